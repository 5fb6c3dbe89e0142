"""Reports: a run folder's rows → tables, plots, pictures → one PDF and one HTML
page, with the rows beside them as CSV and Parquet.

Reads the run folder only and never runs anything. The way through: `load` (folder → rows, as `schema` names them) →
`derive` (speed-ups, floors, fronts) and `breaks` (of families of hard rays) → `sections` (what the report says, in
the blocks of `content`: the first page from `summary`, then every module of `parts`) → `document` (content → PDF
through `report.typ`) and `html` (content → `page.html` with its style and script).
"""

from __future__ import annotations

import tempfile
from pathlib import Path

from harness.contract import FirsthitError


def build(run: Path, baseline: str | None = None) -> Path:
    """Write report.pdf, report.html, results.csv and results.parquet into the folder `run`; the path of the PDF.

    A run with families of hard rays also gets stability.csv, one line for each rung. All are made in full before the
    first of them replaces an older one. Speed-ups are over `baseline`, a method or variant of the run, or else over
    the one that the run's config names.
    Raises FirsthitError where `run` is no run folder, holds no finished cell, has no such baseline or cannot be written
    to.
    """
    # Imported here because pandas, matplotlib and typst take seconds, and a machine that only runs has none of them.
    from reports import breaks, derive, document, html, load, sections, store, style

    loaded = load.load(run)
    frame = derive.derive(load.over(loaded.frame, baseline), loaded.plan.peaks)
    rungs = breaks.derive(loaded.families, loaded.rungs)
    content = sections.report(loaded, frame, rungs)
    try:
        with tempfile.TemporaryDirectory(prefix=".report-", dir=run) as name:
            made = Path(name)
            document.write_pdf(content, made / "pdf", made / "report.pdf", loaded.plan.created)
            html.write_html(content, style.marks([*frame["method"], *loaded.families["method"]]), made / "report.html")
            store.write(frame, made / "results.csv", made / "results.parquet")
            files = ["results.csv", "results.parquet", "report.html", "report.pdf"]
            if not rungs.empty:
                rungs.to_csv(made / "stability.csv", index=False)
                files.insert(0, "stability.csv")
            else:
                (run / "stability.csv").unlink(missing_ok=True)  # of an earlier plan
            for file in files:
                (made / file).replace(run / file)
    except OSError as error:
        raise FirsthitError(f"cannot write the report into {run}: {error.strerror or error}", exit_code=3) from error
    return run / "report.pdf"


def compare(a: Path, b: Path) -> Path:
    """Write what changed from run `a` to run `b` into the folder `a`, as against-….pdf and .html; the path of the PDF.

    Raises FirsthitError where either is no run folder, they have nothing in common or `a` cannot be written to.
    """
    from reports import against, document, html, load

    content = against.report(load.load(a), load.load(b))
    stem = against.name_of(a, b)
    try:
        with tempfile.TemporaryDirectory(prefix=".report-", dir=a) as name:
            made = Path(name)
            document.write_pdf(content, made / "pdf", made / f"{stem}.pdf", "")
            html.write_html(content, {}, made / f"{stem}.html")
            for ending in ("html", "pdf"):
                (made / f"{stem}.{ending}").replace(a / f"{stem}.{ending}")
    except OSError as error:
        raise FirsthitError(f"cannot write the report into {a}: {error.strerror or error}", exit_code=3) from error
    return a / f"{stem}.pdf"
