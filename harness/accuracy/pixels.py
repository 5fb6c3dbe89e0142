"""Hold beams against rays: find the pixel whose beam holds an accuracy ray, and say what its answer means for the ray.

A beam's hit says only that f's interval extension cannot exclude the surface from a piece of the pixel's closed beam. A
ray in that beam may well pass the surface there. So these rules hold for a ray in the beam:

- If the ray hits, the beam must hit too, and at no later depth (`no_missed_root`).
- |t - t*| is computed from the beam's depth, brought to the ray.
- A hit where the ray has none, or in front of the ray's first hit, is `beam_only` if the ray's margin (the oracle's
  estimate of its distance from another answer) is no more than its distance from the beam's farthest edge there: the
  beam then holds the piece of surface that the ray passes by. Otherwise it is a false hit or a wrong root, as for any
  method.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.judge import Verdicts, Wrong
from harness.contract import Hits, Truth

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Pixels:
    """Hold the pixels of a size × size frame whose closed beams hold the rays of another grid over the same view.

    Arrays are [n], one value a ray, row by row from the top left.

    index: row * size + column
    per_middle: t along the ray, over t at the same depth along the ray through the pixel's middle
    reach: distance from the ray to the farthest edge of the pixel's beam, over t
    """

    index: NDArray[np.int32]
    per_middle: Floats
    reach: Floats


def pixels_of(camera: NDArray[np.float32], rays_per_side: int, size: int) -> Pixels:
    """Find the pixels of a size × size frame that hold the rays of rays_of(camera, rays_per_side).

    `camera` is float32[12] (eye, forward, right, up).
    """
    _, forward, right, up = camera.astype(np.float64).reshape(4, 3)
    twice = 2 * np.arange(rays_per_side) + 1  # a ray's place across the picture, in halves of its own pixels
    pixel = twice * size // (2 * rays_per_side)
    ray, middle = twice / rays_per_side - 1.0, (2 * pixel + 1) / size - 1.0
    farthest = np.abs(ray - middle) + 1.0 / size

    def lengths(at: Floats) -> Floats:
        directions = forward + at[None, :, None] * right - at[:, None, None] * up
        return np.asarray(np.linalg.norm(directions, axis=-1))

    across, down = farthest * np.linalg.norm(right), farthest * np.linalg.norm(up)
    reach = np.hypot(across[None, :], down[:, None]) / lengths(ray)
    index = pixel[:, None] * size + pixel[None, :]
    return Pixels(index.ravel().astype(np.int32), (lengths(ray) / lengths(middle)).ravel(), reach.ravel())


def along_rays(hits: Hits, pixels: Pixels) -> Hits:
    """Return the answers [n] of `pixels` with t along the rays that they hold."""
    return dataclasses.replace(hits, t=hits.t * pixels.per_middle)


def set_apart(verdicts: Verdicts, hits: Hits, truth: Truth, pixels: Pixels) -> tuple[Verdicts, NDArray[np.bool_]]:
    """Count as right the hits of beams on surface that the beam meets and its ray passes by.

    Returns the verdicts, and bool[n]: the hits that were wrong before. `hits` are along the rays.
    """
    with np.errstate(invalid="ignore"):
        seen = truth.margin <= pixels.reach * hits.t
        in_front = (verdicts.wrong == Wrong.WRONG_ROOT) & (hits.t < truth.lower)
    beam_only = seen & ((verdicts.wrong == Wrong.FALSE_HIT) | in_front)
    wrong = np.where(beam_only, np.uint8(Wrong.RIGHT), verdicts.wrong)
    return dataclasses.replace(verdicts, wrong=wrong), beam_only
