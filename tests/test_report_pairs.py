"""The report's table of paired ratios."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from harness.contract import digest
from reports import content
from tests.synthetic_run import cell, printed, reported, sampled, tiny_run


def timed(variant: str, samples: list[float], rounds: list[int], session: str = "one", misses: int = 0) -> Any:
    made = cell("ray_march", "torus", "opencl:intel", "float32")
    slot = f"{variant} torus"
    made |= {"slot": slot, "key": digest(slot), "variant": variant, "method": variant, "arrays": None}
    sampled(made, samples)["time"].update(rounds=rounds, session=session)
    made["accuracy"] |= {"misses": misses}
    return made


def test_variants_are_held_against_the_fastest_right_one_round_by_round(tmp_path: Path, rng: Any) -> None:
    load = rng.lognormal(sigma=0.4, size=30)
    rounds = list(range(30))
    folder = tiny_run(
        tmp_path / "run",
        timed("best", list(load), rounds),
        timed("wrong", list(0.5 * load * (1 + 0.01 * rng.standard_normal(30))), rounds, misses=7),
        timed("slow", list(3.0 * load[:10]), rounds[:10]),
        timed("alike", [time * (1.02 if i % 2 else 0.985) for i, time in enumerate(load)], rounds),
        timed("few", list(2.0 * load[:3]), rounds[:3]),
        timed("elsewhere", list(2.0 * load), rounds, session="another"),
    )
    _, report = reported(folder)
    (section,) = [s for s in report.sections if s.title == "Variants compared round by round"]
    text = printed(section.details)
    lines = {line.split(" | ")[3]: line.split(" | ")[2:] for line in text.splitlines() if line.count(" | ") == 9}
    lines.pop("variant", None)
    assert {variant: row[0] for variant, row in lines.items()} == dict.fromkeys(
        ("Wrong", "Slow", "Alike", "Few"), "Best"
    )
    assert lines["Slow"][2:5] == ["3.00×", "3.00×", "3.00×"]
    assert lines["Slow"][6:] == ["10", "slower"]
    assert lines["Wrong"][2:] == ["–", "–", "–", "–", "30", "7 wrong rays: not compared"]
    assert lines["Alike"][-1] == "not told apart"
    assert lines["Few"][2:5] == ["2.00×", "–", "–"]
    (matrix,) = [block for block in section.details if isinstance(block, content.Matrix)]
    ((scene, squares),) = matrix.rows
    marks = dict(zip(matrix.columns, (square.text for square in squares), strict=True))
    assert scene == "Torus" and marks["Best"].endswith(" ms") and matrix.columns[0] == "Best"
    assert marks == {"Best": marks["Best"], "Alike": "even", "Slow": "3.00×", "Few": "2.00× ?"} | {
        "Wrong": marks["Wrong"],
        "Elsewhere": "–",
    }
    assert marks["Wrong"].endswith("×, 7 wrong"), "a speed stands beside its errors"
    assert "In 0 of 1 scene one method leads alone; the first are not told apart on Torus." in text
    assert lines["Few"][6:] == ["3", "too few rounds: 3 can at best give a chance of 0.25; needs 8"]


@pytest.mark.parametrize("rounds", [6, 7, 8])
def test_a_hundredfold_difference_is_too_few_rounds_or_told(tmp_path: Path, rng: Any, rounds: int) -> None:
    load = rng.lognormal(sigma=0.02, size=rounds)
    cells = [timed("best", list(load), list(range(rounds))), timed("slow", list(96.0 * load), list(range(rounds)))]
    _, report = reported(tiny_run(tmp_path / "run", *cells))
    (section,) = [s for s in report.sections if s.title == "Variants compared round by round"]
    told = {6: "too few rounds: 6 can at best give a chance of 0.031; needs 8", 7: "too few rounds: 7", 8: "| slower"}
    assert told[rounds] in printed(section.details)
    assert "| not told apart" not in printed(section.details)
    (matrix,) = [block for block in section.details if isinstance(block, content.Matrix)]
    assert [square.text for square in matrix.rows[0][1]][1] == ("96×" if rounds >= 8 else "96× ?")
    assert section.blocks == (), "the winners' page of so few surfaces shows it"


@pytest.mark.parametrize("sessions", [("one", "two")])
def test_runs_that_were_not_interleaved_are_not_paired(tmp_path: Path, sessions: tuple[str, str]) -> None:
    cells = [timed(name, [1.0] * 9, list(range(9)), session) for name, session in zip("ab", sessions, strict=True)]
    _, report = reported(tiny_run(tmp_path / "run", *cells))
    assert "Variants compared round by round" not in [s.title for s in report.sections]
