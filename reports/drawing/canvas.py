"""Give all drawings the same settings, key and SVG, and an axis of errors that can show zero.

The axis of errors is logarithmic, and broken below its smallest decade, where an error of exactly zero is drawn.
Positions on it are decimal exponents.
"""

from __future__ import annotations

import io
import json
import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal
from urllib.parse import quote

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure as Drawing
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator
from numpy.typing import ArrayLike, NDArray

from harness.escaping import shown
from reports import wording
from reports.drawing import style
from reports.drawing.style import Mark

RC: dict[Any, Any] = {
    "font.family": style.FONT,
    "font.size": 7,
    "axes.titlesize": 7.5,
    "axes.titleweight": "bold",
    "axes.edgecolor": style.FAINT,
    "axes.labelcolor": style.INK,
    "axes.linewidth": 0.6,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": style.HAIRLINE,
    "grid.linewidth": 0.4,
    "xtick.color": style.FAINT,
    "ytick.color": style.FAINT,
    "xtick.labelcolor": style.INK,
    "ytick.labelcolor": style.INK,
    "legend.frameon": False,
    "svg.fonttype": "none",  # text stays text: the PDF embeds the same font, and readers can search it
    "svg.hashsalt": "firsthit",
    "text.parse_math": False,  # a name may have a $ in it
}
LINE: dict[str, Any] = {"lw": 0.8, "ms": 3.6, "mew": 0.8}
SERIES = "series:"  # begins the id of a group of marks, see `series`
WIDE, NARROW = 10.4, 7.0  # the width of the text on a landscape page and on an upright one, inches


@dataclass(frozen=True)
class ErrorAxis:
    """Place errors on a logarithmic axis from decade `lowest` to decade `highest`, and zero below them."""

    lowest: int
    highest: int

    @classmethod
    def of(cls, errors: ArrayLike) -> ErrorAxis:
        """Return the axis that holds these errors [n]; NaN and infinities do not count."""
        values = np.asarray(errors, np.float64)
        positive = values[(values > 0) & np.isfinite(values)]
        if not len(positive):
            return cls(-8, -4)
        lowest = math.floor(math.log10(positive.min()))
        return cls(lowest, max(math.ceil(math.log10(positive.max())), lowest + 1))

    @property
    def zero(self) -> float:
        """Return the position of an error of exactly zero, in decades."""
        return self.lowest - max(1.0, 0.18 * (self.highest - self.lowest))

    def position(self, errors: ArrayLike) -> NDArray[np.float64]:
        """Return the position of each error [n] in decades, as float64[n].

        An error that is not positive has the position of zero.
        """
        values = np.asarray(errors, np.float64)
        return np.asarray(np.where(values > 0, np.log10(np.where(values > 0, values, 1.0)), self.zero))

    def _label(self, position: float, _: object) -> str:
        """Write the label of a position, as matplotlib asks for it: a power of ten, or 0."""
        return wording.power_of_ten(round(position)) if position > self.zero else "0"

    def dress(self, axes: Axes, which: Literal["x", "y"] = "x", zero: bool = True) -> None:
        """Make this the x or y axis of `axes`: its ticks, its limits, and a grey ground behind zero.

        Without `zero` it ends somewhat below the smallest decade.
        """
        span = self.highest - self.lowest
        step = max(1, math.ceil(span / 4))
        axis = axes.xaxis if which == "x" else axes.yaxis
        axis.set_major_locator(FixedLocator([self.zero, *range(self.lowest, self.highest + 1, step)]))
        axis.set_major_formatter(FuncFormatter(self._label))
        if not zero:
            (axes.set_xlim if which == "x" else axes.set_ylim)(self.lowest - 0.12 * span, self.highest + 0.05 * span)
            return
        margin = 0.06 * (self.highest - self.zero)
        limits, ground = (axes.set_xlim, axes.axvspan) if which == "x" else (axes.set_ylim, axes.axhspan)
        limits(self.zero - margin, self.highest + margin)
        ground(self.zero - margin, (self.zero + self.lowest) / 2, color="#f4f4f4", linewidth=0, zorder=0)


@dataclass(frozen=True)
class Key:
    """Draw a key above the panels of a drawing, in as few lines as its labels need."""

    handles: Sequence[Artist]
    labels: list[str]
    width: float  # inches

    @property
    def _columns(self) -> int:
        """Return the largest number of columns of labels that fit into the width; at least 1.

        Labels fill one column after the other. A letter takes 0.056 inches, a handle 0.5.
        """
        letters = [len(label) for label in self.labels]
        for columns in range(len(letters), 1, -1):
            longest = [max(column) for column in np.array_split(letters, columns)]
            if sum(0.5 + 0.056 * letter for letter in longest) < self.width:
                return columns
        return 1

    @property
    def height(self) -> float:
        """Return the height in inches."""
        return 0.02 + 0.14 * -(-len(self.labels) // self._columns)

    def draw(self, drawing: Drawing) -> None:
        """Draw the key at the top of a drawing."""
        told: dict[str, Any] = {"ncols": self._columns, "borderaxespad": 0.1, "handlelength": 2.6}
        drawing.legend(self.handles, self.labels, loc="upper center", **told)


def label_decades(axis: Axis, few: bool = False) -> None:
    """Label a logarithmic axis, whose limits are set, with plain numbers.

    A short axis has labels within its decades too; `few` asks for fewer labels.
    """
    low, high = axis.get_view_interval()
    within_decades = (1.0, 2.0, 5.0) if high / low < (30 if few else 300) else (1.0,)
    axis.set_major_locator(LogLocator(subs=within_decades, numticks=5 if few else 9))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}" if value >= 1 else f"{value:g}"))


def series(method: str, *variants: str) -> str:
    """Return the id of a line's group in the SVG: its method, and its variant or the variant of each of its marks.

    It is JSON, percent-encoded, because matplotlib puts an id with quotes in it between quotes of the other kind.
    """
    return SERIES + quote(json.dumps([method, *variants]), safe="")


def line_of(mark: Mark) -> Line2D:
    """Return a line as a key shows it for a variant."""
    return Line2D([], [], color=mark.color, marker=mark.marker, ls=mark.line, **LINE)


def svg(drawing: Drawing) -> str:
    """Return the drawing as SVG text, which is the same every time, and is XML whatever its texts hold."""
    buffer = io.StringIO()
    with warnings.catch_warnings():  # SVG holds text as text: the reader's fonts have the letters that ours lack
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        drawing.savefig(buffer, format="svg", metadata={"Date": None})
    return shown(buffer.getvalue())
