"""Workers start from any caller: a script without a main guard, a notebook, a source tree that only sys.path names."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from harness.devices import serving

pytestmark = pytest.mark.usefixtures("no_cache")

ROOT = Path(__file__).parents[1]
NO_GUARD = """
import os, sys, time
sys.path.insert(0, {root!r})
print("the script runs", flush=True)
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
{more}
"""
FIND = """
for info in discover_devices():
    print(info.name, info.problem, sep="; ")
"""
HOLD = """
executor = LocalExecutor(60.0)
executor.find("opencl")
print(executor._processes["opencl"].process.pid, flush=True)
time.sleep(300)
"""


def script(folder, more):
    path = folder / "script.py"
    path.write_text(NO_GUARD.format(root=str(ROOT), more=more))
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return {"args": [sys.executable, str(path)], "cwd": folder, "env": environment, "text": True}


@pytest.mark.parametrize("typed", [False, True], ids=["script", "typed in"])
def test_a_script_without_a_guard_runs_once_and_finds_the_devices(tmp_path, typed):
    work = tmp_path / "work"
    (work / "harness").mkdir(parents=True)
    (work / "harness/__init__.py").write_text("raise SystemExit('the harness of another folder was imported')")
    started = script(tmp_path, FIND)
    if typed:
        started |= {"args": [sys.executable], "input": (tmp_path / "script.py").read_text()}
    else:
        started |= {"cwd": work}
    result = subprocess.run(**started, capture_output=True, check=True, timeout=120)
    first, *found = result.stdout.splitlines()
    assert first == "the script runs" and first not in found
    assert found and all("worker" not in line for line in found), result.stdout + result.stderr


def test_a_worker_dies_with_the_process_that_started_it(tmp_path):
    with subprocess.Popen(**script(tmp_path, HOLD), stdout=subprocess.PIPE) as process:
        assert process.stdout and process.stdout.readline() == "the script runs\n"
        worker = Path(f"/proc/{int(process.stdout.readline())}")
        assert b"harness.devices.serving" in (worker / "cmdline").read_bytes()
        process.send_signal(signal.SIGKILL)
    end = time.monotonic() + 10.0
    while worker.exists() and (worker / "stat").read_text().rpartition(")")[2].split()[0] != "Z":
        assert time.monotonic() < end, "the worker is still there"
        time.sleep(0.05)


def test_a_worker_answers_until_its_connection_closes_and_is_not_interrupted():
    process, connection = serving.start("opencl")
    try:
        connection.send(("release", ("nothing",)))
        assert connection.recv() == ("ok", None)
        process.send_signal(signal.SIGINT)
        connection.send(("nonesuch", ()))
        outcome, reason = connection.recv()
        assert outcome == "broken" and reason.startswith("AttributeError: ")
        connection.close()
        assert process.wait(30.0) == 0
    finally:
        process.kill()
        process.wait()


def test_a_worker_that_has_only_just_started_is_not_interrupted():
    process, connection = serving.start("opencl")
    try:
        process.send_signal(signal.SIGINT)  # before it has imported what ignores it
        connection.send(("release", ("nothing",)))
        assert connection.recv() == ("ok", None)
    finally:
        process.kill()
        process.wait()
