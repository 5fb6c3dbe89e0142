"""The prepass leaves every root to its ray, and no method loses one by it."""

from functools import cache

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import Wrong, judge
from harness.accuracy.pixels import pixels_of
from harness.contract import RayStatus, TruthStatus, View
from harness.devices.interface import Reserved, hits_from, real_type
from harness.devices.narrowed import launch_narrowed_camera, launch_narrowed_rays
from harness.devices.quadtree import LEVELS, first_level, last_level, quadtree_steps
from harness.kernels import prepass
from harness.kernels.assemble import method_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of, scene_radius

from .conftest import opened, usable_devices
from .test_devices import cast
from .test_renders import _case, _view

METHODS = [n for n, p in find_methods().plugins.items() if p.method.casts == "rays" and p.method.answers]
VIEW = View("oblique", azimuth=30, elevation=35)
STARTS_MATTER = ("newton",)  # it may step over a thin part from one start and not from another
SIZE, RAYS = 100, 40  # no power of two, and not whole tiles


def spans(device, surface, camera, size):
    """Depths [tiles, tiles, 2] that the prepass hands out, and the evaluations it spent."""
    program = prepass.program(surface, "float32", device.language)
    last, across = last_level(size), prepass.tiles_per_side(size)
    stop = max(0, last - prepass.TILE_BITS)
    steps, queue = quadtree_steps(device, device.build(program), size, first_level(device.info, stop), last, stop)
    values = 2 * across**2
    reserved = [Reserved(values, real_type(program)), Reserved(values, np.int32)]
    scratch = [Reserved(queue, np.int32), Reserved(LEVELS, np.int32)]
    launch = device.launch_steps([camera, *reserved, *scratch], (1, 2), steps)
    launch.run()
    depths, spent = launch.read()
    launch.release()
    return depths.reshape(across, across, 2).astype(np.float64), int(spent.sum())


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", surfaces.names())
def test_every_root_lies_between_the_depths_of_its_tile(name):
    device = opened(usable_devices()[0].name)
    surface, rays, truth = _case(name)
    camera = camera_for(_view(name), surface)
    side = round(len(rays) ** 0.5)
    depths, spent = spans(device, surface, camera, SIZE)
    row, column = np.divmod(pixels_of(camera, side, SIZE).index, SIZE)
    s0, s1 = depths[row >> prepass.TILE_BITS, column >> prepass.TILE_BITS].T
    there = np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))
    at = rays[:, 3:].astype(np.float64) @ camera[3:6].astype(np.float64)
    assert (s0 <= truth.lower * at)[there].all()
    assert (truth.upper * at <= s1)[there].all()
    assert 0 < spent < 2.0 * SIZE**2


def narrowed(device, method, surface, camera, precision="float32", rays=None, size=SIZE, origin="nearest", **knobs):
    """Hits of listed rays, or of every pixel, behind the prepass."""
    plugin = find_methods().get(method)
    entry = "camera" if rays is None else "rays"
    programs = (
        prepass.program(surface, precision, device.language),
        method_program(
            plugin.method,
            plugin.folder,
            plugin.variant(knobs),
            surface,
            precision,
            device.language,
            entry,
            prepass.parameters(),
            origin=origin,
        ),
    )
    built = tuple(device.build(program) for program in programs)
    if rays is None:
        launch = launch_narrowed_camera(device, programs, built, camera, size)
    else:
        pixels = pixels_of(camera, round(len(rays) ** 0.5), size).index
        launch = launch_narrowed_rays(device, programs, built, camera, size, rays, pixels)
    launch.run()
    hits = hits_from(launch.read()[:2])
    launch.release()
    return hits


@cache
def _typical(name):
    surface = surfaces.get(name)
    camera = camera_for(VIEW, surface)
    rays = rays_of(camera, RAYS)
    return surface, camera, rays, first_hits(surface, rays)


def lost(plain, behind, truth, surface):
    """Rays whose root the method finds, and not behind the prepass; rays near another answer may go either way."""
    before, after = (judge(hits, truth, scene_radius(surface), 1e-3) for hits in (plain, behind))
    there = np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)) & ~before.grazing
    return there & (before.wrong == Wrong.RIGHT) & (after.wrong != Wrong.RIGHT)


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", ["torus", "barth_sextic", "dingdong_beamcasting"])
@pytest.mark.parametrize("method", METHODS)
def test_no_method_loses_a_root_behind_it(method, name):
    device = opened(usable_devices()[0].name)
    surface, camera, rays, truth = _typical(name)
    if reason := find_methods().get(method).method.accepts(surface):
        pytest.skip(reason)
    plain = cast(device, method, surface, "float32", rays)
    behind = narrowed(device, method, surface, camera, rays=rays)
    most = 2 if method in STARTS_MATTER else 0
    assert lost(plain, behind, truth, surface).sum() <= most
    assert behind.evaluations.sum() <= 1.05 * plain.evaluations.sum()


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_every_device_narrows(device, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    surface, camera, rays, truth = _typical("barth_sextic")
    plain = cast(device, "ray_march", surface, precision, rays, STEPS=1000)
    behind = narrowed(device, "ray_march", surface, camera, precision, rays, size=400, STEPS=1000)
    assert not lost(plain, behind, truth, surface).any()
    assert behind.evaluations.sum() < 0.7 * plain.evaluations.sum()


def test_the_timed_frame_answers_as_the_checked_rays_do(device):
    surface, camera, _, _ = _typical("torus")
    frame = narrowed(device, "newton", surface, camera)
    listed = narrowed(device, "newton", surface, camera, rays=rays_of(camera, SIZE))
    assert np.count_nonzero(frame.status != listed.status) <= 4
    both = (frame.status == RayStatus.HIT) & (listed.status == RayStatus.HIT)
    assert np.quantile(np.abs(frame.t - listed.t)[both], 0.99) < 1e-5
    assert np.array_equal(frame.t, narrowed(device, "newton", surface, camera).t, equal_nan=True)
