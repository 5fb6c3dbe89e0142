"""Judge what became of each row since the baseline was blessed."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from types import MappingProxyType
from typing import cast

from harness.contract import CellStatus
from harness.experiment.config import SlackChoice, ToleranceChoice
from harness.gate.baseline import LAST_BIT, Baseline, Entry
from harness.gate.comparable import OTHER_SCENE, Held, Rule, distance, held_against
from harness.results.figures import GATED, NO_SLACK, Better, Slack


class Verdict(StrEnum):
    """Name what became of a row, the worst first.

    INCOMPARABLE: nothing can be said of the row, so that this is no pass
    MISSING: the row was blessed, and its cell is no longer in the config
    """

    REGRESSED = "regressed"
    MISSING = "missing"
    INCOMPARABLE = "incomparable"
    NEW = "new"
    IMPROVED = "improved"
    PASS = "pass"


ORDER = list(Verdict)
Value = float | int | str  # of a figure; a text for a status, and for a figure that is gone


@dataclass(frozen=True)
class Tolerance:
    """State how much a figure may change: by absolute + relative * |before|, for the worse, and still pass.

    A figure that is better by more than that is improved. One that is NaN is regressed.

    last_bits: how much more it may change on a device that computes with other last bits
    of_family: the same for a row of a family, if it is not `last_bits`
    """

    better: Better
    absolute: float
    relative: float
    last_bits: Slack = NO_SLACK
    of_family: Slack | None = None

    def under(self, rule: Rule, last_bit: float = 0.0, family: bool = False) -> Tolerance:
        """Return the tolerance that a rule allows, with the slack in it and none beside it.

        `last_bit` is the row's, see kinds.comparing. `family` says whether the row is of a family.
        """
        stated = self.of_family if family and self.of_family else self.last_bits
        slack = stated if rule is Rule.LAST_BITS else NO_SLACK
        absolute = self.absolute + slack.absolute + slack.bits * last_bit
        return Tolerance(self.better, absolute, self.relative + slack.relative)

    def allowed(self, before: float) -> float:
        """Return the worst value that passes."""
        slack = self.absolute + self.relative * abs(before)
        return before + slack if self.better == "lower" else before - slack

    def verdict(self, before: float, now: float) -> Verdict:
        """Judge a figure's value now by its value before."""
        slack = self.absolute + self.relative * abs(before)
        worse = now - before if self.better == "lower" else before - now
        return Verdict.IMPROVED if worse < -slack else Verdict.PASS if worse <= slack else Verdict.REGRESSED


@dataclass(frozen=True)
class Change:
    """Hold what became of one gated figure of a row, or of its status, which has no tolerance."""

    figure: str
    before: Value
    now: Value
    allowed: Value
    verdict: Verdict
    tolerance: Tolerance | None = field(default=None, compare=False)

    @property
    def size(self) -> float:
        """Return how far the value is beyond what is allowed, over the baseline's value, to sort by; 0 for a pass."""
        if self.verdict is Verdict.PASS:
            return 0.0
        if isinstance(self.before, str) or isinstance(self.allowed, str) or isinstance(self.now, str):
            return math.inf  # a status, or a figure that is gone
        size = float(abs(self.now - self.allowed) / max(abs(self.before), 1e-300))
        return math.inf if math.isnan(size) else size


@dataclass(frozen=True)
class Judged:
    """Hold a row's verdict, which is the worst of its figures'.

    reason: why, if the verdict follows from no figure, and why the rule is not EXACT
    rule: by which Rule the row was held against another one; "" if it was held against none
    """

    slot: str
    device: str
    method: str
    verdict: Verdict
    reason: str = ""
    changes: tuple[Change, ...] = ()
    rule: str = ""

    @property
    def worst(self) -> Change | None:
        """Return the change with the worst verdict, and of several such the largest; None without a change."""
        return max(self.changes, key=lambda c: (-ORDER.index(c.verdict), c.size), default=None)


def judge(
    now: Baseline, before: Baseline, methods: Mapping[str, str], tolerances: Mapping[str, Tolerance]
) -> list[Judged]:
    """Judge every row of `now`, and those rows of `before` that are gone; the worst comes first.

    methods: each slot's method
    tolerances: each gated figure's tolerance, as `tolerances_of` returns them
    """
    judged: list[Judged] = []
    for key, rows in now.rows.items():
        facts, used = now.devices[key], set[str]()
        for slot, entry in rows.items():
            held = held_against(slot, entry, facts, before)
            if isinstance(held, Held):
                used.add(held.key)
            judged.append(_judged(slot, facts["name"], methods[slot], entry, held, tolerances))
        if before.devices and not used:
            used = {min(before.devices, key=lambda one: distance("", facts, before.devices[one], one))}
        judged += missing(facts["name"], rows, {one: before.rows.get(one, {}) for one in used})
    return sorted(judged, key=rank)


def missing(device: str, slots: Container[str], blessed: Mapping[str, Mapping[str, Entry]]) -> list[Judged]:
    """Judge the rows of blessed devices that a device's `slots` lack, each once."""
    gone = sorted({slot for rows in blessed.values() for slot in rows if slot not in slots})
    reason = "blessed, but no longer in the config"
    return [Judged(slot, device, slot.partition(" ")[0].partition("[")[0], Verdict.MISSING, reason) for slot in gone]


