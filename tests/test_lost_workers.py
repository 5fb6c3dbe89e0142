"""Workers that do what they must not: grow without end, die, hang, answer nonsense, or lose their device for good."""

import contextlib
import io
import os
import signal
import subprocess
import sys
import time
from multiprocessing import Pipe
from pathlib import Path

import pandas as pd
import pytest

import firsthit
import surfaces
from harness import memory
from harness.cli import main
from harness.contract import CellStatus, DeviceInfo, FirsthitError, LostDevice, View
from harness.devices import discovery, executor, interface, serving
from harness.devices.executor import CellError, LocalExecutor
from harness.experiment import plan, reading, targets
from harness.experiment.kinds import beams
from harness.experiment.kinds import model as kinds_model
from harness.experiment.kinds import rays as kinds_rays
from harness.plugins import find_methods
from harness.running import environment, picture, run
from harness.verifying import truth as verified_truth
from harness.verifying.model import CannotTell
from reports.reading import arrays
from tests.conftest import usable_devices

pytestmark = pytest.mark.usefixtures("no_cache")

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
OTHER = DeviceInfo("opengl:one", "t", "d", "c", 4, True, "wall", ())
DIES = "os.kill(os.getpid(), signal.SIGKILL)"
GROWS = "kept = [b'x' * 4_000_000 for _ in range(100)]; import time; time.sleep(60)"
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


def commands():
    """Yield the command lines of this machine's processes."""
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):  # it has ended meanwhile
            yield path.read_bytes()


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
    end = time.monotonic() + 10.0
    while any(b"kept = [b'x'" in command for command in commands()):
        assert time.monotonic() < end, "its child is still there"
        time.sleep(0.05)


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


def test_a_worker_that_was_killed_while_devices_were_looked_for_is_said(monkeypatch, tmp_path):
    serving_as(monkeypatch, DIES)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    told = "opencl:intel: the worker was killed by signal KILL while devices were looked for"
    found = discovery.discover_devices(["opencl:intel"])
    for name, devices in [("opencl:intel", found), ("opencl:intel", [*found, OTHER])]:
        with pytest.raises(FirsthitError, match=told) as raised:
            interface.device_named(name, devices)
        assert raised.value.exit_code == 3
    with pytest.raises(FirsthitError, match="opencl:none: the worker was killed by signal KILL"):
        interface.working(found)
    chosen = targets.choose_devices(["opencl:intel", OTHER.name], [*found, OTHER])
    assert chosen[OTHER.name] is OTHER and f"{chosen['opencl:intel'].name}: {chosen['opencl:intel'].problem}" == told
    with pytest.raises(FirsthitError, match="there is no device 'opengl:nonesuch' here"):
        interface.device_named("opengl:nonesuch", found)


def test_a_run_goes_on_without_a_device_that_was_lost(monkeypatch, tmp_path):
    config = 'title = "t"\nsurfaces = ["sphere"]\nsizes = [16]\ndevices = {}\n[[method]]\nname = "newton"\n'
    gone = LostDevice(**vars(OTHER) | {"name": "opencl:none", "problem": "the worker was killed"})
    serving_as(monkeypatch, DIES)
    monkeypatch.setattr(run, "discover_devices", lambda _: [gone, OTHER])
    for name, devices in {"both": ["opencl:intel", "opengl:one"], "probed": ["opengl:one"]}.items():
        (tmp_path / f"{name}.toml").write_text(config.format(devices))
        if name == "both":
            monkeypatch.setattr(run, "probed", lambda _executor, info, _cache: (info, None))
            done = run.run(run.read(tmp_path / "both.toml"), tmp_path, "")
            assert done.lost == ("opencl:intel: the worker was killed",)
            assert [row["status"] for row in done.rows] == ["skipped", "crashed"]
            assert done.rows[0]["reason"] == "the worker was killed"
        else:
            monkeypatch.setattr(run, "probed", environment.probed)
            said = "opengl:one: the worker was killed by signal KILL while its arithmetic and clock were tried"
            with pytest.raises(FirsthitError, match=said) as raised:
                run.run(run.read(tmp_path / "probed.toml"), tmp_path, "")
            assert raised.value.exit_code == 3


def test_what_a_driver_says_is_said_once_with_its_device_and_without_its_signs(capfd, monkeypatch):
    monkeypatch.setattr(serving, "_SAID", set())
    monkeypatch.setattr(serving, "MOST_LINES", 4)
    said = b"Mesa: a warning at 0x7f01\nMesa: a warning at 0x7f99\n1 warning generated.\n\033[2Jgone\n::error::x\n"
    for device in ("opencl:a", "opencl:a", "opencl:b"):
        serving._hand_on(io.BytesIO(said + said), device)
    lines = capfd.readouterr().err.splitlines()
    shown = ["Mesa: a warning at 0x7f01", r"\x1b[2Jgone", "::error::x"]
    cut = "opencl:b: what devices say from here on is left out"
    assert lines == [*(f"opencl:a: {line}" for line in shown), f"opencl:b: {shown[0]}", cut]


