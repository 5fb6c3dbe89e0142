"""Bound the length of f's gradient over a box, through the kinks and cone points of distance functions.

A root has no bounded derivative over a ball that holds 0, so sqrt(x^2 + y^2 + z^2) has no bounded gradient in ball
arithmetic near the origin, though its gradient is 1 long. `Slopes` knows that the root of a sum of squares of u_1 … u_n
changes no faster than J^T w for a unit vector w, where the rows of J are the gradients of the u_i, and that the
gradient of log(exp(u_1) + … + exp(u_n)) is a mean of theirs, as smooth minima of distances have it.

`lipschitz` asks only whether 1 is a bound all over a domain. It proves that of kinks by structure, without boxes, and
of smooth formulas on boxes of numpy, which are about ten times as fast as these balls and know nothing of kinks.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache, reduce
from typing import Any

from surfaces.numbers import Balls
from surfaces.tape import JUMPS, Op, Tape, walk

Parts = tuple[tuple[tuple[Any, ...], float], ...]
MOST_PARTS = 24  # of a sum that is bounded by its parts: roots take the square of it
_UP = 1.0 + 2.0**-40  # covers the rounding of a few operations in float64


@dataclass(frozen=True, slots=True)
class Sloped:
    """Hold what is known of a value over a box.

    value: flint.arb
    rates: three flint.arb, the derivatives by x, y and z; where there is a kink, what lies between those of both sides
    steep: a bound of the gradient's length
    squares: (rates, steep) of u_1 … u_n, if the value is the sum of their squares and of what is constant and positive
    exponents: the same, if it is the sum of their exponentials, each times a positive constant
    """

    value: Any
    rates: tuple[Any, ...]
    steep: float
    squares: Parts | None = None
    exponents: Parts | None = None


def jumps(tape: Tape) -> list[str]:
    """Return the names of the operations on variables at which f may jump, sorted."""
    constant = tape.constants()
    return sorted({op.name for op, fixed in zip(tape.ops, constant, strict=True) if op.name in JUMPS and not fixed})


def steepest(tape: Tape, box: Mapping[str, Any]) -> float:
    """Return a bound of the gradient's length of the first output over a box of balls for x, y, z; it may be infinite.

    Raises ValueError for a tape that may jump, of which no gradient tells how fast it changes.
    """
    if found := jumps(tape):
        raise ValueError(f"f may jump: {found[0]}")
    numbers = Slopes()
    variables = {axis: numbers.variable(axis, ball) for axis, ball in box.items()}
    return float(walk(_with_whole_powers(tape), numbers, variables)[0].steep)


@cache
def _with_whole_powers(tape: Tape) -> Tape:
    """Return a tape in which a^n sqrt(a) is one power: its slope is bounded at a = 0, unlike that of its factor."""
    powers: list[tuple[int, int]] = []  # each operation as a base and a whole exponent
    ops = list(tape.ops)
    for index, op in enumerate(tape.ops):
        powers.append((index, 1))
        if op.name == "sqr":
            base, n = powers[op.args[0]]
            powers[index] = base, 2 * n
        elif op.name == "mul":
            (p, m), (q, n) = (powers[i] for i in op.args)
            powers[index] = (p, m + n) if p == q else (index, 1)
            for i, j in (op.args, op.args[::-1]):
                base, n = powers[i]
                root = tape.ops[j].args[0] if tape.ops[j].name == "sqrt" else -1
                even = n % 2 == 0 and tape.ops[root].name == "abs" and root >= 0
                if base == root or (even and base == tape.ops[root].args[0]):
                    ops[index] = Op("powr", (root, n + Fraction(1, 2)))
    return Tape(tuple(ops), tape.outputs)


class Slopes:
    """Run a tape in `Sloped` numbers, at the precision of `flint.ctx`."""

    def __init__(self) -> None:
        self.balls = Balls()
        self.zero, self.one = self.balls.const(Fraction(0)), self.balls.const(Fraction(1))

    def variable(self, axis: str, ball: Any) -> Sloped:
        """Return a coordinate that is somewhere in a ball."""
        return Sloped(ball, tuple(self.one if axis == name else self.zero for name in "xyz"), 1.0)

    def _fixed(self, value: Any) -> Sloped:
        rates = (self.zero,) * 3
        return Sloped(value, rates, 0.0, () if value >= 0 else None, ((rates, 0.0),) if value > 0 else None)

    def const(self, value: Fraction) -> Sloped:
        return self._fixed(self.balls.const(value))

    def pi(self) -> Sloped:
        return self._fixed(self.balls.pi())

    def e(self) -> Sloped:
        return self._fixed(self.balls.e())

    def _made(
        self,
        value: Any,
        rates: tuple[Any, ...],
        steep: float = math.inf,
        squares: Parts | None = None,
        exponents: Parts | None = None,
    ) -> Sloped:
        """Return a number whose gradient is bounded by `steep` and by its rates; each narrows the other."""
        steep = min(steep, _length(rates))
        if steep < math.inf:
            about = self.balls.arb(0, steep)
            rates = tuple(about if not rate.is_finite() or abs(rate).upper() > steep else rate for rate in rates)
        return Sloped(value, rates, steep, squares, exponents)

    def _chained(self, a: Sloped, value: Any, slope: Any) -> Sloped:
        """Return a function of a, from its value and its slope."""
        if a.steep == 0.0:
            return self._fixed(value)
        return self._made(value, tuple(_product(slope, rate) for rate in a.rates), _scaled(a.steep, slope) * _UP)

    def neg(self, a: Sloped) -> Sloped:
        return Sloped(-a.value, tuple(-rate for rate in a.rates), a.steep)

    def add(self, a: Sloped, b: Sloped) -> Sloped:
        rates = tuple(p + q for p, q in zip(a.rates, b.rates, strict=True))
        parts = _joined(a.squares, b.squares), _joined(a.exponents, b.exponents)
        return self._made(a.value + b.value, rates, (a.steep + b.steep) * _UP, *parts)

    def sub(self, a: Sloped, b: Sloped) -> Sloped:
        rates = tuple(p - q for p, q in zip(a.rates, b.rates, strict=True))
        return self._made(a.value - b.value, rates, (a.steep + b.steep) * _UP)

    def mul(self, a: Sloped, b: Sloped) -> Sloped:
        squares, exponents = None, None
        for factor, other in ((a, b), (b, a)):
            if factor.steep == 0.0 and factor.value > 0:
                exponents = other.exponents
                root = factor.value.sqrt()
                most = float(root.upper()) * _UP
                if other.squares is not None:
                    squares = tuple((tuple(root * r for r in rates), steep * most) for rates, steep in other.squares)
        rates = tuple(_product(p, b.value) + _product(q, a.value) for p, q in zip(a.rates, b.rates, strict=True))
        steep = _scaled(a.steep, b.value) + _scaled(b.steep, a.value)
        return self._made(a.value * b.value, rates, steep * _UP, squares, exponents)

    def div(self, a: Sloped, b: Sloped) -> Sloped:
        value = a.value / b.value
        over = 1 / b.value
        tops = (p - _product(q, value) for p, q in zip(a.rates, b.rates, strict=True))
        return self._made(value, tuple(_product(top, over) for top in tops))

    def sqr(self, a: Sloped) -> Sloped:
        made = self._chained(a, self.balls.sqr(a.value), 2 * a.value)
        return Sloped(made.value, made.rates, made.steep, ((a.rates, a.steep),))

    def powi(self, a: Sloped, n: int) -> Sloped:
        if n % 2 == 0:
            return self.sqr(self.powi(a, n // 2)) if n > 2 else self.sqr(a)
        return a if n == 1 else self.mul(a, self.powi(a, n - 1))

    def powr(self, a: Sloped, q: Fraction) -> Sloped:
        value = self.balls.powr(a.value, q)
        slope = self.balls.powr(a.value, q - 1) if q > 1 else self.balls.powr(a.value, q) / a.value
        return self._chained(a, value, self.balls.const(q) * slope)

    def sqrt(self, a: Sloped) -> Sloped:
        value = self.balls.sqrt(a.value)
        made = self._chained(a, value, 1 / (2 * value))
        return made if a.squares is None else self._made(value, made.rates, min(made.steep, _spectral(a.squares)))

    def exp(self, a: Sloped) -> Sloped:
        value = a.value.exp()
        made = self._chained(a, value, value)
        return Sloped(value, made.rates, made.steep, exponents=((a.rates, a.steep),))

    def log(self, a: Sloped) -> Sloped:
        made = self._chained(a, a.value.log(), 1 / a.value)
        if not a.exponents:
            return made
        steep = max(steep for _, steep in a.exponents)
        rates = tuple(
            reduce(lambda p, q: p.union(q), column) for column in zip(*(r for r, _ in a.exponents), strict=True)
        )
        return made if made.steep <= steep else self._made(made.value, rates, steep)

    def sin(self, a: Sloped) -> Sloped:
        return self._chained(a, a.value.sin(), a.value.cos())

    def cos(self, a: Sloped) -> Sloped:
        return self._chained(a, a.value.cos(), -a.value.sin())

    def tan(self, a: Sloped) -> Sloped:
        value = a.value.tan()
        return self._chained(a, value, 1 + value * value)

    def abs(self, a: Sloped) -> Sloped:
        made = self._chained(a, abs(a.value), self.balls.sign(a.value))
        return Sloped(made.value, made.rates, min(made.steep, a.steep))

    def min(self, a: Sloped, b: Sloped) -> Sloped:
        return self._either(a, b, self.balls.min(a.value, b.value), a.value <= b.value, b.value <= a.value)

    def max(self, a: Sloped, b: Sloped) -> Sloped:
        return self._either(a, b, self.balls.max(a.value, b.value), b.value <= a.value, a.value <= b.value)

    def _either(self, a: Sloped, b: Sloped, value: Any, first: bool, second: bool) -> Sloped:
        """Return the one of two values that it is everywhere, or what holds both."""
        if first or second:
            return a if first else b
        rates = tuple(p.union(q) for p, q in zip(a.rates, b.rates, strict=True))
        return Sloped(value, rates, max(a.steep, b.steep))


def _joined(a: Parts | None, b: Parts | None) -> Parts | None:
    """Return the parts of a sum; None if they are not known, or too many."""
    return a + b if a is not None and b is not None and len(a) + len(b) <= MOST_PARTS else None


def _scaled(steep: float, by: Any) -> float:
    """Return a bound of a slope times a ball, 0 where the slope is 0, whatever the ball."""
    return steep * _size(by) if steep else 0.0


def _product(a: Any, b: Any) -> Any:
    """Return the product of two balls, 0 where one is exactly 0, whatever the other."""
    return a if a.is_zero() else b if b.is_zero() else a * b


def _length(rates: tuple[Any, ...]) -> float:
    """Return a bound of the length of any vector in three balls."""
    return math.hypot(*(_size(rate) for rate in rates)) * _UP


def _size(ball: Any) -> float:
    """Return a bound of a ball's absolute values; it may be infinite."""
    return float(abs(ball).upper()) * _UP if ball.is_finite() else math.inf


def _spectral(squares: tuple[tuple[tuple[Any, ...], float], ...]) -> float:
    """Bound the length of J^T w for unit vectors w, where J has these rows.

    Its square is at most the largest eigenvalue of J J^T, and so at most the largest sum of absolute values in a row of
    it (Gershgorin).
    """
    most = 0.0
    for p, p_steep in squares:
        row = 0.0
        for q, q_steep in squares:
            product = sum(x * y for x, y in zip(p, q, strict=True))
            row += min(_size(product), p_steep * q_steep) * _UP
        most = max(most, row)
    return math.sqrt(most) * _UP
