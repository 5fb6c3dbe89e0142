"""What the report says, in which order: the blocks of `content` that any renderer sets."""

from __future__ import annotations

import pandas as pd

from harness.contract import CellStatus
from reports import derive, images, plots, style, tables, wording
from reports.content import Block, Code, Document, Section, Text
from reports.load import Run

SUMMARY_LINES = 30  # winners that fit on the first page beside the rest of it
OVERVIEW_SCENES = 12  # scenes that fit into its figure


def report(run: Run, frame: pd.DataFrame) -> Document:
    """The whole report on one run; `frame` is the run's own with the derived columns."""
    pictures, damaged = images.galleries(run.folder, frame)
    unreadable = [*run.unreadable, *damaged]
    sections = [
        _devices(run),
        *_winners(frame),
        _results(frame),
        *_fronts(frame),
        *(
            Section(f"Pictures: {frame.loc[frame['surface'] == surface, 'surface_title'].iloc[0]}", (gallery,))
            for surface, gallery in pictures.items()
        ),
        Section(
            "Skipped, failed and missing",
            tuple(filter(None, (tables.troubles(frame), tables.unreadable(unreadable), tables.not_run(run.not_run))))
            or (Text("Nothing: every planned cell ran and gave a result."),),
            wide=True,
        ),
    ]
    return Document(run.plan.title or run.plan.name, _subtitle(run), _summary(run, frame), tuple(sections))


def _subtitle(run: Run) -> str:
    environment = run.plan.environment
    dirty = " with uncommitted changes" if environment.get("dirty") else ""
    parts = [f"firsthit {environment.get('firsthit', '')}".strip(), f"run “{run.plan.name}”", run.plan.created[:10]]
    if environment.get("commit"):
        parts.append(f"commit {environment['commit']}{dirty}")
    return " · ".join(parts)


def _summary(run: Run, frame: pd.DataFrame) -> Section:
    """The first page: how it went, who wins where, how to run it again."""
    blocks: list[Block] = [Text(_verdict(frame), strong=True)]
    blocks.append(tables.statuses(frame, len(run.unreadable), len(run.not_run)))
    blocks += [Text("To run it again, or go on where it stopped:"), Code(run.plan.command)]
    if _groups(frame):
        blocks.append(tables.winners(frame) if _groups(frame) <= SUMMARY_LINES else tables.wins(frame))
        scenes = tables.places(frame)
        figure = plots.overview(frame, style.marks(frame["method"]), scenes) if len(scenes) <= OVERVIEW_SCENES else None
        blocks += [figure] if figure else []
    return Section("Summary", tuple(blocks))


def _groups(frame: pd.DataFrame) -> int:
    return int(derive.contenders(frame).groupby(derive.GROUP).ngroups)


def _verdict(frame: pd.DataFrame) -> str:
    """One sentence for who reads no further."""
    rows = derive.contenders(frame)
    right = rows[derive.all_right(rows)].drop_duplicates(derive.GROUP)
    if right.empty:
        return "No variant was timed with every ray away from silhouettes answered rightly."
    total = _groups(frame)
    counted = right["method"].value_counts()
    method = str(counted.index[0])
    won = right[right["method"] == method]
    sentence = (
        f"Of the variants with no wrong ray away from silhouettes, {method} is fastest in {counted.iloc[0]} of "
        f"{wording.plural(total, 'combination')} of surface, view, device and precision"
    )
    gains = won["speedup"].dropna()
    if method == derive.BASELINE or gains.empty:
        return f"{sentence}."
    low, high, error = wording.factor(gains.min()), wording.factor(gains.max()), wording.error(won["error_max"].max())
    gain = low if low == high else f"{low} to {high}"
    return f"{sentence}: {gain} as fast as {derive.BASELINE}, with a largest error of {error}."


def _devices(run: Run) -> Section:
    config = Code(run.plan.config_text, "toml")
    tabled = (tables.devices(run.plan), tables.environment(run.plan))
    return Section("Devices, environment, config", (*tabled, config), wide=True)


def _winners(frame: pd.DataFrame) -> list[Section]:
    """A section of its own where the winners do not fit on the first page."""
    return [Section("Winners", (tables.winners(frame),))] if _groups(frame) > SUMMARY_LINES else []


def _results(frame: pd.DataFrame) -> Section:
    finished = frame[frame["status"] == CellStatus.OK]
    if finished.empty:
        return Section("Results", (Text("No cell gave a result; the reasons are listed below."),), wide=True)
    legend = Text(
        f"Speed-up is over {derive.BASELINE}. Flags: front, no other variant with all rays right is both faster and "
        f"more exact; floor-bound, under {derive.FLOOR_FACTOR:g} times the null method's time, so that "
        "the harness is measured more than the method; floor, the null method itself, which finds nothing; interval "
        "wide, the budget ended before the 95 % interval of the median was within 2 %; overhead, the harness's share "
        f"of the time where it is above {wording.share(tables.OVERHEAD_LIMIT)}."
    )
    printed = tables.worth_printing(finished)
    blocks: list[Block] = [legend]
    if len(printed) < len(finished):
        told = f"{len(printed):,} of {len(finished):,} rows: those on a front, {derive.BASELINE} and the floor"
        blocks.append(Text(f"Printed are {told}. results.csv has all."))
    blocks += [tables.results(rows) for _, rows in printed.groupby("comparison", sort=False)]
    return Section("Results", tuple(blocks), wide=True)


def _fronts(frame: pd.DataFrame) -> list[Section]:
    marks, named = style.marks(frame["method"]), tables.places(frame)
    figures = [
        figure
        for i, (scene, rows) in enumerate(frame.groupby("comparison", sort=False))
        for figure in plots.speed_against_error(rows, marks, f"front-{i}", named[str(scene)])
    ]
    return [Section("Speed against error", tuple(figures), wide=True)] if figures else []
