"""szente's Tables 1, 2, 4 and 5."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pandas as pd

from reports import published, wording
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import counted as summed
from reports.claims.model import largest
from reports.claims.szente_studies import bounds, condition
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Block, Column, Section, Table, Text
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 20
SEEN_1_2 = (
    "Two studies without any ray: how well conditioned the fit is, and how tight the bounds of a polynomial are. Look "
    "for figures of the paper that no reading of its text gives."
)
SEEN_4 = (
    "The fit with Yuksel's bracketing against ray marching. Compare percentages and speed-ups; milliseconds are of two "
    "devices. The speed-up over a march that does not wait, in blocks of 8 steps, is a processor's fairer figure."
)
TOLD_4 = (
    "EFT and EVAL are the share of the time that is saved with that part switched off. As printed means: f is marched "
    "step by step, and bisected to float32's precision between critical points of the fit. Step by step a processor "
    "waits for each evaluation before the next, which a GPU hides behind its other rays; in blocks of 8 steps, as our "
    "march does it, it takes the same steps without waiting, to degree 4 on f's expansion along the ray. The paper "
    "gives a cap of 10,000 steps and no step length: both marches take 10,000 across the domain's diameter, and the "
    "speed-ups grow with this number. Domains and radii are those of the authors' code, but for the sphere, which is "
    "the catalog's."
)
SEEN_5 = (
    "Lipschitz tracing by the paper's LU bound, and by control points. Compare the ratios, not the milliseconds, which "
    "are of two devices."
)
TOLD_5 = (
    "As printed means: one bound for the whole ray, of the slope's magnitude. Here LU bounds cull rays and control "
    "points do not; the paper does not say whether its control points do. The marches are Table 4's. At our best the "
    "bound is of the slope towards zero on the interval of the next step. Domains are those of the authors' code, but "
    "for the sphere, which is the catalog's."
)
MATCH = 0.03  # a reading matches Table 2 where each figure differs by at most this share
_NAMES = {
    "sphere": "Sphere",
    "torus": "Torus",
    "flirt": "Flirt",
    "calyx": "Calyx",
    "barth_sextic": "Barth sextic",
    "endrass_octic": "Endrass octic",
    "barth_decic": "Barth decic",
    "sixteen_ball": "16-Ball",
}


def sections(material: Material) -> list[Section]:
    """Make up to four sections; [] where the run has no rows for any."""
    made = (_table_1_and_2(material), _table_4(material), _changes(material), _table_5(material))
    return [section for section in made if section]


def _table_1_and_2(material: Material) -> Section | None:
    """Make the section of the two studies; None where neither was run."""
    ours = condition(material.evidence)
    blocks: list[Block] = []
    if not ours.empty:
        blocks.append(_table_1(ours))
    figures = bounds(material.evidence)
    if not figures.empty:
        blocks.append(_table_2(figures))
    if not blocks:
        return None
    details = verdict_tables(material.judged, "szente-tables-1-2.toml", "szente, Tables 1 and 2")
    return Section(
        "szente, Tables 1 and 2",
        (introduced(SEEN_1_2, material.judged, "szente-tables-1-2.toml"), *blocks),
        tuple(details),
    )


def _table_1(ours: pd.DataFrame) -> Table:
    """Compare our condition numbers with the paper's."""
    paper = published.table("szente_table1_condition")
    body: list[tuple[Any, ...]] = []
    for basis, row in ours.iterrows():
        for n, value in row.items():
            printed = paper.number(f"degree_{n}", basis=str(basis))
            same = None if printed is None else "yes" if f"{value:.2f}" == f"{printed:.2f}" else "no"
            body.append((basis, n, value, printed, None if printed is None else value - printed, same))
    return Table(
        (
            Column("basis"),
            Column("degree", wording.count, numeric=True),
            Column("ours", _exact, numeric=True),
            Column("paper", _exact, numeric=True),
            Column("difference", _small, numeric=True),
            Column("every printed digit"),
        ),
        body,
        "Table 1: L² condition numbers of fitting matrices.",
        "Nodes cos(iπ/n) on [−1, 1] for the monomial basis, mapped to [0, 1] for the Bernstein basis. The paper has no "
        "figures for the monomial basis on [0, 1], which it calls worse.",
        group=1,
    )


