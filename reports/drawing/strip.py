"""Set pictures of surfaces side by side, each as the variant to take for it draws it."""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from reports import wording
from reports.analysis import choices
from reports.analysis.choices import Choice
from reports.content import Gallery, Panel, Picture
from reports.drawing import images
from reports.reading.arrays import Arrays, Shelf

PIXELS = 1400  # of all pictures of a strip side by side
FEW = 4  # pictures that are wide enough for the names of variants
EDGE = 0.03  # of the picture's side is left free around what is seen


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
    picture = Picture(f"{row.key}-teaser", _png(cropped(arrays), side), f"{choice.name} drawn by {name}")
    wrong = "" if choice.best is not None else f"{wording.plural(int(row.wrong_rays), 'wrong ray')}, "
    head = f"{name}, " if large else f"{row.method_label}\n"
    told = f"{head}{wording.number(row.median_ms)} ms\n{wrong}error {wording.error(row.relative_error_max)}"
    return Panel(choice.name, (picture,), told)


def cropped(arrays: Arrays) -> NDArray[np.float64]:
    """Paint what is seen of a surface, in a square with little around it; returns float64[n, n, 3] in 0…1."""
    seen = ~np.isnan(arrays.shade)
    image = images.shaded(arrays)
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    if not len(rows):
        return image
    side = max(rows[-1] - rows[0], columns[-1] - columns[0]) + 1
    side += 2 * max(1, round(EDGE * side))
    square = np.ones((side, side, 3))
    part = image[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    top, left = (side - part.shape[0]) // 2, (side - part.shape[1]) // 2
    square[top : top + part.shape[0], left : left + part.shape[1]] = part
    return square


def _png(image: NDArray[np.float64], side: int) -> bytes:
    """Return an image float64[n, n, 3] in 0…1 as a PNG file of side × side pixels, smooth where it is enlarged."""
    buffer = io.BytesIO()
    scaled = Image.fromarray(np.round(255 * image).astype(np.uint8)).resize((side, side), Image.Resampling.BICUBIC)
    scaled.save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
