"""The report's sections on the papers: the checklist of claims, tables and figures beside ours, our own front."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from reports import content, published
from reports.claims import figures, picks
from reports.parts import checklist
from reports.parts.papers import szente_tables
from tests.synthetic_run import printed, reported, tiny_run

from .test_claims import ROOT, planted


def test_beamcastings_tables_stand_on_the_printed_descent_beside_ours(tmp_path: Path) -> None:
    times = ((picks.UNIFORM, 6.0, 12.0), (picks.ADAPTIVE, 4.0, 6.0), (picks.ADAPTIVE_OURS, 2.0, 3.0))
    cells = [planted(pick, "sphere", ms, evaluations_mean=spent) for pick, ms, spent in times]
    for made in cells:
        made["size"] = 512
    _, report = reported(tiny_run(tmp_path / "run", *cells))
    told = next(printed(s.blocks) for s in report.sections if s.title == "beamcasting, Tables I and II")
    line = next(line for line in told.splitlines() if line.startswith("512 | 1 | sphere | 167 | 860"))
    assert line.endswith("| 250 | 1,120 | 1.50× | 1.30× | 1.15× | 2.00× | 3.00×")
    assert "perspective frustum" in told and "nothing is shaded" in told


def test_the_checklist_and_the_tables_stand_in_the_report(tmp_path: Path) -> None:
    cells = [planted(pick, "sphere", ms) for pick, ms in ((picks.MARCH, 38.4), (picks.FIT, 1.0), (picks.NO_EFT, 0.61))]
    cells += [planted(pick, "sphere", ms) for pick, ms in ((picks.MARCH_OURS, 28.0), (picks.FIT_OURS, 0.4))]
    cells += [planted(pick, "sphere", 0.5) for pick in picks.FIT_CHANGES[:1]]
    cells += [planted(pick, "flirt", ms) for pick, ms in ((picks.CONTROL, 3.5), (picks.LU, 2.0), (picks.MARCH, 23.2))]
    _, report = reported(tiny_run(tmp_path / "run", *cells))
    by_title = {section.title: printed(section.blocks) for section in report.sections}
    assert "23.6 times as fast as ray marching, in the mean. | confirmed" in by_title["The papers' claims"]
    line = next(line for line in by_title["szente, Table 4"].splitlines() if line.startswith("sphere"))
    assert line.endswith("38.4× | 38.4× | 1.00× | 28.0 | 28.0× | 0.400 | 70.0×"), (
        "ours, the paper's, their ratio; our best"
    )
    assert "| 39 | 39 |" in line, "EFT's share of the time, ours and the paper's"
    line = next(
        line for line in by_title["szente, what our changes are worth"].splitlines() if "Newton's steps" in line
    )
    assert "| 2.00× | 2.00× | 2.00× |" in line
    line = next(line for line in by_title["szente, Table 5"].splitlines() if line.startswith("flirt"))
    assert "1.75× | 1.75× | 1.00× | 11.6× | 11.6×" in line


def test_figures_of_the_papers_name_configs_and_surfaces_that_exist() -> None:
    import surfaces

    for figure in figures.FIGURES:
        assert (ROOT / "configs" / figure.config).is_file()
        assert set(figure.surfaces) <= set(surfaces.names())
    for name in szente_tables._NAMES:
        assert name in surfaces.names()
    assert checklist.ORDER < 100
    assert published.table("szente_table4_runtime").number("speedup", surface="16-Ball") == 3.3
    assert published.table("szente_table4_runtime").number("speedup", surface="Flirt") is None


def test_the_levels_of_beamcastings_figure_1_add_up_to_the_picture(tmp_path: Path) -> None:
    made = planted(picks.ADAPTIVE, "octdong", 1.0) | {"size": 8, "casts": "quadtree"}
    made["arrays"] = f"arrays/{made['key']}.npz"
    folder = tiny_run(tmp_path / "run", made)
    told = json.loads((folder / "plan.json").read_text()) | {"name": "beamcasting-fig1"}
    (folder / "plan.json").write_text(json.dumps(told))
    (folder / "arrays").mkdir()
    level = np.full((8, 8), 3, np.uint8)
    level[:4] = 1
    status = np.zeros((8, 8), np.uint8)
    status[6:] = 1
    blank = {"truth": status, "wrong": np.zeros((8, 8), np.uint8), "grazing": np.zeros((8, 8), bool)}
    blank |= dict.fromkeys(("error", "shade"), np.zeros((8, 8), np.float32))
    np.savez_compressed(folder / made["arrays"], level=level, status=status, **blank)
    _, report = reported(folder)
    (section,) = [section for section in report.sections if section.title == "beamcasting, Figure 1"]
    (table,) = [block for block in section.blocks if isinstance(block, content.Table)]
    assert table.rows == [(8, 1, 4, 0.5), (8, 2, 2, 0.0), (8, 3, 1, 0.25), (8, "surface", None, 0.25)]
    (gallery,) = [block for block in section.blocks if isinstance(block, content.Gallery)]
    assert [panel.title for panel in gallery.panels] == ["octdong, 8 × 8"]
