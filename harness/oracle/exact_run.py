"""Run a program exactly: on an open interval of t in which no sign changes, or at one number t.

Values are quotients of a tower's elements. A number that must not change its sign on the interval and does is reported
with its roots, at which the interval is to be cut.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import floor
from typing import Any

from flint import arb, fmpq, fmpq_poly
from flint.utils.flint_exceptions import DomainError

from harness.oracle import reals
from harness.oracle.bernstein import Undecidable
from harness.oracle.points import Point, roots_between
from harness.oracle.program import Instruction, Program
from harness.oracle.reals import float_above, float_below, precision
from harness.oracle.tower import Element, PointTower, Tower, add, constant, neg

FIRST_PRECISION = 128  # bits of the balls, which decide most kinks
MOST_STEPS = 64  # whole numbers that a floor's argument may pass in one cell
LARGEST = 2.0**50  # floors of larger numbers are not computed
ONE = constant(1)


class Cut(Exception):
    """Report that something that must not vanish inside a cell has `roots` there."""

    def __init__(self, roots: list[Point]) -> None:
        super().__init__()
        self.roots = roots


class Undefined(Undecidable):
    """Report that f has no value in the cell."""


Quotient = tuple[Element, Element]
ZERO: Quotient = ({}, ONE)


class Run:
    """Run the program on one cell, in quotients of a tower's elements."""

    def __init__(self, program: Program, leaves: list[Element], ray: Sequence[Any], first: Point, last: Point) -> None:
        self.program = program
        self.leaves = leaves
        self.tower = self.new_tower(first, last)
        self.inputs = [fmpq_poly([o, d]) for o, d in zip(ray[:3], ray[3:], strict=True)]
        with precision(FIRST_PRECISION):
            whole = first.ball().union(last.ball())
            points = [arb(o) + arb(d) * whole for o, d in zip(ray[:3], ray[3:], strict=True)]
            constants = program.constants.converted(reals.leaf, reals.FUNCTIONS)
            self.balls = program.results(points, constants, reals.FUNCTIONS)

    @staticmethod
    def new_tower(first: Point, last: Point) -> Tower:
        """Return the tower of the cell between two points."""
        return Tower(first, last)

    def result(self) -> Quotient:
        """Return f on the cell. Only what f needs there is computed."""
        values: dict[int, Quotient] = {}
        stack = [len(self.program.instructions) - 1]
        while stack:
            i = self.program.instructions[stack[-1]]
            wanted = self.wanted(i, values)
            missing = [a for a in wanted if a not in values]
            if stack[-1] in values:
                stack.pop()
            elif missing:
                stack += missing
            elif len(wanted) == 1 and i.name in ("min", "max", "select"):
                values[stack.pop()] = values[wanted[0]]
            else:
                values[stack.pop()] = self.value(i, [values[a] for a in i.args])
        return values[len(self.program.instructions) - 1]

    def wanted(self, i: Instruction, values: dict[int, Quotient]) -> tuple[int, ...]:
        """Return the arguments that an instruction needs, of which some may be computed."""
        if i.name in ("min", "max"):
            side = self.side(i)
            return i.args if side is None else i.args[side : side + 1]
        if i.name != "select":
            return i.args
        condition, taken, other = i.args
        known = self.balls[condition]
        if known > 0.5 or known < 0.5:
            return (taken,) if known > 0.5 else (other,)
        if condition not in values:
            return (condition,)
        return (taken,) if values[condition][0] else (other,)

    def side(self, i: Instruction) -> int | None:
        """Return which argument a minimum or maximum is all over the cell, or None if balls do not tell."""
        with precision(FIRST_PRECISION):
            gap = self.balls[i.args[0]] - self.balls[i.args[1]]
        return None if gap.contains(0) else int((gap > 0) == (i.name == "min"))

    def value(self, i: Instruction, a: list[Quotient]) -> Quotient:
        """Return an instruction's result from those of its arguments."""
        mul = self.tower.mul
        match i.name:
            case "input":
                p = self.inputs[i.index]
                return ({0: p} if p else {}), ONE
            case "constant":
                return self.leaves[i.index], ONE
            case "neg":
                return neg(a[0][0]), a[0][1]
            case "add":
                return self.sum(a[0], a[1])
            case "sub":
                return self.sum(a[0], (neg(a[1][0]), a[1][1]))
            case "mul":
                return mul(a[0][0], a[1][0]), mul(a[0][1], a[1][1])
            case "sqr":
                return mul(a[0][0], a[0][0]), mul(a[0][1], a[0][1])
            case "div":
                return mul(a[0][0], a[1][1]), mul(a[0][1], a[1][0])
            case "sqrt":
                return self.sqrt(a[0], self.balls[i.args[0]])
            case "abs":
                return a[0] if self.kink(a[0], self.balls[i.args[0]]) >= 0 else (neg(a[0][0]), a[0][1])
            case "floor":
                return constant(self.floor(a[0], self.balls[i.args[0]])), ONE
        ahead = self.sign(self.numerator(self.sum(a[0], (neg(a[1][0]), a[1][1]))))
        if i.name == "below":
            return constant(int(ahead <= 0)), ONE
        return a[int((ahead > 0) == (i.name == "min"))]

    def floor(self, a: Quotient, ball: Any) -> int:
        """Return ⌊a⌋ on the cell. Raises Cut if it changes, and Undecidable if it may have too many values."""
        with precision(FIRST_PRECISION):
            if not abs(ball) < LARGEST:
                raise Undecidable("a floor's argument is too large")
            low, high = floor(float_below(ball)), floor(float_above(ball))
        if high - low > MOST_STEPS:
            raise Undecidable("a floor has too many values")
        return low + sum(
            self.sign(self.numerator(self.sum(a, (constant(-step), ONE)))) >= 0 for step in range(low + 1, high + 1)
        )

    def sum(self, a: Quotient, b: Quotient) -> Quotient:
        """Return the sum of two quotients."""
        if a[1] == b[1]:
            return add(a[0], b[0]), a[1]
        mul = self.tower.mul
        return add(mul(a[0], b[1]), mul(b[0], a[1])), mul(a[1], b[1])

    def numerator(self, a: Quotient) -> Element:
        """Return an element that has the sign of `a`."""
        return a[0] if a[1] == ONE else self.tower.mul(a[0], a[1])

    def kink(self, a: Quotient, ball: Any) -> int:
        """Return the sign of `a` on the cell, 0 if it is 0 all over. Raises Cut if it changes."""
        if not ball.contains(0):
            return 1 if ball > 0 else -1
        return self.sign(self.numerator(a))

    def sign(self, x: Element) -> int:
        """Return the sign of an element on the cell, 0 if it is 0 all over. Raises Cut if it changes."""
        p = self.tower.zeros(x)
        if p is None:
            return 0
        roots = roots_between(p, self.tower.first, self.tower.last)
        if roots:
            raise Cut(roots)
        return self.tower.sign(x)

    def sqrt(self, a: Quotient, ball: Any) -> Quotient:
        """Return √a. Raises Undefined if `a` is negative or its divisor is 0 on the cell, Cut if a sign changes."""
        sign = self.kink(a, ball)
        if sign < 0:
            raise Undefined("a root of what is negative")
        if sign == 0:
            return ZERO
        below = a[1]
        side = 1 if below == ONE else self.sign(below)
        if not side:
            raise Undefined("a division by zero")
        if side < 0:
            below = neg(below)
        return self.root(self.numerator(a)), below

    def root(self, square: Element) -> Element:
        """Return √square; if it is a polynomial, squared factors are taken out of the root."""
        if max(square) > 0:
            return self.tower.radical(square)
        p = square[0]
        content, factors = p.numer().factor_squarefree()
        outer, inner = fmpq_poly([1]), fmpq_poly([fmpq(int(content), 1) / p.denom()])
        for factor, multiplicity in factors:
            outer *= fmpq_poly(factor) ** (multiplicity // 2)
            inner *= fmpq_poly(factor) ** (multiplicity % 2)
        if outer.degree() > 0 and self.sign({0: outer}) < 0:
            outer = -outer
        return self.tower.mul({0: outer}, _constant_root(inner) or self.tower.radical({0: inner}))


class PointRun(Run):
    """Run the program at one point, where elements are numbers, and nothing needs to be cut."""

    def __init__(self, program: Program, leaves: list[Element], ray: Sequence[Any], point: Point) -> None:
        self.point = point
        point.refine(fmpq(1, 1 << FIRST_PRECISION))
        super().__init__(program, leaves, ray, point, point)

    @staticmethod
    def new_tower(first: Point, last: Point) -> Tower:
        """Return a tower whose radicals are numbers at one point, which both arguments are."""
        assert first is last
        return PointTower(first)

    def vanishes(self) -> bool:
        """Return whether f is 0 at the point; where it has no value, it is not. Raises Undecidable."""
        try:
            return not self.sign(self.result()[0])
        except Undefined:
            return False

    def value(self, i: Instruction, a: list[Quotient]) -> Quotient:
        """Return an instruction's result, as on a cell. Raises Undefined for a division by zero."""
        if i.name == "div" and not self.sign(a[1][0]):
            raise Undefined("a division by zero")
        return super().value(i, a)

    def sign(self, x: Element) -> int:
        """Return the sign of an element at the point."""
        if self.tower.vanishes_at(x, self.point):
            return 0
        assert isinstance(self.tower, PointTower)
        return self.tower.sign_at(x, self.point)


def _constant_root(p: Any) -> Element | None:
    """Return √p if p is the square of a rational, else None."""
    if p.degree() > 0:
        return None
    try:
        return constant(p[0].sqrt())
    except DomainError:
        return None
