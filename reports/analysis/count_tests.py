"""Test whether one count of rays is larger than another, so that chance alone seldom decides a verdict.

Exact binomial tests: C. J. Clopper, E. S. Pearson, The use of confidence or fiducial limits illustrated in the case of
the binomial, 1934. For two counts: J. Przyborowski, H. Wilenski, Homogeneity of results in testing samples from Poisson
series, 1940. The rays of a picture are taken as drawn at random. Two methods' counts of the same rays are tested as
if the rays were different ones, which makes a test say "not told apart" too often rather than too seldom.
"""

from __future__ import annotations

import numpy as np

LEVEL = 0.01  # the chance of a wrong verdict, on each side
RULE = f"A count is more than another where an exact binomial test leaves a chance of at most {LEVEL:g}"


def at_least_by_chance(count: int, of: int, share: float) -> float:
    """Return the chance of at least `count` successes in `of` trials, each with the chance `share`, 0 < share < 1."""
    return _tail(count, of, share)


def at_most_by_chance(count: int, of: int, share: float) -> float:
    """Return the chance of at most `count` successes in `of` trials, each with the chance `share`, 0 < share < 1."""
    return _tail(of - count, of, 1.0 - share)


def _tail(count: int, of: int, share: float) -> float:
    """Return the chance of at least `count` successes in `of` trials, by the sum of the binomial distribution."""
    if count <= 0:
        return 1.0
    k = np.arange(of, dtype=np.float64)
    # logarithms of the chances of 1, 2, … successes over the chance of none
    logs = np.cumsum(np.log((of - k) / (k + 1.0)) + np.log(share / (1.0 - share)))
    return float(min(1.0, np.exp(logs[count - 1 :] + of * np.log1p(-share)).sum()))


def exceeds(count: int, of: int, other: int, of_other: int, factor: float = 1.0, tries: int = 1) -> bool | None:
    """Tell whether count / of is more than `factor` times other / of_other; None where the test decides neither way.

    `tries` is the number of pairs that this pair was chosen from; the level is divided by it.
    """
    if min(of, of_other) <= 0:
        return None
    share = factor * of / (factor * of + of_other)
    return _decided(count, count + other, share, LEVEL / tries)


def share_exceeds(count: int, of: int, limit: float) -> bool | None:
    """Tell whether more than the share `limit`, 0 < limit < 1, of rays like these `of` is counted.

    None where the test decides neither way.
    """
    return _decided(count, of, limit, LEVEL)


def _decided(count: int, of: int, share: float, level: float) -> bool | None:
    """Tell whether each of `of` trials succeeds with a chance above `share` (True) or below it (False).

    `count` is the number of successes. None where neither is proved at `level`.
    """
    if at_least_by_chance(count, of, share) <= level:
        return True
    return False if at_most_by_chance(count, of, share) <= level else None
