"""The first hit of one ray with a surface that is not a polynomial: bisection and interval Newton in ball arithmetic.

Crossings and misses are proved as in `range64`, with rising precision. A touch of such a surface cannot be proved by
ranges, nor can a root that lies exactly at a clip end: those rays stay undecided.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ldexp, sqrt
from typing import Any

from flint import arb

from harness.contract import Domain, TruthStatus
from harness.oracle import reals
from harness.oracle.bernstein import Undecidable
from harness.oracle.clip import End, clip_exactly
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.program import Program, convert_constants
from harness.oracle.reals import float_above, float_below, precision, rational
from harness.oracle.slow import MISS, UNDECIDED, FirstHit, certified_hit

PRECISIONS = (80, 256)
MOST_PIECES = 3000  # looked at for one ray and precision
NARROW = 2.0**-50  # width of certified intervals, in domain radii


@dataclass(frozen=True)
class SmoothSolver:
    """First hits of single rays."""

    program: Program
    domain: Domain

    def first_hit(self, ray: Sequence[float]) -> FirstHit:
        """`ray`: six floats, taken as the exact rationals they are."""
        ends = clip_exactly(self.domain, [rational(v) for v in ray])
        if ends is None:
            return MISS
        for bits in PRECISIONS:
            try:
                with precision(bits):
                    constants = convert_constants(self.program, reals.leaf, reals.FUNCTIONS)
                    scale = self.domain.radius / sqrt(sum(v * v for v in ray[3:]))
                    return _Search(self.program, constants, ray, scale).first_hit(ends, ldexp(scale, -bits // 2))
            except Undecidable:
                continue
        return UNDECIDED


class _Search:
    """One ray at one precision; `scale` is the domain's radius in units of t."""

    def __init__(self, program: Program, constants: list[Any], ray: Sequence[float], scale: float) -> None:
        self.program = program
        self.constants = constants
        self.duals = [Dual(c, arb(0)) for c in constants]
        self.axes = [(arb(o), arb(d)) for o, d in zip(ray[:3], ray[3:], strict=True)]
        self.scale = scale

    def value(self, t: Any) -> Any:
        return self.program.run([o + d * t for o, d in self.axes], self.constants, reals.FUNCTIONS)

    def range(self, t: Any) -> Dual:
        inputs = [Dual(o + d * t, d) for o, d in self.axes]
        result: Dual = self.program.run(inputs, self.duals, DUAL_FUNCTIONS)
        return result

    def first_hit(self, ends: tuple[End, End], floor: float) -> FirstHit:
        """Pieces from front to back; Undecidable where one stays open below the width `floor`."""
        enter, leave = (end.ball() for end in ends)
        room = self.scale * 2.0**-20 + abs(float(leave)) * 2.0**-40
        stack = [(arb(float_below(enter) - room), arb(float_above(leave) + room))]
        for _ in range(MOST_PIECES):
            if not stack:
                return MISS
            lower, upper = stack.pop()
            if upper < enter or lower > leave or self.is_empty(lower, upper):
                continue
            root = self.single_root(lower, upper)
            if root is None:
                if upper - lower < floor:
                    raise Undecidable("a piece stays open")
                middle = (lower + (upper - lower) * 0.484375).mid()
                stack += [(middle, upper), (lower, middle)]
            elif root > leave:
                return MISS
            elif root >= enter and root <= leave:
                return certified_hit(TruthStatus.CROSSING, root)
            elif not root < enter:
                raise Undecidable("a root may lie at an end")
        raise Undecidable("too many pieces")

    def is_empty(self, lower: Any, upper: Any) -> bool:
        whole = lower.union(upper)
        f = self.range(whole)
        if not f.value.contains(0):
            return True
        middle = whole.mid()
        return not (self.value(middle) + f.slope * (whole - middle)).contains(0)

    def single_root(self, lower: Any, upper: Any) -> Any:
        """The root as a ball of t, or None where the piece is not proved to hold exactly one with opposite signs."""
        if self.range(lower.union(upper)).slope.contains(0):
            return None
        first, last = self.value(lower), self.value(upper)
        if first.contains(0) or last.contains(0) or (first > 0) == (last > 0):
            return None
        rising = last > 0
        while upper - lower > self.scale * NARROW:
            whole = lower.union(upper)
            middle = whole.mid()
            value = self.value(middle)
            step = middle - value / self.range(whole).slope
            tighter = max(lower, step.lower()), min(upper, step.upper())
            if 4 * (tighter[1] - tighter[0]) < 3 * (upper - lower):
                lower, upper = tighter
            elif value.contains(0) or not lower < middle < upper:
                raise Undecidable("the root is not known more narrowly")
            elif (value > 0) == rising:
                upper = middle
            else:
                lower = middle
        return lower.union(upper)


def _sign(a: Any) -> Any:
    return arb(1) if a > 0 else arb(-1) if a < 0 else arb(0, 1)


DUAL_FUNCTIONS = dual_functions({**reals.FUNCTIONS, "sign": _sign, "half": lambda a: a / 2})
