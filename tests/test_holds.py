"""The defaults of our methods tell close roots apart, cost no more for it, and read no bound outside its table."""

from __future__ import annotations

import numpy as np
import pytest

from harness import hardcases
from harness.accuracy.rungs import judge_rung, share_right
from harness.contract import RayStatus
from harness.devices.interface import hits_from, launch_rays
from harness.kernels.assemble import method_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from reports.analysis.breaks import HELD

from .test_devices import cast

# rungs that broke the methods while their steps ended by their length alone
HARD = [
    ("bernstein", "float32", "spindle_torus", 1e-6),
    ("bernstein", "float32", "double_line", 1e-6),
    ("bernstein", "float64", "clustered_roots", 1e-7),
    ("bernstein", "float64", "cusp", 1e-6),
    ("lu_lipschitz", "float32", "spindle_torus", 1e-6),
    ("lu_lipschitz", "float32", "double_line", 1e-6),
    ("lu_lipschitz", "float64", "clustered_roots", 1e-7),
    ("lu_lipschitz", "float64", "spindle_torus", 1e-6),
]


def rung_of(family, parameter):
    (found,) = (rung for rung in hardcases.rungs(family) if rung.parameter == parameter)
    return found


@pytest.mark.parametrize(("method", "precision", "family", "parameter"), HARD)
def test_a_default_tells_roots_apart_that_lie_close_together(device, method, precision, family, parameter):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    rung = rung_of(family, parameter)
    truth = first_hits(rung.surface, rung.rays)
    verdict = judge_rung(rung, cast(device, method, rung.surface, precision, rung.rays), truth, precision)
    assert verdict["decided"] > 10
    assert share_right(verdict) >= HELD


@pytest.mark.parametrize("method", ["bernstein", "lu_lipschitz"])
def test_the_finest_tolerance_is_what_the_precision_can_step(device, method):
    """A tolerance below a unit roundoff would let steps stand still, or follow the rounding errors of f."""
    rung = rung_of("huge_coefficients", 1.0)
    default = cast(device, method, rung.surface, "float32", rung.rays)
    finer = cast(device, method, rung.surface, "float32", rung.rays, TOLERANCE=0.0)
    assert (default.status == finer.status).all() and not (finer.status == RayStatus.EXHAUSTED).any()
    assert np.array_equal(default.evaluations, finer.evaluations)
    assert default.evaluations.max() < 20


def test_a_ray_from_the_eye_through_the_domains_centre_stays_in_the_table_of_bounds(device):
    """Its squared distance from the centre comes out below 0; the square root is then no number, and no index."""
    rung = rung_of("horn_torus", 1e-5)
    plugin = find_methods().get("bernstein")
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), rung.surface, "float32", device.language, "rays", origin="eye"
    )
    launch = launch_rays(device, program, device.build(program), rung.rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    verdict = judge_rung(rung, hits, first_hits(rung.surface, rung.rays), "float32")
    assert share_right(verdict) >= HELD
