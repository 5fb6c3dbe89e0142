"""View dependence: a set of views → tables of spread and worst views, plots over angle, maps over directions."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from reports.analysis import viewstats
from reports.analysis.viewstats import ANGLES, DIRECTIONS, ViewSet
from reports.content import Block, Section, Text
from reports.drawing import viewplots
from reports.drawing.style import Mark

MOST_SETS = 6  # of a run that are all shown
MOST_MAPPED = 4  # whose maps are drawn

EXPLANATION = (
    "Every surface, device, precision and size that was timed from at least three views of one set. The spread is the "
    "standard deviation over the mean, as in toledo2007, Table 1. There it is of frames per second × pixels of the "
    "bounding box, the rays that a method is called for; that is “rays in the domain” here. “Rays cast” counts every "
    "pixel of the picture, “rays that hit” those that the surface covers. The views of a set are timed interleaved, so "
    "that the machine's drift cancels; what spread the method null has in rays cast, which cost it the same from "
    "everywhere, is noise. Elsewhere in this report its first view stands for a set of "
    f"more than {viewstats.MOST_LISTED}."
)


def _kept(sets: list[ViewSet]) -> list[ViewSet]:
    """All of a run with few; of one with more than MOST_SETS the first of each surface, at most so many."""
    if len(sets) <= MOST_SETS:
        return sets
    return list({of.first.surface: of for of in reversed(sets)}.values())[::-1][:MOST_SETS]


def sections(frame: pd.DataFrame, marks: Mapping[str, Mark], errors: tuple[int, int]) -> list[Section]:
    """One section of tables and one of pictures, where some set of views is there; `marks` by variant, `errors` the
    decades of the report's colour scale of errors."""
    every = viewstats.view_sets(frame)
    if not every:
        return []
    sets = _kept(every)
    cut = "" if len(sets) == len(every) else f" {len(sets)} of {len(every):,} such sets, those of the first surfaces."
    tabled: list[Block] = [Text(EXPLANATION + cut)]
    for of in sets:
        tabled += filter(None, (viewstats.dependence(of), viewstats.wrong_rays(of)))
    made = [Section("View dependence", tuple(tabled), wide=True)]
    lines = [viewplots.over_angle(of, marks, f"angles-{i}") for i, of in enumerate(sets) if of.kind == ANGLES]
    mapped = [of for of in sets if of.kind == DIRECTIONS][:MOST_MAPPED]
    scales = viewplots.Scales.of(mapped, errors) if mapped else None
    maps = [
        figure
        for i, of in enumerate(mapped)
        if scales
        for figure in viewplots.over_directions(of, scales, f"sphere-{i}")
    ]
    made += [Section("View dependence: over the projection angle", tuple(lines))] if lines else []
    made += [Section("View dependence: over the sphere of directions", tuple(maps), wide=True)] if maps else []
    return made
