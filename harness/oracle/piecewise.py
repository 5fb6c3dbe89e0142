"""Decide first hits exactly on short pieces of a ray, for f made of polynomials, quotients, square roots and kinks.

**Theory.** A piece is cut into cells at every number where the argument of a kink or of a square root, or f itself, may
be 0; these are roots of rational polynomials (`tower`). Inside a cell every kink is on one side, f is one element of a
tower, and f has one sign or is 0 all over. There remain the ends of cells. f is 0 at an end if it changes its sign
there or is 0 beside it; otherwise one exact question at one algebraic number decides. Kinks whose sign balls prove on
the whole cell need no cut, so that few cuts are made.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq, fmpq_poly
from flint.utils.flint_exceptions import DomainError

from harness.contract import TruthStatus
from harness.oracle import reals
from harness.oracle.bernstein import Undecidable
from harness.oracle.clip import End
from harness.oracle.points import Point, end_point, rational_point, roots_between
from harness.oracle.program import POLYNOMIAL, Instruction, Program, compile_expression
from harness.oracle.reals import precision
from harness.oracle.slow import FirstHit, certified_hit
from harness.oracle.tower import Element, Tower, add, constant, neg

if TYPE_CHECKING:
    import sympy

EXACT = POLYNOMIAL | {"div", "sqrt", "abs", "min", "max"}
FIRST_PRECISION = 128  # bits of the balls, which decide most kinks
MOST_CELLS = 200
ONE = constant(1)


class _Cut(Exception):
    """Report that something that must not vanish inside a cell has `roots` there."""

    def __init__(self, roots: list[Point]) -> None:
        super().__init__()
        self.roots = roots


class _Undefined(Undecidable):
    """Report that f has no value in the cell."""


def exact_program(expr: sympy.Expr) -> Program | None:
    """Return the program of `expr` for `PiecewiseSolver`; None if it has other functions or constants."""
    program = compile_expression(expr, fold=False)
    known = all(i.name in EXACT for i in program.instructions) and all(map(_is_exact, program.constants))
    return program if known else None


def _is_exact(leaf: sympy.Expr) -> bool:
    """Return whether a constant is a rational or the golden ratio."""
    import sympy

    return bool(leaf.is_Rational or leaf == sympy.GoldenRatio)


@dataclass
class _Cell:
    """Hold an open interval between two points, with f and its `sign` inside; None if f has no value there."""

    first: Point
    last: Point
    tower: Tower
    f: Element
    sign: int | None


class PiecewiseSolver:
    """Decide first hits on pieces of one ray, which is given as six fmpq."""

    def __init__(self, program: Program, ray: Sequence[Any], ends: tuple[End, End], t_min: float) -> None:
        self.program = program
        self.ray = ray
        self.t_min = t_min
        self.enter, self.leave = (end_point(end) for end in ends)

    def first_hit(self, lower: Any, upper: Any, width: float) -> FirstHit | None:
        """Return the first root in the clip interval and in [lower, upper], two fmpq; None if there is none.

        No root may lie in the clip interval before `lower`. A root shortly behind `upper` may be found too. `width` is
        the width of the certified interval, in units of t. Raises Undecidable if a question is not decided.
        """
        room = (upper - lower) / 7
        cells = self.cells(rational_point(lower - room), rational_point(upper + room))
        for k, cell in enumerate(cells):
            if cell.sign == 0 and cell.first.compare(self.leave) <= 0 and cell.last.compare(self.enter) >= 0:
                start = cell.first if cell.first.compare(self.enter) > 0 else self.enter
                return self.hit(TruthStatus.TOUCH, start, width)
            following = cells[k + 1] if k + 1 < len(cells) else None
            if following and self.vanishes_between(cell, following):
                if cell.last.compare(self.leave) > 0:
                    return None
                if cell.last.compare(self.enter) >= 0:
                    crosses = cell.sign and following.sign and cell.sign != following.sign
                    return self.hit(TruthStatus.CROSSING if crosses else TruthStatus.TOUCH, cell.last, width)
        return None

    def hit(self, status: TruthStatus, t: Point, width: float) -> FirstHit:
        """Return a hit at t in a certified interval of at most this width."""
        t.refine(fmpq(*width.as_integer_ratio()))
        with precision(FIRST_PRECISION):
            return certified_hit(status, t.ball(), self.t_min)

    @staticmethod
    def vanishes_between(cell: _Cell, following: _Cell) -> bool:
        """Return whether f is 0 at the point between two neighbouring cells."""
        if cell.sign is None and following.sign is None:
            return False
        if cell.sign is None or following.sign is None:
            known = following if cell.sign is None else cell
            return known.sign == 0 or known.tower.vanishes_at(known.f, cell.last)
        return cell.sign * following.sign <= 0 or cell.tower.vanishes_at(cell.f, cell.last)

    def cells(self, first: Point, last: Point) -> list[_Cell]:
        """Return the cells from `first` to `last`. Outside the clip interval, f may have no value in a cell.

        Raises Undecidable if there are too many cells, and _Undefined if f has no value in one inside the interval.
        """
        inside = [p for p in (self.enter, self.leave) if p.compare(first) > 0 and p.compare(last) < 0]
        if len(inside) == 2 and not inside[0].compare(inside[1]):
            inside.pop()
        points = [first, *inside, last]
        stack = list(pairwise(points))[::-1]
        result: list[_Cell] = []
        for _ in range(MOST_CELLS):
            if not stack:
                return result
            first, last = stack.pop()
            try:
                result.append(self.cell(first, last))
            except _Cut as cut:
                points = [first, *cut.roots, last]
                stack += list(pairwise(points))[::-1]
            except _Undefined:
                if last.compare(self.enter) > 0 and first.compare(self.leave) < 0:
                    raise
                result.append(_Cell(first, last, Tower(first, last), {}, None))
        raise Undecidable("too many cells")

    def cell(self, first: Point, last: Point) -> _Cell:
        """Return one cell. Raises _Cut if it must be cut, and _Undefined if f has no value in it."""
        run = _Run(self.program, self.ray, first, last)
        f = run.numerator(run.result())
        return _Cell(first, last, run.tower, f, run.sign(f))


Quotient = tuple[Element, Element]
ZERO: Quotient = ({}, ONE)


class _Run:
    """Run the program on one cell, in quotients of a tower's elements."""

    def __init__(self, program: Program, ray: Sequence[Any], first: Point, last: Point) -> None:
        self.program = program
        self.tower = Tower(first, last)
        self.inputs = [fmpq_poly([o, d]) for o, d in zip(ray[:3], ray[3:], strict=True)]
        with precision(FIRST_PRECISION):
            whole = first.ball().union(last.ball())
            points = [arb(o) + arb(d) * whole for o, d in zip(ray[:3], ray[3:], strict=True)]
            self.balls = program.results(points, [reals.leaf(c) for c in program.constants], reals.FUNCTIONS)

    def result(self) -> Quotient:
        """Return f on the cell."""
        needed = self.needed()
        values: dict[int, Quotient] = {}
        for k, i in enumerate(self.program.instructions):
            if k in needed:
                values[k] = self.value(i, [values.get(a, ZERO) for a in i.args])
        return values[len(self.program.instructions) - 1]

    def needed(self) -> set[int]:
        """Return the instructions that f needs on this cell, without the other sides of minima and maxima."""
        needed = {len(self.program.instructions) - 1}
        for k in range(len(self.program.instructions) - 1, -1, -1):
            i = self.program.instructions[k]
            if k in needed:
                side = self.side(i)
                needed.update(i.args if side is None else i.args[side : side + 1])
        return needed

    def side(self, i: Instruction) -> int | None:
        """Return which argument a minimum or maximum is all over the cell, or None if balls do not tell."""
        if i.name not in ("min", "max"):
            return None
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
                return self.leaf(self.program.constants[i.index]), ONE
            case "neg":
                return neg(a[0][0]), a[0][1]
            case "add":
                return self.sum(a[0], a[1])
            case "sub":
                return self.sum(a[0], (neg(a[1][0]), a[1][1]))
            case "mul":
                return mul(a[0][0], a[1][0]), mul(a[0][1], a[1][1])
            case "div":
                return mul(a[0][0], a[1][1]), mul(a[0][1], a[1][0])
            case "sqrt":
                return self.sqrt(a[0], self.balls[i.args[0]])
            case "abs":
                return a[0] if self.kink(a[0], self.balls[i.args[0]]) >= 0 else (neg(a[0][0]), a[0][1])
        side = self.side(i)
        if side is None:
            ahead = self.sign(self.numerator(self.sum(a[0], (neg(a[1][0]), a[1][1]))))
            side = int((ahead > 0) == (i.name == "min"))
        return a[side]

    def sum(self, a: Quotient, b: Quotient) -> Quotient:
        """Return the sum of two quotients."""
        if a[1] == b[1]:
            return add(a[0], b[0]), a[1]
        mul = self.tower.mul
        return add(mul(a[0], b[1]), mul(b[0], a[1])), mul(a[1], b[1])

    def leaf(self, expr: sympy.Expr) -> Element:
        """Return a rational or the golden ratio as an element."""
        if expr.is_Rational:
            return constant(fmpq(int(expr.p), int(expr.q)))
        root = self.tower.radical(constant(5))  # the golden ratio
        return add(constant(fmpq(1, 2)), self.tower.mul(constant(fmpq(1, 2)), root))

    def numerator(self, a: Quotient) -> Element:
        """Return an element that has the sign of `a`."""
        return a[0] if a[1] == ONE else self.tower.mul(a[0], a[1])

    def kink(self, a: Quotient, ball: Any) -> int:
        """Return the sign of `a` on the cell, 0 if it is 0 all over. Raises _Cut if it changes."""
        if not ball.contains(0):
            return 1 if ball > 0 else -1
        return self.sign(self.numerator(a))

    def sign(self, x: Element) -> int:
        """Return the sign of an element on the cell, 0 if it is 0 all over. Raises _Cut if it changes."""
        p = self.tower.zeros(x)
        if p is None:
            return 0
        roots = roots_between(p, self.tower.first, self.tower.last)
        if roots:
            raise _Cut(roots)
        return self.tower.sign(x)

    def sqrt(self, a: Quotient, ball: Any) -> Quotient:
        """Return √a. Raises _Undefined if `a` is negative or its divisor is 0 on the cell, _Cut if a sign changes."""
        sign = self.kink(a, ball)
        if sign < 0:
            raise _Undefined("a root of what is negative")
        if sign == 0:
            return ZERO
        below = a[1]
        side = 1 if below == ONE else self.sign(below)
        if not side:
            raise _Undefined("a division by zero")
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


def _constant_root(p: Any) -> Element | None:
    """Return √p if p is the square of a rational, else None."""
    if p.degree() > 0:
        return None
    try:
        return constant(p[0].sqrt())
    except DomainError:
        return None
