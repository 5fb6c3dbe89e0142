"""Make entries of the catalog and of the gallery, with the facts that they may state.

A wrong transcription renders plausibly. Everything in `facts` is therefore recomputed by tests/test_catalog.py and
tests/test_gallery_facts.py:

    singular_points   how many real points have f = 0 and grad f = 0, all of them isolated
    singular_within     a radius about the domain's centre, and how many such points lie within it, of more farther out
    singular_along    directions (a, b, c) of lines through the origin along which f and grad f vanish
    singular_at       some points of a curve along which f and grad f vanish
    symmetries        names of SYMMETRIES that leave f as it is
    points            points that lie on the surface
"""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, pi, sin, sqrt
from typing import Any

from surfaces.model import Domain, Surface

PHI = (1.0 + sqrt(5.0)) / 2.0
_HALF_ROOT_3 = sqrt(3.0) / 2.0
CATALOG = "catalog"  # the group of what is in the catalog
Matrix = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]


def _turn_z(parts: int) -> Matrix:
    """Return the turn about z by a full turn over `parts`."""
    angle = 2.0 * pi / parts
    return ((cos(angle), -sin(angle), 0), (sin(angle), cos(angle), 0), (0, 0, 1))


SYMMETRIES: dict[str, Matrix] = {
    "mirror_x": ((-1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "mirror_y": ((1, 0, 0), (0, -1, 0), (0, 0, 1)),
    "mirror_z": ((1, 0, 0), (0, 1, 0), (0, 0, -1)),
    "half_turn_x": ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
    "half_turn_y": ((-1, 0, 0), (0, 1, 0), (0, 0, -1)),
    "half_turn_z": ((-1, 0, 0), (0, -1, 0), (0, 0, 1)),
    "swap_xy": ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "swap_yz": ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    "swap_xz": ((0, 0, 1), (0, 1, 0), (1, 0, 0)),
    "cycle_xyz": ((0, 1, 0), (0, 0, 1), (1, 0, 0)),
    "quarter_roto_reflection_z": ((0, 1, 0), (-1, 0, 0), (0, 0, -1)),
    "rotate_z_5": ((3 / 5, -4 / 5, 0), (4 / 5, 3 / 5, 0), (0, 0, 1)),  # by atan(4/3), of infinite order
    "rotate_x_5": ((1, 0, 0), (0, 3 / 5, -4 / 5), (0, 4 / 5, 3 / 5)),
    "rotate_y_5": ((3 / 5, 0, 4 / 5), (0, 1, 0), (-4 / 5, 0, 3 / 5)),
    "fifth_turn_z": _turn_z(5),
    "sixth_turn_z": _turn_z(6),
    "seventh_turn_z": _turn_z(7),
    "twelfth_turn_z": _turn_z(12),
    "third_turn_z": ((-0.5, -_HALF_ROOT_3, 0), (_HALF_ROOT_3, -0.5, 0), (0, 0, 1)),
    "eighth_turn_z": ((sqrt(0.5), -sqrt(0.5), 0), (sqrt(0.5), sqrt(0.5), 0), (0, 0, 1)),
    # the fifth turn about (phi, 1, 0), a vertex of the icosahedron
    "icosahedral_turn": (
        (0.5 * PHI, 0.5 / PHI, 0.5),
        (0.5 / PHI, 0.5, -0.5 * PHI),
        (-0.5, 0.5 * PHI, 0.5 / PHI),
    ),
}
FULL = ("mirror_x", "swap_xy", "cycle_xyz")
ROUND = ("rotate_z_5", "rotate_x_5", "mirror_z")
REVOLVED = ("rotate_z_5", "mirror_x", "mirror_z")


def sum_over_axes(term: str, constant: str) -> str:
    """Return the sum of a term in t at x, y and z, and of a constant, which is given with its sign."""
    return " + ".join(f"({term.replace('t', axis)})" for axis in "xyz") + f" {constant}"


def entry(
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
    group: str = CATALOG,
    **facts: Any,
) -> Surface:
    """Return a surface of the catalog or of the gallery; this module's docstring lists the `facts`."""
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
        group=group,
        facts=tuple(facts.items()),
    )
