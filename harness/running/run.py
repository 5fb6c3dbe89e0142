"""Run a config into a folder: what `firsthit run` and firsthit.run share.

Nothing is printed here. A Watcher is told what happens, and may print it.
"""

from __future__ import annotations

import dataclasses
import threading
from collections import ChainMap, Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from harness import ROOT, console, memory, studies
from harness.contract import CellStatus, DeviceInfo, LostDevice, plural
from harness.devices.discovery import discover_devices
from harness.devices.executor import LocalExecutor
from harness.devices.host import Host
from harness.devices.probes import Probes
from harness.devices.steps import Executor
from harness.experiment import kinds, plan, reading, shards, targets
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.experiment.shards import Shard, Share
from harness.experiment.shipped import located
from harness.experiment.size import cells_of, check_size
from harness.hardcases import groups
from harness.oracle import cache
from harness.plugins import Catalog, find_methods
from harness.results.lock import locked
from harness.results.store import Row, Store
from harness.results.stored import Rows, Stored
from harness.results.writing import sweep_below
from harness.running.cards import card
from harness.running.due import UNFINISHED, Again, begin, estimate_seconds, studies_due
from harness.running.environment import describe, probed
from harness.running.failures import failure_of, mistakes
from harness.running.fastest import Tried, settled
from harness.running.fleet import Fleet
from harness.running.packing import Packing
from harness.running.runner import Runner


@dataclass(frozen=True, eq=False)
class Read:
    """Hold a config as it was read, before anybody has looked for devices."""

    whole: Experiment
    parts: tuple[Experiment, ...]  # the config itself, or those that it includes
    catalog: Catalog
    yes: bool  # plans of any size are run
    shard: Shard | None = field(default=None, kw_only=True)  # None: the whole config
    machine: str | None = field(default=None, kw_only=True)  # the name that rows tell; None: its name in its network

    def folder(self, runs: Path, one: Experiment) -> Path:
        """Return the folder of the results of the config, or of one that it includes."""
        return runs / (self.shard.named(one.name) if self.shard else one.name)

    def shares(self) -> list[Share | None]:
        """Return what the shard has of each part; None for a part that is run whole."""
        return [*shards.shares(self.parts, self.catalog, self.shard)] if self.shard else [None] * len(self.parts)


@dataclass(frozen=True, eq=False)
class Loaded(Read):
    """Hold a config, and all that is needed to plan and run it here."""

    devices: list[DeviceInfo]  # of the backends that the config names
    tried: Mapping[str, Tried] = field(default_factory=dict)  # what was measured of devices already, by their names
    hosts: Mapping[str, Host] = field(default_factory=dict)  # machines of devices that are not this one's, by device


@dataclass(frozen=True, eq=False)
class Run:
    """Hold what a run left behind: the folder that reports read, and the row of every cell that its config names."""

    folder: Path
    rows: Rows  # of the cells that were run now, in the order in which they ended; each is read when it is asked for
    reused: Rows = field(default_factory=Rows)  # of the cells that were already finished
    lost: tuple[str, ...] = ()  # devices whose workers died when they were looked for or tried, each with what happened

    def __repr__(self) -> str:
        """Return one line: the folder, and how many cells ended how."""
        told = ", ".join(f"{count} {status}" for status, count in self.counts.items() if count)
        return f"Run({str(self.folder)!r}: {len(self.rows)} run, {len(self.reused)} reused; {told or 'no cells'})"

    @property
    def counts(self) -> dict[CellStatus, int]:
        """Return how many rows have each status; every status is a key."""
        found = Counter((*self.rows.statuses, *self.reused.statuses))
        return {status: found[status] for status in CellStatus}

    @property
    def unfinished(self) -> int:
        """Return how many cells failed, timed out or crashed."""
        return sum(self.counts[status] for status in UNFINISHED)


