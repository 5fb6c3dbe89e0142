"""Families of hard rays: where each method breaks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from harness.contract import CellStatus
from reports import wording
from reports.analysis import breaks, derive
from reports.content import Block, Column, Matrix, Section, Square, Table, Text
from reports.drawing import ladders, shades, tables
from reports.material import Material
from reports.reading.run import Facts
from reports.reading.tuples import tuples

ORDER = 45
NOTHING_DECIDED = "nothing decided"
MOST_TOLD = 3  # families that a line of the first page's table names
READ = (
    "A family is a ladder of rays that get harder rung by rung; each ray has a certified answer. A square counts the "
    f"rungs on which a method is right on at least {wording.share(breaks.HELD)} of the rays that can be decided: dark "
    "squares hold the whole ladder, and the brighter one is, the sooner the method breaks."
)
EXPLANATION = (
    "Here, unlike in pictures, rays near tangency are not excused. A ray is undecidable where rounding the coordinates "
    "of its points in the cell's precision already turns it into one with other roots: it counts neither for nor "
    "against a method. A method breaks on the first rung where it is right on less than "
    f"{wording.share(breaks.HELD)} of the decided rays: where a rung has fewer than 100, one certified wrong answer is "
    "enough. A wrong root is a later root or a place that is none; exhausted is a ray that gave up. Decided rays may "
    "graze the surface, or f may drown in its rounding on them: claims of no false hit except such rays, so that these "
    "counts do not break them. Its worst error is over what the problem allows, max(condition, 1) × unit roundoff × "
    "the domain's radius: a small number for a method that is as good as the problem."
)
LADDERS = (
    "Share of the decided rays answered rightly, rung by rung: harder to the right, better at the top. A line that "
    "stays at the top is a method that holds. On hatched rungs no ray can be decided in that precision; the hollow "
    "marks there show the share of undecidable rays answered as the oracle does, for what that is worth."
)


def sections(material: Material) -> list[Section]:
    """Make the section: a matrix for each precision, with tables and ladders as details; [] without a family."""
    rungs, facts = material.rungs, material.run.plan.facts
    if rungs.empty:
        return []
    devices = breaks.by_device(rungs)
    found = {device: breaks.verdicts(rows) for device, rows in devices.items()}
    first, *rest = found
    refused = _refused(material.run.families)
    shown: list[Block] = [Text(READ), *(Text(told) for told in _said(found[first], facts))]
    if rungs["device"].nunique() > 1:
        shown.append(Text(_agreement(rungs, devices)))
    shown += _matrices(found[first], facts, refused, first)
    details = [block for device in rest for block in _matrices(found[device], facts, refused, device)]
    details.append(Text(EXPLANATION))
    for device, verdicts in found.items():
        details += [table(own, facts, f"{name} on {device}.") for name, own in verdicts.groupby("precision")]
    details.append(_why_hard({name: told for name, told in facts.items() if name in set(rungs["family"])}))
    details.append(Text(LADDERS))
    for family in rungs["family"].unique():
        own = {device: rows[rows["family"] == family] for device, rows in devices.items()}
        details.append(ladders.figure(own, facts[str(family)], material.marks))
    return [Section("Where each method breaks", tuple(shown), tuple(details), own_page=True, name="Stability")]


def _refused(families: pd.DataFrame) -> dict[tuple[str, str, str], str]:
    """Return why a variant was not run on a family, by family, precision and variant."""
    rows = families[families["status"] != CellStatus.OK]
    return {(r.family, r.precision, r.variant): str(r.reason) for r in tuples(rows)}


def _agreement(rungs: pd.DataFrame, devices: Mapping[str, pd.DataFrame]) -> str:
    """Say whether the devices agree; `devices` is what breaks.by_device returns."""
    named = wording.listed(sorted(set(rungs["device"])))
    if breaks.ALL_DEVICES in devices:
        return f"All devices agree on every count of every rung they ran: {named}. Errors are the worst of any."
    return f"The devices differ ({named}): here is {next(iter(devices))}, and the others are among the details."


def _said(verdicts: pd.DataFrame, facts: Mapping[str, Facts]) -> list[str]:
    """Say for each precision who holds most, what nobody holds and what everybody holds."""
    told = []
    for precision, own in verdicts[verdicts["decided"] > 0].groupby("precision"):
        held = own.assign(held=own["breaks_at"].isna())
        tally = held.groupby("label", sort=False)["held"].sum()
        best = list(tally.index[tally == tally.max()])
        named = wording.listed(best) if len(best) <= 3 else f"{wording.listed(best[:2])} and {len(best) - 2} more"
        by_family = held.groupby("family", sort=False)["held"]
        none, every = ([facts[str(f)].title for f in of.index[of]] for of in (~by_family.any(), by_family.all()))
        sentence = f"In {precision}, {named} {'hold' if len(best) > 1 else 'holds'} most"
        sentence += f", {tally.max()} of {by_family.ngroups} families."
        sentence += f" No method holds {wording.listed(none)}." if none else ""
        sentence += f" All that take them hold {wording.listed(every)}." if every else ""
        told.append(sentence)
    return told


def _matrices(
    verdicts: pd.DataFrame, facts: Mapping[str, Facts], refused: Mapping[tuple[str, str, str], str], device: str
) -> list[Block]:
    """Make a matrix of families and methods for each precision, from the verdicts of one device."""
    return [
        _matrix(own, facts, {(f, v): why for (f, p, v), why in refused.items() if p == precision}, device)
        for precision, own in verdicts.groupby("precision")
    ]


def _matrix(
    verdicts: pd.DataFrame, facts: Mapping[str, Facts], refused: Mapping[tuple[str, str], str], device: str
) -> Matrix:
    """Make the matrix of one device and precision: of each method the variant that holds most rungs.

    The methods that hold most are on the left, the families that most methods hold on the top.
    """
    several = verdicts.groupby("method")["variant"].nunique() > 1
    best = breaks.best_of_each_method(verdicts)
    share = (best["rungs_held"] / best["rungs_decided"]).where(best["rungs_decided"] > 0)
    best = best.assign(held_share=share.astype("float64"))
    methods = best.groupby(["variant", "method", "label", "method_label"], sort=False)["held_share"].sum()
    methods = methods.sort_values(ascending=False, kind="stable")
    families = best.groupby("family", sort=False)["held_share"].mean().sort_values(ascending=False, kind="stable")
    by_place = {(r.family, r.variant): r for r in tuples(best)}
    rows = []
    for family in map(str, families.index):
        squares = [
            _square(by_place.get((family, variant)), facts[family], refused.get((family, variant)))
            for variant, *_ in methods.index
        ]
        rows.append((facts[family].title, tuple(squares)))
    precision, chosen = verdicts["precision"].iloc[0], [several[method] for _, method, *_ in methods.index]
    return Matrix(
        tuple(label if more else name for (*_, label, name), more in zip(methods.index, chosen, strict=True)),
        rows,
        f"{precision} on {device}: rungs of each ladder that a method holds.",
        f"{wording.REFUSED} the method refuses the family; {wording.NONE} no ray of it can be decided in {precision}."
        + (" Of several variants of a method, the one that holds most rungs." if any(chosen) else ""),
        "family",
        shades.key({0.0: "holds the whole ladder", 0.5: "half of it", 1.0: "breaks at once"}),
    )


def _square(verdict: Any, facts: Facts, refusal: str | None) -> Square:
    """Make a square of the share of a ladder that holds; `verdict` is None where the variant has none."""
    if verdict is None:
        return shades.silent("", "not run") if refusal is None else shades.silent(wording.REFUSED, refusal)
    named = f"{verdict.label}, {facts.title}"
    if not verdict.rungs_decided:
        return shades.silent(wording.NONE, f"{named}: {NOTHING_DECIDED}")
    held, of = int(verdict.rungs_held), int(verdict.rungs_decided)
    if wording.absent(verdict.breaks_at):
        return Square("all", shades.shade(0.0), f"{named}: holds all {wording.plural(of, 'rung')}")
    broken = f"breaks at {wording.level(verdict.breaks_at)} ({facts.parameter}), by {_how(verdict)}"
    note = f"{named}: holds {held} of {wording.plural(of, 'rung')}; {broken}"
    return Square(f"{held}/{of}", shades.shade(1.0 - held / of), note)


def table(verdicts: pd.DataFrame, facts: Mapping[str, Facts], title: str) -> Table:
    """Make a line for each family and variant, from the verdicts of one device and precision."""
    kinds = derive.kinds(verdicts)
    body = []
    for row in tuples(verdicts):
        right = (row.share_right, *(getattr(row, kind) for kind in kinds))
        known = (row.decided, *(right if row.decided else (None,) * len(right)), row.worst_ratio)
        body.append(
            (
                facts[row.family].title,
                row.label,
                _outcome(row),
                _how(row),
                *known,
                row.undecidable,
                row.undecidable_right,
            )
        )
    decided, undecidable = "decided rays", "undecidable rays"
    return Table(
        (
            Column("family"),
            Column("variant", stretch=1),
            Column("breaks at", _written, numeric=True),
            Column("by"),
            Column("rays", wording.count, numeric=True, over=decided),
            Column("right", wording.portion, numeric=True, over=decided),
            *(Column(tables.WRONG[kind], wording.count, numeric=True, over=decided) for kind in kinds),
            Column("worst error over\ncondition × roundoff", wording.short, numeric=True, over=decided),
            Column("rays", wording.count, numeric=True, over=undecidable),
            Column("right", wording.count, numeric=True, over=undecidable),
        ),
        body,
        f"Where each method breaks: {title}",
        "The parameter at which a variant breaks is explained below for each family. Look for families that a variant "
        f"holds with a large worst error: right roots, but badly computed.{wording.zeros(verdicts['worst_ratio'])}",
        group=1,
    )


def _outcome(verdict: Any) -> str | float:
    """Return the parameter that breaks a variant, "holds" where none does, or NOTHING_DECIDED."""
    if not verdict.decided:
        return NOTHING_DECIDED
    return "holds" if wording.absent(verdict.breaks_at) else float(verdict.breaks_at)


def _how(verdict: Any) -> str | None:
    """Return what breaks a variant on the first rung that does; None where none does."""
    return None if wording.absent(verdict.breaks_by) else wording.WRONG_RAYS[verdict.breaks_by]


def _written(value: str | float) -> str:
    """Write an outcome: a text as it is, a parameter as `wording.level` does."""
    return value if isinstance(value, str) else wording.level(value)


def _why_hard(facts: Mapping[str, Facts]) -> Table:
    """Make a line for each family: why it is hard, and what its parameter is."""
    body = [(told.title, told.why, told.parameter, told.harder, told.source) for told in facts.values()]
    return Table(
        (
            Column("family"),
            Column("why it is hard", stretch=5),
            Column("its parameter", stretch=4),
            Column("harder\nwhen"),
            Column("source", stretch=2),
        ),
        body,
        "Why each family is hard.",
    )


def summary_table(rungs: pd.DataFrame, facts: Mapping[str, Facts]) -> Table:
    """Make a line for each variant and precision: how many families it holds, and what breaks it."""
    devices = breaks.by_device(rungs)
    body: list[tuple[Any, ...]] = []
    for device, rows in devices.items():
        for (variant, precision), own in breaks.verdicts(rows).groupby(["label", "precision"], sort=False):
            judged = own[own["decided"] > 0]
            broken = judged[judged["breaks_at"].notna()]
            each = [f"{facts[r.family].title} {wording.level(r.breaks_at)}" for r in tuples(broken)]
            more = f" and {len(each) - MOST_TOLD} more" if len(each) > MOST_TOLD else ""
            told = ", ".join(each[:MOST_TOLD]) + more
            held = judged[judged["breaks_at"].isna()]
            tally = (len(held), len(judged), held["worst_ratio"].max())
            body.append((precision, device, variant, *tally, told or "nothing"))
    body.sort(key=lambda row: (row[0], row[1], -row[3]))
    worst = [row[5] for row in body]
    columns: tuple[Column, ...] = (
        Column("precision"),
        Column("device"),
        Column("variant", stretch=2),
        Column("holds", wording.count, numeric=True),
        Column("of", wording.count, numeric=True),
        Column("worst\nerror", wording.short, numeric=True),
        Column("is broken by, at", stretch=5),
    )
    if len(devices) == 1:
        columns, body = columns[:1] + columns[2:], [row[:1] + row[2:] for row in body]
    where = f" On {wording.listed(list(devices))}." if len(devices) == 1 else ""
    return Table(
        columns,
        body,
        f"Which families of hard rays each variant holds, and what breaks it.{where}",
        "“Of” counts the families with decided rays that the variant was run on and accepts. Held is a family with "
        f"at least {wording.share(breaks.HELD)} of the decided rays right on every rung; worst error is over "
        f"condition × unit roundoff, in the families held.{wording.zeros(worst)} Behind each family that breaks a "
        "variant stands the first parameter that does.",
        group=1 if len(devices) == 1 else 2,
    )


def verdict(rungs: pd.DataFrame) -> str:
    """Say in one sentence which variants hold most families in each precision, on every device."""
    rows = pd.concat([breaks.verdicts(own) for own in breaks.by_device(rungs).values()])
    rows = rows[rows["decided"] > 0].assign(held=lambda judged: judged["breaks_at"].isna())
    if rows.empty:
        return "No family of hard rays has a ray that its precision can decide."
    tallies = []
    for precision, own in rows.groupby("precision"):
        by_variant = own.groupby(["label", "family"])["held"].all().groupby("label")
        held, tried = by_variant.sum(), by_variant.size()
        families = own["family"].nunique()
        tried = tried[held == held.max()].sort_index()
        best = [name if n == families else f"{name} (which answers {n})" for name, n in tried.items()]
        tallies.append(f"by {wording.listed(best)} in {precision} ({held.max()} of {families})")
    where = f"On {wording.listed(sorted(set(rungs['device'])))}"
    return f"{where}, the most families of hard rays are held {wording.listed(tallies)}."
