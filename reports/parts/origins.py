"""Compare origins of rays: wrong rays, errors and times of the same method with rays that begin at several places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from harness.contract import ORIGINS, CellStatus
from reports import wording
from reports.analysis import breaks, count_tests, derive, rounds
from reports.analysis.scene_names import scene_names
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import tables
from reports.material import Material
from reports.reading.run import Facts

ORDER = 23
CHEAP = 1.05  # a shift that multiplies a frame's time by at most this is called cheap
_OF = ["device", "precision", "caster"]
_ERROR = "relative_error_max"
_CAPTION = (
    "Nearest: the harness moves each ray's origin, by error-free arithmetic, to the point nearest the domain's centre; "
    "entry: to where the ray enters the domain; eye: the ray stays as it is given. The programs differ in that alone. "
    "Errors are largest |t − t*| of right hits over the scene's radius, t along the ray as given from every origin, so "
    "that from the eye they include the rounding of t itself. Time is over that from the eye, in the geometric mean of "
    "the scenes where both answer every ray away from silhouettes rightly."
)


def paired(frame: pd.DataFrame) -> pd.DataFrame:
    """Select the timed rows of variants whose rays began at several origins in one comparison.

    Adds `caster`, the variant without its origin, `told`, the label without it, and `cost`, its time over that from the
    eye.
    """
    rows = frame[(frame["status"] == CellStatus.OK) & frame["median_ms"].notna() & frame["origin"].notna()]
    rows = rows.assign(caster=derive.casters(rows), told=_without_origin(rows))
    rows["silhouette_wrong_rays"] = rows["grazing_wrong_rays"] + rows["drowned_wrong_rays"]
    several = rows.groupby([*derive.GROUP, "caster"])["origin"].transform("nunique") > 1
    return rows[several.astype(bool)].assign(cost=lambda kept: _costs(kept).reindex(kept.index))


def _without_origin(rows: pd.DataFrame) -> pd.Series:
    """Return the rows' labels without the words for where rays begin: texts, with the index of `rows`."""
    return derive.casters(rows.assign(variant=rows["label"]))


def _costs(rows: pd.DataFrame) -> pd.Series:
    """Return each row's time over that of the same rays from the eye, in the rounds that timed both.

    Returns float64 with the index of the rows that are right or answer nothing. NaN for the rows from the eye, for rows
    without common rounds, and where the row from the eye answers a ray away from silhouettes wrongly.
    """
    keys = [*derive.GROUP, "caster"]
    rows = rows[derive.all_right(rows) | ~rows["answers"].astype(bool)]
    eye = rows[rows["origin"] == "eye"]
    found = pd.Series(np.nan, rows.index)
    for _, own in rows[rows["origin"] != "eye"].groupby("origin", sort=False):
        ratios = rounds.over(own, eye, keys).set_index(keys)["ratio"]
        found.update(own.join(ratios, on=keys)["ratio"])
    return found


def sections(material: Material) -> list[Section]:
    """Make the section; [] unless rays of one variant began at several origins."""
    rows = paired(material.frame)
    shown: list[Block] = []
    details: list[Block] = []
    if len(rows):
        shown += [*map(Text, conclusions(rows)), by_variant(rows)]
        details.append(by_scene(rows))
    hard = families_held(material.rungs, material.run.plan.facts)
    if hard:
        shown.append(Text(_held(hard)))
        details.append(hard)
    return [Section("What the shift is worth", tuple(shown), tuple(details), name="Origins")] if shown else []


def _mean(ratios: pd.Series) -> float:
    """Return the geometric mean of the ratios that are not NaN; NaN where there is none."""
    known = ratios.dropna().astype("float64")
    return float(np.exp(np.log(known).mean())) if len(known) else float("nan")


def _present(rows: pd.DataFrame) -> list[str]:
    """Return the origins that rows have, in the order of ORIGINS."""
    return [origin for origin in ORIGINS if (rows["origin"] == origin).any()]


def _from_all(rows: pd.DataFrame, origins: Sequence[str]) -> pd.DataFrame:
    """Select the rows of variants and scenes that have one from each of `origins`, so that sums over scenes compare."""
    there = rows["origin"].where(rows["origin"].isin(list(origins)))
    found = there.groupby([rows[name] for name in (*derive.GROUP, "caster")]).transform("nunique")
    return rows[found == len(origins)]


def _wrong(rows: pd.DataFrame) -> int:
    """Count the wrong rays, silhouettes included."""
    return int(rows[["wrong_rays", "silhouette_wrong_rays"]].sum().sum())


