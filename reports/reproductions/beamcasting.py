"""beamcasting's Tables I and II."""

from __future__ import annotations

from typing import Any

from reports import published, wording
from reports.claims import picks
from reports.content import Column, Section, Table
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
            ("uniform, frames/s", wording.number),
            ("adaptive, frames/s", wording.number),
            ("adaptive over uniform", wording.factor),
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
    return [Section("beamcasting, Tables I and II", (table, *verdicts.of(material, "beamcasting-tables.toml")))]
