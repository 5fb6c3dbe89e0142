"""The prepass: beams over tiles of the image leave to each ray the depths between which the surface may lie.

It composes with every method that casts rays, in stage `compute`; the check casts its rays in the same spans.

The spans hold every root of every ray of their tile: tested on every surface. So a method that finds the first root of
the interval it is given loses none. What an iteration finds depends on where it starts: Newton, bounded by λ, can step
over a thin part of the surface from one start and not from another, with a prepass or without.

**Tried**, processor time of opencl:intel at 512 × 512, float32, as ms on both cores, of null / newton / eft_yuksel /
lu_lipschitz, on barth_sextic: 0.8 / 6.2 / 17.0 / 18.2 without; tiles of 4 pixels 19 / 16 / 23 / 22; of 8 pixels
6.0 / 6.7 / 14.1 / 12.9; of 16 pixels 1.6 / 4.2 / 12.7 / 12.2, kept. One bisection less or more changes little. On the
torus and the decic it does not pay for newton, eft_yuksel and lu_lipschitz: 16-pixel tiles cost them 0.4 to 3 ms, since
the torus is as cheap as the prepass and the decic's ranges exclude little.
"""

from __future__ import annotations

from harness.contract import Precision, Program, Section, Surface
from harness.kernels.assemble import KERNELS, Language, beam_sections, file_section

TILE_BITS = 4  # a tile is 2^TILE_BITS pixels a side
BISECTIONS = 1  # a tile's last piece in depth is the domain's depth / 2^(the tiles' level + BISECTIONS)
NEEDS = ("surface_range",)


def parameters() -> Section:
    """Define what the prepass and the rays that it narrows both have to know."""
    text = f"#define TILE_BITS {TILE_BITS}\n#define PREPASS_BISECTIONS {BISECTIONS}"
    return Section("generated: parameters of the prepass", text)


def tiles_per_side(size: int) -> int:
    """Count the prepass's tiles on a side of an image of size × size pixels."""
    return (size - 1 >> TILE_BITS) + 1


def program(surface: Surface, precision: Precision, language: Language) -> Program:
    """The program that casts the prepass's beams at `surface`; for quadtree_steps down to the tiles' level.

    Raises FirsthitError where the surface has no interval extension here.
    """
    sections = beam_sections(surface, NEEDS, precision, language)
    sections += [
        parameters(),
        file_section(KERNELS / "beams/prepass.glsl"),
        file_section(KERNELS / f"beams/entry_beams.{language}"),
    ]
    return Program(language, precision, "beams", tuple(sections))
