"""Compare the forms of a formula: the same surface written in several ways, by range, work, time and error."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import matplotlib
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure as Drawing
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from harness.contract import CellStatus
from reports import wording
from reports.analysis import rounds, ties
from reports.analysis.surface_names import PRINTED, base_of, form_of
from reports.content import Block, Column, Figure, Matrix, Section, Square, Table, Text
from reports.drawing import line_labels, shades, style
from reports.drawing.canvas import LINE, NARROW, RC, svg
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 22
SIDES = (0.25, 0.03125, 0.00390625)  # of the boxes in the table, over the domain's radius
_ONE_PICTURE = ["device", "precision", "view", "size", "samples_per_pixel", "stage"]
_STYLES = (  # colour, marker and dashes; a form takes the next, and keeps it in all panels
    ("#222222", "o", "-"),
    ("#0072B2", "s", "--"),
    ("#D55E00", "^", ":"),
    ("#009E73", "D", "-."),
    ("#CC79A7", "v", (0, (5, 1))),
    ("#B8A800", "P", (0, (1, 1))),
)
EVEN = "even"
TOP = 4.0  # the factor that has the brightest colour, and its inverse the darkest
READ_RANGES = (
    "Interval arithmetic bounds f over a box, and how wide the bound is depends on how the formula is written. The "
    "plots show its width over that of f's range as boxes shrink: where two forms stay apart at the right, no "
    "subdivision brings them together."
)
READ_COST = "Dark squares are faster than the form as printed, bright ones slower; all forms were timed in turns."
LEAD = (
    "One polynomial may be written in many ways, and exact arithmetic cannot tell them apart; a test expands them "
    "all. Two things differ. An interval extension treats each place in the formula where a variable stands as if it "
    "were a variable of its own. So it is wider than f's range, the more so the more such places there are and the "
    "more their terms cancel. And each form rounds its own intermediate results. All forms of a surface see the same "
    "rays, and are timed in turns. “As printed” is the catalog's form, that of the paper which the surface is from."
)
WARNING = (
    "Fewer evaluations do not mean a tighter extension: a beam ends at the first piece that it cannot exclude, so "
    "that an extension that excludes nothing ends it at once, in front of the surface. Read evaluations with the "
    "wrong rays."
)


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless the run has two forms of a surface in one picture, or the study of ranges."""
    rows = _picture(material.evidence.of("forms.toml").frame)
    ranges = pd.DataFrame(material.run.studies.get("form_ranges", []))
    shown: list[Block] = []
    details: list[Block] = [Text(LEAD)]
    if not ranges.empty:
        titles = dict(zip(material.frame["surface"], material.frame["surface_title"], strict=True))
        shown += [Text(f"{READ_RANGES} {_narrowest(ranges, titles)}"), _figure(ranges, titles)]
        details.append(_ranges(ranges, rows, titles))
    if not rows.empty:
        shown += [Text(READ_COST), _cost(rows)]
        details += [_work(rows), Text(WARNING), _errors(rows)]
    return [Section("How a formula is written", tuple(shown), tuple(details), name="Forms")] if shown else []


def _cost(rows: pd.DataFrame) -> Matrix:
    """Make a line for each form and a column for each variant: its time over that of the form as printed."""
    variants = dict(zip(rows["variant"], rows["label"], strict=True))
    missing = shades.silent(wording.NONE, "not timed")
    body: list[tuple[str, tuple[Square, ...]]] = []
    for _, forms in rows.groupby("base", sort=False):
        title = str(forms["surface_title"].iloc[0]).removesuffix(f", {forms['form'].iloc[0]}")
        printed = _by_name(tuples(forms[forms["form"] == PRINTED]))
        for form, own in forms.groupby("form", sort=False):
            found = _by_name(tuples(own))
            squares = (_square(found[v], printed.get(v)) if v in found else missing for v in variants)
            body.append((f"{title}, {form}", tuple(squares)))
    return Matrix(
        tuple(variants.values()),
        body,
        "What a form costs: its time over that of the form as printed.",
        f"“Even”: the rounds do not tell the two apart; “?”: fewer than {ties.NEEDED} rounds timed both. "
        + _where(rows),
        "surface, form",
        shades.key({0.0: f"{TOP:g}× as fast", 0.5: "the same", 1.0: f"{TOP:g}× as slow"}),
    )


def _square(row: Any, printed: Any) -> Square:
    """Return the square of a form; `printed` is the row of the same variant with the form as printed, or None."""
    told = _times(row, printed)
    if told is None:
        return shades.silent(wording.NONE, "not timed")
    wrong = f", {wording.count(row.wrong_rays)} wrong" if row.wrong_rays else ""
    note = f"{row.label}: {wording.number(row.median_ms)} ms, {wording.count(row.wrong_rays)} wrong rays"
    over = 1.0 if row.surface == printed.surface or told == EVEN else rounds.times_over(row, printed)
    return Square(told + wrong, shades.shade(0.5 + math.log(over) / (2.0 * math.log(TOP))), note)


