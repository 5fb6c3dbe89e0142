"""The first page, to stop after: which method wins where, at which error, and what that costs."""

from __future__ import annotations

from collections import Counter

import pandas as pd

from reports import stability, wording
from reports.analysis import derive, ties
from reports.claims import Outcome
from reports.content import Block, Code, Section, Text
from reports.drawing import choice, plots, style, tables
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
        f"Of {decided} claims of the papers that this run decides, {outcomes[Outcome.CONFIRMED]} hold here "
        f"and {outcomes[Outcome.REFUTED]} do not."
    )


def _verdict(frame: pd.DataFrame) -> str:
    """One sentence for who reads no further, or two: who leads, if anybody does."""
    rows = derive.contenders(frame)
    leading = ties.leaders(frame)
    if leading.empty:
        return "No variant was timed with every ray away from silhouettes answered rightly."
    contested = int((rows.groupby(derive.GROUP)["method"].nunique() > 1).sum())
    if not contested:
        return "Nothing is compared: no combination of surface, view, device and precision was timed by two methods."
    leading = leading[leading["methods"] > 1]
    alone = leading[leading["tied"].map(len) == 0]
    counted = alone["method"].value_counts()
    told = f"{wording.plural(contested, 'combination')} of surface, view, device and precision"
    shared, wrong = len(leading) - len(alone), contested - len(leading)
    rest = [f"the times of several methods are not told apart in {shared}"] if shared else []
    rest += [f"no variant answers every such ray rightly in {wrong}"] if wrong else []
    errors = alone.groupby("method")["error_max"].max()
    each = [
        f"{method} is fastest in {count} (largest error {wording.error(errors[method])} scene units)"
        for method, count in counted.items()
    ]
    if len(counted) and 2 * counted.iloc[0] > contested:
        rest = [*each[1:], *rest]
        first = str(counted.index[0])
        sentence = (
            f"Of the variants with no wrong ray away from silhouettes, {first} is fastest in {counted.iloc[0]} of "
            f"{told}{_gain(alone[alone['method'] == first])}."
        )
        return f"{sentence} Of the others, {wording.listed(rest)}." if rest else sentence
    return (
        "No method leads: of the variants with no wrong ray away from silhouettes, in "
        f"{told}, {wording.listed([*each, *rest])}."
    )


def _gain(won: pd.DataFrame) -> str:
    """Say how many times as fast as the baseline the winner is, where that is right too, and how exact it is."""
    baseline = derive.baseline_of(won)
    told = won[won["speedup"].notna()]
    over = told[~told["floor_bound"].astype(bool)]
    if len(told) and over.empty:
        return ", where every time is floor-bound: under " + _bound(told) + ", so that no gain is told"
    if over.empty or ((won["method"] == won["baseline"]) | (won["variant"] == won["baseline"])).any():
        return ""
    low, high = wording.factor(over["speedup"].min()), wording.factor(over["speedup"].max())
    gain = low if low == high else f"{low} to {high}"
    where = "there" if len(told) == len(won) else f"in the {len(told)} in which {baseline} has no such ray either"
    bound = len(told) - len(over)
    floor = f" ({bound} left out, whose times are floor-bound: under {_bound(told)})" if bound else ""
    most = wording.error(won["error_max"].max())
    return f": {gain} as fast as {baseline} {where}{floor}, with a largest error of {most} scene units"


def _bound(rows: pd.DataFrame) -> str:
    """Say what a floor-bound time is under, with the floors of these rows."""
    floors = rows.loc[rows["floor_bound"].astype(bool), "floor_ms"]
    low, high = wording.number(floors.min()), wording.number(floors.max())
    span = f"{low} ms" if low == high else f"{low} to {high} ms"
    return f"{derive.FLOOR_FACTOR:g} times the harness's floor of {span}"
