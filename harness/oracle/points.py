"""Compute with exact real algebraic numbers: rationals, and roots of rational polynomials, each in a bracket."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from flint import arb, fmpq, fmpq_poly

from harness.oracle.bernstein import Undecidable, brackets, to_bernstein
from harness.oracle.clip import End

DEPTH = 4096  # bits after which two numbers that are not told apart are given up


def polynomial(*coefficients: Any) -> Any:
    """Return the fmpq_poly of these coefficients, the lowest first."""
    return fmpq_poly(list(coefficients))


@dataclass(eq=False)
class Point:
    """Hold a number in [lower, upper], which is lower itself if both are equal, else the only root of `p` between them.

    `p` is a square-free fmpq_poly with opposite signs at the two ends, which are fmpq. Refining narrows the bracket of
    this very object.
    """

    p: Any
    lower: Any
    upper: Any

    @property
    def is_rational(self) -> bool:
        """Return whether the number is known to be rational."""
        return bool(self.lower == self.upper)

    def is_root_of(self, p: Any) -> bool:
        """Return whether the polynomial `p` vanishes at the number."""
        if self.is_rational:
            return not p(self.lower)
        common = self.p.gcd(p)
        return bool(common.degree() > 0 and common(self.lower) * common(self.upper) < 0)

    def halve(self) -> None:
        """Halve the bracket."""
        middle = (self.lower + self.upper) / 2
        value = self.p(middle)
        if not value:
            self.lower = self.upper = middle
        elif (value > 0) == (self.p(self.upper) > 0):
            self.upper = middle
        else:
            self.lower = middle

    def refine(self, width: Any) -> None:
        """Halve the bracket until it has at most this `width`, an fmpq."""
        while self.upper - self.lower > width:
            self.halve()

    def ball(self) -> Any:
        """Return the bracket as a ball (flint.arb) at the current precision."""
        return arb(self.lower).union(arb(self.upper))

    def compare(self, other: Point) -> int:
        """Return −1, 0 or 1: less, equal or greater. Raises Undecidable if DEPTH bits do not tell."""
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
            # if both are roots of `common`, a bracket holds only one of its roots: a number inside the other's is that
            if both and wider.lower <= narrower.lower and narrower.upper <= wider.upper:
                return 0
            (narrower if both and not narrower.is_rational else wider).halve()
        raise Undecidable("two numbers were not told apart")


def rational_point(value: Any) -> Point:
    """Return an fmpq as a point."""
    return Point(polynomial(-value, 1), value, value)


def end_point(end: End) -> Point:
    """Return an end of a clip interval as a point."""
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
    """Return the distinct roots of a polynomial `p`, which is not 0, strictly between two points, in rising order."""
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
    """Return a rational strictly between two different points, of which the first is the lesser."""
    while not first.upper < last.lower:
        wider = first if first.upper - first.lower > last.upper - last.lower else last
        wider.halve()
    return first.upper + (last.lower - first.upper) * fmpq(29, 61)
