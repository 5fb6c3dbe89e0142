"""Offer `firsthit worker`: this machine's devices and cores for runs with --cluster."""

from __future__ import annotations

import argparse
import socket
import time

from harness import console
from harness.commands import Add
from harness.commands.options import tell, whole
from harness.contract import FirsthitError, plural
from harness.limits import Within

LOOK_SECONDS = 0.5
ANSWER_SECONDS = 3.0


def add_parsers(add: Add) -> None:
    parser = add(
        "worker",
        "firsthit worker lab1:8786",
        "Offer this machine to runs with --cluster: start a Dask worker for each device that works, and one for each "
        "core, which take the oracle's work. It goes on until Ctrl-C, also when the scheduler ends and comes back.",
    )
    parser.add_argument("address", metavar="ADDRESS", help="HOST:PORT of the scheduler that `dask scheduler` runs")
    help_ = "offer this device only; may be repeated (default: all that work)"
    parser.add_argument("--device", action="append", metavar="NAME", help=help_)
    help_ = "workers for work that needs no device, 0 for none (default: one for each core)"
    parser.add_argument("--cores", type=whole(Within(0, 4096)), metavar="N", help=help_)
    help_ = "what this machine is called in names of devices and in rows (default: its host name)"
    parser.add_argument("--machine", metavar="NAME", help=help_)
    for own in ("--name", "--nthreads", "--memory-limit", "--death-timeout", "--local-directory"):
        parser.add_argument(own, help=argparse.SUPPRESS)  # what dask-jobqueue says to any worker
    parser.set_defaults(run=_worker)


def _worker(options: argparse.Namespace) -> int:
    """Run this machine's workers until the command is stopped."""
    import os

    from harness.cluster import holder, starting
    from harness.cluster.supervisor import Supervisor
    from harness.devices.discovery import usable_devices
    from harness.devices.host import cores

    starting.need_dask("`firsthit worker`")
    address = starting.checked_address(options.address, "the scheduler")
    if options.machine:
        os.environ[holder.MACHINE] = options.machine
        if holder.machine() != options.machine:
            raise FirsthitError(f"--machine {options.machine!r}: write letters, digits, points, - and _")
    with console.doing("looking for this machine's devices"):
        try:
            names = [info.name for info in usable_devices(options.device or ())]
        except FirsthitError:
            if options.device or options.cores == 0:
                raise
            names = []
    count = (cores() or 1) if options.cores is None else options.cores
    offers = ", ".join([*names, *([plural(count, "core")] if count else [])])
    tell(f"firsthit: {holder.machine()} offers {offers} to {address}; Ctrl-C ends it")
    if not _answers(address):
        tell(f"firsthit: no scheduler answers at {address} yet; the workers wait for it")
    supervisor = Supervisor(address, names, count, holder.machine(), lambda line: tell(f"firsthit: {line}"))
    with starting.kept_running(supervisor):
        while True:
            time.sleep(LOOK_SECONDS)


def _answers(address: str) -> bool:
    host, _, port = address.rpartition("://")[2].rpartition(":")
    try:
        socket.create_connection((host.strip("[]"), int(port)), ANSWER_SECONDS).close()
    except OSError:
        return False
    return True
