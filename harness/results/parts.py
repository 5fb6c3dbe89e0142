"""Read rows that were packed into Parquet, parts/<number>-<SHA-256>.parquet (harness/results/compaction.py packs them).

A part holds of each row the bytes of the file that it had (TEXT), its key, and the columns that reports read. Its name
holds the SHA-256 of its bytes, as `sha256sum` prints it, so that damage is seen before a value is used. Where that hash
does not hold, the columns are not used; each row whose own bytes still hold for their own checksum is, and the others
are lost. Such a part is read by a process of its own (harness.results.salvage), since it may end the one that reads it.
A row in a file stands before the same row in a part, and one in a later part before that in an earlier one.

Rows lie in groups of some thousand, and reading one row reads its group: `in_storage_order` tells in which order
reading many is fast.
"""

from __future__ import annotations

import bisect
import contextlib
import hashlib
import re
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, plural
from harness.results import salvage, sealed

if TYPE_CHECKING:
    import pyarrow as pa
    import pyarrow.parquet as pq

FOLDER = "parts"
KEY, TEXT = "key", "text of the row"
LARGEST_GROUP = 2**30  # bytes of one column of a group of rows, unpacked
LARGEST = 2**36  # bytes of a part
HELD = 4  # groups of rows whose bytes are held
CHUNK = 2**22
State: TypeAlias = tuple[tuple[str, int, int], ...]  # of each part: its name, size and time of change
_NAME = re.compile(r"(?P<number>\d{6})-(?P<hash>[0-9a-f]{64})\.parquet")
_NO_KEYS: NDArray[np.bytes_] = np.empty(0, "S1")


def needs(package: str) -> FirsthitError:
    """Return the error that rows in parts cannot be read without a package."""
    return FirsthitError(
        f"rows in Parquet parts need the package {package}: pip install 'firsthit[report]'", exit_code=3
    )


@contextlib.contextmanager
def damage() -> Iterator[None]:
    """Make a ValueError of all that pyarrow raises within the block for a file that is damaged."""
    import pyarrow as pa

    try:
        yield
    except pa.ArrowException as error:
        raise ValueError(sealed.problem(error) or type(error).__name__) from None


def hash_of(path: Path) -> str:
    """Return the SHA-256 of a file. Raises OSError or ValueError where it cannot be read, or is no ordinary file."""
    found = hashlib.sha256()
    with sealed.opened(path, LARGEST) as file:
        while chunk := file.read(CHUNK):
            found.update(chunk)
    return found.hexdigest()


def parts_in(folder: Path) -> list[Path]:
    """List the parts of a run's folder, the earliest first."""
    try:
        return sorted(path for path in (folder / FOLDER).iterdir() if _NAME.fullmatch(path.name))
    except OSError:
        return []


def number_of(path: Path) -> int:
    """Return the number of a part, by which later ones are known."""
    named = _NAME.fullmatch(path.name)
    assert named is not None
    return int(named["number"])