def test_a_list_of_rays_that_memory_does_not_hold_is_refused(monkeypatch, tmp_path):
    path = tmp_path / "large.toml"
    path.write_text(
        'title = "t"\nsurfaces = ["sphere"]\nsizes = [16384]\nstages = ["rays"]\ndevices = ["opengl:one"]\n'
        '[[method]]\nname = "newton"\n'
    )
    catalog = find_methods()
    (planned,) = plan.plan(reading.load(path, catalog), catalog, [OTHER])
    monkeypatch.setattr(memory, "of_machine", lambda: 8_000_000_000)
    told = "a list of 268,435,456 rays would take 40.3 GB of memory, over the limit of 4 GB"
    with pytest.raises(FirsthitError, match=told):
        _ = planned.frame


def _refuse(*_, **__):
    raise AssertionError("rays were made")


@pytest.fixture
def little_memory(monkeypatch):
    """Make this machine one of 2 GB, on which the places that make rays of a view may make none."""
    monkeypatch.setattr(memory, "of_machine", lambda: 2_000_000_000)
    for module in (picture, kinds_model, kinds_rays, beams, verified_truth):
        monkeypatch.setattr(module, "rays_of", _refuse)


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("[accuracy]\nsize = 4096", "a check of 16,777,216 rays would take"),
        ("[accuracy]\nsize = 2048\n[samples]", "a check of 71,303,168 rays would take"),
    ],
)
@pytest.mark.parametrize("method", ["newton", "interval_uniform"])
@pytest.mark.usefixtures("little_memory")
def test_a_check_that_memory_does_not_hold_is_refused_before_any_ray(tmp_path, method, more, told):
    path = tmp_path / "large.toml"
    named = f'[[method]]\nname = "{method}"\n'
    text = 'title = "t"\nsurfaces = ["sphere"]\ndevices = ["opengl:one"]\n'
    samples = "samples_per_pixel = [16]\n" if "samples" in more else ""
    path.write_text(text + samples + named + more.removesuffix("[samples]"))
    catalog = find_methods()
    (planned,) = plan.plan(reading.load(path, catalog), catalog, [OTHER], timed=False)
    choice = reading.load(path, catalog).config.accuracy
    with pytest.raises(
        FirsthitError, match=rf"{told} .* GB of memory, over the limit of 1 GB; take a smaller"
    ) as raised:
        planned.casting.check(None, choice, tmp_path, False)
    assert raised.value.exit_code == 3


@pytest.mark.usefixtures("little_memory")
def test_maps_that_memory_does_not_hold_together_are_refused_before_any_is_read(monkeypatch):
    monkeypatch.setattr(arrays, "read", _refuse)
    rows = pd.DataFrame({"arrays": [f"arrays/{i}.npz" for i in range(9)], "accuracy_rays": [4096.0**2] * 9})
    told = r"the maps of 9 cells, 16,777,216 rays at most, would take .* GB of memory, over the limit of 1 GB; run with"
    with pytest.raises(FirsthitError, match=told) as raised:
        arrays.Shelf({}).together(rows)
    assert raised.value.exit_code == 3


@pytest.mark.usefixtures("little_memory")
def test_rays_that_memory_does_not_hold_are_not_certified_anew(monkeypatch):
    monkeypatch.setattr(verified_truth, "surface_of", lambda _: surfaces.get("sphere"))
    monkeypatch.setattr(verified_truth, "view_of", lambda _: View("shown"))
    row = {"accuracy": {"size": 4096}, "stage": "compute"}
    with pytest.raises(CannotTell, match=r"certifying 16,777,216 rays would take .* verify it on a machine with more"):
        verified_truth.rays_for(row)


@pytest.mark.usefixtures("little_memory")
def test_a_picture_that_memory_does_not_hold_is_refused_before_any_ray(tmp_path, capsys):
    device, output = usable_devices()[0].name, tmp_path / "a.png"
    words = ["--method", "newton", "--device", device, "--size", "4096", "-o", str(output)]
    told = "GB of memory, over the limit of 1 GB; take a smaller"
    for command in (["show", "--surface", "sphere"], ["sheet"]):
        assert main([*command, *words]) == 3
        error = " ".join(capsys.readouterr().err.split())
        assert told in error and ("a picture of 4096x4096 pixels" in error or "a sheet of" in error)
    with pytest.raises(FirsthitError, match=told):
        firsthit.render("x^2 + y^2 + z^2 - 1", "newton", size=4096, device=device)
    path = tmp_path / "c.toml"
    path.write_text('title = "t"\n[[method]]\nname = "newton"\n[scene.mine]\ngenerate = "lattice"\ncounts = [8]\n')
    assert main(["scene", str(path), "--method", "newton", "--size", "4096", "-o", str(output)]) == 3
    assert told in " ".join(capsys.readouterr().err.split()) and not output.exists()


def test_what_stops_a_command_ends_no_worker_first():
    running = LocalExecutor(60.0)
    name = usable_devices()[0].name
    try:
        running.probe(name)
        worker = running._processes[name].process
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            os.kill(worker.pid, number)
        assert running.builds(name) is not None and worker.poll() is None
    finally:
        running.close()
