"""Hold polynomials of degree 8 to 20."""

from __future__ import annotations

from surfaces.entries import FULL, entry
from surfaces.gallery.polynomials import chebyshev, folded, folded_nodes
from surfaces.model import Box, Sphere, Surface

TITLE = "High degree, up to 20"
_FOLDED = (
    "S. V. Chmutov, Examples of projective surfaces with many singularities, J. Alg. Geom. 1, 1992;"
    " real nodes: S. Breske, O. Labs, D. van Straten, Real line arrangements, 2008"
)
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
        f"{chebyshev(16, 'x')} + {chebyshev(16, 'y')} + {chebyshev(16, 'z')}",
        16,
        Sphere(1.7),
        _CHMUTOV,
        symmetries=FULL,
        singular_points=0,
    ),
    entry(
        "chmutov_20",
        "Banchoff–Chmutov of degree 20",
        f"{chebyshev(20, 'x')} + {chebyshev(20, 'y')} + {chebyshev(20, 'z')}",
        20,
        Sphere(1.7),
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
)
