"""Move surfaces as POV-Ray does: translate, scale, rotate and matrix, exactly where their numbers are rational.

POV-Ray turns by the left hand in left-handed coordinates, which in numbers is what the right hand does in ours: by 90
degrees about z, x goes to y. `rotate <a, b, c>` turns about x, then about y, then about z.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from math import cos, hypot, radians, sin

from surfaces.files.expressions import Text, add, call, div, mul, negative, rational, sub, word
from surfaces.model import Box, Domain, Sphere

Rows = tuple[tuple[float, float, float, float], ...]  # of a matrix and the shift: p'[i] = sum(row[j]*p[j]) + row[3]
_AXES = "xyz"
_ZERO, _ONE = rational(0), rational(1)


@dataclass(frozen=True)
class Move:
    """Hold an affine map in numbers, and the coordinates before it as formulas of those behind it.

    `back` has for each coordinate three factors and a shift.
    """

    rows: Rows
    back: tuple[tuple[Text, Text, Text, Text], ...]


def translation(by: tuple[Text, Text, Text], numbers: tuple[float, float, float]) -> Move:
    """Return a shift."""
    rows = tuple((*(float(i == j) for j in range(3)), numbers[i]) for i in range(3))
    back = tuple(
        (*(_ONE if i == j else _ZERO for j in range(3)), _ZERO if by[i].value == 0 else negative(by[i]))
        for i in range(3)
    )
    return Move(rows, back)  # type: ignore[arg-type]


def scaling(by: tuple[Text, Text, Text], numbers: tuple[float, float, float]) -> Move:
    """Return a scaling along the axes."""
    rows = tuple((*(numbers[i] if i == j else 0.0 for j in range(3)), 0.0) for i in range(3))
    back = tuple((*(div(_ONE, by[i]) if i == j else _ZERO for j in range(3)), _ZERO) for i in range(3))
    return Move(rows, back)  # type: ignore[arg-type]


def rotations(by: tuple[Text, Text, Text], numbers: tuple[float, float, float]) -> list[Move]:
    """Return the turns about x, y and z, in degrees, without those by 0."""
    return [_turn(axis, by[axis], numbers[axis]) for axis in range(3) if by[axis].value != 0]


def _turn(axis: int, angle: Text, degrees: float) -> Move:
    """Return a turn about an axis."""
    first, second = (axis + 1) % 3, (axis + 2) % 3
    quarter = angle.value is not None and angle.value % 90 == 0
    if quarter:
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[int(Fraction(angle.value or 0) // 90) % 4]
        cosine, sine = rational(c), rational(s)
        number_c, number_s = float(c), float(s)
    else:
        turned = div(mul(angle, word("pi")), rational(180))
        cosine, sine = call("cos", turned), call("sin", turned)
        number_c, number_s = cos(radians(degrees)), sin(radians(degrees))
    rows = [[float(i == j) for j in range(3)] + [0.0] for i in range(3)]
    rows[first][first] = rows[second][second] = number_c
    rows[first][second], rows[second][first] = -number_s, number_s
    back = [[_ONE if i == j else _ZERO for j in range(4)] for i in range(3)]
    back[first][first] = back[second][second] = cosine
    back[first][second] = sine
    back[second][first] = rational(-(sine.value or 0)) if quarter else negative(sine)
    return Move(tuple(map(tuple, rows)), tuple(map(tuple, back)))  # type: ignore[arg-type]


def by_matrix(values: list[Fraction]) -> Move | None:
    """Return the map of POV-Ray's matrix <12 numbers>; None where it has no inverse.

    Its numbers are the images of the axes, three each, and then the shift.
    """
    a = [[values[3 * j + i] for j in range(3)] for i in range(3)]  # rows
    shift = values[9:]
    minors = [
        [
            a[(i + 1) % 3][(j + 1) % 3] * a[(i + 2) % 3][(j + 2) % 3]
            - a[(i + 1) % 3][(j + 2) % 3] * a[(i + 2) % 3][(j + 1) % 3]
            for j in range(3)
        ]
        for i in range(3)
    ]
    determinant = sum(a[0][j] * minors[0][j] for j in range(3))
    if determinant == 0:
        return None
    inverse = [[minors[j][i] / determinant for j in range(3)] for i in range(3)]
    back = tuple(
        (*map(rational, row), rational(-sum(e * s for e, s in zip(row, shift, strict=True)))) for row in inverse
    )
    rows = tuple((*map(float, row), float(s)) for row, s in zip(a, shift, strict=True))
    return Move(rows, back)  # type: ignore[arg-type]


def applied(row: tuple[Text, Text, Text, Text], at: tuple[Text, Text, Text]) -> Text:
    """Return the sum of a row's factors times coordinates, and its shift."""
    total: Text | None = None
    for factor, coordinate in [*zip(row, at, strict=False), (row[3], None)]:
        if factor.value == 0:
            continue
        falls = factor.parts[0] == "-" and isinstance(factor.parts[-1], Text)
        size = factor.parts[-1] if falls else factor
        assert isinstance(size, Text)
        term = size if coordinate is None else _times(size, coordinate)
        if total is None:
            total = negative(term) if falls else term
        else:
            total = sub(total, term) if falls else add(total, term)
    return total or _ZERO


def _times(factor: Text, coordinate: Text) -> Text:
    """Return a factor times a coordinate: a quotient for 1/a, and the coordinate alone for 1."""
    if factor.value == 1:
        return coordinate
    if factor.parts[1:2] == ("/",) and isinstance(factor.parts[0], Text) and factor.parts[0].value == 1:
        divisor = factor.parts[2]
        if isinstance(divisor, Text):
            return div(coordinate, divisor)
    return mul(factor, coordinate)


def moved(region: Domain, move: Move) -> tuple[Domain, bool]:
    """Return a region behind a move, and whether it is exactly that: else it is a box around it."""
    if isinstance(region, Sphere):
        columns = [[row[j] for row in move.rows] for j in range(3)]
        lengths = [hypot(*column) for column in columns]
        crossed = [
            abs(sum(a * b for a, b in zip(columns[i], columns[j], strict=True))) for i, j in ((0, 1), (0, 2), (1, 2))
        ]
        if max(crossed) <= 1e-12 * max(lengths) ** 2 and max(lengths) - min(lengths) <= 1e-12 * max(lengths):
            return Sphere(region.radius * max(lengths), _point(region.center, move)), True
        center, size = region.center, region.radius
        reach = [size * hypot(*row[:3]) for row in move.rows]
        middle = _point(center, move)
        return _box(
            [m - r for m, r in zip(middle, reach, strict=True)], [m + r for m, r in zip(middle, reach, strict=True)]
        ), False
    corners = [_point(corner, move) for corner in product(*zip(region.lower, region.upper, strict=True))]  # type: ignore[arg-type]
    straight = all(sum(abs(entry) > 1e-12 for entry in row[:3]) == 1 for row in move.rows)
    return _box(
        [min(axis) for axis in zip(*corners, strict=True)], [max(axis) for axis in zip(*corners, strict=True)]
    ), straight


def _point(point: tuple[float, float, float], move: Move) -> tuple[float, float, float]:
    x, y, z = (sum(a * b for a, b in zip(row, (*point, 1.0), strict=True)) for row in move.rows)
    return x, y, z


def _box(lower: list[float], upper: list[float]) -> Box:
    return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))
