"""A page for each surface: speed against error, pictures, and every figure of its rows."""

from __future__ import annotations

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive
from reports.content import Block, Section, Text
from reports.drawing import images, plots, style, tables
from reports.material import Material

ORDER = 20
SCENES = 40  # comparisons of a run whose fronts are all drawn; of a larger one those of each surface's fullest

LEGEND = (
    "Speed-up is over the baseline that each table names. Flags: front, no other variant with all rays right is both "
    f"faster, by the medians, and more exact; floor-bound, under {derive.FLOOR_FACTOR:g} times the null method's time, "
    "so that the harness is measured more than the method; floor, the null method itself, which finds nothing; "
    "interval wide, the budget ended before the 95 % interval of the median was within 2 % of it; drifts, the second "
    "half of the samples was slower or faster than the first; noisy, the middle half of the samples spreads over more "
    "than a tenth of the median; outliers, samples far outside the rest, which are kept; overhead, what the harness's "
    "submitting and waiting adds to the time by the device's clock, as a share of that, where it is above "
    f"{wording.share(tables.OVERHEAD_LIMIT)} and that clock is believed; the probe's peak is too low, the row computes "
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
            kept_scenes = {derive.fullest(own) for _, own in printed.groupby("surface", sort=False)}
            printed = printed[printed["comparison"].isin(kept_scenes)]
            kept += f", and of these {len(printed):,}, of each surface's scene with most methods"
        told.append(Text(f"Printed are {kept}. results.csv has all."))
    made = [Section("How to read the surfaces' pages", tuple(told))]
    marks, named = style.marks(frame["method"]), tables.places(frame)
    all_fronts = frame["comparison"].nunique() <= SCENES
    for i, (surface, rows) in enumerate(frame.groupby("surface", sort=False)):
        own = printed[printed["surface"] == surface]
        scenes = [scene for _, scene in rows.groupby("comparison", sort=False)]
        blocks: list[Block] = [Text(_facts(rows))]
        fullest = derive.fullest(rows)
        for j, scene in enumerate(s for s in scenes if all_fronts or s["comparison"].iloc[0] == fullest):
            title = named[str(scene["comparison"].iloc[0])]
            blocks += plots.speed_against_error(scene, marks, f"front-{i}-{j}", title)
        blocks += [pictures[str(surface)]] if str(surface) in pictures else []
        for _, scene in own.groupby("comparison", sort=False):
            errors = tables.units(scene)
            blocks += [tables.results(scene), *([errors] if errors else [])]
        made.append(Section(str(rows["surface_title"].iloc[0]), tuple(blocks), wide=True))
    return made


def _facts(rows: pd.DataFrame) -> str:
    """Formula and degree, as the first row tells them."""
    first = rows.iloc[0]
    degree = "not algebraic" if wording.absent(first["degree"]) else f"degree {first['degree']}"
    formula = "" if wording.absent(first["formula"]) else f": {wording.excerpt(first['formula'], 400)} = 0"
    return f"{degree[0].upper()}{degree[1:]}{formula}."
