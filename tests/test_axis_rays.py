"""Rays along axes and diagonals, and a hair off them, where leading coefficients along the ray are zero or tiny: every
method of rays against right values and the oracle."""

from __future__ import annotations

import itertools
from functools import cache
from typing import Any

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import Wrong, judge
from harness.contract import RayStatus, Surface
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import scene_radius

from .conftest import all_round, opened, rotation, usable_devices
from .test_starts import cast_from

METHODS = sorted(
    name for name, plugin in find_methods().plugins.items() if plugin.method.casts == "rays" and name != "null"
)
HAIRS = (0.0, 1e-8, 1e-6, 1e-4, 1e-3)
X, FROM_X = (1, 0, 0), (-3, 0.1, 0.2)
# formula, domain, origin, direction, the first hit's t or None for a miss
TABLE: list[tuple[str, str, Any, Any, float | None]] = [
    ("x^2 - x + 0.6 + 1e-16*x^3", "sphere:1.5", FROM_X, X, None),
    ("x^2 + y^2*z - z^2", "sphere:2", (-3, 0.3, 0.2), (1, 1e-8, 1e-3), 2.84870295),
    ("x^3 + y^2 + z^2 - 0.5", "sphere:1.5", (0, -3, 0.1), (0, 1, 0), 2.3),
    ("14482-83592*x+84888*x^2+1.3e-11*x^3+8e-28*x^4", "sphere:1.5", FROM_X, X, 3.2243675),
    ("14482-83592*x+84888*x^2+1.3e-11*x^3+8e-28*x^4", "sphere:1.5", (3, 0.1, 0.2), (-1, 0, 0), 2.2396347),
    ("35842-57720*x+59800*x^2-5.2e-12*x^3+2e-28*x^4", "sphere:1.5", FROM_X, X, None),
    ("3.07e-8*x^4+3.67e-9*x^3+1.00019*x^2+1.15e-5*x-0.6976", "sphere:1.5", FROM_X, X, 2.1648491),
    ("3.07e-8*x^4+3.67e-9*x^3+1.00019*x^2+1.15e-5*x-0.6976", "sphere:1.5", (3, 0.1, 0.2), (-1, 0, 0), 2.1648606),
    ("x^4 + y^2 + z^4 - 0.5", "sphere:1.5", (0.1, -3, 0.2), (0, 1, 0), 3 - 0.70590368),
    ("x^4 + y^4 + z^4 - 1", "sphere:1.5", (0, 0, -3), (0, 0, 1), 2.0),
]
STEPS = {"newton": 1e-3, "interval_march": 1e-5, "sphere_tracing_lipschitz": 1e-4, "lu_lipschitz": 1e-4, "sturm": 2e-6}


def _ray(origin: Any, direction: Any) -> Any:
    heading = np.array(direction, float)
    return np.concatenate([origin, heading / np.linalg.norm(heading)]).astype(np.float32)[None]


FORMULAS = {key: list(rows) for key, rows in itertools.groupby(TABLE, key=lambda row: row[:2])}
DOUBLE = [info.name for info in usable_devices() if info.float64]
PLACES = [(info.name, precision) for info in usable_devices() for precision in ("float32", "float64")]


@pytest.mark.one_in(5)
@pytest.mark.parametrize(
    ("pair", "place"),
    [
        pytest.param(*each, id=str(i))
        for i, each in enumerate(rotation(list(itertools.product(FORMULAS, METHODS)), PLACES))
    ],
)
def test_tiny_leading_coefficients_change_no_answer(pair, place):
    (formula, domain), method = pair
    name, precision = place
    surface, listed = surfaces.from_formula(formula, domain), FORMULAS[formula, domain]
    rays = np.concatenate([_ray(origin, direction) for _, _, origin, direction, _ in listed])
    allowed = 64 * 2.0**-24 * surface.domain.radius + STEPS.get(method, 0.0)
    hits = cast_from(opened(name), method, surface, rays, precision)
    for i, (*_, right) in enumerate(listed if hits else []):
        assert hits is not None
        wanted = RayStatus.MISS if right is None else RayStatus.HIT
        assert hits.status[i] == wanted, (formula, i)
        assert right is None or abs(hits.t[i] - right) < allowed, (formula, i, hits.t[i])


