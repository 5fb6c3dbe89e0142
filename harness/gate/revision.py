"""Get another git revision's programs of a config, which that revision's own code makes in a temporary folder."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from harness import ROOT
from harness.contract import FirsthitError, Program, Section
from harness.devices.raster import Batch
from harness.experiment.kinds.programs import Programs
from harness.results import git
from harness.results.writing import temporary_folder

EXPORT = Path(__file__).with_name("export.py")
PLAN_SECONDS = 1800.0  # for the other revision's code to make all programs; a method.py of it may never end
SUBMODULE = "160000"  # the mode of its entry in a tree
ALONE = ("-c", "core.hooksPath=/dev/null", "-c", "core.fsmonitor=false", "-c", "core.splitIndex=false")


@dataclass(frozen=True, eq=False)
class Former:
    """Hold one cell at the other revision.

    programs: what it is cast by
    skip: why the cell is skipped there; None where it is not
    failure: why it fails there before it runs: its method cannot be loaded, or goes wrong when it is asked; None: not
    claims: those that its method states there; None where that revision does not say
    identity: what that revision says of the cell's identity (harness.experiment.identity)
    """

    programs: Programs
    skip: str | None
    failure: str | None
    method: str
    claims: tuple[str, ...] | None
    identity: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Formers:
    """Hold the cells of a config at another revision by their slots, and what could not be read there, by its name."""

    cells: Mapping[str, Former]
    left_out: Mapping[str, str]

    def failure(self, slot: str, method: str) -> str | None:
        """Say why a method's cell fails there before it runs; None where it does not.

        A method that cannot be loaded there does not say what it casts. So its cells may have other slots there.
        """
        if slot in self.cells:
            return self.cells[slot].failure
        return next((cell.failure for cell in self.cells.values() if cell.method == method and cell.failure), None)


@dataclass(frozen=True)
class Revision:
    """State a git revision that is there: its name as it was given, its commit, and its repository.

    plugins: the folder of further methods, in this repository; None for the project itself
    """

    name: str
    commit: str
    repository: Path
    plugins: Path | None

    @property
    def holds_harness(self) -> bool:
        """Tell whether the revision is one of this project, whose harness then plans the config."""
        return self.repository == ROOT.resolve()


def found(name: str, plugins: Path | None) -> Revision:
    """Find a revision of the repository that holds the folder `plugins` or, without plugins, of this project.

    This is done at once, before anything is run. The revision need not have the folder: its methods are new then.
    Raises FirsthitError where there is no git, no repository or no such revision.
    """
    if not name:
        raise FirsthitError("--against: the name of the revision is empty")
    folder = (plugins or ROOT).resolve()
    if not folder.is_dir():
        raise FirsthitError(f"--plugins: there is no folder {plugins}")
    top, reason = _git(folder, "rev-parse", "--show-toplevel")
    if top is None:
        raise FirsthitError(f"--against: {folder} is in no git repository that can be read ({reason})")
    revision = Revision(name, "", Path(top).resolve(), folder if plugins else None)
    if plugins is None and not revision.holds_harness:
        raise FirsthitError(
            f"--against: {ROOT} is an installation and no clone of firsthit; give --plugins DIR before gate"
        )
    commit, _ = _git(folder, "rev-parse", "--verify", "--quiet", "--end-of-options", f"{name}^{{commit}}")
    if not commit or set(commit) - set("0123456789abcdef"):
        kind, _ = _git(folder, "cat-file", "-t", name)
        if kind in ("tree", "blob"):
            raise FirsthitError(f"--against: {name!r} is a {kind} of {revision.repository}, and no commit")
        shallow, _ = _git(folder, "rev-parse", "--is-shallow-repository")
        hint = (
            "the clone is shallow: `git fetch --unshallow`, or fetch-depth: 0 of actions/checkout, gets older ones"
            if shallow == "true"
            else "`git fetch` gets what others pushed, and `git branch -a` lists branches"
        )
        raise FirsthitError(f"--against: {revision.repository} has no revision {name!r}; {hint}")
    return Revision(name, commit, revision.repository, revision.plugins)


def programs_at(
    revision: Revision, config: Path, devices: list[str], own: Mapping[str, Sequence[str]] | None = None
) -> Formers:
    """Return each cell of a config at a git revision. The config is read as it stands now.

    Its cells are on `devices`, and those of variants in `own` on the devices there; `fastest` is no name of one.

    Where plugins are in a repository of their own, the harness that plans them is the present one. Raises
    FirsthitError, with exit code 3, where the revision cannot be checked out, or its code cannot plan the config.
    """
    with temporary_folder("firsthit-against") as place:
        tree = _checked_out(revision, place)
        there = tree / revision.plugins.relative_to(revision.repository) if revision.plugins else None
        _held(revision, tree)
        code, arrays = tree if revision.holds_harness else ROOT, place / "arrays"
        arrays.mkdir()
        arguments = [
            str(config.resolve()),
            str(there or ""),
            str(arrays),
            json.dumps({"devices": devices, "own": own or {}}),
        ]
        command = [sys.executable, "-c", EXPORT.read_text(encoding="utf-8"), *arguments]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(code), *_own(revision, tree)])}
        options: dict[str, Any] = {"cwd": code, "env": environment, "capture_output": True, "text": True}
        try:
            ran = subprocess.run(command, check=False, timeout=PLAN_SECONDS, errors="backslashreplace", **options)
        except subprocess.TimeoutExpired:
            reason = f"it took longer than {PLAN_SECONDS:g} s, as a method.py does that never ends"
            message = f"--against {revision.name}: its code cannot plan {config}: {reason}"
            raise FirsthitError(message, exit_code=3) from None
        written = arrays / "cells.json"
        if ran.returncode or not written.is_file():
            reason = (ran.stderr.strip().splitlines() or ["no reason given"])[-1].replace(f"{tree}/", "")
            raise FirsthitError(f"--against {revision.name}: its code cannot plan {config}: {reason}", exit_code=3)
        told = json.loads(written.read_text(encoding="utf-8").replace(json.dumps(f"{tree}/")[1:-1], ""))
        return Formers({slot: _former(cell) for slot, cell in told["cells"].items()}, told["left_out"])


def _own(revision: Revision, tree: Path) -> list[str]:
    """List the folders of the other revision from which Python now imports the repository's own modules, if it has any.

    A method may import modules beside its folder; an installation that can be edited offers the present ones.
    """
    inside = (Path(entry).resolve() for entry in sys.path if entry)
    moved = (
        tree / path.relative_to(revision.repository) for path in inside if path.is_relative_to(revision.repository)
    )
    return [str(path) for path in dict.fromkeys(moved) if path.is_dir()]


def _checked_out(revision: Revision, folder: Path) -> Path:
    """Check `revision` out into a new folder below the temporary one `folder`, and return it.

    Nothing is written into the repository, and no hook of it runs. Raises FirsthitError where it cannot be checked out.
    """
    tree = folder.resolve() / "tree"
    tree.mkdir()
    own = {"GIT_INDEX_FILE": str(folder.resolve() / "index"), "GIT_WORK_TREE": str(tree)}
    for arguments in (("read-tree", revision.commit), ("checkout-index", "--all", "--quiet")):
        told, reason = _git(revision.repository, *ALONE, *arguments, own=own)
        if told is None:
            message = f"--against: git cannot check {revision.name} out into {tree}: {reason}"
            raise FirsthitError(message, exit_code=3)
    return tree


def _held(revision: Revision, tree: Path) -> None:
    """Raise FirsthitError where a folder that is a method's now is not held by the revision, which lies in `tree`.

    A link out of it leads to what is there now, which would pass for the other revision's. A submodule is empty.
    """
    now = revision.plugins or revision.repository / "methods"
    there = tree / now.relative_to(revision.repository)
    told = {path: f"a link to {path.readlink()}, out of the revision" for path in _leading_out(there, tree)}
    listed, _ = _git(revision.repository, "ls-tree", "-r", "-z", revision.commit, "--", f"{there.relative_to(tree)}")
    for entry in filter(None, (listed or "").split("\0")):
        facts, name = entry.split("\t", 1)
        if facts.startswith(SUBMODULE):
            told[tree / name] = "a submodule; give --plugins a folder in it"
    for path, what in told.items():
        if any(folder.joinpath("method.py").is_file() for folder in (now, now / path.relative_to(there).parts[0])):
            raise FirsthitError(f"--against: {path.relative_to(tree)} at {revision.name} is {what}", exit_code=3)


def _leading_out(there: Path, tree: Path) -> list[Path]:
    """List the links in a folder of methods that lead out of `tree`."""
    links = sorted(path for pattern in ("*", "*/*") for path in there.glob(pattern) if path.is_symlink())
    return [path for path in links if not (path.exists() and path.resolve().is_relative_to(tree))]


def _git(folder: Path, *arguments: str, own: Mapping[str, str] = git.NOTHING) -> tuple[str | None, str]:
    """Run git in a folder. Return what it printed, or None and the reason where it fails or is not here."""
    try:
        ran = git.ran(folder, *arguments, own=own)
    except OSError as error:
        return None, f"git: {error.strerror}"
    if ran.returncode:
        return None, " ".join(ran.stderr.split()) or f"git ended with {ran.returncode}"
    return ran.stdout.strip("\n"), ""


def _former(cell: dict[str, Any]) -> Former:
    """Read what harness/gate/export.py wrote of a cell."""
    timed, second = (_program(cell[name]) if cell[name] else None for name in ("timed", "second"))
    checks = tuple(map(_program, cell["checks"])) or (
        (timed,) if timed else ()
    )  # beams once had no program of their own
    others = tuple(map(_program, cell["others"]))
    batches = tuple(_batch(check, file) for check, file in zip(checks, cell["batches"], strict=False))
    tables = {name: np.load(file, allow_pickle=False) for name, file in cell["tables"].items()}
    programs = Programs(checks, timed, others, cell["parameters"], batches, second, tables)
    claims = None if cell["claims"] is None else tuple(cell["claims"])
    return Former(programs, cell["skip"], cell["failure"], cell["method"] or "", claims, cell["identity"])


def _program(stored: dict[str, Any]) -> Program:
    """Read a program that harness/gate/export.py wrote."""
    sections, vertex = (tuple(Section(*section) for section in stored[name]) for name in ("sections", "vertex"))
    return Program(stored["language"], stored["precision"], stored["entry"], sections, vertex)


def _batch(check: Program, file: str) -> Batch:
    """Read what harness/gate/export.py wrote of a draw call, whose reporting program is `check`."""
    with np.load(file, allow_pickle=False) as arrays:
        vertices = arrays.get("vertices")
        return Batch(check, arrays["instances"], arrays["triangles"], vertices, bool(arrays["closed"]))
