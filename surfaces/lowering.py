"""Tape → tape: constants folded, powers by squaring, derivatives, the coefficients along a ray.

Every pass is exact in exact arithmetic; each keeps the written order of operations where it can, since that decides
rounding.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache, reduce

from surfaces.numbers import Balls, fractions_of
from surfaces.tape import LEAVES, Builder, Op, Tape, walk

Enclosure = tuple[Fraction, Fraction]
CONSTANT_BITS = 320


@cache
def enclosures(tape: Tape) -> dict[int, Enclosure]:
    """For each constant operation, exact rational bounds of its value, equal where it is rational as written.

    Raises ZeroDivisionError where a constant is undefined, past 2^1000, or divided by what may be zero.
    """
    import flint

    constant = [i for i, is_constant in enumerate(tape.constants()) if is_constant]
    with flint.ctx.workprec(CONSTANT_BITS):
        balls = dict(zip(constant, walk(Tape(tape.ops, tuple(constant)).pruned(), Balls(), {}), strict=True))
        found: dict[int, Enclosure] = {}
        for index, ball in balls.items():
            op = tape.ops[index]
            if not abs(ball) < 2**1000:
                raise ZeroDivisionError(f"a constant {op.name} is undefined or too large")
            found[index] = (op.args[0], op.args[0]) if op.name == "const" else fractions_of(ball)
    return found


class _Squaring(Builder):
    """Whole powers as squares and products, so that powers of one base share theirs."""

    def powi(self, a: int, n: int) -> int:
        if n <= 2:
            return super().powi(a, n)
        half = self.sqr(self.powi(a, n // 2))
        return self.mul(a, half) if n % 2 else half


@cache
def real_tape(tape: Tape) -> Tape:
    """The tape with irrational constants as 320-bit rationals and powers by squaring: what floats evaluate."""
    known = enclosures(tape)
    builder = _Squaring()
    ops = tuple(Op("const", (sum(known[i]) / 2,)) if i in known else op for i, op in enumerate(tape.ops))
    return builder.tape(*walk(Tape(ops, tape.outputs), builder, builder.var))


def _partials(b: Builder, op: Op, value: int) -> tuple[int, ...]:
    """The derivatives of an operation with respect to each of its inputs."""
    a = op.args[0]
    one = b.const(1)
    match op.name:
        case "add":
            return one, one
        case "sub":
            return one, b.const(-1)
        case "mul":
            return op.args[1], a
        case "div":
            inverse = b.div(one, op.args[1])
            return inverse, b.neg(b.mul(value, inverse))
        case "neg":
            return (b.const(-1),)
        case "sqr":
            return (b.mul(b.const(2), a),)
        case "sqrt":
            return (b.div(b.const(Fraction(1, 2)), value),)
        case "exp":
            return (value,)
        case "log":
            return (b.div(one, a),)
        case "sin":
            return (b.cos(a),)
        case "cos":
            return (b.neg(b.sin(a)),)
        case "tan":
            return (b.add(one, b.sqr(value)),)
        case "abs":
            return (b.sign(a),)
        case "min":
            first = b.below(a, op.args[1])
            return first, b.sub(one, first)
        case "max":
            first = b.below(op.args[1], a)
            return first, b.sub(one, first)
        case "sign" | "below":
            return tuple(b.const(0) for _ in op.args)
    raise ValueError(f"no derivative of {op.name}")


def _copied(tape: Tape) -> Builder:
    """A builder that starts with the tape's operations, at their indices."""
    builder = Builder()
    for op in tape.ops:
        builder.emit(op.name, *op.args)
    return builder


def gradient(tape: Tape, names: tuple[str, ...] = ("x", "y", "z")) -> Tape:
    """Derivatives of the first output of a real tape by each variable, in one backward pass."""
    b = _copied(tape)
    adjoints: dict[int, int] = {tape.outputs[0]: b.const(1)}
    for index in reversed(range(len(tape.ops))):
        op = tape.ops[index]
        if index not in adjoints or op.name in LEAVES:
            continue
        for i, partial in zip(op.inputs, _partials(b, op, index), strict=True):
            if not b.is_constant(i):
                term = b.mul(partial, adjoints[index])
                adjoints[i] = b.add(adjoints[i], term) if i in adjoints else term
    zero = b.const(0)
    return b.tape(*(adjoints.get(b.var(name), zero) for name in names))


