"""Compare variants round by round: each one's time over that of the fastest variant with every ray right."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd

from harness.results.timings import Ratio
from reports import wording
from reports.analysis import derive, rounds, ties
from reports.analysis.scene_names import scene_names, scene_title
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import shades, standings, tables
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 32
TITLE = "Variants compared round by round"
MOST_SCENES = 30  # of the matrix
TOP = 100.0  # the factor that has the brightest colour
EVEN, NOT_PAIRED = "even", "–"
READ = (
    "How many times the time of the fastest variant with every ray right each method takes, by the rounds that timed "
    "both: dark squares are as good as the fastest, and each step brighter is more time."
)
_NEEDED = [
    *("comparison", "device", "precision", "key", "method", "variant", "wrong_rays", *ties.COLUMNS),
    *("label", "method_label", "surface", "surface_title", "view", "size", "samples_per_pixel", "stage", "run"),
]


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless two variants or more of one comparison were timed in the same rounds."""
    frame = material.listed
    others = [name for name in tables.CHOSEN_BY if name not in _NEEDED]
    rows = tables.worth_printing(derive.contenders(frame, [*_NEEDED, *others]))[_NEEDED]
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
    matrix = _matrix(frame)
    if not tabled or matrix is None:
        return []
    seen: tuple[Block, ...] = (Text(f"{READ} {_said(matrix)}"), matrix)
    rest: tuple[Block, ...] = (Text(told), *tabled)
    if len(material.choices) <= standings.MOST:  # the winners' page has every method's standing already
        return [Section(TITLE, (), (*seen, *rest), name="Comparisons")]
    return [Section(TITLE, seen, rest, name="Comparisons")]


def _matrix(frame: pd.DataFrame) -> Matrix | None:
    """Make a line for each scene and a column for each method, of the device with most rows and its first precision.

    The methods that are fastest in most scenes are on the left. None where no scene has a pair of methods.
    """
    rows = derive.contenders(frame, _NEEDED)
    if rows.empty:
        return None
    rows = derive.on_fullest_device(rows)
    rows = rows[rows["precision"] == rows["precision"].iloc[0]]
    by_scene = {scene: own for scene, own in rows.groupby("comparison", sort=False) if own["method"].nunique() > 1}
    scenes = [scene for scene in dict.fromkeys(frame["comparison"]) if scene in by_scene][:MOST_SCENES]
    squares = {scene: found for scene in scenes if (found := _squares(by_scene[scene]))}
    if not squares:
        return None
    names = scene_names(rows)
    ranks = {method: sum(of[method][0] for of in squares.values() if method in of) for method in rows["method"]}
    seen = {method: sum(method in of for of in squares.values()) for method in ranks}
    methods = sorted((m for m in ranks if seen[m]), key=lambda m: ranks[m] / seen[m])
    titles = dict(zip(rows["method"], rows["method_label"], strict=True))
    body = [
        (names[str(scene)], tuple(of[m][1] if m in of else shades.silent("", "not timed") for m in methods))
        for scene, of in squares.items()
    ]
    return Matrix(
        tuple(titles[m] for m in methods),
        body,
        f"Times over the fastest, {rows['precision'].iloc[0]} on {rows['device'].iloc[0]}.",
        "Of each method its fastest variant with every ray right, else its fastest, with the wrong rays. “Even”: the "
        f"rounds do not tell it from the fastest; “?”: fewer than {ties.NEEDED} rounds timed both; "
        "empty: the method refuses the scene, or was not timed." + wording.first_of(len(body), len(by_scene)),
        "scene",
        shades.key({0.0: "the fastest", 0.5: f"{TOP**0.5:g}×", 1.0: f"{TOP:g}× and more"}),
    )


