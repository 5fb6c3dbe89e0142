"""Hold distance functions: f is the distance to a solid, negative inside, or nowhere greater than it.

Where |f| is the distance outside, as of a box, it is often less inside; of unions and intersections f is a bound.
`distance` is f itself then, for sphere tracing. Of the two surfaces that are scaled it is a part of f.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

from surfaces.entries import FULL, PHI, REVOLVED, ROUND, entry
from surfaces.model import Box, Domain, Sphere, Surface

TITLE = "Distance functions and their unions, intersections and blends"
_HART = "J. C. Hart, Sphere tracing, The Visual Computer 12, 1996"
_QUILEZ = "I. Quilez, Distance functions, 2008"
_TORUS = "sqrt((sqrt(x^2 + y^2) - 0.7)^2 + z^2) - 0.3"
_ROUND_BOX = (
    "sqrt(max(abs(x) - 0.5, 0)^2 + max(abs(y) - 0.4, 0)^2 + max(abs(z) - 0.3, 0)^2)"
    " + min(max(abs(x) - 0.5, abs(y) - 0.4, abs(z) - 0.3), 0) - 0.1"
)


def _distance(
    name: str, title: str, formula: str, domain: Domain, source: str, part: str | None = None, **facts: Any
) -> Surface:
    """Return a surface whose f is a bound of the distance, or `part` times f."""
    distance = formula if part is None else f"{part}*({formula})"
    return entry(name, title, formula, None, domain, source, distance=distance, **facts)


def ball(x: float, y: float, z: float, radius: float) -> str:
    """Return the distance from a ball."""
    terms = [
        axis if c == 0 else f"({axis} {'-' if c > 0 else '+'} {abs(c):.12g})"
        for axis, c in zip("xyz", (x, y, z), strict=True)
    ]
    return f"sqrt({' + '.join(f'{term}^2' for term in terms)}) - {radius:.12g}"


def smooth_min(a: str, b: str, k: float) -> str:
    """Return the quadratic smooth minimum of two functions, which blends them where they differ by less than k."""
    return f"min({a}, {b}) - max({k:g} - abs({a} - ({b})), 0)^2/{4 * k:g}"


_OUTER = sqrt(2.0 + PHI)  # the radius of the icosahedron with edges of 2
_VERTICES: list[tuple[float, float, float]] = [  # of the icosahedron, scaled to a sphere of radius 1
    (x / _OUTER, y / _OUTER, z / _OUTER)
    for a in (1.0, -1.0)
    for b in (PHI, -PHI)
    for x, y, z in ((b, a, 0.0), (0.0, b, a), (a, 0.0, b))
]
_LEFT, _RIGHT = ball(-0.4, 0, 0, 0.7), ball(0.4, 0, 0, 0.7)

SURFACES: tuple[Surface, ...] = (
    _distance(
        "ball_distance",
        "Distance from a ball",
        "sqrt(x^2 + y^2 + z^2) - 1",
        Sphere(1.5),
        f"{_HART}, appendix A",
        symmetries=ROUND,
        points=((1, 0, 0), (0, 0.6, 0.8)),
        bounding_radius=1.0,
    ),
    _distance(
        "torus_distance",
        "Distance from a torus",
        _TORUS,
        Box((-1, -1, -0.3), (1, 1, 0.3)),
        f"{_HART}, appendix A",
        symmetries=REVOLVED,
        points=((1, 0, 0), (0, 0.4, 0), (0.7, 0, 0.3)),
    ),
    _distance(
        "rounded_box",
        "Distance from a rounded box",
        _ROUND_BOX,
        Box((-0.625, -0.5, -0.4375), (0.625, 0.5, 0.4375)),
        _QUILEZ,
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
        points=((0.6, 0.2, 0.1), (0, 0, -0.4)),
    ),
    _distance(
        "box_frame",
        "Distance bound of the frame of a box",
        "max(max(abs(x), abs(y), abs(z)) - 0.8,"
        " 0.65 - max(min(abs(x), abs(y)), min(abs(y), abs(z)), min(abs(z), abs(x))))",
        Box((-0.875, -0.875, -0.875), (0.875, 0.875, 0.875)),
        f"{_QUILEZ}: the frame, here as an intersection",
        symmetries=FULL,
    ),
    _distance(
        "capsule",
        "Distance from a capsule",
        "sqrt(x^2 + y^2 + max(abs(z) - 0.6, 0)^2) - 0.4",
        Box((-0.5, -0.5, -1.125), (0.5, 0.5, 1.125)),
        _QUILEZ,
        symmetries=REVOLVED,
        points=((0.4, 0, 0.3), (0, 0, 1)),
    ),
    _distance(
        "leaning_capsule",
        "Distance from a capsule between two points",
        # from (-0.6, -0.3, -0.6) along (1.2, 0.6, 1.2), whose square is 3.24
        "sqrt((x + 0.6 - 1.2*min(max((1.2*x + 0.6*y + 1.2*z + 1.62)/3.24, 0), 1))^2"
        " + (y + 0.3 - 0.6*min(max((1.2*x + 0.6*y + 1.2*z + 1.62)/3.24, 0), 1))^2"
        " + (z + 0.6 - 1.2*min(max((1.2*x + 0.6*y + 1.2*z + 1.62)/3.24, 0), 1))^2) - 0.3",
        Sphere(1.3),
        _QUILEZ,
        symmetries=("swap_xz",),
        points=((0.8, 0.4, 0.8),),
    ),
    _distance(
        "capped_cylinder",
        "Distance from a cylinder with caps",
        "min(max(sqrt(x^2 + y^2) - 0.6, abs(z) - 0.8), 0)"
        " + sqrt(max(sqrt(x^2 + y^2) - 0.6, 0)^2 + max(abs(z) - 0.8, 0)^2)",
        Box((-0.75, -0.75, -1), (0.75, 0.75, 1)),
        _QUILEZ,
        symmetries=REVOLVED,
        points=((0.6, 0, 0.5), (0.2, 0, 0.8)),
    ),
    _distance(
        "cone",
        "Distance bound of a cone with a base",
        "max(0.8*sqrt(x^2 + y^2) + 0.6*z - 0.6, -0.6 - z)",
        Box((-1.25, -1.25, -0.75), (1.25, 1.25, 1.125)),
        f"{_HART}, appendix A: the cone, cut by a plane",
        symmetries=("rotate_z_5", "mirror_x"),
        points=((0, 0, 1), (0.75, 0, 0), (0, 0, -0.6)),
    ),
    _distance(
        "octahedron",
        "Distance bound of an octahedron",
        "(abs(x) + abs(y) + abs(z) - 1)/sqrt3",
        Sphere(1.125),
        f"{_QUILEZ}: the bound",
        symmetries=FULL,
        points=((1, 0, 0), (0.5, 0.25, 0.25)),
        bounding_radius=1.0,
    ),
    _distance(
        "hexagonal_prism",
        "Distance bound of a hexagonal prism",
        "max(abs(z) - 0.5, abs(x)*sqrt3/2 + abs(y)/2 - 0.8, abs(y) - 0.8)",
        Box((-1, -1, -0.625), (1, 1, 0.625)),
        f"{_QUILEZ}: the prism, here as an intersection",
        symmetries=("mirror_x", "mirror_z", "sixth_turn_z"),
        points=((0, 0.8, 0), (0, 0, 0.5)),
    ),
    _distance(
        "chain_link",
        "Distance from a link of a chain",
        "sqrt((sqrt(x^2 + max(abs(y) - 0.4, 0)^2) - 0.5)^2 + z^2) - 0.2",
        Box((-0.75, -1.125, -0.25), (0.75, 1.125, 0.25)),
        _QUILEZ,
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
        points=((0.7, 0.2, 0), (0, 1.1, 0), (0.5, 0, 0.2)),
    ),
    _distance(
        "scaled_ellipsoid",
        "Ellipsoid as a scaled length",
        "sqrt(x^2 + y^2/0.36 + z^2/0.16) - 1",
        Box((-1.0625, -0.6875, -0.4375), (1.0625, 0.6875, 0.4375)),
        f"{_HART}, section 3: a Lipschitz constant of 1/0.4",
        part="0.4",
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
        points=((1, 0, 0), (0, 0.6, 0), (0, 0, 0.4)),
    ),
    _distance(
        "twisted_box",
        "Twisted box",
        "max(abs(x*cos(2*z) + y*sin(2*z)) - 0.4, abs(y*cos(2*z) - x*sin(2*z)) - 0.4, abs(z) - 0.8)",
        Box((-0.625, -0.625, -0.875), (0.625, 0.625, 0.875)),
        f"A. H. Barr, Global and local deformations of solid primitives, 1984; {_QUILEZ}",
        part="0.45",  # |grad f|^2 <= 1 + (2 r)^2 with r <= 0.625 sqrt(2)
        symmetries=("half_turn_x", "half_turn_z"),
        points=((0.4, 0.1, 0), (0, 0, 0.8)),
    ),
    _distance(
        "two_balls",
        "Union of two balls",
        f"min({_LEFT}, {_RIGHT})",
        Box((-1.25, -0.75, -0.75), (1.25, 0.75, 0.75)),
        f"{_HART}, section 3: union",
        symmetries=("mirror_x", "rotate_x_5", "mirror_y"),
        points=((1.1, 0, 0), (-0.4, 0, 0.7)),
    ),
    _distance(
        "lens",
        "Intersection of two balls",
        f"max({_LEFT}, {_RIGHT})",
        Box((-0.375, -0.625, -0.625), (0.375, 0.625, 0.625)),
        f"{_HART}, section 3: intersection",
        symmetries=("mirror_x", "rotate_x_5", "mirror_y"),
        points=((0.3, 0, 0), (-0.3, 0, 0)),
    ),
    _distance(
        "bitten_ball",
        "Difference of two balls",
        f"max(sqrt(x^2 + y^2 + z^2) - 1, -({ball(0.75, 0.25, 0.5, 0.6)}))",
        Sphere(1.125),
        f"{_HART}, section 3: complement and intersection",
        points=((-1, 0, 0), (0.75, 0.25, -0.1)),
        bounding_radius=1.0,
    ),
    _distance(
        "nested_shells",
        "Nested shells, cut open",
        "max(abs(abs(abs(sqrt(x^2 + y^2 + z^2) - 0.6) - 0.2) - 0.1) - 0.04, (x + y + z - 0.3)/sqrt3)",
        Sphere(1.125),
        f"{_QUILEZ}: making shapes annular",
        symmetries=("swap_xy", "cycle_xyz"),
        bounding_radius=0.95,
        points=((0, 0, -0.94), (0, 0, -0.86)),
    ),
    _distance(
        "icosahedral_union",
        "Union of twelve balls",
        f"min({', '.join(ball(*point, 0.4) for point in _VERTICES)})",
        Sphere(1.5),
        f"{_HART}, section 3: union",
        symmetries=("mirror_x", "cycle_xyz", "icosahedral_turn"),
        bounding_radius=1.4 + 1e-9,
    ),
    _distance(
        "smooth_union",
        "Smooth union of a rounded box and a ball",
        smooth_min(_ROUND_BOX, ball(0, 0, 0.6, 0.35), 0.2),
        Box((-0.75, -0.625, -0.5), (0.75, 0.625, 1.0625)),
        "I. Quilez, Smooth minimum, 2013: quadratic polynomial",
        symmetries=("mirror_x", "mirror_y"),
        points=((0, 0, -0.4), (0.6, 0, 0)),
    ),
    _distance(
        "exponential_union",
        "Union of a torus and a ball by exponentials",
        f"-log(exp(-8*({_TORUS})) + exp(-8*({ball(0.7, 0, 0.3, 0.3)})))/8",
        Box((-1.125, -1.125, -0.375), (1.125, 1.125, 0.75)),
        "I. Quilez, Smooth minimum, 2013: exponential",
        symmetries=("mirror_y",),
    ),
    _distance(
        "menger_sponge",
        "Menger sponge of two levels",
        "let cross(a, b, c) = min(max(a, b), max(b, c), max(c, a)) - 1;"
        " let third(t) = mod(3*t + 1, 2) - 1;"  # of the cube, from -1 to 1
        " let hole(p, q, r) = cross(abs(p), abs(q), abs(r));"
        " max(abs(x) - 1, abs(y) - 1, abs(z) - 1, -hole(3*x, 3*y, 3*z)/3,"
        " -hole(3*third(x), 3*third(y), 3*third(z))/9)",
        Box((-1.125, -1.125, -1.125), (1.125, 1.125, 1.125)),
        "K. Menger 1926; I. Quilez, Menger fractal, 2011",
        symmetries=FULL,
        points=((1, 0.5, 0.5), (0.5, 0.5, 1)),
    ),
)
