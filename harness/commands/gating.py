"""gate, bless: a config held against a blessed baseline."""

from __future__ import annotations

import argparse
import dataclasses
import sys
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from harness.commands import Add
from harness.commands.options import writable
from harness.contract import FirsthitError
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
from harness.experiment import plan, reading
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.experiment.shipped import located
from harness.gate import against, baseline, outputs
from harness.gate.baseline import Baseline
from harness.gate.entries import baseline_of, slot_of
from harness.gate.judge import Judged, Tolerance, Verdict, exit_code, judge, rank, tolerances_of
from harness.gate.revision import programs_at
from harness.plugins import Catalog, find_methods
from harness.results.figures import SPEED
from harness.results.store import Row
from harness.results.writing import write_atomically
from harness.running import batch
from harness.running.due import UNFINISHED
from harness.running.environment import describe, probed


def add_parsers(add: Add) -> None:
    parser = add(
        "gate",
        "firsthit gate configs/gate.toml --junit gate.xml",
        "Check every cell of a config (untimed) and hold errors, wrong rays, claims and evaluations "
        "against a blessed baseline. Exit codes: 0 nothing got worse, 1 a row regressed or is missing, 2 usage, "
        "3 a row could not be run or compared.",
    )
    _add_shared(parser)
    parser.add_argument("--junit", type=Path, metavar="FILE", help="write the verdicts as JUnit XML")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="write a summary as Markdown")
    parser.add_argument("--github", action="store_true", help="print annotations for GitHub Actions")
    parser.add_argument("--against", metavar="REV", help="also time every cell against this git revision's program")
    parser.set_defaults(run=_gate)

    parser = add(
        "bless",
        'firsthit bless configs/gate.toml --reason "newton stops at a smaller step"',
        "Check every cell of a config (untimed) and write its results into the baseline, for the devices "
        "here; what the baseline holds of other machines is kept.",
    )
    _add_shared(parser)
    parser.add_argument("--reason", required=True, metavar="TEXT", help="why the results are as they should be")
    parser.set_defaults(run=_bless)


