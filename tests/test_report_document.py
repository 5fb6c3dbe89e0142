"""How a document names figures, heads columns and writes numbers; no run is needed for it."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
import typst

from reports import content, wording
from reports.drawing import plots
from reports.rendering import document


def test_one_name_stands_for_one_figure(tmp_path: Path) -> None:
    """Two galleries with scales of their own have keys of their own; one name for both would show the last for all."""
    keys = [plots.error_legend(*scale) for scale in ((-7, -3), (-4, 0), (-4, 0))]
    shown = content.Section("", tuple(content.Gallery((), "", key) for key in keys))
    document._section(shown, shown.blocks, tmp_path)
    assert len(list(tmp_path.iterdir())) == 2
    clash = content.Section("", (content.Figure("a", "<svg/>", ""), content.Figure("a", "<svg></svg>", "")))
    with pytest.raises(ValueError, match="two figures of one report are named a"):
        document._section(clash, clash.blocks, tmp_path)


def test_repeated_group_values_are_printed_once(tmp_path: Path) -> None:
    columns = tuple(content.Column(title) for title in "abc")
    table = content.Table(columns, [("x", "y", 1), ("x", "y", 2), ("x", "z", 3), ("w", "z", 4)], "T", group=2)
    made = document._block(table, tmp_path)
    assert [row["cells"] for row in made["rows"]] == [["x", "y", "1"], ["", "", "2"], ["", "z", "3"], ["w", "z", "4"]]
    assert [row["opens"] for row in made["rows"]] == [True, False, True, True]
    assert made["headings"] == [{"title": "", "span": 3}]


def test_a_section_stands_on_one_page_where_that_leaves_no_page_empty(tmp_path: Path) -> None:
    def section(lines: int) -> content.Section:
        return content.Section("S", (content.Table((content.Column("a"),), [("x",)] * lines, "T"),))

    summary = content.Section("Summary", (content.Text("…"),))
    made = content.Document("T", "", summary, tuple(section(lines) for lines in (30, 40, 5, 60)))
    document.write_pdf(made, tmp_path / "pdf", tmp_path / "report.pdf", "2026-01-01")
    settings = document._settings(tmp_path / "pdf")
    begun = json.loads(typst.query(tmp_path / "pdf" / "report.typ", "<section>", **settings))
    assert [mark["value"] for mark in begun] == [2, 3, 3, 4]


def test_neighbours_share_their_heading(tmp_path: Path) -> None:
    columns = (content.Column("a"), content.Column("b", over="x"), content.Column("c", over="x"), content.Column("d"))
    headings = document._block(content.Table(columns, [], "T"), tmp_path)["headings"]
    assert headings == [{"title": "", "span": 1}, {"title": "x", "span": 2}, {"title": "", "span": 1}]


@pytest.mark.parametrize(
    ("show", "value", "shown"),
    [
        (wording.number, 0.012345, "0.0123"),
        (wording.number, 9.996, "10.0"),
        (wording.number, 1234.5, "1,234"),
        (wording.number, float("nan"), "–"),
        (wording.error, 1.26e-7, "1.3e−7"),
        (wording.error, 0.0, "0"),
        (wording.count, pd.NA, "–"),
        (wording.factor, 7.04, "7.04×"),
        (wording.share, 0.005, "0.5 %"),
        (wording.share, 0.12, "12 %"),
        (wording.portion, 0.9999, "99.9 %"),
        (wording.portion, 1.0, "100 %"),
        (wording.short, 1.0, "1.0"),
        (wording.short, 0.0123, "0.012"),
        (wording.short, 56.7, "57"),
        (wording.short, 99.6, "100"),
        (wording.short, 1234.0, "1,234"),
        (wording.short, 0.001, "1.0e−3"),
        (wording.short, 12345.0, "1.2e4"),
        (wording.short, None, "–"),
        (wording.level, 1e-6, "10⁻⁶"),
        (wording.level, 0.01, "0.01"),
        (wording.level, 3.5, "3.5"),
        (wording.level, 1792.0, "1792"),
        (wording.level, 1e30, "10³⁰"),
        (wording.level, 2.0**-20, "9.5e−7"),
        (wording.level, 0.0, "0"),
        (wording.listed, ["a", "b", "c"], "a, b and c"),
        (wording.listed, ["a"], "a"),
    ],
)
def test_numbers_as_people_read_them(show: Callable[[Any], str], value: Any, shown: str) -> None:
    assert show(value) == shown
