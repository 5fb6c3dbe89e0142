"""What szente claims."""

from __future__ import annotations

from typing import Any

import pandas as pd

from reports import counts, published, wording
from reports.claims import picks
from reports.claims.model import (
    Claim,
    Verdict,
    always,
    both,
    count,
    counted,
    every,
    faster,
    known,
    lost,
    mean_ratio,
    quantities,
    untestable,
    verdict,
)
from reports.evidence import Evidence, Pick, over

PAPER = "szente"
SOME = 0.001  # a larger share of rays, where a test says so, is “some rays”
FIG_1, TABLE_4, TABLE_5, STUDIES = (
    "szente-fig1.toml",
    "szente-table4.toml",
    "szente-table5.toml",
    "szente-tables-1-2.toml",
)


def condition(evidence: Evidence) -> pd.DataFrame:
    """Our Table 1: index basis, one column for each degree; empty where the study was not run."""
    rows = pd.DataFrame(evidence.studies.get("condition_numbers", []), columns=["basis", "degree", "condition"])
    return rows.pivot_table(index="basis", columns="degree", values="condition", sort=False)


def bounds(evidence: Evidence) -> pd.DataFrame:
    """Our Table 2: index (reading, bound), one column for each degree."""
    columns = ["reading", "bound", "degree", "percent"]
    rows = pd.DataFrame(evidence.studies.get("extrema_bounds", []), columns=columns)
    return rows.pivot_table(index=["reading", "bound"], columns="degree", values="percent", sort=False)


def _digits(evidence: Evidence) -> Verdict | None:
    ours, paper = condition(evidence), published.table("szente_table1_condition")
    if ours.empty:
        return None
    same = [f"{ours.loc[row['basis'], n]:.2f}" == row[f"degree_{n}"] for row in paper.rows for n in ours.columns]
    missing = bool(ours.isna().any(axis=None)) or not same
    told = f"{sum(same)} of {len(same)} figures agree in every printed digit"
    return verdict(None if missing else all(same), told)


def _better_interval(evidence: Evidence) -> Verdict | None:
    ours = condition(evidence)
    if "monomial on [0, 1]" not in ours.index:
        return None
    ratio = ours.loc["monomial on [0, 1]"] / ours.loc["monomial"]
    told = ", ".join(f"{wording.factor(value)} at degree {n}" for n, value in ratio.items())
    return verdict(every(ratio, lambda r: r > 1.0), f"on [0, 1] it is larger {told}")


def _steadier_basis(evidence: Evidence) -> Verdict | None:
    ours = condition(evidence)
    if ours.empty:
        return None
    ratio = ours.loc["monomial"] / ours.loc["Bernstein"]
    told = ", ".join(f"{wording.factor(value)} at degree {n}" for n, value in ratio.items())
    return verdict(every(ratio, lambda r: r > 1.0), f"the monomial basis is worse conditioned {told}")


_WRONG = ("wrong_rays", "grazing_wrong_rays")


def _paired(evidence: Evidence, first: Pick, second: Pick, surfaces: tuple[str, ...]) -> list[pd.DataFrame]:
    """The first device's rows of both on the surfaces that both have, in the same order."""
    rows = [evidence.rows(pick, surfaces).drop_duplicates("surface").set_index("surface") for pick in (first, second)]
    shared = rows[0].index.intersection(rows[1].index, sort=False)
    return [own.loc[shared] for own in rows]


def _told(rows: pd.DataFrame) -> str:
    """Wrong rays, silhouettes included, of each surface."""
    found = [(row["surface_title"], counted(rows.loc[[name]], *_WRONG)) for name, row in rows.iterrows()]
    return ", ".join(f"{title} {count(n)}" for title, n in found)


def _more_wrong(rows: pd.DataFrame, others: pd.DataFrame, factor: float = 1.0) -> bool | None:
    """Whether `rows` answer more than `factor` times as many rays wrongly, silhouettes included; no, where they answer
    none wrongly."""
    bad, of = counted(rows, *_WRONG), counted(rows, "accuracy_rays")
    other, of_other = counted(others, *_WRONG), counted(others, "accuracy_rays")
    if bad is None or of is None or other is None or of_other is None:
        return None
    return False if bad == 0 else counts.exceeds(bad, of, other, of_other, factor)


