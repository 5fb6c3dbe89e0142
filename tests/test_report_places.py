"""Where a report is written: beside the run or where the user says, and never into a run, which is only read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from harness.cli import main
from harness.contract import FirsthitError
from reports import compare, place, report
from reports.reading import load
from tests.synthetic_run import cell, stability_run, tiny_run


def test_a_report_lies_beside_its_run_under_the_name_that_the_user_calls_it(tmp_path, monkeypatch):
    (tmp_path / "quick").mkdir()
    (tmp_path / "latest").symlink_to("quick")
    assert place.place(tmp_path / "quick") == tmp_path / "quick.report"
    assert place.place(tmp_path / "latest") == tmp_path / "latest.report"
    monkeypatch.chdir(tmp_path / "quick")
    assert place.place(Path()) == tmp_path / "quick.report"
    assert place.place(Path("..", "quick")) == tmp_path / "quick.report"


def test_comparisons_of_runs_of_one_name_have_places_of_their_own():
    assert place.place(Path("/r/a"), Path("/r/b")) == Path("/r/a-to-b.report")
    assert place.place(Path("/old/quick"), Path("/new/quick")) == Path("/old/old-quick-to-new-quick.report")
    others = [place.place(Path("/r/one/quick"), Path(f"/r/{name}/quick")) for name in ("one", "two", "two/deep")]
    assert len(set(others)) == 3 and {other.parent for other in others} == {Path("/r/one")}


@pytest.mark.parametrize("where", ["run", "run/report", "run/cells", "other", "other/here"])
def test_nothing_is_written_into_a_run(tmp_path, capsys, where):
    run, other = (
        tiny_run(tmp_path / name, cell("newton[EPSILON=0.001]", "torus", "opencl:pocl", "float32"))
        for name in ("run", "other")
    )
    before = sorted(tmp_path.rglob("*"))
    for arguments in ([run], [run, other]):
        assert main(["report", *map(str, arguments), "-o", str(tmp_path / where)]) == 2
        told = capsys.readouterr().err.splitlines()[-1]
        assert told.startswith("firsthit: ") and "a report is never written into a run" in told
    assert sorted(tmp_path.rglob("*")) == before


def test_a_file_is_no_place_for_a_report(tmp_path):
    run = tiny_run(tmp_path / "run", cell("newton[EPSILON=0.001]", "torus", "opencl:pocl", "float32"))
    (tmp_path / "report.pdf").write_text("mine")
    for build in (report.build, lambda run, output: compare.build(run, run, output)):
        with pytest.raises(FirsthitError, match="is a file; a report is several files"):
            build(run, tmp_path / "report.pdf")
    assert (tmp_path / "report.pdf").read_text() == "mine"


def test_a_run_that_cannot_be_written_to_is_reported_elsewhere(tmp_path):
    pytest.importorskip("typst")
    runs = tmp_path / "runs"
    run = tiny_run(runs / "quick", cell("newton[EPSILON=0.001]", "torus", "opencl:pocl", "float32"))
    everything = [runs, *runs.rglob("*")]
    for path in everything:
        path.chmod(0o555 if path.is_dir() else 0o444)
    try:
        assert report.build(run, tmp_path / "made") == tmp_path / "made/report.pdf"
        if os.geteuid():  # nothing stops root
            with pytest.raises(FirsthitError, match="cannot write the report into"):
                report.build(run)
    finally:
        for path in everything:
            path.chmod(0o755 if path.is_dir() else 0o644)


def test_a_focus_is_a_method_of_the_run_of_views_or_of_families(tmp_path):
    run = load.load(stability_run(tmp_path / "hard"))
    assert load.focus_of(run, None) == "" and load.focus_of(run, "newton") == "newton"
    assert load.focus_of(run, "newton[EPSILON=0.001]") == "newton[EPSILON=0.001]"
    for name in ("newtn", "null"):
        with pytest.raises(FirsthitError, match=f"--focus: unknown '{name}'"):
            load.focus_of(run, name)
