"""Print tapes as shader source: one statement per operation, in reals or in intervals.

Literals have every digit. A real constant is the nearest number of its precision; an interval constant has as its ends
the nearest numbers below and above.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction

import numpy as np

from harness.contract import FirsthitError, Precision
from harness.contract import Language as Language
from surfaces.lowering import enclosures
from surfaces.tape import UNARY, Op, Tape

_PI = Fraction(314159265358979323846264338327950288, 10**35)
_TYPES: dict[Precision, type[np.floating]] = {"float32": np.float32, "float64": np.float64}


def nearest(value: Fraction, precision: Precision) -> np.floating:
    """Return the nearest number of a precision, ties to even. Raises FirsthitError past the precision's range."""
    kind = _TYPES[precision]
    with np.errstate(over="ignore"):
        first = kind(value.numerator / value.denominator)
    if not np.isfinite(first):
        raise FirsthitError(f"the constant {float(value):.3g} is past the range of {precision}")
    # a float32 is rounded twice, and may be a neighbour of the nearest: take the nearest of three, or the even one
    near = (first, np.nextafter(first, kind(math.inf)), np.nextafter(first, kind(-math.inf)))
    return min(
        (n for n in near if np.isfinite(n)),
        key=lambda n: (abs(Fraction(float(n)) - value), (float(n) / float(np.spacing(n))) % 2),
    )


def bounds(lower: Fraction, upper: Fraction, precision: Precision) -> tuple[np.floating, np.floating]:
    """Return the largest number of a precision not above `lower`, and the smallest not below `upper`.

    Raises FirsthitError past the precision's range.
    """
    kind = _TYPES[precision]
    lo, hi = nearest(lower, precision), nearest(upper, precision)
    lo = lo if Fraction(float(lo)) <= lower else np.nextafter(lo, kind(-math.inf))
    hi = hi if Fraction(float(hi)) >= upper else np.nextafter(hi, kind(math.inf))
    return lo, hi


def number(value: np.floating, precision: Precision, language: Language) -> str:
    """Return a finite number as a literal of the precision, with the fewest digits that read back as that number."""
    text = np.format_float_scientific(value, unique=True, trim="0") if value else "0.0"
    if 1e-4 <= abs(value) < 1e9:
        text = np.format_float_positional(value, unique=True, trim="0")
    text += "f" if precision == "float32" else {"glsl": "lf", "cl": ""}[language]
    return f"({text})" if value < 0 else text


def table(name: str, values: Sequence[float], precision: Precision, language: Language) -> str:
    """Return the text of a constant array of reals, `TABLE real NAME[n]`, with every digit of its numbers.

    Raises FirsthitError if a number is past the range of the precision.
    """
    with np.errstate(over="ignore"):
        made = [_TYPES[precision](value) for value in values]
    if not np.isfinite(made).all():
        raise FirsthitError(f"its table {name} has a number past the range of {precision}; scale the formula down")
    numbers = ", ".join(number(value, precision, language) for value in made)
    size = len(values)
    body = f"real[{size}]({numbers})" if language == "glsl" else f"{{{numbers}}}"
    return f"TABLE real {name}[{size}] = {body};"


def function_text(head: str, lines: Sequence[str], *last: str) -> str:
    """Return a function's text: its head, and its statements indented."""
    return "\n".join([f"{head} {{", *(f"    {line}" for line in (*lines, *last)), "}"])


def _never_negative(tape: Tape) -> list[bool]:
    """Return for each operation whether its value in floats is not negative, whatever the variables are."""
    known: list[bool] = []
    for op in tape.ops:
        match op.name:
            case "const":
                known.append(op.args[0] >= 0)
            case "sqr" | "abs" | "sqrt" | "exp" | "powr" | "below":
                known.append(True)
            case "add" | "mul" | "div" | "min":
                known.append(all(known[i] for i in op.inputs))
            case "max":
                known.append(any(known[i] for i in op.inputs))
            case "select":
                known.append(known[op.inputs[1]] and known[op.inputs[2]])
            case _:
                known.append(False)
    return known


