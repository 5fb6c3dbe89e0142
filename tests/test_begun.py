"""Steps are kept as they end: whatever ends a runner, the next one goes on where it was, and rounds still pair."""

import dataclasses
import json
import math
import os
from itertools import pairwise

import pytest

from harness.contract import CellStatus, DeviceInfo
from harness.devices.interface import Timing
from harness.devices.messages import Warmed
from harness.experiment import plan, reading
from harness.experiment.kinds import Outcome
from harness.experiment.plan import Planned
from harness.plugins import find_methods
from harness.results import begun, timings
from harness.results.begun import Begun
from harness.results.row import Accuracy, Environment
from harness.results.store import Store
from harness.running.due import begin
from harness.running.runner import Runner
from tests.agreeing_rows import whole

DEVICE = DeviceInfo("opencl:made_up", "t", "t", "t", None, False, "wall", ())
CONFIG = """title = "t"
surfaces = ["sphere"]
sizes = [8]
devices = ["opencl:made_up"]
[[method]]
name = "newton"
parameters = { EPSILON = [0.001, 0.0001, 0.00001] }
[accuracy]
size = 4
[budget]
seconds = 1000.0
repetitions = 12
interval = 0.0
"""
ERROR = {"p50": 1e-8, "p99": 1e-7, "p999": 1e-7, "max": 1e-7}
SUMMARY = whole({"rays": 16, "size": 4, "truth_hits": 16, "error": ERROR}, Accuracy)
ENVIRONMENT = whole({"commit": None, "dirty": False}, Environment)


class Casting:
    """Checks nothing, and counts how often it is asked to."""

    checks, others, timed = (), (), object()

    def __init__(self, key, log, outcome):
        self.key, self.log, self.outcome = key, log, outcome

    def frame(self):
        return self.key

    def check(self, *_):
        self.log.append(("check", self.key))
        return self.outcome


class Executor:
    """Takes samples of about a millisecond, and writes down what it does, up to the step of number `stop`."""

    moves = 0  # it is always the same place

    def __init__(self, log, stop=None, ms=1.0):
        self.log, self.stop, self.ms = log, stop, ms

    def step(self, *what):
        if self.stop is not None:
            self.stop -= 1
            if self.stop < 0:
                raise KeyboardInterrupt
        self.log.append(what)

    def warm(self, _, key, __):
        self.step("warm", key)
        return Warmed(10.0 + len(self.log), 1.0, 1.0, 2)

    def expect(self, samples):
        pass

    def sample(self, _, key, __, batch):
        self.step("sample", key)
        return Timing(self.ms * batch * (1.0 + 0.01 * (len(self.log) % 5)), None)

    def release(self, *_):
        pass

    def builds(self, _):
        return []


@pytest.fixture
def sit(tmp_path):
    """Return a function that runs the config's cells in one sitting, and returns their rows and what was done."""
    (tmp_path / "t.toml").write_text(CONFIG)
    catalog = find_methods()
    experiment = reading.load(tmp_path / "t.toml", catalog)
    planned = plan.plan(experiment, catalog, [DEVICE])
    assert [p.skip for p in planned] == [None] * 3

    def sit(stop=None, again="nothing", ms=1.0, outcome=None, cells=3):
        log, store = [], Store(tmp_path / "run")
        found = outcome or Outcome(5.0, None, SUMMARY, {"t": [1.0, 2.0]})
        chosen = [dataclasses.replace(p, casting=Casting(p.key, log, found)) for p in planned[:cells]]
        todo, kept, _ = begin(chosen, store, again)
        executor = Executor(log, stop, ms)
        runner = Runner(experiment.config, catalog, store, executor, ENVIRONMENT, lambda *_: None)
        try:
            return list(runner.run(todo.todo, kept).values()), log
        except KeyboardInterrupt:
            return None, log

    sit.store = Store(tmp_path / "run")
    sit.keys = [p.key for p in planned]
    return sit


@pytest.fixture(autouse=True)
def _no_program(monkeypatch):
    monkeypatch.setattr(Planned, "timed", property(lambda _: None))
    monkeypatch.setattr(Planned, "frame", property(lambda self: self.casting.frame()))


def count(log, word):
    return sum(what == word for what, _ in log)


def test_a_run_that_is_not_disturbed_has_one_sitting(sit):
    rows, log = sit()
    assert [row["status"] for row in rows] == ["ok"] * 3
    assert {(tuple(row["time"]["sittings"]), row["time"]["session"]) for row in rows} == {
        ((12,), rows[0]["time"]["session"])
    }
    assert (count(log, "check"), count(log, "sample")) == (3, 36)
    assert not (sit.store.folder / "begun").exists()


