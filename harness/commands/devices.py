"""Offer `firsthit devices`: which devices are here, and what their arithmetic and clocks are worth."""

from __future__ import annotations

import argparse
import contextlib
import dataclasses
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.answers import listed
from harness.commands.machine import Answer, add_json
from harness.contract import DeviceInfo, FirsthitError
from harness.devices import kept_answers
from harness.devices.discovery import known_devices
from harness.devices.executor import START_SECONDS, LocalExecutor
from harness.devices.fingerprint import Fingerprint, digests
from harness.devices.probes import Probes
from harness.running.environment import fingerprinted, kept_fingerprint, kept_probes, probed

HEADER = (
    *("name", "title", "driver", "units", "float64", "clock"),
    *("two_sum", "two_prod fma", "two_prod split", "nearest", "division", "GFLOP/s"),
)
# Digests of fingerprints: where two are equal, the devices answer alike, to the last bit
ALIKE = ("arithmetic", "float32", "float64", "raster")
Tried = tuple[DeviceInfo, Probes | None, Fingerprint | None]  # what a look at a device found
SHARES = ("two_sum", "two_prod_fma", "two_prod_split", "round_to_nearest", "division")


def add_parsers(add: Add) -> None:
    parser = add("devices", "firsthit devices")
    parser.add_argument("--again", action="store_true", help="look and measure anew, whatever is kept of before")
    add_json(parser)
    parser.set_defaults(run=_devices)


def _share(value: float | None) -> str:
    """Write a share as per cent; `-` where it was not measured."""
    return "-" if value is None else f"{value:.2%}".replace(".00%", "%")


def _peak(gflops: float) -> str:
    """Write a peak to one digit.

    Two probes of a device may differ by tens of per cent, and by more where other programs run.
    """
    return f"{float(f'{gflops:.0e}'):,g}"


def _row(info: DeviceInfo, found: Probes | None) -> tuple[str, ...]:
    """Return what the table says of a device under HEADER; `found` is what its probes found."""
    units = "-" if info.compute_units is None else str(info.compute_units)
    head = (info.name, info.title, info.driver, units, "yes" if info.float64 else "no")
    if found is None:
        return (*head, *["-"] * 7)
    return (*head, info.clock, *(_share(getattr(found, name)) for name in SHARES), _peak(found.peak_gflops))


def _alike(devices: dict[str, Fingerprint]) -> list[tuple[str, ...]]:
    """Return the rows under ALIKE: a digest for each precision, and the first device above that has the same one."""
    first: dict[tuple[str, str], str] = {}
    rows = []
    for name, found in devices.items():
        short, cells = digests(found), []
        for of in ALIKE[1:]:
            same = first.setdefault((of, short[of]), name) if of in short else name
            cells.append(short.get(of, "-") + ("" if same == name else f" (as {same})"))
        rows.append((name, *cells))
    return rows


def _kept(info: DeviceInfo, folder: Path | None, again: bool) -> list[float]:
    """Return when what is kept of a device was found: of its probes and of its fingerprint, where they are kept."""
    if folder is None or again:
        return []
    return [when for found, when in (kept_probes(info, folder), kept_fingerprint(info, folder)) if found]


def _look(executor: LocalExecutor, info: DeviceInfo, folder: Path | None, again: bool) -> Tried:
    """Return a device, its probes and its fingerprint; if one of them cannot be had, the device's problem says why."""
    info, probes = probed(executor, info, folder, again)
    if info.problem:
        return info, probes, None
    try:
        return info, probes, fingerprinted(executor, info, folder, again)
    except FirsthitError as error:
        return dataclasses.replace(info, problem=str(error)), probes, None


def _devices(options: argparse.Namespace) -> int | Answer:
    """Tell of the devices, measured now or before; the exit code is 3 where none is usable."""
    with console.doing("looking for devices"):
        known = known_devices(again=options.again)
    since, tried = [known.since], list[Tried]()
    folder, executor = kept_answers.probes_folder(), LocalExecutor(START_SECONDS)
    try:
        for info in known.devices:
            since += (before := _kept(info, folder, options.again))
            all_is_kept = len(before) == 2 or info.problem
            with contextlib.nullcontext() if all_is_kept else console.doing(f"measuring {info.name}"):
                tried.append(_look(executor, info, folder, options.again))
    finally:
        executor.close()
    oldest = min((age for age in since if age is not None), default=None)
    when = None if oldest is None else datetime.fromtimestamp(oldest, UTC)
    code = 0 if any(not info.problem for info, _, _ in tried) else 3
    if options.json:
        return Answer(listed.Devices(_facts(tried), when.isoformat(timespec="seconds") if when else None), code)
    _print(tried, when)
    return code


def _print(tried: Sequence[Tried], when: datetime | None) -> None:
    """Print the tables of devices; `when` is the time when the oldest of this was found, if it was not now."""
    print(console.table(HEADER, [_row(info, probes) for info, probes, _ in tried]))
    if devices := {info.name: found for info, _, found in tried if found}:
        print("\n" + console.table(ALIKE, _alike(devices)))
    for info, _, _ in tried:
        if info.problem:
            print(f"{info.name}: {info.problem}")
    if when:
        told = f"Some of this was found on {when:%Y-%m-%d %H:%M UTC}, and kept"
        print(f"{told}; `firsthit devices --again` finds all of it anew.")


def _facts(tried: Sequence[Tried]) -> list[listed.MeasuredDevice]:
    first: dict[tuple[str, str], str] = {}
    devices = []
    for info, probes, fingerprint in tried:
        short = digests(fingerprint or {})
        measured = listed.MeasuredDevice(
            **vars(listed.device(info)),
            probes=listed.ProbeFacts(**dataclasses.asdict(probes)) if probes else None,
            fingerprint=fingerprint or {},
            digests=short,
            alike={of: first.setdefault((of, found), info.name) for of, found in short.items()},
        )
        devices.append(measured)
    return devices
