"""Files of six formats, written here from the literature's equations: they are read, and the oracle is held against an
independent evaluation along random rays: Sturm's theorem in exact fractions for polynomials, samples for the others.

FIRSTHIT_RAYS sets how many rays each file gets, of all files; by default a few files get 20.
"""

from __future__ import annotations

import os
from fractions import Fraction

import mpmath
import numpy as np
import pytest

import firsthit
from harness.contract import Surface, TruthStatus
from harness.oracle import first_hits
from surfaces import files

from .conftest import usable_devices
from .foreign_files import EXACT, FLOATS, MPMATH, Case, Poly, cases, value
from .test_oracle_formulas import Roots, clip, integral

ALL = cases()
WANTED = int(os.environ.get("FIRSTHIT_RAYS", "0"))
CHOSEN = ALL if WANTED else ALL[::11]  # 12 files, of all formats
SAMPLES = 3000
UNDECIDED: dict[str, tuple[int, int]] = {}  # file: undecided rays, rays


def rays_at(surface: Surface, count: int, seed: int) -> np.ndarray:
    """Rays float32[n, 6] from around the domain to points in it."""
    rng = np.random.default_rng(seed)
    away = rng.normal(size=(count, 3))
    away /= np.linalg.norm(away, axis=1, keepdims=True)
    radius, center = surface.domain.radius, np.array(surface.domain.center)
    origins = center + 2.5 * radius * away
    targets = center + rng.uniform(-0.6, 0.6, (count, 3)) * radius
    directions = (targets - origins) / np.linalg.norm(targets - origins, axis=1, keepdims=True)
    return np.concatenate((origins, directions), axis=1).astype(np.float32)


def hold_against_sturm(case: Case, surface: Surface, ray: np.ndarray, status: int, lower: float, upper: float) -> None:
    """Fail where the oracle's answer cannot be, by the roots of the equation along the ray."""
    exact = [Fraction(float(v)) for v in ray]
    where = f"{case.file} along {[float(v) for v in ray]}"
    ends = clip(surface, exact)
    if ends is None:
        assert status == TruthStatus.MISS, where
        return
    outer, inner = ends
    scale = Fraction(case.scale)
    along = [Poly({(): scale * o, (1,): scale * d}) for o, d in zip(exact[:3], exact[3:], strict=True)]
    roots = Roots(integral(value(case.equation, *along, EXACT).coefficients()))
    if status == TruthStatus.MISS:
        assert roots.within(*outer) == 0, where
        return
    low, high = max(Fraction(lower), inner[0]), min(Fraction(upper), inner[1])
    assert roots.before(inner[0], low) == 0, where
    slack = Fraction(1, 10**30) if "sqrt" in case.equation else 0  # roots of 2 and 5 are rounded to 80 digits
    assert roots.within(low - slack, high + slack) >= 1, where


def hold_against_samples(
    case: Case, surface: Surface, ray: np.ndarray, status: int, lower: float, upper: float
) -> None:
    """Fail where samples of the equation along the ray have another sign than the oracle's answer allows."""
    where = f"{case.file} along {[float(v) for v in ray]}"
    ends = clip(surface, [Fraction(float(v)) for v in ray])
    if ends is None:
        assert status == TruthStatus.MISS, where
        return
    enter, leave = map(float, ends[1])
    hit = status != TruthStatus.MISS
    t = np.linspace(enter, min(leave, lower) if hit else leave, SAMPLES)
    wide = ray.astype(np.float64)
    values = value(case.equation, *(case.scale * (wide[i] + t * wide[i + 3]) for i in range(3)), FLOATS)
    clear = values[np.abs(values) > 1e-9]
    assert (clear > 0).all() or (clear < 0).all(), where
    if status == TruthStatus.CROSSING:
        with mpmath.workdps(40):
            sides = []
            for at in (lower, upper):
                point = [
                    mpmath.mpf(case.scale) * (mpmath.mpf(wide[i]) + mpmath.mpf(at) * mpmath.mpf(wide[i + 3]))
                    for i in range(3)
                ]
                sides.append(value(case.equation, *point, MPMATH))
            assert sides[0] * sides[1] <= 0, where


def test_there_are_eighty_files_of_six_formats():
    assert len(ALL) >= 80
    assert {case.form for case in ALL} == {"jsurf", "surf", "pov", "function", "json", "vm"}


@pytest.mark.parametrize("case", CHOSEN, ids=lambda case: case.file)
def test_the_oracle_agrees_with_an_independent_evaluation(case, tmp_path):
    path = tmp_path / case.file
    path.write_text(case.text, encoding="utf-8")
    surface = files.load(path).surface
    count = WANTED or 20
    rays = rays_at(surface, count, len(case.text))
    truth = first_hits(surface, rays)
    hold = hold_against_sturm if case.is_polynomial else hold_against_samples
    undecided = truth.status == TruthStatus.UNDECIDED
    for ray, status, lower, upper in zip(rays, truth.status, truth.lower, truth.upper, strict=True):
        if status != TruthStatus.UNDECIDED:
            hold(case, surface, ray, status, lower, upper)
    UNDECIDED[case.file] = int(undecided.sum()), count


@pytest.mark.parametrize("case", CHOSEN if WANTED else CHOSEN[1::4], ids=lambda case: case.file)
def test_a_file_is_drawn(case, tmp_path):
    path = tmp_path / case.file
    path.write_text(case.text, encoding="utf-8")
    picture = firsthit.render(files.load(path).surface, "interval_march", usable_devices()[0].name, size=32)
    assert (picture < 255).any(axis=2).mean() > 0.02, "the picture shows next to nothing"


def test_almost_no_ray_is_undecided():
    if not UNDECIDED:
        pytest.skip("no file was read in this process")
    undecided, asked = (sum(pair[i] for pair in UNDECIDED.values()) for i in (0, 1))
    assert undecided <= 0.001 * asked, UNDECIDED
