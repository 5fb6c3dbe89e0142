"""Claims of szente about ray marching and Lipschitz tracing."""

from __future__ import annotations

from reports import wording
from reports.analysis import count_tests
from reports.claims import picks
from reports.claims.evidence import Evidence
from reports.claims.model import (
    Claim,
    Verdict,
    always,
    at_least,
    both,
    count,
    counted,
    known,
    lost,
    quantities,
    rays,
    verdict,
)
from reports.claims.szente_fit import PAPER, over_marching
from reports.reading.tuples import tuples

TABLE_5 = "szente-table5.toml"
SOME = 0.001  # a share of rays that is larger by a test is called “some rays”
PAYS = 1.02  # the least ratio of times without and with culling that is called a gain


def _details_skipped(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.MARCH)
    if rows.empty:
        return None
    clear, grazing, drowned = (
        counted(rows, f"{kind}misses", f"{kind}wrong_root") for kind in ("", "grazing_", "drowned_")
    )
    told = f"{count(clear)} roots skipped away from silhouettes, {count(grazing)} at them and {count(drowned)} where f "
    told += f"drowns in its rounding, of {rays(rows)}"
    # that no root was skipped says nothing of finer details; at a silhouette rounding alone may skip a root
    return verdict(True if clear else None, told)


def _culling_pays(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.LU_UNCULLED, picks.LU, picks.TABLE_5)
    held, told = [], []
    for device, own in ratios.groupby("device", sort=False):
        own = own.sort_values("degree", kind="stable")
        if own["degree"].nunique() < 2:
            continue
        low, high = own.iloc[0], own.iloc[-1]
        held.append(at_least(low["ratio_low"], low["ratio_high"], PAYS))
        held.append(at_least(low["ratio_low"] / high["ratio_high"], low["ratio_high"] / high["ratio_low"], 1.0))
        each = ", ".join(f"{row.surface_title} {wording.factor(row.ratio)}" for row in tuples(own))
        told.append(f"on {device} {each}")
    if not held:
        return None
    return verdict(both(*held), f"time without culling over time with it, in float32: {'; '.join(told)}")


def _lu_misses_nothing(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.LU, picks.TABLE_5)
    if rows.empty:
        return None
    bad = counted(rows, "misses", "wrong_root")
    told = f"{count(bad)} misses and wrong roots of {rays(rows)}"
    return verdict(known(bad, lambda n: n == 0), told)


def _out_of_steps(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.LU, picks.HIGH_DEGREE).drop_duplicates("surface")
    if rows.empty:
        return None
    given_up = rows["exhausted"] + rows["grazing_exhausted"] + rows["drowned_exhausted"]
    share = given_up.astype(float) / rows["accuracy_rays"].astype(float)
    told = ", ".join(f"{t} {wording.share(s)}" for t, s in zip(rows["surface_title"], share, strict=True))
    held = []
    for i in range(len(rows)):
        spent, of = (
            counted(rows.iloc[[i]], *names) for names in (("exhausted", "grazing_exhausted"), ("accuracy_rays",))
        )
        held.append(None if spent is None or not of else count_tests.share_exceeds(spent, of, SOME))
    return verdict(both(*held), f"share of rays that run out of steps: {told}")


def _lu_over_control(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.CONTROL, picks.LU, picks.TABLE_5)
    if ratios.empty:
        return None
    each = ", ".join(f"{r.surface_title} {wording.factor(r.ratio)}" for r in tuples(ratios))
    return verdict(always(ratios), f"{each}{lost(ratios)}; the paper: 1.37×")


def _subintervals(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.LU, picks.LU_SUBINTERVALS, picks.TABLE_5)
    if ratios.empty:
        return None
    figure = (
        f"bounds on each next step's interval are {quantities(ratios['ratio'])} as fast as one bound for the whole ray"
        f"{lost(ratios)}"
    )
    ours = evidence.ratios(picks.LU, picks.LU_OURS, picks.TABLE_5)
    figure += (
        f"; our bounds of coefficients restricted to it, with all our other changes: {quantities(ours['ratio'])}"
        if len(ours)
        else ""
    )
    return verdict(always(ratios), figure)


_LU = ("lu_lipschitz",)
CLAIMS = (
    Claim(
        PAPER,
        "1, 3",
        "Lipschitz tracing by LU bounds misses no surface feature.",
        "Misses and wrong roots away from silhouettes on the surfaces of Table 5",
        _lu_misses_nothing,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "4",
        "LU bounds are consistently faster than control points.",
        "Time with control points, which cull no ray here, over time with LU bounds, which cull; surface by surface",
        _lu_over_control,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "4",
        "LU tracing is 4.8 times as fast as ray marching.",
        "Time of ray marching over that of LU as printed, mean of four surfaces, by two marches: step by step as "
        "printed, and ours in blocks. Both take 10,000 steps across the domain",
        over_marching(picks.LU, picks.LU_OURS, picks.TABLE_5, 4.8, "the paper's text: 4.8× and 7×"),
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "4",
        "Surfaces of higher degree run out of the iteration cap.",
        f"Exhausted rays at degrees 8, 10 and 16: more than {100 * SOME:g} % of each",
        _out_of_steps,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "5",
        "LU bounds on subintervals, each extremum moved into the interval, may be faster still (future work).",
        "Time of one bound for the ray over LU bounds on the next step's interval",
        _subintervals,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "1",
        "Ray marching may skip details smaller than its step.",
        "Misses and wrong roots of ray marching away from silhouettes; one certified ray is enough to confirm it",
        _details_skipped,
        ("ray_march",),
        "szente-fig2.toml",
    ),
    Claim(
        PAPER,
        "5",
        "Culling by LU bounds pays on surfaces of low degree.",
        f"Time without culling over time with it: above {PAYS} at the lowest degree, and more than at the highest, on "
        "every device",
        _culling_pays,
        ("lu_lipschitz",),
        TABLE_5,
    ),
)
