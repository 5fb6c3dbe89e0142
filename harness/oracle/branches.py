"""Compute ranges of f and its slope on pieces of rays separately for both sides of a kink.

**Theory.** A kink is a place where the argument u of an abs, min or max changes its sign. If that sign is not known on
a piece, f is one function where u >= 0 and another where u <= 0. Almost everywhere its slope is that of one of the two.
So if a range holds both slopes and not 0, f is monotone (f is absolutely continuous where its ranges are finite). Two
separate ranges are much narrower than one range of the slopes of all kinks mixed. In √(max(u, 0)²) + min(u, 0), for
example, every kink has the same u, and the slope is u' on either side.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from harness.oracle import balls64
from harness.oracle.balls64 import Balls, where
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.program import Functions
from harness.oracle.segments import Mask

Signs = NDArray[np.signedinteger]  # 1, 0 or −1


def _is_zero(a: Dual) -> Mask:
    """Return bool[...]: whether a value is exactly 0."""
    return np.asarray((np.asarray(a.value.mid) == 0.0) & (np.asarray(a.value.rad) == 0.0))


def _signs(side: Signs) -> Balls:
    """Return signs int[...] as balls [...]: 1, −1, or [−1, 1] where a sign is 0."""
    return Balls(np.asarray(side, np.float64), np.where(side == 0, 1.0, 0.0))


class Branch:
    """Define the functions of one run of a program in which each piece's first open kink lies on `side`, 1 or −1."""

    def __init__(self, side: int, shape: tuple[int, ...]) -> None:
        self.side = side
        self.free = np.ones(shape, dtype=bool)  # pieces that have met no open kink yet
        # by the identity of a run's results: the result, and 1 where it is >= 0, −1 where it is <= 0, else 0; a result
        # is held here, so that its identity is not given to another one
        self.known: dict[int, tuple[Dual, Signs]] = {}

    def functions(self) -> Functions:
        """Return the elementary functions of this run."""
        smooth = dual_functions(balls64.FUNCTIONS)
        return {**smooth, "abs": self.absolute, "min": self.minimum, "max": self.maximum, "length": self.length}

    def of(self, a: Dual) -> Signs:
        """Return int[...]: 1 or −1 where the sign of `a` is known, else 0."""
        sign = np.broadcast_to(a.value.sign, self.free.shape)
        return np.where(sign != 0, sign, self.known[id(a)][1]) if id(a) in self.known else sign

    def settled(self, side: Signs) -> Signs:
        """Return `side`, int[...], replaced by this run's own side in pieces whose first open kink this is."""
        side = np.broadcast_to(side, self.free.shape)
        first = (side == 0) & self.free
        self.free &= ~first
        return np.where(first, self.side, side)

    def settle(self, a: Dual) -> Signs:
        """Return int[...], the sign of `a`, which is chosen if it is not known, and remembered."""
        side = self.settled(self.of(a))
        self.known[id(a)] = a, side
        return side

    def absolute(self, a: Dual) -> Dual:
        side = self.settle(a)
        result = Dual(balls64.absolute(a.value), balls64.pick(_signs(side), a.slope, -a.slope))
        self.known[id(result)] = result, np.ones_like(side)
        return result

    def minimum(self, a: Dual, b: Dual) -> Dual:
        return self.extreme(a, b, 1)

    def maximum(self, a: Dual, b: Dual) -> Dual:
        return self.extreme(a, b, -1)

    def extreme(self, a: Dual, b: Dual, order: int) -> Dual:
        """Return the minimum if `order` is 1, the maximum if it is −1."""
        if _is_zero(b).all():
            ahead = -order * self.settle(a)
        elif _is_zero(a).all():
            ahead = order * self.settle(b)
        else:
            ahead = self.settled((b.value - a.value).sign * order)
        value = balls64.minimum(a.value, b.value) if order > 0 else balls64.maximum(a.value, b.value)
        value = where(ahead > 0, a.value, where(ahead < 0, b.value, value))
        result = Dual(value, balls64.pick(_signs(ahead), a.slope, b.slope))
        self.known[id(result)] = result, np.where(ahead > 0, self.of(a), np.where(ahead < 0, self.of(b), 0))
        return result

    def length(self, *parts: Dual) -> Dual:
        """Return √(u² + v² + …), which is |u| where everything else is 0."""
        whole: Dual = _LENGTH(*parts)
        value, slope = whole.value, whole.slope
        zero = [np.broadcast_to(_is_zero(p), self.free.shape) for p in parts]
        for k, part in enumerate(parts):
            alone = np.ones(self.free.shape, dtype=bool)
            for others in zero[:k] + zero[k + 1 :]:
                alone &= others
            signed = balls64.pick(_signs(self.of(part)), part.slope, -part.slope)
            value, slope = where(alone, balls64.absolute(part.value), value), where(alone, signed, slope)
        return Dual(value, slope)


_LENGTH = dual_functions(balls64.FUNCTIONS)["length"]
