"""What is kept by commit: its files, and which commit a run is of."""

import json

import pytest

from harness import ROOT
from harness.contract import FirsthitError
from harness.gate import repository
from harness.gate.keep import keeping
from harness.results import commits, sealed
from harness.results.commits import same_arithmetic

from .kept_runs import DEVICE, SLOT, committed, git, kept, row

ROWS = {SLOT: row(misses=3, error_max=1.0828379917171563e-06), "other": row(misses=0)}


def test_a_kept_run_is_read_again_as_it_was_written_and_its_bytes_are_the_same_each_time(tmp_path):
    path = commits.write(tmp_path, kept(0, ROWS), "opencl:one 1f3a6c")
    assert path.name == "2026-03-01-01aaaaaaaaaa-opencl-one-1f3a6c.json"
    before = path.read_bytes()
    assert len(before.splitlines()) == 9 + len(ROWS), "a row is a line"
    assert commits.write(tmp_path, kept(0, ROWS), "opencl:one 1f3a6c").read_bytes() == before
    [found], problems = commits.read_all(tmp_path)
    assert problems == []
    assert (found.commit, found.device, found.rows) == (kept(0, ROWS).commit, DEVICE, ROWS)


def test_a_clean_tree_replaces_its_commit_and_a_dirty_one_stands_beside_it(tmp_path):
    for misses, dirty in ((1, False), (2, True), (3, True), (4, False)):
        commits.write(tmp_path, kept(0, {SLOT: row(misses=misses)}, dirty), "opencl:one 1f3a6c")
    found, _ = commits.read_all(tmp_path)
    assert {(one.commit.dirty, one.rows[SLOT]["misses"]) for one in found} == {(False, 4), (True, 3)}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"misses": 3', '"misses": 3,,', "damaged"),
        ('"misses": 3', "<<<<<<< HEAD", "damaged"),
        ('"misses": 3', '"misses": NaN', "it holds NaN"),
        ('"misses": 3', '"misses": 1e999', "its misses: inf is no finite number"),
        ('"status": "ok"', '"state": "ok"', "status is missing"),
        ('"scene": "s"', '"scene": 4', "scene is no text: 4"),
        ('"name": "opencl:one"', '"title": "One"', "name is missing"),
        ('"dirty": false', '"dirty": 0', "dirty is no truth value: 0"),
        ('"hash": "01', '"hash": "zz', "names no commit"),
        ("2026-03-01T12", "some day", "damaged"),
        ("12:00:00+00:00", "12:00:00+02:00", "dates are in UTC"),
        ("12:00:00+00:00", "12:00:00", "dates are in UTC"),
        ('"format": 1', '"format": 2', "not of this version's format (2, not 1)"),
        ('"commit": {', '"comit": {', "commit is missing"),
    ],
)
def test_a_damaged_file_is_named_with_the_reason_and_the_others_are_read(tmp_path, old, new, words):
    path = commits.write(tmp_path, kept(0, ROWS), "one")
    commits.write(tmp_path, kept(1, ROWS), "one")
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    assert "its checksum does not hold" in commits.read_all(tmp_path)[1][0]
    path.write_bytes(sealed.with_seal("{\n" + text.replace(old, new, 1).partition("\n")[2]))
    found, [problem] = commits.read_all(tmp_path)
    assert len(found) == 1
    assert str(path) in problem
    assert words in problem


def test_a_file_that_was_cut_or_left_half_written_costs_no_other(tmp_path):
    path = commits.write(tmp_path, kept(0, ROWS), "one")
    commits.write(tmp_path, kept(1, ROWS), "one")
    (tmp_path / f".{path.name}.x.json").write_bytes(path.read_bytes()[:50])  # what a stopped process leaves
    assert [len(found) for found in commits.read_all(tmp_path)] == [2, 0]
    path.write_bytes(path.read_bytes()[:-40])
    assert [len(found) for found in commits.read_all(tmp_path)] == [1, 1]


def test_the_same_arithmetic_is_that_of_the_rows_precision_and_host_whatever_the_processor():
    print_ = {"float32": {"sums": "a"}, "float64": {"sums": "b"}, "host": {"exp": "c"}, "raster": {"all": "d"}}
    one = DEVICE | {"arithmetic": print_}
    assert same_arithmetic(one, SLOT) == same_arithmetic(one | {"processor": "Q", "driver": "2"}, SLOT)
    for part, own, alone in (
        ("float32", SLOT, "a family float64"),
        ("float64", "a family float64", SLOT),
        ("host", SLOT, None),
        ("raster", "a torus front 1x1x1 float32 raster", SLOT),
    ):
        other = DEVICE | {"arithmetic": print_ | {part: {"sums": "z"}}}
        assert same_arithmetic(one, own) != same_arithmetic(other, own)
        assert alone is None or same_arithmetic(one, alone) == same_arithmetic(other, alone)
    assert same_arithmetic(DEVICE, SLOT) != same_arithmetic(DEVICE | {"processor": "Q"}, SLOT)
    assert same_arithmetic(DEVICE, SLOT) == same_arithmetic(DEVICE | {"name": "another", "versions": {}}, SLOT)


