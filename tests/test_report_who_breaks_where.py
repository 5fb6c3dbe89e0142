"""The report's page that says who breaks where, on rows made up for it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from harness.contract import digest
from reports import content, parts
from reports.analysis import breaks, derive
from reports.material import Material
from reports.parts import who_breaks_where
from reports.reading import load
from reports.reading.arrays import Shelf
from tests.synthetic_run import cell, printed, tiny_run

TITLE = "Who breaks where"
DEVICE = "opencl:intel"


def row(
    variant: str, surface: str, group: str | None, wrong: dict[str, int] | None, undecided: int = 0
) -> dict[str, Any]:
    """A row of a method on a surface; `wrong` None is a refusal."""
    made = cell(variant, "torus", DEVICE, "float32")
    slot = f"{variant} {surface}"
    made |= {"surface": surface, "surface_title": surface.title(), "comparison": surface, "surface_group": group}
    made |= {"slot": slot, "key": digest(slot), "arrays": None}
    if wrong is None:
        made |= dict.fromkeys(("time", "build", "accuracy", "operations"))
        return made | {"status": "skipped", "reason": f"the method refuses the surface {surface}: degree 8: no"}
    counts = {"misses": 0, "false_hits": 0, "exhausted": 0, "wrong_root": 0, "invalid": 0} | wrong
    made["accuracy"] |= counts | {"judged": 1000, "undecided": undecided}
    made["accuracy"]["truth_misses"] -= undecided
    return made


def page(folder: Path) -> content.Section | None:
    run = load.load(folder)
    frame = derive.derive(run.frame, run.plan.peaks)
    found = who_breaks_where.sections(Material(run, frame, breaks.derive(run.families, run.rungs), Shelf(run.folders)))
    assert all(section.title == TITLE for section in found)
    return found[0] if found else None


def every(section: content.Section) -> tuple[content.Block, ...]:
    return (*section.blocks, *section.details)


def table(section: content.Section, title: str) -> dict[str, tuple[Any, ...]]:
    """The lines of the table whose title begins so, by their first cell."""
    (found,) = [b for b in every(section) if isinstance(b, content.Table) and b.title.startswith(title)]
    return {str(line[0]): line for line in found.rows}


def matrix(section: content.Section, title: str) -> dict[str, list[str]]:
    """The texts of the squares of the matrix whose title begins so, by their line's heading."""
    (found,) = [b for b in every(section) if isinstance(b, content.Matrix) and b.title.startswith(title)]
    return {heading: [square.text for square in squares] for heading, squares in found.rows}


def gallery(folder: Path) -> Path:
    rows = [
        row("ray_march", "goursat", "nodal", {}),
        row("ray_march", "desmic", "nodal", {"misses": 20, "exhausted": 5}),
        row("ray_march", "gyroid", "minimal", {"exhausted": 1}, undecided=9),
        row("newton[EPSILON=0.001]", "goursat", "nodal", {}),
        row("newton[EPSILON=0.001]", "desmic", "nodal", None),
        row("newton[EPSILON=0.001]", "gyroid", "minimal", {}, undecided=9),
        row("null", "goursat", "nodal", {}),
    ]
    made = tiny_run(folder, *rows)
    document = json.loads((made / "plan.json").read_text())
    document["methods"] = {"ray_march": {"claims": ["no_missed_root"]}, "newton": {"claims": []}}
    (made / "plan.json").write_text(json.dumps(document))
    return made


def test_groups_count_the_surfaces_that_are_right(tmp_path: Path) -> None:
    section = page(gallery(tmp_path / "run"))
    assert section is not None
    groups = matrix(section, "On how many surfaces")
    assert groups == {"Nodal, 2": ["1/2", "1/1"], "Minimal, 1": ["0/1", "1/1"]}


def test_the_matrix_marks_shares_kinds_and_refusals(tmp_path: Path) -> None:
    section = page(gallery(tmp_path / "run"))
    assert section is not None
    marks = matrix(section, "Every surface")
    assert marks["Nodal"] == [], "a heading over the lines of its group"
    assert marks["Goursat"] == ["✓", "✓"]
    assert marks["Desmic"] == ["2.5 m", "·"]
    assert marks["Gyroid"] == ["0.1 e", "✓"]
    wrong = matrix(section, "The surfaces on which a method is wrong")
    assert list(wrong) == ["Nodal", "Desmic", "Minimal", "Gyroid"], "those that all draw rightly are details"
    refused = table(section, "Which surfaces")
    assert refused["Newton"] == ("Newton", "its degree: no", 1, "nodal 1")


def test_words_say_where_each_breaks_and_which_claim_is_broken(tmp_path: Path) -> None:
    section = page(gallery(tmp_path / "run"))
    assert section is not None
    told = table(section, "Where each method")
    assert told["Ray march"][1:3] == (3, 2)
    assert told["Ray march"][3].startswith("minimal 1 of 1 (Gyroid 0.1 %, rays given up); nodal 1 of 2 (Desmic 2.5 %")
    assert told["Newton, ε = 0.001"][3].startswith("nowhere")
    text = printed(section.blocks)
    assert "Ray march claims no missed root, and misses of clear rays break it: Ray march on Desmic." in text
    assert "Newton claims" not in text
    assert (
        "Newton, ε = 0.001 is right on every ray of most: 2 of the 2 it takes; Ray march is wrong on most: 2 of 3"
        in text
    )
    assert "more than 0.1 % of the rays undecided on Gyroid" in printed(section.details)


def test_the_catalog_alone_has_the_page_where_it_is_many_surfaces(tmp_path: Path) -> None:
    few = [row("ray_march", f"s{i}", "catalog", {}) for i in range(3)]
    assert page(tiny_run(tmp_path / "few", *few)) is None
    many = [row("ray_march", f"s{i}", "catalog", {}) for i in range(who_breaks_where.MANY)]
    section = page(tiny_run(tmp_path / "many", *many))
    assert section is not None
    assert matrix(section, "On how many surfaces") == {f"Catalog, {len(many)}": [f"{len(many)}/{len(many)}"]}


def test_rows_of_older_versions_without_groups_make_no_page(tmp_path: Path) -> None:
    old = row("ray_march", "torus", None, {})
    del old["surface_group"]
    assert page(tiny_run(tmp_path / "run", old)) is None


def test_it_stands_before_the_winners():
    parts_ = [part.__name__.rpartition(".")[2] for part in parts.found(parts.__name__, parts.__path__)]
    assert parts_.index("who_breaks_where") < parts_.index("winners")
