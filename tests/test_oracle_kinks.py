"""Roots at kinks of abs, min, max and where a root's argument is 0; distance functions; formulas as one finds them."""

from __future__ import annotations

import os
import random
from dataclasses import replace

import mpmath
import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, Surface, TruthStatus
from harness.oracle import first_hits
from harness.oracle.balls64 import Balls
from harness.oracle.clip import clip_exactly
from harness.oracle.dual import Dual
from harness.oracle.enclosure import Enclosure
from harness.oracle.piecewise import PiecewiseSolver, exact_program
from harness.oracle.program import compile_tape
from harness.oracle.range64 import RangeIsolator
from harness.oracle.reading import graph_of
from harness.oracle.reals import rational
from harness.oracle.slow import MISS
from tests import distance_functions
from tests.distance_functions import clip, contradictions, random_shape, rays_for
from tests.test_oracle import mp_function
from tests.test_oracle_formulas import check, random_formula, rays_at

SHAPES = int(os.environ.get("FIRSTHIT_SHAPES", "24"))  # random distance functions, 60 rays each; 24 take about 20 s
ALONG_X = [-3, 0.1, 0.2, 1, 0, 0]
DOWN = [0, 0, 3, 0, 0, -1]
BOX = (
    "sqrt(max(abs(x)-0.5,0)^2 + max(abs(y)-0.25,0)^2 + max(abs(z)-0.75,0)^2)"
    " + min(max(abs(x)-0.5, max(abs(y)-0.25, abs(z)-0.75)), 0)"
)


def answer(formula: str, ray: list[float], domain: str = "sphere:2", t_min: float = 0.0) -> tuple[str, float]:
    """Status and t of one ray; the interval is as narrow as it must be."""
    surface = surfaces.from_formula(formula, domain)
    truth = first_hits(surface, np.array([ray], np.float32), t_min)
    status = TruthStatus(truth.status[0])
    if status in (TruthStatus.CROSSING, TruthStatus.TOUCH):
        assert truth.lower[0] <= truth.upper[0]
        assert truth.upper[0] - truth.lower[0] <= max(2.0**-40 * surface.domain.radius, 2.0**-49 * truth.upper[0])
    return status.name.lower(), 0.5 * (truth.lower[0] + truth.upper[0])


