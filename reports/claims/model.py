"""Define claims and verdicts, and the judgements that many claims share."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import pandas as pd

from reports import wording
from reports.claims.evidence import Evidence, Pick


class Outcome(StrEnum):
    """Name the outcomes of a claim in a run; reports print the values."""

    CONFIRMED = "confirmed"
    REFUTED = "refuted"
    UNDECIDED = "not decided"  # the rows are there, but a figure is missing or no test decides
    UNTESTED = "not testable here"


@dataclass(frozen=True)
class Verdict:
    """Hold the outcome of a claim, and the figures that decide it."""

    outcome: Outcome
    figure: str  # what was measured, in words and numbers


Judge = Callable[[Evidence], Verdict | None]  # None where the rows that it needs are missing


@dataclass(frozen=True)
class Claim:
    """Hold a claim of a paper, and what decides it."""

    paper: str  # as the papers are cited: toledo2007, szente, beamcasting
    section: str
    text: str  # the claim, in our words
    evidence: str  # what decides it
    decide: Judge
    methods: tuple[str, ...] = ()  # the methods whose cards show the claim
    config: str = ""  # the config whose rows decide it
    reason: str = ""  # why no config here decides it, if none does


def judge(claim: Claim, evidence: Evidence) -> Verdict:
    """Return the verdict on one claim, by the rows of its own config if the run has them, else by all rows.

    Where rows are missing, the verdict says which config makes them. Pairs of rows that were not timed in the same
    rounds are left out; the figure says how many.
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
    """Return None, which stands for "no verdict", since nothing here can decide the claim."""
    return None


def verdict(confirmed: bool | None, figure: str) -> Verdict:
    """Make a verdict: confirmed, refuted, or not decided where `confirmed` is None."""
    if confirmed is None:
        return Verdict(Outcome.UNDECIDED, figure)
    return Verdict(Outcome.CONFIRMED if confirmed else Outcome.REFUTED, figure)


def both(*held: bool | None) -> bool | None:
    """Tell whether all of `held` are True: False if any is False; else None if any is None or none is given."""
    if any(one is False for one in held):
        return False
    return True if held and all(one is True for one in held) else None


def at_least(low: float, high: float, limit: float) -> bool | None:
    """Tell whether a value that lies between `low` and `high` is at least `limit`.

    True where `low` is at least `limit`, False where `high` is below it, else None. An end that is NaN decides nothing.
    """
    return True if low >= limit else False if high < limit else None


def mean_ratio(ratios: pd.DataFrame, limit: float) -> bool | None:
    """Tell whether the mean of ratios of times is at least `limit`.

    It is judged by the mean of the intervals' lower ends and that of their upper ends; None where these do not decide.
    """
    low, high = (float(ratios[name].mean(skipna=False)) for name in ("ratio_low", "ratio_high"))
    return at_least(low, high, limit)


def each_mean(readings: list[pd.DataFrame], limit: float) -> bool | None:
    """Tell whether the mean ratio is at least `limit` in every reading of one comparison; None where they disagree.

    Readings without rows do not count; None where no reading has rows.
    """
    held = {mean_ratio(ratios, limit) for ratios in readings if len(ratios)}
    return held.pop() if len(held) == 1 else None


def known(value: float | None, test: Callable[[float], bool]) -> bool | None:
    """Tell whether an exact figure passes `test`; None where the figure is missing."""
    return None if value is None or pd.isna(value) else bool(test(value))


def every(values: Iterable[float], test: Callable[[float], bool]) -> bool | None:
    """Tell whether each exact figure passes `test`; None where one is missing or there is none."""
    return both(*(known(value, test) for value in values))


def counted(rows: pd.DataFrame, *names: str) -> int | None:
    """Return the sum of these columns over all rows; None where a count is missing or there is no row."""
    cells = rows[list(names)]
    return None if rows.empty or cells.isna().any(axis=None) else int(cells.sum().sum())


def largest(rows: pd.DataFrame, name: str) -> float:
    """Return the largest value of a column; NaN where a value is missing or there is no row."""
    return float(rows[name].astype("float64").max(skipna=False)) if len(rows) else math.nan


