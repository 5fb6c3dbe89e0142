"""Return the parts of programs: kernel files, which are never edited, and what is generated for a method."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Literal

from harness import ROOT
from harness.contract import (
    Box,
    FirsthitError,
    Language,
    Method,
    Origin,
    Parameter,
    Precision,
    Program,
    Section,
    Surface,
    Variant,
)
from harness.kernels.complaints import recursion
from harness.stated import read_file
from surfaces.words import suggestion

KERNELS = Path(__file__).parent / "glsl"
AFTER_TABLES = ("fit_samples", "fit_whole")  # libraries that read a method's tables, and so come after them
# How the 16 lanes of a tile lie on work items: one work item has them all as a vector or takes them in turn, or 16 of
# them have one each, and are a work group or half a warp.
Lanes = Literal["vector", "own", "group", "warp"]
TileStage = Literal["isolate", "finish", "packets", "rest"]  # of a frame of tiles, each a program of its own
STAGE_FILES: dict[TileStage, tuple[str, ...]] = {  # of a method's folder, those that stand behind kernel.glsl
    "isolate": ("isolate",),
    "finish": ("correct", "refine", "finish"),
    "packets": ("correct", "refine", "packets"),
    "rest": ("correct", "rest"),
}


@cache
def _read(path: Path) -> str:
    """Return the text of a file of ours, which is read once."""
    return path.read_text(encoding="utf-8")


def file_section(path: Path) -> Section:
    """Return one file as a section.

    Its origin is the path below the project (`methods/newton/kernel.glsl`) or else below the working folder, where
    editors find it, or the last three parts of an outer path. A method's file is read anew each time, since it may be
    edited while a notebook runs. Raises FirsthitError, with exit code 3, where it cannot be read any more.
    """
    full = path.absolute()
    here = next((top for top in (ROOT, Path.cwd()) if full.is_relative_to(top)), None)
    origin = full.relative_to(here) if here else Path(*full.parts[-3:])
    if path.is_relative_to(KERNELS):
        return Section(origin.as_posix(), _read(path))
    try:
        text = io.TextIOWrapper(io.BytesIO(read_file(path)), encoding="utf-8-sig").read()
    except UnicodeDecodeError:
        raise FirsthitError(f"{path}: it is not written in UTF-8; save it in this encoding", exit_code=3) from None
    return Section(origin.as_posix(), text)


def files(*names: str) -> list[Section]:
    """Return files below glsl/ as sections."""
    return [file_section(KERNELS / name) for name in names]


def _library(name: str) -> Section:
    """Return a file of glsl/lib as a section. Raises FirsthitError if there is none of that name."""
    path = KERNELS / "lib" / f"{name}.glsl"
    if not path.exists():
        known = sorted(p.stem for p in path.parent.glob("*.glsl"))
        raise FirsthitError(f"there is no kernel library {name!r}; {suggestion(name, known)}")
    return file_section(path)


def head_sections(language: Language, precision: Precision, libraries: Iterable[str]) -> list[Section]:
    """Return prelude, number type and libraries, each once: eft, ray, hit and those given, in this order."""
    ordered = list(dict.fromkeys(("eft", "ray", "hit", *libraries)))
    head = files(f"prelude.{language}", f"{precision}.{language}")
    return head + [_library(name) for name in ordered]


def literal(value: float | int, precision: Precision, language: Language) -> str:
    """Return a number as source text: an int as it is, a real with every digit and the suffix of its type."""
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
    """Define a variant's knobs as constants.

    `loosened` holds the knobs, by name, whose value depends on the instance that a fragment casts at: a tolerance is
    at least the instance's, and a number of halvings at most what reaches it. `Parameter.per` turns one into the other.
    """
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
    """Return a constant array of reals as a section, `TABLE real NAME[n]`, with every digit of its numbers."""
    from harness.kernels.printing import table

    return Section(f"generated: table {name}", table(name, values, precision, language))


def early_libraries(method: Method) -> list[str]:
    """Return the libraries of a method that stand before the surface's functions."""
    return [name for name in method.libraries if name not in AFTER_TABLES]


