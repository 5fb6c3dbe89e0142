"""Give the squares of matrices colours: dark where all is well, bright where nothing is.

The scale is cividis, which colour-blind readers see as others do, and which keeps its order in greyscale.
"""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib
from matplotlib.colors import to_hex

from reports.content import Square

NEUTRAL = "#eeeeee"  # of a square that says nothing either way
_DARKEST, _BRIGHTEST = 0.12, 0.97  # the part of the scale that is used: white letters stand on its dark end


def shade(badness: float) -> str:
    """Return the colour "#rrggbb" of `badness`, which is held to 0 (all is well) … 1 (nothing is)."""
    held = min(max(badness, 0.0), 1.0)
    return str(to_hex(matplotlib.colormaps["cividis"](_DARKEST + (_BRIGHTEST - _DARKEST) * held)))


def key(texts: Mapping[float, str]) -> dict[str, str]:
    """Return a Matrix's key: what the colours of these badnesses mean, by colour."""
    return {shade(badness): text for badness, text in texts.items()}


def silent(text: str, note: str = "") -> Square:
    """Return a square that says nothing either way: a refusal, or what was not measured."""
    return Square(text, NEUTRAL, note)
