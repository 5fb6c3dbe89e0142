"""Find the first hit of one ray with an algebraic surface.

Balls of 128 bits are tried first. What they leave open is decided by exact arithmetic if that applies, else by balls of
up to 4096 bits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot, nan
from typing import TYPE_CHECKING, Any

from flint import arb, arb_poly, fmpq, fmpq_poly

from harness.contract import Domain, TruthStatus
from harness.oracle import reals, surd
from harness.oracle.bernstein import Bracket, Undecidable, brackets, to_bernstein
from harness.oracle.clip import End, clip_exactly
from harness.oracle.program import Program
from harness.oracle.reals import float_above, float_below, precision, rational

if TYPE_CHECKING:
    from harness.oracle.surd import Split, Surd

FIRST_PRECISION = 128  # bits; what this does not decide is decided by exact arithmetic, if that applies
PRECISIONS = (FIRST_PRECISION, 512, 2048, 4096)  # of balls if it does not apply, and to compare roots with clip ends


@dataclass(frozen=True)
class FirstHit:
    """Hold an answer for one ray: lower <= t* <= upper, or NaN if there is no hit; `status` is as in the contract."""

    status: TruthStatus
    lower: float = nan
    upper: float = nan


def certified_hit(status: TruthStatus, t: Any, t_min: float) -> FirstHit:
    """Return a hit somewhere in the ball `t`; the hit is known not to be before `t_min`."""
    return FirstHit(status, max(float_below(t), t_min), float_above(t))


MISS = FirstHit(TruthStatus.MISS)
UNDECIDED = FirstHit(TruthStatus.UNDECIDED)


@dataclass
class AlgebraicSolver:
    """Find first hits of single rays with one polynomial surface. Constants are converted once for each precision."""

    program: Program
    domain: Domain
    constants: dict[int, list[Any]] = field(default_factory=dict)
    surds: list[Any] | None = None

    def __post_init__(self) -> None:
        try:
            self.surds = self.program.constants.converted(surd.leaf, surd.FUNCTIONS)
        except surd.NotExact:
            self.surds = None

    def first_hit(self, ray: Sequence[float], t_min: float = 0.0) -> FirstHit:
        """Return the first hit of a ray, six floats. They and `t_min` are taken as exact rationals."""
        exact_ray = [rational(v) for v in ray]
        ends = clip_exactly(self.domain, exact_ray, t_min)
        if ends is None:
            return MISS
        reach = self.domain.radius / hypot(*ray[3:])
        exact = self.surds is not None
        for bits in PRECISIONS[:1] if exact else PRECISIONS:
            try:
                with precision(bits):
                    return self._by_balls(ray, ends, reach, bits, t_min)
            except Undecidable:
                continue
        try:
            return self._exactly(exact_ray, ends, reach, t_min) if exact else UNDECIDED
        except Undecidable:
            return UNDECIDED

    def _by_balls(self, ray: Sequence[float], ends: tuple[End, End], reach: float, bits: int, t_min: float) -> FirstHit:
        """Return the first hit by balls of `bits`; `reach` is the domain's radius in units of t. Raises Undecidable."""
        if bits not in self.constants:
            self.constants[bits] = self.program.constants.converted(reals.leaf, reals.FUNCTIONS)
            self.constants[bits] = [arb_poly([c]) for c in self.constants[bits]]
        enter, leave = (end.ball() for end in ends)
        start, width = _frame(enter, leave, reach)
        inputs = [arb_poly([arb(o) + arb(start) * d, arb(width) * d]) for o, d in zip(ray[:3], ray[3:], strict=True)]
        p = self.program.run(inputs, self.constants[bits], {})
        line = _Line(p, start, width, reach)
        for bracket in brackets(*_integers(p, bits), depth=bits):
            t = line.refine(bracket, bits)
            if t > leave:
                return MISS
            if t >= enter and t <= leave:
                return certified_hit(TruthStatus.CROSSING, t, t_min)
            if not t < enter:
                raise Undecidable("a root may lie at an end")
        return MISS

    def _exactly(self, ray: Sequence[Any], ends: tuple[End, End], reach: float, t_min: float) -> FirstHit:
        """Return the first hit by exact arithmetic.

        Balls are used only to compare roots with irrational clip ends, which are told apart or proved equal. Raises
        Undecidable if 4096 bits do not tell.
        """
        inputs = [surd.Surd(fmpq_poly([o, d])) for o, d in zip(ray[:3], ray[3:], strict=True)]
        assert self.surds is not None
        p = self.program.run(inputs, self.surds, {})
        if p.is_zero:
            with precision(FIRST_PRECISION):
                enter = ends[0].ball()
                return certified_hit(TruthStatus.TOUCH, enter, t_min)
        parts = surd.split(p)
        with precision(FIRST_PRECISION):
            start, width = _frame(ends[0].ball(), ends[1].ball(), reach)
        scaled = parts.carrier(fmpq_poly([rational(start), rational(width)]))
        if scaled.degree() <= 0:
            return MISS
        while not scaled[0] or not sum(scaled.coeffs()):  # a root is at an end of the frame: take a wider one
            start, width = start - width, 3.015625 * width
            scaled = parts.carrier(fmpq_poly([rational(start), rational(width)]))
        whole = [int(c) for c in scaled.numer().coeffs()]
        line = _Line(arb_poly(scaled), start, width, reach, scaled)
        for bracket in brackets(*to_bernstein(whole), depth=PRECISIONS[-1]):
            multiplicity = _multiplicity(line, bracket, parts)
            if not multiplicity:
                continue
            side, t = _place(line, bracket, parts.carrier, ends)
            if side > 0:
                return MISS
            if side == 0:
                return certified_hit(TruthStatus.CROSSING if multiplicity % 2 else TruthStatus.TOUCH, t, t_min)
        return MISS


