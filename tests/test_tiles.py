"""Frames of tiles: their stages are launched in order, and what is checked are the very rays of the oracle.

The stages here are a stand-in's (tile_stand_in), which isolate nothing: Newton's method casts each pixel.
"""

import dataclasses
from functools import cache

import numpy as np
import pytest

import surfaces
from harness import cli
from harness.contract import FirsthitError, RayStatus, View
from harness.devices.interface import hits_from, launch_camera, launch_rays
from harness.devices.messages import FirstRun
from harness.devices.tiles import TileCheck, TileFrame, tile_hits_from
from harness.experiment.kinds.tiles import TileMethods, checked_over, frame_of
from harness.experiment.plan import plan
from harness.experiment.reading import load
from harness.hardcases import groups
from harness.kernels import tiles as kernels
from harness.kernels.assemble import method_program
from harness.plugins import find_methods
from harness.results import pictures_file
from harness.results.store import Store
from harness.running import trace
from harness.running.trace import Caster, cast
from harness.scenes.camera import camera_for, rays_of

from . import tile_stand_in
from .conftest import opened, usable_devices
from .tile_stand_in import METHOD

VIEW = View("far", azimuth=30, elevation=35, distance=9.0)
SIZE = 61  # its tiles reach out of it


TORUS = surfaces.get("torus")


@cache
def alone(name, precision, entry):
    """The stand-in's method by itself, built."""
    plugin, device = find_methods().get(METHOD), opened(name)
    stated = plugin.method, plugin.folder, plugin.variant({}), TORUS, precision, device.language
    program = method_program(*stated, entry)
    return device, program, device.build(program)


@cache
def frames(name, precision, listed):
    """The stand-in's programs, and the same built."""
    device = opened(name)
    programs = tile_stand_in.programs(TORUS, precision, device.language, listed)
    return programs, [device.build(program) for program in programs]


def outputs_of(launch):
    launch.run()
    outputs = [values.copy() for values in launch.read()]
    launch.release()
    return outputs