def _add_shared(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("config", type=Path, metavar="CONFIG", help="a TOML file, or a name of `firsthit list configs`")
    parser.add_argument(
        "--baseline", type=Path, metavar="FILE", help="default: baselines/NAME.toml beside the config NAME.toml"
    )
    parser.add_argument("--runs", type=Path, default=Path("runs"), metavar="DIR", help="rows go here (default: runs)")
    parser.add_argument("--device", action="append", metavar="NAME", help="on this device only; may be repeated")
    parser.add_argument("--force", action="store_true", help="run every cell again")


@dataclass(frozen=True, eq=False)
class _Checked:
    """A config's cells and rows, and what a baseline keeps of them."""

    experiment: Experiment
    catalog: Catalog
    planned: list[Planned]
    rows: dict[str, Row]
    now: Baseline


def _path(options: argparse.Namespace) -> Path:
    path: Path = options.baseline or options.config.parent / "baselines" / options.config.name
    return path


def _checked(options: argparse.Namespace) -> _Checked:
    """Run what is not stored yet, without timing it."""
    catalog = find_methods(options.plugins)
    experiment = reading.load(options.config, catalog)
    if options.device:
        chosen = dataclasses.replace(experiment.config, devices=options.device)
        experiment = dataclasses.replace(experiment, config=chosen)
    planned = plan.plan(experiment, catalog, discover_devices(experiment.config.devices), timed=False)
    executor = LocalExecutor(experiment.config.budget.timeout)
    try:
        folder = options.runs / f"gate-{experiment.name}"
        rows = batch.rows_of(planned, experiment, catalog, folder, executor, options.force)
    finally:
        executor.close()
    now = baseline_of(planned, rows, catalog, experiment.name, experiment.config.gate.same)
    return _Checked(experiment, catalog, planned, rows, now)


def _gate(options: argparse.Namespace) -> int:
    options.config = located(options.config)
    for path in filter(None, (options.junit, options.markdown)):
        writable(path)
    path = _path(options)
    before = baseline.read(path)
    checked = _checked(options)
    methods = {slot_of(p): p.cell.variant.method for p in checked.planned}
    judged = judge(checked.now, before, methods, tolerances_of(checked.experiment.config.gate.figures))
    judged += _absent(checked)
    judged += _speed(options, checked) if options.against else []
    judged.sort(key=rank)
    broken = {(slot_of(p), p.cell.device) for p in checked.planned if checked.rows[p.key]["status"] in UNFINISHED}
    code = exit_code(judged, broken)
    _tell(options, checked, judged, path, code)
    return code


def _absent(checked: _Checked) -> list[Judged]:
    """Rows on devices that are not here."""
    return [
        Judged(slot_of(p), p.cell.device, p.cell.variant.method, Verdict.INCOMPARABLE, str(p.skip))
        for p in checked.planned
        if p.device is None
    ]


def _speed(options: argparse.Namespace, checked: _Checked) -> list[Judged]:
    """Each timed cell's speed against another revision's program, by the clock that the device's probes believe."""
    experiment = checked.experiment
    here = {p.cell.device: p.device for p in checked.planned if p.device}
    own = experiment.config.gate.figures.get(SPEED.name)
    tolerance = Tolerance("lower", own.absolute, own.relative) if own else Tolerance("lower", 0.0, SPEED.relative)
    former = programs_at(options.against, options.config, options.plugins, list(here))
    folder = options.runs / f"gate-{experiment.name}"
    executor = LocalExecutor(experiment.config.budget.timeout)
    try:
        infos = [probed(executor, info, folder / "probes")[0] for info in here.values()]
        answering = [p for p in plan.plan(experiment, checked.catalog, infos) if p.skip is None]
        return against.compare(answering, former, experiment, tolerance, executor, folder / "truth")
    finally:
        executor.close()


def _tell(options: argparse.Namespace, checked: _Checked, judged: list[Judged], path: Path, code: int) -> None:
    title = checked.experiment.name
    if options.junit:  # files before the table, whose reader may go away
        write_atomically(options.junit, outputs.junit(judged, title).encode())
    if options.markdown:
        write_atomically(options.markdown, outputs.markdown(judged, title, path, code).encode())
    print(outputs.table(judged))
    if options.github:
        kernels = {name: plugin.folder / "kernel.glsl" for name, plugin in checked.catalog.plugins.items()}
        if written := outputs.github(judged, kernels):
            print(written)
    if any(j.verdict is Verdict.INCOMPARABLE for j in judged):
        print("firsthit: incomparable is no pass; bless the baseline on this machine and device", file=sys.stderr)


def _bless(options: argparse.Namespace) -> int:
    if not options.reason.strip():
        raise FirsthitError("--reason: say why the results are as they should be")
    options.config = located(options.config)
    path = _path(options)
    old = baseline.read(path) if path.exists() else Baseline()
    checked = _checked(options)
    broken = [row for row in checked.rows.values() if row["status"] in UNFINISHED]
    if broken:
        row = broken[0]
        message = f"not blessed: {len(broken)} cells did not finish, first {row['slot']}: {row['reason']}"
        raise FirsthitError(message, exit_code=3)
    environment = describe()
    dirty = " with uncommitted changes" if environment["dirty"] else ""
    blessing = {
        "blessed": datetime.now(UTC).date().isoformat(),
        "reason": options.reason.strip(),
        "commit": f"{environment['commit']}{dirty}",
    }
    devices = {key: facts | blessing for key, facts in checked.now.devices.items()}
    made = dataclasses.replace(checked.now, devices=devices)
    baseline.write(path, baseline.merged(old, made))
    total = sum(map(len, made.rows.values()))
    print(f"{path}: {total} rows blessed on {', '.join(facts['name'] for facts in devices.values())}")
    return 0
