"""What every method is held to, the same for tests and `firsthit conform`: answers against the oracle, the claims it
states, knobs that move the error the way it says, and the same bits from run to run.

Each check says what it measured, the limit, and the rule that both follow. What is not at most the limit fails, NaN
too, and what could not be measured is named and is no pass. Rays nearer than GRAZING scene radii to another answer,
and those on which f drowns in its own rounding, count only where a claim says so. Rays that the oracle leaves undecided
count as neither right nor wrong, and are bounded.

**Views** Four from outside (oblique, along an axis, down a pole, from below), and one with the eye inside the domain,
whose limit for wrong answers is wider: the papers start their rays outside.

**Surfaces** On TYPICAL ones nearly every answer must be right. On others a method may be weak, never useless.

**Settings** The papers' own settings (Method.settings) are held to the same claims as the default, and otherwise to the
limits of a surface that is not typical, since a paper may prefer speed (its thresholds) or leave out what would cure
some rays (toledo2007's Newton gives up on up to 0.61 of the Barth sextic's). From inside the domain a setting may give
up on any share. What a method's page calls weak without naming it a setting is not checked.
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
    rotation,
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
    "rotation",
    "rounding_adds",
    "same_bits",
    "settings_of",
    "swept",
    "touch_cases",
    "view_case",
    "views_case",
]
