"""Checks against what is no number, infinite, negative, unknown, empty or undecided: nothing of it passes."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import surfaces
from harness import conformance
from harness.conformance import Case, Finding, view_case
from harness.conformance.checks import CLAIM_CHECKS
from harness.conformance.knobs import swept
from harness.contract import Hits, RayStatus, TruthStatus
from harness.plugins import find_methods

CASE = view_case(surfaces.get("torus"))
CLAIMS = (
    conformance.no_missed_root,
    conformance.conservative_bound,
    conformance.no_false_hit,
    conformance.error_below_tolerance,
)


def _right(case: Case = CASE) -> Hits:
    """The oracle's own answers."""
    t = np.where(case.there, 0.5 * (case.truth.lower + case.truth.upper), np.nan)
    status = np.where(case.there, RayStatus.HIT, RayStatus.MISS).astype(np.uint8)
    return Hits(t, status, np.ones(len(t), np.int32))


def _all(hits: Hits, case: Case = CASE, setting: str = "") -> list[Finding]:
    plugin = find_methods().get("ray_march")
    claims = [check(plugin, hits, case, "float32", {}) for check in CLAIMS]
    found = [
        conformance.decided(case),
        conformance.answers(hits, case),
        *conformance.agreement(hits, case, "float32", setting),
    ]
    return [*found, *claims]


def _failing(found: list[Finding]) -> set[str]:
    return {finding.check.split(",")[0] for finding in found if finding.fails}


def test_the_oracles_own_answers_pass_every_check():
    found = _all(_right())
    assert len(found) == 8 and all(finding.holds for finding in found)


@pytest.mark.parametrize("limit", [0.0, 1.0, np.inf])
@pytest.mark.parametrize("value", [np.nan, -np.nan])
def test_what_is_no_number_holds_under_no_limit(value, limit):
    assert Finding("check", value, limit, "rule").fails
    assert Finding("check", limit, value, "rule").fails


def test_what_was_not_checked_neither_holds_nor_fails():
    finding = conformance.not_checked("check", "reason")
    assert not finding.holds and not finding.fails


@pytest.mark.parametrize("t", [np.nan, np.inf, -np.inf, -1e6, 1e30])
@pytest.mark.parametrize("share", [0.05, 1.0])
def test_a_hit_at_no_place_in_the_domain_is_wrong(t, share):
    hits = _right()
    hit = np.flatnonzero(hits.status == RayStatus.HIT)
    hits.t[hit[: int(share * len(hit))]] = t
    failing = _failing(_all(hits))
    assert {"answers", "right answers", "conservative_bound"} <= failing
    if t != -1e6 and t != -np.inf:
        assert "no_missed_root" in failing


def test_an_unknown_status_is_no_miss():
    hits = _right()
    hits.status[hits.status == RayStatus.MISS] = 200
    assert {"answers", "no_false_hit"} <= _failing(_all(hits))


def test_negative_evaluations_are_no_answer():
    hits = _right()
    hits.evaluations[0] = -(10**6)
    assert _failing(_all(hits)) == {"answers"}


def _with(case: Case, **values: np.ndarray) -> Case:
    return dataclasses.replace(case, truth=dataclasses.replace(case.truth, **values))


@pytest.mark.parametrize(("share", "holds"), [(0.005, True), (0.02, False), (1.0, False)])
def test_undecided_hits_are_bounded(share, holds):
    status = CASE.truth.status.copy()
    hit = np.flatnonzero(CASE.there)
    status[hit[: round(share * len(hit))]] = TruthStatus.UNDECIDED
    finding = conformance.decided(_with(CASE, status=status))
    assert finding.holds is holds
    assert f"{round(share * len(hit))} undecided" in finding.detail


