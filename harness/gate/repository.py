"""Say which commit a run is of: of the repository that holds the plugins, else the config, else this project."""

from __future__ import annotations

import subprocess
from collections.abc import Collection
from datetime import UTC, datetime
from pathlib import Path

from harness import ROOT
from harness.contract import FirsthitError
from harness.escaping import joined, shown
from harness.results import git
from harness.results.commits import Commit

SUBJECT = 500  # letters of a commit's subject that are kept


def holding(plugins: Path | None, config: Path) -> Path | None:
    """Return the top folder of the git repository that holds `plugins`, else `config`, else this project; else None.

    What a repository ignores is not held by it: a virtual environment in somebody's tree is no part of it. Raises
    FirsthitError where there is a repository that git will not read, as where it belongs to somebody else.
    """
    for path in (plugins, config, ROOT):
        if path is None:
            continue
        held = path.resolve()
        top = _top(held if held.is_dir() else held.parent)
        if top is not None and _git(top, "check-ignore", "--quiet", str(held)) is None:
            return top
    return None


def commit_of(top: Path, plugins: Path | None, config: Path, written: Collection[Path] = ()) -> Commit:
    """Return the commit that the tree of the repository at `top` is at.

    The tree is dirty where a file that git knows was changed, or where the config, or a file in the folder of a method
    of `plugins` (without plugins, of this project), is not known to git. What lies in `written` does not count: it is
    what commands write, and decides nothing. Raises FirsthitError where there is no commit yet.
    """
    told = _git(top, "log", "-1", "--format=%H%n%ct%n%s")
    if told is None:
        raise FirsthitError(f"{top} has no commit yet to keep rows by; commit first")
    name, seconds, subject = (*told.split("\n", 2), "")[:3]
    date = datetime.fromtimestamp(int(seconds), UTC).isoformat()
    subject = shown(joined(subject))[:SUBJECT]  # which may hold anything, in any encoding
    return Commit(name, date, subject, bool(changed(top, plugins, config, written)))


def changed(top: Path, plugins: Path | None, config: Path, written: Collection[Path] = ()) -> list[str]:
    """List the files that make the tree at `top` dirty, as `commit_of` says, by their paths below `top`."""
    outside = [f":(exclude){inner}" for path in written if (inner := _below(path, top)) not in (None, ".")]
    folder = plugins or ROOT / "methods"
    methods = [path.parent for pattern in ("method.py", "*/method.py") for path in sorted(folder.glob(pattern))]
    own = [inner for path in (config, *methods) if (inner := _below(path, top))]
    listed = _git(top, "diff", "--name-only", "-z", "HEAD", "--", ".", *outside) or ""
    if own:
        listed += "\0" + (_git(top, "ls-files", "--others", "--exclude-standard", "-z", "--", *own, *outside) or "")
    return [name for name in listed.split("\0") if name]


def line(top: Path, hashes: Collection[str]) -> list[str] | None:
    """Return those of the commits `hashes` that are HEAD or its first parents, the oldest first.

    None where the repository at `top` cannot tell: it is shallow, or none of them is on that line.
    """
    if _git(top, "rev-parse", "--is-shallow-repository") != "false":
        return None
    wanted = set(hashes)
    told = _git(top, "rev-list", "--first-parent", "--reverse", "HEAD") or ""
    return [name for name in told.split() if name in wanted] or None


def _below(path: Path, top: Path) -> str | None:
    """Return where a path lies below a repository's top; None where it is outside."""
    full = path.resolve()
    return full.relative_to(top).as_posix() if full.is_relative_to(top) else None


def _top(folder: Path) -> Path | None:
    """Return the top of the repository that a folder is in; None in none. Raises FirsthitError as `holding` does."""
    ran = _run(folder, "rev-parse", "--show-toplevel")
    if ran is None or (ran.returncode and "not a git repository" in ran.stderr):
        return None
    if ran.returncode:
        raise FirsthitError(f"git in {folder}: {ran.stderr.strip().splitlines()[0]}")
    return Path(ran.stdout.rstrip("\n")).resolve()


def _git(folder: Path, *arguments: str) -> str | None:
    """Run git in a folder and return what it printed; None where it fails or is not here."""
    ran = _run(folder, *arguments)
    return ran.stdout.strip("\n") if ran and ran.returncode == 0 else None


def _run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str] | None:
    """Run git in a folder, in English; None where there is no git or no such folder."""
    try:
        return git.ran(folder, *arguments)
    except OSError:
        return None
