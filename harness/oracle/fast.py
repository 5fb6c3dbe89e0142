"""Find first hits of many rays at once in float64, and accept only those that a rigorous error bound certifies.

**Theory.** A ray is cut into segments along the outer clip interval [a, b], whose ends enclose the exact ones. Each
segment is proved to have no root, or to have exactly one, a simple one with opposite proved signs at the segment's ends
(`isolate`: by Bernstein coefficients for polynomials, by ranges of f and f' for everything else). The first segment
with a root, if nothing before it is undecided, holds the first root of [a, b]. A few safeguarded Newton steps in plain
float64 guess that root. The guess is not trusted: f is evaluated in ball arithmetic on both sides of it, and opposite
proved signs inside the segment are the certificate. A ray is left to the slow path if any of that fails, or if the root
is not proved to lie inside the exact clip interval.

If f is written as a product with repeated factors, such as a plane squared, all this is done for its radical, in which
each factor is taken once. Touches of f are crossings of the radical; the factor that changes its sign tells the
multiplicity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from harness.contract import Domain, TruthStatus
from harness.oracle.balls64 import Floats
from harness.oracle.bernstein64 import BernsteinIsolator
from harness.oracle.clip import clip_many, recentred
from harness.oracle.enclosure import Enclosure
from harness.oracle.floats import FloatFunction
from harness.oracle.graph import Graph
from harness.oracle.program import program_of
from harness.oracle.range64 import RangeIsolator
from harness.oracle.segments import Mask, Segments

BLOCK = 2048  # rays at a time, so that the arrays stay in the cache
FEWEST = 64  # rays at a time of a long formula, which holds many arrays
LONG = 1000  # instructions from which on a block has fewer rays
MOST_DEGREE = 32  # beyond it the collocation matrix is too ill-conditioned for float64
WIDTHS = (2.0**-44, 2.0**-42, 2.0**-41)  # the widths of certified intervals that are tried, in domain radii


@dataclass(frozen=True)
class FastAnswers:
    """Hold answers for n rays; those that are `decided` are certified."""

    decided: NDArray[np.bool_]
    status: NDArray[np.uint8]
    lower: Floats
    upper: Floats

    @staticmethod
    def joined(parts: Sequence[FastAnswers]) -> FastAnswers:
        """Return the answers of several blocks of rays, one after the other."""
        return FastAnswers(*(np.concatenate([getattr(part, name) for part in parts]) for name in _NAMES))


_NAMES = tuple(FastAnswers.__annotations__)


class FastSolver:
    """Find first hits by float64 ball arithmetic on all rays at once."""

    def __init__(self, graph: Graph, domain: Domain) -> None:
        self.domain = domain
        radical, factors = graph.radical(graph.output)
        program = program_of(graph, radical)
        self.f = Enclosure(program_of(graph, radical, lengths=True))
        self.floats = FloatFunction(program, [c.mid for c in Enclosure(program).constants])
        self.factors = [
            (Enclosure(program_of(graph, factor, lengths=True)), multiplicity) for factor, multiplicity in factors
        ]
        self.block = max(FEWEST, BLOCK * LONG // max(LONG, len(self.f.program.instructions)))  # rays at a time
        small = program.is_polynomial and program.degree <= MOST_DEGREE
        self.isolate = (BernsteinIsolator if small else RangeIsolator)(self.f)

    def first_hits(self, rays: Floats, t_min: float) -> FastAnswers:
        """Return the answers for rays float64[n, 6] that hold float32 values."""
        starts = range(0, max(len(rays), 1), self.block)
        return FastAnswers.joined([self._block(rays[k : k + self.block], t_min) for k in starts])

    def _block(self, rays: Floats, t_min: float) -> FastAnswers:
        """Return the answers for a block of rays."""
        with np.errstate(all="ignore"):
            clip = clip_many(self.domain, rays, t_min)
            status = np.full(len(rays), TruthStatus.MISS, dtype=np.uint8)
            lower, upper = np.full(len(rays), np.nan), np.full(len(rays), np.nan)
            decided = clip.missed.copy()
            inside = np.flatnonzero(~clip.missed & np.isfinite(clip.enter_lower) & np.isfinite(clip.leave_upper))
            segments = self.isolate(rays[inside], clip.enter_lower[inside], clip.leave_upper[inside])
            decided[inside[segments.empty]] = True
            hit = inside[segments.found]
            found = self._narrow(rays[hit], segments.take(segments.found))
            odd, proved = self._parity(rays[hit], *found)
            proved &= (found[0] >= clip.enter_upper[hit]) & (found[1] <= clip.leave_lower[hit])
            hit = hit[proved]
            lower[hit], upper[hit] = found[0][proved], found[1][proved]
            status[hit] = np.where(odd[proved], TruthStatus.CROSSING, TruthStatus.TOUCH)
            decided[hit] = True
        return FastAnswers(decided, status, lower, upper)

    def _narrow(self, rays: Floats, segments: Segments) -> tuple[Floats, Floats]:
        """Return certified bounds of each segment's root, float64[n] each: the lower and the upper.

        They are NaN where the signs could not be proved.
        """
        guess = self._guess(rays, segments)
        length = np.sqrt((rays[:, 3:] ** 2).sum(axis=1))
        direction = np.where(segments.rising, 1, -1)
        lower, upper = np.full(len(rays), np.nan), np.full(len(rays), np.nan)
        left = np.arange(len(rays))
        for width in WIDTHS:
            room = 0.5 * width * self.domain.radius / length[left] + np.abs(guess[left]) * 2.0**-51
            below = np.maximum(guess[left] - room, segments.lower[left])
            above = np.minimum(guess[left] + room, segments.upper[left])
            signs = self.f.along(rays[left], below).sign, self.f.along(rays[left], above).sign
            proved = (signs[0] == -direction[left]) & (signs[1] == direction[left]) & (below < above)
            lower[left[proved]], upper[left[proved]] = below[proved], above[proved]
            left = left[~proved]
        return lower, upper

    def _parity(self, rays: Floats, lower: Floats, upper: Floats) -> tuple[Mask, Mask]:
        """Return bool[n] each: whether the root's multiplicity in f itself is odd, and whether that is proved.

        The interval holds one root of the radical, so that no factor has a second root there. The factors that vanish
        change their sign, and f changes its sign if their multiplicities add up to an odd number.
        """
        odd = np.full(len(rays), not self.factors)
        proved = np.isfinite(lower)
        for factor, multiplicity in self.factors:
            change = factor.along(rays, lower).sign * factor.along(rays, upper).sign
            proved &= change != 0
            odd ^= (change < 0) & (multiplicity % 2 == 1)
        return odd, proved

    def _guess(self, rays: Floats, segments: Segments) -> Floats:
        """Return float64[n]: each segment's root, in plain float64.

        A root is computed from the segment's lower end, so that a distant origin costs no digits.
        """
        near = recentred(rays, segments.lower)
        length = segments.upper - segments.lower
        return segments.lower + self.floats.root_between(near, np.zeros_like(length), length, segments.rising)
