"""Make kept runs of a few commits, with figures that step where a test wants it, and git repositories to keep by."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from harness.results.commits import Commit, Kept

START = datetime(2026, 3, 1, 12, tzinfo=UTC)
DEVICE = {"name": "opencl:one", "title": "One", "driver": "1.0", "compiler": "c", "processor": "P"}
SLOT = "mine torus front 16x16x1 float32 compute"


def commit(number: int, dirty: bool = False, subject: str = "") -> Commit:
    """Return a commit whose hash and date follow from its number."""
    date = (START + timedelta(days=number)).isoformat()
    return Commit(f"{number + 1:x}".rjust(2, "0").ljust(40, "a"), date, subject or f"change {number}", dirty)


def row(**figures: Any) -> dict[str, Any]:
    """Return a row that finished, with these figures."""
    return {"status": "ok", "scene": "s", "program": "p"} | figures


def kept(
    number: int, rows: Mapping[str, Mapping[str, Any]], dirty: bool = False, device: Mapping[str, Any] = DEVICE
) -> Kept:
    """Return what a device gave at a commit."""
    return Kept("tiny", commit(number, dirty), device, rows, {"version": "1", "commit": "abc"})


def series(*values: Any, figure: str = "misses") -> list[Kept]:
    """Return kept runs of one row, whose figure has these values commit by commit; None stands for no figure."""
    return [kept(i, {SLOT: row(**({} if v is None else {figure: v}))}) for i, v in enumerate(values)]


def git(folder: Path, *arguments: str) -> str:
    """Run git as a user of the tests. Fails where git does."""
    who = ("-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false")
    command = ["git", "-C", str(folder), *who, "-c", "init.defaultBranch=main", *arguments]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def committed(folder: Path, message: str) -> str:
    """Commit all files of a repository, and return the commit's hash."""
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "--allow-empty", "-m", message)
    return git(folder, "rev-parse", "HEAD")
