import itertools
import json

import numpy as np
import pytest

from harness.accuracy.judge import (
    NAMES,
    Wrong,
    deviations,
    judge,
    judged,
    nothing_judged,
    summarize,
    undecided_hits,
    undecided_too_many,
    wrong_share,
)
from harness.contract import Box, Hits, Surface, Truth

BALL = Surface("ball", "Ball", "x^2 + y^2 + z^2 - 4", Box((-4, -4, -4), (4, 4, 4)), "test", 2, bounding_radius=2.0)


def _truth(status, lower, following, margin, contrast=None):
    lower = np.array(lower, float)
    return Truth(
        lower,
        lower,
        np.array(status, np.uint8),
        np.array(following, float),
        np.ones(len(lower)),
        np.array(margin),
        np.full(len(lower), np.inf) if contrast is None else np.array(contrast),
    )


def _hits(t, status):
    return Hits(np.array(t, float), np.array(status, np.uint8), np.arange(len(t), dtype=np.int32))


def _summary(hits, truth, margin=1e-3, footprint=0.01, precision="float32", surface=BALL):
    verdicts = judge(hits, truth, 2.0, margin, precision)
    rays = np.tile(np.float32([0, 0, 3, 0, 0, -1]), (len(hits.t), 1))
    found = deviations(surface, rays, hits, truth, verdicts)
    return summarize(
        surface, hits, truth, verdicts, found, precision=precision, footprint=footprint, grazing_margin=margin
    )


def test_each_kind_of_wrong_answer_is_told_apart():
    nan, inf = np.nan, np.inf
    truth = _truth(
        [1, 1, 0, 1, 1, 1, 3, 2, 0],
        [1.0, 1.0, nan, 1.0, 1.0, 1.0, nan, 1.0, nan],
        [2.0, 2.0, inf, 2.0, 2.0, inf, inf, inf, inf],
        [inf] * 9,
    )
    hits = _hits([1.0001, nan, 3.0, nan, 1.9, 1.2, 1.0, 1.0, nan], [1, 0, 1, 2, 1, 1, 1, 1, 2])
    verdicts = judge(hits, truth, scene_radius=1.0, grazing_margin=1e-3)
    expected = [Wrong.RIGHT, Wrong.MISS, Wrong.FALSE_HIT, Wrong.EXHAUSTED, Wrong.WRONG_ROOT, Wrong.WRONG_ROOT]
    assert list(verdicts.wrong) == [*expected, Wrong.RIGHT, Wrong.RIGHT, Wrong.EXHAUSTED]
    assert np.isfinite(verdicts.error).tolist() == [True] + [False] * 6 + [True, False]


def test_grazing_rays_are_counted_apart_and_give_no_errors():
    truth = _truth([1, 1, 1], [1.0, 1.0, 1.0], [np.inf] * 3, [1e-4, 1e-2, np.inf])
    hits = _hits([np.nan, 1.001, 1.002], [0, 1, 1])
    summary = _summary(hits, truth)
    assert (summary["grazing"], summary["grazing_misses"], summary["misses"]) == (1, 1, 0)
    assert np.isclose(summary["error"]["max"], 0.002)
    assert np.isclose(summary["relative_error"]["max"], 0.001)
    assert np.isclose(summary["pixel_error"]["max"], 0.2)
    assert wrong_share(summary) == 0.0


def test_error_is_the_distance_from_the_certified_interval():
    truth = Truth(*(np.array([v]) for v in (1.0, 1.5, 1, np.inf, 1.0, np.inf, np.inf)))
    for t, error in ((1.25, 0.0), (0.9999, 1e-4), (1.5003, 3e-4)):
        assert np.isclose(judge(_hits([t], [1]), truth, 1.0, 0.0).error[0], error, atol=1e-12)


def test_a_method_that_finds_nothing_is_wholly_wrong():
    truth = _truth([1, 1, 0], [1.0, 1.0, np.nan], [np.inf] * 3, [np.inf] * 3)
    hits = _hits([np.nan] * 3, [0] * 3)
    summary = _summary(hits, truth)
    assert summary["misses"] == 2
    assert summary["error"]["max"] is None
    assert np.isclose(wrong_share(summary), 2 / 3)


