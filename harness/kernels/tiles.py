"""Make the programs of a method that casts tiles: one program for each stage of a frame.

A tile is a square of pixels whose rays are handled together. Sixteen lanes share a tile. A number of type `wide` has one
value per lane: on a processor it is a vector of sixteen, so that one work item has a whole tile; elsewhere it is one
number, and sixteen work items share a tile. The text is the same, since what differs lies behind the operations of
glsl/tiles/lanes.*.

What a polynomial's degree decides is generated here, as macros on the fields of struct Poly: straight-line text, since
compilers do not keep arrays in registers where loops index them.

    macro                   what it does
    ----------------------  ------------------------------------------------------------------------------------------
    SAMPLE(s, o, d, a, h)   s = f at the fit's nodes on the rays o + t d, t in [a, a + h]
    SCALE(s, v)             s = v s
    FIT(s, c)               c = the Bernstein coefficients of the polynomial with the values s at the nodes
    WEIGHTED(s)             the sum of |s|, each times the largest entry of its column of the fit's matrix
    LARGEST(c), LEAST(c)    the largest magnitude, and the least value, of the coefficients
    SPREAD(c)               the largest distance of a lane's coefficients from those of the first lane
    TRANSFORM(c, rows)      applies a 4 by 4 matrix in both directions of the tile to each coefficient
    HALVE(near, far)        near becomes the coefficients of its near half, far those of its far half
    STEEPEST(c)             the largest difference of neighbouring coefficients
    SURE_ABOVE(c, e), SURE_BELOW(c, e)  bits: coefficient j, or N - j, is above e, or below -e, in all lanes
    LARGEST_AFTER(c, e)     the largest coefficient behind the first that is not above e
    KEEP(q, mask, c)        q = c in the mask's lanes
    BINOMIAL(q)             q = each coefficient times its binomial, for EVALUATE
    EVALUATE(q, x, v, s)    v, s = the polynomial's value and derivative at x in [0, 1]
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import comb
from pathlib import Path

from harness.contract import Box, Language, Method, Precision, Program, Section, Surface, Variant
from harness.kernels.fourths import GRID, NODES, POWERS, half_side, interpolation, remainder_factors
from harness.kernels.sections import (
    Lanes,
    TileStage,
    cast_sections,
    early_libraries,
    file_section,
    files,
    kept_loops,
    literal,
    method_sections,
    ray_sections,
    table_section,
)

STAGES: tuple[TileStage, ...] = ("isolate", "finish", "packets", "rest")
TILE = 16  # pixels along a side of the first level's tiles
LEVELS = 2  # of tiles, each of half the side of the one before
REACH = 1.125  # radius of the last ball of the bounds of rounding errors, in domain radii
RECORDS = {"OPEN_RECORD": 4, "SINGLE_RECORD": 36, "QUEUE_RECORD": 2}  # reals, reals and int32 that lists have for a tile
Row = Sequence[Fraction]


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

    `folder` holds the method's kernel.glsl. If `listed`, each pixel's ray is read from a buffer, else made from the
    camera. `rest` is the folder of the kernel.glsl that casts the pixels that are left in stage "rest"; it has the same
    method's knobs and tables.

    `lanes` says who has a tile's sixteen lanes: "vector": a work item, in vectors of sixteen numbers (OpenCL only);
    "group": sixteen work items, which exchange numbers through local memory where a stage needs it; "own": no lane
    needs another one, since a work item isolates a tile alone. Default: "vector" for OpenCL, "own" for GLSL.
    """
    form: Lanes = lanes or ("vector" if language == "cl" else "own")
    sections = ray_sections(surface, ("surface_value",), precision, language, early_libraries(method))
    if language == "glsl":
        sections.insert(1, kept_loops())
    sections.append(_shape(surface, precision, language, listed, stage, form))
    sections += files("rays/camera.glsl")
    if stage == "rest":
        sections += method_sections(method, rest, variant, surface, precision, language)
        sections += [*cast_sections("nearest"), *files(f"tiles/work.{language}", "tiles/lists.glsl", "tiles/rest.glsl")]
    else:
        sections += _lane_sections(stage, precision, language, form)
        held: Lanes = form if form == "vector" or _exchanges(stage, form) else "own"
        sections += [wide_value(surface, precision, language), macros(surface, precision, language, held)]
        sections += files(*_net_files(stage, form))
        domain = "box" if isinstance(surface.domain, Box) else "sphere"
        sections += [*_lane_tables(precision, language), *files(f"tiles/domain_{domain}.glsl")]
        sections += [table_section("POWERS", [float(v) for b in POWERS for v in b], precision, language)]
        sections += method_sections(method, folder, variant, surface, precision, language)
    sections += files(f"tiles/entry_{stage}.{language}")
    return Program(language, precision, stage, tuple(sections))


