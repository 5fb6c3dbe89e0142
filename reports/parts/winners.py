"""Tell who wins in every group of rows, what beating the winner costs, and how much other devices take."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

import pandas as pd

from reports import wording
from reports.analysis import derive, ties
from reports.analysis.scene_names import rays_checked, scene_names
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import shades, standings, style, tables, trades_tables
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 10
ONE_BY_ONE = 20  # a run with more groups has a table that counts the winners too
FEW = 2  # surfaces, up to which the page has the table of winners too
LINES = 30  # scenes of the matrix that is printed, and surfaces with trade-offs; details have all
TWO_LINES = 12  # a matrix of so many scenes has room for two lines a square
COLUMNS = 6  # devices and precisions that a page is wide enough for
Listed = TypeVar("Listed", Matrix, Table)
PALE = 0.68  # how far the colour of a square is from its method's, towards white
_SPEEDUP = Column("speed-\nup", wording.factor, numeric=True)


def sections(material: Material) -> list[Section]:
    """Make the section; [] where no row was timed."""
    timed = derive.is_contender(material.listed)
    if not timed.any():
        return []
    leading = ties.leaders(material.listed)
    found = material.choices
    whole = matrix(material, leading)
    each = standings.matrix(found, material.focus_method) if len(found) <= standings.MOST else None
    one_each = {str(one.rows["comparison"].iloc[0]): one.name for one in found}
    many = len(whole.rows) > LINES
    printed = matrix(material, leading, one_each) if many else whole
    blocks: list[Block] = [Text(_seen(leading[leading["comparison"].isin(list(one_each))] if many else leading))]
    blocks += [_cut(printed, LINES)] if each is None or len(printed.columns) > 1 else []
    blocks += [each] if each is not None else []
    details: list[Block] = [] if len(whole.rows) <= LINES else [whole]
    trades = trades_tables.trades(found)
    if trades is not None:
        blocks.append(_cut(trades, LINES // 2))
        details += [trades] if len(trades.rows) > LINES // 2 else []
    if len(found) <= FEW:  # the page has room for more
        blocks.append(winners_table(material.listed, leading))
    elsewhere = trades_tables.devices(material.listed)
    blocks += [elsewhere] if elsewhere is not None else []
    several = len(material.listed.loc[timed, derive.GROUP].drop_duplicates()) > ONE_BY_ONE
    if several and len(leading):
        details.append(wins_table(leading))
    details += [Text(f"{ties.RULE}."), *([winners_table(material.listed, leading)] if len(found) > FEW else [])]
    return [Section("Winners", tuple(blocks), tuple(details), not material.focus)]


def _seen(leading: pd.DataFrame) -> str:
    """Say what to see in the matrix; `leading` is what ties.leaders returns."""
    if leading.empty:
        return (
            "No variant answers every ray away from silhouettes rightly: the matrix names the fastest of those timed."
        )
    alone = leading[leading["tied"].map(len) == 0]
    counted = Counter(alone["method_label"]).most_common(3)
    most = [f"{label} on {count}" for label, count in counted]
    shared = len(leading) - len(alone)
    rest = f"; on {shared} the times of several methods are not told apart (≈)" if shared else ""
    won = f"fastest, whatever their error, are {wording.listed(most)}" if most else "no method is fastest alone"
    several = len(leading.drop_duplicates(["device", "precision"])) > 1
    what = "surface" if leading["comparison"].nunique() == leading["surface"].nunique() else "scene"
    cells = wording.plural(len(leading), "combination") + f" of {what}, device and precision" * several
    cells = cells if several else wording.plural(len(leading), what)
    return f"Of {cells} on which some variant answers every ray away from silhouettes rightly, {won}{rest}."


def matrix(material: Material, leading: pd.DataFrame, scenes_of: Mapping[str, str] | None = None) -> Matrix:
    """Make a square for each scene, device and precision: the fastest method with every ray right, and its time.

    `leading` is what ties.leaders returns. `scenes_of` has the names of the scenes to show, None for all. A group in
    which every variant is wrong somewhere has a grey square.
    """
    frame = material.listed
    told = [*derive.GROUP, "method", "variant", "label", "wrong_rays", "accuracy_rays"]
    rows = derive.contenders(frame, told)
    if scenes_of is not None:
        rows = rows[rows["comparison"].isin(list(scenes_of))]
    named, safest = (
        scenes_of or scene_names(frame),
        {(r.comparison, r.device, r.precision): r for r in tuples(leading)},
    )
    groups = {key: own for key, own in rows.groupby(derive.GROUP)}
    timed = set(rows["comparison"])
    scenes = [name for name in named if name in timed]
    pairs = list(dict.fromkeys(zip(rows["device"], rows["precision"], strict=True)))
    pairs.sort(key=lambda pair: -int(((rows["device"] == pair[0]) & (rows["precision"] == pair[1])).sum()))
    pairs, cut = pairs[:COLUMNS], len(pairs) - COLUMNS
    several = len({precision for _, precision in pairs}) > 1
    labels = dict(zip(rows["variant"], rows["label"], strict=True))
    apart = "\n" if len(scenes) <= TWO_LINES else " "
    body = []
    for scene in scenes:
        squares = []
        for device, precision in pairs:
            own, won = groups.get((scene, device, precision)), safest.get((scene, device, precision))
            squares.append(_square(own, won, material, labels, apart))
        body.append((named[scene], tuple(squares)))
    methods = rows.groupby(["device", "precision"])["method"].nunique()
    most = methods.max()
    fewer = {pair: f"\n{methods[pair]} of {most} methods" for pair in pairs if methods[pair] < most}
    columns = tuple(
        (f"{device}\n{precision}" if several else device) + fewer.get((device, precision), "")
        for device, precision in pairs
    )
    one = "" if several else f" All in {pairs[0][1]}."
    more = f" {cut} more devices and precisions are in the details." if cut > 0 else ""
    return Matrix(
        columns,
        body,
        "The fastest method with no wrong ray, whatever its error, and its ms.",
        f"≈: not told apart from others. Grey: every variant timed there is wrong on some ray.{one}{more}",
        "surface",
    )


def _square(own: pd.DataFrame | None, won: Any, material: Material, labels: dict[str, str], apart: str) -> Square:
    """Make the square of one group: its rows, fastest first, and the one that wins."""
    if own is None:
        return Square(wording.NONE, note="not timed")
    if won is None:
        fewest = next(tuples(own.sort_values("wrong_rays", kind="stable")))
        if wording.absent(fewest.wrong_rays):
            return shades.silent("not judged", "no answers were checked")
        told = f"{fewest.label}: {int(fewest.wrong_rays):,} wrong rays of {wording.count(fewest.accuracy_rays)}"
        return shades.silent("all wrong\nsomewhere" if apart == "\n" else "all wrong", f"fewest: {told}")
    tied = [labels[variant] for variant in won.tied]
    sign = "≈ " if tied else ""
    note = f"{won.label}, largest error {wording.error(won.error_max)} scene units"
    note += f"; not told apart from {wording.listed(tied)}" if tied else ""
    note += "; floor-bound: mostly the harness's own time" if won.floor_bound else ""
    color = style.pale(material.method_marks[str(won.method)].color, PALE)
    text = f"{sign}{won.method_label}{apart}{wording.number(won.median_ms)}"
    focused = material.focus != "" and str(won.method) == material.focus_method
    return Square(text, color, note, strong=focused)


def _cut(whole: Listed, lines: int) -> Listed:
    """Return the first lines of a matrix or a table, which says so."""
    if len(whole.rows) <= lines:
        return whole
    caption = f"{whole.caption} The first {lines} of {len(whole.rows)}; the appendix and the HTML page have all."
    return replace(whole, rows=whole.rows[:lines], caption=caption)


def winners_table(frame: pd.DataFrame, leading: pd.DataFrame) -> Table:
    """Make a line for each group: its fastest variant, its fastest with every ray right, and what ties with the latter.

    `leading` is what ties.leaders returns.
    """
    rows = derive.contenders(frame, ["variant", "label", "method", "method_label", "baseline"])
    fastest = ties.fastest(frame)
    safest = {(r.comparison, r.device, r.precision): r for r in tuples(leading)}
    body: list[tuple[Any, ...]] = []
    named, labels = scene_names(frame), dict(zip(rows["variant"], rows["label"], strict=True))
    fastest = fastest.assign(planned=fastest["comparison"].map({name: i for i, name in enumerate(named)}))
    shown = fastest.sort_values(["planned", "precision", "device"], kind="stable").head(tables.ROW_LIMIT)
    for row in tuples(shown):
        safe = safest.get((row.comparison, row.device, row.precision))
        instead = ("none", None, None) if safe is None else (safe.label, safe.median_ms, _tied(safe, labels))
        if safe is not None and safe.variant == row.variant:
            instead = ("the same", None, instead[2])
        values = (row.median_ms, row.speedup, row.error_max, row.wrong_rays)
        body.append((named[row.comparison], row.precision, row.device, row.label, *values, *instead))
    columns: tuple[Column, ...] = (
        Column("surface", stretch=4),
        Column("precision"),
        Column("device"),
        Column("fastest variant", stretch=3),
        Column("ms", wording.number, numeric=True),
        _SPEEDUP,
        Column("max\nerror", wording.error, numeric=True),
        Column("wrong\nrays", wording.count, numeric=True),
        Column("fastest with no wrong ray", stretch=3),
        Column("ms", wording.number, numeric=True),
        Column("not told\napart from", stretch=2),
    )
    note = " Where the columns after it name another variant, the fastest buys its speed with wrong answers."
    if all(row[-3] == "the same" for row in body):
        columns, body, note = columns[:-3] + columns[-1:], [row[:-3] + row[-1:] for row in body], ""
    over, at = f"{tables.speedup(rows)} ", columns.index(_SPEEDUP)
    if all(wording.absent(row[at]) for row in body):  # the baseline is not among them
        columns, body, over = columns[:at] + columns[at + 1 :], [row[:at] + row[at + 1 :] for row in body], ""
    note += wording.first_of(len(shown), len(fastest))
    return Table(
        columns,
        body,
        "What wins where.",
        f"{over}Max error is the largest |t − t*| in scene units over rays away from silhouettes; "
        "wrong rays are misses, false hits, exhausted rays, wrong roots and invalid answers among them, of the "
        f"{rays_checked(shown)} rays of each scene's check. Not told apart: the "
        "fastest variants of other methods, with no wrong ray, whose times are not told to be longer than that of the "
        "fastest without one; of a method's own settings the fastest is by the median."
        + wording.zeros(shown["error_max"])
        + note,
        group=2,
    )


def _tied(row: Any, labels: dict[str, str]) -> str | None:
    """Name the variants whose times are not told apart from a row's; None where there are none."""
    return "; ".join(labels[variant] for variant in row.tied) or None


def wins_table(leading: pd.DataFrame) -> Table:
    """Make a line for each device and precision: how often each method is fastest there.

    `leading` is what ties.leaders returns.
    """
    body = []
    for (device, precision), rows in leading.groupby(["device", "precision"], sort=False):
        alone = rows[rows["tied"].map(len) == 0]
        counted = ", ".join(f"{method} {n}" for method, n in Counter(alone["method_label"]).most_common()) or "none"
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
