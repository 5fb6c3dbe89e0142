"""Hold what decides the papers' claims: rows by method and knobs, and ratios of times taken in the same rounds."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from harness.contract import ORIGINS, CellStatus, Origin
from reports import wording
from reports.analysis import derive, rounds
from reports.reading.arrays import Arrays, Shelf

RAYS_BEGIN: Mapping[str, Origin] = {
    # Where the rays of a paper begin, by the first word of its configs' names.
    # toledo2007, sections 3, 4.3 and 4.4: "from where the ray-casting starts" is the bounding box; t = 0 is where the
    # ray enters it, λ where it leaves.
    "toledo": "entry",
    # szente, section 2: f is sampled along the view ray p(t) of each pixel; nothing moves its origin.
    "szente": "eye",
    # beamcasting has no rays: its boxes are in world coordinates. Rays that are compared with them are ours.
}
_WORDS: Mapping[Origin, str] = {
    "nearest": "their point nearest the domain's centre",
    "entry": "their entry into the domain",
    "eye": "the eye",
}


_SELECTS = ("origin", "precision", "surface", "parameters")  # what `Evidence.rows` selects by
_BY = list(dict.fromkeys([*derive.GROUP, *_SELECTS]))


@dataclass(frozen=True)
class Pick:
    """Name a method with some of its knobs at stated values.

    `words` name the pick in texts. `origin` is where its rays begin; None stands for the origin of the judged paper's
    rays.
    """

    words: str
    method: str
    knobs: Mapping[str, float] = field(default_factory=dict)
    origin: Origin | None = None


@dataclass(frozen=True, eq=False)
class Evidence:
    """Hold the rows of a run that claims are judged by, and select from them.

    Only cells that ended well and were checked against the oracle count. Rows whose rays begin at different origins are
    never mixed: a pick states its origin, or takes `origin`.
    """

    frame: pd.DataFrame  # with the columns of analysis.derive
    studies: Mapping[str, list[dict[str, Any]]]  # rows by study
    shelf: Shelf
    apart: set[tuple[str, str]] = field(default_factory=set)  # the keys of pairs of rows that `ratios` left out
    config: str = ""  # the config whose claims are judged; its first word names the paper, as in RAYS_BEGIN

    @cached_property
    def _finished(self) -> dict[str, NDArray[np.intp]]:
        """Return by method where the rows of cells are that ended well, answer, and were checked against the oracle."""
        frame = self.frame
        there = (frame["status"] == CellStatus.OK) & frame["answers"].astype(bool) & frame["accuracy_rays"].notna()
        places = np.flatnonzero(there)
        by_method = frame[["method"]].take(places).groupby("method", sort=False).indices
        return {str(method): places[at] for method, at in by_method.items()}

    @cached_property
    def _coded(self) -> dict[str, dict[str, _Coded]]:
        """Return by method the columns by which `rows` selects its finished rows, by the columns' names."""
        return {method: {name: _Coded.of(told[name]) for name in _SELECTS} for method, told in self._told.items()}

    @cached_property
    def _told(self) -> dict[str, pd.DataFrame]:
        """Return by method what `rows` selects its finished rows by; all columns of very many rows are not copied."""
        told = self.frame[_BY]
        return {method: told.take(places) for method, places in self._finished.items()}

    def finished(self, method: str, surfaces: Iterable[str] | None = None) -> pd.DataFrame:
        """Return all finished rows of a method, of every origin and precision; `surfaces` None takes all surfaces."""
        places = self._finished.get(method, np.empty(0, np.intp))
        if surfaces is not None:
            places = places[self.frame["surface"].take(places).isin(list(surfaces)).to_numpy()]
        return self.frame.take(places)

    def of(self, config: str) -> Evidence:
        """Return the evidence that the claims of `config` are judged by.

        Where this evidence is collected from several runs, and that of `config` is among them, it is the rows of that
        run alone. Else it is all rows.
        """
        if config not in self._judged:
            base = self._runs.get(run_of(config), self)
            self._judged[config] = replace(base, config=config)
            # these do not depend on the config
            vars(self._judged[config]).update(_finished=base._finished, _told=base._told, _coded=base._coded)
        return self._judged[config]

    @cached_property
    def _judged(self) -> dict[str, Evidence]:
        """Return the evidence that `of` has made so far, by config."""
        return {}

    @cached_property
    def origin(self) -> Origin:
        """Return the origin of the rays that claims are judged by.

        It is the origin that the paper's rays have, if any finished row has it. Else it is the first of ORIGINS that
        any finished row has. Where no row has an origin, it is the paper's.
        """
        there = {origin for told in self._told.values() for origin in told["origin"].dropna().unique()}
        return next((origin for origin in (self._stated, *ORIGINS) if origin in there), self._stated)

    @property
    def _stated(self) -> Origin:
        """Return the origin of the judged paper's rays; "nearest" for a paper that RAYS_BEGIN does not name."""
        return RAYS_BEGIN.get(run_of(self.config).partition("-")[0], "nearest")

    @property
    def note(self) -> str:
        """Return a phrase for verdicts that are by rays of another origin than the paper's.

        The phrase names both origins. It is "" where the rays begin as in the paper.
        """
        if self.origin == self._stated:
            return ""
        return f"of rays that begin at {_WORDS[self.origin]}, where the paper's begin at {_WORDS[self._stated]}"

    @cached_property
    def _runs(self) -> dict[str, Evidence]:
        """Return the evidence of each run alone, by the run's name; {} unless there are several runs."""
        runs = self.frame.groupby("run", sort=False)
        return {str(run): replace(self, frame=rows) for run, rows in runs} if runs.ngroups > 1 else {}

    def rows(
        self, pick: Pick, surfaces: Iterable[str] | None = None, precision: str | None = "float32"
    ) -> pd.DataFrame:
        """Return the finished rows of `pick` from one origin, one for each scene, device and precision.

        Where several rows of one scene have the knobs of the pick, the first is taken. Beams and triangles have no
        origin, so that their rows go with those of any origin. `precision` None takes all precisions, `surfaces` None
        all surfaces.
        """
        if pick.method not in self._told:
            return self._no_rows
        rows, by, origin = self._told[pick.method], self._coded[pick.method], pick.origin or self.origin
        kept = by["origin"].where(lambda own: wording.absent(own) or own == origin)
        if precision is not None:
            kept = kept & by["precision"].where(lambda own: own == precision)
        if surfaces is not None:
            kept = kept & by["surface"].where(frozenset(surfaces).__contains__)
        if pick.knobs:
            kept = kept & by["parameters"].where(lambda text: _has(text, pick.knobs))
        at = np.flatnonzero(kept)
        at = at[~rows[derive.GROUP].take(at).duplicated().to_numpy()]
        return self.frame.take(self._finished[pick.method][at])

    def ratios(
        self,
        slow: Pick,
        fast: Pick,
        surfaces: Iterable[str] | None = None,
        precision: str | None = "float32",
    ) -> pd.DataFrame:
        """Divide the times of `slow` by those of `fast`: one row for each group that timed both in the same rounds.

        The columns are those of `rounds.over`. Pairs without a common round are left out, and added to `apart`.
        """
        a, b = (self.rows(pick, surfaces, precision) for pick in (slow, fast))
        if a.empty or b.empty:  # as for most claims, since few runs have the rows of all papers
            return self._no_ratios
        return self.over(a[a["median_ms"].notna()], b[b["median_ms"].notna()], derive.GROUP)

    @cached_property
    def _no_rows(self) -> pd.DataFrame:
        """Return the columns of `frame`, without rows."""
        return self.frame.head(0)

    @cached_property
    def _no_ratios(self) -> pd.DataFrame:
        """Return the columns that `ratios` returns, without rows."""
        return rounds.over(self._no_rows, self._no_rows, derive.GROUP)

    def over(self, slow: pd.DataFrame, fast: pd.DataFrame, keys: list[str]) -> pd.DataFrame:
        """Return what `rounds.over` returns, and add the pairs of rows that it leaves out to `apart`."""
        found = rounds.over(slow, fast, keys)
        if slow.empty or fast.empty:
            return found
        pairs = fast[[*keys, "key"]].merge(slow[[*keys, "key"]], on=keys, suffixes=("", "_slow"))
        every, kept = (set(zip(of["key_slow"], of["key"], strict=True)) for of in (pairs, found))
        self.apart.update(every - kept)
        return found

    def arrays(self, row: Any) -> Arrays | None:
        """Return the arrays of a row of the frame; None where its file is damaged or missing."""
        return self.shelf.get(row)


def run_of(config: str) -> str:
    """Return the name of the run of a config's file: `toledo-fig4` of `toledo-fig4.toml`."""
    return Path(config).stem


@dataclass(frozen=True, eq=False)
class _Coded:
    """Hold a column whose values repeat: each value once, and the place of each row's among these."""

    values: list[Any]
    codes: NDArray[np.intp]

    @classmethod
    def of(cls, column: pd.Series) -> _Coded:
        codes, values = pd.factorize(column, use_na_sentinel=False)
        return cls(list(values), codes)

    def where(self, holds: Callable[[Any], bool]) -> NDArray[np.bool_]:
        """Tell for each row whether something holds of its value, as bool[n]."""
        return np.array([holds(value) for value in self.values], bool)[self.codes]


def _has(parameters: str | None, knobs: Mapping[str, float]) -> bool:
    """Tell whether a row's parameters, as JSON, have these values."""
    bound = json.loads(parameters) if isinstance(parameters, str) else {}
    return all(bound.get(name) == value for name, value in knobs.items())
