"""Choose the figures and pictures of a run that a paper shows, and name them by what they are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import partial
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.figure import Figure as Drawing
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter

from reports import wording
from reports.analysis import derive, shown, viewstats
from reports.analysis.scene_names import picture_size
from reports.drawing import images, style
from reports.for_papers import column, stability
from reports.for_papers.model import Plate, distinct, exact, sentence, slug
from reports.material import Material
from reports.parts import growth
from reports.reading.tuples import tuples

_TITLED = ["surface_title", "view", "size", "samples_per_pixel", "precision", "device"]
_SCENE = ["view", "size", "samples_per_pixel", "stage", "scene"]


def scene_slugs(rows: pd.DataFrame) -> dict[str, str]:
    """Return a name for the files of each comparison: its surface, and what differs among those of that surface.

    Two comparisons of one name have their run's before it.
    """
    scenes = rows.drop_duplicates("comparison")
    differ = {
        surface: [n for n in _SCENE if own[n].nunique(dropna=False) > 1] for surface, own in scenes.groupby("surface")
    }
    named = {
        str(row.comparison): slug(
            str(row.surface), *(str(v) for n in differ[row.surface] if not wording.absent(v := getattr(row, n)))
        )
        for row in tuples(scenes)
    }
    shared = Counter(named.values())
    runs = dict(zip(scenes["comparison"].astype(str), scenes["run"].astype(str), strict=True))
    return {scene: slug(runs[scene], name) if shared[name] > 1 else name for scene, name in named.items()}


def several(rows: pd.DataFrame, *names: str) -> list[str]:
    """Return which of these columns have several values."""
    return [name for name in names if rows[name].nunique() > 1]


def groups(rows: pd.DataFrame) -> Iterator[tuple[str, str, pd.DataFrame]]:
    """Yield for each scene, device and precision its file's name, what it is in words, and its rows."""
    slugs, more = scene_slugs(rows), several(rows, "device", "precision")
    for (comparison, _, _), own in rows.groupby(derive.GROUP, sort=False):
        first = next(tuples(own[_TITLED].head(1)))
        name = slug(slugs[str(comparison)], *(str(getattr(first, column)) for column in more))
        place = f"{first.surface_title}, view {first.view}, {picture_size(first)}, {first.precision} on {first.device}"
        yield name, place, own


def plates(material: Material) -> list[Plate]:
    """Return every figure and picture, the figures first; [] where the run has nothing for one."""
    made = [*_speed_error(material), *_stability(material), *_views(material), *_growth(material), *_pictures(material)]
    return distinct(made, [f"{plate.title} {plate.caption}" for plate in made])


def _look(material: Material, by: str) -> column.Look:
    """Return how methods or variants are drawn; `by` is the column that has them."""
    frame = pd.concat([material.frame[["method", "variant"]], material.run.families[["method", "variant"]]])
    named = frame[(frame["method"] == material.focus) | (frame["variant"] == material.focus)]
    marks = style.marks(frame["method"]) if by == "method" else material.marks
    return column.Look(marks, list(named[by].unique()))


def _speed_error(material: Material) -> Iterator[Plate]:
    """Yield speed against error of each scene, device and precision with two rows or more."""
    rows = derive.contenders(material.listed)
    rows = rows[rows["error_max"].notna() & np.isfinite(rows["mrays_per_s"]) & (rows["mrays_per_s"] > 0)]
    look = _look(material, "method")
    for name, place, own in groups(rows):
        if len(own) > 1:
            told = sentence(
                f"{place}. Up is faster, left is more exact; a line joins the settings of a method.",
                "" if derive.all_right(own).all() else "Hollow marks answer some rays wrongly.",
                "What lies below and right of the black line is beaten in both." if own["front"].any() else "",
                "Hatched, where it is in sight: under twice the time of an empty kernel."
                if own["floor_ms"].iloc[0] > 0
                else "",
                exact(own["error_max"]),
            )
            draw = partial(column.speed_against_error, own, look)
            yield Plate(f"speed-error-{name}", "Speed against largest error.", told, draw)


def _stability(material: Material) -> Iterator[Plate]:
    """Yield for each device and precision which share of each ladder of hard rays a variant holds."""
    for of in stability.ladders(material):
        draw = partial(column.matrix, of.shares, of.told, of.strong)
        yield Plate(slug("stability", *of.more), f"Hard rays in {of.precision}.", of.caption, draw)


