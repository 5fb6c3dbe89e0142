"""Figures that cannot be: shares above 100 %, overheads over a clock that is not believed, ratios of wrong rows, fits
and verdicts that the data do not carry."""

from __future__ import annotations

import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest

from harness.contract import FirsthitError, digest
from harness.results import ranks, timings
from harness.running.rows import Samples, time_of
from reports import content
from reports.analysis import choices, count_tests, derive, ties
from reports.drawing import choice, style
from reports.parts import evaluations, growth
from reports.reading import load
from reports.reading.arrays import Arrays
from reports.sentences import answer
from tests.synthetic_run import cell, printed, reported, retime, tiny_run, write_run


def timed(method: str, surface: str, median: float, misses: int = 0, precision: str = "float32") -> dict[str, Any]:
    """A finished cell of any method, with an error and so many misses."""
    made = cell("ray_march", surface, "opencl:intel", precision)
    slot = f"{method} {surface} {precision}"
    made |= {"slot": slot, "key": digest(slot), "method": method, "variant": method, "arrays": None}
    made["accuracy"] |= dict.fromkeys(("false_hits", "exhausted", "wrong_root"), 0) | {"misses": misses}
    return retime(made, median)


def headline(folder: Path, *cells: dict[str, Any], baseline: str | None = None) -> str:
    return answered(derive.derive(load.over(load.load(tiny_run(folder, *cells)).frame, baseline)))


def answered(frame: pd.DataFrame) -> str:
    """Return the first sentence of the first page, and what it says of the gain over the baseline."""
    found = choices.choices(frame)
    return f"{answer.lead(found)} {answer.gain(found)}"


def noisy(made: dict[str, Any], seed: int, spread: float = 0.05) -> dict[str, Any]:
    """The same cell with samples of its own about the same median."""
    draws = np.random.default_rng(seed).normal(1.0, spread, 20)
    made["time"]["samples_ms"] = list(made["time"]["median_ms"] * draws / np.median(draws))
    median, lower, upper, _ = timings.median_interval(made["time"]["samples_ms"])
    made["time"] |= {"median_ms": median, "lower_ms": lower, "upper_ms": upper}
    return made


# ---- overheads


def test_an_overhead_needs_a_device_time_for_each_sample() -> None:
    assert timings.overhead([1.1, 2.2], [1.0, 2.0]) == pytest.approx(0.1)
    assert timings.overhead([1.0, 2.0], [1.02, 2.04]) == 0.0, "within the clocks' own error"
    for wall, device in (([1.0], []), ([], []), ([1.0], [0.0]), ([1.0], [-1.0]), ([1.0], [1.5]), ([1.0], [math.nan])):
        assert timings.overhead(wall, device) is None


def test_no_overhead_is_told_over_a_clock_that_is_not_believed(tmp_path: Path) -> None:
    made = cell("ray_march", "torus", "opengl:llvmpipe", "float32")
    made["time"]["overhead_share"] = 1_734_862.0
    _, report = reported(tiny_run(tmp_path / "run", made))
    text = "\n".join(printed(section.blocks) for section in report.sections)
    assert "overhead 1" not in text and "173486200" not in text


# ---- rounds


def test_how_many_rounds_a_signed_rank_test_needs() -> None:
    for pairs in (1, 5, 6, 7, 8, 9, 20):
        assert ranks.least_chance(pairs) == pytest.approx(ranks.signed_rank(np.arange(1.0, pairs + 1)))
    assert ranks.pairs_needed(0.05) == 6
    assert ties.NEEDED == ranks.pairs_needed(ties.LEVEL) == 8
    assert ranks.least_chance(7) > ties.LEVEL >= ranks.least_chance(8)


def test_the_default_budget_gives_as_many_rounds_as_a_comparison_needs() -> None:
    from harness.experiment.config import BudgetChoice

    assert BudgetChoice().rounds >= ties.NEEDED


@pytest.mark.parametrize(
    ("ratio", "told"),
    [
        (timings.Ratio(0.01, 0.009, 0.011, True, 2**-6, 7), "too few rounds: 7 can at best give a chance of 0.016"),
        (timings.Ratio(0.01, 0.009, 0.011, True, 2**-7, 8), ties.FASTER),
        (timings.Ratio(1.3, 1.2, 1.4, True, 1e-6, 20), ties.SLOWER),
        (timings.Ratio(1.3, 0.9, 1.4, True, 0.2, 20), ties.ALIKE),
        (timings.Ratio(0.963, 0.950, 0.991, True, 0.17, 118), ties.TORN),
        (timings.Ratio(1.1, 0.9, 1.4, True, 1e-4, 20), ties.TORN),
    ],
)
def test_verdicts_on_two_times(ratio: timings.Ratio, told: str) -> None:
    assert ties.verdict(ratio).startswith(told)


