"""Where a method sees its rays begin: one section of the program, the same answers but for roundings, rays only."""

from __future__ import annotations

import itertools
import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import surfaces
from harness.accuracy import answers
from harness.accuracy.judge import Wrong, judge
from harness.cli import main
from harness.contract import ORIGINS, FirsthitError, Hits, RayStatus, Sphere, TruthStatus, View
from harness.devices.interface import Device, hits_from, launch_rays
from harness.experiment import plan as plans
from harness.experiment.kinds import draws
from harness.experiment.reading import load
from harness.kernels.assemble import method_program
from harness.kernels.raster import fill_program, raster_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of, scene_radius
from harness.scenes.model import single
from harness.scenes.records import depth_map
from harness.scenes.views import AngleChoice, by_angle
from reports.analysis import count_tests

from .conftest import opened, usable_devices
from .test_prepass import narrowed
from .test_raster import drawing_device, variant

RAYS_METHODS = [n for n, p in find_methods().plugins.items() if p.method.casts == "rays" and p.method.answers]
ITERATES = ("newton", "ray_march", "sphere_tracing")  # what they find depends on where their steps fall
VIEW = View("oblique", azimuth=30, elevation=35)
OTHERS = [origin for origin in ORIGINS if origin != "nearest"]


def program(
    method: str, surface: Any, origin: Any, entry: Any = "rays", precision: Any = "float32", **more: Any
) -> Any:
    plugin = find_methods().get(method)
    chosen, language = more.pop("chosen", plugin.variant({})), more.pop("language", "glsl")
    return method_program(
        plugin.method, plugin.folder, chosen, surface, precision, language, entry, origin=origin, **more
    )


