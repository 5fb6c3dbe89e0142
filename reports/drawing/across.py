"""Draw speed-ups device by device as small multiples: lines that cross are methods whose order changes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib
import pandas as pd
from matplotlib.figure import Figure as Drawing
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from reports import wording
from reports.content import Figure
from reports.drawing import line_labels, placing, style
from reports.drawing.canvas import NARROW, RC, series, svg
from reports.drawing.style import Mark

ACROSS, MOST = 2, 6  # panels beside each other, and in all
PANEL = 1.75  # inches: the height of a panel
TITLE, BETWEEN = 0.2, 0.12  # inches
LEFT = 0.5  # inches, or as much as the first device's name needs
TEXT = 7.0  # points
TURN = math.radians(28)  # by which the devices' names are turned


def figure(
    rows: pd.DataFrame, devices: Sequence[str], scenes: Mapping[str, str], marks: Mapping[str, Mark]
) -> Figure | None:
    """Draw a panel for each of at most MOST scenes; None where no scene has a method on two devices.

    `rows` has one row for each scene, device and method, `scenes` the names of the scenes to draw, `marks` are by
    method.
    """
    own = {name: rows[rows["comparison"] == name] for name in scenes}
    drawn = {name: of for name, of in own.items() if (of.groupby("method")["device"].nunique() > 1).any()}
    drawn = dict(list(drawn.items())[:MOST])
    if not drawn or len(devices) < 2:
        return None
    every = pd.concat(drawn.values())
    low, high = min(1.0, float(every["speedup"].min())) / 1.25, max(1.0, float(every["speedup"].max())) * 1.25
    names = line_labels.width([str(label) for label in every["method_label"].unique()])
    below = 0.12 + max(placing.text_size(device, TEXT)[0] for device in devices) * math.sin(TURN) / 72
    left = max(LEFT, placing.text_size(devices[0], TEXT)[0] * math.cos(TURN) / 72)
    down, across = -(-len(drawn) // ACROSS), min(ACROSS, len(drawn))
    height = down * (PANEL + TITLE) + (down - 1) * BETWEEN + below + 0.12
    width = (NARROW - left - across * names - (across - 1) * 0.12) / across
    with matplotlib.rc_context({**RC, "font.size": TEXT}):
        drawing = Drawing(figsize=(NARROW, height))
        for at, (name, of) in enumerate(drawn.items()):
            column, line = at % across, at // across
            x = left + column * (width + names + 0.12)
            y = height - TITLE - PANEL - line * (PANEL + TITLE + BETWEEN)
            axes = drawing.add_axes((x / NARROW, y / height, width / NARROW, PANEL / height))
            axes.set_title(scenes[name], loc="left", color=style.INK, pad=3)
            _dress(axes, devices, (low, high), column == 0, at + across >= len(drawn))
            line_labels.write(axes, _lines(axes, of, devices, marks))
        told = "speed-up over the baseline, times"
        drawing.text(0.03 / NARROW, 0.5, told, ha="left", va="center", rotation=90, fontsize=TEXT)
        made = svg(drawing)
    caption = (
        "For each method its fastest variant with no wrong ray, over the baseline on the same device and scene (the "
        "dashed line). Lines that cross are methods whose order depends on the device."
    )
    told = wording.listed([scenes[name] for name in drawn])
    return Figure("across-devices", made, f"Speed-ups by device on {told}.", "Speed-up by device.", caption)


def _dress(axes: Any, devices: Sequence[str], limits: tuple[float, float], first: bool, lowest: bool) -> None:
    """Set the axes of a panel: the devices, and the speed-ups."""
    axes.set_xlim(-0.25, len(devices) - 0.75)
    axes.set_xticks(range(len(devices)), devices if lowest else [""] * len(devices))
    if lowest:
        for label in axes.get_xticklabels():
            label.set(rotation=math.degrees(TURN), ha="right", rotation_mode="anchor")
    axes.set_yscale("log")
    axes.set_ylim(*limits)
    ticks = [t * 10.0**e for e in range(-4, 6) for t in (1, 2, 5) if limits[0] <= t * 10.0**e <= limits[1]]
    if len(ticks) > 7:
        ticks = [tick for tick in ticks if f"{tick:e}".startswith("1.")]
    axes.yaxis.set_major_locator(FixedLocator(ticks))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.tick_params(length=2, pad=1.5, labelleft=first)
    axes.axhline(1.0, color=style.FAINT, lw=0.7, ls=(0, (3, 2)), zorder=1)


def _lines(
    axes: Any, rows: pd.DataFrame, devices: Sequence[str], marks: Mapping[str, Mark]
) -> list[tuple[float, float, str, str]]:
    """Draw a line for each method; return where each ends, its name and its colour."""
    ends = []
    for method, own in rows.groupby("method", sort=False):
        speedups = dict(zip(own["device"], own["speedup"], strict=True))
        points = [(at, float(speedups[device])) for at, device in enumerate(devices) if device in speedups]
        mark = marks[str(method)]
        look: dict[str, Any] = {"color": mark.color, "marker": mark.marker, "ms": 4, "mew": 0.8, "lw": 1.1}
        axes.plot(*zip(*points, strict=True), gid=series(str(method), *own["variant"]), zorder=3, **look)
        ends.append((*points[-1], str(own["method_label"].iloc[0]), mark.color))
    return ends