def _exact(value: Any) -> str:
    """Write two decimals; a dash for a missing value."""
    return wording.NONE if wording.absent(value) else f"{value:,.2f}"


def _small(value: Any) -> str:
    """Write a sign and four decimals; a dash for a missing value."""
    return wording.NONE if wording.absent(value) else wording.minus(f"{value:+.4f}")


def _table_2(figures: pd.DataFrame) -> Table:
    """Compare our errors of bounds, by each reading of the paper, with the paper's."""
    paper = published.table("szente_table2_bounds")
    columns = (
        Column("what was run", stretch=1),
        Column("bound"),
        *(Column(str(n), _percent, numeric=True, over="degree") for n in figures.columns),
    )
    printed = {"control point": paper.rows[0], "LU": paper.rows[1]}
    body: list[tuple[Any, ...]] = [
        ("the paper prints", bound, *(float(row[str(n)]) for n in figures.columns)) for bound, row in printed.items()
    ]
    matches = []
    for reading in figures.index.get_level_values("reading").unique():
        own = [(reading, bound, *figures.loc[(reading, bound)]) for bound in printed]
        body += own
        pairs = [
            (a, float(printed[row[1]][str(n)])) for row in own for a, n in zip(row[2:], figures.columns, strict=True)
        ]
        if all(abs(a - b) <= MATCH * b for a, b in pairs):
            matches.append(str(reading))
    told = f"Matched by: {'; '.join(matches)}." if matches else "No reading matches it."
    return Table(
        columns,
        body,
        "Table 2: relative errors of bounds of extrema, in per cent, mean of 100 random curves.",
        f"{told} A match would be every figure within {wording.share(MATCH)}. At degree 2 the LU function is the "
        "curve itself wherever its extremum is an inner one, so that no random quadratic leaves an error: the paper's "
        "28.54 % cannot come from Equations 5 to 8 as printed.",
        group=1,
    )


def _percent(value: Any) -> str:
    """Write two decimals, with no sign before a zero; a dash for a missing value."""
    return wording.NONE if wording.absent(value) else wording.minus(f"{value:z.2f}")


def _table_4(material: Material) -> Section | None:
    """Compare the times of the fit and of ray marching with the paper's; None without common rounds."""
    evidence = material.evidence.of("szente-table4.toml")
    march = evidence.ratios(picks.MARCH, picks.FIT, picks.TABLE_4)
    if march.empty:
        return None
    shares = {
        name: evidence.ratios(pick, picks.FIT, picks.TABLE_4).set_index("comparison")["ratio"]
        for name, pick in (("eft", picks.NO_EFT), ("eval", picks.NO_EVAL))
    }
    over_blocks, best = (
        evidence.ratios(picks.MARCH_OURS, fit, picks.TABLE_4).set_index("comparison")
        for fit in (picks.FIT, picks.FIT_OURS)
    )
    body: list[tuple[Any, ...]] = []
    for row in _in_order(march, picks.TABLE_4):
        told: list[Any] = [
            row.surface_title,
            row.degree,
            row.fast_ms,
            _lookup("szente_table4_runtime", "total_ms", row),
        ]
        for name in ("eft", "eval"):
            ratio = shares[name].get(row.comparison)
            paper = _lookup("szente_table4_runtime", f"{name}_percent", row)
            told += [None if ratio is None else 100.0 * (1.0 - ratio), paper]
        told += [row.slow_ms, _lookup("szente_table4_runtime", "raymarch_ms", row), row.ratio]
        theirs = _lookup("szente_table4_runtime", "speedup", row)
        told += [theirs, None if theirs is None else row.ratio / theirs]
        told += [over_blocks[name].get(row.comparison) for name in ("slow_ms", "ratio")]
        body.append((*told, *(best[name].get(row.comparison) for name in ("fast_ms", "ratio"))))
    mean = _means(body, (4, 5, 6, 7, 10, 11, 14, 16), 12)
    table = Table(
        (
            Column("surface"),
            Column("degree", wording.count, numeric=True),
            *_both("EFT + EVAL,\nms", wording.number),
            *_both("EFT,\n% of it", _whole),
            *_both("EVAL,\n% of it", _whole),
            *_both("ray marching,\nms", wording.number),
            Column("ours", wording.factor, numeric=True, over="speed-up"),
            Column("paper", wording.factor, numeric=True, over="speed-up"),
            Column("ours over\npaper", wording.factor, numeric=True),
            Column("ms", wording.number, numeric=True, over="marching in blocks"),
            Column("printed fit\nover it", wording.factor, numeric=True, over="marching in blocks"),
            Column("ms", wording.number, numeric=True, over="our fit"),
            Column("over march\nin blocks", wording.factor, numeric=True, over="our fit"),
        ),
        [*body, mean],
        "The fit against ray marching, as printed, and both at our best.",
        f"Ours on {_where(march)}; the paper's on an NVIDIA 1660 Ti mobile.",
    )
    verdicts = verdict_tables(material.judged, "szente-table4.toml", "szente, Table 4")
    blocks: tuple[Block, ...] = (introduced(SEEN_4, material.judged, "szente-table4.toml"), table)
    return Section("szente, Table 4", blocks, (Text(TOLD_4), *verdicts))


