"""Open the cluster that --cluster names: a scheduler's address, `local`, or a file that says what to ask Slurm for."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import re
import threading
from collections.abc import Callable, Collection, Iterator
from pathlib import Path
from typing import Any

from harness import spreading
from harness.cluster import holder, serving, slurm
from harness.cluster.engine import PATIENCE_SECONDS, Engine
from harness.cluster.fleet import ANY, ClusterFleet
from harness.cluster.spread import ClusterSpread
from harness.cluster.supervisor import Supervisor
from harness.contract import FirsthitError
from harness.devices.discovery import discover_devices
from harness.devices.host import cores
from harness.running.run import Read

CONNECT_SECONDS = 30.0
LOOK_SECONDS = 0.5  # between two looks at this machine's workers
MOST_CORES = 4096
LOGGING = "DASK_LOGGING__DISTRIBUTED"  # how much Dask writes, which a user may say too
Tell = Callable[[str], None]
_PLACE = re.compile(r"(?:(?:tcp|tls|ws|wss)://)?(?:\[[0-9A-Fa-f:.]+\]|[\w.-]+):\d{1,5}")


@contextlib.contextmanager
def opened(text: str, given: Read, tell: Tell) -> Iterator[ClusterFleet]:
    """Open a cluster for the run of a config in a block: HOST:PORT of a scheduler, local[:N], or a TOML file for Slurm.

    `tell` hears of what is started, lost and found again. While the block runs, the cluster's cores take the oracle's
    work. What was started for it is ended after it. Raises FirsthitError where the text says no cluster, Dask is
    missing, or nothing answers.
    """
    need_dask("--cluster")
    wanted = list(dict.fromkeys(name for part in given.parts for name in part.wanted_devices()))
    with _opened(text, wanted, tell) as fleet, spreading.over(ClusterSpread(fleet.engine, spreading.taker())):
        yield fleet


@contextlib.contextmanager
def _opened(text: str, wanted: Collection[str], tell: Tell) -> Iterator[ClusterFleet]:
    if text == "local" or text.startswith("local:"):
        with _local(_count(text), wanted, tell) as fleet:
            yield fleet
    elif text.endswith(".toml"):
        with (
            slurm.started(Path(text), tell) as (cluster, seconds),
            _watched(cluster, text, tell, max(seconds, PATIENCE_SECONDS)) as engine,
        ):
            yield ClusterFleet(engine, seconds, to_do=slurm.TO_DO)
    else:
        address = checked_address(text, "--cluster")
        with _watched(address, address, tell) as engine:
            yield ClusterFleet(engine, PATIENCE_SECONDS)


def need_dask(what: str) -> None:
    """Raise FirsthitError where Dask is not installed; `what` needs it."""
    if importlib.util.find_spec("distributed") is None:
        raise FirsthitError(f"{what} needs the package distributed: pip install 'firsthit[cluster]'", exit_code=3)
    os.environ.setdefault(LOGGING, "critical")  # here, and in the workers: what is lost is told by the engine


def checked_address(text: str, what: str) -> str:
    """Return the address of a scheduler. Raises FirsthitError, which begins with `what`, for a text that is none."""
    if not _PLACE.fullmatch(text):
        told = "write HOST:PORT of a Dask scheduler, as lab1:8786"
        also = ", or local[:N], or a TOML file for Slurm (docs/cluster.md)" if what == "--cluster" else ""
        raise FirsthitError(f"{what} {text!r}: {told}{also}")
    return text


@contextlib.contextmanager
def _watched(address: Any, told: str, tell: Tell, patience: float = PATIENCE_SECONDS) -> Iterator[Engine]:
    """Watch the cluster of a scheduler, given by address or as a Dask cluster, for a block."""

    def connect() -> Any:
        from dask.distributed import Client

        serving.hush()
        return Client(address, timeout=CONNECT_SECONDS)  # type: ignore[no-untyped-call]

    try:
        engine = Engine(connect, told, tell, patience)
    except OSError as error:
        start = "start one with `dask scheduler`, and on each machine `firsthit worker HOST:PORT`"
        raise FirsthitError(f"no Dask scheduler answers at {told} ({error}); {start}", exit_code=3) from None
    try:
        yield engine
    finally:
        engine.close()


@contextlib.contextmanager
def _local(count: int | None, wanted: Collection[str], tell: Tell) -> Iterator[ClusterFleet]:
    """Run a scheduler in this process, and workers of this machine: one for each device, and `count` for its cores."""
    from dask.distributed import LocalCluster

    offered = [info.name for info in discover_devices(name.partition("@")[0] for name in wanted) if not info.problem]
    plain = {name.partition("@")[0] for name in wanted}
    names = [name for name in offered if name in plain or not plain.isdisjoint(ANY)]
    workers = (cores() or 1) if count is None else count
    options: dict[str, Any] = {"n_workers": 0, "dashboard_address": None, "host": "127.0.0.1"}
    with LocalCluster(**options) as cluster:  # type: ignore[no-untyped-call]
        address = cluster.scheduler_address
        supervisor = Supervisor(address, names, workers, holder.machine(), tell)
        with kept_running(supervisor), _watched(address, address, tell) as engine:
            yield ClusterFleet(engine, PATIENCE_SECONDS, names)


@contextlib.contextmanager
def kept_running(supervisor: Supervisor) -> Iterator[None]:
    """Keep a machine's workers running for a block, in a thread."""
    ended = threading.Event()
    supervisor.look()

    def look() -> None:
        while not ended.wait(LOOK_SECONDS):
            with contextlib.suppress(FirsthitError):  # one cannot be started now, as where memory is short
                supervisor.look()

    thread = threading.Thread(target=look, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        supervisor.close()


def _count(text: str) -> int | None:
    """Return N of `local:N`; None for `local`. Raises FirsthitError where it is no number of cores."""
    if text == "local":
        return None
    number = text.removeprefix("local:")
    if not number.isdecimal() or not 0 <= int(number) <= MOST_CORES:
        raise FirsthitError(f"--cluster {text!r}: write local:N, where N cores (0 to {MOST_CORES}) take other work")
    return int(number)
