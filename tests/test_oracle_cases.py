"""Rays on which solvers are known to fail, with the right values; distance functions; balls off the centre."""

from __future__ import annotations

import os
import random

import numpy as np
import pytest

import surfaces
from harness.contract import Box, Sphere, Surface, TruthStatus
from harness.oracle import first_hits
from tests.test_oracle_formulas import check_all, random_formula, rays_at

RAYS = int(os.environ.get("FIRSTHIT_RAYS", "150"))  # of each distance function; the promise is for 2,000
CROSSING, TOUCH, MISS = "crossing", "touch", "miss"
UNIT = "x^2 + y^2 + z^2 - 1"
FLAT = "14482-83592*x+84888*x^2+1.3e-11*x^3+8e-28*x^4"
NONE = "35842-57720*x+59800*x^2-5.2e-12*x^3+2e-28*x^4"
QUARTIC = "x^4-202.388*x^3+15346.8*x^2-516775*x+6.52025e6"
NEARLY_SQUARE = "3.07e-8*x^4+3.67e-9*x^3+1.00019*x^2+1.15e-5*x-0.6976"


@pytest.mark.parametrize(
    ("formula", "domain", "ray", "status", "t", "within"),
    [
        (QUARTIC, "box:0,0,0:100,100,100", [-1, 50, 50, 1, 0, 0], CROSSING, 48.9760, 1e-4),
        (QUARTIC, "box:0,0,0:100,100,100", [101, 50, 50, -1, 0, 0], CROSSING, 46.0854, 1e-4),
        (NEARLY_SQUARE, "sphere:2", [-2, 0, 0, 1, 0, 0], CROSSING, 2 - 0.835, 1e-3),
        (NEARLY_SQUARE, "sphere:2", [2, 0, 0, -1, 0, 0], CROSSING, 2 - 0.835, 1e-3),
        ("x^2+y^2+z^2-.01", "sphere:1", [-1e7, 0.095, 0, 1, 0, 0], CROSSING, 9999999.968775, 1e-6),
        ("x^2+y^2+z^2-.01", "sphere:1", [-1e7, 0.0999, 0, 1, 0, 0], CROSSING, 1e7 - 0.00447101778, 1e-6),
        ("x^2+y^2+z^2-.01", "sphere:1", [-1e7, 0.1001, 0, 1, 0, 0], MISS, np.nan, 0),
        (UNIT, "sphere:2", [-3, 1, 0, 1, 0, 0], TOUCH, 3.0, 1e-12),
        ("x^2+z^2-.01", "sphere:1", [0.1, 0, -3, 0, 0, 1], MISS, np.nan, 0),  # by 1.5e-9
        (f"({UNIT})*(x^2+y^2+z^2-1.00004^2)", "sphere:2", [-3, 0, 0, 1, 0, 0], CROSSING, 3 - 1.00004, 1e-12),
        (f"({UNIT})*(x^2+y^2+z^2-1.00004^2)", "sphere:2", [0, 3, 0, 0, -2, 0], CROSSING, 1.5 - 0.50002, 1e-12),
        (UNIT, "sphere:2", [1, 0, 0, 1, 0, 0], CROSSING, 0.0, 1e-12),  # leaving
        (UNIT, "sphere:2", [1, 0, 0, 0, 1, 0], TOUCH, 0.0, 1e-12),  # grazing
        (UNIT, "sphere:2", [1, 0, 0, -1, 0, 0], CROSSING, 0.0, 1e-12),  # entering
        (FLAT, "sphere:2", [0, 0, 0, 1, 0, 0], CROSSING, 0.224367, 1e-5),
        (FLAT, "sphere:2", [2, 0, 0, -1, 0, 0], CROSSING, 2 - 0.760, 1e-3),
        (NONE, "sphere:10", [-10, 0, 0, 1, 0, 0], MISS, np.nan, 0),
        (NONE, "sphere:10", [10, 0, 0, -1, 0, 0], MISS, np.nan, 0),
    ],
)
def test_rays_that_solvers_fail_on(
    formula: str, domain: str, ray: list[float], status: str, t: float, within: float
) -> None:
    truth = first_hits(surfaces.from_formula(formula, domain), np.array([ray], np.float32))
    assert TruthStatus(truth.status[0]).name.lower() == status
    if status != MISS:
        assert truth.lower[0] - within <= t <= truth.upper[0] + within
        assert truth.upper[0] - truth.lower[0] <= max(1e-11, abs(t) * 2.0**-48)


def test_the_cylinder_of_a_tenth_is_missed_by_a_billionth() -> None:
    truth = first_hits(surfaces.from_formula("x^2+z^2-.01", "sphere:1"), np.array([[0.1, 0, -3, 0, 0, 1]], np.float32))
    assert truth.margin[0] == pytest.approx(float(np.float32(0.1)) - 0.1, rel=0.01)


def capsule(k: int) -> str:
    return f"sqrt((x-{k}/9)^2 + max(abs(y)-0.5, 0)^2 + z^2) - 0.2"


