"""Count the arithmetic operations of one evaluation: those of the generated function that a method evaluates.

Additions, multiplications, divisions, minima, maxima, roots and functions count as one each. Signs, comparisons and
constants are free. What a method computes beside its evaluations is not counted.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from harness.contract import Surface

POINT = 6  # of origin + t direction
FREE = frozenset({"neg", "abs", "sign", "below", "select"})
WIDENED = 6  # of widened_by_rounding in interval.glsl
OUTWARD = WIDENED + 1  # of outward: also the check that the ends are finite
INTERVAL = {
    **dict.fromkeys(("add", "sub", "scale"), 2 + OUTWARD),
    "neg": 0,
    "mul": 10 + OUTWARD,
    "sqr": 5 + OUTWARD,
    "div": 13 + OUTWARD,
    "sqrt": 4 + OUTWARD,
    "log": 4 + OUTWARD,
    "exp": 8 + OUTWARD,
    **dict.fromkeys(("min", "max"), 3),
    "abs": 4,
    **dict.fromkeys(("sin", "cos"), 138),
    "tan": 2 * 138 + 13 + OUTWARD,
    "powr": 17 + 2 * OUTWARD,
    "floor": 2 + 3,  # the 3 of open_floor
    "below": 0,
    "sign": 0,
    "select": 2,
    "atan2": 7 + 2 * 59 + WIDENED + 2,  # two corners; the 2 of open_atan2
}
SLOPES = {  # of interval_slopes.glsl
    **dict.fromkeys(("interval_hull", "slope_of_lesser", "slope_of_abs", "slope_of_select"), 2),
    **dict.fromkeys(("order_of", "divides", "has_powers", "off_the_cut"), 0),
    "share_of_length": INTERVAL["div"] + 4,
    "known_quotient": INTERVAL["div"],
    "interval_magnitude": 1,
    "finite_or_whole": 1,
}
AFFINE = 10 + WIDENED  # of bounded_affine: one coordinate of a piece of a ray


def _value(surface: Surface) -> int:
    """Count the operations of surface_value, without those of the point."""
    from surfaces import tape_of
    from surfaces.lowering import counts, real_tape

    return _sum(counts(real_tape(tape_of(surface))))


def _sum(counted: dict[str, int]) -> int:
    """Sum up counts, without those of free operations."""
    return sum(count for name, count in counted.items() if name not in FREE)


def _value_along(surface: Surface) -> int:
    """Count the operations of surface_value_along."""
    from harness.kernels.functions import expands

    return 2 * (surface.degree or 0) if expands(surface) else POINT + _value(surface)


def _dual_along(surface: Surface) -> int:
    """Count the operations of surface_dual_along."""
    from harness.kernels.functions import expands
    from surfaces import tape_of
    from surfaces.lowering import counts, real_tape, tangent

    if expands(surface):
        return 4 * (surface.degree or 0) - 2
    return POINT + _sum(counts(tangent(real_tape(tape_of(surface)), {axis: f"d{axis}" for axis in "xyz"})))


def _distance(surface: Surface) -> int:
    """Count the operations of surface_distance."""
    from surfaces.formula import parse
    from surfaces.lowering import counts, real_tape

    assert surface.distance
    return POINT + _sum(counts(real_tape(parse(surface.distance, dict(surface.parameters)))))


def _range(surface: Surface) -> int:
    """Count the operations of surface_range."""
    from harness.kernels.printing import BOUNDED
    from harness.kernels.reach import safe_reach
    from surfaces import tape_of
    from surfaces.lowering import enclosures

    tape = tape_of(surface)
    constants = enclosures(tape)
    bounded = safe_reach(surface, "float32") is not None
    ends = 2 * sum(op.name == "var" for op in tape.ops)
    total = max(0, ends - 1) if bounded else ends // 2
    for index, op in enumerate(tape.ops):
        if index in constants or op.name == "var":
            continue
        if op.name == "powi":
            total += _interval_power(op.args[1])
        else:
            total += INTERVAL["scale" if op.name == "mul" and constants.keys() & set(op.inputs) else op.name]
        total -= bounded and op.name in BOUNDED  # the check that it is finite
    return total


def _gradient_range(surface: Surface) -> int:
    """Count the operations of surface_gradient_range: those that its text names, and those of what it calls."""
    from harness.kernels.gradient_ranges import gradient_function
    from harness.kernels.reach import safe_reach
    from surfaces import tape_of

    reach = safe_reach(surface, "float32")
    text, _ = gradient_function(tape_of(surface), {}, reach, "float32", "cl")
    called = {f"interval_{name}": count for name, count in INTERVAL.items()} | SLOPES
    called |= {f"bounded_{name}": count - 1 for name, count in INTERVAL.items()}  # less the check that it is finite
    called |= {"surface_range": _range(surface), "interval_floor": 2, "floor": 1}
    total = len(re.findall(r" [-+*/] ", text)) + sum(called.get(name, 0) for name in re.findall(r"\b(\w+)\(", text))
    powers = re.findall(r"\b(bounded|interval)_powi\(\w+, (\d+)\)", text)
    return total + sum(_interval_power(int(n)) - int(kind == "bounded") for kind, n in powers)


def _interval_power(n: int) -> int:
    """Count the operations of interval_powi: both ends by squaring, and for an even n the least and greatest |a|."""
    return 2 * (n.bit_length() + n.bit_count()) + (0 if n % 2 else 3) + OUTWARD


_COSTS: dict[str, Callable[[Surface], int]] = {
    "surface_dual_along": _dual_along,
    "surface_range_along": lambda surface: 3 * AFFINE + _range(surface),
    "surface_gradient_range": _gradient_range,
    "surface_range": _range,
    "surface_distance": _distance,
    "surface_value_along": _value_along,
    "surface_value": lambda surface: POINT + _value(surface),
    "surface_coefficients_along": lambda surface: 2 * (surface.degree or 0),
}


def operations_per_evaluation(surface: Surface, needs: Sequence[str]) -> int | None:
    """Count the operations of one evaluation by a method that needs these functions.

    The evaluation is by the first function of _COSTS among `needs`. A method that needs only the exact coefficients
    along the ray evaluates the polynomial by Horner's rule.

    None if it evaluates nothing, and if it evaluates surface_gradient_range beside other functions. It counts all
    evaluations alike, and those cost many times as much as that of a point, so that no number holds for all.
    """
    own = [name for name in _COSTS if name in needs]
    if not own or ("surface_gradient_range" in own and len(own) > 1):
        return None
    return _COSTS[own[0]](surface)
