"""Beams: how their hits compare with rays, at which level a quadtree eliminates boxes, and what the prepass saves."""

from __future__ import annotations

import math

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, rounds, surface_names
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Gallery, Section, Table, Text
from reports.drawing import levels
from reports.material import Material
from reports.reading.arrays import Shelf

ORDER = 28
MOST_PANELS = 12
MEANING = (
    "A beam's hit says that f's interval extension cannot keep the surface out of a piece of the pixel's whole beam. "
    "It is held against a ray in that beam. Beam only: the beam hits where the ray passes the surface by, no further "
    "off than the beam's farthest edge; these are neither right nor wrong. Hits further off are false hits or wrong "
    "roots, the price of overestimating boxes. Misses would refute the method. Evaluations are of the interval "
    "extension, large beams shared among their pixels."
)


def sections(material: Material) -> list[Section]:
    """Make up to two sections: of methods that cast beams, and of the prepass; [] where the run has neither."""
    frame = surface_names.printed_alone(material.frame)
    return [*_casters(material.shelf, frame), *_prepass(frame)]


def _casters(shelf: Shelf, frame: pd.DataFrame) -> list[Section]:
    """Make one section where any finished row casts beams."""
    rows = frame[(frame["status"] == CellStatus.OK) & frame["casts"].isin(["beams", "quadtree"])]
    if rows.empty:
        return []
    blocks: list[Block] = [Text(MEANING), _table(rows)]
    if gallery := _gallery(shelf, rows[rows["casts"] == "quadtree"]):
        blocks.append(gallery)
    return [Section("Beams", tuple(blocks))]


def _table(rows: pd.DataFrame) -> Table:
    """Make a line for each row: how many of its hits are also hits of rays, and how many are not."""
    named = scene_names(rows)
    bad = "invalid" in derive.kinds(rows)
    body = []
    for row in rows.itertuples():
        missed = row.misses + row.grazing_misses
        missed += 0 if wording.absent(row.drowned_misses) else row.drowned_misses
        counts = (missed, row.beam_only, row.false_hits, row.wrong_root)
        counts += (row.invalid,) if bad else ()
        told = (row.device, row.precision, row.variant, *counts, row.pixel_error_p50, row.evaluations_mean)
        body.append((named[str(row.comparison)], *told))
    titles = ("misses", "beam\nonly", "false\nhits", "wrong\nroot", *(["in-\nvalid"] if bad else []))
    counted = [Column(title, wording.count, numeric=True) for title in titles]
    return Table(
        (
            Column("surface", stretch=1),
            Column("device"),
            Column("precision"),
            Column("variant", stretch=1),
            *counted,
            Column("median error,\npixels", wording.short, numeric=True),
            Column("evals per pixel\nof the picture", wording.number, numeric=True),
        ),
        body,
        "Beams held against rays.",
        "Counts are of the rays of each picture's check; misses include silhouettes. Look for surfaces whose false "
        "hits outnumber the hits that only a beam can see: there the interval extension overestimates most."
        + wording.zeros(rows["pixel_error_p50"]),
        group=3,
    )


def _gallery(shelf: Shelf, rows: pd.DataFrame) -> Gallery | None:
    """Show the levels of the largest picture of every surface; None where no row stores levels."""
    largest = rows.sort_values(["size", "samples_per_pixel"], ascending=False, kind="stable")
    kept = rows.loc[sorted(largest.drop_duplicates("surface").index)].head(MOST_PANELS)
    panels = []
    for row in kept.itertuples():
        arrays = shelf.get(row)
        if arrays is not None and arrays.level is not None and arrays.status is not None:
            panels.append(levels.panel(row, arrays))
    return Gallery(tuple(panels), levels.EXPLANATION) if panels else None


def _prepass(frame: pd.DataFrame) -> list[Section]:
    """Make one section where a variant was timed with and without the prepass in one comparison."""
    rows = derive.contenders(frame)
    rows = rows.assign(right=derive.all_right(rows))
    plain, behind = rows[rows["prepass"] != "beams"], rows[rows["prepass"] == "beams"]
    keys = [*derive.GROUP, "method", "parameters", "origin"]
    both = plain.merge(behind, on=keys, suffixes=("", "_behind"))
    if both.empty:
        return []
    slower = [math.nan if one is None else one.median for one in rounds.ratios(both, "_behind")]
    both = both.assign(faster=[1.0 / ratio for ratio in slower])
    named = scene_names(both)
    body = [
        (
            named[str(row.comparison)],
            row.device,
            row.precision,
            row.variant,
            row.median_ms,
            row.median_ms_behind,
            row.faster if row.right and row.right_behind else None,
            row.evaluations_mean,
            row.evaluations_mean_behind,
            row.prepass_evaluations_mean_behind,
            row.wrong_rays,
            row.wrong_rays_behind,
        )
        for row in both.itertuples()
    ]
    columns = (
        Column("surface", stretch=1),
        Column("device"),
        Column("precision"),
        Column("variant", stretch=1),
        Column("plain", wording.number, numeric=True, over="ms"),
        Column("+beams", wording.number, numeric=True, over="ms"),
        Column("faster", wording.factor, numeric=True, over="ms"),
        Column("plain", wording.number, numeric=True, over="evals per ray cast"),
        Column("+beams", wording.number, numeric=True, over="evals per ray cast"),
        Column("of tiles", wording.number, numeric=True, over="evals per ray cast"),
        Column("plain", wording.count, numeric=True, over="wrong rays"),
        Column("+beams", wording.count, numeric=True, over="wrong rays"),
    )
    caption = (
        "Each method alone and behind beams over tiles of pixels, which leave to a ray the depths where the surface "
        "may lie. Evaluations are per ray cast, those that pass the domain by included. Faster is the plain time over "
        "that with beams, in the rounds that timed both, where neither has a wrong ray; above 1× the prepass pays; it "
        "cannot where a method is hardly slower than it."
    )
    return [Section("Where the prepass pays", (Table(columns, body, "The prepass.", caption, group=3),))]
