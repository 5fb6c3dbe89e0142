"""Hold devices against each other by what can be compared: speed-ups over one baseline, orders of variants, answers.

Times of two devices are never compared, since they may be of different machines and days. A speed-up is over the
baseline on the same device, in the rounds that timed both.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from harness.contract import CellStatus
from reports.analysis import choices, derive

CELL = ["comparison", "variant", "precision"]  # what names a cell on any device
CLEAR = 1.1  # the factor from which on a mean counts as another order
NEAR = 2.0  # the factor up to which two largest errors differ in last bits alone


def comparable(frame: pd.DataFrame) -> pd.DataFrame:
    """Select the rows with a speed-up, in the precision that most of them have, one for each cell and device.

    A speed-up is of a variant that answers every ray away from silhouettes rightly.
    """
    rows = derive.contenders(frame, list(dict.fromkeys([*CELL, "device", "precision", "speedup"])))
    rows = rows[rows["speedup"].notna()]
    rows = rows[rows["precision"] == choices.precision_of(rows)] if len(rows) else rows
    return frame.loc[rows.sort_index().drop_duplicates([*CELL, "device"]).index]


def devices_of(rows: pd.DataFrame) -> list[str]:
    """Return the devices of rows, those with most rows first."""
    return [str(name) for name in rows["device"].value_counts().index]


def mean_speedups(rows: pd.DataFrame) -> dict[str, dict[str, tuple[float, int]]]:
    """Return by variant's label and device the geometric mean of its speed-ups, and of how many scenes it is.

    For each variant only those scenes count that all of its devices have, so that the means are of the same.
    """
    found: dict[str, dict[str, tuple[float, int]]] = {}
    for label, own in rows.groupby("label", sort=False):
        table = own.pivot_table(index="comparison", columns="device", values="speedup", aggfunc="first", sort=False)
        common = table.dropna()
        if len(table.columns) > 1 and len(common):
            means = np.exp(np.log(common).mean())
            found[str(label)] = {str(device): (float(mean), len(common)) for device, mean in means.items()}
    return found


@dataclass(frozen=True)
class Swap:
    """Name two variants of which one is the faster on a device and the other on another.

    here, there: how many times as fast the `first` is as the `second`, over 1 on `device` and under 1 on `other`
    scenes: of the same ones
    """

    first: str
    second: str
    device: str
    other: str
    here: float
    there: float
    scenes: int

    @property
    def size(self) -> float:
        """Return the factor by which the ratio of the two changes."""
        return self.here / self.there


def swaps(rows: pd.DataFrame, devices: Sequence[str]) -> list[Swap]:
    """List the pairs of variants that change their order between two devices by more than CLEAR both ways.

    Each pair stands once, with the two devices between which it changes most; the largest change comes first.
    """
    tables = {}
    for device in devices:
        own = rows[rows["device"] == device]
        table = own.pivot_table(index="comparison", columns="label", values="speedup", aggfunc="first", sort=False)
        tables[device] = np.log(table)
    best: dict[frozenset[str], Swap] = {}
    for one, other in itertools.combinations(devices, 2):
        a, b = tables[one].align(tables[other], join="inner")
        names, x, y = [str(name) for name in a.columns], a.to_numpy(float), b.to_numpy(float)
        for i, j in itertools.combinations(range(len(names)), 2):
            both = np.isfinite(x[:, i] - x[:, j] + y[:, i] - y[:, j])
            if not both.any():
                continue
            here, there = (float(np.exp((of[both, i] - of[both, j]).mean())) for of in (x, y))
            if min(here, there) * CLEAR < 1.0 < max(here, there) / CLEAR:
                made = _swap((names[i], names[j]), (one, other), (here, there), int(both.sum()))
                pair = frozenset((names[i], names[j]))
                if pair not in best or made.size > best[pair].size:
                    best[pair] = made
    return sorted(best.values(), key=lambda swap: -swap.size)


def _swap(pair: tuple[str, str], devices: tuple[str, str], ratios: tuple[float, float], scenes: int) -> Swap:
    """Make a swap of how many times as fast a pair's first is on two devices; `device` is where it is the faster."""
    if ratios[0] > ratios[1]:
        return Swap(*pair, *devices, *ratios, scenes)
    return Swap(*pair, *devices[::-1], *ratios[::-1], scenes)


def answers(frame: pd.DataFrame) -> pd.DataFrame:
    """Return the cells that two devices or more answered: a line each, with columns by ("wrong" or "error", device).

    The index is CELL and the label. `error` is the largest |t − t*| away from silhouettes, in scene units.
    """
    there = (frame["status"] == CellStatus.OK) & frame["answers"].astype(bool) & frame["wrong_rays"].notna()
    rows = frame.loc[there, [*CELL, "label", "device", "wrong_rays", "error_max"]]
    rows = rows.drop_duplicates([*CELL, "device"])
    rows = rows[rows.groupby(CELL)["device"].transform("size") > 1]
    told = rows.assign(wrong=rows["wrong_rays"].astype("float64"), error=rows["error_max"].astype("float64"))
    return told.pivot(index=[*CELL, "label"], columns="device", values=["wrong", "error"])


def differing(table: pd.DataFrame) -> pd.DataFrame:
    """Return the lines of `answers` whose wrong rays differ, or whose largest errors do by more than NEAR.

    Columns `by_wrong` (rays) and `by_error` (a factor) say how much; the largest differences come first.
    """
    wrong, error = table["wrong"], table["error"]
    by_wrong = wrong.max(axis=1) - wrong.min(axis=1)
    least = error.min(axis=1)
    by_error = (error.max(axis=1) / least.where(least > 0)).fillna(1.0)
    by_error = by_error.where(~((least == 0) & (error.max(axis=1) > 0)), np.inf)
    kept = (by_wrong > 0) | (by_error > NEAR)
    told = table[kept].copy()
    told["by_wrong", ""], told["by_error", ""] = by_wrong[kept], by_error[kept]
    return told.sort_values([("by_wrong", ""), ("by_error", "")], ascending=False, kind="stable")


def identical(table: pd.DataFrame) -> int:
    """Count the lines of `answers` whose wrong rays and largest errors are the same to the last digit."""
    same = [
        (table[name].max(axis=1) == table[name].min(axis=1)) | table[name].isna().all(axis=1)
        for name in ("wrong", "error")
    ]
    return int((same[0] & same[1]).sum())


def fastest_of_methods(rows: pd.DataFrame) -> pd.DataFrame:
    """Return of each scene, device and method the row with the largest speed-up."""
    return rows.sort_values("speedup", ascending=False, kind="stable").drop_duplicates(
        ["comparison", "device", "method"]
    )
