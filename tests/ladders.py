"""Tell from a ladder's verdicts alone where it breaks, which is what reports are held against."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

from harness.accuracy.rungs import share_right


def first_break(
    verdicts: Sequence[Mapping[str, Any]], harder: Literal["smaller", "larger"], share: float = 0.99
) -> float | None:
    """Return the first parameter, going harder, at which less than `share` of the decided rays are right; else None.

    Rungs without decided rays neither break a method nor clear it.
    """
    for verdict in sorted(verdicts, key=lambda v: float(v["parameter"]), reverse=harder == "smaller"):
        right = share_right(verdict)
        if right is not None and right < share:
            return float(verdict["parameter"])
    return None
