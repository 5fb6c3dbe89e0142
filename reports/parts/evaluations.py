"""Evaluations ray by ray: where a method spends its work, and where it errs (toledo2007, Fig. 4)."""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure as Drawing
from matplotlib.ticker import FixedLocator, FuncFormatter
from numpy.typing import NDArray

from reports import wording
from reports.analysis import shown
from reports.content import Block, Figure, Gallery, Panel, Picture, Section, Text
from reports.drawing import images, style
from reports.drawing.canvas import RC, svg
from reports.material import Material
from reports.reading.arrays import Arrays
from reports.reading.tuples import tuples

ORDER = 27
PAGED = 2  # a run with more surfaces has its maps in the details
PANELS = 20  # of a page, the fastest variants
ACROSS = 5
COLORS = "viridis"
TITLE = "Evaluations, ray by ray"
SEEN = (
    "How often each ray evaluates f, from dark to bright on one logarithmic scale. Bright rings along silhouettes are "
    "rays that nearly touch the surface, where iterations creep (toledo2007, Fig. 4)."
)
EXPLANATION = (
    f"The errors of these rays are on the surfaces' pages. {wording.ZERO} Wrong rays are those away from "
    "silhouettes; grazing and drowned ones are counted apart, and “max” leaves them out. “Per ray cast” counts those "
    "that pass the domain by too, as every table of this report does. Of the device with most results, in its first "
    "precision."
)


def sections(material: Material) -> list[Section]:
    """Make a section with the maps of each surface; [] where no row stores evaluations, or none was spent.

    A page shows the fastest variants of at most PAGED surfaces; all maps are in the details.
    """
    cells: list[tuple[Any, Arrays]] = []
    for row in tuples(shown.in_evaluation_maps(material.frame)):
        arrays = material.shelf.get(row)
        if arrays is not None and arrays.evaluations is not None and arrays.evaluations.any():
            cells.append((row, arrays))
    if not cells:
        return []
    most = max(2, *(int(arrays.evaluations.max()) for _, arrays in cells if arrays.evaluations is not None))
    surfaces = list(dict.fromkeys(row.surface for row, _ in cells))
    panels = {name: [_panel(row, a, most) for row, a in cells if row.surface == name] for name in surfaces}
    every: list[Block] = [Text(EXPLANATION), *(Gallery(tuple(own), "") for own in panels.values())]
    told: list[Block] = [Text(SEEN), _legend(most)]
    if len(surfaces) > PAGED:
        return [Section(TITLE, (), (*told, *every))]
    fastest = sorted(cells, key=lambda cell: (wording.absent(cell[0].median_ms), cell[0].median_ms))
    per_surface = PANELS // len(surfaces)
    page = [
        _panel(row, a, most)
        for name in surfaces
        for row, a in [cell for cell in fastest if cell[0].surface == name][:per_surface]
    ]
    if len(page) == len(cells):
        return [Section(TITLE, (*told, Text(EXPLANATION), Gallery(tuple(page), "", across=ACROSS)), own_page=True)]
    cut = f"The fastest {per_surface} variants of each surface."
    return [Section(TITLE, (*told, Gallery(tuple(page), cut, across=ACROSS)), tuple(every), own_page=True)]


def evaluation_map(evaluations: NDArray[np.int32], most: int) -> NDArray[np.float64]:
    """Paint counts [h, w] from 1 to `most` by colour, and 0 white; returns float64[h, w, 3] in 0…1."""
    level = np.log(np.maximum(evaluations, 1)) / np.log(most)
    image = matplotlib.colormaps[COLORS](np.clip(level, 0.0, 1.0))[..., :3]
    image[evaluations == 0] = to_rgb(style.PAPER)
    return np.asarray(image)


def _panel(row: Any, arrays: Arrays, most: int) -> Panel:
    """Show the evaluations of one row."""
    assert arrays.evaluations is not None
    name = f"{row.label}, {row.surface_title}, {row.view}"
    painted = images.png(evaluation_map(arrays.evaluations, most))
    pictures = (Picture(f"{row.key}-evaluations", painted, f"Evaluations of {name}"),)
    spent = arrays.evaluations[arrays.evaluations > 0]
    cost = (
        f"{wording.number(arrays.evaluations.mean())} per ray cast, {wording.number(spent.mean())} "
        f"per ray that spends any, at most {spent.max():,}"
    )
    of = wording.count(row.accuracy_rays)
    wrong = f"{wording.count(row.wrong_rays)} of {of} wrong" if row.wrong_rays else f"none of {of} wrong"
    return Panel(name, pictures, f"{cost} · max {wording.error(row.error_max)} · {wrong}{images.wrong_apart(row)}")


def _legend(most: int) -> Figure:
    """Draw the colour bar of counts from 1 to `most`."""
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(6.8, 0.42))
        bar = drawing.add_axes((0.03, 0.6, 0.36, 0.36))
        top = float(np.log10(most))
        bar.imshow(np.linspace(0, 1, 256)[None], aspect="auto", cmap=COLORS, extent=(0, top, 0, 1))
        bar.set_yticks([])
        bar.grid(visible=False)
        within = (1, 2, 5) if top < 2.5 else (1,)
        ticks = [d * 10**e for e in range(int(top) + 1) for d in within if d * 10**e <= most]
        bar.xaxis.set_major_locator(FixedLocator([float(np.log10(tick)) for tick in ticks]))
        bar.xaxis.set_major_formatter(FuncFormatter(lambda place, _: f"{round(10**place):,}"))
        drawing.text(0.41, 0.68, "evaluations of f on a ray; white: none", va="center", fontsize=7)
        return Figure(f"evaluations-legend-{most}", svg(drawing), "Colours of evaluation counts.")
