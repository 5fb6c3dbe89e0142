"""Hold rows by their keys, and read each from its file when it is asked for: a run may have more than memory holds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import overload

from harness.contract import CellStatus, FirsthitError
from harness.results.store import Row, Store


class Stored(Mapping[str, Row]):
    """Map keys to rows of one store, in the order in which they were added.

    A row is read each time that it is asked for. That raises FirsthitError where its file is gone or damaged meanwhile.
    """

    def __init__(self, store: Store) -> None:
        self.store = store
        self.statuses: dict[str, CellStatus] = {}

    def add(self, row: Row) -> None:
        """Add a row that the store holds; its key and status are remembered."""
        self.statuses[row["key"]] = CellStatus(row["status"])

    def __getitem__(self, key: str) -> Row:
        if key not in self.statuses:
            raise KeyError(key)
        if row := self.store.read(key):
            return row
        reason = self.store.unreadable.get(key, "its file is gone")
        raise FirsthitError(f"the row {key} of {self.store.folder} cannot be read any more: {reason}", exit_code=3)

    def __contains__(self, key: object) -> bool:  # Mapping's own would read the row
        return key in self.statuses

    def __iter__(self) -> Iterator[str]:
        return iter(self.statuses)

    def __len__(self) -> int:
        return len(self.statuses)


class Rows(Sequence[Row]):
    """List the rows of several stores one after the other; each is read when it is asked for, as `Stored` says."""

    def __init__(self, parts: Iterable[Stored] = ()) -> None:
        self._places = [(part, key) for part in parts for key in part]

    @property
    def statuses(self) -> Iterator[CellStatus]:
        """Yield the status of each row, without reading it."""
        return (part.statuses[key] for part, key in self._places)

    def of(self, statuses: Sequence[CellStatus]) -> Rows:
        """Return the rows that have one of these statuses."""
        chosen = Rows()
        chosen._places = [(part, key) for part, key in self._places if part.statuses[key] in statuses]
        return chosen

    def __add__(self, others: Rows) -> Rows:
        both = Rows()
        both._places = [*self._places, *others._places]
        return both

    @overload
    def __getitem__(self, place: int) -> Row: ...

    @overload
    def __getitem__(self, place: slice) -> Rows: ...

    def __getitem__(self, place: int | slice) -> Row | Rows:
        if isinstance(place, slice):
            chosen = Rows()
            chosen._places = self._places[place]
            return chosen
        part, key = self._places[place]
        return part[key]

    def __len__(self) -> int:
        return len(self._places)
