"""Say where a report goes: beside the run if the user names no folder, and never into a run."""

from __future__ import annotations

import os
from pathlib import Path

from harness.contract import FirsthitError


def place(*runs: Path) -> Path:
    """Return the folder for a report on these runs: runs/quick.report, or runs/before-to-after.report of two.

    It is in the first run's folder. Runs of different folders have in it what sets their paths apart, as in
    a/a-quick-to-b-quick.report, so that two comparisons do not take each other's place.
    """
    whole = [Path(os.path.abspath(run)) for run in runs]  # noqa: PTH100 - a link stays what the user calls the run
    whole = [run.with_suffix("") if run.is_file() else run for run in whole]  # an archive
    together = len({run.parent for run in whole}) == 1
    above = Path(os.path.commonpath([run.parent for run in whole]))
    names = [run.name if together else "-".join(run.relative_to(above).parts) for run in whole]
    return whole[0].with_name("-to-".join(names) + ".report")


def checked(output: Path) -> Path:
    """Return `output`. Raises FirsthitError where it is a file or lies in a run's folder, which is only read."""
    whole = Path(os.path.abspath(output))  # noqa: PTH100 - nor is a link followed here
    if whole.exists() and not whole.is_dir():
        raise FirsthitError(f"{output} is a file; a report is several files, so name a folder for them")
    for folder in (whole, *whole.parents):
        if (folder / "plan.json").is_file():
            where = "is" if folder == whole else f"lies in {folder}, which is"
            raise FirsthitError(f"{output} {where} a run's folder; a report is never written into a run: name another")
    return output
