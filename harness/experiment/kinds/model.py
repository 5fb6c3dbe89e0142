"""What a kind of casting has to say, so that plan, runner and gate ask it and branch on nothing.

A `MethodKind` belongs to what a method's kernel defines (`Method.casts`): rays, beams, a quadtree of beams, a mesh. A
`Kind` belongs to a cell: which way its method is asked to cast. It refuses a cell or makes its `Casting`, which holds
the cell's programs and runs them.
"""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from harness.accuracy import check, freeloops
from harness.accuracy.compilers import SecondBuild, doubts_about
from harness.accuracy.pictures import headlight
from harness.contract import DeviceInfo, Hits, Method, Normal, Origin, Program, Proxy, Stage, Surface, Variant
from harness.devices.executor import LocalExecutor
from harness.devices.interface import LANGUAGES
from harness.devices.messages import Check, Frame
from harness.experiment.cells import Cell
from harness.experiment.config import AccuracyChoice, Config, Experiment
from harness.kernels.assemble import Language, method_program
from harness.kernels.functions import unsupported
from harness.plugins import Catalog, Plugin
from harness.results.row import Accuracy, RungVerdict
from harness.scenes.camera import camera_for, distance_of, pixel_footprint, rays_of
from harness.scenes.model import Group

Entry = Literal["rays", "camera", "beams"]
Rastering = tuple[Proxy, float, Normal]  # proxy, tolerance in pixels, normal: what only stage raster asks
NOT_RASTERED: Rastering = ("box", 0.0, "distance")


@dataclass(frozen=True, eq=False)
class Asked:
    """A cell to be cast on a device, with all that a kind needs to know of it."""

    cell: Cell
    info: DeviceInfo | None  # None: no such device is here
    catalog: Catalog
    method_kind: MethodKind
    most_triangles: int  # of a frame

    @property
    def plugin(self) -> Plugin:
        return self.catalog.get(self.cell.variant.method)

    @property
    def method(self) -> Method:
        return self.plugin.method

    @property
    def language(self) -> Language:
        return LANGUAGES[self.cell.device.partition(":")[0]]

    def program(self, surface: Surface, entry: Entry, language: Language | None = None, **more: Any) -> Program:
        """Make a program of the cell's variant, as harness.kernels.assemble.method_program does."""
        cell, plugin = self.cell, self.plugin
        stated = plugin.method, plugin.folder, cell.variant, surface, cell.precision, language or self.language
        return method_program(*stated, entry, origin=cell.origin, **more)


@dataclass(frozen=True, eq=False)
class Outcome:
    """Holds what checking a cell found; None for what its kind does not find, or what nothing could be judged by."""

    compile_ms: float
    reason: str | None = None  # why the cell is not timed
    summary: Accuracy | None = None  # the row's accuracy
    pictures: dict[str, NDArray[Any]] | None = None  # the row's arrays
    rungs: list[RungVerdict] | None = None  # of a family


