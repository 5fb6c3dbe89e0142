"""The oracle's estimates against the exact polynomial along each ray: all its roots and extrema, isolated by flint."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy
from flint import arb, arb_poly, ctx, fmpq, fmpq_poly

import surfaces
from harness import hardcases
from harness.contract import Box, Surface, Truth, TruthStatus, View
from harness.oracle import first_hits
from harness.scenes.camera import camera_for, rays_of

DIGITS = 60  # of irrational constants: 1e-60 off is 1e-30 off where two roots meet
EXACT = 400  # bits
Polynomials = tuple[fmpq_poly, ...]


@dataclass(frozen=True)
class Reference:
    """What the exact polynomial says, in t and scene units."""

    first: float  # NaN without a root
    gap: float  # to the next root; inf where there is none
    margin: float  # contract.Truth's formula at exact extrema


def rational(value: sympy.Expr) -> fmpq:
    near = value if value.is_Rational else sympy.Rational(str(value.evalf(DIGITS)))
    return fmpq(int(near.p), int(near.q))


@cache
def terms(formula: str, parameters: tuple[tuple[str, str], ...]) -> tuple[list[tuple[tuple[int, ...], fmpq]], ...]:
    """Monomials of f and of its three derivatives."""
    surface = surfaces.from_formula(formula, "sphere:1", "any", dict(parameters))
    x, y, z = variables = sympy.symbols("x y z", real=True)
    expr = surfaces.expression(surface)
    expr = expr.xreplace({s: variables["xyz".index(s.name)] for s in expr.free_symbols})
    whole = sympy.Poly(expr, x, y, z)
    return tuple([(m, rational(c)) for m, c in p.terms()] for p in (whole, *(whole.diff(v) for v in variables)))


def along(surface: Surface, ray: np.ndarray) -> Polynomials:
    """f and its gradient on o + t·d."""
    o, d = ([fmpq(*float(v).as_integer_ratio()) for v in part] for part in (ray[:3], ray[3:]))
    powers = []
    for a, b in zip(o, d, strict=True):
        powers.append([fmpq_poly([1])])
        for _ in range(surface.degree):
            powers[-1].append(powers[-1][-1] * fmpq_poly([a, b]))
    result = []
    for monomials in terms(surface.formula, surface.parameters):
        total = fmpq_poly([0])
        for (i, j, k), c in monomials:
            total += c * powers[0][i] * powers[1][j] * powers[2][k]
        result.append(total)
    return tuple(result)


def clip(surface: Surface, ray: np.ndarray) -> tuple[arb, arb] | None:
    """The ends of the clip interval, as balls."""
    o, d = ([fmpq(*float(v).as_integer_ratio()) for v in part] for part in (ray[:3], ray[3:]))
    domain = surface.domain
    if isinstance(domain, Box):
        pairs = zip(domain.lower, domain.upper, o, d, strict=True)
        bounds = [
            sorted((fmpq(*side.as_integer_ratio()) - a) / b for side in (low, high)) for low, high, a, b in pairs if b
        ]
        lower, upper = arb(max(fmpq(0), *(b[0] for b in bounds))), arb(min(b[1] for b in bounds))
    else:
        offset = [a - fmpq(*c.as_integer_ratio()) for a, c in zip(o, domain.center, strict=True)]
        radius = fmpq(*domain.radius.as_integer_ratio())
        a, b = sum(v * v for v in d), sum(v * w for v, w in zip(offset, d, strict=True))
        root = arb(b * b - a * (sum(v * v for v in offset) - radius * radius)).sqrt()
        lower, upper = ((-b - root) / a).max(arb(0)), (-b + root) / a
    return (lower, upper) if lower < upper else None


def real_roots(p: fmpq_poly, ends: tuple[arb, arb]) -> list[arb]:
    """Distinct, in order, inside the clip interval."""
    found: list[tuple[Any, int]] = p.numer().complex_roots() if p.degree() > 0 else []
    roots = [r.real for r, _ in found if r.imag == 0]
    return sorted((r for r in roots if ends[0] <= r <= ends[1]), key=float)


def reference(surface: Surface, ray: np.ndarray) -> Reference | None:
    """None for a ray that misses the domain, or along which f is constant."""
    before, ctx.prec = ctx.prec, EXACT
    try:
        ends = clip(surface, ray)
        f, *gradient = along(surface, ray)
        if ends is None or f.degree() < 1:
            return None
        distance = float(arb(sum(fmpq(*float(v).as_integer_ratio()) ** 2 for v in ray[3:])).sqrt())

        def nearness(t: arb) -> float:
            steep = math.hypot(*(float(arb_poly(g)(t)) for g in gradient))
            return abs(float(arb_poly(f)(t))) / steep if steep else math.inf

        roots, bends = real_roots(f, ends), real_roots(f.derivative(), ends)
        if not roots:
            return Reference(math.nan, math.inf, min(map(nearness, [*ends, *bends])))
        first, stop = roots[0], roots[1] if len(roots) > 1 else ends[1]
        gap = float(stop - first) if len(roots) > 1 else math.inf
        dip = max([stop, *(t for t in bends if first < t < stop)], key=lambda t: abs(float(arb_poly(f)(t))))
        near = [nearness(t) for t in (ends[0], dip, *(b for b in bends if b < first))]
        return Reference(
            float(first), gap, min(*near, 0.5 * gap * distance, float(first) * distance, inside(surface, ray, first))
        )
    finally:
        ctx.prec = before


def inside(surface: Surface, ray: np.ndarray, t: arb) -> float:
    """Distance of a point of the ray from the domain's boundary."""
    point = [float(arb(float(o)) + t * arb(float(d))) for o, d in zip(ray[:3], ray[3:], strict=True)]
    if isinstance(surface.domain, Box):
        return min(min(p - a, b - p) for p, a, b in zip(point, surface.domain.lower, surface.domain.upper, strict=True))
    return surface.domain.radius - math.dist(point, surface.domain.center)


