"""Plan an experiment: which cells it has, and for each cell what decides its result."""

from __future__ import annotations

import dataclasses
import itertools
import random
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from harness.contract import (
    DeviceInfo,
    FirsthitError,
    Origin,
    Precision,
    Prepass,
    Program,
    Stage,
    Variant,
    View,
    digest,
)
from harness.devices.host import Host
from harness.devices.messages import Frame
from harness.experiment import identity as identities
from harness.experiment import kinds
from harness.experiment.cells import Cell, FamilyCell
from harness.experiment.config import Experiment, views_of
from harness.experiment.kinds import Asked, Casting
from harness.experiment.kinds.methods import NOT_RASTERED, Rastering
from harness.experiment.kinds.shared import Shared
from harness.experiment.size import cells_of
from harness.experiment.targets import choose_devices, devices_of
from harness.hardcases import groups
from harness.plugins import Catalog

Place = TypeVar("Place")


@dataclass(frozen=True, eq=False)
class Planned:
    """Hold a cell with its key.

    identity: what decides the cell's row, JSON-able; the key is its digest
    casting: the cell's programs; None if it cannot run
    skip: why it cannot run
    is_timed: False: the cell is checked only
    lacks: it cannot run for something that its device lacks, and not for its method
    at: the place of the cell in the whole plan, from 0
    failure: why it fails before it runs: a method of it cannot be loaded, or went wrong when it was asked, or its
        device does not tell how it computes; None: not
    """

    cell: Cell
    key: str
    identity: dict[str, Any]
    device: DeviceInfo | None
    casting: Casting | None
    skip: str | None
    kind: kinds.Kind
    is_timed: bool = True
    lacks: bool = False
    failure: str | None = None
    at: int = 0

    @property
    def checks(self) -> tuple[Program, ...]:
        """Return the programs whose answers are read."""
        return self.casting.checks if self.casting else ()

    @property
    def timed(self) -> Program | None:
        """Return the frame's program; None if there is no frame."""
        if self.casting is None or not (self.is_timed or self.kind.checked_on_frame):
            return None
        return self.casting.timed

    @property
    def programs(self) -> list[Program]:
        """Return all its programs; one that is checked and timed may be there twice."""
        others = self.casting.others if self.casting else ()
        return [program for program in (*self.checks, self.timed, *others) if program]

    @property
    def frame(self) -> Frame | None:
        """Build the frame that is timed; None if nothing is."""
        return self.casting.frame() if self.casting and self.timed else None


def _absent(cell: Cell, info: DeviceInfo | None) -> str | None:
    """Say why nothing of a cell's precision can run on its device; None if something can."""
    if info is None:
        return f"there is no device {cell.device!r} on this machine"
    if info.problem:
        return info.problem
    return "the device has no float64" if cell.precision == "float64" and not info.float64 else None


def _refusal(asked: Asked, kind: kinds.Kind) -> str | None:
    """Say why a cell cannot run; None if it can."""
    cell, method = asked.cell, asked.method
    if reason := _absent(cell, asked.info):
        return reason
    if cell.precision not in method.precisions:
        return f"the method has no {cell.precision} form"
    return asked.method_kind.origin_refusal(method, cell.origin) or kind.refusal(asked)


def _unloaded(cell: Cell, catalog: Catalog) -> str | None:
    """Say why a method of a cell cannot be loaded; None if all can."""
    groups = cell.scene.groups if cell.scene else ()
    variants = (cell.variant, *(group.variant for group in groups if group.variant))
    why = ((variant.method, catalog.get(variant.method).broken) for variant in variants)
    return next((f"method {name!r} cannot be loaded: {reason}" for name, reason in why if reason is not None), None)


