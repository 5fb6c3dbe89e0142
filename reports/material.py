"""Hold what every part of a report is made from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import pandas as pd

from reports import claims
from reports.analysis import choices, shown, surface_names, viewstats
from reports.analysis.choices import Choice
from reports.claims import Claim, Verdict, figures
from reports.claims.evidence import Evidence
from reports.drawing import images, style
from reports.drawing.style import Mark
from reports.reading.arrays import Shelf
from reports.reading.run import Run
from reports.reading.tuples import tuples


@dataclass(frozen=True, eq=False)
class Material:
    """Hold a run, its rows with the derived columns, and what several parts compute from them."""

    run: Run
    frame: pd.DataFrame  # what analysis.derive returns
    rungs: pd.DataFrame  # what analysis.breaks returns
    shelf: Shelf
    focus: str = ""  # the method or variant that the report is about; "" for none

    @cached_property
    def marks(self) -> Mapping[str, Mark]:
        """Return the mark of each variant, by the variant's name."""
        variants = pd.concat([of[["method", "variant"]] for of in (self.frame, self.run.families)])
        pairs = variants.drop_duplicates().itertuples(index=False, name=None)
        return style.variant_marks(pairs, self.focus_method)

    @cached_property
    def method_marks(self) -> Mapping[str, Mark]:
        """Return the mark of each method, by the method's name."""
        return style.marks([*self.frame["method"], *self.run.families["method"]], self.focus_method)

    @cached_property
    def focus_method(self) -> str:
        """Return the method that the report is about, or whose variant it is about; "" for none."""
        of = self.frame.loc[self.frame["variant"] == self.focus, "method"]
        return str(of.iloc[0]) if len(of) and self.focus not in set(self.frame["method"]) else self.focus

    @cached_property
    def choices(self) -> list[Choice]:
        """Return what to take for each surface that was timed, of the rows `listed`."""
        return choices.choices(self.listed)

    @cached_property
    def _choice_by_surface(self) -> dict[str, Choice]:
        return {one.surface: one for one in self.choices}

    def choice_of(self, rows: pd.DataFrame) -> Choice | None:
        """Return what to take of the finished rows `listed` of one scene and device; None where nothing was timed."""
        if rows.empty:
            return None
        first = rows.iloc[0]
        known = self._choice_by_surface.get(str(first["surface"]))
        if known is not None:
            told = known.rows[["comparison", "device"]].iloc[0]
            if (told["comparison"], told["device"]) == (first["comparison"], first["device"]):
                return known
        return next(iter(choices.choices(rows)), None)

    @cached_property
    def listed(self) -> pd.DataFrame:
        """Return the rows of `frame` for tables that list scenes one by one.

        Of a large set of views only the first view is kept, and of a surface in several forms only the printed one.
        """
        return surface_names.printed_alone(viewstats.one_view_of_each(self.frame))

    @cached_property
    def error_scale(self) -> tuple[int, int]:
        """Return the first and the last decade of the one colour scale that all pictures and maps of errors share."""
        rows = [shown.in_galleries(self.listed), shown.in_evaluation_maps(self.frame)]
        rows += [figures.rows_of(figure, self.evidence) for figure in figures.FIGURES]
        every = pd.concat(rows).drop_duplicates(["run", "key"])
        found = (self.shelf.get(row) for row in tuples(every))
        mapped = self.frame.loc[self.frame["view_set"] == viewstats.DIRECTIONS, "error_max"].dropna()
        return images.scale_of((arrays for arrays in found if arrays is not None), mapped)

    @cached_property
    def evidence(self) -> Evidence:
        """Return the run as evidence for and against the papers' claims."""
        return Evidence(self.frame, self.run.studies, self.shelf)

    @cached_property
    def judged(self) -> list[tuple[Claim, Verdict]]:
        """Judge every claim of the papers by this run; return claims and verdicts in the papers' order."""
        return [(claim, claims.judge(claim, self.evidence)) for claim in claims.CLAIMS]
