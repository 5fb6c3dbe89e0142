"""Reports compare only what was asked, timed and counted alike, and nothing drops out of a count unsaid."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pandas as pd
import pytest

from harness.accuracy.check import too_wrong
from harness.contract import digest
from reports.analysis import choices, derive, shown, ties
from reports.content import Matrix, Text
from reports.drawing import charts, choice, surface_tables, trades_tables, who_is_right
from reports.parts import devices_compared, instance_scenes, who_breaks_where, winners
from reports.reading import load
from tests.synthetic_run import cell, printed, retime, sampled, tiny_run
from tests.test_report_scenes import row as scene_row


def row(
    method: str, ms: float, surface: str = "torus", *, misses: int = 0, size: int = 256, **told: Any
) -> dict[str, Any]:
    """A row of a method that is right but for `misses`; `told` are leaves of the row, and `clock` of its time."""
    device, precision = told.pop("device", "opencl:intel"), told.pop("precision", "float32")
    clock = told.pop("clock", "device")
    made = cell("ray_march", "torus", device, precision)
    slot = f"{method} {surface} {size} {precision} {device}"
    made |= {"slot": slot, "key": digest(slot), "variant": method, "method": method, "arrays": None, "size": size}
    made |= {"surface": surface, "surface_title": surface.title(), "comparison": f"{surface} front {size} compute"}
    made["accuracy"] |= {"misses": misses, "false_hits": 0, "exhausted": 0, "wrong_root": 0, "judged": 2000}
    made["time"] |= {"clock": clock, "overhead_share": 0.5 if clock == "device" else None}
    return retime(made, ms) | told


def frame(folder: Path, *rows: dict[str, Any]) -> pd.DataFrame:
    return derive.derive(load.load(tiny_run(folder, *rows)).frame)


def failed(made: dict[str, Any]) -> dict[str, Any]:
    """The row as it is stored where it is wrong on too many rays to be timed."""
    reason = too_wrong(made["accuracy"], 0.5)
    assert reason is not None
    return made | {"status": "failed", "reason": reason, "time": None}


def test_two_sizes_of_a_surface_are_two_scenes_and_no_two_surfaces(tmp_path: Path) -> None:
    rows = frame(tmp_path / "run", *(row("newton", 1.0, size=size) for size in (256, 512)))
    assert winners._seen(ties.leaders(rows)).startswith("Of 2 scenes on which")
    several = [row("newton", 1.0, size=s, device=d) for s in (256, 512) for d in ("opencl:intel", "opencl:pocl")]
    told = winners._seen(ties.leaders(frame(tmp_path / "several", *several)))
    assert told.startswith("Of 4 combinations of scene, device and precision on which")


def test_the_largest_picture_stands_for_a_surface(tmp_path: Path) -> None:
    rows = frame(tmp_path / "run", *(row(m, ms, size=s) for s, m, ms in SIZES))
    assert shown.fullest(rows) == "torus front 512 compute"
    (found,) = choices.choices(rows)
    assert choice.made([found], False, 1, 2).caption.endswith("of several the largest picture; “Winners” has all.")
    assert "largest picture" not in choice.made([found], False, 1, 1).caption


SIZES = [(16, "newton", 0.001), (16, "sturm", 0.002), (512, "newton", 1.0), (512, "sturm", 2.0), (900, "newton", 3.0)]


def test_a_variant_that_is_wrong_in_one_precision_is_not_called_right(tmp_path: Path) -> None:
    rows = [row("newton", 1.0, misses=3), row("newton", 1.0, precision="float64"), row("sturm", 1.0)]
    lead, *_ = who_is_right.blocks(frame(tmp_path / "run", *(one | {"time": None} for one in rows)))
    assert isinstance(lead, Text)
    assert lead.text.startswith("Right on every ray away from silhouettes:")
    assert "Newton in float64" in lead.text and "Sturm" in lead.text and "answer some wrongly" in lead.text


def test_what_is_too_wrong_to_be_timed_counts_as_wrong(tmp_path: Path) -> None:
    bad = failed(row("newton", 1.0, misses=1500))
    rows = [bad, row("newton", 1.0, "sphere") | {"time": None}, row("sturm", 1.0) | {"time": None}]
    told = printed(who_is_right.blocks(frame(tmp_path / "run", *rows)))
    assert "Right on every ray away from silhouettes: Sturm. The others answer some wrongly." in told
    assert "Newton | float32 | 1 | 2 | 1,500" in told
    grouped = [one | {"surface_group": "nodal"} for one in rows]
    (section,) = who_breaks_where.sections(_material(frame(tmp_path / "grouped", *grouped)))
    told = printed((*section.blocks, *section.details))
    assert "Newton is wrong on most: 1 of 2" in told and "Newton | 2 | 1 | nodal 1 of 2 (Torus 75 %, misses)" in told
    undecided = bad | {"reason": "the oracle leaves 30 of 90 hits undecided, over 0.01 of them: no accuracy"}
    assert not derive.is_judged(frame(tmp_path / "undecided", undecided)).any()


def _material(rows: pd.DataFrame) -> Any:
    return SimpleNamespace(frame=rows, run=SimpleNamespace(plan=SimpleNamespace(methods={})))


def test_a_tolerance_is_held_against_the_same_precision_and_normal() -> None:
    alone = {"normal": "distance"}
    rows = [scene_row("newton", ms, 0.001) | alone | told for ms, told in PLAIN]
    rows += [scene_row("newton to 1 pixels", 8.0, 0.7, pixels=1.0) | alone | {"precision": "float64"}]
    sections = instance_scenes.sections(SimpleNamespace(listed=pd.DataFrame(rows)))
    (line,) = next(section for section in sections if section.name == "Tolerances").details[0].rows
    assert line[5:8] == (40.0, 8.0, pytest.approx(0.8))


PLAIN = [(10.0, {}), (20.0, {"precision": "float64", "normal": "gradient"}), (40.0, {"precision": "float64"})]


def test_devices_are_compared_on_the_same_scenes_and_by_one_clock(tmp_path: Path) -> None:
    first, second, third = "opencl:intel", "opencl:pocl", "opengl:llvmpipe"
    times = {("sphere", first): 1.0, ("sphere", second): 4.0, ("torus", first): 1.0, ("torus", second): 4.0}
    times |= {("torus", third): 1.2}
    rows = [row("newton", ms, surface, device=device) for (surface, device), ms in times.items()]
    (section,) = devices_compared.sections(SimpleNamespace(listed=frame(tmp_path / "sets", *rows)))
    matrix = next(block for block in section.blocks if isinstance(block, Matrix))
    notes = {square.note for _, squares in matrix.rows for square in squares}
    assert notes == {"mean of 1 scene"}, "of the scene that all three have"

    own, host = row("newton", 1.0), row("newton", 3.0, device="opencl:pocl", clock="wall")
    host["time"] |= {"samples_ms": [3 * one for one in own["time"]["samples_ms"]]}
    both = frame(tmp_path / "clocks", own, host)
    (section,) = devices_compared.sections(SimpleNamespace(listed=both))
    matrix = next(block for block in section.blocks if isinstance(block, Matrix))
    assert [square.text for square in matrix.rows[0][1]] == ["1.00×", "2.00×"], (
        "1 ms and a half that its clock leaves out"
    )
    assert "compared by the host's" in matrix.caption
    assert section.details[0].rows[0][4] == pytest.approx(2.0)
    elsewhere = trades_tables.devices(both)
    assert elsewhere is not None and elsewhere.rows[0][2:5] == (pytest.approx(2.0),) * 3
    assert "Ratios are of the rounds that timed both." in elsewhere.caption
    apart = trades_tables.devices(frame(tmp_path / "apart", own, host | {"time": host["time"] | {"session": "later"}}))
    assert apart is not None and "not taken in turns" in apart.caption


def test_times_of_two_runs_differ_only_where_they_are_far_apart(tmp_path: Path) -> None:
    def later(method: str, ms: float) -> dict[str, Any]:
        made = row(method, ms)
        return made | {"time": made["time"] | {"session": "later"}}

    rows = [row("newton", 2.0), row("ray_march", 9.0), row("sturm", 12.0), later("mine", 1.0), later("slow", 90.0)]
    (found,) = choices.choices(frame(tmp_path / "run", *rows))
    assert found.within[0].variant == "mine" and found.tied[0] == ("Newton",)
    caption = choice.made([found], False).caption
    assert "Timed in another run than the rest" in caption and "Mine and Slow; with --force" in caption


def test_the_first_table_says_whose_times_are_noisy(tmp_path: Path) -> None:
    steady, noisy = row("newton", 1.0), row("newton", 1.0, "sphere")
    for made, warnings in ((steady, []), (noisy, ["noisy: the middle half …"])):
        made["time"] |= {"warnings": warnings}
    found = choices.choices(frame(tmp_path / "run", steady, noisy))
    assert choice.made(found, False).caption.count("Times are noisy or drift") == 1
    assert "ratios are rough: Sphere." in choice.made(found, False).caption


def test_a_single_sample_has_no_interval(tmp_path: Path) -> None:
    made = [sampled(row(method, 1.0), [1.0] * count) for method, count in (("newton", 1), ("sturm", 6))]
    rows = frame(tmp_path / "run", *made)
    table = surface_tables.compact_table(rows)
    assert table is not None
    told = [[column.show(value) for column, value in zip(table.columns, line, strict=True)] for line in table.rows]
    assert {line[0]: line[2] for line in told} == {"Newton": "–", "Sturm": "0.0 %"}
    assert choices.choices(rows)[0].tied[0] == ("Sturm",)
    explored = charts.explorer(rows)
    assert explored is not None and explored.columns["low"] == [None, 1.0] == explored.columns["high"]


@pytest.mark.parametrize("baseline", [True, False])
def test_a_column_of_speed_ups_is_there_where_the_baseline_is(tmp_path: Path, baseline: bool) -> None:
    others = ("newton", "ray_march") if baseline else ("newton", "sturm")
    rows = frame(tmp_path / "run", *(sampled(row(method, 1.0), [1.0] * 8) for method in others))
    for table in (surface_tables.compact_table(rows), winners.winners_table(rows, ties.leaders(rows))):
        assert table is not None
        assert ("speed-\nup" in [column.title for column in table.columns]) is baseline
        assert ("Speed-up is" in table.caption) is baseline


def test_one_in_a_thousand_is_of_the_clear_rays() -> None:
    columns = ("wrong_rays", "judged", "accuracy_rays", "undecided", "grazing", "drowned")
    rows = [
        (16, 9000, 16384, 0, 7384, 0),
        (16, 16384, 16384, 0, 0, 0),
        (16, None, 16384, 200, 300, None),
        *[(None,) * 6],
    ]
    frame = pd.DataFrame(rows, columns=columns)
    assert list(derive.clear_rays(frame).fillna(-1)) == [9000, 16384, 15884, -1]
    assert list(derive.nearly_all_right(frame)) == [False, True, False, False]
