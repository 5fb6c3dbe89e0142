"""Verdicts, exit codes and the baseline's file, of made-up rows."""

import pytest

from harness.contract import FirsthitError
from harness.experiment.config import ToleranceChoice
from harness.gate import baseline
from harness.gate.baseline import Baseline
from harness.gate.judge import Judged, Tolerance, Verdict, exit_code, judge, tolerances_of
from harness.gate.race import verdict_of
from harness.results import figures
from harness.results.timings import Ratio

BITS = {"float32": {"sums": "1", "sin": "2", "exp": "3"}, "float64": {"sums": "4"}, "host": {"tan": "5"}}
FACTS = {"name": "opencl:a", "title": "A", "driver": "1", "compiler": "c", "processor": "p", "versions": {"b": "2"}}
FACTS["arithmetic"] = BITS
KEY = baseline.device_key(FACTS)
ENTRY = {
    "status": "ok",
    "scene": "s1",
    "program": "p1",
    "misses": 3,
    "error_max": 1e-5,
    "evaluations_mean": 12.5,
    "claims": 1,
}
METHODS = {"m a": "m", "m b": "m", "m c": "m"}
DEFAULT = tolerances_of({})


def of(rows, facts=FACTS):
    key = baseline.device_key(facts)
    return Baseline("t", {key: facts}, {key: rows})


def verdict(now, before=ENTRY, facts=FACTS, own=None):
    tolerances = tolerances_of(own or {})
    (found,) = judge(of({"m a": now}, facts), of({"m a": before}), METHODS, tolerances)
    return found


@pytest.mark.parametrize(
    ("changed", "expected", "figure"),
    [
        ({}, "pass", None),
        ({"program": "another"}, "pass", None),
        ({"misses": 4}, "regressed", "misses"),
        ({"misses": 2}, "improved", "misses"),
        ({"error_max": 1.04e-5}, "pass", None),
        ({"error_max": 1.06e-5}, "regressed", "error_max"),
        ({"error_max": 0.9e-5}, "improved", "error_max"),
        ({"evaluations_mean": 12.5 + 1 / 4096}, "regressed", "evaluations_mean"),
        ({"claims": 0}, "regressed", "claims"),
        ({"misses": 2, "error_max": 1.0}, "regressed", "error_max"),
        ({"status": "crashed", "reason": "SIGSEGV"}, "regressed", "status"),
        ({"scene": "s2", "misses": 0}, "incomparable", None),
    ],
)
def test_each_figure_is_judged_by_its_direction_and_tolerance(changed, expected, figure):
    found = verdict(ENTRY | changed)
    assert found.verdict == expected
    if figure:
        assert found.worst.figure == figure


def test_a_figure_that_is_gone_is_a_regression_and_a_cell_that_recovers_an_improvement():
    assert verdict({name: value for name, value in ENTRY.items() if name != "error_max"}).verdict == "regressed"
    assert verdict(ENTRY, before={"status": "failed", "scene": "s1"}).verdict == "improved"


def test_rows_that_come_and_go():
    found = judge(of({"m a": ENTRY, "m c": ENTRY}), of({"m a": ENTRY, "m b": ENTRY}), METHODS, DEFAULT)
    assert [(j.slot, str(j.verdict)) for j in found] == [("m b", "missing"), ("m c", "new"), ("m a", "pass")]
    assert exit_code(found, set()) == 1
    assert exit_code(found[1:], set()) == 0
    assert exit_code(found[1:], {("m c", "opencl:a")}) == 3, "a new row that did not finish is no pass"
    assert exit_code(found[1:2], set()) == 3, "where nothing was compared nothing passed"


def test_a_config_may_loosen_turn_or_drop_a_figure():
    own = {
        "misses": ToleranceChoice(absolute=2),
        "error_max": ToleranceChoice(gated=False),
        "evaluations_mean": ToleranceChoice(better="higher"),
    }
    assert verdict(ENTRY | {"misses": 5, "error_max": 9.0, "evaluations_mean": 99.0}, own=own).verdict == "improved"
    assert verdict(ENTRY | {"misses": 6}, own=own).verdict == "regressed"
    assert verdict(ENTRY | {"evaluations_mean": 12.0}, own=own).verdict == "regressed"


def test_the_worst_comes_first():
    before = of({f"m {i}": ENTRY for i in range(4)})
    now = of({f"m {i}": ENTRY | {"error_max": 1e-5 * factor} for i, factor in enumerate((1.0, 2.0, 50.0, 0.1))})
    methods = {f"m {i}": "m" for i in range(4)}
    assert [j.slot for j in judge(now, before, methods, DEFAULT)] == ["m 2", "m 1", "m 3", "m 0"]


