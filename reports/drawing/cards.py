"""Say on a card what a surface is, who wins on it and who is wrong, beside its picture as the winner draws it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from harness.contract import UNIT_ROUNDOFF, CellStatus
from reports import wording
from reports.analysis import choices, derive
from reports.analysis.choices import ERRORS, Choice
from reports.content import Panel, Picture
from reports.drawing import images
from reports.reading.arrays import Arrays, Shelf
from reports.reading.tuples import tuples

NAMED = 4  # methods of one kind that a short card names
SHORT = 110  # characters of a formula on a short card
WHOLE = 320  # and on a long one
SMALL = 256  # pixels of a side of a short card's picture, which is 31 mm wide


def winner(rows: pd.DataFrame, choice: Choice | None) -> Any | None:
    """Return the row of one scene and device that its picture is of, which has arrays; None without any.

    It is that of `choice`; where nothing was timed, or the picture is not stored, the most exact of those with fewest
    wrong rays.
    """
    if choice is not None and not wording.absent(choice.pictured.arrays):
        return next(tuples(rows.loc[[choice.pictured.Index]]))
    drawn = rows[(rows["status"] == CellStatus.OK) & rows["answers"].astype(bool) & rows["arrays"].notna()]
    return next(tuples(drawn.sort_values(["wrong_rays", "error_max"], kind="stable").head(1)), None)


def long_card(rows: pd.DataFrame, choice: Choice | None, shelf: Shelf, told: pd.DataFrame) -> Panel | None:
    """Make the card of a surface's own page; None where the winner has no picture.

    `rows` are those of one scene and device, `choice` is what to take of them, `told` are all rows of the surface.
    """
    row = winner(rows, choice)
    arrays = None if row is None else shelf.get(row)
    if row is None or arrays is None:
        return None
    height, width = arrays.shade.shape
    arrays = arrays.cropped(*images.outline([arrays]))
    notes = [
        *(wrong_methods(rows, len(rows)), hardness(row, arrays)),
        what(told, WHOLE),
        not_here(told),
        f"The picture is of {row.label}'s hits on {width} × {height} rays, smoothly enlarged.",
    ]
    time = "" if wording.absent(row.median_ms) else f" in {wording.number(row.median_ms)} ms"
    picture = Picture(f"{row.key}-hero", images.png(images.hero(arrays)), f"{row.surface_title} drawn by {row.label}")
    return Panel(f"Drawn by {row.label}{time}", (picture,), "\n".join(filter(None, notes)), winners(rows, choice))


def short_card(rows: pd.DataFrame, choice: Choice | None, shelf: Shelf) -> Panel | None:
    """Make the card of a surface in an atlas; None where the winner has no picture.

    `rows` are those of one scene and device.
    """
    drawn = _small_picture(rows, choice, shelf)
    if drawn is None:
        return None
    row, picture = drawn
    notes = (wrong_methods(rows, NAMED), what(rows, SHORT))
    return Panel(str(row.surface_title), (picture,), "\n".join(filter(None, notes)), winners(rows, choice))


def thumbnail(rows: pd.DataFrame, choice: Choice | None, shelf: Shelf) -> Panel | None:
    """Make a picture with the winner's name and time; None where the winner has no picture."""
    drawn = _small_picture(rows, choice, shelf)
    if drawn is None:
        return None
    row, picture = drawn
    time = "" if wording.absent(row.median_ms) else f", {wording.number(row.median_ms)} ms"
    wrong = "" if not row.wrong_rays or wording.absent(row.wrong_rays) else f", {wording.count(row.wrong_rays)} wrong"
    return Panel(str(row.surface_title), (picture,), f"{row.label}{time}{wrong}")


def _small_picture(rows: pd.DataFrame, choice: Choice | None, shelf: Shelf) -> tuple[Any, Picture] | None:
    """Return the winner's row and its picture, SMALL and square; None where the winner has no picture."""
    row = winner(rows, choice)
    arrays = None if row is None else shelf.get(row)
    if row is None or arrays is None:
        return None
    drawn = images.png(images.hero(_square(arrays), SMALL))
    return row, Picture(f"{row.key}-card", drawn, f"{row.surface_title} drawn by {row.label}")