CLUSTERED = ("x^4-202.388*x^3+15346.8*x^2-516775*x+6.52025e6", "box:0,-1,-1:100,1,1")


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("method", "where"),
    [pytest.param(m, d) for (m,), d in rotation([(m,) for m in METHODS], DOUBLE)],
)
def test_a_condition_of_1e5_is_float32s_limit_and_not_float64s(method, where):
    """Roots at 47.976 and 54.915 whose condition is 88,000 and 13,000: in float64 found; float32 may be off by
    88,000 x 2^-24 x the box's radius, a quarter, which is no fault of a method."""
    surface = surfaces.from_formula(*CLUSTERED)
    rays = np.concatenate([_ray((-1, 0.1, 0.2), X), _ray((101, 0.1, 0.2), (-1, 0, 0))])
    hits = cast_from(opened(where), method, surface, rays, "float64")
    if hits is None:
        return
    if method == "interval_march":  # naive intervals of five large terms: its budget ends, and it says so
        assert (hits.status == RayStatus.EXHAUSTED).all()
        return
    assert np.abs(hits.t - [48.9760, 46.0854]).max() < 1e-3 + 50 * STEPS.get(method, 0.0)


def _directions() -> list[Any]:
    return [np.array(v, float) for v in itertools.product((-1, 0, 1), repeat=3) if any(v)]


@cache
def _axis_case(surface: Surface) -> tuple[Any, Any]:
    """Rays along the axes and diagonals of faces and space, and a hair off, through round and random feet."""
    rng, radius, center = np.random.default_rng(5), scene_radius(surface), np.array(surface.domain.center)
    rays = []
    for way, foot_number, hair in itertools.product(_directions()[::2], range(4), HAIRS):
        heading = way / np.linalg.norm(way)
        foot = rng.uniform(-0.6, 0.6, 3) * radius
        foot = center + (np.zeros(3), np.round(foot * 8) / 8, foot, foot)[foot_number]
        ray = heading + hair * rng.normal(size=3) * (1.0 if foot_number % 2 else way == 0)
        ray /= np.linalg.norm(ray)
        rays.append(np.concatenate([foot - 4 * radius * ray, ray]))
    cast = np.array(rays, np.float32)
    return cast, first_hits(surface, cast)


LOW = [name for name in surfaces.names() if 1 <= (surfaces.get(name).degree or 0) <= 4]


@pytest.mark.one_in(6)
@pytest.mark.parametrize("name", LOW)
def test_sturm_is_right_along_axes_and_a_hair_off(name):
    surface = surfaces.get(name)
    rays, truth = _axis_case(surface)
    for precision in ("float32", "float64"):
        hits = cast_from(opened(all_round()), "sturm", surface, rays, precision)
        if hits is None:
            continue
        verdicts = judge(hits, truth, scene_radius(surface), 1e-3)
        wrong = (verdicts.wrong != Wrong.RIGHT) & ~verdicts.grazing
        assert wrong.sum() <= 0.01 * len(rays), (precision, np.flatnonzero(wrong)[:8])


@pytest.mark.parametrize("degree", [4, 6, 9])
def test_a_small_factor_makes_no_miss(degree):
    surface = surfaces.from_formula(f"1e-18*(x^{degree} + y^2 + z^2 - 0.5)", "sphere:1.5")
    hits = cast_from(opened(all_round()), "sturm", surface, _ray((0, -3, 0.1), (0, 1, 0)), "float32")
    assert hits is not None
    assert hits.status[0] == RayStatus.HIT
    assert abs(hits.t[0] - 2.3) < 1e-5
