"""Decide who wins each cell of the leaderboard: a surface on a device in one precision, at each bound on the error."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports.analysis import derive, rounds, surface_names, ties, viewstats
from reports.analysis.choices import ERRORS

LEVELS: tuple[tuple[str, float], ...] = (  # how a bound is written in a page's address, and the bound
    *((f"{error:.0e}".replace("e-0", "e-"), error) for error in ERRORS),
    ("any", math.inf),
)
FULL = 256
RISKY = 0.01  # the largest share of wrong rays, of those judged, of a variant that is named beside a winner


@dataclass(frozen=True, eq=False)
class Won:
    """Hold the answer of one cell at one bound: the winner, what ties with it, and what is faster but answers wrongly.

    `winner` is a row of the race, None where no variant answers every clear ray rightly within the bound. `usable` has
    for each method that does its fastest such row, fastest first.
    """

    winner: Any | None
    tied: tuple[Any, ...]
    faster: Any | None
    usable: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class Race:
    """Hold the timed rows of one scene on one device in one precision, of one run, fastest first; there is one or more.

    `each` has the rows as named tuples, with their speed-up over the site's baseline as `over_baseline`. `won` has the
    answer at each of LEVELS, by name. `untimed` has for each method that entered and of which no variant was timed,
    since all failed, crashed or ran out of time, the row that stands for it. `older` are races of the same scene that
    do not count.
    """

    rows: pd.DataFrame
    each: Sequence[Any]
    won: Mapping[str, Won]
    untimed: Mapping[str, Any]
    older: tuple[Race, ...] = ()

    @property
    def first(self) -> Any:
        """Return one row of the race, for what all of them share."""
        return self.each[0]

    @cached_property
    def methods(self) -> dict[str, Any]:
        """Return the fastest row of each method, by the method, fastest first."""
        found: dict[str, Any] = {}
        for row in self.each:
            found.setdefault(str(row.method), row)
        return found

    @cached_property
    def entered(self) -> dict[str, Any]:
        """Return a row of each method that could be cast there, by the method: those timed, then the others."""
        return {**self.methods, **self.untimed}

    @cached_property
    def counted(self) -> dict[str, Any]:
        """Return what the leaderboard counts, as `_counted` says."""
        return _counted(self)

    @cached_property
    def size(self) -> tuple[int, int]:
        """Return how many methods and how many variants race."""
        return len(self.methods), len({row.variant for row in self.each})


def races(frame: pd.DataFrame) -> list[Race]:
    """Return the races of a frame with the site's columns, in its order.

    Rows race only with rows of their own run, which were timed in turns with them. Of the races of one scene on one
    device that counts which has most methods; of several, that with most variants and then that of the newest run. Of a
    large set of views only the first view is raced, and of a surface in several forms only the printed one.
    """
    raced = surface_names.printed_alone(viewstats.one_view_of_each(frame))
    rows = _over(baseline_of(frame), derive.contenders(raced))
    untimed = _untimed(raced.assign(over_baseline=math.nan))
    grouped: dict[tuple[Any, ...], list[Race]] = {}
    order = {key: i for i, key in enumerate(zip(frame["comparison"], frame["on"], frame["precision"], strict=True))}
    for at, own in rows.groupby(derive.GROUP, sort=False):
        each = list(own.itertuples())
        won = {name: _won(own, each, bound) for name, bound in LEVELS}
        there = {row.method for row in each}
        race = Race(own, each, won, {m: row for m, row in untimed.get(at, {}).items() if m not in there})
        grouped.setdefault((race.first.scene_id, race.first.on, race.first.precision), []).append(race)
    counted = []
    for own_races in grouped.values():
        newest_last = sorted(own_races, key=lambda race: (race.size, str(race.first.created)))
        *older, best = newest_last
        counted.append(replace(best, older=tuple(reversed(older))))
    return sorted(counted, key=lambda race: order[(race.first.comparison, race.first.on, race.first.precision)])


def baseline_of(frame: pd.DataFrame) -> str:
    """Name the method or variant that standings are over: the baseline of most rows, the first of equals."""
    return str(frame["baseline"].value_counts(sort=False).idxmax())


def _over(baseline: str, rows: pd.DataFrame) -> pd.DataFrame:
    """Add `over_baseline`, the speed-up over `baseline`: the row's own, or anew where its run has another baseline."""
    own = rows["baseline"] == baseline
    others = rows[~own].assign(baseline=baseline)
    anew = rounds.over_first(others, derive.baseline_rows(others), derive.GROUP).where(derive.all_right(others))
    return rows.assign(over_baseline=rows["speedup"].where(own, anew.reindex(rows.index)))


def _untimed(frame: pd.DataFrame) -> dict[Any, dict[str, Any]]:
    """Return for each of derive.GROUP, by method, the row that stands for what did not end well there.

    It is the judged row with fewest wrong rays, or the first where none was judged. Skipped rows could not be cast.
    """
    ended = frame["status"].isin([CellStatus.OK, CellStatus.SKIPPED])
    rows = frame[frame["answers"].astype(bool) & ~ended]
    fewest = rows["wrong_rays"].where(derive.is_judged(rows)).astype("float64").sort_values(kind="stable")
    found: dict[Any, dict[str, Any]] = {}
    for row in rows.loc[fewest.index].itertuples():
        found.setdefault((row.comparison, row.device, row.precision), {}).setdefault(str(row.method), row)
    return found


