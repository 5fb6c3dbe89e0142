"""Each variant's time over the fastest right one's, round by round of one interleaved run."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pandas as pd

from harness.measure import Ratio, paired_ratio
from reports import derive, tables, wording
from reports.content import Block, Column, Section, Table, Text

_NEEDED = [
    *("comparison", "device", "precision", "key", "variant", "wrong_rays", "session", "rounds", "samples_ms"),
    *("surface_title", "view", "size", "samples_per_pixel", "stage"),
]
ALIKE = 0.01  # a chance above this is no evidence that two variants differ


def sections(frame: pd.DataFrame) -> list[Section]:
    """One section where at least two variants of one comparison were timed in the same rounds; else none."""
    rows = tables.worth_printing(derive.contenders(frame))[_NEEDED]
    scenes = [group for _, group in rows.groupby("comparison", sort=False)]
    shown = scenes[: max(1, int((np.cumsum([len(group) for group in scenes]) <= tables.ROW_LIMIT).sum()))]
    tabled = [table for group in shown if (table := _table(group))]
    told = (
        "How many times the time of the fastest variant with every ray right each variant takes: the median of the "
        "ratios within rounds, so that what slows a whole round cancels, with its 95 % interval (order statistics), "
        f"and how often chance alone parts equally fast variants so (signed-rank test). At a chance over {ALIKE:g} the "
        "two are not told apart: neither should be called faster. With under 6 common rounds nothing is proved."
    )
    if len(shown) < len(scenes):
        told += f" The first {len(shown):,} of {len(scenes):,} scenes; results.csv has the samples and rounds of all."
    blocks: list[Block] = [Text(told), *tabled]
    return [Section("Variants compared round by round", tuple(blocks), wide=True)] if tabled else []


def _table(rows: pd.DataFrame) -> Table | None:
    body = []
    for (device, precision), group in rows.groupby(["device", "precision"], sort=True):
        right = group[derive.all_right(group)]
        if right.empty:
            continue
        best = next(right.head(1).itertuples())
        for row in group.itertuples():
            if row.key != best.key and (ratio := _ratio(row, best)):
                body.append((device, precision, best.variant, row.variant, *_figures(ratio), _verdict(ratio)))
    if not body:
        return None
    columns = (
        Column("device"),
        Column("precision"),
        Column("fastest right variant", stretch=1),
        Column("variant", stretch=1),
        Column("times\nits time", wording.factor, numeric=True),
        Column("from", wording.factor, numeric=True),
        Column("to", wording.factor, numeric=True),
        Column("chance", wording.error, numeric=True),
        Column("rounds", wording.count, numeric=True),
        Column("verdict"),
    )
    return Table(columns, body, tables.scene(rows), group=3)


def _ratio(row: Any, best: Any) -> Ratio | None:
    """None unless both were timed in one interleaved run."""
    if wording.absent(row.session) or row.session != best.session:
        return None
    return paired_ratio(row.samples_ms, json.loads(row.rounds), best.samples_ms, json.loads(best.rounds))


def _figures(ratio: Ratio) -> tuple[Any, ...]:
    interval = (ratio.lower, ratio.upper) if ratio.proved else (None, None)
    return (ratio.median, *interval, ratio.chance, ratio.pairs)


def _verdict(ratio: Ratio) -> str:
    if not ratio.proved:
        return "too few rounds"
    if ratio.chance > ALIKE:
        return "not told apart"
    return "slower" if ratio.lower > 1.0 else "faster" if ratio.upper < 1.0 else "not told apart"
