"""Turn formulas into tapes: run the code of `grammar` on a `Builder`. Every size is checked before it is built."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from typing import Any, NoReturn

from surfaces.language.grammar import COMPARISONS
from surfaces.language.names import RESERVED, Code, Names
from surfaces.language.prelude import library
from surfaces.language.statements import Parser
from surfaces.language.tokens import MAX_BITS, bits, fail
from surfaces.model import FirsthitError
from surfaces.tape import Builder, Tape, walk
from surfaces.words import COORDINATES

MAX_DEGREE = 64  # a polynomial of this degree in three variables has 47,905 terms
MAX_OPERATIONS = 200_000  # of a tape
MAX_STEPS = 200_000  # inside functions, for all calls of a formula together
OPERATORS = frozenset({"+", "-", "*", "/", "%", "^", "and", "or", *COMPARISONS})
_FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "abs", "floor", "atan2", "min", "max")
_WEIGHED = (*_FUNCTIONS, "below", "select")  # their values have degree 1


@dataclass(frozen=True)
class Read:
    """Hold a formula that was read: its tape, which parameters occur in it, and what the user should be told."""

    tape: Tape
    used: frozenset[str]
    notes: tuple[str, ...]


def read(text: str, parameters: Mapping[str, str], free: bool = False) -> Read:
    """Read a formula.

    `parameters` are formulas of constants by name. If `free`, they become variables. Raises FirsthitError, which names
    the column and shows it with a caret, if the text is no formula.
    """
    values = {name: None if free else _constant(name, value) for name, value in parameters.items()}
    names = Names(frozenset(parameters), library())
    code = Parser(text, names).formula()
    reader = _Reader(text, values)
    output = reader.run(code)
    if reader.is_condition(output) and reader.builder.value(output) is None:
        reader.fail("an inequality is 0 or 1 everywhere: it describes a solid; write a = b for its surface")
    return Read(reader.builder.tape(output), frozenset(names.used), tuple(dict.fromkeys(names.notes)))


def _constant(name: str, text: str) -> Read:
    """Read a parameter's value, which only depends on constants. Raises FirsthitError if it is none."""
    if not re.fullmatch(r"[A-Za-z_][A-Za-z_0-9]*", name) or name in (*COORDINATES, *RESERVED):
        told = "names are ASCII words that are neither coordinates nor and, or, not, let"
        raise FirsthitError(f"{name!r} cannot be a parameter's name: {told}")
    try:
        found = read(text, {})
    except FirsthitError as error:
        raise FirsthitError(f"parameter {name}: {error}") from None
    if not all(found.tape.constants()):
        raise FirsthitError(f"parameter {name}: {text[:40]!r} is no constant")
    return found


@dataclass
class _Frame:
    """Hold a call that is being run."""

    code: Code
    arguments: tuple[int, ...]
    column: int | None  # what errors name; None: where the instruction was written
    key: tuple[Any, ...] | None  # under which the result is kept
    at: int = 0


