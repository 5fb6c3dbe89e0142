"""Beams hold their rays, the methods that cast them miss nothing, and broken copies of them are caught."""

import dataclasses
import re
from fractions import Fraction

import numpy as np
import pytest

import surfaces
from harness.accuracy import pixels as beams
from harness.accuracy.judge import Verdicts, Wrong, judge
from harness.contract import FirsthitError, Hits, RayStatus, Section, Surface, Truth, TruthStatus, View
from harness.devices.interface import map_rows
from harness.devices.quadtree import beam_hits_from, launch_beams, layout_of
from harness.kernels.assemble import map_program, method_program
from harness.kernels.functions import surface_sections, unsupported
from harness.kernels.sections import KERNELS, file_section
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of, scene_radius

from .conftest import opened, usable_devices
from .test_renders import _case, _view

METHODS = [name for name, plugin in find_methods().plugins.items() if plugin.method.casts in ("beams", "quadtree")]
CASTERS = [*((name, {}) for name in METHODS), ("interval_adaptive", {"DESCENT": 0})]  # as printed
TYPICAL = ("torus", "dingdong_beamcasting", "blinn_blob")
VIEW = View("oblique", azimuth=30, elevation=35)
SIZE = 80  # twice test_renders' rays; no power of two
WIDE = surfaces.from_formula("x + y + z", "box:1e6,1e6,1e6")  # its domain cuts no box off
FIRST = 3  # the quadtree's first level, whatever fills the device


def frame(device, method, surface, camera, size, precision="float32", edit=None, **knobs):
    """Hits and levels of every pixel; `edit` changes the program's text."""
    outputs, _ = outputs_of(device, method, surface, camera, size, precision, edit, **knobs)
    return beam_hits_from(outputs)


def outputs_of(device, method, surface, camera, size, precision="float32", edit=None, **knobs):
    """All outputs of a launch, and its layout."""
    plugin = find_methods().get(method)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant(knobs), surface, precision, device.language, "beams"
    )
    if edit:
        sections = tuple(Section(s.origin, edit(s.text)) for s in program.sections)
        program = dataclasses.replace(program, sections=sections)
    quadtree = plugin.method.casts == "quadtree"
    layout = layout_of(dict(plugin.variant(knobs).parameters))
    launch = launch_beams(device, program, device.build(program), camera, size, quadtree, layout, True, True)
    launch.run()
    outputs = launch.read()
    launch.release()
    return outputs, layout


def deviating(hits, truth, surface, pixels):
    """Rays whose root the beam misses, and rays whose root lies in front of the piece that the beam tells."""
    there = np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))
    picked = beams.along_rays(Hits(*(values[pixels.index] for values in vars(hits).values())), pixels)
    piece = 2.0 * surface.domain.radius / SIZE
    late = (picked.status == RayStatus.HIT) & (picked.t > truth.upper + piece)
    return there & (picked.status != RayStatus.HIT), there & late


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", surfaces.names())
@pytest.mark.parametrize(("method", "knobs"), CASTERS)
def test_no_root_of_any_surface_is_missed(method, knobs, name):
    """On the device whose compiler is the fastest; the typical surfaces are looked at on every one."""
    device = opened(usable_devices()[0].name)
    surface, rays, truth = _case(name)
    camera = camera_for(_view(name), surface)
    hits, _ = frame(device, method, surface, camera, SIZE, **knobs)
    missed, late = deviating(hits, truth, surface, beams.pixels_of(camera, round(len(rays) ** 0.5), SIZE))
    assert not missed.any()
    assert not late.any()
    assert not np.any(hits.status == RayStatus.EXHAUSTED)


@pytest.mark.one_in(2)
@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("name", TYPICAL)
def test_adaptive_and_uniform_answer_alike_and_miss_nothing(device, name, precision):
    surface, rays, truth = _case(name)
    if precision == "float64" and (not device.info.float64 or unsupported(surface, precision, device.language)):
        pytest.skip("the surface has no float64 here")
    camera = camera_for(_view(name), surface)
    uniform, _ = frame(device, "interval_uniform", surface, camera, SIZE, precision)
    adaptive, _ = frame(device, "interval_adaptive", surface, camera, SIZE, precision, FIRST_LEVEL=FIRST)
    missed, late = deviating(adaptive, truth, surface, beams.pixels_of(camera, round(len(rays) ** 0.5), SIZE))
    assert not missed.any()
    assert not late.any()
    # the same tree of depths: only pieces that two beams' rounding tells apart may differ
    assert np.mean(uniform.status != adaptive.status) < 1e-3
    assert np.mean((uniform.t != adaptive.t) & np.isfinite(uniform.t + adaptive.t)) < 1e-3
    assert adaptive.evaluations.sum() < 0.8 * uniform.evaluations.sum()


