"""Compute from the rungs of families of hard rays how often each variant is right, and the first rung that breaks it.

A family is a ladder of rungs, each of rays that are harder than those of the rung before. A variant breaks on a rung
where it answers less than the share HELD of the decided rays rightly. Rays that no arithmetic of the precision can
decide do not count. A rung without decided rays neither breaks a variant nor clears it.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from harness.results.schema import KINDS

HELD = 0.99
COUNTS = ["rays", "decided", "right", *KINDS, "undecidable", "undecidable_right", "undecided"]
LADDER = ["family", "precision", "variant"]
ALL_DEVICES = "all devices"
_NAMES = ["method", "label", "method_label", "device"]


def derive(families: pd.DataFrame, rungs: pd.DataFrame) -> pd.DataFrame:
    """Return one row for each rung: its cell's columns, its own, and `share_right`.

    `share_right` is the share of the rung's decided rays that are answered rightly; NaN where none is decided.
    `families` has a row for each cell, `rungs` the rungs of all cells; methods that answer nothing are left out.
    """
    told = ["key", "slot", "family", "method", "variant", "parameters", "origin", "precision", "device"]
    told += ["label", "method_label"]
    rows = families.loc[families["answers"].astype(bool), told].merge(rungs, on="key", sort=False)
    return rows.assign(share_right=_share(rows["right"], rows["decided"]))


def by_device(rungs: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return the rungs of each device.

    Where several devices agree on every count, all are returned as the one device ALL_DEVICES, with the largest
    error of any.
    """
    rung = [*LADDER, "level"]
    if rungs["device"].nunique() <= 1 or (rungs.groupby(rung)[COUNTS].nunique() > 1).any(axis=None):
        return {str(device): rows for device, rows in rungs.groupby("device", sort=False)}
    worst = rungs.groupby(rung)[["max_error", "worst_ratio"]].transform("max")
    return {ALL_DEVICES: rungs.assign(**worst).drop_duplicates(rung)}


def verdicts(rungs: pd.DataFrame) -> pd.DataFrame:
    """Return a row for each ladder (family, precision and variant) of one device's `rungs`.

    A row has _NAMES, the sums of COUNTS over the ladder, `share_right`, and the largest `worst_ratio`. It counts the
    rungs with decided rays, `rungs_decided`, and of these those that do not break the variant, `rungs_held`. Of the
    first rung that does, in order of growing difficulty, it has the parameter, `breaks_at`, and the kind of most of its
    wrong answers, `breaks_by`; both are missing where the variant holds.
    """
    breaking = (rungs["share_right"] < HELD).astype(int)
    ladders = rungs.assign(rungs_decided=rungs["share_right"].notna().astype(int), broken=breaking).groupby(
        LADDER, sort=False
    )
    rows = ladders[_NAMES].first().join(ladders[[*COUNTS, "rungs_decided", "broken"]].sum())
    rows = rows.join(ladders["worst_ratio"].max())
    first = rungs[breaking == 1].sort_values("level", kind="stable").drop_duplicates(LADDER).set_index(LADDER)
    rows = rows.join(first["parameter"].rename("breaks_at"))
    most = first[list(KINDS)].astype("float64").fillna(0.0).to_numpy().argmax(axis=1)
    rows = rows.join(pd.Series([KINDS[i] for i in most], first.index, dtype=object, name="breaks_by"))
    held = rows["rungs_decided"] - rows.pop("broken")
    return rows.assign(rungs_held=held, share_right=_share(rows["right"], rows["decided"])).reset_index()


def best_of_each_method(verdicts: pd.DataFrame) -> pd.DataFrame:
    """Keep of each method the variant that holds most rungs, of several the first.

    `verdicts` are those of one device and precision.
    """
    held = verdicts.groupby(["method", "variant"], sort=False)["rungs_held"].sum()
    best = held.groupby(level="method", sort=False).idxmax()
    return verdicts[verdicts["variant"].isin([variant for _, variant in best])]


def _share(part: pd.Series, whole: pd.Series) -> pd.Series:
    """Return `part` over `whole`, float64 with the index of both; NaN where `whole` is not above 0."""
    total = whole.astype("float64")
    return part.astype("float64") / total.where(total > 0, np.nan)
