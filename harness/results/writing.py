"""Write files that somebody keeps, whole or not at all: a process that is stopped half-way leaves the old file.

Everything goes to a temporary file in the same folder first, is flushed to the disk, and then takes the place of the
file of its name, which a file system does in one step.
"""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError


@contextlib.contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary file for a library to write, which takes the place of `path` when the block ends.

    Where the block raises, `path` stays as it was and the temporary file is removed. Raises FirsthitError where nothing
    can be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix)
        os.close(handle)
        temporary = Path(name)
        try:
            yield temporary
            temporary.chmod(0o644)
            _flush(temporary)
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
        with tempfile.TemporaryDirectory(prefix=".new-", dir=folder) as name:
            yield Path(name)
            files = sorted(path for path in Path(name).iterdir() if path.is_file())
            for file in files:
                _flush(file)
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


def _flush(path: Path) -> None:
    """Wait until a file's content is on the disk, since its new name may get there first."""
    with path.open("r+b") as file:
        os.fsync(file.fileno())
