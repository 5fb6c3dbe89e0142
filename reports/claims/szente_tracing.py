"""What szente claims of marching and of culling."""

from __future__ import annotations

from reports import wording
from reports.claims import picks
from reports.claims.model import Claim, Verdict, at_least, both, count, counted, verdict
from reports.evidence import Evidence

PAPER = "szente"
PAYS = 1.02  # culled over not culled, to call it a gain


def _details_skipped(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.MARCH)
    if rows.empty:
        return None
    clear, grazing, drowned = (
        counted(rows, f"{kind}misses", f"{kind}wrong_root") for kind in ("", "grazing_", "drowned_")
    )
    told = f"{count(clear)} roots skipped away from silhouettes, {count(grazing)} at them and {count(drowned)} where f "
    told += f"drowns in its rounding, by {count(counted(rows, 'accuracy_rays'))} rays on "
    told += f"{rows['surface'].nunique()} surfaces"
    # none seen says nothing of finer details; and at a silhouette rounding alone may skip a root
    return verdict(True if clear else None, told)


def _culling_pays(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.LU_UNCULLED, picks.LU, picks.TABLE_5).sort_values("degree")
    if ratios["degree"].nunique() < 2:
        return None
    each = ", ".join(f"{row.surface_title} {wording.factor(row.ratio)}" for row in ratios.itertuples())
    low, high = ratios.iloc[0], ratios.iloc[-1]
    pays = at_least(low["ratio_low"], low["ratio_high"], PAYS)
    more = at_least(low["ratio_low"] / high["ratio_high"], low["ratio_high"] / high["ratio_low"], 1.0)
    return verdict(both(pays, more), f"time without culling over time with it: {each}")


CLAIMS = (
    Claim(
        PAPER,
        "1",
        "Ray marching may skip details smaller than its step.",
        "Misses and wrong roots of ray marching away from silhouettes: one certified ray is enough",
        _details_skipped,
        ("ray_march",),
        "szente-fig2.toml",
    ),
    Claim(
        PAPER,
        "5",
        "Culling by LU bounds pays on surfaces of low degree.",
        f"Time without culling over time with it: above {PAYS} at the lowest degree, and more than at the highest",
        _culling_pays,
        ("lu_lipschitz",),
        "szente-table5.toml",
    ),
)
