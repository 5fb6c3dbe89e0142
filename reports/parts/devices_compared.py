"""Compare devices by the same variant: how much faster each device is, and what the harness adds to its time."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Mapping
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, rounds
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import shades, tables
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 30
TOP = 30.0  # the factor that has the brightest colour
READ = "A line without bright squares is a method that needs no particular device."

_KERNEL = ["comparison", "variant", "precision"]


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless two devices or more timed the same variant on the same scene."""
    timed = material.listed[material.listed["status"] == CellStatus.OK].dropna(subset=["median_ms"])
    table = _table(timed) if timed["device"].nunique() > 1 else None
    if table is None:
        return []
    right = timed[derive.all_right(timed) & timed["answers"].astype(bool)]
    right = right[right["precision"] == right["precision"].iloc[0]] if len(right) else right
    means = _means(right)
    shown: tuple[Block, ...] = (Text(_said(means)), _matrix(means, right)) if means else ()
    return [Section("The same kernel on every device", shown, (table,), name="Devices")]


def _means(right: pd.DataFrame) -> dict[str, dict[str, tuple[float, int]]]:
    """Return by label and device the geometric mean of a variant's times over its fastest device's, and of how many.

    For each variant only those scenes count that all of its devices answered rightly in the same rounds, so that the
    means are of the same. `right` is of one precision.
    """
    logs: dict[str, list[dict[str, float]]] = {}
    read = list(dict.fromkeys([*_KERNEL, "device", "label", "median_ms", *rounds.COLUMNS, *rounds.CLOCKS]))
    rows = right[read].drop_duplicates([*_KERNEL, "device"]).sort_values("median_ms", kind="stable")
    for _, own in rows.groupby(_KERNEL, sort=False):
        first, *rest = tuples(own)
        ratios = {str(row.device): rounds.times_elsewhere(row, first) for row in rest}
        found = {device: math.log(ratio) for device, ratio in ratios.items() if not math.isnan(ratio)}
        if found:
            least = min(0.0, *found.values())  # in the rounds that timed both, or by one clock, another is the fastest
            found = {device: ratio - least for device, ratio in ({str(first.device): 0.0} | found).items()}
            logs.setdefault(str(first.label), []).append(found)
    means = {}
    for label, scenes in logs.items():
        devices = dict.fromkeys(device for scene in scenes for device in scene)
        common = [scene for scene in scenes if len(scene) == len(devices)]
        if common:
            means[label] = {
                device: (math.exp(sum(scene[device] for scene in common) / len(common)), len(common))
                for device in devices
            }
    return means


def _fastest(means: Mapping[str, Mapping[str, tuple[float, int]]]) -> list[tuple[str, int]]:
    """Return each device and for how many variants it has the smallest mean, those with most first."""
    firsts = Counter(min(own, key=lambda device: own[device][0]) for own in means.values())
    devices = dict.fromkeys(device for own in means.values() for device in own)
    return sorted(((device, firsts[device]) for device in devices), key=lambda found: -found[1])


def _said(means: Mapping[str, Mapping[str, tuple[float, int]]]) -> str:
    """Say what to see, and which device is fastest for how many of the variants."""
    (first, count), *rest = _fastest(means)
    others = [f"{device} for {firsts}" for device, firsts in rest if firsts]
    told = f"{first} is the fastest for {count} of {wording.plural(len(means), 'variant')}"
    return f"{READ} {told}{f', {wording.listed(others)}' if others else ''}."


def _matrix(means: Mapping[str, Mapping[str, tuple[float, int]]], right: pd.DataFrame) -> Matrix:
    """Make a line for each variant and a column for each device, those on the left that are fastest most often.

    `right` are the rows that the means are of.
    """
    order = [device for device, _ in _fastest(means)]
    missing = shades.silent(wording.NONE, "wrong, or not timed in the same rounds")
    return Matrix(
        tuple(order),
        [(label, tuple(_square(*own[d]) if d in own else missing for d in order)) for label, own in means.items()],
        f"Time over that of the variant's fastest device, {right['precision'].iloc[0]}.",
        "The geometric mean over the scenes that all devices of the line answered rightly in the same rounds; lines "
        f"may be of different scenes.{_clocks(right)}",
        "method",
        shades.key({0.0: "the fastest", 0.5: f"{TOP**0.5:.2g}×", 1.0: f"{TOP:g}× and more"}),
    )


def _host_ms(rows: pd.DataFrame) -> pd.Series:
    """Return the rows' median times, by the host's clock where theirs are different; float64 with their index."""
    if rows["clock"].nunique() < 2:
        return rows["median_ms"]
    return rows["median_ms"] * [rounds.on_host(row) for row in tuples(rows)]


def _clocks(rows: pd.DataFrame) -> str:
    """Say, with a space before it, by which clock devices are compared that are timed by different ones; else ""."""
    if rows["clock"].nunique() < 2:
        return ""
    return " Devices timed by different clocks are compared by the host's, which counts submitting and waiting."


def _square(mean: float, scenes: int) -> Square:
    """Return a device's square for a variant: the mean of its times over the fastest device's."""
    return Square(
        wording.factor(mean), shades.shade(math.log(mean) / math.log(TOP)), f"mean of {wording.plural(scenes, 'scene')}"
    )


def _table(timed: pd.DataFrame) -> Table | None:
    """Make a line for each scene, precision and variant that several devices timed; None where there is none."""
    devices = list(dict.fromkeys(timed["device"]))
    named = scene_names(timed)
    body: list[tuple[Any, ...]] = []
    timed = timed.assign(comparable=derive.all_right(timed) | ~timed["answers"].astype(bool))
    kept = [*_KERNEL, "device", "label", "median_ms", *rounds.COLUMNS, *rounds.CLOCKS, "comparable"]
    timed = timed[kept].drop_duplicates([*_KERNEL, "device"])
    shared = timed[timed.groupby(_KERNEL)["device"].transform("size") > 1]
    groups = shared.groupby(_KERNEL, sort=False)
    for (scene, _, precision), rows in itertools.islice(groups, tables.ROW_LIMIT):
        by_device = rows.set_index("device")
        slowest = rows.loc[rows["comparable"]]
        slowest = slowest.loc[_host_ms(slowest).nlargest(1).index]
        cells: list[float | None] = []
        for device in devices:
            here = by_device.loc[device] if device in by_device.index else None
            if here is None:
                cells += [None] * 3
            else:
                faster = rounds.times_elsewhere(slowest.iloc[0], here) if here.comparable else None
                cells += [here.median_ms, faster, here.overhead_share]
        body.append((named[str(scene)], precision, rows["label"].iloc[0], *cells))
    if not body:
        return None
    columns = [Column("surface"), Column("precision"), Column("variant", stretch=1)]
    for device in devices:
        columns += [
            Column("ms", wording.number, numeric=True, over=device),
            Column("faster", wording.factor, numeric=True, over=device),
            Column("overhead", wording.share, numeric=True, over=device),
        ]
    return Table(
        tuple(columns),
        body,
        "The same kernel on every device.",
        "Faster is the time of the row's slowest device over this device's, in the rounds that timed both. Only those "
        "devices count on which the variant answers every ray away from silhouettes rightly; null answers nothing and "
        "always counts. Each device is timed by the clock that is believed there. Overhead is what the harness's "
        "submitting and waiting adds to the kernel's own time, as a share of that time; – where the device has no "
        "clock of its own that is believed. Look for a device whose lead changes from variant to variant: its compiler "
        f"makes more, or less, of one of them.{_clocks(timed)}{wording.first_of(len(body), groups.ngroups)}",
        group=2,
    )
