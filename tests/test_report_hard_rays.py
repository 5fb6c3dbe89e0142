"""The report of families of hard rays, alone and beside views."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb

from harness.contract import CLAIMS
from harness.plugins import find_methods
from harness.running.cards import card
from reports import content, report, wording
from reports.analysis import breaks
from reports.drawing import shades
from reports.parts import last_page
from reports.reading import load
from tests import synthetic_run
from tests.synthetic_run import family_cell, printed, reported, stability_run, tiny_run

from .ladders import first_break

BREAKS = "Where each method breaks"


@pytest.fixture(scope="module")
def hard(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return stability_run(tmp_path_factory.mktemp("runs") / "stability")


def test_verdicts_name_the_rung_that_breaks(hard: Path) -> None:
    run = load.load(hard)
    rungs = breaks.derive(run.families, run.rungs)
    devices = breaks.by_device(rungs)
    assert list(devices) == [breaks.ALL_DEVICES], "both agree, where both ran"
    rows = breaks.verdicts(devices[breaks.ALL_DEVICES]).set_index(breaks.LADDER)
    broken = rows["breaks_at"].dropna()
    assert broken["grazing", "float64", "newton[EPSILON=0.001]"] == synthetic_run.LEVELS["grazing"][3]
    assert broken["grazing", "float64", "ray_march"] == synthetic_run.LEVELS["grazing"][5]
    assert broken["thin_torus", "float32", "newton[EPSILON=0.001]"] == 100.0
    assert len(broken) == 2 * len(synthetic_run.BROKEN_FROM)
    row = rows.loc["grazing", "float64", "newton[EPSILON=0.001]"]
    assert (row["decided"], row["right"], row["false_hits"], row["worst_ratio"]) == (630, 530, 100, 42.5)
    assert row["share_right"] == pytest.approx(530 / 630)
    blind = rows.xs("double_root")
    assert (blind["decided"] == 0).all() and blind["share_right"].isna().all() and blind["breaks_at"].isna().all()


def test_breaks_are_those_that_the_harness_finds() -> None:
    rng = np.random.default_rng(7)
    told = dict.fromkeys(("key", "slot", "family", "method", "variant", "origin", "precision", "device"), "x")
    told |= {"label": "X", "method_label": "X"}
    for harder in ("smaller", "larger"):
        for _ in range(50):
            decided = rng.choice([0, 50, 100], 6)
            right = np.minimum(decided, rng.choice([0, 49, 50, 98, 99, 100], 6))
            parameters = np.sort(rng.random(6))[:: -1 if harder == "smaller" else 1]
            ladder = [
                synthetic_run.rung(float(p), 0, "misses", True) | {"decided": int(d), "right": int(r)}
                for p, d, r in zip(parameters, decided, right, strict=True)
            ]
            rungs = pd.DataFrame(ladder).assign(level=range(6), key="x")
            rows = breaks.derive(pd.DataFrame([told | {"parameters": "{}", "answers": True}]), rungs)
            found = breaks.verdicts(rows)["breaks_at"].iloc[0]
            assert (None if np.isnan(found) else found) == first_break(ladder, harder)


def test_devices_that_differ_have_tables_of_their_own(tmp_path: Path) -> None:
    cells = [family_cell("ray_march", "grazing", device, "float32") for device in ("opencl:intel", "opencl:pocl")]
    rungs = load.load(tiny_run(tmp_path / "same", *cells))
    same = breaks.derive(rungs.families, rungs.rungs)
    cells[1]["rungs"][0]["max_error"] = 7.0
    cells[1]["rungs"][0]["worst_ratio"] = 1e6
    worse = load.load(tiny_run(tmp_path / "worse", *cells))
    (together,) = breaks.by_device(breaks.derive(worse.families, worse.rungs)).values()
    assert together["worst_ratio"].iloc[0] == 1e6 and len(together) == len(same) // 2, "the worst error of any device"
    cells[1]["rungs"][0] |= {"right": 89, "misses": 1}
    other = tiny_run(tmp_path / "other", *cells)
    run, document = reported(other)
    assert list(breaks.by_device(breaks.derive(run.families, run.rungs))) == ["opencl:intel", "opencl:pocl"]
    (section,) = [section for section in document.sections if section.title == BREAKS]
    shown, details = printed(section.blocks), printed(section.details)
    assert "The devices differ (opencl:intel and opencl:pocl): here is opencl:intel" in shown
    assert "float32 on opencl:intel: rungs" in shown and "opencl:pocl: rungs" not in shown
    assert "float32 on opencl:pocl: rungs" in details
    assert "float32 on opencl:intel." in details and "float32 on opencl:pocl." in details


def test_the_matrix_shows_which_share_of_each_ladder_holds_and_what_breaks_it(hard: Path) -> None:
    _, document = reported(hard)
    (section,) = [section for section in document.sections if section.title == BREAKS]
    single, double = [block for block in section.blocks if isinstance(block, content.Matrix)]
    assert single.title.startswith("float32 on all devices") and double.title.startswith("float64 on all devices")
    place = {column: i for i, column in enumerate(double.columns)}
    assert set(place) == {"Newton, ε = 1e−6", "Ray march", "Odd#"}, "of Newton's two variants the one that holds"
    lines = dict(double.rows)
    march, odd = lines["Grazing #rays_ $*"][place["Ray march"]], lines["Thin tori"][place["Odd#"]]
    assert (march.text, odd.text) == ("5/7", "0/4")
    assert march.note.endswith("breaks at 10⁻⁶ (distance from tangency, scene units), by rays given up")
    assert odd.note.endswith("holds 0 of 4 rungs; breaks at 10 (R/r), by wrong roots")
    assert {square.text for square in lines["Double roots"]} == {wording.NONE}
    newton = [lines[title][place["Newton, ε = 1e−6"]] for title in ("Grazing #rays_ $*", "Thin tori")]
    assert [square.text for square in newton] == ["all", "all"]
    assert newton[0].color == shades.shade(0.0) != march.color != odd.color == shades.shade(1.0)
    assert list(lines)[-1] == "Double roots", "the families that most hold are on the top"


def test_the_colours_of_matrices_keep_their_order_in_greyscale() -> None:
    shown = [to_rgb(shades.shade(badness)) for badness in np.linspace(0.0, 1.0, 11)]
    grey = [0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in shown]
    assert grey == sorted(grey) and grey[0] < 0.25 and grey[-1] > 0.7


def test_a_run_of_families_alone_makes_a_report(hard: Path) -> None:
    run, document = reported(hard)
    assert run.frame.empty and len(run.not_run) == 1 and len(run.unreadable) == 1
    summary = printed(document.summary.blocks)
    told = "the most families of hard rays are held by Newton, ε = 1e−6 in float32 (2 of 2)"
    assert told in summary
    by_title = {section.title: printed((*section.blocks, *section.details)) for section in document.sections}
    assert list(by_title) == [BREAKS, last_page.TITLE]
    page = by_title[BREAKS]
    assert "All devices agree on every count of every rung they ran: opencl:intel and opencl:pocl" in page
    assert "Thin tori | Ray march | holds | – | 360 | 100 %" in page
    assert " | Newton, ε = 0.001 | 100 | misses | 360 | 83.3 % | 60 | 0 | 0 | 0 | " in page
    assert "Double roots | Ray march | nothing decided | – | 0 | – | – | – | – | – | – | 288 | 120" in page
    for facts in synthetic_run.FAMILIES.values():
        assert page.count(facts["why"]) == 2, "in the table and beside its ladder"
    assert "In float32 none of these rays can be decided" in page
    assert "1 | skipped | no *interval* extension" in by_title[last_page.TITLE]
    assert "family: Grazing #rays_ $*" in by_title[last_page.TITLE]

    folder = report.build(hard).parent
    made = {"report.pdf", "report.html", "results.csv", "results.parquet", "stability.csv"}
    assert {path.name for path in folder.iterdir()} == made
    csv = pd.read_csv(folder / "stability.csv")
    cells = [json.loads((hard / "cells" / f"{key}.json").read_text()) for key in csv["key"].unique()]
    assert len(csv) == sum(len(cell["rungs"]) for cell in cells) == len(run.rungs)
    first = csv[csv["key"] == cells[-1]["key"]].sort_values("level")
    assert first["parameter"].tolist() == [rung["parameter"] for rung in cells[-1]["rungs"]]
    assert first["right"].tolist() == [rung["right"] for rung in cells[-1]["rungs"]]
    assert pd.read_csv(folder / "results.csv").empty


def test_a_run_of_families_alone_says_what_its_methods_are(tmp_path: Path) -> None:
    folder = stability_run(tmp_path / "stability")
    told = json.loads((folder / "plan.json").read_text()) | {
        "methods": {"bernstein": card(find_methods().get("bernstein"))}
    }
    (folder / "plan.json").write_text(json.dumps(told))
    _, told = reported(folder)
    page = next(printed(section.details) for section in told.sections if section.title == "Methods")
    assert f"• no false hit: {CLAIMS['no_false_hit']}. Not counted in this run; `firsthit conform" in page


def test_families_without_a_result_still_make_a_report(tmp_path: Path) -> None:
    skipped = family_cell("ray_march", "grazing", "opencl:intel", "float32")
    skipped |= {"status": "skipped", "reason": "no such thing", "rungs": None}
    folder = tiny_run(tmp_path / "run", skipped)
    _, told = reported(folder)
    assert [section.title for section in told.sections] == [
        last_page.TITLE,
    ]
    made = tmp_path / "made"
    made.mkdir()
    (made / "stability.csv").write_text("from an earlier plan")
    report.build(folder, made)
    assert not (made / "stability.csv").exists()


def test_a_method_that_answers_nothing_breaks_nowhere(tmp_path: Path) -> None:
    null = family_cell("null", "grazing", "opencl:intel", "float32")
    run = load.load(tiny_run(tmp_path / "run", null, family_cell("ray_march", "grazing", "opencl:intel", "float32")))
    assert breaks.derive(run.families, run.rungs)["method"].unique().tolist() == ["ray_march"]


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda c: c["rungs"][1].pop("decided"), "rungs[].decided is missing"),
        (lambda c: c["rungs"].append(7), "rungs[] is no object: 7"),
        (lambda c: c.update(rungs="many"), "rungs is no list: 'many'"),
        (lambda c: c.update(family="unheard_of"), "the plan says nothing of its family, 'unheard_of'"),
    ],
)
def test_a_foreign_ladder_is_listed(tmp_path: Path, change: Callable[[dict[str, Any]], Any], problem: str) -> None:
    good, bad = (family_cell("ray_march", family, "opencl:intel", "float32") for family in ("grazing", "thin_torus"))
    folder = tiny_run(tmp_path / "run", good, bad)
    change(bad)
    (folder / "cells" / f"{bad['key']}.json").write_text(json.dumps(bad))
    run = load.load(folder)
    assert run.families["key"].tolist() == run.rungs["key"].unique().tolist() == [good["key"]]
    assert run.unreadable[0].problem.startswith(problem)
