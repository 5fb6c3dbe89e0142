"""Write the names of lines at their right ends, in place of a key."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from reports.drawing import placing, style

SIZE = 7.0  # points
STEP = 1.18 * SIZE  # from a label to the next, points
_LEADER = 14.0  # from a line's end to its label, points


def width(labels: Sequence[str]) -> float:
    """Return the width in inches that `labels` and their leaders take beside a plot."""
    return (_LEADER + 2.0 + max((placing.text_size(label, SIZE)[0] for label in labels), default=0.0)) / 72.0


def apart(wanted: ArrayLike, step: float, low: float, high: float) -> NDArray[np.float64]:
    """Return places for labels that want those of `wanted` [n], at least `step` from each other, as float64[n].

    They keep the order of `wanted`, move as little as they can in the sum of squares, and stay between `low` and
    `high` where there is room for all; else their step is smaller.
    """
    places = np.asarray(wanted, np.float64)
    order = np.argsort(places, kind="stable")
    step = min(step, (high - low) / max(len(places) - 1, 1))
    steps = step * np.arange(len(places))
    free = _ascending(places[order] - steps)
    found = np.empty(len(places))
    found[order] = np.clip(free, low, high - step * max(len(places) - 1, 0)) + steps
    return found


def _ascending(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the ascending numbers closest to `values` [n]: neighbours in the wrong order take their mean."""
    pools: list[tuple[float, int]] = []
    for value in values:
        mean, count = float(value), 1
        while pools and pools[-1][0] > mean:
            before, size = pools.pop()
            mean, count = (before * size + mean * count) / (size + count), size + count
        pools.append((mean, count))
    return np.repeat([mean for mean, _ in pools], [count for _, count in pools])


def write(axes: Axes, ends: Sequence[tuple[float, float, str, str]]) -> None:
    """Write the labels of lines to the right of `axes`, whose place, limits and scales are set.

    Each of `ends` has the x and y of a line's last point, its label and its colour.
    """
    if not ends:
        return
    figure = axes.get_figure(root=True)
    assert figure is not None
    scale = 72.0 / figure.dpi
    points = axes.transData.transform([(x, y) for x, y, *_ in ends]) * scale
    box = axes.bbox
    right = box.x1 * scale
    heights = apart(points[:, 1], STEP, box.y0 * scale + SIZE / 2, box.y1 * scale - SIZE / 2)
    for (x, y, label, color), place in zip(ends, heights, strict=True):
        axes.annotate(
            label,
            (x, y),
            xytext=(right + _LEADER, place),
            textcoords="figure points",
            va="center",
            ha="left",
            fontsize=SIZE,
            color=style.INK,
            annotation_clip=False,
            arrowprops={
                "arrowstyle": "-",
                "color": color,
                "lw": 0.6,
                "shrinkA": 1.0,
                "shrinkB": 2.0,
                "relpos": (0, 0.5),
            },
        )
