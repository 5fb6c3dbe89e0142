"""Error against condition: whether a method's errors are those of the problem, or larger because it is unstable."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter
from numpy.typing import NDArray

from harness.contract import UNIT_ROUNDOFF
from reports import wording
from reports.analysis import shown, surface_names
from reports.content import Block, Figure, Matrix, Section, Square, Text
from reports.drawing import style
from reports.drawing.canvas import LINE, NARROW, RC, ErrorAxis, Key, line_of, series, svg
from reports.drawing.style import Mark
from reports.material import Material
from reports.reading.arrays import Shelf
from reports.reading.taking import taken
from reports.reading.tuples import tuples

ORDER = 40
TITLE = "Error against condition"
ONE_PAGE = 24  # a run with more surfaces has no figure beside the matrix
BINS = 12  # of equal width in the logarithm of the condition, over the range of one surface's conditions
NAMED = 6  # methods that a sentence names
VARIANTS = 4  # the most that are drawn of one method
DODGE = 0.6  # the share of a bin's width over which its marks are spread, so that all are seen
_ROUNDOFF: Mapping[str, float] = {str(name): unit for name, unit in UNIT_ROUNDOFF.items()}
ALONE, ATLAS = 2, 8  # a run with at most ALONE or more than ATLAS surfaces has a page; else all is in the details
MOST_DRAWN = 4  # surfaces with a figure in the details: those with the largest ratios
NEAR, FAR = 10.0, 1000.0  # ratios that are told apart by colour
_COLORS = {"#dbe9f6": f"up to {NEAR:g}", "#fdf0c8": f"up to {FAR:,.0f}", "#f6c9ad": "more"}
EXPLANATION = (
    "The condition number of a root says how far it moves when the terms of f change by a relative amount. Condition × "
    "unit roundoff (condition at least 1) is the error, over the radius, that the problem allows at a ray: what no "
    "method avoids that rounds f's terms. A method near it is as bad as the problem and no worse; one far above it is "
    "unstable, or stops early. In figures the black line is what the problem allows; a mark is the largest error among "
    "the rays of a narrow range of condition, and the thin line below it reaches down to their median. "
    + wording.ZERO
    + " Rays at silhouettes are included: they have the largest "
    f"conditions. Of the device with most results, and at most {VARIANTS} variants of each method."
)


@dataclass(frozen=True, eq=False)
class Cloud:
    """Hold the rays of one row that hit the right root."""

    method: str
    variant: str
    label: str
    method_label: str
    precision: str
    condition: NDArray[np.float64]  # [n]
    error: NDArray[np.float64]  # [n], over the domain's radius

    @property
    def excess(self) -> float:
        """Return the largest ratio of a ray's error to the error that the problem allows at the ray's condition."""
        return float((self.error / allowed(self.condition, self.precision)).max())


def allowed(condition: NDArray[np.float64], precision: str) -> NDArray[np.float64]:
    """Return the error, over the domain's radius, that the problem allows at each condition [n], as float64[n]."""
    return np.maximum(condition, 1.0) * _ROUNDOFF[precision]


def sections(material: Material) -> list[Section]:
    """Make a section with a matrix of the worst ratios, and a figure of the surface that tells most; [] without any."""
    frame = surface_names.printed_alone(material.frame)
    found: list[tuple[list[Cloud], pd.Series]] = []
    for places in frame.groupby("surface", sort=False).indices.values():
        drawn = shown.of_surface(taken(frame, places), VARIANTS)
        clouds = [cloud for row in tuples(drawn) if (cloud := _cloud(material.shelf, row)) is not None]
        if clouds:
            found.append((clouds, drawn.iloc[0]))
    if not found:
        return []
    ranked = sorted(found, key=lambda pair: -max(cloud.excess for cloud in pair[0]))[:MOST_DRAWN]
    kept = [pair for pair in found if any(pair is one for one in ranked)]
    figures = [_figure(f"condition-{i}", clouds, material.marks, row) for i, (clouds, row) in enumerate(kept)]
    first = next(i for i, pair in enumerate(kept) if pair is ranked[0])
    every = [cloud for clouds, _ in found for cloud in clouds]
    precision, *others = sorted({cloud.precision for cloud in every})
    told = seen([cloud for cloud in every if cloud.precision == precision])
    page: tuple[Block, ...] = (Text(told), matrix(found, precision))
    further = (matrix(found, name) for name in others)
    rest: tuple[Block, ...] = (Text(EXPLANATION), *further, *figures[:first], *figures[first + 1 :])
    if ALONE < len(found) <= ATLAS:
        return [Section(TITLE, (), (*page, figures[first], *rest))]
    room = (figures[first],) if len(found) <= ONE_PAGE else ()
    return [Section(TITLE, (*page, *room), (*rest, *([] if room else [figures[first]])))]


