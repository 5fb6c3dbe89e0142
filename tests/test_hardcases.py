"""Hard cases: every rung's float32 rays are measured again, exactly, and must be where the rung says they are."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest

import surfaces
from harness import hardcases
from harness.accuracy.rungs import judge_rung, knowable_margin, share_right
from harness.contract import FirsthitError, Hits, RayStatus, Truth, TruthStatus
from harness.hardcases import Rung
from harness.oracle import first_hits

from .ladders import first_break

Exact = tuple[Fraction, ...]
PRECISION = 60  # decimal digits
EVERY = [(name, rung) for name in hardcases.names() for rung in hardcases.rungs(name)]
IDS = [f"{name}-{rung.parameter:.3g}" for name, rung in EVERY]


@cache
def truths(name: str) -> tuple[Truth, ...]:
    return tuple(first_hits(rung.surface, rung.rays) for rung in hardcases.rungs(name))


def exact_rays(rung: Rung) -> list[tuple[Exact, Exact]]:
    numbers = [[Fraction(float(v)) for v in ray] for ray in rung.rays]
    return [(tuple(row[:3]), tuple(row[3:])) for row in numbers]


def root(value: Fraction) -> float:
    with mpmath.workdps(PRECISION):
        return float(mpmath.sqrt(mpmath.mpf(value.numerator) / value.denominator))


def dot(a: Exact, b: Exact) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def from_point(o: Exact, d: Exact, point: tuple[float, ...]) -> float:
    """Distance of a point from the ray's line."""
    to = tuple(Fraction(p) - x for p, x in zip(point, o, strict=True))
    return root(dot(to, to) - dot(to, d) ** 2 / dot(d, d))


def from_nodes(nodes: list[tuple[float, ...]]) -> Callable[[Rung], list[float]]:
    return lambda rung: [min(from_point(o, d, node) for node in nodes) for o, d in exact_rays(rung)]


def from_z_axis(rung: Rung) -> list[float]:
    return [root((o[0] * d[1] - o[1] * d[0]) ** 2 / (d[0] ** 2 + d[1] ** 2)) for o, d in exact_rays(rung)]


def torus_distance(o: Exact, d: Exact, t: mpmath.mpf) -> mpmath.mpf:
    x, y, z = (
        mpmath.mpf(a.numerator) / a.denominator + t * b.numerator / b.denominator for a, b in zip(o, d, strict=True)
    )
    return mpmath.hypot(mpmath.hypot(x, y) - mpmath.mpf("0.7"), z) - mpmath.mpf("0.3")


def tangency(rung: Rung) -> list[float]:
    """|least signed distance| from the torus, two units into the ray; a sixth of the rays, for time."""
    distances = []
    with mpmath.workdps(30):
        for o, d in exact_rays(rung)[::6]:
            slope = lambda t, o=o, d=d: mpmath.diff(lambda s: torus_distance(o, d, s), t)  # noqa: E731
            distances.append(float(abs(torus_distance(o, d, mpmath.findroot(slope, 2.0, tol=1e-12)))))
    return distances


def origin_distance(rung: Rung) -> list[float]:
    with mpmath.workdps(PRECISION):
        return [float(abs(torus_distance(o, d, mpmath.mpf(0)))) for o, d in exact_rays(rung)]


def sphere_spacing(rung: Rung) -> list[float]:
    """Between the two first roots: half chords of the two spheres, by their exact squares."""
    gap = Fraction(dict(rung.surface.parameters)["gap"])
    spacings = []
    with mpmath.workdps(PRECISION):
        for o, d in exact_rays(rung):
            length = dot(d, d)
            inner = (dot(o, d) ** 2 - length * (dot(o, o) - 1)) / length**2
            halves = [mpmath.sqrt(mpmath.mpf(q.numerator) / q.denominator) for q in (inner, inner + gap / length)]
            spacings.append(float(halves[1] - halves[0]))
    return spacings


def sine_to(normal: tuple[int, int, int]) -> Callable[[Rung], list[float]]:
    n = tuple(map(Fraction, normal))
    return lambda rung: [root(dot(n, d) ** 2 / (dot(n, n) * dot(d, d))) for _, d in exact_rays(rung)]


