"""The claims checklist: complete data, and verdicts that planted rows flip."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from harness.contract import digest
from harness.plugins import find_methods
from reports import claims
from reports.analysis import derive
from reports.claims import Claim, Outcome, picks
from reports.claims.evidence import Evidence, Pick
from reports.reading import load
from reports.reading.arrays import Shelf
from tests import stated_settings
from tests.agreeing_rows import PERCENTILES
from tests.synthetic_run import cell, retime, sampled, tiny_run

ROOT = Path(__file__).parent.parent


def planted(pick: Pick, surface: str, median: float, view: str = "front", **accuracy: Any) -> dict[str, Any]:
    """Make a finished cell of `pick` that took `median` ms; `accuracy` replaces what is made up."""
    made = cell("ray_march", "torus", "opencl:intel", "float32")
    slot = f"{pick.words} {pick.method} {surface} {view}"
    made |= {"slot": slot, "key": digest(slot), "method": pick.method, "variant": pick.words, "surface": surface}
    made |= {"parameters": dict(pick.knobs), "surface_title": surface, "view": view, "arrays": None, "answers": True}
    made |= {"comparison": f"{surface} {view} 256x256x1 compute", "degree": 8}
    retime(made, median)["time"].update(lower_ms=0.99 * median, upper_ms=1.01 * median, session="one")  # in turns
    clean = dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root"), 0)
    made["accuracy"] |= clean | {f"grazing_{name}": 0 for name in clean} | accuracy
    return made


def evidence(folder: Path, *cells: dict[str, Any], studies: dict[str, Any] | None = None) -> Evidence:
    """Write a run of these cells into `folder`, and return it as evidence with the rows of `studies`."""
    run = load.load(tiny_run(folder, *cells))
    return Evidence(derive.derive(run.frame), studies or {}, Shelf(run.folders))


def claim(paper: str, words: str) -> Claim:
    """Return the one claim of `paper` whose text has these words in it."""
    (found,) = (c for c in claims.CLAIMS if c.paper == paper and words in c.text)
    return found


def test_claims_name_configs_and_methods_that_exist() -> None:
    for stated in claims.CLAIMS:
        assert bool(stated.config) != bool(stated.reason), stated.text
        assert not stated.config or (ROOT / "configs" / stated.config).is_file(), stated.text
        assert all((ROOT / "methods" / name).is_dir() for name in stated.methods), stated.text
    assert {stated.paper for stated in claims.CLAIMS} == {"toledo2007", "szente", "beamcasting"}
    assert len({(c.paper, c.text) for c in claims.CLAIMS}) == len(claims.CLAIMS)


def test_without_rows_no_claim_is_decided_and_each_says_what_would(tmp_path: Path) -> None:
    nothing = evidence(tmp_path / "run", planted(Pick("x", "other"), "plane", 1.0))
    for stated in claims.CLAIMS:
        verdict = claims.judge(stated, nothing)
        assert verdict.outcome is Outcome.UNTESTED, stated.text
        assert stated.config in verdict.figure or stated.reason == verdict.figure


@pytest.mark.parametrize(
    ("paper", "words", "slow", "fast", "surface"),
    [
        ("szente", "23.6 times", picks.MARCH, picks.FIT, "sphere"),
        ("szente", "4.8 times", picks.MARCH, picks.LU, "flirt"),
        ("szente", "consistently faster", picks.CONTROL, picks.LU, "calyx"),
        ("szente", "On the sphere direct", picks.NO_EVAL, picks.FIT, "sphere"),
        ("toledo2007", "Two starts", picks.ONE_RAY, picks.TWO_RAYS, "torus"),
        ("toledo2007", "faster than closed forms", picks.LOOP_BLINN, picks.NEWTON_3, "torus"),
        ("beamcasting", "adaptive method beats", picks.UNIFORM, picks.ADAPTIVE, "heart"),
    ],
)
def test_planted_times_flip_a_verdict(
    tmp_path: Path, paper: str, words: str, slow: Pick, fast: Pick, surface: str
) -> None:
    for name, factor, outcome in (("as-claimed", 30.0, Outcome.CONFIRMED), ("against", 0.5, Outcome.REFUTED)):
        cells = (planted(slow, surface, factor), planted(fast, surface, 1.0))
        assert claims.judge(claim(paper, words), evidence(tmp_path / name, *cells)).outcome is outcome


def test_the_settings_that_claims_read_are_those_that_the_methods_state() -> None:
    told = "a method changed its defaults or settings: run `python -m tests.stated_settings`"
    assert stated_settings.FILE.read_text(encoding="utf-8") == stated_settings.text(), told


def test_the_picks_of_toledos_table_1_are_the_settings_that_their_methods_print() -> None:
    methods = find_methods()
    for pick in picks.TABLE_1:
        assert pick.knobs.items() <= dict(methods.get(pick.method).setting(pick.words).parameters).items(), pick.words
    for pick in picks.OURS_OF_TABLE_1:
        default = methods.get(pick.method).variant({}).parameters
        changed = {name for name, value in default if pick.knobs.get(name, value) != value}
        assert changed <= {"ITERATIONS", "EPSILON"}, f"{pick.words}: ours but for the printed error"


def test_ours_stands_beside_the_printed_verdict_and_decides_nothing(tmp_path: Path) -> None:
    cells = [planted(picks.LOOP_BLINN, "torus", 1.0), planted(picks.NEWTON_3, "torus", 2.0)]
    closed = claim("toledo2007", "faster than closed forms")
    assert "Ours" not in claims.judge(closed, evidence(tmp_path / "alone", *cells)).figure
    cells.append(planted(picks.NEWTON_3_FORWARDS, "torus", 0.5))
    verdict = claims.judge(closed, evidence(tmp_path / "both", *cells))
    assert verdict.outcome is Outcome.REFUTED
    assert "Ours at its best, steps forwards" in verdict.figure and verdict.figure.endswith("(confirmed)")


def test_vanishing_rays_are_those_without_their_hit(tmp_path: Path) -> None:
    bound = claim("toledo2007", "step bound")
    for kind, expected in (("misses", Outcome.CONFIRMED), ("exhausted", Outcome.REFUTED)):
        cells = [planted(picks.NEWTON_UNBOUND, "torus", 1.0, **{kind: 300}), planted(picks.NEWTON_3, "torus", 1.0)]
        assert claims.judge(bound, evidence(tmp_path / kind, *cells)).outcome is expected


def test_times_of_different_scenes_are_no_ratio(tmp_path: Path) -> None:
    apart = evidence(tmp_path / "run", planted(picks.MARCH, "sphere", 30.0), planted(picks.FIT, "sphere", 1.0, "side"))
    assert apart.ratios(picks.MARCH, picks.FIT).empty


def test_planted_wrong_rays_flip_a_verdict(tmp_path: Path) -> None:
    def outcome(name: str, words: str, *cells: dict[str, Any], paper: str = "szente") -> Outcome:
        return claims.judge(claim(paper, words), evidence(tmp_path / name, *cells)).outcome

    octic = "endrass_octic"
    for pick, bad, words, expected in (
        (picks.NO_EFT, 500, "EFT is indispensable", Outcome.CONFIRMED),
        (picks.NO_EFT, 0, "EFT is indispensable", Outcome.REFUTED),
        (picks.NEITHER, 500, "Without EFT and direct evaluation", Outcome.CONFIRMED),
        (picks.NEITHER, 0, "Without EFT and direct evaluation", Outcome.REFUTED),
    ):
        cells = (planted(pick, octic, 1.0, wrong_root=bad), planted(picks.FIT, octic, 1.0))
        assert outcome(f"{pick.method}{bad}{words[:3]}", words, *cells) is expected

    for bad, expected in ((0, Outcome.CONFIRMED), (1, Outcome.REFUTED)):
        cells = (planted(picks.FIT, "scattered", 2.0, wrong_root=bad), planted(picks.YUKSEL, "scattered", 1.0))
        assert outcome(f"values {bad}", "Values of f and its degree", *cells) is expected

    lu = "misses no surface feature"
    assert outcome("lu-right", lu, planted(picks.LU, "flirt", 1.0)) is Outcome.CONFIRMED
    assert outcome("lu-wrong", lu, planted(picks.LU, "flirt", 1.0, misses=1)) is Outcome.REFUTED

    views = [planted(picks.STURM, "torus", 1.0, f"tilted by {i}", misses=n) for i, n in enumerate((0, 40))]
    even = [planted(picks.STURM, "torus", 1.0, f"tilted by {i}", misses=n) for i, n in enumerate((40, 40))]
    assert outcome("uneven", "viewing angle", *views, paper="toledo2007") is Outcome.CONFIRMED
    assert outcome("even", "viewing angle", *even, paper="toledo2007") is Outcome.REFUTED

    for missed, other, expected in ((0, 1, Outcome.CONFIRMED), (1, 0, Outcome.REFUTED)):
        blob = planted(picks.UNIFORM, "blob", 1.0, misses=missed, wrong_root=other) | {"degree": None}
        assert outcome(f"blob {missed}", "not restricted to algebraic", blob, paper="beamcasting") is expected

    tight, loose = ({"feature_error": {"max": value}} for value in (1e-3, 2e-3))
    bisection = "none of Sturm's failures"
    for name, cells, expected in (
        ("within", planted(picks.BISECTION, "torus", 1.0, **tight), Outcome.CONFIRMED),
        ("beyond", planted(picks.BISECTION, "torus", 1.0, **loose), Outcome.REFUTED),
        ("wrong", planted(picks.BISECTION, "torus", 1.0, wrong_root=3, **tight), Outcome.REFUTED),
    ):
        assert outcome(name, bisection, cells, paper="toledo2007") is expected


def test_two_rays_of_thousands_decide_nothing(tmp_path: Path) -> None:
    for few, expected in ((2, Outcome.UNDECIDED), (40, Outcome.CONFIRMED)):
        views = [planted(picks.STURM, "torus", 1.0, f"tilted by {i}", misses=n) for i, n in enumerate((0, few))]
        verdict = claims.judge(claim("toledo2007", "viewing angle"), evidence(tmp_path / str(few), *views))
        assert verdict.outcome is expected
        assert f"from 0 (view tilted by 0) to {few} (view tilted by 1) of 2,304" in verdict.figure
    for words, before, after in (
        ("Without EFT and direct evaluation", picks.NEITHER, picks.FIT),
        ("EFT is indispensable", picks.NO_EFT, picks.FIT),
    ):
        cells = (planted(before, "endrass_octic", 1.0, wrong_root=2), planted(after, "endrass_octic", 1.0))
        judged = claims.judge(claim("szente", words), evidence(tmp_path / words[:5], *cells))
        assert judged.outcome is Outcome.UNDECIDED and "of 2,304 rays each" in judged.figure
    cells = (planted(picks.FIT, "calyx", 1.0), planted(picks.MARCH, "calyx", 1.0, misses=1))
    thin = claims.judge(claim("szente", "thin features"), evidence(tmp_path / "thin", *cells))
    assert thin.outcome is Outcome.UNDECIDED, "one ray more is no less accurate method"


def _claims_by_method() -> list[tuple[Claim, dict[str, Any]]]:
    """Return claims about rays' answers, each with a row that confirms or refutes it unless figures are missing."""
    return [
        (claim("szente", "No artifacts on any"), planted(picks.FIT, "torus", 1.0)),
        (claim("szente", "misses no surface feature"), planted(picks.LU, "flirt", 1.0)),
        (claim("szente", "smaller than its step"), planted(picks.MARCH, "torus", 1.0, misses=1)),
        (claim("toledo2007", "none of Sturm's failures"), planted(picks.BISECTION, "torus", 1.0)),
        (claim("toledo2007", "thresholds assure"), planted(picks.NEWTON_3, "torus", 1.0)),
        (claim("toledo2007", "quality on cubics"), planted(picks.STURM, "cayley", 1.0, misses=99) | {"degree": 3}),
        (claim("beamcasting", "All parts of the surface"), planted(picks.UNIFORM, "heart", 1.0)),
        (claim("beamcasting", "not restricted to algebraic"), planted(picks.UNIFORM, "blob", 1.0) | {"degree": None}),
    ]


