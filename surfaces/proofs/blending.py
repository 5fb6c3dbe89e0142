"""Prove that a sum is a smooth minimum or maximum of two of its parts: a convex combination of them in every direction.

**Theory.** With d = b - a, a polynomial smooth minimum is b + P(d) for a function P that is a polynomial on each of
some intervals of d. Its slopes by a and b are -P'(d) and 1 + P'(d), which add up to 1; where -1 <= P' <= 0 both are
shares, so that no gradient of the sum leaves the convex hull of the gradients of a and b. The sum is computed exactly,
in rationals, on intervals of d between which a clamp, a minimum or an absolute value changes its part.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from surfaces.tape import Op

MOST_STEPS = 60  # operations between a blend and its two parts
MOST_PIECES = 16
MOST_PAIRS = 6  # that are tried
Poly = tuple[Fraction, ...]  # coefficients in d, the lowest power first, without zeros at the end
_INSIDE = ("add", "sub", "neg", "mul", "sqr", "powi", "min", "max", "abs", "const")


class NotAPolynomialError(Exception):
    """Say that an operation is no polynomial in d, plus one in d times b."""


@dataclass(frozen=True)
class Piece:
    """Hold the value `own` + b `of_b` on an interval of d; an end that is None is infinite."""

    low: Fraction | None
    high: Fraction | None
    own: Poly
    of_b: Poly


def is_blend(ops: Sequence[Op], op: Op) -> tuple[int, int] | None:
    """Return two operations of which `op`, a sum, is proved to be a convex combination, or that negated, else None."""
    for a, b in _pairs(ops, op):
        try:
            pieces = _run(ops, op, a, b)
        except NotAPolynomialError:
            continue
        if all(map(_is_share, pieces)) or all(map(_is_share, _negated(pieces))):
            return a, b
    return None


def _pairs(ops: Sequence[Op], op: Op) -> list[tuple[int, int]]:
    """Return the pairs of operations that stand in a difference, a minimum or a maximum near to `op`."""
    found: list[tuple[int, int]] = []
    seen: set[int] = set()
    layer = [op]
    steps = 0
    while layer and steps < MOST_STEPS and len(found) < MOST_PAIRS:
        following: list[Op] = []
        for at in layer:
            steps += 1
            if at.name in ("sub", "min", "max") and all(ops[i].name != "const" for i in at.args):
                pair = (min(at.args), max(at.args))
                found += [pair] if pair not in found else []
            for i in at.inputs:
                if i not in seen and ops[i].name in _INSIDE:
                    seen.add(i)
                    following.append(ops[i])
        layer = following
    return found[:MOST_PAIRS]


def _run(ops: Sequence[Op], op: Op, a: int, b: int) -> list[Piece]:
    """Compute a sum in pieces. Raises NotAPolynomialError where it depends on more than the operations a and b."""
    one = (Fraction(1),)
    known = {a: [Piece(None, None, (Fraction(0), Fraction(-1)), one)], b: [Piece(None, None, (), one)]}
    order: list[int] = []
    stack = [i for i in op.inputs if i not in known]
    while stack:
        i = stack.pop()
        if i in known or i in order:
            continue
        if ops[i].name not in _INSIDE or len(order) > MOST_STEPS:
            raise NotAPolynomialError
        order.append(i)
        stack += ops[i].inputs
    for i in sorted(order):
        known[i] = _value(ops[i], known)
    return _value(op, known)


def _value(op: Op, known: dict[int, list[Piece]]) -> list[Piece]:
    if op.name == "const":
        return [Piece(None, None, _trimmed([op.args[0]]), ())]
    of = [known[i] for i in op.inputs]
    if op.name == "neg":
        return _negated(of[0])
    if op.name == "sqr":
        return _joined(of[0], of[0], _product)
    if op.name == "powi":
        value = of[0]
        for _ in range(op.args[1] - 1):
            value = _joined(value, of[0], _product)
        return value
    if op.name == "abs":
        return _extreme(of[0], _negated(of[0]), most=True)
    if op.name in ("min", "max"):
        return _extreme(of[0], of[1], most=op.name == "max")
    if op.name == "mul":
        return _joined(of[0], of[1], _product)
    return _joined(of[0], of[1] if op.name == "add" else _negated(of[1]), _total)


def _negated(pieces: list[Piece]) -> list[Piece]:
    minus = (Fraction(-1),)
    return [Piece(p.low, p.high, _times(p.own, minus), _times(p.of_b, minus)) for p in pieces]


def _total(p: Piece, q: Piece) -> tuple[Poly, Poly]:
    return _plus(p.own, q.own), _plus(p.of_b, q.of_b)


def _product(p: Piece, q: Piece) -> tuple[Poly, Poly]:
    if p.of_b and q.of_b:
        raise NotAPolynomialError
    return _times(p.own, q.own), _plus(_times(p.own, q.of_b), _times(p.of_b, q.own))


def _joined(
    first: list[Piece], second: list[Piece], combine: Callable[[Piece, Piece], tuple[Poly, Poly]]
) -> list[Piece]:
    """Combine two piecewise values on the intervals that both have."""
    made = []
    for p in first:
        for q in second:
            low = q.low if p.low is None else p.low if q.low is None else max(p.low, q.low)
            high = q.high if p.high is None else p.high if q.high is None else min(p.high, q.high)
            if low is None or high is None or low < high:
                made.append(Piece(low, high, *combine(p, q)))
    if len(made) > MOST_PIECES:
        raise NotAPolynomialError
    return made


def _extreme(first: list[Piece], second: list[Piece], most: bool) -> list[Piece]:
    """Return the maximum, or the minimum, of two piecewise values whose difference is linear in d on every piece."""
    made: list[Piece] = []
    apart = _joined(first, _negated(second), _total)
    values = [_joined(first, second, lambda *of, k=k: (of[k].own, of[k].of_b)) for k in (0, 1)]
    for gap, p, q in zip(apart, *values, strict=True):
        if gap.of_b or len(gap.own) > 2:
            raise NotAPolynomialError
        if len(gap.own) < 2:
            made.append(p if (bool(gap.own) and gap.own[0] > 0) == most else q)
            continue
        root = -gap.own[0] / gap.own[1]
        before, behind = (q, p) if (gap.own[1] > 0) == most else (p, q)  # `first` is larger behind the root if rising
        if gap.low is None or gap.low < root:
            made.append(Piece(gap.low, root if gap.high is None else min(root, gap.high), before.own, before.of_b))
        if gap.high is None or root < gap.high:
            made.append(Piece(root if gap.low is None else max(root, gap.low), gap.high, behind.own, behind.of_b))
    if len(made) > MOST_PIECES:
        raise NotAPolynomialError
    return made


def _is_share(piece: Piece) -> bool:
    """Return whether a piece is b + P(d) with -1 <= P' <= 0, where P' is at most a quadratic polynomial."""
    slope = [k * c for k, c in enumerate(piece.own)][1:]
    if piece.of_b != (Fraction(1),) or len(slope) > 3:
        return False
    if len(slope) <= 1:
        return -1 <= (slope[0] if slope else 0) <= 0
    if piece.low is None or piece.high is None:
        return False
    at = [piece.low, piece.high]
    if len(slope) == 3 and piece.low < (turn := -slope[1] / (2 * slope[2])) < piece.high:
        at.append(turn)
    return all(-1 <= sum(c * d**k for k, c in enumerate(slope)) <= 0 for d in at)


def _trimmed(values: list[Fraction]) -> Poly:
    while values and values[-1] == 0:
        values.pop()
    return tuple(values)


def _plus(p: Poly, q: Poly) -> Poly:
    n, zero = max(len(p), len(q)), Fraction(0)
    return _trimmed([(p[k] if k < len(p) else zero) + (q[k] if k < len(q) else zero) for k in range(n)])


def _times(p: Poly, q: Poly) -> Poly:
    if not p or not q:
        return ()
    made = [Fraction(0)] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, c in enumerate(q):
            made[i + j] += a * c
    return _trimmed(made)
