"""What goes on fits the terminal, whatever its width, and nothing of it stays; what stays is a line each."""

import io
import json
import re
import sys
import time

import pytest

from harness import cli, console, terminal
from harness.terminal import SCREEN, cut, fitting, size, width

from .conftest import usable_devices
from .synthetic_run import write_run
from .terminals import play, shown

LONG = "newton[EPSILON=0.001,MAX_EVALUATIONS=200,STEP_BOUND=0.15] barth_sextic oblique 512x512x1 float32 compute"
NAMES = (LONG, "曲面法 トーラス 正面 64x64x1 float32 compute", "e\u0301toile\u0301 sphere 64x64x1 float32 compute")
RUN = """
import fcntl, struct, sys, termios, time
from harness import console, terminal
from harness.terminal import SCREEN
terminal.LIVE_SECONDS = 0.04
names, resized = {names!r}, {resized!r}
devices = {{"opencl:intel": 3, "opengl:llvmpipe": 3}}
with console.doing("preparing devices and cells, which is a line of more than sixty characters") as tell:
    for i in range(3):
        tell("preparing [%d/3] %s" % (i, names[0]))
        time.sleep(0.05)
progress = console.Progress(6, 10.0, devices)
for i, name in enumerate(names):
    for device in devices:
        progress(name + " " + device, None)
        time.sleep(0.05)
        if resized and i == 1:
            fcntl.ioctl(2, termios.TIOCSWINSZ, struct.pack("HHHH", 24, resized, 0, 0))
            sys.stderr.write("\\x1b]2;columns=%d\\x07" % resized)
            sys.stderr.flush()
            time.sleep(0.05)
        time.sleep({sleeps!r})
        row = {{"status": "failed", "reason": "no\\nway", "time": None}} if i == 2 else {{
            "status": "ok", "reason": None, "time": {{"median_ms": 1.5, "warnings": ["noisy: very", "drifts: far"]}}}}
        progress(name + " " + device, row)
print("done")
"""
ENDS = ["opencl:intel: 1.5 ms, noisy, drifts", "opengl:llvmpipe: 1.5 ms, noisy, drifts"]
ENDS = [*ENDS, *ENDS, "opencl:intel: failed: no", "opengl:llvmpipe: failed, as above", "done"]


def script(resized=0, sleeps=0.0):
    return ["-c", RUN.format(names=NAMES, resized=resized, sleeps=sleeps)]


def held(lines, columns):
    """Hold that each finished cell has one line, of these columns at most, and that nothing else is left."""
    assert len(lines) == len(ENDS), lines
    for number, (line, end) in enumerate(zip(lines, ENDS, strict=True), 1):
        assert line.endswith(end) and width(line) < columns, line
        assert line.startswith("done" if end == "done" else f"[{number}/6]")


@pytest.mark.parametrize("columns", [60, 80, 120, 200])
def test_nothing_is_left_of_live_lines_at_any_width(columns):
    played = play(script(), columns)
    held(played.lines, columns)
    assert played.code == 0 and played.raw.count(terminal.CLEAR.encode()) > 8, "it was live"


@pytest.mark.parametrize("emulated", [60, 80])
def test_nothing_is_left_where_the_width_is_not_known(emulated):
    lines = play(script(), 0, emulated=emulated).lines
    assert not any(line.startswith(("firsthit:", "  opencl:", "  opengl:")) for line in lines), lines
    if emulated == 80:
        held(lines, 80)


def test_the_terminal_is_asked_that_is_written_to():
    played = play(script(), 60, piped=True)
    assert played.out == "done\n"
    held([*played.lines, "done"], 60)


@pytest.mark.parametrize(("columns", "resized"), [(120, 60), (60, 120)])
def test_nothing_is_left_where_the_width_changes(columns, resized):
    lines = play(script(resized), columns).lines
    assert len(lines) == len(ENDS), lines
    assert all(re.match(r"\[\d/6\] |done$", line) for line in lines), lines


def test_of_a_low_terminal_live_lines_take_no_more_than_there_is():
    held(play(script(), 80, rows=3).lines, 80)


def test_the_cursor_waits_at_the_beginning_of_what_is_live(monkeypatch):
    """So that clearing from there clears all, also where a terminal has broken the lines anew at another width."""
    monkeypatch.setattr("sys.stderr", written := Terminal())
    monkeypatch.setenv("COLUMNS", "60")
    screen = terminal.Screen()
    screen.show(lambda: ["one", "two", "three"])
    assert written.getvalue().endswith(f"three{terminal.WRAP}\x1b[2A\r")
    screen.say("stays")
    screen.show(None)
    assert shown(written.getvalue().replace("stays\n", "stays\r\n").encode(), 60) == ["stays"]


