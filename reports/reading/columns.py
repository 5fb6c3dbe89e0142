"""Hold every column of a run's rows in the plan's order, and read those that are asked for.

Rows of files were read as rows and are held as an Arrow table. Of rows in Parquet parts (harness.results.parts) only
what is asked for is read, and is held against its declaration then: a part's columns are made of rows that were.
"""

from __future__ import annotations

import json
from array import array as numbers_of
from collections.abc import Collection, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
from numpy.typing import NDArray

from harness.results import compaction
from harness.results.parts import Part, damage
from harness.results.schema import SCHEMA, Field
from harness.results.sealed import problem
from harness.results.store import Row

FIELDS = {field.name: field for field in compaction.FIELDS}
BATCH = 20_000  # rows that are read together where all are written
_TYPES = {field.name: field.type for field in compaction.schema()}
_CODED = [name for name in FIELDS if _TYPES[name] == pa.string() and name not in compaction.UNIQUE]
Piece: TypeAlias = Any  # a pa.Table, which has no types, or a Part
UNREAD = frozenset(  # columns that only results.csv and results.parquet have: a report of 10^6 rows must not hold them
    [
        "fov",
        "bootstrap_lower_ms",
        "bootstrap_upper_ms",
        "drift_share",
        "drift_chance",
        "spread_share",
        "batch",
        "upload_ms",
        "readback_ms",
        "accuracy_size",
        "truth_misses",
        "error_p50",
        "relative_error_p50",
        "relative_error_p999",
        "feature_error_p50",
        "feature_error_p999",
        "ulp_error_p50",
        "ulp_error_p999",
        "condition_ratio_p50",
        "condition_ratio_p999",
        "normal_error_degrees_p50",
        "normal_error_degrees_p999",
        "residual_p50",
        "residual_p999",
        "program_hash",
        "started",
        "identity",
    ]
)


def held(rows: Sequence[Row]) -> pa.Table:
    """Hold rows, which were read from files, as a table of every column of FIELDS."""
    return compaction.table([(row, b"") for row in rows]).select(list(FIELDS))


@dataclass(frozen=True, eq=False)
class Columns:
    """Hold where each row of a run lies, in the plan's order: in which of `pieces`, and at which place there."""

    pieces: tuple[Piece, ...]
    which: NDArray[np.int32]
    rows: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.rows)

    @classmethod
    def together(cls, parts: Sequence[Columns]) -> Columns:
        """Join the rows of several, one after the other."""
        starts = np.cumsum([0, *(len(part.pieces) for part in parts)])
        which = [part.which + start for part, start in zip(parts, starts[:-1], strict=True)]
        return cls(
            tuple(piece for part in parts for piece in part.pieces),
            np.concatenate([np.empty(0, np.int32), *which]).astype(np.int32),
            np.concatenate([np.empty(0, np.int64), *(part.rows for part in parts)]),
        )

    @cached_property
    def _order(self) -> NDArray[np.int64] | None:
        """Return the place of each row in all pieces one after the other; None where they are in that order."""
        sizes = [piece.num_rows if isinstance(piece, pa.Table) else piece.ends[-1] for piece in self.pieces]
        starts = np.cumsum([0, *sizes])
        order = starts[:-1][self.which] + self.rows if len(self.rows) else np.empty(0, np.int64)
        return None if np.array_equal(order, np.arange(starts[-1])) else order

    def column(self, name: str) -> pa.Array:
        """Read a column of all rows; texts that repeat are coded by a dictionary.

        Raises Refused where a part holds what its rows cannot hold.
        """
        kind = _TYPES[name] if name not in _CODED else pa.dictionary(pa.int32(), pa.string())
        if kind == pa.string():
            kind = pa.large_string()  # all of them may have more than 2³¹ bytes

        def chunks_of(piece: Piece) -> list[pa.Array]:
            found = piece.column(name) if isinstance(piece, pa.Table) else _read(piece, name)
            return list(found.cast(kind).chunks)

        if len(self.pieces) == 1:  # threads would take longer to start than a small run's rows to read
            chunks = chunks_of(self.pieces[0])
        else:
            with ThreadPoolExecutor(pa.cpu_count()) as beside:
                chunks = [chunk for made in beside.map(chunks_of, self.pieces) for chunk in made]
        whole = pa.chunked_array(chunks, kind).unify_dictionaries().combine_chunks()
        whole = whole if isinstance(whole, pa.Array) else whole.chunk(0) if whole.num_chunks else pa.array([], kind)
        return whole if self._order is None else whole.take(pa.array(self._order))

    def at(self, name: str, row: int) -> Any:
        """Read the value of a column in one row. Raises OSError or ValueError where a part is damaged."""
        near = _Near(self.pieces, pa.schema([(name, _TYPES[name])]))
        return near.take(self.which[row : row + 1], self.rows[row : row + 1]).column(0)[0].as_py()

    def batches(self, names: Sequence[str]) -> Iterator[pa.Table]:
        """Yield these columns of all rows, in order, a batch after the other.

        Raises OSError or ValueError where a part is damaged.
        """
        schema = pa.schema([(name, _TYPES[name]) for name in names])
        near = _Near(self.pieces, schema)
        for start in range(0, len(self), BATCH):
            here = slice(start, start + BATCH)
            yield near.take(self.which[here], self.rows[here])


