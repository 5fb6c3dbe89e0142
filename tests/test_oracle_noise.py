"""The bound of f's rounding errors for floors, angles, selections and general powers, against float32 itself."""

from __future__ import annotations

import numpy as np
import pytest

import surfaces
from harness.oracle.noise import Noise, RunningErrors
from surfaces.lowering import real_tape
from surfaces.tape import walk
from tests.test_noise import UNIT, Single, near_rays


@pytest.mark.parametrize(
    "formula",
    [
        "floor(7*x) + y - 1/3",
        "mod(5*x + y/3, 2/7) - z",
        "atan2(y/3, x - 1/7) + z",
        "cos(7*atan2(x + y/3, z))",
        "if(x/3 > y*z, x*y - 2, 5*z/7)",
        "if(x/3 > y, x/3 - y, y - x/3)",
        "abs(x/3 - y)^(1/3) + z",
        "(x^2 + y^2/3)^(7/5) - z",
        "sign(x/3 - y*z)*floor(z/7 + 3*y)",
    ],
)
def test_float32_is_never_off_by_more_than_the_bound(formula: str, rng: np.random.Generator) -> None:
    """Jumps that float32 takes on the wrong side are within the bound too."""
    surface = surfaces.from_formula(formula, "sphere:2")
    rays, t = near_rays(surface, 4_000, rng)
    single, ts = rays.astype(np.float32), t.astype(np.float32)
    exact = surfaces.evaluate(surface, rays[:, :3] + ts.astype(np.float64)[:, None] * rays[:, 3:])
    bound = Noise(surface).along(rays).bound(slice(None), ts.astype(np.float64)) * UNIT
    points = {axis: single[:, k] + ts * single[:, 3 + k] for k, axis in enumerate("xyz")}
    found = walk(real_tape(surfaces.tape_of(surface)), Single(), points)[0]
    off = np.abs(np.broadcast_to(found, len(t)).astype(np.float64) - exact)
    assert not np.isnan(bound).any()
    assert (off <= bound * (1.0 + 1e-5) + 1e-12).all()
    assert (bound < 1.0).mean() > 0.9, "a bound that is large everywhere says nothing"


def test_a_jump_is_charged_by_its_height_and_its_distance() -> None:
    errors = RunningErrors()
    assert errors.floor((2.75, 1.0)) == (2.0, 4.0)
    assert errors.floor((2.75, 0.0)) == (2.0, 0.0)
    with np.errstate(all="ignore"):
        assert errors.floor((3.0, 1.0)) == (3.0, np.inf)
    condition = errors.below((1.0, 1.0), (3.0, 3.0))
    assert condition == (1.0, 2.0)
    assert errors.select(condition, (5.0, 1.0), (1.0, 7.0)) == (5.0, 1.0 + 2.0 * 4.0)
    assert errors.select(condition, (5.0, 1.0), (5.0, 7.0)) == (5.0, 1.0)  # the parts meet: a kink
    value, error = errors.atan2((1.0, 0.0), (0.0, 0.0))
    assert value == np.pi / 2 and np.isfinite(error)
