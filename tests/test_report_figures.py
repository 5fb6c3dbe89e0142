"""The drawings and pictures of a report."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from reports import content
from reports.analysis import derive
from reports.drawing import canvas, fronts, images, style
from reports.parts import conditions
from reports.reading import arrays, load
from tests.synthetic_run import write_run


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "quick")


@pytest.fixture(scope="module")
def frame(run: Path) -> pd.DataFrame:
    return derive.derive(load.load(run).frame)


def test_error_pictures_show_each_kind_of_ray_in_its_colour() -> None:
    shape = (1, 9)
    error = np.array([[0.0, 1e-8, 1e-2, np.nan, np.nan, np.nan, np.nan, np.nan, np.nan]], np.float32)
    wrong = np.array([[0, 0, 0, 1, 2, 3, 4, 5, 1]], np.uint8)
    grazing = np.arange(9).reshape(shape) == 8
    shade = np.ones(shape, np.float32)
    image = images.error_map(arrays.Arrays(np.ones(shape, np.uint8), error, wrong, grazing, shade), (-8, -2))
    colors = ["#{:02x}{:02x}{:02x}".format(*np.round(255 * pixel).astype(int)) for pixel in image[0]]
    assert colors[0] == style.EXACT
    assert colors[1] == "#00224e" and colors[2] == "#fee838", "the ends of cividis"
    assert colors[3:8] == [kind.color.lower() for kind in style.WRONG]
    assert np.all(image[0, 8] > image[0, 3] - 1e-9) and not np.allclose(image[0, 8], image[0, 3])


def test_a_pixel_of_several_samples_has_the_mean_of_their_colours(tmp_path: Path) -> None:
    shape, nan = (1, 2), np.nan
    blank = {"truth": np.zeros(shape, np.uint8), "wrong": np.zeros(shape, np.uint8), "grazing": np.zeros(shape, bool)}
    blank |= {"error": np.zeros(shape, np.float32), "shade": np.array([[1.0, nan]], np.float32)}
    samples = np.array([[1.0, 1.0, nan, nan], [1.0, 0.0, nan, 1.0]], np.float32)
    np.savez(tmp_path / "made.npz", samples=samples, **blank)
    light, shadow = (np.array(images._rgb(color)) for color in (style.SURFACE_LIGHT, style.SURFACE_SHADOW))
    image = images.shaded(arrays.read(tmp_path / "made.npz"))
    assert np.allclose(image[0, 0], (3 * light + shadow) / 4)
    assert np.allclose(image[0, 1], (3 + light) / 4), "three samples see the white behind"
    np.savez(tmp_path / "made.npz", samples=samples[:, :3], **blank)
    with pytest.raises(ValueError, match="samples has the shape"):
        arrays.read(tmp_path / "made.npz")


def test_a_zero_error_has_its_place_left_of_the_smallest(frame: pd.DataFrame) -> None:
    axis = canvas.ErrorAxis.of(pd.Series([0.0, 3e-7, 2e-3, np.inf]))
    assert (axis.lowest, axis.highest) == (-7, -2)
    assert axis.position(pd.Series([0.0, 1e-7, 1e-2])).tolist() == [axis.zero, -7.0, -2.0]
    assert axis.zero <= -8
    intel = frame[(frame["surface"] == "sphere") & (frame["device"] == "opencl:intel")]
    (figure,) = fronts.speed_against_error(intel, style.marks(frame["method"]), "sphere", "Sphere")
    assert "rows with an error of 0 stand left of the break. An error of 0 is of a t within" in figure.caption
    assert ">Newton, ε = 0.001<" in figure.svg, "text stays text"


def test_a_method_keeps_its_mark_and_no_two_share_one() -> None:
    plugins = [f"plugin_{i}" for i in range(30)]
    marks = style.marks([*plugins, "newton", "ray_march", "null", "sturm", "analytic"])
    assert len(set(marks.values())) == len(marks)
    assert marks["newton"] == style.marks(["newton"])["newton"]


def test_errors_are_held_against_what_the_condition_allows(run: Path, frame: pd.DataFrame) -> None:
    marks = style.variant_marks(frame[["method", "variant"]].itertuples(index=False, name=None))
    (section,) = conditions.sections(
        SimpleNamespace(shelf=arrays.Shelf(load.load(run).folders), frame=frame, marks=marks)
    )
    assert not section.blocks, "three surfaces have pages of their own; this is looked up"
    figures = {f.title.partition(",")[0]: f for f in section.details if isinstance(f, content.Figure)}
    assert set(figures) == {"Sphere", "Torus", "Barth #6 $extic_* @65 <b>"}
    assert len(figures["Torus"].svg) < 300_000, "summaries, not a mark for each ray"
    told = [block for block in section.details if isinstance(block, content.Matrix)]
    assert [matrix.title.rpartition(" ")[2] for matrix in told] == ["float32.", "float64."]

    row = next(frame[(frame["variant"] == "newton[EPSILON=0.001]") & (frame["surface"] == "torus")].itertuples())
    stored = np.load(run / "arrays" / f"{row.key}.npz")
    both = np.isfinite(stored["error"]) & np.isfinite(stored["condition"])
    cloud = conditions._cloud(arrays.Shelf(load.load(run).folders), row)
    assert cloud is not None and len(cloud.error) == both.sum()
    squares = dict(zip(told[0].columns, dict(told[0].rows)["Torus"], strict=True))
    assert "Newton, ε = 0.001 on Torus" in squares["Newton"].note or "ε = 1e−6" in squares["Newton"].note
    ratios = stored["error"][both] / (np.maximum(stored["condition"][both], 1) * 2.0**-24 * row.scene_radius)
    assert cloud.excess == pytest.approx(ratios.max())
    told = conditions._cloud(arrays.Shelf(load.load(run).folders), row._replace(domain_radius=2.0))
    assert told is not None and told.excess == pytest.approx(cloud.excess / 2)
    edges = np.linspace(np.log10(cloud.condition).min(), np.log10(cloud.condition).max(), conditions.BINS + 1)
    filled, largest, median = conditions._spread(cloud, edges)
    for number, top, middle in zip(filled, largest, median, strict=True):
        last = number == conditions.BINS - 1
        place = np.log10(cloud.condition)
        errors = cloud.error[(place >= edges[number]) & ((place < edges[number + 1]) | last)]
        assert (top, middle) == (errors.max(), np.sort(errors)[len(errors) // 2])
    assert len(filled) > 3


def test_variants_of_a_method_differ_in_their_line_alone() -> None:
    pairs = [("newton", "newton[A=1]"), ("sturm", "sturm"), ("newton", "newton[A=2]"), ("newton", "newton[A=1]")]
    marks = style.variant_marks(pairs)
    one, two = marks["newton[A=1]"], marks["newton[A=2]"]
    own = style.marks(["newton"])["newton"]
    assert {(mark.color, mark.marker) for mark in (one, two)} == {(own.color, own.marker)}
    assert one.line != two.line and marks["sturm"].line == one.line


def test_a_key_takes_no_more_room_than_there_is() -> None:
    assert canvas.Key([None] * 3, ["a", "b", "c"], 7.0)._columns == 3
    long = canvas.Key([None] * 3, ["x" * 50, "y" * 40, "z" * 40], 7.0)
    assert long._columns == 2, "two lines in the first column, one in the second"
    assert long.height == canvas.Key([None] * 2, ["x" * 100, "y" * 100], 7.0).height


def test_every_method_of_the_suite_has_a_marker_of_its_own() -> None:
    folders = (Path(style.__file__).parents[2] / "methods").glob("*/method.py")
    names = sorted(path.parent.name for path in folders)
    assert set(names) <= set(style._HOUSE)
    markers = [mark.marker for mark in style._HOUSE.values()]
    assert len(markers) == len(set(markers))
    assert style.marks(["newton"])["newton"] == style.marks(names)["newton"], "the same in every report"
