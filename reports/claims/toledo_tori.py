"""Claims of toledo2007 about views and many tori (sections 5.1 and 5.2, Table 1 and Figure 6)."""

from __future__ import annotations

import math

import pandas as pd

from reports import wording
from reports.analysis import derive, rounds
from reports.analysis.viewstats import spread
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import (
    Claim,
    Judge,
    Outcome,
    Verdict,
    always,
    beside,
    both,
    faster,
    lost,
    quantities,
    verdict,
)
from reports.claims.toledo import PAPER
from reports.reading.tuples import tuples

CONFIG = "toledo-fig6.toml"
TABLE_1 = "toledo-table1.toml"
PICKS = (picks.NEWTON_3, picks.NEWTON_5, *picks.POLYGONS[:3])
OURS = picks.NEWTON_3_FORWARDS
OVERTAKES = 700  # tori
MANY = 16_000
LOD = "toledo-lod.toml"
DETAIL = 0.1  # footprints of a pixel that an error may grow to, and is not seen
_PICTURE = ["device", "view", "size", "samples_per_pixel", "precision"]
INTERACTIVE_MS = 20.0  # 50 frames per second


def tori(evidence: Evidence) -> pd.DataFrame:
    """Return the timed rows of Figure 6's techniques and of ours on lattices, with the column `technique`.

    They are of the first device that has them and, where a run draws each lattice in several pictures, of the first
    picture. Where no row is of polygons, none is returned: the lattices are then of another experiment.
    """
    rows = pd.concat([evidence.rows(pick).assign(technique=pick.words) for pick in (*PICKS, OURS)])
    rows = rows[(rows["scene"] == "lattice") & ~(rows["pixel_tolerance"] > 0.0)].dropna(subset=["median_ms"])
    if not (rows["method"] == "polygon").any():  # the lattices are of another experiment
        return rows.iloc[:0]
    rows = rows[(rows[_PICTURE] == rows[_PICTURE].iloc[0]).all(axis=1)] if len(rows) else rows
    return rows.drop_duplicates(["technique", "instances"])


def curve(rows: pd.DataFrame, pick: Pick) -> pd.Series:
    """Return a technique's median times in ms, indexed by the number of tori, ascending."""
    own = rows[rows["technique"] == pick.words]
    return own.set_index(own["instances"].astype(int))["median_ms"].sort_index()


def crossing(fast: pd.Series, slow: pd.Series) -> float | None:
    """Return the number of tori from which on `fast` is faster; 1 if it always is.

    None if it is not faster at the largest number that both have, or if they have none in common. Between two counts
    that both have it is interpolated, on logarithmic axes.
    """
    both = sorted(fast.index.intersection(slow.index))
    lead = [math.log(slow[n] / fast[n]) for n in both]
    if not both or lead[-1] <= 0.0:
        return None
    behind = [i for i, ahead in enumerate(lead) if ahead <= 0.0]
    if not behind:
        return 1.0
    i = behind[-1]
    share = -lead[i] / (lead[i + 1] - lead[i])
    return math.exp(math.log(both[i]) + share * math.log(both[i + 1] / both[i]))


def _fastest_for_many(newton: Pick) -> Judge:
    """Make a judge of "`newton` is faster than every other technique for OVERTAKES tori and more"."""

    def decide(evidence: Evidence) -> Verdict | None:
        rows = tori(evidence)
        own = curve(rows, newton) if len(rows) else pd.Series(dtype=float)
        others = [pick for pick in PICKS[2:] if len(rows) and not curve(rows, pick).empty]
        if own.empty or not others or own.index.max() < OVERTAKES:
            return None
        at = {pick.words: crossing(own, curve(rows, pick)) for pick in others}
        told = ", ".join(
            f"{words} {'nowhere' if n is None else 'from the first' if n <= 1.0 else f'from {n:,.0f} tori'}"
            for words, n in at.items()
        )
        beyond = rows[rows["instances"].astype("float64") >= OVERTAKES]
        held = [always(_against(beyond, pick, newton)) for pick in others]
        return verdict(both(*held), f"{newton.words} overtakes {told}; the paper: from 700 on it is the fastest")

    return decide


def _against(rows: pd.DataFrame, pick: Pick, newton: Pick) -> pd.DataFrame:
    """Divide `pick`'s times by `newton`'s for each number of tori that both drew, as `rounds.over` does."""
    slow, fast = (rows[rows["technique"] == of.words] for of in (pick, newton))
    return rounds.over(slow, fast, ["comparison", "device"])


