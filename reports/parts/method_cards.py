"""Make a card for each method: what it is, what it claims, and whether its claims held."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

import matplotlib
import pandas as pd
from matplotlib.figure import Figure as Drawing

from harness.contract import CLAIMS
from harness.results.figures import BROKEN_BY
from reports import wording
from reports.claims import Claim, Outcome, Verdict
from reports.claims.model import where
from reports.content import Block, Column, Figure, Section, Table
from reports.drawing import style
from reports.drawing.canvas import NARROW, RC, Key, line_of, svg
from reports.labels import method_label
from reports.material import Material

ORDER = 70
TEXT_LIMIT = 1500  # characters of a paragraph or point
LONG_CELL = 24  # characters of a table's cell that may be broken


def sections(material: Material) -> list[Section]:
    """Make the section, which is all details; [] where the run, made by an older version, stores no cards."""
    told = material.run.plan.methods
    if not told:
        return []
    blocks: list[Block] = [_key(told)]
    for name in sorted(told):
        blocks += _card(name, told[name], material.frame[material.frame["method"] == name], material.judged)
    return [Section("Methods", (), tuple(blocks))]


def _card(name: str, told: Mapping[str, Any], rows: pd.DataFrame, judged: list[tuple[Claim, Verdict]]) -> list[Block]:
    """Make the card of one method: `told` is what its plan stores of it, `rows` are its rows of this run."""
    knobs = ", ".join(_knob(knob) for knob in told.get("parameters", []))
    tables = told.get("tables", [])
    said = {part: text for part, text in told.get("doc", {}).items() if not _is_caption(part, text, tables)}
    body = [
        *([("what it does", told["summary"])] if told.get("summary") else []),
        ("source", told.get("source")),
        *((part.lower(), _points(text)) for part, text in said.items()),
        ("knobs, with defaults", knobs or "none"),
        ("claims", _claims(name, told.get("claims", []), at_defaults(told, rows))),
    ]
    for claim, verdict in judged:
        if name in claim.methods and verdict.outcome is not Outcome.UNTESTED:
            body.append(
                (
                    f"{claim.paper} {claim.section}",
                    f"{claim.text} {verdict.outcome.value.capitalize()}: {verdict.figure}.",
                )
            )
    known = method_label(name, {name: told})
    title = f"{known}: {told.get('title', '')}"
    own = [_table(known, table, told["doc"].get(table["part"], "")) for table in tables]
    return [Table((Column(""), Column("", stretch=1)), body, title), *own]


def _is_caption(part: str, text: str, tables: list[Mapping[str, Any]]) -> bool:
    """Tell whether a part's text becomes the caption of a table: it is one paragraph, and the part has a table."""
    return "\n" not in text and any(table["part"] == part for table in tables)


def _table(name: str, told: Mapping[str, Any], text: str) -> Table:
    """Make a table of the method's page.

    Its columns of long text share the width by the length of their longest cell.
    """
    cells = list(zip(told["header"], *told["rows"], strict=True))
    longest = [max(map(len, column)) for column in cells]
    columns = tuple(
        Column(column[0], stretch=length if length > LONG_CELL else 0)
        for column, length in zip(cells, longest, strict=True)
    )
    caption = text if _is_caption(told["part"], text, [told]) else ""
    return Table(columns, [tuple(row) for row in told["rows"]], f"{name}: {told['part'].lower()}.", caption)


def _knob(knob: Mapping[str, Any]) -> str:
    """Write a knob: its name, its default and its meaning, and its printed value if that is not the default."""
    printed = "" if knob.get("printed") is None else f"; as printed {knob['printed']:g}"
    return f"{knob['name']} = {knob['default']:g} ({knob['meaning']}{printed})"


def _points(text: str) -> str:
    """Write each paragraph and each point of a text on a line of its own; a point begins with "- "."""
    return "\n".join(wording.excerpt(re.sub("^- ", "• ", line), TEXT_LIMIT) for line in text.split("\n"))


def _key(told: Mapping[str, Mapping[str, Any]]) -> Figure:
    """Draw the mark of each method; `told` is what the plan stores of each."""
    marks = style.marks(sorted(told))
    names = [method_label(name, told) for name in marks]
    key = Key([line_of(mark) for mark in marks.values()], names, NARROW)
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(NARROW, key.height + 0.06))
        key.draw(drawing)
        drawn = svg(drawing)
    caption = "The same on every page; a variant has its method's mark, and a line of its own."
    return Figure("methods-key", drawn, f"Marks of {wording.listed(names)}.", "How each method is drawn.", caption)


def at_defaults(told: Mapping[str, Any], rows: pd.DataFrame) -> pd.DataFrame:
    """Select the rows that a method's claims are about: every knob at its default, rays from the nearest point."""
    rows = rows[rows["origin"].fillna("nearest") == "nearest"]
    defaults = {knob["name"]: knob["default"] for knob in told.get("parameters", [])}
    bound = rows["parameters"].map(lambda text: json.loads(text) if isinstance(text, str) else {})
    return rows[bound.map(lambda knobs: defaults | knobs == defaults).astype(bool)]


_PASSED = {  # the counts that hold later roots, which contradict a claim, among other wrong roots, which do not
    "no_missed_root": [f"{kind}wrong_root" for kind in ("", "grazing_", "drowned_")],
    "conservative_bound": ["wrong_root"],
}


def _claims(method: str, stated: list[str], rows: pd.DataFrame) -> str:
    """Write each claim of a method, and whether this run's counts contradict it.

    An older run may state a claim that is no longer known, which has no meaning beside it.
    """
    if not stated:
        return "none"
    lines = []
    for name in sorted(stated):
        meaning = f": {CLAIMS[name]}" if name in CLAIMS else ""
        lines.append(f"• {name.replace('_', ' ')}{meaning}. {held(method, name, rows)}")
    return "\n".join(lines)


def held(method: str, name: str, rows: pd.DataFrame, among: str = "this run") -> str:
    """Say whether the counts of `rows`, which are those of `among`, contradict one claim."""
    columns = list(BROKEN_BY.get(name, ()))
    known = rows[rows["accuracy_rays"].notna()] if columns else rows.head(0)
    if known.empty or not columns:
        return f"Not counted in {among}; `firsthit conform --method {method}` checks it."
    if known[columns].isna().any(axis=None):
        return "A row here does not count what would break it."
    bad = int(known[columns].sum().sum())
    every = name == "no_missed_root"
    of = int(known["truth_hits" if every else "judged"].sum())
    asked = "rays that meet the surface" if every else "decided rays that are neither grazing nor drowned"
    surfaces = wording.plural(int(known["surface"].nunique()), "surface")
    in_rows = f"{wording.plural(len(known), 'row')} of {among} ({surfaces} {where(known)})"
    told = f"{'Held on' if bad == 0 else f'broken by {bad:,} of'} {of:,} {asked} in {in_rows}"
    passed = known[_PASSED.get(name, [])].sum().sum()
    told += f"; of {wording.plural(int(passed), 'wrong root')} it is not counted which are later ones" if passed else ""
    return f"{told[0].upper()}{told[1:]}."
