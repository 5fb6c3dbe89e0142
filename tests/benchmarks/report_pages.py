"""Count the pages of a report by section: `python -m tests.benchmarks.report_pages RUN`.

It prints where each section begins and how many pages it takes, the seconds that the report took, and the bytes of the
PDF and the HTML page: what a report's budget of pages is held against. Nothing is asserted.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from pathlib import Path

import typst

from reports import report
from reports.analysis import breaks, derive
from reports.reading import load
from reports.rendering import document

PLACES = """#include "report.typ"
#context [#metadata((
  query(<section>).map(found => (found.body.text, found.location().page(), found.location().position().y / 1mm)),
  counter(page).final().first(),
)) <places>]
"""
HEIGHT = 297.0  # mm of a page


def measure(run: Path) -> None:
    """Print the pages of the report on a run by section."""
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        loaded = load.load(run)
        frame = derive.derive(loaded.frame, loaded.plan.peaks)
        made = report.report(loaded, frame, breaks.derive(loaded.families, loaded.rungs))
        document.write_pdf(made, folder / "pdf", folder / "report.pdf", loaded.plan.created)
        seconds, size = time.monotonic() - began, (folder / "report.pdf").stat().st_size
        (folder / "pdf" / "places.typ").write_text(PLACES)
        settings = document._settings(folder / "pdf")
        (told,) = json.loads(typst.query(folder / "pdf" / "places.typ", "<places>", **settings))
    sections, pages = told["value"]
    starts = [page - 1 + y / HEIGHT for _, page, y in sections]
    for (title, page, _), start, end in zip(sections, starts, [*starts[1:], float(pages)], strict=True):
        print(f"page {page:3d}  {end - start:5.1f} pages  {title}")
    print(f"{pages} pages, {size / 1e6:.1f} MB, {seconds:.1f} s without the HTML page")


if __name__ == "__main__":
    measure(Path(sys.argv[1]))
