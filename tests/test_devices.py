"""What every device must do, and that devices agree."""

import importlib.util
import os

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, RayStatus, TruthStatus, View
from harness.devices.executor import LocalExecutor
from harness.devices.interface import (
    Timing,
    find_devices,
    hits_from,
    launch_camera,
    launch_rays,
    map_rows,
    open_device,
)
from harness.devices.probes import PEAK_OPERATIONS, PEAK_SHAPES, _peak, peak_section, probe
from harness.kernels.assemble import map_program, method_program
from harness.kernels.sections import KERNELS, file_section
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of

from .conftest import opened, usable_devices

VIEW = View("oblique", azimuth=30, elevation=35)
SAME_T = 8 * 2.0**-24  # the bound on |t - t'| between devices in float32, over the distance from the eye


def cast(device, method, surface, precision, rays, **knobs):
    plugin = find_methods().get(method)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant(knobs), surface, precision, device.language, "rays"
    )
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


def test_error_free_transforms_are_exact_and_the_peak_rate_is_measured(device):
    probes = probe(device)
    assert probes.two_sum == 1.0
    assert probes.two_prod_split == 1.0
    assert probes.round_to_nearest == 1.0
    assert 0.0 < probes.peak_median_gflops <= probes.peak_gflops
    assert "multiply-adds" in probes.peak_shape


@pytest.mark.parametrize(("chains", "fused"), PEAK_SHAPES)
def test_every_loop_of_the_peak_computes_what_it_counts(device, chains, fused):
    values = map_rows(device, map_program(peak_section(chains, fused), "float32", device.language), np.ones((3, 1)), 1)
    turns = -(-PEAK_OPERATIONS // (2 * chains))
    left = 0.999**turns * chains * (chains - 1) / 2  # chain k starts at 1 + k and tends to 0.001 / (1 - 0.999) = 1
    assert np.allclose(values, chains + left, rtol=1e-3), "no compiler may leave steps out"


def test_a_peak_is_looked_for_in_loops_of_several_shapes():
    assert len({chains for chains, _ in PEAK_SHAPES}) >= 5 and {fused for _, fused in PEAK_SHAPES} == {True, False}


def test_error_free_transforms_are_exact_in_float64(device, rng):
    if not device.info.float64:
        pytest.skip("the device has no float64")
    program = map_program(file_section(KERNELS / "map/probe.glsl"), "float64", device.language)
    pairs = rng.integers(-(2**50), 2**50, (2000, 2)).astype(np.float64)
    s, e, p, q = map_rows(device, program, pairs, 6).T[:4]
    for (a, b), s_, e_, p_, q_ in zip(pairs, s, e, p, q, strict=True):
        assert int(s_) + int(e_) == int(a) + int(b)
        assert int(p_) + int(q_) == int(a) * int(b)


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_a_camera_frame_answers_as_its_listed_rays_do(device, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    surface, plugin = surfaces.get("torus"), find_methods().get("newton")
    camera = camera_for(VIEW, surface)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surface, precision, device.language, "camera"
    )
    launch = launch_camera(device, program, device.build(program), camera, 96)
    launch.run()
    frame = hits_from(launch.read())
    listed = cast(device, "newton", surface, precision, rays_of(camera, 96))
    assert np.count_nonzero(frame.status != listed.status) <= 4  # rays differ in their last bits: silhouettes may flip
    both = (frame.status == RayStatus.HIT) & (listed.status == RayStatus.HIT)
    assert np.quantile(np.abs(frame.t - listed.t)[both], 0.99) < 1e-5


@pytest.mark.parametrize("surface_name", ["sphere", "torus"])
@pytest.mark.parametrize(("method", "knobs"), [("newton", {"EPSILON": 0.00003}), ("ray_march", {"STEPS": 500})])
def test_every_device_gives_the_same_status_and_t_within_a_bound(method, knobs, surface_name):
    surface = surfaces.get(surface_name)
    rays = rays_of(camera_for(VIEW, surface), 96)
    names = [info.name for info in usable_devices()]
    if len(names) < 2:
        pytest.skip("one device has nothing to agree with")
    answers = {name: cast(opened(name), method, surface, "float32", rays, **knobs) for name in names}
    first = answers[names[0]]
    for name in names[1:]:
        other = answers[name]
        assert np.array_equal(first.status, other.status), name
        hit = first.status == RayStatus.HIT
        # a root's sensitivity grows as the ray grazes: the bound is stated for 99 % of rays, ten times it for all
        gap = np.abs(first.t - other.t)[hit] / first.t[hit]
        assert np.quantile(gap, 0.99) <= SAME_T, name
        assert gap.max() <= 10 * SAME_T, name


def test_a_run_gives_the_same_bits_twice(device):
    surface = surfaces.get("barth_sextic")
    rays = rays_of(camera_for(VIEW, surface), 64)
    one, two = (cast(device, "newton", surface, "float32", rays) for _ in range(2))
    assert np.array_equal(one.t, two.t, equal_nan=True)
    assert np.array_equal(one.evaluations, two.evaluations)


def test_timing_is_of_all_repetitions(device):
    surface, plugin = surfaces.get("sphere"), find_methods().get("null")
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surface, "float32", device.language, "camera"
    )
    launch = launch_camera(device, program, device.build(program), camera_for(VIEW, surface), 256)
    launch.run()
    timing = launch.run(20)
    assert timing.wall_ms > 0.0
    if timing.device_ms is not None:
        assert 0.0 < timing.device_ms <= 1.05 * timing.wall_ms


