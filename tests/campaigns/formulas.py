"""Read random formulas: right ones, such with mistakes, and noise. See tests.fuzz_formulas, which makes them."""

from __future__ import annotations

import random
from collections import Counter

from tests.campaigns.frame import Campaign, Fell, Place
from tests.fuzz_formulas import fuzz

EACH = 500
LIMIT = 60.0  # seconds of the processor for one formula


def _trial(dice: random.Random, place: Place) -> Counter[str]:
    del place
    seen, problems, _ = fuzz(EACH, dice.getrandbits(32), LIMIT)
    if problems:
        raise Fell("; ".join(problems))
    return seen


CAMPAIGN = Campaign(
    name="formulas",
    tries="reads a random formula: a right one, one with mistakes, or noise",
    promise="no traceback, no code that runs, no hang, no other value than the one it was made with",
    trial=_trial,
    small=400,
    whole=1_000_000,
    each=EACH,
    block=20,
    limit=600,
)
