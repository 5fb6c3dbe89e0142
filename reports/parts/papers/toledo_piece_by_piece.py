"""toledo2007's methods piece by piece: what each piece is worth in time, evaluations and wrong rays."""

from __future__ import annotations

from typing import Any

import pandas as pd

from reports import wording
from reports.claims import toledo_pieces
from reports.claims.evidence import Evidence, run_of
from reports.claims.toledo_pieces import CUBICS, NORMALS, PIECES, PROXIES, Piece
from reports.claims.verdict_tables import introduced, verdict_tables
from reports.content import Block, Column, Section, Table
from reports.material import Material
from reports.reading.tuples import tuples

ORDER = 13
SEEN = (
    "What each piece of the paper's methods is worth: the method with the piece and without it are timed in turns, all "
    "else as printed. A factor over 1× says that the piece makes the method faster."
)


def sections(material: Material) -> list[Section]:
    """Make the section; [] where the run has none of the pieces, proxies and normals."""
    blocks: list[Block] = []
    worth = [row for piece in PIECES if (row := _worth(piece, material.evidence.of(piece.config)))]
    if worth:
        blocks.append(_pieces(worth))
    rows = toledo_pieces.by_proxy(material.evidence.of(PROXIES))
    if not rows.empty:
        blocks.append(_proxies(rows))
    rows = toledo_pieces.by_normal(material.evidence.of(NORMALS))
    if not rows.empty:
        blocks.append(_normals(rows))
    if not blocks:
        return []
    details: list[Block] = []
    for config, told in ((CUBICS, "section 3"), (PROXIES, "proxies"), (NORMALS, "section 4.5")):
        if (material.frame["run"] == run_of(config)).any():
            details += verdict_tables(material.judged, config, f"toledo2007, {told}")
    seen = introduced(SEEN, material.judged, CUBICS, PROXIES, NORMALS)
    return [Section("toledo2007, piece by piece", (seen, *blocks), tuple(details))]


def _worth(piece: Piece, evidence: Evidence) -> tuple[Any, ...] | None:
    """Make the line of one piece; None where the method was not timed with it and without it in the same rounds."""
    ratios = evidence.ratios(piece.without, piece.having, piece.surfaces)
    if ratios.empty:
        return None
    figures: list[Any] = [ratios["ratio"].mean(), ratios["ratio"].min(), ratios["ratio"].max()]
    for name in ("evaluations_mean", "wrong_rays"):
        for pick in (piece.without, piece.having):
            values = evidence.rows(pick, piece.surfaces)[name].astype("float64")
            figures.append(values.mean() if name == "evaluations_mean" else values.sum(skipna=False))
    return (piece.title, piece.whose, len(ratios), *figures)


def _pieces(worth: list[tuple[Any, ...]]) -> Table:
    """Make the table of what each piece is worth."""
    return Table(
        (
            Column("piece"),
            Column("whose"),
            Column("cases", wording.count, numeric=True),
            Column("mean", wording.factor, numeric=True, over="time without over with"),
            Column("least", wording.factor, numeric=True, over="time without over with"),
            Column("most", wording.factor, numeric=True, over="time without over with"),
            Column("without", wording.number, numeric=True, over="evaluations a ray"),
            Column("with", wording.number, numeric=True, over="evaluations a ray"),
            Column("without", wording.count, numeric=True, over="wrong rays"),
            Column("with", wording.count, numeric=True, over="wrong rays"),
        ),
        worth,
        "What the pieces of toledo2007's methods are worth.",
        "Cases are views or surfaces; wrong rays are neither grazing nor drowned, and are summed over the cases.",
    )


def _proxies(rows: pd.DataFrame) -> Table:
    """Make a line for each angle and proxy."""
    body = [
        (row.view.removeprefix("angle ") + "°", row.proxy, row.fragments, row.waste, row.median_ms, row.wrong_rays)
        for row in tuples(rows)
    ]
    return Table(
        (
            Column("angle"),
            Column("proxy"),
            Column("fragments", wording.count, numeric=True),
            Column("without a hit", wording.percentage, numeric=True),
            Column("ms", wording.number, numeric=True),
            Column("wrong\nrays", wording.count, numeric=True),
        ),
        body,
        "The torus by Newton 0.001 in a box, a sphere and a tetrahedron.",
        f"On {rows['device'].iloc[0]}, {wording.square(rows['size'].iloc[0])}. The tetrahedron is the smallest about "
        "the box; Loop and Blinn's is about a piece of the surface, and may be smaller.",
        group=1,
    )


def _normals(rows: pd.DataFrame) -> Table:
    """Make a line for each view: its times by the three normals."""
    body = []
    for view in dict.fromkeys(rows["view"]):
        own = rows[rows["view"] == view].set_index("normal")["median_ms"]
        times = tuple(own.get(name) for name in ("core_circle", "distance", "gradient"))
        ratios = toledo_pieces.shaded(rows[rows["view"] == view], "gradient", "core_circle")["ratio"]
        body.append(
            (f"{view}°" if view.startswith("tilted") else view, *times, ratios.iloc[0] if len(ratios) else None)
        )
    return Table(
        (
            Column("view"),
            Column("core circle,\nequation 6", wording.number, numeric=True, over="ms, shaded by"),
            Column("gradient of\nthe distance", wording.number, numeric=True, over="ms, shaded by"),
            Column("gradient\nof f", wording.number, numeric=True, over="ms, shaded by"),
            Column("gradient of f over\ncore circle", wording.factor, numeric=True),
        ),
        body,
        "The torus by Newton 0.001, shaded by three normals.",
        f"On {rows['device'].iloc[0]}, {wording.square(rows['size'].iloc[0])}. f is written in factors here; the paper "
        "calls its partial derivatives expensive and does not print them.",
    )
