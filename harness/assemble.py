"""Ordered sections → one program text. Chooses whole files and generated sections; never edits kernel text."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Literal

from harness.contract import Box, FirsthitError, Method, Precision, Program, Section, Surface, Variant

KERNELS = Path(__file__).parent / "kernels"
AFTER_TABLES = ("fit_samples",)  # libraries that read the surface's degree and the method's tables
Language = Literal["glsl", "cl"]


@cache
def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def file_section(path: Path) -> Section:
    """A section holding one file, named by its last three path parts at most (`methods/newton/kernel.glsl`)."""
    root = KERNELS.parent.parent
    origin = path.relative_to(root) if path.is_relative_to(root) else Path(*path.parts[-3:])
    return Section(origin.as_posix(), _read(path))


def _library(name: str) -> Section:
    path = KERNELS / "lib" / f"{name}.glsl"
    if not path.exists():
        known = ", ".join(sorted(p.stem for p in path.parent.glob("*.glsl")))
        raise FirsthitError(f"there is no kernel library {name!r}; there are {known}")
    return file_section(path)


def _head(language: Language, precision: Precision, libraries: Iterable[str]) -> list[Section]:
    """Prelude, number type and libraries, each once, in the order in which they need one another."""
    ordered = list(dict.fromkeys(("eft", "ray", "hit", *libraries)))
    head = [file_section(KERNELS / f"prelude.{language}"), file_section(KERNELS / f"{precision}.{language}")]
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


def _parameter_section(variant: Variant, precision: Precision, language: Language) -> Section:
    lines = [f"#define {name} {literal(value, precision, language)}" for name, value in variant.parameters]
    return Section(f"generated: parameters of {variant.method}", "\n".join(lines))


def table_section(name: str, values: Sequence[float], precision: Precision, language: Language) -> Section:
    """A constant array of reals, every digit kept: `TABLE real NAME[n]`."""
    from surfaces.printing import table

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
) -> Program:
    """The program that casts rays or beams at `surface` by `variant`; `folder` holds the method's kernel.glsl.

    `narrowed` is the prepass's parameters where rays are to be narrowed by it. Raises FirsthitError where the surface
    lacks a function that the method needs.
    """
    from surfaces.sections import libraries_for, surface_sections

    early = [name for name in method.libraries if name not in AFTER_TABLES]
    if entry == "beams":
        sections = beam_sections(surface, method.needs, precision, language, early)
    else:
        sections = _head(language, precision, (*libraries_for(method.needs, surface), *early))
        sections += surface_sections(surface, method.needs, precision, language)
        domain = "domain_box" if isinstance(surface.domain, Box) else "domain_sphere"
        sections.append(file_section(KERNELS / f"{domain}.glsl"))
    if variant.parameters:
        sections.append(_parameter_section(variant, precision, language))
    if method.tables:
        tables = method.tables(surface, dict(variant.parameters), precision)
        sections += [table_section(name, values, precision, language) for name, values in tables.items()]
    sections += [_library(name) for name in method.libraries if name in AFTER_TABLES]
    sections.append(file_section(folder / "kernel.glsl"))
    if entry != "beams":
        sections.append(file_section(KERNELS / "cast.glsl"))
    if entry == "camera":
        sections.append(file_section(KERNELS / "camera.glsl"))
    if narrowed:
        sections += [narrowed, file_section(KERNELS / "narrowed.glsl")]
    suffix = "_narrowed" if narrowed else ""
    sections.append(file_section(KERNELS / f"entry_{entry}{suffix}.{language}"))
    return Program(language, precision, entry, tuple(sections))


def beam_sections(
    surface: Surface, needs: Iterable[str], precision: Precision, language: Language, libraries: Iterable[str] = ()
) -> list[Section]:
    """What comes before the kernel of a method that casts beams."""
    from surfaces.sections import libraries_for, surface_sections

    sections = _head(language, precision, (*libraries_for(needs, surface), *libraries))
    sections += surface_sections(surface, needs, precision, language)
    return sections + [file_section(KERNELS / f) for f in ("beam.glsl", f"quadtree.{language}", "cells.glsl")]


def map_program(
    item: Section | Iterable[Section],
    precision: Precision,
    language: Language,
    libraries: Iterable[str] = (),
) -> Program:
    """A program that runs `map_item` of the last given section over rows (INPUTS and OUTPUTS are its #defines)."""
    items = [item] if isinstance(item, Section) else list(item)
    entry = file_section(KERNELS / f"entry_map.{language}")
    return Program(language, precision, "map", (*_head(language, precision, libraries), *items, entry))


_LINE = re.compile(r"(?m)^(?P<head>.*?)(?:\b0:|<kernel>:|\binput\.cl:|\.cl:|\b\d+:)(?P<line>\d+)(?P<tail>[:(].*)$")


def explain_log(program: Program, log: str) -> str:
    """A compiler's log with every line number replaced by the section's own file and line."""

    def replace(match: re.Match[str]) -> str:
        origin, line = program.locate(int(match["line"]))
        return f"{origin}:{line}{match['tail']}"

    return _LINE.sub(replace, log).strip()
