"""What sets the project up on other machines: the versions of Python that are promised, and the drivers' packages."""

import os
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from harness.devices import opengl

ROOT = Path(__file__).parents[1]
NEEDED = ("sh", "id", "grep", "env")
NO_DEVICE = "#!/bin/sh\nexit 0\n"
RECORDS = '#!/bin/sh\necho "$@" >> "$(dirname "$0")/asked"\n'


@pytest.fixture
def programs(tmp_path: Path) -> Path:
    """A folder that is all of PATH: few real programs, and stand-ins that find no device and install nothing."""
    for name in NEEDED:
        (tmp_path / name).symlink_to(shutil.which(name) or name)
    (tmp_path / "dirname").symlink_to(shutil.which("dirname") or "dirname")
    for name, text in {"python": NO_DEVICE, "apt-get": RECORDS, "sudo": '#!/bin/sh\nshift\n"$@"\n'}.items():
        stand_in(tmp_path / name, text)
    return tmp_path


def stand_in(path: Path, text: str) -> None:
    path.write_text(text)
    path.chmod(0o755)


def drivers(programs: Path, *words: str) -> tuple[str, list[str]]:
    """Run drivers.sh there: what it printed, and the packages that it asked for."""
    command = [str(programs / "sh"), str(ROOT / "drivers.sh"), str(programs / "python"), *words]
    ran = subprocess.run(command, env={"PATH": str(programs)}, capture_output=True, text=True, check=True)
    asked = programs / "asked"
    lines = asked.read_text().splitlines() if asked.exists() else []
    packages = [word for line in lines if " install " in line for word in line.split() if not word.startswith("-")]
    return ran.stdout, [word for word in packages if word != "install"]


def test_what_opengl_misses_is_what_the_drivers_install(programs, monkeypatch):
    """Debian 13 has libEGL without libGL, which moderngl loads too."""
    monkeypatch.setattr(opengl, "_context", lambda: 1 / 0)
    (none,) = opengl.find.__wrapped__()
    named = set(re.findall(r"\blib[\w-]+", none.problem.partition("install ")[2]))
    said, packages = drivers(programs)
    assert named == {name for name in packages if name.startswith("lib")} == {"libegl1", "libgl1", "libgl1-mesa-dri"}
    assert all(name in said for name in packages)
    assert "pocl-opencl-icd" in packages


@pytest.mark.parametrize("browser", ["chromium", "chromium-browser", "google-chrome"])
def test_any_browser_that_the_tests_can_drive_is_enough(programs, browser):
    said, packages = drivers(programs, "chromium")
    assert packages == ["chromium"] and "chromium is missing" in said
    (programs / "asked").unlink()
    stand_in(programs / browser, NO_DEVICE)
    assert drivers(programs, "chromium") == ("", [])


def test_the_versions_of_python_that_are_promised_are_those_that_ci_runs():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    told = " ".join(project["project"]["classifiers"])
    promised = re.findall(r"Python :: (3\.\d+)", told)
    workflow = (ROOT / ".github/workflows/ci.yml").read_text()
    matrix = re.search(r"python: (\[.*\])", workflow)
    assert matrix and re.findall(r"3\.\d+", matrix[1]) == promised
    assert (
        project["project"]["requires-python"] == f">={promised[0]}" == f">={project['tool']['mypy']['python_version']}"
    )
    assert "run: .ci/run" in workflow


def made(tree: Path, **environment: str) -> list[str]:
    """The commands by which make would set up a tree."""
    command = ["make", "--dry-run", "--no-print-directory", ".venv/ready"]
    without = {name: value for name, value in os.environ.items() if name != "PYTHON" and not name.startswith("MAKE")}
    ran = subprocess.run(command, cwd=tree, env=without | environment, capture_output=True, text=True, check=True)
    return ran.stdout.splitlines()


def test_make_sets_up_with_the_python_that_is_named(tmp_path):
    """An environment of another interpreter never stands in for the one that was asked for."""
    for name in ("Makefile", "pyproject.toml", "constraints.txt", "drivers.sh"):
        shutil.copy(ROOT / name, tmp_path)
    (tmp_path / "bin").mkdir()
    for name, version in {"old": "3.11", "new": "3.14"}.items():
        stand_in(tmp_path / "bin" / name, f"#!/bin/sh\necho {version}\n")
    old, new = str(tmp_path / "bin/old"), str(tmp_path / "bin/new")
    assert f"{old} -m venv --clear .venv" in made(tmp_path, PYTHON=old)
    (tmp_path / ".venv/bin").mkdir(parents=True)
    (tmp_path / ".venv/bin/python").symlink_to(old)
    (tmp_path / ".venv/ready").touch()
    assert made(tmp_path, PYTHON=old) == ["make: '.venv/ready' is up to date."]
    assert made(tmp_path) == ["make: '.venv/ready' is up to date."]
    assert f"{new} -m venv --clear .venv" in made(tmp_path, PYTHON=new)


def test_the_page_of_licences_names_every_package_that_is_installed():
    pins = re.findall(r"^([\w.-]+)==", (ROOT / "constraints.txt").read_text(encoding="utf-8"), re.MULTILINE)
    told = set(re.findall(r"[\w.-]+", (ROOT / "docs" / "licences.md").read_text(encoding="utf-8").lower()))
    assert len(pins) > 50 and [name for name in pins if name.lower() not in told] == []