@pytest.mark.parametrize("stops", [[s] for s in range(0, 39, 3)] + [[1, 0, 4, 5, 0, 20, 3, 9]])
def test_whatever_stops_it_only_the_step_that_ran_is_lost(sit, stops):
    logs = []
    for stop in stops:
        rows, log = sit(stop)
        assert rows is None
        logs += log
    rows, log = sit()
    logs += log
    assert count(logs, "check") == 3, "a check is not run again"
    assert count(logs, "sample") == 36, "no sample is taken in vain"
    stored = [sit.store.read(key) for key in sit.keys]
    assert len({row["time"]["session"] for row in stored}) == 1
    for row in stored:
        time = row["time"]
        assert sum(time["sittings"]) == len(time["samples_ms"]) == len(time["rounds"]) == 12
        assert all(a < b for a, b in pairwise(time["rounds"]))
        assert (row["status"], row["accuracy"]) == ("ok", SUMMARY)
        assert (sit.store.folder / row["arrays"]).exists()
        assert time["batch"] == 2
    assert not (sit.store.folder / "begun").exists()


def test_samples_of_one_round_were_taken_in_turn(sit):
    """A round that is stopped half-way is not completed later: its missing samples are of the next round."""
    _, first = sit(3 + 3 * 4 + 1)
    _, second = sit()
    taken = [[key for what, key in log if what == "sample"] for log in (first, second)]
    turns = [
        {key: turn for turn, at in enumerate(range(0, len(keys), 3)) for key in keys[at : at + 3]} for keys in taken
    ]
    assert turns
    rounds = {key: sit.store.read(key)["time"]["rounds"] for key in sit.keys}
    (early,) = [key for key in rounds if 4 in rounds[key]]
    assert taken[0][-1] == early
    assert rounds[early] == [0, 1, 2, 3, 4, *range(5, 12)]
    assert {tuple(rounds[key]) for key in rounds if key != early} == {(0, 1, 2, 3, *range(5, 13))}


def test_cells_that_are_taken_up_apart_share_no_later_round(sit):
    sit(3 + 3 * 4)
    ((row,), log) = sit(cells=1)
    assert (row["time"]["rounds"], count(log, "check")) == ([*range(12)], 0)
    rows, log = sit()
    assert (len(rows), count(log, "check")) == (2, 0)
    for other in rows:
        assert other["time"]["session"] == row["time"]["session"]
        assert other["time"]["rounds"] == [*range(4), *range(12, 20)]


def test_a_changed_cell_begins_anew(sit):
    sit(20)
    kept = Begun(sit.store.folder)
    session = kept.session(["another key"], "new")
    assert (session.name, session.sitting, session.cells) == ("new", 0, {})


def test_force_begins_anew_and_goes_on_without_force(sit):
    sit()
    before = [sit.store.read(key) for key in sit.keys]
    rows, log = sit(2 * 3 + 5, again="everything")
    assert rows is None
    rows, more = sit()
    assert (count(log, "check"), count(more, "check"), len(rows)) == (3, 0, 3)
    assert all(a["time"]["session"] != row["time"]["session"] for a in before for row in rows)
    assert sit() == ([], [])
    _, log = sit(9, again="everything")
    _, log = sit(again="everything")
    assert count(log, "check") == 3, "--force checks again what an earlier --force has checked"


def test_retry_goes_on_without_retry_and_begins_failed_cells_anew(sit):
    failed = Outcome(5.0, "it is wrong", SUMMARY)
    rows, _ = sit(outcome=failed)
    assert [row["status"] for row in rows] == ["failed"] * 3
    rows, log = sit(1, again="unfinished")
    assert rows is None
    rows, more = sit()
    assert [row["status"] for row in rows] == ["ok"] * 3
    assert count(log, "check") + count(more, "check") == 3


@pytest.mark.parametrize(
    ("damage", "checks", "samples"),
    [
        (lambda text: text[:-7], 0, 24 + 3),  # the last round's line is torn, as a power cut leaves it
        (lambda text: text[:-7] + bytes(40), 0, 24 + 3),
        (lambda text: text.replace(b'"batch":2', b'"batch":3', 1), 0, 24 + 4),  # one cell was never ready
        (lambda _: b"", 3, 36),
        (lambda _: b"\xff\n" * 9, 3, 36),
        (lambda text: text.replace(b'"format":1', b'"format":2'), 0, 24),
    ],
)
def test_damage_costs_what_it_hits_and_nothing_else(sit, damage, checks, samples):
    sit(3 + 12)
    (path,) = (sit.store.folder / "begun").iterdir()
    path.write_bytes(damage(path.read_bytes()))
    rows, log = sit()
    assert [row["status"] for row in rows] == ["ok"] * 3
    assert (count(log, "check"), count(log, "sample")) == (checks, samples)
    assert not path.exists()


