"""Recommendations on formulas that are in no config, held against the oracle on views they were not chosen by."""

import dataclasses

import numpy as np
import pytest

import surfaces
from harness import ROOT
from harness.accuracy.judge import Wrong, judge
from harness.cli import main
from harness.contract import FirsthitError, View
from harness.devices.executor import LocalExecutor
from harness.oracle import first_hits
from harness.plugins import Catalog, find_methods
from harness.recommend import candidates, search, telling
from harness.recommend.model import Cause, Contender, Fallen, Recommendation, Wish
from harness.recommend.search import Search, certified_error
from harness.results.lock import Lock
from harness.running.run import Watcher
from harness.scenes.camera import camera_for, rays_of, scene_radius

from .conftest import all_round, opened, usable_devices
from .test_devices import cast

pytestmark = pytest.mark.usefixtures("devices_found_once")

FORMULAS = {
    "rounded cube": ("x^4 + y^4 + z^4 - 0.7", "sphere:1.5"),
    "cassinian": ("(x^2 + y^2 + z^2)^2 - 2*(x^2 - y^2) - 0.3", "sphere:1.8"),
    "boxed cubic": ("x^3 + y^3 + z^3 + 0.2*x*y*z - 0.5", "box:1,1,1"),
    "waves": ("sin(3*x) + sin(3*y) + sin(3*z)", "sphere:1.5"),
    "bulged ball": ("x^6 + y^6 + z^6 + x^2*y^2 - 0.8", "sphere:1.5"),
}
METHODS = ("newton", "interval_march", "eft_yuksel")
ERROR = 1e-4


@pytest.fixture
def info():
    if not usable_devices():
        pytest.skip("no device")
    return next(info for info in usable_devices() if info.name == all_round())


def _search(tmp_path, info, surface, methods=METHODS, pictured=False, **wished):
    plugins = find_methods().plugins
    wish = Wish(surface, ERROR, size=64, views=2, rays=32, seconds=0.02)
    executor = LocalExecutor(60.0)
    try:
        catalog = Catalog({name: plugins[name] for name in methods})
        with Lock(tmp_path, "t") as lock:
            asked = dataclasses.replace(wish, **wished)
            return Search(asked, catalog, info, executor, lock, Watcher()).run(pictured)
    finally:
        executor.close()


@pytest.mark.one_in(10)
@pytest.mark.parametrize("name", FORMULAS)
def test_the_recommended_variant_holds_on_views_it_was_not_chosen_by(tmp_path, info, name):
    formula, domain = FORMULAS[name]
    assert all(formula not in path.read_text() for path in (ROOT / "configs").glob("*.toml"))
    surface = surfaces.from_formula(formula, domain)
    found = _search(tmp_path, info, surface)
    assert found.contenders, [fallen.why for fallen in found.fallen]
    best = found.contenders[0]
    assert [c.ms for c in found.contenders] == sorted(c.ms for c in found.contenders)
    assert best.error <= ERROR / 2
    for view in (View("unseen", azimuth=17, elevation=8), *candidates.views(2, seed=12345)):
        rays = rays_of(camera_for(view, surface), 32)
        truth = first_hits(surface, rays)
        hits = cast(
            opened(info.name), best.variant.method, surface, best.precision, rays, **dict(best.variant.parameters)
        )
        verdicts = judge(hits, truth, scene_radius(surface), 1e-3)
        clear = ~verdicts.grazing
        assert (verdicts.wrong[clear] == Wrong.RIGHT).all(), view
        widths = truth.upper - truth.lower
        assert np.nanmax((verdicts.error + widths)[clear], initial=0.0) <= ERROR, view


