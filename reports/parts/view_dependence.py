"""View dependence: how speed, error and wrong rays change with the direction from which a surface is seen."""

from __future__ import annotations

import itertools

import pandas as pd

from reports import wording
from reports.analysis import derive, viewstats
from reports.analysis.scene_names import rays_checked
from reports.analysis.viewstats import ViewSet
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import viewplots
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 25
MOST_SETS = 6  # a run with more sets of views shows one for each surface, at most so many
PRINTED_LINES, PRINTED_MAPS = 2, 2  # sets whose drawings are printed; those of others are details
PRINTED_WRONG = 40  # lines of the table of wrong rays
EXPLANATION = (
    "Every surface, device, precision and size that was timed from at least three views of one set. The spread is the "
    "standard deviation over the mean, as in toledo2007, Table 1. There it is of frames per second × pixels of the "
    "bounding box, the rays that a method is called for; that is “rays in the domain” here. “Rays cast” counts every "
    "pixel of the picture, “rays that hit” those that the surface covers. The views of a set are timed interleaved, so "
    "that the machine's drift cancels; what spread the method null has in rays cast, which cost it the same from "
    "everywhere, is noise. Elsewhere in this report its first view stands for a set of "
    f"more than {viewstats.MOST_LISTED}."
)
READ_LINES = "A level line is a method that does not depend on the view."
READ_MAPS = "An even map is a method that does not depend on the view."


def _kept(sets: list[ViewSet]) -> list[ViewSet]:
    """Return all sets if there are at most MOST_SETS, else the first of each surface, at most MOST_SETS."""
    if len(sets) <= MOST_SETS:
        return sets
    return list({of.first.surface: of for of in reversed(sets)}.values())[::-1][:MOST_SETS]


def sections(material: Material) -> list[Section]:
    """Make a section of lines over angles and one of maps over directions, with tables as details.

    [] where the run has no set of views, or only a camera's path, which reports.parts.camera_paths shows.
    """
    every = [of for of in viewstats.view_sets(material.frame) if of.kind != viewstats.PATH]
    if not every:
        return []
    sets = _kept(every)
    cut = "" if len(sets) == len(every) else f" {len(sets)} of {len(every):,} such sets, those of the first surfaces."
    tabled: list[Block] = [Text(EXPLANATION + cut)]
    for of in sets:
        tabled += filter(None, (dependence_table(of), wrong_rays_table(of)))
    by_angle = [of for of in sets if of.kind == viewstats.ANGLES]
    mapped = [of for of in sets if of.kind == viewstats.DIRECTIONS]
    lines = [viewplots.over_angle(of, material.marks, f"angles-{i}") for i, of in enumerate(by_angle)]
    scales = viewplots.Scales.of(mapped, material.error_scale) if mapped else None
    maps = [viewplots.over_directions(of, scales, f"sphere-{i}") for i, of in enumerate(mapped) if scales]
    made = []
    if lines:
        angles: tuple[Block, ...] = (Text(f"{READ_LINES} {_said(by_angle[:PRINTED_LINES])}"), *lines[:PRINTED_LINES])
        made.append(Section("View dependence", angles, tuple(lines[PRINTED_LINES:]), own_page=True))
    if maps:
        around: tuple[Block, ...] = (
            Text(f"{READ_MAPS} {_said(mapped[:PRINTED_MAPS])}"),
            *itertools.chain(*maps[:PRINTED_MAPS]),
        )
        rest: tuple[Block, ...] = tuple(itertools.chain(*maps[PRINTED_MAPS:]))
        made.append(Section("View dependence over all directions", around, rest, own_page=True, name="Directions"))
    return [*made, Section("View dependence: every figure", (), tuple(tabled))]


def _said(sets: list[ViewSet]) -> str:
    """Say for each set which variant depends most on the view, which least, and by how much."""
    return " ".join(told for of in sets if (told := _said_of(of)))


def _said_of(of: ViewSet) -> str:
    """Say which variant of a set depends most on the view; "" where fewer than two that answer were timed."""
    named = [rows for _, rows in of.variants() if rows["answers"].iloc[0]]
    if len(named) < 2:
        return ""
    least, *_, most = sorted(named, key=lambda rows: _reach(rows["us_per_ray"]))
    slow = most.loc[most["us_per_ray"].idxmax(), "view"]
    told = (
        f"On {of.first.surface_title} the view matters most to {most['label'].iloc[0]}: a ray takes "
        f"{wording.factor(_reach(most['us_per_ray']))} as long from {slow} as from its best view. It matters least to "
        f"{least['label'].iloc[0]}, {wording.factor(_reach(least['us_per_ray']))}"
    )
    noise = [_reach(rows["median_ms"]) for _, rows in of.variants() if not rows["answers"].iloc[0]]
    return told + (f"; of an empty frame's time, {wording.factor(max(noise))} is noise." if noise else ".")


