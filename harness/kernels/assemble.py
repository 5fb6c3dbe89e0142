"""Make programs: put whole kernel files and generated sections in order.

Kernel files are never edited. What differs from program to program is which files and sections it holds, and the
constants that generated sections define. The last section is a program's entry point.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Literal

from harness import ROOT
from harness.contract import DeviceInfo, FirsthitError, Method, Origin, Precision, Program, Section, Surface, Variant
from harness.contract import Language as Language
from harness.kernels.sections import (
    KERNELS,
    Lanes,
    TileStage,
    beam_sections,
    cast_sections,
    early_libraries,
    file_section,
    files,
    head_sections,
    kept_loops,
    method_sections,
    ray_sections,
    t_min_section,
)

METHODS = ROOT / "methods"
# As what a method's program is started. A stage that is `listed` casts listed rays where a pixel has one.
Entry = Literal["rays", "camera", "beams", TileStage, "finish_listed", "packets_listed", "rest_listed"]
STAGES: dict[Entry, tuple[TileStage, bool]] = {  # the entries of frames of tiles: the stage, and whether it is listed
    "isolate": ("isolate", False),
    "finish": ("finish", False),
    "packets": ("packets", False),
    "rest": ("rest", False),
    "finish_listed": ("finish", True),
    "packets_listed": ("packets", True),
    "rest_listed": ("rest", True),
}
ROOMS: dict[Entry, str] = {  # the folder of glsl/ that holds an entry
    "rays": "rays",
    "camera": "rays",
    "beams": "beams",
    **dict.fromkeys(STAGES, "tiles"),
}


def method_program(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    precision: Precision,
    language: Language,
    entry: Entry,
    narrowed: Section | None = None,
    t_min: float = 0.0,
    origin: Origin = "nearest",
    lanes: Lanes | None = None,
) -> Program:
    """Return the program that casts rays, beams or a stage of tiles at `surface` by `variant`.

    `folder` holds the method's kernel.glsl. `narrowed` gives the prepass's parameters if rays are to be narrowed by it.
    Listed rays begin at `t_min`, in units of t; those of tiles at 0. `origin` says where the method sees its rays
    begin. `lanes` is for tiles, as `lanes_on` chooses it for a device; a processor's if none is given. In GLSL no loop
    may be removed by the compiler, except in a camera's program, which is only timed.

    Raises FirsthitError if the surface lacks a function that the method needs, if t_min is no distance, or if the
    method does not cast rays and so cannot begin them elsewhere.
    """
    if ROOMS[entry] != "rays" and origin != "nearest":
        raise FirsthitError(f"an origin is chosen for rays, and the method {method.name} casts {ROOMS[entry]}")
    if entry in STAGES:
        from harness.kernels.tile_ranges import NEED, ranged_program
        from harness.kernels.tiles import stage_program

        stage, listed = STAGES[entry]
        stated = method, folder, variant, surface, precision, language
        if NEED in method.needs:
            return ranged_program(*stated, stage, listed, METHODS / method.rest)
        return stage_program(*stated, stage, listed, METHODS / method.rest, lanes or lanes_on(language, None))
    listed = entry == "rays" and narrowed is None
    needs = (*method.needs, "surface_value") if listed else method.needs
    ahead: dict[str, Callable[..., list[Section]]] = {"rays": ray_sections, "beams": beam_sections}
    sections = ahead[ROOMS[entry]](surface, needs, precision, language, early_libraries(method))
    sections += method_sections(method, folder, variant, surface, precision, language)
    if ROOMS[entry] == "rays":
        sections += cast_sections(origin)
    if listed:
        sections += [t_min_section(t_min, precision, language), *files("rays/listed.glsl")]
    sections += _entry_sections(entry, narrowed, language)
    if entry != "camera" and language == "glsl":
        sections.insert(1, kept_loops())
    return Program(language, precision, entry, tuple(sections))


def lanes_on(language: Language, device: DeviceInfo | None) -> Lanes:
    """Choose how lanes lie on a device's work items; on a processor's where none is given."""
    if device and device.resident is not None:
        return "warp" if device.name.startswith("opencl:nvidia") else "group"
    return "vector" if language == "cl" else "own"


def _entry_sections(entry: Entry, narrowed: Section | None, language: Language) -> list[Section]:
    """Return a program's entry point and what it calls beside the cast."""
    sections = files("rays/camera.glsl") if entry == "camera" else []
    if narrowed:
        sections += [narrowed, *files("rays/narrowed.glsl")]
    if entry == "rays" and language == "glsl":
        sections += files("turns.glsl")
    return sections + files(f"{ROOMS[entry]}/entry_{entry}{'_narrowed' if narrowed else ''}.{language}")


def map_program(
    item: Section | Iterable[Section],
    precision: Precision,
    language: Language,
    libraries: Iterable[str] = (),
) -> Program:
    """Return a program that runs the function map_item, which the last of the given sections defines, on every row.

    That section also defines INPUTS and OUTPUTS, how many reals a row and its result have.
    """
    items = [item] if isinstance(item, Section) else list(item)
    entry = file_section(KERNELS / f"map/entry_map.{language}")
    return Program(language, precision, "map", (*head_sections(language, precision, libraries), *items, entry))
