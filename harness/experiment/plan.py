"""An experiment → its cells, and for each cell what decides its result."""

from __future__ import annotations

import dataclasses
import itertools
import random
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from harness.contract import (
    Casts,
    Cell,
    DeviceInfo,
    FirsthitError,
    Normal,
    Origin,
    Program,
    Proxy,
    Stage,
    Surface,
    Variant,
    View,
    digest,
)
from harness.devices.interface import LANGUAGES, RASTERISES, no_device
from harness.devices.quadtree import layout_of
from harness.devices.worker import Frame
from harness.experiment import draws as raster
from harness.experiment import identity as identities
from harness.experiment.config import Config, Experiment
from harness.experiment.draws import Draw
from harness.hardcases import groups
from harness.kernels import prepass
from harness.kernels.assemble import fill_program, method_program, origin_refusal, with_free_loops
from harness.plugins import Catalog
from harness.scenes.camera import camera_for, rays_of
from harness.scenes.model import Scene, single
from harness.scenes.records import depth_map


@dataclass(frozen=True, eq=False)
class Planned:
    """A cell with its key; `skip` says why where it cannot run, and then it has no programs."""

    cell: Cell
    key: str
    identity: dict[str, Any]
    device: DeviceInfo | None
    checks: tuple[Program, ...]  # over listed rays, or of beams: one for a view, one for each surface of a family
    timed: Program | None  # the frame's; None for a family
    skip: str | None
    casts: Casts = "rays"
    is_timed: bool = (
        True  # False: checked only; then only beams and prepasses have a frame, since they are checked on it
    )
    prepass: Program | None = None
    draws: tuple[Draw, ...] = ()  # of stage raster

    @property
    def scene(self) -> Scene:
        """What stage raster draws."""
        scene: Scene = self.cell.scene or single(self.cell.surface, self.cell.view)
        return scene

    @property
    def camera(self) -> NDArray[np.float32]:
        """float32[12], as camera_for makes it."""
        return camera_for(self.cell.view, self.cell.surface)

    @property
    def frame(self) -> Frame | None:
        """What is timed, if anything."""
        if self.timed is None:
            return None
        if self.draws:
            return self.raster_frame(self.samples, reports=False)
        camera, size = self.camera, self.samples
        rays = rays_of(camera, size) if self.cell.stage == "rays" else None
        layout = layout_of(dict(self.cell.variant.parameters))
        return Frame(self.timed, camera, rays, size, self.casts, self.prepass, layout=layout)

    @property
    def samples(self) -> int:
        """Count the frame's samples per side."""
        side: float = self.cell.samples_per_pixel**0.5
        return self.cell.size * round(side)

    def raster_frame(self, size: int, reports: bool, free_loops: bool = False) -> Frame:
        """Build the frame that stage raster draws, size × size.

        With `reports` its programs say what they answered. With `free_loops` they leave their loops to the compiler, as
        timed ones do.
        """
        batches = tuple(draw.batch(reports) for draw in self.draws)
        if free_loops:
            batches = tuple(dataclasses.replace(batch, program=with_free_loops(batch.program)) for batch in batches)
        depths = depth_map(self.scene, self.camera)
        program = fill_program() if reports else batches[0].program
        return Frame(program, self.camera, None, size, self.casts, None, batches, depths)


def choose_devices(
    wanted: list[str], found: list[DeviceInfo], rasterises: bool = False
) -> dict[str, DeviceInfo | None]:
    """Device names to run on; None for a named one that is not here. `any` is the first that works, and
    rasterises if it must. `all` leaves out a broken double of a working device (one driver installed twice)."""
    by_name = {info.name: info for info in found}
    chosen: dict[str, DeviceInfo | None] = {}
    working = {info.name.split("-")[0] for info in found if not info.problem}
    for name in wanted:
        if name == "all":
            chosen |= {i.name: i for i in found if not i.problem or i.name.split("-")[0] not in working}
        elif name == "any":
            chosen |= dict(
                [(info.name, info) for info in found if not info.problem and (able(info) or not rasterises)][:1]
            )
        else:
            chosen[name] = by_name.get(name)
    return chosen


def able(info: DeviceInfo) -> bool:
    """Whether a device rasterises."""
    return info.name.split(":")[0] in RASTERISES


def devices_of(experiment: Experiment, found: list[DeviceInfo]) -> dict[str, DeviceInfo | None]:
    """The devices that a config's cells run on; where all of them are rasterised, `any` is one that can."""
    drawn_only = not experiment.config.families and (not experiment.surfaces or set(experiment.stages) == {"raster"})
    return choose_devices(experiment.config.devices, found, drawn_only)


