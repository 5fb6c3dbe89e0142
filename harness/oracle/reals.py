"""Compute with reals as balls of python-flint: conversions, and elementary functions at the current precision."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq

from harness.contract import FirsthitError
from harness.oracle.program import Functions

if TYPE_CHECKING:
    import sympy


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Set the precision of ball operations, in bits, inside a with statement."""
    before = ctx.prec
    ctx.prec = bits
    try:
        yield
    finally:
        ctx.prec = before


def rational(value: float) -> Any:
    """Return a finite float exactly, as an fmpq."""
    return fmpq(*value.as_integer_ratio())


def leaf(expr: sympy.Expr) -> Any:
    """Return a sympy number without arguments as a ball. Raises FirsthitError if it is not known."""
    import sympy

    if expr.is_Rational:
        return arb(fmpq(int(expr.p), int(expr.q)))
    if expr == sympy.pi:
        return arb.pi()
    if expr == sympy.E:
        return arb.const_e()
    if expr == sympy.GoldenRatio:
        return (1 + arb(5).sqrt()) / 2
    raise FirsthitError(f"the oracle does not know the constant {expr}")


def root(ball: Any) -> Any:
    """Enclose the square roots of the members that are not negative; NaN if all are negative."""
    return arb.sqrt(ball.nonnegative_part() if ball.contains(0) else ball)


def length(*parts: Any) -> Any:
    """Enclose the square root of the sum of the squares."""
    return root(sum(part * part for part in parts))


FUNCTIONS: Functions = {
    "sqrt": root, "length": length, "exp": arb.exp, "log": arb.log, "sin": arb.sin, "cos": arb.cos, "tan": arb.tan,
    "abs": abs, "min": arb.min, "max": arb.max,
}  # fmt: skip


def float_below(ball: Any) -> float:
    """Return a float64 that is proved to be above no member of `ball`."""
    value = float(ball.lower())
    while not arb(value) <= ball:
        value = math.nextafter(value, -math.inf)
    return value


def float_above(ball: Any) -> float:
    """Return a float64 that is proved to be below no member of `ball`."""
    value = float(ball.upper())
    while not arb(value) >= ball:
        value = math.nextafter(value, math.inf)
    return value
