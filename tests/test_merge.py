"""Runs of one config from several machines, or of shards, become one; what does not fit is named with its reason."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from harness import cli
from harness.contract import FirsthitError
from harness.merging import merge as merging
from harness.results.lock import Lock
from harness.results.store import Store
from reports.reading import load
from tests import machine_runs
from tests.machine_runs import contents, plan_of, row_of, usual, write


def merged(tmp_path: Path, *runs: Path, out: str = "all", **more: Any) -> merging.Merged:
    return merging.merge(runs, tmp_path / out, "firsthit merge …", **more)


def reasons(found: merging.Merged) -> list[str]:
    return [f"{Path(one.run).name}: {one.what}: {one.reason}" for one in found.left]


def test_shards_of_one_machine_give_the_rows_of_the_whole_run_in_its_order(tmp_path: Path) -> None:
    rows = usual()
    run = write(tmp_path / "quick", rows)
    first = [row for row in rows if row["surface"] == "torus"]
    second = [row for row in rows if row["surface"] == "sphere"]
    parts = [
        write(tmp_path / f"quick.shard-{n}-of-3", own, shard=(n, 3)) for n, own in ((1, first), (2, second), (3, []))
    ]
    for part, own in zip(parts, (first, second, []), strict=True):
        plan = plan_of(part)
        plan["cells"] = [{"slot": row["slot"], "key": row["key"], "at": rows.index(row)} for row in own]
        plan.pop("checksum")
        Store(part).write_plan(plan)
    found = merged(tmp_path, *parts)
    assert (found.rows, found.cells, found.left, found.twice, found.shards) == (6, 6, [], [], "")
    of_both = [
        {name: text for name, text in contents(one).items() if name != "plan.json"} for one in (run, tmp_path / "all")
    ]
    assert of_both[0] == of_both[1], "the rows are those of the whole run, byte for byte, with their answers"
    assert [one["key"] for one in plan_of(tmp_path / "all")["cells"]] == [row["key"] for row in rows]
    assert "device" not in str(plan_of(tmp_path / "all")["cells"]), "one device keeps its name"
    less = merged(tmp_path, parts[0], out="less")
    assert less.shards == "of 3 shards 2 are missing: 2, 3"


def test_one_name_of_two_devices_is_told_with_the_machine_and_rows_stay_as_they_are(tmp_path: Path) -> None:
    a = write(tmp_path / "a", usual(machine="lab1"), machine="lab1")
    b = write(tmp_path / "b", usual(machine="lab2", driver="2", factor=3.0), machine="lab2")
    found = merged(tmp_path, a, b)
    assert found.devices == ("opencl:intel@lab1", "opencl:intel@lab2") and found.rows == 12 and not found.left
    run = load.load(tmp_path / "all")
    assert list(dict.fromkeys(run.frame["device"])) == list(found.devices)
    assert all(slot.endswith(device) for slot, device in zip(run.frame["slot"], run.frame["device"], strict=True))
    assert [device["name"] for device in run.plan.devices] == list(found.devices)
    assert [device["machine"] for device in run.plan.devices] == ["lab1", "lab2"]
    for source in (a, b):
        rows = {name: text for name, text in contents(source).items() if name != "plan.json"}
        assert rows.items() <= contents(tmp_path / "all").items()
    other = merged(tmp_path, b, a, out="other")
    told = [{one["key"]: one["device"] for one in plan_of(tmp_path / out)["cells"]} for out in ("all", "other")]
    assert told[0] == told[1] and other.rows == 12, "the order of the runs changes no name"


def test_two_drivers_of_one_machine_and_two_machines_that_are_alike(tmp_path: Path) -> None:
    old = write(tmp_path / "old", usual(started="2026-11-01T00:00:00+00:00"))
    new = write(tmp_path / "new", usual(driver="2"))
    assert merged(tmp_path, new, old).devices == ("opencl:intel@lab1-2", "opencl:intel@lab1"), (
        "the older one is the first"
    )
    alike = write(tmp_path / "alike", usual(machine="lab7"), machine="lab7")
    found = merged(tmp_path, alike, old, out="same")
    assert found.devices == ("opencl:intel",) and found.rows == 6 and len(found.twice) == 6
    untimed = row_of("ray_march", "sphere", cores=None, machine="lab3")
    less = write(tmp_path / "untimed", [untimed], machine="lab3")
    assert merged(tmp_path, less, new, old, out="more").devices[0] == "opencl:intel@lab1", "cores are not told untimed"


def test_what_fits_of_three_runs_is_merged_and_what_does_not_is_named(tmp_path: Path) -> None:
    """A run of a changed commit, one that is truncated, and one of another config."""
    good = write(tmp_path / "good", usual())
    changed = write(tmp_path / "changed", usual(machine="lab2", driver="2", files={"harness/a.py": "f" * 16}))
    truncated = write(tmp_path / "truncated", usual(machine="lab3", driver="3"), machine="lab3")
    hurt = sorted((truncated / "cells").glob("*.json"))[0]
    hurt.write_bytes(hurt.read_bytes()[:200])
    other = write(tmp_path / "other", usual(machine="lab4"), text='title = "other"\n')
    found = merged(tmp_path, good, changed, truncated, other)
    assert found.rows == 6 + 5 and found.cells == 12
    told = reasons(found)
    assert len([one for one in told if one.startswith("changed: ")]) == 6
    assert "methodology: harness/a.py changed" in next(one for one in told if one.startswith("changed: "))
    assert any(one.startswith(f"truncated: cells/{hurt.name}: its checksum does not hold") for one in told)
    assert "other: the run: it is of another config than" in told[0] and len(told) == 8
    assert len(list((tmp_path / "all" / "cells").iterdir())) == 11
    run = load.load(tmp_path / "all")
    assert len(run.frame) == 11 and len(run.not_run) == 1


def test_the_same_merge_again_changes_nothing_and_one_that_was_stopped_goes_on(tmp_path: Path) -> None:
    a = write(tmp_path / "a", usual())
    b = write(tmp_path / "b", usual(machine="lab2", driver="2"), machine="lab2")
    assert merged(tmp_path, a, b).written > 0
    out = tmp_path / "all"
    before = {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in out.rglob("*.json")}
    again = merged(tmp_path, a, b)
    assert again.written == 0 and again.rows == 12 and not again.left and not again.twice
    assert {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in out.rglob("*.json")} == before
    for path in sorted((out / "cells").iterdir())[:5]:
        path.unlink()
    assert merged(tmp_path, a, b).rows == 12
    assert {path: path.read_bytes() for path in out.rglob("*.json")} == {
        path: text for path, (_, text) in before.items()
    }
    c = write(tmp_path / "c", usual(machine="lab3", driver="3"), machine="lab3")
    assert merged(tmp_path, c).rows == 18, "a later merge adds to an earlier one"
    assert [one["run"] for one in plan_of(out)["merged"]] == ["a", "b", "c"]


def test_of_a_cell_that_two_runs_have_one_is_kept_and_it_is_said_why(tmp_path: Path) -> None:
    a, b = usual(), usual(factor=1.5, machine="lab9")
    a[0] |= {"status": "timeout", "reason": "60 s", "time": None, "arrays": None}
    b[1]["accuracy"] = json.loads(json.dumps(b[1]["accuracy"])) | {"misses": 7}
    found = merged(tmp_path, write(tmp_path / "a", a), write(tmp_path / "b", b, machine="lab9"))
    kept = {row["slot"]: row for row in Store(tmp_path / "all").rows()}
    assert kept[a[0]["slot"]]["status"] == "ok" and kept[a[1]["slot"]] == a[1]
    assert kept[a[2]["slot"]]["time"] == a[2]["time"], "the run that was named first"
    said = {one.slot: one for one in found.twice}
    assert said[a[0]["slot"]].why == "it ended well" and said[a[0]["slot"]].kept == str(tmp_path / "b")
    assert said[a[1]["slot"]].contradicts and "accuracy.misses differs" in said[a[1]["slot"]].why
    assert not said[a[2]["slot"]].contradicts and len(said) == 6
    c = write(tmp_path / "c", usual(packages={"numpy": "1.0"}))
    conditions = merged(tmp_path, tmp_path / "a", c, out="more").twice
    assert "other conditions: packages: numpy: '2.4.6' → '1.0'" in conditions[-1].why


def test_what_a_machine_lacks_is_taken_from_one_that_has_it(tmp_path: Path) -> None:
    lacking = usual(machine="lab2")
    for row in lacking:
        row |= {"status": "skipped", "reason": "there is no device", "time": None, "accuracy": None, "arrays": None}
        row["identity"]["device"] = None
    a, b = write(tmp_path / "a", lacking, machine="lab2"), write(tmp_path / "b", usual()[:3])
    found = merged(tmp_path, a, b)
    assert found.rows == 6 and found.elsewhere == {str(a): 3}
    assert sorted(row["status"] for row in Store(tmp_path / "all").rows()) == ["ok"] * 3 + ["skipped"] * 3


def test_cells_that_have_not_run_are_named_unless_another_run_has_them(tmp_path: Path) -> None:
    rows = usual()
    a = write(tmp_path / "a", rows[:2], more=rows[2:])
    b = write(tmp_path / "b", rows[2:4])
    found = merged(tmp_path, a, b)
    assert (found.rows, found.cells) == (4, 6)
    assert len(load.load(tmp_path / "all").not_run) == 2


def test_damaged_answers_cost_their_picture_alone(tmp_path: Path) -> None:
    rows = usual()
    a = write(tmp_path / "a", rows)
    (a / rows[0]["arrays"]).write_bytes(b"no zip file")
    found = merged(tmp_path, a)
    assert found.rows == 6 and "merged without its answers ray by ray" in reasons(found)[0]
    assert machine_runs.pictured(tmp_path / "all", rows[1])


@pytest.mark.parametrize("what", ("a run", "a file", "a folder of files"))
def test_only_a_new_folder_or_a_merged_run_is_written_to(tmp_path: Path, what: str) -> None:
    a = write(tmp_path / "a", usual()[:1])
    out = tmp_path / "out"
    if what == "a run":
        write(out, usual()[:2])
    elif what == "a file":
        out.write_text("mine")
    else:
        out.mkdir()
        (out / "mine.txt").write_text("mine")
    before = contents(tmp_path)
    with pytest.raises(FirsthitError, match="name a"):
        merged(tmp_path, a, out="out")
    assert contents(tmp_path) == before


def test_nothing_is_left_where_nothing_can_be_merged_or_another_command_writes(tmp_path: Path) -> None:
    broken = write(tmp_path / "broken", usual()[:1])
    (broken / "plan.json").write_text("{")
    with pytest.raises(FirsthitError, match=r"nothing was merged: .*broken: plan.json is damaged"):
        merged(tmp_path, broken, tmp_path / "nowhere")
    assert not (tmp_path / "all").exists()
    a = write(tmp_path / "a", usual()[:1])
    with Lock(tmp_path / "all", "firsthit merge b -o all") as lock:
        lock.take()
        with pytest.raises(FirsthitError, match="is being written by"):
            merged(tmp_path, a)


def test_the_command_says_what_it_did_by_its_exit_code(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    a = write(tmp_path / "a", usual())
    b = write(tmp_path / "b", usual(machine="lab2", driver="2"), machine="lab2")
    assert cli.main(["merge", str(a), str(b), "-o", str(tmp_path / "all")]) == 0
    out = capsys.readouterr().out
    assert "12 of 12 cells have a row, on opencl:intel@lab1, opencl:intel@lab2" in out
    assert cli.main(["merge", str(a), str(b), "-o", str(tmp_path / "all")]) == 0
    assert "nothing was new" in capsys.readouterr().out
    other = write(tmp_path / "other", usual(), text="x = 1\n")
    assert cli.main(["merge", str(a), str(other), "-o", str(tmp_path / "all")]) == 3
    assert "the run was left out: it is of another config" in capsys.readouterr().err
    rows = usual()
    rows[1]["accuracy"]["misses"] = 5
    wrong = write(tmp_path / "wrong", rows)
    assert cli.main(["merge", str(a), str(wrong), "-o", str(tmp_path / "two")]) == 1
    assert "disagree; kept is" in capsys.readouterr().err
    assert cli.main(["merge", str(tmp_path / "no"), "-o", str(tmp_path / "three")]) == 3
    assert "Traceback" not in capsys.readouterr().err
