"""List the claims of the papers, each with its verdict."""

from __future__ import annotations

from collections import Counter

from reports import wording
from reports.analysis import count_tests
from reports.claims import Claim, Outcome, Verdict
from reports.claims.verdict_tables import DECIDED, brief
from reports.content import Block, Column, Section, Table, Text
from reports.material import Material

ORDER = 66
LEADS = True
TITLE = "The papers’ claims"
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
    """Make the section: the claims that the run decides, and all of them among the details.

    [] where the run decides no claim.
    """
    judged = material.judged
    decided = [(claim, verdict) for claim, verdict in judged if verdict.outcome in DECIDED]
    if not decided:
        return []
    rest = _rest([verdict for _, verdict in judged if verdict.outcome not in DECIDED])
    blocks: list[Block] = [Text(_counted(decided), strong=True), _decided(decided), *([Text(rest)] if rest else [])]
    return [Section(TITLE, tuple(blocks), (Text(TOLD), _table(judged)), name="Claims")]


def _counted(decided: list[tuple[Claim, Verdict]]) -> str:
    """Say how many claims of each paper are confirmed."""
    papers: dict[str, list[bool]] = {}
    for claim, verdict in decided:
        papers.setdefault(claim.paper, []).append(verdict.outcome is Outcome.CONFIRMED)
    held = sum(map(sum, papers.values()))
    each = wording.listed([f"{sum(of)} of {len(of)} of {paper}" for paper, of in papers.items()])
    told = f"{held} {'is' if held == 1 else 'are'} confirmed"
    return f"Of {wording.plural(len(decided), 'claim')} that this run decides, {told}: {each}."


def _rest(others: list[Verdict]) -> str:
    """Say in a sentence what became of the claims that the run does not decide; "" where there are none."""
    open_ones = sum(verdict.outcome is Outcome.UNDECIDED for verdict in others)
    untold = len(others) - open_ones
    told = [f"{open_ones} stay open (their rows do not tell)"] if open_ones else []
    told += [f"{untold} have no rows in this run"] if untold else []
    return f"Of {wording.plural(len(others), 'more claim')}, {wording.listed(told)}." if others else ""


def _decided(decided: list[tuple[Claim, Verdict]]) -> Table:
    """Make a line or two for each claim that is confirmed or refuted."""
    return Table(
        (
            Column("paper"),
            Column("verdict"),
            Column("section"),
            Column("claim", stretch=5),
            Column("what was measured", stretch=8),
        ),
        [(c.paper, v.outcome.value, c.section, c.text, brief(v.figure)) for c, v in decided],
        "",
        group=1,
    )


def _table(judged: list[tuple[Claim, Verdict]]) -> Table:
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
        "Every claim and its verdict.",
        f"{wording.listed([f'{n} {outcome}' for outcome, n in counted.most_common()])}.",
        group=1,
    )
