"""Every surface of the catalog is drawn rightly by two methods, touches and near coincidences included."""

from functools import cache

import numpy as np
import pytest

import surfaces
from harness import hardcases
from harness.accuracy.judge import Wrong, judge
from harness.contract import RayStatus, TruthStatus, View
from harness.hardcases import groups
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of, scene_radius

from .conftest import all_round, opened
from .test_devices import cast

SIZE = 40
VARIANTS = (
    ("newton", "float64", {"EPSILON": 0.00003}),
    ("ray_march", "float64", {"STEPS": 4000}),
    ("interval_march", "float32", {}),
    ("interval_march", "float64", {"TOLERANCE": 2.0**-30}),
)
THIN = {"thin_torus_1000": 0.02, "thin_torus_10000": 0.002}  # the field of view, in degrees, that shows the tube
MOST_WRONG = 0.02  # share of all rays, the grazing class included


def _view(name):
    if name not in THIN:
        return View("oblique")
    radius = surfaces.get(name).bounding_radius
    return View("close", azimuth=0.0, elevation=40.0, fov=THIN[name], distance=3.0 * radius, target=(radius, 0.0, 0.0))


@cache
def _case(name):
    surface = surfaces.get(name)
    rays = rays_of(camera_for(_view(name), surface), SIZE)
    return surface, rays, first_hits(surface, rays)


def _agrees(name, method, precision, knobs):
    surface, rays, truth = _case(name)
    device = opened(all_round())
    if "STEPS" in knobs and name in THIN:
        knobs = {"STEPS": 1_000_000}  # a step must be shorter than the tube is wide
    verdicts = judge(cast(device, method, surface, precision, rays, **knobs), truth, scene_radius(surface), 0.0)
    right = verdicts.error[np.isfinite(verdicts.error)]
    close = len(right) > 0 and np.median(right) < 1e-3 * scene_radius(surface)
    return close and np.mean(verdicts.wrong != Wrong.RIGHT) <= MOST_WRONG


@pytest.mark.one_in(5)
@pytest.mark.parametrize("name", surfaces.names())
def test_a_surface_is_drawn_as_the_oracle_sees_it(name):
    _, _, truth = _case(name)
    assert (truth.status != TruthStatus.UNDECIDED).all()
    assert np.mean(truth.status != TruthStatus.MISS) > 0.02, "the view shows next to nothing"
    agreeing = {method for method, precision, knobs in VARIANTS if _agrees(name, method, precision, knobs)}
    assert len(agreeing) >= 2


CASTERS = {n: plugin.method for n, plugin in find_methods().plugins.items() if plugin.method.casts == "rays"}
NEVER_MISSES = [name for name, method in CASTERS.items() if "no_missed_root" in method.claims]
FINDS_TOUCHES = [name for name, method in CASTERS.items() if "finds_touch" in method.claims]


@pytest.mark.one_in(3)
@pytest.mark.parametrize("family", hardcases.names())
@pytest.mark.parametrize("method", NEVER_MISSES)
def test_a_method_that_claims_it_misses_no_root_of_any_hard_case(method, family):
    device = opened(all_round())
    accepted = [group for group in groups.groups(family) if CASTERS[method].accepts(group.surface) is None]
    if not accepted:
        pytest.skip(f"{method} accepts none of the family's surfaces")
    for group in accepted:
        truth = first_hits(group.surface, group.rays)
        hits = cast(device, method, group.surface, "float32", group.rays)
        there = (truth.status == TruthStatus.CROSSING) | (truth.status == TruthStatus.TOUCH)
        assert not np.any(there & (hits.status == RayStatus.MISS))
        later = hits.t > truth.upper + 1e-3 * group.surface.domain.radius
        assert not np.any(there & (hits.status == RayStatus.HIT) & later)


@pytest.mark.parametrize("method", FINDS_TOUCHES)
def test_a_method_that_claims_it_finds_touches(method):
    surface, rays, truth = _case("plane_squared")
    if reason := CASTERS[method].accepts(surface):
        pytest.skip(f"{reason}; tests/test_conformance.py has touches of a sphere and a torus")
    hits = cast(opened(all_round()), method, surface, "float32", rays)
    touches = truth.status == TruthStatus.TOUCH
    assert touches.sum() > 100
    assert (hits.status[touches] == RayStatus.HIT).all()
