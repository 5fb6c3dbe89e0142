"""What the report says: a summary, then its parts, in the blocks of `content` that any renderer sets."""

from __future__ import annotations

import pandas as pd

from reports import parts, summary
from reports.arrays import Shelf
from reports.content import Document
from reports.load import Run
from reports.material import Material


def report(run: Run, frame: pd.DataFrame, rungs: pd.DataFrame) -> Document:
    """The whole report on one run; `frame` and `rungs` are the run's own with the derived columns."""
    material = Material(run, frame, rungs, Shelf(run.folders))
    sections = tuple(parts.sections(material))
    return Document(run.plan.title or run.plan.name, _subtitle(run), summary.section(material), sections)


def _subtitle(run: Run) -> str:
    environment = run.plan.environment
    dirty = " with uncommitted changes" if environment.get("dirty") else ""
    told = [f"firsthit {environment.get('firsthit', '')}".strip(), f"run “{run.plan.name}”", run.plan.created[:10]]
    if environment.get("commit"):
        told.append(f"commit {environment['commit']}{dirty}")
    return " · ".join(told)
