"""Tiles answer the share of pixels that they should at each stage, and breaking the kernel's text shows.

A path that is lost in the halving may leave a tile open: its pixels are cast one by one, and all answers are right.
Only the shares of pixels by stage tell of it. Other breaks give wrong answers.
"""

import dataclasses
from functools import cache

import numpy as np
import pytest

import surfaces
from harness.contract import RayStatus, View
from harness.scenes.camera import camera_for, rays_of

from .benchmarks.tile_errors import compared
from .benchmarks.tile_rays import Caster, suspects
from .conftest import opened, usable_devices

SIZE = 64  # pixels a side of a window, in the middle of an image of PIXELS
PIXELS = 512
DIFFER = 2.0**-18  # domain radii
ISOLATE, FINISH = 0, 1  # stages
OPENCL = [info.name for info in usable_devices() if info.name.startswith("opencl")][:1]
pytestmark = pytest.mark.skipif(not OPENCL, reason="no device for OpenCL")


SEEN = View("v", azimuth=30, elevation=35)


def window(surface, aside, pixels=PIXELS, view=SEEN, above=0.0):
    """The camera of a window, `aside` and `above` of the image's half width to the right of its middle and up."""
    eye, forward, right, up = camera_for(view, surface).astype(float).reshape(4, 3)
    part = SIZE / pixels
    return np.concatenate([eye, forward + aside * right + above * up, part * right, part * up]).astype(np.float32)


@cache
def caster(surface):
    return Caster(opened(OPENCL[0]), surface)


def cast(surface, camera, *edit, stage=ISOLATE):
    """A window's shares by stage, and the share of its answers that differ from bernstein's in float64.

    `edit` is a line of the kernel, and what stands in its place in a stage.
    """
    answer, exact = answers(surface, camera, *edit, stage=stage)
    return answer.shares, float(suspects(answer.hits, exact, DIFFER * surface.domain.radius).mean())


def answers(surface, camera, *edit, stage=ISOLATE):
    """The answers to a window, as cast says, and those of bernstein in float64."""
    right, rays = caster(surface), rays_of(camera, SIZE)
    programs, built, mine = list(right.programs), list(right.built), dataclasses.replace
    if edit:
        assert sum(section.text.count(edit[0]) for section in programs[stage].sections) == 1
        sections = tuple(mine(section, text=section.text.replace(*edit)) for section in programs[stage].sections)
        programs[stage] = mine(programs[stage], sections=sections)
        built[stage] = right.device.build(programs[stage])
    broken = object.__new__(Caster)
    broken.device, broken.surface = right.device, surface
    broken.programs, broken.built = tuple(programs), built
    return broken.tiles(camera, rays), right.alone("float64", rays)


STEP = "bundle = stack[depth - 1];"  # to the next path
RANGES = {  # of the windows: empty, single, and what no tile decides
    ("torus", 0.75): ((0.0, 0.0), (0.95, 1.0), (0.0, 0.05)),
    ("clebsch", 0.3): ((0.03, 0.13), (0.65, 0.76), (0.16, 0.27)),
    ("barth_sextic", 0.6): ((0.17, 0.27), (0.52, 0.63), (0.15, 0.25)),
}


def within(shares, ranges):
    """Tell whether shares of empty tiles, of single ones and of the rest are in their ranges."""
    empty, single = (sum(shares[f"{verdict}_{side}"] for side in (16, 8)) for verdict in ("empty", "single"))
    found = (empty, single, shares["packets"] + shares["rest"])
    return all(low <= share <= high for share, (low, high) in zip(found, ranges, strict=True))


@pytest.mark.parametrize("where", RANGES)
def test_shares_by_stage_are_in_their_ranges_and_no_answer_differs(where):
    surface = surfaces.get(where[0])
    shares, differ = cast(surface, window(surface, where[1]))
    assert within(shares, RANGES[where]), shares
    assert differ == 0.0


def test_a_path_to_the_wrong_piece_shows_in_answers_or_shares():
    surface = surfaces.get("barth_sextic")
    shares, differ = cast(surface, window(surface, 0.6), STEP, "bundle = stack[0];")
    assert differ > 0.0 or not within(shares, RANGES["barth_sextic", 0.6]), shares


def test_a_verdict_single_with_two_uncertain_coefficients_gives_wrong_roots():
    surface = surfaces.get("clebsch")
    _, differ = cast(surface, window(surface, 0.3), ">= N;", ">= N - 1;")
    assert differ > 0.01


def test_a_slope_that_interpolation_gets_wrong_ends_no_refinement():
    """Along a column of pixels the interpolated inverse slope passes through zero: all steps are short there."""
    surface = surfaces.get("limao")
    camera = window(surface, 0.0, view=View("low", azimuth=100, elevation=8), above=0.875)
    shares, differ = cast(surface, camera)
    assert shares["single_8"] > 0.2 and differ == 0.0


