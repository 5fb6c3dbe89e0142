"""Scene and variant → what the raster stage draws: programs, instance records, proxies or meshes, and the depth range.

Rays are not made here: each fragment makes the ray through its pixel's middle, and the check reads it back.

**Tried**, opengl:llvmpipe, 512 tori on a lattice at 768 × 768, ms with gl_FragDepth declared depth_greater / without:
newton 76 / 80, near instances first 75 / 75, far first 80 / 76; sturm 551 / 558, 545 / 548, 592 / 664; the same picture
bit for bit. llvmpipe rejects no fragment early, so instances are drawn as they stand; the promise is kept for devices
that do.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from harness.contract import FirsthitError, MeshRecipe, Normal, Origin, Program, Proxy, Variant
from harness.devices.frames import Batch
from harness.kernels.assemble import mesh_program, raster_program
from harness.plugins import Catalog, Plugin
from harness.scenes.model import Group, Scene
from harness.scenes.records import MOST_PARAMETERS, corners, pack


@dataclass(frozen=True, eq=False)
class Draw:
    """One draw call: a group of instances by one variant."""

    group: Group
    proxy: Proxy
    recipe: MeshRecipe | None  # of a mesh, which needs no proxy
    timed: Program
    check: Program

    def batch(self, reports: bool) -> Batch:
        """Ready for a device; a mesh is made here, or read from where it was kept."""
        records, program = pack(self.group), self.check if reports else self.timed
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
    """A draw for each group; FirsthitError where its method cannot draw it. `pixels`, `origin` and `normal` as for
    raster_program; a group with a variant of its own keeps that one's tolerance. Triangles have no origin."""
    return tuple(
        _draw(group, group.variant or variant, proxy, catalog, 0.0 if group.variant else pixels, origin, normal)
        for group in scene.groups
    )


def refusal(scene: Scene, variant: Variant, catalog: Catalog) -> str | None:
    """Why the methods of a scene cannot draw its surfaces, if they cannot."""
    for group in scene.groups:
        chosen = group.variant or variant
        method = catalog.get(chosen.method).method
        if method.casts not in ("rays", "mesh"):
            return f"{chosen} casts the beams of a camera's pixels, and a fragment has one ray"
        for surface in group.distinct:
            if reason := method.accepts(surface):
                return f"{chosen} refuses the surface {surface.name}: {reason}"
        if method.casts == "mesh":
            from harness.scenes import meshes

            if reason := meshes.missing():
                return reason
            if group.varies:
                return f"{chosen} has one mesh for a group, and the group's surfaces differ in {_differ(group)}"
        elif group.varies and method.tables:
            knobs = dict(chosen.parameters)
            first = method.tables(group.distinct[0], knobs, "float32")
            if any(method.tables(surface, knobs, "float32") != first for surface in group.distinct):
                return f"{chosen} has tables of its surface, and the group's surfaces differ in {_differ(group)}"
    return None


def too_many(scene: Scene, variant: Variant, catalog: Catalog, most: int) -> str | None:
    """Why a scene's meshes are too fine for a frame of at most `most` triangles, if they are; contours are not counted
    before they are made."""
    count = 0
    for group in scene.groups:
        chosen = group.variant or variant
        method = catalog.get(chosen.method).method
        recipe = method.mesh(group.distinct[0], dict(chosen.parameters)) if method.mesh else None
        if recipe and recipe.kind == "parametric":
            from harness.scenes import meshes

            count += len(group) * meshes.triangles(group.distinct[0], recipe.resolution)
    return f"{count / 1e6:,.0f} million triangles a frame, over [budget] triangles" if count > most else None


def _differ(group: Group) -> str:
    names = [name for name in dict(group.distinct[0].parameters) if _several(group, name)]
    return ", ".join(names) or "their domains"


def _several(group: Group, name: str) -> bool:
    return len({dict(surface.parameters)[name] for surface in group.distinct}) > 1


def _draw(
    group: Group, variant: Variant, proxy: Proxy, catalog: Catalog, pixels: float, origin: Origin, normal: Normal
) -> Draw:
    plugin: Plugin = catalog.get(variant.method)
    method, surface = plugin.method, group.distinct[0]
    if method.casts == "mesh":
        assert method.mesh
        recipe = method.mesh(surface, dict(variant.parameters))
        return Draw(group, proxy, recipe, mesh_program(plugin.folder, False), mesh_program(plugin.folder, True))
    if group.varies and len(surface.parameters) > MOST_PARAMETERS:
        raise FirsthitError(f"instances of {surface.name} cannot differ: it has over {MOST_PARAMETERS} parameters")
    timed, check = (
        raster_program(method, plugin.folder, variant, surface, proxy, reports, group.varies, pixels, origin, normal)
        for reports in (False, True)
    )
    return Draw(group, proxy, None, timed, check)


def identity(scene: Scene, proxy: Proxy, drawn: tuple[Draw, ...]) -> Mapping[str, object]:
    """What beside the programs decides a picture: goes into cache keys."""
    from harness.scenes import meshes

    recipes = [None if d.recipe is None else [d.recipe.kind, d.recipe.resolution] for d in drawn]
    return {
        "scene": scene.identity,
        "proxy": proxy,
        "meshes": recipes,
        "mesher": meshes.mesher() if any(recipes) else None,
    }
