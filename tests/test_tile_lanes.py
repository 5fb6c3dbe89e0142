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

GPUS = {"opencl:nvidia": 2048, "opencl:amd": 2048, "opengl:nvidia": 2048, "opencl:pocl": None, "opengl:llvmpipe": None}
SIZE = 404  # the tiles of both levels reach out of it
VIEW = View("seen", azimuth=30, elevation=35)
FORMS = {"cl": ["vector"], "glsl": ["group", "own"]}  # those that a processor's compiler gets right in a few seconds
SHUFFLES = "opencl:intel"  # its compiler has the exchanges of "warp"


def outputs_of(launch):
    launch.run()
    outputs = [values.copy() for values in launch.read()]
    launch.release()
    return outputs


def stated(name, device, surface, precision):
    plugin = find_methods().get(name)
    return plugin.method, plugin.folder, plugin.variant({}), surface, precision, device.language


@pytest.mark.parametrize(("name", "precision"), [("torus", "float32"), ("sphere", "float64")])
def test_every_form_of_the_lanes_answers_as_each_ray_alone(device, name, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("no float64 here")
    surface = surfaces.get(name)
    camera = camera_for(VIEW, surface)
    alone = method_program(*stated("bernstein", device, surface, precision), "camera")
    expected = hits_from(outputs_of(launch_camera(device, alone, device.build(alone), camera, SIZE)))
    hit = expected.status == RayStatus.HIT
    more = ["warp"] if device.info.name == SHUFFLES and name == "sphere" else []
    for lanes in (*FORMS[device.language], *more):
        tiled = stated("tiles", device, surface, precision)
        programs = [method_program(*tiled, stage, lanes=lanes) for stage in ("isolate", "finish", "packets", "rest")]
        built = [device.build(program) for program in programs]
        hits, stages = tile_hits_from(
            outputs_of(frame_of(tuple(programs), surface, camera, SIZE).launch(device, built))
        )
        assert np.array_equal(hits.status, expected.status), lanes
        assert np.abs(hits.t - expected.t)[hit].max() < 2e-5 * surface.domain.radius, lanes
        shares = np.bincount(stages, minlength=6) / SIZE**2
        assert 0.15 < shares[:2].sum() < 0.5, (lanes, shares)  # empty
        assert 0.4 < shares[2:4].sum() < 0.8, (lanes, shares)  # single
        assert shares[4:].sum() < 0.12, (lanes, shares)
        assert (shares[4] == 0) == (lanes != "vector"), (lanes, shares)


def test_a_device_that_is_no_processor_has_lanes_of_its_own():
    found = {name: DeviceInfo(name, "", "", "", 1, True, "device", (), resident=of) for name, of in GPUS.items()}
    chosen = [lanes_on("cl" if name.startswith("opencl") else "glsl", info) for name, info in found.items()]
    assert chosen == ["warp", "group", "group", "vector", "own"]


def test_a_stage_is_made_of_the_kernel_and_of_its_own_file_and_of_no_other_stages():
    plugin = find_methods().get("tiles")
    given = plugin.method, plugin.folder, plugin.variant({}), surfaces.get("torus"), "float32", "cl"
    for stage in ("isolate", "finish", "packets"):
        program = method_program(*given, stage)
        own = [section.origin for section in program.sections if section.origin.startswith("methods/tiles/")]
        assert own == ["methods/tiles/kernel.glsl", f"methods/tiles/{stage}.glsl"]
