"""Prove that f is defined all over its domain, or refuse the formula.

A divisor must not vanish, a logarithm needs a positive argument, a root and a power with a fraction one that is not
negative, and the tangent must stay off its poles. What stands in a part of a select needs its value only where the part
is taken. Three proofs are tried: by the structure alone (`signs`), by the structure with what the conditions around an
operation say (`guards`), and on boxes that are halved (`ranges`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surfaces.evaluation import Floats64, tape_of
from surfaces.formula import degree
from surfaces.lowering import enclosures
from surfaces.model import Domain, FirsthitError, Surface
from surfaces.proofs.boxes import box_about, corners, halved, outside
from surfaces.proofs.guards import Guards, facts_of, guards_of, live_on
from surfaces.proofs.ranges import has_value, run, sides
from surfaces.proofs.signs import Range, ranges_of
from surfaces.tape import Tape

MAX_BOXES = 60_000
MAX_STEPS = 25_000  # operations on batches of boxes, about 20 µs each: half a second
MAX_BATCH = 1024  # boxes at once
MAX_GUARDED = 200_000  # operations bounded once more with what conditions say, about 2 µs each
_CONDITIONS = {
    "div": "a divisor must not vanish, also where the dividend does",
    "log": "log needs a positive argument",
    "sqrt": "sqrt needs an argument that is not negative",
    "powr": "a power that is no whole number needs a base that is not negative",
    "tan": "tan must stay off its poles",
}
Condition = tuple[str, int]  # the operation's name, and the index of the argument that the condition is on


def check(surface: Surface) -> None:
    """Raise FirsthitError if f does not depend on x, y, z, or cannot be shown to be defined all over the domain."""
    tape = tape_of(surface)
    check_constants(surface.name, tape)
    if problem := undefined(tape, surface.domain):
        raise FirsthitError(f"{surface.name}: {problem}")


def check_constants(name: str, tape: Tape) -> None:
    """Raise FirsthitError, which names the surface, if a tape's constants have no values, or it is constant itself."""
    try:
        enclosures(tape)
    except ZeroDivisionError as error:
        raise FirsthitError(f"{name}: {error}; the formula has no value") from None
    if tape.constants()[tape.outputs[0]] or degree(tape) in (-1, 0):
        raise FirsthitError(f"{name}: the formula does not depend on x, y, z: it describes no surface")


def undefined(tape: Tape, domain: Domain) -> str | None:
    """Say what cannot be shown to be defined all over a domain, and where; None where all of the tape can."""
    constant = tape.constants()
    asked = dict.fromkeys(
        ((op.name, op.inputs[-1]), i)
        for i, op in enumerate(tape.ops)
        if op.name in _CONDITIONS and not constant[op.inputs[-1]]
    )
    if not asked:
        return None
    box = box_about(domain)
    known = ranges_of(tape, box)
    left = [(condition, user) for condition, user in asked if not shown(condition[0], known[condition[1]])]
    if left and any(op.name == "select" for op in tape.ops):
        left = _unguarded(tape, box, left)
    return _on_boxes(tape, domain, left) if left else None


def shown(name: str, known: Range) -> bool:
    """Return whether a range of its argument shows that an operation is defined."""
    if name in ("sqrt", "powr"):
        return known.low >= 0.0
    if name == "log":
        return known.positive
    return name == "div" and known.not_zero


def _unguarded(
    tape: Tape, box: dict[str, tuple[float, float]], left: list[tuple[Condition, int]]
) -> list[tuple[Condition, int]]:
    """Return those conditions that are not shown by what holds where their operations are needed."""
    guards = guards_of(tape)
    groups: dict[int, list[tuple[Condition, int]]] = {}
    for one in left:
        guard = guards.of[one[1]]
        if guard is not None:
            groups.setdefault(guard, []).append(one)
    open_: list[tuple[Condition, int]] = groups.pop(0, [])
    spent = 0
    for guard, conditions in groups.items():
        open_ += _under(tape, guards, guard, box, conditions) if spent < MAX_GUARDED else conditions
        spent += len(tape.ops)
    return open_


