"""Parse the formula language: turn text into a `Tape`, by a Pratt parser. Nothing is ever evaluated as Python.

    formula  = numbers, x y z, parameters, constants, + - * / ^ (or **), parentheses, function calls
    constants: pi e phi sqrt2 sqrt3 sqrt5 (sqrt and any whole number)
    functions: sqrt exp log sin cos tan abs(a), min max(a, b, ...)

`^` binds tighter than a minus sign before it and groups to the right. Exponents are whole constants; those of e may be
anything. Numbers are exact: 0.3 is 3/10. Every size is checked before anything of that size is built.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, reduce
from typing import Any, NoReturn

from surfaces.model import FirsthitError
from surfaces.numbers import BallPolynomials, Symbols
from surfaces.tape import UNARY, Builder, Tape, walk
from surfaces.words import COORDINATES, suggestion

MAX_LENGTH = 4000  # characters of a formula
MAX_DEPTH = 60  # of parentheses, calls, signs and exponents inside one another
MAX_DEGREE = 64  # a polynomial of this degree in three variables has 47,905 terms
MAX_BITS = 1000  # of a rational constant's numerator and denominator, which keeps it inside float64's range
FUNCTIONS = (*UNARY, "abs", "min", "max")
CONSTANTS = ("pi", "e", "phi", "sqrt2", "sqrt3", "sqrt5")

_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)|(?P<operator>\*\*|[-+*/^(),])"
)
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE](?P<exponent>[+-]?[0-9]+))?")
_PRECEDENCE = {"+": 10, "-": 10, "*": 20, "/": 20, "^": 40}
_SIGN = 30


def __getattr__(name: str) -> Any:
    """Return X, Y or Z, the sympy symbols of `expression`; sympy is imported when one is first asked for.

    Raises AttributeError for any other name.
    """
    if name in ("X", "Y", "Z"):
        import sympy

        return sympy.Symbol(name.lower(), real=True)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def exact(text: str) -> Fraction:
    """Return a decimal number exactly. Raises FirsthitError for other text, and past the range of float64."""
    match = _NUMBER.fullmatch(text)
    if match is None or len(text) > 300:
        raise FirsthitError(f"{text[:40]!r} is not a decimal number")
    if abs(int(match["exponent"] or 0)) > 300:
        raise FirsthitError(f"{text[:40]!r} is past the range of float64")
    value = Fraction(text)
    if _bits(value) > MAX_BITS:
        raise FirsthitError(f"{text[:40]!r} is past the range of float64")
    return value


@lru_cache(maxsize=1024)
def _parsed(text: str, parameters: tuple[tuple[str, str], ...], free: bool) -> Tape:
    """Parse a formula; parameters are sorted pairs, so that they can be a key."""
    return _Parser(text, dict(parameters), free).formula()


def parse(text: str, parameters: Mapping[str, str] | None = None, free: bool = False) -> Tape:
    """Return the tape of a formula, with its operations in the order written.

    `parameters` are exact decimals by name. If `free`, they become variables, as the coordinates are. Raises
    FirsthitError, which names the column and shows it with a caret, if the text is no formula.
    """
    return _parsed(text, tuple(sorted((parameters or {}).items())), free)


def expression(tape: Tape) -> Any:
    """Return the exact sympy expression of a tape's first output, in the symbols X, Y, Z of this module."""
    import sympy

    symbols = {name: sympy.Symbol(name, real=True) for name in COORDINATES}
    return walk(tape, Symbols(), symbols)[0]


def is_polynomial(tape: Tape) -> bool:
    """Return whether a tape is built as a polynomial: it divides by, and calls functions of, constants only."""
    constant = tape.constants()
    ring = {"add", "sub", "mul", "neg", "sqr", "powi", "var"}
    return all(
        constant[i] or op.name in ring or (op.name == "div" and constant[op.args[1]]) for i, op in enumerate(tape.ops)
    )


def degree(tape: Tape) -> int | None:
    """Return the total degree in x, y, z, -1 for zero; None if the formula is not built as a polynomial.

    It is computed along one fixed generic line in 2000-bit balls, so that terms that cancel do not count. Only a
    leading form that vanishes in the line's direction, three ratios of large primes, would be missed.
    """
    if not is_polynomial(tape):
        return None
    import flint

    line = {"x": (7919, 104729, 1299709), "y": (6997, 100003, 1299721), "z": (5003, 99991, 1299743)}
    with flint.ctx.workprec(2000):
        coordinates = {name: flint.arb_poly([flint.arb(a) / c, flint.arb(b) / c]) for name, (a, b, c) in line.items()}
        along = walk(tape, BallPolynomials(), coordinates)[0]
        if isinstance(along, flint.arb):
            return -1 if along.contains(0) else 0
        return max((k for k in range(len(along)) if not along[k].contains(0)), default=-1)


