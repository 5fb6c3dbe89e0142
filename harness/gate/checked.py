"""Check a config's cells without timing them: `firsthit gate` judges what they give, `firsthit bless` keeps it."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from harness.contract import FirsthitError
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
from harness.experiment import plan, reading
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.gate.baseline import Baseline
from harness.gate.chosen import ALL, Only
from harness.gate.entries import baseline_of, slot_of
from harness.gate.judge import Judged, Verdict, judge, tolerances_of
from harness.plugins import Catalog, find_methods
from harness.results.store import Row
from harness.running import batch
from harness.running.due import UNFINISHED
from harness.running.environment import describe
from harness.running.run import Watcher


@dataclass(frozen=True, eq=False)
class Checked:
    """Hold a config's cells and their rows, and what a baseline keeps of them."""

    experiment: Experiment
    catalog: Catalog
    planned: list[Planned]
    rows: dict[str, Row]  # of every planned cell, by its key
    now: Baseline
    folder: Path  # where the rows are stored
    earlier: frozenset[str] = frozenset()  # keys of the rows that are of an earlier run

    @property
    def unfinished(self) -> set[tuple[str, str]]:
        """Return slot and device of each cell that failed, timed out or crashed."""
        return {(slot_of(p), p.cell.device) for p in self.planned if self.rows[p.key]["status"] in UNFINISHED}

    def judged(self, before: Baseline) -> list[Judged]:
        """Judge every row against a baseline; the rows of devices that are not here are incomparable."""
        methods = {slot_of(p): p.cell.variant.method for p in self.planned}
        absent = [
            Judged(slot_of(p), p.cell.device, p.cell.variant.method, Verdict.INCOMPARABLE, str(p.skip))
            for p in self.planned
            if p.device is None
        ]
        return judge(self.now, before, methods, tolerances_of(self.experiment.config.gate.figures)) + absent

    def blessed(self, reason: str) -> Baseline:
        """Return what was found as a baseline that says when, why and at which commit it was blessed.

        Raises FirsthitError, with exit code 3, where a cell did not finish.
        """
        broken = [row for row in self.rows.values() if row["status"] in UNFINISHED]
        if broken:
            row = broken[0]
            message = f"not blessed: {len(broken)} cells did not finish, first {row['slot']}: {row['reason']}"
            raise FirsthitError(message, exit_code=3)
        environment = describe()
        dirty = " with uncommitted changes" if environment["dirty"] else ""
        blessing = {
            "blessed": datetime.now(UTC).date().isoformat(),
            "reason": reason,
            "commit": f"{environment['commit']}{dirty}",
        }
        devices = {key: facts | blessing for key, facts in self.now.devices.items()}
        return dataclasses.replace(self.now, devices=devices)


def check(
    config: Path,
    plugins: Path | None,
    devices: Sequence[str],
    runs: Path,
    watcher: Watcher,
    force: bool = False,
    only: Only = ALL,
) -> Checked:
    """Check the cells of a config that have no finished row yet below `runs`, without timing them.

    `plugins` is a folder of further methods; `devices`, where there are any, take the place of those that the config
    names. `only` says which cells are checked; with `force` all of these are checked again. `watcher` is told of each
    cell. Raises FirsthitError where the config cannot be planned.
    """
    catalog = find_methods(plugins)
    experiment = reading.load(config, catalog)
    for line in catalog.warnings:
        watcher.warned(line)
    if devices:
        chosen = dataclasses.replace(experiment.config, devices=list(devices))
        experiment = dataclasses.replace(experiment, config=chosen)
    whole = plan.plan(experiment, catalog, discover_devices(experiment.config.devices), timed=False)
    slots = only.slots(map(slot_of, whole))
    planned = [p for p in whole if slot_of(p) in slots]
    folder = runs / f"gate-{experiment.name}"
    executor = LocalExecutor(experiment.config.budget.timeout)
    try:
        rows, earlier = batch.rows_of(planned, experiment, catalog, folder, executor, watcher, force)
    finally:
        executor.close()
    watcher.failed([row for row in rows.values() if row["status"] in UNFINISHED])
    now = baseline_of(whole, rows, catalog, experiment.name, experiment.config.gate.same)
    return Checked(experiment, catalog, planned, rows, now, folder, earlier)
