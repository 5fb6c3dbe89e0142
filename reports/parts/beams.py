"""Beams: how their hits compare with rays, at which level a quadtree eliminates boxes, and what the prepass saves."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, rounds, surface_names
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Gallery, Matrix, Section, Square, Table, Text
from reports.drawing import levels, shades
from reports.material import Material
from reports.reading.arrays import Shelf
from reports.reading.tuples import tuples

ORDER = 28
MOST_PANELS = 6
CAPTION = "Levels of elimination: dark early, bright late, white the surface."
TOP = 4.0  # the factor that has the darkest colour, and its inverse the brightest
MOST_SCENES = 40  # of the prepass's matrix
READ_PREPASS = (
    "Beams over tiles of pixels go before the rays and leave them the depths where the surface may lie. Above 1× that "
    "pays: the dark squares."
)
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
    """Make one section where any finished row casts beams.

    Its pictures are printed in a run about beams, where most rows that answer cast them, and else are details.
    """
    rows = frame[(frame["status"] == CellStatus.OK) & frame["casts"].isin(["beams", "quadtree"])]
    if rows.empty:
        return []
    answering = frame[(frame["status"] == CellStatus.OK) & frame["answers"].astype(bool)]
    printed = 2 * len(rows) > len(answering)
    gallery = _gallery(shelf, rows[rows["casts"] == "quadtree"])
    pictures: tuple[Block, ...] = (gallery,) if gallery else ()
    told: tuple[Block, ...] = (Text(f"{levels.EXPLANATION} {_said(rows)}"), *pictures) if pictures and printed else ()
    rest = () if told else pictures
    return [Section("Beams", told, (Text(MEANING), _table(rows), *rest))]


def _said(rows: pd.DataFrame) -> str:
    """Say on which surface a beam's hits are most often none of the surface's."""
    shares = rows["false_hits"].astype("float64") / rows["accuracy_rays"].astype("float64")
    if not (shares > 0).any():
        return "No beam of this run has a false hit."
    worst = rows.loc[shares.idxmax()]
    return (
        f"Most false hits: {wording.share(shares.max())} of the rays of {worst['surface_title']}, {worst['label']}, "
        f"{worst['precision']}."
    )


def _table(rows: pd.DataFrame) -> Table:
    """Make a line for each row: how many of its hits are also hits of rays, and how many are not."""
    named = scene_names(rows)
    bad = "invalid" in derive.kinds(rows)
    body = []
    for row in tuples(rows):
        missed = row.misses + row.grazing_misses
        missed += 0 if wording.absent(row.drowned_misses) else row.drowned_misses
        counts = (missed, row.beam_only, row.false_hits, row.wrong_root)
        counts += (row.invalid,) if bad else ()
        told = (row.device, row.precision, row.label, *counts, row.pixel_error_p50, row.evaluations_mean)
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
    for row in tuples(kept):
        arrays = shelf.get(row)
        if arrays is not None and arrays.level is not None and arrays.status is not None:
            panels.append(levels.panel(row, arrays))
    return Gallery(tuple(panels), CAPTION, across=3) if panels else None


def _prepass(frame: pd.DataFrame) -> list[Section]:
    """Make one section where a variant was timed with and without the prepass in one comparison."""
    if not (frame["prepass"] == "beams").any():  # which is looked at first: of very many rows a copy of all takes 1 GB
        return []
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
            row.label,
            row.median_ms,
            row.median_ms_behind,
            row.faster if row.right and row.right_behind else None,
            row.evaluations_mean,
            row.evaluations_mean_behind,
            row.prepass_evaluations_mean_behind,
            row.wrong_rays,
            row.wrong_rays_behind,
        )
        for row in tuples(both)
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
    table = Table(columns, body, "The prepass.", caption, group=3)
    matrix = _pays(both)
    shown: tuple[Block, ...] = () if matrix is None else (Text(READ_PREPASS), matrix)
    return [Section("Where the prepass pays", shown, (table,), name="Prepass")]


def _pays(both: pd.DataFrame) -> Matrix | None:
    """Make a line for each surface and a column for each variant: how much faster it is behind beams.

    Of the device with most rows and its first precision; None where no variant is right in both ways.
    """
    rows = derive.on_fullest_device(both)
    rows = rows[rows["precision"] == rows["precision"].iloc[0]]
    if not (rows["right"] & rows["right_behind"] & rows["faster"].notna()).any():
        return None
    named = scene_names(rows)
    labels = dict(zip(rows["variant"], rows["label"], strict=True))
    squares = {(r.comparison, r.variant): _square(r) for r in tuples(rows)}
    missing = shades.silent("", "not timed in both ways")
    body = [
        (named[str(scene)], tuple(squares.get((scene, variant), missing) for variant in labels))
        for scene in dict.fromkeys(rows["comparison"])
    ]
    place = f"{rows['precision'].iloc[0]} on {rows['device'].iloc[0]}"
    shown = body[:MOST_SCENES]
    return Matrix(
        tuple(labels.values()),
        shown,
        f"How many times as fast a method is behind beams, {place}.",
        "“Wrong”: a ray away from silhouettes is answered wrongly, with beams or without; empty: not timed in both "
        f"ways.{wording.first_of(len(shown), len(body))}",
        "scene",
        shades.key({0.0: f"{TOP:g}× as fast", 0.5: "the same", 1.0: f"{TOP:g}× as slow"}),
    )


def _square(row: Any) -> Square:
    """Return the square of a variant on a surface, with and without beams."""
    times = f"{wording.number(row.median_ms)} ms plain, {wording.number(row.median_ms_behind)} ms behind beams"
    wrong = f"{wording.count(row.wrong_rays)} and {wording.count(row.wrong_rays_behind)} wrong rays"
    note = f"{row.label}: {times}; {wrong}"
    if not (row.right and row.right_behind):
        return shades.silent("wrong", note)
    if wording.absent(row.faster):
        return shades.silent(wording.NONE, f"{note}; no round timed both")
    return Square(wording.factor(row.faster), shades.shade(0.5 - math.log(row.faster) / (2.0 * math.log(TOP))), note)
