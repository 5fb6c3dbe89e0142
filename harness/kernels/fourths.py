"""Bound the fourth derivatives of a polynomial f over the cells of a cube about its domain.

    table = fourth_bounds(surface)  # float64[32, 32, 32, 16]; table.ravel() has x fastest of the coordinates
    pyramid = fourth_pyramid(surface)  # float64[37376, 16]: the tables of 32, 16 and 8 cells a side, one after another

Entry [k, j, i, a] is at least 24 / b! |d^b f(p)|, with the powers b = POWERS[a] of x, y and z, for each point p of cell
(i, j, k) and of its surroundings: of all that is within BEYOND sides of a cell from it, in each coordinate. The last of
the 16 entries is 0. So for any vector v

    |D⁴f(p)(v, v, v, v)| <= sum over a of table[k, j, i, a] |v_x|^b_x |v_y|^b_y |v_z|^b_z.

The cube is about the domain's centre; `half_side` says how large it is.

**Theory** A cell and its surroundings are covered by parts, which are smaller cubes. f is expanded about each part's
centre. Each derivative is then a polynomial in the offset from the centre, whose magnitude in the part is at most the
sum of its terms' magnitudes at a corner. The expansion about the domain's centre is exact. All after that is in double
precision. Its errors are at most ROUNDINGS unit roundoffs of the same sums with all terms positive, and are added.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache, lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Box, Domain, FirsthitError, Surface

NODES = (
    -0.9609375,
    -0.3984375,
    0.3984375,
    0.9609375,
)  # of cubic interpolation on [-1, 1], in both directions of a tile
GRID = 32  # cells along the cube's side
TABLES = 3  # of a pyramid: each has half as many cells along the cube's side as the one before
BEYOND = 1.0  # sides of a cell: how far its entries hold beyond it
WIDER = Fraction(9, 8)  # half the cube's side over half the domain's
PARTS = 32  # least number of parts along the cube's side
POWERS = [(a, b, 4 - a - b) for a in range(5) for b in range(5 - a)]
ROUNDINGS = 512  # unit roundoffs; for degree 20 they sum up to less than 460
FLOAT32 = 1.0 + 2.0**-20  # so that a bound that is rounded to float32 still is one
KERNELS = 1.0 + 2.0**-14
_UNIT = 2.0**-53

Floats = NDArray[np.float64]


def half_side(domain: Domain) -> float:
    """Return half the side of the cube, in scene units: WIDER times half the domain's longest extent."""
    if isinstance(domain, Box):
        return float(WIDER) * max(b - a for a, b in zip(domain.lower, domain.upper, strict=True)) / 2
    return float(WIDER) * domain.radius