def conclusions(rows: pd.DataFrame) -> list[str]:
    """Say what the shift from the eye to the nearest point gains and what it costs; [] without rays from both."""
    answering = _from_all(rows[rows["answers"].astype(bool)], ("eye", "nearest"))
    before, after = (answering[answering["origin"] == origin] for origin in ("eye", "nearest"))
    if before.empty or after.empty:
        return []
    better, worse = _changed(before, after)
    cost = float(after["cost"].median())
    gained, harmed = (
        wording.listed([f"{name} ({was:,} to {now:,})" for name, was, now in found]) or "none"
        for found in (better, worse)
    )
    errors = _errors(before, after)
    first = (
        f"Moving the origins of rays from the eye to the point nearest the domain's centre takes the wrong rays of all "
        f"{answering['caster'].nunique()} variants together, silhouettes included, from {_wrong(before):,} to "
        f"{_wrong(after):,} of {int(after['accuracy_rays'].sum()):,}{_by_view(before, after)}. Fewer beyond chance: "
        f"{gained}. More beyond chance: {harmed}. The largest error from the eye is {wording.factor(errors.median())} "
        "that from the nearest point, in the median of all scenes and variants, and "
        f"{wording.short(errors.max())}× at most. {count_tests.RULE}."
    )
    return [first, _price(cost, bool(better), bool(worse))]


def _price(cost: float, gains: bool, harms: bool) -> str:
    """Say whether what the shift gains is worth its cost.

    `cost` is the factor of a frame's time; NaN where it is not known.
    """
    if np.isnan(cost):
        return (
            "No variant answers every ray away from silhouettes rightly from both origins: what that costs is not told."
        )
    paid = (
        f"Where both answer every ray away from silhouettes rightly, the shift multiplies the time of a frame by "
        f"{wording.hundredths(cost)} in the median"
    )
    if not gains:
        return f"{paid}, and no variant answers more rays rightly for it here."
    if harms or cost > CHEAP:
        return f"{paid}: it is worth that to the variants named, and to no other."
    return f"{paid}: it makes methods more robust and costs next to nothing."


def _by_view(before: pd.DataFrame, after: pd.DataFrame) -> str:
    """Write the wrong rays before and after view by view; "" where there is one view."""
    views = list(dict.fromkeys(before["view"]))
    told = [
        f"{_wrong(before[before['view'] == view]):,} to {_wrong(after[after['view'] == view]):,} in {view}"
        for view in views
    ]
    return f" ({wording.listed(told)})" if len(views) > 1 else ""


def _changed(
    before: pd.DataFrame, after: pd.DataFrame
) -> tuple[list[tuple[str, int, int]], list[tuple[str, int, int]]]:
    """Return the variants with fewer wrong rays after than before, and those with more, by a test.

    Each has its name and its wrong rays before and after; the largest changes are first.
    """
    names = dict(zip(after["caster"], after["told"], strict=True))
    better: list[tuple[str, int, int]] = []
    worse: list[tuple[str, int, int]] = []
    for caster, name in names.items():
        one, other = (rows[rows["caster"] == caster] for rows in (before, after))
        was, now = _wrong(one), _wrong(other)
        rays = int(one["accuracy_rays"].sum()), int(other["accuracy_rays"].sum())
        if count_tests.exceeds(was, rays[0], now, rays[1], tries=2 * len(names)):
            better.append((name, was, now))
        if count_tests.exceeds(now, rays[1], was, rays[0], tries=2 * len(names)):
            worse.append((name, was, now))
    for found in (better, worse):
        found.sort(key=lambda one: -abs(one[1] - one[2]))
    return better, worse


def _errors(before: pd.DataFrame, after: pd.DataFrame) -> pd.Series:
    """Return the largest error before over that after, float64 with a value for each scene and variant.

    Scenes and variants whose error after is 0 or not known are left out.
    """
    keys = [*derive.GROUP, "caster"]
    both = before.merge(after[[*keys, _ERROR]], on=keys, suffixes=("", "_after"))
    return (both[_ERROR] / both[f"{_ERROR}_after"].where(both[f"{_ERROR}_after"] > 0)).astype("float64").dropna()


def _line(own: pd.DataFrame, origins: Sequence[str]) -> tuple[Any, ...]:
    """Return one variant's figures over its scenes: counts summed, largest errors, geometric means of times."""
    by = {origin: own[own["origin"] == origin] for origin in origins}
    answers = bool(own["answers"].iloc[0])
    clear, silhouettes, errors = (
        tuple(of(rows) if answers and len(rows) else None for rows in by.values())
        for of in (
            lambda rows: int(rows["wrong_rays"].sum()),
            lambda rows: int(rows["silhouette_wrong_rays"].sum()),
            lambda rows: rows[_ERROR].max(),
        )
    )
    return (*clear, *silhouettes, *errors, *(_mean(by[origin]["cost"]) for origin in origins if origin != "eye"))


