"""Compute how far bounds of a random Bézier function's extrema are from the extrema (szente, section 3 and Table 2).

The paper describes "curves with random coefficients in [0, 1], averaging the statistics over 100 curves" and errors
"normalised by the magnitude of the extremum". That recipe does not give its figures: the LU bound is exact at degree 2,
where the paper prints 28.54 %. Other readings are therefore computed as well. The extrema are the least and the largest
of SAMPLES values, and of the parabolas through each three neighbours. Their error is about 1e-6 of the function's
range.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Literal

import numpy as np
from numpy.typing import NDArray

TITLE = "Errors of bounds of extrema"
DEGREES = (2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20)
CURVES = 100
SAMPLES = 1001
SEED = 1

Curve = NDArray[np.float64]


@dataclass(frozen=True)
class Reading:
    """Hold one way to understand the paper's description."""

    words: str
    draw: Callable[[np.random.Generator, int], Curve]
    over: Literal["extremum", "range", "largest"] = "extremum"
    slip: bool = False  # whether Equation 8 has the exponent 1/n, as in the authors' published code
    kind: Literal["both", "largest magnitude"] = "both"


def _unit(rng: np.random.Generator, n: int) -> Curve:
    """Draw n + 1 coefficients in [0, 1]."""
    return rng.random(n + 1)


def _signed(rng: np.random.Generator, n: int) -> Curve:
    """Draw n + 1 coefficients in [−1, 1]."""
    return rng.uniform(-1.0, 1.0, n + 1)


def _slope(rng: np.random.Generator, n: int) -> Curve:
    """Draw a curve of degree n + 1 with coefficients in [0, 1], and return the coefficients of its derivative."""
    return (n + 1) * np.diff(rng.random(n + 2))


READINGS = (
    Reading("as described: coefficients in [0, 1], over the extremum's magnitude", _unit),
    Reading("coefficients in [0, 1], over the function's range", _unit, "range"),
    Reading("coefficients in [−1, 1], over the largest magnitude", _signed, "largest"),
    Reading("derivatives of such curves, over the largest magnitude", _slope, "largest"),
    Reading("derivatives of such curves, bound of the largest slope", _slope, "largest", kind="largest magnitude"),
    Reading("as described, but exponent 1/n for Equation 8's 1/(n − 1)", _unit, slip=True),
)


def compute() -> list[dict[str, str | int | float]]:
    """Return a row for each reading, bound and degree: reading, bound, degree, percent."""
    rows: list[dict[str, str | int | float]] = []
    for reading in READINGS:
        rng = np.random.default_rng(SEED)
        for n in DEGREES:
            curves = [reading.draw(rng, n) for _ in range(CURVES)]
            for bound in ("control point", "LU"):
                errors = [error for curve in curves for error in _errors(curve, bound, reading)]
                percent = 100.0 * float(np.mean(errors))
                rows.append({"reading": reading.words, "bound": bound, "degree": n, "percent": percent})
    return rows


def _errors(b: Curve, bound: str, reading: Reading) -> list[float]:
    """Return the relative errors of a bound for one curve, of both extrema or of the largest magnitude."""
    low, high = extrema(b)
    least, most = (b.min(), b.max())
    if bound == "LU":
        least, most = lu_least(b, reading.slip), -lu_least(-b, reading.slip)
    largest = max(abs(low), abs(high))
    if reading.kind == "largest magnitude":
        return [(max(abs(least), abs(most)) - largest) / largest]
    scales = {"extremum": (abs(low), abs(high)), "range": (high - low,) * 2, "largest": (largest,) * 2}[reading.over]
    return [abs(low - least) / scales[0], abs(most - high) / scales[1]]


def extrema(b: Curve) -> tuple[float, float]:
    """Return the least and the largest value on [0, 1] of the function with Bernstein coefficients b[n + 1]."""
    values = _bernstein(len(b) - 1) @ b
    before, here, after = values[:-2], values[1:-1], values[2:]
    bend = before - 2.0 * here + after
    top = ((here - before) * (here - after) >= 0.0) & (bend != 0.0)
    tops = here[top] - (after[top] - before[top]) ** 2 / (8.0 * bend[top])
    every = np.concatenate([values, tops])
    return float(every.min()), float(every.max())


@cache
def _bernstein(n: int) -> NDArray[np.float64]:
    """Return the basis functions of degree n at equal steps over [0, 1]: float64[SAMPLES, n + 1]."""
    t = np.linspace(0.0, 1.0, SAMPLES)
    return np.stack([math.comb(n, j) * t**j * (1.0 - t) ** (n - j) for j in range(n + 1)], axis=1)


def lu_least(b: Curve, slip: bool = False) -> float:
    """Return the least value on [0, 1] of the lower LU function (Equations 5 and 8) of b[n + 1]."""
    n, m = len(b) - 1, b.min()
    left, right = b[0] - m, b[-1] - m
    if left <= 0.0 or right <= 0.0:
        return float(m)
    root = n if slip else n - 1
    t = 1.0 / (1.0 + (right / left) ** (1.0 / root))
    return float(m + left * (1.0 - t) ** n + right * t**n)
