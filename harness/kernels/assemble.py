"""Ordered sections → one program text. Chooses whole files and generated sections; never edits kernel text."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Literal

from harness.contract import (
    Box,
    FirsthitError,
    Method,
    Normal,
    Origin,
    Parameter,
    Precision,
    Program,
    Proxy,
    Section,
    Surface,
    Variant,
)

ROOT = Path(__file__).parents[2]
KERNELS = Path(__file__).parent / "glsl"
AFTER_TABLES = ("fit_samples", "fit_whole")  # libraries that read the surface's degree and the method's tables
TORUS = "(x^2 + y^2 + z^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)"  # about z, as the catalog writes it
PROXY_SIDES = 16  # of the polygon about a ball's outline: 1.3 % more than the disk
RAY_OF_PIXEL = ("rays/camera.glsl", "raster/view.glsl", "raster/ray.glsl")
INSTANCE_OF_VIEW = ("raster/view.glsl", "raster/instance.glsl")
Language = Literal["glsl", "cl"]


@cache
def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def file_section(path: Path) -> Section:
    """A section holding one file, named by its last three path parts at most (`methods/newton/kernel.glsl`)."""
    origin = path.relative_to(ROOT) if path.is_relative_to(ROOT) else Path(*path.parts[-3:])
    return Section(origin.as_posix(), _read(path))


def _files(*names: str) -> list[Section]:
    """Sections of files below glsl/."""
    return [file_section(KERNELS / name) for name in names]


def _library(name: str) -> Section:
    path = KERNELS / "lib" / f"{name}.glsl"
    if not path.exists():
        known = ", ".join(sorted(p.stem for p in path.parent.glob("*.glsl")))
        raise FirsthitError(f"there is no kernel library {name!r}; there are {known}")
    return file_section(path)


def _head(language: Language, precision: Precision, libraries: Iterable[str]) -> list[Section]:
    """Prelude, number type and libraries, each once, in the order in which they need one another."""
    ordered = list(dict.fromkeys(("eft", "ray", "hit", *libraries)))
    head = _files(f"prelude.{language}", f"{precision}.{language}")
    return head + [_library(name) for name in ordered]


def literal(value: float | int, precision: Precision, language: Language) -> str:
    """`value` as shader source, every digit kept: ints stay ints, reals get the suffix their compiler needs."""
    if isinstance(value, int):
        return f"({value})" if value < 0 else str(value)
    suffix = "f" if precision == "float32" else {"glsl": "lf", "cl": ""}[language]
    text = repr(float(value))
    if "e" in text and "." not in text:
        text = text.replace("e", ".0e")
    return f"({text}{suffix})" if value < 0 else text + suffix


def _parameter_section(
    variant: Variant, precision: Precision, language: Language, loosened: Mapping[str, Parameter] | None = None
) -> Section:
    """The knobs as constants; `loosened` ones stop where the instance's tolerance is reached."""
    lines = []
    for name, value in variant.parameters:
        text = literal(value, precision, language)
        if loosened and name in loosened:
            per = loosened[name].per
            if loosened[name].finer == "up":
                text = f"min({text}, max(1, int(ceil(log2(({per}) / instance_tolerance)))))"
            else:
                text = f"max({text}, instance_tolerance / ({per}))"
        lines.append(f"#define {name} {text}")
    return Section(f"generated: parameters of {variant.method}", "\n".join(lines))


def table_section(name: str, values: Sequence[float], precision: Precision, language: Language) -> Section:
    """A constant array of reals, every digit kept: `TABLE real NAME[n]`."""
    from harness.kernels.printing import table

    return Section(f"generated: table {name}", table(name, values, precision, language))


