"""Isolate real roots of a polynomial on [0, 1] by Bernstein subdivision in exact integers.

**Theory.** A polynomial has at most as many roots in (u, v), counted with multiplicity, as its Bernstein coefficients
on [u, v] have sign changes, and the two numbers differ by an even number (Descartes' rule in Bernstein form; Lane and
Riesenfeld 1981). So no sign change proves that there is no root, and one proves that there is one simple root.
Coefficients are integers with an error of at most ±`error`; a coefficient has a sign only if it is larger than that. De
Casteljau's algorithm with weights a / 2^k is exact once its results are scaled by 2^(k·degree), and averaging never
enlarges the error.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from math import comb, lcm

SPLITS = ((1, 1), (5, 3), (11, 4), (19, 5), (45, 6))  # a and k of the split points a / 2^k that are tried


class Undecidable(Exception):
    """Report that numbers are not known well enough to decide; more precision may help."""


@dataclass(frozen=True)
class Bracket:
    """State an open interval (lower, upper) / 2^exponent that holds one simple root and no other; no end is a root."""

    lower: int
    upper: int
    exponent: int
    rising: bool  # whether the polynomial is negative at the lower end and positive at the upper one


@cache
def _weights(degree: int) -> tuple[int, tuple[int, ...]]:
    """Return the least common multiple of the binomials C(degree, j), and it divided by each of them."""
    scale = lcm(*(comb(degree, j) for j in range(degree + 1)))
    return scale, tuple(scale // comb(degree, j) for j in range(degree + 1))


def to_bernstein(power: Sequence[int], error: int = 0) -> tuple[list[int], int]:
    """Return Bernstein coefficients on [0, 1], times a common factor, and a bound of their errors.

    `power` holds the coefficients of the powers, the lowest first, and `error` bounds the sum of their errors. The
    result is b_i = Σ_j C(i, j) p_j / C(n, j), computed by repeated sums.
    """
    scale, weights = _weights(len(power) - 1)
    row = [p * w for p, w in zip(power, weights, strict=True)]
    result = []
    for last in range(len(row) - 1, -1, -1):
        result.append(row[0])
        for j in range(last):
            row[j] += row[j + 1]
    return result, error * scale


def split(b: Sequence[int], a: int, k: int) -> tuple[list[int], list[int]]:
    """Return the coefficients left and right of a / 2^k, both times 2^(k·degree)."""
    degree = len(b) - 1
    c = (1 << k) - a
    row = list(b)
    left, right = [row[0] << (k * degree)], [row[-1] << (k * degree)]
    for level in range(1, degree + 1):
        row = [p + q for p, q in pairwise(row)] if k == 1 else [c * p + a * q for p, q in pairwise(row)]
        shift = k * (degree - level)
        left.append(row[0] << shift)
        right.append(row[-1] << shift)
    right.reverse()
    return left, right


def _one_change(b: Sequence[int], error: int) -> bool:
    """Return whether the coefficients have exactly one sign change, whatever their errors up to `error`.

    Then the signs are +…0…− or −…0…+, where 0 is any that is not known.
    """
    rising = b[0] < 0
    last = 1
    for value in b:
        if rising:
            value = -value
        sign = 1 if value > error else -1 if value < -error else 0
        if sign > last:
            return False
        last = sign
    return last < 0


def brackets(b: list[int], error: int, depth: int) -> Iterator[Bracket]:
    """Yield a bracket for each root in [0, 1], in rising order; roots are searched only as far as the caller asks.

    Raises Undecidable if the sign at an end of [0, 1] or at every split point tried is not known, or if intervals
    become smaller than 2^-depth.
    """
    if abs(b[0]) <= error or abs(b[-1]) <= error:
        raise Undecidable("the polynomial may vanish at an end")
    stack = [(0, 1, 0, b, error)]
    while stack:
        lower, upper, exponent, b, error = stack.pop()
        if min(b) > error or max(b) < -error:
            continue
        if _one_change(b, error):
            yield Bracket(lower, upper, exponent, b[0] < 0)
            continue
        if (upper - lower) << depth < 1 << exponent:
            raise Undecidable("intervals became too small")
        for a, k in SPLITS:
            left, right = split(b, a, k)
            scaled = error << (k * (len(b) - 1))
            if abs(right[0]) > scaled:
                break
        else:
            raise Undecidable("the polynomial may vanish at every split point")
        middle = (lower << k) + a * (upper - lower)
        stack.append((middle, upper << k, exponent + k, right, scaled))
        stack.append((lower << k, middle, exponent + k, left, scaled))
