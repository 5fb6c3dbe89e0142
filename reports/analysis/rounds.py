"""Compare the times of two rows in the rounds that timed both.

A row's rounds end when its interval is narrow. What slows the machine down after that is in the other rows' medians
alone. So a ratio is never made of two medians over different rounds.
"""

from __future__ import annotations

import json
import math
from array import array
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from harness.results import timings
from harness.results.timings import Ratio
from reports import wording
from reports.reading.tuples import tuples

COLUMNS = ["session", "rounds", "samples_ms"]
CLOCKS = ["clock", "overhead_share"]
_RATIO = ["ratio", "ratio_low", "ratio_high"]


def ratio(row: Any, other: Any) -> Ratio | None:
    """Return `row`'s time over `other`'s, round by round; None unless both were timed in the rounds of one run."""
    if not _in_one_run(row, other):
        return None
    return timings.paired_ratio(row.samples_ms, json.loads(row.rounds), other.samples_ms, json.loads(other.rounds))


def _in_one_run(row: Any, other: Any) -> bool:
    """Tell whether two rows were timed in the rounds of one run, of which they may have none in common."""
    if wording.absent(row.session) or row.session != other.session:
        return False
    return not any(wording.absent(one.rounds) or not one.samples_ms for one in (row, other))


def times_over(row: Any, other: Any) -> float:
    """Return the median of `row`'s time over `other`'s in the rounds that timed both; NaN where no round did."""
    paired = ratio(row, other)
    return math.nan if paired is None else paired.median


def times_elsewhere(row: Any, other: Any) -> float:
    """Do what `times_over` does for rows of two devices, by one clock: the host's, where theirs are different.

    The rows have the columns CLOCKS too. NaN where it is not known what the host's clock told.
    """
    ratio_of_times = times_over(row, other)
    return ratio_of_times if row.clock == other.clock else ratio_of_times * on_host(row) / on_host(other)


def on_host(row: Any) -> float:
    """Return the factor that makes a row's time one by the host's clock: 1, or what submitting and waiting add."""
    if row.clock != "device":
        return 1.0
    return math.nan if wording.absent(row.overhead_share) else 1.0 + float(row.overhead_share)


def medians_over(rows: pd.DataFrame, first: Any) -> NDArray[np.float64]:
    """Return the median of each row's time over that of `first`, for rows with the same rounds of the same run.

    Returns float64[n]; NaN for the others, of which nothing is told.
    """
    found = np.full(len(rows), math.nan)
    alike, own = _alike(rows, first)
    if len(alike):
        found[alike] = np.median(own / np.array(first.samples_ms, np.float64), axis=1)
    return found


def maybe_faster(rows: pd.DataFrame, first: Any) -> NDArray[np.bool_]:
    """Tell which rows may be faster than `first`: all but those whose median of `medians_over` is 1 or more."""
    found = np.ones(len(rows), bool)
    alike, own = _alike(rows, first)
    if len(alike):
        times = np.array(first.samples_ms, np.float64)
        open_ = (own < times).sum(axis=1) > (len(times) - 1) // 2  # the middle ratios of all others are 1 or more
        found[alike] = False
        found[alike[open_]] = ~(np.median(own[open_] / times, axis=1) >= 1.0)
    return found


def _alike(rows: pd.DataFrame, first: Any) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Return the places of the k rows with the same rounds of the same run as `first`, and their times [k, rounds]."""
    nothing = np.empty(0, np.intp), np.empty((0, 0))
    if wording.absent(first.session) or wording.absent(first.rounds) or not first.samples_ms:
        return nothing
    session, rounds, samples = (rows[name].to_numpy() for name in COLUMNS)
    same = np.flatnonzero((session == first.session) & (rounds == first.rounds))
    alike = [at for at in same.tolist() if samples[at]]
    return (np.array(alike, np.intp), _times([samples[at] for at in alike])) if alike else nothing


def _times(samples: Sequence[Sequence[float]]) -> NDArray[np.float64]:
    """Return rows' times as float64[n, rounds]; all have as many."""
    if all(isinstance(own, array) for own in samples):  # as reports of many rows hold them
        return np.frombuffer(b"".join(samples), np.float64).reshape(len(samples), -1)  # type: ignore[arg-type]
    return np.array(samples, np.float64)


def ratios(both: pd.DataFrame, suffix: str) -> list[Ratio | None]:
    """Return for each line of `both`, a join of two rows, the time of the one row over the time of the other.

    The columns of the dividend end in `suffix`, those of the divisor have no ending. None stands for a pair that was
    not timed in the rounds of one run.
    """
    other = both[[f"{name}{suffix}" for name in COLUMNS]].set_axis(COLUMNS, axis=1)
    return [ratio(a, b) for a, b in zip(tuples(other), tuples(both[COLUMNS]), strict=True)]


def above(row: Any, other: Any) -> float:
    """Return by how many ms `row` takes longer than `other`: the median over their common rounds, NaN without any."""
    pairs = list(zip(*common(row, other), strict=True)) if _in_one_run(row, other) else []
    return timings.median_interval([a - b for a, b in pairs])[0] if pairs else math.nan


