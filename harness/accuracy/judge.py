"""A method's hits held against certified truth: what is wrong, and how far off what is right."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.contract import UNIT_ROUNDOFF, Hits, Precision, RayStatus, Surface, Truth, TruthStatus
from harness.results.row import Quantiles
from harness.scenes.camera import scene_radius

# Unit roundoffs under which a ray's contrast leaves f's sign in doubt: one is the kernel's, whose bound is of first
# order and whose compiler may regroup, one is the estimate's, which is of float64.
DROWNED = 2.0
FAR = 0.05  # a hit further than this from the first root, over the scene radius, belongs to no root or another one


class Wrong(IntEnum):
    """What is wrong with one answer; WRONG_ROOT is a later root, or a place that is no root at all; INVALID is what can
    be no answer, whatever the truth (harness.accuracy.answers)."""

    RIGHT = 0
    MISS = 1
    FALSE_HIT = 2
    EXHAUSTED = 3
    WRONG_ROOT = 4
    INVALID = 5


NAMES = {
    Wrong.MISS: "misses",
    Wrong.FALSE_HIT: "false_hits",
    Wrong.EXHAUSTED: "exhausted",
    Wrong.WRONG_ROOT: "wrong_root",
    Wrong.INVALID: "invalid",
}


@dataclass(frozen=True, eq=False)
class Verdicts:
    """Per ray: `wrong` uint8[n]; `error` float64[n], |t − t*|, NaN unless the right root was hit; `grazing` and
    `drowned` bool[n], classes without a common ray."""

    wrong: NDArray[np.uint8]
    error: NDArray[np.float64]
    grazing: NDArray[np.bool_]
    drowned: NDArray[np.bool_]

    @property
    def clear(self) -> NDArray[np.bool_]:
        """bool[n]: rays outside both classes, on which every wrong answer is the method's fault."""
        return ~(self.grazing | self.drowned)


def judge(
    hits: Hits, truth: Truth, scene_radius: float, grazing_margin: float, precision: Precision | None = None
) -> Verdicts:
    """Compare n answers with n certified ones.

    `error` is the distance from the certified interval. A ray whose margin is under `grazing_margin` scene radii is in
    the grazing class, where a perturbation of that size changes the answer. Of the others, one whose contrast is under
    DROWNED unit roundoffs of `precision` is in the class of drowned rays, on which |f| falls under what arithmetic of
    that precision may be off in it; without a precision no ray is. Right is what is shown to be right; of an undecided
    ray nothing is shown but that its answer is none: it counts as right here and is no part of `judged`.
    """
    undecided = truth.status == TruthStatus.UNDECIDED
    there = (truth.status == TruthStatus.CROSSING) | (truth.status == TruthStatus.TOUCH)
    away = truth.status == TruthStatus.MISS
    hit = (hits.status == RayStatus.HIT) & np.isfinite(hits.t)
    miss, gave_up = hits.status == RayStatus.MISS, hits.status == RayStatus.EXHAUSTED
    error = np.maximum(0.0, np.maximum(truth.lower - hits.t, hits.t - truth.upper))
    with np.errstate(invalid="ignore"):
        near = (error <= 0.5 * (truth.following - truth.lower)) & (error <= FAR * scene_radius)
    wrong = np.full(len(hit), Wrong.INVALID, np.uint8)
    wrong[hit & there] = Wrong.WRONG_ROOT
    wrong[hit & away] = Wrong.FALSE_HIT
    wrong[miss & there] = Wrong.MISS
    wrong[gave_up] = Wrong.EXHAUSTED
    wrong[(hit & there & near) | (miss & away) | (undecided & (hit | miss | gave_up))] = Wrong.RIGHT
    error = np.where(there & (wrong == Wrong.RIGHT), error, np.nan)
    grazing = truth.margin < grazing_margin * scene_radius
    faint = DROWNED * UNIT_ROUNDOFF[precision] if precision else 0.0
    return Verdicts(wrong, error, grazing, ~grazing & (truth.contrast < faint))


def judged(truth: Truth, verdicts: Verdicts) -> NDArray[np.bool_]:
    """bool[n]: the rays that shares of wrong ones are of: decided, and neither grazing nor drowned."""
    return np.asarray((truth.status != TruthStatus.UNDECIDED) & verdicts.clear)


def undecided_hits(truth_hits: int, undecided: int, most: float, what: str = "hits") -> str | None:
    """Why a truth of so many decided and undecided hits measures no error, where it does not; `most` is the share of
    undecided ones among both that it may have. Rays that all are proved to miss are judged by their misses."""
    both = truth_hits + undecided
    if undecided <= most * both:
        return None
    return f"the oracle leaves {undecided} of {both} {what} undecided, over {most:.3g} of them: no accuracy"


def undecided_too_many(truth: Truth, most: float) -> str | None:
    """Do what `undecided_hits` does, for certified answers."""
    there = (truth.status == TruthStatus.CROSSING) | (truth.status == TruthStatus.TOUCH)
    return undecided_hits(int(there.sum()), int((truth.status == TruthStatus.UNDECIDED).sum()), most)


def nothing_judged(rays: int) -> str:
    """What is said of a truth none of whose rays is decided and clear."""
    return f"none of the {rays} rays is decided and neither grazing nor drowned: nothing to judge"


