"""Compute values with their derivative along a ray in any number system: balls of arb or float64, and plain floats."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from operator import truediv
from typing import Any

from harness.oracle.program import Functions

HALF = Fraction(1, 2)


class Dual:
    """Hold a value and its derivative. In a number system of ranges, both are ranges over the whole range of t."""

    __slots__ = ("slope", "value")

    def __init__(self, value: Any, slope: Any) -> None:
        self.value = value
        self.slope = slope

    def __add__(self, other: Dual) -> Dual:
        return Dual(self.value + other.value, self.slope + other.slope)

    def __sub__(self, other: Dual) -> Dual:
        return Dual(self.value - other.value, self.slope - other.slope)

    def __neg__(self) -> Dual:
        return Dual(-self.value, -self.slope)

    def __mul__(self, other: Dual) -> Dual:
        return Dual(self.value * other.value, self.value * other.slope + self.slope * other.value)

    def __truediv__(self, other: Dual) -> Dual:
        quotient = self.value / other.value
        return Dual(quotient, (self.slope - quotient * other.slope) / other.value)


def dual_functions(base: Mapping[str, Callable[..., Any]]) -> Functions:
    """Return the elementary functions on duals, made of those of the number system `base`.

    Beside the elementary functions `base` has

    - `scale`, of a number and a rational;
    - `sqr`, if squares are enclosed better than products;
    - `sign`, the generalised derivative of abs: +1, −1, or a range that holds [−1, 1] if the sign is not known;
    - `step_slope`, `select_slope` and `atan2_slope`, which are NaN where f may jump. NaN goes on to the slope of f, so
      that no proof by slopes crosses a jump.

    It may have

    - `pick` of a sign and two numbers: the first if the sign is +1, the second if it is −1, else what holds both;
    - `ratio` of a slope and a root: 0 if the slope is known to be 0;
    - `share` of u and a length that is not less than |u|: the quotient, which never leaves [−1, 1].
    """

    def mixed(sign: Any, a: Any, b: Any) -> Any:
        return base["scale"](a + b + sign * (a - b), HALF)

    pick: Callable[..., Any] = base.get("pick", mixed)
    ratio: Callable[..., Any] = base.get("ratio", truediv)
    share: Callable[..., Any] | None = base.get("share")

    def sqrt(a: Dual) -> Dual:
        root = base["sqrt"](a.value)
        return Dual(root, base["scale"](ratio(a.slope, root), HALF))

    def length(*parts: Dual) -> Dual:
        value = base["length"](*(p.value for p in parts))
        terms = [share(p.value, value) * p.slope for p in parts] if share else []
        return Dual(value, sum(terms[1:], terms[0]))

    def exp(a: Dual) -> Dual:
        value = base["exp"](a.value)
        return Dual(value, value * a.slope)

    def log(a: Dual) -> Dual:
        return Dual(base["log"](a.value), a.slope / a.value)

    def sin(a: Dual) -> Dual:
        return Dual(base["sin"](a.value), base["cos"](a.value) * a.slope)

    def cos(a: Dual) -> Dual:
        return Dual(base["cos"](a.value), -(base["sin"](a.value) * a.slope))

    def tan(a: Dual) -> Dual:
        return sin(a) / cos(a)

    def absolute(a: Dual) -> Dual:
        return Dual(base["abs"](a.value), base["sign"](a.value) * a.slope)

    def minimum(a: Dual, b: Dual) -> Dual:
        return Dual(base["min"](a.value, b.value), pick(base["sign"](b.value - a.value), a.slope, b.slope))

    def maximum(a: Dual, b: Dual) -> Dual:
        return Dual(base["max"](a.value, b.value), pick(base["sign"](a.value - b.value), a.slope, b.slope))

    def square(a: Dual) -> Dual:
        value = base["sqr"](a.value) if "sqr" in base else a.value * a.value
        return Dual(value, a.value * (a.slope + a.slope))

    def powr(a: Dual, exponent: Fraction) -> Dual:
        value = base["powr"](a.value, exponent)
        if exponent > 1:
            return Dual(value, base["scale"](base["powr"](a.value, exponent - 1), exponent) * a.slope)
        return Dual(value, base["scale"](ratio(a.slope, a.value) * value, exponent))

    def floor(a: Dual) -> Dual:
        value = base["floor"](a.value)
        return Dual(value, base["step_slope"](value))

    def below(a: Dual, b: Dual) -> Dual:
        value = base["below"](a.value, b.value)
        return Dual(value, base["step_slope"](value))

    def select(c: Dual, p: Dual, q: Dual) -> Dual:
        slope = base["select_slope"](c.value, p.slope, q.slope)
        return Dual(base["select"](c.value, p.value, q.value), slope)

    def atan2(y: Dual, x: Dual) -> Dual:
        return Dual(base["atan2"](y.value, x.value), base["atan2_slope"](y.value, x.value, y.slope, x.slope))

    return {
        "sqr": square, "powr": powr, "floor": floor, "below": below, "select": select, "atan2": atan2,
        "sqrt": sqrt, "exp": exp, "log": log, "sin": sin, "cos": cos, "tan": tan,
        "abs": absolute, "min": minimum, "max": maximum, "length": length,
    }  # fmt: skip
