"""How speed, error and wrong rays depend on the view: figures over a set of views, as in toledo2007, Table 1."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive
from reports.content import Column, Table
from reports.drawing import tables

FEWEST = 3  # views that make a set
MOST_LISTED = 8  # views of a set that are listed one by one where scenes are
SCENE = ["surface", "view_set", "device", "precision", "size", "samples_per_pixel", "stage"]
ANGLES, DIRECTIONS, NAMED = "angles", "directions", "named views"
RATES = {"cast": "rays cast", "inside": "rays in the domain", "covered": "rays that hit"}
PRINTED_WRONG = 40  # lines of the table of wrong rays


@dataclass(frozen=True, eq=False)
class ViewSet:
    """The finished rows of one surface, device, precision and size, over one set of views."""

    rows: pd.DataFrame  # with the columns of `_with_rates` and the projection angle
    views: tuple[str, ...]  # in the plan's order

    @property
    def first(self) -> Any:
        return next(self.rows.head(1).itertuples())

    @property
    def kind(self) -> str:
        return str(self.first.view_set)

    @property
    def place(self) -> str:
        row = self.first
        return f"{row.surface_title}, {row.device}, {row.precision}, {tables.picture_size(row)}, {row.stage}"

    def variants(self) -> Iterator[tuple[str, pd.DataFrame]]:
        """Each variant that was timed from at least FEWEST views, in the plan's order, with its rows."""
        for variant, rows in self.rows.groupby("variant", sort=False):
            if len(rows) >= FEWEST:
                yield str(variant), rows


def view_sets(frame: pd.DataFrame) -> list[ViewSet]:
    """Every surface × device × precision × size with at least FEWEST views of one set, in the plan's order."""
    rows = frame[(frame["status"] == CellStatus.OK) & frame["median_ms"].notna()]
    rows = _with_rates(rows.assign(view_set=rows["view_set"].fillna(NAMED), angle=90.0 - rows["elevation"]))
    sets = []
    for _, own in rows.groupby(SCENE, sort=False):
        views = tuple(own["view"].unique())
        if len(views) >= FEWEST:
            sets.append(ViewSet(own, views))
    return sets


def one_view_of_each(frame: pd.DataFrame) -> pd.DataFrame:
    """Keep the first view alone of a set of more than MOST_LISTED, for what lists scenes one by one."""
    views = frame.groupby(["surface", "view_set"], dropna=False)["view"]
    large = frame["view_set"].notna() & (views.transform("nunique") > MOST_LISTED)
    return frame[~large | (frame["view"] == views.transform("first"))]


def _with_rates(rows: pd.DataFrame) -> pd.DataFrame:
    """Millions of rays per second: of all that were cast, of those that meet the domain, and of those that hit.

    The rays of the accuracy check say which share meets the domain and hits; a method that answers nothing takes the
    shares of the others.
    """
    shares = pd.DataFrame({"cast": 1.0}, index=rows.index)
    for name, count in (("inside", "domain_rays"), ("covered", "truth_hits")):
        share = rows[count].astype("float64") / rows["accuracy_rays"].astype("float64")
        shares[name] = share.fillna(share.groupby(rows["comparison"]).transform("max"))
    rates = shares.mul(rows["mrays_per_s"], axis=0)
    per_ray = 1.0 / rates["inside"].where(rates["inside"] > 0).fillna(rates["cast"])
    return rows.assign(**{f"{name}_rate": rates[name] for name in RATES}, us_per_ray=per_ray)


def spread(values: pd.Series) -> float:
    """StdDev over average as in Table 1, whose figures are those of the population's standard deviation."""
    return float(values.std(ddof=0) / values.mean())


