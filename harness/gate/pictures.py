"""Gather what pictures of bad rows are drawn from: each ray's answer before and now, or each rung's of a family."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from harness.contract import CellStatus, digest
from harness.gate.about import cell_slot
from harness.gate.baseline import Baseline, Entry
from harness.gate.checked import Checked
from harness.gate.entries import slot_of
from harness.gate.judge import Judged, Verdict
from harness.gate.outputs import changed, number
from harness.hardcases import groups
from harness.results import pictures_file, sealed
from harness.results.row import RungVerdict
from harness.results.store import Row, Store

FIGURES = 3  # that a heading names
LONGEST = 120  # characters of a file's name that are of the row's


@dataclass(frozen=True, eq=False)
class Side:
    """Hold what one program answered for a row: of a view its arrays (as accuracy.pictures makes them), else its rungs.

    title: what stands above it
    told: why there are no answers; "" where there are
    """

    title: str
    arrays: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    rungs: Sequence[RungVerdict] = ()
    told: str = ""


@dataclass(frozen=True, eq=False)
class Pair:
    """Hold both sides of a picture of one row.

    heading: lines that say what the row is and what fell
    file: the name of the picture's file, which no other row's has
    parameter: of a family, what its rungs are made harder by; "" of a view
    """

    judged: Judged
    heading: tuple[str, ...]
    before: Side
    now: Side
    file: str
    parameter: str

    @property
    def evaluations(self) -> bool:
        """Tell whether the evaluations changed, so that they are worth a picture."""
        return any(change.figure == "evaluations_mean" for change in changed(self.judged))


Before = Callable[[Judged, Row], Side]  # what a row, which is given as it is now, was before


def pairs(checked: Checked, judged: Iterable[Judged], before: Before) -> list[Pair]:
    """Gather the sides of every row that fell and has answers ray by ray or rung by rung, in the order of `judged`.

    `before` says what a row's answers were: `blessed_in` makes it for a baseline. A row that is judged twice, by its
    answers and by its time, is gathered once.
    """
    store, keys = Store(checked.folder), {(slot_of(p), p.cell.device): p.key for p in checked.planned}
    made: dict[tuple[str, str], Pair] = {}
    for j in judged:
        place = (cell_slot(j), j.device)
        row = store.read(keys[place]) if place in keys else None  # as stored, it names the file of its arrays
        if row and place not in made and _fell(j, row) and (row["arrays"] or row["rungs"]):
            made[place] = _pair(j, row, before(j, row), side_of(row, checked.folder, "now"))
    return list(made.values())


def _fell(judged: Judged, row: Row) -> bool:
    """Tell whether a row is worth a picture: it regressed, or cannot be compared because it is wrong."""
    wrong = row["status"] == CellStatus.FAILED or judged.slot != cell_slot(judged)
    return judged.verdict is Verdict.REGRESSED or (judged.verdict is Verdict.INCOMPARABLE and wrong)


def side_of(row: Row, folder: Path, title: str) -> Side:
    """Return what a stored row of a run's folder answered, or why that cannot be read."""
    program = f"{title}: program {row['program']['hash'][:8]}" if row["program"] else title
    if row["rungs"]:
        return Side(program, rungs=row["rungs"])
    try:
        return Side(program, pictures_file.read(folder / row["arrays"]))
    except (OSError, ValueError) as error:
        return Side(program, told=f"its answers cannot be read: {sealed.problem(error)}")


def blessed_in(baseline: Baseline, folder: Path) -> Before:
    """Make the function that finds the answers of a blessed program among a gate's earlier rows in its `folder`.

    A baseline holds figures and no answers. So they are there only where the blessed program was run in this folder,
    and the side says so where it was not.
    """
    rows = list(Store(folder).rows())

    def before(judged: Judged, row: Row) -> Side:
        """Return the newest answers of the program that the row was blessed with."""
        slot, missing = cell_slot(judged), "the baseline names no program of this row"
        for facts, entry in _entries(baseline, slot, judged.device):
            title, program = f"blessed {facts.get('blessed', '')}".strip(), entry.get("program")
            found = [old for old in rows if program and _is_of(old, row, program)]
            if found:
                return side_of(max(found, key=lambda old: str(old["environment"]["started"])), folder, title)
            if program and row["program"] and program == row["program"]["hash"]:
                missing = "this is the blessed program: what it answered where it was blessed is not on this machine"
            elif program:
                missing = f"the answers of the blessed program, {program[:8]}, are not on this machine (in {folder})"
        return Side("before", told=missing)

    return before


def rows_in(rows: Mapping[tuple[str, str], Row], folder: Path, title: str) -> Before:
    """Make the function that finds the answers of rows that are known: by the cell's slot and device, below `folder`.

    `title` says what they are of, as "at v1.0".
    """

    def before(judged: Judged, _: Row) -> Side:
        """Return the answers of the row's cell."""
        old = rows.get((cell_slot(judged), judged.device))
        if old is None or not (old["arrays"] or old["rungs"]):
            return Side(title, told=f"there are no answers {title}" + (f": {old['reason']}" if old else ""))
        return side_of(old, folder, title)

    return before


def _entries(baseline: Baseline, slot: str, device: str) -> Iterator[tuple[Mapping[str, Any], Entry]]:
    """Yield the facts of each blessed device that has a row, and the row; devices of the same name come first."""
    keys = [key for key, rows in baseline.rows.items() if slot in rows]
    for key in sorted(keys, key=lambda key: baseline.devices[key].get("name") != device):
        yield baseline.devices[key], baseline.rows[key][slot]


def _is_of(old: Row, row: Row, program: str) -> bool:
    """Tell whether an earlier row has the answers of a program at the place of `row`."""
    there = bool(old["program"]) and old["program"]["hash"] == program and bool(old["arrays"] or old["rungs"])
    return there and old["slot"] == row["slot"] and old["key"] != row["key"]


def _pair(judged: Judged, row: Row, before: Side, now: Side) -> Pair:
    """Put both sides together under a heading."""
    facts = groups.facts(row["family"]) if row["family"] else {}
    what = f"{facts['title']} ({row['family']})" if facts else f"{row['surface']}, view {row['view']}"
    fell = [c for c in changed(judged) if c.verdict is judged.verdict]
    figures = [f"{c.figure} {number(c.before)} → {number(c.now)} (allowed {number(c.allowed)})" for c in fell[:FIGURES]]
    more = len(fell) - FIGURES
    rule = f" by the rule {judged.rule}" if judged.rule else ""
    told = ", ".join(figures) + (f" and {more} more" if more > 0 else "")
    heading = (
        f"{row['variant']} on {what}, {row['precision']}, {judged.device}",
        f"{judged.verdict}{rule}: {told or judged.reason}",
    )
    return Pair(judged, heading, before, now, _file(judged), facts.get("parameter", ""))


def _file(judged: Judged) -> str:
    """Return a name for a row's picture: the row's own with nothing that a file system minds, and a hash of it."""
    plain = re.sub(r"[^A-Za-z0-9._=-]+", "-", f"{cell_slot(judged)} {judged.device}").strip("-.")
    return f"{plain[:LONGEST]}-{digest(judged.slot, judged.device)[:6]}.png"
