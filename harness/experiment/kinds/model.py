"""State what a kind of casting must say, so that plan, runner and gate ask it and branch on nothing.

A `MethodKind` (methods.py) belongs to what a method's kernel defines (`Method.casts`): rays, beams, a quadtree of
beams, tiles, a mesh. A `Kind` belongs to a cell: it is the way in which the cell's method is asked to cast. A Kind
refuses a cell, or makes its `Casting`, which holds the cell's programs and runs them. Most castings are a
`ViewCasting`, which checks answers on a grid of a view's rays. A new kind gives each abstract method; the others have
an answer that is right for most kinds.
"""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import check, freeloops
from harness.accuracy.compilers import SecondBuild, doubts_about
from harness.accuracy.pictures import headlight
from harness.contract import (
    DeviceInfo,
    Method,
    Normal,
    Program,
    Proxy,
    Section,
    Surface,
)
from harness.devices.interface import LANGUAGES
from harness.devices.messages import Frame
from harness.devices.steps import Executor
from harness.experiment.cells import Cell
from harness.experiment.config import AccuracyChoice, Config
from harness.experiment.kinds.methods import MethodKind
from harness.experiment.kinds.programs import Programs
from harness.experiment.kinds.shared import Shared
from harness.kernels.assemble import Entry, Language, lanes_on, method_program
from harness.kernels.functions import too_long, unsupported
from harness.kernels.sections import with_free_loops
from harness.plugins import Catalog, Plugin
from harness.results.row import Accuracy, Camera, RungVerdict
from harness.scenes.camera import camera_for, distance_of, pixel_footprint, rays_of


class KindFacts(TypedDict):
    """Hold the leaves of a cell's row that depend on its kind; see `Kind.facts`."""

    camera: Camera | None
    proxy: Proxy | None
    normal: Normal | None
    pixel_tolerance: float | None


@dataclass(frozen=True, eq=False)
class Asked:
    """State a cell that is to be cast on a device, with all that a kind needs to know of it.

    info: of the cell's device; None if it is not here
    method_kind: the kind of the cell's method
    most_triangles: the most that a frame may have
    shared: what cells of the same plan have in common
    """

    cell: Cell
    info: DeviceInfo | None
    catalog: Catalog
    method_kind: MethodKind
    most_triangles: int
    shared: Shared = field(default_factory=Shared)

    @property
    def plugin(self) -> Plugin:
        return self.catalog.get(self.cell.variant.method)

    @property
    def method(self) -> Method:
        return self.plugin.method

    @property
    def language(self) -> Language:
        return LANGUAGES[self.cell.device.partition(":")[0]]

    def program(
        self, surface: Surface, entry: Entry, language: Language | None = None, narrowed: Section | None = None
    ) -> Program:
        """Make a program of the cell's variant at `surface`, as harness.kernels.assemble.method_program does.

        `language` is the device's if none is given. Raises FirsthitError as method_program does.
        """
        cell, plugin = self.cell, self.plugin
        stated = cell.variant, surface, cell.precision, language or self.language
        own = self.info if language in (None, self.language) else None
        lanes = lanes_on(stated[-1], own)

        def make() -> Program:
            made = method_program(plugin.method, plugin.folder, *stated, entry, narrowed, 0.0, cell.origin, lanes)
            return self.shared.program(made)

        return self.shared.once((plugin.folder, *stated, entry, narrowed, cell.origin, lanes), make)

    def freed(self, program: Program) -> Program:
        """Return a program whose loops are left to the compiler, as timed ones are."""
        return self.shared.once(("freed", program), lambda: self.shared.program(with_free_loops(program)))


@dataclass(frozen=True, eq=False)
class Outcome:
    """Hold what checking a cell found. What a kind does not find is None, as is what nothing could be judged by.

    reason: why the cell fails and is not timed; None if it may be
    summary: the row's accuracy
    pictures: the row's arrays by name
    rungs: of a family: what accuracy.rungs says of each rung
    """

    compile_ms: float
    reason: str | None = None
    summary: Accuracy | None = None
    pictures: dict[str, NDArray[Any]] | None = None
    rungs: list[RungVerdict] | None = None