def dependence(of: ViewSet) -> Table:
    """One line for each variant, the most view-dependent first."""
    body = []
    for variant, rows in of.variants():
        slow = rows.loc[rows["us_per_ray"].idxmax()]
        rates = [f(rows[f"{name}_rate"]) for name in RATES for f in (pd.Series.mean, spread)]
        errors = rows["error_max"].astype("float64")
        worst = rows.loc[errors.idxmax()] if errors.notna().any() else None
        wrong = rows["wrong_rays"].fillna(0).astype(int)
        mistaken = rows.loc[wrong.idxmax(), "view"] if wrong.any() else None
        answers = bool(rows["answers"].iloc[0])
        body.append(
            (
                variant,
                *rates,
                float(((rows["upper_ms"] - rows["lower_ms"]) / (2 * rows["median_ms"])).max()),
                slow["view"],
                float(slow["us_per_ray"] / rows["us_per_ray"].mean()),
                None if worst is None else worst["view"],
                None if worst is None else worst["error_max"],
                int(wrong.sum()) if answers else None,
                int((wrong > 0).sum()) if answers else None,
                mistaken,
                int(rows["grazing_wrong_rays"].fillna(0).sum()) if answers else None,
                int(rows["drowned_wrong_rays"].fillna(0).sum()) if answers else None,
            )
        )
    body.sort(key=lambda row: -(row[4] if row[4] == row[4] else row[2]))
    rate_columns = (
        Column(title, show, numeric=True, over=f"{over},\nMrays/s")
        for over in RATES.values()
        for title, show in (("mean", wording.number), ("std/mean", wording.percentage))
    )
    return Table(
        (
            Column("variant", stretch=1),
            *rate_columns,
            Column("noise,\n±", wording.share, numeric=True),
            Column("view", over="slowest per ray"),
            Column("over\nmean", wording.factor, numeric=True, over="slowest per ray"),
            Column("view", over="worst error"),
            Column("|t − t*|", wording.error, numeric=True, over="worst error"),
            Column("all", wording.count, numeric=True, over="wrong rays"),
            Column("in\nviews", wording.count, numeric=True, over="wrong rays"),
            Column("most in", over="wrong rays"),
            Column("grazing", wording.count, numeric=True, over="wrong rays"),
            Column("drowned", wording.count, numeric=True, over="wrong rays"),
        ),
        body,
        f"View dependence over {len(of.views)} {_name(of)}: {of.place}.",
        "The most view-dependent first, by the spread of rays in the domain per second. A spread says something of the "
        "method only well above the noise: half the 95 % interval of the median, in the view where it is widest. "
        f"Wrong rays are of the {tables.checked(of.rows)} rays of each view's check."
        + wording.zeros([row[11] for row in body]),
    )


def _name(of: ViewSet) -> str:
    named = {ANGLES: "projection angles", DIRECTIONS: "directions"}.get(of.kind, of.kind)
    return named if of.kind in (ANGLES, DIRECTIONS, NAMED) else f"views of the set “{named}”"


def wrong_rays(of: ViewSet) -> Table | None:
    """Every variant and view with a wrong ray, neither grazing nor drowned, the most wrong first; None without one."""
    rows = of.rows[of.rows["wrong_rays"].fillna(0) > 0].sort_values("wrong_rays", ascending=False, kind="stable")
    if rows.empty:
        return None
    kinds = derive.kinds(rows)
    apart = ("grazing_wrong_rays", "drowned_wrong_rays")
    body = [
        (r.variant, r.view, r.wrong_rays, *(getattr(r, name) for name in (*kinds, *apart)))
        for r in rows.head(PRINTED_WRONG).itertuples()
    ]
    titles = ("wrong", *(kind.replace("_", " ") for kind in kinds), "grazing wrong", "drowned wrong")
    cut = f" The first {PRINTED_WRONG} of {len(rows):,}; results.csv has all." if len(rows) > PRINTED_WRONG else ""
    return Table(
        (
            Column("variant", stretch=1),
            Column("view"),
            *(Column(title, wording.count, numeric=True) for title in titles),
        ),
        body,
        f"Wrong rays view by view: {of.place}.",
        f"Of the {wording.count(of.first.accuracy_rays)} rays of each view's check; other views have none.{cut}",
    )
