"""A loop that does not end is told where the compiler would remove it, and its kernel is never timed."""

from __future__ import annotations

import json

import numpy as np
import pytest

import surfaces
from harness import ROOT
from harness.accuracy.freeloops import removed
from harness.cli import main
from harness.conformance.cases import view_case
from harness.conformance.checks import agreement
from harness.contract import Hits, Method, Program, RayStatus, Variant, View, digest
from harness.devices.interface import BuildError, hits_from, launch_rays
from harness.kernels.assemble import method_program
from harness.kernels.raster import raster_program
from harness.kernels.sections import kept_loops, with_free_loops
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, meets, rays_of

from .conftest import opened, usable_devices
from .test_conform_plugins import _example

NAME = "opengl:llvmpipe"
pytestmark = [
    pytest.mark.skipif(NAME not in [info.name for info in usable_devices()], reason="no llvmpipe"),
    pytest.mark.usefixtures("devices_found_once"),
]
VIEW = View("oblique", azimuth=30, elevation=35)
VALUE = "surface_value_along(along, t1)"
BEHIND = f"for (;;) {{ if ({VALUE} == 12345.0) break; }}"
FRONT = "real q = t0; while (q < t1 + 1.0) { q = q + 0.0 * surface_value_along(along, q); }"
LOOPS = {
    "for": BEHIND,
    "while": FRONT,
    "do": "real q = t0; do { q = q + 0.0 * surface_value_along(along, q); } while (q < t1 + 1.0);",
    "without a condition": "for (;;) { }",
    "without an end": "for (int i = 0; ; ) i = 1 - i;",
    "always true": "while (true) hit.evaluations = 7;",
    "nested": f"for (int i = 0; i < 9; i++) {{ for (int j = 0; j < 9; j++) {{ while ({VALUE} != 12345.0) {{ }} }} }}",
    "continue": f"for (int i = 0; i < 9; ) {{ if ({VALUE} != 12345.0) continue; i++; }}",
    "helper": "spin(along, t1);",
    "array": "real a[4]; for (int k = 0; k < 4; ) { a[k] = t0; k = (k + 1) & 3; }",
    "macro": f"SPIN {{ if ({VALUE} == 12345.0) break; }}",
}
HELPERS = """#define SPIN for (;;)
void spin(Along along, real t) {
    for (;;) { if (surface_value_along(along, t) == 12345.0) return; }
}
"""
FAULT = "rays the kernel ends only because this device's compiler removes a loop"


def _kernel(behind: str = "", front: str = "") -> str:
    """The example of docs/methods.md with statements in front of its march and behind it."""
    text = HELPERS + _example()["kernel.glsl"]
    head, _, tail = text.rpartition("return hit;")
    text = f"{head}{behind} return hit;{tail}"
    along = "Along along = surface_along(ray);"
    assert text.count(along) == 1
    return text.replace(along, f"{along} {front}")


def _program(folder, kernel: str) -> Program:
    folder = folder / digest(kernel)
    folder.mkdir()
    (folder / "kernel.glsl").write_text(kernel)
    method = Method(name="mine", source="test", needs=("surface_along", "surface_value_along"))
    return method_program(
        method, folder, Variant("mine", (("STEPS", 200),)), surfaces.get("torus"), "float32", "glsl", "rays"
    )


def _cast(program: Program, size: int = 24, surface: str = "torus") -> Hits:
    device = opened(NAME)
    launch = launch_rays(device, program, device.build(program), _rays(size, surface))
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


def _rays(size: int, surface: str = "torus"):
    return rays_of(camera_for(VIEW, surfaces.get(surface)), size)


@pytest.mark.parametrize("kind", LOOPS)
def test_rays_behind_an_endless_loop_are_exhausted(tmp_path, kind):
    hits = _cast(_program(tmp_path, _kernel(LOOPS[kind])))
    inside = meets(surfaces.get("torus").domain, _rays(24))
    assert RayStatus.MISS not in hits.status[inside]
    assert (hits.status[inside] == RayStatus.EXHAUSTED).mean() > 0.25


