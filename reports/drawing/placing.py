"""Place labels beside the points of a plot, so that none lies on another, on a mark or outside the plot.

All lengths are points of 1/72 inch, and y grows upwards. The same input gives the same places.
"""

from __future__ import annotations

import itertools
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextToPath
from numpy.typing import ArrayLike, NDArray

from harness.escaping import one_line
from reports.drawing import style

_REACHES = (1.5, 4.0, 7.0, 11.0, 16.0, 22.0, 29.0, 38.0, 50.0, 64.0)  # between a mark and its label
_ANGLES = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
_BESIDE, _BY_MARK = 4.0, 10.0  # so near to another's mark a label seems to be that one's
_GAP = np.array([5.0, 1.0])  # between labels, beside and above each other
_ALONG = 1.5  # a leader so near to a line is taken for a part of it
_AFAR = 3.0  # a label farther than this from its mark has a leader
_SWEEPS = 12
_KEPT = 90  # places of a label that are tried
_ON_LABEL, _UNDER_LEADER = 4000, 60  # costs of two labels; a reach costs its length
_ON_MARK, _THROUGH, _ON_LINE = 2000.0, 25.0, 6.0


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
    with warnings.catch_warnings():  # a letter that the font lacks is as wide as what stands for it
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        width, _, _ = TextToPath().get_text_width_height_descent(one_line(text), font, ismath=False)
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
    foreign = [others[(np.abs(others - own) > 1e-6).any(axis=1)] for own in at]  # the own mark may be among `marks`
    options = [_Options.of(at[i], size[i], area, radius, foreign[i], along) for i in range(len(at))]
    placed: list[Place | None] = [None] * len(at)
    kept = [i for i, own in enumerate(options) if len(own.cost)]
    between = _Between.of({i: options[i] for i in kept})
    while kept:
        chosen, bad = _settle({i: options[i].cost for i in kept}, between)
        if not bad:
            for i in kept:
                placed[i] = options[i].place(chosen[i])
            break
        kept.remove(max(bad))
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
        cost = 1.5 * reach + np.where(np.abs(way[:, 1]) < 0.1, 0.0, np.where(np.abs(way[:, 0]) < 0.1, 1.0, 2.0))
        cost += np.where(way[:, 0] < -0.1, 0.5, 0.0)
        cost += _BY_MARK * _count(boxes, marks, radius + _BESIDE)
        cost += _ON_MARK * _count(boxes, marks, radius) + _ON_LINE * np.minimum(_count(boxes, lines, 0.0), 5)
        touched = _near(leaders[far], marks, radius).any(axis=1).sum(axis=1)
        met = _near(leaders[far], lines, _ALONG).any(axis=2).sum(axis=1)
        cost[far] += _THROUGH * np.minimum(touched, 4) + 2 * _ON_LINE * met
        best = np.argsort(cost, kind="stable")[:_KEPT]
        return cls(boxes[best], leaders[best], far[best], cost[best])

    def place(self, option: int) -> Place:
        """Return one of the places."""
        x0, y0, x1, y1 = (float(v) for v in (*self.leaders[option, 0], *self.leaders[option, -1]))
        x, y = (float(v) for v in self.boxes[option, :2])
        return Place(x, y, (x0, y0, x1, y1) if self.far[option] else None)


def _settle(costs: Mapping[int, NDArray[np.float64]], between: _Between) -> tuple[dict[int, int], list[int]]:
    """Choose a place for each label; return the choices, and the labels that still lie on a label or a mark.

    `costs` are of each place by itself. Labels are placed one after the other, in several orders, and then moved as
    long as that helps; the cheapest result is taken.
    """
    names = list(costs)
    best: tuple[float, dict[int, int], list[int]] | None = None
    for order in (names, names[::-1], names[1::2] + names[::2], names[::2] + names[1::2]):
        chosen: dict[int, int] = {}
        for _ in range(_SWEEPS):
            before = dict(chosen)
            for i in order:
                chosen[i] = int((costs[i] + between.beside(i, chosen)).argmin())
            if chosen == before:
                break
        paid = {i: float(costs[i][chosen[i]] + between.beside(i, chosen)[chosen[i]]) for i in names}
        if best is None or sum(paid.values()) < best[0]:
            best = (sum(paid.values()), chosen, [i for i in names if paid[i] >= _ON_MARK])
    return ({}, []) if best is None else best[1:]


