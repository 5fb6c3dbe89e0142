"""Hold surfaces that cross themselves: images of the projective plane, of the Klein bottle and of bands."""

from __future__ import annotations

from surfaces.entries import entry
from surfaces.model import Sphere, Surface

TITLE = "Immersed surfaces, which cross themselves"
_FISCHER = "G. Fischer, Mathematische Modelle, 1986"
_NORDSTRAND = "T. Nordstrand, Gallery of surfaces, University of Bergen"

SURFACES: tuple[Surface, ...] = (
    entry(
        "crosscap",
        "Cross-cap",
        "4*x^2*(x^2 + y^2 + z^2 + z) + y^2*(y^2 + z^2 - 1)",
        4,
        Sphere(1.5),
        _FISCHER,
        symmetries=("mirror_x", "mirror_y"),
        singular_along=((0, 0, 1),),
        points=((-0.5, 0, -0.5), (0, -1, 0)),
    ),
    entry(
        "boy",
        "Boy surface",
        "64*(1 - z)^3*z^3 - 48*(1 - z)^2*z^2*(3*x^2 + 3*y^2 + 2*z^2) + 12*(1 - z)*z*(27*(x^2 + y^2)^2 - "
        "24*z^2*(x^2 + y^2) + 36*sqrt(2)*y*z*(y^2 - 3*x^2) + 4*z^4) + (9*x^2 + 9*y^2 - 2*z^2)*(-81*(x^2 + "
        "y^2)^2 - 72*z^2*(x^2 + y^2) + 108*sqrt(2)*x*z*(x^2 - 3*y^2) + 4*z^4)",
        6,
        Sphere(1.6, (0.0, 0.0, 1.4)),
        f"F. Apéry, Models of the Real Projective Plane, 1987; {_NORDSTRAND}",
        symmetries=("third_turn_z",),
        singular_at=((0, 0, 0), (0, 0, 2 / 3)),
    ),
    entry(
        "moebius_band",
        "Möbius band's cubic",
        "-y + x^2*y + y^3 - 2*x*z - 2*x^2*z - 2*y^2*z + y*z^2",
        3,
        Sphere(2.0),
        "A. Gray, Modern Differential Geometry, 1997; E. W. Weisstein, MathWorld: Möbius Strip, R = 1",
        singular_at=((-1, 0, 0), (-1, 0.5, 0.5)),
        points=((0, 0, 1), (0, 1, 0)),
    ),
)
