"""Make pictures of a run's arrays: what a method drew, and beside it its errors, on the rays of the accuracy check."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Sequence
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb
from numpy.typing import NDArray
from PIL import Image

from harness.contract import TruthStatus
from harness.results.schema import KINDS
from reports import wording
from reports.content import Gallery, Panel, Picture
from reports.drawing import plots, style
from reports.reading.arrays import Arrays, Shelf

PIXELS = 200  # pixels are repeated until the longer side has so many, because some viewers blur small pictures
HERO = 480  # pixels of a side of a large picture, which is printed 84 mm wide
PALE = 0.55  # how far the colour of a wrong ray fades to white where it is grazing or drowned
WIDEST_SCALE = 10  # decades of the colour scale of errors
STEPS = 80  # colours of that scale: what the eye tells apart, and what makes small files


def gallery(shelf: Shelf, rows: pd.DataFrame, caption: str, name: str, scale: tuple[int, int]) -> Gallery | None:
    """Make a gallery of the rows that have pictures, in their order; None where none has.

    A panel's title has the row's column `setting`, and its view if there are several. `name` begins the names of the
    pictures, so that they differ from others of the same rows; `scale` is what scale_of returns.
    """
    views = rows["view"].nunique() > 1
    rows = rows.assign(panel=rows["surface_title"] + (", " + rows["view"] if views else "") + ": " + rows["setting"])
    cells = shelf.together(rows)
    if not cells:
        return None
    panels = tuple(
        Panel(f"{row.panel}, {row.precision}", both(row, arrays, scale, f"{name}-"), note(row)) for row, arrays in cells
    )
    return Gallery(panels, f"{caption} {wording.ZERO}", plots.error_legend(*scale))


def scale_of(every: Iterable[Arrays], beside: Iterable[float] = ()) -> tuple[int, int]:
    """Return the first and the last decimal exponent of one colour scale for all errors of a report.

    The scale holds the positive errors of every picture, but for the smallest hundredth of each, and the positive
    errors `beside`. It spans at most WIDEST_SCALE decades, the largest ones.
    """
    positive = (arrays.error[(arrays.error > 0) & np.isfinite(arrays.error)] for arrays in every)
    ends = [(float(np.quantile(e, 0.01)), float(e.max())) for e in positive if e.size]
    ends = [*ends, *((error, error) for error in beside if error > 0.0)] or [(1e-7, 1e-3)]
    low, high = min(low for low, _ in ends), max(high for _, high in ends)
    highest = max(math.ceil(math.log10(high)), math.floor(math.log10(low)) + 1)
    return max(math.floor(math.log10(low)), highest - WIDEST_SCALE), highest


def both(row: Any, arrays: Arrays, scale: tuple[int, int], prefix: str = "") -> tuple[Picture, Picture]:
    """Return what one row drew, and its errors; `prefix` begins the pictures' names."""
    name = f"{row.label}, {row.precision}"
    return (
        Picture(f"{prefix}{row.key}-shade", png(shaded(arrays)), f"{row.surface_title} drawn by {name}"),
        Picture(f"{prefix}{row.key}-error", png(error_map(arrays, scale)), f"Errors of {name} on {row.surface_title}"),
    )


def note(row: Any) -> str:
    """Write a row's largest error, its wrong rays by kind, and those that are counted apart."""
    counts = zip((getattr(row, kind) for kind in KINDS), style.WRONG, strict=True)
    wrong = ", ".join(f"{kind.title} {n:,}" for n, kind in counts if not wording.absent(n) and n > 0)
    return f"max {wording.error(row.error_max)} · {wrong or 'no wrong ray away from silhouettes'}{wrong_apart(row)}"


def wrong_apart(row: Any) -> str:
    """Write how many grazing and drowned rays of a row are wrong, to end a note with; "" where none are wrong."""
    counts = {"grazing": row.grazing_wrong_rays, "drowned": row.drowned_wrong_rays}
    told = (f" · {wording.count(n)} wrong at {name}" for name, n in counts.items() if not wording.absent(n) and n > 0)
    return "".join(told)