def face_distance(rung: Rung) -> list[float]:
    """From the face whose plane the ray is parallel to."""
    rows, axis = np.nonzero(rung.rays[:, 3:] == 0.0)
    assert rows.tolist() == list(range(len(rung.rays)))
    return [abs(abs(float(height)) - 1.0) for height in rung.rays[rows, axis]]


def factor(rung: Rung) -> list[float]:
    point = np.array([[0.25, 0.5, 0.125]])
    return [float((surfaces.evaluate(rung.surface, point) / surfaces.evaluate(surfaces.get("torus"), point))[0])]


def torus_ratio(rung: Rung) -> list[float]:
    parameters = dict(rung.surface.parameters)
    return [float(Fraction(parameters["R"]) / Fraction(parameters["r"]))]


def along_the_axis(rung: Rung) -> list[float]:
    """Distance from the axis, and for rays across it the height above the equator."""
    flat = rung.rays[:, 5] == 0.0
    assert flat.sum() == len(flat) // 2
    return [*from_z_axis(rung), *np.abs(rung.rays[flat, 2]).tolist()]


CAYLEY = [(-0.5, -0.5, -0.5), (-0.5, 0.5, 0.5), (0.5, -0.5, 0.5), (0.5, 0.5, -0.5)]
KUMMER = [(0.0, 0.5, 1.0), (0.0, -0.5, 1.0), (0.5, 0.0, -1.0), (-0.5, 0.0, -1.0)]
AXES = [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]
NODES = {
    "horn_torus": [(0.0, 0.0, 0.0)],
    "spindle_torus": [(0.0, 0.0, 0.5), (0.0, 0.0, -0.5)],
    "nodes_cayley": CAYLEY,
    "nodes_kummer": KUMMER,
    "nodes_barth": AXES,
    "cusp": [(0.0, 0.0, 0.0)],
}
# name: (measure, the largest ratio allowed between it and the rung's parameter)
MEASURES: dict[str, tuple[Callable[[Rung], list[float]], float]] = {
    "grazing": (tangency, 1.2),
    "torus_four_hits": (tangency, 1.5),
    "tangent_plane": (lambda rung: np.abs(rung.rays[:, 2]).tolist(), 1.001),
    "double_root": (sine_to((1, 2, 2)), 1.2),
    "clustered_roots": (sphere_spacing, 1.5),
    "flat_faces": (face_distance, 1.0),
    "lower_degree": (sine_to((1, 0, 0)), 1.001),
    "torus_axis": (along_the_axis, 1.2),
    "thin_torus": (torus_ratio, 1.001),
    **{name: (from_nodes(points), 1.6) for name, points in NODES.items()},
    "double_line": (from_z_axis, 1.2),
    "origin_on_surface": (origin_distance, 1.5),
    "origin_inside": (origin_distance, 1.5),
    "far_origin": (lambda rung: [root(dot(o, o)) for o, _ in exact_rays(rung)[112:113]], 1.0),
    "tiny_coefficients": (factor, 1.001),
    "huge_coefficients": (factor, 1.001),
}


@pytest.mark.parametrize(("name", "rung"), EVERY, ids=IDS)
def test_the_rays_are_at_the_rungs_parameter(name: str, rung: Rung) -> None:
    measure, ratio = MEASURES[name]
    measured = np.array(measure(rung))
    assert len(measured)
    assert (measured <= rung.parameter * ratio).all() and (measured >= rung.parameter / ratio).all()


@pytest.mark.parametrize("name", hardcases.names())
def test_ladders_are_small_and_go_harder_in_unit_float32_rays(name: str) -> None:
    family, rungs = hardcases.get(name), hardcases.rungs(name)
    assert 6 <= len(rungs) <= 10
    parameters = [rung.parameter for rung in rungs]
    assert parameters == sorted(set(parameters), reverse=family.harder == "smaller")
    for rung in rungs:
        assert rung.rays.dtype == np.float32 and 64 <= len(rung.rays) <= 256 and rung.rays.shape[1] == 6
        assert np.abs((rung.rays[:, 3:].astype(float) ** 2).sum(axis=1) - 1.0).max() < 4 * 2.0**-24
        assert len(np.unique(rung.rays, axis=0)) == len(rung.rays)


