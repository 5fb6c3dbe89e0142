"""Offer `firsthit new`: the files that a method of one's own starts with, which compile, conform, run and are gated."""

from __future__ import annotations

import argparse
import contextlib
import importlib.metadata
import importlib.util
import json
import keyword
import re
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path
from string import Template

from harness import ROOT
from harness.commands import Add
from harness.contract import FirsthitError
from harness.plugins import BUILT_IN, ENTRY_POINTS
from harness.results.writing import write_new
from harness.stated import NAME

TEMPLATES = Path(__file__).with_name("templates")
METHOD = {  # the method's own files, none of which may be there already, each with its template
    "$folder/method.py": "method.py.txt",
    "$folder/kernel.glsl": "kernel.glsl",
    "$name.toml": "gate.toml",
    "tests/test_$name.py": "test_method.py.txt",
}
PROJECT = {  # files that methods share, which stay as they are where they are there
    ".github/workflows/gate.yml": "gate.yml",
    "README.md": "readme.md",
    ".gitignore": "gitignore.txt",
}
PACKAGE = {"pyproject.toml": "pyproject.toml.txt", "$package/__init__.py": "package.py.txt"}
OURS = ("configs", "firsthit", "harness", "methods", "reports", "surfaces")
TAKEN = ("baselines", "history", "runs", "tests")  # folders of the project that hold something else
DISTRIBUTION = re.compile("[A-Za-z]([A-Za-z0-9._-]*[A-Za-z0-9])?")
ADDRESS = re.compile(r"github\.com[:/]([\w.-]+/[\w.-]+?)(\.git)?/?$")


def add_parsers(add: Add) -> None:
    parser = add(
        "new",
        "firsthit new method mine",
        "Make a folder for a method of your own, with a kernel that works, the config of its gate, tests and a "
        "workflow for GitHub. No file that is there is changed.",
    )
    parser.add_argument("what", choices=["method"], help="what to make")
    parser.add_argument("name", metavar="NAME", help="of the method: letters, digits and _, a letter first")
    parser.add_argument(
        "--to", type=Path, default=Path(), metavar="DIR", help="the project's folder (default: this one)"
    )
    parser.add_argument(
        "--package",
        metavar="DISTRIBUTION",
        help="a package of this name to install, which holds this method and others",
    )
    parser.set_defaults(run=_new)


@dataclass(frozen=True)
class Project:
    """Hold what the templates are filled with: the method's name and, where there is one, the package's names."""

    name: str
    distribution: str | None

    @property
    def package(self) -> str:
        """Return the package's name in Python; "" without a package."""
        return re.sub("[-._]+", "_", self.distribution).lower() if self.distribution else ""

    @property
    def plugins(self) -> str:
        """Return the folder that --plugins is to name, from the project's folder."""
        return self.package or "."

    def files(self, which: dict[str, str]) -> dict[str, str]:
        """Return the texts of some files, filled in, by their paths in the project."""
        words = {
            "name": self.name,
            "folder": f"{self.package}/{self.name}" if self.package else self.name,
            "package": self.package,
            "distribution": self.distribution or "",
            "plugins": self.plugins,
            "repository": repository() or "OWNER/firsthit",
        }
        made = {}
        for path, template in which.items():
            text = (TEMPLATES / template).read_text(encoding="utf-8")
            made[Template(path).substitute(words)] = Template(text).substitute(words)
        return made


def _new(options: argparse.Namespace) -> int:
    project = Project(checked_name(options.name), options.package)
    folder: Path = options.to
    if project.distribution is not None:
        check_package(project.distribution, project.package, folder)
    files = project.files(METHOD)
    shared = project.files(PROJECT | (PACKAGE if project.package else {}))
    missing = {path: text for path, text in shared.items() if not (folder / path).exists()}
    write_new(folder, files | missing)
    for path in files | missing:
        print(f"made  {folder / path}")
    for path in sorted(shared.keys() - missing.keys()):
        print(f"kept  {folder / path}, which was there{wanting(folder / path, project)}")
    print(next_steps(folder, project, ".github/workflows/gate.yml" in missing))
    return 0