def test_ctrl_c_leaves_nothing_that_was_live(tmp_path):
    write_run(tmp_path / "run")
    played = play(["-m", "harness.cli", "report", str(tmp_path / "run")], 60, interrupt=b"[")
    assert (played.code, played.lines) == (130, ["firsthit: stopped"])


CONFIG = """title = "t"
surfaces = ["sphere", "torus"]
sizes = [16]
devices = ["{device}"]
[[method]]
name = "analytic"
[[method]]
name = "double_derivative_bisection"
[accuracy]
size = 16
[budget]
seconds = 0.3
interval = 0.0
"""


@pytest.fixture
def config(tmp_path):
    if not usable_devices():
        pytest.skip("no device")
    (tmp_path / "c.toml").write_text(CONFIG.format(device=usable_devices()[0].name))
    return [str(tmp_path / "c.toml"), "--runs", str(tmp_path / "runs")]


def test_a_run_leaves_a_line_for_each_cell_and_no_litter(config):
    played = play(["-m", "harness.cli", "run", *config], 60)
    assert played.code == 0
    text, width_of = "\n".join(played.lines), max(map(len, played.lines))
    cells = [line for line in played.lines if re.match(r"\[\d/4\] ", line)]
    assert len(cells) == 3 and all(re.search(r"\w+:\w+: [\d.e-]+ ms(, [\w…]+)*$", line) for line in cells), text
    last = played.lines.index(cells[-1])
    assert played.lines[: last + 1] == cells and width_of <= 60, text
    assert "".join(played.lines[last + 1 :]).split(";")[0].endswith("4 cells run, 0 reused")
    assert b"looking for devices" in played.raw


def test_how_much_is_told_is_an_option(config, capsys, devices_found_once):
    def told(*options):
        devices_found_once()  # so that a worker is new, and builds what another one has built
        assert cli.main(["run", *config, *options]) == 0
        return capsys.readouterr()

    quiet = told("--quiet")
    assert quiet.err == "" and quiet.out.splitlines()[-1].endswith("4 cells run, 0 reused; 3 ok, 1 skipped")
    normal = told("--force").err
    assert "skipped" not in normal and "built" not in normal and len(re.findall(r"^\[.* ms", normal, re.M)) == 3
    verbose = told("--force", "-v").err
    assert "skipped: the method refuses the surface sphere" in verbose
    assert re.search(r"analytic sphere .*: built \w+ in [\d.]+ s; ", verbose)
    assert len(re.findall(r"^\[.*: (?:[\d.e-]+ ms|skipped)", verbose, re.M)) == 4
    assert len(re.findall(r"^reused: ", told("-v").err, re.M)) == 4
    assert "reused: " not in told().err
    assert "\x1b" not in normal + verbose and "\r" not in normal + verbose


def test_quiet_tells_errors(tmp_path, capsys):
    assert cli.main(["run", str(tmp_path / "none.toml"), "-q"]) == 2
    assert "cannot read" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        cli.main(["run", "quick", "-q", "-v"])


def test_a_report_says_what_it_does_and_where_it_is(tmp_path, capsys, monkeypatch):
    write_run(tmp_path / "run", ["torus"])
    monkeypatch.setattr(terminal, "FIRST_SECONDS", 0.0)
    monkeypatch.setattr(terminal, "NEXT_SECONDS", 0.0)
    assert cli.main(["report", str(tmp_path / "run")]) == 0
    told = capsys.readouterr()
    assert told.out == f"{tmp_path / 'run.report' / 'report.pdf'}\n"
    assert "firsthit: drawing [" in told.err


