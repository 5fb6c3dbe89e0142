"""Turn a config's rows into the entries of a baseline, and say by which slot a row is found there."""

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

# These parts of a cell's identity are the method's, the machine's or the harness's. All others say what was asked of
# the method: its hash, an entry's `scene`, must be the same for two rows to be compared.
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
    """Return the cell's place in the grid without its device, by which a row is found again in a baseline.

    It does not depend on the cell's program, so that a row stays gated when its program changes.
    """
    return planned.cell.slot.removesuffix(f" {planned.cell.device}")


def facts_of(info: DeviceInfo) -> dict[str, Any]:
    """Return what a baseline says of a device: its name, title, driver, compiler, packages and processor."""
    facts = dataclasses.asdict(info)
    told = {name: facts[name] for name in ("name", "title", "driver", "compiler")}
    return told | {"versions": dict(info.versions), "processor": processor()}


def baseline_of(
    planned: Iterable[Planned], rows: dict[str, Row], catalog: Catalog, config: str, same: list[str]
) -> Baseline:
    """Make a baseline of the rows of all cells whose device is here.

    `rows` holds each cell's row by its key; of a cell without one only the device is taken. `config` is the config's
    name, and `same` names the facts that tell one device from another. Raises FirsthitError where a row's figure is no
    finite number.
    """
    made = Baseline(config)
    for p in planned:
        if p.device is None:
            continue
        facts = facts_of(p.device)
        key = device_key(facts, same)
        made.devices[key] = facts
        entries = made.rows.setdefault(key, {})
        if p.key in rows:
            entries[slot_of(p)] = _entry(p, rows[p.key], catalog)
    return made


def _entry(planned: Planned, row: Row, catalog: Catalog) -> Entry:
    """Return status, hashes and gated figures of a row."""
    scene = {name: value for name, value in planned.identity.items() if name not in _NOT_SCENE}
    if "accuracy" in scene:  # the share that may be undecided decides whether there are figures, but changes none
        scene["accuracy"] = {name: value for name, value in scene["accuracy"].items() if name != "undecided"}
    entry: Entry = {"status": row["status"], "scene": digest(scene)}
    if row["program"]:
        entry["program"] = row["program"]["hash"]
    if row["reason"]:
        entry["reason"] = row["reason"]
    method = catalog.get(planned.cell.variant.method).method
    return entry | (figures(row, method.claims) if method.answers else {})
