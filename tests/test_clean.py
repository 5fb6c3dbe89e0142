"""What a run's plan does not name is listed and removed; what it names stays, and another writer is respected."""

from __future__ import annotations

from pathlib import Path

import pytest

from harness import cli
from harness.contract import FirsthitError
from harness.merging.clean import clean
from harness.results.lock import Lock
from harness.results.store import Store
from tests.machine_runs import contents, row_of, usual, write


def littered(tmp_path: Path) -> tuple[Path, dict[str, bytes]]:
    """Write a run, and then beside it what no plan names; return the folder, and what it held before."""
    run = write(tmp_path / "quick", usual())
    hurt = run / "cells" / f"{usual()[4]['key']}.json"
    hurt.write_text("{")
    before = contents(run)
    old = row_of("ray_march", "sphere", driver="0")
    Store(run).write(old)
    Store(run).write(row_of("null", "torus", device="opencl:pocl"))
    (run / old["arrays"]).write_bytes(b"old")
    (run / "cells" / "0123456789abcdef.json").write_text("stale")
    (run / "studies").mkdir()
    (run / "studies" / "abc.json").write_text("{}")
    (run / "begun").mkdir()
    (run / "begun" / "abc.jsonl").write_text("nothing\n")
    return run, before


def test_what_no_plan_names_goes_and_the_rest_stays(tmp_path: Path) -> None:
    run, before = littered(tmp_path)
    after = contents(run)
    dry = clean(run, "firsthit clean", dry=True)
    assert contents(run) == after and len(dry) == 6
    said = sorted(one.what.partition(":")[0] for one in dry)
    assert said == [
        "a damaged row that the plan does not name",
        "a row of a cell that the plan does not name",
        "a study that the plan does not name",
        "an older row of a cell of the plan",
        "answers of a row that the plan does not name",
        "what was begun of cells that the plan does not name",
    ]
    assert clean(run, "firsthit clean") == dry
    assert contents(run) == before, "rows that the plan names stay, damaged ones too"
    assert clean(run, "firsthit clean") == []


def test_truth_goes_on_request_alone(tmp_path: Path) -> None:
    run = write(tmp_path / "quick", usual()[:1])
    (run / "truth").mkdir()
    (run / "truth" / "abc.npz").write_bytes(b"t")
    assert clean(run, "c") == [] and (run / "truth" / "abc.npz").exists()
    assert [one.what for one in clean(run, "c", truth=True)] == ["the oracle's answers"]


def test_nothing_is_removed_where_another_command_writes_or_no_plan_can_be_read(tmp_path: Path) -> None:
    run, _ = littered(tmp_path)
    after = contents(run)
    with Lock(run, "firsthit run quick") as lock:
        lock.take()
        with pytest.raises(FirsthitError, match="is being written by"):
            clean(run, "firsthit clean")
        assert len(clean(run, "firsthit clean", dry=True)) == 6
    (run / "plan.json").write_text("{")
    with pytest.raises(FirsthitError, match="so that nothing was removed"):
        clean(run, "firsthit clean")
    assert contents(run).keys() == after.keys()
    with pytest.raises(FirsthitError, match="is no run folder"):
        clean(tmp_path, "firsthit clean")


def test_the_command_lists_first(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run, before = littered(tmp_path)
    assert cli.main(["clean", str(run), "--dry-run"]) == 0
    out = capsys.readouterr().out
    assert (
        "an older row of a cell of the plan: ray_march sphere" in out and "6 files" in out and "would be removed" in out
    )
    assert cli.main(["clean", str(run)]) == 0
    assert "removed" in capsys.readouterr().out and contents(run) == before
