"""Enclose f along rays in float64 balls."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from harness.oracle import balls64, reals
from harness.oracle.balls64 import TINY, Balls, Floats
from harness.oracle.clip import points_at
from harness.oracle.dual import Dual, dual_functions
from harness.oracle.program import Functions, Program

DUAL_FUNCTIONS = dual_functions(balls64.FUNCTIONS)


class Enclosure:
    """Hold a program with its constants as float64 balls."""

    def __init__(self, program: Program) -> None:
        self.program = program
        with reals.precision(128):
            self.constants = [_ball(c) for c in program.constants.converted(reals.leaf, reals.FUNCTIONS)]
        # products of narrow balls are as good as squares, and faster
        self.functions: Functions = {} if program.is_polynomial else balls64.FUNCTIONS
        self.duals = [Dual(c, Balls(0.0)) for c in self.constants]

    def of(self, points: Sequence[Balls]) -> Balls:
        """Enclose f, [...], at points whose coordinates x, y and z are balls [...]."""
        f: Balls = self.program.run(points, self.constants, self.functions)
        return f

    def along(self, rays: Floats, t: Floats) -> Balls:
        """Enclose f at o + t·d of rays float64[n, 6] that hold float32 values, for `t` float64[n]."""
        return self.of(points_at(rays, t))

    def slopes(self, inputs: Sequence[Dual], functions: Functions = DUAL_FUNCTIONS) -> Dual:
        """Enclose f and its derivative, both as balls of the inputs' shape."""
        f: Dual = self.program.run(inputs, self.duals, functions)
        shape = np.shape(inputs[0].value.mid)
        return Dual(*(Balls(np.broadcast_to(b.mid, shape), np.broadcast_to(b.rad, shape)) for b in (f.value, f.slope)))


def _ball(constant: Any) -> Balls:
    """Return the float64 ball, [], that holds a constant, which is given as a flint.arb; zero stays exact."""
    if constant == 0:
        return Balls(0.0)
    mid = float(constant.mid())
    return Balls(mid, (abs(mid) * 2.0**-52 + float(constant.rad().upper())) * balls64.GROW + TINY)
