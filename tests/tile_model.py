"""Model how a tile of rays is isolated, to hold docs/tiles.md ("Why a verdict holds") against exact arithmetic.

A tile's rays are eye + s (forward + x right + y up), for (x, y) in a square. The model has the polynomial of any ray in
balls of 200 bits, the net of the 16 node rays, the bound of their difference, and the halving with its verdicts. It
shares the tables of harness.kernels with the method, and none of the kernels' text.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from math import comb

import flint
import numpy as np
from numpy.typing import NDArray

import surfaces
from harness.contract import Surface
from harness.kernels import fourths
from harness.kernels.rounding import sample_errors_grow
from surfaces.lowering import real_tape
from surfaces.numbers import BallPolynomials
from surfaces.tape import walk

BITS = 200
DEPTHS = 6
NODES = np.array(fourths.NODES)
Floats = NDArray[np.float64]


def weights(at: float) -> list[flint.arb]:
    """Return the weights of the four nodes in cubic interpolation at a place in [-1, 1]."""
    nodes = [flint.arb(float(node)) for node in NODES]
    found = []
    for k, node in enumerate(nodes):
        weight = flint.arb(1)
        for other in nodes[:k] + nodes[k + 1 :]:
            weight *= (flint.arb(at) - other) / (node - other)
        found.append(weight)
    return found


def control_matrix() -> Floats:
    """Return the matrix that turns values at the nodes into cubic Bernstein coefficients on [-1, 1]."""
    u = (1.0 + NODES) / 2.0
    return np.linalg.inv(np.array([[comb(3, j) * x**j * (1.0 - x) ** (3 - j) for j in range(4)] for x in u]))


@dataclass(frozen=True)
class Tile:
    """Hold a tile: rays through (x, y) with |x - middle[0]| <= half[0] and |y - middle[1]| <= half[1].

    `camera` is float[4, 3]: eye, forward, right, up. Places in the tile are (a, b) in [-1, 1]².
    """

    surface: Surface
    camera: Floats
    middle: tuple[float, float]
    half: tuple[float, float]

    @property
    def degree(self) -> int:
        assert self.surface.degree is not None
        return self.surface.degree

    def polynomial(self, a: flint.arb | float, b: flint.arb | float) -> flint.arb_poly:
        """Return f along the ray of a place, as a polynomial in the depth s."""
        x = flint.arb(self.middle[0]) + flint.arb(self.half[0]) * a
        y = flint.arb(self.middle[1]) + flint.arb(self.half[1]) * b
        eye, forward, right, up = ([flint.arb(float(v)) for v in row] for row in self.camera)
        lines = {axis: flint.arb_poly([eye[k], forward[k] + x * right[k] + y * up[k]]) for k, axis in enumerate("xyz")}
        (along,) = walk(real_tape(surfaces.tape_of(self.surface)), BallPolynomials(), lines)
        return flint.arb_poly(along)

    def along(self, place: tuple[float, float], start: float, stop: float) -> list[flint.arb]:
        """Return the Bernstein coefficients of f on [start, stop] along the ray of a place."""
        return coefficients_on(self.polynomial(*place), self.degree, start, stop)

    def nodes(self, start: float, stop: float) -> list[list[list[flint.arb]]]:
        """Return the Bernstein coefficients along the node rays, [row b][column a][coefficient]."""
        places = [float(node) for node in NODES]
        return [[coefficients_on(self.polynomial(a, b), self.degree, start, stop) for a in places] for b in places]

    def net(self, start: float, stop: float) -> Floats:
        """Return the control values of the interpolated coefficients: float64[degree + 1, 16]."""
        nodes = np.array([[[float(c.mid()) for c in ray] for ray in row] for row in self.nodes(start, stop)])
        matrix = control_matrix()
        return np.einsum("ib,ja,bak->kij", matrix, matrix, nodes).reshape(self.degree + 1, 16)

    def left_over(self, places: Floats, start: float, stop: float) -> Floats:
        """Return by what the interpolated coefficients differ from those of each place's ray, float64[n, degree + 1].

        The difference is computed in balls; it is 0 where they do not tell it from 0.
        """
        nodes, found = self.nodes(start, stop), []
        for place in places:
            true, by_a, by_b = self.along(tuple(map(float, place)), start, stop), *map(weights, map(float, place))
            row = []
            for k, value in enumerate(true):
                inner = (sum((u * ray[k] for u, ray in zip(by_a, line, strict=True)), flint.arb(0)) for line in nodes)
                off = value - sum((v * c for v, c in zip(by_b, inner, strict=True)), flint.arb(0))
                row.append(0.0 if off.contains(0) else float(off.mid()))
            found.append(row)
        return np.array(found)

    @cached_property
    def depths(self) -> tuple[float, float]:
        """Return the depths between which the tile's rays may be in a domain that is a sphere; equal if nowhere."""
        eye, forward, right, up = self.camera
        near, far = math.inf, -math.inf
        for a in (-1.0, 0.0, 1.0):
            for b in (-1.0, 0.0, 1.0):
                way = forward + (self.middle[0] + self.half[0] * a) * right + (self.middle[1] + self.half[1] * b) * up
                to = np.array(self.surface.domain.center) - eye
                square, along = way @ way, to @ way
                room = along**2 - square * (to @ to - (1.02 * self.surface.domain.radius) ** 2)
                if room > 0.0:
                    near = min(near, (along - math.sqrt(room)) / square)
                    far = max(far, (along + math.sqrt(room)) / square)
        return (max(near, 0.0), far) if near < far and far > 0.0 else (0.0, 0.0)

    def remainder(self, table: Floats, start: float, stop: float) -> float:
        """Bound the interpolation's remainder at every depth, by entries of a table with BEYOND = 1 along the ray.

        Returns infinity where the tile is too wide for the table's cells, or reaches out of its cube.
        """
        grid, half_side = len(table), fourths.half_side(self.surface.domain)
        eye, forward, right, up = self.camera
        way = forward + self.middle[0] * right + self.middle[1] * up
        side = 2.0 * half_side / grid
        steps = 1 + int((stop - start) * np.abs(way).max() / side)
        across = np.abs([self.half[0] * right, self.half[1] * up])
        largest = np.zeros(16)
        for k in range(steps + 1):
            depth = start + (stop - start) * k / steps
            until = min(depth + 0.5 * (stop - start) / steps, stop)
            point = eye + depth * way - np.array(self.surface.domain.center)
            aside = until * across.sum(axis=0)
            if aside.max() > 0.5 * side or (np.abs(point) + aside).max() > half_side:
                return math.inf
            i, j, k3 = np.clip((point + half_side) / side, 0, grid - 1).astype(int)
            largest = np.maximum(largest, until**4 * table[k3, j, i])
        a, b = (np.prod(row ** np.array([*fourths.POWERS, (0, 0, 0)]), axis=1) for row in across)
        across_factor, down_factor = fourths.remainder_factors(self.degree)
        return float(largest @ (across_factor * a + down_factor * b))


