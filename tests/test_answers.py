"""What kernels answer is held to what an answer can be, on every device and by every entry."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

import surfaces
from harness.accuracy import answers
from harness.accuracy.scene_truth import hits_of
from harness.contract import (
    Box,
    FirsthitError,
    Hits,
    Method,
    Program,
    RayStatus,
    Sphere,
    Variant,
    View,
    digest,
)
from harness.devices.interface import Launch, Timing, hits_from, launch_camera, launch_rays, same_values
from harness.devices.messages import ListedCheck
from harness.devices.quadtree import Layout, beam_hits_from, launch_beams
from harness.devices.worker import Worker
from harness.experiment.kinds import draws
from harness.kernels.assemble import method_program
from harness.kernels.raster import fill_program
from harness.plugins import Catalog, Plugin, find_methods
from harness.scenes.camera import camera_for, meets, rays_of
from harness.scenes.model import single
from harness.scenes.records import depth_map

from .conftest import opened, usable_devices

VIEW = View("oblique", azimuth=30, elevation=35)
MADE = Method(name="made", source="test")
INVALID = RayStatus.INVALID
WRONG_HITS = {
    "nan": "return hit_at(hit, sqrt(-1.0 * fabs(t1) - 1.0));",
    "infinite": "return hit_at(hit, REAL_INFINITY);",
    "behind the domain": "return hit_at(hit, t1 + 0.01);",
    "before the domain": "return hit_at(hit, t0 - 0.01);",
    "status 3": "hit.status = 3; return hit;",
    "status 5": "hit.status = 5; return hit;",
    "status 4": "hit.status = 4; return hit;",
    "status -1": "hit.status = -1; return hit;",
    "minus a million": "hit.evaluations = -1000000; return hit_at(hit, t0);",
    "2^24": "hit.evaluations = 16777216; return hit_at(hit, t0);",
    "2^30": "hit.evaluations = 1073741824; return hit_at(hit, t0);",
    "2^31 - 1": "hit.evaluations = 2147483647; return hit_at(hit, t0);",
}


def _program(device, folder, body, entry="rays", method=MADE, surface=None):
    text = f"Hit first_hit(Ray ray, real t0, real t1) {{\n    Hit hit = no_hit(t0);\n    {body}\n}}\n"
    folder = folder / digest(device.info.name, body, entry)  # what was read of a path once is kept
    folder.mkdir(exist_ok=True)
    (folder / "kernel.glsl").write_text(text if entry != "beams" else body)
    surface = surface or surfaces.get("sphere")
    return method_program(method, folder, Variant("made"), surface, "float32", device.language, entry)


def _cast(device, folder, body, rays, surface=None):
    program = _program(device, folder, body, surface=surface)
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


@pytest.fixture
def sphere_rays():
    return rays_of(camera_for(VIEW, surfaces.get("sphere")), 16)


def _inside(surface, rays):
    return meets(surface.domain, rays)


@pytest.mark.parametrize("kind", WRONG_HITS)
def test_what_can_be_no_answer_is_invalid(device, tmp_path, sphere_rays, kind):
    sphere = surfaces.get("sphere")
    hits = answers.validated(_cast(device, tmp_path, WRONG_HITS[kind], sphere_rays), sphere.domain, sphere_rays)
    inside = _inside(sphere, sphere_rays)
    assert inside.any()
    assert (hits.status[inside] == INVALID).all()
    assert (hits.status[~inside] == RayStatus.MISS).all()
    assert np.isnan(hits.t).all()
    assert answers.invalid(hits) == inside.sum()


def test_the_ends_of_the_interval_and_of_the_count_are_answers(device, tmp_path, sphere_rays):
    for surface in (surfaces.get("sphere"), surfaces.get("barth_sextic"), surfaces.get("cayley")):
        rays = rays_of(camera_for(VIEW, surface), 64)
        for end in ("t0", "t1"):
            body = f"hit.evaluations = 16777215; return hit_at(hit, {end});"
            hits = _cast(device, tmp_path, body, rays, surface)
            assert answers.invalid(answers.validated(hits, surface.domain, rays)) == 0
            assert hits.evaluations.max() == 2**24 - 1
    hits = _cast(device, tmp_path, "return exhausted(hit, t0);", sphere_rays)
    assert RayStatus.EXHAUSTED in hits.status


def test_a_camera_frame_packs_as_listed_rays_do(device, tmp_path):
    camera = camera_for(VIEW, surfaces.get("sphere"))
    for kind in ("status 5", "minus a million", "2^30"):
        program = _program(device, tmp_path, WRONG_HITS[kind], "camera")
        launch = launch_camera(device, program, device.build(program), camera, 16)
        launch.run()
        hits = hits_from(launch.read())
        launch.release()
        assert INVALID in hits.status
        assert set(hits.status) <= {INVALID, RayStatus.MISS}
        assert hits.evaluations.max() == 0


BEAMS = {
    "status": "hit.status = 5;",
    "negative": "hit.evaluations = -7;",
    "many": "hit.evaluations = 2147483647;",
    "no pixel": "return;",
}
CELL = "void cast_cell(Work work, Cell cell) {{\n    Hit hit = no_hit(1.0);\n    {}\n    {}\n}}\n"
PAINT = "paint(work, cell, hit);"
QUEUE = "if (cell.level == work.last) {{ paint(work, cell, hit); }} else {{ {} queue_quarters(work, cell, 2, hit); }}"


def _beams(device, folder, kernel, casts, size=12):
    method = dataclasses.replace(MADE, casts=casts, needs=("surface_range",))
    program = _program(device, folder, kernel, "beams", method)
    camera = camera_for(VIEW, surfaces.get("sphere"))
    launch = launch_beams(
        device, program, device.build(program), camera, size, casts == "quadtree", Layout(1), blank=True
    )
    launch.run()
    hits, levels = beam_hits_from(launch.read())
    launch.release()
    return hits, levels


@pytest.mark.parametrize("kind", BEAMS)
def test_beams_that_answer_nothing_are_invalid(device, tmp_path, kind):
    hits, _ = _beams(device, tmp_path, CELL.format(BEAMS[kind], PAINT), "beams")
    assert (hits.status == INVALID).all()
    assert (hits.evaluations == 0).all()


@pytest.mark.parametrize("kind", ["negative", "many"])
def test_a_count_that_is_none_is_handed_down_the_quadtree(device, tmp_path, kind):
    """Only the cells of the first level count wrongly, by a number that the quarters' own counts could hide."""
    kernel = CELL.format("", QUEUE.format(f"if (cell.level == 1) {{{{ {BEAMS[kind]} }}}}")).replace("{{", "{")
    hits, _ = _beams(device, tmp_path, kernel.replace("}}", "}"), "quadtree")
    assert (hits.status == INVALID).all()