def same(found, expected):
    return all(
        np.array_equal(a, b, equal_nan=True) for a, b in zip(vars(found).values(), vars(expected).values(), strict=True)
    )


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_each_pixel_of_a_frame_is_answered_once_by_the_stage_that_is_due(device, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("no float64 here")
    camera = camera_for(VIEW, TORUS)
    programs, built = frames(device.info.name, precision, False)
    hits, stages = tile_hits_from(outputs_of(frame_of(programs, TORUS, camera, SIZE).launch(device, built)))
    expected = hits_from(outputs_of(launch_camera(*alone(device.info.name, precision, "camera"), camera, SIZE)))
    due = tile_stand_in.expected_stages(TORUS, camera, SIZE)
    assert set(due.ravel()) == set(range(6))
    assert np.array_equal(stages.reshape(SIZE, SIZE), due)
    assert same(hits, expected)


@pytest.mark.parametrize(("side", "samples", "ratio"), [(9, 9, 1), (9, 18, 2), (9, 26, 3), (8, 27, 4), (12, 5, 1)])
def test_a_check_casts_the_rays_of_the_grid_as_they_were_made_on_the_host(device, side, samples, ratio):
    camera = camera_for(VIEW, TORUS)
    rays = rays_of(camera, side)
    moved, found = checked_over(camera, side, samples)
    assert found == ratio
    programs, built = frames(device.info.name, "float32", True)
    check = TileCheck(frame_of(programs, TORUS, moved, ratio * side), rays, ratio, np.arange(side * side))
    outputs = outputs_of(check.launch(device, built))
    answer = check.answer(FirstRun(device.info, check.hits(outputs), outputs))
    expected = hits_from(outputs_of(launch_rays(*alone(device.info.name, "float32", "rays"), rays)))
    assert same(answer.hits, expected)
    due = tile_stand_in.expected_stages(TORUS, moved, ratio * side)
    assert np.array_equal(answer.stages, due.ravel()[check.pixels])
    assert answer.shares == {
        name: np.mean(due == stage)
        for stage, name in enumerate(["empty_16", "empty_8", "single_16", "single_8", "packets", "rest"])
    }
    assert answer.evaluations[1] >= expected.evaluations.max()


@pytest.mark.parametrize(("side", "samples"), [(8, 8), (8, 15), (6, 18), (8, 32), (5, 49)])
def test_the_grids_rays_go_through_middles_of_the_checks_pixels(side, samples):
    camera = camera_for(VIEW, TORUS)
    moved, ratio = checked_over(camera, side, samples)
    size = ratio * side
    assert size >= samples and size - samples < side
    frame = TileFrame((None,) * 4, moved, size, np.zeros(0))
    pixels = TileCheck(frame, rays_of(camera, side), ratio, np.arange(side * side)).pixels
    apart = rays_of(moved, size)[pixels, 3:].astype(float) - rays_of(camera, side)[:, 3:]
    width = 2 * np.linalg.norm(camera[6:9]) / size
    assert np.abs(apart).max() < 1e-5 * width + 2e-7


def pictures(device, rays, edit=lambda program: program):
    """The hits of rays in the middles of small frames, by the stand-in with its programs changed."""
    programs, _ = frames(device.info.name, "float32", True)
    programs = tuple(edit(program) for program in programs)
    check = TileMethods().hard_check(programs, TORUS, rays)
    return check.run(device, [device.build(program) for program in check.programs])


def test_a_hard_ray_is_cast_in_the_middle_of_a_small_frame_as_it_is_when_listed(device):
    (group,) = groups.groups("origin_inside")
    rays = np.concatenate([group.rays[::101], groups.groups("grazing")[0].rays[::101]])
    expected = hits_from(outputs_of(launch_rays(*alone(device.info.name, "float32", "rays"), rays)))
    assert same(pictures(device, rays), expected)


def test_a_pixel_that_no_stage_answers_has_no_answer_in_any_small_frame(device):
    def idle(program):
        """Let `finish` do nothing."""
        sections = [
            dataclasses.replace(
                s, text=s.text.replace("while (e < counts[2 + level]", "while (e < 0 * counts[2 + level]")
            )
            for s in program.sections
        ]
        return dataclasses.replace(program, sections=tuple(sections))

    rays = rays_of(camera_for(VIEW, TORUS), 5)[11:14]  # each is in a frame's first tile, which is single
    assert (pictures(device, rays, idle).status == RayStatus.INVALID).all()
    assert (pictures(device, rays).status != RayStatus.INVALID).all()


CONFIG = """title = "t"
surfaces = ["torus"]
sizes = [23]
samples_per_pixel = [4]
devices = ["{device}"]
families = ["grazing"]
{settings}
{methods}
[accuracy]
size = 10
[budget]
seconds = 0.002
rounds = 1
"""
STATED = f"""import dataclasses
from methods.{METHOD}.method import METHOD as ALONE
METHOD = dataclasses.replace(ALONE, name="stand_in", casts="tiles", rest="{METHOD}")
"""


def planted(folder, settings=""):
    """Write a method that casts tiles by the stand-in, and a config of it and of the stand-in's method alone."""
    mine = folder / "plugins" / "stand_in"
    mine.mkdir(parents=True)
    (mine / "method.py").write_text(STATED)
    (mine / "kernel.glsl").write_text("// all is in the stages\n")
    methods = "".join(f'[[method]]\nname = "{name}"\n' for name in (METHOD, "stand_in"))
    text = CONFIG.format(device=usable_devices()[0].name, methods=methods, settings=settings)
    (folder / "t.toml").write_text(text)
    return mine.parent, folder / "t.toml"


@pytest.mark.usefixtures("devices_found_once")
def test_rows_of_tiles_hold_what_rows_of_rays_hold_and_the_stages_beside(tmp_path, monkeypatch):
    plugins, config = planted(tmp_path)
    monkeypatch.setattr(kernels, "stage_program", tile_stand_in.stage_program)
    assert cli.main(["--plugins", str(plugins), "run", str(config), "--runs", str(tmp_path / "runs")]) == 0
    run = tmp_path / "runs" / "t"
    rows = {(row["method"], row["family"] or row["surface"]): row for row in Store(run).rows()}
    assert rows["stand_in", "grazing"]["rungs"] == rows[METHOD, "grazing"]["rungs"]
    mine = rows["stand_in", "torus"]
    own, listed = mine["accuracy"], rows[METHOD, "torus"]["accuracy"]
    assert {name for name in listed if own[name] != listed[name]} <= {"evaluations_mean", "evaluations_max"}
    assert own.keys() - listed.keys() == {"stages"} and sum(own["stages"].values()) == pytest.approx(1.0)
    assert own["evaluations_mean"] == pytest.approx(listed["evaluations_mean"], rel=0.3)
    assert mine["time"]["median_ms"] > 0.0 and mine["origin"] is None
    stages = pictures_file.read(run / mine["arrays"])["stage"]
    assert stages.shape == (10, 10) and set(np.unique(stages)) <= set(range(6))
    assert cli.main(["verify", str(run)]) == 0


def test_what_tiles_cannot_do_is_refused_in_one_sentence(tmp_path, monkeypatch):
    settings = 'stages = ["compute", "rays", "raster"]\nprepass = ["none", "beams"]'
    plugins, config = planted(tmp_path, settings)
    monkeypatch.setattr(kernels, "stage_program", tile_stand_in.stage_program)
    catalog, device = find_methods(plugins), dataclasses.replace(usable_devices()[0], name="opengl:llvmpipe")
    config.write_text(config.read_text().replace(usable_devices()[0].name, device.name))
    planned = plan(load(config, catalog), catalog, [device])
    skips = {(p.cell.stage, p.cell.prepass): p.skip for p in planned if p.cell.variant.method == "stand_in"}
    listed = "the method casts the tiles of a camera's image, and listed rays have none"
    assert skips["compute", "none"] is None and skips["rays", "none"] is None  # the second is the family's
    assert skips["raster", "none"].endswith("casts the tiles of a camera's image, and fragments have none")
    assert skips["compute", "beams"] == "a prepass narrows the rays of a camera's pixels, in the stage compute"
    assert listed in {p.skip for p in planned}
    unstated = dataclasses.replace(catalog.get("stand_in").method, rest="")
    catalog.plugins["stand_in"] = dataclasses.replace(catalog.get("stand_in"), method=unstated)
    told = {p.skip for p in plan(load(config, catalog), catalog, [device])}
    assert "the method stand_in states no `rest`, which casts what no tile decides" in told
    with pytest.raises(FirsthitError, match="an origin is chosen for rays, and the method stand_in casts tiles"):
        method_program(
            unstated, plugins, catalog.get(METHOD).variant({}), TORUS, "float32", "cl", "finish", origin="eye"
        )


def test_a_shot_of_tiles_is_the_image_of_listed_rays_and_has_the_devices_form_of_lanes(monkeypatch):
    device, made = opened(usable_devices()[0].name), []

    def stage_program(*stated):
        made.append(stated[-1])
        return tile_stand_in.stage_program(*stated)

    monkeypatch.setattr(kernels, "stage_program", stage_program)
    monkeypatch.setattr(trace, "discover_devices", lambda _: [dataclasses.replace(device.info, resident=2048)])
    catalog, camera = find_methods(), camera_for(VIEW, TORUS)
    catalog.plugins["stand_in"] = dataclasses.replace(catalog.get(METHOD), method=tile_stand_in.stand_in())
    shots = [
        cast(Caster(plugin, plugin.variant({}), device.info.name), TORUS, rays_of(camera, 20), camera)
        for plugin in (catalog.get("stand_in"), catalog.get(METHOD))
    ]
    assert same(*shots)
    assert set(made) == {"group"}
    plugin = catalog.get("stand_in")
    with pytest.raises(FirsthitError, match="casts the tiles of a camera's image, and listed rays have none"):
        cast(Caster(plugin, plugin.variant({}), device.info.name), TORUS, rays_of(camera, 20))


@pytest.mark.filterwarnings("error")
def test_what_lay_in_the_buffer_of_a_pixel_without_a_hit_is_no_warning():
    signalling = np.array([0x7FA00000], np.uint32).view(np.float32)
    hits, _ = tile_hits_from([signalling, np.array([int(RayStatus.MISS)], np.int32)])
    assert hits.status.tolist() == [RayStatus.MISS] and np.isnan(hits.t).all()