def test_the_fastest_is_the_one_that_is_faster_in_common_rounds(tmp_path: Path) -> None:
    """A busy machine in the first rounds alone makes the median of whoever was timed there longest."""
    load_of_rounds = [3.0] * 15 + [1.0] * 5
    slow, quick = timed("slow", "torus", 1.0), timed("quick", "torus", 1.0)
    slow["time"] |= {"samples_ms": [1.1 * x for x in [*load_of_rounds, *[1.0] * 20]], "rounds": list(range(40))}
    quick["time"] |= {"samples_ms": list(load_of_rounds), "rounds": list(range(20))}
    for made in (slow, quick):
        median, lower, upper, _ = timings.median_interval(made["time"]["samples_ms"])
        made["time"] |= {"median_ms": median, "lower_ms": lower, "upper_ms": upper}
    assert slow["time"]["median_ms"] < quick["time"]["median_ms"]
    leading = ties.leaders(derive.derive(load.load(tiny_run(tmp_path / "run", slow, quick)).frame))
    assert leading["variant"].tolist() == ["quick"] and leading["tied"].tolist() == [[]]


# ---- the headline and its baseline


SCENES = ("sphere", "torus", "barth")


def test_a_method_that_wins_one_of_three_does_not_lead(tmp_path: Path) -> None:
    winners = ("bernstein", "newton", "yuksel")
    cells = [
        timed(method, surface, 1.0 if method == winner else 3.0)
        for surface, winner in zip(SCENES, winners, strict=True)
        for method in (*winners, "ray_march")
    ]
    told = headline(tmp_path / "run", *cells)
    assert "come from Bernstein on Sphere (1.00 ms), Newton on Torus (1.00 ms) and Yuksel on Barth" in told
    assert told.endswith("3.00× as fast as Ray march.")


@pytest.mark.parametrize("misses", [0, 14])
def test_a_gain_is_told_over_a_baseline_that_is_right(tmp_path: Path, misses: int) -> None:
    cells = [timed("newton", surface, 1.0) for surface in SCENES]
    cells += [timed("ray_march", surface, 8.0, misses) for surface in SCENES]
    told = headline(tmp_path / "run", *cells)
    assert "come from Newton on Sphere (1.00 ms), Torus (1.00 ms) and" in told
    assert ("8.00× as fast as Ray march" in told) == (misses == 0)
    frame = derive.derive(load.load(tmp_path / "run").frame)
    assert frame["speedup"].notna().all() == (misses == 0)


def test_times_that_are_not_told_apart_have_no_winner(tmp_path: Path) -> None:
    cells = [noisy(timed("newton", surface, 1.0), 1) for surface in SCENES]
    cells += [noisy(timed("yuksel", surface, 1.001), 2) for surface in SCENES]
    told = headline(tmp_path / "run", *cells)
    assert "Newton or Yuksel on" in told or "Yuksel or Newton on" in told
    assert "“or”: times that are not told apart" in told
    frame = derive.derive(load.load(tmp_path / "run").frame)
    table = choice.table(frame)
    assert table is not None
    assert {row[1] for row in table.rows} <= {"Newton ≈ Yuksel", "Yuksel ≈ Newton"}


def test_one_method_alone_is_not_the_fastest(tmp_path: Path) -> None:
    assert headline(tmp_path / "run", timed("newton", "torus", 1.0)).endswith(
        "nothing is compared: Newton takes 1.00 ms. "
    )
    wrong = [timed(method, "torus", 1.0, misses=3) for method in ("newton", "yuksel")]
    assert headline(tmp_path / "wrong", *wrong).endswith(
        "no variant was timed that answers every ray away from silhouettes rightly. "
    )


def test_the_baseline_is_a_setting_of_the_plan_and_of_the_report(tmp_path: Path) -> None:
    cells = [timed(method, "torus", ms) for method, ms in (("newton", 1.0), ("sturm", 4.0), ("ray_march", 8.0))]
    folder = tiny_run(tmp_path / "run", *cells)
    assert "8.00× as fast as Ray march" in answered(derive.derive(load.load(folder).frame))
    plan = json.loads((folder / "plan.json").read_text())
    (folder / "plan.json").write_text(json.dumps(plan | {"baseline": "sturm"}))
    frame = load.load(folder).frame
    assert "4.00× as fast as Sturm" in answered(derive.derive(frame))
    again = derive.derive(load.over(frame, "newton")).set_index("variant")["speedup"]
    assert again.to_dict() == pytest.approx({"newton": 1.0, "sturm": 0.25, "ray_march": 0.125})
    with pytest.raises(FirsthitError, match=r"--baseline: unknown 'strum'; did you mean 'sturm'\?"):
        load.over(frame, "strum")


