"""The public interface: what it answers, which mistakes it names, and that it works in a plain script."""

import inspect
import json
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import firsthit
from harness import plugins
from harness.results.schema import DERIVED, SCHEMA

from .conftest import usable_devices

ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "docs/example.py"
HEAVY = (
    "argparse",
    "flint",
    "matplotlib",
    "moderngl",
    "pandas",
    "PIL",
    "pyarrow",
    "pyopencl",
    "sympy",
    "typst",
    "vl_convert",
)
ENVIRONMENT = os.environ | {"PYTHONPATH": str(ROOT), "MPLBACKEND": "Agg"}

needs_a_device = pytest.mark.skipif(not usable_devices(), reason="no device")


@pytest.fixture(autouse=True)
def found_once(devices_found_once):
    return devices_found_once


@pytest.fixture(scope="module")
def first_device() -> str:
    return usable_devices()[0].name


@pytest.fixture(scope="module")
def rays():
    return firsthit.rays_of(firsthit.View("oblique", elevation=35), "torus", 24)


def test_importing_it_loads_nothing_heavy():
    text = f"import sys, firsthit; print([name for name in {HEAVY} if name in sys.modules])"
    ran = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True, env=ENVIRONMENT)
    assert ran.stdout == "[]\n"


def test_all_that_is_promised_is_there_and_explained():
    for name in firsthit.__all__:
        found = getattr(firsthit, name)
        assert not inspect.isroutine(found) or len(found.__doc__) > 100, name
    with pytest.raises(AttributeError, match="nonesuch"):
        _ = firsthit.nonesuch


def test_methods_and_devices_are_described(tmp_path):
    assert firsthit.methods()["newton"].parameters[0].meaning
    assert {info.name for info in firsthit.devices() if not info.problem} == {info.name for info in usable_devices()}
    (tmp_path / "mine").mkdir()
    text = (
        'from firsthit import Method, Parameter\nMETHOD = Method("mine", "t", parameters=(Parameter("N", 3, "n"),))\n'
    )
    (tmp_path / "mine/method.py").write_text(text)
    (tmp_path / "mine/kernel.glsl").write_text("")
    assert firsthit.methods(tmp_path)["mine"].parameters[0].default == 3


@needs_a_device
def test_a_name_a_formula_and_a_surface_are_the_same_torus_to_tracer_and_oracle(first_device, rays):
    formula = "(x^2 + y^2 + z^2 + 0.49 - 0.09)^2 - 4*0.49*(x^2 + y^2)"
    surface = firsthit.surfaces.from_formula(formula, "sphere:1.1")
    found = [firsthit.trace(given, rays, "newton", first_device) for given in ("torus", formula, surface)]
    proved = [firsthit.oracle(given, rays) for given in ("torus", formula, surface)]
    hit = proved[0].status == firsthit.TruthStatus.CROSSING
    assert 100 < hit.sum() < len(rays)
    for hits, truth in zip(found, proved, strict=True):
        assert hits.t.shape == (len(rays),) and hits.t.dtype == np.float64
        assert ((hits.status == firsthit.RayStatus.HIT) == hit).mean() > 0.99
        both = hit & (hits.status == firsthit.RayStatus.HIT)
        assert np.quantile(np.abs(hits.t - truth.lower)[both], 0.99) < 1e-3
        assert np.array_equal(truth.status, proved[0].status)


@needs_a_device
def test_knobs_and_precision_change_the_error(first_device, rays):
    truth = firsthit.oracle("torus", rays)
    coarse = firsthit.trace("torus", rays, "newton", first_device, knobs={"EPSILON": 0.03})
    fine = firsthit.trace("torus", rays, "newton", first_device, knobs={"EPSILON": 0.00001})
    errors = [np.nanquantile(np.abs(hits.t - truth.lower), 0.9) for hits in (coarse, fine)]
    assert errors[1] < 0.1 * errors[0]


@needs_a_device
def test_a_picture_is_white_around_the_surface(first_device):
    picture = firsthit.render("x^2 + y^2 + z^2 - 1", "bernstein", first_device, size=48)
    assert picture.shape == (48, 48, 3) and picture.dtype == np.uint8
    assert (picture[0, 0] == 255).all() and (picture[24, 24] < 255).all()
    close = firsthit.View("close", azimuth=30, elevation=30, fov=5, distance=9.0)
    assert (firsthit.render("sphere", "newton", first_device, size=8, view=close) < 255).all()


