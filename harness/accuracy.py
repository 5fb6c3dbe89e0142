"""A method's hits held against certified truth: what is wrong, and how far off what is right."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import Hits, RayStatus, Truth, TruthStatus

FAR = 0.05  # a hit further than this from the first root, over the scene radius, belongs to no root or another one


class Wrong(IntEnum):
    """What is wrong with one answer; WRONG_ROOT is a later root, or a place that is no root at all."""

    RIGHT = 0
    MISS = 1
    FALSE_HIT = 2
    EXHAUSTED = 3
    WRONG_ROOT = 4


NAMES = {
    Wrong.MISS: "misses",
    Wrong.FALSE_HIT: "false_hits",
    Wrong.EXHAUSTED: "exhausted",
    Wrong.WRONG_ROOT: "wrong_root",
}


@dataclass(frozen=True, eq=False)
class Verdicts:
    """Per ray: `wrong` uint8[n]; `error` float64[n], |t − t*|, NaN unless the right root was hit; `grazing` bool[n]."""

    wrong: NDArray[np.uint8]
    error: NDArray[np.float64]
    grazing: NDArray[np.bool_]


def judge(hits: Hits, truth: Truth, scene_radius: float, grazing_margin: float) -> Verdicts:
    """Compare n answers with n certified ones.

    `error` is the distance from the certified interval. A ray whose margin is under `grazing_margin` scene radii is in
    the grazing class, where a perturbation of that size changes the answer. Undecided rays count as right.
    """
    decided = truth.status != TruthStatus.UNDECIDED
    there = (truth.status == TruthStatus.CROSSING) | (truth.status == TruthStatus.TOUCH)
    hit = hits.status == RayStatus.HIT
    error = np.maximum(0.0, np.maximum(truth.lower - hits.t, hits.t - truth.upper))
    with np.errstate(invalid="ignore"):
        later = error > 0.5 * (truth.following - truth.lower)
        far = error > FAR * scene_radius
    wrong = np.zeros(len(hit), np.uint8)
    wrong[there & hit & (later | far)] = Wrong.WRONG_ROOT
    wrong[there & (hits.status == RayStatus.MISS)] = Wrong.MISS
    wrong[decided & ~there & hit] = Wrong.FALSE_HIT
    wrong[decided & (hits.status == RayStatus.EXHAUSTED)] = Wrong.EXHAUSTED
    error = np.where(there & hit & (wrong == Wrong.RIGHT), error, np.nan)
    return Verdicts(wrong, error, truth.margin < grazing_margin * scene_radius)


def _quantiles(values: NDArray[np.float64]) -> dict[str, float | None]:
    if not len(values):
        return {"max": None, "p999": None, "p99": None, "p50": None}
    top = [float(q) for q in np.quantile(values, (0.999, 0.99, 0.5), method="higher")]
    return {"max": float(values.max()), "p999": top[0], "p99": top[1], "p50": top[2]}


def summarize(
    hits: Hits, truth: Truth, verdicts: Verdicts, scene_radius: float, footprint: float, grazing_margin: float
) -> dict[str, Any]:
    """Counts and quantiles, outside the grazing class and (`grazing_…`) inside it.

    `footprint` is a pixel's height at distance 1. Errors are of rays outside the grazing class that hit the right root.
    """
    clear = ~verdicts.grazing
    summary: dict[str, Any] = {
        "rays": len(hits.status),
        "truth_hits": int(np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)).sum()),
        "truth_misses": int((truth.status == TruthStatus.MISS).sum()),
        "undecided": int((truth.status == TruthStatus.UNDECIDED).sum()),
        "grazing": int(verdicts.grazing.sum()),
        "grazing_margin": grazing_margin,
        "scene_radius": scene_radius,
    }
    for kind, name in NAMES.items():
        summary[name] = int((clear & (verdicts.wrong == kind)).sum())
        summary[f"grazing_{name}"] = int((verdicts.grazing & (verdicts.wrong == kind)).sum())
    measured = clear & np.isfinite(verdicts.error)
    error = verdicts.error[measured]
    summary["error"] = _quantiles(error)
    summary["relative_error"] = _quantiles(error / scene_radius)
    summary["pixel_error"] = _quantiles(error / (footprint * np.maximum(truth.lower[measured], np.finfo(float).tiny)))
    summary["evaluations_mean"] = float(hits.evaluations.mean())
    summary["evaluations_max"] = int(hits.evaluations.max())
    return summary


def wrong_share(summary: dict[str, Any]) -> float:
    """The share of rays outside the grazing class that were answered wrongly."""
    clear = summary["rays"] - summary["grazing"]
    return sum(summary[name] for name in NAMES.values()) / clear if clear else 0.0
