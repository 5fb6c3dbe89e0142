"""The oracle against Sturm's theorem in exact integers, on random formulas and on multiple and nearly multiple roots.

The reference here shares nothing with the oracle: it expands f along the ray in Python's own fractions and counts
distinct roots by Sturm sequences, multiplicities by repeated greatest common divisors.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise
from math import comb, gcd, isqrt, lcm

import numpy as np
import pytest

import surfaces
from harness.contract import Box, Surface, TruthStatus
from harness.oracle import first_hits
from harness.oracle.bernstein64 import BernsteinIsolator
from harness.oracle.enclosure import Enclosure
from harness.oracle.program import compile_tape
from harness.oracle.slow import AlgebraicSolver

Poly = list[int]  # lowest power first, no trailing zero
Interval = tuple[Fraction, Fraction]


def trimmed(p: Iterable[int]) -> Poly:
    """Drop zeros at the end and the common factor of all coefficients."""
    p = list(p)
    while p and p[-1] == 0:
        p.pop()
    content = gcd(*p) if p else 1
    return [c // content for c in p]


def remainder(a: Poly, b: Poly) -> Poly:
    """Return a positive multiple of a mod b."""
    a = list(a)
    while len(a) >= len(b):
        lead, shift = a[-1], len(a) - len(b)
        scale = abs(b[-1])
        a = [c * scale for c in a]
        factor = lead if b[-1] > 0 else -lead
        for i, c in enumerate(b):
            a[shift + i] -= factor * c
        a.pop()
    return trimmed(a)


def derivative(p: Poly) -> Poly:
    return trimmed(i * c for i, c in enumerate(p) if i)


def common(a: Poly, b: Poly) -> Poly:
    """Return a greatest common divisor of a and b."""
    while b:
        a, b = b, remainder(a, b)
    return a


def quotient(a: Poly, b: Poly) -> Poly:
    """Return a / b, times a positive constant; b divides a."""
    rest, result = [Fraction(c) for c in a], [Fraction(0)] * (len(a) - len(b) + 1)
    for k in reversed(range(len(result))):
        result[k] = rest[k + len(b) - 1] / b[-1]
        for i, c in enumerate(b):
            rest[k + i] -= result[k] * c
    return integral(result)


def integral(p: Sequence[Fraction]) -> Poly:
    """Return p times the positive constant that makes its coefficients whole and without a common factor."""
    scale = lcm(*(c.denominator for c in p))
    return trimmed(int(c * scale) for c in p)


def value(p: Poly, t: Fraction) -> Fraction:
    """Return p(t)."""
    result = Fraction(0)
    for c in reversed(p):
        result = result * t + c
    return result


class Roots:
    """Count the distinct real roots of p on intervals."""

    def __init__(self, p: Poly) -> None:
        self.p = quotient(p, common(p, derivative(p))) if len(p) > 1 else p
        self.chain = [self.p, derivative(self.p)]
        while self.chain[-1]:
            self.chain.append([-c for c in remainder(self.chain[-2], self.chain[-1])])
        self.chain.pop()

    def changes(self, t: Fraction) -> int:
        """Return the number of changes of sign in the Sturm chain at t."""
        signs = [v > 0 for q in self.chain if (v := value(q, t))]
        return sum(a != b for a, b in pairwise(signs))

    def within(self, lower: Fraction, upper: Fraction) -> int:
        """Return the number of roots in the closed interval."""
        if lower > upper:
            return 0
        return self.changes(lower) - self.changes(upper) + (value(self.p, lower) == 0)

    def before(self, lower: Fraction, upper: Fraction) -> int:
        """Return the number of roots in [lower, upper)."""
        return self.within(lower, upper) - (lower <= upper and value(self.p, upper) == 0)


def along(expr: object, ray: Sequence[Fraction]) -> list[Fraction]:
    """Return the coefficients of a rational sympy polynomial along o + t·d, lowest power first."""
    if expr.is_Symbol:
        axis = "xyz".index(expr.name)
        return [ray[axis], ray[axis + 3]]
    if expr.is_Rational:
        return [Fraction(int(expr.p), int(expr.q))]
    parts = [along(a, ray) for a in expr.args]
    if expr.is_Add:
        width = max(map(len, parts))
        return [sum((p[i] for p in parts if i < len(p)), Fraction(0)) for i in range(width)]
    if expr.is_Pow:
        assert expr.exp.is_Integer, f"{expr} is not rational"
        parts = [parts[0]] * int(expr.exp)
    result = [Fraction(1)]
    for p in parts:
        product = [Fraction(0)] * (len(result) + len(p) - 1)
        for i, a in enumerate(result):
            for j, b in enumerate(p):
                product[i + j] += a * b
        result = product
    return result


def clip(surface: Surface, ray: Sequence[Fraction]) -> tuple[Interval, Interval] | None:
    """Return the clip interval as (outer, inner) rational intervals, or None where the ray misses the domain.

    The two are equal for boxes, and some 2^-300 apart for spheres.
    """
    o, d = ray[:3], ray[3:]
    domain = surface.domain
    if isinstance(domain, Box):
        enter, leave = Fraction(0), None
        for k in range(3):
            low, high = Fraction(domain.lower[k]), Fraction(domain.upper[k])
            if d[k] == 0:
                if not low <= o[k] <= high:
                    return None
                continue
            near, far = sorted(((low - o[k]) / d[k], (high - o[k]) / d[k]))
            enter, leave = max(enter, near), far if leave is None else min(leave, far)
        return ((enter, leave), (enter, leave)) if enter <= leave else None
    offset = [a - Fraction(c) for a, c in zip(o, domain.center, strict=True)]
    a = sum(v * v for v in d)
    b = sum(v * w for v, w in zip(offset, d, strict=True))
    discriminant = b * b - a * (sum(v * v for v in offset) - Fraction(domain.radius) ** 2)
    if discriminant < 0:
        return None
    scale = 1 << 400
    floor = isqrt(discriminant.numerator * discriminant.denominator * scale * scale)
    exact = Fraction(floor, discriminant.denominator * scale)
    slack = 0 if exact**2 == discriminant else Fraction(1, discriminant.denominator * scale)
    outer = (max(Fraction(0), (-b - exact - slack) / a), (-b + exact + slack) / a)
    inner = (max(Fraction(0), (-b - exact) / a), (-b + exact) / a)
    return (outer, inner) if inner[1] >= 0 else None


def check(surface: Surface, ray: Sequence[float], status: int, lower: float, upper: float) -> None:
    """Fail unless Sturm's theorem says the same; UNDECIDED always fails, since rational surfaces are decidable."""
    exact = [Fraction(float(v)) for v in ray]
    where = f"{surface.formula} in {surface.domain} along {[float(v) for v in ray]}"
    ends = clip(surface, exact)
    if ends is None:
        assert status == TruthStatus.MISS, where
        return
    outer, inner = ends
    p = integral(along(surfaces.expression(surface), exact))
    if not p:
        assert status == TruthStatus.TOUCH and Fraction(lower) <= inner[0] <= Fraction(upper), where
        return
    roots = Roots(p)
    assert roots.within(*outer) == roots.within(*inner), f"the reference cannot tell: {where}"
    if status == TruthStatus.MISS:
        assert roots.within(*outer) == 0, where
        return
    assert status in (TruthStatus.CROSSING, TruthStatus.TOUCH), where
    low, high = Fraction(lower), Fraction(upper)
    assert roots.before(inner[0], min(low, inner[1])) == 0, where
    inside = max(low, inner[0]), min(high, inner[1])
    assert roots.within(*inside) >= 1, where
    length = float(sum(v * v for v in exact[3:])) ** 0.5
    assert upper - lower <= max(2.0**-40 * surface.domain.radius / length, 2.0**-49 * upper), where
    if roots.within(*inside) == 1:
        multiplicity = 0
        while len(p) > 1 and Roots(p).within(*inside):
            multiplicity += 1
            p = common(p, derivative(p))
        assert (multiplicity % 2 == 0) == (status == TruthStatus.TOUCH), where


