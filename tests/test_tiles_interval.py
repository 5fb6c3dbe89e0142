"""Tiles by intervals find the first roots of any f: for all rays of a tile, at its rim, and from inside the domain."""

import dataclasses
from functools import cache

import numpy as np
import pytest

import surfaces
from harness.contract import RayStatus, View
from harness.devices.messages import ListedCheck
from harness.devices.tiles import TileCheck
from harness.experiment.kinds.tiles import CHECKED, frame_of
from harness.kernels.assemble import method_program
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of

from .conftest import opened, usable_devices

SIZE = 96
VIEWS = [View("far", azimuth=30, elevation=35), View("inside", azimuth=70, elevation=10, distance=0.4, fov=60)]
WAVY = surfaces.from_formula("abs(x^2 + y^2 + z^2 - 1) - 0.3*sin(4*x)", "sphere:1.2", "wavy")
DEVICES = [info.name for info in usable_devices()]
pytestmark = pytest.mark.skipif(not DEVICES, reason="no device")


@cache
def programs(name):
    plugin = find_methods().get("tiles_interval")
    stated = plugin.method, plugin.folder, plugin.variant({}), WAVY, "float32", opened(name).language
    return tuple(method_program(*stated, entry) for entry in CHECKED)


@cache
def built(name):
    return [opened(name).build(program) for program in programs(name)]


@cache
def alone(name, view):
    """What interval_march answers for the same rays, each alone."""
    device, plugin = opened(name), find_methods().get("interval_march")
    stated = plugin.method, plugin.folder, plugin.variant({}), WAVY, "float32", device.language
    check = ListedCheck(method_program(*stated, "rays"), rays_of(camera_for(view, WAVY), SIZE))
    return check.run(device, [device.build(program) for program in check.programs])


def cast(name, view, isolate=None):
    """A frame's answers; `isolate` is another program, and the same built, that isolates."""
    camera, device = camera_for(view, WAVY), opened(name)
    mine, made = list(programs(name)), list(built(name))
    if isolate:
        mine[0], made[0] = isolate, device.build(isolate)
    rays = rays_of(camera, SIZE)
    check = TileCheck(frame_of(tuple(mine), WAVY, camera, SIZE), rays, 1, np.arange(len(rays)))
    return check.run(device, made)


def differing(found, expected):
    """The share of rays that are answered otherwise, by more than 1e-4."""
    hit = (found.status == RayStatus.HIT) & (expected.status == RayStatus.HIT)
    far = hit & ~(np.abs(found.t - expected.t) < 1e-4)
    return float(np.mean((found.status != expected.status) | far))


@pytest.mark.parametrize("name", DEVICES)
def test_each_pixel_has_the_first_root_on_its_ray(name):
    for view in VIEWS:
        answer = cast(name, view)
        assert differing(answer.hits, alone(DEVICES[0], view)) < 1e-3
        assert sum(answer.shares.values()) == pytest.approx(1.0)
        assert answer.shares["rest"] < 0.05
        assert sum(share for stage, share in answer.shares.items() if "_" in stage) > 0.05  # tiles decide


BREAKS = {
    "a root at the far end that is not sure": ("far_most < -aside;", "far_most < 64.0 * aside;"),
    "a piece that is taken for empty": ("|| clear || rises ||", "|| clear || rises || near > 0.0 ||"),
}


@pytest.mark.parametrize("name", BREAKS)
def test_a_broken_verdict_is_caught(name):
    right = programs(DEVICES[0])[0]
    old, new = BREAKS[name]
    assert sum(section.text.count(old) for section in right.sections) == 1
    sections = tuple(dataclasses.replace(s, text=s.text.replace(old, new)) for s in right.sections)
    wrong = cast(DEVICES[0], VIEWS[0], dataclasses.replace(right, sections=sections))
    assert differing(wrong.hits, alone(DEVICES[0], VIEWS[0])) > 2e-3
