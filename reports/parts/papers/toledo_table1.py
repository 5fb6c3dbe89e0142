"""toledo2007's Table 1: eleven ways to draw a torus, from six angles."""

from __future__ import annotations

import math
from typing import Any

import pandas as pd

from reports import published, wording
from reports.analysis import derive
from reports.analysis.viewstats import spread
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.verdict_tables import verdict_tables
from reports.content import Block, Column, Section, Table
from reports.material import Material

ORDER = 10
CONFIG = "toledo-table1.toml"
PICKS = (*picks.TABLE_1, *picks.OURS_OF_TABLE_1, *picks.POLYGONS)
REFERENCE = picks.NEWTON_3  # the technique that ratios are over
OURS, PAPER = "ours", "paper"


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has no rows for it."""
    rows = table_rows(material.evidence.of(CONFIG))
    if rows.empty:
        return []
    angles = list(dict.fromkeys(rows["view"]))
    blocks: list[Block] = [_pixels(rows, angles), _frames(rows, angles), _rates(rows), _errors(rows)]
    if measured := material.evidence.studies.get("mesh_errors"):
        blocks.append(_meshes(measured))
    return [Section("toledo2007, Table 1", (*blocks, *verdict_tables(material.judged, CONFIG, "toledo2007, Table 1")))]


def table_rows(evidence: Evidence) -> pd.DataFrame:
    """Return the timed rows of Table 1's techniques in stage raster, with `technique`, on the first device."""
    found = [evidence.rows(pick, picks.TORUS).assign(technique=pick.words) for pick in PICKS]
    rows = pd.concat(found)
    # only the views of Table 1 are at the paper's distance
    rows = rows[(rows["stage"] == "raster") & (rows["proxy"] == "box") & (rows["view_set"] == "angles")]
    rows = rows[(rows["distance"] - 5.584).abs() < 1e-9].dropna(subset=["median_ms"])
    return derive.on_first_device(rows)


def _column(view: str) -> str:
    """Return the name that the paper's tables give the column of a view."""
    return view.replace("angle ", "angle_")


def _title(view: str) -> str:
    """Write the angle of a view."""
    return view.removeprefix("angle ") + "°"


def _pixels(rows: pd.DataFrame, angles: list[str]) -> Table:
    """Compare our counts of pixels with the paper's.

    Ours are counted on the device. They are of the ray caster with the fewest wrong rays, because lost rays are lost
    pixels.
    """
    cast = rows[rows["casts"] == "rays"]
    wrong = (
        cast.assign(bad=cast["wrong_rays"].astype("float64")).groupby("technique", sort=False)["bad"].sum(min_count=1)
    )
    technique = wrong.fillna(math.inf).idxmin() if len(wrong) else REFERENCE.words
    own = cast[cast["technique"] == technique].set_index("view")
    paper = published.table("toledo2007_table1_pixels")
    counted = {
        "bbox_kpixels": ("box, kilopixels", own["fragments"] / 1e3),
        "torus_kpixels": ("torus, kilopixels", own["pixels_drawn"] / 1e3),
        "fragment_waste_percent": ("fragment waste, %", 100.0 * own["fragments_discarded"] / own["fragments"]),
    }
    body: list[tuple[Any, ...]] = []
    for quantity, (title, ours) in counted.items():
        theirs = [paper.number(_column(view), quantity=quantity) for view in angles]
        mine = [float(ours[view]) for view in angles if view in ours]
        if len(mine) < len(angles):
            continue
        body += [(title, OURS, *mine), (title, PAPER, *theirs)]
        if quantity == "fragment_waste_percent":
            body.append((title, "difference, points", *(a - (b or 0.0) for a, b in zip(mine, theirs, strict=True))))
        else:
            body.append(
                (
                    title,
                    "difference, %",
                    *(100.0 * (a / b - 1.0) if b else None for a, b in zip(mine, theirs, strict=True)),
                )
            )
    return Table(
        (Column("", stretch=1), Column(""), *(Column(_title(view), _one_digit, numeric=True) for view in angles)),
        body,
        "toledo2007, Table 1: pixels of box and torus, by projection angle.",
        "1024 × 1024, distance 5.584, field of view 30°: the paper does not state its camera; this one gives its "
        f"pixels. Counted on the device as {technique} draws them, which has the fewest wrong rays here. Waste is the "
        "share of the box's fragments that are discarded.",
        group=1,
    )


def _one_digit(value: Any) -> str:
    """Write one decimal; a dash for a missing value."""
    return wording.NONE if wording.absent(value) else wording.minus(f"{value:,.1f}")


def _of(rows: pd.DataFrame, pick: Pick) -> pd.DataFrame:
    """Return one technique's rows, indexed by view."""
    return rows[rows["technique"] == pick.words].set_index("view")


def _frames(rows: pd.DataFrame, angles: list[str]) -> Table:
    """Compare our frames per second with the paper's."""
    paper, body = published.table("toledo2007_table1_fps"), []
    reference = _of(rows, REFERENCE)["frames_per_s"].mean()
    theirs_reference = paper.number("average", technique=REFERENCE.words)
    for pick in PICKS:
        own = _of(rows, pick)["frames_per_s"]
        if own.empty:
            continue
        theirs = [paper.number(_column(view), technique=pick.words) for view in angles]
        mean = paper.number("average", technique=pick.words)
        over = mean / theirs_reference if mean and theirs_reference else None
        body.append((pick.words, OURS, *(own.get(view) for view in angles), own.mean(), own.mean() / reference))
        body += [(pick.words, PAPER, *theirs, mean, over)] if mean else []  # the paper has no row of ours at its best
    return Table(
        (
            Column("technique", stretch=1),
            Column(""),
            *(Column(_title(view), wording.number, numeric=True, over="frames per second") for view in angles),
            Column("mean", wording.number, numeric=True, over="frames per second"),
            Column(f"over\n{REFERENCE.words}", wording.factor, numeric=True),
        ),
        body,
        "toledo2007, Table 1: frames per second, by projection angle.",
        f"Ours on {rows['device'].iloc[0]}, shaded by equation 6's normal, with depth; the paper's on a GeForce 7900. "
        "Frames per second are of two devices; what is compared is the last column, a technique's mean over that of "
        f"{REFERENCE.words}. Rows that the paper lacks are ours at its best, to the same error.",
        group=1,
    )


