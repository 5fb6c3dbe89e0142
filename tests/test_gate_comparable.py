"""What a row is held against, by which rule, and what cannot be compared, of made-up rows."""

from pathlib import Path

import pytest

from harness.experiment.config import SlackChoice, ToleranceChoice
from harness.gate import baseline
from harness.gate.baseline import Baseline
from harness.gate.comparable import OTHER_SCENE, Rule
from harness.gate.foretold import foretold
from harness.gate.judge import Judged, Tolerance, Verdict, exit_code, judge, judge_row, tolerances_of
from harness.results.figures import GATED, Slack

from .test_gate_judge import BITS, DEFAULT, ENTRY, FACTS, KEY, METHODS, of, verdict

OTHER_BITS = BITS | {"float32": BITS["float32"] | {"sin": "x", "exp": "y"}}
OTHER = FACTS | {"name": "opencl:b", "processor": "q", "arithmetic": OTHER_BITS}


def both(*several):
    """One baseline of the devices of several."""
    devices = {key: facts for one in several for key, facts in one.devices.items()}
    return Baseline("t", devices, {key: rows for one in several for key, rows in one.rows.items()})


@pytest.mark.parametrize("fact", ["name", "title", "driver", "compiler", "processor"])
def test_a_device_that_computes_the_same_is_held_exactly_whatever_it_is_called(fact):
    facts = FACTS | {fact: "other"}
    assert (verdict(ENTRY, facts=facts).verdict, verdict(ENTRY, facts=facts).rule) == ("pass", "exact")
    more = ENTRY | {"evaluations_mean": 12.5 + 1 / 4096}
    assert verdict(more, facts=facts).verdict == "regressed"


def test_a_device_with_other_last_bits_is_held_with_slack_and_says_in_what_it_differs():
    found = verdict(ENTRY | {"evaluations_mean": 12.5 + 1 / 4096}, facts=OTHER)
    assert (found.verdict, found.rule) == ("pass", "last bits")
    assert found.reason == "held by last bits: sin, exp differ from opencl:a on p"
    assert verdict(ENTRY | {"evaluations_mean": 13.5}, facts=OTHER).verdict == "regressed"


def test_only_the_arithmetic_of_a_rows_precision_counts():
    now, before = of({"m float64 rays": ENTRY}, OTHER), of({"m float64 rays": ENTRY})
    (found,) = judge(now, before, {"m float64 rays": "m"}, DEFAULT)
    assert (found.rule, found.reason) == ("exact", "")
    other_host = FACTS | {"arithmetic": BITS | {"host": {"tan": "x"}}}
    assert verdict(ENTRY, facts=other_host).reason == "held by last bits: host tan differs from opencl:a on p"
    rastered = FACTS | {"arithmetic": BITS | {"raster": {"box": "6"}}}
    raster, listed = "m float32 raster", "m float32 rays"
    now, before = (of(dict.fromkeys((raster, listed), ENTRY), facts) for facts in (rastered, FACTS))
    found = judge(now, before, dict.fromkeys((raster, listed), "m"), DEFAULT)
    assert {j.slot: j.rule for j in found} == {raster: "last bits", listed: "exact"}


def test_a_row_is_held_against_the_device_that_computes_the_same_then_the_same_name_then_any():
    rows = [{"m a": ENTRY | {"misses": misses}} for misses in (1, 2, 3)]
    third = FACTS | {"name": "opencl:c", "arithmetic": BITS | {"float32": {"sums": "z"}}}
    before = both(of(rows[0]), of(rows[1], OTHER), of(rows[2], third))

    def held(facts):
        (found,) = judge(of({"m a": ENTRY}, facts), before, METHODS, DEFAULT)
        return next(change.before for change in found.changes if change.figure == "misses"), found.rule

    assert held(FACTS | {"name": "opencl:c"}) == (1, "exact"), "the same arithmetic, whatever its name"
    assert held(OTHER) == (2, "exact")
    changed = BITS | {"float32": {"sums": "new", "sin": "2", "exp": "3"}}
    assert held(third | {"arithmetic": changed}) == (3, "last bits"), "the same name"
    assert held(FACTS | {"name": "opencl:d", "arithmetic": changed}) == (1, "last bits"), "the fewest parts differ"
    without = Baseline("t", before.devices, before.rows | {KEY: {"m b": ENTRY}})
    (found,) = [j for j in judge(of({"m a": ENTRY}), without, METHODS, DEFAULT) if j.slot == "m a"]
    assert found.rule == "last bits", "another device of the baseline has the row"


