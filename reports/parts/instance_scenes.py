"""Scenes of many instances: ray casting against tessellation, and what tolerances in pixels save."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, rounds
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import shades
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 29
ERRORS = (1.0, 0.1, 0.01, 0.001)  # the image errors compared at, in pixel footprints
MESHES = "mesh"
LEAD = (
    "Instances of surfaces, each with a transform, in one depth buffer: ray cast, or as meshes. The image error is "
    "|t − t*| against the oracle's certified first hit over all instances, in pixel footprints."
)
SAVED = (
    "What a tolerance as large as a pixel shows saves of each method's own time. Dark squares save most; a square also "
    "says how many more rays are wrong for it."
)
PLACE = ["surface", "surface_title", "view", "size", "samples_per_pixel", "precision", "device"]


def sections(material: Material) -> list[Section]:
    """Make one section where scenes were drawn, and one where tolerances in pixels were compared."""
    frame = material.listed
    timed = (frame["status"] == CellStatus.OK) & frame["answers"] & frame["median_ms"].notna()
    drawn = frame[timed & frame["scene"].notna() & ~(frame["pixel_tolerance"] > 0.0)]
    full = _equal_error(drawn)
    made = []
    if tabled := [table for table in (full, _each(drawn)) if table]:
        shown: tuple[Block, ...] = (Text(f"{LEAD} {_said(full)}"), _short(full)) if full else ()
        made.append(Section("Scenes", shown, tuple(tabled)))
    loose = frame[timed & frame["pixel_tolerance"].notna()]
    if loosened := _detail(loose):
        saved = _saved(loose)
        made.append(Section("Detail where the scene needs it", (Text(SAVED), saved), (loosened,), name="Tolerances"))
    return made


def _kept_by_both(full: Table) -> dict[str, tuple[Any, ...]]:
    """Return for each scene the line of the smallest error that both kinds keep, else its first line."""
    kept: dict[str, tuple[Any, ...]] = {}
    for row in full.rows:
        if str(row[0]) not in kept or not wording.absent(row[-1]):
            kept[str(row[0])] = row
    return kept


def _said(full: Table) -> str:
    """Say how ray casting and tessellation compare in the first and the last scene in which both keep an error."""
    both = [row for row in _kept_by_both(full).values() if not wording.absent(row[-1])]
    if not both:
        return "Nowhere do both keep one of these errors in the same rounds."
    each = [
        f"on {row[0]}, under {wording.number(row[1])} pixels, {row[2]} takes {wording.number(row[4])} ms, and {row[6]} "
        f"takes {wording.factor(row[-1])} that"
        for row in dict.fromkeys((both[0], both[-1]))
    ]
    return f"At the smallest error that both keep, {'; '.join(each)}."


def _short(full: Table) -> Table:
    """Return the table of equal errors with a line for each scene, and without what only some look up."""
    kept = (0, 1, 2, 4, 6, 8, 10)
    columns = tuple(full.columns[i] for i in kept)
    rows = [tuple(row[i] for i in kept) for row in _kept_by_both(full).values()]
    caption = (
        "The fastest of either kind that keeps 99 % of the errors under the smallest bound that both keep; – where no "
        "setting of this run does."
    )
    return Table(columns, rows, "Time at equal image error.", caption, full.group)


def _equal_error(rows: pd.DataFrame) -> Table | None:
    """Make a line for each scene and each of ERRORS: the fastest ray caster and the fastest mesh that keep the error.

    None where there is no such line.
    """
    body: list[tuple[Any, ...]] = []
    for _, own in rows.groupby(PLACE, sort=False):
        usable = own[derive.nearly_all_right(own)]
        meshes, casters = usable[usable["casts"] == MESHES], usable[usable["casts"] != MESHES]
        if not (own["casts"] == MESHES).any() or casters.empty:
            continue
        first = own.iloc[0]
        for level in ERRORS:
            cast, mesh = (_fastest(of[of["pixel_error_p99"] <= level]) for of in (casters, meshes))
            if cast is None:
                continue
            told = [first["surface_title"], level]
            for one in (cast, mesh):
                told += (
                    [None] * 4
                    if one is None
                    else [one["label"], one["pixel_error_p99"], one["median_ms"], one["bytes"]]
                )
            body.append((*told, None if mesh is None else rounds.times_over(mesh, cast)))
    if not body:
        return None
    columns = [Column("scene", stretch=1), Column("99 % of\nerrors under,\npixels", wording.number, numeric=True)]
    for over in ("ray cast", "tessellated"):
        columns += [
            Column("the fastest", over=over),
            Column("99 %,\npixels", wording.short, numeric=True, over=over),
            Column("ms", wording.number, numeric=True, over=over),
            Column("bytes", wording.count, numeric=True, over=over),
        ]
    return Table(
        (*columns, Column("tessellated\nover ray cast", wording.factor, numeric=True)),
        body,
        "Time and memory at equal image error.",
        "The fastest of either kind that keeps the error, with at most 1 in 1,000 rays wrong away from silhouettes; "
        "none where no setting of this run does. Bytes are those of instances, triangles and vertices on the device. "
        "Tessellated over ray cast is the time's median ratio in the rounds that timed both."
        + wording.zeros([row[i] for row in body for i in (3, 7)]),
        group=1,
    )


def _fastest(rows: pd.DataFrame) -> pd.Series | None:
    """Return the row with the smallest median time; None where there is no row."""
    return None if rows.empty else rows.loc[rows["median_ms"].idxmin()]


def _each(rows: pd.DataFrame) -> Table | None:
    """Make a line for each row; None where there is no row."""
    if rows.empty:
        return None
    body = [
        (
            r.surface_title,
            r.label,
            r.instances,
            r.median_ms,
            r.bytes,
            r.fragments,
            None if r.casts == MESHES else r.fragments_discarded / max(1, r.fragments),
            r.pixels_drawn,
            r.pixel_error_p50,
            r.pixel_error_p99,
            r.wrong_rays,
            r.other_instance,
        )
        for r in tuples(rows)
    ]
    return Table(
        (
            Column("scene", stretch=1),
            Column("variant"),
            Column("instances", wording.count, numeric=True),
            Column("ms", wording.number, numeric=True),
            Column("bytes", wording.count, numeric=True),
            Column("fragments", wording.count, numeric=True),
            Column("discarded", wording.share, numeric=True),
            Column("pixels\ndrawn", wording.count, numeric=True),
            Column("50 %", wording.short, numeric=True, over="error, pixels"),
            Column("99 %", wording.short, numeric=True, over="error, pixels"),
            Column("wrong\nrays", wording.count, numeric=True),
            Column("of them, another\ninstance", wording.count, numeric=True),
        ),
        body,
        "Every scene by every variant.",
        "Fragments are those of all proxies or triangles, hidden ones too; discarded, as a share of them, are a "
        "proxy's without a hit. Counts of wrong rays are of the rays that fragments cast for the check."
        + wording.zeros(rows["pixel_error_p50"], rows["pixel_error_p99"]),
        group=1,
    )


def _detail(rows: pd.DataFrame) -> Table | None:
    """Make a line for each row with a tolerance in pixels, beside the same without it; None without such pairs."""
    body = list(_savings(rows))
    if not body:
        return None
    return Table(
        (
            Column("scene", stretch=1),
            Column("variant"),
            Column("its own", wording.number, numeric=True, over="evaluations per pixel"),
            Column("tolerant", wording.number, numeric=True, over="evaluations per pixel"),
            Column("saved", wording.whole_percentage, numeric=True, over="evaluations per pixel"),
            Column("its own", wording.number, numeric=True, over="ms"),
            Column("tolerant", wording.number, numeric=True, over="ms"),
            Column("saved", wording.whole_percentage, numeric=True, over="ms"),
            Column("50 %", wording.short, numeric=True, over="error, pixels"),
            Column("99 %", wording.short, numeric=True, over="error, pixels"),
            Column("its own", wording.count, numeric=True, over="wrong rays"),
            Column("tolerant", wording.count, numeric=True, over="wrong rays"),
        ),
        body,
        "Tolerances as large as pixels show, against the methods' own.",
        "Saved is a share of what the method takes with its own tolerance, of times in the rounds that timed both; "
        "below 0 more is taken. The tolerance may grow to so many footprints of a pixel at the instance's distance. "
        "Evaluations are those of all fragments of a pixel. A march that ends at a distance from the surface ends "
        "beside silhouettes too: these hits are the wrong rays that a larger tolerance adds."
        + wording.zeros([row[i] for row in body for i in (8, 9)]),
        group=1,
    )


def _saved(rows: pd.DataFrame) -> Matrix:
    """Make a line for each scene and variant and a column for each tolerance: the share of the time that it saves."""
    pairs = list(_paired(rows))
    tolerances = sorted({row.pixel_tolerance for row, _ in pairs})
    several = [name for name in PLACE[2:] if len({getattr(row, name) for row, _ in pairs}) > 1]
    lines: dict[str, dict[float, Square]] = {}
    for row, base in pairs:
        saved = 1.0 - rounds.times_over(row, base)
        more = int(row.wrong_rays) - int(base["wrong_rays"])
        told = wording.whole_percentage(saved) + (f", {wording.minus(f'{more:+,}')} wrong" if more else "")
        note = f"{row.label}: {wording.number(row.median_ms)} ms, {wording.number(base['median_ms'])} ms without"
        square = Square(told, shades.shade(1.0 - max(0.0, saved) if saved == saved else 1.0), note)
        place = ", ".join([row.surface_title, *(str(getattr(row, name)) for name in several)])
        lines.setdefault(f"{place}: {base['label']}", {})[row.pixel_tolerance] = square
    missing = shades.silent(wording.NONE, "not timed")
    body = [(line, tuple(own.get(of, missing) for of in tolerances)) for line, own in lines.items()]
    return Matrix(
        tuple(f"{tolerance:g} pixels" for tolerance in tolerances),
        body,
        "Time saved by a tolerance, by its size in footprints of a pixel at the instance's distance.",
        "Below 0 more time is taken. A march that ends at a distance from the surface ends beside silhouettes too: "
        "these hits are the wrong rays that a larger tolerance adds.",
        "scene and method",
        shades.key({0.0: "all of the time saved", 0.5: "half of it", 1.0: "none"}),
    )


def _paired(rows: pd.DataFrame) -> Iterator[tuple[Any, pd.Series]]:
    """Yield each row with a tolerance in pixels, and the same without it."""
    for row in tuples(rows[rows["pixel_tolerance"] > 0.0]):
        own = rows[
            (rows["comparison"] == row.comparison)
            & (rows["device"] == row.device)
            & (rows["method"] == row.method)
            & (rows["parameters"] == row.parameters)
            & (rows["precision"] == row.precision)
            & (rows["proxy"] == row.proxy)
            & (rows["normal"].fillna("") == ("" if wording.absent(row.normal) else row.normal))
            & (rows["origin"].fillna("") == ("" if wording.absent(row.origin) else row.origin))
            & (rows["pixel_tolerance"] == 0.0)
        ]
        if not own.empty:
            yield row, own.iloc[0]


def _savings(rows: pd.DataFrame) -> Iterator[tuple[Any, ...]]:
    """Yield the lines of the table that `_detail` makes."""
    for row, base in _paired(rows):
        yield (
            row.surface_title,
            row.label,
            base["evaluations_mean"],
            row.evaluations_mean,
            1.0 - row.evaluations_mean / base["evaluations_mean"],
            base["median_ms"],
            row.median_ms,
            1.0 - rounds.times_over(row, base),
            row.pixel_error_p50,
            row.pixel_error_p99,
            base["wrong_rays"],
            row.wrong_rays,
        )
