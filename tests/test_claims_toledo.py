"""toledo2007's claims about pieces of its casters, and the tables beside them: planted rows flip the verdicts."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from PIL import Image

from harness.contract import digest
from harness.results.store import FORMAT
from reports import claims, content
from reports.claims import Outcome, picks
from reports.claims.evidence import Pick
from reports.drawing import images
from reports.parts.papers import toledo_table1
from tests.synthetic_run import printed, reported, tiny_run
from tests.test_claims import claim, evidence, planted


def in_proxy(proxy: str, fragments: int, hits: int, median: float) -> dict[str, Any]:
    """A row of Newton as printed at one of Table 1's views, from the fragments of `proxy`."""
    counted = {"fragments": fragments, "fragments_discarded": fragments - hits, "pixels_drawn": hits}
    made = planted(Pick(f"Newton in a {proxy}", "newton", picks.NEWTON_3.knobs), "torus", median, **counted)
    return made | {"stage": "raster", "proxy": proxy, "view_set": "angles"}


def named(folder: Path, name: str, *cells: dict[str, Any]) -> Path:
    """A run that bears a config's name."""
    run = tiny_run(folder, *cells)
    told = json.loads((run / "plan.json").read_text()) | {"name": name}
    (run / "plan.json").write_text(json.dumps(told))
    return run


