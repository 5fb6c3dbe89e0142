"""Tessellate surfaces with pyvista, and keep the meshes on disk. No other module imports pyvista."""

from __future__ import annotations

import importlib.util
import os
from dataclasses import dataclass
from functools import lru_cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, FirsthitError, MeshRecipe, Surface, digest
from harness.results import npz
from harness.results.sources import MESHES, digest_of, packages
from harness.results.writing import savez_atomically

FARTHEST = 5000  # how many samples of a surface are compared with its mesh
PARAMETRIC = {  # the formulas whose parametric form is known here
    "(x^2 + y^2 + z^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)": "torus",
    "x^2 + y^2 + z^2 - R^2": "sphere",
    "x^2 + y^2 - r^2": "cylinder",
    "x^2 + y^2 - (a + b*z)^2": "cone",
    "z": "plane",
}


@dataclass(frozen=True, eq=False)
class Mesh:
    """Hold triangles, counterclockwise as seen from outside; positions are in the surface's own units."""

    vertices: NDArray[np.float32]  # [v, 6] position and unit normal
    triangles: NDArray[np.uint32]  # [f, 3]
    closed: bool  # whether it has no boundary


def missing() -> str | None:
    """Return why meshes cannot be made here, or None if they can."""
    if importlib.util.find_spec("pyvista") is None:
        return "a mesh needs the package pyvista: pip install 'firsthit[mesh]'"
    return None


def mesher() -> str:
    """Name the packages that tessellate, with their versions."""
    return f"pyvista {version('pyvista')}, vtk {version('vtk')}"


def folder() -> Path:
    """Return the folder of the stored meshes, below $FIRSTHIT_CACHE or the user's cache folder."""
    base = os.environ.get("FIRSTHIT_CACHE") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "firsthit" / "meshes"


def mesh(surface: Surface, recipe: MeshRecipe) -> Mesh:
    """Return the surface tessellated by `recipe`, from disk if it is stored there.

    Raises FirsthitError if pyvista is missing, the surface has no such form, or the grid is too coarse to show it.
    """
    if reason := missing():
        raise FirsthitError(reason)
    key = digest(surface.identity, recipe.kind, recipe.resolution, mesher(), packages(), digest_of(*MESHES))
    return _mesh(surface, recipe, folder() / f"{surface.name}-{recipe.kind}-{recipe.resolution}-{key}.npz")


@lru_cache(maxsize=16)  # of a path, since another cache folder has files of its own
def _mesh(surface: Surface, recipe: MeshRecipe, path: Path) -> Mesh:
    """Return the mesh that `path` keeps, or make it and keep it there."""
    if stored := _stored(path):
        return stored
    made = _parametric(surface, recipe.resolution) if recipe.kind == "parametric" else _contour(surface, recipe)
    savez_atomically(path, vertices=made.vertices, triangles=made.triangles, closed=np.array(made.closed))
    return made


def _stored(path: Path) -> Mesh | None:
    """Return a stored mesh; None if there is none, or if the file is damaged."""
    try:
        arrays = npz.read(path, {"vertices": np.float32, "triangles": np.uint32, "closed": np.bool_}, _fits)
    except (OSError, ValueError):
        return None
    vertices, corners = arrays["vertices"], arrays["triangles"]
    whole = len(vertices) and len(corners) and np.isfinite(vertices[:, :3]).all() and corners.max() < len(vertices)
    return Mesh(vertices, corners, bool(arrays["closed"])) if whole else None


def _fits(name: str, shape: npz.Shape) -> bool:
    """Tell whether an array of a stored mesh may have a shape."""
    columns = {"vertices": 6, "triangles": 3}.get(name)
    return shape == () if columns is None else len(shape) == 2 and shape[1] == columns


def triangles(surface: Surface, n: int) -> int:
    """Estimate how many triangles a parametric mesh has, without making it."""
    return {"torus": 2 * n * n, "sphere": n * n, "plane": 2}.get(PARAMETRIC.get(surface.formula, ""), 2 * n)


def parametric_refusal(surface: Surface) -> str | None:
    """Return why a surface has no parametric mesh, or None if it has one."""
    form = PARAMETRIC.get(surface.formula)
    if form is None:
        return f"only {', '.join(PARAMETRIC.values())} have a parametric form here; take the method contour"
    if form not in ("sphere", "torus") and not isinstance(surface.domain, Box):
        return f"a {form} is tessellated in a box"
    return None


