"""Sample functions at Chebyshev's points, and search between samples."""

from __future__ import annotations

from functools import cache

import numpy as np

from harness.oracle.balls64 import Floats


@cache
def lobatto(degree: int) -> Floats:
    """Return Chebyshev's extrema in [0, 1]: float64[degree + 1]."""
    return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.arange(degree + 1) / degree))


@cache
def interpolation(degree: int, finer: int) -> Floats:
    """Return the matrix, float64[degree * finer + 1, degree + 1], that refines a polynomial's samples.

    It turns the values at lobatto(degree) into the values at lobatto(degree * finer).
    """
    weight = np.where(np.arange(degree + 1) % degree == 0, 0.5, 1.0) if degree > 1 else np.full(2, 0.5)
    order = np.arange(degree + 1)
    at_nodes = np.cos(np.pi / degree * np.outer(order, order)) * np.outer(weight, weight) * 2.0 / degree
    at_samples = np.cos(np.pi / (degree * finer) * np.outer(np.arange(degree * finer + 1), order))
    return np.asarray(at_samples @ at_nodes)


def least_of_cubic(a: Floats, b: Floats, low: Floats, high: Floats, fall: Floats, climb: Floats) -> Floats:
    """Return where cubics are least between a and b; all arrays are float64[k].

    The values of a cubic at a and b are `low` and `high`, its slopes `fall` and `climb`.
    """
    width = b - a
    bend = fall + climb - 3.0 * (high - low) / width
    root = np.sqrt(bend * bend - fall * climb)
    return np.asarray(b - width * (climb + root - bend) / (climb - fall + 2.0 * root))
