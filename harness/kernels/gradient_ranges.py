"""Write surface_gradient_range: intervals that hold f and its three derivatives over a box.

Derivatives are found operation by operation, forward, in intervals that are widened as those of surface_range are. A
derivative that is 0 everywhere is not computed. At a kink (abs, min, max) the interval holds the derivatives of both
sides and all numbers between them, so that the mean value theorem holds across it. The root of a sum of squares is a
length: it changes no faster than what is squared, and has a kink where it is 0.

No derivative is known over a box where f may jump, and where a root, a power, a logarithm or an angle may have a
derivative that is too large. Then `known` is false, and the derivatives are the whole line.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

from harness.contract import Language, Precision
from harness.kernels.printing import IntervalPrinter, function_text, nearest, number, operations_used
from harness.kernels.ranges import PARAMETERS, SIDED, WITHIN_REACH, guarded_inputs, reach_test
from harness.kernels.reach import LARGEST, sizes_within
from surfaces.lowering import enclosures
from surfaces.tape import LEAVES, Op, Tape

AXES = ("x", "y", "z")
_HEAD = f"GradientRange surface_gradient_range({PARAMETERS})"
_LARGEST_SLOPE = 2.0**20  # of an operation whose derivative is found by a division, see LEAST_DIVISOR


@dataclass(frozen=True)
class Slope:
    """Hold a derivative.

    text: a name or an expression
    size: a bound of its magnitude over every box that is within reach
    fixed: its value, where it is the same rational number everywhere
    """

    text: str
    size: float
    fixed: Fraction | None = None


Slopes = dict[str, Slope]  # by axis; a derivative that is 0 everywhere is left out


class GradientPrinter(IntervalPrinter):
    """Print a tape as IntervalPrinter does, and behind each operation the statements of its derivatives.

    `sizes` bounds the magnitude of each operation's value. After `gradient`, `largest` bounds every derivative met,
    `count` is how many operations on intervals the derivatives take, and `conditions` says where they are known.
    """

    def __init__(
        self,
        variables: Mapping[str, str],
        precision: Precision,
        language: Language,
        sizes: list[float] | None,
        bounded: bool,
    ) -> None:
        super().__init__(variables, precision, language, sizes is not None)
        self.sizes = sizes
        self.slopes_bounded = bounded
        self.largest = 0.0
        self.count = 0
        self.conditions: list[str] = []
        self.lines: list[str] = []
        self.names: list[str] = []
        self.rational: dict[int, Fraction] = {}
        self._waves: dict[tuple[str, int], str] = {}

    def gradient(self, tape: Tape) -> tuple[list[str], str, Slopes]:
        """Return the statements, the value's name, and the derivatives of the tape's one output."""
        known = enclosures(tape)
        constants = {i: self._constant(*ends) for i, ends in known.items()}
        factors = {i: self._factor(*ends) for i, ends in known.items()}
        self.rational = {i: lo for i, (lo, hi) in known.items() if lo == hi}
        found: list[Slopes] = []
        for index, op in enumerate(tape.ops):
            slopes: Slopes = {}
            if index in constants:
                self.names.append("make_interval({}, {})".format(*constants[index]))
            elif op.name == "var":
                self.names.append(self.variables[op.args[0]])
                slopes = {op.args[0]: self._fixed(Fraction(1))} if op.args[0] in AXES else {}
            else:
                name = f"a{index}"
                self.lines.append(self.statement(name, op, self.names, factors))
                self.names.append(name)
                if op.name in ("sin", "cos"):
                    self._waves[op.name, op.args[0]] = name
                moving = [found[i] for i in op.inputs]
                slopes = dict(self._slopes(index, op, tape, found, moving, factors)) if any(moving) else {}
                self._jump(op)
            found.append(slopes)
            self.largest = max([self.largest, *(slope.size for slope in slopes.values())])
        return self.lines, self.names[tape.outputs[0]], found[tape.outputs[0]]

    def ends(self, value: Fraction | int) -> str:
        """Return an interval that holds a rational number."""
        return "make_interval({}, {})".format(*self._constant(Fraction(value), Fraction(value)))

    def _size(self, index: int) -> float:
        return self.sizes[index] if self.sizes else math.inf

    def _call(self, name: str, *args: str) -> str:
        """Return a call of an operation on intervals, one that looks for overflow unless it is proved that none is."""
        self.count += 1
        return f"{'bounded' if self.slopes_bounded else 'interval'}_{name}({', '.join(args)})"

    def _fixed(self, value: Fraction) -> Slope:
        """Return a derivative that is a rational number."""
        return Slope(self.ends(value), 1.01 * abs(float(value)), value)

    def _times(self, index: int, slope: Slope) -> Slope:
        """Return a derivative times an operation's value."""
        if slope.fixed is not None:
            return self._scaled(slope.fixed, Slope(self.names[index], self._size(index)))
        return Slope(self._call("mul", self.names[index], slope.text), self._size(index) * slope.size)

    def _scaled(self, factor: Fraction | int, slope: Slope) -> Slope:
        """Return a derivative times a rational number."""
        if slope.fixed is not None:
            return self._fixed(factor * slope.fixed)
        if factor == 1:
            return slope
        value = nearest(Fraction(factor), self.precision)
        exact = Fraction(float(value)) == factor
        text = self._call("scale", number(value, self.precision, self.language), slope.text, "1.0" if exact else "2.0")
        return Slope(text, 1.01 * abs(float(factor)) * slope.size)

    def _sum(self, slopes: list[Slope], minus: bool = False) -> Slope:
        """Return the sum of one derivative or two, or their difference; `minus` negates one that is alone."""
        fixed = [slope.fixed for slope in slopes if slope.fixed is not None]
        if len(fixed) == len(slopes):
            return self._fixed((fixed[0] if len(fixed) == 2 else 0) + fixed[-1] * (-1 if minus else 1))
        if len(slopes) == 2:
            return Slope(
                self._call("sub" if minus else "add", slopes[0].text, slopes[1].text), slopes[0].size + slopes[1].size
            )
        return Slope(f"interval_neg({slopes[0].text})", slopes[0].size) if minus else slopes[0]

    def _named(self, index: int, suffix: str, slope: Slope) -> Slope:
        """Give a derivative's text a name, unless it is one or a number."""
        if "(" not in slope.text or slope.fixed is not None:
            return slope
        name = f"a{index}{suffix}"
        self.lines.append(f"Interval {name} = {slope.text};")
        return Slope(name, 1.01 * slope.size)

    def _known(self, condition: str) -> None:
        """State a condition without which no derivative is known."""
        if condition not in self.conditions:
            self.conditions.append(condition)

    def _jump(self, op: Op) -> None:
        """State where an operation does not jump."""
        args = [self.names[i] for i in op.inputs]
        match op.name:
            case "floor":
                self._known(f"floor({args[0]}.lo) == floor({args[0]}.hi)")
            case "below":
                self._known(f"({args[0]}.hi <= {args[1]}.lo || {args[0]}.lo > {args[1]}.hi)")
            case "sign":
                self._known(f"({args[0]}.lo >= 0.0 || {args[0]}.hi < 0.0)")
            case "atan2":
                self._known(f"off_the_cut({args[0]}, {args[1]})")

    def _slopes(
        self,
        index: int,
        op: Op,
        tape: Tape,
        found: list[Slopes],
        moving: list[Slopes],
        factors: Mapping[int, str | None],
    ) -> Iterator[tuple[str, Slope]]:
        """Yield the derivatives of an operation by each axis that it depends on, each with a name of its own."""
        if op.name in ("floor", "below", "sign"):
            return
        parts = _squared(tape, op.args[0]) if op.name == "sqrt" else None
        if parts is not None:
            yield from self._length(index, parts, found)
            return
        common = self._common(index, op)
        for axis in AXES:
            if any(axis in slopes for slopes in moving):
                slopes = [slopes.get(axis) for slopes in moving]
                yield axis, self._named(index, axis, self._slope(index, op, common, slopes, factors))

    def _length(self, index: int, parts: list[int], found: list[Slopes]) -> Iterator[tuple[str, Slope]]:
        """Yield the derivatives of a root of a sum of squares."""
        terms: dict[str, Slope] = {}
        for k, part in enumerate(parts):
            if not found[part]:
                continue
            share = f"a{index}s{k}"
            self.count += 1
            self.lines.append(f"Interval {share} = share_of_length({self.names[part]}, {self.names[index]});")
            for axis, slope in found[part].items():
                term = (
                    Slope(share, 1.0) if slope.fixed == 1 else Slope(self._call("mul", share, slope.text), slope.size)
                )
                terms[axis] = self._sum([terms[axis], term]) if axis in terms else term
        for axis, term in terms.items():
            yield axis, self._named(index, axis, term)

    def _common(self, index: int, op: Op) -> Slope:
        """Return what the derivative of an operation is a multiple of, by whichever axis; it gets a name."""
        a = self.names[op.args[0]]
        value = self.names[index]
        match op.name:
            case "sqrt":
                self._known(f"divides({value})")
                slope = Slope(f"known_quotient({self.ends(Fraction(1, 2))}, {value})", _LARGEST_SLOPE)
            case "log":
                self._known(f"divides({a})")
                slope = Slope(f"known_quotient({self.ends(1)}, {a})", _LARGEST_SLOPE)
            case "exp":
                return Slope(value, self._size(index))
            case "sin" | "cos":
                other = "cos" if op.name == "sin" else "sin"
                slope = Slope(self._waves.get((other, op.args[0])) or f"interval_{other}({a})", 1.0)
            case "tan":
                slope = Slope(self._call("add", self.ends(1), self._call("sqr", value)), math.inf)
            case "powi":
                power = Slope(
                    self._call("powi", a, str(op.args[1] - 1)), _raised(self._size(op.args[0]), op.args[1] - 1)
                )
                slope = self._scaled(op.args[1], power)
            case "powr":
                slope = self._power(index, op)
            case "atan2":
                b = self.names[op.args[1]]
                square = self._call("add", self._call("sqr", a), self._call("sqr", b))
                slope = Slope(square, self._size(op.args[0]) ** 2 + self._size(op.args[1]) ** 2)
                self._known(f"divides(a{index}c)")
            case "min" | "max":
                self.lines.append(f"int a{index}c = order_of({a}, {self.names[op.args[1]]});")
                return Slope(f"a{index}c", 1.0)
            case _:
                return Slope("", 1.0)
        self.count += 1
        return self._named(index, "c", slope)

    def _power(self, index: int, op: Op) -> Slope:
        """Return q a^(q - 1), the derivative of a^q."""
        base, exponent = op.args
        a = self.names[base]
        if exponent > 1:
            self._known(f"has_powers({a})")
            less = number(nearest(exponent - 1, self.precision), self.precision, self.language)
            size = 1.01 * _raised(max(self._size(base), 1.0), float(exponent - 1))
            return self._scaled(exponent, Slope(f"interval_powr({a}, {less})", size))
        self._known(f"divides({a})")
        quotient = Slope(f"known_quotient({self.names[index]}, {a})", _LARGEST_SLOPE * self._size(index))
        return self._scaled(exponent, quotient)

    def _slope(
        self, index: int, op: Op, common: Slope, slopes: list[Slope | None], factors: Mapping[int, str | None]
    ) -> Slope:
        """Return an operation's derivative by one axis; `slopes` are those of its inputs, None where they are 0."""
        moving = [slope for slope in slopes if slope is not None]
        zero = self.ends(0)
        texts = [slope.text if slope else zero for slope in slopes]
        largest = max(slope.size for slope in moving)
        match op.name:
            case "add":
                return self._sum(moving)
            case "sub":
                return self._sum(moving, minus=slopes[1] is not None)
            case "neg":
                return self._sum(moving, minus=True)
            case "mul":
                return self._product(op, slopes, factors)
            case "div":
                return self._quotient(index, op, slopes)
            case "sqr":
                return self._scaled(2, self._times(op.args[0], moving[0]))
            case "abs":
                return Slope(f"slope_of_abs({self.names[op.args[0]]}, {texts[0]})", largest)
            case "min":
                return Slope(f"slope_of_lesser({common.text}, {texts[0]}, {texts[1]})", largest)
            case "max":
                return Slope(f"slope_of_lesser({common.text}, {texts[1]}, {texts[0]})", largest)
            case "select":
                return Slope(f"slope_of_select({self.names[op.args[0]]}, {texts[1]}, {texts[2]})", largest)
            case "atan2":
                across = [
                    self._times(i, slope) for i, slope in zip(op.args[::-1], slopes, strict=True) if slope is not None
                ]
                turned = self._sum(across, minus=slopes[1] is not None)
                return Slope(f"known_quotient({turned.text}, {common.text})", _LARGEST_SLOPE * turned.size)
        if (fixed := moving[0].fixed) is not None:
            slope = self._scaled(fixed, common)
        else:
            slope = Slope(self._call("mul", common.text, moving[0].text), common.size * moving[0].size)
        return self._sum([slope], minus=op.name == "cos")

    def _product(self, op: Op, slopes: list[Slope | None], factors: Mapping[int, str | None]) -> Slope:
        """Return the derivative of a product, one of whose factors may be a constant."""
        terms = []
        for slope, other in zip(slopes, op.args[::-1], strict=True):
            if slope is None:
                continue
            factor = factors.get(other)
            if (value := self.rational.get(other)) is not None:
                terms.append(self._scaled(value, slope))
            elif factor is None:
                terms.append(self._times(other, slope))
            else:
                self.count += 1
                kind = "bounded" if self.slopes_bounded else "interval"
                terms.append(Slope(f"{kind}_scale({factor.format(slope.text)})", self._size(other) * slope.size))
        return self._sum(terms)

    def _quotient(self, index: int, op: Op, slopes: list[Slope | None]) -> Slope:
        """Return the derivative of a quotient: that of the dividend, less the quotient times the divisor's, divided."""
        above, below = slopes
        terms = [slope for slope in (above, self._times(index, below) if below else None) if slope is not None]
        whole = self._sum(terms, minus=below is not None)
        self.count += 1
        return Slope(f"interval_div({whole.text}, {self.names[op.args[1]]})", math.inf)


