"""Draw figures that are one column of a paper wide, with text of SIZE points."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator
from numpy.typing import NDArray

from reports.analysis import derive
from reports.analysis.fits import Power
from reports.drawing import placing, shades, style
from reports.drawing.canvas import RC, ErrorAxis, label_decades
from reports.drawing.style import Mark
from reports.reading.tuples import tuples

WIDTH = 3.33  # inches, of a column
SIZE = 8.0  # points, of every text
LINE_HEIGHT = 1.35 * SIZE / 72  # inches
SETTINGS: dict[Any, Any] = RC | {
    "font.size": SIZE,
    "axes.titlesize": SIZE,
    "axes.labelsize": SIZE,
    "xtick.labelsize": SIZE,
    "ytick.labelsize": SIZE,
    "legend.fontsize": SIZE,
    "figure.titlesize": SIZE,
    "pdf.fonttype": 42,  # text stays text in the PDF
}
INSIDE = np.array([2.69, 2.3])  # inches, width and height of the axes of speed against error
FLOOR: dict[str, Any] = {"facecolor": "none", "edgecolor": style.FAINT, "hatch": "/////", "linewidth": 0}
FOLD = 22  # letters of a line of a long label
_PALE = 0.55  # how far what is not in focus fades to white


class Look:
    """Tell how a variant or a method is drawn; with a focus all others are pale."""

    def __init__(self, marks: Mapping[str, Mark], focus: Sequence[str]) -> None:
        """Take the marks by name, and the names in focus; none where the report has no focus."""
        self.marks, self.focus = marks, set(focus)

    def of(self, name: str) -> dict[str, Any]:
        """Return matplotlib's settings of a line with marks."""
        mark = self.marks[name]
        first = name in self.focus
        color = mark.color if first or not self.focus else _pale(mark.color)
        size = {"lw": 1.4, "ms": 6.0, "zorder": 5} if first else {"lw": 0.8, "ms": 4.2, "zorder": 4}
        return {"color": color, "marker": mark.marker, "ls": mark.line, "mew": 0.9, **size}


def _pale(color: str) -> tuple[float, float, float]:
    """Return a colour that has faded to white."""
    red, green, blue = (c + _PALE * (1 - c) for c in matplotlib.colors.to_rgb(color))
    return (red, green, blue)


def keyed(
    height: float, entries: Sequence[tuple[Artist, str]], left: float, below: float, right: float = 0.06
) -> tuple[Drawing, Axes]:
    """Return a drawing with axes `height` inches high, and below them a key in as many columns as fit.

    `left`, `below` and `right` are the inches that the axes' labels take.
    """
    handles, labels = [list(part) for part in zip(*entries, strict=True)] if entries else ([], [])
    columns = _columns(labels)
    lines = max((sum(1 + label.count("\n") for label in own) for own in np.array_split(labels, columns)), default=0)
    key, above = LINE_HEIGHT * lines + 0.04, 0.08
    whole = above + height + below + key
    drawing = Drawing(figsize=(WIDTH, whole))
    axes = drawing.add_axes((left / WIDTH, (below + key) / whole, 1 - (left + right) / WIDTH, height / whole))
    if labels:
        told: dict[str, Any] = {"ncols": columns, "borderaxespad": 0.0, "handlelength": 1.6, "columnspacing": 1.0}
        told |= {"handletextpad": 0.4, "labelspacing": 0.25, "borderpad": 0.0}
        drawing.legend(handles, labels, loc="lower center", bbox_to_anchor=(0.5, 0.02 / whole), **told)
    return drawing, axes


def _columns(labels: Sequence[str]) -> int:
    """Return in how many columns a key of these labels fits, at least 1; they fill one column after the other."""
    widths = [_wide(label) + 0.38 for label in labels]
    for columns in range(len(widths), 1, -1):
        if sum(max(own) for own in np.array_split(widths, columns)) < WIDTH:
            return columns
    return 1


def _folded(label: str) -> str:
    """Break a long label into lines."""
    return textwrap.fill(label, FOLD)


