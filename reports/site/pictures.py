"""Draw the pictures of a site, and count stored answers anew, to see whether rows say what their answers are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.colors import to_hex
from numpy.typing import NDArray
from PIL import Image

from harness.contract import digest
from harness.results.schema import KINDS
from reports import wording
from reports.drawing import images, style
from reports.reading.arrays import Arrays, Shelf
from reports.site.markup import Html, join, tag
from reports.site.standings import Race, usable

SHADES = 9  # colours that the legend's bar is made of
COLORS = 256  # of a picture
CLOSE = 1e-5  # by how much of itself an error in a row may differ from the float32 that is stored of its ray


@dataclass(frozen=True)
class Pair:
    """Hold the paths of a row's two pictures below the site's folder, and their sizes in pixels."""

    shade: str
    error: str
    width: int
    height: int


def chosen(races: Sequence[Race], full: Iterable[Race]) -> dict[tuple[str, str], Any]:
    """Return the rows that have pictures, by run and key.

    They are the winners of each of `races` and what is faster but wrong and, of each race of `full`, the fastest usable
    variant of each method, else its fastest.
    """
    rows: list[Any] = []
    for race in races:
        for won in race.won.values():
            rows += [row for row in (won.winner, won.faster) if row is not None]
    for race in full:
        good = usable(race.rows, 1e-3).drop_duplicates("method")
        rest = race.rows[~race.rows["method"].isin(good["method"])].drop_duplicates("method")
        rows += [*good.itertuples(), *rest.itertuples()]
    return {(row.at, row.key): row for row in rows if not wording.absent(row.arrays)}


def recounted(shelf: Shelf, rows: Iterable[Any]) -> tuple[dict[tuple[str, str], Arrays], list[str]]:
    """Read the answers of `rows`, by run and key, and say of which rows the counts are not those of their answers.

    What is missing or damaged is noted in `shelf.damaged`.
    """
    found: dict[tuple[str, str], Arrays] = {}
    wrong: list[str] = []
    for row in rows:
        arrays = shelf.get(row)
        if arrays is None:
            continue
        found[row.at, row.key] = arrays
        if told := _differs(row, arrays):
            wrong.append(f"{row.at}: {row.slot}: {told}")
    return found, wrong


def _differs(row: Any, arrays: Arrays) -> str:
    """Say how a row differs from its stored answers; "" where it does not."""
    told = []
    for kind, code in zip(KINDS, style.WRONG, strict=True):
        counted = int(((arrays.wrong == code.code) & ~arrays.apart).sum())
        stated = getattr(row, kind)
        if not wording.absent(stated) and int(stated) != counted:
            told.append(f"{kind} {int(stated):,}, and {counted:,} by its stored answers")
    errors = arrays.error[~arrays.apart & np.isfinite(arrays.error)]
    largest = float(errors.max()) if errors.size else 0.0
    stated = 0.0 if wording.absent(row.error_max) else float(row.error_max)
    if abs(largest - stated) > CLOSE * max(largest, stated):
        told.append(f"largest error {wording.error(stated)}, and {wording.error(largest)} by its stored answers")
    return "; ".join(told)


def write(
    folder: Path, arrays: Mapping[tuple[str, str], Arrays], scale: tuple[int, int]
) -> dict[tuple[str, str], Pair]:
    """Write the pictures of `arrays` below `folder`/pictures; equal ones are one file. Returns them by run and key."""
    (folder / "pictures").mkdir()
    made = {}
    for at, own in arrays.items():
        paths = [_save(folder, image) for image in (images.shaded(own), images.error_map(own, scale))]
        height, width = own.shade.shape
        made[at] = Pair(paths[0], paths[1], width, height)
    return made


def _save(folder: Path, image: NDArray[np.float64]) -> str:
    """Write an image [h, w, 3] in 0…1 as a PNG of few colours under the name of its pixels; return its path."""
    pixels = np.round(255 * image).astype(np.uint8)
    path = f"pictures/{digest(pixels.tobytes().hex(), pixels.shape)}.png"
    if not (folder / path).exists():
        Image.fromarray(pixels).quantize(COLORS, dither=Image.Dither.NONE).save(folder / path, "PNG", optimize=True)
    return path


def shown(pair: Pair, row: Any, up: str) -> Html:
    """Write the two pictures of a row with what they tell; `up` leads from the page to the site's folder."""
    note = f"{wording.number(row.median_ms)} ms · {images.note(row)}"
    both = (("drawn by", pair.shade), ("errors of", pair.error))
    size = {"width": pair.width, "height": pair.height, "loading": "lazy", "decoding": "async"}
    drawn = [
        tag("img", src=up + path, alt=f"{row.surface_title}, {said} {row.label} on {row.on}", **size)
        for said, path in both
    ]
    title = tag("a", row.label, href=f"#{anchor(row)}")
    return tag("figure", tag("div", *drawn, class_="pair"), tag("figcaption", tag("b", title), " ", note))


def anchor(row: Any) -> str:
    """Return the id of a row on its surface's page."""
    return f"r-{row.at}-{row.key}"


def legend(scale: tuple[int, int]) -> Html:
    """Explain the colours of error maps: the scale of errors between two powers of ten, and the kinds of wrong rays."""
    low, high = scale
    colors = [to_hex(c) for c in matplotlib.colormaps[style.ERROR_MAP](np.linspace(0.0, 1.0, SHADES))]
    bar = tag("span", class_="bar", style=f"background: linear-gradient(to right, {', '.join(colors)})")
    ends = (wording.power_of_ten(low), wording.power_of_ten(high))
    kinds = [
        ("error 0", style.EXACT),
        *((kind.title, kind.color) for kind in style.WRONG),
        ("undecided", style.UNDECIDED),
    ]
    swatches = [tag("span", tag("i", style=f"background: {color}"), name, class_="swatch") for name, color in kinds]
    return tag("p", "|t − t*| in scene units: ", ends[0], " ", bar, " ", ends[1], " ", join(*swatches), class_="legend")