@lru_cache(maxsize=64)
def fourth_bounds(surface: Surface, grid: int = GRID, beyond: float = BEYOND) -> Floats:
    """Bound f's fourth derivatives over each cell with its surroundings: float64[grid, grid, grid, 16].

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
    for axis in range(1, 4):
        wide = np.pad(parts, [(margin, margin) if a == axis else (0, 0) for a in range(4)], mode="edge")
        windows = np.lib.stride_tricks.sliding_window_view(wide, cut + 2 * margin, axis=axis)
        parts = windows.max(axis=-1).take(range(0, cut * grid, cut), axis=axis)
    table = np.zeros((grid, grid, grid, len(POWERS) + 1))
    table[..., :-1] = np.moveaxis(parts, 0, -1)
    table.setflags(write=False)
    return table


@lru_cache(maxsize=64)
def fourth_pyramid(surface: Surface) -> Floats:
    """Return the tables of GRID, GRID / 2, … cells a side, TABLES of them, as rows: float64[cells of all, 16].

    The result is read-only. Raises FirsthitError as `fourth_bounds`.
    """
    rows = np.concatenate([fourth_bounds(surface, GRID >> k).reshape(-1, len(POWERS) + 1) for k in range(TABLES)])
    rows.setflags(write=False)
    return rows


def remainder_factors(degree: int) -> tuple[float, float]:
    """Return factors a, b: on a tile, bicubic interpolation at NODES is off by at most a X + b Y.

    X and Y are the largest fourth derivatives by the place in [-1, 1] across the tile and down it. `degree` is f's. The
    factors are larger by the share KERNELS, more than what float32 kernels lose in their products and sums.
    """
    error, lebesgue = (KERNELS * value for value in interpolation(NODES))
    return error, error * (lebesgue if degree >= 8 else 1.0)  # see docs/tiles.md


def interpolation(nodes: Sequence[float]) -> tuple[float, float]:
    """Return bounds of cubic interpolation on [-1, 1], at four nodes in ascending order.

    The first is the largest error over the largest fourth derivative. The second, Lebesgue's constant, is the largest
    interpolated value over the largest value at the nodes.
    """
    whole = np.asarray(np.poly(nodes))
    others = [np.asarray(np.poly([*nodes[:k], *nodes[k + 1 :]])) for k in range(4)]
    weights = [other / np.polyval(other, node) for other, node in zip(others, nodes, strict=True)]
    error = lebesgue = 0.0
    for start, stop in pairwise((-1.0, *nodes, 1.0)):  # no weight changes its sign in one of these
        signs = [math.copysign(1.0, np.polyval(weight, (start + stop) / 2.0)) for weight in weights]
        error = max(error, _largest(whole, start, stop) / 24.0)
        lebesgue = max(lebesgue, _largest(np.array(signs) @ np.array(weights), start, stop))
    return error * FLOAT32, lebesgue * FLOAT32


def _largest(polynomial: Floats, start: float, stop: float) -> float:
    """Return the largest magnitude of a polynomial in an interval; its highest coefficient is first."""
    turns = [z.real for z in np.roots(np.polyder(polynomial)) if abs(z.imag) < 1e-6 and start < z.real < stop]
    return max(abs(float(np.polyval(polynomial, x))) for x in (start, stop, *turns))


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


@lru_cache(maxsize=4)  # tables of a pyramid have the same parts
def _over_parts(surface: Surface, count: int) -> Floats:
    """Bound the derivatives over count³ parts: float64[15, z, y, x]; the unit is half the cube's side."""
    coefficients = expanded(surface).T  # by z, y and x
    middles = (2.0 * np.arange(count) + 1.0 - count) / count
    bounds = np.stack(list(_slabs(coefficients, middles, 1.0 / count)), axis=1)
    # rounding errors grow with the coefficients' magnitudes, and with those of the coordinates
    sizes = np.abs(middles[count // 2 :])
    majorants = np.stack(list(_slabs(np.abs(coefficients), sizes, 1.0 / count)), axis=1)
    place = np.abs(2 * np.arange(count) + 1 - count) // 2
    bounds += ROUNDINGS * _UNIT * majorants[:, place][:, :, place][:, :, :, place]
    return bounds * float(count) ** 4


def _slabs(coefficients: Floats, middles: Floats, unit: float) -> Iterator[Floats]:
    """Bound the derivatives over cubes about each (x, y, z) of `middles`; `unit` is half their side and the unit.

    Yields float64[15, y, x] for each z. All matrices are small: their products are then left to one thread, which on a
    busy machine is much faster than several that wait for each other.
    """
    n, count = len(coefficients) - 1, len(middles)
    shift = np.zeros((n + 1, n + 1, count))  # [new power, power, middle]
    for power in range(n + 1):
        for new in range(power + 1):
            shift[new, power] = math.comb(power, new) * middles ** (power - new) * unit**new
    for k in range(count):
        along_z = np.tensordot(shift[:, :, k], coefficients, axes=(1, 0))  # [new z, y, x]
        along_y = {(b, c): shift[b].T @ along_z[c] for c in range(n + 1) for b in range(n + 1 - c)}  # [middle y, x]
        bounds = np.zeros((len(POWERS), count, count))
        for m in range(4, n + 1):
            terms, factors = _terms(m)
            part = np.empty((count, len(terms), count))
            for i, (a, b, c) in enumerate(terms):
                np.matmul(along_y[b, c][:, a:], shift[a, a:], out=part[:, i])
            bounds += np.moveaxis(factors @ np.abs(part, out=part), 0, 1)
        yield bounds


@cache
def _terms(degree: int) -> tuple[list[tuple[int, int, int]], Floats]:
    """Return the powers of x, y and z in terms of a degree, and how large a part each term has in the derivatives.

    The parts, float64[15, terms], are those of terms whose value is 1 where x, y and z are 1.
    """
    terms = [(a, b, degree - a - b) for a in range(degree + 1) for b in range(degree + 1 - a)]
    parts = [[24.0 * math.prod(map(math.comb, term, powers)) for term in terms] for powers in POWERS]
    return terms, np.array(parts)