def cells(every: Sequence[Race]) -> list[Race]:
    """Return the race that stands for each surface on each device in each precision on the leaderboard.

    It is that with most methods, then pixels, then variants. Frames of fewer than FULL pixels a side come last, since
    their times are more of a launch than of casting.
    """
    best: dict[tuple[str, str, str], Race] = {}
    for race in every:
        at = (race.first.page, race.first.on, race.first.precision)
        if at not in best or _worth(race) > _worth(best[at]):
            best[at] = race
    return list(best.values())


def _worth(race: Race) -> tuple[bool, int, int, int]:
    methods, variants = race.size
    pixels = int(race.first.size)
    return pixels >= FULL, methods, pixels, variants


def usable(rows: pd.DataFrame, bound: float) -> pd.DataFrame:
    """Select the rows with every clear ray right, and with a largest error over the scene's radius within `bound`."""
    return rows[derive.all_right(rows)] if math.isinf(bound) else derive.within(rows, bound)


def _won(rows: pd.DataFrame, each: Sequence[Any], bound: float) -> Won:
    """Decide one cell at one bound; `rows` are fastest first, and `each` has them as named tuples."""
    good = usable(rows, bound)
    if good.empty:
        return Won(None, (), None, {})
    winner = ties.best(good)
    right = set(good.index)
    by_index = {row.Index: row for row in each if row.Index in right}
    whole = {row.variant: row for row in by_index.values()}
    first = by_index[winner.Index]
    fastest = {row.method: row for row in reversed(whole.values())} | {first.method: first}
    by_time = dict(sorted(fastest.items(), key=lambda pair: pair[1].median_ms))
    tied = tuple(by_index[at] for at in ties.tied(good, winner))
    return Won(first, tied, _faster(each, first), by_time)


def _faster(each: Sequence[Any], winner: Any) -> Any | None:
    """Return the fastest row that answers a few rays wrongly and is told to be faster than the winner; None without."""
    for row in each:
        if pd.isna(row.wrong_rays) or not 0 < row.wrong_rays <= RISKY * row.clear_rays:
            continue
        if row.median_ms < winner.median_ms and ties.is_slower(winner, row):
            return row
    return None


@dataclass(frozen=True)
class Standing:
    """Count what a method does over cells, at one bound.

    won: cells in which it is the fastest, alone; `tied` are those in which it is not told apart from the fastest
    usable: cells in which a variant of it answers every clear ray rightly within the bound, of the `raced` ones, in
        which it was timed or failed, crashed or ran out of time
    speedup: the median of its fastest such variants' speed-ups over `baseline_of`, over the `compared` cells: those in
        which the baseline, too, answers every clear ray rightly; None where there are none
    wrong, rays: clear rays that its fastest variants, right or not, answer wrongly, of those judged; where none was
        timed, those of the judged variant with fewest
    """

    method: str
    won: int
    tied: int
    usable: int
    raced: int
    speedup: float | None
    compared: int
    wrong: int
    rays: int


def standings(of: Sequence[Race], level: str) -> list[Standing]:
    """Count over the cells `of`, at the bound that `level` names; who wins most comes first."""
    at = [name for name, _ in LEVELS].index(level)
    entered = [race.counted for race in of]
    found = []
    for method in dict.fromkeys(m for race in of for m in race.entered):
        entries = [entry[method] for entry in entered if method in entry]
        speedups = sorted(e["v"][at] for e in entries if e["v"][at] is not None and e["v"][at] > 0)
        found.append(
            Standing(
                method,
                sum(e["w"][at] == 2 for e in entries),
                sum(e["w"][at] == 1 for e in entries),
                sum(e["v"][at] is not None for e in entries),
                len(entries),
                _median(speedups),
                len(speedups),
                sum(e["x"] for e in entries),
                sum(e["n"] for e in entries),
            )
        )
    return sorted(found, key=lambda s: (-s.won, -s.tied, -s.usable, s.method))


def _median(ordered: Sequence[float]) -> float | None:
    """Return the median of sorted numbers; None of none."""
    if not ordered:
        return None
    half = len(ordered) // 2
    return ordered[half] if len(ordered) % 2 else (ordered[half - 1] + ordered[half]) / 2


def _counted(race: Race) -> dict[str, Any]:
    """Return what the leaderboard counts of a cell, for the site's script too, by method:

    w: for each level 2 where the method wins alone, 1 where it wins and is not told apart from others, or is one of
        these, else 0; a method that no other entered against wins nothing
    v: for each level the speed-up of its fastest usable variant over the site's baseline, 0 where that is not known;
        null without such a variant
    x, n: wrong rays of its fastest variant or, where none was timed, of that with fewest, and how many were judged
    """
    told: dict[str, Any] = {}
    against = len(race.entered) > 1
    for method, row in race.entered.items():
        wins, speedups = [], []
        for name, _ in LEVELS:
            won = race.won[name]
            first = won.winner is not None and won.winner.method == method
            beside = any(other.method == method for other in won.tied)
            wins.append(against * (2 if first and not won.tied else 1 if first or beside else 0))
            own = won.usable.get(method)
            speedups.append(None if own is None else _rounded(own.over_baseline))
        told[method] = {"w": wins, "v": speedups, "x": int(_zero(row.wrong_rays)), "n": int(_zero(row.clear_rays))}
    return told


def _rounded(value: Any) -> float:
    """Return a speed-up to four digits; 0 where it is not known."""
    return 0.0 if pd.isna(value) else float(f"{value:.4g}")


def _zero(value: Any) -> float:
    return 0.0 if pd.isna(value) else float(value)
