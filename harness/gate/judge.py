"""Judge what became of each row since the baseline was blessed."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, cast

from harness.contract import CellStatus
from harness.experiment.config import ToleranceChoice
from harness.gate.baseline import Baseline, Entry
from harness.results.facts import FACTS
from harness.results.figures import GATED, Better


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
    """

    better: Better
    absolute: float
    relative: float

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
    """Hold what became of one gated figure of a row, or of its status."""

    figure: str
    before: Value
    now: Value
    allowed: Value
    verdict: Verdict

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
    """Hold a row's verdict, which is the worst of its figures', and the reason where it follows from no figure.

    rule: by what rule its figures were held; "" where no figure was
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
    """Judge every row of `now`, and those rows of `before` on the same devices that are gone; the worst comes first.

    methods: each slot's method
    tolerances: each gated figure's tolerance, as `tolerances_of` returns them
    """
    judged: list[Judged] = []
    for key, rows in now.rows.items():
        name = now.devices[key]["name"]
        blessed = before.rows.get(key)
        for slot, entry in rows.items():
            told = (slot, name, methods[slot])
            if blessed is None:
                judged.append(Judged(*told, Verdict.INCOMPARABLE, _elsewhere(now.devices[key], before)))
            else:
                judged.append(_judge_row(*told, entry, blessed.get(slot), tolerances))
        for slot in sorted((blessed or {}).keys() - rows.keys()):
            method = slot.partition(" ")[0].partition("[")[0]
            judged.append(Judged(slot, name, method, Verdict.MISSING, "blessed, but no longer in the config"))
    return sorted(judged, key=rank)


def rank(judged: Judged) -> tuple[int, float, str, str]:
    """Return a key to sort by: the worst comes first."""
    return ORDER.index(judged.verdict), -(judged.worst.size if judged.worst else 0.0), judged.slot, judged.device


def _judge_row(
    slot: str, device: str, method: str, now: Entry, before: Entry | None, tolerances: Mapping[str, Tolerance]
) -> Judged:
    """Judge one row by its entry now and the one that was blessed, if one was."""
    if before is None:
        return Judged(slot, device, method, Verdict.NEW, f"{now['status']}; bless to gate it")
    if now["scene"] != before["scene"]:
        reason = "surface, view, rays or family are others than those blessed under this name"
        return Judged(slot, device, method, Verdict.INCOMPARABLE, reason)
    if now["status"] != before["status"]:
        verdict = Verdict.IMPROVED if now["status"] == CellStatus.OK else Verdict.REGRESSED
        change = Change("status", before["status"], now["status"], before["status"], verdict)
        return Judged(slot, device, method, verdict, now.get("reason", ""), (change,))
    if now["status"] not in (CellStatus.OK, CellStatus.SKIPPED):
        return Judged(slot, device, method, Verdict.INCOMPARABLE, f"{now['status']}, now as when it was blessed")
    changes: list[Change] = []
    for name, tolerance in tolerances.items():
        old, new = before.get(name), now.get(name)
        if old is None and new is not None:
            old = GATED[name].unsaid
        if old is not None and new is not None:
            changes.append(Change(name, old, new, tolerance.allowed(old), tolerance.verdict(old, new)))
        elif old is not None:
            changes.append(Change(name, old, "none", tolerance.allowed(old), Verdict.REGRESSED))
    verdict = ORDER[min((ORDER.index(change.verdict) for change in changes), default=ORDER.index(Verdict.PASS))]
    return Judged(slot, device, method, verdict, "", tuple(changes))


def _elsewhere(facts: Mapping[str, Any], before: Baseline) -> str:
    """Say why a device has no baseline: in which facts it differs from the most similar one that has."""
    alike = [old for old in before.devices.values() if old.get("name") == facts["name"]]
    if not alike:
        known = ", ".join(sorted({str(old.get("name")) for old in before.devices.values()})) or "no device"
        return f"the baseline is of {known}, not of {facts['name']}"

    def differing(old: Mapping[str, Any]) -> list[str]:
        """List the facts in which a blessed device differs from this one."""
        return [f"{name}: {old.get(name)!r} → {facts[name]!r}" for name in FACTS if old.get(name) != facts[name]]

    nearest = min((differing(old) for old in alike), key=lambda changes: len(changes))
    return f"blessed on another {facts['name']}: {'; '.join(nearest)}"


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


def tolerances_of(own: Mapping[str, ToleranceChoice]) -> dict[str, Tolerance]:
    """Return each gated figure's tolerance by its name: the config's `own` where it states one, else the default.

    Figures that the config does not want gated are left out.
    """
    chosen = {}
    for name, figure in GATED.items():
        choice = own.get(name)
        if choice is None:
            chosen[name] = Tolerance(figure.better, figure.absolute, figure.relative)
        elif choice.gated:
            chosen[name] = Tolerance(cast("Better", choice.better or figure.better), choice.absolute, choice.relative)
    return chosen
