"""Work that tests hand to processes, which import it by its name."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path

import numpy as np

from harness.contract import FirsthitError


def doubled(number: int) -> tuple[int, int]:
    """Return twice a number, and the process that doubled it; small numbers take longer than large ones."""
    time.sleep(0.02 if number < 3 else 0.0)
    return 2 * number, os.getpid()


def dies(marker: Path | None) -> str:
    """Kill this process; with a file, only if that is not there, which is then made."""
    if marker is None or not marker.exists():
        if marker is not None:
            marker.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return "answered"


def fails_or_sleeps(seconds: float) -> None:
    """Sleep; without seconds, raise what a user can put right."""
    if not seconds:
        raise FirsthitError("no chunk of work", exit_code=3)
    time.sleep(seconds)


def breaks(_: int) -> None:
    raise ZeroDivisionError("a mistake of ours")


def holds(size: int) -> int:
    """Hold so many bytes for a while."""
    kept = np.ones(size, np.uint8)
    time.sleep(1.0)
    return int(kept[0])
