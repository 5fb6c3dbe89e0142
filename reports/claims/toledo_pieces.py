"""Claims of toledo2007 about single pieces of its methods, judged by the method with the piece and without it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import pandas as pd

from reports import wording
from reports.analysis import derive, rounds
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import (
    Claim,
    Judge,
    Verdict,
    always,
    beside,
    cases,
    every,
    lost,
    quantities,
    verdict,
)
from reports.claims.toledo import PAPER, VIEWS

CUBICS = "toledo-cubics.toml"
PROXIES = "toledo-proxies.toml"
NORMALS = "toledo-normals.toml"
FIGURE_3 = "toledo-fig3.toml"
EXACT = 1e-9  # a relative error in float64 that is called none
SEARCHED = (*picks.CUBICS, *picks.TORUS)


@dataclass(frozen=True)
class Piece:
    """Hold a piece of a method, the paper's or ours, and the picks without it and with it."""

    title: str
    whose: str
    config: str
    without: Pick
    having: Pick
    surfaces: tuple[str, ...]


PAPERS, OURS = "the paper's", "ours"
PIECES = (
    Piece("Sturm: discard before the search", PAPERS, CUBICS, picks.STURM_SEARCHING, picks.STURM, SEARCHED),
    Piece(
        "Sturm: by sign at one root, double words if needed", OURS, VIEWS, picks.STURM, picks.STURM_BY_SIGN, picks.TORUS
    ),
    Piece(
        "D.D. bisection: parted at the roots of f''",
        OURS,
        VIEWS,
        picks.BISECTION,
        picks.BISECTION_AT_BENDS,
        picks.TORUS,
    ),
    Piece("Sphere tracing: a second start", PAPERS, VIEWS, picks.ONE_RAY, picks.TWO_RAYS, picks.TORUS),
    Piece("Sphere tracing: the second never goes back", OURS, VIEWS, picks.TWO_RAYS, picks.TWO_RAYS_AHEAD, picks.TORUS),
    Piece("Newton: start on the sphere", PAPERS, VIEWS, picks.NEWTON_FROM_BOX, picks.NEWTON_3, picks.TORUS),
    Piece("Newton: bound of the step", PAPERS, VIEWS, picks.NEWTON_UNBOUND, picks.NEWTON_3, picks.TORUS),
    Piece("Newton: steps forwards", OURS, VIEWS, picks.NEWTON_3, picks.NEWTON_3_FORWARDS, picks.TORUS),
)


def _cubics_are_slower(evidence: Evidence) -> Verdict | None:
    """Judge by whole frames of surfaces that fill the window, as the paper counts them."""
    sturm = evidence.rows(picks.STURM, picks.CUBICS).dropna(subset=["median_ms"])
    ball = evidence.rows(picks.CLOSED_FORM, ("sphere",)).dropna(subset=["median_ms"])
    both = sturm.merge(ball[["device", "median_ms", "upper_ms"]], on="device", suffixes=("", "_ball"))
    if both.empty:
        return None
    slower = both["median_ms"] / both["median_ms_ball"]
    figure = (
        f"a closed form draws a sphere in {wording.number(ball['median_ms'].iloc[0])} ms; Sturm's method takes "
        f"{wording.factor(slower.min())} to {wording.factor(slower.max())} that time on "
        f"{wording.plural(both['surface'].nunique(), 'cubic')}"
    )
    if not (all(rounds.proved(rows["samples_ms"]).all() for rows in (sturm, ball))):
        return verdict(None, figure)
    told_apart = (both["lower_ms"] > both["upper_ms_ball"]) | (both["upper_ms"] < both["median_ms_ball"])
    return verdict(every(slower, lambda ratio: ratio > 1.0) if told_apart.all() else None, figure)


def by_proxy(evidence: Evidence) -> pd.DataFrame:
    """Return Newton's rows of Table 1's views in each proxy, on the first device.

    There is no row unless there are several proxies. The column `waste` is the share of a row's fragments that have no
    hit.
    """
    rows = evidence.rows(picks.NEWTON_3, picks.TORUS).iloc[:0]
    found = evidence.finished(picks.NEWTON_3.method, picks.TORUS)
    found = found[found["stage"].eq("raster") & found["view_set"].eq("angles")]
    if found["proxy"].nunique() < 2:
        return rows.assign(waste=pd.Series(dtype=float))
    found = derive.on_first_device(found)
    return found.assign(waste=found["fragments_discarded"].astype("float64") / found["fragments"].astype("float64"))


def _tetrahedron_wastes(evidence: Evidence) -> Verdict | None:
    rows = by_proxy(evidence)
    box, tetrahedron = (rows[rows["proxy"] == name] for name in ("box", "tetrahedron"))
    both = tetrahedron.merge(box[["comparison", "waste"]], on="comparison", suffixes=("", "_box"))
    if both.empty:
        return None
    times = evidence.over(
        tetrahedron.dropna(subset=["median_ms"]), box.dropna(subset=["median_ms"]), ["comparison", "device"]
    )
    figure = (
        f"fragments without a hit: {wording.percentage(both['waste'].min())} to "
        f"{wording.percentage(both['waste'].max())} of the tetrahedron's, "
        f"{wording.percentage(both['waste_box'].min())} to {wording.percentage(both['waste_box'].max())} of the box's, "
        f"over {cases(both)}; the tetrahedron takes {quantities(times['ratio'])} the box's time{lost(times)}"
    )
    return verdict(every(both["waste"] - both["waste_box"], lambda more: more > 0.0), figure)