def test_error_is_told_in_every_unit():
    """A ray down the z axis at a sphere of radius 2 from z = 3: the root is t = 1, f' there 4, the terms' sum 8."""
    slope, terms, domain = 4.0, 8.0, BALL.domain.radius
    truth = Truth(*(np.array([v]) for v in (1.0, 1.0, 1, 5.0, terms / (slope * domain), np.inf, np.inf)))
    summary = _summary(_hits([1.0 + 2.0**-10], [1]), truth)
    error = 2.0**-10
    for name, value in {
        "error": error,
        "relative_error": error / 2.0,
        "feature_error": error / 2.0,
        "pixel_error": error / 0.01,
        "ulp_error": error / 2.0**-23,
        "condition_ratio": error / (2.0**-24 * domain),
        "normal_error_degrees": 0.0,
    }.items():
        assert np.isclose(summary[name]["max"], value, rtol=1e-6, atol=1e-9), name
    assert np.isclose(summary["residual"]["max"], (4.0 - (2.0 - error) ** 2) / terms, rtol=1e-3)


def test_the_normal_error_is_the_angle_between_gradients():
    tilted = Surface("t", "T", "z - x^2", Box((-4, -4, -4), (4, 4, 4)), "test", 2)
    rays = np.array([[0, 0, 0, 1, 0, 0]], np.float32)
    truth = Truth(*(np.array([v]) for v in (0.0, 0.0, 1, np.inf, 1.0, np.inf, np.inf)))
    hits = _hits([0.05], [1])
    found = deviations(tilted, rays, hits, truth, judge(hits, truth, 4.0, 0.0))
    assert np.isclose(found.normal[0], np.degrees(np.arctan(0.1)))


NAN, INF = np.nan, np.inf
ANSWERS = (1.0, 0.5, -1.0, 0.0, 1e300, -1e300, NAN, INF, -INF)


@pytest.mark.parametrize("status", range(8))
def test_right_is_only_what_is_shown_to_be_right(status):
    """Every t with every status, against a hit at 1, a miss and an undecided ray: what can be no answer is invalid,
    whatever the truth."""
    t = np.array(ANSWERS)
    nowhere = np.zeros(len(t), bool)
    for truth_status, root in ((1, 1.0), (2, 1.0), (0, NAN), (3, NAN)):
        truth = _truth([truth_status] * len(t), [root] * len(t), [INF] * len(t), [INF] * len(t))
        verdicts = judge(_hits(t, [status] * len(t)), truth, 2.0, 1e-3)
        right = verdicts.wrong == Wrong.RIGHT
        hit_right = (t == 1.0) if truth_status in (1, 2) else np.isfinite(t) if truth_status == 3 else nowhere
        expected = {0: np.full(len(t), truth_status in (0, 3)), 1: hit_right, 2: np.full(len(t), truth_status == 3)}
        assert (right == expected.get(status, nowhere)).all(), (status, truth_status)
        invalid = verdicts.wrong == Wrong.INVALID
        assert (invalid == (~np.isfinite(t) if status == 1 else np.full(len(t), status > 2))).all()
        assert (np.isfinite(verdicts.error) == (right & (truth_status in (1, 2)) & (status == 1))).all()


def test_a_root_whose_bounds_are_no_numbers_is_met_by_no_hit():
    truth = _truth([1, 1, 1], [NAN, 1.0, INF], [INF, NAN, INF], [INF] * 3)
    verdicts = judge(_hits([1.0, 1.0, 1.0], [1, 1, 1]), truth, 2.0, 1e-3)
    assert (verdicts.wrong == Wrong.WRONG_ROOT).all()


def test_a_kernel_that_answers_nan_is_wholly_wrong():
    truth = _truth([1, 1, 0, 0], [1.0, 1.0, NAN, NAN], [INF] * 4, [INF] * 4)
    summary = _summary(_hits([NAN] * 4, [1] * 4), truth)
    assert (summary["invalid"], summary["misses"], summary["wrong_root"], summary["false_hits"]) == (4, 0, 0, 0)
    assert wrong_share(summary) == 1.0
    assert summary["error"]["max"] is None
    json.dumps(summary, allow_nan=False)


