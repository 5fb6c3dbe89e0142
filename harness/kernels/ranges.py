"""Write surface_range, f's interval extension, with what keeps jumps from looking like roots.

Over a box that a jump crosses, such as one at the border of two cells of mod(x, 1), an interval holds everything
between the values on both sides, 0 too, however small the box is. So where up to MOST_OPEN operations jump in a box,
from one value to another, f is bounded again for each way in which each of them may take one of its two values
everywhere. f has a root in the box only if one of these ranges holds 0. Where more jump, or one has more than two
values, f is not bounded again.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction

from harness.contract import Language, Precision
from harness.kernels.printing import IntervalPrinter, RealPrinter, function_text, operations_used
from surfaces.tape import Op, Tape

SIDED = frozenset({"floor", "below", "atan2"})  # operations that jump by themselves
PARAMETERS = "Interval x, Interval y, Interval z"
MOST_OPEN = 3
WITHIN_REACH = "make_interval(safe ? value.lo : -REAL_INFINITY, safe ? value.hi : REAL_INFINITY)"
_BY_SIDES = """
// Returns an interval that holds f in a box. If f jumps there from one sign to the other, and has no root on any side,
// it is that of one side. Bit k of `sides` says which value the jump number k takes; -1 stands for both values of all.
Interval surface_range(Interval x, Interval y, Interval z) {
    Sided whole = range_of_sides(x, y, z, -1);
    if (whole.open < 1 || whole.open > MOST_OPEN || without_zero(whole.range)) return whole.range;
    Interval first = whole.range;
    Interval all = whole.range;
    bool alike = true;
    int ways = 1 << whole.open;
    int tried = 0;
    for (int sides = 0; sides < ways; sides++) {
        Sided one = range_of_sides(x, y, z, sides);
        if (!without_zero(one.range) || one.open > whole.open) return whole.range;
        if (sides == 0) first = one.range;
        all = sides == 0 ? one.range : make_interval(min(all.lo, one.range.lo), max(all.hi, one.range.hi));
        alike = alike && (one.range.lo > 0.0) == (first.lo > 0.0);
        tried += 1;
    }
    if (tried < ways) return whole.range;
    return alike ? all : first;
}""".replace("MOST_OPEN", str(MOST_OPEN))


class SidedPrinter(IntervalPrinter):
    """Print a tape as IntervalPrinter does, with jumps that take the values that `sides` says, counted in `open`."""

    def statement(self, name: str, op: Op, names: list[str], factors: Mapping[int, str | None]) -> str:
        text = super().statement(name, op, names, factors)
        if op.name not in SIDED:
            return text
        args = ", ".join(names[i] for i in op.args)
        return f"Interval {name} = sided_{op.name}({args}, sides, open); open += open_{op.name}({args});"


def range_operations(tape: Tape) -> int:
    """Return how many operations on intervals surface_range is made of: compilers copy what it calls twice."""
    fixed = tape.constants()
    count = sum(op.name != "var" and not known for op, known in zip(tape.ops, fixed, strict=True))
    return 2 * count if SIDED & set(operations_used(tape)) else count


def guarded_inputs(used: Iterable[str]) -> list[str]:
    """Return the statements that make the whole line of inputs with an end that is not finite; `used` names them."""
    return [f"{axis} = finite_or_whole({axis}.lo, {axis}.hi);" for axis in used]


def reach_test(used: Iterable[str], reach: float, precision: Precision, language: Language) -> list[str]:
    """Return the statements that set `safe` where the inputs named in `used` are a box in which nothing overflows."""
    limit = RealPrinter({}, precision, language).literal(Fraction(reach))
    ends = " + ".join(f"fabs({axis}.{end})" for axis in used for end in ("lo", "hi"))
    return [f"PRECISE real reach = {ends};", f"bool safe = reach <= {limit};"]


def range_function(
    tape: Tape, parameters: Mapping[str, str], reach: float | None, precision: Precision, language: Language
) -> str:
    """Return the text of surface_range.

    `tape` is the formula as parsed; `parameters` gives the text of those of its variables that are no coordinates.
    `reach` is what harness.kernels.reach knows: None, or how large a box may be that nothing overflows in.
    """
    sided = bool(SIDED & set(operations_used(tape)))
    used = sorted({op.args[0] for op in tape.ops if op.name == "var"} - parameters.keys())
    intervals = {name: f"make_interval({value}, {value})" for name, value in parameters.items()}
    printer = (SidedPrinter if sided else IntervalPrinter)(
        {axis: axis for axis in "xyz"} | intervals, precision, language, reach is not None
    )
    lines, (value,) = printer.body(tape)
    if reach is None or not used:
        lines = guarded_inputs(used) + lines
    else:
        lines = [*reach_test(used, reach, precision, language), *lines, f"Interval value = {value};"]
        value = WITHIN_REACH
    if not sided:
        return function_text(f"Interval surface_range({PARAMETERS})", lines, f"return {value};")
    last = ["Sided sided;", f"sided.range = {value};", "sided.open = open;", "return sided;"]
    one = function_text(f"Sided range_of_sides({PARAMETERS}, int sides)", ["int open = 0;", *lines], *last)
    return one + "\n" + _BY_SIDES
