"""Read files that may be damaged, and seal JSON files by a checksum, so that damage is seen before a value is used.

A sealed file's first line is `{"checksum": "…",`, of the SHA-256 of all bytes after that line: what
`tail -n +2 FILE | sha256sum` prints. Files of older versions have no checksum and are read too. All that is wrong with
a file is a ValueError or an OSError, whose `problem` is one line.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO

LARGEST = 256 * 2**20  # bytes of a JSON or TOML file that is read
DEEPEST = 64  # objects and lists within each other
CHECKSUM = "checksum"
_HALVES = re.compile(rb"\\u[dD][89a-fA-F]")  # of a letter beyond the first 65,536, which stand in pairs
_SEAL = re.compile(rb'\{"checksum": "([0-9a-f]{64})",')


@contextlib.contextmanager
def opened(path: Path, most: int = LARGEST) -> Iterator[BinaryIO]:
    """Open a file of at most `most` bytes to be read.

    Raises OSError where it cannot be read, and ValueError where it is larger or no ordinary file: a folder, a pipe or a
    socket in its place is never waited for.
    """
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    facts = os.fstat(handle)
    if not stat.S_ISREG(facts.st_mode) or facts.st_size > most:
        os.close(handle)
        larger = f"it has {facts.st_size:,} bytes, more than {most:,}"
        raise ValueError(larger if stat.S_ISREG(facts.st_mode) else "it is no ordinary file")
    with os.fdopen(handle, "rb") as file:
        yield file


def content(path: Path) -> bytes:
    """Return the bytes of a file. Raises OSError or ValueError as `opened` does."""
    with opened(path) as file:
        return file.read()


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Make an object of its members. Raises ValueError where two have one name."""
    made = dict(pairs)
    if len(made) != len(pairs):
        names = [name for name, _ in pairs]
        raise ValueError(f"it says {next(name for name in names if names.count(name) > 1)!r:.40} twice")
    return made


def _no_number(name: str) -> None:
    raise ValueError(f"it holds {name}, which is no number")


def _depth(document: Any) -> int:
    """Return how many objects and lists of a JSON document lie within each other."""
    depth, layer = 0, [document]
    while layer := [one for one in layer if isinstance(one, (dict, list))]:
        depth += 1
        layer = [item for one in layer for item in (one.values() if isinstance(one, dict) else one)]
    return depth


def json_object(text: bytes, trusted: bool = False) -> dict[str, Any]:
    """Read one JSON object of UTF-8, as RFC 8259 has it: without NaN, halves of letters, or names that stand twice.

    The latter takes a third of the time, and is not looked for in a text that is `trusted` to be ours. Raises
    ValueError for anything else, and for objects and lists more than DEEPEST within each other.
    """
    try:
        document = json.loads(text.decode(), object_pairs_hook=None if trusted else _once, parse_constant=_no_number)
        if text.count(b"{") + text.count(b"[") > DEEPEST and _depth(document) > DEEPEST:
            raise RecursionError
        if _HALVES.search(text):
            json.dumps(document, ensure_ascii=False).encode()
    except UnicodeError as error:
        raise ValueError(f"it is no UTF-8: {error}") from None
    except RecursionError:
        raise ValueError(f"its objects are more than {DEEPEST} deep") from None
    except ValueError as error:
        raise ValueError(f"truncated or no JSON: {error}") from None
    if not isinstance(document, dict):
        raise ValueError("it holds no JSON object")
    return document


def read(path: Path) -> dict[str, Any]:
    """Read the JSON object of a file, whose bytes its checksum must hold for where it has one.

    The object is returned without the checksum. Raises OSError or ValueError where the file is damaged.
    """
    return unsealed(content(path))


def has_seal(text: bytes) -> bool:
    """Tell whether the bytes of a file begin with a checksum, whether that holds or not."""
    return bool(_SEAL.fullmatch(text[:200].partition(b"\n")[0].rstrip(b"\r")))


def unsealed(text: bytes) -> dict[str, Any]:
    """Read a sealed object, or one of an older version, which has no checksum. Raises ValueError for a damaged one."""
    first, _, rest = text.partition(b"\n")
    if first.endswith(b"\r"):  # git may write lines as Windows does; JSON's texts hold no line's end as such
        first, _, rest = text.replace(b"\r\n", b"\n").partition(b"\n")
    seal = _SEAL.fullmatch(first)
    if seal and seal[1].decode() != hashlib.sha256(rest).hexdigest():
        raise ValueError("its checksum does not hold: the file was changed after it was written")
    document = json_object(text, trusted=bool(seal))
    if document.pop(CHECKSUM, None) is not None and not seal:
        raise ValueError("its checksum is not the first line: the file was changed after it was written")
    if not seal and rest and first.rstrip() != b"{":
        raise ValueError("its first line is no checksum: the file was changed after it was written")
    return document


def sealed(document: dict[str, Any]) -> bytes:
    """Write a JSON object, and seal it. Raises ValueError where it holds NaN or infinity."""
    return with_seal(json.dumps(document, indent=1, allow_nan=False))


def with_seal(text: str) -> bytes:
    """Seal the text of a JSON object whose first line is `{`."""
    first, _, rest = text.partition("\n")
    if first != "{":
        raise ValueError("the text to seal begins with a line that is no bracket")
    return f'{{"{CHECKSUM}": "{hashlib.sha256(rest.encode()).hexdigest()}",\n{rest}'.encode()


def problem(error: Exception) -> str:
    """Say in one line what is wrong with a file, without the path that an OSError adds."""
    return " ".join(((isinstance(error, OSError) and error.strerror) or str(error)).split())
