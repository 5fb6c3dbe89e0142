import numpy as np
import pytest

from harness.measure import is_narrow, median_interval


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
