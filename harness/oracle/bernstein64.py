"""Isolate first roots of polynomials along many rays by Bernstein coefficients in float64, with rigorous error bounds.

**Theory.** f is evaluated in ball arithmetic at degree + 1 dyadic nodes of the clip interval. The coefficients are M·f,
where M is the exact inverse of the Bernstein collocation matrix, rounded once. A dot product of length m, in any order,
fused or not, has an error of at most γ_m Σ|M_ij f_j| (Higham 2002, §3.1); the rounding of M adds u of the same sum.
(m + 4)·2^-52 of the sum covers both. De Casteljau's halving only averages, so that each of its `degree` levels has an
error of at most u times the largest coefficient. The signs of coefficients larger than their error bound then prove
what they prove in `bernstein`.
"""

from __future__ import annotations

from functools import cache
from math import comb

import numpy as np

from harness.oracle.balls64 import GROW, TINY, UNIT, Balls, Floats
from harness.oracle.clip import points_at
from harness.oracle.enclosure import Enclosure
from harness.oracle.segments import Pieces, Segments, Verdict, first_segments

DEPTH = 30
NODE_BITS = 20


@cache
def _collocation(degree: int) -> tuple[Floats, Floats]:
    """Return dyadic nodes near the Chebyshev-Lobatto points of [0, 1], and the rounded inverse collocation matrix.

    With n = degree + 1, the nodes are float64[n] and the matrix is float64[n, n].
    """
    from flint import fmpq, fmpq_mat

    count = degree + 1
    angles = np.pi * np.arange(count) / degree
    whole = [round((0.5 - 0.5 * np.cos(a)) * 2**NODE_BITS) for a in angles]
    nodes = [fmpq(w, 2**NODE_BITS) for w in whole]
    matrix = fmpq_mat(
        count, count, [comb(degree, i) * s**i * (1 - s) ** (degree - i) for s in nodes for i in range(count)]
    )
    inverse = matrix.inv()
    # dividing Python ints rounds correctly
    entries = [[int(inverse[i, j].p) / int(inverse[i, j].q) for j in range(count)] for i in range(count)]
    return np.array(whole) / 2**NODE_BITS, np.array(entries)


class BernsteinIsolator:
    """Isolate the first roots of a polynomial along rays."""

    def __init__(self, f: Enclosure) -> None:
        self.f = f
        self.nodes, self.matrix = _collocation(max(f.program.degree, 1))

    def __call__(self, rays: Floats, lower: Floats, upper: Floats) -> Segments:
        """Return the first segment of each ray between t = `lower` and `upper`, both float64[n] and finite."""
        count = len(rays)
        coefficients, error = self.coefficients(rays, lower, upper)
        whole = Pieces(np.arange(count), np.zeros(count), np.ones(count), (coefficients, error))
        in_s = first_segments(count, whole, _judge, _halve, DEPTH)
        # s is exact; the ends are moved inwards by more than the rounding of lower + s·(upper − lower)
        pad = (np.abs(lower) + np.abs(upper)) * 2.0**-50
        t_lower = lower + in_s.lower * (upper - lower) + pad
        t_upper = lower + in_s.upper * (upper - lower) - pad
        return Segments(t_lower, t_upper, in_s.rising, in_s.found, in_s.empty)

    def coefficients(self, rays: Floats, lower: Floats, upper: Floats) -> tuple[Floats, Floats]:
        """Return coefficients on [lower, upper], float64[n, degree + 1], and bounds of their errors, float64[n]."""
        span = Balls(upper[:, None]) - Balls(lower[:, None])
        nodes = Balls(self.nodes)
        inputs = [
            Balls(p.mid[:, None], p.rad[:, None]) + nodes * (span * Balls(rays[:, 3 + k, None]))
            for k, p in enumerate(points_at(rays, lower))
        ]
        values = self.f.of(inputs)
        shape = (len(rays), len(self.nodes))
        mid, rad = np.broadcast_to(values.mid, shape), np.broadcast_to(values.rad, shape)
        coefficients = mid @ self.matrix.T
        charge = (rad + (len(self.nodes) + 4) * UNIT * np.abs(mid)) @ np.abs(self.matrix).T
        return coefficients, charge.max(axis=1) * (GROW + 4 * len(self.nodes) * UNIT) + TINY


def _judge(pieces: Pieces) -> Verdict:
    """Return what the signs of the coefficients prove."""
    b, error = pieces.data
    positive, negative = b > error[:, None], b < -error[:, None]
    signs = positive.view(np.int8) - negative.view(np.int8)
    steps = np.diff(signs, axis=1)
    rising = (signs[:, 0] == -1) & (signs[:, -1] == 1) & (steps >= 0).all(axis=1)
    falling = (signs[:, 0] == 1) & (signs[:, -1] == -1) & (steps <= 0).all(axis=1)
    empty = np.asarray(positive.all(axis=1) | negative.all(axis=1))
    hopeless = np.asarray(~(positive | negative).any(axis=1))
    return Verdict(empty, rising | falling, rising, hopeless)


def _halve(pieces: Pieces) -> Pieces:
    """Return both halves of all pieces, with their coefficients."""
    b, error = pieces.data
    degree = b.shape[1] - 1
    left, right = np.empty_like(b), np.empty_like(b)
    largest = np.abs(b).max(axis=1)
    row = b
    left[:, 0], right[:, degree] = row[:, 0], row[:, -1]
    for level in range(1, degree + 1):
        row = 0.5 * (row[:, :-1] + row[:, 1:])
        left[:, level], right[:, degree - level] = row[:, 0], row[:, -1]
    error = (error + degree * UNIT * largest) * GROW + TINY
    middle = 0.5 * (pieces.lower + pieces.upper)  # exact: s has at most DEPTH bits
    return Pieces(
        np.concatenate((pieces.ray, pieces.ray)),
        np.concatenate((pieces.lower, middle)),
        np.concatenate((middle, pieces.upper)),
        (np.concatenate((left, right)), np.concatenate((error, error))),
    )
