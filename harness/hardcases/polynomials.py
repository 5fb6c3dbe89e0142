"""Define families of hard rays along which the polynomial f(o + t d) is hard.

Its degree falls, its roots lie close together, its coefficients are tiny or huge, or it is flat.
"""

from __future__ import annotations

import numpy as np

import surfaces
from harness.contract import Surface
from harness.hardcases.model import Rays, family
from harness.hardcases.rays import (
    COUNT,
    TO_1E_7,
    across,
    circle,
    directions,
    halves,
    rounded,
    scaled,
    signs,
    uniform,
    unit,
    vectors,
)

TORUS = "((x^2 + y^2 + z^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2))"


@family(
    "Directions of lower degree",
    "sine of the angle between the ray and a plane in which the cubic along it becomes a quadratic",
    (1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 1e-20),
    why="the leading coefficient vanishes and a root goes to infinity; closed forms and deflation divide by it",
    source="D. Hilbert, S. Cohn-Vossen 1932; surface Monkey saddle",
)
def lower_degree(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Aim at the saddle z = x³ - 3xy². In the plane x = 0 the leading coefficient vanishes, since x divides it."""
    x, y = signs(rng) * uniform(rng, 0.2, 0.7), uniform(rng, -0.5, 0.5)
    cosine, sine = circle(rng)
    heading = np.sqrt(1.0 - value * value) * unit(vectors(0.0, cosine + 0.5 * np.sign(cosine), sine))
    heading += vectors(value * signs(rng), 0.0, 0.0)
    points = vectors(x, y, x * x * x - 3.0 * x * y * y)
    return surfaces.get("monkey_saddle"), rounded(points - 2.0 * heading, heading)


@family(
    "Clustered roots",
    "distance between two concentric spheres, scene units",
    TO_1E_7,
    why="f between the first two roots is as small as the square of their distance, and the condition grows inversely",
    is_margin=True,
)
def clustered_roots(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Aim at spheres of the radii 1 and 1 + value, which are met at angles of up to 45 degrees from the normal."""
    heading = directions(rng)
    feet = scaled(uniform(rng, 0.0, 0.7), across(heading, rng))
    return surfaces.get("two_spheres", gap=repr(value * (2.0 + value))), rounded(feet - 2.0 * heading, heading)


def _scaled_torus(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Return the torus with its equation multiplied by `value`, and rays that are the same for all factors."""
    torus = surfaces.from_formula(f"{value!r}*{TORUS}", "sphere:1.25", "scaled_torus", {"R": "0.7", "r": "0.3"})
    heading = directions(rng)
    feet = scaled(uniform(rng, 0.0, 1.0), across(heading, rng))
    return torus, rounded(feet - 2.0 * heading, heading)


@family(
    "Tiny coefficients",
    "factor of the torus's equation",
    (1.0, 1e-5, 1e-10, 1e-15, 1e-20, 1e-25, 1e-30),
    why="absolute thresholds on f pass everywhere, and products of coefficients underflow",
)
def tiny_coefficients(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Multiply the torus's equation by small factors."""
    return _scaled_torus(value, rng)


@family(
    "Huge coefficients",
    "factor of the torus's equation",
    (1.0, 1e5, 1e10, 1e15, 1e20, 1e25, 1e30),
    why="absolute thresholds on f never pass, and products of coefficients overflow float32",
)
def huge_coefficients(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Multiply the torus's equation by large factors."""
    return _scaled_torus(value, rng)


@family(
    "Along flat faces",
    "distance of the ray from a face of the 16-ball that it is parallel to, scene units; "
    "half of the rays are below it and hit, half above it and miss",
    (2.0**-4, 2.0**-7, 2.0**-10, 2.0**-13, 2.0**-16, 2.0**-20, 2.0**-23),
    why="f stays within rounding of 0 over a large part of the ray, on either side of it",
    source="szente, Table 3; surface 16-ball",
    is_margin=True,
)
def flat_faces(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast along each of the six faces, past its middle by up to 0.3.

    The last value, 2⁻²³, is the float32 spacing above 1, so that no float32 ray is nearer.
    """
    cosine, sine = circle(rng)
    aside = uniform(rng, -0.3, 0.3)
    height = signs(rng) * (1.0 + value * halves())
    origins = vectors(height, -sine * aside - 2.0 * cosine, cosine * aside - 2.0 * sine)
    rays = np.stack([origins, vectors(0.0, cosine, sine)], axis=1)
    turn = (np.arange(3) - np.arange(COUNT)[:, None] // 2) % 3  # the axis of the face is x, y and z in turn
    rays = np.take_along_axis(rays, turn[:, None, :], axis=2)
    return surfaces.get("sixteen_ball"), rounded(rays[:, 0], rays[:, 1])
