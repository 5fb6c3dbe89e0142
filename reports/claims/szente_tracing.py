"""What szente claims of marching and of culling."""

from __future__ import annotations

from reports import wording
from reports.claims import picks
from reports.claims.model import Claim, Verdict, verdict
from reports.evidence import Evidence

PAPER = "szente"
PAYS = 1.02  # culled over not culled, to call it a gain


def _details_skipped(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.MARCH)
    if rows.empty:
        return None
    names = [f"{kind}{name}" for kind in ("", "grazing_", "drowned_") for name in ("misses", "wrong_root")]
    skipped = int(sum(rows[name].sum() for name in names))
    told = f"{skipped:,} roots skipped by {rows['accuracy_rays'].sum():,} rays on {rows['surface'].nunique()} surfaces"
    return verdict(skipped > 0, told)


def _culling_pays(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.LU_UNCULLED, picks.LU, picks.TABLE_5).sort_values("degree")
    if ratios["degree"].nunique() < 2:
        return None
    each = ", ".join(f"{row.surface_title} {wording.factor(row.ratio)}" for row in ratios.itertuples())
    low, high = ratios["ratio"].iloc[0], ratios["ratio"].iloc[-1]
    return verdict(bool(low > PAYS and low > high), f"time without culling over time with it: {each}")


CLAIMS = (
    Claim(
        PAPER,
        "1",
        "Ray marching may skip details smaller than its step.",
        "Misses and wrong roots of ray marching, silhouettes included",
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
