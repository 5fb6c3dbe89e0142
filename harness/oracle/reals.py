"""Compute with reals as balls of python-flint: conversions, and elementary functions at the current precision."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

from flint import arb, ctx, fmpq

from harness.oracle.program import Functions, Leaf


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


def leaf(value: Leaf) -> Any:
    """Return a rational number, pi or e as a ball."""
    if isinstance(value, Fraction):
        return arb(fmpq(value.numerator, value.denominator))
    return arb.pi() if value == "pi" else arb.const_e()


def root(ball: Any) -> Any:
    """Enclose the square roots of the members that are not negative; NaN if all are negative."""
    return arb.sqrt(ball.nonnegative_part() if ball.contains(0) else ball)


def square(ball: Any) -> Any:
    """Enclose the square, which is not negative. Polynomials are squared too."""
    result = ball * ball
    return result.nonnegative_part() if isinstance(result, arb) and result.contains(0) else result


def length(*parts: Any) -> Any:
    """Enclose the square root of the sum of the squares."""
    return root(sum(square(part) for part in parts))


def powr(ball: Any, exponent: Fraction) -> Any:
    """Enclose the powers, to a positive exponent, of the members that are not negative; NaN if all are negative."""
    power = arb(fmpq(exponent.numerator, exponent.denominator))
    low, high = ball.lower(), ball.upper()
    if not high > 0:
        return high if high == 0 else arb.nan()
    return (low**power if low > 0 else arb(0)).union(high**power)


def floor(ball: Any) -> Any:
    """Enclose the greatest whole numbers that are not above the members; exactly if there is only one."""
    low, high = ball.lower().floor(), ball.upper().floor()
    return low if low == high else low.union(high)


def below(a: Any, b: Any) -> Any:
    """Return 1 if a <= b, 0 if a > b, else a ball that holds both."""
    return arb(1) if a <= b else arb(0) if a > b else arb(0.5, 0.5)


def select(c: Any, p: Any, q: Any) -> Any:
    """Return p if the condition c, which is 1 or 0, holds, q if it does not, else a ball that holds both."""
    return p if c > 0.5 else q if c < 0.5 else p.union(q)


FUNCTIONS: Functions = {
    "sqrt": root, "length": length, "exp": arb.exp, "log": arb.log, "sin": arb.sin, "cos": arb.cos, "tan": arb.tan,
    "abs": abs, "min": arb.min, "max": arb.max, "sqr": square,
    "floor": floor, "powr": powr, "atan2": arb.atan2, "below": below, "select": select,
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
