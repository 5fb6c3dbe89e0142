"""Say where a report goes if the user names no folder: beside the run, never into it."""

from __future__ import annotations

from pathlib import Path


def place(*runs: Path) -> Path:
    """Return the folder for a report on these runs: runs/quick.report, or runs/before-to-after.report of two."""
    first, *others = (run.resolve() for run in runs)
    return first.with_name("-to-".join([first.name, *(run.name for run in others)]) + ".report")