def _frame(enter: Any, leave: Any, reach: float) -> tuple[float, float]:
    """Return floats start and width such that [start, start + width] holds the clip interval well inside."""
    lower, upper = float(enter.lower()), float(leave.upper())
    room = (upper - lower) * 0.0137 + reach * 2.0**-30 + max(abs(lower), abs(upper)) * 2.0**-48
    start = lower - room
    return start, (upper - start) + 0.93 * room


def _integers(p: Any, bits: int) -> tuple[list[int], int]:
    """Return the Bernstein coefficients of an arb_poly as integers, and a bound of their errors, in a common unit.

    Raises Undecidable if the polynomial may be zero.
    """
    parts = [(c.mid().man_exp(), c.rad().man_exp()) for c in p.coeffs()]
    top = max((int(e) + int(m).bit_length() for (m, e), _ in parts if m), default=0)
    unit = top - bits - 8  # the exponent of the unit
    whole, error = [], 0
    for (mantissa, exponent), (radius, radius_exponent) in parts:
        shift = int(exponent) - unit
        whole.append(int(mantissa) << shift if shift >= 0 else int(mantissa) >> -shift)
        error += shift < 0
        if radius:
            shift = int(radius_exponent) - unit
            error += (int(radius) << shift if shift >= 0 else int(radius) >> -shift) + 1
    if not whole:
        raise Undecidable("the polynomial may be zero")
    return to_bernstein(whole, error)


