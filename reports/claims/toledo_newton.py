"""Claims of toledo2007 about Newton's method (sections 4.4 and 5.1).

They are judged by the method as printed; the figure of our steps forwards stands beside it.
"""

from __future__ import annotations

import math

import pandas as pd

from reports import wording
from reports.analysis import count_tests, derive, rounds
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import (
    Claim,
    Judge,
    Verdict,
    beside,
    both,
    cases,
    count,
    counted,
    every,
    known,
    largest,
    mean_ratio,
    quantities,
    verdict,
)
from reports.claims.toledo import PAPER, VIEWS

FORWARDS = "steps forwards"
MORE_STEPS = 1.0  # one step that doubles the digits of 0.001 r gives more digits than 0.00003 r has


def _fastest(pick: Pick, settings: tuple[Pick, ...]) -> Judge:
    """Make a judge of "`pick` is the fastest of these `settings`, at every angle"."""

    def decide(evidence: Evidence) -> Verdict | None:
        rows = [evidence.rows(one, picks.TORUS).assign(words=one.words) for one in settings]
        timed = pd.concat(rows).dropna(subset=["median_ms"])
        groups = [own for _, own in timed.groupby(["comparison", "device"]) if len(own) > 2]
        groups = [own for own in groups if (own["words"] == pick.words).any()]
        return _won(groups, pick) if groups else None

    return decide


def _won(groups: list[pd.DataFrame], pick: Pick) -> Verdict:
    """Judge whether `pick` is the fastest in each of these groups, by the intervals of medians."""
    lost, won = [], 0
    for own in groups:
        own = own[rounds.proved(own["samples_ms"])]
        newton, others = (own[(own["words"] == pick.words) == is_it] for is_it in (True, False))
        if newton.empty:
            continue
        beating = others[others["upper_ms"] < newton["lower_ms"].iloc[0]].sort_values("median_ms")
        if len(beating):
            best = beating.iloc[0]
            lost.append(f"{best['words']} at view {best['view']}")
        won += bool(len(others) and (others["lower_ms"] > newton["upper_ms"].iloc[0]).all())
    settings = len({words for own in groups for words in own["words"]})
    even = len(groups) - won - len(lost)
    figure = f"fastest of {settings} settings in {won} of {wording.plural(len(groups), 'case')} (views, on each device)"
    figure += f"; beaten by {', '.join(dict.fromkeys(lost))}" if lost else ""
    figure += f"; not told apart from the fastest in {even}" if even else ""
    return verdict(False if lost else True if not even else None, figure)


def _thresholds_hold(coarse: Pick, fine: Pick) -> Judge:
    """Make a judge of "the largest errors are at most the thresholds, 0.001 r and 0.00003 r"."""

    def decide(evidence: Evidence) -> Verdict | None:
        told: list[str] = []
        held: list[bool | None] = []
        for pick, limit in ((coarse, 0.001), (fine, 0.00003)):
            rows = evidence.rows(pick, picks.TORUS)
            if len(rows):
                error = largest(rows, "feature_error_max")
                held.append(known(error / limit, lambda share: share <= 1.0))
                gave_up = (
                    f"{count(counted(rows, 'exhausted'))} of {count(counted(rows, 'accuracy_rays'))} rays exhausted"
                )
                told.append(f"{pick.words}: largest error {wording.error(error)} r over {cases(rows)}, {gave_up}")
        return verdict(both(*held), "; ".join(told)) if told else None

    return decide


def _quadratic(coarse: Pick, fine: Pick) -> Judge:
    """Make a judge of "`fine` takes at most MORE_STEPS more evaluations for each hit than `coarse`"."""

    def decide(evidence: Evidence) -> Verdict | None:
        near, nearer = (evidence.rows(pick, picks.TORUS) for pick in (coarse, fine))
        pairs = near.merge(nearer, on=derive.GROUP, suffixes=("", "_fine"))
        if pairs.empty:
            return None
        hits = (pairs["truth_hits"].astype("float64") / pairs["accuracy_rays"].astype("float64")).replace(0.0, math.nan)
        more = (pairs["evaluations_mean_fine"] - pairs["evaluations_mean"]) / hits
        told = f"{wording.number(more.mean())} more evaluations for each hit (at most {wording.number(more.max())})"
        told += f" at 0.00003 r than at 0.001 r, over {cases(pairs)}"
        return verdict(every(more, lambda steps: steps <= MORE_STEPS), told)

    return decide


def _step_bound(loose: Pick, bound: Pick) -> Judge:
    """Make a judge of "fewer rays vanish with the bound, at no less than 0.9 of the speed".

    A ray vanishes where it is a miss or finds a later root. The figure also counts exhausted rays, which stay in a dip.
    """

    def decide(evidence: Evidence) -> Verdict | None:
        ratios = evidence.ratios(loose, bound, picks.TORUS)
        if ratios.empty:
            return None
        free, held = (evidence.rows(pick, picks.TORUS) for pick in (loose, bound))
        gone, left = (counted(rows, "misses", "wrong_root") for rows in (free, held))
        of_free, of_held = (counted(rows, "accuracy_rays") for rows in (free, held))
        stuck, held_up = (count(counted(rows, "exhausted")) for rows in (free, held))
        figure = (
            f"rays that vanish: {count(gone)} of {count(of_free)} without the bound, {count(left)} of {count(of_held)} "
            f"with it; exhausted: {stuck} without, {held_up} with it; it is {quantities(ratios['ratio'])} as fast"
        )
        if gone is None or of_free is None or left is None or of_held is None:
            return verdict(None, figure)
        avoids = False if gone == 0 else count_tests.exceeds(gone, of_free, left, of_held)
        return verdict(both(avoids, mean_ratio(ratios, 0.9)), figure)

    return decide


CLAIMS = (
    Claim(
        PAPER,
        "4.4",
        "The step bound λ = 0.15 avoids vanishing rays without losing speed.",
        "Misses, later roots and time of Newton 0.001 with the bound and without",
        beside(
            _step_bound(picks.NEWTON_UNBOUND, picks.NEWTON_3),
            _step_bound(picks.FORWARDS_UNBOUND, picks.NEWTON_3_FORWARDS),
            FORWARDS,
        ),
        ("newton",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.4",
        "Newton's method converges quadratically near a root.",
        f"Evaluations at 0.00003 r less those at 0.001 r: at most {MORE_STEPS:g} more for each hit",
        beside(
            _quadratic(picks.NEWTON_3, picks.NEWTON_5),
            _quadratic(picks.NEWTON_3_FORWARDS, picks.NEWTON_5_FORWARDS),
            FORWARDS,
        ),
        ("newton",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "4.4",
        "Newton's thresholds assure errors under 0.001 r and 0.00003 r.",
        "The largest error over the minor radius, every view",
        beside(
            _thresholds_hold(picks.NEWTON_3, picks.NEWTON_5),
            _thresholds_hold(picks.NEWTON_3_FORWARDS, picks.NEWTON_5_FORWARDS),
            FORWARDS,
        ),
        ("newton",),
        VIEWS,
    ),
    Claim(
        PAPER,
        "5.1",
        "Newton 0.001 is the fastest of the iterative methods, at every angle.",
        "Times of Table 1's settings, torus, every view",
        beside(
            _fastest(picks.NEWTON_3, picks.TABLE_1),
            _fastest(picks.NEWTON_3_FORWARDS, picks.OURS_OF_TABLE_1),
            "all methods so, Newton with steps forwards",
        ),
        ("newton",),
        VIEWS,
    ),
)
