"""What floats make of f: bounds of its rounding errors over balls about the domain's centre.

**Theory** Running error analysis (Higham 2002, section 3.3): the result of an operation is off by what its operands are
off by, to first order, and by one unit roundoff of its own magnitude. A fused multiply-add errs by less. The bound at a
point is exact to first order; over a ball it is the largest of POINTS points, times MARGIN for those between and for
what is of second order.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from harness.contract import Box, FirsthitError, Surface

POINTS = 60_000
MARGIN = 1.25


@dataclass(frozen=True, eq=False)
class _Errors:
    """The operations of a real tape on (value, error in unit roundoffs); `own` is each operation's own error."""

    own: float

    def const(self, value: Any) -> Any:
        return float(value), self.own * abs(float(value))

    def _rounded(self, value: Any, error: Any) -> Any:
        return value, error + self.own * np.abs(value)

    def add(self, a: Any, b: Any) -> Any:
        return self._rounded(a[0] + b[0], a[1] + b[1])

    def sub(self, a: Any, b: Any) -> Any:
        return self._rounded(a[0] - b[0], a[1] + b[1])

    def neg(self, a: Any) -> Any:
        return -a[0], a[1]

    def mul(self, a: Any, b: Any) -> Any:
        return self._rounded(a[0] * b[0], a[1] * np.abs(b[0]) + b[1] * np.abs(a[0]))

    def sqr(self, a: Any) -> Any:
        return self.mul(a, a)

    def div(self, a: Any, b: Any) -> Any:
        value = a[0] / b[0]
        return self._rounded(value, (a[1] + np.abs(value) * b[1]) / np.abs(b[0]))


@lru_cache(maxsize=128)
def value_errors(surface: Surface, shells: int, coordinates: float) -> tuple[float, ...]:
    """Bound |computed f − f| in unit roundoffs, for k = 1 … shells, at points of the domain within k/shells of its
    radius of its centre, whose coordinates are off by `coordinates` unit roundoffs of that distance.

    Only for polynomials. Raises FirsthitError where there is no finite bound.
    """
    import surfaces
    from surfaces.lowering import real_tape
    from surfaces.tape import walk

    domain, radius = surface.domain, surface.domain.radius
    rng = np.random.default_rng(1)
    directions = rng.normal(size=(POINTS, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    away = radius * rng.integers(1, 4 * shells + 1, POINTS) / (4 * shells)
    points = directions * away[:, None]
    if isinstance(domain, Box):
        half = np.subtract(domain.upper, domain.lower) / 2
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
        reach = radius * k / shells
        inside = away <= reach * (1.0 + 1e-9)
        bounds.append(MARGIN * float((found[0] + coordinates * reach * found[1])[inside].max()))
    if not bounds[-1] < np.inf:
        raise FirsthitError(f"{surface.name}: no finite bound of its rounding errors over the domain")
    return tuple(bounds)


def sample_errors_grow(degree: int, precision: Any, depths: int) -> list[float]:
    """Bound for d = 0 … depths what an error of the samples grows to in the Bernstein coefficients of a piece that
    is 2^-d of the interval that the samples are of (nodes and inverse as in harness.kernels.fitting)."""
    from harness.kernels.fitting import inverse

    matrix = np.array([[float(v) for v in row] for row in inverse(degree, "bernstein", precision)])
    pieces, grown = [matrix], []
    for _ in range(depths + 1):
        grown.append(max(float(np.abs(piece).sum(axis=1).max()) for piece in pieces) * MARGIN)
        pieces = [half for piece in pieces for half in _halves(piece)]
    return grown


def slope_errors_grow(degree: int, precision: Any, depths: int) -> list[float]:
    """Bound for d = 0 … depths what an error of the samples grows to in the derivative's Bernstein coefficients on
    any piece that is 2^-d of the interval that the samples are of, which is the unit of length (nodes and inverse as in
    harness.kernels.fitting)."""
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


def _restricted(rows: Any, starts: Any, widths: Any) -> Any:
    """Restrict rows [m, …] of coefficients on [0, 1] to each [start, start + width]: [pieces, m, …]."""
    pieces = np.repeat(rows[None], len(starts), axis=0)
    at, share = starts[:, None, None], (widths / (1.0 - starts))[:, None, None]
    for r in range(1, len(rows)):
        pieces[:, : len(rows) - r] += at * (pieces[:, 1 : len(rows) - r + 1] - pieces[:, : len(rows) - r])
    for r in range(1, len(rows)):
        pieces[:, r:] = pieces[:, r - 1 : -1] + share * (pieces[:, r:] - pieces[:, r - 1 : -1])
    return pieces


def _halves(rows: Any) -> tuple[Any, Any]:
    """De Casteljau's algorithm in the middle, on rows [degree + 1, …] of coefficients."""
    left, right = [rows[0]], [rows[-1]]
    while len(rows) > 1:
        rows = 0.5 * (rows[:-1] + rows[1:])
        left.append(rows[0])
        right.append(rows[-1])
    return np.array(left), np.array(right[::-1])
