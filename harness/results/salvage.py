"""Read the rows of a Parquet part whose hash does not hold, in a process of its own.

What reads Parquet may end the process where a file is damaged (a C++ exception that nothing catches). So a damaged part
is read by a child, which prints each row that it can read. Where the child does not end well, what it had printed by
then counts.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

PATIENCE = 600.0  # seconds for one part
COMMAND = (sys.executable, "-P", "-m", "harness.results.salvage_child")
LENGTH = 8  # bytes in which a number is printed


def rows_of(path: Path) -> tuple[int | None, list[bytes]]:
    """Return how many rows a part has, None where that cannot be told, and the bytes of those that can be read.

    Their own checksums are not looked at. Raises OSError where no process can be started.
    """
    try:
        done = subprocess.run(
            [*COMMAND, str(path)], stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE, check=False
        )
        printed = done.stdout
    except subprocess.TimeoutExpired as late:
        printed = late.stdout or b""
    if len(printed) < LENGTH:
        return None, []
    total, at, rows = int.from_bytes(printed[:LENGTH], "big"), LENGTH, list[bytes]()
    while at + LENGTH <= len(printed):
        end = at + LENGTH + int.from_bytes(printed[at : at + LENGTH], "big")
        if end > len(printed):
            break
        rows.append(printed[at + LENGTH : end])
        at = end
    return total, rows
