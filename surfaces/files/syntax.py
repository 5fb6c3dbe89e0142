"""Parse the expressions of foreign formats, each with its own operators and functions, into our formula language."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from math import isfinite, nan

from surfaces.files.expressions import ATOM, Text, add, call, compare, literal, mul, number, sub, word
from surfaces.files.source import Source, Token
from surfaces.model import FirsthitError
from surfaces.words import COORDINATES, suggestion

MAX_DEPTH = 60  # of parentheses and calls inside one another
_NAME = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")
Unary = Callable[[Text], Text]
Binary = Callable[[Text, Text], Text]


def function(name: str) -> Callable[..., Text]:
    """Return what calls a function of our language."""
    return lambda *arguments: call(name, *arguments)


def comparison(sign: str) -> Binary:
    """Return what compares two numbers."""
    return lambda a, b: compare(a, sign, b)


def folded(name: str) -> Callable[..., Text]:
    """Return what calls a function of two values, or of more by applying it again, as in min(a, b, c)."""

    def apply(*arguments: Text) -> Text:
        value = arguments[0]
        for argument in arguments[1:]:
            value = call(name, value, argument)
        return value

    return apply


def one(name: str) -> tuple[int, int, Callable[..., Text]]:
    """Return a function of one value for a dialect's table."""
    return 1, 1, function(name)


SAME = {  # functions that every format calls as we do
    name: one(name)
    for name in ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "sqrt", "abs")
}


@dataclass(frozen=True)
class Dialect:
    """Say how a format writes expressions.

    infix, prefix: an operator's binding, and what it makes of its operands
    functions: the fewest and the most arguments, and what a call makes of them
    names: constants
    right: the operators of which a chain is read from the right
    unread: what to say of a function, a word or an operator that is not read
    ignores_case: whether names in capitals are the same
    """

    infix: Mapping[str, tuple[int, Binary]]
    prefix: Mapping[str, tuple[int, Unary]]
    functions: Mapping[str, tuple[int, int, Callable[..., Text]]]
    names: Mapping[str, Text] = field(default_factory=dict)
    right: frozenset[str] = frozenset({"^"})
    unread: Mapping[str, str] = field(default_factory=dict)
    ignores_case: bool = False


PLAIN: dict[str, tuple[int, Binary]] = {"+": (50, add), "-": (50, sub), "*": (60, mul)}


@dataclass
class Scope:
    """Hold the names that a file defines, and those that stand for them in our language.

    `values` are coordinates, parameters and named parts; `functions` have the number of their arguments and the name
    that they are called by.
    """

    values: dict[str, Text] = field(default_factory=dict)
    functions: dict[str, tuple[int, str]] = field(default_factory=dict)
    taken: set[str] = field(default_factory=set)

    def fresh(self, name: str) -> str:
        """Return a name for a part of our formula that is like `name`, and no word of the language or of this scope."""
        plain = re.sub(r"[^A-Za-z_0-9]", "_", name)[:40] or "part"
        plain = plain if re.match(r"[A-Za-z]", plain) else f"p{plain}"
        if reserved(plain):
            plain += "_"
        number, chosen = 1, plain
        while chosen.lower() in self.taken:
            number += 1
            chosen = f"{plain}_{number}"
        self.taken.add(chosen.lower())
        return chosen


@cache
def _language() -> frozenset[str]:
    """Return the words that our language knows."""
    from surfaces.language.names import BUILT_IN, CONSTANTS, RESERVED
    from surfaces.language.prelude import library

    return frozenset({*COORDINATES, *BUILT_IN, *CONSTANTS, *RESERVED, *library()})


def reserved(name: str) -> bool:
    """Return whether a name has a meaning in our language, in small letters or in capitals."""
    return name.lower() in _language() or re.fullmatch(r"(?i)sqrt[0-9]+", name) is not None


