"""The oracle as others use it: catalog surfaces, irrational coefficients, other functions, estimates, cache, errors."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import fields
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest
import sympy
from flint import arb

import surfaces
from harness.contract import FirsthitError, Surface, Truth, TruthStatus
from harness.oracle import balls64, cached_first_hits, first_hits, reals
from harness.oracle.balls64 import Balls
from harness.oracle.program import program_of
from harness.oracle.reading import graph_of
from harness.oracle.reals import precision
from harness.oracle.slow import AlgebraicSolver
from harness.oracle.transcendental import SmoothSolver

SURFACES = [surfaces.get(name) for name in surfaces.names()]
AXIS = [[3, 0, 0, -1, 0, 0]]


def float_rays(rows: list[list[float]]) -> np.ndarray:
    return np.array(rows, dtype=np.float32)


def rays_into(surface: Surface, count: int, seed: int = 1) -> np.ndarray:
    """Rays from around the domain, and a few from inside it, towards points inside."""
    rng = np.random.default_rng(seed)
    radius, center = surface.domain.radius, np.asarray(surface.domain.center)
    origins = rng.normal(size=(count, 3)) * radius * rng.choice([0.3, 2.0], size=(count, 1), p=[0.2, 0.8])
    directions = rng.uniform(-0.7, 0.7, size=(count, 3)) * radius - origins
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    return np.hstack([origins + center, directions]).astype(np.float32)


def slow_path(surface: Surface) -> AlgebraicSolver | SmoothSolver:
    graph = graph_of(surfaces.tape_of(surface))
    program = program_of(graph)
    return AlgebraicSolver(program, surface.domain) if program.is_polynomial else SmoothSolver(graph, surface.domain)


@pytest.mark.parametrize("surface", SURFACES, ids=lambda s: s.name)
def test_fast_and_slow_path_agree_on_the_catalog(surface: Surface) -> None:
    rays = rays_into(surface, 400 if surface.algebraic else 40)
    truth = first_hits(surface, rays)
    slow = slow_path(surface)
    for ray, status, lower, upper in zip(rays, truth.status, truth.lower, truth.upper, strict=True):
        alone = slow.first_hit(ray.tolist())
        assert alone.status == status
        if status != TruthStatus.MISS:
            assert alone.lower <= upper and lower <= alone.upper
    assert not (truth.status == TruthStatus.UNDECIDED).any()
    assert np.isfinite(truth.lower).tolist() == (truth.status != TruthStatus.MISS).tolist()


def mp_function(surface: Surface, ray: np.ndarray) -> mpmath.mpf:
    """f along the ray as an mpmath function of t, by sympy's own evaluation."""
    t = sympy.Symbol("t")
    point = [sympy.Rational(float(o)) + t * sympy.Rational(float(d)) for o, d in zip(ray[:3], ray[3:], strict=True)]
    expr = surfaces.expression(surface)
    symbols = {str(s): s for s in expr.free_symbols}
    along = expr.subs({symbols[n]: p for n, p in zip("xyz", point, strict=True) if n in symbols})
    return sympy.lambdify(t, along, "mpmath")


def clip_ends(surface: Surface, ray: np.ndarray) -> tuple[mpmath.mpf, mpmath.mpf] | None:
    """Clip a ray by a sphere domain, in mpmath; None where it misses."""
    o, d, c = ([mpmath.mpf(float(v)) for v in part] for part in (ray[:3], ray[3:], surface.domain.center))
    o = [a - b for a, b in zip(o, c, strict=True)]
    qa, qb = sum(v * v for v in d), sum(v * w for v, w in zip(o, d, strict=True))
    root = qb * qb - qa * (sum(v * v for v in o) - mpmath.mpf(surface.domain.radius) ** 2)
    if root < 0:
        return None
    ends = (-qb - mpmath.sqrt(root)) / qa, (-qb + mpmath.sqrt(root)) / qa
    return (max(ends[0], mpmath.mpf(0)), ends[1]) if ends[1] >= 0 else None


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", ["barth_sextic", "barth_decic", "endrass_octic", "sixteen_ball"])
def test_polynomials_against_mpmath_roots(name: str) -> None:
    """All roots by Durand-Kerner in 120 digits: the first real one in the clip interval lies in the oracle's."""
    surface = surfaces.get(name)
    rays = rays_into(surface, 15, seed=7)
    truth = first_hits(surface, rays)
    with mpmath.workdps(120):
        for ray, status, lower, upper in zip(rays, truth.status, truth.lower, truth.upper, strict=True):
            ends = clip_ends(surface, ray)
            roots = []
            if ends is not None:
                f, n = mp_function(surface, ray), surface.degree
                middle, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
                nodes = [mpmath.mpf(2 * k - n) / n for k in range(n + 1)]
                matrix = mpmath.matrix([[s**j for j in range(n + 1)] for s in nodes])
                coefficients = mpmath.lu_solve(matrix, mpmath.matrix([f(middle + half * s) for s in nodes]))
                found = mpmath.polyroots(list(coefficients)[::-1], maxsteps=500, extraprec=500)
                real = sorted(r.real for r in found if abs(r.imag) < mpmath.mpf(10) ** -50)
                roots = [middle + half * r for r in real if abs(r) <= 1]
            if status == TruthStatus.MISS:
                assert not roots
            else:
                assert status == TruthStatus.CROSSING
                assert lower - mpmath.mpf(10) ** -50 <= roots[0] <= upper + mpmath.mpf(10) ** -50


