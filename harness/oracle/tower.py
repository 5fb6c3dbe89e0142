"""Compute with exact functions of t, built from rational polynomials by sums, products and square roots.

**Theory.** A tower is a list of radicals r_k = √g_k, where g_k is written in rational polynomials of t and earlier
radicals. An element can be written as e = a + b·r_k, where r_k is the last radical that it holds. e times its conjugate
a − b·r_k is a² − b²·g_k, which does not hold r_k. Repeated, this leads to a rational polynomial that vanishes wherever
e does. A cell is an open interval of t on which every g_k is positive. There elements are analytic functions, and a
product is identically 0 only if a factor is. So if a² − b²·g_k vanishes identically, e or its conjugate does; if a does
not, only one of the two does, and a value other than 0 tells which. The same argument at a single number t, where
elements are real numbers, decides whether e is 0 there. Constants such as √2 are radicals too.
"""

from __future__ import annotations

from typing import Any

from flint import arb, arb_poly, fmpq, fmpq_poly

from harness.oracle.bernstein import Undecidable
from harness.oracle.points import Point, between
from harness.oracle.reals import precision, root

Element = dict[int, Any]  # by bit masks, which are sets of radicals: the fmpq_poly, not 0, that their product has
PRECISIONS = (96, 384, 1536)
MOST_RADICALS = 12  # of one function; with more, its polynomials become too large
SAMPLES = 8  # points of a cell that are tried if a function is nearly 0


def constant(value: Any) -> Element:
    """Return a rational as an element."""
    return {0: fmpq_poly([value])} if value else {}


def add(x: Element, y: Element) -> Element:
    """Return the sum."""
    result = dict(x)
    for mask, p in y.items():
        total = result[mask] + p if mask in result else p
        if total:
            result[mask] = total
        else:
            del result[mask]
    return result


def neg(x: Element) -> Element:
    """Return the opposite."""
    return {mask: -p for mask, p in x.items()}


def parted(x: Element) -> tuple[Element, Element, int]:
    """Return a, b and k of x = a + b·r_k; x must hold a radical."""
    k = max(x).bit_length() - 1
    return (
        {mask: p for mask, p in x.items() if not mask >> k & 1},
        {mask ^ (1 << k): p for mask, p in x.items() if mask >> k & 1},
        k,
    )