def _wide(label: str, bold: bool = False) -> float:
    """Return the width of a label's longest line, inches."""
    return max(placing.text_size(line, SIZE, bold)[0] for line in label.split("\n")) / 72


def _handle(look: Mapping[str, Any]) -> Line2D:
    """Return a line as the key shows it."""
    return Line2D([], [], **{name: value for name, value in look.items() if name != "zorder"})


def speed_against_error(rows: pd.DataFrame, look: Look) -> Drawing:
    """Draw the timed rows of one scene, device and precision, with the methods' names beside the marks.

    `look` is by method. A name that finds no place is in a key below.
    """
    axis, y = ErrorAxis.of(rows["error_max"]), rows["mrays_per_s"]
    x = pd.Series(axis.position(rows["error_max"]), rows.index)
    margin = 0.06 * (axis.highest - axis.lowest)
    left = axis.zero if (rows["error_max"] == 0).any() else axis.lowest
    low, high = y.min() / 1.6, y.max() * 1.6

    def points(at: Any, speed: Any) -> Any:
        across = (np.asarray(at) - left + margin) / (axis.highest - left + 2 * margin)
        up = np.log(np.asarray(speed) / low) / math.log(high / low)
        return 72 * INSIDE * np.clip(np.stack([across, up], axis=1), 0, 1)

    edge = _front(x[rows["front"].astype(bool)].sort_values(), y)
    joined = [points(x[own.index], own["mrays_per_s"]) for _, own in rows.groupby("method")]
    named = rows.drop_duplicates("method")["method_label"]
    told = _placed(pd.DataFrame(points(x, y), rows.index), named, [points(*edge), *joined])
    entries = [(_handle(look.of(rows.loc[at, "method"])), named[at]) for at, place in told.items() if place is None]
    with matplotlib.rc_context(SETTINGS):
        drawing, axes = keyed(INSIDE[1], [*entries, *_signs(rows, high)], left=WIDTH - INSIDE[0] - 0.06, below=0.42)
        axis.dress(axes)
        axes.set_xlim(left - margin, axis.highest + margin)
        axes.set_yscale("log")
        axes.set_ylim(low, high)
        label_decades(axes.yaxis)
        if (bound := _floor(rows)) < high:
            axes.axhspan(bound, 1e3 * bound, zorder=0.5, **FLOOR | {"edgecolor": style.HAIRLINE})
        right = derive.all_right(rows)
        for method, own in x.sort_index().groupby(rows["method"]):
            how = look.of(str(method))
            axes.plot(own, y[own.index], **how | {"ls": "-", "lw": 0.5 * how["lw"]})
            wrong = own[~right[own.index]]
            axes.plot(wrong, y[wrong.index], **how | {"ls": "none", "markerfacecolor": style.PAPER})
        axes.plot(*edge, color=style.INK, lw=0.8, zorder=2)
        _name(axes, {at: (named[at], place) for at, place in told.items() if place}, rows, look)
        axes.set_xlabel("largest error |t − t*|, scene units")
        axes.set_ylabel("Mrays/s")
    return drawing


def _placed(points: pd.DataFrame, named: pd.Series, lines: Sequence[Any]) -> dict[Any, placing.Place | None]:
    """Return a place for the name of each row of `named`.

    `points` are all marks and `lines` what is drawn besides, in points from the lower left.
    """
    sizes = [placing.text_size(name, SIZE) for name in named]
    inside = (2.0, 2.0, 72 * INSIDE[0] - 2.0, 72 * INSIDE[1] - 2.0)
    others = points.drop(index=named.index).to_numpy()
    found = placing.place(points.loc[named.index].to_numpy(), sizes, inside, radius=3.2, marks=others, lines=lines)
    return dict(zip(named.index, found, strict=True))


