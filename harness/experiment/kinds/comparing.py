"""Say what must be known of a cell to compare its answers on two devices: what follows from precision and device."""

from __future__ import annotations

import numpy as np

from harness.contract import UNIT_ROUNDOFF, DeviceInfo, Precision
from harness.devices.quadtree import first_level, last_level, layout_of
from harness.experiment.cells import Cell
from harness.experiment.kinds.beams import BeamCasting
from harness.experiment.kinds.model import Casting
from harness.experiment.kinds.narrowed import NarrowedCasting
from harness.hardcases.groups import groups
from harness.kernels.prepass import TILE_BITS
from harness.scenes.camera import distance_of


def last_bit(cell: Cell) -> float:
    """Return the distance between neighbouring numbers of a cell's precision at the largest t that its kernel answers.

    No answer is finer. A kernel's t begins at most the domain's size away, except at the eye and of fragments. It is in
    scene units for a view, whose errors are in these. For a family it is over what rounding makes of the domain's
    radius, as `worst_ratio` is.
    """
    from_eye = cell.origin == "eye" or cell.stage == "raster"
    if cell.family is None:
        away = distance_of(cell.view, cell.surface) if from_eye else 0.0
        return _spacing(away + 2.0 * cell.surface.domain.radius, cell.precision)
    bits = []
    for group in groups(cell.family):
        domain = group.surface.domain
        farthest = float(np.linalg.norm(group.rays[:, :3].astype(np.float64) - domain.center, axis=1).max())
        reach = (farthest if from_eye else 0.0) + 2.0 * domain.radius
        bits.append(_spacing(reach, cell.precision) / (UNIT_ROUNDOFF[cell.precision] * domain.radius))
    return max(bits)


def _spacing(value: float, precision: Precision) -> float:
    return float(np.spacing(np.float32(value) if precision == "float32" else np.float64(value)))


def device_level(casting: Casting | None, info: DeviceInfo) -> int | None:
    """Return the level at which a quadtree of beams begins, if the size of the device decides it; else None.

    On a device that takes more cells at once it begins deeper, and so spends another number of evaluations.
    """
    if isinstance(casting, NarrowedCasting):
        return first_level(info, max(0, last_level(casting.samples) - TILE_BITS))
    if isinstance(casting, BeamCasting) and casting.quadtree:
        by_device = layout_of(dict(casting.cell.variant.parameters)).first is None
        return first_level(info, last_level(casting.samples)) if by_device else None
    return None
