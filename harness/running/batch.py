"""Run what a plan names and is not stored yet, for commands that need rows and no run folder that people look at."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from harness.devices.steps import Executor
from harness.experiment.config import Config
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
    config: Config,
    catalog: Catalog,
    store: Store,
    executor: Executor,
    watcher: Watcher,
    lock: Lock,
    force: bool = False,
    environment: Mapping[str, Any] | None = None,
) -> tuple[dict[str, Row], frozenset[str]]:
    """Return each planned cell's row by its key, and the keys of the rows that are of an earlier run.

    A cell is run now where `store` has no row of it, where its row says that it did not finish and, with `force`, in
    any case; `watcher` is told of each. The folder's `lock` is taken if any is to run. Rows state the `environment`,
    this one's if none is given. Raises FirsthitError where the lock is another's, or a row cannot be stored.
    """
    sweep_below(store.folder)
    again: Again = "everything" if force else "unfinished"
    found, begun = due(planned, store, again), None
    if found.todo:
        lock.take()
        found, begun, _ = begin(planned, store, again)  # anew: another process may have stored rows until now
        for message in store.unreadable.values():
            watcher.wrong(f"{message}; running that cell again")
        watcher.starts(len(found.todo), 1.0 * len(found.todo), Counter(p.cell.device for p in found.todo))
    told = dict(environment or describe()), watcher.cell, watcher.hears_builds
    rows = Runner(config, catalog, store, executor, *told).run(found.todo, begun)
    return {**found.kept, **rows}, frozenset(found.kept)
