"""The history of kept runs: its steps and their order, and the command with real gate runs."""

import json
import random
import re
import sys
from collections import Counter

import pytest

from harness import ROOT
from harness.cli import main
from harness.gate.judge import Tolerance, Verdict, tolerances_of
from harness.kernels import sections
from harness.results import commits
from reports.history import axes, series

from .conftest import usable_devices
from .kept_runs import DEVICE, SLOT, commit, committed, git, kept, row
from .kept_runs import series as runs_of

RULES = tolerances_of({})


def graphs(kept_runs, line=None, figure="misses"):
    return [graph for graph in series.graphs(kept_runs, line, RULES) if graph.figure == figure]


def stepped(kept_runs, line=None, figure="misses"):
    """The steps of one figure, in the order of commits: before, now, whether worse, and the commit's number."""
    steps = [step for graph in graphs(kept_runs, line, figure) for step in graph.steps]
    return [(s.before, s.now, s.worse, int(s.commit.hash[:2], 16) - 1) for s in sorted(steps, key=lambda s: s.at)]


def test_a_step_is_what_the_gate_does_not_pass_between_two_commits():
    rng = random.Random(3)
    for name, tolerance in RULES.items():
        found = Counter()
        for _ in range(200):
            before = rng.choice([0, 3, 1e-6, 1.0, 250.0])
            near = before + rng.choice([0.0, 0.999, -0.999, 1.001, -1.001, 5.0, -5.0]) * (
                tolerance.absolute + tolerance.relative * abs(before) or 1.0
            )
            steps = stepped(runs_of(before, near, figure=name), figure=name)
            verdict = tolerance.verdict(before, near)
            assert [(step[2], step[3]) for step in steps] == (
                [] if verdict is Verdict.PASS else [(verdict is Verdict.REGRESSED, 1)]
            )
            found[verdict] += 1
        assert set(found) == {Verdict.PASS, Verdict.IMPROVED, Verdict.REGRESSED}


def test_consecutive_commits_are_compared_and_not_the_first_with_the_last():
    drifting = [1e-6 * 1.04**i for i in range(20)]
    assert stepped(runs_of(*drifting, figure="error_max"), figure="error_max") == []
    assert stepped(runs_of(0, 0, 2, 2, 1)) == [("0", "2", True, 2), ("2", "1", False, 4)]


def crept(*values, figure="error_max"):
    """What figures crept: before, now, whether worse, and the numbers of the two commits."""
    drawn = graphs(runs_of(*values, figure=figure), figure=figure)
    numbers = [[int(c.hash[:2], 16) - 1 for c in (s.since, s.commit)] for g in drawn for s in g.crept]
    found = [step for graph in drawn for step in graph.crept]
    return [(s.before, s.now, s.worse, *at) for s, at in zip(found, numbers, strict=True)]


def test_what_creeps_is_told_as_such():
    drifting = [1e-6 * 1.04**i for i in range(20)]
    assert crept(*drifting) == [("1e-06", "2.10685e-06", True, 0, 19)]
    assert crept(*reversed(drifting)) == [("2.10685e-06", "1e-06", False, 0, 19)]
    back = [*reversed(drifting[:10]), *drifting[1:]]
    assert crept(*back) == [("1e-06", "2.10685e-06", True, 9, 28)], "since the best"
    assert crept(*drifting, 1e-6) == [("1e-06", "2.10685e-06", True, 0, 19)], "the last before a step"
    assert crept(1e-6, 2e-6, 2.04e-6) == [], "all of it is one step"
    assert crept(*([1e-6, 1.04e-6] * 5)) == []
    assert crept(*drifting[:5], None, *drifting[5:]) == [("1e-06", "2.10685e-06", True, 0, 20)]
    found = series.steps(graphs(runs_of(*drifting, figure="error_max"), figure="error_max"))
    assert [step.crept for step in found] == [True]


