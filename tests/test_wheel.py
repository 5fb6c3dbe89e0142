"""A wheel is whole: built from the tree and installed into an empty environment, firsthit does there what it does here.

Nothing is downloaded. The environment finds the packages that firsthit needs where this interpreter has them, behind
its own, so that firsthit itself can only come from the wheel.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest

from harness.experiment import shipped
from harness.plugins import find_methods
from harness.results import sources

from .conftest import usable_devices

ROOT = Path(__file__).parents[1]
PACKAGES = ("configs", "firsthit", "harness", "methods", "reports", "surfaces")
NEWEST_NEEDED = 77  # of setuptools, as pyproject.toml has it
CONFIG = """title = "One sphere"
surfaces = ["sphere"]
sizes = [32]
devices = ["any"]
precisions = ["float32"]
method = [{ name = "newton" }]
accuracy.size = 8
budget.seconds = 0.01
"""


class Installed:
    """An environment that holds the wheel, inside a git repository of somebody else's, and an empty folder to work in.

    The folder is not inside the environment.
    """

    def __init__(self, folder: Path) -> None:
        self.wheel = self._built(folder)
        self.work, environment = folder / "work", folder / "repository" / "environment"
        self.work.mkdir()
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(environment)], check=True)
        self.bin = environment / "bin"
        pip = (sys.executable, "-m", "pip", "--python", str(self.bin / "python"), "install", "--quiet")
        subprocess.run([*pip, "--no-deps", "--no-index", str(self.wheel)], check=True)
        (self.site,) = environment.glob("lib/*/site-packages")
        others = [path for path in sys.path if path.endswith(sources.LIBRARIES)]
        (self.site / "others.pth").write_text("\n".join(others) + "\n")
        for command in (["init", "-q"], ["add", "."], ["commit", "-qm", "somebody else's"]):
            (folder / "repository" / "file").write_text("theirs")
            (folder / "repository" / ".gitignore").write_text("environment\n")
            who = ["-c", "user.name=t", "-c", "user.email=t@example.org"]
            subprocess.run(["git", *who, "-C", str(folder / "repository"), *command], check=True)

    @staticmethod
    def _built(folder: Path) -> Path:
        """Build in a copy, since a build leaves folders behind that the next one would take files from."""
        tree = folder / "tree"
        litter = shutil.ignore_patterns(".*", "__pycache__", "*.egg-info", "build", "runs", "tests")
        shutil.copytree(ROOT, tree, ignore=litter)
        pip = (sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-index", "--no-build-isolation")
        built = subprocess.run([*pip, "--wheel-dir", str(folder), str(tree)], capture_output=True, text=True)
        assert built.returncode == 0, built.stdout + built.stderr
        (wheel,) = folder.glob("firsthit-*.whl")
        return wheel

    def run(self, *command: object) -> str:
        environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "MYPYPATH")}
        program, *arguments = map(str, command)
        ran = subprocess.run(
            [self.bin / program, *arguments],
            cwd=self.work,
            env=environment,
            capture_output=True,
            text=True,
            timeout=250,
            check=False,
        )
        assert ran.returncode == 0, ran.stdout + ran.stderr
        return ran.stdout

    def evaluate(self, text: str) -> object:
        """What a Python expression is there, as JSON."""
        return json.loads(self.run("python", "-c", f"import json\n{text}"))


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Installed:
    if int(version("setuptools").partition(".")[0]) < NEWEST_NEEDED:
        pytest.skip(f"building needs setuptools {NEWEST_NEEDED}: pip install --upgrade '.[dev]'")
    return Installed(tmp_path_factory.mktemp("wheel"))


def test_every_file_of_the_packages_is_in_the_wheel_and_no_other(installed):
    here = {file.relative_to(ROOT).as_posix() for name in PACKAGES for file in sources.files_in(ROOT / name)}
    there = {name for name in zipfile.ZipFile(installed.wheel).namelist() if ".dist-info/" not in name}
    assert there == here


def test_what_decides_a_row_is_the_same_there(installed):
    text = """
