"""toledo2007's Figure 6: frame time against the number of tori, and where techniques change places."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from reports import wording
from reports.claims import picks
from reports.claims.toledo_tori import CONFIG, OURS, PICKS, crossing, curve, tori
from reports.claims.verdict_tables import verdict_tables
from reports.content import Block, Column, Section, Table
from reports.material import Material

ORDER = 12
CLAIMED = {  # what the paper's text says of Newton 0.001 against each technique
    picks.POLYGONS[0].words: "Newton 0.001 is the fastest for more than 700 tori",
    picks.POLYGONS[1].words: "Newton 0.001 is the fastest for more than 700 tori",
    picks.POLYGONS[2].words: "of equal error: Newton 0.001 is always faster",
    picks.NEWTON_5.words: "Newton 0.001 is the fastest for more than 700 tori",
}


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has no rows for it."""
    rows = tori(material.evidence.of(CONFIG))
    if rows.empty:
        return []
    blocks: list[Block] = [
        _times(rows),
        _crossings(rows),
        *verdict_tables(material.judged, CONFIG, "toledo2007, Figure 6"),
    ]
    return [Section("toledo2007, Figure 6", tuple(blocks))]


def _times(rows: pd.DataFrame) -> Table:
    """Make a line for each technique: its time by the number of tori."""
    counts = sorted(int(n) for n in rows["instances"].unique())
    body: list[tuple[Any, ...]] = []
    for pick in (*PICKS, OURS):
        own = curve(rows, pick)
        if not own.empty:
            body.append((pick.words, *(own.get(n) for n in counts)))
    return Table(
        (
            Column("technique", stretch=1),
            *(Column(f"{n:,}", wording.number, numeric=True, over="ms, by number of tori") for n in counts),
        ),
        body,
        "toledo2007, Figure 6: frame time against the number of tori.",
        f"Tori on a cubic lattice, each turned at random, on {rows['device'].iloc[0]}; the paper prints no numbers. "
        "Where a cell is empty, its frame has more triangles than the config allows.",
    )


def _crossings(rows: pd.DataFrame) -> Table:
    """Make a line for each technique: from how many tori on Newton is faster than it."""
    newton, ours = curve(rows, picks.NEWTON_3), curve(rows, OURS)
    body = []
    for pick in PICKS[1:]:
        own = curve(rows, pick)
        both = own.index.intersection(newton.index)
        if both.empty:
            continue
        last = max(both)
        told = (_told(crossing(newton, own)), None if ours.empty else _told(crossing(ours, own)))
        body.append((pick.words, *told, last, own[last] / newton[last], CLAIMED[pick.words]))
    return Table(
        (
            Column("against"),
            Column("Newton 0.001 is faster from", stretch=1),
            Column("ours, forwards, is from", stretch=1),
            Column("tori, at most", wording.count, numeric=True),
            Column("time there over\nNewton 0.001's", wording.factor, numeric=True),
            Column("the paper", stretch=1),
        ),
        body,
        "toledo2007, Figure 6: where Newton 0.001 overtakes.",
        "Interpolated between the counts measured, on logarithmic axes.",
    )


def _told(at: float | None) -> str:
    """Write the number of tori that `crossing` returns."""
    if at is None:
        return "nowhere measured"
    return (
        "the first torus on"
        if at <= 1.0
        else f"about {np.format_float_positional(float(f'{at:.2g}'), trim='-')} tori on"
    )
