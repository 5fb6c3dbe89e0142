"""Write expressions in our formula language, with the parentheses that they need and no others.

Readers of foreign formats parse their own syntax, whose signs, powers and comparisons bind in their own ways, and build
a Text. Its parts are shared and not copied, so that long sums cost no more than they are long.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

EITHER, BOTH, COMPARISON, SUM, PRODUCT, SIGN, POWER, ATOM = range(8)  # how tightly the outermost operator binds
_MAX_BITS = 400  # of a rational constant that is computed here


@dataclass(frozen=True, slots=True)
class Text:
    """Hold a piece of a formula. `value` is that of a rational constant, where it is known."""

    parts: tuple[str | Text, ...]
    binding: int = ATOM
    value: Fraction | None = None

    @property
    def is_condition(self) -> bool:
        """Return whether this is true or false, and no number."""
        return self.binding <= COMPARISON

    def __str__(self) -> str:
        """Return the text; built without recursion, since sums can be long."""
        pieces: list[str] = []
        todo: list[str | Text] = [self]
        while todo:
            part = todo.pop()
            if isinstance(part, str):
                pieces.append(part)
            else:
                todo.extend(reversed(part.parts))
        return "".join(pieces)


def word(text: str) -> Text:
    """Return a name or another piece that needs no parentheses."""
    return Text((text,))


def literal(text: str) -> Text:
    """Return a decimal number as it is written. Its value is left open where the exponent is large."""
    exponent = text.lower().partition("e")[2]
    small = len(text) <= 60 and (not exponent or abs(int(exponent)) <= 60)
    return Text((text,), ATOM, Fraction(text) if small else None)


def rational(value: Fraction | int) -> Text:
    """Return a rational number: a decimal where it has a short one, else a quotient."""
    value = Fraction(value)
    if value < 0:
        return negative(rational(-value))
    scale = 1
    for digits in range(18):
        if (value * scale).denominator == 1:
            whole = str(value.numerator * scale // value.denominator).rjust(digits + 1, "0")
            text = whole if not digits else f"{whole[:-digits]}.{whole[-digits:]}"
            return Text((text,), ATOM, value)
        scale *= 10
    return Text((f"{value.numerator}/{value.denominator}",), PRODUCT, value)


def number(a: Text) -> Text:
    """Return a number: 1 or 0 for a condition."""
    return choose(a, word("1"), word("0")) if a.is_condition else a


def condition(a: Text) -> Text:
    """Return a condition: for a number, that it is not 0."""
    return a if a.is_condition else Text((_inside(a, SUM), " != ", "0"), COMPARISON)


def _inside(a: Text, binding: int) -> Text:
    """Return `a`, in parentheses unless it binds at least so tightly."""
    return a if a.binding >= binding else Text(("(", a, ")"), ATOM, a.value)


def _unsigned(a: Text, binding: int) -> Text:
    """Return `a` as an operator's right operand; a sign gets parentheses."""
    return Text(("(", a, ")"), ATOM, a.value) if a.binding == SIGN else _inside(a, binding)


def _known(value: Fraction) -> Fraction | None:
    """Return a constant's value unless it is too long to compute with."""
    return value if max(value.numerator.bit_length(), value.denominator.bit_length()) <= _MAX_BITS else None


def add(a: Text, b: Text) -> Text:
    a, b = number(a), number(b)
    value = None if a.value is None or b.value is None else _known(a.value + b.value)
    return Text((_inside(a, SUM), " + ", _unsigned(b, PRODUCT)), SUM, value)


def sub(a: Text, b: Text) -> Text:
    a, b = number(a), number(b)
    value = None if a.value is None or b.value is None else _known(a.value - b.value)
    return Text((_inside(a, SUM), " - ", _unsigned(b, PRODUCT)), SUM, value)


def mul(a: Text, b: Text) -> Text:
    a, b = number(a), number(b)
    value = None if a.value is None or b.value is None else _known(a.value * b.value)
    return Text((_inside(a, PRODUCT), "*", _unsigned(b, SIGN)), PRODUCT, value)


def div(a: Text, b: Text) -> Text:
    a, b = number(a), number(b)
    value = _known(a.value / b.value) if a.value is not None and b.value else None
    return Text((_inside(a, PRODUCT), "/", _unsigned(b, SIGN)), PRODUCT, value)


def negative(a: Text) -> Text:
    a = number(a)
    return Text(("-", _inside(a, POWER)), SIGN, None if a.value is None else -a.value)


def power(a: Text, b: Text) -> Text:
    a, b = number(a), number(b)
    value = None
    small = b.value is not None and b.value.denominator == 1 and abs(b.value) <= 100
    if small and a.value is not None and b.value is not None and (a.value or b.value > 0):
        value = _known(a.value ** int(b.value))
    return Text((_inside(a, ATOM), "^", _inside(b, ATOM)), POWER, value)


def call(name: str, *arguments: Text) -> Text:
    """Return a call of a function of our language, or of the formula's own."""
    parts: list[str | Text] = [name, "("]
    for i, argument in enumerate(arguments):
        parts += [", ", number(argument)] if i else [number(argument)]
    return Text((*parts, ")"))


def compare(a: Text, sign: str, b: Text) -> Text:
    """Return a condition; `sign` is one of < <= > >= == !=."""
    return Text((_inside(number(a), SUM), f" {sign} ", _inside(number(b), SUM)), COMPARISON)


def both(a: Text, b: Text) -> Text:
    return Text((_inside(condition(a), BOTH), " and ", _inside(condition(b), COMPARISON)), BOTH)


def either(a: Text, b: Text) -> Text:
    return Text((condition(a), " or ", _inside(condition(b), BOTH)), EITHER)


def opposite(a: Text) -> Text:
    return Text(("not ", Text(("(", condition(a), ")"))), COMPARISON)


def choose(a: Text, b: Text, c: Text) -> Text:
    """Return b where the condition a holds, else c."""
    return Text(("if(", condition(a), ", ", number(b), ", ", number(c), ")"))
