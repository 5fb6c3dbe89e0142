"""Each claim of the papers, with its verdict."""

from __future__ import annotations

from collections import Counter

from reports import claims, counts, wording
from reports.claims import Outcome
from reports.content import Column, Section, Table, Text
from reports.material import Material

ORDER = 60
LEADS = True
TOLD = (
    "Each paper's claims, in our words, judged by the rows of this run: confirmed, refuted, not decided, or not "
    "testable here. Only times taken in turns are compared, on this device; a claim about a graphics card of 2006 or "
    "2010 may be true there and refuted here. Wrong rays are counted against certified answers. Times differ where the "
    f"95 % intervals of their medians do not meet. {counts.RULE}; one certified ray is enough against “none” and for "
    "“some”. Not decided: the rows are there, but a figure is missing, or no test tells."
)


def sections(material: Material) -> list[Section]:
    """None where the run decides no claim at all."""
    if all(verdict.outcome is Outcome.UNTESTED for _, verdict in material.judged):
        return []
    return [Section("The papers' claims", (Text(TOLD), table(material.judged)), wide=True)]


def table(judged: list[tuple[claims.Claim, claims.Verdict]], title: str = "Claims and verdicts.") -> Table:
    """One line for each claim."""
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
        title,
        f"{wording.listed([f'{n} {outcome}' for outcome, n in counted.most_common()])}.",
        group=1,
    )
