"""What a claim is, and the judgements that many claims share."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import pandas as pd

from reports import wording
from reports.claims.evidence import Evidence, Pick


class Outcome(StrEnum):
    CONFIRMED = "confirmed"
    REFUTED = "refuted"
    UNDECIDED = "not decided"  # the rows are there, but a figure is missing or no test tells
    UNTESTED = "not testable here"


@dataclass(frozen=True)
class Verdict:
    outcome: Outcome
    figure: str  # what was measured, in words and numbers


@dataclass(frozen=True)
class Claim:
    """`decide` returns None where the rows it needs are missing."""

    paper: str  # as the papers are cited: toledo2007, szente, beamcasting
    section: str
    text: str  # the claim, in our words
    evidence: str  # what decides it
    decide: Callable[[Evidence], Verdict | None]
    methods: tuple[str, ...] = ()  # whose cards show it
    config: str = ""  # the config whose rows decide it
    reason: str = ""  # why no config here decides it, where none does


def judge(claim: Claim, evidence: Evidence) -> Verdict:
    """The verdict on one claim, by the rows of its own config where they are there; else what is missing is said.

    Pairs of rows that were left out, since they were not timed in turns, are counted in the figure.
    """
    own = evidence.of(claim.config)
    own.apart.clear()
    verdict = claim.decide(own)
    apart = f"{wording.plural(len(own.apart), 'pair')} of rows not timed in the same rounds" if own.apart else ""
    if verdict is not None:
        figure = f"{verdict.figure}; left out: {apart}" if apart else verdict.figure
        return replace(verdict, figure=f"{figure} ({own.note})" if own.note else figure)
    if apart:
        return Verdict(Outcome.UNTESTED, f"{apart}; `firsthit run configs/{claim.config} --force` times them in turns")
    return Verdict(Outcome.UNTESTED, claim.reason or f"this run has no rows for it; configs/{claim.config} gives them")


def untestable(_: Evidence) -> Verdict | None:
    return None


def verdict(confirmed: bool | None, figure: str) -> Verdict:
    """Make a verdict; `confirmed` None is not decided."""
    if confirmed is None:
        return Verdict(Outcome.UNDECIDED, figure)
    return Verdict(Outcome.CONFIRMED if confirmed else Outcome.REFUTED, figure)


def both(*held: bool | None) -> bool | None:
    """Whether all hold: one that does not refutes; else one that is not decided leaves the whole so, as none does."""
    if any(one is False for one in held):
        return False
    return True if held and all(one is True for one in held) else None


def at_least(low: float, high: float, limit: float) -> bool | None:
    """Whether what lies between `low` and `high` is at least `limit`; None where they enclose it or one is missing."""
    return True if low >= limit else False if high < limit else None


def mean_ratio(ratios: pd.DataFrame, limit: float) -> bool | None:
    """Whether the mean of these ratios of times is at least `limit`, by the means of their intervals' ends."""
    low, high = (float(ratios[name].mean(skipna=False)) for name in ("ratio_low", "ratio_high"))
    return at_least(low, high, limit)


def each_mean(readings: list[pd.DataFrame], limit: float) -> bool | None:
    """Tell whether `mean_ratio` holds for every reading of one comparison; None where readings disagree.

    Readings without rows do not count.
    """
    held = {mean_ratio(ratios, limit) for ratios in readings if len(ratios)}
    return held.pop() if len(held) == 1 else None


def known(value: Any, test: Callable[[Any], bool]) -> bool | None:
    """Whether an exact figure passes; None where it is missing."""
    return None if pd.isna(value) else bool(test(value))


def every(values: Any, test: Callable[[Any], bool]) -> bool | None:
    """Whether each of these exact figures passes; None where one is missing or there is none."""
    return both(*(known(value, test) for value in values))


def counted(rows: pd.DataFrame, *names: str) -> int | None:
    """The sum of these counts over all rows; None where one is missing or there is no row."""
    cells = rows[list(names)]
    return None if rows.empty or cells.isna().any(axis=None) else int(cells.sum().sum())


def largest(rows: pd.DataFrame, name: str) -> float:
    """NaN where one is missing or there is no row."""
    return float(rows[name].astype("float64").max(skipna=False)) if len(rows) else math.nan


