"""Compare devices by the same variant: how much faster each device is, and what the harness adds to its time."""

from __future__ import annotations

import itertools
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, rounds
from reports.analysis.scene_names import scene_names
from reports.content import Column, Section, Table
from reports.drawing import tables
from reports.material import Material

ORDER = 30

_KERNEL = ["comparison", "variant", "precision"]


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless two devices or more timed the same variant on the same scene."""
    timed = material.listed[material.listed["status"] == CellStatus.OK].dropna(subset=["median_ms"])
    table = _table(timed) if timed["device"].nunique() > 1 else None
    return [Section("The same kernel on every device", (table,))] if table else []


def _table(timed: pd.DataFrame) -> Table | None:
    """Make a line for each scene, precision and variant that several devices timed; None where there is none."""
    devices = list(dict.fromkeys(timed["device"]))
    named = scene_names(timed)
    body: list[tuple[Any, ...]] = []
    timed = timed.assign(comparable=derive.all_right(timed) | ~timed["answers"].astype(bool))
    kept = [*_KERNEL, "device", "median_ms", *rounds.COLUMNS, "overhead_share", "comparable"]
    timed = timed[kept].drop_duplicates([*_KERNEL, "device"])
    shared = timed[timed.groupby(_KERNEL)["device"].transform("size") > 1]
    groups = shared.groupby(_KERNEL, sort=False)
    for (scene, variant, precision), rows in itertools.islice(groups, tables.ROW_LIMIT):
        by_device = rows.set_index("device")
        slowest = rows[rows["comparable"]].nlargest(1, "median_ms")
        cells: list[float | None] = []
        for device in devices:
            here = by_device.loc[device] if device in by_device.index else None
            if here is None:
                cells += [None] * 3
            else:
                faster = rounds.times_over(slowest.iloc[0], here) if here.comparable else None
                cells += [here.median_ms, faster, here.overhead_share]
        body.append((named[str(scene)], precision, variant, *cells))
    if not body:
        return None
    columns = [Column("surface"), Column("precision"), Column("variant", stretch=1)]
    for device in devices:
        columns += [
            Column("ms", wording.number, numeric=True, over=device),
            Column("faster", wording.factor, numeric=True, over=device),
            Column("overhead", wording.share, numeric=True, over=device),
        ]
    return Table(
        tuple(columns),
        body,
        "The same kernel on every device.",
        "Faster is the time of the row's slowest device over this device's, in the rounds that timed both. Only those "
        "devices count on which the variant answers every ray away from silhouettes rightly; null answers nothing and "
        "always counts. Each device is timed by the clock that is believed there. Overhead is what the harness's "
        "submitting and waiting adds to the kernel's own time, as a share of that time; – where the device has no "
        "clock of its own that is believed. Look for a device whose lead changes from variant to variant: its compiler "
        f"makes more, or less, of one of them.{wording.first_of(len(body), groups.ngroups)}",
        group=2,
    )
