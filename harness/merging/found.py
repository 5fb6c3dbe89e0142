"""Read the cells of runs that are to be merged, and of each what decides whether and as what it is taken."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import Any

from harness.contract import digest
from harness.results import sealed
from harness.results.store import Row, Store, row_of


@dataclass(frozen=True, eq=False)
class Source:
    """Hold a run that is to be merged: its folder's name as the user gave it, where its files are, and its plan."""

    name: str
    folder: Path
    plan: Mapping[str, Any]

    @cached_property
    def store(self) -> Store:
        return Store(self.folder)

    def row(self, key: str) -> Row:
        """Read a row. Raises FileNotFoundError where there is none, and OSError or ValueError where it is damaged."""
        return row_of(self.store.text(key), key)

    def file_of(self, key: str) -> str:
        """Return the name of the file that holds a row, below the folder."""
        return self.store.place(key).relative_to(self.folder).as_posix()

    @property
    def machine(self) -> str:
        """Return the machine that wrote the plan; of older runs, which do not say it, the folder's name."""
        return str(self.plan["environment"].get("machine") or Path(self.name).name)


@dataclass(frozen=True)
class Hardware:
    """Tell what a cell ran on: a hash of the device's facts, the processor and the drivers' settings, and the cores.

    facts: None where the machine lacks the device, so that nothing ran
    cores: None of a cell that is not timed, whose result does not depend on them
    """

    facts: str | None
    cores: int | None


@dataclass(frozen=True, eq=False)
class Made:
    """Hold what a cell's row says, as far as merging asks.

    parts: a hash of each part of its identity, by the part's name
    methods: a hash of the files of each folder of a method
    answers: a hash of what it found, without times
    whole: a hash of all that it says
    """

    status: str
    started: str
    commit: str | None
    machine: str
    hardware: Hardware
    parts: Mapping[str, str]
    methods: Mapping[str, str]
    answers: str
    whole: str


@dataclass(frozen=True, eq=False)
class Cell:
    """Hold a cell that a run's plan names.

    listed: "cells" or "families"
    own: the device's name without the machine
    told: the device's name as the run tells it
    place: the slot without the device
    at: the place in the whole plan, where the run is a shard
    made: what its row says; None where there is no row that can be read
    """

    source: Source
    listed: str
    key: str
    slot: str
    own: str
    told: str
    place: str
    at: int | None
    made: Made | None


@dataclass(frozen=True)
class Left:
    """Name what was not merged, and why."""

    run: str
    what: str
    reason: str


def cells_of(source: Source, left: list[Left], tell: Callable[[str], None] = lambda _: None) -> Iterator[Cell]:
    """Yield the cells of a run in its plan's order; rows and parts that cannot be read are noted in `left`."""
    left += [Left(source.name, name, problem) for name, problem in source.store.parts.problems().items()]
    for listed in ("cells", "families"):
        named = source.plan.get(listed, ())
        for number, one in enumerate(named, 1):
            if number % 100 == 1:
                tell(f"reading {source.name}: {listed} [{number}/{len(named)}]")
            yield _cell(source, listed, one, left)


def _cell(source: Source, listed: str, one: Mapping[str, Any], left: list[Left]) -> Cell:
    key, slot, row = one["key"], one["slot"], None
    try:
        row = source.row(key)
        if row["slot"] != slot:
            raise ValueError(f"the plan names another cell by its key: {slot:.80}")
    except FileNotFoundError:
        pass
    except (OSError, ValueError) as error:
        row = None
        left.append(Left(source.name, source.file_of(key), f"{sealed.problem(error)} ({slot})"))
    device = row["device"] if row else slot.rpartition(" ")[2]
    own, told = device.partition("@")[0], one.get("device", device)
    place = slot.removesuffix(device)
    return Cell(
        source, listed, key, slot, own, told, place, one.get("at"), None if row is None else _made(source, row, told)
    )


def _made(source: Source, row: Row, told: str) -> Made:
    """Return what merging asks of a row."""
    identity, environment = row["identity"], row["environment"]
    device = identity.get("device")
    facts = {name: value for name, value in device.items() if name != "name"} if isinstance(device, dict) else None
    hardware = None if facts is None else digest(facts, identity.get("processor"), identity.get("settings"))
    named = next((one.get("machine") for one in source.plan["devices"] if one["name"] == told), None)
    machine = row["device"].partition("@")[2] or environment.get("machine") or named or source.machine
    return Made(
        row["status"],
        environment["started"],
        environment.get("commit"),
        machine,
        Hardware(hardware, identity.get("cores")),
        {name: digest(value) for name, value in identity.items()},
        _folders(identity.get("method")),
        digest({name: row.get(name) for name in ("accuracy", "rungs", "program")}),
        digest(row),
    )


def _folders(files: Any) -> dict[str, str]:
    """Return one hash for each folder of the files whose hashes are given by their paths."""
    folders: dict[str, dict[str, str]] = {}
    for path, found in files.items() if isinstance(files, dict) else ():
        folders.setdefault(PurePosixPath(path).parent.as_posix(), {})[path] = found
    return {folder: digest(own) for folder, own in folders.items()}


def reread(cell: Cell) -> Row:
    """Read the row of a cell once more. Raises OSError or ValueError where it is gone or damaged meanwhile."""
    return cell.source.row(cell.key)


def lists_of(names: Iterable[str], most: int = 3) -> str:
    """Write names in a row, the first few of many."""
    every = list(names)
    more = f" and {len(every) - most} more" if len(every) > most else ""
    return ", ".join(every[:most]) + more
