"""Makes the entries of a baseline from rows that were just run."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from typing import Any

from harness.contract import DeviceInfo, digest
from harness.devices.host import processor
from harness.experiment.plan import Planned
from harness.gate.baseline import Baseline, Entry, device_key
from harness.plugins import Catalog
from harness.results.figures import figures
from harness.results.store import Row

# These parts of a cell's identity belong to the method, the machine or the harness; the rest is the question asked.
_NOT_SCENE = {
    "program",
    "program order",
    "parameters",
    "device",
    "processor",
    "cores",
    "methodology",
    "method",
    "packages",
    "settings",
    "skip",
    "budget",
}


def slot_of(planned: Planned) -> str:
    """Return the cell's place in the grid without its device: what its row is gated by, whatever its program is."""
    return planned.cell.slot.removesuffix(f" {planned.cell.device}")


def facts_of(info: DeviceInfo) -> dict[str, Any]:
    """Return what a baseline keeps of a device: its names, driver, compiler and versions, and the processor's name."""
    facts = dataclasses.asdict(info)
    told = {name: facts[name] for name in ("name", "title", "driver", "compiler")}
    return told | {"versions": dict(info.versions), "processor": processor()}


def baseline_of(
    planned: Iterable[Planned], rows: dict[str, Row], catalog: Catalog, config: str, same: list[str]
) -> Baseline:
    """Make a baseline of the rows of every device that is here.

    `rows` are by key. `same` names the device facts that must be equal for figures to be compared. Raises
    FirsthitError for a figure that is no finite number.
    """
    made = Baseline(config)
    for p in planned:
        if p.device is None:
            continue
        facts = facts_of(p.device)
        key = device_key(facts, same)
        made.devices[key] = facts
        made.rows.setdefault(key, {})[slot_of(p)] = _entry(p, rows[p.key], catalog)
    return made


def _entry(planned: Planned, row: Row, catalog: Catalog) -> Entry:
    """Make one row's entry: how it ended, a hash of what was asked, its program, and its figures."""
    scene = {name: value for name, value in planned.identity.items() if name not in _NOT_SCENE}
    if "accuracy" in scene:  # how much may be undecided decides whether there are figures, and none of them
        scene["accuracy"] = {name: value for name, value in scene["accuracy"].items() if name != "undecided"}
    entry: Entry = {"status": row["status"], "scene": digest(scene)}
    if row["program"]:
        entry["program"] = row["program"]["hash"]
    if row["reason"]:
        entry["reason"] = row["reason"]
    method = catalog.get(planned.cell.variant.method).method
    return entry | (figures(row, method.claims) if method.answers else {})