class Watcher:
    """Hear what a run does, and do nothing about it. A caller overrides the methods that it needs.

    hears_builds: what to call with a cell's slot and what was built for it; None: nothing
    """

    hears_builds: Callable[[str, str], None] | None = None

    def doing(self, what: str) -> AbstractContextManager[Callable[[str], None]]:
        """Hear what goes on while a block runs that takes long; the block tells more to what it is given."""
        del what
        return nullcontext(lambda _: None)

    def told(self, line: str) -> None:
        """Hear what was done beside running cells."""

    def warned(self, line: str) -> None:
        """Hear what the caller should know before the results are used."""

    def wrong(self, line: str) -> None:
        """Hear what is wrong, though the work goes on."""
        self.warned(line)

    def starts(self, cells: int, seconds: float, devices: Mapping[str, int]) -> None:
        """Hear how many cells will be run, an estimate of how long that takes, and how many each device has."""

    def cell(self, slot: str, row: Row | None) -> None:
        """Hear which cell is worked on or, with a `row`, that the cell has ended and what its row is."""

    def failed(self, rows: Sequence[Row]) -> None:
        """Hear which cells did not finish, once all are done."""

    def ended(self, part: Run) -> None:
        """Hear that a config, or one of those that it includes, is done."""


class Teller(Watcher):
    """Tell what a run does to a function that takes a line of text."""

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell, self._left = tell, 0

    def told(self, line: str) -> None:
        self._tell(line)

    def warned(self, line: str) -> None:
        self._tell(line)

    def starts(self, cells: int, seconds: float, devices: Mapping[str, int]) -> None:
        del devices
        self._left = cells
        self._tell(f"{plural(cells, 'cell')} to run, about {console.duration(seconds)}")

    def cell(self, slot: str, row: Row | None) -> None:
        if row:
            self._left -= 1
            self._tell(f"{slot}: {console.outcome(row)}; {self._left} left")

    def failed(self, rows: Sequence[Row]) -> None:
        for paragraph in mistakes(map(failure_of, rows), "cells"):
            self._tell(paragraph)

    def ended(self, part: Run) -> None:
        for line in (*console.undecided(part.rows + part.reused), *console.warnings(part.rows)):
            self._tell(line)


def teller(tell: Callable[[str], None] | None) -> Watcher:
    """Make a watcher that calls `tell` with lines of text; without a function it does nothing."""
    return Watcher() if tell is None else Teller(tell)


def read(
    name: str | Path,
    plugins: Path | None = None,
    devices: Sequence[str] = (),
    watcher: Watcher | None = None,
    yes: bool = False,
    *,
    shard: str | None = None,
    machine: str | None = None,
) -> Read:
    """Read a config, given by path or by the name of one that firsthit ships.

    `plugins` is a folder of further methods; `devices` take the place of those that the config names. `shard`, such as
    "3/16", is the part that is run, `machine` the name of this machine that rows tell. Raises FirsthitError where there
    is no such config, something in it is wrong, it includes configs that include others, it has more cells than are
    planned without `yes` (harness.experiment.size), or there is no such shard.
    """
    part_of = None if shard is None else shards.read(shard)
    catalog, hears = find_methods(plugins).with_stand_ins(), watcher or Watcher()
    whole, parts = reading.load_all(located(name), catalog)
    for line in catalog.warnings:
        hears.wrong(line)
    parts = [part.on(devices) for part in parts]
    for told in [check_size(part, catalog, yes=yes) for part in parts]:
        if told:
            hears.warned(told)
    return Read(whole, tuple(parts), catalog, yes, shard=part_of, machine=machine)


def load(given: Read, watcher: Watcher | None = None, fleet: Fleet | None = None) -> Loaded:
    """Look for the devices that a config names, here or in a `fleet`.

    Raises FirsthitError for too many cells on the devices found.
    """
    hears, parts = watcher or Watcher(), given.parts
    named = {device for part in parts for device in part.wanted_devices()}
    with hears.doing(f"looking for devices to run {given.whole.path} on"):
        found = fleet.devices(named) if fleet else discover_devices(named)
    hosts, known = (fleet.hosts, fleet.tried) if fleet else ({}, {})
    made = settled(parts, found, hears, known)
    for part in made.parts:
        check_size(part, given.catalog, found, given.yes)
    tried = {**known, **made.tried}
    told = (given.whole, made.parts, given.catalog, given.yes, found, tried, hosts)
    return Loaded(*told, shard=given.shard, machine=given.machine)


