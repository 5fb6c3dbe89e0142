"""Tiles: which stage of a frame answers how many of its pixels."""

from __future__ import annotations

import json
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Gallery, Section, Table, Text
from reports.drawing import stages
from reports.material import Material
from reports.reading.arrays import Shelf
from reports.reading.tuples import tuples

ORDER = 29
MOST_PANELS = 6
MEANING = (
    "Rays of a tile are isolated together. A tile is empty, or all of its rays have their first root in one piece of "
    "depth, where each is refined by itself (single), or it is left open. The numbers are the pixels a side of the "
    "tiles. Pixels of open tiles are cast in packets of 4 by 4, or each as a tile of its own (packets), and those that "
    "are left are cast alone (rest). "
    "The more pixels the first stages answer, the more work is shared."
)
CAPTION = "Which stage answered each pixel: dark, empty tiles; bright, packets and rays cast alone."


def sections(material: Material) -> list[Section]:
    """Make one section where any finished row casts tiles; [] where none does."""
    frame = material.frame
    rows = frame[(frame["status"] == CellStatus.OK) & (frame["casts"] == "tiles")]
    rows = rows[rows["stages"].notna()] if "stages" in rows else rows.head(0)
    if rows.empty:
        return []
    gallery = _gallery(material.shelf, rows)
    shown: tuple[Block, ...] = (gallery,) if gallery else ()
    return [Section("Tiles", (), (Text(MEANING), _table(rows), *shown))]


def shares(row: Any) -> dict[str, float]:
    """Return the share of the checked frame's pixels that each stage answered, by its name, in the stages' order."""
    told: dict[str, float] = json.loads(row.stages)
    return told


def _table(rows: pd.DataFrame) -> Table:
    """Make a line for each row with the share of each stage."""
    named, names = scene_names(rows), list(dict.fromkeys(name for row in tuples(rows) for name in shares(row)))
    body = []
    for row in tuples(rows):
        told = shares(row)
        each = (told.get(name) for name in names)
        body.append((named[str(row.comparison)], row.device, row.precision, row.label, *each, row.evaluations_mean))
    columns = (
        Column("surface", stretch=1),
        Column("device"),
        Column("precision"),
        Column("variant", stretch=1),
        *(Column(name.replace("_", "\n"), wording.share, numeric=True, over="pixels answered by") for name in names),
        Column("evals per pixel\nof the picture", wording.number, numeric=True),
    )
    caption = "Shares are of the pixels of the check's frame, whose pixels are as narrow as the timed frame's."
    return Table(columns, body, "What answers the pixels of tiles.", caption, group=3)


def _gallery(shelf: Shelf, rows: pd.DataFrame) -> Gallery | None:
    """Show the stages of the largest picture of every surface; None where no row stores them."""
    largest = rows.sort_values(["size", "samples_per_pixel"], ascending=False, kind="stable")
    kept = rows.loc[sorted(largest.drop_duplicates("surface").index)].head(MOST_PANELS)
    panels = []
    for row in tuples(kept):
        arrays = shelf.get(row)
        if arrays is not None and arrays.stage is not None:
            panels.append(stages.panel(row, arrays, list(shares(row))))
    return Gallery(tuple(panels), CAPTION, across=3) if panels else None