@pytest.mark.one_in(2)
@pytest.mark.parametrize(
    "formula",
    [
        "exp(-4*(x^2+y^2+z^2)) + exp(-8*((x-1)^2+y^2+z^2)) - 1/3",
        "sin(3*x) + cos(2*y) + sin(pi*z) - 1/5",
        "sqrt(x^2 + y^2 + 1) + abs(z) - 3/2",
        "max(x^2 + y^2 - 1/2, z^2 - 1/4)",
        "min(x^2 + y^2 + z^2 - 1, (x - 1)^2 + y^2 + z^2 - 1/2)",
        "log(2 + x + y*z) - tan(z/2)",
        "1/(x^2 + y^2 + z^2 + 1/10) - 2",
        "x^2 + pi*y^2 + sqrt2*z^2 - e/3",
    ],
)
def test_other_functions_against_high_precision_signs(formula: str) -> None:
    """No sign change of f in front of the interval, one across it: evaluated by mpmath in 40 digits."""
    surface = surfaces.from_formula(formula, "sphere:1.5")
    rays = rays_into(surface, 30, seed=11)
    truth = first_hits(surface, rays)
    assert not (truth.status == TruthStatus.UNDECIDED).any()
    assert (truth.status == TruthStatus.CROSSING).any()
    slow = slow_path(surface)
    with mpmath.workdps(40):
        for k, ray in enumerate(rays):
            alone = slow.first_hit(ray.tolist())
            assert alone.status == truth.status[k]
            ends = clip_ends(surface, ray)
            if ends is None:
                assert truth.status[k] == TruthStatus.MISS
                continue
            f = mp_function(surface, ray)
            hit = truth.status[k] == TruthStatus.CROSSING
            last = mpmath.mpf(truth.lower[k]) if hit else ends[1]
            signs = {mpmath.sign(f(ends[0] + (last - ends[0]) * s / 150)) for s in range(151)}
            assert len(signs) == 1
            if hit:
                assert mpmath.sign(f(mpmath.mpf(truth.upper[k]))) == -signs.pop()
                assert alone.lower <= truth.upper[k] and truth.lower[k] <= alone.upper


def test_touches_with_irrational_coefficients() -> None:
    """Rays through singular points and tangent spheres, known in closed form."""
    cases = [
        ("(x^2 + y^2 + z^2 - phi)^2", AXIS, "touch", 3 - ((1 + 5**0.5) / 2) ** 0.5),
        ("x^2 - phi^2*y^2", [[1, 1, 0, -1, -1, 0]], "touch", 1.0),
        ("(x - sqrt2)^3*(y - sqrt2)", AXIS, "crossing", 3 - 2**0.5),
        ("(x - sqrt2)*(x^2 - 2)", AXIS, "touch", 3 - 2**0.5),  # a root of the rational and of the irrational factor
        ("(x + sqrt2)*(x^2 - 3)^2", AXIS, "touch", 3 - 3**0.5),
        ("(x - sqrt3)*(x^2 - 2)", [[0, 0, 0, 1, 0, 0]], "crossing", 2**0.5),
        ("(x - pi/3)*(x - 1)", AXIS, "crossing", 3 - np.pi / 3),
        ("(x - pi/3)^2*(x - 1)", AXIS, "touch", 3 - np.pi / 3),
        ("exp(x)*sin(3*x)^2*(x - 9/8)^3", AXIS, "crossing", 3 - 9 / 8),
        ("exp(x)*sin(3*x)^2*(x - 1)^3", AXIS, "touch", 3 - np.pi / 3),
    ]
    for formula, rows, status, t in cases:
        truth = first_hits(surfaces.from_formula(formula, "sphere:2"), float_rays(rows))
        assert TruthStatus(truth.status[0]).name.lower() == status, formula
        assert truth.lower[0] - 1e-14 <= t <= truth.upper[0] + 1e-14, formula


