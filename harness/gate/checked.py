"""Check a config's cells without timing them: `firsthit gate` judges what they give, `firsthit bless` keeps it."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from harness.contract import FirsthitError, plural
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
from harness.devices.fingerprint import Fingerprint
from harness.devices.interface import lost, told_lost
from harness.experiment import plan, reading
from harness.experiment.config import FASTEST, Experiment
from harness.experiment.plan import Planned
from harness.experiment.size import check_size
from harness.gate.baseline import Baseline
from harness.gate.chosen import Only
from harness.gate.comparable import held_against
from harness.gate.entries import asked_of, baseline_of, facts_of, slot_of
from harness.gate.foretold import others
from harness.gate.judge import Judged, Verdict, judge, tolerances_of
from harness.plugins import Catalog, find_methods
from harness.results.lock import Lock
from harness.results.store import Row, Store
from harness.running import batch
from harness.running.due import UNFINISHED
from harness.running.environment import describe, fingerprinted, kept_fingerprint
from harness.running.failures import first_line
from harness.running.fastest import settled
from harness.running.run import Watcher


@dataclass(frozen=True, eq=False)
class Prepared:
    """Hold a config's cells before any of them has run: all of them in `whole`, those that are chosen in `planned`."""

    experiment: Experiment
    catalog: Catalog
    whole: list[Planned]
    planned: list[Planned]

    def chosen(self, only: Only) -> Prepared:
        """Choose the cells that `only` names. Raises FirsthitError where it names none."""
        slots = only.slots(map(slot_of, self.whole))
        return dataclasses.replace(self, planned=[p for p in self.whole if slot_of(p) in slots])

    def incomparable(self, before: Baseline) -> list[Judged]:
        """Judge the rows that cannot be held against a baseline, whatever they give: incomparable ones and new ones."""
        found = []
        for p in self.planned:
            slot, method = slot_of(p), p.cell.variant.method
            asked = asked_of(p)
            held = str(p.skip) if p.device is None else held_against(slot, asked, facts_of(p.device, {}), before)
            if held is None:
                found.append(Judged(slot, p.cell.device, method, Verdict.NEW, "not in the baseline; bless to gate it"))
            elif isinstance(held, str):
                found.append(Judged(slot, p.cell.device, method, Verdict.INCOMPARABLE, held))
        return found

    def lock(self, runs: Path, command: str, wait: bool, watcher: Watcher) -> Lock:
        """Make the lock of the folder below `runs` that `check` stores rows in."""
        return Lock(runs / f"gate-{self.experiment.name}", command, wait=wait, doing=watcher.doing)

    def check(self, lock: Lock, watcher: Watcher, force: bool = False) -> Checked:
        """Check the cells that have no finished row yet in the folder of `lock`, without timing them.

        With `force` all cells are checked again. `watcher` is told of each cell. The cells of a device that does not
        tell how it computes fail for that reason, and none of them runs. The lock is taken if any cell is to be
        checked. Raises FirsthitError where it is another's.
        """
        folder = lock.folder
        executor = LocalExecutor(self.experiment.config.budget.timeout, self.experiment.config.budget.memory)
        try:
            arithmetic, untold = self._arithmetic(executor, folder / "probes", watcher)
            whole, planned = ([_without(p, untold) for p in cells] for cells in (self.whole, self.planned))
            stated = planned, self.experiment.config, self.catalog, Store(folder), executor, watcher, lock
            rows, earlier = batch.rows_of(*stated, force)
        finally:
            executor.close()
        watcher.failed([row for row in rows.values() if row["status"] in UNFINISHED])
        now = baseline_of(whole, rows, self.catalog, self.experiment.name, arithmetic)
        return Checked(self.experiment, self.catalog, whole, planned, rows, now, folder, earlier)

    def _arithmetic(
        self, executor: LocalExecutor, cache: Path, watcher: Watcher
    ) -> tuple[dict[str, Fingerprint], dict[str, str]]:
        """Return the fingerprints of the chosen cells' devices, and why others have none, by the devices' names."""
        usable = {p.device.name: p.device for p in self.planned if p.device and not p.device.problem}
        arithmetic, untold = {}, {}
        for name, info in usable.items():
            kept = kept_fingerprint(info, cache)[0]
            with nullcontext() if kept else watcher.doing(f"taking the fingerprint of {name}'s arithmetic"):
                try:
                    arithmetic[name] = fingerprinted(executor, info, cache)
                except FirsthitError as error:
                    untold[name] = str(error)
        return arithmetic, untold