def coefficients_on(polynomial: flint.arb_poly, degree: int, start: float, stop: float) -> list[flint.arb]:
    """Return the degree + 1 Bernstein coefficients on [start, stop] of a polynomial."""
    inner = polynomial(flint.arb_poly([flint.arb(start), flint.arb(stop) - flint.arb(start)]))
    return [
        sum((inner[i] * flint.arb(flint.fmpq(comb(k, i), comb(degree, i))) for i in range(k + 1)), flint.arb(0))
        for k in range(degree + 1)
    ]


def halves(c: Floats) -> tuple[Floats, Floats]:
    """Return the Bernstein coefficients of both halves, float64[degree + 1, …] each."""
    near, far = [c[0]], [c[-1]]
    while len(c) > 1:
        c = 0.5 * (c[:-1] + c[1:])
        near.append(c[0])
        far.append(c[-1])
    return np.array(near), np.array(far[::-1])


@cache
def growth(degree: int) -> list[float]:
    """Return by what factor errors grow in the coefficients of pieces of depth 0 … DEPTHS."""
    return sample_errors_grow(degree, "float64", DEPTHS)


def largest_share(tile: Tile, table: Floats, places: Floats, start: float, stop: float, depths: int) -> float:
    """Return the largest share of its bound by which a ray's coefficient differs from the net's, down to a depth.

    Returns 0 for a tile whose remainder is not bounded.
    """
    with flint.ctx.workprec(BITS):
        bound = tile.remainder(table, start, stop)
        if not math.isfinite(bound):
            return 0.0
        pieces = [tile.left_over(places, start, stop).T]
    share = 0.0
    for depth in range(depths + 1):
        most = max(float(np.abs(piece).max()) for piece in pieces)
        allowed = growth(tile.degree)[min(depth, DEPTHS)] * bound
        share = max(share, most / allowed if allowed > 0.0 else math.inf * (most > 0.0))
        pieces = [half for piece in pieces for half in halves(piece)]
    return share


Judge = Callable[[Floats, float], str]
Next = Callable[[int, int], tuple[int, int] | None]


def judged(c: Floats, error: float) -> str:
    """Return "empty", "single" or "open" for control values float64[degree + 1, 16], each within `error`."""
    above, below = (c > error).all(axis=1), (c < -error).all(axis=1)
    if above.all():
        return "empty"
    if above[0] and below[-1]:
        if (np.diff(c, axis=0) < -2.0 * error).all():
            return "single"
        certain = int(np.logical_and.accumulate(above).sum() + np.logical_and.accumulate(below[::-1]).sum())
        if certain >= len(c) - 1:
            return "single"
    return "open"


def following(path: int, depth: int) -> tuple[int, int] | None:
    """Return the piece behind (path, depth): the binary digits of a path lead to it. None behind the last one."""
    ended = (path & ~(path + 1)).bit_count()  # far halves that end with this piece, and it itself if it is one
    return None if ended > depth else ((path >> ended) + 1, depth - ended)


def pieces_judged(
    net: Floats, error_at: Callable[[int], float], deepest: int, judge: Judge = judged, behind: Next = following
) -> Iterator[tuple[int, int, str, Floats]]:
    """Halve a net from its near end on; yield path, depth, verdict and control values of each piece that is decided.

    The last piece is single or open, or all of the pieces are empty.
    """
    far: dict[int, Floats] = {}
    c, path, depth = net, 1, 0
    while True:
        verdict = judge(c, error_at(depth))
        if verdict == "open" and depth < deepest:
            c, far[depth] = halves(c)
            path, depth = 2 * path, depth + 1
            continue
        yield path, depth, verdict, c
        place = behind(path, depth) if verdict == "empty" else None
        if place is None:
            return
        path, depth = place
        c = far[depth - 1]


def span_of(path: int, depth: int) -> tuple[float, float]:
    """Return the part of [0, 1] that a path leads to."""
    width = 0.5**depth
    return (path - 2**depth) * width, (path - 2**depth + 1) * width


def roots(tile: Tile, place: Floats, start: float, stop: float) -> list[float]:
    """Return the depths of the roots along a place's ray in [start, stop], ascending, each as often as it counts."""
    with flint.ctx.workprec(BITS):
        found = tile.polynomial(*map(float, place)).complex_roots()
        real = [float(root.real.mid()) for root in found if root.imag.contains(0)]
    return sorted(value for value in real if start <= value <= stop)
