"""How a surface lies in its domain, the boxes that are found for it, and who says so."""

from __future__ import annotations

import json
import math
import random
import re

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import FirsthitError
from harness.recommend.model import Recommendation
from harness.recommend.search import Search
from surfaces import formula
from surfaces.model import Box, Sphere, domain_text
from surfaces.proofs.extent import Extent, extent, held_by, remark

from .conftest import usable_devices

CUT = "x^4 + y^4 + z^4 - 1.2*(x^2 + y^2 + z^2) + 0.35"  # reaches x^2 = y^2 = z^2 = (3.6 + sqrt(8.76))/6: r = 1.811


def kind(text: str, domain: str) -> str:
    return extent(surfaces.from_formula(text, domain)).kind


@pytest.mark.parametrize(
    ("text", "domain", "expected"),
    [
        (CUT, "sphere:1.8", "cut"),
        (CUT, "sphere:1.9", "held"),
        (CUT, "box:1.25,1.25,1.25", "held"),  # max x: x^2 = 0.6 + sqrt(0.73)
        (CUT, "box:1.25,1.15,1.25", "cut"),
        ("x^2 + y^2 + z^2 - 1", "box:1.1,1.1,0.5", "cut"),
        ("x^2 + y^2 + z^2 - 1", "sphere:0.1,0,0:1.05", "cut"),
        ("x^2 + y^2 + z^2 - 1", "sphere:0.1,0,0:1.2", "held"),
        ("(x - 4)^2 + y^2 + z^2 - 1", "sphere:1.5", "missed"),
        ("length(x, y, z) - 1", "sphere:0.9", "missed"),
        ("x^2 + y^2 + z^2 + 1", "sphere:1", "empty"),
        ("exp(x) + 1", "sphere:1", "empty"),
        ("(x^2 + y^2 + z^2 - 1)^2", "sphere:2", "held"),  # no sign changes anywhere
        ("if(x^2 + y^2 + z^2 < 1, x^2 + y^2 - 0.1, 1)", "sphere:1.2", "held"),
        # what cannot be told, or is cut on purpose
        ("x^2 + y^2 - 1", "sphere:2", "unknown"),
        ("x^3 - 3*x*y^2 - z", "box:1,1,1", "unknown"),
        ("sin(3*x) + sin(3*y) + sin(3*z)", "sphere:2", "unknown"),
        ("x^2 + y^2 + z^2 - 1", "sphere:1", "unknown"),  # touches from within
        ("x^2 + y^2 + z^2 - 0.49", "sphere:0.7", "unknown"),
        ("floor(x) + 0.5", "sphere:0.5", "unknown"),  # it jumps across 0, which ranges cannot tell from a root
    ],
)
def test_kinds_by_hand(text: str, domain: str, expected: str) -> None:
    assert kind(text, domain) == expected


def test_random_ellipsoids_are_never_told_wrong() -> None:
    """Their box is known: held and cut must be so, by numpy alone; a cut one sticks out by a thousandth or more."""
    pick, told = random.Random(2), 0
    for _ in range(40):
        a = [round(pick.uniform(0.2, 1.5), 2) for _ in range(3)]
        c = [round(pick.uniform(-1.0, 1.0), 2) for _ in range(3)]
        text = " + ".join(f"(({v} - ({m}))/{h})^2" for v, m, h in zip("xyz", c, a, strict=True)) + " - 1"
        domain = f"sphere:{round(pick.uniform(0.5, 3.0), 2)}"
        surface = surfaces.from_formula(text, domain)
        unit = np.random.default_rng(1).normal(size=(20_000, 3))
        reach = np.linalg.norm(c + np.array(a) * unit / np.linalg.norm(unit, axis=1)[:, None], axis=1)
        found, radius = extent(surface), surface.domain.radius
        if found.kind == "held":
            assert reach.max() <= radius * 1.002
        elif found.kind == "cut":
            assert reach.max() > radius and reach.min() < radius
        elif found.kind == "missed":
            assert reach.min() > radius
        elif found.kind == "empty":
            assert math.dist(c, (0, 0, 0)) + max(a) > 4 * radius
        told += found.kind != "unknown"
        if found.box:
            low, high = np.subtract(c, a), np.add(c, a)
            assert (np.array(found.box.lower) <= low).all() and (np.array(found.box.upper) >= high).all()
            assert np.abs(np.subtract(found.box.upper, high)).max() <= 0.05 * 2 * max(a)
    assert told > 30


def test_the_sentences_name_domain_and_box() -> None:
    surface = surfaces.from_formula(CUT, "sphere:1.8", name="mine")
    assert remark(surface) == (
        "mine: its domain sphere:1.8 cuts the surface; the domain box:1.22,1.22,1.22 holds all of it"
    )
    assert remark(surfaces.from_formula(CUT, "box:1.22,1.22,1.22")) is None
    told = remark(surfaces.from_formula("(x - 4)^2 + y^2 + z^2 - 1", "sphere:1.5"))
    assert told and "has nothing of the surface; the domain box:2.98,-1.02,-1.02:5.02,1.02,1.02 holds" in told
    assert "there is no surface" in (remark(surfaces.from_formula("x^2 + y^2 + z^2 + 1")) or "")
    away = remark(surfaces.from_formula("x + y - 4", "sphere:1"))
    assert away and away.endswith("its domain sphere:1 has nothing of the surface: f is 0 nowhere in it")


