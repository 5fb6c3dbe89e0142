"""Groups of very many rows: what is computed at once is what rows tell one by one, and figures say what they omit."""

from __future__ import annotations

import json
import random
from typing import Any

import pandas as pd
import pytest

from reports.analysis import rounds, ties
from reports.drawing import fronts


def timed(rng: random.Random, count: int) -> pd.DataFrame:
    """Make up rows of one group, fastest first: most have the same rounds, some fewer, and some another session."""
    rows = []
    for i in range(count):
        rounds_of = list(range(rng.choice([12, 12, 12, 9])))
        level = rng.choice([1.0, 1.0, 1.05, 2.0])
        samples = [level * rng.uniform(0.97, 1.03) for _ in rounds_of]
        told = {"method": rng.choice("abc"), "variant": f"v{i}", "key": f"k{i}", "samples_ms": samples}
        told |= {"session": rng.choice(["s", "s", "t", None]), "rounds": json.dumps(rounds_of)}
        median = sorted(samples)[len(samples) // 2]
        rows.append(told | {"median_ms": median, "lower_ms": 0.99 * median, "upper_ms": 1.01 * median})
    return pd.DataFrame(rows).sort_values("median_ms", kind="stable")


def one_by_one(rows: list[Any]) -> Any:
    first = rows[0]
    for row in rows[1:]:
        paired = rounds.ratio(row, first)
        if paired is not None and ties.verdict(paired) == ties.FASTER:
            first = row
    return first


@pytest.mark.parametrize("seed", range(6))
def test_the_fastest_of_a_group_is_that_which_comparing_row_by_row_finds(seed: int) -> None:
    rows = timed(random.Random(seed), 40)
    assert ties.best(rows).key == one_by_one(list(rows.itertuples())).key
    shuffled = rows.sample(frac=1.0, random_state=seed)  # where the medians are of other rounds, another may be first
    assert ties.best(shuffled).key == one_by_one(list(shuffled.itertuples())).key


def test_a_row_of_a_group_is_compared_at_once_as_it_is_alone() -> None:
    rows = timed(random.Random(1), 30)
    first = next(rows.itertuples())
    for found, row in zip(rounds.medians_over(rows, first), rows.itertuples(), strict=True):
        alike = row.session == first.session and row.rounds == first.rounds
        assert found == pytest.approx(rounds.times_over(row, first)) if alike else pd.isna(found)


def test_a_figure_of_very_many_rows_keeps_those_that_tell_most() -> None:
    count = 10 * fronts.MOST_DRAWN
    rows = pd.DataFrame(
        {
            "precision": ["float32", "float64"] * (count // 2),
            "method": [f"m{i % 5}" for i in range(count)],
            "variant": [f"m{i % 5}[K={i}]" for i in range(count)],
            "front": [i % 997 == 3 for i in range(count)],
            "baseline": "m1[K=1001]",
        }
    )
    kept = fronts._most_telling(rows, "m2[K=2002]")
    assert fronts.MOST_DRAWN / 2 < len(kept) < 1.1 * fronts.MOST_DRAWN
    assert kept["front"].sum() == rows["front"].sum() and {"m1[K=1001]", "m2[K=2002]"} <= set(kept["variant"])
    first_of_each = rows.drop_duplicates(["precision", "method"]).index
    assert set(first_of_each) <= set(kept.index), "of each method the fastest, which comes first"
    assert len(fronts._most_telling(rows.head(9), "")) == 9
