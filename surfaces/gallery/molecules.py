"""Hold molecules in ångström: sums of Gaussians, products, hard spheres, and densities of orbitals.

Positions follow from measured bond lengths and angles. A Gaussian of an atom alone has the atom's radius as its level
set (Blinn 1982, his blobbiness is b).
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import product
from math import cos, pi, radians, sin, sqrt

from surfaces.entries import FULL, entry
from surfaces.gallery.blobs import square
from surfaces.model import Box, Sphere, Surface

TITLE = "Molecules and orbitals"
_BLINN = "J. F. Blinn, A generalization of algebraic surface drawing, ACM TOG 1, 1982"
_BONDI = "A. Bondi, van der Waals volumes and radii, J. Phys. Chem. 68, 1964"
_PAULING = "L. Pauling, E. B. Wilson, Introduction to Quantum Mechanics, 1935, chapter 5"
_LENGTHS = "CRC Handbook of Chemistry and Physics: bond lengths and angles"
_RADII = {"H": 1.20, "C": 1.70, "N": 1.55, "O": 1.52, "F": 1.47, "S": 1.80}  # Bondi
Atom = tuple[str, tuple[float, float, float]]


def _atom(element: str, *point: float) -> Atom:
    """Return an atom, its position rounded to 1e-4 ångström."""
    x, y, z = (round(c, 4) + 0.0 for c in point)
    return element, (x, y, z)


def _gaussians(atoms: Iterable[Atom], blobbiness: float, scale: float = 1.0) -> str:
    """Return the sum of the atoms' Gaussians less 1; `scale` times their van der Waals radii are their radii."""
    terms = []
    for element, point in atoms:
        factor = blobbiness / (scale * _RADII[element]) ** 2
        terms.append(f"exp({blobbiness:g} - {factor:.6g}*({square(point)}))")
    return " + ".join(terms) + " - 1"


def _product(atoms: Iterable[Atom], level: float, scale: float) -> str:
    """Return the product of r^2/R^2 - 1 over the atoms, less the level."""
    factors = (f"(({square(point)})/{(scale * _RADII[element]) ** 2:.6g} - 1)" for element, point in atoms)
    return "*".join(factors) + f" - {level:g}"


def _spheres(atoms: Iterable[Atom]) -> str:
    """Return the least distance from the atoms' van der Waals spheres."""
    return f"min({', '.join(f'sqrt({square(point)}) - {_RADII[element]:g}' for element, point in atoms)})"


def _ring(element: str, radius: float) -> list[Atom]:
    """Return six atoms on a circle in the plane z = 0."""
    return [_atom(element, radius * cos(k * pi / 3), radius * sin(k * pi / 3), 0) for k in range(6)]


def _fullerene(edge: float) -> list[Atom]:
    """Return the sixty corners of the truncated icosahedron whose edges have this length."""
    phi = (1.0 + sqrt(5.0)) / 2.0
    first = ((0.0, 1.0, 3.0 * phi), (1.0, 2.0 + phi, 2.0 * phi), (phi, 2.0, 1.0 + 2.0 * phi))
    corners = {
        tuple(edge / 2.0 * s * c for s, c in zip(signs, corner[k:] + corner[:k], strict=True))
        for corner in first
        for k in range(3)
        for signs in product((1.0, -1.0), repeat=3)
    }
    return [_atom("C", *corner) for corner in sorted({tuple(c + 0.0 for c in corner) for corner in corners})]


_HALF = radians(104.48 / 2.0)
_WATER = [
    _atom("O", 0, 0, 0),
    *(_atom("H", s * 0.9575 * sin(_HALF), 0, 0.9575 * cos(_HALF)) for s in (1, -1)),
]
_T = 1.087 / sqrt(3.0)
_METHANE = [
    _atom("C", 0, 0, 0),
    *(_atom("H", _T * a, _T * b, _T * a * b) for a, b in product((1, -1), repeat=2)),
]
_BENZENE = [*_ring("C", 1.399), *_ring("H", 1.399 + 1.101)]
_HEXAFLUORIDE = [
    _atom("S", 0, 0, 0),
    *(_atom("F", *(1.561 * s if i == axis else 0 for i in range(3))) for axis in range(3) for s in (1, -1)),
]
_CELL = 3.567  # of diamond
_DIAMOND = [
    _atom("C", *(_CELL * (c - 0.5) for c in point))
    for point in (
        *product((0, 1), repeat=3),
        *((p[k], p[(k + 1) % 3], p[(k + 2) % 3]) for s in (0, 1) for p in [(s, 0.5, 0.5)] for k in range(3)),
        *((0.25, 0.25, 0.25), (0.75, 0.75, 0.25), (0.75, 0.25, 0.75), (0.25, 0.75, 0.75)),
    )
]

