"""Hold the catalog's surfaces with parameters: each family makes a surface of exact decimals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import sqrt

from surfaces.entries import REVOLVED, ROUND, entry
from surfaces.formula import exact
from surfaces.model import Box, FirsthitError, Sphere, Surface


def _sphere(name: str, title: str, values: Mapping[str, str]) -> Surface:
    """Make a sphere in a ball half as large again."""
    radius = _positive(name, values, "R")
    return entry(
        name,
        title,
        "x^2 + y^2 + z^2 - R^2",
        2,
        Sphere(1.5 * radius),
        "szente, Table 3; beamcasting, Fig. 2",
        values,
        distance="sqrt(x^2 + y^2 + z^2) - R",
        bounding_radius=radius,
        feature_radius=radius,
        singular_points=0,
        symmetries=ROUND,
        points=((radius, 0, 0),),
    )


def _torus(name: str, title: str, values: Mapping[str, str]) -> Surface:
    """Make a torus in toledo2007's tight box, [-(R+r), R+r]^2 x [-r, r]."""
    ring, tube = _positive(name, values, "R"), _positive(name, values, "r")
    outer = float(exact(values["R"]) + exact(values["r"]))
    return entry(
        name,
        title,
        "(x^2 + y^2 + z^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)",
        4,
        Box((-outer, -outer, -tube), (outer, outer, tube)),
        "toledo2007, section 4; szente, Table 3"
        if name == "torus"
        else "degenerate torus; after toledo2007, section 4",
        values,
        distance="sqrt((sqrt(x^2 + y^2) - R)^2 + z^2) - r" if tube <= ring else None,
        bounding_radius=outer,
        feature_radius=tube,
        singular_points=0 if tube < ring else 1 if tube == ring else 2,
        symmetries=REVOLVED,
        points=((outer, 0, 0), (0, ring - tube, 0), (ring, 0, tube)),
    )


def _kummer(name: str, title: str, values: Mapping[str, str]) -> Surface:
    """Make a Kummer quartic, whose four planes are those of a tetrahedron. It has 16 real nodes.

    Raises FirsthitError unless 1/3 < mu2 < 3 and mu2 is not 1.
    """
    square = exact(values["mu2"])
    if not Fraction(1, 3) < square < 3 or square == 1:
        raise FirsthitError(f"{name}: mu2 must be between 1/3 and 3 and not 1, not {values['mu2']}")
    planes = "(1 - z - sqrt2*x)*(1 - z + sqrt2*x)*(1 + z + sqrt2*y)*(1 + z - sqrt2*y)"
    return entry(
        name,
        title,
        f"(x^2 + y^2 + z^2 - mu2)^2 - (3*mu2 - 1)/(3 - mu2)*{planes}",
        4,
        Sphere(3.5),
        "E. E. Kummer 1864; this pencil: R. W. H. T. Hudson, Kummer's Quartic Surface, 1905",
        values,
        singular_points=16,
        symmetries=("mirror_x", "mirror_y", "quarter_roto_reflection_z"),
    )


def _two_spheres(name: str, title: str, values: Mapping[str, str]) -> Surface:
    """Make two concentric spheres with the radii 1 and sqrt(1 + gap)."""
    _positive(name, values, "gap")
    return entry(
        name,
        title,
        "(x^2 + y^2 + z^2 - 1)*(x^2 + y^2 + z^2 - 1 - gap)",
        4,
        Sphere(1.5),
        "firsthit: clustered roots",
        values,
        bounding_radius=sqrt(1.0 + float(exact(values["gap"]))),
        singular_points=0,
        symmetries=ROUND,
        points=((0, 1, 0),),
    )


def _positive(name: str, values: Mapping[str, str], key: str) -> float:
    """Return a parameter as a float. Raises FirsthitError unless it is positive."""
    value = float(exact(values[key]))
    if value <= 0.0:
        raise FirsthitError(f"{name}: {key} must be positive, not {values[key]}")
    return value


Family = Callable[[str, str, Mapping[str, str]], Surface]
# name: (title, maker, default parameters)
FAMILIES: dict[str, tuple[str, Family, dict[str, str]]] = {
    "sphere": ("Sphere", _sphere, {"R": "1"}),
    "torus": ("Torus", _torus, {"R": "0.7", "r": "0.3"}),
    "horn_torus": ("Horn torus", _torus, {"R": "0.5", "r": "0.5"}),
    "spindle_torus": ("Spindle torus", _torus, {"R": "0.35", "r": "0.65"}),
    "thin_torus_1000": ("Thin torus, R/r = 1000", _torus, {"R": "1", "r": "0.001"}),
    "thin_torus_10000": ("Thin torus, R/r = 10000", _torus, {"R": "1", "r": "0.0001"}),
    "kummer": ("Kummer quartic", _kummer, {"mu2": "1.69"}),
    "two_spheres": ("Two nearly coincident spheres", _two_spheres, {"gap": "0.0001"}),
}
