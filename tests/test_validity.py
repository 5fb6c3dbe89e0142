"""Which formulas are known to have a value all over their domain, by structure or on boxes."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError
from surfaces import formula
from surfaces.evaluation import evaluate_tape
from surfaces.model import Box, Sphere
from surfaces.proofs.signs import Range, _own, ranges_of
from surfaces.proofs.validity import undefined
from surfaces.tape import Builder, Op, Tape


@pytest.mark.parametrize(
    "text",
    [
        "sqrt(x^2+y^2+z^2) - 1",
        "sqrt(2*x^2 + y^2) - 1",
        "sqrt((sqrt(x^2+y^2) - 0.8)^2 + z^2) - 0.3",
        "sqrt(x^2+y^2) + z - 0.5",
        "(sqrt(x^2+y^2) - 0.2)^2 + z^2 - 0.25",
        "sqrt(max(abs(x)-0.5,0)^2 + max(abs(y)-0.4,0)^2) + min(max(abs(x)-0.5, abs(y)-0.4), 0)",
        "sqrt(abs(x)*abs(y)) + sqrt(max(x, 0)) + sqrt(min(x^2, abs(y))) - z",
        "sqrt((x - y)^4 + abs(z)^3) - 1",
        "sqrt(exp(x)*y^2) - z",
        "sqrt(x^2/(1 + y^2)) - z",
        "1/(1 + sqrt(x^2 + y^2)) - z",
        "-log(exp(-8*sqrt(x^2+y^2)) + exp(-8*abs(z)))/8 - 0.1",
        "log(1/10 + sqrt(x^2+y^2)) - z",
        "sqrt(log(2 + sqrt(x^2 + y^2))) - z",
        "sqrt(1 - sin(9*x)) - z",
        "sqrt(1 - cos(x)^2 * sin(y)^4) - z",
        "sqrt(abs(x) + x) + sqrt(abs(y) - y) - z",
        "sqrt(sqrt(x^2 + y^2) - x) - z",
        "sqrt(max(x, y) - x) + sqrt(y - min(x, y)) - z",
        "sqrt(1 + x/sqrt(x^2 + y^2 + 1/100)) - z",
        "1/(2 + sin(x + y)) - z",
        "log(3 - cos(x)) - z",
    ],
)
def test_signs_that_show_in_the_structure_need_no_boxes(text: str) -> None:
    surface = surfaces.from_formula(text, "box:1,1,1")
    assert np.isfinite(surfaces.evaluate(surface, np.random.default_rng(1).uniform(-1, 1, (50, 3)))).all()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("sqrt(x^3) - y", "sqrt needs"),
        ("sqrt(x^2 - y^2) - z", "sqrt needs"),
        ("sqrt(abs(x)*y) - z", "sqrt needs"),
        ("sqrt(min(x^2, y)) - z", "sqrt needs"),
        ("sqrt(-abs(x)) - z", "sqrt needs"),
        ("log(x^2 + y^2) - z", "log needs"),
        ("log(max(x, 0)) - z", "log needs"),
        ("log(abs(x)*exp(y)) - z", "log needs"),
        ("1/sqrt(x^2 + y^2) - z", "a divisor"),
        ("1/abs(x) - z", "a divisor"),
        ("z/(x^2 + max(y, 0))", "a divisor"),
        ("sqrt(x^2/y) - z", "a divisor|sqrt needs"),
        ("x/sqrt(y - 12)", "sqrt needs"),  # has a value nowhere, nor have these
        ("x/sqrt(y - 12) + 1/log(y - 12)", "sqrt needs|log needs"),
        ("1/sqrt(sqrt(-2 - exp(x)) - y)", "sqrt needs"),
        ("abs(x - 3)/(x - 12)^2.3", "a power"),
    ],
)
def test_what_may_have_no_value_is_still_refused(text: str, message: str) -> None:
    with pytest.raises(FirsthitError, match=message):
        surfaces.from_formula(text, "box:1,1,1")


def test_signs_hold_on_random_formulas() -> None:
    """Every operation of random formulas, at random points: never of another sign than is claimed, if finite."""
    pick, rng = random.Random(3), np.random.default_rng(3)
    points = np.vstack([rng.uniform(-2, 2, (200, 3)), rng.integers(-1, 2, (40, 3))])
    claimed = 0

    def tree(depth: int) -> str:
        if not depth:
            return pick.choice(["x", "y", "z", "1/2", "-1", "0", "pi"])
        a, b = tree(depth - 1), tree(depth - 1)
        return pick.choice(
            [f"({a} + {b})", f"({a} - {b})", f"{a}*({b})", f"({a})/({b} + 3)", f"abs({a})", f"min({a}, {b})", f"-({a})",
             f"max({a}, {b})", f"({a})^2", f"({a})^3", f"({a})^4", f"sqrt({a})", f"exp({a})", f"log({a})", f"sin({a})"]
        )  # fmt: skip

    for _ in range(300):
        try:
            tape = formula.parse(tree(3))
        except FirsthitError:  # a constant without a value
            continue
        known = ranges_of(tape, dict.fromkeys("xyz", (-2.0, 2.0)))
        values = evaluate_tape(Tape(tape.ops, tuple(range(len(tape.ops)))), points)
        values = values[np.isfinite(values).all(axis=1)]
        for column, found in zip(values.T, known, strict=True):
            slack = 1e-12 * np.maximum(1.0, np.abs(column))
            assert (column >= found.low - slack).all() and (column <= found.high + slack).all()
            assert found.low < 0.0 or (column >= 0.0).all()
            assert not found.not_zero or found.low == 0.0 or found.high == 0.0 or (column != 0.0).all()
            claimed += found.low >= 0.0
    assert claimed > 300


def _choice(condition: str, part: str, other: str = "zero") -> Tape:
    """Return select(condition, part, other) of expressions in the operations of a Builder b, and x, y, z, zero, one."""
    b = Builder()
    names: dict[str, Any] = {
        "Fraction": Fraction,
        "b": b,
        "x": b.var("x"),
        "y": b.var("y"),
        "z": b.var("z"),
        "zero": b.const(0),
        "one": b.const(1),
    }
    names["above"] = lambda p, q: b.sub(b.const(1), b.below(p, q))
    names["equal"] = lambda p, q: b.min(b.below(p, q), b.below(q, p))
    return b.tape(b.sub(b.select(*(eval(text, names) for text in (condition, part, other))), names["z"]))


GUARDED = [  # what holds in the part that is taken: the very argument, the same sum in another form, a factor of it
    ("above(x, zero)", "b.log(x)", "zero"),
    ("b.below(zero, x)", "b.sqrt(x)", "zero"),
    ("b.below(zero, x)", "b.sqrt(x)", "b.sqrt(b.neg(x))"),
    ("b.below(x, zero)", "zero", "b.div(one, x)"),
    ("above(x, y)", "b.log(b.sub(x, y))", "zero"),
    ("above(b.add(b.sqr(x), b.sqr(y)), one)", "zero", "b.sqrt(b.sub(b.sub(one, b.sqr(x)), b.sqr(y)))"),
    ("b.min(above(x, zero), above(y, zero))", "b.log(b.mul(x, y))", "zero"),
    ("b.max(b.below(x, zero), b.below(y, zero))", "zero", "b.log(b.mul(x, y))"),
    ("equal(x, zero)", "one", "b.div(b.sin(x), x)"),
    ("b.below(b.abs(x), zero)", "one", "b.div(b.sin(x), x)"),
    ("above(b.powi(x, 3), zero)", "b.log(x)", "zero"),
    ("above(x, b.const(Fraction(1, 2)))", "b.sqrt(b.sin(x))", "zero"),  # on boxes: sin is positive on [1/2, 2]
    ("above(x, one)", "b.select(above(x, b.const(2)), zero, b.sqrt(b.sub(x, one)))", "zero"),
]


@pytest.mark.parametrize(("condition", "part", "other"), GUARDED)
def test_a_guarded_part_needs_its_value_only_where_it_is_taken(condition: str, part: str, other: str) -> None:
    assert undefined(_choice(condition, part, other), Box((-2, -2, -2), (2, 2, 2))) is None


@pytest.mark.parametrize(
    ("condition", "part", "other"),
    [
        ("b.below(zero, x)", "b.log(x)", "zero"),  # log(0) is taken
        ("above(x, zero)", "zero", "b.log(x)"),
        ("above(y, zero)", "b.log(x)", "zero"),
        ("above(x, zero)", "b.add(b.log(x), b.log(y))", "zero"),
        ("above(b.add(x, one), zero)", "b.log(x)", "zero"),
        ("b.max(above(x, zero), above(y, zero))", "b.log(x)", "zero"),
        ("above(x, zero)", "b.log(x)", "b.sqrt(x)"),
        ("above(b.sqr(x), zero)", "b.log(x)", "zero"),
        ("equal(x, y)", "one", "b.div(b.sin(x), x)"),
        ("above(b.sqrt(x), one)", "one", "zero"),  # the condition itself needs a value everywhere
    ],
)
def test_a_guard_that_does_not_help_is_no_proof(condition: str, part: str, other: str) -> None:
    assert undefined(_choice(condition, part, other), Sphere(2.0))


@pytest.mark.parametrize(
    "text",
    [
        "if(x > 0, if(x <= 0, 1/x, 1), 2) + y",
        "if(x > 0 && x <= 0, 1/x^2 + sqrt(x) + x^(1/3) + 1/abs(x), z)",
        "if(x != 0, if(x >= 0 and x <= 0, 1/x, 1), y)",
    ],
)
def test_a_part_that_is_never_taken_needs_no_value(text: str) -> None:
    surface = surfaces.from_formula(text, "sphere:1")
    assert np.isfinite(surfaces.evaluate(surface, np.random.default_rng(1).uniform(-1, 1, (50, 3)))).all()


def test_one_use_outside_the_guard_needs_a_value_there() -> None:
    b = Builder()
    x, zero = b.var("x"), b.const(0)
    guarded = b.select(b.sub(b.const(1), b.below(x, zero)), b.log(x), zero)
    assert undefined(b.tape(guarded), Sphere(1.0)) is None
    assert "log needs" in (undefined(b.tape(b.add(guarded, b.log(x))), Sphere(1.0)) or "")


def test_a_quotient_without_a_value_is_refused_with_its_place() -> None:
    with pytest.raises(FirsthitError, match=r"also where the dividend does.*look near 0, 0, 0\)$"):
        surfaces.from_formula("sin(x)/x - y", "sphere:1")


def test_a_hundred_thousand_shared_operations_are_checked_in_linear_time() -> None:
    b = Builder()
    x, y, value = b.var("x"), b.var("y"), b.var("z")
    for i in range(20_000):
        value = b.sqrt(b.add(b.sqr(b.sub(value, b.const(Fraction(i, 7)))), b.sqr(y)))
        if i % 5 == 0:
            value = b.select(b.below(value, x), value, b.abs(x))
    tape = b.tape(value)
    assert len(tape.ops) > 80_000 and undefined(tape, Sphere(1.0)) is None


def test_ranges_of_what_has_no_value_end_in_no_error() -> None:
    """Every operation on every pair of ranges, empty ones too, such as that of a root of a negative number."""
    ends = (-np.inf, -1e308, -1.0, -1e-320, 0.0, 5e-324, 1.0, 710.0, np.inf)
    odd = [Range(a, b, nonzero) for a in ends for b in ends for nonzero in (False, True)]
    for name in ("neg", "sqr", "sqrt", "abs", "exp", "log", "sin", "cos", "tan", "floor", "sign"):
        for a in odd:
            assert isinstance(_own(Op(name, (0,)), [a]), Range)
    for exponent in (2, 3, 8, Fraction(5, 2), Fraction(1, 7)):
        for a in odd:
            assert isinstance(_own(Op("powr" if isinstance(exponent, Fraction) else "powi", (0, exponent)), [a]), Range)
    for name in ("add", "sub", "mul", "div", "min", "max", "atan2", "below"):
        for a in odd[::2]:
            assert all(isinstance(_own(Op(name, (0, 1)), [a, b]), Range) for b in odd)
