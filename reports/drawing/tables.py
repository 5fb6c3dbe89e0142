"""Frames → tables of content. Each function makes one table with a caption that says what to see in it."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, ties
from reports.content import Column, Table
from reports.reading.load import Facts, Unreadable

ROW_LIMIT = 1_500  # rows that one list prints; a longer one belongs in results.csv
REASON_LIMIT = 500  # characters of a reason; a compiler's full log stays in the cell's file
WRONG = {  # heads of columns, by the kind of wrong rays
    "misses": "misses",
    "false_hits": "false\nhits",
    "exhausted": "exhaus-\nted",
    "wrong_root": "wrong\nroot",
    "invalid": "in-\nvalid",
}
OVERHEAD_LIMIT = 0.05  # a larger share of the time is flagged: the harness promises less


def places(frame: pd.DataFrame) -> dict[str, str]:
    """Each comparison's name for people: the surface, and what of view, size and stage differs among its scenes."""
    scenes = frame.drop_duplicates("comparison")
    counted = scenes.groupby("surface")[["view", "size", "samples_per_pixel", "stage"]].nunique() > 1
    differs = {surface: {name for name in counted if row[name]} for surface, row in counted.iterrows()}
    named = {}
    for row in scenes.itertuples():
        several = differs[row.surface]
        parts = [row.surface_title]
        parts += [row.view] if "view" in several else []
        parts += [picture_size(row)] if several & {"size", "samples_per_pixel"} else []
        parts += [row.stage] if "stage" in several else []
        named[str(row.comparison)] = ", ".join(parts)
    runs = dict(zip(frame["comparison"], frame["run"], strict=True))
    shared = Counter(named.values())
    return {scene: f"{name} ({runs[scene]})" if shared[name] > 1 else name for scene, name in named.items()}


def picture_size(row: Any) -> str:
    samples = "" if row.samples_per_pixel == 1 else f" × {row.samples_per_pixel} samples"
    return f"{row.size} × {row.size}{samples}"


def statuses(ended: pd.Series, unreadable: int, not_run: int) -> Table:
    """How many cells ended how: one column for each status that occurs, and always one for `ok`."""
    counts = {str(status): int((ended == status).sum()) for status in CellStatus}
    counts |= {"unreadable": unreadable, "not run yet": not_run}
    shown = {name: count for name, count in counts.items() if count or name == CellStatus.OK}
    cells = Column("cells", wording.count, numeric=True)
    columns = (cells, *(Column(name, wording.count, numeric=True) for name in shown))
    return Table(columns, [(sum(counts.values()), *shown.values())], "Cells by how they ended.")


def winners(frame: pd.DataFrame, leading: pd.DataFrame) -> Table:
    """The fastest variant of every group, the fastest with every ray right where that is another, and what the latter
    is not told apart from; `leading` is of ties.leaders."""
    rows = derive.contenders(frame)
    fastest = ties.fastest(frame)
    safest = {(r.comparison, r.device, r.precision): r for r in leading.itertuples()}
    body: list[tuple[Any, ...]] = []
    named = places(frame)
    fastest = fastest.assign(planned=fastest["comparison"].map({name: i for i, name in enumerate(named)}))
    shown = fastest.sort_values(["planned", "precision", "device"], kind="stable").head(ROW_LIMIT)
    for row in shown.itertuples():
        safe = safest.get((row.comparison, row.device, row.precision))
        instead = ("none", None, None) if safe is None else (safe.variant, safe.median_ms, _named(safe.tied))
        if safe is not None and safe.variant == row.variant:
            instead = ("the same", None, instead[2])
        values = (row.median_ms, row.speedup, row.error_max, row.wrong_rays)
        body.append((named[row.comparison], row.precision, row.device, row.variant, *values, *instead))
    columns: tuple[Column, ...] = (
        Column("surface", stretch=4),
        Column("precision"),
        Column("device"),
        Column("fastest variant", stretch=3),
        Column("ms", wording.number, numeric=True),
        Column("speed-\nup", wording.factor, numeric=True),
        Column("max\nerror", wording.error, numeric=True),
        Column("wrong\nrays", wording.count, numeric=True),
        Column("fastest with no wrong ray", stretch=3),
        Column("ms", wording.number, numeric=True),
        Column("not told\napart from", stretch=2),
    )
    note = " Where the columns after it name another variant, the fastest buys its speed with wrong answers."
    if all(row[-3] == "the same" for row in body):
        columns, body, note = columns[:-3] + columns[-1:], [row[:-3] + row[-1:] for row in body], ""
    if len(shown) < len(fastest):
        note += f" The first {len(shown):,} of {len(fastest):,}; results.csv has all."
    return Table(
        columns,
        body,
        "What wins where.",
        f"{speedup(rows)} Max error is the largest |t − t*| in scene units over rays away from silhouettes; wrong rays "
        "are misses, false hits, exhausted rays, wrong roots and invalid answers among them, of the "
        f"{checked(shown)} rays of each scene's check. Not told apart: the "
        "fastest variants of other methods, with no wrong ray, whose times are not told to be longer than that of the "
        "fastest without one; of a method's own settings the fastest is by the median."
        + wording.zeros(shown["error_max"])
        + note,
        group=2,
    )


def checked(rows: pd.DataFrame) -> str:
    """How many rays each check casts: one number, or the least and the most; a question mark where none tells."""
    known = rows["accuracy_rays"].dropna()
    if known.empty:
        return "?"
    return " to ".join(dict.fromkeys((wording.count(known.min()), wording.count(known.max()))))