def test_a_large_cell_can_miss_or_give_up_and_no_more(device, tmp_path):
    for status, expected in (("MISS", 0), ("EXHAUSTED", 2), ("HIT", INVALID), ("7", INVALID)):
        hits, levels = _beams(device, tmp_path, CELL.format(f"hit.status = {status};", PAINT), "quadtree")
        assert (hits.status == expected).all()
        assert expected == INVALID or (levels == 1).all()


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    "surface", [surfaces.get(name) for name in ("torus", "cayley", "barth_sextic")], ids=lambda s: s.name
)
@pytest.mark.parametrize("name", ["newton", "yuksel", "analytic", "sturm", "eft_yuksel"])
def test_methods_of_ours_give_no_invalid_answer(device, name, surface):
    plugin = find_methods().get(name)
    if reason := plugin.method.accepts(surface):
        pytest.skip(reason)
    rays = rays_of(camera_for(VIEW, surface), 48)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surface, "float32", device.language, "rays"
    )
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = answers.validated(hits_from(launch.read()), surface.domain, rays)
    launch.release()
    assert answers.invalid(hits) == 0


ENDLESS = {
    "counts": "real t = t0; while (true) { t += 0.0; hit.evaluations += 1; if (t > 1.0e30) return missed(hit); }"
    "  return hit;",
    "counts nothing": "real t = t0; while (t < 1.0e30) { t = 0.5 * (t + t0); }  hit.t = t; return missed(hit);",
    "inner": "real t = t0; for (int i = 0; i < 100000; i++) { real s = t; while (s < 1.0e30 && i >= 0) {"
    " s = 0.5 * (s + t0); } t += s - t0; }  return t > 1.0e30 ? hit_at(hit, t0) : missed(hit);",
    "hits after it": "real t = t0; while (t < 1.0e30) { t = 0.5 * (t + t0); }  return hit_at(hit, t);",
    "is long": "real t = 0.0; for (int i = 0; i < 70000; i++) { t = 0.5 * (t + t0); }  hit.evaluations = 1;"
    " return t < 1.0e30 ? missed(hit) : hit_at(hit, t0);",
}


@pytest.fixture
def ending_device():
    names = [info.name for info in usable_devices() if info.name == "opengl:llvmpipe"]
    if not names:
        pytest.skip("no llvmpipe")
    return opened(names[0])


