"""Write tapes as expressions of other languages: for each a number system whose numbers are pieces of text."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from fractions import Fraction

from surfaces.files.expressions import (
    Text,
    add,
    call,
    compare,
    div,
    literal,
    mul,
    negative,
    power,
    rational,
    sub,
    word,
)
from surfaces.model import FirsthitError, Surface, domain_text
from surfaces.numbers import Arithmetic
from surfaces.tape import LEAVES, Tape
from surfaces.visible import one_line


class Words(Arithmetic):
    """Write operations as our own language does, where no language says otherwise."""

    language = "the language"

    def refuse(self, what: str) -> Text:
        """Raise FirsthitError: the language has no such thing."""
        raise FirsthitError(f"{self.language} has no {what}; --as {self.others} has it")

    others = "sympy"
    add = staticmethod(add)
    sub = staticmethod(sub)
    mul = staticmethod(mul)
    div = staticmethod(div)
    neg = staticmethod(negative)

    def const(self, value: Fraction) -> Text:
        return rational(value)

    def pi(self) -> Text:
        return word("pi")

    def e(self) -> Text:
        return call("exp", word("1"))

    def sqr(self, a: Text) -> Text:
        return self.powi(a, 2)

    def powi(self, a: Text, n: int) -> Text:
        return power(a, word(str(n)))

    def powr(self, a: Text, q: Fraction) -> Text:
        return call("pow", a, rational(q))

    def abs(self, a: Text) -> Text:
        return call("abs", a)

    def sqrt(self, a: Text) -> Text:
        return call("sqrt", a)

    def exp(self, a: Text) -> Text:
        return call("exp", a)

    def log(self, a: Text) -> Text:
        return call("log", a)

    def sin(self, a: Text) -> Text:
        return call("sin", a)

    def cos(self, a: Text) -> Text:
        return call("cos", a)

    def tan(self, a: Text) -> Text:
        return call("tan", a)

    def floor(self, a: Text) -> Text:
        return call("floor", a)

    def atan2(self, a: Text, b: Text) -> Text:
        return call("atan2", a, b)

    def min(self, a: Text, b: Text) -> Text:
        return call("min", a, b)

    def max(self, a: Text, b: Text) -> Text:
        return call("max", a, b)


class Jsurf(Words):
    """Write polynomials as jsurf reads them; its functions take numbers only."""

    language = "a .jsurf file"
    others = "pov"

    def pi(self) -> Text:
        return call("acos", negative(word("1")))

    def powr(self, a: Text, q: Fraction) -> Text:
        return power(a, rational(q))

    def atan2(self, *_: Text) -> Text:
        return self.refuse("atan2")

    def min(self, *_: Text) -> Text:
        return self.refuse("min")

    def max(self, *_: Text) -> Text:
        return self.refuse("max")

    def below(self, *_: Text) -> Text:
        return self.refuse("comparison")

    def select(self, *_: Text) -> Text:
        return self.refuse("if")


class Povray(Words):
    """Write functions of POV-Ray, which have no ^."""

    language = "a POV-Ray function"

    def log(self, a: Text) -> Text:
        return call("ln", a)

    def powi(self, a: Text, n: int) -> Text:
        return mul(a, a) if n == 2 and str(a) in ("x", "y", "z") else call("pow", a, word(str(n)))

    def below(self, a: Text, b: Text) -> Text:
        return Text(("(", compare(a, "<=", b), ")"))

    def select(self, c: Text, p: Text, q: Text) -> Text:
        return call("select", sub(c, word("0.5")), q, p)


class Glsl(Words):
    """Write GLSL in float; powers are products, since its pow has no value for negative numbers."""

    language = "GLSL"

    def const(self, value: Fraction) -> Text:
        number = literal(repr(abs(float(value))))
        return negative(number) if value < 0 else number

    def pi(self) -> Text:
        return literal("3.141592653589793")

    def powi(self, a: Text, n: int) -> Text:
        return call(f"power{n}", a)

    def powr(self, a: Text, q: Fraction) -> Text:
        return call("pow", a, self.const(q))

    def e(self) -> Text:
        return literal("2.718281828459045")

    def atan2(self, a: Text, b: Text) -> Text:
        return call("angle", a, b)

    def below(self, a: Text, b: Text) -> Text:
        return Text(("(", compare(a, "<=", b), " ? 1.0 : 0.0)"))

    def select(self, c: Text, p: Text, q: Text) -> Text:
        return Text(("(", compare(c, ">", word("0.5")), " ? ", p, " : ", q, ")"))


class Sympy(Words):
    """Write Python text that makes sympy expressions, as surfaces.numbers.Symbols does."""

    language = "sympy"

    def const(self, value: Fraction) -> Text:
        if value.denominator == 1:
            whole = call("Integer", word(str(abs(value.numerator))))
        else:
            whole = call("Rational", word(str(abs(value.numerator))), word(str(value.denominator)))
        return negative(whole) if value < 0 else whole

    def e(self) -> Text:
        return word("E")

    def powi(self, a: Text, n: int) -> Text:
        return _raised(a, word(str(n)))

    def powr(self, a: Text, q: Fraction) -> Text:
        return _raised(a, self.const(q))

    def abs(self, a: Text) -> Text:
        return Text(("Abs(", a, ", evaluate=False)"))

    def min(self, a: Text, b: Text) -> Text:
        return Text(("Min(", a, ", ", b, ", evaluate=False)"))

    def max(self, a: Text, b: Text) -> Text:
        return Text(("Max(", a, ", ", b, ", evaluate=False)"))

    def below(self, a: Text, b: Text) -> Text:
        return Text(("Piecewise((1, ", compare(a, "<=", b), "), (0, True))"))

    def select(self, c: Text, p: Text, q: Text) -> Text:
        return Text(("Piecewise((", p, ", ", compare(c, ">", word("0")), "), (", q, ", True))"))


def _raised(a: Text, n: Text) -> Text:
    """Return a power as Python writes it."""
    base, _, exponent = power(a, n).parts
    return Text((base, "**", exponent), power(a, n).binding)


def written(tape: Tape, words: Words, name: Callable[[Text], Text] | None) -> Text:
    """Return a tape's first output as an expression.

    `name` gives a name to a value that is used more than once, and returns it; where it is None, such values are
    written out each time. Raises FirsthitError for an operation that the language does not have.
    """
    uses = Counter(i for op in tape.ops for i in op.inputs)
    values: list[Text] = []
    for index, op in enumerate(tape.ops):
        if op.name == "var":
            value = word(op.args[0])
        else:
            others = op.args[len(op.inputs) :]
            value = getattr(words, op.name)(*(values[i] for i in op.inputs), *others)
        if name is not None and uses[index] > 1 and op.name not in LEAVES:
            value = name(value)
        values.append(value)
    return values[tape.outputs[0]]


def titled(surface: Surface) -> list[str]:
    """Return what a comment says of a surface, line by line."""
    lines = [f"{surface.name}: {surface.title}", f"domain {domain_text(surface.domain)}", "written by firsthit"]
    return [one_line(line) for line in lines]