def _lane_sections(stage: TileStage, precision: Precision, language: Language, lanes: Lanes) -> list[Section]:
    """Return the operations on lanes, the buffers, and what a stage reads and writes."""
    if lanes == "vector":
        head = (f"tiles/lanes_{precision}.{language}", f"tiles/lanes.{language}", "tiles/wide.glsl")
        return files(*head, f"tiles/work.{language}", "tiles/lists.glsl", f"tiles/blocks.{language}")
    first, exchange = [], "own"
    if _exchanges(stage, lanes):
        first, exchange = [f"tiles/memory.{language}"], "group"
    work = (f"tiles/work.{language}", "tiles/lists.glsl", f"tiles/exchange_{exchange}.glsl", "tiles/blocks_one.glsl")
    return files(*first, "tiles/lanes_one.glsl", "tiles/wide.glsl", *work)


def _net_files(stage: TileStage, lanes: Lanes) -> list[str]:
    """Return the files on what isolation keeps of a tile's polynomials."""
    if lanes == "vector":
        return ["tiles/nets_shared.glsl"]
    if _exchanges(stage, lanes):
        return ["tiles/nets_shared.glsl", "tiles/tiles_group.glsl"]
    return ["tiles/nets_own.glsl", "tiles/tiles_own.glsl"]


def _exchanges(stage: TileStage, lanes: Lanes) -> bool:
    """Tell whether a stage's work items exchange numbers."""
    return lanes == "group" and stage == "isolate"


def _shape(
    surface: Surface, precision: Precision, language: Language, listed: bool, stage: TileStage, lanes: Lanes
) -> Section:
    """Return the constants that the host and all stages share.

    TABLE_HALF is half the side of the cube over which GRID³ cells have a bound of f's fourth derivatives. Points that
    are out of the domain by more than MARGIN have no bounds. TILE_ITEMS work items share a tile, and TILE_GROUP are in
    a work group. A step needs TILE_ITEMS for each TILE_TURNS of its tiles: where a program's text costs the same however
    few of a vector's work items have a tile, each takes several.
    """
    assert surface.degree is not None
    half = half_side(surface.domain)
    error_x, error_y = remainder_factors(surface.degree)
    one = lanes != "vector"
    items = 16 if one and stage in ("finish", "packets") or _exchanges(stage, lanes) else 1
    group = 64 if stage == "rest" else 1 if not one else 16 if _exchanges(stage, lanes) else 8 if items == 1 else 64
    shape = {"TILE": TILE, "LEVELS": LEVELS, "GRID": GRID, **RECORDS, "TILE_ITEMS": items, "TILE_GROUP": group}
    shape["TILE_TURNS"] = 8 if lanes == "own" else 1
    shape["OPEN_TILES"] = int(lanes == "own")
    shape |= {"LISTED": int(listed), "REACH": REACH, "TABLE_HALF": half, "MARGIN": half / 9.0}
    shape |= {"REMAINDER_X": error_x, "REMAINDER_Y": error_y, "LEBESGUE": interpolation(NODES)[1]}
    lines = [f"#define {name} {literal(value, precision, language)}" for name, value in shape.items()]
    return Section("generated: shape of tiles", "\n".join(lines))


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