def run(
    given: Read,
    runs: Path,
    command: str,
    *,
    force: bool = False,
    retry_failed: bool = False,
    wait: bool = False,
    watcher: Watcher | None = None,
    fleet: Fleet | None = None,
) -> Run:
    """Run every cell that has no row yet and store its row below `runs`, in a folder of the config's name.

    `command` is what a reader of the results may type to get them again. `force` runs finished cells again,
    `retry_failed` those that failed, timed out or crashed. Where another process writes into one of the folders, `wait`
    waits until it has ended. Cells run on the devices of a `fleet`, if there is one, else on this machine's. A cell
    that fails is a row; FirsthitError is raised only where no cell can be run, a folder is another's, the machines of
    the fleet cannot be reached any more, or a result cannot be written.
    """
    hears = watcher or Watcher()
    folders = [given.folder(runs, one) for one in (given.whole, *given.parts)]
    with locked(folders, command, wait=wait, doing=hears.doing):
        return _run(load(given, hears, fleet), runs, command, force, retry_failed, hears, fleet)


def _run(
    loaded: Loaded, runs: Path, command: str, force: bool, retry_failed: bool, hears: Watcher, fleet: Fleet | None
) -> Run:
    folder = loaded.folder(runs, loaded.whole)
    if loaded.whole.included:
        told = _described(loaded, loaded.whole, command, describe(loaded.machine))
        parts = [loaded.folder(runs, part).name for part in loaded.parts]
        Store(folder).write_plan(told | {"include": parts, "devices": [], "cells": []})
    again: Again = "everything" if force else "unfinished" if retry_failed else "nothing"
    ended = []
    for part, share in zip(loaded.parts, loaded.shares(), strict=True):
        ended.append(_run_part(part, share, loaded, runs, command, again, hears, fleet))
        hears.failed((ended[-1].rows + ended[-1].reused).of(UNFINISHED))
        hears.ended(ended[-1])
    lost = tuple(dict.fromkeys(line for one in ended for line in one.lost))
    return Run(folder, sum((one.rows for one in ended), Rows()), sum((one.reused for one in ended), Rows()), lost)


def _told(config: Path) -> str:
    """Return the path of a config: from the project's root if it lies in the project, else as it was given."""
    whole = config.resolve()
    return str(whole.relative_to(ROOT) if whole.is_relative_to(ROOT) else config)


def _described(given: Read, experiment: Experiment, command: str, environment: Mapping[str, Any]) -> dict[str, Any]:
    """Return what every plan.json says first."""
    shard = {"shard": dataclasses.asdict(given.shard)} if given.shard else {}
    return shard | {
        "name": experiment.name,
        "title": experiment.config.title,
        "config": _told(experiment.path),
        "config_text": experiment.text,
        "baseline": experiment.config.baseline,
        "focus": experiment.config.focus,
        "command": command,
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "environment": environment,
    }


