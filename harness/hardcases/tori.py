"""Define families of hard rays at tori: near tangency, near the axis, with four hits, from origins on the torus, at
thin tori, and from far away.

The torus is that of toledo2007 with R = 0.7 and r = 0.3, unless a family says otherwise. Its domain is a ball larger
than the torus: in its own tight box every family would also have roots near the ends of its rays.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import surfaces
from harness.contract import Sphere, Surface
from harness.hardcases.model import Rays, family
from harness.hardcases.rays import (
    TO_1E_7,
    TO_1E_8,
    Floats,
    across,
    circle,
    cross,
    directions,
    distance_to_z_axis,
    dot,
    halves,
    rounded,
    scaled,
    settled,
    signs,
    uniform,
    unit,
    vectors,
)

RING, TUBE = 0.7, 0.3
AWAY = 2.0  # from a ray's origin to the point that makes it hard, scene units
TOLEDO = "after toledo2007, section 4"


def roomy_torus(ring: str, tube: str) -> Surface:
    """Return the catalog's torus in a ball whose radius is a quarter larger than the torus's."""
    torus = surfaces.get("torus", R=ring, r=tube)
    return replace(torus, domain=Sphere(1.25 * (float(ring) + float(tube))))


def distance_to_torus(points: Floats) -> Floats:
    """Return the signed distances of points[..., 3] from the torus, negative inside the tube."""
    x, y, z = np.moveaxis(points, -1, 0)
    from_core = np.sqrt(x * x + y * y) - RING
    return np.asarray(np.sqrt(from_core * from_core + z * z) - TUBE)


def points_and_normals(around: tuple[Floats, Floats], cosine: Floats, sine: Floats) -> tuple[Floats, Floats]:
    """Return points and normals of the torus, float64[n, 3] each.

    `around` holds the cosines and sines, [n] each, of the angles about the axis; `cosine` and `sine` those about the
    tube.
    """
    cu, su = around
    normals = vectors(cosine * cu, cosine * su, sine)
    return RING * vectors(cu, su, 0.0) + TUBE * normals, normals


def at_depth(points: Floats, normals: Floats, tangents: Floats, height: Floats | float) -> Rays:
    """Return rays along tangents, unit vectors, whose least signed distance from the torus near `points` is `height`.

    `points`, `normals` and `tangents` are float64[COUNT, 3].
    """
    feet = points + scaled(height, normals)

    def least_distance(rays: Floats) -> Floats:
        o, d = rays[..., :3], rays[..., 3:]
        t = dot(feet[:, None] - o, d) / dot(d, d)  # where the distance is least, to second order
        return distance_to_torus(o + scaled(t, d))

    return settled(feet - AWAY * tangents, tangents, least_distance, height)


@family(
    "Grazing rays",
    "distance of the ray from tangency, scene units; half of the rays hit, half miss",
    TO_1E_8,
    why="hit and miss are decided by a dip of f as deep as the distance, and the two roots merge",
    is_margin=True,
)
def grazing(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Shift tangents of the torus's outer half outwards and inwards. Such a tangent lies outside the torus."""
    cosine = uniform(rng, 0.1, 1.0)
    points, normals = points_and_normals(circle(rng), cosine, signs(rng) * np.sqrt(1.0 - cosine * cosine))
    return roomy_torus("0.7", "0.3"), at_depth(points, normals, across(normals, rng), value * halves())