class _Near:
    """Take rows of pieces whose neighbours were taken before, from groups of rows that are held."""

    def __init__(self, pieces: Sequence[Piece], schema: pa.Schema) -> None:
        self._pieces, self._schema = pieces, schema
        self._held: dict[tuple[int, int], pa.Table] = {}
        self._files: dict[int, pq.ParquetFile] = {}

    def take(self, which: NDArray[np.int32], rows: NDArray[np.int64]) -> pa.Table:
        """Return the rows at these places, in their order."""
        tables, order, start, used = list[pa.Table](), np.empty(len(rows), np.int64), 0, set()
        for piece in np.unique(which).tolist():
            of = self._pieces[piece]
            here = which == piece
            if isinstance(of, pa.Table):
                tables.append(of.select(self._schema.names).cast(self._schema).take(pa.array(rows[here])))
                order[here] = start + np.arange(int(here.sum()))
                start += len(tables[-1])
                continue
            groups = np.searchsorted(of.ends, rows, side="right")
            for group in np.unique(groups[here]).tolist():
                mine = here & (groups == group)
                at = rows[mine] - (of.ends[group - 1] if group else 0)
                used.add((piece, group))
                tables.append(self._group(piece, of, group).take(pa.array(at)))
                order[mine] = start + np.arange(len(at))
                start += len(at)
        self._held = {place: table for place, table in self._held.items() if place in used}
        return pa.concat_tables(tables).take(pa.array(order)) if tables else self._schema.empty_table()

    def _group(self, number: int, part: Part, group: int) -> pa.Table:
        if (number, group) not in self._held:
            with damage():
                if number not in self._files:
                    self._files[number] = _opened(part)
                found = self._files[number].read_row_group(group, columns=self._schema.names)
                self._held[number, group] = found.select(self._schema.names).cast(self._schema)
        return self._held[number, group]


class Refused(ValueError):
    """Say why a column of a part is not used."""

    def __init__(self, part: Part, reason: str) -> None:
        super().__init__(reason)
        self.part = part


def _read(part: Part, name: str) -> pa.ChunkedArray:
    """Read a column of a part, and hold it against its declaration. Raises Refused where it does not hold."""
    try:
        return _held(part, FIELDS[name])
    except (OSError, ValueError) as error:
        raise Refused(part, f"its column {name} is damaged: {problem(error)}") from None


def _opened(part: Part, coded: Sequence[str] = ()) -> pq.ParquetFile:
    """Open the file of a part again, since threads cannot share one; texts of the columns `coded` stay coded."""
    told = part.file.metadata  # reading it takes most of the time of opening a file
    return pq.ParquetFile(part.path, metadata=told, read_dictionary=coded, page_checksum_verification=True)


