"""Cast beams: one for each pixel, or a quadtree of them over the image.

The check casts the whole frame. Each ray of the accuracy grid lies in the beam of a pixel, and that beam's answer,
brought to the ray, is held against the oracle (harness.accuracy.pixels).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated_beams
from harness.accuracy.check import Cast, Certified
from harness.accuracy.judge import Verdicts
from harness.accuracy.pixels import Pixels, along_rays, pixels_of, set_apart
from harness.contract import Hits, Program, Surface
from harness.devices.beams import BeamAnswer, BeamCheck, BeamFrame
from harness.devices.messages import Check, Checked, Frame
from harness.devices.quadtree import Layout, layout_of
from harness.devices.steps import Executor
from harness.experiment.kinds.model import Asked, Casting, Kind, RacedCasting
from harness.experiment.kinds.programs import Programs
from harness.experiment.kinds.shots import Shot, ShotKind
from harness.scenes.camera import rays_of


@dataclass(frozen=True)
class BeamMethods(ShotKind):
    """State what follows for methods whose kernel answers a cell of the image: `void cast_cell(Work, Cell)`."""

    quadtree: bool

    what = "beams"
    entries = ("beams",)
    shot_entries = ("beams",)
    unlisted = "casts the beams of a camera's pixels, and listed rays have none"
    undrawn = "casts the beams of a camera's pixels, and a fragment has one ray"

    def shot(self, programs: tuple[Program, ...], shot: Shot, index: NDArray[np.intp]) -> Check[BeamAnswer]:
        assert shot.camera is not None
        size, layout = math.isqrt(len(shot.rays)), layout_of(shot.knobs)
        return BeamCheck(BeamFrame(programs[0], shot.camera, size, self.quadtree, layout), index.astype(np.int32))

    def shot_hits(self, answer: BeamAnswer) -> Hits:
        return answer.hits

    def validated(self, hits: Hits, surface: Surface, shot: Shot) -> Hits:
        assert shot.camera is not None
        return validated_beams(hits, surface.domain, shot.rays, shot.camera[3:6])


@dataclass(frozen=True, eq=False)
class BeamCast(Cast):
    """Hold the answers of the beams that hold the grid's rays, brought to the rays.

    pixels: which pixel's beam holds each ray
    """

    pixels: Pixels

    def judged(self, verdicts: Verdicts, certified: Certified) -> tuple[Verdicts, dict[str, int]]:
        verdicts, beam_only = set_apart(verdicts, self.hits, certified.truth, self.pixels)
        return verdicts, {"beam_only": int(beam_only.sum())}


class BeamCasting(RacedCasting):
    """Cast the beams of a camera's image, or a quadtree of them."""

    def __init__(self, asked: Asked, check: Program, timed: Program | None, quadtree: bool, layout: Layout) -> None:
        super().__init__(asked, (check,), timed)
        self.quadtree, self.layout = quadtree, layout

    def _frame(self, program: Program) -> BeamFrame:
        return BeamFrame(program, self.camera, self.samples, self.quadtree, self.layout)

    def frame(self) -> Frame | None:
        assert self.timed
        return self._frame(self.timed)

    def cast(self, executor: Executor, size: int, free_loops: bool = False) -> Cast:
        surface, rays = self.cell.surface, rays_of(self.camera, size)
        pixels, frame = pixels_of(self.camera, size, self.samples), self._frame(self.check_program(free_loops))
        checked: Checked[BeamAnswer] = executor.check(self.cell.device, BeamCheck(frame, pixels.index))
        answer = checked.answer
        hits = beam_hits(answer.hits, pixels, surface, rays, self.camera)
        mean, largest = answer.evaluations  # over all pixels, since large beams are shared by unchecked ones
        facts = {"evaluations_mean": mean, "evaluations_max": largest, "lanes": answer.lanes}
        pictures = {"level": answer.levels.reshape(size, size)}
        return BeamCast(surface, rays, hits, checked.compile_ms, facts, pictures, pixels)

    def with_programs(self, programs: Programs) -> RacedCasting:
        layout = layout_of(programs.parameters)
        return BeamCasting(self.asked, programs.checks[0], programs.timed, self.quadtree, layout)


def beam_hits(
    hits: Hits, pixels: Pixels, surface: Surface, rays: NDArray[np.float32], camera: NDArray[np.float32]
) -> Hits:
    """Turn the answers of beams into answers for the rays float32[n, 6] that they hold; mark impossible ones INVALID.

    `camera` is float32[12].
    """
    return validated_beams(along_rays(hits, pixels), surface.domain, rays, camera[3:6])


@dataclass(frozen=True)
class Beams(Kind):
    """Make castings of beams, in stage compute."""

    quadtree: bool
    checked_on_frame = True

    def casting(self, asked: Asked) -> Casting:
        check = asked.program(asked.cell.surface, "beams")
        layout = layout_of(dict(asked.cell.variant.parameters))
        return BeamCasting(asked, check, asked.freed(check), self.quadtree, layout)