def _changes(material: Material) -> Section | None:
    """Tell what each of our changes is worth when it is made alone; None where none was timed."""
    evidence = material.evidence.of("szente-changes.toml")
    body = [
        row
        for printed, changes in ((picks.FIT, picks.FIT_CHANGES), (picks.MARCH, picks.MARCH_CHANGES))
        for change in changes
        if (row := _change(evidence, printed, change))
    ]
    if not body:
        return None
    table = Table(
        (
            Column("of"),
            Column("change", stretch=1),
            Column("mean", wording.factor, numeric=True, over="as fast as printed"),
            Column("least", wording.factor, numeric=True, over="as fast as printed"),
            Column("most", wording.factor, numeric=True, over="as fast as printed"),
            Column("printed", wording.number, numeric=True, over="evaluations a ray"),
            Column("changed", wording.number, numeric=True, over="evaluations a ray"),
            Column("printed", wording.count, numeric=True, over="wrong rays"),
            Column("changed", wording.count, numeric=True, over="wrong rays"),
            Column("printed", wording.error, numeric=True, over="largest p99 error"),
            Column("changed", wording.error, numeric=True, over="largest p99 error"),
        ),
        body,
        "What each of our changes is worth when it is made alone.",
        "Evaluations are means, wrong rays are sums, and errors are over the scene's radius.",
        group=1,
    )
    seen = (
        "Each row is the printed method of Table 4 with one change of ours, over Table 4's surfaces. A change that "
        "helps alone may help less beside others."
    )
    return Section("szente, what our changes are worth", (Text(seen), table))


def _change(evidence: Evidence, printed: Pick, change: Pick) -> tuple[Any, ...] | None:
    """Make the line of one change; None where the two were not timed in the same rounds."""
    ratios = evidence.ratios(printed, change, picks.TABLE_4)
    if ratios.empty:
        return None
    sides = [evidence.rows(pick, ratios["surface"].unique()) for pick in (printed, change)]
    figures = [
        [rows["evaluations_mean"].mean(skipna=False) for rows in sides],
        [summed(rows, "wrong_rays") for rows in sides],
        [largest(rows, "error_p99") for rows in sides],
    ]
    ratio = ratios["ratio"]
    return (printed.words, change.words, ratio.mean(), ratio.min(), ratio.max(), *(v for pair in figures for v in pair))