def cast(
    device: Device, method: str, surface: Any, rays: Any, origin: Any, precision: Any = "float32", **more: Any
) -> Hits:
    made = program(method, surface, origin, precision=precision, language=device.language, **more)
    launch = launch_rays(device, made, device.build(made), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


@cache
def case(name: str, size: int = 40) -> tuple[Any, Any, Any]:
    surface = surfaces.get(name)
    rays = rays_of(camera_for(VIEW, surface), size)
    return surface, rays, first_hits(surface, rays)


def sections(made: Any) -> list[str]:
    return [section.text for section in (*made.sections, *made.vertex)]


@pytest.mark.parametrize("entry", ["rays", "camera"])
@pytest.mark.parametrize("origin", OTHERS)
def test_programs_differ_in_the_shift_alone(origin, entry):
    torus = surfaces.get("torus")
    pairs = zip(
        sections(program("newton", torus, "nearest", entry)),
        sections(program("newton", torus, origin, entry)),
        strict=True,
    )
    (differs,) = [pair for pair in pairs if pair[0] != pair[1]]
    assert all("real own_shift(Ray ray)" in text for text in differs)


def test_fragments_differ_in_the_shift_alone():
    plugin, torus = find_methods().get("newton"), surfaces.get("torus")
    made = {
        origin: sections(
            raster_program(plugin.method, plugin.folder, plugin.variant({}), torus, "box", True, origin=origin)
        )
        for origin in ORIGINS
    }
    for origin in OTHERS:
        assert sum(a != b for a, b in zip(made["nearest"], made[origin], strict=True)) == 1


@pytest.mark.one_in(3)
@pytest.mark.parametrize("name", ["torus", "barth_sextic"])
@pytest.mark.parametrize("method", RAYS_METHODS)
def test_from_every_origin_a_method_answers_alike_in_float64(method, name):
    """Two shifts may round a ray near another answer differently; t is told along the ray as given."""
    surface, rays, truth = case(name)
    if reason := find_methods().get(method).method.accepts(surface):
        pytest.skip(reason)
    device = next((opened(info.name) for info in usable_devices() if info.float64), None)
    if device is None or "float64" not in find_methods().get(method).method.precisions:
        pytest.skip("no float64")
    found = {origin: cast(device, method, surface, rays, origin, "float64") for origin in ORIGINS}
    verdicts = {
        origin: judge(answers.validated(hits, surface.domain, rays, origin=origin), truth, scene_radius(surface), 1e-3)
        for origin, hits in found.items()
    }
    clear = ~verdicts["nearest"].grazing
    wrong = {origin: int((clear & (verdict.wrong != Wrong.RIGHT)).sum()) for origin, verdict in verdicts.items()}
    right = np.logical_and.reduce([v.wrong == Wrong.RIGHT for v in verdicts.values()]) & clear
    hit = right & (found["nearest"].status == RayStatus.HIT)
    assert hit.sum() > 300
    for origin in OTHERS:
        assert abs(wrong[origin] - wrong["nearest"]) <= (8 if method in ITERATES else 0), wrong
        assert np.abs(found[origin].t - found["nearest"].t)[hit].max() < 2e-3 * scene_radius(surface)


def test_sturm_as_printed_needs_the_shift():
    """toledo2007, section 4.1: at the eye its chain is of large numbers that nearly cancel, and rays are lost."""
    torus, device = surfaces.get("torus"), opened(usable_devices()[0].name)
    chosen = find_methods().get("sturm").setting("Sturm")
    wrong, errors, judged = dict.fromkeys(ORIGINS, 0), dict.fromkeys(ORIGINS, 0.0), 0
    for view in by_angle(AngleChoice(values=[0, 36, 72], distance=5.584)):
        rays = rays_of(camera_for(view, torus), 96)
        truth = first_hits(torus, rays)
        judged += int((truth.status != TruthStatus.UNDECIDED).sum())
        for origin in ORIGINS:
            hits = answers.validated(
                cast(device, "sturm", torus, rays, origin, chosen=chosen), torus.domain, rays, origin=origin
            )
            verdicts = judge(hits, truth, scene_radius(torus), 1e-3)
            wrong[origin] += int((verdicts.wrong != Wrong.RIGHT).sum())
            right = (verdicts.wrong == Wrong.RIGHT) & (hits.status == RayStatus.HIT)
            errors[origin] = max(errors[origin], float(np.abs(hits.t - truth.lower)[right].max()))
    assert count_tests.exceeds(wrong["eye"], judged, wrong["nearest"], judged, factor=8.0), wrong
    assert count_tests.exceeds(wrong["eye"], judged, wrong["entry"], judged, factor=8.0), wrong
    assert errors["eye"] > 100.0 * errors["nearest"]


@pytest.mark.parametrize("origin", ORIGINS)
def test_the_planes_of_loop_and_blinn_do_not_move_with_a_rays_origin(device, origin):
    """Between planes that just hold the domain every hit is found."""
    surface, rays, truth = case("torus")
    chosen = find_methods().get("analytic").variant({"SCREEN": 1, "POLISH": 0, "NEAR": 2.875, "FAR": 4.875})
    hits = cast(device, "analytic", surface, rays, origin, chosen=chosen)
    clear = (truth.status == TruthStatus.CROSSING) & (truth.margin > 0.01)
    assert clear.sum() > 300
    assert (hits.status[clear] == RayStatus.HIT).all()


@pytest.mark.parametrize("origin", ORIGINS)
def test_a_surface_that_touches_its_domain_is_not_cut_off_from_afar(device, origin):
    """Every hit lies on the ball's end, where the clip of a far ray is off by the roundings of its distance."""
    ball = surfaces.from_formula("x^2 + y^2 + z^2 - 1", "sphere:1")
    side = np.linspace(-0.7, 0.7, 9)
    rays = np.array([(300.0, y, z, -1.0, 0.0, 0.0) for y, z in itertools.product(side, side)], np.float32)
    hits = answers.validated(cast(device, "ray_march", ball, rays, origin), ball.domain, rays, origin=origin)
    assert (hits.status == RayStatus.HIT).all()


@pytest.mark.parametrize("origin", OTHERS)
def test_a_listed_ray_begins_at_t_min_from_any_origin(device, origin):
    ball = surfaces.from_formula("x^2 + y^2 + z^2 - 1", "sphere:1.5")
    rays = np.array([(1, 0, 0, 1, 0, 0), (1, 0, 0, -1, 0, 0), (0, 0, 0, 0, 1, 0)], np.float32)
    at_once, later = (cast(device, "bernstein", ball, rays, origin, t_min=t_min) for t_min in (0.0, 0.25))
    assert at_once.status.tolist() == [RayStatus.HIT] * 3 and at_once.t[:2].tolist() == [0.0, 0.0]
    assert later.status.tolist() == [RayStatus.MISS, RayStatus.HIT, RayStatus.HIT]
    assert later.t[1:] == pytest.approx([2.0, 1.0], abs=1e-5)


def test_an_answer_from_the_eye_may_be_off_by_the_roundings_of_its_distance():
    ball, t = Sphere(1.0), np.array([1001.0004])
    ray = np.array([[-1000.0, 0.0, 0.0, 1.0, 0.0, 0.0]], np.float32)
    assert answers.reachable(ball, ray, t, origin="eye").tolist() == [True]
    assert answers.reachable(ball, ray, t, origin="nearest").tolist() == [False]
    assert answers.reachable(ball, ray, t + 0.01, origin="eye").tolist() == [False]


@pytest.mark.parametrize("origin", OTHERS)
def test_a_prepass_narrows_rays_from_any_origin(device, origin):
    surface, rays, truth = case("torus")
    camera = camera_for(VIEW, surface)
    hits = narrowed(device, "bernstein", surface, camera, rays=rays, origin=origin)
    verdicts = judge(hits, truth, scene_radius(surface), 1e-3)
    assert (verdicts.wrong[~verdicts.grazing] == Wrong.RIGHT).all()


@pytest.mark.parametrize("origin", OTHERS)
def test_fragments_cast_from_any_origin(origin):
    gl = drawing_device() or pytest.skip("no device that rasterises")
    surface, _, truth = case("torus", 90)
    camera, scene = camera_for(VIEW, surface), single(surface, VIEW)
    drawn = draws.draws(scene, variant("bernstein"), "box", find_methods(), origin=origin)
    assert all("origin_" + origin in str([s.origin for s in d.check.sections]) for d in drawn)
    batches = [d.batch(True) for d in drawn]
    launch = gl.launch_raster(
        batches,
        [gl.build(b.program) for b in batches],
        camera,
        depth_map(scene, camera),
        90,
        gl.build(fill_program()),
    )
    launch.run()
    hit = (launch.picture().batch >= 0).reshape(-1)
    launch.release()
    assert (hit != np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH))).sum() <= 8


