"""Runs what a plan names and is not stored yet, for commands that need rows and not a run folder to look at."""

from __future__ import annotations

from pathlib import Path

from harness import console
from harness.devices.executor import LocalExecutor
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.plugins import Catalog
from harness.results.store import Row, Store
from harness.running.environment import describe
from harness.running.runner import UNFINISHED, Runner


def rows_of(
    planned: list[Planned],
    experiment: Experiment,
    catalog: Catalog,
    folder: Path,
    executor: LocalExecutor,
    force: bool = False,
) -> dict[str, Row]:
    """Each planned cell's row by its key; run now where `folder` has none, or one that did not finish."""
    store = Store(folder)
    stored = {p.key: None if force else store.read(p.key) for p in planned}
    kept = {key: row for key, row in stored.items() if row and row["status"] not in UNFINISHED}
    todo = [p for p in planned if p.key not in kept]
    progress = console.Progress(len(todo), 1.0 * len(todo))
    rows = Runner(experiment.config, catalog, store, executor, describe(), progress).run(todo)
    return kept | {row["key"]: row for row in rows}
