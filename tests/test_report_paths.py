"""A camera's path in a report, on rows whose figures are known beforehand."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from harness.scenes.views import PathChoice, along_path
from reports import content
from reports.drawing import style
from reports.parts import camera_paths, view_dependence
from tests.synthetic_run import printed
from tests.test_report_views import framed, viewed

MARKS = style.variant_marks(
    [
        ("ray_march", "ray_march"),
        ("newton", "newton[EPSILON=0.001]"),
        ("null", "null"),
        ("newton", "newton[EPSILON=1e-06]"),
    ]
)


def test_a_path_tells_frames_per_second_in_all_in_the_median_and_in_the_worst_frame(tmp_path: Path) -> None:
    views = along_path(PathChoice(frames=5))
    cells = [viewed("ray_march", view, 40.0 if i == 2 else 10.0, wrong=i) for i, view in enumerate(views)]
    cells += [viewed("newton[EPSILON=0.001]", view, 20.0) for view in views]
    cells += [viewed("null", view, 1.0) for view in views]
    cells += [viewed("newton[EPSILON=1e-06]", view, 1.0) for view in views[:4]]
    frame = framed(tmp_path / "run", *cells)
    (section,) = camera_paths.sections(SimpleNamespace(frame=frame, marks=MARKS))
    told, figure, table = section.blocks
    assert isinstance(figure, content.Figure) and isinstance(table, content.Table) and not section.details
    assert [row[0] for row in table.rows] == ["Null", "Ray march", "Newton, ε = 0.001"], "the most frames first"
    null, march, newton = table.rows
    assert march[1:4] == pytest.approx((5e3 / 80.0, 100.0, 25.0)) and march[4:6] == ("frame 3", 4.0)
    assert newton[1:4] == pytest.approx((50.0, 50.0, 50.0))
    assert (march[6], newton[6], null[6:]) == (10, 0, (None, None, None))
    assert "(4 of 5)" in printed((table,)) and "Each frame is drawn by itself" in printed((told,))
    assert ">frame<" in figure.svg and figure.svg.count("Ray march") >= 1


def test_frames_of_a_path_are_no_views_whose_spread_is_told(tmp_path: Path) -> None:
    cells = [viewed("ray_march", view, 10.0) for view in along_path(PathChoice(frames=4))]
    frame = framed(tmp_path / "run", *cells)
    assert view_dependence.sections(SimpleNamespace(frame=frame)) == []
    others = frame.assign(view_set="mine")
    assert camera_paths.sections(SimpleNamespace(frame=others, marks=MARKS)) == []
