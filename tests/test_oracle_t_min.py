"""Starts on the surface: the first hit is the first root in [max(t_min, t_enter), t_exit], ends included."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import FirsthitError, Truth, TruthStatus
from harness.oracle import cached_first_hits, first_hits
from harness.oracle.clip import clip_exactly, clip_many
from harness.oracle.reals import precision, rational
from tests.test_oracle_formulas import check, random_formula, rays_at

UNIT = "x^2 + y^2 + z^2 - 1"
AS_DISTANCE = "sqrt(x^2 + y^2 + z^2) - 1"
CUBE = "max(abs(x), abs(y), abs(z)) - 1"
DOMAINS = ("sphere:2", "box:2,2,2", "sphere:1", "box:1,1,1")


class At:
    """A number that an interval is equal to if it holds it and is narrow."""

    def __init__(self, t: float) -> None:
        self.t = t

    def __eq__(self, other: object) -> bool:
        assert isinstance(other, tuple)
        return bool(other[0] <= self.t <= other[1] and other[1] - other[0] < 1e-11)

    def __repr__(self) -> str:
        return f"an interval around {self.t}"


def ask(formula: str, domain: str, ray: list[float], t_min: float = 0.0) -> tuple[str, tuple[float, float]]:
    """Status and certified interval of one ray."""
    truth = first_hits(surfaces.from_formula(formula, domain), np.array([ray], np.float32), t_min)
    status = TruthStatus(truth.status[0])
    if status in (TruthStatus.CROSSING, TruthStatus.TOUCH):
        assert t_min <= truth.lower[0] <= truth.upper[0]
    return status.name.lower(), (float(truth.lower[0]), float(truth.upper[0]))


@pytest.mark.parametrize("formula", [UNIT, AS_DISTANCE, CUBE])
@pytest.mark.parametrize("domain", DOMAINS)
def test_a_start_on_the_surface_is_a_hit_at_0(formula: str, domain: str) -> None:
    for direction in ([1, 0, 0], [-1, 0, 0], [0.5, 0.25, 0], [-0.5, 0.25, 0.125]):  # leaving and entering
        assert ask(formula, domain, [1, 0, 0, *direction]) == ("crossing", At(0.0)), direction
    assert ask(formula, domain, [1, 0, 0, 0, 1, 0]) == ("touch", At(0.0))  # grazing


@pytest.mark.parametrize("formula", [UNIT, AS_DISTANCE, CUBE])
@pytest.mark.parametrize("domain", ["sphere:2", "box:2,2,2"])
def test_t_min_just_before_at_and_after_roots(formula: str, domain: str) -> None:
    through = [-3, 0, 0, 1, 0, 0]  # roots at 2 and 4
    below, above = float(np.nextafter(2.0, 0)), float(np.nextafter(2.0, 9))
    for t_min, t in ((0.0, 2.0), (1.5, 2.0), (below, 2.0), (2.0, 2.0), (above, 4.0), (3.0, 4.0), (4.0, 4.0)):
        assert ask(formula, domain, through, t_min) == ("crossing", At(t)), t_min
    for t_min in (float(np.nextafter(4.0, 9)), 4.5, 5.0, 5.5, 1e30):  # the domain ends at 5
        assert ask(formula, domain, through, t_min)[0] == "miss", t_min
    assert ask(formula, domain, [0, 0, 0, 1, 0, 0], 1.0) == ("crossing", At(1.0))  # from inside
    assert ask(formula, domain, [0, 0, 0, 1, 0, 0], float(np.nextafter(1.0, 2)))[0] == "miss"


@pytest.mark.parametrize("domain", ["sphere:2", "box:2,2,2"])
def test_t_min_at_a_touch(domain: str) -> None:
    for formula in ("(x - 1/2)^2", "abs(x - 1/2)", "min((x - 1/2)^2, y^2 + 1)", "exp(x)*(x - 1/2)^2"):
        for t_min in (0.0, 3.4, float(np.nextafter(3.5, 0)), 3.5):
            found = ask(formula, domain, [-3, 0, 0, 1, 0, 0], t_min)
            if "exp" in formula and t_min == 3.5:
                assert found[0] == "undecided"  # a root exactly at an end, of what is not algebraic
            else:
                assert found == ("touch", At(3.5))
        assert ask(formula, domain, [-3, 0, 0, 1, 0, 0], float(np.nextafter(3.5, 9)))[0] == "miss"


def test_t_min_where_f_is_0_all_along() -> None:
    assert ask("y*(x^2 + 1)", "box:1,1,1", [-3, 0, 0, 1, 0, 0], 0.0) == ("touch", At(2.0))
    assert ask("y*(x^2 + 1)", "box:1,1,1", [-3, 0, 0, 1, 0, 0], 2.75) == ("touch", At(2.75))
    assert ask("y*(x^2 + 1)", "box:1,1,1", [-3, 0, 0, 1, 0, 0], 4.0) == ("touch", At(4.0))
    assert ask("max(x, abs(y)) - max(x, 0)", "box:1,1,1", [-3, 0, 0, 1, 0, 0], 2.75) == ("touch", At(2.75))
    assert ask("max(abs(x) - 1/2, abs(y))", "sphere:1", [-3, 0, 0, 1, 0, 0], 2.75) == ("touch", At(2.75))
    assert ask("max(abs(x) - 1/2, abs(y))", "sphere:1", [-3, 0, 0, 1, 0, 0], 3.5) == ("touch", At(3.5))
    assert ask("max(abs(x) - 1/2, abs(y))", "sphere:1", [-3, 0, 0, 1, 0, 0], 3.75)[0] == "miss"


@pytest.mark.parametrize("degree", [2, 3, 5, 8])
def test_random_formulas_from_t_min_on(degree: int) -> None:
    """As rays whose origin is moved to o + t_min·d, exactly: their roots are t_min less."""
    import random

    pick, rng = random.Random(degree), np.random.default_rng(degree)
    for domain in ("sphere:1.5", "box:1,1.25,0.75"):
        surface = surfaces.from_formula(random_formula(pick, degree), domain)
        rays = rays_at(rng, 25, 1.5, coarse=True)
        for t_min in (0.25, 1.5, 4.0):
            moved = rays.copy()
            moved[:, :3] += np.float32(t_min) * rays[:, 3:]  # exact: sixteenths
            truth = first_hits(surface, rays, t_min)
            for ray, status, lower, upper in zip(moved, truth.status, truth.lower, truth.upper, strict=True):
                check(surface, ray, status, float(lower) - t_min, float(upper) - t_min)


@pytest.mark.parametrize("domain", ["sphere:1", "box:1,0.5,0.75"])
def test_both_clips_agree(domain: str) -> None:
    surface = surfaces.from_formula("x", domain)
    rays = rays_at(np.random.default_rng(3), 200, 1.0, coarse=True)
    for t_min in (0.0, 2.0**-40, 0.5, 1.0, 2.0, 9.0):
        many = clip_many(surface.domain, rays.astype(np.float64), t_min)
        for k, ray in enumerate(rays.tolist()):
            ends = clip_exactly(surface.domain, [rational(v) for v in ray], t_min)
            if ends is None:
                continue
            assert not many.missed[k]
            with precision(200):
                enter, leave = (end.ball() for end in ends)
                assert not enter < t_min
                assert not enter < many.enter_lower[k] and not enter > many.enter_upper[k]
                assert not leave < many.leave_lower[k] and not leave > many.leave_upper[k]
        assert many.missed.any() or t_min < 9.0


def test_estimates_are_those_of_the_part_beyond_t_min() -> None:
    surface = surfaces.from_formula(UNIT, "sphere:2")
    truth = first_hits(surface, np.array([[-3, 0, 0, 1, 0, 0]] * 2, np.float32), 1.999)
    np.testing.assert_allclose(truth.margin, 0.001, rtol=1e-3)
    truth = first_hits(surface, np.array([[-3, 0, 0, 1, 0, 0]], np.float32), 2.5)
    assert truth.lower[0] <= 4.0 <= truth.upper[0] and np.isinf(truth.following[0])


@pytest.mark.parametrize(
    ("t_min", "message"),
    [
        (-1e-300, "not negative"),
        (np.nan, "finite"),
        (np.inf, "finite"),
        ("0", "a number"),
        (10**400, "finite"),
        (True, "a number"),
    ],
)
def test_bad_values_are_refused(t_min: object, message: str, tmp_path: Path) -> None:
    surface, rays = surfaces.from_formula(UNIT, "sphere:2"), np.array([[-3, 0, 0, 1, 0, 0]], np.float32)
    with pytest.raises(FirsthitError, match=message):
        first_hits(surface, rays, t_min)  # type: ignore[arg-type]
    with pytest.raises(FirsthitError, match=message):
        cached_first_hits(surface, rays, tmp_path, t_min)  # type: ignore[arg-type]


def test_numbers_of_every_kind_are_taken_as_they_are() -> None:
    surface, rays = surfaces.from_formula("x", "sphere:2"), np.array([[-3, 0, 0, 1, 0, 0]], np.float32)
    for t_min in (3, np.float32(3), np.int64(3), 3.0):
        assert first_hits(surface, rays, t_min).status[0] == TruthStatus.CROSSING
    tenth = np.float32(0.1)
    surface = surfaces.from_formula(f"x - {Fraction(float(tenth))}", "sphere:2")
    rays = np.array([[0, 0, 0, 1, 0, 0]], np.float32)
    assert first_hits(surface, rays, tenth).status[0] == TruthStatus.CROSSING
    assert first_hits(surface, rays, 0.1).status[0] == TruthStatus.CROSSING  # 0.1f lies beyond the float64 0.1
    assert first_hits(surface, rays, float(np.nextafter(tenth, np.float32(1)))).status[0] == TruthStatus.MISS


def test_the_cache_tells_t_min_apart(tmp_path: Path) -> None:
    surface, rays = surfaces.from_formula(UNIT, "sphere:2"), np.array([[-3, 0, 0, 1, 0, 0]], np.float32)

    def interval(truth: Truth) -> tuple[float, float]:
        return float(truth.lower[0]), float(truth.upper[0])

    for _ in range(2):
        assert interval(cached_first_hits(surface, rays, tmp_path)) == At(2.0)
        assert interval(cached_first_hits(surface, rays, tmp_path, 2.5)) == At(4.0)
        assert interval(cached_first_hits(surface, rays, tmp_path, -0.0)) == At(2.0)
    assert len(list(tmp_path.iterdir())) == 2


def test_the_command_takes_t_min(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rays, output = tmp_path / "rays.npy", tmp_path / "truth.npz"
    np.save(rays, np.array([[1, 0, 0, 1, 0, 0], [-3, 0, 0, 1, 0, 0]], np.float32))
    command = ["oracle", "--formula", UNIT, "--domain", "sphere:2", "--rays", str(rays), "-o", str(output)]
    assert main(command) == 0
    with np.load(output) as stored:
        np.testing.assert_allclose(stored["lower"], [0.0, 2.0], atol=1e-11)
    assert main([*command, "--t-min", "2.5"]) == 0
    with np.load(output) as stored:
        assert stored["status"].tolist() == [TruthStatus.MISS, TruthStatus.CROSSING] and stored["lower"][1] > 3.99
    capsys.readouterr()
    with pytest.raises(SystemExit) as usage:
        main([*command, "--t-min", "-1"])
    assert usage.value.code == 2
    assert "must be finite and not under 0" in capsys.readouterr().err
