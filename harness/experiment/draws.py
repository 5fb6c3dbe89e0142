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

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, FirsthitError, MeshRecipe, Normal, Origin, Program, Proxy, Surface, Variant
from harness.devices.frames import RECORD, Batch
from harness.kernels.assemble import PROXY_SIDES, mesh_program, raster_program
from harness.plugins import Catalog, Plugin
from harness.scenes.model import Group, Scene, bounding_radius

Floats = NDArray[np.float64]
MOST_PARAMETERS = 4  # of a formula, that instances may differ in
CLOSEST = 1e-4  # of the far plane's distance: the near plane is no closer to the eye


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


def pack(group: Group) -> NDArray[np.float32]:
    """float32[n, RECORD], the instances as raster/instance.glsl reads them."""
    n = len(group)
    records = np.zeros((n, RECORD), np.float64)
    inverse = group.turn.transpose(0, 2, 1) / group.scale[:, None, None]
    offset = -np.einsum("nij,nj->ni", inverse, group.place)
    for row in range(3):
        records[:, 4 * row : 4 * row + 3] = inverse[:, row]
        records[:, 4 * row + 3] = offset[:, row]
    own = {surface: _own(surface, group.varies) for surface in group.distinct}
    records[:, 12:] = [own[surface] for surface in group.surfaces] if group.varies else own[group.distinct[0]]
    records[:, 15] = group.scale
    records[:, 24:27] = group.colours
    return records.astype(np.float32)


def _own(surface: Surface, varies: bool) -> list[float]:
    """Numbers 12 to 31 of a record; scale and colour are left to the instance."""
    domain, radius = surface.domain, bounding_radius(surface)
    lower, upper = box_of(surface, tight=not varies)
    parameters = [float(value) for _, value in sorted(surface.parameters)][:MOST_PARAMETERS] if varies else []
    feature = surface.feature_radius or domain.radius
    stretch = (1.0, 1.0, 1.0)
    numbers = [*lower, 1.0, *upper, radius, *stretch, domain.radius, 0.0, 0.0, 0.0, feature, *parameters]
    return numbers + [0.0] * (RECORD - 12 - len(numbers))


def box_of(surface: Surface, tight: bool = True) -> tuple[Floats, Floats]:
    """Lower and upper corner of a box that holds what is seen of the surface; `tight`: no larger than about its
    bounding sphere, though the domain be."""
    domain, center = surface.domain, np.array(surface.domain.center)
    if isinstance(domain, Box):
        lower, upper = np.array(domain.lower), np.array(domain.upper)
    else:
        lower, upper = center - domain.radius, center + domain.radius
    if not tight:
        return lower, upper
    radius = bounding_radius(surface)
    return np.maximum(lower, center - radius), np.minimum(upper, center + radius)


def corners(proxy: Proxy) -> NDArray[np.uint32]:
    """uint32[3 k], the triangles of a proxy by the numbers of its corners, counterclockwise from outside."""
    if proxy == "sphere":
        fan = [(0, k, k + 1) for k in range(1, PROXY_SIDES - 1)]
        return np.array(fan, np.uint32).ravel()
    if proxy == "tetrahedron":
        return np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)], np.uint32).ravel()
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return np.array([(a, b, c, a, c, d) for a, b, c, d in sides], np.uint32).ravel()


def depth_map(scene: Scene, camera: NDArray[np.float32]) -> tuple[float, float]:
    """a and b of the depth buffer's a + b / s: 0 at the near plane, 1 at the far one, which just hold the instances.

    FirsthitError where the eye is inside an instance's bounding sphere: front faces of its proxy may then not be seen.
    """
    eye, forward = camera[:3].astype(np.float64), camera[3:6].astype(np.float64)
    spheres = np.concatenate([group.spheres for group in scene.groups])
    away = np.linalg.norm(spheres[:, :3] - eye, axis=1)
    if inside := int((away <= 1.001 * spheres[:, 3]).sum()):
        raise FirsthitError(
            f"the eye is inside the bounding spheres of {inside} instances: the raster stage draws what "
            "is in front of it; raise the view's distance"
        )
    s = (spheres[:, :3] - eye) @ forward
    near, far = 0.999 * float((s - spheres[:, 3]).min()), 1.001 * float((s + spheres[:, 3]).max())
    if far <= 0.0:
        raise FirsthitError("all instances are behind the eye; turn the view or raise its distance")
    near = max(near, CLOSEST * far)
    return far / (far - near), -far * near / (far - near)


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
