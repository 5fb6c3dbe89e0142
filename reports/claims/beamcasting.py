"""Claims of beamcasting."""

from __future__ import annotations

import json
import math

import numpy as np
import pandas as pd

from harness.results import ranks
from reports import wording
from reports.analysis import derive
from reports.analysis.idle_lanes import WARP, idle_share
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import (
    Claim,
    Judge,
    Verdict,
    always,
    at_least,
    count,
    counted,
    known,
    quantities,
    rays,
    untestable,
    verdict,
)
from reports.reading.tuples import tuples

PAPER = "beamcasting"
TABLES = "beamcasting-tables.toml"
DIVERGENCE = "beamcasting-divergence.toml"
MUCH = 0.25  # the idle share of a warp's lanes that is called much
TOLD_APART = 0.01  # idle shares differ by so much from run to run, because the order of the queue does
LEVEL = 0.01  # the largest chance that is evidence of a growing gain
_BOTH = ("interval_uniform", "interval_adaptive")


def _ratios(evidence: Evidence) -> pd.DataFrame:
    return evidence.ratios(picks.UNIFORM, picks.ADAPTIVE)


def _always(evidence: Evidence) -> Verdict | None:
    ratios = _ratios(evidence)
    if ratios.empty:
        return None
    lost = ratios[ratios["ratio_high"] < 1.0]
    even = int((~(ratios["ratio_low"] > 1.0)).sum()) - len(lost)
    named = ", ".join(
        f"{r.surface_title} {r.size}×{r.samples_per_pixel} {wording.factor(r.ratio)}" for r in tuples(lost)
    )
    figure = f"{quantities(ratios['ratio'])}; the paper: 1.16× to 2.85×" + (f"; slower: {named}" if named else "")
    figure += f"; not told apart in {even} of {len(ratios)}" if even else ""
    return verdict(always(ratios), figure)


def _grows(evidence: Evidence, by: str, kept: str, told_there: str) -> Verdict | None:
    """Judge whether the gain grows with the column `by`, at each value of the column `kept`.

    `told_there` is what the paper prints.
    """
    ratios = _ratios(evidence)
    table = ratios.pivot_table(index=["device", "surface", kept], columns=by, values="ratio").dropna()
    if table.shape[1] < 2 or table.empty:
        return None
    low, high = table.columns[0], table.columns[-1]
    more = int((table[high] > table[low]).sum())
    figure = (
        f"mean ratio {wording.factor(table[low].mean())} at {low} and {wording.factor(table[high].mean())} at {high}"
    )
    growth = np.log(table[high] / table[low])
    chance = ranks.signed_rank(list(growth))
    told = None if chance > LEVEL else bool(growth.median() > 0.0)
    figure += f"; larger in {more} of {len(table)}, of which chance {wording.short(chance)}; the paper: {told_there}"
    return verdict(told, figure)


def _resolution(evidence: Evidence) -> Verdict | None:
    return _grows(evidence, "size", "samples_per_pixel", "1.59× and 1.81×, larger in 22 of 24")


def _samples(evidence: Evidence) -> Verdict | None:
    return _grows(evidence, "samples_per_pixel", "size", "1.49× and 1.91×, larger in 23 of 24")


def _closer_with_samples(evidence: Evidence) -> Verdict | None:
    rows = pd.concat([evidence.rows(pick) for pick in (picks.UNIFORM, picks.ADAPTIVE)])
    table = rows.pivot_table(
        index=["device", "method", "surface", "size"], columns="samples_per_pixel", values="error_p99"
    ).dropna()
    if table.shape[1] < 2 or table.empty:
        return None
    missing = int(rows["error_p99"].isna().sum())
    few, many = table.columns[0], table.columns[-1]
    closer = int((table[many] < table[few]).sum())
    share = wording.factor((table[few] / table[many]).median())
    told = f"99th percentile of the error at {few} over {many} samples: {share} (median)"
    told += f"; smaller in {closer} of {len(table)}"
    if missing:
        return verdict(None, f"{told}; {wording.plural(missing, 'row')} without an error")
    return verdict(closer == len(table), told)


def _beyond_algebra(evidence: Evidence) -> Verdict | None:
    rows = pd.concat([evidence.rows(pick) for pick in (picks.UNIFORM, picks.ADAPTIVE)])
    algebraic = rows[rows["degree"].notna()]
    rows = rows[rows["degree"].isna()]
    if rows.empty:
        return None
    misses = counted(rows, "misses", "grazing_misses", "drowned_misses")
    told = f"{count(misses)} misses of {rays(rows)}; {_wrong_roots(rows)}"
    told += f", on algebraic surfaces {_wrong_roots(algebraic)}" if len(algebraic) else ""
    return verdict(known(misses, lambda n: n == 0), told)


def _wrong_roots(rows: pd.DataFrame) -> str:
    """Write how often a beam finds another root than its middle ray.

    A beam may touch a piece of the surface that its middle ray does not hit; no method of beams tells these apart.
    """
    wrong, of = counted(rows, "wrong_root"), counted(rows, "accuracy_rays")
    return f"other roots than the middle ray's: {count(wrong)} of {count(of)}"


def _nothing_missed(evidence: Evidence) -> Verdict | None:
    rows = pd.concat([evidence.rows(pick) for pick in (picks.UNIFORM, picks.ADAPTIVE)])
    if rows.empty:
        return None
    misses = counted(rows, "misses", "grazing_misses", "drowned_misses")
    told = f"{count(misses)} misses of {rays(rows)}"
    return verdict(known(misses, lambda n: n == 0), told)


