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

from harness.contract import ORIGINS, CellStatus, Origin
from harness.results import timings
from reports.analysis import derive, rounds
from reports.reading.arrays import Arrays, Shelf

STOOD: Mapping[str, Origin] = {
    # Where a paper's rays begin, by the first word of its configs' names. toledo2007, sections 3, 4.3 and 4.4: "from
    # where the ray-casting starts" is the bounding box; t = 0 is the ray's entry, λ its exit.
    "toledo": "entry",
    # szente, section 2: f is sampled along the view ray p(t) of each pixel; no step moves its origin.
    "szente": "eye",
    # beamcasting has no rays: its boxes are in world coordinates. What stands beside its beams is ours.
}
_WORDS: Mapping[Origin, str] = {
    "nearest": "their point nearest the domain's centre",
    "entry": "their entry into the domain",
    "eye": "the eye",
}


@dataclass(frozen=True)
class Pick:
    """A method with some of its knobs at stated values; `words` name it in texts. `origin` is where its rays begin;
    None: where those of the paper do that is judged."""

    words: str
    method: str
    knobs: Mapping[str, float] = field(default_factory=dict)
    origin: Origin | None = None


@dataclass(frozen=True, eq=False)
class Evidence:
    """All that a run holds, for those who judge by it. Only cells that ended well count.

    Rays that begin at several origins are never mixed: a pick states its own, or takes `origin`.
    """

    frame: pd.DataFrame  # with the columns of derive
    studies: Mapping[str, list[dict[str, Any]]]
    shelf: Shelf
    apart: set[tuple[str, str]] = field(default_factory=set)  # keys of pairs that `ratios` left out
    config: str = ""  # by whose paper it is judged, see STOOD

    @cached_property
    def finished(self) -> pd.DataFrame:
        frame = self.frame  # what was never held against the oracle is evidence of nothing
        return frame[(frame["status"] == CellStatus.OK) & frame["answers"] & frame["accuracy_rays"].notna()]

    def of(self, config: str) -> Evidence:
        """The rows of `config`'s own run alone, where this collects several and that one is among them; else all."""
        if config not in self._judged:
            self._judged[config] = replace(self._runs.get(Path(config).stem, self), config=config)
        return self._judged[config]

    @cached_property
    def _judged(self) -> dict[str, Evidence]:
        return {}

    @cached_property
    def origin(self) -> Origin:
        """Where rays begin: as in the paper, where rows are of such rays, else at the first of ORIGINS of which rows
        are."""
        there = set(self.finished["origin"].dropna())
        return next((origin for origin in (self._stated, *ORIGINS) if origin in there), self._stated)

    @property
    def _stated(self) -> Origin:
        return STOOD.get(Path(self.config).stem.partition("-")[0], "nearest")

    @property
    def note(self) -> str:
        """Say where rays begin, if not as in the paper; else empty."""
        if self.origin == self._stated:
            return ""
        return f"of rays that begin at {_WORDS[self.origin]}, where the paper's begin at {_WORDS[self._stated]}"

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
        """The finished rows of `pick` from one origin, one for each scene, device and precision (the first, where knobs
        leave several). Beams and triangles have no origin, and their rows stand beside those of any.

        `precision` None takes all precisions, `surfaces` None all surfaces.
        """
        rows = self._methods.get(pick.method, self.finished.head(0))
        rows = rows[rows["origin"].isna() | (rows["origin"] == (pick.origin or self.origin))]
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
        """Divide the times of `slow` by those of `fast`: one row for each group that timed both in the same rounds.

        Columns as in `over`. Pairs that were not timed in turns are left out, and noted in `apart`.
        """
        a, b = (self.rows(pick, surfaces, precision).dropna(subset=["median_ms"]) for pick in (slow, fast))
        return self.over(a, b, derive.GROUP)

    def over(self, slow: pd.DataFrame, fast: pd.DataFrame, keys: list[str]) -> pd.DataFrame:
        """Do what the function `over` does, and note in `apart` the pairs that it leaves out."""
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
    return rows["samples_ms"].map(lambda samples: timings.proves(len(samples or ()))).astype(bool)


def _has(parameters: Any, knobs: Mapping[str, float]) -> bool:
    bound = json.loads(parameters) if isinstance(parameters, str) else {}
    return all(bound.get(name) == value for name, value in knobs.items())
