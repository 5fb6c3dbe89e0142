"""Devices are held against each other by speed-ups on each, by orders that change, and by answers that differ."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from harness.merging.merge import merge
from harness.results.store import Store
from reports import report
from reports.analysis import across, derive
from reports.content import Figure, Matrix, Table, Text
from reports.drawing import style
from reports.parts import devices_across
from reports.parts.last_page import environment, rerun
from reports.place import place
from reports.reading import load
from reports.reading.run import Run
from tests.machine_runs import plan_of, row_of, write

VARIANTS = ("ray_march", "newton[EPSILON=0.001]", "newton[EPSILON=1e-06]")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """Merge two machines: on the second, `newton` with the larger EPSILON is slow, and the other misses more rays."""
    folder = tmp_path_factory.mktemp("machines")
    runs = []
    for machine, driver in (("lab1", "1"), ("lab2", "2")):
        rows = []
        for surface in ("sphere", "torus"):
            for variant in VARIANTS:
                slow = 10.0 if machine == "lab2" and variant == VARIANTS[1] else 1.0
                rows.append(row_of(variant, surface, machine=machine, driver=driver, factor=slow) | {"arrays": None})
        if machine == "lab2":
            rows[-1]["accuracy"] |= {"misses": 5}
        runs.append(write(folder / machine, rows, machine=machine))
        told = plan_of(runs[-1])
        told["environment"] |= {"commit": "abc1234" if machine == "lab1" else "def5678", "dirty": machine == "lab2"}
        Store(runs[-1]).write_plan({k: v for k, v in told.items() if k not in ("checksum", "format")})
    merge(runs, folder / "all", "firsthit merge lab1 lab2 -o runs/all")
    return load.load(folder / "all")


def test_the_order_that_changes_is_told_and_the_answer_that_differs(run: Run) -> None:
    frame = derive.derive(run.frame)
    marks = style.marks(frame["method"])
    (section,) = devices_across.sections(SimpleNamespace(listed=frame, method_marks=marks))
    texts = [block.text for block in section.blocks if isinstance(block, Text)]
    assert "1 pair of variants changes order between devices: on opencl:intel@lab1, Newton, ε = 0.001" in texts[0]
    assert "1 answer another number of rays wrongly" in texts[1]
    matrix = next(block for block in section.blocks if isinstance(block, Matrix))
    assert set(matrix.columns) == {"opencl:intel@lab1", "opencl:intel@lab2"}
    strong = {label: [square.strong for square in squares] for label, squares in matrix.rows}
    first = matrix.columns.index("opencl:intel@lab1")
    assert strong["Newton, ε = 0.001"][first] and not strong["Newton, ε = 0.001"][1 - first]
    figure = next(block for block in section.blocks if isinstance(block, Figure))
    assert all(name in figure.svg for name in (*matrix.columns, "Sphere", "Newton"))
    swapped, differing = (block for block in section.blocks if isinstance(block, Table))
    assert [row[2] for row in swapped.rows] == ["opencl:intel@lab1"]
    assert differing.rows[0][0] == "Torus" and 5 in differing.rows[0]


def test_ratios_are_of_the_same_scenes_and_never_of_two_machines(run: Run) -> None:
    rows = across.comparable(derive.derive(run.frame))
    (swap,) = across.swaps(rows, across.devices_of(rows))
    own = rows[rows["variant"].isin(VARIANTS[1:]) & rows["comparison"].str.startswith("sphere")]
    speed = own.set_index(["device", "variant"])["speedup"]
    here = [speed[swap.device, variant] for variant in VARIANTS[1:]]
    assert swap.scenes == 1, "of the torus one row is wrong, so that it has no speed-up"
    assert swap.here == pytest.approx(here[0] / here[1]) and swap.there == pytest.approx(swap.here / 10, rel=0.6)
    alone = rows[rows["device"] == swap.device]
    assert across.swaps(alone, [swap.device]) == [] and across.mean_speedups(alone) == {}


def test_one_device_has_nothing_to_stand_against(run: Run) -> None:
    frame = derive.derive(run.frame)
    alone = frame[frame["device"] == "opencl:intel@lab1"]
    assert devices_across.sections(SimpleNamespace(listed=alone, method_marks={})) == []


def test_a_merged_run_says_of_what_it_is_made(run: Run) -> None:
    *_, merged = environment.blocks(run.plan)
    assert isinstance(merged, Table) and [row[:2] for row in merged.rows] == [("lab1", "lab1"), ("lab2", "lab2")]
    material = SimpleNamespace(run=run, frame=run.frame)
    code, _ = rerun.blocks(material)
    lines = code.text.splitlines()
    assert [line for line in lines if "git checkout" in line] == ["git checkout abc1234", "git checkout def5678"]
    assert "commits abc1234 and def5678 with uncommitted changes" in report._subtitle(run)
    assert lines.count("firsthit run configs/quick.toml") == 2 and "# on lab2" in lines
    assert lines[-2:] == ["firsthit merge lab1 lab2 -o runs/all", "firsthit report runs/all"]


def test_a_report_on_several_runs_has_a_place_beside_them() -> None:
    assert place(Path("runs/a"), Path("runs/b"), joined=True).name == "a-and-b.report"
    many = [Path(f"runs/quick.shard-{n}-of-9") for n in range(9)]
    assert place(*many, joined=True).name == "quick.shard-0-of-9-and-8-more.report"
