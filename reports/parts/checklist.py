"""List the claims of the papers, each with its verdict."""

from __future__ import annotations

from collections import Counter

from reports import claims, wording
from reports.analysis import count_tests
from reports.claims import Outcome
from reports.content import Column, Section, Table, Text
from reports.material import Material

ORDER = 60
LEADS = True
TOLD = (
    "Each paper's claims, in our words, judged by the rows of this run: confirmed, refuted, not decided, or not "
    "testable here. A verdict is over all rows that its claim asks for: every device, size and view of the run. Only "
    "times taken in turns are compared, in the rounds that timed both; pairs without such a round are left out and "
    "counted. Times differ where the 95 % interval of their ratio is all on one side of 1. A claim about a graphics "
    "card of 2006 or 2010 may be true there and refuted here. Wrong rays are counted against certified answers. "
    f"{count_tests.RULE}; one certified ray is enough against “none” and for “some”. Not decided: the rows are there, "
    "but a figure is missing, or no test tells."
)


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run decides no claim."""
    if all(verdict.outcome is Outcome.UNTESTED for _, verdict in material.judged):
        return []
    return [Section("The papers' claims", (Text(TOLD), _table(material.judged)))]


def _table(judged: list[tuple[claims.Claim, claims.Verdict]]) -> Table:
    """Make a line for each claim."""
    body = [(c.paper, c.section, c.text, v.outcome.value, v.figure, c.evidence) for c, v in judged]
    counted = Counter(verdict.outcome.value for _, verdict in judged)
    return Table(
        (
            Column("paper"),
            Column("section"),
            Column("claim", stretch=4),
            Column("verdict"),
            Column("what was measured", stretch=5),
            Column("what decides it", stretch=3),
        ),
        body,
        "Claims and verdicts.",
        f"{wording.listed([f'{n} {outcome}' for outcome, n in counted.most_common()])}.",
        group=1,
    )
