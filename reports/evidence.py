"""What claims and reproductions are decided by: rows picked by method and knobs, and ratios of times taken in turns."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from harness import measure
from harness.contract import CellStatus
from reports import derive, rounds
from reports.arrays import Arrays, Shelf


@dataclass(frozen=True)
class Pick:
    """A method with some of its knobs at stated values; `words` name it in texts."""

    words: str
    method: str
    knobs: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Evidence:
    """All that a run holds, for those who judge by it. Only cells that ended well count."""

    frame: pd.DataFrame  # with the columns of derive
    studies: Mapping[str, list[dict[str, Any]]]
    shelf: Shelf
    apart: set[tuple[str, str]] = field(default_factory=set)  # keys of pairs that `ratios` left out

    @cached_property
    def finished(self) -> pd.DataFrame:
        frame = self.frame  # what was never held against the oracle is evidence of nothing
        return frame[(frame["status"] == CellStatus.OK) & frame["answers"] & frame["accuracy_rays"].notna()]

    def of(self, config: str) -> Evidence:
        """The rows of `config`'s own run alone, where this collects several and that one is among them; else all."""
        return self._runs.get(Path(config).stem, self)

    @cached_property
    def _runs(self) -> dict[str, Evidence]:
        runs = self.frame.groupby("run", sort=False)
        return {str(run): replace(self, frame=rows) for run, rows in runs} if runs.ngroups > 1 else {}

    @cached_property
    def _methods(self) -> dict[str, pd.DataFrame]:
        return {str(method): rows for method, rows in self.finished.groupby("method", sort=False)}

    def rows(
        self, pick: Pick, surfaces: Iterable[str] | None = None, precision: str | None = "float32"
    ) -> pd.DataFrame:
        """The finished rows of `pick`, one for each scene, device and precision (the first, where knobs leave several).

        `precision` None takes all precisions, `surfaces` None all surfaces.
        """
        rows = self._methods.get(pick.method, self.finished.head(0))
        if precision is not None:
            rows = rows[rows["precision"] == precision]
        if surfaces is not None:
            rows = rows[rows["surface"].isin(list(surfaces))]
        if pick.knobs:
            texts = {text: _has(text, pick.knobs) for text in rows["parameters"].unique()}
            rows = rows[rows["parameters"].map(texts).astype(bool)]
        return rows.drop_duplicates(derive.GROUP)

    def ratios(
        self,
        slow: Pick,
        fast: Pick,
        surfaces: Iterable[str] | None = None,
        precision: str | None = "float32",
    ) -> pd.DataFrame:
        """How many times as long `slow` takes as `fast`: one row for each group that timed both in the same rounds.

        Columns as in `over`. Pairs that were not timed in turns are left out, and noted in `apart`.
        """
        a, b = (self.rows(pick, surfaces, precision).dropna(subset=["median_ms"]) for pick in (slow, fast))
        return self.over(a, b, derive.GROUP)

    def over(self, slow: pd.DataFrame, fast: pd.DataFrame, keys: list[str]) -> pd.DataFrame:
        """As the function `over`; the pairs that it leaves out are noted in `apart`."""
        found = over(slow, fast, keys)
        pairs = fast[[*keys, "key"]].merge(slow[[*keys, "key"]], on=keys, suffixes=("", "_slow"))
        every, kept = (set(zip(of["key_slow"], of["key"], strict=True)) for of in (pairs, found))
        self.apart.update(every - kept)
        return found

    def arrays(self, row: Any) -> Arrays | None:
        return self.shelf.get(row)


_RATIO = ["ratio", "ratio_low", "ratio_high"]


def over(slow: pd.DataFrame, fast: pd.DataFrame, keys: list[str]) -> pd.DataFrame:
    """Timed rows `slow` over timed rows `fast` with the same `keys`, where some round timed both; other pairs are left
    out, since medians of different rounds make no ratio.

    Columns: those of `fast`, `ratio`, the median over the common rounds, with its 95 % interval `ratio_low` to
    `ratio_high` (NaN where too few common rounds prove none), and `slow_ms`, `fast_ms` and `key_slow`.
    """
    told = ["key", "median_ms", *rounds.COLUMNS]
    both = fast.merge(slow[[*keys, *told]], on=keys, suffixes=("", "_slow"))
    found = {}
    for at, paired in zip(both.index, rounds.ratios(both, "_slow"), strict=True):
        if paired is not None:
            ends = (paired.lower, paired.upper) if paired.proved else (math.nan, math.nan)
            found[at] = (paired.median, *ends)
    ratios = pd.DataFrame(list(found.values()), index=list(found), columns=_RATIO, dtype="float64")
    both = both.assign(slow_ms=both["median_ms_slow"], fast_ms=both["median_ms"])
    return both.loc[ratios.index].join(ratios).reset_index(drop=True)


def proved(rows: pd.DataFrame) -> pd.Series:
    """Which rows have enough samples for the interval of their median."""
    return rows["samples_ms"].map(lambda samples: measure.proves(len(samples or ()))).astype(bool)


def _has(parameters: Any, knobs: Mapping[str, float]) -> bool:
    bound = json.loads(parameters) if isinstance(parameters, str) else {}
    return all(bound.get(name) == value for name, value in knobs.items())
