"""Hold what pages are made from, and write what several of them show: winners, rows, and how to run them again."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import PurePath
from typing import Any

import pandas as pd

from harness.escaping import shell
from reports import labels, wording
from reports.analysis import rounds
from reports.drawing.style import Mark
from reports.site.gather import Gathered, Part
from reports.site.markup import Frame, Head, Html, Line, code, join, link, table, tag
from reports.site.pictures import Pair, anchor
from reports.site.scatter import Point, chip, scatter
from reports.site.standings import LEVELS, Race, Won, baseline_of

BOUNDS = {  # how people write the levels
    name: "any error" if math.isinf(bound) else f"error ≤ {wording.power_of_ten(round(math.log10(bound)))}"
    for name, bound in LEVELS
}
RADIUS = "of the scene's radius"


@dataclass(frozen=True, eq=False)
class Site:
    """Hold what pages are made from.

    races: all that count; `cells` are those of the leaderboard
    marks: how each method is drawn
    pages: the name of each method's page
    pictures: those of rows, by run and key; `scale` has the decades of errors that their colours span
    contact: whom one sends a run to, as text or as an address; "" where the site does not say
    """

    frame: Frame
    data: Gathered
    races: Sequence[Race]
    cells: Sequence[Race]
    marks: Mapping[str, Mark]
    pages: Mapping[str, str]
    pictures: Mapping[tuple[str, str], Pair]
    scale: tuple[int, int]
    contact: str

    def label(self, name: str) -> str:
        """Return how people write a method's name."""
        return labels.method_label(name, self.data.methods)

    def method(self, name: str, up: str) -> Html:
        """Write a method's mark, and its name as a link to its page; `up` leads to the site's folder."""
        return join(chip(self.marks[name]), link(f"{up}methods/{self.pages[name]}.html", self.label(name)))

    def baseline(self, rows: pd.DataFrame) -> str:
        """Name the method or variant that the speed-ups of these rows are over; several are joined by "or"."""
        return " or ".join(dict.fromkeys(self._named(str(name)) for name in dict.fromkeys(rows["baseline"])))

    @cached_property
    def overall(self) -> str:
        """Name the method or variant that the medians of speed-ups are over, in all runs."""
        return self._named(baseline_of(self.data.frame))

    def _named(self, name: str) -> str:
        """Return how people write a method or a variant."""
        return self.label(name) if name in self.pages else self._variants.get(name, name)

    @cached_property
    def _variants(self) -> dict[str, str]:
        """Return the label of each variant."""
        return dict(zip(self.data.frame["variant"], self.data.frame["label"], strict=True))

    @cached_property
    def several_precisions(self) -> bool:
        """Tell whether devices are named with a precision."""
        return len({race.first.precision for race in self.cells}) > 1

    def place(self, row: Any) -> str:
        """Write the device of a row, and its precision where there are several."""
        return f"{row.on}, {row.precision}" if self.several_precisions else str(row.on)


def row_link(row: Any, up: str, text: object = None) -> Html:
    """Write a variant as a link to its row on its surface's page."""
    return link(f"{up}surfaces/{row.page}.html#{anchor(row)}", row.label if text is None else text)


def unsteady(row: Any) -> list[str]:
    """Return what is unsteady about a row's times, a sentence each, which begins with a word for it and a colon."""
    return [] if wording.absent(row.warnings) else [str(text) for text in json.loads(row.warnings)]


def _caution(row: Any) -> str:
    """Write in brackets, with a space before it, that a row's times are noisy or drift; "" where they are steady."""
    words = dict.fromkeys(text.partition(":")[0] for text in unsteady(row))
    return f" ({', '.join(words)})" if words else ""


def speed(row: Any, speedup: Any) -> str:
    """Write a row's time, whether it is unsteady and, where it is known, its speed-up."""
    over = "" if wording.absent(speedup) else f", {wording.factor(speedup)}"
    return f"{wording.number(row.median_ms)} ms{_caution(row)}{over}"


def milliseconds(row: Any) -> Html | str:
    """Write a row's time as a cell of a table; where it is unsteady, that is told, and what to do under the pointer."""
    told = f"{wording.number(row.median_ms)}{_caution(row)}"
    return tag("span", told, title=" ".join(unsteady(row))) if unsteady(row) else told


