"""When a count of rays says more than another one: exact tests, so that two rays of thousands decide nothing.

Sources: C. J. Clopper, E. S. Pearson, The use of confidence or fiducial limits illustrated in the case of the binomial,
1934; two counts: J. Przyborowski, H. Wilenski, Homogeneity of results in testing samples from Poisson series, 1940.
Rays of one picture are taken as drawn at random. Counts of the same rays by two methods are tested as if of different
ones, which errs to the side of not telling them apart.
"""

from __future__ import annotations

import numpy as np

LEVEL = 0.01  # a verdict is wrong at most this often by chance, on either side
RULE = f"A count is more than another where an exact binomial test leaves a chance of at most {LEVEL:g}"


def at_least_by_chance(count: int, of: int, share: float) -> float:
    """The chance of `count` or more of `of`, where each has the chance `share`, 0 < share < 1."""
    return _tail(count, of, share)


def at_most_by_chance(count: int, of: int, share: float) -> float:
    """The chance of `count` or fewer of `of`, where each has the chance `share`, 0 < share < 1."""
    return _tail(of - count, of, 1.0 - share)


def _tail(count: int, of: int, share: float) -> float:
    if count <= 0:
        return 1.0
    k = np.arange(of, dtype=np.float64)
    logs = np.cumsum(np.log((of - k) / (k + 1.0)) + np.log(share / (1.0 - share)))  # of 1, 2, … over that of none
    return float(min(1.0, np.exp(logs[count - 1 :] + of * np.log1p(-share)).sum()))


def exceeds(count: int, of: int, other: int, of_other: int, factor: float = 1.0, tries: int = 1) -> bool | None:
    """Whether count / of is more than `factor` times other / of_other: True, False, or None where no test tells.

    `tries`: how many such pairs this one was picked from; the level is divided by it.
    """
    if min(of, of_other) <= 0:
        return None
    share = factor * of / (factor * of + of_other)
    return _told(count, count + other, share, LEVEL / tries)


def share_exceeds(count: int, of: int, limit: float) -> bool | None:
    """Whether more than the share `limit`, 0 < limit < 1, of such rays are counted; None where no test tells."""
    return _told(count, of, limit, LEVEL)


def _told(count: int, of: int, share: float, level: float) -> bool | None:
    if at_least_by_chance(count, of, share) <= level:
        return True
    return False if at_most_by_chance(count, of, share) <= level else None
