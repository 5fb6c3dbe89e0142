"""The bound of f's rounding errors at points of rays, and the contrast that the oracle makes of it."""

from __future__ import annotations

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import judge
from harness.contract import Hits, TruthStatus
from harness.oracle import first_hits
from harness.oracle.noise import Noise, RunningErrors
from surfaces.evaluation import Floats
from surfaces.lowering import coefficients_along, real_tape
from surfaces.tape import walk

from .gallery import anywhere, held, surface_named

NAMES = (*surfaces.names(), *held())
UNIT = 2.0**-24
X = np.array([[-3.0, 0.0, 0.0, 1.0, 0.0, 0.0]], np.float32)


class Single(Floats):
    """float32 arithmetic, each operation rounded."""

    def const(self, value):
        return np.float32(value.numerator / value.denominator)

    def pi(self):
        return np.float32(np.pi)

    def e(self):
        return np.float32(np.e)


def near_rays(surface, count, rng):
    """Rays float32 with their origins moved near the domain's centre, and a t float32 of each in the domain."""
    rays = anywhere(surface, count, rng).astype(np.float64)
    origin, direction = rays[:, :3], rays[:, 3:]
    shift = ((np.array(surface.domain.center) - origin) * direction).sum(axis=1)
    moved = np.hstack([origin + shift[:, None] * direction, direction])
    return moved, rng.uniform(-0.6, 0.6, count) * surface.domain.radius


@pytest.mark.parametrize("name", NAMES)
def test_float32_is_never_off_by_more_than_the_bound(name, rng):
    """Points are formed as kernels form them; values are of the tape, and to degree 4 of Horner's rule too."""
    surface = surface_named(name)
    rays, t = near_rays(surface, 3_000, rng)
    single, ts = rays.astype(np.float32), t.astype(np.float32)
    # t is exact as kernels have it: the point that it stands for is where f is to be known
    exact = surfaces.evaluate(surface, rays[:, :3] + ts.astype(np.float64)[:, None] * rays[:, 3:])
    bound = Noise(surface).along(rays).bound(slice(None), ts.astype(np.float64)) * UNIT
    tape = real_tape(surfaces.tape_of(surface))
    points = {axis: single[:, k] + ts * single[:, 3 + k] for k, axis in enumerate("xyz")}
    found = [walk(tape, Single(), points)[0]]
    if surface.degree is not None and 1 <= surface.degree <= 4:
        inputs = {f"{part}{axis}": single[:, 3 * j + k] for j, part in enumerate("od") for k, axis in enumerate("xyz")}
        *lower, value = walk(coefficients_along(tape, surface.degree), Single(), inputs)
        for coefficient in reversed(lower):
            value = value * ts + coefficient
        found.append(value)
    for values in found:
        off = np.abs(np.broadcast_to(values, len(t)).astype(np.float64) - exact)
        assert np.isfinite(bound).all()
        assert (off <= bound * (1.0 + 1e-6) + 1e-12 * bound.max()).all()
        assert (off > 0.003 * bound).any() or not off.any(), "a bound that nothing comes near says nothing"


def test_an_error_is_what_an_operation_makes_of_its_operands_and_its_own():
    errors = RunningErrors()
    a, b = (3.0, 1.0), (-4.0, 2.0)
    assert errors.add(a, b) == (-1.0, 1.0 + 2.0 + 1.0)
    assert errors.sub(a, b) == (7.0, 1.0 + 2.0 + 7.0)
    assert errors.mul(a, b) == (-12.0, 1.0 * 4.0 + 2.0 * 3.0 + 12.0)
    assert errors.sqr(a) == (9.0, 3.0 + 3.0 + 9.0)
    assert errors.powi(a, 3)[0] == 27.0
    assert errors.powi(a, 5)[0] == 243.0
    assert errors.min(a, b) == (-4.0, 2.0)
    with np.errstate(all="ignore"):
        at_zero = errors.sqrt((0.0, 0.0))
    value, error = errors.sqrt((4.0, 0.0))
    assert value == 2.0
    assert error > 2.0
    assert at_zero[1] == 0.0


# (x + 1)^2 - 2 x - 1 is x^2, with terms of size 1 about x = 0: floats lose what is smaller than their roundings
FLAT = "(x + 1)^2 - 2*x - 1 + {}"


@pytest.mark.parametrize(
    ("rest", "drowned32", "drowned64"), [("1e-3", False, False), ("1e-8", True, False), ("1e-18", True, True)]
)
def test_a_near_touch_drowns_where_rounding_is_larger_than_it(rest, drowned32, drowned64):
    truth = first_hits(surfaces.from_formula(FLAT.format(rest), "sphere:1"), X)
    assert truth.status[0] == TruthStatus.MISS
    assert (truth.contrast[0] < 2.0**-23, truth.contrast[0] < 2.0**-52) == (drowned32, drowned64)
    hits = Hits(np.array([np.nan]), np.zeros(1, np.uint8), np.ones(1, np.int32))
    for precision, drowned in (("float32", drowned32), ("float64", drowned64)):
        assert judge(hits, truth, 1.0, 0.0, precision).drowned.tolist() == [drowned]
    assert not judge(hits, truth, 1.0, 0.0).drowned.any(), "without a precision there is no such class"


def test_a_near_touch_without_large_terms_is_as_clear_as_any():
    """x^2 + 1e-8 itself is never in doubt: at x = 0 all its terms are as small as it is."""
    truth = first_hits(surfaces.from_formula("x^2 + 1e-8", "sphere:1"), X)
    assert truth.contrast[0] > 0.1


def test_the_first_root_itself_drowns_nothing():
    for formula in ("x", "x^3 - x/4", "x^2 + y^2 + z^2 - 1/4", "(x + 1)^2 - 2*x - 1 - 1/100"):
        truth = first_hits(surfaces.from_formula(formula, "sphere:1"), X)
        assert truth.status[0] == TruthStatus.CROSSING
        assert truth.contrast[0] > 1e-3, formula


def test_a_dip_that_stays_within_rounding_drowns_its_hit():
    """Two roots, 2e-5 apart, between which f is 1e-10 where its terms are 1."""
    truth = first_hits(surfaces.from_formula(FLAT.format("(-1e-10)"), "sphere:1"), X)
    assert truth.status[0] == TruthStatus.CROSSING
    assert 2.0**-50 < truth.contrast[0] < 2.0**-24


def test_a_touch_has_no_contrast_and_a_ray_beside_the_domain_any():
    plane = surfaces.from_formula("(x + 2*y + 2*z)^2", "sphere:1")
    beside = np.array([[-3, 5, 0, 1, 0, 0]], np.float32)
    truth = first_hits(plane, np.concatenate((X, beside)))
    assert truth.contrast.tolist() == [0.0, np.inf]