@pytest.mark.skipif(not importlib.util.find_spec("pyopencl"), reason="no OpenCL binding")
@pytest.mark.skipif("OCL_ICD_VENDORS" in os.environ, reason="the user's own list of drivers")
def test_a_worker_leaves_no_files_behind_and_the_environment_as_it_was(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    executor = LocalExecutor(60.0)
    try:
        found = executor.find("opencl")
    finally:
        executor.close()
    assert [info.name for info in found] == [info.name for info in find_devices("opencl")]
    assert not list(tmp_path.glob("firsthit*")) and "OCL_ICD_VENDORS" not in os.environ


@pytest.mark.parametrize("name", ["opencl:nonesuch", "opengl:nonesuch", "vulkan:0", ""])
def test_an_absent_device_is_one_line(name):
    with pytest.raises(FirsthitError, match="device"):
        open_device(name)


@pytest.mark.gpu
def test_a_gpu_agrees_with_the_oracle():
    gpus = [info.name for info in usable_devices() if "nvidia" in info.name or "amd" in info.name]
    if not gpus:
        pytest.skip("no GPU on this machine")
    surface = surfaces.get("torus")
    rays = rays_of(camera_for(VIEW, surface), 128)
    crossing = first_hits(surface, rays).status == TruthStatus.CROSSING
    for name in gpus:
        assert np.mean((cast(opened(name), "newton", surface, "float32", rays).status == 1) == crossing) > 0.999


class _BusyDevice:
    """Stands for a device whose clock is right, on a busy machine: the fastest launch waits for half its time."""

    language = "cl"

    def __init__(self) -> None:
        self.launches = 0

    def build(self, program):
        return program

    def launch(self, built, inputs, outputs, grid):
        del built, inputs, outputs, grid
        return self

    def run(self, times=1):
        del times
        self.launches += 1
        return Timing(6.0, 2.9) if self.launches % 5 == 0 else Timing(7.0, 6.6)

    def release(self):
        pass


def test_one_launch_that_had_to_wait_does_not_decide_whose_clock_is_trusted():
    assert np.median(_peak(_BusyDevice()).clock_ratios) == pytest.approx(6.6 / 7.0)


def test_a_device_without_a_clock_has_no_ratio(monkeypatch):
    monkeypatch.setattr(_BusyDevice, "run", lambda _: Timing(7.0, None))
    assert _peak(_BusyDevice()).clock_ratios == ()
