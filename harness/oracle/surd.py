"""Compute with exact polynomials in t over Q(√d): a + b·√d, with a and b in Q[t], and d a square-free integer or 0.

d is 0 for plain rationals. These polynomials serve every surface whose coefficients are rational or lie in one
quadratic field, such as Barth's with the golden ratio or Endraß's with √2. Other constants raise NotExact; the oracle
then uses balls.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import gcd
from typing import Any

from flint import arb, arb_poly, fmpq, fmpq_poly, fmpz

from harness.oracle.program import Functions, Leaf

ZERO = fmpq_poly(0)


class NotExact(Exception):
    """Report that a number does not lie in one quadratic field."""


class Surd:
    """Hold a polynomial a + b·√d; `a` and `b` are fmpq_poly."""

    __slots__ = ("a", "b", "d")

    def __init__(self, a: Any, b: Any = ZERO, d: int = 0) -> None:
        self.a = fmpq_poly(a)
        self.b = fmpq_poly(b)
        self.d = d if self.b else 0

    def field(self, other: Surd) -> int:
        """Return d of the field that holds both. Raises NotExact if there is none."""
        if self.d and other.d and self.d != other.d:
            raise NotExact(f"√{self.d} beside √{other.d}")
        return self.d or other.d

    def __add__(self, other: Surd) -> Surd:
        return Surd(self.a + other.a, self.b + other.b, self.field(other))

    def __sub__(self, other: Surd) -> Surd:
        return Surd(self.a - other.a, self.b - other.b, self.field(other))

    def __neg__(self) -> Surd:
        return Surd(-self.a, -self.b, self.d)

    def __mul__(self, other: Surd) -> Surd:
        if self.d and other.d and self.d != other.d and not self.a and not other.a:  # √2·√6 is 2·√3
            common = gcd(self.d, other.d)
            return Surd(0, common * self.b * other.b, self.d * other.d // common**2)
        d = self.field(other)
        if not d:
            return Surd(self.a * other.a)
        return Surd(self.a * other.a + d * self.b * other.b, self.a * other.b + self.b * other.a, d)

    def __truediv__(self, other: Surd) -> Surd:
        """Divide by a constant. Raises NotExact for any other divisor, and for 0."""
        if other.a.degree() > 0 or other.b.degree() > 0:
            raise NotExact("division by a polynomial")
        norm = (other.a * other.a - other.d * other.b * other.b)[0]
        if not norm:
            raise NotExact("division by zero")
        product = self * Surd(other.a, -other.b, other.d)
        return Surd(product.a / norm, product.b / norm, product.d)

    def conjugate(self) -> Surd:
        """Return a − b·√d."""
        return Surd(self.a, -self.b, self.d)

    @property
    def is_zero(self) -> bool:
        """Return whether the polynomial is 0."""
        return not self.a and not self.b

    def ball(self) -> Any:
        """Return the value as an arb_poly at the current precision."""
        return arb_poly(self.a) + arb_poly(self.b) * arb(self.d).sqrt()


def leaf(value: Leaf) -> Surd:
    """Return a rational number as a surd. Raises NotExact for pi and e."""
    if not isinstance(value, Fraction):
        raise NotExact(value)
    return Surd(fmpq(value.numerator, value.denominator))


def sqrt(value: Surd) -> Surd:
    """Return the square root of a non-negative rational constant. Raises NotExact for anything else."""
    if value.d or value.a.degree() > 0 or value.a[0] < 0:
        raise NotExact("nested root")
    number = value.a[0]
    square, free = fmpz(1), 1
    for prime, exponent in (number.p * number.q).factor() if number else []:
        square *= prime ** (exponent // 2)
        free *= int(prime) ** (exponent % 2)
    root = fmpq(square, number.q)
    return Surd(root if number else 0) if free == 1 else Surd(0, root, free)


def _outside(*_: Surd) -> Surd:
    """Raise NotExact: the function leads out of the field."""
    raise NotExact("an elementary function")


FUNCTIONS: Functions = {
    **dict.fromkeys(("exp", "log", "sin", "cos", "tan", "abs", "min", "max"), _outside),
    **dict.fromkeys(("floor", "powr", "atan2", "below", "select"), _outside),
    "sqrt": sqrt,
}


@dataclass(frozen=True)
class Split:
    """Hold an exact polynomial p = g·q in the form in which roots are isolated.

    g is rational, and q is coprime to its conjugate.

    `carrier` is square-free over Q. It vanishes at every root of p, and perhaps at roots of the conjugate of q.
    """

    carrier: Any  # fmpq_poly
    rational: tuple[tuple[Any, int], ...]  # square-free factors of g, with multiplicity
    norms: tuple[tuple[Any, int], ...]  # square-free factors of q·conjugate(q), with multiplicity
    q: Surd


def split(p: Surd) -> Split:
    """Return the split of a polynomial p, which must not be zero.

    **Theory.** With p = a + b√d and g = gcd(a, b), q = p/g has coprime a/g and b/g, so that q and its conjugate share
    no root. The norm q·q̄ is rational and has each root of q with the multiplicity that it has in q.
    """
    g = p.a.gcd(p.b)
    q = Surd(p.a / g, p.b / g, p.d)
    norm = q.a * q.a - p.d * q.b * q.b
    rational = _square_free_factors(g)
    norms = _square_free_factors(norm) if p.d else ()
    product = g * norm if p.d else g
    return Split(product / product.gcd(product.derivative()), rational, norms, q)


def _square_free_factors(p: Any) -> tuple[tuple[Any, int], ...]:
    """Return the square-free factors of an fmpq_poly with their multiplicities."""
    if p.degree() <= 0:
        return ()
    _, factors = p.numer().factor_squarefree()
    return tuple((fmpq_poly(f), int(m)) for f, m in factors)