SURFACES: tuple[Surface, ...] = (
    entry(
        "water",
        "Water",
        _gaussians(_WATER, 4.0, 0.7),
        None,
        Sphere(2.0),
        f"{_BLINN}; {_LENGTHS}; {_BONDI}, radii times 0.7",
        symmetries=("mirror_x", "mirror_y"),
    ),
    entry(
        "methane",
        "Methane",
        _gaussians(_METHANE, 4.0, 0.6),
        None,
        Sphere(2.25),
        f"{_BLINN}; {_LENGTHS}; {_BONDI}, radii times 0.6",
        symmetries=("half_turn_x", "swap_xy", "cycle_xyz"),
    ),
    entry(
        "benzene",
        "Benzene",
        _gaussians(_BENZENE, 4.0, 0.6),
        None,
        Box((-3.5, -3.5, -1.25), (3.5, 3.5, 1.25)),
        f"{_BLINN}; {_LENGTHS}; {_BONDI}, radii times 0.6",
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
    ),
    entry(
        "sulfur_hexafluoride",
        "Sulfur hexafluoride",
        _gaussians(_HEXAFLUORIDE, 4.0, 0.7),
        None,
        Sphere(3.0),
        f"{_BLINN}; {_LENGTHS}; {_BONDI}, radii times 0.7",
        symmetries=FULL,
    ),
    entry(
        "diamond",
        "Cell of diamond",
        _gaussians(_DIAMOND, 4.0, 0.45),
        None,
        Box((-2.75, -2.75, -2.75), (2.75, 2.75, 2.75)),
        f"{_BLINN}; W. H. Bragg, W. L. Bragg 1913, a = 3.567; {_BONDI}, radii times 0.45",
        symmetries=("swap_xy", "cycle_xyz"),
    ),
    entry(
        "buckminsterfullerene",
        "Buckminsterfullerene",
        _gaussians(_fullerene(1.44), 4.0, 0.45),
        None,
        Sphere(4.75),
        f"{_BLINN}; H. W. Kroto et al., Nature 318, 1985, edges of 1.44; {_BONDI}, radii times 0.45",
        symmetries=("mirror_x", "cycle_xyz"),
    ),
    entry(
        "water_product",
        "Water as a product",
        _product(_WATER, 0.3, 0.5),
        6,
        Sphere(2.0),
        f"products of spheres: {_BLINN}, section 2; {_LENGTHS}",
        symmetries=("mirror_x", "mirror_y"),
    ),
    entry(
        "methane_product",
        "Methane as a product",
        _product(_METHANE, 0.2, 0.45),
        10,
        Sphere(2.0),
        f"products of spheres: {_BLINN}, section 2; {_LENGTHS}",
        symmetries=("half_turn_x", "swap_xy", "cycle_xyz"),
    ),
    entry(
        "benzene_spheres",
        "Benzene of hard spheres",
        _spheres(_BENZENE),
        None,
        Box((-3.875, -3.875, -1.8125), (3.875, 3.875, 1.8125)),
        f"R. B. Corey, L. Pauling, Molecular models, 1953; {_LENGTHS}; {_BONDI}",
        distance=_spheres(_BENZENE),
        symmetries=("mirror_x", "mirror_y", "mirror_z"),
    ),
    entry(
        "orbital_2p",
        "Orbital 2p of hydrogen",
        "z^2*exp(-sqrt(x^2 + y^2 + z^2)) - 0.1",
        None,
        Sphere(6.5),
        f"{_PAULING}: psi^2, in units of the Bohr radius",
        symmetries=("rotate_z_5", "mirror_x", "mirror_z"),
    ),
    entry(
        "orbital_3d",
        "Orbital 3d of hydrogen along z",
        "(2*z^2 - x^2 - y^2)^2*exp(-2/3*sqrt(x^2 + y^2 + z^2)) - 4",
        None,
        Sphere(18.0),
        f"{_PAULING}: psi^2, in units of the Bohr radius",
        symmetries=("rotate_z_5", "mirror_x", "mirror_z"),
    ),
    entry(
        "orbital_4f",
        "Orbital 4f of hydrogen, xyz",
        "(x*y*z)^2*exp(-1/2*sqrt(x^2 + y^2 + z^2)) - 3",
        None,
        Sphere(30.0),
        f"{_PAULING}: psi^2, in units of the Bohr radius",
        symmetries=FULL,
    ),
    entry(
        "hydrogen_ion",
        "Antibonding orbital of the hydrogen molecular ion",
        "(exp(-sqrt(x^2 + y^2 + (z - 1)^2)) - exp(-sqrt(x^2 + y^2 + (z + 1)^2)))^2 - 0.02",
        None,
        Sphere(4.5),
        "B. N. Finkelstein, G. E. Horowitz 1928; linear combination of atomic orbitals, R = 2 Bohr radii",
        symmetries=("rotate_z_5", "mirror_x", "mirror_z"),
    ),
)
