"""What a claim is, and the judgements that many claims share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import pandas as pd

from reports import wording
from reports.evidence import Evidence, Pick


class Outcome(StrEnum):
    CONFIRMED = "confirmed"
    REFUTED = "refuted"
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
    """The verdict on one claim, by the rows of its own config where they are there; else what is missing is said."""
    verdict = claim.decide(evidence.of(claim.config))
    if verdict is not None:
        return verdict
    return Verdict(Outcome.UNTESTED, claim.reason or f"this run has no rows for it; configs/{claim.config} gives them")


def untestable(_: Evidence) -> Verdict | None:
    return None


def verdict(confirmed: bool, figure: str) -> Verdict:
    return Verdict(Outcome.CONFIRMED if confirmed else Outcome.REFUTED, figure)


def quantities(values: Any, show: Callable[[Any], str] = wording.factor) -> str:
    """Mean and range, of several; the value itself, of one."""
    series = pd.Series(values, dtype="float64")
    if len(series) == 1:
        return show(series.iloc[0])
    return f"{show(series.mean())} in the mean ({show(series.min())} to {show(series.max())}, {len(series)} cases)"


def faster(slow: Pick, fast: Pick, surfaces: tuple[str, ...] | None = None, told: str = "") -> Any:
    """A judge of "`fast` is always faster than `slow`": refuted by a case the other way, beyond both intervals, or
    where it is not faster in the mean."""

    def decide(evidence: Evidence) -> Verdict | None:
        ratios = evidence.ratios(slow, fast, surfaces)
        if ratios.empty:
            return None
        against = ratios[ratios["ratio_high"] < 1.0]
        figure = f"{fast.words} is {quantities(ratios['ratio'])} as fast as {slow.words}"
        if len(against):
            figure += f"; slower in {len(against)} of {len(ratios)}"
        return verdict(
            against.empty and ratios["ratio"].mean() > 1.0, figure + (f"; the paper: {told}" if told else "")
        )

    return decide


def wrong(rows: pd.DataFrame, grazing: bool = False) -> pd.Series:
    """Wrong rays of each row; with `grazing` those at silhouettes and drowned ones too."""
    names = ["wrong_rays", *(["grazing_wrong_rays", "drowned_wrong_rays"] if grazing else [])]
    return rows[names].astype("float64").sum(axis=1, skipna=False)