def test_of_the_catalog_as_it_stands_nothing_is_said_and_of_another_domain_it_is() -> None:
    assert not any(remark(surfaces.get(name)) for name in (*surfaces.names(), *surfaces.forms_of("chmutov")))
    assert remark(surfaces.get("torus", R="2", r="0.1")) is None
    from harness.scenes.choice import cut

    assert "cuts the surface" in (remark(cut(surfaces.get("heart"), "sphere:1")) or "")


@pytest.mark.parametrize(
    ("text", "box"),  # the true box
    [
        ("x^2 + y^2 + z^2 - 1", ((-1, -1, -1), (1, 1, 1))),
        ("(x - 3)^2 + (y + 200)^2 + z^2 - 0.01", ((2.9, -200.1, -0.1), (3.1, -199.9, 0.1))),
        ("sqrt((sqrt(x^2 + y^2) - 0.8)^2 + z^2) - 0.3", ((-1.1, -1.1, -0.3), (1.1, 1.1, 0.3))),
        ("|x| + |y|/2 + |z| = 30", ((-30, -60, -30), (30, 60, 30))),
        ("1/((x - 1)^2 + y^2 + z^2 + 0.19) - 5", ((0.9, -0.1, -0.1), (1.1, 0.1, 0.1))),
        ("if(x > 0, x^2 + y^2 + z^2 - 1, x^2/4 + y^2 + z^2 - 1)", ((-2, -1, -1), (1, 1, 1))),
    ],
)  # fmt: skip
def test_auto_finds_a_tight_box_of_short_decimals(text: str, box: tuple[tuple[float, ...], ...]) -> None:
    found = surfaces.from_formula(text, "auto").domain
    assert isinstance(found, Box)
    lower, upper = map(np.array, box)
    assert (np.array(found.lower) < lower).all() and (np.array(found.upper) > upper).all()
    assert max((lower - found.lower).max(), (found.upper - upper).max()) <= 0.05 * (upper - lower).max()
    assert all(len(number.lstrip("-").replace(".", "")) <= 6 for number in re.split("[,:]", domain_text(found))[1:])
    assert surfaces.from_formula(text, domain_text(found)).domain == found


def test_a_found_box_holds_the_surface_as_float32_too_and_can_be_copied() -> None:
    """Small balls far from the origin, where float32s lie farther apart than a box's short decimals."""
    rng = np.random.default_rng(3)
    for _ in range(8):
        center, radius = rng.uniform(-900, 900, 3).round(4), float(f"{10 ** rng.uniform(-4.5, -1):.3g}")
        text = " + ".join(f"({v} - ({c}))^2" for v, c in zip("xyz", center.tolist(), strict=True))
        found = surfaces.from_formula(f"{text} - {radius}^2", "auto")
        assert isinstance(found.domain, Box) and remark(found) is None
        assert (found.domain.lower < center - radius).all() and (center + radius < found.domain.upper).all()
        assert surfaces.from_formula("x", domain_text(found.domain)).domain == found.domain


@pytest.mark.parametrize("radius", [1e-9, 1e-15, 1e30])
def test_a_box_is_as_large_as_its_surface_whatever_the_scale(radius: float) -> None:
    domain = Sphere(0.9 * radius)
    found = extent(surfaces.from_formula(f"sqrt(x^2 + y^2 + z^2) - {radius}", domain))
    assert found.kind == "missed" and found.box and radius < found.box.upper[0] < 1.05 * radius


def test_a_single_point_off_the_origin_has_a_box() -> None:
    found = extent(surfaces.from_formula("abs(x - 1) + abs(y - 1) + abs(z - 1)", "sphere:1.5"))
    assert found.kind == "missed" and found.box and found.box.lower < (1.0, 1.0, 1.0) < found.box.upper


def test_what_is_written_of_a_domain_makes_the_same_domain() -> None:
    rng = np.random.default_rng(1)
    for _ in range(200):
        a, b, c, d = (float(v) for v in rng.normal(size=4) * 10.0 ** rng.integers(-12, 12))
        box = Box((-abs(d), min(b, a), -abs(c)), (abs(a), max(b, a), abs(b)))
        for domain in (Sphere(abs(d), (a, b, c)), box):
            assert surfaces.from_formula("x", domain_text(domain)).domain == domain
    assert domain_text(Sphere(1.2)) == "sphere:1.2" and domain_text(Box((-1.1, -1, -2), (1.1, 1, 2))) == "box:1.1,1,2"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x^2 + y^2 - 1", "go on without end; give a domain"),
        ("sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)", "go on without end"),
        ("x^2 + y^2 + z^2 + 1", "there is no surface within 1000 of the origin"),
        ("(x - 5000)^2 + y^2 + z^2 - 1", "there is no surface within 1000"),
    ],
)
def test_auto_refuses_what_no_box_holds(text: str, message: str) -> None:
    with pytest.raises(FirsthitError, match=message):
        held_by(formula.parse(text))


