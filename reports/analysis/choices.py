"""Choose which variant to take for which surface, at which error."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pandas as pd

from reports.analysis import derive, shown, ties
from reports.analysis.scene_names import picture_size
from reports.reading.taking import taken
from reports.reading.tuples import tuples

ERRORS = (1e-3, 1e-6)  # largest |t − t*| over the scene's radius
_COLUMNS = [
    *("run", "key", "slot", "arrays", "comparison", "device", "precision", "baseline", "prepass", "origin"),
    *("surface", "surface_title", "degree", "view", "size", "samples_per_pixel", "stage"),
    *("method", "variant", "label", "method_label", *ties.COLUMNS, "floor_ms", "floor_bound"),
    *("wrong_rays", "grazing_wrong_rays", "drowned_wrong_rays", "accuracy_rays"),
    *("error_max", "relative_error_max", "front", "speedup", "warnings"),
]  # of a choice's rows
_JUDGED = [*ties.TOLD, "wrong_rays", "error_max", "relative_error_max"]  # what decides
_CHOSEN_BY = [
    *("surface", "comparison", "device", "method", "variant", "origin", "size", "samples_per_pixel"),
]  # columns that tell the fullest scene


@dataclass(frozen=True, eq=False)
class Choice:
    """Hold what to take for one surface on one device: rows as named tuples of the frame.

    name: the surface's title, with its view, size and stage where those are not as in most of the choices
    rows: the timed rows of the scene that answer, fastest first, with the columns _COLUMNS
    within: the fastest row with every ray away from silhouettes right, at each of ERRORS; None where none is so exact
    tied: the variants of other methods whose times are not told apart from it, as `written`, at each of ERRORS
    tied_rows: their labels in the index of `rows`
    right: the fastest row with every such ray right, whatever its error; None where there is none
    nearest: the most exact of these rows; None where there is none
    """

    surface: str
    name: str
    rows: pd.DataFrame
    within: tuple[Any, ...]
    tied: tuple[tuple[str, ...], ...]
    tied_rows: tuple[tuple[Any, ...], ...]
    right: Any
    nearest: Any

    @property
    def best(self) -> Any:
        """Return the row to take where nothing is said of the error; None where every variant is wrong somewhere."""
        return next((row for row in self.within if row is not None), self.right)

    @property
    def pictured(self) -> Any:
        """Return the row that shows the surface: the best, else that with fewest wrong rays."""
        if self.best is not None:
            return self.best
        return next(tuples(self.rows.sort_values("wrong_rays", kind="stable")))


def choices(frame: pd.DataFrame) -> list[Choice]:
    """Make a choice for each surface that was timed, in the plan's order.

    Rows are of the surface's fullest scene, on the device that has most rows of all.
    """
    rows = fullest_scenes(frame)
    if rows.empty:
        return []
    named = _names(frame.loc[rows.drop_duplicates("comparison").index, _COLUMNS])
    at, of = frame.index.get_indexer(rows.index), rows.groupby("surface", sort=False).indices
    order = [surface for surface in dict.fromkeys(frame["surface"]) if surface in of]
    return [_choice(str(surface), named, taken(frame, at[of[surface]], _COLUMNS)) for surface in order]


def _names(scenes: pd.DataFrame) -> dict[str, str]:
    """Return the name of each scene, of which there is one row of each surface.

    It is the surface's title, and behind it what is not as in most of the scenes.
    """
    told = shape_of(scenes)
    unlike = {name: values.where(values != common(values), "") for name, values in told.items()}
    parts = zip(scenes["surface_title"], *unlike.values(), strict=True)
    names = [", ".join(filter(None, map(str, own))) for own in parts]
    return dict(zip(scenes["comparison"], names, strict=True))


def shape_of(scenes: pd.DataFrame) -> dict[str, pd.Series]:
    """Return view, size and stage of each row as texts."""
    sizes = pd.Series([picture_size(row) for row in tuples(scenes)], scenes.index)
    return {"view": scenes["view"], "size": sizes, "stage": scenes["stage"]}


def common(values: pd.Series) -> Any:
    """Return the value that most of `values` have, the first of several."""
    return values.value_counts(sort=False).idxmax()


def fullest_scenes(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the contenders of each surface's fullest scene, on the device that has most rows of all.

    They have the columns _CHOSEN_BY.
    """
    rows = derive.contenders(frame, _CHOSEN_BY)
    if not rows.empty:
        rows = derive.on_fullest_device(rows)
        in_plan_order = rows.sort_index()
        fullest = [shown.fullest(own) for _, own in in_plan_order.groupby("surface", sort=False)]
        rows = rows[rows["comparison"].isin(fullest)]
    return rows


def _choice(surface: str, named: dict[str, str], rows: pd.DataFrame) -> Choice:
    """Choose among the rows of one scene."""
    rows = rows.sort_values("median_ms", kind="stable")
    judged = rows[_JUDGED]
    right = judged[derive.all_right(judged)]
    usable = [derive.within(judged, error) for error in ERRORS]
    within = [_fastest(own) for own in usable]
    tied_rows = tuple(
        () if won is None else tuple(ties.tied(own, won)) for own, won in zip(usable, within, strict=True)
    )
    firsts = [*(None if won is None else won.Index for won in within), getattr(_fastest(right), "Index", None)]
    firsts.append(next(iter(right["relative_error_max"].sort_values(kind="stable").index), None))
    wanted = {at for at in (*firsts, *itertools.chain(*tied_rows)) if at is not None}
    of = {row.Index: row for row in tuples(rows[rows.index.isin(wanted)])}
    *best, fastest, nearest = (of.get(at) for at in firsts)
    precision = precision_of(rows)
    tied = tuple(tuple(_written(of[at], precision) for at in own) for own in tied_rows)
    name = named[str(rows["comparison"].iloc[0])]
    return Choice(surface, name, rows, tuple(best), tied, tied_rows, fastest, nearest)


def _fastest(rows: pd.DataFrame) -> Any:
    """Return the fastest of `rows`, which are in order of their medians, as ties.best does; None of none."""
    return None if rows.empty else ties.best(rows)


def others(tied: Sequence[str]) -> list[str]:
    """Return the one variant that is not told apart from a winner, or how many there are."""
    return [f"{len(tied)} others"] if len(tied) > 1 else list(tied)


def precision_of(rows: pd.DataFrame) -> str:
    """Return the precision that most of the rows have, the plan's first of several."""
    counts = rows["precision"].value_counts(sort=False)
    if (counts == counts.max()).sum() == 1:  # then their order does not matter
        return str(counts.idxmax())
    return str(common(rows["precision"].sort_index()))


def written(row: Any, rows: pd.DataFrame) -> str:
    """Write the variant of a row, with its precision where that is not the one of most rows of its scene."""
    return _written(row, precision_of(rows))


def _written(row: Any, precision: str) -> str:
    """Write the variant of a row, with its precision where that is another one."""
    return str(row.label) if row.precision == precision else f"{row.label}, {row.precision}"