BOX = (
    "sqrt(max(abs(x)-0.5,0)^2+max(abs(y)-0.4,0)^2+max(abs(z)-0.3,0)^2)"
    "+min(max(abs(x)-0.5,max(abs(y)-0.4,abs(z)-0.3)),0)-0.05"
)
SPHERE = "sqrt(x^2+y^2+z^2)-1"
TORUS = "sqrt((sqrt(x^2+y^2)-0.8)^2+z^2)-0.3"
CONE = "max(0.8*sqrt(x^2+y^2)+0.6*z-0.5, -z-0.75)"
MANY = "min(" + ", ".join(
    f"sqrt((x-{(7 * k % 13 - 6) / 8})^2+(y-{(5 * k % 11 - 5) / 8})^2+(z-{(3 * k % 9 - 4) / 8})^2)-{(k % 4 + 1) / 16}"
    for k in range(30)
) + ")"  # fmt: skip
DISTANCES = {
    "sphere": SPHERE,
    "ellipsoid": "sqrt(2*x^2+y^2)-1",
    "ellipsoid of three": "sqrt(2*x^2+y^2+3*z^2)-1",
    "torus": TORUS,
    "box": BOX,
    "capsule": capsule(0),
    "cone": CONE,
    "union": f"min({SPHERE}+0.5, {TORUS}, {CONE})",
    "intersection": f"max({SPHERE}+0.3, {BOX})",
    "difference": f"max({BOX}, -({SPHERE}+0.5))",
    "smooth minimum": f"-log(exp(-8*({SPHERE}+0.5))+exp(-8*({TORUS})))/8",
    "polynomial smooth minimum": f"let a = {capsule(3)}; let b = {TORUS}; let h = max(0.25-abs(a-b), 0)/0.25;"
    " min(a, b) - h*h*0.25/4",
    "thirty spheres": MANY,
    "rounded": f"abs({BOX}) - 0.02",
}


def ball_rays(count: int, seed: int) -> np.ndarray:
    """Rays towards the ball of radius 1, a third of them along axes, diagonals and coarse grids."""
    rng = np.random.default_rng(seed)
    origins = rng.normal(size=(count, 3))
    origins *= 3.0 / np.linalg.norm(origins, axis=1, keepdims=True)
    directions = rng.uniform(-0.8, 0.8, (count, 3)) - origins
    coarse = rng.random(count) < 1 / 3
    step = rng.choice([-1.0, 0.0, 1.0], (count, 3))
    step[~step.any(axis=1), 0] = 1.0
    origins[coarse] = (rng.integers(-3, 4, (count, 3)) / 4 - 3 * step)[coarse]
    directions[coarse] = step[coarse]
    return np.hstack([origins, directions]).astype(np.float32)


@pytest.mark.parametrize("name", DISTANCES)
def test_distance_functions_are_decided(name: str) -> None:
    surface = surfaces.from_formula(DISTANCES[name], "sphere:2")
    rays = ball_rays(RAYS if len(name) < 14 or RAYS > 150 else RAYS // 3, seed=len(name))
    truth = first_hits(surface, rays)
    assert (truth.status == TruthStatus.UNDECIDED).sum() * 1000 < max(RAYS, 1000)
    assert (truth.status == TruthStatus.CROSSING).any() and (truth.status == TruthStatus.MISS).any()
    hit = np.isfinite(truth.lower)
    near = rays[hit, :3] + (0.5 * (truth.lower + truth.upper))[hit, None] * rays[hit, 3:].astype(np.float64)
    assert np.abs(surfaces.evaluate(surface, near)).max() < 1e-9


@pytest.mark.parametrize("seed", range(4))
def test_balls_off_the_centre(seed: int) -> None:
    """Random polynomials in balls about other points, against Sturm's theorem in exact fractions."""
    pick, rng = random.Random(seed), np.random.default_rng(seed)
    center = tuple(pick.randint(-20, 20) / 8 for _ in range(3))
    domain = Sphere(pick.choice([0.75, 1.5]), center)
    surface = surfaces.from_formula(random_formula(pick, 3 + seed), domain)
    for coarse in (False, True):
        rays = rays_at(rng, 15, 1.5, coarse)
        rays[:, :3] += np.array(center, np.float32)
        statuses = check_all(surface, rays)
        assert not (statuses == TruthStatus.UNDECIDED).any()


@pytest.mark.parametrize("center", [(3.0, -5.0, 8.0), (1e4, 2e4, -3e4)])
def test_what_is_moved_with_its_domain_is_hit_at_the_same_places(center: tuple[float, float, float]) -> None:
    """All numbers are short, so that the moved rays and surfaces are exactly the moved ones."""
    x, y, z = (f"({axis} - ({int(c)}))" for axis, c in zip("xyz", center, strict=True))
    rng = np.random.default_rng(2)
    origins = rng.integers(-24, 25, (60, 3)) / 8
    directions = rng.integers(-8, 9, (60, 3)) / 8
    directions[~directions.any(axis=1), 0] = 1.0
    rays = np.hstack([origins, directions]).astype(np.float32)
    moved = rays.copy()
    moved[:, :3] += np.array(center, np.float32)

    def compare(here: Surface, there: Surface) -> None:
        a, b = first_hits(here, rays), first_hits(there, moved)
        assert a.status.tolist() == b.status.tolist()
        assert (a.status == TruthStatus.CROSSING).any()
        hit = np.isfinite(a.lower)
        assert ((a.lower <= b.upper) & (b.lower <= a.upper))[hit].all()
        np.testing.assert_allclose(a.following, b.following, rtol=1e-6)
        if here.algebraic:  # at kinks, a margin depends on where samples happen to lie
            np.testing.assert_allclose(a.margin, b.margin, rtol=1e-4, atol=1e-9)

    for text in ("{x}^2 + {y}^2*{z} - 1/2", "sqrt({x}^2 + {y}^2) - 1 + abs({z})/2", "max({x}, {y}, {z}) - 1/4"):
        here, there = text.format(x="x", y="y", z="z"), text.format(x=x, y=y, z=z)
        compare(surfaces.from_formula(here, Sphere(1.5)), surfaces.from_formula(there, Sphere(1.5, center)))
        low, high = (tuple(s * 1.5 + c for c in center) for s in (-1, 1))
        compare(surfaces.from_formula(here, "box:1.5,1.5,1.5"), surfaces.from_formula(there, Box(low, high)))
