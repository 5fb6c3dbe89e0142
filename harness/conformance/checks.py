"""A function for each check of a method's answers on a case, which returns what it measured, its limit and its rule."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated
from harness.accuracy.judge import FAR, NAMES, Wrong
from harness.conformance.cases import INSIDE, TYPICAL, Case, Finding, not_checked
from harness.contract import CLAIMS, UNIT_ROUNDOFF, Hits, Precision, RayStatus, TruthStatus
from harness.oracle.noise import root_shift
from harness.plugins import Plugin

MOST_UNDECIDED = 0.01  # of the rays that hit or may: a pass needs decided hits
MOST_WRONG = 0.002  # of a typical surface's clear rays
MOST_WRONG_INSIDE = 0.01  # of these where the eye is inside the domain: the papers start their rays outside
MOST_WRONG_ELSEWHERE = 0.1  # of any other surface's: beyond its paper's surfaces a method may be weak, never useless
MOST_WRONG_ELSEWHERE_INSIDE = 0.25  # of these where the eye is inside the domain, and so maybe inside the surface
MOST_EXHAUSTED_ELSEWHERE = 0.5  # of these: it may give up, as long as it says so and answers most rays
MOST_EXHAUSTED_OF_A_SETTING = (
    0.65  # from outside: toledo2007's Newton as printed turns back in dips of the Barth sextic
)
MOST_ERROR = 1e-3  # radii, of 99 of 100 right hits on a typical surface
MOST_ERROR_ELSEWHERE = 1e-2  # the same on any other surface, and at a paper's own setting, which may be coarse
ROUNDINGS = 64.0  # of condition × roundoff × radius: what an error may have beside its tolerance
SAME_ROOT = 1e-6  # radii: roots nearer to each other are not told apart, as no t in float32 tells them


def decided(case: Case) -> Finding:
    """The oracle decides nearly all rays that hit or may, and some hit."""
    hits, open_ = int(case.there.sum()), int((case.truth.status == TruthStatus.UNDECIDED).sum())
    return Finding(
        "truth",
        open_ / (hits + open_) if hits else np.nan,
        MOST_UNDECIDED,
        "share of the rays that hit or may hit which the oracle leaves undecided; without decided hits none passes",
        f"{hits} hits decided, {open_} undecided, of {len(case.rays)} rays",
        "check it on another surface: of this one nothing certain is known",
    )


def answers(hits: Hits, case: Case) -> Finding:
    """A hit has a finite t inside the domain, nothing else has one, and evaluations are counted."""
    bad = validated(hits, case.surface.domain, case.rays).status == RayStatus.INVALID
    return Finding(
        "answers",
        int(bad.sum()),
        0,
        "rays with a status that is none, a count out of range, or a hit whose t is not finite or outside the domain",
        f"{(hits.status == RayStatus.HIT).sum()} hits" + _first(bad, hits, case),
        "end with hit_at(hit, t) for a finite t in [t0, t1], else with missed or exhausted, and count evaluations up",
    )


def same_bits(hits: Hits, again: Hits) -> Finding:
    """Cast twice, every answer is the same to the last bit."""
    differs = hits.t.view(np.uint64) != again.t.view(np.uint64)
    differs |= (hits.status != again.status) | (hits.evaluations != again.evaluations)
    return Finding(
        "same from run to run",
        int(differs.sum()),
        0,
        "rays whose answer differs in any bit when they are cast again",
        f"of {len(differs)}",
        "look for a local or an array's element that is read before it is set",
    )


def agreement(hits: Hits, case: Case, precision: Precision, setting: str = "") -> Iterator[Finding]:
    """On clear rays, neither grazing nor drowned, nearly every answer is right, and right hits are near their roots.

    View by view.

    `setting` is the name of the paper's setting that the answers are of: it may be weaker than the default.
    """
    for view, part, answered in case.parts(hits):
        yield from _agreement(f", view {view}" if view else "", part, answered, precision, setting)


def _agreement(view: str, case: Case, hits: Hits, precision: Precision, setting: str) -> Iterator[Finding]:
    verdicts = case.judged(hits, precision)
    clear = case.clear(verdicts)
    if not clear.any():  # a thin torus, whose every ray is near to missing it; a surface that is only touched
        yield not_checked(f"right answers{view}", "no ray is clear")
        return
    typical = case.surface.name in TYPICAL and not setting
    wrong = np.where(clear, verdicts.wrong, Wrong.RIGHT)
    gave_up = wrong == Wrong.EXHAUSTED
    nowhere = clear & case.there & (wrong == Wrong.RIGHT) & ~np.isfinite(verdicts.error)  # no number shows them right
    wrongly = nowhere | (wrong != Wrong.RIGHT if typical else (wrong != Wrong.RIGHT) & ~gave_up)
    limits = (MOST_WRONG, MOST_WRONG_INSIDE) if typical else (MOST_WRONG_ELSEWHERE, MOST_WRONG_ELSEWHERE_INSIDE)
    counts = ", ".join(f"{(wrong == kind).sum()} {name}" for kind, name in NAMES.items() if (wrong == kind).any())
    whose = "a setting of the paper" if setting else "a typical surface" if typical else "a surface that is not typical"
    yield Finding(
        f"right answers{view}",
        float(wrongly.sum() / clear.sum()),
        limits[view.endswith(INSIDE)],
        f"share of wrong answers on clear rays, on {whose}",
        f"{counts or 'none wrong'} of {clear.sum()}" + _first(wrongly, hits, case),
        ("look for a loop that does not end (a driver that ends it exhausts its rays), " if gave_up.any() else "")
        + "mend the kernel, or refuse such surfaces in Method.accepts",
    )
    if not typical and not (setting and view.endswith(INSIDE)):
        yield Finding(
            f"gives up seldom{view}",
            float(gave_up.sum() / clear.sum()),
            MOST_EXHAUSTED_OF_A_SETTING if setting else MOST_EXHAUSTED_ELSEWHERE,
            f"share of clear rays that end as exhausted, on {whose}",
            advice="let it spend more evaluations on a ray, look for a loop that does not end (a driver that ends it "
            "exhausts its rays), or refuse such surfaces in Method.accepts",
        )
    if (clear & case.there).any():
        errors = verdicts.error[clear & case.there & (wrong == Wrong.RIGHT)] / case.radius
        yield _near_roots(view, errors, MOST_ERROR if typical else MOST_ERROR_ELSEWHERE, whose)


def _near_roots(view: str, errors: NDArray[np.float64], limit: float, whose: str) -> Finding:
    """`errors` of right hits, in scene radii."""
    p99 = float(np.quantile(errors, 0.99)) if len(errors) else np.nan
    return Finding(
        f"error{view}",
        p99,
        limit,
        f"error in scene radii that 99 of 100 right hits stay below, on {whose}",
        f"{len(errors)} right hits",
        "end with a step that refines the root (secant, bisection, Newton), or stop at a smaller step",
    )


def _first(bad: NDArray[np.bool_], hits: Hits, case: Case) -> str:
    """Where to look: the first bad ray, and what was answered."""
    if not bad.any():
        return ""
    row = int(np.argmax(bad))
    origin, direction = (", ".join(f"{x:.9g}" for x in part) for part in np.split(case.rays[row], 2))
    truth = TruthStatus(case.truth.status[row]).name.lower()
    right = f"{truth} at {case.truth.lower[row]:.9g}" if case.there[row] else truth
    return (
        f"; first from ({origin}) along ({direction}): "
        f"status {hits.status[row]} at {hits.t[row]:.9g}, the oracle says {right}"
    )


# Claims


def _passed(hits: Hits, case: Case) -> NDArray[np.bool_]:
    """bool[n]: first roots that were answered as a miss, by something later or by nothing that is an answer.

    A hit before the root passes none, whatever else is wrong with it; nor does a ray that gave up.
    """
    between = case.truth.upper + np.fmax(0.5 * (case.truth.following - case.truth.upper), SAME_ROOT * case.radius)
    found = (hits.status == RayStatus.HIT) & (hits.t <= np.fmin(between, case.truth.upper + FAR * case.radius))
    found &= hits.t >= -FAR * case.radius  # what lies behind the ray's start is no place that it could stop at
    return np.asarray(case.there & ~found & (hits.status != RayStatus.EXHAUSTED))


def no_missed_root(_plugin: Plugin, hits: Hits, case: Case, _precision: Precision, _knobs: Knobs) -> Finding:
    rule = "roots that were missed or passed, also near tangency"
    return _claim("no_missed_root", _passed(hits, case), case.there, rule, hits, case)


def conservative_bound(_plugin: Plugin, hits: Hits, case: Case, precision: Precision, _knobs: Knobs) -> Finding:
    there = case.there & case.clear(case.judged(hits, precision))
    rule = "roots that were missed or passed, on clear rays"
    return _claim("conservative_bound", _passed(hits, case) & there, there, rule, hits, case)


def no_false_hit(_plugin: Plugin, hits: Hits, case: Case, precision: Precision, _knobs: Knobs) -> Finding:
    misses = (case.truth.status == TruthStatus.MISS) & case.clear(case.judged(hits, precision))
    false = misses & ~np.isin(hits.status, (RayStatus.MISS, RayStatus.EXHAUSTED))
    return _claim("no_false_hit", false, misses, "hits where the oracle proves a miss, on clear rays", hits, case)


def rounding_adds(case: Case, precision: Precision) -> NDArray[np.float64]:
    """float64[n], scene units: what rounding may add to a right hit's error; NaN without a root.

    ROUNDINGS of the root's condition, or what kernels may be off in f's value over f's slope there, where that is more:
    with forty terms of degree 20, or an expansion along the ray whose terms are larger than f's own.
    """
    conditioned = ROUNDINGS * np.fmax(case.truth.condition, 1.0) * case.surface.domain.radius
    kernels = root_shift(case.surface, case.rays.astype(np.float64), case.truth.lower)
    return np.asarray(UNIT_ROUNDOFF[precision] * np.fmax(conditioned, kernels))


def error_below_tolerance(plugin: Plugin, hits: Hits, case: Case, precision: Precision, knobs: Knobs) -> Finding:
    assert plugin.method.tolerance
    tolerance = plugin.method.tolerance(case.surface, dict(plugin.variant(knobs).parameters))
    verdicts = case.judged(hits, precision)
    measured = case.clear(verdicts) & case.there & (verdicts.wrong == Wrong.RIGHT)
    if not measured.any():
        return not_checked("error_below_tolerance", "no right hit on a clear ray")
    excess = verdicts.error[measured] / (tolerance + rounding_adds(case, precision)[measured])
    return Finding(
        "error_below_tolerance",
        float(np.max(excess)),
        1.0,
        f"largest error over Method.tolerance, here {tolerance:.1e}, and what roundings may move the root by",
        f"{measured.sum()} right hits",
        "state the tolerance that the kernel reaches, or withdraw the claim from Method.claims",
    )


def finds_touch(hits: Hits, case: Case) -> Finding:
    near = np.abs(hits.t - case.truth.lower) < FAR * case.radius
    found = (hits.status == RayStatus.HIT) & near
    everywhere = np.ones(len(found), bool)
    return _claim("finds_touch", ~found, everywhere, f"touches of {case.surface.name} that were not hit", hits, case)


def _claim(
    name: str, broken: NDArray[np.bool_], asked: NDArray[np.bool_], rule: str, hits: Hits, case: Case
) -> Finding:
    if not asked.any():
        return not_checked(name, "no ray asks for it here")
    detail = f"of {asked.sum()}{_first(broken, hits, case)}"
    return Finding(
        name, int(broken.sum()), 0, rule, detail, "mend the kernel, or withdraw the claim from Method.claims"
    )


Knobs = Mapping[str, float]
CLAIM_CHECKS: dict[str, Callable[[Plugin, Hits, Case, Precision, Knobs], Finding]] = {
    "no_missed_root": no_missed_root,
    "no_false_hit": no_false_hit,
    "error_below_tolerance": error_below_tolerance,
    "conservative_bound": conservative_bound,
}
assert {*CLAIM_CHECKS, "finds_touch"} == CLAIMS.keys()
