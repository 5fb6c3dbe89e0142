"""What repeated timings say: the median and an interval for it that assumes nothing about their distribution."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache

CONFIDENCE = 0.95


@cache
def _rank(count: int) -> int | None:
    """The largest k so that the k-th smallest and k-th largest of `count` samples enclose the median at CONFIDENCE."""
    tail, k = 0.0, 0
    while True:
        tail += math.comb(count, k) * 0.5**count
        if 2.0 * tail > 1.0 - CONFIDENCE:
            return k or None
        k += 1


def median_interval(samples: Sequence[float]) -> tuple[float, float, float, bool]:
    """(median, lower, upper, proved): the 95 % order-statistic interval of the median.

    Under 6 samples none exists: then the extremes are given and `proved` is False. Raises ValueError for no samples.
    """
    if not samples:
        raise ValueError("no samples")
    ordered, count = sorted(samples), len(samples)
    median = 0.5 * (ordered[(count - 1) // 2] + ordered[count // 2])
    rank = _rank(count)
    if rank is None:
        return median, ordered[0], ordered[-1], False
    return median, ordered[rank - 1], ordered[count - rank], True


def is_narrow(samples: Sequence[float], share: float) -> bool:
    """Whether the 95 % interval of the median lies within ± `share` of it."""
    if not samples:
        return False
    median, lower, upper, proved = median_interval(samples)
    return proved and max(upper - median, median - lower) <= share * median
