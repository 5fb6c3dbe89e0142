"""The catalog: the surfaces of the papers, and singular ones that are hard.

A wrong transcription renders plausibly, so everything stated in `facts` is recomputed by tests/test_catalog.py:

    singular_points   how many real points have f = 0 and grad f = 0, all of them isolated
    singular_along    directions (a, b, c): f and grad f vanish along the line through the origin
    singular_at       some points where f and grad f vanish, of a whole curve of them
    symmetries        names of SYMMETRIES that leave f as it is
    points            points that lie on the surface

Domains: spheres, as in szente, of a radius that shows all singular points; the box of the paper for toledo2007's torus
and cubics; boxes where a sphere would show mostly tentacles.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import sqrt
from typing import Any

from harness.contract import Box, Domain, FirsthitError, Sphere, Surface
from surfaces.formula import exact

PHI = (1.0 + sqrt(5.0)) / 2.0
_HALF_ROOT_3 = sqrt(3.0) / 2.0
Matrix = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]
SYMMETRIES: dict[str, Matrix] = {
    "mirror_x": ((-1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "mirror_y": ((1, 0, 0), (0, -1, 0), (0, 0, 1)),
    "mirror_z": ((1, 0, 0), (0, 1, 0), (0, 0, -1)),
    "half_turn_x": ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
    "half_turn_y": ((-1, 0, 0), (0, 1, 0), (0, 0, -1)),
    "swap_xy": ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "swap_yz": ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    "cycle_xyz": ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
    "quarter_roto_reflection_z": ((0, 1, 0), (-1, 0, 0), (0, 0, -1)),
    "rotate_z_5": ((3 / 5, -4 / 5, 0), (4 / 5, 3 / 5, 0), (0, 0, 1)),  # by atan(4/3), of infinite order
    "rotate_x_5": ((1, 0, 0), (0, 3 / 5, -4 / 5), (0, 4 / 5, 3 / 5)),
    "rotate_y_5": ((3 / 5, 0, 4 / 5), (0, 1, 0), (-4 / 5, 0, 3 / 5)),
    "third_turn_z": ((-0.5, -_HALF_ROOT_3, 0), (_HALF_ROOT_3, -0.5, 0), (0, 0, 1)),
    "eighth_turn_z": ((sqrt(0.5), -sqrt(0.5), 0), (sqrt(0.5), sqrt(0.5), 0), (0, 0, 1)),
    # the fifth turn about (phi, 1, 0), a vertex of the icosahedron
    "icosahedral_turn": (
        (0.5 * PHI, 0.5 / PHI, 0.5),
        (0.5 / PHI, 0.5, -0.5 * PHI),
        (-0.5, 0.5 * PHI, 0.5 / PHI),
    ),
}
_FULL = ("mirror_x", "swap_xy", "cycle_xyz")
_ROUND = ("rotate_z_5", "rotate_x_5", "mirror_z")
_REVOLVED = ("rotate_z_5", "mirror_x", "mirror_z")


def _surface(
    name: str,
    title: str,
    formula: str,
    degree: int | None,
    domain: Domain,
    source: str,
    parameters: Mapping[str, str] | None = None,
    distance: str | None = None,
    bounding_radius: float | None = None,
    feature_radius: float | None = None,
    **facts: Any,
) -> Surface:
    return Surface(
        name=name,
        title=title,
        formula=formula,
        domain=domain,
        source=source,
        degree=degree,
        parameters=tuple((parameters or {}).items()),
        distance=distance,
        bounding_radius=bounding_radius,
        feature_radius=feature_radius,
        facts=tuple(facts.items()),
    )


def _sphere(name: str, title: str, values: Mapping[str, str]) -> Surface:
    radius = _positive(name, values, "R")
    return _surface(
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
        symmetries=_ROUND,
        points=((radius, 0, 0),),
    )


def _torus(name: str, title: str, values: Mapping[str, str]) -> Surface:
    """In toledo2007's tight box, [-(R+r), R+r]^2 x [-r, r]."""
    ring, tube = _positive(name, values, "R"), _positive(name, values, "r")
    outer = float(exact(values["R"]) + exact(values["r"]))
    return _surface(
        name,
        title,
        "(x^2 + y^2 + z^2 + R^2 - r^2)^2 - 4*R^2*(x^2 + y^2)",
        4,
        Box((-outer, -outer, -tube), (outer, outer, tube)),
        "toledo2007, section 4; szente, Table 3" if name == "torus" else "degenerate torus; after toledo2007, section 4",
        values,
        distance="sqrt((sqrt(x^2 + y^2) - R)^2 + z^2) - r" if tube <= ring else None,
        bounding_radius=outer,
        feature_radius=tube,
        singular_points=0 if tube < ring else 1 if tube == ring else 2,
        symmetries=_REVOLVED,
        points=((outer, 0, 0), (0, ring - tube, 0), (ring, 0, tube)),
    )