def test_every_candidate_is_recommended_or_told_why_it_fell(tmp_path, info):
    surface = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1")
    methods = ("newton", "sphere_tracing", "interval_march")
    found = _search(tmp_path, info, surface, methods, precision="float32", fps=1e6)
    told = [fallen.variant for fallen in found.fallen] + [c.variant for c in found.contenders]
    plugins = find_methods().plugins
    assert sorted(map(str, told)) == sorted(map(str, candidates.variants(Catalog({m: plugins[m] for m in methods}))))
    refused = next(fallen for fallen in found.fallen if fallen.variant.method == "sphere_tracing")
    assert refused.cause is Cause.REFUSED and "states no distance" in refused.why
    loose = next(fallen for fallen in found.fallen if str(fallen.variant) == "newton[EPSILON=0.03]")
    assert loose.cause is Cause.ERROR and loose.error > ERROR / 2
    assert loose.why.startswith("has a max error of ")
    assert not found.contenders, "no device here draws a million frames per second"
    slow = [fallen for fallen in found.fallen if fallen.cause is Cause.FRAMES]
    assert any("frames/s at 64x64, not the 1e+06 asked for" in fallen.why for fallen in slow)
    assert min(fallen.times for fallen in slow) == 1.0
    told = {one.method: one.sentence for one in telling.others(found, Wish(surface, ERROR, fps=1e6))}
    assert set(told) == set(methods), "a sentence for each method"
    assert told["sphere_tracing"].startswith("sphere_tracing cannot draw the surface here: ")
    assert all(sentence.endswith(".") and sentence.count("\n") == 0 for sentence in told.values())


def test_a_variant_that_could_not_be_timed_is_told_of(tmp_path, info, monkeypatch):
    surface, rows = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1"), Search._rows

    def untimed(self, of, precision, view, size, seconds=None, rays=None):
        found = rows(self, of, precision, view, size, seconds, rays)
        return {v: row | ({"time": None} if v.parameters == of[0].parameters else {}) for v, row in found.items()}

    monkeypatch.setattr(Search, "_rows", untimed)
    found = _search(tmp_path, info, surface, ("newton",), precision="float32")
    told = [fallen.variant for fallen in found.fallen] + [c.variant for c in found.contenders]
    assert len(told) == len(candidates.variants(Catalog({"newton": find_methods().get("newton")})))
    assert any("could not be timed" in fallen.why for fallen in found.fallen)


def test_only_methods_that_make_the_claims_and_whose_answers_do_not_disprove_them_are_tried(
    tmp_path, info, monkeypatch
):
    surface, wanted = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1"), {"require": ("no_missed_root",)}
    methods = ("newton", "interval_march")
    found = _search(tmp_path, info, surface, methods, precision="float32", **wanted)
    assert {contender.variant.method for contender in found.contenders} == {"interval_march"}
    assert "no_missed_root" in found.contenders[0].claims and not found.contenders[0].disproved
    fell = {fallen.cause for fallen in found.fallen if fallen.variant.method == "newton"}
    assert fell == {Cause.CLAIM}
    monkeypatch.setattr("harness.recommend.search.disproved", lambda claim, _: claim == "no_missed_root")
    found = _search(tmp_path, info, surface, methods, precision="float32", **wanted)
    assert not found.contenders
    assert any("which its answers on view 1 of seed 1 disprove" in fallen.why for fallen in found.fallen)
    best = _search(tmp_path, info, surface, ("interval_march",), precision="float32").contenders[0]
    assert best.disproved == ("no_missed_root",)
    assert "But answers of this search disprove no_missed_root." in telling.guarantee(best)


def test_the_next_fastest_have_their_turn_where_none_of_the_fastest_holds(tmp_path, info, monkeypatch):
    surface, reason = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1"), Search._reason
    monkeypatch.setattr(search, "CONTENDERS", 1)
    fell = []

    def falls(self, variant, precision, row):
        if "2 of" in row["view"] and len(fell) < 2:  # a view held out
            fell.append(variant)
            return Fallen(variant, precision, Cause.WRONG, "answers rays wrongly")
        return reason(self, variant, precision, row)

    monkeypatch.setattr(Search, "_reason", falls)
    found = _search(tmp_path, info, surface, ("newton",), precision="float32", views=1)
    assert len(fell) == 2 and [c.variant for c in found.contenders] and found.contenders[0].variant not in fell
    told = [fallen.variant for fallen in found.fallen] + [c.variant for c in found.contenders]
    assert len(set(told)) == len(told) == len(candidates.variants(Catalog({"newton": find_methods().get("newton")})))
    assert {fallen.cause for fallen in found.fallen} >= {Cause.SLOW, Cause.WRONG}