@needs_a_device
def test_a_run_is_loaded_as_a_table_and_reused(tmp_path, first_device):
    config = tmp_path / "mine.toml"
    config.write_text(
        f'title = "t"\nsurfaces = ["sphere"]\nsizes = [32]\ndevices = ["{first_device}"]\nprecisions = ["float32"]\n'
        'method = [{ name = "newton" }, { name = "null" }]\naccuracy.size = 12\nbudget.seconds = 0.01\n'
    )
    told: list[str] = []
    done = firsthit.run(config, runs=tmp_path / "runs", tell=told.append)
    assert isinstance(done, firsthit.Run) and done.folder == tmp_path / "runs/mine"
    assert len(done.rows) == 2 and not done.reused and done.counts[firsthit.CellStatus.OK] == 2
    assert repr(done) == f"Run({str(done.folder)!r}: 2 run, 0 reused; 2 ok)"
    assert told[0].startswith("2 cells to run") and sum(" left" in line for line in told) == 2
    table = firsthit.load(done.folder)
    assert set(table.columns) == {field.name for field in (*SCHEMA, *DERIVED)}
    assert sorted(table["method"]) == ["newton", "null"]
    again = firsthit.run(str(config), runs=str(tmp_path / "runs"))
    assert not again.rows and len(again.reused) == 2
    command = json.loads((done.folder / "plan.json").read_text())["command"]
    assert command == f"firsthit run {config} --runs {tmp_path / 'runs'}"


@needs_a_device
def test_a_config_that_includes_others_is_one_run(tmp_path, first_device):
    for name, surface in (("a", "sphere"), ("b", "torus")):
        (tmp_path / f"{name}.toml").write_text(
            f'title = "t"\nsurfaces = ["{surface}"]\nsizes = [16]\nprecisions = ["float32"]\n'
            'method = [{ name = "null" }]\naccuracy.size = 8\nbudget.seconds = 0.01\n'
        )
    (tmp_path / "both.toml").write_text('title = "both"\ninclude = ["a.toml", "b.toml"]\n')
    done = firsthit.run(tmp_path / "both.toml", runs=tmp_path / "runs", devices=[first_device])
    assert done.folder == tmp_path / "runs/both"
    assert [row["surface"] for row in done.rows] == ["sphere", "torus"]
    assert sorted(firsthit.load(done.folder)["surface"]) == ["sphere", "torus"]


@needs_a_device
def test_a_recommendation_names_device_contenders_and_why_others_fell(tmp_path, first_device, monkeypatch, capfd):
    few = plugins.Catalog({name: plugins.find_methods().get(name) for name in ("analytic", "ray_march")})
    monkeypatch.setattr(plugins, "find_methods", lambda _: few)  # the search itself is the same with all of them
    wished = {"size": 32, "views": 1, "rays": 8, "seconds": 0.01, "runs": tmp_path}
    found = firsthit.recommend("x^2 + y^2 + z^2 - 1", 1e-3, first_device, **wished)
    said = capfd.readouterr()
    assert said.out == said.err == "", "nobody asked to be told"
    assert found.device.name == first_device
    assert found.contenders and found.contenders[0].error <= 1e-3
    assert found.fallen and all(fallen.why for fallen in found.fallen)
    told: list[str] = []
    few.plugins.pop("ray_march")
    firsthit.recommend("x^2 + y^2 + z^2 - 1", 1e-3, first_device, tell=told.append, **wished | {"rays": 9})
    assert told[0].startswith("float32: ") and "cells to run" in told[1] and told[2].endswith(" left")
    said = capfd.readouterr()
    assert said.out == said.err == ""


