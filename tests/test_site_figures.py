"""What the figures of a site count: which methods entered a cell, and what medians and shares are of."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from harness.merging import merge
from harness.results.store import Store
from reports.analysis import derive
from reports.site import board, build, cells, gather, standings
from tests import machine_runs
from tests.synthetic_run import SURFACES, cell, sampled, tiny_run

NEWTON, MARCH, ODD = "newton[EPSILON=1e-06]", "ray_march", "_odd#[STEP_$=0.5,RELAXATION_OF_THE_LAST_STEP=1.25]"
KINDS = ("misses", "false_hits", "exhausted", "wrong_root", "invalid")


@pytest.fixture(autouse=True)
def _no_claims(monkeypatch: pytest.MonkeyPatch) -> None:
    """Judge no claims of the papers, which takes longer than all the rest."""
    monkeypatch.setattr(gather, "_verdicts", lambda *_: [])


def timed(
    variant: str, ms: float, surface: str = "torus", device: str = "opencl:intel", misses: int = 0, error: float = 5e-4
) -> dict[str, Any]:
    """Make a cell with this time, so many misses and this largest error."""
    made = sampled(cell(variant, surface, device, "float32"), [ms] * 20)
    made["accuracy"] |= dict.fromkeys(KINDS, 0) | {"misses": misses, "error": {"max": error}}
    made["accuracy"]["relative_error"] = {"max": error}
    return made | {"arrays": None}


def ended(made: dict[str, Any], status: str, reason: str, judged: bool = False) -> dict[str, Any]:
    """Take a cell's time, and its answers too unless they were `judged`."""
    return made | {"time": None, "status": status, "reason": reason} | ({} if judged else {"accuracy": None})


def counted(folder: Path, *rows: dict[str, Any]) -> dict[str, standings.Standing]:
    """Return the standings of a run of these rows."""
    return standing(tiny_run(folder, *rows))


def standing(*folders: Path) -> dict[str, standings.Standing]:
    """Return the standings of runs at any error, by method."""
    races = standings.races(gather.gather(folders).frame)
    return {found.method: found for found in standings.standings(standings.cells(races), "any")}


def test_a_method_that_fails_in_a_cell_is_counted_there_and_a_skipped_one_is_not(tmp_path):
    rows = [timed(NEWTON, 1.0, surface) for surface in SURFACES] + [timed(NEWTON, 1.0, device="opencl:pocl")]
    rows += [timed(MARCH, 2.0, "torus"), ended(timed(MARCH, 2.0, "sphere"), "failed", "no")]
    rows += [ended(timed(MARCH, 2.0, "barth"), "timeout", "still running")]
    found = counted(tmp_path / "few", *rows, ended(timed(MARCH, 2.0, device="opencl:pocl"), "skipped", "no extension"))
    assert (found["ray_march"].usable, found["ray_march"].raced) == (1, 3)
    assert found["newton"].won == 3, "where the other is skipped, nothing was held against it"
    found = counted(tmp_path / "all", *rows, ended(timed(MARCH, 2.0, device="opencl:pocl"), "crashed", "died"))
    assert (found["ray_march"].raced, found["newton"].won) == (4, 4)


def test_wrong_rays_of_a_method_too_wrong_to_be_timed_are_counted(tmp_path):
    reason = f"{derive.TOO_WRONG}900 of its judged rays"
    rows = [timed(NEWTON, 1.0), ended(timed(MARCH, 2.0, misses=900), "failed", reason, judged=True)]
    found = counted(tmp_path / "run", *rows)["ray_march"]
    assert (found.wrong, found.usable, found.raced) == (900, 0, 1)
    assert board.said(found)[1] == "0 of 1"


def test_a_median_speedup_is_over_one_baseline_and_says_of_how_many_cells(tmp_path):
    rows = [timed(variant, ms, s) for s in SURFACES for variant, ms in ((NEWTON, 1.0), (ODD, 5.0))]
    rows += [timed(MARCH, 20.0, "sphere"), timed(MARCH, 30.0, "torus"), timed(MARCH, 99.0, "barth", misses=1)]
    tiny_run(tmp_path / "first", *rows)
    others = [timed(v, ms, device="opencl:pocl") for v, ms in ((NEWTON, 1.0), (MARCH, 40.0), (ODD, 5.0))]
    tiny_run(tmp_path / "other", *others)
    plan = json.loads((tmp_path / "other" / "plan.json").read_text()) | {"name": "other", "baseline": "_odd#"}
    (tmp_path / "other" / "plan.json").write_text(json.dumps(plan))
    newton = standing(tmp_path / "first", tmp_path / "other")["newton"]
    assert (newton.speedup, newton.compared, newton.usable) == (30.0, 3, 4), "of 20, 30 and 40, and not 5"
    assert board.said(newton)[2] == "30.0× in 3"
    build.build([tmp_path / "first", tmp_path / "other"], tmp_path / "site")
    index = (tmp_path / "site" / "index.html").read_text(encoding="utf-8")
    assert "1.00 ms, 40.0×" in index and "1.00 ms, 5.00×" not in index, "beside a winner it is over the same"


