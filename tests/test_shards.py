"""Shards of a config are its whole plan, each cell once, the same on each machine; comparisons stay in one piece."""

from __future__ import annotations

import dataclasses
from collections import Counter
from pathlib import Path

import pytest

from harness.contract import DeviceInfo, FirsthitError
from harness.experiment import plan, reading, shards
from harness.experiment.config import Experiment
from harness.experiment.shards import Shard
from harness.experiment.shipped import located
from harness.plugins import Catalog, find_methods
from harness.results import plan_file
from harness.running import run as running

FOUND = [
    DeviceInfo(name, "One", "1", "c", 2, True, "wall", ())
    for name in ("opencl:intel", "opencl:pocl", "opengl:llvmpipe")
]
SMALL = """title = "Three groups"
surfaces = ["torus", "kiss"]
families = ["grazing"]
devices = ["all"]
studies = ["condition_numbers"]
[[method]]
name = "newton"
[[method]]
name = "null"
[[view]]
name = "front"
azimuth = 0
elevation = 0
"""


def loaded(name: str | Path) -> tuple[list[Experiment], Catalog]:
    catalog = find_methods(None).with_stand_ins()
    _, parts = reading.load_all(located(name), catalog)
    return [part.on(["all"]) for part in parts], catalog


@pytest.mark.parametrize("name", ("quick", "pipes"))
def test_the_shards_are_the_whole_plan_and_none_has_a_cell_twice(name: str) -> None:
    parts, catalog = loaded(name)
    for of in (1, 3, 16):
        shares = [shards.shares(parts, catalog, Shard(number, of)) for number in range(1, of + 1)]
        for at, part in enumerate(parts):
            cells = [cell for cell, _ in plan.grid(part, catalog, FOUND)]
            whole = Counter(cell.slot for cell in cells)
            split = Counter(cell.slot for own in shares for cell in cells if cell.together in own[at].groups)
            assert whole == split and set(whole.values()) == {1}
            assert sorted(name for own in shares for name in own[at].studies) == sorted(part.config.studies)


def test_sixteen_shards_of_three_groups_and_a_study_leave_twelve_empty(tmp_path: Path) -> None:
    config = tmp_path / "small.toml"
    config.write_text(SMALL)
    parts, catalog = loaded(config)
    shares = [shards.shares(parts, catalog, Shard(number, 16))[0] for number in range(1, 17)]
    assert [len(one.groups) + len(one.studies) for one in shares] == [1] * 4 + [0] * 12
    assert shares[3].studies == ("condition_numbers",) and shares[15].is_empty


def test_a_share_follows_from_the_config_and_not_from_the_devices_and_is_balanced() -> None:
    parts, catalog = loaded("quick")
    elsewhere = [part.on(["opencl:pocl"]) for part in parts]
    for number in (1, 2, 3):
        one, other = (shards.shares(of, catalog, Shard(number, 3)) for of in (parts, elsewhere))
        assert one == other
    weights = plan.together(parts[0], catalog)
    loads = [sum(weights[name] for name in shards.shares(parts, catalog, Shard(n, 3))[0].groups) for n in (1, 2, 3)]
    assert max(loads) - min(loads) <= max(weights.values())


def test_a_shard_is_written_as_two_numbers() -> None:
    assert shards.read("3/16") == Shard(3, 16) and str(Shard(3, 16)) == "3/16"
    assert Shard(3, 16).named("quick") == "quick.shard-3-of-16"
    for wrong in ("0/4", "5/4", "3", "3/", "a/b", "-1/4", "1/0", "1/99999999", "3/16/2", "", "²/4"):
        with pytest.raises(FirsthitError, match="write K/N"):
            shards.read(wrong)


def test_an_empty_shard_says_so_and_leaves_a_run_that_merges(tmp_path: Path) -> None:
    config = tmp_path / "small.toml"
    config.write_text(SMALL.replace('"all"', '"opencl:none"'))
    given = running.read(config, shard="16/16", machine="lab1")
    heard: list[str] = []
    with_devices = running.Loaded(
        given.whole, given.parts, given.catalog, given.yes, FOUND, shard=given.shard, machine=given.machine
    )
    found = running._run(
        with_devices, tmp_path / "runs", "firsthit run", False, False, running.Teller(heard.append), None
    )
    assert len(found.rows) == 0 and found.folder.name == "small.shard-16-of-16" and not found.unfinished
    assert "shard 16/16 has no cell of" in heard[0]
    told = plan_file.read(found.folder / "plan.json")
    assert (
        told["shard"] == {"number": 16, "of": 16} and told["cells"] == [] and told["environment"]["machine"] == "lab1"
    )
    assert dataclasses.asdict(Shard(16, 16)) == told["shard"]
