"""The report on scenes: what it holds against what, from planted rows."""

import math
from types import SimpleNamespace

import pandas as pd
import pytest

from reports.claims.toledo_tori import crossing
from reports.parts import instance_scenes


def row(variant, ms, error, casts="rays", wrong=0, pixels=0.0, evaluations=10.0):
    return {
        "status": "ok",
        "answers": True,
        "median_ms": ms,
        "samples_ms": [ms] * 8,
        "rounds": str(list(range(8))),
        "session": "one",
        "scene": "pipes",
        "surface": "pipes 9",
        "surface_title": "Nine pipes",
        "comparison": "pipes",
        "view": "v",
        "size": 64,
        "samples_per_pixel": 1,
        "precision": "float32",
        "device": "opengl:x",
        "method": variant.split()[0],
        "parameters": "{}",
        "proxy": "box",
        "normal": "distance",
        "origin": "nearest",
        "variant": variant,
        "label": variant.capitalize(),
        "casts": casts,
        "instances": 9,
        "bytes": int(100 * ms),
        "fragments": 1000,
        "fragments_discarded": 300,
        "pixels_drawn": 600,
        "pixel_error_p50": error / 10,
        "pixel_error_p99": error,
        "wrong_rays": wrong,
        "accuracy_rays": 4096,
        "judged": 4096,
        "undecided": 0,
        "grazing": 0,
        "drowned": 0,
        "other_instance": 0,
        "pixel_tolerance": pixels,
        "evaluations_mean": evaluations,
    }


def sections(rows):
    return instance_scenes.sections(SimpleNamespace(listed=pd.DataFrame(rows)))


def table(rows, title):
    blocks = [block for section in sections(rows) for block in section.details]
    return next(block for block in blocks if getattr(block, "title", "").startswith(title))


def test_the_fastest_that_keeps_the_error_stands_for_its_kind():
    rows = [
        row("newton", 10.0, 0.0005),
        row("hasty", 5.0, 0.05),
        row("wrong", 1.0, 0.0001, wrong=100),
        row("polygon a", 4.0, 0.5, "mesh"),
        row("polygon b", 40.0, 0.005, "mesh"),
    ]
    lines = {line[1]: line for line in table(rows, "Time and memory").rows}
    assert [lines[1.0][i] for i in (2, 6, 10)] == ["Hasty", "Polygon a", pytest.approx(0.8)]
    assert [lines[0.01][i] for i in (2, 6, 10)] == ["Newton", "Polygon b", pytest.approx(4.0)]
    assert lines[0.001][6] is None
    assert lines[0.01][9] == 4000
    text, short = sections(rows)[0].blocks
    assert "on Nine pipes, under 0.0100 pixels, Newton takes 10.0 ms, and Polygon b takes 4.00× that" in text.text
    assert [row[:4] for row in short.rows] == [("Nine pipes", 0.01, "Newton", 10.0)]


def test_times_of_different_rounds_make_no_ratio():
    rows = [row("newton", 10.0, 0.0005), row("polygon b", 40.0, 0.005, "mesh")]
    rows[0]["session"] = "another"
    (line, *_) = table(rows, "Time and memory").rows
    assert line[6] == "Polygon b" and math.isnan(line[10])


def test_a_tolerance_is_held_against_the_same_knobs_without_it():
    rows = [row("newton", 10.0, 0.001), row("newton to 1 pixels", 8.0, 0.7, pixels=1.0, evaluations=4.0, wrong=3)]
    (line,) = table(rows, "Tolerances").rows
    assert line[4] == pytest.approx(0.6)
    assert line[7] == pytest.approx(0.2)
    assert line[-2:] == (0, 3)
    _, matrix = next(section.blocks for section in sections(rows) if section.name == "Tolerances")
    assert matrix.columns == ("1 pixels",)
    ((heading, (square,)),) = matrix.rows
    assert (heading, square.text) == ("Nine pipes: Newton", "20 %, +3 wrong")


def test_the_crossing_is_where_the_lead_stays():
    slow = pd.Series({1: 1.0, 10: 10.0, 100: 100.0})
    assert crossing(pd.Series({1: 10.0, 10: 10.0 / math.sqrt(10), 100: 10.0}), slow) == pytest.approx(10 ** (2 / 3))
    assert crossing(pd.Series({1: 0.5, 10: 5.0, 100: 10.0}), slow) == 1.0
    assert crossing(pd.Series({1: 0.5, 10: 5.0, 100: 200.0}), slow) is None
