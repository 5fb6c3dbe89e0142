"""Say who breaks where: every method on every surface of the gallery, or of any run with many surfaces."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from harness.results.schema import KINDS
from reports import wording
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import tables
from reports.material import Material

ORDER = 9  # before the winners: what is right comes before what is fast
MANY = 30  # surfaces, from which on a run without the gallery has the section too
CATALOG, OTHERS = "catalog", "others"
RIGHT, REFUSED, NOTHING = "✓", "·", "?"
WORDS = {
    "misses": "misses",
    "false_hits": "false hits",
    "exhausted": "rays given up",
    "wrong_root": "later roots",
    "invalid": "impossible answers",
}
LETTERS = {"misses": "m", "false_hits": "f", "exhausted": "e", "wrong_root": "r", "invalid": "i"}
BREAKS = {  # what a broken claim is, by the kind of wrong ray that breaks it
    "no_false_hit": "false_hits",
    "no_missed_root": "misses",
}
KEY = (
    f"{RIGHT}: right on every ray that is neither grazing nor drowned. A share: of these rays, how many are wrong, and "
    "how most of them are: m missed the surface, f hit where nothing is, e gave up, r a later root or none, i an "
    f"impossible answer. {REFUSED}: the method refuses the surface. {NOTHING}: the cell failed, or has nothing to "
    "judge; its reason is listed at the end of the report."
)


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has neither the gallery nor many surfaces."""
    rows = material.frame[material.frame["answers"].astype(bool) & material.frame["scene"].isna()]
    groups = rows["surface_group"].dropna()
    if rows.empty or (set(groups) <= {CATALOG} and rows["surface"].nunique() < MANY):
        return []
    rows = rows.assign(group=rows["surface_group"].fillna(OTHERS))
    blocks: list[Block] = [Text(KEY), *_broken(rows, material)]
    for (precision, device), own in rows.groupby(["precision", "device"], sort=False):
        place = f"{precision} on {device}"
        judged = _worst(own)
        blocks += [_by_group(judged, place), _classes(judged, place), _matrix(judged, place)]
    refusals = _refusals(rows)
    return [Section("Who breaks where", (*blocks, *([refusals] if refusals else [])))]


def _worst(rows: pd.DataFrame) -> pd.DataFrame:
    """Return one row for each surface and variant: that of its worst view.

    Adds `share`, of its clear and decided rays those that are wrong; missing where nothing was judged.
    """
    share = (rows["wrong_rays"] / rows["judged"]).astype("Float64").where(rows["judged"] > 0)
    rows = rows.assign(share=share.where(rows["status"] == CellStatus.OK))
    placed = rows.sort_values("share", ascending=False, na_position="last", kind="stable")
    return placed.drop_duplicates(["surface", "variant"]).sort_index()


def _main_kind(row: Any) -> str:
    """Return the kind that most of a row's wrong rays are of."""
    return max(KINDS, key=lambda kind: 0 if wording.absent(getattr(row, kind)) else int(getattr(row, kind)))


def _mark(row: Any) -> str:
    """Write what became of a variant on a surface, as KEY explains."""
    if row.status == CellStatus.SKIPPED:
        return REFUSED
    if wording.absent(row.share):
        return NOTHING
    return RIGHT if row.share == 0 else f"{wording.share(row.share)} {LETTERS[_main_kind(row)]}"


def _heading(variant: str) -> str:
    """Break a variant's name where a narrow column may break it."""
    return variant.replace("_", "_\n").replace("[", "\n[")


def _by_group(judged: pd.DataFrame, place: str) -> Table:
    """Make a line for each group: on how many of its surfaces each variant is right on every ray."""
    variants = list(dict.fromkeys(judged["variant"]))
    body = []
    for group, own in judged.groupby("group", sort=False):
        cells: list[str] = []
        for variant in variants:
            taken = own[(own["variant"] == variant) & own["share"].notna()]
            right = int((taken["share"] == 0).sum())
            cells.append(f"{right} / {len(taken)}" if len(taken) else REFUSED)
        body.append((str(group).replace("_", " "), own["surface"].nunique(), *cells))
    return Table(
        (
            Column("group"),
            Column("surfaces", wording.count, numeric=True),
            *(Column(_heading(v), numeric=True) for v in variants),
        ),
        body,
        f"How many surfaces of each group a method draws rightly, {place}.",
        "The first number counts surfaces with every ray right, the second those that the method takes and was judged "
        f"on; {REFUSED} where it takes none.",
        group=1,
    )


