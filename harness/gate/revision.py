"""Get another git revision's programs of a config, which that revision's own code makes in a temporary worktree."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness import ROOT
from harness.contract import FirsthitError, Program, Section

EXPORT = Path(__file__).with_name("export.py")


@dataclass(frozen=True)
class Former:
    """Hold one cell's programs at the other revision.

    check, timed: the programs that are checked and timed; None where there is none
    skip: why the cell is skipped there; None where it is not
    """

    check: Program | None
    timed: Program | None
    skip: str | None


def programs_at(revision: str, config: Path, plugins: Path | None, devices: list[str]) -> dict[str, Former]:
    """Return each cell's programs at a git revision, by its slot.

    The revision is one of the repository that holds the folder `plugins` or, without plugins, of this project. Where
    plugins are in a repository of their own, the harness that plans them is the present one. Raises FirsthitError where
    there is no such revision, and with exit code 3 where its code cannot plan the config.
    """
    top = _git(plugins or ROOT, "rev-parse", "--show-toplevel")
    if top is None:
        raise FirsthitError(f"--against: {plugins or ROOT} is in no git repository, so there is no revision to be had")
    repository = Path(top)
    with _worktree(repository, revision) as tree:
        ours = repository == ROOT.resolve()
        there = tree / plugins.resolve().relative_to(repository) if plugins else None
        code = tree if ours else ROOT
        arguments = [str(config.resolve()), str(there or ""), *devices]
        command = [sys.executable, "-c", EXPORT.read_text(encoding="utf-8"), *arguments]
        environment = {**os.environ, "PYTHONPATH": str(code)}
        ran = subprocess.run(command, cwd=code, env=environment, capture_output=True, text=True, check=False)
    if ran.returncode:
        reason = (ran.stderr.strip().splitlines() or ["no reason given"])[-1]
        raise FirsthitError(f"--against {revision}: its code cannot plan {config}: {reason}", exit_code=3)
    return {slot: _former(cell) for slot, cell in json.loads(ran.stdout.splitlines()[-1]).items()}


@contextlib.contextmanager
def _worktree(repository: Path, revision: str) -> Iterator[Path]:
    """Check `revision` out into a temporary folder, and remove it again when the block ends.

    Raises FirsthitError where there is no such revision or it cannot be checked out.
    """
    commit = _git(repository, "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
    if commit is None:
        raise FirsthitError(f"--against: {repository} has no revision {revision!r}; a shallow clone lacks older ones")
    with tempfile.TemporaryDirectory(prefix="firsthit-against-") as folder:
        tree = Path(folder).resolve() / "tree"
        if _git(repository, "worktree", "add", "--detach", "--quiet", str(tree), commit) is None:
            raise FirsthitError(f"--against: git cannot check {revision} out into {tree}", exit_code=3)
        try:
            yield tree
        finally:
            _git(repository, "worktree", "remove", "--force", str(tree))


def _git(folder: Path, *arguments: str) -> str | None:
    """Run git in a folder and return what it printed; None where it fails or is not here."""
    try:
        ran = subprocess.run(["git", "-C", str(folder), *arguments], capture_output=True, text=True, check=False)
    except OSError:
        return None
    return ran.stdout.strip() if ran.returncode == 0 else None


def _former(cell: dict[str, Any]) -> Former:
    """Read what harness/gate/export.py wrote of a cell."""
    check, timed = (_program(cell[name]) if cell[name] else None for name in ("check", "timed"))
    return Former(check, timed, cell["skip"])


def _program(stored: dict[str, Any]) -> Program:
    """Read a program that harness/gate/export.py wrote."""
    sections = tuple(Section(origin, text) for origin, text in stored["sections"])
    return Program(stored["language"], stored["precision"], stored["entry"], sections)
