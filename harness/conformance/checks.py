"""Check a method's answers on a case: each function measures one thing, and returns it with its limit and its rule."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from harness.accuracy.answers import validated
from harness.accuracy.judge import FAR, NAMES, Wrong
from harness.conformance.cases import INSIDE, TYPICAL, Case, Finding, not_checked
from harness.contract import CLAIMS, UNIT_ROUNDOFF, Hits, Precision, RayStatus, TruthStatus, plural
from harness.oracle.noise import root_shift
from harness.plugins import Plugin
from surfaces.evaluation import tape_of
from surfaces.proofs.slopes import jumps

MOST_UNDECIDED = 0.01  # of the rays that hit or may: a pass needs decided hits
MOST_WRONG = 0.002  # of a typical surface's clear rays
MOST_WRONG_INSIDE = 0.01  # the same where the eye is inside the domain: the papers start their rays outside
MOST_WRONG_ELSEWHERE = 0.1  # of any other surface's: beyond its paper's surfaces a method may be weak, but not useless
MOST_WRONG_ELSEWHERE_INSIDE = 0.25  # the same where the eye is inside the domain, and so perhaps inside the surface
MOST_EXHAUSTED_ELSEWHERE = 0.5  # of such a surface's: a method may give up, as long as it says so and answers most rays
MOST_EXHAUSTED_OF_A_SETTING = 0.65  # from outside; toledo2007's Newton as printed turns back in the Barth sextic's dips
MOST_ERROR = 1e-3  # radii, of 99 of 100 right hits on a typical surface
MOST_ERROR_ELSEWHERE = 1e-2  # the same on any other surface, and at a paper's own setting, which may be coarse
ROUNDINGS = 64.0  # times condition × unit roundoff × radius: what rounding may add to an error
SAME_ROOT = 1e-6  # radii: roots nearer to each other count as one, since no t in float32 tells them apart


def decided(case: Case) -> Finding:
    """Check that the oracle decides nearly all rays that hit or may hit, and that some hit."""
    hits, open_ = int(case.there.sum()), int((case.truth.status == TruthStatus.UNDECIDED).sum())
    return Finding(
        "truth",
        open_ / (hits + open_) if hits else np.nan,
        MOST_UNDECIDED,
        "share of the rays that hit or may hit which the oracle leaves undecided; without decided hits none passes",
        f"{plural(hits, 'hit')} decided, {open_} undecided, of {plural(len(case.rays), 'ray')}",
        "check it on another surface: of this one nothing certain is known",
    )


def answers(hits: Hits, case: Case) -> Finding:
    """Check that a hit has a finite t inside the domain and nothing else has one, and that evaluations are counted."""
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
    """Check that the answers of two casts are the same to the last bit."""
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
    """Check, in each view, that nearly all answers on clear rays are right, and that right hits are near their roots.

    `setting` is the name of the paper's setting by which the method answered, or "" for the method's default. A setting
    of a paper may be weaker than the default, and has looser limits.
    """
    for view, part, answered in case.parts(hits):
        yield from _agreement(f", view {view}" if view else "", part, answered, precision, setting)


def _agreement(view: str, case: Case, hits: Hits, precision: Precision, setting: str) -> Iterator[Finding]:
    """Check one view; `view` is ", view " and its name, or "", as the names of findings end."""
    verdicts = case.judged(hits, precision)
    clear = case.clear(verdicts)
    if not clear.any():  # as of a thin torus, where every ray nearly misses, or a surface that is only touched
        yield not_checked(f"right answers{view}", "no ray is clear")
        return
    typical = case.surface.name in TYPICAL and not setting
    wrong = np.where(clear, verdicts.wrong, Wrong.RIGHT)
    gave_up = wrong == Wrong.EXHAUSTED
    nowhere = clear & case.there & (wrong == Wrong.RIGHT) & ~np.isfinite(verdicts.error)  # right by no measured error
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
    """Check the errors, in scene radii, of right hits."""
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
    """Describe the first bad ray and its answer, so that one knows where to look; "" where no ray is bad."""
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
    """Return bool[n]: true where a ray has a first root and its answer is a miss, a later hit or impossible.

    A hit before the root does not pass the root, whatever else is wrong with it. Nor does a ray that gave up.
    """
    between = case.truth.upper + np.fmax(0.5 * (case.truth.following - case.truth.upper), SAME_ROOT * case.radius)
    found = (hits.status == RayStatus.HIT) & (hits.t <= np.fmin(between, case.truth.upper + FAR * case.radius))
    found &= hits.t >= -FAR * case.radius  # a ray cannot stop behind its start
    return np.asarray(case.there & ~found & (hits.status != RayStatus.EXHAUSTED))


def no_missed_root(_plugin: Plugin, hits: Hits, case: Case, _precision: Precision, _knobs: Knobs) -> Finding:
    """Check the claim that no first root is missed or passed, near tangency too."""
    rule = "roots that were missed or passed, also near tangency"
    return _claim("no_missed_root", _passed(hits, case), case.there, rule, hits, case)


def conservative_bound(_plugin: Plugin, hits: Hits, case: Case, precision: Precision, _knobs: Knobs) -> Finding:
    """Check the claim that no first root of a clear ray is missed or passed."""
    there = case.there & case.clear(case.judged(hits, precision))
    rule = "roots that were missed or passed, on clear rays"
    return _claim("conservative_bound", _passed(hits, case) & there, there, rule, hits, case)


def _jumps(case: Case) -> str | None:
    """Say why claims of an f that does not jump are not checked; None where f does not."""
    found = jumps(tape_of(case.surface))
    return f"f may jump ({', '.join(found)}), and the claim is for an f that does not" if found else None


def no_false_hit(_plugin: Plugin, hits: Hits, case: Case, precision: Precision, _knobs: Knobs) -> Finding:
    """Check the claim that no clear ray hits where the oracle proves a miss; it is made of an f that does not jump."""
    if reason := _jumps(case):
        return not_checked("no_false_hit", reason)
    misses = (case.truth.status == TruthStatus.MISS) & case.clear(case.judged(hits, precision))
    false = misses & ~np.isin(hits.status, (RayStatus.MISS, RayStatus.EXHAUSTED))
    return _claim("no_false_hit", false, misses, "hits where the oracle proves a miss, on clear rays", hits, case)


def rounding_adds(case: Case, precision: Precision) -> NDArray[np.float64]:
    """Return float64[n], scene units: how much rounding may add to a right hit's error; NaN without a root.

    It is the larger of two numbers. One is ROUNDINGS times the root's condition × unit roundoff × radius. The other is
    the error that a kernel's f may have there, over f's slope: it is the larger one for forty terms of degree 20, or
    where f is expanded along the ray with terms that are larger than its own.
    """
    conditioned = ROUNDINGS * np.fmax(case.truth.condition, 1.0) * case.surface.domain.radius
    kernels = root_shift(case.surface, case.rays.astype(np.float64), case.truth.lower)
    return np.asarray(UNIT_ROUNDOFF[precision] * np.fmax(conditioned, kernels))


def error_below_tolerance(plugin: Plugin, hits: Hits, case: Case, precision: Precision, knobs: Knobs) -> Finding:
    """Check the claim that a right hit on a clear ray is off its root by at most Method.tolerance and rounding.

    It is made of an f that does not jump: a jump across 0 close to the root may be taken for it.
    """
    assert plugin.method.tolerance
    if reason := _jumps(case):
        return not_checked("error_below_tolerance", reason)
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
    """Check the claim that every ray which touches the surface hits it there; `case` is one of touch_cases."""
    near = np.abs(hits.t - case.truth.lower) < FAR * case.radius
    found = (hits.status == RayStatus.HIT) & near
    everywhere = np.ones(len(found), bool)
    return _claim("finds_touch", ~found, everywhere, f"touches of {case.surface.name} that were not hit", hits, case)


def _claim(
    name: str, broken: NDArray[np.bool_], asked: NDArray[np.bool_], rule: str, hits: Hits, case: Case
) -> Finding:
    """Make the finding of a claim about the rays `asked`, bool[n], which the rays `broken`, bool[n], contradict."""
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
