"""Define number systems that run a tape: certified balls, polynomials of balls, and sympy expressions.

Each has a method for each operation of `surfaces.tape`. Balls need python-flint, Symbols need sympy; both are imported
when they are first used. The system of numpy floats is in `evaluation`, so that parsing a formula needs no numpy. Their
numbers have no types here, since neither library states any.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any


class Arithmetic:
    """Define the operations that number systems with Python operators share."""

    def add(self, a: Any, b: Any) -> Any:
        return a + b

    def sub(self, a: Any, b: Any) -> Any:
        return a - b

    def mul(self, a: Any, b: Any) -> Any:
        return a * b

    def div(self, a: Any, b: Any) -> Any:
        return a / b

    def neg(self, a: Any) -> Any:
        return -a

    def sqr(self, a: Any) -> Any:
        return a * a

    def powi(self, a: Any, n: int) -> Any:
        """Return a to the power n by squaring, n >= 1."""
        if n == 1:
            return a
        half = self.sqr(self.powi(a, n // 2))
        return self.mul(half, a) if n % 2 else half


class Balls(Arithmetic):
    """Run a tape in flint.arb, at the precision of `flint.ctx`.

    Every result holds the exact values for all points of its inputs.
    """

    def __init__(self) -> None:
        import flint

        self.arb: Any = flint.arb
        self.fmpq: Any = flint.fmpq

    def const(self, value: Fraction) -> Any:
        return self.arb(self.fmpq(value.numerator, value.denominator))

    def pi(self) -> Any:
        return self.arb.pi()

    def e(self) -> Any:
        return self.arb.const_e()

    def sqr(self, a: Any) -> Any:
        # the product of a ball about zero with itself reaches as far below zero as above; a square does not
        square = a * a
        return square.nonnegative_part() if square.contains(0) else square

    def abs(self, a: Any) -> Any:
        return abs(a)

    def min(self, a: Any, b: Any) -> Any:
        return a.min(b)

    def max(self, a: Any, b: Any) -> Any:
        return a.max(b)

    def sqrt(self, a: Any) -> Any:
        # rounding may take a sum of squares slightly below zero: the root is taken of the part that is not negative
        return a.nonnegative_part().sqrt() if a.contains(0) else a.sqrt()

    def exp(self, a: Any) -> Any:
        return a.exp()

    def log(self, a: Any) -> Any:
        return a.log()

    def sin(self, a: Any) -> Any:
        return a.sin()

    def cos(self, a: Any) -> Any:
        return a.cos()

    def tan(self, a: Any) -> Any:
        return a.tan()

    def sign(self, a: Any) -> Any:
        return self.arb(1) if a >= 0 else self.arb(-1) if a < 0 else self.arb(0, 1)

    def below(self, a: Any, b: Any) -> Any:
        return self.arb(1) if a <= b else self.arb(0) if a > b else self.arb("0.5", "0.5")

    def select(self, c: Any, p: Any, q: Any) -> Any:
        return p if c >= 1 else q if c <= 0 else p.union(q)

    def floor(self, a: Any) -> Any:
        return a.floor()

    def powr(self, a: Any, q: Fraction) -> Any:
        # as sqrt: of the part that is not negative, between the powers of its ends
        exponent = self.const(q)
        low, high = a.lower(), a.upper()
        if high < 0:
            return a.log()  # NaN
        most = high**exponent if high > 0 else high
        return (low**exponent).union(most) if low > 0 else self.arb(0).union(most)

    def atan2(self, a: Any, b: Any) -> Any:
        return self.arb.atan2(a, b)


class BallPolynomials(Balls):
    """Run a tape in flint.arb_poly; constants stay balls. With x, y, z as polynomials in t it gives f along a ray.

    It is only for tapes that are built as polynomials (`surfaces.formula.is_polynomial`).
    """

    def sqr(self, a: Any) -> Any:
        return super().sqr(a) if isinstance(a, self.arb) else a * a

    def div(self, a: Any, b: Any) -> Any:
        return a / b if isinstance(a, self.arb) else a * (1 / b)


class Symbols(Arithmetic):
    """Run a tape in sympy expressions. abs, min and max stay unevaluated: simplifying them can take forever."""

    def __init__(self) -> None:
        import sympy

        self.sympy: Any = sympy

    def const(self, value: Fraction) -> Any:
        return self.sympy.Rational(value.numerator, value.denominator)

    def pi(self) -> Any:
        return self.sympy.pi

    def e(self) -> Any:
        return self.sympy.E

    def sqr(self, a: Any) -> Any:
        return a**2

    def powi(self, a: Any, n: int) -> Any:
        return a**n

    def abs(self, a: Any) -> Any:
        return self.sympy.Abs(a, evaluate=False)

    def min(self, a: Any, b: Any) -> Any:
        return self.sympy.Min(a, b, evaluate=False)

    def max(self, a: Any, b: Any) -> Any:
        return self.sympy.Max(a, b, evaluate=False)

    def sqrt(self, a: Any) -> Any:
        return self.sympy.sqrt(a)

    def exp(self, a: Any) -> Any:
        return self.sympy.exp(a)

    def log(self, a: Any) -> Any:
        return self.sympy.log(a)

    def sin(self, a: Any) -> Any:
        return self.sympy.sin(a)

    def cos(self, a: Any) -> Any:
        return self.sympy.cos(a)

    def tan(self, a: Any) -> Any:
        return self.sympy.tan(a)

    def floor(self, a: Any) -> Any:
        return self.sympy.floor(a)

    def powr(self, a: Any, q: Fraction) -> Any:
        return a ** self.const(q)

    def atan2(self, a: Any, b: Any) -> Any:
        return self.sympy.atan2(a, b)

    def sign(self, a: Any) -> Any:
        return self.sympy.Piecewise((1, a >= 0), (-1, True))

    def below(self, a: Any, b: Any) -> Any:
        return self.sympy.Piecewise((1, a <= b), (0, True))

    def select(self, c: Any, p: Any, q: Any) -> Any:
        return self.sympy.Piecewise((p, c > 0), (q, True))


def fractions_of(ball: Any) -> tuple[Fraction, Fraction]:
    """Return exact bounds of a flint.arb at the precision of `flint.ctx`.

    Raises OverflowError past 2^1100. A bound closer to zero than 2^-1100 is replaced by that number, or by zero.
    """
    return _bound(ball.lower(), -1), _bound(ball.upper(), 1)


def _bound(exact: Any, outward: int) -> Fraction:
    """Return an exact flint.arb as a fraction, rounded to the side `outward`, −1 or 1, if it is tiny.

    Raises OverflowError past 2^1100.
    """
    mantissa, exponent = (int(part) for part in exact.man_exp())
    size = mantissa.bit_length() + exponent
    if size > 1100:
        raise OverflowError("past 2^1100")
    if mantissa and size < -1100:
        return Fraction(outward, 2**1100) if mantissa * outward > 0 else Fraction(0)
    return Fraction(mantissa) * Fraction(2) ** exponent
