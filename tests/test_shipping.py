"""`firsthit kernel`: what it writes draws by itself, answers as the checked program does, and holds nothing unused."""

import ast
import dataclasses
import os
import re
import shlex
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

import surfaces
from harness import ROOT
from harness.cli import main
from harness.contract import FirsthitError, RayStatus, Section, View
from harness.devices.interface import LANGUAGES, launch_camera
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of
from harness.shipping.program import Shipment
from harness.shipping.pruned import items_of, pruned
from harness.shipping.trial import CameraCheck, DrawCheck

from .conftest import opened, rotation, usable_devices
from .test_devices import cast

pytestmark = pytest.mark.usefixtures("devices_found_once")

METHODS = [name for name, plugin in find_methods().plugins.items() if plugin.method.answers]
RAYS = [name for name in METHODS if find_methods().get(name).method.casts == "rays"]
FILES = ["LICENSE.txt", "README.txt", "draw.py"]
DRAWN = """
import runpy, sys
import numpy as np
made = runpy.run_path("draw.py", run_name="__main__")
np.savez("answers.npz", t=made["t"], answer=made["answer"], normals=made["normals"], view=made["camera"]())
"""
FORMULA = ("--formula", "x^4 + y^4 + z^4 - a", "--parameter", "a=0.5", "--domain", "box:1,1.25,1")
PLACES = [(info.name, precision) for info in usable_devices() for precision in ("float32", "float64") if info.float64]


def shipped(method, surface, language, precision="float32", **knobs):
    plugin = find_methods().get(method)
    return Shipment(plugin, plugin.variant(knobs), surface, language, precision)


SEEN = """
import pyopencl as cl
for i, platform in enumerate(cl.get_platforms()):
    for j, device in enumerate(platform.get_devices()):
        print(f"{i}:{j}|{platform.name} {device.driver_version}")
"""


@cache
def device_of(kind):
    """The name of a device that an example of that kind can open by itself, and the variables that name it there."""
    if kind == "glsl":
        return next(((info.name, ()) for info in usable_devices() if info.name.startswith("opengl:")), None)
    ran = subprocess.run([sys.executable, "-c", SEEN], capture_output=True, text=True, check=False, timeout=60)
    seen = dict(reversed(line.split("|")) for line in ran.stdout.splitlines())
    mine = (info for info in usable_devices() if info.name.startswith("opencl:"))
    return next(((info.name, (("PYOPENCL_CTX", seen[info.driver]),)) for info in mine if info.driver in seen), None)


@pytest.mark.parametrize(
    ("kind", "method", "of", "surface"),
    [
        ("glsl", "newton", ("--surface", "torus", "--knob", "EPSILON=1e-5"), surfaces.get("torus")),
        ("opencl", "bernstein", ("--surface", "barth_sextic"), surfaces.get("barth_sextic")),
        ("glsl", "interval_march", FORMULA, None),
        ("opencl", "ray_march", FORMULA, None),
    ],
)
def test_the_example_draws_what_the_harness_casts(tmp_path, capsys, kind, method, of, surface):
    if device_of(kind) is None:
        pytest.skip(f"no device that an example in {kind} can open")
    device, variables = device_of(kind)
    mine = surface or surfaces.from_formula(FORMULA[1], FORMULA[5], parameters={"a": "0.5"})
    assert main(["kernel", *of, "--method", method, "--language", kind, "-o", str(tmp_path)]) == 0
    assert "next:" in capsys.readouterr().out
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*FILES, f"program.{LANGUAGES[device[:6]]}"])
    without = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = [sys.executable, "-c", DRAWN]
    ran = subprocess.run(
        command, cwd=tmp_path, env=without | dict(variables), capture_output=True, text=True, check=False, timeout=120
    )
    assert ran.returncode == 0, ran.stderr
    found = np.load(tmp_path / "answers.npz")
    assert (tmp_path / "surface.png").read_bytes().startswith(b"\x89PNG")

    knobs = {"EPSILON": 1e-5} if method == "newton" else {}
    open_device, shipment = opened(device), shipped(method, mine, LANGUAGES[device[:6]], **knobs)
    camera = camera_for(View("example"), mine)
    assert (found["view"] == camera).all(), "the example looks from where the harness looks"
    program = shipment.checked
    launch = launch_camera(open_device, program, open_device.build(program), camera, 512)
    launch.run()
    t, answer = launch.read()
    assert (found["answer"] == answer).all() and (found["t"].view(np.uint32) == t.view(np.uint32)).all()
    assert (answer & 3 == RayStatus.HIT).mean() > 0.1
    launch.release()
    # The listed rays, whose answers the oracle judges, are the same but for the last bits of their directions.
    listed = cast(open_device, method, mine, "float32", rays_of(camera, 512), **knobs)
    same = (found["answer"] & 3) == listed.status
    assert same.mean() > 0.999
    assert np.nanquantile(np.abs(found["t"] - listed.t)[same], 0.99) < 1e-4 * mine.domain.radius

    hit = found["answer"] & 3 == RayStatus.HIT
    rays = rays_of(camera, 512).astype(np.float64)[hit]
    gradient = surfaces.gradient(mine, rays[:, :3] + found["t"][hit, None] * rays[:, 3:])
    cosines = np.einsum("ij,ij->i", found["normals"][hit], gradient) / np.linalg.norm(gradient, axis=1)
    assert np.quantile(cosines, 0.01) > 0.999
    assert not found["normals"][~hit].any()


