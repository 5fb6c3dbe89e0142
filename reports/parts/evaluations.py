"""Evaluations ray by ray: where a method spends its work, and where it errs (toledo2007, Fig. 4)."""

from __future__ import annotations

from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure as Drawing
from matplotlib.ticker import FixedLocator, FuncFormatter
from numpy.typing import NDArray

from harness.contract import CellStatus
from reports import wording
from reports.content import Block, Figure, Gallery, Panel, Picture, Section, Text
from reports.drawing import images, plots, style
from reports.drawing.canvas import RC, svg
from reports.reading.arrays import Arrays, Shelf

EVERY_VIEW = 3  # views of a surface that are all shown; of more, each variant's worst
MOST_SURFACES = 4  # of a run that has this section
MAP = "viridis"
EXPLANATION = (
    "Evaluations of f that each ray costs, from dark to bright on one logarithmic scale, and beside it its error, in "
    f"the colours of all pictures of this report. {wording.ZERO} Bright rings along silhouettes are rays that nearly "
    "touch the surface: sphere tracing's critical case, in toledo2007's Fig. 4. Wrong rays are those away from "
    "silhouettes; grazing and drowned ones are counted apart, and “max” leaves them out. “Per ray cast” counts those "
    "that pass the domain by too, as every table of this report does. Of the device with most results, in its first "
    "precision."
)


def drawn(frame: pd.DataFrame) -> pd.DataFrame:
    """The rows whose rays are shown; none in runs of more than MOST_SURFACES."""
    rows = frame[(frame["status"] == CellStatus.OK) & frame["answers"] & frame["arrays"].notna()]
    if rows.empty or rows["surface"].nunique() > MOST_SURFACES:
        return rows.head(0)
    rows = rows[rows["device"] == rows["device"].value_counts(sort=False).idxmax()]
    rows = rows[rows["precision"] == rows["precision"].iloc[0]].drop_duplicates(["surface", "view", "variant"])
    by_surface = (own for _, own in rows.groupby("surface", sort=False))
    return pd.concat([own if own["view"].nunique() <= EVERY_VIEW else _worst(own) for own in by_surface])


def sections(shelf: Shelf, frame: pd.DataFrame, errors: tuple[int, int]) -> list[Section]:
    """A gallery for each surface; no section where no cell tells its evaluations. `errors` is of images.scale_of."""
    shown: list[tuple[Any, Arrays]] = []
    for row in drawn(frame).itertuples():
        arrays = shelf.get(row)
        if arrays is not None and arrays.evaluations is not None:
            shown.append((row, arrays))
    if not shown:
        return []
    most = max(int(arrays.evaluations.max()) for _, arrays in shown if arrays.evaluations is not None)
    counted = _legend(max(most, 2))
    blocks: list[Block] = [Text(EXPLANATION), counted]
    for surface in dict.fromkeys(row.surface for row, _ in shown):
        own_panels = tuple(_panel(row, a, max(most, 2), errors) for row, a in shown if row.surface == surface)
        blocks.append(Gallery(own_panels, "", plots.error_legend(*errors)))
    return [Section("Evaluations, ray by ray", tuple(blocks))]


def _worst(rows: pd.DataFrame) -> pd.DataFrame:
    """For each variant the view with most wrong rays, among equals the one with most evaluations on a ray."""
    ordered = rows.sort_values(["wrong_rays", "evaluations_max", "evaluations_mean"], ascending=False, kind="stable")
    return rows.loc[sorted(ordered.drop_duplicates("variant").index)]


def evaluation_map(evaluations: NDArray[np.int32], most: int) -> NDArray[np.float64]:
    """float64[h, w, 3] in 0…1: counts from 1 to `most` by colour, white where a ray cost none."""
    level = np.log(np.maximum(evaluations, 1)) / np.log(most)
    image = matplotlib.colormaps[MAP](np.clip(level, 0.0, 1.0))[..., :3]
    image[evaluations == 0] = to_rgb(style.PAPER)
    return np.asarray(image)


def _panel(row: Any, arrays: Arrays, most: int, errors: tuple[int, int]) -> Panel:
    assert arrays.evaluations is not None
    name = f"{row.variant}, {row.surface_title}, {row.view}"
    pictures = (
        Picture(
            f"{row.key}-evaluations", images.png(evaluation_map(arrays.evaluations, most)), f"Evaluations of {name}"
        ),
        Picture(f"{row.key}-errors", images.png(images.error_map(arrays, errors)), f"Errors of {name}"),
    )
    spent = arrays.evaluations[arrays.evaluations > 0]
    cost = "no evaluation"
    if spent.size:
        cost = (
            f"evaluations: {wording.number(arrays.evaluations.mean())} per ray cast, {wording.number(spent.mean())} "
            f"per ray that spends any, at most {spent.max():,}"
        )
    of = wording.count(row.accuracy_rays)
    wrong = f"{wording.count(row.wrong_rays)} of {of} wrong" if row.wrong_rays else f"none of {of} wrong"
    grazing = f" · {wording.count(row.grazing_wrong_rays)} wrong at grazing" if row.grazing_wrong_rays else ""
    drowned = f" · {wording.count(row.drowned_wrong_rays)} wrong at drowned" if row.drowned_wrong_rays else ""
    return Panel(name, pictures, f"{cost} · max {wording.error(row.error_max)} · {wrong}{grazing}{drowned}")


def _legend(most: int) -> Figure:
    with matplotlib.rc_context(RC):
        drawing = Drawing(figsize=(6.8, 0.42))
        bar = drawing.add_axes((0.03, 0.6, 0.36, 0.36))
        top = float(np.log10(most))
        bar.imshow(np.linspace(0, 1, 256)[None], aspect="auto", cmap=MAP, extent=(0, top, 0, 1))
        bar.set_yticks([])
        bar.grid(visible=False)
        within = (1, 2, 5) if top < 2.5 else (1,)
        ticks = [d * 10**e for e in range(int(top) + 1) for d in within if d * 10**e <= most]
        bar.xaxis.set_major_locator(FixedLocator([float(np.log10(tick)) for tick in ticks]))
        bar.xaxis.set_major_formatter(FuncFormatter(lambda place, _: f"{round(10**place):,}"))
        drawing.text(0.41, 0.68, "evaluations of f on a ray; white: none", va="center", fontsize=6.5)
        return Figure(f"evaluations-legend-{most}", svg(drawing), "Colours of evaluation counts.")