class Kind(ABC):
    """State a way to cast a cell.

    checked_on_frame: the check casts the frame that is timed, so that its program is made for cells too that are not
        timed
    is_timed: cells of this kind have a frame to time
    listed: the part of plan.json that lists its cells
    """

    checked_on_frame = False
    is_timed = True
    listed: Literal["cells", "families"] = "cells"

    def surfaces(self, cell: Cell) -> Sequence[Surface]:
        """List the surfaces that the cell's programs are of."""
        return [cell.surface]

    def refusal(self, asked: Asked) -> str | None:
        """Say why the cell's method cannot cast it in this way; None if it can."""
        cell, method = asked.cell, asked.method
        if cell.scene:
            return "the stage casts at one surface; several are drawn by stage raster"
        if reason := self.stage_refusal(asked) or self.unable(asked):
            return reason
        for surface in self.surfaces(cell):
            if reason := method.accepts(surface):
                return f"the method refuses the surface {surface.name}: {reason}"
        stated = method.needs, cell.precision, asked.language
        return self.lacking(asked) or next(filter(None, (too_long(s, *stated) for s in self.surfaces(cell))), None)

    def lacking(self, asked: Asked) -> str | None:
        """Say what the cell's device lacks to run it, whatever the method; None if it lacks nothing."""
        reasons = (unsupported(s, asked.cell.precision, asked.language) for s in self.surfaces(asked.cell))
        return next(filter(None, reasons), None)

    def stage_refusal(self, asked: Asked) -> str | None:
        """Say why the method cannot cast in the cell's stage; None if it can."""
        return asked.method_kind.stage_refusal(asked.cell.stage)

    def unable(self, asked: Asked) -> str | None:
        """Say why this kind refuses the cell, whatever the surface; None if it does not."""
        return None

    @abstractmethod
    def casting(self, asked: Asked) -> Casting:
        """Make the cell's programs; `refusal` was asked before. Raises FirsthitError if they cannot be made."""

    def facts(self, cell: Cell) -> KindFacts:
        """Return the leaves of the cell's row that depend on the kind.

        `camera` is the view's angles in degrees and its distance from the target in scene units, also if the view
        leaves that to the surface. `proxy`, `normal` and `pixel_tolerance` are of stage raster, and None elsewhere.
        """
        view, distance = cell.view, distance_of(cell.view, cell.surface)
        pose: Camera = {"azimuth": view.azimuth, "elevation": view.elevation, "fov": view.fov, "distance": distance}
        return {"camera": pose, "proxy": None, "normal": None, "pixel_tolerance": None}

    def question(self, cell: Cell, config: Config, timed: bool) -> dict[str, Any]:
        """Return what the cell asks, JSON-able: the part of its identity that programs do not hold."""
        budget = dataclasses.asdict(config.budget) | {"seed": config.seed}
        del budget["memory"]  # a limit of the machine, not of the answer
        return {
            "surface": cell.surface.identity,
            "view": dataclasses.asdict(cell.view),
            "sampling": [cell.size, cell.samples_per_pixel, cell.stage],
            "accuracy": dataclasses.asdict(config.accuracy),
            "budget": budget if timed else None,
        }


class Casting(ABC):
    """Hold a cell's programs, and run them.

    not_raced: why its frame is not timed against another revision's; None if it is
    """

    not_raced: str | None = None

    def __init__(self, asked: Asked, checks: tuple[Program, ...], timed: Program | None) -> None:
        """Take `checks`, the programs whose answers are read, and `timed`, the frame's; None if nothing is timed."""
        self.asked, self.checks, self.timed = asked, checks, timed

    @property
    def cell(self) -> Cell:
        return self.asked.cell

    @property
    def others(self) -> tuple[Program, ...]:
        """Return the programs beside `checks` and `timed` that decide the cell's row, such as a prepass's."""
        return ()

    @property
    def programs(self) -> Programs:
        """Return the cell's programs, with all that belongs to them."""
        parameters = dict(self.cell.variant.parameters)
        return Programs(self.checks, self.timed, self.others, parameters, tables=self.tables)

    @property
    def tables(self) -> Mapping[str, NDArray[np.float64]]:
        """Return what the host computes of the surface and hands to the programs in buffers, by name."""
        return {}

    @abstractmethod
    def with_programs(self, programs: Programs) -> Casting:
        """Return the same casting by another revision's programs, which `launched_as` allows in the place of its own.

        Raises FirsthitError if they lack what belongs to them.
        """

    @property
    def methods(self) -> tuple[str, ...]:
        """Return the names of the methods whose programs these are."""
        return (self.cell.variant.method,)

    @property
    def decides(self) -> Mapping[str, object]:
        """Return what decides the cell's row beside its programs and its question, JSON-able."""
        return {}

    @abstractmethod
    def frame(self) -> Frame | None:
        """Build the frame that is timed; None if nothing is timed."""

    @abstractmethod
    def check(self, executor: Executor, choice: AccuracyChoice, folder: Path, framed: bool) -> Outcome:
        """Cast, and hold the answers against the oracle, whose answers `folder` keeps.

        With `framed` a frame is to follow, so that a cell which is too wrong to be timed is given a reason. Raises
        CellError if a step fails, and FirsthitError if what is to be drawn cannot be made.
        """


