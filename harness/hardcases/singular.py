"""Define families of hard rays near singular points: a double plane, double points, nodes, a cusp and a double line.

The coordinates of the singular points are dyadic numbers, so that neither the surface nor a ray is rounded.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import surfaces
from harness.contract import Sphere, Surface
from harness.hardcases.model import Rays, family
from harness.hardcases.rays import (
    COUNT,
    TO_1E_6,
    TO_1E_7,
    Floats,
    across,
    circle,
    cross,
    directions,
    distance_to_points,
    distance_to_z_axis,
    halves,
    rounded,
    scaled,
    settled,
    signs,
    uniform,
    unit,
    vectors,
)
from harness.hardcases.tori import roomy_torus

NEAR = 0.25  # from a ray's origin to the singular point: near enough that no other sheet is in the way
PASSING = "distance at which the ray passes the singular point, scene units"
NODE = "two sheets meet in a cone: roots merge, the gradient vanishes with them, and no step that divides by it is safe"


def _passing(points: Floats, along: Floats, value: float, rng: np.random.Generator, start: float = NEAR) -> Rays:
    """Return rays float32[COUNT, 6] along unit vectors that pass `points` at the distance `value`.

    `points` and `along` are float64[COUNT, 3]. Rays start at the length `start` before they pass.
    """
    feet = points + value * across(along, rng)
    return settled(feet - start * along, along, lambda rays: distance_to_points(rays, points[:, None]), value)


@family(
    "Double roots",
    "sine of the angle between the ray and a plane, squared",
    (1.0, *TO_1E_6),
    why="f touches 0 and never changes sign; the flatter the ray, the longer f stays at rounding level",
)
def double_root(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Aim at the squared plane x + 2y + 2z = 0, within 0.4 of its middle. Flatter rays would miss the domain."""
    normal, first, second = (vectors(*row) / 3.0 for row in ((1.0, 2.0, 2.0), (2.0, 1.0, -2.0), (2.0, -2.0, 1.0)))
    cosine, sine = circle(rng)
    flat = scaled(cosine, first) + scaled(sine, second)
    along = np.sqrt(1.0 - value * value) * flat + scaled(value * signs(rng), normal)
    points = scaled(uniform(rng, -0.4, 0.4), scaled(sine, first) - scaled(cosine, second))
    return surfaces.get("plane_squared"), rounded(points - 2.0 * along, along)


@family(
    "Horn torus",
    PASSING,
    TO_1E_7,
    why="the hole has shrunk to a point where the tube touches itself; along the axis two roots merge like its square",
    source="degenerate torus, R = r = 0.5",
    is_margin=True,
)
def horn_torus(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast in turn parallel to the axis, down the horn, and from inside the tube in all directions."""
    centre = np.zeros((COUNT, 3))
    horn = _passing(centre, vectors(0.0, 0.0, signs(rng)), value, rng, start=1.0)
    inside = _passing(centre, directions(rng), value, rng)
    return roomy_torus("0.5", "0.5"), np.where((halves() > 0.0)[:, None], horn, inside)


@family(
    "Spindle torus",
    PASSING,
    TO_1E_7,
    why=NODE,
    is_margin=True,
    source="degenerate torus, R = 0.375, r = 0.625: nodes at z = ±0.5",
)
def spindle_torus(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Pass the two nodes on the axis in all directions."""
    return roomy_torus("0.375", "0.625"), _passing(vectors(0.0, 0.0, 0.5 * signs(rng)), directions(rng), value, rng)


@family("Nodes of the Cayley cubic", PASSING, TO_1E_7, why=NODE, is_margin=True, source="A. Cayley 1869")
def nodes_cayley(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Pass the nodes (±1, ±1, ±1)/2 with an odd number of minus signs, in all directions."""
    x, y = signs(rng), signs(rng)
    return surfaces.get("cayley"), _passing(0.5 * vectors(x, y, -x * y), directions(rng), value, rng)


@family("Nodes of a Kummer quartic", PASSING, TO_1E_7, why=NODE, is_margin=True, source="E. E. Kummer 1864; mu² = 1.25")
def nodes_kummer(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Pass the four nodes (0, ±1/2, 1) and (±1/2, 0, -1), in all directions."""
    side, half = signs(rng), 0.5 * signs(rng)
    nodes = vectors(np.where(side < 0.0, half, 0.0), np.where(side > 0.0, half, 0.0), side)
    return surfaces.get("kummer", mu2="1.25"), _passing(nodes, directions(rng), value, rng)


@family("Nodes of the Barth sextic", PASSING, TO_1E_7, why=NODE, is_margin=True, source="W. Barth 1996")
def nodes_barth(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Pass the nodes at ±1 on each axis, in all directions."""
    axis = np.eye(3)[np.arange(COUNT) % 3]
    return surfaces.get("barth_sextic"), _passing(scaled(signs(rng), axis), directions(rng), value, rng)


@family(
    "Cusp",
    "distance at which the ray passes the tip of the Zitrus, scene units",
    TO_1E_7,
    why="the surface is a thread whose radius falls like distance^1.5, under any step and any tolerance",
    source="H. Hauser; surface Zitrus",
)
def cusp(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Cast at right angles to the thread, along x and z in turn, past its axis at 0.5 to 1.5 of its radius.

    Along x and z, float32 rays can be aimed at the thread.
    """
    y = value * uniform(rng, 1.0, 1.5)
    aside = uniform(rng, 0.5, 1.5) * signs(rng) * y * np.sqrt(y) * np.sqrt((1.0 - y) * (1.0 - y) * (1.0 - y))
    side, along_x = signs(rng), halves() > 0.0
    origins = np.where(along_x[:, None], vectors(-0.5 * side, y, aside), vectors(aside, y, -0.5 * side))
    along = np.where(along_x[:, None], vectors(side, 0.0, 0.0), vectors(0.0, 0.0, side))
    return replace(surfaces.get("zitrus"), domain=Sphere(0.5, (0.0, 0.5, 0.0))), rounded(origins, along)


@family(
    "Double line",
    "distance at which the ray passes the double line, scene units; "
    "half of the rays where two sheets cross in it, half where it is a handle that is not met",
    TO_1E_7,
    why="two sheets cross along a line: roots merge, and f has no sign change at all where the line goes on alone",
    source="H. Whitney 1943; surface Whitney umbrella, domain a ball",
    is_margin=True,
)
def double_line(value: float, rng: np.random.Generator) -> tuple[Surface, Rays]:
    """Pass the z axis in turn at heights of 0.25 to 0.75, where sheets cross, and at the handle, -0.75 to -0.25."""
    cosine, sine = circle(rng)
    along = unit(vectors(cosine, sine, uniform(rng, -0.6, 0.6)))
    aside = scaled(signs(rng), unit(cross(along, vectors(0.0, 0.0, 1.0))))
    feet = value * aside + vectors(0.0, 0.0, halves() * uniform(rng, 0.25, 0.75))
    umbrella = replace(surfaces.get("whitney_umbrella"), domain=Sphere(1.5))
    return umbrella, settled(feet - along, along, lambda rays: np.abs(distance_to_z_axis(rays)), value)