def test_evaluations_are_of_rays_that_were_answered():
    truth = _truth([0, 0, 0], [NAN] * 3, [INF] * 3, [INF] * 3)
    hits = Hits(np.full(3, NAN), np.array([0, 0, 3], np.uint8), np.array([4, 8, 0], np.int32))
    assert _summary(hits, truth)["evaluations_mean"] == 6.0
    none = Hits(np.full(3, NAN), np.full(3, 3, np.uint8), np.zeros(3, np.int32))
    assert _summary(none, truth)["evaluations_mean"] is None


def test_where_nothing_is_judged_no_share_is_wrong_and_none_is_right():
    truth = _truth([1, 3], [1.0, NAN], [INF] * 2, [0.0, INF])
    hits = _hits([1.0, NAN], [1, 0])
    summary = _summary(hits, truth)
    assert (summary["judged"], summary["grazing"], summary["undecided"]) == (0, 1, 1)
    assert wrong_share(summary) is None
    assert not judged(truth, judge(hits, truth, 2.0, 1e-3)).any()
    assert "nothing to judge" in nothing_judged(2)


def test_undecided_rays_dilute_no_share():
    truth = _truth([1, 1, 3, 3], [1.0, 1.0, NAN, NAN], [INF] * 4, [INF] * 4)
    assert wrong_share(_summary(_hits([1.0, NAN, 1.0, NAN], [1, 0, 1, 0]), truth)) == 0.5
    assert wrong_share(_summary(_hits([NAN] * 4, [1] * 4), truth)) == 1.0, "an invalid answer to an undecided ray too"


@pytest.mark.parametrize(
    ("hits", "undecided", "most", "holds"),
    [(99, 1, 0.01, True), (98, 2, 0.01, False), (0, 0, 0.01, True), (0, 1, 0.01, False), (100, 0, 0.0, True),
     (100, 1, 0.0, False), (0, 5, 1.0, True), (0, 5, float("nan"), False)],
)  # fmt: skip
def test_a_truth_with_too_many_undecided_hits_measures_nothing(hits, undecided, most, holds):
    reason = undecided_hits(hits, undecided, most)
    assert (reason is None) == holds
    assert holds or f"{undecided} of {hits + undecided} hits undecided" in reason
    statuses = [1] * hits + [3] * undecided + [0] * 7
    truth = _truth(statuses, [NAN] * len(statuses), [INF] * len(statuses), [INF] * len(statuses))
    assert undecided_too_many(truth, most) == reason


def test_every_kind_of_wrong_ray_has_a_name_of_its_own():
    assert set(NAMES) == set(Wrong) - {Wrong.RIGHT}
    assert all(a != b for a, b in itertools.combinations(NAMES.values(), 2))


def test_drowned_rays_are_counted_apart_by_precision_and_never_twice():
    """Contrast 1e-9 is under float32's roundoff, 6e-8, and far over float64's; a grazing ray stays one."""
    truth = _truth(
        [0, 0, 1, 0], [np.nan, np.nan, 1.0, np.nan], [np.inf] * 4, [1.0, 1e-4, 1.0, 1.0], [1e-9, 1e-9, 1e-9, 1.0]
    )
    hits = _hits([1.0, 1.0, np.nan, 1.0], [1, 1, 0, 1])
    single, double = _summary(hits, truth), _summary(hits, truth, precision="float64")
    assert (single["grazing"], single["drowned"], double["drowned"]) == (1, 2, 0)
    assert (single["drowned_false_hits"], single["grazing_false_hits"], single["false_hits"]) == (1, 1, 1)
    assert (single["drowned_misses"], single["misses"]) == (1, 0)
    assert (double["drowned_false_hits"], double["grazing_false_hits"], double["false_hits"]) == (0, 1, 2)
    assert single["judged"] == 1
    assert wrong_share(single) == 1.0
    assert wrong_share(double) == 1.0
    assert judge(hits, truth, 2.0, 1e-3, "float32").clear.tolist() == [False, False, False, True]


def test_errors_on_drowned_rays_give_no_quantiles():
    truth = _truth([1, 1], [1.0, 1.0], [np.inf] * 2, [1.0, 1.0], [1e-9, 1.0])
    summary = _summary(_hits([1.01, 1.001], [1, 1]), truth)
    assert np.isclose(summary["error"]["max"], 0.001)
