"""The rounding errors of a tile in float32, as shares of their worst case (docs/tiles.md, step 4): a model in numpy.

The model fits, makes the net and halves in float32, in the order of the kernels. What it gets is held against the same
in exact arithmetic.
"""

from __future__ import annotations

from functools import cache, reduce

import flint
import numpy as np
import pytest

import surfaces
from harness.kernels import fourths
from harness.kernels.fitting import fit_tables, inverse
from harness.kernels.rounding import value_errors
from surfaces.lowering import real_tape
from surfaces.numbers import BallPolynomials
from surfaces.tape import walk

from . import tile_model as model
from .test_tile_bounds import surface_of, tiles_of

ROUNDOFF = 2.0**-24
HALVINGS = 4
BALLAST, MIXING = 7.0, 220.0  # roundoffs of the net: of the largest coefficient, and of the largest difference of lanes


class Singles:
    """Run a tape in float32."""

    def const(self, value):
        return np.float32(float(value))

    def add(self, a, b):
        return np.asarray(a + b, np.float32)

    def sub(self, a, b):
        return np.asarray(a - b, np.float32)

    def neg(self, a):
        return -a

    def mul(self, a, b):
        return np.asarray(a * b, np.float32)

    def sqr(self, a):
        return self.mul(a, a)

    def div(self, a, b):
        return np.asarray(a / b, np.float32)


def dot(weights, values):
    return reduce(np.add, [w * v for w, v in zip(weights, values, strict=True)])


