"""Judge hits against the certified truth: which answers are wrong, and how far off the right ones are."""

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

# Unit roundoffs of contrast below which f's sign is in doubt. One is for the kernel, whose bound is of first order and
# whose compiler may regroup terms. The other is for the estimate of the contrast, which is computed in float64.
DROWNED = 2.0
FAR = 0.05  # scene radii: a hit that is further from the first root belongs to another root, or to none


class Wrong(IntEnum):
    """Name what is wrong with one answer.

    WRONG_ROOT: the hit is at a later root, or at a place that is no root at all
    INVALID: the answer is impossible, whatever the truth (harness.accuracy.answers)
    """

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
    """Hold the verdicts on n answers.

    wrong: uint8[n], Wrong
    error: float64[n], |t − t*| in scene units; NaN unless the right root was hit
    grazing, drowned: bool[n], two classes of rays; no ray is in both
    """

    wrong: NDArray[np.uint8]
    error: NDArray[np.float64]
    grazing: NDArray[np.bool_]
    drowned: NDArray[np.bool_]

    @property
    def clear(self) -> NDArray[np.bool_]:
        """Return bool[n]: rays outside both classes, on which every wrong answer is the method's fault."""
        return ~(self.grazing | self.drowned)


def judge(
    hits: Hits, truth: Truth, scene_radius: float, grazing_margin: float, precision: Precision | None = None
) -> Verdicts:
    """Compare n answers with n certified ones.

    An error is the distance from the certified interval. A ray is grazing if its margin is under `grazing_margin` scene
    radii: a perturbation of that size changes the answer. Of the others, a ray is drowned if its contrast is under
    DROWNED unit roundoffs of `precision`: |f| falls below the error that arithmetic of that precision may make in it.
    Without a precision no ray is drowned.

    An answer is RIGHT if it is shown to be right. Of a ray that the oracle leaves undecided, only an INVALID answer is
    shown to be wrong; any other counts as RIGHT here, and the ray is no part of `judged`.
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
    """Return bool[n]: the rays over which shares of wrong answers are taken: decided, neither grazing nor drowned."""
    return np.asarray((truth.status != TruthStatus.UNDECIDED) & verdicts.clear)


def undecided_hits(truth_hits: int, undecided: int, most: float, what: str = "hits") -> str | None:
    """Say why a truth with so many undecided hits cannot tell the accuracy; None if it can.

    `truth_hits` counts the decided hits. `most` is the largest share of undecided hits that is allowed, of both
    together. If all rays are proved to miss, they are judged by their misses.
    """
    both = truth_hits + undecided
    if undecided <= most * both:
        return None
    return f"the oracle leaves {undecided} of {both} {what} undecided, over {most:.3g} of them: no accuracy"


def undecided_too_many(truth: Truth, most: float) -> str | None:
    """Do what `undecided_hits` does, for certified answers."""
    there = (truth.status == TruthStatus.CROSSING) | (truth.status == TruthStatus.TOUCH)
    return undecided_hits(int(there.sum()), int((truth.status == TruthStatus.UNDECIDED).sum()), most)


def nothing_judged(rays: int) -> str:
    """Say that no ray of a truth is decided, and neither grazing nor drowned."""
    return f"none of the {rays} rays is decided and neither grazing nor drowned: nothing to judge"


def _quantiles(values: NDArray[np.float64]) -> Quantiles:
    """Return quantiles of the finite values, None for all of them if there is no finite value.

    A normal has no direction at a singular point, and a touch has no condition number.
    """
    values = values[np.isfinite(values)]
    if not len(values):
        return {"max": None, "p999": None, "p99": None, "p50": None}
    top = [float(q) for q in np.quantile(values, (0.999, 0.99, 0.5), method="higher")]
    return {"max": float(values.max()), "p999": top[0], "p99": top[1], "p50": top[2]}


@dataclass(frozen=True, eq=False)
class Deviations:
    """Hold what an error in t does at the hit, float64[n] each; NaN unless the right root was hit.

    The position is off by as much as t, since directions have length 1.

    normal: degrees between the surface's normals at the hit and at the root
    residual: |f| at the hit over the sum of |terms of f| at the root, which is the backward error
    """

    normal: NDArray[np.float64]
    residual: NDArray[np.float64]


def deviations(surface: Surface, rays: NDArray[np.float32], hits: Hits, truth: Truth, verdicts: Verdicts) -> Deviations:
    """Compute the deviations of hits on rays float32[n, 6], on the host in float64."""
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
    """Return counts and quantiles, JSON-able: of clear rays, and in the classes of grazing and of drowned ones.

    Names of the classes' counts begin with `grazing_` and `drowned_`. `footprint` is a pixel's height at distance 1.
    `judged` counts the rays that are decided and in neither class. Evaluations are over rays whose answer is not
    INVALID.

    Errors are of clear rays that hit the right root. They are distances to a certified interval: an error smaller than
    its width may show as 0, and `certified_width` is the largest width. Their units are:

    error: scene units
    relative_error: scene radii, which is toledo2007's ε(R + r)
    feature_error: feature radii, which is toledo2007's ε(r)
    pixel_error: pixel footprints
    ulp_error: units in the last place of t
    condition_ratio: condition × unit roundoff × radius; a method that is as good as the problem allows keeps this small
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
    """Return the share of judged rays (see `judged`) whose answer is wrong; None if there are none to judge."""
    wrong = sum(summary[name] for name in NAMES.values())
    return min(1.0, wrong / summary["judged"]) if summary["judged"] else None
