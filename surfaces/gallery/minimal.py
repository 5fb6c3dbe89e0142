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
)