def _refusal(
    cell: Cell, surface: Surface, info: DeviceInfo | None, catalog: Catalog, most_triangles: int
) -> str | None:
    """Why a cell cannot run, if it cannot."""
    from harness.kernels.functions import unsupported

    method = catalog.get(cell.variant.method).method
    if info is None:
        return f"there is no device {cell.device!r} on this machine"
    if info.problem:
        return info.problem
    if cell.precision == "float64" and not info.float64:
        return "the device has no float64"
    if cell.precision not in method.precisions:
        return f"the method has no {cell.precision} form"
    if reason := origin_refusal(method, cell.origin):
        return reason
    if cell.stage == "raster":
        if not able(info):
            return "the stage raster needs a rasteriser, and the device has none"
        if cell.precision != "float32":
            return "the stage raster is float32, as its vertices and its depth buffer are"
        if cell.prepass == "none":
            scene = cell.scene or single(surface, cell.view)
            return raster.refusal(scene, cell.variant, catalog) or raster.too_many(
                scene, cell.variant, catalog, most_triangles
            )
    if cell.scene:
        return "the stage casts at one surface; several are drawn by stage raster"
    if method.casts == "mesh":
        return "the method draws triangles, in stage raster"
    if method.casts != "rays" and cell.stage == "rays":
        return "the method casts the beams of a camera's pixels, and listed rays have none"
    if cell.prepass != "none" and (method.casts != "rays" or cell.stage != "compute"):
        return "a prepass narrows the rays of a camera's pixels, in the stage compute"
    if reason := method.accepts(surface):
        return f"the method refuses the surface {surface.name}: {reason}"
    return unsupported(surface, cell.precision, LANGUAGES[cell.device.split(":")[0]])


def _programs(cell: Cell, surfaces: list[Surface], catalog: Catalog) -> tuple[tuple[Program, ...], Program | None]:
    plugin, language = catalog.get(cell.variant.method), LANGUAGES[cell.device.split(":")[0]]

    def program(surface: Surface, entry: Literal["rays", "camera", "beams"]) -> Program:
        narrowed = prepass.parameters() if cell.prepass == "beams" else None
        return method_program(
            plugin.method,
            plugin.folder,
            cell.variant,
            surface,
            cell.precision,
            language,
            entry,
            narrowed,
            origin=cell.origin,
        )

    if plugin.method.casts != "rays":
        check = program(cell.surface, "beams")
        return (check,), with_free_loops(check)
    checks = tuple(program(surface, "rays") for surface in surfaces)
    if cell.family:
        return checks, None
    return checks, program(cell.surface, "camera") if cell.stage == "compute" else with_free_loops(checks[0])


def _planned(cell: Cell, info: DeviceInfo | None, catalog: Catalog, experiment: Experiment, timed: bool) -> Planned:
    surfaces = [group.surface for group in groups.groups(cell.family)] if cell.family else [cell.surface]
    most = experiment.config.budget.triangles
    skip = next(filter(None, (_refusal(cell, surface, info, catalog, most) for surface in surfaces)), None)
    checks: tuple[Program, ...] = ()
    frame: Program | None = None
    before: Program | None = None
    drawn: tuple[Draw, ...] = ()
    if skip is None:
        try:
            if cell.stage == "raster":
                scene = cell.scene or single(cell.surface, cell.view)
                depth_map(scene, camera_for(cell.view, cell.surface))
                drawn = raster.draws(scene, cell.variant, cell.proxy, catalog, cell.tolerance, cell.origin, cell.normal)
                checks, frame = tuple(draw.check for draw in drawn), drawn[0].timed
            else:
                checks, frame = _programs(cell, surfaces, catalog)
            if cell.prepass == "beams" and info is not None:
                before = prepass.program(cell.surface, cell.precision, LANGUAGES[info.name.split(":")[0]])
        except FirsthitError as error:
            skip = str(error)
    casts = catalog.get(cell.variant.method).method.casts
    frame = frame if timed or before or casts in ("beams", "quadtree") else None
    programs = tuple(program for program in (*checks, frame, before, *(draw.timed for draw in drawn)) if program)
    # which clock is believed is found by probing when a run starts, after a plan is printed: no part of the key
    facts = None if info is None else dataclasses.asdict(dataclasses.replace(info, clock="wall"))
    scene = (
        {"family": groups.identity(cell.family)}
        if cell.family
        else {
            "surface": cell.surface.identity,
            "view": dataclasses.asdict(cell.view),
            "sampling": [cell.size, cell.samples_per_pixel, cell.stage],
            "accuracy": dataclasses.asdict(experiment.config.accuracy),
            "budget": dataclasses.asdict(experiment.config.budget) | {"seed": experiment.config.seed}
            if timed
            else None,
        }
    )
    if drawn:
        scene["raster"] = raster.identity(cell.scene or single(cell.surface, cell.view), cell.proxy, drawn)
    methods = [cell.variant.method, *(d.group.variant.method for d in drawn if d.group.variant)]
    identity = scene | {
        "program": {s.origin: s.hash for program in programs for s in (*program.sections, *program.vertex)},
        "program order": [program.hash for program in programs],
        "parameters": dict(cell.variant.parameters),
        "precision": cell.precision,
        "device": facts,
        "skip": skip,
        **identities.common((catalog.get(name).folder for name in methods), timed and not cell.family),
    }
    return Planned(cell, digest(cell.slot, identity), identity, info, checks, frame, skip, casts, timed, before, drawn)


