"""Which formulas are known to have a value all over their domain, by structure or on boxes."""

from __future__ import annotations

import random

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError
from surfaces import formula
from surfaces.evaluation import evaluate_tape
from surfaces.tape import Tape
from surfaces.validity import signs_of


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
        known = signs_of(tape)
        values = evaluate_tape(Tape(tape.ops, tuple(range(len(tape.ops)))), points)
        for column, sign in zip(values.T, known, strict=True):
            column = column[np.isfinite(column)]
            assert sign == 0 or (column >= 0.0).all()
            claimed += sign > 0
    assert claimed > 300
