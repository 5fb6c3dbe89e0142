"""Families of hard rays: where each method breaks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import breaks, derive
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import ladders, tables
from reports.material import Material
from reports.reading.run import Facts

ORDER = 45
NOTHING_DECIDED = "nothing decided"
EXPLANATION = (
    "A family is a ladder of rays that get harder as one parameter changes. Each ray has a certified answer; here, "
    "unlike in pictures, rays near tangency are not excused. A ray is undecidable where rounding the coordinates of "
    "its points in the cell's precision already turns it into one with other roots: it counts neither for nor against "
    f"a method. A method breaks on the first rung where it is right on less than {wording.share(breaks.HELD)} of the "
    "decided rays: where a rung has fewer than 100, one certified wrong answer is enough. A wrong root is a "
    "later root or "
    "a place that is none; exhausted is a ray that gave up. Decided rays may graze the surface, or f may drown in its "
    "rounding on them: claims of no false hit except such rays, so that these counts do not break them. Its "
    "worst error is over what "
    "the problem allows, max(condition, 1) × unit roundoff × the domain's radius: a small number for a method that is "
    "as good as the problem."
)


def sections(material: Material) -> list[Section]:
    """Make a section of tables and one of drawings, a ladder for each family; [] where the run has no family."""
    rungs, facts = material.rungs, material.run.plan.facts
    if rungs.empty:
        return []
    devices = breaks.by_device(rungs)
    blocks: list[Block] = [Text(EXPLANATION)]
    if rungs["device"].nunique() > 1:
        blocks.append(Text(_agreement(rungs, devices)))
    for device, rows in devices.items():
        for precision, verdicts in breaks.verdicts(rows).groupby("precision"):
            blocks.append(table(verdicts, facts, f"{precision} on {device}."))
    blocks.append(_why_hard({name: told for name, told in facts.items() if name in set(rungs["family"])}))
    drawn = [
        ladders.figure(
            {d: rows[rows["family"] == family] for d, rows in devices.items()}, facts[str(family)], material.marks
        )
        for family in rungs["family"].unique()
    ]
    key = Text(
        "Share of the decided rays answered rightly, rung by rung: harder to the right, better at the top. A line that "
        "stays at the top is a method that holds. On hatched rungs no ray can be decided in that precision; the hollow "
        "marks there show the share of undecidable rays answered as the oracle does, for what that is worth."
    )
    return [
        Section("Where each method breaks", tuple(blocks)),
        Section("Hard rays, family by family", (key, *drawn)),
    ]


def _agreement(rungs: pd.DataFrame, devices: Mapping[str, pd.DataFrame]) -> str:
    """Say whether the devices agree; `devices` is what breaks.by_device returns."""
    named = wording.listed(sorted(set(rungs["device"])))
    if breaks.ALL_DEVICES in devices:
        return f"All devices agree on every count of every rung they ran: {named}. Errors are the worst of any."
    return f"The devices differ ({named}), so that each has its own table."


def table(verdicts: pd.DataFrame, facts: Mapping[str, Facts], title: str) -> Table:
    """Make a line for each family and variant, from the verdicts of one device and precision."""
    kinds = derive.kinds(verdicts)
    body = []
    for row in verdicts.itertuples():
        right = (row.share_right, *(getattr(row, kind) for kind in kinds))
        known = (row.decided, *(right if row.decided else (None,) * len(right)), row.worst_ratio)
        body.append(
            (facts[row.family].title, row.variant, _outcome(row), *known, row.undecidable, row.undecidable_right)
        )
    decided, undecidable = "decided rays", "undecidable rays"
    return Table(
        (
            Column("family"),
            Column("variant", stretch=1),
            Column("breaks at", _written, numeric=True),
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
        for (variant, precision), own in breaks.verdicts(rows).groupby(["variant", "precision"], sort=False):
            judged = own[own["decided"] > 0]
            broken = judged[judged["breaks_at"].notna()]
            told = ", ".join(f"{facts[r.family].title} {wording.level(r.breaks_at)}" for r in broken.itertuples())
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
        by_variant = own.groupby(["variant", "family"])["held"].all().groupby("variant")
        held, tried = by_variant.sum(), by_variant.size()
        best = [f"{name}, of {tried[name]} that it answered" for name in sorted(held.index[held == held.max()])]
        tallies.append(f"{held.max()} of {own['family'].nunique()} in {precision} ({wording.listed(best)})")
    where = f"on {wording.listed(sorted(set(rungs['device'])))}"
    most = f"the most that any variant holds are {wording.listed(tallies)}"
    return f"Families of hard rays with rays decided {where}: {most}."