def cases(rows: pd.DataFrame) -> str:
    """Say what these rows are of: 6 views in float32 on opencl:intel."""
    return f"{wording.plural(int(rows['view'].nunique()), 'view')} {where(rows)}"


def rays(rows: pd.DataFrame) -> str:
    """Say how many rays a count over these rows is out of: 147,456 rays (16,384 in each of 9 rows: 3 surfaces in …).

    Rows of one view that differ in device, size or variant are of the same rays.
    """
    each = f"{count(int(rows['accuracy_rays'].iloc[0]))} in each of " if rows["accuracy_rays"].nunique() == 1 else ""
    surfaces = wording.plural(int(rows["surface"].nunique()), "surface")
    total = count(counted(rows, "accuracy_rays"))
    return f"{total} rays ({each}{wording.plural(len(rows), 'row')}: {surfaces} {where(rows)})"


def where(rows: pd.DataFrame) -> str:
    """Name the precisions and the devices of these rows."""
    precisions, devices = (list(dict.fromkeys(rows[name])) for name in ("precision", "device"))
    each = "each of " if len(devices) > 1 else ""
    return f"in {wording.listed(precisions)} on {each}{wording.listed(devices)}"


def count(value: int | None) -> str:
    return wording.NONE if value is None else f"{value:,}"


def quantities(values: Any, show: Callable[[Any], str] = wording.factor) -> str:
    """Mean and range, of several; the value itself, of one."""
    series = pd.Series(values, dtype="float64")
    if len(series) == 1:
        return show(series.iloc[0])
    return f"{show(series.mean())} in the mean ({show(series.min())} to {show(series.max())}, {len(series)} cases)"


def faster(slow: Pick, fast: Pick, surfaces: tuple[str, ...] | None = None, told: str = "") -> Any:
    """A judge of "`fast` is always faster than `slow`": confirmed where it is in every case, beyond both intervals;
    refuted by one the other way, or where it is not faster in the mean."""

    def decide(evidence: Evidence) -> Verdict | None:
        ratios = evidence.ratios(slow, fast, surfaces)
        if ratios.empty:
            return None
        figure = f"{fast.words} is {quantities(ratios['ratio'])} as fast as {slow.words} {where(ratios)}"
        figure += lost(ratios) + (f"; the paper: {told}" if told else "")
        return verdict(always(ratios), figure + _answered_wrongly(evidence, (fast, slow), ratios, surfaces))

    return decide


def _answered_wrongly(
    evidence: Evidence, picked: tuple[Pick, ...], ratios: pd.DataFrame, surfaces: tuple[str, ...] | None
) -> str:
    """Say how many rays away from silhouettes each of `picked` answers wrongly where its times are compared; "" where
    all answer rightly."""
    told, any_wrong = [], False
    for pick in picked:
        rows = evidence.rows(pick, surfaces)
        rows = rows[rows["comparison"].isin(ratios["comparison"])]
        bad, of = counted(rows, "wrong_rays"), counted(rows, "accuracy_rays")
        any_wrong = any_wrong or bad != 0
        told.append(f"{pick.words} {count(bad)} of {count(of)}")
    return f"; wrong rays: {', '.join(told)}" if any_wrong else ""


def always(ratios: pd.DataFrame) -> bool | None:
    """Whether every ratio of times is above 1 beyond its interval; refuted by one below it, or by their mean."""
    if (ratios["ratio_high"] < 1.0).any() or mean_ratio(ratios, 1.0) is False:
        return False
    return True if len(ratios) and (ratios["ratio_low"] > 1.0).all() else None


def lost(ratios: pd.DataFrame) -> str:
    """Say in how many cases it is the other way round, and in how many the intervals do not tell."""
    slower, faster = int((ratios["ratio_high"] < 1.0).sum()), int((ratios["ratio_low"] > 1.0).sum())
    told = f"; slower in {slower} of {len(ratios)}" if slower else ""
    even = len(ratios) - slower - faster
    return told + (f"; not told apart in {even} of {len(ratios)}" if even else "")


def wrong(rows: pd.DataFrame, grazing: bool = False) -> pd.Series:
    """Wrong rays of each row; with `grazing` those at silhouettes and drowned ones too."""
    names = ["wrong_rays", *(["grazing_wrong_rays", "drowned_wrong_rays"] if grazing else [])]
    return rows[names].astype("float64").sum(axis=1, skipna=False)
