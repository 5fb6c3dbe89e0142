"""Judge a method's answers on a rung: counts of right and wrong ones, and errors over what the problem allows.

Unlike in views, rays near tangency are not excused here. What no arithmetic of the cell's precision can know is told
apart from what a method gets wrong. A kernel evaluates f at o + t·d. The three coordinates are rounded when the origin
is moved, when t·d is formed and when it is added, and constants are rounded once. Points are then off by up to
ROUNDINGS · unit roundoff · their size, which is at most that of the domain. If such a shift can turn a ray into one
with other roots, the ray is `undecidable` and counted apart: the margin of the oracle, or of the rung by construction,
is then smaller than the shift. The distance to the origin is no part of that size: the origin is given exactly and can
be moved near without a loss.

Views have a class of drowned rays beside the grazing one (harness.accuracy.judge), which is another class. There f's
value is off, by its own roundings and by those of the point at that very place. So flat places count there, and places
whose size is far below the domain's do not. Neither class contains the other. Families use the errors of points alone:
their ladders are built along a distance, and `undecidable` says where that distance becomes too small, whatever the
formula.
"""

from __future__ import annotations

import math
from typing import TypeVar

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
    """Return the margin, in scene units, below which a ray of this rung is undecidable."""
    domain = rung.surface.domain
    return ROUNDINGS * UNIT_ROUNDOFF[precision] * (domain.radius + math.hypot(*domain.center))


def judge_rung(rung: Rung, hits: Hits, truth: Truth, precision: Precision) -> RungVerdict:
    """Return counts, errors in scene units, and stability; all of it JSON-able.

    rays = decided + undecidable + undecided, and decided = right + misses + false_hits + exhausted + wrong_root +
    invalid. An INVALID answer is wrong whatever the truth, so that its ray is a decided one.

    undecidable_right: undecidable rays that are answered as the oracle does
    max_error: the largest |t - t*| over `right` rays that hit; None if there are none
    worst_ratio: the largest |t - t*| over max(condition, 1) · unit roundoff · the domain's radius, of the same rays; no
        t can be had better than with condition 1. A backward stable method's ratio is a small number on every rung
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


def share_right(verdict: RungVerdict) -> float | None:
    """Return the share of decided rays answered rightly; None where there are none, so that nothing can be said."""
    return verdict["right"] / verdict["decided"] if verdict["decided"] else None
