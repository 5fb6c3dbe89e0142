"""Draw speed against error on one surface: every variant by name, the front, and the harness's floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from numpy.typing import ArrayLike, NDArray

from reports import wording
from reports.analysis import derive, ties
from reports.content import Figure
from reports.drawing import style, tables
from reports.drawing.canvas import NARROW, RC, ErrorAxis, label_decades, series, svg
from reports.drawing.placing import place, text_size
from reports.drawing.style import Mark
from reports.reading.tuples import tuples

TALL, LOW, MANY = 4.9, 3.9, 16  # inches: of a drawing, and of one of more rows, which leave less of the page
LETTER = 7.0  # points
LONGEST = 32  # letters of a name
MOST_NAMED = 24  # marks of one panel
MOST_DRAWN = 400  # marks of one figure, about: of some thousand none could be told from another
WRONG = "#9a4a00"  # the name of a variant that answers rays wrongly


def speed_against_error(
    rows: pd.DataFrame, marks: Mapping[str, Mark], name: str, title: str, focus: str = ""
) -> list[Figure]:
    """Draw one comparison: a figure for each device, with a panel for each precision, and a label at each mark.

    Returns [] for fewer than two rows, which leave nothing to compare. `marks` are by method; `name` begins the
    figures' names. The method or variant `focus` is named first, and in bold.
    """
    shown = derive.contenders(rows)
    shown = shown[shown["error_max"].notna() & np.isfinite(shown["mrays_per_s"]) & (shown["mrays_per_s"] > 0)]
    if len(shown) < 2:
        return []
    figures = []
    for i, device in enumerate(dict.fromkeys(shown["device"])):
        own = shown[shown["device"] == device]
        kept = _most_telling(own, focus)
        drawn, unnamed = _speed_against_error(kept, marks, focus)
        more = f" {wording.plural(unnamed, 'mark')} have no room for a label; the table names all." if unnamed else ""
        if len(kept) < len(own):
            more += (
                f" {len(kept):,} of {wording.plural(len(own), 'row')} are drawn: of each method and precision those on "
                "the front, the fastest, and others spread evenly over its times."
            )
        figures.append(
            Figure(
                f"{name}-{i}",
                drawn,
                f"Scatter plot of speed against largest error on {title}, for {device}.",
                f"{title}, on {device}.",
                _caption(own) + more,
            )
        )
    return figures


def _most_telling(rows: pd.DataFrame, focus: str) -> pd.DataFrame:
    """Return at most about MOST_DRAWN of the rows of one device, in their order; all where there are no more.

    Those on the front, those of the focus's variant, the baseline's and each method's fastest stay. Of the others, each
    method and precision has some, spread evenly over the order of its times.
    """
    if len(rows) <= MOST_DRAWN:
        return rows
    groups = rows.groupby(["precision", "method"], sort=False)
    places, sizes = groups.cumcount(), groups["method"].transform("size")
    each = max(1, MOST_DRAWN // groups.ngroups)
    step = np.ceil(sizes / each).astype("int64")
    kept = (places % step == 0) | rows["front"].astype(bool) | (rows["variant"] == focus)
    return rows[kept | (rows["variant"] == rows["baseline"])]


def _speed_against_error(shown: pd.DataFrame, marks: Mapping[str, Mark], focus: str) -> tuple[str, int]:
    """Draw the panels of one device, side by side; return SVG text and how many marks have no label."""
    precisions = sorted(set(shown["precision"]))
    several = len(precisions) > 1
    left, right, below, above, between = 0.55, 0.06, 0.46, 0.24 if several else 0.06, 0.12  # inches
    wide = (NARROW - left - right - between * (len(precisions) - 1)) / len(precisions)
    height = TALL if len(shown) <= MANY else LOW
    high = height - below - above
    limits = float(shown["mrays_per_s"].min()) / 1.8, float(shown["mrays_per_s"].max()) * 1.8
    unnamed = 0
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(NARROW, height))
        for i, precision in enumerate(precisions):
            corner = (left + i * (wide + between)) / NARROW, below / height
            axes = drawing.add_axes((*corner, wide / NARROW, high / height))
            group = shown[shown["precision"] == precision]
            axis = ErrorAxis.of(group["error_max"])
            axis.dress(axes)
            axes.set_yscale("log")
            axes.set_ylim(*limits)
            label_decades(axes.yaxis)
            if several:
                axes.set_title(precision, color=style.INK)
            if i:
                axes.tick_params(labelleft=False)
            unnamed += _draw_group(axes, group, axis, marks, focus, (72 * wide, 72 * high))
        drawing.supxlabel(
            "more exact  ←  largest error |t − t*| away from silhouettes, scene units",
            y=0.11 / height,
            va="center",
            fontsize=7.5,
        )
        drawing.supylabel("Mrays/s  →  faster", x=0.1 / NARROW, ha="center", fontsize=7.5)
        return svg(drawing), unnamed


def _draw_group(
    axes: Axes,
    group: pd.DataFrame,
    axis: ErrorAxis,
    marks: Mapping[str, Mark],
    focus: str,
    size: tuple[float, float],
) -> int:
    """Draw one panel of `size` points: the rows of one device and precision, their front, where rows are floor-bound.

    Returns how many marks have no label.
    """
    x = pd.Series(axis.position(group["error_max"]), group.index)
    y = group["mrays_per_s"]
    low, high = y * group["median_ms"] / group["upper_ms"], y * group["median_ms"] / group["lower_ms"]
    right = derive.all_right(group)
    panel, joined = _Panel(axes, size), []
    for method, rows in x.sort_index().groupby(group["method"]):  # a line joins a method's settings in the plan's order
        names = group["variant"][rows.index]
        color = marks[str(method)].color
        look: dict[str, Any] = {"color": color, "marker": marks[str(method)].marker, "ms": 5.5, "mew": 1.0, "zorder": 4}
        ends = low[rows.index], high[rows.index]
        axes.vlines(rows, *ends, color=color, lw=0.8, zorder=3, gid=series(str(method)))
        axes.plot(rows, y[rows.index], lw=0.5, gid=series(str(method), *names), **look)
        joined.append(panel.points(rows, y[rows.index]))
        hollow = rows[~right[rows.index]]
        if len(hollow):
            own = series(str(method), *names[hollow.index])
            axes.plot(hollow, y[hollow.index], lw=0, markerfacecolor=style.PAPER, gid=own, **look)
    notes = [*joined, *_front(panel, x[group["front"].astype(bool)].sort_values(), y), *_floor(panel, group)]
    return _labels(panel, group.assign(x=x, right=right), focus, notes)


@dataclass(frozen=True, eq=False)
class _Panel:
    """Hold the axes of a panel, whose limits are set, and its size in points."""

    axes: Axes
    size: tuple[float, float]

    def points(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Return where positions x [n] and speeds y [n] are, in points from the lower left corner, as float64[n, 2]."""
        (x0, x1), (y0, y1) = self.axes.get_xlim(), np.log10(self.axes.get_ylim())
        across = (np.asarray(x, np.float64) - x0) / (x1 - x0) * self.size[0]
        up = (np.log10(np.asarray(y, np.float64)) - y0) / (y1 - y0) * self.size[1]
        return np.stack([across, up], axis=-1)

    def write(self, x: float, y: float, text: str, **look: Any) -> None:
        """Write a text whose left end and middle are at a point."""
        at: dict[str, Any] = {"transform": self.axes.transAxes, "va": "center", "fontsize": LETTER, "zorder": 6}
        self.axes.text(x / self.size[0], y / self.size[1], text, **at, **look)


