"""Say of each row of a gate what outputs tell beside its verdict: how to get it again, what it took, its picture."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from harness.gate.checked import Checked
from harness.gate.entries import slot_of
from harness.gate.judge import Judged

SPEED_ENDS = ": speed"  # of the slot of a row that judges a cell's time, which is not what checking took
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
    return judged.slot.removesuffix(SPEED_ENDS)


def abouts(
    checked: Checked, judged: Iterable[Judged], command: Callable[[Judged], str], pictures: Mapping[Place, Path]
) -> dict[Place, About]:
    """Say of every row, by its slot and device, what outputs tell of it.

    `command` returns the command that gates one row anew, and `pictures` holds the files that were drawn.
    """
    rows = {(slot_of(p), p.cell.device): checked.rows[p.key] for p in checked.planned}
    made = {}
    for j in judged:
        place = (j.slot, j.device)
        row = rows.get(place)
        earlier = row["environment"]["started"] if row and row["key"] in checked.earlier else None
        made[place] = About(command(j), row["seconds"] if row else None, earlier, pictures.get(place))
    return made
