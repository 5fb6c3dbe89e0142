"""Write surface_range, f's interval extension, with what keeps jumps from looking like roots.

Over a box that a jump crosses, such as one at the border of two cells of mod(x, 1), an interval holds everything
between the values on both sides, 0 too, however small the box is. So where the box is crossed by one jump, f is bounded
again on either side alone: the jump takes its lower value everywhere, and then its upper one. f has a root in the box
only if one of these holds 0. A box that several jumps cross is not looked at again.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from harness.contract import Language, Precision
from harness.kernels.printing import IntervalPrinter, RealPrinter, function_text, operations_used
from surfaces.tape import Op, Tape

SIDED = frozenset({"floor", "below", "atan2"})  # operations that jump by themselves
_PARAMETERS = "Interval x, Interval y, Interval z"
_BY_SIDES = """
// Returns an interval that holds f in a box. If f jumps there from one sign to the other, and has no root on either
// side, it is that of one side.
Interval surface_range(Interval x, Interval y, Interval z) {
    Sided whole = range_of_side(x, y, z, 0);
    if (whole.open != 1 || without_zero(whole.range)) return whole.range;
    Interval p = range_of_side(x, y, z, 1).range;
    Interval q = range_of_side(x, y, z, 2).range;
    if (!without_zero(p) || !without_zero(q)) return whole.range;
    return (p.lo > 0.0) == (q.lo > 0.0) ? make_interval(min(p.lo, q.lo), max(p.hi, q.hi)) : p;
}"""


class SidedPrinter(IntervalPrinter):
    """Print a tape as IntervalPrinter does, with jumps that take the side `side`, and count the open ones in `open`."""

    def statement(self, name: str, op: Op, names: list[str], factors: Mapping[int, str | None]) -> str:
        text = super().statement(name, op, names, factors)
        if op.name not in SIDED:
            return text
        args = ", ".join(names[i] for i in op.args)
        return f"open += open_{op.name}({args}); Interval {name} = sided_{op.name}({args}, side);"


def range_operations(tape: Tape) -> int:
    """Return how many operations on intervals surface_range is made of: compilers copy what it calls for each side."""
    fixed = tape.constants()
    count = sum(op.name != "var" and not known for op, known in zip(tape.ops, fixed, strict=True))
    return 3 * count if SIDED & set(operations_used(tape)) else count


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
        lines = [f"{axis} = finite_or_whole({axis}.lo, {axis}.hi);" for axis in used] + lines
    else:
        limit = RealPrinter({}, precision, language).literal(Fraction(reach))
        lines = [
            "PRECISE real reach = " + " + ".join(f"fabs({axis}.{end})" for axis in used for end in ("lo", "hi")) + ";",
            *lines,
            f"Interval value = {value};",
            f"bool safe = reach <= {limit};",
        ]
        value = "make_interval(safe ? value.lo : -REAL_INFINITY, safe ? value.hi : REAL_INFINITY)"
    if not sided:
        return function_text(f"Interval surface_range({_PARAMETERS})", lines, f"return {value};")
    last = ["Sided sided;", f"sided.range = {value};", "sided.open = open;", "return sided;"]
    one = function_text(f"Sided range_of_side({_PARAMETERS}, int side)", ["int open = 0;", *lines], *last)
    return one + "\n" + _BY_SIDES
