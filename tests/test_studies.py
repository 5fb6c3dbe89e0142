"""Studies: what they compute, and that a run stores them once."""

from __future__ import annotations

import numpy as np
import pytest

import surfaces
from harness import studies
from harness.cli import main
from harness.contract import MeshRecipe
from harness.scenes import meshes
from harness.studies import condition_numbers, extrema_bounds, mesh_errors, torus_along_rays
from reports import published


def test_condition_numbers_are_table_1_to_every_printed_digit():
    table = published.table("szente_table1_condition")
    for row in condition_numbers.compute():
        printed = [r for r in table.rows if r["basis"] == row["basis"]]
        if printed:
            assert f"{row['condition']:.2f}" == printed[0][f"degree_{row['degree']}"]


def test_extrema_and_bounds_of_random_functions():
    rng = np.random.default_rng(7)
    t = np.linspace(0.0, 1.0, 100_001)
    for n in (2, 3, 5, 9):
        for _ in range(20):
            b = rng.uniform(-1.0, 1.0, n + 1)
            values = sum(extrema_bounds.math.comb(n, j) * b[j] * t**j * (1 - t) ** (n - j) for j in range(n + 1))
            low, high = extrema_bounds.extrema(b)
            assert low == pytest.approx(values.min(), abs=1e-5)
            assert high == pytest.approx(values.max(), abs=1e-5)
            least = extrema_bounds.lu_least(b)
            assert b.min() - 1e-12 <= least <= low + 1e-9
            if n == 2:
                assert least == pytest.approx(low, abs=1e-9), "exact by construction at degree 2"


def test_table_2_rows_cover_every_reading_bound_and_degree():
    rows = extrema_bounds.compute()
    assert len(rows) == len(extrema_bounds.READINGS) * 2 * len(extrema_bounds.DEGREES)
    assert all(np.isfinite(row["percent"]) for row in rows)


def test_a_run_stores_studies_and_reuses_them(tmp_path, capsys):
    config = tmp_path / "s.toml"
    config.write_text('title = "s"\nstudies = ["condition_numbers"]\n')
    assert main(["run", str(config), "--runs", str(tmp_path)]) == 0
    first = capsys.readouterr().out
    assert "study condition_numbers" in first and "reused" not in first
    assert studies.is_done("condition_numbers", tmp_path / "s")
    assert main(["run", str(config), "--runs", str(tmp_path)]) == 0
    assert capsys.readouterr().out.startswith("study condition_numbers: reused")


def test_published_tables_cite_their_paper():
    names = [path.stem for path in published.FOLDER.glob("*.csv")]
    assert names
    for name in names:
        table = published.table(name)
        assert any(title in table.citation for title in ("Szente", "de Toledo", "beam casting"))
        assert table.rows
        assert None not in table.rows[0], "more cells than columns"


def test_beamcastings_ratios_are_those_of_its_frames():
    """The paper cuts its ratios off after two digits, of frames per second that it rounds."""
    for row in published.table("beamcasting_tables_fps").rows:
        ratio = float(row["adaptive_fps"]) / float(row["uniform_fps"])
        assert ratio == pytest.approx(float(row["adaptive_over_uniform"]), abs=0.011), row


def test_the_torus_along_rays_has_the_shapes_that_its_cases_name():
    rows = {row["case"]: row for row in torus_along_rays.compute()}
    shapes = {
        name: (len(row["roots"]), len(row["extremes"]), len(row["bends"]))
        for name, row in rows.items()
        if "roots" in row
    }
    assert shapes == {
        "four roots": (4, 3, 2),
        "two roots, one minimum": (2, 1, 0),
        "two roots about a maximum below 0": (2, 3, 2),
        "two roots in the first minimum": (2, 3, 2),
        "two roots in the second minimum": (2, 3, 2),
        "a touch, and two roots": (3, 3, 2),
        "no root, two minima": (0, 3, 2),
    }
    for row in rows.values():
        if len(row.get("extremes", ())) == 3:
            assert row["t_m"] == pytest.approx(sum(row["extremes"]) / 3.0, abs=1e-9)
    sampled = rows["sampled"]
    assert (sampled["minima"], sampled["maxima"]) == (2, 1)
    assert max(sampled["mean_error"], sampled["equation_error"]) < 1e-12


def test_polygonal_tori_are_off_by_both_chords_where_they_add(monkeypatch, tmp_path):
    """Within 5 %, from 32 × 32 on; the formula of the ring alone is what Table 1 prints, to its last digit."""
    pytest.importorskip("pyvista")
    monkeypatch.setenv("FIRSTHIT_CACHE", str(tmp_path))
    monkeypatch.setattr(mesh_errors, "SIZES", (32, 64, 128))
    paper = published.table("toledo2007_table1_fps")
    meshes.mesh(surfaces.get("torus"), MeshRecipe("parametric", 64))
    monkeypatch.setenv("FIRSTHIT_CACHE", str(tmp_path / "another"))  # where nothing is yet, whatever was made before
    for row in mesh_errors.compute():
        printed = paper.number("error_Rr_1e-6", technique=f"Polygon {row['n']}*{row['n']}")
        assert 1e6 * row["ring"] == pytest.approx(printed, abs=1.0)
        assert row["to_surface"] == pytest.approx(row["both"], rel=0.05)
        assert row["to_mesh"] == pytest.approx(row["both"], rel=0.05)
        assert row["vertices"] == row["n"] ** 2
        assert row["triangles"] == 2 * row["n"] ** 2
    stored = {path.name: path.stat().st_mtime_ns for path in meshes.folder().iterdir()}
    assert len(stored) == 3
