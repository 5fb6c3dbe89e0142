"""Make two pages for each surface: what it is, who breaks where, and speed against error.

A run with more than shown.SPREADS surfaces has an atlas in their place, several surfaces a page. Every figure of every
row is in the details.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import choices, rounds, shown, tradeoffs
from reports.analysis.choices import ERRORS, Choice
from reports.analysis.scene_names import scene_names
from reports.content import Block, Figure, Gallery, Section, Text
from reports.drawing import cards, error_maps, fronts, surface_tables, tables
from reports.material import Material
from reports.reading.arrays import Arrays
from reports.reading.taking import taken

ORDER = 20
FRONTS = 16  # plots of further scenes and devices, in the details of all surfaces that have pages
MOST_PRINTED = 20_000  # rows of all tables of every figure together, about: a page of more is slow to open
CARDS = 48  # a run with more surfaces has a picture with a name and a time for each, in place of a card


_CHOSEN_BY = list(
    dict.fromkeys(
        [
            *(*tables.CHOSEN_BY, "label", "method_label", "surface", "comparison", "origin", "median_ms"),
            *("size", "samples_per_pixel"),
        ]
    )
)  # columns that `_printed` reads


class _Surfaces:
    """Hold the rows of each surface, in the plan's order; they are taken when they are asked for."""

    def __init__(self, frame: pd.DataFrame) -> None:
        self._frame, self._places = frame, frame.groupby("surface", sort=False).indices

    def __len__(self) -> int:
        return len(self._places)

    def of(self, surface: str) -> pd.DataFrame:
        """Return the rows of a surface, of which there may be none."""
        return taken(self._frame, self._places.get(surface, np.empty(0, np.intp)))

    def __iter__(self) -> Iterator[tuple[str, pd.DataFrame]]:
        return ((str(name), taken(self._frame, places)) for name, places in self._places.items())


def sections(material: Material) -> list[Section]:
    """Make a section for each surface, or the atlas; [] where the run has no view."""
    frame = material.listed
    if frame.empty:
        return []
    finished = frame.loc[frame["status"] == CellStatus.OK, _CHOSEN_BY]  # of very many rows a copy of all takes 1 GB
    if finished.empty:
        return [Section("Surfaces", (Text("No cell gave a result; the reasons are listed below."),))]
    chosen, told = _printed(finished)
    printed = _Surfaces(frame.loc[chosen.index])
    guide = Section(
        "How to read the surfaces' pages", (), (*map(Text, (surface_tables.LEGEND, surface_tables.UNITS)), *told)
    )
    surfaces = _Surfaces(frame)
    paged = shown.with_pages(frame)
    spread = len(surfaces) <= shown.SPREADS
    named = scene_names(frame)
    made = [] if spread else [_atlas(material, surfaces)]
    room = FRONTS if spread else 0
    for i, (surface, rows) in enumerate(surfaces):
        first, second = _pages(material, rows, f"front-{i}") if surface in paged else ([], [])
        further, room = _further(material, rows, named, f"front-{i}", room)
        figures = [*further, *_tables(printed.of(surface))]
        title = str(rows["surface_title"].iloc[0])
        if not spread:
            made.append(Section(title, (), (*first, *second, *figures)))
            continue
        if not any(isinstance(block, Figure) for block in second):  # nothing was timed, or there is nothing to compare
            made.append(Section(title, (*first, *second), tuple(figures), own_page=True))
            continue
        made.append(Section(title, tuple(first), own_page=True))
        made.append(Section(f"{title}: speed against error", tuple(second), tuple(figures), True, f"{title}, speed"))
    return [*made, guide]


