"""Say who is right, for the first page of a run that timed nothing."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive
from reports.content import Block, Column, Matrix, Square, Table, Text
from reports.drawing.shades import GOOD, WRONG

NAMED = 8  # variants that a sentence names
LINES, SURFACES = 24, 8  # that fit on the first page


def blocks(frame: pd.DataFrame) -> list[Block]:
    """Return a sentence on which variants answer every ray rightly, and a table of all; `frame` has a row or more."""
    rows = frame[derive.is_judged(frame) & frame["answers"].astype(bool)]
    if rows.empty:
        harness = frame[(frame["status"] == CellStatus.OK) & ~frame["answers"].astype(bool)]
        only = "This run has the harness alone: a method that answers nothing" if len(harness) else ""
        return [Text(f"{only or 'No cell of this run has a result that can be judged'}.", strong=True)]
    body = []
    for (label, precision), own in rows.groupby(["label", "precision"], sort=False):
        right = derive.all_right(own)
        wrong, worst = int(own["wrong_rays"].sum()), own["error_max"].max()
        surfaces = own["surface"].nunique()
        held = surfaces - own.loc[~right, "surface"].nunique()
        body.append((label, precision, held, surfaces, wrong, int(own["accuracy_rays"].sum()), worst))
    body.sort(key=lambda line: (line[4] / max(1, line[5]), line[6]))
    wrong_somewhere = {line[0] for line in body if line[4]}
    named = list(dict.fromkeys(_named(line, wrong_somewhere) for line in body if line[4] == 0))
    if not named:
        first = body[0]
        lead = f"No variant is right on every ray; {first[0]} has fewest wrong: {first[4]:,} of {first[5]:,}."
    elif not wrong_somewhere:
        lead = f"Every variant is right on every ray away from silhouettes: {wording.few(named, NAMED)}."
    else:
        lead = f"Right on every ray away from silhouettes: {wording.few(named, NAMED)}. The others answer some wrongly."
    told = "This run timed nothing. Answers are held, ray by ray, against first hits certified in ball arithmetic."
    columns = (
        Column("variant", stretch=1),
        Column("precision"),
        Column("surfaces\nall right", wording.count, numeric=True),
        Column("of", wording.count, numeric=True),
        Column("wrong\nrays", wording.count, numeric=True),
        Column("of", wording.count, numeric=True),
        Column("max\nerror", wording.error, numeric=True),
    )
    caption = "Rays that graze a silhouette or drown in f's rounding are not counted; max error is in scene units."
    zeros = wording.zeros([line[6] for line in body])
    shown = body[:LINES]
    table = Table(columns, shown, "Who is right.", f"{caption}{zeros}{wording.first_of(len(shown), len(body))}")
    return [Text(lead, strong=True), Text(told), *_matrix(rows), table]


def _named(line: tuple[Any, ...], wrong_somewhere: Set[str]) -> str:
    """Name the variant of a line, with its precision where it is wrong in another one."""
    label, precision, *_ = line
    return f"{label} in {precision}" if label in wrong_somewhere else str(label)


def _matrix(rows: pd.DataFrame) -> list[Block]:
    """Make a line for each variant and a square for each surface: right, or how many rays are wrong.

    [] where there are more than SURFACES surfaces or LINES variants, which a page has no room for.
    """
    titles = list(dict.fromkeys(rows["surface_title"]))
    labels = list(dict.fromkeys(rows["label"]))
    if len(titles) > SURFACES or len(labels) > LINES:
        return []
    by_place = {place: own for place, own in rows.groupby(["label", "surface_title"])}
    body = [(label, tuple(_square(by_place.get((label, title))) for title in titles)) for label in labels]
    key = {GOOD: "every ray right", WRONG: "some rays wrong"}
    told = "Wrong rays away from silhouettes, of all views, devices and precisions together; – does not apply."
    return [Matrix(tuple(titles), body, "Who is right where.", told, "variant", key)]


def _square(own: pd.DataFrame | None) -> Square:
    """Make the square of one variant on one surface."""
    if own is None:
        return Square(wording.NONE, note="does not apply or was not judged")
    wrong, rays = int(own["wrong_rays"].sum()), int(own["accuracy_rays"].sum())
    largest = f"largest error {wording.error(own['error_max'].max())} scene units"
    note = f"{wrong:,} wrong of {wording.plural(rays, 'ray')}, {largest}"
    return Square(f"{wrong:,} wrong" if wrong else "right", WRONG if wrong else GOOD, note)
