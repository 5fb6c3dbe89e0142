"""State the papers' qualitative claims as data: the claim, what decides it, and a function from rows to a verdict.

CLAIMS are in the order of the papers. A claim is judged by the rows that a run has. Without the rows it needs it is not
testable, and the checklist names the config that makes them.
"""

from reports.claims.beamcasting import CLAIMS as _BEAMCASTING
from reports.claims.model import Claim, Outcome, Verdict, judge
from reports.claims.szente_fit import CLAIMS as _SZENTE
from reports.claims.szente_studies import CLAIMS as _SZENTE_STUDIES
from reports.claims.szente_tracing import CLAIMS as _SZENTE_TRACING
from reports.claims.toledo import CLAIMS as _TOLEDO
from reports.claims.toledo_newton import CLAIMS as _NEWTON
from reports.claims.toledo_pieces import CLAIMS as _PIECES
from reports.claims.toledo_tori import CLAIMS as _TORI

CLAIMS: tuple[Claim, ...] = (
    *_TOLEDO,
    *_NEWTON,
    *_PIECES,
    *_TORI,
    *_SZENTE_STUDIES,
    *_SZENTE,
    *_SZENTE_TRACING,
    *_BEAMCASTING,
)

__all__ = ["CLAIMS", "Claim", "Outcome", "Verdict", "judge"]
