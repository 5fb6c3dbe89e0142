"""A mistake is said once: with its file and line, what to do, and the devices and surfaces it was met on."""

from __future__ import annotations

import io
import re
import time
from pathlib import Path

import pytest

from harness import console, terminal
from harness.cli import main
from harness.contract import CellStatus, Program, Section
from harness.kernels.complaints import complaints_in, explained, recursion
from harness.kernels.sections import file_section
from harness.plugins import BUILT_IN
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


FAR = "1:{}:11: error: use of undeclared identifier 'first_hit'"


def test_a_comment_at_the_top_of_a_kernel_hides_nothing_from_the_advice():
    commented = "// a comment\n" + KERNEL.replace("a = t0", "a = t0;")
    (told,) = complaints_in(explained(_program(commented), f"0:{AT + 2}(14): error: no function with name 'x'"))
    assert NEEDS in told.advice
    (told,) = complaints_in(explained(_program(commented.replace("first_hit", "frist_hit")), FAR.format(99)))
    assert (told.line, told.words) == (2, "the kernel does not define first_hit; did you mean 'frist_hit'?")


def test_two_unknown_names_in_one_line_are_two_mistakes_and_both_are_told():
    kernel = KERNEL.replace("a = t0", "a = t2 + STEPZ;")
    log = "\n".join(
        f"1:{AT}:{column}: error: use of undeclared identifier '{name}'" for column, name in ((14, "t2"), (19, "STEPZ"))
    )
    text = explained(_program(kernel), log)
    assert [complaint.words.split()[-1] for complaint in complaints_in(text)] == ["'t2'", "'STEPZ'"]
    told = "\n".join(mistakes([Failure("mine", "a", "opencl:intel", "float32", "torus", text)], "programs"))
    assert "'t2'" in told and "also   line 2, opencl:intel: use of undeclared identifier 'STEPZ'" in told


@pytest.mark.parametrize(("word", "language"), [("half", "OpenCL C"), ("sample", "GLSL"), ("input", "GLSL")])
def test_a_word_that_one_language_keeps_for_itself_is_named(word, language):
    kernel = KERNEL.replace("real a = t0", f"real {word} = t0; // kernel").replace("surface_value", "f")
    (told,) = complaints_in(explained(_program(kernel), f"0:{AT}(7): error: syntax error, unexpected SAMPLE"))
    assert told.advice == f"use another word than {word}, which is a word of {language}"


def test_a_name_with_other_letters_than_those_of_ascii_is_named():
    kernel = KERNEL.replace("real a = t0", "real höhe = t0; // π").replace("surface_value", "f")
    (told,) = complaints_in(explained(_program(kernel), f"0:{AT}(7): error: syntax error, unexpected end of file"))
    assert "höhe" in told.advice and "ASCII" in told.advice


def test_of_a_very_long_line_the_part_around_the_caret_is_shown():
    kernel = KERNEL.replace("a = t0", f"a = {'1.0 + ' * 100}q{' + 1.0' * 100};")
    (told,) = complaints_in(explained(_program(kernel), f"1:{AT}:614: error: use of undeclared identifier 'q'"))
    text, caret = told.shown
    assert len(text) < 200 and text[len(caret) - 1] == "q"


STAGE = "void finish_tiles(Work work, Frame frame) {\n    real h = STEPZ;\n}\n"


def _staged(stage: str) -> Program:
    own = Section("mine/kernel.glsl", "real a() { return STEPS; }\n"), Section("mine/finish.glsl", stage)
    return Program("cl", "float32", "finish", (AHEAD, KNOBS, *own, Section("glsl/finish.cl", "\nfinish_tiles(w, f);")))


@pytest.mark.parametrize(
    ("stage", "line", "told", "advice"),
    [
        (STAGE, 10, "2", "did you mean 'STEPS'?"),
        (STAGE.replace("}", ""), 14, "1", "write the missing '}'"),
        (STAGE.replace("finish_", "finnish_"), 14, "1", "define `void finish_tiles(Work work, Frame frame) { … }`"),
    ],
)
def test_a_mistake_in_the_file_of_a_stage_is_told_there(stage, line, told, advice):
    error = f"1:{line}:5: error: use of undeclared identifier 'STEPZ'"
    (found,) = complaints_in(explained(_staged(stage), error))
    assert found.place.startswith(f"mine/finish.glsl:{told}") and advice in found.advice


