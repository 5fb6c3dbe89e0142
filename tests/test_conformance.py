"""Every method × accepted surfaces × devices × precisions (harness/conformance); a new folder is covered at
once.

Typical surfaces are checked in each precision, other accepted surfaces and settings of the papers in one of these, in
turn; all of them from all views.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable

import numpy as np
import pytest

import surfaces
from harness import conformance
from harness.accuracy.judge import deviations, judge, summarize, wrong_share
from harness.conformance import (
    Bench,
    Finding,
    dense,
    examine,
    examine_knobs,
    examine_touches,
    refusal,
    view_case,
    views_case,
)
from harness.conformance.examine import own_settings
from harness.contract import PRECISIONS, Precision, RayStatus
from harness.devices.interface import Device
from harness.plugins import find_methods
from harness.scenes.camera import scene_radius

from .conftest import all_round, opened, rotation, usable_devices
from .test_devices import cast

METHODS = [n for n, plugin in find_methods().plugins.items() if plugin.method.answers and plugin.method.casts == "rays"]
DEVICES = [info.name for info in usable_devices()]


def bench_on(device: Device) -> Bench:
    def run(check):
        return check.run(device, [device.build(program) for program in check.programs])

    return Bench(device.info.name, device.language, device.info.float64, run)


def hold(findings: Iterable[Finding]) -> None:
    """Fails with every finding that says no; one of none at all, or of nothing measured, would hold nothing."""
    found = list(findings)
    assert any(f.unchecked is None for f in found)
    assert not [f"{f.check}: {f.value:g} > {f.limit:g}, {f.rule}: {f.detail}" for f in found if f.fails]


def plugin_for(method: str, surface: surfaces.Surface, precision: Precision, bench: Bench):
    plugin = find_methods().get(method)
    if reason := refusal(plugin, surface, precision, bench):
        pytest.skip(reason)
    return plugin


@pytest.mark.one_in(4)
@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("surface_name", conformance.TYPICAL)
@pytest.mark.parametrize("method", METHODS)
def test_method_conforms_on_typical_surfaces(device, method, surface_name, precision):
    bench, surface = bench_on(device), surfaces.get(surface_name)
    hold(examine(bench, plugin_for(method, surface, precision, bench), views_case(surface), precision))


@pytest.mark.one_in(2)
@pytest.mark.parametrize("precision", PRECISIONS)
def test_tiles_conform_on_a_typical_surface_as_frames(precision):
    bench, surface = bench_on(opened(all_round())), surfaces.get("torus")
    hold(examine(bench, plugin_for("tiles", surface, precision, bench), views_case(surface), precision))


def test_tiles_conform_on_a_dense_polynomial_as_small_frames():
    bench, case = bench_on(opened(all_round())), dense.case_of(5, dense.seed_of(5), 100)
    found = list(examine(bench, plugin_for("tiles", case.surface, "float32", bench), case, "float32"))
    assert any(finding.check == "no_false_hit" and finding.holds for finding in found)
    hold(found)


def test_tiles_by_intervals_conform_where_f_is_no_polynomial():  # test_tiles_interval casts on every device
    bench, surface = bench_on(opened(all_round())), surfaces.get("blinn_blob")
    found = list(
        examine(bench, plugin_for("tiles_interval", surface, "float32", bench), views_case(surface), "float32")
    )
    assert any(finding.check == "no_missed_root" and finding.holds for finding in found)
    hold(found)


def _other_pairs() -> list[tuple[str, str]]:
    others = [name for name in surfaces.names() if name not in conformance.TYPICAL]
    plugins = find_methods().plugins
    return [(m, s) for s in others for m in METHODS if plugins[m].method.accepts(surfaces.get(s)) is None]


PLACES = [(name, precision) for precision in PRECISIONS for name in DEVICES]
OTHERS = [(*pair, *place) for pair, place in rotation(_other_pairs(), PLACES)]


@pytest.mark.one_in(16)
@pytest.mark.parametrize(("method", "surface_name", "device_name", "precision"), OTHERS)
def test_method_conforms_on_every_other_surface_in_turn(method, surface_name, device_name, precision):
    bench, surface = bench_on(opened(device_name)), surfaces.get(surface_name)
    hold(examine(bench, plugin_for(method, surface, precision, bench), views_case(surface), precision))


def _settings() -> list[tuple[str, str, str]]:
    """Every setting of the papers on every typical surface that its method accepts."""
    plugins = [find_methods().get(name) for name in METHODS]
    return [
        (plugin.method.name, setting, name)
        for plugin in plugins
        for setting in own_settings(plugin)
        for name in conformance.TYPICAL
        if plugin.method.accepts(surfaces.get(name)) is None
    ]


SETTINGS = [(*one, *place) for one, place in rotation(_settings(), PLACES)]


@pytest.mark.one_in(4)
@pytest.mark.parametrize(("method", "setting", "surface_name", "device_name", "precision"), SETTINGS)
def test_the_papers_settings_conform_in_turn(method, setting, surface_name, device_name, precision):
    bench, surface = bench_on(opened(device_name)), surfaces.get(surface_name)
    hold(examine(bench, plugin_for(method, surface, precision, bench), views_case(surface), precision, setting))


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("method", [m for m in METHODS if "finds_touch" in find_methods().get(m).method.claims])
def test_touches_are_found_where_that_is_claimed(device, method, precision):
    if precision == "float64" and not device.info.float64:
        pytest.skip("the device has no float64")
    hold(examine_touches(bench_on(device), find_methods().get(method), precision))


SWEEPING = [m for m in METHODS if any(p.finer for p in find_methods().get(m).method.parameters)]


@pytest.mark.one_in(2)
@pytest.mark.parametrize("method", SWEEPING)
def test_finer_knobs_lower_the_error(method):
    hold(examine_knobs(bench_on(opened(DEVICES[0])), find_methods().get(method)))


# What the checks would see


def _case_and_hits(method="ray_march"):
    case = view_case(surfaces.get("torus"))
    bench = bench_on(opened(DEVICES[0]))
    return case, bench.cast(find_methods().get(method), case, "float32")


def test_each_check_sees_what_it_is_for():
    case, hits = _case_and_hits()
    plugin = find_methods().get("ray_march")
    clear = case.judged(hits, "float32").clear
    there = np.flatnonzero(clear & (hits.status == 1))[:3]
    gone = np.flatnonzero(clear & (hits.status == 0))[:1]

    def changed(rows, **values):
        fields = {name: array.copy() for name, array in vars(hits).items()}
        for name, value in values.items():
            fields[name][rows] = value(fields[name][rows])
        return dataclasses.replace(hits, **fields)

    missed = changed(there, status=lambda s: 0 * s, t=lambda t: np.nan * t)
    later = changed(there, t=lambda t: t + 1.0)
    off = changed(there, t=lambda t: t + 1e-4)
    invented = changed(gone, status=lambda s: s + 1, t=lambda t: np.full_like(t, case.rays[gone, :3].max()))
    outside = changed(there, t=lambda t: t + 100.0)
    for check, broken in (
        (conformance.no_missed_root, missed),
        (conformance.no_missed_root, later),
        (conformance.conservative_bound, missed),
        (conformance.conservative_bound, later),
        (conformance.no_false_hit, invented),
        (conformance.error_below_tolerance, off),
    ):
        assert check(plugin, hits, case, "float32", {}).holds, check
        assert check(plugin, broken, case, "float32", {}).fails, check
    assert conformance.answers(hits, case).holds
    assert not conformance.answers(outside, case).holds
    assert conformance.same_bits(hits, hits).holds
    assert not conformance.same_bits(hits, changed(there[:1], t=lambda t: np.nextafter(t, 9.0))).holds
    assert all(finding.holds for finding in conformance.agreement(hits, case, "float32"))
    none = changed(np.arange(len(hits.t)), status=lambda s: 0 * s)
    assert any(finding.fails for finding in conformance.agreement(none, case, "float32"))


def test_giving_up_on_most_rays_is_seen_where_there_is_no_root_to_measure():
    case = view_case(surfaces.get("two_spheres"))
    hits = bench_on(opened(DEVICES[0])).cast(find_methods().get("interval_march"), case, "float32")
    assert not any(finding.fails for finding in conformance.agreement(hits, case, "float32"))
    given_up = dataclasses.replace(hits, status=np.full_like(hits.status, RayStatus.EXHAUSTED), t=np.nan * hits.t)
    assert any(finding.fails for finding in conformance.agreement(given_up, case, "float32"))


def test_a_touch_that_is_missed_is_seen():
    bench = bench_on(opened(DEVICES[0]))
    case = conformance.touch_cases()[2]
    assert len(case.rays) > 20
    hits = bench.cast(find_methods().get("ray_march"), case, "float32")
    assert not conformance.finds_touch(hits, case).holds


def test_a_knob_that_says_the_wrong_way_is_seen():
    plugin = find_methods().get("newton")
    knobs = [dataclasses.replace(p, finer="up") if p.finer else p for p in plugin.method.parameters]
    method = dataclasses.replace(plugin.method, parameters=tuple(knobs))
    found = list(examine_knobs(bench_on(opened(DEVICES[0])), dataclasses.replace(plugin, method=method)))
    assert [finding.holds for finding in found] == [False, False]


def test_null_finds_nothing(device):
    case = view_case(surfaces.get("sphere"))
    hits = cast(device, "null", case.surface, "float32", case.rays)
    assert not hits.status.any()
    assert not hits.evaluations.any()


def test_newton_forward_steps_cure_the_rays_that_signed_steps_lose(device):
    """The change that methods/newton states: same rays, the printed step against ours."""
    case = view_case(surfaces.get("torus"))
    wrong = {}
    for forward in (0, 1):
        hits = cast(device, "newton", case.surface, "float32", case.rays, FORWARD=forward)
        verdicts = judge(hits, case.truth, scene_radius(case.surface), 1e-3)
        found = deviations(case.surface, case.rays, hits, case.truth, verdicts)
        summary = summarize(
            case.surface, hits, case.truth, verdicts, found, precision="float32", footprint=0.01, grazing_margin=1e-3
        )
        wrong[forward] = wrong_share(summary)
    assert wrong[1] == 0.0
    assert wrong[0] > 0.05
