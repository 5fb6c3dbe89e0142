"""The page of the method or variant that a report is about: where it wins, ties and loses, and to what."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from reports import wording
from reports.analysis import derive, rounds, ties
from reports.analysis.choices import ERRORS, Choice
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import standings
from reports.material import Material
from reports.reading.tuples import tuples
from reports.sentences import answer

ORDER = 2
LEADS = True
ACROSS = 9  # other methods that are columns of a page; those that are compared on most surfaces
LINES = 26  # surfaces on the page; details have all


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the report is about no method, or where that was not timed."""
    found = material.choices if material.focus else []
    own = [one for one in found if standings.taken(one, material.focus) is not None]
    if not own:
        return []
    first = standings.taken(own[0], material.focus)
    label = str(first.method_label if material.focus == material.focus_method else first.label)
    others = _others(own, material)
    blocks: list[Block] = [Text(answer.focus(found, material.focus, material.focus_method))]
    details: list[Block] = []
    whole = table(own, material.focus, label)
    if others:
        blocks.append(standings.against(own[:LINES], material.focus, others[:ACROSS]))
        if len(own) > LINES or len(others) > ACROSS:
            details.append(standings.against(own, material.focus, others))
    if len(own) > LINES:
        details.append(whole)
        more = f" The first {LINES} of {len(own)} surfaces; the appendix and the HTML page have all."
        whole = Table(whole.columns, whole.rows[:LINES], whole.title, whole.caption + more)
    blocks.append(whole)
    return [Section(f"{label} against the others", tuple(blocks), tuple(details), True, label)]


def _others(own: Sequence[Choice], material: Material) -> list[str]:
    """Return the other methods, those compared on most surfaces first; with a variant, its method's own default too."""
    counted: dict[str, int] = {}
    for one in own:
        for method in dict.fromkeys(one.rows.sort_index()["method"]):
            if method != material.focus_method:
                counted[str(method)] = counted.get(str(method), 0) + 1
    return sorted(counted, key=lambda method: -counted[method])


def table(own: Sequence[Choice], focus: str, label: str) -> Table:
    """Make a line for each surface: the focus beside the baseline, and what beats it."""
    baseline = derive.baseline_of(own[0].rows)
    labels = {str(v): str(lab) for one in own for v, lab in zip(one.rows["variant"], one.rows["label"], strict=True)}
    labels |= {
        str(m): str(lab) for one in own for m, lab in zip(one.rows["method"], one.rows["method_label"], strict=True)
    }
    named = labels.get(baseline, baseline)
    body = [_line(one, focus, baseline) for one in own]
    columns = (
        Column("surface", stretch=2),
        Column("ms", wording.number, numeric=True, over=label),
        Column("error", wording.error, numeric=True, over=label),
        Column("wrong\nrays", wording.count, numeric=True, over=label),
        Column("ms", wording.number, numeric=True, over=named),
        Column("error", wording.error, numeric=True, over=named),
        Column("wrong\nrays", wording.count, numeric=True, over=named),
        Column("speed-\nup", wording.factor, numeric=True),
        Column("what beats it, and by how much", stretch=3),
    )
    return Table(
        columns,
        body,
        f"{label} beside {named}, and what beats it.",
        f"Of each the fastest setting with no wrong ray, within {wording.level(ERRORS[0])} of the radius if it has "
        "one, else that with fewest. Error is the largest over the scene's radius. Speed-up is "
        f"{named}'s time over its own, in the rounds that timed both, where both are right. What "
        "beats it is right on every ray away from silhouettes and proved faster."
        + wording.zeros([line[2] for line in body], [line[5] for line in body]),
    )


def _right(one: Choice) -> str:
    """Say of a surface on which the focus is wrong who is right there."""
    return "none is right" if one.best is None else f"right is {answer.inline(one.best, one.rows)}"


def _line(one: Choice, focus: str, baseline: str) -> tuple[Any, ...]:
    """Make the line of one surface."""
    own, base = standings.taken(one, focus), standings.taken(one, baseline)
    cells: list[Any] = [one.name]
    for row in (own, base):
        cells += [None] * 3 if row is None else [row.median_ms, row.relative_error_max, row.wrong_rays]
    both = base is not None and own.wrong_rays == 0 and base.wrong_rays == 0
    cells.append(rounds.times_over(base, own) if both else None)
    right, exact = one.rows[derive.all_right(one.rows)], derive.within(one.rows, ERRORS[0])
    faster = exact if own.Index in exact.index else right  # what is less exact does not beat it
    faster = faster[faster["method"] != own.method]
    fastest = tuples(faster.drop_duplicates("method"))
    beating = [(row, rounds.times_over(own, row)) for row in fastest if ties.is_slower(own, row)]
    told = [
        f"{answer.inline(row)} {'' if wording.absent(times) else wording.factor(times)}".strip()
        for row, times in beating[:3]
    ]
    rest = [f"{len(beating) - 3} more"] if len(beating) > 3 else []
    cells.append(wording.listed([*told, *rest]) or ("nothing" if own.wrong_rays == 0 else _right(one)))
    return tuple(cells)
