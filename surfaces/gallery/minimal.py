"""Hold minimal surfaces, and level sets of few trigonometric terms that are near triply periodic ones."""

from __future__ import annotations

from surfaces.entries import FULL, entry
from surfaces.model import Sphere, Surface

TITLE = "Minimal surfaces, and level sets near periodic ones"
_MATHWORLD = "E. W. Weisstein, MathWorld: Algebraic Surface, and the surface's own page"
_NODAL = "H. G. von Schnering, R. Nesper, Nodal surfaces of Fourier series, Z. Phys. B 83, 1991"
_SCHOEN = "A. H. Schoen, Infinite periodic minimal surfaces without self-intersections, 1970"
_SCHERK = "H. F. Scherk, Bemerkungen über die kleinste Fläche innerhalb gegebener Grenzen, 1835"

SURFACES: tuple[Surface, ...] = (
    entry(
        "enneper",
        "Enneper's minimal surface",
        "64*z^9 - 128*z^7 + 64*z^5 - 702*x^2*y^2*z^3 - 18*x^2*y^2*z + 144*(y^2*z^6 - x^2*z^6) + 162*(y^4*z^2 "
        "- x^4*z^2) + 27*(y^6 - x^6) + 9*(x^4*z + y^4*z) + 48*(x^2*z^3 + y^2*z^3) - 432*(x^2*z^5 + y^2*z^5) + "
        "81*(x^4*y^2 - x^2*y^4) + 240*(y^2*z^4 - x^2*z^4) - 135*(x^4*z^3 + y^4*z^3)",
        9,
        Sphere(2.0),
        _MATHWORLD,
        symmetries=("mirror_x", "mirror_y"),
        singular_at=((0, 0, 0), (-0.5, -0.5, 0), (-0.5, 0.5, 0)),
        points=((-2, 0, 3), (0, -2, -3)),
    ),
    entry(
        "gyroid",
        "Gyroid",
        "cos(x)*sin(y) + cos(y)*sin(z) + cos(z)*sin(x)",
        None,
        Sphere(5.0),
        f"{_NODAL}; {_SCHOEN}",
        symmetries=("cycle_xyz",),
        singular_points=0,
    ),
    entry(
        "schwarz_p",
        "Schwarz P",
        "cos(x) + cos(y) + cos(z)",
        None,
        Sphere(5.0),
        f"{_NODAL}; {_SCHOEN}",
        symmetries=("mirror_x", "swap_xy", "cycle_xyz"),
        singular_points=0,
    ),
    entry(
        "scherk",
        "Scherk's first surface",
        "exp(z)*cos(x) - cos(y)",
        None,
        Sphere(4.0),
        _SCHERK,
        symmetries=("mirror_x", "mirror_y"),
        points=((-0.5, -0.5, 0), (-0.5, 0.5, 0)),
        singular_points=0,
    ),
    entry(
        "schwarz_d",
        "Schwarz D",
        "cos(x)*cos(y)*cos(z) - sin(x)*sin(y)*sin(z)",
        None,
        Sphere(5.0),
        f"{_NODAL}; H. A. Schwarz 1865",
        symmetries=("half_turn_x", "swap_xy", "cycle_xyz"),
        singular_points=0,
    ),
    entry(
        "neovius",
        "Neovius' surface",
        "3*(cos(x) + cos(y) + cos(z)) + 4*cos(x)*cos(y)*cos(z)",
        None,
        Sphere(5.0),
        f"{_NODAL}; E. R. Neovius 1883",
        symmetries=FULL,
        singular_points=0,
    ),
    entry(
        "lidinoid",
        "Lidinoid",
        "sin(2*x)*cos(y)*sin(z) + sin(2*y)*cos(z)*sin(x) + sin(2*z)*cos(x)*sin(y)"
        " - cos(2*x)*cos(2*y) - cos(2*y)*cos(2*z) - cos(2*z)*cos(2*x) + 0.3",
        None,
        Sphere(4.0),
        "S. Lidin, S. Larsson, Bonnet transformation of infinite periodic minimal surfaces, 1990; level set: Wikipedia",
        symmetries=("cycle_xyz",),
        singular_points=0,
    ),
    entry(
        "schoen_iwp",
        "Schoen's I-WP",
        "2*(cos(x)*cos(y) + cos(y)*cos(z) + cos(z)*cos(x)) - cos(2*x) - cos(2*y) - cos(2*z)",
        None,
        Sphere(5.0),
        f"{_NODAL}; {_SCHOEN}",
        symmetries=FULL,
    ),
    entry(
        "schoen_frd",
        "Schoen's F-RD",
        "4*cos(x)*cos(y)*cos(z) - cos(2*x)*cos(2*y) - cos(2*y)*cos(2*z) - cos(2*z)*cos(2*x)",
        None,
        Sphere(4.0),
        f"{_NODAL}; {_SCHOEN}",
        symmetries=FULL,
    ),
    entry(
        "fischer_koch_s",
        "Fischer and Koch's S",
        "cos(2*x)*sin(y)*cos(z) + cos(x)*cos(2*y)*sin(z) + sin(x)*cos(y)*cos(2*z)",
        None,
        Sphere(4.0),
        f"{_NODAL}; W. Fischer, E. Koch, Z. Kristallogr. 179, 1987",
        symmetries=("cycle_xyz",),
    ),
    entry(
        "double_gyroid",
        "Double gyroid",
        "0.6 - abs(cos(x)*sin(y) + cos(y)*sin(z) + cos(z)*sin(x))",
        None,
        Sphere(5.0),
        f"{_NODAL}: two level sets; {_SCHOEN}",
        symmetries=("cycle_xyz",),
    ),
    entry(
        "scherk_tower",
        "Scherk's second surface",
        "4*sin(z) - (exp(x) - exp(-x))*(exp(y) - exp(-y))",
        None,
        Sphere(4.0),
        f"{_SCHERK}: sin z = sinh x sinh y",
        symmetries=("half_turn_z", "swap_xy"),
        points=((0, 0, 0), (1, 0, 0), (0, 2, 0)),
        singular_points=0,
    ),
    entry(
        "catenoid",
        "Catenoid",
        "x^2 + y^2 - (exp(z) + exp(-z))^2/4",
        None,
        Sphere(3.0),
        "L. Euler, Methodus inveniendi lineas curvas, 1744",
        symmetries=("rotate_z_5", "mirror_x", "mirror_z"),
        points=((1, 0, 0),),
        singular_points=0,
    ),
    entry(
        "helicoid",
        "Helicoid",
        "x*sin(2*z) - y*cos(2*z)",
        None,
        Sphere(2.5),
        "J. B. Meusnier, Mémoire sur la courbure des surfaces, 1785",
        symmetries=("half_turn_y",),
        points=((1, 0, 0), (0, 0, 1)),
        singular_points=0,
    ),
    entry(
        "henneberg",
        "Henneberg's surface",
        # eliminated from x = 2 sinh u cos v - 2/3 sinh 3u cos 3v, y = 2 sinh u sin v + 2/3 sinh 3u sin 3v,
        # z = 2 cosh 2u cos 2v: the one polynomial of degree 15, even in x and y, that vanishes at all such points
        "-294912*y^2*z^4 + 147456*y^2*z^5 + 221184*y^2*z^6 - 110592*y^2*z^7 - 55296*y^2*z^8 + 27648*y^2*z^9 + "
        "4608*y^2*z^10 - 2304*y^2*z^11 - 196608*y^4*z^2 + 49152*y^4*z^3 - 86016*y^4*z^4 + 651264*y^4*z^5 - "
        "595968*y^4*z^6 + 162816*y^4*z^7 - 5376*y^4*z^8 + 768*y^4*z^9 - 768*y^4*z^10 - 32768*y^6 - 138240*y^6*z^2 "
        "+ 416256*y^6*z^3 - 179712*y^6*z^4 - 89856*y^6*z^5 + 52032*y^6*z^6 - 4320*y^6*z^7 - 64*y^6*z^9 - 27648*y^8 "
        "+ 62208*y^8*z + 31104*y^8*z^2 - 69120*y^8*z^3 + 7776*y^8*z^4 + 3888*y^8*z^5 - 432*y^8*z^6 + 9720*y^10 - "
        "8748*y^10*z - 4374*y^10*z^2 + 1215*y^10*z^3 - 729*y^12 + 294912*x^2*z^4 + 147456*x^2*z^5 - 221184*x^2*z^6 "
        "- 110592*x^2*z^7 + 55296*x^2*z^8 + 27648*x^2*z^9 - 4608*x^2*z^10 - 2304*x^2*z^11 + 294912*x^2*y^2*z^3 - "
        "1105920*x^2*y^2*z^5 + 276480*x^2*y^2*z^7 - 4608*x^2*y^2*z^9 + 98304*x^2*y^4 - 248832*x^2*y^4*z^2 - "
        "84480*x^2*y^4*z^3 - 1147392*x^2*y^4*z^4 + 573696*x^2*y^4*z^5 + 10560*x^2*y^4*z^6 + 7776*x^2*y^4*z^7 - "
        "192*x^2*y^4*z^9 + 55296*x^2*y^6 - 248832*x^2*y^6*z - 248832*x^2*y^6*z^2 + 62208*x^2*y^6*z^4 + "
        "15552*x^2*y^6*z^5 - 864*x^2*y^6*z^6 - 79704*x^2*y^8 + 26244*x^2*y^8*z - 13122*x^2*y^8*z^2 + "
        "9963*x^2*y^8*z^3 + 196608*x^4*z^2 + 49152*x^4*z^3 + 86016*x^4*z^4 + 651264*x^4*z^5 + 595968*x^4*z^6 + "
        "162816*x^4*z^7 + 5376*x^4*z^8 + 768*x^4*z^9 + 768*x^4*z^10 - 98304*x^4*y^2 + 248832*x^4*y^2*z^2 - "
        "84480*x^4*y^2*z^3 + 1147392*x^4*y^2*z^4 + 573696*x^4*y^2*z^5 - 10560*x^4*y^2*z^6 + 7776*x^4*y^2*z^7 - "
        "192*x^4*y^2*z^9 + 373248*x^4*y^4*z + 511488*x^4*y^4*z^3 + 23328*x^4*y^4*z^5 + 190512*x^4*y^6 - "
        "17496*x^4*y^6*z - 8748*x^4*y^6*z^2 + 23814*x^4*y^6*z^3 + 2187*x^4*y^8 + 32768*x^6 + 138240*x^6*z^2 + "
        "416256*x^6*z^3 + 179712*x^6*z^4 - 89856*x^6*z^5 - 52032*x^6*z^6 - 4320*x^6*z^7 - 64*x^6*z^9 - "
        "55296*x^6*y^2 - 248832*x^6*y^2*z + 248832*x^6*y^2*z^2 - 62208*x^6*y^2*z^4 + 15552*x^6*y^2*z^5 + "
        "864*x^6*y^2*z^6 - 190512*x^6*y^4 - 17496*x^6*y^4*z + 8748*x^6*y^4*z^2 + 23814*x^6*y^4*z^3 + 27648*x^8 + "
        "62208*x^8*z - 31104*x^8*z^2 - 69120*x^8*z^3 - 7776*x^8*z^4 + 3888*x^8*z^5 + 432*x^8*z^6 + 79704*x^8*y^2 + "
        "26244*x^8*y^2*z + 13122*x^8*y^2*z^2 + 9963*x^8*y^2*z^3 - 2187*x^8*y^4 - 9720*x^10 - 8748*x^10*z + "
        "4374*x^10*z^2 + 1215*x^10*z^3 + 729*x^12",
        15,
        Sphere(5.0),
        "L. Henneberg 1875; E. W. Weisstein, MathWorld: Henneberg's Minimal Surface (parametrisation; degree 15)",
        symmetries=("mirror_x", "mirror_y"),
        singular_along=((0, 0, 1),),
        points=((-1.125, 0, 4.25), (0, -1.125, -4.25), (3.357, 2.124, -1.19)),
    ),
)
