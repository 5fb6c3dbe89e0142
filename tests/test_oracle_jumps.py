"""Hits of surfaces that jump: floor, mod, atan2, sign, if. A jump across 0 is no root; f's own value there decides."""

from __future__ import annotations

import numpy as np
import pytest
from flint import arb

import surfaces
from harness.contract import TruthStatus
from harness.oracle import balls64, first_hits
from harness.oracle.balls64 import Balls
from harness.oracle.jumps import Sided, Sided64, sides
from harness.oracle.reading import graph_of
from harness.oracle.transcendental import SmoothSolver
from tests.test_oracle_kinks import ALONG_X, answer

BACK = [3, 0.1, 0.2, -1, 0, 0]
ON_AXIS = [-3, 0, 0, 1, 0, 0]
STAR = "sqrt(x^2+y^2) - 1 - 0.3*cos(5*atan2(y,x))"
BALL = "x^2+y^2+z^2"
OF_BALL = 3 - float(np.sqrt(2 - np.float64(np.float32(0.1)) ** 2 - np.float64(np.float32(0.2)) ** 2))


@pytest.mark.parametrize(
    ("formula", "ray", "status", "t"),
    [
        ("floor(x)", ALONG_X, "touch", 3.0),
        ("floor(x)", BACK, "touch", 2.0),  # 0 all along behind x = 1, where it is still 1
        ("floor(x) + 1/2", ALONG_X, "miss", np.nan),
        ("floor(x^2)", ALONG_X, "touch", 2.0),
        ("floor(-x^2)", ALONG_X, "touch", 3.0),  # −1 on both sides, 0 at one point
        ("mod(x, 1)", ALONG_X, "touch", 2.0),
        ("mod(x, 1) - 1/2", ALONG_X, "crossing", 1.5),
        ("mod(x, 1) + 1/2", ALONG_X, "miss", np.nan),
        ("mod(x, 1) - 1", ALONG_X, "miss", np.nan),  # 0 is only the limit from one side
        ("mod(3*x, 1/2) - 1/4", BACK, "crossing", 3 - 1.75 - 1 / 6),
        ("if(x > 0, 1, -1)", ALONG_X, "miss", np.nan),
        ("sign(x)", ALONG_X, "crossing", 3.0),
        ("sign(x)*mod(x, 1) + 2", ALONG_X, "miss", np.nan),  # two jumps at one place
        ("sign(x) + floor(x) + 7/2", ALONG_X, "miss", np.nan),
        ("if(x > 0, x, -x)", ALONG_X, "touch", 3.0),
        ("if(x > 0, 2*x, x)", ALONG_X, "crossing", 3.0),
        ("if(x >= 0, 1, x)", ALONG_X, "miss", np.nan),
        ("if(x > 0, 1, x)", ALONG_X, "crossing", 3.0),
        ("if(x > 0, 1, x)", BACK, "crossing", 3.0),
        ("if(x > 0, -1, x)", ALONG_X, "touch", 3.0),
        ("if(x > 1/2, log(x), x - 3)", ALONG_X, "crossing", 4.0),
        ("if(x > 0, sqrt(x), 1)", ALONG_X, "miss", np.nan),
        ("if(x >= 0, sqrt(x), 1)", ALONG_X, "touch", 3.0),
        ("(x - 1/3)*if(x > 0, 1, -1)", ALONG_X, "crossing", 3 + 1 / 3),
        ("(x - 1/3)^2*if(x > 0, 1, -1)", ALONG_X, "touch", 3 + 1 / 3),
        ("if(x > 0 && x < 1, -1, 1)", ALONG_X, "miss", np.nan),
        ("if(x > 0 || y > 5, x - 1, -1)", ALONG_X, "crossing", 4.0),
        (f"if({BALL} > 2, 1, {BALL} - 2)", ALONG_X, "crossing", OF_BALL),  # the place of the jump is irrational
        (f"if({BALL} >= 2, 1, {BALL} - 2)", ALONG_X, "miss", np.nan),
        ("atan2(y, x)", [-1, 3, 0, 0, -1, 0], "miss", np.nan),  # from π to −π
        ("atan2(y, x)", [1, 3, 0, 0, -1, 0], "crossing", 3.0),
        ("atan2(y, x) + pi/4", [1, 3, 0, 0, -1, 0], "crossing", 4.0),
        (STAR, ON_AXIS, "crossing", 2.3),  # all along the cut
        (STAR, [-0.5, 3, 0, 0, -1, 0], "crossing", 2.22752294141308),
        (f"{STAR} + 2", [-0.5, 3, 0, 0, -1, 0], "miss", np.nan),
        ("abs(x)^(1/3) - 1/2", ALONG_X, "crossing", 2.875),
        ("abs(x)^(1/3)", ALONG_X, "touch", 3.0),
        ("abs(x - pi/3)^(7/3)*(y - 2)", ALONG_X, "touch", 3 + np.pi / 3),
        ("abs(x)^(2/3) + 1/8", ALONG_X, "miss", np.nan),
        ("abs(x)^(7/3) + abs(y)^(7/3) - 1", ON_AXIS, "crossing", 2.0),
    ],
)
def test_known_values(formula: str, ray: list[float], status: str, t: float) -> None:
    found, at = answer(formula, ray)
    assert found == status
    np.testing.assert_allclose(at, t, rtol=1e-9)