def _quantiles(values: NDArray[np.float64]) -> Quantiles:
    """Return quantiles of the finite values: a normal has no direction at a singular point, a touch no condition."""
    values = values[np.isfinite(values)]
    if not len(values):
        return {"max": None, "p999": None, "p99": None, "p50": None}
    top = [float(q) for q in np.quantile(values, (0.999, 0.99, 0.5), method="higher")]
    return {"max": float(values.max()), "p999": top[0], "p99": top[1], "p50": top[2]}


@dataclass(frozen=True, eq=False)
class Deviations:
    """What an error in t does at the hit, float64[n] each, NaN unless the right root was hit.

    The position is off by as much as t, since directions have length 1.
    """

    normal: NDArray[np.float64]  # degrees between the surface's normals at the hit and at the root
    residual: NDArray[np.float64]  # |f| at the hit over the sum of |terms of f| at the root: the backward error


def deviations(surface: Surface, rays: NDArray[np.float32], hits: Hits, truth: Truth, verdicts: Verdicts) -> Deviations:
    """Evaluated on the host in float64."""
    import surfaces

    normal, residual = np.full(len(rays), np.nan), np.full(len(rays), np.nan)
    right = np.isfinite(verdicts.error)
    if right.any():
        origins, directions = np.split(rays[right].astype(np.float64), 2, axis=1)
        hit = origins + hits.t[right, None] * directions
        at_hit, at_root = (
            surfaces.gradient(surface, p) for p in (hit, origins + truth.lower[right, None] * directions)
        )
        slope = np.abs(np.einsum("ij,ij->i", at_root, directions))
        terms = truth.condition[right] * slope * surface.domain.radius
        with np.errstate(invalid="ignore", divide="ignore"):
            turn = np.linalg.norm(np.cross(at_hit, at_root), axis=1)
            normal[right] = np.degrees(np.arctan2(turn, np.abs(np.einsum("ij,ij->i", at_hit, at_root))))
            residual[right] = np.abs(surfaces.evaluate(surface, hit)) / terms
    return Deviations(normal, residual)


def summarize(
    surface: Surface,
    hits: Hits,
    truth: Truth,
    verdicts: Verdicts,
    deviations: Deviations,
    *,
    precision: Precision,
    footprint: float,
    grazing_margin: float,
) -> dict[str, Any]:
    """Counts and quantiles, of clear rays, and in the classes of grazing (`grazing_…`) and drowned (`drowned_…`) ones.

    `footprint` is a pixel's height at distance 1. Errors are of clear rays that hit the right root:
    in scene units; relative to the scene radius (toledo2007's ε(R + r)) and to the feature radius (its ε(r)); in pixel
    footprints; in units in the last place of t; and over condition × unit roundoff × radius, which a method as good as
    the problem allows keeps at a small number. Errors are distances to a certified interval: what is smaller than its
    width (`certified_width` is the largest) may show as 0. `judged` rays are decided and outside the grazing class;
    evaluations are over rays that were answered.
    """
    clear, radius = verdicts.clear, scene_radius(surface)
    widths = (truth.upper - truth.lower)[clear & np.isfinite(verdicts.error)]
    summary: dict[str, Any] = {
        "rays": len(hits.status),
        "truth_hits": int(np.isin(truth.status, (TruthStatus.CROSSING, TruthStatus.TOUCH)).sum()),
        "truth_misses": int((truth.status == TruthStatus.MISS).sum()),
        "undecided": int((truth.status == TruthStatus.UNDECIDED).sum()),
        "grazing": int(verdicts.grazing.sum()),
        "drowned": int(verdicts.drowned.sum()),
        "judged": int(judged(truth, verdicts).sum()),
        "grazing_margin": grazing_margin,
        "scene_radius": radius,
        "domain_radius": surface.domain.radius,
        "certified_width": float(np.max(widths, initial=0.0)),
    }
    for kind, name in NAMES.items():
        summary[name] = int((clear & (verdicts.wrong == kind)).sum())
        summary[f"grazing_{name}"] = int((verdicts.grazing & (verdicts.wrong == kind)).sum())
        summary[f"drowned_{name}"] = int((verdicts.drowned & (verdicts.wrong == kind)).sum())
    measured = clear & np.isfinite(verdicts.error)
    error, t = verdicts.error[measured], truth.lower[measured]
    kind_of_t = np.float32 if precision == "float32" else np.float64
    allowed = np.fmax(truth.condition[measured], 1.0) * UNIT_ROUNDOFF[precision] * surface.domain.radius
    summary["error"] = _quantiles(error)
    summary["relative_error"] = _quantiles(error / radius)
    summary["feature_error"] = _quantiles(error / (surface.feature_radius or radius))
    summary["pixel_error"] = _quantiles(error / (footprint * np.maximum(t, np.finfo(float).tiny)))
    summary["ulp_error"] = _quantiles(error / np.spacing(np.abs(t).astype(kind_of_t)).astype(np.float64))
    summary["condition_ratio"] = _quantiles(error / allowed)
    summary["normal_error_degrees"] = _quantiles(deviations.normal[measured])
    summary["residual"] = _quantiles(deviations.residual[measured])
    summary["evaluations_mean"], summary["evaluations_max"] = hits.spent
    return summary


def wrong_share(summary: Mapping[str, Any]) -> float | None:
    """The share of judged rays (see `judged`) that were answered wrongly; None where there are none to judge."""
    wrong = sum(summary[name] for name in NAMES.values())
    return min(1.0, wrong / summary["judged"]) if summary["judged"] else None