def _held(part: Part, field: Field) -> pa.ChunkedArray:
    """Do what `_read` does. Raises OSError or ValueError."""
    name = field.name
    with damage():
        coded = [name] if name in _CODED else []
        file = _opened(part, coded)
        if name not in file.schema_arrow.names:
            return pa.chunked_array([pa.nulls(part.ends[-1], _TYPES[name])])  # of an older version
        found = file.read(columns=[name]).column(0)
        plain = found.type.value_type if pa.types.is_dictionary(found.type) else found.type
        if plain != _TYPES[name]:
            raise ValueError(f"it is of {plain}, not {_TYPES[name]}")
        _hold(field, found)
    return found


def _hold(field: Field, found: pa.ChunkedArray) -> None:
    """Hold the values of a column against what its leaf can hold. Raises ValueError."""
    if field.always and found.null_count:
        raise ValueError(f"it is missing from {found.null_count:,} rows")
    if field.kind in ("real", "reals", "whole"):
        values = pc.list_flatten(found) if field.kind == "reals" else found
        if field.kind != "whole" and not pc.all(pc.is_finite(values), min_count=0).as_py():
            raise ValueError("it holds what is no finite number")
        ends = pc.min_max(values).as_py()
        for value in (ends["min"], ends["max"]):
            if value is not None:
                field.check([value] if field.kind == "reals" else value, field.name)
    elif field.name in _CODED:
        for value in pc.unique(found.cast(pa.string())).to_pylist():
            if value is not None:
                field.check(json.loads(value) if field.kind == "json" else value, field.name)


def values(array: pa.Array, field: Field) -> Any:
    """Return the values of a column as pandas holds a column of its kind."""
    if field.kind == "whole":
        return pd.Int64Dtype().__from_arrow__(array)
    if field.kind == "flag":
        return pd.BooleanDtype().__from_arrow__(array)
    if field.kind == "real":
        return np.array(array.to_numpy(zero_copy_only=False), dtype=np.float64)
    if isinstance(array, pa.DictionaryArray):  # each text is held once
        texts = np.array([*array.dictionary.to_pylist(), None], dtype=object)
        return texts[array.indices.fill_null(len(texts) - 1).to_numpy()]
    made = np.empty(len(array), dtype=object)
    made[:] = array.to_pylist()
    return made


def compact(array: pa.Array) -> Any:
    """Return lists of numbers as arrays of the standard library, which take a third of a list's memory."""
    made, ends = np.empty(len(array), dtype=object), array.offsets.to_numpy()
    numbers = np.ascontiguousarray(array.values.to_numpy())
    there = array.is_valid().to_numpy(zero_copy_only=False)
    for at in np.flatnonzero(there).tolist():
        made[at] = numbers_of("d", numbers[ends[at] : ends[at + 1]].tobytes())
    return made


def frame(
    found: Columns,
    stated: Mapping[str, str],
    unread: Collection[str] = (),
    known: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> pd.DataFrame:
    """Make a frame of the columns of SCHEMA but for `unread`; `stated` are those that a plan states.

    Where any is unread, lists of numbers are arrays of the standard library. `known` are texts of each row that the
    caller holds, by their columns: where the row's are the same, no second copy is kept.

    Raises Refused where a part holds what its rows cannot hold.
    """
    made = {}
    for field in SCHEMA:
        if field.name in unread:
            continue
        if field.name in stated:
            made[field.name] = pd.Series([stated[field.name]] * len(found), dtype=object)
        else:
            column = found.column(field.name)
            told = compact(column) if unread and field.kind == "reals" else values(column, field)
            if field.name in known:
                pairs = zip(known[field.name], told, strict=True)
                told[:] = [own if own == text else text for own, text in pairs]
            made[field.name] = pd.Series(told, dtype=told.dtype, copy=False)  # texts stay objects
    return pd.DataFrame(made)  # columns of a kind in one block of memory
