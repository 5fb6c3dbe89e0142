"""Make the table of verdicts that ends a paper's section."""

from __future__ import annotations

from collections.abc import Iterable

from reports.claims.model import Claim, Verdict
from reports.content import Column, Table

CAPTION = (
    "A verdict is over all rows that its claim asks for: every device, size and view of the run, where a table above "
    "may be of one of them alone."
)


def verdict_tables(judged: Iterable[tuple[Claim, Verdict]], config: str, of_what: str) -> list[Table]:
    """Make the table of the claims that the rows of `config` decide; [] where they decide none."""
    body = [(v.outcome.value, c.section, c.text, v.figure) for c, v in judged if c.config == config]
    columns = (Column("verdict"), Column("section"), Column("claim", stretch=4), Column("what was measured", stretch=5))
    return [Table(columns, body, f"{of_what}: verdicts.", CAPTION)] if body else []