@dataclass(frozen=True, eq=False)
class Checked(Prepared):
    """Hold a config's cells and their rows, and what a baseline keeps of them."""

    rows: dict[str, Row]  # of every planned cell, by its key
    now: Baseline
    folder: Path  # where the rows are stored
    earlier: frozenset[str] = frozenset()  # keys of the rows that are of an earlier run

    @property
    def unfinished(self) -> set[tuple[str, str]]:
        """Return slot and device of each cell that failed, timed out or crashed."""
        return {(slot_of(p), p.cell.device) for p in self.planned if self.rows[p.key]["status"] in UNFINISHED}

    def judged(self, before: Baseline) -> list[Judged]:
        """Judge every row against a baseline.

        The rows of devices that are not here are incomparable, and so are those of methods that cannot be asked.
        """
        methods = {slot_of(p): p.cell.variant.method for p in self.planned}
        absent = [
            Judged(slot_of(p), p.cell.device, p.cell.variant.method, Verdict.INCOMPARABLE, str(p.skip))
            for p in self.planned
            if p.device is None
        ]
        gate = self.experiment.config.gate
        told = judge(self.now, before, methods, tolerances_of(gate.figures, gate.last_bits))
        failures = {(slot_of(p), p.cell.device): p.failure for p in self.planned if p.failure}
        return [_failed(one, failures.get((one.slot, one.device))) for one in told] + absent

    def blessed(self, reason: str) -> Baseline:
        """Return what was found as a baseline that says when, why and at which commit it was blessed.

        Raises FirsthitError, with exit code 3, where a cell did not finish.
        """
        broken = [row for row in self.rows.values() if row["status"] in UNFINISHED]
        if broken:
            row = broken[0]
            why = first_line(row["reason"] or row["status"])
            message = f"not blessed: {plural(len(broken), 'cell')} did not finish, first {row['slot']}: {why}"
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


def _without(planned: Planned, untold: Mapping[str, str]) -> Planned:
    """Return a cell as it is or, if `untold` has a reason against its device, as one that fails for it."""
    reason = untold.get(planned.cell.device)
    if reason is None or planned.skip is not None or planned.failure is not None:
        return planned
    return dataclasses.replace(planned, failure=reason, casting=None)


def _failed(judged: Judged, failure: str | None) -> Judged:
    """Return the verdict on a row: incomparable if its cell failed, for `failure`, before it ran."""
    if failure is None:
        return judged
    return dataclasses.replace(judged, verdict=Verdict.INCOMPARABLE, reason=failure, changes=(), rule="")


def prepare(
    config: Path, plugins: Path | None, devices: Sequence[str], watcher: Watcher, yes: bool = False
) -> Prepared:
    """Plan the cells of a config, all of which are chosen; none of them is to be timed.

    `plugins` is a folder of further methods; `devices`, where there are any, take the place of those that the config
    names. `watcher` is told of warnings. Raises FirsthitError where the config cannot be planned, or has more cells
    than are planned without `yes` (harness.experiment.size).
    """
    catalog = find_methods(plugins).with_stand_ins()
    experiment = reading.load_one(config, catalog)
    for line in catalog.warnings:
        watcher.wrong(line)
    experiment = experiment.on(devices)
    if told := check_size(experiment, catalog, yes=yes):
        watcher.warned(told)
    wanted = experiment.wanted_devices()
    with watcher.doing(f"looking for devices and preparing the cells of {config}") as tell:
        found = discover_devices(wanted)
        if not {"all", "any", FASTEST, *(info.name for info in found)} & set(wanted):
            if gone := [info for name in wanted if (info := lost(name, found))]:
                raise told_lost(gone)
            here = ", ".join(f"--device {name}" for name in others(set(wanted))) or "no device here can be used"
            raise FirsthitError(f"there is no device {', '.join(wanted)} here; name one that is: {here}", exit_code=3)
        (experiment,) = settled([experiment], found, watcher).parts
        check_size(experiment, catalog, found, yes)
        planned = plan.plan(experiment, catalog, found, timed=False, tell=tell)
    return Prepared(experiment, catalog, planned, planned)
