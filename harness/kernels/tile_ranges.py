"""Make the programs of a method that casts tiles and isolates roots by ranges of f and of its derivatives.

Such a method needs surface_gradient_range. A work item has a tile to itself, or a pixel, on every device: intervals
over a tile's pyramid are single numbers, and no lanes share them. Tiles are cut until they are 4 by 4 pixels.
"""

from __future__ import annotations

from pathlib import Path

from harness.contract import Language, Method, Precision, Program, Section, Surface, Variant
from harness.kernels.sections import TileStage, files, literal
from harness.kernels.tile_stages import StageText, lists

NEED = "surface_gradient_range"  # what a method needs that isolates by ranges
TILE = 16  # pixels along a side of the first level's tiles
LEVELS = 3  # of tiles, each of half the side of the one before
RECORDS = {"OPEN_RECORD": 3, "SINGLE_RECORD": 9, "QUEUE_RECORD": 2}  # reals, reals, int32 that lists have for a tile


def ranged_program(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    precision: Precision,
    language: Language,
    stage: TileStage,
    listed: bool,
    rest: Path,
) -> Program:
    """Return the program of one stage; the arguments are those of harness.kernels.tiles.stage_program."""
    stated = StageText(method, folder, variant, surface, precision, language, stage, rest)
    needs = [name for name in method.needs if stage != "rest" or name != NEED]
    heads = ("tiles/lanes_one.glsl", "tiles/wide.glsl", *lists(language), "tiles/alone.glsl")
    own = files(*heads) if stage != "rest" else []
    return stated.program(needs, _shape(precision, language, listed, stage), own)


def _shape(precision: Precision, language: Language, listed: bool, stage: TileStage) -> Section:
    """Return the constants that the host and all stages share, as harness.kernels.tiles has them; there is no grid."""
    items = 16 if stage in ("finish", "packets") else 1
    shape: dict[str, int] = {"TILE": TILE, "LEVELS": LEVELS, "GRID": 0, **RECORDS}
    shape |= {"TILE_ITEMS": items, "TILE_GROUP": 16 if stage == "isolate" else 64, "TILE_TURNS": 1}
    shape |= {"OPEN_TILES": 0, "LISTED": int(listed)}
    lines = [f"#define {name} {literal(value, precision, language)}" for name, value in shape.items()]
    return Section("generated: shape of tiles", "\n".join(lines))