def _square(arrays: Arrays) -> Arrays:
    """Return the arrays without what is empty about the surface, as a square where they are one."""
    down, across = images.outline([arrays])
    side = max(down.stop - down.start, across.stop - across.start)
    made = []
    for kept, length in zip((down, across), arrays.truth.shape, strict=True):
        start = min(max(0, (kept.start + kept.stop - side) // 2), max(0, length - side))
        made.append(slice(start, min(length, start + side)))
    return arrays.cropped(*made)


def winners(rows: pd.DataFrame, choice: Choice | None) -> list[tuple[str, ...]]:
    """Return the lines of a card: the fastest at each of ERRORS, or where nothing was timed the most exact.

    Errors are the largest over the scene's radius, as ERRORS are.
    """
    if choice is not None:
        lines: list[tuple[str, ...]] = [("error ≤", "fastest right", "ms", "error")]
        for error, row in zip(ERRORS, choice.within, strict=True):
            figures = ("none", "", "")
            if row is not None:
                time = wording.number(row.median_ms)
                figures = (choices.written(row, rows), time, wording.error(row.relative_error_max))
            lines.append((wording.level(error), *figures))
        return lines
    right = rows[derive.all_right(rows) & rows["relative_error_max"].notna()]
    right = right.sort_values("relative_error_max", kind="stable").head(3)
    ranked = [
        (f"{i}.", choices.written(row, rows), wording.error(row.relative_error_max))
        for i, row in enumerate(tuples(right), 1)
    ]
    return [("", "most exact, all rays right", "error over radius"), *ranked] if ranked else []


def wrong_methods(rows: pd.DataFrame, most: int) -> str:
    """Name the methods with wrong rays, at most so many, those with most first; say it where there are none."""
    judged = rows[rows["wrong_rays"].notna()]
    if judged.empty:
        return ""
    checked = f"of {wording.count(judged['accuracy_rays'].max())} rays"
    wrong = judged[judged["wrong_rays"] > 0].sort_values("wrong_rays", ascending=False, kind="stable")
    if wrong.empty:
        return f"No method is wrong on any {checked}."
    labels = dict.fromkeys(wrong["label"])
    names = [f"{label}: {_span(wrong.loc[wrong['label'] == label, 'wrong_rays'])}" for label in labels]
    more = f"; {len(names) - most} more" if len(names) > most else ""
    return f"Wrong rays, {checked}: {'; '.join(names[:most])}{more}."


def _span(counts: pd.Series) -> str:
    """Write the least and the most of some counts."""
    return " to ".join(dict.fromkeys((wording.count(counts.min()), wording.count(counts.max()))))


def hardness(row: Any, arrays: Arrays) -> str:
    """Say what is hard about a scene: its worst condition, and how many rays graze the surface or drown."""
    told = []
    if arrays.condition is not None:
        away = arrays.condition[np.isfinite(arrays.condition) & ~arrays.apart]
        radius = row.scene_radius if wording.absent(row.domain_radius) else row.domain_radius
        if away.size and not wording.absent(radius):
            worst = float(away.max())
            cost = max(worst, 1.0) * UNIT_ROUNDOFF[row.precision] * radius
            told.append(
                f"away from silhouettes the condition of a root reaches {wording.short(worst)}, with which rounding "
                f"alone may cost {row.precision} an error of {wording.error(cost)}"
            )
    counts = ((row.grazing, "graze the surface"), (row.drowned, "drown in rounding"))
    rays = [f"{wording.count(n)} {what}" for n, what in counts if not wording.absent(n) and n > 0]
    if rays:
        told.append(f"of {wording.count(row.accuracy_rays)} rays {wording.listed(rays)}")
    return f"What is hard: {'; '.join(told)}." if told else ""


def what(rows: pd.DataFrame, letters: int) -> str:
    """Write degree and formula, at most so many letters of it, the domain, and what the domain leaves out."""
    first = rows.iloc[0]
    degree = "Not algebraic" if wording.absent(first["degree"]) else f"Degree {first['degree']}"
    formula = "" if wording.absent(first["formula"]) else f": {wording.excerpt(first['formula'], letters)} = 0"
    domain = "" if wording.absent(first.get("domain")) else f", in {_domain(first['domain'])}"
    told = rows["extent"].dropna().unique() if "extent" in rows else ()
    return " ".join([f"{degree}{formula}{domain}.", *(f"Note: {sentence}." for sentence in told)])


def _domain(text: str) -> str:
    """Write a domain, as in `sphere:1.5`, in words."""
    kind, _, rest = text.partition(":")
    centre, _, size = rest.rpartition(":")
    about = f" about ({centre})" if centre else ""
    if kind == "sphere":
        return f"a ball of radius {size}{about}"
    return f"a box of half extents {size.replace(',', ', ')}{about}" if kind == "box" else text


def not_here(rows: pd.DataFrame) -> str:
    """Name the variants of which no row of the surface has a result; "" without any."""
    finished = set(rows.loc[rows["status"] == CellStatus.OK, "variant"])
    missing: Sequence[str] = list(dict.fromkeys(rows.loc[~rows["variant"].isin(finished), "label"]))
    return f"Without a result here: {wording.listed(missing)}." if missing else ""