@pytest.mark.parametrize(("fragments", "expected"), [(220, Outcome.CONFIRMED), (120, Outcome.REFUTED)])
def test_a_tetrahedrons_waste_is_counted_in_fragments(tmp_path: Path, fragments: int, expected: Outcome) -> None:
    cells = (in_proxy("box", 130, 78, 1.0), in_proxy("tetrahedron", fragments, 78, 2.0))
    verdict = claims.judge(claim("toledo2007", "tetrahedron about the torus"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is expected
    assert "40.00 %" in verdict.figure and "2.00× the box's time" in verdict.figure


@pytest.mark.parametrize(("slower", "expected"), [(1.2, Outcome.CONFIRMED), (0.9, Outcome.REFUTED)])
def test_normals_are_held_against_each_other_view_by_view(tmp_path: Path, slower: float, expected: Outcome) -> None:
    cells = []
    for normal, median in (("core_circle", 1.0), ("distance", 1.1), ("gradient", slower)):
        made = planted(Pick(f"shaded by {normal}", "newton", picks.NEWTON_3.knobs), "torus", median)
        cells.append(made | {"stage": "raster", "proxy": "box", "normal": normal})
    verdict = claims.judge(claim("toledo2007", "normal from the torus's core"), evidence(tmp_path / "a", *cells))
    assert verdict.outcome is expected
    assert verdict.figure.endswith("by the distance's gradient 1.10×")
    _, report = reported(named(tmp_path / "b", "toledo-normals", *cells))
    told = next(printed(s.blocks) for s in report.sections if s.title == "toledo2007, piece by piece")
    assert f"front | 1.00 | 1.10 | {slower:.3g}" in told


@pytest.mark.parametrize(
    ("words", "without", "having"),
    [
        ("discard before the search", picks.STURM_SEARCHING, picks.STURM),
        ("start on the sphere", picks.NEWTON_FROM_BOX, picks.NEWTON_3),
    ],
)
def test_a_piece_pays_where_it_is_faster(tmp_path: Path, words: str, without: Pick, having: Pick) -> None:
    for slow, expected in ((2.0, Outcome.CONFIRMED), (0.5, Outcome.REFUTED)):
        cells = (planted(without, "torus", slow, evaluations_mean=9.0), planted(having, "torus", 1.0))
        verdict = claims.judge(claim("toledo2007", words), evidence(tmp_path / f"{slow}", *cells))
        assert verdict.outcome is expected
        assert f"{without.words}: 9.00 evaluations a ray" in verdict.figure


@pytest.mark.parametrize(("cubic", "expected"), [(3.0, Outcome.CONFIRMED), (0.5, Outcome.REFUTED)])
def test_cubics_by_sturm_are_held_against_a_quadric(tmp_path: Path, cubic: float, expected: Outcome) -> None:
    cells = (planted(picks.STURM, "cayley", cubic), planted(picks.CLOSED_FORM, "sphere", 1.0))
    verdict = claims.judge(claim("toledo2007", "ray casting of quadrics"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is expected


def test_the_worth_of_pieces_and_proxies_stand_in_the_report(tmp_path: Path) -> None:
    cells = [planted(picks.STURM_SEARCHING, "cayley", 3.0, evaluations_mean=20.0, false_hits=2)]
    cells += [planted(picks.STURM, "cayley", 1.5, evaluations_mean=4.0)]
    _, report = reported(named(tmp_path / "a", "toledo-cubics", *cells))
    told = next(printed(s.blocks) for s in report.sections if s.title == "toledo2007, piece by piece")
    (line,) = [line for line in told.splitlines() if line.startswith("Sturm: discard")]
    assert "| 1 | 2.00× | 2.00× | 2.00× | 20.0 | 4.00 | 2 | 0" in line
    cells = [in_proxy("box", 130, 78, 1.0), in_proxy("tetrahedron", 220, 78, 2.0)]
    _, report = reported(named(tmp_path / "b", "toledo-proxies", *cells))
    told = next(printed(s.blocks) for s in report.sections if s.title == "toledo2007, piece by piece")
    assert "| tetrahedron | 220 | 64.55 %" in told


def test_figure_3_is_drawn_from_its_study_and_its_words_are_judged(tmp_path: Path) -> None:
    from harness.studies import torus_along_rays

    rows = torus_along_rays.compute()
    run = tiny_run(tmp_path / "run", planted(picks.STURM, "torus", 1.0))
    (run / "studies").mkdir(exist_ok=True)
    stored = {"format": FORMAT, "key": "k", "study": "torus_along_rays", "title": "", "rows": rows, "seconds": 0.0}
    (run / "studies" / "k.json").write_text(json.dumps(stored))
    told = json.loads((run / "plan.json").read_text()) | {"studies": [{"study": "torus_along_rays", "key": "k"}]}
    (run / "plan.json").write_text(json.dumps(told))
    _, report = reported(run)
    (section,) = [section for section in report.sections if section.title == "toledo2007, Figure 3"]
    (figure,) = [block for block in section.blocks if isinstance(block, content.Figure)]
    assert all(word in figure.svg for row in rows[:-1] for word in row["case"].split())
    told = printed(section.details)
    assert "Claims that these rows test: 1 confirmed and 1 refuted;" in printed(section.blocks)
    assert "local minima: 2 at most, local maxima: 1 at most" in told
    assert told.count("confirmed") == 1 and told.count("refuted") == 1
    other = [rows[-1] | {"case": "sampled", "minima": 1, "maxima": 2}]
    swapped = evidence(tmp_path / "b", planted(picks.STURM, "torus", 1.0), studies={"torus_along_rays": other})
    assert claims.judge(claim("toledo2007", "two local maxima"), swapped).outcome is Outcome.CONFIRMED


def on_lattice(pick: Pick, tori: int, median: float, **more: Any) -> dict[str, Any]:
    made = planted(pick, "torus", median, f"lattice {tori}")
    made["build"] = (made["build"] or {}) | {"bytes": more.pop("bytes", 1000)}
    return made | {"scene": "lattice", "instances": tori, "stage": "raster", "pixel_tolerance": 0.0} | more


@pytest.mark.parametrize(
    ("mesh", "told", "expected"), [(9000, "9.00×", Outcome.CONFIRMED), (900, "0.900×", Outcome.REFUTED)]
)
def test_memory_is_counted_in_bytes_on_the_device(tmp_path: Path, mesh: int, told: str, expected: Outcome) -> None:
    cells = (on_lattice(picks.NEWTON_3, 16, 1.0), on_lattice(picks.POLYGONS[0], 16, 1.0, bytes=mesh))
    verdict = claims.judge(claim("toledo2007", "needs less memory"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is expected
    assert f"Polygon 32*32 {told} of 16 tori" in verdict.figure


@pytest.mark.parametrize(
    ("coarse", "told", "expected"), [(0.5, "2.00×", Outcome.CONFIRMED), (1.6, "0.625×", Outcome.REFUTED)]
)
def test_level_of_detail_is_judged_where_tori_are_farthest(
    tmp_path: Path, coarse: float, told: str, expected: Outcome
) -> None:
    cells = []
    for tori, own in ((1, 1.0), (64, coarse)):
        fine, loose = on_lattice(picks.STURM, tori, 1.0), on_lattice(picks.STURM, tori, own, pixel_tolerance=0.1)
        cells += [fine, loose | {"slot": f"loose {tori}", "key": digest(f"loose {tori}")}]
    verdict = claims.judge(claim("toledo2007", "level of detail"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is expected
    assert f"64 tori {told}" in verdict.figure


@pytest.mark.parametrize(("bad", "expected"), [(160, Outcome.CONFIRMED), (0, Outcome.REFUTED), (18, Outcome.UNDECIDED)])
def test_errors_near_singular_points_are_those_of_the_worst_view(tmp_path: Path, bad: int, expected: Outcome) -> None:
    views = (("zoomed", 0), ("zoomed closely", bad))
    checked = {"size": 141, "rays": 141**2, "truth_hits": 0, "truth_misses": 141**2}
    cells = [planted(picks.STURM, "cayley", 1.0, view, grazing_false_hits=n, **checked) for view, n in views]
    verdict = claims.judge(claim("toledo2007", "evident after zooming"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is expected
    if bad:
        assert f"zoomed closely: {bad + 2} of" in verdict.figure, "2 drowned ones are planted in each view"


@pytest.mark.parametrize(("fine", "expected"), [(1e-5, Outcome.CONFIRMED), (1e-3, Outcome.REFUTED)])
def test_precision_is_judged_by_the_settings_of_small_errors(tmp_path: Path, fine: float, expected: Outcome) -> None:
    errors = ((picks.LOOP_BLINN, 1e-4), (picks.STURM, 1e-5), (picks.NEWTON_5, fine), (picks.BISECTION, 1e-2))
    cells = [planted(pick, "torus", 1.0, feature_error={"max": error}) for pick, error in errors]
    verdict = claims.judge(claim("toledo2007", "more precisely"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is expected
    assert "D.D. Bisection" in verdict.figure


def test_sturm_is_judged_from_the_box_and_told_from_the_eye(tmp_path: Path) -> None:
    cells = []
    for origin, worst in (("entry", 0), ("eye", 400)):
        for view, bad in (("angle 0", 0), ("angle 72", worst)):
            pick = Pick(f"Sturm {origin}", "sturm", picks.STURM.knobs)
            cells.append(planted(pick, "torus", 1.0, view, misses=bad) | {"origin": origin})
    verdict = claims.judge(claim("toledo2007", "viewing angle"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is Outcome.REFUTED
    assert "With o read as the eye: wrong rays from 0 (view angle 0) to 400" in verdict.figure
    assert verdict.figure.endswith("(confirmed)")


def test_planes_are_compared_on_rays_of_one_origin(tmp_path: Path) -> None:
    """From the eye errors are larger, whatever the planes."""
    cells = []
    for origin, error in (("entry", 1e-4), ("eye", 1e-2)):
        for near in (0.005, 2.5):
            pick = Pick(f"{near} from {origin}", "analytic", {"SCREEN": 1, "POLISH": 0, "NEAR": near, "FAR": 6.0})
            cells.append(planted(pick, "torus", 1.0, error={"p99": error}) | {"origin": origin})
    verdict = claims.judge(claim("toledo2007", "depends on the near plane"), evidence(tmp_path / "run", *cells))
    assert verdict.outcome is Outcome.REFUTED
    assert "by 1.00×" in verdict.figure


def test_figure_5_tells_a_boxs_fragments_from_the_torus(tmp_path: Path) -> None:
    made = planted(picks.STURM, "torus", 1.0, "angle 18", fragments=40, fragments_discarded=30)
    made |= {"stage": "raster", "proxy": "box", "arrays": f"arrays/{made['key']}.npz"}
    run = named(tmp_path / "run", "toledo-table1", made)
    shade, evaluations = np.full((4, 4), np.nan, np.float32), np.zeros((4, 4), np.int32)
    evaluations[1:], shade[2] = 2, 1.0
    blank = {
        "truth": np.zeros((4, 4), np.uint8),
        "wrong": np.zeros((4, 4), np.uint8),
        "grazing": np.zeros((4, 4), bool),
    }
    (run / "arrays").mkdir(exist_ok=True)
    arrays = blank | {"error": np.zeros((4, 4), np.float32), "shade": shade, "evaluations": evaluations}
    np.savez_compressed(run / made["arrays"], **arrays)
    _, report = reported(run)
    (section,) = [section for section in report.sections if section.title == "toledo2007, Figures 1 and 5"]
    (gallery,) = [block for block in section.blocks if isinstance(block, content.Gallery)]
    assert [panel.title for panel in gallery.panels] == ["tilted by 18°"]
    assert "75 % wasted" in gallery.panels[0].note
    picture = Image.open(io.BytesIO(gallery.panels[0].pictures[0].png)).convert("RGB")
    pixels = np.asarray(picture).reshape(4, images.PIXELS // 4, -1, 3)
    assert [len(np.unique(row.reshape(-1, 3), axis=0)) for row in pixels] == [1] * 4
    white, box, torus, below = (tuple(row[0, 0]) for row in pixels)
    assert white == (255, 255, 255) and box == below != torus != white != box


def test_pixels_are_counted_by_a_technique_that_loses_none():
    """Newton as printed loses 7 % of the torus's pixels at 72°, which the paper's table has."""
    angles = ["angle 0", "angle 72"]
    told = {"casts": "rays", "fragments": 324_000, "fragments_discarded": 121_000}
    drawn = (("Newton 0.001", 232, 188_500), ("Newton 0.001 forwards", 0, 203_000), ("Polygon 32*32", 0, 1))
    rows = pd.DataFrame(
        [
            told | {"technique": name, "view": view, "wrong_rays": wrong, "pixels_drawn": pixels}
            for name, wrong, pixels in drawn
            for view in angles
        ]
    )
    rows.loc[rows["technique"] == "Polygon 32*32", "casts"] = "mesh"
    table = toledo_table1._pixels(rows, angles)
    assert "as Newton 0.001 forwards draws them" in table.caption
    ours = next(row for row in table.rows if row[:2] == ("torus, kilopixels", "ours"))
    assert ours[2:] == (203.0, 203.0)


def test_a_claim_about_speed_says_who_answers_wrongly(tmp_path: Path) -> None:
    """Newton as printed leaves rays exhausted; its speed stands beside that."""

    def told(name: str, exhausted: int) -> str:
        slow, fast = planted(picks.LOOP_BLINN, "torus", 2.6), planted(picks.NEWTON_3, "torus", 1.0, exhausted=exhausted)
        return claims.judge(
            claim("toledo2007", "faster than closed forms"), evidence(tmp_path / name, slow, fast)
        ).figure

    assert "wrong rays: Newton 0.001 912 of 2,304, Loop-Blinn 0 of 2,304" in told("lost", 912)
    assert "wrong" not in told("right", 0)