@dataclass(eq=False)
class Part:
    """Hold one part: which rows it has, and where.

    problem: "" where its hash holds; else what is wrong, and how many rows are lost where that can be told
    keys: of its rows that can be read, sorted
    rows: the place of each in the part, or in `saved`
    saved: the bytes of the rows that can be read where its hash does not hold; its file is not opened here any more
    """

    path: Path
    problem: str = ""
    saved: list[bytes] | None = None
    keys: NDArray[np.bytes_] = field(default_factory=lambda: _NO_KEYS)
    rows: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, np.int64))

    @cached_property
    def file(self) -> pq.ParquetFile:
        """Return the open file. Raises OSError, ValueError or FirsthitError where it cannot be opened."""
        try:
            import pyarrow.parquet as pq
        except ModuleNotFoundError as error:
            raise needs(str(error.name)) from None
        with damage():
            opened = pq.ParquetFile(self.path, page_checksum_verification=True)
        names = set(opened.schema_arrow.names)
        if not {KEY, TEXT} <= names:
            raise ValueError(f"it has no column {KEY if KEY not in names else TEXT!r}")
        return opened

    @cached_property
    def ends(self) -> list[int]:
        """Return for each group of rows the place behind its last one. Raises ValueError where one is too large."""
        told, ends = self.file.metadata, [0]
        for i in range(told.num_row_groups):
            group = told.row_group(i)
            sizes = (group.column(c).total_uncompressed_size for c in range(group.num_columns))
            if max(sizes, default=0) > LARGEST_GROUP:
                raise ValueError(f"a column of its rows unpacks to more than {LARGEST_GROUP:,} bytes")
            ends.append(ends[-1] + group.num_rows)
        return ends[1:]

    def group_of(self, row: int) -> tuple[int, int]:
        """Return in which group of rows a row lies, and its place there."""
        if self.saved is not None:
            return 0, row
        group = bisect.bisect_right(self.ends, row)
        return group, row - (self.ends[group - 1] if group else 0)

    def texts(self, group: int) -> pa.ChunkedArray:
        """Read the bytes of the rows of a group. Raises OSError or ValueError where they are damaged."""
        if self.saved is not None:
            import pyarrow as pa

            return pa.chunked_array([pa.array(self.saved, pa.large_binary())])
        _ = self.ends  # holds the groups' sizes against what is allowed
        with damage():
            found = self.file.read_row_group(group, columns=[TEXT], use_threads=False).column(0)
        if str(found.type) not in ("binary", "large_binary"):
            raise ValueError(f"{TEXT!r} is of {found.type}, not binary")
        return found

    def row_of(self, key: bytes) -> int | None:
        """Return the place of the row of a key; None where the part has none that can be read."""
        at = int(np.searchsorted(self.keys, key))
        return int(self.rows[at]) if at < len(self.keys) and self.keys[at] == key else None


def opened(path: Path) -> Part:
    """Open a part, and hold it against the hash in its name. What is wrong with it stands in its `problem`."""
    part = Part(path)
    named = _NAME.fullmatch(path.name)
    try:
        whole = named is not None and hash_of(path) == named["hash"]
        if whole:
            _ = part.ends
            with damage():
                found = _bytes_of(part.file.read(columns=[KEY], use_threads=False).column(0).to_pylist())
        else:
            total, texts = salvage.rows_of(path)
            keys, part.saved = _sound(texts)
            found = _bytes_of(keys)
            lost = "none of its rows can be read"
            if total is not None and len(keys) <= total:
                lost = f"{plural(total - len(keys), 'row')} of {total:,} cannot be read"
            part.problem = f"the hash in its name does not hold: the file was changed after it was written; {lost}"
    except (OSError, ValueError) as error:
        return Part(path, sealed.problem(error) or "it cannot be read")
    order = np.argsort(found, kind="stable")
    part.keys, part.rows = found[order], np.arange(len(found))[order]
    return part


def _bytes_of(keys: Iterable[str]) -> NDArray[np.bytes_]:
    """Return keys as an array. Raises ValueError for what is no key."""
    told = list(keys)
    if not all(isinstance(key, str) and key.isascii() and key.isalnum() and len(key) <= 64 for key in told):
        raise ValueError("it holds a key that is none")
    return np.array(told, dtype=np.bytes_) if told else _NO_KEYS


def _sound(texts: Iterable[bytes]) -> tuple[list[str], list[bytes]]:
    """Return the keys of the rows whose own bytes hold, and these bytes."""
    keys, kept = list[str](), list[bytes]()
    for text in texts:
        try:
            document = sealed.unsealed(text) if sealed.has_seal(text) else {}
        except ValueError:
            continue
        if isinstance(key := document.get("key"), str) and key.isascii() and key.isalnum() and len(key) <= 64:
            keys.append(key)
            kept.append(text)
    return keys, kept


