"""beamcasting's Tables I and II and Figure 1, and how many lanes wait."""

from __future__ import annotations

from typing import Any

import numpy as np

from harness.contract import RayStatus
from reports import published, wording
from reports.analysis import derive, idle_lanes
from reports.claims import picks
from reports.claims.evidence import run_of
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Block, Column, Gallery, Section, Table, Text
from reports.drawing import levels
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 40


def sections(material: Material) -> list[Section]:
    """Make up to three sections; [] where the run has no rows for any."""
    return [*_tables(material), *_figure_1(material), *_divergence(material)]


_SEEN = (
    "Adaptive beams against uniform ones on twelve surfaces. Compare the ratios of the two methods; frames per second "
    "are of two devices, and ours leave out the shading that both methods share."
)
_TOLD = (
    "A beam here is a perspective frustum: all rays from one eye through a rectangle of the picture. The paper's is a "
    "right prism in image space, U × V × T with T = [−1, 1], and its camera is not printed. Times here are of casting "
    "alone, all levels and the clearing of their counters: a hit's distance, its status and its evaluations are "
    "stored, and nothing is shaded. The paper's frames per second are of whole frames, with a second kernel that "
    "shades by the gradient and a textured quad: work that both methods share draws its ratio towards 1. Adaptive is "
    "the paper's Subdivide as printed, which halves [w, far] anew for each quarter; ε, which the paper does not "
    "print, gives both methods pieces of about the same depth. In the last column, ours, quarters go on at their "
    "parent's piece."
)


def _tables(material: Material) -> list[Section]:
    """Compare the speeds of both methods with the paper's; [] where the two were not timed in the same rounds."""
    evidence = material.evidence.of("beamcasting-tables.toml")
    ratios = evidence.ratios(picks.UNIFORM, picks.ADAPTIVE, picks.BEAM_SURFACES)
    if ratios.empty:
        return []
    ratios = derive.on_first_device(ratios)
    best = (
        evidence.ratios(picks.UNIFORM, picks.ADAPTIVE_OURS, picks.BEAM_SURFACES)
        .set_index(derive.GROUP)["ratio"]
        .to_dict()
    )
    spent = evidence.rows(picks.UNIFORM).set_index(derive.GROUP)["evaluations_mean"].to_dict()
    paper = published.table("beamcasting_tables_fps")
    body: list[tuple[Any, ...]] = []
    for row in tuples(ratios.sort_values(["size", "samples_per_pixel"], kind="stable")):
        where = {
            "surface": picks.BEAM_SURFACES[row.surface],
            "image_size": row.size,
            "samples_per_pixel": row.samples_per_pixel,
        }
        theirs = [paper.number(c, **where) for c in ("uniform_fps", "adaptive_fps", "adaptive_over_uniform")]
        told = (row.size, row.samples_per_pixel, row.surface_title, 1e3 / row.slow_ms, theirs[0])
        last = None if theirs[2] is None else row.ratio / theirs[2]
        group = tuple(getattr(row, name) for name in derive.GROUP)
        adaptive = (1e3 / row.fast_ms, theirs[1], row.ratio, theirs[2], last)
        body.append((*told, *adaptive, spent[group] / row.evaluations_mean, best.get(group)))
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
            Column("size", wording.square),
            Column("samples", wording.count, numeric=True),
            Column("surface"),
            *pairs,
            Column("ours over\npaper", wording.factor, numeric=True),
            Column("the ratio in\nevaluations", wording.factor, numeric=True),
            Column("from the\nparent's piece", wording.factor, numeric=True),
        ),
        body,
        "Adaptive beams against uniform ones.",
        f"Ours on {ratios['device'].iloc[0]}; the paper's on an NVIDIA GTX 470.",
        group=2,
    )
    verdicts = verdict_tables(material.judged, "beamcasting-tables.toml", "beamcasting")
    blocks: tuple[Block, ...] = (introduced(_SEEN, material.judged, "beamcasting-tables.toml"), table)
    return [Section("beamcasting, Tables I and II", blocks, (Text(_TOLD), *verdicts))]


