"""Hold polynomials of degree 8 to 20."""

from __future__ import annotations

from surfaces.entries import FULL, entry
from surfaces.gallery.polynomials import chebyshev, doubled, folded, folded_nodes
from surfaces.model import Box, Sphere, Surface

TITLE = "High degree, up to 20"
_FOLDED = (
    "S. V. Chmutov, Examples of projective surfaces with many singularities, J. Alg. Geom. 1, 1992;"
    " real nodes: S. Breske, O. Labs, D. van Straten, Real line arrangements, 2008"
)
_CUBE = Box((-1.0625, -1.0625, -1.0625), (1.0625, 1.0625, 1.0625))
_DELTOID = Box((-1.75, -2.875, -1.125), (3.25, 2.875, 1.125))
_CHMUTOV = (
    "T. F. Banchoff, Computer graphics tools for rendering algebraic surfaces, 1991: sums of Chebyshev polynomials"
)
_NORDSTRAND = "T. Nordstrand, Gallery of surfaces, University of Bergen"

SURFACES: tuple[Surface, ...] = (
    entry(
        "chmutov_octic",
        "Banchoff–Chmutov octic",
        f"{chebyshev(8, 'x')} + {chebyshev(8, 'y')} + {chebyshev(8, 'z')}",
        8,
        Sphere(1.7),
        _CHMUTOV,
        symmetries=FULL,
        singular_points=0,
    ),
    entry(
        "chmutov_12",
        "Banchoff–Chmutov of degree 12",
        f"{chebyshev(12, 'x')} + {chebyshev(12, 'y')} + {chebyshev(12, 'z')}",
        12,
        Sphere(1.7),
        _CHMUTOV,
        symmetries=FULL,
        singular_points=0,
    ),
    entry(
        "chmutov_16",
        "Banchoff–Chmutov of degree 16",
        f"{doubled(16, 'x')} + {doubled(16, 'y')} + {doubled(16, 'z')}",
        16,
        _CUBE,
        _CHMUTOV,
        symmetries=FULL,
        singular_points=0,
    ),
    entry(
        "chmutov_20",
        "Banchoff–Chmutov of degree 20",
        f"{doubled(20, 'x')} + {doubled(20, 'y')} + {doubled(20, 'z')}",
        20,
        _CUBE,
        _CHMUTOV,
        symmetries=FULL,
        singular_points=0,
    ),
    entry(
        "folded_nonic",
        "Chmutov's nonic of A2",
        folded(9),
        9,
        _DELTOID,
        _FOLDED,
        symmetries=("third_turn_z", "mirror_y"),
        singular_points=folded_nodes(9),
    ),
    entry(
        "folded_dodecic",
        "Chmutov's dodecic of A2",
        folded(12),
        12,
        _DELTOID,
        _FOLDED,
        symmetries=("third_turn_z", "mirror_y", "mirror_z"),
        singular_points=folded_nodes(12),
    ),
    entry(
        "cube_20",
        "Superquadric of degree 20",
        "x^20 + y^20 + z^20 - 1",
        20,
        Sphere(1.7),
        _NORDSTRAND,
        symmetries=("mirror_x", "swap_xy", "cycle_xyz"),
        points=((-1, 0, 0), (0, -1, 0)),
    ),
    entry(
        "superquadric_10",
        "Superquadric of degree 10",
        "x^10 + y^10 + z^10 - 1",
        10,
        Sphere(1.75),
        "A. H. Barr, Superquadrics and angle-preserving transformations, 1981",
        symmetries=FULL,
        points=((1, 0, 0), (0, -1, 0)),
        singular_points=0,
    ),
    entry(
        "fermat_15",
        "Fermat surface of degree 15",
        "x^15 + y^15 + z^15 - 1",
        15,
        Sphere(2.0),
        "P. de Fermat; F. Klein 1879 and others: x^n + y^n + z^n = 1",
        symmetries=("swap_xy", "cycle_xyz"),
        points=((1, 0, 0), (1, -1, 1)),
        singular_points=0,
    ),
    entry(
        "rose_ring",
        "Tube about a rose of five petals",
        "((x^2 + y^2)^3 - x*(x^4 - 10*x^2*y^2 + 5*y^4))^2 + 0.25*z^2*(x^2 + y^2 + z^2)^2 - 0.0025",
        12,
        Sphere(1.375),
        "G. Grandi 1723: the curve r = cos 5θ; E. W. Weisstein, MathWorld: Rose",
        symmetries=("fifth_turn_z", "mirror_y", "mirror_z"),
    ),
    entry(
        "sarti_dodecic",
        "Sarti dodecic",
        "let l1 = x^4 + y^4 + z^4 + 1; let l2 = x^2*y^2 + z^2; let l3 = x^2*z^2 + y^2; let l4 = x^2 + y^2*z^2;"
        " let l5 = x*y*z; let q = x^2 + y^2 + z^2 + 1;"
        " let s10 = l1*(l2*l3 + l2*l4 + l3*l4); let s11 = l1^2*(l2 + l3 + l4); let s12 = l1*(l2^2 + l3^2 + l4^2);"
        " let s51 = l5^2*(l2 + l3 + l4); let s234 = l2^3 + l3^3 + l4^3;"
        " let plus = l2*l3*(l2 + l3) + l3*l4*(l3 + l4) + l4*l2*(l4 + l2);"
        " let minus = l2*l3*(l2 - l3) + l3*l4*(l3 - l4) + l4*l2*(l4 - l2);"
        " 22*q^6 - 243*(33*sqrt5*minus + 19*plus + 10*s234 - 14*s10 + 2*s11 - 6*s12 - 352*s51 + 336*l5^2*l1"
        " + 48*l2*l3*l4)",
        12,
        Sphere(2.5),
        "A. Sarti, Pencils of symmetric surfaces in P3, J. Algebra 246, 2001; S. Endraß, Surf's gallery, 2003",
        symmetries=("mirror_x", "cycle_xyz", "icosahedral_turn"),
        singular_within=(2.5, 290),  # of 600, some of them at infinity
    ),
    entry(
        "quaternion_julia",
        "Lemniscate of a quaternion Julia set",
        # q -> q^2 + c on q = (a, b, c', 0), whose imaginary part keeps its direction but for that of c
        "let a1 = x^2 - y^2 - z^2 - 0.3; let b1 = 2*x*y + 0.6; let c1 = 2*x*z;"
        " let a2 = a1^2 - b1^2 - c1^2 - 0.3; let b2 = 2*a1*b1 + 0.6; let c2 = 2*a1*c1;"
        " let a3 = a2^2 - b2^2 - c2^2 - 0.3; let b3 = 2*a2*b2 + 0.6; let c3 = 2*a2*c2;"
        " a3^2 + b3^2 + c3^2 - 4",
        16,
        Sphere(1.75),
        "A. Norton, Julia sets in the quaternions, Computers & Graphics 13, 1989: three turns, |q| = 2",
        symmetries=("mirror_z",),
    ),
)
