"""A method's answers on a rung: right and wrong counts, error over what the problem allows, and where it breaks.

Unlike in pictures, rays near tangency are not excused. What no arithmetic of the cell's precision can know is told
apart from what a method gets wrong: a kernel evaluates f at o + t·d, three coordinates rounded when the origin is
moved, when t·d is formed and when it is added, and with constants rounded once. Points are then off by up to
ROUNDINGS · unit roundoff · their size, at most that of the domain. A ray that such a shift turns into one with other
roots (`margin` of the oracle, or of the rung by construction) is `undecidable` and counted apart. The distance to the
origin is no part of that size: the origin is given exactly and can be moved near without a loss.

The class of drowned rays, which views have beside the grazing one (harness.accuracy.judge), is another: there f's
value is off, by its own roundings and by those of the point at that very place, so that flat places count, and places
of a size far below the domain's do not. Neither class holds the other. Families keep to the points alone: their
ladders are built along a distance, and `undecidable` says where that distance ends, whatever the formula.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, TypeVar

import numpy as np

from harness.accuracy.judge import Wrong, judge
from harness.contract import UNIT_ROUNDOFF, Hits, Precision, Truth, TruthStatus
from harness.hardcases.groups import Group
from harness.hardcases.model import Rung
from harness.results.row import RungVerdict
from harness.scenes.camera import scene_radius

ROUNDINGS = 4.0
PerRay = TypeVar("PerRay", Hits, Truth)


def knowable_margin(rung: Rung, precision: Precision) -> float:
    """The margin, in scene units, below which a ray of this rung is undecidable."""
    domain = rung.surface.domain
    return ROUNDINGS * UNIT_ROUNDOFF[precision] * (domain.radius + math.hypot(*domain.center))


def judge_rung(rung: Rung, hits: Hits, truth: Truth, precision: Precision) -> RungVerdict:
    """Count right and wrong answers, and measure errors and stability.

    rays = decided + undecidable + undecided, and decided = right + misses + false_hits + exhausted + wrong_root
    + invalid. An answer that can be none is wrong whatever the truth, so that its ray is a decided one.
    `undecidable_right`: undecidable rays answered as the oracle does. `max_error` and `worst_ratio` are over `right`,
    None where there is no hit: the largest |t - t*|, and of it over max(condition, 1) · unit roundoff · the domain's
    radius (t itself cannot be had better than with condition 1). A backward stable method's ratio is a small number
    on every rung.
    """
    verdicts = judge(hits, truth, scene_radius(rung.surface), grazing_margin=0.0)
    invalid = verdicts.wrong == Wrong.INVALID
    certified = (truth.status != TruthStatus.UNDECIDED) | invalid
    undecidable = certified & ~invalid & (np.minimum(truth.margin, rung.margin) < knowable_margin(rung, precision))
    decided = certified & ~undecidable
    right = verdicts.wrong == Wrong.RIGHT
    measured = decided & np.isfinite(verdicts.error)
    error = verdicts.error[measured]

    def count(kind: Wrong) -> int:
        return int((decided & (verdicts.wrong == kind)).sum())

    allowed = np.fmax(truth.condition[measured], 1.0) * UNIT_ROUNDOFF[precision] * rung.surface.domain.radius
    return {
        "parameter": rung.parameter,
        "rays": len(certified),
        "decided": int(decided.sum()),
        "right": count(Wrong.RIGHT),
        "misses": count(Wrong.MISS),
        "false_hits": count(Wrong.FALSE_HIT),
        "exhausted": count(Wrong.EXHAUSTED),
        "wrong_root": count(Wrong.WRONG_ROOT),
        "invalid": count(Wrong.INVALID),
        "undecidable": int(undecidable.sum()),
        "undecidable_right": int((undecidable & right).sum()),
        "undecided": int((~certified).sum()),
        "max_error": float(error.max()) if len(error) else None,
        "worst_ratio": float((error / allowed).max()) if len(error) else None,
    }


def judge_group(group: Group, hits: Hits, truth: Truth, precision: Precision) -> list[RungVerdict]:
    """Return the verdict of `judge_rung` on each rung of a group; hits and truth are of `group.rays`."""
    verdicts, start = [], 0
    for rung in group.rungs:
        part = slice(start, start + len(rung.rays))
        verdicts.append(judge_rung(rung, _part(hits, part), _part(truth, part), precision))
        start = part.stop
    return verdicts


def _part(whole: PerRay, part: slice) -> PerRay:
    """Return the answers or the truth of some of the rays."""
    return type(whole)(**{name: values[part] for name, values in vars(whole).items()})


def share_right(verdict: Mapping[str, Any]) -> float | None:
    """Return the share of decided rays answered rightly; None where there are none, so that nothing can be said."""
    return verdict["right"] / verdict["decided"] if verdict["decided"] else None
