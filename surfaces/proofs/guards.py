"""Find where a tape's operations need a value: inside a part of a select, only where that part is taken.

A guard is what is known where an operation is needed on every way from the output: which conditions hold, and which do
not. Guards form a tree, whose root knows nothing; an operation that is needed in two places has what both share.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

import numpy as np

from surfaces.proofs.signs import Fact, linear
from surfaces.tape import Op, Tape

DEEPEST = 40  # conditions around one operation that are kept track of; more are left out, which proves less
MOST_FACTS = 64


@dataclass(frozen=True)
class Guards:
    """Hold the tree of guards: for each its parent, its depth, and the condition with its outcome.

    `of` has the guard of each operation, the root 0 for one that is needed everywhere, and None for one that is not
    needed.
    """

    parent: tuple[int, ...]
    depth: tuple[int, ...]
    literal: tuple[tuple[int, bool], ...]
    of: tuple[int | None, ...]

    def literals(self, guard: int) -> list[tuple[int, bool]]:
        """Return the conditions of a guard, with whether they hold."""
        found = []
        while guard:
            found.append(self.literal[guard])
            guard = self.parent[guard]
        return found


def guards_of(tape: Tape) -> Guards:
    """Return the guards of a tape's operations."""
    parent, depth, literal = [0], [0], [(0, True)]
    known: dict[tuple[int, int, bool], int] = {}
    of: list[int | None] = [None] * len(tape.ops)

    def under(guard: int, condition: int, holds: bool) -> int:
        if depth[guard] == DEEPEST:
            return guard
        key = (guard, condition, holds)
        if key not in known:
            known[key] = len(parent)
            parent.append(guard)
            depth.append(depth[guard] + 1)
            literal.append((condition, holds))
        return known[key]

    def need(index: int, guard: int) -> None:
        other = of[index]
        if other is None:
            of[index] = guard
            return
        while other != guard:
            if depth[other] >= depth[guard]:
                other = parent[other]
            else:
                guard = parent[guard]
        of[index] = guard

    for output in tape.outputs:
        need(output, 0)
    for index in reversed(range(len(tape.ops))):
        guard, op = of[index], tape.ops[index]
        if guard is None:
            continue
        if op.name == "select":
            need(op.args[0], guard)
            need(op.args[1], under(guard, op.args[0], True))
            need(op.args[2], under(guard, op.args[0], False))
        else:
            for i in op.inputs:
                need(i, guard)
    return Guards(tuple(parent), tuple(depth), tuple(literal), tuple(of))


def facts_of(tape: Tape, guards: Guards, guard: int) -> list[Fact]:
    """Return what the conditions of a guard say of sums of operations; of what they say in other ways, nothing."""
    found: list[Fact] = []
    stack = guards.literals(guard)
    while stack and len(found) < MOST_FACTS:
        index, holds = stack.pop()
        op = tape.ops[index]
        if op.name == "sub" and tape.ops[op.args[0]] == Op("const", (Fraction(1),)):
            stack.append((op.args[1], not holds))
        elif op.name == ("min" if holds else "max"):
            stack += [(i, holds) for i in op.args]
        elif op.name == "below":
            a, b = op.args if holds else reversed(op.args)
            found += _compared(tape, a, b, ">=" if holds else ">")
        elif op.name == "min" and _equality(tape, *op.args):
            a, b = tape.ops[op.args[0]].args
            found += _compared(tape, a, b, "!=")
    return found


def _equality(tape: Tape, a: int, b: int) -> bool:
    """Return whether two conditions together say that two values are equal."""
    first, second = tape.ops[a], tape.ops[b]
    return first.name == second.name == "below" and first.args == second.args[::-1]


def _compared(tape: Tape, a: int, b: int, how: Literal[">=", ">", "!="]) -> list[Fact]:
    """Return how b - a compares with 0, and what follows for the base of a power or of an absolute value."""
    first, second = linear(tape, a), linear(tape, b)
    if first is None or second is None:
        return []
    (less, below), (more, above) = first, second
    terms = {i: more.get(i, Fraction(0)) - less.get(i, Fraction(0)) for i in {*less, *more}}
    terms = {i: factor for i, factor in terms.items() if factor}
    found = [Fact(terms, above - below, how)] if terms else []
    if len(terms) != 1 or above != below:
        return found
    (index, factor) = next(iter(terms.items()))
    op = tape.ops[index]
    while op.name in ("abs", "sqr", "powi"):
        if op.name != "powi" or op.args[1] % 2 == 0:
            if how == ">=":
                break
            how = "!="
        form, op = linear(tape, op.args[0]), tape.ops[op.args[0]]
        if form:
            found.append(Fact({i: f * factor for i, f in form[0].items()}, form[1] * factor, how))
    return found


def live_on(tape: Tape, values: list[Any], boxes: int) -> list[Any]:
    """Return for each operation on which boxes its value may be needed: True, or bool[boxes].

    `values` are the ranges of the operations on the boxes, as surfaces.proofs.ranges computes them.
    """
    live: list[Any] = [False] * len(tape.ops)
    for output in tape.outputs:
        live[output] = True
    for index in reversed(range(len(tape.ops))):
        here, op = live[index], tape.ops[index]
        if here is False:
            continue
        parts = [here] * len(op.inputs)
        if op.name == "select":
            low, high = values[op.args[0]]
            first, second = np.broadcast_to(low > 0.0, boxes), np.broadcast_to(high < 1.0, boxes)  # c is 0 or 1
            parts = [here, ~second & here, ~first & here]
        for i, part in zip(op.inputs, parts, strict=True):
            live[i] = part if live[i] is False else True if part is True or live[i] is True else live[i] | part
    return live