def _columns(origins: Sequence[str]) -> tuple[Column, ...]:
    """Return the columns of what `_line` returns."""
    figures = (
        ("wrong rays", wording.count),
        ("wrong at silhouettes", wording.count),
        ("largest error", wording.error),
    )
    told = [Column(origin, show, numeric=True, over=heading) for heading, show in figures for origin in origins]
    times = [Column(o, wording.hundredths, numeric=True, over="time over the eye's") for o in origins if o != "eye"]
    return (*told, *times)


def by_variant(rows: pd.DataFrame) -> Table:
    """Make a line for each variant, over those of its scenes that have a row from every origin of the run."""
    origins = _present(rows)
    rows = _from_all(rows, origins)
    several = [name for name in ("device", "precision") if rows[name].nunique() > 1]
    body = [
        (
            *(own[name].iloc[0] for name in several),
            own["told"].iloc[0],
            own["comparison"].nunique(),
            *_line(own, origins),
        )
        for _, own in rows.groupby(_OF, sort=False)
    ]
    head = (*(Column(name) for name in several), Column("variant", stretch=1), Column("scenes", wording.count, True))
    return Table((*head, *_columns(origins)), body, "What the shift is worth to each method.", _CAPTION, len(several))


def by_scene(rows: pd.DataFrame) -> Table:
    """Make a line for each variant and scene."""
    origins, named = _present(rows), scene_names(rows)
    several = [name for name in ("device", "precision") if rows[name].nunique() > 1]
    body = [
        (named[str(comparison)], *(own[name].iloc[0] for name in several), own["told"].iloc[0], *_line(own, origins))
        for (comparison, *_), own in rows.groupby(["comparison", *_OF], sort=False)
    ]
    head = (Column("scene", stretch=1), *(Column(name) for name in several), Column("variant", stretch=1))
    return Table(
        (*head, *_columns(origins)), body[: tables.ROW_LIMIT], "The same, scene by scene.", "", 1 + len(several)
    )


def families_held(rungs: pd.DataFrame, facts: Mapping[str, Facts]) -> Table | None:
    """Count the families of hard rays that each variant holds from each origin.

    The table also names those that a variant holds from the eye alone and from the nearest point alone. None unless
    some variant's rays began at both.
    """
    rungs = rungs[rungs["origin"].notna()] if len(rungs) else rungs
    if rungs.empty or rungs["origin"].nunique() < 2:
        return None
    origins, body = _present(rungs), []
    origin_of = dict(zip(rungs["variant"], rungs["origin"], strict=True))
    for device, own in breaks.by_device(rungs).items():
        verdicts = breaks.verdicts(own)
        verdicts = verdicts[verdicts["decided"] > 0].assign(origin=lambda rows: rows["variant"].map(origin_of))
        verdicts = verdicts.assign(caster=derive.casters(verdicts), held=verdicts["breaks_at"].isna())
        for (precision, _), rows in verdicts.groupby(["precision", "caster"], sort=False):
            by = rows.pivot_table(index="family", columns="origin", values="held", aggfunc="all").dropna()
            if {*by} >= {"nearest", "eye"}:
                lost, won = (
                    ", ".join(facts[str(family)].title for family in by.index[by[one] & ~by[other]]) or "none"
                    for one, other in (("nearest", "eye"), ("eye", "nearest"))
                )
                held = (int(by[origin].sum()) if origin in by else None for origin in origins)
                body.append((precision, device, _without_origin(rows).iloc[0], len(by), *held, lost, won))
    columns = (
        Column("precision"),
        Column("device"),
        Column("variant", stretch=2),
        Column("of", wording.count, numeric=True),
        *(Column(origin, wording.count, numeric=True, over="families held") for origin in origins),
        Column("held only when moved", stretch=4),
        Column("held only from the eye", stretch=3),
    )
    caption = "Held as where each method breaks; “of” counts the families with decided rays from every origin."
    return Table(columns, body, "Families of hard rays held from each origin.", caption, 2) if body else None


def _held(of: Table) -> str:
    """Say in two sentences what the shift does to families of hard rays, from the table of `families_held`."""
    place = {column.title: k for k, column in enumerate(of.columns)}
    held = [(row[place["nearest"]], row[place["eye"]], row) for row in of.rows]
    alike = [f"{row[place['variant']]} in {row[place['precision']]}" for near, eye, row in held if near == eye]
    total = sum(row[place["of"]] for _, _, row in held)
    moved, given = sum(near for near, *_ in held), sum(eye for _, eye, _ in held)
    return (
        f"Of {total:,} pairs of a variant and a family of hard rays, {moved:,} are held with the origins moved next to "
        f"the domain's centre, and {given:,} with rays that begin at the eye. As many from either: "
        f"{wording.listed(alike) or 'none'}."
    )