def _reach(values: pd.Series) -> float:
    """Return the largest of `values`, which are positive, over the smallest."""
    return float(values.max() / values.min())


def dependence_table(of: ViewSet) -> Table:
    """Make a line for each variant, the most view-dependent first."""
    body = []
    for _, rows in of.variants():
        slow = rows.loc[rows["us_per_ray"].idxmax()]
        rates = [f(rows[f"{name}_rate"]) for name in viewstats.RATES for f in (pd.Series.mean, viewstats.spread)]
        errors = rows["error_max"].astype("float64")
        worst = rows.loc[errors.idxmax()] if errors.notna().any() else None
        wrong = rows["wrong_rays"].fillna(0).astype(int)
        mistaken = rows.loc[wrong.idxmax(), "view"] if wrong.any() else None
        answers = bool(rows["answers"].iloc[0])
        body.append(
            (
                rows["label"].iloc[0],
                *rates,
                float(((rows["upper_ms"] - rows["lower_ms"]) / (2 * rows["median_ms"])).max()),
                slow["view"],
                float(slow["us_per_ray"] / rows["us_per_ray"].mean()),
                None if worst is None else worst["view"],
                None if worst is None else worst["error_max"],
                int(wrong.sum()) if answers else None,
                int((wrong > 0).sum()) if answers else None,
                mistaken,
                int(rows["grazing_wrong_rays"].fillna(0).sum()) if answers else None,
                int(rows["drowned_wrong_rays"].fillna(0).sum()) if answers else None,
            )
        )
    body.sort(key=lambda row: -(row[4] if row[4] == row[4] else row[2]))
    rate_columns = (
        Column(title, show, numeric=True, over=f"{over},\nMrays/s")
        for over in viewstats.RATES.values()
        for title, show in (("mean", wording.number), ("std/mean", wording.percentage))
    )
    return Table(
        (
            Column("variant", stretch=1),
            *rate_columns,
            Column("noise,\n±", wording.share, numeric=True),
            Column("view", over="slowest per ray"),
            Column("over\nmean", wording.factor, numeric=True, over="slowest per ray"),
            Column("view", over="worst error"),
            Column("|t − t*|", wording.error, numeric=True, over="worst error"),
            Column("all", wording.count, numeric=True, over="wrong rays"),
            Column("in\nviews", wording.count, numeric=True, over="wrong rays"),
            Column("most in", over="wrong rays"),
            Column("grazing", wording.count, numeric=True, over="wrong rays"),
            Column("drowned", wording.count, numeric=True, over="wrong rays"),
        ),
        body,
        f"View dependence over {len(of.views)} {_name(of)}: {of.place}.",
        "The most view-dependent first, by the spread of rays in the domain per second. A spread says something of the "
        "method only well above the noise: half the 95 % interval of the median, in the view where it is widest. "
        f"Wrong rays are of the {rays_checked(of.rows)} rays of each view's check."
        + wording.zeros([row[11] for row in body]),
    )


def _name(of: ViewSet) -> str:
    """Return what the views of a set are called: “projection angles”, “directions” or “named views”.

    Those of any other set are “views of the set” with its name.
    """
    named = {viewstats.ANGLES: "projection angles", viewstats.DIRECTIONS: "directions"}.get(of.kind, of.kind)
    return (
        named if of.kind in (viewstats.ANGLES, viewstats.DIRECTIONS, viewstats.NAMED) else f"views of the set “{named}”"
    )


def wrong_rays_table(of: ViewSet) -> Table | None:
    """Make a line for each variant and view with wrong rays that are neither grazing nor drowned, the most first.

    None where there are none.
    """
    rows = of.rows[of.rows["wrong_rays"].fillna(0) > 0].sort_values("wrong_rays", ascending=False, kind="stable")
    if rows.empty:
        return None
    kinds = derive.kinds(rows)
    apart = ("grazing_wrong_rays", "drowned_wrong_rays")
    body = [
        (r.label, r.view, r.wrong_rays, *(getattr(r, name) for name in (*kinds, *apart)))
        for r in tuples(rows.head(PRINTED_WRONG))
    ]
    titles = ("wrong", *(kind.replace("_", " ") for kind in kinds), "grazing wrong", "drowned wrong")
    cut = wording.first_of(len(body), len(rows))
    return Table(
        (
            Column("variant", stretch=1),
            Column("view"),
            *(Column(title, wording.count, numeric=True) for title in titles),
        ),
        body,
        f"Wrong rays view by view: {of.place}.",
        f"Of the {wording.count(of.first.accuracy_rays)} rays of each view's check; other views have none.{cut}",
    )