def outline(every: Sequence[Arrays]) -> tuple[slice, slice]:
    """Return the rows and the columns that show what any of these hit, with a margin; all arrays are of one scene."""
    height, width = every[0].truth.shape
    shown = np.zeros((height, width), np.bool_)
    for arrays in every:
        shown |= (arrays.truth != TruthStatus.MISS) | (arrays.wrong > 0)
    margin = max(1, max(height, width) // 40)
    ends = []
    for along, length in ((1, height), (0, width)):
        (at,) = np.nonzero(shown.any(axis=along))
        low, high = (int(at[0]), int(at[-1]) + 1) if at.size else (0, length)
        ends.append(slice(max(0, low - margin), min(length, high + margin)))
    return ends[0], ends[1]


def shaded(arrays: Arrays) -> NDArray[np.float64]:
    """Paint the hit points lit from the camera, on white; returns float64[h, w, 3] in 0…1.

    A pixel with several samples has their mean colour.
    """
    shade = arrays.shade if arrays.samples is None else arrays.samples
    light = np.clip(np.nan_to_num(shade.astype(np.float64)), 0.0, 1.0)
    colors = np.where(np.isnan(shade)[..., None], 1.0, _lit(light))
    height, width = arrays.shade.shape
    return np.asarray(colors.reshape(height, len(shade) // height, width, -1, 3).mean(axis=(1, 3)))


def hero(arrays: Arrays, pixels: int = HERO) -> NDArray[np.float64]:
    """Paint the hit points as `shaded` does, smoothly enlarged; returns float64[h, w, 3] in 0…1.

    The longer side has at least `pixels`, and more only where the arrays do. Shades and the surface's outline are
    interpolated separately, so that the outline stays sharp.
    """
    shade = (arrays.shade if arrays.samples is None else arrays.samples).astype(np.float64)
    covered = ~np.isnan(shade)
    times = max(1.0, pixels / max(shade.shape))
    size = (round(times * shade.shape[1]), round(times * shade.shape[0]))
    light = np.clip(_resized(_spread(shade), size), 0.0, 1.0)
    # an outline at 0.42 of the smoothed cover keeps thin spikes; its edge is about two of the arrays' pixels wide, and
    # steep enough that no cover at all is the background
    steep = max(0.45 * times, 0.5 / 0.42)
    cover = np.clip((_resized(_smoothed(covered.astype(np.float64)), size) - 0.42) * steep + 0.5, 0.0, 1.0)
    cover = np.round(cover * 8) / 8  # at most 256 colours: 129 of whole pixels, 7 × 18 at the edge
    levels = np.where(cover == 1.0, 128, 17)
    return np.asarray(_lit(np.round(light * levels) / levels) * cover[..., None] + (1.0 - cover[..., None]))


def _lit(light: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the colours of a surface's points by how much light [h, w] they have, as float64[h, w, 3]."""
    shadow, lit = _rgb(style.SURFACE_SHADOW), _rgb(style.SURFACE_LIGHT)
    return np.asarray(shadow + (lit - shadow) * light[..., None])


def _resized(values: NDArray[np.float64], size: tuple[int, int]) -> NDArray[np.float64]:
    """Return `values` [h, w] interpolated to `size`, which is (width, height)."""
    return np.asarray(Image.fromarray(values.astype(np.float32)).resize(size, Image.Resampling.BICUBIC), np.float64)


def _neighbours(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return for each of `values` [h, w] itself and its eight neighbours as float64[9, h, w]; NaN outside."""
    height, width = values.shape
    wide = np.pad(values, 1, constant_values=np.nan)
    return np.stack([wide[i : i + height, j : j + width] for i in range(3) for j in range(3)])


def _spread(shade: NDArray[np.float64], pixels: int = 4) -> NDArray[np.float64]:
    """Continue shades [h, w] by some pixels into the background, which is NaN; beyond them are zeros."""
    for _ in range(pixels):
        around = _neighbours(shade)
        known = ~np.isnan(around)
        count = known.sum(axis=0)
        mean = np.where(known, around, 0.0).sum(axis=0) / np.maximum(count, 1)
        shade = np.where(np.isnan(shade) & (count > 0), mean, shade)
    return np.nan_to_num(shade)


def _smoothed(cover: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean of each pixel's neighbourhood, the nearer ones weighing more; float64[h, w]."""
    weights = np.array([1.0, 2.0, 1.0, 2.0, 4.0, 2.0, 1.0, 2.0, 1.0]) / 16.0
    return np.asarray(np.tensordot(weights, np.nan_to_num(_neighbours(cover)), axes=1))


def error_map(arrays: Arrays, scale: tuple[int, int]) -> NDArray[np.float64]:
    """Paint errors by colour between the decades of `scale`, and wrong rays in the colour of their kind.

    Returns float64[h, w, 3] in 0…1.
    """
    lowest, highest = scale
    error = arrays.error.astype(np.float64)
    positive = np.isfinite(error) & (error > 0)
    level = (np.log10(np.where(positive, error, 1.0)) - lowest) / (highest - lowest)
    level = np.round(np.clip(level, 0.0, 1.0) * (STEPS - 1)) / (STEPS - 1)
    image = np.ones((*error.shape, 3))
    image[error == 0] = _rgb(style.EXACT)
    image[positive] = matplotlib.colormaps[style.ERROR_MAP](level[positive])[:, :3]
    image[arrays.truth == TruthStatus.UNDECIDED] = _rgb(style.UNDECIDED)
    for kind in style.WRONG:
        color = _rgb(kind.color)
        image[(arrays.wrong == kind.code) & ~arrays.apart] = color
        image[(arrays.wrong == kind.code) & arrays.apart] = color + PALE * (1 - color)
    return image


def _rgb(color: str) -> NDArray[np.float64]:
    """Return a colour as float64[3] in 0…1."""
    return np.asarray(to_rgb(color))


def repeated(image: NDArray[Any], times: int) -> NDArray[Any]:
    """Return an image [h, w, 3] with each pixel as a square of `times` pixels a side."""
    return image.repeat(times, axis=0).repeat(times, axis=1)


def png(image: NDArray[np.float64]) -> bytes:
    """Return an image float64[h, w, 3] in 0…1 as the bytes of a PNG file, its pixels repeated as PIXELS says.

    An image of at most 256 colours is stored with a palette.
    """
    pixels = repeated(np.round(255 * image).astype(np.uint8), max(1, -(-PIXELS // max(image.shape[:2]))))
    buffer = io.BytesIO()
    _stored(pixels).save(buffer, "PNG", compress_level=9)
    return buffer.getvalue()


def _stored(pixels: NDArray[np.uint8]) -> Image.Image:
    """Return pixels uint8[h, w, 3] as an image, with a palette where that is enough."""
    codes = pixels.astype(np.uint32) @ np.array([65536, 256, 1], np.uint32)
    colors, index = np.unique(codes, return_inverse=True)
    if len(colors) > 256:
        return Image.fromarray(pixels)
    image = Image.fromarray(index.reshape(codes.shape).astype(np.uint8), "P")
    image.putpalette(bytes(int(c) >> shift & 255 for c in colors for shift in (16, 8, 0)))
    return image
