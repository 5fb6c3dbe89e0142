"""Claims of szente about the fit and its root finding."""

from __future__ import annotations

import pandas as pd

from reports import wording
from reports.analysis import count_tests
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick
from reports.claims.model import (
    Claim,
    Judge,
    Verdict,
    count,
    counted,
    each_mean,
    known,
    mean_ratio,
    quantities,
    rays,
    untestable,
    verdict,
)

PAPER = "szente"
FIG_1, TABLE_4 = "szente-fig1.toml", "szente-table4.toml"


_WRONG = ("wrong_rays", "grazing_wrong_rays")


def _paired(evidence: Evidence, first: Pick, second: Pick, surfaces: tuple[str, ...]) -> list[pd.DataFrame]:
    """Select the first device's rows of both picks, on the surfaces that both have and in the same order."""
    rows = [evidence.rows(pick, surfaces).drop_duplicates("surface").set_index("surface") for pick in (first, second)]
    shared = rows[0].index.intersection(rows[1].index, sort=False)
    return [own.loc[shared] for own in rows]


def _told(rows: pd.DataFrame) -> str:
    """List the wrong rays of each surface, silhouettes included."""
    found = [(row["surface_title"], counted(rows.loc[[name]], *_WRONG)) for name, row in rows.iterrows()]
    return ", ".join(f"{title} {count(n)}" for title, n in found)


def _more_wrong(rows: pd.DataFrame, others: pd.DataFrame, factor: float = 1.0) -> bool | None:
    """Tell whether `rows` answer more than `factor` times as many rays wrongly, silhouettes included.

    False where they answer none wrongly, None where a count is missing.
    """
    bad, of = counted(rows, *_WRONG), counted(rows, "accuracy_rays")
    other, of_other = counted(others, *_WRONG), counted(others, "accuracy_rays")
    if bad is None or of is None or other is None or of_other is None:
        return None
    return False if bad == 0 else count_tests.exceeds(bad, of, other, of_other, factor)


def _each(rows: pd.DataFrame) -> str:
    """Write how many rays each surface's count is out of."""
    return f"of {wording.count(rows['accuracy_rays'].max())} rays each"


def _artifacts(without: Pick, cured: Pick, surfaces: tuple[str, ...]) -> Judge:
    """Make a judge of "`without` draws artifacts, and `cured` leaves at most a tenth of their wrong rays"."""

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
    bad = counted(rows, "wrong_rays")
    told = f"{count(bad)} wrong of {rays(rows)}"
    return verdict(known(bad, lambda n: n == 0), told)


def over_marching(printed: Pick, best: Pick, surfaces: tuple[str, ...], factor: float, told: str) -> Judge:
    """Make a judge of "`printed` is at least `factor` times as fast as ray marching, in the mean".

    It is judged by two marches, the paper's step by step and ours in blocks. The figure also has our march's time over
    that of `best`, the same method at our best. `told` is what the paper prints.
    """

    def decide(evidence: Evidence) -> Verdict | None:
        step_by_step = evidence.ratios(picks.MARCH, printed, surfaces)
        if step_by_step.empty:
            return None
        in_blocks = evidence.ratios(picks.MARCH_OURS, printed, surfaces)
        both_best = evidence.ratios(picks.MARCH_OURS, best, surfaces)
        figure = f"over marching step by step {quantities(step_by_step['ratio'])}"
        figure += f"; over our march in blocks {quantities(in_blocks['ratio'])}" if len(in_blocks) else ""
        figure += f"; both at our best {quantities(both_best['ratio'])}" if len(both_best) else ""
        return verdict(each_mean([step_by_step, in_blocks], factor), f"{figure}; {told}")

    return decide


def _values_suffice(evidence: Evidence) -> Verdict | None:
    rows = evidence.rows(picks.FIT)
    if rows.empty:
        return None
    bad = counted(rows, "wrong_rays")
    told = f"{count(bad)} wrong of {rays(rows)}"
    ratios = evidence.ratios(picks.FIT, picks.YUKSEL)["ratio"]
    told += (
        f"; it takes {quantities(ratios)} the time of Yuksel's method with expanded coefficients" if len(ratios) else ""
    )
    return verdict(known(bad, lambda n: n == 0), told)


def _share(part: Pick, most: float, paper: str) -> Judge:
    """Make a judge of "`part`, the fit without one of its steps, saves at most the share `most` of the whole time".

    `paper` is what the paper prints.
    """

    def decide(evidence: Evidence) -> Verdict | None:
        ratios = evidence.ratios(part, picks.FIT, picks.TABLE_4)
        if ratios.empty:
            return None
        shares = 1.0 - ratios["ratio"]
        return verdict(
            mean_ratio(ratios, 1.0 - most), f"{quantities(shares, wording.whole_percentage)}; the paper: {paper}"
        )

    return decide


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


def _cheaper_than_double(evidence: Evidence) -> Verdict | None:
    single = evidence.rows(picks.FIT, picks.HIGH_DEGREE).dropna(subset=["median_ms"])
    double = evidence.rows(picks.NO_EFT, picks.HIGH_DEGREE, "float64").dropna(subset=["median_ms"])
    ratios = evidence.over(double, single, ["comparison", "device"])
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
CLAIMS = (
    Claim(
        PAPER,
        "1",
        "Fitting is numerically unstable at higher degrees.",
        "Wrong rays of the plain fit in the Bernstein basis: more at degree 16 than at degree 8",
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
        "Wrong rays of both without direct evaluation, silhouettes included; under a tenth left",
        _artifacts(picks.NEITHER, picks.NO_EVAL, ("endrass_octic", "barth_decic")),
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "Fig. 1",
        "EFT alone removes most artifacts of the plain fit (monomial basis, degree 16).",
        "Wrong rays of both on the 16-ball without direct evaluation; under a tenth left",
        _artifacts(picks.NEITHER, picks.NO_EVAL, ("sixteen_ball",)),
        _EFT,
        FIG_1,
    ),
    Claim(
        PAPER,
        "Fig. 1",
        "EFT alone removes most artifacts of the plain fit (Bernstein basis, degrees 8, 10 and 16).",
        "Wrong rays of both on all three surfaces without direct evaluation; under a tenth left",
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
        "1",
        "Values of f and its degree are enough, so that coefficients may change in every frame.",
        "Wrong rays on tori whose radii are read for each instance while the frame is drawn",
        _values_suffice,
        _EFT,
        "szente-animated.toml",
    ),
    Claim(
        PAPER,
        "4",
        "23.6 times as fast as ray marching, in the mean.",
        "Time of ray marching over that of EFT + EVAL as printed, on seven surfaces, by two marches: step by step as "
        "printed, and ours in blocks of 8 steps, which do not wait for one another. Both take 10,000 steps across the "
        "domain: the paper gives this cap and no step length, and the ratio grows with the number of steps",
        over_marching(picks.FIT, picks.FIT_OURS, picks.TABLE_4, 23.6, "the paper: 23.6× (3.3× to 38.4×)"),
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
        _share(picks.NO_EVAL, 0.10, "10 % in the mean (−8 % to 17 %)"),
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
    Claim(
        PAPER,
        "2.2",
        "Register efficiency on consumer graphics hardware.",
        "none",
        untestable,
        reason="registers are no part of what a device here reports",
    ),
)
