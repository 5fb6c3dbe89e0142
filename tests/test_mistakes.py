"""A mistake is said once: with its file and line, what to do, and the devices and surfaces it was met on."""

from __future__ import annotations

import io
import re
import time

import pytest

from harness import console
from harness.cli import main
from harness.contract import CellStatus, Program, Section
from harness.kernels.complaints import complaints_in, explained
from harness.running.failures import Failure, mistakes

from .conftest import usable_devices
from .test_conform_plugins import ILLINOIS

KERNEL = (
    "Hit first_hit(Ray ray, real t0, real t1) {\n    real a = t0\n    real b = surface_value(a);\n    return a;\n}\n"
)
AHEAD = Section("head.glsl", "#define real float\nstruct Hit { real t; };\n")
KNOBS = Section("generated: parameters of mine", "#define STEPS 200")
CALL = Section("cast.glsl", "void cast() {\n    hit = first_hit(own, t0, t1);\n}")


def _program(kernel: str = KERNEL) -> Program:
    return Program("cl", "float32", "rays", (AHEAD, KNOBS, Section("mine/kernel.glsl", kernel), CALL))


def _line(origin: str, line: int) -> int:
    """The line of the program's text that is `line` of a section."""
    program = _program()
    return next(n for n in range(1, 99) if program.locate(n) == (origin, line))


AT = _line("mine/kernel.glsl", 2)
INTEL = f"""clBuildProgram failed: BUILD_PROGRAM_FAILURE - clBuildProgram failed: BUILD_PROGRAM_FAILURE

Build on <pyopencl.Device 'AMD EPYC' on 'Intel(R) OpenCL' at 0x55d16441b2b8>:

Compilation started
1:{AT}:16: error: expected ';' at end of declaration
  {AT} |     real a = t0
      |                ^
      |                ;
1:{AT}:10: note: 'a' declared here
Compilation failed

(options: -cl-single-precision-constant -I /somewhere/pyopencl/cl)"""
POCL = f"""clBuildProgram failed: BUILD_PROGRAM_FAILURE

Build on <pyopencl.Device 'pthread' on 'Portable Computing Language' at 0x1>:

tempfile_1.cl:{AT}:16: expected ';' at end of declaration
Device pthread failed to build the program

(options: -I somewhere)"""
MESA = f"""GLSL Compiler failed

compute_shader
==============
0:{AT}(7): warning: `a' used uninitialized
0:{AT + 1}(2): error: syntax error, unexpected BASIC_TYPE_TOK, expecting ',' or ';'"""
NVIDIA = f"""GLSL Compiler failed

compute_shader
==============
0({AT + 1}) : error C0000: syntax error, unexpected reserved word "float"
0({AT + 1}) : warning C7050: "b" might be used before being initialized"""
NEEDS = 'add "surface_value" to needs in method.py'
TOLD = "mine/kernel.glsl:2:16: expected ';' at end of declaration\n    | real a = t0\n    |            ^"


@pytest.mark.parametrize(
    ("log", "told"),
    [
        (INTEL, TOLD),
        (POCL, TOLD),
        (MESA, "mine/kernel.glsl:3: syntax error, unexpected BASIC_TYPE_TOK, expecting ',' or ';'"),
        (NVIDIA, 'mine/kernel.glsl:3: syntax error, unexpected reserved word "float"'),
    ],
)
def test_of_a_log_the_errors_are_told_with_place_and_source_and_nothing_else(log, told):
    text = explained(_program(), log)
    assert told in text
    assert not re.search("Compil|Build|options|shader|warning|declared here", text)
    assert str(complaints_in(text)[0]) == text


def test_a_log_of_no_known_form_is_told_whole_but_for_drivers_talk():
    assert explained(_program(), "Compilation started\nout of registers\nCompilation failed") == "out of registers"


@pytest.mark.parametrize(
    ("kernel", "error", "place", "advice"),
    [
        (
            KERNEL,
            f"1:{AT + 1}:14: error: use of undeclared identifier 'surface_value'",
            3,
            'add "surface_value" to needs',
        ),
        (KERNEL, f"0:{AT + 1}(14): error: no function with name 'surface_value'", 3, NEEDS),
        (
            KERNEL.replace("surface_value(a)", "STEP"),
            f'0({AT + 1}) : error C1503: undefined variable "STEP"',
            3,
            "STEP is no knob of the method; did you mean 'STEPS'?",
        ),
        (
            KERNEL.replace("surface_value(a)", "interval_from_real(a)"),
            f"0:{AT + 1}(14): error: no function with name 'interval_sqrt'",
            3,
            'add "interval" to libraries',
        ),
        (
            KERNEL.replace("real b = surface_value(a)", "Interval b"),
            f"1:{AT + 1}:5: error: use of undeclared identifier 'Interval'",
            3,
            'add "interval" to libraries',
        ),
        (
            KERNEL.replace("surface_value", "f").replace("first_hit", "frist_hit"),
            f"1:{_line('cast.glsl', 2)}:11: error: use of undeclared identifier 'first_hit'",
            1,
            "define `Hit first_hit(Ray ray, real t0, real t1) { … }`",
        ),
        (
            KERNEL.replace("surface_value", "f").replace("real t0, real t1", "real t0"),
            f"1:{_line('cast.glsl', 2)}:11: error: too many arguments to function call, expected 2, have 3",
            1,
            "define it as `Hit first_hit(Ray ray, real t0, real t1)`",
        ),
        (
            KERNEL.replace("surface_value", "f").replace("}", "// }"),
            f"1:{_line('cast.glsl', 1)}:13: error: function definition is not allowed here",
            1,
            "write the missing '}'",
        ),
    ],
)
def test_what_to_do_is_said_at_the_line_of_the_kernel(kernel, error, place, advice):
    (told,) = complaints_in(explained(_program(kernel), error))
    assert (told.file, told.line) == ("mine/kernel.glsl", place)
    assert advice in told.advice


