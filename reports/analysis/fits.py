"""Power laws through points: an exponent by least squares in logarithms, with its interval."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

FEWEST = 3  # different places that a fit needs


@dataclass(frozen=True)
class Refusal:
    """Why no exponent is told of so many points."""

    points: int
    reason: str


@dataclass(frozen=True)
class Power:
    """y = factor · x ** exponent; the exponent is known to ± `half_width` at 95 % if errors are normal."""

    exponent: float
    half_width: float
    factor: float
    points: int
    scatter: float  # standard deviation of ln y about the line

    def at(self, x: ArrayLike) -> NDArray[np.float64]:
        fitted: NDArray[np.float64] = self.factor * np.asarray(x, np.float64) ** self.exponent
        return fitted


def power_law(x: ArrayLike, y: ArrayLike) -> Power | Refusal:
    """The fit through positive points [n], or why there is none: too few places, or an interval wider than itself.

    At least FEWEST different x make a fit.
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
            f"{points} points do not determine an exponent: the 95 % interval of {exponent:.2f}, {ends}, is wider than "
            "that".replace("-", "−"),
        )
    return Power(exponent, half_width, math.exp(level), points, scatter)


@cache
def student(freedom: int, share: float = 0.975) -> float:
    """The quantile of Student's distribution at `share` > 1/2, found by bisection on its integrated density."""
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