def _front(panel: _Panel, front: pd.Series, speeds: pd.Series) -> list[NDArray[np.float64]]:
    """Draw the front, and name it at its right end; return what labels had better not stand on, as lines of points.

    `front` are the positions of its rows, the most exact first, `speeds` those of all rows.
    """
    if front.empty:
        return []
    # the line goes down from the most exact row and right from the fastest: what lies there is beaten
    y = speeds[front.index]
    edge_x, edge_y = np.r_[front.iloc[0], front, front.iloc[-1] + 99], np.r_[y.iloc[0] * 1e-9, y, y.iloc[-1]]
    panel.axes.step(edge_x, edge_y, where="post", color=style.INK, lw=0.8, zorder=2)
    drawn = panel.points(edge_x, edge_y)
    corners = np.stack([np.c_[drawn[1:, 0], drawn[:-1, 1]], drawn[1:]], axis=1).reshape(-1, 2)
    outline = np.clip(np.concatenate([drawn[:1], corners]), 0.0, panel.size)
    wide, _ = text_size("Pareto front", LETTER)
    at = panel.size[0] - wide - 4.0, float(drawn[-1, 1]) + 0.8 * LETTER
    panel.write(*at, "Pareto front", color=style.INK, style="italic")
    return [outline, _beneath(*at, wide)]


def _floor(panel: _Panel, group: pd.DataFrame) -> list[NDArray[np.float64]]:
    """Hatch where rows are floor-bound, and say so; return what labels had better not stand on."""
    floor = group["floor_ms"].iloc[0]
    if not floor > 0:
        return []
    rays_per_ms = group["mrays_per_s"].iloc[0] * group["median_ms"].iloc[0]
    bound = rays_per_ms / (derive.FLOOR_FACTOR * floor)
    hatched: dict[str, Any] = {
        "facecolor": "none",
        "edgecolor": style.HAIRLINE,
        "hatch": "////",
        "linewidth": 0,
        "zorder": 0.5,
    }
    panel.axes.axhspan(bound, 1e3 * bound, **hatched)
    height = float(panel.points(0.0, bound)[1]) + 0.8 * LETTER
    if height > panel.size[1] - 0.5 * LETTER:
        return []
    told = f"floor-bound: under {derive.FLOOR_FACTOR:g} times the harness's own time"
    paper = {"facecolor": style.PAPER, "edgecolor": "none", "pad": 1.0}
    panel.write(4.0, height, told, color=style.INK, style="italic", bbox=paper)
    return [_beneath(4.0, height, text_size(told, LETTER)[0])]