def test_a_commit_that_has_no_row_is_passed_over_and_what_came_after_it_is_found():
    all_runs = runs_of(0, 0, 2)
    all_runs[1] = kept(1, {})
    assert stepped(all_runs) == [("0", "2", True, 2)]
    [graph] = graphs(all_runs)
    assert [(span.value, len(span.points), span.joined) for span in graph.spans] == [(0, 1, False), (2, 1, True)]
    assert graph.steps[0].since.hash == commit(0).hash


def test_another_scene_breaks_the_line_and_is_no_step():
    all_runs = [kept(i, {SLOT: row(misses=m, scene=s)}) for i, (m, s) in enumerate([(0, "a"), (9, "b"), (12, "b")])]
    assert stepped(all_runs) == [("9", "12", True, 2)]
    [graph] = graphs(all_runs)
    assert [span.joined for span in graph.spans] == [False, False, True]
    same = [kept(i, {SLOT: row(misses=1, scene=s)}) for i, s in enumerate("aabb")]
    assert [(len(span.points), span.joined) for span in graphs(same)[0].spans] == [(2, False), (2, False)]


def test_a_figure_that_is_gone_is_a_step_and_so_is_its_return_changed():
    assert stepped(runs_of(3, None, None, 4)) == [("3", "none", True, 1), ("3", "4", True, 3)]
    assert stepped(runs_of(3, None, 3)) == [("3", "none", True, 1)]
    assert [span.joined for span in graphs(runs_of(3, None, 3))[0].spans] == [False, False]


def test_a_status_is_drawn_where_it_changes_and_explains_why_figures_are_gone():
    rows = [row(misses=0), {"status": "failed", "scene": "s", "reason": "no"}, row(misses=1)]
    all_runs = [kept(i, {SLOT: one, "other": row(misses=0)}) for i, one in enumerate(rows)]
    assert stepped(all_runs, figure="status") == [("ok", "failed", True, 1), ("failed", "ok", False, 2)]
    assert stepped(all_runs) == [("0", "1", True, 2)]
    [graph] = graphs(all_runs, figure="status")
    assert (graph.slot, graph.steps[0].notes) == (SLOT, ("no",))


def test_devices_and_arithmetics_are_lines_of_their_own():
    other = DEVICE | {"processor": "Q"}
    mixed = [kept(0, {SLOT: row(misses=0)}), kept(1, {SLOT: row(misses=5)}, device=other)]
    mixed += [kept(2, {SLOT: row(misses=0)}), kept(3, {SLOT: row(misses=5)}, device=other)]
    assert stepped(mixed) == []
    assert len({graph.device for graph in graphs(mixed)}) == 2
    alike = {"arithmetic": {"float32": {"sums": "a"}, "host": {"exp": "b"}}}
    same = [kept(i, {SLOT: row(misses=5 * (i % 2))}, device=(other if i % 2 else DEVICE) | alike) for i in range(2)]
    assert stepped(same) == [("0", "5", True, 1)], "two processors of one arithmetic are one line"
    again = [*same, kept(1, {SLOT: row(misses=5)}, device=DEVICE | alike)]
    assert [len(span.points) for span in graphs(again)[0].spans] == [1, 1], "the same commit counts once"


def test_devices_without_a_fingerprint_are_told_apart_by_their_facts():
    for untold in ({}, {"float32": {}, "host": {}}, {"host": {"exp": "b"}}):
        devices = [DEVICE | {"arithmetic": untold, "processor": name} for name in "PQ"]
        mixed = [kept(i, {SLOT: row(misses=5 * (i % 2))}, device=devices[i % 2]) for i in range(4)]
        assert stepped(mixed) == [], untold


def test_meshes_by_other_packages_are_lines_of_their_own():
    mixed = [kept(i, {SLOT: row(misses=5 * (i % 2), mesher=f"m {i % 2}")}) for i in range(4)]
    assert stepped(mixed) == []
    assert len({graph.device for graph in graphs(mixed)}) == 2
    assert stepped([*mixed, kept(4, {SLOT: row(misses=9, mesher="m 0")})]) == [("0", "9", True, 4)]