def _squares(rows: pd.DataFrame) -> dict[str, tuple[float, Square]]:
    """Return how bad each method is, 0 to 2, and its square, for the rows of one scene, fastest first.

    Empty where no row answers every ray rightly.
    """
    right = rows[derive.all_right(rows)]
    if right.empty:
        return {}
    best = ties.best(right)
    found: dict[str, tuple[float, Square]] = {}
    for method, own in rows.groupby("method", sort=False):
        sound = own[derive.all_right(own)]
        row = next(tuples((sound if len(sound) else own).head(1)))
        if row.method == best.method:
            row = next(tuples(own[own["key"] == best.key]))
        found[str(method)] = _square(row, best, sound=len(sound) > 0)
    return found


def _square(row: Any, best: Any, *, sound: bool) -> tuple[float, Square]:
    """Return how bad a row is beside the fastest, 0 to 2, and its square."""
    if row.key == best.key:
        told = f"{wording.number(row.median_ms)} ms"
        return 0.0, Square(told, shades.shade(0.0), f"{row.label}: the fastest with every ray right", strong=True)
    ratio = rounds.ratio(row, best)
    if not sound:
        wrong = f"{wording.count(row.wrong_rays)} wrong"
        told = wrong if ratio is None else f"{_short(ratio.median)}, {wrong}"
        return 2.0, shades.silent(told, f"{row.label}: {wording.number(row.median_ms)} ms, {wrong} rays")
    if ratio is None:
        return 1.0, shades.silent(NOT_PAIRED, f"{row.label}: no round timed it and the fastest")
    badness = min(max(math.log(ratio.median) / math.log(TOP), 0.0), 1.0)
    interval = f", 95 % {wording.factor(ratio.lower)} to {wording.factor(ratio.upper)}" if ratio.proved else ""
    outcome = ties.verdict(ratio)
    note = f"{row.label}: {wording.factor(ratio.median)}{interval}; {outcome}"
    if outcome in (ties.ALIKE, ties.TORN):
        return badness, Square(EVEN, shades.shade(0.0), note)
    text = _short(ratio.median) + (" ?" if ratio.pairs < ties.NEEDED else "")
    return badness, Square(text, shades.shade(badness), note)


def _short(factor: float) -> str:
    """Write a factor for a narrow square: 1.07×, 12×, 1,234×."""
    return f"{factor:.2f}×" if factor < 9.995 else f"{factor:,.0f}×"


def _said(matrix: Matrix) -> str:
    """Say in how many scenes the fastest method is proved to be alone, and where it is not."""
    even = [heading for heading, squares in matrix.rows if any(square.text == EVEN for square in squares)]
    unknown = [
        heading
        for heading, squares in matrix.rows
        if heading not in even and any(square.text.endswith(" ?") or square.text == NOT_PAIRED for square in squares)
    ]
    alone = len(matrix.rows) - len(even) - len(unknown)
    rest = f"; in {len(unknown)} too few rounds timed it and another method to tell" if unknown else ""
    told = f"In {alone} of {wording.plural(len(matrix.rows), 'scene')} one method leads alone{rest}"
    named = wording.listed(even[:3]) if len(even) <= 3 else f"{', '.join(even[:3])} and {len(even) - 3} more"
    return f"{told}; the first are not told apart on {named}." if even else f"{told}."


def _table(rows: pd.DataFrame) -> Table | None:
    """Make the table of one scene; None where nothing was timed beside the fastest right variant."""
    body = []
    for (device, precision), group in rows.groupby(["device", "precision"], sort=True):
        right = group[derive.all_right(group)]
        if right.empty:
            continue
        best = ties.best(right)
        labels, sound_keys = dict(zip(group["key"], group["label"], strict=True)), set(right["key"])
        for row in tuples(group):
            if row.key != best.key and (ratio := rounds.ratio(row, best)):
                sound = row.key in sound_keys
                figures = _figures(ratio) if sound else (None, None, None, None, ratio.pairs)
                told = ties.verdict(ratio) if sound else f"{wording.count(row.wrong_rays)} wrong rays: not compared"
                body.append((device, precision, labels[best.key], row.label, *figures, told))
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
