"""Search a box for the zeros of a tape: the smallest box that holds them all, or a place where there surely is one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product

import numpy as np
from numpy.typing import NDArray

from surfaces.evaluation import Floats64
from surfaces.lowering import gradient, real_tape
from surfaces.proofs.ranges import has_value, outputs, run, sides
from surfaces.tape import JUMPS, Tape

Bools = NDArray[np.bool_]
TIGHT = 0.01  # of the zeros' extent: how much larger than they the box that is found may be
BATCH = 2048
PER_OPERATION, PER_BOX = 1e-5, 1.5e-8  # seconds for one operation, and for each of its boxes
OVERHEAD = 20  # operations that cutting and sorting boxes is worth
_CORNERS = np.array(list(product((-1.0, 1.0), repeat=3)))


@dataclass
class Searcher:
    """Hold a tape, its gradient, and the time that is left for searching, seconds.

    `left` is counted by the work that is done, not by the clock, so that the same question has the same answer.
    """

    tape: Tape
    left: float
    slopes: Tape | None = field(init=False)  # None where f may jump: then slopes bound nothing
    defined: tuple[tuple[str, int], ...] = field(init=False)  # operations whose argument must be in their domain

    def __post_init__(self) -> None:
        self.defined = tuple(
            (op.name, op.inputs[-1]) for op in self.tape.ops if op.name in ("div", "log", "sqrt", "powr", "tan")
        )
        jumps = any(op.name in JUMPS for op in self.tape.ops)
        self.slopes = None if jumps else gradient(real_tape(self.tape), guarded=False)

    def _spend(self, tape: Tape, boxes: int) -> None:
        self.left -= (len(tape.ops) + OVERHEAD) * (PER_OPERATION + PER_BOX * boxes)

    def _outputs(self, tape: Tape, lower: Floats64, upper: Floats64) -> tuple[Floats64, Floats64]:
        self._spend(tape, len(lower))
        return outputs(tape, lower, upper)

    def empty(self, lower: Floats64, upper: Floats64) -> Bools:
        """Return which boxes float64[n, 3] are proved to hold no zero: bool[n]."""
        if not len(lower):
            return np.zeros(0, np.bool_)
        low, high = self._outputs(self.tape, lower, upper)
        none = np.asarray(((low > 0.0) | (high < 0.0))[:, 0])
        rest = np.flatnonzero(~none)
        if self.slopes is not None and len(rest):
            none[rest] = self._empty_by_slopes(lower[rest], upper[rest])
        return none

    def _empty_by_slopes(self, lower: Floats64, upper: Floats64) -> Bools:
        """Return which boxes hold no zero by the mean value form: f(middle) and what the slopes may add."""
        assert self.slopes is not None
        middle = 0.5 * (lower + upper)
        half = np.maximum(upper - middle, middle - lower) * (1.0 + 1e-15)
        steep = np.maximum(*(np.abs(end) for end in self._outputs(self.slopes, lower, upper)))
        low, high = self._outputs(self.tape, middle, middle)
        with np.errstate(all="ignore"):
            room = (steep * half).sum(axis=1) * (1.0 + 1e-14)
            return np.asarray((low[:, 0] > room) | (high[:, 0] < -room))

    def crossing(self, lower: Floats64, upper: Floats64) -> Bools:
        """Return which boxes float64[n, 3] are proved to hold a zero: f changes its sign on them, and is continuous."""
        if not len(lower):
            return np.zeros(0, np.bool_)
        middle, half = 0.5 * (lower + upper), 0.5 * (upper - lower)
        points = (
            (middle[:, None] + half[:, None] * _CORNERS)
            .reshape(-1, 3)
            .clip(np.repeat(lower, 8, axis=0), np.repeat(upper, 8, axis=0))
        )
        low, high = (end[:, 0].reshape(-1, 8) for end in self._outputs(self.tape, points, points))
        found = np.asarray((low > 0.0).any(axis=1) & (high < 0.0).any(axis=1))
        rows = np.flatnonzero(found)
        if len(rows) and (self.defined or any(op.name in JUMPS for op in self.tape.ops)):
            found[rows] = self._continuous(lower[rows], upper[rows])
        return found

    def _continuous(self, lower: Floats64, upper: Floats64) -> Bools:
        """Return on which boxes f is proved to have a value everywhere, and no jump."""
        self._spend(self.tape, len(lower))
        smooth = np.ones(len(lower), np.bool_)
        with np.errstate(all="ignore"):
            values = list(run(self.tape, sides(lower, upper)))
            for name, argument in self.defined:
                smooth &= has_value(name, values[argument])
            for op, (low, high) in zip(self.tape.ops, values, strict=True):
                if op.name in ("floor", "below", "sign"):
                    smooth &= np.asarray(low == high)
                elif op.name == "atan2":
                    y, x = (values[i] for i in op.args)
                    smooth &= np.asarray((x[0] > 0.0) | (y[0] > 0.0) | (y[1] < 0.0))
        return smooth


@dataclass(frozen=True)
class Hull:
    """Hold a box, float64[3] each, outside which no zero is, as far as was searched.

    `inner` and `outer` say how far zeros surely reach: the true box about them has its lower corner between `lower` and
    `inner`, and its upper corner between `outer` and `upper`. Both are infinite, the wrong way, where no zero is sure.
    """

    lower: Floats64
    upper: Floats64
    inner: Floats64
    outer: Floats64


def hull(searcher: Searcher, lower: Floats64, upper: Floats64) -> Hull | None:
    """Return a box that holds all zeros in the box from `lower` to `upper`, float64[3] each; None if there are none.

    Boxes are cut in eight. Those inside what zeros surely span need not be looked at any more, so that the work is done
    where the zeros' box has its faces. It ends where the box is TIGHT, reaches a side of the box that is searched, or
    the searcher has no time left.
    """
    inner, outer = np.full(3, np.inf), np.full(3, -np.inf)
    straight = not {"x", "y", "z"} <= {op.args[0] for op in searcher.tape.ops if op.name == "var"}
    kept: list[tuple[Floats64, Floats64]] = []
    todo = [(lower[None], upper[None])]
    while todo and searcher.left > 0.0:
        low, high = todo.pop(0)
        left = ~searcher.empty(low, high)
        low, high = low[left], high[left]
        sure = searcher.crossing(low, high)
        inner = np.minimum(inner, high[sure].min(axis=0, initial=np.inf))
        outer = np.maximum(outer, low[sure].max(axis=0, initial=-np.inf))
        if straight and sure.any():
            return Hull(lower, upper, inner, outer)  # the zero is part of a line from side to side
        size = max(float((outer - inner).max()), 0.0)
        room = TIGHT * size
        if size > 0.0 and ((inner - lower <= room).any() or (upper - outer <= room).any()):
            return Hull(lower, upper, inner, outer)  # the zeros reach a side: there is nothing to be tight about
        beyond = np.maximum(np.maximum(inner - low, high - outer), 0.0).max(axis=1)
        close = beyond <= room
        kept.append((low[close & (beyond > 0.0)], high[close & (beyond > 0.0)]))
        todo = _queued(todo, low[~close], high[~close])
    kept += todo
    if not any(len(low) for low, _ in kept) and not np.isfinite(inner).all():
        return None
    ends = np.concatenate([low for low, _ in kept]), np.concatenate([high for _, high in kept])
    least = np.minimum(ends[0].min(axis=0, initial=np.inf), inner)
    return Hull(least, np.maximum(ends[1].max(axis=0, initial=-np.inf), outer), inner, outer)


def zero_beyond(
    searcher: Searcher,
    lower: Floats64,
    upper: Floats64,
    inside: Callable[[Floats64, Floats64], Bools],
    outside: Callable[[Floats64, Floats64], Bools],
) -> bool | None:
    """Return whether a zero in a box lies beyond a region: True and False are proved, None is not known.

    `inside` and `outside` say of boxes [n] whether they are wholly within the region, or wholly beyond it.
    """
    todo = [(lower[None], upper[None])]
    while todo and searcher.left > 0.0:
        low, high = todo.pop(0)
        left = ~inside(low, high)
        left[left] = ~searcher.empty(low[left], high[left])
        low, high = low[left], high[left]
        beyond = outside(low, high)
        if searcher.crossing(low[beyond], high[beyond]).any():
            return True
        todo = _queued(todo, low, high)
    return None if todo else False


def _queued(todo: list[tuple[Floats64, Floats64]], lower: Floats64, upper: Floats64) -> list[tuple[Floats64, Floats64]]:
    """Return what is to do, with the eighths of boxes float64[n, 3] behind it, in portions of BATCH boxes at most."""
    if not len(lower):
        return todo
    low, high = _eighths(lower, upper)
    if todo and len(todo[-1][0]) + len(low) <= BATCH:
        last = todo[-1]
        return [*todo[:-1], (np.concatenate((last[0], low)), np.concatenate((last[1], high)))]
    return todo + [(low[i : i + BATCH], high[i : i + BATCH]) for i in range(0, len(low), BATCH)]


def _eighths(lower: Floats64, upper: Floats64) -> tuple[Floats64, Floats64]:
    """Cut boxes float64[n, 3] in eight: float64[8 n, 3] each."""
    middle = 0.5 * (lower + upper)
    low = [np.where(corner < 0.0, lower, middle) for corner in _CORNERS]
    high = [np.where(corner < 0.0, middle, upper) for corner in _CORNERS]
    return np.concatenate(low), np.concatenate(high)
