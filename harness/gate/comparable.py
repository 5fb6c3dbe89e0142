"""Choose the blessed row that a row is held against, and say by which rule, or why nothing can be compared."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from harness.contract import PRECISIONS, CellStatus, Precision
from harness.devices.fingerprint import unlike
from harness.gate.baseline import ARITHMETIC, Baseline, Entry
from harness.results.commits import SIZED

OTHER_SCENE = "surface, view, rays or family are others than those blessed under this name"
NAMED_PARTS = 6  # of arithmetic that a reason names


class Rule(StrEnum):
    """Name a rule by which a row is held against a blessed one.

    EXACT: both devices compute the same bit for bit, so that a figure may change only as its tolerance says
    LAST_BITS: they do not, so that its slack for last bits is added to the tolerance
    """

    EXACT = "exact"
    LAST_BITS = "last bits"


@dataclass(frozen=True)
class Held:
    """State what a row is held against: an entry of the baseline, and the key of the device that it is of.

    reason: why the rule is not EXACT, and why figures are left out; empty where neither is so
    left_out: figures that are not held, since the size of the device decides them
    """

    key: str
    entry: Entry
    rule: Rule
    reason: str
    left_out: tuple[str, ...] = ()


def held_against(slot: str, row: Entry, facts: Mapping[str, Any], before: Baseline) -> Held | str | None:
    """Choose what a row is held against, of all devices of a baseline.

    `row` needs no more than `entries.asked_of` gives, and `facts` are those of its device. Returns a text where the
    row cannot be compared, which says why, and None where the baseline has no such row.

    A row whose device computes the same is taken first, whatever the device is called; then one of a device of the
    same name, then any other.
    """
    blessed = {key: rows[slot] for key, rows in before.rows.items() if slot in rows}
    if not blessed:
        return None
    same_scene = {key: entry for key, entry in blessed.items() if entry["scene"] == row["scene"]}
    if not same_scene:
        return OTHER_SCENE
    able = {key: entry for key, entry in same_scene.items() if _lacks(entry, row) == bool(row.get("lacks"))}
    if not able:
        return f"the device cannot run this cell: {row['reason']}" if row.get("lacks") else None
    key = min(able, key=lambda one: distance(slot, facts, before.devices[one], one))
    entry = able[key]
    # a cell that cannot run computes nothing
    differs = "" if row.get("lacks") else _differs(slot, row, entry, facts, before.devices[key])
    rule = Rule.LAST_BITS if differs else Rule.EXACT
    levels = row.get("device_level"), entry.get("device_level")
    if levels[0] == levels[1]:
        return Held(key, entry, rule, differs)
    sized = f"its quadtree begins at level {levels[0]}, and began at {levels[1]}: {', '.join(SIZED)} is not held"
    return Held(key, entry, rule, "; ".join(filter(None, (differs, sized))), SIZED)


def distance(slot: str, facts: Mapping[str, Any], blessed: Mapping[str, Any], key: str) -> tuple[Any, ...]:
    """Return a key to sort the devices of a baseline by: the one to hold a row against comes first."""
    parts = _parts(slot, facts, blessed)
    renamed, moved = (blessed.get(fact) != facts.get(fact) for fact in ("name", "processor"))
    return bool(parts), renamed, len(parts), moved, key


def _lacks(entry: Entry, row: Entry) -> bool:
    """Tell whether a blessed row was skipped for what its device lacked; older files say only why it was skipped."""
    skipped = entry["status"] == row.get("status") == CellStatus.SKIPPED
    return bool(entry.get("lacks")) or (skipped and bool(row.get("lacks")) and entry.get("reason") == row["reason"])


def _parts(slot: str, facts: Mapping[str, Any], blessed: Mapping[str, Any]) -> list[str]:
    """List the parts of arithmetic in which two devices differ for the row of a slot."""
    here, there = facts.get(ARITHMETIC, {}), blessed.get(ARITHMETIC, {})
    return unlike(here, there, _precision(slot), raster=slot.endswith(" raster"))


def _precision(slot: str) -> Precision:
    """Return the precision that a slot names."""
    words = slot.split()
    return next((precision for precision in PRECISIONS if precision in words), "float32")


def _differs(slot: str, row: Entry, entry: Entry, facts: Mapping[str, Any], blessed: Mapping[str, Any]) -> str:
    """Say in what a device differs from the blessed one, so that a row is not held exactly; "" if in nothing."""
    place = f"{blessed.get('name')} on {blessed.get('processor')}"
    if not blessed.get(ARITHMETIC):
        return f"held by {Rule.LAST_BITS}: the baseline does not say how {place} computes; bless anew"
    if parts := [part.removeprefix(f"{_precision(slot)} ") for part in _parts(slot, facts, blessed)]:
        more = f" and {len(parts) - NAMED_PARTS} more" if len(parts) > NAMED_PARTS else ""
        named, verb = ", ".join(parts[:NAMED_PARTS]), "differ" if len(parts) > 1 else "differs"
        return f"held by {Rule.LAST_BITS}: {named}{more} {verb} from {place}"
    now, then = row.get("mesher"), entry.get("mesher")
    return f"held by {Rule.LAST_BITS}: meshes are by {now}, and were by {then}" if now != then else ""