def _printed(finished: pd.DataFrame) -> tuple[pd.DataFrame, list[Block]]:
    """Return the rows that tables of every figure show, and a text that says which if they are not all.

    `finished` has the columns _CHOSEN_BY, as what is returned has.
    """
    printed = tables.worth_printing(finished)
    if len(printed) == len(finished):
        return printed, []
    of_all = f"{len(printed):,} of {wording.plural(len(finished), 'row')}"
    kept = f"{of_all}: those on a front, {tables.baseline(finished)} and the floor"
    if len(printed) > tables.ROW_LIMIT:
        kept_scenes = {shown.fullest(own) for _, own in printed.groupby("surface", sort=False)}
        printed = printed[printed["comparison"].isin(kept_scenes)]
        kept += f", and of these {len(printed):,}, of each surface's scene with most methods"
    if len(printed) > MOST_PRINTED:
        each = max(1, MOST_PRINTED // printed["comparison"].nunique())
        best = printed.sort_values(["front", "median_ms"], ascending=[False, True], kind="stable")
        printed = best.groupby("comparison", sort=False).head(each).sort_index()
        kept += f"; of these the first {each} of each scene, those on the front and then the fastest"
    return printed, [Text(f"Printed are {kept}. results.csv has all.")]


def _pages(material: Material, rows: pd.DataFrame, name: str) -> tuple[list[Block], list[Block]]:
    """Make what the two pages of one surface show; `name` begins the name of its plot."""
    own = shown.on_pages(rows)
    if own.empty:
        return [Text("No cell of this surface gave a result.")], []
    cells = material.shelf.together(shown.in_strip(rows))
    plots = fronts.speed_against_error(own, material.method_marks, name, _title(own), material.focus)
    table = surface_tables.compact_table(own)
    choice = material.choice_of(own)
    first, second = ("", "") if choice is None else (_fastest(choice, own), _risks(choice))
    return (
        [*([Text(first)] if first else []), *_pictures(material, own, choice, rows, cells)],
        [*([Text(second)] if second else []), *plots, *([table] if table else [])],
    )


def _pictures(
    material: Material,
    own: pd.DataFrame,
    choice: Choice | None,
    rows: pd.DataFrame,
    cells: list[tuple[Any, Arrays]],
) -> list[Block]:
    """Make the hero and the strip of error maps; what the surface is, in words, where no picture is stored."""
    if not cells:
        return [Text(cards.what(rows, cards.WHOLE))]
    return [error_maps.strip(cards.long_card(own, choice, material.shelf, rows), cells, material.error_scale)]


def _title(rows: pd.DataFrame) -> str:
    """Write which scene the rows are of."""
    first = rows.iloc[0]
    return f"{first['surface_title']}, view {first['view']}"


def _fastest(choice: Choice, rows: pd.DataFrame) -> str:
    """Say who is fastest within each of ERRORS; `rows` are those of the scene and device."""
    loose, tight = choice.within[0], choice.within[-1]
    first, second = (wording.level(error) for error in ERRORS)
    exact = (
        f"; the most exact is {choice.nearest.label} ({_figures(choice.nearest)})" if choice.nearest is not None else ""
    )
    if loose is None:
        return f"No method that answers every ray rightly is within {first} of the scene's radius{exact}."
    won = _won(choice, rows)
    if tight is None:
        exact = "" if choice.nearest.Index == loose.Index else exact
        return f"Within {first} of the scene's radius, {won}. None is within {second}{exact}."
    if tight.Index == loose.Index:
        return f"Within {first} and within {second} of the scene's radius, {won}."
    slower = rounds.times_over(tight, loose)
    more = "" if wording.absent(slower) else f", {wording.factor(slower)} the time"
    tighter = choices.written(tight, choice.rows)
    return f"Within {first} of the scene's radius, {won}. Within {second} it is {tighter} ({_figures(tight)}{more})."


def _figures(row: Any) -> str:
    """Write a row's time and its largest error over the scene's radius."""
    return f"{wording.number(row.median_ms)} ms, error {wording.error(row.relative_error_max)}"


def _won(choice: Choice, rows: pd.DataFrame) -> str:
    """Say that the row within the looser error is the fastest, over which baseline, and what ties with it."""
    row, gain = choice.within[0], ""
    times = rows.at[row.Index, "speedup"]
    if not wording.absent(times) and row.baseline not in (row.variant, row.method):
        gain = f", {wording.factor(times)} as fast as {tables.baseline(rows)}"
    tied = f", not told apart from {wording.listed(choice.tied[0])}" if choice.tied[0] else ""
    name = choices.written(row, choice.rows)
    return f"{name} is the fastest right method ({wording.number(row.median_ms)} ms{gain}){tied}"


def _risks(choice: Choice) -> str:
    """Say what is faster than the row to take, and how wrong it is."""
    if choice.best is None:
        return "Every method answers some rays wrongly."
    best = choices.written(choice.best, choice.rows)
    told = [f"{choices.written(trade.row, choice.rows)} ({trade.told})" for trade in tradeoffs.faster(choice)]
    if told:
        return f"Faster than {best}, but wrong: {wording.listed(told)}."
    return f"Nothing that answers rays wrongly is proved faster here than {best}."


def _further(
    material: Material, rows: pd.DataFrame, named: dict[str, str], name: str, room: int
) -> tuple[list[Block], int]:
    """Draw at most `room` of the further scenes and devices of a surface; return the plots and what room is left."""
    made: list[Block] = []
    if not room:
        return made, room
    own = shown.on_pages(rows)
    marks = material.method_marks
    for j, (scene, of) in enumerate(rows.groupby("comparison", sort=False)):
        for k, (device, on) in enumerate(of.groupby("device", sort=False)):
            if len(made) >= room:
                break
            if not len(own) or (scene, device) != (own["comparison"].iloc[0], own["device"].iloc[0]):
                made += fronts.speed_against_error(on, marks, f"{name}-{j}-{k}", named[str(scene)], material.focus)
    return made, max(0, room - len(made))


def _tables(printed: pd.DataFrame) -> list[Block]:
    """Make the tables of every figure of the rows of one surface, scene by scene."""
    made: list[Block] = []
    for _, scene in printed.groupby("comparison", sort=False):
        errors = surface_tables.units_table(scene)
        made += [surface_tables.results_table(scene), *([errors] if errors else [])]
    return made


def _atlas(material: Material, surfaces: _Surfaces) -> Section:
    """Make the atlas: a card for each surface, or of more than CARDS surfaces a picture with the winner's name."""
    short = len(surfaces) > CARDS
    panels, without = [], []
    for name, rows in surfaces:
        own = shown.on_pages(rows)
        made = None
        if len(own):
            card = cards.thumbnail if short else cards.short_card
            made = card(own, material.choice_of(own), material.shelf)
        if made is None:
            without.append(str(rows["surface_title"].iloc[0]) or name)
        else:
            panels.append(made)
    shows = ", with its name and its time" if short else ", who that is at two errors, and who is wrong"
    scale = "" if short else " Errors are over the scene's radius."
    told = (
        f"Each surface as the fastest method without a wrong ray draws it{shows}. Of each the scene with most methods, "
        f"on the device with most results.{scale} Wrong rays are those away from silhouettes. Plots, error maps and "
        "tables are in report.html."
    )
    blocks: list[Block] = [Text(told)]
    blocks += [Gallery(tuple(panels), "", across=6 if short else 2)] if panels else []
    blocks += [Text(f"Without a picture: {wording.listed(without)}.")] if without else []
    return Section("Atlas of the surfaces", tuple(blocks), own_page=True, name="atlas")