def test_what_does_not_hold_on_its_picture_is_not_recommended(tmp_path, info, monkeypatch):
    surface, reason = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1"), Search._reason
    monkeypatch.setattr(search, "PICTURE_RAYS", 24)
    found = _search(tmp_path, info, surface, ("newton", "yuksel"), pictured=True)
    first = found.contenders[0]
    assert found.picture["accuracy"]["rays"] == 24 * 24 and (tmp_path / found.picture["arrays"]).exists()

    def falls(self, variant, precision, row):
        if row["view"] == "picture" and variant == first.variant:
            return Fallen(variant, precision, Cause.WRONG, "answers rays wrongly on view picture")
        return reason(self, variant, precision, row)

    monkeypatch.setattr(Search, "_reason", falls)
    again = _search(tmp_path, info, surface, ("newton", "yuksel"), pictured=True)
    assert again.contenders[0].variant != first.variant
    assert again.picture["variant"] == str(again.contenders[0].variant)
    assert first.variant in [fallen.variant for fallen in again.fallen if fallen.cause is Cause.WRONG]


def test_stored_rows_are_used_again(tmp_path, info):
    surface = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1")
    first = _search(tmp_path, info, surface, ("newton",))
    written = {path: path.stat().st_mtime_ns for path in (tmp_path / "cells").iterdir()}
    assert _search(tmp_path, info, surface, ("newton",)).contenders == first.contenders
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "cells").iterdir()} == written


def test_times_of_an_earlier_search_are_not_compared_with_new_ones(tmp_path, info):
    wish, plugins = Wish(surfaces.get("sphere"), ERROR), find_methods().plugins
    catalog = Catalog({name: plugins[name] for name in ("newton", "yuksel")})
    newton, yuksel = (catalog.get(name).variant({}) for name in catalog.plugins)
    executor = LocalExecutor(60.0)
    try:
        with Lock(tmp_path, "t") as lock:
            made = Search(wish, catalog, info, executor, lock, Watcher())
            earlier = made._rows([newton], "float32", View("front"), 16, 0.01, 8)
            both = made._rows([newton, yuksel], "float32", View("front"), 16, 0.01, 8)
            assert made._rows([newton, yuksel], "float32", View("front"), 16, 0.01, 8) == both, "stored, and not again"
    finally:
        executor.close()
    sessions = {row["time"]["session"] for row in both.values()}
    assert len(sessions) == 1 and earlier[newton]["time"]["session"] not in sessions