def _each(rows: pd.DataFrame) -> str:
    """Of how many rays a count of each surface is."""
    return f"of {wording.count(rows['accuracy_rays'].max())} rays each"


def _artifacts(without: Pick, cured: Pick, surfaces: tuple[str, ...]) -> Any:
    """A judge of "`without` draws artifacts that `cured` does not": at most a tenth of the wrong rays is left."""

    def decide(evidence: Evidence) -> Verdict | None:
        before, after = _paired(evidence, without, cured, surfaces)
        if before.empty:
            return None
        figure = f"wrong rays, {without.words}: {_told(before)}; {cured.words}: {_told(after)}; {_each(before)}"
        return verdict(_more_wrong(before, after, 10.0), figure)

    return decide


def _indispensable(evidence: Evidence) -> Verdict | None:
    without, whole = _paired(evidence, picks.NO_EFT, picks.FIT, picks.HIGH_DEGREE)
    if without.empty:
        return None
    figure = f"wrong rays, {picks.NO_EFT.words}: {_told(without)}; {picks.FIT.words}: {_told(whole)}; {_each(whole)}"
    return verdict(_more_wrong(without, whole, 2.0), figure)


def _no_artifacts(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.FIT, picks.TABLE_4)
    if rows.empty:
        return None
    bad, of = counted(rows, "wrong_rays"), counted(rows, "accuracy_rays")
    told = f"{count(bad)} wrong rays of {count(of)} on {rows['surface'].nunique()} surfaces"
    return verdict(known(bad, lambda n: n == 0), told)


def _speedup(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.MARCH, picks.FIT, picks.TABLE_4)
    if ratios.empty:
        return None
    return verdict(mean_ratio(ratios, 23.6), f"{quantities(ratios['ratio'])}; the paper: 23.6× (3.3× to 38.4×)")


def _share(part: Pick, most: float, paper: str) -> Any:
    """A judge of "switching this part off saves at most a share `most` of the whole time"."""

    def decide(evidence: Evidence) -> Verdict | None:
        ratios = evidence.ratios(part, picks.FIT, picks.TABLE_4)
        if ratios.empty:
            return None
        shares = 1.0 - ratios["ratio"]
        return verdict(mean_ratio(ratios, 1.0 - most), f"{quantities(shares, _percent)}; the paper: {paper}")

    return decide


def _percent(value: float) -> str:
    return f"{100 * value:.0f} %".replace("-", "−")


def _sphere(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.NO_EVAL, picks.FIT, ("sphere",))
    if ratios.empty:
        return None
    return verdict(
        mean_ratio(ratios, 1.0), f"without direct evaluation it takes {quantities(ratios['ratio'])} the time"
    )


def _thin_features(evidence: Evidence) -> Verdict | None:
    ours, march = _paired(evidence, picks.FIT, picks.MARCH, ("calyx", "sixteen_ball", "endrass_octic"))
    if ours.empty:
        return None
    figure = f"wrong rays, {picks.FIT.words}: {_told(ours)}; ray marching: {_told(march)}; {_each(ours)}"
    return verdict(_more_wrong(march, ours), figure)


def _sharper(evidence: Evidence) -> Verdict | None:
    ours = bounds(evidence)
    if ours.empty:
        return None
    first = ours.index.get_level_values("reading")[0]
    gain = ours.loc[first, "control point"] - ours.loc[first, "LU"]
    figure = f"as described, {quantities(gain, lambda v: f'{v:.1f}')} points sharper, most at degree {gain.idxmax()}"
    paper = published.table("szente_table2_bounds").rows
    theirs = [float(paper[0][str(n)]) - float(paper[1][str(n)]) for n in gain.index]
    return verdict(
        known(gain.mean(skipna=False), lambda points: points >= 15.0),
        f"{figure}; the paper's Table 2: {quantities(theirs, lambda v: f'{v:.1f}')}",
    )


def _never_looser(evidence: Evidence) -> Verdict | None:
    ours = bounds(evidence)
    if ours.empty:
        return None
    readings = [r for r in ours.index.get_level_values("reading").unique() if "1/n" not in r]
    gaps = [ours.loc[r, "control point"] - ours.loc[r, "LU"] for r in readings]
    least = float(pd.concat(gaps).min(skipna=False)) if gaps else float("nan")
    return verdict(
        known(least, lambda gap: gap >= -1e-9), f"smallest gain over {sum(map(len, gaps))} averages: {least:.3f} points"
    )


