"""Make the program that is shipped: the sections that the harness casts, and an entry point that draws.

The answers are those of the harness's own program of entry `camera`, bit for bit: the same text computes them.
`trial` looks whether a device's compiler sees it so.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import surfaces
from harness import __version__
from harness.contract import (
    CLAIMS,
    Box,
    FirsthitError,
    Language,
    Origin,
    Precision,
    Program,
    Surface,
    Variant,
)
from harness.experiment.kinds import of_method
from harness.kernels.assemble import method_program
from harness.kernels.sections import cast_sections, early_libraries, file_section, files, method_sections, ray_sections
from harness.plugins import BUILT_IN, Plugin
from harness.shipping.pruned import pruned

HERE = Path(__file__).parent
LANGUAGE_TITLES: dict[Language, str] = {"glsl": "GLSL 4.30, a compute shader", "cl": "OpenCL C 1.2"}
ENTRY = "draw"
WIDTH = 118  # characters of a line of the head
MACROS = (
    "real is the type of numbers. PRECISE keeps the compiler from contracting or reordering a sum whose rounding error "
    "is used. IN, OUT, INOUT, TABLE and STRUCT write what differs between GLSL and OpenCL C"
)
LONGEST = 4000  # characters of a formula that the head shows
BUILD_OPTIONS = {  # without the first, OpenCL takes numbers like 0.5 as float64; not every device has the second
    "float32": "-cl-single-precision-constant and, where the device has it, -cl-fp32-correctly-rounded-divide-sqrt",
    "float64": "none",
}


@dataclass(frozen=True)
class Shipment:
    """State what is shipped: a method with values for its knobs, for a surface, in a language and a precision.

    Raises FirsthitError where the method cannot be shipped, or cannot draw the surface in this language and precision.
    """

    plugin: Plugin
    variant: Variant
    surface: Surface
    language: Language
    precision: Precision = "float32"
    origin: Origin = "nearest"

    def __post_init__(self) -> None:
        if reason := self._refusal():
            raise FirsthitError(reason)

    def _refusal(self) -> str | None:
        """Say why there is nothing to ship; None if there is."""
        from harness.kernels.functions import unsupported

        method, name = self.plugin.method, self.plugin.method.name
        if not method.answers:
            return f"{name} finds no hits: it measures what the harness itself costs, and there is nothing to ship"
        if why := of_method(method).unlisted:
            return f"{name} {why}: only methods that cast rays one by one are written out"
        if self.precision not in method.precisions:
            return f"{name} is for {' and '.join(method.precisions)}, not for {self.precision}"
        if why := method.accepts(self.surface) or unsupported(self.surface, self.precision, self.language):
            return f"{self.variant} cannot draw {self.surface.name} here: {why}"
        return None

    @property
    def checked(self) -> Program:
        """Return the harness's own program of a camera's image, whose answers the shipped one must give."""
        stated = self.plugin.method, self.plugin.folder, self.variant, self.surface, self.precision, self.language
        return method_program(*stated, "camera", origin=self.origin)

    @property
    def program(self) -> Program:
        """Return the program that is shipped, without its head. Raises FirsthitError where the kernel is mistaken."""
        method = self.plugin.method
        stated = self.surface, self.precision, self.language
        sections = ray_sections(
            self.surface, (*method.needs, "surface_normal"), self.precision, self.language, early_libraries(method)
        )
        sections += method_sections(method, self.plugin.folder, self.variant, *stated)
        sections += [*cast_sections(self.origin), *files("rays/camera.glsl")]
        entry = file_section(HERE / "glsl" / f"entry_{ENTRY}.{self.language}")
        return Program(self.language, self.precision, ENTRY, tuple(pruned(sections, [entry])))

    def text(self, command: str) -> str:
        """Return the text of the file that is shipped: the head, and below it the program, section by section.

        `command` is the one that writes it. Raises FirsthitError where the kernel is mistaken.
        """
        sections = [f"// ==== {s.origin} ====\n{_folded(s.text).rstrip()}\n" for s in self.program.sections]
        return "\n".join([head(self, command) + "\n", *sections])

    @property
    def foreign(self) -> bool:
        """Tell whether the method's kernel is not of this project."""
        return not self.plugin.folder.is_relative_to(BUILT_IN)


