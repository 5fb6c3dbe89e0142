"""Bound the fourth directional derivatives of a polynomial f over the cells of a cube about its domain.

    table = fourth_bounds(surface)  # float64[16, 16, 16]; table.ravel() has x fastest

Entry [k, j, i] is at least |D⁴f(p)(v, v, v, v)| for each unit vector v and each point p of cell (i, j, k) and of its
surroundings: of all that is within BEYOND sides of a cell from it, in each coordinate. The cube is about the domain's
centre; `half_side` says how large it is.

**Theory** A cell and its surroundings are covered by parts, which are smaller cubes. About a part's centre c, f is the
sum of its homogeneous Taylor parts P_m, of degrees m = 0 … n. For |h| <= r and |v| = 1,

    |D⁴f(c + h)(v, v, v, v)| <= sum over m = 4 … n of m! / (m - 4)! r^(m - 4) max |P_m(w)| over |w| = 1,

since term m of the left side is a value of the symmetric m-linear form of P_m at m - 4 times h and 4 times v, and such
a form is on no unit vectors larger than the maximum of |P_m| (Banach 1938). That maximum is bounded in two ways, and
the smaller bound is taken:

- By values at directions. If the angle between any direction and the nearest of these, or its opposite, is at most a,
  the maximum is at most their largest value over cos(m a). On a great circle P_m is a trigonometric polynomial of
  degree m, and such a one is at the angle a from its maximum M still at least M cos(m a), if m a < π/2 (Riesz 1914).
- By Bombieri's norm: |sum of c_b w^b| <= (sum of c_b² b! / m!)^(1/2), by Cauchy's inequality.

f is expanded exactly, in units of the cube. All after that is in double precision. Its errors are at most ROUNDINGS
unit roundoffs of the same sums with all terms positive, and are added.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, FirsthitError, Surface

GRID = 16  # cells along the cube's side
BEYOND = 1.0  # sides of a cell: how far its entry holds beyond it
WIDER = Fraction(9, 8)  # half the cube's side over half the domain's
FACE = 12  # directions: FACE² on each of three faces of a cube
DIRECTED = 8  # highest degree of a Taylor part that is bounded by its values at directions
BLOCK = 128  # forms whose values are computed at once: these fit into a processor's cache
ROUNDINGS = 512  # unit roundoffs; for degree 20 they sum up to less than 400
FLOAT32 = 1.0 + 2.0**-20  # so that a bound that is rounded to float32 still is one
PARTS = 32  # least number of parts along the cube's side
_UNIT = 2.0**-53
_TINY = 2.0**-500  # what squares may lose by underflow, over the largest coefficient

Floats = NDArray[np.float64]


def half_side(domain: Domain) -> float:
    """Return half the side of the cube, in scene units: WIDER times half the domain's longest extent."""
    if isinstance(domain, Box):
        return float(WIDER) * max(b - a for a, b in zip(domain.lower, domain.upper, strict=True)) / 2
    return float(WIDER) * domain.radius


@lru_cache(maxsize=64)
def fourth_bounds(surface: Surface, grid: int = GRID, beyond: float = BEYOND) -> Floats:
    """Bound |D⁴f(v, v, v, v)| over all unit vectors v and each cell with its surroundings: float64[grid, grid, grid].

    Entry [k, j, i] is for cell number i along x, j along y and k along z. The surroundings reach `beyond` sides of a
    cell beyond it in each coordinate, but not out of the cube; `beyond` is a multiple of 1/2. The result is read-only.
    Rounded to float32 it still is a bound.

    Raises FirsthitError if f is no polynomial or a bound is not finite.
    """
    if surface.degree is None:
        raise FirsthitError(f"{surface.name}: not algebraic, so its fourth derivatives are not bounded here")
    cut = 2 * math.ceil(PARTS / (2 * grid)) if 2 * beyond % 2 or grid < PARTS else 1  # parts along a cell's side
    margin = round(beyond * cut)
    if beyond < 0.0 or margin != beyond * cut:
        raise FirsthitError(f"{beyond} cells beyond a cell: not a multiple of 1/2")
    with np.errstate(over="ignore", invalid="ignore"):
        parts = _over_parts(surface, cut * grid) * (FLOAT32 / half_side(surface.domain) ** 4)
    if not np.isfinite(parts).all():
        raise FirsthitError(f"{surface.name}: no finite bound of its fourth derivatives over the domain")
    for axis in range(3):
        wide = np.pad(parts, [(margin, margin) if a == axis else (0, 0) for a in range(3)], mode="edge")
        windows = np.lib.stride_tricks.sliding_window_view(wide, cut + 2 * margin, axis=axis)
        parts = windows.max(axis=-1).take(range(0, cut * grid, cut), axis=axis)
    table: Floats = np.ascontiguousarray(parts)
    table.setflags(write=False)
    return table


