"""One row's time over another's, in the rounds that timed both.

A row ends its rounds when its interval is narrow. What slows the machine down later is then in the other rows' medians
alone, so that medians of different rounds make no ratio.
"""

from __future__ import annotations

import json
import math
from typing import Any

import pandas as pd

from harness.results import timings
from harness.results.timings import Ratio
from reports import wording

COLUMNS = ["session", "rounds", "samples_ms"]


def ratio(row: Any, other: Any) -> Ratio | None:
    """`row`'s time over `other`'s, round by round; None unless both were timed in one interleaved run."""
    if wording.absent(row.session) or row.session != other.session:
        return None
    if any(wording.absent(one.rounds) or not one.samples_ms for one in (row, other)):
        return None
    return timings.paired_ratio(row.samples_ms, json.loads(row.rounds), other.samples_ms, json.loads(other.rounds))


def times_over(row: Any, other: Any) -> float:
    """`row`'s time over `other`'s: the median over the rounds that timed both; NaN where none did."""
    paired = ratio(row, other)
    return math.nan if paired is None else paired.median


def ratios(both: pd.DataFrame, suffix: str) -> list[Ratio | None]:
    """Compute for each line of `both` the time of the row in the columns that end in `suffix` over the other row's."""
    other = both[[f"{name}{suffix}" for name in COLUMNS]].set_axis(COLUMNS, axis=1)
    return [ratio(a, b) for a, b in zip(other.itertuples(), both[COLUMNS].itertuples(), strict=True)]


def above(row: Any, other: Any) -> float:
    """Compute how many ms longer `row` takes than `other`: the median over the rounds that timed both, or NaN."""
    if ratio(row, other) is None:
        return math.nan
    others = dict(zip(json.loads(other.rounds), other.samples_ms, strict=True))
    own = zip(json.loads(row.rounds), row.samples_ms, strict=True)
    return timings.median_interval([ms - others[at] for at, ms in own if at in others])[0]


def over_first(rows: pd.DataFrame, firsts: pd.DataFrame, keys: list[str]) -> pd.Series:
    """The time of the row of `firsts` with the same `keys` over each of `rows`, by their index; NaN without one that
    shares a round."""
    told = [*keys, *COLUMNS]
    by_key = {tuple(getattr(row, key) for key in keys): row for row in firsts[told].itertuples()}
    found = {}
    for row in rows.loc[rows["median_ms"].notna(), told].itertuples():
        first = by_key.get(tuple(getattr(row, key) for key in keys))
        if first is not None:
            found[row.Index] = times_over(first, row)
    return pd.Series(found, dtype="float64").reindex(rows.index)
