"""`--cluster` and `firsthit worker` read what they are given, and need no more than they say."""

from __future__ import annotations

import importlib
import importlib.util
import os
import subprocess
import sys
import time
from importlib.metadata import distribution
from multiprocessing import Pipe
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import dask
import pytest

from harness import ROOT
from harness.cli import main
from harness.cluster import serving, slurm
from harness.cluster.supervisor import Supervisor
from harness.contract import FirsthitError
from tests.conftest import usable_devices
from tests.sleeping_device import until
from tests.test_light import _python
from tests.test_light import environment as environment

WHOLE = 'jobs = 2\nwalltime = "02:00:00"\ncores = 8\nmemory = "32GB"\n'


@pytest.mark.parametrize(
    ("where", "words"),
    [
        ("nowhere", "--cluster 'nowhere': write HOST:PORT of a Dask scheduler, as lab1:8786, or local[:N]"),
        ("local:many", "write local:N, where N cores"),
        ("missing.toml", "cannot read missing.toml: No such file"),
    ],
)
def test_a_cluster_that_is_none_is_told_in_a_line(
    where: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["run", "quick", "--cluster", where]) == 2
    told = capsys.readouterr().err
    assert words in told and "Traceback" not in told
    assert not (tmp_path / "runs").exists(), "nothing was begun"


def test_a_scheduler_that_does_not_answer_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("harness.cluster.starting.CONNECT_SECONDS", 0.2)
    assert main(["run", "quick", "--cluster", "127.0.0.1:9"]) == 3
    assert "no Dask scheduler answers at 127.0.0.1:9" in capsys.readouterr().err


def test_a_missing_dask_is_told(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *p: None if name == "distributed" else find(name, *p))
    for words in (["worker", "lab1:8786"], ["run", "quick", "--cluster", "local"]):
        assert main(words) == 3
        assert "needs the package distributed: pip install 'firsthit[cluster]'" in capsys.readouterr().err


def test_a_run_without_a_cluster_imports_no_dask() -> None:
    code = "import sys, harness.cli, harness.commands.experiment, harness.running.run, firsthit\n"
    code += "sys.exit(any(name in sys.modules for name in ('dask', 'distributed', 'harness.cluster')))"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, timeout=100, check=False).returncode == 0


