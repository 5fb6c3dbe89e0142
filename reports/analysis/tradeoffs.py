"""Tell what one gains and pays beside the best variant: by faster ones that are wrong, by slower more exact ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd

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
    rows, wrong = choice.rows, choice.rows["wrong_rays"].tolist()
    judged = (~derive.all_right(rows) & rows["wrong_rays"].notna()).to_numpy()
    faster = ~(rounds.medians_over(rows.loc[judged, rounds.COLUMNS], best) >= 1.0)  # the others take no test
    found: list[Trade] = []
    for at in np.flatnonzero(judged)[faster].tolist():
        if not found or wrong[at] <= LESS * found[-1].row.wrong_rays:
            row = _at(rows, at)
            if ties.is_slower(best, row):
                found.append(Trade(row, rounds.times_over(row, best)))
    return _ends(found)


def exacter(choice: Choice) -> list[Trade]:
    """Return variants with every ray right that are more exact than the best, the fastest first; at most MOST.

    Each is clearly more exact than the best and than those before it. [] where there is no best.
    """
    best = choice.best
    if best is None:
        return []
    rows, errors = choice.rows, choice.rows["error_max"].tolist()
    own = derive.all_right(rows) & (rows["precision"] == best.precision) & rows["error_max"].notna()
    found: list[Trade] = []
    bound = LESS * best.error_max
    for at in np.flatnonzero(own).tolist():
        if errors[at] <= bound and errors[at] < best.error_max and rows.index[at] != best.Index:
            row = _at(rows, at)
            found.append(Trade(row, rounds.times_over(row, best)))
            bound = LESS * row.error_max
    return _ends(found)


def _at(rows: pd.DataFrame, place: int) -> Any:
    """Return the row at a place as a named tuple."""
    return next(tuples(rows.iloc[place : place + 1]))


def _ends(found: list[Trade]) -> list[Trade]:
    """Return at most MOST of them: the first ones and the last."""
    return found if len(found) <= MOST else [*found[: MOST - 1], found[-1]]
