"""Pack rows of a run that has very many into Parquet parts (harness.results.parts), and take rows out of them.

A file for each row is safe and plain, but a folder of 10^6 files is slow to list, copy and read. So where a run has
more than MOST files of rows, they are packed. A part is written under a temporary name, forced to the disk, and then
takes its name; the files go only after that. A process that is killed between leaves rows twice, and the next one that
packs removes the files whose very bytes a part holds. Nothing changes a part, and nothing is appended to one.

A part has each row's bytes, so that a row that is read from it is the row that its file held, and the columns of
harness.results.schema, which reports read without the rows. They are made of the row after it was held against its
checksum, its declaration and itself; a row that is damaged stays a file.

Only who holds the lock of the run's folder (harness.results.lock) may call what writes here.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Collection, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from harness.contract import FirsthitError
from harness.results import parts, plan_file
from harness.results.garbage import uncollected
from harness.results.schema import SCHEMA, Kind, flattener_of_many
from harness.results.store import ENDING, Row, Store, row_of
from harness.results.writing import flush, temporary_folder

if TYPE_CHECKING:
    import pyarrow as pa

MOST = 100_000  # files of rows that a folder may hold before they are packed
ROWS = 100_000  # of a part
GROUP = 2_000  # rows that are read together where one is wanted
FAMILY = "family"
OF_PLAN = ("run", "baseline")  # columns that a plan states, and no row
FIELDS = tuple(field for field in SCHEMA if field.name not in OF_PLAN)
UNIQUE = (parts.KEY, "slot", "identity", "arrays", parts.TEXT)  # values that hardly repeat
NEEDS = "rows stay in files, since packing them needs the package pyarrow: pip install 'firsthit[report]'"


@dataclass(frozen=True)
class Packed:
    """Hold what packing did.

    rows: how many rows went from files into parts
    files: how many files were removed because a part holds the same bytes, as one that was killed leaves them
    reason: why rows stayed in files although there are many; "" where none did
    mended: how many rows of damaged parts were written anew, those whose own checksums hold
    """

    rows: int = 0
    files: int = 0
    reason: str = ""
    mended: int = 0


def arrow_types() -> dict[Kind, pa.DataType]:
    """Return the type of Arrow for each kind of field."""
    import pyarrow as pa

    return {
        "text": pa.string(),
        "real": pa.float64(),
        "whole": pa.int64(),
        "flag": pa.bool_(),
        "json": pa.string(),
        "reals": pa.list_(pa.float64()),
    }


def schema() -> pa.Schema:
    """Return the columns of a part: those of reports, the family of hard rays, and the row's bytes."""
    import pyarrow as pa

    kinds = arrow_types()
    told = [pa.field(field.name, kinds[field.kind]) for field in FIELDS]
    return pa.schema([*told, pa.field(FAMILY, pa.string()), pa.field(parts.TEXT, pa.binary())])


_flatten = flattener_of_many(FIELDS)


def table(rows: Sequence[tuple[Row, bytes]]) -> pa.Table:
    """Make the table of rows, each with the bytes of its file, as a part holds it."""
    import pyarrow as pa

    told = schema()
    columns = [*_flatten([row for row, _ in rows]), [row.get(FAMILY) for row, _ in rows], [text for _, text in rows]]
    return pa.table([pa.array(values, field.type) for values, field in zip(columns, told, strict=True)], schema=told)


def group(part: parts.Part, number: int) -> pa.Table:
    """Read a group of rows of a part, with those columns of `schema` that it has.

    Raises OSError or ValueError where it is damaged.
    """
    names = [name for name in schema().names if name in part.file.schema_arrow.names]
    _ = part.ends  # holds the groups' sizes against what is allowed
    with parts.damage():
        return part.file.read_row_group(number, columns=names).select(names)


@uncollected()
def write_part(folder: Path, rows: Iterable[tuple[Row, bytes]]) -> Path:
    """Write rows, at least one, as the next part of a run's folder, and return it when it is on the disk.

    `rows` are each a row that was read and the bytes of its file. Raises FirsthitError where it cannot be written.
    """
    import pyarrow.parquet as pq

    place, told = folder / parts.FOLDER, schema()
    try:
        place.mkdir(parents=True, exist_ok=True)
        number = max((parts.number_of(path) for path in parts.parts_in(folder)), default=0) + 1
        with temporary_folder(within=place) as scratch:
            new = scratch / "part"
            coded = [name for name in told.names if name not in UNIQUE and told.field(name).type == "string"]
            options: dict[str, Any] = {"compression": "zstd", "use_dictionary": coded, "write_statistics": False}
            with (
                pq.ParquetWriter(new, told, write_page_checksum=True, **options) as writer,
                ThreadPoolExecutor(1) as beside,
            ):

                def write(made: pa.Table) -> None:  # Arrow's work, beside Python's for the next group
                    writer.write_table(made, row_group_size=GROUP)

                waiting, writing = iter(rows), beside.submit(lambda: None)
                while group := list(islice(waiting, GROUP)):
                    made = table(group)
                    writing.result()
                    writing = beside.submit(write, made)
                writing.result()
            flush(new)
            path = place / f"{number:06d}-{parts.hash_of(new)}.parquet"
            new.chmod(0o644)
            new.replace(path)
        _flush_folder(place)
    except OSError as error:
        raise FirsthitError(f"cannot write {place}: {error.strerror or error}", exit_code=3) from None
    return path


