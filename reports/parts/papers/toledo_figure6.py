"""toledo2007's Figure 6: frame time against the number of tori, and where techniques change places."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing

from reports import wording
from reports.claims import picks
from reports.claims.toledo_tori import CONFIG, OURS, PICKS, crossing, curve, tori
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Block, Column, Figure, Section, Table
from reports.drawing.canvas import NARROW, RC, label_decades, svg
from reports.material import Material

ORDER = 12
SEEN = (
    "Frame time against the number of tori on a lattice. Polygons cost by the torus and ray casting by the pixel, so "
    "that their lines cross; the paper prints no numbers for this figure, but says where Newton 0.001 overtakes."
)
COLORS = ("#0072B2", "#56B4E9", "#E69F00", "#D55E00", "#882255", "#009E73")
CLAIMED = {  # what the paper's text says of Newton 0.001 against each technique
    picks.POLYGONS[0].words: "Newton 0.001 is the fastest for more than 700 tori",
    picks.POLYGONS[1].words: "Newton 0.001 is the fastest for more than 700 tori",
    picks.POLYGONS[2].words: "of equal error: Newton 0.001 is always faster",
    picks.NEWTON_5.words: "Newton 0.001 is the fastest for more than 700 tori",
}


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has no rows for it."""
    rows = tori(material.evidence.of(CONFIG))
    if rows.empty:
        return []
    blocks: tuple[Block, ...] = (introduced(SEEN, material.judged, CONFIG), _drawn(rows), _crossings(rows))
    details: tuple[Block, ...] = (_times(rows), *verdict_tables(material.judged, CONFIG, "toledo2007, Figure 6"))
    return [Section("toledo2007, Figure 6", blocks, details, name="Fig. 6")]


def _drawn(rows: pd.DataFrame) -> Figure:
    """Draw the time of each technique by the number of tori, with its name at its line's end."""
    with matplotlib.rc_context(RC | {"font.size": 7, "axes.titlesize": 7}):
        drawing = Drawing(figsize=(NARROW, 2.9), layout="constrained")
        axes = drawing.subplots()
        curves = {pick.words: own for pick in (*PICKS, OURS) if len(own := curve(rows, pick))}
        for (name, own), color in zip(curves.items(), itertools.cycle(COLORS), strict=False):
            axes.loglog(own.index, own, color=color, ls=":" if name == OURS.words else "-", marker="o", ms=3, lw=1.0)
        _name_ends(axes, curves)
        low, high = axes.get_ylim()
        axes.set_ylim(low, high * 2.0)
        axes.set_xlim(right=axes.get_xlim()[1] * 6)  # room for the names
        axes.spines[["top", "right"]].set_visible(False)
        axes.set_xlabel("tori")
        axes.set_ylabel("ms a frame")
        for axis in (axes.xaxis, axes.yaxis):
            label_decades(axis)
        drawn = svg(drawing)
    told = f"Frame time against the number of tori by {wording.listed(list(curves))}, on logarithmic axes."
    return Figure("toledo-figure-6", drawn, told)


def _name_ends(axes: Axes, curves: Mapping[str, pd.Series]) -> None:
    """Write each curve's name in a column on the right, in the order of the last points, to which lines lead."""
    low, high = np.log10(axes.get_ylim())
    least = 0.075 * (high - low)  # a line of text
    column = 1.8 * max(own.index[-1] for own in curves.values())
    above = -np.inf
    ends = zip(curves.items(), itertools.cycle(COLORS), strict=False)
    for (name, own), color in sorted(ends, key=lambda one: one[0][1].iloc[-1]):
        above = max(float(np.log10(own.iloc[-1])), above + least)
        leader = {"arrowstyle": "-", "color": color, "lw": 0.4, "shrinkA": 0.0, "relpos": (0.0, 0.5)}
        place = (column, 10.0**above)
        axes.annotate(name, (own.index[-1], own.iloc[-1]), place, color=color, va="center", arrowprops=leader)


def _times(rows: pd.DataFrame) -> Table:
    """Make a line for each technique: its time by the number of tori."""
    counts = sorted(int(n) for n in rows["instances"].unique())
    body: list[tuple[Any, ...]] = []
    for pick in (*PICKS, OURS):
        own = curve(rows, pick)
        if not own.empty:
            body.append((pick.words, *(own.get(n) for n in counts)))
    return Table(
        (
            Column("technique"),
            *(Column(f"{n:,}", wording.number, numeric=True, over="ms, by number of tori") for n in counts),
        ),
        body,
        "toledo2007, Figure 6: frame time against the number of tori.",
        f"Tori on a cubic lattice, each turned at random, on {rows['device'].iloc[0]}; the paper prints no numbers. "
        "Where a cell is empty, its frame has more triangles than the config allows.",
    )


def _crossings(rows: pd.DataFrame) -> Table:
    """Make a line for each technique: from how many tori on Newton is faster than it."""
    newton, ours = curve(rows, picks.NEWTON_3), curve(rows, OURS)
    body = []
    for pick in PICKS[1:]:
        own = curve(rows, pick)
        both = own.index.intersection(newton.index)
        if both.empty:
            continue
        last = max(both)
        told = (_told(crossing(newton, own)), None if ours.empty else _told(crossing(ours, own)))
        body.append((pick.words, *told, last, own[last] / newton[last], CLAIMED[pick.words]))
    return Table(
        (
            Column("against"),
            Column("Newton 0.001 is faster from", stretch=1),
            Column("ours, forwards, is from", stretch=1),
            Column("tori, at most", wording.count, numeric=True),
            Column("time there over\nNewton 0.001's", wording.factor, numeric=True),
            Column("the paper", stretch=1),
        ),
        body,
        "Where Newton 0.001 overtakes.",
        "Interpolated between the counts measured, on logarithmic axes.",
    )


def _told(at: float | None) -> str:
    """Write the number of tori that `crossing` returns."""
    if at is None:
        return "nowhere measured"
    return (
        "the first torus on"
        if at <= 1.0
        else f"about {np.format_float_positional(float(f'{at:.2g}'), trim='-')} tori on"
    )
