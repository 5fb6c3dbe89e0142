"""Decide first hits exactly on short pieces of a ray, for f made of polynomials, quotients, square roots and kinks.

**Theory.** A piece is cut into cells at every number where the argument of a kink or of a square root, or f itself, may
be 0; these are roots of rational polynomials (`tower`). Inside a cell every kink is on one side, f is one element of a
tower, and f has one sign or is 0 all over. There remain the ends of cells. f is 0 at an end if it changes its sign
there or is 0 beside it; otherwise one exact question at one algebraic number decides. Kinks whose sign balls prove on
the whole cell need no cut, so that few cuts are made.

Where f may jump, cells are cut too: where the argument of a floor is a whole number, and where the two sides of a
comparison are equal. Then what f does beside an end says nothing about f at the end, and the whole program is run at
the end itself (`exact_run.PointRun`). Only the part of a select that is taken is computed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from typing import Any

from flint import fmpq

from harness.contract import TruthStatus
from harness.oracle.bernstein import Undecidable
from harness.oracle.clip import End
from harness.oracle.exact_run import FIRST_PRECISION, Cut, PointRun, Run, Undefined
from harness.oracle.graph import Graph
from harness.oracle.points import Point, end_point, rational_point
from harness.oracle.program import POLYNOMIAL, Leaf, Program, program_of
from harness.oracle.reals import precision
from harness.oracle.slow import FirstHit, certified_hit
from harness.oracle.tower import Element, Tower, constant

EXACT = POLYNOMIAL | {"div", "sqrt", "abs", "min", "max", "floor", "below", "select"}
MOST_CELLS = 200


def exact_program(graph: Graph) -> Program | None:
    """Return the program of a graph for `PiecewiseSolver`; None if it has other functions or constants."""
    program = program_of(graph, fold=False)
    known = all(i.name in EXACT for i in program.instructions)
    return program if known and all(isinstance(leaf, Fraction) for leaf in program.constants.leaves) else None


def _element(leaf: Leaf) -> Element:
    """Return a rational leaf as an element."""
    assert isinstance(leaf, Fraction), "an exact program has no other leaves"
    return constant(fmpq(leaf.numerator, leaf.denominator))


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
        self.leaves = program.constants.converted(_element, {})

    def first_hit(self, lower: Any, upper: Any, width: float) -> FirstHit | None:
        """Return the first root in the clip interval and in [lower, upper], two fmpq; None if there is none.

        No root may lie in the clip interval before `lower`. A root shortly behind `upper` may be found too. `width` is
        the width of the certified interval, in units of t. Raises Undecidable if a question is not decided.
        """
        room = (upper - lower) / 7
        cells = self.cells(rational_point(lower - room), rational_point(upper + room))
        for k, cell in enumerate(cells):
            if cell.sign == 0 and self.is_met(cell):
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

    def is_met(self, cell: _Cell) -> bool:
        """Return whether the clip interval holds a point of a cell in which f is 0, or of its ends if f is 0 there too.

        If f may jump, it need not be 0 at the ends; those are asked for one by one.
        """
        ahead, behind = cell.first.compare(self.leave), cell.last.compare(self.enter)
        return ahead < 0 < behind if self.program.jumps else ahead <= 0 <= behind

    def vanishes_between(self, cell: _Cell, following: _Cell) -> bool:
        """Return whether f is 0 at the point between two neighbouring cells."""
        if self.program.jumps:
            return PointRun(self.program, self.leaves, self.ray, cell.last).vanishes()
        if cell.sign is None and following.sign is None:
            return False
        if cell.sign is None or following.sign is None:
            known = following if cell.sign is None else cell
            return known.sign == 0 or known.tower.vanishes_at(known.f, cell.last)
        return cell.sign * following.sign <= 0 or cell.tower.vanishes_at(cell.f, cell.last)

    def cells(self, first: Point, last: Point) -> list[_Cell]:
        """Return the cells from `first` to `last`. Outside the clip interval, f may have no value in a cell.

        Raises Undecidable if there are too many cells, and Undefined if f has no value in one inside the interval.
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
            except Cut as cut:
                points = [first, *cut.roots, last]
                stack += list(pairwise(points))[::-1]
            except Undefined:
                if last.compare(self.enter) > 0 and first.compare(self.leave) < 0:
                    raise
                result.append(_Cell(first, last, Tower(first, last), {}, None))
        raise Undecidable("too many cells")

    def cell(self, first: Point, last: Point) -> _Cell:
        """Return one cell. Raises Cut if it must be cut, and Undefined if f has no value in it."""
        run = Run(self.program, self.leaves, self.ray, first, last)
        f = run.numerator(run.result())
        return _Cell(first, last, run.tower, f, run.sign(f))