@dataclass(frozen=True, eq=False)
class _Between:
    """Hold what places of labels cost beside places of others: at once, since there are many pairs.

    starts: where the places of each label begin among those of all
    costs: by label, int16[p, c]: what each of its c places costs beside each of the p places of all labels
    """

    starts: Mapping[int, int]
    costs: Mapping[int, NDArray[np.int16]]

    @classmethod
    def of(cls, options: Mapping[int, _Options]) -> _Between:
        """Hold the costs of labels with these places."""
        every = np.concatenate([np.zeros((0, 4)), *(own.boxes for own in options.values())])
        ends = itertools.accumulate((len(own.cost) for own in options.values()), initial=0)
        starts = dict(zip(options, ends, strict=False))
        crossed = {i: _crossed(own.leaders, own.far, every) for i, own in options.items()}
        of_all = np.concatenate([np.zeros((0, len(every)), bool), *crossed.values()])
        costs = {}
        for i, own in options.items():
            here = slice(starts[i], starts[i] + len(own.cost))
            before, after = _apart(every[: here.stop], own.boxes), _apart(own.boxes, every[here.stop :]).T
            beside = np.where(np.concatenate([before, after]), np.int16(0), np.int16(_ON_LABEL))
            costs[i] = beside + np.int16(_UNDER_LEADER) * (of_all[:, here] | crossed[i].T)
        return cls(starts, costs)

    def beside(self, i: int, chosen: Mapping[int, int]) -> NDArray[np.float64]:
        """Return what each place of label `i` costs beside the places chosen for others, as float64[c]."""
        others = [self.starts[j] + place for j, place in chosen.items() if j != i]
        return np.asarray(self.costs[i][others].sum(axis=0, dtype=np.float64))


def _apart(boxes: NDArray[np.float64], others: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which boxes [c, 4] have a gap to which others [d, 4], as bool[c, d]."""
    found: Any = np.zeros((len(boxes), len(others)), bool)
    for axis in (0, 1):
        found |= boxes[:, axis, None] > others[:, axis + 2] + _GAP[axis]
        found |= boxes[:, axis + 2, None] < others[:, axis] - _GAP[axis]
    return np.asarray(found)


def _crossed(leaders: NDArray[np.float64], far: NDArray[np.bool_], boxes: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which leaders [c, 9, 2], of the `far` [c] ones, go through which boxes [d, 4], as bool[c, d]."""
    found = np.zeros((len(leaders), len(boxes)), bool)
    if far.any():
        drawn = leaders[far]
        low, high = drawn.min(axis=(0, 1)), drawn.max(axis=(0, 1))
        maybe = ((boxes[:, 2:] >= low) & (boxes[:, :2] <= high)).all(axis=1)
        left, bottom, right, top = boxes[maybe].T.copy()
        met = np.zeros((len(drawn), len(left)), bool)
        for x, y in drawn.transpose(1, 2, 0)[..., None]:
            met |= (x >= left) & (x <= right) & (y >= bottom) & (y <= top)
        found[np.ix_(far, maybe)] = met
    return found


def _count(boxes: NDArray[np.float64], points: NDArray[np.float64], radius: float) -> Any:
    """Count the points [m, 2] within `radius` of each box [c, 4], as int[c]."""
    (left, bottom, right, top), (x, y) = boxes.T[:, :, None], points.T
    across = (x > left - radius) & (x < right + radius)
    return (across & (y > bottom - radius) & (y < top + radius)).sum(axis=1)


def _near(leaders: NDArray[np.float64], points: NDArray[np.float64], radius: float) -> Any:
    """Tell which points [m, 2] lie within `radius` of which points of leaders [c, 9, 2], as bool[c, 9, m]."""
    found = np.zeros((*leaders.shape[:2], len(points)), bool)
    if found.size:
        low, high = leaders.min(axis=(0, 1)) - radius, leaders.max(axis=(0, 1)) + radius
        maybe = ((points >= low) & (points <= high)).all(axis=1)  # most are far away
        (x, y), (along, up) = leaders.transpose(2, 0, 1)[..., None], points[maybe].T
        found[..., maybe] = (np.abs(x - along) < radius) & (np.abs(y - up) < radius)
    return found


def _dotted(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points along a line [k, 2], four points of length apart."""
    pieces = [np.zeros((0, 2))]
    for a, b in itertools.pairwise(line):
        steps = max(2, int(np.hypot(*(b - a)) / 4))
        pieces.append(a + np.linspace(0, 1, min(steps, 400))[:, None] * (b - a))
    return np.concatenate(pieces)
