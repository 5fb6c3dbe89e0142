"""Enlarge the place of a picture of errors where a method breaks, within the picture itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from harness.contract import TruthStatus
from reports.drawing import images, style
from reports.reading.arrays import Arrays

PART = 8  # a window's side is this part of the picture's
SHARE = 0.42  # of the picture's longer side, of an inset, and at most
MOST = 0.62  # of the shorter one
PIXELS = 360  # of the longer side of a picture with an inset: at most 300 an inch where it is 32 mm wide
LINE = 2  # pixels of a frame


@dataclass(frozen=True)
class Window:
    """Hold a square of rays, in rays: its upper left corner and its side."""

    top: int
    left: int
    side: int


def worst_window(arrays: Arrays, limit: float) -> Window | None:
    """Return where a method breaks: most wrong rays that are not counted apart, else an error above `limit`.

    None where it answers every ray rightly within `limit`, which is in scene units.
    """
    bad = (arrays.wrong > 0) & ~arrays.apart
    if not bad.any():
        error = np.where(arrays.apart, 0.0, np.nan_to_num(arrays.error))
        if not error.max() > limit:  # a limit that is not known is NaN
            return None
        bad = error == error.max()
    side = min(max(8, max(bad.shape) // PART), *bad.shape)
    summed = np.pad(bad.astype(np.int64).cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    within = summed[side:, side:] - summed[:-side, side:] - summed[side:, :-side] + summed[:-side, :-side]
    top, left = (int(at) for at in np.unravel_index(within.argmax(), within.shape))
    rows, columns = np.nonzero(bad[top : top + side, left : left + side])
    middle = (top + round(float(rows.mean())), left + round(float(columns.mean())))
    top, left = (min(max(at - side // 2, 0), n - side) for at, n in zip(middle, bad.shape, strict=True))
    return Window(top, left, side)


def framed(image: NDArray[np.float64], arrays: Arrays, window: Window) -> NDArray[np.float64]:
    """Return a picture of errors [h, w, 3] enlarged, with the window framed and shown larger in an empty corner."""
    times = max(1, PIXELS // max(image.shape[:2]))
    side = min(SHARE * max(image.shape[:2]), MOST * min(image.shape[:2]))
    zoom = max(times + 1, round(times * side / window.side))
    height, width = (times * n for n in image.shape[:2])
    span = min(zoom * window.side, height - 2 * LINE, width - 2 * LINE)
    top, left = _corner(arrays, window, times, span + 2 * LINE)
    drawn = Image.fromarray(np.round(255 * images.repeated(image, times)).astype(np.uint8))
    pen = ImageDraw.Draw(drawn)
    frame = [times * window.left - LINE, times * window.top - LINE]
    frame += [times * (window.left + window.side) + LINE - 1, times * (window.top + window.side) + LINE - 1]
    inset = [left, top, left + span + 2 * LINE - 1, top + span + 2 * LINE - 1]
    for (x0, y0), (x1, y1) in _leaders(frame, inset):
        pen.line((x0, y0, x1, y1), fill=style.FAINT, width=1)
    pen.rectangle(frame, outline=style.INK, width=LINE)
    pen.rectangle(inset, outline=style.INK, width=LINE)
    made = np.asarray(drawn, np.float64) / 255
    crop = image[window.top : window.top + window.side, window.left : window.left + window.side]
    made[top + LINE : top + LINE + span, left + LINE : left + LINE + span] = images.repeated(crop, zoom)[:span, :span]
    return made


def _corner(arrays: Arrays, window: Window, times: int, span: int) -> tuple[int, int]:
    """Return the upper left corner, in pixels, of the square at a corner of the picture that hides least of it."""
    height, width = (times * n for n in arrays.truth.shape)
    shown = np.asarray((arrays.truth != TruthStatus.MISS) | (arrays.wrong > 0), np.float64)
    shown[window.top : window.top + window.side, window.left : window.left + window.side] = 1e6
    corners = [(top, left) for top in (0, height - span) for left in (0, width - span)]
    rays = [[slice(at // times, -(-(at + span) // times)) for at in corner] for corner in corners]
    return corners[int(np.argmin([shown[down, across].sum() for down, across in rays]))]


def _leaders(frame: list[int], inset: list[int]) -> list[tuple[tuple[int, int], tuple[int, int]]]:
    """Return the two lines from the corners of `frame` to those of `inset` that cross neither."""
    left, top, right, bottom = frame
    x0, y0, x1, y1 = inset
    falling = (x0 + x1 - left - right) * (y0 + y1 - top - bottom) > 0  # the inset is upper left or lower right of it
    if falling:
        return [((right, top), (x1, y0)), ((left, bottom), (x0, y1))]
    return [((left, top), (x0, y0)), ((right, bottom), (x1, y1))]
