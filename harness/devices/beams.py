"""Launch frames of beams, one for each pixel or a quadtree of them, and read what a frame answers for chosen pixels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, Program
from harness.devices import lanes
from harness.devices.interface import Array, Built, Device, Launch
from harness.devices.messages import FirstRun, Frame, HitsCheck
from harness.devices.quadtree import BY_DEVICE, Layout, beam_hits_from, last_level, launch_beams, start_of
from harness.results.row import Lane


@dataclass(frozen=True, eq=False)
class BeamFrame(Frame):
    """State a frame of beams: one for each pixel of a camera's image, or a quadtree of them.

    camera: float32[12] (eye, forward, right, up)
    size: pixels per side
    layout: how the quadtree's cells are laid over levels and work items
    """

    program: Program
    camera: NDArray[np.float32]
    size: int
    quadtree: bool
    layout: Layout = BY_DEVICE

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        return launch_beams(device, self.program, built[0], self.camera, self.size, self.quadtree, self.layout)


@dataclass(frozen=True, eq=False)
class BeamAnswer:
    """Hold what a frame of beams answered for n chosen pixels, and what it spent on all of its pixels.

    hits: [n], t along the ray through the pixel's middle
    levels: uint8[n], the level of the quadtree at which each pixel was decided
    evaluations: mean and largest number over the frame's pixels, as Hits.spent returns them
    lanes: what the work items of each level spend, as lanes.summary returns it; None if an answer is INVALID
    """

    hits: Hits
    levels: NDArray[np.uint8]
    evaluations: tuple[float | None, int]
    lanes: list[Lane] | None


@dataclass(frozen=True, eq=False)
class BeamCheck(HitsCheck[BeamAnswer]):
    """State a check that casts a frame of beams and reads the answers of chosen pixels, int32[n]."""

    frame: BeamFrame
    pixels: NDArray[np.int32]

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.frame.programs

    def launch(self, device: Device, built: Sequence[Built]) -> Launch:
        frame = self.frame
        stated = frame.program, built[0], frame.camera, frame.size, frame.quadtree, frame.layout
        return launch_beams(device, *stated, blank=True, queues=True)

    def hits(self, outputs: Sequence[Array]) -> Hits:
        return beam_hits_from(outputs)[0]

    def answer(self, first: FirstRun) -> BeamAnswer:
        frame, pixels, hits = self.frame, self.pixels, first.hits
        _, levels = beam_hits_from(first.outputs)
        start = start_of(first.info, frame.size, frame.quadtree, frame.layout)
        tree = lanes.Tree(frame.size, start, last_level(frame.size), frame.layout.grouped)
        picked = Hits(hits.t[pixels], hits.status[pixels], hits.evaluations[pixels])
        return BeamAnswer(picked, levels[pixels], hits.spent, lanes.of_frame(tree, hits, levels, first.outputs))
