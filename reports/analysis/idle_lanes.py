"""Compute how many lanes wait when the work items of a frame of beams run in step, from what rows store of them."""

from __future__ import annotations

import json
from typing import Any

from reports import wording

WIDTHS = (8, 16, 32)  # lanes of a group, as rows store them
WARP = 32  # lanes


def levels_of(row: Any) -> list[dict[str, Any]]:
    """Return what the row stores of each level of the search; [] where it stores nothing.

    A level has its number (`level`), its work items (`items`), the evaluations of them all (`evaluations`), and for
    each of WIDTHS, as text, the idle share of groups so wide (`idle`).
    """
    return [] if wording.absent(row.lanes) else list(json.loads(row.lanes) or [])


def idle_share(row: Any, width: int) -> float | None:
    """Return the idle share of all levels together in groups of `width` lanes; None where the row stores none."""
    levels = levels_of(row)
    spent = sum(level["evaluations"] for level in levels)
    taken = sum(level["evaluations"] / (1.0 - level["idle"][str(width)]) for level in levels)
    return 1.0 - spent / taken if taken else None