@pytest.mark.parametrize(
    ("formula", "ray", "status", "t"),
    [
        ("abs(x)", ALONG_X, "touch", 3.0),
        ("max(x, -x)", ALONG_X, "touch", 3.0),
        ("min(x^2, y^2)", ALONG_X, "touch", 3.0),
        ("sqrt(max(x,0)^2) + min(x,0)", ALONG_X, "crossing", 3.0),
        ("(sqrt(x^2+y^2) - 0.2)^2 + z^2 - 0.25", DOWN, "crossing", 2.541742430504416),
        ("sqrt(x^2+y^2) + z - 0.5", DOWN, "crossing", 2.5),
        ("sqrt(x^2+y^2)", ALONG_X, "miss", np.nan),
        ("sqrt(x^2+y^2)", [-3, 0, 0.2, 1, 0, 0], "touch", 3.0),
        ("sqrt(x^2+y^2)", DOWN, "touch", 1.0),  # 0 all along: where the ray enters the domain
        ("sqrt(x^2+y^2) - x", [-3, 0, 0, 1, 0, 0], "touch", 3.0),  # 2|x| in front, 0 all along behind
        ("sqrt(max(x^2-2*x/3+1/9, 0)) - abs(x-1/3)", [-3, 0, 0, 1, 0, 0], "touch", 1.0),
        ("sqrt((x-1/3)^4) - (1/3-x)^2", [-3, 0, 0, 1, 0, 0], "touch", 1.0),
        ("abs(x) + abs(y) - sqrt((abs(x) + abs(y))^2) + abs(z)", DOWN, "touch", 3.0),
        ("abs(x - pi/3)*exp(y)", ALONG_X, "touch", 3 + np.pi / 3),
        ("abs(x - pi/3)^3*(x - pi/3)", ALONG_X, "crossing", 3 + np.pi / 3),
        ("abs(x - y)*abs(y - x)*(x - y)", ALONG_X, "crossing", 3.0 + float(np.float32(0.1))),
        ("abs(x)*x", ALONG_X, "crossing", 3.0),
        ("sqrt2*abs(x) + sqrt3*abs(x - phi*y)", [-3, 0, 0, 1, 0, 0], "touch", 3.0),
        ("(x^2 - sqrt2*sqrt3)^2 + (x^2 - sqrt(6))^2", ALONG_X, "touch", 3 - 6**0.25),
        ("min(abs(x), 1 - abs(y)) - max(x, 0)", [-3, 0, 0, 1, 0, 0], "touch", 3.0),
        ("1/(1 + abs(x)) - 1", ALONG_X, "touch", 3.0),
        ("sqrt(max(x,0)) - sqrt(max(x - 1/2, 0))", ALONG_X, "touch", 1.0 + 2.0 - (4 - 0.05) ** 0.5),
        (BOX, [-3, 0, 0, 1, 0, 0], "crossing", 2.5),
        (BOX, [-3, 0.25, 0, 1, 0, 0], "touch", 2.5),  # in the plane of a face: f is 0 from edge to edge
        (BOX, [-3, 0.25, 0.75, 1, 0, 0], "touch", 2.5),  # along an edge
        (BOX, [0, 0.25, 0.75, 1, 0, 0], "touch", 0.0),  # from within that edge
        (BOX, [2.5, 2.25, 0.75, -1, -1, 0], "touch", 2.0),  # meets a corner, leaving again
        (BOX, [0.5, 1, 0.75, 0, -1, 0], "touch", 0.75),
        (BOX, [-1.5, -1.25, 0, 1, 1, 0], "crossing", 1.0),  # in through an edge
        (BOX, [0, 0, 0, 1, 0, 0], "crossing", 0.5),
        (BOX, [0, 0, 0, 2, 1, 0], "crossing", 0.25),  # out through an edge
        (BOX, [0, 0, 0, 2, 1, 3], "crossing", 0.25),  # out through a corner
        (f"max({BOX}, x)", [-3, 0.25, 0, 1, 0, 0], "touch", 2.5),
    ],
)
def test_known_values(formula: str, ray: list[float], status: str, t: float) -> None:
    found, at = answer(formula, ray)
    assert found == status
    np.testing.assert_allclose(at, t, rtol=1e-6 if "x,0)) -" in formula else 1e-12, atol=1e-12)


def test_roots_at_kinks_have_estimates_without_nan() -> None:
    for formula, ray in (("abs(x)", ALONG_X), ("sqrt(x^2+y^2) + z - 0.5", DOWN), (BOX, [-3, 0.25, 0.75, 1, 0, 0])):
        truth = first_hits(surfaces.from_formula(formula, "sphere:2"), np.array([ray], np.float32))
        assert not np.isnan(truth.margin[0]) and not np.isnan(truth.following[0])
        assert truth.margin[0] == 0.0 or truth.status[0] == TruthStatus.CROSSING


@pytest.mark.one_in(2)
@pytest.mark.parametrize("block", range(4))
def test_random_distance_functions(block: int) -> None:
    """Boxes, cones, tori, capsules, spheres, joined and cut: all decided, and float64 marching refutes nothing."""
    seen = np.zeros(4, int)
    for seed in range(block, SHAPES, 4):
        pick = random.Random(seed)
        shape = random_shape(pick, pick.choice([1, 1, 2, 2, 3, 4]))
        surface = surfaces.from_formula(shape.text, pick.choice(["sphere:2", "box:1.5,1.5,1.5"]))
        rays = rays_for(shape, 60, seed)
        truth = first_hits(surface, rays)
        seen += np.bincount(truth.status, minlength=4)
        assert not contradictions(shape, surface.domain, rays, truth), shape.text
    assert seen[TruthStatus.UNDECIDED] * 1000 <= seen.sum()
    assert SHAPES < 8 or (seen[:3] > 0).all()


