"""Camera paths: how many frames a second each variant draws while the camera moves, and in its worst frame."""

from __future__ import annotations

import pandas as pd

from reports import wording
from reports.analysis import viewstats
from reports.analysis.scene_names import rays_checked
from reports.analysis.viewstats import ViewSet
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import viewplots
from reports.material import Material

ORDER = 24
PRINTED = 2  # paths that are printed; others are details
EXPLANATION = (
    "The camera moves about the surface. Each frame is drawn by itself, and takes nothing from the one before. Its "
    "time is the median of its repetitions. All frames are timed in the same rounds, so that they share the machine's "
    "drift. “Whole path” is the number of frames over the sum of their times. A path is as smooth as its worst frame."
)


def sections(material: Material) -> list[Section]:
    """Make one section with a figure and a table for each path; [] where the run has none."""
    paths = [of for of in viewstats.view_sets(material.frame) if of.kind == viewstats.PATH]
    if not paths:
        return []
    shown: list[list[Block]] = [
        [viewplots.over_frames(of, material.marks, f"path-{i}"), path_table(of)] for i, of in enumerate(paths)
    ]
    printed: list[Block] = [Text(EXPLANATION), *(block for blocks in shown[:PRINTED] for block in blocks)]
    others = tuple(block for blocks in shown[PRINTED:] for block in blocks)
    return [Section("Camera paths", tuple(printed), others, own_page=True)]


def path_table(of: ViewSet) -> Table:
    """Make a line for each variant that was timed in every frame, the one with the most frames a second first."""
    body, left_out = [], []
    for _, rows in of.variants():
        label, answers = rows["label"].iloc[0], bool(rows["answers"].iloc[0])
        if len(rows) < len(of.views):
            left_out.append(f"{label} ({len(rows)} of {len(of.views)})")
            continue
        worst = rows.loc[rows["median_ms"].idxmax()]
        median = float(rows["median_ms"].median())
        body.append(
            (
                label,
                1e3 * len(rows) / float(rows["median_ms"].sum()),
                1e3 / median,
                1e3 / float(worst["median_ms"]),
                worst["view"],
                float(worst["median_ms"]) / median,
                _whole(rows, "wrong_rays") if answers else None,
                _whole(rows, "grazing_wrong_rays") if answers else None,
                float(rows["error_max"].astype("float64").max()) if answers else None,
            )
        )
    body.sort(key=lambda row: -row[1])
    missing = f" Not timed in every frame: {wording.listed(left_out)}." if left_out else ""
    columns = (
        Column("variant", stretch=1),
        Column("whole\npath", wording.number, numeric=True, over="frames per second"),
        Column("median\nframe", wording.number, numeric=True, over="frames per second"),
        Column("worst\nframe", wording.number, numeric=True, over="frames per second"),
        Column("which", over="worst frame"),
        Column("time over\nmedian", wording.factor, numeric=True, over="worst frame"),
        Column("clear", wording.count, numeric=True, over="wrong rays"),
        Column("grazing", wording.count, numeric=True, over="wrong rays"),
        Column("largest\n|t − t*|", wording.error, numeric=True),
    )
    checked = f"Wrong rays and errors are of the {rays_checked(of.rows)} rays of each frame's check.{missing}"
    return Table(columns, body, f"A path of {len(of.views)} frames: {of.place}.", checked)


def _whole(rows: pd.DataFrame, name: str) -> int:
    return int(rows[name].fillna(0).sum())