def test_what_cannot_be_decided_is_undecided() -> None:
    """A touch of a surface whose coefficients are in no quadratic field, and one that is not algebraic."""
    for formula in ("(x^2 + y^2 + z^2 - pi/4)*(x^2 + y^2 + z^2 + y - pi/4)", "sin(x - y)*sin(x - y + z)"):
        truth = first_hits(surfaces.from_formula(formula, "sphere:2"), float_rays([[2.5, 0, 0, -1, 0, 0]]))
        assert truth.status[0] == TruthStatus.UNDECIDED
        assert np.isnan(truth.lower[0]) and np.isnan(truth.upper[0]) and truth.margin[0] == 0.0


def test_nodes_of_the_barth_surfaces_are_touches() -> None:
    for name in ("barth_sextic", "barth_decic"):
        truth = first_hits(surfaces.get(name), float_rays([*AXIS, [0, 0, 3, 0, 0, -1]]))
        assert (truth.status == TruthStatus.TOUCH).all() and (truth.lower <= 2).all() and (truth.upper >= 2).all()


def test_the_next_root_condition_and_margin() -> None:
    surface = surfaces.from_formula("x^2 + y^2 + z^2 - 1", "sphere:2")
    heights = [0.0, 0.5, 0.999, 1.001, 1.5]
    truth = first_hits(surface, float_rays([[-3, h, 0, 1, 0, 0] for h in heights]))
    chord = np.sqrt(np.maximum(1 - np.float32(heights).astype(float) ** 2, 0))
    assert truth.status.tolist() == [1, 1, 1, 0, 0]
    np.testing.assert_allclose(truth.following[:3], 3 + chord[:3], rtol=1e-12)
    assert np.isinf(truth.following[3:]).all() and np.isnan(truth.condition[3:]).all()
    np.testing.assert_allclose(truth.condition[:3], 2 / (2 * chord[:3] * 2), rtol=1e-9)
    np.testing.assert_allclose(truth.margin[2:4], 0.001, rtol=0.01)
    assert (truth.margin[[0, 1, 4]] > 0.1).all()


def test_margin_sees_what_float32_may_decide_otherwise() -> None:
    """Near touches before the hit, a root just before the origin, a hit about to be clipped, a grazed domain."""
    two = surfaces.from_formula("((x + 1)^2 + y^2 + z^2 - 1/4)*((x - 1)^2 + y^2 + z^2 - 3/4)", "sphere:2")
    truth = first_hits(two, float_rays([[-3, 0.5001, 0, 1, 0, 0], [-3, 0.6, 0, 1, 0, 0]]))
    assert (truth.status == TruthStatus.CROSSING).all() and truth.margin[0] < 2e-4 and truth.margin[1] > 0.02
    plane = surfaces.from_formula("x", "sphere:1")
    near = first_hits(plane, float_rays([[1e-5, 0, 0, 1, 0, 0], [-1e-5, 0, 0, 1, 0, 0], [-2, 0.99999, 0, 1, 0, 0]]))
    assert near.status.tolist() == [0, 1, 1] and (near.margin < 2e-5).all()
    assert first_hits(plane, float_rays([[-2, 1.00001, 0, 1, 0, 0]])).margin[0] < 2e-5


def test_cache_is_named_by_content_and_survives_damage(tmp_path: Path) -> None:
    torus, rays = surfaces.get("torus"), rays_into(surfaces.get("torus"), 50)
    fresh = cached_first_hits(torus, rays, tmp_path)
    (file,) = tmp_path.iterdir()

    def same(other: Truth) -> None:
        for field in fields(Truth):
            np.testing.assert_array_equal(getattr(other, field.name), getattr(fresh, field.name))

    altered = {f.name: getattr(fresh, f.name) for f in fields(Truth)}
    np.savez(file, **{**altered, "margin": fresh.margin + 1.0})
    np.testing.assert_array_equal(cached_first_hits(torus, rays, tmp_path).margin, fresh.margin + 1.0)  # it is read
    for damage in (b"", b"not a zip file", file.read_bytes()[:700], file.read_bytes()[:-30]):
        file.write_bytes(damage)
        same(cached_first_hits(torus, rays, tmp_path))
    np.savez(file, **{**altered, "margin": fresh.margin[:3]})
    same(cached_first_hits(torus, rays, tmp_path))
    moved = rays.copy()
    moved[0, 0] = np.nextafter(moved[0, 0], np.float32(9))
    cached_first_hits(torus, moved, tmp_path)
    cached_first_hits(surfaces.get("torus", R="0.6"), rays, tmp_path)
    assert len(list(tmp_path.iterdir())) == 3