MISTAKES = {
    "did you mean torus": lambda rays: firsthit.trace("tors", rays, "newton"),
    "not int": lambda rays: firsthit.oracle(3, rays),
    "did you mean 'newton'": lambda rays: firsthit.trace("torus", rays, "newtn"),
    "did you mean 'EPSILON'": lambda rays: firsthit.trace("torus", rays, "newton", knobs={"EPSILN": 1.0}),
    "EPSILON is a number, not 'big'": lambda rays: firsthit.trace("torus", rays, "newton", knobs={"EPSILON": "big"}),
    "there is no device 'vulkan:0' here; known: ": lambda rays: firsthit.trace("torus", rays, "newton", "vulkan:0"),
    "unknown precision 'half'": lambda rays: firsthit.trace("torus", rays, "newton", precision="half"),
    "unknown origin 'here'": lambda rays: firsthit.trace("torus", rays, "newton", origin="here"),
    "they are float64; make them float32": lambda rays: firsthit.oracle("torus", rays.astype(np.float64)),
    "must be [n, 6]": lambda rays: firsthit.oracle("torus", rays.tolist()),
    "t_min must be finite and not negative": lambda rays: firsthit.oracle("torus", rays, -1.0),
    "1 to 8192 pixels": lambda _: firsthit.render("torus", "newton", size=0),
    "fov: 180.0 is outside [0.001, 179]": lambda _: firsthit.rays_of(firsthit.View("v", fov=180.0), "torus", 8),
    "fov: 0.0 is outside": lambda _: firsthit.rays_of(firsthit.View("v", fov=0.0), "torus", 8),
    "azimuth: nan is outside": lambda _: firsthit.View("v", azimuth=math.nan),
    "target needs 3 numbers, not (0, 1)": lambda _: firsthit.View("v", target=(0, 1)),
    "elevation is a number, not True": lambda _: firsthit.View("v", elevation=True),
    "size: -3 is outside [1, 16384]": lambda _: firsthit.rays_of(firsthit.View("v"), "torus", -3),
    "size is a whole number, not 2.5": lambda _: firsthit.rays_of(firsthit.View("v"), "torus", 2.5),
    "view is a View, not 'front'": lambda _: firsthit.rays_of("front", "torus", 8),
    "azimuth: nan is": lambda _: firsthit.render("torus", "newton", view=(math.nan, 0)),
    "size is a whole number, not 512.0": lambda _: firsthit.render("torus", "newton", size=512.0),
    "as in (30, 30), not 'front'": lambda _: firsthit.render("torus", "newton", view="front"),
    "as in (30, 30), not (1,)": lambda _: firsthit.render("torus", "newton", view=(1,)),
    "as in (30, 30), not None": lambda _: firsthit.render("torus", "newton", view=None),
    "timeout: nan is outside": lambda rays: firsthit.trace("torus", rays, "newton", "opencl:0", timeout=math.nan),
    "timeout: 0 is outside": lambda rays: firsthit.trace("torus", rays, "newton", "opencl:0", timeout=0),
    "timeout: -1 is outside": lambda rays: firsthit.trace("torus", rays, "newton", "opencl:0", timeout=-1),
    "a method's name is a text, as in 'newton', not None": lambda rays: firsthit.trace("torus", rays, None),
    "'float64', not <class": lambda rays: firsthit.trace("torus", rays, "newton", "opencl:0", precision=np.float32),
    "device is a text, not 3": lambda rays: firsthit.trace("torus", rays, "newton", 3),
    "there is no device '' here": lambda rays: firsthit.trace("torus", rays, "newton", ""),
    "EPSILON is a number, not True": lambda rays: firsthit.trace("torus", rays, "newton", knobs={"EPSILON": True}),
    "knobs are values by name": lambda rays: firsthit.trace("torus", rays, "newton", knobs=[0.1]),
    "column 3: '€'": lambda rays: firsthit.oracle("x²€+y²-1", rays),
    "unknown name 'xq'": lambda rays: firsthit.oracle("xq^2+y^2-1", rays),
    "write /2*x or /(2*x)": lambda rays: firsthit.oracle("1/2x^2-1", rays),
    "config is a path, as a text": lambda _: firsthit.run(None),
    "devices is a list of names, not 'opencl:pocl'": lambda _: firsthit.run("quick", devices="opencl:pocl"),
    "folder is a path, as a text": lambda _: firsthit.load(None),
    "plugins is a path, as a text": lambda _: firsthit.methods(3),
    "a surface's name is a text": lambda _: firsthit.surfaces.get(None),
    "parameter R is a number or": lambda _: firsthit.surfaces.get("torus", R=True),
    "radius 1e+60 is past the range of float32": lambda _: firsthit.Sphere(1e60),
    "a sphere's radius is a number, not 'big'": lambda _: firsthit.Sphere("big"),
    "a sphere's centre is three numbers": lambda _: firsthit.Sphere(1.0, (0.0, 0.0)),
    "a box's upper corner is three numbers": lambda _: firsthit.Box((0, 0, 0), 1.0),
    "a domain is a text, as in 'sphere:1.5', a Sphere or a Box, not 3": lambda _: firsthit.surfaces.from_formula(
        "x", 3
    ),
    "a formula is a text": lambda _: firsthit.surfaces.from_formula(None),
    "did you mean 'quick'": lambda _: firsthit.run("quik"),
    "cannot read none.toml": lambda _: firsthit.run("none.toml"),
    "there is no run folder none": lambda _: firsthit.load("none"),
    "no such folder": lambda _: firsthit.methods("none"),
    "error: -1.0 is outside": lambda _: firsthit.recommend("torus", -1.0),
    "error: 0 is outside": lambda _: firsthit.recommend("torus", 0),
    "error: nan is outside": lambda _: firsthit.recommend("torus", math.nan),
    "error is a number, not 'a'": lambda _: firsthit.recommend("torus", "a"),
    "views is a whole number, not 1.5": lambda _: firsthit.recommend("torus", 1.0, views=1.5),
    "rays: 5000 is outside [1, 4096]": lambda _: firsthit.recommend("torus", 1.0, rays=5000),
    "seed is a whole number, not 'q'": lambda _: firsthit.recommend("torus", 1.0, seed="q"),
    "seed: -1 is outside": lambda _: firsthit.recommend("torus", 1.0, seed=-1),
    "runs is a path, as a text": lambda _: firsthit.recommend("torus", 1.0, runs=None),
    "unknown quantile 'mean'": lambda _: firsthit.recommend("torus", 1.0, quantile="mean"),
}


