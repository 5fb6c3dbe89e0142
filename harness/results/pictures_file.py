"""Declare arrays/<key>.npz: a row's answers ray by ray, as pictures (harness/accuracy/pictures.py makes them)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness import memory
from harness.contract import TruthStatus, plural
from harness.results import npz
from harness.results.row import KINDS

TYPES: dict[str, Any] = {
    "truth": np.uint8,
    "error": np.float32,
    "wrong": np.uint8,
    "grazing": np.bool_,
    "shade": np.float32,
    "condition": np.float32,
    "evaluations": np.int32,
    "status": np.uint8,
    "level": np.uint8,
    "stage": np.uint8,
    "drowned": np.bool_,
    "samples": np.float32,
}
OPTIONAL = frozenset(  # not in every older run
    ("condition", "evaluations", "status", "level", "stage", "drowned", "samples")
)
BYTES_PER_RAY = 26  # of one row's arrays, as they are read
BYTES_DRAWN = 150  # of a ray while one row's maps are drawn
MOST_SIDE = 2**13
MOST_SAMPLES = 64  # on each side of a pixel
MOST_LEVEL = 30  # of a quadtree
MOST_STAGE = 31  # of a frame of tiles


def refusal(rays: Sequence[int]) -> str | None:
    """Say why the arrays of rows with so many rays each should not be read and drawn together; None where they may.

    Samples of a pixel are not counted.
    """
    wanted = BYTES_PER_RAY * sum(rays) + BYTES_DRAWN * max(rays, default=0)
    what = f"drawing the maps of {plural(len(rays), 'cell')}, {plural(max(rays, default=0), 'ray')} at most,"
    return memory.refusal(wanted, what, "run with a smaller [accuracy] size, or report on a machine with more memory")


def read(path: Path) -> dict[str, NDArray[Any]]:
    """Read the arrays of one row by their names: [h, w] each, `samples` [s h, s w].

    Raises OSError where the file cannot be read, and ValueError where it is damaged.
    """
    first: list[npz.Shape] = []

    def fits(name: str, shape: npz.Shape) -> bool:
        """Tell whether a shape is two-dimensional and that of the array before, or whole pixels of it."""
        first[:] = first or [shape]
        if name == "samples":
            return any(shape == tuple(s * side for side in first[0]) for s in range(1, MOST_SAMPLES + 1))
        return shape == first[0] and len(shape) == 2 and all(1 <= side <= MOST_SIDE for side in shape)

    arrays = npz.read(path, TYPES, fits, OPTIONAL)
    for name, array in arrays.items():
        if not _possible(name, array):
            raise ValueError(f"damaged: {name} holds what it cannot hold")
    return arrays


def _possible(name: str, array: NDArray[Any]) -> bool:
    """Tell whether an array holds only values that its name can have."""
    most = {"truth": max(TruthStatus), "wrong": len(KINDS), "level": MOST_LEVEL, "stage": MOST_STAGE}.get(name)
    if most is not None:
        return bool(array.max() <= most)
    if name in ("error", "evaluations"):
        return not bool((array < 0).any() or np.isinf(array).any())
    return name not in ("shade", "samples") or not bool(np.isinf(array).any())
