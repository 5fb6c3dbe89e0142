"""Impossible answers, and hits that nobody decided, in a report."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pandas as pd

from reports.analysis import breaks, derive
from reports.claims import Outcome, picks, szente_fit
from reports.content import Block, Document, Table
from reports.drawing import surface_tables
from reports.parts import hard_rays, method_cards
from reports.reading import load

from .synthetic_run import cell, family_cell, reported, tiny_run
from .test_claims import evidence, planted


def made(**accuracy: Any) -> dict[str, Any]:
    found = cell("ray_march", "torus", "opencl:intel", "float32") | {"arrays": None}
    clean = dict.fromkeys(("misses", "false_hits", "exhausted", "wrong_root", "invalid"), 0)
    found["accuracy"] |= clean | {f"grazing_{name}": 0 for name in clean} | accuracy
    return found


def frame_of(folder: Path, *cells: dict[str, Any]) -> pd.DataFrame:
    return derive.derive(load.load(tiny_run(folder, *cells)).frame)


def blocks(document: Document) -> list[Block]:
    return [block for section in document.sections for block in (*section.blocks, *section.details)]


def heads(table: Any) -> list[str]:
    return [column.title for column in table.columns]


def test_invalid_answers_are_wrong_rays_and_have_a_column_where_there_are_any(tmp_path: Path) -> None:
    clean, bad = frame_of(tmp_path / "a", made()), frame_of(tmp_path / "b", made(invalid=7, grazing_invalid=2))
    assert (clean["wrong_rays"].iloc[0], bad["wrong_rays"].iloc[0], bad["grazing_wrong_rays"].iloc[0]) == (0, 7, 2)
    assert not derive.all_right(bad).any() and not bad["front"].any()
    assert "in-\nvalid" not in heads(surface_tables.results_table(clean))
    table = surface_tables.results_table(bad)
    assert table.rows[0][heads(table).index("in-\nvalid")] == 7
    _, document = reported(tmp_path / "b")
    assert any("in-\nvalid" in heads(block) for block in blocks(document) if isinstance(block, Table))


def test_rows_of_before_invalid_was_counted_still_load(tmp_path: Path) -> None:
    old = made(misses=3)
    del old["accuracy"]["invalid"], old["accuracy"]["grazing_invalid"]
    frame = frame_of(tmp_path / "a", old)
    assert frame["wrong_rays"].iloc[0] == 3
    assert "in-\nvalid" not in heads(surface_tables.results_table(frame))


def test_an_invalid_answer_breaks_what_a_method_claims_of_the_ray(tmp_path: Path) -> None:
    frame = frame_of(tmp_path / "a", made(invalid=7, grazing_invalid=2))
    for name, count in (("no_missed_root", 9), ("conservative_bound", 7), ("no_false_hit", 7)):
        assert f"Broken by {count} of" in method_cards._claims("ray_march", [name], frame), name


def test_undecided_hits_are_told_under_the_results(tmp_path: Path) -> None:
    assert "undecided" not in surface_tables.results_table(frame_of(tmp_path / "a", made())).caption
    undecided = made(undecided=3, truth_misses=made()["accuracy"]["truth_misses"] - 3)
    caption = surface_tables.results_table(frame_of(tmp_path / "b", undecided)).caption
    assert "The oracle left 3 hits undecided" in caption


def test_invalid_answers_to_hard_rays_have_a_column(tmp_path: Path) -> None:
    hard = family_cell("ray_march", "grazing", "opencl:intel", "float32")
    for rung in hard["rungs"]:
        rung |= {"right": rung["right"] - 5, "invalid": 5}
    run = load.load(tiny_run(tmp_path / "a", hard))
    verdicts = breaks.verdicts(breaks.derive(run.families, run.rungs))
    table = hard_rays.table(verdicts, run.plan.facts, "x")
    assert table.rows[0][heads(table).index("in-\nvalid")] == 5 * len(hard["rungs"])


def test_a_row_that_was_never_held_against_the_oracle_confirms_no_claim(tmp_path: Path) -> None:
    rows = [planted(picks.FIT, surface, 1.0) for surface in picks.TABLE_4]
    verdict = szente_fit._no_artifacts(evidence(tmp_path / "a", *rows))
    assert verdict is not None and verdict.outcome is Outcome.CONFIRMED
    for row in rows:
        row["accuracy"] = None
    assert szente_fit._no_artifacts(evidence(tmp_path / "b", *rows)) is None
