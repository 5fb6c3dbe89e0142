"""Make the first page: which method wins where, at which error, and what that costs."""

from __future__ import annotations

from collections import Counter

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, ties
from reports.analysis.scene_names import scene_names
from reports.claims import Outcome
from reports.content import Block, Code, Column, Section, Table, Text
from reports.drawing import choice, plots, style
from reports.material import Material
from reports.parts import hard_rays

OVERVIEW_SCENES = 8  # a run with more scenes has no figure on the first page


def section(material: Material) -> Section:
    """Make the first page."""
    run, frame, rungs = material.run, material.frame, material.rungs
    blocks: list[Block] = [] if frame.empty else [Text(_verdict(frame), strong=True)]
    blocks += [] if rungs.empty else [Text(hard_rays.verdict(rungs), strong=True)]
    told = _claims(material)
    blocks += [Text(told, strong=True)] if told else []
    table = choice.table(frame)
    blocks += [table] if table else []
    scenes = scene_names(frame)
    if table and len(scenes) <= OVERVIEW_SCENES:
        figure = plots.overview(frame, style.marks(frame["method"]), scenes)
        blocks += [figure] if figure else []
    elif table is None and not rungs.empty:
        blocks.append(hard_rays.summary_table(rungs, run.plan.facts))
    ended = pd.concat([frame["status"], run.families["status"]])
    blocks.append(statuses_table(ended, len(run.unreadable), len(run.not_run)))
    blocks.append(Code(run.plan.command))
    return Section("Summary", tuple(blocks))


def _claims(material: Material) -> str:
    """Count the papers' claims that hold and that do not; "" where the run decides less than a quarter of them."""
    outcomes = Counter(verdict.outcome for _, verdict in material.judged)
    decided = outcomes[Outcome.CONFIRMED] + outcomes[Outcome.REFUTED]
    if decided < len(material.judged) / 4:
        return ""
    return (
        f"Of {decided} claims of the papers that this run decides, {outcomes[Outcome.CONFIRMED]} hold here "
        f"and {outcomes[Outcome.REFUTED]} do not."
    )


def _verdict(frame: pd.DataFrame) -> str:
    """Say in a sentence or two which method is fastest where, if any is."""
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
    """Say how many times as fast as the baseline the winner is in the rows `won`, and how exact.

    Only rows count whose baseline is right too. "" where there are none, or where the winner is the baseline.
    """
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
    """Say below which time a row is floor-bound, with the floors of these rows."""
    floors = rows.loc[rows["floor_bound"].astype(bool), "floor_ms"]
    low, high = wording.number(floors.min()), wording.number(floors.max())
    span = f"{low} ms" if low == high else f"{low} to {high} ms"
    return f"{derive.FLOOR_FACTOR:g} times the harness's floor of {span}"


def statuses_table(ended: pd.Series, unreadable: int, not_run: int) -> Table:
    """Count the cells by how they ended: a column for each status that occurs, and always one for `ok`."""
    counts = {str(status): int((ended == status).sum()) for status in CellStatus}
    counts |= {"unreadable": unreadable, "not run yet": not_run}
    shown = {name: count for name, count in counts.items() if count or name == CellStatus.OK}
    cells = Column("cells", wording.count, numeric=True)
    columns = (cells, *(Column(name, wording.count, numeric=True) for name in shown))
    return Table(columns, [(sum(counts.values()), *shown.values())], "Cells by how they ended.")
