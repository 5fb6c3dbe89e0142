"""Bound the rounding errors of f's value in kernels at points of rays, in unit roundoffs of the kernel's arithmetic.

**Theory.** Running error analysis, as in harness.kernels.rounding, but at given points instead of over balls, and for
every formula. The bound covers one rounding each of the moved origin, of t·d and of their sum in every coordinate; one
rounding of each constant that is no float32; and the error of each operation of the tape that kernels evaluate. Some
methods evaluate a surface of degree 4 or less by its coefficients along the ray and Horner's rule, others by its tape;
the larger of both bounds is taken. The bound depends on how f is written, as the errors do. It is a worst case to first
order: at most points the errors are less than a tenth of it. It does not apply to a method that finds f's sign
otherwise than by f's value.

The errors of functions are the larger of what OpenCL and GLSL allow. GLSL states none of sin, cos, tan and atan: those
of OpenCL stand for the first three, and twice the largest that was measured for atan. (Vulkan allows sin and cos an
error of 2^-11, and atan one of 4096 units in the last place. A bound as wide would excuse answers that are wrong
everywhere.) tests/test_function_errors.py measures every function on each device of the machine.

A jump at a distance g, in the argument whose error is u·e for the unit roundoff u, may be taken for its other side once
u·e reaches g. So its height times e/g bounds that error for every u.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from harness.contract import Surface, as_float32
from harness.oracle.balls64 import Floats
from harness.oracle.clip import nearest, recentred
from surfaces.tape import walk

Numbers = float | Floats  # one number, or one for each point
Estimate = tuple[Numbers, Numbers]  # a value, and its error in unit roundoffs

Rows = NDArray[np.intp] | slice  # an index of rays
DIVISION = 5.0  # unit roundoffs of a quotient; OpenCL and GLSL allow 2.5 units in the last place
FUNCTION = 10.0  # unit roundoffs of a function that has no line here; OpenCL allows up to 5 units in the last place
EXPONENTIAL = (6.0, 4.0)  # unit roundoffs of exp(a) or exp2(a), and for each 1 of |a|: GLSL allows half as many ulp
LOGARITHM = (6.0, 8.0)  # of log and log2, or in place of these 8 (2^-21) about 1: GLSL allows 3 ulp, and 2^-21
ANGLE = 700.0  # unit roundoffs of atan2; Mesa's in GLSL was measured at 350, and OpenCL allows 6 ulp
POWER = 32.0  # unit roundoffs of a general power in OpenCL, which allows 16 ulp; GLSL's is exp2(q log2(a))
MOST_EXPANDED = 4  # the degree up to which kernels may expand f along the ray


class RunningErrors:
    """Run a tape in pairs of a value and its error in unit roundoffs; see surfaces.tape for the names."""

    def const(self, value: Fraction) -> Estimate:
        number = value.numerator / value.denominator
        try:
            exact = Fraction(as_float32(number)) == value
        except OverflowError:
            exact = False
        return number, 0.0 if exact else abs(number)

    def pi(self) -> Estimate:
        return np.pi, np.pi

    def e(self) -> Estimate:
        return np.e, np.e

    def add(self, a: Estimate, b: Estimate) -> Estimate:
        value = a[0] + b[0]
        return value, a[1] + b[1] + np.abs(value)

    def sub(self, a: Estimate, b: Estimate) -> Estimate:
        value = a[0] - b[0]
        return value, a[1] + b[1] + np.abs(value)

    def neg(self, a: Estimate) -> Estimate:
        return -a[0], a[1]

    def mul(self, a: Estimate, b: Estimate) -> Estimate:
        value = a[0] * b[0]
        return value, a[1] * np.abs(b[0]) + b[1] * np.abs(a[0]) + np.abs(value)

    def sqr(self, a: Estimate) -> Estimate:
        return self.mul(a, a)

    def powi(self, a: Estimate, n: int) -> Estimate:
        half = self.sqr(a if n < 4 else self.powi(a, n // 2))
        return self.mul(half, a) if n % 2 else half

    def div(self, a: Estimate, b: Estimate) -> Estimate:
        value = a[0] / b[0]
        return value, (a[1] + np.abs(value) * b[1]) / np.abs(b[0]) + DIVISION * np.abs(value)

    def _called(self, a: Estimate, value: Numbers, slope: Numbers, size: Numbers) -> Estimate:
        """Return a function's result: the error of its argument and one more rounding times the slope, and its own."""
        moved = a[1] + np.abs(a[0])
        through = np.where(moved == 0.0, 0.0, np.abs(slope) * moved)
        return value, through + FUNCTION * size

    def sqrt(self, a: Estimate) -> Estimate:
        value = np.sqrt(a[0])
        return self._called(a, value, 0.5 / value, np.abs(value))

    def exp(self, a: Estimate) -> Estimate:
        value = np.exp(a[0])
        own, each = EXPONENTIAL
        return self._called(a, value, value, value * np.maximum(1.0, (own + each * np.abs(a[0])) / FUNCTION))

    def log(self, a: Estimate) -> Estimate:
        value = np.log(a[0])
        return self._called(a, value, 1.0 / np.asarray(a[0]), np.maximum(np.abs(value), LOGARITHM[1] / FUNCTION))

    def sin(self, a: Estimate) -> Estimate:
        return self._called(a, np.sin(a[0]), np.cos(a[0]), 1.0)

    def cos(self, a: Estimate) -> Estimate:
        return self._called(a, np.cos(a[0]), np.sin(a[0]), 1.0)

    def tan(self, a: Estimate) -> Estimate:
        value = np.tan(a[0])
        return self._called(a, value, 1.0 + value * value, np.abs(value))

    def abs(self, a: Estimate) -> Estimate:
        return np.abs(a[0]), a[1]

    def min(self, a: Estimate, b: Estimate) -> Estimate:
        return np.minimum(a[0], b[0]), np.maximum(a[1], b[1])

    def max(self, a: Estimate, b: Estimate) -> Estimate:
        return np.maximum(a[0], b[0]), np.maximum(a[1], b[1])

    def powr(self, a: Estimate, q: Fraction) -> Estimate:
        value = np.power(a[0], float(q))
        size = np.where(value == 0.0, 0.0, np.abs(np.log2(a[0])))
        bend = 2.0 * float(q) * size  # the exponent and its product with the logarithm are rounded too
        bend = np.log(2.0) * (bend + float(q) * np.maximum(LOGARITHM[0] * size, LOGARITHM[1]))
        own = np.maximum(POWER, EXPONENTIAL[0] + EXPONENTIAL[1] * float(q) * size)
        return self._called(a, value, float(q) * value / np.asarray(a[0]), np.abs(value) * (own + bend) / FUNCTION)

    def floor(self, a: Estimate) -> Estimate:
        value = np.floor(a[0])
        return value, _over(a[1], np.minimum(a[0] - value, value + 1.0 - a[0]))

    def below(self, a: Estimate, b: Estimate) -> Estimate:
        return np.where(a[0] <= b[0], 1.0, 0.0), _over(a[1] + b[1], np.abs(np.asarray(a[0]) - b[0]))

    def select(self, c: Estimate, p: Estimate, q: Estimate) -> Estimate:
        taken = np.asarray(c[0]) > 0.5
        doubt, height = np.asarray(c[1]), np.abs(np.asarray(p[0]) - q[0])
        jump = np.where((doubt == 0.0) | (height == 0.0), 0.0, doubt * height)
        return np.where(taken, p[0], q[0]), np.where(taken, p[1], q[1]) + jump

    def atan2(self, y: Estimate, x: Estimate) -> Estimate:
        value = np.arctan2(y[0], x[0])
        high, wide = np.abs(np.asarray(y[0])), np.abs(np.asarray(x[0]))
        turned = (wide * (y[1] + high) + high * (x[1] + wide)) / (wide * wide + high * high)
        cut = np.where(np.asarray(x[0]) <= 0.0, 2.0 * np.pi * _over(y[1], high), 0.0)
        return value, turned + cut + ANGLE * np.abs(value)


