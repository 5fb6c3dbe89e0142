"""What every part of a report is made from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import pandas as pd

from reports import claims, evaluations
from reports.analysis import forms, viewstats
from reports.claims import Claim, Verdict
from reports.claims.evidence import Evidence
from reports.drawing import images, style
from reports.drawing.style import Mark
from reports.reading.arrays import Shelf
from reports.reading.load import Run


@dataclass(frozen=True, eq=False)
class Material:
    """A run, its rows with the derived columns, and what parts share."""

    run: Run
    frame: pd.DataFrame  # of derive
    rungs: pd.DataFrame  # of breaks
    shelf: Shelf

    @cached_property
    def marks(self) -> Mapping[str, Mark]:
        """Give each variant its mark."""
        variants = pd.concat([of[["method", "variant"]] for of in (self.frame, self.run.families)])
        return style.variant_marks(variants.drop_duplicates().itertuples(index=False, name=None))

    @cached_property
    def listed(self) -> pd.DataFrame:
        """`frame` for what lists scenes one by one: the first view stands for a large set, and a surface as printed for
        its other forms, which parts/forms compares."""
        return forms.printed_alone(viewstats.one_view_of_each(self.frame))

    @cached_property
    def error_scale(self) -> tuple[int, int]:
        """The decades of the one colour scale of errors that all pictures and maps of the report share."""
        from reports.parts.papers import pictures  # which takes a Material itself

        shown = [images.drawn(self.listed), evaluations.drawn(self.frame)]
        shown += [pictures.drawn(self.evidence, figure) for figure in pictures.FIGURES]
        rows = pd.concat(shown).drop_duplicates(["run", "key"])
        found = (self.shelf.get(row) for row in rows.itertuples())
        mapped = self.frame.loc[self.frame["view_set"] == viewstats.DIRECTIONS, "error_max"].dropna()
        return images.scale_of((arrays for arrays in found if arrays is not None), mapped)

    @cached_property
    def evidence(self) -> Evidence:
        return Evidence(self.frame, self.run.studies, self.shelf)

    @cached_property
    def judged(self) -> list[tuple[Claim, Verdict]]:
        """Every claim of the papers with its verdict by this run, in the papers' order."""
        return [(claim, claims.judge(claim, self.evidence)) for claim in claims.CLAIMS]
