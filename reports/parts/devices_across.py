"""Hold devices against each other: speed-ups, orders of variants that change, and answers that differ."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import across, derive
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import across as drawn
from reports.drawing import shades, tables
from reports.material import Material

ORDER = 31
COLUMNS = 6  # devices that a page is wide enough for
LINES = 24  # variants of the matrix that is printed
SHOWN = 8  # swaps and answers that differ, of the page; details have all


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless two devices or more have a speed-up or an answer of the same variant and scene."""
    frame = material.listed
    if frame["device"].nunique() < 2:
        return []
    rows, answered = across.comparable(frame), across.answers(frame)
    devices = across.devices_of(rows)
    means = across.mean_speedups(rows) if len(devices) > 1 else {}
    if not means and answered.empty:
        return []
    blocks: list[Block] = []
    details: list[Block] = []
    if means:
        shown = devices[:COLUMNS]
        swaps = across.swaps(rows, shown)
        blocks.append(Text(_said(swaps, rows)))
        matrix = _matrix(means, shown, rows)
        blocks.append(_cut(matrix))
        picture = drawn.figure(across.fastest_of_methods(rows), shown, _telling(frame, rows), material.method_marks)
        blocks += [picture] if picture else []
        if swaps:
            blocks.append(_swapped(swaps[:SHOWN], len(swaps)))
        details += [matrix] if len(matrix.rows) > LINES else []
        details += [_swapped(swaps[: tables.ROW_LIMIT], len(swaps))] if len(swaps) > SHOWN else []
    if not answered.empty:
        differing = across.differing(answered)
        blocks.append(Text(_answers_said(answered, differing)))
        if len(differing):
            named, order = scene_names(frame), list(dict.fromkeys([*devices, *across.devices_of(frame)]))
            blocks.append(_differing(differing.head(SHOWN), named, order, len(differing)))
            if len(differing) > SHOWN:
                details.append(_differing(differing.head(tables.ROW_LIMIT), named, order, len(differing)))
    return [Section("Devices against each other", tuple(blocks), tuple(details), name="Across devices")]


def _said(swaps: Sequence[across.Swap], rows: pd.DataFrame) -> str:
    """Say what to see: whether the choice of a method depends on the device."""
    over = derive.baseline_of(rows)
    told = f"Speed-ups are over {over} on the same device, so that devices of different machines can be compared. "
    if not swaps:
        return (
            f"{told}No two variants change their order between devices by more than {across.CLEAR - 1:.0%} both ways."
        )
    one = swaps[0]
    pairs = f"{wording.plural(len(swaps), 'pair')} of variants {'changes' if len(swaps) == 1 else 'change'} order"
    return (
        f"{told}{pairs} between devices: on {one.device}, {one.first} is {wording.factor(one.here)} as fast as "
        f"{one.second}, and on {one.other} {wording.factor(one.there)}."
    )


def _matrix(means: dict[str, dict[str, tuple[float, int]]], devices: Sequence[str], rows: pd.DataFrame) -> Matrix:
    """Make a line for each variant and a column for each device, the variant that is fastest in the mean first."""
    logs = [math.log(mean) for own in means.values() for mean, _ in own.values()]
    low, high = min(logs), max(max(logs), min(logs) + 1e-9)
    order = sorted(means, key=lambda label: -sum(math.log(m) for m, _ in means[label].values()) / len(means[label]))
    ranks = {device: _ranks(means, device) for device in devices}

    def square(label: str, device: str) -> Square:
        if device not in means[label]:
            return shades.silent(wording.NONE, "wrong, or not timed in the rounds of the baseline")
        mean, scenes = means[label][device]
        rank = f"number {ranks[device][label]} of {len(ranks[device])}, mean of {wording.plural(scenes, 'scene')}"
        first = ranks[device][label] == 1
        return Square(wording.factor(mean), shades.shade((high - math.log(mean)) / (high - low)), rank, first)

    key = {0.0: wording.factor(math.exp(high)), 1.0: wording.factor(math.exp(low))}
    return Matrix(
        tuple(devices),
        [(label, tuple(square(label, device) for device in devices)) for label in order],
        f"Speed-up over {derive.baseline_of(rows)}, {rows['precision'].iloc[0]}.",
        "The geometric mean over the scenes that all devices of the line answered rightly; lines may be of different "
        "scenes. Bold is the fastest of a device.",
        "method",
        shades.key(key),
    )