def _faster_at_equal_error(newton: Pick) -> Judge:
    """Make a judge of "`newton` is always faster than the polygons of about its error"."""

    def decide(evidence: Evidence) -> Verdict | None:
        rows = tori(evidence)
        if rows.empty:
            return None
        ratios = _against(rows, picks.POLYGONS[2], newton)
        tori_drawn = ratios["instances"].astype("float64")
        if tori_drawn.nunique() < 3:
            return None
        figure = f"Polygon 128*128 takes {quantities(ratios['ratio'])} {newton.words}'s time{lost(ratios)}, from "
        return verdict(always(ratios), f"{figure}{tori_drawn.min():.0f} to {tori_drawn.max():,.0f} tori")

    return decide


def _only_one_interactive(evidence: Evidence) -> Verdict | None:
    rows = tori(evidence)
    if len(rows):
        rows = rows[(rows["instances"].astype("float64") >= MANY) & (rows["technique"] != OURS.words)]
    if rows.empty:
        return None
    if not (rows["median_ms"] <= INTERACTIVE_MS).any():
        best = rows.loc[rows["median_ms"].idxmin()]
        figure = f"none has 50 frames/s on this device; {best['technique']} is the fastest, {best['median_ms']:,.0f} ms"
        return Verdict(Outcome.UNTESTED, figure)
    quick = sorted(set(rows[rows["median_ms"] <= INTERACTIVE_MS]["technique"]))
    told = f"50 frames/s beyond {MANY:,} tori: {wording.listed(quick)}"
    across = (rows["lower_ms"] <= INTERACTIVE_MS) & (rows["upper_ms"] > INTERACTIVE_MS)
    if (across | ~rounds.proved(rows["samples_ms"])).any():
        return verdict(None, f"{told}; the interval of a time reaches beyond that of 50 frames/s")
    return verdict(quick == [picks.NEWTON_3.words], told)


def _less_memory(evidence: Evidence) -> Verdict | None:
    """Judge by a frame's bytes on the device: the instances, and a proxy's corners or one mesh that all share."""
    rows = tori(evidence)
    rows = rows[rows["technique"] != OURS.words] if len(rows) else rows
    newton = _bytes(rows, picks.NEWTON_3)
    told, held = [], []
    for pick in PICKS[2:]:
        own = _bytes(rows, pick)
        both_drew = sorted(own.index.intersection(newton.index))
        if not both_drew:
            continue
        least, most = both_drew[0], both_drew[-1]
        held += [bool(own[n] > newton[n]) for n in both_drew]
        shares = [f"{wording.factor(own[n] / newton[n])} of {n:,}" for n in dict.fromkeys((least, most))]
        told.append(f"{pick.words} {' and '.join(shares)}")
    if not told:
        return None
    figure = f"bytes over Newton 0.001's ({newton.iloc[0]:,.0f} for {newton.index[0]:,}): {'; '.join(told)} tori"
    return verdict(all(held), f"{figure}; all tori share one mesh, which the paper's may not have")


def _bytes(rows: pd.DataFrame, pick: Pick) -> pd.Series:
    """Return a technique's bytes on the device, indexed by the number of tori, ascending."""
    own = rows[rows["technique"] == pick.words] if len(rows) else rows
    return own.set_index(own["instances"].astype(int))["bytes"].astype("float64").dropna().sort_index()


def detail(evidence: Evidence) -> pd.DataFrame:
    """Divide the times of Sturm with 18 halvings by those at DETAIL pixels, for each number of tori.

    Returns what `rounds.over` returns.
    """
    rows = evidence.finished(picks.STURM.method)
    rows = rows[rows["scene"].eq("lattice")].dropna(subset=["median_ms"])
    whole, seen = (rows[rows["pixel_tolerance"].sub(size).abs() < 1e-9] for size in (0.0, DETAIL))
    return evidence.over(whole, seen, ["comparison", "device"])


def _detail_pays(evidence: Evidence) -> Verdict | None:
    ratios = detail(evidence)
    if ratios.empty:
        return None
    ratios = ratios.assign(tori=ratios["instances"].astype(int)).sort_values("tori")
    each = ", ".join(f"{row.tori:,} tori {wording.factor(row.ratio)}" for row in tuples(ratios))
    worst = wording.number(ratios["pixel_error_max"].max())
    figure = f"18 halvings over those for {DETAIL:g} pixels: {each}; largest error {worst} pixels{lost(ratios)}"
    afar = ratios[ratios["tori"] == ratios["tori"].max()]
    return verdict(always(afar), figure)


