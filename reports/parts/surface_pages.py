"""Make a page for each surface: speed against error, pictures, and every figure of its rows."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, shown
from reports.analysis.scene_names import scene_names, scene_title
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import images, plots, style, tables
from reports.material import Material

ORDER = 20
SCENES = 40  # a run with more scenes has the fronts of each surface's fullest scene alone
OVERHEAD_LIMIT = 0.05  # the share of the time above which an overhead is flagged

LEGEND = (
    "Speed-up is over the baseline that each table names. Flags: front, no other variant with all rays right is both "
    f"faster, by the medians, and more exact; floor-bound, under {derive.FLOOR_FACTOR:g} times the null method's time, "
    "so that the harness is measured more than the method; floor, the null method itself, which finds nothing; "
    "interval wide, the budget ended before the 95 % interval of the median was within 2 % of it; drifts, the second "
    "half of the samples was slower or faster than the first; noisy, the middle half of the samples spreads over more "
    "than a tenth of the median; outliers, samples far outside the rest, which are kept; overhead, what the harness's "
    "submitting and waiting adds to the time by the device's clock, as a share of that, where it is above "
    f"{wording.share(OVERHEAD_LIMIT)} and that clock is believed; the probe's peak is too low, the row computes "
    "more than the probe found the device to be able to, so that no share is told. Evaluations are per ray cast, "
    "those that pass the domain by included. Share of peak: operations of the function that a method evaluates, times "
    "evaluations per ray cast, times rays per second, as a share of the float32 operations per second that the device "
    "was measured at (see “Devices of this run”), to one digit, since a peak is known no better: probes of one device "
    "that run minutes apart beside other programs have found peaks that differ by a factor of 2. What else a method "
    "computes, and what idle lanes of a vector do, is not counted; in float64 no peak is measured."
)
UNITS = (
    "The same errors in the units that papers use, over rays away from silhouettes that hit the right root: the "
    f"largest and the 99th percentile. {wording.ZERO} |t − t*| in scene units; over the radius of the scene; over the "
    "feature radius (a torus's minor radius r; the scene's where a surface has none of its own); in pixel footprints "
    "at the hit; in units in the last place of t. Over condition × roundoff: the error over what the problem allows, "
    "max(condition, 1) × unit roundoff × the domain's radius, which a stable method keeps small. Normal: the angle "
    "between the surface's normals at the hit and at the root. Residual: |f| at the hit over the sum of |terms of f|, "
    "the backward error. Look for rows with a small error in one unit and a large one in another."
)


def sections(material: Material) -> list[Section]:
    """Make a section that explains the pages and one for each surface; [] where the run has no view."""
    frame = material.listed
    if frame.empty:
        return []
    finished = frame[frame["status"] == CellStatus.OK]
    if finished.empty:
        return [Section("Surfaces", (Text("No cell gave a result; the reasons are listed below."),))]
    pictures = images.galleries(material.shelf, frame, material.error_scale)
    printed = tables.worth_printing(finished)
    told: list[Block] = [Text(LEGEND), Text(UNITS)]
    if len(printed) < len(finished):
        kept = f"{len(printed):,} of {len(finished):,} rows: those on a front, "
        kept += f"{derive.baseline_of(finished)} and the floor"
        if len(printed) > tables.ROW_LIMIT:
            kept_scenes = {shown.fullest(own) for _, own in printed.groupby("surface", sort=False)}
            printed = printed[printed["comparison"].isin(kept_scenes)]
            kept += f", and of these {len(printed):,}, of each surface's scene with most methods"
        told.append(Text(f"Printed are {kept}. results.csv has all."))
    made = [Section("How to read the surfaces' pages", tuple(told))]
    marks, named = style.marks(frame["method"]), scene_names(frame)
    all_fronts = frame["comparison"].nunique() <= SCENES
    for i, (surface, rows) in enumerate(frame.groupby("surface", sort=False)):
        own = printed[printed["surface"] == surface]
        scenes = [scene for _, scene in rows.groupby("comparison", sort=False)]
        blocks: list[Block] = [Text(_facts(rows))]
        fullest = shown.fullest(rows)
        for j, scene in enumerate(s for s in scenes if all_fronts or s["comparison"].iloc[0] == fullest):
            title = named[str(scene["comparison"].iloc[0])]
            blocks += plots.speed_against_error(scene, marks, f"front-{i}-{j}", title)
        blocks += [pictures[str(surface)]] if str(surface) in pictures else []
        for _, scene in own.groupby("comparison", sort=False):
            errors = units_table(scene)
            blocks += [results_table(scene), *([errors] if errors else [])]
        made.append(Section(str(rows["surface_title"].iloc[0]), tuple(blocks)))
    return made


def _facts(rows: pd.DataFrame) -> str:
    """Write degree and formula, which all rows of a surface share, and what their domains leave out of it."""
    first = rows.iloc[0]
    degree = "not algebraic" if wording.absent(first["degree"]) else f"degree {first['degree']}"
    formula = "" if wording.absent(first["formula"]) else f": {wording.excerpt(first['formula'], 400)} = 0"
    told = rows["extent"].dropna().unique() if "extent" in rows else ()
    return " ".join([f"{degree[0].upper()}{degree[1:]}{formula}.", *(f"Note: {sentence}." for sentence in told)])


def flags(row: Any) -> str:
    """List what a reader must know before trusting or quoting a row."""
    notes = []
    if not row.answers:
        notes.append("floor")
    if row.front:
        notes.append("front")
    if row.floor_bound:
        notes.append("floor-bound")
    if not (wording.absent(row.narrow) or row.narrow):
        notes.append("interval wide")
    if not wording.absent(row.warnings):
        notes += [text.partition(":")[0] for text in json.loads(row.warnings)]
    if not wording.absent(row.outliers) and row.outliers:
        notes.append(wording.plural(row.outliers, "outlier"))
    if row.peak_too_low:
        notes.append("the probe's peak is too low")
    if row.overhead_share > OVERHEAD_LIMIT:
        notes.append(f"overhead {wording.share(row.overhead_share)}")
    return ", ".join(notes)


def results_table(rows: pd.DataFrame) -> Table:
    """Make a line for each finished row of one comparison, fastest first for each device and precision.

    The column ± has the longer side of the median's interval over the median, as harness.results.timings measures it.
    """
    rows = rows.sort_values(["device", "precision", "median_ms"], kind="stable")
    kinds = derive.kinds(rows)
    body = []
    for row in rows.itertuples():
        reach = max(row.upper_ms - row.median_ms, row.median_ms - row.lower_ms)
        spread = reach / row.median_ms if row.median_ms else None
        speed = (row.median_ms, spread, row.mrays_per_s, row.frames_per_s, row.speedup)
        errors = (row.error_max, row.error_p99, *(getattr(row, kind) for kind in kinds))
        told = (*errors, row.grazing_wrong_rays, row.drowned_wrong_rays, row.evaluations_mean, row.peak_share)
        body.append((row.device, row.precision, row.variant, *speed, *told, row.compile_ms, row.clock, flags(row)))
    return Table(
        (
            Column("device"),
            Column("precision"),
            Column("variant", stretch=1),
            Column("ms", wording.number, numeric=True),
            Column("±", wording.share, numeric=True),
            Column("Mrays/s", wording.number, numeric=True),
            Column("frames/s", wording.number, numeric=True),
            Column("speed-\nup", wording.factor, numeric=True),
            Column("max\nerror", wording.error, numeric=True),
            Column("99 %\nerror", wording.error, numeric=True),
            *(Column(tables.WRONG[kind], wording.count, numeric=True) for kind in kinds),
            Column("grazing\nwrong", wording.count, numeric=True),
            Column("drowned\nwrong", wording.count, numeric=True),
            Column("evals per\nray cast", wording.number, numeric=True),
            Column("share\nof peak", wording.rough, numeric=True),
            Column("compile\nms", wording.number, numeric=True),
            Column("clock"),
            Column("flags", stretch=1),
        ),
        body,
        *_results_caption(rows),
        group=2,
    )


_UNITS: tuple[tuple[str, str, Callable[[Any], str]], ...] = (
    ("error", "scene units", wording.error),
    ("relative_error", "over scene\nradius", wording.error),
    ("feature_error", "over feature\nradius", wording.error),
    ("pixel_error", "pixels", wording.short),
    ("ulp_error", "units in last\nplace of t", wording.short),
    ("condition_ratio", "over condition\n× roundoff", wording.short),
    ("normal_error_degrees", "normal,\ndegrees", wording.short),
    ("residual", "residual", wording.error),
)


def units_table(rows: pd.DataFrame) -> Table | None:
    """Make a line for each row of one comparison that answers: its errors in every unit; None without such rows."""
    rows = rows[rows["answers"] & rows["error_max"].notna()].sort_values(["device", "precision"], kind="stable")
    if rows.empty:
        return None
    known = [(unit, title, show) for unit, title, show in _UNITS if rows[f"{unit}_max"].notna().any()]
    body = []
    for row in rows.itertuples():
        figures = (getattr(row, f"{unit}_{quantile}") for unit, _, _ in known for quantile in ("max", "p99"))
        body.append((row.device, row.precision, row.variant, *figures))
    return Table(
        (
            Column("device"),
            Column("precision"),
            Column("variant", stretch=1),
            *(
                Column(quantile, show, numeric=True, over=title)
                for _, title, show in known
                for quantile in ("max", "99 %")
            ),
        ),
        body,
        scene_title(rows),
        group=2,
    )


def _drowned(rows: pd.DataFrame) -> str:
    """Write how many rays drown in each precision."""
    most = rows[rows["drowned"].notna()].groupby("precision", sort=False)["drowned"].max()
    return ", ".join(f"{wording.count(count)} in {precision}" for precision, count in most.items()) or "not counted"


def _results_caption(rows: pd.DataFrame) -> tuple[str, str]:
    """Return the title and the caption of `results_table`."""
    checked = ""
    for row in rows[rows["accuracy_rays"].notna()].head(1).itertuples():
        checked = (
            f" Errors and counts of wrong rays are of {row.accuracy_rays:,} rays, of which "
            f"{wording.count(row.grazing)} pass another answer within {wording.error(row.grazing_margin)} of the "
            f"scene's "
            "radius: these grazing rays are counted apart. So are drowned ones, on which |f| falls under its own "
            "rounding "
            f"errors ({_drowned(rows)})."
        )
        if not wording.absent(row.undecided) and row.undecided:
            checked += f" The oracle left {wording.plural(row.undecided, 'hit')} undecided; no figure here is of them."
    return (
        scene_title(rows),
        "Fastest first for each device and precision; ± is how far the 95 % interval reaches from the median, over the "
        f"median; errors are |t − t*| in scene units.{wording.zeros(rows['error_max'], rows['error_p99'])} "
        f"{tables.speedup(rows)}{checked}",
    )
