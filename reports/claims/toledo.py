"""What toledo2007 claims."""

from __future__ import annotations

import json
from collections.abc import Callable

import numpy as np
import pandas as pd

from reports import derive, wording
from reports.claims import picks
from reports.claims.model import Claim, Verdict, faster, quantities, untestable, verdict, wrong
from reports.evidence import Evidence, Pick

PAPER = "toledo2007"
VIEWS = "toledo-fig4.toml"
UNEVEN = 2.0  # a view has more failures than another where it has this many times as many
MORE_STEPS = 1.0  # doubling the digits of 0.001 r gives more than 0.00003 r has
SLOWER = 1.5  # more evaluations near grazing than elsewhere, to call it slow there


def _newton_fastest(evidence: Evidence) -> Verdict | None:
    rows = [evidence.rows(pick, picks.TORUS).assign(words=pick.words) for pick in picks.TABLE_1]
    timed = pd.concat(rows).dropna(subset=["median_ms"])
    groups = [own for _, own in timed.groupby(["comparison", "device"]) if len(own) > 2]
    groups = [own for own in groups if (own["words"] == picks.NEWTON_3.words).any()]
    if not groups:
        return None
    lost = []
    for own in groups:
        newton = own[own["words"] == picks.NEWTON_3.words].iloc[0]
        best = own.sort_values("median_ms").iloc[0]
        if best["upper_ms"] < newton["lower_ms"]:
            lost.append(f"{best['words']} at view {best['view']}")
    rivals = len({words for own in groups for words in own["words"]}) - 1
    figure = f"fastest of {rivals + 1} settings in {len(groups) - len(lost)} of {len(groups)} views"
    return verdict(not lost, figure + (f"; beaten by {', '.join(dict.fromkeys(lost))}" if lost else ""))


def _sturm_depends_on_the_view(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.STURM, picks.TORUS)
    if rows["view"].nunique() < 2:
        return None
    counts = wrong(rows, grazing=True).groupby(rows["view"]).max()
    least, most = counts.idxmin(), counts.idxmax()
    figure = f"wrong rays from {counts[least]:,.0f} (view {least}) to {counts[most]:,.0f} (view {most}) in float32"
    exact = evidence.rows(picks.STURM, picks.TORUS, "float64")
    figure += "" if exact.empty else f"; in float64 at most {wrong(exact, grazing=True).max():,.0f}"
    return verdict(bool(counts[most] > UNEVEN * counts[least]), figure)


def _bisection_is_free_of_them(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.BISECTION, picks.TORUS)
    if rows.empty:
        return None
    counts = wrong(rows).groupby(rows["view"]).max()
    largest = rows["feature_error_max"].max()
    figure = f"{counts.sum():,.0f} wrong rays over {len(counts)} views, largest error {wording.error(largest)} r"
    if counts.max() > 0:
        figure += f"; most at view {counts.idxmax()}: {counts.max():,.0f}"
        ours = evidence.rows(Pick("", "double_derivative_bisection", {"SPLIT": 1}), picks.TORUS)
        figure += "" if ours.empty else f"; parted at the roots of f'' instead: {wrong(ours).sum():,.0f}"
    return verdict(bool(counts.max() == 0 and largest <= 0.0014), figure)


def _slow_near_grazing(evidence: Evidence) -> Verdict | None:
    near, far = [], []
    for row in evidence.rows(picks.ONE_RAY, picks.TORUS).itertuples():
        arrays = evidence.arrays(row)
        if arrays is not None and arrays.evaluations is not None and arrays.grazing.any():
            spent = arrays.evaluations > 0
            near.append(float(arrays.evaluations[spent & arrays.grazing].mean()))
            far.append(float(arrays.evaluations[spent & ~arrays.grazing].mean()))
    if not near:
        return None
    a, b = float(np.mean(near)), float(np.mean(far))
    figure = (
        f"{wording.number(a)} evaluations on grazing rays, {wording.number(b)} on the others: {wording.factor(a / b)}"
    )
    return verdict(a > SLOWER * b, figure)


def _planes(name: str) -> Callable[[Evidence], Verdict | None]:
    """A judge of whether the near or the far plane changes the error of screen-space coefficients."""
    other = {"NEAR": "FAR", "FAR": "NEAR"}[name]

    def decide(evidence: Evidence) -> Verdict | None:
        rows = evidence.finished[
            (evidence.finished["method"] == "analytic")
            & (evidence.finished["precision"] == "float32")
            & evidence.finished["surface"].isin(picks.TORUS)
        ]
        knobs = pd.DataFrame([_knobs(text) for text in rows["parameters"]], index=rows.index)
        if rows.empty or name not in knobs:
            return None
        rows = rows.join(knobs)[(knobs["SCREEN"] == 1) & (knobs["POLISH"] == 0)]
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