@pytest.mark.parametrize("number", range(8))
def test_a_claim_with_a_missing_figure_is_not_decided(tmp_path: Path, number: int) -> None:
    stated, made = _claims_by_method()[number]
    whole = load.load(tiny_run(tmp_path / "whole", made))
    counts = ["misses", "wrong_root", "grazing_misses", "grazing_wrong_root", "false_hits", "exhausted"]
    figures = [*counts, *(f"feature_error_{name}" for name in PERCENTILES)]
    empty = whole.frame[figures].head(0).reindex(whole.frame.index)
    missing = whole.frame.assign(**empty)
    told = {}
    for name, frame in (("whole", whole.frame), ("missing", missing)):
        told[name] = claims.judge(stated, Evidence(derive.derive(frame), {}, Shelf(whole.folders)))
    assert told["whole"].outcome in (Outcome.CONFIRMED, Outcome.REFUTED), told["whole"].figure
    assert told["missing"].outcome is Outcome.UNDECIDED, told["missing"].figure

    made["accuracy"] = None
    assert claims.judge(stated, evidence(tmp_path / "unchecked", made)).outcome is Outcome.UNTESTED


def test_times_whose_intervals_meet_or_are_not_proved_decide_nothing(tmp_path: Path) -> None:
    always = claim("toledo2007", "Two starts")

    def spread(made: dict[str, Any], width: float, samples: int = 20) -> dict[str, Any]:
        """Change `made` so that its samples are `width` below and above its median by turns; return it."""
        median = made["time"]["median_ms"]
        return sampled(made, [median * (1 + (width if i % 2 else -width)) for i in range(samples)])

    def outcome(name: str, ratio: float, samples: int = 20, width: float = 0.01) -> Outcome:
        cells = [spread(planted(picks.ONE_RAY, "torus", ratio), width, samples)]
        cells.append(spread(planted(picks.TWO_RAYS, "torus", 1.0), 0.0, samples))
        return claims.judge(always, evidence(tmp_path / name, *cells)).outcome

    assert outcome("clear", 1.5) is Outcome.CONFIRMED
    assert outcome("against", 0.7) is Outcome.REFUTED
    assert outcome("meeting", 1.05, width=0.1) is Outcome.UNDECIDED
    assert outcome("few", 1.5, samples=5) is Outcome.UNDECIDED
    mean = claim("szente", "23.6 times")
    for ratio, width, expected in (
        (24.0, 0.001, Outcome.CONFIRMED),
        (24.0, 0.1, Outcome.UNDECIDED),
        (20.0, 0.001, Outcome.REFUTED),
    ):
        cells = [spread(planted(picks.MARCH, "sphere", ratio), width), spread(planted(picks.FIT, "sphere", 1.0), 0.0)]
        assert claims.judge(mean, evidence(tmp_path / f"{ratio} {width}", *cells)).outcome is expected
    for blocks, expected in ((24.0, Outcome.CONFIRMED), (20.0, Outcome.UNDECIDED)):
        marches = ((picks.MARCH, 90.0), (picks.MARCH_OURS, blocks), (picks.FIT, 1.0))
        cells = [planted(pick, "sphere", ms) for pick, ms in marches]
        for made in cells:
            median = made["time"]["median_ms"]
            made["time"] |= {"lower_ms": 0.999 * median, "upper_ms": 1.001 * median}
        assert claims.judge(mean, evidence(tmp_path / f"in blocks {blocks}", *cells)).outcome is expected


