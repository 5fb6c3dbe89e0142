"""How far kernels may be off in f's value at points of rays, in unit roundoffs of the arithmetic they use.

**Theory.** Running error analysis, as in harness.kernels.rounding, at given points instead of over balls, and for every
formula. Counted are: the coordinates, off by a rounding each of the moved origin, of t·d and of their sum; constants
that are no float32, rounded once; and each operation of the tape that kernels evaluate, with what OpenCL allows the
functions. A surface of degree 4 or less is evaluated by some methods through its coefficients along the ray and
Horner's rule, and by others through its tape: the larger of both bounds counts. How f is written decides the bound, as
it decides the errors. It is a worst case to first order: the errors of most points are under a tenth of it. It says
nothing of a method that takes f's sign from anything else than f's value.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from harness.contract import Surface, as_float32
from harness.oracle.balls64 import Floats
from harness.oracle.clip import nearest, recentred
from surfaces.tape import walk

DIVISION = 5.0  # unit roundoffs: OpenCL and GLSL allow 2.5 units in the last place
FUNCTION = 10.0  # of any other function's value; OpenCL allows up to 5 units in the last place
MOST_EXPANDED = 4  # degree up to which kernels may expand f along the ray


class RunningErrors:
    """The number system of pairs (value, error in unit roundoffs); see surfaces.tape for the names."""

    def const(self, value: Fraction) -> Any:
        number = value.numerator / value.denominator
        try:
            exact = Fraction(as_float32(number)) == value
        except OverflowError:
            exact = False
        return number, 0.0 if exact else abs(number)

    def pi(self) -> Any:
        return np.pi, np.pi

    def e(self) -> Any:
        return np.e, np.e

    def add(self, a: Any, b: Any) -> Any:
        value = a[0] + b[0]
        return value, a[1] + b[1] + np.abs(value)

    def sub(self, a: Any, b: Any) -> Any:
        value = a[0] - b[0]
        return value, a[1] + b[1] + np.abs(value)

    def neg(self, a: Any) -> Any:
        return -a[0], a[1]

    def mul(self, a: Any, b: Any) -> Any:
        value = a[0] * b[0]
        return value, a[1] * np.abs(b[0]) + b[1] * np.abs(a[0]) + np.abs(value)

    def sqr(self, a: Any) -> Any:
        return self.mul(a, a)

    def powi(self, a: Any, n: int) -> Any:
        half = self.sqr(a if n < 4 else self.powi(a, n // 2))
        return self.mul(half, a) if n % 2 else half

    def div(self, a: Any, b: Any) -> Any:
        value = a[0] / b[0]
        return value, (a[1] + np.abs(value) * b[1]) / np.abs(b[0]) + DIVISION * np.abs(value)

    def _called(self, a: Any, value: Any, slope: Any, size: Any) -> Any:
        """A function's result: its argument's error and one rounding more through the slope, and its own."""
        moved = a[1] + np.abs(a[0])
        through = np.where(moved == 0.0, 0.0, np.abs(slope) * moved)
        return value, through + FUNCTION * size

    def sqrt(self, a: Any) -> Any:
        value = np.sqrt(a[0])
        return self._called(a, value, 0.5 / value, np.abs(value))

    def exp(self, a: Any) -> Any:
        value = np.exp(a[0])
        return self._called(a, value, value, value)

    def log(self, a: Any) -> Any:
        value = np.log(a[0])
        return self._called(a, value, 1.0 / np.asarray(a[0]), np.abs(value))

    def sin(self, a: Any) -> Any:
        return self._called(a, np.sin(a[0]), np.cos(a[0]), 1.0)

    def cos(self, a: Any) -> Any:
        return self._called(a, np.cos(a[0]), np.sin(a[0]), 1.0)

    def tan(self, a: Any) -> Any:
        value = np.tan(a[0])
        return self._called(a, value, 1.0 + value * value, np.abs(value))

    def abs(self, a: Any) -> Any:
        return np.abs(a[0]), a[1]

    def min(self, a: Any, b: Any) -> Any:
        return np.minimum(a[0], b[0]), np.maximum(a[1], b[1])

    def max(self, a: Any, b: Any) -> Any:
        return np.maximum(a[0], b[0]), np.maximum(a[1], b[1])


class Noise:
    """Bounds of f's rounding errors in kernels, for one surface."""

    def __init__(self, surface: Surface) -> None:
        import surfaces
        from surfaces.lowering import coefficients_along, real_tape

        self.tape = real_tape(surfaces.tape_of(surface))
        degree = surface.degree
        expanded = degree is not None and 1 <= degree <= MOST_EXPANDED
        self.expansion = coefficients_along(self.tape, degree) if expanded and degree else None

    def along(self, rays: Floats) -> NoiseAlong:
        """Prepare for rays float64[n, 6] whose origins are where kernels move them, near the domain's centre."""
        return NoiseAlong(self, rays)


class NoiseAlong:
    """The bounds on some rays: what belongs to a ray is calculated once."""

    def __init__(self, noise: Noise, rays: Floats) -> None:
        self._noise = noise
        self._rays = rays
        self._coefficients: tuple[Any, ...] = ()
        if noise.expansion is not None:
            inputs = {}
            for k, axis in enumerate("xyz"):
                inputs[f"o{axis}"] = rays[:, k], np.abs(rays[:, k])
                inputs[f"d{axis}"] = rays[:, 3 + k], np.zeros(len(rays))
            found = walk(noise.expansion, RunningErrors(), inputs)
            self._coefficients = tuple(tuple(np.broadcast_to(part, len(rays)) for part in pair) for pair in found)

    def bound(self, rows: Any, t: Floats) -> Floats:
        """At o + t·d of the rays `rows`, an index of them, for t float64[k]: float64[k], in unit roundoffs; infinite or
        NaN where there is no bound."""
        by_tape = self.by_tape(rows, t)
        if not self._coefficients:
            return by_tape
        *lower, (value, error) = [(value[rows], error[rows]) for value, error in self._coefficients]
        size = np.abs(t)
        for coefficient, off in reversed(lower):
            product = value * t
            value = product + coefficient
            error = error * size + np.abs(product) + off + np.abs(value)
        return np.asarray(np.maximum(by_tape, error))

    def by_tape(self, rows: Any, t: Floats) -> Floats:
        """Bound the errors of values that are calculated from the point alone, as `bound` does."""
        inputs = {}
        for k, axis in enumerate("xyz"):
            origin = self._rays[rows, k]
            step = t * self._rays[rows, 3 + k]
            point = origin + step
            inputs[axis] = point, np.abs(origin) + np.abs(step) + np.abs(point)
        error = walk(self._noise.tape, RunningErrors(), inputs)[0][1]
        return np.asarray(np.broadcast_to(error, t.shape))


def root_shift(surface: Surface, rays: Floats, t: Floats) -> Floats:
    """How far kernels' roundings may move simple roots at `t` of rays float64[n, 6], to first order: float64[n], in t
    per unit roundoff; NaN where t is, infinite where the slope along the ray is 0."""
    import surfaces

    shift = nearest(np.asarray(surface.domain.center), rays)
    near, at = recentred(rays, shift), t - shift
    with np.errstate(all="ignore"):
        slope = surfaces.gradient(surface, near[:, :3] + at[:, None] * near[:, 3:]) * near[:, 3:]
        return np.asarray(Noise(surface).along(near).bound(slice(None), at) / np.abs(slope.sum(axis=1)))