def checked_name(name: str) -> str:
    """Return a name that a method can have. Raises FirsthitError, which says what to write, for any other."""
    if not NAME.fullmatch(name):
        plain = re.sub("[^A-Za-z0-9]+", "_", name).strip("_")
        proposal = plain if NAME.fullmatch(plain) else f"method_{plain}".rstrip("_")
        raise FirsthitError(f"a method's name is letters, digits and _, a letter first: not {name!r}, but {proposal!r}")
    if (BUILT_IN / name).exists():
        raise FirsthitError(f"{name} is a method that firsthit brings; choose another name, such as {'my_' + name!r}")
    if name in OURS:
        raise FirsthitError(f"a folder {name} would stand before firsthit's own code; choose another name")
    if name in TAKEN:
        raise FirsthitError(f"the folder {name} holds something else in a project; choose another name")
    return name


def check_package(distribution: str, package: str, folder: Path) -> None:
    """Raise FirsthitError, which says what to write, for a package's name that cannot be installed or imported.

    `folder` is the project's, which may hold the package already.
    """
    if not DISTRIBUTION.fullmatch(distribution):
        plain = re.sub("[^A-Za-z0-9]+", "-", distribution).strip("-0123456789")
        raise FirsthitError(
            f"--package {distribution!r}: a package's name is letters, digits, '-', '_' and '.', a letter first and no "
            f"mark last; write {plain or 'my-methods'!r}"
        )
    there = (folder / package / "__init__.py").exists()  # made by this command before, and perhaps installed since
    other = not there and importlib.util.find_spec(package) is not None
    taken = package in (*OURS, *TAKEN) or package in sys.stdlib_module_names or other
    if keyword.iskeyword(package) or taken:
        raise FirsthitError(f"--package {distribution!r}: {package} means something else; write '{package}-methods'")


def repository() -> str | None:
    """Return the OWNER/NAME on GitHub that this firsthit was installed from, as far as it is known."""
    try:
        told = importlib.metadata.distribution("firsthit").read_text("direct_url.json")
    except importlib.metadata.PackageNotFoundError:
        told = None
    addresses = [str(json.loads(told).get("url", ""))] if told else []
    if (ROOT / ".git").exists():
        command = ["git", "-C", str(ROOT), "remote", "get-url", "origin"]
        with contextlib.suppress(OSError):  # without git there is no address from it
            addresses.append(subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip())
    return next((found[1] for address in addresses if (found := ADDRESS.search(address))), None)


def wanting(path: Path, project: Project) -> str:
    """Say what a shared file that was there already has to hold for this method; "" where nothing is missing."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.name == "gate.yml" and f"{project.name}.toml" not in text:
        return f"; add a step with {{ config: {project.name}.toml, plugins: {project.plugins} }}"
    if path.name == ".gitignore" and "runs/" not in text:
        return "; add a line: runs/"
    if path.name == "pyproject.toml" and not _enters(text, project.package):
        return f'; add: [project.entry-points."{ENTRY_POINTS}"] {project.package} = "{project.package}"'
    return ""


def _enters(text: str, package: str) -> bool:
    """Tell whether the text of a pyproject.toml names a package as one that holds methods."""
    try:
        points = tomllib.loads(text)["project"]["entry-points"][ENTRY_POINTS]
        return package in points.values()
    except (tomllib.TOMLDecodeError, KeyError, TypeError, AttributeError):
        return False


def next_steps(folder: Path, project: Project, workflow: bool) -> str:
    """Write the commands that come next, in their order, with what each of them is for."""
    name = project.name
    steps = [
        (f"compile --method {name}", "on every device here"),
        (f"conform --method {name} --surface torus", "answers, claims and knobs"),
        (f"run {name}.toml", "errors and times"),
        (f'bless {name}.toml --reason "first results"', "then commit"),
        (f"gate {name}.toml", "fails where something got worse"),
    ]
    lines = [] if folder.resolve() == Path.cwd() else [f"  cd {folder}"]
    lines += [f"  pip install --editable .  # then {name} is found without --plugins"] if project.package else []
    commands = [(f"  firsthit --plugins {project.plugins} {command}", meaning) for command, meaning in steps]
    width = max(len(command) for command, _ in commands)
    lines += [f"{command:<{width}}  # {meaning}" for command, meaning in commands]
    if workflow and repository() is None:
        lines.append(
            "In .github/workflows/gate.yml and README.md, write the owner of firsthit's repository in place of OWNER."
        )
    return "\n".join(["next:", *lines])