def _beneath(x: float, y: float, wide: float) -> NDArray[np.float64]:
    """Return the line [2, 2] along which a text stands."""
    return np.array([[x, y], [x + wide, y]])


def _labels(panel: _Panel, rows: pd.DataFrame, focus: str, lines: Sequence[NDArray[np.float64]]) -> int:
    """Name each mark: those on the front first, then the right ones, the fastest first; return how many are left out.

    `rows` have the columns x, their position, and right.
    """
    own = (rows["method"] == focus) | (rows["variant"] == focus)
    ordered = rows.assign(late=~own, beaten=~rows["front"].astype(bool), wrong=~rows["right"])
    ordered = ordered.sort_values(["late", "beaten", "wrong", "median_ms"], kind="stable")
    marks = panel.points(ordered["x"], ordered["mrays_per_s"])
    ordered = ordered[["label", "wrong_rays", "right", "late", "beaten"]].head(MOST_NAMED)
    told = [_label(row) for row in tuples(ordered)]
    bold = [not row.beaten or not row.late for row in tuples(ordered)]
    sizes = [text_size(text, LETTER, heavy) for text, heavy in zip(told, bold, strict=True)]
    area = (2.0, 2.0, panel.size[0] - 2.0, panel.size[1] - 2.0)
    at, others = marks[: len(ordered)], marks[len(ordered) :]
    places = place(at, sizes, area, radius=3.4, marks=others, lines=lines)
    for text, heavy, right, found in zip(told, bold, ordered["right"], places, strict=True):
        if found is None:
            continue
        color = style.INK if right else WRONG
        panel.write(found.x, found.y + LETTER / 2, text, color=color, weight="bold" if heavy else "normal")
        if found.leader is not None:
            x0, y0, x1, y1 = found.leader
            ends = (np.array([x0, x1]) / panel.size[0], np.array([y0, y1]) / panel.size[1])
            panel.axes.plot(*ends, transform=panel.axes.transAxes, color=style.FAINT, lw=0.4, zorder=3)
    return sum(found is None for found in places) + len(others)


def _label(row: Any) -> str:
    """Write a row's name, and how many of its rays are wrong."""
    name = wording.excerpt(str(row.label), LONGEST)
    return name if row.right else f"{name}: {wording.count(row.wrong_rays)} wrong"


def _caption(shown: pd.DataFrame) -> str:
    """Say how to read the figure, and what the largest gain over the baseline in it is."""
    baseline = tables.baseline(shown)
    told = shown[["device", "precision", "label", "speedup", "error_max", "floor_ms", "floor_bound", *ties.COLUMNS]]
    over = {(row.device, row.precision): row for row in tuples(derive.baseline_rows(shown))}
    gains = [
        gaining
        for gaining in tuples(told[told["speedup"] > 1.0].sort_values("speedup", ascending=False))
        if (beaten := over.get((gaining.device, gaining.precision))) is not None and ties.is_slower(beaten, gaining)
    ]
    row = next((gaining for gaining in gains if not gaining.floor_bound), None)
    bound = sum(bool(gaining.floor_bound) for gaining in gains)
    seen = f" {baseline} answers some rays wrongly here or was not timed, so that no gain over it is told."
    if row is not None:
        seen = (
            f" The largest gain with no wrong ray: {row.label} in {row.precision}, "
            f"{wording.factor(row.speedup)} as fast as {baseline}, at a largest error of "
            f"{wording.error(row.error_max)} scene units{_of_floor(row)}."
        )
    elif bound:
        seen = f" Every gain over {baseline} is floor-bound here, so that none is told as the largest."
    elif over:
        seen = f" No variant that is told to be faster than {baseline} answers every ray rightly here."
    if row is not None and bound:
        seen += f" {wording.plural(bound, 'floor-bound row')} left out: there the harness is measured more."
    exact = int((shown["error_max"] == 0).sum())
    stand = "stands" if exact == 1 else "stand"
    zeros = (
        f" {wording.plural(exact, 'row')} with an error of 0 {stand} left of the break. {wording.ZERO}" if exact else ""
    )
    return (
        "What lies below and right of the black line is beaten in speed and in exactness. Hollow marks answer some "
        f"rays wrongly and cannot be on it; bars are 95 % intervals of the median.{zeros}{seen}"
    )


def _of_floor(row: Any) -> str:
    """Write how much of a row's time is the harness's floor."""
    if wording.absent(row.floor_ms):
        return "; the harness's floor was not measured there"
    return f"; of its {wording.number(row.median_ms)} ms the harness's floor is {wording.number(row.floor_ms)} ms"