def _lu_misses_nothing(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.LU, picks.TABLE_5)
    if rows.empty:
        return None
    bad, of = counted(rows, "misses", "wrong_root"), counted(rows, "accuracy_rays")
    told = f"{count(bad)} misses and wrong roots of {count(of)} rays on {rows['surface'].nunique()} surfaces"
    return verdict(known(bad, lambda n: n == 0), told)


def _out_of_steps(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.LU, picks.HIGH_DEGREE).drop_duplicates("surface")
    if rows.empty:
        return None
    given_up = rows["exhausted"] + rows["grazing_exhausted"] + rows["drowned_exhausted"]
    share = given_up.astype(float) / rows["accuracy_rays"].astype(float)
    told = ", ".join(f"{t} {wording.share(s)}" for t, s in zip(rows["surface_title"], share, strict=True))
    held = []
    for i in range(len(rows)):
        spent, of = (
            counted(rows.iloc[[i]], *names) for names in (("exhausted", "grazing_exhausted"), ("accuracy_rays",))
        )
        held.append(None if spent is None or not of else counts.share_exceeds(spent, of, SOME))
    return verdict(both(*held), f"rays out of steps, of all: {told}")


def _lu_over_marching(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.MARCH, picks.LU, picks.TABLE_5)
    if ratios.empty:
        return None
    return verdict(mean_ratio(ratios, 4.8), f"{quantities(ratios['ratio'])}; the paper's text: 4.8× and 7×")


def _lu_over_control(evidence: Evidence) -> Verdict | None:
    ratios = evidence.ratios(picks.CONTROL, picks.LU, picks.TABLE_5)
    if ratios.empty:
        return None
    each = ", ".join(f"{r.surface_title} {wording.factor(r.ratio)}" for r in ratios.itertuples())
    return verdict(always(ratios), f"{each}{lost(ratios)}; the paper: 1.37×")


def _cheaper_than_double(evidence: Evidence) -> Verdict | None:
    single = evidence.rows(picks.FIT, picks.HIGH_DEGREE).dropna(subset=["median_ms"])
    double = evidence.rows(picks.NO_EFT, picks.HIGH_DEGREE, "float64").dropna(subset=["median_ms"])
    ratios = over(double, single, ["comparison", "device"])
    if ratios.empty:
        return None
    told = f"float64 without EFT takes {quantities(ratios['ratio'])} the time of float32 with it"
    return verdict(mean_ratio(ratios, 1.0), told)


def _degree_hurts(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.BERNSTEIN_NEITHER, picks.HIGH_DEGREE).drop_duplicates("surface").sort_values("degree")
    if len(rows) < 2:
        return None
    share = rows[list(_WRONG)].astype(float).sum(axis=1, skipna=False) / rows["accuracy_rays"].astype(float)
    told = ", ".join(f"degree {d}: {wording.share(s)}" for d, s in zip(rows["degree"], share, strict=True))
    return verdict(
        _more_wrong(rows.iloc[[-1]], rows.iloc[[0]]), f"wrong rays in the Bernstein basis without EFT: {told}"
    )