def test_where_no_ray_is_clear_right_answers_are_not_checked_and_without_hits_nothing_passes():
    grazing = _with(CASE, margin=np.zeros_like(CASE.truth.margin))
    found = _all(_right(grazing), grazing)
    unchecked = {finding.check.split(",")[0] for finding in found if finding.unchecked}
    assert unchecked == {"right answers", "conservative_bound", "no_false_hit", "error_below_tolerance"}
    missed = _with(CASE, status=np.full_like(CASE.truth.status, TruthStatus.MISS))
    assert "truth" in _failing(_all(_right(missed), missed))


def test_missing_every_root_measures_no_error_and_fails():
    hits = _right()
    hits.status[:] = RayStatus.MISS
    failing = [finding for finding in _all(hits) if finding.fails and finding.check.startswith("error,")]
    assert len(failing) == 1 and np.isnan(failing[0].value)


def test_a_setting_of_a_paper_may_be_coarser_and_no_more():
    for error, default, setting in ((5e-4, True, True), (5e-3, False, True), (2e-2, False, False)):
        hits = _right()
        hits.t[:] += error * CASE.radius
        for name, allowed in (("", default), ("Sturm", setting)):
            found = [finding for finding in _all(hits, setting=name) if finding.check.startswith("error,")]
            assert [finding.holds for finding in found] == [allowed]


def test_each_view_is_judged_by_itself():
    case = conformance.views_case(surfaces.get("torus"))
    hits = _right(case)
    start = 0
    for name, count in case.views:
        broken = dataclasses.replace(hits, status=hits.status.copy())
        broken.status[start : start + count] = RayStatus.MISS
        failing = [f.check for f in conformance.agreement(broken, case, "float32") if f.fails]
        assert failing and all(check.endswith(f"view {name}") for check in failing)
        start += count


class _Bench:
    """Answers with errors that depend on a knob by `error`."""

    def __init__(self, error):
        self.error = error

    def cast(self, _plugin, case, _precision, **knobs):
        hits = _right(case)
        hits.t[:] += self.error(knobs["EPSILON"]) * case.radius
        return hits


@pytest.mark.parametrize(
    ("error", "expected"),
    [
        (lambda epsilon: epsilon, [True, True]),
        (lambda _: 1e-7, [True, True]),  # at float32's end at all settings
        (lambda _: 1e-4, [True, False]),  # the knob does nothing
        (lambda epsilon: 1e-6 / epsilon, [False, False]),
        (lambda epsilon: 1.0 if epsilon < 1e-4 else epsilon, [False, False]),  # the finest settings lose all roots
        (lambda _: np.nan, [False, False]),
        (lambda _: 1.0, [False, False]),  # no setting answers rightly
    ],
)
def test_a_knob_is_held_to_what_it_says_above_the_floor_of_float32(error, expected):
    plugin = find_methods().get("newton")
    knob = next(parameter for parameter in plugin.method.parameters if parameter.finer)
    assert [finding.holds for finding in swept(_Bench(error), plugin, CASE, knob, {})] == expected


def test_two_roots_at_one_place_are_not_told_apart_and_others_are():
    hits = _right()
    near, far = (_with(CASE, following=CASE.truth.upper + gap * CASE.radius) for gap in (1e-7, 1e-3))
    hits.t[:] += 8e-7 * CASE.radius
    assert all(
        conformance.no_missed_root(find_methods().get("null"), hits, c, "float32", {}).holds for c in (near, far)
    )
    hits.t[:] += 8e-4 * CASE.radius
    assert all(
        conformance.no_missed_root(find_methods().get("null"), hits, c, "float32", {}).fails for c in (near, far)
    )


@pytest.mark.parametrize("claim", ["no_false_hit", "error_below_tolerance"])
def test_a_claim_of_an_f_that_does_not_jump_is_not_checked_where_it_may(claim):
    """A jump across 0 is taken for a root: where there is none, or close to one, as that of an angle near its cut."""
    jumping = dataclasses.replace(CASE, surface=surfaces.from_formula("floor(x) + y^2 + z^2 - 0.5"))
    found = CLAIM_CHECKS[claim](find_methods().get("ray_march"), _right(), jumping, "float32", {})
    assert found.unchecked == "f may jump (floor), and the claim is for an f that does not"
