"""Claims of szente about condition numbers and bounds of extrema."""

from __future__ import annotations

import pandas as pd

from reports import published, wording
from reports.claims.evidence import Evidence
from reports.claims.model import Claim, Verdict, every, known, quantities, verdict

PAPER = "szente"
STUDIES = "szente-tables-1-2.toml"
_EFT = ("eft_yuksel",)
_LU = ("lu_lipschitz",)


def condition(evidence: Evidence) -> pd.DataFrame:
    """Return our Table 1: a row for each basis, a column for each degree; empty where the study was not run."""
    rows = pd.DataFrame(evidence.studies.get("condition_numbers", []), columns=["basis", "degree", "condition"])
    return rows.pivot_table(index="basis", columns="degree", values="condition", sort=False)


def bounds(evidence: Evidence) -> pd.DataFrame:
    """Return our Table 2: a row for each (reading, bound), a column for each degree; empty without the study."""
    columns = ["reading", "bound", "degree", "percent"]
    rows = pd.DataFrame(evidence.studies.get("extrema_bounds", []), columns=columns)
    return rows.pivot_table(index=["reading", "bound"], columns="degree", values="percent", sort=False)


def _digits(evidence: Evidence) -> Verdict | None:
    ours, paper = condition(evidence), published.table("szente_table1_condition")
    if ours.empty:
        return None
    same = [f"{ours.loc[row['basis'], n]:.2f}" == row[f"degree_{n}"] for row in paper.rows for n in ours.columns]
    missing = bool(ours.isna().any(axis=None)) or not same
    told = f"{sum(same)} of {wording.plural(len(same), 'figure')} agree in every printed digit"
    return verdict(None if missing else all(same), told)


def _better_interval(evidence: Evidence) -> Verdict | None:
    return _worse(evidence, "monomial on [0, 1]", "monomial", "on [0, 1] it is larger")


def _steadier_basis(evidence: Evidence) -> Verdict | None:
    return _worse(evidence, "monomial", "Bernstein", "the monomial basis is worse conditioned")


def _worse(evidence: Evidence, basis: str, other: str, words: str) -> Verdict | None:
    """Judge whether `basis` is worse conditioned than `other` at every degree; `words` say so."""
    ours = condition(evidence)
    if basis not in ours.index:
        return None
    ratio = ours.loc[basis] / ours.loc[other]
    told = ", ".join(f"{wording.factor(value)} at degree {n}" for n, value in ratio.items())
    return verdict(every(ratio, lambda r: r > 1.0), f"{words} {told}")


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


CLAIMS = (
    Claim(PAPER, "2.1", "The condition numbers of Table 1.", "Our own, digit by digit", _digits, _EFT, STUDIES),
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
        "3",
        "LU bounds are never looser than control points.",
        "Mean errors of both",
        _never_looser,
        _LU,
        STUDIES,
    ),
    Claim(
        PAPER,
        "3",
        "LU bounds are about 20 % sharper.",
        "Difference of both errors as Table 2 describes them; at least 15 points in the mean",
        _sharper,
        _LU,
        STUDIES,
    ),
)