def check_all(surface: Surface, rays: np.ndarray) -> np.ndarray:
    """Check the oracle's answers and the slow path's own, ray by ray; return the statuses."""
    truth = first_hits(surface, rays)
    slow = AlgebraicSolver(compile_tape(surfaces.tape_of(surface)), surface.domain)
    for ray, status, lower, upper in zip(rays, truth.status, truth.lower, truth.upper, strict=True):
        check(surface, ray, status, lower, upper)
        alone = slow.first_hit(ray.tolist())
        assert alone.status == status
        if status != TruthStatus.MISS:
            assert alone.lower <= upper and lower <= alone.upper
    return truth.status


def rays_at(rng: np.random.Generator, count: int, radius: float, coarse: bool) -> np.ndarray:
    """Return rays float32[count, 6] from around towards the inside.

    `coarse` ones are on a grid of eighths, so that they hit things exactly.
    """
    origins = rng.normal(size=(count, 3)) * radius * rng.choice([0.3, 1.0, 3.0], size=(count, 1))
    directions = rng.uniform(-0.6, 0.6, size=(count, 3)) * radius - origins
    if coarse:
        origins, directions = np.round(origins * 8) / 8, np.round(directions * 4) / 8
        directions[~directions.any(axis=1), 0] = 1.0
    else:
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return np.hstack([origins, directions]).astype(np.float32)