def test_a_baseline_comes_back_as_written_one_figure_a_line(tmp_path):
    path = tmp_path / "b.toml"
    entry = ENTRY | {"error_max": 5e-324, "error_p99": 1e22, "reason": 'quotes " and \\ and\nlines é'}
    stored = Baseline("c", {KEY: FACTS}, {KEY: {'x["y"] z': entry, "a": ENTRY}})
    baseline.write(path, stored)
    assert baseline.read(path) == stored
    text = path.read_text()
    assert text.splitlines().count("misses = 3") == 2
    assert text.index('."a"]') < text.index('."x[')
    baseline.write(path, Baseline("c", stored.devices, {KEY: {"a": ENTRY | {"misses": 4}, 'x["y"] z': entry}}))
    changed = set(path.read_text().splitlines()) - set(text.splitlines())
    assert changed == {"misses = 4"}, "a diff shows what changed and nothing else"


@pytest.mark.parametrize(
    "text",
    ["", "format = 3", "format = 1\ndevice = 3", "not toml", "format = 1\n[row.x.y]\nstatus = 'ok'\nscene = 's'",
     "format = 1\n[device.x]\nname = 'x'\n[row.x.y]\nmisses = 1", "format = 1\n[device]\nx = 1",
     "format = 2\n[device.x]\narithmetic = 3", "format = 2\n[device.x.arithmetic.float32]\nsums = 3"],
)  # fmt: skip
def test_a_damaged_baseline_is_one_line(tmp_path, text):
    path = tmp_path / "b.toml"
    path.write_text(text)
    with pytest.raises(FirsthitError, match=r"baseline|damaged") as caught:
        baseline.read(path)
    assert "\n" not in str(caught.value)
    assert caught.value.exit_code == 2
    with pytest.raises(FirsthitError, match="firsthit bless"):
        baseline.read(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("line", "named"),
    [("status = 7", "status is no text: 7"), ('status = "done"', "status: 'done' is not one of ok"),
     ("misses = true", "misses is no number: True"), ('misses = "none"', "misses is no number: 'none'"),
     ("misses = [1]", r"misses is no number: \[1\]"), ("misses = -1", "misses: -1 is negative"),
     ("last_bit = 'x'", "last_bit is no number: 'x'"), ("error_max = nan", "error_max: nan is no finite number"),
     (f"misses = 1{'0' * 400}", "misses: 1000"), ("scene = 1979-05-27", "scene is no text")],
)  # fmt: skip
def test_a_row_whose_value_cannot_be_is_damage_and_no_improvement(tmp_path, line, named):
    path = tmp_path / "b.toml"
    status = "" if line.startswith("status") else "status = 'ok'\n"
    scene = "" if line.startswith("scene") else "scene = 's'\n"
    path.write_text(f"format = 2\n[device.x]\nname = 'x'\n[row.x.y]\n{scene}{status}{line}\n")
    with pytest.raises(FirsthitError, match=f"is damaged: row y.*{named}"):
        baseline.read(path)


def test_claims_are_counted_until_a_row_disproves_them():
    counts = dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root", "invalid"), 0)
    grazing = {f"grazing_{name}": 0 for name in counts}
    counts |= {"undecided": 0}
    accuracy = counts | grazing | {"error": {"max": 1.0, "p99": None}, "evaluations_mean": 2.0}
    row = {"accuracy": accuracy, "rungs": None}
    claims = ("no_missed_root", "finds_touch")
    assert figures.figures(row, claims) == counts | {
        "grazing_wrong": 0,
        "error_max": 1.0,
        "evaluations_mean": 2.0,
        "claims": 2,
    }
    assert figures.figures({"accuracy": accuracy | {"grazing_misses": 1}, "rungs": None}, claims)["claims"] == 1
    rung = counts | {"right": 5, "worst_ratio": 2.0}
    family = figures.figures({"accuracy": None, "rungs": [rung, rung | {"misses": 1, "worst_ratio": None}]}, claims)
    assert family == counts | {"misses": 1, "right": 10, "worst_ratio": 2.0, "claims": 1}
    assert figures.figures({"accuracy": None, "rungs": None}, claims) == {}


@pytest.mark.parametrize(
    ("lower", "upper", "proved", "expected"),
    [
        (1.06, 1.2, True, "regressed"),
        (1.04, 1.2, True, "pass"),
        (0.8, 0.9, True, "improved"),
        (0.8, 0.99, True, "pass"),
        (2.0, 3.0, False, "incomparable"),
    ],
)
def test_speed_regresses_only_where_the_whole_interval_is_beyond_the_tolerance(lower, upper, proved, expected):
    base = Judged("m a: speed", "opencl:a", "m", Verdict.PASS)
    ratio = Ratio((lower + upper) / 2, lower, upper, proved, 0.001, 12)
    assert verdict_of(base, ratio, Tolerance("lower", 0.0, 0.05)).verdict == expected


NAN, INF = float("nan"), float("inf")