@pytest.mark.parametrize("method", ["interval_uniform", "interval_adaptive"])
def test_beams_have_no_origin(method):
    with pytest.raises(FirsthitError, match=f"an origin is chosen for rays, and the method {method} casts beams"):
        program(method, surfaces.get("torus"), "eye", "beams")


@pytest.mark.usefixtures("devices_found_once")
def test_commands_take_an_origin_and_refuse_it_for_beams(tmp_path, capsys):
    rays = tmp_path / "rays.npy"
    np.save(rays, np.array([(0, 0, 300, 0, 0, -1)], np.float32))
    told = {}
    for origin in ORIGINS:
        hits = tmp_path / f"{origin}.npz"
        command = ["trace", "--surface", "sphere", "--method", "bernstein", "--rays", str(rays), "-o", str(hits)]
        assert main([*command, "--origin", origin]) == 0
        told[origin] = float(np.load(hits)["t"][0])
    assert told["nearest"] == pytest.approx(299.0, abs=1e-6) and told["eye"] == pytest.approx(299.0, abs=1e-4)
    picture = [
        "show",
        "--surface",
        "torus",
        "--method",
        "interval_uniform",
        "--size",
        "8",
        "-o",
        str(tmp_path / "x.png"),
    ]
    capsys.readouterr()
    assert main([*picture, "--origin", "eye"]) == 2
    assert "an origin is chosen for rays" in capsys.readouterr().err


CONFIG = """title = "t"
surfaces = ["torus"]
sizes = [16]
origins = [{origins}]
devices = ["any"]
families = ["far_origin"]
[[method]]
name = "bernstein"
[[method]]
name = "interval_uniform"
[[method]]
name = "null"
[accuracy]
size = 16
[budget]
seconds = 0.01
"""


def written(folder: Path, origins: str) -> Path:
    path = folder / "t.toml"
    path.write_text(CONFIG.format(origins=origins))
    return path


def test_origins_multiply_the_grid_of_rays_and_no_other(tmp_path):
    experiment = load(written(tmp_path, '"nearest", "eye"'), find_methods())
    planned = plans.plan(experiment, find_methods(), list(usable_devices()))
    casters = [p.cell.caster for p in planned if not p.cell.family]
    assert casters == ["bernstein", "bernstein from the eye", "interval_uniform", "null", "null from the eye"]
    assert len({p.key for p in planned}) == len({p.cell.slot for p in planned}) == len(planned)
    far = [p.cell.origin for p in planned if p.cell.family and p.cell.variant.method == "bernstein"]
    assert far == ["nearest", "eye"]
    plain = plans.plan(load(written(tmp_path, '"nearest"'), find_methods()), find_methods(), list(usable_devices()))
    assert {p.key for p in plain} <= {p.key for p in planned}, "what is not moved keeps its rows"


def test_an_unknown_origin_is_answered_with_line_and_neighbour(tmp_path):
    with pytest.raises(FirsthitError, match=r"t\.toml:4: origins: unknown 'eyes'; did you mean 'eye'\?"):
        load(written(tmp_path, '"eyes"'), find_methods())


@pytest.mark.usefixtures("devices_found_once")
def test_rows_say_where_their_rays_begin(tmp_path):
    path = written(tmp_path, '"entry", "eye"')
    assert main(["run", str(path), "--runs", str(tmp_path / "runs")]) == 0
    rows = [json.loads(file.read_text()) for file in (tmp_path / "runs" / "t" / "cells").iterdir()]
    told = {(row["method"], row["origin"]) for row in rows if row["status"] == "ok"}
    rays = set(itertools.product(("bernstein", "null"), ("entry", "eye")))
    assert told >= rays | {("interval_uniform", None)}
    by_origin = {row["origin"]: row for row in rows if row["method"] == "bernstein" and not row["family"]}
    assert by_origin["entry"]["accuracy"]["error"]["max"] < by_origin["eye"]["accuracy"]["error"]["max"]


def test_a_march_by_shells_stays_in_its_table_from_afar(device):
    """From 115 radii the squared distance from the centre cancels to below 0, where there is no shell."""
    nowhere = surfaces.from_formula("x^2 + y^2 + z^2 + 0.5", "sphere:1")
    rays = rays_of(camera_for(View("far", azimuth=30, elevation=35, fov=1), nowhere), 33)
    far, near = (cast(device, "sphere_tracing_lipschitz", nowhere, rays, origin) for origin in ("eye", "nearest"))
    assert (far.status == RayStatus.MISS).all() and (near.status == RayStatus.MISS).all()
    assert far.evaluations.max() <= 2 * near.evaluations.max()
