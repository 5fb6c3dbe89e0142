"""Cover a domain with boxes: the box about it, which boxes lie beyond it, and boxes cut in two."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from surfaces.model import Box, Domain

Floats = NDArray[np.float64]


def corners(domain: Domain) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the lower and the upper corner of the box about a domain."""
    if isinstance(domain, Box):
        return domain.lower, domain.upper
    lower = tuple(math.nextafter(c - domain.radius, -math.inf) for c in domain.center)
    return lower, tuple(math.nextafter(c + domain.radius, math.inf) for c in domain.center)


def box_about(domain: Domain) -> dict[str, tuple[float, float]]:
    """Return the sides of the box about a domain, by the names of the coordinates."""
    return dict(zip("xyz", zip(*corners(domain), strict=True), strict=True))


def outside(domain: Domain, lower: Floats, upper: Floats) -> NDArray[np.bool_]:
    """Return which boxes float64[n, 3] are proved to lie outside the domain: bool[n]."""
    if isinstance(domain, Box):
        return np.asarray((lower > domain.upper).any(axis=1) | (upper < domain.lower).any(axis=1))
    center = np.asarray(domain.center)
    gap = np.maximum(np.maximum(lower - center, center - upper), 0.0)
    return np.asarray((gap * gap).sum(axis=1) > domain.radius * domain.radius * (1.0 + 1e-14))


def halved(lower: Floats, upper: Floats, used: NDArray[np.bool_]) -> tuple[Floats, Floats]:
    """Cut boxes float64[n, 3] in two across the longest of their `used` sides, bool[3]: float64[2 n, 3] each."""
    rows, axis = np.arange(len(lower)), np.argmax(np.where(used, upper - lower, -1.0), axis=1)
    middle = 0.5 * (lower[rows, axis] + upper[rows, axis])
    first, second = upper.copy(), lower.copy()
    first[rows, axis] = second[rows, axis] = middle
    return np.concatenate((lower, second)), np.concatenate((first, upper))