def test_plan_says_what_it_prepares_and_standard_output_is_json_alone(config, capsys, monkeypatch):
    monkeypatch.setattr(terminal, "FIRST_SECONDS", 0.0)
    heard = []
    monkeypatch.setattr(console._Steps, "tell", lambda _, what: heard.append(what))
    assert cli.main(["plan", *config, "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["parts"][0]["cells"]) == 4
    assert f"preparing [3/4] analytic: torus default 16x16x1 compute on {usable_devices()[0].name}" in heard


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(
    ("text", "columns"), [("abc", 3), ("曲面", 4), ("e\u0301", 1), ("\u200b", 0), ("a\u0308曲", 3), ("", 0)]
)
def test_wide_characters_take_two_columns_and_marks_that_combine_none(text, columns):
    assert width(text) == columns
    assert cut(text, columns) == text
    assert width(cut(text + "x" * 9, columns + 3)) <= columns + 3


def test_what_does_not_fit_is_cut_and_the_end_stays():
    assert cut("abcdef", 4) == "abc…" and cut("曲面曲面", 4) == "曲…" and cut("abc", 0) == ""
    assert fitting("abcdefghij", 8, ": ok") == "abc…: ok"
    assert fitting("abc", 8, ": ok") == "abc: ok"
    assert width(fitting("abcdefghij", 10, ": a long reason")) == 10
    assert console.table(("曲面", "b"), [("a", 1)]) == "曲面  b\na     1"


def test_names_cannot_move_the_cursor_and_begin_no_line():
    assert console.table(("a\x1b[2Jb\r\nc\t",), ()) == "a\\x1b[2Jb c"
    written = io.StringIO()
    guard = terminal.Guarded(written)
    for text in ("a\x1b[2J", "b\r\n ::err", "or::c\n##[group]d ##vso[x]", "\u202ee"):
        guard.write(text)
    assert written.getvalue() == "a\\x1b[2Jb\\x0d\n \\x3a:error::c\n"
    guard.flush()
    assert written.getvalue().endswith("\\x23#[group]d \\x23#vso[x]\\u202ee")


def test_a_terminal_that_does_not_say_how_wide_it_is_may_be_told(monkeypatch):
    monkeypatch.delenv("COLUMNS", raising=False)
    monkeypatch.delenv("LINES", raising=False)
    assert size(Terminal()) == (80, 24)
    monkeypatch.setenv("COLUMNS", "132")
    monkeypatch.setenv("LINES", "many")
    assert size(Terminal()) == (132, 24)


@pytest.mark.parametrize(
    ("environment", "on_terminal", "elsewhere"),
    [
        ({}, True, False),
        ({"NO_COLOR": "1"}, False, False),
        ({"NO_COLOR": "1", "FORCE_COLOR": "1"}, False, False),
        ({"NO_COLOR": ""}, True, False),
        ({"FORCE_COLOR": "1"}, True, True),
        ({"FORCE_COLOR": "0"}, False, False),
        ({"CLICOLOR": "0"}, False, False),
        ({"CLICOLOR": "0", "CLICOLOR_FORCE": "1"}, True, True),
        ({"TERM": "dumb"}, False, False),
    ],
)
def test_colours_are_as_the_environment_says(monkeypatch, environment, on_terminal, elsewhere):
    for name in ("NO_COLOR", "FORCE_COLOR", "CLICOLOR", "CLICOLOR_FORCE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    for stream, expected in ((Terminal(), on_terminal), (io.StringIO(), elsewhere)):
        monkeypatch.setattr("sys.stderr", stream)
        assert ("\x1b" in terminal.painted("failed", "red")) is expected


def test_a_cell_that_failed_is_red_and_its_line_fits_all_the_same(monkeypatch):
    monkeypatch.setattr("sys.stderr", written := Terminal())
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    console.Progress(1, 1.0, {})(f"{LONG} opencl:intel", {"status": "failed", "reason": "x" * 99, "time": None})
    assert written.getvalue().startswith("\x1b[31m[1/1] newton")
    assert width(re.sub(r"\x1b\[\d+m", "", written.getvalue()).rstrip("\n")) == 59


def test_what_goes_on_is_a_live_line_on_a_terminal_and_a_line_elsewhere(monkeypatch):
    live, file = Terminal(), io.StringIO()
    for stream in (live, file):
        monkeypatch.setattr(sys, "stderr", stream)
        with pytest.raises(ValueError), console.doing("looking"):
            assert "firsthit: looking" in stream.getvalue()
            raise ValueError
    assert live.getvalue().endswith(terminal.CLEAR) and "\n" not in live.getvalue()
    assert file.getvalue() == "firsthit: looking\n"


def test_elsewhere_what_goes_on_is_said_now_and_then_while_no_cell_ends(monkeypatch):
    monkeypatch.setattr("sys.stderr", written := io.StringIO())
    monkeypatch.setattr(terminal, "FIRST_SECONDS", 0.1)
    monkeypatch.setattr(terminal, "NEXT_SECONDS", 60.0)
    progress = console.Progress(2, 30.0, {"opencl:a": 1, "opencl:b": 1})
    progress("newton torus opencl:a", None)
    end = time.monotonic() + 60.0
    while not written.getvalue() and time.monotonic() < end:
        time.sleep(0.05)
    progress("newton torus opencl:a", {"status": "ok", "reason": None, "time": None})
    progress.pause()
    first, last = written.getvalue().splitlines()
    assert re.fullmatch(r"\[0/2\] \d:\d\d, about \d:\d\d left: newton torus opencl:a", first)
    assert re.fullmatch(r"\[1/2\] \d:\d\d, about \d:\d\d left: newton torus opencl:a: ok", last)


def test_the_first_cells_that_end_together_do_not_make_the_estimate_absurd():
    assert console._left(25.0, 60.0, 1 / 88) < 180.0
    assert console._left(30.0, 60.0, 0.5) == pytest.approx(30.0)
    assert console._left(10.0, 0.0, 0.5) == pytest.approx(10.0) and console._left(1.0, 0.0, 0.0) == 0.0


@pytest.fixture(autouse=True)
def _nothing_goes_on_afterwards():
    yield
    SCREEN.show(None)
    SCREEN.level = "normal"