@pytest.mark.parametrize(
    ("formula", "ray", "status", "t"),
    [
        ("floor(x)", [3, 0, 0, -1, 0, 0], "miss", np.nan),  # 0 from x = 1 on, where the box ends and f is still 1
        ("floor(x)", [0, 0, 0, 1, 0, 0], "miss", np.nan),  # 0 up to x = 1, where the box begins
        ("floor(x)*(x - 3/2)", [0, 0, 0, 1, 0, 0], "crossing", 1.5),
        ("floor(x) - 1", [3, 0, 0, -1, 0, 0], "touch", 1.0),
        ("floor(x) - 2", [3, 0, 0, -1, 0, 0], "touch", 1.0),  # 0 at x = 2 alone, where the box begins
        ("floor(x) - 2", [0, 0, 0, 1, 0, 0], "touch", 2.0),
        ("if(x > 1, 1, x - 1)", [3, 0, 0, -1, 0, 0], "crossing", 2.0),
        ("if(x >= 2, 0, 1)", [0, 0, 0, 1, 0, 0], "touch", 2.0),
        ("if(x > 2, 0, 1)", [0, 0, 0, 1, 0, 0], "miss", np.nan),
        ("if(x > 2, 0, 1)", [3, 0, 0, -1, 0, 0], "miss", np.nan),
    ],
)
def test_jumps_at_the_ends_of_the_domain(formula: str, ray: list[float], status: str, t: float) -> None:
    found, at = answer(formula, ray, "box:1,-1,-1:2,1,1")
    assert found == status
    np.testing.assert_allclose(at, t, rtol=1e-12)


@pytest.mark.parametrize("formula", ["mod(x, 1) - 1/2", "sign(x)*y + z", STAR, "if(x > 0, x - y, z) - 1/4"])
def test_estimates_of_what_jumps_are_no_nan(formula: str) -> None:
    rng = np.random.default_rng(4)
    rays = np.hstack([rng.uniform(-2, 2, (40, 3)), rng.normal(size=(40, 3))]).astype(np.float32)
    truth = first_hits(surfaces.from_formula(formula, "sphere:2"), rays)
    assert not np.isnan(truth.following).any() and not np.isnan(truth.margin).any()
    assert not np.isnan(truth.contrast).any()


def test_a_jump_is_no_next_root() -> None:
    truth = first_hits(surfaces.from_formula("mod(x, 1) - 1/2", "sphere:2"), np.array([ALONG_X], np.float32))
    assert truth.following[0] == pytest.approx(2.5) or np.isinf(truth.following[0])


