"""The report of where rays begin: what the shift gains and costs, never by rows of several origins mixed."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from harness.contract import FROM_ORIGIN, ORIGINS, digest
from reports import claims
from reports.analysis import breaks, derive
from reports.claims import Claim, Outcome, Verdict
from reports.claims.evidence import Evidence, Pick
from reports.content import Text
from reports.parts import origins
from reports.reading import load
from reports.reading.arrays import Shelf
from tests.synthetic_run import FAMILIES, cell, family_cell, reported, retime, tiny_run

KINDS = ("misses", "false_hits", "exhausted", "wrong_root", "invalid")


def moved(
    origin: Any, wrong: int, error: float, median: float, variant: str = "ray_march", surface: str = "torus"
) -> dict[str, Any]:
    """A finished cell whose rays begin at `origin`, with so many exhausted rays, so large an error, in so many ms."""
    made = cell(variant, surface, "opencl:intel", "float32")
    made["variant"] = variant + FROM_ORIGIN[origin]
    slot = made["slot"].replace(variant, made["variant"], 1)
    made |= {"slot": slot, "key": digest(slot), "origin": origin, "casts": "rays", "arrays": None}
    retime(made, median)
    none = {f"{prefix}{kind}": 0 for prefix in ("", "grazing_", "drowned_") for kind in KINDS}
    made["accuracy"] |= none | {"exhausted": wrong}
    made["accuracy"]["relative_error"] = {"max": error}
    return made


def rows_of(folder: Path, *cells: dict[str, Any]) -> Any:
    return derive.derive(load.load(tiny_run(folder, *cells)).frame)


GAINS = (moved("nearest", 2, 1e-6, 1.02), moved("entry", 3, 2e-6, 1.01), moved("eye", 300, 1e-3, 1.0))


def right(nearest_ms: float) -> tuple[dict[str, Any], ...]:
    """A scene with no wrong ray from either end, so that its times may be told."""
    times = {"nearest": nearest_ms, "eye": 1.0}
    return tuple(moved(origin, 0, 1e-6, ms, surface="sphere") for origin, ms in times.items())


def test_gain_and_cost_are_told_and_called_cheap(tmp_path: Path) -> None:
    first, second = origins.conclusions(origins.paired(rows_of(tmp_path / "run", *GAINS, *right(1.02))))
    assert "from 300 to 2 of 4,608. Fewer beyond chance: Ray march (300 to 2). More beyond chance: none." in first
    assert "1,000× at most" in first
    assert "by 1.02 in the median: it makes methods more robust and costs next to nothing" in second


def test_a_gain_that_costs_time_is_not_called_cheap(tmp_path: Path) -> None:
    _, second = origins.conclusions(origins.paired(rows_of(tmp_path / "run", *GAINS, *right(1.2))))
    assert "by 1.20 in the median: it is worth that to the variants named" in second


def test_no_time_is_told_of_wrong_answers(tmp_path: Path) -> None:
    rows = origins.paired(rows_of(tmp_path / "run", *GAINS))
    _, second = origins.conclusions(rows)
    assert second.endswith("what that costs is not told.")
    assert np.isnan(origins.by_variant(rows).rows[0][-2])


@pytest.mark.parametrize(("nearest", "eye"), [(5, 8), (8, 5)])
def test_a_few_rays_are_no_gain(tmp_path: Path, nearest: int, eye: int) -> None:
    cells = (moved("nearest", nearest, 1e-6, 1.0), moved("eye", eye, 1e-6, 1.0), *right(1.0))
    first, second = origins.conclusions(origins.paired(rows_of(tmp_path / "run", *cells)))
    assert (
        "Fewer beyond chance: none. More beyond chance: none." in first
        and "no variant answers more rays rightly for it" in second
    )


def test_a_loss_is_told_and_never_called_cheap(tmp_path: Path) -> None:
    worse = (
        moved("nearest", 200, 1e-6, 1.0, "newton[EPSILON=0.001]"),
        moved("eye", 1, 1e-6, 1.0, "newton[EPSILON=0.001]"),
    )
    first, second = origins.conclusions(origins.paired(rows_of(tmp_path / "run", *GAINS, *worse, *right(1.0))))
    assert "More beyond chance: Newton, ε = 0.001 (1 to 200)." in first
    assert "next to nothing" not in second


def test_tables_have_a_line_for_each_variant_and_scene(tmp_path: Path) -> None:
    null = [moved(origin, 0, 0.0, ms, "null") for origin, ms in zip(ORIGINS, (0.2, 0.15, 0.1), strict=True)]
    ball = [moved(origin, 1, 1e-5, 1.0, surface="sphere") for origin in ("nearest", "eye")]
    alone = moved("nearest", 0, 1e-6, 1.0, "newton[EPSILON=0.001]")
    rows = origins.paired(rows_of(tmp_path / "run", *GAINS, *null, *ball, alone))
    by = {line[0]: line[1:] for line in origins.by_variant(rows).rows}
    assert set(by) == {"Ray march", "Null"}, "what began at one origin alone is no pair"
    assert by["Ray march"][:4] == (1, 2, 3, 300), (
        "the ball has no row from the entry: its sum would compare with nothing"
    )
    assert by["Ray march"][7:10] == pytest.approx((1e-6, 2e-6, 1e-3))
    assert by["Null"][1:10] == (None,) * 9, "it finds nothing, so that its misses say nothing"
    assert by["Null"][10:] == pytest.approx((2.0, 1.5))
    assert len(origins.by_scene(rows).rows) == 3


def test_families_held_from_one_origin_alone_are_named(tmp_path: Path) -> None:
    cells = []
    for family in ("grazing", "thin_torus"):
        for origin in ("nearest", "eye"):
            variant = "newton[EPSILON=0.001]" if (family, origin) == ("thin_torus", "eye") else "_odd#[STEP_$=0.5]"
            made = family_cell("newton[EPSILON=1e-06]", family, "opencl:intel", "float32")
            if variant.startswith("newton"):
                made["rungs"] = family_cell(variant, family, "opencl:intel", "float32")["rungs"]
            made |= {"variant": "newton" + FROM_ORIGIN[origin], "origin": origin}
            cells.append(made | {"key": digest(family, origin), "slot": f"{family} {origin}"})
    run = load.load(tiny_run(tmp_path / "run", *cells))
    table = origins.families_held(breaks.derive(run.families, run.rungs), run.plan.facts)
    assert table is not None
    ((_, _, caster, of, nearest, eye, lost, won),) = table.rows
    assert (caster, of, nearest, eye, won) == ("Newton", 2, 2, 1, "none")
    assert lost == FAMILIES["thin_torus"]["title"]
    _, document = reported(run.folder)
    (section,) = (section for section in document.sections if section.title == "What the shift is worth")
    assert isinstance(section.blocks[0], Text)
    assert section.blocks[0].text.startswith("Of 2 pairs of a variant and a family of hard rays, 2 are held")


def test_the_section_stands_in_the_report_only_with_pairs(tmp_path: Path) -> None:
    for name, cells, there in (("pairs", GAINS, True), ("alone", GAINS[:1], False)):
        _, document = reported(tiny_run(tmp_path / name, *cells))
        assert ("What the shift is worth" in [section.title for section in document.sections]) is there


def test_evidence_takes_the_papers_origin_or_the_picks_and_never_several(tmp_path: Path) -> None:
    frame = rows_of(tmp_path / "run", *GAINS)
    evidence = Evidence(frame, {}, Shelf({}))
    march = Pick("march", "ray_march")
    for config, origin in (("toledo-x.toml", "entry"), ("szente-x.toml", "eye"), ("beamcasting-x.toml", "nearest")):
        own = evidence.of(config)
        assert own.rows(march)["origin"].tolist() == [origin] and own.note == ""
        assert own.rows(Pick("march", "ray_march", origin="nearest"))["origin"].tolist() == ["nearest"]
    assert evidence.rows(march)["origin"].tolist() == ["nearest"]


def test_a_verdict_says_where_rays_begin_if_not_as_in_the_paper(tmp_path: Path) -> None:
    decide = lambda evidence: Verdict(Outcome.CONFIRMED, f"{len(evidence.rows(Pick('', 'ray_march')))} row")  # noqa: E731
    claim = Claim("toledo2007", "3", "text", "rows", decide, config="toledo-x.toml")
    nearest = Evidence(rows_of(tmp_path / "near", GAINS[0], GAINS[2]), {}, Shelf({}))
    entry = Evidence(rows_of(tmp_path / "entry", *GAINS), {}, Shelf({}))
    assert claims.judge(claim, entry).figure == "1 row"
    told = claims.judge(claim, nearest).figure
    assert told.startswith("1 row (of rays that begin at their point nearest") and "entry" in told


def test_triangles_and_rows_of_older_runs_have_no_origin_and_stand_beside_any(tmp_path: Path) -> None:
    old = cell("ray_march", "torus", "opencl:intel", "float32")
    evidence = Evidence(rows_of(tmp_path / "run", old), {}, Shelf({}))
    assert len(evidence.of("toledo-x.toml").rows(Pick("", "ray_march"))) == 1


def test_the_floor_is_that_of_the_same_origin(tmp_path: Path) -> None:
    null = [moved(origin, 0, 0.0, ms, "null") for origin, ms in zip(ORIGINS, (0.2, 0.15, 0.1), strict=True)]
    frame = rows_of(tmp_path / "run", *GAINS, *null).set_index("variant")["floor_ms"]
    assert frame["ray_march"] == pytest.approx(0.2) and frame["ray_march from the eye"] == pytest.approx(0.1)


def test_a_baseline_is_named_without_its_origin(tmp_path: Path) -> None:
    cells = [moved("entry", 0, 1e-6, ms, name) for name, ms in (("newton[EPSILON=0.001]", 2.0), ("ray_march", 1.0))]
    frame = load.load(tiny_run(tmp_path / "run", *cells)).frame.assign(baseline="newton[EPSILON=0.001]")
    assert derive.derive(frame).set_index("method")["speedup"]["ray_march"] == pytest.approx(2.0, rel=0.2)
