"""Draw families of hard rays: the share of rays answered rightly, rung by rung."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.patches import Patch
from matplotlib.ticker import PercentFormatter

from reports import wording
from reports.content import Figure
from reports.drawing import style
from reports.drawing.canvas import LINE, NARROW, RC, Key, line_of, series, svg
from reports.drawing.style import Mark
from reports.reading.run import Facts
from reports.reading.tuples import tuples

DODGE = 0.5  # the share of the step between rungs over which marks of one rung are spread, so that all are seen


def figure(devices: Mapping[str, pd.DataFrame], facts: Facts, marks: Mapping[str, Mark]) -> Figure:
    """Draw one family: a panel for each device and precision, a line for each variant.

    Devices are below each other, precisions beside each other. Rungs have equal distances, in order of growing
    difficulty: a scale of the parameter would crowd some ladders, and a logarithmic one cannot show a rung at 0.
    """
    rows = pd.concat(devices.values())
    variants = [variant for variant in marks if (rows["variant"] == variant).any()]
    precisions = sorted(rows["precision"].unique())
    hatched = Patch(facecolor="none", edgecolor=style.FAINT, hatch="////", linewidth=0)
    key = Key([*(line_of(marks[v]) for v in variants), hatched], [*variants, "no ray decided"], NARROW)
    above = key.height + 0.2
    height = above + 0.22 + 1.0 * len(devices)
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(NARROW, height))
        panels = drawing.subplots(len(devices), len(precisions), sharey=True, squeeze=False)
        drawing.subplots_adjust(0.45 / NARROW, 0.2 / height, 1 - 0.05 / NARROW, 1 - above / height, 0.05, 0.45)
        for line, (device, own) in zip(panels, devices.items(), strict=True):
            for axes, precision in zip(line, precisions, strict=True):
                axes.set_title(precision if len(devices) == 1 else f"{precision}, {device}", color=style.INK)
                _draw(axes, own[own["precision"] == precision], variants, marks)
        key.draw(drawing)
        drawn = svg(drawing)
    return Figure(
        f"ladder-{rows['family'].iloc[0]}",
        drawn,
        f"Share of rays answered rightly by {wording.listed(variants)}, against {facts.parameter}.",
        f"{facts.title}.",
        f"Across: {facts.parameter}. Hard because {facts.why}.{_undecided(rows)}",
    )


def _draw(axes: Axes, rows: pd.DataFrame, variants: list[str], marks: Mapping[str, Mark]) -> None:
    """Draw the ladder of one device and precision."""
    if rows.empty:
        axes.text(0.5, 0.5, "no result", transform=axes.transAxes, ha="center", va="center", color=style.FAINT)
    rungs = rows.drop_duplicates("level").sort_values("level")
    axes.set_ylim(-0.08, 1.08)
    axes.set_yticks([0, 0.5, 1])
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.set_xlim(-0.5, max(len(rungs), 1) - 0.5)
    axes.set_xticks(rungs["level"].astype(int), [wording.level(parameter) for parameter in rungs["parameter"]])
    axes.grid(visible=False, axis="x")
    for level in rungs["level"][rungs["decided"] == 0].astype(int):
        axes.axvspan(level - 0.5, level + 0.5, facecolor="none", edgecolor=style.HAIRLINE, hatch="////", linewidth=0)
    for i, variant in enumerate(variants):
        own, mark = rows[rows["variant"] == variant].sort_values("level"), marks[variant]
        x = own["level"].astype(float) + DODGE * ((i + 0.5) / len(variants) - 0.5)
        method = str(own["method"].iloc[0]) if len(own) else variant
        look = {"color": mark.color, "marker": mark.marker, "gid": series(method, variant), **LINE}
        axes.plot(x, own["share_right"], ls=mark.line, zorder=3, **look)
        blind = own[(own["decided"] == 0) & (own["undecidable"] > 0)]
        share = blind["undecidable_right"].astype(float) / blind["undecidable"].astype(float)
        axes.plot(x[blind.index], share, ls="none", markerfacecolor=style.PAPER, zorder=3, **look)


def _undecided(rows: pd.DataFrame) -> str:
    """Say in which precisions no ray of the family can be decided; "" where there is none."""
    told = ""
    for precision, own in rows.groupby("precision"):
        if not own["decided"].any():
            sums = own.groupby("variant", sort=False)[["undecidable_right", "undecidable"]].sum()
            counts = wording.listed([f"{r.Index} {r.undecidable_right:,} of {r.undecidable:,}" for r in tuples(sums)])
            told += f" In {precision} none of these rays can be decided; answered as the oracle does: {counts}."
    return told
