"""What bernstein promises, on random rays over the catalog held against the oracle. FIRSTHIT_RAYS sets how many.

The promise: where the nearest other answer is MARGIN domain radii away, and the first root's condition times roundoff
is under CONDITION, no crossing is missed, no later root taken, nothing hit that is not there, and the error is below
the tolerance and what rounding must add. Rays start outside the domain and in it, by turns.
"""

from __future__ import annotations

import os

import numpy as np
import pytest

import surfaces
from harness import conformance
from harness.accuracy.judge import judge
from harness.contract import UNIT_ROUNDOFF, RayStatus, TruthStatus
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import scene_radius

from .conftest import opened, usable_devices
from .test_devices import cast

RAYS = int(os.environ.get("FIRSTHIT_RAYS", "14000"))
METHOD = find_methods().get("bernstein").method
NAMES = [name for name in surfaces.names() if METHOD.accepts(surfaces.get(name)) is None]
PLACES = [(info.name, precision) for precision in ("float32", "float64") for info in usable_devices()]
MARGIN = 2.0**-11  # of the domain's radius
CONDITION = 2.0**-8  # of the first root's condition × unit roundoff
TOLERANCE = 2.0 * {p.name: p.default for p in METHOD.parameters}["TOLERANCE"]  # of the radius: a ray is two radii long


def drawn(surface, count, rng):
    """Rays float32[count, 6] from a sphere of four radii, or from inside the domain, towards points of the domain."""
    radius, center = surface.domain.radius, np.array(surface.domain.center)

    def ball():
        points = rng.normal(size=(count, 3))
        return points * (rng.uniform(0, 1, (count, 1)) ** (1 / 3) / np.linalg.norm(points, axis=1)[:, None])

    origins = ball()
    origins[::2] *= 4.0 / np.linalg.norm(origins[::2], axis=1)[:, None]
    directions = ball() - origins
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    return np.hstack([origins * radius + center, directions]).astype(np.float32)


def hold_promise(hits, case, precision):
    """Fails where an answer is outside the promise; the share of rays that it is about."""
    truth, radius = case.truth, case.surface.domain.radius
    verdicts = judge(hits, truth, scene_radius(case.surface), 0.0)
    promised = ~(truth.margin < MARGIN * radius) & ~(truth.condition * UNIT_ROUNDOFF[precision] > CONDITION)
    wrong = np.flatnonzero(promised & (verdicts.wrong > 0))
    assert not len(wrong), f"{len(wrong)} of {promised.sum()}: ray {case.rays[wrong[0]].tolist()}"
    measured = promised & np.isfinite(verdicts.error)
    allowed = radius * TOLERANCE + conformance.rounding_adds(case, precision)
    assert (verdicts.error <= allowed)[measured].all()
    return promised.mean()


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("name", "device_name", "precision"),
    [(name, *PLACES[i % len(PLACES)]) for i, name in enumerate(NAMES)] if PLACES else [],
)
def test_no_answer_is_outside_the_promise(name, device_name, precision):
    surface = surfaces.get(name)
    rays = drawn(surface, RAYS // len(NAMES), np.random.default_rng(len(surface.formula)))
    case = conformance.Case(surface, rays, first_hits(surface, rays))
    promised = hold_promise(cast(opened(device_name), "bernstein", surface, precision, rays), case, precision)
    assert promised > 0.3 or name.startswith(("thin_torus", "two_spheres", "plane_squared"))


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_a_touch_is_a_miss_or_a_hit_at_the_touch(device, precision):
    """f does not change its sign there, so that only its roundings can make it a hit."""
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    for case in conformance.touch_cases():
        hits = cast(device, "bernstein", case.surface, precision, case.rays)
        alone = ~np.isfinite(case.truth.following)
        near = np.abs(hits.t - case.truth.lower) < 1e-3 * case.radius
        assert (case.truth.status == TruthStatus.TOUCH).all()
        assert ((hits.status == RayStatus.MISS) | near)[alone].all()
        assert not (hits.status == RayStatus.EXHAUSTED).any()
