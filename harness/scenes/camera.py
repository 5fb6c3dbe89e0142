"""Turn views into cameras, and cameras into rays.

The rays of an accuracy check are made here, once, in float32; every device is given the same list.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, Surface, View


def scene_radius(surface: Surface) -> float:
    """Return the length, in scene units, that relative errors and default distances refer to: a bounding radius."""
    return surface.bounding_radius or surface.domain.radius


def distance_of(view: View, surface: Surface) -> float:
    """Return the distance from the eye to the target, in scene units."""
    return scene_radius(surface) / math.sin(math.radians(view.fov) / 2.0) if view.distance is None else view.distance


def camera_for(view: View, surface: Surface) -> NDArray[np.float32]:
    """Return a view's camera, float32[12]: eye, forward, right and up.

    Forward has length 1; right and up are half the image's width and height at the distance 1. Up is as near to the z
    axis as it can be. Looking along the z axis, it is the limit along the view's azimuth, so that no view is singular.
    """
    azimuth, elevation = math.radians(view.azimuth), math.radians(view.elevation)
    half = math.radians(view.fov) / 2.0
    target = np.array(surface.domain.center if view.target is None else view.target)
    ca, sa, ce, se = math.cos(azimuth), math.sin(azimuth), math.cos(elevation), math.sin(elevation)
    backward = np.array([ce * ca, ce * sa, se])
    right = np.array([-sa, ca, 0.0])
    up = np.array([-se * ca, -se * sa, ce])
    parts = (target + distance_of(view, surface) * backward, -backward, math.tan(half) * right, math.tan(half) * up)
    return np.concatenate(parts).astype(np.float32)


def rays_of(camera: NDArray[np.float32], size: int) -> NDArray[np.float32]:
    """Return the rays through the middles of an image's pixels, row by row from the top left: float32[size * size, 6].

    `camera` is float32[12]. A ray is its origin, the eye, and its direction, of length 1.
    """
    eye, forward, right, up = camera.astype(np.float64).reshape(4, 3)
    at = (2.0 * np.arange(size) + 1.0 - size) / size
    directions = forward + at[None, :, None] * right - at[:, None, None] * up
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    rays = np.empty((size * size, 6), np.float32)
    rays[:, :3] = eye
    rays[:, 3:] = directions.reshape(-1, 3)
    return rays


def pixel_footprint(camera: NDArray[np.float32], size: int) -> float:
    """Return a pixel's height at the distance 1 from the eye, for an image of size × size pixels."""
    return 2.0 * float(np.linalg.norm(camera[9:12].astype(np.float64))) / size


def meets(domain: Domain, rays: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Return which rays float32[n, 6] run through the domain: bool[n].

    It is computed in float64 without error bounds, and so is good for counting rays, not for proofs.
    """
    origins, directions = np.split(rays.astype(np.float64), 2, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        if isinstance(domain, Box):
            at = [(np.array(corner) - origins) / directions for corner in (domain.lower, domain.upper)]
            enter, leave = np.fmin(*at).max(axis=1), np.fmax(*at).min(axis=1)
            return np.asarray((enter <= leave) & (leave >= 0.0))
        origins = origins - np.array(domain.center)
        along = -np.einsum("ij,ij->i", origins, directions) / np.einsum("ij,ij->i", directions, directions)
        nearest = np.linalg.norm(origins + along[:, None] * directions, axis=1)
        inside = np.linalg.norm(origins, axis=1) <= domain.radius
        return np.asarray((nearest <= domain.radius) & (inside | (along >= 0.0)))
