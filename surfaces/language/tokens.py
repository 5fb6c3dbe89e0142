"""Split the text of a formula into tokens, and say where in the text something is wrong."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import NamedTuple, NoReturn

from surfaces.model import FirsthitError

MAX_BITS = 1000  # of a rational constant's numerator and denominator, which keeps it inside float64's range
MAX_DIGITS = 400  # characters of one number
MAX_NAME = 60  # characters of one name
WORDS = {"and": "and", "or": "or", "not": "not"}
# other ways to write an operator, a word or a name
SAME = {
    "**": "^",
    "&&": "and",
    "∧": "and",
    "∨": "or",
    "¬": "not",
    "·": "*",
    "×": "*",
    "∗": "*",
    "⋅": "*",
    "∙": "*",
    "÷": "/",
    "∕": "/",
    "⁄": "/",
    "−": "-",
    "–": "-",
    "﹣": "-",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "<>": "!=",
    "π": "pi",
    "φ": "phi",
    "ϕ": "phi",
    "τ": "tau",
}
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻"
_LOWERED = str.maketrans(_RAISED, "0123456789+-")
_TOKEN = re.compile(
    r"(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*|[πφϕτ])"
    r"|(?P<space>[ \t\r\n\u00a0\u2009\u202f]+|(?:\#|//)[^\n]*|/\*.*?\*/)"
    r"|(?P<operator>\*\*|&&|<=|>=|==|!=|<>|[-+*/^(),;=<>!?:|%√·×∗⋅∙÷∕⁄−–﹣≤≥≠∧∨¬])"
    rf"|(?P<raised>[⁺⁻]?[{_RAISED[:10]}]+)",
    re.DOTALL,
)
_NUMBER = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE](?P<exponent>[+-]?[0-9]+))?")


class Token(NamedTuple):
    """Hold one token. `spaced` and `line` say whether white space and whether a new line stand before it."""

    kind: str  # "number", "name", "raised", "operator" or "end"
    text: str  # as the grammar knows it: "^" for "**"
    column: int  # 0-based place in the whole text
    spaced: bool = False
    line: bool = False


def fail(text: str, message: str, place: int) -> NoReturn:
    """Raise FirsthitError with the part of the line around a place of the text, and a caret below it."""
    begin = text.rfind("\n", 0, place) + 1
    stop = text.find("\n", place)
    line, column = text.count("\n", 0, place) + 1, place - begin
    start, end = max(begin, place - 60), min(place + 40, len(text) if stop < 0 else stop)
    shown = "".join(c if c.isprintable() else "?" for c in text[start:end])
    where = f"line {line}, column {column + 1}" if "\n" in text else f"column {column + 1}"
    raise FirsthitError(f"formula, {where}: {message}\n    {shown}\n    {' ' * (place - start)}^")


def exact(text: str) -> Fraction:
    """Return a decimal number exactly. Raises FirsthitError for other text, and past the range of float64."""
    match = _NUMBER.fullmatch(text)
    if match is None or len(text) > MAX_DIGITS:
        raise FirsthitError(f"{text[:40]!r} is not a decimal number")
    if len(match["exponent"] or "") > 4 or abs(int(match["exponent"] or 0)) > 300:
        raise FirsthitError(f"{text[:40]!r} is past the range of float64")
    value = Fraction(text)
    if bits(value) > MAX_BITS:
        raise FirsthitError(f"{text[:40]!r} is past the range of float64")
    return value


def bits(value: Fraction) -> int:
    """Return the length of the longer of numerator and denominator, in bits."""
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def tokens(text: str) -> list[Token]:
    """Split a text into tokens, the last of which is its end. Raises FirsthitError at characters without a meaning."""
    found: list[Token] = []
    column, spaced, line = 0, False, False
    while column < len(text):
        match = _TOKEN.match(text, column)
        if match is None or match.lastgroup is None:
            fail(text, _misplaced(text, column), column)
        kind, word = match.lastgroup, match.group()
        if word == "/" and text.startswith("/*", column):
            fail(text, "this comment has no end; write */ behind it", column)
        if kind != "space" and len(word) > (MAX_DIGITS if kind == "number" else MAX_NAME):
            fail(text, f"a {'number' if kind != 'name' else kind} of {len(word)} characters", column)
        if kind == "space":
            spaced, line = True, line or "\n" in word
        else:
            if kind == "raised":
                word = word.translate(_LOWERED)
            elif kind == "name" and word.lower() in WORDS:
                kind, word = "operator", WORDS[word.lower()]
            found.append(Token(kind, SAME.get(word, word), column, spaced, line))
            spaced = line = False
        column = match.end()
    found.append(Token("end", "", len(text), spaced, line))
    return found


_FROM_LATEX = r"write (a)/(b) for \frac{a}{b}, * for \cdot, sqrt(a) for \sqrt{a}"


def _misplaced(text: str, column: int) -> str:
    """Return what is wrong with a character that begins no token."""
    character = text[column]
    hint = "; write ( ) around parts" if character in "[]{}" else ""
    if character == "\\":
        return f"'{character}' has no place in a formula, which is no LaTeX; {_FROM_LATEX}"
    if text[column : column + 2] in (".*", "./", ".^"):
        hint = "; operators have no dot"
    return f"{character!r} (U+{ord(character):04X}) has no place in a formula{hint}"