def compact(folder: Path, most: int | None = None) -> Packed:
    """Pack the rows of a run's folder into parts where more than `most`, MOST if not given, have files of their own.

    Files of rows whose very bytes a part holds are removed in any case, and a damaged part is replaced by one of its
    rows that can be read; one of which none can is left as it is. Without pyarrow nothing is packed, and the
    answer says so. Raises FirsthitError where a part cannot be written; the files then stay.
    """
    store = Store(folder)
    keys, most = store.files(), MOST if most is None else most
    if len(keys) <= most and not parts.parts_in(folder):
        return Packed()
    try:
        import pyarrow.parquet  # noqa: F401
    except ModuleNotFoundError:
        return Packed(reason=NEEDS)
    damaged = [part for part in store.parts.all() if part.problem and len(part.keys)]
    mended = sum(_rewrite(store, part) for part in damaged)
    removed = [key for key in keys if _is_held(store, key)]
    _remove(store, removed)
    keys = sorted(set(keys) - set(removed))
    if len(keys) <= most:
        return Packed(files=len(removed), mended=mended)
    packed, ordered = 0, _in_order(folder, keys)
    for start in range(0, len(ordered), ROWS):
        held, some = list[str](), ordered[start : start + ROWS]
        write_part(folder, _read(store, some, held)) if _any(store, some) else None
        _remove(store, held)
        packed += len(held)
    return Packed(packed, len(removed), mended=mended)


def without(folder: Path, keys: Collection[str]) -> int:
    """Remove the rows of `keys` from the files and the parts of a run's folder, and return how many there were.

    A part that has some of them is written anew without them before the old one goes. A damaged part is left as it is.
    Raises FirsthitError where a part cannot be written, or a file cannot be removed.
    """
    store, gone = Store(folder), set(keys)
    removed = gone & set(store.files())
    for key in removed:
        _unlink(store.place(key))
    for part in store.parts.all():
        named = {key.decode() for key in part.keys.tolist()}
        if not part.problem and not named.isdisjoint(gone):
            removed |= named & gone
            _rewrite(store, part, gone)
    return len(removed)


def _rewrite(store: Store, part: parts.Part, gone: Collection[str] = ()) -> int:
    """Write the rows of a part that count, but for those that are `gone`, as a new part, and remove the old one.

    Returns how many rows were written. Raises FirsthitError where that cannot be done.
    """
    which, places = store.parts.locate(part.keys)
    number = store.parts.all().index(part)
    at = np.flatnonzero(which == number)  # a later part stands before this one
    kept = [key for i in at[np.argsort(places[at])].tolist() if (key := part.keys[i].decode()) not in gone]
    if kept:
        write_part(store.folder, ((row_of(text, key), text) for key, text in _texts(part, kept)))
    _unlink(part.path)
    return len(kept)


def _unlink(path: Path) -> None:
    """Remove a file. Raises FirsthitError where that cannot be done."""
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise FirsthitError(f"cannot remove {path}: {error.strerror}", exit_code=3) from None


def _texts(part: parts.Part, keys: Iterable[str]) -> Iterator[tuple[str, bytes]]:
    """Yield the bytes of rows of a part, by their keys, which are in the order of the part."""
    held, texts = -1, None
    for key in keys:
        row = part.row_of(key.encode())
        assert row is not None
        group, at = part.group_of(row)
        if group != held:
            held, texts = group, part.texts(group)
        assert texts is not None
        yield key, texts[at].as_py()


def _is_held(store: Store, key: str) -> bool:
    """Tell whether a part holds the bytes of a row's file."""
    try:
        return store.parts.find(key) is not None and store.parts.text(key) == store.text(key)
    except (OSError, ValueError):
        return False


def _in_order(folder: Path, keys: Sequence[str]) -> list[str]:
    """Return keys in the plan's order, in which reports read them; those that the plan does not name follow."""
    try:
        told = plan_file.read(folder / "plan.json")
    except (OSError, ValueError):
        return list(keys)
    order = {cell["key"]: at for at, cell in enumerate((*told["cells"], *told.get("families", ())))}
    return sorted(keys, key=lambda key: order.get(key, len(order)))


def _any(store: Store, keys: Iterable[str]) -> bool:
    """Tell whether any of these rows can be read."""
    return next(_read(store, keys, []), None) is not None


def _read(store: Store, keys: Iterable[str], held: list[str]) -> Iterator[tuple[Row, bytes]]:
    """Yield the rows that can be read with the bytes of their files, and note their keys."""
    for key in keys:
        try:
            text = store.text(key)
            row = row_of(text, key)
        except (OSError, ValueError):
            continue
        held.append(key)
        yield row, text


def _remove(store: Store, keys: Iterable[str]) -> None:
    """Remove files of rows."""
    for key in keys:
        with contextlib.suppress(OSError):  # one that stays is found again as held by a part
            (store.folder / "cells" / f"{key}{ENDING}").unlink()


def _flush_folder(folder: Path) -> None:
    """Wait until the names in a folder are on the disk, where the system can."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
