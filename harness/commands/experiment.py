"""Offer `firsthit plan`, `run`, `why` and `report`: what one does with a config and its results."""

from __future__ import annotations

import argparse
import shlex
import sys
from pathlib import Path

from harness import console
from harness.commands import Add
from harness.commands.options import tell
from harness.commands.printer import Printer
from harness.contract import DeviceInfo, FirsthitError
from harness.experiment import config, identity, plan
from harness.experiment.plan import Planned
from harness.plugins import Catalog, find_methods
from harness.results.history import past_of
from harness.results.store import Row, Store
from harness.running.due import due, estimate_seconds
from harness.running.run import Loaded, load, remarks, run


def add_parsers(add: Add) -> None:
    parser = add("plan", "firsthit plan quick")
    _add_config(parser)
    parser.set_defaults(run=_plan)

    parser = add("run", "firsthit run quick --retry failed")
    _add_config(parser)
    parser.add_argument("--force", action="store_true", help="run every cell again")
    parser.add_argument("--retry", choices=["failed"], help="run failed, timed out and crashed cells again")
    parser.add_argument("--device", action="append", metavar="NAME", help="run on this device only; may be repeated")
    parser.set_defaults(run=_run)

    parser = add("why", "firsthit why runs/quick/cells/0123456789abcdef.json")
    parser.add_argument("cell", help="a cell's key (or its beginning), or its file")
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="where to look (default: runs)")
    parser.set_defaults(run=_why)

    parser = add("report", "firsthit report runs/quick")
    parser.add_argument("folder", type=Path, metavar="RUN", help="a folder below runs/")
    parser.add_argument("other", type=Path, metavar="OTHER", nargs="?", help="report what changed from RUN to OTHER")
    parser.add_argument(
        "--baseline",
        metavar="NAME",
        help="the method or variant that speed-ups are over (default: the config's, else ray_march)",
    )
    parser.set_defaults(run=_report)


def _add_config(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("config", type=Path, metavar="CONFIG", help="a TOML file, or a name of `firsthit list configs`")
    parser.add_argument(
        "--runs", type=Path, default=Path("runs"), metavar="DIR", help="results go here (default: runs)"
    )


def _load(options: argparse.Namespace) -> Loaded:
    return load(options.config, options.plugins, getattr(options, "device", None) or (), Printer())


def _plan(options: argparse.Namespace) -> int:
    loaded = _load(options)
    for part in loaded.parts:
        _plan_one(part, loaded.catalog, loaded.devices, options)
    return 0


def _plan_one(
    experiment: config.Experiment, catalog: Catalog, devices: list[DeviceInfo], options: argparse.Namespace
) -> None:
    """Print a config's cells, and how long those that must run will take; on standard error what is to be known."""
    for told in remarks(experiment):
        tell(f"firsthit: {told}")
    planned = plan.plan(experiment, catalog, devices)
    store = Store(options.runs / experiment.name)
    found = due(planned, store)
    states = [(p.key, p.cell.slot, _state(p, found.kept.get(p.key))) for p in planned]
    print(console.table(("key", "cell", "state"), states))
    left = estimate_seconds(found.todo, store, experiment.config.budget.seconds)
    print(f"{experiment.path}: {len(planned)} cells, {len(found.todo)} to run, about {console.duration(left)}")


def _state(planned: Planned, row: Row | None) -> str:
    if row:
        return f"done: {row['status']}"
    return f"skip: {planned.skip}" if planned.skip else "to run"


def _run(options: argparse.Namespace) -> int:
    command = shlex.join(["firsthit", *sys.argv[1:]])
    retry = options.retry == "failed"
    found = run(_load(options), options.runs, command, force=options.force, retry_failed=retry, watcher=Printer())
    return 3 if found.unfinished else 0


def _why(options: argparse.Namespace) -> int:
    """Print what set a cell apart from its last result and its next, and what would make it run again now."""
    past = past_of(Path(options.cell).stem, options.runs)
    row = past.row
    print(f"{row['key']}  {row['slot']}\nrun {row['environment']['started']}: {row['status']}")
    if row["reason"]:
        print(f"reason: {row['reason']}")
    if not past.before and not past.after:
        print("the only result of this cell so far")
    if past.before:
        _print_changes("before", past.before, past.before, row)
    if past.after:
        _print_changes("after", past.after, row, past.after)
    else:
        _why_again(row, find_methods(options.plugins))
    return 0


def _print_changes(word: str, other: Row, older: Row, newer: Row) -> None:
    """Print what changed between two results of a cell; `other` is the one that is not asked about."""
    print(f"\n{word} it: {other['key']}, run {other['environment']['started']}; between the two changed:")
    for line in identity.changes(older["identity"], newer["identity"]):
        print(f"  {line}")


def _why_again(row: Row, catalog: Catalog) -> None:
    """Print what changed in the harness, the method and this machine since a cell's newest row was made."""
    changed = identity.since(row["identity"], catalog)
    if not changed:
        print(
            "\nsince then nothing changed in the harness, the method or the packages; a config may ask for another cell"
        )
        return
    print("\nsince then changed, so that it would run again:")
    for line in changed:
        print(f"  {line}")


def _report(options: argparse.Namespace) -> int:
    """Build a report. Raises FirsthitError if a package is missing, or if --baseline is given with two runs."""
    try:
        from reports import compare, report

        if options.other:
            if options.baseline:
                raise FirsthitError("--baseline goes with one run: of two, each cell is held against itself")
            print(compare.build(options.folder, options.other))
        else:
            print(report.build(options.folder, options.baseline))
    except ModuleNotFoundError as error:
        message = (
            f"a report needs the package {error.name}: pip install 'firsthit[report]'; runs/ can be copied elsewhere"
        )
        raise FirsthitError(message, exit_code=3) from None
    return 0