@pytest.mark.parametrize("words", MISTAKES)
def test_mistakes_are_told_in_words(words, rays):
    with pytest.raises(firsthit.FirsthitError) as caught:
        MISTAKES[words](rays)
    assert str(caught.value).count(words) == 1


def test_numbers_of_numpy_are_numbers():
    torus = firsthit.surfaces.get("torus", R=np.float64(0.5), r=np.float32(0.3))
    assert torus == firsthit.surfaces.get("torus", R="0.5", r="0.3")
    given = firsthit.surfaces.from_formula("x - a", parameters={"a": np.float32(0.1)})
    assert given.parameters == (("a", "0.1"),), "the decimal that it prints, not the nearest one in float64"
    assert firsthit.View("v", azimuth=np.float32(30), fov=np.int64(20)) == firsthit.View("v", azimuth=30.0, fov=20)
    assert firsthit.rays_of(firsthit.View("v"), "torus", np.int64(2)).shape == (4, 6)
    bound = plugins.find_methods().get("newton").variant({"MAX_EVALUATIONS": np.int64(9), "EPSILON": np.float32(0.5)})
    assert {type(value) for _, value in bound.parameters} == {int, float}
    assert firsthit.Sphere(np.float64(2)) == firsthit.Sphere(2)


def test_a_domain_is_as_good_as_its_text():
    ball = firsthit.surfaces.from_formula("x", firsthit.Sphere(1.0))
    assert ball == firsthit.surfaces.from_formula("x", "sphere:1")


@needs_a_device
def test_the_example_is_short_runs_as_a_plain_script_and_draws_its_figure(tmp_path):
    text = EXAMPLE.read_text(encoding="utf-8")
    assert sum(bool(line.strip()) and not line.startswith("# ") for line in text.splitlines()) < 30
    ran = subprocess.run(
        [sys.executable, EXAMPLE], cwd=tmp_path, env=ENVIRONMENT, capture_output=True, text=True, timeout=250
    )
    assert ran.returncode == 0, ran.stderr
    assert "12 cells to run" in ran.stdout
    table = firsthit.load(tmp_path / "runs/cube")
    assert set(table["status"]) == {"ok"}
    assert table.groupby("method")["error_max"].min().lt(1e-3).all()
    from PIL import Image

    drawn, shown = (Image.open(path) for path in (tmp_path / "cube.png", ROOT / "docs/example.png"))
    assert drawn.size == shown.size
    cube = np.asarray(drawn.convert("RGB"))[:, : drawn.width // 3]
    assert 0.3 < (cube[:, :, 0] < 200).mean() < 0.9
