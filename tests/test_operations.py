"""Every place that computes or writes the operations of a tape has all of them: an example of each is run in each."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import flint
import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, Surface, TruthStatus
from harness.kernels.assemble import method_program
from harness.oracle import first_hits
from harness.oracle.noise import RunningErrors
from harness.oracle.program import compile_tape
from harness.oracle.reals import FUNCTIONS, leaf
from harness.plugins import find_methods
from surfaces import files, formula, lowering
from surfaces.evaluation import Floats
from surfaces.numbers import Balls, Symbols
from surfaces.proofs.ranges import outputs
from surfaces.proofs.signs import ranges_of
from surfaces.proofs.slopes import Slopes
from surfaces.tape import JUMPS, Builder, Tape, walk

# what an operation is on three numbers, in a tape and in Python; select takes the second, since 0.3 < 0.6
EXAMPLES: dict[str, tuple[Callable[..., int], Callable[[float, float, float], float]]] = {
    "const": (lambda b, x, _, __: b.add(x, b.const(Fraction(1, 3))), lambda x, _, __: x + 1 / 3),
    "pi": (lambda b, x, _, __: b.mul(x, b.pi()), lambda x, _, __: x * math.pi),
    "e": (lambda b, x, _, __: b.mul(x, b.e()), lambda x, _, __: x * math.e),
    "neg": (lambda b, x, _, __: b.neg(x), lambda x, _, __: -x),
    "sqr": (lambda b, x, _, __: b.sqr(x), lambda x, _, __: x * x),
    "abs": (lambda b, x, _, __: b.abs(x), lambda x, _, __: abs(x)),
    "sqrt": (lambda b, x, _, __: b.sqrt(x), lambda x, _, __: math.sqrt(x)),
    "exp": (lambda b, x, _, __: b.exp(x), lambda x, _, __: math.exp(x)),
    "log": (lambda b, x, _, __: b.log(x), lambda x, _, __: math.log(x)),
    "sin": (lambda b, x, _, __: b.sin(x), lambda x, _, __: math.sin(x)),
    "cos": (lambda b, x, _, __: b.cos(x), lambda x, _, __: math.cos(x)),
    "tan": (lambda b, x, _, __: b.tan(x), lambda x, _, __: math.tan(x)),
    "floor": (lambda b, x, _, __: b.floor(x), lambda x, _, __: math.floor(x)),
    "powi": (lambda b, x, _, __: b.powi(x, 3), lambda x, _, __: x**3),
    "powr": (lambda b, x, _, __: b.powr(x, Fraction(7, 3)), lambda x, _, __: x ** (7 / 3)),
    "add": (lambda b, x, y, _: b.add(x, y), lambda x, y, _: x + y),
    "sub": (lambda b, x, y, _: b.sub(x, y), lambda x, y, _: x - y),
    "mul": (lambda b, x, y, _: b.mul(x, y), lambda x, y, _: x * y),
    "div": (lambda b, x, y, _: b.div(x, y), lambda x, y, _: x / y),
    "min": (lambda b, x, y, _: b.min(x, y), lambda x, y, _: min(x, y)),
    "max": (lambda b, x, y, _: b.max(x, y), lambda x, y, _: max(x, y)),
    "atan2": (lambda b, x, y, _: b.atan2(x, y), lambda x, y, _: math.atan2(x, y)),
    "below": (lambda b, x, y, _: b.add(x, b.below(x, y)), lambda x, y, _: x + (x <= y)),
    "select": (lambda b, x, y, z: b.select(b.below(x, y), y, z), lambda x, y, z: y if x <= y else z),
    "sign": (lambda b, x, _, __: b.sign(x), lambda x, _, __: math.copysign(1, x)),
}
INTERNAL = {"sign"}  # the language has no word for it; only derivatives use it
POINT = (0.6, 0.3, 0.8)
NOT_OPERATIONS = {"tape", "is_constant", "value", "emit", "var"}

each = pytest.mark.parametrize("name", EXAMPLES)
each_written = pytest.mark.parametrize("name", [name for name in EXAMPLES if name not in INTERNAL])


def tape_for(name: str) -> Tape:
    builder = Builder()
    return builder.tape(EXAMPLES[name][0](builder, *map(builder.var, "xyz")))


def value_of(name: str) -> float:
    return float(EXAMPLES[name][1](*POINT))


def surface_of(name: str) -> Surface:
    """A surface that uses the operation, where all of them have values."""
    builder = Builder()
    tape = builder.tape(
        builder.sub(EXAMPLES[name][0](builder, *map(builder.var, "xyz")), builder.const(Fraction(1, 4)))
    )
    return surfaces.from_formula(formula.canonical(tape), "box:0.1,0.1,0.1:1,1,1")


def slopes_of(name: str) -> list[float]:
    """The derivatives at POINT, by differences."""
    step, found = 1e-6, []
    for axis in np.eye(3):
        ahead, behind = (EXAMPLES[name][1](*(POINT + sign * step * axis)) for sign in (1, -1))
        found.append((ahead - behind) / (2 * step))
    return found


def holds(ball: Any, value: float) -> bool:
    """Whether a ball holds a value that is known to 15 digits, and little else."""
    return bool(abs(ball - value) < 1e-12)


def test_every_operation_has_an_example() -> None:
    assert {name for name in vars(Builder) if not name.startswith("_")} - NOT_OPERATIONS == EXAMPLES.keys()
    for name in EXAMPLES:
        assert name in {op.name for op in tape_for(name).ops}


@each
def test_number_systems(name: str) -> None:
    tape, value = tape_for(name), value_of(name)
    for numbers in (tape, lowering.real_tape(tape)):
        assert walk(numbers, Floats(), dict(zip("xyz", POINT, strict=True)))[0] == pytest.approx(value, rel=1e-14)
    balls = {axis: flint.arb(at) for axis, at in zip("xyz", POINT, strict=True)}
    assert holds(walk(tape, Balls(), balls)[0], value)
    symbols = {axis: getattr(formula, axis.upper()) for axis in "xyz"}
    expression = walk(tape, Symbols(), symbols)[0]
    assert float(expression.subs({symbols[a]: at for a, at in zip("xyz", POINT, strict=True)})) == pytest.approx(value)


@each
def test_ranges(name: str) -> None:
    tape, value, point = tape_for(name), value_of(name), np.array([POINT])
    low, high = outputs(tape, point - 1e-9, point + 1e-9)
    assert low[0, 0] <= value <= high[0, 0] and high[0, 0] - low[0, 0] < 1e-6
    known = ranges_of(tape, {axis: (at, at) for axis, at in zip("xyz", POINT, strict=True)})[tape.outputs[0]]
    assert known.low - 1e-15 <= value <= known.high + 1e-15


@each
def test_derivatives(name: str) -> None:
    tape, wanted = tape_for(name), slopes_of(name)
    variables = dict(zip("xyz", POINT, strict=True))
    assert [float(s) for s in walk(lowering.gradient(lowering.real_tape(tape)), Floats(), variables)] == pytest.approx(
        wanted, abs=1e-8
    )
    if not JUMPS & {op.name for op in tape.ops}:
        numbers = Slopes()
        point = {axis: numbers.variable(axis, flint.arb(at)) for axis, at in variables.items()}
        found = walk(tape, numbers, point)[0]
        assert holds(found.value, value_of(name))
        assert all(abs(rate - slope) < 1e-8 for rate, slope in zip(found.rates, wanted, strict=True))


@each_written
def test_canonical_text_reads_back(name: str) -> None:
    tape = tape_for(name)
    assert formula.parse(formula.canonical(tape)).ordered() == tape.ordered()


@each_written
def test_the_oracle(name: str) -> None:
    """Its graph and programs, its estimate of rounding errors, and the root of a surface that uses the operation."""
    tape, value = tape_for(name), value_of(name)
    program = compile_tape(tape)
    inputs = [flint.arb(at) for at in POINT]
    assert holds(program.run(inputs, program.constants.converted(leaf, FUNCTIONS), FUNCTIONS), value)
    estimate = walk(tape, RunningErrors(), {a: (at, 0.0) for a, at in zip("xyz", POINT, strict=True)})[0]
    assert float(estimate[0]) == pytest.approx(value, rel=1e-14) and 0.0 <= float(estimate[1]) < math.inf
    builder = Builder()
    x, y, z = map(builder.var, "xyz")
    f = builder.add(builder.sub(x, builder.const(Fraction(1, 2))), EXAMPLES[name][0](builder, y, z, y))
    at = EXAMPLES[name][1](0.375, 0.75, 0.375)
    text = f"{formula.canonical(builder.tape(f))} - ({at!r})"
    hit = first_hits(
        surfaces.from_formula(text, "box:0.1,0.1,0.1:1,1,1"), np.array([[-1, 0.375, 0.75, 1, 0, 0]], np.float32)
    )
    assert hit.status[0] == TruthStatus.CROSSING
    assert hit.lower[0] - 1e-6 <= 1.5 <= hit.upper[0] + 1e-6


@each_written
def test_kernels_define_what_they_call(name: str) -> None:
    found = find_methods().get("interval_march")
    text = method_program(found.method, found.folder, found.variant({}), surface_of(name), "float32", "cl", "rays").text
    code = re.sub(r"//.*", "", text)
    called = set(re.findall(r"\b((?:interval|bounded|sided|open)_\w+)\(", code))
    assert called <= set(re.findall(r"^(?:static |inline )*(?:Interval|int|real|bool) (\w+)\(", code, re.M))


@pytest.mark.parametrize("form", files.FORMS)
@each_written
def test_other_languages_have_it_or_say_that_they_do_not(name: str, form: str) -> None:
    try:
        assert files.export(surface_of(name), form)
    except FirsthitError as error:
        assert form == "jsurf" or "has no" in str(error)