def _figure_1(material: Material) -> list[Section]:
    """Show the levels at which boxes are eliminated, by the rows of the figure's own config; [] without any."""
    rows = material.evidence.rows(picks.ADAPTIVE, ("octdong",))
    rows = rows[rows["run"] == run_of("beamcasting-fig1.toml")].sort_values("size", kind="stable")
    found = material.shelf.together(rows)
    found = [(row, arrays) for row, arrays in found if arrays.level is not None and arrays.status is not None]
    if not found:
        return []
    told = Text(
        "The Octdong with each pixel coloured by the level at which its box was eliminated, and white where the "
        "subdivision reaches the surface, at three sizes. Larger pictures add levels near the surface only: the share "
        "that large boxes throw away stays. The paper prints no shares."
    )
    gallery = Gallery(tuple(levels.panel(row, arrays, "figure-1-") for row, arrays in found), levels.EXPLANATION)
    body: list[tuple[Any, ...]] = []
    for row, arrays in found:
        hit, decided = np.asarray(arrays.status == RayStatus.HIT), np.asarray(arrays.level)
        for level in range(int(decided.min()), int(decided.max()) + 1):
            body.append((row.size, level, row.size >> level, float(np.mean(~hit & (decided == level)))))
        body.append((row.size, "surface", None, float(hit.mean())))
    table = Table(
        (
            Column("size", wording.square),
            Column("eliminated at level"),
            Column("pixels a side\nof its boxes", wording.count, numeric=True),
            Column("share of\nthe picture", wording.percentage, numeric=True),
        ),
        body,
        "Where boxes are eliminated.",
        f"Of {wording.count(rows['accuracy_rays'].iloc[0])} pixels of each picture.",
        group=1,
    )
    return [Section("beamcasting, Figure 1", (told, gallery), (table,))]


_SETTINGS = (picks.UNIFORM_IN_ROWS, picks.UNIFORM, picks.ADAPTIVE, picks.REMAPPED, picks.ADAPTIVE_OURS)
_IDLE_SEEN = (
    "How many lanes of a processor's vector or a GPU's warp wait while another evaluates f: each group takes as many "
    "turns as its busiest lane. Grouping by place lowers the share; shares are lower bounds."
)
_IDLE = (
    "Work items that run in step, in a processor's vector or a GPU's warp, wait for the one that evaluates f most "
    "often. Each lane of a group takes as many turns as the lane with most evaluations; idle is the share of turns in "
    "which a lane evaluates nothing. Counts are of the frame that was checked; groups are neighbours in the order of "
    "the work items. Turns of the search that only test the domain are not counted, nor that lanes evaluate at "
    "different turns: shares are lower bounds. The order of a level's queue changes from run to run, and shares by "
    "about a hundredth."
)


def _divergence(material: Material) -> list[Section]:
    """Tell how many lanes wait: of whole frames by setting, and level by level on the surface of Figure 1.

    [] where no row stores its levels.
    """
    config = "beamcasting-divergence.toml"
    evidence = material.evidence.of(config)
    rows = [(pick, row) for pick in _SETTINGS for row in tuples(evidence.rows(pick, picks.BEAM_SURFACES))]
    rows = [(pick, row) for pick, row in rows if row.run == run_of(config) and idle_lanes.levels_of(row)]
    if not rows:
        return []
    rows = [(pick, row) for pick, row in rows if row.device == rows[0][1].device]
    order = list(picks.BEAM_SURFACES)
    rows.sort(key=lambda one: order.index(one[1].surface))
    body = [
        (picks.BEAM_SURFACES[row.surface], pick.words, row.evaluations_mean, *_shares(row), row.median_ms)
        for pick, row in rows
    ]
    shares = [
        Column(str(width), wording.share, numeric=True, over="idle of so many lanes") for width in idle_lanes.WIDTHS
    ]
    whole = Table(
        (
            Column("surface"),
            Column("setting"),
            Column("evals per\npixel", wording.number, numeric=True),
            *shares,
            Column("ms", wording.number, numeric=True),
        ),
        body,
        "Lanes that wait.",
        f"On {rows[0][1].device}. Row by row is what the paper's grouping by place (III.E) is held against; remapped: "
        "quarters of a cell that evaluated f more than 16 times come after the others (its plan, V).",
        group=1,
    )
    by_level = [
        (
            pick.words,
            level["level"],
            level["items"],
            level["evaluations"] / level["items"],
            *(level["idle"][str(width)] for width in idle_lanes.WIDTHS),
        )
        for pick, row in rows
        if row.surface == "octdong"
        for level in idle_lanes.levels_of(row)
    ]
    level_table = Table(
        (
            Column("setting"),
            Column("level", wording.count, numeric=True),
            Column("work\nitems", wording.count, numeric=True),
            Column("evals\nper item", wording.number, numeric=True),
            *shares,
        ),
        by_level,
        "The Octdong level by level.",
        "The first level is the one that fills the device. Coarse levels wait most, since their neighbouring cells "
        "are least alike.",
        group=1,
    )
    blocks: tuple[Block, ...] = (introduced(_IDLE_SEEN, material.judged, config), whole)
    details: tuple[Block, ...] = (
        Text(_IDLE),
        *([level_table] if by_level else []),
        *verdict_tables(material.judged, config, "beamcasting"),
    )
    return [Section("beamcasting, divergence", blocks, details)]


def _shares(row: Any) -> tuple[float | None, ...]:
    """Return a row's idle share for each of WIDTHS."""
    return tuple(idle_lanes.idle_share(row, width) for width in idle_lanes.WIDTHS)
