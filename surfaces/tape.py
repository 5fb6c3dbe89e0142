"""Define straight-line programs. A surface is one `Tape`; every number system runs it by the same operation names.

    const pi e var          a Fraction, two numbers, and a variable by its name
    neg sqr abs             abs has a kink at 0
    sqrt exp log sin cos tan
    floor                   the greatest whole number that is not above a; it jumps
    powi powr               a^n for a whole n of 3 or more; a^q for a >= 0 and a Fraction q > 0 that is not whole
    add sub mul div
    min max                 they have kinks
    atan2                   the angle of the point (x, y) = (b, a), in (-pi, pi]; it jumps where a = 0 and b < 0
    below                   1 if a <= b, else 0; it jumps
    select                  p if c is 1, q if c is 0, for a condition c made of `below`, min, max and 1 - c
    sign                    1 if a >= 0, else -1; only derivatives of abs use it

Every other function of the formula language is defined by these. What stands in the part of a select that is not taken
need not have a value.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeVar

Number = TypeVar("Number")
ONE = Fraction(1)
LEAVES = frozenset({"const", "pi", "e", "var"})
POWERS = frozenset({"powi", "powr"})  # their second argument is an exponent
UNARY = ("sqrt", "exp", "log", "sin", "cos", "tan")  # smooth functions of one value
JUMPS = frozenset({"floor", "atan2", "below", "select", "sign"})  # operations that may not be continuous


@dataclass(frozen=True, slots=True)
class Op:
    """Hold one operation.

    `args` are indices of earlier operations, except that const has (Fraction,), var (name,), powi (index, n) and powr
    (index, Fraction).
    """

    name: str
    args: tuple[Any, ...] = ()

    @property
    def inputs(self) -> tuple[int, ...]:
        """Return those of `args` that are indices."""
        if self.name in LEAVES:
            return ()
        return self.args[:1] if self.name in POWERS else self.args


@dataclass(frozen=True)
class Tape:
    """Hold operations, each after its inputs, and the indices of those that are the results."""

    ops: tuple[Op, ...]
    outputs: tuple[int, ...]

    def __hash__(self) -> int:
        """Return a hash of all operations. It is computed once, since caches ask for it at each look."""
        known = self.__dict__.get("_hash")
        if known is None:
            known = hash((self.ops, self.outputs))
            self.__dict__["_hash"] = known
        return int(known)

    def __reduce__(self) -> tuple[type[Tape], tuple[tuple[Op, ...], tuple[int, ...]]]:
        """Leave the hash out of pickles: that of a text differs from process to process."""
        return Tape, (self.ops, self.outputs)

    def ordered(self) -> Tape:
        """Return the same graph with its operations in the order in which the outputs reach them, inputs first."""
        place: dict[int, int] = {}
        ops: list[Op] = []
        waiting = list(reversed(self.outputs))
        while waiting:
            index = waiting[-1]
            op = self.ops[index]
            missing = [i for i in op.inputs if i not in place] if index not in place else []
            if missing:
                waiting.extend(reversed(missing))
                continue
            waiting.pop()
            if index not in place:
                inputs = tuple(place[i] for i in op.inputs)
                place[index] = len(ops)
                ops.append(op if op.name in LEAVES else Op(op.name, inputs + op.args[len(inputs) :]))
        return Tape(tuple(ops), tuple(place[i] for i in self.outputs))

    def constants(self) -> list[bool]:
        """Return for each operation whether it depends on no variable."""
        constant: list[bool] = []
        for op in self.ops:
            constant.append(op.name != "var" and all(constant[i] for i in op.inputs))
        return constant

    def pruned(self) -> Tape:
        """Return the tape with only those operations that the outputs need."""
        live = set(self.outputs)
        for index in reversed(range(len(self.ops))):
            if index in live:
                live.update(self.ops[index].inputs)
        place = {old: new for new, old in enumerate(sorted(live))}
        ops = []
        for old in sorted(live):
            op = self.ops[old]
            inputs = tuple(place[i] for i in op.inputs)
            ops.append(op if op.name in LEAVES else Op(op.name, inputs + op.args[len(inputs) :]))
        return Tape(tuple(ops), tuple(place[i] for i in self.outputs))


def walk(tape: Tape, numbers: Any, variables: Mapping[str, Number] | Callable[[str], Number]) -> tuple[Number, ...]:
    """Run a tape and return its outputs.

    `numbers` is a number system: any object that has a method for each operation on the tape, by its name. `variables`
    gives the values of the variables.
    """
    variable = variables.__getitem__ if isinstance(variables, Mapping) else variables
    values: list[Number] = []
    for op in tape.ops:
        if op.name == "var":
            values.append(variable(op.args[0]))
        elif op.name in POWERS:
            values.append(getattr(numbers, op.name)(values[op.args[0]], op.args[1]))
        elif op.name in LEAVES:
            values.append(getattr(numbers, op.name)(*op.args))
        else:
            values.append(getattr(numbers, op.name)(*(values[i] for i in op.args)))
    return tuple(values[i] for i in tape.outputs)


class Builder:
    """Build tapes: a number system whose numbers are the indices of operations that it has recorded.

    Equal subexpressions become one operation, and rational constants are folded. Operations stay in the order written,
    since it decides rounding; only sums and products with exact constants are rearranged.
    """

    def __init__(self) -> None:
        self.ops: list[Op] = []
        self._known: dict[tuple[Any, ...], int] = {}
        self._constant: list[bool] = []

    def tape(self, *outputs: int) -> Tape:
        """Return the tape of these outputs, with only the operations that they need."""
        return Tape(tuple(self.ops), outputs).pruned()

    def is_constant(self, index: int) -> bool:
        """Tell whether an operation depends on no variable."""
        return self._constant[index]

    def value(self, index: int) -> Fraction | None:
        """Return the rational number of a constant operation; None for any other operation."""
        op = self.ops[index]
        return op.args[0] if op.name == "const" else None

    def emit(self, name: str, *args: Any) -> int:
        """Return the index of an operation, which is added if it is not there yet."""
        key: tuple[Any, ...]
        if name in ("add", "mul", "min", "max"):
            key = (name, *args) if args[0] <= args[1] else (name, args[1], args[0])
        elif name == "const":
            key = (args[0].numerator, args[0].denominator)  # a Fraction's own hash takes long
        else:
            key = (name, *args)
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = len(self.ops)
            op = Op(name, args)
            self._constant.append(name != "var" and all([self._constant[i] for i in op.inputs]))
            self.ops.append(op)
        return known

    def _split(self, index: int) -> tuple[Fraction, int | None]:
        """Split an operation into a rational factor and the rest; the rest is None for a rational constant."""
        op = self.ops[index]
        if op.name == "const":
            return op.args[0], None
        if self._constant[index]:
            return ONE, index
        if op.name == "neg":
            return Fraction(-1), op.args[0]
        if op.name == "mul" and (factor := self.value(op.args[0])) is not None:
            return factor, op.args[1]
        return ONE, index

    def const(self, value: Fraction | int) -> int:
        return self.emit("const", Fraction(value))

    def var(self, name: str) -> int:
        return self.emit("var", name)

    def pi(self) -> int:
        return self.emit("pi")

    def e(self) -> int:
        return self.emit("e")

    def neg(self, a: int) -> int:
        factor, rest = self._split(a)
        if rest is None:
            return self.const(-factor)
        if factor != 1:
            return self._scaled(-factor, rest)
        if self.ops[a].name == "sub":
            return self.sub(*reversed(self.ops[a].args))
        return self.emit("neg", a)

    def _offset(self, index: int) -> tuple[int, Fraction]:
        """Split a sum that ends in a rational constant into the rest and the constant; others into themselves and 0."""
        op = self.ops[index]
        if op.name in ("add", "sub") and (offset := self.value(op.args[1])) is not None:
            return op.args[0], offset if op.name == "add" else -offset
        return index, Fraction(0)

    def _shifted(self, a: int, offset: Fraction) -> int:
        """Return a + offset, where a constant at the end of a and the offset become one constant."""
        rest, known = self._offset(a)
        total = known + offset
        if total == 0:
            return rest
        return self.emit("add" if total > 0 else "sub", rest, self.const(abs(total)))

    def _scaled(self, factor: Fraction, a: int) -> int:
        """Return factor · a, with one factor before the rest of a."""
        own, rest = self._split(a)
        if rest is not None and own is not ONE:
            factor, a = factor * own, rest
        if factor == 0:
            return self.const(0)
        if factor == 1:
            return a
        return self.emit("neg", a) if factor == -1 else self.emit("mul", self.const(factor), a)

    def add(self, a: int, b: int) -> int:
        x, y = self.value(a), self.value(b)
        if x is not None and y is not None:
            return self.const(x + y)
        if x == 0:
            return b
        if y is not None:
            return self._shifted(a, y)
        if self.ops[b].name == "neg":
            return self.sub(a, self.ops[b].args[0])
        if self.ops[a].name == "neg":
            return self.sub(b, self.ops[a].args[0])
        if a == b:
            return self.mul(self.const(2), a)
        return self.emit("add", a, b)

    def sub(self, a: int, b: int) -> int:
        x, y = self.value(a), self.value(b)
        if a == b:
            return self.const(0)
        if x is not None and y is not None:
            return self.const(x - y)
        if y is not None:
            return self._shifted(a, -y)
        if x == 0:
            return self.neg(b)
        if self.ops[b].name == "neg":
            return self.add(a, self.ops[b].args[0])
        return self.emit("sub", a, b)

    def mul(self, a: int, b: int) -> int:
        (x, p), (y, q) = self._split(a), self._split(b)
        if p is None or q is None:
            rest = p if q is None else q
            return self.const(x * y) if rest is None else self._scaled(x * y, rest)
        if x is not ONE or y is not ONE:
            return self._scaled(x * y, self.mul(p, q))
        return self.sqr(a) if a == b else self.emit("mul", a, b)

    def div(self, a: int, b: int) -> int:
        """Return the quotient of two operations. Raises ZeroDivisionError if the divisor is the constant 0."""
        divisor = self.value(b)
        if divisor == 0:
            raise ZeroDivisionError("division by zero")
        if divisor is not None:
            return self.mul(a, self.const(1 / divisor))
        if self.is_constant(b) and not self.is_constant(a):
            return self.mul(a, self.emit("div", self.const(1), b))
        return self.const(0) if self.value(a) == 0 else self.emit("div", a, b)

    def sqr(self, a: int) -> int:
        if self.ops[a].name == "abs":
            a = self.ops[a].args[0]
        factor, rest = self._split(a)
        if rest is None:
            return self.const(factor * factor)
        return self.emit("sqr", a) if factor == 1 else self._scaled(factor * factor, self.sqr(rest))

    def powi(self, a: int, n: int) -> int:
        if n < 0:
            return self.div(self.const(1), self.powi(a, -n))
        if n == 0:
            return self.const(1)
        if n <= 2:
            return a if n == 1 else self.sqr(a)
        if n % 2 == 0 and self.ops[a].name == "abs":
            a = self.ops[a].args[0]
        value = self.value(a)
        return self.emit("powi", a, n) if value is None else self.const(value**n)

    def powr(self, a: int, q: Fraction) -> int:
        """Return a^q for a >= 0 and any q > 0: whole powers and roots of squares have operations of their own."""
        if q.denominator == 1:
            return self.powi(a, int(q))
        if q.denominator == 2:
            root = self.sqrt(a)
            return root if q < 1 else self.mul(self.powi(a, int(q)), root)
        return self.emit("powr", a, q)

    def abs(self, a: int) -> int:
        value = self.value(a)
        if value is not None:
            return self.const(abs(value))
        op = self.ops[a]
        positive = op.name in ("abs", "sqr", "sqrt", "exp", "powr") or (op.name == "powi" and op.args[1] % 2 == 0)
        return a if positive else self.emit("abs", a)

    def min(self, a: int, b: int) -> int:
        x, y = self.value(a), self.value(b)
        if x is not None and y is not None:
            return a if x <= y else b
        return a if a == b else self.emit("min", a, b)

    def max(self, a: int, b: int) -> int:
        x, y = self.value(a), self.value(b)
        if x is not None and y is not None:
            return a if x >= y else b
        return a if a == b else self.emit("max", a, b)

    def floor(self, a: int) -> int:
        value = self.value(a)
        return self.emit("floor", a) if value is None else self.const(math.floor(value))

    def sqrt(self, a: int) -> int:
        value, op = self.value(a), self.ops[a]
        if value is not None and value >= 0:
            top, bottom = math.isqrt(value.numerator), math.isqrt(value.denominator)
            if top * top == value.numerator and bottom * bottom == value.denominator:
                return self.const(Fraction(top, bottom))
        return self.abs(op.args[0]) if op.name == "sqr" else self.emit("sqrt", a)

    def exp(self, a: int) -> int:
        return self.emit("exp", a)

    def log(self, a: int) -> int:
        return self.emit("log", a)

    def sin(self, a: int) -> int:
        return self.emit("sin", a)

    def cos(self, a: int) -> int:
        return self.emit("cos", a)

    def tan(self, a: int) -> int:
        return self.emit("tan", a)

    def sign(self, a: int) -> int:
        return self.emit("sign", a)

    def below(self, a: int, b: int) -> int:
        x, y = self.value(a), self.value(b)
        if x is not None and y is not None:
            return self.const(int(x <= y))
        return self.const(1) if a == b else self.emit("below", a, b)

    def select(self, c: int, p: int, q: int) -> int:
        value = self.value(c)
        if value is not None:
            return p if value > 0 else q
        return p if p == q else self.emit("select", c, p, q)

    def atan2(self, a: int, b: int) -> int:
        return self.emit("atan2", a, b)
