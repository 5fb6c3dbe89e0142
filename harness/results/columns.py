"""Print docs/columns.md, which lists every leaf of a stored row and every column of a report's tables:

python -m harness.results.columns > docs/columns.md
"""

from __future__ import annotations

from collections.abc import Iterable

from harness.results.schema import BASELINE, DERIVED, LEAVES, RUN, RUNG, Field

TYPES = {  # what a reader is told of a field's kind
    "text": "text",
    "real": "number",
    "whole": "whole number",
    "flag": "true or false",
    "json": "JSON",
    "reals": "list of numbers",
}
_HEAD = """# What a row holds

`firsthit run` stores each cell as `runs/NAME/cells/KEY.json`, and packs many of them into Parquet parts
([rows.md](rows.md)); `firsthit report` writes `results.csv`, with a line for
each cell that is a view, `results.parquet`, with the same columns, and, of families of hard rays, `stability.csv`, with
a line for each rung.

Lengths are in scene units, the surface's own coordinates, unless a line says otherwise. A clear ray is one that is
neither grazing nor drowned; see [When a row counts](rows.md). A leaf that is null, or absent because it has no meaning
for the cell, is an empty field of CSV and a null of Parquet. In CSV lists and objects are JSON, and a text that begins
with `=`, `+`, `-` or `@`, which a spreadsheet would take for a formula, has a `'` before it; Parquet has the texts as
they are.

This page is printed from `harness/results/row.py` and `harness/results/schema.py` by
`python -m harness.results.columns > docs/columns.md`.
"""


def page() -> str:
    """Return the page, in Markdown."""
    return "\n".join(
        [
            _HEAD,
            "## Leaves of `cells/KEY.json`, and their columns",
            "",
            "`[]` in a leaf's name stands for every item of a list.",
            "",
            "| leaf | column | type | meaning |",
            "| --- | --- | --- | --- |",
            *(f"| `{_place(leaf)}` | {_name(leaf)} | {TYPES[leaf.kind]} | {_meaning(leaf)} |" for leaf in LEAVES),
            "",
            "## Columns that a report adds",
            "",
            "The first two are the plan's, in `runs/NAME/plan.json`. All others follow from the rows that are compared "
            "with each other.",
            "",
            *_table((RUN, BASELINE, *DERIVED)),
            "",
            "## Columns of `stability.csv`",
            "",
            "Beside those of its cell that name it, and `share_right`, which is `right` over `decided`:",
            "",
            *_table(RUNG[1:]),
            "",
        ]
    )


def _table(fields: Iterable[Field]) -> list[str]:
    lines = (f"| {_name(field)} | {TYPES[field.kind]} | {_meaning(field)} |" for field in fields)
    return ["| column | type | meaning |", "| --- | --- | --- |", *lines]


def _place(leaf: Field) -> str:
    return ".".join(leaf.path).replace(".[]", "[]")


def _name(field: Field) -> str:
    return f"`{field.name}`" if field.name else "—"


def _meaning(field: Field) -> str:
    return field.meaning.replace("|", "\\|")


if __name__ == "__main__":
    print(page(), end="")