def _kummer(name: str, title: str, values: Mapping[str, str]) -> Surface:
    """16 real nodes for 1/3 < mu2 < 3, mu2 != 1; p, q, r, s are the planes of a tetrahedron."""
    square = exact(values["mu2"])
    if not Fraction(1, 3) < square < 3 or square == 1:
        raise FirsthitError(f"{name}: mu2 must be between 1/3 and 3 and not 1, not {values['mu2']}")
    planes = "(1 - z - sqrt2*x)*(1 - z + sqrt2*x)*(1 + z + sqrt2*y)*(1 + z - sqrt2*y)"
    return _surface(
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
    """Radii 1 and sqrt(1 + gap)."""
    _positive(name, values, "gap")
    return _surface(
        name,
        title,
        "(x^2 + y^2 + z^2 - 1)*(x^2 + y^2 + z^2 - 1 - gap)",
        4,
        Sphere(1.5),
        "firsthit: clustered roots",
        values,
        bounding_radius=sqrt(1.0 + float(exact(values["gap"]))),
        singular_points=0,
        symmetries=_ROUND,
        points=((0, 1, 0),),
    )


def _positive(name: str, values: Mapping[str, str], key: str) -> float:
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

_CUBE = Box((-1, -1, -1), (1, 1, 1))  # toledo2007, Fig. 2: "clipped outside the domain [-1, 1]^3"
_HAUSER = "H. Hauser, The Hironaka theorem on resolution of singularities, 2003 (gallery)"

FIXED: tuple[Surface, ...] = (
    _surface(
        "clebsch",
        "Clebsch diagonal cubic",
        "81*(x^3 + y^3 + z^3) - 189*(x^2*(y + z) + y^2*(x + z) + z^2*(x + y)) + 54*x*y*z + 126*(x*y + x*z + y*z)"
        " - 9*(x^2 + y^2 + z^2) - 9*(x + y + z) + 1",
        3,
        _CUBE,
        "A. Clebsch 1871; toledo2007, Fig. 2 (cubics)",
        singular_points=0,
        symmetries=("swap_xy", "cycle_xyz"),
    ),
    _surface(
        "cayley",
        "Cayley nodal cubic",
        "4*(x^2 + y^2 + z^2) + 16*x*y*z - 1",
        3,
        _CUBE,
        "A. Cayley 1869; toledo2007, Fig. 2 (cubics)",
        singular_points=4,
        symmetries=("half_turn_x", "swap_xy", "cycle_xyz"),
    ),
    _surface(
        "monkey_saddle",
        "Monkey saddle",
        "x^3 - 3*x*y^2 - z",
        3,
        _CUBE,
        "D. Hilbert, S. Cohn-Vossen 1932; toledo2007, Fig. 2 (cubics)",
        singular_points=0,
        symmetries=("third_turn_z", "mirror_y"),
        points=((1, 0, 1),),
    ),
    _surface(
        "ding_dong",
        "Ding-Dong",
        "x^2 + y^2 + z^3 - z^2",
        3,
        Box((-1, -1, -1), (1, 1, 1)),
        f"{_HAUSER}; toledo2007, Fig. 2 (cubics)",
        singular_points=1,
        symmetries=("rotate_z_5", "mirror_x"),
        points=((0, 0, 1),),
    ),
    _surface(
        "whitney_umbrella",
        "Whitney umbrella",
        "x^2 - y^2*z",
        3,
        _CUBE,
        "H. Whitney 1943; a cubic beside toledo2007, Fig. 2",
        singular_along=((0, 0, 1),),
        symmetries=("mirror_x", "mirror_y"),
        points=((1, 1, 1),),
    ),
    _surface(
        "cartan_umbrella",
        "Cartan umbrella",
        "z*(x^2 + y^2) - x^3",
        3,
        _CUBE,
        "H. Cartan 1957; a cubic beside toledo2007, Fig. 2",
        singular_along=((0, 0, 1),),
        symmetries=("mirror_y",),
        points=((1, 0, 1),),
    ),
    _surface(
        "flirt",
        "Flirt",
        "x^2 - x^3 + y^2 + y^4 + z^3 - 10*z^4",
        4,
        Sphere(1.0),
        "szente, Table 3",
        symmetries=("mirror_y",),
        singular_points=1,
    ),
    _surface(
        "calyx",
        "Calyx",
        "x^2 + y^2*z^3 - z^4",
        5,
        Sphere(1.0),
        f"szente, Table 3; {_HAUSER}",
        singular_along=((0, 1, 0),),
        symmetries=("mirror_x", "mirror_y"),
        points=((0, 1, 1),),
    ),
    _surface(
        "barth_sextic",
        "Barth sextic",
        "4*(phi^2*x^2 - y^2)*(phi^2*y^2 - z^2)*(phi^2*z^2 - x^2) - (1 + 2*phi)*(x^2 + y^2 + z^2 - 1)^2",
        6,
        Sphere(2.0),
        "W. Barth 1996; szente, Table 3; beamcasting, Fig. 2",
        singular_points=50,
        symmetries=("mirror_x", "cycle_xyz", "icosahedral_turn"),
    ),
    _surface(
        "endrass_octic",
        "Endraß octic",
        "64*(x^2 - 1)*(y^2 - 1)*((x - y)^2 - 2)*((x + y)^2 - 2)"
        " - (-4*(1 + sqrt2)*(x^2 + y^2)^2 + (8*(2 + sqrt2)*z^2 + 4 + 14*sqrt2)*(x^2 + y^2)"
        " - 16*z^4 + 8*(1 - 2*sqrt2)*z^2 - 1 - 12*sqrt2)^2",
        8,
        Sphere(4.0),
        "S. Endraß 1997; szente, Table 3",
        singular_points=144,
        symmetries=("mirror_x", "mirror_z", "eighth_turn_z"),
    ),
    _surface(
        "barth_decic",
        "Barth decic",
        "8*(x^2 - phi^4*y^2)*(y^2 - phi^4*z^2)*(z^2 - phi^4*x^2)"
        "*(x^4 + y^4 + z^4 - 2*x^2*y^2 - 2*y^2*z^2 - 2*z^2*x^2)"
        " + (3 + 5*phi)*(x^2 + y^2 + z^2 - 1)^2*(x^2 + y^2 + z^2 - 2 + phi)^2",
        10,
        Sphere(2.0),
        "W. Barth 1996; szente, Table 3",
        singular_points=300,
        symmetries=("mirror_x", "cycle_xyz", "icosahedral_turn"),
    ),
    _surface(
        "sixteen_ball",
        "16-ball",
        "x^16 + y^16 + z^16 - 1",
        16,
        Sphere(1.75),
        "szente, Table 3; its corners are 3^(7/16) = 1.62 from the centre",
        bounding_radius=1.62,
        singular_points=0,
        symmetries=_FULL,
        points=((0, 0, 1),),
    ),
    _surface(
        "dingdong_beamcasting",
        "Dingdong (beamcasting)",
        "x^2 + y^2 - z*(1 - z^2)",
        3,
        Box((-1, -1, -1.25), (1, 1, 1.25)),
        "beamcasting, Fig. 2, as printed: smooth, unlike Hauser's Ding-Dong",
        singular_points=0,
        symmetries=("rotate_z_5", "mirror_x"),
        points=((0, 0, 1), (0, 0, -1)),
    ),
    _surface(
        "klein",
        "Klein bottle",
        "(x^2 + y^2 + z^2 + 2*y - 1)*((x^2 + y^2 + z^2 - 2*y - 1)^2 - 8*z^2)"
        " + 16*x*z*(x^2 + y^2 + z^2 - 2*y - 1)",
        6,
        Sphere(4.5),
        "I. Stewart; beamcasting, Fig. 2",
        singular_at=((sqrt(2.0), 1, 0), (0, 1 + sqrt(2.0), 0), (0, 1 - sqrt(2.0), 0)),
        symmetries=("half_turn_y",),
    ),
    _surface(
        "mitchell",
        "Mitchell",
        "4*(x^4 + (y^2 + z^2)^2 + 17*x^2*(y^2 + z^2)) - 20*(x^2 + y^2 + z^2) + 17",
        4,
        Sphere(2.5),
        "D. P. Mitchell 1990; beamcasting, Fig. 2",
        singular_points=0,
        symmetries=("rotate_x_5", "mirror_x", "mirror_y"),
    ),
    _surface(
        "octdong",
        "Octdong",
        "x^2 + y^2 + z^4 - z^2",
        4,
        Sphere(1.25),
        "beamcasting, Fig. 2",
        singular_points=1,
        symmetries=_REVOLVED,
        points=((0, 0, 1),),
    ),
    _surface(
        "steiner",
        "Steiner's Roman surface",
        "x^2*y^2 + y^2*z^2 + x^2*z^2 + x*y*z",
        4,
        Sphere(1.0),
        "J. Steiner 1844; beamcasting, Fig. 2",
        singular_along=((1, 0, 0), (0, 1, 0), (0, 0, 1)),
        symmetries=("half_turn_x", "swap_xy", "cycle_xyz"),
    ),
    _surface(
        "tangle",
        "Tangle",
        "x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8",
        4,
        Sphere(4.0),
        "beamcasting, Fig. 2",
        singular_points=0,
        symmetries=_FULL,
    ),
    _surface(
        "teardrop",
        "Teardrop",
        "0.5*x^5 + 0.5*x^4 - y^2 - z^2",
        5,
        Box((-1.25, -0.75, -0.75), (0.75, 0.75, 0.75)),
        "beamcasting, Fig. 2",
        singular_points=1,
        symmetries=("rotate_x_5", "mirror_y"),
        points=((-1, 0, 0),),
    ),
    _surface(
        "heart",
        "Heart",
        "(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3",
        6,
        Sphere(1.5),
        "G. Taubin 1993; beamcasting, Fig. 2",
        singular_at=((1, 0, 0), (0, 2 / 3, 0)),
        symmetries=("mirror_x", "mirror_y"),
    ),
    _surface(
        "chmutov",
        "Chmutov septic",
        "64*x^7 - 112*x^5 + 56*x^3 - 7*x + 64*y^7 - 112*y^5 + 56*y^3 - 7*y + 64*z^7 - 112*z^5 + 56*z^3 - 7*z + 1",
        7,
        _CUBE,
        "S. V. Chmutov 1992; beamcasting, Fig. 2: Chebyshev polynomials T7(x) + T7(y) + T7(z) + 1",
        singular_points=81,
        symmetries=("swap_xy", "cycle_xyz"),
    ),
    _surface(
        "blinn_blob",
        "Blinn blob",
        "exp(1 - 4*(x^2 + y^2 + z^2)) + exp(1 - 8*((x - 1)^2 + y^2 + z^2)) + exp(1 - 8*(x^2 + (y - 1)^2 + z^2))"
        " + exp(1 - 16*(x^2 + y^2 + (z - 0.5)^2)) - 1",
        None,
        Box((-0.75, -0.75, -0.75), (1.5, 1.5, 1.0)),
        "J. F. Blinn 1982; beamcasting, Fig. 2 (b = e, drawn into the exponents)",
        symmetries=("swap_xy",),
    ),
    _surface(
        "distel",
        "Distel",
        "x^2 + y^2 + z^2 + 1000*(x^2 + y^2)*(x^2 + z^2)*(y^2 + z^2) - 1",
        6,
        Sphere(1.25),
        _HAUSER,
        bounding_radius=1.0,
        singular_points=0,
        symmetries=_FULL,
        points=((1, 0, 0), (0, 0, -1)),
    ),
    _surface(
        "zitrus",
        "Zitrus",
        "x^2 + z^2 - y^3*(1 - y)^3",
        6,
        Box((-0.25, -0.125, -0.25), (0.25, 1.125, 0.25)),
        _HAUSER,
        singular_points=2,
        symmetries=("rotate_y_5", "mirror_x"),
        points=((0, 0, 0), (0, 1, 0)),
    ),
    _surface(
        "limao",
        "Limão",
        "x^2 - y^3*z^3",
        6,
        Sphere(1.0),
        _HAUSER,
        singular_along=((0, 1, 0), (0, 0, 1)),
        symmetries=("mirror_x", "swap_yz"),
        points=((1, 1, 1),),
    ),
    _surface(
        "himmel",
        "Himmel und Hölle",
        "x^2 - y^2*z^2",
        4,
        Sphere(1.0),
        _HAUSER,
        singular_along=((0, 1, 0), (0, 0, 1)),
        symmetries=("mirror_x", "mirror_y", "swap_yz"),
        points=((1, 1, 1),),
    ),
    _surface(
        "kolibri",
        "Kolibri",
        "x^3 + x^2*z^2 - y^2",
        4,
        Sphere(1.0),
        _HAUSER,
        singular_along=((0, 0, 1),),
        symmetries=("mirror_y", "mirror_z"),
    ),
    _surface(
        "plane_squared",
        "Plane, squared",
        "(x + 2*y + 2*z)^2",
        2,
        Sphere(1.0),
        "firsthit: met without crossing",
        singular_along=((2, -1, 0), (0, 1, -1)),
        symmetries=("swap_yz",),
    ),
)
