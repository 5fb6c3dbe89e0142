"""Turn tapes into other tapes: with folded constants and powers by squaring, derivatives, coefficients along a ray.

Every pass is exact in exact arithmetic. Each keeps the written order of operations where it can, since the order
decides rounding.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache, reduce
from typing import Any

from surfaces.numbers import Balls, fractions_of
from surfaces.tape import LEAVES, Builder, Op, Tape, walk

Enclosure = tuple[Fraction, Fraction]
CONSTANT_BITS = 320
LEAST_ROOT = Fraction(1, 2**60)  # what roots' derivatives divide by at least: far below a kernel's rounding of lengths


@cache
def enclosures(tape: Tape) -> dict[int, Enclosure]:
    """Return exact rational bounds of each constant operation's value, which are equal if it is rational as written.

    Raises ZeroDivisionError if a constant is undefined, larger than 2^1000, or divided by what may be zero.
    """
    import flint

    constant = [i for i, is_constant in enumerate(tape.constants()) if is_constant]
    with flint.ctx.workprec(CONSTANT_BITS):
        balls: dict[int, Any] = dict(
            zip(constant, walk(Tape(tape.ops, tuple(constant)).pruned(), Balls(), {}), strict=True)
        )
        found: dict[int, Enclosure] = {}
        for index, ball in balls.items():
            op = tape.ops[index]
            if not abs(ball) < 2**1000:
                what = "a constant" if op.name == "const" else f"a constant's {op.name}"
                raise ZeroDivisionError(f"{what} is undefined, or 2^1000 or larger")
            found[index] = (op.args[0], op.args[0]) if op.name == "const" else fractions_of(ball)
    return found


class _Squaring(Builder):
    """Build whole powers as squares and products, so that powers of one base share them."""

    def powi(self, a: int, n: int) -> int:
        if n <= 2:
            return super().powi(a, n)
        half = self.sqr(self.powi(a, n // 2))
        return self.mul(a, half) if n % 2 else half


@cache
def real_tape(tape: Tape) -> Tape:
    """Return the tape that floats evaluate: irrational constants become 320-bit rationals, and powers squares."""
    known = enclosures(tape)
    builder = _Squaring()
    ops = tuple(Op("const", (sum(known[i]) / 2,)) if i in known else op for i, op in enumerate(tape.ops))
    return builder.tape(*walk(Tape(ops, tape.outputs), builder, builder.var))


def _partials(b: Builder, op: Op, value: int, guarded: bool = True) -> tuple[int, ...]:
    """Return the derivatives of an operation by each of its inputs; `value` is the operation's own index.

    Jumps have the derivative 0. A root's derivative is infinite at 0; if `guarded` it is a large number there, so that
    it vanishes where the root's argument does not change, as inside of a box whose distance is a root of squares.
    Raises ValueError for an operation that has no derivatives; a select has none by its inputs, see `tangent`.
    """
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
            return (b.div(b.const(Fraction(1, 2)), b.max(value, b.const(LEAST_ROOT)) if guarded else value),)
        case "powr":
            return (_power_derivative(b, a, op.args[1], value),)
        case "atan2":
            square = b.add(b.sqr(a), b.sqr(op.args[1]))
            square = b.max(square, b.const(LEAST_ROOT**2))
            return b.div(op.args[1], square), b.neg(b.div(a, square))
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
        case "sign" | "below" | "floor":
            return tuple(b.const(0) for _ in op.args)
    raise ValueError(f"no derivative of {op.name}")


def _power_derivative(b: Builder, a: int, q: Fraction, value: int) -> int:
    """Return q a^(q - 1), where `value` is a^q; for q < 1 it is 0 at a = 0, as the derivative of a root is guarded."""
    if q > 1:
        return b.mul(b.const(q), b.powr(a, q - 1))
    return b.mul(b.const(q), b.div(value, b.max(a, b.const(LEAST_ROOT))))


def _copied(tape: Tape) -> Builder:
    """Return a builder that holds the tape's operations, at the same indices."""
    builder = Builder()
    for op in tape.ops:
        builder.emit(op.name, *op.args)
    return builder


def gradient(tape: Tape, names: tuple[str, ...] = ("x", "y", "z"), guarded: bool = True) -> Tape:
    """Return the derivatives of a real tape's first output by each variable, guarded as for `_partials`.

    It is one backward pass. In that, the part of a select that is not taken would be multiplied by 0, and it may be
    infinite or no number; so a tape with selects gets a forward pass for each variable.
    """
    if any(op.name == "select" for op in tape.ops):
        return _forward_gradient(tape, names)
    b = _copied(tape)
    adjoints: dict[int, int] = {tape.outputs[0]: b.const(1)}
    for index in reversed(range(len(tape.ops))):
        op = tape.ops[index]
        if index not in adjoints or op.name in LEAVES:
            continue
        for i, partial in zip(op.inputs, _partials(b, op, index, guarded), strict=True):
            if not b.is_constant(i):
                term = b.mul(partial, adjoints[index])
                adjoints[i] = b.add(adjoints[i], term) if i in adjoints else term
    zero = b.const(0)
    return b.tape(*(adjoints.get(b.var(name), zero) for name in names))