@pytest.mark.parametrize("now", [NAN, INF])
@pytest.mark.parametrize("before", [0.0, 1e-5, NAN, -1.0])
def test_what_is_no_number_regresses(before, now):
    for tolerance in (Tolerance("lower", 0.0, 0.05), Tolerance("lower", 1.0, 0.0), Tolerance("lower", NAN, 0.0)):
        assert tolerance.verdict(before, now) == "regressed"
        assert tolerance.verdict(NAN, before) == "regressed"
    assert Tolerance("higher", 0.0, 0.0).verdict(1.0, NAN) == "regressed"
    assert Tolerance("higher", 0.0, 0.0).verdict(1.0, -INF) == "regressed"


def test_a_tolerance_that_is_no_number_lets_nothing_pass():
    assert Tolerance("lower", NAN, 0.0).verdict(1.0, 1.0) == "regressed"
    assert Tolerance("lower", 0.0, NAN).verdict(1.0, 1.0) == "regressed"


def test_invalid_answers_regress_against_a_baseline_that_never_counted_them():
    """Blessed on a good kernel; the new one answers NaN on most of its hits, and misses fewer."""
    now = ENTRY | {"misses": 1, "error_max": 1e-6, "invalid": 197}
    found = verdict(now)
    assert (found.verdict, found.worst.figure) == ("regressed", "invalid")
    assert verdict(ENTRY | {"invalid": 0}).verdict == "pass"
    assert verdict(ENTRY | {"invalid": 3}, before=ENTRY | {"invalid": 5}).verdict == "improved"


def test_a_row_that_did_not_finish_then_and_now_is_no_pass():
    for status in ("failed", "timeout", "crashed"):
        broken = {"status": status, "scene": "s1"}
        assert verdict(broken, before=broken).verdict == "incomparable"
    skipped = {"status": "skipped", "scene": "s1"}
    assert verdict(skipped, before=skipped).verdict == "pass"


def test_a_figure_that_is_no_number_cannot_be_gated_nor_read_back(tmp_path):
    counts = dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root", "invalid"), 0)
    accuracy = counts | {f"grazing_{name}": 0 for name in counts} | {"undecided": 0}
    accuracy |= {"error": {"max": NAN, "p99": None}, "evaluations_mean": 2.0}
    with pytest.raises(FirsthitError, match="m a: its error_max is nan"):
        figures.figures({"slot": "m a", "accuracy": accuracy, "rungs": None}, ())
    for value in (NAN, INF, -INF):
        baseline.write(tmp_path / "b.toml", of({"m a": ENTRY | {"error_max": value}}))
        with pytest.raises(FirsthitError, match="error_max"):
            baseline.read(tmp_path / "b.toml")


def test_grazing_invalid_answers_are_gated_without_a_tolerance():
    counts = dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root", "invalid"), 0)
    accuracy = counts | {f"grazing_{name}": 0 for name in counts} | {"undecided": 2, "grazing_invalid": 1}
    accuracy |= {"error": {"max": None, "p99": None}, "evaluations_mean": None}
    found = figures.figures({"slot": "m a", "accuracy": accuracy, "rungs": None}, ("no_missed_root", "no_false_hit"))
    assert (found["invalid"], found["grazing_wrong"], found["undecided"], found["claims"]) == (1, 0, 2, 1)
    assert "evaluations_mean" not in found


@pytest.mark.parametrize(("lower", "upper"), [(NAN, NAN), (0.9, NAN), (NAN, 1.0), (INF, INF), (-INF, 0.5)])
def test_a_ratio_that_is_no_number_is_incomparable(lower, upper):
    base = Judged("m a: speed", "opencl:a", "m", Verdict.PASS)
    assert verdict_of(base, Ratio(1.0, lower, upper, True, 0.001, 12), Tolerance("lower", 0.0, 0.05)).verdict == (
        "incomparable"
    )


def test_wrong_answers_on_drowned_rays_are_gated_and_break_only_what_is_claimed_of_every_ray():
    counts = dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root", "invalid"), 0)
    apart = {"undecided": 0} | {f"{kind}_{name}": 0 for kind in ("grazing", "drowned") for name in counts}
    accuracy = counts | apart | {"error": {"max": 1.0, "p99": None}, "evaluations_mean": 2.0}
    found = accuracy | {"drowned_misses": 2, "drowned_false_hits": 3}
    claims = ("no_missed_root", "no_false_hit")
    read = figures.figures({"slot": "m a", "accuracy": found, "rungs": None}, claims)
    assert (read["drowned_wrong"], read["grazing_wrong"], read["claims"]) == (5, 0, 1)
    assert verdict(ENTRY | {"drowned_wrong": 5}).verdict == "pass", "not in the baseline: nothing to compare with"
    (judged,) = judge(
        of({"m a": ENTRY | {"drowned_wrong": 9}}), of({"m a": ENTRY | {"drowned_wrong": 0}}), METHODS, DEFAULT
    )
    assert judged.verdict == "regressed"
