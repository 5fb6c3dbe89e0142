"""Keep results as files below runs/<config>/, written whole or not at all, and named by what decides them.

plan.json            the experiment as last run: which cells it names, on which devices
cells/<key>.json     one row
arrays/<key>.npz     that row's answers on the accuracy grid, as pictures
truth/<hash>.npz     the oracle's answers, shared by all rows with the same rays
begun/               what is known of cells that have no row yet (harness.results.begun)
.lock                who writes here now (harness.results.lock)
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from harness.results import agreement, sealed
from harness.results.row import Environment, StoredRow
from harness.results.writing import savez_atomically, write_atomically

FORMAT = 1
Row = dict[str, Any]  # as it was read, of this or an older version; harness/results/row.py declares what is in it


def read_row(path: Path, key: str, *, older: bool = True) -> Row:
    """Read the row of a cell's file, and hold it against its checksum, its declaration and itself.

    With `older`, leaves that not every version wrote may be missing. Raises FileNotFoundError where there is none, and
    OSError or ValueError where it is damaged, of another version or of another cell.
    """
    row = of_format(sealed.read(path), FORMAT)
    if row.get("key") != key:
        raise ValueError(f"it names another cell's key, {row.get('key')!r:.40}")
    held = agreement.check if older else agreement.check_whole
    held(row, "")
    return row


def of_format(document: dict[str, Any], number: int) -> dict[str, Any]:
    """Return a document that was read, which is of this format. Raises ValueError where it is of another."""
    if type(document.get("format")) is not int or document["format"] != number:
        raise ValueError(f"its format is {document.get('format')!r:.40}, not {number}")
    return document


_UNSAID: Row = dict.fromkeys(StoredRow.__annotations__) | {"environment": dict.fromkeys(Environment.__annotations__)}


class Store:
    """Hold one experiment's folder, to which only one process writes."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.truth = folder / "truth"
        self.unreadable: dict[str, str] = {}

    def _cell(self, key: str) -> Path:
        return self.folder / "cells" / f"{key}.json"

    def has(self, key: str) -> bool:
        """Tell whether there is a file of the row of `key`, whole or not."""
        return self._cell(key).exists()

    def read(self, key: str, *, older: bool = False) -> Row | None:
        """Return the row of `key`; None if there is none or its file is damaged (then `unreadable` says why).

        With `older`, what an older version did not write is null. Without it, a row that lacks a leaf is damaged: the
        key of a cell as it stands now holds this version, so that its row is no older one.
        """
        try:
            row = read_row(self._cell(key), key, older=older)
            return _UNSAID | row if older else row
        except FileNotFoundError:
            return None
        except (OSError, ValueError) as error:
            self.unreadable[key] = f"{self._cell(key)} is damaged ({sealed.problem(error)})"
            return None

    def write(self, row: Row, arrays: dict[str, NDArray[Any]] | None = None) -> None:
        """Store a finished row, its arrays first, so that a row never names arrays that are not there.

        Raises FirsthitError where a file cannot be written.
        """
        if arrays is not None:
            row = row | {"arrays": self.write_arrays(row["key"], arrays)}
        write_atomically(self._cell(row["key"]), sealed.sealed({"format": FORMAT, **row}))

    def write_arrays(self, key: str, arrays: dict[str, NDArray[Any]]) -> str:
        """Store the arrays of the row of `key`, which follows, and return their name below the folder.

        Raises FirsthitError where they cannot be written.
        """
        name = f"arrays/{key}.npz"
        savez_atomically(self.folder / name, **arrays)
        return name

    def rows(self) -> Iterator[Row]:
        """Yield every row that can be read, current or stale; what an older version did not write is null."""
        for path in sorted((self.folder / "cells").glob("*.json")):
            if row := self.read(path.stem, older=True):
                yield row

    def write_plan(self, plan: dict[str, Any]) -> None:
        """Store what the run sets out to do. Raises FirsthitError if it cannot be written."""
        write_atomically(self.folder / "plan.json", sealed.sealed({"format": FORMAT, **plan}))
