"""Decide whether the times of two variants differ, by the rounds that timed both.

Rows that share too few rounds for a test are told apart only where they are far apart in all of these. Rows that share
none were timed in different runs, between which the machine may have been busier by a factor: they are told apart only
where the intervals of their two medians are far apart.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from harness.results import ranks, timings
from harness.results.timings import Ratio
from reports import wording
from reports.analysis import derive, rounds
from reports.analysis.rounds import ratio
from reports.reading.tuples import tuples

LEVEL = 0.01  # the largest chance that is evidence of a difference
NEEDED = ranks.pairs_needed(LEVEL)
FAR = 4.0  # times that differ by more than this factor in every common round, or without one, need no test
SLOWER, FASTER, ALIKE = "slower", "faster", "not told apart"
TORN = f"{ALIKE}: the test and the interval disagree"
COLUMNS = [*rounds.COLUMNS, "median_ms", "lower_ms", "upper_ms"]
TOLD = ["method", "variant", "key", *COLUMNS]
RULE = (
    "Two times differ where both variants were timed in the same rounds and a signed-rank test of the rounds' ratios "
    f"leaves a chance of at most {LEVEL:g}, which takes {NEEDED} rounds, and the 95 % interval of their median is "
    "all on one side of 1. Where they share fewer rounds, they differ where each time of the one in these is more than "
    f"{FAR:g} times each of the other. Times that share no round are of different runs, between which the machine may "
    f"have changed: they differ where the 95 % intervals of both medians are more than a factor of {FAR:g} apart"
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
    """Tell whether `row` is told to be slower than `other`: by common rounds, else by intervals that are far apart."""
    paired = ratio(row, other)
    if paired is not None:
        return verdict(paired) == SLOWER or (paired.pairs < NEEDED and _far_slower(row, other))
    enough = all(timings.proves(len(one.samples_ms or ())) for one in (row, other))
    return bool(enough and row.lower_ms > FAR * other.upper_ms)


def _far_slower(row: Any, other: Any) -> bool:
    """Tell whether in the rounds that timed both each time of `row` is more than FAR times each of `other`."""
    own, others = rounds.common(row, other)
    return min(own) > FAR * max(others)


def best(rows: pd.DataFrame) -> Any:
    """Return the fastest of `rows`, as a named tuple of the columns of TOLD.

    `rows` are in order of their medians, fastest first; there is at least one. A median is over all rounds of its row.
    So a row takes the place of the first where it is faster in the rounds that timed both.
    """
    rows = rows[TOLD]
    first, behind = _at(rows, 0), 1
    while behind < len(rows):
        left = rows.iloc[behind:]
        for at in (behind + np.flatnonzero(rounds.maybe_faster(left, first))).tolist():  # the others take no test
            row = _at(rows, at)
            if row.samples_ms and first.samples_ms and min(row.samples_ms) >= max(first.samples_ms):
                continue  # it is faster in no round
            paired = ratio(row, first)  # whatever the medians: they may be of other rounds
            if paired is not None and verdict(paired) == FASTER:
                first, behind = row, at + 1
                break
        else:
            break
    return first


def _at(rows: pd.DataFrame, place: int) -> Any:
    """Return the row at a place as a named tuple."""
    return next(tuples(rows.iloc[place : place + 1]))


def tied(rows: pd.DataFrame, first: Any) -> list[Any]:
    """Return the labels in the index of the rows of other methods that are not told to be slower than `first`.

    Of each method it is the fastest. `rows` are of one scene and device, in order of their medians.
    """
    return [row.Index for row in _tied(rows, first)]


def _tied(rows: pd.DataFrame, first: Any) -> list[Any]:
    """Return the rows that `tied` tells of, as named tuples."""
    fastest_of = rows.loc[~rows["method"].duplicated() & (rows["method"] != first.method), TOLD]
    return [row for row in tuples(fastest_of) if not is_slower(row, first)]


def _groups(rows: pd.DataFrame) -> list[pd.DataFrame]:
    """Return the rows of each group, in their order."""
    return [rows.take(places) for places in rows.groupby(derive.GROUP, sort=False).indices.values()]


def leaders(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the fastest row with every ray right of each group that has one, with two more columns.

    `tied` lists the rows of other methods that are not told to be slower, of each method its fastest. `methods` is
    the number of methods timed in the group.
    """
    rows = derive.contenders(frame, [*derive.GROUP, *TOLD, "wrong_rays"])
    methods = rows.groupby(derive.GROUP)["method"].nunique().rename("methods")
    right = rows[derive.all_right(rows)]
    groups = _groups(right)
    firsts = [best(own) for own in groups]
    found = pd.Series(
        [[str(row.variant) for row in _tied(own, first)] for own, first in zip(groups, firsts, strict=True)],
        [first.Index for first in firsts],
        dtype=object,
    )
    return frame.loc[found.index].assign(tied=found).join(methods, on=derive.GROUP)


def fastest(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the fastest row of each group, whether it answers every ray rightly or not."""
    rows = derive.contenders(frame, [*derive.GROUP, *TOLD])
    return frame.loc[[best(own).Index for own in _groups(rows)]]
