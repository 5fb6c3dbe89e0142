"""What a claim's figure says of itself: which rays it counts, on which devices, and which times are no part of it; and
which claims a reader of a report is told of."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from harness.contract import digest
from reports import claims
from reports.claims import Outcome, picks
from reports.claims.evidence import Pick
from reports.claims.verdict_tables import BRIEF, brief
from reports.parts import checklist
from tests.synthetic_run import printed, reported, tiny_run

from .test_claims import claim, evidence, planted


def on(device: str, made: dict[str, Any]) -> dict[str, Any]:
    """The same cell on another device."""
    slot = f"{made['slot']} {device}"
    return made | {"device": device, "slot": slot, "key": digest(slot)}


def test_a_count_of_rays_names_surfaces_precision_and_devices(tmp_path: Path) -> None:
    rows = [planted(picks.MARCH, surface, 1.0, misses=1) for surface in ("calyx", "torus")]
    one = claims.judge(claim("szente", "smaller than its step"), evidence(tmp_path / "one", *rows))
    assert one.figure.endswith("of 4,608 rays (2,304 in each of 2 rows: 2 surfaces in float32 on opencl:intel)")
    rows += [on("opencl:pocl", row) for row in rows]
    two = claims.judge(claim("szente", "smaller than its step"), evidence(tmp_path / "two", *rows))
    assert two.figure.endswith(
        "of 9,216 rays (2,304 in each of 4 rows: 2 surfaces in float32 on each of opencl:intel and opencl:pocl)"
    )
    views = [planted(picks.BISECTION, "torus", 1.0, view, feature_error={"max": 1e-3}) for view in "ab"]
    told = claims.judge(claim("toledo2007", "none of Sturm's failures"), evidence(tmp_path / "views", *views))
    assert "over 2 views in float32 on opencl:intel" in told.figure
    times = [planted(pick, "torus", ms) for pick, ms in ((picks.ONE_RAY, 2.0), (picks.TWO_RAYS, 1.0))]
    faster = claims.judge(claim("toledo2007", "Two starts"), evidence(tmp_path / "times", *times))
    assert "in float32 on opencl:intel" in faster.figure


def test_a_gain_that_one_device_shows_and_another_does_not_is_refuted_with_both_named(tmp_path: Path) -> None:
    def cells(device: str, gain: float) -> list[dict[str, Any]]:
        made = []
        for surface, degree, ratio in (("sphere", 2, gain), ("calyx", 5, 1.0)):
            for pick, ms in ((picks.LU_UNCULLED, ratio), (picks.LU, 1.0)):
                made.append(on(device, planted(pick, surface, ms) | {"degree": degree}))
        return made

    both = evidence(tmp_path / "run", *cells("opencl:intel", 1.5), *cells("opencl:pocl", 0.8))
    told = claims.judge(claim("szente", "Culling by LU bounds"), both)
    assert told.outcome is Outcome.REFUTED
    assert "on opencl:intel sphere 1.50×, calyx 1.00×; on opencl:pocl sphere 0.800×, calyx 1.00×" in told.figure


def test_times_that_were_not_taken_in_turns_are_left_out_and_counted(tmp_path: Path) -> None:
    def timed(pick: Pick, surface: str, ms: float, session: str) -> dict[str, Any]:
        made = planted(pick, surface, ms)
        made["time"]["session"] = session
        return made

    two_rays = claim("toledo2007", "Two starts")
    apart = [timed(picks.ONE_RAY, "torus", 9.0, "yesterday"), timed(picks.TWO_RAYS, "torus", 1.0, "today")]
    found = evidence(tmp_path / "apart", *apart)
    assert found.ratios(picks.ONE_RAY, picks.TWO_RAYS).empty
    told = claims.judge(two_rays, found)
    assert told.outcome is Outcome.UNTESTED
    assert told.figure.startswith("1 pair of rows not timed in the same rounds; `firsthit run configs/")

    fit = claim("szente", "23.6 times")
    mixed = [timed(picks.MARCH, "sphere", 30.0, "today"), timed(picks.FIT, "sphere", 1.0, "today")]
    mixed += [timed(picks.MARCH, "torus", 2.0, "yesterday"), timed(picks.FIT, "torus", 1.0, "today")]
    told = claims.judge(fit, evidence(tmp_path / "mixed", *mixed))
    assert told.outcome is Outcome.CONFIRMED and "30.0×; the paper" in told.figure
    assert told.figure.endswith("left out: 1 pair of rows not timed in the same rounds")
    again = claims.judge(fit, evidence(tmp_path / "again", *mixed[:2]))
    assert "left out" not in again.figure


def test_a_page_of_claims_has_those_that_the_run_decides_and_counts_the_others(tmp_path: Path) -> None:
    cells = [planted(pick, "torus", ms) for pick, ms in ((picks.ONE_RAY, 2.0), (picks.TWO_RAYS, 1.0))]
    _, report = reported(tiny_run(tmp_path / "run", *cells))
    (section,) = [section for section in report.sections if section.title == checklist.TITLE]
    text, whole = printed(section.blocks), printed(section.details)
    (lead, table, rest) = section.blocks
    assert printed((lead,)) == "Of 1 claim that this run decides, 1 is confirmed: 1 of 1 of toledo2007."
    assert "toledo2007 | confirmed | 4.3 | Two starts for each ray are faster than one." in printed((table,))
    assert f"{len(claims.CLAIMS) - 1} have no rows in this run" in printed((rest,))
    assert Outcome.UNTESTED.value not in text
    assert whole.count(Outcome.UNTESTED.value) >= len(claims.CLAIMS) - 1, "the whole checklist is among the details"


def test_a_run_that_decides_no_claim_has_no_page_of_claims(tmp_path: Path) -> None:
    _, report = reported(tiny_run(tmp_path / "run", planted(Pick("x", "other"), "plane", 1.0)))
    assert checklist.TITLE not in [section.title for section in report.sections]


def test_a_figure_told_in_brief_keeps_what_the_paper_says_and_how_ours_at_its_best_is_judged() -> None:
    first = "Newton is 2.61× as fast as Loop-Blinn in float32 on opencl:intel"
    long = f"{first}; {'wrong rays, ' * 12}none; the paper: 2.6×. Ours at its best, forwards: 3.3× (confirmed)"
    assert brief(long) == f"{first}; the paper: 2.6×. Ours at its best: confirmed."
    assert brief(long.replace("(confirmed)", "(not decided)")).endswith("Ours at its best: not decided.")
    assert brief("43 of 43") == "43 of 43."
    assert len(brief("word " * 100)) <= BRIEF + 1