class Parser:
    """Parse expressions by precedence climbing. `at` is the place of the next word."""

    def __init__(self, source: Source, words: Sequence[Token], dialect: Dialect, scope: Scope) -> None:
        self.source, self.words, self.dialect, self.scope = source, words, dialect, scope
        self.at = 0
        self.depth = 0

    def peek(self, ahead: int = 0) -> Token:
        """Return the next word, or one behind it."""
        return self.words[min(self.at + ahead, len(self.words) - 1)]

    def take(self) -> Token:
        """Return the next word, and go on behind it."""
        token = self.peek()
        self.at += token.kind != "end"
        return token

    def took(self, text: str) -> bool:
        """Go on behind the next word where it is `text`, and say whether it was."""
        found = self.peek().text == text and self.peek().kind != "text"
        self.at += found
        return found

    def expect(self, text: str) -> Token:
        """Take a word that must be `text`. Raises FirsthitError if it is another."""
        token = self.take()
        if token.text != text or token.kind == "text":
            self.source.fail(f"expected {text!r}, found {shown(token)}", token.line)
        return token

    def name(self) -> Token:
        """Take a word that must be a name. Raises FirsthitError if it is none."""
        token = self.take()
        if token.kind != "name":
            self.source.fail(f"expected a name, found {shown(token)}", token.line)
        return token

    def whole(self) -> Text:
        """Parse an expression that all words belong to. Raises FirsthitError where something is left over."""
        value = self.expression()
        if (token := self.peek()).kind != "end":
            self.source.fail(f"expected an operator, found {shown(token)}", token.line)
        return value

    def expression(self, binding: int = 0) -> Text:
        """Parse all that binds tighter than `binding`. Raises FirsthitError for anything that is no expression."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self.source.fail(f"nested more than {MAX_DEPTH} deep", self.peek().line)
        left = self._operand()
        while (known := self.dialect.infix.get(self.peek().text)) and self.peek().kind == "operator":
            strength, apply = known
            if strength <= binding:
                break
            operator = self.take()
            right = self.expression(strength - (operator.text in self.dialect.right))
            left = apply(left, right)
        if (token := self.peek()).kind == "operator" and token.text in self.dialect.unread:
            self.source.fail(f"{token.text!r} is not read: {self.dialect.unread[token.text]}", token.line)
        self.depth -= 1
        return left

    def _operand(self) -> Text:
        """Parse a number, a name, a call, or a value in parentheses or behind a sign."""
        token = self.take()
        if token.kind == "operator" and token.text in self.dialect.prefix:
            strength, apply = self.dialect.prefix[token.text]
            return apply(self.expression(strength))
        if token.kind == "operator" and token.text == "(":
            value = self.expression()
            self.expect(")")
            return value
        if token.kind == "number":
            if len(token.text) > 300:
                self.source.fail("a number of more than 300 characters", token.line)
            return literal(token.text)
        if token.kind == "name":
            return self._named(token)
        self.source.fail(f"expected a number, a name or '(', found {shown(token)}", token.line)

    def _named(self, token: Token) -> Text:
        """Parse what begins with a name. Raises FirsthitError for one that is not known, or not read."""
        dialect, scope = self.dialect, self.scope
        name = token.text
        plain = name.lower() if dialect.ignores_case else name
        if self.peek().text == "(" and self.peek().kind == "operator":
            if name in scope.functions:
                arity, ours = scope.functions[name]
                return call(ours, *self._arguments(token, arity, arity))
            if plain in dialect.functions:
                fewest, most, make = dialect.functions[plain]
                return make(*self._arguments(token, fewest, most))
        elif name in scope.values:
            return scope.values[name]
        elif plain in dialect.names:
            return dialect.names[plain]
        if plain in dialect.unread:
            self.source.fail(f"{name} is not read: {dialect.unread[plain]}", token.line)
        known = [*scope.values, *dialect.names, *scope.functions, *dialect.functions]
        self.source.fail(f"unknown name {name[:40]!r}; {suggestion(name[:40], known)}", token.line)

    def _arguments(self, token: Token, fewest: int, most: int) -> list[Text]:
        """Parse the arguments of a call. Raises FirsthitError if their number is wrong."""
        self.expect("(")
        arguments = [] if self.peek().text == ")" else [self.expression()]
        while self.took(","):
            arguments.append(self.expression())
        self.expect(")")
        if not fewest <= len(arguments) <= most:
            takes = str(fewest) if fewest == most else f"{fewest} or more"
            self.source.fail(f"{token.text} takes {takes} values, not {len(arguments)}", token.line)
        return arguments


def shown(token: Token) -> str:
    """Return how a message names a word."""
    return "the end" if token.kind == "end" else repr(token.text[:40])


@dataclass
class Parts:
    """Hold the named parts of a formula that is being written, in their order."""

    texts: list[tuple[str, tuple[str, ...], Text]] = field(default_factory=list)

    def define(self, name: str, value: Text, arguments: Sequence[str] = ()) -> Text:
        """Add a part, or a function of `arguments`, and return what stands for it."""
        self.texts.append((name, tuple(arguments), value))
        return Text((name,), ATOM, value.value)

    def formula(self, value: Text) -> str:
        """Return the formula of a value: the parts that it needs and itself, one in each line."""
        last = str(number(value))
        needed = set(_NAME.findall(last))
        lines = [last]
        for name, arguments, part in reversed(self.texts):
            if name in needed:
                written = str(number(part))
                needed.update(_NAME.findall(written))
                given = f"({', '.join(arguments)})" if arguments else ""
                lines.append(f"let {name}{given} = {written}")
        return ";\n".join(reversed(lines))

    def constant(self, source: Source, value: Text, what: str, line: int | None) -> float:
        """Return the value of a constant. Raises FirsthitError where it is none, or no finite number."""
        if value.value is not None:
            return float(value.value)
        from numpy import zeros

        from surfaces import evaluation, formula, lowering

        try:
            tape = formula.parse(self.formula(value))
            known = tape.constants()[tape.outputs[0]]
            result = float(evaluation.evaluate_tape(lowering.real_tape(tape), zeros((1, 3)))[0, 0]) if known else nan
        except (FirsthitError, ArithmeticError) as error:
            source.fail(f"{what} is no constant: {error}", line)
        if not isfinite(result):
            source.fail(f"{what} is no finite constant: {str(value)[:60]}", line)
        return result


def coordinates() -> dict[str, Text]:
    """Return the coordinates by their names."""
    return {name: word(name) for name in "xyz"}