def _ranks(means: dict[str, dict[str, tuple[float, int]]], device: str) -> dict[str, int]:
    """Return the place of each variant on a device, 1 for the fastest."""
    there = sorted((label for label in means if device in means[label]), key=lambda label: -means[label][device][0])
    return {label: place for place, label in enumerate(there, 1)}


def _cut(matrix: Matrix) -> Matrix:
    """Return a matrix with as many lines as a page has room for."""
    if len(matrix.rows) <= LINES:
        return matrix
    caption = f"{matrix.caption} The details have all {len(matrix.rows)} lines."
    return Matrix(matrix.columns, matrix.rows[:LINES], matrix.title, caption, matrix.corner, matrix.key)


def _telling(frame: pd.DataFrame, rows: pd.DataFrame) -> dict[str, str]:
    """Return the names of the scenes, those first that most methods and devices have."""
    counts = rows.groupby("comparison", sort=False)[["device", "method"]].nunique()
    order = counts.sort_values(["device", "method"], ascending=False, kind="stable").index
    named = scene_names(frame)
    return {str(scene): named[str(scene)] for scene in order}


def _swapped(swaps: Sequence[across.Swap], total: int) -> Table:
    """Make a line for each pair of variants that changes its order."""
    body = [(one.first, one.second, one.device, one.here, one.other, one.there, one.scenes) for one in swaps]
    columns = (
        Column("variant", stretch=1),
        Column("against", stretch=1),
        Column("device", over="faster on"),
        Column("times as fast", wording.factor, numeric=True, over="faster on"),
        Column("device", over="slower on"),
        Column("times as fast", wording.factor, numeric=True, over="slower on"),
        Column("scenes", wording.count, numeric=True),
    )
    told = "Ratios of speed-ups, in the geometric mean over the scenes that both devices have for both variants."
    told += wording.first_of(len(body), total)
    return Table(columns, body, "Orders that change between devices.", told)


def _answers_said(answered: pd.DataFrame, differing: pd.DataFrame) -> str:
    """Say how far devices give the same answers."""
    same, wrong = across.identical(answered), int((differing["by_wrong"] > 0).sum()) if len(differing) else 0
    rest = len(answered) - same
    cells = f"{wording.plural(len(answered), 'cell')} that several devices answered"
    told = f"Of {cells}, {same} are alike to the last digit"
    if not rest:
        return f"{told}."
    apart = len(differing) - wrong
    more = f", and the largest errors of {apart} more differ by more than {across.NEAR:g} times" if apart else ""
    last = "" if len(differing) == rest else "; the rest differ in last bits"
    return f"{told}. Of the other {rest}, {wrong} answer another number of rays wrongly{more}{last}."


def _differing(differing: pd.DataFrame, named: dict[str, str], order: Sequence[str], total: int) -> Table:
    """Make a line for each cell whose answers differ, with wrong rays and largest errors by device."""
    devices = [device for device in order if device in differing["wrong"].columns][:COLUMNS]
    body: list[tuple[Any, ...]] = []
    for (scene, _, precision, label), row in differing.iterrows():
        own = [row.get((name, device)) for device in devices for name in ("wrong", "error")]
        body.append((named[str(scene)], label, precision, *own))
    columns = [Column("surface"), Column("variant", stretch=1), Column("precision")]
    for device in devices:
        columns += [
            Column("wrong", wording.count, numeric=True, over=device),
            Column("max error", wording.error, numeric=True, over=device),
        ]
    told = (
        f"Wrong rays and the largest |t − t*| away from silhouettes, scene units.{wording.first_of(len(body), total)}"
    )
    return Table(tuple(columns), body, "Answers that differ between devices.", told)