def speedup(rows: pd.DataFrame) -> str:
    """What a speed-up is, in a sentence, for captions."""
    return (
        f"Speed-up is {derive.baseline_of(rows)}'s time over this one's on the same device, in the same precision: the "
        "median of the ratios within the rounds that timed both, which need not be the ratio of the two medians; "
        "– where one of the two answers a ray away from silhouettes wrongly, was not timed or shares no round with the "
        "other."
    )


def _named(variants: Sequence[str]) -> str | None:
    return ", ".join(variants) or None


def wins(leading: pd.DataFrame) -> Table:
    """For each device and precision, how often each method is fastest; `leading` is of ties.leaders."""
    body = []
    for (device, precision), rows in leading.groupby(["device", "precision"], sort=False):
        alone = rows[rows["tied"].map(len) == 0]
        counted = ", ".join(f"{method} {n}" for method, n in Counter(alone["method"]).most_common()) or "none"
        shared = len(rows) - len(alone)
        body.append((device, precision, len(rows), counted, shared, rows["speedup"].median(), rows["error_max"].max()))
    return Table(
        (
            Column("device"),
            Column("precision"),
            Column("scenes", wording.count, numeric=True),
            Column("fastest method, and on how many scenes", stretch=1),
            Column("not told\napart", wording.count, numeric=True),
            Column("median\nspeed-up", wording.factor, numeric=True),
            Column("worst\nmax error", wording.error, numeric=True),
        ),
        body,
        "Which method is fastest with no wrong ray, and how often.",
        "Scenes are those with a variant that has no wrong ray away from silhouettes; not told apart are those on "
        f"which the times of several methods are not. {speedup(leading)} It and the largest |t − t*|, in scene units, "
        f"are of the fastest variants.{wording.zeros(leading['error_max'])}",
        group=1,
    )


def flags(row: Any) -> str:
    """What a reader must know before trusting or quoting a row."""
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


def results(rows: pd.DataFrame) -> Table:
    """Every finished row of one comparison, fastest first for each device and precision."""
    rows = rows.sort_values(["device", "precision", "median_ms"], kind="stable")
    kinds = derive.kinds(rows)
    body = []
    for row in rows.itertuples():
        reach = max(row.upper_ms - row.median_ms, row.median_ms - row.lower_ms)  # as measure.is_narrow has it
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
            *(Column(WRONG[kind], wording.count, numeric=True) for kind in kinds),
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


def units(rows: pd.DataFrame) -> Table | None:
    """The largest and the 99th-percentile error of every row of one comparison that answers, in every unit."""
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
        scene(rows),
        group=2,
    )


def scene(rows: pd.DataFrame) -> str:
    first = next(rows.head(1).itertuples())
    return f"{first.surface_title}, view {first.view}, {picture_size(first)}, {first.stage}."


def _drowned(rows: pd.DataFrame) -> str:
    """How many rays drown, in each precision."""
    most = rows[rows["drowned"].notna()].groupby("precision", sort=False)["drowned"].max()
    return ", ".join(f"{wording.count(count)} in {precision}" for precision, count in most.items()) or "not counted"


def _results_caption(rows: pd.DataFrame) -> tuple[str, str]:
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
        scene(rows),
        "Fastest first for each device and precision; ± is how far the 95 % interval reaches from the median, over the "
        "median; "
        f"errors are |t − t*| in scene units.{wording.zeros(rows['error_max'], rows['error_p99'])} {speedup(rows)}"
        f"{checked}",
    )


def worth_printing(finished: pd.DataFrame) -> pd.DataFrame:
    """All finished rows of a run of moderate size; of a larger one its fronts and what they are compared with."""
    if len(finished) <= ROW_LIMIT:
        return finished
    is_baseline = (finished["method"] == finished["baseline"]) | (finished["variant"] == finished["baseline"])
    return finished[finished["front"] | is_baseline | ~finished["answers"]]


def troubles(frame: pd.DataFrame, families: pd.DataFrame, facts: Mapping[str, Facts]) -> Table | None:
    """Every cell that ended otherwise than `ok`, those with the same reason together."""
    views = frame.assign(place=frame["comparison"].map(places(frame)))
    hard = families.assign(place=[f"family: {facts[name].title}" for name in families["family"]])
    told = ["status", "reason", "device", "precision", "place", "variant"]
    rows = pd.concat([of[of["status"] != CellStatus.OK][told] for of in (views, hard)])
    rows = rows.sort_values(["status", "reason", "device"], kind="stable")
    if rows.empty:
        return None
    body = []
    for row in rows.head(ROW_LIMIT).itertuples():
        reason = None if wording.absent(row.reason) else wording.excerpt(row.reason, REASON_LIMIT)
        body.append((row.status, reason, row.device, row.precision, row.place, row.variant))
    cut = f" The first {ROW_LIMIT:,} of {len(rows):,}; results.csv has all." if len(rows) > ROW_LIMIT else ""
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


def unreadable(files: Sequence[Unreadable]) -> Table | None:
    if not files:
        return None
    body = [(file.file, wording.excerpt(file.problem, REASON_LIMIT)) for file in files[:ROW_LIMIT]]
    return Table(
        (Column("file"), Column("problem", stretch=1)),
        body,
        "Files that could not be read.",
        f"{wording.plural(len(files), 'file')} of this run left out; run again to have them made anew.",
    )


def not_run(slots: Sequence[str]) -> Table | None:
    """How many cells wait, for each device: the last word of a slot."""
    if not slots:
        return None
    counted = Counter(slot.rpartition(" ")[2] for slot in slots)
    return Table(
        (Column("device"), Column("cells not run yet", wording.count, numeric=True)),
        counted.most_common(),
        "Not run yet.",
        "Planned cells without a result of any kind; the command on the first page goes on where the run stopped.",
    )