def seen(clouds: Sequence[Cloud]) -> str:
    """Say which methods stay near the error that the problem allows, and which go far above it.

    The clouds are those of one precision.
    """
    worst: dict[str, float] = {}
    for cloud in clouds:
        worst[cloud.method_label] = max(cloud.excess, worst.get(cloud.method_label, 0.0))
    near = [label for label, excess in worst.items() if excess <= NEAR]
    far = sorted((label for label, excess in worst.items() if excess > FAR), key=lambda label: -worst[label])
    told = []
    if near:
        told.append(
            f"Never more than {NEAR:g} times what a root's condition allows: the errors of {wording.few(near, NAMED)}."
        )
    if far:
        named = [f"{label} (up to {wording.short(worst[label])})" for label in far]
        told.append(f"More than {FAR:,.0f} times above it, unstable or ended early: {wording.few(named, NAMED)}.")
    return (
        " ".join(told) or f"Every method's worst error is {NEAR:g} to {FAR:,.0f} times what a root's condition allows."
    )


def matrix(found: Sequence[tuple[list[Cloud], pd.Series]], precision: str) -> Matrix:
    """Make a line for each surface, and a column for each method: its worst error over the allowed one.

    Of several variants of a method a square has the worst.
    """
    methods = {cloud.method: cloud.method_label for clouds, _ in found for cloud in clouds}
    lines = []
    for clouds, row in found:
        title = str(row["surface_title"])
        own = [cloud for cloud in clouds if cloud.precision == precision]
        squares = tuple(_square([cloud for cloud in own if cloud.method == method], title) for method in methods)
        if own:
            lines.append((title, squares))
    return Matrix(
        tuple(methods.values()),
        lines,
        f"Worst error over what the problem allows, in {precision}.",
        "Of all rays that hit the right root; of a method's variants the worst. Small is stable.",
        "surface",
        _COLORS,
    )


def _square(clouds: Sequence[Cloud], surface: str) -> Square:
    """Write the worst ratio of some variants of a method on one surface; a dash where it has none."""
    if not clouds:
        return Square(wording.NONE)
    worst = max(clouds, key=lambda cloud: cloud.excess)
    color = list(_COLORS)[(worst.excess > NEAR) + (worst.excess > FAR)]
    note = f"{worst.label} on {surface}: its worst error is {wording.short(worst.excess)} times what is allowed"
    return Square(wording.short(worst.excess), color, note)


def _cloud(shelf: Shelf, row: Any) -> Cloud | None:
    """Read the cloud of one row; None where its conditions or its radius are not known."""
    arrays = shelf.get(row)
    if arrays is None or arrays.condition is None:
        return None
    radius = row.scene_radius if wording.absent(row.domain_radius) else row.domain_radius
    known = np.isfinite(arrays.error) & np.isfinite(arrays.condition) & (arrays.condition > 0)
    if wording.absent(radius) or not known.any():
        return None
    condition, error = (array[known].astype(np.float64) for array in (arrays.condition, arrays.error))
    return Cloud(row.method, row.variant, row.label, row.method_label, row.precision, condition, error / radius)


def _figure(name: str, clouds: list[Cloud], marks: Mapping[str, Mark], row: Any) -> Figure:
    """Draw the clouds of one surface, a panel for each precision; `row` is one of its rows."""
    radius = "scene's" if wording.absent(row["domain_radius"]) else "domain's"
    labels = {cloud.variant: cloud.label for cloud in clouds}
    variants = [variant for variant in marks if variant in labels]
    precisions = sorted({cloud.precision for cloud in clouds})
    every = np.log10(np.concatenate([cloud.condition for cloud in clouds]))
    edges = np.linspace(every.min(), max(every.max(), every.min() + 0.1), BINS + 1)
    limits = np.concatenate([allowed(10.0 ** edges[[0, -1]], precision) for precision in precisions])
    axis = ErrorAxis.of(np.concatenate([limits, *(np.concatenate(_spread(c, edges)[1:]) for c in clouds)]))
    line = Line2D([], [], color=style.INK, lw=1.1)
    key = Key(
        [*(line_of(marks[v]) for v in variants), line],
        [*(labels[v] for v in variants), "condition × unit roundoff"],
        NARROW,
    )
    above = key.height + 0.2
    height = above + 0.36 + 1.7
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(NARROW, height))
        panels = drawing.subplots(1, len(precisions), sharex=True, sharey=True, squeeze=False)[0]
        drawing.subplots_adjust(0.5 / NARROW, 0.36 / height, 1 - 0.05 / NARROW, 1 - above / height, 0.05)
        for axes, precision in zip(panels, precisions, strict=True):
            axes.set_title(precision, color=style.INK)
            _dress(axes, edges, axis, precision)
            for cloud in clouds:
                if cloud.precision == precision:
                    place = (variants.index(cloud.variant) + 0.5) / len(variants) - 0.5
                    _draw(axes, cloud, edges, DODGE * place * (edges[1] - edges[0]), axis, marks[cloud.variant])
        drawing.supxlabel("condition number", y=0.08 / height, va="center", fontsize=7)
        drawing.supylabel(f"|t − t*| over the {radius} radius", x=0.08 / NARROW, ha="center", fontsize=7)
        key.draw(drawing)
        drawn = svg(drawing)
    names = wording.listed([labels[v] for v in variants])
    return Figure(
        name,
        drawn,
        f"Largest and median error of {names} on {row['surface_title']}, against condition.",
        f"{row['surface_title']}, view {row['view']}, on {row['device']}.",
        _caption(clouds, radius),
    )


