"""Hard cases of the torus: near tangency, along its axis, with four hits, from on and inside it, thin, and from afar.

Where not said otherwise it is toledo2007's torus, R = 0.7 and r = 0.3, in a ball with room to spare: its own tight box
would add roots near the ends of the ray to every family.
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
AWAY = 2.0  # from where a ray starts to where it gets interesting
TOLEDO = "after toledo2007, section 4"


def roomy_torus(ring: str, tube: str) -> Surface:
    """The catalog's torus in a ball a quarter larger than it is."""
    torus = surfaces.get("torus", R=ring, r=tube)
    return replace(torus, domain=Sphere(1.25 * (float(ring) + float(tube))))


def distance_to_torus(points: Floats) -> Floats:
    """Signed, negative inside the tube; points[..., 3]."""
    x, y, z = np.moveaxis(points, -1, 0)
    from_core = np.sqrt(x * x + y * y) - RING
    return np.asarray(np.sqrt(from_core * from_core + z * z) - TUBE)


def points_and_normals(around: tuple[Floats, Floats], cosine: Floats, sine: Floats) -> tuple[Floats, Floats]:
    """Return the torus's points and normals at angles around its axis and its tube: cosines and sines, [n] each."""
    cu, su = around
    normals = vectors(cosine * cu, cosine * su, sine)
    return RING * vectors(cu, su, 0.0) + TUBE * normals, normals


def at_depth(points: Floats, normals: Floats, tangents: Floats, height: Floats | float) -> Rays:
    """Rays along tangents (unit vectors) whose least signed distance from the torus near `points` is `height`."""
    feet = points + scaled(height, normals)

    def least_distance(rays: Floats) -> Floats:
        o, d = rays[..., :3], rays[..., 3:]
        t = dot(feet[:, None] - o, d) / dot(d, d)  # where the distance is stationary, to second order
        return distance_to_torus(o + scaled(t, d))

    return settled(feet - AWAY * tangents, tangents, least_distance, height)