def test_what_is_kept_quiet_in_a_worker_is_what_dask_does() -> None:
    importlib.import_module("distributed")  # whose settings are among Dask's then
    stated = {name: dask.config.get(name) for name in serving.QUIET}
    assert all(stated[name] != value for name, value in serving.QUIET.items()), stated


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("jobs = 2", "walltime, cores, memory missing; a whole file is: jobs = 4"),
        (WHOLE + "cpus = 3", "unknown key 'cpus'; known: jobs, cores"),
        (WHOLE.replace("2\n", "0\n", 1), "jobs = 0 is not what it must be"),
        (WHOLE + "devices = [1]", "devices = [1] is not what it must be"),
        (WHOLE + "wait = nan", "wait = nan is not what it must be"),
        ("jobs =", "Invalid value"),
    ],
)
def test_a_file_for_slurm_that_means_nothing_is_told(text: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "slurm.toml"
    path.write_text(text)
    with pytest.raises(FirsthitError) as raised:
        slurm.read(path)
    assert words in str(raised.value) and str(path) in str(raised.value)


def test_a_job_of_slurm_runs_the_worker_with_what_the_file_says(tmp_path: Path) -> None:
    path = tmp_path / "slurm.toml"
    path.write_text(WHOLE + 'queue = "gpu"\ndevices = ["opencl:nvidia"]\nprologue = ["module load cuda"]\n')
    options = slurm.options(slurm.read(path))
    assert options["worker_extra_args"] == ["--cores", "8", "--device", "opencl:nvidia"]
    assert options["job_script_prologue"] == ["module load cuda"] and "account" not in options
    jobs = pytest.importorskip("dask_jobqueue.slurm", reason="dask-jobqueue is not installed")
    own = {name: value for name, value in options.items() if name != "scheduler_options"}
    script = jobs.SLURMJob(scheduler="tcp://lab1:8786", name="job-1", **own).job_script()
    assert "#SBATCH -p gpu" in script and "module load cuda" in script
    line = next(line for line in script.splitlines() if "harness.cli worker" in line)
    parsed = _parsed(line.split("harness.cli ")[1].split())
    assert parsed.address == "tcp://lab1:8786" and parsed.cores == 8 and parsed.device == ["opencl:nvidia"]


def stand_in(folder: Path, name: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a program of Slurm's, a text of shell, before all others."""
    (folder / name).write_text(f"#!/bin/sh\n{text}\n")
    (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(folder), prepend=os.pathsep)


def test_what_slurm_refuses_is_told_before_anything_waits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "slurm.toml"
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(FirsthitError, match=r"slurm.toml: jobs are queued by sbatch, which does not run here: No such"):
        slurm._try_out(path, "#!/bin/sh\n")
    monkeypatch.undo()
    stand_in(
        tmp_path,
        "sbatch",
        'test "$1" = --test-only && echo "Invalid partition name specified" >&2; exit 1',
        monkeypatch,
    )
    with pytest.raises(FirsthitError, match=r"slurm.toml: Slurm refuses the job: Invalid partition name specified$"):
        slurm._try_out(path, "#!/bin/sh\n")
    stand_in(tmp_path, "sbatch", "exit 0", monkeypatch)
    slurm._try_out(path, "#!/bin/sh\n")


class Jobs:
    """What is used of a Dask cluster whose workers are jobs: `asked` is what scale was called with."""

    def __init__(self, count: int) -> None:
        self.workers: dict[str, SimpleNamespace] = {}
        self.asked: list[int] = []
        self.scale(count)

    def scale(self, jobs: int) -> None:
        self.asked.append(jobs)
        self.workers.update({str(n): SimpleNamespace(job_id=str(n)) for n in range(len(self.workers), jobs)})


def test_for_a_job_of_slurm_that_ends_another_one_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(slurm, "LOOK_SECONDS", 0.01)
    monkeypatch.setattr(slurm, "MOST_ENDED", 2)
    stand_in(tmp_path, "squeue", f"cat {tmp_path}/queue || exit 1", monkeypatch)
    cluster, told = Jobs(2), list[str]()
    with slurm._replaced(cluster, 2, told.append):
        time.sleep(0.2)  # squeue fails, which says nothing of jobs
        assert cluster.asked == [2] and not told
        for queue, asked in (("1\n", 3), ("1\n2\n", 3), ("2\n", 4), ("", 6)):
            (tmp_path / "new").write_text(queue)
            (tmp_path / "new").replace(tmp_path / "queue")
            until(lambda asked=asked: cluster.asked[-1] >= asked)
        until(lambda: "no further one" in told[-1])
    assert cluster.asked[:3] == [2, 3, 4] and len(cluster.asked) < 6
    assert told[0] == "1 job of Slurm (0) ended; as many others are asked for"


def _parsed(words: list[str]) -> object:
    from harness.cli import build_parser

    return build_parser(words).parse_args(words)


SERVES = """
import pickle, sys
from distributed import Nanny, Worker
from harness.cluster import holder, serving, starting, supervisor

for name in sys.argv[1:]:
    (info, probes), = pickle.loads(holder.announce({name: 1.0})["said"]).devices
    assert probes and not info.problem, info.problem
    held = holder.Holder(60.0, 0.5)
    said = pickle.loads(held.step(pickle.dumps(("fingerprint", (name,), info.resident is None, []))))
    assert said[0] == "ok", said
    held.close()
assert holder.announce({"cores": 1.0})["code"]
print("ready")
"""


def _needed(name: str, found: set[str]) -> set[str]:
    """Return a package, and all that it cannot be installed without."""
    from packaging.requirements import Requirement

    if name not in found:
        found.add(name)
        for text in distribution(name).requires or []:
            requirement = Requirement(text)
            if requirement.marker is None or requirement.marker.evaluate({"extra": ""}):
                _needed(requirement.name, found)
    return found


def test_a_worker_needs_the_engine_and_no_more(environment: dict[str, str]) -> None:
    folder = Path(environment["PYTHONPATH"])
    for name in _needed("distributed", set()):
        for file in distribution(name).files or []:
            link = folder / file.parts[0]
            if file.parts[0] not in ("..", "__pycache__") and not link.exists():
                link.symlink_to(str(distribution(name).locate_file(file.parts[0])))
    names = [info.name for info in usable_devices()][-1:]  # one that works will do
    result = _python(environment, "-c", SERVES, *names)
    assert result.stdout == "ready\n", result.stderr


def test_a_worker_that_cannot_be_started_is_told_in_a_line(monkeypatch: pytest.MonkeyPatch) -> None:
    async def killed(**_: object) -> None:
        raise RuntimeError("Nanny failed to start.") from OSError("its process was killed")

    monkeypatch.setattr(serving, "serve", killed)
    monkeypatch.setattr(serving.process, "die_with_parent", lambda: None)
    monkeypatch.setattr(serving, "Connection", int)
    with pytest.raises(SystemExit, match="a worker could not be started: OSError: its process was killed"):
        serving.main("{}", "3")


def test_what_a_worker_has_started_ends_with_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def start(_module: str, _words: list[str], _what: str, options: dict[str, Any]) -> tuple[Any, Any]:
        script = f"sleep 300 & echo $! > {tmp_path}/pid.new; mv {tmp_path}/pid.new {tmp_path}/pid; exec sleep 300"
        return subprocess.Popen(["sh", "-c", script], **options), Pipe()[0]

    monkeypatch.setattr("harness.cluster.supervisor.process.start", start)
    monkeypatch.setattr("harness.cluster.supervisor.END_SECONDS", 0.0)
    supervisor = Supervisor("lab1:8786", (), 1, "lab1", lambda _: None)
    supervisor.look()
    until((tmp_path / "pid").exists)
    started = int((tmp_path / "pid").read_text())
    supervisor.close()
    until(lambda: not Path(f"/proc/{started}/stat").exists() or " Z " in Path(f"/proc/{started}/stat").read_text())