RIM = {"flirt": (0.3, 0.0), "clebsch": (0.6, 0.0), "kummer": (0.3, 0.5)}  # windows on the domain's rim, right and up
BEHIND = "stop = end;\n                    tries = 0;"
MOST_ALONE = {"flirt": 0.01, "clebsch": 0.08, "kummer": 0.01}  # shares of pixels; 0.09 to 0.15 without second pieces


@pytest.mark.parametrize("name", RIM)
def test_rays_that_the_domain_cuts_find_their_root_behind_the_first_piece(name):
    surface = surfaces.get(name)
    shares, differ = cast(surface, window(surface, RIM[name][0], above=RIM[name][1]))
    assert shares["rest"] <= MOST_ALONE[name], shares
    assert differ == 0.0


@pytest.mark.parametrize(("name", "broken"), [("kummer", "end = start;"), ("clebsch", "start = 0.5 * (start + end);")])
def test_a_break_behind_the_first_piece_gives_wrong_answers(name, broken):
    surface = surfaces.get(name)
    _, differ = cast(surface, window(surface, RIM[name][0], above=RIM[name][1]), BEHIND, f"{broken} {BEHIND}")
    assert differ > 0.01


BREAKS = {  # what is broken, the window where it shows and the image's pixels, and there the ranges as in RANGES
    "a path that is lost leaves tiles open": (
        ("barth_sextic", 0.3, PIXELS, STEP, f"{STEP} inner = OPEN;"),
        ((0.12, 0.16), (0.34, 0.40), (0.46, 0.53)),
    ),
    "no bound of the remainder": (
        ("sixteen_ball", 0.3, 1024, "return bound;", "return 0.0 * bound;"),
        ((0.0, 0.0), (0.57, 0.62), (0.38, 0.43)),
    ),
}


@pytest.mark.parametrize("name", BREAKS)
def test_a_break_that_leaves_answers_right_shows_in_the_shares(name):
    (named, aside, pixels, *edit), ranges = BREAKS[name]
    surface = surfaces.get(named)
    camera = window(surface, aside, pixels)
    shares, differ = cast(surface, camera)
    assert differ < 1e-3  # rays that graze the surface, of which the first window has three
    assert within(shares, ranges), shares
    shares, _ = cast(surface, camera, *edit)
    assert not within(shares, ranges), shares


LINE = "        result.good = BOTH(line,"  # whether one step by the mean of f is enough
VALUE = "wide f = value.hi + value.lo;"  # of f in compensated arithmetic


@pytest.mark.parametrize(("name", "aside", "low", "high"), [("heart", 0.2, 0.7, 1.0), ("clebsch", 0.3, 0.4, 0.9)])
def test_pixels_take_one_step_by_the_mean_of_f(name, aside, low, high):
    surface = surfaces.get(name)
    answer, _ = answers(surface, window(surface, aside))
    longer, _ = answers(surface, window(surface, aside), LINE, f"line = NOWHERE; {LINE}", stage=FINISH)
    single = (answer.stages == 2) | (answer.stages == 3)
    assert low <= np.mean(answer.hits.evaluations[single] < longer.hits.evaluations[single]) <= high


def largest_single(surface, camera, *edit):
    """The largest error of pixels of single tiles, in domain radii."""
    answer, exact = answers(surface, camera, *edit, stage=FINISH)
    both = (answer.hits.status == RayStatus.HIT) & (exact.status == RayStatus.HIT)
    error = np.abs(answer.hits.t - exact.t) / surface.domain.radius
    return error[both & ((answer.stages == 2) | (answer.stages == 3))].max()


@pytest.mark.parametrize("edit", [(LINE, f"line = NOT(NOWHERE); {LINE}"), (VALUE, "wide f = value.hi;")])
def test_compensated_values_make_errors_small_where_one_step_is_not_enough(edit):
    surface = surfaces.get("barth_sextic")
    camera = window(surface, 0.3)
    assert largest_single(surface, camera) < 1.5e-7 < 5e-7 < largest_single(surface, camera, *edit)


ROUGH = ("torus", "barth_sextic", "heart", "limao", "endrass_octic")


@pytest.mark.parametrize("name", ROUGH)
def test_errors_of_a_frame_are_no_larger_than_those_of_bernstein(name):
    found = compared(caster(surfaces.get(name)), View("v", azimuth=100, elevation=8), 256)
    assert max(found.ratios) <= 1.0, found


def test_errors_are_small_where_the_eye_is_far_away():
    surface = surfaces.get("torus")
    found = compared(caster(surface), View("far", azimuth=30, elevation=35, distance=1e5, fov=0.002), 64)
    assert found.rays > 500 and found.tiles[1] < 3e-7, found
