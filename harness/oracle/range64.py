"""Isolate first roots along many rays by ranges of f and its slope in float64 balls, if f is no polynomial.

**Theory.** A piece has no root if the range of f excludes 0, directly or by the mean value form
f(m) + f'(piece)·(piece − m). It has exactly one root, a crossing, if the range of f' excludes 0 and f has opposite
proved signs at the ends. Where f is not defined, and in slopes where f may jump, ranges are NaN, which proves nothing.
A piece in which f may jump has no root if f is off 0 on all sides (`jumps`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.oracle import balls64
from harness.oracle.balls64 import GROW, TINY, Balls, Floats
from harness.oracle.branches import Branch
from harness.oracle.clip import points_at
from harness.oracle.dual import Dual
from harness.oracle.enclosure import Enclosure
from harness.oracle.jumps import Sided64, sides
from harness.oracle.segments import Pieces, Segments, Verdict, first_segments

DEPTH = 36


class RangeIsolator:
    """Isolate the first roots of a function along rays."""

    def __init__(self, f: Enclosure) -> None:
        self.f = f
        self.jumps = f.program.jumps
        self.kinks = any(i.name in ("abs", "min", "max", "length") for i in f.program.instructions)

    def __call__(self, rays: Floats, lower: Floats, upper: Floats) -> Segments:
        """Return the first segment of each ray between t = `lower` and `upper`, both float64[n] and finite."""
        whole = Pieces(np.arange(len(rays)), lower, upper)
        return first_segments(len(rays), whole, lambda pieces: self._judge(rays, pieces), _halve, DEPTH)

    def _judge(self, rays: Floats, pieces: Pieces) -> Verdict:
        """Return what ranges of f and its slope prove."""
        rays = rays[pieces.ray]
        middle = 0.5 * (pieces.lower + pieces.upper)
        # at least the distance from the rounded `middle` to the farther end
        half = np.maximum(middle - pieces.lower, pieces.upper - middle) * GROW
        centers = points_at(rays, middle)
        inputs = [
            Dual(Balls(p.mid, (p.rad + half * np.abs(rays[:, 3 + k])) * GROW + TINY), Balls(rays[:, 3 + k]))
            for k, p in enumerate(centers)
        ]
        whole = self.f.slopes(inputs)
        slope = self._narrowed(whole, inputs)
        mean_value = self.f.of(centers) + slope * Balls(0.0, half)
        empty = whole.value.excludes_zero | mean_value.excludes_zero
        if self.jumps:
            open_ = np.flatnonzero(~empty & ~np.isfinite(slope.rad))
            empty[open_] = self._off_zero_on_all_sides([_rows(i.value, open_) for i in inputs])
        single = np.zeros_like(empty)
        rising = slope.mid > 0.0
        monotone = ~empty & slope.excludes_zero
        first = self.f.along(rays[monotone], pieces.lower[monotone]).sign
        last = self.f.along(rays[monotone], pieces.upper[monotone]).sign
        single[monotone] = first * last == -1
        empty[monotone] |= first * last == 1
        return Verdict(empty, single, rising, (middle <= pieces.lower) | (middle >= pieces.upper))

    def _off_zero_on_all_sides(self, points: list[Balls]) -> NDArray[np.bool_]:
        """Return bool[p]: whether f is proved to be off 0 on all sides of the jumps that are open on p pieces."""
        shape = np.shape(points[0].mid)
        proved = np.ones(shape, dtype=bool)
        for chosen in sides() if len(proved) else ():
            f = self.f.program.run(points, self.f.constants, Sided64(chosen, shape).functions())
            proved &= np.broadcast_to(f.excludes_zero, shape)
        return proved

    def _narrowed(self, whole: Dual, inputs: list[Dual]) -> Balls:
        """Enclose the slopes of f on p pieces, balls [p].

        Where all kinks together leave the slope's sign open, the two sides of a kink are enclosed separately.
        """
        slope: Balls = whole.slope
        open_ = (
            np.flatnonzero(~whole.value.excludes_zero & ~slope.excludes_zero) if self.kinks else np.empty(0, np.intp)
        )
        if not len(open_):
            return slope
        some = [Dual(_rows(i.value, open_), _rows(i.slope, open_)) for i in inputs]
        sides = [self.f.slopes(some, Branch(side, open_.shape).functions()).slope for side in (1, -1)]
        lower, upper = np.minimum(sides[0].lower, sides[1].lower), np.maximum(sides[0].upper, sides[1].upper)
        both = balls64.hull(lower, upper)
        mid, rad = slope.mid.copy(), slope.rad.copy()
        mid[open_], rad[open_] = both.mid, both.rad
        return Balls(mid, rad)


def _rows(balls: Balls, rows: NDArray[np.intp]) -> Balls:
    """Return the balls [k] of the rows int[k], from balls [n] whose radius may be one number for all."""
    return Balls(balls.mid[rows], balls.rad[rows] if np.ndim(balls.rad) else balls.rad)


def _halve(pieces: Pieces) -> Pieces:
    """Cut all pieces in two, slightly off the middle, since roots of simple formulas often lie exactly there."""
    middle = pieces.lower + 0.4917 * (pieces.upper - pieces.lower)
    return Pieces(
        np.concatenate((pieces.ray, pieces.ray)),
        np.concatenate((pieces.lower, middle)),
        np.concatenate((middle, pieces.upper)),
    )
