"""The method of our own: its error bounds hold, its answers are right, and it says what it refuses."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import judge
from harness.contract import Box, Section
from harness.devices.interface import map_rows
from harness.kernels.assemble import map_program
from harness.kernels.functions import surface_sections
from harness.kernels.rounding import sample_errors_grow, value_errors
from harness.plugins import find_methods
from harness.scenes.camera import scene_radius

from .test_devices import cast
from .test_renders import _case

VALUE = Section(
    "tests: surface_value over rows",
    """#define INPUTS 3
#define OUTPUTS 1
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) { y[0] = surface_value(vec3(x[0], x[1], x[2])); }
""",
)


@pytest.mark.parametrize("name", ["barth_sextic", "endrass_octic", "barth_decic", "sixteen_ball", "chmutov"])
def test_values_are_off_by_no_more_than_their_bound(device, name, rng):
    surface = surfaces.get(name)
    bounds = np.array(value_errors(surface, 16, 0.0))
    points = rng.normal(size=(20000, 3))
    points *= surface.domain.radius * rng.uniform(0, 1, (20000, 1)) / np.linalg.norm(points, axis=1)[:, None]
    if isinstance(surface.domain, Box):
        half = np.subtract(surface.domain.upper, surface.domain.lower) / 2
        points = points[(np.abs(points) < half).all(axis=1)]
    points = (points + surface.domain.center).astype(np.float32)
    sections = surface_sections(surface, ("surface_value",), "float32", device.language)
    program = map_program([*sections, VALUE], "float32", device.language)
    found = map_rows(device, program, points, 1)[:, 0].astype(np.float64)
    exact = surfaces.evaluate(surface, points.astype(np.float64))
    away = np.linalg.norm(points - surface.domain.center, axis=1) / surface.domain.radius
    allowed = 2.0**-24 * bounds[np.clip(np.ceil(away * 16).astype(int) - 1, 0, 15)]
    assert (np.abs(found - exact) <= allowed).all()
    assert (np.abs(found - exact) > 2e-3 * allowed).any()  # and the bound is no empty one


def test_errors_of_samples_grow_less_in_smaller_pieces():
    grown = sample_errors_grow(10, "float32", 6)
    assert 733 < grown[0] < 1000  # the inverse's norm, see papers/README
    assert all(after <= before for before, after in pairwise(grown))
    assert grown[-1] < 5.0


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("name", ["endrass_octic", "barth_decic", "sixteen_ball"])
def test_high_degrees_have_no_wrong_answer(device, name, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    surface, rays, truth = _case(name)
    verdicts = judge(cast(device, "bernstein", surface, precision, rays), truth, scene_radius(surface), 1e-3)
    assert not verdicts.wrong[~verdicts.grazing].any()


def test_refusals_say_why():
    accepts = find_methods().get("bernstein").method.accepts
    assert "not algebraic" in accepts(surfaces.get("blinn_blob"))
    assert "degree 21" in accepts(surfaces.from_formula("x^21 - y", "sphere:1", "mine"))
    assert accepts(surfaces.get("torus")) is None


@pytest.mark.parametrize("name", ["klein", "barth_decic"])
def test_a_mean_of_f_about_the_root_errs_less_than_one_value(device, name):
    surface, rays, truth = _case(name)
    medians = []
    for pairs in (0, 8):
        hits = cast(device, "bernstein", surface, "float32", rays, PAIRS=pairs)
        error = judge(hits, truth, scene_radius(surface), 1e-3).error
        medians.append(np.nanmedian(error))
    assert 0.0 < medians[1] < 0.8 * medians[0]
