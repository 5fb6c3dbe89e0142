"""conform: a method against the oracle, its own claims and itself, as the tests check ours."""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from harness import conformance, console, dense
from harness.backends import LANGUAGES
from harness.conformance import Bench, Finding
from harness.contract import PRECISIONS, DeviceInfo, FirsthitError, Hits, Program, Surface
from harness.executor import CellError, LocalExecutor, discover_devices
from harness.plugins import Plugin, find_methods


def add_parsers(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    text = "check a method's answers, claims and knobs as the tests check ours; exit code 1 where a check fails"
    parser = commands.add_parser(
        "conform", help=text, description=text, epilog="example: firsthit --plugins DIR conform --method mine"
    )
    parser.add_argument("--method", action="append", metavar="NAME", help="may be repeated (default: all)")
    parser.add_argument(
        "--surface",
        action="append",
        metavar="NAME",
        help=f"may be repeated; all: every one (default: {', '.join(conformance.TYPICAL)})",
    )
    parser.add_argument("--device", action="append", metavar="NAME", help="may be repeated (default: every usable one)")
    parser.add_argument("--timeout", type=float, default=60.0, metavar="SECONDS", help="for one step (default: 60)")
    parser.set_defaults(run=_conform)


def _conform(options: argparse.Namespace) -> int:
    import surfaces

    catalog = find_methods(options.plugins)
    names = options.method or [name for name, plugin in catalog.plugins.items() if plugin.method.answers]
    plugins = [catalog.get(name) for name in names]
    wanted = surfaces.names() if options.surface == ["all"] else options.surface or conformance.TYPICAL
    chosen = [surfaces.get(name) for name in wanted]
    devices = _devices(options.device)
    executor = LocalExecutor(options.timeout)
    rows: list[tuple[str, ...]] = []
    try:
        for plugin, info in itertools.product(plugins, devices):
            bench = _bench(executor, info.name, info.float64)
            for finding, where in _findings(bench, plugin, chosen):
                word = "holds" if finding.holds else "FAILS"
                rows.append((plugin.method.name, finding.check, where, info.name, word, finding.detail))
    finally:
        executor.close()
    print(console.table(("method", "check", "where", "device", "outcome", "detail"), rows))
    failed = sum(row[4] == "FAILS" for row in rows)
    print(f"{len(rows)} checks, {failed} failed")
    return 1 if failed else 0


def _devices(names: list[str] | None) -> list[DeviceInfo]:
    usable = {info.name: info for info in discover_devices() if not info.problem}
    for name in names or ():
        if name not in usable:
            raise FirsthitError(f"no usable device {name!r}; there are {', '.join(usable) or 'none'}")
    if not usable:
        raise FirsthitError("no usable device; `firsthit devices` says why", exit_code=3)
    return [usable[name] for name in names or usable]


def _bench(executor: LocalExecutor, device: str, float64: bool) -> Bench:
    def run(program: Program, rays: NDArray[np.float32]) -> Hits:
        return executor.check(device, program, rays).hits

    return Bench(device, LANGUAGES[device.partition(":")[0]], float64, run)


def _findings(bench: Bench, plugin: Plugin, chosen: list[Surface]) -> list[tuple[Finding, str]]:
    """Every check of a method on a device; a step that fails, hangs or crashes is a finding that says no."""
    found: list[tuple[Finding, str]] = []

    def gather(where: str, findings: Iterable[Finding]) -> None:
        try:
            found.extend((finding, where) for finding in findings)
        except (CellError, FirsthitError) as error:
            found.append((Finding("runs", False, str(error).splitlines()[0]), where))

    for surface, precision in itertools.product(chosen, PRECISIONS):
        where = f"{surface.name} {precision}"
        if reason := conformance.refusal(plugin, surface, precision, bench):
            found.append((Finding("accepts", True, f"not checked: {reason}"), where))
        else:
            gather(where, conformance.examine(bench, plugin, conformance.view_case(surface), precision))
    for where, case, precision in dense.cases(bench, plugin):
        gather(where, conformance.examine(bench, plugin, case, precision))
    for precision in PRECISIONS:
        gather(f"touches {precision}", conformance.examine_touches(bench, plugin, precision))
    gather("float32", conformance.examine_knobs(bench, plugin))
    return found