def test_a_variant_may_be_the_baseline(tmp_path: Path) -> None:
    cells = [
        timed("newton", "torus", ms) | {"variant": name} for name, ms in (("newton[A=1]", 2.0), ("newton[A=2]", 6.0))
    ]
    for i, made in enumerate(cells):
        made |= {"slot": f"newton {i}", "key": digest(f"newton {i}")}
    frame = load.load(tiny_run(tmp_path / "run", *cells)).frame
    over_second = derive.derive(load.over(frame, "newton[A=2]")).set_index("variant")["speedup"]
    assert over_second.to_dict() == pytest.approx({"newton[A=1]": 3.0, "newton[A=2]": 1.0})


# ---- counts


def test_binomial_tails_against_sums_of_products() -> None:
    for of, share in ((1, 0.3), (5, 0.5), (12, 0.01), (12, 0.9)):
        chances = [math.comb(of, k) * share**k * (1 - share) ** (of - k) for k in range(of + 1)]
        for count in range(of + 1):
            assert count_tests.at_least_by_chance(count, of, share) == pytest.approx(sum(chances[count:]))
            assert count_tests.at_most_by_chance(count, of, share) == pytest.approx(sum(chances[: count + 1]))
    assert count_tests.at_most_by_chance(0, 16_384, 0.001) == pytest.approx(0.999**16_384)


def test_two_rays_of_16384_are_no_more_than_none() -> None:
    assert count_tests.exceeds(2, 16_384, 0, 16_384) is None
    assert count_tests.exceeds(2, 16_384, 0, 16_384, factor=2.0) is None
    assert count_tests.exceeds(40, 16_384, 0, 16_384, factor=2.0, tries=15) is True
    assert count_tests.exceeds(40, 16_384, 40, 16_384, factor=2.0) is False
    assert count_tests.exceeds(40, 16_384, 40, 16_384) is None
    assert count_tests.exceeds(0, 16_384, 40, 16_384) is False
    assert count_tests.exceeds(5, 0, 0, 100) is None, "no ray, no verdict"


def test_a_tenth_of_a_percent_needs_rays() -> None:
    assert count_tests.share_exceeds(0, 100, 0.001) is None
    assert count_tests.share_exceeds(0, 16_384, 0.001) is False
    assert count_tests.share_exceeds(1, 1000, 0.001) is None
    assert count_tests.share_exceeds(60, 16_384, 0.001) is True


def test_equal_rates_are_told_apart_as_seldom_as_promised(rng: Any) -> None:
    pairs = rng.binomial(16_384, 0.002, (2000, 2))
    told = [count_tests.exceeds(int(a), 16_384, int(b), 16_384) for a, b in pairs]
    assert np.mean([verdict is True for verdict in told]) <= count_tests.LEVEL + 0.005
    assert np.mean([verdict is False for verdict in told]) <= count_tests.LEVEL + 0.005


# ---- fits and evaluations


def test_a_fit_through_three_surfaces_is_refused_with_its_reason(tmp_path: Path) -> None:
    cells = [timed("newton", surface, ms) for surface, ms in zip(SCENES, (1.0, 9.0, 2.0), strict=True)]
    frame = derive.derive(load.load(tiny_run(tmp_path / "run", *cells)).frame)
    (section,) = growth.sections(SimpleNamespace(listed=frame, marks=style.variant_marks([("newton", "newton")])))
    told = printed((*section.blocks, *section.details))
    assert "3 points do not determine an exponent: the 95 % interval of 0.90, −" in told
    assert "| Newton | 3 | – | – | – |" in told
    (figure,) = [block for block in section.details if isinstance(block, content.Figure)]
    assert figure.caption.startswith("No exponent is determined")


def test_evaluations_have_one_denominator_or_say_which(tmp_path: Path) -> None:
    spent = np.zeros((8, 8), np.int32)
    spent[:2] = 4
    blank = np.zeros((8, 8))
    made = Arrays(*(blank.astype(kind) for kind in ("u1", "f4", "u1", "?", "f4")), evaluations=spent)
    row = next(derive.derive(load.load(tiny_run(tmp_path / "run", timed("newton", "torus", 1.0))).frame).itertuples())
    note = evaluations._panel(row, made, 10).note
    assert note.startswith("1.00 per ray cast, 4.00 per ray that spends any, at most 4")


