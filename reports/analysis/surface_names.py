"""Which rows are of the same surface, written in another way."""

from __future__ import annotations

import pandas as pd

PRINTED = "as printed"


def form_of(name: str) -> str:
    """Read the form from a surface's name: `nested` from `chmutov:nested`; PRINTED where the name has none."""
    return name.partition(":")[2] or PRINTED


def base_of(name: str) -> str:
    """Return a surface's name without that of its form."""
    return name.partition(":")[0]


def printed_alone(frame: pd.DataFrame) -> pd.DataFrame:
    """Drop the rows of further forms of surfaces that are there as printed too."""
    there = set(frame["surface"])
    further = frame["surface"].map(lambda name: base_of(name) != name and base_of(name) in there)
    return frame[~further.astype(bool)]
