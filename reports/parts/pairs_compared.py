"""Compare variants round by round: each one's time over that of the fastest variant with every ray right."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from harness.results.timings import Ratio
from reports import wording
from reports.analysis import derive, rounds, ties
from reports.analysis.scene_names import scene_title
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import tables
from reports.material import Material

ORDER = 32
_NEEDED = [
    *("comparison", "device", "precision", "key", "method", "variant", "wrong_rays", *ties.COLUMNS),
    *("surface_title", "view", "size", "samples_per_pixel", "stage"),
]


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless two variants or more of one comparison were timed in the same rounds."""
    frame = material.listed
    rows = tables.worth_printing(derive.contenders(frame))[_NEEDED]
    by_scene = {scene: group for scene, group in rows.groupby("comparison", sort=False)}
    scenes = [by_scene[scene] for scene in dict.fromkeys(frame["comparison"]) if scene in by_scene]  # the plan's order
    shown = scenes[: max(1, int((np.cumsum([len(group) for group in scenes]) <= tables.ROW_LIMIT).sum()))]
    tabled = [table for group in shown if (table := _table(group))]
    told = (
        "How many times the time of the fastest variant with every ray right each variant takes that answers every ray "
        "rightly too: the median of the ratios within rounds, so that what slows a whole round cancels, with its 95 % "
        "interval (order statistics), and how often chance alone parts equally fast variants so (signed-rank test). "
        f"At a chance over {ties.LEVEL:g}, or where the interval reaches across 1, the two are not told apart: neither "
        f"should be called faster. So many rounds n give a chance of at least 2^(1 − n): it takes {ties.NEEDED} to "
        "tell anything apart, and 6 for an interval. Each chance is of one comparison: of 100 pairs that are equally "
        "fast one is told apart by chance."
    )
    if len(shown) < len(scenes):
        told += f" The first {len(shown):,} of {len(scenes):,} scenes; results.csv has the samples and rounds of all."
    blocks: list[Block] = [Text(told), *tabled]
    return [Section("Variants compared round by round", tuple(blocks))] if tabled else []


def _table(rows: pd.DataFrame) -> Table | None:
    """Make the table of one scene; None where nothing was timed beside the fastest right variant."""
    body = []
    for (device, precision), group in rows.groupby(["device", "precision"], sort=True):
        right = group[derive.all_right(group)]
        if right.empty:
            continue
        best = ties.best(right)
        for row in group.itertuples():
            if row.key != best.key and (ratio := rounds.ratio(row, best)):
                sound = row.key in set(right["key"])
                figures = _figures(ratio) if sound else (None, None, None, None, ratio.pairs)
                told = ties.verdict(ratio) if sound else f"{wording.count(row.wrong_rays)} wrong rays: not compared"
                body.append((device, precision, best.variant, row.variant, *figures, told))
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
        Column("common\nrounds", wording.count, numeric=True),
        Column("verdict", stretch=1),
    )
    return Table(columns, body, scene_title(rows), group=3)


def _figures(ratio: Ratio) -> tuple[Any, ...]:
    """Return the median, the interval's two ends, the chance and the number of common rounds."""
    interval = (ratio.lower, ratio.upper) if ratio.proved else (None, None)
    return (ratio.median, *interval, ratio.chance, ratio.pairs)
