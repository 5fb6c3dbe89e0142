"""Make the first page: which method to take for which surface, what that costs, and what it risks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive
from reports.analysis.choices import Choice
from reports.claims import Outcome
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import choice, multiples, strip, who_is_right
from reports.material import Material
from reports.parts import hard_rays
from reports.sentences import answer

PANELS = 8  # surfaces with a picture and a plot; a run with more shows the most telling ones
PLOTS = {1: 3.4, 2: 3.2, 3: 2.9, 4: 3.8}  # height of so many plots, inches
PLOTS_LOW, PLOTS_HIGH = 3.2, 3.9  # of at most 6, and of more
PLOTTED = 6  # surfaces with a plot, of a run with more than PANELS
LESS = 0.35  # that plots are lower where there is a sentence more


def section(material: Material) -> Section:
    """Make the first page."""
    found = material.choices
    blocks: list[Block] = []
    if found:
        blocks += _timed(material, found)
    elif not material.frame.empty:
        blocks += who_is_right.blocks(material.frame)
    if not material.rungs.empty:
        blocks.append(Text(hard_rays.verdict(material.rungs), strong=True))
        if not found:
            blocks.append(hard_rays.summary_table(material.rungs, material.run.plan.facts))
    run = material.run
    cells = ended(pd.concat([material.frame["status"], run.families["status"]]), len(run.unreadable), len(run.not_run))
    again = f"To run it again: {run.plan.command}"  # nothing behind it, so that it can be copied
    blocks.append(Text(" ".join(filter(None, [_claims(material), cells, again]))))
    return Section("Summary", tuple(blocks))


def _timed(material: Material, found: Sequence[Choice]) -> list[Block]:
    """Make the page of a run that timed something: the answer, pictures, plots and a table."""
    several = material.frame["device"].nunique() > 1
    blocks: list[Block] = [Text(answer.lead(found), strong=True)]
    about = answer.focus(found, material.focus, material.focus_method) if material.focus else ""
    blocks += [Text(about, strong=True)] if about else []
    blocks.append(_facts(material, found))
    telling = found if len(found) <= PANELS else most_telling(found, PANELS)
    pictures = strip.strip(material.shelf, telling)
    blocks += [pictures] if pictures else []
    drawn = telling if len(found) <= PANELS else most_telling(telling, PLOTTED)
    height = PLOTS.get(len(drawn), PLOTS_LOW if len(drawn) <= PLOTTED else PLOTS_HIGH)
    height -= LESS * (bool(about) + (len(found) > PANELS))
    figure = multiples.figure(drawn, material.method_marks, height, material.focus_method)
    blocks += [figure] if figure else []
    scenes = int(material.listed.loc[derive.is_contender(material.listed), "comparison"].nunique())
    blocks.append(choice.made(telling, several, len(found), scenes))
    return blocks


def _facts(material: Material, found: Sequence[Choice]) -> Table:
    """Say beside each other how exact the answer is, what it risks, and what is faster but wrong."""
    fast = " ".join(filter(None, [answer.gain(found), answer.exact(found)]))
    told = (fast, answer.risk(found, material.run.plan.methods), answer.bought(found))
    titles = "How fast and how exact it is", "What it risks", "What is faster, but wrong"
    return Table(tuple(Column(title, stretch=1) for title in titles), [told], "")


def most_telling(found: Sequence[Choice], count: int) -> list[Choice]:
    """Return `count` of these choices, in their order, whose winners and degrees differ most.

    Each winner is shown once before one is shown twice; of equals, that compared by most methods and then that of the
    highest degree comes first.
    """
    by_winner: dict[str, list[Choice]] = {}
    for one in sorted(found, key=lambda one: (-one.rows["method"].nunique(), -_degree(one))):
        by_winner.setdefault(str(one.best.method) if one.best is not None else "", []).append(one)
    queues = sorted(by_winner.values(), key=len, reverse=True)
    taken: list[Choice] = []
    while len(taken) < min(count, len(found)):
        for queue in queues:
            if queue and len(taken) < count:
                taken.append(queue.pop(0))
    return [one for one in found if any(one is other for other in taken)]


def _degree(one: Choice) -> int:
    """Return the degree of a surface; 0 for one that is not algebraic."""
    degree = one.rows["degree"].iloc[0]
    return 0 if wording.absent(degree) else int(degree)


def _claims(material: Material) -> str:
    """Count the papers' claims that are confirmed and refuted; "" where the run decides less than a quarter of them."""
    outcomes = Counter(verdict.outcome for _, verdict in material.judged)
    decided = outcomes[Outcome.CONFIRMED] + outcomes[Outcome.REFUTED]
    if decided < len(material.judged) / 4:
        return ""
    return (
        f"Of {decided} claims of the papers that this run decides, {outcomes[Outcome.CONFIRMED]} are confirmed "
        f"and {outcomes[Outcome.REFUTED]} refuted."
    )


def ended(statuses: pd.Series, unreadable: int, not_run: int) -> str:
    """Say in a sentence how the cells of the run ended: each status that occurs, and always `ok`."""
    counts = {str(status): int((statuses == status).sum()) for status in CellStatus}
    counts |= {"unreadable": unreadable, "not run yet": not_run}
    told = [f"{count:,} {name}" for name, count in counts.items() if count or name == CellStatus.OK]
    return f"{wording.plural(sum(counts.values()), 'cell')}: {wording.listed(told)}."