class _Line:
    """Hold a polynomial in s, where t = start + width·s, whose roots are returned as balls of t."""

    def __init__(self, p: Any, start: float, width: float, reach: float, exact: Any = None) -> None:
        self.p = p
        self.exact = exact  # the fmpq_poly of which `p` is the rounded one, or None
        self.slope = p.derivative()
        self.start = start
        self.width = width
        self.reach = reach  # the domain's radius in units of t

    def at_precision(self) -> _Line:
        """Return the same line with its exact polynomial rounded at the current precision."""
        return _Line(arb_poly(self.exact), self.start, self.width, self.reach, self.exact)

    def ends(self, bracket: Bracket) -> tuple[Any, Any]:
        """Return the bracket's ends as balls of t."""
        return self.t(arb((bracket.lower, -bracket.exponent))), self.t(arb((bracket.upper, -bracket.exponent)))

    def t(self, s: Any) -> Any:
        """Return the t of a ball s."""
        return arb(self.start) + arb(self.width) * s

    def refine(self, bracket: Bracket, bits: int) -> Any:
        """Return the bracket's root as a ball of t, narrower than the domain's radius · 2^-(bits·7/16).

        It takes interval Newton steps, and bisects where the slope may vanish; both cut away only what holds no root.
        Raises Undecidable if the polynomial is not known well enough.
        """
        target = arb(self.reach / self.width) * arb((1, -(bits * 7 // 16)))  # as a float it would be 0 at 4096 bits
        lower, upper = arb((bracket.lower, -bracket.exponent)), arb((bracket.upper, -bracket.exponent))  # exact
        while True:
            whole = lower.union(upper)
            gap = upper - lower
            if gap < target:
                return self.t(whole)
            middle = whole.mid()
            value = self.p(middle)
            slope = self.slope(whole)
            if not slope.contains(0):
                step = middle - value / slope
                below, above = step.lower(), step.upper()
                tighter = below if below > lower else lower, above if above < upper else upper
                if 4 * (tighter[1] - tighter[0]) < 3 * gap:
                    lower, upper = tighter
                    continue
            if value.contains(0):  # the middle may be the root itself
                middle = (lower + gap * fmpq(3, 8)).mid()
                value = self.p(middle)
            if value.contains(0) or not (lower < middle and middle < upper):
                raise Undecidable("the root is not known more narrowly")
            if (value > 0) == bracket.rising:
                upper = middle
            else:
                lower = middle


def _multiplicity(line: _Line, bracket: Bracket, parts: Split) -> int:
    """Return the multiplicity in p of the carrier's root in a bracket; 0 if it is a root of p's conjugate only.

    Raises Undecidable if no precision tells.
    """
    lower, upper = (
        rational(line.start) + rational(line.width) * fmpq(e, 1 << bracket.exponent)
        for e in (bracket.lower, bracket.upper)
    )

    def among(factors: tuple[tuple[Any, int], ...]) -> int:
        return sum(m for f, m in factors if f(lower) * f(upper) < 0)

    in_norm = among(parts.norms)
    if in_norm and _belongs_to_conjugate(line, bracket, parts.q):
        in_norm = 0
    return among(parts.rational) + in_norm


def _belongs_to_conjugate(line: _Line, bracket: Bracket, q: Surd) -> bool:
    """Return whether a root of q·q̄ is one of q̄. It is a root of exactly one of the two.

    The precision is raised until the other one is proved not to vanish there. Raises Undecidable if none tells.
    """
    for bits in PRECISIONS:
        with precision(bits):
            try:
                t = line.at_precision().refine(bracket, bits)
            except Undecidable:
                continue
            if not q.conjugate().ball()(t).contains(0):
                return False
            if not q.ball()(t).contains(0):
                return True
    raise Undecidable("a root of the norm was not told from its conjugate")


def _place(line: _Line, bracket: Bracket, carrier: Any, ends: tuple[End, End]) -> tuple[int, Any]:
    """Return where the root in a bracket lies, and the root as a ball of t.

    −1, 0 and +1 stand for before, in and after the closed clip interval. Raises Undecidable if no precision tells.
    """
    at_end = [end.is_root_of(carrier) for end in ends]
    for bits in PRECISIONS:
        with precision(bits):
            try:
                t = line.at_precision().refine(bracket, bits)
            except Undecidable:
                continue
            enter, leave = (end.ball() for end in ends)
            lower, upper = line.ends(bracket)
            # the bracket holds one root of the carrier: a clip end in it that is a root of the carrier is that root
            if any(root and lower < e and e < upper for root, e in zip(at_end, (enter, leave), strict=True)):
                return 0, t
            if t < enter:
                return -1, t
            if t > leave:
                return 1, t
            if t >= enter and t <= leave:
                return 0, t
    raise Undecidable("a root was not told from a clip end")
