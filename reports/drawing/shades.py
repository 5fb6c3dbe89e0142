"""Give the squares of matrices colours: by a scale, dark where all is well and bright where nothing is, or by outcome.

The scale is cividis, which colour-blind readers see as others do, and which keeps its order in greyscale.
"""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib
from matplotlib.colors import to_hex

from reports.content import Square

NEUTRAL = "#eeeeee"  # of a square that says nothing either way
GOOD, WRONG = "#8fd3b6", "#ecd9ec"  # right or fastest; some ray is answered wrongly
_DARK, _LIGHT = "#000000", "#ffffff"  # what is written on a coloured square
_DARKEST, _BRIGHTEST = 0.12, 0.97  # the part of the scale that is used: white letters stand on its dark end


def shade(badness: float) -> str:
    """Return the colour "#rrggbb" of `badness`, which is held to 0 (all is well) … 1 (nothing is)."""
    held = min(max(badness, 0.0), 1.0)
    return str(to_hex(matplotlib.colormaps["cividis"](_DARKEST + (_BRIGHTEST - _DARKEST) * held)))


def ink(color: str) -> str:
    """Return the colour for text on a ground of `color`, "#rrggbb": black or white, whichever is read more easily.

    Their contrast is 4.5 or more on every colour.
    """
    shares = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in shares)
    luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue
    return _DARK if luminance > 0.1791 else _LIGHT  # where both have a contrast of 4.58


def key(texts: Mapping[float, str]) -> dict[str, str]:
    """Return a Matrix's key: what the colours of these badnesses mean, by colour."""
    return {shade(badness): text for badness, text in texts.items()}


def silent(text: str, note: str = "") -> Square:
    """Return a square that says nothing either way: a refusal, or what was not measured."""
    return Square(text, NEUTRAL, note)
