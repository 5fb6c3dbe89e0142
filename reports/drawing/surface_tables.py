"""Make the tables of one surface: the columns that matter, every figure, and the errors in every unit."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import derive
from reports.analysis.scene_names import scene_title
from reports.content import Column, Table
from reports.drawing import tables
from reports.reading.tuples import tuples

OVERHEAD_LIMIT = 0.05  # the share of the time above which an overhead is flagged
KNOWN = ("front", "floor-bound", "drifts", "noisy")  # flags of the table beside a plot; the other one has all
ORDERED = "The fastest first; ± is the 95 % interval of the median, – of too few samples. "
MOST_ROWS = 26  # of the table beside a surface's plot, so that both stand on one page
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


_FLAGGED = ["answers", "front", "floor_bound", "narrow", "warnings", "outliers", "peak_too_low", "overhead_share"]
_TIMED = ["label", "device", "precision", "median_ms", "lower_ms", "upper_ms", "mrays_per_s", "frames_per_s", "speedup"]
_JUDGED = ["error_max", "error_p99", "wrong_rays", "grazing_wrong_rays", "drowned_wrong_rays", "evaluations_mean"]
_TOLD = [*_FLAGGED, *_TIMED, *_JUDGED]  # what a table's rows are made of: a tuple of all columns takes long to make


def compact_table(rows: pd.DataFrame) -> Table | None:
    """Make a line for each variant that answers, the fastest first in each precision; None without any.

    `rows` are the finished rows of one scene and device. Of more than MOST_ROWS rows those on the front stay, and the
    fastest.
    """
    rows = rows[rows["answers"].astype(bool)]
    if rows.empty:
        return None
    every = len(rows)
    kept = rows.sort_values(["front", "median_ms"], ascending=[False, True], kind="stable").head(MOST_ROWS)
    kept = kept.sort_values(["precision", "median_ms", "error_max"], kind="stable")
    timed, several = bool(kept["median_ms"].notna().any()), kept["precision"].nunique() > 1
    speed = [
        (Column("ms", wording.number, numeric=True), "median_ms"),
        (Column("±", wording.share, numeric=True), "spread"),
        (Column("Mrays/s", wording.number, numeric=True), "mrays_per_s"),
    ]
    compared = timed and bool(kept["speedup"].notna().any())  # else the baseline is not among them
    speed += [(Column("speed-\nup", wording.factor, numeric=True), "speedup")] if compared else []
    columns = [
        *([(Column("precision"), "precision")] if several else []),
        (Column("method", stretch=3), "label"),
        *(speed if timed else []),
        (Column("max\nerror", wording.error, numeric=True), "error_max"),
        (Column("99 %\nerror", wording.error, numeric=True), "error_p99"),
        (Column("wrong\nrays", wording.count, numeric=True), "wrong_rays"),
        (Column("evaluations\nper ray", wording.number, numeric=True), "evaluations_mean"),
        (Column("what to know", stretch=3), "flags"),
    ]
    body = []
    for row in tuples(kept[_TOLD]):
        told = {
            **row._asdict(),
            "spread": spread(row),
            "flags": ", ".join(word for word in flags(row).split(", ") if word in KNOWN),
        }
        body.append(tuple(told[name] for _, name in columns))
    cut = f" {len(kept)} of {every} variants: those on the front, and the fastest." if len(kept) < every else ""
    over = (
        f" Speed-up is over {tables.baseline(kept)}, round by round; – where one of the two is wrong."
        if compared
        else ""
    )
    return Table(
        tuple(column for column, _ in columns),
        body,
        scene_title(rows),
        f"{ORDERED if timed else ''}Errors are |t − t*| in scene "
        f"units, of {wording.count(kept['accuracy_rays'].max())} rays, away from "
        f"silhouettes.{wording.zeros(kept['error_max'], kept['error_p99'])}{over}{cut} "
        "All columns, units, devices and views are in report.html, under “Every figure”.",
        group=1 if several else 0,
    )


def spread(row: Any) -> float | None:
    """Return how far the 95 % interval of the median reaches from it, at the longer side, over the median.

    None where too few samples were taken for an interval.
    """
    reach = max(row.upper_ms - row.median_ms, row.median_ms - row.lower_ms)
    return None if wording.absent(reach) or not row.median_ms else reach / row.median_ms


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
    for row in tuples(rows[[*_TOLD, *kinds, "peak_share", "compile_ms", "clock"]]):
        speed = (row.median_ms, spread(row), row.mrays_per_s, row.frames_per_s, row.speedup)
        errors = (row.error_max, row.error_p99, *(getattr(row, kind) for kind in kinds))
        told = (*errors, row.grazing_wrong_rays, row.drowned_wrong_rays, row.evaluations_mean, row.peak_share)
        body.append((row.device, row.precision, row.label, *speed, *told, row.compile_ms, row.clock, flags(row)))
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
    figures_of = [f"{unit}_{quantile}" for unit, _, _ in known for quantile in ("max", "p99")]
    for row in tuples(rows[["device", "precision", "label", *figures_of]]):
        figures = (getattr(row, name) for name in figures_of)
        body.append((row.device, row.precision, row.label, *figures))
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
    judged = rows.loc[rows["accuracy_rays"].notna(), ["accuracy_rays", "grazing", "grazing_margin", "undecided"]]
    for row in tuples(judged.head(1)):
        checked = (
            f" Errors and counts of wrong rays are of {wording.plural(row.accuracy_rays, 'ray')}, of which "
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
        "median, – of too few samples; errors are |t − t*| in scene "
        f"units.{wording.zeros(rows['error_max'], rows['error_p99'])} "
        f"{tables.speedup(rows)}{checked}",
    )
