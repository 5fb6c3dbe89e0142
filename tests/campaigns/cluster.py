"""Kill workers and the scheduler of a cluster at random moments while a config runs on it.

A trial starts a scheduler and `firsthit worker`, which serves each device of this machine by a process of its own, runs
a config on them again and again, and disturbs them until it has done so EACH times: one time it kills the scheduler,
which is started again at its address, one time it stops a worker of Dask so that it hangs, else it kills a worker or
its nanny. Each run must end by itself, with the rows of a run without a cluster. Where a step lost LOSSES workers one
after the other, which is what a step that ends its workers looks like, its cell is run again with `--retry failed`.
"""

from __future__ import annotations

import contextlib
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from harness.cluster.executor import LOSSES
from harness.devices.discovery import discover_devices
from tests.campaigns import frame, processes
from tests.campaigns.frame import Campaign, Fell, Place
from tests.campaigns.processes import Command

EACH = 12
CORES = 1
PAUSE = 0.05, 0.6  # between two disturbances, in times of what the workers need to start and say what they have
LONGEST = 900.0  # seconds of a run, after which it counts as one that hangs
STACKS = {"PYTHONFAULTHANDLER": "1"}  # so that a run that hangs tells where
CONFIG = """title = "Small"
surfaces = ["sphere", "torus"]
sizes = [16]
devices = {devices}
[[method]]
name = "newton"
[[method]]
name = "null"
[accuracy]
size = 8
[budget]
seconds = 0.3
rounds = 3
timeout = 300
"""


class Scheduler:
    """Hold a scheduler, which is started again at the same address after it was killed."""

    def __init__(self) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port: int = free.getsockname()[1]
        self.address = f"127.0.0.1:{port}"
        self._process = self._started()
        frame.ENDINGS.append(self.end)

    def _started(self) -> subprocess.Popen[bytes]:
        host, port = self.address.split(":")
        where = ("--host", host, "--port", port, "--no-dashboard")
        command = [sys.executable, "-m", "distributed.cli.dask_scheduler", *where]
        options = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        return subprocess.Popen(command, start_new_session=True, **options)

    def end(self) -> None:
        self._process.kill()
        self._process.wait()

    def replace(self) -> None:
        """Kill it, and start another one in its place."""
        self.end()
        self._process = self._started()


def prepare(shared: Path) -> None:
    """Run the config without a cluster, once for all trials, on all devices that work here."""
    names = [info.name for info in discover_devices() if not info.problem]
    (shared / "small.toml").write_text(CONFIG.format(devices=json.dumps(names)))
    code, told = Command(shared, ("run", "small.toml")).ended(within=1500.0)
    if code != 0:
        raise Fell(f"the run without a cluster ended with {code}: {told[-1500:]}")


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    own = place.own / "work"
    own.mkdir()
    shutil.copy(place.shared / "small.toml", own)
    scheduler, undisturbed = Scheduler(), processes.facts(place.shared / "runs")
    workers = Command(own, ("worker", scheduler.address, "--cores", str(CORES)))
    outcomes: Counter[str] = Counter()
    left = ["scheduler killed", "worker hung", *["worker killed"] * (EACH - 2)]
    dice.shuffle(left)
    number, pace = 0, 0.0
    while left:
        number += 1
        runs = f"runs{number}"
        pace = _disturb(dice, own, runs, workers, scheduler, left, outcomes, pace)
        processes.check_same(processes.facts(own / runs), undisturbed)
        processes.check_clean(own / runs)
    workers.process.send_signal(signal.SIGINT)
    code, told = workers.ended()
    if code != 130:
        raise Fell(f"`firsthit worker` ended with {code} after Ctrl-C: {told[-1500:]}")
    outcomes["runs that ended by themselves"] += number
    return outcomes


