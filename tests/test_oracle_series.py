"""Rays on which f's large terms cancel: Taylor series enclose f there, and decide what ranges do not."""

from __future__ import annotations

import random

import numpy as np
import pytest
from flint import arb, ctx

import surfaces
from harness.contract import TruthStatus
from harness.oracle import first_hits, reals, taylor
from harness.oracle.program import program_of
from harness.oracle.reading import graph_of
from surfaces import formula


def rays() -> np.ndarray:
    """12 rays of a view, of which none lies in a coordinate plane."""
    side = np.linspace(-0.8, 0.8, 6)
    listed = [(x, y, 3.0, 0.1 * x - 0.03, 0.02 - 0.1 * y, -1.0) for x in side for y in side]
    return np.array(listed[::3], np.float32)


IDENTITIES = [
    ("cos(x)^2 + sin(x)^2 - 1 + 1e-9*({})", 1),
    ("cosh(x)^2 - sinh(x)^2 - 1 + 1e-9*({})", 1),
    ("sin(2*x) - 2*sin(x)*cos(x) + 1e-12*({})", 1),
    ("log(exp(x) + 1) - x - log(1 + exp(-x)) + 1e-9*({})", 1),
    ("cos(x*y)^2 + sin(x*y)^2 - 1 - 1e-9*({})", 1),
    ("max(cos(x)^2 + sin(x)^2 - 1 + 1e-9*({}), -exp(x))", 1),
    ("abs(tan(x/2)*(1 + cos(x)) - sin(x) + 1e-9*({}))", 2),
]


@pytest.mark.parametrize(("identity", "order"), IDENTITIES)
@pytest.mark.parametrize("rest", ["y + z/8", "x^2 + y^2 + z^2 - 1"])
def test_what_is_left_of_an_identity_is_decided(identity: str, order: int, rest: str) -> None:
    whole, alone = (surfaces.from_formula(f, "sphere:1.5") for f in (identity.format(rest), rest))
    found, known = first_hits(whole, rays()), first_hits(alone, rays())
    decided = found.status != TruthStatus.UNDECIDED
    if order == 1:
        assert decided.all()
        assert (found.status == known.status).all()
    assert (found.status[decided] == TruthStatus.MISS).tolist() == (known.status[decided] == TruthStatus.MISS).tolist()
    hit = decided & (known.status == TruthStatus.CROSSING)
    assert (found.lower[hit] <= known.upper[hit] + 1e-12).all()
    assert (found.upper[hit] >= known.lower[hit] - 1e-12).all()


def test_an_identity_alone_stays_undecided() -> None:
    truth = first_hits(surfaces.from_formula("cos(x)^2 + sin(x)^2 - 1 + 0*z", "sphere:1.5"), rays()[:2])
    assert (truth.status == TruthStatus.UNDECIDED).all()


def text(pick: random.Random, depth: int) -> str:
    if not depth:
        return pick.choice(["x", "y", "z", "(1/3)", "x", "(-5/8)"])
    a, b = text(pick, depth - 1), text(pick, depth - 1)
    kinds = ["({} + {})", "({} - {})", "{}*{}", "min({}, {})", "max({}, {})", "({})/(2 + ({})^2)",
             "atan2({}, 3 + ({})^2)", "if({} < {}, x, y)"]  # fmt: skip
    functions = ["exp({})", "sin({})", "cos({})", "log(2 + ({})^2)", "sqrt(1 + ({})^2)", "abs({})", "floor({})",
                 "tan(sin({}))", "({})^3", "(1 + ({})^2)^(1/3)"]  # fmt: skip
    return pick.choice(functions).format(a) if pick.random() < 0.5 else pick.choice(kinds).format(a, b)


@pytest.mark.parametrize("seed", range(40))
def test_values_and_slopes_lie_in_what_series_enclose(seed: int) -> None:
    pick = random.Random(seed)
    f = program_of(graph_of(formula.parse(f"{text(pick, 3)} + x*y")), lengths=True)
    axes = [(arb(pick.randint(-8, 8)) / 8, arb(pick.randint(-8, 8)) / 8) for _ in range(3)]
    middle, radius = arb(pick.randint(-8, 8)) / 8, arb(2) ** -pick.randint(0, 6)
    with reals.precision(taylor.BITS):
        constants = f.constants.converted(reals.leaf, reals.FUNCTIONS)
        found = taylor.enclosed(f, constants, axes, (middle - radius).union(middle + radius))
        for k in range(-20, 21):
            t = middle + radius * k / 20
            value = f.run([o + d * t for o, d in axes], constants, reals.FUNCTIONS)
            assert not found.value.is_finite() or found.value.overlaps(value)
            step = arb(2) ** -60
            if found.slope.is_finite() and abs(k) < 20:
                ahead = f.run([o + d * (t + step) for o, d in axes], constants, reals.FUNCTIONS)
                assert ((ahead - value) / step - found.slope).overlaps(arb(0, 1) * arb(2) ** -50)


def test_series_leave_the_length_of_series_as_it_was() -> None:
    before = ctx.cap
    with reals.precision(taylor.BITS):
        f = program_of(graph_of(formula.parse("sqrt(x) + y")))
        found = taylor.enclosed(f, [], [(arb(0), arb(1)), (arb(0), arb(0)), (arb(0), arb(0))], arb(0, 1))
    assert not found.value.is_finite()
    assert ctx.cap == before