def tangent(tape: Tape, seeds: Mapping[str, str]) -> Tape:
    """Each output followed by its derivative in the direction whose component of variable v is named seeds[v]; other
    variables stay as they are."""
    b = _copied(tape)
    rates: list[int] = []
    zero = b.const(0)
    for index, op in enumerate(tape.ops):
        if op.name in LEAVES:
            rates.append(b.var(seeds[op.args[0]]) if op.name == "var" and op.args[0] in seeds else zero)
            continue
        partials = _partials(b, op, index) if any(rates[i] != zero for i in op.inputs) else ()
        rates.append(reduce(b.add, (b.mul(p, rates[i]) for p, i in zip(partials, op.inputs, strict=False)), zero))
    return b.tape(*(i for output in tape.outputs for i in (output, rates[output])))


def hessian_product(tape: Tape) -> Tape:
    """The Hessian times the vector (vx, vy, vz): three outputs."""
    both = tangent(gradient(tape), {"x": "vx", "y": "vy", "z": "vz"})
    return Tape(both.ops, both.outputs[1::2]).pruned()


class _Coefficients:
    """Polynomials in t over a builder's operations: lists of coefficients, lowest power first."""

    def __init__(self, builder: Builder) -> None:
        self.b = builder

    def const(self, value: Fraction) -> list[int]:
        return [self.b.const(value)]

    def _zip(self, combine: Callable[[int, int], int], p: list[int], q: list[int]) -> list[int]:
        zero, n = self.b.const(0), max(len(p), len(q))
        pairs = zip(p + [zero] * (n - len(p)), q + [zero] * (n - len(q)), strict=True)
        return [combine(a, c) for a, c in pairs]

    def add(self, p: list[int], q: list[int]) -> list[int]:
        return self._zip(self.b.add, p, q)

    def sub(self, p: list[int], q: list[int]) -> list[int]:
        return self._zip(self.b.sub, p, q)

    def neg(self, p: list[int]) -> list[int]:
        return [self.b.neg(a) for a in p]

    def mul(self, p: list[int], q: list[int]) -> list[int]:
        sums: list[int] = [self.b.const(0)] * (len(p) + len(q) - 1)
        for i, a in enumerate(p):
            for j, c in enumerate(q):
                sums[i + j] = self.b.add(sums[i + j], self.b.mul(a, c))
        return sums

    def sqr(self, p: list[int]) -> list[int]:
        sums: list[int] = [self.b.const(0)] * (2 * len(p) - 1)
        for i, a in enumerate(p):
            for j in range(i + 1, len(p)):
                sums[i + j] = self.b.add(sums[i + j], self.b.mul(a, p[j]))
        sums = [self.b.mul(self.b.const(2), a) for a in sums]
        for i, a in enumerate(p):
            sums[2 * i] = self.b.add(sums[2 * i], self.b.sqr(a))
        return sums

    def div(self, p: list[int], q: list[int]) -> list[int]:
        return [self.b.div(a, q[0]) for a in p]


def coefficients_along(tape: Tape, degree: int) -> Tape:
    """Coefficients in t of f(o + t d), t^0 first, degree + 1 outputs; variables ox oy oz dx dy dz, and the tape's own
    beside x, y, z.

    `tape` is a real tape built as a polynomial of this total degree; what cancels above the degree is left out.
    """
    b = Builder()
    ray = {name: [b.var(f"o{name}"), b.var(f"d{name}")] for name in ("x", "y", "z")}
    along = walk(tape, _Coefficients(b), lambda name: ray[name] if name in ray else [b.var(name)])[0]
    along += [b.const(0)] * (degree + 1 - len(along))
    return b.tape(*along[: degree + 1])


def counts(tape: Tape) -> dict[str, int]:
    """How many of each operation floats spend on the tape, constants free."""
    constant = tape.constants()
    return dict(
        sorted(Counter(op.name for op, c in zip(tape.ops, constant, strict=True) if not c and op.name != "var").items())
    )
