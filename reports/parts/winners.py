"""Tell who wins in every group of rows."""

from __future__ import annotations

from collections import Counter
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import derive, ties
from reports.analysis.scene_names import rays_checked, scene_names
from reports.content import Column, Section, Table, Text
from reports.drawing import tables
from reports.material import Material

ORDER = 10
ONE_BY_ONE = 20  # a run with more groups has a table that counts the winners too


def sections(material: Material) -> list[Section]:
    """Make the section; [] where no row was timed."""
    rows = derive.contenders(material.listed)
    if rows.empty:
        return []
    leading = ties.leaders(material.listed)
    several = len(rows.drop_duplicates(derive.GROUP)) > ONE_BY_ONE
    counted = (wins_table(leading),) if several and len(leading) else ()
    return [Section("Winners", (Text(f"{ties.RULE}."), *counted, winners_table(material.listed, leading)))]


def winners_table(frame: pd.DataFrame, leading: pd.DataFrame) -> Table:
    """Make a line for each group: its fastest variant, its fastest with every ray right, and what ties with the latter.

    `leading` is what ties.leaders returns.
    """
    rows = derive.contenders(frame)
    fastest = ties.fastest(frame)
    safest = {(r.comparison, r.device, r.precision): r for r in leading.itertuples()}
    body: list[tuple[Any, ...]] = []
    named = scene_names(frame)
    fastest = fastest.assign(planned=fastest["comparison"].map({name: i for i, name in enumerate(named)}))
    shown = fastest.sort_values(["planned", "precision", "device"], kind="stable").head(tables.ROW_LIMIT)
    for row in shown.itertuples():
        safe = safest.get((row.comparison, row.device, row.precision))
        instead = ("none", None, None) if safe is None else (safe.variant, safe.median_ms, ", ".join(safe.tied) or None)
        if safe is not None and safe.variant == row.variant:
            instead = ("the same", None, instead[2])
        values = (row.median_ms, row.speedup, row.error_max, row.wrong_rays)
        body.append((named[row.comparison], row.precision, row.device, row.variant, *values, *instead))
    columns: tuple[Column, ...] = (
        Column("surface", stretch=4),
        Column("precision"),
        Column("device"),
        Column("fastest variant", stretch=3),
        Column("ms", wording.number, numeric=True),
        Column("speed-\nup", wording.factor, numeric=True),
        Column("max\nerror", wording.error, numeric=True),
        Column("wrong\nrays", wording.count, numeric=True),
        Column("fastest with no wrong ray", stretch=3),
        Column("ms", wording.number, numeric=True),
        Column("not told\napart from", stretch=2),
    )
    note = " Where the columns after it name another variant, the fastest buys its speed with wrong answers."
    if all(row[-3] == "the same" for row in body):
        columns, body, note = columns[:-3] + columns[-1:], [row[:-3] + row[-1:] for row in body], ""
    note += wording.first_of(len(shown), len(fastest))
    return Table(
        columns,
        body,
        "What wins where.",
        f"{tables.speedup(rows)} Max error is the largest |t − t*| in scene units over rays away from silhouettes; "
        "wrong rays are misses, false hits, exhausted rays, wrong roots and invalid answers among them, of the "
        f"{rays_checked(shown)} rays of each scene's check. Not told apart: the "
        "fastest variants of other methods, with no wrong ray, whose times are not told to be longer than that of the "
        "fastest without one; of a method's own settings the fastest is by the median."
        + wording.zeros(shown["error_max"])
        + note,
        group=2,
    )


def wins_table(leading: pd.DataFrame) -> Table:
    """Make a line for each device and precision: how often each method is fastest there.

    `leading` is what ties.leaders returns.
    """
    body = []
    for (device, precision), rows in leading.groupby(["device", "precision"], sort=False):
        alone = rows[rows["tied"].map(len) == 0]
        counted = ", ".join(f"{method} {n}" for method, n in Counter(alone["method"]).most_common()) or "none"
        shared = len(rows) - len(alone)
        body.append((device, precision, len(rows), counted, shared, rows["speedup"].median(), rows["error_max"].max()))
    return Table(
        (
            Column("device"),
            Column("precision"),
            Column("scenes", wording.count, numeric=True),
            Column("fastest method, and on how many scenes", stretch=1),
            Column("not told\napart", wording.count, numeric=True),
            Column("median\nspeed-up", wording.factor, numeric=True),
            Column("worst\nmax error", wording.error, numeric=True),
        ),
        body,
        "Which method is fastest with no wrong ray, and how often.",
        "Scenes are those with a variant that has no wrong ray away from silhouettes; not told apart are those on "
        f"which the times of several methods are not. {tables.speedup(leading)} It and the largest |t − t*|, in scene "
        f"units, are of the fastest variants.{wording.zeros(leading['error_max'])}",
        group=1,
    )
