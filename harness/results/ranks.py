"""Test by ranks whether two sets of timings differ, whatever their distribution. Two-sided; ties share a rank.

Sources: F. Wilcoxon, Individual comparisons by ranking methods, 1945; H. B. Mann, D. R. Whitney, On a test of whether
one of two random variables is stochastically larger than the other, 1947; normal form with the correction for ties:
M. Hollander, D. A. Wolfe, Nonparametric Statistical Methods, 1973, sections 3.1 and 4.1.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

EXACT = 40  # observations up to which the exact distribution is used; the normal form differs by under 0.01 beyond


def signed_rank(differences: Sequence[float]) -> float:
    """Return the p-value of Wilcoxon's signed-rank test of paired differences, whose hypothesis is a median of 0.

    Zeros are left out; 1.0 where nothing is left.
    """
    values = np.array([d for d in differences if d != 0.0])
    if not len(values):
        return 1.0
    if len(values) <= EXACT and ((values > 0.0).all() or (values < 0.0).all()):
        return least_chance(len(values))
    ranks = _mid_ranks(np.abs(values))
    statistic = float(ranks[values > 0.0].sum())
    mean, variance = float(ranks.sum()) / 2.0, float((ranks**2).sum()) / 4.0
    if len(values) > EXACT:
        return _normal(statistic, mean, variance)
    doubled = np.rint(2.0 * ranks).astype(int)
    chances = np.zeros(int(doubled.sum()) + 1)
    chances[0] = 1.0
    for rank in doubled:
        chances[rank:] = 0.5 * (chances[rank:] + chances[: len(chances) - rank])
        chances[:rank] *= 0.5
    return _two_sided(chances, round(2.0 * statistic))


def least_chance(pairs: int) -> float:
    """Return the smallest p-value that signed_rank can give for `pairs` pairs: when one side leads in all of them."""
    return min(1.0, 2.0 ** (1 - pairs))


def pairs_needed(level: float) -> int:
    """Count the pairs that it takes until signed_rank can give a p-value of at most `level`, 0 < level <= 1."""
    return next(pairs for pairs in range(1, 1100) if least_chance(pairs) <= level)


def rank_sum(first: Sequence[float], second: Sequence[float]) -> float:
    """Return the p-value of the rank-sum test of Mann and Whitney, whose hypothesis is one distribution of both.

    1.0 where either is empty.
    """
    if not len(first) or not len(second):
        return 1.0
    ranks = _mid_ranks(np.array([*first, *second], np.float64))
    n, count = len(first), len(ranks)
    statistic = float(ranks[:n].sum())
    mean = n * (count + 1) / 2.0
    variance = n * (count - n) / count * float(((ranks - ranks.mean()) ** 2).sum()) / max(count - 1, 1)
    if count > EXACT:
        return _normal(statistic, mean, variance)
    doubled = np.rint(2.0 * ranks).astype(int)
    ways = np.zeros((n + 1, int(doubled.sum()) + 1))
    ways[0, 0] = 1.0
    for rank in doubled:
        ways[1:, rank:] += ways[:-1, : ways.shape[1] - rank].copy()
    return _two_sided(ways[n] / ways[n].sum(), round(2.0 * statistic))


def _mid_ranks(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the ranks float64[n] of n values, 1, 2, … by size; equal values share the mean of their ranks."""
    _, places, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts)
    shared: NDArray[np.float64] = (last - (counts - 1) / 2.0)[places]
    return shared


def _two_sided(chances: NDArray[np.float64], at: int) -> float:
    """Return the two-sided p-value of the outcome `at`; chances: float64[n], of each outcome 0, 1, …."""
    return min(1.0, 2.0 * min(float(chances[: at + 1].sum()), float(chances[at:].sum())))


def _normal(statistic: float, mean: float, variance: float) -> float:
    """Return the two-sided p-value by the normal distribution, with the correction for continuity."""
    if variance == 0.0:
        return 1.0
    away = max(abs(statistic - mean) - 0.5, 0.0) / math.sqrt(variance)
    return math.erfc(away / math.sqrt(2.0))
