"""Make the table of which method to take for which surface, at which error, and what that costs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import choices, rounds
from reports.analysis.choices import ERRORS, Choice
from reports.content import Column, Table

LINES = 26  # surfaces that fit on the first page
NAMED = 4  # surfaces or variants that a sentence names
_OTHERS = " Of each surface it is the scene with most methods, and of several the largest picture; “Winners” has all."
LETTERS = 60  # of a surface's name, so that a long one leaves the other columns room


def table(frame: pd.DataFrame) -> Table | None:
    """Make a line for each surface: its fastest row at each of ERRORS; None where nothing was timed."""
    found = choices.choices(frame)
    return made(found, frame["device"].nunique() > 1) if found else None


def made(found: Sequence[Choice], several: bool, surfaces: int = 0, scenes: int = 0) -> Table:
    """Make the table of these choices, of which there is at least one; `several` tells that the run has more devices.

    `surfaces` and `scenes` are how many the run has, 0 where these are all. At most LINES of them are printed.
    """
    printed = [_line(choice) for choice in found[:LINES]]
    rows = pd.concat([choice.rows for choice in found])
    every = max(surfaces, len(found))
    more = "" if len(printed) == every else f" {len(printed)} of {every} surfaces; “Winners” has all."
    columns: list[Column] = [Column("surface")]
    for error in ERRORS:
        over = f"error at most {wording.level(error)} of the radius"
        columns += [
            Column("fastest", stretch=1, over=over),
            Column("ms", wording.number, numeric=True, over=over),
            Column("error", wording.error, numeric=True, over=over),
        ]
    columns.append(Column("cost", wording.factor, numeric=True))
    nearest = any(choice.within[-1] is None and choice.nearest is not None for choice in found[:LINES])
    where = f"{rows['device'].iloc[0]}{', the device with most results' if several else ''}"
    return Table(
        tuple(columns),
        printed,
        f"Which method, at which error, on {where}.",
        f"{_shared(rows)}Fastest of the variants with every ray away from silhouettes right. Error is the largest "
        f"over the radius; cost is how many times as long the choice at {wording.level(ERRORS[-1])} takes."
        + (" Behind “none” stands the most exact variant of this run, with its own figures." if nearest else "")
        + (" “≈” stands before what is not told apart." if _any_tied(found[:LINES]) else "")
        + _bound(found[:LINES])
        + _unsteady(found[:LINES])
        + _apart(found[:LINES])
        + (_OTHERS if scenes > every else "")
        + wording.zeros([row[i] for row in printed for i in (3, 6)])
        + more,
    )


def _line(choice: Choice) -> tuple[Any, ...]:
    """Make the line of one surface."""
    cells: list[Any] = [wording.excerpt(choice.name, LETTERS)]
    for won, tied in zip(choice.within, choice.tied, strict=True):
        if won is not None:
            cells += [
                " ≈ ".join([choices.written(won, choice.rows), *choices.others(tied)]),
                won.median_ms,
                won.relative_error_max,
            ]
        elif choice.nearest is not None:
            near = choice.nearest
            cells += [f"none; {choices.written(near, choice.rows)}", near.median_ms, near.relative_error_max]
        else:
            cells += ["none", None, None]
    loose, tight = choice.within[0], choice.within[-1]
    cells.append(None if loose is None or tight is None else rounds.times_over(tight, loose))
    return tuple(cells)


def _any_tied(found: Sequence[Choice]) -> bool:
    """Tell whether some winner is not told apart from others."""
    return any(tied for choice in found for tied in choice.tied)


def _bound(found: Sequence[Choice]) -> str:
    """Say which winners' times are floor-bound; "" for none."""
    names = [choice.name for choice in found if any(won is not None and bool(won.floor_bound) for won in choice.within)]
    if not names:
        return ""
    return f" Floor-bound, so that the time is mostly the harness's own: {wording.listed(names)}."


def _unsteady(found: Sequence[Choice]) -> str:
    """Say of which surfaces the winners' times are noisy or drift; "" for none."""
    names = [choice.name for choice in found if any(won is not None and _warned(won) for won in choice.within)]
    if not names:
        return ""
    where = wording.listed(names) if len(names) <= NAMED else f"{len(names)} of {wording.plural(len(found), 'surface')}"
    return f" Times are noisy or drift, as on a busy machine, so that ratios are rough: {where}."


def _warned(row: Any) -> bool:
    return not wording.absent(row.warnings) and bool(json.loads(row.warnings))


def _apart(found: Sequence[Choice]) -> str:
    """Say which variants were not timed in one run with the others of their scene; "" for none."""
    labels: dict[str, None] = {}
    for choice in found:
        sessions = choice.rows["session"].dropna()
        if sessions.nunique() > 1:
            main = choices.common(sessions)
            others = choice.rows[choice.rows["session"].notna() & (choice.rows["session"] != main)]
            labels |= dict.fromkeys(map(str, others.sort_index()["label"]))
    if not labels:
        return ""
    return (
        f" Timed in another run than the rest, so that only times far apart are told apart and none is divided: "
        f"{wording.few(list(labels), NAMED)}; with --force all are timed in turns."
    )


def _shared(rows: pd.DataFrame) -> str:
    """Write the view, the size and the precision of most scenes; what differs is in the names of the scenes."""
    told = choices.shape_of(rows.drop_duplicates("comparison"))
    precisions = pd.Series([choices.precision_of(own) for _, own in rows.groupby("surface")])
    parts = [f"View {choices.common(told['view'])}", choices.common(told["size"])]
    several = rows["precision"].nunique() > 1
    parts += [choices.common(precisions)] if several else []
    unlike = several or any(told[name].nunique() > 1 for name in ("view", "size"))
    return f"{', '.join(parts)}{' where no other is named' if unlike else ''}. "
