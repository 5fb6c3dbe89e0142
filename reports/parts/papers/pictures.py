"""Show the papers' pictures: what each setting drew, its errors, and how many rays it got wrong."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from reports import wording
from reports.analysis import derive
from reports.claims import figures, picks
from reports.claims.evidence import run_of
from reports.claims.figures import Figure
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Block, Column, Gallery, Panel, Picture, Section, Table, Text
from reports.drawing import images, plots
from reports.material import Material
from reports.reading.arrays import Arrays
from reports.reading.tuples import tuples

ORDER = 30
ACROSS = 6  # pictures on a line of a page
PAIRS = 3  # pairs of pictures on a line
Drawn = tuple[Any, Arrays]  # a row, and its arrays


def sections(material: Material) -> list[Section]:
    """Make a section for each figure whose config this run holds; what a figure shows zoomed is in its section."""
    made = []
    for title, parts in itertools.groupby(figures.FIGURES, key=lambda figure: ", ".join(figure.title.split(", ")[:2])):
        found = [(figure, rows) for figure in parts if len(rows := figures.rows_of(figure, material.evidence))]
        if found:
            made.append(_section(material, title, found))
    return made


def _section(material: Material, title: str, found: list[tuple[Figure, pd.DataFrame]]) -> Section:
    """Make the section of one figure from its parts, each with the rows that it shows."""
    blocks: list[Block] = []
    details: list[Block] = []
    for figure, rows in found:
        legend = not any(isinstance(block, Gallery) for block in blocks)  # one for all parts
        pictures = _galleries(material, figure, rows, legend)
        configs = (figure.config,) if figure.judged else ()
        blocks += [introduced(f"{figure.told} {figure.caption}", material.judged, *configs), *pictures]
        details += [*([Text(figure.made)] if figure.made else []), _counts(rows, figure.title)]
        details += verdict_tables(material.judged, figure.config, figure.title) if figure.judged else []
    return Section(title, tuple(blocks), tuple(details))


def _galleries(material: Material, figure: Figure, rows: pd.DataFrame, legend: bool) -> list[Gallery]:
    """Make galleries of full lines of pictures; [] where no row has any. The first has the key of errors if `legend`.

    A line that is not full has a gallery of its own, so that what comes after it begins a line.
    """
    drawn = material.shelf.together(rows)
    if not drawn:
        return []
    painter = Painter(f"{run_of(figure.config)}-", material.error_scale, _titles(drawn))
    if figure.surfaces == tuple(picks.BEAM_SURFACES):
        return [Gallery(painter.shades(drawn, noted=True), "", across=ACROSS)]
    one_surface = rows["surface"].nunique() == 1
    if one_surface and rows["view"].nunique() > 1 and rows["setting"].nunique() > 1:
        lines = painter.view_by_view(drawn)
    elif len(drawn) <= PAIRS:
        lines = [painter.pairs(drawn)]
    else:
        lines = [panels for line in _batched(drawn) for panels in (painter.shades(line), painter.errors(line))]
    across = PAIRS if len(lines) == 1 else ACROSS
    full = all(len(line) == across for line in lines)
    galleries = [tuple(panel for line in lines for panel in line)] if full else lines
    told = f"Errors in scene units, from blue to yellow. {wording.ZERO}" if legend else ""
    first = Gallery(galleries[0], told, plots.error_legend(*material.error_scale) if legend else None, across)
    return [first, *(Gallery(panels, "", across=across) for panels in galleries[1:])]


@dataclass(frozen=True)
class Painter:
    """Make panels with one picture each; `place` begins the names of pictures, `titles` has a title for each row."""

    place: str
    scale: tuple[int, int]  # of errors, as images.scale_of returns it
    titles: Mapping[str, str]  # by the row's key

    def shades(self, line: Iterable[Drawn], noted: bool = False) -> tuple[Panel, ...]:
        """Show what each row drew under its title, with its note if `noted`."""
        return tuple(
            self._panel(row, images.shaded(arrays), "shade", self.titles[row.key], noted) for row, arrays in line
        )

    def errors(self, line: Iterable[Drawn], title: str = "") -> tuple[Panel, ...]:
        """Show each row's errors with its note, under `title`."""
        return tuple(
            self._panel(row, images.error_map(arrays, self.scale), "error", title, True) for row, arrays in line
        )

    def _panel(self, row: Any, painted: NDArray[np.float64], what: str, title: str, noted: bool) -> Panel:
        """Make a panel of one picture."""
        told = f"{self.titles[row.key]}: {'errors' if what == 'error' else 'as drawn'}"
        return Panel(
            title, (Picture(f"{self.place}{row.key}-{what}", images.png(painted), told),), _note(row) if noted else ""
        )

    def pairs(self, drawn: Iterable[Drawn]) -> tuple[Panel, ...]:
        """Show what each row drew and its errors beside each other, with its title and its note."""
        shown = zip(self.shades(drawn), self.errors(drawn), strict=True)
        return tuple(
            replace(errors, title=shade.title, pictures=shade.pictures + errors.pictures) for shade, errors in shown
        )

    def view_by_view(self, drawn: list[Drawn]) -> list[tuple[Panel, ...]]:
        """Return a line of what the first setting drew from each view, and one of errors for each setting."""
        settings = {row.setting: [one for one in drawn if one[0].setting == row.setting] for row, _ in drawn}
        first = next(iter(settings.values()))
        shown = tuple(
            replace(panel, title=_angle(row.view)) for panel, (row, _) in zip(self.shades(first), first, strict=True)
        )
        return [shown, *(self.errors(line, _short(setting)) for setting, line in settings.items())]


