"""Define how things look: a colour and marker for each method, dashes for variants, a colour for a kind of wrong ray.

The colours are Okabe and Ito's, which colour-blind readers can tell apart. There are more methods than colours. So each
method of the suite has a marker that no other method of the suite has, which tells them apart in greyscale too. Plugins
have pairs of a colour and a marker that are left over.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal

INK = "#222222"
FAINT = "#8a8a8a"
HAIRLINE = "#d9d9d9"
PAPER = "#ffffff"
FONT = "DejaVu Sans"  # matplotlib has the file, and the PDF embeds it

_BLUE, _ORANGE, _GREEN, _VERMILLION = "#0072B2", "#E69F00", "#009E73", "#D55E00"
_PURPLE, _SKY, _YELLOW, _GREY = "#CC79A7", "#56B4E9", "#B8A800", "#777777"  # the yellow darkened to be seen on paper


@dataclass(frozen=True)
class Mark:
    """Hold how a method or a variant is drawn, in matplotlib's values.

    A variant has its method's colour and marker, and a line of its own.
    """

    color: str
    marker: str | tuple[int, Literal[0, 1, 2], int]
    line: str = "-"


_HOUSE: dict[str, Mark] = {
    "null": Mark(_GREY, "x"),
    "ray_march": Mark(_ORANGE, "s"),
    "newton": Mark(_BLUE, "o"),
    "sturm": Mark(_PURPLE, "D"),
    "double_derivative_bisection": Mark(_GREEN, "v"),
    "sphere_tracing": Mark(_SKY, "h"),
    "analytic": Mark(_VERMILLION, "P"),
    "yuksel": Mark(_YELLOW, "^"),
    "eft_yuksel": Mark(_VERMILLION, ">"),
    "lu_lipschitz": Mark(_GREEN, "<"),
    "sphere_tracing_lipschitz": Mark(_PURPLE, "X"),
    "interval_march": Mark(_BLUE, "d"),
    "interval_uniform": Mark(_ORANGE, "p"),
    "interval_adaptive": Mark(_BLUE, "*"),
    "bernstein": Mark(_GREEN, (3, 1, 0)),  # a star with three points
    "tiles": Mark(_PURPLE, "H"),
    "tiles_interval": Mark(_PURPLE, (6, 1, 0)),  # a star with six points
    "polygon": Mark(_GREY, "8"),
    "contour": Mark(_SKY, (4, 1, 0)),  # a star with four points
}
_SPARE_COLORS = (_PURPLE, _GREEN, _VERMILLION, _SKY, _ORANGE, _BLUE, _YELLOW)
_SPARE_MARKERS: tuple[str | tuple[int, Literal[0, 1, 2], int], ...] = (
    "p",
    ">",
    "X",
    "H",
    "D",
    "v",
    "s",
    "o",
    "^",
    "<",
    "P",
    "*",
    (3, 1, 0),
    (4, 1, 0),
    (6, 1, 0),
)
_SPARE = [
    mark for mark in (Mark(c, m) for m in _SPARE_MARKERS for c in _SPARE_COLORS) if mark not in _HOUSE.values()
]  # pairs of a colour and a marker that no method of the suite has
_PALER = 0.6  # how far towards white the methods beside the focus are


def marks(methods: Iterable[str], focus: str = "") -> dict[str, Mark]:
    """Return a mark for each method, by name; no two share colour and marker, up to len(_SPARE) plugins.

    The suite's methods have the same mark in every report. A plugin's mark is chosen by its name, so that it is the
    same in every report in which no other plugin's name chooses that mark too. With a method `focus` all other methods
    are paler.
    """
    names = sorted(set(methods))
    found = {name: _HOUSE[name] for name in names if name in _HOUSE}
    free = list(_SPARE)
    for name in names:
        if name not in found:
            wanted = _SPARE[_number(name) % len(_SPARE)]
            found[name] = wanted if wanted in free else free[_number(name) % len(free)]
            free = [mark for mark in free if mark != found[name]] or list(_SPARE)
    return {name: found[name] if focus in ("", name) else _paler(found[name]) for name in names}


def _number(name: str) -> int:
    """Return a number that a name has in every run."""
    return int.from_bytes(hashlib.sha256(name.encode()).digest()[:6])


def _paler(mark: Mark) -> Mark:
    """Return the mark in a paler colour."""
    return replace(mark, color=pale(mark.color, _PALER))


def pale(color: str, share: float) -> str:
    """Return a colour "#rrggbb" moved by `share` of the way to white."""
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(part + share * (255 - part)):02x}" for part in parts)


_LINES = ("-", "--", ":", "-.")


def variant_marks(variants: Iterable[tuple[str, str]], focus: str = "") -> dict[str, Mark]:
    """Return a mark for each variant of the pairs (method, variant), by the variant's name.

    It is the method's mark; the variants of a method have different dashes, as long as there are enough.
    `focus` is as for `marks`.
    """
    pairs = list(dict.fromkeys(variants))
    own = marks((method for method, _ in pairs), focus)
    seen: Counter[str] = Counter()
    made = {}
    for method, variant in pairs:
        made[variant] = replace(own[method], line=_LINES[seen[method] % len(_LINES)])
        seen[method] += 1
    return made


@dataclass(frozen=True)
class Kind:
    """Hold a kind of wrong ray; `code` is its value in the `wrong` array of a run."""

    code: int
    title: str
    color: str


WRONG = (
    Kind(1, "miss", _VERMILLION),
    Kind(2, "false hit", _PURPLE),
    Kind(3, "exhausted", _SKY),
    Kind(4, "wrong root", _GREEN),
    Kind(5, "invalid", "#FF00FF"),
)
APART = "#7a3b10"  # a wrong answer to a grazing or drowned ray, where the kinds of all others are told apart
UNDECIDED = "#bdbdbd"
EXACT = "#e9eef4"  # an error of exactly zero, below the colour scale
ERROR_MAP = "cividis"
SURFACE_SHADOW, SURFACE_LIGHT = "#2b3440", "#f3eadb"
