"""Show how cost grows: time against pixels, degree and instances, with fitted exponents."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.figure import Figure as Drawing
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import NDArray

from harness.contract import CellStatus
from reports import wording
from reports.analysis import derive, rounds
from reports.analysis.fits import FEWEST, Power, Refusal, power_law
from reports.content import Block, Column, Figure, Section, Table, Text
from reports.drawing import style, tables
from reports.drawing.canvas import LINE, NARROW, RC, Key, label_decades, line_of, svg
from reports.drawing.style import Mark
from reports.material import Material

ORDER = 26
PANELS = 6  # of one figure
MOST_LINES = 12  # variants in one figure; where there are more, those with an exponent are drawn
LEAD = (
    "Time t against {unit} n, on logarithmic axes, and the line t = c·nᵏ that fits the logarithms best. The exponent k "
    "stands with its 95 % interval, and is told only where that is no wider than k itself. The points of a line are of "
    "different pictures, which were timed one after the other: what slowed the machine down meanwhile is in the "
    "scatter. No point is of a row {wrongly}."
)
MOST_FIGURES = 4  # for one axis; the first is printed
ACROSS = 3  # panels beside each other


@dataclass(frozen=True)
class Axis:
    """Define a quantity that cost grows with.

    Rows with the same values in the columns `fixed` differ in nothing else.
    """

    name: str
    unit: str
    of: Callable[[pd.DataFrame], pd.Series]  # the quantity of each row
    fixed: tuple[str, ...]  # columns
    needs: str  # a column; a frame without it has nothing to fit
    above_floor: bool = False  # whether the null method's time is subtracted, in the rounds that timed both
    right: Callable[[pd.DataFrame], pd.Series] = derive.all_right  # which rows' answers are good enough to time
    wrongly: str = "with a ray away from silhouettes answered wrongly, or unchecked"  # says what the other rows are
    expected: str = ""  # says what an exponent means


_READ = [
    *("run", "key", "slot", "comparison", "method", "variant", "label", "method_label", "answers", "baseline"),
    *("surface", "surface_title", "scene", "view", "size", "samples_per_pixel", "stage", "precision", "device"),
    *("degree", "instances", "prepass", "origin", "median_ms", "wrong_rays", *derive.CLEAR_RAYS, *rounds.COLUMNS),
]  # columns: a frame of 10^6 rows and all columns is not copied for this
_ELSE = ("device", "precision", "stage", "samples_per_pixel")
AXES = (
    Axis(
        "pixels",
        "pixels",
        lambda rows: rows["size"].astype(float) ** 2,
        ("surface", "view", *_ELSE),
        needs="size",
        expected="An exponent of 1 is a cost in proportion to the pixels; less, that small pictures do not fill the "
        "device or pay a fixed price.",
    ),
    Axis(
        "degree",
        "degree of the surface",
        lambda rows: rows["degree"],
        ("size", "view", *_ELSE),
        needs="degree",
        above_floor=True,
        expected="Times are above the null method's, where it ran, in the rounds that timed both. Surfaces differ in "
        "more than their degree, in the "
        "share of the picture they cover most of all, so that the interval is wide.",
    ),
    Axis(
        "instances",
        "instances in the scene",
        lambda rows: rows["instances"],
        ("scene", "size", "view", *_ELSE),
        needs="instances",
        right=derive.nearly_all_right,
        wrongly="with over 1 in 1,000 rays answered wrongly away from silhouettes, or unchecked",
        expected="An exponent of 0 is a cost that pixels alone decide, 1 one in proportion to the instances.",
    ),
)
TITLES = {axis.name: f"Cost against {axis.name}" for axis in AXES}


@dataclass(frozen=True, eq=False)
class Curve:
    """Hold the times of one variant along one axis, all else fixed."""

    place: tuple[Any, ...]  # the values of the axis's `fixed`, in their order
    variant: str
    label: str
    x: NDArray[np.float64]  # [n], growing
    ms: NDArray[np.float64]  # [n]
    fit: Power | Refusal


def _points(frame: pd.DataFrame, axis: Axis) -> tuple[pd.DataFrame, dict[str, int]]:
    """Return the rows that become points, with `x` and `ms`, and for each reason how many rows are left out.

    Only rows of lines that have at least FEWEST places are counted.
    """
    if axis.needs not in frame:
        return frame.head(0), {}
    timed = (frame["status"] == CellStatus.OK) & frame["median_ms"].notna()
    if axis.of(frame.loc[timed, [axis.needs]]).nunique() < FEWEST:
        return frame.head(0), {}
    rows = frame.loc[timed, _READ]
    rows = rows.assign(x=axis.of(rows).astype("float64"), ms=rows["median_ms"])
    rows = rows[rows["x"] > 0]
    above_floor = _over_floor(rows, axis)
    if axis.above_floor:
        rows = rows[rows["answers"].astype(bool)]
    if rows.empty:
        return rows, {}
    rows = rows[rows.groupby(_line(axis), sort=False)["x"].transform("nunique") >= FEWEST]
    left_out = {}
    right = axis.right(rows) | ~rows["answers"].astype(bool)
    left_out[axis.wrongly] = int((~right).sum())
    rows = rows[right]
    if above_floor is not None:
        rows = rows.assign(ms=above_floor.reindex(rows.index))
        left_out["without a round shared with the null method"] = int(rows["ms"].isna().sum())
        left_out["no slower than the null method"] = int((rows["ms"] <= 0.0).sum())
        rows = rows[rows["ms"] > 0.0]
    return rows, {reason: count for reason, count in left_out.items() if count}


def _over_floor(rows: pd.DataFrame, axis: Axis) -> pd.Series | None:
    """Return by how many ms each row takes longer than its group's null method, float64 with the index of `rows`.

    NaN where the two share no round. None where no null method is subtracted.
    """
    floors = derive.floor_rows(rows)
    if not axis.above_floor or floors.empty:
        return None
    return rounds.above_first(rows, floors, derive.GROUP)


def _line(axis: Axis) -> list[str]:
    """Return the columns whose values the points of one line share."""
    return [*axis.fixed, "variant"]


def _curves(axis: Axis, rows: pd.DataFrame) -> list[Curve]:
    """Fit a curve to each line of at least FEWEST places, in the plan's order; `rows` is what _points returns."""
    by = _line(axis)
    if rows.empty:
        return []
    rows = rows.loc[rows.groupby(by, sort=False)["x"].transform("nunique") >= FEWEST, [*by, "label", "x", "ms"]]
    lines = rows.groupby(by, sort=False).ngroup().to_numpy()  # -1 of a row that lacks one of `by`
    x, ms = rows["x"].to_numpy(), rows["ms"].to_numpy()
    order = np.lexsort((x, lines))[np.count_nonzero(lines < 0) :]
    starts = np.flatnonzero(np.diff(lines[order], prepend=-1))
    names = rows[[*by, "label"]].take(order[starts]).itertuples(index=False, name=None)
    found = []
    for (*place, variant, label), at in zip(names, np.split(order, starts[1:]), strict=False):
        found.append(Curve(tuple(place), str(variant), str(label), x[at], ms[at], power_law(x[at], ms[at])))
    return found