def _under(
    tape: Tape,
    guards: Guards,
    guard: int,
    box: dict[str, tuple[float, float]],
    conditions: list[tuple[Condition, int]],
) -> list[tuple[Condition, int]]:
    """Return those conditions that are not shown where a guard holds."""
    known = ranges_of(tape, box, facts_of(tape, guards, guard))
    return [one for one in conditions if not shown(one[0][0], known[one[0][1]])]


def _on_boxes(tape: Tape, domain: Domain, left: list[tuple[Condition, int]]) -> str | None:
    """Prove conditions on boxes that are halved, breadth first; say which is not proved, and where, else None."""
    users: dict[Condition, list[int]] = {}
    for condition, user in left:
        users.setdefault(condition, []).append(user)
    if not any(op.name == "select" for op in tape.ops):  # then what is needed is needed everywhere
        pruned = Tape(tape.ops, tuple(index for _, index in users)).pruned()
        tape, users = pruned, {(name, i): [] for (name, _), i in zip(users, pruned.outputs, strict=True)}
    used = np.array([any(op.name == "var" and op.args[0] == axis for op in tape.ops) for axis in "xyz"])
    lower, upper = (np.array([corner], np.float64) for corner in corners(domain))
    batch = max(1, min(MAX_BATCH, 4_000_000 // len(tape.ops)))
    seen = steps = 0
    failed = next(iter(users))
    while len(lower) and seen < MAX_BOXES and steps <= MAX_STEPS - len(tape.ops):
        now, later = (lower[:batch], upper[:batch]), (lower[batch:], upper[batch:])
        steps, seen = steps + len(tape.ops), seen + len(now[0])
        open_, worst = _open(tape, users, *now)
        open_ &= ~outside(domain, *now)
        failed = worst or failed
        more = halved(now[0][open_], now[1][open_], used)
        lower, upper = np.concatenate((later[0], more[0])), np.concatenate((later[1], more[1]))
    if not len(lower):
        return None
    place = np.where(np.abs(place := _place(tape, failed, 0.5 * (lower + upper))) < 1e-9 * domain.radius, 0.0, place)
    where = ", ".join(f"{value:.3g}" for value in place)
    return f"{_CONDITIONS[failed[0]]}, and that cannot be shown all over the domain (look near {where})"


def _open(
    tape: Tape, users: dict[Condition, list[int]], lower: Floats64, upper: Floats64
) -> tuple[NDArray[np.bool_], Condition | None]:
    """Return on which boxes [n] some condition is not proved, and the first such condition; None where all are.

    `users` has the operations that need each condition; a condition without any is needed everywhere.
    """
    n, first = len(lower), None
    open_ = np.zeros(n, np.bool_)
    with np.errstate(all="ignore"):
        values = list(run(tape, sides(lower, upper)))
        live = live_on(tape, values, n) if any(users.values()) else []
        for condition, of in users.items():
            fails = np.broadcast_to(~has_value(condition[0], values[condition[1]]), n)
            if of:
                fails = fails & np.logical_or.reduce([np.broadcast_to(live[i], n) for i in of])
            if first is None and fails.any():
                first = condition
            open_ |= fails
    return open_, first


def _place(tape: Tape, condition: Condition, points: Floats64) -> Floats64:
    """Return that of the points float64[n, 3] at which the argument is nearest to breaking the condition."""
    points = points[:4096]
    if len(tape.ops) * len(points) > 4_000_000:
        return np.asarray(points[0])
    argument = Tape(tape.ops, (condition[1],)).pruned()
    with np.errstate(all="ignore"):
        low, high = list(run(argument, sides(points, points)))[argument.outputs[0]]
        middle = np.broadcast_to(0.5 * (low + high), len(points))
        middle = np.cos(middle) if condition[0] == "tan" else middle
        size = np.abs(middle) if condition[0] in ("div", "tan") else middle
    return np.asarray(points[int(np.argmin(np.where(np.isnan(size), np.inf, size)))])
