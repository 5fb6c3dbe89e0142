"""Draw speed against error as small multiples: a panel for each surface, and each method's name beside its marks."""

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
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports import wording
from reports.analysis import choices, derive
from reports.analysis.choices import ERRORS, Choice
from reports.content import Figure
from reports.drawing import placing, style
from reports.drawing.canvas import NARROW, RC, ErrorAxis, series, svg
from reports.drawing.style import Mark
from reports.reading.tuples import tuples

TEXT = 7.0  # points
RADIUS = 3.0  # of a mark, points
_RIGHT, _TOP, _BOTTOM = 0.02, 0.17, 0.30  # inches around the panels
_NAME, _TICK = 0.17, 0.07  # inches left of the panels: what the axis is, and ticks; the times stand between them
_BETWEEN = 0.10, 0.21  # inches between panels, beside and above each other
MOST = 9  # panels


def figure(found: Sequence[Choice], marks: Mapping[str, Mark], height: float, focus: str = "") -> Figure | None:
    """Draw a panel for each of these choices, at most MOST; None where there is nothing to compare.

    `marks` are by method, `height` is in inches, and `focus` is the method that the report is about.
    """
    rows = [_drawn(choice) for choice in found]
    if not 0 < len(found) <= MOST or sum(map(len, rows)) < 2:
        return None
    every = pd.concat(rows)
    drawing, unnamed = _drawing(found, rows, marks, height, focus, {})
    if unnamed:
        drawing, _ = _drawing(found, rows, marks, height, focus, unnamed)
    with matplotlib.rc_context(RC):
        drawn = svg(drawing)
    return Figure("multiples", drawn, _description(found), "Speed against error.", _caption(every))


def _drawing(
    found: Sequence[Choice],
    rows: Sequence[pd.DataFrame],
    marks: Mapping[str, Mark],
    height: float,
    focus: str,
    key: Mapping[str, str],
) -> tuple[Drawing, dict[str, str]]:
    """Draw all panels, above a key of the methods `key`; return also the methods whose names found no place."""
    every = pd.concat(rows)
    left = _left(every["median_ms"])
    lines = _key_lines(list(key.values()), left)
    below = 0.14 * len(set(line for line, _ in lines))
    scales = _Scales.of(every, len(found), height, below, left)
    unnamed: dict[str, str] = {}
    with matplotlib.rc_context({**RC, "font.size": TEXT, "axes.titlesize": 7.6}):
        drawing = Drawing(figsize=(NARROW, height))
        for at, (choice, own) in enumerate(zip(found, rows, strict=True)):
            unnamed |= _panel(drawing, at, at + scales.across >= len(found), choice, own, scales, marks, focus)
        for (method, label), (line, x) in zip(key.items(), lines, strict=True):
            y, mark = (below - 0.14 * line - 0.07) / height, marks[method]
            size: dict[str, Any] = {"ms": 2 * RADIUS - 1, "transform": drawing.transFigure}
            drawing.add_artist(Line2D([(x + 0.06) / NARROW], [y], color=mark.color, marker=mark.marker, lw=0, **size))
            drawing.text((x + 0.15) / NARROW, y, label, va="center", fontsize=TEXT, gid=series(method))
        drawing.text(0.5, (below + 0.03) / height, _X_LABEL, ha="center", va="bottom", fontsize=TEXT)
        drawing.text(0.03 / NARROW, 0.5, _Y_LABEL, ha="left", va="center", rotation=90, fontsize=TEXT)
    return drawing, unnamed


def _limits(ms: pd.Series) -> tuple[float, float]:
    """Return the ends of the axis of these times."""
    return float(ms.min()) / 1.7, float(ms.max()) * 1.7


def _left(ms: pd.Series) -> float:
    """Return how much room the labels of these times take on the left of the panels, in inches."""
    widths = [placing.text_size(_time(tick), TEXT)[0] / 72 for tick in _ticks(*_limits(ms))]
    return _NAME + _TICK + max(widths, default=0.0)


def _time(ms: float) -> str:
    """Write the label of a tick."""
    return f"{ms:,.0f}" if ms >= 1 else f"{ms:g}"


def _key_lines(labels: Sequence[str], left: float) -> list[tuple[int, float]]:
    """Return the line of each label of the key, which begins at `left`, and where on it, in inches."""
    found, line, x = [], 0, left
    for label in labels:
        width = 0.3 + placing.text_size(label, TEXT)[0] / 72
        if x + width > NARROW and x > left:
            line, x = line + 1, left
        found.append((line, x))
        x += width
    return found


_Y_LABEL = "ms a frame, faster is up"
_X_LABEL = "largest error over the scene's radius, more exact is left"


def _drawn(choice: Choice) -> pd.DataFrame:
    """Select the rows that have a place, fastest first, with the column `name` of what they belong to.

    They are those in the precision of most rows, and winners in others.
    """
    main = choices.precision_of(choice.rows)
    rows = choice.rows[choice.rows["relative_error_max"].notna() & np.isfinite(choice.rows["relative_error_max"])]
    winners = [row.Index for row in choice.within if row is not None]
    rows = rows[(rows["precision"] == main) | rows.index.isin(winners)]
    named = rows["method_label"] + np.where(rows["prepass"] == "beams", " behind beams", "")
    named = named + np.where(rows["precision"] == main, "", ", " + rows["precision"])
    return rows.assign(name=named).sort_values("median_ms", kind="stable")


