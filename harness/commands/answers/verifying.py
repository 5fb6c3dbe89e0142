"""State what `firsthit verify` answers with --json."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from harness.verifying.checks import CHECKS, Verified


@dataclass(frozen=True)
class FailingFacts:
    """Say which value of which row does not hold.

    file: the row's file
    slot: variant, surface, view, size, precision, stage and device; "" where the row cannot be read
    check: the name of the check that says so
    figure: where the value stands in the row, as accuracy.error.max
    stored: what the row says, as text
    found: what follows from the rest of the row, or from the truth, as text
    """

    file: str
    slot: str
    check: str
    figure: str
    stored: str
    found: str


@dataclass(frozen=True)
class SilentFacts:
    """Say of how many rows a check cannot tell, and why.

    reason: why
    rows: of how many
    """

    reason: str
    rows: int


@dataclass(frozen=True)
class CheckFacts:
    """Say what became of one check.

    check: its name
    meaning: what holds where it holds
    rows: how many rows it was made for
    failing: how many of these it does not hold for
    cannot_tell: of how many others it says nothing, by reason
    """

    check: str
    meaning: str
    rows: int
    failing: int
    cannot_tell: Sequence[SilentFacts]


@dataclass(frozen=True)
class Verify:
    """Say which rows were checked again, how, and what does not hold.

    rows: how many rows there are
    failing_rows: how many of them do not hold
    certifiable: how many are of rays whose truth can be asked for, or of a family of hard rays
    certified: of how many of these the truth was certified anew
    seed: what chose these
    missing: cells that a plan names and that have no row
    checks: what was checked
    failing: every value that does not hold
    """

    rows: int
    failing_rows: int
    certifiable: int
    certified: int
    seed: int
    missing: int
    checks: Sequence[CheckFacts]
    failing: Sequence[FailingFacts]


def answer(found: Verified) -> Verify:
    """Return the answer for what was found."""
    checks = [
        CheckFacts(
            name,
            meaning,
            found.checked[name],
            len({one.file for one in found.failing if one.check == name}),
            [SilentFacts(why, count) for (check, why), count in sorted(found.not_checked.items()) if check == name],
        )
        for name, meaning in CHECKS.items()
    ]
    failing = [
        FailingFacts(str(one.file), one.slot, one.check, one.wrong.figure, str(one.wrong.stored), str(one.wrong.found))
        for one in found.failing
    ]
    sampled = found.certifiable, found.sampled, found.seed
    return Verify(found.rows, len({one.file for one in failing}), *sampled, found.missing, checks, failing)
