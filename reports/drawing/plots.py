"""Draw the legend of pictures of errors."""

from __future__ import annotations

import math

import matplotlib
import numpy as np
from matplotlib.figure import Figure as Drawing
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter

from reports import wording
from reports.content import Figure
from reports.drawing import style
from reports.drawing.canvas import RC, svg


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