def method_program(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    precision: Precision,
    language: Language,
    entry: Literal["rays", "camera", "beams"],
    narrowed: Section | None = None,
    t_min: float = 0.0,
    origin: Origin = "nearest",
) -> Program:
    """The program that casts rays or beams at `surface` by `variant`; `folder` holds the method's kernel.glsl.

    `narrowed` is the prepass's parameters where rays are to be narrowed by it. `t_min`, in units of t, is where listed
    rays begin. In GLSL the compiler may remove none of its loops, but of a camera's program, which is only timed.
    `origin` is where the method sees its rays begin.

    Raises FirsthitError where the surface lacks a function that the method needs, t_min is no distance, or the method
    casts no rays whose origin could be chosen.
    """
    from harness.kernels.functions import libraries_for, surface_sections

    listed = entry == "rays" and narrowed is None
    needs = (*method.needs, "surface_value") if listed else method.needs
    early = [name for name in method.libraries if name not in AFTER_TABLES]
    if entry == "beams":
        sections = beam_sections(surface, method.needs, precision, language, early)
    else:
        sections = _head(language, precision, (*libraries_for(needs, surface), *early))
        sections += surface_sections(surface, needs, precision, language)
        sections.append(_domain_section(surface))
    sections += method_sections(method, folder, variant, surface, precision, language)
    if entry != "beams":
        sections += _cast_sections(origin)
    elif origin != "nearest":
        raise FirsthitError(f"an origin is chosen for rays, and the method {method.name} casts beams")
    if listed:
        sections += [_t_min_section(t_min, precision, language), *_files("rays/listed.glsl")]
    if entry == "camera":
        sections += _files("rays/camera.glsl")
    if narrowed:
        sections += [narrowed, *_files("rays/narrowed.glsl")]
    suffix = "_narrowed" if narrowed else ""
    if entry == "rays" and language == "glsl":
        sections += _files("turns.glsl")
    if entry != "camera" and language == "glsl":
        sections.insert(1, kept_loops())
    room = "beams" if entry == "beams" else "rays"
    sections += _files(f"{room}/entry_{entry}{suffix}.{language}")
    return Program(language, precision, entry, tuple(sections))


def kept_loops() -> Section:
    """What keeps the loops of a GLSL program whose answers are checked; behind the prelude, which holds #version."""
    return file_section(KERNELS / "kept_loops.glsl")


def with_free_loops(program: Program) -> Program:
    """The program as it is timed: a compiler may remove the loops that nothing depends on."""
    return replace(program, sections=tuple(s for s in program.sections if s != kept_loops()))


def _cast_sections(origin: Origin) -> list[Section]:
    return _files(f"rays/origin_{origin}.glsl", "rays/cast.glsl")


def _t_min_section(t_min: float, precision: Precision, language: Language) -> Section:
    """T_MIN, the least number of the precision that is not under t_min."""
    from harness.kernels.printing import bounds, number

    if not 0.0 <= t_min < math.inf:
        raise FirsthitError(f"t_min is {t_min:g}: give a distance along the ray, finite and not under 0")
    _, least = bounds(Fraction(t_min), Fraction(t_min), precision)
    return Section("generated: where listed rays begin", f"#define T_MIN {number(least, precision, language)}")


def _domain_section(surface: Surface) -> Section:
    return file_section(KERNELS / ("domain_box.glsl" if isinstance(surface.domain, Box) else "domain_sphere.glsl"))


def method_sections(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    precision: Precision,
    language: Language,
    loose: bool = False,
) -> list[Section]:
    """The method itself, with its knobs bound and its tables; after the surface's sections."""
    loosened = {p.name: p for p in method.parameters if p.per} if loose else None
    sections = [_parameter_section(variant, precision, language, loosened)] if variant.parameters else []
    if method.tables:
        tables = method.tables(surface, dict(variant.parameters), precision)
        sections += [table_section(name, values, precision, language) for name, values in tables.items()]
    sections += [_library(name) for name in method.libraries if name in AFTER_TABLES]
    return [*sections, file_section(folder / "kernel.glsl")]


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
    """The program whose fragments, of a proxy about each instance of `surface`, cast rays by `variant`, in GLSL and
    float32. With `reports` it also writes what the check reads, and the compiler may remove none of its loops.
    `free`: parameters and domain are each instance's own. `pixels`: how many footprints of a pixel the method's
    tolerance may grow to; 0 leaves it alone. `origin`: as for method_program, of the ray in the instance's coordinates.
    `normal`: what hits are shaded by, the gradient of the distance (of f, where none is stated), that of f, or the
    torus's core circle.

    Raises FirsthitError where the surface lacks a function that the method or the shading needs.
    """
    from harness.kernels.functions import libraries_for, surface_sections

    shading = _shading(surface, normal, free)
    needs = (*method.needs, *([] if normal == "core_circle" else [shading]))
    early = [name for name in method.libraries if name not in AFTER_TABLES]
    sections = _head("glsl", "float32", (*libraries_for(needs, surface), *early))
    if free:
        sections += _files("raster/free.glsl")
        sections += surface_sections(surface, needs, "float32", "glsl", free=True)
    else:
        sections += surface_sections(surface, needs, "float32", "glsl")
    sections.append(_domain_section(surface))
    if pixels:
        sections += _files("raster/tolerance.glsl")
    sections += method_sections(method, folder, variant, surface, "float32", "glsl", pixels > 0.0)
    if normal == "core_circle":
        ring, tube = (literal(float(dict(surface.parameters)[name]), "float32", "glsl") for name in ("R", "r"))
        radii = f"#define RING_RADIUS {ring}\n#define TUBE_RADIUS {tube}"
        sections += [Section("generated: radii", radii), *_files("raster/normal_core_circle.glsl")]
    sections.append(Section("generated: shading", f"#define SHADING_NORMAL {shading}"))
    sections += _cast_sections(origin)
    reporting = ("turns.glsl", "raster/report.glsl") if reports else ()
    sections += _files(*RAY_OF_PIXEL, "raster/fragment.glsl", "raster/shade.glsl", *reporting)
    sections += _files(f"raster/entry_raster{'_check' * reports}.frag.glsl")
    if reports:
        sections.insert(1, kept_loops())
    vertex = [
        *_head("glsl", "float32", ()),
        Section("generated: proxy", f"#define PROXY_SIDES {PROXY_SIDES}\n#define PIXELS {float(pixels)!r}"),
        *_files(
            *INSTANCE_OF_VIEW,
            f"raster/proxy_{proxy}.glsl",
            f"raster/{'free' if free else 'baked'}.vert.glsl",
            f"raster/{'tolerance' if pixels else 'exact'}.vert.glsl",
            "raster/entry_raster.vert.glsl",
        ),
    ]
    return Program("glsl", "float32", "raster", tuple(sections), tuple(vertex))


