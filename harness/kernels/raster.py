"""Make the programs of stage raster: proxies whose fragments cast rays, triangles of a mesh, and every pixel's ray.

They are in GLSL and float32. The programs of vertices are in `Program.vertex`.
"""

from __future__ import annotations

from pathlib import Path

from harness.contract import FirsthitError, Method, Normal, Origin, Program, Proxy, Section, Surface, Variant
from harness.kernels.sections import (
    cast_sections,
    early_libraries,
    file_section,
    files,
    head_sections,
    kept_loops,
    literal,
    method_sections,
    ray_sections,
)
from surfaces.formula import number

TORUS = "(x^2 + y^2 + z^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)"  # about the z axis, as the catalog writes it
PROXY_SIDES = 16  # of the polygon about a ball's outline, whose area is 1.3 % more than the disk's
RAY_OF_PIXEL = ("rays/camera.glsl", "raster/view.glsl", "raster/ray.glsl")
INSTANCE_OF_VIEW = ("raster/view.glsl", "raster/instance.glsl")


def raster_program(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    proxy: Proxy,
    reports: bool,
    free: bool = False,
    pixels: float = 0.0,
    origin: Origin = "nearest",
    normal: Normal = "distance",
) -> Program:
    """Return the float32 GLSL program that draws a proxy about each instance of `surface` and casts rays by `variant`.

    Every fragment of a proxy casts the ray through its pixel's middle. With `reports` the program also writes what the
    check reads, and the compiler may remove none of its loops. With `free`, each instance has its own parameters and
    domain. The method's tolerance may grow to `pixels` times the footprint of a pixel; 0 leaves it as it is. `origin`
    is as for method_program, of the ray in the instance's coordinates. `normal` says what hits are shaded by: the
    gradient of the distance function (of f, if the surface states none), the gradient of f, or the torus's core circle.

    Raises FirsthitError if the surface lacks a function that the method or the shading needs.
    """
    shading = _shading(surface, normal, free)
    needs = (*method.needs, *([] if normal == "core_circle" else [shading]))
    sections = ray_sections(surface, needs, "float32", "glsl", early_libraries(method), free)
    if pixels:
        sections += files("raster/tolerance.glsl")
    sections += method_sections(method, folder, variant, surface, "float32", "glsl", pixels > 0.0)
    if normal == "core_circle":
        sections += _core_circle_sections(surface)
    sections.append(Section("generated: shading", f"#define SHADING_NORMAL {shading}"))
    sections += cast_sections(origin)
    reporting = ("turns.glsl", "raster/report.glsl") if reports else ()
    sections += files(*RAY_OF_PIXEL, "raster/fragment.glsl", "raster/shade.glsl", *reporting)
    sections += files(f"raster/entry_raster{'_check' * reports}.frag.glsl")
    if reports:
        sections.insert(1, kept_loops())
    return Program("glsl", "float32", "raster", tuple(sections), _proxy_sections(proxy, free, pixels))


def _proxy_sections(proxy: Proxy, free: bool, pixels: float) -> tuple[Section, ...]:
    """Return the sections of the program that places a proxy's corners; `free` and `pixels` as for raster_program."""
    return (
        *head_sections("glsl", "float32", ()),
        Section("generated: proxy", f"#define PROXY_SIDES {PROXY_SIDES}\n#define PIXELS {float(pixels)!r}"),
        *files(
            *INSTANCE_OF_VIEW,
            f"raster/proxy_{proxy}.glsl",
            f"raster/{'free' if free else 'baked'}.vert.glsl",
            f"raster/{'tolerance' if pixels else 'exact'}.vert.glsl",
            "raster/entry_raster.vert.glsl",
        ),
    )


def _core_circle_sections(surface: Surface) -> list[Section]:
    """Return the normal of a torus by its core circle, with the torus's radii as constants."""
    ring, tube = (literal(number(dict(surface.parameters)[name]), "float32", "glsl") for name in ("R", "r"))
    radii = f"#define RING_RADIUS {ring}\n#define TUBE_RADIUS {tube}"
    return [Section("generated: radii", radii), *files("raster/normal_core_circle.glsl")]


def _shading(surface: Surface, normal: Normal, free: bool) -> str:
    """Return the name of the function that hits are shaded by.

    Raises FirsthitError if `normal` is "core_circle" and the surface is not a torus with R >= r that all instances
    share.
    """
    if normal != "core_circle":
        return "surface_distance_normal" if surface.distance and normal == "distance" else "surface_normal"
    values = {name: float(text) for name, text in surface.parameters}
    if surface.formula != TORUS or free or values["R"] < values["r"]:
        raise FirsthitError(f"{surface.name} is shaded by no core circle: only tori with R >= r that share both are")
    return "core_circle_normal"


def mesh_program(folder: Path, reports: bool) -> Program:
    """Return the program that draws triangles. `folder` holds the kernel that defines mesh_normal.

    With `reports` it also writes what the check reads.
    """
    head = head_sections("glsl", "float32", ())
    sections = [*head, *files(*RAY_OF_PIXEL, "raster/shade.glsl", *(["raster/report.glsl"] * reports))]
    sections += [file_section(folder / "kernel.glsl"), *files(f"raster/entry_mesh{'_check' * reports}.frag.glsl")]
    vertex = (*head, *files(*INSTANCE_OF_VIEW, "raster/entry_mesh.vert.glsl"))
    return Program("glsl", "float32", "mesh", tuple(sections), vertex)


def proof_program(proxy: Proxy) -> Program:
    """Return the program of a fingerprint that draws a proxy, and casts a ray at a fixed torus for every fragment."""
    sections = head_sections("glsl", "float32", ())
    names = ("map/torus.glsl", *RAY_OF_PIXEL, "raster/fragment.glsl", "raster/shade.glsl", "raster/report.glsl")
    sections += files(*names, "map/proxy.frag.glsl")
    sections.insert(1, kept_loops())
    return Program("glsl", "float32", "raster", tuple(sections), _proxy_sections(proxy, False, 0.0))


def fill_program() -> Program:
    """Return the program that reports the ray of every pixel, and draws nothing."""
    head = head_sections("glsl", "float32", ())
    sections = (*head, *files(*RAY_OF_PIXEL, "raster/report.glsl", "raster/entry_fill.frag.glsl"))
    return Program("glsl", "float32", "fill", sections, (*head, *files("raster/entry_fill.vert.glsl")))
