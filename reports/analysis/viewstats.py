"""Group rows into sets of views, and compute how their speed depends on the view, as toledo2007's Table 1 does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports.analysis.scene_names import picture_size
from reports.reading.tuples import tuples

FEWEST = 3  # views that a set has at least
MOST_LISTED = 8  # of a set with more views only the first is in tables that list scenes one by one
SCENE = ["surface", "view_set", "device", "precision", "size", "samples_per_pixel", "stage"]
ANGLES, DIRECTIONS, PATH, NAMED = "angles", "directions", "path", "named views"
RATES = {"cast": "rays cast", "inside": "rays in the domain", "covered": "rays that hit"}


@dataclass(frozen=True, eq=False)
class ViewSet:
    """Hold the finished rows of one surface, device, precision, size and stage, over one set of views."""

    rows: pd.DataFrame  # with the columns of `_with_rates`, and the projection angle in degrees as `angle`
    views: tuple[str, ...]  # in the plan's order

    @property
    def first(self) -> Any:
        """Return the first row, as a named tuple."""
        return next(tuples(self.rows.head(1)))

    @property
    def kind(self) -> str:
        """Return the kind of the set: ANGLES, DIRECTIONS, PATH, NAMED, or the name that a config gives it."""
        return str(self.first.view_set)

    @property
    def place(self) -> str:
        """Return surface, device, precision, size and stage as one text for readers."""
        row = self.first
        return f"{row.surface_title}, {row.device}, {row.precision}, {picture_size(row)}, {row.stage}"

    def variants(self) -> Iterator[tuple[str, pd.DataFrame]]:
        """Yield each variant that was timed from at least FEWEST views, with its rows, in the plan's order."""
        for variant, rows in self.rows.groupby("variant", sort=False):
            if len(rows) >= FEWEST:
                yield str(variant), rows


def view_sets(frame: pd.DataFrame) -> list[ViewSet]:
    """Return a set for each of SCENE's combinations that was timed from at least FEWEST views, in the plan's order."""
    if frame["view"].nunique() < FEWEST:
        return []
    rows = frame[(frame["status"] == CellStatus.OK) & frame["median_ms"].notna()]
    rows = _with_rates(rows.assign(view_set=rows["view_set"].fillna(NAMED), angle=90.0 - rows["elevation"]))
    sets = []
    for _, own in rows.groupby(SCENE, sort=False):
        views = tuple(own["view"].unique())
        if len(views) >= FEWEST:
            sets.append(ViewSet(own, views))
    return sets


def one_view_of_each(frame: pd.DataFrame) -> pd.DataFrame:
    """Keep only the first view of each set of more than MOST_LISTED views, for tables that list scenes one by one."""
    views = frame.groupby(["surface", "view_set"], dropna=False)["view"]
    large = frame["view_set"].notna() & (views.transform("nunique") > MOST_LISTED)
    return frame[~large | (frame["view"] == views.transform("first"))] if large.any() else frame


def _with_rates(rows: pd.DataFrame) -> pd.DataFrame:
    """Add the rates of RATES in millions of rays per second, and the time per ray in the domain, `us_per_ray`.

    The rates are of all rays cast, of those that meet the domain and of those that hit, by their shares of the rays of
    the accuracy check. A method that answers nothing takes the shares of the others.
    """
    shares = pd.DataFrame({"cast": 1.0}, index=rows.index)
    for name, count in (("inside", "domain_rays"), ("covered", "truth_hits")):
        share = rows[count].astype("float64") / rows["accuracy_rays"].astype("float64")
        shares[name] = share.fillna(share.groupby(rows["comparison"]).transform("max"))
    rates = shares.mul(rows["mrays_per_s"], axis=0)
    per_ray = 1.0 / rates["inside"].where(rates["inside"] > 0).fillna(rates["cast"])
    return rows.assign(**{f"{name}_rate": rates[name] for name in RATES}, us_per_ray=per_ray)


def spread(values: pd.Series) -> float:
    """Return the population's standard deviation over the mean, which is what Table 1 prints as StdDev/Average."""
    return float(values.std(ddof=0) / values.mean())
