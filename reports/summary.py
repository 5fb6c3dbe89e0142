"""The first page, to stop after: which method wins where, at which error, and what that costs."""

from __future__ import annotations

from collections import Counter

import pandas as pd

from reports import choice, derive, plots, stability, style, tables, wording
from reports.claims import Outcome
from reports.content import Block, Code, Section, Text
from reports.material import Material

OVERVIEW_SCENES = 8  # scenes that fit into its figure beside the table


def section(material: Material) -> Section:
    run, frame, rungs = material.run, material.frame, material.rungs
    blocks: list[Block] = [] if frame.empty else [Text(_verdict(frame), strong=True)]
    blocks += [] if rungs.empty else [Text(stability.verdict(rungs), strong=True)]
    told = _claims(material)
    blocks += [Text(told, strong=True)] if told else []
    table = choice.table(frame)
    blocks += [table] if table else []
    scenes = tables.places(frame)
    if table and len(scenes) <= OVERVIEW_SCENES:
        figure = plots.overview(frame, style.marks(frame["method"]), scenes)
        blocks += [figure] if figure else []
    elif table is None and not rungs.empty:
        blocks.append(stability.summary(rungs, run.plan.facts))
    ended = pd.concat([frame["status"], run.families["status"]])
    blocks.append(tables.statuses(ended, len(run.unreadable), len(run.not_run)))
    blocks.append(Code(run.plan.command))
    return Section("Summary", tuple(blocks))


def _claims(material: Material) -> str:
    """How the papers' claims fare; empty where the run decides few."""
    outcomes = Counter(verdict.outcome for _, verdict in material.judged)
    decided = outcomes[Outcome.CONFIRMED] + outcomes[Outcome.REFUTED]
    if decided < len(material.judged) / 4:
        return ""
    return (
        f"Of {decided} claims of the papers that this run decides, {outcomes[Outcome.CONFIRMED]} hold on this device "
        f"and {outcomes[Outcome.REFUTED]} do not."
    )


def _verdict(frame: pd.DataFrame) -> str:
    """One sentence for who reads no further."""
    rows = derive.contenders(frame)
    right = rows[derive.all_right(rows)].drop_duplicates(derive.GROUP)
    if right.empty:
        return "No variant was timed with every ray away from silhouettes answered rightly."
    total = int(rows.groupby(derive.GROUP).ngroups)
    counted = right["method"].value_counts()
    method = str(counted.index[0])
    won = right[right["method"] == method]
    sentence = (
        f"Of the variants with no wrong ray away from silhouettes, {method} is fastest in {counted.iloc[0]} of "
        f"{wording.plural(total, 'combination')} of surface, view, device and precision"
    )
    gains = won["speedup"].dropna()
    if method == derive.BASELINE or gains.empty:
        return f"{sentence}."
    low, high, error = wording.factor(gains.min()), wording.factor(gains.max()), wording.error(won["error_max"].max())
    gain = low if low == high else f"{low} to {high}"
    return f"{sentence}: {gain} as fast as {derive.BASELINE}, with a largest error of {error}."
