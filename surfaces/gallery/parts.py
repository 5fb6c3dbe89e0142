"""Hold parts as a CAD system makes them: unions, intersections and differences of solids, with fillets and bores."""

from __future__ import annotations

from itertools import product

from surfaces.entries import FULL, entry
from surfaces.gallery.distances import smooth_min
from surfaces.model import Box, Sphere, Surface

TITLE = "CAD parts: unions, intersections, differences, fillets"
_REQUICHA = "A. A. G. Requicha, Representations for rigid solids, ACM Computing Surveys 12, 1980: constructive solids"
_BARR = "A. H. Barr, Superquadrics and angle-preserving transformations, IEEE CG&A 1, 1981"
_PASKO = "A. Pasko, V. Adzhiev, A. Sourin, V. Savchenko, Function representation, The Visual Computer 11, 1995"
_RICCI = "A. Ricci, A constructive geometry for computer graphics, The Computer Journal 16, 1973: min and max"
_QUILEZ = "I. Quilez, Smooth minimum, 2013: quadratic polynomial"
_BLOCK = "max(abs(x), abs(y), abs(z)) - 0.75"


def _pips() -> list[tuple[float, float, float]]:
    """Return the middles of the 21 pips of a die whose faces are at 0.6; opposite faces sum to seven."""
    one = [(0.0, 0.0)]
    two = [(-0.3, -0.3), (0.3, 0.3)]
    four = [(a, b) for a, b in product((-0.3, 0.3), repeat=2)]
    faces: dict[int, list[tuple[float, float]]] = {
        1: one,
        2: two,
        3: one + two,
        4: four,
        5: one + four,
        6: [*four, (0.0, -0.3), (0.0, 0.3)],
    }
    found = []
    for pips, axis, side in ((1, 2, 1), (6, 2, -1), (2, 0, 1), (5, 0, -1), (3, 1, 1), (4, 1, -1)):
        for u, v in faces[pips]:
            z = 0.6 * side
            found.append(((z, u, v), (u, z, v), (u, v, z))[axis])
    return found


def _ball(point: tuple[float, float, float], square: str) -> str:
    """Return a ball as a polynomial that is negative inside."""
    terms = (
        axis if c == 0 else f"({axis} {'-' if c > 0 else '+'} {abs(c):g})" for axis, c in zip("xyz", point, strict=True)
    )
    return f"{' + '.join(f'{term}^2' for term in terms)} - {square}"


_PIPS = ", ".join(f"-({_ball(point, '0.01')})" for point in _pips())
_RODS = ("x^2 + y^2 - 0.16", "y^2 + z^2 - 0.16", "z^2 + x^2 - 0.16")
_BALLS = ", ".join(f"{_ball((0.6 * a, 0.6 * b, 0.0), '0.0225')}" for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1)))
_DIAGONAL = ", ".join(f"{_ball((0.42426 * a, 0.42426 * b, 0.0), '0.0225')}" for a, b in product((1, -1), repeat=2))
_BIG_END, _SMALL_END = "sqrt((x + 0.8)^2 + y^2) - 0.5", "sqrt((x - 0.8)^2 + y^2) - 0.35"
_SHANK = "max(abs(x) - 0.8, abs(y) - 0.16)"
_ROD = smooth_min(f"min({_BIG_END}, {_SMALL_END})", _SHANK, 0.2)
_FOOT, _WALL = (
    "max(abs(x) - 0.8, abs(y) - 0.6, abs(z + 0.6) - 0.12)",
    "max(abs(x + 0.68) - 0.12, abs(y) - 0.6, abs(z) - 0.72)",
)

