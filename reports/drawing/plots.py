"""Draw speed against error, the overview of the first page, and the legend of pictures of errors."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter

from reports import wording
from reports.analysis import derive, ties
from reports.content import Figure
from reports.drawing import style
from reports.drawing.canvas import NARROW, RC, WIDE, ErrorAxis, Key, label_decades, series, svg
from reports.drawing.style import Mark

PANELS_ACROSS = 5  # devices in one figure


def speed_against_error(rows: pd.DataFrame, marks: Mapping[str, Mark], name: str, title: str) -> list[Figure]:
    """Draw one comparison: a panel for each device and precision, PANELS_ACROSS devices to a figure.

    Returns [] for fewer than two rows, which leave nothing to compare. `marks` are by method; `name` begins the
    figures' names.
    """
    shown = derive.contenders(rows)
    shown = shown[shown["error_max"].notna() & np.isfinite(shown["mrays_per_s"]) & (shown["mrays_per_s"] > 0)]
    if len(shown) < 2:
        return []
    devices = list(dict.fromkeys(shown["device"]))
    batches = [devices[i : i + PANELS_ACROSS] for i in range(0, len(devices), PANELS_ACROSS)]
    return [
        Figure(
            f"{name}-{i}",
            _speed_against_error(shown[shown["device"].isin(batch)], batch, marks),
            f"Scatter plots of speed against largest error on {title}, one for each of {', '.join(batch)}.",
            f"{title}.",
            _caption(shown[shown["device"].isin(batch)]),
        )
        for i, batch in enumerate(batches)
    ]


def overview(frame: pd.DataFrame, marks: Mapping[str, Mark], titles: Mapping[str, str]) -> Figure | None:
    """Draw the speed of each method's fastest variant with no wrong ray, scene by scene.

    `marks` are by method, `titles` by comparison. Returns None where there is nothing to draw, or where there are more
    devices than PANELS_ACROSS.
    """
    rows = derive.contenders(frame)
    rows = rows[derive.all_right(rows) & np.isfinite(rows["mrays_per_s"])].drop_duplicates([*derive.GROUP, "method"])
    devices, precisions = sorted(set(rows["device"])), sorted(set(rows["precision"]))
    scenes = [name for name in titles if name in set(rows["comparison"])]
    if rows.empty or len(devices) > PANELS_ACROSS:
        return None
    width, height = NARROW, 0.8 + (0.2 + 0.2 * len(scenes)) * len(precisions)
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(width, height), layout="constrained")
        panels = drawing.subplots(len(precisions), len(devices), sharex=True, sharey=True, squeeze=False)
        for (device, precision), group in rows.groupby(["device", "precision"]):
            axes = panels[precisions.index(precision), devices.index(device)]
            for method, own in group.groupby("method"):
                mark = marks[str(method)]
                places = own["comparison"].map(scenes.index)
                look = {"color": mark.color, "marker": mark.marker, "ms": 4.5, "lw": 0}
                axes.plot(own["mrays_per_s"], places, gid=series(str(method), *own["variant"]), **look)
        for axes, device in zip(panels[0], devices, strict=True):
            axes.set_title(device, color=style.INK)
        for axes, precision in zip(panels[:, 0], precisions, strict=True):
            axes.set_ylabel(precision)
        first = panels[0, 0]
        first.set_yticks(range(len(scenes)), [titles[name] for name in scenes])
        first.set_ylim(len(scenes) - 0.5, -0.5)
        first.set_xscale("log")
        first.set_xlim(rows["mrays_per_s"].min() / 2, rows["mrays_per_s"].max() * 2)
        label_decades(first.xaxis, few=True)
        drawing.supxlabel("Mrays/s", fontsize=6.5)
        handles = [Line2D([], [], color=marks[m].color, marker=marks[m].marker, ms=4.5, lw=0) for m in _methods(rows)]
        drawing.legend(handles, _methods(rows), loc="outside upper center", ncols=9)
        drawn = svg(drawing)
    return Figure(
        "overview",
        drawn,
        f"Speed of each method on {', '.join(titles.values())}, for {', '.join(devices)}.",
        "How fast each method is.",
        "Its fastest variant among those with no wrong ray, on a logarithmic axis: right is faster. A method without a "
        f"mark has no such variant there.{_bound_marks(rows)}",
    )


def _bound_marks(rows: pd.DataFrame) -> str:
    """Say how many marks are floor-bound; "" for none."""
    bound = int(rows["floor_bound"].sum())
    return (
        f" Of {len(rows)} marks {bound} are floor-bound: under {derive.FLOOR_FACTOR:g} times the time of the harness "
        "itself."
        if bound
        else ""
    )


def _methods(rows: pd.DataFrame) -> list[str]:
    """Return the names of the methods of `rows`, sorted."""
    return sorted(set(rows["method"]))


def _speed_against_error(shown: pd.DataFrame, devices: Sequence[str], marks: Mapping[str, Mark]) -> str:
    """Draw the panels of these devices; returns SVG text."""
    precisions = sorted(set(shown["precision"]))
    axis = ErrorAxis.of(shown["error_max"])
    alone = len(devices) == 1  # the panels of one device are beside each other
    columns, lines = (len(precisions), 1) if alone else (len(devices), len(precisions))
    width = min(WIDE, 0.7 + 3.2 * columns)
    key = Key(*_key(shown, marks), width)
    height = key.height + 0.76 + (1.75 if alone else 2.35 * lines)
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(width, height))
        panels = drawing.subplots(lines, columns, sharex=True, sharey=True, squeeze=False)
        # margins in inches: left for speeds, below for errors, above for the key; automatic layout takes longer
        above = key.height + 0.26
        drawing.subplots_adjust(0.55 / width, 0.5 / height, 1 - 0.08 / width, 1 - above / height, 0.06, 0.16)
        for i, precision in enumerate(precisions):
            for j, device in enumerate(devices):
                axes = panels[j, i] if alone else panels[i, j]
                group = shown[(shown["device"] == device) & (shown["precision"] == precision)]
                axes.set_title(f"{device}  {precision}", color=style.INK)
                axis.dress(axes)
                _draw_group(axes, group, axis, marks)
        panels[0, 0].set_yscale("log")
        panels[0, 0].set_ylim(shown["mrays_per_s"].min() / 2, shown["mrays_per_s"].max() * 2)
        label_decades(panels[0, 0].yaxis)
        drawing.supxlabel("largest error |t − t*|, scene units", y=0.12 / height, va="center", fontsize=6.5)
        drawing.supylabel("Mrays/s", x=0.1 / width, ha="center", fontsize=6.5)
        key.draw(drawing)
        return svg(drawing)


def _draw_group(axes: Axes, group: pd.DataFrame, axis: ErrorAxis, marks: Mapping[str, Mark]) -> None:
    """Draw one panel: the rows of one device and precision, their front, and where rows are floor-bound."""
    if group.empty:
        axes.text(0.5, 0.5, "no result", transform=axes.transAxes, ha="center", va="center", color=style.FAINT)
        return
    floor = group["floor_ms"].iloc[0]
    if floor > 0:
        rays_per_ms = group["mrays_per_s"].iloc[0] * group["median_ms"].iloc[0]
        bound = rays_per_ms / (derive.FLOOR_FACTOR * floor)
        axes.axhspan(
            bound, 1e3 * bound, facecolor="none", edgecolor=style.HAIRLINE, hatch="////", linewidth=0, zorder=0.5
        )
    x = pd.Series(axis.position(group["error_max"]), group.index)
    y = group["mrays_per_s"]
    low, high = y * group["median_ms"] / group["upper_ms"], y * group["median_ms"] / group["lower_ms"]
    right = derive.all_right(group)
    for method, rows in x.sort_index().groupby(group["method"]):  # a line joins a method's settings in the plan's order
        mark = marks[str(method)]
        look: dict[str, Any] = {"color": mark.color, "marker": mark.marker, "ms": 4.5, "mew": 0.9, "zorder": 4}
        names = group["variant"][rows.index]
        ends = low[rows.index], high[rows.index]
        axes.vlines(rows, *ends, color=mark.color, lw=0.8, zorder=3, gid=series(str(method)))
        axes.plot(rows, y[rows.index], lw=0.5, gid=series(str(method), *names), **look)
        hollow = rows[~right[rows.index]]
        if len(hollow):
            own = series(str(method), *names[hollow.index])
            axes.plot(hollow, y[hollow.index], lw=0, markerfacecolor=style.PAPER, gid=own, **look)
    front = x[group["front"].astype(bool)].sort_values()
    if len(front):  # the line goes down from the most exact row and right from the fastest: what lies there is beaten
        ends, speeds = (front.iloc[0], front.iloc[-1] + 99), y[front.index]
        edge_x, edge_y = np.r_[ends[0], front, ends[1]], np.r_[speeds.iloc[0] * 1e-9, speeds, speeds.iloc[-1]]
        axes.step(edge_x, edge_y, where="post", color=style.INK, lw=0.8, zorder=2)


def _key(shown: pd.DataFrame, marks: Mapping[str, Mark]) -> tuple[list[Artist], list[str]]:
    """Return the handles and labels of the key."""
    entries: list[tuple[Artist, str]] = [
        (Line2D([], [], color=marks[m].color, marker=marks[m].marker, markersize=4.5, lw=0.5), m)
        for m in _methods(shown)
    ]
    hollow = Line2D([], [], color=style.INK, marker="o", markerfacecolor=style.PAPER, markersize=4.5, lw=0)
    entries.append((hollow, "hollow: some rays wrong"))
    entries.append((Line2D([], [], color=style.INK, lw=0.8), "Pareto front"))
    if shown["floor_ms"].notna().any():
        entries.append((Patch(facecolor="none", edgecolor=style.FAINT, hatch="////", linewidth=0), "floor-bound"))
    handles, labels = zip(*entries, strict=True)
    return list(handles), list(labels)


def _caption(shown: pd.DataFrame) -> str:
    """Say how to read the figure, and what the largest gain over the baseline in it is."""
    baseline = derive.baseline_of(shown)
    over = {(row.device, row.precision): row for row in derive.baseline_rows(shown).itertuples()}
    gains = [
        gaining
        for gaining in shown[shown["speedup"] > 1.0].sort_values("speedup", ascending=False).itertuples()
        if (beaten := over.get((gaining.device, gaining.precision))) is not None and ties.is_slower(beaten, gaining)
    ]
    row = next((gaining for gaining in gains if not gaining.floor_bound), None)
    bound = sum(bool(gaining.floor_bound) for gaining in gains)
    seen = f" {baseline} answers some rays wrongly here or was not timed, so that no gain over it is told."
    if row is not None:
        seen = (
            f" The largest gain with no wrong ray: {row.variant} on {row.device} in {row.precision}, "
            f"{wording.factor(row.speedup)} as fast as {baseline}, at a largest error of "
            f"{wording.error(row.error_max)} scene units{_floor(row)}."
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
        "Up is faster, left is more exact; what lies below and right of the black line is beaten in both. "
        f"Hollow marks answer some rays wrongly and cannot be on the front.{zeros}{seen}"
    )


def _floor(row: Any) -> str:
    """Write how much of a row's time is the harness's floor."""
    if wording.absent(row.floor_ms):
        return "; the harness's floor was not measured there"
    return f"; of its {wording.number(row.median_ms)} ms the harness's floor is {wording.number(row.floor_ms)} ms"


def error_legend(lowest: int, highest: int) -> Figure:
    """Draw the legend of pictures of errors: the colour scale between two decades, and the kinds of wrong rays."""
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(6.8, 0.42))
        bar = drawing.add_axes((0.03, 0.6, 0.29, 0.36))
        bar.imshow(np.linspace(0, 1, 256)[None, :], aspect="auto", cmap=style.ERROR_MAP, extent=(lowest, highest, 0, 1))
        bar.set_yticks([])
        bar.grid(visible=False)
        bar.xaxis.set_major_locator(FixedLocator(range(lowest, highest + 1, max(1, math.ceil((highest - lowest) / 6)))))
        bar.xaxis.set_major_formatter(FuncFormatter(lambda x, _: wording.power_of_ten(round(x))))
        patches = [(style.EXACT, "0"), *((c.color, c.title) for c in style.WRONG), (style.UNDECIDED, "undecided")]
        handles = [Patch(facecolor=color, edgecolor=style.FAINT, linewidth=0.3) for color, _ in patches]
        labels = [label for _, label in patches]
        spacing = {"handlelength": 1.1, "columnspacing": 1.2, "handletextpad": 0.5}
        drawing.legend(handles, labels, loc="center left", bbox_to_anchor=(0.35, 0.62), ncols=len(labels), **spacing)
        return Figure(f"error-legend{lowest}{highest:+d}", svg(drawing), "Colours of errors and of wrong rays.")
