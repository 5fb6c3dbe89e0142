"""Turn a config's rows into the entries of a baseline, and say by which slot a row is found there."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from harness.contract import DeviceInfo, digest
from harness.devices.fingerprint import Fingerprint
from harness.devices.host import processor
from harness.experiment.kinds.comparing import device_level, last_bit
from harness.experiment.plan import Planned
from harness.gate.baseline import LAST_BIT, Baseline, Entry, device_key
from harness.plugins import Catalog
from harness.results.figures import figures
from harness.results.store import Row
from harness.scenes.model import Group, Scene
from surfaces.formula import number

# These parts of a cell's identity are the method's, the machine's or the harness's. All others say what was asked of
# the method: its hash, an entry's `scene`, must be the same for two rows to be compared. "raster" names a scene's
# numbers to the last bit, and the mesher's version; `_placed` says the same without them.
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
    "raster",
}
STEP = math.e * 1e-7  # scene units; numbers that people write lie on no edge between two steps


def slot_of(planned: Planned) -> str:
    """Return the cell's place in the grid without its device, by which a row is found again in a baseline.

    It does not depend on the cell's program, so that a row stays gated when its program changes.
    """
    return planned.cell.slot.removesuffix(f" {planned.cell.device}")


def facts_of(info: DeviceInfo, arithmetic: Fingerprint) -> dict[str, Any]:
    """Return what a baseline says of a device: names and versions for people, and how it computes."""
    facts = dataclasses.asdict(info)
    told = {name: facts[name] for name in ("name", "title", "driver", "compiler")}
    return told | {"versions": dict(info.versions), "processor": processor(), "arithmetic": arithmetic}


def asked_of(planned: Planned) -> Entry:
    """Return what an entry holds of a cell before it has run.

    scene: a hash of what is asked of the method, which does not depend on the machine
    status, reason: of a cell that cannot run
    lacks: True of a cell that cannot run for something that its device lacks
    last_bit: how finely its answers can be told, see kinds.comparing
    device_level: of a quadtree, where the device's size decides at which level it begins
    mesher: the packages that make its triangles, and their versions
    """
    scene = {name: value for name, value in planned.identity.items() if name not in _NOT_SCENE}
    if "accuracy" in scene:  # the share that may be undecided decides whether there are figures, but changes none
        scene["accuracy"] = {name: value for name, value in scene["accuracy"].items() if name != "undecided"}
    if planned.cell.scene:  # its stand-in is as large as its instances, whose places are computed
        scene["surface"] = _placed(planned.cell.scene)
    entry: Entry = {"scene": digest(scene), LAST_BIT: last_bit(planned.cell)}
    if planned.skip is not None:
        entry |= {"status": "skipped", "reason": planned.skip}
    if planned.lacks:
        entry["lacks"] = True
    if planned.device and (level := device_level(planned.casting, planned.device)) is not None:
        entry["device_level"] = level
    if mesher := planned.identity.get("raster", {}).get("mesher"):
        entry["mesher"] = mesher
    return entry


def baseline_of(
    planned: Iterable[Planned],
    rows: dict[str, Row],
    catalog: Catalog,
    config: str,
    arithmetic: Mapping[str, Fingerprint],
) -> Baseline:
    """Make a baseline of the rows of all cells whose device is here.

    `rows` holds each cell's row by its key; of a cell without one only the device is taken. `config` is the config's
    name, and `arithmetic` holds the fingerprints of the devices by their names. Raises FirsthitError where a row's
    figure is no finite number.
    """
    made = Baseline(config)
    for p in planned:
        if p.device is None:
            continue
        facts = facts_of(p.device, arithmetic.get(p.device.name, {}))
        key = device_key(facts)
        made.devices[key] = facts
        entries = made.rows.setdefault(key, {})
        if p.key in rows:
            entries[slot_of(p)] = _entry(p, rows[p.key], catalog)
    return made


def _entry(planned: Planned, row: Row, catalog: Catalog) -> Entry:
    """Return status, hashes and gated figures of a row."""
    entry = asked_of(planned) | {"status": row["status"]}
    if row["program"]:
        entry["program"] = row["program"]["hash"]
    if row["reason"]:
        entry["reason"] = row["reason"]
    method = catalog.get(planned.cell.variant.method).method
    return entry | (figures(row, method.claims) if method.answers else {})


def _placed(scene: Scene) -> list[Any]:
    """Say which instances a scene shows, JSON-able, and the same on every machine.

    Places and sizes are computed with functions whose last bits are the host's. So they are told in whole steps.
    """
    return [_instances(group) for group in scene.groups]


def _instances(group: Group) -> dict[str, Any]:
    own = [
        {
            "formula": surface.formula,
            "parameters": {name: _steps(number(value)) for name, value in surface.parameters},
            "domain": {name: _steps(value) for name, value in dataclasses.asdict(surface.domain).items()},
        }
        for surface in group.surfaces
    ]
    variant = None if group.variant is None else [group.variant.method, dict(group.variant.parameters)]
    arrays = (group.place, group.turn, group.scale, group.colours)
    return {"surfaces": own, "places": [_steps(array) for array in arrays], "variant": variant}


def _steps(numbers: Any) -> Any:
    """Return numbers of any shape in whole steps of STEP, as lists of the same shape."""
    return np.rint(np.asarray(numbers, np.float64) / STEP).astype(np.int64).tolist()
