"""Read and write tapes (.vm): one operation in a line, a name for its value before it, as in `_2 add _0 _1`.

The format is that of Matt Keeter's fidget (Context::from_text in fidget-core/src/context/mod.rs), known from the
Prospero challenge: `#` begins a comment, the last line is the result. What each operation means is there too: `mod` is
the least remainder that is not negative, `round` goes away from zero, `compare` is -1, 0 or 1, and `and` and `or` give
one of their inputs. Viewers draw tapes in the cube from -1 to 1. Tapes of firsthit
have their domain in a comment.
"""

from __future__ import annotations

import re
from collections import Counter

from surfaces.files.expressions import (
    Text,
    add,
    call,
    choose,
    compare,
    div,
    literal,
    mul,
    negative,
    power,
    sub,
    word,
)
from surfaces.files.source import Reading, Source
from surfaces.files.syntax import Parts, function
from surfaces.language.tokens import exact
from surfaces.model import FirsthitError
from surfaces.words import suggestion

NAME = "a tape"
MAX_LINES = 60_000
_NESTED = 12  # values that are used once stand inside one another up to this deep
_ZERO, _ONE = word("0"), word("1")


def _both(a: Text, b: Text) -> Text:
    return choose(compare(a, "==", _ZERO), _ZERO, b)


def _either(a: Text, b: Text) -> Text:
    return choose(compare(a, "==", _ZERO), b, a)


def _compared(a: Text, b: Text) -> Text:
    return choose(compare(a, "<", b), negative(_ONE), choose(compare(a, ">", b), _ONE, _ZERO))


def _remainder(a: Text, b: Text) -> Text:
    size = call("abs", b)
    return sub(a, mul(size, call("floor", div(a, size))))


def _rounded(a: Text) -> Text:
    return mul(call("sign", a), call("floor", add(call("abs", a), word("0.5"))))


UNARY = {
    "neg": negative,
    "abs": lambda a: call("abs", a),
    "recip": lambda a: div(_ONE, a),
    "square": lambda a: power(a, word("2")),
    "ln": lambda a: call("log", a),
    "not": lambda a: choose(compare(a, "==", _ZERO), _ONE, _ZERO),
    "ceil": lambda a: negative(call("floor", negative(a))),
    "round": _rounded,
    **{name: function(name) for name in ("sqrt", "floor", "sin", "cos", "tan", "asin", "acos", "atan", "exp")},
}
BINARY = {
    "add": add,
    "sub": sub,
    "mul": mul,
    "div": div,
    "min": lambda a, b: call("min", a, b),
    "max": lambda a, b: call("max", a, b),
    "atan2": lambda a, b: call("atan2", a, b),
    "compare": _compared,
    "mod": _remainder,
    "and": _both,
    "or": _either,
}
_AGAIN = {"compare", "mod", "and", "or", "round"}  # their formulas name an input more than once
_VARIABLES = {"var-x": "x", "var-y": "y", "var-z": "z"}


def read(source: Source) -> Reading:
    """Read a tape. Raises FirsthitError, with the line, for one that is none."""
    lines = _lines(source)
    uses: Counter[str] = Counter()
    for _, operation, inputs in lines.values():
        if operation != "const":
            uses.update(inputs * (2 if operation in _AGAIN else 1))
    values: dict[str, Text] = {}
    depths: dict[str, int] = {}
    parts = Parts()
    axes = set()
    last = next(reversed(lines))
    for name, (line, operation, inputs) in lines.items():
        if operation == "const":
            values[name], depths[name] = _constant(source, inputs[0], line), 0
            continue
        if operation in _VARIABLES:
            axes.add(_VARIABLES[operation])
            values[name], depths[name] = word(_VARIABLES[operation]), 0
            continue
        make = UNARY.get(operation) or BINARY[operation]
        value = make(*(values[i] for i in inputs))
        depth = 1 + max(depths[i] for i in inputs)
        if name != last and (uses[name] > 1 or depth > _NESTED):
            value, depth = parts.define(f"v{len(parts.texts) + 1}", value), 0
        values[name], depths[name] = value, depth
    if not axes:
        source.fail("the tape reads no var-x, var-y or var-z: it describes no surface")
    ours = re.search(r"^# domain (\S+)\n# written by firsthit$", source.text, re.MULTILINE)  # as `titled` writes it
    if ours is None:
        source.remark("a tape has no domain; the cube from -1 to 1, in which its viewers draw, is taken")
    if absent := sorted(set("xyz") - axes):
        what = "a prism" if len(absent) == 1 else "planes"
        source.remark(f"the tape does not read {' and '.join(absent)}: the surface is {what} along it")
    return Reading(parts.formula(values[last]), ours[1] if ours else "box:1,1,1")


def _lines(source: Source) -> dict[str, tuple[int, str, list[str]]]:
    """Return the operations by the names of their values: the line, the operation and its inputs.

    Raises FirsthitError for a line that is no operation, or that has inputs which are not there.
    """
    lines: dict[str, tuple[int, str, list[str]]] = {}
    for number, text in enumerate(source.text.split("\n"), 1):
        words = text.partition("#")[0].split()
        if not words:
            continue
        if len(lines) == MAX_LINES:
            source.fail(f"more than {MAX_LINES} operations are not read", number)
        name, operation, *inputs = words if len(words) > 1 else [words[0], ""]
        arity = 1 if operation in UNARY or operation == "const" else 2 if operation in BINARY else 0
        if not arity and operation not in _VARIABLES:
            known = [*_VARIABLES, "const", *UNARY, *BINARY]
            source.fail(f"{operation[:40]!r} is no operation of a tape; {suggestion(operation[:40], known)}", number)
        if len(inputs) != arity:
            source.fail(f"{operation} takes {arity} word{'s' * (arity != 1)}, not {len(inputs)}", number)
        if name in lines:
            source.fail(f"{name[:40]} has a value already, since line {lines[name][0]}", number)
        if operation != "const" and (unknown := [i for i in inputs if i not in lines]):
            source.fail(f"{unknown[0][:40]} has no value yet", number)
        lines[name] = number, operation, inputs
    if not lines:
        source.fail("the tape has no operations")
    return lines


def _constant(source: Source, text: str, line: int) -> Text:
    """Return a constant. Raises FirsthitError for what is no decimal number, such as inf."""
    try:
        exact(text)
    except FirsthitError as error:
        source.fail(str(error), line)
    plain = text.lstrip("+-")
    return negative(literal(plain)) if text.startswith("-") else literal(plain)