@pytest.mark.parametrize("kind", ENDLESS)
def test_a_ray_whose_loops_the_driver_ended_is_exhausted(ending_device, tmp_path, sphere_rays, kind):
    hits = _cast(ending_device, tmp_path, ENDLESS[kind], sphere_rays)
    inside = _inside(surfaces.get("sphere"), sphere_rays)
    assert (hits.status[inside] == RayStatus.EXHAUSTED).all()


def test_long_loops_under_the_limit_are_left_alone(ending_device, tmp_path, sphere_rays):
    body = (
        "real t = 0.0; for (int i = 0; i < 60000; i++) { t = 0.5 * (t + t0); } return t > 1.0e30 ? hit : missed(hit);"
    )
    hits = _cast(ending_device, tmp_path, body, sphere_rays)
    assert (hits.status == RayStatus.MISS).all()


def test_a_beam_whose_loops_the_driver_ended_is_exhausted(ending_device, tmp_path):
    endless = "real s = 1.0; while (s < 1.0e30) { s = 0.5 * (s + real(cell.x)); hit.evaluations += 1; } hit.t = s;"
    for casts in ("beams", "quadtree"):
        hits, _ = _beams(ending_device, tmp_path, CELL.format(endless, PAINT), casts)
        assert RayStatus.EXHAUSTED in hits.status
        assert set(hits.status) <= {RayStatus.EXHAUSTED, INVALID}, "loops that paint a large cell are ended too"


# Fragments


def _drawn(device, folder, body):
    place = folder / digest(body)
    place.mkdir(exist_ok=True)
    (place / "kernel.glsl").write_text(
        f"Hit first_hit(Ray ray, real t0, real t1) {{\n    Hit hit = no_hit(t0);\n    {body}\n}}\n"
    )
    scene = single(surfaces.get("sphere"), VIEW)
    catalog = Catalog({"made": Plugin(MADE, place)})
    camera = camera_for(VIEW, surfaces.get("sphere"))
    batches = [d.batch(True) for d in draws.draws(scene, Variant("made"), "box", catalog)]
    built = [device.build(batch.program) for batch in batches]
    depths = depth_map(scene, camera)
    pictures = []
    for _ in range(2):
        launch = device.launch_raster(batches, built, camera, depths, 24, device.build(fill_program()))
        launch.run()
        pictures.append(launch.picture())
        launch.release()
    assert not pictures[0].differing(pictures[1]).any()
    return scene, pictures[0]


@pytest.mark.parametrize("kind", WRONG_HITS)
def test_a_fragment_without_an_answer_makes_its_pixel_invalid(ending_device, tmp_path, kind):
    hits = hits_of(*_drawn(ending_device, tmp_path, WRONG_HITS[kind]))
    inside = _inside(surfaces.get("sphere"), rays_of(camera_for(VIEW, surfaces.get("sphere")), 24))
    assert (hits.status[inside] == INVALID).mean() > 0.99  # a proxy's edge may leave a pixel out
    assert set(hits.status) <= {INVALID, RayStatus.MISS}
    assert (hits.evaluations >= 0).all()


def test_a_fragment_whose_loops_the_driver_ended_is_exhausted(ending_device, tmp_path):
    scene, picture = _drawn(ending_device, tmp_path, ENDLESS["counts"])
    assert (picture.exhausted[picture.fragments > 0] > 0).mean() > 0.7  # all that are in the domain
    assert RayStatus.HIT not in picture.hits(np.ones(24 * 24)).status
    assert scene.instances == 1


def test_pictures_that_differ_anywhere_are_told(ending_device, tmp_path):
    _, picture = _drawn(ending_device, tmp_path, "return hit_at(hit, t0);")
    for name, values in vars(picture).items():
        other = values.copy()
        pixel = other.reshape(len(other), -1)[7]
        pixel[0] = 1 if np.isnan(pixel[0]) or pixel[0] != 1 else 0
        assert np.flatnonzero(picture.differing(dataclasses.replace(picture, **{name: other}))).tolist() == [7], name


# The same program twice


class Flaky(Launch):
    """Answers otherwise from its second run on."""

    upload_ms = 0.0

    def __init__(self, outputs, change):
        self._outputs, self._change, self._runs = outputs, change, 0

    def run(self, times=1):
        self._runs += times
        if self._runs == 2:
            self._change(*self._outputs)  # in place, as drivers reuse what was read
        return Timing(1.0, None)

    def read(self):
        return self._outputs

    def release(self):
        pass


