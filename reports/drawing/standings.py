"""Make matrices of methods by surfaces: how long each takes over the winner, or over the method of a focus."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import choices, derive, rounds, ties
from reports.analysis.choices import Choice
from reports.content import Matrix, Square
from reports.drawing import style
from reports.drawing.shades import GOOD, WRONG
from reports.reading.tuples import tuples

MOST = 8  # surfaces that are columns of a page
BEST, FASTER, SLOWER, ALIKE = GOOD, GOOD, "#f0a45d", "#e6e6e6"
_SPAN = 1.5  # decades of a ratio over which a colour fades


def matrix(found: Sequence[Choice], focus: str = "") -> Matrix:
    """Make a line for each method and a square for each surface: its time over the winner's, or its wrong rays.

    `focus` is the method whose line is bold. `found` has at least one choice.
    """
    methods = _methods(found)
    body = []
    for method, label in methods.items():
        squares = tuple(_against_best(one, method) for one in found)
        if method == focus:
            squares = tuple(Square(s.text, s.color, s.note, strong=True) for s in squares)
        body.append((label, squares))
    body.sort(key=lambda line: [-sum(_rank(square) >= least for square in line[1]) for least in (2, 1)])
    return Matrix(
        tuple(one.name for one in found),
        body,
        f"Every method on every surface, on {found[0].rows['device'].iloc[0]}.",
        "The winner's time, and how many times as long each other method takes with its fastest right setting, within "
        f"{wording.level(choices.ERRORS[0])} of the radius if it has one. Paler is slower. A method with wrong rays "
        "shows how many, with the time of the setting that has fewest. – does not apply or was not timed.",
        "method",
        {BEST: "fastest with no wrong ray", WRONG: "some rays wrong"},
    )


def _rank(square: Square) -> int:
    """Return 2 for a square of the fastest, 1 for another that is right, 0 for the rest."""
    return 2 if square.color == BEST else int(square.color != WRONG and square.text != wording.NONE)


def _methods(found: Sequence[Choice]) -> dict[str, str]:
    """Return the label of each method, by name, in the plan's order."""
    rows = pd.concat([one.rows for one in found]).sort_index()
    return dict(zip(rows["method"], rows["method_label"], strict=True))


def _against_best(one: Choice, method: str) -> Square:
    """Make the square of one method on one surface."""
    best = one.best
    row = best if best is not None and best.method == method else taken(one, method)
    if row is None:
        return Square(wording.NONE, note="does not apply or was not timed")
    if best is not None and row.Index == best.Index:
        return Square(f"{wording.number(row.median_ms)} ms", BEST, noted(one, row), strong=True)
    times = math.nan if best is None else rounds.times_over(row, best)
    text = f"{wording.number(row.median_ms)} ms" if math.isnan(times) else wording.factor(times)
    if row.wrong_rays != 0:
        return Square(f"{text}, {wording.count(row.wrong_rays)} wrong", WRONG, noted(one, row))
    if best is not None and ties.is_slower(best, row):  # it is no winner, since its error is too large
        return Square(f"{text}, error {wording.error(row.relative_error_max)}", "", noted(one, row))
    if best is not None and not ties.is_slower(row, best):
        return Square(f"≈ {text}", BEST, f"{noted(one, row)}; not told apart from the winner")
    return Square(text, _faded(BEST, times), noted(one, row))


def taken(one: Choice, method: str) -> Any:
    """Return the row that stands for a method or variant: its fastest that is right, else that with fewest wrong rays.

    Of right rows those within the looser of ERRORS come first. None where it has no row whose answers were checked.
    """
    own = one.rows[((one.rows["method"] == method) | (one.rows["variant"] == method)) & one.rows["wrong_rays"].notna()]
    exact = derive.within(own, choices.ERRORS[0])
    right = exact if len(exact) else own[derive.all_right(own)]
    if len(right):
        return next(tuples(right.loc[[ties.best(right).Index]]))
    return next(tuples(own.sort_values("wrong_rays", kind="stable")), None)


def noted(one: Choice, row: Any) -> str:
    """Write what a reader who asks is told of a row."""
    told = f"{choices.written(row, one.rows)} on {one.name}: {wording.number(row.median_ms)} ms, largest error "
    told += f"{wording.error(row.relative_error_max)} of the radius, {wording.count(row.wrong_rays)} wrong rays of "
    return told + wording.count(row.accuracy_rays)


def _faded(color: str, times: float) -> str:
    """Return a colour that is paler the more `times` is from 1."""
    if not times > 0 or math.isinf(times):
        return ""
    return style.pale(color, min(0.94, 0.35 + 0.6 * abs(math.log10(times)) / _SPAN))


def against(found: Sequence[Choice], focus: str, methods: Sequence[str]) -> Matrix:
    """Make a line for each surface and a square for each of `methods`: its time over that of the focus.

    `focus` is a method or variant that one of the choices has a row of.
    """
    labels = _methods(found)
    body = []
    for one in found:
        own = taken(one, focus)
        heading = one.name if own is None or own.wrong_rays == 0 else f"{one.name} ({int(own.wrong_rays):,} wrong)"
        body.append((heading, tuple(_against_focus(one, own, method) for method in methods)))
    return Matrix(
        tuple(labels[method] for method in methods),
        body,
        "Times of the others over its own.",
        "Above 1× it is faster than the other method; ≈ stands where the times are not told apart. “Wrong” counts the "
        "other's wrong rays: a time that is bought with them is no win. Its own wrong rays stand beside the surface, "
        "whose line has no colours then. – the other does not apply or was not timed.",
        "surface",
        {FASTER: "it is faster", ALIKE: "not told apart", SLOWER: "the other is faster", WRONG: "the other is wrong"},
    )


def _against_focus(one: Choice, own: Any, method: str) -> Square:
    """Make the square of one other method on one surface; `own` is the row of the focus."""
    row = taken(one, method)
    if row is None or own is None:
        return Square(wording.NONE, note="one of the two does not apply or was not timed")
    times = rounds.times_over(row, own)
    text = f"{wording.number(row.median_ms)} ms" if math.isnan(times) else wording.factor(times)
    if row.wrong_rays != 0:
        return Square(f"{text}\n{wording.count(row.wrong_rays)} wrong", WRONG, noted(one, row))
    if own.wrong_rays != 0:
        return Square(text, "", f"{noted(one, row)}; its own time is bought with wrong rays")
    if ties.is_slower(row, own):
        return Square(text, _strength(FASTER, times), noted(one, row))
    if ties.is_slower(own, row):
        return Square(text, _strength(SLOWER, times), noted(one, row))
    return Square(f"≈ {text}", ALIKE, noted(one, row))


def _strength(color: str, times: float) -> str:
    """Return a colour that is stronger the more `times` is from 1."""
    if not times > 0 or math.isinf(times):
        return color
    return style.pale(color, max(0.0, 0.6 * (1 - abs(math.log10(times)))))
