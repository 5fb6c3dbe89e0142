"""Tell where the suite's own methods are on the front of speed against error, and who wins where they are not."""

from __future__ import annotations

from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import derive, rounds, ties
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Section, Table, Text
from reports.material import Material

ORDER = 12
OWN = "firsthit"  # how the source begins that a method of our own states


def sections(material: Material) -> list[Section]:
    """Make a section for each method of our own; [] where none was timed beside another method."""
    own = sorted(name for name, told in material.run.plan.methods.items() if str(told.get("source")).startswith(OWN))
    return [section for name in own for section in _of(name, material.listed)]


def _of(method: str, frame: pd.DataFrame) -> list[Section]:
    """Make the section of one method; [] where it has no comparison with a front."""
    rows = derive.contenders(frame)
    groups = [group for _, group in rows.groupby(derive.GROUP) if group["method"].nunique() > 1]
    groups = [group for group in groups if (group["method"] == method).any()]
    lines = [_line(method, group) for group in groups if group["front"].any()]
    if not lines:
        return []
    planned = list(dict.fromkeys(frame["comparison"]))
    lines.sort(key=lambda line: (line[0], planned.index(line[1]), line[2]))
    named = scene_names(rows)
    body = [(degree, named[comparison], *told) for degree, comparison, *told, _ in lines]
    off = [line for line in lines if line[3] == "no"]
    told = f"{method} is on the front in {len(lines) - len(off)} of {wording.plural(len(lines), 'comparison')}"
    blocks: list[Block] = [Text(f"{told}{_lost(off)}.{_without(len(groups) - len(lines))}")]
    columns = (
        Column("degree", wording.count, numeric=True),
        Column("surface", stretch=1),
        Column("device"),
        Column("on the front"),
        Column("variant", stretch=1, over=f"{method}, fastest on the front or at all"),
        Column("ms", wording.number, numeric=True, over=f"{method}, fastest on the front or at all"),
        Column("max error", wording.error, numeric=True, over=f"{method}, fastest on the front or at all"),
        Column("variant", stretch=1, over="fastest of the others, as exact"),
        Column("ms", wording.number, numeric=True, over="fastest of the others, as exact"),
        Column("max error", wording.error, numeric=True, over="fastest of the others, as exact"),
        Column("faster", wording.factor, numeric=True),
    )
    caption = (
        "The others are those with no wrong ray away from silhouettes and no larger error than that variant of "
        f"{method}; “none” where there is none. Faster is their fastest's time over {method}'s, in the rounds that "
        "timed both, where that has no such ray "
        f"either.{wording.zeros([line[6] for line in body], [line[9] for line in body])}"
    )
    return [Section(f"{method} on the front", (*blocks, Table(columns, body, "By degree.", caption)))]


def _line(method: str, group: pd.DataFrame) -> tuple[Any, ...]:
    """Make the line of one comparison; its last item tells whether the rival is proved faster.

    The rows of `group` are fastest first.
    """
    own = group[group["method"] == method]
    right = own[derive.all_right(own)]
    on_front = right[right["front"].astype(bool)]
    first = next(pd.concat([on_front, right, own]).head(1).itertuples())
    others = group[(group["method"] != method) & derive.all_right(group) & (group["error_max"] <= first.error_max)]
    rival = next(others.head(1).itertuples(), None)
    told: list[Any] = [first.device, "no" if on_front.empty else "yes", str(first.variant)]
    told += [first.median_ms, first.error_max]
    told += ["none", None, None, None] if rival is None else _rival(rival, first if len(right) else None)
    beaten = rival is not None and ties.is_slower(first, rival)
    return (int(first.degree), str(first.comparison), *told, beaten)


def _rival(row: Any, own: Any | None) -> list[Any]:
    """Return the cells of the rival `row`; the last is its time over that of `own`, None where `own` is None."""
    return [str(row.variant), row.median_ms, row.error_max, None if own is None else rounds.times_over(row, own)]


def _without(count: int) -> str:
    """Say in how many comparisons there is no front; "" for none."""
    if not count:
        return ""
    return (
        f" {wording.plural(count, 'more comparison')} without a front: there no method answers every ray away from "
        "silhouettes rightly with a hit among them."
    )


def _lost(off: list[tuple[Any, ...]]) -> str:
    """Say at which degrees the method is not on the front, and which methods win there; "" where it always is."""
    if not off:
        return ""
    degrees = sorted({line[0] for line in off})
    winners = sorted({str(line[7]).partition("[")[0].partition("+")[0] for line in off if line[-1]})
    who = f"; there {wording.listed(winners)} win" + ("s" if len(winners) == 1 else "") if winners else ""
    return f"; it is not at degree {wording.listed([str(d) for d in degrees])}{who}"