def _batched(drawn: list[Drawn]) -> list[list[Drawn]]:
    """Return the rows in lines of ACROSS."""
    return [drawn[start : start + ACROSS] for start in range(0, len(drawn), ACROSS)]


def _titles(drawn: list[Drawn]) -> dict[str, str]:
    """Write a title for each row, by its key: its surface, view and setting as far as the rows differ in them."""
    rows = [row for row, _ in drawn]
    several = {name: len({getattr(row, name) for row in rows}) > 1 for name in ("surface", "view", "setting")}
    made = {}
    for row in rows:
        name = picks.BEAM_SURFACES.get(row.surface, row.surface_title)
        told = {"surface": name, "view": _angle(row.view), "setting": _short(row.setting)}
        made[row.key] = ", ".join(text for which, text in told.items() if several[which]) or name
    return made


def _angle(view: str) -> str:
    """Write a view as a title does: 18° of "angle 18"."""
    return f"{view.removeprefix('angle ')}°" if view.startswith("angle ") else view


def _short(setting: str) -> str:
    """Shorten a setting's name, so that it fits above a small picture."""
    for long, short in ((" without EVAL", " alone"), (" without EFT", " alone"), (" 0.001", ""), (" per pixel", "")):
        setting = setting.replace(long, short)
    return setting.removeprefix("adaptive, ")


def _note(row: Any) -> str:
    """Write a row's largest error, and how many of its rays away from silhouettes are wrong."""
    return f"max {wording.error(row.error_max)}\n{wording.count(row.wrong_rays)} wrong"


def _counts(rows: pd.DataFrame, title: str) -> Table:
    """Make a line for each picture: how many of its rays are wrong."""
    kinds = derive.kinds(rows)
    views = rows["view"].nunique() > 1
    body = []
    for row in tuples(rows):
        counts = tuple(getattr(row, kind) for kind in kinds)
        place = (row.surface_title, row.view) if views else (row.surface_title,)
        apart = (row.grazing_wrong_rays, row.drowned_wrong_rays)
        told = (row.setting, *counts, row.wrong_rays, *apart, row.error_max, row.error_p99)
        body.append((*place, *told))
    return Table(
        (
            Column("surface"),
            *([Column("view")] if views else []),
            Column("setting", stretch=1),
            *(Column(kind.replace("_", "\n"), wording.count, numeric=True) for kind in kinds),
            Column("wrong\nrays", wording.count, numeric=True),
            Column("at sil-\nhouettes", wording.count, numeric=True),
            Column("drowned", wording.count, numeric=True),
            Column("max\nerror", wording.error, numeric=True),
            Column("99 %\nerror", wording.error, numeric=True),
        ),
        body,
        f"{title}: rays answered wrongly, of {wording.count(rows['accuracy_rays'].iloc[0])} each.",
        f"On {rows['device'].iloc[0]}, {rows['precision'].iloc[0]}; errors in scene units. The paper prints no counts.",
        group=1,
    )
