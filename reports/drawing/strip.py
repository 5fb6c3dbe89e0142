"""Set pictures of surfaces side by side, each as the variant to take for it draws it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from reports import wording
from reports.analysis import choices
from reports.analysis.choices import Choice
from reports.content import Gallery, Panel, Picture
from reports.drawing import images
from reports.reading.arrays import Arrays, Shelf

PIXELS = 1400  # of all pictures of a strip side by side
FEW = 4  # pictures that are wide enough for the names of variants


def strip(shelf: Shelf, found: Sequence[Choice]) -> Gallery | None:
    """Make a gallery with one panel for each of these choices; None where no arrays are stored.

    Below each picture stand its method, its time and its largest error, or how many rays are wrong.
    """
    shown = [(choice, choice.pictured) for choice in found]
    read = [(choice, row, shelf.get(row)) for choice, row in shown if not wording.absent(row.arrays)]
    side = PIXELS // max(4, len(read) or 1)
    panels = [_panel(choice, row, arrays, side, len(read) <= FEW) for choice, row, arrays in read if arrays is not None]
    return Gallery(tuple(panels), "", across=len(panels)) if panels else None


def _panel(choice: Choice, row: Any, arrays: Arrays, side: int, large: bool) -> Panel:
    """Show one surface; below a `large` picture there is room for the whole name of the variant."""
    name = choices.written(row, choice.rows)
    picture = Picture(f"{row.key}-teaser", images.png(pictured(arrays, side)), f"{choice.name} drawn by {name}")
    wrong = "" if choice.best is not None else f"{wording.plural(int(row.wrong_rays), 'wrong ray')}, "
    head = f"{name}, " if large else f"{row.method_label}\n"
    told = f"{head}{wording.number(row.median_ms)} ms\n{wrong}error {wording.error(row.relative_error_max)}"
    return Panel(choice.name, (picture,), told)


def pictured(arrays: Arrays, side: int) -> NDArray[np.float64]:
    """Paint what is seen of a surface, with sharp outlines, in a square; returns float64[side, side, 3] in 0…1."""
    seen = arrays.cropped(*images.outline([arrays]))
    image = images.hero(seen, side)[:side, :side]
    square = np.ones((side, side, 3))
    top, left = (side - image.shape[0]) // 2, (side - image.shape[1]) // 2
    square[top : top + image.shape[0], left : left + image.shape[1]] = image
    return square
