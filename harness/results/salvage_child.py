"""Print the rows of a Parquet part, as far as they can be read: the child of harness.results.salvage."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from harness.results.parts import Part
from harness.results.salvage import LENGTH


def _readable(path: Path) -> Iterator[int | bytes]:
    """Yield how many rows a part has, and then the bytes of each that can be read. Raises OSError or ValueError."""
    part = Part(path)
    yield part.ends[-1] if part.ends else 0
    for group in range(len(part.ends)):
        try:
            texts = part.texts(group).to_pylist()
        except (OSError, ValueError):
            continue
        yield from (text for text in texts if text)


def _print(path: Path, out: BinaryIO) -> None:
    for told in _readable(path):
        out.write(told.to_bytes(LENGTH, "big") if isinstance(told, int) else len(told).to_bytes(LENGTH, "big") + told)
        out.flush()


if __name__ == "__main__":
    with contextlib.suppress(OSError, ValueError):  # what was printed is what can be read
        _print(Path(sys.argv[1]), sys.stdout.buffer)