def test_what_is_of_no_line_is_no_complaint_of_the_first_file():
    log = "1:0:0: error: function `first_hit' has static recursion"
    assert "prelude" not in explained(_program(), log) and "static recursion" in explained(_program(), log)


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("// f(1)\nreal f(real x) {\n    return f(x);\n}\n", 3, "f calls itself"),
        (
            "real g(real x);\nreal f(real x) { return g(x); }\nreal g(real x) { return f(x); }\n",
            2,
            "f calls itself, through g",
        ),
    ],
)
def test_a_function_that_calls_itself_is_told_before_a_compiler_dies_of_it(text, line, words):
    told = recursion(Section("mine/kernel.glsl", text))
    assert (told.line, told.words) == (line, words)


def test_no_kernel_of_ours_is_taken_for_one_that_calls_itself():
    kernels = list(BUILT_IN.glob("*/kernel.glsl"))
    assert len(kernels) > 10
    assert not [path for path in kernels if recursion(Section("kernel.glsl", path.read_text()))]
    assert not recursion(Section("kernel.glsl", "void f() {\n  if (a) {}\n  else if (b) {\n if (c) {} }\n}\n"))


def test_a_kernel_is_named_by_the_path_that_was_typed(tmp_path, monkeypatch):
    folder = tmp_path / "deep" / "er" / "own" / "mine"
    folder.mkdir(parents=True)
    (folder / "kernel.glsl").write_bytes(b"\xef\xbb\xbfvoid f() {}\r\n")
    monkeypatch.chdir(tmp_path)
    section = file_section(Path("deep/er/own/mine/kernel.glsl"))
    assert section == Section("deep/er/own/mine/kernel.glsl", "void f() {}\n"), "without the mark of byte order"


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
    build = Failure(
        "mine", "a", "opencl:pocl", "float32", "torus", "the worker died during build: x", CellStatus.CRASHED
    )
    assert "a function that calls itself" in " ".join(mistakes([build], "programs")[0].split())


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


@pytest.mark.usefixtures("devices_found_once", "few_degrees")
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
    monkeypatch.setattr(terminal, "FIRST_SECONDS", first)
    monkeypatch.setattr("sys.stderr", written := io.StringIO())
    with console.working() as tell:
        tell("compiling newton")
        time.sleep(seconds)
    return written.getvalue()


def test_what_goes_on_is_said_where_it_takes_long_even_within_one_step(monkeypatch):
    assert _working(monkeypatch, 0.5, 0.05) == "firsthit: compiling newton\n"


def test_what_is_done_at_once_says_nothing(monkeypatch):
    assert _working(monkeypatch, 0.0, 60.0) == ""


@pytest.mark.skipif(not usable_devices(), reason="no device")
def test_a_picture_that_cannot_be_drawn_tells_one_mistake_and_not_what_follows_from_it(tmp_path, capfd):
    plugins = _plugin(tmp_path, "real a = t0;", "real half = t0; real a = half;")
    device = next((info.name for info in usable_devices() if info.name.startswith("opencl:")), None)
    if device is None:
        pytest.skip("no OpenCL device")
    picture = ["show", "--surface", "sphere", "--size", "16", "-o", str(tmp_path / "x.png")]
    assert main([*picture, "--method", "illinois", "--device", device, *plugins]) == 3
    err = capfd.readouterr().err
    assert len(re.findall(r"illinois/kernel\.glsl:\d", err)) == 1 and "a word of OpenCL C" in err


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not usable_devices(), reason="no device")
def test_what_is_not_blessed_is_told_by_its_first_line(tmp_path, capfd):
    plugins = _plugin(tmp_path, "real a = t0;", "real a = t0")
    (tmp_path / "one.toml").write_text(CONFIG)
    runs = ["--runs", str(tmp_path / "runs"), "--baseline", str(tmp_path / "b.toml"), "--reason", "first"]
    assert main(["bless", str(tmp_path / "one.toml"), *runs, *plugins]) == 3
    last = capfd.readouterr().err.splitlines()[-1]
    assert last.startswith("firsthit: not blessed: 4 cells did not finish, first illinois")