def test_a_baseline_without_fingerprints_is_held_by_last_bits():
    old = {name: value for name, value in FACTS.items() if name != "arithmetic"}
    before = Baseline("t", {"opencl:a 123456": old}, {"opencl:a 123456": {"m a": ENTRY}})
    (found,) = judge(of({"m a": ENTRY}), before, METHODS, DEFAULT)
    assert (found.verdict, found.rule) == ("pass", "last bits")
    assert "the baseline does not say how opencl:a on p computes; bless anew" in found.reason


def test_what_a_device_cannot_run_is_incomparable_unless_it_was_blessed_so():
    lacking = {"status": "skipped", "scene": "s1", "reason": "the device has no float64", "lacks": True}
    found = verdict(lacking, facts=OTHER)
    assert (found.verdict, found.reason) == (
        "incomparable",
        "the device cannot run this cell: the device has no float64",
    )
    assert exit_code([found, Judged("m b", "opencl:a", "m", Verdict.PASS)], set()) == 3, "one such row is enough"
    assert verdict(lacking, before=lacking).verdict == "pass"
    assert verdict(lacking, before=lacking, facts=OTHER).rule == "exact", "what cannot run computes nothing"
    old = {name: value for name, value in lacking.items() if name != "lacks"}
    assert verdict(lacking, before=old).verdict == "pass", "older files say no more than the reason"
    assert verdict(ENTRY, before=lacking, facts=OTHER).verdict == "new", "no device of the baseline ran it"
    refused = lacking | {"reason": "the method refuses the surface"}
    refused.pop("lacks")
    assert verdict(refused, facts=OTHER).verdict == "regressed", "that is the method's doing, and no device's"


def test_another_scene_on_every_device_is_incomparable():
    before = both(of({"m a": ENTRY | {"scene": "old"}}), of({"m a": ENTRY}, OTHER))
    (found,) = judge(of({"m a": ENTRY}), before, METHODS, DEFAULT)
    assert (found.verdict, found.rule) == ("pass", "last bits"), "the other device was asked the same"
    (found,) = judge(of({"m a": ENTRY | {"scene": "new"}}), before, METHODS, DEFAULT)
    assert (found.verdict, found.reason, found.rule) == ("incomparable", OTHER_SCENE, "")


def test_meshes_of_another_mesher_are_held_by_last_bits():
    now, before = ENTRY | {"mesher": "pyvista 2"}, ENTRY | {"mesher": "pyvista 1"}
    assert verdict(now, before=before).reason == "held by last bits: meshes are by pyvista 2, and were by pyvista 1"
    assert verdict(now, before=now).rule == "exact"


def test_a_row_can_be_judged_by_itself():
    more = ENTRY | {"evaluations_mean": 12.5 + 1 / 4096}
    assert judge_row("m a", "d", "m", more, ENTRY, DEFAULT).verdict == "regressed"
    assert judge_row("m a", "d", "m", more, ENTRY, DEFAULT, Rule.LAST_BITS).verdict == "pass"
    assert judge_row("m a", "d", "m", more, None, DEFAULT).verdict == "new"


