"""Place labels beside the points of a plot, so that none lies on another, on a mark or outside the plot.

All lengths are points of 1/72 inch, and y grows upwards. The same input gives the same places.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from numpy.typing import ArrayLike, NDArray

from reports.drawing import style

_REACHES = (1.5, 4.0, 7.0, 11.0, 16.0, 22.0, 29.0, 38.0, 50.0, 64.0)  # between a mark and its label
_ANGLES = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
_GAP = 1.0  # between labels
_ALONG = 1.5  # a leader so near to a line is taken for a part of it
_AFAR = 3.0  # a label farther than this from its mark has a leader
_SWEEPS = 12
_ON_LABEL, _ON_MARK, _UNDER_LEADER, _ON_LINE = 4000.0, 2000.0, 60.0, 6.0  # costs; a reach costs its length


@dataclass(frozen=True)
class Place:
    """Hold where a label stands: the lower left corner of its box, and its leader.

    The leader is (x0, y0, x1, y1) from the mark's edge to the box, None for a label that stands beside its mark.
    """

    x: float
    y: float
    leader: tuple[float, float, float, float] | None


def text_size(text: str, size: float, bold: bool = False) -> tuple[float, float]:
    """Return width and height of a line of text in style.FONT at this size."""
    width, height = _size(text, bold)
    return width * size, height * size


@cache
def _size(text: str, bold: bool) -> tuple[float, float]:
    """Return width and height of a line of text over the font's size."""
    font = FontProperties(family=style.FONT, size=100, weight="bold" if bold else "normal")
    width, _, _ = TextToPath().get_text_width_height_descent(text, font, ismath=False)
    return width / 100, 1.0


def place(
    anchors: ArrayLike,
    sizes: ArrayLike,
    area: tuple[float, float, float, float],
    *,
    radius: float = 3.0,
    marks: ArrayLike = (),
    lines: Sequence[ArrayLike] = (),
) -> list[Place | None]:
    """Return a place for the label of each of `anchors` [n, 2], the most important first.

    A label that finds no free place is None; the last of those that get in each other's way go first. `sizes` [n, 2]
    are width and height of the labels, `area` is (left, bottom, right, top) of the plot, `radius` is that of a mark.
    `marks` [m, 2] are further marks to keep free, and `lines`, each [k, 2], are drawn lines that labels had better not
    stand on.
    """
    at, size = np.asarray(anchors, float).reshape(-1, 2), np.asarray(sizes, float).reshape(-1, 2)
    others = np.concatenate([at, np.asarray(marks, float).reshape(-1, 2)])
    along = np.concatenate([np.zeros((0, 2)), *(_dotted(np.asarray(line, float)) for line in lines)])
    options = [_Options.of(at[i], size[i], area, radius, np.delete(others, i, 0), along) for i in range(len(at))]
    placed: list[Place | None] = [None] * len(at)
    kept = [i for i, own in enumerate(options) if len(own.cost)]
    while kept:
        chosen, bad = _settle([options[i] for i in kept])
        if not bad:
            for i, option in zip(kept, chosen, strict=True):
                placed[i] = options[i].place(option)
            break
        del kept[max(bad)]
    return placed


