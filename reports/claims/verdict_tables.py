"""The verdicts that close a reproduction."""

from __future__ import annotations

from reports.content import Column, Table
from reports.material import Material

CAPTION = (
    "A verdict is over all rows that its claim asks for: every device, size and view of the run, where a table above "
    "may be of one of them alone."
)


def of(material: Material, config: str, of_what: str) -> list[Table]:
    """The claims decided by the rows of `config`; none where it decides none."""
    body = [(v.outcome.value, c.section, c.text, v.figure) for c, v in material.judged if c.config == config]
    columns = (Column("verdict"), Column("section"), Column("claim", stretch=4), Column("what was measured", stretch=5))
    return [Table(columns, body, f"{of_what}: verdicts.", CAPTION)] if body else []
