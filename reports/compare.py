"""Make the report that compares two runs: of two commits, or on two devices.

Cells are matched by scene, variant and precision, and by device where the runs share one. Where they share none, each
run must have only one device.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from harness.contract import CellStatus, FirsthitError
from harness.results.figures import GATED
from harness.results.writing import replacing_together
from reports import wording
from reports.analysis import derive, rounds
from reports.content import Block, Code, Column, Document, Section, Table, Text
from reports.drawing import tables
from reports.place import checked, place
from reports.reading import load
from reports.reading.run import Plan, Run
from reports.reading.tuples import tuples
from reports.rendering import document, html

ERROR = GATED["error_max"]
WORST = 10  # changes that the first page lists
_PLACE = ["scene", "variant", "precision"]


def build(a: Path, b: Path, output: Path | None = None) -> Path:
    """Write what changed from run `a` to run `b` into the folder `output`, as report.pdf and report.html.

    Nothing is written into the runs; `output` is the folder `place(a, b)` where none is given. Returns the path of the
    PDF. Raises FirsthitError if either is no run folder, they have no cell in common, or `output` is a
    file, lies in a run or cannot be written to.
    """
    folder = checked(place(a, b) if output is None else output)
    with load.opened(a) as first, load.opened(b) as second:
        content = report(first, second)
    with replacing_together(folder, "the report") as made:
        document.write_pdf(content, made / "pdf", made / "report.pdf", "")
        html.write_html(content, {}, made / "report.html")
    return folder / "report.pdf"


def paired(a: Run, b: Run) -> tuple[pd.DataFrame, list[str]]:
    """Return the cells that both runs have, a row for each, and the names of the columns by which they match.

    A column of A ends in _a, one of B in _b. `ratio` is B's time over A's, NaN where they are by different clocks;
    `ratio_low` and `ratio_high` are its ends by the intervals of both medians, NaN where one has too few samples for an
    interval. `alike` tells where both were checked on the same rays, so that counts and errors can be compared. Cells
    of one name that show another surface, or from elsewhere, do not match. Raises FirsthitError if no cell matches, or
    if the runs share no device and one has several.
    """
    frames = [derive.derive(run.frame).assign(scene=_scenes(run.frame)) for run in (a, b)]
    devices = [set(frame["device"]) for frame in frames]
    by = [*_PLACE, "device"] if devices[0] & devices[1] else _PLACE
    if by == _PLACE and max(map(len, devices)) > 1:
        told = "; ".join(", ".join(sorted(names)) for names in devices)
        raise FirsthitError(
            f"the runs share no device, and one of them has several ({told}): nothing says which to match"
        )
    unique = [frame.drop_duplicates(by) for frame in frames]
    both = unique[0].merge(unique[1], on=by, suffixes=("_a", "_b"))
    if both.empty:
        raise FirsthitError(
            f"{a.folder} and {b.folder} have no cell in common: no scene, variant and precision in both"
        )
    same = [_is_same(*pair) for pair in zip(both["identity_a"], both["identity_b"], strict=True)]
    both = both[same].reset_index(drop=True)
    if both.empty:
        raise FirsthitError(
            f"the cells of one name in {a.folder} and {b.folder} show different surfaces or views: none can be compared"
        )
    one_clock = both["clock_a"] == both["clock_b"]
    proved = rounds.proved(both["samples_ms_a"]) & rounds.proved(both["samples_ms_b"]) & one_clock
    return both.assign(
        ratio=(both["median_ms_b"] / both["median_ms_a"]).where(one_clock),
        ratio_low=(both["lower_ms_b"] / both["upper_ms_a"]).where(proved),
        ratio_high=(both["upper_ms_b"] / both["lower_ms_a"]).where(proved),
        alike=_on_same_rays(both),
    ), by


def _is_same(a: Any, b: Any) -> bool:
    """Tell whether two identities are of the same surface from the same place, by what both of them say."""
    if wording.absent(a) or wording.absent(b):
        return True
    first, second = json.loads(a), json.loads(b)
    pairs = ((first.get(part) or {}, second.get(part) or {}) for part in ("surface", "view"))
    return all(_agree(*pair) for pair in pairs)


def _agree(a: Mapping[str, Any], b: Mapping[str, Any]) -> bool:
    """Tell whether two tables have the same values under the keys of both, but for names and sets of views."""
    return all(a[key] == b[key] for key in (a.keys() & b.keys()) - {"name", "set"})


def _on_same_rays(both: pd.DataFrame) -> pd.Series:
    """Tell for each pair whether both cells were checked on the same rays, in the same classes, or one was not at all.

    Returns bool with the index of `both`.
    """
    checked = both["accuracy_rays_a"].notna() & both["accuracy_rays_b"].notna()
    same = (both["accuracy_rays_a"] == both["accuracy_rays_b"]) & (both["grazing_margin_a"] == both["grazing_margin_b"])
    return ~checked | same.fillna(False).astype(bool)


def _scenes(frame: pd.DataFrame) -> pd.Series:
    """Return the rows' comparisons without the run's name, which a collection of runs puts before them.

    Returns texts with the index of `frame`.
    """
    return frame["comparison"].str.replace(r"^[^:]*: ", "", regex=True)


def report(a: Run, b: Run) -> Document:
    """Make the report on what changed from A to B. Raises FirsthitError as `paired` does."""
    both, by = paired(a, b)
    timed = both[both["ratio"].notna()]
    quicker = timed[(timed["ratio_high"] < 1.0) & timed["alike"] & ~(_error_change(timed) > 0)]
    faster = quicker[~_less_exact(quicker)]
    slower = timed[timed["ratio_low"] > 1.0]
    worse, better = both[_error_change(both) > 0], both[_error_change(both) < 0]
    verdict = (
        f"Of {wording.plural(len(both), 'cell')} in both runs, B is clearly slower in {len(slower)} and clearly faster "
        f"in {len(faster)} of {len(timed)} timed ones; it answers more rays wrongly in {len(worse)} and fewer in "
        f"{len(better)}.{_bought(len(quicker) - len(faster))}{_ended(both)}"
    )
    caution = (
        "Clearly: the 95 % intervals of both medians, of 6 samples or more, do not meet, and what is faster answers no "
        f"more rays wrongly, and its largest error is at most {ERROR.relative:.0%} larger. The two runs were not timed "
        "in turns, so that a machine that was busier during one of them changes every ratio alike; the ratio's median "
        f"over all cells is {wording.factor(timed['ratio'].median())}.{_not_compared(a, b, both, by)}"
    )
    blocks: list[Block] = [Text(verdict, strong=True), Text(caution), _runs(a.plan, b.plan)]
    order = timed.assign(size_of_change=(timed["ratio"] - 1.0).abs()).sort_values("size_of_change", ascending=False)
    shown = order[(order["ratio_low"] > 1.0) | (order["ratio_high"] < 1.0)]
    sections = [
        Section(
            "Speed", (_speed(shown.sort_values("ratio", ascending=False), by, "Cells whose times clearly differ."),)
        ),
        Section("Answers", tuple(_answers(both, by))),
        Section("In one run only", tuple(_alone(a, b, by))),
        Section("Every cell in both", (_speed(timed, by, "Times of both, in A's order."),)),
    ]
    blocks += _damaged(a, b)
    if len(shown):
        worst = shown.sort_values("size_of_change", ascending=False).head(WORST)
        blocks.append(_speed(worst, by, "The largest changes of speed."))
    blocks.append(Code(f"firsthit report {a.folder} {b.folder}"))
    title = f"{a.plan.name} against {b.plan.name}" if a.plan.name != b.plan.name else f"{a.plan.name}, twice"
    return Document(title, f"A: {a.folder} · B: {b.folder}", Section("Summary", tuple(blocks)), tuple(sections))


def _not_compared(a: Run, b: Run, both: pd.DataFrame, by: list[str]) -> str:
    """Say, with a space before it, how many cells of one name are not compared, or not by their times or answers."""
    names = [set(run.frame.assign(scene=_scenes(run.frame))[by].itertuples(index=False, name=None)) for run in (a, b)]
    others = len(names[0] & names[1]) - len(both)
    clocks = int(((both["clock_a"] != both["clock_b"]) & both["clock_a"].notna() & both["clock_b"].notna()).sum())
    rays = int((~both["alike"]).sum())
    told = [f"{wording.plural(others, 'cell')} of one name, of another surface or view"] if others else []
    told += [f"the times of {wording.plural(clocks, 'cell')}, which are by different clocks"] if clocks else []
    told += [f"the answers of {wording.plural(rays, 'cell')}, which were checked on other rays"] if rays else []
    return f" Not compared: {wording.listed(told)}." if told else ""


def _less_exact(both: pd.DataFrame) -> pd.Series:
    """Tell for each row whether B's largest error is larger than A's, by more than the gate lets it grow.

    Returns bool with the index of `both`; False where one has no error.
    """
    before, now = (both[f"error_max_{side}"].astype("float64") for side in "ab")
    return now > before + ERROR.absolute + ERROR.relative * before


def _bought(cells: int) -> str:
    """Say, with a space before it, in how many cells B is faster and less exact; "" for none."""
    return f" In {wording.plural(cells, 'other cell')} B is faster, but its largest error is larger." if cells else ""


def _ended(both: pd.DataFrame) -> str:
    """Say, with a space before it, how many cells ended well in one run and not in the other, and how; "" for none."""
    told = []
    for first, second in (("a", "b"), ("b", "a")):
        own = both[(both[f"status_{first}"] == CellStatus.OK) & (both[f"status_{second}"] != CellStatus.OK)]
        ways = [f"{count} {status}" for status, count in own[f"status_{second}"].value_counts(sort=False).items()]
        told += [f" Of those that ended well in {first.upper()}, {wording.plural(len(own), 'cell')} did not in "
                 f"{second.upper()}: {wording.listed(ways)}."] if ways else []  # fmt: skip
    return "".join(told)


def _error_change(both: pd.DataFrame) -> pd.Series:
    """Return for each row how many more rays B answers wrongly than A, as float64.

    0 where one does not tell, and where other rays were checked.
    """
    more = both["wrong_rays_b"].astype("float64") - both["wrong_rays_a"].astype("float64")
    return more.where(both["alike"]).fillna(0.0)


def _runs(a: Plan, b: Plan) -> Table:
    """Show config, date, commit and devices of both runs."""

    def told(plan: Plan) -> dict[str, Any]:
        devices = ", ".join(f"{device.get('name')} ({device.get('title')})" for device in plan.devices)
        commit = wording.listed(plan.commits) or None
        return {"config": plan.config, "created": plan.created, "commit": commit, "devices": devices or None}

    first, second = told(a), told(b)
    body = [(name, first[name], second[name]) for name in first]
    return Table((Column(""), Column("A", stretch=1), Column("B", stretch=1)), body, "The two runs.")


def _places(by: list[str]) -> list[Column]:
    """Return a column for each of the columns that match cells."""
    return [Column(name, stretch=1 if name in ("scene", "variant") else 0) for name in by]


def _speed(rows: pd.DataFrame, by: list[str], title: str) -> Table:
    """Make a line for each cell with the times of both runs."""
    body = []
    for row in tuples(rows.head(tables.ROW_LIMIT)):
        interval = f"{wording.factor(row.ratio_low)} to {wording.factor(row.ratio_high)}"
        times = (row.median_ms_a, row.median_ms_b, row.ratio, interval)
        body.append((*(getattr(row, name) for name in by), *times, row.wrong_rays_a, row.wrong_rays_b))
    return Table(
        (
            *_places(by),
            Column("A, ms", wording.number, numeric=True),
            Column("B, ms", wording.number, numeric=True),
            Column("B over A", wording.factor, numeric=True),
            Column("of the intervals' ends"),
            Column("A", wording.count, numeric=True, over="wrong rays"),
            Column("B", wording.count, numeric=True, over="wrong rays"),
        ),
        body,
        title,
        "Above 1 B is slower." if body else "None.",
    )


def _answers(both: pd.DataFrame, by: list[str]) -> list[Block]:
    """List the cells whose status, wrong rays, error or evaluations differ."""
    fields = ("wrong_rays", "grazing_wrong_rays", "drowned_wrong_rays", "error_max", "evaluations_mean")
    body = []
    for row in tuples(both):
        a, b = ([getattr(row, f"{name}_{side}") for name in fields] for side in "ab")
        status = "" if row.status_a == row.status_b else f"{row.status_a} → {row.status_b}"
        if status or (row.alike and any(not _same(x, y) for x, y in zip(a, b, strict=True))):
            pairs = [value for pair in zip(a, b, strict=True) for value in pair]
            body.append((*(getattr(row, name) for name in by), status, *pairs))
    shows = (
        ("wrong rays", wording.count),
        ("at silhouettes", wording.count),
        ("drowned", wording.count),
        ("max error", wording.error),
        ("evaluations per ray cast", wording.number),
    )
    columns = [Column(side, show, numeric=True, over=over) for over, show in shows for side in ("A", "B")]
    caption = f"{len(body)} of {wording.plural(len(both), 'cell')} answer differently in some way."
    caption += wording.zeros(both["error_max_a"], both["error_max_b"])
    table = Table(
        (*_places(by), Column("status"), *columns), body[: tables.ROW_LIMIT], "Answers that changed.", caption
    )
    return [table]


def _same(x: Any, y: Any) -> bool:
    """Tell whether two cells of a frame are equal, or both absent."""
    return bool(wording.absent(x) and wording.absent(y)) or (not wording.absent(x) and not wording.absent(y) and x == y)


def _damaged(a: Run, b: Run) -> list[Block]:
    """List the files of both runs that could not be read, so that no cell is missing unsaid."""
    body = [(side, file.file, file.problem) for side, run in (("A", a), ("B", b)) for file in run.unreadable]
    if not body:
        return []
    columns = Column("run"), Column("file"), Column("problem", stretch=1)
    caption = "Their cells are left out on all pages; run them again to have them made anew."
    return [Table(columns, body[: tables.ROW_LIMIT], "Files that could not be read.", caption)]


def _alone(a: Run, b: Run, by: list[str]) -> list[Block]:
    """List the finished cells that only one of the runs has, in that run's order."""
    keys = []
    for run in (a, b):
        frame = run.frame.assign(scene=_scenes(run.frame))
        keys.append(dict.fromkeys(frame[frame["status"] == CellStatus.OK][by].itertuples(index=False, name=None)))
    blocks: list[Block] = []
    for side, own, other in (("A", keys[0], keys[1]), ("B", keys[1], keys[0])):
        only = [cell for cell in own if cell not in other]
        blocks.append(
            Table(
                tuple(_places(by)),
                only[: tables.ROW_LIMIT],
                f"Only in {side}.",
                f"{wording.plural(len(only), 'cell')}.",
            )
        )
    return blocks