def test_rows_of_a_merged_run_are_of_the_machine_that_made_them(tmp_path):
    made = []
    for name, driver in (("lab1", "1"), ("lab2", "2")):
        rows = machine_runs.usual(machine=name, processor=f"Processor {name}", driver=driver)
        made.append(machine_runs.write(tmp_path / name, rows, machine=name))
        told = machine_runs.plan_of(made[-1])
        told["environment"] |= {"cpu": f"Processor {name}", "commit": f"of-{name}", "dirty": name == "lab2"}
        Store(made[-1]).write_plan({k: v for k, v in told.items() if k not in ("checksum", "format")})
    merge.merge(made, tmp_path / "all", "firsthit merge …")
    found = gather.gather([tmp_path / "all"])
    pairs = set(zip(found.frame["device"], found.frame["processor"], strict=True))
    assert pairs == {(f"opencl:intel@{name}", f"Processor {name}") for name in ("lab1", "lab2")}
    part = found.parts[0]
    assert part.machine == "Processor lab1 and Processor lab2"
    assert part.commit == "of-lab1 and of-lab2 with uncommitted changes"
    again = cells.commands(part, "opencl:intel@lab2")
    assert again[0] == "git checkout of-lab2" and again[-1].endswith("--device opencl:intel"), "as it is called there"
    with_one = gather.gather([tmp_path / "all", tmp_path / "lab2"])
    assert with_one.frame["processor"].nunique() == 2, "a run of one of them adds no machine"


def test_unsteady_times_are_told(tmp_path):
    steady, noisy = timed(MARCH, 20.0), sampled(timed(NEWTON, 1.0), [0.5, 1.5] * 10)
    tiny_run(tmp_path / "run", steady, noisy)
    assert noisy["time"]["warnings"] and not steady["time"]["warnings"]
    build.build([tmp_path / "run"], tmp_path / "site")
    index, surface, method, steady_one = (
        (tmp_path / "site" / f"{page}.html").read_text(encoding="utf-8")
        for page in ("index", "surfaces/torus", "methods/newton", "methods/ray-march")
    )
    assert "At error ≤ 10⁻³ the times of 1 of 1 winners are noisy or drift" in index
    assert index.count("1.00 ms (noisy), ") == 2, "at two bounds, of which the third has no winner"
    for page in (surface, method):
        assert re.search(r'<span title="noisy: the middle half[^>]*>1.00 \(noisy\)<', page)
        assert "20.0 (" not in page
    assert "noisy" not in steady_one


def test_wrong_rays_are_counted_of_the_rays_that_were_judged(tmp_path):
    few, many = timed(NEWTON, 1.0, misses=5), timed(NEWTON, 1.0, "sphere", misses=5)
    few["accuracy"] |= {"judged": 400}
    many["accuracy"] |= {"judged": 500}
    slow = [timed(MARCH, 20.0), timed(MARCH, 20.0, "sphere")]
    frame = gather.gather([tiny_run(tmp_path / "run", few, many, *slow)]).frame
    each = {race.first.surface: race for race in standings.races(frame)}
    newton = {surface: race.counted["newton"] for surface, race in each.items()}
    assert {surface: (one["x"], one["n"]) for surface, one in newton.items()} == {"torus": (5, 400), "sphere": (5, 500)}
    assert each["torus"].won["any"].faster is None, "5 of 400 are more than the share that is named beside a winner"
    assert cells.risk(each["sphere"].won["any"]).endswith("5 of 500 rays wrong")
    assert each["torus"].counted["ray_march"]["n"] == 48 * 48 - 57 - 2, "an older row, of which the rest is left"


def test_the_lead_says_what_was_checked_and_what_is_undecided(tmp_path):
    rows = [timed(NEWTON, 1.0), timed(MARCH, 2.0)]
    for name, undecided, told in (
        ("some", 48, "2.1 % of these rays are undecided"),
        ("none", 0, "certified first hits."),
    ):
        for row in rows:
            row["accuracy"] |= {
                "undecided": undecided,
                "truth_misses": 48**2 - row["accuracy"]["truth_hits"] - undecided,
            }
        build.build([tiny_run(tmp_path / name, *rows)], tmp_path / f"site-{name}")
        text = (tmp_path / f"site-{name}" / "index.html").read_text(encoding="utf-8")
        assert "its answers to a grid of rays were held against certified first hits" in text and told in text
