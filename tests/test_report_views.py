"""View dependence, growth and evaluations in a report, on rows whose figures are known beforehand."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest

from harness.contract import View, digest
from harness.scenes.views import AngleChoice, DirectionChoice, by_angle, by_direction
from reports import content
from reports.analysis import derive, fits, viewstats
from reports.drawing import images, line_labels, style, viewplots
from reports.parts import evaluations, growth, view_dependence
from reports.reading import arrays, load
from tests.synthetic_run import SURFACES, cell, printed, reported, sampled, tiny_run
from tests.synthetic_run import arrays as made_arrays

PAPER_STURM = [35.64, 35.16, 35.15, 35.32, 35.06, 34.07]  # toledo2007, Table 1, Mpixels/s


def viewed(
    variant: str, view: View, ms: float, surface: str = "torus", size: int = 256, wrong: int = 0
) -> dict[str, Any]:
    """A finished cell of one view, half of whose rays meet the domain and a quarter hit."""
    made = cell(variant, surface, "opencl:intel", "float32")
    slot = f"{variant} {surface} {view.name} {size}"
    made |= {"slot": slot, "key": digest(slot), "size": size, "view": view.name, "view_set": view.set}
    made |= {"comparison": f"{surface} {view.name} {size}", "arrays": None}
    made["camera"] = {"azimuth": view.azimuth, "elevation": view.elevation, "fov": view.fov, "distance": 5.0}
    made["time"] |= {
        "median_ms": ms,
        "lower_ms": ms,
        "upper_ms": ms,
        "samples_ms": [ms] * 20,
        "session": made["comparison"],
    }
    rays = made["accuracy"]["rays"]
    made["accuracy"] |= {"domain_rays": rays // 2, "truth_hits": rays // 4, "misses": wrong}
    made["accuracy"]["truth_misses"] = rays - rays // 4
    made["accuracy"] |= {"false_hits": 0, "exhausted": 0, "wrong_root": 0}
    return made


def framed(folder: Path, *cells: dict[str, Any]) -> pd.DataFrame:
    return derive.derive(load.load(tiny_run(folder, *cells)).frame)


def curves(frame: pd.DataFrame, axis: growth.Axis) -> list[growth.Curve]:
    return growth._curves(axis, growth._points(frame, axis)[0])


def grown(frame: pd.DataFrame, marks: dict[str, style.Mark]) -> list[content.Section]:
    return growth.sections(SimpleNamespace(listed=frame, marks=marks))


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    angles, around = by_angle(AngleChoice()), by_direction(DirectionChoice(24))
    cells = []
    for i, view in enumerate(angles):
        rate = PAPER_STURM[i] * 1e6  # rays in the domain per second; half of 256² rays
        cells.append(viewed("ray_march", view, 256 * 256 / 2 / rate * 1e3, wrong=7 if view.name == "angle 72" else 0))
        cells += [viewed("newton[EPSILON=0.001]", view, 1.0 + (i == 5)), viewed("null", view, 0.01)]
    for i, view in enumerate(around):
        cells.append(viewed("ray_march", view, 10 + np.sin(i), wrong=i if i < 3 else 0))
        cells.append(viewed("newton[EPSILON=0.001]", view, 5.0))
    cells += [viewed("ray_march", View(name), 9.0) for name in ("a", "b")]
    return tiny_run(tmp_path_factory.mktemp("views") / "run", *cells)


@pytest.fixture(scope="module")
def frame(run: Path) -> pd.DataFrame:
    return derive.derive(load.load(run).frame)


def test_rows_tell_their_camera(frame: pd.DataFrame) -> None:
    row = frame[(frame["view"] == "angle 72") & (frame["variant"] == "ray_march")].iloc[0]
    assert row[["view_set", "azimuth", "elevation", "fov", "distance"]].tolist() == ["angles", 0.0, 18.0, 30.0, 5.0]
    assert row["domain_rays"] == row["accuracy_rays"] // 2


def test_spread_is_the_papers(frame: pd.DataFrame) -> None:
    angles, around = viewstats.view_sets(frame)
    assert (angles.kind, around.kind) == ("angles", "directions"), "two views of no set are none"
    table = view_dependence.dependence_table(angles)
    rows = {row[0]: row for row in table.rows}
    assert [row[0] for row in table.rows] == ["Newton, ε = 0.001", "Ray march", "Null"], "most dependent first"
    titles = [(column.over.partition(",")[0], column.title) for column in table.columns]
    sturm = dict(zip(titles, rows["Ray march"], strict=True))
    assert sturm["rays in the domain", "mean"] == pytest.approx(np.mean(PAPER_STURM))
    assert sturm["rays in the domain", "std/mean"] == pytest.approx(0.0138, abs=5e-5), "Table 1: 1.38 %"
    assert sturm["rays cast", "mean"] == pytest.approx(2 * np.mean(PAPER_STURM))
    assert sturm["rays that hit", "mean"] == pytest.approx(np.mean(PAPER_STURM) / 2)
    assert sturm["slowest per ray", "view"] == "angle 90"
    assert sturm["wrong rays", "all"] == 7 and sturm["wrong rays", "most in"] == "angle 72"
    null = dict(zip(titles, rows["Null"], strict=True))
    assert null["rays in the domain", "mean"] == pytest.approx(256 * 256 / 2 / 0.01e-3 / 1e6), "shares are the scene's"
    assert null["wrong rays", "all"] is None and null["worst error", "view"] is None
    wrong = view_dependence.wrong_rays_table(around)
    assert wrong is not None
    assert [row[:4] for row in wrong.rows] == [("Ray march", "direction 03", 2, 2), ("Ray march", "direction 02", 1, 1)]


def test_the_report_shows_each_set_and_lists_its_first_view_elsewhere(run: Path, frame: pd.DataFrame) -> None:
    _, report = reported(run)
    by_title = {section.title: section for section in report.sections}
    assert "over 6 projection angles" in printed(by_title["View dependence: every figure"].details)
    told, lines = by_title["View dependence"].blocks
    said, maps = by_title["View dependence over all directions"].blocks
    assert isinstance(lines, content.Figure) and isinstance(maps, content.Figure)
    for text in (">0°<", ">90°<", ">Newton, ε = 0.001<"):
        assert text in lines.svg
    assert len(maps.svg) < 400_000
    first = (
        "On Torus the view matters most to Newton, ε = 0.001: a ray takes 2.00× as long from angle 90 as from its best"
    )
    assert first in printed(
        (told,)
    ) and "least to Ray march, 1.05×; of an empty frame's time, 1.00× is noise" in printed((told,))
    assert "matters most to Ray march: a ray takes 1.22× as long" in printed((said,))
    own = [of for of in report.sections if of.title.startswith("Torus")]
    results = "\n".join(printed((*of.blocks, *of.details)) for of in own)
    assert "view angle 18," in results and "view a," in results and "view direction 01," in results
    assert "direction 02" not in results
    kept = viewstats.one_view_of_each(frame)
    assert set(kept["view"]) == {*(f"angle {a}" for a in range(0, 91, 18)), "direction 01", "a", "b"}
    assert view_dependence.sections(SimpleNamespace(frame=kept[kept["view_set"] != "angles"])) == []


def test_the_map_is_equal_area_and_gives_each_place_its_nearest_direction() -> None:
    x, y = viewplots.mollweide(np.array([0.0, 90, -90, 0, 0, 180]), np.array([0.0, 0, 0, 90, -90, 0]))
    assert x == pytest.approx([0, 1, -1, 0, 0, -2], abs=1e-6)
    assert y == pytest.approx([0, 0, 0, 1, -1, 0], abs=1e-6)
    sphere = viewplots.Sphere.of(np.array([0.0, 0, 120, -120]), np.array([90.0, -19.4712] * 2)[[0, 1, 1, 1]])
    inside = sphere.nearest >= 0
    assert inside.mean() == pytest.approx(np.pi / 4, abs=0.01), "an ellipse in its box"
    shares = np.bincount(sphere.nearest[inside]) / inside.sum()
    assert shares == pytest.approx([0.25] * 4, abs=0.01), "a tetrahedron's corners share the sphere evenly"
    assert sphere.nearest[2, 90] == 0 and sphere.nearest[-3, 90] == 1
    for number, (px, py) in enumerate(zip(sphere.x, sphere.y, strict=True)):
        line, column = int((1 - py) / 2 * 89.999), int((px + 2) / 4 * 179.999)
        if inside[line, column]:
            assert sphere.nearest[line, column] == number


def test_names_of_lines_keep_apart_in_their_order_and_within_the_plot() -> None:
    rng = np.random.default_rng(3)
    for count in (1, 2, 14, 40):
        wanted = rng.uniform(10.0, 90.0, count)
        places = line_labels.apart(wanted, 5.0, 10.0, 90.0)
        order = np.argsort(wanted)
        assert (np.diff(places[order]) >= min(5.0, 80.0 / max(count - 1, 1)) - 1e-9).all()
        assert places.min() >= 10.0 - 1e-9 and places.max() <= 90.0 + 1e-9
    assert line_labels.apart([20.0, 50.0, 51.0], 5.0, 10.0, 90.0) == pytest.approx([20.0, 48.0, 53.0])


@pytest.mark.parametrize("exponent", [0.5, 1.0, 2.3, -1.0])
def test_a_known_exponent_is_found_within_its_interval(exponent: float) -> None:
    x = np.array([1.0, 2, 4, 8, 16, 32])
    exact = fits.power_law(x, 3.0 * x**exponent)
    assert isinstance(exact, fits.Power)
    assert exact.exponent == pytest.approx(exponent) and exact.factor == pytest.approx(3.0)
    assert exact.half_width == pytest.approx(0.0, abs=1e-9)
    held = 0
    for seed in range(400):
        noise = np.exp(np.random.default_rng(seed).normal(0.0, 0.1, len(x)))
        fit = fits.power_law(x, 3.0 * x**exponent * noise)
        assert isinstance(fit, fits.Power)
        held += abs(fit.exponent - exponent) <= fit.half_width
    assert 0.92 < held / 400 < 0.98, "a 95 % interval holds the truth 95 % of the time"


def test_what_no_fit_can_be_made_of() -> None:
    for x, y in (([1, 2, 2], [1, 2, 2]), ([1, 2, 3], [1, 0, 2])):
        two = fits.power_law(x, y)
        assert isinstance(two, fits.Refusal), "two places make a line through anything"
        assert two.reason == "fewer than 3 places determine no exponent"
    wide = fits.power_law([2, 4, 6], [1.0, 40.0, 2.0])
    assert isinstance(wide, fits.Refusal)
    assert wide.reason.startswith("3 points do not determine an exponent: the 95 % interval of 1.14, −")
    level = fits.power_law([1, 2, 4, 8], [1.0, 1.0, 1.0, 1.0])
    assert isinstance(level, fits.Power) and level.exponent == level.half_width == 0.0


@pytest.mark.parametrize("seed", range(20))
def test_no_exponent_is_told_whose_interval_is_wider_than_itself(seed: int) -> None:
    draws = np.random.default_rng(seed)
    fit = fits.power_law(draws.uniform(1, 9, 4), np.exp(draws.normal(size=4)))
    assert isinstance(fit, fits.Refusal) or 2.0 * fit.half_width <= abs(fit.exponent)
    assert [fits.student(n) for n in (1, 2, 5, 30)] == pytest.approx([12.706, 4.303, 2.571, 2.042], abs=5e-4)


def test_growth_against_pixels_and_degree_and_instances(tmp_path: Path) -> None:
    view = View("front")
    cells = [viewed("ray_march", view, 1e-5 * size**1.8, size=size) for size in (128, 256, 512)]
    cells += [viewed("newton[EPSILON=0.001]", view, 1e-6 * size**2, size=size) for size in (256,)]
    for surface, (_, degree, _) in SURFACES.items():
        cells.append(viewed("newton[EPSILON=0.001]", view, 0.3 + 0.01 * degree**2.0, surface, size=64))
        cells.append(viewed("null", view, 0.3, surface, size=64))
    frame = framed(tmp_path / "run", *cells)
    pixels, degree, instances = growth.AXES
    (curve,) = curves(frame, pixels)
    assert (curve.variant, curve.fit.points) == ("ray_march", 3)
    assert curve.fit.exponent == pytest.approx(0.9)
    (curve,) = curves(frame, degree)
    assert (curve.variant, curve.fit.exponent) == ("newton[EPSILON=0.001]", pytest.approx(2.0))
    assert curves(frame, instances) == []
    many = frame[frame["size"] == 64].iloc[[0] * 4].assign(instances=[1, 10, 100, 1000], scene="lattice")
    many = many.assign(median_ms=[1, 10, 100, 1000.0])
    (curve,) = curves(many, instances)
    assert curve.fit.exponent == pytest.approx(1.0)
    sections = grown(frame, style.variant_marks([("newton", curve.variant), ("ray_march", "ray_march")]))
    assert [section.title for section in sections] == ["Cost against pixels", "Cost against degree"]
    assert "Here k is 0.90, of Ray march, " in printed(sections[0].blocks)
    assert "2.00" in printed(sections[1].blocks) and "2.00" in printed(sections[1].details)


def test_points_are_of_right_rows_in_the_floors_own_rounds_and_the_rest_is_counted(tmp_path: Path) -> None:
    view, cells = View("front"), []
    for surface, (_, degree, _) in SURFACES.items():
        cells.append(viewed("newton[EPSILON=0.001]", view, 0.3 + 0.01 * degree**2.0, surface))
        cells.append(viewed("ray_march", view, 9.0 * degree, surface, wrong=int(degree == 2)))
        cells.append(viewed("null", view, 0.3, surface))
    for made in cells:  # the machine was busy in rounds that only the null method was timed in
        if made["method"] == "null":
            sampled(made, [0.3] * 20 + [9.9] * 30)
    frame = framed(tmp_path / "run", *cells)
    degree_axis = growth.AXES[1]
    (curve,) = curves(frame, degree_axis)
    assert (curve.variant, curve.fit.exponent) == ("newton[EPSILON=0.001]", pytest.approx(2.0))
    (section,) = grown(frame, style.variant_marks([("newton", curve.variant)]))
    told = printed(section.details)
    assert "Left out: 1 row with a ray away from silhouettes answered wrongly, or unchecked; a line" in told
    for made in cells:
        if made["method"] == "newton" and made["surface"] == "torus":
            made["time"]["session"] = "another day"
    (section,) = grown(framed(tmp_path / "apart", *cells), {})
    assert "and 1 row without a round shared with the null method; a line" in printed(section.details)


def test_evaluations_are_drawn_and_the_worst_of_many_views_chosen(tmp_path: Path) -> None:
    seen = [
        viewed("ray_march", view, 1.0, wrong=4 if view.name == "angle 54" else 0) for view in by_angle(AngleChoice())
    ]
    seen += [viewed("null", view, 1.0) for view in by_angle(AngleChoice())]
    for made in seen:
        made["arrays"] = f"arrays/{made['key']}.npz" if made["answers"] else None
    folder = tiny_run(tmp_path / "run", *seen)
    (folder / "arrays").mkdir()
    for made in seen[:6]:
        np.savez_compressed(folder / made["arrays"], **made_arrays(made))
    frame = derive.derive(load.load(folder).frame)
    (section,) = evaluations.sections(
        SimpleNamespace(shelf=arrays.Shelf(load.load(folder).folders), frame=frame, error_scale=(-8, -2))
    )
    (gallery,) = [block for block in section.blocks if isinstance(block, content.Gallery)]
    (panel,) = gallery.panels
    assert panel.title == "Ray march, Torus, angle 54" and "4 wrong" in panel.note
    image = evaluations.evaluation_map(np.array([[0, 1, 10, 100]], np.int32), 100)
    assert image[0, 0].tolist() == [1, 1, 1]
    assert image[0, 1].sum() < image[0, 2].sum() < image[0, 3].sum(), "more is brighter"
    assert images.png(image).startswith(b"\x89PNG")
