"""Write files that somebody keeps, whole or not at all: a process that is stopped half-way leaves the old file.

Everything goes to a temporary file in the same folder first, is flushed to the disk, and then takes the place of the
file of its name, which a file system does in one step.

What a process that was killed leaves of this is removed by the next one that writes into the same folder. Temporary
files and folders have names that say whose they are, so that nobody removes what another still writes.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError
from harness.results import owner

NEW = ".new"
OWNED = re.compile(r"(?P<machine>[0-9a-f]{8})-(?P<pid>\d{1,9})-(?P<born>\d{1,19})-[a-z0-9_]{8}(\..*)?", re.DOTALL)
DAY = 86_400.0  # seconds, after which what a process of another machine left is nobody's
SPECIAL = "it is a device or a pipe; name a file"
_swept: set[tuple[Path, str]] = set()  # folders that this process has looked at, and for which names


@contextlib.contextmanager
def temporary_folder(name: str = NEW, within: Path | None = None) -> Iterator[Path]:
    """Yield an empty folder that is removed when the block ends, in `within` or where the system keeps such folders.

    Those of this name that processes which were killed left there are removed first. Raises OSError where the folder
    cannot be made.
    """
    place = within or Path(tempfile.gettempdir())
    _sweep_once(place, name)
    with tempfile.TemporaryDirectory(prefix=_prefix(name), dir=place) as made:
        yield Path(made)


def sweep(folder: Path, name: str = NEW) -> list[Path]:
    """Remove what `replacing` and its like left in `folder` where their process was killed, and return it.

    What another machine's process left is removed when a day old, since whether that has ended cannot be seen. What
    cannot be removed stays. `name` is as for `temporary_folder`.
    """
    _swept.add((folder, name))
    left = left_in(folder, name)
    for path in left:
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path, ignore_errors=True)
        else:
            with contextlib.suppress(OSError):
                path.unlink()
    return [path for path in left if not os.path.lexists(path)]


def sweep_below(folder: Path) -> list[Path]:
    """Sweep a folder and those in it, and return what was removed."""
    try:
        inside = [path for path in sorted(folder.iterdir()) if path.is_dir() and not path.name.startswith(".")]
    except OSError:
        return []
    return [path for place in (folder, *inside) for path in sweep(place)]


def left_in(folder: Path, name: str = NEW) -> list[Path]:
    """List what `sweep` removes."""
    try:
        return [path for path in folder.iterdir() if path.name.startswith(f"{name}-") and _is_left(path, name)]
    except OSError:
        return []


def _is_left(path: Path, name: str) -> bool:
    """Tell whether a path is a temporary one of a process that has ended."""
    owned = OWNED.fullmatch(path.name.removeprefix(f"{name}-"))
    if not owned:
        return False
    if owned["machine"] == owner.machine():
        return owner.has_ended(int(owned["pid"]), int(owned["born"]))
    try:
        return time.time() - path.lstat().st_mtime > DAY
    except OSError:
        return False


def _sweep_once(folder: Path, name: str = NEW) -> None:
    if (folder, name) not in _swept:
        sweep(folder, name)


def is_special(path: Path) -> bool:
    """Tell whether there is something at `path` that is neither a file nor a folder."""
    return path.exists() and not path.is_file() and not path.is_dir()


def _prefix(name: str = NEW) -> str:
    """Return how the names of this process's temporary files and folders begin, by which `sweep` knows them."""
    return f"{name}-{owner.machine()}-{os.getpid()}-{owner.born(os.getpid())}-"


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary file for a library to write, which takes the place of `path` when the block ends.

    Where the block raises, `path` stays as it was and the temporary file is removed. Raises FirsthitError where nothing
    can be written, and for a device or a pipe, such as /dev/stdout, which a file would replace for good.
    """
    if is_special(path):
        raise FirsthitError(f"cannot write {path}: {SPECIAL}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        _sweep_once(path.parent)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=_prefix(), suffix=path.suffix)
        os.close(handle)
        temporary = Path(name)
        try:
            yield temporary
            temporary.chmod(0o644)
            flush(temporary)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)  # only where it did not become `path`
    except OSError as error:
        raise FirsthitError(f"cannot write {path}: {error.strerror or error}", exit_code=3) from None


@contextlib.contextmanager
def replacing_together(folder: Path, what: str) -> Iterator[Path]:
    """Yield an empty folder for files that belong together; each takes the place of its namesake in `folder`.

    `folder` is made where it is missing. All files are complete before the first one is replaced; where the block
    raises, none is. What lies in folders of its own there is thrown away. `what` says in the error what was to be
    written. Raises FirsthitError where nothing can be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with temporary_folder(within=folder) as new:
            yield new
            files = sorted(path for path in new.iterdir() if path.is_file())
            for file in files:
                flush(file)
            for file in files:
                file.replace(folder / file.name)
    except OSError as error:
        raise FirsthitError(f"cannot write {what} into {folder}: {error.strerror or error}", exit_code=3) from error


def write_new(folder: Path, files: Mapping[str, str]) -> None:
    """Write texts as files below `folder` that are not there yet, by their paths in it: all of them, or none.

    Raises FirsthitError, and leaves everything as it was, where one of them is there or cannot be written.
    """
    there = sorted(name for name in files if os.path.lexists(folder / name))
    if there:
        names = f"{', '.join(there)} {'is' if len(there) == 1 else 'are'}"
        raise FirsthitError(f"{names} in {folder.resolve()} already; nothing was written")
    path = folder
    with contextlib.ExitStack() as undo:
        try:
            for path in (folder / name for name in files):
                for parent in (*reversed(path.parent.parents), path.parent):
                    if not parent.exists():
                        parent.mkdir()
                        undo.callback(parent.rmdir)
                with replacing(path) as temporary:
                    temporary.write_bytes(files[path.relative_to(folder).as_posix()].encode())
                undo.callback(path.unlink)
        except OSError as error:
            raise FirsthitError(f"cannot write {path}: {error.strerror or error}", exit_code=3) from None
        undo.pop_all()  # all were written: nothing is taken back


def write_atomically(path: Path, content: bytes) -> None:
    """Replace `path` by `content`. Raises FirsthitError where it cannot be written."""
    with replacing(path) as temporary:
        temporary.write_bytes(content)


def savez_atomically(path: Path, **arrays: NDArray[Any]) -> None:
    """Write arrays as one compressed .npz. Raises FirsthitError where it cannot be written."""
    with replacing(path) as temporary, temporary.open("wb") as file:
        np.savez_compressed(file, **cast(Any, arrays))


def flush(path: Path) -> None:
    """Wait until a file's content is on the disk, since its new name may get there first."""
    with path.open("r+b") as file:
        os.fsync(file.fileno())
