"""Rank tests against published values and against their own normal form."""

import itertools

import numpy as np
import pytest

from harness.results import ranks
from harness.results.ranks import rank_sum, signed_rank


def test_the_depression_scale_of_hollander_and_wolfe():
    """Hollander and Wolfe 1973, page 29 f.: T+ = 40, one-sided 0.0195."""
    before = [1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30]
    after = [0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29]
    assert signed_rank(np.subtract(before, after)) == pytest.approx(2 * 0.01953125, abs=1e-12)


def test_the_permeability_of_hollander_and_wolfe():
    """Hollander and Wolfe 1973, page 69 f.: one-sided 0.1272."""
    at_term = [0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46]
    earlier = [1.15, 0.88, 0.90, 0.74, 1.21]
    assert rank_sum(at_term, earlier) == pytest.approx(2 * 0.1272, abs=5e-5)
    assert rank_sum(earlier, at_term) == pytest.approx(rank_sum(at_term, earlier))


@pytest.mark.parametrize(("count", "critical"), [(6, 0), (8, 3), (10, 8), (15, 25), (20, 52), (25, 89)])
def test_wilcoxons_table_of_critical_values(count, critical):
    """The largest smaller rank sum that is significant at 5 %, two-sided (Wilcoxon and Wilcox 1964, table 1)."""

    def chance(smaller_sum):
        signs, left = np.ones(count), smaller_sum
        for rank in range(count, 0, -1):
            if rank <= left:
                signs[rank - 1], left = -1.0, left - rank
        assert left == 0
        return signed_rank(signs * np.arange(1, count + 1))

    assert chance(critical) <= 0.05 < chance(critical + 1)


@pytest.mark.parametrize(("m", "n", "critical"), [(4, 4, 0), (5, 5, 2), (8, 8, 13), (10, 10, 23), (7, 12, 18)])
def test_mann_and_whitneys_table_of_critical_values(m, n, critical):
    """The largest U that is significant at 5 %, two-sided (Milton 1964)."""

    def chance(u):
        second = np.arange(1.0, n + 1)
        firsts = np.zeros(m)  # each beats no second one, then as many as u asks for
        for i in range(m):
            beaten = min(n, u)
            firsts[i], u = beaten + 0.5 + i * 1e-3, u - beaten
        return rank_sum(firsts, second)

    assert chance(critical) <= 0.05 < chance(critical + 1)


def test_ties_are_exact_too(rng):
    """Against every permutation, counted."""
    first, second = [1.0, 2.0, 2.0, 5.0], [2.0, 3.0, 5.0, 5.0, 6.0]
    joined = np.array(first + second)
    mid_ranks = np.array([np.mean(np.flatnonzero(np.sort(joined) == value) + 1) for value in joined])
    sums = [mid_ranks[list(chosen)].sum() for chosen in itertools.combinations(range(9), 4)]
    low = np.mean(np.array(sums) <= mid_ranks[:4].sum() + 1e-9)
    assert rank_sum(first, second) == pytest.approx(2 * low)

    differences = rng.integers(-3, 4, 12).astype(float)
    kept = differences[differences != 0.0]
    size = np.array([np.mean(np.flatnonzero(np.sort(np.abs(kept)) == abs(value)) + 1) for value in kept])
    sums = [size[np.array(signs)].sum() for signs in itertools.product([False, True], repeat=len(kept))]
    at = size[kept > 0].sum()
    tail = min(np.mean(np.array(sums) <= at + 1e-9), np.mean(np.array(sums) >= at - 1e-9))
    assert signed_rank(differences) == pytest.approx(min(1.0, 2 * tail))


def test_the_normal_form_takes_over_smoothly(rng, monkeypatch):
    draws = [(rng.normal(0.0, 1.0, 20), rng.normal(0.4, 1.0, 20)) for _ in range(100)]
    exact = [(signed_rank(a - b), rank_sum(a, b)) for a, b in draws]
    monkeypatch.setattr(ranks, "EXACT", 0)
    assert np.max(np.abs(np.subtract(exact, [(signed_rank(a - b), rank_sum(a, b)) for a, b in draws]))) < 0.01


def test_nothing_to_compare_is_no_difference():
    assert signed_rank([]) == signed_rank([0.0, 0.0]) == rank_sum([], [1.0]) == rank_sum([2.0] * 50, [2.0] * 50) == 1.0


def test_equal_distributions_are_told_apart_as_often_as_promised(rng):
    chances = [rank_sum(rng.exponential(size=8), rng.exponential(size=8)) for _ in range(600)]
    assert np.mean(np.array(chances) <= 0.05) < 0.075
