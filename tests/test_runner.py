"""Runs for real: kill the runner, kill a worker, and plugins that do not compile, hang and crash."""

import functools
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from harness.results import owner
from harness.results.begun import Begun

from .conftest import usable_devices

CONFIG = """title = "t"
surfaces = ["sphere", "torus"]
sizes = [64]
devices = ["{device}"]
precisions = ["float32"]
[[method]]
name = "newton"
parameters = {{ EPSILON = [0.001, 0.0001, 0.00001] }}
[[method]]
name = "null"
{more}
[accuracy]
size = 16
[budget]
seconds = {seconds}
repetitions = 100000
interval = 0.0
timeout = 6.0
"""


def firsthit(*arguments):
    return [sys.executable, "-m", "harness.cli", *map(str, arguments)]


def run(*arguments):
    return subprocess.run(firsthit(*arguments), capture_output=True, text=True, timeout=200, check=False)


def rows(folder: Path):
    plan = json.loads((folder / "plan.json").read_text())
    found = {}
    for cell in plan["cells"]:
        path = folder / "cells" / f"{cell['key']}.json"
        if path.exists():
            found[cell["key"]] = json.loads(path.read_text())
    return plan["cells"], found


@pytest.fixture(scope="module")
def finished_once(tmp_path_factory):
    """The folder of a run of the config as it is written by default, made once."""
    folder = tmp_path_factory.mktemp("finished")
    first = run("run", written(folder), "--runs", folder / "runs")
    assert first.returncode == 0, first.stderr
    return folder / "runs"


@pytest.fixture
def finished(tmp_path, finished_once):
    """A copy of that run, in the test's own folder `runs`."""
    return shutil.copytree(finished_once, tmp_path / "runs")


def written(folder, seconds=0.05, more=""):
    """Write the config into a folder."""
    devices = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
    if not devices:
        pytest.skip("no OpenCL device")
    path = folder / "t.toml"
    path.write_text(CONFIG.format(device=devices[0], seconds=seconds, more=more))
    return path


@pytest.fixture
def config(tmp_path):
    return functools.partial(written, tmp_path)


def wait_for(condition, seconds=90.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "nothing happened in time"
        time.sleep(0.05)


def stop_when(process, condition):
    """Stop a process where the condition holds and stays so until it is told to go on."""

    def holds():
        process.send_signal(signal.SIGSTOP)
        if condition():
            return True
        process.send_signal(signal.SIGCONT)
        return False

    wait_for(holds)


def is_timing(run, rows):
    """Tell whether a run has that many rows, and samples of cells that have none yet."""
    have = {path.stem for path in (run / "cells").glob("[!.]*.json")}
    sampled = {key for session in Begun(run)._sessions for key, kept in session.cells.items() if kept.samples}
    return len(have) >= rows and bool(sampled) and not sampled & have


def children(pid):
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(path.parent.name))
    return found


def workers(pid):
    commands = {child: Path(f"/proc/{child}/cmdline") for child in children(pid)}
    return [
        child for child, path in commands.items() if path.exists() and b"harness.devices.serving" in path.read_bytes()
    ]


def is_running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_a_second_run_reuses_every_cell_and_force_repeats_them(config, finished):
    path, runs = config(), finished
    cells, before = rows(runs / "t")
    assert {row["status"] for row in before.values()} == {"ok"}
    assert len(before) == len(cells) == 8
    for row in before.values():
        assert len(row["time"]["samples_ms"]) >= 1
        assert row["accuracy"]["rays"] == 256
    second = run("run", path, "--runs", runs)
    assert second.returncode == 0
    assert "0 cells run, 8 reused" in second.stdout
    assert rows(runs / "t")[1] == before
    third = run("run", path, "--runs", runs, "--force")
    assert "8 cells run, 0 reused" in third.stdout


@pytest.mark.usefixtures("no_cache")
def test_killing_the_runner_loses_and_repeats_no_finished_cell(tmp_path, config):
    path, runs = config(seconds=0.4), tmp_path / "runs"
    process = subprocess.Popen(firsthit("run", path, "--runs", runs), stderr=subprocess.DEVNULL)
    cells_folder = runs / "t" / "cells"
    stop_when(process, lambda: is_timing(runs / "t", rows=3))
    second = run("run", path, "--runs", runs)
    assert second.returncode == 3
    assert f"is being written by `firsthit run {path} --runs {runs}` (process {process.pid} of " in second.stderr
    orphans = workers(process.pid)
    process.send_signal(signal.SIGKILL)
    process.wait()
    begun = Begun(runs / "t")._sessions[0]
    finished = {p.name: p.read_bytes() for p in cells_folder.glob("*.json")}
    assert 3 <= len(finished) < 8
    wait_for(lambda: not any(map(is_running, orphans)), 10.0)
    litter = cells_folder / f".new-{owner.machine()}-{2**22 + 1}-1-abcdefgh.json"  # of a process that cannot be
    litter.touch()
    again = run("run", path, "--runs", runs)
    assert again.returncode == 0, again.stderr
    assert "that killed commands left" in again.stdout
    assert not litter.exists()
    assert f"{8 - len(finished)} cells run, {len(finished)} reused" in again.stdout
    assert {name: (cells_folder / name).read_bytes() for name in finished} == finished
    found = rows(runs / "t")[1]
    assert {row["status"] for row in found.values()} == {"ok"}
    timed = {key: len(kept.samples) for key, kept in begun.cells.items() if kept.samples}
    assert {key: found[key]["time"]["sittings"][0] for key in timed} == timed
    assert {found[key]["time"]["session"] for key in begun.cells} == {begun.name}
    assert not (runs / "t" / "begun").exists()


