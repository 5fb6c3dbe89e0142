"""The share of lanes that the work items of a frame of beams leave idle where they run in step, read from rows."""

from __future__ import annotations

import json
from typing import Any

from reports import wording

WIDTHS = (8, 16, 32)
WARP = 32  # lanes


def levels_of(row: Any) -> list[dict[str, Any]]:
    """Read each level's numbers: level, items, evaluations, idle by width; [] where the row has no lanes."""
    return [] if wording.absent(row.lanes) else list(json.loads(row.lanes) or [])


def idle_share(row: Any, width: int) -> float | None:
    """Compute the idle share of all levels together in groups of `width` lanes; None where the row has no lanes."""
    levels = levels_of(row)
    spent = sum(level["evaluations"] for level in levels)
    taken = sum(level["evaluations"] / (1.0 - level["idle"][str(width)]) for level in levels)
    return 1.0 - spent / taken if taken else None