_EFT = ("eft_yuksel",)
_LU = ("lu_lipschitz",)
CLAIMS = (
    Claim(PAPER, "2.1", "The condition numbers of Table 1.", "The same computed", _digits, _EFT, STUDIES),
    Claim(
        PAPER,
        "2.1",
        "In the monomial basis, nodes on [−1, 1] are better conditioned than nodes on [0, 1].",
        "Condition numbers of both",
        _better_interval,
        _EFT,
        STUDIES,
    ),
    Claim(
        PAPER,
        "Table 1",
        "The Bernstein basis is better conditioned than the monomial one.",
        "Condition numbers of both",
        _steadier_basis,
        _EFT,
        STUDIES,
    ),
    Claim(
        PAPER,
        "1",
        "Fitting is numerically unstable at higher degrees.",
        "Wrong rays of the plain fit by degree",
        _degree_hurts,
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "Fig. 1",
        "Without EFT and direct evaluation there are artifacts, with both none (monomial basis).",
        "Wrong rays of both at degrees 8, 10 and 16, silhouettes included; under a tenth left",
        _artifacts(picks.NEITHER, picks.FIT, picks.HIGH_DEGREE),
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "Fig. 1",
        "EFT alone removes most artifacts of the plain fit (monomial basis, degrees 8 and 10).",
        "The same without direct evaluation",
        _artifacts(picks.NEITHER, picks.NO_EVAL, ("endrass_octic", "barth_decic")),
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "Fig. 1",
        "EFT alone removes most artifacts of the plain fit (monomial basis, degree 16).",
        "The same on the 16-ball",
        _artifacts(picks.NEITHER, picks.NO_EVAL, ("sixteen_ball",)),
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "Fig. 1",
        "The same, in the Bernstein basis.",
        "The same, in the Bernstein basis, all three surfaces",
        _artifacts(picks.BERNSTEIN_NEITHER, picks.BERNSTEIN_NO_EVAL, picks.HIGH_DEGREE),
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "2.1",
        "EFT is indispensable: nothing else in the method mends what a plain fit loses (degree 8 and more).",
        "Wrong rays with direct evaluation but without EFT, against both: more than twice as many",
        _indispensable,
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "1",
        "EFT gives the precision without the cost of double precision.",
        "Time in float64 without EFT over float32 with it",
        _cheaper_than_double,
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "4",
        "No artifacts on any of the surfaces of Table 4.",
        "Wrong rays away from silhouettes",
        _no_artifacts,
        _EFT,
        TABLE_4,
    ),
    Claim(
        PAPER,
        "4",
        "Around thin features it is more accurate than the ray marching taken as truth.",
        "Wrong rays of both on the surfaces of Figure 2, silhouettes included",
        _thin_features,
        ("eft_yuksel", "ray_march"),
        "szente-fig2.toml",
    ),
    Claim(
        PAPER,
        "4",
        "23.6 times as fast as ray marching, in the mean.",
        "Time of ray marching over EFT + EVAL, seven surfaces",
        _speedup,
        _EFT,
        TABLE_4,
    ),
    Claim(
        PAPER,
        "Table 4",
        "EFT takes a quarter of the time.",
        "1 − time without EFT over time with it; at most 24 % in the mean",
        _share(picks.NO_EFT, 0.24, "24 % in the mean (5 % to 39 %)"),
        _EFT,
        TABLE_4,
    ),
    Claim(
        PAPER,
        "Table 4",
        "Direct evaluation takes less than a tenth of the time.",
        "1 − time without it over time with it; at most 10 % in the mean",
        _share(picks.NO_EVAL, 0.10, "8 % in the mean (−8 % to 17 %)"),
        _EFT,
        TABLE_4,
    ),
    Claim(
        PAPER,
        "4",
        "On the sphere direct evaluation is faster than the polynomial.",
        "Time without direct evaluation over time with it",
        _sphere,
        _EFT,
        TABLE_4,
    ),
    Claim(PAPER, "3", "LU bounds are never looser than control points.", "Both, averaged", _never_looser, _LU, STUDIES),
    Claim(
        PAPER,
        "3",
        "LU bounds are about 20 % sharper.",
        "Difference of both errors as Table 2 describes them; at least 15 points in the mean",
        _sharper,
        _LU,
        STUDIES,
    ),
    Claim(
        PAPER,
        "1, 3",
        "Lipschitz tracing by LU bounds misses no surface feature.",
        "Misses and wrong roots away from silhouettes on the surfaces of Table 5",
        _lu_misses_nothing,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "4",
        "LU bounds are consistently faster than control points.",
        "Time of control points over LU, surface by surface",
        _lu_over_control,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "4",
        "LU tracing is 4.8 times as fast as ray marching.",
        "Time of ray marching over LU, mean of four surfaces",
        _lu_over_marching,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "4",
        "Surfaces of higher degree run out of the iteration cap.",
        f"Exhausted rays at degrees 8, 10 and 16: more than {100 * SOME:g} % of each",
        _out_of_steps,
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "5",
        "Bounds that follow the interval may be faster still (future work).",
        "Time of one bound for the ray over bounds that follow it",
        faster(picks.LU, picks.LU_LOCAL, picks.TABLE_5),
        _LU,
        TABLE_5,
    ),
    Claim(
        PAPER,
        "2.2",
        "Register efficiency on consumer graphics hardware.",
        "none",
        untestable,
        reason="registers are no part of what a device here reports",
    ),
)