def _lane_tables(precision: Precision, language: Language) -> list[Section]:
    """Return the tables by which TRANSFORM works: six or eight rows of sixteen numbers, one for each lane.

    Lane k is node (k & 3, k >> 2). Row number i of one direction has each lane's factor of the lane whose index in that
    direction differs by the bits i. LANE_X, LANE_Y: each lane's own indices. NODE_X, NODE_Y: its node's place.
    """
    lanes = [(k & 3, k >> 2) for k in range(16)]
    made = {"LANE_X": [float(x) for x, _ in lanes], "LANE_Y": [float(y) for _, y in lanes]}
    made |= {"NODE_X": [NODES[x] for x, _ in lanes], "NODE_Y": [NODES[y] for _, y in lanes]}
    for name, matrix in (("TO_CONTROL", to_control()), ("TO_POWERS", to_powers())):
        across = [float(matrix[x][x ^ i]) for i in range(4) for x, _ in lanes]
        down = [float(matrix[y][y ^ i]) for i in range(4) for _, y in lanes]
        made[name] = across + down
    return [table_section(name, values, precision, language) for name, values in made.items()]


def to_nodes() -> list[Row]:
    """Return the matrix that turns cubic Bernstein coefficients on [-1, 1] into values at NODES."""
    return [[comb(3, j) * ((1 + x) / 2) ** j * ((1 - x) / 2) ** (3 - j) for j in range(4)] for x in map(Fraction, NODES)]


def to_control() -> list[Row]:
    """Return the matrix that turns values at NODES into cubic Bernstein coefficients on [-1, 1]."""
    return _inverse(to_nodes())


def to_powers() -> list[Row]:
    """Return the matrix that turns values at NODES into the coefficients of 1, x, x², x³."""
    return _inverse([[x**j for j in range(4)] for x in map(Fraction, NODES)])


def _inverse(matrix: Sequence[Row]) -> list[Row]:
    """Return the exact inverse of a matrix."""
    import flint

    made = flint.fmpq_mat([[flint.fmpq(v.numerator, v.denominator) for v in row] for row in matrix])
    return [[Fraction(int(v.p), int(v.q)) for v in row] for row in made.inv().tolist()]


def macros(surface: Surface, precision: Precision, language: Language, lanes: Lanes) -> Section:
    """Return struct Poly and the macros that are listed above, for the surface's degree."""
    from harness.kernels.fitting import fit_tables, inverse

    assert surface.degree is not None
    n = surface.degree
    tables = fit_tables(n, "bernstein", precision)
    matrix = inverse(n, "bernstein", precision)
    columns = [max(float(abs(row[i])) for row in matrix) for i in range(n + 1)]

    def number(value: float) -> str:
        return literal(float(value), precision, language)

    ks = range(n + 1)
    struct = f"STRUCT(Poly) struct Poly {{ wide {', '.join(f'k{j}' for j in ks)}; }};"
    made = [
        ("SAMPLE(s, o, d, a, h)", [f"s.k{i} = wide_value(wide_point(o, a + h * {number(tables['NODES'][i])}, d));" for i in ks]),
        ("SCALE(s, v)", [f"s.k{i} = v * s.k{i};" for i in ks]),
        ("FIT(s, c)", _fit(n, tables["EVEN_HI"], tables["ODD_HI"], number)),
        ("TRANSFORM(c, rows)", [f"TRANSFORM_ONE(c.k{j}, rows)" for j in ks]),
        ("HALVE(near, far)", _halve(n, number)),
        ("KEEP(q, mask, c)", [f"q.k{j} = CHOOSE(mask, c.k{j}, q.k{j});" for j in ks]),
        ("BINOMIAL(q)", [f"q.k{j} = {number(comb(n, j))} * q.k{j};" for j in ks if comb(n, j) != 1]),
        ("EVALUATE(q, x, v, s)", _evaluate(n)),
        ("LARGEST_AFTER(c, e, after)", _largest_after(n)),
    ]
    values = [
        ("WEIGHTED(s)", " + ".join(f"{number(columns[i])} * fabs(s.k{i})" for i in ks)),
        ("LARGEST(c)", _paired("max", [f"fabs(c.k{j})" for j in ks])),
        ("LEAST(c)", _paired("min", [f"c.k{j}" for j in ks])),
        ("SPREAD(c)", _paired("max", [f"fabs(c.k{j} - first_lane(c.k{j}))" for j in ks])),
        ("STEEPEST(c)", _paired("max", [f"c.k{j} - c.k{j - 1}" for j in ks if j])),
        ("SURE_ABOVE(c, e)", _sure(n, lanes, above=True)),
        ("SURE_BELOW(c, e)", _sure(n, lanes, above=False)),
        ("FIRST(c)", "c.k0"),
        ("LAST(c)", f"c.k{n}"),
        ("CONSTANT(c, v)", " ".join(f"c.k{j} = v;" for j in ks)),
    ]
    if lanes == "own":
        made += _own_net(n, number)
        values.append(("LARGEST_FALL(c)", _paired("max", [f"c.k{j}" for j in range(n)])))
    elif lanes == "group":
        made.append(("TRANSFORM(c, rows)", _exchanged_transform(n)))
    lines = [struct]
    for head, statements in dict(made).items():
        body = " \\\n    ".join(["{", *statements])
        lines.append(f"#define {head} {body} }}")
    lines += [f"#define {head} ({text})" if head != "CONSTANT(c, v)" else f"#define {head} {{ {text} }}" for head, text in values]
    return Section(f"generated: polynomials of degree {n}", "\n".join(lines))