@pytest.mark.parametrize("precision", ["float32", "float64"])
@pytest.mark.parametrize("name", TYPICAL)
def test_the_printed_descent_misses_nothing_and_costs_more(device, name, precision):
    surface, rays, truth = _case(name)
    if precision == "float64" and (not device.info.float64 or unsupported(surface, precision, device.language)):
        pytest.skip("the surface has no float64 here")
    camera = camera_for(_view(name), surface)
    ours, _ = frame(device, "interval_adaptive", surface, camera, SIZE, precision, FIRST_LEVEL=FIRST)
    printed, _ = frame(device, "interval_adaptive", surface, camera, SIZE, precision, FIRST_LEVEL=FIRST, DESCENT=0)
    missed, late = deviating(printed, truth, surface, beams.pixels_of(camera, round(len(rays) ** 0.5), SIZE))
    assert not missed.any()
    assert not late.any()
    assert not np.any(printed.status == RayStatus.EXHAUSTED)
    assert printed.evaluations.sum() > 1.2 * ours.evaluations.sum()


@pytest.mark.parametrize(("descent", "expected"), [(0, 16 * 4 + 64 * 5 + 256 * 6), (1, 16 * 4 + 64 * 2 + 256 * 2)])
def test_the_printed_descent_halves_the_whole_depth_again_at_each_level(device, descent, expected):
    """Nothing can be excluded, so that every search goes straight to the nearest piece. At level L it is the whole
    depth / 2^(L + 1): L + 2 evaluations, or, from the parent's piece on, that piece and its first half."""
    camera = camera_for(View("inside", distance=1.5), surfaces.get("sphere"))
    knobs = {
        "FIRST_LEVEL": 2,
        "DESCENT": descent,
        "edit": lambda text: text.replace("= range.lo > 0.0 || range.hi < 0.0", "= false"),
    }
    hits, levels = frame(device, "interval_adaptive", WIDE, camera, 16, **knobs)
    assert (hits.status == RayStatus.HIT).all()
    assert (levels == 4).all()
    assert hits.evaluations.sum() == expected


@pytest.mark.parametrize("descent", [0, 1])
def test_a_quadtree_that_starts_at_the_pixels_is_the_uniform_method(device, descent):
    surface = surfaces.get("torus")
    camera = camera_for(VIEW, surface)
    uniform, _ = frame(device, "interval_uniform", surface, camera, 50)
    adaptive, levels = frame(device, "interval_adaptive", surface, camera, 50, FIRST_LEVEL=6, DESCENT=descent)
    assert np.array_equal(uniform.t, adaptive.t, equal_nan=True)
    assert np.array_equal(uniform.evaluations, adaptive.evaluations)
    assert (levels == 6).all()


