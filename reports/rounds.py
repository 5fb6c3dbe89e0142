"""One row's time over another's, in the rounds that timed both.

A row ends its rounds when its interval is narrow. What slows the machine down later is then in the other rows' medians
alone, so that medians of different rounds make no ratio.
"""

from __future__ import annotations

import json
from typing import Any

import pandas as pd

from harness import measure
from harness.measure import Ratio
from reports import wording

COLUMNS = ["session", "rounds", "samples_ms"]


def ratio(row: Any, other: Any) -> Ratio | None:
    """`row`'s time over `other`'s, round by round; None unless both were timed in one interleaved run."""
    if wording.absent(row.session) or row.session != other.session:
        return None
    if any(wording.absent(one.rounds) or not one.samples_ms for one in (row, other)):
        return None
    return measure.paired_ratio(row.samples_ms, json.loads(row.rounds), other.samples_ms, json.loads(other.rounds))


def times_over(row: Any, other: Any) -> float:
    """`row`'s time over `other`'s: the median of the rounds that timed both, or of too few such rounds the medians'."""
    paired = ratio(row, other)
    if paired is not None and paired.proved:
        return paired.median
    return float(row.median_ms / other.median_ms)


def over_first(rows: pd.DataFrame, firsts: pd.DataFrame, keys: list[str]) -> pd.Series:
    """The time of the row of `firsts` with the same `keys` over each of `rows`, by their index; NaN without one."""
    told = [*keys, *COLUMNS, "median_ms"]
    by_key = {tuple(getattr(row, key) for key in keys): row for row in firsts[told].itertuples()}
    found = {}
    for row in rows.loc[rows["median_ms"].notna(), told].itertuples():
        first = by_key.get(tuple(getattr(row, key) for key in keys))
        if first is not None:
            found[row.Index] = times_over(first, row)
    return pd.Series(found, dtype="float64").reindex(rows.index)
