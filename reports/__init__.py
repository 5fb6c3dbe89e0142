"""Reports: a run folder's rows → tables, plots, pictures → one PDF, with the rows beside it as CSV and Parquet.

Reads the run folder only and never runs anything. The way through: `load` (folder → rows, as `schema` names them) →
`derive` (speed-ups, floors, fronts) → `sections` (what the report says, in the blocks of `content`, from `tables`,
`plots` and `images`) → `document` (content → PDF through `report.typ`).
"""

from __future__ import annotations

import tempfile
from pathlib import Path

from harness.contract import FirsthitError


def build(run: Path) -> Path:
    """Write report.pdf, results.csv and results.parquet into the folder `run`; the path of the PDF.

    All three are made in full before the first of them replaces an older one.
    Raises FirsthitError where `run` is no run folder, holds no finished cell or cannot be written to.
    """
    # Imported here because pandas, matplotlib and typst take seconds, and a machine that only runs has none of them.
    from reports import derive, document, load, sections, store

    loaded = load.load(run)
    frame = derive.derive(loaded.frame)
    content = sections.report(loaded, frame)
    try:
        with tempfile.TemporaryDirectory(prefix=".report-", dir=run) as name:
            made = Path(name)
            document.write_pdf(content, made / "pdf", made / "report.pdf", loaded.plan.created)
            store.write_csv(frame, made / "results.csv")
            store.write_parquet(frame, made / "results.parquet")
            for file in ("results.csv", "results.parquet", "report.pdf"):
                (made / file).replace(run / file)
    except OSError as error:
        raise FirsthitError(f"cannot write the report into {run}: {error.strerror or error}", exit_code=3) from error
    return run / "report.pdf"
