"""plan, run, why, report: what one does with a config and its results."""

from __future__ import annotations

import argparse
import dataclasses
import shlex
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from harness import console, studies
from harness.contract import CellStatus, DeviceInfo, FirsthitError
from harness.devices.executor import LocalExecutor, discover_devices
from harness.experiment import config, identity, plan
from harness.experiment.plan import Planned
from harness.hardcases import groups
from harness.plugins import Catalog, find_methods
from harness.results.store import Row, Store
from harness.running.cards import card
from harness.running.environment import describe, probed
from harness.running.runner import UNFINISHED, Runner


def add_parsers(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    def add(name: str, help_text: str, example: str) -> argparse.ArgumentParser:
        parser = commands.add_parser(name, help=help_text, description=help_text, epilog=f"example: {example}")
        return parser

    parser = add("plan", "print a config's cells and how long they will take", "firsthit plan configs/quick.toml")
    _add_config(parser)
    parser.set_defaults(run=_plan)

    parser = add("run", "run a config; finished cells are reused", "firsthit run configs/quick.toml --retry failed")
    _add_config(parser)
    parser.add_argument("--force", action="store_true", help="run every cell again")
    parser.add_argument("--retry", choices=["failed"], help="run failed, timed out and crashed cells again")
    parser.add_argument("--device", action="append", metavar="NAME", help="run on this device only; may be repeated")
    parser.set_defaults(run=_run)

    parser = add(
        "why",
        "say what would make a cell run again, or what set it apart from its last result",
        "firsthit why runs/quick/cells/0123456789abcdef.json",
    )
    parser.add_argument("cell", help="a cell's key (or its beginning), or its file")
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="where to look (default: runs)")
    parser.set_defaults(run=_why)

    parser = add(
        "report",
        "make the PDF, HTML, CSV and Parquet of a run, or hold two runs against each other; runs nothing",
        "firsthit report runs/quick",
    )
    parser.add_argument("folder", type=Path, metavar="RUN", help="a folder below runs/")
    parser.add_argument("other", type=Path, metavar="OTHER", nargs="?", help="report what changed from RUN to OTHER")
    parser.add_argument(
        "--baseline",
        metavar="NAME",
        help="the method or variant that speed-ups are over (default: the config's, else ray_march)",
    )
    parser.set_defaults(run=_report)