def by_normal(evidence: Evidence) -> pd.DataFrame:
    """Return Newton's rows of the torus shaded by each normal, on the first device.

    There is no row unless there are several normals.
    """
    found = evidence.finished(picks.NEWTON_3.method, picks.TORUS)
    found = found[found["proxy"].eq("box")].dropna(subset=["median_ms", "normal"])
    if found["normal"].nunique() < 2:
        return found.iloc[:0]
    return derive.on_first_device(found)


def shaded(rows: pd.DataFrame, slow: str, fast: str) -> pd.DataFrame:
    """Divide the times of frames shaded by the normal `slow` by those shaded by `fast`, view by view.

    Returns what `rounds.over` returns.
    """
    long, short = (rows[rows["normal"] == name] for name in (slow, fast))
    return rounds.over(long, short, ["comparison", "device"])


def _core_circle_is_cheaper(evidence: Evidence) -> Verdict | None:
    rows = by_normal(evidence)
    ratios = shaded(rows, "gradient", "core_circle")
    if ratios.empty:
        return None
    figure = f"frames shaded by f's gradient take {quantities(ratios['ratio'])} the time of those shaded by the core "
    figure += f"circle{lost(ratios)}"
    other = shaded(rows, "distance", "core_circle")
    figure += "" if other.empty else f"; by the distance's gradient {quantities(other['ratio'])}"
    return verdict(always(ratios), figure)


def _sampled(evidence: Evidence) -> dict[str, Any] | None:
    """Return the row of the study of T along random rays; None where the study was not run."""
    rows = evidence.studies.get("torus_along_rays", [])
    return next((row for row in rows if row["case"] == "sampled"), None)


def _extremes(evidence: Evidence) -> Verdict | None:
    found = _sampled(evidence)
    if found is None:
        return None
    minima, maxima = found["minima"], found["maxima"]
    figure = f"local minima: {minima} at most, local maxima: {maxima} at most, on {found['rays']:,} rays"
    figure += "; with a = 1 the two words are exchanged" if (minima, maxima) == (2, 1) else ""
    return verdict(maxima <= 2 and minima <= 1, figure)


def _mean_of_roots(evidence: Evidence) -> Verdict | None:
    found = _sampled(evidence)
    if found is None:
        return None
    off, other = found["mean_error"], found["equation_error"]
    figure = f"t_M is off the mean by {wording.error(off)} at most, T by equation 2 off the torus's formula by "
    figure += f"{wording.error(other)} of its largest value, on {found['rays']:,} rays"
    return verdict(off < EXACT and other < EXACT, figure)


def _pays(piece: Pick, without: Pick, surfaces: tuple[str, ...]) -> Judge:
    """Make a judge of "`piece` is faster than `without`"; the figure adds the evaluations and wrong rays of each."""

    def decide(evidence: Evidence) -> Verdict | None:
        ratios = evidence.ratios(without, piece, surfaces)
        if ratios.empty:
            return None
        told = f"{piece.words} is {quantities(ratios['ratio'])} as fast as {without.words}{lost(ratios)}"
        for pick in (without, piece):
            rows = evidence.rows(pick, surfaces)
            told += f"; {pick.words}: {wording.number(rows['evaluations_mean'].mean())} evaluations a ray, "
            told += (
                f"{wording.count(rows['wrong_rays'].sum())} wrong of {wording.count(rows['accuracy_rays'].sum())} rays"
            )
        return verdict(always(ratios), told)

    return decide


CLAIMS = (
    Claim(
        PAPER,
        "4.2",
        "T has at most two local maxima and at most one local minimum.",
        "Roots of T' by the sign of T'', along random rays",
        _extremes,
        ("double_derivative_bisection",),
        FIGURE_3,
    ),
    Claim(
        PAPER,
        "4.2",
        "t_M = -(o·v) is the mean of the roots of T', with T as equation 2 prints it.",
        "Complex roots of T' in float64, and equation 2 against the catalog's formula, along random rays",
        _mean_of_roots,
        ("double_derivative_bisection",),
        FIGURE_3,
    ),
    Claim(
        PAPER,
        "3",
        "Sturm's discard before the search is worth having.",
        "Time of Sturm that searches for a ray's root before it discards the ray, over Sturm; cubics and torus",
        _pays(picks.STURM, picks.STURM_SEARCHING, SEARCHED),
        ("sturm",),
        CUBICS,
    ),
    Claim(
        PAPER,
        "3",
        "Sturm's method on cubics is not as fast as the ray casting of quadrics.",
        "Frame times of Sturm on each cubic of Figure 2, and of a closed form on the sphere",
        _cubics_are_slower,
        ("sturm", "analytic"),
        CUBICS,
    ),
    Claim(
        PAPER,
        "2",
        "A tetrahedron about the torus wastes more fragments than a box.",
        "Share of the proxy's fragments without a hit, at each of Table 1's angles",
        _tetrahedron_wastes,
        ("newton",),
        PROXIES,
    ),
    Claim(
        PAPER,
        "4.5",
        "The normal from the torus's core circle is cheaper than that from f's partial derivatives.",
        "Time of frames by Newton 0.001 shaded by f's gradient over the same shaded by equation 6, every view",
        _core_circle_is_cheaper,
        ("newton",),
        NORMALS,
    ),
    Claim(
        PAPER,
        "4.4",
        "Newton's start on the sphere of radius R + r pays.",
        "Time of Newton 0.001 from the box over Newton 0.001, torus, every view",
        beside(
            _pays(picks.NEWTON_3, picks.NEWTON_FROM_BOX, picks.TORUS),
            _pays(picks.NEWTON_3_FORWARDS, picks.FORWARDS_FROM_BOX, picks.TORUS),
            "steps forwards",
        ),
        ("newton",),
        VIEWS,
    ),
)
