"""Draw a surface's picture by one method: what `firsthit show`, `firsthit sheet` and firsthit.render share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.pictures import headlight
from harness.contract import FirsthitError, Hits, RayStatus, Surface, View
from harness.running.trace import Caster, Tell, cast, ignore
from harness.scenes.camera import camera_for, rays_of

MOST_PIXELS = 8192  # a side
BACKGROUND = np.array([1.0, 1.0, 1.0])
LIT = np.array([0.36, 0.58, 0.82])
EXHAUSTED = np.array([0.84, 0.37, 0.0])
INVALID = np.array([1.0, 0.0, 1.0])


def picture(
    caster: Caster, surface: Surface, view: View, size: int, tell: Tell = ignore
) -> tuple[NDArray[np.uint8], Hits]:
    """Draw a surface with a light at the eye, on white: uint8[size, size, 3], row 0 at the top, and the hits.

    Each pixel is the mean of four rays, so there are 4 · size² hits. Rays that the method gave up are orange, answers
    that can be none magenta. Raises FirsthitError for a size or a field of view that no picture has, and where `cast`
    does.
    """
    if not 1 <= size <= MOST_PIXELS:
        raise FirsthitError(f"size {size}: an image has 1 to {MOST_PIXELS} pixels per side")
    if not 0.0 < view.fov < 180.0:
        raise FirsthitError(f"fov {view.fov:g}: the angle lies between 0 and 180 degrees")
    camera = camera_for(view, surface)
    rays = rays_of(camera, 2 * size)
    hits = cast(caster, surface, rays, camera, tell=tell)
    colours = _colours(headlight(surface, rays, hits), hits.status).reshape(size, 2, size, 2, 3)
    return np.round(255.0 * colours.mean(axis=(1, 3))).astype(np.uint8), hits


def _colours(shade: NDArray[np.float32], status: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Colour each ray, float64[n, 3] in [0, 1], by the cosine `shade`, float32[n], and what was answered."""
    lit = LIT * (0.25 + 0.75 * np.nan_to_num(shade)[:, None])
    colours = np.where((status == RayStatus.HIT)[:, None], lit, BACKGROUND)
    colours[status == RayStatus.EXHAUSTED] = EXHAUSTED
    colours[status == RayStatus.INVALID] = INVALID
    return colours