class RealPrinter:
    """Print a real tape as statements `real NAME = …;`. `variables` gives the text of each of the tape's variables."""

    def __init__(self, variables: Mapping[str, str], precision: Precision, language: Language) -> None:
        self.variables = variables
        self.precision = precision
        self.language = language
        self.fixed = [self.literal(value) for value in (Fraction(1), Fraction(1, 2), Fraction(0))]

    def literal(self, value: Fraction) -> str:
        """Return the nearest number of the precision as a literal."""
        return number(nearest(value, self.precision), self.precision, self.language)

    def body(self, tape: Tape) -> tuple[list[str], list[str]]:
        """Return the statements, and the tape's outputs as names or literals."""
        names: list[str] = []
        lines: list[str] = []
        safe = _never_negative(tape)
        for op in tape.ops:
            if op.name == "var":
                names.append(self.variables[op.args[0]])
            elif op.name == "const":
                names.append(self.literal(op.args[0]))
            elif op.name == "sqrt" and not safe[op.args[0]]:  # rounding may take it under 0, also that of a ray's point
                names.append(f"a{len(lines)}")
                lines.append(f"real {names[-1]} = sqrt(max({names[op.args[0]]}, {self.fixed[2]}));")
            else:
                names.append(f"a{len(lines)}")
                args = [names[i] for i in op.inputs] + [self.literal(q) for q in op.args[len(op.inputs) :]]
                lines.append(f"real {names[-1]} = {self.operation(op, args)};")
        return lines, [names[i] for i in tape.outputs]

    def operation(self, op: Op, args: list[str]) -> str:
        """Return the text of one operation on arguments that are names or literals."""
        one, half, zero = self.fixed
        match op.name, args:
            case "add", (a, b):
                return f"{a} + {b}"
            case "sub", (a, b):
                return f"{a} - {b}"
            case "mul", (a, b):
                return f"{a} * {b}"
            case "div", (a, b):
                return f"{a} / {b}"
            case "neg", (a,):
                return f"-{a}"
            case "sqr", (a,):
                return f"{a} * {a}"
            case "abs", (a,):
                return f"fabs({a})"
            case "sign", (a,):
                return f"{a} < {zero} ? -{one} : {one}"
            case "below", (a, b):
                return f"{a} <= {b} ? {one} : {zero}"
            case "select", (c, p, q):
                return f"{c} > {half} ? {p} : {q}"
            case "powr", (a, q):  # GLSL leaves open what pow is of a number under 0, where rounding may take a
                return f"{a} > {zero} ? pow({a}, {q}) : {zero}"
            case "atan2", (a, b):  # C has other angles for -0, and GLSL has none for the point (0, 0)
                angle = f"{'atan' if self.language == 'glsl' else 'atan2'}({a}, {b})"
                return f"{a} == {zero} ? ({b} < {zero} ? {self.literal(_PI)} : {zero}) : {angle}"
        return f"{op.name}({', '.join(args)})"


BOUNDED = frozenset({"add", "sub", "mul", "scale", "sqr", "powi"})  # operations with a form that ignores overflow


class IntervalPrinter:
    """Print a parsed tape, with exact constants and whole powers, as statements `Interval NAME = …;`.

    `variables` gives the text of each of the tape's variables. If `bounded`, nothing in it can overflow, and operations
    do not look for that.
    """

    def __init__(
        self, variables: Mapping[str, str], precision: Precision, language: Language, bounded: bool = False
    ) -> None:
        self.variables = variables
        self.precision = precision
        self.language = language
        self.bounded = bounded

    def _constant(self, lower: Fraction, upper: Fraction) -> tuple[str, str]:
        """Return the two ends of an interval that holds a constant, as literals."""
        lo, hi = (number(n, self.precision, self.language) for n in bounds(lower, upper, self.precision))
        return lo, hi

    def _factor(self, lower: Fraction, upper: Fraction) -> str | None:
        """Return a constant as arguments of interval_scale, or None if its relative error may be too large.

        They are the nearest number, a place for the other factor, and 1 if the number is exact or 2 if it is rounded.
        """
        lo, hi = bounds(lower, upper, self.precision)
        if lo != hi and not abs(lo) > 2 * np.finfo(_TYPES[self.precision]).tiny:
            return None
        return f"{number(nearest(lower, self.precision), self.precision, self.language)}, {{}}, {1 + (lo != hi)}.0"

    def body(self, tape: Tape) -> tuple[list[str], list[str]]:
        """Return the statements, and the tape's outputs as names or expressions."""
        constants = {i: self._constant(*ends) for i, ends in enclosures(tape).items()}
        factors = {i: self._factor(*ends) for i, ends in enclosures(tape).items()}
        names: list[str] = []
        lines: list[str] = []
        for index, op in enumerate(tape.ops):
            if index in constants:
                lo, hi = constants[index]
                names.append(f"make_interval({lo}, {hi})")
            elif op.name == "var":
                names.append(self.variables[op.args[0]])
            else:
                names.append(f"a{len(lines)}")
                lines.append(self.statement(names[-1], op, names, factors))
        return lines, [names[i] for i in tape.outputs]

    def statement(self, name: str, op: Op, names: list[str], factors: Mapping[int, str | None]) -> str:
        """Return the statement that computes one operation under a name."""
        return f"Interval {name} = {self.operation(op, names, factors)};"

    def operation(self, op: Op, names: list[str], factors: Mapping[int, str | None]) -> str:
        """Return the text of one operation; `factors` holds the constants that interval_scale can take."""
        if op.name == "powi":
            return f"{self._kind('powi')}_powi({names[op.args[0]]}, {op.args[1]})"
        if op.name == "powr":
            q = nearest(op.args[1], self.precision)
            return f"interval_powr({names[op.args[0]]}, {number(q, self.precision, self.language)})"
        for i, j in (op.args, reversed(op.args)) if op.name == "mul" else ():
            if factor := factors.get(i):
                return f"{self._kind('scale')}_scale({factor.format(names[j])})"
        return f"{self._kind(op.name)}_{op.name}({', '.join(names[i] for i in op.args)})"

    def _kind(self, name: str) -> str:
        """Return the prefix of an operation's name: bounded, or interval."""
        return "bounded" if self.bounded and name in BOUNDED else "interval"


FUNCTIONS = frozenset({*UNARY, "powr", "atan2"})  # operations that call a function of the language


def functions_used(tape: Tape) -> list[str]:
    """Return the functions beyond arithmetic that a tape calls of its variables, sorted by name."""
    return [name for name in operations_used(tape) if name in FUNCTIONS]


def operations_used(tape: Tape) -> list[str]:
    """Return the operations of a tape that depend on its variables, sorted by name."""
    constant = tape.constants()
    return sorted({op.name for op, fixed in zip(tape.ops, constant, strict=True) if not fixed and op.name != "var"})
