"""Formulas with very small and very large constants: they are read without a traceback, or refused in words."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import surfaces
from harness.contract import FirsthitError, TruthStatus
from harness.oracle import first_hits

DOWN = np.array([[0.25, 0.125, 3.0, 0.0, 0.0, -1.0]], np.float32)


@pytest.mark.parametrize(
    "formula",
    [
        "x/(abs(x) + 1e-300) - z",
        "1/(x^2 + y^2 + 1e200) - 10",
        "(x^2 + 1e200)^-1.5 - z",
        "sin(1e90*x) + sin(1e-90*y)",
        "(1e30*x)^60 - y",
        "tanh(x/1e-160) - z",
    ],
)
def test_is_read_without_a_warning(formula: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        surfaces.from_formula(formula, "sphere:1.5")


@pytest.mark.parametrize("small", ["1e-9", "1e-12", "1e-40", "1e-300"])
@pytest.mark.parametrize(
    "formula",
    ["sqrt(x^2 + y^2 + {}) - z", "sqrt(x^2 + y^2 + {})*2 - 1/2", "1/(1 + x^2 + {}) - z", "z - log(x^2 + {})/99"],
)
def test_a_small_constant_is_taken_and_decided(formula: str, small: str) -> None:
    surface = surfaces.from_formula(formula.format(small), "sphere:1.5")
    assert first_hits(surface, DOWN).status[0] in (TruthStatus.CROSSING, TruthStatus.MISS)


def test_a_constant_that_is_too_large_is_refused_in_words() -> None:
    with pytest.raises(FirsthitError, match=r"a constant is undefined, or 2\^1000 or larger"):
        surfaces.from_formula("(x/1e-160)^2 + y^2 - 1", "sphere:1.5")
