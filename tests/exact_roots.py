"""Find roots of polynomials in one variable exactly, by Sturm's theorem in whole numbers of Python.

It stands beside the oracle to hold it against something else, and shares nothing with it: no bounds, no Bernstein
coefficients, no balls, no library.

**Theory.** s is the square-free product of all polynomials whose signs matter. Between two neighbouring roots of s none
of them changes its sign, and at a root of s each is 0 or has the sign that it has beside the root. Sturm's chain counts
the roots of s in an interval, so that halving parts them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import gcd

Signs = tuple[int, ...]


class Poly:
    """Hold a polynomial with rational coefficients: whole `num`, the lowest first and the last not 0, over `den`."""

    __slots__ = ("den", "num")

    def __init__(self, num: Sequence[int], den: int = 1) -> None:
        num = list(num)
        while num and not num[-1]:
            num.pop()
        common = gcd(den, *num)
        self.num = [c // common for c in num]
        self.den = den // common

    def __add__(self, other: Poly) -> Poly:
        n = max(len(self.num), len(other.num))
        a, b = (list(p.num) + [0] * (n - len(p.num)) for p in (self, other))
        return Poly([x * other.den + y * self.den for x, y in zip(a, b, strict=True)], self.den * other.den)

    def __neg__(self) -> Poly:
        return Poly([-c for c in self.num], self.den)

    def __sub__(self, other: Poly) -> Poly:
        return self + -other

    def __mul__(self, other: Poly) -> Poly:
        result = [0] * max(len(self.num) + len(other.num) - 1, 0)
        for i, a in enumerate(self.num):
            for j, b in enumerate(other.num):
                result[i + j] += a * b
        return Poly(result, self.den * other.den)

    def __pow__(self, n: int) -> Poly:
        result = Poly([1])
        for _ in range(n):
            result = result * self
        return result

    def sign(self, t: Fraction) -> int:
        """Return the sign of the value at `t`."""
        return _sign(self.num, t)


def constant(value: Fraction | int) -> Poly:
    """Return a rational number as a polynomial."""
    value = Fraction(value)
    return Poly([value.numerator], value.denominator)


def linear(at_zero: Fraction, slope: Fraction) -> Poly:
    """Return at_zero + slope·t."""
    return constant(at_zero) + constant(slope) * Poly([0, 1])


def _sign(num: Sequence[int], t: Fraction) -> int:
    total, n, d, power = 0, t.numerator, t.denominator, 1
    for c in reversed(num):  # Horner's rule, times d^degree
        total = total * n + c * power
        power *= d
    return (total > 0) - (total < 0)


def _primitive(num: Sequence[int]) -> list[int]:
    common = gcd(*num) if num else 1
    return [c // common for c in num] if common > 1 else list(num)


def _remainder(a: Sequence[int], b: Sequence[int]) -> list[int]:
    """Return a positive multiple of the remainder of a / b, without common factors."""
    rest, top = list(a), abs(b[-1])
    while len(rest) >= len(b):
        factor, shift = rest[-1] * (1 if b[-1] > 0 else -1), len(rest) - len(b)
        rest = [c * top for c in rest]
        for i, c in enumerate(b):
            rest[i + shift] -= factor * c
        while rest and not rest[-1]:
            rest.pop()
    return _primitive(rest)


def _divided(a: Sequence[int], b: Sequence[int]) -> list[int]:
    """Return a / b, which must leave no rest, up to a positive factor."""
    rest, result = [Fraction(c) for c in a], [Fraction(0)] * (len(a) - len(b) + 1)
    for shift in range(len(a) - len(b), -1, -1):
        result[shift] = rest[shift + len(b) - 1] / b[-1]
        for i, c in enumerate(b):
            rest[i + shift] -= result[shift] * c
    assert not any(rest), "the division leaves a rest"
    scale = 1
    for c in result:
        scale = scale * c.denominator // gcd(scale, c.denominator)
    return _primitive([int(c * scale) for c in result])


def _chain(num: Sequence[int]) -> list[list[int]]:
    """Return Sturm's chain of a polynomial; its last element is the greatest common divisor with the derivative."""
    chain = [_primitive(num), _primitive([i * c for i, c in enumerate(num)][1:])]
    while chain[-1]:
        chain.append([-c for c in _remainder(chain[-2], chain[-1])])
    return chain[:-1]


