"""Make the programs of a method that casts tiles: one program for each stage of a frame.

A tile is a square of pixels whose rays are handled together. Sixteen lanes share a tile, and a number of type `wide`
has one value per lane. The text of a stage is the same whoever has the lanes (sections.Lanes), since what differs lies
behind the operations of glsl/tiles/{lanes,exchange,nets,blocks,tiles}_*:

    lanes   wide                       isolate                                         finish, packets
    ------  -------------------------  ----------------------------------------------  ------------------------------
    vector  vectors of sixteen         a work item has a tile                          a work item has 16 pixels
    group   a number of the precision  sixteen work items have a tile, and exchange    a work item has a pixel, and asks
                                       numbers through local memory                    no other one; what packets would
                                                                                       do is left to the last stage
    warp    the same                   the same, and exchange them without memory:     as group
                                       NVIDIA's OpenCL
    own     the same                   a work item has a tile, does its lanes in       as group
                                       turn, row by row, and halves three polynomials
                                       that bound all

harness.kernels.tile_polynomials generates what a polynomial's degree decides.
"""

from __future__ import annotations

from pathlib import Path

from harness.contract import Language, Method, Precision, Program, Section, Surface, Variant
from harness.kernels.compensated import compensated_value
from harness.kernels.fourths import GRID, NODES, POWERS, TABLES, half_side, interpolation, remainder_factors
from harness.kernels.sections import Lanes, TileStage, files, literal, table_section
from harness.kernels.tile_polynomials import chosen, macros, to_control, to_powers
from harness.kernels.tile_stages import StageText, lists

STAGES: tuple[TileStage, ...] = ("isolate", "finish", "packets", "rest")
TILE = 16  # pixels along a side of the first level's tiles
WARPS = 64  # work items of a group whose lanes are halves of warps
LEVELS = 2  # of tiles, each of half the side of the one before
REACH = 1.125  # radius of the last ball of the bounds of rounding errors, in domain radii
PIECE = 40  # reals of a piece that holds a root of each of a tile's rays; a single tile has at most two
RECORDS = {"OPEN_RECORD": 4, "SINGLE_RECORD": 2 * PIECE, "PIECE_RECORD": PIECE, "QUEUE_RECORD": 2}


def stage_program(
    method: Method,
    folder: Path,
    variant: Variant,
    surface: Surface,
    precision: Precision,
    language: Language,
    stage: TileStage,
    listed: bool,
    rest: Path,
    lanes: Lanes | None = None,
) -> Program:
    """Return the program of one stage. Its entry is named as the stage.

    `folder` holds the method's kernel.glsl and, where a stage has a file of its own, that file, named as the stage. If
    `listed`, each pixel's ray is read from a buffer, else made from the camera. `rest` is the folder of the kernel.glsl
    that casts the pixels that are left in stage "rest"; it has the same method's knobs and tables.

    `lanes` says who has a tile's sixteen lanes: "vector": a work item, in vectors of sixteen numbers (OpenCL only);
    "group", "warp": sixteen work items, which exchange numbers where a stage needs it; "own": no lane needs another
    one, since a work item isolates a tile alone. Default: "vector" for OpenCL, "own" for GLSL.
    """
    form: Lanes = lanes or ("vector" if language == "cl" else "own")
    stated = StageText(method, folder, variant, surface, precision, language, stage, rest)
    shape = _shape(surface, precision, language, listed, stage, form)
    corrections = [*files("tiles/compensated.glsl"), compensated_value(surface, precision, language)]
    own = [*files("tiles/lanes_one.glsl", "tiles/wide.glsl", "tiles/exchange_own.glsl"), *corrections]
    if stage != "rest":
        held: Lanes = form if form == "vector" or _exchanges(stage, form) else "own"
        own = _lane_sections(stage, precision, language, form)
        own += [wide_value(surface, precision, language), macros(surface, precision, language, held, stage)]
        own += [*_lane_tables(precision, language, form, stage), *files(*_net_files(stage, form))]
        own += corrections if stage != "isolate" else []
    return stated.program(("surface_value",), shape, own)


def _lane_sections(stage: TileStage, precision: Precision, language: Language, lanes: Lanes) -> list[Section]:
    """Return the operations on lanes, the buffers, and what a stage reads and writes."""
    if lanes == "vector":
        head = (f"tiles/lanes_{precision}.{language}", f"tiles/lanes.{language}", "tiles/wide.glsl")
        return files(*head, *lists(language), "tiles/alone.glsl", f"tiles/blocks.{language}")
    first, exchange = [], "exchange_own.glsl"
    if _exchanges(stage, lanes) and lanes == "group":
        first, exchange = [f"tiles/memory.{language}"], "exchange_group.glsl"
    elif _exchanges(stage, lanes):
        first, exchange = [f"tiles/exchange_warp_{precision}.{language}"], f"exchange_warp.{language}"
    turns = ["tiles/lanes_in_turn.glsl"] if _in_turn(stage, lanes) else []
    work = (*lists(language), f"tiles/{exchange}", *turns, "tiles/blocks_one.glsl")
    return files(*first, "tiles/lanes_one.glsl", "tiles/wide.glsl", *work)


def _net_files(stage: TileStage, lanes: Lanes) -> list[str]:
    """Return the files on what isolation keeps of a tile's polynomials."""
    if lanes == "vector":
        return ["tiles/nets_shared.glsl"]
    if _exchanges(stage, lanes):
        return ["tiles/nets_shared.glsl", "tiles/tiles_group.glsl"]
    return ["tiles/nets_own.glsl", "tiles/alone.glsl", "tiles/tiles_own.glsl"] if _in_turn(stage, lanes) else []


