"""Compute the torus's quartic T along rays, and test what toledo2007 says of it (section 4.2, equations 2 and 3).

The paper prints T's coefficients, says that T has "at most two local maximum and at most one local minimum", and splits
a ray at t_M = -(o·v), the mean of the roots of T'. Here, one ray is computed for each shape of T that Figure 3 draws
and for some like them. On SAMPLED random rays all three statements are tested; equation 2 is compared with the
catalog's formula.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

TITLE = "The torus's quartic along rays"
RING, TUBE = 0.7, 0.3
SAMPLED = 20_000
SEED = 1
REAL = 1e-6  # a root with a smaller imaginary part is real; double roots are found to its square root

Vector = NDArray[np.float64]


def _touching() -> tuple[Vector, Vector]:
    """Return origin and direction, float64[3] each, of a ray in the plane y = 0.

    The ray touches one of the tube's circles and passes the centre of the other.
    """
    slope = TUBE / math.sqrt(4.0 * RING**2 - TUBE**2)
    return np.array([RING, 0.0, 0.0]), np.array([1.0, 0.0, -slope])


CASES: dict[str, tuple[Vector, Vector]] = {  # a point of the ray, and its direction
    "four roots": (np.array([0.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.1])),
    "two roots, one minimum": (np.array([0.0, 0.9, 0.0]), np.array([1.0, 0.0, 0.0])),
    "two roots about a maximum below 0": (np.array([0.0, 0.5, 0.0]), np.array([1.0, 0.0, 0.0])),
    "two roots in the first minimum": (np.array([-RING, 0.0, 0.0]), np.array([1.0, 0.0, 0.25])),
    "two roots in the second minimum": (np.array([RING, 0.0, 0.0]), np.array([1.0, 0.0, -0.25])),
    "a touch, and two roots": _touching(),
    "no root, two minima": (np.array([0.0, 0.0, 0.38]), np.array([1.0, 0.0, 0.03])),
}


def quartic(o: Vector, v: Vector) -> Vector:
    """Compute T's coefficients of t^4 to 1, float64[n, 5], by equation 2.

    o, v: points and unit directions, float64[n, 3].
    """
    along, square = (o * v).sum(axis=1), (o * o).sum(axis=1)
    radii = RING**2 + TUBE**2
    c = 2.0 * (square - radii + 2.0 * along**2 + 2.0 * RING**2 * v[:, 2] ** 2)
    d = 4.0 * (along * (square - radii) + 2.0 * RING**2 * v[:, 2] * o[:, 2])
    e = (square - radii) ** 2 - 4.0 * RING**2 * (TUBE**2 - o[:, 2] ** 2)
    return np.stack([np.ones_like(c), 4.0 * along, c, d, e], axis=1)


def compute() -> list[dict[str, Any]]:
    """Return a row for each case, and a last row for the sampled rays.

    A case has case, coefficients, t_m, roots, extremes and bends (T'' = 0), t ascending. The sampled rays have rays,
    minima and maxima (the most of one ray), mean_error (the largest |t_M - mean of T''s roots|) and equation_error (the
    largest |T - f| over the largest |T| of its ray).
    """
    rows: list[dict[str, Any]] = []
    for name, (point, heading) in CASES.items():
        o, v = point[None], (heading / np.linalg.norm(heading))[None]
        coefficients = quartic(o, v)[0]
        rows.append(
            {
                "case": name,
                "coefficients": coefficients.tolist(),
                "t_m": -float((o * v).sum()),
                "roots": _real(coefficients),
                "extremes": _real(np.polyder(coefficients)),
                "bends": _real(np.polyder(coefficients, 2)),
            }
        )
    return [*rows, _sampled()]


def _real(coefficients: Vector) -> list[float]:
    """Return a polynomial's real roots, ascending, each once."""
    found = np.roots(coefficients)
    real = np.sort(found.real[np.abs(found.imag) < math.sqrt(REAL)])
    return [float(t) for i, t in enumerate(real) if i == 0 or t - real[i - 1] > math.sqrt(REAL)]


def _sampled() -> dict[str, Any]:
    """Return the row of the sampled rays."""
    import surfaces

    rng = np.random.default_rng(SEED)
    v = rng.normal(size=(SAMPLED, 3))
    v /= np.linalg.norm(v, axis=1)[:, None]
    o = rng.uniform(-1.0, 1.0, (SAMPLED, 3)) * [1.0, 1.0, TUBE]
    coefficients = quartic(o, v)
    t = np.linspace(-1.0, 1.0, 9)
    by_equation = np.stack([np.polyval(coefficients.T, at) for at in t])
    by_formula = np.stack([surfaces.evaluate(surfaces.get("torus"), o + at * v) for at in t])
    off = np.abs(by_equation - by_formula).max(axis=0) / np.abs(by_formula).max(axis=0)
    slopes = [np.roots(np.polyder(row)) for row in coefficients]
    mean = np.array([roots.mean().real for roots in slopes])
    rising = [
        [np.polyval(np.polyder(c, 2), x.real) for x in r if abs(x.imag) < REAL]
        for c, r in zip(coefficients, slopes, strict=True)
    ]
    return {
        "case": "sampled",
        "rays": SAMPLED,
        "minima": max(sum(bool(bend > 0.0) for bend in own) for own in rising),
        "maxima": max(sum(bool(bend < 0.0) for bend in own) for own in rising),
        "mean_error": float(np.abs(mean + (o * v).sum(axis=1)).max()),
        "equation_error": float(off.max()),
    }