@pytest.mark.parametrize("make", distance_functions.PRIMITIVES, ids=lambda make: make.__name__)
def test_one_distance_function(make: distance_functions.Callable[[random.Random], distance_functions.Shape]) -> None:
    shape = make(random.Random(5))
    surface = surfaces.from_formula(shape.text, "sphere:2")
    rays = rays_for(shape, 150, 5)
    truth = first_hits(surface, rays)
    assert not (truth.status == TruthStatus.UNDECIDED).any()
    assert not contradictions(shape, surface.domain, rays, truth)


def test_the_marcher_finds_wrong_answers() -> None:
    """What judges the answers above: a hit taken away, moved, called by the other name, or behind the first one."""
    shape = distance_functions.torus(random.Random(5))
    surface = surfaces.from_formula(shape.text, "sphere:2")
    rays = rays_for(shape, 150, 5)
    truth = first_hits(surface, rays)
    hits = np.flatnonzero((truth.status == TruthStatus.CROSSING) & (truth.lower > 0.1) & np.isfinite(truth.following))
    assert len(hits) > 20
    status, lower, upper = truth.status.copy(), truth.lower.copy(), truth.upper.copy()
    status[hits[0::4]] = TruthStatus.MISS
    lower[hits[1::4]] += 1e-4
    upper[hits[1::4]] += 1e-4
    status[hits[2::4]] = TruthStatus.TOUCH
    lower[hits[3::4]] = upper[hits[3::4]] = truth.following[hits[3::4]]
    wrong = contradictions(shape, surface.domain, rays, replace(truth, status=status, lower=lower, upper=upper))
    assert {k for k, _ in wrong} == set(hits.tolist())


@pytest.mark.parametrize("seed", range(6))
def test_exact_pieces_against_sturm(seed: int) -> None:
    """Polynomials, which the exact side takes too: it is given whole clip intervals."""
    pick, rng = random.Random(seed), np.random.default_rng(seed)
    factors = [f"({pick.choice('xyz')} - {pick.randint(-4, 4)}/8)^{pick.randint(1, 3)}" for _ in range(3)]
    for formula in (random_formula(pick, 2 + seed), "*".join(factors)):
        surface = surfaces.from_formula(formula, "box:1,1.25,0.75")
        program = exact_program(graph_of(surfaces.tape_of(surface)))
        assert program is not None
        for ray in rays_at(rng, 20, 1.5, coarse=True):
            exact = [rational(v) for v in ray.tolist()]
            ends = clip_exactly(surface.domain, exact)
            found = MISS
            if ends is not None:
                solver = PiecewiseSolver(program, exact, ends, 0.0)
                found = solver.first_hit(ends[0].value, ends[1].value + 1, 2.0**-50) or MISS
            if ends is None or surfaces.expression(surface) != 0:
                check(surface, ray, found.status, found.lower, found.upper)


def random_kinks(pick: random.Random, depth: int) -> str:
    """A formula of sums, products, quotients, roots and kinks."""
    if not depth:
        return pick.choice(["x", "y", "z", "x", "y", "z", f"{pick.randint(-8, 8)}/8", "sqrt2", "phi", "x^2", "(x-y)"])
    a, b = random_kinks(pick, depth - 1), random_kinks(pick, depth - 1)
    return pick.choice(
        [f"({a} + {b})", f"({a} - {b})", f"({a} * {b})", f"abs({a})", f"min({a}, {b})", f"max({a}, {b})", f"({a})^2",
         f"sqrt(({a})^2 + ({b})^2)", f"sqrt(max({a}, 0))", f"({a})/(1/4 + abs({b}))"]
    )  # fmt: skip


def valid(pick: random.Random) -> Surface:
    while True:
        try:
            return surfaces.from_formula(random_kinks(pick, pick.choice([2, 3, 3])), "box:1.5,1.25,1")
        except FirsthitError:
            continue


