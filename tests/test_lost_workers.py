"""Workers that do what they must not: grow without end, die, hang, answer nonsense, or lose their device for good."""

import os
import subprocess
import sys
from multiprocessing import Pipe
from pathlib import Path

import pytest

from harness import memory
from harness.contract import CellStatus
from harness.devices import executor, serving
from harness.devices.executor import CellError, LocalExecutor

ROOT = Path(__file__).parents[1]
SERVE = """
import os, signal, sys, time
from multiprocessing.connection import Connection
pipe = Connection(int(sys.argv[1]))
while True:
    operation, arguments = pipe.recv()
    if operation == "reopen":
        {reopen}
        pipe.send(("ok", None))
    else:
        {build}
"""
DIES = "os.kill(os.getpid(), signal.SIGKILL)"
GROWS = "kept = [b'x' * 4_000_000 for _ in range(10**5)]"
CHILD_GROWS = f"import subprocess; subprocess.run([sys.executable, '-c', {GROWS!r}])"


def serving_as(monkeypatch, build, reopen="pass"):
    """Let executors start workers that answer `build` by the statement `build`; return the list of those started."""
    started = []

    def start(_device):
        ours, theirs = Pipe()
        text = SERVE.format(build=build, reopen=reopen)
        process = subprocess.Popen([sys.executable, "-c", text, str(theirs.fileno())], pass_fds=[theirs.fileno()])
        theirs.close()
        started.append(process)
        return process, ours

    monkeypatch.setattr(serving, "start", start)
    return started


def built(runner):
    with pytest.raises(CellError) as raised:
        runner.build("opencl:none", None)
    return raised.value.status, str(raised.value)


@pytest.mark.parametrize("grows", [GROWS, CHILD_GROWS], ids=["worker", "child"])
@pytest.mark.skipif(sys.platform != "linux", reason="looks at /proc")
def test_a_worker_that_grows_is_killed_and_its_row_says_the_limit(monkeypatch, grows):
    started = serving_as(monkeypatch, grows)
    monkeypatch.setattr(memory, "of_machine", lambda: 200_000_000)
    monkeypatch.setattr(memory, "FAMILY_SECONDS", 0.1)
    status, reason = built(LocalExecutor(60.0, 0.5))
    assert status is CellStatus.CRASHED
    limit = "the limit ([budget] memory = 0.5 of 0.2 GB)"
    assert reason == f"build held more than 0.1 GB of memory, {limit}; killed"
    assert started[0].poll() is not None


@pytest.mark.parametrize(
    ("build", "status", "words"),
    [
        (DIES, CellStatus.CRASHED, "the worker was killed by signal KILL during build"),
        ("os._exit(7)", CellStatus.CRASHED, "the worker ended with exit code 7 during build"),
        ("pipe.send_bytes(b'no pickle')", CellStatus.CRASHED, "the worker's answer to build is damaged"),
        ("pipe.send(('ok', 1, 2))", CellStatus.CRASHED, "the worker's answer to build is damaged"),
        ("time.sleep(60)", CellStatus.TIMEOUT, "build took longer than"),
        ("os.write(pipe.fileno(), b'\\0\\0\\1\\0half'); time.sleep(60)", CellStatus.TIMEOUT, "did not come whole"),
    ],
    ids=["killed", "exits", "garbage", "three parts", "hangs", "half a message"],
)
def test_what_a_worker_does_costs_the_step_and_says_what_it_was(monkeypatch, build, status, words):
    started = serving_as(monkeypatch, build)
    runner = LocalExecutor(1.0)
    runner._call("opencl:none", "reopen")  # it has started now
    found, reason = built(runner)
    assert found is status and words in reason
    assert started[0].poll() is not None, "the worker is still there"
    runner.close()


def test_a_kernel_that_crashes_each_time_costs_one_row_each_time(monkeypatch):
    started = serving_as(monkeypatch, DIES)
    runner = LocalExecutor(60.0)
    for _ in range(executor.REOPENINGS + 3):
        assert built(runner) == (CellStatus.CRASHED, "the worker was killed by signal KILL during build")
    assert len(started) == executor.REOPENINGS + 3


def test_a_device_that_is_gone_is_given_up_after_a_few_tries(monkeypatch):
    started = serving_as(monkeypatch, DIES, DIES)
    runner = LocalExecutor(60.0)
    built(runner)
    for _ in range(executor.REOPENINGS):
        again = "opencl:none could not be opened again after its worker was lost"
        assert built(runner) == (
            CellStatus.CRASHED,
            f"{again}: the worker was killed by signal KILL while it was opened",
        )
    assert len(started) == 1 + executor.REOPENINGS
    for _ in range(5):
        status, reason = built(runner)
        assert status is CellStatus.FAILED and reason.startswith("not tried: opencl:none was given up")
    assert len(started) == 1 + executor.REOPENINGS


def test_an_exception_of_a_binding_loses_its_worker(monkeypatch):
    started = serving_as(monkeypatch, "pipe.send(('broken', 'clFinish failed: OUT_OF_RESOURCES'))")
    runner = LocalExecutor(60.0)
    for count in (1, 2):
        assert built(runner) == (CellStatus.FAILED, "clFinish failed: OUT_OF_RESOURCES")
        assert len(started) == count and started[-1].poll() is not None


def test_the_memory_of_a_container_counts_where_it_is_less(tmp_path):
    told, root = tmp_path / "cgroup", tmp_path / "mounted"
    told.write_text("4:cpu,memory:/a/b\n3:cpu:/c\n0::/x/y\n")
    for group, file, limit in [
        ("memory/a/b", "memory.limit_in_bytes", "9223372036854771712"),
        ("memory/a", "memory.limit_in_bytes", "3000"),
        ("x/y", "memory.max", "max"),
        ("x", "memory.max", "2000"),
    ]:
        (root / group).mkdir(parents=True, exist_ok=True)
        (root / group / file).write_text(f"{limit}\n")
    assert sorted(memory._of_containers(told, root)) == [2000, 3000, 9223372036854771712]
    assert list(memory._of_containers(tmp_path / "none", root)) == []


@pytest.mark.skipif(sys.platform != "linux", reason="looks at /proc")
def test_what_this_process_holds_is_seen():
    before = memory.Watch(os.getpid()).held()
    kept = b"x" * 50_000_000
    assert memory.Watch(os.getpid()).held() > before + 40_000_000 and kept
