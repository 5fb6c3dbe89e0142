"""Draw times against errors as SVG that follows the page's colours, light or dark."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from reports import wording
from reports.drawing.markers import outline
from reports.drawing.style import Mark
from reports.site.markup import Html, join, tag

WIDTH, HEIGHT = 560, 360
LEFT, RIGHT, TOP, BOTTOM = 76, 14, 12, 48
SIZE = 5.5  # of a mark, half its side
LETTER, LINE = 7.0, 15.0  # the size of a label's letters, on average


@dataclass(frozen=True)
class Point:
    """Hold a point: its place, how it is marked, its label, what it is told to be under the pointer, and its link.

    A `hollow` one answers some rays wrongly.
    """

    x: float
    y: float
    mark: Mark
    label: str
    title: str
    to: str
    hollow: bool = False


@dataclass(frozen=True)
class _Axis:
    """Hold a logarithmic axis: its decades, and the pixels of its ends."""

    low: float
    high: float
    start: float
    end: float

    def __call__(self, value: float) -> float:
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def ticks(self) -> list[float]:
        """Return the values to mark: powers of ten, and where there are few of them 2 and 5 times these."""
        exponents = range(math.ceil(self.low), math.floor(self.high) + 1)
        if len(exponents) > 2:
            step = -(-len(exponents) // 8)
            return [10.0**n for n in exponents if n % step == 0]
        every = (f * 10.0**n for n in range(math.floor(self.low), math.ceil(self.high) + 1) for f in (1, 2, 5))
        return [v for v in every if self.low <= math.log10(v) <= self.high]


def scatter(points: Sequence[Point], x_title: str, y_title: str, description: str) -> Html:
    """Draw points on logarithmic axes; an error of 0 is drawn below the least one. Returns "" without a point."""
    points = [p for p in points if p.x > 0 and math.isfinite(p.x) and math.isfinite(p.y)]
    if not points:
        return Html("")
    positive = [p.y for p in points if p.y > 0]
    exact = 10 ** math.floor(math.log10(min(positive, default=1e-7)) - 0.7)
    heights = [p.y if p.y > 0 else exact for p in points]
    x = _axis([p.x for p in points], LEFT, WIDTH - RIGHT)
    y = _axis(heights, HEIGHT - BOTTOM, TOP)
    zero = exact if len(positive) < len(points) else None
    spots = [(x(p.x), y(h)) for p, h in zip(points, heights, strict=True)]
    marks = (_mark(p, *spot) for p, spot in zip(points, spots, strict=True))
    names = _labels(points, spots)
    return tag(
        "svg",
        tag("title", description),
        _grid(x, y, zero),
        tag("text", x_title, x=(LEFT + WIDTH - RIGHT) / 2, y=HEIGHT - 8, text_anchor="middle", class_="axis"),
        tag(
            "text",
            y_title,
            x=14,
            y=HEIGHT / 2 - 12,
            class_="axis",
            text_anchor="middle",
            transform=f"rotate(-90 14 {HEIGHT / 2 - 12:g})",
        ),
        *marks,
        *names,
        viewBox=f"0 0 {WIDTH} {HEIGHT}",
        role="group",
        class_="scatter",
        aria_label=description,
    )


def _axis(values: Sequence[float], start: float, end: float) -> _Axis:
    low, high = math.log10(min(values)), math.log10(max(values))
    room = max(0.08 * (high - low), 0.15)
    return _Axis(low - room, high + room, start, end)


def _grid(x: _Axis, y: _Axis, zero: float | None) -> Html:
    """Draw lines and numbers of both axes; `zero` is where errors of 0 are drawn, None where there is none."""
    made = []
    for value in x.ticks():
        made.append(tag("line", x1=f"{x(value):.1f}", x2=f"{x(value):.1f}", y1=TOP, y2=HEIGHT - BOTTOM))
        made.append(
            tag("text", wording.level(value), x=f"{x(value):.1f}", y=HEIGHT - BOTTOM + 16, text_anchor="middle")
        )
    ticks = [(value, wording.level(value)) for value in y.ticks() if zero is None or value > 2 * zero]
    for value, text in [*ticks, *([(zero, "0")] if zero else [])]:
        made.append(tag("line", x1=LEFT, x2=WIDTH - RIGHT, y1=f"{y(value):.1f}", y2=f"{y(value):.1f}"))
        made.append(tag("text", text, x=LEFT - 6, y=f"{y(value) + 4:.1f}", text_anchor="end"))
    return tag("g", *made, class_="grid")


def _mark(point: Point, x: float, y: float) -> Html:
    """Draw a point as a link that tells what it is. Keys pass over it: its row is in a table."""
    fill = "none" if point.hollow else point.mark.color
    path = tag("path", d=outline(point.mark, x, y, SIZE), fill=fill, stroke=point.mark.color)
    return tag("a", tag("title", point.title), path, href=point.to, aria_label=point.title, tabindex=-1)


def _labels(points: Sequence[Point], spots: Sequence[tuple[float, float]]) -> list[Html]:
    """Write each point's label beside it where there is room for it; what has none is told under the pointer."""
    boxes = [(x - SIZE, y - SIZE, x + SIZE, y + SIZE) for x, y in spots]
    made = []
    for point, (x, y) in zip(points, spots, strict=True):
        width = LETTER * len(point.label)
        for left, top, at in (
            (x + 9, y - 8, "start"),
            (x - 9 - width, y - 8, "end"),
            (x - width / 2, y - 23, "middle"),
            (x - width / 2, y + 8, "middle"),
        ):
            box = (left, top, left + width, top + LINE)
            inside = box[0] > LEFT and box[2] < WIDTH and box[1] > 0 and box[3] < HEIGHT - BOTTOM + 4
            if inside and not any(_meet(box, other) for other in boxes):
                boxes.append(box)
                place = {"start": x + 9, "end": x - 9, "middle": x}[at]
                made.append(tag("text", point.label, x=f"{place:.1f}", y=f"{top + 12.5:.1f}", text_anchor=at))
                break
    return made


def _meet(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def chip(mark: Mark) -> Html:
    """Draw a mark as a small picture to stand before a name, which tells the same."""
    path = tag("path", d=outline(mark, 8, 8, SIZE), fill=mark.color, stroke=mark.color)
    return join(tag("svg", path, viewBox="0 0 16 16", class_="chip", aria_hidden="true"), " ")
