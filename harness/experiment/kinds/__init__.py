"""Define the kinds: one for each way of casting a cell.

A kind says what it refuses and why, which programs it is made of, what a device is asked to do for a check and for a
frame, and how answers become hits of rays. The rest of the harness asks the kind, and never asks how a cell is cast.

    module    what it defines
    --------  ---------------------------------------------------------------------------------------------------------
    methods   the abstract class MethodKind
    model     the abstract classes Kind, Casting and ViewCasting, and what they are handed
    casts     the table of the words of Method.casts; a new way to cast has its line there
    rays      rays, each cast by itself. The model for a kind whose checked rays can be listed
    beams     beams, one for each pixel, and quadtrees of them. The model for a kind that answers for pixels of a frame
    tiles     tiles of pixels, whose rays are isolated together and finished one by one. The model for a kind of several
              programs a frame, and for one that answers for pixels and is held against the oracle's rays
    narrowed  rays behind a prepass. The model for a kind of two programs, the first of which helps the second
    mesh      triangles of a surface that is tessellated beforehand
    family    families of hard rays, which are checked and never timed
    raster    scenes in stage raster; draws makes their draw calls
    programs  what a cell is cast by, which another revision's programs can replace
    shared    what the cells of a plan have in common, made and kept once
    drawing   how a group of instances is to be drawn

CONTRIBUTING.md, "a kind", lists all that a new one needs.
"""

from __future__ import annotations

from harness.contract import Method, Stage
from harness.experiment.cells import Cell
from harness.experiment.config import Experiment
from harness.experiment.kinds.casts import WAYS, of_method
from harness.experiment.kinds.family import Family
from harness.experiment.kinds.methods import NOT_RASTERED, MethodKind, Rastering
from harness.experiment.kinds.model import Asked, Casting, Kind, Outcome
from harness.experiment.kinds.narrowed import Narrowed
from harness.experiment.kinds.raster import Raster

__all__ = ["Asked", "Casting", "Kind", "MethodKind", "Outcome", "of_cell", "of_method", "only_rasters", "rasterings"]

FAMILY, RASTER, NARROWED = Family(), Raster(), Narrowed()


def of_cell(cell: Cell, method: Method) -> Kind:
    """Return the kind of casting that a cell asks of its method."""
    if cell.family:
        return FAMILY
    if cell.stage == "raster":
        return RASTER
    return WAYS[method.casts].cells if cell.prepass == "none" else NARROWED


def only_rasters(experiment: Experiment) -> bool:
    """Tell whether all cells of an experiment are rasterised."""
    return not experiment.config.families and (not experiment.surfaces or set(experiment.stages) == {"raster"})


def rasterings(stage: Stage, method: Method, experiment: Experiment) -> list[Rastering]:
    """List the ways to rasterise that make a difference to a method in a stage; one if it does not rasterise there."""
    return of_method(method).rasterings(method, experiment) if stage == "raster" else [NOT_RASTERED]