@pytest.mark.one_in(2)
@pytest.mark.parametrize(("method", "place"), rotation(RAYS, PLACES))
def test_every_method_that_casts_rays_answers_as_its_checked_program(method, place):
    device, precision = opened(place[0]), place[1]
    surface = surfaces.get("torus")
    shipment = shipped(method, surface, device.language, precision)
    camera = camera_for(View("oblique", azimuth=50, elevation=20), surface)
    answers = [
        check(program, camera, 32).run(device, [device.build(program)])
        for check, program in ((DrawCheck, shipment.program), (CameraCheck, shipment.checked))
    ]
    assert (answers[0].status == RayStatus.HIT).sum() > 100
    for name, values in vars(answers[0]).items():
        assert np.array_equal(values, getattr(answers[1], name), equal_nan=name == "t"), name


@pytest.mark.one_in(2)
@pytest.mark.parametrize("language", ["glsl", "cl"])
@pytest.mark.parametrize("method", RAYS)
def test_no_function_is_unused_and_each_is_word_for_word_that_of_the_checked_program(method, language):
    for surface in (surfaces.get("torus"), surfaces.get("barth_sextic"), surfaces.from_formula("x^2 + y^2 + z^2 - 1")):
        try:
            shipment = shipped(method, surface, language)
        except FirsthitError:
            continue
        own = {s.origin: s.text for s in shipment.checked.sections}
        text = "\n".join(section.text for section in shipment.program.sections)
        bare = re.sub(r"//[^\n]*", "", text)
        defined = set(re.findall(r"(?m)^(?:__kernel )?\w+ (\w+)\([^;{]*\) \{", bare)) - {"draw", "main"}
        assert {"first_hit", "cast_ray", "surface_normal"} <= defined
        assert not {name for name in defined if len(re.findall(rf"\b{name}\b", bare)) < 2}
        for section in shipment.program.sections[:-1]:
            if "surface_normal" in section.origin or "surface_gradient" in section.origin:
                continue  # for shading alone
            for item in items_of(section.text):
                assert item.text.strip() in own[section.origin], (section.origin, item.names)


def test_the_head_says_what_the_program_is():
    torus = surfaces.get("torus")
    text = shipped("interval_march", torus, "glsl").text("the command")
    head = text[: text.index("#version")]
    assert all(line.startswith("//") for line in head.splitlines() if line)
    told = " ".join(line[2:].strip() for line in head.splitlines())
    for word in (
        "torus",
        "R = 0.7",
        "f(x, y, z) = (x^2 + y^2 + z^2 + 0.4)^2 - 1.96*(x^2 + y^2)",
        "the box from (-1, -1, -0.3) to (1, 1, 0.3)",
        "units",
        "the command",
        "MIT",
    ):
        assert word in told
    assert "no_missed_root: a ray that meets the surface is never answered as a miss" in re.sub(" +", " ", told)
    assert "no guarantee" in shipped("newton", torus, "glsl").text("")
    odd = dataclasses.replace(torus, title="two\nlines \\")
    assert all(not line.rstrip().endswith("\\") for line in shipped("newton", odd, "cl").text("").splitlines()[:20])