def _disturb(
    dice: random.Random,
    own: Path,
    runs: str,
    workers: Command,
    scheduler: Scheduler,
    left: list[str],
    outcomes: Counter[str],
    pace: float,
) -> float:
    """Run the config to its end, and do meanwhile what is next in `left`.

    Returns `pace`, the seconds in which workers start; where that is 0, how long the run took to find them.
    """
    finished: dict[str, bytes] = {}
    words = ("run", "small.toml", "--runs", runs, "--cluster", scheduler.address)
    command = Command(own, words, environment=STACKS)
    start = time.monotonic()
    end, after = start + LONGEST, 0.0
    while command.process.poll() is None:
        finished = _seen(own / runs, finished)
        if not after and _has_begun(own / runs):
            pace = pace or time.monotonic() - start
            after = time.monotonic() + pace * dice.uniform(*PAUSE)
        if left and after and time.monotonic() > after:
            if _done(dice, left[-1], workers, scheduler):
                outcomes[left.pop()] += 1
            after = time.monotonic() + pace * dice.uniform(*PAUSE)
        if time.monotonic() > end:
            command.process.send_signal(signal.SIGABRT)
            command.process.wait(60)
            told = command.told()
            raise Fell(f"`run --cluster` did not end within {LONGEST:.0f} s; it told {told[:2000]} … {told[-6000:]}")
        time.sleep(0.1)
    code, told = command.ended()
    if code == 3 and (lost := _lost(own / runs)):
        outcomes["cells given up after a step lost its worker again and again"] += len(lost)
        code, told = Command(own, (*words, "--retry", "failed"), environment=STACKS).ended(within=LONGEST)
        finished = {name: content for name, content in finished.items() if name not in lost}
    if code != 0:
        raise Fell(f"`run --cluster` ended with {code}: {told[-2500:]}")
    _seen(own / runs, finished)
    return pace


def _lost(runs: Path) -> list[str]:
    """Name the rows of cells that were given up since one step lost its worker again and again."""
    told = {name: json.loads(content) for name, content in processes.rows(runs).items()}
    given_up = f"lost its worker {LOSSES} times"
    return [name for name, row in told.items() if row["status"] == "crashed" and given_up in str(row["reason"])]


def _has_begun(runs: Path) -> bool:
    """Tell whether a run has found its devices, and written its plan."""
    return (runs / "small" / "plan.json").exists()


def _seen(runs: Path, finished: dict[str, bytes]) -> dict[str, bytes]:
    """Return the rows that are there. Raises Fell where one that was there is gone, or was made again."""
    now = processes.rows(runs)
    if lost := [name for name, content in finished.items() if now.get(name) != content]:
        raise Fell(f"finished cells are lost, or ran twice: {lost}")
    return now


def _done(dice: random.Random, what: str, workers: Command, scheduler: Scheduler) -> bool:
    """Kill the scheduler, or kill or stop a process that serves a device or a core; tell whether there was one."""
    if what == "scheduler killed":
        scheduler.replace()
        return True
    chosen = dice.choice((_is_worker, _is_nanny)) if what == "worker killed" else _is_worker
    number = signal.SIGKILL if what == "worker killed" else signal.SIGSTOP  # these processes block SIGTERM
    found = [pid for pid in workers.workers() if chosen(pid)]
    with contextlib.suppress(OSError):
        if found:
            os.kill(dice.choice(found), number)
            return True
    return False


def _is_worker(pid: int) -> bool:
    return b"spawn_main" in _command(pid)


def _is_nanny(pid: int) -> bool:
    return b"harness.cluster.serving" in _command(pid)


def _command(pid: int) -> bytes:
    reads: Callable[[], bytes] = Path(f"/proc/{pid}/cmdline").read_bytes
    try:
        return reads()
    except OSError:  # it has ended since
        return b""


CAMPAIGN = Campaign(
    name="cluster",
    tries="kills workers of a cluster, once in EACH times its scheduler, or stops a worker, while a config runs on it",
    promise="no finished cell lost or run twice, no run that does not end by itself, no figure other than that of a run"
    " without a cluster, no traceback, no process left behind",
    trial=_trial,
    small=0,  # a trial takes minutes; tests/test_cluster.py does the same with devices that sleep
    whole=60,
    each=EACH,
    prepare=prepare,
    limit=3600,
)