def fitted(samples):
    """Return the Bernstein coefficients float32[n + 1, 16] of samples, by the plain products of the kernels."""
    n = len(samples) - 1
    tables = fit_tables(n, "bernstein", "float32")
    evens, odds = n // 2 + 1, (n + 1) // 2
    even = np.array(tables["EVEN_HI"], np.float32).reshape(evens, evens)
    odd = np.array(tables["ODD_HI"], np.float32).reshape(odds, odds)
    sums = [samples[n - i] + samples[i] if i < odds else samples[i] for i in range(evens)]
    differences = [samples[n - i] - samples[i] for i in range(odds)]
    c = np.zeros_like(samples)
    for r in range(odds):
        e, o = dot(even[r], sums), dot(odd[r], differences)
        c[r], c[n - r] = e - o, e + o
    if evens > odds:
        c[n // 2] = dot(even[odds], sums)
    return c


def mixed(c):
    """Return the net float32[n + 1, 16] of coefficients along the node rays, by differences as the kernels do."""
    matrix, net = model.control_matrix().astype(np.float32), c.reshape(-1, 4, 4)
    for axis in (2, 1):
        rows = np.moveaxis(net, axis, 0)
        made = [
            rows[i] + reduce(np.add, [matrix[i, i ^ k] * (rows[i ^ k] - rows[i]) for k in (1, 2, 3)]) for i in range(4)
        ]
        net = np.moveaxis(np.array(made), 0, axis)
    return net.reshape(len(c), 16)


def halves(c):
    """Return both halves in float32: sums are not halved until the end."""
    n, far, near = len(c) - 1, c.copy(), [c[0]]
    for r in range(1, n + 1):
        far[: n - r + 1] += far[1 : n - r + 2]
        near.append(np.float32(2.0**-r) * far[0])
    return np.array(near), far * np.float32(2.0) ** -np.arange(n, -1, -1).astype(np.float32)[:, None]


class Rounded:
    """Hold a tile's node rays in float32, and what is computed on a piece of them."""

    def __init__(self, tile, start, stop):
        self.tile, center = tile, np.array(tile.surface.domain.center)
        eye, forward, right, up = tile.camera
        middle = np.float32((center - eye) @ forward)
        base = (eye + float(middle) * forward).astype(np.float32)
        forward, right, up = (row.astype(np.float32) for row in (forward, right, up))
        nodes = np.array(fourths.NODES, np.float32)
        x = np.tile(np.float32(tile.middle[0]) + np.float32(tile.half[0]) * nodes, 4)
        y = np.repeat(np.float32(tile.middle[1]) + np.float32(tile.half[1]) * nodes, 4)
        self.origins = [base[k] + (middle * x) * right[k] + (middle * y) * up[k] for k in range(3)]
        self.ways = [forward[k] + x * right[k] + y * up[k] for k in range(3)]
        self.start = np.float32(start - float(middle))
        self.reach = np.float32(stop - float(middle)) - self.start
        self.piece = float(self.start) + float(middle), float(self.start) + float(self.reach) + float(middle)
        places = np.array(fit_tables(tile.degree, "bernstein", "float32")["NODES"], np.float32)
        self.samples = np.array([self.values(self.start + self.reach * place) for place in places])
        ends = np.array([[o + t * d for o, d in zip(self.origins, self.ways, strict=True)] for t in self.ends])
        self.away = float(np.linalg.norm(ends - center[:, None], axis=1).max())

    @property
    def ends(self):
        return self.start, self.start + self.reach

    def values(self, t):
        point = {axis: self.origins[k] + t * self.ways[k] for k, axis in enumerate("xyz")}
        (value,) = walk(real_tape(surfaces.tape_of(self.tile.surface)), Singles(), point)
        return np.broadcast_to(np.asarray(value, np.float32), 16)

    def exact(self):
        """Return the exact coefficients float64[n + 1, 16] along the node rays as they are after rounding."""
        tape, found = real_tape(surfaces.tape_of(self.tile.surface)), []
        with flint.ctx.workprec(model.BITS):
            start, stop = float(self.start), float(self.start) + float(self.reach)
            for lane in range(16):
                lines = {
                    axis: flint.arb_poly([float(self.origins[k][lane]), float(self.ways[k][lane])])
                    for k, axis in enumerate("xyz")
                }
                along = flint.arb_poly(walk(tape, BallPolynomials(), lines)[0])
                found.append([float(c.mid()) for c in model.coefficients_on(along, self.tile.degree, start, stop)])
        return np.array(found).T


def largest_share(computed, exact, weights, bound_at):
    """Return the largest share of its bound that an error is, at any depth; `weights` make rays of the 16 values."""
    share, pieces = 0.0, [(computed, exact)]
    for depth in range(HALVINGS + 1):
        for near, true in pieces:
            share = max(share, float((np.abs((near - true) @ weights) / bound_at(depth)).max()))
        pieces = [pair for near, true in pieces for pair in zip(halves(near), model.halves(true), strict=True)]
    return share


@cache
def columns(degree):
    return np.array(
        [max(abs(float(row[i])) for row in inverse(degree, "bernstein", "float32")) for i in range(degree + 1)]
    )


def shares(tile, start, stop):
    """Return the largest share of a tile's net, and of its node rays each for itself, as bernstein casts them."""
    rounded, n = Rounded(tile, start, stop), tile.degree
    shell = min(int(rounded.away * 16.0 / tile.surface.domain.radius), 15)
    off = ROUNDOFF * value_errors(tile.surface, 16, 6.0)[shell]
    c, growth = fitted(rounded.samples), model.growth(n)
    fit = 2.0 * ROUNDOFF * (n // 2 + 6) * (columns(n)[:, None] * np.abs(rounded.samples.astype(float))).sum(axis=0)
    alone = largest_share(
        c, rounded.exact(), np.eye(16), lambda d: growth[d] * off + fit + n * (d + 1) * ROUNDOFF * np.abs(c).max(axis=0)
    )
    net, square = mixed(c), fourths.interpolation(fourths.NODES)[1] ** 2
    made = ROUNDOFF * (BALLAST * np.abs(c).max() + MIXING * np.ptp(c, axis=1).max())
    with flint.ctx.workprec(model.BITS):
        exact = tile.net(*rounded.piece)
    powers = np.array([[1.0, 3.0, 3.0, 1.0]] * 5) * np.array(
        [[((1 - v) / 2) ** (3 - j) * ((1 + v) / 2) ** j for j in range(4)] for v in (-1.0, -0.7, 0.0, 0.7, 1.0)]
    )
    weights = np.einsum("ai,bj->ijab", powers, powers).reshape(16, -1)
    together = largest_share(
        net,
        exact,
        weights,
        lambda d: square * (growth[d] * off + fit.max()) + made + n * (d + 1) * ROUNDOFF * np.abs(net).max(),
    )
    return together, alone


@pytest.mark.parametrize("case", ["torus", "tangle", "barth_sextic", "sixteen_ball", 3, 5, 9])
def test_rounding_errors_are_small_shares_of_their_worst_case(case):
    """A tile's are below 1/32 of it, and, over some tiles, no larger shares than those of its rays cast alone."""
    found = np.array([shares(*piece) for piece in tiles_of(surface_of(case), 5, 3)])
    assert found[:, 0].max() < 1.0 / 32.0
    assert found[:, 0].max() <= found[:, 1].max()