def _planned(
    cell: Cell,
    info: DeviceInfo | None,
    catalog: Catalog,
    experiment: Experiment,
    timed: bool,
    shared: Shared,
    host: Host | None,
) -> Planned:
    method = catalog.get(cell.variant.method).method
    kind = kinds.of_cell(cell, method)
    asked = Asked(cell, info, catalog, kinds.of_method(method), experiment.config.budget.triangles, shared)
    skip, casting, failure = _absent(cell, info), None, _unloaded(cell, catalog)
    if skip is None and failure is None:
        try:
            skip = _refusal(asked, kind)
            casting = None if skip else kind.casting(asked)
        except FirsthitError as error:
            if error.exit_code == 3:  # the method went wrong, which is no refusal
                failure = str(error)
            else:
                skip = str(error)
    lacks = skip is not None and skip == (_absent(cell, info) or kind.lacking(asked))
    planned = Planned(cell, "", {}, info, casting, skip, kind, timed, lacks, None if skip else failure)
    programs = planned.programs
    names = casting.methods if casting else (cell.variant.method,)
    timed = timed and kind.is_timed
    texts = {s.origin: s.hash for program in programs for s in (*program.sections, *program.vertex)}
    common = shared.once(
        ("common", names, timed, host),
        lambda: identities.common((catalog.get(name).folder for name in names), timed, host),
    )
    identity = {
        **{name: shared.facts(said) for name, said in kind.question(cell, experiment.config, planned.is_timed).items()},
        **(casting.decides if casting else {}),
        "program": shared.facts(texts),
        "program order": shared.facts([program.hash for program in programs]),
        "parameters": shared.facts(dict(cell.variant.parameters)),
        "precision": cell.precision,
        "device": shared.once(("device", info), lambda: _facts(info)),
        "skip": skip,
        **common,
    }
    return dataclasses.replace(planned, key=digest(cell.slot, identity), identity=identity)


def _facts(info: DeviceInfo | None) -> dict[str, Any] | None:
    """Return what a device's part in an identity says of it.

    Probing finds which clock is to be trusted, when a run starts and its plan is printed already: no part of the key.
    """
    return None if info is None else dataclasses.asdict(dataclasses.replace(info, clock="wall"))


def plan(
    experiment: Experiment,
    catalog: Catalog,
    found: list[DeviceInfo],
    timed: bool = True,
    tell: Callable[[str], None] = lambda _: None,
    only: Collection[str] | None = None,
    hosts: Mapping[str, Host] | None = None,
) -> list[Planned]:
    """Plan every cell of the grid, comparison by comparison; families last. Untimed cells are only checked.

    No cell is timed where the config's budget for it is 0 seconds, whatever `timed` says.

    With `only`, names of `together`, the other groups' cells are left out. `hosts` are the machines of devices that are
    not this one's, by the devices' names. `tell` hears of each cell before its programs are made, since a surface's
    tables may take seconds. Raises FirsthitError where none of the devices that the config names is among those
    `found`.
    """
    planned, shared, timed = [], Shared(), timed and experiment.config.budget.seconds > 0.0
    total = cells_of(experiment, catalog, found)
    for at, (cell, info) in enumerate(grid(experiment, catalog, found)):
        if only is None or cell.together in only:
            tell(f"preparing [{at + 1}/{total}] {cell.variant.method}: {cell.comparison} on {cell.device}")
            one = _planned(cell, info, catalog, experiment, timed, shared, (hosts or {}).get(cell.device))
            planned.append(dataclasses.replace(one, at=at))
    return planned


def together(experiment: Experiment, catalog: Catalog) -> Mapping[str, int]:
    """Count the cells on one device of each group that is timed together (Cell.together), in the plan's order.

    No device is looked for, so that the answer is the same on each machine.
    """
    casters = list(_casters(experiment, catalog, lambda _: ("",)))
    return Counter(cell.together for cell in _cells(experiment, catalog, casters))


def grid(experiment: Experiment, catalog: Catalog, found: list[DeviceInfo]) -> Iterator[tuple[Cell, DeviceInfo | None]]:
    """Go through the cells of `plan` in its order, each with its device. No program is made.

    Raises FirsthitError as `plan` does.
    """
    rasterises = kinds.only_rasters(experiment)
    devices = devices_of(experiment, found, rasterises)
    casters = _casters(experiment, catalog, lambda v: choose_devices([*experiment.devices_of(v)], found, rasterises))
    return ((cell, devices[cell.device]) for cell in _cells(experiment, catalog, list(casters)))