@pytest.mark.parametrize("seed", range(10))
def test_random_kinks_against_high_precision_signs(seed: int) -> None:
    """In front of an answer f has one sign at 60 places, in 40 digits; across it, it changes as the status says."""
    pick, rng = random.Random(seed), np.random.default_rng(seed)
    surface = valid(pick)
    directions = rng.choice([0.0, 0.0, 1.0, -1.0, 0.5], (12, 3))
    directions[~directions.any(axis=1), 0] = 1.0
    rays = np.hstack(
        [rng.choice([0, 0.5, -0.5, 0.25], (12, 3)) - rng.choice([0.0, 3.0], (12, 1)) * directions, directions]
    )
    rays = rays.astype(np.float32)
    truth = first_hits(surface, rays)
    assert not (truth.status == TruthStatus.UNDECIDED).any(), surface.formula
    enter, leave = clip(surface.domain, rays)
    with mpmath.workdps(40):
        for k in np.flatnonzero(enter < leave - 1e-9):
            f = mp_function(surface, rays[k])
            hit = truth.status[k] != TruthStatus.MISS
            last = truth.lower[k] if hit else leave[k]
            places = [enter[k] + 1e-12 + (last - enter[k] - 1e-11) * s / 60 for s in range(61)]
            signs = {mpmath.sign(f(mpmath.mpf(t))) for t in places if enter[k] < t < last}
            assert len(signs) <= 1 and 0 not in signs, (surface.formula, rays[k].tolist())
            if hit and enter[k] + 1e-9 < truth.lower[k] and truth.upper[k] < leave[k] - 1e-9:
                sides = [mpmath.sign(f(mpmath.mpf(t))) for t in (truth.lower[k] - 1e-9, truth.upper[k] + 1e-9)]
                crosses = sides[0] * sides[1] < 0
                assert crosses == (truth.status[k] == TruthStatus.CROSSING), (surface.formula, rays[k].tolist())


@pytest.mark.parametrize("formula", [BOX, "max(min(abs(x), abs(y)) - abs(z), sqrt(x^2 + 4*y^2) - 0.5)"])
def test_ranges_of_slopes_hold_the_mean_slopes(formula: str) -> None:
    """(f(b) − f(a)) / (b − a) is a mean of slopes: on short pieces across kinks it lies in the range found there."""
    surface = surfaces.from_formula(formula, "sphere:2")
    f = Enclosure(compile_tape(surfaces.tape_of(surface), lengths=True))
    isolator = RangeIsolator(f)
    rng = np.random.default_rng(8)
    count = 4000
    rays = np.hstack(
        [rng.choice([0.0, 0.25, 0.5, 0.75, 0.1], (count, 3)), rng.choice([0.0, 1.0, -1.0, 0.3], (count, 3))]
    )
    half = 2.0 ** rng.uniform(-30, -1, count)
    inputs = [Dual(Balls(rays[:, k], half * np.abs(rays[:, 3 + k])), Balls(rays[:, 3 + k])) for k in range(3)]
    with np.errstate(all="ignore"):
        whole = f.slopes(inputs)
        narrowed = isolator._narrowed(whole, inputs)
        for a, b in ((-1.0, 1.0), (-1.0, 0.0), (0.0, 1.0), (-0.5, 0.25)):
            ends = [surfaces.evaluate(surface, rays[:, :3] + (s * half)[:, None] * rays[:, 3:]) for s in (a, b)]
            mean = (ends[1] - ends[0]) / ((b - a) * half)
            slack = 1e-14 / half
            for slope in (whole.slope, narrowed):
                known = np.isfinite(slope.rad)
                assert (np.abs(mean - slope.mid)[known] <= (slope.rad + slack)[known]).all()
                assert known.sum() > count // 2
    assert (narrowed.rad < whole.slope.rad - 0.1).any()


def test_a_function_without_a_value_beyond_the_domain() -> None:
    """f ends just behind the box, nearer than the exact side looks; its root lies on the box's face."""
    assert answer("sqrt(1 + 1/2^30 - x) - 1/2^15", [-3, 0, 0, 1, 0, 0], "box:1,1,1") == ("crossing", 4.0)
    assert answer("sqrt(1 + 1/2^30 - x)", [-3, 0, 0, 1, 0, 0], "box:1,1,1")[0] == "miss"


def test_more_roots_than_the_exact_side_takes_are_undecided_not_wrong() -> None:
    many = " + ".join(f"sqrt((x - {k}/32)^2 + y^2 + {k + 1}/64)" for k in range(13))
    flat = f"abs({many} - ({many.replace('x', '(x + y)')}))"  # 26 square roots meet in one kink
    assert answer(flat, [-3, 0.25, 0, 1, 0, 0])[0] in ("undecided", "touch")
