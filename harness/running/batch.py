"""Run what a plan names and is not stored yet, for commands that need rows and no run folder that people look at."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from harness.devices.executor import LocalExecutor
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.plugins import Catalog
from harness.results.store import Row, Store
from harness.running.due import due
from harness.running.environment import describe
from harness.running.run import Watcher
from harness.running.runner import Runner


def rows_of(
    planned: list[Planned],
    experiment: Experiment,
    catalog: Catalog,
    folder: Path,
    executor: LocalExecutor,
    watcher: Watcher,
    force: bool = False,
) -> tuple[dict[str, Row], frozenset[str]]:
    """Return each planned cell's row by its key, and the keys of the rows that are of an earlier run.

    A cell is run now where `folder` has no row of it, where its row says that it did not finish and, with `force`, in
    any case; `watcher` is told of each. Raises FirsthitError where a row cannot be stored.
    """
    store = Store(folder)
    found = due(planned, store, "everything" if force else "unfinished")
    if found.todo:
        watcher.starts(len(found.todo), 1.0 * len(found.todo), Counter(p.cell.device for p in found.todo))
    told = watcher.cell, watcher.hears_builds
    rows = Runner(experiment.config, catalog, store, executor, describe(), *told).run(found.todo)
    return {**found.kept, **rows}, frozenset(found.kept)
