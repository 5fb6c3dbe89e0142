"""Keep what was found of cells that have no row yet, so that a process which is killed loses only the step that ran.

begun/<session>.jsonl    the cells that are timed together: what checking found, how each was warmed, and each round
begun/again.jsonl        the keys of cells that `--force` or `--retry` runs again, though they have rows

A line is a checksum and a JSON object. A line that is torn, as a power cut leaves it, counts as not there. Lines are
only ever appended, in one write each, so that they stay when the process is killed. They are forced to the disk
(fsync) when the last cell of a session is checked, and then between rounds every FLUSH seconds: that is what a power
cut may cost.

A file goes when the last row of its cells is stored. One that was left, and whose cells nobody asks for any more, goes
a day after it was last written. Only who holds the lock of the run's folder (harness.results.lock) writes here.
"""

from __future__ import annotations

import contextlib
import json
import os
import time
import zlib
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError
from harness.results.writing import DAY

FORMAT = 1
FLUSH = 30.0  # seconds
AGAIN = "again.jsonl"
TRIES = 100  # to open a file whose folder others remove
Sample = tuple[float, float | None, float]  # ms by the host's clock, by the device's, and seconds that it ran


@dataclass(eq=False)
class Kept:
    """Hold what is kept of a cell without a row.

    checked: what checking found, as the runner gave it; pictures are in the run's arrays
    warmed: what the timed frame cost; None where it was never ready
    samples: by rounds, each with the number of the sitting that took it
    """

    checked: dict[str, Any]
    warmed: dict[str, Any] | None = None
    samples: dict[int, tuple[int, Sample]] = field(default_factory=dict)


@dataclass(eq=False)
class Session:
    """Hold the file of one interleaved session, and what it says of its cells.

    name: the session's, which its rows tell
    sitting: how many processes worked on it before this one, and how often its samples moved to another machine
    next_round: the number of the round that follows all that are kept
    """

    path: Path
    cells: dict[str, Kept] = field(default_factory=dict)
    sitting: int = 0
    next_round: int = 0
    _file: int | None = None
    _flushed: float = 0.0

    @property
    def name(self) -> str:
        return self.path.stem

    def check(self, key: str, checked: Mapping[str, Any]) -> None:
        """Keep what checking found of a cell. Raises FirsthitError where it cannot be written, as all here do."""
        self._append({"cell": key, "checked": checked})

    def warm(self, key: str, warmed: Mapping[str, Any]) -> None:
        """Keep how the frame of a cell was warmed, which was checked before."""
        self._append({"warmed": warmed, "of": key})

    def round(self, number: int, samples: Mapping[str, Sample]) -> None:
        """Keep the samples of a round, or of a part of it, by the keys of their cells."""
        self.next_round = number + 1
        if samples:
            self._append({"round": number, "samples": samples})
        if time.monotonic() - self._flushed > FLUSH:
            self.flush()

    def forget(self, keys: Collection[str]) -> None:
        """Forget what is kept of cells."""
        if gone := [key for key in self.cells if key in keys]:
            for key in gone:
                del self.cells[key]
            if self.cells:
                self._append({"forget": gone})
                self.close()
            else:
                self.remove()

    def sit_again(self) -> None:
        """Begin another sitting: samples that follow are taken by another process, or on another machine."""
        self.sitting += 1
        self._append({"format": FORMAT, "sitting": self.sitting})

    def flush(self) -> None:
        """Wait until all that was kept is on the disk."""
        if self._file is not None:
            with contextlib.suppress(OSError):  # a file system that cannot; the lines are as safe as it makes them
                os.fsync(self._file)
        self._flushed = time.monotonic()

    def close(self) -> None:
        """Close the file, which stays."""
        if self._file is not None:
            os.close(self._file)
            self._file = None

    def remove(self) -> None:
        """Remove the file, since all its cells have rows."""
        self.close()
        _remove(self.path)

    def _append(self, said: Mapping[str, Any]) -> None:
        try:
            if self._file is None:
                self._file, self._flushed = _opened(self.path), time.monotonic()
                _write(self._file, _line({"format": FORMAT, "sitting": self.sitting}))
            _write(self._file, _line(said))
        except OSError as error:
            raise FirsthitError(f"cannot write {self.path}: {error.strerror or error}", exit_code=3) from None