class Tower:
    """Hold the radicals on one cell, and answer exactly about elements there."""

    def __init__(self, first: Point, last: Point) -> None:
        self.first = first
        self.last = last
        self.squares: list[Element] = []
        self.sample = between(first, last)

    def mul(self, x: Element, y: Element) -> Element:
        """Return the product."""
        result: Element = {}
        for m, p in x.items():
            for n, q in y.items():
                term: Element = {m ^ n: p * q}
                for k in range((m & n).bit_length()):
                    if (m & n) >> k & 1:
                        term = self.mul(term, self.squares[k])
                result = add(result, term)
        return result

    def radical(self, square: Element) -> Element:
        """Return √square, where `square` is positive on the cell. Raises Undecidable beyond MOST_RADICALS."""
        if square not in self.squares:
            if len(self.squares) == MOST_RADICALS:
                raise Undecidable("too many roots")
            self.squares.append(square)
        return {1 << self.squares.index(square): fmpq_poly([1])}

    def norm(self, x: Element) -> Element:
        """Return x times its conjugate, which does not hold x's last radical."""
        a, b, k = parted(x)
        return add(self.mul(a, a), neg(self.mul(self.mul(b, b), self.squares[k])))

    def conjugate(self, x: Element) -> Element:
        """Return a − b·r_k of x = a + b·r_k."""
        a, b, k = parted(x)
        return add(a, neg({mask | 1 << k: p for mask, p in b.items()}))

    def ball(self, x: Element, t: Any) -> Any:
        """Return x at the ball `t` in the closed cell, as a ball at the current precision."""
        radicals = {0: arb(1)}
        for k, square in enumerate(self.squares):
            if x and max(x) >> k:
                radicals[1 << k] = root(_sum(square, radicals, t))
        return _sum(x, radicals, t)

    def zeros(self, x: Element) -> Any:
        """Return a fmpq_poly, not 0, that vanishes wherever x does on the cell; None if x is 0 all over the cell."""
        if not x:
            return None
        if max(x) == 0:
            return x[0]
        p = self.zeros(self.norm(x))
        if p is not None:
            return p
        a = parted(x)[0]
        of_a = self.zeros(a)
        if of_a is None or not self._is_not_conjugate(x):
            return None
        return of_a  # the conjugate is 0 all over, so that x = 2a

    def _is_not_conjugate(self, x: Element) -> bool:
        """Return whether it is x's conjugate that is 0 all over the cell, and not x; exactly one of them must be.

        Raises Undecidable if neither is proved to have another value.
        """
        other = self.conjugate(x)
        for k in range(SAMPLES):
            at = self.sample + (self.last.lower - self.sample) * fmpq(k, SAMPLES + 1)
            for bits in PRECISIONS[:2]:
                with precision(bits):
                    if not self.ball(x, arb(at)).contains(0):
                        return True
                    if not self.ball(other, arb(at)).contains(0):
                        return False
        raise Undecidable("a function was not told from its conjugate")

    def sign(self, x: Element) -> int:
        """Return the sign of x, which must have no root in the cell. Raises Undecidable if no precision tells."""
        for bits in PRECISIONS:
            with precision(bits):
                value = self.ball(x, arb(self.sample))
                if not value.contains(0):
                    return 1 if value > 0 else -1
        raise Undecidable("a sign was not found")

    def vanishes_at(self, x: Element, t: Point) -> bool:
        """Return whether x is 0 at a point of the closed cell. Raises Undecidable if no precision tells."""
        if not x:
            return True
        if max(x) == 0:
            return t.is_root_of(x[0])
        if not self._may_vanish(x, t, PRECISIONS[0]):
            return False
        a, _, k = parted(x)
        if self.vanishes_at(self.squares[k], t):
            return self.vanishes_at(a, t)
        if not self.vanishes_at(self.norm(x), t):
            return False
        if self.vanishes_at(a, t):
            return True
        other = self.conjugate(x)  # a is not 0, so that exactly one of x and its conjugate is 0
        for bits in PRECISIONS:
            if not self._may_vanish(x, t, bits):
                return False
            if not self._may_vanish(other, t, bits):
                return True
        raise Undecidable("a number was not told from its conjugate")

    def _may_vanish(self, x: Element, t: Point, bits: int) -> bool:
        """Return whether balls of `bits` leave open that x is 0 at a point."""
        t.refine(fmpq(1, 1 << (bits // 2)))
        with precision(bits):
            return bool(self.ball(x, t.ball()).contains(0))


class PointTower(Tower):
    """Hold radicals of numbers that are not negative at one point, and answer exactly about elements there."""

    def __init__(self, point: Point) -> None:
        self.first = self.last = point
        self.squares = []

    def sign_at(self, x: Element, t: Point) -> int:
        """Return the sign of an element that is not 0 at the point. Raises Undecidable if no precision tells."""
        for bits in PRECISIONS:
            t.refine(fmpq(1, 1 << bits))
            with precision(bits):
                value = self.ball(x, t.ball())
                if not value.contains(0):
                    return 1 if value > 0 else -1
        raise Undecidable("a sign was not found")


def _sum(x: Element, radicals: dict[int, Any], t: Any) -> Any:
    """Return x at the ball `t`, given the radicals' values there."""
    total = arb(0)
    for mask, p in x.items():
        term = arb_poly(p)(t)
        for k in range(mask.bit_length()):
            if mask >> k & 1:
                term = term * radicals[1 << k]
        total += term
    return total