def _shading(surface: Surface, normal: Normal, free: bool) -> str:
    """The function that hits are shaded by; FirsthitError where it is the core circle's and there is none."""
    if normal != "core_circle":
        return "surface_distance_normal" if surface.distance and normal == "distance" else "surface_normal"
    values = {name: float(text) for name, text in surface.parameters}
    if surface.formula != TORUS or free or values["R"] < values["r"]:
        raise FirsthitError(f"{surface.name} is shaded by no core circle: only tori with R >= r that share both are")
    return "core_circle_normal"


def mesh_program(folder: Path, reports: bool) -> Program:
    """The program that draws triangles; `folder` holds the kernel that defines mesh_normal."""
    head = _head("glsl", "float32", ())
    sections = [*head, *_files(*RAY_OF_PIXEL, "raster/shade.glsl", *(["raster/report.glsl"] * reports))]
    sections += [file_section(folder / "kernel.glsl"), *_files(f"raster/entry_mesh{'_check' * reports}.frag.glsl")]
    vertex = (*head, *_files(*INSTANCE_OF_VIEW, "raster/entry_mesh.vert.glsl"))
    return Program("glsl", "float32", "mesh", tuple(sections), vertex)


def fill_program() -> Program:
    """The program that reports every pixel's ray."""
    head = _head("glsl", "float32", ())
    sections = (*head, *_files(*RAY_OF_PIXEL, "raster/report.glsl", "raster/entry_fill.frag.glsl"))
    return Program("glsl", "float32", "fill", sections, (*head, *_files("raster/entry_fill.vert.glsl")))


def beam_sections(
    surface: Surface, needs: Iterable[str], precision: Precision, language: Language, libraries: Iterable[str] = ()
) -> list[Section]:
    """What comes before the kernel of a method that casts beams."""
    from harness.kernels.functions import libraries_for, surface_sections

    sections = _head(language, precision, (*libraries_for(needs, surface), *libraries))
    sections += surface_sections(surface, needs, precision, language)
    turns = ["turns.glsl"] if language == "glsl" else []
    return sections + _files("beams/beam.glsl", *turns, f"beams/quadtree.{language}", "beams/cells.glsl")


def map_program(
    item: Section | Iterable[Section],
    precision: Precision,
    language: Language,
    libraries: Iterable[str] = (),
) -> Program:
    """A program that runs `map_item` of the last given section over rows (INPUTS and OUTPUTS are its #defines)."""
    items = [item] if isinstance(item, Section) else list(item)
    entry = file_section(KERNELS / f"map/entry_map.{language}")
    return Program(language, precision, "map", (*_head(language, precision, libraries), *items, entry))


ONE_COUNTER = (
    "\nin a program that is checked, the head of a `for` loop holds no comma outside brackets: count by one variable"
)
_LINE = re.compile(r"(?m)^(?P<head>.*?)(?:\b0:|<kernel>:|\binput\.cl:|\.cl:|\b\d+:)(?P<line>\d+)(?P<tail>[:(].*)$")


def explain_log(program: Program, log: str) -> str:
    """A compiler's log with every line number replaced by the section's own file and line, and the rule of loops'
    heads where that one is broken."""

    def at_home(match: re.Match[str]) -> str:
        origin, line = program.locate(int(match["line"]))
        return f"{origin}:{line}{match['tail']}"

    return _LINE.sub(at_home, log).strip() + (ONE_COUNTER if re.search(r"\bmacro\b.{0,20}\bfor\b", log) else "")