@pytest.mark.parametrize(("factor", "alike"), [(1.0, True), (1.2, False)])
def test_what_is_not_told_apart_from_the_fastest_is_said(tmp_path, info, factor, alike):
    wish, catalog = Wish(surfaces.get("sphere"), ERROR), find_methods()
    newton, yuksel = (catalog.get(name).variant({}) for name in ("newton", "yuksel"))
    made = Search(wish, catalog, info, None, Lock(tmp_path, "t"), Watcher())
    for view in range(2):
        ups = [1.0 + 0.01 * (-1) ** (at + at // 2) for at in range(8)]
        made._times.append({newton: {"rounds": [*range(8)], "samples_ms": [1.0 + view] * 8}})
        made._times[-1][yuksel] = {"rounds": [*range(8)], "samples_ms": [factor * (1.0 + view) * up for up in ups]}
    assert made._alike(yuksel, newton) is alike
    contenders = [Contender(one, "float32", ms, 1e-6, 9.0) for one, ms in ((newton, 1.0), (yuksel, factor))]
    found = Recommendation(info, contenders, alike=[yuksel] if alike else [])
    assert ("Its time is not told apart from that of yuksel." in telling.answer(found, wish)) is alike


def test_float64_is_tried_where_no_float32_variant_holds(tmp_path, info):
    if not info.float64:
        pytest.skip("the device has no float64")
    surface = surfaces.from_formula("x^2 + 2*y^2 + z^2 - 1")
    found = _search(tmp_path, info, surface, ("newton", "yuksel"), error=1e-9)
    assert {fallen.precision for fallen in found.fallen} >= {"float32"}
    assert all(contender.precision == "float64" for contender in found.contenders)
    assert found.contenders, [fallen.why for fallen in found.fallen]


def test_candidates_bind_every_sweep_and_setting_once():
    catalog = find_methods()
    found = candidates.variants(catalog)
    assert len({(v.method, v.parameters) for v in found}) == len(found)
    for plugin in catalog.plugins.values():
        if plugin.method.answers and plugin.method.casts == "rays":
            mine = {v.parameters for v in found if v.method == plugin.method.name}
            assert plugin.variant({}).parameters in mine
            assert all(plugin.setting(name).parameters in mine for name in plugin.method.settings)
            for parameter in plugin.method.parameters:
                assert {dict(p)[parameter.name] for p in mine} >= set(parameter.sweep)
    assert not any(v.method == "null" for v in found)


@pytest.mark.parametrize("count", [1, 3, 8])
def test_views_surround_the_surface_and_follow_the_seed(count):
    made = candidates.views(count, 4)
    assert made == candidates.views(count, 4) != candidates.views(count, 5)
    assert len({view.name for view in made}) == count
    if count == 8:
        assert min(view.elevation for view in made) < -35.0
        assert max(view.elevation for view in made) > 35.0


def test_the_certified_error_holds_the_certificates_own_width():
    accuracy = {"error": {"max": 0.25, "p99": None}, "certified_width": 0.125}
    assert certified_error(accuracy, "max") == 0.375
    assert certified_error(accuracy, "p99") is None, "no hit was measured, so that no error is kept"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--surface", "spere", "--error", "1"), "did you mean sphere"),
        (
            ("--surface", "sphere", "--error", "1", "--device", "opencl:none"),
            "there is no device 'opencl:none' here; known: open",
        ),
        (("--formula", "x + ", "--error", "1"), "x + "),
        (("--surface", "sphere", "--error", "1", "--require", "no_mised_root"), "did you mean 'no_missed_root'"),
        (("--surface", "sphere", "--error", "1", "-o", "page.doc"), "name it page.pdf"),
        (("--surface", "sphere", "--error", "1", "-o", "no/page.pdf"), "no such folder"),
    ],
)
def test_mistakes_are_one_line(tmp_path, capsys, arguments, words):
    assert main(["recommend", "--runs", str(tmp_path), *arguments]) in (2, 3)
    err = capsys.readouterr().err
    assert words in err
    assert err.count("\n") == 1 or "^" in err


def test_a_search_without_time_is_refused():
    with pytest.raises(FirsthitError, match=r"seconds: 0\.0 is outside"):
        Wish(surfaces.get("sphere"), ERROR, seconds=0.0)


def test_a_disturbance_makes_no_variant_fall_before_it_is_timed_well(tmp_path, info, monkeypatch):
    wish, catalog = Wish(surfaces.get("sphere"), ERROR, views=1), find_methods()
    newton, yuksel, sturm = variants = [catalog.get(name).variant({}) for name in ("newton", "yuksel", "sturm")]
    times = {newton: [1.0] * 8, yuksel: [0.9, 0.9, *[3.0] * 6], sturm: [2.1] * 8}
    asked = []

    def rows(_, of, __, view, size, seconds):
        asked.append(tuple(of))
        assert view and size and seconds
        stated = {v: {"rounds": [*range(8)], "median_ms": float(np.median(times[v]))} for v in of}
        return {v: {"time": {"samples_ms": times[v], **stated[v]}} for v in of}

    monkeypatch.setattr(Search, "_rows", rows)
    made = Search(wish, catalog, info, None, Lock(tmp_path, "t"), Watcher())
    _, slow = made._race(list(variants), "float32", Recommendation(info), dict.fromkeys(variants, (1e-6, 9.0)))
    assert asked == [tuple(variants), (newton, yuksel)], "nothing proves that yuksel takes twice as long"
    assert [fallen.variant for fallen in slow] == [sturm] and slow[0].times == 2.1
