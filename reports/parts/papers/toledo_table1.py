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
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Column, Section, Table, Text
from reports.material import Material

ORDER = 10
CONFIG = "toledo-table1.toml"
PICKS = (*picks.TABLE_1, *picks.OURS_OF_TABLE_1, *picks.POLYGONS)
REFERENCE = picks.NEWTON_3  # the technique that ratios are over
OURS, PAPER = "ours", "paper"
SEEN = (
    "Eleven ways to draw one torus, from six angles. Frames per second are of two devices: compare the last column, a "
    f"technique's mean over that of {REFERENCE.words}. Rows that the paper lacks are ours at its best, to the same "
    "error."
)
TOLD = (
    "The paper does not state its camera; distance 5.584 with a field of view of 30° gives its pixels. Pixels are "
    "counted on the device as the technique with the fewest wrong rays draws them. A polygon's error along a ray is "
    "more than its distance from the torus, and most where the ray is nearly tangent; the paper's figure for polygons "
    "is a formula, held against measured distances here."
)


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has no rows for it."""
    rows = table_rows(material.evidence.of(CONFIG))
    if rows.empty:
        return []
    angles = list(dict.fromkeys(rows["view"]))
    blocks = (
        introduced(SEEN, material.judged, CONFIG),
        _pixels(rows, angles),
        _frames(rows, angles),
        _rates_and_errors(rows),
    )
    measured = material.evidence.studies.get("mesh_errors")
    details = ([_meshes(measured)] if measured else []) + verdict_tables(material.judged, CONFIG, "toledo2007, Table 1")
    return [Section("toledo2007, Table 1", blocks, (Text(TOLD), *details))]


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
        (Column("pixels"), Column(""), *(Column(_title(view), _one_digit, numeric=True) for view in angles)),
        body,
        "Pixels of box and torus, by projection angle.",
        f"Counted as {technique} draws them. Waste is the share of the box's fragments that are discarded.",
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
            Column("technique"),
            Column(""),
            *(Column(_title(view), wording.number, numeric=True, over="frames per second") for view in angles),
            Column("mean", wording.number, numeric=True, over="frames per second"),
            Column(f"over\n{REFERENCE.words}", wording.factor, numeric=True),
        ),
        body,
        "Frames per second, by projection angle.",
        f"Ours on {rows['device'].iloc[0]}, shaded by equation 6's normal, with depth; the paper's on a GeForce 7900.",
        group=1,
    )


def _rates_and_errors(rows: pd.DataFrame) -> Table:
    """Compare pixels per second, their spread over the views, and errors with the paper's, technique by technique."""
    body = [(pick.words, *_rate(pick, own), *_error(pick, own)) for pick in PICKS if len(own := _of(rows, pick))]
    rate, spread_over, by_r, by_both = "megapixels/s, mean", "StdDev / Average", "error over r", "error over R + r"
    return Table(
        (
            Column("technique"),
            Column(OURS, wording.number, numeric=True, over=rate),
            Column(PAPER, wording.number, numeric=True, over=rate),
            Column(OURS, wording.share, numeric=True, over=spread_over),
            Column(PAPER, wording.share, numeric=True, over=spread_over),
            Column("noise,\n±", wording.share, numeric=True),
            Column("largest", wording.error, numeric=True, over=by_r),
            Column("99 %", wording.error, numeric=True, over=by_r),
            Column(PAPER, wording.error, numeric=True, over=by_r),
            Column("largest", wording.error, numeric=True, over=by_both),
            Column(PAPER, wording.error, numeric=True, over=by_both),
            Column("wrong\nrays", wording.share, numeric=True),
            Column("most at"),
        ),
        body,
        "Megapixels per second, how they depend on the view, and errors.",
        "Megapixels are frames per second times the box's pixels; their spread over six angles says something only "
        "well above the noise of one view. Errors are |t − t*| over all angles, against certified first hits.",
    )


def _rate(pick: Pick, own: pd.DataFrame) -> tuple[float | None, ...]:
    """Return a technique's megapixels per second, ours and the paper's, their spreads, and the noise of one view.

    All are None for polygons, whose time does not depend on pixels.
    """
    if pick in picks.POLYGONS:
        return (None,) * 5
    paper = published.table("toledo2007_table1_megapixels")
    rate = own["frames_per_s"] * own["fragments"].astype("float64") / 1e6
    name = {"D.D. Bisection": "Bisection"}.get(pick.words, pick.words)
    name = name if paper.number("average", technique=name) is not None else pick.words
    mean, percent = (paper.number(c, technique=name) for c in ("average", "stddev_over_average_percent"))
    noise = float(((own["upper_ms"] - own["lower_ms"]) / (2.0 * own["median_ms"])).max())
    return (rate.mean(), mean, spread(rate), None if percent is None else percent / 100.0, noise)


def _error(pick: Pick, own: pd.DataFrame) -> tuple[Any, ...]:
    """Return a technique's errors, ours and the paper's, the share of wrong rays, and the angle with most of them."""
    paper = published.table("toledo2007_table1_fps")
    theirs = [paper.number(c, technique=pick.words) for c in ("error_r_1e-6", "error_Rr_1e-6")]
    by_r, by_both = (None if value is None else 1e-6 * value for value in theirs)
    wrong = own["wrong_rays"].astype("float64")
    largest = (own["feature_error_max"].max(), own["feature_error_p99"].max(), by_r)
    most = _title(str(wrong.idxmax())) if wrong.max() > 0 else None
    share = wrong.sum() / own["accuracy_rays"].astype("float64").sum()
    return (*largest, own["relative_error_max"].max(), by_both, share, most)


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
            Column("bytes", wording.count, numeric=True),
        ),
        body,
        "Errors of polygonal tori: the paper's formula, geometry's, and what is measured.",
        "The paper counts the ring's chord alone. Where the tube's chord adds to it, (R + 2r)(1 − cos(π/N)) are left.",
    )
