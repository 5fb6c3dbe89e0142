"""toledo2007's Figure 3: T, T' and T'' along rays through the torus, case by case."""

from __future__ import annotations

import textwrap
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D

from reports import wording
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Block, Figure, Section, Text
from reports.drawing import style
from reports.drawing.canvas import NARROW, RC, svg
from reports.material import Material

ORDER = 11
CONFIG = "toledo-fig3.toml"
SEEN = (
    "T and its two derivatives along rays through the torus. As printed, t_M parts each ray for bisection; ours parts "
    "it at the roots of T″. Where no minimum reaches 0, Newton's signed steps turn back and stay in the dip."
)
TOLD = (
    "T′ and T″ are scaled to T's height. Bisection looks at the two ends of a piece. Where f has different signs at "
    "them, it ends at a root; else it ends at an extreme of f, on the side towards 0. In the last case but one the "
    "first minimum only touches; in the last none reaches 0."
)
TITLE = 22  # characters of a line of a panel's title
ACROSS = 4  # panels beside each other
BEYOND = 0.15  # curves go on by this share of the stretch between the outermost marks
CURVES = ((0, "T", "#0072B2", "-"), (1, "T′", "#E69F00", "--"), (2, "T″", "#009E73", ":"))
MARKS = (("roots", "o", "roots of T"), ("extremes", "^", "roots of T′"), ("bends", "s", "roots of T″"))


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has no rows for it."""
    rows = material.evidence.studies.get("torus_along_rays")
    if not rows:
        return []
    drawn = _figure([row for row in rows if row["case"] != "sampled"])
    verdicts = tuple(verdict_tables(material.judged, CONFIG, "toledo2007, Figure 3"))
    blocks: tuple[Block, ...] = (introduced(SEEN, material.judged, CONFIG), drawn)
    return [Section("toledo2007, Figure 3", blocks, (Text(TOLD), *verdicts))]


def _figure(cases: list[dict[str, Any]]) -> Figure:
    """Draw a panel for each case, a row of the study."""
    down = -(-len(cases) // ACROSS)
    with matplotlib.rc_context(RC | {"font.size": 7}):
        drawing = Drawing(figsize=(NARROW, 0.3 + 1.25 * down), layout="constrained")
        panels = drawing.subplots(down, ACROSS, squeeze=False).ravel()
        for axes, case in zip(panels, cases, strict=False):
            _case(axes, case)
        for axes in panels[len(cases) :]:
            axes.set_axis_off()
        handles = [Line2D([], [], color=color, ls=line, lw=1.0) for _, _, color, line in CURVES]
        handles += [Line2D([], [], color=style.INK, marker=mark, ms=3.5, lw=0) for _, mark, _ in MARKS]
        handles.append(Line2D([], [], color=style.FAINT, lw=0.8, ls="-."))
        labels = [*(name for _, name, _, _ in CURVES), *(told for _, _, told in MARKS), "t_M"]
        drawing.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
        drawn = svg(drawing)
    return Figure(
        "toledo-figure-3",
        drawn,
        f"T and its two derivatives along {wording.plural(len(cases), 'ray')}, with the roots of each.",
    )


def _case(axes: Axes, case: dict[str, Any]) -> None:
    """Draw T and its two derivatives along one ray, each scaled to T's height."""
    places = [t for name, _, _ in MARKS for t in case[name]]
    reach = max(places) - min(places) or 1.0
    t = np.linspace(min(places) - BEYOND * reach, max(places) + BEYOND * reach, 200)
    height = np.abs(np.polyval(case["coefficients"], t)).max()
    for order, _, color, line in CURVES:
        values = np.polyval(np.polyder(np.array(case["coefficients"]), order), t)
        axes.plot(t, values * height / np.abs(values).max(), color=color, ls=line, lw=1.0)
    for name, mark, _ in MARKS:
        at = np.array(case[name])
        axes.plot(at, np.polyval(case["coefficients"], at), color=style.INK, marker=mark, ms=3.5, lw=0)
    axes.axhline(0.0, color=style.FAINT, lw=0.6)
    axes.axvline(case["t_m"], color=style.FAINT, lw=0.8, ls="-.")
    axes.set_title(textwrap.fill(case["case"], TITLE), color=style.INK)
    axes.set_yticks([])
