"""Keep results as files below runs/<config>/, written whole or not at all, and named by what decides them.

plan.json            the experiment as last run: which cells it names, on which devices
cells/<key>.json     one row
parts/<…>.parquet    many rows, of a run that has very many (harness.results.parts)
arrays/<key>.npz     that row's answers on the accuracy grid, as pictures
truth/<hash>.npz     the oracle's answers, shared by all rows with the same rays
begun/               what is known of cells that have no row yet (harness.results.begun)
.lock                who writes here now (harness.results.lock)
"""

from __future__ import annotations

import os
from collections.abc import Container, Iterable, Iterator
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from harness.results import agreement, sealed
from harness.results.parts import Parts
from harness.results.row import Environment, StoredRow
from harness.results.writing import savez_atomically, write_atomically

FORMAT = 1
ENDING = ".json"
Row = dict[str, Any]  # as it was read, of this or an older version; harness/results/row.py declares what is in it


def read_row(path: Path, key: str, *, older: bool = True) -> Row:
    """Read the row of a cell's file, and hold it against its checksum, its declaration and itself.

    With `older`, leaves that not every version wrote may be missing. Raises FileNotFoundError where there is none, and
    OSError or ValueError where it is damaged, of another version or of another cell.
    """
    return row_of(sealed.content(path), key, older=older)


def row_of(text: bytes, key: str, *, older: bool = True) -> Row:
    """Read the row of the bytes of a cell's file, as `read_row` does. Raises ValueError where they are damaged."""
    row = of_format(sealed.unsealed(text), FORMAT)
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
        self.parts = Parts(folder)

    def _cell(self, key: str) -> Path:
        return self.folder / "cells" / f"{key}{ENDING}"

    def has(self, key: str) -> bool:
        """Tell whether there is a file of the row of `key`, whole or not, or a part that has the row.

        This and what reads rows raises FirsthitError where there are parts and the package that reads them is missing.
        """
        return self._cell(key).exists() or self.parts.find(key) is not None

    def place(self, key: str) -> Path:
        """Return the file that holds the row of `key`, its own or a part; its own where there is none."""
        found = None if self._cell(key).exists() else self.parts.find(key)
        return self._cell(key) if found is None else found[0].path

    def size(self, key: str) -> int:
        """Return the bytes that the row of `key` takes on the disk, in a part its share; 0 where there is none."""
        try:
            return self._cell(key).lstat().st_size
        except OSError:
            found = self.parts.find(key)
            return 0 if found is None else found[0].path.lstat().st_size // len(found[0].keys)

    def text(self, key: str) -> bytes:
        """Return the bytes of the file that the row of `key` has, or had before it went into a part.

        Raises FileNotFoundError where there is none, and OSError or ValueError where it cannot be read.
        """
        try:
            return sealed.content(self._cell(key))
        except FileNotFoundError:  # looked for first, since rows go from files into parts, never back
            return self.parts.text(key)

    def read(self, key: str, *, older: bool = False) -> Row | None:
        """Return the row of `key`; None if there is none or its file is damaged (then `unreadable` says why).

        With `older`, what an older version did not write is null. Without it, a row that lacks a leaf is damaged: the
        key of a cell as it stands now holds this version, so that its row is no older one.
        """
        try:
            row = row_of(self.text(key), key, older=older)
            return _UNSAID | row if older else row
        except FileNotFoundError:
            return None
        except (OSError, ValueError) as error:
            self.unreadable[key] = f"{self.place(key)} is damaged ({sealed.problem(error)})"
            return None

    def keys(self) -> list[str]:
        """Return the key of every row that has a file or lies in a part, sorted."""
        return sorted({*self.files(), *self.parts.keys()})

    def files(self) -> list[str]:
        """Return the keys of the rows that have files of their own, sorted."""
        try:
            names = os.listdir(self.folder / "cells")  # noqa: PTH208 (a Path for each of 10^6 names takes seconds)
        except OSError:
            return []
        return sorted(name.removesuffix(ENDING) for name in names if name.endswith(ENDING) and name[0] != ".")

    def in_storage_order(self, keys: Iterable[str]) -> list[str]:
        """Return keys in the order in which reading their rows is fast."""
        return self.parts.in_storage_order(keys)

    def write(self, row: Row, arrays: dict[str, NDArray[Any]] | None = None) -> None:
        """Store a finished row, its arrays first, so that a row never names arrays that are not there.

        Raises FirsthitError where a file cannot be written.
        """
        if arrays is not None:
            row = row | {"arrays": self.write_arrays(row["key"], arrays)}
        self.write_text(row["key"], sealed.sealed({"format": FORMAT, **row}))

    def write_text(self, key: str, text: bytes) -> None:
        """Store the bytes of a row's file as they are. Raises FirsthitError where they cannot be written."""
        write_atomically(self._cell(key), text)

    def write_arrays(self, key: str, arrays: dict[str, NDArray[Any]]) -> str:
        """Store the arrays of the row of `key`, which follows, and return their name below the folder.

        Raises FirsthitError where they cannot be written.
        """
        name = f"arrays/{key}.npz"
        savez_atomically(self.folder / name, **arrays)
        return name

    def rows_of(self, slot: str) -> Iterator[Row]:
        """Yield the rows of a slot, as `rows` does. Of parts only the slots and these rows are read."""
        for key in dict.fromkeys([*self.files(), *self.parts.keys_with("slot", slot)]):
            if (row := self.read(key, older=True)) and row["slot"] == slot:
                yield row

    def rows(self, but: Container[str] = ()) -> Iterator[Row]:
        """Yield every row that can be read, current or stale, `but` those of some keys.

        What an older version did not write is null.
        """
        for key in self.in_storage_order(key for key in self.keys() if key not in but):
            if row := self.read(key, older=True):
                yield row

    def write_plan(self, plan: dict[str, Any]) -> None:
        """Store what the run sets out to do. Raises FirsthitError if it cannot be written."""
        write_atomically(self.folder / "plan.json", sealed.sealed({"format": FORMAT, **plan}))
