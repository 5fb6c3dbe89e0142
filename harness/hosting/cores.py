"""Tell how many cores there are for a process."""

from __future__ import annotations

import os


def cores() -> int | None:
    """Count the processor's cores that this process may use; None where the system does not tell."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
