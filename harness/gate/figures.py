"""What is gated of a row: figures that the same program on the same device gives again to the last digit."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

from harness.store import Row

Better = Literal["lower", "higher"]
Value = float | int | None


@dataclass(frozen=True)
class Figure:
    """One gated figure: which way is better, and by how much it may get worse before it counts.

    `read` finds it in a view's accuracy, `add_up` in a family's rungs; None: it has none there.
    """

    name: str
    better: Better
    absolute: float
    relative: float
    meaning: str
    read: Callable[[dict[str, Any]], Value] | None
    add_up: Callable[[list[dict[str, Any]]], Value] | None


def _count(name: str, meaning: str) -> Figure:
    return Figure(
        name, "lower", 0.0, 0.0, meaning, lambda found: found[name], lambda rungs: sum(rung[name] for rung in rungs)
    )


def _error(quantile: str, meaning: str) -> Figure:
    return Figure(f"error_{quantile}", "lower", 1e-15, 0.05, meaning, lambda found: found["error"][quantile], None)


def _worst(rungs: list[dict[str, Any]], name: str) -> Value:
    return max((rung[name] for rung in rungs if rung[name] is not None), default=None)


_WRONG = ("misses", "false_hits", "exhausted", "wrong_root")


def _within(kind: str) -> Callable[[dict[str, Any]], Value]:
    """Wrong answers in the class of `kind` rays; None in rows from before the class was."""
    names = [f"{kind}_{name}" for name in _WRONG]
    return lambda found: sum(found[name] for name in names) if names[0] in found else None


FIGURES: tuple[Figure, ...] = (
    _count("misses", "clear rays, neither grazing nor drowned, whose hit was missed"),
    _count("false_hits", "clear rays that hit nothing"),
    _count("exhausted", "clear rays that ran out of evaluations"),
    _count("wrong_root", "clear rays that hit a later root, or no root"),
    Figure("grazing_wrong", "lower", 2.0, 0.1, "wrong answers in the grazing class",
           _within("grazing"), None),
    Figure("drowned_wrong", "lower", 2.0, 0.1, "wrong answers in the class of drowned rays", _within("drowned"), None),
    _error("max", "largest |t - t*|, scene units"),
    _error("p99", "99th percentile of |t - t*|, scene units"),
    Figure("worst_ratio", "lower", 1e-9, 0.05, "largest error over what the problem allows, of a family",
           None, lambda rungs: _worst(rungs, "worst_ratio")),
    Figure("right", "higher", 0.0, 0.0, "rays of a family answered rightly",
           None, lambda rungs: sum(rung["right"] for rung in rungs)),
    Figure("evaluations_mean", "lower", 1e-9, 0.0, "evaluations of f spent on a ray, in the mean",
           lambda found: found["evaluations_mean"], None),
)  # fmt: skip
CLAIMS = Figure("claims", "higher", 0.0, 0.0, "claims stated by the method that this row does not disprove", None, None)
SPEED = Figure("speed", "lower", 0.0, 0.05, "with --against: time over the other revision's, above 1", None, None)
GATED = {figure.name: figure for figure in (*FIGURES, CLAIMS)}
KNOWN = (*GATED, SPEED.name)


def figures(row: Row, claims: Iterable[str]) -> dict[str, Value]:
    """Every figure that `row` has, by name."""
    found: dict[str, Value] = {}
    accuracy, rungs = row["accuracy"], row["rungs"]
    for figure in FIGURES:
        if accuracy is not None and figure.read:
            found[figure.name] = figure.read(accuracy)
        elif rungs is not None and figure.add_up:
            found[figure.name] = figure.add_up(rungs)
    if found:
        found[CLAIMS.name] = sum(not _disproved(claim, row) for claim in claims)
    return {name: value for name, value in found.items() if value is not None}


def _missed(count: dict[str, Any]) -> int:
    """Hits missed, in whatever class their rays are."""
    return int(sum(count.get(name, 0) for name in ("misses", "grazing_misses", "drowned_misses")))


def _disproved(claim: str, row: Row) -> bool:
    """Whether this row contradicts the claim (contract.CLAIMS); one that no row can contradict stands while stated."""
    counts = [row["accuracy"]] if row["accuracy"] else row["rungs"]
    match claim:
        case "no_missed_root":
            return any(_missed(count) > 0 for count in counts)
        case "conservative_bound":
            return any(count["misses"] > 0 for count in counts)
        case "no_false_hit":
            return any(count["false_hits"] > 0 for count in counts)
    return False