def test_an_endless_loop_in_front_of_the_march_exhausts_every_ray(tmp_path):
    hits = _cast(_program(tmp_path, _kernel(front=FRONT)))
    assert (hits.status[meets(surfaces.get("torus").domain, _rays(24))] == RayStatus.EXHAUSTED).all()


@pytest.mark.parametrize("name", ["newton", "bernstein", "ray_march", "lu_lipschitz"])
def test_keeping_loops_changes_no_bit_of_an_answer(name):
    plugin = find_methods().get(name)
    program = method_program(
        plugin.method, plugin.folder, plugin.variant({}), surfaces.get("barth_sextic"), "float32", "glsl", "rays"
    )
    kept, free = (_cast(p, surface="barth_sextic") for p in (program, with_free_loops(program)))
    assert RayStatus.HIT in kept.status
    for name_of, values in vars(kept).items():
        np.testing.assert_array_equal(values, getattr(free, name_of))


def test_an_else_behind_a_loop_stays_with_its_own_if(tmp_path):
    front = "real q = 0.0; if (t0 > 1.0e9) for (int i = 0; i < 2; i++) q = 1.0; else q = 2.0;"
    front += " int n = 0; do n++; while (n < 3 || n == 3); if (q == 2.0 && n == 4) return hit_at(hit, t1);"
    hits = _cast(_program(tmp_path, _kernel(front=front)))
    assert (hits.status[meets(surfaces.get("torus").domain, _rays(24))] == RayStatus.HIT).all()


def test_a_loop_with_two_counters_is_refused_with_its_line_and_the_rule(tmp_path):
    program = _program(tmp_path, _kernel("for (int i = 0, j = 0; i < 3; i++) j += i;"))
    with pytest.raises(BuildError, match=r"kernel\.glsl:\d+(.|\n)*no comma outside brackets"):
        opened(NAME).build(program)


def test_only_programs_that_are_checked_keep_their_loops():
    plugin, surface = find_methods().get("newton"), surfaces.get("torus")
    common = (plugin.method, plugin.folder, plugin.variant({}), surface)
    assert kept_loops() in method_program(*common, "float32", "glsl", "rays").sections
    assert kept_loops() not in method_program(*common, "float32", "glsl", "camera").sections
    assert kept_loops() in raster_program(*common, "box", True).sections
    assert kept_loops() not in raster_program(*common, "box", False).sections
    for entry in ("rays", "camera"):
        program = method_program(*common, "float32", "cl", entry)
        assert with_free_loops(program) == program


def test_rays_that_are_given_up_either_way_are_no_fault():
    program = Program("glsl", "float32", "rays", (kept_loops(),))

    def hits(*status: RayStatus) -> Hits:
        return Hits(np.full(50, np.nan), np.resize(np.uint8(status), 50), np.ones(50, np.int32))

    given_up, half = hits(RayStatus.EXHAUSTED), hits(RayStatus.EXHAUSTED, RayStatus.MISS)
    assert removed([program], given_up, lambda: given_up) is None
    assert removed([with_free_loops(program)], given_up, lambda: half) is None
    assert FAULT in (removed([program], given_up, lambda: half) or "")


def test_conform_says_what_exhausts_rays():
    case = view_case(surfaces.get("torus"))
    hits = Hits(
        np.full(len(case.rays), np.nan), np.full(len(case.rays), 2, np.uint8), np.ones(len(case.rays), np.int32)
    )
    told = next(finding for finding in agreement(hits, case, "float32") if finding.fails)
    assert "look for a loop that does not end" in told.advice


# Commands

CONFIG = """title = "t"
surfaces = ["torus"]
sizes = [16]
devices = ["opengl:llvmpipe"]
precisions = ["float32"]
stages = {stages}
{methods}
[accuracy]
size = 16
[budget]
seconds = 0.05
"""


