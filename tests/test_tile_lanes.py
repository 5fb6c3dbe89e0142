"""A frame of tiles answers the same whoever has a tile's sixteen lanes."""

import numpy as np
import pytest

import surfaces
from harness.contract import RayStatus, View
from harness.devices.interface import hits_from, launch_camera
from harness.devices.tiles import tile_hits_from
from harness.experiment.kinds.tiles import frame_of
from harness.kernels.assemble import method_program
from harness.plugins import find_methods
from harness.scenes.camera import camera_for

SIZE = 404  # the tiles of both levels reach out of it
TORUS = surfaces.get("torus")
CAMERA = camera_for(View("seen", azimuth=30, elevation=35), TORUS)
FORMS = {"cl": ["vector"], "glsl": ["group", "own"]}  # those that a processor's compiler gets right in a few seconds


def outputs_of(launch):
    launch.run()
    outputs = [values.copy() for values in launch.read()]
    launch.release()
    return outputs


def stated(name, device, precision):
    plugin = find_methods().get(name)
    return plugin.method, plugin.folder, plugin.variant({}), TORUS, precision, device.language


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_every_form_of_the_lanes_answers_as_each_ray_alone(device, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("no float64 here")
    alone = method_program(*stated("bernstein", device, precision), "camera")
    expected = hits_from(outputs_of(launch_camera(device, alone, device.build(alone), CAMERA, SIZE)))
    hit = expected.status == RayStatus.HIT
    for lanes in FORMS[device.language]:
        tiled = stated("tiles", device, precision)
        programs = [method_program(*tiled, stage, lanes=lanes) for stage in ("isolate", "finish", "packets", "rest")]
        built = [device.build(program) for program in programs]
        hits, stages = tile_hits_from(outputs_of(frame_of(tuple(programs), TORUS, CAMERA, SIZE).launch(device, built)))
        assert np.array_equal(hits.status, expected.status), lanes
        assert np.abs(hits.t - expected.t)[hit].max() < 1e-5 * TORUS.domain.radius, lanes
        shares = np.bincount(stages, minlength=6) / SIZE**2
        assert 0.3 < shares[:2].sum() < 0.6, (lanes, shares)  # empty
        assert 0.3 < shares[2:4].sum() < 0.6, (lanes, shares)  # single
        assert shares[4:].sum() < 0.2, (lanes, shares)
        assert (shares[4] == 0) == (lanes == "own"), (lanes, shares)
