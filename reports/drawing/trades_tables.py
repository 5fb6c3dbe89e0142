"""Make the tables of what one gains and pays beside the winners, and of how long other devices take."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import choices, derive, rounds, tradeoffs
from reports.analysis.scene_names import scene_names
from reports.content import Column, Table
from reports.reading.tuples import tuples


def trades(found: Sequence[choices.Choice]) -> Table | None:
    """Make a line for each variant to take in place of a surface's winner; None where there is none."""
    body = []
    for one in found:
        if one.best is None:
            continue
        best = f"{choices.written(one.best, one.rows)}, {wording.number(one.best.median_ms)} ms"
        error = one.best.relative_error_max
        for trade in tradeoffs.faster(one):
            row = trade.row
            gained = "faster" if wording.absent(trade.times) else f"{wording.factor(1 / trade.times)} as fast"
            wrong = wording.plural(int(row.wrong_rays), "wrong ray")
            paid = f"{wrong} of {wording.count(row.accuracy_rays)}"
            body.append((one.name, best, choices.written(row, one.rows), gained, paid, row.relative_error_max))
        for trade in tradeoffs.exacter(one):
            row = trade.row
            less = error / row.relative_error_max if row.relative_error_max else float("inf")
            gained = f"error {wording.factor(less)} smaller" if less < float("inf") else "an error of 0"
            paid = "more time" if wording.absent(trade.times) else f"{wording.factor(trade.times)} the time"
            body.append((one.name, best, choices.written(row, one.rows), gained, paid, row.relative_error_max))
    if not body:
        return None
    columns = (
        Column("surface"),
        Column("the winner", stretch=3),
        Column("instead of it", stretch=3),
        Column("gains", stretch=3),
        Column("and pays", stretch=3),
        Column("error", wording.error, numeric=True),
    )
    device = found[0].rows["device"].iloc[0]
    return Table(
        columns,
        body,
        f"Trade-offs on {device}.",
        "What is faster than the winner answers some rays wrongly; what is more exact takes longer. Ratios of times "
        "are of the rounds that timed both; error is the largest over the scene's radius."
        + wording.zeros([row[-1] for row in body]),
        group=2,
    )


def devices(frame: pd.DataFrame) -> Table | None:
    """Make a line for each device but the one with most rows: how long the same variants take there.

    None where there is nothing to compare. Only variants that are right on both devices are compared.
    """
    if frame["device"].nunique() < 2:
        return None
    rows = derive.contenders(frame)
    fullest = str(derive.on_fullest_device(rows)["device"].iloc[0])
    rows = rows[derive.all_right(rows)]
    kernel = ["comparison", "variant", "precision"]
    first = rows[rows["device"] == fullest].drop_duplicates(kernel)
    body: list[tuple[Any, ...]] = []
    named, apart = scene_names(frame), False
    for device, own in rows[rows["device"] != fullest].groupby("device", sort=False):
        both = own.drop_duplicates(kernel).merge(first, on=kernel, suffixes=("", "_first"))
        if both.empty:
            continue
        times = _over(both)
        apart |= bool((both["session"] != both["session_first"]).any())
        if times.isna().all():
            continue
        low, high = both.loc[times.idxmin()], both.loc[times.idxmax()]
        told = f"{low.label} on {named[low.comparison]}; {high.label} on {named[high.comparison]}"
        body.append((device, int(times.notna().sum()), times.median(), times.min(), times.max(), told))
    if not body:
        return None
    columns = (
        Column("device"),
        Column("compared", wording.count, numeric=True),
        Column("median", wording.factor, numeric=True, over=f"time over that on {fullest}"),
        Column("least", wording.factor, numeric=True, over=f"time over that on {fullest}"),
        Column("most", wording.factor, numeric=True, over=f"time over that on {fullest}"),
        Column("least and most are of", stretch=1),
    )
    turns = (
        "Some of these times were not taken in turns, so that other load on one of two devices shifts a ratio."
        if apart
        else "Ratios are of the rounds that timed both."
    )
    clocks = " Devices that are timed by different clocks are compared by the host's." * (rows["clock"].nunique() > 1)
    caption = f"The same variant on the same scene, right on both. Above 1× is slower. {turns}{clocks}"
    return Table(columns, body, "The other devices.", caption)


def _over(both: pd.DataFrame) -> pd.Series:
    """Return the times of rows over those of another device, whose columns end in _first; float64 with their index.

    They are of the rounds that timed both or, where these were not timed in turns, of the two medians; NaN where no
    clock tells both.
    """
    names = [*rounds.COLUMNS, *rounds.CLOCKS, "median_ms"]
    own, first = both[names], both[[f"{name}_first" for name in names]].set_axis(names, axis=1)
    found = []
    for row, other in zip(tuples(own), tuples(first), strict=True):
        times = rounds.times_elsewhere(row, other)
        if math.isnan(times):
            clocks = 1.0 if row.clock == other.clock else rounds.on_host(row) / rounds.on_host(other)
            times = clocks * row.median_ms / other.median_ms
        found.append(times)
    return pd.Series(found, both.index, dtype="float64")