def _later_t(t, _):
    t[7] += 1e-6


def _other_status(_, word):
    word[3] = 4 * 9


def _other_count(_, word):
    word[3:5] += 4


def _nan(t, _):
    t[6] = np.nan


@pytest.mark.parametrize(
    ("change", "differing"),
    [(_later_t, 1), (_other_status, 1), (_other_count, 2), (_nan, 1), (lambda *_: None, 0)],
)
def test_a_program_that_answers_otherwise_when_it_is_run_again_fails(monkeypatch, change, differing):
    """t's last bit, a status and a count, on a device whose read-back reuses its memory."""
    count = 5
    t = np.arange(2.0 * count)
    outputs = [t, np.full(count, 4 * 9 + RayStatus.HIT, np.int32)]
    worker = Worker("made:up")
    monkeypatch.setattr(Worker, "_device", SimpleNamespace(info=None))
    monkeypatch.setattr(worker, "_build", lambda *_: (None, 0.0))
    monkeypatch.setattr("harness.devices.messages.launch_rays", lambda *_: Flaky(outputs, change))
    check = ListedCheck(Program("cl", "float32", "rays", ()), np.zeros((count, 6), np.float32))
    if not differing:
        assert len(worker.check(check).answer.t) == count
        return
    with pytest.raises(FirsthitError, match=f"answer {differing} of 5 rays differently") as caught:
        worker.check(check)
    assert caught.value.exit_code == 3


def test_answers_that_are_no_numbers_twice_are_the_same():
    other_nan = np.array([0x7FF8000000000001], np.uint64).view(np.float64)
    assert same_values(np.array([np.nan]), other_nan).all()
    assert same_values(np.float32([np.nan, 1.0]), np.float32([np.nan, 1.0])).all()
    assert not same_values(np.array([0.0]), np.array([-0.0])).any(), "bit for bit"


# The interval itself


def test_the_interval_is_the_domains_from_t_min_on():
    rays = np.tile(np.float32([-3, 0, 0, 1, 0, 0]), (6, 1))
    t = np.array([1.0, 2.0, 3.0, 4.0, 5.0, np.nan])
    for domain in (Sphere(1.0), Box((-1, -1, -1), (1, 1, 1))):
        assert answers.reachable(domain, rays, t).tolist() == [False, True, True, True, False, False]
        assert answers.reachable(domain, rays, t, 2.5).tolist() == [False, False, True, True, False, False]
        assert not answers.reachable(domain, rays + np.float32([0, 2, 0, 0, 0, 0]), t).any(), "passes by"
    inside = np.tile(np.float32([0, 0, 0, 1, 0, 0]), (3, 1))
    assert answers.reachable(Sphere(1.0), inside, np.array([-0.5, 0.0, 1.0])).tolist() == [False, True, True]
    assert answers.reachable(Sphere(1.0), inside[:0], np.zeros(0)).tolist() == []


@pytest.mark.parametrize("status", [-0, 1, 2, 3, 4, 255])
@pytest.mark.parametrize("evaluations", [-1, 0, 1])
def test_only_known_statuses_and_counts_are_answers(status, evaluations):
    hits = Hits(np.array([3.0]), np.array([status], np.uint8), np.array([evaluations], np.int32))
    found = answers.only(hits, np.array([True]))
    assert (found.status[0] == INVALID) == (status > 2 or evaluations < 0)
    assert np.isnan(found.t[0]) == (found.status[0] != RayStatus.HIT)


def test_beams_are_held_against_the_depths_of_the_bounding_sphere():
    rays = np.tile(np.float32([-3, 0, 0, 1, 0, 0]), (5, 1))
    hits = Hits(np.array([1.9, 2.0, 4.0, 4.1, np.nan]), np.ones(5, np.uint8), np.zeros(5, np.int32))
    found = answers.validated_beams(hits, Sphere(1.0), rays, np.float32([1, 0, 0]))
    assert found.status.tolist() == [INVALID, 1, 1, INVALID, INVALID]


def test_a_hit_that_spent_nothing_is_none_but_behind_a_prepass():
    ball, ray = surfaces.get("sphere").domain, np.array([[0, 0, -3, 0, 0, 1]], np.float32)
    hits = Hits(np.array([2.0]), np.array([RayStatus.HIT], np.uint8), np.array([0], np.int32))
    assert answers.validated(hits, ball, ray).status.tolist() == [RayStatus.INVALID]
    assert answers.validated(hits, ball, ray, counts=False).status.tolist() == [RayStatus.HIT]