def _exchanges(stage: TileStage, lanes: Lanes) -> bool:
    """Tell whether a stage's work items exchange numbers."""
    return lanes in ("group", "warp") and stage == "isolate"


def _in_turn(stage: TileStage, lanes: Lanes) -> bool:
    """Tell whether a stage's work items do a tile's lanes in turn."""
    return lanes == "own" and stage == "isolate"


def _shape(
    surface: Surface, precision: Precision, language: Language, listed: bool, stage: TileStage, lanes: Lanes
) -> Section:
    """Return the constants that the host and all stages share.

    TABLE_HALF is half the side of the cube over which GRID³ cells have a bound of f's fourth derivatives. Points that
    are out of the domain by more than MARGIN have no bounds. TILE_ITEMS work items share a tile, and TILE_GROUP are in
    a work group. A step needs TILE_ITEMS for each TILE_TURNS of its tiles: where a program costs the same however few
    of a vector's work items have a tile, each takes several.
    """
    assert surface.degree is not None
    half = half_side(surface.domain)
    error_x, error_y = remainder_factors(surface.degree)
    items, group = _grouping(stage, lanes)
    shape: dict[str, int | float] = {"TILE": TILE, "LEVELS": LEVELS, "GRID": GRID, "TABLES": TABLES, **RECORDS}
    shape |= {"TILE_ITEMS": items, "TILE_GROUP": group, "TILE_TURNS": 8 if lanes == "own" else 1}
    shape |= {"OPEN_TILES": int(lanes != "vector"), "LISTED": int(listed)}
    shape |= {"BLOCK_WIDTH": block_width(lanes), "FINISH_PARTS": 16 if lanes in ("group", "warp") else 1}
    shape |= {"REACH": REACH, "TABLE_HALF": half, "MARGIN": half / 9.0}
    shape |= {"REMAINDER_X": error_x, "REMAINDER_Y": error_y, "LEBESGUE": interpolation(NODES)[1]}
    lines = [f"#define {name} {literal(value, precision, language)}" for name, value in shape.items()]
    return Section("generated: shape of tiles", "\n".join(lines))


def _grouping(stage: TileStage, lanes: Lanes) -> tuple[int, int]:
    """Return how many work items share a tile, and how many are in a work group."""
    if stage == "rest":
        return 1, 64
    if lanes == "vector":
        return 1, 1
    if _exchanges(stage, lanes):
        return 16, 16 if lanes == "group" else WARPS
    return (1, 8) if stage == "isolate" else (16, 64)


def block_width(lanes: Lanes) -> int:
    """Return how many pixels of a row are in a block of sixteen: a GPU writes rows to memory at once."""
    return 8 if lanes in ("group", "warp") else 4


def wide_value(surface: Surface, precision: Precision, language: Language) -> Section:
    """Return f of a point per lane: wide wide_value(WideVec3 p)."""
    import surfaces
    from harness.kernels.printing import RealPrinter, function_text
    from surfaces.lowering import real_tape

    printer = RealPrinter({axis: f"p.{axis}" for axis in "xyz"}, precision, language)
    lines, (value,) = printer.body(real_tape(surfaces.tape_of(surface)))
    lanes = [f"wide {line.removeprefix('real ')}" for line in lines]
    text = function_text("wide wide_value(WideVec3 p)", lanes, f"return wide({value});")
    return Section(f"generated: surface {surface.name}, wide_value", text)


def _lane_tables(precision: Precision, language: Language, form: Lanes, stage: TileStage) -> list[Section]:
    """Return the tables by which TRANSFORM works: six or eight rows of sixteen numbers, one for each lane.

    Lane k is node (k & 3, k >> 2). Row number i of one direction has each lane's factor of the lane whose index in that
    direction differs by the bits i. LANE_X, LANE_Y: the place of each lane's pixel in a block. NODE_X, NODE_Y: its
    node's place.
    POWERS_X, POWERS_Y, POWERS_Z: the powers of its entry in the table of fourth derivatives. Where a work item does
    the lanes in turn, a row is a macro that reads its table, a node's place follows from its column or row, and
    FIND_WEIGHTS has the powers.
    """
    lanes = [(k & 3, k >> 2) for k in range(16)]
    width = block_width(form)
    made = {"LANE_X": [float(k % width) for k in range(16)], "LANE_Y": [float(k // width) for k in range(16)]}
    made |= {"NODE_X": [NODES[x] for x, _ in lanes], "NODE_Y": [NODES[y] for _, y in lanes]}
    if not _in_turn(stage, form):
        made |= {f"POWERS_{axis}": [*(float(b[k]) for b in POWERS), 0.0] for k, axis in enumerate("XYZ")}
    for name, matrix in (("TO_CONTROL", to_control()), ("TO_POWERS", to_powers())):
        across = [float(matrix[x][x ^ i]) for i in range(4) for x, _ in lanes]
        down = [float(matrix[y][y ^ i]) for i in range(4) for _, y in lanes]
        made[name] = across + down
    if not _in_turn(stage, form):
        return [table_section(name, values, precision, language) for name, values in made.items()]
    places = [literal(place, precision, language) for place in NODES]
    texts = {"NODE_X": chosen("work.column", places), "NODE_Y": chosen("work.row", places)}
    read = {name: texts.get(name, f"{name}_TABLE[16 * (k) + OWN_LANE]") for name in made}
    tables = {f"{name}_TABLE": values for name, values in made.items() if name not in texts}
    rows = Section("generated: rows of lanes", "\n".join(f"#define {name}(k) {text}" for name, text in read.items()))
    return [*(table_section(name, values, precision, language) for name, values in tables.items()), rows]