def _plugin(folder, name: str, kernel: str) -> None:
    (folder / name).mkdir(parents=True)
    (folder / name / "method.py").write_text(_example()["method.py"].replace('"mine"', f'"{name}"'))
    (folder / name / "kernel.glsl").write_text(kernel)


def _config(folder, stages: list[str], *methods: str):
    path = folder / "t.toml"
    named = "".join(f'[[method]]\nname = "{name}"\n' for name in methods)
    path.write_text(CONFIG.format(stages=json.dumps(stages), methods=named))
    return path


def _rows(runs) -> list[dict]:
    return [json.loads(path.read_text()) for path in sorted(runs.glob("*/cells/*.json"))]


def _need_untimed(row: dict) -> None:
    assert (row["status"], row["time"]) == ("failed", None), row["method"]
    assert FAULT in row["reason"]
    assert row["accuracy"]["exhausted"] > 0


def test_run_times_no_kernel_whose_endless_loop_the_compiler_removes(tmp_path):
    plugins, runs = tmp_path / "plugins", tmp_path / "runs"
    for name, kernel in {"good": _kernel(), "behind": _kernel(BEHIND), "front": _kernel(front=FRONT)}.items():
        _plugin(plugins, name, kernel)
    path = _config(tmp_path, ["compute", "rays", "raster"], "good", "behind", "front")
    assert main(["--plugins", str(plugins), "run", str(path), "--runs", str(runs)]) == 3
    found = _rows(runs)
    assert len(found) == 9
    for row in found:
        if row["method"] == "good":
            assert row["status"] == "ok"
        else:
            _need_untimed(row)


@pytest.mark.parametrize("source", ["interval_uniform", "interval_adaptive"])
def test_run_times_no_beams_whose_endless_loop_the_compiler_removes(tmp_path, source):
    plugins, runs = tmp_path / "plugins", tmp_path / "runs"
    (plugins / "beams").mkdir(parents=True)
    texts = {name: (ROOT / "methods" / source / name).read_text() for name in ("method.py", "kernel.glsl")}
    head, paint, tail = texts["kernel.glsl"].rpartition("paint(work, cell, hit);")
    loop = "if (hit.status == MISS) { for (;;) { if (beam.far * 2.0 == 12345.0) break; } } "
    (plugins / "beams" / "method.py").write_text(texts["method.py"].replace(f'"{source}"', '"beams"'))
    (plugins / "beams" / "kernel.glsl").write_text(head + loop + paint + tail)
    path = _config(tmp_path, ["compute"], "beams")
    assert main(["--plugins", str(plugins), "run", str(path), "--runs", str(runs)]) == 3
    (row,) = _rows(runs)
    _need_untimed(row)


def test_gate_and_trace_tell_of_the_loop(tmp_path, capsys):
    plugins, runs = tmp_path / "plugins", tmp_path / "runs"
    _plugin(plugins, "mine", _kernel())
    path = _config(tmp_path, ["compute"], "mine")
    at = ["--plugins", str(plugins)]
    assert main([*at, "bless", str(path), "--runs", str(runs), "--reason", "first"]) == 0
    again = tmp_path / "again"  # what was read of a path once is kept
    _plugin(again, "mine", _kernel(BEHIND))
    at = ["--plugins", str(again)]
    assert main([*at, "gate", str(path), "--runs", str(runs)]) == 1
    assert FAULT in capsys.readouterr().out
    np.save(tmp_path / "rays.npy", _rays(16))
    traced = ["--surface", "torus", "--method", "mine", "--device", NAME, "--rays", str(tmp_path / "rays.npy")]
    assert main([*at, "trace", *traced, "-o", str(tmp_path / "hits.npz")]) == 0
    assert (np.load(tmp_path / "hits.npz")["status"] == RayStatus.EXHAUSTED).sum() > 50