def _square_free(num: Sequence[int]) -> tuple[list[int], list[list[int]]]:
    """Return a polynomial with each root of `num` once, and its chain."""
    chain = _chain(num)
    if len(chain[-1]) == 1:
        return chain[0], chain
    num = _divided(chain[0], chain[-1])
    return num, _chain(num)


def _changes(chain: Sequence[Sequence[int]], t: Fraction) -> int:
    signs = [s for s in (_sign(p, t) for p in chain) if s]
    return sum(a != b for a, b in pairwise(signs))


@dataclass
class Hit:
    """Hold the first root: the only one of `s` in the open interval from `low` to `high`, and whether f crosses 0."""

    s: list[int]
    low: Fraction
    high: Fraction
    crosses: bool

    def at_least(self, t: Fraction) -> bool:
        """Return whether the root is not under `t`."""
        return t <= self.low or (t < self.high and _sign(self.s, t) in (0, _sign(self.s, self.low)))

    def at_most(self, t: Fraction) -> bool:
        """Return whether the root is not above `t`."""
        return t >= self.high or (t > self.low and _sign(self.s, t) in (0, _sign(self.s, self.high)))


def first_hit(
    parts: Sequence[Poly], sign: Callable[[Signs], int], inside: Sequence[Poly], low: Fraction, high: Fraction
) -> Hit | None:
    """Return where f is 0 first, or begins to be 0, while all of `inside` are not negative; None where it never is.

    `sign` returns f's sign where the `parts` have these signs. `low` and `high` lie before and behind all that is
    inside.
    """
    everything = [*parts, *inside]
    single = [_square_free(p.num)[0] if len(p.num) > 2 else p.num for p in everything]
    s = Poly([1])
    for num in {tuple(_primitive(n)) for n in single if len(n) > 1}:
        s = s * Poly(num)
    if len(s.num) < 2:
        return None  # nothing bounds the ray, so that nothing is inside
    num, chain = _square_free(s.num)

    def signs_at(t: Fraction) -> Signs:
        return tuple(p.sign(t) for p in everything)

    def hit(signs: Signs) -> bool:
        return min(signs[len(parts) :]) >= 0 and sign(signs[: len(parts)]) == 0

    for first, last in _isolated(num, chain, low, high):
        before, behind = signs_at(first), signs_at(last)
        root = [_sign(n, first) * _sign(n, last) < 0 for n in single]
        at = tuple(0 if zero else known for zero, known in zip(root, before, strict=True))
        if hit(at):
            sides = sign(before[: len(parts)]), sign(behind[: len(parts)])
            return Hit(num, first, last, sides[0] * sides[1] < 0)
        if hit(behind):  # f is 0 from here on, and not here: this is where its roots begin
            return Hit(num, first, last, False)
    return None


def _isolated(
    num: list[int], chain: list[list[int]], low: Fraction, high: Fraction
) -> Iterator[tuple[Fraction, Fraction]]:
    """Yield open intervals with one root each, in rising order; no end is a root."""
    room = (high - low) / 64
    while not _sign(num, low):
        low -= room
    while not _sign(num, high):
        high += room
    stack = [(low, high, _changes(chain, low), _changes(chain, high))]
    while stack:
        low, high, at_low, at_high = stack.pop()
        if at_low - at_high == 1:
            yield low, high
        elif at_low > at_high:
            share = Fraction(1, 2)
            while not _sign(num, middle := low + (high - low) * share):
                share *= Fraction(15, 16)
            at_middle = _changes(chain, middle)
            stack += [(middle, high, at_middle, at_high), (low, middle, at_low, at_middle)]
