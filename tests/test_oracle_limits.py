"""The oracle's documented limits: what lies within them is decided, and what lies beyond is UNDECIDED."""

from __future__ import annotations

import numpy as np
import pytest

import surfaces
from harness.contract import TruthStatus
from harness.oracle import first_hits

RAY = np.array([[0.0, 0.0, 0.0, 1.0, 0.3, 0.2]], np.float32)
MISS, CROSSING, UNDECIDED = TruthStatus.MISS, TruthStatus.CROSSING, TruthStatus.UNDECIDED


@pytest.mark.parametrize(
    ("gap", "inside", "outside"),
    [
        ("1e-300*(1e-100*sqrt(2))", CROSSING, MISS),
        ("1e-300*(1e-239*sqrt(2))", CROSSING, MISS),
        ("(1e-300*sqrt(2))^5", UNDECIDED, UNDECIDED),
    ],
)
def test_a_root_that_is_near_the_domains_end(gap: str, inside: TruthStatus, outside: TruthStatus) -> None:
    """4096 bits tell a root from an irrational end of the clip interval that is 2^-1790 radii away, or farther."""
    for sign, status in (("+", inside), ("-", outside)):
        surface = surfaces.from_formula(f"x^2 + y^2 + z^2 - 2.25 {sign} {gap}", "sphere:1.5")
        assert first_hits(surface, RAY).status[0] == status


@pytest.mark.parametrize(
    ("gap", "status"), [("1e-120", CROSSING), ("1e-300*(1e-150*pi)", CROSSING), ("(1e-300*pi)^3", UNDECIDED)]
)
def test_two_roots_that_are_near_each_other(gap: str, status: TruthStatus) -> None:
    """With π in coefficients only balls tell two roots apart: f between them is as small as their gap squared."""
    surface = surfaces.from_formula(f"(x - pi/3)*(x - pi/3 - {gap})", "sphere:1.5")
    truth = first_hits(surface, RAY)
    assert truth.status[0] == status
    if status != UNDECIDED:
        assert truth.lower[0] <= np.pi / 3 <= truth.upper[0]