def _classes(judged: pd.DataFrame, place: str) -> Table:
    """Make a line for each variant: on how many surfaces it is wrong, and the groups where it breaks, in words."""
    body = []
    for variant, own in judged.groupby("variant", sort=False):
        taken = own[own["share"].notna()]
        wrong = taken[taken["share"] > 0]
        body.append((variant, len(taken), len(wrong), _told(taken, wrong)))
    body.sort(key=lambda line: (line[2] / max(line[1], 1), -line[1]))
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
        "wrong rays, the share, and what most of them are.",
        group=1,
    )


def _told(taken: pd.DataFrame, wrong: pd.DataFrame) -> str:
    """Say in which groups a variant is wrong, and how."""
    if wrong.empty:
        return "nowhere: every ray of every surface is right" if len(taken) else "it takes none of these surfaces"
    told = []
    for group, own in wrong.groupby("group", sort=False):
        of = int((taken["group"] == group).sum())
        worst = next(own.sort_values("share", ascending=False, kind="stable").head(1).itertuples())
        what = f"{worst.surface} {wording.share(worst.share)}, {WORDS[_main_kind(worst)]}"
        told.append((len(own) / of, f"{str(group).replace('_', ' ')} {len(own)} of {of} ({what})"))
    return "; ".join(text for _, text in sorted(told, key=lambda item: -item[0]))


def _matrix(judged: pd.DataFrame, place: str) -> Table:
    """Make a line for each surface and a column for each variant, with the marks of KEY."""
    variants = list(dict.fromkeys(judged["variant"]))
    body = []
    for (group, surface), own in judged.groupby(["group", "surface"], sort=False):
        marks = {row.variant: _mark(row) for row in own.itertuples()}
        degree = next(iter(own["degree"]))
        told = None if wording.absent(degree) else int(degree)
        body.append((str(group).replace("_", " "), surface, told, *(marks.get(v) for v in variants)))
    return Table(
        (
            Column("group"),
            Column("surface"),
            Column("degree", numeric=True),
            *(Column(_heading(v), numeric=True) for v in variants),
        ),
        body[: tables.ROW_LIMIT],
        f"Every surface and method, {place}.",
        f"Of several views, the worst.{wording.first_of(min(len(body), tables.ROW_LIMIT), len(body))}",
        group=1,
    )


def _refusals(rows: pd.DataFrame) -> Table | None:
    """Make a line for each method and reason to refuse a surface; None where none is refused."""
    refused = rows[rows["status"] == CellStatus.SKIPPED]
    if refused.empty:
        return None
    reasons = [_shared(str(row.reason), str(row.surface)) for row in refused.itertuples()]
    refused = refused.assign(reason=reasons).drop_duplicates(["surface", "method", "reason"])
    body = []
    for (method, reason), own in refused.groupby(["method", "reason"], sort=True):
        told = ", ".join(f"{str(group).replace('_', ' ')} {n}" for group, n in Counter(own["group"]).most_common())
        body.append((method, wording.excerpt(str(reason), 200), own["surface"].nunique(), told))
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
        claims: list[str] = list(_stated(material.run.plan.methods, str(method)))
        for claim in claims:
            kind = BREAKS.get(claim)
            against = own[own[kind] > 0] if kind else own.head(0)
            if len(against):
                where = ", ".join(dict.fromkeys(against["surface"]))
                found.append(
                    Text(f"{method} claims {claim}, and {WORDS[str(kind)]} of clear rays break it on: {where}.", True)
                )
    return [*found, _undecided(rows)]


def _stated(methods: Mapping[str, Mapping[str, Any]], method: str) -> list[str]:
    """Return what a method claims, as the plan tells it."""
    claims = methods.get(method, {}).get("claims", [])
    return [str(claim) for claim in claims]


def _undecided(rows: pd.DataFrame) -> Text:
    """Say on which surfaces the oracle is undecided on more than 0.1 % of the rays."""
    known = rows[rows["undecided"].notna() & (rows["accuracy_rays"] > 0)]
    shares = (known["undecided"] / known["accuracy_rays"]).groupby(known["surface"]).max()
    over = shares[shares > 0.001].sort_values(ascending=False)
    if over.empty:
        return Text("On no surface does the oracle leave more than 0.1 % of the rays undecided.")
    told = wording.listed([f"{surface} ({wording.share(share)})" for surface, share in over.items()])
    return Text(f"The oracle leaves more than 0.1 % of the rays undecided on {told}.", True)
