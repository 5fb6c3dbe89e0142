"""Compute which share of each ladder of hard rays a variant holds, for the figure and the table of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import pandas as pd

from reports import wording
from reports.analysis import breaks
from reports.material import Material


@dataclass(frozen=True, eq=False)
class Ladders:
    """Hold the ladders of one device and precision: a line for each variant, a column for each family.

    shares: the rungs that a variant holds over those with decided rays; NaN where it was not run or nothing is decided
    told: the two numbers as text
    strong: the labels of the variants in focus
    more: the device and the precision, as far as the run has several
    """

    shares: pd.DataFrame
    told: pd.DataFrame
    strong: Sequence[str]
    precision: str
    more: Sequence[str]
    caption: str


def ladders(material: Material) -> Iterator[Ladders]:
    """Yield the ladders of each device and precision; devices that agree on every count are one."""
    if material.rungs.empty:
        return
    devices = breaks.by_device(material.rungs)
    several = material.rungs["precision"].nunique() > 1
    for device, on_device in devices.items():
        for precision, rows in on_device.groupby("precision"):
            more = [device] * (len(devices) > 1) + [str(precision)] * several
            yield _ladders(material, rows, device, str(precision), more)


def _ladders(material: Material, rows: pd.DataFrame, device: str, precision: str, more: Sequence[str]) -> Ladders:
    """Return the ladders of one device and precision; the variants and families that hold most come first."""
    counts = breaks.verdicts(rows).groupby(["label", "family"])[["rungs_held", "rungs_decided"]].sum()
    share = (counts["rungs_held"] / counts["rungs_decided"]).where(counts["rungs_decided"] > 0).unstack()
    written = [f"{held}/{of}" if of else wording.NONE for held, of in counts.itertuples(index=False)]
    told = pd.Series(written, counts.index, dtype=object).unstack().fillna(wording.REFUSED)
    lines = share.fillna(0.0).sum(axis=1).sort_values(ascending=False, kind="stable").index
    families = share.mean().fillna(-1.0).sort_values(ascending=False, kind="stable").index
    facts = material.run.plan.facts
    named = [facts[family].title if family in facts else str(family) for family in families]
    focused = rows[(rows["method"] == material.focus) | (rows["variant"] == material.focus)]
    caption = (
        f"Of each family of hard rays the rungs that a variant holds, {precision} on {device}: those on which it "
        f"answers at least {breaks.HELD:.0%} of the decided rays rightly. {wording.REFUSED} not run, "
        f"{wording.NONE} nothing decided."
    ).replace("%", " %")
    shares, texts = (of.loc[lines, families].set_axis(named, axis=1) for of in (share, told))
    return Ladders(shares.astype("float64"), texts, list(focused["label"].unique()), precision, more, caption)
