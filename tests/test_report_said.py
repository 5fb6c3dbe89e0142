"""What a reader is told beside a figure: who ties, what is excepted, where the harness's floor is, what an error of 0
means, how well a peak is known, and what the commit does not hold."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from harness.contract import CLAIMS, View, digest
from harness.plugins import find_methods
from harness.running.cards import card
from harness.scenes.views import DirectionChoice, by_direction
from reports import content, wording
from reports.analysis import choices, derive, viewstats
from reports.drawing import choice, fronts, style, surface_tables, viewplots
from reports.parts import conditions, method_cards
from reports.parts.last_page import environment, rerun
from reports.reading import load
from reports.report import Material, Shelf
from reports.sentences import answer
from tests.synthetic_run import SURFACES, cell, printed, reported, retime, tiny_run, write_run


def timed(method: str, surface: str, median: float, error: float | None = 1e-6, device: str = "opencl:intel") -> Any:
    made = cell("null" if method == "null" else "ray_march", surface, device, "float32")
    slot = f"{method} {surface} {device}"
    made |= {"slot": slot, "key": digest(slot), "method": method, "variant": method, "arrays": None}
    made["accuracy"] |= dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root"), 0)
    made["accuracy"]["error"] = made["accuracy"]["relative_error"] = dict.fromkeys(("max", "p999", "p99", "p50"), error)
    return retime(made, median)


def framed(folder: Path, *cells: dict[str, Any]) -> pd.DataFrame:
    return derive.derive(load.load(tiny_run(folder, *cells)).frame)


def planned(folder: Path, **told: Any) -> Path:
    document = json.loads((folder / "plan.json").read_text()) | told
    (folder / "plan.json").write_text(json.dumps(document))
    return folder


# ---- ties


def cloud(variant: str, excess: float) -> conditions.Cloud:
    return conditions.Cloud(
        variant, variant, variant, variant, "float32", np.array([1.0]), np.array([excess * 2.0**-24])
    )


def test_all_whose_worst_error_over_condition_is_the_same_are_named() -> None:
    caption = conditions._caption([cloud("a", 12.0), cloud("b", 3.0), cloud("c", 12.01), cloud("d", 3.0)], "domain's")
    assert caption == "Worst error over the line, in float32: from 3.0 (b and d) to 12 (a and c)."
    assert "float32: 3.0 (a and b)." in conditions._caption([cloud("a", 3.0), cloud("b", 3.0)], "domain's")
    assert "float32: 3.0 (a)." in conditions._caption([cloud("a", 3.0)], "domain's")


# ---- claims of a method


def test_a_card_says_what_a_claim_excepts_and_on_which_rays_it_held(tmp_path: Path) -> None:
    rows = framed(tmp_path / "run", timed("ray_march", "torus", 1.0), timed("ray_march", "sphere", 1.0))
    for name in CLAIMS:
        assert CLAIMS[name] in method_cards._claims("ray_march", [name], rows)
    told = method_cards._claims("ray_march", ["no_false_hit"], rows.assign(judged=100))
    assert "on rays that are neither grazing nor drowned. Held on 200 decided rays" in told
    assert told.endswith("in 2 rows of this run (2 surfaces in float32 on opencl:intel).")
    passed = method_cards._claims(
        "ray_march", ["no_missed_root"], rows.assign(misses=0, grazing_misses=0, wrong_root=4)
    )
    assert "of 8 wrong roots it is not counted which are later ones" in passed
    assert "`firsthit conform --method mine` checks it" in method_cards._claims("mine", ["finds_touch"], rows)


def test_a_card_says_what_the_source_prints_for_a_knob() -> None:
    knob = {"name": "SPLIT", "default": 1, "meaning": "where it parts", "printed": 0}
    assert method_cards._knob(knob) == "SPLIT = 1 (where it parts; as printed 0)"
    assert method_cards._knob(knob | {"printed": None}) == "SPLIT = 1 (where it parts)"


# ---- the floor


def test_a_row_bound_by_the_floor_is_no_largest_gain(tmp_path: Path) -> None:
    cells = [timed("null", "torus", 0.5), timed("ray_march", "torus", 40.0)]
    cells += [timed("bound", "torus", 0.8), timed("newton", "torus", 2.0)]
    frame = framed(tmp_path / "run", *cells)
    (figure,) = fronts.speed_against_error(frame, style.marks(frame["method"]), "torus", "Torus")
    assert "The largest gain with no wrong ray: Newton in float32" in figure.caption
    assert "20.0× as fast as Ray march" in figure.caption
    assert "of its 2.00 ms the harness's floor is 0.500 ms. 1 floor-bound row left out" in figure.caption
    found = choices.choices(frame)
    assert "come from Bound on Torus (0.800 ms, floor-bound)" in answer.lead(found)
    assert answer.gain(found).startswith("Every time is floor-bound")
    alone = framed(tmp_path / "alone", *cells[:3])
    (figure,) = fronts.speed_against_error(alone, style.marks(alone["method"]), "torus", "Torus")
    assert "Every gain over Ray march is floor-bound here" in figure.caption
    unknown = framed(tmp_path / "unknown", cells[1], cells[3])
    (figure,) = fronts.speed_against_error(unknown, style.marks(unknown["method"]), "torus", "Torus")
    assert "the harness's floor was not measured there" in figure.caption


def test_a_headline_counts_the_floor_bound_rows_that_its_gain_leaves_out(tmp_path: Path) -> None:
    cells = []
    for surface, floor in (("torus", 0.9), ("sphere", 0.1)):
        cells += [timed("null", surface, floor), timed("ray_march", surface, 20.0), timed("newton", surface, 1.0)]
    cells[4] = timed("ray_march", "sphere", 8.0)
    found = choices.choices(framed(tmp_path / "run", *cells))
    assert answer.gain(found) == "8.00× as fast as Ray march (1 left out, whose time is floor-bound)."


# ---- an error of 0


def test_an_error_of_0_is_explained_wherever_one_is_printed(tmp_path: Path) -> None:
    cells = [timed("ray_march", "torus", 9.0, 0.0), timed("newton", "torus", 1.0, 0.0)]
    run, report = reported(tiny_run(tmp_path / "run", *cells))
    shown = 0
    for section in (report.summary, *report.sections):
        for table in (block for block in (*section.blocks, *section.details) if isinstance(block, content.Table)):
            errors = [i for i, column in enumerate(table.columns) if "error" in column.title]
            if any(row[i] == 0.0 for row in table.rows for i in errors):
                shown += 1
                assert wording.ZERO in table.caption, table.title
    assert shown >= 2
    table = choice.table(derive.derive(run.frame))
    assert table is not None and wording.ZERO in table.caption
    assert (
        wording.ZERO
        not in surface_tables.results_table(framed(tmp_path / "other", timed("newton", "torus", 1.0))).caption
    )
    text = "\n".join(printed(section.blocks + section.details) for section in report.sections)
    assert text.count(wording.ZERO) > shown, "in how to read the pages too"


# ---- peaks


def test_a_share_of_a_peak_has_one_digit_and_the_devices_say_how_well_it_is_known(tmp_path: Path) -> None:
    assert [wording.rough(x) for x in (0.1234, 0.96, 0.0034, 1e-6, None)] == [
        "≈ 10 %",
        "≈ 100 %",
        "≈ 0.3 %",
        "< 0.1 %",
        "–",
    ]
    folder = tiny_run(tmp_path / "run", cell("ray_march", "torus", "opencl:intel", "float32"))
    devices = json.loads((folder / "plan.json").read_text())["devices"]
    devices[0]["probes"] |= {"peak_gflops": 528.8, "peak_median_gflops": 311.2}
    table = environment.devices_table(load.load(planned(folder, devices=devices)).plan)
    titles = [column.title for column in table.columns if column.over]
    assert titles == ["peak", "median"]
    line = " | ".join(column.show(value) for column, value in zip(table.columns, table.rows[0], strict=True))
    assert "530 | 310" in line, "two digits, since no more are known"
    assert "The median is of all launches of that loop" in table.caption


# ---- what the commit does not hold


def test_the_rerun_page_names_methods_and_configs_that_are_no_part_of_the_commit(tmp_path: Path) -> None:
    plugin = tmp_path / "plugins" / "mine"
    plugin.mkdir(parents=True)
    (plugin / "method.py").write_text(
        'from harness.contract import Method\nMETHOD = Method(name="mine", source="x", claims=frozenset())\n'
    )
    (plugin / "kernel.glsl").write_text("")
    catalog = find_methods(plugin.parent)
    methods = {name: card(catalog.get(name)) for name in ("mine", "newton")}
    made = timed("mine", "torus", 1.0) | {"identity": {"method": {"mine/kernel.glsl": "0123456789abcdef"}}}
    folder = planned(tiny_run(tmp_path / "run", made), methods=methods, config=str(tmp_path / "own.toml"))

    def page(folder: Path) -> str:
        run = load.load(folder)
        material = Material(run, derive.derive(run.frame), pd.DataFrame(), Shelf(run.folders))
        return printed(rerun.blocks(material))

    told = page(folder)
    assert f"No part of the commit, which does not hold what lies outside the project: mine from {plugin}" in told
    assert "(mine/kernel.glsl 0123456789abcdef)" in told and "newton" not in told
    assert "own.toml is no part of the commit; the HTML page has its text" in told
    older = {name: {k: v for k, v in told.items() if k != "outside"} for name, told in methods.items()}
    planned(folder, methods=older, command="firsthit --plugins p run x.toml", config="x.toml")
    assert "Methods that --plugins adds are no part of the commit." in page(folder)
    planned(folder, methods={"newton": methods["newton"]}, command="firsthit run configs/quick.toml")
    assert "no part of the commit" not in page(folder)


def test_the_first_page_says_which_pictures_its_times_are_of(tmp_path: Path) -> None:
    def sized(method: str, size: int, ms: float) -> Any:
        made = timed(method, "torus", ms)
        slot = f"{method} {size}"
        return made | {"size": size, "slot": slot, "key": digest(slot), "comparison": f"torus front {size}x{size}x1"}

    cells = [
        sized(method, size, size / 64 * ms) for size in (64, 128) for method, ms in (("newton", 1.0), ("sturm", 2))
    ]
    table = choice.table(framed(tmp_path / "run", *cells))
    assert table is not None
    assert table.rows[0][:3] == ("Torus", "Newton", 2.0), "the largest picture of equally full scenes"
    assert "View front, 128 × 128" in table.caption
    assert table.title == "Which method, at which error, on opencl:intel."


# ---- one order, one scale


def test_surfaces_stand_in_the_plans_order_on_every_page(tmp_path: Path) -> None:
    order = ("torus", "sphere", "barth")
    cells = [timed(m, surface, ms) for surface in order for m, ms in (("newton", 1.0), ("ray_march", 9.0))]
    _, report = reported(tiny_run(tmp_path / "run", *cells))
    titles = [SURFACES[surface][0] for surface in order]
    pairs = next(section for section in report.sections if section.title == "Variants compared round by round")
    assert [block.title.split(",")[0] for block in pairs.details if isinstance(block, content.Table)] == titles
    winners = next(section for section in report.sections if section.title == "Winners")
    (matrix,) = [block for block in winners.blocks if isinstance(block, content.Matrix)]
    assert list(matrix.columns) == titles
    assert [section.title for section in report.sections if section.title in titles] == titles


def test_all_pictures_of_a_report_share_one_scale_of_errors(tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run")
    for file in sorted(folder.glob("arrays/*.npz"))[::2]:  # what one page shows and the other does not
        with np.load(file) as stored:
            kept = {name: stored[name] for name in stored}
        np.savez_compressed(file, **(kept | {"error": kept["error"] * np.float32(1e-3)}))
    _, report = reported(folder)
    legends = {
        block.legend.name
        for section in report.sections
        for block in (*section.blocks, *section.details)
        if isinstance(block, content.Gallery) and block.legend
    }
    pages = [s.title for s in report.sections if any(isinstance(block, content.Gallery) for block in s.blocks)]
    assert len(pages) > 2
    assert len(legends) == 1


def test_maps_of_all_sets_share_their_scales(tmp_path: Path) -> None:
    cells = []
    for surface, top in (("torus", 1e-3), ("sphere", 1e-7)):
        for i, view in enumerate(by_direction(DirectionChoice(6))):
            cells.append(seen(surface, view, 1.0 + i, top))
    loaded = load.load(tiny_run(tmp_path / "run", *cells))
    frame = derive.derive(loaded.frame)
    errors = Material(loaded, frame, pd.DataFrame(), Shelf(loaded.folders)).error_scale
    assert errors == (-7, -3), "of both surfaces' errors"
    sets = viewstats.view_sets(frame)
    scales = viewplots.Scales.of(sets, errors)
    ticks = [
        [t for t in ("10⁻⁷", "10⁻³") if f">{t}<" in viewplots.over_directions(of, scales, "a")[0].svg] for of in sets
    ]
    assert ticks[0] == ticks[1] == ["10⁻⁷", "10⁻³"]


def seen(surface: str, view: View, ms: float, error: float) -> dict[str, Any]:
    made = timed("ray_march", surface, ms, error)
    slot = f"{surface} {view.name}"
    made |= {"slot": slot, "key": digest(slot), "view": view.name, "view_set": "directions", "comparison": slot}
    made["camera"] = {"azimuth": view.azimuth, "elevation": view.elevation, "fov": 30.0, "distance": 5.0}
    made["accuracy"]["domain_rays"] = made["accuracy"]["rays"]
    return made