def test_evaluations_of_a_quadtree_are_compared_where_it_begins_at_the_same_level():
    values = [(100.0, 0, 3), (700.0, 0, 5), (100.0, 4, 3), (900.0, 4, 5)]
    mixed = [kept(i, {SLOT: row(evaluations_mean=e, misses=m, device_level=n)}) for i, (e, m, n) in enumerate(values)]
    assert stepped(mixed, figure="evaluations_mean") == [("700", "900", True, 3)]
    assert stepped(mixed) == [("0", "4", True, 2)], "other figures do not depend on the level"
    devices = {graph.device for graph in graphs(mixed, figure="evaluations_mean")}
    assert devices == {"opencl:one, from level 3", "opencl:one, from level 5"}


def test_dirty_trees_and_other_branches_are_drawn_apart_and_make_no_step():
    dirty = [*runs_of(0, 0, 0), kept(1, {SLOT: row(misses=7)}, dirty=True)]
    assert stepped(dirty) == []
    [graph] = graphs(dirty)
    assert [(p.place.at, p.value, p.place.apart) for p in graph.apart] == [(1.5, 7, series.DIRTY)]
    assert not graph.flat
    branch = runs_of(0, 7, 0)
    line = [commit(0).hash, commit(2).hash]
    assert stepped(branch, line) == []
    assert [(p.place.at, p.place.apart) for p in graphs(branch, line)[0].apart] == [(0.5, series.ASIDE)]
    again = kept(2, {SLOT: row(misses=7)}, dirty=True)
    backwards = [commit(i).hash for i in (2, 1, 0)]
    assert graphs([*runs_of(0, 0, 0), again], backwards)[0].apart[0].place.at == 0.5, "beside its own commit"
    late = graphs(runs_of(0, 0, 7, 0), [commit(i).hash for i in (0, 1, 3)])[0].apart
    assert [p.place.at for p in late] == [1.5], "behind the last commit of the line that is no newer"
    assert len(stepped(branch)) == 2, "without a line all clean commits are on it"


def test_the_line_orders_commits_and_dates_do_where_there_is_none():
    backwards = [commit(2).hash, commit(1).hash, commit(0).hash]
    assert stepped(runs_of(0, 2, 4)) == [("0", "2", True, 1), ("2", "4", True, 2)]
    assert stepped(runs_of(0, 2, 4), backwards) == [("4", "2", False, 1), ("2", "0", False, 0)]
    assert stepped(list(reversed(runs_of(0, 2, 4)))) == [("0", "2", True, 1), ("2", "4", True, 2)]


def test_steps_are_listed_the_worst_first_and_improvements_last():
    rows = [{f"row {i}": row(error_max=1e-6, misses=0) for i in range(4)} for _ in range(2)]
    rows[1]["row 0"] = row(error_max=2e-6, misses=0)
    rows[1]["row 1"] = row(error_max=8e-6, misses=0)
    rows[1]["row 2"] = row(error_max=1e-9, misses=0)
    rows[1]["row 3"] = row(error_max=1e-6, misses=1)
    found = series.steps(series.graphs([kept(i, one) for i, one in enumerate(rows)], None, RULES))
    assert [step.slot for step in found] == ["row 3", "row 1", "row 0", "row 2"]


def test_the_values_of_a_step_have_six_digits_or_as_many_as_tell_them_apart():
    name = "evaluations_mean"
    assert stepped(runs_of(1.38500976562, 2.0, figure=name), figure=name) == [("1.38501", "2", True, 1)]
    near = stepped(runs_of(1.38500976562, 1.38500986562, figure=name), figure=name)
    assert near == [("1.38500976562", "1.38500986562", True, 1)]


def test_a_step_tells_what_it_is_not_due_to():
    rows = [{SLOT: row(misses=0)}, {SLOT: row(misses=1)}, {SLOT: row(misses=2, program="q")}]
    all_runs = [kept(i, one) for i, one in enumerate(rows)]
    object.__setattr__(all_runs[2], "harness", {"version": "2", "commit": "def"})
    notes = [step.notes for step in graphs(all_runs)[0].steps]
    assert notes == [("the row's program is the same",), ("firsthit changed too, 1 abc to 2 def",)]
    object.__setattr__(all_runs[2], "harness", {"version": "2", "commit": commit(2).hash[:12]})
    assert graphs(all_runs)[0].steps[1].notes == (), "where the commit is firsthit's own it is said already"


