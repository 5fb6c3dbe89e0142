"""Check what every method must keep, in the same way for the tests and for `firsthit conform`.

A method's answers are held against the oracle and against the claims that it states. Its knobs must move the error the
way that it says, and every answer must be the same to the last bit when it is cast again.

Each check says what it measured, the limit, and the rule for both. It fails where the measured value is above the limit
or NaN. What could not be measured is named, and is not a pass. Rays nearer than GRAZING scene radii to another answer,
and rays on which f drowns in its own rounding, count only where a claim says so. Rays that the oracle leaves undecided
count as neither right nor wrong; how many there may be is limited.

**Views** Four are from outside: oblique, along an axis, down a pole, and from below. One has its eye inside the domain;
its limit for wrong answers is wider, since the papers start their rays outside.

A method that casts tiles has no listed rays. Its views are cast as frames of at least FRAME pixels a side, in which
the checked rays are middles of pixels, and the rays of dense polynomials and of touches each as the middle of a small
frame (harness/experiment/kinds/tiles.py). Other methods that answer for pixels, and not for rays, are not checked.

**Surfaces** On TYPICAL surfaces nearly every answer must be right. On others a method may be weak, but not useless.

**Settings** The papers' own settings (Method.settings) are held to the same claims as the default, and otherwise to the
limits of a surface that is not typical, since a paper may prefer speed (its thresholds) or leave out what would cure
some rays: toledo2007's Newton gives up on up to 0.61 of the rays at the Barth sextic. From inside the domain a setting
may give up on any share. A weakness that a method's page describes, but that is no setting of it, is not checked.
"""

from harness.conformance.bench import bench_on, checkable, findings
from harness.conformance.cases import (
    GRAZING,
    TYPICAL,
    VIEWS,
    Bench,
    Case,
    Finding,
    joined,
    not_checked,
    refusal,
    touch_cases,
    view_case,
    views_case,
)
from harness.conformance.checks import (
    MOST_UNDECIDED,
    agreement,
    answers,
    conservative_bound,
    decided,
    error_below_tolerance,
    finds_touch,
    no_false_hit,
    no_missed_root,
    rounding_adds,
    same_bits,
)
from harness.conformance.examine import (
    EXAMINATIONS,
    examine,
    examine_knobs,
    examine_touches,
)
from harness.conformance.knobs import settings_of, swept

__all__ = [
    "EXAMINATIONS",
    "GRAZING",
    "MOST_UNDECIDED",
    "TYPICAL",
    "VIEWS",
    "Bench",
    "Case",
    "Finding",
    "agreement",
    "answers",
    "bench_on",
    "checkable",
    "conservative_bound",
    "decided",
    "error_below_tolerance",
    "examine",
    "examine_knobs",
    "examine_touches",
    "findings",
    "finds_touch",
    "joined",
    "no_false_hit",
    "no_missed_root",
    "not_checked",
    "refusal",
    "rounding_adds",
    "same_bits",
    "settings_of",
    "swept",
    "touch_cases",
    "view_case",
    "views_case",
]
