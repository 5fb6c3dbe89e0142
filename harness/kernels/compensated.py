"""Generate a polynomial's value in compensated arithmetic, whose operations are glsl/tiles/compensated.glsl."""

from __future__ import annotations

import math
from fractions import Fraction

import surfaces
from harness.contract import FirsthitError, Language, Precision, Section, Surface
from harness.kernels.printing import function_text, nearest, number
from surfaces.lowering import real_tape
from surfaces.tape import Op

HEAD = "WidePair compensated_value(WidePairs o, wide t, WideVec3 d)"
_OPERATIONS = {"add": "wide_sum", "sub": "wide_difference", "mul": "wide_product", "sqr": "wide_square"}


def compensated_value(surface: Surface, precision: Precision, language: Language) -> Section:
    """Return f at o + t d of each lane: WidePair compensated_value(WidePairs o, wide t, WideVec3 d).

    Constants have the digits of two numbers of the precision. Raises FirsthitError where f is no polynomial.
    """
    tape = real_tape(surfaces.tape_of(surface))
    printer = _Printer(precision, language)
    points = [f"WidePair {axis} = wide_sum(o.{axis}, wide_two_prod(t, d.{axis}));" for axis in "xyz"]
    lines, value = printer.body(tape.ops, tape.outputs[0])
    text = function_text(HEAD, [*points, *lines], f"return {value};")
    return Section(f"generated: surface {surface.name}, compensated_value", text)


class _Printer:
    """Print operations on pairs as statements `WidePair NAME = …;`."""

    def __init__(self, precision: Precision, language: Language) -> None:
        self.precision, self.language = precision, language

    def body(self, ops: tuple[Op, ...], output: int) -> tuple[list[str], str]:
        """Return the statements, and the name of one of the values."""
        names: list[str] = []
        lines: list[str] = []
        known: list[Fraction | None] = []
        for op in ops:
            known.append(op.args[0] if op.name == "const" else None)
            if op.name == "var":
                names.append(op.args[0])
            elif op.name == "const":
                names.append(self.pair(op.args[0]))
            else:
                names.append(f"a{len(lines)}")
                text = self.operation(op.name, [names[i] for i in op.inputs], [known[i] for i in op.inputs])
                lines.append(f"WidePair {names[-1]} = {text};")
        return lines, names[output]

    def operation(self, name: str, args: list[str], known: list[Fraction | None]) -> str:
        """Return the text of an operation; `known` are the values of those arguments that are constants.

        Raises FirsthitError for an operation that a polynomial does not have.
        """
        if name == "neg":
            return f"wide_pair(-{args[0]}.hi, -{args[0]}.lo)"
        for value, other in zip(known, reversed(args), strict=True):
            if value is None or nearest(value, self.precision) != value:
                continue
            if name == "add":
                return f"wide_shifted({other}, {self.literal(value)})"
            if name == "sub" and other == args[0]:
                return f"wide_shifted({other}, {self.literal(-value)})"
            if name == "mul":
                power = math.frexp(value)[0] in (0.5, -0.5)
                return f"{'wide_doubled' if power else 'wide_scaled'}({other}, {self.literal(value)})"
        if name not in _OPERATIONS:
            raise FirsthitError(f"{name} has no compensated form: f must be a polynomial")
        return f"{_OPERATIONS[name]}({', '.join(args)})"

    def literal(self, value: Fraction) -> str:
        """Return the nearest number of the precision as a literal."""
        return number(nearest(value, self.precision), self.precision, self.language)

    def pair(self, value: Fraction) -> str:
        """Return a constant as the pair of the nearest number and of what that leaves."""
        rest = value - Fraction(float(nearest(value, self.precision)))
        return f"wide_pair(wide({self.literal(value)}), wide({self.literal(rest)}))"