@dataclass(frozen=True)
class _Scales:
    """Hold what all panels share: their grid, their size in inches, and both axes."""

    across: int
    down: int
    width: float
    height: float
    whole: float  # height of the drawing
    error: ErrorAxis
    zero: bool  # some error is 0
    ms: tuple[float, float]  # shortest and longest time
    left: float  # inches left of the panels

    @classmethod
    def of(cls, rows: pd.DataFrame, panels: int, height: float, below: float, left: float) -> _Scales:
        """Lay out so many panels in a drawing of this height, with room `below` and `left` of them."""
        across = panels if panels < 4 else 2 if panels == 4 else 3
        down = -(-panels // across)
        width = (NARROW - left - _RIGHT - (across - 1) * _BETWEEN[0]) / across
        each = (height - below - _BOTTOM - down * _TOP - (down - 1) * (_BETWEEN[1] - _TOP)) / down
        errors = rows["relative_error_max"]
        zero, ms = bool((errors == 0).any()), _limits(rows["median_ms"])
        return cls(across, down, width, each, height, ErrorAxis.of(errors), zero, ms, left)

    def box(self, at: int) -> tuple[float, float, float, float]:
        """Return left, bottom, width and height of a panel, as shares of the drawing."""
        column, line = at % self.across, at // self.across
        left = self.left + column * (self.width + _BETWEEN[0])
        top = self.whole - _TOP - line * (self.height + _BETWEEN[1])
        return left / NARROW, (top - self.height) / self.whole, self.width / NARROW, self.height / self.whole

    def points(self, axes: Axes, x: Any, y: Any) -> Any:
        """Return places in points from the panel's lower left corner, as float64[n, 2]."""
        low, high = axes.get_xlim()
        across = (np.asarray(x, float) - low) / (high - low)
        up = np.log(self.ms[1] / np.asarray(y, float)) / math.log(self.ms[1] / self.ms[0])
        return np.stack([across * self.width, up * self.height], axis=1) * 72.0


def _panel(
    drawing: Drawing,
    at: int,
    lowest: bool,
    choice: Choice,
    rows: pd.DataFrame,
    scales: _Scales,
    marks: Mapping[str, Mark],
    focus: str,
) -> dict[str, str]:
    """Draw one panel, which is the `lowest` of its column or not; return the methods whose names found no place."""
    axes = drawing.add_axes(scales.box(at))
    axes.set_title(choice.name, color=style.INK, loc="left", pad=3)
    axes.set_yscale("log")
    axes.set_ylim(scales.ms[1], scales.ms[0])
    axes.yaxis.set_major_locator(FixedLocator(_ticks(*scales.ms)))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: _time(value)))
    scales.error.dress(axes, zero=scales.zero)
    axes.tick_params(labelleft=at % scales.across == 0, length=2, pad=1.5)
    axes.tick_params(axis="x", labelbottom=lowest)
    for error in ERRORS:
        axes.axvline(math.log10(error), color=style.FAINT, lw=0.6, ls=(0, (3, 2)), zorder=1)
    if rows.empty:
        return {}
    floor = derive.FLOOR_FACTOR * float(rows["floor_ms"].iloc[0])
    if floor > scales.ms[0]:
        axes.axhspan(scales.ms[0], floor, facecolor="none", edgecolor=style.HAIRLINE, hatch="////", lw=0, zorder=0.5)
    x = pd.Series(scales.error.position(rows["relative_error_max"]), rows.index)
    for (_, method), own in rows.groupby(["name", "method"], sort=False):
        _marks(axes, x[own.index], own, marks[str(method)], str(method), focus)
    edge = _front(rows, x, scales)
    axes.plot(*edge.T, color=style.INK, lw=0.9, zorder=2)
    return _names(axes, choice, rows, x, scales, marks, edge, focus)


def _marks(axes: Axes, x: pd.Series, rows: pd.DataFrame, mark: Mark, method: str, focus: str) -> None:
    """Draw the marks of one method, joined in the plan's order; hollow where rays are wrong."""
    size = 2 * RADIUS - 1 + (1.5 if method == focus else 0.0)
    look: dict[str, Any] = {"color": mark.color, "marker": mark.marker, "ms": size, "mew": 0.9}
    rows = rows.sort_index()
    gid = series(method, *rows["variant"])
    axes.plot(x[rows.index], rows["median_ms"], lw=0.6, zorder=4, gid=gid, **look)
    wrong = rows[~derive.all_right(rows)]
    if len(wrong):
        own = series(method, *wrong["variant"])
        axes.plot(x[wrong.index], wrong["median_ms"], lw=0, zorder=4, markerfacecolor=style.PAPER, gid=own, **look)


