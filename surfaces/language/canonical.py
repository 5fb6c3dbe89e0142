"""Write a tape as text in the language's primitives, which reads back as the same graph.

Parts that are used more than once and are long, and parts that are nested deeply, become `let s1 = ...;`.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from surfaces.tape import Op, Tape

SHORT = 12  # characters of a part that is written again where it is used again
DEEP = 100  # levels of reading inside one another; grammar.MAX_DEPTH is the most
_OR, _AND, _NOT, _COMPARE, _SUM, _PRODUCT, _SIGN, _POWER, _ATOM = 4, 6, 7, 8, 10, 20, 30, 40, 60


@dataclass(frozen=True, slots=True)
class _Part:
    """Hold a piece of text as a tree of pieces, so that long sums take linear time."""

    pieces: tuple[Any, ...]  # texts and parts
    binding: int  # how tight its outermost operator binds
    length: int
    depth: int
    minus: bool = False  # whether it begins with a minus sign

    def text(self) -> str:
        """Return the whole text."""
        found: list[str] = []
        waiting: list[Any] = [self]
        while waiting:
            piece = waiting.pop()
            if isinstance(piece, str):
                found.append(piece)
            else:
                waiting.extend(reversed(piece.pieces))
        return "".join(found)


def _made(binding: int, *pieces: str | _Part) -> _Part:
    """Return a part of pieces."""
    length = sum(len(p) if isinstance(p, str) else p.length for p in pieces)
    depth = max((p.depth + (i > 0) for i, p in enumerate(pieces) if isinstance(p, _Part)), default=0)
    first = pieces[0]
    return _Part(pieces, binding, length, depth, first.startswith("-") if isinstance(first, str) else first.minus)


def _inside(before: str, part: _Part, after: str = ")") -> _Part:
    """Return a part inside brackets, which are read as one level, those of a call as two."""
    return _Part((before, part, after), _ATOM, part.length + len(before) + 1, part.depth + 2)


def _wrapped(part: _Part, binding: int, right: bool = False) -> _Part:
    """Return a part in parentheses unless it binds at least as tight; `right`: unless it has no minus sign either."""
    return _inside("(", part) if part.binding < binding or (right and part.minus) else part


def number(value: Fraction) -> str:
    """Return a rational number as a decimal where it has a short one, else as a quotient."""
    if value.denominator == 1 and abs(value) < 10**17:
        return str(value.numerator)
    if abs(value) < 10**300 and value != 0:
        decimal = repr(float(value))
        if Fraction(decimal) == value:
            return decimal
    if value.denominator == 1:
        return str(value.numerator)
    return f"{value.numerator}/{value.denominator}"


def _constant(value: Fraction) -> _Part:
    text = number(value)
    return _Part((text,), _PRODUCT if "/" in text else _SIGN if value < 0 else _ATOM, len(text), 0, value < 0)


def canonical(tape: Tape) -> str:
    """Return the text of a tape that the formula language made: statements that define parts, and the value.

    Raises ValueError for an operation that the language has no word for.
    """
    uses = Counter(i for op in tape.ops for i in op.inputs)
    taken = {op.args[0] for op in tape.ops if op.name == "var"}
    names = (name for k in range(1, len(tape.ops) + 2) if (name := f"s{k}") not in taken)
    statements: list[str] = []
    parts: list[_Part] = []
    constant, conditions = tape.constants(), _conditions(tape)
    for index, op in enumerate(tape.ops):
        condition = _condition(tape, op, parts) if conditions[index] and op.inputs else None
        part = condition or _written(tape, op, parts, constant)
        shared = uses[index] > 1 and part.length > SHORT
        if op.inputs and (shared or part.depth >= DEEP) and index != tape.outputs[0]:
            name = next(names)
            statements.append(f"let {name} = {part.text()}; ")
            part = _Part((name,), _ATOM, len(name), 0)
        parts.append(part)
    return "".join(statements) + parts[tape.outputs[0]].text()


def _conditions(tape: Tape) -> list[bool]:
    """Return for each operation whether it is 0 or 1 by its structure."""
    known: list[bool] = []
    for op in tape.ops:
        if op.name in ("min", "max"):
            known.append(all(known[i] for i in op.inputs))
        elif op.name == "sub":
            first = tape.ops[op.args[0]]
            known.append(first.name == "const" and first.args[0] == 1 and known[op.args[1]])
        else:
            known.append(op.name == "below" or (op.name == "const" and op.args[0] in (0, 1)))
    return known


def _condition(tape: Tape, op: Op, parts: list[_Part]) -> _Part | None:
    """Return the text of a condition, as people write it; None if only arithmetic reads back as the same."""

    def compared(sign: str, a: int, b: int) -> _Part:
        if tape.ops[a].name == "const" and sign != "==":
            a, b, sign = b, a, ">=" if sign == "<=" else "<"
        return _made(_COMPARE, _wrapped(parts[a], _SUM), f" {sign} ", _wrapped(parts[b], _SUM))

    a, b = op.args
    if op.name == "below":
        return compared("<=", a, b)
    first, second = tape.ops[a], tape.ops[b]
    if op.name in ("min", "max"):
        if "const" in (first.name, second.name):
            return None
        if op.name == "min" and first.name == second.name == "below" and first.args == second.args[::-1]:
            return compared("==", *first.args)
        word, binding = ("and", _AND) if op.name == "min" else ("or", _OR)
        return _made(binding, _wrapped(parts[a], binding), f" {word} ", _wrapped(parts[b], binding + 1))
    if second.name == "below":
        return compared(">", *second.args)
    if second.name in ("sub", "const"):
        return None
    return _made(_NOT, "not ", _wrapped(parts[b], _NOT))


def _written(tape: Tape, op: Op, parts: list[_Part], constant: list[bool]) -> _Part:
    """Return the text of one operation, from those of its inputs."""
    of = [parts[i] for i in op.inputs]
    match op.name:
        case "const":
            return _constant(op.args[0])
        case "pi" | "e":
            return _made(_ATOM, op.name)
        case "var":
            return _made(_ATOM, op.args[0])
        case "neg" if tape.ops[op.args[0]].name == "sub":  # -(a - b) would be read as b - a
            return _made(_PRODUCT, "-1*", _wrapped(of[0], _POWER))
        case "neg":
            bare = _bare(tape, op.args[0], constant)
            return _made(_SIGN if not bare else _PRODUCT, "-", of[0] if bare else _wrapped(of[0], _POWER))
        case "add":
            return _made(_SUM, _wrapped(of[0], _SUM), " + ", _wrapped(of[1], _PRODUCT, right=True))
        case "sub":
            return _made(_SUM, _wrapped(of[0], _SUM), " - ", _wrapped(of[1], _PRODUCT, right=True))
        case "mul" | "div":
            sign = "*" if op.name == "mul" else "/"
            return _made(_PRODUCT, _wrapped(of[0], _PRODUCT), sign, _wrapped(of[1], _POWER))
        case "sqr":
            return _made(_POWER, _wrapped(of[0], _ATOM), "^2")
        case "powi" | "powr":
            exponent = _wrapped(_constant(Fraction(op.args[1])), _ATOM)
            return _made(_POWER, _wrapped(of[0], _ATOM), "^", exponent)
        case "select":
            return _inside("if(", _made(0, of[0], ", ", of[1], ", ", of[2]))
        case "min" | "max" | "atan2":
            return _inside(f"{op.name}(", _made(0, of[0], ", ", of[1]))
        case "sqrt" | "exp" | "log" | "sin" | "cos" | "tan" | "abs" | "floor":
            return _inside(f"{op.name}(", of[0])
    raise ValueError(f"the formula language has no word for {op.name}")


def _bare(tape: Tape, index: int, constant: list[bool]) -> bool:
    """Return whether a minus sign may stand before a product without parentheses: it moves out of its first factor."""
    if tape.ops[index].name != "mul":
        return False
    while tape.ops[index].name == "mul":
        if constant[index]:
            return False
        index = tape.ops[index].args[0]
    return not constant[index] and tape.ops[index].name not in ("div", "add", "sub", "neg", "below")
