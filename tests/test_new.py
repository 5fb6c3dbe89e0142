"""`firsthit new method`: what it makes works at once, changes nothing that was there, and is whole or not at all."""

import importlib.metadata
import os
import subprocess
import sys
import tomllib

import pytest

from harness import ROOT
from harness.cli import main
from harness.commands import new
from harness.contract import FirsthitError
from harness.plugins import find_methods
from harness.results import writing

from .conftest import usable_devices

pytestmark = pytest.mark.usefixtures("devices_found_once", "few_degrees")
OWN = ["mine.toml", "mine/kernel.glsl", "mine/method.py", "tests/test_mine.py"]
SHARED = [".github/workflows/gate.yml", ".gitignore", "README.md"]


def _files(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_what_is_made_compiles_conforms_runs_and_is_gated(here, capsys):
    if not usable_devices():
        pytest.skip("no device")
    device = usable_devices()[0].name
    assert main(["new", "method", "mine"]) == 0
    assert _files(here) == sorted(OWN + SHARED)
    for command in (
        ["compile", "--method", "mine", "--surface", "torus"],
        ["conform", "--method", "mine", "--surface", "torus", "--device", device],
        ["run", "mine.toml", "--device", device],
        ["bless", "mine.toml", "--device", device, "--reason", "first results"],
        ["gate", "mine.toml", "--device", device],
    ):
        assert main(["--plugins", ".", *command]) == 0, capsys.readouterr()
    assert "3 cells run, 0 reused; 3 ok" in capsys.readouterr().out
    where = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    ran = subprocess.run(command, cwd=here, env=where, capture_output=True, text=True, check=False)
    assert ran.returncode == 0 and "3 passed" in ran.stdout, ran.stdout


def test_the_tests_that_are_made_see_a_wrong_root_and_a_large_error(here):
    if not usable_devices():
        pytest.skip("no device")
    assert main(["new", "method", "mine"]) == 0
    kernel = here / "mine/kernel.glsl"
    right = kernel.read_text()
    where = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", "torus"]
    for old, wrong in (("t - step *", "t + 0.02 - step *"), ("real t = t0 +", "real t = 0.5 * (t0 + t1) +")):
        assert right.count(old) == 1
        kernel.write_text(right.replace(old, wrong))
        ran = subprocess.run(command, cwd=here, env=where, capture_output=True, text=True, check=False)
        assert ran.returncode == 1 and "1 failed" in ran.stdout, ran.stdout


def test_a_package_is_found_by_its_entry_point_and_takes_further_methods(here, capsys, monkeypatch):
    assert main(["new", "method", "mine", "--package", "Torus-Casters"]) == 0
    assert main(["new", "method", "other", "--package", "Torus-Casters"]) == 0
    out = capsys.readouterr().out
    assert "kept  pyproject.toml, which was there\n" in out
    assert "gate.yml, which was there; add a step with { config: other.toml, plugins: torus_casters }" in out
    stated = tomllib.loads((here / "pyproject.toml").read_text())["project"]
    points = stated["entry-points"]["firsthit.methods"]
    assert (stated["name"], points) == ("Torus-Casters", {"torus_casters": "torus_casters"})
    point = importlib.metadata.EntryPoint("torus_casters", points["torus_casters"], "firsthit.methods")
    monkeypatch.setattr(importlib.metadata, "entry_points", lambda **_: [point])
    monkeypatch.syspath_prepend(str(here))
    assert {"mine", "other"} <= find_methods().plugins.keys()


def test_the_package_holds_its_kernels_when_it_is_built(here, tmp_path_factory):
    assert main(["new", "method", "mine", "--package", "torus-casters"]) == 0
    to = tmp_path_factory.mktemp("installed")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--no-build-isolation"]
    ran = subprocess.run([*pip, "--target", str(to), "."], cwd=here, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert {"mine/kernel.glsl", "mine/method.py"} <= set(_files(to / "torus_casters"))


@pytest.mark.parametrize("standing", OWN)
def test_a_file_that_stands_in_the_way_is_named_and_nothing_is_written(here, capsys, standing):
    path = here / standing
    path.parent.mkdir(exist_ok=True)
    path.write_text("theirs")
    assert main(["new", "method", "mine"]) == 2
    assert f"{standing} is in {here} already; nothing was written" in capsys.readouterr().err
    assert _files(here) == [standing] and path.read_text() == "theirs"


def test_files_of_the_project_that_are_there_stay_as_they_are(here, capsys):
    (here / "README.md").write_text("theirs")
    (here / ".gitignore").write_text("build/\n")
    assert main(["new", "method", "mine"]) == 0
    assert (here / "README.md").read_text() == "theirs" and (here / ".gitignore").read_text() == "build/\n"
    out = capsys.readouterr().out
    assert "kept  README.md, which was there\n" in out
    assert "kept  .gitignore, which was there; add a line: runs/\n" in out


def test_a_write_that_fails_or_is_stopped_leaves_nothing(here, monkeypatch):
    replacing, calls = writing.replacing, []

    def stopped(path):
        calls.append(path)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return replacing(path)

    monkeypatch.setattr(writing, "replacing", stopped)
    with pytest.raises(KeyboardInterrupt):
        writing.write_new(here / "to", {"a/b/c": "1", "a/d": "2", "e": "3"})
    assert not list(here.iterdir())
    (here / "a").write_text("a file where a folder is wanted")
    with pytest.raises(FirsthitError, match="cannot write"):
        writing.write_new(here, {"e": "3", "a/b": "1"})
    assert _files(here) == ["a"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["dowell-jarratt"], "not 'dowell-jarratt', but 'dowell_jarratt'"),
        (["2nd"], "not '2nd', but 'method_2nd'"),
        (["newton"], "newton is a method that firsthit brings; choose another name, such as 'my_newton'"),
        (["tests"], "the folder tests holds something else"),
        (["history"], "the folder history holds something else"),  # where `gate --keep` keeps
        (["harness"], "a folder harness would stand before firsthit's own code"),
        (["mine", "--package", "numpy"], "numpy means something else; write 'numpy-methods'"),
        (["mine", "--package", "-x"], "expected one argument"),
        (["mine", "--package", "my package!"], "write 'my-package'"),
        (["mine", "--package", "json"], "json means something else; write 'json-methods'"),
        (["mine", "--package", "firsthit"], "firsthit means something else"),
    ],
)
def test_a_bad_name_is_refused_with_what_to_write(here, capsys, arguments, words):
    try:
        code = main(["new", "method", *arguments])
    except SystemExit as stopped:  # argparse's own
        code = stopped.code
    assert code == 2 and words in capsys.readouterr().err
    assert not list(here.iterdir())


