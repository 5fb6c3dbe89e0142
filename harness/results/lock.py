"""Give a run's folder one writer at a time: who wants to write takes its lock, and who reads takes none.

The lock is the file `.lock` in the folder. The system locks it (flock), so that the lock is gone with its process,
however that ends. Its text says who holds it, for whoever comes second; a file without text is nobody's.

A system lock of another machine may not be seen on a shared file system. So the holder touches the file every
BEAT seconds, and a text of another machine holds for SILENT seconds after its last touch. Where the file system has no
locks at all, the text and the touch alone decide: two processes that begin within PAUSE seconds are told apart, and
two that write the text in the same moment after it are not.
"""

from __future__ import annotations

import contextlib
import json
import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from datetime import datetime
from pathlib import Path
from typing import Any

from harness.contract import FirsthitError
from harness.results import owner

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

NAME = ".lock"
BEAT = 10.0  # seconds between two signs of life of who holds a lock
SILENT = 60.0  # seconds without one, after which the lock of another machine's process is nobody's
PAUSE = 0.1  # seconds
NEXT_LOOK = 0.5  # seconds between two looks of who waits
TRIES = 100  # to take a lock whose file or folder others remove
Doing = Callable[[str], AbstractContextManager[Any]]  # says what goes on while a block runs


class Held(Exception):
    """Say who holds a lock, and since when, in a clause that begins with the folder."""


class Lock:
    """Hold the right to write into a folder, from `take` to the end of the `with` block.

    command: what the holder runs, for who comes second
    wait: wait until another holder has ended; else FirsthitError is raised
    doing: says that it waits
    """

    def __init__(self, folder: Path, command: str, *, wait: bool = False, doing: Doing | None = None) -> None:
        self.folder, self._path = folder, folder / NAME
        self._command, self._wait, self._doing = command, wait, doing
        self._file: int | None = None
        self._made = False  # whether this object made the folder
        self._ended = threading.Event()

    def __enter__(self) -> Lock:
        return self

    def __exit__(self, *_: object) -> None:
        self.release()

    def take(self) -> None:
        """Take the lock, if it is not held by this object already; the folder is made where it is missing.

        Raises FirsthitError with exit code 3 where another process holds it and nobody wants to wait, and where its
        file cannot be written.
        """
        if self._file is not None:
            return
        try:
            try:
                self._file = self._taken()
            except Held as held:
                if not self._wait:
                    told = f"{held}; with --wait (in Python wait=True) this command waits for it"
                    raise FirsthitError(told, exit_code=3) from None
                with self._doing(f"waiting: {held}") if self._doing else contextlib.nullcontext():
                    self._file = self._waited()
        except OSError as error:
            raise FirsthitError(f"cannot write {self._path}: {error.strerror or error}", exit_code=3) from None
        self._ended.clear()
        threading.Thread(target=_beat, args=(os.dup(self._file), self._ended), daemon=True).start()

    def release(self) -> None:
        """Give the lock back, if it is held; a folder that was made for it goes too, if nothing was written there."""
        if self._file is not None:
            file, self._file = self._file, None
            self._ended.set()
            with contextlib.suppress(OSError):
                alone = self._made and [one.name for one in self.folder.iterdir()] == [NAME]
                if alone and _is_at(file, self._path):  # and no other's, where this one was removed by hand
                    self._path.unlink()
                    self.folder.rmdir()
            with contextlib.suppress(OSError):
                os.ftruncate(file, 0)
            if fcntl:
                with contextlib.suppress(OSError):
                    fcntl.flock(file, fcntl.LOCK_UN)  # the thread that touches it has the file open a moment longer
            os.close(file)

    def _waited(self) -> int:
        while True:
            time.sleep(NEXT_LOOK)
            with contextlib.suppress(Held):
                return self._taken()

    def _taken(self) -> int:
        """Take the lock and return its open file. Raises Held, and OSError where the file cannot be written."""
        for tried in range(TRIES):
            try:
                with contextlib.ExitStack() as undo:
                    file = self._opened()
                    undo.callback(os.close, file)
                    if self._claim(file):
                        undo.pop_all()  # it stays open
                        return file
            except FileNotFoundError:  # who held the lock has just removed the folder
                if tried == TRIES - 1:
                    raise
        raise OSError("others remove it all the time")

    def _opened(self) -> int:
        """Open the lock's file; it and its folder are made where they are missing. Raises OSError."""
        try:
            self.folder.mkdir(parents=True)
            self._made = True
        except FileExistsError:
            self._made = False
        return os.open(self._path, os.O_RDWR | os.O_CREAT, 0o666)

    def _claim(self, file: int) -> bool:
        """Take the lock by its open file; return False where it was removed a moment ago. Raises as `_taken`."""
        locked = _locked(file)
        if locked is False or self._is_held(file, locked is True):
            raise Held(self._told(file))
        if not _is_at(file, self._path):
            return False
        text = json.dumps(_said(self._command)).encode()
        os.ftruncate(file, 0)
        os.pwrite(file, text, 0)
        if locked is None:
            time.sleep(PAUSE)
            if _text(file) != text:
                raise Held(self._told(file))
            return _is_at(file, self._path)  # who held it before may have removed it meanwhile
        return True

    def _is_held(self, file: int, locked: bool) -> bool:
        """Tell whether the process that the text names still holds the lock, which the system has given us or lacks."""
        said = _read(file)
        if not said:
            return False
        if said["boot"] == owner.boot() and said["host"] == owner.host():
            return not locked and not owner.has_ended(said["pid"], said["born"])
        if locked and said["boot"] is not None and said["boot"] == owner.boot():  # another container of this machine
            return False
        return self._silence(file) < SILENT

    def _silence(self, file: int) -> float:
        """Return the seconds since the last sign of life, by the clock of the file system."""
        with tempfile.TemporaryFile(dir=self.folder) as now:
            now.write(b"now")
            now.flush()
            return os.fstat(now.fileno()).st_mtime - os.fstat(file).st_mtime

    def _told(self, file: int) -> str:
        """Say who holds the lock."""
        for _ in range(5):
            said = _read(file)
            if said:
                break
            time.sleep(PAUSE / 2)  # it is about to write its text, or has just removed it
        else:
            return f"{self.folder} is being written by a process that does not say who it is"
        here = said["host"] == owner.host()
        where = "" if here else f" on {said['host']}"
        told = (
            f"{self.folder} is being written by `{said['command']}` (process {said['pid']} of {said['user']}{where}) "
            f"since {said['started']}"
        )
        if here:
            return told
        silent = f"{self._silence(file):.0f} s ago"
        return f"{told}, and gave its last sign of life {silent}; if it has ended, remove {self._path}"