@family(
    "Four hits",
    "depth of the first of two passes through the tube, scene units",
    TO_1E_8,
    why="the first two of four roots merge; a method that misses them answers with the third, a valid-looking hit",
    source=TOLEDO,
    is_margin=True,
)
def torus_four_hits(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast slightly downwards: rays just enter the near side of the tube at its top, then meet the far side."""
    cu, su = circle(rng)
    cosine, up = uniform(rng, -0.3, -0.1), signs(rng)
    sine = up * np.sqrt(1.0 - cosine * cosine)
    points, normals = points_and_normals((cu, su), cosine, sine)
    inwards, sideways = vectors(-up * sine * cu, -up * sine * su, up * cosine), vectors(-su, cu, 0.0)
    tangents = unit(inwards + scaled(uniform(rng, -0.2, 0.2), sideways))
    return roomy_torus("0.7", "0.3"), at_depth(points, normals, tangents, -value)


@family(
    "Rays beside a tangent plane",
    "distance of the ray from a plane it is parallel to, which touches the torus along a circle, scene units; "
    "half of the rays are below it and hit, half above it and miss",
    TO_1E_8,
    why="two pairs of roots merge at once: f is nearly the square of a quadratic",
    is_margin=True,
)
def tangent_plane(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast parallel to z = 0, which touches the torus: float32 numbers near 0 are dense enough for a ray's height."""
    torus = surfaces.from_formula(
        "(x^2 + y^2 + (z + r)^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)",
        "sphere:1.5",
        "torus_below_z0",
        {"R": "0.7", "r": "0.3"},
    )
    along, offset = vectors(*circle(rng), 0.0), uniform(rng, -0.4, 0.4)
    feet = scaled(offset, cross(along, vectors(0.0, 0.0, 1.0))) + vectors(0.0, 0.0, value * halves())
    return torus, rounded(feet - AWAY * along, along)


@family(
    "Rays of the axis and the equator",
    "distance of the ray from the torus's axis, and of every second ray from its equatorial plane, scene units",
    TO_1E_7,
    why="the odd coefficients of the quartic along the ray vanish by symmetry, and closed forms divide by them",
    source=TOLEDO,
)
def torus_axis(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast in turn through the hole, nearly along the axis, and across the axis, nearly in the equatorial plane.

    With the parameter d, a ray through the hole passes the axis at the distance d and leans by the slope d. A ray
    across the axis passes the axis and the equatorial plane at the distance d each, and meets the tube twice.
    """
    cosine, sine = circle(rng)
    aside, sideways = vectors(cosine, sine, 0.0), vectors(-sine, cosine, 0.0)
    through = (halves() > 0.0)[:, None]
    along = np.where(through, unit(vectors(0.0, 0.0, signs(rng)) + value * sideways), sideways)
    feet = value * np.where(through, aside, aside + vectors(0.0, 0.0, signs(rng)))
    return roomy_torus("0.7", "0.3"), settled(
        feet - AWAY * along, along, lambda rays: np.abs(distance_to_z_axis(rays)), value
    )


def _starting_at(height: float, rng: np.random.Generator) -> Rays:
    """Return rays with origins at a signed distance from the torus, in turn towards it and away from it."""
    points, normals = points_and_normals(circle(rng), *circle(rng))
    heading = directions(rng)
    cosine = dot(heading, normals)
    heading = unit(heading + scaled(np.where(cosine < 0.0, -0.3, 0.3), normals))  # none of them grazes the torus
    heading = scaled(halves() * np.sign(height) * np.sign(-cosine), heading)
    return settled(
        points + height * normals, heading, lambda rays: distance_to_torus(rays[..., :3]), np.full(len(points), height)
    )


@family(
    "Origin on the surface, outside",
    "distance of the ray's origin from the torus, scene units",
    TO_1E_7,
    why="shadow rays: the root just behind the origin must not be taken, the one just in front must not be skipped",
    is_margin=True,
)
def origin_on_surface(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Start rays just outside the torus."""
    return roomy_torus("0.7", "0.3"), _starting_at(value, rng)


@family(
    "Origin on the surface, inside",
    "depth of the ray's origin inside the tube, scene units",
    TO_1E_7,
    why="refracted rays: f has the other sign at the start, and a root lies just before or just behind it",
    is_margin=True,
)
def origin_inside(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Start rays just inside the tube."""
    return roomy_torus("0.7", "0.3"), _starting_at(-value, rng)


@family(
    "Thin tori",
    "R/r",
    (10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0),
    why="the hit is a short dip in a long ray, between samples, and f there is the small difference of large terms",
)
def thin_torus(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Aim in turn at the tube, within 0.8 of its radius from its core, and past it, at 1.2 to 2 radii from its core."""
    cu, su = circle(rng)
    heading = directions(rng)
    aside = unit(cross(heading, vectors(-su, cu, 0.0)))
    offset = np.where(halves() > 0.0, uniform(rng, 0.0, 0.8), uniform(rng, 1.2, 2.0)) / value
    return roomy_torus("1", repr(1.0 / value)), rounded(
        vectors(cu, su, 0.0) + scaled(offset, aside) - AWAY * heading, heading
    )


@family(
    "Far origins",
    "distance of the ray's origin, scene units (the torus has R = 2, r = 1)",
    (3.5, 28.0, 224.0, 1792.0, 14336.0, 114688.0, 917504.0),
    why="o + t·d cancels: the same picture must come out whatever the distance",
)
def far_origin(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast parallel rays in 15 × 15 lines, which are exactly the same on each rung; only the origins move back on them.

    The direction is k·(2, 3, 6) with 7k = 1 - 2⁻²⁴. Each origin is a point of a grid of 1/16 minus a multiple of
    (2, 3, 6). So nothing is rounded.
    """
    del rng  # nothing here is random
    forward, right, up = (vectors(*axis) for axis in ((2.0, 3.0, 6.0), (3.0, -6.0, 2.0), (6.0, 2.0, -3.0)))
    column, row = (axis.ravel() / 16.0 for axis in np.meshgrid(np.arange(-7.0, 8.0), np.arange(7.0, -8.0, -1.0)))
    pixels = scaled(column, right) + scaled(row, up)
    return roomy_torus("2", "1"), rounded(pixels - value / 7.0 * forward, np.rint(2.0**24 / 7.0) / 2.0**24 * forward)