@pytest.mark.usefixtures("devices_found_once")
def test_show_and_plan_and_run_and_recommend_say_that_a_surface_is_cut(tmp_path, capsys, monkeypatch) -> None:
    device, told = usable_devices()[0].name, "its domain sphere:1.8 cuts the surface; the domain box:1.22,1.22,1.22"
    one = ["--formula", CUT, "--domain", "sphere:1.8", "--device", device]
    assert main(["show", *one, "--method", "newton", "--size", "16", "-o", str(tmp_path / "a.png")]) == 0
    assert capsys.readouterr().err.count(told) == 1
    config = tmp_path / "cut.toml"
    config.write_text(
        f'title = "Cut"\nsurfaces = ["mine", "whole"]\nsizes = [16]\ndevices = ["{device}"]\n'
        f'[surface.mine]\nformula = "{CUT}"\ndomain = "sphere:1.8"\n'
        f'[surface.whole]\nformula = "{CUT}"\ndomain = "auto"\n'
        '[[method]]\nname = "newton"\n'
        "[accuracy]\nsize = 12\n[budget]\nseconds = 0.001\nrounds = 1\n"
    )
    assert main(["plan", str(config), "--runs", str(tmp_path)]) == 0
    assert capsys.readouterr().err.count(told) == 1
    assert main(["run", str(config), "--runs", str(tmp_path)]) == 0
    assert capsys.readouterr().err.count(told) == 1
    rows = [json.loads(path.read_text()) for path in (tmp_path / "cut" / "cells").glob("*.json")]
    said = {(row["surface"], row["domain"], row["extent"]) for row in rows}
    assert said == {("mine", "sphere:1.8", f"mine: {told} holds all of it"), ("whole", "box:1.24,1.24,1.24", None)}
    monkeypatch.setattr(Search, "run", lambda search, _: Recommendation(search._device))  # which takes minutes
    assert main(["recommend", *one, "--error", "1e-2", "--runs", str(tmp_path)]) == 1
    answered = capsys.readouterr()
    assert answered.err.count(told) == 1
    assert f"{told} holds all of it. The answer is for what" in " ".join(answered.out.split())


def test_a_reports_page_of_a_surface_has_the_note() -> None:
    pytest.importorskip("pandas")
    import pandas as pd

    from reports.drawing.cards import what

    rows = pd.DataFrame({"degree": [2, 2], "formula": ["x", "x"], "extent": ["mine: its domain cuts it", None]})
    assert what(rows, 99) == "Degree 2: x = 0. Note: mine: its domain cuts it."
    assert what(rows.drop(columns="extent"), 99) == "Degree 2: x = 0."
    cut = rows.assign(domain="sphere:0,1,0:1.5", formula="x + y")
    assert what(cut, 4).startswith("Degree 2: x … = 0, in a ball of radius 1.5 about (0,1,0). Note")


def test_big_formulas_are_not_searched() -> None:
    text = " + ".join(f"(x - {i})^2*y" for i in range(2000)) + " + z^2 - 1"
    assert extent(surfaces.from_formula(text, "sphere:2")) == Extent("unknown")
    with pytest.raises(FirsthitError, match="more than 5000 operations"):
        surfaces.from_formula(text, "auto")


def test_domains_about_other_centres_are_read_and_written() -> None:
    domain = surfaces.from_formula("x - 3", "sphere:3,-2,1/2:1.5").domain
    assert domain == Sphere(1.5, (3.0, -2.0, 0.5)) and domain_text(domain) == "sphere:3,-2,0.5:1.5"
    assert domain_text(Box((-1, -2, -0.1), (1, 2, 0.1))) == "box:1,2,0.1"
    for bad in ("sphere:1,2:3", "sphere:1,2,3", "sphere:1,2,3:0", "auto:1"):
        with pytest.raises(FirsthitError):
            surfaces.from_formula("x", bad)


def test_remarks_name_the_domain_with_all_digits() -> None:
    said = remark(surfaces.from_formula("x^2 + y^2 + z^2 - 100", Sphere(10**0.5)))
    assert said and "its domain sphere:3.1622777 has nothing" in said
    for radius in (3.4028234e38, 1e-45):
        assert surfaces.from_formula("x", domain_text(Sphere(radius))).domain == Sphere(radius)


def test_slopes_do_not_bound_what_jumps() -> None:
    """f is 1 outside of a thin slab and x - 0.5 inside of it; its derivatives are 0 nearly everywhere."""
    slab = "if(x > 0.499 && x < 0.501, x - 0.5, 1) + 0*y"
    assert kind(slab, "sphere:1.5") == "unknown"  # it goes on along y and z
    ball = "if((x - 0.5)^2 + y^2 + z^2 < 0.0001, x - 0.5, 1)"
    assert kind(ball, "sphere:1") == "held" and kind(ball, "sphere:0.4") == "missed"