def _spread(
    cloud: Cloud, edges: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
    """Return the indices of the bins that hold rays, and the largest and the median error in each.

    `edges` float64[n + 1] bound n bins in the decimal logarithm of the condition. The result is intp[k], float64[k],
    float64[k] for the k bins that hold rays.
    """
    bins = np.clip(np.searchsorted(edges, np.log10(cloud.condition), side="right") - 1, 0, len(edges) - 2)
    order = np.lexsort((cloud.error, bins))
    errors = cloud.error[order]
    filled, first, count = np.unique(bins[order], return_index=True, return_counts=True)
    return filled, errors[first + count - 1], errors[first + count // 2]


def _draw(axes: Axes, cloud: Cloud, edges: NDArray[np.float64], shift: float, axis: ErrorAxis, mark: Mark) -> None:
    """Draw one cloud, its marks moved by `shift` from the middle of their bin.

    `edges` [n + 1] are those of the n bins.
    """
    filled, largest, median = _spread(cloud, edges)
    x = (edges[filled] + edges[filled + 1]) / 2 + shift
    top, middle = axis.position(largest), axis.position(median)
    own = series(cloud.method, cloud.variant)
    axes.vlines(x, middle, top, color=mark.color, lw=0.7, zorder=3, gid=own)
    axes.plot(x, top, color=mark.color, marker=mark.marker, ls=mark.line, zorder=4, gid=own, **LINE)


def _dress(axes: Axes, edges: NDArray[np.float64], axis: ErrorAxis, precision: str) -> None:
    """Set the axes of one panel, and draw the line of what the problem allows.

    `edges` [n + 1] are those of the n bins.
    """
    axis.dress(axes, "y")
    low, high = float(edges[0]), float(edges[-1])
    axes.set_xlim(low - 0.03 * (high - low), high + 0.03 * (high - low))
    within = (1, 2, 5) if high - low < 1.8 else (1,)
    step = max(1, math.ceil((high - low) / 8))
    places = [e + math.log10(m) for e in range(math.floor(low), math.ceil(high) + 1, step) for m in within]
    axes.xaxis.set_major_locator(FixedLocator(places))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda place, _: wording.level(10.0**place)))
    line = np.unique(np.clip([low, 0.0, high], low, high))
    axes.plot(line, np.log10(allowed(10.0**line, precision)), color=style.INK, lw=1.1, zorder=5)


def _caption(clouds: list[Cloud], radius: str) -> str:
    """Name in each precision the variants farthest above the line of what the problem allows, and those least above it.

    Variants whose printed figure is the same are named together.
    """
    told = []
    for precision in sorted({cloud.precision for cloud in clouds}):
        own = [cloud for cloud in clouds if cloud.precision == precision]
        figures = {cloud.label: wording.short(cloud.excess) for cloud in sorted(own, key=lambda c: c.excess)}
        lowest, highest = (figures[variant] for variant in (next(iter(figures)), next(reversed(figures))))
        low, high = (
            f"{end} ({wording.listed([v for v, figure in figures.items() if figure == end])})"
            for end in (lowest, highest)
        )
        told.append(f"{precision}: {high}" if lowest == highest else f"{precision}: from {low} to {high}")
    note = "" if radius == "domain's" else " This run does not tell the domain's radius; the line takes the scene's."
    return f"Worst error over the line, in {'; in '.join(told)}.{note}"