def test_a_change_that_is_no_step_is_drawn_as_a_small_one():
    [graph] = graphs(runs_of(1.0, 1.02, figure="error_max"), figure="error_max")
    scale = axes.Scale.of(graph)
    assert 0.1 < scale.position(1.02) - scale.position(1.0) < 0.3
    [graph] = graphs(runs_of(1e-6, 1e-2, 1e-4, figure="error_max"), figure="error_max")
    scale = axes.Scale.of(graph)
    assert [round(scale.position(v), 6) for v in (1e-6, 1e-4, 1e-2)] == [0.0, 0.5, 1.0]
    assert axes.Scale.of(graphs(runs_of(0))[0]).position(0) == 0.5


CONFIG = """title = "A plugin"
surfaces = ["torus"]
sizes = [32]
devices = ["{device}"]
[[method]]
name = "mine"
[accuracy]
size = 16
[budget]
seconds = 0.5
"""


@pytest.fixture
def project(tmp_path, capsys, devices_found_once):  # noqa: ARG001
    """A repository with one method, its config, and a function that runs a command of it: exit code, stdout, stderr."""
    names = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
    if not names:
        pytest.skip("no OpenCL device")
    top = tmp_path / "project"
    (top / "methods" / "mine").mkdir(parents=True)
    for file in ("method.py", "kernel.glsl"):
        text = (ROOT / "methods" / "newton" / file).read_text().replace('name="newton"', 'name="mine"')
        (top / "methods" / "mine" / file).write_text(text)
    (top / "tiny.toml").write_text(CONFIG.format(device=names[0]))
    git(top, "init", "-q")

    def run(command, *arguments):
        capsys.readouterr()
        more = ["--runs", tmp_path / "runs"] if command != "history" else []
        code = main(list(map(str, ["--plugins", top / "methods", command, top / "tiny.toml", *more, *arguments])))
        return code, *capsys.readouterr()

    run.top, run.out = top, tmp_path / "out"
    return run


def _plant(top, old, new):
    path = top / "methods" / "mine" / "kernel.glsl"
    assert path.read_text().count(old) == 1
    path.write_text(path.read_text().replace(old, new))
    sections._read.cache_clear()  # a process reads a kernel once


def test_real_gate_runs_of_six_commits_give_the_steps_that_were_planted(project):
    """Four of six commits are kept, and a dirty tree; one of them looks twice, and the last looks once again."""
    top = project.top
    code, _, err = project("history")
    assert code == 2
    assert f"`firsthit --plugins {top / 'methods'} gate {top / 'tiny.toml'} --keep` keeps" in err
    committed(top, "a method")
    assert project("bless", "--reason", "the first")[0] == 0
    assert project("gate", "--keep")[0] == 0
    code, out, _ = project("history", "-o", project.out)
    assert code == 0
    assert "1 kept run, 0 steps" in out
    assert "One commit is on the line; a step needs two" in (project.out / "index.html").read_text()
    committed(top, "README alone")
    project("gate", "--keep")
    _plant(top, "hit.evaluations = 1;", "hit.evaluations = 2;")
    code, _, err = project("gate", "--keep")
    assert code == 1, "a gate that fails keeps its rows"
    assert "kept apart" in err and "methods/mine/kernel.glsl not as committed" in err
    worse = committed(top, "mine looks twice")
    assert project("gate", "--keep")[0] == 1
    committed(top, "not kept")
    _plant(top, "hit.evaluations = 2;", "hit.evaluations = 1;")
    committed(top, "not kept either")
    better = committed(top, "mine looks once again")
    assert project("gate", "--keep")[0] == 0
    _plant(top, "return missed(hit);", "return mised(hit);")
    assert project("gate", "--keep", "--history", top / "elsewhere")[0] == 1
    [failed] = (top / "elsewhere" / "tiny").iterdir()
    [entry] = json.loads(failed.read_text())["rows"].values()
    assert entry["status"] == "failed"
    assert 0 < len(entry["reason"]) <= 300
    _plant(top, "return mised(hit);", "return missed(hit);")
    folder = top / "history" / "tiny"
    assert len(list(folder.iterdir())) == 5
    code, out, _ = project("history", "-o", project.out)
    assert code == 0
    assert [line.split()[:2] for line in out.splitlines()[1:3]] == [
        ["worse", "evaluations_mean"],
        ["better", "evaluations_mean"],
    ]
    text = (project.out / "index.html").read_text()
    assert "first parents" in text
    items = re.findall(r'<li id="s\d+">(.*?)</li>', text)
    assert [worse[:8] in items[0], "mine looks twice" in items[0]] == [True, True]
    assert [better[:8] in items[1], f"last kept before: {worse[:8]}" in items[1]] == [True, True]
    assert "Rings are commits with uncommitted changes (1 kept so)" in text
    assert (project.out / "evaluations_mean.png").is_file()
    damaged = sorted(folder.iterdir())[0]
    damaged.write_text("{")
    code, out, err = project("history", "-o", project.out, "--history", top / "history")
    assert code == 0
    assert str(damaged) in err
    assert damaged.name in (project.out / "index.html").read_text()
    assert "4 kept runs" in out