def _picture(frame: pd.DataFrame) -> pd.DataFrame:
    """Select the finished rows of surfaces with several forms, of the first device, precision, view and size of any."""
    bases = Counter(map(base_of, frame["surface"].unique()))
    several = [name for name in frame["surface"].unique() if bases[base_of(name)] > 1]  # a run may have none
    rows = frame[frame["surface"].isin(several)]
    rows = rows[rows["answers"].astype(bool) & (rows["status"] == CellStatus.OK)]
    rows = rows.assign(base=rows["surface"].map(base_of), form=rows["surface"].map(form_of))
    rows = rows[rows.groupby([*_ONE_PICTURE, "base"])["surface"].transform("nunique") > 1]
    return rows if rows.empty else rows[(rows[_ONE_PICTURE] == rows[_ONE_PICTURE].iloc[0]).all(axis=1)]


def _narrowest(ranges: pd.DataFrame, titles: dict[str, str]) -> str:
    """Name each surface's form with the narrowest extension over the smallest boxes, beside the form as printed."""
    told = []
    for base, own in ranges[ranges["side"] == ranges["side"].min()].groupby("surface", sort=False):
        factors = dict(zip(own["form"].map(form_of), own["factor"], strict=True))
        best = min(factors, key=lambda form: factors[form])
        printed = f"{wording.factor(factors[PRINTED])} {PRINTED}"
        rest = "" if best == PRINTED else f" and {wording.factor(factors[best])} {best}"
        told.append(f"{titles.get(str(base), base)} {printed}{rest}")
    return f"Over the smallest boxes, as printed and in the best form: {'; '.join(told)}."


def _ranges(ranges: pd.DataFrame, rows: pd.DataFrame, titles: dict[str, str]) -> Table:
    """Make a line for each form: how wide its extension is, and how many empty boxes it excludes."""
    operations = dict(zip(rows["surface"], rows["operations"], strict=True))
    body: list[tuple[Any, ...]] = []
    for form, own in ranges.groupby("form", sort=False):
        by_side = own.set_index("side")
        counted = operations.get(form)
        spent = None if wording.absent(counted) else sum(json.loads(str(counted)).values())
        factors = [by_side["factor"].get(side) for side in SIDES]
        shares = [by_side["excluded"].get(side) for side in SIDES]
        base = base_of(str(form))
        body.append((titles.get(base, base), form_of(str(form)), spent, *factors, *shares))
    heads = [f"1/{1 / side:.0f}" for side in SIDES]
    columns = (
        Column("surface"),
        Column("form"),
        Column("operations", wording.count, numeric=True),
        *(Column(head, wording.factor, numeric=True, over="width over the range's") for head in heads),
        *(Column(head, wording.share, numeric=True, over="empty boxes excluded") for head in heads),
    )
    caption = (
        "Width of the natural interval extension over that of f's range, as the ratio of their means over random "
        "boxes, the same for all forms, whose sides are 1/4, 1/32 and 1/256 of the domain's radius; 1× is exact. "
        "A natural extension converges in proportion to the box, so that "
        "the factor does not fall to 1 as boxes shrink: it stays with the form. Empty boxes hold no surface; those "
        "that are not excluded are searched in vain, or taken for the surface. Operations are those of one "
        "evaluation of f at a point. The torus as printed is szente's; toledo2007 prints another form of it."
    )
    return Table(columns, body, "What a form makes of f's range.", caption, group=1)


def _figure(ranges: pd.DataFrame, titles: dict[str, str]) -> Figure:
    """Draw each form's overestimation against the size of boxes, a panel for each surface."""
    bases = list(dict.fromkeys(ranges["surface"]))
    forms = list(dict.fromkeys(ranges["form"].map(form_of)))
    looks = {form: _STYLES[i % len(_STYLES)] for i, form in enumerate(forms)}
    across = min(2, len(bases))
    lines = -(-len(bases) // across)
    height = 0.4 + 1.5 * lines
    with matplotlib.rc_context(RC | {"font.size": 7.0}):
        drawing = Drawing(figsize=(NARROW, height))
        panels = drawing.subplots(lines, across, squeeze=False)
        drawing.subplots_adjust(0.6 / NARROW, 0.42 / height, 1 - 0.9 / NARROW, 1 - 0.2 / height, 0.5, 0.4)
        for axes, base in zip(panels.flat, bases, strict=False):
            axes.set_title(titles.get(base, base), color=style.INK)
            _panel(axes, ranges[ranges["surface"] == base], looks)
        for axes in list(panels.flat)[len(bases) :]:
            axes.axis("off")
        drawing.supxlabel("side of the boxes over the domain's radius", y=0.1 / height, va="center", fontsize=7)
        drawing.supylabel("width of the interval over that of f's range", x=0.08 / NARROW, ha="center", fontsize=7)
        drawn = svg(drawing)
    return Figure(
        "forms-range",
        drawn,
        f"Overestimation of the ranges of {wording.listed([titles.get(base, base) for base in bases])} by form.",
        "Overestimation against the size of boxes.",
        "1× is exact.",
    )


def _panel(axes: Axes, own: pd.DataFrame, looks: Mapping[str, tuple[str, str, Any]]) -> None:
    """Draw the overestimation of one surface's forms, named at their ends; `looks` has the style of each form."""
    ends = []
    for form, line in own.groupby(own["form"].map(form_of), sort=False):
        color, marker, dashes = looks[str(form)]
        line = line.sort_values("side")
        axes.plot(line["side"], line["factor"], color=color, marker=marker, ls=dashes, **LINE)
        ends.append((line["side"].iloc[0], line["factor"].iloc[0], str(form), color))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.invert_xaxis()
    sides = sorted(set(own["side"]))[::2]
    axes.xaxis.set_major_locator(FixedLocator(sides))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda side, _: f"1/{1 / side:.0f}"))
    high = own["factor"].max()
    axes.set_ylim(0.95, high * 1.1)
    axes.yaxis.set_major_locator(FixedLocator([1, 1.2, 1.5, 2] if high < 3 else [1, 2, 5, 10, 20, 50, 100]))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(FuncFormatter(lambda factor, _: f"{factor:g}×"))
    line_labels.write(axes, ends)