def _judged(
    slot: str, device: str, method: str, now: Entry, held: Held | str | None, tolerances: Mapping[str, Tolerance]
) -> Judged:
    """Judge one row by what it is held against."""
    if isinstance(held, str):
        return Judged(slot, device, method, Verdict.INCOMPARABLE, held)
    if held is None:
        return judge_row(slot, device, method, now, None, tolerances)
    tolerances = {name: tolerance for name, tolerance in tolerances.items() if name not in held.left_out}
    judged = judge_row(slot, device, method, now, held.entry, tolerances, held.rule)
    return replace(judged, reason="; ".join(filter(None, (judged.reason, held.reason))))


def rank(judged: Judged) -> tuple[int, float, str, str]:
    """Return a key to sort by: the worst comes first."""
    return ORDER.index(judged.verdict), -(judged.worst.size if judged.worst else 0.0), judged.slot, judged.device


def judge_row(
    slot: str,
    device: str,
    method: str,
    now: Entry,
    before: Entry | None,
    tolerances: Mapping[str, Tolerance],
    rule: Rule = Rule.EXACT,
) -> Judged:
    """Judge one row by its entry now and the one that it is held against, if there is one, by a rule."""
    if before is None:
        return Judged(slot, device, method, Verdict.NEW, f"{now['status']}; bless to gate it")
    if now["scene"] != before["scene"]:
        return Judged(slot, device, method, Verdict.INCOMPARABLE, OTHER_SCENE)
    if now["status"] != before["status"]:
        verdict = Verdict.IMPROVED if now["status"] == CellStatus.OK else Verdict.REGRESSED
        change = Change("status", before["status"], now["status"], before["status"], verdict)
        return Judged(slot, device, method, verdict, now.get("reason", ""), (change,), rule)
    if now["status"] not in (CellStatus.OK, CellStatus.SKIPPED):
        return Judged(slot, device, method, Verdict.INCOMPARABLE, f"{now['status']}, now as when it was blessed")
    changes: list[Change] = []
    for name, stated in tolerances.items():
        tolerance = stated.under(rule, now.get(LAST_BIT, 0.0), family="right" in before)
        old, new = before.get(name), now.get(name)
        if old is None and new is not None:
            old = GATED[name].unsaid
        if old is not None and new is not None:
            changes.append(Change(name, old, new, tolerance.allowed(old), tolerance.verdict(old, new), tolerance))
        elif old is not None:
            changes.append(Change(name, old, "none", tolerance.allowed(old), Verdict.REGRESSED, tolerance))
    verdict = ORDER[min((ORDER.index(change.verdict) for change in changes), default=ORDER.index(Verdict.PASS))]
    return Judged(slot, device, method, verdict, "", tuple(changes), rule)


def unloaded(broken: Mapping[str, str], judged: Sequence[Judged]) -> list[Judged]:
    """Return a verdict on each method that cannot be loaded and has no row: with one of them a gate is no pass.

    `broken` says why, by the method's name. The verdicts are for people and CI servers, who else read of passes alone.
    """
    methods = {j.method for j in judged}
    return [
        Judged(f"method {name}", "every device", name, Verdict.INCOMPARABLE, f"the method cannot be loaded: {why}")
        for name, why in broken.items()
        if name not in methods
    ]


def exit_code(judged: list[Judged], broken: Container[tuple[str, str]]) -> int:
    """Return the exit code of a gate.

    1: a row regressed or is missing
    3: a row could not be judged, a new one did not finish, or no row was compared
    0: none of these

    `broken` holds slot and device of the rows that did not finish.
    """
    verdicts = {j.verdict for j in judged}
    if verdicts & {Verdict.REGRESSED, Verdict.MISSING}:
        return 1
    broken_new = any(j.verdict is Verdict.NEW and (j.slot, j.device) in broken for j in judged)
    compared = verdicts & {Verdict.PASS, Verdict.IMPROVED}
    return 3 if Verdict.INCOMPARABLE in verdicts or broken_new or not compared else 0


def tolerances_of(
    own: Mapping[str, ToleranceChoice], last_bits: Mapping[str, SlackChoice] = MappingProxyType({})
) -> dict[str, Tolerance]:
    """Return each gated figure's tolerance by its name: the config's `own` where it states one, else the default.

    The same holds of the slack, of which the config's own is in `last_bits`. Figures that are not to be gated are left
    out.
    """
    chosen = {}
    for name, figure in GATED.items():
        choice, slack = own.get(name), last_bits.get(name)
        better, absolute, relative = figure.better, figure.absolute, figure.relative
        if choice:
            better, absolute, relative = cast("Better", choice.better or better), choice.absolute, choice.relative
        if choice is None or choice.gated:
            bits = Slack(slack.absolute, slack.relative) if slack else figure.last_bits
            chosen[name] = Tolerance(better, absolute, relative, bits, None if slack else figure.of_family)
    return chosen
