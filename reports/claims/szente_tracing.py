"""What szente claims of marching and of culling."""

from __future__ import annotations

from reports import wording
from reports.claims import picks
from reports.claims.model import Claim, Verdict, at_least, both, count, counted, rays, verdict
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
    told += f"drowns in its rounding, of {rays(rows)}"
    # none seen says nothing of finer details; and at a silhouette rounding alone may skip a root
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
        each = ", ".join(f"{row.surface_title} {wording.factor(row.ratio)}" for row in own.itertuples())
        told.append(f"on {device} {each}")
    if not held:
        return None
    return verdict(both(*held), f"time without culling over time with it, in float32: {'; '.join(told)}")


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
        f"Time without culling over time with it: above {PAYS} at the lowest degree, and more than at the highest, on "
        "every device",
        _culling_pays,
        ("lu_lipschitz",),
        "szente-table5.toml",
    ),
)
