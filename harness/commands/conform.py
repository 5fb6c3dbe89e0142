"""Offer `firsthit conform`: hold a method against the oracle and its own claims, as the tests check ours."""

from __future__ import annotations

import argparse
import itertools
import math
import textwrap
from collections import defaultdict
from collections.abc import Iterable

from harness import conformance, console
from harness.commands import Add
from harness.commands.options import add_jobs, add_timeout, methods_of, named_surface
from harness.conformance import Finding
from harness.contract import PRECISIONS, CellStatus, plural
from harness.devices.discovery import usable_devices
from harness.devices.executor import LocalExecutor
from harness.running.failures import Failure, mistakes

WIDTH = 100  # characters of a line


def add_parsers(add: Add) -> None:
    parser = add("conform", "firsthit --plugins DIR conform --method mine")
    parser.add_argument(
        "--method", action="append", metavar="NAME", help="may be repeated (default: all that cast rays)"
    )
    parser.add_argument(
        "--surface",
        action="append",
        metavar="NAME",
        help=f"may be repeated; all: every one (default: {', '.join(conformance.TYPICAL)})",
    )
    parser.add_argument("--device", action="append", metavar="NAME", help="may be repeated (default: every usable one)")
    add_jobs(parser)
    add_timeout(parser)
    parser.set_defaults(run=_conform)


def _conform(options: argparse.Namespace) -> int:
    import surfaces

    catalog = methods_of(options)
    names = options.method or conformance.checkable(catalog)
    plugins = [catalog.get(name) for name in names]
    wanted = surfaces.names() if options.surface == ["all"] else options.surface or conformance.TYPICAL
    chosen = [named_surface(name) for name in wanted]
    devices = usable_devices(options.device or ())
    executor = LocalExecutor(options.timeout)
    rows: list[tuple[str, str, Finding]] = []
    ended: list[Failure] = []
    try:
        with console.working() as tell:
            for plugin, info in itertools.product(plugins, devices):
                bench = conformance.bench_on(executor, info)
                found = []
                tell(f"conform: {plugin.method.name} on {info.name}")
                for where, finding in conformance.findings(bench, plugin, chosen):
                    found.append((plugin.method.name, where, finding))
                    tell(f"conform: {plugin.method.name} on {info.name}, {where}, checked: {finding.check}")
                tell("")
                print(told(info.name, found, options.verbose), flush=True)
                rows += found
                ended += [_failure(info.name, *one) for one in found if one[2].ended]
    finally:
        executor.close()
    for paragraph in mistakes(ended, "cases"):
        print(paragraph)
    failed = sum(finding.fails for *_, finding in rows)
    print(f"{plural(sum(not finding.unchecked for *_, finding in rows), 'check')}, {failed} failed")
    idle = sorted(set(names) - {name for name, _, finding in rows if not finding.unchecked})
    if idle:
        print(f"nothing was checked of {', '.join(idle)}: what is not checked does not conform")
    return 1 if failed or idle else 3 if catalog.broken and not options.method else 0


def _failure(device: str, method: str, where: str, finding: Finding) -> Failure:
    """Return the failure of a case whose program did not run to its end."""
    precision = next((word for word in PRECISIONS if word in where), "")
    case = where.replace(precision, "").replace(" ,", ",").strip(" ,")
    return Failure(method, where, device, precision, case, finding.detail, finding.ended or CellStatus.FAILED)


def told(device: str, found: Iterable[tuple[str, str, Finding]], verbose: bool) -> str:
    """Say what was found of one method on one device: a line for all that holds, a block for each check that fails.

    Cases whose program did not run to its end are only counted here: on other devices they fail for the same reason.
    """
    found = list(found)
    name = found[0][0] if found else "none"
    checked = [finding for *_, finding in found if not finding.unchecked]
    failing = [(where, finding) for _, where, finding in found if finding.fails]
    ended = sum(finding.ended is not None for *_, finding in found)
    beside = f"; {plural(ended, 'case')} did not run to the end, see below" if ended else ""
    hold = "holds" if len(checked) == 1 else "hold"
    held = f"{len(checked) - len(failing)} of {plural(len(checked), 'check')} {hold}"
    lines = [f"{name} on {device}: {held}{beside}"]
    if verbose:
        rows = [
            (finding.check, where, _outcome(finding), _number(finding.value), _number(finding.limit))
            for _, where, finding in found
        ]
        lines.append(textwrap.indent(console.table(("check", "where", "outcome", "measured", "at most"), rows), "  "))
    places: dict[str, list[str]] = defaultdict(list)
    for _, where, finding in found:
        if finding.unchecked:
            places[f"{finding.check}: {finding.unchecked}"].append(where)
    lines += [_wrapped("  not checked  ", f"{reason} ({'; '.join(where)})") for reason, where in places.items()]
    for where, finding in failing:
        if finding.ended:
            continue
        lines.append(f"  FAILS  {finding.check}  ({where})")
        measured = f"{_number(finding.value)}, at most {_number(finding.limit)} allowed"
        parts = {"measured": measured, "rule": finding.rule, "seen": finding.detail, "do": finding.advice}
        lines += [_wrapped(f"    {word:<10}", text) for word, text in parts.items() if text]
    return "\n".join(lines)


def _outcome(finding: Finding) -> str:
    return "not checked" if finding.unchecked else "FAILS" if finding.fails else "holds"


def _number(value: float) -> str:
    """Write a number with three digits; NaN, where nothing was measured, is `nothing`."""
    return "nothing" if math.isnan(value) else f"{value:.3g}"


def _wrapped(head: str, text: str) -> str:
    """Break a text into lines, which are indented as far as `head` reaches."""
    return textwrap.fill(text, WIDTH, initial_indent=head, subsequent_indent=" " * len(head), break_long_words=False)
