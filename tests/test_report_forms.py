"""The report's page on how a formula is written."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from harness.contract import digest
from harness.studies import form_ranges
from reports import content
from reports.analysis.surface_names import PRINTED
from tests.synthetic_run import cell, printed, reported, sampled, tiny_run

TITLE = "How a formula is written"


def written(form: str, times_printed: float, seed: int, rounds: int = 20, wrong: int = 0) -> dict[str, Any]:
    """A row of the torus in a form, `times_printed` as slow as the row as printed, but for a hundredth of noise."""
    rng = np.random.default_rng(seed)
    made = cell("ray_march", "torus", "opencl:intel", "float32")
    name = f"torus:{form}" if form else "torus"
    slot = f"ray_march {name}"
    load = np.random.default_rng(0).lognormal(sigma=0.4, size=rounds)
    samples = (times_printed * load * (1.0 + 0.01 * rng.standard_normal(rounds))).tolist()
    made |= {"surface": name, "surface_title": f"Torus, {form}" if form else "Torus", "comparison": name}
    made |= {"slot": slot, "key": digest(slot), "arrays": None}
    made["time"]["session"] = "one"
    made["accuracy"] |= {"misses": wrong, "false_hits": 0, "exhausted": 0, "wrong_root": 0}
    return sampled(made, samples)


def page(folder: Path) -> content.Section:
    (section,) = [s for s in reported(folder)[1].sections if s.title == TITLE]
    return section


def lines(section: content.Section, title: str) -> dict[str, tuple[Any, ...]]:
    """The lines of a table by form."""
    (table,) = [b for b in section.details if isinstance(b, content.Table) and b.title == title]
    return {str(row[1]): row for row in table.rows}


def test_forms_are_held_against_the_printed_one_round_by_round(tmp_path: Path) -> None:
    rows = [written("", 1.0, 1), written("nested", 0.5, 2, wrong=7), written("expanded", 1.0, 3)]
    section = page(tiny_run(tmp_path / "run", *rows, written("few", 2.0, 4, rounds=4)))
    cost = lines(section, "What a form costs.")
    assert cost[PRINTED][3].endswith(" ms")
    assert float(cost["nested"][3].rstrip("×")) == pytest.approx(0.5, rel=0.03)
    assert cost["expanded"][3] == "even"
    assert cost["few"][3].endswith("× ?"), "fewer rounds than tell anything apart"
    assert [row[0] for row in cost.values()] == ["Torus"] * 4
    (matrix,) = [b for b in section.blocks if isinstance(b, content.Matrix)]
    squares = {heading: square.text for heading, (square,) in matrix.rows}
    assert squares["Torus, nested"] == f"{cost['nested'][3]}, 7 wrong" and squares["Torus, expanded"] == "even"
    worth = lines(section, "What a form's answers are worth.")
    assert worth["nested"][2] == 7 and worth[PRINTED][2] == 0


def test_a_failed_form_is_left_out_and_costs_no_page_of_others(tmp_path: Path) -> None:
    failed = written("nested", 0.5, 2) | {"status": "failed", "reason": "no", "time": None, "accuracy": None}
    _, report = reported(tiny_run(tmp_path / "one", written("", 1.0, 1), failed))
    assert TITLE not in [section.title for section in report.sections]
    two = page(tiny_run(tmp_path / "two", written("", 1.0, 1), failed, written("expanded", 2.0, 3)))
    assert list(lines(two, "What a form costs.")) == [PRINTED, "expanded"]


def test_one_form_alone_makes_no_page_and_stays_in_the_lists(tmp_path: Path) -> None:
    _, report = reported(tiny_run(tmp_path / "run", written("nested", 0.5, 2)))
    titles = [section.title for section in report.sections]
    assert TITLE not in titles and "Torus, nested" in titles


def test_further_forms_have_the_page_alone(tmp_path: Path) -> None:
    _, report = reported(tiny_run(tmp_path / "run", written("", 1.0, 1), written("nested", 0.5, 2)))
    titles = [section.title for section in report.sections]
    assert TITLE in titles and "Torus" in titles and "Torus, nested" not in titles


def test_the_study_of_ranges_is_tabled_and_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(form_ranges, "BASES", ("tangle",))
    folder = tiny_run(tmp_path / "run", written("", 1.0, 1))
    document = json.loads((folder / "plan.json").read_text())
    document["studies"] = [{"study": "form_ranges", "key": "abc"}]
    (folder / "plan.json").write_text(json.dumps(document))
    (folder / "studies").mkdir()
    stored = {"format": 1, "study": "form_ranges", "key": "abc", "rows": form_ranges.compute()}
    (folder / "studies" / "abc.json").write_text(json.dumps(stored))
    section = page(folder)
    made = lines(section, "What a form makes of f's range.")
    assert list(made) == [PRINTED, "nested", "squares"]
    assert made["squares"][3:6] == pytest.approx((1.0, 1.0, 1.0), abs=1e-3)
    assert "tangle 1.79× as printed and 1.00× squares." in printed(section.blocks)
    (figure,) = [b for b in section.blocks if isinstance(b, content.Figure)]
    assert all(f">{form}<" in figure.svg for form in made)


def test_an_extension_holds_the_range_and_is_exact_where_each_variable_stands_once() -> None:
    rows = form_ranges.compute()
    assert {row["surface"] for row in rows} == set(form_ranges.BASES)
    assert all(row["factor"] >= 1.0 - 1e-9 for row in rows)
    smallest = {row["form"]: row["factor"] for row in rows if row["side"] == 0.5 ** max(form_ranges.HALVINGS)}
    assert smallest["tangle:squares"] < 1.0 + 1e-3
    assert smallest["tangle"] > 1.5 and smallest["chmutov"] > 3.0 * smallest["chmutov:nested"]
