"""Tell where a method's default differs from what its source prints, and what each difference is worth."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from reports import wording
from reports.analysis import derive, rounds
from reports.content import Column, Section, Table, Text
from reports.labels import method_label
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 67
LEADS = True
ALL = "all of these"
TITLE = "Deviations from the papers"
PAGE = 40  # lines of the table that fit on a page
SHORT = 20  # lines of the table that stand on what a section before leaves of a page
WHAT = 72  # characters of what a knob is, in the table that fits on a page
SEEN = (
    "Where our default of a knob differs from what its source prints, this is what the printed value costs. Times over "
    "1× say that our change makes the method faster; wrong rays are neither grazing nor drowned."
)
TOLD = (
    "Each method's default is compared with the same method in which one knob stands at the value that its source "
    "prints, and then with all such knobs there. Where a source prints none, the method's card says how it is read. "
    "What differs beside these knobs is said there too, under “changes against the paper”."
)
CAPTION = (
    "Time is that of the method as printed over that of our default: the median, the least and the largest over the "
    "surfaces, views and devices that were timed in the same rounds. Over 1 our change makes the method faster; a "
    "dash says that no common rounds were timed. Evaluations are means over all rays cast. Wrong rays are neither "
    "grazing nor drowned. The largest error is over the scene's radius and of right hits. Every figure is a sum or an "
    "extreme over the comparisons that have both."
)

_ELSE = ["prepass", "origin", "proxy", "normal"]  # in which rows of one comparison may differ beside their knobs
_KEYS = ["run", *derive.GROUP, *_ELSE]
_FIGURES = ["evaluations_mean", "wrong_rays", "judged", "relative_error_max"]
_READ = ["method", "status", "accuracy_rays", "parameters", *_KEYS, *rounds.COLUMNS, *_FIGURES]


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has no method with a knob at its printed value and at its default."""
    frame = material.frame[_READ]
    body = [line for name, told in material.run.plan.methods.items() for line in _lines(name, told, frame)]
    if not body:
        return []
    return [Section(TITLE, (Text(SEEN), _short(body)), (Text(TOLD), _full(body)), len(body) > SHORT, "Deviations")]


def _short(body: list[tuple[Any, ...]]) -> Table:
    """Make the table that fits on a page: what each change is worth in time, wrong rays and error."""
    rows = []
    for label, knob, ours, printed, what, *figures in body[:PAGE]:
        _, time, _, _, _, *wrong_and_errors = figures
        own, theirs, _, *errors = wrong_and_errors
        change = f"{knob} {printed} → {ours}" if printed else knob
        rows.append((label, change, wording.excerpt(what.partition(";")[0], WHAT), time, own, theirs, *errors))
    return Table(
        (
            Column("method"),
            Column("knob, printed → ours"),
            Column("what it is", stretch=3),
            Column("time, printed\nover ours", wording.factor, numeric=True),
            Column("ours", wording.count, numeric=True, over="wrong rays"),
            Column("printed", wording.count, numeric=True, over="wrong rays"),
            Column("ours", wording.error, numeric=True, over="largest error"),
            Column("printed", wording.error, numeric=True, over="largest error"),
        ),
        rows,
        "What our changes to the papers' methods are worth.",
        f"The first {PAGE} of {len(body)} lines; the HTML page has all." if len(body) > PAGE else "",
        group=1,
    )


def _full(body: list[tuple[Any, ...]]) -> Table:
    """Make the whole table."""
    ours, theirs = "ours", "as printed"
    columns = (
        Column("method"),
        Column("knob"),
        Column("ours"),
        Column("printed"),
        Column("what it is", stretch=1),
        Column("compa-\nrisons", wording.count, numeric=True),
        Column("time", wording.factor, numeric=True, over="as printed over ours"),
        Column("from", wording.factor, numeric=True, over="as printed over ours"),
        Column("to", wording.factor, numeric=True, over="as printed over ours"),
        Column("evalua-\ntions", wording.factor, numeric=True, over="as printed over ours"),
        Column(ours, wording.count, numeric=True, over="wrong rays"),
        Column(theirs, wording.count, numeric=True, over="wrong rays"),
        Column("of", wording.count, numeric=True, over="wrong rays"),
        Column(ours, wording.error, numeric=True, over="largest error"),
        Column(theirs, wording.error, numeric=True, over="largest error"),
    )
    return Table(columns, body, "What our changes to the papers' methods are worth, in full.", CAPTION, group=1)


def _lines(name: str, told: Mapping[str, Any], frame: pd.DataFrame) -> Iterator[tuple[Any, ...]]:
    """Yield a line for each knob whose printed value was run alone, and one for all of them together."""
    knobs = {knob["name"]: knob for knob in told.get("parameters", []) if knob.get("printed") is not None}
    rows = frame[(frame["method"] == name) & (frame["status"] == "ok") & frame["accuracy_rays"].notna()]
    if not knobs or rows.empty:
        return
    label = method_label(name, {name: told})
    defaults = {knob["name"]: knob["default"] for knob in told["parameters"]}
    bound = rows["parameters"].map(lambda text: defaults | json.loads(text))
    ours = rows[(bound == defaults).astype(bool)]
    for knob in knobs.values():
        theirs = rows[(bound == defaults | {knob["name"]: knob["printed"]}).astype(bool)]
        what = (label, knob["name"], f"{knob['default']:.3g}", f"{knob['printed']:.3g}", knob["meaning"])
        yield from _line(what, ours, theirs)
    if len(knobs) > 1:
        printed = {key: knob["printed"] for key, knob in knobs.items()}
        yield from _line((label, ALL, "", "", ""), ours, rows[(bound == defaults | printed).astype(bool)])


def _line(what: tuple[str, ...], ours: pd.DataFrame, theirs: pd.DataFrame) -> Iterator[tuple[Any, ...]]:
    """Yield one line if the rows `ours` and `theirs` have a comparison in common; `what` are its first cells."""
    left, right = (
        rows.assign(**{name: rows[name].fillna("") for name in _ELSE}).drop_duplicates(_KEYS).set_index(_KEYS)
        for rows in (ours, theirs)
    )
    common = left.index.intersection(right.index)
    if common.empty:
        return
    left, right = left.loc[common], right.loc[common]
    pairs = zip(*(tuples(rows[rounds.COLUMNS]) for rows in (left, right)), strict=True)
    timed = (rounds.ratio(b, a) for a, b in pairs)
    times = [ratio.median for ratio in timed if ratio is not None]
    spread = (float(np.median(times)), min(times), max(times)) if times else (None, None, None)
    spent = right["evaluations_mean"].sum(skipna=False) / left["evaluations_mean"].sum(skipna=False)
    wrong = (left["wrong_rays"].sum(skipna=False), right["wrong_rays"].sum(skipna=False), left["judged"].sum())
    errors = (left["relative_error_max"].max(), right["relative_error_max"].max())
    yield (*what, len(common), *spread, spent, *wrong, *errors)
