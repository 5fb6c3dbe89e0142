"""Claims of toledo2007."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from typing import Literal

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from reports import wording
from reports.analysis import count_tests, derive
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import (
    Claim,
    Judge,
    Verdict,
    at_least,
    beside,
    both,
    cases,
    count,
    counted,
    every,
    faster,
    known,
    largest,
    quantities,
    untestable,
    verdict,
)
from reports.reading.tuples import tuples

PAPER = "toledo2007"
_WRONG = ("wrong_rays", "grazing_wrong_rays")
VIEWS = "toledo-fig4.toml"
UNEVEN = 2.0  # the failures depend on the view where one view has more than this many times another's
MANY_WRONG = 0.001  # a share of wrong rays that is smaller by a test is called “very good”
FINE = (picks.STURM, picks.NEWTON_5)  # the finest of Table 1, which prints errors of 25e-6 r and 30e-6 r for them
SLOWER = 1.5  # the least ratio of evaluations on grazing rays and on others that is called slow


def _sturm_depends_on_the_view(evidence: Evidence) -> Verdict | None:
    """Judge by rays that begin where the paper's do.

    The figure adds rays from the eye, which is another reading of the paper's o.
    """
    found, other = (_uneven(evidence, pick) for pick in (picks.STURM, picks.STURM_FROM_EYE))
    if found is None or other is None:
        return found
    return replace(found, figure=f"{found.figure}. With o read as the eye: {other.figure} ({other.outcome})")


def _uneven(evidence: Evidence, pick: Pick) -> Verdict | None:
    """Judge whether one view has more than UNEVEN times the wrong rays of another."""
    rows = evidence.rows(pick, picks.TORUS)
    if rows["view"].nunique() < 2:
        return None
    found = rows.assign(bad=rows["wrong_rays"].astype("float64") + rows["grazing_wrong_rays"].astype("float64"))
    if found[["bad", "accuracy_rays"]].isna().any(axis=None):
        return verdict(None, "a view has no count of wrong rays")
    found = found.sort_values("bad", kind="stable").drop_duplicates("view", keep="last")
    least, most = found.iloc[0], found.iloc[-1]
    figure = (
        f"wrong rays from {least['bad']:,.0f} (view {least['view']}) to {most['bad']:,.0f} (view {most['view']}) of "
        f"{most['accuracy_rays']:,} in float32"
    )
    exact = evidence.rows(pick, picks.TORUS, "float64")
    figure += "" if exact.empty else f"; in float64 {count(counted(exact, *_WRONG))} over {cases(exact)}"
    pairs = len(found) * (len(found) - 1) // 2
    held = (int(most["bad"]), int(most["accuracy_rays"]), int(least["bad"]), int(least["accuracy_rays"]))
    uneven = count_tests.exceeds(*held, UNEVEN, tries=pairs)
    return verdict(False if most["bad"] == 0 else uneven, figure)


def _bisection_is_free_of_them(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.BISECTION, picks.TORUS)
    if rows.empty:
        return None
    bad, of = counted(rows, "wrong_rays"), counted(rows, "accuracy_rays")
    error = largest(rows, "feature_error_max")
    figure = f"{count(bad)} wrong rays of {count(of)} over {cases(rows)}, largest error {wording.error(error)} r"
    if bad:
        worst = rows.loc[rows["wrong_rays"].astype("float64").idxmax()]
        figure += f"; most at view {worst['view']}: {worst['wrong_rays']:,}"
        ours = evidence.rows(picks.BISECTION_AT_BENDS, picks.TORUS)
        figure += "" if ours.empty else f"; parted at the roots of f'' instead: {count(counted(ours, 'wrong_rays'))}"
    return verdict(both(known(bad, lambda n: n == 0), known(error, lambda e: e <= 0.0014)), figure)


def _slow_near_grazing(evidence: Evidence) -> Verdict | None:
    near, far = [], []
    for row in tuples(evidence.rows(picks.ONE_RAY, picks.TORUS)):
        arrays = evidence.arrays(row)
        if arrays is not None and arrays.evaluations is not None and arrays.grazing.any():
            spent = arrays.evaluations > 0
            near.append(arrays.evaluations[spent & arrays.grazing])
            far.append(arrays.evaluations[spent & ~arrays.grazing])
    if not near:
        return None
    (a, a_reach), (b, b_reach) = (_mean(np.concatenate(found)) for found in (near, far))
    figure = (
        f"{wording.number(a)} ± {wording.number(a_reach)} evaluations per grazing ray, {wording.number(b)} ± "
        f"{wording.number(b_reach)} per other ray that spends any: {wording.factor(a / b)}"
    )
    return verdict(at_least((a - a_reach) / (b + b_reach), (a + a_reach) / (b - b_reach), SLOWER), figure)


def _mean(values: NDArray[np.int32]) -> tuple[float, float]:
    """Return the mean of values [n] and half its 99 % interval; NaN for fewer than two values."""
    if len(values) < 2:
        return math.nan, math.nan
    return float(values.mean()), float(2.576 * values.std(ddof=1) / math.sqrt(len(values)))


def _more_precise(evidence: Evidence) -> Verdict | None:
    """Judge by the picks FINE, view by view; the figure adds the errors of the coarser settings of Table 1."""
    closed, planes = (evidence.rows(pick, picks.TORUS) for pick in (picks.LOOP_BLINN, picks.BETWEEN_PLANES))
    told, held = [f"{picks.LOOP_BLINN.words} {wording.error(largest(closed, 'feature_error_max'))} r"], []
    if len(planes):
        told.append(f"{picks.BETWEEN_PLANES.words} {wording.error(largest(planes, 'feature_error_max'))} r")
    for pick in picks.TABLE_1:
        rows = evidence.rows(pick, picks.TORUS)
        rows = rows.merge(closed[[*derive.GROUP, "feature_error_max"]], on=derive.GROUP, suffixes=("", "_closed"))
        if rows.empty:
            continue
        told.append(f"{pick.words} {wording.error(largest(rows, 'feature_error_max'))} r")
        if pick in FINE:
            less = rows["feature_error_max_closed"] - rows["feature_error_max"]
            held.append(every(less, lambda gain: gain > 0.0))
            told[-1] += (
                f" (larger than Loop-Blinn's in {int((less <= 0.0).sum())} of {wording.plural(len(less), 'case')})"
            )
    return verdict(both(*held), f"largest errors over {cases(closed)}: {', '.join(told)}") if held else None


def _planes(name: Literal["NEAR", "FAR"]) -> Judge:
    """Make a judge of "this plane changes the error of screen-space coefficients"."""
    other = {"NEAR": "FAR", "FAR": "NEAR"}[name]

    def decide(evidence: Evidence) -> Verdict | None:
        rows = evidence.finished("analytic", picks.TORUS)
        rows = rows[(rows["precision"] == "float32") & (rows["origin"] == evidence.origin)]
        knobs = pd.DataFrame([_knobs(text) for text in rows["parameters"]], index=rows.index)
        if rows.empty or name not in knobs:
            return None
        rows = rows.join(knobs)[(knobs["SCREEN"] == 1) & (knobs["POLISH"] == 0)]
        if rows["error_p99"].isna().any():
            return verdict(None, "a row has no error")
        spread = []
        for _, own in rows.groupby(["comparison", "device", other]):
            if own[name].nunique() > 1 and own["error_p99"].min() > 0:
                spread.append(own["error_p99"].max() / own["error_p99"].min())
        if not spread:
            return None
        return verdict(
            float(np.median(spread)) > 2.0,
            f"moving the {name.lower()} plane changes the 99th percentile of the error by {quantities(spread)}",
        )

    return decide


def _knobs(text: str) -> dict[str, float]:
    return dict(json.loads(text)) if isinstance(text, str) else {}


def _cubics(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.STURM)
    rows = rows[rows["degree"] == 3]
    if rows.empty:
        return None
    each = ", ".join(f"{row.surface_title} {wording.count(row.wrong_rays)}" for row in tuples(rows))
    bad, of = counted(rows, "wrong_rays"), counted(rows, "accuracy_rays")
    if bad is None or not of:
        return verdict(None, f"wrong rays away from silhouettes: {each}")
    more = count_tests.share_exceeds(bad, of, MANY_WRONG)
    told = f"wrong rays away from silhouettes: {each}; {wording.share(bad / of)} of all {of:,} rays"
    return verdict(None if more is None else not more, told)


def _evident_after_zooming(evidence: Evidence) -> Verdict | None:
    """Judge by the zoomed view with most wrong rays, silhouettes included.

    Near a singular point nearly every ray is at a silhouette.
    """
    rows = evidence.rows(picks.STURM, picks.CUBICS)
    if rows.empty:
        return None
    bad = rows[[*_WRONG, "drowned_wrong_rays"]].astype("float64").sum(axis=1, skipna=False)
    if bad.isna().any():
        return verdict(None, "a view has no count of wrong rays")
    worst = rows.loc[bad.idxmax()]
    most, of = int(bad.max()), int(worst["accuracy_rays"])
    figure = f"most on {worst['surface_title']}, {worst['view']}: {most} of {of:,} rays; {int(bad.sum())} over all "
    figure += wording.plural(len(rows), "view")
    return verdict(count_tests.share_exceeds(most, of, MANY_WRONG), figure)


CLAIMS = (
    Claim(
        PAPER,
        "1, 6",
        "Iterative methods are faster than closed forms (Loop and Blinn's), since they find one root only.",
        "Time of Loop-Blinn over Newton 0.001, torus, every view",
        beside(
            faster(picks.LOOP_BLINN, picks.NEWTON_3, picks.TORUS, "1,300 over 500 frames/s, 2.6×"),
            faster(picks.LOOP_BLINN, picks.NEWTON_3_FORWARDS, picks.TORUS),
            "steps forwards",
        ),
        ("newton", "analytic"),
        VIEWS,
    ),
    Claim(
        PAPER,
        "1, 2",
        "Iterative methods draw surfaces more precisely than closed forms (Loop and Blinn's).",
        "Largest errors over r, grazing rays left out: Sturm's and Newton 0.00003's under Loop-Blinn's, in each view",
        _more_precise,
        ("sturm", "newton", "analytic"),
        VIEWS,
    ),
    Claim(
        PAPER,
        "2",
        "Loop and Blinn's screen-space coefficients bring noise that depends on the near plane.",
        "99th percentile of the error with the near plane moved, the far one kept",
        _planes("NEAR"),
        ("analytic",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "2",
        "The same noise depends on the far plane.",
        "99th percentile of the error with the far plane moved, the near one kept",
        _planes("FAR"),
        ("analytic",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "3",
        "Sturm's quality on cubics is very good; errors appear close to singular points only.",
        "Wrong rays of Sturm on the cubics of Figure 2, under 0.1 %",
        _cubics,
        ("sturm",),
        "toledo-fig2.toml",
    ),
    Claim(
        PAPER,
        "3",
        "Close to singular points Sturm's errors on cubics are evident after zooming.",
        "Wrong rays of Sturm, silhouettes included, in the zoomed view with most of them: over 0.1 %",
        _evident_after_zooming,
        ("sturm",),
        "toledo-fig2-zoom.toml",
    ),
    Claim(
        PAPER,
        "3",
        "Fewer halvings make Sturm faster: an adaptive quality.",
        "Time of Sturm with 18 halvings over Sturm with 8",
        faster(picks.STURM, picks.STURM_SHORT, picks.TORUS),
        ("sturm",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.1",
        "Sturm fails for want of precision on the torus, and how often depends on the viewing angle.",
        f"Wrong rays of Sturm in float32, silhouettes included: of one view more than {UNEVEN:g} times another's",
        _sturm_depends_on_the_view,
        ("sturm",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.2",
        "Double derivative bisection is slower than Sturm.",
        "Time of D.D. Bisection over Sturm, torus, every view",
        beside(
            faster(picks.BISECTION, picks.STURM, picks.TORUS, "93 over 23 frames/s, 4×"),
            faster(picks.BISECTION_AT_BENDS, picks.STURM_BY_SIGN, picks.TORUS),
            "parted at the roots of f'', and Sturm by sign",
        ),
        ("double_derivative_bisection",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.2",
        "Double derivative bisection has none of Sturm's failures and keeps its error under 0.0014 r.",
        "Wrong rays away from silhouettes, and the largest error, over all views",
        _bisection_is_free_of_them,
        ("double_derivative_bisection",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.3",
        "Sphere tracing slows down where rays nearly touch the torus.",
        f"Evaluations on grazing rays over those on the others, at least {SLOWER}× by both means' 99 % intervals",
        _slow_near_grazing,
        ("sphere_tracing",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.3",
        "Two starts for each ray are faster than one.",
        "Time of Sphere Tracing over 2-rays S. Tracing, torus, every view",
        beside(
            faster(picks.ONE_RAY, picks.TWO_RAYS, picks.TORUS, "88 over 24 frames/s, 3.7×"),
            faster(picks.ONE_RAY, picks.TWO_RAYS_AHEAD, picks.TORUS),
            "a second march that never goes back",
        ),
        ("sphere_tracing",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "3",
        "300 frames/s on cubics.",
        "none",
        untestable,
        reason="an absolute speed of a GeForce 7900; the table of results says what this device does",
    ),
)