def test_the_examples_are_short_and_need_nothing_of_firsthit():
    for path in (ROOT / "harness/shipping/templates").glob("draw_*.py.txt"):
        text = path.read_text()
        assert len(text.splitlines()) < 60
        tree = ast.parse(re.sub(r"\$(\w+)", r"\1", text))
        named = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
        named |= {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
        assert named <= {"math", "sys", "pathlib", "numpy", "PIL", "moderngl", "pyopencl"}
    assert (ROOT / "harness/shipping/templates/license.txt").read_text() == (ROOT / "LICENSE").read_text()


def test_a_plugin_is_shipped_with_its_tables(tmp_path, capsys):
    folder = tmp_path / "plugins" / "mine"
    folder.mkdir(parents=True)
    (folder / "method.py").write_text(
        "from firsthit import Method\n"
        "METHOD = Method(name='mine', source='t', needs=('surface_value',),\n"
        "    tables=lambda surface, knobs, precision: {'PARTS': [0.25, 0.75], 'NOBODYS': [1.0]})\n"
    )
    (folder / "kernel.glsl").write_text(
        "/* a comment of two lines { that opens\n   what it never closes */\n"
        "real unused(real a) { return a; }\n\n"
        "// Asks f at two places.\nreal asked(Ray ray, real t) {\n    return surface_value(ray_point(ray, t));\n}\n\n"
        "Hit first_hit(Ray ray, real t0, real t1) {\n    Hit hit = no_hit(t1);\n    hit.evaluations = 2;\n"
        "    real a = asked(ray, t0 + PARTS[0] * (t1 - t0)), b = asked(ray, t0 + PARTS[1] * (t1 - t0));\n"
        "    if (a * b < 0.0) return hit_at(hit, t0 + 0.5 * (t1 - t0));\n    return hit;\n}\n"
    )
    if not usable_devices():
        pytest.skip("no device")
    command = ["--plugins", str(folder.parent), "kernel", *FORMULA, "--method", "mine", "-o", str(tmp_path / "made")]
    assert main([*command, "--device", usable_devices()[0].name]) == 0
    told = capsys.readouterr().out
    assert "all answered as by the program that firsthit checks" in told
    (program,) = (tmp_path / "made").glob("program.*")
    text = program.read_text()
    assert "PARTS" in text and "Asks f at two places." in text and "NOBODYS" not in text and "unused" not in text
    assert "the kernel of mine is its author's" in " ".join(text.replace("//", "").split())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--surface", "torus", "--method", "interval_uniform"), "casts the beams of a camera's pixels"),
        (("--surface", "torus", "--method", "polygon"), "draws triangles"),
        (("--surface", "torus", "--method", "null"), "there is nothing to ship"),
        (("--surface", "torus", "--method", "sphere_tracing", "--language", "wgsl"), "not written in WGSL"),
        (("--formula", "sin(x) + y", "--method", "sturm"), "sturm cannot draw formula here"),
        (("--formula", "sin(x) + y", "--method", "ray_march", "--precision", "float64"), "GLSL has no sin in float64"),
        (("--surface", "torus", "--method", "newton", "--knob", "EPSILO=1"), "did you mean 'EPSILON'"),
        (("--surface", "tours", "--method", "newton"), "did you mean torus"),
    ],
)
def test_what_cannot_be_shipped_is_refused_in_a_sentence(tmp_path, capsys, arguments, words):
    assert main(["kernel", *arguments, "-o", str(tmp_path / "made")]) == 2
    err = capsys.readouterr().err
    assert words in err and err.count("\n") == 1
    assert not (tmp_path / "made").exists()


def test_the_next_command_can_be_pasted_whatever_the_folder_is_called(tmp_path, capsys):
    folder = tmp_path / "two words"
    assert main(["kernel", "--surface", "torus", "--method", "newton", "-o", str(folder)]) == 0
    words = shlex.split(capsys.readouterr().out.splitlines()[-1])
    assert words == ["next:", "python", str(folder / "draw.py"), "surface.png"]


def test_tables_are_folded_and_nothing_else_is():
    shipment = shipped("lu_lipschitz", surfaces.get("barth_sextic"), "cl")
    text = shipment.text("firsthit kernel")
    assert all(len(line) <= 118 for line in text.splitlines() if line.startswith("TABLE "))
    folded = [line for line in text.splitlines() if line.startswith("TABLE ") and not line.endswith(";")]
    assert folded  # a table longer than a line
    assert "PRECISE keeps the compiler" in text
    squeezed = "".join(text.split())
    assert all("".join(section.text.split()) in squeezed for section in shipment.program.sections)


def test_all_files_are_written_or_none(tmp_path, capsys):
    (tmp_path / "README.txt").write_text("mine")
    assert main(["kernel", "--surface", "torus", "--method", "newton", "-o", str(tmp_path)]) == 2
    assert "README.txt is in" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["README.txt"]


def test_a_program_that_answers_otherwise_is_not_written(tmp_path, capsys, monkeypatch):
    if not usable_devices():
        pytest.skip("no device")
    checked = Shipment.checked
    loose = shipped("newton", surfaces.get("torus"), LANGUAGES[usable_devices()[0].name[:6]], EPSILON=0.01)
    monkeypatch.setattr(Shipment, "checked", property(lambda _: checked.fget(loose)))
    command = ["kernel", "--surface", "torus", "--method", "newton", "--device", usable_devices()[0].name]
    assert main([*command, "-o", str(tmp_path / "made")]) == 3
    assert "otherwise than the program that firsthit checks; nothing was written" in capsys.readouterr().err
    assert not (tmp_path / "made").exists()


def test_pruning_follows_names_and_keeps_what_it_cannot_name():
    text = (
        "#version 430\n#define USED 1\n#define UNUSED 2\n\n// Twice.\nreal twice(real a) {\n    return 2.0 * a;\n}\n"
        "real other(real a) { return a; }\nSTRUCT(Pair) struct Pair { real a; };\n"
        "STRUCT(Lone) struct Lone { int b; };\n"
        "#define LONG(a) \\\n    twice(a)\nTABLE real NODES[2] = real[2](0.0, 1.0);\n#pragma kept\n"
    )
    entry = Section("entry", "void main() { Pair p; p.a = LONG(USED); }")
    left, last = pruned([Section("lib", text)], [entry])
    assert last == entry
    assert re.findall(r"USED|twice|other|Pair|Lone|NODES|#version|#pragma|Twice", left.text) == [
        *("#version", "USED", "Twice", "twice", "Pair", "Pair", "twice", "#pragma")
    ]
    assert pruned([Section("lib", "real other(real a) { return a; }")], [entry]) == [entry]
