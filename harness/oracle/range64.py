"""First roots along many rays from ranges of f and of its slope in float64 balls: for what is not a polynomial.

**Theory.** A piece has no root where the range of f excludes 0, directly or by the mean value form
f(m) + f'(piece)·(piece − m); it has exactly one, a crossing, where the range of f' excludes 0 and f has opposite proved
signs at the ends. Where f is not defined the ranges are NaN, which proves nothing.
"""

from __future__ import annotations

import numpy as np

from harness.oracle import balls64
from harness.oracle.balls64 import GROW, TINY, Balls, Floats
from harness.oracle.clip import points_at
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.program import Program
from harness.oracle.segments import Pieces, Segments, Verdict, first_segments

DEPTH = 36


class RangeIsolator:
    """First roots of a function along rays."""

    def __init__(self, program: Program, constants: list[Balls]) -> None:
        self.program = program
        self.constants = constants
        self.duals = [Dual(c, Balls(0.0)) for c in constants]
        self.functions = dual_functions(balls64.FUNCTIONS)

    def __call__(self, rays: Floats, lower: Floats, upper: Floats) -> Segments:
        """The first segment of each ray between t = `lower` and `upper`, float64[n], finite."""
        whole = Pieces(np.arange(len(rays)), lower, upper)
        return first_segments(len(rays), whole, lambda pieces: self._judge(rays, pieces), _halve, DEPTH)

    def _value(self, rays: Floats, t: Floats) -> Balls:
        f: Balls = self.program.run(points_at(rays, t), self.constants, balls64.FUNCTIONS)
        return f

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
        whole: Dual = self.program.run(inputs, self.duals, self.functions)
        center = self.program.run(centers, self.constants, balls64.FUNCTIONS)
        shape = pieces.lower.shape
        slope = Balls(np.broadcast_to(whole.slope.mid, shape), np.broadcast_to(whole.slope.rad, shape))
        mean_value = center + slope * Balls(0.0, half)
        empty = np.broadcast_to(whole.value.excludes_zero, shape) | mean_value.excludes_zero
        single = np.zeros(shape, dtype=bool)
        rising = slope.mid > 0.0
        monotone = ~empty & slope.excludes_zero
        first = self._value(rays[monotone], pieces.lower[monotone]).sign
        last = self._value(rays[monotone], pieces.upper[monotone]).sign
        single[monotone] = first * last == -1
        empty[monotone] |= first * last == 1
        hopeless = (
            np.broadcast_to(~np.isfinite(center.rad), shape) | (middle <= pieces.lower) | (middle >= pieces.upper)
        )
        return Verdict(empty, single, rising, hopeless)


def _halve(pieces: Pieces) -> Pieces:
    middle = 0.5 * (pieces.lower + pieces.upper)
    return Pieces(
        np.concatenate((pieces.ray, pieces.ray)),
        np.concatenate((pieces.lower, middle)),
        np.concatenate((middle, pieces.upper)),
    )
