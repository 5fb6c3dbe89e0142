"""Say of each row of a gate what outputs tell beside its verdict: how to get it again, what it took, its picture."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from harness.experiment.plan import Planned
from harness.gate.entries import slot_of
from harness.gate.judge import Judged
from harness.results.store import Row

ACCURACY, SPEED = ": accuracy", ": speed"  # end the slots of what a cell is judged by against a revision
Place = tuple[str, str]  # a row's slot and device


@dataclass(frozen=True)
class About:
    """Hold what outputs tell of one row beside its verdict.

    command: what a person may paste to get the row again
    seconds: what checking its cell took; None where none was checked, as of a missing row
    earlier: when that was, ISO 8601, where it was in an earlier run; None where it was now
    picture: the file that shows its wrong rays; None where there is none
    """

    command: str
    seconds: float | None = None
    earlier: str | None = None
    picture: Path | None = None


def cell_slot(judged: Judged) -> str:
    """Return the slot of the cell that a row is of."""
    return judged.slot.removesuffix(ACCURACY).removesuffix(SPEED)


def abouts(
    judged: Iterable[Judged],
    command: Callable[[Judged], str],
    planned: Iterable[Planned],
    rows: Mapping[str, Row],
    earlier: Collection[str],
    pictures: Mapping[Place, Path],
) -> dict[Place, About]:
    """Say of every row, by its slot and device, what outputs tell of it.

    command: returns the command that gates one row anew
    rows: the rows of the `planned` cells by their keys, of which those in `earlier` are of an earlier run
    pictures: the files that were drawn
    """
    by_place = {(slot_of(p), p.cell.device): rows[p.key] for p in planned if p.key in rows}
    made = {}
    for j in judged:
        row = by_place.get((j.slot.removesuffix(ACCURACY), j.device))  # a race took another time than the check
        when = row["environment"]["started"] if row and row["key"] in earlier else None
        place = (j.slot, j.device)
        made[place] = About(command(j), row["seconds"] if row else None, when, pictures.get(place))
    return made