class _Reader:
    """Run code. Values are operations of one `Builder`."""

    def __init__(self, text: str, values: Mapping[str, Read | None]) -> None:
        self.text = text
        self.values = values
        self.builder = Builder()
        self.weights: list[int] = []  # for each operation its degree, where a function's value has degree 1
        self.conditions: list[bool] = []  # for each operation whether it is 0 or 1 by structure
        self.frees: list[bool] = []  # for each operation whether it depends on a free parameter
        self.parameters: dict[str, int] = {}
        self.parts: dict[str, int] = {}
        self.column = 0

    def fail(self, message: str) -> NoReturn:
        fail(self.text, message, self.column)

    def run(self, code: Code) -> int:
        """Run the code of a formula, and return its value. Calls are run on a stack of frames."""
        stack: list[int] = []
        frames = [_Frame(code, (), None, None)]
        kept: dict[tuple[Any, ...], int] = {}
        steps = 0
        while frames:
            frame = frames[-1]
            if frame.at == len(frame.code):
                frames.pop()
                if frame.key is not None:
                    kept[frame.key] = stack[-1]
                continue
            name, value, column = frame.code[frame.at]
            frame.at += 1
            steps += len(frames) > 1
            self.column = column if frame.column is None else frame.column
            if steps > MAX_STEPS or len(self.builder.ops) > MAX_OPERATIONS:
                self._too_much()
            if name == "argument":
                stack.append(frame.arguments[value])
            elif name == "store":
                self.parts[value] = stack.pop()
            elif name == "apply":
                arguments = tuple(stack[-value.count :])
                del stack[-value.count :]
                key = (id(value), *arguments)
                if key in kept:
                    stack.append(kept[key])
                else:
                    # errors inside the prelude are told where it was called
                    inside = None if value.own else self.column
                    frames.append(_Frame(value.code, arguments, inside, key))
            else:
                self.step(name, value, stack)
        return stack[0]

    def _too_much(self) -> NoReturn:
        """Raise FirsthitError for a formula that is too large."""
        built = len(self.builder.ops)
        if built > MAX_OPERATIONS:
            raise FirsthitError(f"the formula has more than {MAX_OPERATIONS:,} operations; no more are accepted")
        raise FirsthitError(
            f"the formula's calls of functions take more than {MAX_STEPS:,} steps; no more are accepted"
        )

    def step(self, name: str, value: Any, stack: list[int]) -> None:
        """Do one instruction that is no call of a function of the language's own."""
        b = self.builder
        if name in OPERATORS:
            right = stack.pop()
            stack[-1] = self.checked(self.apply(name, stack[-1], right))
        elif name == "const":
            stack.append(b.const(value))
        elif name == "var":
            stack.append(b.var(value))
        elif name == "part":
            stack.append(self.parts[value])
        elif name == "parameter":
            stack.append(self.parameter(value))
        elif name in ("constant", "root"):
            stack.append(self.constant(value))
        elif name == "call":
            function, count = value
            arguments = stack[-count:]
            del stack[-count:]
            stack.append(self.checked(self.call(function, arguments)))
        elif name == "if":
            q, p, c = stack.pop(), stack.pop(), stack.pop()
            stack.append(self.checked(b.select(self.condition(c), p, q)))
        else:
            stack[-1] = self.checked((b.neg if name == "neg" else self.negated)(stack[-1]))

    def parameter(self, name: str) -> int:
        """Return a parameter's value, whose operations are added where it occurs first."""
        if name not in self.parameters:
            found = self.values[name]
            if found is None:
                self.parameters[name] = self.builder.var(name)
            else:
                self.parameters[name] = walk(found.tape, self.builder, {})[0]
        return self.parameters[name]

    def constant(self, name: str | int) -> int:
        """Return a constant of the language, or the square root of a whole number."""
        b = self.builder
        if name == "pi":
            return b.pi()
        if name == "e":
            return b.e()
        if name == "phi":
            return b.mul(b.const(Fraction(1, 2)), b.add(b.const(1), b.sqrt(b.const(5))))
        return b.sqrt(b.const(int(name)))

    def call(self, name: str, values: list[int]) -> int:
        """Return the value of a function of the tape's own."""
        b = self.builder
        if name == "length":
            return b.abs(values[0]) if len(values) == 1 else b.sqrt(reduce(b.add, map(b.sqr, values)))
        function: Callable[..., int] = getattr(b, name)
        return reduce(function, values) if name in ("min", "max") else function(*values)

    def apply(self, name: str, left: int, right: int) -> int:
        """Return the result of an operator. Raises FirsthitError for a division by zero."""
        b = self.builder
        match name:
            case "+":
                return b.add(left, right)
            case "-":
                return b.sub(left, right)
            case "*":
                return b.mul(left, right)
            case "/" | "%":
                if b.value(right) == 0:
                    self.fail("division by zero")
                quotient = b.div(left, right)
                return quotient if name == "/" else b.sub(left, b.mul(right, b.floor(self.checked(quotient))))
            case "^":
                return self.power(left, right)
            case "and" | "or":
                return self.joined(name, self.condition(left), self.condition(right))
        return self.compared(name, left, right)

    # conditions

    def compared(self, name: str, a: int, b: int) -> int:
        """Return a comparison, which is 1 where it holds and else 0."""
        below = self.builder.below
        match name:
            case "<=":
                return below(a, b)
            case ">=":
                return below(b, a)
            case "<":
                return self.negated(below(b, a))
            case ">":
                return self.negated(below(a, b))
        equal = self.joined("and", below(a, b), below(b, a))
        return equal if name == "==" else self.negated(equal)

    def joined(self, name: str, a: int, b: int) -> int:
        """Return whether two conditions, or one of them, hold."""
        builder, neutral = self.builder, int(name == "and")
        for one, other in ((a, b), (b, a)):
            value = builder.value(one)
            if value is not None:
                return other if value == neutral else one
        return builder.min(a, b) if name == "and" else builder.max(a, b)

    def negated(self, a: int) -> int:
        """Return 1 - a for a condition a."""
        a = self.condition(a)
        b, op = self.builder, self.builder.ops[a]
        if op.name == "sub" and b.value(op.args[0]) == 1:
            return int(op.args[1])
        return b.sub(b.const(1), a)

    def condition(self, a: int) -> int:
        """Return a value as a condition: itself, or for a number whether it is not 0."""
        value = self.builder.value(a)
        if value is not None:
            return self.builder.const(int(value != 0))
        return a if self.is_condition(a) else self.compared("!=", a, self.builder.const(0))

    def is_condition(self, index: int) -> bool:
        """Return whether an operation is 0 or 1 by its structure."""
        ops = self.builder.ops
        while len(self.conditions) < len(ops):
            op = ops[len(self.conditions)]
            known = [self.conditions[i] for i in op.inputs]
            if op.name == "const":
                self.conditions.append(op.args[0] in (0, 1))
            elif op.name == "sub":
                self.conditions.append(self.builder.value(op.args[0]) == 1 and known[1])
            else:
                self.conditions.append(op.name == "below" or (op.name in ("min", "max") and all(known)))
        return self.conditions[index]

    # powers

    def power(self, base: int, exponent: int) -> int:
        """Return a power. Raises FirsthitError where it is too large or has no value."""
        b, q, value = self.builder, self.builder.value(exponent), self.builder.value(base)
        if b.ops[base].name == "e":
            return b.exp(exponent)
        if self.is_free(exponent):
            self.fail("a parameter that varies between instances cannot be an exponent")
        if q is None:
            return self.general(base, exponent)
        if value is not None and q != 0:
            if value == 0 and q < 0:
                self.fail("division by zero")
            if abs(q) > MAX_BITS or (bits(value) - 1) * abs(q) > MAX_BITS:
                self.fail(f"this power is a number of more than {MAX_BITS} bits")
            if value < 0 and q.denominator != 1:
                self.fail("a root of a negative number has no value; cbrt(a) is the cube root of any number")
        elif abs(q) * max(1, self.weight(base)) > MAX_DEGREE:
            self.fail(f"this power's degree is past {MAX_DEGREE}")
        if q.denominator == 1:
            return b.powi(base, int(q))
        if b.ops[base].name == "exp":
            return b.exp(b.mul(b.const(q), b.ops[base].args[0]))
        if value in (0, 1):
            return base
        return b.powr(base, q) if q > 0 else b.div(b.const(1), b.powr(base, -q))

    def general(self, base: int, exponent: int) -> int:
        """Return exp(exponent·log(base)), for an exponent that is no rational constant."""
        b, value = self.builder, self.builder.value(base)
        if value is not None and value <= 0:
            self.fail("a power whose exponent varies needs a base above 0")
        if value == 1:
            return base
        if b.ops[base].name == "exp":
            return b.exp(b.mul(exponent, b.ops[base].args[0]))
        return b.exp(b.mul(exponent, b.log(base)))

    def is_free(self, index: int) -> bool:
        """Return whether an operation depends on a parameter that is a variable."""
        ops = self.builder.ops
        while len(self.frees) < len(ops):
            op = ops[len(self.frees)]
            free = op.name == "var" and op.args[0] not in COORDINATES
            self.frees.append(free or any(self.frees[i] for i in op.inputs))
        return self.frees[index]

    # sizes

    def checked(self, index: int) -> int:
        """Return `index` unless its constant or its degree is too large, which raises FirsthitError."""
        value = self.builder.value(index)
        if value is not None and bits(value) > MAX_BITS:
            self.fail(f"this constant has more than {MAX_BITS} bits")
        if self.weight(index) > MAX_DEGREE:
            self.fail(f"the degree here is past {MAX_DEGREE}")
        return index

    def weight(self, index: int) -> int:
        """Return the degree of an operation, where a function's value has degree 1."""
        ops = self.builder.ops
        while len(self.weights) < len(ops):
            op = ops[len(self.weights)]
            inputs = [self.weights[i] for i in op.inputs]
            if op.name in ("mul", "div"):
                weight = sum(inputs)
            elif op.name in ("sqr", "powi"):
                weight = inputs[0] * (2 if op.name == "sqr" else op.args[1])
            elif op.name == "powr":
                weight = min(1, inputs[0]) if op.args[1] < 1 else math.ceil(inputs[0] * op.args[1])
            elif op.name in _WEIGHED:
                weight = min(1, max(inputs))
            else:
                weight = max(inputs, default=int(op.name == "var"))
            self.weights.append(weight)
        return self.weights[index]