def _rates(rows: pd.DataFrame) -> Table:
    """Compare our pixels per second, and their spread over the views, with the paper's."""
    paper, body = published.table("toledo2007_table1_megapixels"), []
    for pick in (*picks.TABLE_1, *picks.OURS_OF_TABLE_1):
        own = _of(rows, pick)
        if own.empty:
            continue
        rate = own["frames_per_s"] * own["fragments"].astype("float64") / 1e6
        name = {"D.D. Bisection": "Bisection"}.get(pick.words, pick.words)
        name = name if paper.number("average", technique=name) is not None else pick.words
        theirs = [paper.number(c, technique=name) for c in ("average", "stddev_over_average_percent")]
        noise = float(((own["upper_ms"] - own["lower_ms"]) / (2.0 * own["median_ms"])).max())
        body.append(
            (pick.words, rate.mean(), theirs[0], spread(rate), None if theirs[1] is None else theirs[1] / 100.0, noise)
        )
    return Table(
        (
            Column("technique", stretch=1),
            Column(OURS, wording.number, numeric=True, over="megapixels per second, mean"),
            Column(PAPER, wording.number, numeric=True, over="megapixels per second, mean"),
            Column(OURS, wording.percentage, numeric=True, over="StdDev / Average"),
            Column(PAPER, wording.percentage, numeric=True, over="StdDev / Average"),
            Column("noise,\n±", wording.share, numeric=True),
        ),
        body,
        "toledo2007, Table 1: megapixels per second, and how they depend on the view.",
        "Frames per second times the pixels of the box: how often the ray caster ran. The spread over six angles is "
        "the paper's measure of view dependence; it says something only well above the noise of a single view.",
    )


def _errors(rows: pd.DataFrame) -> Table:
    """Compare our errors with the paper's."""
    paper, body = published.table("toledo2007_table1_fps"), []
    for pick in PICKS:
        own = _of(rows, pick)
        if own.empty:
            continue
        theirs = [paper.number(c, technique=pick.words) for c in ("error_r_1e-6", "error_Rr_1e-6")]
        printed = [None if value is None else 1e-6 * value for value in theirs]
        wrong = own["wrong_rays"].astype("float64")
        body.append(
            (
                pick.words,
                own["feature_error_max"].max(),
                own["feature_error_p99"].max(),
                printed[0],
                own["relative_error_max"].max(),
                printed[1],
                wrong.sum() / own["accuracy_rays"].astype("float64").sum(),
                wrong.idxmax() if wrong.max() > 0 else None,
            )
        )
    return Table(
        (
            Column("technique", stretch=1),
            Column("largest", wording.error, numeric=True, over="error over r"),
            Column("99 %", wording.error, numeric=True, over="error over r"),
            Column(PAPER, wording.error, numeric=True, over="error over r"),
            Column("largest", wording.error, numeric=True, over="error over R + r"),
            Column(PAPER, wording.error, numeric=True, over="error over R + r"),
            Column("wrong, of\nall rays", wording.share, numeric=True),
            Column("most at"),
        ),
        body,
        "toledo2007, Table 1: errors, against certified first hits.",
        "Ours are |t − t*| along the rays that the fragments cast, outside the grazing class, over all angles. A "
        "polygon's error along a ray is more than its distance from the torus, and most where the ray is nearly "
        "tangent; the paper's figure for polygons is a formula, held against measured distances below.",
    )


def _meshes(measured: list[dict[str, Any]]) -> Table:
    """Compare the measured errors of polygonal tori with the formulas; `measured` has the study's rows."""
    paper = published.table("toledo2007_table1_fps")
    body = []
    for row in measured:
        printed = paper.number("error_Rr_1e-6", technique=f"Polygon {row['n']}*{row['n']}")
        share = row["to_surface"] / row["both"] - 1.0
        told = None if printed is None else 1e-6 * printed
        body.append((row["n"], told, row["ring"], row["both"], row["to_surface"], row["to_mesh"], share, row["bytes"]))
    return Table(
        (
            Column("N", wording.count, numeric=True),
            Column(PAPER, wording.error, numeric=True, over="formula, over R + r"),
            Column("1 − cos(π/N)", wording.error, numeric=True, over="formula, over R + r"),
            Column("both chords", wording.error, numeric=True, over="formula, over R + r"),
            Column("mesh to\ntorus", wording.error, numeric=True, over="measured, over R + r"),
            Column("torus to\nmesh", wording.error, numeric=True, over="measured, over R + r"),
            Column("measured less\nboth chords", lambda x: wording.minus(f"{100 * x:+.1f} %"), numeric=True),
            Column("bytes", wording.count, numeric=True, stretch=1),
        ),
        body,
        "Errors of polygonal tori: the paper's formula, geometry's, and what is measured.",
        "The paper counts the ring's chord alone. Where the tube's chord adds to it, (R + 2r)(1 − cos(π/N)) are left.",
    )
