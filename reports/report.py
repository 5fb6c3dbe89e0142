"""Make the report on one run: a summary, then its parts."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from harness.results.writing import replacing_together
from reports import first_page, parts
from reports.analysis import breaks, derive
from reports.content import Document
from reports.drawing import style
from reports.material import Material
from reports.reading import export, load
from reports.reading.arrays import Shelf
from reports.reading.run import Run
from reports.rendering import document, html


def build(run: Path, baseline: str | None = None) -> Path:
    """Write report.pdf, report.html, results.csv and results.parquet into the folder `run`; return the PDF's path.

    A run with families of hard rays also gets stability.csv, with a line for each rung. No older file is replaced
    before all new ones are complete. Speed-ups are over `baseline`, a method or variant of the run; None takes the one
    that the run's config names.

    Raises FirsthitError if `run` is no run folder, holds no finished cell, has no such baseline or cannot be written
    to.
    """
    loaded = load.load(run)
    frame = derive.derive(load.over(loaded.frame, baseline), loaded.plan.peaks)
    rungs = breaks.derive(loaded.families, loaded.rungs)
    content = report(loaded, frame, rungs)
    with replacing_together(run, "the report") as made:
        document.write_pdf(content, made / "pdf", made / "report.pdf", loaded.plan.created)
        html.write_html(content, style.marks([*frame["method"], *loaded.families["method"]]), made / "report.html")
        export.write(frame, made / "results.csv", made / "results.parquet")
        if not rungs.empty:
            rungs.to_csv(made / "stability.csv", index=False)
    if rungs.empty:
        (run / "stability.csv").unlink(missing_ok=True)  # of an earlier plan
    return run / "report.pdf"


def report(run: Run, frame: pd.DataFrame, rungs: pd.DataFrame) -> Document:
    """Make the whole report.

    `frame` is what analysis.derive.derive returns for the run, `rungs` what analysis.breaks.derive returns.
    """
    material = Material(run, frame, rungs, Shelf(run.folders))
    sections = tuple(parts.sections(material))
    return Document(run.plan.title or run.plan.name, _subtitle(run), first_page.section(material), sections)


def _subtitle(run: Run) -> str:
    """Write the version, the run's name and date, and the commit."""
    environment = run.plan.environment
    dirty = " with uncommitted changes" if environment.get("dirty") else ""
    told = [f"firsthit {environment.get('firsthit', '')}".strip(), f"run “{run.plan.name}”", run.plan.created[:10]]
    if environment.get("commit"):
        told.append(f"commit {environment['commit']}{dirty}")
    return " · ".join(told)
