"""Remove what a run's folder holds and its plan does not name: rows of old keys, their answers, old studies."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError
from harness.results import compaction, plan_file, sealed, writing
from harness.results.begun import Begun
from harness.results.lock import Doing, locked
from harness.results.store import Store


@dataclass(frozen=True)
class Unnamed:
    """Name a file that no plan names, or one that holds a row which none names.

    size: in bytes; of a row in a part, its share of the part
    what: what it is
    key: of the row; "" where it is none
    """

    path: Path
    size: int
    what: str
    key: str = ""


def clean(
    folder: Path,
    command: str,
    *,
    truth: bool = False,
    dry: bool = False,
    wait: bool = False,
    doing: Doing | None = None,
) -> list[Unnamed]:
    """Remove what the plan of a run does not name, and of the runs that it collects; return what was removed.

    With `truth` the oracle's answers go too: no plan says which of them it needs, and the next run makes them anew.
    With `dry` nothing is removed, and nobody's lock is asked for. The rows of cells that the plan names stay, damaged
    ones too, and so does a damaged part. Raises FirsthitError where there is no run, its plan cannot be read, another
    process writes into it, or a file cannot be removed.
    """
    folders = _folders(folder)
    if dry:
        return [one for own in folders for one in unnamed(own, truth)]
    removed: list[Unnamed] = []
    with locked(folders, command, wait=wait, doing=doing):
        for own in folders:
            found = unnamed(own, truth)
            compaction.without(own, {one.key for one in found if one.key})
            for one in found:
                if not one.key:
                    try:
                        one.path.unlink(missing_ok=True)
                    except OSError as error:
                        raise FirsthitError(f"cannot remove {one.path}: {error.strerror}", exit_code=3) from None
            removed += found
            writing.sweep_below(own)
    return removed


def _folders(folder: Path) -> list[Path]:
    """Return a run's folder, and those that it collects and that are there. Raises FirsthitError."""
    parts = (folder.parent / name for name in _plan(folder).get("include", ()))
    return [folder, *(part for part in parts if part.is_dir())]


def _plan(folder: Path) -> Mapping[str, Any]:
    """Read a plan: without one, nobody can say what is named. Raises FirsthitError."""
    try:
        return plan_file.read(folder / "plan.json")
    except FileNotFoundError:
        raise FirsthitError(f"{folder} is no run folder: it has no plan.json, so that nothing was removed") from None
    except (OSError, ValueError) as error:
        told = f"{folder / 'plan.json'} is damaged ({sealed.problem(error)}), so that nothing was removed"
        raise FirsthitError(f"{told}; `firsthit run` writes it anew", exit_code=3) from None


def unnamed(folder: Path, truth: bool = False) -> list[Unnamed]:
    """List the files of a run that its plan does not name. Raises FirsthitError where the plan cannot be read."""
    plan = _plan(folder)
    slots = {cell["key"]: cell["slot"] for cell in (*plan["cells"], *plan.get("families", ()))}
    store, found, planned = Store(folder), list[Unnamed](), set(slots.values())
    damaged = {folder / name for name in store.parts.problems()}
    for key in store.in_storage_order(set(store.keys()) - slots.keys()):
        place = store.place(key)
        if place not in damaged:
            found.append(Unnamed(place, store.size(key), _what(store, key, planned), key))
    for path in _files(folder / "arrays", ".npz"):
        if path.stem not in slots:
            found.append(Unnamed(path, _size(path), "answers of a row that the plan does not name"))
    studies = {study["key"] for study in plan.get("studies", ())}
    for path in _files(folder / "studies", ".json"):
        if path.stem not in studies:
            found.append(Unnamed(path, _size(path), "a study that the plan does not name"))
    begun = "what was begun of cells that the plan does not name"
    found += [Unnamed(path, _size(path), begun) for path in Begun(folder).without(slots)]
    if truth:
        found += [Unnamed(path, _size(path), "the oracle's answers") for path in _files(folder / "truth", ".npz")]
    return found


def _files(folder: Path, suffix: str) -> Iterator[Path]:
    """Yield the files of a folder that end so, sorted; a temporary file, which has a point before, is none of them."""
    with contextlib.suppress(OSError):
        yield from sorted(one for one in folder.iterdir() if one.suffix == suffix and not one.name.startswith("."))


def _size(path: Path) -> int:
    with contextlib.suppress(OSError):
        return path.lstat().st_size
    return 0


def _what(store: Store, key: str, slots: set[str]) -> str:
    """Say what a row is that the plan does not name; `slots` are those of the plan's cells."""
    row = store.read(key, older=True)
    if row is None:
        return "a damaged row that the plan does not name"
    of = "an older row of a cell of the plan" if row["slot"] in slots else "a row of a cell that the plan does not name"
    return f"{of}: {row['slot']}"
