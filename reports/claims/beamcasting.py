"""What beamcasting claims."""

from __future__ import annotations

import json

import pandas as pd

from reports import wording
from reports.claims import picks
from reports.claims.model import Claim, Verdict, quantities, untestable, verdict
from reports.evidence import Evidence

PAPER = "beamcasting"
TABLES = "beamcasting-tables.toml"
_BOTH = ("interval_uniform", "interval_adaptive")


def _ratios(evidence: Evidence) -> pd.DataFrame:
    return evidence.ratios(picks.UNIFORM, picks.ADAPTIVE)


def _always(evidence: Evidence) -> Verdict | None:
    ratios = _ratios(evidence)
    if ratios.empty:
        return None
    lost = ratios[ratios["ratio_high"] < 1.0]
    named = ", ".join(
        f"{r.surface_title} {r.size}×{r.samples_per_pixel} {wording.factor(r.ratio)}" for r in lost.itertuples()
    )
    figure = f"{quantities(ratios['ratio'])}; the paper: 1.16× to 2.85×" + (f"; slower: {named}" if named else "")
    return verdict(lost.empty and ratios["ratio"].mean() > 1.0, figure)


def _grows(evidence: Evidence, by: str, kept: str) -> Verdict | None:
    ratios = _ratios(evidence)
    table = ratios.pivot_table(index=["device", "surface", kept], columns=by, values="ratio").dropna()
    if table.shape[1] < 2 or table.empty:
        return None
    low, high = table.columns[0], table.columns[-1]
    more = int((table[high] > table[low]).sum())
    figure = (
        f"mean ratio {wording.factor(table[low].mean())} at {low} and {wording.factor(table[high].mean())} at {high}"
    )
    return verdict(
        bool(table[high].mean() > table[low].mean() and more > len(table) / 2),
        f"{figure}; larger in {more} of {len(table)}",
    )


def _resolution(evidence: Evidence) -> Verdict | None:
    return _grows(evidence, "size", "samples_per_pixel")


def _samples(evidence: Evidence) -> Verdict | None:
    return _grows(evidence, "samples_per_pixel", "size")


def _closer_with_samples(evidence: Evidence) -> Verdict | None:
    rows = pd.concat([evidence.rows(pick) for pick in (picks.UNIFORM, picks.ADAPTIVE)])
    table = rows.pivot_table(
        index=["device", "method", "surface", "size"], columns="samples_per_pixel", values="error_p99"
    ).dropna()
    if table.shape[1] < 2 or table.empty:
        return None
    few, many = table.columns[0], table.columns[-1]
    closer = int((table[many] < table[few]).sum())
    share = wording.factor((table[few] / table[many]).median())
    told = f"99th percentile of the error at {few} over {many} samples: {share} (median)"
    told += f"; smaller in {closer} of {len(table)}"
    return verdict(closer == len(table), told)


def _beyond_algebra(evidence: Evidence) -> Verdict | None:
    rows = pd.concat([evidence.rows(pick) for pick in (picks.UNIFORM, picks.ADAPTIVE)])
    rows = rows[rows["degree"].isna()]
    if rows.empty:
        return None
    wrong = rows["misses"].sum() + rows["wrong_root"].sum()
    return verdict(
        bool(wrong == 0), f"{wrong:,} misses and wrong roots on {wording.listed(sorted(set(rows['surface_title'])))}"
    )


def _nothing_missed(evidence: Evidence) -> Verdict | None:
    rows = pd.concat([evidence.rows(pick) for pick in (picks.UNIFORM, picks.ADAPTIVE)])
    if rows.empty:
        return None
    misses = rows["misses"].sum() + rows["grazing_misses"].sum() + rows["drowned_misses"].sum()
    told = f"{misses:,} misses of {rows['accuracy_rays'].sum():,} rays on {rows['surface'].nunique()} surfaces"
    return verdict(bool(misses == 0), told)


def _complexity(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.UNIFORM).dropna(subset=["median_ms"])
    counted = rows.drop_duplicates(["surface"])
    counted = counted[counted["operations"].notna()]
    if len(counted) < 4:
        return None
    operations = counted["operations"].map(lambda text: sum(json.loads(text).values())).astype(float)
    rank = float(operations.rank().corr(counted["median_ms"].rank()))
    return verdict(rank > 0.5, f"rank correlation of operations and time over {len(counted)} surfaces: {rank:.2f}")


CLAIMS = (
    Claim(
        PAPER,
        "IV",
        "In all cases the adaptive method beats the uniform one.",
        "Time of uniform over adaptive: every surface, size and number of samples",
        _always,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "The gain grows with the resolution.",
        "That ratio at the smallest and the largest size",
        _resolution,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "The gain grows with the samples per pixel.",
        "That ratio at 1 and at 4 samples",
        _samples,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "III.D",
        "More samples per pixel approximate the surface better.",
        "99th percentile of the error at 1 and at 4 samples, every surface and size",
        _closer_with_samples,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "Beams are not restricted to algebraic surfaces.",
        "Misses and wrong roots on the Blinn blob",
        _beyond_algebra,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "I, III",
        "All parts of the surface are seen.",
        "Misses, silhouettes included, on every surface",
        _nothing_missed,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "Speed falls with the complexity of the expression.",
        "Rank correlation of operations and time of the uniform method, above 0.5",
        _complexity,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "Real-time frame rates in almost all cases.",
        "none",
        untestable,
        reason="an absolute speed of a GTX 470; the tables of results say what this device does",
    ),
    Claim(
        PAPER,
        "V",
        "Divergence within a warp costs much.",
        "none",
        untestable,
        reason="a processor has no warps; a GPU's profiler would decide it",
    ),
    Claim(
        PAPER,
        "V",
        "Affine arithmetic would help (future work).",
        "none",
        untestable,
        reason="no method here has affine arithmetic",
    ),
)
