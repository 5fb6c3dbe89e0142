"""Bound every operation of a tape by its structure: a range, and whether the value can be zero.

One pass in plain floats goes over the tape. Beside the ranges of the parts it uses what no range tells: |a| + a is not
negative, a - floor(a) is in [0, 1), a quotient by a root that the dividend's square is under is in [-1, 1]. `given`
facts, such as x - 1 > 0 in the part of a select that is taken there, narrow the operations that they speak of, also
where the same sum is written in another way.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, nextafter
from typing import Literal, NamedTuple

from surfaces.proofs.ranges import bracket
from surfaces.tape import Op, Tape

MOST_TERMS = 64  # of a sum that is looked through
MORE = 2  # how a covers b, where a > |b|
_SLACK = 2.0**-44


class Range(NamedTuple):
    """Hold bounds of a value; `nonzero` says that it is never 0, which matters where a bound is 0."""

    low: float = -inf
    high: float = inf
    nonzero: bool = False

    @property
    def positive(self) -> bool:
        """Return whether every value is above 0."""
        return self.low > 0.0 or (self.low == 0.0 and self.nonzero)

    @property
    def not_zero(self) -> bool:
        """Return whether no value is 0."""
        return self.nonzero or self.low > 0.0 or self.high < 0.0

    def within(self, other: Range) -> Range:
        """Return what is known where both ranges hold."""
        return Range(max(self.low, other.low), min(self.high, other.high), self.nonzero or other.nonzero)


ANY = Range()


@dataclass(frozen=True)
class Fact:
    """State how a sum of operations, each times a rational, plus a constant, compares with 0."""

    terms: Mapping[int, Fraction]
    constant: Fraction
    how: Literal[">=", ">", "!="]


def ranges_of(
    tape: Tape, box: Mapping[str, tuple[float, float]] | None = None, given: Sequence[Fact] = ()
) -> list[Range]:
    """Return a range of each operation's value over a box of the variables, where it has one and the facts hold."""
    known: list[Range] = []
    named = {index for fact in given for index in fact.terms}
    for index, op in enumerate(tape.ops):
        if op.name == "var":
            low, high = (box or {}).get(op.args[0], (-inf, inf))
            value = Range(low, high)
        else:
            value = _own(op, known)
            if op.name in ("add", "sub", "div"):
                related = _related(tape.ops, op)
                value = value if related is ANY else value.within(related)
        if given:
            form = linear(tape, index) if op.name in ("add", "sub", "mul", "neg") or index in named else None
            value = value.within(_told(*form, given)) if form else value
        known.append(value)
    return known


def _told(terms: Mapping[int, Fraction], constant: Fraction, facts: Sequence[Fact]) -> Range:
    """Return what facts say of a sum: those whose own sum is a multiple of it, but for a constant."""
    value = ANY
    for fact in facts:
        if terms.keys() != fact.terms.keys():
            continue
        first = next(iter(terms))
        factor = terms[first] / fact.terms[first]
        if all(terms[i] == factor * fact.terms[i] for i in terms):
            rest = constant - factor * fact.constant  # the sum is factor * (what compares with 0) + rest
            nonzero = fact.how != ">=" and rest == 0
            if fact.how == "!=":
                value = value.within(Range(nonzero=nonzero))
            elif factor > 0:
                value = value.within(Range(low=bracket(rest)[0], nonzero=nonzero))
            else:
                value = value.within(Range(high=bracket(rest)[1], nonzero=nonzero))
    return value


def linear(tape: Tape, index: int) -> tuple[dict[int, Fraction], Fraction] | None:
    """Write an operation as a sum of others, each times a rational, and a constant; None past MOST_TERMS steps."""
    terms: dict[int, Fraction] = {}
    constant, steps = Fraction(0), 0
    stack = [(index, Fraction(1))]
    while stack:
        at, factor = stack.pop()
        op, steps = tape.ops[at], steps + 1
        if steps > MOST_TERMS:
            return None
        if op.name == "const":
            constant += factor * op.args[0]
        elif op.name in ("add", "sub"):
            stack += [(op.args[0], factor), (op.args[1], factor if op.name == "add" else -factor)]
        elif op.name == "neg":
            stack.append((op.args[0], -factor))
        elif op.name == "mul" and tape.ops[op.args[0]].name == "const":
            stack.append((op.args[1], factor * tape.ops[op.args[0]].args[0]))
        else:
            terms[at] = terms.get(at, Fraction(0)) + factor
    return {i: factor for i, factor in terms.items() if factor}, constant


