"""Kill workers and the scheduler of a cluster at random moments while a config runs on it.

A trial starts a scheduler and `firsthit worker`, which serves each device of this machine by a process of its own, runs
a config on them again and again, and kills until it has killed EACH times: one time the scheduler, which is started
again at its address, else a worker of Dask or its nanny. Each run must end by itself, with the rows of a run without a
cluster.
"""

from __future__ import annotations

import contextlib
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

from tests.campaigns import frame, processes
from tests.campaigns.frame import Campaign, Fell, Place
from tests.campaigns.processes import Command, done

EACH = 11
CORES = 1
PAUSE = 1.5, 6.0  # seconds between two kills
CONFIG = """title = "Small"
surfaces = ["sphere", "torus"]
sizes = [16]
devices = ["all"]
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


class _Scheduler:
    """Hold a scheduler, which is started again at the same address after it was killed."""

    def __init__(self) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port: int = free.getsockname()[1]
        self._process = self._started()
        frame.ENDINGS.append(self.end)

    def _started(self) -> subprocess.Popen[bytes]:
        where = ("--host", "127.0.0.1", "--port", str(self.port), "--no-dashboard")
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
    """Run the config without a cluster, once for all trials."""
    (shared / "small.toml").write_text(CONFIG)
    done(shared, "run", "small.toml")


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    shutil.copy(place.shared / "small.toml", place.own)
    scheduler, undisturbed = _Scheduler(), processes.facts(place.shared / "runs")
    address = f"127.0.0.1:{scheduler.port}"
    workers = Command(place.own, ("worker", address, "--cores", str(CORES)))
    outcomes: Counter[str] = Counter()
    kills = ["scheduler", *["worker"] * (EACH - 1)]
    dice.shuffle(kills)
    number = 0
    while kills:
        number += 1
        _disturb(dice, place.own, f"runs{number}", address, workers, scheduler, kills, outcomes)
        processes.check_same(processes.facts(place.own / f"runs{number}"), undisturbed)
        processes.check_clean(place.own / f"runs{number}")
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
    address: str,
    workers: Command,
    scheduler: _Scheduler,
    kills: list[str],
    outcomes: Counter[str],
) -> None:
    """Run the config to its end, and kill meanwhile what is next in `kills`."""
    command = Command(own, ("run", "small.toml", "--runs", runs, "--cluster", address))
    finished: dict[str, bytes] = {}
    after = time.monotonic() + dice.uniform(*PAUSE)
    while command.process.poll() is None:
        finished = _seen(own / runs, finished)
        if kills and time.monotonic() > after and (_told_devices(own / runs)):
            what = kills.pop()
            outcomes[f"{what} killed"] += _kill(dice, what, workers, scheduler)
            after = time.monotonic() + dice.uniform(*PAUSE)
        time.sleep(0.1)
    code, told = command.ended()
    if code != 0:
        raise Fell(f"`run --cluster` ended with {code}: {told[-2500:]}")
    _seen(own / runs, finished)


def _told_devices(runs: Path) -> bool:
    """Tell whether the run has begun: it has found its devices, and written its plan."""
    return (runs / "small" / "plan.json").exists()


def _seen(runs: Path, finished: dict[str, bytes]) -> dict[str, bytes]:
    """Return the rows that are there. Raises Fell where one that was there is gone, or was made again."""
    now = processes.rows(runs)
    if lost := [name for name, content in finished.items() if now.get(name) != content]:
        raise Fell(f"finished cells are lost, or ran twice: {lost}")
    return now


def _kill(dice: random.Random, what: str, workers: Command, scheduler: _Scheduler) -> int:
    """Kill the scheduler, or a process of Dask's that serves devices or cores; return how many were killed."""
    if what == "scheduler":
        scheduler.replace()
        return 1
    chosen = dice.choice((_is_worker, _is_nanny))
    found = [pid for pid in workers.workers() if chosen(pid)]
    with contextlib.suppress(OSError):
        if found:
            os.kill(dice.choice(found), dice.choice((signal.SIGKILL, signal.SIGTERM)))
    return 1


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
    tries="kills workers of a cluster, and its scheduler once in EACH times, while a config runs on it",
    promise="no finished cell lost or run twice, no run that does not end by itself, no figure other than that of a run"
    " without a cluster, no traceback, no process left behind",
    trial=_trial,
    small=0,  # a trial takes minutes; tests/test_cluster.py does the same with devices that sleep
    whole=55,
    each=EACH,
    prepare=prepare,
    limit=1800,
)