def _run_part(
    part: Experiment,
    share: Share | None,
    loaded: Loaded,
    runs: Path,
    command: str,
    again: Again,
    hears: Watcher,
    fleet: Fleet | None,
) -> Run:
    """Run the cells and studies of one config, or its share of a shard, and write its plan.json."""
    store, environment = Store(loaded.folder(runs, part)), describe(loaded.machine)
    casts = bool(part.variants and (share is None or share.groups))
    only, named = (None, part.config.studies) if share is None else (share.groups, share.studies)
    if share and share.is_empty:
        hears.told(f"{store.folder}: shard {loaded.shard} has no cell of {part.path}; there is nothing to run")
    executor = LocalExecutor(part.config.budget.timeout, part.config.budget.memory)
    try:
        chosen = targets.devices_of(part, loaded.devices, kinds.only_rasters(part)) if casts else {}
        with hears.doing(_announced(part, loaded, chosen)) as tell:
            here = [info for info in chosen.values() if info]
            tried = []
            for info in here:
                tell(f"trying the arithmetic and the clock of {info.name}")
                tried.append(loaded.tried.get(info.name) or probed(executor, info, store.folder / "probes"))
            stated = part, loaded.catalog, [info for info, _ in tried], True, tell, only, loaded.hosts
            planned = plan.plan(*stated) if casts else []
        lost = tuple(f"{info.name}: {info.problem}" for info, _ in tried if isinstance(info, LostDevice))
        for line in lost:
            hears.wrong(line)
        for remark in [*remarks(part), *filter(None, [memory.unwatched()])]:
            hears.warned(remark)
        store.write_plan(
            _described(loaded, part, command, environment)
            | {"devices": [_device(info, found) for info, found in tried], "peaks": dict(part.peaks)}
            | _named(part, planned, named, loaded)
        )
        _run_studies(named, store.folder, again == "everything", hears)
        packing = Packing(store, hears)
        found, begun, old = begin(planned, store, again)
        if swept := [*old, *sweep_below(store.folder)]:
            hears.told(f"{store.folder}: removed {plural(len(swept), 'file')} that killed commands left")
        for message in store.unreadable.values():
            hears.wrong(f"{message}; running that cell again")
        seconds = estimate_seconds(found, store, part.config.budget.seconds)
        hears.starts(len(found.todo), seconds, Counter(p.cell.device for p in found.todo))
        rows, told = Stored(store), (packing.cell, hears.hears_builds, threading.RLock())

        def work(executor: Executor, cells: Sequence[Planned], where: dict[str, Any]) -> None:
            said = ChainMap(where, environment)
            Runner(part.config, loaded.catalog, store, executor, said, *told).run(cells, begun, rows)

        if fleet:
            fleet.run(found.todo, part.config.budget, work)
        else:
            work(executor, found.todo, {})
        if reason := cache.unwritten(store.truth):
            hears.warned(f"{reason}; the oracle's answers were kept in memory, and the next run computes them again")
    finally:
        executor.close()
    return Run(store.folder, Rows([rows]), Rows([found.kept]), lost)


def remarks(part: Experiment) -> list[str]:
    """Return sentences on surfaces that their domains cut or do not hold, and on what of their files is left out."""
    from surfaces.proofs.extent import remark

    return [*part.left_out, *(told for told in map(remark, part.surfaces) if told)]


def _device(info: DeviceInfo, found: Probes | None) -> dict[str, Any]:
    """Return what a plan.json says of a device and of what its probes found."""
    probes = dataclasses.asdict(found) if found else {}
    return dataclasses.asdict(info) | {"versions": dict(info.versions), "probes": probes}


def _announced(part: Experiment, loaded: Loaded, chosen: Mapping[str, DeviceInfo | None]) -> str:
    """Say what will be run where, before anything slow is done for it."""
    here = [info for info in chosen.values() if info]
    cells = plural(cells_of(part, loaded.catalog, here), "cell")
    what = f"shard {loaded.shard} of {cells}" if loaded.shard else cells
    where = f" on {', '.join(info.name for info in here)}" if here else ""
    return f"{part.path}: {what}{where}; preparing devices and cells"


def _named(part: Experiment, planned: Sequence[Planned], named: Sequence[str], loaded: Loaded) -> dict[str, Any]:
    """Return what a plan.json names: cells, families of hard rays, methods, and the studies `named`."""

    def listed(kind: str) -> list[dict[str, Any]]:
        """Name the cells of a list; those of a shard with their places in the whole plan, by which it is merged."""
        own = (p for p in planned if p.kind.listed == kind)
        return [{"slot": p.cell.slot, "key": p.key} | ({"at": p.at} if loaded.shard else {}) for p in own]

    return {
        "cells": listed("cells"),
        "families": listed("families"),
        "family_facts": {name: groups.facts(name) for name in part.config.families},
        "methods": {v.method: card(loaded.catalog.get(v.method)) for v in part.variants},
        "studies": [{"study": name, "key": studies.key(name)} for name in named],
    }


def _run_studies(names: Sequence[str], folder: Path, force: bool, hears: Watcher) -> None:
    """Run the studies that are not done yet in a folder; all of them with `force`."""
    todo = studies_due(names, folder, "everything" if force else "nothing")
    for name in names:
        if name in todo:
            done = studies.run(name, folder)
            hears.told(f"study {name}: {plural(len(done['rows']), 'row')}, {console.duration(done['seconds'])}")
        else:
            hears.told(f"study {name}: reused")