class ViewCasting(Casting):
    """Hold the programs of a cell that is cast from a view, and check their answers on a grid of the view's rays."""

    @property
    def camera(self) -> NDArray[np.float32]:
        """Return the view's camera, float32[12] (eye, forward, right, up)."""
        return camera_for(self.cell.view, self.cell.surface)

    @property
    def samples(self) -> int:
        """Count the frame's samples per side."""
        side: float = self.cell.samples_per_pixel**0.5
        return self.cell.size * round(side)

    def check_program(self, free_loops: bool) -> Program:
        """Return the program that is checked, of a casting with one; with `free_loops` as it is timed (see `cast`)."""
        return with_free_loops(self.checks[0]) if free_loops else self.checks[0]

    @abstractmethod
    def cast(self, executor: Executor, size: int, free_loops: bool = False) -> check.Cast:
        """Cast a grid of size × size rays of the view, rays_of(self.camera, size), and return validated answers.

        With `free_loops` the programs leave their loops to the compiler, as timed ones do.
        """

    def second_build(self, executor: Executor, cast: check.Cast) -> SecondBuild | None:
        """Return how the same kernel is compiled in another way; None if it cannot be.

        It tells whether a compiler is at fault for answers that f contradicts.
        """
        return None

    def samples_shade(self, executor: Executor, size: int) -> NDArray[np.float32] | None:
        """Shade the samples of size × size pixels, float32[k, k]; None if a pixel has one sample."""
        side = size * round(self.cell.samples_per_pixel**0.5)
        if side == size:
            return None
        rays = rays_of(self.camera, side)
        return headlight(self.cell.surface, rays, self.cast(executor, side).hits).reshape(side, side)

    def rays_held(self, choice: AccuracyChoice) -> int:
        """Count the rays that this process holds while it checks: those that are judged, and all that are shaded."""
        return choice.size**2 * (1 + self.cell.samples_per_pixel * (self.cell.samples_per_pixel > 1))

    def check(self, executor: Executor, choice: AccuracyChoice, folder: Path, framed: bool) -> Outcome:
        cell = self.cell
        check.need_memory(self.rays_held(choice))
        cast = self.cast(executor, choice.size)
        footprint = pixel_footprint(self.camera, cell.size)
        summary, pictures = check.figures(cast, folder, choice.grazing_margin, cell.precision, footprint)
        reason = freeloops.removed(
            self.checks, cast.hits, lambda: self.cast(executor, choice.size, free_loops=True).hits
        )
        answers = self.asked.method.answers
        if not reason and answers and (second := self.second_build(executor, cast)):
            reason = doubts_about(cell.surface, cast.rays, cast.hits, second).fault
        if (shade := self.samples_shade(executor, choice.size)) is not None:
            pictures["samples"] = shade
        if not reason and answers:
            if reason := check.unjudged(summary, choice.undecided):
                return Outcome(cast.compile_ms, reason)
            reason = check.too_wrong(summary, choice.max_wrong_share) if framed else None
        return Outcome(cast.compile_ms, reason, summary, pictures)


class RacedCasting(ViewCasting):
    """State how to cast a cell whose frame can be timed against another revision's."""

    @abstractmethod
    def with_programs(self, programs: Programs) -> RacedCasting:
        """Return the same casting by another revision's programs, as Casting.with_programs does."""