class Begun:
    """Hold what a run's folder keeps of cells without rows."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "begun"
        self._sessions = [_read(path) for path in sorted(self.folder.glob("*.jsonl")) if path.name != AGAIN]
        self._again = _wanted(self.folder / AGAIN)
        self._in_use: set[Path] = set()  # of sessions that a runner works on; several may do so side by side

    def session(self, keys: Collection[str], new: str) -> Session:
        """Return the session that most of these cells were begun in, to go on with; one called `new` where none was.

        What checking found in other sessions counts too. Their samples do not, since those of two sessions were not
        taken in turn. A session that another runner works on is one of the others.
        """
        found = [(session, len(session.cells.keys() & keys)) for session in self._sessions]
        free = [one for one in found if one[0].path not in self._in_use]
        best = max(free, key=lambda one: one[1], default=(Session(Path()), 0))
        session = best[0] if best[1] else Session(self.folder / f"{new}.jsonl")
        self._in_use.add(session.path)
        for other, count in found:
            if count and other is not session:
                for key in other.cells.keys() & keys - session.cells.keys():
                    session.check(key, other.cells[key].checked)
                    session.cells[key] = Kept(other.cells[key].checked)
        return session

    def forget(self, keys: Collection[str]) -> None:
        """Forget what is kept of cells, which are to begin anew."""
        for session in self._sessions:
            session.forget(keys)

    def sweep(self, wanted: Collection[str], has_row: Callable[[str], bool]) -> list[Path]:
        """Remove what is of none of the `wanted` cells, if all of its cells have rows or it is a day old; return it.

        A file that says nothing of any cell, as a damaged one, goes too.
        """
        gone = []
        for session in list(self._sessions):
            if session.cells.keys().isdisjoint(wanted) and (
                all(self._has_ended(key, has_row) for key in session.cells) or _age(session.path) > DAY
            ):
                self._sessions.remove(session)
                session.remove()
                gone.append(session.path)
        again = self.folder / AGAIN
        if self._again.isdisjoint(wanted) and _age(again) > (DAY if self._again else 0.0):
            _remove(again)
            self._again = set()
            gone.append(again)
        return gone

    def without(self, keys: Collection[str]) -> list[Path]:
        """Return the files of sessions that say nothing of any of these cells."""
        return [session.path for session in self._sessions if session.cells.keys().isdisjoint(keys)]

    def done(self, session: Session, has_row: Callable[[str], bool]) -> None:
        """Remove the file of a session that was timed to its end, and those of others, if all their cells have rows.

        A file that names other cells too, which are timed apart from these by now, stays for them.
        """
        self._in_use.discard(session.path)
        for one in {*self._sessions, session}:
            if one.path not in self._in_use and all(self._has_ended(key, has_row) for key in one.cells):
                self._sessions = [other for other in self._sessions if other is not one]
                one.remove()

    def _has_ended(self, key: str, has_row: Callable[[str], bool]) -> bool:
        return has_row(key) and key not in self._again

    @property
    def again(self) -> frozenset[str]:
        """Return the keys of the cells that are to be run although they have rows."""
        return frozenset(self._again)

    def ask_again(self, keys: Iterable[str]) -> None:
        """Keep that cells are to be run although they have rows."""
        new = sorted(set(keys) - self._again)
        if new:
            self._again.update(new)
            self._append_again({"again": new})

    def ended(self, key: str) -> None:
        """Keep that the row of a cell is stored."""
        if key in self._again:
            self._again.remove(key)
            if self._again:
                self._append_again({"ended": key})
            else:
                _remove(self.folder / AGAIN)

    def _append_again(self, said: Mapping[str, Any]) -> None:
        path = self.folder / AGAIN
        try:
            file = _opened(path)
            try:
                _write(file, _line(said))
            finally:
                os.close(file)
        except OSError as error:
            raise FirsthitError(f"cannot write {path}: {error.strerror or error}", exit_code=3) from None


def _remove(path: Path) -> None:
    """Remove a file, and its folder with the last one."""
    with contextlib.suppress(OSError):
        path.unlink(missing_ok=True)
        path.parent.rmdir()


def _opened(path: Path) -> int:
    """Open a file to append to; a last line that was torn is ended first."""
    for tried in range(TRIES):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o644)
            break
        except FileNotFoundError:  # the folder went with the last file of another session
            if tried == TRIES - 1:
                raise
    length = os.fstat(file).st_size
    if length and os.pread(file, 1, length - 1) != b"\n":
        _write(file, b"\n")
    return file


def _write(file: int, line: bytes) -> None:
    """Write a whole line. Raises OSError where the disk takes a part of it only."""
    while line:
        line = line[os.write(file, line) :]


def _line(said: Mapping[str, Any]) -> bytes:
    text = json.dumps(said, separators=(",", ":")).encode()
    return b"%08x %s\n" % (zlib.crc32(text), text)


def _lines(path: Path) -> Iterator[dict[str, Any]]:
    """Yield the objects of the lines that are whole."""
    try:
        lines = path.read_bytes().split(b"\n")
    except OSError:
        return
    for line in lines:
        with contextlib.suppress(ValueError, RecursionError):
            if int(line[:8], 16) == zlib.crc32(line[9:]) and isinstance(said := json.loads(line[9:]), dict):
                yield said


def _read(path: Path) -> Session:
    """Read a session's file. What is damaged in it is not there; of another format, nothing is."""
    session = Session(path)
    for said in _lines(path):
        try:
            _hear(session, said)
        except (LookupError, TypeError, ValueError):  # of another version
            return Session(path)
    session.sitting += 1
    return session


def _hear(session: Session, said: Mapping[str, Any]) -> None:
    """Add what a line says to a session. Raises LookupError, TypeError and ValueError for a line of another format."""
    if "sitting" in said:
        if said["format"] != FORMAT:
            raise ValueError(said["format"])
        session.sitting = int(said["sitting"])
    elif "cell" in said:
        session.cells[str(said["cell"])] = Kept(dict(said["checked"]))
    elif "warmed" in said:
        if kept := session.cells.get(said["of"]):
            kept.warmed = dict(said["warmed"])
    elif "round" in said:
        number = int(said["round"])
        session.next_round = max(session.next_round, number + 1)
        for key, (wall, device, seconds) in dict(said["samples"]).items():
            if kept := session.cells.get(key):
                sample = float(wall), None if device is None else float(device), float(seconds)
                kept.samples[number] = (session.sitting, sample)
    else:
        for key in said["forget"]:
            session.cells.pop(key, None)


def _wanted(path: Path) -> set[str]:
    wanted: set[str] = set()
    for said in _lines(path):
        with contextlib.suppress(TypeError):  # of another version
            wanted.update(map(str, said.get("again", ())))
            wanted.discard(said.get("ended", ""))
    return wanted


def _age(path: Path) -> float:
    """Return the seconds since a file was last written; 0 where it is gone."""
    try:
        return time.time() - path.stat().st_mtime
    except OSError:
        return 0.0


def counts(sittings: Iterable[int]) -> list[int]:
    """Count the samples of each sitting, in the order of the sittings; those that took none are left out."""
    return [count for _, count in sorted(Counter(sittings).items())]