def _forward_gradient(tape: Tape, names: tuple[str, ...]) -> Tape:
    """Return the derivatives of a real tape's first output by each variable, in a forward pass for each."""
    b = _copied(tape)
    passes = [_rates(b, tape, {name: b.const(1)}) for name in names]
    return b.tape(*(rates[tape.outputs[0]] for rates in passes))


def _rates(b: Builder, tape: Tape, seeds: Mapping[str, int]) -> list[int]:
    """Return the derivative of each operation of a tape that `b` holds a copy of, by a forward pass.

    seeds[v] is the derivative of the variable v. Variables without one are constant.
    """
    rates: list[int] = []
    zero = b.const(0)
    halves: dict[int, int] = {}  # half the derivatives of sums of squares, which their roots need
    rooted = any(op.name == "sqrt" for op in tape.ops)
    for index, op in enumerate(tape.ops):
        moving = [rates[i] for i in op.inputs]
        if rooted and (half := _half(b, op, rates, halves)) is not None:
            halves[index] = half
        if op.name == "var":
            rates.append(seeds.get(op.args[0], zero))
        elif all(rate == zero for rate in moving):
            rates.append(zero)
        elif op.name == "select":
            rates.append(b.select(op.args[0], moving[1], moving[2]))
        elif op.name == "sqrt" and op.args[0] in halves:
            rates.append(b.div(halves[op.args[0]], b.max(index, b.const(LEAST_ROOT))))
        elif op.name in ("min", "max"):
            lesser, other = op.args if op.name == "min" else op.args[::-1]
            rates.append(b.select(b.below(lesser, other), *moving))
        else:
            terms = (b.mul(p, rate) for p, rate in zip(_partials(b, op, index), moving, strict=True))
            rates.append(reduce(b.add, terms, zero))
    return rates


def _half(b: Builder, op: Op, rates: list[int], halves: Mapping[int, int]) -> int | None:
    """Return half the derivative of an operation if it is a square or a sum of squares and constants, else None."""
    if op.name == "sqr":
        return b.mul(op.args[0], rates[op.args[0]])
    if op.name not in ("add", "sub") or not any(i in halves for i in op.args):
        return None
    first, second = (halves[i] if i in halves else rates[i] if b.value(rates[i]) == 0 else None for i in op.args)
    if first is None or second is None:
        return None
    return b.add(first, second) if op.name == "add" else b.sub(first, second)


def tangent(tape: Tape, seeds: Mapping[str, str]) -> Tape:
    """Return a tape of each output, followed by its derivative along a direction.

    seeds[v] names the direction's component along the variable v. Variables without one are constant.
    """
    b = _copied(tape)
    rates = _rates(b, tape, {name: b.var(component) for name, component in seeds.items()})
    return b.tape(*(i for output in tape.outputs for i in (output, rates[output])))


def hessian_product(tape: Tape) -> Tape:
    """Return the product of the Hessian and the vector (vx, vy, vz): a tape of three outputs."""
    both = tangent(gradient(tape), {"x": "vx", "y": "vy", "z": "vz"})
    return Tape(both.ops, both.outputs[1::2]).pruned()


class _Coefficients:
    """Define the number system of polynomials in t: lists of a builder's operations, the lowest power first."""

    def __init__(self, builder: Builder) -> None:
        self.b = builder

    def const(self, value: Fraction) -> list[int]:
        return [self.b.const(value)]

    def _zip(self, combine: Callable[[int, int], int], p: list[int], q: list[int]) -> list[int]:
        """Combine coefficients of equal powers."""
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
    """Return a tape of the degree + 1 coefficients of f(o + t d), that of t^0 first.

    Its variables are ox oy oz dx dy dz, and the tape's own other than x, y, z. `tape` is a real tape that is built as a
    polynomial of this total degree; terms above the degree cancel and are left out.
    """
    b = Builder()
    ray = {name: [b.var(f"o{name}"), b.var(f"d{name}")] for name in ("x", "y", "z")}
    along = walk(tape, _Coefficients(b), lambda name: ray[name] if name in ray else [b.var(name)])[0]
    along += [b.const(0)] * (degree + 1 - len(along))
    return b.tape(*along[: degree + 1])


def counts(tape: Tape) -> dict[str, int]:
    """Count the operations that floats spend on a tape, by name; those of constants are free."""
    constant = tape.constants()
    return dict(
        sorted(Counter(op.name for op, c in zip(tape.ops, constant, strict=True) if not c and op.name != "var").items())
    )