from harness import plugins; from harness.results import sources
assert str(sources.ROOT) == {site!r}, sources.ROOT
methods = {{name: sources.of_method(plugin.folder) for name, plugin in plugins.find_methods().plugins.items()}}
print(json.dumps([sources.methodology(), methods]))
"""
    methodology, methods = installed.evaluate(text.format(site=str(installed.site)))
    assert methodology == sources.methodology()
    assert methods == {name: sources.of_method(p.folder) for name, p in find_methods().plugins.items()}


def test_a_plugin_beside_firsthit_counts_with_its_packages_modules(installed):
    for name, text in {"__init__.py": "", "shared.py": "LIMIT = 4\n", "mine/kernel.glsl": ""}.items():
        (installed.site / "somebodys" / name).parent.mkdir(parents=True, exist_ok=True)
        (installed.site / "somebodys" / name).write_text(text)
    described = 'from firsthit import Method\nfrom somebodys.shared import LIMIT\nMETHOD = Method("mine", str(LIMIT))\n'
    (installed.site / "somebodys/mine/method.py").write_text(described)
    text = f"""
from pathlib import Path; from harness.results import sources
print(json.dumps(list(sources.of_method(Path({str(installed.site / "somebodys/mine")!r})))))
"""
    expected = ["__init__.py", "mine/kernel.glsl", "mine/method.py", "shared.py"]
    assert installed.evaluate(text) == [f"somebodys/{name}" for name in expected]


def test_methods_surfaces_and_configs_are_listed_and_planned_by_name(installed):
    names = installed.run("firsthit", "list", "configs")
    assert [line.split()[0] for line in names.splitlines()[1:]] == shipped.names()
    assert set(find_methods().plugins) <= set(installed.run("firsthit", "list", "methods").split())
    assert "barth_sextic" in installed.run("firsthit", "list", "surfaces")
    included = installed.run("firsthit", "plan", "szente-tables-1-2")
    assert "0 cells, 0 to run" in included
    assert str(installed.site / "configs") in included


def test_a_run_and_its_report_work_there_and_name_no_commit_of_others(installed):
    if not usable_devices():
        pytest.skip("no device")
    (installed.work / "one.toml").write_text(CONFIG)
    assert "1 cell run, 0 reused; 1 ok" in installed.run("firsthit", "run", "one.toml")
    plan = json.loads((installed.work / "runs/one/plan.json").read_text())
    assert plan["environment"]["commit"] is None and plan["environment"]["dirty"] is False
    installed.run("firsthit", "report", "runs/one")
    made = {path.name for path in (installed.work / "runs/one.report").iterdir()}
    assert {"report.pdf", "report.html", "results.csv", "results.parquet"} <= made


def test_a_blessed_baseline_is_found_beside_its_config(installed):
    text = """
from harness.experiment.shipped import located; from harness.gate import baseline
path = located("gate")
print(json.dumps(len(baseline.read(path.parent / "baselines" / path.name).rows)))
"""
    assert installed.evaluate(text) > 0


USER = """
import firsthit

rays = firsthit.rays_of(firsthit.View("front"), "torus", 8)
hits = firsthit.trace("torus", rays, method="newton", knobs={"EPSILON": 1e-4})
truth = firsthit.oracle(firsthit.surfaces.get("torus", R="0.6"), rays)
run = firsthit.run("quick", devices=["opencl:pocl"], tell=print)
METHOD = firsthit.Method(name="mine", source="here", parameters=(firsthit.Parameter("STEPS", 200, "steps"),))
reveal_type(hits.t)
reveal_type(truth.status)
reveal_type(run.folder)
reveal_type(METHOD.parameters[0].name)
reveal_type(firsthit.render("torus", "newton"))
reveal_type(firsthit.recommend("torus", 1e-4).contenders[0].ms)
reveal_type(firsthit.devices()[0].problem)
"""


def test_a_typed_script_of_a_user_passes_mypy_strict_and_knows_the_types(installed):
    script = installed.work / "user.py"
    script.write_text(textwrap.dedent(USER))
    command = [sys.executable, "-m", "mypy", "--strict", "--python-executable", str(installed.bin / "python")]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    ran = subprocess.run(
        [*command, "--config-file", os.devnull, script.name],
        cwd=installed.work,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    revealed = re.findall(r'Revealed type is "(.*)"', ran.stdout)
    words = ("float64", "_8Bit", "pathlib.Path", "str", "_8Bit", "float", "str | None")
    assert len(revealed) == len(words), ran.stdout
    assert all(word in found for word, found in zip(words, revealed, strict=True)), revealed