def _related(ops: Sequence[Op], op: Op) -> Range:
    """Return what the parts of a sum, difference or quotient say about each other."""
    a, b = op.args
    if op.name == "div":
        return Range(-1.0, 1.0) if ops[b].name == "sqrt" and _root_covers(ops, b, a) else ANY
    if op.name == "add":
        covered = max(_covers(ops, a, b), _covers(ops, b, a))
        return Range(low=0.0, nonzero=covered == MORE) if covered else ANY
    if ops[b].name == "floor" and ops[b].args[0] == a:
        return Range(0.0, 1.0)
    if _modulo(ops, a, b):
        return Range(0.0, float("inf"))
    covered, covering = _covers(ops, a, b), _covers(ops, b, a)
    if covered or _is_one_of(ops[a], "max", b) or _is_one_of(ops[b], "min", a):
        return Range(low=0.0, nonzero=covered == MORE)
    if covering or _is_one_of(ops[b], "max", a) or _is_one_of(ops[a], "min", b):
        return Range(high=0.0, nonzero=covering == MORE)
    return ANY


def _is_one_of(op: Op, name: str, part: int) -> bool:
    """Return whether `op` is the minimum or maximum, by `name`, of a part and another."""
    return op.name == name and part in op.args


def _modulo(ops: Sequence[Op], a: int, b: int) -> bool:
    """Return whether a - b is a - c floor(a / c) for a rational c > 0, which is never negative."""
    if ops[b].name != "mul" or ops[ops[b].args[0]].name != "const" or ops[ops[b].args[1]].name != "floor":
        return False
    step, inner = ops[ops[b].args[0]].args[0], ops[ops[ops[b].args[1]].args[0]]
    if inner.name != "mul" or ops[inner.args[0]].name != "const":
        return False
    return bool(step > 0 and inner.args[1] == a and ops[inner.args[0]].args[0] * step == 1)


def _covers(ops: Sequence[Op], a: int, b: int) -> int:
    """Return MORE where the structure shows a > |b|, 1 where it shows a >= |b|, else 0."""
    if ops[a].name == "abs":
        inner = ops[a].args[0]
        return int(b in (inner, a) or (ops[b].name == "neg" and ops[b].args[0] == inner))
    return _root_covers(ops, a, b) if ops[a].name == "sqrt" else 0


def _root_covers(ops: Sequence[Op], root: int, b: int) -> int:
    """Return 1 or MORE where the argument of a root is a sum of squares, even powers and constants with that of b."""
    inner = ops[b].args[0] if ops[b].name in ("abs", "neg") else b
    stack, steps, found, more = [ops[root].args[0]], 0, False, False
    while stack:
        op, steps = ops[stack.pop()], steps + 1
        if steps > MOST_TERMS:
            return 0
        if op.name == "add":
            stack += op.args
        elif op.name == "sqr":
            found = found or op.args[0] == inner
        elif op.name == "const" and op.args[0] >= 0:
            more = more or op.args[0] > 0
        elif op.name != "powi" or op.args[1] % 2:
            return 0
    return (MORE if more else 1) if found else 0


def _sum(a: float, b: float, outward: float) -> float:
    """Return a + b, rounded to the side `outward`, plus or minus infinity, unless it is exact."""
    total = a + b
    if total - a == b and total - b == a:
        return total
    return outward if math.isnan(total) else nextafter(total, outward)


def _short(a: float) -> bool:
    """Return whether a float has 26 significant bits at most, so that products of two such are exact."""
    scaled = a * 134217729.0
    return scaled - (scaled - a) == a


def _product(a: float, b: float, outward: float) -> float:
    """Return a b, rounded to the side `outward` unless it is exact; 0 times infinity is 0."""
    if a == 0.0 or b == 0.0:
        return 0.0
    total = a * b
    if _short(a) and _short(b) and abs(total) > 1e-290:
        return total
    rounded = nextafter(total, outward)
    return 0.0 if (rounded > 0.0) != ((a > 0.0) == (b > 0.0)) else rounded


def _times(a: Range, b: Range) -> Range:
    pairs = [(p, q) for p in (a.low, a.high) for q in (b.low, b.high)]
    low, high = min(_product(p, q, -inf) for p, q in pairs), max(_product(p, q, inf) for p, q in pairs)
    return Range(low, high, a.not_zero and b.not_zero)


def _inverse(b: Range) -> Range:
    """Return the range of 1 / b."""
    if b.positive and b.high <= 0.0:  # the divisor has a value nowhere, such as a root of what is negative
        return ANY
    if b.positive:
        return Range(nextafter(1.0 / b.high, 0.0) if b.high < inf else 0.0, _reciprocal(b.low), True)
    if _negated(b).positive:
        return _negated(_inverse(_negated(b)))
    return Range(nonzero=True)


