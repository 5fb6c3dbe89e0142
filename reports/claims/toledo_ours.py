"""Verdicts on toledo2007's methods as printed, with the same figure of ours at its best beside it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from reports.claims.evidence import Evidence
from reports.claims.model import Verdict

Judge = Callable[[Evidence], Verdict | None]


def beside(printed: Judge, ours: Judge, whose: str) -> Judge:
    """Make a judge by `printed` alone, whose figure ends with that of `ours` where there is one.

    `whose` names the change.
    """

    def decide(evidence: Evidence) -> Verdict | None:
        found, other = printed(evidence), ours(evidence)
        if found is None or other is None:
            return found
        return replace(found, figure=f"{found.figure}. Ours at its best, {whose}: {other.figure} ({other.outcome})")

    return decide
