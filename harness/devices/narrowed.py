"""Launch rays behind a prepass, whose beams over tiles of the image leave to each ray the depths to be searched.

harness.kernels.prepass says which beams a prepass casts, and what a ray then knows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, Program
from harness.devices.interface import Array, Built, Device, Launch, Reserved, Step, hits_from, real_type
from harness.devices.messages import FirstRun, Frame, HitsCheck
from harness.devices.quadtree import LEVELS, first_level, last_level, quadtree_steps
from harness.kernels import prepass


@dataclass(frozen=True, eq=False)
class NarrowedFrame(Frame):
    """State a frame of one ray for each sample of a camera's image, narrowed by the beams of a prepass over it.

    before: the prepass's program
    program: the rays' program
    camera: float32[12] (eye, forward, right, up)
    size: samples per side
    """

    before: Program
    program: Program
    camera: NDArray[np.float32]
    size: int

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.before, self.program

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        before, rays = built
        return launch_narrowed_camera(device, (self.before, self.program), (before, rays), self.camera, self.size)


@dataclass(frozen=True, eq=False)
class NarrowedAnswer:
    """Hold what narrowed rays answered, and what the prepass spent.

    prepass_evaluations: the prepass's own, mean over the frame's pixels
    """

    hits: Hits
    prepass_evaluations: float


@dataclass(frozen=True, eq=False)
class NarrowedCheck(HitsCheck[NarrowedAnswer]):
    """State a check that casts listed rays, narrowed by the prepass of the frame whose pixels they lie in.

    frame: the frame whose prepass is run; its own program is not
    rays: float32[n, 6]
    pixels: int32[n], row * size + column of the pixel that each ray lies in
    """

    frame: NarrowedFrame
    program: Program
    rays: NDArray[np.float32]
    pixels: NDArray[np.int32]

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.frame.before, self.program

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        before, rays = built
        camera, size = self.frame.camera, self.frame.size
        return launch_narrowed_rays(device, self.programs, (before, rays), camera, size, self.rays, self.pixels)

    def hits(self, outputs: Sequence[Array]) -> Hits:
        return hits_from(outputs[:2])

    def answer(self, first: FirstRun) -> NarrowedAnswer:
        return NarrowedAnswer(first.hits, float(first.outputs[2].sum()) / self.frame.size**2)


def _prepass(device: Device, program: Program, built: Built, size: int) -> tuple[list[Step], list[Array | Reserved]]:
    """Return the prepass's steps over a size × size image, and its buffers behind the camera.

    The buffers are, with m tiles: their spans of depth, real[2 m]; the evaluations that tiles spent, int32[2 m]; the
    queue; and its counts, int32[LEVELS].
    """
    last, bits = last_level(size), prepass.tile_bits(program)
    stop = max(0, last - bits)
    steps, queue = quadtree_steps(device, built, size, first_level(device.info, stop), last, stop)
    values = 2 * prepass.tiles_per_side(size, bits) ** 2
    spans, spent = Reserved(values, real_type(program)), Reserved(values, np.int32)
    return steps, [spans, spent, Reserved(queue, np.int32), Reserved(LEVELS, np.int32)]


def launch_narrowed_camera(
    device: Device,
    programs: tuple[Program, ...],
    built: tuple[Built, Built],
    camera: NDArray[np.float32],
    size: int,
) -> Launch:
    """Launch a prepass, and the rays of a size × size image that are narrowed by it.

    programs, built: of the prepass, of the rays. Outputs: t and answer of each sample, for hits_from.
    """
    steps, scratch = _prepass(device, programs[0], built[0], size)
    outputs = [Reserved(size * size, real_type(programs[1])), Reserved(size * size, np.int32)]
    buffers: list[Array | Reserved] = [np.ascontiguousarray(camera, np.float32), *scratch, *outputs]
    return device.launch_steps(buffers, (5, 6), [*steps, Step(built[1], (0, 5, 6, 1), (size, size))])


def launch_narrowed_rays(
    device: Device,
    programs: tuple[Program, ...],
    built: tuple[Built, Built],
    camera: NDArray[np.float32],
    size: int,
    rays: NDArray[np.float32],
    pixels: NDArray[np.int32],
) -> Launch:
    """Launch a prepass, and listed rays float32[n, 6] narrowed by it, which lie in `pixels`, int32[n], of its image.

    programs, built: of the prepass, of the rays. Outputs: t and answer of each ray, for hits_from, and the evaluations
    that the prepass's tiles spent; they add up to all.
    """
    steps, scratch = _prepass(device, programs[0], built[0], size)
    row, column = np.divmod(pixels, size)
    bits = prepass.tile_bits(programs[0])
    tiles = ((row >> bits) * prepass.tiles_per_side(size, bits) + (column >> bits)).astype(np.int32)
    buffers: list[Array | Reserved] = [
        np.ascontiguousarray(camera, np.float32),
        *scratch,
        Reserved(2 * len(rays), real_type(programs[1])),
        Reserved(len(rays), np.int32),
        np.ascontiguousarray(rays, np.float32),
        tiles,
    ]
    cast = Step(built[1], (0, 5, 6, 1, 7, 8), (len(rays), 1))
    return device.launch_steps(buffers, (5, 6, 2), [*steps, cast])