def test_variants_timed_in_the_same_rounds_are_told_apart_by_these(tmp_path: Path) -> None:
    """The medians are of other rounds: the machine slowed down when the faster one had ended its own."""
    cells = [planted(pick, "torus", ms) for pick, ms in ((picks.ONE_RAY, 1.5), (picks.TWO_RAYS, 1.0))]
    for made in cells:
        made["time"] |= {"session": "one", "rounds": list(range(len(made["time"]["samples_ms"])))}
    late = cells[1]["time"]
    late["samples_ms"] = late["samples_ms"] + [9.0] * 30
    late |= {"rounds": list(range(len(late["samples_ms"]))), "median_ms": 9.0, "lower_ms": 1.0, "upper_ms": 9.0}
    found = evidence(tmp_path, *cells).ratios(picks.ONE_RAY, picks.TWO_RAYS)
    assert found["ratio"].tolist() == pytest.approx([1.5], rel=0.05)
    assert (found["ratio_low"] > 1.0).all()
    judged = claims.judge(claim("toledo2007", "Two starts"), evidence(tmp_path / "judged", *cells))
    assert judged.outcome is Outcome.CONFIRMED


def test_planted_work_and_errors_flip_a_verdict(tmp_path: Path) -> None:
    def outcome(name: str, paper: str, words: str, *cells: dict[str, Any]) -> Outcome:
        return claims.judge(claim(paper, words), evidence(tmp_path / name, *cells)).outcome

    for more, expected in ((0.1, Outcome.CONFIRMED), (40.0, Outcome.REFUTED)):
        cells = [
            planted(pick, "torus", 1.0, evaluations_mean=9.0 + n)
            for pick, n in ((picks.NEWTON_3, 0.0), (picks.NEWTON_5, more))
        ]
        assert outcome(f"steps {more}", "toledo2007", "quadratically", *cells) is expected
    for skipped, expected in ((3, Outcome.CONFIRMED), (0, Outcome.UNDECIDED)):
        cells = [planted(picks.MARCH, "torus", 1.0, misses=skipped)]
        assert outcome(f"skipped {skipped}", "szente", "smaller than its step", *cells) is expected
    for gain, expected in ((1.2, Outcome.CONFIRMED), (1.0, Outcome.REFUTED), (0.9, Outcome.REFUTED)):
        cells = []
        for surface, degree, ratio in (("sphere", 2, gain), ("calyx", 5, 1.0)):
            cells += [planted(picks.LU_UNCULLED, surface, ratio), planted(picks.LU, surface, 1.0)]
            for made in cells[-2:]:
                made["degree"] = degree
        assert outcome(f"culling {gain}", "szente", "Culling by LU bounds", *cells) is expected
    for error, expected in ((1e-4, Outcome.CONFIRMED), (1e-2, Outcome.REFUTED)):
        cells = [planted(picks.UNIFORM, "heart", 1.0, error={"p99": e}) for e in (1e-3, error)]
        cells[1] |= {"samples_per_pixel": 4, "slot": "finer", "key": digest("finer"), "comparison": "heart finer"}
        assert outcome(f"samples {error}", "beamcasting", "approximate the surface better", *cells) is expected


