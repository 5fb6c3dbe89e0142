"""Hold blobs: level sets of sums of bumps about points, segments and lines, and blends of two solids."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import cos, pi, sin

from surfaces.entries import FULL, entry
from surfaces.model import Box, Sphere, Surface

TITLE = "Blobs, metaballs and blends"
_BLINN = "J. F. Blinn, A generalization of algebraic surface drawing, ACM TOG 1, 1982"
_WYVILL = "G. Wyvill, C. McPheeters, B. Wyvill, Data structure for soft objects, The Visual Computer 2, 1986"
_SHERSTYUK = "A. Sherstyuk, Kernel functions in convolution surfaces, The Visual Computer 15, 1999"
_PASKO = "A. Pasko, V. Adzhiev, A. Sourin, V. Savchenko, Function representation, The Visual Computer 11, 1995"
_TRIANGLE = ((0.5, 0, 0), (-0.25, 0.4375, 0), (-0.25, -0.4375, 0), (0, 0, 0.5))
_RING = tuple((round(cos(k * pi / 6), 6), round(sin(k * pi / 6), 6), 0) for k in range(12))
Point = Sequence[float]


def square(point: Point) -> str:
    """Return the squared distance from a point."""
    terms = (
        axis if c == 0 else f"({axis} {'-' if c > 0 else '+'} {abs(c):.12g})"
        for axis, c in zip("xyz", point, strict=True)
    )
    return " + ".join(f"{term}^2" for term in terms)


def _summed(bump: str, points: Iterable[Point], level: str) -> str:
    """Return a sum of bumps over points, less the level. `bump` has the squared distance as `r2`."""
    return " + ".join(bump.replace("r2", f"({square(point)})") for point in points) + f" - {level}"


SURFACES: tuple[Surface, ...] = (
    entry(
        "dumbbell",
        "Two Gaussian blobs",
        _summed("exp(-4*r2)", ((0.6, 0, 0), (-0.6, 0, 0)), "0.4"),
        None,
        Box((-1.25, -0.75, -0.75), (1.25, 0.75, 0.75)),
        _BLINN,
        symmetries=("mirror_x", "mirror_y", "rotate_x_5"),
    ),
    entry(
        "soft_objects",
        "Wyvill's soft objects",
        _summed("(1 - 22/9*min(r2, 1) + 17/9*min(r2, 1)^2 - 4/9*min(r2, 1)^3)", _TRIANGLE, "0.5"),
        None,
        Sphere(1.25),
        f"{_WYVILL}: the cubic in r^2, over blobs of radius 1",
        symmetries=("mirror_y",),
    ),
    entry(
        "quartic_blobs",
        "Murakami's metaballs",
        _summed("max(1 - r2/0.64, 0)^2", _TRIANGLE, "0.3"),
        None,
        Sphere(1.25),
        "S. Murakami, H. Ichihara, On a 3D display method by metaball technique, 1987",
        symmetries=("mirror_y",),
    ),
    entry(
        "cauchy_blobs",
        "Blobs of the Cauchy kernel",
        _summed("1/(1 + 4*r2)^2", _TRIANGLE, "0.5"),
        None,
        Sphere(1.5),
        _SHERSTYUK,
        symmetries=("mirror_y",),
    ),
    entry(
        "softened_points",
        "Equipotential of softened masses",
        _summed("1/sqrt(r2 + 0.01)", ((0.6, 0, 0), (-0.6, 0, 0)), "3"),
        None,
        Box((-1.25, -0.75, -0.75), (1.25, 0.75, 0.75)),
        "H. C. Plummer, On the problem of distribution in globular star clusters, MNRAS 71, 1911: the potential",
        symmetries=("mirror_x", "mirror_y", "rotate_x_5"),
    ),
    entry(
        "gaussian_cross",
        "Gaussians about three lines",
        "exp(-6*(y^2 + z^2)) + exp(-6*(x^2 + z^2)) + exp(-6*(x^2 + y^2)) - 0.6",
        None,
        Box((-1, -1, -1), (1, 1, 1)),
        "J. Bloomenthal, K. Shoemake, Convolution surfaces, SIGGRAPH 1991: lines under a Gaussian",
        symmetries=FULL,
    ),
    entry(
        "blob_ring",
        "Ring of twelve blobs",
        _summed("exp(-20*r2)", _RING, "0.35"),
        None,
        Box((-1.375, -1.375, -0.375), (1.375, 1.375, 0.375)),
        _BLINN,
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
    ),
    entry(
        "ricci_union",
        "Ricci's blended union",
        "((x - 0.35)^2/0.36 + y^2/0.36 + z^2/0.36)^4*((x + 0.35)^2/0.36 + y^2/0.16 + z^2/0.64)^4"
        " - ((x - 0.35)^2/0.36 + y^2/0.36 + z^2/0.36)^4 - ((x + 0.35)^2/0.36 + y^2/0.16 + z^2/0.64)^4",
        16,
        Box((-1.25, -0.875, -1), (1.25, 0.875, 1)),
        "A. Ricci, A constructive geometry for computer graphics, The Computer Journal 16, 1973: (f^-4 + g^-4)^(-1/4)",
        symmetries=("mirror_y", "mirror_z"),
    ),
    entry(
        "r_function_union",
        "Union by an R-function",
        "(1 - x^2 - y^2 - z^2) + (0.16 - x^2 - y^2) + sqrt((1 - x^2 - y^2 - z^2)^2 + (0.16 - x^2 - y^2)^2)",
        None,
        Box((-1.125, -1.125, -1.5), (1.125, 1.125, 1.5)),
        "V. L. Rvachev, 1963; V. Shapiro, Semi-analytic geometry with R-functions, Acta Numerica 2007",
        symmetries=("rotate_z_5", "mirror_x", "mirror_z"),
        points=((1, 0, 0),),
    ),
    entry(
        "pasko_blend",
        "Blended union of two cylinders",
        "(0.16 - y^2 - z^2) + (0.16 - x^2 - z^2) + sqrt((0.16 - y^2 - z^2)^2 + (0.16 - x^2 - z^2)^2)"
        " + 0.1/(1 + (0.16 - y^2 - z^2)^2/0.04 + (0.16 - x^2 - z^2)^2/0.04)",
        None,
        Box((-1.25, -1.25, -0.75), (1.25, 1.25, 0.75)),
        f"{_PASKO}, section 4: blending union",
        symmetries=("mirror_x", "mirror_z", "swap_xy"),
    ),
    entry(
        "nishimura_metaballs",
        "Nishimura's metaballs",
        "let bump(r) = if(r < 1/3, 1 - 3*r^2, if(r < 1, 3/2*(1 - r)^2, 0));"
        " bump(length(x - 0.4, y, z)) + bump(length(x + 0.4, y, z)) + bump(length(x, y, z - 0.6)) - 0.45",
        None,
        Box((-1.125, -0.75, -0.75), (1.125, 0.75, 1.25)),
        "H. Nishimura et al., Object modeling by distribution function, 1985: piecewise quadratic",
        symmetries=("mirror_x", "mirror_y"),
    ),
    entry(
        "convolution_jack",
        "Convolution surface of three segments",
        # segments from -1 to 1 under the Cauchy kernel of width 1/4: h is the squared distance from the line
        "let part(t, p) = t/(2*p*(p + 16*t^2)) + atan2(4*t, sqrt(p))/(8*p*sqrt(p));"
        " let segment(t, h) = part(1 - t, 1 + 16*h) + part(1 + t, 1 + 16*h);"
        " segment(x, y^2 + z^2) + segment(y, z^2 + x^2) + segment(z, x^2 + y^2) - 0.2",
        None,
        Sphere(1.5),
        f"{_SHERSTYUK}: the Cauchy kernel along a segment",
        symmetries=FULL,
    ),
)
