"""Tell verdicts: in a line or two on the page of claims, as a count in a paper's section, and whole in its details."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from reports import wording
from reports.claims.model import Claim, Outcome, Verdict
from reports.content import Column, Table, Text

CAPTION = (
    "A verdict is over all rows that its claim asks for: every device, size and view of the run, where a table above "
    "may be of one of them alone."
)
DECIDED = (Outcome.CONFIRMED, Outcome.REFUTED)
BRIEF = 170  # characters of a figure that is told in two lines
_PAPERS = "the paper"  # begins the clause of a figure with what the paper says
_AT_BEST = ". Ours at its best"  # begins the clause that model.at_best adds
_BEST = " Ours at its best: "


def verdict_tables(judged: Iterable[tuple[Claim, Verdict]], config: str, of_what: str) -> list[Table]:
    """Make the table of the claims that the rows of `config` decide; [] where they decide none."""
    body = [(v.outcome.value, c.section, c.text, v.figure) for c, v in judged if c.config == config]
    columns = (Column("verdict"), Column("section"), Column("claim", stretch=4), Column("what was measured", stretch=5))
    return [Table(columns, body, f"{of_what}: verdicts.", CAPTION)] if body else []


def introduced(seen: str, judged: Iterable[tuple[Claim, Verdict]], *configs: str) -> Text:
    """Return the text `seen`, with a count of the claims that the rows of `configs` test, if they test any."""
    counts = Counter(verdict.outcome for claim, verdict in judged if claim.config in configs)
    held, failed = (counts[outcome] for outcome in DECIDED)
    if not held + failed:
        return Text(seen)
    told = [f"{n} {outcome}" for n, outcome in ((held, "confirmed"), (failed, "refuted")) if n]
    told += [f"{counts[Outcome.UNDECIDED]} left open"] if counts[Outcome.UNDECIDED] else []
    return Text(f"{seen} Claims that these rows test: {wording.listed(told)}; see “The papers’ claims”.")


def brief(figure: str) -> str:
    """Shorten a verdict's figure to about BRIEF characters.

    It keeps the first clause, the one with the paper's figures, how ours at its best is judged, and of the others those
    that there is room for.
    """
    told, at_best, best = figure.partition(_AT_BEST)
    outcome = next((o.value for o in Outcome if best.rstrip(" )").endswith(f"({o.value}")), "") if at_best else ""
    first, *others = told.split("; ")
    kept = [wording.excerpt(first, BRIEF)]
    for clause in sorted(others, key=lambda clause: not clause.startswith(_PAPERS)):
        if len("; ".join([*kept, clause])) <= BRIEF:
            kept.append(clause)
    return f"{'; '.join(kept)}." + (f"{_BEST}{outcome}." if outcome else "")
