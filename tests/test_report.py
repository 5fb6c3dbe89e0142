"""The report of a synthetic run, and of folders that are none."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from harness.contract import FirsthitError, digest
from harness.results import schema
from reports import content, first_page, report
from reports.analysis import derive, shown, ties
from reports.drawing import choice, surface_tables, tables
from reports.material import Material
from reports.parts import last_page, surface_pages, winners
from reports.reading import arrays, load
from tests.synthetic_run import cell, plan, printed, reported, retime, tiny_run, troubled, write_run


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "quick")


@pytest.fixture(scope="module")
def loaded(run: Path) -> load.Run:
    return load.load(run)


@pytest.fixture(scope="module")
def frame(loaded: load.Run) -> pd.DataFrame:
    return derive.derive(loaded.frame)


def test_build_writes_four_files_and_nothing_else(tmp_path: Path) -> None:
    run = write_run(tmp_path / "quick", ["torus"])
    before = {path: path.stat().st_mtime_ns for path in run.rglob("*")}
    pdf = report.build(run)
    made = run.parent / "quick.report"
    assert pdf == made / "report.pdf"
    assert {path.name for path in made.iterdir()} == {"report.pdf", "report.html", "results.csv", "results.parquet"}
    assert {path: path.stat().st_mtime_ns for path in run.rglob("*")} == before, "a run is only read"
    first = pdf.read_bytes()
    assert first.startswith(b"%PDF")
    assert report.build(run).read_bytes() == first, "the same run must give the same PDF"

    csv, parquet = pd.read_csv(made / "results.csv"), pq.read_table(made / "results.parquet")
    names = [field.name for field in (*schema.SCHEMA, *schema.DERIVED)]
    assert list(csv.columns) == parquet.column_names == names
    for key, samples, text in zip(csv["key"], parquet["samples_ms"].to_pylist(), csv["samples_ms"], strict=True):
        stored = json.loads((run / "cells" / f"{key}.json").read_text())["time"]
        assert samples == (stored and stored["samples_ms"])
        assert stored is None or json.loads(text) == stored["samples_ms"]


def test_every_planned_cell_is_accounted_for(loaded: load.Run, frame: pd.DataFrame) -> None:
    assert [file.problem.split(" (")[0].split(":")[0] for file in loaded.unreadable] == [
        "truncated or no JSON",
        "its format is None, not 1",
    ]
    assert len(loaded.not_run) == 2
    assert len(frame) + len(loaded.unreadable) + len(loaded.not_run) == len(loaded.plan.slots) == 120
    told = first_page.ended(frame["status"], 2, 2)
    total, *parts = map(int, re.findall(r"\d+", told))
    assert total == sum(parts) == 120
    names = re.findall(r"\d+ ([a-z][a-z ]*?)(?=[,.:]| and )", told)
    assert names == ["cells", "ok", "skipped", "failed", "timeout", "crashed", "unreadable", "not run yet"]


def test_the_report_says_what_happened(run: Path) -> None:
    _, report = reported(run)
    by_title = {section.title: printed(section.blocks) for section in report.sections}
    assert "firsthit run configs/quick.toml" in printed(report.summary.blocks)
    assert "Odd#, step $ = 0.5, relaxation of the last step = 1.25" in by_title["Torus: speed against error"]
    last = report.sections[-1]
    assert last.title == last_page.TITLE
    troubles = printed(last.details)
    for reason in ("opencl:gpu#0_$ has no float64", "the worker died of signal 11", "still running after 20 s"):
        assert reason in troubles
    assert "use of `$x` @ *p = a_b[#i] <7:3> ^~~~ kernel" in troubles, "folded, and without terminal colours"
    assert "2 planned cells not run yet (2 on opencl:gpu#0_$)" in printed(last.blocks)
    assert 'title = "quick"  # a comment' in troubles, "the config's text"
    titles = [section.title for section in report.sections]
    surfaces = ["Sphere", "Torus", "Barth #6 $extic_* @65 <b>"]
    assert titles[:7] == ["Winners", *(page for name in surfaces for page in (name, f"{name}: speed against error"))]
    for first, second in zip(report.sections[1:7:2], report.sections[2:7:2], strict=True):
        (gallery,) = [block for block in first.blocks if isinstance(block, content.Gallery)]
        assert gallery.hero and len(gallery.panels) > 3
        assert {content.Figure, content.Table} <= {type(block) for block in second.blocks}
        assert sum(isinstance(block, content.Table) for block in second.details) >= 2, "every figure, and every unit"
        assert first.own_page and second.own_page


def test_winners_name_the_fastest_and_the_fastest_with_no_wrong_ray(frame: pd.DataFrame) -> None:
    rows = {row[:3]: row[3:] for row in winners.winners_table(frame, ties.leaders(frame)).rows}
    group = frame[
        (frame["surface"] == "torus") & (frame["device"] == "opencl:intel") & (frame["precision"] == "float32")
    ]
    times = group.set_index("variant")["median_ms"]
    fastest, *_, instead, instead_ms, tied = rows["Torus", "float32", "opencl:intel"]
    assert times.drop("null").idxmin() == "_odd#[STEP_$=0.5,RELAXATION_OF_THE_LAST_STEP=1.25]"
    assert fastest == "Odd#, step $ = 0.5, relaxation of the last step = 1.25"
    assert (instead, instead_ms) == ("Newton, ε = 0.001", times["newton[EPSILON=0.001]"])
    assert tied is None
    assert rows["Sphere", "float32", "opencl:intel"][-3:] == ("the same", None, None)


def test_derived_columns(tmp_path: Path) -> None:
    def timed(variant: str, median: float, error: float = 0.0, misses: int = 0) -> dict[str, Any]:
        made = cell("null" if variant == "null" else "ray_march", "torus", "opencl:intel", "float32")
        slot = f"{variant} torus"
        made |= {"slot": slot, "key": digest(slot), "variant": variant, "method": variant.partition("[")[0]}
        retime(made, median)
        if made["accuracy"]:
            made["accuracy"] |= {"error": {"max": error}, "misses": misses}
        return made

    cells = [
        timed("ray_march[CAP=10]", 99.0, 1e-2),
        timed("ray_march", 8.0, 0.0),
        timed("null", 0.5),
        timed("a", 0.9, 1e-3),
        timed("b", 2.0, 1e-5),
        timed("beaten", 2.5, 1e-5),
        timed("misses", 1.5, 1e-6, misses=3),
    ]
    loaded = load.load(tiny_run(tmp_path / "run", *cells))
    rows = derive.derive(loaded.frame, {"opencl:intel": 1e5}).set_index("variant")
    assert rows["speedup"].drop(["null", "misses"]).to_dict() == pytest.approx(
        {"ray_march[CAP=10]": 8 / 99, "ray_march": 1, "a": 8 / 0.9, "b": 4, "beaten": 3.2}
    )
    assert np.isnan(rows["speedup"]["null"]) and np.isnan(rows["speedup"]["misses"])
    assert rows.index[rows["floor_bound"]].tolist() == ["a"]
    assert rows.index[rows["front"]].tolist() == ["ray_march", "a", "b"]
    assert rows["wrong_rays"]["misses"] == 3
    assert rows["mrays_per_s"]["b"] == pytest.approx(256 * 256 / 2e-3 / 1e6)
    assert rows["frames_per_s"]["b"] == pytest.approx(500)
    flops = 25 * rows["evaluations_mean"]["b"] * 256 * 256 / 2e-3
    assert rows["peak_share"]["b"] == pytest.approx(flops / 1e14)
    assert np.isnan(rows["peak_share"]["null"]) and not rows["peak_too_low"].any()
    low = derive.derive(loaded.frame, loaded.plan.peaks).set_index("variant")
    assert np.isnan(low["peak_share"]["b"]) and low["peak_too_low"]["b"], "a share above 100 % is no share"
    assert "the probe's peak is too low" in surface_tables.flags(next(low.loc[["b"]].itertuples()))


def test_the_share_of_peak_is_absent_where_no_peak_is_known(frame: pd.DataFrame) -> None:
    assert frame["peak_share"].isna().all()  # no peaks given
    bare = frame.drop(columns=[field.name for field in schema.DERIVED])
    known = derive.derive(bare, {"opencl:intel": 100.0})
    told = known[known["peak_share"].notna()]
    assert set(told["device"]) == {"opencl:intel"} and set(told["precision"]) == {"float32"}


def test_flags_say_what_to_know_of_a_row(frame: pd.DataFrame) -> None:
    flagged = {word for table_row in frame.itertuples() for word in surface_tables.flags(table_row).split(", ")}
    assert flagged - {"drifts", "1 outlier"} == {"", "floor", "front", "interval wide", "overhead 12 %"}
    for row in frame[frame["status"] == "ok"].itertuples():
        words = surface_tables.flags(row).split(", ")
        assert ("interval wide" in words) == (not row.narrow)
        assert ("front" in words) == bool(row.front)
        assert ("floor" in words) == (row.method == "null")
        assert ("drifts" in words) == ("drifts:" in row.warnings)
        assert ("1 outlier" in words) == (row.outliers == 1)


def test_no_error_is_told_of_a_method_that_answers_nothing(loaded: load.Run, frame: pd.DataFrame) -> None:
    finished = frame[(frame["status"] == "ok") & (frame["surface"] == "torus")]
    null = loaded.frame["method"] == "null"
    assert (loaded.frame.loc[null, "misses"].dropna() > 0).all()
    accuracy = [field.name for field in schema.SCHEMA if field.path[0] == "accuracy"]
    assert len(accuracy) > 40
    assert frame.loc[null, accuracy].isna().all(axis=None)
    kept = frame.loc[~null, accuracy]
    pd.testing.assert_frame_equal(kept, loaded.frame.loc[~null, accuracy])
    table = surface_tables.results_table(finished)
    titles = [column.title for column in table.columns]
    first, last = titles.index("max\nerror"), titles.index("evals per\nray cast")
    for row in table.rows:
        assert all(pd.isna(value) for value in row[first : last + 1]) == (row[2] == "Null")


def test_fronts_are_what_a_comparison_of_all_pairs_finds(frame: pd.DataFrame) -> None:
    for _, group in derive.contenders(frame).groupby(derive.GROUP):
        right = group[(group["wrong_rays"] == 0) & group["error_max"].notna()]
        points = list(right[["median_ms", "error_max"]].itertuples(index=False, name=None))
        best = [not any(q != p and q[0] <= p[0] and q[1] <= p[1] for q in points) for p in points]
        assert right["front"].tolist() == best
        assert not group.loc[group.index.difference(right.index), "front"].any()


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda c: c.pop("variant"), "variant is missing"),
        (lambda c: c.update(size="256"), "size is no whole number: '256'"),
        (lambda c: c.update(answers=1), "answers is no truth value: 1"),
        (lambda c: c.update(time=[1.0]), "time is no object"),
        (lambda c: c["time"].update(samples_ms=[1.0, None]), "time.samples_ms[] is no number: None"),
        (lambda c: c["accuracy"]["error"].update(p99="small"), "accuracy.error.p99 is no number: 'small'"),
        (lambda c: c["accuracy"].update(misses=2**64), "accuracy.misses: 18446744073709551616 is no count"),
        (lambda c: c.update(key="0" * 16), "it names another cell's key"),
        (lambda c: c.update(status="fine"), "status: 'fine' is not one of ok, skipped"),
    ],
)
def test_a_foreign_cell_is_listed_and_the_rest_reported(
    tmp_path: Path, change: Callable[[dict[str, Any]], Any], problem: str
) -> None:
    good, bad = (cell(v, "torus", "opencl:intel", "float32") for v in ("ray_march", "newton[EPSILON=0.001]"))
    folder = tiny_run(tmp_path / "run", good, bad)
    file = folder / "cells" / f"{bad['key']}.json"
    change(bad)
    file.write_text(json.dumps(bad))
    loaded = load.load(folder)
    assert loaded.frame["key"].tolist() == [good["key"]]
    assert [unreadable.file for unreadable in loaded.unreadable] == [f"cells/{file.name}"]
    assert loaded.unreadable[0].problem.startswith(problem)


def test_a_folder_that_is_no_run_is_refused_in_one_line(tmp_path: Path) -> None:
    made = cell("ray_march", "torus", "opencl:intel", "float32")
    plans = {
        "empty": (None, "it has no plan.json"),
        "truncated": ('{"format": 1, "na', "truncated or no JSON"),
        "foreign": ('{"format": 7}', "its format is 7, not 1"),
        "escaping": (json.dumps(plan([made | {"key": "../../etc"}])), "is no key"),
        "unfinished": (json.dumps(plan([made])), "run `firsthit run configs/quick.toml` first"),
    }
    for name, (text, message) in plans.items():
        (tmp_path / name).mkdir()
        if text is not None:
            (tmp_path / name / "plan.json").write_text(text)
        with pytest.raises(FirsthitError) as raised:
            report.build(tmp_path / name)
        assert message in str(raised.value)
        assert "\n" not in str(raised.value)
        assert raised.value.exit_code == 2
        assert len(list((tmp_path / name).iterdir())) == (text is not None), "nothing half-written"
    with pytest.raises(FirsthitError, match="there is no run folder"):
        report.build(tmp_path / "nowhere")


def test_runs_with_nothing_to_show_still_make_a_report(tmp_path: Path) -> None:
    skipped = troubled(cell("ray_march", "torus", "opencl:gpu#0_$", "float64"))
    bare = cell("ray_march", "torus", "opencl:intel", "float32") | {"accuracy": None, "arrays": "arrays/gone.npz"}
    assert report.build(tiny_run(tmp_path / "skipped", skipped)).stat().st_size > 0
    folder = tiny_run(tmp_path / "bare", bare)
    made = tmp_path / "bare.report"
    (made / "report.pdf").mkdir(parents=True)
    with pytest.raises(FirsthitError, match="cannot write the report") as raised:
        report.build(folder)
    assert raised.value.exit_code == 3
    assert not list(made.glob(".*"))
    (made / "report.pdf").rmdir()
    assert report.build(folder).stat().st_size > 0


def test_a_damaged_array_file_is_listed_and_the_other_pictures_drawn(tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run")
    victim = next(iter(sorted((folder / "arrays").iterdir())))
    for broken in folder.glob("arrays/*.npz"):
        if broken.name.startswith(victim.name[0]):
            broken.write_bytes(broken.read_bytes()[:200])
    loaded = load.load(folder)
    frame = derive.derive(loaded.frame)
    drawn = shown.in_galleries(frame)
    read = pd.concat([drawn, shown.in_evaluation_maps(frame)])["key"]  # one scale of colours is for both
    cut = {key for key in read if key.startswith(victim.name[0])}
    damaged = {f"arrays/{key}.npz" for key in cut}
    shelf = arrays.Shelf(loaded.folders)
    made = surface_pages.sections(Material(loaded, frame, pd.DataFrame(), shelf))
    galleries = [block for section in made for block in section.blocks if isinstance(block, content.Gallery)]
    assert {file.file for file in shelf.damaged.values()} == set(shelf.damaged) == damaged
    heroes = sum(gallery.hero for gallery in galleries)
    assert sum(len(gallery.panels) for gallery in galleries) - heroes == len(drawn) - drawn["key"].isin(cut).sum()


def test_large_runs_print_only_what_matters(run: Path, frame: pd.DataFrame, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tables, "ROW_LIMIT", 10)
    monkeypatch.setattr(choice, "LINES", 2)
    monkeypatch.setattr(winners, "ONE_BY_ONE", 2)
    _, report = reported(run)
    assert "2 of 3 surfaces" in printed(report.summary.blocks)
    looked_up = next(printed(section.details) for section in report.sections if section.title == "Winners")
    assert "The first 10 of" in looked_up
    assert "Which method is fastest with no wrong ray, and how often." in looked_up
    finished = frame[frame["status"] == "ok"]
    guide = next(printed(s.details) for s in report.sections if s.title == "How to read the surfaces' pages")
    kept = int((finished["front"] | finished["method"].isin(["ray_march", "null"])).sum())
    assert f"Printed are {kept} of {len(finished)} rows" in guide
    assert "The first 10 of" in printed(report.sections[-1].details)
    for title in ("The same kernel on every device", "Variants compared round by round"):
        assert "The first " in next(printed(own.details) for own in report.sections if own.title == title)


def test_units_of_error_stand_beside_each_other(frame: pd.DataFrame) -> None:
    rows = frame[(frame["surface"] == "torus") & (frame["status"] == "ok")]
    table = surface_tables.units_table(rows)
    assert table is not None
    titles = [(column.over.replace("\n", " "), column.title) for column in table.columns]
    assert [title for title in titles[3:] if title[1] == "max"] == [
        ("scene units", "max"),
        ("over scene radius", "max"),
        ("over feature radius", "max"),
        ("pixels", "max"),
        ("units in last place of t", "max"),
        ("over condition × roundoff", "max"),
        ("normal, degrees", "max"),
        ("residual", "max"),
    ]
    assert len(table.rows) == int(rows["answers"].sum())
    for row in table.rows:
        told = dict(zip(titles, row, strict=True))
        assert told["over feature radius", "99 %"] == pytest.approx(told["scene units", "99 %"] / 0.3)
        assert told["units in last place of t", "max"] == pytest.approx(told["scene units", "max"] * 2**23)


def test_an_older_run_has_no_families_and_no_conditions(tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run", ["torus"])
    document = json.loads((folder / "plan.json").read_text())
    del document["families"], document["family_facts"]
    (folder / "plan.json").write_text(json.dumps(document))
    for file in folder.glob("arrays/*.npz"):
        with np.load(file) as stored:
            kept = {name: stored[name] for name in stored if name not in ("condition", "evaluations")}
        np.savez_compressed(file, **kept)
    run, report = reported(folder)
    assert run.families.empty
    assert not {"Error against condition", "Where each method breaks"} & {section.title for section in report.sections}
    galleries = [block for section in report.sections for block in section.blocks if isinstance(block, content.Gallery)]
    assert len(galleries) == 1


def test_importing_reports_imports_nothing_heavy() -> None:
    heavy = "{'pandas', 'matplotlib', 'typst', 'PIL', 'pyarrow', 'numpy'}"
    code = f"import sys, reports; print(sorted({heavy} & set(sys.modules)))"
    root = Path(report.__file__).parents[1]
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=root)
    assert done.stdout.strip() == "[]"


def test_the_first_page_says_which_method_at_which_error_and_what_it_costs(tmp_path: Path) -> None:
    def timed(variant: str, median: float, error: float, precision: str = "float32", misses: int = 0) -> dict[str, Any]:
        made = cell("ray_march", "torus", "opencl:intel", precision)
        slot = f"{variant} torus {precision}"
        made |= {"slot": slot, "key": digest(slot), "variant": variant, "method": variant}
        retime(made, median)
        made["accuracy"] |= {"relative_error": {"max": error}, "error": {"max": error}, "misses": misses}
        made["accuracy"] |= dict.fromkeys(("false_hits", "exhausted", "wrong_root"), 0)
        return made

    cells = [
        timed("wrong", 0.1, 1e-8, misses=1),
        timed("rough", 0.5, 2e-3),
        timed("loose", 1.0, 9e-4),
        timed("tight", 4.0, 9e-7, "float64"),
        timed("tighter", 8.0, 1e-9),
    ]
    frame = derive.derive(load.load(tiny_run(tmp_path / "run", *cells)).frame)
    table = choice.table(frame)
    assert table is not None
    (row,) = table.rows
    assert row[:-1] == ("Torus", "Loose", 1.0, 9e-4, "Tight, float64", 4.0, 9e-7)
    assert "float32 where no other is named" in table.caption
    assert row[-1] == pytest.approx(4.0, rel=0.05), "in the rounds that timed both"
    only = derive.derive(load.load(tiny_run(tmp_path / "rough", timed("rough", 0.5, 2e-3))).frame)
    table = choice.table(only)
    assert table is not None
    assert table.rows == [("Torus", "none; Rough", 0.5, 2e-3, "none; Rough", 0.5, 2e-3, None)]
    assert "Behind “none” stands the most exact variant of this run, with its own figures." in table.caption
