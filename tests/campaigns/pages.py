"""Put hostile texts into run folders, and write all pages, tables and PDFs of them, as a publisher of them does."""

from __future__ import annotations

import contextlib
import csv
import io
import json
import random
import re
from collections import Counter
from pathlib import Path

from harness import console, terminal
from harness.contract import FirsthitError
from harness.escaping import visible, whole
from reports import report
from reports.analysis import breaks, derive
from reports.for_papers import files
from reports.material import Material
from reports.reading import load
from reports.reading.arrays import Shelf
from reports.rendering import document, html
from reports.site import build
from tests import hostile_texts as hostile
from tests import synthetic_run
from tests.campaigns.frame import Campaign, Fell, Place

OURS = frozenset({"key", "status", "format", "clock", "precision", "stage", "casts", "harder", "include"})
SHARE = 0.2  # of the texts of a folder that are hostile


def _run(folder: Path, dice: random.Random, share: float) -> list[str]:
    """Write a run of a few cells, of whose texts a share is hostile; return these texts."""
    device, other = list(synthetic_run.DEVICES)[:2]
    told: list[str] = []
    variants = list(synthetic_run.VARIANTS)
    cells = [
        synthetic_run.cell(variant, surface, on, "float32") | {"arrays": None}
        for on in (device, other)
        for surface, variant in (("sphere", variants[1]), ("sphere", variants[2]), ("torus", variants[1]))
    ]
    cells[1] |= dict.fromkeys(("time", "build", "accuracy", "operations")) | {"status": "failed", "reason": "a\nlog"}
    cells += [synthetic_run.family_cell(variant, "grazing", device, "float32") for variant in variants[1:3]]
    plan = synthetic_run.plan(cells)
    methods = {name: _card(name) for name in ("newton", "ray_march")}
    plan = hostile.put(plan | {"methods": methods}, dice, share, OURS, told)
    if "studies" in plan:
        del plan["studies"]
    names: dict[str, str] = {}
    for cell in cells:
        for field in ("surface", "view", "device", "variant", "method"):  # names, which rows share
            if cell[field] not in names:
                names[cell[field]] = hostile.put(cell[field], dice, share, OURS, told)
            cell[field] = names[cell[field]]
    (folder / "cells").mkdir(parents=True)
    hostile.write(folder / "plan.json", plan)
    for cell in cells:
        made = hostile.put(cell, dice, share, OURS | {"surface", "view", "device", "variant", "method", "family"}, told)
        hostile.write(folder / "cells" / f"{cell['key']}.json", made)
    return told


def _card(name: str) -> dict[str, object]:
    """Make up what a method says of itself."""
    knobs = [{"name": "EPSILON", "default": 1e-3, "meaning": "where it stops", "finer": "down", "printed": None}]
    page = {"title": name, "text": "What it does.\n- a point\n", "source": "a paper"}
    return {**page, "casts": "rays", "claims": ["no_false_hit"], "parameters": knobs, "needs": ["surface_value"]}


def _report(own: Path, dice: random.Random) -> list[str]:
    """Return the page of the report, and write the tables for papers and sometimes the PDF."""
    loaded = load.load(own / "run")
    frame = derive.derive(loaded.frame, loaded.plan.peaks)
    rungs = breaks.derive(loaded.families, loaded.rungs)
    material = Material(loaded, frame, rungs, Shelf(loaded.folders), "")
    content = report.document_of(material)
    if dice.random() < 0.4:
        document.write_pdf(content, own / "typst", own / "report.pdf", loaded.plan.created, appendix=True)
    (own / "tables").mkdir()
    files.write_tables(material, files.TABLES, own / "tables")
    return [html.page(content, material.method_marks, report._labels(loaded), "0;")]


def _site(own: Path) -> list[str]:
    """Return the pages of a site."""
    build.build([own / "run"], own / "site", "a title", "a@b.c")
    return [path.read_text(encoding="utf-8") for path in sorted((own / "site").rglob("*.html"))]


def _trial(dice: random.Random, place: Place) -> str:
    told = _run(place.own / "run", dice, SHARE)
    sited = dice.random() < 0.4
    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed), terminal.guarded():
            pages = _site(place.own) if sited else _report(place.own, dice)
            for path in (place.own / "run" / "cells").iterdir():
                row = json.loads(path.read_text())
                print(console.table(("slot", "reason"), [(row["slot"], row["reason"])]), row["slot"], row["reason"])
    except FirsthitError:
        return "refused in one line"
    if found := hostile.commands(printed.getvalue()):
        raise Fell(f"printed: {found[0]!r}")
    read = list(map(hostile.Page, pages))
    for page in read:
        hostile.harmless_page(page)
    title = visible(whole(json.loads((place.own / "run" / "plan.json").read_text())["title"]), "\n\t")
    if not any(title in page.said() for page in read):
        raise Fell(f"no page says the title {title!r}")
    _tables(place.own)
    return f"{'site' if sited else 'report'} with {len(told) // 20 * 20} hostile texts or more"


def _tables(folder: Path) -> None:
    """Read the tables that were written. Raises Fell where a cell is a formula, or a line is another one."""
    for path in [*(folder / "tables").glob("*.csv"), *(folder / "site").rglob("*.csv")]:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        if len({len(row) for row in rows}) > 1:
            raise Fell(f"{path.name} has rows of other lengths")
        for cell in (cell for row in rows for cell in row):
            if cell[:1] in ("=", "+", "@", "\t", "\r") or (
                cell[:1] == "-" and not re.fullmatch(r"-[\d.e+-]+|-inf", cell)
            ):
                raise Fell(f"{path.name} has a formula: {cell!r}")
    for path in (folder / "tables").glob("*.md"):
        hostile_kinds = Counter(hostile.read_markdown(re.sub(r"\*\*", "", path.read_text(encoding="utf-8")))[0])
        if set(hostile_kinds) & {"html_block", "fence", "code_block", "link_open"}:
            raise Fell(f"{path.name} has {hostile_kinds}")


CAMPAIGN = Campaign(
    name="pages",
    tries="puts hostile texts into a run folder, and writes its report, tables and site",
    promise="no text that becomes markup or code, no page, table or PDF that cannot be read, and no title that is lost",
    trial=_trial,
    small=1,
    whole=1000,
    block=5,
    limit=300,
)
