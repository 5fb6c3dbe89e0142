"""Draw the overview of the first page, and the legend of pictures of errors."""

from __future__ import annotations

import math
from collections.abc import Mapping

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter

from reports import wording
from reports.analysis import derive
from reports.content import Figure
from reports.drawing import style
from reports.drawing.canvas import NARROW, RC, label_decades, series, svg
from reports.drawing.style import Mark

PANELS_ACROSS = 5  # devices in one figure


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
        drawing.supxlabel("Mrays/s", fontsize=7)
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