def cases(rows: pd.DataFrame) -> str:
    """Write what these rows are of: 6 views in float32 on opencl:intel."""
    return f"{wording.plural(int(rows['view'].nunique()), 'view')} {where(rows)}"


def rays(rows: pd.DataFrame) -> str:
    """Write how many rays a count over these rows is out of: 147,456 rays (16,384 in each of 9 rows: 3 surfaces in …).

    Rows of one view that differ in device, size or variant check the same rays, which count once for each row.
    """
    each = f"{count(int(rows['accuracy_rays'].iloc[0]))} in each of " if rows["accuracy_rays"].nunique() == 1 else ""
    surfaces = wording.plural(int(rows["surface"].nunique()), "surface")
    total = count(counted(rows, "accuracy_rays"))
    return f"{total} rays ({each}{wording.plural(len(rows), 'row')}: {surfaces} {where(rows)})"


def where(rows: pd.DataFrame) -> str:
    """Write the precisions and the devices of these rows: in float32 on opencl:intel."""
    precisions, devices = (list(dict.fromkeys(rows[name])) for name in ("precision", "device"))
    each = "each of " if len(devices) > 1 else ""
    return f"in {wording.listed(precisions)} on {each}{wording.listed(devices)}"


def count(value: int | None) -> str:
    """Write a count, or a dash for None."""
    return wording.NONE if value is None else f"{value:,}"


def quantities(values: Iterable[float], show: Callable[[Any], str] = wording.factor) -> str:
    """Write the mean and the range of several values, or the one value."""
    series = pd.Series(values, dtype="float64")
    if len(series) == 1:
        return show(series.iloc[0])
    return f"{show(series.mean())} in the mean ({show(series.min())} to {show(series.max())}, {len(series)} cases)"


def faster(slow: Pick, fast: Pick, surfaces: tuple[str, ...] | None = None, told: str = "") -> Judge:
    """Make a judge of "`fast` is always faster than `slow`".

    Confirmed where it is faster in every case, by the whole interval of the ratio; refuted by one case the other way,
    or where it is not faster in the mean. `told` is what the paper prints.
    """

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
    """Say how many rays away from silhouettes each pick answers wrongly where its times are compared.

    Returns "" where all answer rightly.
    """
    told, any_wrong = [], False
    for pick in picked:
        rows = evidence.rows(pick, surfaces)
        rows = rows[rows["comparison"].isin(ratios["comparison"])]
        bad, of = counted(rows, "wrong_rays"), counted(rows, "accuracy_rays")
        any_wrong = any_wrong or bad != 0
        told.append(f"{pick.words} {count(bad)} of {count(of)}")
    return f"; wrong rays: {', '.join(told)}" if any_wrong else ""


def always(ratios: pd.DataFrame) -> bool | None:
    """Tell whether the whole interval of every ratio of times is above 1.

    False where the whole interval of one is below 1, or that of the mean; None where neither is so.
    """
    if (ratios["ratio_high"] < 1.0).any() or mean_ratio(ratios, 1.0) is False:
        return False
    return True if len(ratios) and (ratios["ratio_low"] > 1.0).all() else None


def lost(ratios: pd.DataFrame) -> str:
    """Say in how many cases the ratio is below 1, and in how many its interval does not decide; "" for none."""
    slower, faster = int((ratios["ratio_high"] < 1.0).sum()), int((ratios["ratio_low"] > 1.0).sum())
    told = f"; slower in {slower} of {len(ratios)}" if slower else ""
    even = len(ratios) - slower - faster
    return told + (f"; not told apart in {even} of {len(ratios)}" if even else "")


def beside(printed: Judge, ours: Judge, whose: str) -> Judge:
    """Make a judge that decides by `printed` alone; its figure ends with the figure and the outcome of `ours`.

    `printed` judges a method as its paper prints it, `ours` the same method at our best; `whose` names the change.
    """

    def decide(evidence: Evidence) -> Verdict | None:
        found, other = printed(evidence), ours(evidence)
        if found is None or other is None:
            return found
        return replace(found, figure=f"{found.figure}. Ours at its best, {whose}: {other.figure} ({other.outcome})")

    return decide
