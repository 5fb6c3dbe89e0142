"""Evaluate f along rays in plain float64: fast and with unknown errors, and so only for guesses and estimates."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.oracle.balls64 import Floats
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.program import Functions, Program


def _ratio(slope: Any, root: Any) -> Any:
    """Return slope / root, which is 0 if the slope is, even where the root is 0 too."""
    return np.where(slope == 0.0, 0.0, slope / root)


def _select(c: Any, p: Any, q: Any) -> Any:
    return np.where(c > 0.5, p, q)


FUNCTIONS: Functions = {
    "sqrt": np.sqrt, "exp": np.exp, "log": np.log, "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "abs": np.abs, "min": np.minimum, "max": np.maximum, "sign": np.sign, "scale": lambda a, q: float(q) * a,
    "ratio": _ratio, "floor": np.floor, "powr": lambda a, q: np.power(a, float(q)), "atan2": np.arctan2,
    "below": lambda a, b: np.where(a <= b, 1.0, 0.0), "select": _select,
    "step_slope": np.zeros_like, "select_slope": _select,
    "atan2_slope": lambda y, x, dy, dx: (x * dy - y * dx) / (x * x + y * y),
}  # fmt: skip
NEWTON_STEPS = 9
MOST_DEGREE = 32
DUAL_FUNCTIONS = dual_functions(FUNCTIONS)


class FloatFunction:
    """Evaluate f at points o + t·d of rays float64[n, 6], for t float64[n] or [n, k]."""

    def __init__(self, program: Program, constants: list[float]) -> None:
        self.program = program
        self.constants: list[Floats | np.float64] = [np.float64(c) for c in constants]
        # degree + 1 samples give a polynomial everywhere, as long as rounding errors do not grow too much
        self.interpolates = program.is_polynomial and 0 < program.degree <= MOST_DEGREE
        self.samples = 12 * program.degree + 1 if self.interpolates else 129
        self.duals = [Dual(c, np.float64(0.0)) for c in self.constants]

    def values(self, rays: Floats, t: Floats) -> Floats:
        """Return f float64[n] or [n, k], in t's shape."""
        value: Floats | np.float64 = self.program.run(self.points(rays, t), self.constants, FUNCTIONS)
        return np.asarray(np.broadcast_to(value, t.shape))

    def along(self, rays: Floats, t: Floats) -> Dual:
        """Return f and df/dt, each float64[n] or [n, k], in t's shape."""
        points = self.points(rays, t)
        return self._dual([Dual(p, _like(rays[:, 3 + k], t)) for k, p in enumerate(points)], t)

    def steepness(self, rays: Floats, t: Floats) -> Floats:
        """Return |grad f| float64[n] or [n, k], in t's shape."""
        points = self.points(rays, t)
        squares = [
            self._dual([Dual(p, np.float64(k == axis)) for k, p in enumerate(points)], t).slope ** 2
            for axis in range(3)
        ]
        return np.asarray(np.sqrt(sum(squares)))

    def root_between(self, rays: Floats, lower: Floats, upper: Floats, rising: NDArray[np.bool_]) -> Floats:
        """Return roots in [lower, upper], float64[n], by safeguarded Newton; f grows through a root where `rising`."""
        t = 0.5 * (lower + upper)
        for _ in range(NEWTON_STEPS):
            f = self.along(rays, t)
            high = (f.value > 0.0) == rising
            upper, lower = np.where(high, t, upper), np.where(high, lower, t)
            step = t - f.value / f.slope
            t = np.where((step >= lower) & (step <= upper), step, 0.5 * (lower + upper))
        return t

    def _dual(self, inputs: list[Dual], t: Floats) -> Dual:
        """Return f and its derivative for inputs that are duals, each in t's shape."""
        result: Dual = self.program.run(inputs, self.duals, DUAL_FUNCTIONS)
        return Dual(np.broadcast_to(result.value, t.shape), np.broadcast_to(result.slope, t.shape))

    @staticmethod
    def points(rays: Floats, t: Floats) -> list[Floats]:
        """Return x, y and z of o + t·d, each float64[n] or [n, k], in t's shape."""
        return [_like(rays[:, k], t) + t * _like(rays[:, 3 + k], t) for k in range(3)]


def _like(column: Floats, t: Floats) -> Floats:
    """Return a column [n] so that it broadcasts to t's shape."""
    return column if t.ndim == 1 else column[:, None]


class _Sized:
    """Hold a value and the sum of its terms' magnitudes, which is how far relative errors of 1 would move it."""

    __slots__ = ("size", "value")

    def __init__(self, value: Any, size: Any) -> None:
        self.value = value
        self.size = size

    def __add__(self, other: _Sized) -> _Sized:
        return _Sized(self.value + other.value, self.size + other.size)

    def __sub__(self, other: _Sized) -> _Sized:
        return _Sized(self.value - other.value, self.size + other.size)

    def __neg__(self) -> _Sized:
        return _Sized(-self.value, self.size)

    def __mul__(self, other: _Sized) -> _Sized:
        return _Sized(self.value * other.value, self.size * other.size)

    def __truediv__(self, other: _Sized) -> _Sized:
        value = self.value / other.value
        return _Sized(value, (self.size + np.abs(value) * other.size) / np.abs(other.value))


def _sized(name: str) -> Callable[..., _Sized]:
    """Return an elementary function of sized values: the argument's terms times the slope, plus the result itself."""

    def call(a: _Sized, *exponent: Any) -> _Sized:
        result = DUAL_FUNCTIONS[name](Dual(a.value, 1.0), *exponent)
        rounding = 0.0 if name in ("abs", "floor") else np.abs(result.value)
        return _Sized(result.value, np.abs(result.slope) * a.size + rounding)

    return call


def _sized_extreme(name: str) -> Callable[..., _Sized]:
    """Return the minimum or maximum of sized values, with the larger size."""
    return lambda a, b: _Sized(FUNCTIONS[name](a.value, b.value), np.maximum(a.size, b.size))


def _sized_angle(y: _Sized, x: _Sized) -> _Sized:
    """Return the angle of a point of two sized values."""
    value = np.arctan2(y.value, x.value)
    moved = np.abs(x.value) * y.size + np.abs(y.value) * x.size
    return _Sized(value, moved / (x.value * x.value + y.value * y.value) + np.abs(value))


SIZED_FUNCTIONS: Functions = {
    **{name: _sized(name) for name in ("sqrt", "exp", "log", "sin", "cos", "tan", "abs", "floor", "powr")},
    **{name: _sized_extreme(name) for name in ("min", "max")},
    "atan2": _sized_angle,
    "below": lambda a, b: _Sized(FUNCTIONS["below"](a.value, b.value), 0.0),
    "select": lambda c, p, q: _Sized(_select(c.value, p.value, q.value), _select(c.value, p.size, q.size)),
}


def majorant(f: FloatFunction, rays: Floats, t: Floats) -> Floats:
    """Return the sum of |terms of f| at o + t·d, float64[n] or [n, k], in t's shape."""
    inputs = [_Sized(p, np.abs(p)) for p in f.points(rays, t)]
    result: _Sized = f.program.run(inputs, [_Sized(c, np.abs(c)) for c in f.constants], SIZED_FUNCTIONS)
    return np.asarray(np.broadcast_to(result.size, t.shape))