def _cells(experiment: Experiment, catalog: Catalog, casters: list[_Caster]) -> Iterator[Cell]:
    return itertools.chain(
        _views_of_surfaces(experiment, catalog, casters),
        _scenes(experiment, catalog, casters),
        _families(experiment, casters),
    )


@dataclass(frozen=True)
class _Caster:
    """State how rays are cast: the settings of a cell that do not depend on its surface, scene or family."""

    variant: Variant
    prepass: Prepass
    origin: Origin
    device: str
    precision: Precision


def _casters(
    experiment: Experiment, catalog: Catalog, devices: Callable[[Variant], Iterable[str]]
) -> Iterator[_Caster]:
    """Yield every way to cast rays; `devices` names those of a variant."""
    for variant, before in itertools.product(experiment.variants, experiment.prepasses):
        origins = kinds.of_method(catalog.get(variant.method).method).origins(experiment)
        for origin, device, precision in itertools.product(origins, devices(variant), experiment.precisions):
            yield _Caster(variant, before, origin, device, precision)


def _views_of_surfaces(experiment: Experiment, catalog: Catalog, casters: list[_Caster]) -> Iterator[Cell]:
    config = experiment.config
    stages = dict.fromkeys(stage for variant in experiment.variants for stage in experiment.stages_of(variant))
    scenes = itertools.product(experiment.surfaces, config.view, config.sizes, config.samples_per_pixel, stages)
    for (surface, view, size, samples, stage), caster in _each_with(scenes, casters):
        if stage in experiment.stages_of(caster.variant):
            for raster in _rasterings(stage, caster.variant, experiment, catalog):
                yield _cell(caster, Cell(caster.variant, surface, view, size, samples, "float32", stage, ""), raster)


def _scenes(experiment: Experiment, catalog: Catalog, casters: list[_Caster]) -> Iterator[Cell]:
    config = experiment.config
    for scene in experiment.scenes:
        views = itertools.product(views_of(scene, config), config.sizes, config.samples_per_pixel)
        for (view, size, samples), caster in _each_with(views, casters):
            for raster in _rasterings("raster", caster.variant, experiment, catalog):
                cell = Cell(caster.variant, scene.stand_in, view, size, samples, "float32", "raster", "", scene=scene)
                yield _cell(caster, cell, raster)


def _each_with(places: Iterable[Place], casters: list[_Caster]) -> Iterator[tuple[Place, _Caster]]:
    """Pair each place with each caster; itertools.product would list all places, which may be many, ahead."""
    return ((place, caster) for place in places for caster in casters)


def _families(experiment: Experiment, casters: list[_Caster]) -> Iterator[Cell]:
    for family, caster in itertools.product(experiment.config.families, casters):
        surface = groups.groups(family)[0].surface
        yield _cell(caster, FamilyCell(caster.variant, surface, View("none"), 0, 1, "float32", "rays", "", family))


def _cell(caster: _Caster, cell: Cell, raster: Rastering = NOT_RASTERED) -> Cell:
    """Return `cell`, which states surface, scene or family, with the settings of `caster` and the way to rasterise."""
    proxy, pixels, normal = raster
    return dataclasses.replace(
        cell,
        precision=caster.precision,
        device=caster.device,
        prepass=caster.prepass,
        origin=caster.origin,
        proxy=proxy,
        tolerance=pixels,
        normal=normal,
    )


def _rasterings(stage: Stage, variant: Variant, experiment: Experiment, catalog: Catalog) -> list[Rastering]:
    """List the proxies, tolerances in pixels and normals that make a difference to a method in a stage."""
    method = catalog.get(variant.method).method
    return kinds.rasterings(stage, method, experiment)


def shuffled(items: list[str], seed: int, round_number: int) -> list[str]:
    """Return `items` in a random order that depends on the seed and the round alone."""
    order = list(items)
    random.Random(f"{seed} {round_number}").shuffle(order)
    return order
