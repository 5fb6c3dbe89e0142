"""Write the markers of methods as SVG paths, for pages that draw them themselves."""

from __future__ import annotations

import numpy as np
from matplotlib.markers import MarkerStyle

from reports.drawing.style import Mark

_COMMANDS = {1: "M", 2: "L", 3: "Q", 4: "C"}  # by matplotlib's codes; any other code closes the path


def outline(mark: Mark, x: float = 0.0, y: float = 0.0, size: float = 1.0) -> str:
    """Return the outline of a mark about (x, y), which reaches `size` from it, as an SVG path: y points down.

    About 0, with size 1, it is what Vega takes for a shape too.
    """
    marker = MarkerStyle(mark.marker)
    path = marker.get_path().transformed(marker.get_transform())
    scale = size / (float(np.abs(path.vertices).max()) or 1.0)
    words = []
    for numbers, code in path.iter_segments(curves=True):
        command = _COMMANDS.get(int(code))
        ends = np.asarray(numbers).reshape(-1, 2) * scale
        words.append(command + " ".join(f"{x + a:.2f},{y - b:.2f}" for a, b in ends) if command else "Z")
    return "".join(words).replace("-0.00", "0.00")
