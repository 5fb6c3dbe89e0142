"""Make the prepass: beams over tiles of the image tell each ray between which depths it may meet the surface.

The prepass works before every method that casts rays, in stage `compute`. The check casts its rays in the same spans of
depth.

A span holds every root of every ray of its tile, which is tested on every surface. A method that finds the first root
of the interval it is given therefore loses none. A method that iterates may answer otherwise than without the prepass,
since it starts elsewhere: Newton's method, with steps bounded by λ, can step over a thin part of the surface from one
start and not from another.

**Tried**, in ms of processor time on both cores of opencl:intel, at 512 × 512 in float32, of null / newton / eft_yuksel
/ lu_lipschitz. On barth_sextic: 0.8 / 6.2 / 17.0 / 18.2 without; tiles of 4 pixels 19 / 16 / 23 / 22; of 8 pixels 6.0 /
6.7 / 14.1 / 12.9; of 16 pixels 1.6 / 4.2 / 12.7 / 12.2, which are kept. One bisection less or more changes little. On
the torus and the decic the prepass does not pay for newton, eft_yuksel and lu_lipschitz: with tiles of 16 pixels it
costs them 0.4 to 3 ms, since the torus is as cheap as the prepass, and the decic's ranges exclude little.
"""

from __future__ import annotations

from harness.contract import Precision, Program, Section, Surface
from harness.kernels.assemble import Language
from harness.kernels.sections import KERNELS, beam_sections, file_section

TILE_BITS = 4  # a tile is 2^TILE_BITS pixels a side
BISECTIONS = 1  # pieces of depth of a tile are the domain's depth / 2^(the tiles' level + BISECTIONS)
NEEDS = ("surface_range",)


def parameters() -> Section:
    """Define the constants that the prepass's program and the program of the narrowed rays share."""
    text = f"#define TILE_BITS {TILE_BITS}\n#define PREPASS_BISECTIONS {BISECTIONS}"
    return Section("generated: parameters of the prepass", text)


def tile_bits(program: Program) -> int:
    """Read the TILE_BITS that a prepass's program was made with, which another revision's may have chosen otherwise."""
    return int(program.text.partition("#define TILE_BITS ")[2].split()[0])


def tiles_per_side(size: int, bits: int = TILE_BITS) -> int:
    """Count the prepass's tiles, of 2^bits pixels a side, on a side of an image of size × size pixels."""
    return (size - 1 >> bits) + 1


def program(surface: Surface, precision: Precision, language: Language) -> Program:
    """Return the program that casts the prepass's beams at `surface`, to be run level by level down to the tiles.

    Raises FirsthitError if the surface has no interval extension in this precision and language.
    """
    sections = beam_sections(surface, NEEDS, precision, language)
    sections += [
        parameters(),
        file_section(KERNELS / "beams/prepass.glsl"),
        file_section(KERNELS / f"beams/entry_beams.{language}"),
    ]
    return Program(language, precision, "beams", tuple(sections))
