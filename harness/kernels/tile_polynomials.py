"""Generate the macros on polynomials of a method that casts tiles, for one degree.

They work on the fields of struct Poly, or on the numbers of a net: straight-line text, since compilers do not keep
arrays in registers where loops index them.

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

And on what isolation keeps of a tile (glsl/tiles/nets_*.glsl), where one work item has all its lanes:

    KEEP_NUMBER(lanes, v)   puts v into the place of the lane that is being done
    NUMBER(lanes)           the number in that place
    FARTHER(o, p, v)        v becomes the largest distance of coefficients of p from those of o, if that is larger
    ACROSS(row)             makes the coefficients of a row of nodes those of cubics in Bernstein form
    WIDEN(net, b)           b becomes what bounds the control net's first column too: ACROSS's transform, downwards
    TO_CUBIC(lanes)         makes the nodes' numbers the coefficients of 1, x, x², x³ in both directions
    FIND_WEIGHTS(lanes, t)  lanes = the factors of fourth derivatives in the bound of tile t's remainder at depth 1
    NO_BOUNDS(lanes)        lanes = 0
    RAISE_BOUNDS(lanes, g, place)  lanes become the bounds at a place of their table, times g, where these are larger
    WEIGHED(a, b)           the sum of the products of the lanes' numbers
    HALVE_FALL(near, far)   halves the polynomial of differences, whose degree is one less
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import comb

from harness.contract import Language, Precision, Section, Surface
from harness.kernels.fourths import NODES, POWERS
from harness.kernels.sections import Lanes, TileStage, literal

Row = Sequence[Fraction]
LONGEST = 600  # operations that f's text may have in SAMPLE where a work item does all lanes: compilers inline it


def to_nodes() -> list[Row]:
    """Return the matrix that turns cubic Bernstein coefficients on [-1, 1] into values at NODES."""
    return [
        [comb(3, j) * ((1 + x) / 2) ** j * ((1 - x) / 2) ** (3 - j) for j in range(4)] for x in map(Fraction, NODES)
    ]


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


def macros(surface: Surface, precision: Precision, language: Language, lanes: Lanes, stage: TileStage) -> Section:
    """Return struct Poly and the macros that are listed above, for the surface's degree.

    Those on what isolation keeps are for the stage that isolates. `lanes` says who has the lanes in this stage.
    """
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
        (
            "SAMPLE(s, o, d, a, h)",
            [f"s.k{i} = wide_value(wide_point(o, a + h * {number(tables['NODES'][i])}, d));" for i in ks],
        ),
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
    if lanes == "own" and stage == "isolate":
        made += [*_own_net(n, number), ("SAMPLE(s, o, d, a, h)", _sampled(surface, tables["NODES"], number))]
        rows = [chosen("work.column", [f"lanes.v{4 * row + x}" for x in range(4)]) for row in range(4)]
        values.append(("NUMBER(lanes)", chosen("work.row", rows)))
        values.append(("WEIGHED(a, b)", " + ".join(f"a.v{k} * b.v{k}" for k in range(15))))
        values.append(("LARGEST_FALL(c)", _paired("max", [f"c.k{j}" for j in range(n)])))
    elif lanes == "group":
        made.append(("TRANSFORM(c, rows)", _exchanged_transform(n)))
    lines = [struct]
    for head, statements in dict(made).items():
        body = " \\\n    ".join(["{", *statements])
        lines.append(f"#define {head} {body} }}")
    lines += [
        f"#define {head} ({text})" if head != "CONSTANT(c, v)" else f"#define {head} {{ {text} }}"
        for head, text in values
    ]
    return Section(f"generated: polynomials of degree {n}", "\n".join(lines))


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
        used = [i for i in range(width) if table[r * width + i] != 0.0]
        text = f"{number(table[r * width + used[0]])} * {variable}{used[0]}"
        for i in used[1:]:
            text = f"FUSED({number(table[r * width + i])}, {variable}{i}, {text})"
        return text

    for r in range(odds):
        lines.append(f"{{ wide e = {row(even, evens, r, 'p')}; wide o = {row(odd, odds, r, 'm')};")
        lines.append(f"  c.k{r} = e - o; c.k{n - r} = e + o; }}")
    if evens > odds:
        lines.append(f"c.k{n // 2} = {row(even, evens, odds, 'p')};")
    return lines


def _sampled(surface: Surface, nodes: Sequence[float], number: Callable[[float], str]) -> list[str]:
    """Return the statements of SAMPLE where f stands in them for LONGEST operations at most, or once.

    Where all samples have more operations, the last ones are taken in the turns of a loop, and s is a queue.
    """
    import surfaces
    from surfaces.lowering import real_tape

    count = len(nodes)
    each = max(1, LONGEST // len(real_tape(surfaces.tape_of(surface)).ops))  # samples a turn
    turns = count // each if each < count else 0
    first = count - turns * each

    def sample(i: int, place: str) -> str:
        return f"s.k{i} = wide_value(wide_point(o, a + h * {place}, d));"

    if not turns:
        return [sample(i, number(place)) for i, place in enumerate(nodes)]
    lines = [sample(count - first + i, number(nodes[i])) for i in range(first)]
    lines += [
        f"for (int turn_ = 0; turn_ < {turns}; turn_++) {{",
        *[f"s.k{i} = s.k{i + each};" for i in range(count - each)],
    ]
    for i in range(each):
        *early, last = [number(place) for place in nodes[first + i :: each]]
        place = " : ".join([*[f"turn_ == {turn} ? {text}" for turn, text in enumerate(early)], last])
        lines.append(sample(count - each + i, f"({place})"))
    return [*lines, "}"]


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
        lines.append("slope_ = FUSED(slope_, y_, -power_); power_ = power_ * y_;")
        lines.append(f"s = FUSED(s, x, FUSED(q.k{j}, slope_, v)); v = FUSED(v, x, q.k{j} * power_);")
    return lines


def _largest_after(n: int) -> list[str]:
    """Return the statements that find the largest coefficient behind the first that is not above e."""
    lines = ["wide low_ = c.k0; after = wide(-REAL_INFINITY);"]
    for j in range(1, n + 1):
        lines.append(f"after = CHOOSE(MORE(low_, e), after, max(after, c.k{j})); low_ = min(low_, c.k{j});")
    return lines


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
    return f"all_bits({text})" if lanes in ("group", "warp") else text


def _exchanged_transform(n: int) -> list[str]:
    """Return the statements of TRANSFORM where work items share a tile: all coefficients are exchanged at once."""
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


def chosen(index: str, places: Sequence[str]) -> str:
    """Return the text that chooses among four places by an index."""
    a, b, c, d = places
    return f"({index} < 2 ? ({index} < 1 ? {a} : {b}) : ({index} < 3 ? {c} : {d}))"


def _own_net(n: int, number: Callable[[float], str]) -> list[tuple[str, list[str]]]:
    """Return the macros on a Net, a Bundle and Lanes of a work item that has all lanes; see nets_own.glsl."""
    ks, lanes = range(n + 1), range(16)

    columns = [f"c{x}" for x in range(4)]
    across, wider = [], []
    for j in ks:
        mixed = _row_mixed([f"row.{c}.k{j}" for c in columns], to_control(), number, differences=True)
        across += ["{", *[f"real {c}_ = {text};" for c, text in zip(columns, mixed, strict=True)]]
        across += [*[f"row.{c}.k{j} = {c}_;" for c in columns], "}"]
        mixed = _row_mixed([f"net.r{y}.c0.k{j}" for y in range(4)], to_control(), number, differences=True)
        own = [f"v{y}_{j}_" for y in range(4)]
        wider += [f"real {name} = {text};" for name, text in zip(own, mixed, strict=True)]
        wider.append(f"b.lo.k{j} = min(b.lo.k{j}, {_paired('min', own)});")
        wider.append(f"b.hi.k{j} = max(b.hi.k{j}, {_paired('max', own)});")
        if j:
            falls = [f"v{y}_{j}_ - v{y}_{j - 1}_" for y in range(4)]
            wider.append(f"b.fall.k{j - 1} = max(b.fall.k{j - 1}, {_paired('max', falls)});")
    wider.append(f"b.fall.k{n} = real(0);")
    farther = [f"spread_ = max(spread_, {_paired('max', [f'fabs(p.k{j} - o.k{j})' for j in ks])});"]
    numbers = [f"lanes.v{k}" for k in lanes]
    kept = [f"{place} = OWN_LANE == {k} ? number_ : {place};" for k, place in enumerate(numbers)]
    fall = _halve(n - 1, number) + [f"{half}.k{j} = 0.5 * {half}.k{j};" for half in ("near", "far") for j in range(n)]
    return [
        ("KEEP_NUMBER(lanes, v)", ["real number_ = v;", *kept]),
        ("ACROSS(row)", across),
        ("FARTHER(o, p, spread_)", farther),
        ("WIDEN(net, b)", wider),
        ("TO_CUBIC(lanes)", _mixed(numbers, to_powers(), number, differences=False)),
        *_own_bounds(numbers),
        ("HALVE_FALL(near, far)", [*fall, f"far.k{n} = real(0);"]),
    ]


def _mixed(
    places: Sequence[str], matrix: Sequence[Row], number: Callable[[float], str], differences: bool
) -> list[str]:
    """Return statements that apply a 4 by 4 matrix in both directions to the sixteen numbers at `places`.

    If `differences`, the sum of each of the matrix's rows is 1, and it is applied as TRANSFORM_ONE does.
    """

    def row(x: int, of: Sequence[str]) -> str:
        return _row_mixed(of, matrix, number, differences)[x]

    net = [places[4 * y : 4 * y + 4] for y in range(4)]
    half = [[f"h{4 * y + x}_" for y in range(4)] for x in range(4)]  # by columns
    across = [f"real {half[x][y]} = {row(x, net[y])};" for y in range(4) for x in range(4)]
    down = [f"{net[y][x]} = {row(y, half[x])};" for y in range(4) for x in range(4)]
    return ["{", *across, *down, "}"]


def _row_mixed(
    of: Sequence[str], matrix: Sequence[Row], number: Callable[[float], str], differences: bool
) -> list[str]:
    """Return the texts of a 4 by 4 matrix times the four numbers `of`; see _mixed."""
    texts = []
    for x in range(4):
        terms = [(number(float(matrix[x][x ^ i])), of[x ^ i]) for i in range(4)]
        if differences:
            texts.append(f"{of[x]} + ({' + '.join(f'{weight} * ({place} - {of[x]})' for weight, place in terms[1:])})")
        else:
            texts.append(" + ".join(f"{weight} * {place}" for weight, place in terms))
    return texts


def _own_bounds(lanes: Sequence[str]) -> list[tuple[str, list[str]]]:
    """Return the macros on bounds of fourth derivatives, of which each of a tile's lanes but the last has one."""
    weights = []
    for side, d in (("across", "u"), ("down", "v")):
        for axis in "xyz":
            weights.append(f"real {d}{axis}1_ = fabs(tile.{side}.{axis});")
            weights += [f"real {d}{axis}{k}_ = {d}{axis}1_ * {d}{axis}{k - 1}_;" for k in (2, 3, 4)]
    for lane, powers in zip(lanes, POWERS, strict=False):
        products = [
            " * ".join(f"{d}{axis}{power}_" for axis, power in zip("xyz", powers, strict=True) if power) for d in "uv"
        ]
        weights.append(f"{lane} = REMAINDER_X * ({products[0]}) + REMAINDER_Y * ({products[1]});")
    weights.append(f"{lanes[-1]} = real(0);")
    raised = [f"{v} = max({v}, grown * fourth_at(work, place + {k}));" for k, v in enumerate(lanes[:-1])]
    return [
        ("FIND_WEIGHTS(lanes, tile)", weights),
        ("NO_BOUNDS(lanes)", [f"{v} = real(0);" for v in lanes]),
        ("RAISE_BOUNDS(lanes, grown, place)", raised),
    ]