@contextlib.contextmanager
def locked(folders: Iterable[Path], command: str, *, wait: bool = False, doing: Doing | None = None) -> Iterator[None]:
    """Hold the locks of folders while the block runs, taken in one order by all, so that nobody waits in a circle.

    Raises FirsthitError as Lock.take does.
    """
    with contextlib.ExitStack() as held:
        for folder in sorted({folder.resolve(): folder for folder in folders}.items()):
            held.enter_context(Lock(folder[1], command, wait=wait, doing=doing)).take()
        yield


def _locked(file: int) -> bool | None:
    """Ask the system to lock a file: whether it did, or None where it has no locks for it."""
    if fcntl is None:
        return None
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # ENOLCK, ENOSYS, ENOTSUP, as the file system likes
        return None
    return True


def _is_at(file: int, path: Path) -> bool:
    """Tell whether an open file is still the one at `path`."""
    try:
        return os.path.samestat(os.fstat(file), path.stat())
    except FileNotFoundError:
        return False


def _said(command: str) -> dict[str, Any]:
    """Return what the text of a lock says of this process."""
    return {
        "pid": os.getpid(),
        "born": owner.born(os.getpid()),
        "boot": owner.boot(),
        "host": owner.host(),
        "user": owner.user(),
        "command": command,
        "started": datetime.now().astimezone().isoformat(sep=" ", timespec="seconds"),
    }


def _text(file: int) -> bytes:
    os.lseek(file, 0, os.SEEK_SET)
    return os.read(file, 100_000)


def _read(file: int) -> dict[str, Any] | None:
    """Return what the text of a lock says; None where there is none, or where it is damaged."""
    try:
        said = json.loads(_text(file))
    except (ValueError, RecursionError):
        return None
    kinds = {"pid": int, "born": int, "host": str, "user": str, "command": str, "started": str}
    if not isinstance(said, dict) or any(type(said.get(name)) is not kind for name, kind in kinds.items()):
        return None
    return said if isinstance(said.setdefault("boot", None), str | None) else None


def _beat(file: int, ended: threading.Event) -> None:
    """Touch a lock's file until its holder has ended."""
    try:
        while not ended.wait(BEAT):
            with contextlib.suppress(OSError):
                os.utime(file)
    finally:
        os.close(file)
