"""List every cell that has no result, and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis.scene_names import scene_names
from reports.content import Column, Section, Table, Text
from reports.drawing import tables
from reports.material import Material
from reports.reading.run import Facts, Unreadable

ORDER = 90
REASON_LIMIT = 500  # characters of a reason; a compiler's full log is in the cell's file


def sections(material: Material) -> list[Section]:
    """Make the section, which every report has."""
    run = material.run
    ended = _troubles(material.frame, run.families, run.plan.facts)
    files = _unreadable([*run.unreadable, *material.shelf.damaged.values()])
    blocks = tuple(filter(None, (ended, files, _not_run(run.not_run))))
    nothing = Text("Nothing: every planned cell ran and gave a result.")
    return [Section("Skipped, failed and missing", blocks or (nothing,))]


def _troubles(frame: pd.DataFrame, families: pd.DataFrame, facts: Mapping[str, Facts]) -> Table | None:
    """Make a line for each cell that did not end as `ok`, sorted by reason; None where all did."""
    views = frame.assign(place=frame["comparison"].map(scene_names(frame)))
    hard = families.assign(place=[f"family: {facts[name].title}" for name in families["family"]])
    told = ["status", "reason", "device", "precision", "place", "variant"]
    rows = pd.concat([of[of["status"] != CellStatus.OK][told] for of in (views, hard)])
    rows = rows.sort_values(["status", "reason", "device"], kind="stable")
    if rows.empty:
        return None
    body = []
    for row in rows.head(tables.ROW_LIMIT).itertuples():
        reason = None if wording.absent(row.reason) else wording.excerpt(row.reason, REASON_LIMIT)
        body.append((row.status, reason, row.device, row.precision, row.place, row.variant))
    cut = wording.first_of(len(body), len(rows))
    return Table(
        (
            Column("status"),
            Column("reason", stretch=3),
            Column("device"),
            Column("precision"),
            Column("surface or family"),
            Column("variant", stretch=2),
        ),
        body,
        "Every cell without a result, by reason.",
        f"Skipped cells were refused before they ran; failed, timeout and crashed ones each cost only themselves.{cut}",
        group=2,
    )


def _unreadable(files: Sequence[Unreadable]) -> Table | None:
    """Make a line for each file that could not be read; None where there is none."""
    if not files:
        return None
    body = [(file.file, wording.excerpt(file.problem, REASON_LIMIT)) for file in files[: tables.ROW_LIMIT]]
    return Table(
        (Column("file"), Column("problem", stretch=1)),
        body,
        "Files that could not be read.",
        f"{wording.plural(len(files), 'file')} of this run left out; run again to have them made anew.",
    )


def _not_run(slots: Sequence[str]) -> Table | None:
    """Count the cells of each device that have not run; None where all have run.

    The last word of a slot is its device.
    """
    if not slots:
        return None
    counted = Counter(slot.rpartition(" ")[2] for slot in slots)
    return Table(
        (Column("device"), Column("cells not run yet", wording.count, numeric=True)),
        counted.most_common(),
        "Not run yet.",
        "Planned cells without a result of any kind; the command on the first page goes on where the run stopped.",
    )
