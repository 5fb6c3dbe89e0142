"""Compute what timings say: the median with its interval, drift, noise, and one variant's time over another's.

Two intervals stand beside each other. The order-statistic interval assumes nothing of the distribution, and from 6
samples on it covers the median at least 95 times in 100: it decides. The bootstrap interval is what papers print. With
few samples it covers the median less often than it says (at 8 samples 90 times in 100, tests/test_measure.py), and it
decides nothing.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

from harness.results import ranks

CONFIDENCE = 0.95
RESAMPLES = 2000
DRIFT_SHARE = 0.03  # a change between the halves smaller than this is no drift worth a warning
DRIFT_CHANCE = 0.05  # nor one that chance makes this often
NOISE_SHARE = 0.1  # the middle half of the samples spread over more than this share of the median is noise
CLOCKS_AGREE = 1.05  # a device that tells more than so many times what passed on the host's clock is not believed
FENCE = 3.0  # an outlier lies so many quartile ranges outside the quartiles (Tukey, Exploratory Data Analysis, 1977)


@cache
def _rank(count: int) -> int | None:
    """Find the largest k for which the k-th smallest and k-th largest of `count` samples hold the median at CONFIDENCE.

    None where there is no such k.
    """
    tail, k = 0.0, 0
    while True:
        tail += math.exp(math.lgamma(count + 1) - math.lgamma(k + 1) - math.lgamma(count - k + 1) - count * math.log(2))
        if 2.0 * tail > 1.0 - CONFIDENCE:
            return k or None
        k += 1


def median_interval(samples: Sequence[float]) -> tuple[float, float, float, bool]:
    """Return (median, lower, upper, proved): the median and its 95 % order-statistic interval, in the samples' unit.

    Of fewer than 6 samples there is none: then the extremes are returned and `proved` is False. Raises ValueError for
    no samples.
    """
    if not samples:
        raise ValueError("no samples")
    ordered, count = sorted(samples), len(samples)
    median = 0.5 * (ordered[(count - 1) // 2] + ordered[count // 2])
    rank = _rank(count)
    if rank is None:
        return median, ordered[0], ordered[-1], False
    return median, ordered[rank - 1], ordered[count - rank], True


def bootstrap_interval(samples: Sequence[float], seed: int) -> tuple[float, float]:
    """Return (lower, upper): the 95 % percentile-bootstrap interval of the median, the same for the same seed.

    Source: B. Efron, Bootstrap methods: another look at the jackknife, 1979. Raises ValueError for no samples.
    """
    if not samples:
        raise ValueError("no samples")
    drawn = np.random.default_rng(seed).choice(np.asarray(samples), (RESAMPLES, len(samples)))
    lower, upper = np.quantile(np.median(drawn, axis=1), (0.5 - CONFIDENCE / 2, 0.5 + CONFIDENCE / 2))
    return float(lower), float(upper)


def is_narrow(samples: Sequence[float], share: float) -> bool:
    """Tell whether the 95 % interval of the median exists and lies within ± `share` of it."""
    if not samples:
        return False
    median, lower, upper, proved = median_interval(samples)
    return proved and max(upper - median, median - lower) <= share * median


def proves(count: int) -> bool:
    """Tell whether `count` samples are enough for a 95 % interval of their median."""
    return count > 0 and _rank(count) is not None


def overhead(wall_ms: Sequence[float], device_ms: Sequence[float]) -> float | None:
    """Return what the host's clock tells beyond the device's, as a share of the latter: the median over the samples.

    None where there is no device time for each sample, where one is not positive, or where the device tells more than
    passed on the host. A device that tells up to CLOCKS_AGREE times as much has an overhead of 0: so far clocks err.
    """
    if not wall_ms or len(wall_ms) != len(device_ms) or min(device_ms) <= 0.0:
        return None
    ratio = float(np.median(np.array(wall_ms) / np.array(device_ms)))
    return max(0.0, ratio - 1.0) if ratio >= 1.0 / CLOCKS_AGREE else None


def steadiness(samples: Sequence[float]) -> dict[str, Any]:
    """Describe drift, noise and outliers of samples, which are in the order in which they were taken; JSON-able.

    `drift_share`: the second half's median over the first's, less 1; `drift_chance`: how often chance alone parts the
    halves so (rank_sum); `spread_share`: the quartile range over the median; `outliers`: how many lie more than FENCE
    quartile ranges outside the quartiles (they are kept); `warnings`: what to do about it, a sentence each. Shares are
    None under 4 samples, where nothing can be said.
    """
    if len(samples) < 4:
        return {"drift_share": None, "drift_chance": None, "spread_share": None, "outliers": 0, "warnings": []}
    half = len(samples) // 2
    drift = float(np.median(samples[-half:]) / np.median(samples[:half])) - 1.0
    chance = ranks.rank_sum(samples[:half], samples[-half:])
    low, middle, high = (float(q) for q in np.quantile(samples, (0.25, 0.5, 0.75)))
    spread, reach = (high - low) / middle, FENCE * (high - low)
    warnings = []
    if abs(drift) > DRIFT_SHARE and chance <= DRIFT_CHANCE:
        way = "slower" if drift > 0.0 else "faster"
        warnings.append(
            f"drifts: the second half is {abs(drift):.0%} {way} than the first; let the machine settle (heat, power "
            "saving, other programs), raise [budget] seconds, and run again with --force"
        )
    if spread > NOISE_SHARE:
        warnings.append(
            f"noisy: the middle half of the times spreads over {spread:.0%} of the median; end other programs or use "
            "an idle machine, raise [budget] seconds, and run again with --force"
        )
    return {
        "drift_share": drift,
        "drift_chance": chance,
        "spread_share": spread,
        "outliers": sum(not low - reach <= sample <= high + reach for sample in samples),
        "warnings": warnings,
    }


def sitting_warnings(samples: Sequence[float], sittings: Sequence[int]) -> list[str]:
    """Warn, a sentence each, where a run that was stopped and taken up again gave other times afterwards.

    `sittings` are the numbers of samples that each part of the run took, in order. Two parts differ where their medians
    do by more than DRIFT_SHARE and by more than the middle half of either spreads over.
    """
    warnings, start = [], 0
    for before, after in pairwise(sittings):
        first, second = samples[start : start + before], samples[start + before : start + before + after]
        start += before
        change = float(np.median(second) / np.median(first)) - 1.0
        spread = max(float(np.subtract(*np.quantile(part, (0.75, 0.25)))) for part in (first, second))
        if abs(change) > DRIFT_SHARE and abs(change) * float(np.median(first)) > spread:
            way = "slower" if change > 0.0 else "faster"
            warnings.append(
                f"sittings differ: it is {abs(change):.0%} {way} after the run was stopped and taken up again; "
                "something on the machine has changed: run again with --force"
            )
    return warnings


@dataclass(frozen=True)
class Ratio:
    """Hold one variant's time over another's, from `pairs` rounds that timed both; `proved` as in median_interval.

    `chance` is how often chance alone parts equally fast variants so (signed_rank of the logarithms).
    """

    median: float
    lower: float
    upper: float
    proved: bool
    chance: float
    pairs: int


def paired_ratio(
    times: Sequence[float], rounds: Sequence[int], others: Sequence[float], other_rounds: Sequence[int]
) -> Ratio | None:
    """Divide `times` by `others` round by round, so that what slows a whole round cancels.

    `rounds` and `other_rounds` number the round of each time; only rounds of one interleaved run may be paired. None
    without a common round.
    """
    by_round = dict(zip(other_rounds, others, strict=True))
    pairs = [(time, by_round[at]) for time, at in zip(times, rounds, strict=True) if at in by_round]
    if not pairs:
        return None
    median, lower, upper, proved = median_interval([a / b for a, b in pairs])
    chance = ranks.signed_rank([math.log(a / b) for a, b in pairs])
    return Ratio(median, lower, upper, proved, chance, len(pairs))