def _failures() -> list[Failure]:
    logs = {"opencl:intel": INTEL, "opencl:pocl": POCL, "opengl:llvmpipe": MESA}
    return [
        Failure("mine", f"{surface} {precision}", device, precision, surface, explained(_program(), log))
        for surface in ("sphere", "torus")
        for device, log in logs.items()
        for precision in ("float32", "float64")
    ]


def test_one_mistake_that_compilers_word_and_place_differently_is_one_paragraph():
    (told,) = mistakes(_failures(), "programs")
    assert told.startswith(TOLD)
    assert told.count("expected ';' at end of declaration") == 1
    assert "also   line 3, opengl:llvmpipe: syntax error" in told
    joined = " ".join(told.split())
    assert "where opencl:intel, opencl:pocl, opengl:llvmpipe; float32, float64; sphere, torus: 12 programs" in joined
    assert max(map(len, told.splitlines())) <= 100


def test_mistakes_of_two_methods_and_of_two_kinds_stay_apart():
    hung = [
        Failure("mine", p, d, p, "torus", "check took longer than 5 s; killed", CellStatus.TIMEOUT)
        for p in ("float32", "float64")
        for d in ("opencl:pocl", "opencl:intel")
    ]
    died = [Failure("mine", "a", "opencl:pocl", "float32", "torus", "the worker died: SIGSEGV", CellStatus.CRASHED)]
    other = [Failure("other", f.program, f.device, f.precision, f.surface, f.text) for f in _failures()]
    told = mistakes([*_failures()[:2], *hung, *died, *other, *_failures()[2:]], "cells")
    assert len(told) == 4
    assert told[1].startswith("mine/kernel.glsl: check took longer")
    assert "look for a loop" in told[1] and ": 4 cells" in told[1]
    assert "past its end" in told[2]


def test_reasons_that_differ_in_a_number_are_all_said():
    texts = [f"wrong on {share}% of the rays: not timed" for share in (61.3, 100.0)]
    (told,) = mistakes([Failure("mine", t, "opencl:pocl", "float32", "torus", t) for t in texts], "cells")
    assert all(text in told for text in texts)


def _plugin(tmp_path, old: str, new: str) -> list[str]:
    folder = tmp_path / "illinois"
    folder.mkdir()
    (folder / "method.py").write_text(ILLINOIS["method.py"])
    assert old in ILLINOIS["kernel.glsl"]
    (folder / "kernel.glsl").write_text(ILLINOIS["kernel.glsl"].replace(old, new, 1))
    return ["--plugins", str(tmp_path)]


MISTAKE = re.compile(r"illinois/kernel\.glsl:[56]\S*: ")  # the kernel begins with an empty line


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not usable_devices(), reason="no device")
@pytest.mark.parametrize("command", ["compile", "conform"])
def test_a_missing_semicolon_is_said_once_by_a_command(tmp_path, capfd, command):
    plugins = _plugin(tmp_path, "real a = t0;", "real a = t0")
    code = main([command, "--method", "illinois", "--surface", "sphere", *plugins])
    told = "".join(capfd.readouterr())
    assert code == {"compile": 3, "conform": 1}[command]
    assert len(MISTAKE.findall(told)) == 1
    assert all(info.name in told for info in usable_devices())
    assert not re.search("Compilation|Build on|errors? generated|options:|FAILS", told)


CONFIG = """title = "One mistake"
surfaces = ["sphere", "torus"]
sizes = [16]
precisions = ["float32", "float64"]
devices = ["any"]
[[method]]
name = "illinois"
[accuracy]
size = 16
"""


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not usable_devices(), reason="no device")
def test_the_rows_of_a_run_that_failed_are_told_together_at_its_end(tmp_path, capfd):
    plugins = _plugin(tmp_path, "real a = t0;", "real a = t0")
    (tmp_path / "one.toml").write_text(CONFIG)
    assert main(["run", str(tmp_path / "one.toml"), "--runs", str(tmp_path / "runs"), *plugins]) == 3
    err = capfd.readouterr().err
    assert len(MISTAKE.findall(err)) == 2, "once beside the first cell, once at the end"
    assert "sphere, torus: 4 cells" in err
    assert err.count("as above") == 3


def _working(monkeypatch, seconds: float, first: float) -> str:
    monkeypatch.setattr(console, "FIRST_SECONDS", first)
    monkeypatch.setattr("sys.stderr", written := io.StringIO())
    with console.Working() as tell:
        tell("compiling newton")
        time.sleep(seconds)
    return written.getvalue()


def test_what_goes_on_is_said_where_it_takes_long_even_within_one_step(monkeypatch):
    assert _working(monkeypatch, 0.5, 0.05) == "firsthit: compiling newton\n"


def test_what_is_done_at_once_says_nothing(monkeypatch):
    assert _working(monkeypatch, 0.0, 60.0) == ""
