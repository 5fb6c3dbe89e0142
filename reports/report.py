"""Make the report on one run: a summary, then its parts."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pandas as pd

from harness.results.writing import flush, replacing_together
from reports import first_page, parts, wording
from reports.analysis import breaks, derive
from reports.content import Document
from reports.drawing import charts
from reports.for_papers import files
from reports.material import Material
from reports.place import checked, place
from reports.reading import export, load
from reports.reading.arrays import Shelf
from reports.reading.columns import UNREAD
from reports.reading.run import Run
from reports.rendering import bundle, document, html


def build(
    run: Path,
    output: Path | None = None,
    *,
    baseline: str | None = None,
    focus: str | None = None,
    appendix: bool = False,
    figures: Sequence[str] = (),
    tables: Sequence[str] = (),
    tell: Callable[[str], None] = lambda _: None,
) -> Path:
    """Write report.pdf, report.html, results.csv and results.parquet into the folder `output`; return the PDF's path.

    Nothing is written into a run; `output` is the folder `place(run)` where none is given. A run with families of hard
    rays also gets stability.csv, with a line for each rung. No older file is replaced before all new ones are complete.
    Speed-ups are over `baseline`, and the report is about `focus`, each a method or variant of the run; None takes the
    one that the run's config names. With `appendix` the PDF ends with the tables that only the HTML page has else.
    `tell` hears what goes on, in a few words.

    With `figures`, forms of for_papers.files.FIGURES, each figure is a file of its own in the folder `figures`, one
    column of a paper wide, and with `tables`, forms of TABLES there, each table in the folder `tables`. Both folders
    have the captions, and example.tex beside them takes all in where there are both.

    Raises FirsthitError if `run` is no run folder, holds no finished cell, has no such baseline or focus, or if
    `output` is a file, lies in a run or cannot be written to.
    """
    folder = checked(place(run) if output is None else output)
    with (
        pd.option_context("mode.string_storage", "python"),  # names of columns are looked up five times as fast
        load.opened(run, UNREAD) as loaded,
    ):
        tell(f"deriving figures of {wording.plural(len(loaded.frame), 'row')}")
        frame = derive.derive(load.over(loaded.frame, baseline), loaded.plan.peaks)
        loaded = replace(loaded, frame=frame)  # what `derive` replaced is not held any more
        _build(loaded, folder, focus, appendix, figures, tables, tell)
    return folder / "report.pdf"


def _build(
    loaded: Run,
    folder: Path,
    focus: str | None,
    appendix: bool,
    figures: Sequence[str],
    tables: Sequence[str],
    tell: Callable[[str], None],
) -> None:
    """Write the files of the report on a run, whose frame has the derived columns, into a folder."""
    frame = loaded.frame
    rungs = breaks.derive(loaded.families, loaded.rungs)
    material = Material(loaded, frame, rungs, Shelf(loaded.folders), load.focus_of(loaded, focus))
    with replacing_together(folder, "the report") as made, ThreadPoolExecutor(1) as beside:
        writing = beside.submit(_write_results, loaded, made)  # mostly Arrow and the disk, beside Python
        content = document_of(material, tell)
        tell("typesetting the PDF")
        document.write_pdf(content, made / "pdf", made / "report.pdf", loaded.plan.created, appendix)
        tell("writing the page")
        html.write_html(content, material.method_marks, made / "report.html", _labels(loaded), bundle.library())
        tell("writing the tables")
        writing.result()
        if not rungs.empty:
            export.without_formulas(rungs).to_csv(made / "stability.csv", index=False)
        if figures or tables:
            _for_papers(material, figures, tables, folder, made)
    if rungs.empty:
        (folder / "stability.csv").unlink(missing_ok=True)  # of an earlier plan


def _write_results(loaded: Run, made: Path) -> None:
    """Write results.csv and results.parquet into the folder `made`, and wait until they are on the disk."""
    files = (made / "results.csv", made / "results.parquet")
    export.write(loaded.frame, *files, rest=loaded.columns)
    for file in files:
        flush(file)


def _for_papers(material: Material, figures: Sequence[str], tables: Sequence[str], folder: Path, made: Path) -> None:
    """Write the figures and tables in these forms into folders of `folder`, and the example into `made`."""
    with contextlib.ExitStack() as complete:  # the files of both folders are replaced when all are written
        plates, tabled = [], []
        if figures:
            own = complete.enter_context(replacing_together(folder / "figures", "the figures"))
            plates = files.write_figures(material, figures, own)
        if tables:
            own = complete.enter_context(replacing_together(folder / "tables", "the tables"))
            tabled = files.write_tables(material, tables, own)
        if "latex" in tables and {"pdf", "png"} & set(figures):
            (made / "example.tex").write_text(files.example(plates, tabled), encoding="utf-8")


def report(run: Run, frame: pd.DataFrame, rungs: pd.DataFrame, focus: str = "") -> Document:
    """Make the whole report, about the method or variant `focus` if that is not empty.

    `frame` is what analysis.derive.derive returns for the run, `rungs` what analysis.breaks.derive returns.
    """
    return document_of(Material(run, frame, rungs, Shelf(run.folders), focus))


def document_of(material: Material, tell: Callable[[str], None] = lambda _: None) -> Document:
    """Make the whole report of what `material` holds; `tell` hears of each part before it is drawn."""
    plan = material.run.plan
    sections = tuple(parts.sections(material, tell))
    title, first = plan.title or plan.name, first_page.section(material)
    return Document(title, _subtitle(material.run), first, sections, charts.explorer(material.listed))


def _labels(run: Run) -> dict[str, str]:
    """Return the written name of each method."""
    named = pd.concat([of[["method", "method_label"]] for of in (run.frame, run.families)])
    return dict(named.drop_duplicates().itertuples(index=False, name=None))


def _subtitle(run: Run) -> str:
    """Write the version, the run's name and date, and the commit."""
    merged = f", merged from {wording.plural(len(run.plan.merged), 'run')}" if run.plan.merged else ""
    told = [
        f"firsthit {run.plan.environment.get('firsthit', '')}".strip(),
        f"run “{run.plan.name}”{run.plan.part}{merged}",
        run.plan.created[:10],
    ]
    if commits := run.plan.commits:
        told.append(f"commit{'s' if len(commits) > 1 else ''} {wording.listed(commits)}")
    return " · ".join(told)