class Parts:
    """Find and read the rows of the parts of one run's folder, which may get new parts meanwhile."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._parts: dict[Path, Part] = {}
        self._texts: OrderedDict[tuple[Path, int], pa.ChunkedArray] = OrderedDict()

    def all(self) -> list[Part]:
        """Return the parts that are there now, the earliest first.

        Raises FirsthitError, with exit code 3, where there are some and the package that reads them is missing.
        """
        there = parts_in(self.folder)
        if there != list(self._parts):
            self._parts = {path: self._parts.get(path) or opened(path) for path in there}
        return list(self._parts.values())

    def state(self) -> State:
        """Return what changes where a part does."""
        return tuple((path.name, path.lstat().st_size, path.lstat().st_mtime_ns) for path in parts_in(self.folder))

    def find(self, key: str) -> tuple[Part, int] | None:
        """Return the part that holds the row of a key, and the row's place in it; None where none does."""
        if not key.isascii():
            return None
        for part in reversed(self.all()):
            if (row := part.row_of(key.encode())) is not None:
                return part, row
        return None

    def locate(self, keys: NDArray[np.bytes_]) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
        """Return for each key the place of its part in `all()`, -1 where none has it, and the row's place there."""
        wanted, places = np.unique(keys, return_inverse=True)
        which, rows = np.full(len(wanted), -1, np.int32), np.zeros(len(wanted), np.int64)
        for number, part in enumerate(self.all() if len(wanted) else ()):  # a later one overwrites
            at = np.minimum(np.searchsorted(wanted, part.keys), len(wanted) - 1)
            there = np.flatnonzero(wanted[at] == part.keys)[::-1]  # of two rows of one key the first counts
            which[at[there]], rows[at[there]] = number, part.rows[there]
        return which[places], rows[places]

    def text(self, key: str) -> bytes:
        """Return the bytes of the file that a row had.

        Raises FileNotFoundError where no part has the row, and OSError or ValueError where it is damaged.
        """
        found = self.find(key)
        if found is None:
            raise FileNotFoundError(f"no part has the row {key}")
        part, row = found
        group, at = part.group_of(row)
        place = part.path, group
        if place not in self._texts:
            self._texts[place] = part.texts(group)
            if len(self._texts) > HELD:
                self._texts.popitem(last=False)
        self._texts.move_to_end(place)
        text = self._texts[place][at].as_py()
        if not isinstance(text, bytes):
            raise ValueError("it holds no bytes of the row")
        return text

    def keys(self) -> Iterator[str]:
        """Yield the key of every row that can be read, once each, those of later parts first."""
        seen: set[bytes] = set()
        for part in reversed(self.all()):
            for key in part.keys.tolist():
                if key not in seen:
                    seen.add(key)
                    yield key.decode()

    def keys_with(self, column: str, value: str) -> Iterator[str]:
        """Yield the keys of rows that have a text in a column, and of all of a part whose columns cannot be used.

        Only these columns are read.
        """
        for part in self.all():
            try:
                if part.problem or column not in part.file.schema_arrow.names:
                    raise ValueError("it has not this column, or one that is not to be used")
                with damage():
                    read = part.file.read(columns=[KEY, column])
            except (OSError, ValueError):
                yield from (key.decode() for key in part.keys.tolist())
                continue
            told = zip(read.column(KEY).to_pylist(), read.column(column).to_pylist(), strict=True)
            yield from (key for key, found in told if found == value)

    def in_storage_order(self, keys: Iterable[str]) -> list[str]:
        """Return the keys in the order in which reading their rows is fast; those of no part come first."""

        told = list(keys)
        if not self.all():
            return told
        which, rows = self.locate(np.array([key.encode() for key in told], dtype=np.bytes_))
        return [told[at] for at in np.lexsort((rows, which))]

    def problems(self) -> dict[str, str]:
        """Return what is wrong with parts, by their names below the folder."""
        return {f"{FOLDER}/{part.path.name}": part.problem for part in self.all() if part.problem}
