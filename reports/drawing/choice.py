"""Make the table of which method to take for which surface, at which error, and what that costs."""

from __future__ import annotations

from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import derive, rounds, shown, ties
from reports.analysis.scene_names import picture_size, scene_names
from reports.content import Column, Table

ERRORS = (1e-3, 1e-6)  # largest |t − t*| over the scene's radius
LINES = 26  # surfaces that fit on the first page


def _fullest_scenes(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the contenders of each surface's fullest scene, on the device that has most rows of all."""
    rows = derive.contenders(frame)
    if rows.empty:
        return rows
    rows = derive.on_fullest_device(rows)
    in_plan_order = rows.sort_index()
    fullest = [shown.fullest(own) for _, own in in_plan_order.groupby("surface", sort=False)]
    return rows[rows["comparison"].isin(fullest)]


def _fastest(rows: pd.DataFrame, error: float) -> Any | None:
    """Return the fastest row of one scene with no wrong ray away from silhouettes and at most this error, or None."""
    good = _usable(rows, error)
    return None if good.empty else next(good.loc[[ties.best(good).Index]].itertuples())


def _usable(rows: pd.DataFrame, error: float) -> pd.DataFrame:
    """Return the rows with no wrong ray away from silhouettes and at most this error, fastest first."""
    good = rows[derive.all_right(rows) & (rows["relative_error_max"] <= error)]
    return good.sort_values("median_ms", kind="stable")


def table(frame: pd.DataFrame) -> Table | None:
    """Make a line for each surface: its fastest row at each of ERRORS; None where nothing was timed."""
    rows = _fullest_scenes(frame)
    if rows.empty:
        return None
    body: list[tuple[Any, ...]] = []
    order, named = list(dict.fromkeys(frame["surface"])), scene_names(frame)
    for _, own in sorted(rows.groupby("surface", sort=False), key=lambda pair: order.index(pair[0])):
        loose, tight = (_fastest(own, error) for error in ERRORS)
        cells: list[Any] = [named[str(own["comparison"].iloc[0])]]
        for won, error in zip((loose, tight), ERRORS, strict=True):
            cells += ["none", None, None] if won is None else [_named(won, own, error), won.median_ms, won.error_max]
        cells.append(None if loose is None or tight is None else rounds.times_over(tight, loose))
        body.append(tuple(cells))
    printed = body[:LINES]
    shared, several = _shared(rows), frame["device"].nunique() > 1
    more = "" if len(printed) == len(body) else f" {len(printed)} of {len(body)} surfaces; “Winners” has all."
    columns: list[Column] = [Column("surface")]
    for error in ERRORS:
        over = f"error at most {wording.level(error)}"
        columns += [
            Column("fastest", stretch=1, over=over),
            Column("ms", wording.number, numeric=True, over=over),
            Column("max error", wording.error, numeric=True, over=over),
        ]
    columns.append(Column("cost", wording.factor, numeric=True))
    return Table(
        tuple(columns),
        printed,
        "Which method, at which error, on "
        f"{rows['device'].iloc[0]}{', the first with most results' if several else ''}.",
        f"{shared}The fastest variant with every ray away from silhouettes right and a largest error over the radius "
        "of the scene of at most this; max error is in scene units. Cost is the time of the second over that of the "
        "first, in the rounds that timed both; “none” where no variant of this run is that exact; “≈” stands before "
        "variants of other methods whose times are not told apart from its "
        f"own.{wording.zeros([row[i] for row in printed for i in (3, 6)])}{more}",
    )


def _shared(rows: pd.DataFrame) -> str:
    """Write the view and the size where all scenes share them; what differs is in the names of the scenes."""
    told = [f"view {rows['view'].iloc[0]}"] if rows["view"].nunique() == 1 else []
    sizes = {picture_size(row) for row in rows.itertuples()}
    told += sizes if len(sizes) == 1 else []
    scenes = "the scene with most methods of each surface"
    return f"Of {', '.join([scenes, *told])}. "


def _named(row: Any, own: pd.DataFrame, error: float) -> str:
    """Write the variant of `row`, and behind it the variants of other methods that are not proved slower.

    The other variants are those of `own`, the rows of the scene, that answer rightly within `error`.
    """
    name = f"{row.variant}, {row.precision}" if own["precision"].nunique() > 1 else str(row.variant)
    return " ≈ ".join([name, *ties.tied(_usable(own, error), row)])
