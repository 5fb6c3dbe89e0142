"""What claims and reproductions are decided by: rows picked by method and knobs, and ratios of times taken in turns."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from harness import measure
from harness.contract import ORIGINS, CellStatus, Origin
from reports import derive, rounds
from reports.arrays import Arrays, Shelf

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
        """In words, where rays begin if not as in the paper; else empty."""
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
        above_floor: bool = False,
    ) -> pd.DataFrame:
        """How many times as long `slow` takes as `fast`, where both were timed in turns: one row for each group.

        Columns: those of `fast`, and `ratio`, `ratio_low`, `ratio_high` (of the ends of both intervals; NaN where one
        of them is not proved, by too few samples), `slow_ms` and `fast_ms`. With `above_floor` the null
        method's time is taken off both first, where it was measured.
        """
        a, b = (self.rows(pick, surfaces, precision).dropna(subset=["median_ms"]) for pick in (slow, fast))
        return over(a, b, derive.GROUP, above_floor)

    def arrays(self, row: Any) -> Arrays | None:
        return self.shelf.get(row)


_TIMES = ["median_ms", "lower_ms", "upper_ms"]


def over(slow: pd.DataFrame, fast: pd.DataFrame, keys: list[str], above_floor: bool = False) -> pd.DataFrame:
    """Timed rows `slow` over timed rows `fast` with the same `keys`, with the columns of Evidence.ratios."""
    a, b = (rows.assign(**{end: rows[end].where(proved(rows)) for end in _TIMES[1:]}) for rows in (slow, fast))
    both = b.merge(a[[*keys, *_TIMES, *rounds.COLUMNS]], on=keys, suffixes=("", "_slow"))
    floor = both["floor_ms"].fillna(0.0) if above_floor else 0.0
    for name in _TIMES:
        both[name] = (both[name] - floor).clip(lower=1e-9)
        both[f"{name}_slow"] -= floor
    both = both.assign(
        slow_ms=both["median_ms_slow"],
        fast_ms=both["median_ms"],
        ratio=both["median_ms_slow"] / both["median_ms"],
        ratio_low=both["lower_ms_slow"] / both["upper_ms"],
        ratio_high=both["upper_ms_slow"] / both["lower_ms"],
    )
    return both if above_floor else _in_common_rounds(both)


def _in_common_rounds(both: pd.DataFrame) -> pd.DataFrame:
    """`both` with the ratios of those pairs that were timed in enough rounds together taken from these."""
    of_slow = both[[f"{name}_slow" for name in rounds.COLUMNS]].set_axis(rounds.COLUMNS, axis=1)
    pairs = zip(of_slow.itertuples(), both[rounds.COLUMNS].itertuples(), strict=True)
    for slow, fast in pairs:
        found = rounds.ratio(slow, fast)
        if found is not None and found.proved:
            both.loc[slow.Index, ["ratio", "ratio_low", "ratio_high"]] = found.median, found.lower, found.upper
    return both


def proved(rows: pd.DataFrame) -> pd.Series:
    """Which rows have enough samples for the interval of their median."""
    return rows["samples_ms"].map(lambda samples: measure.proves(len(samples or ()))).astype(bool)


def _has(parameters: Any, knobs: Mapping[str, float]) -> bool:
    bound = json.loads(parameters) if isinstance(parameters, str) else {}
    return all(bound.get(name) == value for name, value in knobs.items())
