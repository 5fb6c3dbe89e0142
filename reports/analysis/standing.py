"""Say how the variants stand on one scene: the fastest within an error, and what is faster but wrong."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd

from reports.analysis import derive, rounds, ties

ERRORS = (1e-3, 1e-6)  # largest |t − t*| over the scene's radius


def usable(rows: pd.DataFrame, error: float) -> pd.DataFrame:
    """Return the timed rows with no wrong ray away from silhouettes and at most this error, fastest first.

    `error` is over the scene's radius.
    """
    timed = rows[rows["median_ms"].notna()]
    good = timed[derive.all_right(timed) & (timed["relative_error_max"] <= error)]
    return good.sort_values("median_ms", kind="stable")


def fastest(rows: pd.DataFrame, error: float) -> Any | None:
    """Return the fastest of the usable rows of one scene, device and precision; None without any."""
    good = usable(rows, error)
    return None if good.empty else next(good.loc[[ties.best(good).Index]].itertuples())


def gambles(rows: pd.DataFrame, won: Any) -> list[tuple[Any, float]]:
    """Return the rows that answer rays wrongly and are proved faster than `won`, the fastest first.

    Beside each is how many times as fast it is, in the rounds that timed both.
    """
    wrong = rows[(rows["wrong_rays"] > 0).fillna(False) & rows["median_ms"].notna()]
    told = [(row, rounds.times_over(won, row)) for row in wrong.itertuples() if ties.is_slower(won, row)]
    return sorted(((row, times) for row, times in told if not math.isnan(times)), key=lambda pair: -pair[1])
