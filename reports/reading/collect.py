"""Join several runs to one, which the report of a config that includes others is about.

Each run keeps its rows apart: rows are compared only with rows of the same run, since only those were timed in turns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pandas as pd

from harness.contract import FirsthitError
from reports.reading.columns import Columns
from reports.reading.run import Plan, Run, Unreadable


def together(folder: Path, plan: Plan, runs: Sequence[Run], missing: Sequence[Unreadable]) -> Run:
    """Join the runs that `plan` includes; `missing` are those that could not be read.

    Raises FirsthitError where there is no run.
    """
    if not runs:
        raise FirsthitError(
            f"none of the runs that {folder} collects has anything finished; run `{plan.command}` first"
        )
    families = pd.concat([run.families for run in runs], ignore_index=True).drop_duplicates("key", ignore_index=True)
    rungs = pd.concat([run.rungs for run in runs], ignore_index=True).drop_duplicates(["key", "level"])
    frames = [run.frame.assign(comparison=f"{run.plan.name}: " + run.frame["comparison"]) for run in runs]
    return Run(
        folder,
        _whole(plan, [run.plan for run in runs]),
        pd.concat(frames, ignore_index=True),
        families,
        rungs.reset_index(drop=True),
        (*missing, *(replace(f, file=f"{run.plan.name}/{f.file}") for run in runs for f in run.unreadable)),
        tuple(slot for run in runs for slot in run.not_run),
        {name: rows for run in runs for name, rows in run.studies.items()},
        {run.plan.name: run.folder for run in runs},
        Columns.together([run.columns for run in runs]),
    )


def _whole(plan: Plan, parts: list[Plan]) -> Plan:
    """Return `plan` with what its parts say of configs, devices, methods and families."""
    devices = {str(device.get("name")): device for part in parts for device in part.devices}
    return replace(
        plan,
        config_text="\n".join([plan.config_text, *(f"# ---- {part.config}\n{part.config_text}" for part in parts)]),
        devices=tuple(devices.values()),
        methods={name: told for part in parts for name, told in part.methods.items()},
        facts={family: facts for part in parts for family, facts in part.facts.items()},
    )
