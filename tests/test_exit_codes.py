"""Real processes end with the exit codes that are documented, say what is true, and leave no worker behind."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from harness.cli import EXIT_CODES, main
from harness.hosting import process as hosted
from harness.stopping import Stopped, code_of, stoppable

from .conftest import usable_devices
from .synthetic_run import write_run

pytestmark = pytest.mark.usefixtures("no_cache")

ROOT = Path(__file__).parents[1]
COMMAND = [sys.executable, "-m", "harness.cli"]
CONFIG = """title = "Cells that end at once, and one that takes for ever"
surfaces = ["sphere", "torus"]
sizes = [16]
devices = ["{device}"]
[[method]]
name = "analytic"
[[method]]
name = "endless"
[accuracy]
size = 64
[budget]
seconds = 0.1
timeout = 600
"""
METHOD = """from firsthit import Method

METHOD = Method(
    name="endless",
    source="t",
    needs=("surface_along", "surface_value_along"),
    accepts=lambda surface: None if surface.name == "torus" else "the torus alone takes for ever",
)
"""
KERNEL = """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real sum = 0.0;
    for (int i = 0; i < 2000000000; i++) {
        sum = sum * 0.5 + surface_value_along(along, t0 + real(i) * 1e-9);
    }
    if (sum == 12345.0) return hit_at(hit, t0);
    return hit;
}
"""


@pytest.fixture
def endless(tmp_path):
    """A folder with a config whose last cell never ends, and the plugin that it needs."""
    names = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
    if not names:
        pytest.skip("no OpenCL device")
    (tmp_path / "plugins" / "endless").mkdir(parents=True)
    (tmp_path / "plugins" / "endless" / "method.py").write_text(METHOD)
    (tmp_path / "plugins" / "endless" / "kernel.glsl").write_text(KERNEL)
    (tmp_path / "endless.toml").write_text(CONFIG.format(device=names[0]))
    return tmp_path


def _bless_one_row(folder):
    """Write a baseline of the config's first row."""
    config = folder / "endless.toml"
    text = config.read_text()
    config.write_text(text.replace(', "torus"', "").replace('[[method]]\nname = "endless"\n', ""))
    assert main(["bless", str(config), "--runs", str(folder / "blessed"), "--reason", "one row"]) == 0
    config.write_text(text)


def _environment():
    return os.environ | {"PYTHONPATH": str(ROOT)}


