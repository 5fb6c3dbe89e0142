"""The page of a method, its module docstring: which parts it has, and its tables as a report's card shows them."""

from __future__ import annotations

import ast
import re

import pandas as pd
import pytest

from harness.plugins import find_methods
from harness.running.cards import card
from reports.parts import method_cards

PLUGINS = find_methods().plugins
PAGE = """A title.

What it does,
in a paragraph.

**Source** somebody, somewhere.

**Theory** A sentence
over two lines:
- a point
  on two lines
- another point

A paragraph behind the points.

**What was tried** On one device.

    what was tried     measured        kept
    -----------------  --------------  ----
    blocks of 8 steps  5.8 times       yes
      and their sum    as fast
    blocks of 4                        no

Behind the table.
"""


def written(folder, page):
    (folder / "method.py").write_text(f'"""{page}"""\nfrom harness.contract import Method\n')
    (folder / "kernel.glsl").write_text("")
    return card(type(PLUGINS["null"])(PLUGINS["null"].method, folder))


def test_a_card_holds_the_pages_parts_and_its_tables(tmp_path):
    told = written(tmp_path, PAGE)
    assert told["title"] == "A title."
    assert told["summary"] == "What it does, in a paragraph."
    assert told["source"] == "somebody, somewhere."
    points = "A sentence over two lines:\n- a point on two lines\n- another point\nA paragraph behind the points."
    assert told["doc"] == {"Theory": points, "What was tried": "On one device.\nBehind the table."}
    (table,) = told["tables"]
    assert table["part"] == "What was tried"
    assert table["header"] == ["what was tried", "measured", "kept"]
    assert table["rows"] == [
        ["blocks of 8 steps and their sum", "5.8 times as fast", "yes"],
        ["blocks of 4", "", "no"],
    ]


def test_a_page_without_parts_is_a_title(tmp_path):
    told = written(tmp_path, "A title.")
    assert (told["title"], told["summary"], told["doc"], told["tables"]) == ("A title.", "", {}, [])
    assert told["source"] == PLUGINS["null"].method.source


@pytest.mark.parametrize("name", sorted(PLUGINS))
def test_every_page_says_what_the_method_does_its_theory_and_what_was_changed(name):
    told = card(PLUGINS[name])
    assert told["title"].endswith(".")
    assert told["summary"] or name == "null"
    assert {"Theory", "Changes against the paper"} <= set(told["doc"])
    assert set(told["doc"]) <= {
        "Theory",
        "What is promised",
        "Changes against the paper",
        "Evaluations counted",
        "Accuracy",
        "What true bounds cost",
        "Speed",
        "What was tried",
    }


@pytest.mark.parametrize("name", sorted(PLUGINS))
def test_what_was_tried_is_a_table_that_says_what_was_kept(name):
    tables = [table for table in card(PLUGINS[name])["tables"] if table["part"] == "What was tried"]
    assert bool(tables) == ("What was tried" in card(PLUGINS[name])["doc"])
    for table in tables:
        assert table["header"][-1] == "kept"
        assert {row[-1] for row in table["rows"]} <= {"yes", "no", "-"}
        assert all(row[0] for row in table["rows"])


@pytest.mark.parametrize("name", sorted(PLUGINS))
def test_cells_stand_under_their_columns(name):
    """A cell that is shifted would be cut in two by the column's edge."""
    text = ast.get_docstring(ast.parse((PLUGINS[name].folder / "method.py").read_text(encoding="utf-8"))) or ""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        if not re.fullmatch(r" *--+(?: +--+)+", line):
            continue
        dashes = list(re.finditer("-+", line))
        rows = lines[number - 1 :]
        for row in rows[: rows.index("")] if "" in rows else rows:
            for edge in dashes[1:]:
                assert not row[edge.start() - 2 : edge.start()].strip(), row
            for edge in dashes:
                cell = row[edge.start() : edge.end()]
                assert not cell.strip() or cell[0] != " " or edge is dashes[0], row


def test_a_reports_card_shows_the_table_with_what_it_was_measured_on(tmp_path):
    told = written(tmp_path, PAGE)
    told["label"] = "Mine"
    told["doc"] = {"Theory": "A sentence.", "What was tried": "On one device."}
    rows = pd.DataFrame({"origin": ["nearest"], "parameters": [None]})
    page, tried = method_cards._card("mine", told, rows, [])
    assert ("what it does", "What it does, in a paragraph.") in page.rows
    assert ("theory", "A sentence.") in page.rows
    assert not [row for row in page.rows if row[0] == "what was tried"]
    assert (tried.title, tried.caption) == ("Mine: what was tried.", "On one device.")
    assert [column.title for column in tried.columns] == ["what was tried", "measured", "kept"]
    assert tried.rows[0] == ("blocks of 8 steps and their sum", "5.8 times as fast", "yes")
    older = {name: value for name, value in told.items() if name not in ("summary", "tables")}
    (page,) = method_cards._card("mine", older, rows, [])
    assert ("what was tried", "On one device.") in page.rows
