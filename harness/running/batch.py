"""Run what a plan names and is not stored yet, for commands that need rows and no run folder that people look at."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from harness.devices.executor import LocalExecutor
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.plugins import Catalog
from harness.results.lock import Lock
from harness.results.store import Row, Store
from harness.results.writing import sweep_below
from harness.running.due import Again, begin, due
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
    lock: Lock,
    force: bool = False,
) -> tuple[dict[str, Row], frozenset[str]]:
    """Return each planned cell's row by its key, and the keys of the rows that are of an earlier run.

    A cell is run now where `folder` has no row of it, where its row says that it did not finish and, with `force`, in
    any case; `watcher` is told of each. The folder's `lock` is taken if any is to run. Raises FirsthitError where it
    is another's, or a row cannot be stored.
    """
    store = Store(folder)
    sweep_below(folder)
    again: Again = "everything" if force else "unfinished"
    found, begun = due(planned, store, again), None
    if found.todo:
        lock.take()
        found, begun, _ = begin(planned, store, again)  # anew: another process may have stored rows until now
        for message in store.unreadable.values():
            watcher.warned(f"{message}; running that cell again")
        watcher.starts(len(found.todo), 1.0 * len(found.todo), Counter(p.cell.device for p in found.todo))
    told = watcher.cell, watcher.hears_builds
    rows = Runner(experiment.config, catalog, store, executor, describe(), *told).run(found.todo, begun)
    return {**found.kept, **rows}, frozenset(found.kept)
