"""Beams held against rays: which pixel's beam holds an accuracy ray, and what its answer says of the ray.

A beam's hit says that f's interval extension cannot keep the surface out of a piece of the pixel's closed beam. A ray
in that beam may well pass the surface there. So, for a ray in the beam:

- where the ray hits, the beam must hit, and at no later depth (`no_missed_root`);
- |t - t*| is of the beam's depth, brought to the ray;
- a hit where the ray has none, or in front of its first, is `beam_only` where the ray's margin (the oracle's estimate
  of its distance from another answer) is no more than its distance from the beam's farthest edge there: the beam can
  see what the ray passes by. Further away it is a false hit or a wrong root as for any method.
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
    """The pixels of a size × size frame whose closed beams hold the rays of a coarser or finer grid of its view.

    Arrays are [n], a ray each, row by row from the top left.
    """

    index: NDArray[np.int32]  # row * size + column
    per_middle: Floats  # t along the ray, over t at the same depth along the ray through the pixel's middle
    reach: Floats  # distance from the ray to the pixel beam's farthest edge, over t


def pixels_of(camera: NDArray[np.float32], rays_per_side: int, size: int) -> Pixels:
    """For the rays of rays_of(camera, rays_per_side), in a frame of size × size pixels. camera: float32[12]."""
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
    """The answers of `pixels` with t along the rays that they hold."""
    return dataclasses.replace(hits, t=hits.t * pixels.per_middle)


def set_apart(verdicts: Verdicts, hits: Hits, truth: Truth, pixels: Pixels) -> tuple[Verdicts, NDArray[np.bool_]]:
    """Verdicts in which what only the beam can see is not wrong, and bool[n], those rays. `hits` are along the rays."""
    with np.errstate(invalid="ignore"):
        seen = truth.margin <= pixels.reach * hits.t
        in_front = (verdicts.wrong == Wrong.WRONG_ROOT) & (hits.t < truth.lower)
    beam_only = seen & ((verdicts.wrong == Wrong.FALSE_HIT) | in_front)
    wrong = np.where(beam_only, np.uint8(Wrong.RIGHT), verdicts.wrong)
    return dataclasses.replace(verdicts, wrong=wrong), beam_only
