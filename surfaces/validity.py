"""Prove by ball arithmetic on boxes that f is defined all over its domain, or refuse the formula."""

from __future__ import annotations

from collections import deque
from typing import Any

from surfaces.evaluation import tape_of
from surfaces.formula import degree
from surfaces.lowering import enclosures
from surfaces.model import Box, Domain, FirsthitError, Surface
from surfaces.numbers import Balls
from surfaces.tape import Tape, walk

MAX_BOXES = 3000
MAX_OPERATIONS = 300_000  # ball operations spent on one formula, which take about half a second
_CONDITIONS = {
    "div": "a divisor must not vanish",
    "log": "log needs a positive argument",
    "sqrt": "sqrt needs an argument that is not negative",
    "tan": "tan must stay off its poles",
}
_ENOUGH = {"sqrt": 1, "log": 2, "div": 2}  # from which of `signs_of` on no proof on boxes is needed


def check(surface: Surface) -> None:
    """Raise FirsthitError if f does not depend on x, y, z, or cannot be shown to be defined all over the domain."""
    tape = tape_of(surface)
    try:
        enclosures(tape)
    except ZeroDivisionError as error:
        raise FirsthitError(f"{surface.name}: {error}; the formula has no value") from None
    constant = tape.constants()
    if constant[tape.outputs[0]] or degree(tape) in (-1, 0):
        raise FirsthitError(f"{surface.name}: the formula does not depend on x, y, z: it describes no surface")
    conditions = [(op.name, op.inputs[-1]) for op in tape.ops if op.name in _CONDITIONS and not constant[op.inputs[-1]]]
    signs = signs_of(tape)
    for name, index in dict.fromkeys(conditions):
        if signs[index] >= _ENOUGH.get(name, 3):
            continue
        argument = Tape(tape.ops, (index,)).pruned()
        _prove(surface, name, argument, min(MAX_BOXES, MAX_OPERATIONS // (len(conditions) * len(argument.ops))))


def signs_of(tape: Tape) -> list[int]:
    """Return for each operation 2 if its structure shows that it is positive, 1 if not negative, else 0.

    Squares, absolute values and roots are not negative; exponentials are positive. Sums, products, quotients, minima
    and maxima follow from their parts.
    """
    known: list[int] = []
    for op in tape.ops:
        of = [known[i] for i in op.inputs]
        match op.name:
            case "const":
                sign = 2 if op.args[0] > 0 else int(op.args[0] == 0)
            case "pi" | "e" | "exp":
                sign = 2
            case "sqr" | "abs" | "sqrt":
                sign = max(1, of[0])
            case "powi":
                sign = max(of[0], int(op.args[1] % 2 == 0))
            case "add":
                sign = max(of) if min(of) else 0
            case "mul" | "div" | "min":
                sign = min(of)
            case "max":
                sign = max(of)
            case _:
                sign = 0
        known.append(sign)
    return known


def _prove(surface: Surface, name: str, argument: Tape, budget: int) -> None:
    """Prove that an operation is defined for its argument all over the domain, on boxes that are halved, breadth first.

    Raises FirsthitError if `budget` boxes do not prove it. Boxes are halved along their longest side.
    """
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


def _outside(domain: Domain, point: list[Any]) -> bool:
    """Return whether a box, three flint.arb, is proved to lie outside the domain."""
    if isinstance(domain, Box):
        return False
    squares = Balls()
    distance = sum(squares.sqr(p - c) for p, c in zip(point, domain.center, strict=True))
    return bool(distance > domain.radius * domain.radius)


def _holds(name: str, value: Any) -> bool:
    """Return whether an operation is proved to be defined for all of a flint.arb."""
    if name == "sqrt":
        return bool(value >= 0)
    if name == "log":
        return bool(value > 0)
    return not (value.cos() if name == "tan" else value).contains(0)
