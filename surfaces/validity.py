"""Is f defined, and finite, all over its domain? Proved by ball arithmetic on ever smaller boxes, or refused."""

from __future__ import annotations

from typing import Any

from harness.contract import Box, FirsthitError, Sphere, Surface
from surfaces.evaluation import tape_of
from surfaces.formula import degree
from surfaces.lowering import enclosures
from surfaces.numbers import Balls
from surfaces.tape import Tape, walk

MAX_BOXES = 3000
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
    for op in tape.ops:
        argument = op.inputs[-1] if op.name in _CONDITIONS else None
        if argument is not None and not constant[argument]:
            _prove(surface, op.name, Tape(tape.ops, (argument,)).pruned())


def _prove(surface: Surface, name: str, argument: Tape) -> None:
    import flint

    domain = surface.domain
    lower = domain.lower if isinstance(domain, Box) else tuple(c - domain.radius for c in domain.center)
    upper = domain.upper if isinstance(domain, Box) else tuple(c + domain.radius for c in domain.center)
    boxes = [(tuple((a + b) / 2 for a, b in zip(lower, upper, strict=True)), tuple((b - a) / 2 for a, b in zip(lower, upper, strict=True)))]
    numbers = Balls()
    for _ in range(MAX_BOXES):
        if not boxes:
            return
        middle, half = boxes.pop(0)
        point = [flint.arb(m, h) for m, h in zip(middle, half, strict=True)]
        if _outside(domain, point) or _holds(name, walk(argument, numbers, dict(zip("xyz", point, strict=True)))[0]):
            continue
        axis = max(range(3), key=lambda i: half[i])
        smaller = tuple(h / 2 if i == axis else h for i, h in enumerate(half))
        for side in (-1, 1):
            boxes.append((tuple(m + side * smaller[i] if i == axis else m for i, m in enumerate(middle)), smaller))
    where = ", ".join(f"{m:.3g}" for m in boxes[0][0])
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
