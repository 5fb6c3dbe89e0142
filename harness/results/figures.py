"""Read from a row the figures that are gated.

The same program on the same device gives these figures again to the last digit. So does another device that computes
the same. On one that does not, last bits differ, and each figure states by how much that may move it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

from harness.contract import FirsthitError
from harness.results.row import KINDS
from harness.results.store import Row

Better = Literal["lower", "higher"]
Value = float | int | None


@dataclass(frozen=True)
class Slack:
    """State by how much a figure may get worse from last bits alone.

    That is `absolute` + `relative` × the baseline's + `bits` × the last bit of the row's t, in the figure's unit.
    """

    absolute: float = 0.0
    relative: float = 0.0
    bits: float = 0.0


NO_SLACK = Slack()


@dataclass(frozen=True)
class Figure:
    """State which way one gated figure is better, and by how much it may get worse before that counts.

    It may get worse by `absolute` + `relative` × the baseline's. `read` finds it in a view's accuracy and `add_up` in a
    family's rungs; each is None where the figure is not found there. `unsaid` stands for the figure in a baseline that
    was blessed before the figure existed; if it is None, such a baseline is not compared by this figure. `last_bits`
    is added to what is allowed if the baseline is of a device that computes with other last bits; `of_family` takes its
    place for families, if it is given.
    """

    name: str
    better: Better
    absolute: float
    relative: float
    meaning: str
    read: Callable[[dict[str, Any]], Value] | None
    add_up: Callable[[list[dict[str, Any]]], Value] | None
    unsaid: Value = None
    last_bits: Slack = NO_SLACK
    of_family: Slack | None = None


# What last bits move, as measured: docs/gating.md, "Last bits", has the table. A figure whose default is 0 was never
# moved. A largest error is one ray's, and rays of analytic and sturm gave 10,000 times the error on other arithmetic.
# Last bits decide many of a family's rays, by design; how they are wrong is not held then, but how many are right is.
FEW = Slack(4.0, 0.1)
ANYTHING = Slack(math.inf)


def _count(name: str, meaning: str, last_bits: Slack = FEW, of_family: Slack | None = ANYTHING) -> Figure:
    """Make the figure of a count that may not grow."""

    def added(rungs: list[dict[str, Any]]) -> Value:
        return int(sum(rung[name] for rung in rungs))

    return Figure(
        name, "lower", 0.0, 0.0, meaning, lambda found: found[name], added, last_bits=last_bits, of_family=of_family
    )


def _error(quantile: str, meaning: str, last_bits: Slack) -> Figure:
    """Make the figure of a quantile of the errors."""
    return Figure(
        f"error_{quantile}",
        "lower",
        1e-15,
        0.05,
        meaning,
        lambda found: found["error"][quantile],
        None,
        last_bits=last_bits,
    )


def _worst(rungs: list[dict[str, Any]], name: str) -> Value:
    """Return the largest value of a leaf over the rungs that have it; None where none has."""
    return max((rung[name] for rung in rungs if rung[name] is not None), default=None)


BROKEN_BY = {  # by claim, the counts that contradict it; only the first claim is about grazing and drowned rays too
    "no_missed_root": tuple(f"{kind}{name}" for name in ("misses", "invalid") for kind in ("", "grazing_", "drowned_")),
    "conservative_bound": ("misses", "invalid"),
    "no_false_hit": ("false_hits", "invalid"),
}


def _within(kind: str) -> Callable[[dict[str, Any]], Value]:
    """Make the function that adds up the wrong answers to rays of the class `kind`.

    The function returns None for a row that is older than the class.
    """
    names = [f"{kind}_{name}" for name in KINDS if name != "invalid"]
    return lambda found: sum(found[name] for name in names) if names[0] in found else None


def _invalid(found: dict[str, Any]) -> Value:
    """Count the impossible answers, in all classes."""
    return int(sum(found.get(f"{kind}invalid", 0) for kind in ("", "grazing_", "drowned_")))


FIGURES: tuple[Figure, ...] = (
    _count("misses", "clear rays, neither grazing nor drowned, whose hit was missed"),
    _count("false_hits", "clear rays that hit nothing"),
    _count("exhausted", "clear rays that ran out of evaluations"),
    _count("wrong_root", "clear rays that hit a later root, or no root"),
    Figure("invalid", "lower", 0.0, 0.0, "rays whose answer is impossible, of whatever class",
           _invalid, lambda rungs: sum(rung["invalid"] for rung in rungs), 0),
    _count("undecided", "rays that the oracle leaves undecided", NO_SLACK, None),
    Figure("grazing_wrong", "lower", 2.0, 0.1, "wrong answers in the grazing class",
           _within("grazing"), None, last_bits=FEW),
    Figure("drowned_wrong", "lower", 2.0, 0.1, "wrong answers in the class of drowned rays", _within("drowned"), None,
           last_bits=FEW),
    _error("max", "largest |t - t*|, scene units", ANYTHING),
    _error("p99", "99th percentile of |t - t*|, scene units", Slack(relative=1.0, bits=2.0)),
    Figure("worst_ratio", "lower", 1e-9, 0.05, "largest error over what the problem allows, of a family",
           None, lambda rungs: _worst(rungs, "worst_ratio"), last_bits=Slack(relative=4.0, bits=2.0)),
    Figure("right", "higher", 0.0, 0.0, "rays of a family answered rightly",
           None, lambda rungs: sum(rung["right"] for rung in rungs), last_bits=Slack(8.0, 0.35)),
    Figure("evaluations_mean", "lower", 1e-9, 0.0, "evaluations of f spent on a ray, in the mean",
           lambda found: found["evaluations_mean"], None, last_bits=Slack(0.15, 1e-4)),
)  # fmt: skip
CLAIMS = Figure("claims", "higher", 0.0, 0.0, "claims stated by the method that this row does not disprove", None, None,
                of_family=Slack(1.0))  # fmt: skip
SPEED = Figure("speed", "lower", 0.0, 0.05, "with --against: time over the other revision's, above 1", None, None)
GATED = {figure.name: figure for figure in (*FIGURES, CLAIMS)}
KNOWN = (*GATED, SPEED.name)


def figures(row: Row, claims: Iterable[str]) -> dict[str, Value]:
    """Return every figure that `row` has, by name; `claims` are those of its method (contract.CLAIMS).

    Raises FirsthitError for a figure that is no finite number.
    """
    found: dict[str, Value] = {}
    accuracy, rungs = row["accuracy"], row["rungs"]
    for figure in FIGURES:
        if accuracy is not None and figure.read:
            found[figure.name] = figure.read(accuracy)
        elif rungs is not None and figure.add_up:
            found[figure.name] = figure.add_up(rungs)
    if found:
        found[CLAIMS.name] = sum(not disproved(claim, row) for claim in claims)
    for name, value in found.items():
        if value is not None and not math.isfinite(value):
            raise FirsthitError(f"{row['slot']}: its {name} is {value}, which cannot be gated", exit_code=3)
    return {name: value for name, value in found.items() if value is not None}


def disproved(claim: str, row: Row) -> bool:
    """Tell whether this row contradicts a claim. A claim that no row can contradict holds while its method states it.

    An impossible answer contradicts what is claimed of its ray, whatever the truth.
    """
    counts = [row["accuracy"]] if row["accuracy"] else row["rungs"]
    broken_by = BROKEN_BY.get(claim, ())
    return any(not sum(count.get(name, 0) for name in broken_by) <= 0 for count in counts)