def _sure(n: int, lanes: Lanes, above: bool) -> str:
    """Return the text of SURE_ABOVE or SURE_BELOW."""
    terms = []
    for j in range(n + 1):
        k = j if above else n - j
        if lanes == "own":
            sure = f"c.lo.k{k} > e" if above else f"c.hi.k{k} < -e"
        else:
            sure = f"MORE(c.k{k}, wide(e))" if above else f"LESS(c.k{k}, wide(-e))"
            sure = f"all_lanes({sure})" if lanes == "vector" else sure
        terms.append(f"({sure} ? {1 << j} : 0)")
    text = " | ".join(terms)
    return f"all_bits({text})" if lanes == "group" else text


def _exchanged_transform(n: int) -> list[str]:
    """Return the statements of TRANSFORM where sixteen work items share a tile: all coefficients are exchanged at once."""
    lines = []
    for direction, bits in (("u", (1, 2, 3)), ("v", (4, 8, 12))):
        lines += [f"lane_numbers[{16 * j} + OWN_LANE] = c.k{j};" for j in range(n + 1)] + ["MEET"]
        for j in range(n + 1):
            terms = [
                f"rows.{direction}{i} * (lane_numbers[{16 * j} + (OWN_LANE ^ {bit})] - c.k{j})"
                for i, bit in enumerate(bits, start=1)
            ]
            lines.append(f"c.k{j} = c.k{j} + ({' + '.join(terms)});")
        lines.append("MEET")
    return lines


def _own_net(n: int, number: Callable[[float], str]) -> list[tuple[str, list[str]]]:
    """Return the macros on a Net, a Bundle and Lanes of a work item that has all lanes; see nets_own.glsl."""
    ks, lanes = range(n + 1), range(16)
    spread = [f"spread_ = max(spread_, fabs(net.v[{16 * j + k}] - net.v[{16 * j}]));" for j in ks for k in lanes if k]
    bundled = []
    for j in ks:
        bundled.append(f"b.lo.k{j} = {_paired('min', [f'net.v[{16 * j + k}]' for k in lanes])};")
        bundled.append(f"b.hi.k{j} = {_paired('max', [f'net.v[{16 * j + k}]' for k in lanes])};")
    for j in range(n):
        falls = [f"net.v[{16 * j + 16 + k}] - net.v[{16 * j + k}]" for k in lanes]
        bundled.append(f"b.fall.k{j} = {_paired('max', falls)};")
    bundled.append(f"b.fall.k{n} = real(0);")
    control = [line for j in ks for line in _mixed("net", 16 * j, to_control(), number, differences=True)]
    fall = _halve(n - 1, number) + [f"{half}.k{j} = 0.5 * {half}.k{j};" for half in ("near", "far") for j in range(n)]
    return [
        ("KEEP_LANE(net, c)", [f"net.v[{16 * j} + work.lane] = c.k{j};" for j in ks]),
        ("FIND_SPREAD(net, spread_)", spread),
        ("CONTROL(net)", control),
        ("TO_CUBIC(lanes)", _mixed("lanes", 0, to_powers(), number, differences=False)),
        ("BUNDLED(net, b)", bundled),
        ("HALVE_FALL(near, far)", [*fall, f"far.k{n} = real(0);"]),
    ]


