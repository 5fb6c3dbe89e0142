"""A frame of tiles answers the same whoever has a tile's sixteen lanes."""

import numpy as np
import pytest

import surfaces
from harness.contract import DeviceInfo, RayStatus, View
from harness.devices.interface import hits_from, launch_camera
from harness.devices.tiles import tile_hits_from
from harness.experiment.kinds.tiles import frame_of
from harness.kernels.assemble import lanes_on, method_program
from harness.plugins import find_methods
from harness.scenes.camera import camera_for

from .conftest import opened, usable_devices

GPUS = {"opencl:nvidia": 2048, "opencl:amd": 2048, "opengl:nvidia": 2048, "opencl:pocl": None, "opengl:llvmpipe": None}
SIZE = 404  # the tiles of both levels reach out of it
VIEW = View("seen", azimuth=30, elevation=35)
SHUFFLES = "opencl:intel"  # its compiler has the exchanges of "warp"
FORMS = {  # by the kind of device, or the device: who has the lanes, where a compiler gets that right in a few seconds
    ("opencl", "torus", "float32"): "vector",
    ("opencl", "sphere", "float64"): "vector",
    ("opengl", "torus", "float32"): "own",
    ("opengl", "sphere", "float64"): "group",
    (SHUFFLES, "sphere", "float32"): "warp",
}


def outputs_of(launch):
    launch.run()
    outputs = [values.copy() for values in launch.read()]
    launch.release()
    return outputs


def stated(name, device, surface, precision):
    plugin = find_methods().get(name)
    return plugin.method, plugin.folder, plugin.variant({}), surface, precision, device.language


def device_for(kind, precision):
    """A device whose name begins so and that has the precision; for float64 the last one, for float32 the first."""
    found = [
        info for info in usable_devices() if info.name.startswith(kind) and (precision == "float32" or info.float64)
    ]
    if not found:
        pytest.skip(f"no {kind} with {precision} here")
    return opened(found[0 if precision == "float32" else -1].name)


@pytest.mark.one_in(4)
@pytest.mark.parametrize("case", FORMS, ids=lambda case: f"{FORMS[case]}-{case[1]}-{case[2]}")
def test_every_form_of_the_lanes_answers_as_each_ray_alone(case):
    kind, name, precision = case
    lanes, device, surface = FORMS[case], device_for(kind, precision), surfaces.get(name)
    camera = camera_for(VIEW, surface)
    alone = method_program(*stated("bernstein", device, surface, precision), "camera")
    expected = hits_from(outputs_of(launch_camera(device, alone, device.build(alone), camera, SIZE)))
    hit = expected.status == RayStatus.HIT
    tiled = stated("tiles", device, surface, precision)
    programs = [method_program(*tiled, stage, lanes=lanes) for stage in ("isolate", "finish", "packets", "rest")]
    built = [device.build(program) for program in programs]
    hits, stages = tile_hits_from(outputs_of(frame_of(tuple(programs), surface, camera, SIZE).launch(device, built)))
    assert np.array_equal(hits.status, expected.status)
    assert np.abs(hits.t - expected.t)[hit].max() < 2e-5 * surface.domain.radius
    shares = np.bincount(stages, minlength=6) / SIZE**2
    assert 0.15 < shares[:2].sum() < 0.5, shares  # empty
    assert 0.4 < shares[2:4].sum() < 0.8, shares  # single
    assert shares[4:].sum() < 0.12, shares
    assert (shares[4] == 0) == (lanes != "vector"), shares


def test_a_device_that_is_no_processor_has_lanes_of_its_own():
    found = {name: DeviceInfo(name, "", "", "", 1, True, "device", (), resident=of) for name, of in GPUS.items()}
    chosen = [lanes_on("cl" if name.startswith("opencl") else "glsl", info) for name, info in found.items()]
    assert chosen == ["warp", "group", "group", "vector", "own"]


def test_a_stage_is_made_of_the_kernel_and_of_its_own_files_and_of_no_other_stages():
    plugin = find_methods().get("tiles")
    given = plugin.method, plugin.folder, plugin.variant({}), surfaces.get("torus"), "float32", "cl"
    files = {
        "isolate": ["kernel", "isolate"],
        "finish": ["kernel", "correct", "refine", "finish"],
        "packets": ["kernel", "correct", "refine", "packets"],
        "rest": ["correct", "rest"],
    }
    for stage in files:
        program = method_program(*given, stage)
        own = [section.origin for section in program.sections if section.origin.startswith("methods/tiles/")]
        assert own == [f"methods/tiles/{name}.glsl" for name in files[stage]]