def _raised(size: float, power: float) -> float:
    """Return a power of a bound, infinity where that is past the range of floats."""
    try:
        return float(size**power)
    except OverflowError:
        return math.inf


def _squared(tape: Tape, index: int) -> list[int] | None:
    """Return the operations whose squares add up to an operation, beside constants that are not negative, else None."""
    op = tape.ops[index]
    if op.name == "const" and op.args[0] >= 0:
        return []
    if op.name == "sqr":
        return [op.args[0]]
    if op.name != "add":
        return None
    first, second = (_squared(tape, i) for i in op.args)
    return None if first is None or second is None else [*first, *second]


def gradient_function(
    tape: Tape, parameters: Mapping[str, str], reach: float | None, precision: Precision, language: Language
) -> tuple[str, int]:
    """Return the text of surface_gradient_range, and how many operations on intervals it is made of.

    The arguments are those of harness.kernels.ranges.range_function.
    """
    variables = {axis: axis for axis in AXES} | {
        name: f"make_interval({value}, {value})" for name, value in parameters.items()
    }
    sizes = None if reach is None else sizes_within(tape, reach)
    printer = GradientPrinter(variables, precision, language, sizes, sizes is not None)
    lines, value, slopes = printer.gradient(tape)
    if sizes is not None and not printer.largest < LARGEST[precision]:
        printer = GradientPrinter(variables, precision, language, sizes, False)
        lines, value, slopes = printer.gradient(tape)
    used = sorted({op.args[0] for op in tape.ops if op.name == "var"} & set(AXES))
    count = printer.count + sum(op.name not in LEAVES for op in tape.ops)
    conditions = list(printer.conditions)
    if reach is None or not used:
        lines = [*guarded_inputs(used), *lines]
    else:
        lines = [*reach_test(used, reach, precision, language), *lines]
        conditions.insert(0, "safe")
    if SIDED & set(operations_used(tape)):
        value = "surface_range(x, y, z)"
    elif reach is not None and used:
        lines.append(f"Interval value = {value};")
        value = WITHIN_REACH
    zero = printer.ends(0)
    lines += ["GradientRange result;", f"result.value = {value};"]
    lines += [f"result.{axis} = {slopes[axis].text if axis in slopes else zero};" for axis in AXES]
    lines.append(f"bool known = {' && '.join(conditions) or 'true'};")
    if not printer.slopes_bounded:
        sizes_text = " + ".join(f"interval_magnitude(result.{axis})" for axis in slopes) or "0.0"
        lines += [f"PRECISE real size = {sizes_text};", "known = known && size < REAL_INFINITY;"]
    lines += ["result.known = known;"]
    lines += [
        f"result.{axis} = make_interval(known ? result.{axis}.lo : -REAL_INFINITY,"
        f" known ? result.{axis}.hi : REAL_INFINITY);"
        for axis in AXES
    ]
    return function_text(_HEAD, lines, "return result;"), count