def _members(session):
    """The processes of a session that have not ended."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = status.read_text().rpartition(")")[2].split()
        except OSError:  # it has ended since
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found.append(int(status.parent.name))
    return found


def _stopped(folder, arguments, reached, begun=lambda: True, number=signal.SIGINT):
    """Start a command, wait for a line on stderr that `reached` knows and until it has `begun`, and send a signal.

    Returns its exit code and stderr. As of a terminal's Ctrl-C, the signal goes to the workers too. No process of the
    command may stay behind.
    """
    process = subprocess.Popen(
        [*COMMAND, *map(str, arguments)],
        cwd=folder,
        env=_environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        told = ""
        while not reached(told):
            line = process.stderr.readline()
            assert line, f"it ended with {process.wait()}: {told}"
            told += line
        while not begun():
            assert process.poll() is None, "it ended before it was stopped"
            time.sleep(0.01)
        time.sleep(0.3)  # into the next step
        os.killpg(process.pid, number)
        told += process.communicate(timeout=120)[1]
        assert not _members(process.pid)
    finally:
        process.kill()
        process.wait()
    assert "Traceback" not in told
    return process.returncode, told


def _two_are_done(told):
    """Tell whether two of four cells have ended; a slow command tells before of those that it prepares."""
    return re.search(r"^\[[23]/4\]", told, re.MULTILINE)


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.parametrize(("command", "number"), [("run", signal.SIGTERM), ("gate", signal.SIGHUP)])
def test_a_signal_in_a_step_of_a_worker_has_its_code_and_keeps_what_finished(endless, command, number):
    if command == "gate":
        _bless_one_row(endless)
    arguments = ["--plugins", "plugins", command, "endless.toml"]
    code, told = _stopped(endless, arguments, _two_are_done)
    assert code == 130
    kept = "finished cells are kept" + ", with what was checked and timed of others" * (command == "run")
    assert told.splitlines()[-1] == f"firsthit: stopped; {kept}, and the same command goes on from there"
    assert len(list(endless.glob("runs/*/cells/*.json"))) >= 2, "what the message says is true"
    assert not [path for path in endless.rglob(".*") if path.name != ".lock"]
    again = [*arguments, "--force"]
    code, told = _stopped(endless, again, _two_are_done, number=number)
    assert code == 128 + number
    assert "the command without --force goes on from there" in told


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_a_library_that_answers_a_signal_by_an_error_of_its_own_does_not_hide_that_it_came(monkeypatch, capsys):
    def stopped_while_numpy_is_imported(*_: object) -> int:
        try:
            os.kill(os.getpid(), signal.SIGTERM)
        except KeyboardInterrupt:
            raise ImportError("PyCapsule_Import could not import module datetime") from None
        return 0

    monkeypatch.setattr("harness.cli._run", stopped_while_numpy_is_imported)
    assert main(["list", "methods"]) == 143
    assert capsys.readouterr().err == "firsthit: stopped\n"


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_a_signal_just_before_a_process_is_started_leaves_no_thread_deaf(monkeypatch):
    real = signal.pthread_sigmask

    def stopped_when_it_blocks(how, signals):
        before = real(how, signals)
        if signals and how == signal.SIG_BLOCK:
            raise Stopped(signal.SIGTERM)  # as pthread_sigmask does for a signal that came before
        return before

    monkeypatch.setattr(signal, "pthread_sigmask", stopped_when_it_blocks)
    with pytest.raises(Stopped):
        hosted.start("harness.spreading.serving", [], "a worker", {})
    assert real(signal.SIG_BLOCK, ()) == set()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_second_signal_ends_at_once_and_an_echo_of_the_first_does_not(number):
    code = (
        "import time; from harness.stopping import stoppable\n"
        "with stoppable():\n"
        "    try: print('begun', flush=True); time.sleep(60)\n"
        "    except KeyboardInterrupt: print('asked', flush=True); time.sleep(60)\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code], env=_environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "begun\n"
    process.send_signal(number)
    assert process.stdout.readline() == "asked\n"
    process.send_signal(number)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.7)
    process.send_signal(number)
    assert (process.wait(30), process.stderr.read()) == (128 + number, "")


def test_a_signal_that_the_caller_ignores_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does
    try:
        with stoppable():
            os.kill(os.getpid(), signal.SIGHUP)
            assert signal.getsignal(signal.SIGHUP) is signal.SIG_IGN
            with pytest.raises(Stopped) as stopped:
                os.kill(os.getpid(), signal.SIGTERM)
        assert code_of(stopped.value) == 143
        assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGHUP, before)


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_ctrl_c_while_a_report_is_made_is_130_and_leaves_the_folder_as_it_was(tmp_path):
    write_run(tmp_path / "quick")
    (tmp_path / "quick.report").mkdir()
    before = sorted(tmp_path.rglob("*"))
    begun = "quick.report/.new-*"
    code, told = _stopped(tmp_path, ["report", "quick"], lambda _: True, lambda: [*tmp_path.glob(begun)])
    assert (code, told.splitlines()[-1]) == (130, "firsthit: stopped")
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
def test_ctrl_c_while_devices_are_looked_for_is_130(tmp_path):
    code, told = _stopped(tmp_path, ["devices", "--again"], lambda told: "looking for devices" in told)
    assert (code, told.splitlines()[-1]) == (130, "firsthit: stopped")


@pytest.mark.parametrize(
    "arguments",
    [
        *[("list", "methods"), ("list", "configs"), ("--help",), ("--version",), ("gate", "--help")],
        *[("list", "configs", "--json"), ("schema",)],
    ],
)
def test_a_pipe_that_nobody_reads_is_no_success(tmp_path, arguments):
    ours, theirs = os.pipe()
    os.close(ours)
    result = subprocess.run(
        [*COMMAND, *arguments], cwd=tmp_path, env=_environment(), stdout=theirs, stderr=subprocess.PIPE, check=False
    )
    os.close(theirs)
    assert (result.returncode, result.stderr) == (141, b"")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("arguments", [("list", "configs"), ("--version",), ("list", "configs", "--json")])
def test_a_full_disk_is_one_line_and_no_success(tmp_path, arguments, unbuffered):
    with Path("/dev/full").open("w") as full:
        result = subprocess.run(
            [*COMMAND, *arguments],
            cwd=tmp_path,
            env=_environment() | {"PYTHONUNBUFFERED": unbuffered},
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert (result.returncode, result.stderr) == (3, "firsthit: cannot write: No space left on device\n")


def test_a_reason_that_nobody_reads_is_no_success_either(tmp_path):
    ours, theirs = os.pipe()
    os.close(ours)
    result = subprocess.run([*COMMAND, "why", "nonesuch"], cwd=tmp_path, env=_environment(), stderr=theirs, check=False)
    os.close(theirs)
    assert result.returncode == 141


def test_a_mistake_of_ours_is_3_and_says_where(monkeypatch, capsys):
    from harness.commands import listing

    monkeypatch.setattr(listing, "_list", lambda _: 1 / 0)
    assert main(["list", "methods"]) == 3
    assert "ZeroDivisionError" in capsys.readouterr().err


def test_help_names_every_exit_code(capsys):
    with pytest.raises(SystemExit) as caught:
        main(["--help"])
    assert caught.value.code == 0
    out = capsys.readouterr().out
    assert EXIT_CODES in out
    assert [line.split()[0] for line in EXIT_CODES.splitlines()[1:]] == [
        *["0", "1", "2", "3", "129", "130", "141", "143"]
    ]
