"""beamcasting's Tables I and II, and Figure 1."""

from __future__ import annotations

from typing import Any

import numpy as np

from harness.contract import RayStatus
from reports import beams, published, wording
from reports.claims import picks
from reports.content import Column, Gallery, Section, Table, Text
from reports.material import Material
from reports.reproductions import verdicts

ORDER = 40
_NAMES = {
    "sphere": "Sphere",
    "dingdong_beamcasting": "Dingdong",
    "klein": "Klein",
    "mitchell": "Mitchell",
    "octdong": "Octdong",
    "steiner": "Steiner",
    "tangle": "Tangle",
    "teardrop": "Teardrop",
    "barth_sextic": "Barth",
    "heart": "Heart",
    "chmutov": "Chmutov",
    "blinn_blob": "Blob",
}


def sections(material: Material) -> list[Section]:
    return [*_tables(material), *_figure_1(material)]


def _tables(material: Material) -> list[Section]:
    ratios = material.evidence.of("beamcasting-tables.toml").ratios(picks.UNIFORM, picks.ADAPTIVE, _NAMES)
    if ratios.empty:
        return []
    ratios = ratios[ratios["device"] == ratios["device"].iloc[0]]
    paper = published.table("beamcasting_tables_fps")
    body: list[tuple[Any, ...]] = []
    for row in ratios.sort_values(["size", "samples_per_pixel"], kind="stable").itertuples():
        where = {"surface": _NAMES[row.surface], "image_size": row.size, "samples_per_pixel": row.samples_per_pixel}
        theirs = [paper.number(c, **where) for c in ("uniform_fps", "adaptive_fps", "adaptive_over_uniform")]
        told = (row.size, row.samples_per_pixel, row.surface_title, 1e3 / row.slow_ms, theirs[0])
        last = None if theirs[2] is None else row.ratio / theirs[2]
        body.append((*told, 1e3 / row.fast_ms, theirs[1], row.ratio, theirs[2], last))
    pairs = [
        Column(who, show, numeric=True, over=over)
        for over, show in (
            ("uniform,\nframes/s", wording.number),
            ("adaptive,\nframes/s", wording.number),
            ("adaptive\nover uniform", wording.factor),
        )
        for who in ("ours", "paper")
    ]
    table = Table(
        (
            Column("size", wording.count, numeric=True),
            Column("samples", wording.count, numeric=True),
            Column("surface", stretch=1),
            *pairs,
            Column("ours over\npaper", wording.factor, numeric=True),
        ),
        body,
        "beamcasting, Tables I and II: adaptive beams against uniform ones.",
        f"Ours on {ratios['device'].iloc[0]}; the paper's on an NVIDIA GTX 470. Frames per second are of two devices; "
        "the ratio of the two methods is what is compared.",
        group=2,
    )
    return [
        Section(
            "beamcasting, Tables I and II", (table, *verdicts.of(material, "beamcasting-tables.toml", "beamcasting"))
        )
    ]


def _figure_1(material: Material) -> list[Section]:
    """The levels of elimination of its own config's rows."""
    rows = material.evidence.rows(picks.ADAPTIVE, ("octdong",))
    rows = rows[rows["run"] == "beamcasting-fig1"].sort_values("size", kind="stable")
    found = [(row, arrays) for row in rows.itertuples() if (arrays := material.shelf.get(row)) is not None]
    found = [(row, arrays) for row, arrays in found if arrays.level is not None and arrays.status is not None]
    if not found:
        return []
    told = Text(
        "The paper shows the Octdong with each pixel coloured by the level at which its box was eliminated, and white "
        "where the subdivision reaches the surface. Here the same at three sizes; the paper prints no shares."
    )
    gallery = Gallery(tuple(beams.level_panel(row, arrays, "figure-1-") for row, arrays in found), beams.LEVELS)
    body: list[tuple[Any, ...]] = []
    for row, arrays in found:
        hit, levels = np.asarray(arrays.status == RayStatus.HIT), np.asarray(arrays.level)
        for level in range(int(levels.min()), int(levels.max()) + 1):
            body.append((row.size, level, row.size >> level, float(np.mean(~hit & (levels == level)))))
        body.append((row.size, "surface", None, float(hit.mean())))
    table = Table(
        (
            Column("size", wording.count, numeric=True),
            Column("eliminated at level", stretch=1),
            Column("pixels a side\nof its boxes", wording.count, numeric=True),
            Column("share of\nthe picture", wording.percentage, numeric=True),
        ),
        body,
        "beamcasting, Figure 1: where boxes are eliminated.",
        f"Of {wording.count(rows['accuracy_rays'].iloc[0])} pixels of each picture. Larger pictures add levels near "
        "the surface only: the share that large boxes throw away stays.",
        group=1,
    )
    return [Section("beamcasting, Figure 1", (told, gallery, table))]