def ray_sections(
    surface: Surface,
    needs: Iterable[str],
    precision: Precision,
    language: Language,
    libraries: Iterable[str],
    free: bool = False,
) -> list[Section]:
    """Return what stands before the kernel of a method that casts rays: libraries, the surface and its domain.

    `free` is as for `surface_sections`.
    """
    from harness.kernels.functions import libraries_for, surface_sections

    sections = head_sections(language, precision, (*libraries_for(needs, surface), *libraries))
    if free:
        sections += files("raster/free.glsl")
    sections += surface_sections(surface, needs, precision, language, free)
    return [*sections, _domain_section(surface)]


def kept_loops() -> Section:
    """Return what keeps the compiler from removing loops of a GLSL program whose answers are checked.

    It stands after the prelude, since #version must come first.
    """
    return file_section(KERNELS / "kept_loops.glsl")


def with_free_loops(program: Program) -> Program:
    """Return a program as it is timed, where a compiler may remove the loops that nothing depends on."""
    return replace(program, sections=tuple(s for s in program.sections if s != kept_loops()))


def cast_sections(origin: Origin) -> list[Section]:
    """Return what the harness does with every ray before and after the method: shift, clip and call."""
    return files(f"rays/origin_{origin}.glsl", "rays/cast.glsl")


def t_min_section(t_min: float, precision: Precision, language: Language) -> Section:
    """Define T_MIN, the least number of the precision that is not under t_min.

    Raises FirsthitError if t_min is negative or not finite.
    """
    from harness.kernels.printing import bounds, number

    if not 0.0 <= t_min < math.inf:
        raise FirsthitError(f"t_min is {t_min:g}: give a distance along the ray, finite and not under 0")
    _, least = bounds(Fraction(t_min), Fraction(t_min), precision)
    return Section("generated: where listed rays begin", f"#define T_MIN {number(least, precision, language)}")


def _domain_section(surface: Surface) -> Section:
    """Return the function that clips a ray by the kind of domain that the surface has."""
    return file_section(KERNELS / ("domain_box.glsl" if isinstance(surface.domain, Box) else "domain_sphere.glsl"))


def method_sections(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    precision: Precision,
    language: Language,
    loose: bool = False,
    stage: TileStage | None = None,
) -> list[Section]:
    """Return the method's own sections, which come after the surface's: its knobs, tables, late libraries and kernel.

    If `loose`, knobs that state `per` may be loosened, see `_parameter_section`. If a `stage` of tiles is given, the
    folder's STAGE_FILES of it stand behind the kernel. Raises FirsthitError with exit code 3 where a function of these
    files calls itself.
    """
    loosened = {p.name: p for p in method.parameters if p.per} if loose else None
    sections = [_parameter_section(variant, precision, language, loosened)] if variant.parameters else []
    if method.tables:
        tables = method.tables(surface, dict(variant.parameters), precision)
        sections += [table_section(name, values, precision, language) for name, values in tables.items()]
    sections += [_library(name) for name in method.libraries if name in AFTER_TABLES]
    return [*sections, *_own_files([folder / "kernel.glsl"]), *(stage_sections(folder, stage) if stage else [])]


def stage_sections(folder: Path, stage: TileStage) -> list[Section]:
    """Return those of STAGE_FILES of a stage that are in the folder. Raises FirsthitError as `method_sections` does."""
    return _own_files([path for name in STAGE_FILES[stage] if (path := folder / f"{name}.glsl").exists()])


def _own_files(paths: Iterable[Path]) -> list[Section]:
    """Return files of a method as sections. Raises FirsthitError, with exit code 3, where a function calls itself."""
    texts = [file_section(path) for path in paths]
    if complaint := next(filter(None, map(recursion, texts)), None):
        raise FirsthitError(str(complaint), exit_code=3)
    return texts


def beam_sections(
    surface: Surface, needs: Iterable[str], precision: Precision, language: Language, libraries: Iterable[str] = ()
) -> list[Section]:
    """Return what stands before the kernel of a method that casts beams: libraries, the surface and the quadtree.

    Raises FirsthitError if the surface lacks one of the functions in `needs`.
    """
    from harness.kernels.functions import libraries_for, surface_sections

    sections = head_sections(language, precision, (*libraries_for(needs, surface), *libraries))
    sections += surface_sections(surface, needs, precision, language)
    turns = ["turns.glsl"] if language == "glsl" else []
    return sections + files("beams/beam.glsl", *turns, f"beams/quadtree.{language}", "beams/cells.glsl")
