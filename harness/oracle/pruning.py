"""Shorten a program for a piece of a ray: what a minimum, maximum or choice does not take there is left out.

**Theory.** If one argument of a maximum is nowhere on the piece under a number, an argument that is under that number
everywhere is never taken. Arguments of a maximum of a maximum count as its own. On smaller pieces the same holds, so
that a piece's shorter program serves all its parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from harness.oracle.program import CHOICES, Instruction, Program

LONG = 40  # instructions from which on a program is worth shortening


def is_prunable(program: Program) -> bool:
    """Return whether a program may become shorter on a piece, and is worth it."""
    return len(program.instructions) >= LONG and program.chooses


def pruned(program: Program, balls: Sequence[Any]) -> Program:
    """Return a program with the same values wherever each instruction's result lies in its ball (flint.arb).

    It is the same object if nothing can be left out.
    """
    taken = _taken(program, balls)
    if all(k in taken and taken[k] == i.args for k, i in enumerate(program.instructions)):
        return program
    instructions: list[Instruction] = []
    number: dict[int, int] = {}
    for k in sorted(taken):
        i, args = program.instructions[k], [number[a] for a in taken[k]]
        if i.name in CHOICES and len(args) == 1:
            number[k] = args[0]
            continue
        while i.name in ("min", "max") and len(args) > 2:
            instructions.append(Instruction(i.name, (args[0], args[1])))
            args[:2] = [len(instructions) - 1]
        instructions.append(Instruction(i.name, tuple(args), i.index, i.exponent))
        number[k] = len(instructions) - 1
    last = number[len(program.instructions) - 1]
    return Program(tuple(instructions[: last + 1]), program.constants)


def _taken(program: Program, balls: Sequence[Any]) -> dict[int, tuple[int, ...]]:
    """Return for each instruction that is needed those results that it takes."""
    uses = [0] * len(program.instructions)
    for i in program.instructions:
        for a in i.args:
            uses[a] += 1
    last = len(program.instructions) - 1
    needed, taken = {last}, dict[int, tuple[int, ...]]()
    for k in range(last, -1, -1):
        if k not in needed:
            continue
        i = program.instructions[k]
        taken[k] = i.args
        if i.name == "select":
            condition, p, q = i.args
            known = balls[condition]
            taken[k] = (p,) if known > 0.5 else (q,) if known < 0.5 else i.args
        elif i.name in ("min", "max"):
            taken[k] = _active(i.name, _leaves(program, k, uses), balls)
        needed.update(taken[k])
    return taken


def _leaves(program: Program, k: int, uses: Sequence[int]) -> list[int]:
    """Return the arguments of a minimum or maximum, with those of its arguments that are one too and serve it alone."""
    leaves, stack = [], [k]
    while stack:
        at = stack.pop()
        i = program.instructions[at]
        if at == k or (i.name == program.instructions[k].name and uses[at] == 1):
            stack += i.args[::-1]
        else:
            leaves.append(at)
    return list(dict.fromkeys(leaves))


def _active(name: str, leaves: list[int], balls: Sequence[Any]) -> tuple[int, ...]:
    """Return the arguments that may be taken somewhere."""
    bound = None
    for a in leaves:
        end = balls[a].lower() if name == "max" else balls[a].upper()
        if end.is_finite() and (bound is None or (end > bound if name == "max" else end < bound)):
            bound = end
    if bound is None:
        return tuple(leaves)
    return tuple(a for a in leaves if not (balls[a] < bound if name == "max" else balls[a] > bound))
