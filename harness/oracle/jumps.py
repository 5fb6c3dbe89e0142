"""Compute ranges of f on a piece separately for each side of the jumps that may lie in it.

**Theory.** A floor jumps where its argument is a whole number, a comparison where both sides are equal, and atan2 on
the half line y = 0, x <= 0. If such a place may lie in a piece, each point of the piece still lies on one side or the
other, and the place itself belongs to one of them: f is there what that side's formula says. So if f is off 0 for each
side's formula, computed over the whole piece, the piece holds no root. This says nothing about signs on the two sides:
f need not be continuous between them.

Up to DEPTH jumps of a piece are told apart. The ranges of further ones hold the values of both sides.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np
from flint import arb
from numpy.typing import NDArray

from harness.oracle import balls64, reals
from harness.oracle.balls64 import Balls
from harness.oracle.program import Functions

DEPTH = 2


def sides() -> Iterator[tuple[int, ...]]:
    """Return every choice of sides, 1 or −1, of DEPTH jumps."""
    return product((1, -1), repeat=DEPTH)


def meets_cut(y: Any, x: Any) -> bool:
    """Return whether a box of two flint.arb may meet the half line y = 0, x <= 0 and leave it."""
    return bool(y.contains(0) and not x > 0 and not (y == 0 and x < 0))


class Sided:
    """Define the functions of one run in arb in which the first jumps that are open lie on given sides."""

    def __init__(self, chosen: tuple[int, ...]) -> None:
        self.left = list(chosen)

    def functions(self) -> Functions:
        """Return the elementary functions of this run."""
        return {**reals.FUNCTIONS, "floor": self.floor, "below": self.below, "atan2": self.atan2}

    def settled(self) -> int:
        """Return the side of the next open jump; 0 if no more are told apart."""
        return self.left.pop(0) if self.left else 0

    def floor(self, a: Any) -> Any:
        value = reals.floor(a)
        low, high = a.lower().floor(), a.upper().floor()
        side = self.settled() if high - low == 1 else 0
        return high if side > 0 else low if side < 0 else value

    def below(self, a: Any, b: Any) -> Any:
        value = reals.below(a, b)
        side = 0 if value.is_exact() else self.settled()
        return arb(int(side > 0)) if side else value

    def atan2(self, y: Any, x: Any) -> Any:
        side = self.settled() if meets_cut(y, x) else 0
        if not side:
            return arb.atan2(y, x)
        return side * _angles((side * y).upper(), x)


def _angles(high: Any, x: Any) -> Any:
    """Enclose the angles of a box with y from 0 to `high`, not less than 0; they are monotone between its corners."""
    corners = [arb.atan2(v, h) for v in (arb(0), high) for h in (x.lower(), x.upper())]
    result = corners[0]
    for corner in corners[1:]:
        result = result.union(corner)
    return result


class Sided64:
    """Define the functions of one run in float64 balls in which each piece's first open jumps lie on given sides."""

    def __init__(self, chosen: tuple[int, ...], shape: tuple[int, ...]) -> None:
        self.chosen = np.array([*chosen, 0], dtype=np.int8)
        self.count = np.zeros(shape, dtype=np.intp)  # the open jumps that each piece has met

    def functions(self) -> Functions:
        """Return the elementary functions of this run."""
        return {**balls64.FUNCTIONS, "floor": self.floor, "below": self.below, "atan2": self.atan2}

    def settled(self, open_: Any) -> NDArray[np.int8]:
        """Return int8[...]: the side of each piece's next jump where it is `open_`, bool[...]; 0 where none is."""
        open_ = np.broadcast_to(open_, self.count.shape)
        side = np.where(open_, self.chosen[np.minimum(self.count, len(self.chosen) - 1)], 0)
        self.count += open_
        return np.asarray(side, np.int8)

    def floor(self, a: Balls) -> Balls:
        value, (low, high) = balls64.floor(a), balls64.floors(a)
        side = self.settled(high - low == 1.0)
        return balls64.where(side > 0, Balls(high), balls64.where(side < 0, Balls(low), value))

    def below(self, a: Balls, b: Balls) -> Balls:
        value = balls64.below(a, b)
        side = self.settled(value.rad > 0.0)
        return balls64.where(side == 0, value, Balls(np.where(side > 0, 1.0, 0.0)))

    def atan2(self, y: Balls, x: Balls) -> Balls:
        side = self.settled(balls64.meets_cut(y, x))
        over = balls64.angles(0.0, np.maximum(y.upper, 0.0), x)
        under = -balls64.angles(0.0, np.maximum(-y.lower, 0.0), x)
        return balls64.where(side > 0, over, balls64.where(side < 0, under, balls64.atan2(y, x)))