SURFACES: tuple[Surface, ...] = (
    entry(
        "csg_block",
        "Block, ball and bores",
        f"max({_BLOCK}, x^2 + y^2 + z^2 - 1, {', '.join(f'-({rod})' for rod in _RODS)})",
        None,
        Box((-0.875, -0.875, -0.875), (0.875, 0.875, 0.875)),
        _REQUICHA,
        symmetries=FULL,
        points=((0.75, 0.4, 0.25), (0.75, 0, 0.4)),
    ),
    entry(
        "mounting_plate",
        "Plate with four holes",
        "max(abs(x) - 1, abs(y) - 0.7, abs(z) - 0.15, 0.0225 - (abs(x) - 0.75)^2 - (abs(y) - 0.45)^2,"
        " 0.09 - x^2 - y^2)",
        None,
        Box((-1.125, -0.8125, -0.25), (1.125, 0.8125, 0.25)),
        _REQUICHA,
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
        points=((1, 0, 0), (0.3, 0, 0), (0.9, 0.45, 0.1)),
    ),
    entry(
        "flange",
        "Flange with a hub and six bolt holes",
        "max(min(max(x^2 + y^2 - 1, abs(z + 0.3) - 0.12), max(x^2 + y^2 - 0.2, abs(z) - 0.42)), 0.09 - x^2 - y^2,"
        " 0.01 - (abs(x) - 0.75)^2 - y^2, 0.01 - (abs(x) - 0.375)^2 - (abs(y) - 0.649519)^2)",
        None,
        Box((-1.125, -1.125, -0.5), (1.125, 1.125, 0.5)),
        _REQUICHA,
        symmetries=("mirror_x", "mirror_y"),
        points=((1, 0, -0.3), (0.3, 0, 0)),
    ),
    entry(
        "hex_nut",
        "Hexagonal nut",
        "max(abs(z) - 0.4, abs(x)*sqrt3/2 + abs(y)/2 - 0.8, abs(y) - 0.8, 0.45 - sqrt(x^2 + y^2),"
        " sqrt(x^2 + y^2)/2 + abs(z)*sqrt3/2 - 0.77)",
        None,
        Box((-1, -1, -0.5), (1, 1, 0.5)),
        f"{_REQUICHA}; chamfers of 30 degrees as in ISO 4032",
        symmetries=("mirror_x", "mirror_z", "sixth_turn_z"),
        points=((0, 0.8, 0), (0.45, 0, 0.1), (0, 0.6, 0.4)),
    ),
    entry(
        "pipe_tee",
        "Pipe tee",
        "max(min(max(y^2 + z^2 - 0.16, abs(x) - 1), max(x^2 + y^2 - 0.16, abs(z - 0.5) - 0.5)), 0.09 - y^2 - z^2,"
        " min(0.09 - x^2 - y^2, z))",
        None,
        Box((-1.125, -0.5, -0.5), (1.125, 0.5, 1.125)),
        _REQUICHA,
        symmetries=("mirror_x", "mirror_y"),
        points=((1, 0.35, 0), (0, 0, -0.4)),
    ),
    entry(
        "bracket",
        "Bracket with a fillet and two holes",
        f"max({smooth_min(_FOOT, _WALL, 0.3)}, 0.04 - (x - 0.35)^2 - y^2, 0.04 - y^2 - (z - 0.25)^2)",
        None,
        Box((-0.9375, -0.75, -0.875), (0.9375, 0.75, 0.875)),
        f"{_REQUICHA}; {_QUILEZ}",
        symmetries=("mirror_y",),
    ),
    entry(
        "connecting_rod",
        "Connecting rod",
        f"max({_ROD}, abs(z) - 0.15, 0.3 - sqrt((x + 0.8)^2 + y^2), 0.18 - sqrt((x - 0.8)^2 + y^2))",
        None,
        Box((-1.4375, -0.625, -0.25), (1.3125, 0.625, 0.25)),
        f"{_REQUICHA}; {_QUILEZ}",
        symmetries=("mirror_y", "mirror_z"),
        points=((-1.3, 0, 0), (0.98, 0, 0.05)),
    ),
    entry(
        "ball_bearing",
        "Ball bearing",
        f"min(max(abs(x^2 + y^2 - 0.36) - 0.28, abs(z) - 0.18, 0.0225 - (sqrt(x^2 + y^2) - 0.6)^2 - z^2,"
        f" 0.09 - abs(x^2 + y^2 - 0.36)), {_BALLS}, {_DIAGONAL})",
        None,
        Box((-0.875, -0.875, -0.25), (0.875, 0.875, 0.25)),
        _REQUICHA,
        symmetries=("mirror_x", "mirror_z", "swap_xy"),
    ),
    entry(
        "die",
        "Die",
        f"max({_BLOCK.replace('0.75', '0.6')}, x^2 + y^2 + z^2 - 0.7, {_PIPS})",
        None,
        Box((-0.6875, -0.6875, -0.6875), (0.6875, 0.6875, 0.6875)),
        f"{_RICCI}; 21 pips",
        points=((0, 0, 0.5), (0.2, 0, 0.6)),
    ),
    entry(
        "superellipsoid",
        "Superellipsoid",
        "(x^4 + y^4)^2 + z^8 - 1",
        8,
        Sphere(1.75),
        f"{_BARR}: exponents 1/2 and 1/4",
        symmetries=("mirror_x", "mirror_z", "swap_xy"),
        points=((1, 0, 0), (0, 0, -1)),
        singular_points=0,
    ),
    entry(
        "supertoroid",
        "Supertoroid",
        "(sqrt(x^2 + y^2) - 0.7)^8 + z^8 - 0.00006561",
        None,
        Box((-1.0625, -1.0625, -0.375), (1.0625, 1.0625, 0.375)),
        f"{_BARR}: a square ring with rounded edges, 0.3^8",
        symmetries=("rotate_z_5", "mirror_x", "mirror_z"),
        points=((1, 0, 0), (0.7, 0, 0.3)),
    ),
    entry(
        "gyroid_infill",
        "Block filled with a gyroid",
        f"max({_BLOCK}, abs(cos(8*x)*sin(8*y) + cos(8*y)*sin(8*z) + cos(8*z)*sin(8*x)) - 0.4)",
        None,
        Box((-0.8125, -0.8125, -0.8125), (0.8125, 0.8125, 0.8125)),
        "D. Yoo, Porous scaffold design by implicit functions, Int. J. Precis. Eng. Manuf. 12, 2011; Schoen 1970",
        symmetries=("cycle_xyz",),
    ),
    entry(
        "superquadric_5",
        "Superquadric with exponent 5/2",
        "abs(x)^2.5 + abs(y)^2.5 + abs(z)^2.5 - 1",
        None,
        Sphere(1.25),
        _BARR,
        symmetries=FULL,
        points=((1, 0, 0), (0, -1, 0)),
    ),
    entry(
        "astroidal_ellipsoid",
        "Astroidal ellipsoid",
        "abs(x)^(2/3) + abs(y)^(2/3) + abs(z)^(2/3) - 1",
        None,
        Sphere(1.0625),
        "A. Gray, Modern Differential Geometry, 1997; E. W. Weisstein, MathWorld: Astroidal Ellipsoid",
        symmetries=FULL,
        points=((1, 0, 0), (0, -1, 0)),
    ),
    entry(
        "threaded_rod",
        "Threaded rod",
        "max(sqrt(x^2 + y^2) - 0.5 - 0.06*cos(atan2(y, x) - 12*z), abs(z) - 1)",
        None,
        Box((-0.625, -0.625, -1.125), (0.625, 0.625, 1.125)),
        f"{_PASKO}: a surface of revolution, displaced along a helix",
        symmetries=("half_turn_x",),
        points=((0.56, 0, 0), (0.1, 0.2, 1)),
    ),
    entry(
        "spur_gear",
        "Spur gear",
        "max(sqrt(x^2 + y^2) - 0.85 - 0.1*tanh(3*cos(12*atan2(y, x))), abs(z) - 0.2, 0.3 - sqrt(x^2 + y^2))",
        None,
        Box((-1, -1, -0.25), (1, 1, 0.25)),
        f"{_PASKO}; teeth as a smooth wave of the angle",
        symmetries=("twelfth_turn_z", "mirror_x", "mirror_y", "mirror_z"),
        points=((0.3, 0, 0), (0.5, 0, 0.2)),
    ),
    entry(
        "helical_spring",
        "Helical spring",
        "(sqrt(x^2 + y^2) - 0.7)^2 + (1 - cos(atan2(y, x) - 8*z))/32 - 0.01",
        None,
        Box((-0.875, -0.875, -1.125), (0.875, 0.875, 1.125)),
        "E. W. Weisstein, MathWorld: Helix; the tube about it, cut by its domain",
        symmetries=("half_turn_x",),
        points=((0.8, 0, 0), (0.6, 0, 0)),
    ),
    entry(
        "heat_sink",
        "Heat sink",
        "max(min(abs(mod(x + 0.1, 0.2) - 0.1) - 0.03, z + 0.35), abs(x) - 0.93, abs(y) - 0.7, abs(z) - 0.5)",
        None,
        Box((-1.0625, -0.8125, -0.625), (1.0625, 0.8125, 0.625)),
        f"{_REQUICHA}; fins repeated by a remainder",
        symmetries=("mirror_y",),
        points=((0, 0, 0.5), (0.03, 0, 0)),
    ),
)
