"""Draw a surface's picture by one method: what `firsthit show`, `firsthit sheet` and firsthit.render share."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from harness import memory
from harness.accuracy.pictures import headlight
from harness.contract import FirsthitError, Hits, RayStatus, Surface, View
from harness.limits import PICTURE, held
from harness.running.trace import Caster, Tell, cast, ignore
from harness.scenes.camera import camera_for, rays_of

BACKGROUND = np.array([1.0, 1.0, 1.0])
LIT = np.array([0.36, 0.58, 0.82])
EXHAUSTED = np.array([0.84, 0.37, 0.0])
INVALID = np.array([1.0, 0.0, 1.0])
RAYS_PER_PIXEL = 4
BYTES_PER_RAY = 400  # of this process: 300 to 320 were measured for 1024x1024 rays


def shown_by(given: View | tuple[float, float]) -> View:
    """Return a View as it is, and for a pair of its azimuth and elevation, degrees, the view from there.

    Raises FirsthitError for anything else.
    """
    if isinstance(given, View):
        return given
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise FirsthitError(f"view is a View or its azimuth and elevation, as in (30, 30), not {given!r}")
    return View("shown", azimuth=given[0], elevation=given[1])


def picture(
    caster: Caster, surface: Surface, view: View, size: int, tell: Tell = ignore
) -> tuple[NDArray[np.uint8], Hits]:
    """Draw a surface with a light at the eye, on white: uint8[size, size, 3], row 0 at the top, and the hits.

    Each pixel is the mean of four rays, so there are 4 · size² hits. Rays that the method gave up are orange, answers
    that can be none magenta. `tell` is called with a sentence where the domain cuts the surface or has nothing of it,
    and where `cast` calls it. Raises FirsthitError for a size outside harness.limits.PICTURE or whose rays memory does
    not hold, and where `cast` does.
    """
    from surfaces.proofs.extent import remark

    size = held("size", size, Annotated[int, PICTURE])
    what = f"a picture of {size}x{size} pixels, with {RAYS_PER_PIXEL} rays each,"
    if reason := memory.refusal(BYTES_PER_RAY * RAYS_PER_PIXEL * size**2, what, "take a smaller size"):
        raise FirsthitError(reason, exit_code=3)
    if told := remark(surface):
        tell(told)
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
