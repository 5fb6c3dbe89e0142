"""Draw meshes: a surface is tessellated beforehand, and its triangles are rasterised instead of casting rays.

Only stage raster draws them; kinds/raster.py makes its castings.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.contract import FirsthitError, Method, Program, Stage, Surface, Variant
from harness.experiment.kinds.drawing import Drawing
from harness.experiment.kinds.methods import MethodKind
from harness.experiment.kinds.model import Asked, Casting, Kind
from harness.kernels.raster import mesh_program
from harness.plugins import Plugin
from harness.scenes import meshes
from harness.scenes.model import Group


class MeshMethods(MethodKind):
    """State what follows for methods whose kernel shades a triangle: `vec3 mesh_normal(vec3)`."""

    what = "triangles"
    entries = ()
    unlisted = "draws triangles, and listed rays meet none"
    undrawn = None

    def stage_refusal(self, stage: Stage) -> str:
        return "the method draws triangles, in stage raster"

    def draw_refusal(self, method: Method, variant: Variant, group: Group) -> str | None:
        if reason := meshes.missing():
            return reason
        if group.varies:
            return f"{variant} has one mesh for a group, and the group's surfaces differ in {group.differ_in}"
        return None

    def draw_programs(self, plugin: Plugin, drawing: Drawing) -> tuple[Program, Program]:
        return mesh_program(plugin.folder, False), mesh_program(plugin.folder, True)

    def compiled_drawing(self, plugin: Plugin, surface: Surface) -> Program | None:
        return mesh_program(plugin.folder, True)

    def shot_refusal(self, camera: NDArray[np.float32] | None) -> str | None:
        return 'draws triangles, in stage raster: name it in a config with stages = ["raster"]'


class Mesh(Kind):
    """Stand for triangles outside stage raster, where MeshMethods.stage_refusal refuses every cell."""

    def casting(self, asked: Asked) -> Casting:
        """Raise FirsthitError, as `refusal` says for every cell."""
        raise FirsthitError(MeshMethods().stage_refusal(asked.cell.stage))
