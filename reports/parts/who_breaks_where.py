"""Say who breaks where: every method on every surface of the gallery, or of any run with many surfaces."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from harness.results.schema import KINDS
from reports import wording
from reports.analysis import derive, surface_names
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import shades
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 9  # before the winners: what is right comes before what is fast
MANY = 30  # surfaces, from which on a run without the gallery has the section too
CATALOG, OTHERS = "catalog", "others"
RIGHT, NOTHING = "✓", "?"
WORDS = wording.WRONG_RAYS
LETTERS = {"misses": "m", "false_hits": "f", "exhausted": "e", "wrong_root": "r", "invalid": "i"}
BREAKS = {  # what a broken claim is, by the kind of wrong ray that breaks it
    "no_false_hit": "false_hits",
    "no_missed_root": "misses",
}
KEY = (
    f"{RIGHT}: right on every ray that is neither grazing nor drowned. A number: how many per cent of these rays are "
    "wrong, and how most of them are: m missed the surface, f hit where nothing is, e gave up, r hit a wrong root, "
    f"i gave an invalid answer. {wording.REFUSED}: the method refuses the surface. {NOTHING}: the cell failed, or has "
    "nothing to judge; its reason is listed at the end of the report."
)
MOST_COLUMNS = 16
MOST_LINES = 200  # variants of the table in words; a run of more has those that are right on most surfaces
_READ = [
    *("run", "key", "slot", "comparison", "method", "variant", "label", "method_label", "status", "reason"),
    *("surface", "surface_title", "surface_group", "degree", "view", "size", "precision", "device"),
    *("judged", "undecided", "accuracy_rays", "truth_hits", "grazing", "wrong_rays", *KINDS),
]  # columns: a frame of 10^6 rows and all columns is not copied for this
SETTINGS = 3  # of a method whose broken claim is told
MOST_PRINTED = 110  # surfaces; the matrix of all is among the details
FIRST_WRONG = 0.35  # how bad, from 0 to 1, the colour is of a surface with 1 in 1,000 rays wrong


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has neither the gallery nor many surfaces."""
    rows = material.frame.loc[material.frame["answers"].astype(bool) & material.frame["scene"].isna(), _READ]
    groups = rows["surface_group"].dropna()
    if rows.empty or (set(groups) <= {CATALOG} and rows["surface"].nunique() < MANY):
        return []
    rows = rows.assign(group=rows["surface_group"].fillna(OTHERS))
    broken, undecided = _broken(rows, material), _undecided(rows)
    shown: list[Block] = []
    details: list[Block] = [*broken, undecided]
    places = [(f"{precision} on {device}", own) for (precision, device), own in rows.groupby(["precision", "device"])]
    for place, own in sorted(places, key=lambda found: -found[1]["surface"].nunique()):
        by_variant = _worst(own)
        judged = _best_of_each_method(by_variant)
        groups, every = _by_group(judged, place), _matrix(judged, f"Every surface and method, {place}.")
        if not shown:
            worst = _broken_surfaces(judged)
            told = f"The surfaces on which a method is wrong, {place}."
            shown = [Text(f"{_said(judged)} {KEY}"), *_shortened(broken), *([groups] if len(groups.rows) > 1 else [])]
            shown += [_matrix(worst, told)] if len(worst) else []
            details += [*([] if len(groups.rows) > 1 else [groups]), _classes(by_variant, place), every]
        else:
            details += [groups, _classes(by_variant, place), every]
    refusals = _refusals(rows)
    details += [refusals] if refusals else []
    return [Section("Who breaks where", tuple(shown), tuple(details), own_page=True)]


