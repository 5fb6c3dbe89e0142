"""Compute how many lanes of beams are idle.

Work items that run in step wait for the one of their group that evaluates f most often. A group is the lanes of a
processor's vector, or a GPU's warp: work items with neighbouring numbers. Each lane of a group takes the time of the
group's largest number of evaluations, and is idle for the difference to its own number. The result is a lower bound. It
does not see turns of the search that only test the domain, nor evaluations that lanes make at different turns.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, RayStatus
from harness.devices.interface import Array
from harness.devices.quadtree import LEVELS, PARENT, most_queued
from harness.results.row import Lane

WIDTHS = (8, 16, 32)  # lanes of float32 in AVX2 and in AVX-512, and of a GPU's warp

Whole = NDArray[np.int64]


@dataclass(frozen=True)
class Tree:
    """State the levels `first` to `last` of a quadtree over size × size pixels; the cells of level `last` are pixels.

    grouped: as in quadtree.Layout
    """

    size: int
    first: int
    last: int
    grouped: bool = True


def of_frame(tree: Tree, hits: Hits, levels: NDArray[np.uint8], outputs: Sequence[Array]) -> list[Lane] | None:
    """Sum up what a frame's work items spend, level by level, from all outputs of its launch.

    `hits` and `levels` are of all pixels. Returns what `summary` does; None if an answer is INVALID.
    """
    if np.any(hits.status == RayStatus.INVALID):
        return None
    shape = (tree.size, tree.size)
    spent = spent_by_items(tree, hits.evaluations.reshape(shape), levels.reshape(shape), outputs[2], outputs[3])
    return summary(spent)


def idle_share(spent: Whole, width: int) -> float:
    """Compute the idle share of work items, int[n] evaluations each, in groups of `width`; 0 where nothing is spent."""
    groups = np.pad(spent, (0, -len(spent) % width)).reshape(-1, width)
    taken = width * int(groups.max(axis=1, initial=0).sum())
    return 1.0 - int(spent.sum()) / taken if taken else 0.0


def summary(spent: Mapping[int, Whole]) -> list[Lane]:
    """Return a dict for each level, from its items' evaluations in the items' order.

    Its keys are level, items, evaluations, and idle: the idle share by group width.
    """
    return [
        {
            "level": level,
            "items": len(own),
            "evaluations": int(own.sum()),
            "idle": {str(width): idle_share(own, width) for width in WIDTHS},
        }
        for level, own in spent.items()
    ]


def spent_by_items(
    tree: Tree, evaluations: NDArray[np.int32], levels: NDArray[np.uint8], queue: Array, counts: Array
) -> dict[int, Whole]:
    """Return the evaluations int[n] of each level's work items, in the items' order, by level.

    evaluations, levels: [size, size], what each pixel was told. A pixel is told its cell's evaluations and its share of
    those of the cells above. What was handed down is subtracted here. A cell outside the image spends none.
    """
    across = 1 << tree.last
    edge = ((0, across - tree.size), (0, across - tree.size))
    spent: dict[int, Whole] = {}
    x, y, handed, source = *_all_cells(tree), np.zeros(4**tree.first, np.int64), 0
    for level in range(tree.first, tree.last + 1):
        side = across >> level
        painted = np.pad(np.where(levels == level, evaluations, 0), edge).astype(np.int64)
        total = painted.reshape(1 << level, side, 1 << level, side).sum(axis=(1, 3))
        if level < tree.last:
            room = most_queued(tree.size, level, tree.last)
            cells = queue[source : source + PARENT * room].reshape(room, PARENT).astype(np.int64)
            later = counts[level + LEVELS // 2]
            parents = np.concatenate([cells[: counts[level]], cells[room - later :][::-1]])
            total[parents[:, 0] >> 16, parents[:, 0] & 0xFFFF] = parents[:, 2]
            source += PARENT * room
        spent[level] = total[y, x] - handed
        if level < tree.last:
            quarter = np.arange(4)
            x = (2 * (parents[:, :1] & 0xFFFF) + (quarter & 1)).ravel()
            y = (2 * (parents[:, :1] >> 16) + (quarter >> 1)).ravel()
            inside = np.maximum(x, y) * (side // 2) < tree.size
            handed = np.where(inside, (parents[:, 2:] + quarter >> 2).ravel(), 0)
    return spent


def _all_cells(tree: Tree) -> tuple[Whole, Whole]:
    """Return column and row, int[items] each, of each work item's cell at the first level."""
    items = np.arange(4**tree.first)
    if not tree.grouped:
        return items & ((1 << tree.first) - 1), items >> tree.first
    return _even_bits(items), _even_bits(items >> 1)


def _even_bits(values: Whole) -> Whole:
    return sum((((values >> (2 * bit)) & 1) << bit for bit in range(LEVELS // 2)), np.zeros_like(values))
