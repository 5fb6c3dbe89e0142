"""Tell what one gains and pays beside the best variant: by faster ones that are wrong, by slower more exact ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from reports import wording
from reports.analysis import derive, rounds, ties
from reports.analysis.choices import Choice
from reports.reading.tuples import tuples

MOST = 2  # of each kind, for one surface
LESS = 0.8  # what is told has at most this share of the wrong rays, or of the error, of what is told before it


@dataclass(frozen=True)
class Trade:
    """Hold a variant to take in place of the best one of its scene.

    row: its row, as a named tuple
    times: its time over that of the best, in the rounds that timed both
    """

    row: Any
    times: float

    @property
    def told(self) -> str:
        """Say what it gains and what it costs in wrong rays: 83× as fast, 2 wrong rays."""
        wrong = wording.plural(int(self.row.wrong_rays), "wrong ray")
        return wrong if wording.absent(self.times) else f"{wording.factor(1.0 / self.times)} as fast, {wrong}"


def faster(choice: Choice) -> list[Trade]:
    """Return variants that are proved faster than the best and answer some rays wrongly, the fastest first.

    Each but the first has clearly fewer wrong rays than those before it: at most MOST, the last with fewest. [] where
    there is no best.
    """
    best = choice.best
    if best is None:
        return []
    rows = choice.rows[~derive.all_right(choice.rows) & choice.rows["wrong_rays"].notna()]
    found: list[Trade] = []
    faster = ~(rounds.medians_over(rows, best) >= 1.0)  # the others are no faster, which takes no test
    for row in tuples(rows[faster]):
        fewer = all(row.wrong_rays <= LESS * trade.row.wrong_rays for trade in found)
        if fewer and ties.is_slower(best, row):
            found.append(Trade(row, rounds.times_over(row, best)))
    return _ends(found)


def exacter(choice: Choice) -> list[Trade]:
    """Return variants with every ray right that are more exact than the best, the fastest first; at most MOST.

    Each is clearly more exact than the best and than those before it. [] where there is no best.
    """
    best = choice.best
    if best is None:
        return []
    rows = choice.rows[derive.all_right(choice.rows) & (choice.rows["precision"] == best.precision)]
    found: list[Trade] = []
    bound = LESS * best.error_max
    for row in tuples(rows[rows["error_max"].notna()]):
        if row.Index != best.Index and row.error_max <= bound and row.error_max < best.error_max:
            found.append(Trade(row, rounds.times_over(row, best)))
            bound = LESS * row.error_max
    return _ends(found)


def _ends(found: list[Trade]) -> list[Trade]:
    """Return at most MOST of them: the first ones and the last."""
    return found if len(found) <= MOST else [*found[: MOST - 1], found[-1]]
