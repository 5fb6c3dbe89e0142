"""The oracle against Sturm's theorem on rays made to be hard: ends of clip intervals, tangents, distant origins."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

import surfaces
from harness.contract import TruthStatus
from harness.oracle import first_hits

from .test_oracle_formulas import check_all, clip, rays_at


def test_roots_at_the_ends_of_the_clip_interval() -> None:
    rays = np.array(
        [
            [-2, 0, 0, 1, 0, 0],  # enters and leaves at a root
            [-2, 0.5, 0.25, 1, 0, 0],
            [1, 0, 0, 1, 0, 0],  # starts on the surface, leaving the box: a clip interval of length 0
            [1, 0.25, 0.5, -1, 0, 0],  # starts on the surface, entering
            [-2, 1, 0, 1, 0, 0],  # along a face of the box
            [0, 2, 0, 1, -1, 0],  # through an edge of the box only
            [0, 0.5, 0, 1, 0, 0],  # starts inside
            [3, 0, 0, 1, 0, 0],  # leads away
            [-2, 1.5, 0, 1, 0, 0],  # misses the domain
        ],
        np.float32,
    )
    for formula in ("x^2 - 1", "(x - 1)^2", "(x + 1)*(x - 1)^3", "x + y - 2", "x"):
        for domain in ("box:1,1,1", "sphere:1"):
            check_all(surfaces.from_formula(formula, domain), rays)
    check_all(surfaces.from_formula("x^2 + y^2 + z^2 - 1", "box:1,1,1"), rays)


def test_a_sphere_that_is_its_own_domain() -> None:
    """Every root lies exactly at an irrational end of the clip interval."""
    surface = surfaces.from_formula("x^2 + y^2 + z^2 - 1", "sphere:1")
    rays = rays_at(np.random.default_rng(5), 60, 1.0, coarse=False)
    truth = first_hits(surface, rays)
    for ray, status in zip(rays, truth.status, strict=True):
        exact = [Fraction(float(v)) for v in ray]
        inside = sum(v * v for v in exact[:3]) <= 1
        expected = TruthStatus.MISS if clip(surface, exact) is None else TruthStatus.CROSSING
        assert status == (TruthStatus.CROSSING if inside else expected)


@pytest.mark.parametrize("distance", [1.0, 1e3, 1e6])
def test_distant_origins(distance: float) -> None:
    rng = np.random.default_rng(9)
    surface = surfaces.get("torus")
    targets = rng.uniform(-0.8, 0.8, size=(25, 3)) * [1, 1, 0.3]
    back = rng.normal(size=(25, 3))
    back /= np.linalg.norm(back, axis=1, keepdims=True)
    rays = np.hstack([targets + distance * back, -back]).astype(np.float32)
    statuses = check_all(surface, rays)
    assert (statuses == TruthStatus.MISS).any() or distance < 1e6
    assert (statuses == TruthStatus.CROSSING).any() or distance > 1e3


def test_torus_axis_and_tangent_planes() -> None:
    """Axis rays, four-hit rays, rays in the plane that touches the torus along its top circle."""
    surface = surfaces.from_formula("(x^2 + y^2 + z^2 + 9/16 - 1/16)^2 - 9/4*(x^2 + y^2)", "box:1,1,0.5")
    rays = np.array(
        [
            [0, 0, 2, 0, 0, -1],
            [2, 0, 0, -1, 0, 0],
            [2, 0.5, 0, -1, 0, 0],  # tangent to the inner circle
            [2, 0, 0.25, -1, 0, 0],  # in the upper tangent plane, touching twice
            [0.75, 0, 2, 0, 0, -1],  # straight down on the top circle
            [1, -2, 0, 0, 1, 0],  # tangent to the outer circle at the box's face
            [0.5, 0, 2, 0, 0, -1],  # tangent to the inside of the hole
            [0.75, 0, 0, 0, 0, 1],  # from inside
            [0.75, 0, 0.25, 1, 0, 0],  # from the top circle, in its tangent plane
        ],
        np.float32,
    )
    statuses = check_all(surface, rays)
    touching = [TruthStatus.TOUCH if k in (3, 5, 6, 8) else TruthStatus.CROSSING for k in range(1, 9)]
    assert statuses.tolist() == [TruthStatus.MISS, *touching]


def test_directions_that_lower_the_degree_and_vanishing_lines() -> None:
    surface = surfaces.from_formula("x^3*y - z + z^5", "sphere:2")
    rays = np.array(
        [[0, 0, 3, 0, 0, -1], [0, -3, 0, 0, 1, 0], [1, -3, 0, 0, 1, 0], [-3, 0, 0.5, 1, 0, 0], [0, 0.5, 0, 1, 0, 0]],
        np.float32,
    )
    statuses = check_all(surface, rays)
    assert statuses[1] == TruthStatus.TOUCH  # f vanishes all along this ray


@pytest.mark.parametrize("scale", ["1/10^30", "10^30"])
def test_huge_and_tiny_coefficients_and_directions(scale: str) -> None:
    surface = surfaces.from_formula(f"{scale}*(x^4 + y^4 + z^4 - 1)", "sphere:1.5")
    rng = np.random.default_rng(3)
    for length in (1e-20, 1.0, 1e20):
        rays = rays_at(rng, 10, 1.5, coarse=False)
        rays[:, 3:] *= np.float32(length)
        check_all(surface, rays)


@pytest.mark.parametrize("exponent", [30, 44, 50, 56, 62])
def test_planes_at_the_end_of_a_nearly_tangent_chord(exponent: int) -> None:
    """The domain is grazed so that float64 knows the chord's ends badly; planes cross the ray just in and out of it."""
    slant = 2.0**-exponent
    half = 2.0 * slant**0.5
    rays = np.array([[-2, 1, 0, 1, -slant, 0]], np.float32)
    seen = set()
    for k in range(0, 30, 3):
        for side in (-1, 1):
            numerator, denominator = (half * (1 + side * 2.0**-k)).as_integer_ratio()
            surface = surfaces.from_formula(f"x + {numerator}/{denominator}", "sphere:1")
            seen |= set(check_all(surface, rays).tolist())
    assert seen == {TruthStatus.MISS, TruthStatus.CROSSING}
