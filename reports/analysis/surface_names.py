"""Read a surface's name: which surface it is, and in which form its formula is written."""

from __future__ import annotations

import pandas as pd

PRINTED = "as printed"


def form_of(name: str) -> str:
    """Return the form that a surface's name states: `nested` of `chmutov:nested`; PRINTED where it states none."""
    return name.partition(":")[2] or PRINTED


def base_of(name: str) -> str:
    """Return a surface's name without its form: `chmutov` of `chmutov:nested`."""
    return name.partition(":")[0]


def printed_alone(frame: pd.DataFrame) -> pd.DataFrame:
    """Drop the rows of a surface's other forms where the frame has the surface as printed too."""
    there = set(frame["surface"])
    further = {name for name in there if base_of(name) != name and base_of(name) in there}
    return frame[~frame["surface"].isin(further)] if further else frame
