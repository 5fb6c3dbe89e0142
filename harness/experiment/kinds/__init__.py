"""Kinds: one for each way of casting. Each file says of its kind what it refuses and why, which programs it is made of,
what a device is asked to do for a check and for a frame, and how answers become hits of rays.

A new kind is a file here, its kernels, and, where a device is to launch it in a new way, a message beside
harness/devices/messages.py. `of_cell` is the only place that chooses.
"""

from __future__ import annotations

from harness.contract import Casts, Method, Stage
from harness.experiment.cells import Cell
from harness.experiment.config import Experiment
from harness.experiment.kinds.beams import Beams
from harness.experiment.kinds.family import Family
from harness.experiment.kinds.mesh import Mesh
from harness.experiment.kinds.methods import of_method
from harness.experiment.kinds.model import NOT_RASTERED, Asked, Casting, Kind, MethodKind, Outcome, Rastering
from harness.experiment.kinds.narrowed import Narrowed
from harness.experiment.kinds.raster import Raster
from harness.experiment.kinds.rays import Rays

__all__ = ["Asked", "Casting", "Kind", "MethodKind", "Outcome", "of_cell", "of_method", "rasterings"]

FAMILY, RASTER, NARROWED = Family(), Raster(), Narrowed()
BY_METHOD: dict[Casts, Kind] = {"rays": Rays(), "beams": Beams(False), "quadtree": Beams(True), "mesh": Mesh()}


def of_cell(cell: Cell, method: Method) -> Kind:
    """Return the kind of casting that a cell asks of its method."""
    if cell.family:
        return FAMILY
    if cell.stage == "raster":
        return RASTER
    return BY_METHOD[method.casts] if cell.prepass == "none" else NARROWED


def rasterings(stage: Stage, method: Method, experiment: Experiment) -> list[Rastering]:
    """List the ways to rasterise that make a difference to a method in a stage: one where it does not rasterise."""
    return of_method(method).rasterings(method, experiment) if stage == "raster" else [NOT_RASTERED]
