"""Compute how large a box may be for a surface's interval extension to overflow nowhere.

Ball arithmetic over the whole box bounds the result of every operation on any part of it. If all these bounds are far
below the precision's largest number, generated code tests the box once in place of every operation.
"""

from __future__ import annotations

import math

from harness.contract import Box, Precision, Surface
from surfaces.evaluation import tape_of
from surfaces.numbers import Balls
from surfaces.proofs.signs import ranges_of
from surfaces.tape import LEAVES, Tape, walk

SAFE = LEAVES | {"add", "sub", "mul", "sqr", "powi", "neg", "abs", "min", "max", "exp", "sin", "cos"}
SAFE |= {"floor", "below", "select", "sign", "atan2"}  # these have finite results too
ROOTS = frozenset({"sqrt", "powr"})
LARGEST: dict[Precision, int] = {"float32": 2**100, "float64": 2**1000}  # overflow is at 2^128 and 2^1024
MARGIN = 2.0  # how much farther out than the domain a box may reach


def safe_reach(surface: Surface, precision: Precision) -> float | None:
    """Return a power of two below which a box's size rules out overflow, where size is the sum of |end| over all ends.

    The domain's own box is below it. Returns None if that is not proved: the formula has a division, logarithm or
    tangent of its variables, a root of what may be negative, or a value that may be too large.
    """
    tape = tape_of(surface)
    if not _is_safe(tape):
        return None
    domain = surface.domain
    corners = (domain.lower, domain.upper) if isinstance(domain, Box) else (domain.center,)
    ends = [max(abs(corner[axis]) for corner in corners) for axis in range(3)]
    farthest = sum(ends) + (0.0 if isinstance(domain, Box) else 3.0 * domain.radius)
    reach = 2.0 ** math.ceil(math.log2(MARGIN * 2.0 * farthest))
    return reach if all(size < LARGEST[precision] for size in sizes_within(tape, reach)) else None


def sizes_within(tape: Tape, reach: float) -> list[float]:
    """Return a bound of the magnitude of each operation's value over boxes within reach; it may be infinite or NaN."""
    import flint

    box = dict.fromkeys("xyz", flint.arb(0, reach))
    values = walk(Tape(tape.ops, tuple(range(len(tape.ops)))), Balls(), box)
    return [1.01 * float(abs(value).upper()) for value in values]


def _is_safe(tape: Tape) -> bool:
    """Return whether every operation on variables has a finite result where its inputs are below the largest number.

    A root has one of what is not negative, whatever the variables are: rounding may take an interval's lower end below
    0, but not its upper end.
    """
    ranges = ranges_of(tape) if ROOTS & {op.name for op in tape.ops} else []
    return all(
        fixed or op.name in SAFE or (op.name in ROOTS and ranges[op.args[0]].low >= 0.0)
        for op, fixed in zip(tape.ops, tape.constants(), strict=True)
    )