@pytest.mark.parametrize(
    "said",
    [
        {"sitting": "x", "format": 1},
        {"sitting": None, "format": 1},
        {"cell": [1], "checked": {}},
        {"cell": 0, "checked": {}},
        {"cell": 0, "checked": {"outcome": {"a": 1}, "arrays": None, "seconds": 1}},
        {"cell": 0, "checked": {"outcome": {"compile_ms": 1.0}, "arrays": 5, "seconds": 1}},
        {"of": 0, "warmed": {"a": 1}},
        {"round": "x", "samples": {}},
        {"round": 50, "samples": 5},
        {"round": 50, "samples": {"0": ["x", None, 1.0]}},
        {"forget": 5},
    ],
)
def test_a_line_that_says_something_else_is_taken_for_nothing(sit, said):
    """Its check sum fits, as where another version wrote it."""
    sit(3 + 12)
    (path,) = (sit.store.folder / "begun").iterdir()
    named = {name: sit.keys[0] if name in ("cell", "of") and value == 0 else value for name, value in said.items()}
    if "samples" in named and isinstance(named["samples"], dict):
        named["samples"] = {sit.keys[int(key)]: value for key, value in named["samples"].items()}
    with path.open("ab") as file:
        file.write(begun._line(named))
    (path.parent / begun.AGAIN).write_bytes(begun._line({"again": 5}) + begun._line({"ended": []}))
    rows, _ = sit()
    assert [row["status"] for row in rows] == ["ok"] * 3


def test_a_check_whose_pictures_are_gone_is_run_again(sit):
    sit(3 + 12)
    (sit.store.folder / "arrays" / f"{sit.keys[0]}.npz").unlink()
    assert count(sit()[1], "check") == 1


def test_what_nobody_asks_for_goes_after_a_day(sit):
    sit(20)
    (path,) = (sit.store.folder / "begun").iterdir()
    has = sit.store.has
    assert Begun(sit.store.folder).sweep(sit.keys, has) == []
    assert Begun(sit.store.folder).sweep(["another"], has) == []
    os.utime(path, (0, 0))
    assert Begun(sit.store.folder).sweep(sit.keys[:1], has) == []
    assert Begun(sit.store.folder).sweep(["another"], has) == [path]
    assert not path.exists()


def test_what_has_rows_goes_at_once(sit):
    sit(20)
    (path,) = (sit.store.folder / "begun").iterdir()
    whole = path.read_bytes()
    sit()
    path.parent.mkdir()
    path.write_bytes(whole)
    assert sit() == ([], [])
    assert not path.parent.exists()


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_a_figure_that_is_not_finite_costs_its_row(sit, number):
    rows, _ = sit(outcome=Outcome(5.0, None, SUMMARY | {"error": ERROR | {"max": number}}))
    stored = [sit.store.read(key) for key in sit.keys]
    assert {row["status"] for row in stored} == {"failed"}
    assert stored[0]["reason"] == f"a figure of its row is not finite: accuracy.error.max is {number:g}"
    assert [row["accuracy"] for row in rows] == [None] * 3
    assert sit() == ([], [])


@pytest.mark.parametrize("number", [math.nan, math.inf, 0.0, -1.0])
def test_a_clock_that_tells_no_time_costs_its_row(sit, number):
    rows, _ = sit(ms=number)
    assert {row["status"] for row in rows} == {CellStatus.FAILED}
    assert rows[0]["reason"].startswith("the clock told")


def test_sittings_that_differ_are_told(sit):
    assert timings.sitting_warnings([1.0, 1.01, 0.99, 1.0, 1.02, 0.98], [3, 3]) == []
    assert timings.sitting_warnings([1.0] * 6, [6]) == []
    (told,) = timings.sitting_warnings([1.0, 1.01, 0.99, 1.5, 1.52, 1.48], [3, 3])
    assert told.startswith("sittings differ: it is 50% slower")
    assert timings.sitting_warnings([1.0, 3.0, 2.0, 0.5, 2.9, 2.3], [3, 3]) == [], "no more than they spread"
    sit(3 + 3 + 6 * 3)
    rows, _ = sit(ms=2.0)
    assert [text.partition(":")[0] for text in rows[0]["time"]["warnings"]][-1] == "sittings differ"
    assert rows[0]["time"]["sittings"] == [7, 5]


def test_a_line_is_written_in_one_piece_between_rounds(sit, monkeypatch):
    """Nothing is written between a sample and its pair, and nothing is forced to the disk in a short timing."""
    log = []
    write, flush = begun._write, begun.os.fsync
    monkeypatch.setattr(begun, "_write", lambda file, line: (log.append(line), write(file, line)))
    monkeypatch.setattr(begun.os, "fsync", lambda file: (log.append("fsync"), flush(file)))
    sit()
    rounds = [json.loads(line[9:]) for line in log if b'"round"' in (line if line != "fsync" else b"")]
    assert [said["round"] for said in rounds] == list(range(12))
    assert all(len(said["samples"]) == 3 for said in rounds)
