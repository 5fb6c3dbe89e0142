"""The reference that the oracle is held against: roots by Sturm's theorem, and that wrong answers are seen."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

import surfaces
from harness.contract import Truth, TruthStatus
from harness.oracle import first_hits
from tests.campaigns import oracle as campaign
from tests.exact_roots import Poly, Signs, constant, first_hit, linear
from tests.exact_surfaces import Shape, X, Y, Z, number

T = Poly([0, 1])


@pytest.mark.parametrize(
    ("roots", "crosses"), [([1, 3], True), ([1, 1, 3], False), ([1, 1, 1, 2], True), ([Fraction(1, 3)] * 4, False)]
)
def test_the_first_root_and_whether_it_crosses(roots: list[Fraction], crosses: bool) -> None:
    p = constant(1)
    for root in [*roots, -1]:
        p = p * linear(-Fraction(root), Fraction(1))
    hit = first_hit([p], lambda s: s[0], [T, constant(4) - T], Fraction(-1, 8), Fraction(5))
    assert hit is not None
    assert hit.at_least(Fraction(roots[0])) and hit.at_most(Fraction(roots[0]))
    assert not hit.at_least(Fraction(roots[0]) + Fraction(1, 10**30))
    assert hit.crosses == crosses


def test_a_root_at_an_end_counts_and_one_behind_it_does_not() -> None:
    p = T * T - constant(2)
    inside = [constant(2) - T * T, T]
    assert first_hit([p], lambda s: s[0], inside, Fraction(-1), Fraction(2)) is not None
    shorter = [constant(Fraction(1999999, 1000000)) - T * T, T]
    assert first_hit([p], lambda s: s[0], shorter, Fraction(-1), Fraction(2)) is None


def test_where_f_begins_to_be_zero_counts_as_its_first_root() -> None:
    def sign(signs: Signs) -> int:  # of t < 1 ? 1 : 0
        return 1 if signs[0] <= 0 else 0

    hit = first_hit([T - constant(1)], sign, [constant(9) - T * T, T], Fraction(-1), Fraction(4))
    assert hit is not None
    assert (hit.at_least(Fraction(1)), hit.at_most(Fraction(1)), hit.crosses) == (True, True, False)


SPHERE = X**2 + Y**2 + Z**2 - number(1)
SHAPE = Shape(SPHERE.text, (SPHERE,), lambda s: s[0], "polynomial")
RAY = [0.0, 0.0, 3.0, 0.0, 0.0, -1.0]


def wrong(change: dict[str, float]) -> str:
    surface = surfaces.from_formula(SHAPE.text, "sphere:1.5")
    truth = first_hits(surface, np.array([RAY], np.float32))
    changed: Truth = replace(truth, **{name: np.array([value]) for name, value in change.items()})
    return campaign._held(SHAPE, surface.domain, RAY, 0.0, changed, 0)[1]


@pytest.mark.parametrize(
    "change",
    [
        {"status": TruthStatus.MISS},
        {"status": TruthStatus.TOUCH},
        {"status": TruthStatus.UNDECIDED},
        {"lower": 2.0 + 1e-15, "upper": 2.0 + 1e-14},
        {"lower": 4.0 - 1e-14, "upper": 4.0 + 1e-14},
        {"lower": 1.9},
    ],
)
def test_a_wrong_answer_is_seen(change: dict[str, float]) -> None:
    assert wrong(change)


def test_the_right_answer_is_not_wrong() -> None:
    assert not wrong({})