def _reciprocal(low: float) -> float:
    """Return a number that is not under 1 / low for low >= 0."""
    return nextafter(1.0 / low, inf) if low > 1e-300 else inf


def _negated(a: Range) -> Range:
    return Range(-a.high, -a.low, a.nonzero)


def _absolute(a: Range) -> Range:
    low = a.low if a.low > 0.0 else -a.high if a.high < 0.0 else 0.0
    return Range(low, max(-a.low, a.high), a.not_zero)


def _power(a: Range, n: float) -> Range:
    """Return a^n for a range without negative numbers; an end below 0 is of a range that holds no number at all."""

    def at(base: float, outward: float) -> float:
        if base <= 0.0 or base in (1.0, inf):
            return max(base, 0.0)
        try:
            value = float(base**n)
        except OverflowError:
            return inf if outward > 0 else 1e300
        return max(0.0, value * (1.0 + (_SLACK if outward > 0 else -_SLACK)) + (1e-300 if outward > 0 else -1e-300))

    return Range(at(a.low, -inf), at(a.high, inf), a.not_zero)


def _exponential(a: Range) -> Range:
    low = math.exp(min(a.low, 700.0)) * (1.0 - _SLACK) if a.low > -inf else 0.0
    high = math.exp(a.high) * (1.0 + _SLACK) + 1e-300 if a.high < 700.0 else inf
    return Range(1.0 if a.low == 0.0 else low, 1.0 if a.high == 0.0 else high, True)


def _logarithm(a: Range) -> Range:
    def at(value: float, outward: float) -> float:
        if value <= 0.0 or value in (1.0, inf):
            return 0.0 if value == 1.0 else inf if value == inf else -inf
        near = math.log(value)
        return near + math.copysign(abs(near) * _SLACK + 1e-300, outward)

    return Range(at(a.low, -inf), at(a.high, inf))


def _own(op: Op, known: Sequence[Range]) -> Range:
    """Return the range of an operation by the ranges of its inputs."""
    of = [known[i] for i in op.inputs]
    match op.name:
        case "const":
            low, high = bracket(op.args[0])
            return Range(low, high, op.args[0] != 0)
        case "pi":
            return Range(math.pi, nextafter(math.pi, inf))
        case "e":
            return Range(math.e, nextafter(math.e, inf))
        case "neg":
            return _negated(of[0])
        case "add":
            return _added(of[0], of[1])
        case "sub":
            return _added(of[0], _negated(of[1]))
        case "mul":
            return _times(of[0], of[1])
        case "div":
            return _times(of[0], _inverse(of[1]))
        case "sqr":
            whole = _absolute(of[0])
            return _times(whole, whole)
        case "powi" if op.args[1] % 2 == 0:
            return _power(_absolute(of[0]), op.args[1])
        case "powi":
            return _odd(of[0], op.args[1])
        case "powr":
            return _power(of[0].within(Range(low=0.0)), float(op.args[1]))
        case "sqrt":
            return _power(of[0].within(Range(low=0.0)), 0.5)
        case "abs":
            return _absolute(of[0])
        case "min":
            low, high = min(of[0].low, of[1].low), min(of[0].high, of[1].high)
            return Range(low, high, of[0].not_zero and of[1].not_zero)
        case "max":
            low, high = max(of[0].low, of[1].low), max(of[0].high, of[1].high)
            return Range(low, high, of[0].positive or of[1].positive or (of[0].not_zero and of[1].not_zero))
        case "exp":
            return _exponential(of[0])
        case "log":
            return _logarithm(of[0])
        case "sin" | "cos":
            return Range(-1.0, 1.0)
        case "floor":
            low, high = (math.floor(v) if math.isfinite(v) else v for v in (of[0].low, of[0].high))
            return Range(low, high)
        case "atan2":
            return Range(-nextafter(math.pi, inf), nextafter(math.pi, inf))
        case "below":
            return Range(0.0, 1.0)
        case "sign":
            return Range(-1.0, 1.0, True)
        case "select":
            p, q = of[1], of[2]
            return Range(min(p.low, q.low), max(p.high, q.high), p.not_zero and q.not_zero)
    return ANY


def _added(a: Range, b: Range) -> Range:
    apart = (min(a.low, b.low) >= 0.0 or max(a.high, b.high) <= 0.0) and (a.not_zero or b.not_zero)
    return Range(_sum(a.low, b.low, -inf), _sum(a.high, b.high, inf), apart)


def _odd(a: Range, n: int) -> Range:
    def at(value: float) -> Range:
        return _power(Range(abs(value), abs(value)), n)

    low = at(a.low).low if a.low >= 0.0 else -at(a.low).high
    high = at(a.high).high if a.high >= 0.0 else -at(a.high).low
    return Range(low, high, a.not_zero)
