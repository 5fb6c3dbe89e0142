"""Real algebraic numbers: rationals, and roots of rational polynomials in brackets. Everything here is exact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import arb, fmpq, fmpq_poly

from harness.oracle.bernstein import Undecidable, brackets, to_bernstein
from harness.oracle.clip import End

DEPTH = 4096  # bits at which telling two numbers apart is given up


def polynomial(*coefficients: Any) -> Any:
    return fmpq_poly(list(coefficients))


@dataclass(eq=False)
class Point:
    """A number in [lower, upper]: lower itself where they are equal, else the one root of `p` between them.

    `p` is square-free and of opposite signs at the two ends. Refining narrows the bracket in place.
    """

    p: Any
    lower: Any
    upper: Any

    @property
    def is_rational(self) -> bool:
        return bool(self.lower == self.upper)

    def is_root_of(self, p: Any) -> bool:
        if self.is_rational:
            return not p(self.lower)
        common = self.p.gcd(p)
        return bool(common.degree() > 0 and common(self.lower) * common(self.upper) < 0)

    def halve(self) -> None:
        middle = (self.lower + self.upper) / 2
        value = self.p(middle)
        if not value:
            self.lower = self.upper = middle
        elif (value > 0) == (self.p(self.upper) > 0):
            self.upper = middle
        else:
            self.lower = middle

    def refine(self, width: Any) -> None:
        """Down to a bracket of at most this `width`, an fmpq."""
        while self.upper - self.lower > width:
            self.halve()

    def ball(self) -> Any:
        """What is known of the number, as a ball at the current precision."""
        return arb(self.lower).union(arb(self.upper))

    def compare(self, other: Point) -> int:
        """−1, 0 or 1: less, equal or greater."""
        common = self.p.gcd(other.p)
        both = common.degree() > 0 and self.is_root_of(common) and other.is_root_of(common)
        for _ in range(DEPTH):
            if self.upper < other.lower:
                return -1
            if other.upper < self.lower:
                return 1
            if self.is_rational and other.is_rational:
                return 0
            wider, narrower = (self, other) if self.upper - self.lower > other.upper - other.lower else (other, self)
            # both are roots of `common`, of which a bracket holds one at most: one inside the other's bracket is it
            if both and wider.lower <= narrower.lower and narrower.upper <= wider.upper:
                return 0
            (narrower if both and not narrower.is_rational else wider).halve()
        raise Undecidable("two numbers were not told apart")


def rational_point(value: Any) -> Point:
    return Point(polynomial(-value, 1), value, value)


def end_point(end: End) -> Point:
    """An end of a clip interval."""
    if end.value is not None:
        return rational_point(end.value)
    a, b, c = end.quadratic
    p, middle = polynomial(c, 2 * b, a), -b / a
    reach = fmpq(1)
    square = b * b / (a * a) - c / a  # of the distance from the middle
    if not square:
        return rational_point(middle)
    while reach * reach <= square:
        reach *= 2
    return Point(p, middle, middle + reach) if end.side > 0 else Point(p, middle - reach, middle)


def roots_between(p: Any, first: Point, last: Point) -> list[Point]:
    """The distinct roots of the polynomial `p`, not 0, strictly between two points, in rising order."""
    if p.degree() <= 0:
        return []
    p = p / p.gcd(p.derivative())
    lower, upper = first.lower, last.upper
    room = (upper - lower) / 61
    while not p(lower):
        lower -= room
    while not p(upper):
        upper += room
    width = upper - lower
    whole = [int(c) for c in p(polynomial(lower, width)).numer().coeffs()]
    found = []
    for bracket in brackets(*to_bernstein(whole), depth=DEPTH):
        ends = (lower + width * fmpq(e, 1 << bracket.exponent) for e in (bracket.lower, bracket.upper))
        point = Point(p, *ends)
        if point.compare(first) > 0 and point.compare(last) < 0:
            found.append(point)
    return found


def between(first: Point, last: Point) -> Any:
    """A rational strictly between two different points, the first of which is the lesser."""
    while not first.upper < last.lower:
        wider = first if first.upper - first.lower > last.upper - last.lower else last
        wider.halve()
    return first.upper + (last.lower - first.upper) * fmpq(29, 61)
