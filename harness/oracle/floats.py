"""f along rays in plain float64: fast, rounded, and used only for guesses and estimates."""

from __future__ import annotations

from typing import Any

import numpy as np

from harness.oracle.balls64 import Floats
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.program import Functions, Program


def _ratio(slope: Any, root: Any) -> Any:
    """The slope over the root of what is constant is 0, even where the root is."""
    return np.where(slope == 0.0, 0.0, slope / root)


FUNCTIONS: Functions = {
    "sqrt": np.sqrt, "exp": np.exp, "log": np.log, "sin": np.sin, "cos": np.cos, "tan": np.tan,
    "abs": np.abs, "min": np.minimum, "max": np.maximum, "sign": np.sign, "half": lambda a: 0.5 * a,
    "ratio": _ratio,
}  # fmt: skip
NEWTON_STEPS = 9
MOST_DEGREE = 32
DUAL_FUNCTIONS = dual_functions(FUNCTIONS)


class FloatFunction:
    """f at points o + t·d; arrays broadcast, so t may be [n] or [n, k]."""

    def __init__(self, program: Program, constants: list[float]) -> None:
        self.program = program
        self.constants = [np.float64(c) for c in constants]
        # polynomials are known everywhere from degree + 1 samples, as long as rounding errors are not blown up
        self.interpolates = program.is_polynomial and 0 < program.degree <= MOST_DEGREE
        self.samples = 12 * program.degree + 1 if self.interpolates else 129
        self.duals = [Dual(c, np.float64(0.0)) for c in self.constants]

    def values(self, rays: Floats, t: Floats) -> Floats:
        """f, float64 of t's shape."""
        value = self.program.run(self.points(rays, t), self.constants, FUNCTIONS)
        return np.asarray(np.broadcast_to(value, t.shape))

    def along(self, rays: Floats, t: Floats) -> Dual:
        """f and df/dt, each of t's shape."""
        points = self.points(rays, t)
        return self._dual([Dual(p, _like(rays[:, 3 + k], t)) for k, p in enumerate(points)], t)

    def steepness(self, rays: Floats, t: Floats) -> Floats:
        """|grad f|, of t's shape."""
        points = self.points(rays, t)
        squares = [
            self._dual([Dual(p, np.float64(k == axis)) for k, p in enumerate(points)], t).slope ** 2
            for axis in range(3)
        ]
        return np.asarray(np.sqrt(sum(squares)))

    def root_between(self, rays: Floats, lower: Floats, upper: Floats, rising: Any) -> Floats:
        """A root in [lower, upper], across which f changes sign upwards where `rising`: Newton, halving as it must."""
        t = 0.5 * (lower + upper)
        for _ in range(NEWTON_STEPS):
            f = self.along(rays, t)
            high = (f.value > 0.0) == rising
            upper, lower = np.where(high, t, upper), np.where(high, lower, t)
            step = t - f.value / f.slope
            t = np.where((step >= lower) & (step <= upper), step, 0.5 * (lower + upper))
        return t

    def _dual(self, inputs: list[Dual], t: Floats) -> Dual:
        result: Dual = self.program.run(inputs, self.duals, DUAL_FUNCTIONS)
        return Dual(np.broadcast_to(result.value, t.shape), np.broadcast_to(result.slope, t.shape))

    @staticmethod
    def points(rays: Floats, t: Floats) -> list[Floats]:
        return [_like(rays[:, k], t) + t * _like(rays[:, 3 + k], t) for k in range(3)]


def _like(column: Floats, t: Floats) -> Any:
    return column if t.ndim == 1 else column[:, None]


class _Sized:
    """A value and the sum of its terms' magnitudes: what rounding errors of relative size 1 would change it by."""

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


def _sized(name: str) -> Any:
    """An elementary function of sized values: the argument's terms through the slope, and the result's own."""

    def call(*args: _Sized) -> _Sized:
        value = FUNCTIONS[name](*(a.value for a in args))
        if len(args) == 2:
            return _Sized(value, np.maximum(args[0].size, args[1].size))
        slope = DUAL_FUNCTIONS[name](Dual(args[0].value, 1.0)).slope
        return _Sized(value, np.abs(slope) * args[0].size + (0.0 if name == "abs" else np.abs(value)))

    return call


SIZED_FUNCTIONS = {name: _sized(name) for name in FUNCTIONS}


def majorant(f: FloatFunction, rays: Floats, t: Floats) -> Floats:
    """Sum of |terms of f| at o + t·d, of t's shape."""
    inputs = [_Sized(p, np.abs(p)) for p in f.points(rays, t)]
    result: _Sized = f.program.run(inputs, [_Sized(c, np.abs(c)) for c in f.constants], SIZED_FUNCTIONS)
    return np.asarray(np.broadcast_to(result.size, t.shape))