def expanded(surface: Surface) -> Floats:
    """Return the coefficients of x^i y^j z^k of a polynomial f of degree n, float64[n + 1, n + 1, n + 1].

    Coordinates are about the domain's centre, in halves of the cube's side. Each is the double next to the exact one.
    """
    import surfaces
    from surfaces.files.povray_writing import Polynomials
    from surfaces.lowering import real_tape
    from surfaces.tape import walk

    numbers: Any = Polynomials()
    half, center = Fraction(half_side(surface.domain)), map(Fraction, surface.domain.center)
    axes = {
        name: variable * numbers.const(half) + numbers.const(middle)
        for name, variable, middle in zip("xyz", numbers.context.gens(), center, strict=True)
    }
    (polynomial,) = walk(real_tape(surfaces.tape_of(surface)), numbers, axes)
    degree = surface.degree or 0
    found = np.zeros((degree + 1,) * 3)
    for powers, value in polynomial.to_dict().items():
        if sum(powers) <= degree:  # others are what rounded constants leave of terms that cancel
            found[tuple(map(int, powers))] = _rounded(Fraction(int(value.p), int(value.q)))
    return found


def _rounded(value: Fraction) -> float:
    """Return the double next to a number, infinity past all doubles."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def _over_parts(surface: Surface, count: int) -> Floats:
    """Bound the fourth derivatives over each of count³ parts, by z, y and x; the unit is half the cube's side."""
    coefficients = expanded(surface).T  # by z, y and x
    scale = float(np.abs(coefficients).max()) or 1.0
    coefficients = coefficients / scale
    middles = (2.0 * np.arange(count) + 1.0 - count) / count
    bounds = np.empty((count,) * 3)
    for k, parts in enumerate(_slabs(coefficients, middles, 1.0 / count)):
        bounds[k] = _summed(parts, directed=True)
    # rounding errors grow with the coefficients' magnitudes, and with those of the coordinates
    sizes = np.abs(middles[count // 2 :])
    majorants = np.empty((len(sizes),) * 3)
    for k, parts in enumerate(_slabs(np.abs(coefficients), sizes, 1.0 / count)):
        majorants[k] = _summed(parts, directed=False)
    place = np.abs(2 * np.arange(count) + 1 - count) // 2
    bounds += ROUNDINGS * _UNIT * (majorants[np.ix_(place, place, place)] + bounds)
    return bounds * (scale * float(count) ** 4)


def _slabs(coefficients: Floats, middles: Floats, unit: float) -> Iterator[dict[int, Floats]]:
    """Expand a polynomial about each (x, y, z) of `middles`, with `unit` as the unit of length.

    Yields for each z the homogeneous parts of degree m >= 4: float64[powers, y, x], in the order of `_powers(m)`.
    """
    n, count = len(coefficients) - 1, len(middles)
    shift = np.zeros((count, n + 1, n + 1))  # [middle, new power, power]
    for power in range(n + 1):
        for new in range(power + 1):
            shift[:, new, power] = math.comb(power, new) * middles ** (power - new) * unit**new
    places = {powers: (m, i) for m in range(4, n + 1) for i, powers in enumerate(_powers(m))}
    for rows in shift:
        along_z = np.tensordot(rows, coefficients, axes=(1, 0))  # [new z, y, x]
        parts = {m: np.empty((len(_powers(m)), count, count)) for m in range(4, n + 1)}
        for c in range(n + 1):
            along_y = np.tensordot(shift[:, : n + 1 - c], along_z[c], axes=(2, 0))  # [middle y, new y, x]
            for b in range(n + 1 - c):
                most = n - b - c  # powers of x that occur
                along_x = np.tensordot(shift[:, : most + 1, : most + 1], along_y[:, b, : most + 1], axes=(2, 1))
                for a in range(max(0, 4 - b - c), most + 1):
                    m, i = places[a, b, c]
                    parts[m][i] = along_x[:, a].T
        yield parts


def _summed(parts: dict[int, Floats], directed: bool) -> Floats:
    """Bound the fourth derivatives over cubes about the centres of Taylor parts, whose unit is half the cubes' side."""
    radius, total = math.sqrt(3.0), np.zeros(())
    for m, part in parts.items():
        most = _by_norm(m, part)
        if directed and m <= DIRECTED:
            most = np.minimum(most, _by_directions(m, part))
        total = total + math.factorial(m) // math.factorial(m - 4) * radius ** (m - 4) * (most + _TINY)
    return np.asarray(total)


def _by_norm(m: int, part: Floats) -> Floats:
    """Return Bombieri's norm of forms of degree m, whose coefficients float64[powers, …] are given."""
    return np.asarray(np.sqrt(np.tensordot(_shares(m), part * part, axes=(0, 0))))


def _by_directions(m: int, part: Floats) -> Floats:
    """Bound forms of degree m on the sphere by their values at directions."""
    columns, found = part.reshape(len(part), -1), []
    for start in range(0, columns.shape[1], BLOCK):
        values = _monomials(m) @ columns[:, start : start + BLOCK]
        found.append(np.maximum(values.max(axis=(0, 1)), -values.min(axis=(0, 1))))
    return np.asarray(np.concatenate(found).reshape(part.shape[1:]) / math.cos(m * _directions()[1]))


@cache
def _powers(m: int) -> tuple[tuple[int, int, int], ...]:
    """Return the powers of x, y and z in a form of degree m."""
    return tuple((a, b, m - a - b) for a in range(m + 1) for b in range(m + 1 - a))


@cache
def _shares(m: int) -> Floats:
    """Return what Bombieri's norm multiplies the squares of a form's coefficients by, float64[powers]."""
    return np.array([math.prod(map(math.factorial, powers)) / math.factorial(m) for powers in _powers(m)])


@cache
def _directions() -> tuple[Floats, float]:
    """Return unit vectors, float64[directions, 3], and the largest angle from any line through 0 to the nearest."""
    edges = np.tan((np.arange(FACE + 1) / FACE - 0.5) * np.pi / 2)
    inner = np.tan(((np.arange(FACE) + 0.5) / FACE - 0.5) * np.pi / 2)

    def on_face(u: Floats, v: Floats) -> Floats:
        points = np.stack([np.ones((len(u), len(v))), *np.meshgrid(u, v, indexing="ij")], axis=-1)
        return np.asarray(points / np.linalg.norm(points, axis=-1, keepdims=True))

    middles, corners = on_face(inner, inner), on_face(edges, edges)
    # a field is convex, so its point at the largest angle from its middle is one of its corners
    nearest = [(middles * corners[i : i + FACE, j : j + FACE]).sum(axis=-1).min() for i in (0, 1) for j in (0, 1)]
    faces = [np.roll(middles.reshape(-1, 3), k, axis=1) for k in range(3)]
    return np.concatenate(faces), math.acos(min(nearest)) + 1e-9


@cache
def _monomials(m: int) -> Floats:
    """Return the values of a form's monomials at the directions, float64[FACE, directions / FACE, powers].

    In groups, since products of small matrices are computed by one thread: on a busy machine that is faster.
    """
    values = np.prod(_directions()[0][:, None, :] ** np.array(_powers(m))[None], axis=-1)
    return np.asarray(values.reshape(FACE, -1, values.shape[1]))