def test_no_rays_at_all() -> None:
    truth = first_hits(surfaces.get("torus"), np.empty((0, 6), np.float32))
    assert all(getattr(truth, f.name).shape == (0,) for f in fields(Truth))


@pytest.mark.parametrize(
    ("rays", "message"),
    [
        (float_rays([[0, 0, 0, 1, 0, 0], [0, np.nan, 0, 1, 0, 0]]), "ray 1 is not finite"),
        (float_rays([[0, 0, np.inf, 1, 0, 0]]), "ray 0 is not finite"),
        (float_rays([[0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0]]), r"ray 1 has direction \(0, 0, 0\)"),
        (np.zeros((2, 5), np.float32), r"not float32\[2, 5\]"),
        (np.zeros((2, 6)), "not float64"),
        ([[0, 0, 0, 1, 0, 0]], "not list"),
    ],
)
def test_rays_that_are_not_rays(rays: np.ndarray, message: str, tmp_path: Path) -> None:
    with pytest.raises(FirsthitError, match=message):
        first_hits(surfaces.get("torus"), rays)
    with pytest.raises(FirsthitError, match=message):
        cached_first_hits(surfaces.get("torus"), rays, tmp_path)


def test_importing_the_oracle_is_cheap() -> None:
    heavy = ("flint", "sympy", "surfaces.catalog", "surfaces.formula", "surfaces.evaluation")
    code = f"import sys, harness.oracle; print([m for m in {heavy} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_vocabulary_needs_no_numpy() -> None:
    code = "import sys, harness.contract; print([m for m in ('numpy', 'surfaces.formula') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_float64_balls_hold_the_exact_results() -> None:
    """Members drawn from random balls (end points two times in three) against arb at 200 bits."""
    rng = np.random.default_rng(2)
    count = 4000

    def draw() -> tuple[Balls, list[arb]]:
        mid = rng.choice([-1.0, 1.0], count) * 2.0 ** rng.uniform(-12, 5, count)
        rad = np.abs(mid) * 2.0 ** rng.uniform(-60, 1, count) * rng.integers(0, 2, count)
        place = [arb(p) for p in rng.choice([-1.0, 1.0, 0.37], count).tolist()]
        return Balls(mid, rad), [arb(m) + p * arb(r) for m, p, r in zip(mid.tolist(), place, rad.tolist(), strict=True)]

    with precision(200), np.errstate(all="ignore"):
        (a, in_a), (b, in_b), (c, in_c) = draw(), draw(), draw()
        cases = {
            "add": (a + b, [x + y for x, y in zip(in_a, in_b, strict=True)]),
            "sub": (a - b, [x - y for x, y in zip(in_a, in_b, strict=True)]),
            "mul": (a * b, [x * y for x, y in zip(in_a, in_b, strict=True)]),
            "div": (a / b, [x / y for x, y in zip(in_a, in_b, strict=True)]),
        }
        two = ("min", "max", "length", "atan2", "below")
        for name, function in reals.FUNCTIONS.items():
            if name == "select":
                choice = [arb(int(x > 0)) for x in in_c]
                cases[name] = (
                    balls64.select(balls64.below(-c, Balls(0.0)), a, b),
                    [function(*each) for each in zip(choice, in_a, in_b, strict=True)],
                )
                continue
            more = (Fraction(7, 3),) if name == "powr" else ()
            members = [in_a, in_b] if name in two else [in_a]
            result = balls64.FUNCTIONS[name](*(a, b)[: len(members)], *more)
            cases[name] = result, [function(*each, *more) for each in zip(*members, strict=True)]
        for exponent in (Fraction(1, 3), Fraction(2, 7), Fraction(10**9 + 1, 10**8)):
            result = balls64.powr(a, exponent)
            cases[f"powr {exponent}"] = result, [reals.powr(x, exponent) for x in in_a]
        for name, (result, exact) in cases.items():
            proved = 0
            for mid, rad, value in zip(result.mid.tolist(), result.rad.tolist(), exact, strict=True):
                if np.isfinite(mid) and np.isfinite(rad):
                    assert not abs(value - arb(mid)) > arb(rad), name
                    proved += 1
            assert proved > count // 4, name
