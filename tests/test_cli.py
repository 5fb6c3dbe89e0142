"""What a person types, and what comes back when it is wrong: one line that says what to do, no half-written file."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from harness.cli import build_parser, main

from .conftest import usable_devices

pytestmark = pytest.mark.usefixtures("devices_found_once")

COMMANDS = ("devices", "list", "plan", "run", "why", "report", "show", "sheet", "trace", "oracle", "compile")
COMMANDS += ("gate", "bless", "history", "recommend", "kernel", "publish")


@pytest.fixture
def rays(tmp_path):
    path = tmp_path / "rays.npy"
    directions = np.array([[0, 0, -1], [0, 0.6, -0.8], [0, 0, 1]], np.float32)
    np.save(path, np.hstack([np.tile(np.float32([0, 0, 5]), (3, 1)), directions]))
    return path


def told(capsys, *arguments):
    code = main([str(a) for a in arguments])
    captured = capsys.readouterr()
    assert "Traceback" not in captured.err
    return code, captured.out, captured.err


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself_with_an_example(command, capsys):
    with pytest.raises(SystemExit) as caught:
        build_parser().parse_args([command, "--help"])
    assert caught.value.code == 0
    assert f"example: firsthit {command}" in capsys.readouterr().out


LEAST = {  # what a command cannot be parsed without
    "list": ["methods"],
    "report": ["runs/quick"],
    "publish": ["runs/quick", "-o", "x"],
    "show": ["--surface", "torus", "--method", "newton", "-o", "x.png"],
    "sheet": ["--method", "newton", "-o", "x.png"],
    "trace": ["--surface", "torus", "--method", "newton", "--rays", "r.npy", "-o", "x.npz"],
    "oracle": ["--surface", "torus", "--rays", "r.npy", "-o", "x.npz"],
    "bless": ["quick", "--reason", "r"],
    "recommend": ["--surface", "torus", "--error", "1"],
    "kernel": ["--surface", "torus", "--method", "newton", "-o", "x"],
    "history": ["quick"],
    "new": ["method", "mine"],
    "worker": ["lab1:8786"],
}


@pytest.mark.parametrize("command", [*COMMANDS, "conform"])
def test_plugins_stand_before_or_after_every_command_and_the_last_ones_count(command):
    words = [command, *LEAST.get(command, ["quick"] if command in ("plan", "run", "gate", "why") else [])]
    for line, found in (
        (words, None),
        (["--plugins", "a", *words], "a"),
        ([*words, "--plugins", "b"], "b"),
        (["--plugins", "a", *words, "--plugins", "b"], "b"),
    ):
        assert build_parser().parse_args(line).plugins == (None if found is None else Path(found))


def test_usage_mistakes_exit_with_2():
    with pytest.raises(SystemExit) as caught:
        main(["nonesuch"])
    assert caught.value.code == 2


def test_trace_and_oracle_agree_and_write_what_they_promise(tmp_path, capsys, rays):
    hits, truth = tmp_path / "hits.npz", tmp_path / "truth.npz"
    code, _, _ = told(capsys, "trace", "--surface", "sphere", "--method", "newton", "--rays", rays, "-o", hits)
    assert code == 0
    assert told(capsys, "oracle", "--surface", "sphere", "--rays", rays, "-o", truth)[0] == 0
    h, t = np.load(hits), np.load(truth)
    assert (h["t"].dtype, h["status"].dtype, h["evaluations"].dtype) == (np.float64, np.uint8, np.int32)
    assert (t["lower"].dtype, t["upper"].dtype, t["status"].dtype) == (np.float64, np.float64, np.uint8)
    assert h["status"].tolist() == [1, 0, 0]
    assert t["status"].tolist() == [1, 0, 0]
    assert t["lower"][0] <= 4.0 <= t["upper"][0]
    assert abs(h["t"][0] - 4.0) < 1e-5
    assert np.isnan(h["t"][1:]).all()


def test_a_formula_goes_wherever_a_surface_does(tmp_path, capsys, rays):
    output = tmp_path / "truth.npz"
    code, out, _ = told(
        capsys, "oracle", "--formula", "x^2 + y^2 + z^2 - a", "--parameter", "a=0.25", "--rays", rays, "-o", output
    )
    assert code == 0
    assert "1 crossing" in out
    truth = np.load(output)
    assert truth["lower"][0] <= 4.5 <= truth["upper"][0]


def _bad_rays(tmp_path, name):
    good = np.array([[0, 0, 5, 0, 0, -1]], np.float32)
    bad = {
        "empty": np.zeros((0, 6), np.float32),
        "shape": np.zeros((4, 3), np.float32),
        "float64": good.astype(np.float64),
        "nan": np.where(np.arange(6) == 2, np.nan, good).astype(np.float32),
        "zero": np.zeros((1, 6), np.float32),
        "long": good * 2,
    }
    path = tmp_path / "bad.npy"
    if name == "text":
        path.write_text("1 2 3")
    elif name == "truncated":
        np.save(path, np.tile(good, (100, 1)))
        path.write_bytes(path.read_bytes()[:200])
    elif name != "missing":
        np.save(path, bad[name])
    return path


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("empty", "no rays"),
        ("shape", "[n, 6]"),
        ("float64", "make them float32"),
        ("nan", "row 0"),
        ("zero", "length 0"),
        ("long", "length 2"),
        ("text", "not a .npy file"),
        ("truncated", "not a .npy file"),
        ("missing", "cannot read"),
    ],
)
@pytest.mark.parametrize("command", ["trace", "oracle"])
def test_bad_rays_are_one_line_and_leave_no_file(tmp_path, capsys, name, words, command):
    output = tmp_path / "out.npz"
    method = ["--method", "newton"] if command == "trace" else []
    path = _bad_rays(tmp_path, name)
    code, _, err = told(capsys, command, "--surface", "sphere", *method, "--rays", path, "-o", output)
    assert code == 2
    assert words in err
    assert err.count("\n") == 1
    assert not output.exists()


@pytest.mark.parametrize(
    ("changed", "code", "words"),
    [
        ({"--surface": "spere"}, 2, "did you mean sphere"),
        ({"--surface": ""}, 2, "there is no surface ''"),
        ({"--method": "newtn"}, 2, "did you mean 'newton'"),
        ({"--device": "opencl:none"}, 3, "there is no device 'opencl:none'"),
        ({"--device": "none"}, 3, "there is no device 'none' here; known: open"),
        ({"--device": ""}, 3, "there is no device '' here; known: open"),
        ({"--knob": "EPSILN=1"}, 2, "did you mean 'EPSILON'"),
        ({"--knob": "EPSILON"}, 2, "NAME=VALUE"),
        ({"--knob": "EPSILON=big"}, 2, "not a number"),
        ({"--knob": "EPSILON=nan"}, 2, "EPSILON is a finite number, not nan"),
        ({"--knob": "MAX_EVALUATIONS=-inf"}, 2, "MAX_EVALUATIONS is a finite number, not -inf"),
        ({"--knob": "MAX_EVALUATIONS=1.5"}, 2, "whole number"),
        ({"--parameter": "q=1"}, 2, "no parameter 'q'"),
        ({"-o": "no/such/folder/out.npz"}, 2, "no such folder"),
        ({"-o": "/proc/out.npz"}, 3, "cannot write"),
    ],
)
def test_bad_options_are_one_line(tmp_path, capsys, rays, changed, code, words):
    options = {"--surface": "sphere", "--method": "newton", "--rays": rays, "-o": tmp_path / "out.npz"} | changed
    got, _, err = told(capsys, "trace", *[word for pair in options.items() for word in pair])
    assert got == code
    assert words in err
    assert err.count("\n") == 1
    assert not (tmp_path / "out.npz").exists()


@pytest.mark.parametrize(
    ("command", "words"),
    [("run", "did you mean 'quick'"), ("plan", "did you mean 'quick'"), ("gate", "did you mean 'quick'")],
)
def test_a_configs_name_that_is_none_is_one_line_with_the_nearest(capsys, command, words):
    code, _, err = told(capsys, command, "quik")
    assert code == 2
    assert words in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--view", "up"), "azimuth,elevation"),
        (("--view", "nan,0"), "azimuth: nan is outside"),
    ],
)
def test_show_refuses_what_is_no_picture(tmp_path, capsys, arguments, words):
    code, _, err = told(
        capsys, "show", "--surface", "sphere", "--method", "newton", "-o", tmp_path / "a.png", *arguments
    )
    assert code == 2
    assert words in err


TRACE = ("trace", "--surface", "sphere", "--method", "newton", "--rays", "none.npy", "-o", "none.npz")
ORACLE = ("oracle", "--surface", "sphere", "--rays", "none.npy", "-o", "none.npz")
SHOW = ("show", "--surface", "sphere", "--method", "newton", "-o", "none.png")
SHEET = ("sheet", "--method", "newton", "-o", "none.png")
SCENE = ("scene", "pipes", "--method", "newton", "-o", "none.png")
RECOMMEND = ("recommend", "--surface", "sphere", "--error", "1")
KERNEL = ("kernel", "--surface", "sphere", "--method", "newton", "-o", "none")
NUMBERS = {
    TRACE: ("--timeout", "--t-min"),
    ORACLE: ("--t-min", "--jobs"),
    SHOW: ("--timeout", "--size", "--fov"),
    SHEET: ("--timeout", "--size", "--columns"),
    SCENE: ("--timeout", "--size"),
    ("conform",): ("--timeout", "--jobs"),
    ("run", "none"): ("--jobs",),
    ("gate", "none"): ("--jobs",),
    ("bless", "none"): ("--jobs",),
    ("compile",): ("--timeout",),
    KERNEL: ("--timeout",),
    ("verify", "none"): ("--sample", "--seed", "--jobs"),
    ("worker", "lab1:8786"): ("--cores",),
    RECOMMEND: ("--error", "--fps", "--size", "--views", "--rays", "--seconds", "--seed", "--jobs"),
}
LISTS = {("report", "--figures"), ("report", "--tables")}  # of names: test_for_papers holds them against the known ones
NAMES = {("run", "--machine")}  # test_merge_commands
MAY_BE_NOTHING = ("--cores", "--t-min", "--fps", "--seconds", "--seed", "--sample")


def test_every_option_that_is_a_number_is_held_against_its_limits():
    parsers = build_parser()._subparsers._group_actions[0].choices
    read = {
        (name, option.option_strings[0])
        for name, parser in parsers.items()
        for option in parser._actions
        if option.type not in (None, Path)
    }
    assert read - LISTS - NAMES == {(command[0], option) for command, options in NUMBERS.items() for option in options}
    assert read >= LISTS


@pytest.mark.parametrize(
    ("command", "option"), [(command, option) for command, options in NUMBERS.items() for option in options]
)
def test_numbers_out_of_range_are_refused_before_anything_is_done(command, option, capsys):
    for text in ("nan", "inf", "-1", "1e400", "much", *(() if option in MAY_BE_NOTHING else ("0",))):
        with pytest.raises(SystemExit) as caught:
            main([*command, f"{option}={text}"])
        assert caught.value.code == 2
        err = capsys.readouterr().err
        assert f"error: argument {option}: " in err and "Traceback" not in err


def test_show_draws_the_sphere_in_the_middle(tmp_path, capsys):
    from PIL import Image

    output = tmp_path / "a.png"
    code, out, _ = told(capsys, "show", "--surface", "sphere", "--method", "newton", "--size", "64", "-o", output)
    assert code == 0
    picture = np.asarray(Image.open(output))
    assert picture.shape == (64, 64, 3)
    assert (picture[0, 0] == 255).all()
    assert picture[32, 32, 2] > picture[32, 32, 0]
    assert "0 exhausted" in out


def test_show_tells_how_a_formula_was_read(tmp_path, capsys):
    written = ("--formula", "x^2 + e y² + z^2 = a", "--parameter", "a=1/3", "--parameter", "e=sqrt(2)")
    show = ("show", *written, "--method", "newton", "--size", "16", "-o", tmp_path / "a.png")
    code, out, _ = told(capsys, *show)
    assert code == 0
    assert "read as: x^2 + sqrt(2)*y^2 + z^2 - 1/3\nnote: e is your parameter, not Euler's number\n" in out
    refused = (("a=2", "'a' is given twice"), ("b=2", "no 'b' occurs in the formula; its parameters are a, e"))
    for more, words in refused:
        code, _, err = told(capsys, *show, "--parameter", more)
        assert code == 2 and words in err


@pytest.mark.parametrize("what", ["methods", "surfaces", "configs", "devices"])
def test_lists_name_what_is_there(capsys, what):
    code, out, _ = told(capsys, "list", what)
    assert code == 0
    expected = {"methods": "newton", "surfaces": "barth_sextic", "configs": "quick "}
    assert expected.get(what, usable_devices()[0].name) in out


def test_plan_prints_cells_and_an_estimate_and_runs_nothing(tmp_path, capsys):
    code, out, _ = told(capsys, "plan", "newton-steps", "--runs", tmp_path)  # a config of the package, by its name
    assert code == 0
    assert "to run" in out
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "arguments", [("run", "none.toml"), ("plan", "none.toml"), ("report", "none"), ("why", "none")]
)
def test_what_is_not_there_is_one_line(capsys, arguments):
    code, _, err = told(capsys, *arguments)
    assert code == 2
    assert err.count("\n") == 1


def test_a_run_on_a_device_that_is_not_here_is_one_line(tmp_path, capsys):
    code, _, err = told(capsys, "run", "configs/quick.toml", "--runs", tmp_path, "--device", "opencl:none")
    assert code == 3
    assert "there is no device 'opencl:none' here; known: " in err
    assert all(info.name in err for info in usable_devices() if info.name.startswith("opencl:"))
    assert not list(tmp_path.iterdir())


def test_a_run_folder_that_cannot_be_written_is_one_line(tmp_path, capsys):
    (tmp_path / "runs").write_text("in the way")
    code, _, err = told(capsys, "run", "configs/quick.toml", "--runs", tmp_path / "runs")
    assert code == 3
    assert "cannot write" in err


def test_compile_reports_a_broken_plugin_with_its_line(tmp_path, capsys):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "method.py").write_text('from harness.contract import Method\nMETHOD = Method(name="mine", source="t")\n')
    (folder / "kernel.glsl").write_text("Hit first_hit(Ray ray, real t0, real t1) {\n    return wrong;\n}\n")
    code, out, err = told(capsys, "--plugins", tmp_path, "compile", "--method", "mine", "--surface", "sphere")
    assert code == 3
    assert "mine/kernel.glsl:2" in err
    assert "failed" in out


def test_compile_is_on_the_devices_that_are_named(capsys):
    name = usable_devices()[0].name
    code, out, _ = told(capsys, "compile", "--method", "ray_march", "--surface", "sphere", "--device", name)
    assert code == 0 and "programs compiled on 1 device, 0 failed" in out
    assert [line.partition(": ")[0] for line in out.splitlines()[:-1]] == [name]
    assert told(capsys, "compile", "--method", "ray_march", "--device", "opencl:none")[0] == 3


def test_devices_that_compile_at_once_compile_what_they_compile_in_turns(capsys):
    asked = ("compile", "--method", "null", "--surface", "sphere")
    turns, once = (told(capsys, *asked, *more) for more in ((), ("--together",)))
    assert turns[0] == once[0] == 0
    counted = [re.findall(r"^(\S+): (\d+) program", out, re.MULTILINE) for _, out, _ in (turns, once)]
    assert counted[0] == counted[1] != []


def test_a_plugin_that_cannot_be_imported_costs_only_itself(tmp_path, capsys):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "method.py").write_text("import nonesuch\n")
    (folder / "kernel.glsl").write_text("")
    code, out, _ = told(capsys, "--plugins", tmp_path, "list", "methods")
    assert code == 0
    assert "mine: cannot be loaded" in out
    assert "newton" in out


def test_the_command_is_installed():
    result = subprocess.run(
        [sys.executable, "-m", "harness.cli", "--version"], capture_output=True, text=True, check=True
    )
    assert result.stdout.startswith("firsthit 0.")


@pytest.mark.parametrize("name", ["/", ".", "..", ""])
def test_a_config_that_is_no_file_is_a_sentence(name, capsys):
    assert main(["plan", name]) == 2
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize("command", [["gate"], ["bless", "--reason", "r"], ["gate", "--against", "HEAD"]])
def test_a_gate_of_a_config_that_only_includes_others_is_refused_with_its_line(command, tmp_path, capsys):
    (tmp_path / "part.toml").write_text('title = "p"\nsurfaces = ["torus"]\n[[method]]\nname = "newton"\n')
    (tmp_path / "whole.toml").write_text('title = "w"\ninclude = ["part.toml"]\n')
    (tmp_path / "baselines").mkdir()
    (tmp_path / "baselines" / "whole.toml").write_text('format = 2\nconfig = "whole"\n')
    assert main([*command, str(tmp_path / "whole.toml")]) == 2
    err = capsys.readouterr().err
    assert "whole.toml:2: include" in err and "part.toml" in err, err