def _said(judged: pd.DataFrame) -> str:
    """Say which method is right on most surfaces, and which is wrong on most."""
    taken = judged[judged["share"].notna()]
    if taken.empty:
        return ""
    right = (taken["share"] == 0).groupby(taken["label"], sort=False).agg(["sum", "size"])
    best, worst = right["sum"].idxmax(), (right["size"] - right["sum"]).idxmax()
    surfaces = judged["surface"].nunique()
    told = f"{best} is right on every ray of most: {right['sum'][best]} of the {right['size'][best]} it takes"
    wrong = int(right["size"][worst] - right["sum"][worst])
    least = f"; {worst} is wrong on most: {wrong} of {right['size'][worst]}" if wrong else ""
    printed = surface_names.printed_alone(judged)["surface"].nunique()
    forms = f" ({printed}, some of them in several forms of their formula)" if printed < surfaces else ""
    return f"Of {wording.plural(surfaces, 'surface')}{forms}, {told}{least}."


def _shortened(told: Sequence[Text]) -> list[Text]:
    """Return these texts, each cut to what a line or two hold."""
    return [Text(wording.excerpt(text.text, 260)) for text in told]


def _broken_surfaces(judged: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of the surfaces on which a method is wrong: at most MOST_PRINTED, those that break most methods.

    They keep their order.
    """
    wrong = (judged["share"] > 0).fillna(False).groupby(judged["surface"], sort=False).sum()
    kept = wrong[wrong > 0].sort_values(ascending=False, kind="stable").head(MOST_PRINTED)
    return judged[judged["surface"].isin(set(kept.index))]


def _worst(rows: pd.DataFrame) -> pd.DataFrame:
    """Return one row for each surface and variant: that of its worst view.

    Adds `share`, of its clear and decided rays those that are wrong; missing where nothing was judged. `named` is what
    notes call the variant.
    """
    share = (rows["wrong_rays"] / rows["judged"]).astype("Float64").where(rows["judged"] > 0)
    rows = rows.assign(share=share.where(derive.is_judged(rows)))
    rows = rows.assign(named=rows["label"])
    placed = rows.sort_values("share", ascending=False, na_position="last", kind="stable")
    return placed.drop_duplicates(["surface", "variant"]).sort_index()


def _best_of_each_method(judged: pd.DataFrame) -> pd.DataFrame:
    """Return one row for each surface and method, that of the variant with fewest wrong rays, named by its method.

    Return all rows where the variants are few enough for a column each.
    """
    if judged["variant"].nunique() <= MOST_COLUMNS:
        return judged
    placed = judged.sort_values("share", na_position="last", kind="stable").drop_duplicates(["surface", "method"])
    return placed.sort_index().assign(variant=placed["method"], label=placed["method_label"])


def _main_kind(row: Any) -> str:
    """Return the kind that most of a row's wrong rays are of."""
    return max(KINDS, key=lambda kind: 0 if wording.absent(getattr(row, kind)) else int(getattr(row, kind)))


def _square(row: Any) -> Square:
    """Make the square of a variant on a surface, as KEY explains."""
    named = f"{row.named}, {row.surface_title}"
    if row.status == CellStatus.SKIPPED:
        return shades.silent(wording.REFUSED, f"{named}: refused, {wording.excerpt(str(row.reason), 200)}")
    if wording.absent(row.share):
        return shades.silent(NOTHING, f"{named}: {row.status}, nothing judged")
    if row.share == 0:
        return Square(RIGHT, shades.shade(0.0), f"{named}: every ray right")
    kind = _main_kind(row)
    badness = FIRST_WRONG + (1.0 - FIRST_WRONG) * (1.0 + math.log10(max(float(row.share), 1e-3)) / 3.0)
    note = f"{named}: {wording.share(row.share)} wrong, most of them {WORDS[kind]}"
    return Square(f"{_percent(row.share)} {LETTERS[kind]}", shades.shade(badness), note)


def _percent(share: float) -> str:
    """Write a share of one in per cent, without the sign."""
    return wording.share(share).replace(" %", "").replace("< ", "<")


def _columns(judged: pd.DataFrame) -> dict[str, str]:
    """Return the heading of each variant: its method's name, or its label where the method has several."""
    named = judged.drop_duplicates("variant")
    several = named["method"].duplicated(keep=False)
    told = named["label"].where(several, named["method_label"])
    return {str(variant): str(heading) for variant, heading in zip(named["variant"], told, strict=True)}


def _titles(judged: pd.DataFrame) -> dict[str, str]:
    """Return the written name of each group of surfaces, in their order."""
    return {str(group): str(group).replace("_", " ").capitalize() for group in judged["group"].unique()}


def _by_group(judged: pd.DataFrame, place: str) -> Matrix:
    """Make a line for each group: on how many of its surfaces each variant is right on every ray."""
    columns, titles = _columns(judged), _titles(judged)
    body = []
    for group, own in judged.groupby("group", sort=False):
        squares = []
        for variant in columns:
            taken = own[(own["variant"] == variant) & own["share"].notna()]
            right = int((taken["share"] == 0).sum())
            note = f"right on {right} of the {wording.plural(len(taken), 'surface')} that it takes and was judged on"
            share = right / max(len(taken), 1)
            made = Square(f"{right}/{len(taken)}", shades.shade(1.0 - share), note)
            squares.append(made if len(taken) else shades.silent(wording.REFUSED, "takes none of them"))
        body.append((f"{titles[str(group)]}, {own['surface'].nunique()}", tuple(squares)))
    return Matrix(
        tuple(columns.values()),
        body,
        f"On how many surfaces of each group every ray is right, {place}.",
        f"Of those that the method takes; {wording.REFUSED} it takes none.",
        "group, surfaces",
        shades.key({0.0: "right on all", 0.5: "on half of them", 1.0: "on none"}),
    )


def _classes(judged: pd.DataFrame, place: str) -> Table:
    """Make a line for each variant: on how many surfaces it is wrong, and the groups where it breaks, in words."""
    share, body = judged["share"], []
    counted = pd.DataFrame({"taken": share.notna(), "wrong": (share > 0).fillna(False).astype(bool)})
    counts = counted.groupby(judged["variant"], sort=False).sum()
    lines = sorted(tuples(counts), key=lambda line: (line.wrong / max(line.taken, 1), -line.taken))
    places = judged.groupby("variant", sort=False).indices
    for line in lines[:MOST_LINES]:  # of some thousand variants only these are looked at one by one
        own = judged.take(places[line.Index])
        taken = own[own["share"].notna()]
        wrong = taken[taken["share"] > 0]
        body.append((own["label"].iloc[0], len(taken), len(wrong), _told(taken, wrong)))
    cut = wording.first_of(len(body), len(lines))
    return Table(
        (
            Column("variant"),
            Column("surfaces\ntaken", wording.count, numeric=True),
            Column("wrong on", wording.count, numeric=True),
            Column("where it breaks", stretch=1),
        ),
        body,
        f"Where each method breaks, in words, {place}.",
        "Groups by the share of their surfaces with a wrong ray; in brackets the surface with the largest share of "
        f"wrong rays, the share, and what most of them are.{cut}",
        group=1,
    )


def _told(taken: pd.DataFrame, wrong: pd.DataFrame) -> str:
    """Say in which groups a variant is wrong, and how."""
    if wrong.empty:
        return "nowhere: every ray of every surface is right" if len(taken) else "it takes none of these surfaces"
    told = []
    for group, own in wrong.groupby("group", sort=False):
        of = int((taken["group"] == group).sum())
        worst = next(tuples(own.sort_values("share", ascending=False, kind="stable").head(1)))
        what = f"{worst.surface_title} {wording.share(worst.share)}, {WORDS[_main_kind(worst)]}"
        told.append((len(own) / of, f"{str(group).replace('_', ' ')} {len(own)} of {of} ({what})"))
    return "; ".join(text for _, text in sorted(told, key=lambda item: -item[0]))


def _matrix(judged: pd.DataFrame, title: str) -> Matrix:
    """Make a line for each surface and a column for each variant, with the marks of KEY."""
    columns, titles = _columns(judged), _titles(judged)
    missing = shades.silent("", "not run")
    squares = {(row.surface, row.variant): _square(row) for row in tuples(judged)}
    body: list[tuple[str, tuple[Square, ...]]] = []
    for group, grouped in judged.groupby("group", sort=False):
        if judged["group"].nunique() > 1:
            body.append((titles[str(group)], ()))
        for surface, own in grouped.groupby("surface", sort=False):
            name = wording.excerpt(str(own["surface_title"].iloc[0]), 30)
            body.append((name, tuple(squares.get((surface, variant), missing) for variant in columns)))
    return Matrix(
        tuple(columns.values()),
        body,
        title,
        "Per cent of the clear rays that are wrong. Of several views, the worst; of more variants than "
        f"{MOST_COLUMNS}, the best of each method.",
        "surface",
        shades.key({0.0: "every ray right", FIRST_WRONG: "0.1 % wrong", 1.0: "all wrong"}),
    )


def _refusals(rows: pd.DataFrame) -> Table | None:
    """Make a line for each method and reason to refuse a surface; None where none is refused."""
    refused = rows[rows["status"] == CellStatus.SKIPPED]
    if refused.empty:
        return None
    reasons = [_shared(str(row.reason), str(row.surface)) for row in tuples(refused)]
    refused = refused.assign(reason=reasons).drop_duplicates(["surface", "method", "reason"])
    body = []
    for (_, reason), own in refused.groupby(["method", "reason"], sort=True):
        told = ", ".join(f"{str(group).replace('_', ' ')} {n}" for group, n in Counter(own["group"]).most_common())
        body.append((own["method_label"].iloc[0], wording.excerpt(str(reason), 200), own["surface"].nunique(), told))
    return Table(
        (
            Column("method"),
            Column("why it refuses", stretch=2),
            Column("surfaces", wording.count, numeric=True),
            Column("in the groups", stretch=2),
        ),
        body,
        "Which surfaces each method refuses, and why.",
        group=1,
    )


def _shared(reason: str, surface: str) -> str:
    """Return a reason without what is the surface's own: its name and its degree."""
    return re.sub(r"degree \d+", "its degree", reason.removeprefix(f"the method refuses the surface {surface}: "))


def _broken(rows: pd.DataFrame, material: Material) -> list[Text]:
    """Say of each method that claims something whether rays of this run break it, and where the oracle is undecided."""
    found = []
    for method, own in rows[rows["accuracy_rays"].notna()].groupby("method", sort=True):
        name = own["method_label"].iloc[0]
        claims: list[str] = list(_stated(material.run.plan.methods, str(method)))
        for claim in claims:
            kind = BREAKS.get(claim)
            against = own[own[kind] > 0] if kind else own.head(0)
            if len(against):
                claimed = claim.replace("_", " ")
                told = (
                    f"{name} claims {claimed}, and {WORDS[str(kind)]} of clear rays break it: {_by_setting(against)}."
                )
                found.append(Text(told, True))
    return found


def _by_setting(against: pd.DataFrame) -> str:
    """Name the settings of a method that break its claim, each with its surfaces; at most SETTINGS, worst first."""
    each = [
        (len(titles), f"{label} on {', '.join(titles)}")
        for label, own in against.groupby("label", sort=False)
        for titles in [list(dict.fromkeys(own["surface_title"]))]
    ]
    each.sort(key=lambda pair: -pair[0])
    more = [f"{len(each) - SETTINGS} more settings"] if len(each) > SETTINGS else []
    return "; ".join([*(told for _, told in each[:SETTINGS]), *more])


def _stated(methods: Mapping[str, Mapping[str, Any]], method: str) -> list[str]:
    """Return what a method claims, as the plan tells it."""
    claims = methods.get(method, {}).get("claims", [])
    return [str(claim) for claim in claims]


def _undecided(rows: pd.DataFrame) -> Text:
    """Say on which surfaces the oracle is undecided on more than 0.1 % of the rays."""
    known = rows[rows["undecided"].notna() & (rows["accuracy_rays"] > 0)]
    shares = (known["undecided"] / known["accuracy_rays"]).groupby(known["surface_title"]).max()
    over = shares[shares > 0.001].sort_values(ascending=False)
    if over.empty:
        return Text("On no surface does the oracle leave more than 0.1 % of the rays undecided.")
    told = wording.listed([f"{surface} ({wording.share(share)})" for surface, share in over.items()])
    return Text(f"The oracle leaves more than 0.1 % of the rays undecided on {told}.", True)