def test_slack_is_added_to_the_tolerance_and_a_config_may_state_its_own():
    slack = {"misses": SlackChoice(absolute=2, relative=0.5)}
    tolerance = tolerances_of({"misses": ToleranceChoice(absolute=1)}, slack)["misses"]
    assert tolerance == Tolerance("lower", 1, 0.0, Slack(2, 0.5))
    assert tolerance.under(Rule.LAST_BITS, family=True) == tolerance.under(Rule.LAST_BITS)
    assert (tolerance.under(Rule.EXACT).allowed(4), tolerance.under(Rule.LAST_BITS).allowed(4)) == (5, 9)
    right = Tolerance("higher", 0.0, 0.0, Slack(2, 0.0)).under(Rule.LAST_BITS)
    assert (right.verdict(10, 8), right.verdict(10, 7), right.verdict(10, 12)) == ("pass", "regressed", "pass")
    assert {name: t.last_bits for name, t in tolerances_of({}).items()} == {
        name: figure.last_bits for name, figure in GATED.items()
    }


def test_blessing_keeps_other_machines_and_replaces_this_one():
    other = FACTS | {"processor": "q", "arithmetic": OTHER_BITS}
    old_driver = FACTS | {"driver": "0", "arithmetic": BITS | {"host": {"tan": "x"}}}
    keys = [baseline.device_key(facts) for facts in (FACTS, other, old_driver)]
    assert len(set(keys)) == 3
    old = both(*(of({"m a": ENTRY}, facts) for facts in (other, old_driver)))
    merged = baseline.merged(old, of({"m b": ENTRY}))
    assert merged.devices.keys() == merged.rows.keys() == {keys[0], keys[1]}
    same = baseline.merged(of({"m a": ENTRY}, FACTS | {"processor": "q"}), of({"m b": ENTRY}))
    assert same == of({"m b": ENTRY}), "another processor that computes the same is the same device"


def test_how_a_device_computes_is_written_a_part_a_line(tmp_path):
    path = tmp_path / "b.toml"
    baseline.write(path, of({"m a": ENTRY}))
    lines = path.read_text().splitlines()
    first = lines.index(f'[device."{KEY}".arithmetic.float32]')
    assert lines[first + 1 : first + 4] == ['exp = "3"', 'sin = "2"', 'sums = "1"']
    assert "arithmetic" not in lines[lines.index(f'[device."{KEY}"]') + 1 : first]


def test_evaluations_of_a_quadtree_are_held_only_where_it_begins_at_the_same_level():
    now, before = ENTRY | {"device_level": 6, "evaluations_mean": 99.0}, ENTRY | {"device_level": 3}
    found = verdict(now, before=before)
    assert (found.verdict, found.rule) == ("pass", "exact")
    assert found.reason == "its quadtree begins at level 6, and began at 3: evaluations_mean is not held"
    assert "evaluations_mean" not in {change.figure for change in found.changes}
    assert verdict(now | {"misses": 4}, before=before).verdict == "regressed"
    assert verdict(now, before=before | {"device_level": 6}).verdict == "regressed"


def test_how_a_familys_rays_are_wrong_is_not_held_on_other_last_bits_but_how_many_are_right_is():
    before = ENTRY | {"right": 500, "misses": 20}
    assert verdict(before | {"misses": 60, "right": 460}, before=before, facts=OTHER).verdict == "pass"
    assert verdict(before | {"right": 250}, before=before, facts=OTHER).worst.figure == "right"
    assert verdict(before | {"misses": 60}, before=before).verdict == "regressed"
    assert verdict(ENTRY | {"misses": 60}, facts=OTHER).verdict == "regressed"


def test_rows_that_cannot_be_compared_are_told_with_their_number():
    rows = [Judged(slot, "opencl:a", "m", Verdict.INCOMPARABLE, OTHER_SCENE) for slot in ("m a", "m b")]
    one, two = (foretold(rows[:n], n, Path("c.toml"), Path("b.toml")).splitlines() for n in (1, 2))
    assert one[0] == "firsthit: 1 of 1 row cannot be compared with b.toml, whatever the methods answer:"
    assert one[1] == f"  m a on opencl:a: {OTHER_SCENE}"
    assert two[1] == f"  m a on opencl:a and 1 more: {OTHER_SCENE}"
    assert two[2].startswith("    do: firsthit bless c.toml")
