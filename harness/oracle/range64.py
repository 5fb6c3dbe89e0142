"""First roots along many rays from ranges of f and of its slope in float64 balls: for what is not a polynomial.

**Theory.** A piece has no root where the range of f excludes 0, directly or by the mean value form
f(m) + f'(piece)·(piece − m); it has exactly one, a crossing, where the range of f' excludes 0 and f has opposite proved
signs at the ends. Where f is not defined the ranges are NaN, which proves nothing.
"""

from __future__ import annotations

import numpy as np

from harness.oracle.balls64 import GROW, TINY, Balls, Floats
from harness.oracle.clip import points_at
from harness.oracle.dual import Dual
from harness.oracle.enclosure import Enclosure
from harness.oracle.segments import Pieces, Segments, Verdict, first_segments

DEPTH = 36


class RangeIsolator:
    """First roots of a function along rays."""

    def __init__(self, f: Enclosure) -> None:
        self.f = f

    def __call__(self, rays: Floats, lower: Floats, upper: Floats) -> Segments:
        """The first segment of each ray between t = `lower` and `upper`, float64[n], finite."""
        whole = Pieces(np.arange(len(rays)), lower, upper)
        return first_segments(len(rays), whole, lambda pieces: self._judge(rays, pieces), _halve, DEPTH)

    def _judge(self, rays: Floats, pieces: Pieces) -> Verdict:
        rays = rays[pieces.ray]
        middle = 0.5 * (pieces.lower + pieces.upper)
        # at least the distance from `middle`, wherever rounding put it, to the farther end
        half = np.maximum(middle - pieces.lower, pieces.upper - middle) * GROW
        centers = points_at(rays, middle)
        inputs = [
            Dual(Balls(p.mid, (p.rad + half * np.abs(rays[:, 3 + k])) * GROW + TINY), Balls(rays[:, 3 + k]))
            for k, p in enumerate(centers)
        ]
        whole = self.f.slopes(inputs)
        slope = whole.slope
        mean_value = self.f.of(centers) + slope * Balls(0.0, half)
        empty = whole.value.excludes_zero | mean_value.excludes_zero
        single = np.zeros_like(empty)
        rising = slope.mid > 0.0
        monotone = ~empty & slope.excludes_zero
        first = self.f.along(rays[monotone], pieces.lower[monotone]).sign
        last = self.f.along(rays[monotone], pieces.upper[monotone]).sign
        single[monotone] = first * last == -1
        empty[monotone] |= first * last == 1
        return Verdict(empty, single, rising, (middle <= pieces.lower) | (middle >= pieces.upper))


def _halve(pieces: Pieces) -> Pieces:
    """A little off the middle, where roots of tidy formulas on tidy rays would lie."""
    middle = pieces.lower + 0.4917 * (pieces.upper - pieces.lower)
    return Pieces(
        np.concatenate((pieces.ray, pieces.ray)),
        np.concatenate((pieces.lower, middle)),
        np.concatenate((middle, pieces.upper)),
    )
