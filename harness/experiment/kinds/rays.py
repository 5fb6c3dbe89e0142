"""Cast rays, each by itself, from a camera's image or from a list.

The checked program takes listed rays. In stage compute the timed one makes the same rays from the camera.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness import memory
from harness.accuracy.answers import validated
from harness.accuracy.check import Cast
from harness.accuracy.compilers import SecondBuild, with_listed_rays
from harness.contract import FirsthitError, Hits, Method, Origin, Program, Surface, Variant, plural
from harness.devices.messages import CameraFrame, Check, Frame, ListedCheck, ListedFrame
from harness.devices.steps import Executor
from harness.experiment.config import Experiment
from harness.experiment.kinds.drawing import Drawing
from harness.experiment.kinds.methods import Rastering
from harness.experiment.kinds.model import Asked, Casting, Kind, RacedCasting
from harness.experiment.kinds.programs import Programs
from harness.experiment.kinds.shots import Shot, ShotKind
from harness.kernels.raster import raster_program
from harness.plugins import Plugin
from harness.scenes.camera import rays_of
from harness.scenes.model import Group
from harness.scenes.records import MOST_PARAMETERS

SMALLER = "take a smaller size or fewer samples a pixel"
BYTES_PER_RAY = 150  # of this process while it makes a list of rays and sends it: float64 until the list is complete


class RayMethods(ShotKind):
    """State what follows for methods whose kernel answers one ray: `Hit first_hit(Ray, real t0, real t1)`."""

    what = "rays"
    entries = ("rays", "camera")
    shot_entries = ("rays",)
    hard_entries = ("rays",)
    unlisted = None
    undrawn = None

    def origin_refusal(self, method: Method, origin: Origin) -> str | None:
        return None

    def origins(self, experiment: Experiment) -> tuple[Origin, ...]:
        return experiment.origins

    def told_origin(self, origin: Origin) -> Origin | None:
        return origin

    def rasterings(self, method: Method, experiment: Experiment) -> list[Rastering]:
        tolerances = experiment.config.tolerances if any(knob.per for knob in method.parameters) else [0.0]
        normals = experiment.normals if method.answers else ("distance",)
        return [(proxy, pixels, normal) for proxy in experiment.proxies for pixels in tolerances for normal in normals]

    def draw_refusal(self, method: Method, variant: Variant, group: Group) -> str | None:
        if not (group.varies and method.tables):
            return None
        knobs = dict(variant.parameters)
        first = method.tables(group.distinct[0], knobs, "float32")
        if all(method.tables(surface, knobs, "float32") == first for surface in group.distinct):
            return None
        return f"{variant} has tables of its surface, and the group's surfaces differ in {group.differ_in}"

    def draw_programs(self, plugin: Plugin, drawing: Drawing) -> tuple[Program, Program]:
        """Make the timed and the reporting program. Raises FirsthitError if instances differ in too many parameters."""
        group, surface = drawing.group, drawing.group.distinct[0]
        if group.varies and len(surface.parameters) > MOST_PARAMETERS:
            raise FirsthitError(f"instances of {surface.name} cannot differ: it has over {MOST_PARAMETERS} parameters")
        timed, check = (
            raster_program(
                plugin.method,
                plugin.folder,
                drawing.variant,
                surface,
                drawing.proxy,
                reports,
                group.varies,
                drawing.pixels,
                drawing.origin,
                drawing.normal,
            )
            for reports in (False, True)
        )
        return timed, check

    def compiled_drawing(self, plugin: Plugin, surface: Surface) -> Program | None:
        return raster_program(plugin.method, plugin.folder, plugin.variant({}), surface, "box", True)

    def shot(self, programs: tuple[Program, ...], shot: Shot, index: NDArray[np.intp]) -> Check[Hits]:
        return ListedCheck(programs[0], shot.rays[index])

    def hard_check(self, programs: tuple[Program, ...], surface: Surface, rays: NDArray[np.float32]) -> Check[Hits]:
        return ListedCheck(programs[0], rays)

    def shot_hits(self, answer: Hits) -> Hits:
        return answer

    def validated(self, hits: Hits, surface: Surface, shot: Shot) -> Hits:
        return validated(hits, surface.domain, shot.rays, shot.t_min, origin=shot.origin)


class RayCasting(RacedCasting):
    """Cast rays of a camera's image, or the same rays listed."""

    def __init__(self, asked: Asked, check: Program, timed: Program | None, former: Programs | None = None) -> None:
        """Take `former` if the programs are another revision's."""
        super().__init__(asked, (check,), timed)
        self.former = former

    def frame(self) -> Frame | None:
        assert self.timed
        if self.cell.stage == "rays":
            what = f"a list of {plural(self.samples**2, 'ray')}"
            if reason := memory.refusal(BYTES_PER_RAY * self.samples**2, what, SMALLER):
                raise FirsthitError(reason, exit_code=3)
            return ListedFrame(self.timed, rays_of(self.camera, self.samples))
        return CameraFrame(self.timed, self.camera, self.samples)

    def cast(self, executor: Executor, size: int, free_loops: bool = False) -> Cast:
        surface, rays = self.cell.surface, rays_of(self.camera, size)
        checked = executor.check(self.cell.device, ListedCheck(self.check_program(free_loops), rays))
        hits = validated(checked.answer, surface.domain, rays, origin=self.cell.origin)
        return Cast(surface, rays, hits, checked.compile_ms, {}, {})

    def second_build(self, executor: Executor, cast: Cast) -> SecondBuild | None:
        """Cast the same list again; another revision's kernel, where its programs have a second one."""
        cell, run = self.cell, with_listed_rays(executor, cast.rays)
        if self.former is None:
            return SecondBuild(
                cell.device, cell.precision, lambda language: (self.asked.program(cell.surface, "rays", language),), run
            )
        second = self.former.second
        return SecondBuild(cell.device, cell.precision, lambda _: (second,), run) if second else None

    def with_programs(self, programs: Programs) -> RacedCasting:
        return RayCasting(self.asked, programs.checks[0], programs.timed, programs)


class Rays(Kind):
    """Make castings of rays: from a camera's image in stage compute, listed in stage rays."""

    def casting(self, asked: Asked) -> Casting:
        surface = asked.cell.surface
        check = asked.program(surface, "rays")
        timed = asked.program(surface, "camera") if asked.cell.stage == "compute" else asked.freed(check)
        return RayCasting(asked, check, timed)