@dataclass(frozen=True, eq=False)
class _Options:
    """Hold the places that one label may take: boxes [c, 4], leaders [c, 9, 2] and what each costs by itself [c]."""

    boxes: NDArray[np.float64]
    leaders: NDArray[np.float64]
    far: NDArray[np.bool_]
    cost: NDArray[np.float64]

    @classmethod
    def of(
        cls,
        at: NDArray[np.float64],
        size: NDArray[np.float64],
        area: tuple[float, float, float, float],
        radius: float,
        marks: NDArray[np.float64],
        lines: NDArray[np.float64],
    ) -> _Options:
        """Return the places within the area."""
        reach, angle = (grid.ravel() for grid in np.meshgrid(_REACHES, _ANGLES, indexing="ij"))
        way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        aside = np.clip(way * np.sqrt(2.0), -1.0, 1.0)  # the box touches the circle with a side or a corner
        centre = at + way * (radius + reach)[:, None] + aside * size / 2
        boxes = np.concatenate([centre - size / 2, centre + size / 2], axis=1)
        left, bottom, right, top = area
        inside = (boxes[:, :2] >= (left, bottom)).all(axis=1) & (boxes[:, 2:] <= (right, top)).all(axis=1)
        boxes, reach, way = boxes[inside], reach[inside], way[inside]
        ends = np.clip(at, boxes[:, :2], boxes[:, 2:])
        starts = at + way * radius
        leaders = starts[:, None] + np.linspace(0, 1, 9)[None, :, None] * (ends - starts)[:, None]
        far = reach > _AFAR
        cost = reach + np.where(np.abs(way[:, 1]) < 0.1, 0.0, np.where(np.abs(way[:, 0]) < 0.1, 1.0, 2.0))
        cost += np.where(way[:, 0] < -0.1, 0.5, 0.0)
        cost += _ON_MARK * _count(boxes, marks, radius) + _ON_LINE * np.minimum(_count(boxes, lines, 0.0), 5)
        near: Any = (np.abs(leaders[:, :, None] - marks[None, None]) < radius).all(axis=3)
        touched = near.any(axis=1).sum(axis=1)
        met: Any = (np.abs(leaders[:, :, None] - lines[None, None]) < _ALONG).all(axis=3)
        under = _UNDER_LEADER * np.minimum(touched, 4) + _ON_LINE * met.any(axis=2).sum(axis=1)
        return cls(boxes, leaders, far, cost + np.where(far, under, 0.0))

    def place(self, option: int) -> Place:
        """Return one of the places."""
        x0, y0, x1, y1 = (float(v) for v in (*self.leaders[option, 0], *self.leaders[option, -1]))
        x, y = (float(v) for v in self.boxes[option, :2])
        return Place(x, y, (x0, y0, x1, y1) if self.far[option] else None)


def _settle(options: Sequence[_Options]) -> tuple[list[int], list[int]]:
    """Choose a place for each label; return the choices, and the labels that still lie on a label or a mark."""
    chosen = [int(own.cost.argmin()) for own in options]
    for _ in range(_SWEEPS):
        before = list(chosen)
        for i, own in enumerate(options):
            rest = [(options[j], chosen[j]) for j in range(len(options)) if j != i]
            chosen[i] = int((own.cost + _between(own, rest)).argmin())
        if chosen == before:
            break
    bad = []
    for i, own in enumerate(options):
        rest = [(options[j], chosen[j]) for j in range(len(options)) if j != i]
        if own.cost[chosen[i]] + _between(own, rest)[chosen[i]] >= _ON_MARK:
            bad.append(i)
    return chosen, bad


def _between(own: _Options, rest: Sequence[tuple[_Options, int]]) -> Any:
    """Return what each place of a label costs beside the chosen places of the others, as float64[c]."""
    cost = np.zeros(len(own.cost))
    for other, option in rest:
        box = other.boxes[option]
        apart = (own.boxes[:, :2] > box[2:] + _GAP).any(axis=1) | (own.boxes[:, 2:] < box[:2] - _GAP).any(axis=1)
        cost += np.where(apart, 0.0, _ON_LABEL)
        crossed = ((own.leaders >= box[:2]) & (own.leaders <= box[2:])).all(axis=2).any(axis=1)
        cost += np.where(own.far & crossed, _UNDER_LEADER, 0.0)
        if other.far[option]:
            cost += _UNDER_LEADER * np.minimum(_count(own.boxes, other.leaders[option], 0.0), 1)
    return cost


def _count(boxes: NDArray[np.float64], points: NDArray[np.float64], radius: float) -> Any:
    """Count the points [m, 2] within `radius` of each box [c, 4], as int[c]."""
    low, high = boxes[:, None, :2] - radius, boxes[:, None, 2:] + radius
    return ((points[None] > low) & (points[None] < high)).all(axis=2).sum(axis=1)


def _dotted(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points along a line [k, 2], four points of length apart."""
    pieces = [np.zeros((0, 2))]
    for a, b in itertools.pairwise(line):
        steps = max(2, int(np.hypot(*(b - a)) / 4))
        pieces.append(a + np.linspace(0, 1, min(steps, 400))[:, None] * (b - a))
    return np.concatenate(pieces)
