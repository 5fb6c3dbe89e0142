"""Say where a report goes: beside the run if the user names no folder, and never into a run."""

from __future__ import annotations

import os
from pathlib import Path

from harness.contract import FirsthitError

LONGEST = 100  # letters of the name of a folder that is made of several runs' names


def place(*runs: Path, joined: bool = False) -> Path:
    """Return the folder for a report on these runs: runs/quick.report, or runs/before-to-after.report of two.

    Of runs that are `joined` it is runs/lab1-and-lab2.report, or runs/lab1-and-7-more.report where that is too long.

    It is in the first run's folder. Runs of different folders have in it what sets their paths apart, as in
    a/a-quick-to-b-quick.report, so that two comparisons do not take each other's place.
    """
    whole = [Path(os.path.abspath(run)) for run in runs]  # noqa: PTH100 - a link stays what the user calls the run
    whole = [run.with_suffix("") if run.is_file() else run for run in whole]  # an archive
    together = len({run.parent for run in whole}) == 1
    above = Path(os.path.commonpath([run.parent for run in whole]))
    names = [run.name if together else "-".join(run.relative_to(above).parts) for run in whole]
    name = ("-and-" if joined else "-to-").join(names)
    if joined and len(name) > LONGEST:
        name = f"{names[0]}-and-{len(names) - 1}-more"
    return whole[0].with_name(f"{name}.report")


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