class MethodKind(ABC):
    """What follows from what a method's kernel casts."""

    entries: tuple[Entry, ...] = ()  # of the programs that `firsthit compile` builds
    unlisted: str | None = None  # why listed rays cannot be cast, where they cannot
    undrawn: str | None = None  # why stage raster cannot draw with it, where it cannot

    def stage_refusal(self, stage: Stage) -> str | None:
        """Say why the method cannot cast in a stage other than raster, if it cannot."""
        return None

    def origin_refusal(self, method: Method, origin: Origin) -> str | None:
        """Say why the method cannot begin its rays at `origin`, if it cannot."""
        if origin == "nearest":
            return None
        return f"an origin is chosen for rays, and the method {method.name} casts {self.what}"

    @property
    @abstractmethod
    def what(self) -> str:
        """What the method casts, in the plural: rays, beams, triangles."""

    def origins(self, experiment: Experiment) -> tuple[Origin, ...]:
        """List the origins that make a difference to the method; what has none is cast once."""
        return ("nearest",)

    def told_origin(self, origin: Origin) -> Origin | None:
        """Return the origin that a row tells; None where the method has none."""
        return None

    def rasterings(self, method: Method, experiment: Experiment) -> list[Rastering]:
        """List the ways to rasterise that make a difference to the method."""
        return [NOT_RASTERED]

    def draw_refusal(self, method: Method, variant: Variant, group: Group) -> str | None:
        """Say why the method cannot draw a scene's group of instances, if it cannot."""
        return None

    def draw_programs(self, plugin: Plugin, drawing: Drawing) -> tuple[Program, Program]:
        """Make the programs that draw a group, timed and reporting.

        Raises FirsthitError where the method cannot draw it.
        """
        raise NotImplementedError(f"{plugin.method.name} draws nothing: ask draw_refusal first")

    def compiled_drawing(self, plugin: Plugin, surface: Surface) -> Program | None:
        """Make the reporting program of stage raster, which holds the timed one's text; None where there is none."""
        return None

    def shot_refusal(self, camera: NDArray[np.float32] | None) -> str | None:
        """Say why the method cannot cast an image of single rays, if it cannot: what follows its name in a sentence.

        `camera`, float32[12], is the image's; None where the rays are of no camera.
        """
        return None

    @abstractmethod
    def shot(self, program: Program, shot: Shot, index: NDArray[np.intp]) -> Check[Any]:
        """Build the check that casts the rays `index`, int[k], of a shot; its program is of the entry `entries[0]`."""

    @abstractmethod
    def shot_hits(self, answer: Any) -> Hits:
        """Read the hits [k] from what the check of `shot` answered."""

    @abstractmethod
    def validated(self, hits: Hits, surface: Surface, shot: Shot) -> Hits:
        """Mark those answers for all rays of a shot INVALID that can be none."""


@dataclass(frozen=True, eq=False)
class Shot:
    """Holds rays that are cast once, to be looked at: for `firsthit trace` and `firsthit show`."""

    rays: NDArray[np.float32]  # [n, 6]
    camera: NDArray[np.float32] | None  # [12], of the square image whose rays these are, row by row
    knobs: Mapping[str, float | int]
    t_min: float = 0.0
    origin: Origin = "nearest"


@dataclass(frozen=True, eq=False)
class Drawing:
    """How a group of instances is to be drawn; see harness.kernels.assemble.raster_program."""

    group: Group
    variant: Variant
    proxy: Proxy
    pixels: float = 0.0
    origin: Origin = "nearest"
    normal: Normal = "distance"


class Kind(ABC):
    """A way to cast a cell."""

    checked_on_frame = False  # whether the check needs the frame that is timed, so that untimed cells have it too
    is_timed = True  # whether cells of this kind have a frame to time
    listed: Literal["cells", "families"] = "cells"  # where plan.json lists its cells

    def surfaces(self, cell: Cell) -> Sequence[Surface]:
        """List the surfaces that the cell's programs are of."""
        return [cell.surface]

    def refusal(self, asked: Asked) -> str | None:
        """Say why the cell's method cannot cast it in this way, if it cannot."""
        cell, method = asked.cell, asked.method
        if cell.scene:
            return "the stage casts at one surface; several are drawn by stage raster"
        if reason := asked.method_kind.stage_refusal(cell.stage) or self.unable(asked):
            return reason
        for surface in self.surfaces(cell):
            if reason := method.accepts(surface):
                return f"the method refuses the surface {surface.name}: {reason}"
            if reason := unsupported(surface, cell.precision, asked.language):
                return reason
        return None

    def unable(self, asked: Asked) -> str | None:
        """Say what only this kind refuses, whatever the surface."""
        return None

    @abstractmethod
    def casting(self, asked: Asked) -> Casting:
        """Make the cell's programs. Raises FirsthitError where they cannot be made."""

    def facts(self, cell: Cell) -> dict[str, Any]:
        """Return the leaves of the cell's row that depend on the kind.

        `camera` is the view's angles in degrees and its distance from the target in scene units, also where the view
        leaves that to the surface. Of stage raster are `proxy`, `normal` and `pixel_tolerance`.
        """
        view, distance = cell.view, distance_of(cell.view, cell.surface)
        pose = {"azimuth": view.azimuth, "elevation": view.elevation, "fov": view.fov, "distance": distance}
        return {"camera": pose, "proxy": None, "normal": None, "pixel_tolerance": None}

    def question(self, cell: Cell, config: Config, timed: bool) -> dict[str, Any]:
        """Return what the cell asks, JSON-able: the part of its identity that programs do not hold."""
        budget = dataclasses.asdict(config.budget) | {"seed": config.seed}
        return {
            "surface": cell.surface.identity,
            "view": dataclasses.asdict(cell.view),
            "sampling": [cell.size, cell.samples_per_pixel, cell.stage],
            "accuracy": dataclasses.asdict(config.accuracy),
            "budget": budget if timed else None,
        }


