"""State the commands that campaigns disturb, and make what each of them leaves where nobody does."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.campaigns import processes
from tests.campaigns.processes import done


@dataclass(frozen=True)
class Stated:
    """State a command.

    arguments: its command line
    needs: what it reads beside configs, by path, with the command that makes it; "" for what `prepare` makes
    weight: how often it is killed
    again: what completes it, added to its arguments, where a worker that was killed cost a row
    """

    arguments: tuple[str, ...]
    needs: Mapping[str, str]
    weight: int
    again: tuple[str, ...] = ()


GATE = ("gated.toml", "--baseline", "base.toml")
WRITTEN = ("--junit", "gate.xml", "--markdown", "gate.md", "--keep", "--history", "kept")
RECOMMEND = ("--error", "0.01", "--size", "8", "--views", "1", "--rays", "4", "--seconds", "0.001", "-o", "page.html")
RAYS = ("--surface", "torus", "--rays", "rays.npy", "-o", "truth.npz")
COMMANDS = {
    "run": Stated(("run", "views.toml"), {}, 6, ("--retry", "failed")),
    "run-all": Stated(("run", "whole.toml"), {}, 6, ("--retry", "failed")),
    "bless": Stated(("bless", *GATE, "--reason", "a trial"), {}, 2, ("--force",)),
    "gate": Stated(("gate", *GATE, *WRITTEN), {"base.toml": "bless"}, 2, ("--force",)),
    "report": Stated(("report", "runs/whole", "-o", "out"), {"runs": "run-all"}, 1),
    "publish": Stated(("publish", "runs/views", "runs/hard", "-o", "site"), {"runs": "run-all"}, 1),
    "history": Stated(("history", "gated.toml", "--history", "kept", "-o", "drawn"), {"kept": "gate"}, 1),
    "oracle": Stated(("oracle", *RAYS), {"rays.npy": ""}, 1),
    "recommend": Stated(("recommend", "--surface", "sphere", "--require", "conservative_bound", *RECOMMEND), {}, 1),
}
STORE_ROWS = ("run", "run-all", "bless", "gate", "recommend")
CONFIGS = ("views.toml", "hard.toml", "whole.toml", "gated.toml")


def ready_of(shared: Path, name: str) -> tuple[Path, dict[str, float]]:
    """Return a folder in which a command was run undisturbed, with the seconds it took and its changes of files.

    It is made by the first trial that needs it, and those of the commands whose files the command reads before it.
    """
    folder, command = shared / name, COMMANDS[name]
    if not folder.exists():
        making = shared / f"making-{name}-{os.getpid()}"
        shutil.rmtree(making, ignore_errors=True)
        ready = making / "work"
        ready.mkdir(parents=True)
        fill(shared, command, ready)
        start, count = time.monotonic(), making / "count"
        done(ready, *command.arguments, seam={"at": 10**9, "count": str(count)})
        measured = {"seconds": time.monotonic() - start, "events": int(count.read_text())}
        (making / "measured.json").write_text(json.dumps(measured))
        with contextlib.suppress(OSError):  # another process was faster
            making.rename(folder)
    return folder / "work", json.loads((folder / "measured.json").read_text())


def fill(shared: Path, command: Stated, work: Path) -> None:
    """Put the configs, and what else a command reads, into an empty folder."""
    for name in CONFIGS:
        shutil.copy2(shared / name, work / name)
    for needed, maker in command.needs.items():
        source = (ready_of(shared, maker)[0] if maker else shared) / needed
        (shutil.copytree if source.is_dir() else shutil.copy2)(source, work / needed)


def prepare(shared: Path) -> None:
    """Write configs and rays into the shared folder."""
    processes.write_configs(shared)
    rays = np.zeros((4000, 6))
    rays[:, 3:] = np.random.default_rng(1).normal(size=(4000, 3))
    rays[:, 3:] /= np.linalg.norm(rays[:, 3:], axis=1, keepdims=True)
    rays[:, :3] = -3.0 * rays[:, 3:]
    np.save(shared / "rays.npy", rays.astype(np.float32))
