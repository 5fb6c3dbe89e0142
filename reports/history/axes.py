"""Place values and commits in a small drawing, the same way in the page and in the pictures."""

from __future__ import annotations

import math
from dataclasses import dataclass

from reports.history.series import STATUS, STATUSES, Graph, Value

DECADES = 2.0  # values that span more are placed by their logarithms
NEAREST = 0.3  # two labels of an axis


@dataclass(frozen=True)
class Scale:
    """Place values between 0, the lower end, and 1, the upper end.

    The axis is at least twice as long as what may change and make no step, so that a change that is no step is drawn
    as a small one.
    """

    lower: float
    upper: float
    logarithmic: bool

    @classmethod
    def of(cls, graph: Graph) -> Scale:
        """Return the scale that holds a graph's values."""
        values = graph.values
        low, high = float(min(values)), float(max(values))
        logarithmic = low > 0 and math.log10(high) - math.log10(low) > DECADES
        if logarithmic:
            return cls(math.log10(low), math.log10(high), True)
        lacks = max(0.0, 2.0 * graph.slack - (high - low)) / 2.0
        return cls(low - lacks, high + lacks, False)

    def position(self, value: Value) -> float:
        """Return the place of a value that the scale holds; 0.5 where it holds only one."""
        here = math.log10(value) if self.logarithmic else float(value)
        return (here - self.lower) / (self.upper - self.lower) if self.upper > self.lower else 0.5


def labels(graph: Graph, scale: Scale) -> list[tuple[float, str]]:
    """Return the values that an axis names, as positions and texts: the smallest and the largest.

    Two that are near each other are moved apart.
    """
    low, high = min(graph.values), max(graph.values)
    if low == high:
        return [(scale.position(low), short(graph, low))]
    below, above = scale.position(low), scale.position(high)
    lacks = max(0.0, NEAREST - (above - below)) / 2.0
    return [(below - lacks, short(graph, low)), (above + lacks, short(graph, high))]


def short(graph: Graph, value: Value) -> str:
    """Write a value with four digits at most; a status by its name."""
    return STATUSES[int(value)] if graph.figure == STATUS else f"{value:.4g}"


def across(at: float, commits: int) -> float:
    """Return the place of a commit between 0 and 1, of an axis with so many commits on the line."""
    return (at + 0.5) / max(commits, 1)
