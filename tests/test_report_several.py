"""Reports of several runs: one that collects others, and two held against each other."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from harness.contract import FirsthitError, digest
from reports import compare, parts, report
from reports.analysis import derive
from reports.analysis.scene_names import scene_names
from reports.claims.evidence import Evidence
from reports.content import Section
from reports.reading import arrays, load
from tests.synthetic_run import cell, plan, printed, retime, tiny_run


def test_a_run_that_collects_others_keeps_their_rows_apart(tmp_path: Path) -> None:
    def run(name: str, *cells: dict[str, Any]) -> None:
        folder = tiny_run(tmp_path / name, *cells)
        document = json.loads((folder / "plan.json").read_text())
        (folder / "plan.json").write_text(json.dumps(document | {"name": name, "config": f"configs/{name}.toml"}))

    march, newton = (cell(v, "torus", "opencl:intel", "float32") for v in ("ray_march", "newton[EPSILON=0.001]"))
    run("one", march, newton)
    run("two", newton)
    whole = plan([]) | {"name": "all", "include": ["one", "two", "three"]}
    (tmp_path / "all").mkdir()
    (tmp_path / "all" / "plan.json").write_text(json.dumps(whole))
    loaded = load.load(tmp_path / "all")
    frame = derive.derive(loaded.frame)
    assert frame["run"].tolist() == ["one", "one", "two"]
    assert frame["speedup"].notna().tolist() == [True, True, False], "nothing is compared across runs"
    assert sorted(set(scene_names(frame).values())) == ["Torus (one)", "Torus (two)"]
    assert [file.file for file in loaded.unreadable] == ["three"]
    rows = Evidence(frame, {}, arrays.Shelf(loaded.folders))
    assert rows.of("two.toml").frame["run"].tolist() == ["two"]
    assert rows.of("elsewhere.toml").frame["run"].tolist() == ["one", "one", "two"]
    assert report.build(tmp_path / "all").stat().st_size > 0


def test_two_runs_are_held_against_each_other(tmp_path: Path) -> None:
    a, b = (cell("ray_march", "torus", "opencl:intel", "float32") for _ in range(2))
    other = cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32")
    retime(b, 2 * b["time"]["median_ms"])
    b["accuracy"] = b["accuracy"] | {"misses": 7}
    first, second = tiny_run(tmp_path / "a", a, other), tiny_run(tmp_path / "b", b)
    document = compare.report(load.load(first), load.load(second))
    summary = printed(document.summary.blocks)
    assert "Of 1 cell in both runs, B is clearly slower in 1 and clearly faster in 0 of 1" in summary
    assert "more rays wrongly in 1 and fewer in 0" in summary
    by_title = {section.title: printed(section.blocks) for section in document.sections}
    assert "2.00×" in by_title["Speed"]
    assert "newton[EPSILON=0.001]" in by_title["In one run only"]
    assert compare.build(first, second) == tmp_path / "a-to-b.report" / "report.pdf"
    assert (tmp_path / "a-to-b.report" / "report.html").stat().st_size > 0
    back = printed(compare.report(load.load(second), load.load(first)).summary.blocks)
    assert "clearly slower in 0 and clearly faster in 1 of 1" in back
    retime(b, a["time"]["median_ms"] / 4)
    bought = compare.report(load.load(first), load.load(tiny_run(tmp_path / "bought", b)))
    assert "clearly faster in 0 of 1" in printed(bought.summary.blocks), "speed bought with wrong rays is no gain"
    elsewhere = tiny_run(tmp_path / "c", cell("ray_march", "torus", "opencl:pocl", "float32"))
    both, by = compare.paired(load.load(first), load.load(elsewhere))
    assert by == ["scene", "variant", "precision"], "one device each: devices are compared"
    assert len(both) == 1
    with pytest.raises(FirsthitError, match="no cell in common"):
        compare.paired(load.load(second), load.load(tiny_run(tmp_path / "d", other)))


def test_what_was_asked_otherwise_or_timed_by_another_clock_is_not_compared(tmp_path: Path) -> None:
    def identified(finished: dict[str, Any], **asked: Any) -> dict[str, Any]:
        identity = {"surface": {"formula": "x", "domain": "1"}, "view": {"name": "front", "azimuth": 30.0}} | asked
        return finished | {"identity": identity, "key": digest(finished["slot"], identity)}

    names = ("ray_march", "newton[EPSILON=0.001]")
    cells = [identified(cell(name, "torus", "opencl:intel", "float32")) for name in names]
    first = load.load(tiny_run(tmp_path / "a", *cells))
    moved = identified(cells[1], view={"name": "front", "azimuth": 60.0})
    told = printed(compare.report(first, load.load(tiny_run(tmp_path / "b", cells[0], moved))).summary.blocks)
    assert "Of 1 cell in both runs" in told and "Not compared: 1 cell of one name, of another surface or view." in told
    cut = identified(cells[1], surface={"formula": "x", "domain": "2"})
    with pytest.raises(FirsthitError, match="show different surfaces or views"):
        compare.paired(first, load.load(tiny_run(tmp_path / "c", cut)))
    slow = retime(copy.deepcopy(cells[0]), 9 * cells[0]["time"]["median_ms"])
    slow["time"] |= {"clock": "wall"}
    told = printed(compare.report(first, load.load(tiny_run(tmp_path / "d", slow, cells[1]))).summary.blocks)
    assert "slower in 0 and clearly faster in 0 of 1 timed ones" in told
    assert "the times of 1 cell, which are by different clocks" in told
    more = copy.deepcopy(cells[0])
    more["accuracy"] |= {"misses": 7, "truth_misses": more["accuracy"]["truth_misses"] + 97}
    more["accuracy"] |= {"size": 49, "rays": 49**2}
    document = compare.report(first, load.load(tiny_run(tmp_path / "e", retime(more, 1e-3), cells[1])))
    told = printed(document.summary.blocks)
    assert "clearly faster in 0 of 2 timed ones; it answers more rays wrongly in 0" in told
    assert "the answers of 1 cell, which were checked on other rays" in told


def test_what_is_faster_with_a_larger_error_is_not_clearly_faster(tmp_path: Path) -> None:
    first = cell("ray_march", "torus", "opencl:intel", "float32")
    a = load.load(tiny_run(tmp_path / "a", first))
    for factor, faster in ((1.04, 1), (1000.0, 0)):
        fast = retime(copy.deepcopy(first), first["time"]["median_ms"] / 4)
        error = fast["accuracy"]["error"]
        error |= {name: factor * value for name, value in error.items()}
        told = printed(compare.report(a, load.load(tiny_run(tmp_path / f"by {factor}", fast))).summary.blocks)
        assert f"clearly faster in {faster} of 1 timed ones" in told
        assert ("In 1 other cell B is faster, but its largest error is larger." in told) == (not faster)


def test_cells_that_end_otherwise_are_counted(tmp_path: Path) -> None:
    cells = [cell(name, "torus", "opencl:intel", "float32") for name in ("ray_march", "newton[EPSILON=0.001]", "null")]
    ends = [
        one | {"time": None, "accuracy": None, "arrays": None, "status": status, "reason": "no"}
        for one, status in zip(cells, ("crashed", "timeout", "ok"), strict=True)
    ]
    a, b = load.load(tiny_run(tmp_path / "a", *cells)), load.load(tiny_run(tmp_path / "b", *ends[:2], cells[2]))
    told = printed(compare.report(a, b).summary.blocks)
    assert "Of those that ended well in A, 2 cells did not in B: 1 crashed and 1 timeout." in told
    back = printed(compare.report(b, a).summary.blocks)
    assert "Of those that ended well in B, 2 cells did not in A: 1 crashed and 1 timeout." in back
    assert "ended well" not in printed(compare.report(a, a).summary.blocks)


def test_a_comparison_names_the_files_that_it_cannot_read(tmp_path: Path) -> None:
    cells = [cell(name, "torus", "opencl:intel", "float32") for name in ("ray_march", "newton[EPSILON=0.001]")]
    first, second = tiny_run(tmp_path / "a", *cells), tiny_run(tmp_path / "b", *cells)
    path = second / "cells" / f"{cells[1]['key']}.json"
    path.write_bytes(path.read_bytes()[:-9])
    told = printed(compare.report(load.load(first), load.load(second)).summary.blocks)
    assert "Files that could not be read" in told and path.name in told
    whole = printed(compare.report(load.load(first), load.load(first)).summary.blocks)
    assert "could not be read" not in whole


@pytest.mark.parametrize(
    ("include", "order"),
    [(("one", "two"), ["focus", "papers", "checklist", "winners"]), ((), ["focus", "winners", "papers", "checklist"])],
)
def test_the_method_in_focus_comes_before_the_papers_and_they_before_winners(monkeypatch, include, order) -> None:
    for part in parts.found(parts.__name__, parts.__path__):
        name = part.__name__.rpartition(".")[2]
        monkeypatch.setattr(part, "sections", lambda _, name=name: [Section(name, ())])
    collected: Any = SimpleNamespace(run=SimpleNamespace(plan=SimpleNamespace(include=include)))
    assert [made.title for made in parts.sections(collected) if made.title in order] == order