def head(shipment: Shipment, command: str) -> str:
    """Return the comment that a shipped program begins with; `command` is the one that writes it."""
    title = f"Finds where rays first meet the surface {shipment.surface.title}, by {shipment.plugin.method.name}."
    told = (
        "The functions are those that firsthit holds against its certified oracle and times, word for word, without "
        "those that nothing calls. Only the entry point at the end is written for this file."
    )
    lines = [*_wrapped(title), "//", *_wrapped(told), "//", *_wrapped(f"firsthit {__version__}: {command}", "made by")]
    for name, text in _facts(shipment):
        lines += _wrapped(text, name)
    return "\n".join(lines)


def _facts(shipment: Shipment) -> Iterator[tuple[str, str]]:
    """Yield the lines of the head: a name, and what is to be known of it."""
    surface, method = shipment.surface, shipment.plugin.method
    read, bound = surfaces.canonical(surface), "".join(f", {name} = {value}" for name, value in surface.parameters)
    yield "surface", f"{surface.name}: f(x, y, z) = {_cut(read)}; {surface.source}"
    yield "written", f"{_cut(surface.formula)}{bound}"
    yield "domain", domain_of(surface)
    yield "units", "lengths are in the units of x, y and z; t is the distance along a ray of direction length 1"
    yield "numbers", f"{shipment.precision}; the camera and the normals are float32"
    yield "language", LANGUAGE_TITLES[shipment.language]
    yield "macros", MACROS
    if shipment.language == "cl":
        yield "options", BUILD_OPTIONS[shipment.precision]
    use = (
        "the last section starts it for each pixel of a camera. Programs of your own take what stands above it; there "
        "cast_ray(make_ray(origin, direction)) has a hit where hit.status is HIT, at the distance shift + hit.t"
    )
    yield "use", use
    yield "method", f"{method.name}, published in {method.source}"
    meanings = {parameter.name: parameter.meaning for parameter in method.parameters}
    for name, value in shipment.variant.parameters:
        yield "knob", f"{name} = {value:.9g}: {meanings[name]}"
    for claim in guarantees(shipment.plugin, shipment.variant, surface):
        yield "claim", claim
    whose = (
        f"; the kernel of {method.name} is its author's own, who says how it may be used" if shipment.foreign else ""
    )
    yield "license", f"SPDX-License-Identifier: MIT, copyright (c) 2026 the firsthit authors, see LICENSE.txt{whose}"


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} … ({len(text)} characters)"


def guarantees(plugin: Plugin, variant: Variant, surface: Surface) -> list[str]:
    """Return in words what the method of a variant claims of its answers, a line each; at least one line."""
    method = plugin.method
    if not method.claims:
        return ["no guarantee: the method claims nothing of its answers"]
    told = [f"{claim}: {CLAIMS[claim]}" for claim in sorted(method.claims)]
    if "error_below_tolerance" in method.claims and method.tolerance:
        told.append(f"tolerance: {method.tolerance(surface, dict(variant.parameters)):.3g} scene units")
    return told


def domain_of(surface: Surface) -> str:
    """Return a surface's domain in words."""
    domain = surface.domain

    def number(value: float) -> str:
        return np.format_float_positional(np.float32(value), trim="-")  # shortest of those that mean this float32

    def point(values: Iterable[float]) -> str:
        return f"({', '.join(map(number, values))})"

    if isinstance(domain, Box):
        where = f"the box from {point(domain.lower)} to {point(domain.upper)}"
    else:
        where = f"the ball of radius {number(domain.radius)} about {point(domain.center)}"
    return f"{where}; what lies outside is not drawn"


def _folded(text: str) -> str:
    """Return a section's text with its tables in lines of WIDTH; all else is as it was."""
    return re.sub(
        rf"^(?=.{{{WIDTH + 1}}})TABLE .*$",
        lambda line: "\n    ".join(textwrap.wrap(line[0], WIDTH - 4)),
        text,
        flags=re.M,
    )


def _wrapped(text: str, name: str = "") -> list[str]:
    """Return a text as lines of comment, behind a name where one is given. No line ends with a backslash."""
    begin = f"// {name:<9} " if name else "// "
    rest = f"// {' ' * 9} " if name else "// "
    folded = " ".join(text.split()).replace("\\", "/")
    return textwrap.wrap(folded, WIDTH, initial_indent=begin, subsequent_indent=rest, break_on_hyphens=False)