def test_all_ladders_together_are_the_same_bytes_everywhere() -> None:
    rays = [rung.rays for _, rung in EVERY]
    assert sum(map(len, rays)) <= 20_000
    assert (
        hashlib.sha256(b"".join(r.tobytes() for r in rays)).hexdigest()
        == "6dac65979621dba98326ad64008a9f24608ff18bd1c641b26221953c4f26a05b"
    )


@pytest.mark.parametrize("name", NODES)
def test_singular_points_are_exactly_singular(name: str) -> None:
    surface, points = hardcases.rungs(name)[0].surface, np.array(NODES[name])
    assert not surfaces.evaluate(surface, points).any()
    assert not surfaces.gradient(surface, points).any()


@pytest.mark.parametrize("name", hardcases.names())
def test_every_ray_is_certified_and_every_rung_has_work(name: str) -> None:
    for truth in truths(name):
        assert not (truth.status == TruthStatus.UNDECIDED).any()
        assert np.isfinite(truth.lower).mean() > 0.2


@pytest.mark.parametrize("name", ["grazing", "tangent_plane", "flat_faces", "cusp"])
def test_both_sides_of_a_tangency_are_there(name: str) -> None:
    for truth in truths(name):
        assert np.isfinite(truth.lower).sum() == len(truth.lower) // 2


def test_grazing_rays_hit_exactly_where_they_dip_into_the_torus() -> None:
    for rung, truth in zip(hardcases.rungs("grazing"), truths("grazing"), strict=True):
        for (o, d), hit in zip(exact_rays(rung)[:12], np.isfinite(truth.lower), strict=False):
            with mpmath.workdps(30):
                assert (torus_distance(o, d, mpmath.mpf(2)) < 0) == hit


def test_double_roots_are_touches() -> None:
    for truth in truths("double_root"):
        assert (truth.status == TruthStatus.TOUCH).all()


def test_four_hits_are_four() -> None:
    for rung in hardcases.rungs("torus_four_hits")[:4]:  # where samples can see the near pair
        t = np.linspace(1.0, 5.0, 8001)
        for ray in rung.rays[::4].astype(float):
            values = surfaces.evaluate(rung.surface, ray[:3] + t[:, None] * ray[3:])
            assert (np.diff(values > 0.0) != 0).sum() == 4


def test_the_far_picture_is_the_same_lines_and_the_same_answers() -> None:
    rungs, found = hardcases.rungs("far_origin"), truths("far_origin")
    for rung, truth in zip(rungs, found, strict=True):
        assert (truth.status == found[0].status).all()
        speed = Fraction(2**24 - 1, 2**24)  # the directions' exact length
        for (o, d), (near, same) in zip(exact_rays(rung), exact_rays(rungs[0]), strict=True):
            back = (Fraction(rung.parameter) - Fraction(rungs[0].parameter)) / speed
            assert d == same and dot(d, d) == speed**2
            assert o == tuple(p - back * q for p, q in zip(near, d, strict=True))
        hit = np.isfinite(truth.lower)
        moved = (truth.lower - found[0].lower)[hit] - (rung.parameter - rungs[0].parameter) / float(speed)
        assert np.abs(moved).max() < 1e-8


@pytest.mark.parametrize("name", ["tiny_coefficients", "huge_coefficients"])
def test_a_factor_changes_no_ray_and_no_answer(name: str) -> None:
    rungs, found = hardcases.rungs(name), truths(name)
    for rung, truth in zip(rungs, found, strict=True):
        assert (rung.rays == rungs[0].rays).all() and (truth.status == found[0].status).all()
        hit = np.isfinite(truth.lower)
        assert (truth.lower[hit] <= found[0].upper[hit]).all() and (found[0].lower[hit] <= truth.upper[hit]).all()


def test_an_unknown_family_is_named_with_its_neighbours() -> None:
    with pytest.raises(FirsthitError, match=r"'grasing'.*grazing"):
        hardcases.rungs("grasing")


