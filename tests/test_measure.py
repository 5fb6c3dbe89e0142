import numpy as np
import pytest

from harness.results.timings import bootstrap_interval, is_narrow, median_interval, paired_ratio, steadiness


def test_under_six_samples_nothing_is_proved():
    assert median_interval([3.0, 1.0, 2.0]) == (2.0, 1.0, 3.0, False)
    assert not is_narrow([1.0] * 5, 0.5)


def test_six_samples_enclose_the_median_by_their_extremes():
    assert median_interval([6.0, 1.0, 2.0, 3.0, 4.0, 5.0]) == (3.5, 1.0, 6.0, True)


@pytest.mark.parametrize("count", [6, 9, 20, 51])
def test_the_interval_covers_the_median_at_least_95_times_in_100(count, rng):
    draws = rng.lognormal(size=(4000, count))
    intervals = [median_interval(list(draw)) for draw in draws]
    covered = np.mean([lower <= 1.0 <= upper for _, lower, upper, _ in intervals])  # the median of lognormal is 1
    assert covered > 0.94


def test_narrow_is_about_the_interval_not_the_spread():
    samples = [1.0] * 50 + [9.0] * 3
    assert is_narrow(samples, 0.02)
    assert not is_narrow([1.0, 2.0] * 10, 0.02)


def test_no_samples_is_an_error():
    with pytest.raises(ValueError, match="no samples"):
        median_interval([])


@pytest.mark.parametrize(("count", "least"), [(8, 0.86), (15, 0.87), (60, 0.9)])
def test_the_bootstrap_promises_too_much_with_few_samples(count, least, rng):
    """Why it decides nothing: the order-statistic interval covers, the bootstrap's falls short, most at 8 samples."""
    draws = rng.lognormal(sigma=0.2, size=(500, count))
    intervals = [bootstrap_interval(list(draw), seed=i) for i, draw in enumerate(draws)]
    covered = np.mean([lower <= 1.0 <= upper for lower, upper in intervals])
    assert least < covered < (0.945 if count < 60 else 0.97)


def test_the_bootstrap_is_the_same_for_the_same_seed():
    samples = [1.0, 1.1, 1.2, 1.5, 2.0, 1.05]
    assert bootstrap_interval(samples, 3) == bootstrap_interval(samples, 3)
    assert bootstrap_interval([1.0] * 9, 1) == (1.0, 1.0)


def test_drift_is_told_with_what_to_do_about_it(rng):
    steady = list(1.0 + 0.01 * rng.standard_normal(30))
    assert steadiness(steady)["warnings"] == []
    told = steadiness([time * (1.0 if i < 15 else 1.2) for i, time in enumerate(steady)])
    assert told["drift_share"] == pytest.approx(0.2, abs=0.02)
    assert told["drift_chance"] < 1e-6
    assert told["warnings"][0].startswith("drifts: the second half is 19% slower")
    assert "--force" in told["warnings"][0]


def test_noise_is_told_and_outliers_are_counted_and_kept(rng):
    noisy = list(rng.uniform(1.0, 1.6, 60))
    assert [text.partition(":")[0] for text in steadiness(noisy)["warnings"]] == ["noisy"]
    calm = [1.0, 1.01, 0.99, 1.0, 1.02, 0.98, 1.0, 1.01, 9.0]
    assert steadiness(calm)["outliers"] == 1
    assert steadiness(calm)["warnings"] == []
    assert steadiness([1.0, 9.0]) == {
        "drift_share": None,
        "drift_chance": None,
        "spread_share": None,
        "outliers": 0,
        "warnings": [],
    }


def test_pairing_by_round_cancels_what_slows_a_whole_round(rng):
    load = rng.lognormal(sigma=0.5, size=40)
    first = list(1.1 * load * (1.0 + 0.01 * rng.standard_normal(40)))
    second = list(load * (1.0 + 0.01 * rng.standard_normal(40)))
    ratio = paired_ratio(first[:25], range(25), second, range(40))
    assert ratio is not None
    assert ratio.pairs == 25
    assert ratio.proved
    assert 1.08 < ratio.lower <= ratio.median <= ratio.upper < 1.12
    assert ratio.chance < 1e-4
    turned = paired_ratio(second, range(40), first[:25], range(25))
    assert turned is not None
    assert turned.median == pytest.approx(1.0 / ratio.median)


def test_rounds_that_do_not_meet_give_no_ratio():
    assert paired_ratio([1.0], [0], [2.0], [1]) is None
    few = paired_ratio([1.0, 2.0], [3, 5], [2.0, 4.0], [3, 5])
    assert few is not None
    assert (few.median, few.proved) == (0.5, False)


@pytest.mark.parametrize("count", [6, 100, 1029, 1030, 20_000])
def test_the_interval_of_many_samples_is_that_of_the_normal_distribution(count):
    _, lower, upper, proved = median_interval([float(x) for x in range(count)])
    assert proved
    assert abs((upper - lower) - 1.96 * count**0.5) <= 2.0 + 0.02 * count**0.5