@pytest.fixture
def tree(tmp_path):
    """A repository with a config and a method, and its folder of plugins."""
    top = tmp_path / "tree"
    (top / "plugins" / "mine").mkdir(parents=True)
    (top / "plugins" / "mine" / "method.py").write_text("")
    (top / "tiny.toml").write_text("")
    (top / "README").write_text("one")
    git(top, "init", "-q")
    committed(top, "first")
    return top


def test_the_repository_is_that_of_the_plugins_else_of_the_config_else_this_projects(tree, tmp_path):
    lone = tmp_path / "alone"
    lone.mkdir()
    config = lone / "tiny.toml"
    config.write_text("")
    assert repository.holding(tree / "plugins", config) == tree.resolve()
    assert repository.holding(lone, tree / "tiny.toml") == tree.resolve()
    own = repository.holding(lone, config)
    assert own is None or own == ROOT.resolve()
    (tree / ".gitignore").write_text("hidden/\n")
    (tree / "hidden").mkdir()
    assert repository.holding(tree / "hidden", config) == own, "what a repository ignores is not held by it"


def test_outside_any_repository_keeping_is_refused_before_anything_runs(tmp_path, monkeypatch):
    monkeypatch.setattr(repository, "ROOT", tmp_path)
    with pytest.raises(FirsthitError, match=r"in no git repository.*git init"):
        keeping(tmp_path, tmp_path / "tiny.toml", tmp_path / "history", [])
    git(tmp_path, "init", "-q")
    with pytest.raises(FirsthitError, match="has no commit yet"):
        keeping(tmp_path, tmp_path / "tiny.toml", tmp_path / "history", [])


def test_a_repository_that_git_will_not_read_is_told_and_not_passed_over(tree):
    (tree / ".git" / "config").write_text("[core\n")
    with pytest.raises(FirsthitError, match=r"git in .*config"):
        repository.holding(tree / "plugins", tree / "tiny.toml")


def _changed(tree):
    written = [tree / "history" / "tiny", tree / "runs", tree / "plugins" / "mine" / "runs"]
    state = repository.commit_of(tree, tree / "plugins", tree / "tiny.toml", written)
    changed = repository.changed(tree, tree / "plugins", tree / "tiny.toml", written)
    assert state.dirty == bool(changed)
    assert state.hash == git(tree, "rev-parse", "HEAD")
    return changed


def test_a_tree_is_dirty_where_what_decides_a_row_is_not_as_committed(tree):
    assert _changed(tree) == []
    for name in ("history/tiny/a.json", "runs/x.json", "plugins/mine/runs/x.json", "notes.txt"):
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text("new")
    assert _changed(tree) == [], "what commands write, and what no run reads, does not count"
    (tree / "README").write_text("two")
    assert _changed(tree) == ["README"]
    committed(tree, "second: with a kept run")
    assert _changed(tree) == []
    (tree / "history" / "tiny" / "a.json").write_text("kept again")
    assert _changed(tree) == []
    (tree / "plugins" / "mine" / "kernel.glsl").write_text("a kernel that git does not know")
    assert _changed(tree) == ["plugins/mine/kernel.glsl"]
    git(tree, "checkout", "-q", "--", ".")
    (tree / "plugins" / "mine" / "kernel.glsl").unlink()
    git(tree, "rm", "-q", "--cached", "tiny.toml")
    git(tree, "commit", "-q", "-m", "gone")
    assert _changed(tree) == ["tiny.toml"]


def test_subject_and_date_are_the_commits_whatever_is_in_them(tree, monkeypatch):
    monkeypatch.setenv("GIT_COMMITTER_DATE", "2026-04-05T23:30:00-0200")
    committed(tree, 'Roots: "a" <b> é\n\nand more')
    state = repository.commit_of(tree, tree / "plugins", tree / "tiny.toml")
    assert (state.subject, state.date) == ('Roots: "a" <b> é', "2026-04-06T01:30:00+00:00")


def test_the_line_is_heads_first_parents_whatever_their_dates(tree, tmp_path, monkeypatch):
    hashes = [git(tree, "rev-parse", "HEAD")]
    monkeypatch.setenv("GIT_COMMITTER_DATE", "2020-01-01T00:00:00Z")  # older than the commit before
    hashes.append(committed(tree, "second"))
    git(tree, "checkout", "-q", "-b", "side", hashes[0])
    side = committed(tree, "on a branch")
    git(tree, "checkout", "-q", "main")
    git(tree, "merge", "-q", "--no-ff", "-m", "merge", "side")
    hashes.append(git(tree, "rev-parse", "HEAD"))
    assert repository.line(tree, {*hashes, side, "f" * 40}) == hashes
    assert repository.line(tree, {"f" * 40}) is None, "a repository that knows none of them tells nothing"
    git(tmp_path, "clone", "-q", "--depth", "1", f"file://{tree}", "shallow")
    assert repository.line(tmp_path / "shallow", {*hashes, side}) is None


def test_kept_files_are_no_part_of_what_decides_a_row():
    from harness.results import sources

    assert "harness/results/commits.py" not in sources.methodology()


def test_a_kept_file_is_small(tmp_path):
    """84 rows, as the project's own gate has."""
    path = commits.write(tmp_path, kept(0, {f"{SLOT} {i}": ROWS[SLOT] for i in range(84)}), "one")
    assert path.stat().st_size < 20_000
    assert json.loads(path.read_text())["rows"]