def test_importing_hard_cases_is_light() -> None:
    code = (
        "import sys, harness.accuracy.rungs\n"
        "print([m for m in ('sympy', 'flint', 'harness.oracle', 'matplotlib') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def answers(truth: Truth) -> Hits:
    """The oracle's own, as a method's."""
    t = 0.5 * (truth.lower + truth.upper)
    status = np.where(np.isfinite(t), RayStatus.HIT, RayStatus.MISS).astype(np.uint8)
    return Hits(t, status, np.ones(len(t), np.int32))


@pytest.mark.parametrize("name", hardcases.names())
def test_the_truth_itself_is_right_everywhere(name: str) -> None:
    for rung, truth in zip(hardcases.rungs(name), truths(name), strict=True):
        for precision in ("float32", "float64"):
            verdict = judge_rung(rung, answers(truth), truth, precision)
            assert verdict == json.loads(json.dumps(verdict, allow_nan=False))
            assert verdict["right"] == verdict["decided"] == verdict["rays"] - verdict["undecidable"]
            assert verdict["undecidable_right"] == verdict["undecidable"]
            assert verdict["worst_ratio"] in (None, 0.0)


def test_what_float32_cannot_know_is_counted_apart_and_float64_is_asked() -> None:
    for rung, truth in zip(hardcases.rungs("grazing"), truths("grazing"), strict=True):
        everywhere = Hits(np.full(len(rung.rays), 2.0), np.ones(len(rung.rays), np.uint8), np.ones(1, np.int32))
        single, double = (judge_rung(rung, everywhere, truth, p) for p in ("float32", "float64"))
        assert double["undecidable"] == 0 and double["false_hits"] == 48
        if rung.parameter < knowable_margin(rung, "float32"):
            assert single["decided"] == 0 and share_right(single) is None
        if rung.parameter > 1e-5:
            assert single["undecidable"] == 0 and single["false_hits"] == 48
    assert 1e-7 < knowable_margin(rung, "float32") < 1e-6


def test_each_wrong_answer_lowers_the_share_and_an_error_is_measured_in_roundings() -> None:
    rung, truth = hardcases.rungs("torus_four_hits")[0], truths("torus_four_hits")[0]
    hits = answers(truth)
    hits.status[:3], hits.t[:3] = RayStatus.MISS, np.nan
    hits.status[3:5], hits.t[3:5] = RayStatus.EXHAUSTED, np.nan
    hits.t[5] = truth.following[5]
    unit = 2.0**-24 * rung.surface.domain.radius * truth.condition
    assert (truth.condition > 1.0).all()
    hits.t[6] += 50.0 * unit[6]
    hits.t[7] -= 20.0 * unit[7]
    verdict = judge_rung(rung, hits, truth, "float32")
    counts = [verdict[key] for key in ("right", "misses", "exhausted", "wrong_root", "false_hits")]
    assert counts == [90, 3, 2, 1, 0]
    assert share_right(verdict) == 90 / 96
    assert np.isclose(verdict["worst_ratio"], 50.0, rtol=1e-3)
    assert np.isclose(verdict["max_error"], max(50.0 * unit[6], 20.0 * unit[7]), rtol=1e-3)


def test_the_first_break_is_the_easiest_rung_that_fails() -> None:
    def verdict(parameter: float, right: int, decided: int = 100) -> dict[str, float]:
        return {"parameter": parameter, "right": right, "decided": decided}

    ladder = [verdict(1e-3, 40), verdict(1e-1, 100), verdict(1e-2, 98), verdict(1e-4, 100), verdict(1.0, 0, 0)]
    assert first_break(ladder, "smaller") == 1e-2
    assert first_break(ladder, "larger") == 1e-3
    assert first_break(ladder, "smaller", share=0.9) == 1e-3
    assert first_break(ladder, "smaller", share=0.2) is None


def test_an_answer_that_can_be_none_is_wrong_on_rays_that_nobody_can_decide() -> None:
    rung, truth = hardcases.rungs("double_root")[0], truths("double_root")[0]
    hits = answers(truth)
    assert judge_rung(rung, hits, truth, "float32")["decided"] == 0
    hits.t[:5] = (np.nan, np.inf, -np.inf, np.nan, np.nan)
    hits.status[:5] = RayStatus.HIT
    hits.status[5:7] = RayStatus.INVALID
    verdict = judge_rung(rung, hits, truth, "float32")
    assert (verdict["invalid"], verdict["decided"], verdict["right"]) == (7, 7, 0)
    assert verdict["rays"] == verdict["decided"] + verdict["undecidable"] + verdict["undecided"]
    assert first_break([verdict], "smaller") == rung.parameter
