"""Make up the runs of several machines, whose rows say which device, processor and files made them."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from harness.contract import digest
from harness.results.store import Store
from tests import synthetic_run
from tests.agreeing_rows import whole

VARIANTS = ("ray_march", "newton[EPSILON=0.001]", "null")
SURFACES = ("sphere", "torus")
FILES = {"harness/a.py": "0123456789abcdef"}
TEXT = 'title = "quick"\n'


def row_of(
    variant: str,
    surface: str,
    *,
    device: str = "opencl:intel",
    machine: str | None = "lab1",
    processor: str = "Xeon",
    driver: str = "1",
    cores: int | None = 2,
    files: Mapping[str, str] = FILES,
    packages: Mapping[str, str] | None = None,
    started: str = "2026-11-22T03:00:10+00:00",
    factor: float = 1.0,
) -> dict[str, Any]:
    """Make up a finished row of a machine; its times are `factor` times the usual ones."""
    row = whole(synthetic_run.cell(variant, surface, device, "float32"))
    synthetic_run.retime(row, factor * row["time"]["median_ms"])
    row["time"]["wall_samples_ms"] = row["time"]["samples_ms"]
    for name, of in (("bootstrap_lower_ms", "lower_ms"), ("bootstrap_upper_ms", "upper_ms")):
        row["time"][name] = row["time"][of]
    row["time"]["session"] = f"{machine} {surface}"
    row["identity"] = {
        "formula": row["formula"],
        "device": {"name": device, "title": "One", "driver": driver, "clock": "wall"},
        "processor": processor,
        "cores": cores,
        "settings": {},
        "packages": dict(packages or {"numpy": "2.4.6"}),
        "methodology": dict(files),
        "method": {f"{row['method']}/method.py": "1"},
    }
    row["environment"] = {"started": started, "commit": "abc1234", "dirty": False, "machine": machine}
    key = digest(row["slot"], row["identity"])
    return row | {"key": key, "arrays": row["arrays"] and f"arrays/{key}.npz"}


def write(
    folder: Path,
    rows: Sequence[dict[str, Any]],
    *,
    machine: str | None = "lab1",
    text: str = TEXT,
    name: str = "quick",
    shard: tuple[int, int] | None = None,
    more: Sequence[dict[str, Any]] = (),
) -> Path:
    """Write a run of these rows; its plan also names the cells `more`, which have no row. Returns the folder."""
    plan = synthetic_run.plan([*rows, *more]) | {"name": name, "config_text": text, "config": f"{name}.toml"}
    plan["environment"] |= {"machine": machine}
    plan["devices"] = [one for one in plan["devices"] if one["name"] in {row["device"] for row in rows}]
    if shard:
        plan["shard"] = {"number": shard[0], "of": shard[1]}
        plan["cells"] = [one | {"at": at} for at, one in enumerate(plan["cells"])]
    plan.pop("format")
    folder.mkdir(parents=True)
    store = Store(folder)
    store.write_plan(plan)
    for row in rows:
        store.write(row, synthetic_run.arrays(row) if row["arrays"] else None)
    return folder


def usual(**told: Any) -> list[dict[str, Any]]:
    """Make up a row of each of VARIANTS and SURFACES; the first two have answers ray by ray."""
    rows = [row_of(variant, surface, **told) for surface in SURFACES for variant in VARIANTS]
    return [*rows[:2], *(row | {"arrays": None} for row in rows[2:])]


def contents(folder: Path) -> dict[str, bytes]:
    """Return the files of a folder by their paths in it, without the lock."""
    files = (path for path in folder.rglob("*") if path.is_file() and path.name != ".lock")
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(files)}


def plan_of(folder: Path) -> dict[str, Any]:
    """Return a run's plan."""
    return json.loads((folder / "plan.json").read_text())


def pictured(folder: Path, row: Mapping[str, Any]) -> bool:
    """Tell whether a run's folder has the answers of a row ray by ray."""
    with np.load(folder / row["arrays"]) as arrays:
        return "truth" in arrays
