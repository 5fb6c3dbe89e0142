"""Choose, among the cells of several runs, those that one plan names; and say of each other one why it is left out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from harness.contract import CellStatus
from harness.experiment import identity
from harness.merging import devices
from harness.merging.found import Cell, Left, Made, lists_of, reread

FILES = ("methodology", "method")  # parts of an identity that say which files made the row
PROGRAM = ("program", "program order")  # which follow from them and from the device


@dataclass(frozen=True)
class Twice:
    """Name a cell that two runs have with other figures, which of them was kept, and why.

    contradicts: what it found differs, although all that decides it is the same
    """

    slot: str
    kept: str
    other: str
    why: str
    contradicts: bool


@dataclass(eq=False)
class Chosen:
    """Hold what is merged.

    cells: in the order of the plan, those without a row among them
    told: how the device of each is told, by the cell's id
    names: how devices are told, by device
    twice: cells with other figures in another run
    elsewhere: how many cells a run skipped for want of the device on which another run has them, by the run's name
    """

    cells: list[Cell] = field(default_factory=list)
    told: dict[int, str] = field(default_factory=dict)
    names: dict[devices.Device, str] = field(default_factory=dict)
    twice: list[Twice] = field(default_factory=list)
    elsewhere: Counter[str] = field(default_factory=Counter)


def choose(cells: Iterable[Cell], left: list[Left]) -> Chosen:
    """Choose among cells that are given run by run; what does not fit is noted in `left`.

    The first row states the version of firsthit, and the first row of each method that of the method: rows that other
    files made are left out, since they are not comparable. Of two rows of one cell on one device that which ended well
    is kept, else that of the run which was named first.
    """
    fitting = _of_one_version(cells, left)
    found = Chosen()
    of = devices.of(fitting)
    found.names = devices.names(fitting, of)
    ran: dict[tuple[str, str], Cell] = {}
    for cell in fitting:
        if id(cell) in of:
            told = found.names[of[id(cell)]]
            before = ran.setdefault((cell.place, told), cell)
            if before is not cell:
                ran[cell.place, told] = _kept(before, cell, found)
    kept = {id(cell): told for (_, told), cell in ran.items()}
    there = {(cell.place, cell.own) for cell in ran.values()}
    skipped: set[tuple[str, str]] = set()
    for cell in fitting:
        place = (cell.place, cell.own)
        if id(cell) in kept or id(cell) in of:
            continue
        if cell.made and place in there:
            found.elsewhere[cell.source.name] += 1
        elif cell.made and place not in skipped:  # no machine so far has the device
            skipped.add(place)
            kept[id(cell)] = cell.own
    here = {(cell.source, cell.told): found.names[of[id(cell)]] for cell in fitting if id(cell) in of}
    named = {*ran, *skipped}
    for cell in fitting:
        told = here.get((cell.source, cell.told))
        if cell.made is None:  # it is told as the run's other cells on its device, if there are any
            taken = (cell.place, told) in named if told else (cell.place, cell.own) in there
            if not taken and (cell.place, told or cell.own) not in named:
                named.add((cell.place, told or cell.own))
                kept[id(cell)] = told or cell.told
    order: dict[tuple[str, str], int] = {}  # of the first that names a cell, though another run's row may be kept
    for number, cell in enumerate(fitting):
        order.setdefault((cell.place, kept.get(id(cell)) or here.get((cell.source, cell.told), cell.told)), number)
    found.cells = [cell for cell in fitting if id(cell) in kept]
    found.cells.sort(key=lambda cell: (-1 if cell.at is None else cell.at, order[cell.place, kept[id(cell)]]))
    found.told = kept
    return found


def _of_one_version(cells: Iterable[Cell], left: list[Left]) -> list[Cell]:
    """Return the cells without a row, and those that the same files made as the first."""
    fitting: list[Cell] = []
    first: Cell | None = None
    methods: dict[str, Cell] = {}  # by the folder of a method: the first cell that its files made
    told: dict[tuple[str, str | None], str] = {}  # what differs, by the run and what differs from whom
    for cell in cells:
        if cell.made is None:
            fitting.append(cell)
            continue
        first = first or cell
        other = first if cell.made.parts.get("methodology") != _made(first).parts.get("methodology") else None
        for folder, own in cell.made.methods.items():
            same = methods.get(folder)
            other = same if other is None and same and _made(same).methods[folder] != own else other
        if other is None:
            fitting.append(cell)
            methods = dict.fromkeys(cell.made.methods, cell) | methods
            continue
        why = told.setdefault((cell.source.name, other.key), "") or _other_files(cell, other)
        told[cell.source.name, other.key] = why
        left.append(Left(cell.source.name, cell.slot, why))
    return fitting


def _made(cell: Cell) -> Made:
    assert cell.made is not None
    return cell.made


def _other_files(cell: Cell, other: Cell) -> str:
    """Say which files differ between those that made a row and those that made another."""
    commits = " → ".join(_made(one).commit or "no commit" for one in (other, cell))
    return (
        f"other files of firsthit or of its method made it than made the rows of {other.source.name} ({commits}): "
        + (_differing(other, cell, FILES) or "files that older rows do not name")
    )


def _differing(a: Cell, b: Cell, parts: Sequence[str] = ()) -> str:
    """Say in a few words how the identities of two rows differ, in these parts or in any."""
    try:
        one, two = (reread(cell)["identity"] for cell in (a, b))
    except (OSError, ValueError):
        return ""
    one, two = ({name: value for name, value in own.items() if not parts or name in parts} for own in (one, two))
    return lists_of(dict.fromkeys(map(str, identity.changes(one, two))))


def _kept(before: Cell, cell: Cell, found: Chosen) -> Cell:
    """Return which of two rows of one cell is kept; where their figures differ, it is noted."""
    a, b = _made(before), _made(cell)
    if a.whole == b.whole:
        return before
    well = [one.status == CellStatus.OK for one in (a, b)]
    kept, other = (cell, before) if well == [False, True] else (before, cell)
    why = "it ended well" if well[0] != well[1] else "its run was named first"
    contradicts = before.key == cell.key and all(well) and a.answers != b.answers
    if contradicts:
        why += f"; {_figures(before, cell)} differs, though all that decides it is the same"
    elif before.key != cell.key:
        why += f"; they were made under other conditions: {_differing(before, cell) or 'their identities differ'}"
    found.twice.append(Twice(kept.slot, kept.source.name, other.source.name, why, contradicts))
    return kept


def _figures(a: Cell, b: Cell) -> str:
    """Name the figures in which two rows differ."""
    try:
        one, two = (reread(cell) for cell in (a, b))
    except (OSError, ValueError):
        return "what was found"
    names = []
    for part in ("accuracy", "rungs", "program"):
        own, other = one.get(part), two.get(part)
        if isinstance(own, Mapping) and isinstance(other, Mapping):
            names += [f"{part}.{name}" for name in own.keys() | other.keys() if own.get(name) != other.get(name)]
        elif own != other:
            names.append(part)
    return lists_of(sorted(names))
