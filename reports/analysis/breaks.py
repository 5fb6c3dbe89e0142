"""What follows from the rungs of families of hard rays: who is right how often, and the first rung that breaks it.

A variant breaks on a rung where it is right on less than HELD of the decided rays. Rays that no arithmetic of the
precision can decide are no part of this; a rung without decided rays neither breaks a variant nor clears it.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from harness.results.schema import KINDS

HELD = 0.99
COUNTS = ["rays", "decided", "right", *KINDS, "undecidable", "undecidable_right", "undecided"]
LADDER = ["family", "precision", "variant"]
ALL_DEVICES = "all devices"


def derive(families: pd.DataFrame, rungs: pd.DataFrame) -> pd.DataFrame:
    """One row for each rung: its cell's columns, the rung's own, and `share_right` of its decided rays (or NaN)."""
    told = ["key", "slot", "family", "method", "variant", "parameters", "origin", "precision", "device"]
    rows = families.loc[families["answers"].astype(bool), told].merge(rungs, on="key", sort=False)
    return rows.assign(share_right=_share(rows["right"], rows["decided"]))


def by_device(rungs: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """The rungs of each device; where all devices agree on every count, as of one, with the worst error of any."""
    rung = [*LADDER, "level"]
    if rungs["device"].nunique() <= 1 or (rungs.groupby(rung)[COUNTS].nunique() > 1).any(axis=None):
        return {str(device): rows for device, rows in rungs.groupby("device", sort=False)}
    worst = rungs.groupby(rung)[["max_error", "worst_ratio"]].transform("max")
    return {ALL_DEVICES: rungs.assign(**worst).drop_duplicates(rung)}


def verdicts(rungs: pd.DataFrame) -> pd.DataFrame:
    """Sum up one device's rungs, a row for each ladder: COUNTS over it, `share_right`, `worst_ratio`, `breaks_at`.

    `breaks_at` is the parameter of the first rung, going harder, that breaks the variant; NaN where none does.
    """
    ladders = rungs.groupby(LADDER, sort=False)
    rows = ladders[["method", "device"]].first().join(ladders[COUNTS].sum()).join(ladders["worst_ratio"].max())
    broken = rungs[rungs["share_right"] < HELD].sort_values("level", kind="stable").drop_duplicates(LADDER)
    rows = rows.join(broken.set_index(LADDER)["parameter"].rename("breaks_at"))
    return rows.assign(share_right=_share(rows["right"], rows["decided"])).reset_index()


def _share(part: pd.Series, whole: pd.Series) -> pd.Series:
    total = whole.astype("float64")
    return part.astype("float64") / total.where(total > 0, np.nan)