def _complexity(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.UNIFORM).dropna(subset=["median_ms"])
    own = rows.drop_duplicates(["surface"])
    own = own[own["operations"].notna()]
    if len(own) < 4:
        return None
    operations = own["operations"].map(lambda text: sum(json.loads(text).values())).astype(float)
    rank = float(operations.rank().corr(own["median_ms"].rank()))
    # E. C. Fieller, H. O. Hartley, E. S. Pearson, Tests for rank correlation coefficients, 1957: of atanh, at 95 %
    reach = 1.96 * math.sqrt(1.06 / (len(own) - 3))
    middle = math.atanh(min(max(rank, -0.999999), 0.999999))
    low, high = math.tanh(middle - reach), math.tanh(middle + reach)
    told = f"{rank:.2f}, at 95 % from {low:.2f} to {high:.2f}".replace("-", "−")
    return verdict(
        at_least(low, high, 0.5),
        f"rank correlation of operations and time over {wording.plural(len(own), 'surface')}: {told}",
    )


def _idle(evidence: Evidence, pick: Pick) -> pd.DataFrame:
    """Return the rows of `pick` that store their levels, with the idle share of warps as `idle`."""
    rows = evidence.rows(pick)
    idle = [idle_share(row, WARP) for row in tuples(rows)]
    return rows.assign(idle=pd.Series(idle, rows.index, dtype="float64")).dropna(subset=["idle"])


def _divergence(evidence: Evidence) -> Verdict | None:
    adaptive, uniform = (_idle(evidence, pick) for pick in (picks.ADAPTIVE, picks.UNIFORM))
    if adaptive.empty or uniform.empty:
        return None
    shares, beside = (quantities(rows["idle"], wording.share) for rows in (adaptive, uniform))
    told = f"idle of {WARP} lanes: adaptive {shares}; uniform {beside}"
    return verdict(at_least(adaptive["idle"].min(), adaptive["idle"].max(), MUCH), told)


def _less_idle(before: Pick, after: Pick) -> Judge:
    """Make a judge of "`after` leaves less idle than `before`": by more than TOLD_APART, on every surface."""

    def decide(evidence: Evidence) -> Verdict | None:
        own, other = (_idle(evidence, pick) for pick in (before, after))
        if own.empty or other.empty:
            return None
        both = own.merge(other, on=derive.GROUP, suffixes=("", "_after"))
        if both.empty:
            return None
        gain = both["idle"] - both["idle_after"]
        shares = (quantities(both[name], wording.share) for name in ("idle", "idle_after"))
        told = f"idle of {WARP} lanes: {' before, '.join(shares)} after"
        if len(ratios := evidence.ratios(before, after)):
            told += f"; time before over after: {quantities(ratios['ratio'])}"
        return verdict(at_least(float(gain.min()), float(gain.max()), TOLD_APART), told)

    return decide


CLAIMS = (
    Claim(
        PAPER,
        "IV",
        "In all cases the adaptive method beats the uniform one.",
        "Time of uniform over adaptive: every surface, size and number of samples",
        _always,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "Tables I, II",
        "The gain grows with the resolution.",
        f"That ratio at the smallest and the largest size: signed-rank test of the cases, at {LEVEL:g}",
        _resolution,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "Tables I, II",
        "The gain grows with the samples per pixel.",
        f"That ratio at 1 and at 4 samples: signed-rank test of the cases, at {LEVEL:g}",
        _samples,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "III.D",
        "More samples per pixel approximate the surface better.",
        "99th percentile of the error at 1 and at 4 samples, every surface and size",
        _closer_with_samples,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "Beams are not restricted to algebraic surfaces.",
        "Misses on the Blinn blob, silhouettes included; wrong roots beside those of algebraic surfaces",
        _beyond_algebra,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "I",
        "All parts of the surface are seen.",
        "Misses, silhouettes included, on every surface",
        _nothing_missed,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "Speed falls with the complexity of the expression.",
        "Rank correlation of operations and time of the uniform method, its whole 95 % interval above 0.5",
        _complexity,
        _BOTH,
        TABLES,
    ),
    Claim(
        PAPER,
        "IV",
        "Real-time frame rates in almost all cases.",
        "none",
        untestable,
        reason="an absolute speed of a GTX 470; the tables of results say what this device does",
    ),
    Claim(
        PAPER,
        "III.E",
        "Grouping threads by the place of their beams lowers divergence.",
        f"Idle share of {WARP} lanes, uniform method: pixels row by row, and in Z order",
        _less_idle(picks.UNIFORM_IN_ROWS, picks.UNIFORM),
        ("interval_uniform",),
        DIVERGENCE,
    ),
    Claim(
        PAPER,
        "V",
        "Divergence within a warp costs much.",
        f"Idle share of {WARP} lanes, adaptive method as printed: at least {MUCH:.0%} on every surface",
        _divergence,
        _BOTH,
        DIVERGENCE,
    ),
    Claim(
        PAPER,
        "V",
        "Remapping threads by the position of their beams relative to the surface lowers divergence (planned).",
        f"Idle share of {WARP} lanes: quarters in turn, and those last whose parent evaluated f over 16 times",
        _less_idle(picks.ADAPTIVE, picks.REMAPPED),
        ("interval_adaptive",),
        DIVERGENCE,
    ),
    Claim(
        PAPER,
        "V",
        "Affine arithmetic would help (future work).",
        "none",
        untestable,
        reason="no method here has affine arithmetic",
    ),
)