def _thresholds_hold(evidence: Evidence) -> Verdict | None:
    told, held = [], True
    for pick, limit in ((picks.NEWTON_3, 0.001), (picks.NEWTON_5, 0.00003)):
        rows = evidence.rows(pick, picks.TORUS)
        if len(rows):
            largest = rows["feature_error_max"].max()
            held = held and largest <= limit
            told.append(f"{pick.words}: largest error {wording.error(largest)} r over {len(rows)} views")
    return verdict(held, "; ".join(told)) if told else None


def _quadratic(evidence: Evidence) -> Verdict | None:
    coarse, fine = (evidence.rows(pick, picks.TORUS) for pick in (picks.NEWTON_3, picks.NEWTON_5))
    both = coarse.merge(fine, on=derive.GROUP, suffixes=("", "_fine"))
    if both.empty:
        return None
    more = (both["evaluations_mean_fine"] - both["evaluations_mean"]) / (both["truth_hits"] / both["accuracy_rays"])
    told = f"{wording.number(more.mean())} more evaluations for each hit (at most {wording.number(more.max())})"
    return verdict(bool(more.max() <= MORE_STEPS), f"{told} at 0.00003 r than at 0.001 r, over {len(both)} views")


def _step_bound(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.NEWTON_UNBOUND, picks.NEWTON_3, picks.TORUS)
    if ratios.empty:
        return None
    loose = wrong(evidence.rows(picks.NEWTON_UNBOUND, picks.TORUS)).sum()
    bound = wrong(evidence.rows(picks.NEWTON_3, picks.TORUS)).sum()
    figure = (
        f"wrong rays {loose:,.0f} without the bound, {bound:,.0f} with it; it is {quantities(ratios['ratio'])} as fast"
    )
    return verdict(bool(bound < loose and ratios["ratio"].mean() > 0.9), figure)


def _cubics(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.STURM)
    rows = rows[rows["degree"] == 3]
    if rows.empty:
        return None
    each = ", ".join(f"{row.surface_title} {row.wrong_rays:,}" for row in rows.itertuples())
    share = wrong(rows).sum() / rows["accuracy_rays"].sum()
    return verdict(bool(share < 0.001), f"wrong rays away from silhouettes: {each}; {wording.share(share)} of all")


CLAIMS = (
    Claim(
        PAPER,
        "1, 6",
        "Iterative methods are faster than closed forms (Loop and Blinn's), since they find one root only.",
        "Time of Loop-Blinn over Newton 0.001, torus, every view",
        faster(picks.LOOP_BLINN, picks.NEWTON_3, picks.TORUS, "1,300 over 500 frames/s, 2.6×"),
        ("newton", "analytic"),
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
        "Wrong rays of Sturm in float32, view by view, silhouettes included",
        _sturm_depends_on_the_view,
        ("sturm",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.2",
        "Double derivative bisection is slower than Sturm.",
        "Time of D.D. Bisection over Sturm, torus, every view",
        faster(picks.BISECTION, picks.STURM, picks.TORUS, "93 over 23 frames/s, 4×"),
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
        f"Evaluations on grazing rays over those on the others, at least {SLOWER}×",
        _slow_near_grazing,
        ("sphere_tracing",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.3",
        "Two starts for each ray are faster than one.",
        "Time of Sphere Tracing over 2-rays S. Tracing, torus, every view",
        faster(picks.ONE_RAY, picks.TWO_RAYS, picks.TORUS, "88 over 24 frames/s, 3.7×"),
        ("sphere_tracing",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.4",
        "The step bound λ = 0.15 avoids vanishing rays without losing speed.",
        "Wrong rays and time of Newton 0.001 with the bound and without",
        _step_bound,
        ("newton",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.4",
        "Newton's method converges quadratically near a root.",
        f"Evaluations at 0.00003 r over those at 0.001 r: at most {MORE_STEPS:g} more for each hit",
        _quadratic,
        ("newton",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.4",
        "Newton's thresholds assure errors under 0.001 r and 0.00003 r.",
        "The largest error over the minor radius, every view",
        _thresholds_hold,
        ("newton",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "5.1",
        "Newton 0.001 is the fastest of the iterative methods, at every angle.",
        "Times of Table 1's settings, torus, every view",
        _newton_fastest,
        ("newton",),
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