def _views(material: Material) -> Iterator[Plate]:
    """Yield for each set of views how the time per ray depends on the view."""
    sets = viewstats.view_sets(material.frame)
    look = _look(material, "variant")
    places = pd.DataFrame([of.first for of in sets])
    more = several(places, "view_set", "device", "precision", "size", "stage") if sets else []
    for of in sets:
        lines = [(variant, str(rows["label"].iloc[0]), rows) for variant, rows in of.variants()]
        if lines:
            wrong = bool((of.rows["wrong_rays"].fillna(0) > 0).any())
            told = sentence(
                f"{of.place}: {wording.plural(len(of.views), 'view')}, a mark each. A variant that does not depend on "
                "the view has all its marks at 1×.",
                "Hollow marks answer some rays wrongly." if wrong else "",
            )
            name = slug("view-dependence", str(of.first.surface), *(str(getattr(of.first, column)) for column in more))
            yield Plate(name, "View dependence.", told, partial(column.over_views, lines, look))


def _growth(material: Material) -> Iterator[Plate]:
    """Yield how time grows along each axis, a figure for each place."""
    look = _look(material, "variant")
    labels = dict(material.frame[["variant", "label"]].drop_duplicates().itertuples(index=False, name=None))
    for axis, curves, names in growth.of_run(material.listed):
        columns = zip(axis.fixed, zip(*names, strict=True), strict=True)
        differ = [name in ("surface", "scene") or len(set(values)) > 1 for name, values in columns]
        for place, title in names.items():
            own = [curve for curve in curves if curve.place == place]
            time = "ms above the floor" if axis.above_floor else "ms"
            draw = partial(column.growth, own, axis.unit, time, labels, look, axis.name == "pixels")
            told = f"{title}. Lines are the power laws that fit the points' logarithms best, where one does."
            name = slug("growth", axis.name, *(str(value) for value, own in zip(place, differ, strict=True) if own))
            yield Plate(name, f"Time against {axis.unit}.", told, draw)


def _pictures(material: Material) -> Iterator[Plate]:
    """Yield of each surface a picture, and the errors of each method on it, and the scale of their colours."""
    rows = shown.in_galleries(material.listed)
    scale = material.error_scale if len(rows) else (-8, -4)
    more = several(rows, "precision")
    drawn: set[str] = set()
    for row in tuples(rows):
        arrays = material.shelf.get(row)
        if arrays is None:
            continue
        if row.surface not in drawn:
            drawn.add(str(row.surface))
            told = f"{row.surface_title}, view {row.view}, drawn by {row.label} in {row.precision}."
            yield Plate(slug("render", str(row.surface)), "The surface.", told, png=images.png(images.shaded(arrays)))
        name = slug("errors", str(row.surface), str(row.label), *(str(getattr(row, column)) for column in more))
        yield Plate(name, f"Errors of {row.label}.", _told(row), png=images.png(images.error_map(arrays, scale)))
    if drawn:
        told = "The colours of |t − t*|, in scene units, and of wrong rays in the pictures of errors."
        yield Plate("error-scale", "Colours of errors.", told, partial(_scale, *scale))


def _told(row: Any) -> str:
    """Say what a map of errors shows; `row` is its row."""
    wrong = f"{wording.count(row.wrong_rays)} of {wording.count(row.accuracy_rays)} rays are wrong"
    wrong += images.wrong_apart(row).replace(" · ", ", ")
    return (
        f"{row.surface_title}, view {row.view}, {row.precision} on {row.device}: the largest error away from "
        f"silhouettes is {wording.error(row.error_max)} scene units; {wrong}. "
        "The colours are those of error-scale."
    )


def _scale(lowest: int, highest: int) -> Drawing:
    """Draw the colours of errors between two decades, and those of wrong rays."""
    colors = [
        (style.EXACT, "error 0"),
        *((kind.color, kind.title) for kind in style.WRONG),
        (style.UNDECIDED, "undecided"),
    ]
    handles = [(Patch(facecolor=color, edgecolor=style.FAINT, linewidth=0.3), label) for color, label in colors]
    with matplotlib.rc_context(column.SETTINGS):
        drawing, axes = column.keyed(0.14, handles, left=0.15, below=0.42)
        ramp = np.linspace(0, 1, 256)[None, :]
        axes.imshow(ramp, aspect="auto", cmap=style.ERROR_MAP, extent=(lowest, highest, 0, 1))
        axes.set_yticks([])
        axes.grid(visible=False)
        axes.xaxis.set_major_locator(FixedLocator(range(lowest, highest, max(2, (highest - lowest) // 4))))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: wording.power_of_ten(round(x))))
        axes.set_xlabel("|t − t*|, scene units")
    return drawing