def _parametric(surface: Surface, n: int) -> Mesh:
    """Return the mesh of a surface's parametric form with `n` points around, and around the tube of a torus too.

    An arc of a torus has its share of `n`, rounded up. Raises FirsthitError if the surface has no form known here.
    """
    import pyvista

    if reason := parametric_refusal(surface):
        raise FirsthitError(f"{surface.name} has no parametric mesh: {reason}")
    values = {name: float(text) for name, text in surface.parameters}
    form = PARAMETRIC[surface.formula]
    if form == "sphere":
        shape = pyvista.Sphere(radius=values["R"], theta_resolution=n, phi_resolution=max(3, n // 2 + 1))
        return _finished(surface, shape, closed=True)
    box = surface.domain
    assert isinstance(box, Box)
    if form == "torus":
        return _finished(surface, _torus(values["R"], values["r"], box, n), closed=max(box.lower[:2]) < 0.0)
    if form == "plane":
        return _finished(surface, _plane(box), closed=False)
    heights = np.array([box.lower[2], box.upper[2]])
    radii = np.array([values["r"]] * 2) if form == "cylinder" else values["a"] + values["b"] * heights
    return _finished(surface, _mantle(radii, heights, n), closed=False)


def _plane(box: Box) -> Any:
    """Return the rectangle of the plane z = 0 in a box, as a pyvista shape of two triangles."""
    import pyvista

    shape = pyvista.Plane(i_size=1.0, j_size=1.0, i_resolution=1, j_resolution=1).triangulate()
    lower, upper = np.array(box.lower), np.array(box.upper)
    shape.points = (0.5 * (lower + upper) + shape.points * (upper - lower)) * [1.0, 1.0, 0.0]
    return shape


def _mantle(radii: NDArray[np.float64], heights: NDArray[np.float64], n: int) -> Any:
    """Return the mantle of a cylinder or cone about the z axis, as a pyvista shape; both ends are float64[2]."""
    import pyvista

    turn = np.linspace(0.0, 2.0 * np.pi, n + 1)
    x, y = (radii[:, None] * part(turn) for part in (np.cos, np.sin))
    grid = pyvista.StructuredGrid(x, y, np.broadcast_to(heights[:, None], x.shape).copy())
    return grid.extract_surface(algorithm=None).clean(tolerance=1e-9).triangulate()


def _torus(ring: float, tube: float, box: Box, n: int) -> Any:
    """Return the part of a torus in a box, as a pyvista shape.

    The box is the torus's own, or that of a half or a quarter of it, whose x, or x and y, begin at 0. Raises
    FirsthitError for any other box.
    """
    import pyvista
    from vtkmodules.vtkCommonComputationalGeometry import vtkParametricTorus

    outer = ring + tube
    starts = [box.lower[0] >= 0.0, box.lower[1] >= 0.0]
    expected = [0.0 if starts[0] else -outer, 0.0 if starts[1] else -outer, -tube]
    if not np.allclose([*box.lower, *box.upper], [*expected, outer, outer, tube], atol=1e-6):
        raise FirsthitError(f"a torus is tessellated whole, by halves or by quarters, and its box is {box}")
    form = vtkParametricTorus()
    form.SetRingRadius(ring)
    form.SetCrossSectionRadius(tube)
    if any(starts):
        form.JoinUOff()
        form.SetMinimumU(0.0 if starts[0] else -np.pi / 2)  # x = sin u, y = cos u
        form.SetMaximumU(np.pi / 2 if starts[1] else np.pi)
        share = (form.GetMaximumU() - form.GetMinimumU()) / (2.0 * np.pi)
        n_ring = int(np.ceil(n * share)) + 1
    else:
        n_ring = n + 1
    return pyvista.surface_from_para(form, u_res=n_ring, v_res=n + 1, w_res=n + 1, clean=True)


def _contour(surface: Surface, recipe: MeshRecipe) -> Mesh:
    """Return the mesh of f = 0 by flying edges on a grid, clipped by the domain if that is a ball.

    The grid has recipe.resolution cells along the longest side of the domain's box. Raises FirsthitError if it is too
    coarse to show anything.
    """
    import pyvista

    import surfaces

    domain = surface.domain
    if isinstance(domain, Box):
        lower, upper = np.array(domain.lower), np.array(domain.upper)
    else:
        lower, upper = np.array(domain.center) - domain.radius, np.array(domain.center) + domain.radius
    cell = (upper - lower).max() / recipe.resolution
    cells = np.maximum(1, np.ceil((upper - lower) / cell - 1e-9)).astype(int)
    spacing = (upper - lower) / cells
    grid = pyvista.ImageData(dimensions=tuple(cells + 1), spacing=tuple(spacing), origin=tuple(lower))
    grid["f"] = surfaces.evaluate(surface, np.asarray(grid.points))
    shape: Any = grid.contour([0.0], scalars="f", method="flying_edges")
    if not shape.n_points:
        raise FirsthitError(f"a grid of {recipe.resolution} cells shows nothing of {surface.name}; take a finer one")
    if not isinstance(domain, Box):
        shape["away"] = np.linalg.norm(np.asarray(shape.points) - np.array(domain.center), axis=1)
        shape = shape.clip_scalar(scalars="away", value=domain.radius).triangulate()
    return _finished(surface, shape, closed=False)


def _finished(surface: Surface, shape: Any, closed: bool) -> Mesh:
    """Return a pyvista shape as a mesh, with normals along f's gradient, which point to where f > 0.

    Triangles are turned to be counterclockwise as seen from there.
    """
    import surfaces

    points = np.asarray(shape.points, np.float64)
    triangles = np.array(shape.faces, np.int64).reshape(-1, 4)[:, 1:]
    gradients = surfaces.gradient(surface, points)
    lengths = np.linalg.norm(gradients, axis=1, keepdims=True)
    normals = np.where(lengths > 0.0, gradients / np.where(lengths > 0.0, lengths, 1.0), [0.0, 0.0, 1.0])
    a, b, c = (points[triangles[:, k]] for k in range(3))
    inwards = np.einsum("ij,ij->i", np.cross(b - a, c - a), normals[triangles].mean(axis=1)) < 0.0
    triangles[inwards] = triangles[inwards][:, ::-1]
    vertices = np.concatenate([points, normals], axis=1).astype(np.float32)
    return Mesh(vertices, triangles.astype(np.uint32), closed)


def geometric_error(surface: Surface, made: Mesh, pieces: int = 2) -> tuple[float, float]:
    """Return the largest distances from mesh to surface and from surface to mesh over samples, in scene units.

    The samples of the mesh are `pieces` + 1 points along each side of every triangle, and points between them. Their
    distance to the surface is that of the surface's distance function, or |f| / |grad f| if it states none. The samples
    of the surface are the FARTHEST of these points, moved onto the surface along the gradient.
    """
    import pyvista

    import surfaces
    from surfaces.evaluation import evaluate_tape
    from surfaces.formula import parse
    from surfaces.lowering import gradient, real_tape

    corners = made.vertices[:, :3].astype(np.float64)[made.triangles]
    weights = [(i, j, pieces - i - j) for i in range(pieces + 1) for j in range(pieces + 1 - i)]
    points = np.einsum("wk,fkx->fwx", np.array(weights) / pieces, corners).reshape(-1, 3)

    def off(at: NDArray[np.float64]) -> NDArray[np.float64]:
        f, slope = surfaces.evaluate(surface, at), surfaces.gradient(surface, at)
        return np.asarray(f[:, None] * slope / np.einsum("ij,ij->i", slope, slope)[:, None])

    away = np.linalg.norm(off(points), axis=1)
    if surface.distance:
        tape = real_tape(parse(surface.distance, dict(surface.parameters)))
        if np.allclose(np.linalg.norm(evaluate_tape(gradient(tape), points), axis=1), 1.0, rtol=0.0, atol=1e-6):
            away = evaluate_tape(tape, points)[:, 0]  # not only a bound of the distance, but the distance
    onto = points[np.argsort(-np.abs(away), kind="stable")[:FARTHEST]]
    for _ in range(6):
        onto = onto - off(onto)
    faces = np.column_stack([np.full(len(made.triangles), 3), made.triangles]).ravel()
    shape = pyvista.PolyData(made.vertices[:, :3].astype(np.float64), faces)
    back = pyvista.PolyData(onto).compute_implicit_distance(shape)["implicit_distance"]
    return float(np.abs(away).max()), float(np.abs(back).max())