def common(row: Any, other: Any) -> tuple[list[float], list[float]]:
    """Return the times in ms of `row` and of `other` in the rounds that timed both, of which `ratio` tells whether.

    Both were timed in the rounds of one run.
    """
    others = dict(zip(json.loads(other.rounds), other.samples_ms, strict=True))
    own = zip(json.loads(row.rounds), row.samples_ms, strict=True)
    pairs = [(ms, others[at]) for at, ms in own if at in others]
    return [a for a, _ in pairs], [b for _, b in pairs]


def over_first(rows: pd.DataFrame, firsts: pd.DataFrame, keys: list[str]) -> pd.Series:
    """Return for each of `rows` the time of the row of `firsts` with the same `keys` over its own.

    The result has the index of `rows`; NaN where `firsts` has no such row or shares no round with it.
    """
    timed = rows.loc[rows["median_ms"].notna()]
    return _to_first(timed, firsts, keys, lambda own, first: first / own, times_over).reindex(rows.index)


def above_first(rows: pd.DataFrame, firsts: pd.DataFrame, keys: list[str]) -> pd.Series:
    """Return by how many ms each of `rows` takes longer than the row of `firsts` with the same `keys`, as `above`.

    The result has the index of `rows`; NaN where `firsts` has no such row or shares no round with it.
    """
    return _to_first(rows, firsts, keys, lambda own, first: own - first, lambda first, row: above(row, first)).reindex(
        rows.index
    )


def _to_first(
    rows: pd.DataFrame,
    firsts: pd.DataFrame,
    keys: list[str],
    together: Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]],
    alone: Callable[[Any, Any], float],
) -> pd.Series:
    """Compare each of `rows` with the row of `firsts` with the same `keys`; rows without one are left out.

    Rows that have all their rounds in common with it are compared at once, by the median of what `together` makes of
    the times of rows [n, rounds] and of the first one [rounds]. The others are compared by `alone`, of the first row
    and the other one.
    """
    told = [*keys, *COLUMNS]
    by_key = {tuple(getattr(row, key) for key in keys): row for row in tuples(firsts[told])}
    found = pd.Series(math.nan, rows.index, dtype="float64")
    if rows.empty:
        return found
    values = found.to_numpy(copy=True)
    session, rounds, samples = (rows[name].to_numpy() for name in COLUMNS)
    for key, places in rows.groupby(keys, sort=False).indices.items():
        first = by_key.get(key)
        if first is None or wording.absent(first.session) or wording.absent(first.rounds) or not first.samples_ms:
            continue
        alike = [at for at in places if rounds[at] == first.rounds and session[at] == first.session and samples[at]]
        if alike:
            own = _times([samples[at] for at in alike])
            values[alike] = np.median(together(own, np.array(first.samples_ms, np.float64)), axis=1)
        others = sorted(set(places.tolist()).difference(alike))
        for at, row in zip(others, tuples(rows[told].take(others)), strict=True) if others else ():
            values[at] = alone(first, row)
    return pd.Series(values, rows.index)


def over(slow: pd.DataFrame, fast: pd.DataFrame, keys: list[str]) -> pd.DataFrame:
    """Divide the times of the rows `slow` by those of the rows `fast` with the same `keys`.

    Returns the columns of `fast`; `ratio`, the median over the common rounds, with its 95 % interval from `ratio_low`
    to `ratio_high` (NaN where there are too few common rounds for one); `slow_ms`, `fast_ms` and `key_slow`. Pairs
    without a common round are left out. All rows given are timed ones.
    """
    if slow.empty or fast.empty:  # a join of nothing takes as long as one of some rows
        nothing = {name: pd.Series(dtype="float64") for name in _RATIO}
        named = (("slow_ms", slow["median_ms"]), ("fast_ms", fast["median_ms"]), ("key_slow", slow["key"]))
        nothing |= {name: own.head(0).reset_index(drop=True) for name, own in named}
        return fast.head(0).reset_index(drop=True).assign(**nothing)
    told = [*keys, "key", "median_ms", *COLUMNS]
    both = fast[told].assign(at=range(len(fast))).merge(slow[told], on=keys, suffixes=("", "_slow"))
    paired = ratios(both, "_slow")
    both = both.take([at for at, one in enumerate(paired) if one is not None])
    held = [one for one in paired if one is not None]
    ends = [(one.lower, one.upper) if one.proved else (math.nan, math.nan) for one in held]
    divided = pd.DataFrame(ends, columns=_RATIO[1:], dtype="float64")
    divided.insert(0, _RATIO[0], pd.Series([one.median for one in held], dtype="float64"))
    for name, of in (("slow_ms", "median_ms_slow"), ("fast_ms", "median_ms"), ("key_slow", "key_slow")):
        divided[name] = both[of].array
    return fast.take(both["at"].to_numpy()).reset_index(drop=True).join(divided)


def proved(samples: pd.Series) -> pd.Series:
    """Tell for each list of times whether it is long enough for an interval of its median.

    Returns bool with the index of `samples`.
    """
    return samples.map(lambda own: timings.proves(len(own or ()))).astype(bool)