def plan(experiment: Experiment, catalog: Catalog, found: list[DeviceInfo], timed: bool = True) -> list[Planned]:
    """Every cell of the grid, comparison by comparison; families last. Untimed cells are only checked."""
    config = experiment.config
    devices = devices_of(experiment, found)
    if not any(devices.values()):
        if not set(config.devices) <= {"all", "any"}:
            raise no_device(", ".join(config.devices), found)
        raise FirsthitError("no usable device found on this machine; see `firsthit devices`", exit_code=3)
    runs_on = [
        (variant, before, origin, device, precision)
        for variant, before in itertools.product(experiment.variants, experiment.prepasses)
        for origin, device, precision in itertools.product(
            _origins(variant, experiment, catalog), devices.items(), experiment.precisions
        )
    ]
    stages = dict.fromkeys(stage for variant in experiment.variants for stage in experiment.stages_of(variant))
    scenes = itertools.product(experiment.surfaces, config.view, config.sizes, config.samples_per_pixel, stages)
    cells = [
        (
            Cell(
                variant,
                surface,
                view,
                size,
                samples,
                precision,
                stage,
                name,
                None,
                before,
                proxy,
                pixels,
                origin=origin,
                normal=normal,
            ),
            info,
        )
        for surface, view, size, samples, stage in scenes
        for variant, before, origin, (name, info), precision in runs_on
        if stage in experiment.stages_of(variant)
        for proxy, pixels, normal in _rasterings(stage, variant, experiment, catalog)
    ]
    cells += [
        (
            Cell(
                variant,
                scene.stand_in,
                view,
                size,
                samples,
                precision,
                "raster",
                name,
                None,
                before,
                proxy,
                pixels,
                scene,
                origin,
                normal,
            ),
            info,
        )
        for scene in experiment.scenes
        for view, size, samples in itertools.product(_views(scene, config), config.sizes, config.samples_per_pixel)
        for variant, before, origin, (name, info), precision in runs_on
        for proxy, pixels, normal in _rasterings("raster", variant, experiment, catalog)
    ]
    cells += [
        (
            Cell(
                variant,
                groups.groups(family)[0].surface,
                View("none"),
                0,
                1,
                precision,
                "rays",
                name,
                family,
                before,
                origin=origin,
            ),
            info,
        )
        for family in config.families
        for variant, before, origin, (name, info), precision in runs_on
    ]
    return [_planned(cell, info, catalog, experiment, timed) for cell, info in cells]


def _origins(variant: Variant, experiment: Experiment, catalog: Catalog) -> tuple[Origin, ...]:
    """The origins that make a difference to a method: beams and triangles have none, and are cast once."""
    return experiment.origins if catalog.get(variant.method).method.casts == "rays" else ("nearest",)


def _rasterings(
    stage: Stage, variant: Variant, experiment: Experiment, catalog: Catalog
) -> list[tuple[Proxy, float, Normal]]:
    """The proxies, the tolerances in pixels and the normals that make a difference to a method in a stage."""
    method = catalog.get(variant.method).method
    if stage != "raster" or method.casts == "mesh":
        return [("box", 0.0, "distance")]
    tolerances = experiment.config.tolerances if any(knob.per for knob in method.parameters) else [0.0]
    normals: tuple[Normal, ...] = experiment.normals if method.answers else ("distance",)
    return list(itertools.product(experiment.proxies, tolerances, normals))


def _views(scene: Scene, config: Config) -> list[View]:
    """A scene has its own view; a set of views is cast at it besides, where the config names one."""
    return [scene.view, *(view for view in config.view if view.set)]


def shuffled(items: list[str], seed: int, round_number: int) -> list[str]:
    """`items` in a random order that depends on the seed and the round alone."""
    order = list(items)
    random.Random(f"{seed} {round_number}").shuffle(order)
    return order
