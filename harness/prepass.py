"""The prepass: beams over tiles of the image leave to each ray the depths between which the surface may lie.

It composes with every method that casts rays, in stage `compute`; the check casts its rays in the same spans.
"""

from __future__ import annotations

from harness.assemble import KERNELS, Language, beam_sections, file_section
from harness.contract import Precision, Program, Section, Surface

TILE_BITS = 3  # a tile is 2^TILE_BITS pixels a side
BISECTIONS = 1  # a tile's last piece in depth is the domain's depth / 2^(the tiles' level + BISECTIONS)
NEEDS = ("surface_range",)


def parameters() -> Section:
    """What the prepass and the rays that it narrows both have to know."""
    text = f"#define TILE_BITS {TILE_BITS}\n#define PREPASS_BISECTIONS {BISECTIONS}"
    return Section("generated: parameters of the prepass", text)


def tiles_per_side(size: int) -> int:
    """Of an image of size × size pixels."""
    return (size - 1 >> TILE_BITS) + 1


def program(surface: Surface, precision: Precision, language: Language) -> Program:
    """The program that casts the prepass's beams at `surface`; for quadtree_steps down to the tiles' level.

    Raises FirsthitError where the surface has no interval extension here.
    """
    sections = beam_sections(surface, NEEDS, precision, language)
    sections += [
        parameters(),
        file_section(KERNELS / "prepass.glsl"),
        file_section(KERNELS / f"entry_beams.{language}"),
    ]
    return Program(language, precision, "beams", tuple(sections))
