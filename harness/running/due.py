"""Find which of a plan's cells must run: those that have no row, and those whose row is not to be kept."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Literal

from harness import studies
from harness.contract import CellStatus
from harness.experiment.plan import Planned
from harness.results.begun import Begun
from harness.results.store import Row, Store
from harness.results.stored import Stored

Again = Literal["nothing", "unfinished", "everything"]  # which cells run although they have a row
UNFINISHED = (CellStatus.FAILED, CellStatus.TIMEOUT, CellStatus.CRASHED)
# Seconds for each program of a cell, to compile and check it, where no row tells: the mean of two OpenCL devices and
# llvmpipe on two cores, over eight methods, tiles among them, and four surfaces. Each device's own is 0.4 to 1.3
PREPARING = 0.7


@dataclass(frozen=True, eq=False)
class Due:
    """Hold a plan's cells that must run, and the rows of the others."""

    todo: list[Planned]  # in the plan's order
    kept: Stored  # the other cells' rows by their keys, in the plan's order
    replaced: frozenset[str]  # keys of those that must run although they have a row
    seconds: Mapping[str, float]  # that the rows of the latter took, by their slots
    took: Mapping[tuple[str, str], Sequence[float]]  # seconds of each row read that was run, by device and method


def due(planned: Sequence[Planned], store: Store, again: Again = "nothing", asked: Collection[str] = ()) -> Due:
    """Separate the cells that must run from those whose stored row is kept.

    `asked` are keys of cells that an earlier command was to run again, and did not come to (Begun.again). A row that
    cannot be read counts as none; `store.unreadable` then says why.
    """
    kept, replaced, statuses = Stored(store), set(), dict[str, CellStatus]()
    seconds: dict[str, float] = {}
    took: dict[tuple[str, str], list[float]] = {}
    for key in store.in_storage_order(one.key for one in planned):
        if row := store.read(key):
            _learn(took, row)
            if key in asked or _is_wanted_again(row, again):
                replaced.add(key)
                seconds[row["slot"]] = row["seconds"] or 0.0
            else:
                statuses[key] = CellStatus(row["status"])
    for one in planned:
        if one.key in statuses:
            kept.statuses[one.key] = statuses[one.key]
    return Due([p for p in planned if p.key not in kept], kept, frozenset(replaced), seconds, took)


def _learn(took: dict[tuple[str, str], list[float]], row: Row) -> None:
    """Add what a row that ended well took."""
    if row["status"] == CellStatus.OK and row["seconds"]:
        took.setdefault((row["device"], row["method"]), []).append(row["seconds"])


def begin(planned: Sequence[Planned], store: Store, again: Again = "nothing") -> tuple[Due, Begun, list[Path]]:
    """Find which cells must run and what is known of them already, and remove what is left of others.

    Returns that with the files that were removed. Only who holds the folder's lock may call it. Raises FirsthitError
    where the folder cannot be written.
    """
    begun = Begun(store.folder)
    found = due(planned, store, again, begun.again)
    keys = {p.key for p in found.todo}
    begun.forget(keys if again == "everything" else found.replaced - begun.again)
    begun.ask_again(found.replaced)
    return found, begun, begun.sweep(keys, store.has)


def studies_due(names: Iterable[str], folder: Path, again: Again = "nothing") -> list[str]:
    """Return the studies that must be computed: those that a run's folder does not hold as they stand now, or all."""
    return [name for name in names if again == "everything" or not studies.is_done(name, folder)]


def _is_wanted_again(row: Row, again: Again) -> bool:
    """Tell whether a cell must run although it has this row."""
    return again == "everything" or (again == "unfinished" and row["status"] in UNFINISHED)


def estimate_seconds(found: Due, store: Store, budget_seconds: float) -> float:
    """Estimate the seconds that the cells which must run will take together."""
    return sum(estimates(found, store, budget_seconds).values())


def estimates(found: Due, store: Store, budget_seconds: float) -> dict[str, float]:
    """Estimate the seconds of each cell that must run, by its key.

    They are as many as its slot took before, else as the median of the rows of its method on its device, else the whole
    budget and PREPARING for each program. No row is read that `due` has read, since there may be very many.
    """
    if not found.todo:
        return {}
    before, took = dict[str, float](), {of: [*seconds] for of, seconds in found.took.items()}
    for row in store.rows(but={*found.kept, *found.replaced}):
        before[row["slot"]] = row["seconds"] or 0.0
        _learn(took, row)
    before |= found.seconds
    usual = {of: median(seconds) for of, seconds in took.items()}

    def estimate(one: Planned) -> float:
        if one.skip or one.failure:
            return before.get(one.cell.slot, 0.0)
        if one.cell.slot in before:
            return before[one.cell.slot]
        known = usual.get((one.cell.device, one.cell.variant.method))
        programs = {program.hash for program in one.programs}
        return budget_seconds + PREPARING * len(programs) if known is None else known

    return {one.key: estimate(one) for one in found.todo}
