"""Choose the rows that a report shows ray by ray, as pictures, maps and clouds of points."""

from __future__ import annotations

import pandas as pd

from harness.contract import CellStatus
from reports.analysis.derive import casters, on_fullest_device
from reports.reading.taking import taken

SPREADS = 8  # a run with at most so many surfaces has two pages for each; one with more has an atlas
FOLDED = 6  # the surfaces of an atlas whose pages are in the details, which are HTML alone
MANY_ROWS = 20_000  # of a run whose report would take too long
EVERY_VARIANT = 20  # a strip of error maps has all variants if there are at most so many, else one of each method
MOST_MAPS = 40  # maps of one strip
EVERY_VIEW = 3  # a surface with so many views or fewer has maps of all; else each variant has one of its worst view
MOST_SURFACES = 4  # a run with more surfaces has no maps of evaluations


_BY = [
    *("status", "answers", "arrays", "comparison", "device", "precision", "method", "variant", "origin"),
    *("size", "samples_per_pixel"),
]


def _is_pictured(rows: pd.DataFrame) -> pd.Series:
    """Tell for each row whether it is finished, of a method that answers, and its arrays are stored."""
    return (rows["status"] == CellStatus.OK) & rows["answers"].astype(bool) & rows["arrays"].notna()


def of_surface(rows: pd.DataFrame, per_method: int = 1) -> pd.DataFrame:
    """Select at most `per_method` variants of each method and precision from the rows of one surface.

    They are of the surface's fullest scene, on the device with most rows there. Of each method they are the first in
    the plan's order, so that every precision shows the same variants where that can be.
    """
    told = rows.loc[_is_pictured(rows), _BY]
    if told.empty:
        return rows.head(0)
    kept = on_fullest_device(told[told["comparison"] == fullest(told)])
    kept = kept[kept.groupby(["method", "precision"]).cumcount() < per_method]
    return rows.loc[kept.sort_values(["method", "precision"], kind="stable").index]


def fullest(rows: pd.DataFrame) -> str:
    """Return the comparison with most methods among rows of one surface.

    Of several with equally many it is that with most variants, not counting where their rays begin, then that with most
    rays, of whose time the harness's own is the least part, and then the first in the plan's order.
    """
    first = rows["comparison"].iloc[0]
    if (rows["comparison"] == first).all():
        return str(first)
    rays = rows["size"].astype("float64") ** 2 * rows["samples_per_pixel"].astype("float64")
    told = rows[["comparison", "method"]].assign(variant=casters(rows), rays=rays)
    grouped = told.groupby("comparison", sort=False)
    counted = grouped[["method", "variant"]].nunique().join(grouped["rays"].max())
    return str(counted.sort_values(["method", "variant", "rays"], ascending=False, kind="stable").index[0])


def on_pages(rows: pd.DataFrame) -> pd.DataFrame:
    """Select the finished rows of one surface that its pages are about: of one scene and device.

    They are the fullest scene and the device with most rows there, of those with pictures if there are any.
    """
    finished, pictured = rows["status"] == CellStatus.OK, _is_pictured(rows)
    told = rows.loc[pictured if pictured.any() else finished, _BY]
    if told.empty:
        return rows.head(0)
    told = on_fullest_device(told[told["comparison"] == fullest(told)])
    scene, device = told["comparison"].iloc[0], told["device"].iloc[0]
    chosen = finished & (rows["comparison"] == scene) & (rows["device"] == device)
    return rows if chosen.all() else rows[chosen]  # of very many rows a copy takes long


def in_strip(rows: pd.DataFrame) -> pd.DataFrame:
    """Select the rows of one surface whose error maps are shown, the fastest first in each precision.

    They are all variants of `on_pages`, or, of more than EVERY_VARIANT, one of each method; at most MOST_MAPS.
    """
    own = on_pages(rows)
    every = own[_is_pictured(own)]
    kept = every if len(every) <= EVERY_VARIANT else of_surface(own)
    return kept.sort_values(["precision", "median_ms", "error_max"], kind="stable").head(MOST_MAPS)


def with_pages(frame: pd.DataFrame) -> list[str]:
    """Return the names of the surfaces that have pages of their own: all of SPREADS, else the first FOLDED.

    Of more rows than MANY_ROWS it is the first surface alone, since such pages take a second each.
    """
    names = [str(name) for name in dict.fromkeys(frame["surface"])]
    return names if len(names) <= SPREADS else names[: FOLDED if len(frame) <= MANY_ROWS else 1]


def in_galleries(frame: pd.DataFrame) -> pd.DataFrame:
    """Select the rows whose error maps the surfaces' pages show."""
    places, kept = frame.groupby("surface", sort=False).indices, with_pages(frame)
    own = (in_strip(taken(frame, at)) for name, at in places.items() if name in kept)
    return pd.concat([frame.head(0), *own])


def in_evaluation_maps(frame: pd.DataFrame) -> pd.DataFrame:
    """Select the rows whose evaluations are shown ray by ray; none in a run of more than MOST_SURFACES surfaces."""
    there = _is_pictured(frame)
    if not 0 < frame.loc[there, "surface"].nunique() <= MOST_SURFACES:
        return frame.head(0)
    rows = on_fullest_device(frame[there])
    rows = rows[rows["precision"] == rows["precision"].iloc[0]].drop_duplicates(["surface", "view", "variant"])
    by_surface = (own for _, own in rows.groupby("surface", sort=False))
    return pd.concat([own if own["view"].nunique() <= EVERY_VIEW else _worst_views(own) for own in by_surface])


def _worst_views(rows: pd.DataFrame) -> pd.DataFrame:
    """Keep for each variant the view with most wrong rays; among equals that with most evaluations on one ray."""
    ordered = rows.sort_values(["wrong_rays", "evaluations_max", "evaluations_mean"], ascending=False, kind="stable")
    return rows.loc[sorted(ordered.drop_duplicates("variant").index)]