def sections(material: Material) -> list[Section]:
    """Make a section for each axis along which some variant was timed at FEWEST places or more.

    Where all of its rows are left out, the section says so.
    """
    frame, made = material.listed, []
    titles = frame.drop_duplicates("surface").set_index("surface")["surface_title"].to_dict()
    for axis in (_of_run(axis, frame) for axis in AXES):
        rows, left_out = _points(frame, axis)
        found = _curves(axis, rows)
        if found or left_out:
            figures = list(_figures(axis, found, material.marks, titles)) if found else []
            fitted = [curve for curve in found if isinstance(curve.fit, Power)]
            told = 2 * len(fitted) >= len(found) > 0  # else a page would say little
            shown: tuple[Block, ...] = (Text(_said(axis, fitted, titles)), figures[0]) if told else ()
            details: list[Block] = [Text(LEAD.format(unit=axis.unit, wrongly=axis.wrongly) + _told_left_out(left_out))]
            details += [*figures[1 if told else 0 :], _table(axis, found, titles)] if found else []
            made.append(Section(TITLES[axis.name], shown, tuple(details)))
    return made


def _said(axis: Axis, fitted: list[Curve], titles: Mapping[str, str]) -> str:
    """Say which cost grows least and which most, from the curves with an exponent; there is at least one."""
    named = _places(axis, fitted, titles)
    least, *_, most = sorted([*fitted, *fitted[:1]], key=_exponent)
    told = f"Time grows as nᵏ with the {axis.unit} n; the line of each method shows k. {axis.expected} "
    if least is most:
        return wording.minus(f"{told}Here k is {_exponent(least):.2f}, of {least.label}, {named[least.place]}.")
    ends = [f"{_exponent(c):.2f} ({c.label}, {named[c.place]})" for c in (least, most)]
    return wording.minus(f"{told}Here k goes from {ends[0]} to {ends[1]}.")