def test_a_shared_beams_evaluations_are_counted_once(device):
    """Nothing is there, so that each cell of the first level is discarded after one evaluation."""
    surface = Surface("nothing", "Nothing", "1 + x^2", surfaces.get("torus").domain, "test", 2)
    view = View("inside", fov=20.0, distance=1.5)
    for size, first in ((64, 3), (50, 2), (1, 0)):
        hits, levels = frame(device, "interval_adaptive", surface, camera_for(view, surface), size, FIRST_LEVEL=first)
        across = -(-size // 2 ** ((size - 1).bit_length() - first))  # cells of the level that are in the image
        assert hits.evaluations.sum() == across**2
        assert np.ptp(hits.evaluations) <= 1
        assert (levels == first).all()


@pytest.mark.one_in(2)
@pytest.mark.parametrize("knobs", [{}, {"GROUPED": 0}, {"REMAP": 3}, {"REMAP": 3, "GROUPED": 0}])
@pytest.mark.parametrize("descent", [0, 1])
def test_where_a_work_item_lies_changes_no_bit(device, knobs, descent):
    surface = surfaces.get("barth_sextic")
    camera, fixed = camera_for(VIEW, surface), {"FIRST_LEVEL": FIRST, "DESCENT": descent}
    for size in (96, 50):
        one, two = (frame(device, "interval_adaptive", surface, camera, size, **fixed, **k)[0] for k in ({}, knobs))
        assert np.array_equal(one.t, two.t, equal_nan=True)
        assert np.array_equal(one.evaluations, two.evaluations)


@pytest.mark.parametrize("method", METHODS)
def test_more_bisections_and_more_pixels_give_smaller_errors(device, method):
    surface, rays, truth = _case("sphere")
    camera, side = camera_for(_view("sphere"), surface), round(len(rays) ** 0.5)

    def typical(size, **knobs):
        pixels = beams.pixels_of(camera, side, size)
        hits, _ = frame(device, method, surface, camera, size, **knobs)
        picked = beams.along_rays(Hits(*(values[pixels.index] for values in vars(hits).values())), pixels)
        error = judge(picked, truth, scene_radius(surface), 1e-3).error
        return np.nanmedian(error)

    assert typical(SIZE, BISECTIONS=0) > 1.1 * typical(SIZE, BISECTIONS=2)
    assert typical(SIZE) > 1.5 * typical(2 * SIZE) > 2.25 * typical(4 * SIZE)


BOX = Section(
    "tests: beam_box over rows",
    """#define INPUTS 19
#define OUTPUTS 6
void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {
    Camera camera = make_camera(vec3(x[0], x[1], x[2]), vec3(x[3], x[4], x[5]), vec3(x[6], x[7], x[8]),
                                vec3(x[9], x[10], x[11]));
    Beam beam = camera_beam(camera, int(x[12]), int(x[13]), int(x[14]), int(x[15]), int(x[16]));
    Box box = beam_box(beam, x[17], x[18]);
    y[0] = box.x.lo;
    y[1] = box.y.lo;
    y[2] = box.z.lo;
    y[3] = box.x.hi;
    y[4] = box.y.hi;
    y[5] = box.z.hi;
}
""",
)


def escaping(device, precision, rng, edit=lambda text: text, count=4000):
    """How many of `count` boxes lack a point that they must hold: of a corner ray, or of a float32 ray in the pixel."""
    rows, points = [], []
    for i in range(count):
        view = View("v", rng.uniform(0, 360), rng.uniform(-90, 90), rng.uniform(1, 120), 10.0 ** rng.uniform(-1, 3))
        camera = camera_for(view, surfaces.get("sphere"))
        size = int(rng.integers(1, 2000))
        pixel = rng.integers(0, size, 2)
        side = int(rng.integers(1, size - max(pixel) + 1))
        distance = float(view.distance)
        s = np.sort(np.float32(distance + rng.uniform(-1, 1, 2) * min(1.0, distance)))
        rows.append([*camera, pixel[0], pixel[1], pixel[0] + side, pixel[1] + side, size, *s])
        eye, forward, right, up = (np.array([Fraction(float(c)) for c in part]) for part in camera.reshape(4, 3))
        depth = Fraction(float(s[i % 2]))
        if i % 3:
            x, y = (Fraction(int(2 * (pixel[k] + side * rng.integers(0, 2)) - size), size) for k in (0, 1))
            direction = forward + x * right - y * up
        else:  # the float32 ray through a pixel of the beam, scaled to the depth that its exact direction has
            at = rays_of(camera, size)[(pixel[1] + side - 1) * size + pixel[0]] if size < 300 else None
            x, y = (Fraction(int(2 * p + 1 - size), size) for p in (pixel[0], pixel[1] + side - 1))
            direction = forward + x * right - y * up
            if at is not None:
                length = Fraction(float(sum(float(c) ** 2 for c in direction) ** 0.5))
                direction = length * np.array([Fraction(float(c)) for c in at[3:]])
        points.append(eye + depth * direction)
    sections = [*surface_sections(WIDE, ("surface_range",), precision, device.language)]
    sections += [file_section(KERNELS / "beams/beam.glsl"), BOX]
    sections = [Section(s.origin, edit(s.text)) for s in sections]
    program = map_program(sections, precision, device.language, ("interval",))
    boxes = map_rows(device, program, np.array(rows, np.float64), 6).astype(np.float64)
    return sum(
        not all(Fraction(lo) <= c <= Fraction(hi) for lo, hi, c in zip(box[:3], box[3:], point, strict=True))
        for box, point in zip(boxes, points, strict=True)
    )


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_a_piece_of_a_beam_lies_in_its_box(device, precision, rng):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    assert escaping(device, precision, rng) == 0


def test_a_beam_that_lacks_its_corners_or_its_slack_is_caught(device, rng):
    def narrow(text):
        return text.replace("real(i1) * step", "(real(i0 + i1) * 0.5) * step")

    def without_rounding(text):
        exact = re.sub(r"#define BEAM_SLACK \S+", "#define BEAM_SLACK 0.0", text)
        return exact.replace("8.0 * UNIT_ROUNDOFF", "0.0 * UNIT_ROUNDOFF")

    assert escaping(device, "float32", rng, narrow, 300) > 30
    assert escaping(device, "float32", rng, without_rounding, 300) > 30


def test_what_only_a_beam_can_see_is_set_apart():
    nan, inf = np.nan, np.inf
    status, lower = np.uint8([0, 0, 1, 1, 0]), np.array([nan, nan, 2.0, 2.0, nan])
    margin = np.array([0.005, 0.5, 0.005, 0.5, inf])
    truth = Truth(lower, lower, status, np.full(5, inf), np.ones(5), margin, np.full(5, inf))
    hits = Hits(np.full(5, 1.0), np.ones(5, np.uint8), np.ones(5, np.int32))
    pixels = beams.Pixels(np.arange(5, dtype=np.int32), np.ones(5), np.full(5, 0.01))
    verdicts, beam_only = beams.set_apart(judge(hits, truth, 1.0, 0.0), hits, truth, pixels)
    assert beam_only.tolist() == [True, False, True, False, False]
    expected = [Wrong.RIGHT, Wrong.FALSE_HIT, Wrong.RIGHT, Wrong.WRONG_ROOT, Wrong.FALSE_HIT]
    assert verdicts.wrong.tolist() == expected
    assert isinstance(verdicts, Verdicts)


@pytest.mark.parametrize("size", [1, 7, 40, 64, 80, 500])
def test_every_accuracy_ray_is_in_its_pixels_closed_beam(size):
    camera = camera_for(VIEW, surfaces.get("sphere"))
    pixels = beams.pixels_of(camera, 40, size)
    place = (2 * np.arange(40) + 1) / 80 * size  # in pixels
    row, column = np.divmod(pixels.index.reshape(40, 40), size)
    assert np.all((column <= place[None, :]) & (place[None, :] <= column + 1))
    assert np.all((row <= place[:, None]) & (place[:, None] <= row + 1))
    forward = camera[3:6].astype(np.float64)
    straight, middle = (rays_of(camera, n)[:, 3:].astype(np.float64) @ forward for n in (40, size))
    assert np.allclose(pixels.per_middle, middle[pixels.index] / straight, rtol=1e-6)
    assert np.all(pixels.reach >= 0.49 * np.linalg.norm(camera[6:9]) * 2 / size * straight)
    assert np.all(pixels.reach <= 1.5 * np.linalg.norm(camera[6:9]) * 2 / size)


def test_a_launch_of_more_groups_than_the_device_runs_at_once_is_refused_not_dropped(device):
    """OpenGL ignores such a launch and leaves the buffers as they were."""
    if device.language != "glsl":
        pytest.skip("OpenCL has no such limit")
    section = Section(
        "ones",
        "#define INPUTS 1\n#define OUTPUTS 1\nvoid map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) { y[0] = 1.0; }",
    )
    built = device.build(map_program(section, "float32", "glsl"))
    most = device.most_groups
    if 64 * most >= 2**31:
        pytest.skip("the device runs as many as an index can count")
    with pytest.raises(FirsthitError, match="work groups"):
        device.launch(built, [np.ones(1, np.float32)], [(1, np.float32)], (64 * (most + 1), 1))


def test_more_pixels_than_a_launch_has_work_items_are_all_cast(device):
    surface = surfaces.get("sphere")
    hits, levels = frame(device, "interval_uniform", surface, camera_for(VIEW, surface), 1500, BISECTIONS=0)
    assert (levels == 11).all()
    assert abs(np.mean(hits.status == RayStatus.HIT) - np.pi / 4) < 0.02
