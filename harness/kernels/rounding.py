"""Bound the rounding errors of evaluating f over balls about the domain's centre, and how they grow in coefficients.

**Theory** Running error analysis (Higham 2002, section 3.3): to first order, the error of an operation's result is the
propagated errors of its operands, plus one unit roundoff of the result's own magnitude. A fused multiply-add has a
smaller error. The bound at a point is exact to first order. The bound over a ball is the largest at POINTS points,
times MARGIN for the points between them and for terms of second order.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, FirsthitError, Precision, Surface

POINTS = 60_000
MARGIN = 1.25

Floats = NDArray[np.float64]
Numbers = float | Floats  # one number, or one for each point
Estimate = tuple[Numbers, Numbers]  # a value, and its error in unit roundoffs


@dataclass(frozen=True, eq=False)
class _Errors:
    """Run a real tape on pairs of a value and its error in unit roundoffs; `own` is the error of each operation."""

    own: float

    def const(self, value: Fraction) -> Estimate:
        return float(value), self.own * abs(float(value))

    def _rounded(self, value: Numbers, error: Numbers) -> Estimate:
        """Return a result with its own rounding error added."""
        return value, error + self.own * np.abs(value)

    def add(self, a: Estimate, b: Estimate) -> Estimate:
        return self._rounded(a[0] + b[0], a[1] + b[1])

    def sub(self, a: Estimate, b: Estimate) -> Estimate:
        return self._rounded(a[0] - b[0], a[1] + b[1])

    def neg(self, a: Estimate) -> Estimate:
        return -a[0], a[1]

    def mul(self, a: Estimate, b: Estimate) -> Estimate:
        return self._rounded(a[0] * b[0], a[1] * np.abs(b[0]) + b[1] * np.abs(a[0]))

    def sqr(self, a: Estimate) -> Estimate:
        return self.mul(a, a)

    def div(self, a: Estimate, b: Estimate) -> Estimate:
        value = a[0] / b[0]
        return self._rounded(value, (a[1] + np.abs(value) * b[1]) / np.abs(b[0]))


@lru_cache(maxsize=128)
def value_errors(surface: Surface, shells: int, coordinates: float, reach: float = 1.0) -> tuple[float, ...]:
    """Bound the error of a computed f in unit roundoffs over balls about the domain's centre, for a polynomial f.

    Bound number k = 1 … shells is for the points of the domain within k/shells of its radius from its centre. The
    points' coordinates have errors of `coordinates` unit roundoffs of that distance. With `reach` the radius counts as
    that many times as large, and points outside the domain by no more than the difference count too. Raises
    FirsthitError if there is no finite bound.
    """
    import surfaces
    from surfaces.lowering import real_tape
    from surfaces.tape import walk

    domain, radius = surface.domain, reach * surface.domain.radius
    rng = np.random.default_rng(1)
    directions = rng.normal(size=(POINTS, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    away = radius * rng.integers(1, 4 * shells + 1, POINTS) / (4 * shells)
    points = directions * away[:, None]
    if isinstance(domain, Box):
        half = np.subtract(domain.upper, domain.lower) / 2 + (reach - 1.0) * domain.radius
        points = np.clip(points, -half, half)
        away = np.linalg.norm(points, axis=1)
    points = points + domain.center
    tape = real_tape(surfaces.tape_of(surface))
    found = []
    for own, off in ((1.0, 0.0), (0.0, 1.0)):
        inputs = {axis: (points[:, k], off) for k, axis in enumerate("xyz")}
        found.append(np.broadcast_to(walk(tape, _Errors(own), inputs)[0][1], away.shape))
    bounds = []
    for k in range(1, shells + 1):
        ball = radius * k / shells
        inside = away <= ball * (1.0 + 1e-9)
        bounds.append(MARGIN * float((found[0] + coordinates * ball * found[1])[inside].max()))
    if not bounds[-1] < np.inf:
        raise FirsthitError(f"{surface.name}: no finite bound of its rounding errors over the domain")
    return tuple(bounds)


def sample_errors_grow(degree: int, precision: Precision, depths: int) -> list[float]:
    """Bound by what factor an error of the samples grows in the Bernstein coefficients of pieces of their interval.

    Factor number d = 0 … depths is for pieces that are 2^-d of the interval. Nodes and inverse matrix are those of
    harness.kernels.fitting.
    """
    from harness.kernels.fitting import inverse

    matrix = np.array([[float(v) for v in row] for row in inverse(degree, "bernstein", precision)])
    pieces, grown = [matrix], []
    for _ in range(depths + 1):
        grown.append(max(float(np.abs(piece).sum(axis=1).max()) for piece in pieces) * MARGIN)
        pieces = [half for piece in pieces for half in _halves(piece)]
    return grown


def slope_errors_grow(degree: int, precision: Precision, depths: int) -> list[float]:
    """Bound by what factor an error of the samples grows in the derivative's Bernstein coefficients.

    Factor number d = 0 … depths is for any piece that is 2^-d of the samples' interval, which is the unit of length.
    Nodes and inverse matrix are those of harness.kernels.fitting.
    """
    from harness.kernels.fitting import inverse

    rows = np.array([[float(v) for v in row] for row in inverse(degree, "bernstein", precision)])
    slopes = degree * np.diff(rows, axis=0)
    grown = [float(np.abs(slopes).sum(axis=1).max())]
    for depth in range(1, depths + 1):
        width = 0.5**depth
        starts = np.arange(4 * 2**depth) * width / 4  # every piece lies in one that is a quarter longer
        pieces = _restricted(slopes, starts, np.minimum(1.25 * width, 1.0 - starts))
        grown.append(float(np.abs(pieces).sum(axis=2).max()))
    return [value * MARGIN for value in grown]


def _restricted(rows: Floats, starts: Floats, widths: Floats) -> Floats:
    """Restrict Bernstein coefficients on [0, 1] to each [start, start + width]: float64[m, …] to [pieces, m, …]."""
    pieces = np.repeat(rows[None], len(starts), axis=0)
    at, share = starts[:, None, None], (widths / (1.0 - starts))[:, None, None]
    for r in range(1, len(rows)):
        pieces[:, : len(rows) - r] += at * (pieces[:, 1 : len(rows) - r + 1] - pieces[:, : len(rows) - r])
    for r in range(1, len(rows)):
        pieces[:, r:] = pieces[:, r - 1 : -1] + share * (pieces[:, r:] - pieces[:, r - 1 : -1])
    return pieces


def _halves(rows: Floats) -> tuple[Floats, Floats]:
    """Return the Bernstein coefficients of both halves, float64[degree + 1, …] each, by de Casteljau's algorithm."""
    left, right = [rows[0]], [rows[-1]]
    while len(rows) > 1:
        rows = 0.5 * (rows[:-1] + rows[1:])
        left.append(rows[0])
        right.append(rows[-1])
    return np.array(left), np.array(right[::-1])