@pytest.mark.parametrize("formula", [STAR, "mod(x + y/3, 1) - 1/2 + z/9", "if(x > y, sin(3*x), cos(2*y)) - z"])
def test_fast_and_slow_path_agree(formula: str) -> None:
    surface = surfaces.from_formula(formula, "sphere:2")
    rng = np.random.default_rng(6)
    origins = rng.normal(size=(40, 3)) * 1.5
    directions = rng.uniform(-1, 1, (40, 3)) - origins
    rays = np.hstack([origins, directions]).astype(np.float32)
    truth = first_hits(surface, rays)
    solver = SmoothSolver(graph_of(surfaces.tape_of(surface)), surface.domain)
    for ray, status, lower, upper in zip(rays, truth.status, truth.lower, truth.upper, strict=True):
        alone = solver.first_hit(ray.tolist())
        assert alone.status == status
        if status in (TruthStatus.CROSSING, TruthStatus.TOUCH):
            assert alone.lower <= upper and lower <= alone.upper
    assert not (truth.status == TruthStatus.UNDECIDED).any()


def test_each_side_of_a_jump_holds_the_values_there() -> None:
    """Points of random boxes: their values lie in the range of at least one choice of sides, in both number systems."""
    rng = np.random.default_rng(3)
    graph = graph_of(surfaces.tape_of(surfaces.from_formula("floor(2*x) + 3*atan2(y, x)*if(z > x, 1, -2)", "sphere:9")))
    from harness.oracle import reals
    from harness.oracle.enclosure import Enclosure
    from harness.oracle.program import program_of

    program = program_of(graph)
    f, inner = Enclosure(program), program.constants.converted(reals.leaf, reals.FUNCTIONS)
    count, width = 600, 2.0 ** rng.uniform(-20, 0, 600)
    centers = rng.choice([0.0, 0.5, -0.5, -1.0], (count, 3)) + rng.uniform(-1, 1, (count, 3)) * width[:, None]
    balls = [Balls(centers[:, k], width) for k in range(3)]
    ranges = [program.run(balls, f.constants, Sided64(s, (count,)).functions()) for s in sides()]
    narrower = 0
    for k in range(count):
        box = [arb(float(c), float(width[k])) for c in centers[k]]
        exact = [program.run(box, inner, Sided(s).functions()) for s in sides()]
        narrower += max(float(e.rad()) for e in exact) < 2.0
        for place in ([1, 1, 1], [-1, -1, -1], [1, -1, 0.3], [0, 0, 0], [-0.2, 0.7, -1]):
            point = centers[k] + np.array(place) * width[k] * (1 - 1e-12)
            value = surfaces.evaluation.evaluate_tape(
                surfaces.tape_of(surfaces.from_formula("floor(2*x) + 3*atan2(y, x)*if(z > x, 1, -2)", "sphere:9")),
                point[None],
            )[0, 0]
            assert any(abs(value - r.mid[k]) <= r.rad[k] + 1e-9 for r in ranges)
            assert any(abs(arb(float(value)) - e.mid()) <= arb(e.rad()) + 1e-9 for e in exact)
    assert narrower > count // 4


def test_angles_of_boxes_that_end_next_to_the_cut() -> None:
    """A ball that holds no 0, but whose end is rounded to 0 or past it: the angle is near π there, not near −π."""
    for size in (1.0, 3.0, 0.1, 7.3):
        for gap in (2.0**-53, 2.0**-52, 2.0**-51, 2.0**-40):
            for way in (1.0, -1.0):
                y, x = Balls(np.array([way * size]), np.array([size * (1 - gap)])), Balls(np.array([-2.0]))
                angle = balls64.atan2(y, x)
                least = np.abs(y.mid) - y.rad
                exact = way * np.arctan2(least, -2.0)
                assert (np.abs(angle.mid - exact) <= angle.rad).all()


def test_slopes_prove_nothing_where_f_may_jump() -> None:
    """mod(x, 1) − 1/2 rises everywhere and changes its sign at each whole number, where it has no root."""
    surface = surfaces.from_formula("mod(x, 1) - 1/2", "box:0.25,1,1")
    truth = first_hits(surface, np.array([[-3, 0, 0, 1, 0, 0], [3, 0, 0, -1, 0, 0]], np.float32))
    assert (truth.status == TruthStatus.MISS).all()