def _mixed(name: str, at: int, matrix: Sequence[Row], number: Callable[[float], str], differences: bool) -> list[str]:
    """Return statements that apply a 4 by 4 matrix in both directions to the sixteen numbers of a net from `at` on.

    If `differences`, each number's row has the sum 1, and is applied as TRANSFORM_ONE does.
    """
    lines = ["{"]
    for kind, source, step, lane in (("h", None, 1, lambda x, y: 4 * y + x), ("", "h", 4, lambda x, y: 4 * x + y)):
        results = []
        for y in range(4):
            for x in range(4):
                def read(k: int, y: int = y) -> str:
                    return f"h{lane(k, y)}_" if source else f"{name}.v[{at + lane(k, y)}]"

                own = read(x)
                row = [(float(matrix[x][x ^ i]), read(x ^ i)) for i in range(4)]
                if differences:
                    text = f"{own} + ({' + '.join(f'{number(w)} * ({v} - {own})' for w, v in row[1:])})"
                else:
                    text = " + ".join(f"{number(w)} * {v}" for w, v in row)
                results.append(f"{name}.v[{at + lane(x, y)}] = {text};" if source else f"real h{lane(x, y)}_ = {text};")
        lines += results
    return [*lines, "}"]


def _paired(function: str, terms: Sequence[str]) -> str:
    """Return the text of a function of two arguments over all terms, as a balanced tree."""
    left = list(terms)
    while len(left) > 1:
        pairs = [f"{function}({a}, {b})" for a, b in zip(left[::2], left[1::2], strict=False)]
        left = pairs + left[2 * len(pairs) :]
    return left[0]


def _fit(n: int, even: Sequence[float], odd: Sequence[float], number: Callable[[float], str]) -> list[str]:
    """Return the statements that multiply samples with the fit's matrix; see harness.kernels.fitting."""
    evens, odds = n // 2 + 1, (n + 1) // 2
    lines = [f"wide p{i} = s.k{n - i} + s.k{i}; wide m{i} = s.k{n - i} - s.k{i};" for i in range(odds)]
    if evens > odds:
        lines.append(f"wide p{odds} = s.k{n // 2};")

    def row(table: Sequence[float], width: int, r: int, variable: str) -> str:
        terms = [f"{number(table[r * width + i])} * {variable}{i}" for i in range(width) if table[r * width + i] != 0.0]
        return " + ".join(terms)

    for r in range(odds):
        lines.append(f"{{ wide e = {row(even, evens, r, 'p')}; wide o = {row(odd, odds, r, 'm')};")
        lines.append(f"  c.k{r} = e - o; c.k{n - r} = e + o; }}")
    if evens > odds:
        lines.append(f"c.k{n // 2} = {row(even, evens, odds, 'p')};")
    return lines


def _halve(n: int, number: Callable[[float], str]) -> list[str]:
    """Return the statements of de Casteljau's algorithm; sums are not halved until the end."""
    lines = [f"far.k{j} = near.k{j};" for j in range(n + 1)]
    for r in range(1, n + 1):
        lines += [f"far.k{j} = far.k{j} + far.k{j + 1};" for j in range(n - r + 1)]
        lines.append(f"near.k{r} = {number(2.0**-r)} * far.k0;")
    return lines + [f"far.k{j} = {number(2.0 ** -(n - j))} * far.k{j};" for j in range(n)]


def _evaluate(n: int) -> list[str]:
    """Return the statements of polynomial_dual (glsl/lib/polynomial.glsl), for coefficients that hold binomials."""
    lines = [f"wide y_ = 1.0 - x; wide power_ = wide(1.0); wide slope_ = wide(0.0); v = q.k{n}; s = wide(0.0);"]
    for j in range(n - 1, -1, -1):
        lines.append("slope_ = slope_ * y_ - power_; power_ = power_ * y_;")
        lines.append(f"s = s * x + v + q.k{j} * slope_; v = v * x + q.k{j} * power_;")
    return lines


def _largest_after(n: int) -> list[str]:
    """Return the statements that find the largest coefficient behind the first that is not above e."""
    lines = ["wide low_ = c.k0; after = wide(-REAL_INFINITY);"]
    for j in range(1, n + 1):
        lines.append(f"after = CHOOSE(MORE(low_, e), after, max(after, c.k{j})); low_ = min(low_, c.k{j});")
    return lines
