"""Measure by how much the natural interval extension of each form of a surface overestimates f's range over boxes.

beamcasting, section III.A: the natural extension replaces every operation of the expression by its interval
counterpart, and so depends on how the expression is written. Boxes are cubes with random centres in the domain's box,
cut by it. All forms of a surface are evaluated over the same boxes. The range is that of f at POINTS^3 points of each
box, the corners among them; on large boxes it is slightly less than the true one. Extensions are computed in float64
without outward rounding, which is far smaller than the widths compared here.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Surface
from surfaces.numbers import Arithmetic
from surfaces.tape import walk

TITLE = "Overestimation of ranges by the form of a formula"
BASES = ("chmutov", "torus", "tangle", "klein")
HALVINGS = (1, 2, 3, 4, 5, 6, 7, 8)
BOXES = 100
POINTS = 13
SEED = 1

Ends = NDArray[np.float64]
Interval = tuple[Ends, Ends]  # lower and upper ends, float64[n] or one number each
Row = dict[str, str | int | float | None]


class Intervals(Arithmetic):
    """Run a tape in intervals; it has the operations that the papers' formulas need."""

    def const(self, value: Fraction) -> Interval:
        return np.asarray(float(value)), np.asarray(float(value))

    def e(self) -> Interval:
        return np.asarray(np.e), np.asarray(np.e)

    def sqrt(self, a: Interval) -> Interval:
        return np.sqrt(a[0]), np.sqrt(a[1])

    def exp(self, a: Interval) -> Interval:
        return np.exp(a[0]), np.exp(a[1])

    def add(self, a: Interval, b: Interval) -> Interval:
        return a[0] + b[0], a[1] + b[1]

    def sub(self, a: Interval, b: Interval) -> Interval:
        return a[0] - b[1], a[1] - b[0]

    def neg(self, a: Interval) -> Interval:
        return -a[1], -a[0]

    def mul(self, a: Interval, b: Interval) -> Interval:
        products = [p * q for p in a for q in b]
        return np.minimum.reduce(products), np.maximum.reduce(products)

    def sqr(self, a: Interval) -> Interval:
        return self.powi(a, 2)

    def powi(self, a: Interval, n: int) -> Interval:
        if n % 2:
            return a[0] ** n, a[1] ** n
        least = np.maximum(np.maximum(a[0], -a[1]), 0.0)
        return least**n, np.maximum(-a[0], a[1]) ** n


def compute() -> list[Row]:
    """Return a row for each form and size of box.

    Columns: surface, form, side (of a box, over the domain's radius), factor (the mean width of the extension over that
    of the range), empty (how many boxes hold no surface) and excluded (the share of these that the extension excludes).
    """
    import surfaces

    rows: list[Row] = []
    for base in BASES:
        forms = [surfaces.get(name) for name in (base, *surfaces.forms_of(base))]
        for halvings in HALVINGS:
            lower, upper = boxes(forms[0], halvings)
            least, most = sampled_range(forms[0], lower, upper)
            empty = (least > 0.0) | (most < 0.0)
            for form in forms:
                low, high = extension(form, lower, upper)
                outside = (low > 0.0) | (high < 0.0)
                rows.append(
                    {
                        "surface": base,
                        "form": form.name,
                        "side": 0.5**halvings,
                        "factor": float((high - low).sum() / (most - least).sum()),
                        "empty": int(empty.sum()),
                        "excluded": float(outside[empty].mean()) if empty.any() else None,
                    }
                )
    return rows


def boxes(surface: Surface, halvings: int) -> tuple[Ends, Ends]:
    """Draw lower and upper corners, float64[BOXES, 3], of cubes whose side is the domain's radius / 2^halvings."""
    domain = surface.domain
    if isinstance(domain, Box):
        first, last = np.array(domain.lower), np.array(domain.upper)
    else:
        first, last = np.array(domain.center) - domain.radius, np.array(domain.center) + domain.radius
    centres = np.random.default_rng(SEED).uniform(first, last, (BOXES, 3))
    half = 0.5 * domain.radius * 0.5**halvings
    return np.maximum(centres - half, first), np.minimum(centres + half, last)


def sampled_range(surface: Surface, lower: Ends, upper: Ends) -> tuple[Ends, Ends]:
    """Sample the least and the largest value of f at POINTS^3 points of each box: float64[n] each."""
    import surfaces

    steps = np.linspace(0.0, 1.0, POINTS)
    grid = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    points = lower[:, None, :] + grid * (upper - lower)[:, None, :]
    values = surfaces.evaluate(surface, points.reshape(-1, 3)).reshape(len(lower), -1)
    return values.min(axis=1), values.max(axis=1)


def extension(surface: Surface, lower: Ends, upper: Ends) -> tuple[Ends, Ends]:
    """Evaluate the natural extension of f as it is written, over each box: float64[n] each."""
    import surfaces

    box = {axis: (lower[:, k], upper[:, k]) for k, axis in enumerate("xyz")}
    low, high = walk(surfaces.tape_of(surface), Intervals(), box)[0]
    return low, high
