"""Make float32 rays that lie exactly where a rung says, with the same bytes on every machine.

Only +, -, *, / and sqrt are used, which IEEE 754 rounds in the same way everywhere: no libm, no BLAS, no reordered
sums. Points and directions are float64[..., 3] until `rounded` or `settled` makes rays of them.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Rays = NDArray[np.float32]

COUNT = 96  # rays of a rung
TO_1E_6 = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
TO_1E_7 = (*TO_1E_6, 1e-7)
TO_1E_8 = (*TO_1E_7, 1e-8)
REACH = 4  # float32 neighbours tried on each side of each coordinate of an origin
LEAST_STEP = 2.0**-30  # the step between neighbours near 0; smaller numbers gain nothing and may be flushed to 0


def uniform(rng: np.random.Generator, lower: float, upper: float) -> Floats:
    """Draw float64[COUNT], uniformly between two numbers."""
    return lower + (upper - lower) * rng.random(COUNT)


def signs(rng: np.random.Generator) -> Floats:
    """Draw float64[COUNT] of -1 and 1."""
    return np.where(rng.random(COUNT) < 0.5, -1.0, 1.0)


def halves() -> Floats:
    """Return float64[COUNT], 1 and -1 in turn, for the two halves of a rung's rays."""
    return np.where(np.arange(COUNT) % 2 == 0, 1.0, -1.0)


def dot(a: Floats, b: Floats) -> Floats:
    """Return the scalar products float64[...] of vectors float64[..., 3], summed from x to z."""
    product = a * b
    return np.asarray(product[..., 0] + product[..., 1] + product[..., 2])


def cross(a: Floats, b: Floats) -> Floats:
    """Return the vector products of vectors, all float64[..., 3]."""
    (ax, ay, az), (bx, by, bz) = np.moveaxis(a, -1, 0), np.moveaxis(b, -1, 0)
    return np.stack([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx], axis=-1)


def length(a: Floats) -> Floats:
    """Return the lengths float64[...] of vectors float64[..., 3]."""
    return np.asarray(np.sqrt(dot(a, a)))


def unit(a: Floats) -> Floats:
    """Return vectors float64[..., 3] divided by their lengths."""
    return a / length(a)[..., None]


def scaled(factor: Floats | float, a: Floats) -> Floats:
    """Multiply vectors a[n, 3] by factors, one for each or one for all."""
    return np.asarray(factor)[..., None] * a


def vectors(x: Floats | float, y: Floats | float, z: Floats | float) -> Floats:
    """Return float64[n, 3] of coordinates that are given as [n], or as one number for all."""
    return np.stack(np.broadcast_arrays(*map(np.float64, (x, y, z))), axis=-1)


def directions(rng: np.random.Generator) -> Floats:
    """Draw float64[COUNT, 3], unit vectors in all directions, denser towards the corners of a cube."""
    return unit(2.0 * rng.random((COUNT, 3)) - 1.0)


def circle(rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Draw COUNT angles all around, and return their cosines and sines, float64[COUNT] each.

    They are (1 - s²)/(1 + s²) and 2s/(1 + s²) of a uniform s, which needs no libm.
    """
    s, side = uniform(rng, -1.0, 1.0), signs(rng)
    return side * (1.0 - s * s) / (1.0 + s * s), 2.0 * s / (1.0 + s * s)


def across(direction: Floats, rng: np.random.Generator) -> Floats:
    """Draw a unit vector at right angles to each of COUNT unit vectors; both are float64[COUNT, 3]."""
    return unit(cross(direction, directions(rng)))


def rounded(origins: Floats, directions: Floats) -> Rays:
    """Return rays float32[n, 6] of origins and directions, float64[n, 3] or one for all, each coordinate rounded."""
    return np.concatenate(np.broadcast_arrays(origins, directions), axis=-1).astype(np.float32)


def settled(origins: Floats, directions: Floats, measure: Callable[[Floats], Floats], target: Floats | float) -> Rays:
    """Return rounded rays float32[n, 6], each origin moved to the float32 neighbour that measures nearest to `target`.

    `measure` maps float64[n, m, 6], which are m neighbours of each ray with the same direction, to float64[n, m].
    `target` is one number, or float64[n]. Rounding an origin of size 1 moves a ray by 1e-7. The neighbours' rays lie so
    densely that a distance of 1e-8 is reached to a few per cent.
    """
    rays = rounded(origins, directions)
    step = np.maximum(np.spacing(np.abs(rays[:, :3])), np.float32(LEAST_STEP))
    shifts = np.stack(np.meshgrid(*(np.arange(-REACH, REACH + 1, dtype=np.float32),) * 3, indexing="ij"), -1)
    near = np.repeat(rays[:, None], shifts.size // 3, axis=1)
    near[..., :3] += shifts.reshape(1, -1, 3) * step[:, None]
    best = np.argmin(np.abs(measure(near.astype(np.float64)) - np.asarray(target)[..., None]), axis=1)
    chosen: Rays = near[np.arange(len(rays)), best]
    return chosen


def distance_to_points(rays: Floats, points: Floats) -> Floats:
    """Return the distances at which the lines of rays[..., 6] pass points[..., 3]."""
    return length(cross(points - rays[..., :3], rays[..., 3:])) / length(rays[..., 3:])


def distance_to_z_axis(rays: Floats) -> Floats:
    """Return the distances at which the lines of rays[..., 6] pass the z axis, signed by the side they pass on."""
    ox, oy, _, dx, dy, _ = np.moveaxis(rays, -1, 0)
    return np.asarray((ox * dy - oy * dx) / np.sqrt(dx * dx + dy * dy))