def _most_dependent(evidence: Evidence) -> Verdict | None:
    found, noise, sound = {}, {}, True
    for pick in picks.TABLE_1:
        rows = evidence.rows(pick, picks.TORUS)
        rows = rows[(rows["stage"] == "raster") & (rows["view_set"] == "angles")].dropna(subset=["median_ms"])
        rows = derive.on_first_device(rows)
        if len(rows) >= 3:
            found[pick.words] = spread(rows["frames_per_s"] * rows["fragments"].astype("float64"))
            noise[pick.words] = float(((rows["upper_ms"] - rows["lower_ms"]) / (2.0 * rows["median_ms"])).max())
            sound = sound and bool(rounds.proved(rows["samples_ms"]).all())
    if len(found) < len(picks.TABLE_1):
        return None
    order = sorted(found, key=lambda words: -found[words])
    told = ", ".join(f"{words} {100 * found[words]:.1f} %" for words in order)
    told += f"; noise of a view up to {100 * max(noise.values()):.1f} %"
    claimed = (picks.BISECTION.words, picks.ONE_RAY.words)
    others = [words for words in found if words not in claimed]
    gaps = [(found[one] - found[other], noise[one] + noise[other]) for one in claimed for other in others]
    held = [None if not sound or abs(gap) <= reach else gap > 0.0 for gap, reach in gaps]
    return verdict(both(*held), f"StdDev/Average: {told}")


CLAIMS = (
    Claim(
        PAPER,
        "1",
        "A ray-cast primitive needs less memory than its tessellation.",
        "Bytes on the device for frames of Figure 6, against three polygon resolutions",
        _less_memory,
        ("newton", "polygon"),
        CONFIG,
    ),
    Claim(
        PAPER,
        "3",
        "Fewer halvings for surfaces that are farther away (level of detail) improve the speed.",
        f"Time of Sturm with 18 halvings over Sturm with as many as {DETAIL:g} pixels need, on the farthest lattice",
        _detail_pays,
        ("sturm",),
        LOD,
    ),
    Claim(
        PAPER,
        "Table 1",
        "Bisection and sphere tracing depend most on the view.",
        "Spread of megapixels per second over six angles, stage raster, beyond the noise of both",
        _most_dependent,
        ("double_derivative_bisection", "sphere_tracing"),
        TABLE_1,
    ),
    Claim(
        PAPER,
        "5.1",
        "At an error near 0.000015 of R + r, one torus is ray cast much faster than its polygons are drawn.",
        "Time of Polygon 512*512 over Newton 0.00003, stage raster, every view",
        beside(
            faster(picks.POLYGONS[4], picks.NEWTON_5, picks.TORUS, "330 over 24 frames/s, 14×"),
            faster(picks.POLYGONS[4], picks.NEWTON_5_FORWARDS, picks.TORUS),
            "steps forwards",
        ),
        ("newton", "polygon"),
        TABLE_1,
    ),
    Claim(
        PAPER,
        "5.1",
        "At an error near 0.00035 of R + r, polygons are slightly faster than one ray-cast torus.",
        "Time of Newton 0.001 over Polygon 128*128, stage raster, every view",
        beside(
            faster(picks.NEWTON_3, picks.POLYGONS[2], picks.TORUS, "369 over 361 frames/s, 1.02×"),
            faster(picks.NEWTON_3_FORWARDS, picks.POLYGONS[2], picks.TORUS),
            "steps forwards",
        ),
        ("newton", "polygon"),
        TABLE_1,
    ),
    Claim(
        PAPER,
        "5.2",
        "Newton 0.001 is the fastest technique for more than 700 tori.",
        "Frame times on lattices of tori, against three polygon resolutions",
        beside(_fastest_for_many(picks.NEWTON_3), _fastest_for_many(OURS), "steps forwards"),
        ("newton", "polygon"),
        CONFIG,
    ),
    Claim(
        PAPER,
        "5.2",
        "Newton 0.001 is always faster than polygons of 128*128, which have about its error.",
        "Frame times on lattices of tori",
        beside(_faster_at_equal_error(picks.NEWTON_3), _faster_at_equal_error(OURS), "steps forwards"),
        ("newton", "polygon"),
        CONFIG,
    ),
    Claim(
        PAPER,
        "5.2",
        "Beyond 16,000 tori only Newton 0.001 keeps 50 frames/s.",
        "Frame times on lattices of tori",
        _only_one_interactive,
        ("newton", "polygon"),
        CONFIG,
    ),
)