def test_keeping_outside_any_repository_ends_before_anything_runs(project, monkeypatch, tmp_path):
    from harness.gate import repository

    assert project("bless", "--reason", "the first")[0] == 0
    (project.top / ".git").rename(tmp_path / "gone")
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    code, out, err = project("gate", "--keep", "--force")
    assert (code, out) == (2, "")
    assert "in no git repository" in err
    assert "[1/1]" not in err


def test_where_nothing_can_be_drawn_the_command_says_what_to_do(tmp_path, monkeypatch, capsys):
    config = tmp_path / "tiny.toml"
    config.write_text('title = "t"\nsurfaces = ["torus"]\n[[method]]\nname = "newton"\n')
    commits.write(tmp_path / "history" / "tiny", kept(0, {SLOT: row(misses=0)}), "one")
    (tmp_path / "file").write_text("")
    assert main(["history", str(config), "-o", str(tmp_path / "file")]) == 2
    assert "cannot write the history into" in capsys.readouterr().err
    assert main(["history", str(config), "-o", "/proc/history"]) == 3, "no mistake of the user: a disk that refuses"
    assert "cannot write the history into /proc/history" in capsys.readouterr().err
    for name in [name for name in sys.modules if name.startswith(("reports.history", "reports.drawing"))]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["history", str(config), "-o", str(tmp_path / "out")]) == 3
    assert "needs the package matplotlib: pip install 'firsthit[report]'" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_damaged_file_is_told_on_a_quiet_screen_too(tmp_path, capsys):
    config = tmp_path / "tiny.toml"
    config.write_text('title = "t"\nsurfaces = ["torus"]\n[[method]]\nname = "newton"\n')
    folder = tmp_path / "history" / "tiny"
    commits.write(folder, kept(0, {SLOT: row(misses=0)}), "one")
    (folder / "two.json").write_text("{")
    assert main(["history", str(config), "-q", "-o", str(tmp_path / "out")]) == 0
    assert f"{folder / 'two.json'}" in " ".join(capsys.readouterr().err.split())


def test_a_tolerance_of_the_config_decides_what_a_step_is():
    own = {"misses": Tolerance("lower", 3.0, 0.0)}
    found = series.graphs(runs_of(0, 3, 7), None, own)
    assert [(step.before, step.now) for graph in found for step in graph.steps] == [("3", "7")]
    assert {graph.figure for graph in found} == {"misses"}


def test_a_file_for_each_commit_and_device_is_what_the_command_reads(tmp_path):
    for number, device in ((0, DEVICE), (0, DEVICE | {"name": "opencl:two"}), (1, DEVICE)):
        commits.write(tmp_path, kept(number, {SLOT: row(misses=0)}, device=device), str(device["name"]))
    found, _ = commits.read_all(tmp_path)
    assert len(found) == 3
    assert {graph.device: len(graph.spans[0].points) for graph in graphs(found)} == {"opencl:one": 2, "opencl:two": 1}