def test_another_folder_is_made_and_named_in_the_next_commands(here, capsys):
    assert main(["new", "method", "mine", "--to", "work/casters"]) == 0
    assert _files(here / "work/casters") == sorted(OWN + SHARED)
    assert "next:\n  cd work/casters\n  firsthit --plugins . compile --method mine" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("told", "expected"),
    [
        ('{"url": "https://github.com/someone/firsthit.git", "vcs_info": {}}', "someone/firsthit"),
        ('{"url": "git@github.com:someone/rays", "vcs_info": {}}', "someone/rays"),
        ('{"url": "file:///home/someone/firsthit", "dir_info": {}}', None),
        (None, None),
    ],
)
def test_the_workflow_names_the_repository_that_firsthit_came_from(here, capsys, monkeypatch, told, expected):
    class Distribution:
        def read_text(self, _):
            return told

    monkeypatch.setattr(importlib.metadata, "distribution", lambda _: Distribution())
    monkeypatch.setattr(new, "ROOT", here)  # which is no clone
    assert new.repository() == expected
    assert main(["new", "method", "mine"]) == 0
    uses = f"uses: {expected or 'OWNER/firsthit'}@main"
    assert uses in (here / ".github/workflows/gate.yml").read_text()
    assert ("in place of OWNER" in capsys.readouterr().out) == (expected is None)
