"""Make what stage raster draws of a scene by a variant: programs, instance records, and proxies or meshes.

Rays are not made here. Each fragment makes the ray through its pixel's middle, and the check reads it back.

**What was tried** Time in ms of 512 tori on a lattice at 768 × 768 on opengl:llvmpipe, if gl_FragDepth is declared
depth_greater or not. The picture is the same bit for bit.

    order of instances  newton, declared  not declared  sturm, declared  not declared
    ------------------  ----------------  ------------  ---------------  ------------
    as they stand       76                80            551              558
    near ones first     75                75            545              548
    far ones first      80                76            592              664

llvmpipe rejects no fragment early. So instances are drawn as they stand, and depth_greater is declared for devices that
do.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass

from harness.contract import MeshRecipe, Method, Normal, Origin, Program, Proxy, Variant
from harness.devices.raster import Batch, corners
from harness.experiment.kinds.casts import of_method
from harness.experiment.kinds.drawing import Drawing
from harness.plugins import Catalog
from harness.scenes.model import Group, Scene
from harness.scenes.records import pack


@dataclass(frozen=True, eq=False)
class Draw:
    """State one draw call: a group of instances by one variant.

    recipe: of a mesh, which needs no proxy; None for a proxy
    timed, check: the program that is timed, and the one that reports what it answers
    geometry: instances and triangles that belong to another revision's programs; None if they are made here
    """

    group: Group
    proxy: Proxy
    recipe: MeshRecipe | None
    timed: Program
    check: Program
    geometry: Batch | None = None

    def batch(self, reports: bool) -> Batch:
        """Return the draw call ready for a device; a mesh is made here, or read from where it was kept.

        With `reports` it is drawn by the program that reports what it answers. Raises FirsthitError if a mesh cannot be
        made.
        """
        program = self.check if reports else self.timed
        if self.geometry:
            return dataclasses.replace(self.geometry, program=program)
        records = pack(self.group)
        if self.recipe is None:
            return Batch(program, records, corners(self.proxy), None, True)
        from harness.scenes import meshes

        made = meshes.mesh(self.group.distinct[0], self.recipe)
        return Batch(program, records, made.triangles.ravel(), made.vertices, made.closed)


def draws(
    scene: Scene,
    variant: Variant,
    proxy: Proxy,
    catalog: Catalog,
    pixels: float = 0.0,
    origin: Origin = "nearest",
    normal: Normal = "distance",
) -> tuple[Draw, ...]:
    """Make a draw call for each group of a scene.

    `pixels`, `origin` and `normal` are as for raster_program. A group with a variant of its own keeps that variant's
    tolerance. Triangles have no origin. Raises FirsthitError if a group's method cannot draw it.
    """
    drawn = []
    for group in scene.groups:
        chosen = group.variant or variant
        plugin = catalog.get(chosen.method)
        drawing = Drawing(group, chosen, proxy, 0.0 if group.variant else pixels, origin, normal)
        timed, check = of_method(plugin.method).draw_programs(plugin, drawing)
        drawn.append(Draw(group, proxy, _recipe(group, chosen, plugin.method), timed, check))
    return tuple(drawn)


def _recipe(group: Group, variant: Variant, method: Method) -> MeshRecipe | None:
    return method.mesh(group.distinct[0], dict(variant.parameters)) if method.mesh else None


def refusal(scene: Scene, variant: Variant, catalog: Catalog) -> str | None:
    """Say why the methods of a scene cannot draw its surfaces; None if they can."""
    for group in scene.groups:
        chosen = group.variant or variant
        method = catalog.get(chosen.method).method
        kind = of_method(method)
        if kind.undrawn:
            return f"{chosen} {kind.undrawn}"
        for surface in group.distinct:
            if reason := method.accepts(surface):
                return f"{chosen} refuses the surface {surface.name}: {reason}"
        if reason := kind.draw_refusal(method, chosen, group):
            return reason
    return None


def too_many(scene: Scene, variant: Variant, catalog: Catalog, most: int) -> str | None:
    """Say why a scene's meshes are too fine for a frame of at most `most` triangles; None if they are not.

    Contours are not counted, since their triangles are known only once they are made.
    """
    count = 0
    for group in scene.groups:
        chosen = group.variant or variant
        recipe = _recipe(group, chosen, catalog.get(chosen.method).method)
        if recipe and recipe.kind == "parametric":
            from harness.scenes import meshes

            count += len(group) * meshes.triangles(group.distinct[0], recipe.resolution)
    return f"{count / 1e6:,.0f} million triangles a frame, over [budget] triangles" if count > most else None


def identity(scene: Scene, proxy: Proxy, drawn: tuple[Draw, ...]) -> Mapping[str, object]:
    """Return what decides a picture beside the programs, JSON-able; it is part of the cell's identity."""
    from harness.scenes import meshes

    recipes = [None if d.recipe is None else [d.recipe.kind, d.recipe.resolution] for d in drawn]
    return {
        "scene": scene.identity,
        "proxy": proxy,
        "meshes": recipes,
        "mesher": meshes.mesher() if any(recipes) else None,
    }
