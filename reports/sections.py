"""What the report says, in which order: the blocks of `content` that any renderer sets."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from harness.contract import CellStatus
from reports import across, condition, derive, images, pairs, plots, stability, style, tables, wording
from reports.arrays import Shelf
from reports.content import Block, Code, Document, Section, Text
from reports.load import Run, Unreadable

SUMMARY_LINES = 30  # winners that fit on the first page beside the rest of it
OVERVIEW_SCENES = 12  # scenes that fit into its figure


def report(run: Run, frame: pd.DataFrame, rungs: pd.DataFrame) -> Document:
    """The whole report on one run; `frame` and `rungs` are the run's own with the derived columns."""
    shelf = Shelf(run.folder)
    pictures = images.galleries(shelf, frame)
    variants = pd.concat([of[["method", "variant"]] for of in (frame, run.families)])
    marks = style.variant_marks(variants.drop_duplicates().itertuples(index=False, name=None))
    condition_sections = condition.sections(shelf, frame, marks)
    unreadable = [*run.unreadable, *shelf.damaged.values()]
    sections = [
        _devices(run),
        *_winners(frame),
        *_results(frame),
        *across.sections(frame),
        *pairs.sections(frame),
        *_units(frame),
        *stability.sections(rungs, run.plan.facts, marks),
        *_fronts(frame),
        *condition_sections,
        *(
            Section(f"Pictures: {frame.loc[frame['surface'] == surface, 'surface_title'].iloc[0]}", (gallery,))
            for surface, gallery in pictures.items()
        ),
        Section(
            "Skipped, failed and missing",
            _troubles(run, frame, unreadable) or (Text("Nothing: every planned cell ran and gave a result."),),
            wide=True,
        ),
    ]
    return Document(run.plan.title or run.plan.name, _subtitle(run), _summary(run, frame, rungs), tuple(sections))


def _subtitle(run: Run) -> str:
    environment = run.plan.environment
    dirty = " with uncommitted changes" if environment.get("dirty") else ""
    parts = [f"firsthit {environment.get('firsthit', '')}".strip(), f"run “{run.plan.name}”", run.plan.created[:10]]
    if environment.get("commit"):
        parts.append(f"commit {environment['commit']}{dirty}")
    return " · ".join(parts)


def _troubles(run: Run, frame: pd.DataFrame, unreadable: Sequence[Unreadable]) -> tuple[Block, ...]:
    ended = tables.troubles(frame, run.families, run.plan.facts)
    return tuple(filter(None, (ended, tables.unreadable(unreadable), tables.not_run(run.not_run))))


def _summary(run: Run, frame: pd.DataFrame, rungs: pd.DataFrame) -> Section:
    """The first page: how it went, who wins where, who breaks where, how to run it again."""
    blocks: list[Block] = [] if frame.empty else [Text(_verdict(frame), strong=True)]
    blocks += [] if rungs.empty else [Text(stability.verdict(rungs), strong=True)]
    ended = pd.concat([frame["status"], run.families["status"]])
    blocks.append(tables.statuses(ended, len(run.unreadable), len(run.not_run)))
    blocks += [Text("To run it again, or go on where it stopped:"), Code(run.plan.command)]
    if _groups(frame):
        blocks.append(tables.winners(frame) if _groups(frame) <= SUMMARY_LINES else tables.wins(frame))
        scenes = tables.places(frame)
        figure = plots.overview(frame, style.marks(frame["method"]), scenes) if len(scenes) <= OVERVIEW_SCENES else None
        blocks += [figure] if figure else []
    elif not rungs.empty:
        blocks.append(stability.summary(rungs, run.plan.facts))
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


def _results(frame: pd.DataFrame) -> list[Section]:
    if frame.empty:
        return []
    finished = frame[frame["status"] == CellStatus.OK]
    if finished.empty:
        return [Section("Results", (Text("No cell gave a result; the reasons are listed below."),), wide=True)]
    legend = Text(
        f"Speed-up is over {derive.BASELINE}. Flags: front, no other variant with all rays right is both faster and "
        f"more exact; floor-bound, under {derive.FLOOR_FACTOR:g} times the null method's time, so that "
        "the harness is measured more than the method; floor, the null method itself, which finds nothing; interval "
        "wide, the budget ended before the 95 % interval of the median was within 2 %; drifts, the second half of the "
        "samples was slower or faster than the first; noisy, the middle half of the samples spreads over more than a "
        "tenth of the median; outliers, samples far outside the rest, which are kept; overhead, the harness's share "
        f"of the time where it is above {wording.share(tables.OVERHEAD_LIMIT)}."
    )
    printed = tables.worth_printing(finished)
    blocks: list[Block] = [legend]
    if len(printed) < len(finished):
        told = f"{len(printed):,} of {len(finished):,} rows: those on a front, {derive.BASELINE} and the floor"
        blocks.append(Text(f"Printed are {told}. results.csv has all."))
    blocks += [tables.results(rows) for _, rows in printed.groupby("comparison", sort=False)]
    return [Section("Results", tuple(blocks), wide=True)]


def _units(frame: pd.DataFrame) -> list[Section]:
    printed = tables.worth_printing(frame[frame["status"] == CellStatus.OK])
    tabled = [table for _, rows in printed.groupby("comparison", sort=False) if (table := tables.units(rows))]
    told = Text(
        "The same errors in the units that papers use, over rays away from silhouettes that hit the right root: the "
        "largest and the 99th percentile. |t − t*| in scene units; over the radius of the scene; over the feature "
        "radius (a torus's minor radius r; the scene's where a surface has none of its own); in pixel footprints at "
        "the hit; in units in the last place of t. Over condition × roundoff: the error over what the problem allows, "
        "max(condition, 1) × unit roundoff × the domain's radius, which a stable method keeps small. Normal: the angle "
        "between the surface's normals at the hit and at the root. Residual: |f| at the hit over the sum of |terms of "
        "f|, the backward error. Look for rows with a small error in one unit and a large one in another."
    )
    return [Section("Error in every unit", (told, *tabled), wide=True)] if tabled else []


def _fronts(frame: pd.DataFrame) -> list[Section]:
    marks, named = style.marks(frame["method"]), tables.places(frame)
    figures = [
        figure
        for i, (scene, rows) in enumerate(frame.groupby("comparison", sort=False))
        for figure in plots.speed_against_error(rows, marks, f"front-{i}", named[str(scene)])
    ]
    return [Section("Speed against error", tuple(figures), wide=True)] if figures else []