def _exponent(curve: Curve) -> float:
    """Return the exponent of a curve that has one."""
    assert isinstance(curve.fit, Power)
    return curve.fit.exponent


def _of_run(axis: Axis, frame: pd.DataFrame) -> Axis:
    """Return the axis as this run has it: in a run without a null method nothing is subtracted."""
    return axis if bool((~frame["answers"].astype(bool)).any()) else replace(axis, above_floor=False)


def _told_left_out(left_out: Mapping[str, int]) -> str:
    """Say how many rows are left out for which reason; "" where none are."""
    each = wording.listed([f"{wording.plural(count, 'row')} {reason}" for reason, count in left_out.items()])
    return f" Left out: {each}; a line that keeps fewer than {FEWEST} places is not drawn." if each else ""


def _table(axis: Axis, found: list[Curve], titles: Mapping[str, str]) -> Table:
    """Make a line for each curve, the fastest growing first within its place."""
    named = _places(axis, found, titles)
    order = list(dict.fromkeys(curve.place for curve in found))
    lines = sorted(found, key=lambda c: (order.index(c.place), -c.fit.exponent if isinstance(c.fit, Power) else np.inf))
    return Table(
        (
            Column("where", stretch=1),
            Column("variant", stretch=1),
            Column("points", wording.count, numeric=True),
            Column("exponent", wording.hundredths, numeric=True),
            Column("±", wording.hundredths, numeric=True),
            Column("scatter", wording.share, numeric=True),
            Column("why there is none", stretch=2),
        ),
        [(named[c.place], c.label, c.fit.points, *_told(c.fit)) for c in lines[: tables.ROW_LIMIT]],
        f"Exponents of time over {axis.name}.",
        "The fastest growing first. ± is half the 95 % interval; scatter, the standard deviation of the points' times "
        "about the line, as a share of the time."
        + (f" The first {tables.ROW_LIMIT:,} of {len(lines):,}." if len(lines) > tables.ROW_LIMIT else ""),
        group=1,
    )


def _told(fit: Power | Refusal) -> tuple[Any, ...]:
    """Return the exponent, half its interval and the scatter, or why there are none."""
    if isinstance(fit, Refusal):
        return (None, None, None, fit.reason)
    return (fit.exponent, fit.half_width, fit.scatter, None)


def _places(axis: Axis, found: list[Curve], titles: Mapping[str, str]) -> dict[tuple[Any, ...], str]:
    """Return the name of each place: its surface, device and precision, and what else differs among the places."""
    columns = list(zip(*dict.fromkeys(curve.place for curve in found), strict=True))
    shown = [
        i for i, name in enumerate(axis.fixed) if name in ("surface", "device", "precision") or len(set(columns[i])) > 1
    ]

    def words(i: int, value: Any) -> str:
        name = axis.fixed[i]
        if name == "samples_per_pixel":
            return f"{value} samples"
        return titles.get(value, str(value)) if name == "surface" else f"{value}²" if name == "size" else str(value)

    return {curve.place: ", ".join(words(i, curve.place[i]) for i in shown) for curve in found}


def _figures(axis: Axis, found: list[Curve], marks: Mapping[str, Mark], titles: Mapping[str, str]) -> Iterator[Figure]:
    """Draw the curves of the first places, PANELS to a figure; `marks` are by variant, `titles` by surface."""
    named = _places(axis, found, titles) if found else {}
    places = list(named)
    for start in range(0, min(len(places), MOST_FIGURES * PANELS), PANELS):
        batch = places[start : start + PANELS]
        yield _figure(axis, [c for c in found if c.place in batch], batch, named, marks, f"{axis.name}-{start}")