def _front(rows: pd.DataFrame, x: pd.Series, scales: _Scales) -> Any:
    """Return the Pareto front of the rows with every ray right as a line, float64[k, 2] of places on the axes."""
    right = rows[derive.all_right(rows)]
    kept = right[right["relative_error_max"] < right["relative_error_max"].cummin().shift(fill_value=math.inf)]
    if kept.empty:
        return np.zeros((0, 2))
    line = [(99.0, float(kept["median_ms"].iloc[0]))]
    for place, ms in zip(x[kept.index], kept["median_ms"], strict=True):
        line += [(line[-1][0], float(ms)), (float(place), float(ms))]
    line.append((line[-1][0], scales.ms[1] * 2))
    return np.asarray(line[1:])


def _names(
    axes: Axes,
    choice: Choice,
    rows: pd.DataFrame,
    x: pd.Series,
    scales: _Scales,
    marks: Mapping[str, Mark],
    edge: Any,
    focus: str,
) -> dict[str, str]:
    """Write each method's name beside one of its marks; return those that found no place."""
    winners = [row.Index for row in choice.within if row is not None]
    rows = rows.assign(order=[winners.index(i) if i in winners else 9 for i in rows.index])
    rows["order"] += 10 * ~derive.all_right(rows) + 5 * ~rows["front"].astype(bool)
    rows["order"] -= 100 * (rows["method"] == focus)
    named = rows.sort_values(["order", "median_ms"], kind="stable").drop_duplicates("name")
    bold = named.index.isin(winners) | (named["method"] == focus)
    sizes = [placing.text_size(text, TEXT, heavy) for text, heavy in zip(named["name"], bold, strict=True)]
    every = scales.points(axes, x[rows.index], rows["median_ms"])
    at = scales.points(axes, x[named.index], named["median_ms"])
    lines = [scales.points(axes, np.clip(edge[:, 0], *axes.get_xlim()), np.clip(edge[:, 1], *scales.ms))]
    joined = [own.sort_index() for _, own in rows.groupby("name") if len(own) > 1]
    lines += [scales.points(axes, x[own.index], own["median_ms"]) for own in joined]
    area = (1.0, 1.0, scales.width * 72 - 1, scales.height * 72 - 1)
    places = placing.place(at, sizes, area, radius=RADIUS + 0.5, marks=every, lines=lines)
    left: dict[str, str] = {}
    whole = np.asarray([scales.width, scales.height]) * 72
    for row, place, heavy, (_, height) in zip(tuples(named), places, bold, sizes, strict=True):
        if place is None:
            left[str(row.method)] = str(row.method_label)
            continue
        color = _readable(marks[str(row.method)].color)
        gid = series(str(row.method), str(row.variant))
        axes.text(
            place.x / whole[0],
            (place.y + 0.22 * height) / whole[1],
            str(row.name),
            transform=axes.transAxes,
            color=color,
            fontsize=TEXT,
            fontweight="bold" if heavy else "normal",
            zorder=6,
            gid=gid,
            bbox={"facecolor": style.PAPER, "alpha": 0.75, "linewidth": 0, "pad": 0.2},
        )
        if place.leader is not None:
            ends = np.asarray(place.leader).reshape(2, 2) / whole
            axes.plot(*ends.T, transform=axes.transAxes, color=color, lw=0.5, zorder=3, gid=gid)
    return left


def _readable(color: str) -> str:
    """Return a colour dark enough for text on white."""
    parts = [int(color[i : i + 2], 16) for i in (1, 3, 5)]
    light = (0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]) / 255
    share = min(1.0, 0.45 / light) if light > 0 else 1.0
    return "#" + "".join(f"{round(part * share):02x}" for part in parts)


def _ticks(low: float, high: float) -> list[float]:
    """Return times to label between two times: each decade, with its 2 and 5 where there are less than two."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    steps = (1.0, 2.0, 5.0) if high / low < 60 else (1.0,)
    return [step * 10.0**decade for decade in decades for step in steps if low <= step * 10.0**decade <= high]


def _caption(rows: pd.DataFrame) -> str:
    """Say how to read the figure."""
    told = "Up is faster, left is more exact. The black line is the Pareto front: what lies below and right of it is "
    told += "beaten in both."
    if rows["precision"].nunique() > 1:
        told += f" In {choices.precision_of(rows)} where no other precision is named."
    told += " Marks that a line joins are settings of one method."
    if (~derive.all_right(rows)).any():
        told += " Hollow marks answer some rays wrongly."
    if (derive.FLOOR_FACTOR * rows["floor_ms"] > rows["median_ms"].min() / 1.7).any():
        told += " Hatched: mostly the harness's own time."
    levels = wording.listed([wording.level(error) for error in ERRORS])
    return f"{told} Dashed: errors of {levels} of the radius.{wording.zeros(rows['error_max'])}"


def _description(found: Sequence[choices.Choice]) -> str:
    """Describe the figure for those who cannot see it."""
    each = []
    for choice in found:
        best = choice.best
        each.append(
            f"{choice.name}: every variant answers some rays wrongly"
            if best is None
            else f"{choice.name}: {best.label} in {wording.number(best.median_ms)} ms"
        )
    return f"Scatter plots of speed against largest error, one for each surface. {'. '.join(each)}."
