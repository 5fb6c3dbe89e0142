"""What stands above a picture of a gated row is on the picture."""

import matplotlib
import pytest

pairs = pytest.importorskip("reports.drawing.pairs")
FIGURES = "error_p99 0.00010538 → 0.00272971 (allowed 0.000110649), error_max 0.000130792 → 0.00299406"


@pytest.mark.parametrize("text", [FIGURES, "W" * 300, f"mine {FIGURES * 3}"])
def test_a_heading_is_broken_where_the_picture_ends(text):
    with matplotlib.rc_context(pairs.SMALL):
        sheet, _ = pairs._headed([text, text, ""], 840, 100)
        ends = [written.get_window_extent().x1 for written in sheet.drawing.texts]
    assert max(ends) <= 840 - pairs.MARGIN + 2
    assert "".join(w.get_text() for w in sheet.drawing.texts).replace(" ", "") == 2 * text.replace(" ", "")