def risk(won: Won) -> str:
    """Write what is faster than the winner and answers wrongly; "" where nothing is."""
    if won.faster is None or won.winner is None:
        return ""
    times = rounds.times_over(won.winner, won.faster)
    by = "faster" if wording.absent(times) else f"{wording.factor(times)} faster"  # they may share no round
    rays = f"{wording.count(won.faster.wrong_rays)} of {wording.count(won.faster.clear_rays)} rays wrong"
    return f"{won.faster.label}: {by}, {rays}"


ROW_HEADS = (
    Head("variant"),
    Head("ms", True, "median time of one frame"),
    Head("speed-up", True, "the baseline's time over this one's, in the rounds that timed both; of right answers only"),
    Head("largest error", True, f"of |t − t*| over clear rays, {RADIUS}"),
    Head("99 % of errors", True, f"99th percentile of |t − t*|, {RADIUS}"),
    Head("wrong rays", True, "clear rays answered wrongly, of whatever kind"),
    Head("Mrays/s", True, "millions of rays a second, by the median time"),
    Head("evaluations", True, "of f, for each ray cast, in the mean"),
)


def rows_table(site: Site, caption: object, rows: pd.DataFrame) -> Html:
    """Write the rows of a race, fastest first."""
    lines = []
    for row in rows.itertuples():
        name = join(chip(site.marks[row.method]), tag("span", row.label, title=row.variant))
        told = (
            milliseconds(row),
            wording.factor(row.speedup),
            wording.error(row.relative_error_max),
            wording.error(row.relative_error_p99),
            wording.count(row.wrong_rays),
            wording.number(row.mrays_per_s),
            wording.number(row.evaluations_mean),
        )
        kind = None if wording.absent(row.wrong_rays) or row.wrong_rays == 0 else "wrong"
        lines.append(Line((name, *told), anchor(row), kind))
    return table(caption, ROW_HEADS, lines)


def error_plot(site: Site, rows: pd.DataFrame, what: str) -> Html:
    """Draw the times of a race's rows against their largest errors."""
    points = [
        Point(
            row.median_ms,
            row.relative_error_max,
            site.marks[row.method],
            row.label,
            f"{row.label}: {speed(row, row.speedup)}, largest error {wording.error(row.relative_error_max)} {RADIUS}, "
            f"{wording.count(row.wrong_rays)} wrong rays",
            f"#{anchor(row)}",
            bool(row.wrong_rays > 0),
        )
        for row in rows[rows["relative_error_max"].notna() & rows["wrong_rays"].notna()].itertuples()
    ]
    drawn = scatter(points, "ms a frame", f"largest error, {RADIUS}", f"Time against error of each variant: {what}")
    return plot(drawn, "Fast is left, exact is low. A hollow mark answers some rays wrongly.")


def plot(drawn: Html, caption: object) -> Html:
    """Frame a drawing with its caption; "" where nothing is drawn."""
    return tag("figure", drawn, tag("figcaption", caption), class_="plot") if drawn else Html("")


def reproduce(part: Part, device: str) -> Html:
    """Write the commands that make the rows of a run on a device again."""
    return code("\n".join(commands(part, device)))


def commands(part: Part, device: str = "") -> list[str]:
    """Return the commands that make a run again, on one device or on all of its config."""
    config = part.plan.config
    own, _, machine = device.partition("@") if part.plan.merged else (device, "", "")  # lab2, of opencl:nvidia@lab2
    of = [run for run in part.plan.merged if run["machine"] == machine] or part.plan.merged or [part.plan.environment]
    lines = [f"git checkout {of[0]['commit']}"] if of[0].get("commit") else []
    if PurePath(config).is_absolute():
        config = PurePath(config).name
        lines.append(f"# save the config, which is on the page of this run, as {config}")
    outside = sorted({str(told["outside"]) for told in part.plan.methods.values() if told.get("outside")})
    plugins = ["--plugins", str(PurePath(outside[0]).parent)] if outside else []
    on = ["--device", own] if own else []
    return [*lines, "make .venv/ready", shell([".venv/bin/firsthit", "run", config, *plugins, *on])]
