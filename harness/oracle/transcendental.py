"""Find the first hit of one ray with a surface that is no polynomial: by ranges in ball arithmetic, then exactly.

Crossings and misses are proved as in `range64`, with rising precision. Touches, hits at kinks or where a square root's
argument is 0, and hits exactly at a clip end are decided by `piecewise` on the short pieces that ranges leave open, if
f is made of polynomials, quotients, square roots, abs, min and max. With other functions, or with pi or e, such rays
stay undecided.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import hypot, ldexp
from typing import Any

from flint import arb, fmpq

from harness.contract import Domain, TruthStatus
from harness.oracle import reals
from harness.oracle.bernstein import Undecidable
from harness.oracle.clip import End, clip_exactly
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.graph import Graph
from harness.oracle.jumps import Sided, meets_cut, sides
from harness.oracle.piecewise import PiecewiseSolver, exact_program
from harness.oracle.program import Program, program_of
from harness.oracle.pruning import is_prunable, pruned
from harness.oracle.reals import float_above, float_below, precision, rational
from harness.oracle.slow import MISS, UNDECIDED, FirstHit, certified_hit

PRECISIONS = (80, 256)
OPEN = 2.0**-28  # the width, in domain radii, below which pieces that ranges leave open are decided exactly
MOST_PIECES = 3000  # that are tried for one ray and precision
MOST_OPERATIONS = 2_000_000  # that are spent on pieces, so that a long formula has fewer of them
FEWEST_PIECES = 60
PRUNED = 0.9  # the share of a program's length above which pruning it was not worth it
PAUSE = 6  # pieces after which it is tried again then
NARROW = 2.0**-50  # the width of certified intervals, in domain radii


@dataclass
class SmoothSolver:
    """Find first hits of single rays with the surface that a graph describes."""

    graph: Graph
    domain: Domain

    def __post_init__(self) -> None:
        self.program = program_of(self.graph, lengths=True)
        self.exact = exact_program(self.graph)
        self.constants: dict[int, list[Any]] = {}

    def first_hit(self, ray: Sequence[float], t_min: float = 0.0) -> FirstHit:
        """Return the first hit of a ray, six floats. They and `t_min` are taken as exact rationals."""
        exact_ray = [rational(v) for v in ray]
        ends = clip_exactly(self.domain, exact_ray, t_min)
        if ends is None:
            return MISS
        scale = self.domain.radius / hypot(*ray[3:])
        exact = PiecewiseSolver(self.exact, exact_ray, ends, t_min) if self.exact else None
        for bits in PRECISIONS[:1] if exact else PRECISIONS:
            try:
                with precision(bits):
                    if bits not in self.constants:
                        self.constants[bits] = self.program.constants.converted(reals.leaf, reals.FUNCTIONS)
                    search = _Search(self.program, self.constants[bits], ray, scale, t_min)
                    floor = scale * OPEN if exact else ldexp(scale, -bits // 2)
                    return search.first_hit(ends, floor, exact)
            except Undecidable:
                continue
        return UNDECIDED


class _Search:
    """Hold the search on one ray at one precision; `scale` is the domain's radius in units of t."""

    def __init__(
        self, program: Program, constants: list[Any], ray: Sequence[float], scale: float, t_min: float
    ) -> None:
        self.program = program
        self.constants = constants
        self.duals = [Dual(c, arb(0)) for c in constants]
        self.axes = [(arb(o), arb(d)) for o, d in zip(ray[:3], ray[3:], strict=True)]
        self.scale = scale
        self.t_min = t_min
        self.pause = 0  # pieces for which pruning is not tried again

    def prunes(self, program: Program) -> bool:
        """Return whether pruning a program for the next piece is worth trying."""
        if self.pause:
            self.pause -= 1
            return False
        return is_prunable(program)

    def first_hit(self, ends: tuple[End, End], floor: float, exact: PiecewiseSolver | None) -> FirstHit:
        """Return the first hit, from pieces tried from front to back.

        A piece narrower than `floor` that stays open is left to `exact`. Raises Undecidable if that is None, and if
        there are too many pieces.
        """
        enter, leave = (end.ball() for end in ends)
        room = self.scale * 2.0**-20 + abs(float(leave)) * 2.0**-40
        stack = [(arb(float_below(enter) - room), arb(float_above(leave) + room), self.program)]
        affordable = MOST_OPERATIONS // len(self.program.instructions)
        for _ in range(min(MOST_PIECES, max(FEWEST_PIECES, affordable))):
            if not stack:
                return MISS
            lower, upper, program = stack.pop()
            if upper < enter or lower > leave:
                continue
            piece = _Piece(self, program, lower, upper)
            if piece.is_empty():
                continue
            try:
                root = piece.single_root()
                narrow = root is not None or upper - lower < floor
            except Undecidable:  # it has a root, which this precision does not narrow enough
                root, narrow = None, True
            if not narrow:
                middle = (lower + (upper - lower) * 0.484375).mid()
                stack += [(middle, upper, piece.program), (lower, middle, piece.program)]
            elif root is not None and root > leave:
                return MISS
            elif root is not None and root >= enter and root <= leave:
                return certified_hit(TruthStatus.CROSSING, root, self.t_min)
            elif root is None or not root < enter:
                found = self.decide(exact, lower, upper)
                if found:
                    return found
        if exact and stack:
            return self.decide(exact, stack[-1][0], stack[0][1]) or MISS
        raise Undecidable("too many pieces")

    def decide(self, exact: PiecewiseSolver | None, lower: Any, upper: Any) -> FirstHit | None:
        """Return the first hit in a piece by exact arithmetic, None if there is none. Raises Undecidable."""
        if exact is None:
            raise Undecidable("a piece stays open, or a root may lie at an end")
        return exact.first_hit(lower.fmpq(), upper.fmpq(), self.scale * NARROW)