def _work(rows: pd.DataFrame) -> Table:
    """Make the table of evaluations per ray, and of times over that of the form as printed."""

    def told(row: Any, printed: Any) -> tuple[Any, Any]:
        return row.evaluations_mean, _times(row, printed)

    columns, body = _by_variant(rows, told, (Column("evals", wording.number, numeric=True), Column("time")))
    caption = (
        "Evaluations of f or of its extension per ray cast (per pixel, of beams), and the time of the form as printed, "
        "below it the others' over that: the median of the ratios within rounds; “even” where these do not tell the "
        f"two apart, “?” where fewer than {ties.NEEDED} rounds timed both. "
        f"{_where(rows)}"
    )
    return Table(columns, body, "What a form costs.", caption, group=1)


def _times(row: Any, printed: Any) -> str | None:
    """Write a form's time over that of the form as printed, or the time of the latter; None without a time."""
    if wording.absent(row.median_ms) or printed is None or wording.absent(printed.median_ms):
        return None
    if row.surface == printed.surface:
        return f"{wording.number(row.median_ms)} ms"
    factor = wording.factor(rounds.times_over(row, printed))
    paired = rounds.ratio(row, printed)
    if paired is None or paired.pairs < ties.NEEDED:
        return f"{factor} ?"
    return factor if ties.verdict(paired) in (ties.SLOWER, ties.FASTER) else EVEN


def _errors(rows: pd.DataFrame) -> Table:
    """Make the table of wrong rays and errors."""

    def told(row: Any, _: Any) -> tuple[Any, Any]:
        return row.wrong_rays, row.relative_error_p99

    heads = (Column("wrong", wording.count, numeric=True), Column("p99", wording.error, numeric=True))
    columns, body = _by_variant(rows, told, heads)
    rays = wording.count(rows["accuracy_rays"].max())
    caption = (
        f"Wrong rays of {rays}, without grazing and drowned ones, and the 99th percentile of the error |t − t*| of "
        "right hits over the scene's radius. To degree 4 point methods take f's coefficients along the ray, which are "
        "expanded from the form as it is written."
    )
    return Table(columns, body, "What a form's answers are worth.", caption, group=1)


def _by_variant(
    rows: pd.DataFrame, told: Callable[[Any, Any], tuple[Any, Any]], heads: tuple[Column, Column]
) -> tuple[tuple[Column, ...], list[tuple[Any, ...]]]:
    """Return columns and lines of a table with a line for each form and two columns for each variant.

    `told` returns the two values of a cell; it is given the row, and the row of the same variant with the form as
    printed, or None without one.
    """
    variants = dict(zip(rows["variant"], rows["label"], strict=True))
    body: list[tuple[Any, ...]] = []
    for _, forms in rows.groupby("base", sort=False):
        title = str(forms["surface_title"].iloc[0]).removesuffix(f", {forms['form'].iloc[0]}")
        printed = _by_name(tuples(forms[forms["form"] == PRINTED]))
        for form, own in forms.groupby("form", sort=False):
            found = _by_name(tuples(own))
            cells = [told(found[v], printed.get(v)) if v in found else (None, None) for v in variants]
            body.append((title, form, *(value for pair in cells for value in pair)))
    named = (Column("surface"), Column("form"))
    pairs = (Column(head.title, head.show, numeric=True, over=label) for label in variants.values() for head in heads)
    return (*named, *pairs), body


def _by_name(rows: Iterable[Any]) -> dict[str, Any]:
    """Return the rows as named tuples, by the name of their variant."""
    return {str(row.variant): row for row in rows}


def _where(rows: pd.DataFrame) -> str:
    """Write device, precision and size of rows of one picture."""
    first = rows.iloc[0]
    return f"{first['device']}, {first['precision']}, {first['size']} × {first['size']}."
