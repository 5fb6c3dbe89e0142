"""Decide whether the times of two variants differ, by the rounds that timed both.

Only rows that share no round are compared by the intervals of their two medians. Rows that share too few rounds for a
test are told apart only where they are far apart in all of these.
"""

from __future__ import annotations

from typing import Any

import pandas as pd

from harness.results import ranks, timings
from harness.results.timings import Ratio
from reports import wording
from reports.analysis import derive, rounds
from reports.analysis.rounds import ratio

LEVEL = 0.01  # the largest chance that is evidence of a difference
NEEDED = ranks.pairs_needed(LEVEL)
FAR = 4.0  # times that differ by more than this factor in every common round are told apart without a test
SLOWER, FASTER, ALIKE = "slower", "faster", "not told apart"
TORN = f"{ALIKE}: the test and the interval disagree"
COLUMNS = [*rounds.COLUMNS, "median_ms", "lower_ms", "upper_ms"]
_TOLD = ["method", "variant", "key", *COLUMNS]
RULE = (
    "Two times differ where both variants were timed in the same rounds and a signed-rank test of the rounds' ratios "
    f"leaves a chance of at most {LEVEL:g}, which takes {NEEDED} rounds, and the 95 % interval of their median is "
    "all on one side of 1. Where they share fewer rounds, they differ where each time of the one in these is more than "
    f"{FAR:g} times each of the other. Times that share no round differ where the 95 % intervals of both medians do "
    "not meet"
)


def verdict(of: Ratio) -> str:
    """Return SLOWER, FASTER, ALIKE or TORN; where there were too few rounds, a text that tells how many are needed."""
    if of.pairs < NEEDED:
        least = wording.short(ranks.least_chance(of.pairs))
        return f"too few rounds: {of.pairs} can at best give a chance of {least}; needs {NEEDED}"
    aside = of.proved and (of.lower > 1.0 or of.upper < 1.0)
    if aside != (of.chance <= LEVEL):
        return TORN
    return ALIKE if not aside else SLOWER if of.lower > 1.0 else FASTER


def is_slower(row: Any, other: Any) -> bool:
    """Tell whether `row` is told to be slower than `other`: by common rounds, else by intervals that do not meet."""
    paired = ratio(row, other)
    if paired is not None:
        return verdict(paired) == SLOWER or (paired.pairs < NEEDED and _far_slower(row, other))
    enough = all(timings.proves(len(one.samples_ms or ())) for one in (row, other))
    return bool(enough and row.lower_ms > other.upper_ms)


def _far_slower(row: Any, other: Any) -> bool:
    """Tell whether in the rounds that timed both each time of `row` is more than FAR times each of `other`."""
    own, others = rounds.common(row, other)
    return min(own) > FAR * max(others)


def best(rows: pd.DataFrame) -> Any:
    """Return the fastest of `rows`, as a named tuple of the columns of _TOLD.

    `rows` are in order of their medians, fastest first; there is at least one. A median is over all rounds of its row.
    So a row takes the place of the first where it is faster in the rounds that timed both.
    """
    return _best(list(rows[_TOLD].itertuples()))


def tied(rows: pd.DataFrame, first: Any) -> list[Any]:
    """Return the labels in the index of the rows of other methods that are not told to be slower than `first`.

    Of each method it is the fastest. `rows` are of one scene and device, in order of their medians.
    """
    return [row.Index for row in _tied(list(rows[_TOLD].itertuples()), first)]


def _best(rows: list[Any]) -> Any:
    """Do what `best` does, for rows as named tuples."""
    first = rows[0]
    for row in rows[1:]:
        if row.samples_ms and first.samples_ms and min(row.samples_ms) >= max(first.samples_ms):
            continue  # it is faster in no round
        if rounds.is_no_faster(row, first):
            continue
        paired = ratio(row, first)  # whatever the medians: they may be of other rounds
        if paired is not None and verdict(paired) == FASTER:
            first = row
    return first


def _tied(rows: list[Any], first: Any) -> list[Any]:
    """Return the rows that `tied` tells of, as named tuples."""
    fastest_of: dict[str, Any] = {}
    for row in rows:
        if row.method != first.method:
            fastest_of.setdefault(row.method, row)
    return [row for row in fastest_of.values() if not is_slower(row, first)]


def _groups(rows: pd.DataFrame) -> list[list[Any]]:
    """Return the rows of each group, in their order."""
    found: dict[tuple[Any, ...], list[Any]] = {}
    for row in rows[[*derive.GROUP, *_TOLD]].itertuples():
        found.setdefault((row.comparison, row.device, row.precision), []).append(row)
    return list(found.values())


def leaders(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the fastest row with every ray right of each group that has one, with two more columns.

    `tied` lists the rows of other methods that are not told to be slower, of each method its fastest. `methods` is
    the number of methods timed in the group.
    """
    rows = derive.contenders(frame, [*derive.GROUP, *_TOLD, "wrong_rays"])
    methods = rows.groupby(derive.GROUP)["method"].nunique().rename("methods")
    right = rows[derive.all_right(rows)]
    groups = _groups(right)
    firsts = [_best(own) for own in groups]
    found = pd.Series(
        [[str(row.variant) for row in _tied(own, first)] for own, first in zip(groups, firsts, strict=True)],
        [first.Index for first in firsts],
        dtype=object,
    )
    return frame.loc[found.index].assign(tied=found).join(methods, on=derive.GROUP)


def fastest(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the fastest row of each group, whether it answers every ray rightly or not."""
    rows = derive.contenders(frame, [*derive.GROUP, *_TOLD])
    return frame.loc[[_best(own).Index for own in _groups(rows)]]