def _over(error: Numbers, gap: Numbers) -> Floats:
    """Return error / gap, which is 0 if the error is, and infinite if only the gap is."""
    return np.where(np.asarray(error) == 0.0, 0.0, np.asarray(error) / np.asarray(gap))


class Noise:
    """Bound the rounding errors of one surface's f in kernels."""

    def __init__(self, surface: Surface) -> None:
        import surfaces
        from surfaces.lowering import coefficients_along, real_tape

        self.tape = real_tape(surfaces.tape_of(surface))
        degree = surface.degree
        expanded = degree is not None and 1 <= degree <= MOST_EXPANDED
        self.expansion = coefficients_along(self.tape, degree) if expanded and degree else None

    def along(self, rays: Floats) -> NoiseAlong:
        """Prepare bounds for rays float64[n, 6] with the origins that kernels use, near the domain's centre."""
        return NoiseAlong(self, rays)


class NoiseAlong:
    """Bound rounding errors on some rays; what depends on the ray alone is computed once."""

    def __init__(self, noise: Noise, rays: Floats) -> None:
        self._noise = noise
        self._rays = rays
        self._coefficients: tuple[tuple[Floats, Floats], ...] = ()
        if noise.expansion is not None:
            inputs = {}
            for k, axis in enumerate("xyz"):
                inputs[f"o{axis}"] = rays[:, k], np.abs(rays[:, k])
                inputs[f"d{axis}"] = rays[:, 3 + k], np.zeros(len(rays))
            found = walk(noise.expansion, RunningErrors(), inputs)
            self._coefficients = tuple(
                (np.broadcast_to(value, len(rays)), np.broadcast_to(error, len(rays))) for value, error in found
            )

    def bound(self, rows: Rows, t: Floats) -> Floats:
        """Return bounds at o + t·d of the rays `rows`, float64[k] in unit roundoffs, for t float64[k].

        They are infinite or NaN where there is no bound.
        """
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

    def by_tape(self, rows: Rows, t: Floats) -> Floats:
        """Return bounds float64[k] as `bound` does, of values that are evaluated from the point alone."""
        inputs = {}
        for k, axis in enumerate("xyz"):
            origin = self._rays[rows, k]
            step = t * self._rays[rows, 3 + k]
            point = origin + step
            inputs[axis] = point, np.abs(origin) + np.abs(step) + np.abs(point)
        error = walk(self._noise.tape, RunningErrors(), inputs)[0][1]
        return np.asarray(np.broadcast_to(error, t.shape))


def root_shift(surface: Surface, rays: Floats, t: Floats) -> Floats:
    """Return how far rounding errors of kernels may move simple roots, to first order: float64[n], t per unit roundoff.

    The roots are at `t`, float64[n], of rays float64[n, 6]. The result is NaN where t is NaN, infinite where the slope
    along the ray is 0.
    """
    import surfaces

    shift = nearest(np.asarray(surface.domain.center), rays)
    near, at = recentred(rays, shift), t - shift
    with np.errstate(all="ignore"):
        slope = surfaces.gradient(surface, near[:, :3] + at[:, None] * near[:, 3:]) * near[:, 3:]
        return np.asarray(Noise(surface).along(near).bound(slice(None), at) / np.abs(slope.sum(axis=1)))
