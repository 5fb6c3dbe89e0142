"""Cut many rays at once into pieces that are proved to hold no root or exactly one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.oracle.balls64 import Floats

Mask = NDArray[np.bool_]
MOST_PIECES = 64  # of one ray on one level of halving; a ray that needs more stays undecided


@dataclass(frozen=True)
class Segments:
    """Hold for each ray the first segment that is proved to hold exactly one root, a crossing; all arrays are [n]."""

    lower: Floats  # inside the segment, at or behind its lower end; NaN where not found
    upper: Floats
    rising: Mask  # f < 0 at the lower end, f > 0 at the upper end
    found: Mask  # it is proved that there is one root in (lower, upper), and none before
    empty: Mask  # it is proved that there is no root at all

    def take(self, mask: Mask) -> Segments:
        """Return the segments of the rays in `mask`."""
        return Segments(self.lower[mask], self.upper[mask], self.rising[mask], self.found[mask], self.empty[mask])


@dataclass(frozen=True)
class Pieces:
    """Hold p intervals [lower, upper] of rays numbered `ray`, with data of the isolator; all arrays are [p, ...]."""

    ray: NDArray[np.intp]
    lower: Floats
    upper: Floats
    data: tuple[Floats, ...] = ()

    def take(self, mask: Mask) -> Pieces:
        """Return the pieces in `mask`."""
        return Pieces(self.ray[mask], self.lower[mask], self.upper[mask], tuple(d[mask] for d in self.data))


@dataclass(frozen=True)
class Verdict:
    """Hold what is proved about p pieces; all arrays are [p]. Where all are false, cutting the piece may help."""

    empty: Mask  # there is no root in the closed piece
    single: Mask  # there is exactly one root, strictly inside, with opposite signs of f at the ends
    rising: Mask  # f grows through the root of a single piece
    hopeless: Mask  # cutting the piece cannot help


def first_segments(
    count: int, pieces: Pieces, judge: Callable[[Pieces], Verdict], halve: Callable[[Pieces], Pieces], depth: int
) -> Segments:
    """Judge and halve the pieces of `count` rays level by level, at most `depth` times, and return the first segments.

    Pieces behind a segment already found are dropped. A ray with an undecided piece before its first segment, or
    anywhere if no segment is found, is neither `found` nor `empty`.
    """
    lower, upper = np.full(count, np.inf), np.full(count, np.nan)
    unresolved = np.full(count, np.inf)
    rising = np.zeros(count, dtype=bool)
    for level in range(depth + 1):
        verdict = judge(pieces)
        single = pieces.take(verdict.single)
        np.minimum.at(lower, single.ray, single.lower)
        first = single.lower == lower[single.ray]
        upper[single.ray[first]] = single.upper[first]
        rising[single.ray[first]] = verdict.rising[verdict.single][first]
        open_ = ~verdict.empty & ~verdict.single & (pieces.lower < lower[pieces.ray])
        crowded = np.bincount(pieces.ray[open_], minlength=count) > MOST_PIECES
        given_up = open_ & (verdict.hopeless | crowded[pieces.ray] | (level == depth))
        np.minimum.at(unresolved, pieces.ray[given_up], pieces.lower[given_up])
        pieces = pieces.take(open_ & ~given_up)
        if not len(pieces.ray):
            break
        pieces = halve(pieces)
    found = lower < unresolved
    empty = np.isinf(lower) & np.isinf(unresolved)
    return Segments(np.where(found, lower, np.nan), np.where(found, upper, np.nan), rising & found, found, empty)
