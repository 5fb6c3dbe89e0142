import numpy as np

from harness.accuracy import Wrong, clear_rays, deviations, judge, summarize, wrong_share
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
    assert clear_rays(single) == 1
    assert wrong_share(single) == 1.0
    assert wrong_share(double) == 1.0
    assert judge(hits, truth, 2.0, 1e-3, "float32").clear.tolist() == [False, False, False, True]


def test_errors_on_drowned_rays_give_no_quantiles():
    truth = _truth([1, 1], [1.0, 1.0], [np.inf] * 2, [1.0, 1.0], [1e-9, 1.0])
    summary = _summary(_hits([1.01, 1.001], [1, 1]), truth)
    assert np.isclose(summary["error"]["max"], 0.001)