@pytest.mark.usefixtures("no_cache")
def test_killing_a_worker_costs_one_cell_and_retry_mends_it(tmp_path, config):
    path, runs = config(seconds=0.4), tmp_path / "runs"
    process = subprocess.Popen(firsthit("run", path, "--runs", runs), stderr=subprocess.DEVNULL)
    stop_when(process, lambda: is_timing(runs / "t", rows=4))  # a worker that is lost before costs no cell
    victims = workers(process.pid)
    assert victims
    for victim in victims:
        os.kill(victim, signal.SIGKILL)
    process.send_signal(signal.SIGCONT)
    assert process.wait(timeout=120) == 3
    found = rows(runs / "t")[1]
    assert sorted(row["status"] for row in found.values()) == ["crashed"] + ["ok"] * 7
    reason = next(row["reason"] for row in found.values() if row["status"] == "crashed")
    assert "killed by signal KILL" in reason
    again = run("run", path, "--runs", runs, "--retry", "failed")
    assert again.returncode == 0
    assert "1 cell run, 7 reused" in again.stdout


def test_interrupting_keeps_what_is_finished(tmp_path, config):
    path, runs = config(seconds=0.4), tmp_path / "runs"
    process = subprocess.Popen(firsthit("run", path, "--runs", runs), stderr=subprocess.PIPE, text=True)
    cells_folder = runs / "t" / "cells"
    wait_for(lambda: cells_folder.exists() and len(list(cells_folder.glob("*.json"))) >= 1)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "finished cells are kept" in errors
    assert "Traceback" not in errors


PLUGIN = """from harness.contract import Method
METHOD = Method(name="{name}", source="test")
"""
KERNELS = {
    "typing_mistake": "Hit first_hit(Ray ray, real t0, real t1) {\n    Hit hit = no_hit(t1);\n    return hti;\n}\n",
    "endless": """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t0);
    real x = 0.5 + 0.125 * ray.direction.x;
    while (x < 2.0) { x = 3.75 * x * (1.0 - x); hit.evaluations = (hit.evaluations + 1) & 7; }
    hit.t = x;
    return hit;
}
""",
    "crashing": """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t0);
    real a[4];
    int k = 1 << (20 + (ray.direction.z < 2.0 ? 9 : 0));
    for (int i = 0; i < 4; i++) a[i] = t0;
    for (int i = 0; i < 4; i++) a[k + i * k] = t1;
    hit.t = a[k / 2];
    return hit;
}
""",
}


def test_plugins_that_do_not_compile_hang_or_crash_cost_a_row_each(tmp_path, config):
    plugins, runs = tmp_path / "plugins", tmp_path / "runs"
    for name, kernel in KERNELS.items():
        (plugins / name).mkdir(parents=True)
        (plugins / name / "method.py").write_text(PLUGIN.format(name=name))
        (plugins / name / "kernel.glsl").write_text(kernel)
    path = config(more="".join(f'[[method]]\nname = "{name}"\n' for name in KERNELS))
    text = path.read_text().replace('["sphere", "torus"]', '["sphere"]')
    path.write_text(text)
    result = run("--plugins", plugins, "run", path, "--runs", runs)
    assert result.returncode == 3
    assert "Traceback" not in result.stderr
    by_method = {row["method"]: row for row in rows(runs / "t")[1].values() if row["method"] in KERNELS}
    assert by_method["typing_mistake"]["status"] == "failed"
    assert "plugins/typing_mistake/kernel.glsl:3" in by_method["typing_mistake"]["reason"]
    assert "hti" in by_method["typing_mistake"]["reason"]
    assert by_method["endless"]["status"] == "timeout"
    assert by_method["crashing"]["status"] == "crashed", by_method["crashing"]
    others = [row for row in rows(runs / "t")[1].values() if row["method"] not in KERNELS]
    assert [row["status"] for row in others] == ["ok"] * 4


def test_a_truncated_row_is_told_and_run_again(config, finished):
    path, runs = config(), finished
    victim = next((runs / "t" / "cells").glob("*.json"))
    victim.write_bytes(victim.read_bytes()[:100])
    again = run("run", path, "--runs", runs)
    assert again.returncode == 0
    assert victim.name in again.stderr
    assert "1 cell run, 7 reused" in again.stdout


def test_why_names_what_changed(config, finished):
    path, runs = config(), finished
    path.write_text(path.read_text().replace("size = 16", "size = 17"))
    assert run("run", path, "--runs", runs).returncode == 0
    key = rows(runs / "t")[0][0]["key"]
    told = run("why", key, "--runs", runs)
    assert told.returncode == 0
    assert "accuracy: size: 16 → 17" in told.stdout
    assert "program" not in told.stdout
    assert run("why", "zzz", "--runs", runs).returncode == 2
