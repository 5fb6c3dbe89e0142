"""Ask Slurm for machines by a small TOML file, through dask-jobqueue; each job runs `firsthit worker`."""

from __future__ import annotations

import contextlib
import importlib.util
import math
import shlex
import subprocess
import threading
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError, plural

EXAMPLE = 'jobs = 4\nqueue = "gpu"\nwalltime = "02:00:00"\ncores = 8\nmemory = "32GB"'


@dataclass(frozen=True)
class Asked:
    """State what to ask Slurm for.

    jobs: machines to ask for, each by a job of its own
    walltime: of a job, as Slurm writes it
    cores, memory: of a job
    queue, account: Slurm's; None: the site's own choice
    directives: further lines of `#SBATCH`, as "--gres=gpu:1"
    prologue: lines of shell that each job runs first, as "module load cuda"
    devices: names of the devices that a job offers; none: all that it finds
    python: the interpreter on the machines; None: this command's
    wait: seconds for which the first machine is waited for
    """

    jobs: int
    walltime: str
    cores: int
    memory: str
    queue: str | None = None
    account: str | None = None
    directives: tuple[str, ...] = ()
    prologue: tuple[str, ...] = ()
    devices: tuple[str, ...] = ()
    python: str | None = None
    wait: float = 3600.0
    scheduler: Mapping[str, Any] = field(default_factory=dict)


LOOK_SECONDS = 15.0  # between two looks at the queue
ANSWER_SECONDS = 30.0  # for Slurm to answer
TO_DO = "`squeue --me` tells which jobs wait, and a job's output says what went wrong; `wait` in the file may be longer"
MOST_ENDED = 10  # jobs that may end before the run does, for each that is asked for
NEEDED = ("jobs", "walltime", "cores", "memory")
_TYPES: dict[str, tuple[type, ...]] = {
    **dict.fromkeys(("jobs", "cores"), (int,)),
    **dict.fromkeys(("walltime", "memory", "queue", "account", "python"), (str,)),
    **dict.fromkeys(("directives", "prologue", "devices"), (list,)),
    "wait": (int, float),
    "scheduler": (dict,),
}


def read(path: Path) -> Asked:
    """Read what to ask Slurm for. Raises FirsthitError, with the file and the key, for what it cannot mean."""
    try:
        stated = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FirsthitError(f"cannot read {path}: {error.strerror or error}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FirsthitError(f"{path}: {error}") from None
    for key, value in stated.items():
        if key not in _TYPES:
            raise FirsthitError(f"{path}: unknown key {key!r}; known: {', '.join(_TYPES)}")
        fits = isinstance(value, _TYPES[key]) and not isinstance(value, bool)
        listed = not isinstance(value, list) or all(isinstance(one, str) for one in value)
        positive = not isinstance(value, int | float) or (math.isfinite(value) and value > 0)
        if not (fits and listed and positive):
            raise FirsthitError(f"{path}: {key} = {value!r:.60} is not what it must be; see docs/cluster.md")
    if missing := [key for key in NEEDED if key not in stated]:
        example = EXAMPLE.replace("\n", "; ")
        raise FirsthitError(f"{path}: {', '.join(missing)} missing; a whole file is: {example}")
    given: dict[str, Any] = {key: tuple(value) if isinstance(value, list) else value for key, value in stated.items()}
    return Asked(**given)


def options(asked: Asked) -> dict[str, Any]:
    """Return the options of dask-jobqueue's SLURMCluster that ask for this."""
    devices = [word for name in asked.devices for word in ("--device", shlex.quote(name))]
    given: dict[str, Any] = {
        "cores": asked.cores,
        "memory": asked.memory,
        "processes": 1,
        "walltime": asked.walltime,
        "queue": asked.queue,
        "account": asked.account,
        "job_extra_directives": list(asked.directives),
        "job_script_prologue": list(asked.prologue),
        "worker_command": "harness.cli worker",
        "worker_extra_args": ["--cores", str(asked.cores), *devices],
        "python": asked.python,
        "scheduler_options": {"dashboard": False, "dashboard_address": ":0", **asked.scheduler},
    }
    return {name: value for name, value in given.items() if value is not None}


def _try_out(path: Path, script: str) -> None:
    """Raise FirsthitError where Slurm would refuse a job of this script, with what it says; nothing is queued."""
    try:
        done = subprocess.run(["sbatch", "--test-only"], input=script, capture_output=True, text=True, check=False)
    except OSError as error:
        told = f"{path}: jobs are queued by sbatch, which does not run here: {error.strerror or error}"
        raise FirsthitError(told, exit_code=3) from None
    if done.returncode:
        said = "; ".join(done.stderr.split("\n")).strip("; ")
        raise FirsthitError(f"{path}: Slurm refuses the job: {said}", exit_code=3)


@contextlib.contextmanager
def started(path: Path, tell: Callable[[str], None]) -> Iterator[tuple[Any, float]]:
    """Start a scheduler here and ask Slurm for machines, for a block; yield the Dask cluster, and how long to wait.

    A job that ends gets a successor; all are cancelled after the block. Raises FirsthitError where the file is wrong,
    dask-jobqueue is missing or Slurm refuses such a job.
    """
    asked = read(path)
    if importlib.util.find_spec("dask_jobqueue") is None:
        told = f"{path}: Slurm is asked by the package dask-jobqueue: pip install 'firsthit[cluster]' dask-jobqueue"
        raise FirsthitError(told, exit_code=3)
    from dask_jobqueue.slurm import SLURMCluster

    with SLURMCluster(**options(asked)) as cluster:
        _try_out(path, cluster.job_script())
        cluster.scale(jobs=asked.jobs)
        tell(f"asked Slurm for {asked.jobs} machines by {path}; waiting up to {asked.wait:.0f} s for the first")
        with _replaced(cluster, asked.jobs, tell):
            yield cluster, asked.wait


@contextlib.contextmanager
def _replaced(cluster: Any, jobs: int, tell: Callable[[str], None]) -> Iterator[None]:
    """Ask for another job where one of the cluster has ended, for a block: its time may be up, or its machine down.

    dask-jobqueue takes such a job for a running one, since our workers have names of their own.
    """
    over = threading.Event()

    def look() -> None:
        ended: set[str] = set()
        while not over.wait(LOOK_SECONDS):
            known = {str(job.job_id) for job in list(cluster.workers.values()) if getattr(job, "job_id", None)}
            queued = _in_queue()
            lost = set() if queued is None else known - ended - queued
            ended |= lost
            if len(ended) > MOST_ENDED * jobs:
                tell(f"{len(ended)} jobs of Slurm have ended, so no further one is asked for")
                return
            if lost:
                names = ", ".join(sorted(lost))
                tell(f"{plural(len(lost), 'job')} of Slurm ({names}) ended; as many others are asked for")
                cluster.scale(jobs=jobs + len(ended))

    thread = threading.Thread(target=look, name="jobs of Slurm", daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()


def _in_queue() -> set[str] | None:
    """Return the numbers of this user's jobs that run or wait; None where Slurm does not answer."""
    try:
        told = subprocess.run(
            ["squeue", "--me", "--noheader", "--format=%i"],
            capture_output=True,
            text=True,
            check=False,
            timeout=ANSWER_SECONDS,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return None if told.returncode else set(told.stdout.split())
