"""Write variants the way people do: `Newton, ε = 0.001`, not `newton[EPSILON=0.001]`."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any

import pandas as pd

from harness.contract import FROM_ORIGIN
from reports import wording

_SYMBOLS = {"EPSILON": "ε"}
_BEHIND = "+beams"
_NAMED = re.compile(r"(?P<method>[^\[\s+]+)(?:\[(?P<knobs>[^\]]*)\])?(?P<rest>.*)", re.DOTALL)
_PHRASES = re.compile(r"( from the (?:entry|eye)| shaded by | to [0-9.e-]+ pixels| in a (?=\w+))")
SMALL = 0.01  # below it a power of two is written as one


def method_label(method: str, methods: Mapping[str, Mapping[str, Any]]) -> str:
    """Return how people write a method's name; `methods` is what the plan's methods say of themselves, by name."""
    told = methods.get(method, {}).get("label")
    if isinstance(told, str) and told:
        return told
    words = method.replace("_", " ").strip()
    return words[:1].upper() + words[1:]


def label(variant: str, method: str, methods: Mapping[str, Mapping[str, Any]]) -> str:
    """Return how people write a variant: its method, each knob that is bound, and what else its name says.

    A variant that has the name of a paper's own setting keeps it. `methods` is as for `method_label`.
    """
    found = _NAMED.fullmatch(variant)
    if found is None or found["method"] != method:
        return _rest(variant)
    knobs = [_knob(*bound.partition("=")[::2]) for bound in (found["knobs"] or "").split(",") if bound]
    return ", ".join([method_label(method, methods), *knobs]) + _rest(found["rest"])


def _rest(words: str) -> str:
    """Write what a variant's name says behind the knobs: a phrase each behind a comma."""
    return _PHRASES.sub(r",\1", words.replace(_BEHIND, ", behind beams")).replace("core_circle", "the core circle")


def labelled(frame: pd.DataFrame, methods: Mapping[str, Mapping[str, Any]]) -> pd.DataFrame:
    """Return `frame`, which has the columns method and variant, with the columns `label` and `method_label`.

    Labels leave out where rays begin, and by what they are shaded, where that is the same for all that cast rays.
    """
    shared = _shared(frame)
    pairs = frame[["method", "variant"]].drop_duplicates().itertuples(index=False, name=None)
    labels = {}
    for method, variant in pairs:
        short = str(variant)
        for words in shared:
            short = short.replace(words, "")
        labels[method, variant] = label(short, str(method), methods)
    names = {method: method_label(str(method), methods) for method in frame["method"].unique()}
    told = [labels[pair] for pair in zip(frame["method"], frame["variant"], strict=True)]
    return frame.assign(
        label=pd.Series(told, frame.index, dtype=object),
        method_label=pd.Series([names[method] for method in frame["method"]], frame.index, dtype=object),
    )


def _shared(frame: pd.DataFrame) -> list[str]:
    """Return the words of variants that say what all rows of `frame` that cast rays and answer have in common."""
    if not {"casts", "origin", "normal"} <= set(frame):
        return []
    rays = frame[(frame["casts"] == "rays") & frame["answers"].astype(bool)]
    shadings = [f" shaded by {name}" for name in rays["normal"].dropna().unique()]
    origins = [FROM_ORIGIN.get(name, "") for name in rays["origin"].dropna().unique()]
    return [words for own in (shadings, origins) if len(own) == 1 for words in own if words]


def _knob(name: str, value: str) -> str:
    """Write a knob and its value: ε = 0.001, steps = 1,000, tolerance = 2⁻¹⁸."""
    return f"{_SYMBOLS.get(name, name.replace('_', ' ').lower())} = {_value(value)}"


def _value(text: str) -> str:
    """Write a knob's value, of which a variant's name has six digits."""
    try:
        value = float(text)
    except ValueError:
        return text
    if not math.isfinite(value):
        return text
    if 0.0 < value < SMALL:
        exponent = round(math.log2(value))
        if abs(value / 2.0**exponent - 1.0) < 1e-5:
            return wording.raised(2, exponent)
    if value == int(value):
        return wording.minus(f"{int(value):,}")
    return wording.minus(f"{value:g}" if abs(value) >= 1e-4 else re.sub(r"e-0*", "e-", f"{value:g}"))
