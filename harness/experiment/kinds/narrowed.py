"""Cast rays behind a prepass, whose beams over tiles of the image narrow each ray before its method is called.

The check lists rays, and narrows them by the prepass of the frame that is timed.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated
from harness.accuracy.check import Cast
from harness.accuracy.compilers import SecondBuild
from harness.accuracy.pixels import pixels_of
from harness.contract import FirsthitError, Hits, Program
from harness.devices.messages import Frame
from harness.devices.narrowed import NarrowedCheck, NarrowedFrame
from harness.devices.steps import Executor
from harness.experiment.kinds.model import Asked, Casting, Kind, ViewCasting
from harness.experiment.kinds.programs import Programs
from harness.kernels import prepass
from harness.kernels.assemble import Language
from harness.scenes.camera import rays_of

REFUSAL = "a prepass narrows the rays of a camera's pixels, in the stage compute"


class NarrowedCasting(ViewCasting):
    """Cast rays of a camera's image, narrowed by the prepass's program `before`."""

    not_raced = "rays behind a prepass are not raced"

    def __init__(
        self, asked: Asked, check: Program, timed: Program | None, before: Program, *, former: bool = False
    ) -> None:
        """State with `former` that the programs are another revision's."""
        super().__init__(asked, (check,), timed)
        self.before, self.former = before, former

    @property
    def others(self) -> tuple[Program, ...]:
        return (self.before,)

    def _frame(self) -> NarrowedFrame:
        assert self.timed
        return NarrowedFrame(self.before, self.timed, self.camera, self.samples)

    def frame(self) -> Frame | None:
        return self._frame()

    def cast(self, executor: Executor, size: int, free_loops: bool = False) -> Cast:
        surface, rays = self.cell.surface, rays_of(self.camera, size)
        pixels = pixels_of(self.camera, size, self.samples)
        check = NarrowedCheck(self._frame(), self.check_program(free_loops), rays, pixels.index)
        checked = executor.check(self.cell.device, check)
        hits = validated(checked.answer.hits, surface.domain, rays, counts=False, origin=self.cell.origin)
        facts = {"prepass_evaluations_mean": checked.answer.prepass_evaluations}
        return Cast(surface, rays, hits, checked.compile_ms, facts, {})

    def second_build(self, executor: Executor, cast: Cast) -> SecondBuild | None:
        """Cast again behind the same prepass, since a method that iterates may answer otherwise from another start."""
        if self.former:
            return None
        cell, pixels = self.cell, pixels_of(self.camera, math.isqrt(len(cast.rays)), self.samples).index

        def programs(language: Language) -> tuple[Program, ...]:
            before = prepass.program(cell.surface, cell.precision, language)
            return before, self.asked.program(cell.surface, "rays", language, prepass.parameters())

        def run(device: str, programs: tuple[Program, ...], index: NDArray[np.intp]) -> Hits:
            before, check = programs
            frame = NarrowedFrame(before, check, self.camera, self.samples)
            return executor.check(device, NarrowedCheck(frame, check, cast.rays[index], pixels[index])).answer.hits

        return SecondBuild(cell.device, cell.precision, programs, run)

    def with_programs(self, programs: Programs) -> Casting:
        if len(programs.others) != 1:
            raise FirsthitError("that revision does not hand over its prepass")
        return NarrowedCasting(self.asked, programs.checks[0], programs.timed, programs.others[0], former=True)


class Narrowed(Kind):
    """Make castings of rays behind a prepass, in stage compute."""

    checked_on_frame = True

    def unable(self, asked: Asked) -> str | None:
        return None if asked.method.casts == "rays" and asked.cell.stage == "compute" else REFUSAL

    def casting(self, asked: Asked) -> Casting:
        cell = asked.cell
        check, timed = (
            asked.program(cell.surface, entry, narrowed=prepass.parameters()) for entry in ("rays", "camera")
        )
        stated = cell.surface, cell.precision, asked.language
        first = asked.shared.once(("prepass", *stated), lambda: asked.shared.program(prepass.program(*stated)))
        return NarrowedCasting(asked, check, timed, first)
