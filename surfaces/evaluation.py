"""Compute a surface's tape, its exact expression, and its values at numpy points."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from surfaces import formula, lowering
from surfaces.model import Surface
from surfaces.numbers import Arithmetic
from surfaces.tape import Tape, walk

if TYPE_CHECKING:
    import sympy

Floats64 = NDArray[np.float64]


class Floats(Arithmetic):
    """Run a tape in float64 arrays of one shape."""

    def const(self, value: Fraction) -> np.float64:
        try:
            return np.float64(value.numerator / value.denominator)
        except OverflowError:
            return np.float64(np.inf if value > 0 else -np.inf)

    def pi(self) -> np.float64:
        return np.float64(np.pi)

    def e(self) -> np.float64:
        return np.float64(np.e)

    abs = staticmethod(np.abs)
    min = staticmethod(np.minimum)
    max = staticmethod(np.maximum)
    sqrt = staticmethod(np.sqrt)
    exp = staticmethod(np.exp)
    log = staticmethod(np.log)
    sin = staticmethod(np.sin)
    cos = staticmethod(np.cos)
    tan = staticmethod(np.tan)

    floor = staticmethod(np.floor)

    def atan2(self, a: Floats64, b: Floats64) -> Floats64:
        return np.arctan2(a + 0.0, b + 0.0)  # the sum makes 0 of -0, whose angle is another

    def powr(self, a: Floats64, q: Fraction) -> Floats64:
        return np.power(np.maximum(a, 0.0), float(q))  # a is not negative, but rounding may make it so

    def select(self, c: Floats64, p: Floats64, q: Floats64) -> Floats64:
        return np.where(c > 0.0, p, q)

    def sign(self, a: Floats64) -> Floats64:
        return np.where(a < 0.0, -1.0, 1.0)

    def below(self, a: Floats64, b: Floats64) -> Floats64:
        return np.where(a <= b, 1.0, 0.0)


@cache
def tape_of(surface: Surface) -> Tape:
    """Return the parsed formula: constants are exact, powers whole, operations in the order written."""
    return formula.parse(surface.formula, dict(surface.parameters))


@cache
def expression(surface: Surface) -> sympy.Expr:
    """Return f as an exact sympy expression in the symbols X, Y, Z of surfaces.formula. Raises as it does there."""
    value: sympy.Expr = formula.expression(tape_of(surface))
    return value


def operations(surface: Surface) -> dict[str, int]:
    """Count the operations of one evaluation of f in a kernel, by name."""
    return lowering.counts(lowering.real_tape(tape_of(surface)))


def evaluate_tape(tape: Tape, points: Floats64) -> Floats64:
    """Evaluate a real tape at points float64[n, 3]: float64[n, outputs]."""
    points = np.asarray(points, np.float64).reshape(-1, 3)
    with np.errstate(all="ignore"):
        columns = walk(tape, Floats(), dict(zip("xyz", points.T, strict=True)))
    return np.stack([np.broadcast_to(column, len(points)) for column in columns], axis=1)


def evaluate(surface: Surface, points: Floats64) -> Floats64:
    """Evaluate f at points float64[n, 3]: float64[n]."""
    return evaluate_tape(lowering.real_tape(tape_of(surface)), points)[:, 0]


def gradient(surface: Surface, points: Floats64) -> Floats64:
    """Evaluate the gradient of f at points float64[n, 3]: float64[n, 3]."""
    return evaluate_tape(_gradient_tape(surface), points)


@cache
def _gradient_tape(surface: Surface) -> Tape:
    """Return the real tape of the gradient."""
    return lowering.gradient(lowering.real_tape(tape_of(surface)))