def _name(axes: Axes, told: Mapping[Any, tuple[str, placing.Place]], rows: pd.DataFrame, look: Look) -> None:
    """Write names at their places, which are in points from the lower left of `axes`."""
    corner = axes.transAxes
    for at, (name, place) in told.items():
        method = rows.loc[at, "method"]
        weight = "bold" if method in look.focus else "normal"
        x, y = place.x / (72 * INSIDE[0]), (place.y + 0.22 * SIZE) / (72 * INSIDE[1])
        axes.text(x, y, name, transform=corner, va="baseline", ha="left", color=style.INK, weight=weight, zorder=6)
        if place.leader is not None:
            ends = np.array(place.leader).reshape(2, 2) / (72 * np.array(INSIDE))
            axes.plot(*ends.T, transform=corner, color=look.of(method)["color"], lw=0.6, zorder=3)


def _floor(rows: pd.DataFrame) -> float:
    """Return the Mrays/s from which on a row of this scene is floor-bound; infinity where none is known."""
    row = next(tuples(rows[["mrays_per_s", "median_ms", "floor_ms"]].head(1)))
    return row.mrays_per_s * row.median_ms / (derive.FLOOR_FACTOR * row.floor_ms) if row.floor_ms > 0 else math.inf


def _signs(rows: pd.DataFrame, top: float) -> list[tuple[Artist, str]]:
    """Return the entries of the key that explain the signs of these rows, which are drawn up to `top` Mrays/s."""
    entries: list[tuple[Artist, str]] = []
    if not derive.all_right(rows).all():
        hollow = Line2D([], [], color=style.INK, marker="o", markerfacecolor=style.PAPER, ms=4.2, lw=0)
        entries.append((hollow, "wrong rays"))
    if rows["front"].any():
        entries.append((Line2D([], [], color=style.INK, lw=0.8), "front"))
    if _floor(rows) < top:
        entries.append((Patch(**FLOOR), "floor-bound"))
    return entries


def _front(front: pd.Series, speeds: pd.Series) -> tuple[Any, Any]:
    """Return the line below and right of which every row is beaten; an empty one where `front` is empty."""
    if front.empty:
        return np.empty(0), np.empty(0)
    own = speeds[front.index]
    x, y = np.r_[front.iloc[0], front, front.iloc[-1] + 99], np.r_[own.iloc[0] * 1e-9, own, own.iloc[-1]]
    return np.repeat(x, 2)[1:], np.repeat(y, 2)[:-1]


def matrix(shares: pd.DataFrame, told: pd.DataFrame, strong: Sequence[str]) -> Drawing:
    """Draw a square for each cell of `shares`, in 0…1 and NaN for nothing, with the text of `told` in it.

    Rows are named by the index, those in `strong` in bold, and columns by the columns.
    """
    names, heads = ([_folded(str(name)) for name in of] for of in (shares.index, shares.columns))
    bold = [name in strong for name in shares.index]
    edges = _edges(names)
    left, top = 0.1 + max(map(_wide, names, bold)), 0.2 + max(map(_wide, heads))
    cell = min(0.42, (WIDTH - left - 0.05) / len(heads))
    height = edges[-1] + top + 0.05
    with matplotlib.rc_context(SETTINGS):
        drawing = Drawing(figsize=(WIDTH, height))
        axes = drawing.add_axes((left / WIDTH, 0.05 / height, cell * len(heads) / WIDTH, edges[-1] / height))
        axes.set_xlim(0, len(heads))
        axes.set_ylim(edges[-1], 0)
        axes.set_axis_off()
        for i, y in enumerate((edges[1:] + edges[:-1]) / 2):
            for j, share in enumerate(shares.iloc[i]):
                color = shades.NEUTRAL if math.isnan(share) else shades.shade(1.0 - share)
                square = Rectangle((j, edges[i]), 1, edges[i + 1] - edges[i], facecolor=color, edgecolor=style.PAPER)
                axes.add_patch(square)
                text = str(told.iloc[i, j])
                axes.text(j + 0.5, y, text, ha="center", va="center", color=shades.ink(color))
            weight = "bold" if bold[i] else "normal"
            axes.text(-0.04 / cell, y, names[i], ha="right", va="center", color=style.INK, weight=weight)
        for j, head in enumerate(heads):
            axes.text(j + 0.5, -0.06, head, rotation=90, ha="center", va="bottom", color=style.INK)
    return drawing


