"""What became of each row since the baseline was blessed."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from harness.contract import CellStatus
from harness.gate.baseline import Baseline, Entry
from harness.results.facts import FACTS
from harness.results.figures import GATED, Better


class Verdict(StrEnum):
    """Worst first. INCOMPARABLE is no pass: nothing can be said of the row."""

    REGRESSED = "regressed"
    MISSING = "missing"
    INCOMPARABLE = "incomparable"
    NEW = "new"
    IMPROVED = "improved"
    PASS = "pass"


ORDER = list(Verdict)


@dataclass(frozen=True)
class Tolerance:
    """`now` may be worse than `before` by absolute + relative * |before|; better by more than that is improved. What is
    no number is regressed."""

    better: Better
    absolute: float
    relative: float

    def allowed(self, before: float) -> float:
        """The worst value that passes."""
        slack = self.absolute + self.relative * abs(before)
        return before + slack if self.better == "lower" else before - slack

    def verdict(self, before: float, now: float) -> Verdict:
        slack = self.absolute + self.relative * abs(before)
        worse = now - before if self.better == "lower" else before - now
        return Verdict.IMPROVED if worse < -slack else Verdict.PASS if worse <= slack else Verdict.REGRESSED


@dataclass(frozen=True)
class Change:
    """One gated figure of a row."""

    figure: str
    before: Any
    now: Any
    allowed: Any
    verdict: Verdict

    @property
    def size(self) -> float:
        """How far beyond what is allowed, over the baseline; 0 for what passes, to sort by."""
        if self.verdict is Verdict.PASS:
            return 0.0
        if isinstance(self.allowed, str) or isinstance(self.now, str):  # a status, or a figure that is gone
            return math.inf
        size = float(abs(self.now - self.allowed) / max(abs(self.before), 1e-300))
        return math.inf if math.isnan(size) else size


@dataclass(frozen=True)
class Judged:
    """A row's verdict: the worst of its figures', or why there is none."""

    slot: str
    device: str
    method: str
    verdict: Verdict
    reason: str = ""
    changes: tuple[Change, ...] = ()

    @property
    def worst(self) -> Change | None:
        return max(self.changes, key=lambda c: (-ORDER.index(c.verdict), c.size), default=None)


def judge(
    now: Baseline, before: Baseline, methods: Mapping[str, str], tolerances: Mapping[str, Tolerance]
) -> list[Judged]:
    """Every row of `now`, and of `before` those of the same devices that are gone; the worst first.

    `methods`: each slot's method.
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
    """Why a device has no baseline, by the nearest one that has."""
    alike = [old for old in before.devices.values() if old.get("name") == facts["name"]]
    if not alike:
        known = ", ".join(sorted({str(old.get("name")) for old in before.devices.values()})) or "no device"
        return f"the baseline is of {known}, not of {facts['name']}"

    def differing(old: Mapping[str, Any]) -> list[str]:
        return [f"{name}: {old.get(name)!r} → {facts[name]!r}" for name in FACTS if old.get(name) != facts[name]]

    nearest = min((differing(old) for old in alike), key=lambda changes: len(changes))
    return f"blessed on another {facts['name']}: {'; '.join(nearest)}"


def exit_code(judged: list[Judged], broken: Container[tuple[str, str]]) -> int:
    """1 where a row regressed or is missing; else 3 where a row could not be judged, or a new one did not finish, or
    nothing was compared at all; else 0. `broken`: slot and device of the rows that did not finish."""
    verdicts = {j.verdict for j in judged}
    if verdicts & {Verdict.REGRESSED, Verdict.MISSING}:
        return 1
    broken_new = any(j.verdict is Verdict.NEW and (j.slot, j.device) in broken for j in judged)
    compared = verdicts & {Verdict.PASS, Verdict.IMPROVED}
    return 3 if Verdict.INCOMPARABLE in verdicts or broken_new or not compared else 0


def tolerances_of(own: Mapping[str, Any]) -> dict[str, Tolerance]:
    """Each gated figure's tolerance: the config's `own` in place of the defaults; those it leaves ungated are gone."""
    chosen = {}
    for name, figure in GATED.items():
        choice = own.get(name)
        if choice is None:
            chosen[name] = Tolerance(figure.better, figure.absolute, figure.relative)
        elif choice.gated:
            chosen[name] = Tolerance(choice.better or figure.better, choice.absolute, choice.relative)
    return chosen