def _add_config(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("config", type=Path, metavar="CONFIG", help="a TOML file, see configs/")
    parser.add_argument(
        "--runs", type=Path, default=Path("runs"), metavar="DIR", help="results go here (default: runs)"
    )


def _load(options: argparse.Namespace) -> tuple[config.Experiment, list[config.Experiment], Catalog, list[DeviceInfo]]:
    """The config, and what it stands for: itself, or those that it includes."""
    catalog = find_methods(options.plugins)
    whole = config.load(options.config, catalog)
    parts = [config.load(path, catalog) for path in whole.included] or [whole]
    if nested := [part.path for part in parts if part.included and part is not whole]:
        raise FirsthitError(
            f"{nested[0]} includes configs itself, so {whole.path} cannot include it; name them instead"
        )
    if getattr(options, "device", None):
        parts = [dataclasses.replace(p, config=dataclasses.replace(p.config, devices=options.device)) for p in parts]
    return whole, parts, catalog, discover_devices({name for part in parts for name in part.config.devices})


def _plan(options: argparse.Namespace) -> int:
    _, parts, catalog, devices = _load(options)
    for experiment in parts:
        _plan_one(experiment, catalog, devices, options)
    return 0


def _plan_one(
    experiment: config.Experiment, catalog: Catalog, devices: list[DeviceInfo], options: argparse.Namespace
) -> None:
    planned = plan.plan(experiment, catalog, devices)
    store = Store(options.runs / experiment.name)
    rows = {p.key: store.read(p.key) for p in planned}
    print(console.table(("key", "cell", "state"), [(p.key, p.cell.slot, _state(p, rows[p.key])) for p in planned]))
    left = plan.estimate_seconds(planned, store, experiment.config.budget.seconds)
    open_cells = sum(row is None for row in rows.values())
    print(f"{experiment.path}: {len(planned)} cells, {open_cells} to run, about {console.duration(left)}")


def _state(planned: Planned, row: Row | None) -> str:
    if row:
        return f"done: {row['status']}"
    return f"skip: {planned.skip}" if planned.skip else "to run"


def _run(options: argparse.Namespace) -> int:
    whole, parts, catalog, found = _load(options)
    if whole.included:
        told = _described(whole) | {"include": [part.name for part in parts], "devices": [], "cells": []}
        Store(options.runs / whole.name).write_plan(told)
    return max(_run_one(experiment, catalog, found, options) for experiment in parts)


def _described(experiment: config.Experiment) -> dict[str, Any]:
    """What every plan.json says first."""
    return {
        "name": experiment.name,
        "title": experiment.config.title,
        "config": str(experiment.path),
        "config_text": experiment.text,
        "baseline": experiment.config.baseline,
        "command": shlex.join(["firsthit", *sys.argv[1:]]),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "environment": describe(),
    }


def _run_one(
    experiment: config.Experiment, catalog: Catalog, found: list[DeviceInfo], options: argparse.Namespace
) -> int:
    store = Store(options.runs / experiment.name)
    executor = LocalExecutor(experiment.config.budget.timeout)
    try:
        chosen = plan.devices_of(experiment, found) if experiment.variants else {}
        tried = [probed(executor, info, store.folder / "probes") for info in chosen.values() if info]
        planned = plan.plan(experiment, catalog, [info for info, _ in tried]) if experiment.variants else []
        described = _described(experiment)
        store.write_plan(
            described
            | {
                "devices": [dataclasses.asdict(i) | {"versions": dict(i.versions), "probes": p} for i, p in tried],
                "cells": [{"slot": p.cell.slot, "key": p.key} for p in planned if not p.cell.family],
                "families": [{"slot": p.cell.slot, "key": p.key} for p in planned if p.cell.family],
                "family_facts": {name: groups.facts(name) for name in experiment.config.families},
                "methods": {v.method: card(catalog.get(v.method)) for v in experiment.variants},
                "studies": [{"study": name, "key": studies.key(name)} for name in experiment.config.studies],
            }
        )
        for name in experiment.config.studies:
            if options.force or not studies.is_done(name, store.folder):
                done = studies.run(name, store.folder)
                print(f"study {name}: {len(done['rows'])} rows, {console.duration(done['seconds'])}")
            else:
                print(f"study {name}: reused")
        before = {p.key: store.read(p.key) for p in planned}
        for message in store.unreadable.values():
            print(f"firsthit: {message}; running that cell again", file=sys.stderr)
        todo = [p for p in planned if _is_due(before[p.key], options)]
        progress = console.Progress(len(todo), plan.estimate_seconds(todo, store, experiment.config.budget.seconds))
        rows = Runner(experiment.config, catalog, store, executor, described["environment"], progress).run(todo)
    finally:
        executor.close()
    kept = [row for key, row in before.items() if row and key not in {row["key"] for row in rows}]
    return _summary(store.folder, rows, kept)


def _is_due(row: Row | None, options: argparse.Namespace) -> bool:
    return row is None or options.force or (options.retry == "failed" and row["status"] in UNFINISHED)


def _summary(folder: Path, rows: list[Row], kept: list[Row]) -> int:
    counts = {status: sum(row["status"] == status for row in (*rows, *kept)) for status in CellStatus}
    told = ", ".join(f"{count} {status}" for status, count in counts.items() if count)
    if told:
        print(f"{folder}: {len(rows)} cells run, {len(kept)} reused; {told}")
    for line in console.undecided((*rows, *kept)):
        print(f"firsthit: {line}", file=sys.stderr)
    for line in console.warnings(rows):
        print(f"firsthit: {line}", file=sys.stderr)
    return 3 if any(counts[status] for status in UNFINISHED) else 0


def _why(options: argparse.Namespace) -> int:
    key = Path(options.cell).stem
    matches = [p for p in sorted(options.runs.glob("*/cells/*.json")) if p.stem.startswith(key)]
    if len({path.stem for path in matches}) != 1:
        what = "several cells start" if matches else "no cell starts"
        raise FirsthitError(f"{what} with {key!r} below {options.runs}; see `firsthit plan CONFIG` for keys")
    store = Store(matches[0].parent.parent)
    row = store.read(matches[0].stem)
    if row is None:
        raise FirsthitError(f"{store.unreadable[matches[0].stem]}; `firsthit run` makes it again")
    print(f"{row['key']}  {row['slot']}\nrun {row['environment']['started']}: {row['status']}")
    if row["reason"]:
        print(f"reason: {row['reason']}")
    history = sorted(
        (other for other in store.rows() if other["slot"] == row["slot"]),
        key=lambda r: str(r["environment"]["started"]),
    )
    at = next(i for i, other in enumerate(history) if other["key"] == row["key"])
    if len(history) == 1:
        print("the only result of this cell so far")
    for word, older, newer in (("before", at - 1, at), ("after", at, at + 1)):
        if older >= 0 and newer < len(history):
            other = history[older if newer == at else newer]
            print(f"\n{word} it: {other['key']}, run {other['environment']['started']}; between the two changed:")
            for line in identity.changes(history[older]["identity"], history[newer]["identity"]):
                print(f"  {line}")
    if at == len(history) - 1:
        _why_again(row, find_methods(options.plugins))
    return 0


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
