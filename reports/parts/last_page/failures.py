"""Tell which cells have no result, and why: a line for each reason, and every cell among the details."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.content import Block, Column, Table, Text
from reports.drawing import tables
from reports.material import Material
from reports.reading.run import Unreadable
from reports.reading.tuples import tuples

REASON_LIMIT = 500  # characters of a reason; a compiler's full log is in the cell's file
SHORT_LIMIT = 180  # characters of the reason of a group of cells
GROUPS = 12  # reasons that the page has room for
FAMILY = "family: "  # begins the name of a place that is no surface
NAMED = 3  # methods or places that are named; more are counted
_QUOTED = re.compile(r"^ *\|.*\n?", re.MULTILINE)  # a line of a kernel, or a mark below it, under a compiler's message
_REFUSED = re.compile(r"the method refuses the surface [^:]+: ")
_NOTHING_FAILED = "Every planned cell ran and gave a result."


def blocks(material: Material) -> tuple[Block, ...]:
    """Say how many cells have no result, and make a line for each reason, the most frequent first."""
    run, rows = material.run, _troubles(material)
    files = [*run.unreadable, *material.shelf.damaged.values()]
    told = " ".join(filter(None, (_ended(rows), _left_out(files), _not_run(run.not_run))))
    return (Text(told or _NOTHING_FAILED), *([] if rows.empty else [_by_reason(rows)]))


def details(material: Material) -> tuple[Block, ...]:
    """List every cell without a result, and every file that could not be read."""
    rows = _troubles(material)
    files = [*material.run.unreadable, *material.shelf.damaged.values()]
    return (*([] if rows.empty else [_every(rows)]), *([_unreadable(files)] if files else []))


def _troubles(material: Material) -> pd.DataFrame:
    """Return the cells that did not end as `ok`, with their `place`: the surface, scene or family.

    Their reasons have no lines of kernels any more, which nobody can read once a reason is one paragraph.
    """
    frame, families, facts = material.frame, material.run.families, material.run.plan.facts
    views = frame.assign(place=frame["surface_title"])
    hard = families.assign(place=[f"{FAMILY}{facts[name].title}" for name in families["family"]])
    told = ["status", "reason", "device", "precision", "place", "variant", "label", "method_label"]
    rows = pd.concat([of[of["status"] != CellStatus.OK][told] for of in (views, hard)])
    return rows.assign(reason=[_QUOTED.sub("", reason) for reason in rows["reason"].fillna("").astype(str)])


def _ended(rows: pd.DataFrame) -> str:
    """Count the cells without a result by how they ended; "" where there are none."""
    if rows.empty:
        return ""
    each = [f"{count:,} {status}" for status, count in rows["status"].value_counts().items()]
    counts = f"all {rows['status'].iloc[0]}" if len(each) == 1 else wording.listed(each)
    return (
        f"{wording.plural(len(rows), 'cell')} without a result: {counts}. A skipped cell was refused before it ran; "
        "one that failed, crashed or ran out of time costs only itself."
    )


def _left_out(files: Sequence[Unreadable]) -> str:
    """Count the files that could not be read, and quote the first problem; "" where there are none."""
    if not files:
        return ""
    first = f"{files[0].file}: {wording.excerpt(files[0].problem, SHORT_LIMIT)}"
    return f"{wording.plural(len(files), 'file')} could not be read, the first {first}."


def _not_run(slots: Sequence[str]) -> str:
    """Count the cells of each device that have not run; "" where all have. The last word of a slot is its device."""
    if not slots:
        return ""
    counted = Counter(slot.rpartition(" ")[2] for slot in slots)
    each = wording.listed([f"{count:,} on {device}" for device, count in counted.most_common()])
    return f"{wording.plural(len(slots), 'planned cell')} not run yet ({each}); the command below goes on there."


def _by_reason(rows: pd.DataFrame) -> Table:
    """Make a line for each reason of each method; reasons that differ in numbers alone count as one.

    Methods that have a reason in common share its line.
    """
    rows = rows.assign(short=[_REFUSED.sub("", reason) for reason in rows["reason"]])
    rows = rows.assign(kind=[re.sub(r"\d+", "#", short) for short in rows["short"]])
    named = [(len(of), of["method_label"].iloc[0], status, of) for (status, _), of in rows.groupby(["status", "kind"])]
    groups = sorted(named, key=lambda group: (-group[0], group[1]))
    body = []
    for _, _, status, of in groups[:GROUPS]:
        noun = "place" if of["place"].str.startswith(FAMILY).any() else "surface"
        methods, places = _named(of["method_label"], "method"), _named(of["place"], noun)
        reason = wording.excerpt(of["short"].iloc[0], SHORT_LIMIT) or None
        body.append((len(of), status, reason, methods, places, _named(of["device"], "device")))
    rest = len(groups) - len(body)
    caption = f"{wording.plural(rest, 'more reason')} in {sum(count for count, *_ in groups[GROUPS:]):,} cells."
    return Table(
        (
            Column("cells", wording.count, numeric=True),
            Column("ended as"),
            Column("reason", stretch=5),
            Column("methods", stretch=3),
            Column("surfaces or families", stretch=3),
            Column("devices", stretch=2),
        ),
        body,
        "Why cells have no result.",
        caption if rest else "",
    )


def _named(values: Iterable[str], noun: str) -> str:
    """Write the different `values`, or where there are more than NAMED of them how many there are."""
    names = list(dict.fromkeys(map(str, values)))
    return ", ".join(names) if len(names) <= NAMED else wording.plural(len(names), noun)


def _every(rows: pd.DataFrame) -> Table:
    """Make a line for each cell without a result, sorted by reason."""
    rows = rows.sort_values(["status", "reason", "device"], kind="stable")
    body = [
        (row.status, wording.excerpt(row.reason, REASON_LIMIT) or None, row.device, row.precision, row.place, row.label)
        for row in tuples(rows.head(tables.ROW_LIMIT))
    ]
    return Table(
        (
            Column("ended as"),
            Column("reason", stretch=3),
            Column("device"),
            Column("precision"),
            Column("surface or family"),
            Column("method", stretch=2),
        ),
        body,
        "Every cell without a result, by reason.",
        wording.first_of(len(body), len(rows)).strip(),
        group=2,
    )


def _unreadable(files: Sequence[Unreadable]) -> Table:
    """Make a line for each file that could not be read."""
    body = [(file.file, wording.excerpt(file.problem, REASON_LIMIT)) for file in files[: tables.ROW_LIMIT]]
    return Table(
        (Column("file"), Column("problem", stretch=1)),
        body,
        "Files that could not be read.",
        f"{wording.plural(len(files), 'file')} of this run left out; run again to have them made anew.",
    )