def _table_5(material: Material) -> Section | None:
    """Compare the times of Lipschitz tracing by two bounds with the paper's; None without common rounds."""
    evidence = material.evidence.of("szente-table5.toml")
    ratios = evidence.ratios(picks.CONTROL, picks.LU, picks.TABLE_5)
    if ratios.empty:
        return None
    march = evidence.ratios(picks.MARCH, picks.LU, picks.TABLE_5).set_index("comparison")
    in_blocks = evidence.ratios(picks.MARCH_OURS, picks.LU, picks.TABLE_5).set_index("comparison")
    best = evidence.ratios(picks.LU, picks.LU_OURS, picks.TABLE_5).set_index("comparison")
    body: list[tuple[Any, ...]] = []
    for row in _in_order(ratios, picks.TABLE_5):
        told: list[Any] = [row.surface_title, row.degree]
        told += [row.fast_ms, _lookup("szente_table5_lu", "lu_ms", row)]
        told += [row.slow_ms, _lookup("szente_table5_lu", "control_point_ms", row)]
        theirs = _lookup("szente_table5_lu", "lu_speedup", row)
        told += [row.ratio, theirs, None if theirs is None else row.ratio / theirs]
        over = march["ratio"].get(row.comparison)
        told += [
            over,
            _lookup("szente_table5_lu", "speedup_over_raymarch", row),
            in_blocks["ratio"].get(row.comparison),
        ]
        body.append((*told, *(best[name].get(row.comparison) for name in ("fast_ms", "ratio"))))
    mean = _means(body, (6, 7, 9, 10, 11, 13), 8)
    table = Table(
        (
            Column("surface"),
            Column("degree", wording.count, numeric=True),
            *_both("LU bound,\nms", wording.number),
            *_both("control points,\nms", wording.number),
            *_both("LU over\ncontrol points", wording.factor),
            Column("ours over\npaper", wording.factor, numeric=True),
            *_both("LU over\nray marching", wording.factor),
            Column("LU over march\nin blocks", wording.factor, numeric=True),
            Column("LU bound,\nms", wording.number, numeric=True, over="at our best"),
            Column("over\nprinted", wording.factor, numeric=True, over="at our best"),
        ),
        [*body, mean],
        "Lipschitz tracing by two bounds.",
        f"Ours on {_where(ratios)}; the paper's on an NVIDIA 1660 Ti mobile.",
    )
    verdicts = verdict_tables(material.judged, "szente-table5.toml", "szente, Table 5")
    blocks: tuple[Block, ...] = (introduced(SEEN_5, material.judged, "szente-table5.toml"), table)
    return Section("szente, Table 5", blocks, (Text(TOLD_5), *verdicts))


def _where(rows: pd.DataFrame) -> str:
    """Write the device and the size of the first of these rows."""
    return f"{rows['device'].iloc[0]}, {wording.square(rows['size'].iloc[0])}"


def _in_order(ratios: pd.DataFrame, surfaces: tuple[str, ...]) -> list[Any]:
    """Return the first device's row of each surface, in the paper's order."""
    rows = {row.surface: row for row in reversed(list(tuples(ratios)))}
    return [rows[name] for name in surfaces if name in rows]


def _lookup(name: str, column: str, row: Any) -> float | None:
    """Return the paper's figure for the surface of `row`; None where it has none."""
    return published.table(name).number(column, surface=_NAMES.get(row.surface, ""))


def _both(over: str, show: Callable[[Any], str]) -> tuple[Column, Column]:
    """Make a column of ours and one of the paper's under one heading."""
    return Column("ours", show, numeric=True, over=over), Column("paper", show, numeric=True, over=over)


def _whole(value: Any) -> str:
    """Write no decimals, with no sign before a zero; a dash for a missing value."""
    return wording.NONE if wording.absent(value) else wording.minus(f"{value:z.0f}")


def _means(body: list[tuple[Any, ...]], columns: tuple[int, ...], ratio: int) -> tuple[Any, ...]:
    """Make the line of means of `columns`; column `ratio` has the ratio of the two means before it."""
    means: list[Any] = ["mean", *[None] * (len(body[0]) - 1)]
    for i in columns:
        known = [row[i] for row in body if not wording.absent(row[i])]
        means[i] = sum(known) / len(known) if known else None
    means[ratio] = means[ratio - 2] / means[ratio - 1] if means[ratio - 1] else None
    return tuple(means)
