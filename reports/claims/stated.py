"""Read what the methods state of their knobs: the papers' settings by name, and the defaults, which are our values.

The methods' descriptions are the source. settings.csv is a copy of them, because reports import no methods and must
judge stored runs too. A test fails where the two differ; `python -m tests.stated_settings` writes the copy anew.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path

FILE = Path(__file__).with_name("settings.csv")


@cache
def _read() -> dict[tuple[str, str], dict[str, float]]:
    """Return the knobs of each method and setting; the setting "" has the defaults."""
    found: dict[tuple[str, str], dict[str, float]] = {}
    with FILE.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault((row["method"], row["setting"]), {})[row["knob"]] = json.loads(row["value"])
    return found


def printed(method: str, setting: str) -> dict[str, float]:
    """Return the knobs of one of the papers' settings. Raises KeyError where the method does not state it."""
    return dict(_read()[method, setting])


def ours(method: str, knobs: Iterable[str]) -> dict[str, float]:
    """Return the defaults of `knobs`. Raises KeyError where the method has no such knob."""
    defaults = _read()[method, ""]
    return {knob: defaults[knob] for knob in knobs}