def _figure(
    axis: Axis,
    found: list[Curve],
    places: list[tuple[Any, ...]],
    named: Mapping[tuple[Any, ...], str],
    marks: Mapping[str, Mark],
    name: str,
) -> Figure:
    """Draw the curves of these places, a panel for each."""
    every = np.concatenate([curve.x for curve in found])
    many = len({curve.variant for curve in found}) > MOST_LINES
    found = [curve for curve in found if isinstance(curve.fit, Power)] if many else found
    known = {curve.variant for curve in found}
    variants = [variant for variant in marks if variant in known][:MOST_LINES]
    found = [curve for curve in found if curve.variant in variants]
    places = [place for place in places if any(curve.place == place for curve in found)] or places
    columns = min(ACROSS, len(places))
    lines = -(-len(places) // columns)
    labels = {curve.variant: curve.label for curve in found}
    key = Key([line_of(marks[v]) for v in variants], [labels[v] for v in variants], NARROW)
    above = 1.1 * key.height + 0.24
    height = above + 0.4 + 1.45 * lines
    with matplotlib.rc_context(RC | {"font.size": 7.0}):
        drawing = Drawing(figsize=(NARROW, height))
        panels = drawing.subplots(lines, columns, sharex=True, sharey=True, squeeze=False)
        drawing.subplots_adjust(0.62 / NARROW, 0.42 / height, 1 - 0.22 / NARROW, 1 - above / height, 0.06, 0.22)
        for axes, place in zip(panels.flat, places, strict=False):
            axes.set_title(named[place], color=style.INK, fontsize=7)
            for curve in (curve for curve in found if curve.place == place):
                mark = marks[curve.variant]
                axes.plot(curve.x, curve.ms, color=mark.color, marker=mark.marker, **LINE | {"lw": 0})
                if isinstance(curve.fit, Power):
                    ends = np.array([curve.x.min(), curve.x.max()])
                    axes.plot(ends, curve.fit.at(ends), color=mark.color, ls=mark.line, lw=LINE["lw"])
        for axes in list(panels.flat)[len(places) :]:
            axes.axis("off")
        first = panels[0, 0]
        first.set_xscale("log")
        first.set_yscale("log")
        first.set_xlim(every.min() / 1.3, every.max() * 1.3)
        ticks = sorted(set(every))
        first.xaxis.set_major_locator(FixedLocator(_apart(ticks)))
        first.xaxis.set_minor_locator(NullLocator())
        show = (lambda x, _: f"{round(x**0.5)}²") if axis.name == "pixels" else (lambda x, _: f"{x:,.0f}")
        first.xaxis.set_major_formatter(FuncFormatter(show))
        label_decades(first.yaxis)
        drawing.supxlabel(axis.unit, y=0.1 / height, va="center", fontsize=7)
        drawing.supylabel("ms above the floor" if axis.above_floor else "ms", x=0.08 / NARROW, ha="center", fontsize=7)
        key.draw(drawing)
        drawn = svg(drawing)
    exponents = [curve.fit.exponent for curve in found if isinstance(curve.fit, Power)]
    without = len(found) - len(exponents)
    told = f"Exponents from {min(exponents):.2f} to {max(exponents):.2f}" if exponents else "No exponent is determined"
    told = f"One exponent, {exponents[0]:.2f}" if len(exponents) == 1 else told
    told += f", none for {without} of {len(found)} variants and places" if exponents and without else ""
    return Figure(
        name,
        drawn,
        f"Time of {wording.listed(list(labels.values()))} against {axis.unit}, with lines where one fits.",
        f"Time against {axis.unit}.",
        wording.minus(f"{told}.") + (" Only variants with an exponent are drawn." if many else ""),
    )


def _apart(ticks: list[float]) -> list[float]:
    """Keep of the ascending `ticks` those whose labels do not touch the label before, on a logarithmic axis."""
    kept: list[float] = []
    for tick in ticks:
        if not kept or np.log(tick / kept[-1]) > 0.07 * np.log(ticks[-1] / ticks[0]):
            kept.append(tick)
    return kept


def of_run(frame: pd.DataFrame) -> Iterator[tuple[Axis, list[Curve], dict[tuple[Any, ...], str]]]:
    """Yield each axis along which some variant was timed at FEWEST places, its curves, and their places' names."""
    titles = frame.drop_duplicates("surface").set_index("surface")["surface_title"].to_dict()
    for axis in (_of_run(axis, frame) for axis in AXES):
        found = _curves(axis, _points(frame, axis)[0])
        if found:
            yield axis, found, _places(axis, found, titles)