class Casting(ABC):
    """A cell's programs, and what is done with them."""

    not_raced: str | None = None  # why its frame is not timed against another revision's, where it is not

    def __init__(self, asked: Asked, checks: tuple[Program, ...], timed: Program | None) -> None:
        """`checks` are the programs whose answers are read, `timed` is the frame's, None where nothing is timed."""
        self.asked, self.checks, self.timed = asked, checks, timed

    @property
    def cell(self) -> Cell:
        return self.asked.cell

    @property
    def others(self) -> tuple[Program, ...]:
        """The programs beside `checks` and `timed` that decide the cell's row."""
        return ()

    @property
    def methods(self) -> tuple[str, ...]:
        """The names of the methods whose programs these are."""
        return (self.cell.variant.method,)

    @property
    def decides(self) -> Mapping[str, object]:
        """What decides the cell's row beside its programs and its question."""
        return {}

    @abstractmethod
    def frame(self) -> Frame | None:
        """Build the frame that is timed; None where nothing is timed."""

    @abstractmethod
    def check(self, executor: LocalExecutor, choice: AccuracyChoice, folder: Path, framed: bool) -> Outcome:
        """Cast, and hold the answers against the oracle, whose answers `folder` keeps.

        `framed`: a frame is to follow, so that a cell which is too wrong for that is given a reason. Raises CellError
        where a step fails, and FirsthitError where what is to be drawn cannot be made.
        """


class ViewCasting(Casting):
    """A cell that is cast from a view: its answers are checked on a grid of the view's rays."""

    @property
    def camera(self) -> NDArray[np.float32]:
        """float32[12], as camera_for makes it."""
        return camera_for(self.cell.view, self.cell.surface)

    @property
    def samples(self) -> int:
        """Count the frame's samples per side."""
        side: float = self.cell.samples_per_pixel**0.5
        return self.cell.size * round(side)

    @abstractmethod
    def cast(self, executor: LocalExecutor, size: int, free_loops: bool = False) -> check.Cast:
        """Cast a grid of size × size rays of the view.

        With `free_loops` the programs leave their loops to the compiler, as timed ones do.
        """

    def second_build(self, executor: LocalExecutor, cast: check.Cast) -> SecondBuild | None:
        """Return the same kernel compiled another way, to tell whether a compiler is at fault; None: there is none."""
        return None

    def samples_shade(self, executor: LocalExecutor, size: int) -> NDArray[np.float32] | None:
        """Shade the samples of size × size pixels, [k, k]; None where a pixel has one sample."""
        side = size * round(self.cell.samples_per_pixel**0.5)
        if side == size:
            return None
        rays = rays_of(self.camera, side)
        return headlight(self.cell.surface, rays, self.cast(executor, side).hits).reshape(side, side)

    def check(self, executor: LocalExecutor, choice: AccuracyChoice, folder: Path, framed: bool) -> Outcome:
        cell = self.cell
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

    @abstractmethod
    def with_programs(self, checked: Program | None, timed: Program) -> ViewCasting:
        """Return the same casting by another revision's programs; without `checked`, the timed one is checked."""
