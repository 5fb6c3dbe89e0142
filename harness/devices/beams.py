"""Frames of beams: one for each pixel, or a quadtree of them, and what a frame says of each pixel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, Program
from harness.devices import lanes
from harness.devices.interface import Array, Device, Launch
from harness.devices.messages import FirstRun, Frame, HitsCheck
from harness.devices.quadtree import BY_DEVICE, Layout, beam_hits_from, last_level, launch_beams, start_of
from harness.results.row import Lane


@dataclass(frozen=True, eq=False)
class BeamFrame(Frame):
    """A beam for each pixel of a camera's image, or a quadtree of them."""

    program: Program
    camera: NDArray[np.float32]  # [12]
    size: int  # pixels per side
    quadtree: bool
    layout: Layout = BY_DEVICE

    @property
    def programs(self) -> tuple[Program, ...]:
        return (self.program,)

    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
        return launch_beams(device, self.program, built[0], self.camera, self.size, self.quadtree, self.layout)


@dataclass(frozen=True, eq=False)
class BeamAnswer:
    """Holds what a frame of beams answered for n chosen pixels, and what it spent on all."""

    hits: Hits  # [n]; t along the ray through the pixel's middle
    levels: NDArray[np.uint8]  # [n] of the quadtree, at which each pixel was decided
    evaluations: tuple[float | None, int]  # mean and largest over the frame's pixels, as Hits.spent
    lanes: list[Lane] | None  # what each level's work items spend, as lanes.summary


@dataclass(frozen=True, eq=False)
class BeamCheck(HitsCheck[BeamAnswer]):
    """A frame of beams, and what it says of chosen pixels."""

    frame: BeamFrame
    pixels: NDArray[np.int32]  # [n]

    @property
    def programs(self) -> tuple[Program, ...]:
        return self.frame.programs

    def launch(self, device: Device, built: Sequence[Any]) -> Launch:
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