def _edges(names: Sequence[str]) -> NDArray[np.float64]:
    """Return where the lines of these names begin and end, in inches from the first, as float64[n + 1]."""
    return np.cumsum([0.0, *(LINE_HEIGHT * (0.35 + 0.95 * (1 + name.count("\n"))) for name in names)])


def over_views(lines: Sequence[tuple[str, str, pd.DataFrame]], look: Look) -> Drawing:
    """Draw for each variant the time per ray from each view, over the variant's mean; `look` is by variant.

    A line has the variant, its label and its rows. Views with wrong rays have hollow marks.
    """
    labels = [_folded(label) for _, label, _ in lines]
    edges, left = _edges(labels), 0.12 + max(map(_wide, labels))
    middles = (edges[1:] + edges[:-1]) / 2
    with matplotlib.rc_context(SETTINGS):
        drawing, axes = keyed(edges[-1], [], left=left, below=0.42)
        for (variant, _, rows), y in zip(lines, middles, strict=True):
            ratio = rows["us_per_ray"] / rows["us_per_ray"].mean()
            told = look.of(variant) | {"ls": "none", "ms": 3.6}
            wrong = (rows["wrong_rays"].fillna(0) > 0).to_numpy(bool)
            axes.plot([ratio.min(), ratio.max()], [y, y], color=told["color"], lw=0.8)
            axes.plot(ratio[~wrong], np.full((~wrong).sum(), y), **told)
            axes.plot(ratio[wrong], np.full(wrong.sum(), y), **told | {"markerfacecolor": style.PAPER})
        axes.set_yticks(middles, labels)
        axes.set_ylim(edges[-1], 0)
        axes.margins(x=0.1)
        axes.xaxis.set_major_locator(MaxNLocator(4, min_n_ticks=3))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}×"))
        axes.axvline(1.0, color=style.FAINT, lw=0.6, zorder=1)
        drawing.text(0.98, 0.04 / drawing.get_figheight(), "time per ray in the domain, over the mean", ha="right")
    return drawing


def growth(
    curves: Sequence[Any], unit: str, time: str, labels: Mapping[str, str], look: Look, squares: bool
) -> Drawing:
    """Draw the time of each of parts.growth's curves, of one place, against `unit`, with the power law that fits.

    `look` is by variant; `squares` writes a number of pixels as the square of its side.
    """
    entries: list[tuple[Artist, str]] = [
        (_handle(look.of(c.variant)), textwrap.fill(labels[c.variant], 2 * FOLD)) for c in curves
    ]
    with matplotlib.rc_context(SETTINGS):
        drawing, axes = keyed(1.9, entries, left=0.58, below=0.42, right=0.16)
        for curve in curves:
            told = look.of(curve.variant)
            axes.plot(curve.x, curve.ms, **told | {"ls": "none"})
            if isinstance(curve.fit, Power):
                ends = np.array([curve.x.min(), curve.x.max()])
                axes.plot(ends, curve.fit.at(ends), **told | {"marker": "none"})
        every = np.concatenate([curve.x for curve in curves])
        axes.set_xscale("log")
        axes.set_xlim(every.min() / 1.2, every.max() * 1.2)
        show = (lambda x, _: f"{round(x**0.5)}²") if squares else (lambda x, _: f"{x:,.0f}")
        axes.xaxis.set_major_locator(FixedLocator(list(_spaced(sorted(set(every)), show, 2.4))))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(FuncFormatter(show))
        axes.set_yscale("log")
        label_decades(axes.yaxis)
        axes.set_xlabel(unit)
        axes.set_ylabel(time)
    return drawing


def _spaced(ticks: Sequence[float], show: Callable[[float, object], str], inches: float) -> Iterator[float]:
    """Yield of ascending ticks those whose labels do not touch the one before; so many inches lie between the ends."""
    last = -math.inf
    for tick in ticks:
        at = inches * math.log(tick / ticks[0]) / math.log(ticks[-1] / ticks[0])
        half = _wide(show(tick, None)) / 2 + 0.03
        if at - half > last:
            last = at + half
            yield tick
