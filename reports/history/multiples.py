"""Draw one figure of all rows over commits as a picture of small multiples.

All panels are drawn in one pair of axes, whose unit is an inch: axes of its own for each of some hundred rows would
take minutes.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure as Drawing

from reports.drawing import canvas, style
from reports.history.axes import Scale, across, labels, short
from reports.history.series import Graph, Value

DPI = 110
PANEL, PLOT = (3.5, 1.05), (2.75, 0.5)  # width and height of a panel and of the plot in it, inches
LEFT, BELOW, HEAD, FOOT = 0.62, 0.12, 0.72, 0.15
LINE, SHORT = 0.15, 0.75  # of a graph that never changes: the height, and the width of its plot
FITTING = 92  # letters of a name beside it that fit into half the picture
COLUMNS, LETTERS, LISTED = 3, 62, 12
WORSE, BETTER, OWN = "#B34100", "#00704F", "#0067A0"
Place = Callable[[float, Value], tuple[float, float]]  # from a commit's place and a value to inches


def write(graphs: Sequence[Graph], commits: int, heading: str, below: Sequence[str], path: Path) -> None:
    """Draw the graphs of one figure, of which there is at least one, as the PNG file `path`.

    Each graph that changes has a panel, those with most steps first. Below them each that never changes has a line,
    with its value. `commits` are on the line; `heading` stands above, and the lines `below` it. Raises OSError where
    the file cannot be written.
    """
    changing = sorted((graph for graph in graphs if not graph.flat), key=lambda graph: -len(graph.told))
    flat = [graph for graph in graphs if graph.flat]
    columns = COLUMNS if len(changing) > 2 or len(flat) > LISTED else 2
    longest = max((len(f"{graph.slot} · {graph.device}") for graph in flat), default=0)
    halves = 2 if len(flat) > LISTED and longest <= FITTING else 1
    width, rows = columns * PANEL[0], -(-len(flat) // halves)
    top = HEAD + PANEL[1] * -(-len(changing) // columns)
    height = top + LINE * (rows + 2 if flat else 0) + FOOT
    with mpl.rc_context(canvas.RC):
        drawing = Drawing(figsize=(width, height), dpi=DPI, facecolor=style.PAPER)
        panels = _Panels(drawing, width, height, commits, len({graph.device for graph in graphs}) > 1)
        for i, graph in enumerate(changing):
            panels.add(graph, PANEL[0] * (i % columns), height - HEAD - PANEL[1] * (i // columns + 1))
        if flat:
            panels.text(0.12, height - top - LINE, "with the same value at every commit:", weight="bold")
        for i, graph in enumerate(flat):
            panels.add_flat(graph, width / halves * (i // rows) + 0.12, height - top - LINE * (i % rows + 2))
        panels.text(0.12, height - 0.24, heading, size=9, weight="bold")
        said = "\n".join(line for text in below for line in textwrap.wrap(text, int(width * 16)))
        panels.text(0.12, height - 0.34, said, color=style.FAINT, va="top")
        panels.finish()
        drawing.savefig(path, format="png", metadata={"Software": None})


class _Panels:
    """Gather what all panels show, and draw it at once."""

    def __init__(self, drawing: Drawing, width: float, height: float, commits: int, several: bool) -> None:
        self._axes = drawing.add_axes((0, 0, 1, 1))
        self._axes.set(xlim=(0, width), ylim=(0, height))
        self._axes.axis("off")
        self._commits, self._several = commits, several
        self._lines: list[list[tuple[float, float]]] = []
        self._frames: list[list[tuple[float, float]]] = []
        self._dots: list[tuple[float, float]] = []
        self._rings: list[tuple[float, float]] = []
        self._steps: dict[bool, list[tuple[float, float]]] = {True: [], False: []}

    def text(self, x: float, y: float, said: str, size: float = 6.5, color: str = style.INK, **more: Any) -> None:
        """Write a text at a place in inches."""
        self._axes.text(x, y, said, fontsize=size, color=color, **more)

    def add(self, graph: Graph, left: float, bottom: float) -> None:
        """Add the panel of one graph, whose lower left corner is at a place in inches."""
        scale, x0, y0 = Scale.of(graph), left + LEFT, bottom + BELOW

        def place(at: float, value: Value) -> tuple[float, float]:
            y = y0 + PLOT[1] * (0.06 + 0.88 * scale.position(value))
            return x0 + PLOT[0] * across(at, self._commits), y

        self._frames.append([(x0, y0 + PLOT[1]), (x0, y0), (x0 + PLOT[0], y0)])
        self._trace(graph, place)
        for step in graph.told:
            self._steps[step.worse].append((x0 + PLOT[0] * across(step.at, self._commits), y0))
        for position, said in labels(graph, scale):
            y = y0 + PLOT[1] * (0.06 + 0.88 * position)
            self.text(x0 - 0.05, y, said, 5.5, style.FAINT, ha="right", va="center")
        title = "\n".join(textwrap.wrap(self._name(graph), LETTERS)[:2])
        self.text(x0, y0 + PLOT[1] + 0.1, title, 6, va="bottom", linespacing=1.0)

    def add_flat(self, graph: Graph, left: float, bottom: float) -> None:
        """Add a graph that never changes as one line: its drawing, its value and its name."""
        middle = bottom + 0.05
        self._trace(graph, lambda at, _: (left + SHORT * across(at, self._commits), middle))
        said = f"{short(graph, graph.values[0])}   {self._name(graph)}"
        self.text(left + SHORT + 0.12, middle, said, 5.2, va="center_baseline")

    def _name(self, graph: Graph) -> str:
        return f"{graph.slot} · {graph.device}" if self._several else graph.slot

    def _trace(self, graph: Graph, place: Place) -> None:
        """Add the line, the dots and the rings of a graph."""
        for span in graph.spans:
            places = [place(point.place.at, span.value) for point in span.points]
            self._dots += places
            if span.joined:
                self._lines[-1] += places
            else:
                self._lines.append(list(places))
        self._rings += [place(point.place.at, point.value) for point in graph.apart if point.value is not None]

    def finish(self) -> None:
        """Draw all that was added."""
        self._axes.add_collection(LineCollection(self._frames, colors=style.HAIRLINE, linewidths=0.6))
        self._axes.add_collection(LineCollection(self._lines, colors=OWN, linewidths=0.8))
        self._mark(self._dots, 2.6 if self._commits <= 60 else 1.4, OWN, OWN)
        self._mark(self._rings, 3.0, OWN, style.PAPER)
        for worse, color, marker, shift in ((True, WORSE, "^", 0.0), (False, BETTER, "v", 0.04)):
            tops = [(x, y + PLOT[1] + shift) for x, y in self._steps[worse]]
            bars = [[(x, y), (x, y + PLOT[1])] for x, y in self._steps[worse]]
            self._axes.add_collection(LineCollection(bars, colors=color, linewidths=0.7, linestyles="dashed"))
            self._mark(tops, 4.0, color, color, marker)

    def _mark(self, places: list[tuple[float, float]], size: float, edge: str, face: str, marker: str = "o") -> None:
        """Draw marks of one kind, whose width is in points."""
        look: dict[str, Any] = {"ms": size, "mec": edge, "mfc": face, "mew": 0.6}
        self._axes.plot([x for x, _ in places], [y for _, y in places], marker, zorder=3, **look)