def _bits(value: Fraction) -> int:
    """Return the length of the longer of numerator and denominator, in bits."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


@dataclass(frozen=True, slots=True)
class _Token:
    kind: str  # "number", "name", "operator" or "end"
    text: str
    column: int  # 0-based


class _Parser:
    """Parse one formula by precedence climbing. The values of its methods are operations of one `Builder`.

    Raises FirsthitError for a formula that is too long, and for a parameter's name that is no word or has a meaning.
    """

    def __init__(self, text: str, parameters: Mapping[str, str], free: bool) -> None:
        self.text = text
        self.free = free
        self.parameters = parameters
        self.builder = Builder()
        self.weights: list[int] = []  # for each operation its degree, where a function's value has degree 1
        self.depth = 0
        if len(text) > MAX_LENGTH:
            raise FirsthitError(f"the formula has {len(text)} characters; at most {MAX_LENGTH} are accepted")
        for name, value in parameters.items():
            if not re.fullmatch(r"[A-Za-z_][A-Za-z_0-9]*", name) or self._reserved(name):
                raise FirsthitError(
                    f"{name!r} cannot be a parameter's name: names are ASCII words with no other meaning"
                )
            exact(value)
        self.tokens = self._tokens()
        self.position = 0

    @staticmethod
    def _reserved(name: str) -> bool:
        """Return whether a name has a meaning of its own in the language."""
        return name in (*COORDINATES, *FUNCTIONS, *CONSTANTS) or re.fullmatch(r"sqrt[0-9]+", name) is not None

    def fail(self, message: str, column: int) -> NoReturn:
        """Raise FirsthitError with the part of the text around a column, and a caret below it."""
        start = max(0, column - 60)
        shown = "".join(c if c.isprintable() else "?" for c in self.text[start : column + 40])
        raise FirsthitError(f"formula, column {column + 1}: {message}\n    {shown}\n    {' ' * (column - start)}^")

    def _tokens(self) -> list[_Token]:
        """Split the text into tokens, the last of which is its end. Raises FirsthitError at other characters."""
        tokens, column = [], 0
        while column < len(self.text):
            if self.text[column] in " \t\r\n":
                column += 1
                continue
            match = _TOKEN.match(self.text, column)
            if match is None or match.lastgroup is None:
                character = self.text[column]
                self.fail(f"{character!r} (U+{ord(character):04X}) has no place in a formula", column)
            text = "^" if match.group() == "**" else match.group()
            tokens.append(_Token(match.lastgroup, text, column))
            column = match.end()
        return [*tokens, _Token("end", "", len(self.text))]

    def peek(self) -> _Token:
        """Return the next token."""
        return self.tokens[self.position]

    def take(self) -> _Token:
        """Return the next token, and go on behind it."""
        token = self.peek()
        self.position += token.kind != "end"
        return token

    def expect(self, text: str) -> None:
        """Take a token that must be `text`. Raises FirsthitError if it is another."""
        token = self.take()
        if token.text != text:
            self.fail(f"expected {text!r} here, found {self.describe(token)}", token.column)

    @staticmethod
    def describe(token: _Token) -> str:
        """Return how a message names a token."""
        return "the end of the formula" if token.kind == "end" else repr(token.text)

    def formula(self) -> Tape:
        """Parse the whole text. Raises FirsthitError if something is left over."""
        value = self.parse(0)
        token = self.peek()
        if token.kind != "end":
            self.fail(self.surplus(token), token.column)
        return self.builder.tape(value)

    def surplus(self, token: _Token) -> str:
        """Return what is wrong with a token that is left over."""
        if token.text in (")", ","):
            return f"{token.text!r} without its '('"
        if token.text == "(" and self.tokens[self.position - 1].kind == "name":
            return f"{self.tokens[self.position - 1].text!r} is not a function; write * between factors"
        return f"expected an operator before {token.text!r}; write * between factors"

    def parse(self, binding: int) -> int:
        """Parse everything that binds tighter than `binding`, as one value."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self.fail(f"nested more than {MAX_DEPTH} deep", self.peek().column)
        left = self.prefix()
        while (power := _PRECEDENCE.get(self.peek().text, -1)) > binding:
            operator = self.take()
            right = self.parse(power - 1 if operator.text == "^" else power)
            left = self.checked(self.apply(operator, left, right), operator.column)
        self.depth -= 1
        return left

    def prefix(self) -> int:
        """Parse a number, a name, a call, or a value in parentheses or behind a sign."""
        token = self.take()
        if token.text in ("-", "+"):
            value = self.parse(_SIGN)
            return self.builder.neg(value) if token.text == "-" else value
        if token.text == "(":
            value = self.parse(0)
            self.expect(")")
            return value
        if token.kind == "number":
            return self.builder.const(self.number(token))
        if token.kind == "name":
            return self.name(token)
        self.fail(f"expected a number, a name or '(' here, found {self.describe(token)}", token.column)

    def number(self, token: _Token) -> Fraction:
        """Return a number exactly. Raises FirsthitError if it is past the range of float64."""
        try:
            return exact(token.text)
        except FirsthitError as error:
            self.fail(str(error), token.column)

    def name(self, token: _Token) -> int:
        """Parse a coordinate, a parameter, a constant or a call. Raises FirsthitError for an unknown name."""
        name, builder = token.text, self.builder
        if name in FUNCTIONS:
            return self.call(token)
        if name in COORDINATES:
            return builder.var(name)
        if name in self.parameters:
            return builder.var(name) if self.free else builder.const(exact(self.parameters[name]))
        if name in ("pi", "e"):
            return builder.pi() if name == "pi" else builder.e()
        if name == "phi":
            return builder.mul(builder.const(Fraction(1, 2)), builder.add(builder.const(1), self.root(5)))
        if re.fullmatch(r"sqrt[1-9][0-9]{0,3}", name):
            return self.root(int(name[4:]))
        known = [*COORDINATES, *self.parameters, *CONSTANTS, *FUNCTIONS]
        self.fail(f"unknown name {name[:40]!r}; {suggestion(name.lower()[:40], known)}", token.column)

    def root(self, n: int) -> int:
        """Return the square root of a whole number."""
        return self.builder.sqrt(self.builder.const(n))

    def call(self, token: _Token) -> int:
        """Parse a function's arguments and apply it. Raises FirsthitError if their number is wrong."""
        name = token.text
        if self.peek().text != "(":
            self.fail(f"{name!r} is a function; write {name}(...)", token.column)
        self.take()
        values = [self.parse(0)]
        while self.peek().text == ",":
            self.take()
            values.append(self.parse(0))
        self.expect(")")
        function = getattr(self.builder, name)
        if name in ("min", "max"):
            if len(values) < 2:
                self.fail(f"{name} takes two values or more", token.column)
            return int(reduce(function, values))
        if len(values) != 1:
            self.fail(f"{name} takes one value, not {len(values)}", token.column)
        return self.checked(function(values[0]), token.column)

    def apply(self, operator: _Token, left: int, right: int) -> int:
        """Return the result of an operator. Raises FirsthitError for a division by zero."""
        builder = self.builder
        match operator.text:
            case "+":
                return builder.add(left, right)
            case "-":
                return builder.sub(left, right)
            case "*":
                return builder.mul(left, right)
            case "/":
                if builder.value(right) == 0:
                    self.fail("division by zero", operator.column)
                return builder.div(left, right)
        return self.power(operator, left, right)

    def power(self, operator: _Token, base: int, exponent: int) -> int:
        """Return a power. Raises FirsthitError if the exponent is no whole constant or the power too large."""
        builder, n, value = self.builder, self.builder.value(exponent), self.builder.value(base)
        if builder.ops[base].name == "e":
            return builder.exp(exponent)
        if n is None or n.denominator != 1:
            self.fail("an exponent must be a whole constant; write sqrt(a), or exp(b*log(a))", operator.column)
        if value is not None and n != 0:
            if value == 0 and n < 0:
                self.fail("division by zero", operator.column)
            if abs(n) > MAX_BITS or (_bits(value) - 1) * abs(n) > MAX_BITS:
                self.fail(f"this power is a number of more than {MAX_BITS} bits", operator.column)
        elif abs(n) * max(1, self.weight(base)) > MAX_DEGREE:
            self.fail(f"this power's degree is past {MAX_DEGREE}", operator.column)
        return builder.powi(base, int(n))

    def checked(self, index: int, column: int) -> int:
        """Return `index` unless its constant or its degree is too large, which raises FirsthitError."""
        value = self.builder.value(index)
        if value is not None and _bits(value) > MAX_BITS:
            self.fail(f"this constant has more than {MAX_BITS} bits", column)
        if self.weight(index) > MAX_DEGREE:
            self.fail(f"the degree here is past {MAX_DEGREE}", column)
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
            elif op.name in FUNCTIONS:
                weight = min(1, max(inputs))
            else:
                weight = max(inputs, default=int(op.name == "var"))
            self.weights.append(weight)
        return self.weights[index]
