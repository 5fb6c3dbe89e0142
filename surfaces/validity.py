"""Is f defined, and finite, all over its domain? Proved by ball arithmetic on ever smaller boxes, or refused."""

from __future__ import annotations

from collections import deque
from typing import Any

from harness.contract import Box, FirsthitError, Sphere, Surface
from surfaces.evaluation import tape_of
from surfaces.formula import degree
from surfaces.lowering import enclosures
from surfaces.numbers import Balls
from surfaces.tape import Tape, walk

MAX_BOXES = 3000
MAX_OPERATIONS = 300_000  # ball operations spent on one formula: about half a second
_CONDITIONS = {
    "div": "a divisor must not vanish",
    "log": "log needs a positive argument",
    "sqrt": "sqrt needs an argument that is not negative",
    "tan": "tan must stay off its poles",
}


def check(surface: Surface) -> None:
    """Raises FirsthitError where f does not depend on x, y, z, or cannot be shown to be defined all over the domain."""
    tape = tape_of(surface)
    try:
        enclosures(tape)
    except ZeroDivisionError as error:
        raise FirsthitError(f"{surface.name}: {error}; the formula has no value") from None
    constant = tape.constants()
    if constant[tape.outputs[0]] or degree(tape) in (-1, 0):
        raise FirsthitError(f"{surface.name}: the formula does not depend on x, y, z: it describes no surface")
    conditions = [(op.name, op.inputs[-1]) for op in tape.ops if op.name in _CONDITIONS and not constant[op.inputs[-1]]]
    bounded_below = never_negative(tape)
    for name, index in dict.fromkeys(conditions):
        if name == "sqrt" and bounded_below[index]:
            continue
        argument = Tape(tape.ops, (index,)).pruned()
        _prove(surface, name, argument, min(MAX_BOXES, MAX_OPERATIONS // (len(conditions) * len(argument.ops))))


def never_negative(tape: Tape) -> list[bool]:
    """For each operation, whether its structure alone shows that it is nowhere negative, wherever it has a value.

    Squares, absolute values, roots and exponentials are not; nor are sums, products, quotients, minima of what is not,
    and maxima one side of which is not. False only says that the structure does not show it.
    """
    known: list[bool] = []
    for op in tape.ops:
        of = [known[i] for i in op.inputs]
        match op.name:
            case "const":
                holds = op.args[0] >= 0
            case "pi" | "e" | "sqr" | "abs" | "sqrt" | "exp":
                holds = True
            case "powi":
                holds = op.args[1] % 2 == 0 or of[0]
            case "add" | "mul" | "div" | "min":
                holds = all(of)
            case "max":
                holds = any(of)
            case _:
                holds = False
        known.append(holds)
    return known


def _prove(surface: Surface, name: str, argument: Tape, budget: int) -> None:
    """Breadth first over boxes, each halved along its longest side, `budget` of them at most."""
    import flint

    domain, numbers = surface.domain, Balls()
    center, radius = domain.center, domain.radius
    ends = (
        zip(domain.lower, domain.upper, strict=True)
        if isinstance(domain, Box)
        else [(c - radius, c + radius) for c in center]
    )
    boxes = deque([list(ends)])
    for _ in range(budget):
        if not boxes:
            return
        box = boxes.popleft()
        point = [flint.arb(a).union(flint.arb(b)) for a, b in box]
        if _outside(domain, point) or _holds(name, walk(argument, numbers, dict(zip("xyz", point, strict=True)))[0]):
            continue
        axis = max(range(3), key=lambda i: box[i][1] - box[i][0])
        lower, upper = box[axis]
        for half in ((lower, (lower + upper) / 2), ((lower + upper) / 2, upper)):
            boxes.append([half if i == axis else side for i, side in enumerate(box)])
    if boxes:
        where = ", ".join(f"{(lower + upper) / 2:.3g}" for lower, upper in boxes[0])
        raise FirsthitError(
            f"{surface.name}: {_CONDITIONS[name]}, and that cannot be shown all over the domain (look near {where})"
        )


def _outside(domain: Sphere | Box, point: list[Any]) -> bool:
    if isinstance(domain, Box):
        return False
    squares = Balls()
    distance = sum(squares.sqr(p - c) for p, c in zip(point, domain.center, strict=True))
    return bool(distance > domain.radius * domain.radius)


def _holds(name: str, value: Any) -> bool:
    if name == "sqrt":
        return bool(value >= 0)
    if name == "log":
        return bool(value > 0)
    return not (value.cos() if name == "tan" else value).contains(0)
