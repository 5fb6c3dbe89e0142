"""Make pictures of a run's arrays: what a method drew, and beside it its errors, on the rays of the accuracy check."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable
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
from reports.analysis import shown
from reports.content import Gallery, Panel, Picture
from reports.drawing import plots, style
from reports.reading.arrays import Arrays, Shelf

PIXELS = 480  # pixels are repeated until the longer side has so many, because some viewers blur small pictures
PALE = 0.55  # how far the colour of a wrong ray fades to white where it is grazing or drowned
WIDEST_SCALE = 10  # decades of the colour scale of errors


def galleries(shelf: Shelf, frame: pd.DataFrame, scale: tuple[int, int]) -> dict[str, Gallery]:
    """Make a gallery for each surface that has pictures, by its name; `scale` is what scale_of returns."""
    picked: dict[str, list[tuple[Any, Arrays]]] = {}
    for row in shown.in_galleries(frame).itertuples():
        arrays = shelf.get(row)
        if arrays is not None:
            picked.setdefault(str(row.surface), []).append((row, arrays))
    return {surface: _gallery(cells, scale, _caption(cells[0][0])) for surface, cells in picked.items()}


def gallery(shelf: Shelf, rows: pd.DataFrame, caption: str, name: str, scale: tuple[int, int]) -> Gallery | None:
    """Make a gallery of the rows that have pictures, in their order; None where none has.

    A panel's title has the row's column `setting`, and its view if there are several. `name` begins the names of the
    pictures, so that they differ from others of the same rows; `scale` is what scale_of returns.
    """
    views = rows["view"].nunique() > 1
    rows = rows.assign(panel=rows["surface_title"] + (", " + rows["view"] if views else "") + ": " + rows["setting"])
    cells = [(row, arrays) for row in rows.itertuples() if (arrays := shelf.get(row)) is not None]
    if not cells:
        return None
    return _gallery(cells, scale, f"{caption} {wording.ZERO}", f"{name}-", titled=True)


def _gallery(
    cells: list[tuple[Any, Arrays]], scale: tuple[int, int], caption: str, name: str = "", titled: bool = False
) -> Gallery:
    """Make a gallery with a panel for each row."""
    panels = tuple(_panel(row, arrays, scale, name, titled) for row, arrays in cells)
    return Gallery(panels, caption, plots.error_legend(*scale))


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


def _panel(row: Any, arrays: Arrays, scale: tuple[int, int], prefix: str, titled: bool) -> Panel:
    """Show what one row drew beside its errors; `titled` by its column `panel`, else by its variant."""
    name = f"{row.variant}, {row.precision}"
    pictures = (
        Picture(f"{prefix}{row.key}-shade", png(shaded(arrays)), f"{row.surface_title} drawn by {name}"),
        Picture(f"{prefix}{row.key}-error", png(error_map(arrays, scale)), f"Errors of {name} on {row.surface_title}"),
    )
    counts = zip((getattr(row, kind) for kind in KINDS), style.WRONG, strict=True)
    wrong = ", ".join(f"{kind.title} {n:,}" for n, kind in counts if not wording.absent(n) and n > 0)
    note = f"max {wording.error(row.error_max)} · {wrong or 'no wrong ray away from silhouettes'}{wrong_apart(row)}"
    return Panel(f"{row.panel}, {row.precision}" if titled else name, pictures, note)


def wrong_apart(row: Any) -> str:
    """Write how many grazing and drowned rays of a row are wrong, to end a note with; "" where none are wrong."""
    counts = {"grazing": row.grazing_wrong_rays, "drowned": row.drowned_wrong_rays}
    told = (f" · {wording.count(n)} wrong at {name}" for name, n in counts.items() if not wording.absent(n) and n > 0)
    return "".join(told)


def _caption(row: Any) -> str:
    """Write the caption of one surface's gallery; `row` is one of its rows, which are all of one scene and device."""
    return (
        f"{row.surface_title} on {row.device}, view {row.view}: what each method drew, and its error beside it. Dark "
        "blue to yellow is a growing |t − t*| on one logarithmic scale for all pictures of this report, whose end "
        f"colours also stand for what lies beyond. {wording.ZERO} The bright colours are rays answered wrongly, paler "
        "where they graze the surface or f drowns in its own rounding; counts are of the "
        f"{wording.count(row.accuracy_rays)} rays checked, and max is the largest error away from silhouettes. Look "
        "for wrong rays away from the silhouette, and for bands or facets in the error."
    )


def shaded(arrays: Arrays) -> NDArray[np.float64]:
    """Paint the hit points lit from the camera, on white; returns float64[h, w, 3] in 0…1.

    A pixel with several samples has their mean colour.
    """
    shade = arrays.shade if arrays.samples is None else arrays.samples
    light = np.clip(np.nan_to_num(shade.astype(np.float64)), 0.0, 1.0)[..., None]
    lit = _rgb(style.SURFACE_SHADOW) * (1 - light) + _rgb(style.SURFACE_LIGHT) * light
    colors = np.where(np.isnan(shade)[..., None], 1.0, lit)
    height, width = arrays.shade.shape
    return np.asarray(colors.reshape(height, len(shade) // height, width, -1, 3).mean(axis=(1, 3)))


def error_map(arrays: Arrays, scale: tuple[int, int]) -> NDArray[np.float64]:
    """Paint errors by colour between the decades of `scale`, and wrong rays in the colour of their kind.

    Returns float64[h, w, 3] in 0…1.
    """
    lowest, highest = scale
    error = arrays.error.astype(np.float64)
    positive = np.isfinite(error) & (error > 0)
    level = (np.log10(np.where(positive, error, 1.0)) - lowest) / (highest - lowest)
    image = np.ones((*error.shape, 3))
    image[error == 0] = _rgb(style.EXACT)
    image[positive] = matplotlib.colormaps[style.ERROR_MAP](np.clip(level[positive], 0, 1))[:, :3]
    image[arrays.truth == TruthStatus.UNDECIDED] = _rgb(style.UNDECIDED)
    for kind in style.WRONG:
        color = _rgb(kind.color)
        image[(arrays.wrong == kind.code) & ~arrays.apart] = color
        image[(arrays.wrong == kind.code) & arrays.apart] = color + PALE * (1 - color)
    return image


def _rgb(color: str) -> NDArray[np.float64]:
    """Return a colour as float64[3] in 0…1."""
    return np.asarray(to_rgb(color))


def png(image: NDArray[np.float64]) -> bytes:
    """Return an image float64[h, w, 3] in 0…1 as the bytes of a PNG file, its pixels repeated as PIXELS says."""
    times = max(1, -(-PIXELS // max(image.shape[:2])))
    pixels = np.round(255 * image).astype(np.uint8).repeat(times, axis=0).repeat(times, axis=1)
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()
