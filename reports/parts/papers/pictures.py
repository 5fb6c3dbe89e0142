"""Show the papers' pictures: what each setting drew, its errors, and how many rays it got wrong."""

from __future__ import annotations

import pandas as pd

from reports import wording
from reports.analysis import derive
from reports.claims import figures
from reports.claims.evidence import run_of
from reports.claims.figures import Figure
from reports.claims.verdict_tables import verdict_tables
from reports.content import Block, Column, Section, Table, Text
from reports.drawing import images
from reports.material import Material

ORDER = 30


def sections(material: Material) -> list[Section]:
    """Make a section for each figure whose config this run holds."""
    return [section for figure in figures.FIGURES if (section := _section(material, figure))]


def _section(material: Material, figure: Figure) -> Section | None:
    """Make the section of one figure; None where the run has no row of it."""
    rows = figures.rows_of(figure, material.evidence)
    if rows.empty:
        return None
    blocks: list[Block] = [Text(figure.told), _counts(rows, figure.title)]
    gallery = images.gallery(material.shelf, rows, figure.caption, run_of(figure.config), material.error_scale)
    blocks += [gallery] if gallery else []
    blocks += verdict_tables(material.judged, figure.config, figure.title) if figure.judged else []
    return Section(figure.title, tuple(blocks))


def _counts(rows: pd.DataFrame, title: str) -> Table:
    """Make a line for each picture: how many of its rays are wrong."""
    kinds = derive.kinds(rows)
    views = rows["view"].nunique() > 1
    body = []
    for row in rows.itertuples():
        counts = tuple(getattr(row, kind) for kind in kinds)
        place = (row.surface_title, row.view) if views else (row.surface_title,)
        apart = (row.grazing_wrong_rays, row.drowned_wrong_rays)
        told = (row.setting, *counts, row.wrong_rays, *apart, row.error_max, row.error_p99)
        body.append((*place, *told))
    return Table(
        (
            Column("surface"),
            *([Column("view")] if views else []),
            Column("setting", stretch=1),
            *(Column(kind.replace("_", "\n"), wording.count, numeric=True) for kind in kinds),
            Column("wrong\nrays", wording.count, numeric=True),
            Column("at sil-\nhouettes", wording.count, numeric=True),
            Column("drowned", wording.count, numeric=True),
            Column("max\nerror", wording.error, numeric=True),
            Column("99 %\nerror", wording.error, numeric=True),
        ),
        body,
        f"{title}: rays answered wrongly, of {wording.count(rows['accuracy_rays'].iloc[0])} each.",
        f"On {rows['device'].iloc[0]}, {rows['precision'].iloc[0]}; errors in scene units. The paper prints no counts.",
        group=1,
    )