@dataclass(frozen=True)
class Compared:
    """Estimates over the exact figures, ray by ray; only rays for which there is a figure."""

    gaps: list[tuple[float, float, float]]  # |error|, true gap, and what rounding errors of f's terms move t2 by
    margins: list[float]  # estimate / exact, where either is under `NEAR` radii


NEAR = 0.05


def compared(surface: Surface, rays: np.ndarray, truth: Truth) -> Compared:
    gaps, margins = [], []
    radius = surface.domain.radius
    for k, ray in enumerate(rays):
        exact = reference(surface, ray)
        if exact is None:
            continue
        first = 0.5 * (truth.lower[k] + truth.upper[k])
        assert math.isnan(first) == math.isnan(exact.first)
        assert math.isinf(truth.following[k]) == math.isinf(exact.gap), f"ray {k}: {truth.following[k]}, {exact}"
        if math.isfinite(exact.gap):
            rounding = 4.0 * 2.0**-53 * truth.condition[k] * radius + 2.0 * float(np.spacing(first))
            gaps.append((abs(truth.following[k] - first - exact.gap), exact.gap, rounding))
        crossing_or_miss = truth.status[k] in (TruthStatus.CROSSING, TruthStatus.MISS)
        if crossing_or_miss and min(truth.margin[k], exact.margin) < NEAR * radius:
            margins.append(truth.margin[k] / exact.margin if exact.margin else 1.0 + truth.margin[k] / 1e-15)
    return Compared(gaps, margins)


@cache
def of_family(name: str) -> list[tuple[hardcases.Rung, Truth, Compared]]:
    rungs = [(rung, first_hits(rung.surface, rung.rays)) for rung in hardcases.rungs(name)]
    return [(rung, truth, compared(rung.surface, rung.rays, truth)) for rung, truth in rungs]


@pytest.mark.one_in(5)
@pytest.mark.parametrize("name", hardcases.names())
def test_estimates_on_hard_rays(name: str) -> None:
    for rung, _, found in of_family(name):
        for error, gap, rounding in found.gaps:
            assert error <= 1e-3 * gap + rounding, rung.parameter
        assert all(1 / 3 < ratio < 3 for ratio in found.margins), (rung.parameter, found.margins)


@pytest.mark.parametrize("name", ["clustered_roots", "torus_four_hits", "grazing", "tangent_plane", "double_line"])
def test_the_next_root_of_close_pairs_to_a_thousandth(name: str) -> None:
    """No allowance for rounding errors where float64 can do without."""
    for rung, _, found in of_family(name):
        assert len(found.gaps) >= 40
        assert all(error <= 1e-3 * gap for error, gap, _ in found.gaps), rung.parameter


@pytest.mark.parametrize(
    "name", ["clustered_roots", "torus_four_hits", "grazing", "tangent_plane", "flat_faces", "origin_on_surface"]
)
def test_margins_are_what_the_family_was_built_for(name: str) -> None:
    for rung, truth, _ in of_family(name):
        ratios = truth.margin / rung.margin
        assert np.median(ratios) > 1 / 3 and ratios.max() < 3, rung.parameter


@pytest.mark.parametrize("name", ["himmel", "steiner", "spindle_torus", "barth_decic"])
def test_a_crossing_with_another_in_its_own_blur_is_near_to_another_answer(name: str) -> None:
    """A hair off a plane of symmetry f is x^2 less a square: it crosses twice, nearer together than samples are."""
    surface = surfaces.get(name)
    rays = rays_of(camera_for(View("pole", azimuth=0.0, elevation=90.0), surface), 33)
    truth = first_hits(surface, rays)
    in_plane = (np.abs(rays[:, 0]) < 1e-15) & (np.abs(rays[:, 3]) < 1e-15) & (truth.status == TruthStatus.CROSSING)
    around = [surfaces.evaluate(surface, rays[in_plane, :3] + t[in_plane, None] * rays[in_plane, 3:].astype(np.float64))
              for t in (truth.lower - 1e-6, truth.upper + 1e-6)]  # fmt: skip
    paired = around[0] * around[1] > 0.0
    assert paired.any()
    assert (truth.margin[in_plane][paired] < 1e-3).all()


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", [n for n in surfaces.names() if surfaces.get(n).algebraic])
def test_estimates_on_pictures(name: str) -> None:
    surface = surfaces.get(name)
    rays = rays_of(camera_for(View("any", azimuth=37.0, elevation=21.0), surface), 16)
    found = compared(surface, rays, first_hits(surface, rays))
    assert all(error <= 1e-3 * gap + rounding for error, gap, rounding in found.gaps)
    assert sum(not 1 / 3 < ratio < 3 for ratio in found.margins) <= len(found.margins) / 100
