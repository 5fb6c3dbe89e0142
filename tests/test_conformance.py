"""Every method × typical surfaces × devices × precisions against the oracle; a new folder is covered at once."""

from functools import cache

import numpy as np
import pytest

import surfaces
from harness.accuracy import deviations, judge, summarize, wrong_share
from harness.camera import camera_for, rays_of, scene_radius
from harness.contract import RayStatus, View
from harness.oracle import first_hits
from harness.plugins import find_methods

from .test_devices import cast

SURFACES = ("sphere", "torus", "barth_sextic")
VIEW = View("oblique", azimuth=30, elevation=35)
SIZE = 48
METHODS = [n for n, plugin in find_methods().plugins.items() if plugin.method.answers and plugin.method.casts == "rays"]
MOST_WRONG = {"sphere": 0.0, "torus": 0.0, "barth_sextic": 0.002}  # share outside the grazing class


@cache
def _case(name):
    surface = surfaces.get(name)
    rays = rays_of(camera_for(VIEW, surface), SIZE)
    return surface, rays, first_hits(surface, rays)


def _summary(surface, rays, hits, truth, precision="float32"):
    verdicts = judge(hits, truth, scene_radius(surface), 1e-3)
    found = deviations(surface, rays, hits, truth, verdicts)
    return summarize(surface, hits, truth, verdicts, found, precision=precision, footprint=0.01, grazing_margin=1e-3)


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("surface_name", SURFACES)
@pytest.mark.parametrize("method", METHODS)
def test_method_agrees_with_the_oracle(device, method, surface_name, precision):
    surface, rays, truth = _case(surface_name)
    plugin = find_methods().get(method)
    if reason := plugin.method.accepts(surface):
        pytest.skip(reason)
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    hits = cast(device, method, surface, precision, rays)
    summary = _summary(surface, rays, hits, truth, precision)
    assert wrong_share(summary) <= MOST_WRONG[surface_name], summary
    assert summary["relative_error"]["p99"] < 1e-3
    assert np.isfinite(hits.t[hits.status == RayStatus.HIT]).all()


def test_null_finds_nothing(device):
    surface, rays, _ = _case("sphere")
    hits = cast(device, "null", surface, "float32", rays)
    assert not hits.status.any()
    assert not hits.evaluations.any()


def test_newton_forward_steps_cure_the_rays_that_signed_steps_lose(device):
    """The change that methods/newton states: same rays, the printed step against ours."""
    surface, rays, truth = _case("torus")
    wrong = {}
    for forward in (0, 1):
        hits = cast(device, "newton", surface, "float32", rays, FORWARD=forward)
        wrong[forward] = wrong_share(_summary(surface, rays, hits, truth))
    assert wrong[1] == 0.0
    assert wrong[0] > 0.05


def test_a_smaller_threshold_gives_a_smaller_error(device):
    surface, rays, truth = _case("barth_sextic")
    errors = []
    for epsilon in (1e-2, 1e-3, 1e-4):
        hits = cast(device, "newton", surface, "float32", rays, EPSILON=epsilon)
        errors.append(_summary(surface, rays, hits, truth)["error"]["p99"])
    assert errors[0] > 10 * errors[1] > 10 * errors[2]