@family(
    "Grazing rays",
    "distance of the ray from tangency, scene units; half of the rays hit, half miss",
    TO_1E_8,
    why="hit and miss are decided by a dip of f as deep as the distance, and the two roots merge",
    is_margin=True,
)
def grazing(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """About tangents of the torus's outer half, which lie outside it on both sides of the contact."""
    cosine = uniform(rng, 0.1, 1.0)
    points, normals = points_and_normals(circle(rng), cosine, signs(rng) * np.sqrt(1.0 - cosine * cosine))
    return roomy_torus("0.7", "0.3"), at_depth(points, normals, across(normals, rng), level * halves())


@family(
    "Four hits",
    "depth of the first of two passes through the tube, scene units",
    TO_1E_8,
    why="the first two of four roots merge; a method that misses them answers with the third, a valid-looking hit",
    source=TOLEDO,
    is_margin=True,
)
def torus_four_hits(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Past the top of the near side of the tube, slightly downwards, and through the far side."""
    cu, su = circle(rng)
    cosine, up = uniform(rng, -0.3, -0.1), signs(rng)
    sine = up * np.sqrt(1.0 - cosine * cosine)
    points, normals = points_and_normals((cu, su), cosine, sine)
    inwards, sideways = vectors(-up * sine * cu, -up * sine * su, up * cosine), vectors(-su, cu, 0.0)
    tangents = unit(inwards + scaled(uniform(rng, -0.2, 0.2), sideways))
    return roomy_torus("0.7", "0.3"), at_depth(points, normals, tangents, -level)


@family(
    "Rays beside a tangent plane",
    "distance of the ray from a plane it is parallel to, which touches the torus along a circle, scene units; "
    "half of the rays are below it and hit, half above it and miss",
    TO_1E_8,
    why="two pairs of roots merge at once: f is nearly the square of a quadratic",
    is_margin=True,
)
def tangent_plane(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """The torus hangs below its tangent plane z = 0, so that float32 can tell the ray's height from the plane's."""
    torus = surfaces.from_formula(
        "(x^2 + y^2 + (z + r)^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)",
        "sphere:1.5",
        "torus_below_z0",
        {"R": "0.7", "r": "0.3"},
    )
    along, offset = vectors(*circle(rng), 0.0), uniform(rng, -0.4, 0.4)
    feet = scaled(offset, cross(along, vectors(0.0, 0.0, 1.0))) + vectors(0.0, 0.0, level * halves())
    return torus, rounded(feet - AWAY * along, along)


@family(
    "Rays of the axis and the equator",
    "distance of the ray from the torus's axis, and of every second ray from its equatorial plane, scene units",
    TO_1E_7,
    why="the odd coefficients of the quartic along the ray vanish by symmetry, and closed forms divide by them",
    source=TOLEDO,
)
def torus_axis(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """In turn: through the hole, as askew to the axis as it is off it; and across the axis, through the tube twice."""
    cosine, sine = circle(rng)
    aside, sideways = vectors(cosine, sine, 0.0), vectors(-sine, cosine, 0.0)
    through = (halves() > 0.0)[:, None]
    along = np.where(through, unit(vectors(0.0, 0.0, signs(rng)) + level * sideways), sideways)
    feet = level * np.where(through, aside, aside + vectors(0.0, 0.0, signs(rng)))
    return roomy_torus("0.7", "0.3"), settled(
        feet - AWAY * along, along, lambda rays: np.abs(distance_to_z_axis(rays)), level
    )


def _starting_at(height: float, rng: np.random.Generator) -> Rays:
    """Origins at a signed distance from the torus; every second direction heads for it, the others away from it."""
    points, normals = points_and_normals(circle(rng), *circle(rng))
    heading = directions(rng)
    cosine = dot(heading, normals)
    heading = unit(heading + scaled(np.where(cosine < 0.0, -0.3, 0.3), normals))  # no grazing ones
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
def origin_on_surface(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    return roomy_torus("0.7", "0.3"), _starting_at(level, rng)


@family(
    "Origin on the surface, inside",
    "depth of the ray's origin inside the tube, scene units",
    TO_1E_7,
    why="refracted rays: f has the other sign at the start, and a root lies just before or just behind it",
    is_margin=True,
)
def origin_inside(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    return roomy_torus("0.7", "0.3"), _starting_at(-level, rng)


@family(
    "Thin tori",
    "R/r",
    (10.0, 30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0),
    why="the hit is a short dip in a long ray, between samples, and f there is the small difference of large terms",
)
def thin_torus(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Aimed at the tube within 0.8 of its radius, and past it by 1.2 to 2 of them."""
    cu, su = circle(rng)
    heading = directions(rng)
    aside = unit(cross(heading, vectors(-su, cu, 0.0)))
    offset = np.where(halves() > 0.0, uniform(rng, 0.0, 0.8), uniform(rng, 1.2, 2.0)) / level
    return roomy_torus("1", repr(1.0 / level)), rounded(
        vectors(cu, su, 0.0) + scaled(offset, aside) - AWAY * heading, heading
    )


@family(
    "Far origins",
    "distance of the ray's origin, scene units (the torus has R = 2, r = 1)",
    (3.5, 28.0, 224.0, 1792.0, 14336.0, 114688.0, 917504.0),
    why="o + t·d cancels: the same picture must come out whatever the distance",
)
def far_origin(level: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """A picture of 15 × 15 pixels; on each rung exactly the same lines, their origins moved back along them.

    The direction is k·(2, 3, 6), 7k = 1 - 2⁻²⁴, and the origins lie on its multiples and a grid of 1/16: no rounding.
    """
    del rng  # a picture has no chance in it
    forward, right, up = (vectors(*axis) for axis in ((2.0, 3.0, 6.0), (3.0, -6.0, 2.0), (6.0, 2.0, -3.0)))
    column, row = (axis.ravel() / 16.0 for axis in np.meshgrid(np.arange(-7.0, 8.0), np.arange(7.0, -8.0, -1.0)))
    pixels = scaled(column, right) + scaled(row, up)
    return roomy_torus("2", "1"), rounded(pixels - level / 7.0 * forward, np.rint(2.0**24 / 7.0) / 2.0**24 * forward)
