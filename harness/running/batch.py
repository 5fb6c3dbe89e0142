"""Runs the cells of a plan that have no row yet, for commands that need rows and not a run folder to look at."""

from __future__ import annotations

from pathlib import Path

from harness import console
from harness.devices.executor import LocalExecutor
from harness.experiment.config import Experiment
from harness.experiment.plan import Planned
from harness.plugins import Catalog
from harness.results.store import Row, Store
from harness.running.due import due
from harness.running.environment import describe
from harness.running.runner import Runner


def rows_of(
    planned: list[Planned],
    experiment: Experiment,
    catalog: Catalog,
    folder: Path,
    executor: LocalExecutor,
    force: bool = False,
) -> dict[str, Row]:
    """Return each planned cell's row by its key.

    Cells run now if `folder` has no row of theirs or one that did not finish; with `force` all of them run.
    """
    store = Store(folder)
    found = due(planned, store, "everything" if force else "unfinished")
    progress = console.Progress(len(found.todo), 1.0 * len(found.todo))
    rows = Runner(experiment.config, catalog, store, executor, describe(), progress).run(found.todo)
    return found.kept | {row["key"]: row for row in rows}