class _Piece:
    """Hold an interval of t, and f's program, which is shortened for it."""

    def __init__(self, search: _Search, program: Program, lower: Any, upper: Any) -> None:
        self.search = search
        self.program = program
        self.lower = lower
        self.upper = upper
        self.whole = lower.union(upper)
        inputs = [Dual(o + d * self.whole, d) for o, d in search.axes]
        if not search.prunes(program):
            self.f = program.run(inputs, search.duals, DUAL_FUNCTIONS)
            return
        results: list[Dual] = program.results(inputs, search.duals, DUAL_FUNCTIONS)
        self.f = results[-1]
        if self.f.value.contains(0):
            self.program = pruned(program, [r.value for r in results])
            search.pause = 0 if len(self.program.instructions) < PRUNED * len(program.instructions) else PAUSE

    def value(self, t: Any) -> Any:
        """Enclose f at a ball in the piece."""
        return self.program.run([o + d * t for o, d in self.search.axes], self.search.constants, reals.FUNCTIONS)

    def slope(self, t: Any) -> Any:
        """Enclose f's slope over a ball in the piece."""
        inputs = [Dual(o + d * t, d) for o, d in self.search.axes]
        return self.program.run(inputs, self.search.duals, DUAL_FUNCTIONS).slope

    def is_empty(self) -> bool:
        """Return whether the piece is proved to hold no root."""
        if not self.f.value.contains(0):
            return True
        middle = self.whole.mid()
        if not (self.value(middle) + self.f.slope * (self.whole - middle)).contains(0):
            return True
        return self.program.jumps and not self.f.slope.is_finite() and self.is_empty_on_all_sides()

    def is_empty_on_all_sides(self) -> bool:
        """Return whether f is proved to be off 0 on all sides of the jumps that are open on the piece."""
        points = [o + d * self.whole for o, d in self.search.axes]
        constants = self.search.constants
        return not any(self.program.run(points, constants, Sided(s).functions()).contains(0) for s in sides())

    def single_root(self) -> Any:
        """Return the piece's root as a ball of t; None if it is not proved to hold exactly one with opposite signs.

        Raises Undecidable if the root is not narrowed to NARROW.
        """
        lower, upper, scale = self.lower, self.upper, self.search.scale
        if self.f.slope.contains(0):
            return None
        first, last = self.value(lower), self.value(upper)
        if first.contains(0) or last.contains(0) or (first > 0) == (last > 0):
            return None
        rising = last > 0
        while upper - lower > scale * NARROW:
            whole = lower.union(upper)
            middle = whole.mid()
            value = self.value(middle)
            step = middle - value / self.slope(whole)
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
    """Return the generalised derivative of abs: ±1, or [−1, 1] if the sign is not known."""
    return arb(1) if a > 0 else arb(-1) if a < 0 else arb(0, 1)


def _pick(sign: Any, a: Any, b: Any) -> Any:
    """Return `a` if the sign is 1, `b` if it is −1, else a ball that holds both."""
    return a if sign == 1 else b if sign == -1 else a.union(b)


def _ratio(slope: Any, root: Any) -> Any:
    """Return slope / root, which is 0 if the slope is."""
    return slope if slope == 0 else slope / root


def _share(part: Any, whole: Any) -> Any:
    """Enclose part / whole where |part| <= whole is known."""
    share = part / whole
    if not share.is_finite():
        return arb(0, 1)
    return max(share.lower(), arb(-1)).union(min(share.upper(), arb(1)))


def _scale(a: Any, factor: Fraction) -> Any:
    """Return a rational times a ball."""
    return a * fmpq(factor.numerator, factor.denominator)


def _step_slope(value: Any) -> Any:
    """Return the slope of what is constant between jumps: 0 if `value` is one number, else NaN."""
    return arb(0) if value.is_exact() and value.is_finite() else arb.nan()


def _select_slope(c: Any, p: Any, q: Any) -> Any:
    """Return the slope of a select; NaN if the condition leaves open which part is taken."""
    return p if c > 0.5 else q if c < 0.5 else arb.nan()


def _atan2_slope(y: Any, x: Any, dy: Any, dx: Any) -> Any:
    """Enclose the derivative of atan2; NaN if the box may meet the cut."""
    if meets_cut(y, x):
        return arb.nan()
    return (x * dy - y * dx) / (reals.square(x) + reals.square(y))


DUAL_FUNCTIONS = dual_functions({
    **reals.FUNCTIONS, "sign": _sign, "scale": _scale, "pick": _pick, "ratio": _ratio, "share": _share,
    "step_slope": _step_slope, "select_slope": _select_slope, "atan2_slope": _atan2_slope,
})  # fmt: skip