def random_formula(pick: random.Random, degree: int) -> str:
    """Write a polynomial of about this degree: sums of products of small factors, some of them repeated."""

    def number() -> str:
        return f"{pick.randint(-12, 12)}/{pick.choice([1, 2, 4, 5, 8])}"

    def factor(room: int) -> tuple[str, int]:
        kind = pick.choice(["plane", "ball", "power", "cross"])
        if kind == "ball" and room >= 2:
            return f"({pick.choice('xyz')}^2 + {pick.choice('xyz')}^2 + z^2 - {pick.randint(1, 8)}/8)", 2
        if kind == "power" and room >= 2:
            exponent = pick.randint(2, room)
            return f"({pick.choice('xyz')} - ({number()})/8)^{exponent}", exponent
        if kind == "cross" and room >= 3:
            return f"({pick.choice('xyz')}^2*{pick.choice('xyz')} - {pick.choice('xyz')}/4 + ({number()})/16)", 3
        return f"(x*({number()}) + y - z*({number()}) + ({number()})/8)", 1

    def product() -> str:
        room, factors = degree, []
        while room > 0:
            text, used = factor(room)
            factors.append(text)
            room -= used
        return "*".join(factors)

    return " + ".join(f"({number()})*{product()}" for _ in range(pick.randint(1, 2))) + f" + x^{degree}/4"


@pytest.mark.one_in(3)
@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5, 6, 8, 10, 13, 16, 20])
def test_random_formulas(degree: int) -> None:
    pick, rng = random.Random(degree), np.random.default_rng(degree)
    seen = np.zeros(4, dtype=int)
    for domain in ("sphere:1.5", "box:1,1.25,0.75"):
        surface = surfaces.from_formula(random_formula(pick, degree), domain)
        for coarse in (False, True):
            seen += np.bincount(check_all(surface, rays_at(rng, 12, 1.5, coarse)), minlength=4)
    assert seen[TruthStatus.UNDECIDED] == 0


@pytest.mark.parametrize("seed", range(6))
def test_touches_and_multiple_roots(seed: int) -> None:
    """Squares, cubes and products of factors that share roots, on rays that meet them exactly."""
    pick, rng = random.Random(seed), np.random.default_rng(seed)
    factors = [f"({pick.choice('xyz')} - {pick.randint(-4, 4)}/8)^{pick.randint(1, 4)}" for _ in range(3)]
    surface = surfaces.from_formula("*".join(factors), "box:1,1,1")
    statuses = check_all(surface, rays_at(rng, 40, 1.0, coarse=True))
    assert np.isin(statuses, [TruthStatus.CROSSING, TruthStatus.TOUCH]).any()


@pytest.mark.parametrize("spacing", [2.0**-8, 2.0**-24, 2.0**-45, 2.0**-52, 2.0**-70])
def test_clustered_roots(spacing: float) -> None:
    """Five roots `spacing` apart (the last ones closer than float64 resolves), and the same without the first."""
    numerator, denominator = spacing.as_integer_ratio()
    for first in (0, 1):
        roots = "*".join(f"(x - 1/4 - {k}*{numerator}/{denominator})" for k in range(first, 5))
        surface = surfaces.from_formula(roots, "box:1,1,1")
        statuses = check_all(surface, np.array([[-3, 0, 0, 1, 0, 0], [-3, 0.1, 0.2, 0.9, 0.01, 0.02]], np.float32))
        assert (statuses == TruthStatus.CROSSING).all()


@pytest.mark.parametrize("exponent", range(4, 60, 5))
def test_near_tangent(exponent: int) -> None:
    """A dip of 2^-exponent below or above the surface: two roots, one touch, or none."""
    for sign, expected in (("-", TruthStatus.CROSSING), ("+", TruthStatus.MISS)):
        surface = surfaces.from_formula(f"(x - 1/8)^2 + y^2 {sign} 1/2^{exponent}", "sphere:1")
        statuses = check_all(surface, np.array([[-2, 0, 0, 1, 0, 0]], np.float32))
        assert statuses[0] == expected


@pytest.mark.parametrize("name", ["torus", "klein", "heart", "sixteen_ball"])
def test_float64_bernstein_coefficients_are_within_their_error(name: str) -> None:
    """Against Bernstein's own formula in exact fractions, from origins near and far."""
    surface = surfaces.get(name)
    isolator = BernsteinIsolator(Enclosure(compile_tape(surfaces.tape_of(surface))))
    rng = np.random.default_rng(4)
    for distance in (2.0, 1e5):
        directions = rng.normal(size=(20, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        origins = rng.uniform(-0.5, 0.5, size=(20, 3)) - distance * directions
        rays = np.hstack([origins, directions]).astype(np.float32).astype(np.float64)
        lower, upper = np.full(20, distance - 1.0) + rng.uniform(0, 1e-9, 20), np.full(20, distance + 1.1)
        coefficients, error = isolator.coefficients(rays, lower, upper)
        assert (error < 1e-6 * np.abs(coefficients).max(axis=1)).all()
        for ray, low, high, found, bound in zip(rays, lower, upper, coefficients, error, strict=True):
            start, width = Fraction(float(low)), Fraction(float(high)) - Fraction(float(low))
            o, d = [Fraction(float(v)) for v in ray[:3]], [Fraction(float(v)) for v in ray[3:]]
            moved = [*(a + start * b for a, b in zip(o, d, strict=True)), *(width * b for b in d)]
            power = along(surfaces.expression(surface), moved)
            for i, value_found in enumerate(found):
                exact = sum(comb(i, j) * power[j] / comb(len(found) - 1, j) for j in range(i + 1))
                assert abs(Fraction(float(value_found)) - exact) <= Fraction(float(bound))