# ---- every table of a report


SHARES = ("share\nof peak", "±", "right", "overhead", "discarded", "scatter")


def test_no_table_prints_a_figure_that_cannot_be(tmp_path: Path) -> None:
    run, report = reported(write_run(tmp_path / "run"))
    frame = derive.derive(run.frame, run.plan.peaks)
    right = frame[derive.all_right(frame) | ~frame["answers"].astype(bool)]
    sound = set(right[["label", "device", "precision"]].itertuples(index=False, name=None))
    seen = set()
    for section in (report.summary, *report.sections):
        for table in (b for b in (*section.blocks, *section.details) if isinstance(b, content.Table)):
            titles = [column.title for column in table.columns]
            for line in table.rows:
                for column, value in zip(table.columns, line, strict=True):
                    told = column.show(value)
                    if not isinstance(value, int | float | np.number) or value != value:
                        continue
                    assert "nan" not in told
                    if column.title in SHARES:
                        seen.add(column.title)
                        assert 0.0 <= value <= 1.0, (table.title, column.title, value)
                    if column.show is content.wording.count:
                        assert value >= 0
                if "speed-\nup" in titles and "variant" in titles:
                    place = line[titles.index("variant")], line[titles.index("device")], line[titles.index("precision")]
                    ratio = line[titles.index("speed-\nup")]
                    assert ratio != ratio or place in sound, "a ratio of a row with wrong rays"
                    seen.add("ratio")
                if "from" in titles:
                    low, high = (line[titles.index(name)] for name in ("from", "to"))
                    middle = line[titles.index("times\nits time")]
                    assert low is None or low <= middle <= high, "an interval that excludes its median"
                    seen.add("interval")
    assert {"share\nof peak", "±", "overhead", "ratio", "interval"} <= seen
    timed_rows = run.frame[run.frame["median_ms"].notna()]
    assert (
        (timed_rows["lower_ms"] <= timed_rows["median_ms"]) & (timed_rows["median_ms"] <= timed_rows["upper_ms"])
    ).all()


# ---- the runner


class _Slow:
    """Repetitions of so many seconds each by the runner's own clock; what a cell's end is decided from."""

    def __init__(self, seconds: float) -> None:
        from harness.experiment.config import BudgetChoice

        self.seconds, self.budget = seconds, BudgetChoice(seconds=1.0)

    def rounds(self) -> int:
        from harness.running.runner import Runner

        runner: Any = SimpleNamespace(_config=SimpleNamespace(budget=self.budget))
        state: Any = SimpleNamespace(samples=Samples("wall"), timing=0.0)
        while True:
            taken = len(state.samples.wall_ms)
            state.samples.add((1e3 * self.seconds * (1.0 + 0.3 * (taken % 2)), None, self.seconds), taken, 0)
            state.timing += self.seconds
            if Runner._is_done(runner, state):
                return taken + 1


@pytest.mark.parametrize(("seconds", "least", "most"), [(0.05, 20, 20), (0.3, 8, 8), (1.3, 8, 8), (10.0, 2, 2)])
def test_a_slow_cell_is_timed_in_enough_rounds_to_compare_it_but_not_for_ever(
    seconds: float, least: int, most: int
) -> None:
    assert least <= _Slow(seconds).rounds() <= most


@pytest.mark.parametrize(("clock", "told"), [("device", 0.25), ("wall", None)])
def test_a_row_has_an_overhead_only_where_the_devices_clock_is_believed(clock: str, told: float | None) -> None:
    samples = Samples(clock, [1.25] * 9, [1.0] * 9, list(range(9)))
    found = time_of(samples, 1, "s", seed=1, interval=0.02)["overhead_share"]
    assert found == (None if told is None else pytest.approx(told))


def test_a_variant_is_no_gain_over_its_own_method(tmp_path: Path) -> None:
    cells = [
        timed("newton", "torus", ms) | {"variant": name} for name, ms in (("newton[A=1]", 2.0), ("newton[A=2]", 6.0))
    ]
    cells.append(timed("ray_march", "torus", 9.0))
    for i, made in enumerate(cells):
        made |= {"slot": f"newton {i}", "key": digest(f"newton {i}")}
    told = headline(tmp_path / "run", *cells, baseline="newton[A=1]")
    assert told.endswith("come from Newton (a = 1) on Torus (2.00 ms). "), "no gain"
    assert "4.50× as fast as Ray march" in headline(tmp_path / "again", *cells)
