"""Fit power laws to points: an exponent by least squares in logarithms, with its 95 % interval."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from reports import wording

FEWEST = 3  # different x that a fit needs


@dataclass(frozen=True)
class Refusal:
    """Hold why `points` points give no exponent."""

    points: int
    reason: str


@dataclass(frozen=True)
class Power:
    """Hold the law y = factor · x ** exponent.

    If errors are normal, the exponent is known to ± `half_width` at 95 %.
    """

    exponent: float
    half_width: float
    factor: float
    points: int
    scatter: float  # standard deviation of ln y about the line

    def at(self, x: ArrayLike) -> NDArray[np.float64]:
        """Return y at each of x [n], as float64[n]."""
        fitted: NDArray[np.float64] = self.factor * np.asarray(x, np.float64) ** self.exponent
        return fitted


def power_law(x: ArrayLike, y: ArrayLike) -> Power | Refusal:
    """Fit a power law to points x [n], y [n]; those that are not positive and finite are left out.

    Returns a Refusal where there are fewer than FEWEST different x, or where the exponent's interval is wider than the
    exponent.
    """
    places, values = np.asarray(x, np.float64), np.asarray(y, np.float64)
    usable = (places > 0) & (values > 0) & np.isfinite(places) & np.isfinite(values)
    points = int(usable.sum())
    if len(np.unique(places[usable])) < FEWEST:
        return Refusal(points, f"fewer than {FEWEST} places determine no exponent")
    u, v = np.log(places[usable]), np.log(values[usable])
    spread = ((u - u.mean()) ** 2).sum()
    exponent = float(((u - u.mean()) * (v - v.mean())).sum() / spread)
    level = float(v.mean() - exponent * u.mean())
    freedom = len(u) - 2
    scatter = math.sqrt(float(((v - level - exponent * u) ** 2).sum()) / freedom)
    half_width = student(freedom) * scatter / math.sqrt(spread)
    if not 2.0 * half_width <= abs(exponent):
        ends = f"{exponent - half_width:.2f} to {exponent + half_width:.2f}"
        return Refusal(
            points,
            wording.minus(
                f"{points} points do not determine an exponent: the 95 % interval of {exponent:.2f}, {ends}, is wider "
                "than that"
            ),
        )
    return Power(exponent, half_width, math.exp(level), points, scatter)


@cache
def student(freedom: int, share: float = 0.975) -> float:
    """Return the quantile of Student's distribution with `freedom` degrees of freedom at `share` > 1/2.

    The quantile is found by bisection on the integrated density.
    """
    constant = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)
    # t = √freedom · tan φ makes the density's integral one of cos^(freedom − 1) over a bounded range
    low, high = 0.0, math.pi / 2
    for _ in range(60):
        middle = (low + high) / 2
        angles = np.linspace(0.0, middle, 2001)
        heights = np.cos(angles) ** (freedom - 1)
        weights = np.full(2001, 2.0)
        weights[1::2] = 4.0
        weights[[0, -1]] = 1.0
        within = constant * math.sqrt(freedom) * float((weights * heights).sum()) * middle / 6000
        low, high = (middle, high) if within < share - 0.5 else (low, middle)
    return math.sqrt(freedom) * math.tan((low + high) / 2)