@pytest.mark.parametrize(
    ("words", "before", "after"),
    [
        ("Grouping threads", picks.UNIFORM_IN_ROWS, picks.UNIFORM),
        ("Remapping threads", picks.ADAPTIVE, picks.REMAPPED),
        ("Divergence within a warp", picks.UNIFORM, picks.ADAPTIVE),
    ],
)
def test_idle_lanes_decide_what_divergence_costs(tmp_path: Path, words: str, before: Pick, after: Pick) -> None:
    def lanes_of(idle: float) -> list[dict[str, Any]]:
        idle_by_width = {"8": 0.0, "16": 0.0, "32": idle}
        return [{"level": level, "items": 64, "evaluations": 500, "idle": idle_by_width} for level in (8, 9)]

    def outcome(name: str, *shares: tuple[float, float]) -> Outcome:
        cells = [
            planted(pick, f"surface {i}", 1.0, lanes=lanes_of(idle))
            for i, pair in enumerate(shares)
            for pick, idle in zip((before, after), pair, strict=True)
        ]
        return claims.judge(claim("beamcasting", words), evidence(tmp_path / name, *cells)).outcome

    if words.startswith("Divergence"):
        assert outcome("much", (0.1, 0.4), (0.1, 0.25)) is Outcome.CONFIRMED
        assert outcome("little", (0.3, 0.1), (0.3, 0.2)) is Outcome.REFUTED
        assert outcome("both", (0.1, 0.4), (0.1, 0.2)) is Outcome.UNDECIDED
    else:
        assert outcome("less", (0.4, 0.3), (0.2, 0.18)) is Outcome.CONFIRMED
        assert outcome("more", (0.4, 0.45), (0.2, 0.195)) is Outcome.REFUTED
        assert outcome("both", (0.4, 0.3), (0.2, 0.21)) is Outcome.UNDECIDED


def test_a_study_decides_and_a_changed_digit_refutes(tmp_path: Path) -> None:
    from harness.studies import condition_numbers

    rows = condition_numbers.compute()
    right = evidence(tmp_path / "a", planted(picks.FIT, "sphere", 1.0), studies={"condition_numbers": rows})
    assert claims.judge(claim("szente", "condition numbers of Table 1"), right).outcome is Outcome.CONFIRMED
    changed = [row | {"condition": row["condition"] + 0.01} for row in rows]
    wrong = evidence(tmp_path / "b", planted(picks.FIT, "sphere", 1.0), studies={"condition_numbers": changed})
    assert claims.judge(claim("szente", "condition numbers of Table 1"), wrong).outcome is Outcome.REFUTED
