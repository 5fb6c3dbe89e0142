"""State what `firsthit gate` and `firsthit history` answer with --json."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from harness.gate.about import About, Place
from harness.gate.against import Compared
from harness.gate.comparable import Rule
from harness.gate.judge import Change, Judged, Verdict

if TYPE_CHECKING:
    from reports.history.series import Step

Value = float | str  # of a gated figure; a text for a status, for "none", and for what machine.plain writes as one


@dataclass(frozen=True)
class ToleranceFacts:
    """Say how much a figure may change: by absolute + relative * |before|, for the worse, and still pass.

    better: lower or higher
    absolute: in the figure's unit, with the slack that the rule adds; "Infinity" where any change passes
    relative: a share of the value before
    """

    better: Literal["lower", "higher"]
    absolute: Value
    relative: float


@dataclass(frozen=True)
class FigureFacts:
    """Say what became of one figure of a row.

    figure: its name, see docs/gating.md; or status
    before: its value in the baseline or at the other revision
    now: its value now; none where the row has it no longer
    allowed: the worst value that passes
    tolerance: from which that follows; null for a status
    verdict: regressed, improved or pass
    """

    figure: str
    before: Value
    now: Value
    allowed: Value
    tolerance: ToleranceFacts | None
    verdict: Verdict


@dataclass(frozen=True)
class RowFacts:
    """Say what became of a row.

    slot: variant, surface, view, size, precision and stage; with --against followed by accuracy or speed
    device: where it ran
    method: its method's name
    verdict: the worst of its figures', or missing, incomparable or new
    rule: by which it is held: exact, or last bits where the devices compute otherwise; null where it is held by none
    reason: why, where the verdict follows from no figure, and why the rule is not exact; null for others
    figures: every gated figure that was compared, those that pass included
    command: gates this row anew
    seconds: what checking it took; null where it was not checked
    earlier: when it was checked, where that was in an earlier run (ISO 8601); null where it was now
    picture: the file that shows its wrong rays; null where there is none
    """

    slot: str
    device: str
    method: str
    verdict: Verdict
    rule: Rule | None
    reason: str | None
    figures: Sequence[FigureFacts]
    command: str
    seconds: float | None
    earlier: str | None
    picture: str | None


@dataclass(frozen=True)
class Gate:
    """Say whether a config's results are worse than its baseline's, or another revision's.

    Exit code 0: nothing got worse; 1: a row regressed or is missing; 3: a row could not be run or compared.

    config: its path
    baseline: the file that rows are held against; null where they are held against a revision alone
    against: the revision that rows are held against; null without one
    counts: how many rows have each verdict, the worst first
    rows: the worst first
    unraced: with --against: why cells whose program changed were not timed, and how many
    broken: methods that cannot be loaded, with the reason; with one of them, nothing got worse is exit code 3 too
    """

    config: str
    baseline: str | None
    against: str | None
    counts: Mapping[str, int]
    rows: Sequence[RowFacts]
    unraced: Mapping[str, int]
    broken: Mapping[str, str]


def gate(
    config: Path,
    baseline: Path | None,
    against: str | None,
    judged: Sequence[Judged],
    about: Mapping[Place, About],
    compared: Compared | None,
    broken: Mapping[str, str],
) -> Gate:
    """Return what is said of a gate; `judged` are in the order in which they are told."""
    counts = Counter(j.verdict for j in judged)
    return Gate(
        config=str(config),
        baseline=None if baseline is None else str(baseline),
        against=against,
        counts={str(verdict): counts[verdict] for verdict in Verdict},
        rows=[_row(j, about[j.slot, j.device]) for j in judged],
        unraced=dict(compared.unraced) if compared else {},
        broken=broken,
    )


def _row(judged: Judged, about: About) -> RowFacts:
    return RowFacts(
        slot=judged.slot,
        device=judged.device,
        method=judged.method,
        verdict=judged.verdict,
        rule=Rule(judged.rule) if judged.rule else None,
        reason=judged.reason or None,
        figures=[_figure(change) for change in judged.changes],
        command=about.command,
        seconds=about.seconds,
        earlier=about.earlier,
        picture=None if about.picture is None else str(about.picture),
    )


def _figure(change: Change) -> FigureFacts:
    held = change.tolerance
    tolerance = ToleranceFacts(held.better, held.absolute, held.relative) if held else None
    return FigureFacts(change.figure, change.before, change.now, change.allowed, tolerance, change.verdict)


@dataclass(frozen=True)
class StepFacts:
    """Say where a gated figure changed by more than the gate's tolerance.

    figure: its name, or status
    slot: of the row
    device: of the row
    worse: whether it got worse
    before, now: its values, as they are printed
    since: the commit before the step, all digits of its hash
    commit: the commit at the step, all digits of its hash
    subject: the first line of that commit's message
    date: when it was committed (ISO 8601)
    notes: what may explain the step beside the commit
    crept: whether it got there in several changes, of which none is beyond the tolerance
    """

    figure: str
    slot: str
    device: str
    worse: bool
    before: str
    now: str
    since: str
    commit: str
    subject: str
    date: str
    notes: Sequence[str]
    crept: bool


@dataclass(frozen=True)
class History:
    """Say which gated figures changed over the commits whose runs are kept.

    page: the HTML file that was drawn
    runs: how many kept runs it shows
    steps: the worst first
    """

    page: str
    runs: int
    steps: Sequence[StepFacts]


def history(page: Path, runs: int, steps: Sequence[Step]) -> History:
    """Return what is said of the kept runs that were drawn."""
    return History(str(page), runs, [_step(step) for step in steps])


def _step(step: Step) -> StepFacts:
    return StepFacts(
        figure=step.figure,
        slot=step.slot,
        device=step.device,
        worse=step.worse,
        before=step.before,
        now=step.now,
        since=step.since.hash,
        commit=step.commit.hash,
        subject=step.commit.subject,
        date=step.commit.date,
        notes=step.notes,
        crept=step.crept,
    )
