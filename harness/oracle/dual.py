"""Compute values with their derivative along a ray in any number system: balls of arb or float64, and plain floats."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import truediv
from typing import Any

from harness.oracle.program import Functions


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

    - `half`;
    - `sign`, the generalised derivative of abs: +1, −1, or a range that holds [−1, 1] if the sign is not known.

    It may have

    - `pick` of a sign and two numbers: the first if the sign is +1, the second if it is −1, else what holds both;
    - `ratio` of a slope and a root: 0 if the slope is known to be 0;
    - `share` of u and a length that is not less than |u|: the quotient, which never leaves [−1, 1].
    """

    def mixed(sign: Any, a: Any, b: Any) -> Any:
        return base["half"](a + b + sign * (a - b))

    pick: Callable[..., Any] = base.get("pick", mixed)
    ratio: Callable[..., Any] = base.get("ratio", truediv)
    share: Callable[..., Any] | None = base.get("share")

    def sqrt(a: Dual) -> Dual:
        root = base["sqrt"](a.value)
        return Dual(root, base["half"](ratio(a.slope, root)))

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

    return {
        "sqrt": sqrt, "exp": exp, "log": log, "sin": sin, "cos": cos, "tan": tan,
        "abs": absolute, "min": minimum, "max": maximum, "length": length,
    }  # fmt: skip
