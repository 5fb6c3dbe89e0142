"""Make the report on one run: a summary, then its parts."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pandas as pd

from harness.results.writing import replacing_together
from reports import first_page, parts
from reports.analysis import breaks, derive
from reports.content import Document
from reports.drawing import style
from reports.material import Material
from reports.place import place
from reports.reading import export, load
from reports.reading.arrays import Shelf
from reports.reading.run import Run
from reports.rendering import document, html


def build(
    run: Path,
    output: Path | None = None,
    *,
    baseline: str | None = None,
    focus: str | None = None,
    appendix: bool = False,
    tell: Callable[[str], None] = lambda _: None,
) -> Path:
    """Write report.pdf, report.html, results.csv and results.parquet into the folder `output`; return the PDF's path.

    Nothing is written into `run`; `output` is the folder `place(run)` where none is given. A run with families of hard
    rays also gets stability.csv, with a line for each rung. No older file is replaced before all new ones are complete.
    Speed-ups are over `baseline`, and the report is about `focus`, each a method or variant of the run; None takes the
    one that the run's config names. With `appendix` the PDF ends with the tables that only the HTML page has else.
    `tell` hears what goes on, in a few words.

    Raises FirsthitError if `run` is no run folder, holds no finished cell, has no such baseline or focus, or if
    `output` cannot be written to.
    """
    loaded = load.load(run)
    tell(f"deriving figures of {len(loaded.frame):,} rows")
    frame = derive.derive(load.over(loaded.frame, baseline), loaded.plan.peaks)
    rungs = breaks.derive(loaded.families, loaded.rungs)
    content = report(loaded, frame, rungs, load.focus_of(loaded, focus), tell)
    folder = place(run) if output is None else output
    with replacing_together(folder, "the report") as made:
        tell("typesetting the PDF")
        document.write_pdf(content, made / "pdf", made / "report.pdf", loaded.plan.created, appendix)
        tell("writing the page")
        html.write_html(content, style.marks([*frame["method"], *loaded.families["method"]]), made / "report.html")
        tell("writing the tables")
        export.write(frame, made / "results.csv", made / "results.parquet")
        if not rungs.empty:
            rungs.to_csv(made / "stability.csv", index=False)
    if rungs.empty:
        (folder / "stability.csv").unlink(missing_ok=True)  # of an earlier plan
    return folder / "report.pdf"


def report(
    run: Run, frame: pd.DataFrame, rungs: pd.DataFrame, focus: str = "", tell: Callable[[str], None] = lambda _: None
) -> Document:
    """Make the whole report, about the method or variant `focus` if that is not empty.

    `frame` is what analysis.derive.derive returns for the run, `rungs` what analysis.breaks.derive returns. `tell`
    hears of each part before it is drawn.
    """
    material = Material(run, frame, rungs, Shelf(run.folders), focus)
    sections = tuple(parts.sections(material, tell))
    return Document(run.plan.title or run.plan.name, _subtitle(run), first_page.section(material), sections)


def _subtitle(run: Run) -> str:
    """Write the version, the run's name and date, and the commit."""
    environment = run.plan.environment
    dirty = " with uncommitted changes" if environment.get("dirty") else ""
    told = [f"firsthit {environment.get('firsthit', '')}".strip(), f"run “{run.plan.name}”", run.plan.created[:10]]
    if environment.get("commit"):
        told.append(f"commit {environment['commit']}{dirty}")
    return " · ".join(told)
