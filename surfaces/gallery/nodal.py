"""Hold surfaces with many nodes, which are double points with a tangent cone."""

from __future__ import annotations

from surfaces.entries import FULL, entry
from surfaces.gallery.polynomials import chebyshev, folded, folded_nodes
from surfaces.model import Box, Sphere, Surface

TITLE = "Many nodes"
_CHMUTOV = "S. V. Chmutov, Examples of projective surfaces with many singularities, J. Alg. Geom. 1, 1992"
_FOLDED = f"{_CHMUTOV}; real nodes: S. Breske, O. Labs, D. van Straten, Real line arrangements, 2008"
_DELTOID = Box((-1.75, -2.875, -1.125), (3.25, 2.875, 1.125))
_ENDRASS = "S. Endraß, Surf's gallery of surfaces with many nodes, 2003"
_GOURSAT = "E. Goursat, Étude des surfaces qui admettent tous les plans de symétrie d'un polyèdre régulier, 1887"
_LABS = "O. Labs, A septic with 99 real nodes, 2006; with the real root of 7a^3 + 7a + 1 to 32 digits"

SURFACES: tuple[Surface, ...] = (
    entry(
        "togliatti",
        "Togliatti quintic",
        "64*(x - 1)*(x^4 - 4*x^3 - 10*x^2*y^2 - 4*x^2 + 16*x - 20*x*y^2 + 5*y^4 + 16 - 20*y^2) - 5*sqrt(5 - "
        "sqrt(5))*(2*z - sqrt(5 - sqrt(5)))*(4*(x^2 + y^2 - z^2) + 1 + 3*sqrt(5))^2",
        5,
        Sphere(6.0),
        _ENDRASS,
        symmetries=("mirror_y", "fifth_turn_z"),
        singular_points=31,
    ),
    entry(
        "endrass_minus",
        "Endraß octic, the other sign of sqrt(2)",
        "64*(x^2 - 1)*(y^2 - 1)*((x - y)^2 - 2)*((x + y)^2 - 2) - (-4*(1 - sqrt(2))*(x^2 + y^2)^2 + (8*(2 - "
        "sqrt(2))*z^2 + 4 - 14*sqrt(2))*(x^2 + y^2) - 16*z^4 + 8*(1 + 2*sqrt(2))*z^2 - 1 + 12*sqrt(2))^2",
        8,
        Sphere(4.0),
        _ENDRASS,
        symmetries=("mirror_x", "mirror_z", "swap_xy", "eighth_turn_z"),
    ),
    entry(
        "labs_septic",
        "Labs septic",
        "x^7 - 21*x^5*y^2 + 35*x^3*y^4 - 7*x*y^6 + 7*z*((x^2 + y^2)^3 - 8*z^2*(x^2 + y^2)^2 + 16*z^4*(x^2 + y^2))"
        " - 64*z^7 - (z + 51.942614594814650766502398132948)*((z + 1)*(x^2 + y^2)"
        " - 0.078528201496985215355479339329584*z^3 - 4.1583605922880170176286891821059*z^2"
        " - 4.1471434889655123257182185782115*z - 1.1881659380714787350787731342962)^2",
        7,
        Sphere(2.5),
        _LABS,
        symmetries=("mirror_y", "seventh_turn_z"),
        singular_within=(6.0, 92),  # of 99; the last seven are at r = 15.8
    ),
    entry(
        "goursat",
        "Goursat's surface with twelve nodes",
        "x^4 + y^4 + z^4 - (x^2 + y^2 + z^2) + 0.5",
        4,
        Sphere(1.5),
        _GOURSAT,
        symmetries=("mirror_x", "swap_xy", "cycle_xyz"),
        singular_points=12,
    ),
    entry(
        "kummer_nordstrand",
        "Kummer quartic, four nodes at infinity",
        "x^4 + y^4 + z^4 - x^2 - y^2 - z^2 - x^2*y^2 - y^2*z^2 - z^2*x^2 + 1",
        4,
        Sphere(2.5),
        "T. Nordstrand, Gallery of surfaces, University of Bergen; E. E. Kummer 1864",
        symmetries=FULL,
        singular_points=12,
    ),
    entry(
        "fresnel_wave",
        "Fresnel's wave surface",
        "(x^2 + y^2 + z^2)*(4*x^2 + 9/4*y^2 + z^2) - 4*(9/4 + 1)*x^2 - 9/4*(4 + 1)*y^2 - (4 + 9/4)*z^2 + 9",
        4,
        Sphere(2.25),
        "A. Fresnel 1821; G. Salmon, Analytic Geometry of Three Dimensions, 1862: semi-axes 2, 3/2 and 1",
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
        points=((1, 0, 0), (1.5, 0, 0), (0, 1, 0), (0, 2, 0), (0, 0, 1.5), (0, 0, 2)),
        singular_points=4,
    ),
    entry(
        "desmic",
        "Desmic quartic",
        "(y^2 - z^2)*(x^2 - 1) - (z^2 - x^2)*(y^2 - 1)",
        4,
        Sphere(3.0),
        "G. Humbert, Sur la surface desmique du quatrième ordre, 1891",
        symmetries=("mirror_x", "mirror_z", "swap_xy"),
        singular_points=9,  # and three at infinity
    ),
    entry(
        "chmutov_sextic_nodal",
        "Chebyshev sextic with nodes",
        f"{chebyshev(6, 'x')} + {chebyshev(6, 'y')} + {chebyshev(6, 'z')} + 1",
        6,
        Box((-1.125, -1.125, -1.125), (1.125, 1.125, 1.125)),
        _CHMUTOV,
        symmetries=FULL,
        singular_points=54,
    ),
    entry(
        "chmutov_octic_nodal",
        "Chebyshev octic with nodes",
        f"{chebyshev(8, 'x')} + {chebyshev(8, 'y')} + {chebyshev(8, 'z')} + 1",
        8,
        Box((-1.125, -1.125, -1.125), (1.125, 1.125, 1.125)),
        _CHMUTOV,
        symmetries=FULL,
        singular_points=144,
    ),
    entry(
        "folded_sextic",
        "Chmutov's sextic of A2",
        folded(6),
        6,
        _DELTOID,
        _FOLDED,
        symmetries=("third_turn_z", "mirror_y", "mirror_z"),
        singular_points=folded_nodes(6),
    ),
    entry(
        "folded_octic",
        "Chmutov's octic of A2",
        folded(8),
        8,
        _DELTOID,
        _FOLDED,
        symmetries=("mirror_y", "mirror_z"),
        singular_points=folded_nodes(8),
    ),
)
