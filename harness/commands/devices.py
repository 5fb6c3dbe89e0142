"""Offer `firsthit devices`: which devices are here, and what their arithmetic and clocks are worth."""

from __future__ import annotations

import argparse
import contextlib
from datetime import UTC, datetime
from typing import Any

from harness import console
from harness.commands import Add
from harness.contract import DeviceInfo
from harness.devices import kept_answers
from harness.devices.discovery import known_devices
from harness.devices.executor import START_SECONDS, LocalExecutor
from harness.running.environment import kept_probes, probed

HEADER = (
    *("name", "title", "driver", "units", "float64", "clock"),
    *("two_sum", "two_prod fma", "two_prod split", "nearest", "division", "GFLOP/s"),
)
SHARES = ("two_sum", "two_prod_fma", "two_prod_split", "round_to_nearest", "division")


def add_parsers(add: Add) -> None:
    parser = add("devices", "firsthit devices")
    parser.add_argument("--again", action="store_true", help="look and measure anew, whatever is kept of before")
    parser.set_defaults(run=_devices)


def _share(value: float | None) -> str:
    """Write a share as per cent; `-` where it was not measured."""
    return "-" if value is None else f"{value:.2%}".replace(".00%", "%")


def _peak(gflops: float) -> str:
    """Write a peak to one digit.

    Two probes of a device may differ by tens of per cent, and by more where other programs run.
    """
    return f"{float(f'{gflops:.0e}'):,g}"


def _row(info: DeviceInfo, found: dict[str, Any]) -> tuple[str, ...]:
    """Return what the table says of a device under HEADER; `found` is what its probes found, or empty."""
    units = "-" if info.compute_units is None else str(info.compute_units)
    head = (info.name, info.title, info.driver, units, "yes" if info.float64 else "no")
    if not found:
        return (*head, *["-"] * 7)
    return (*head, info.clock, *(_share(found[key]) for key in SHARES), _peak(found["peak_gflops"]))


def _devices(options: argparse.Namespace) -> int:
    """Print the devices, measured now or before; the exit code is 3 where none is usable."""
    with console.doing("looking for devices"):
        known = known_devices(again=options.again)
    since, tried = [known.since], []
    folder, executor = kept_answers.probes_folder(), LocalExecutor(START_SECONDS)
    try:
        for info in known.devices:
            before, when = kept_probes(info, folder) if folder and not options.again else ({}, 0.0)
            since += [when] if before else []
            with contextlib.nullcontext() if before or info.problem else console.doing(f"measuring {info.name}"):
                tried.append(probed(executor, info, folder, options.again))
    finally:
        executor.close()
    print(console.table(HEADER, [_row(info, found) for info, found in tried]))
    for info, _ in tried:
        if info.problem:
            print(f"{info.name}: {info.problem}")
    if ages := [age for age in since if age is not None]:
        oldest = datetime.fromtimestamp(min(ages), UTC).strftime("%Y-%m-%d %H:%M UTC")
        print(f"Some of this was found on {oldest}, and kept; `firsthit devices --again` finds all of it anew.")
    return 0 if any(not info.problem for info, _ in tried) else 3
