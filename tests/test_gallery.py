"""Claims about false hits held on a gallery of the literature: views, random rays, and rays past thin tails and
singular points. FIRSTHIT_RAYS sets how many rays in all; where it is set, every method is held on every surface.
"""

from __future__ import annotations

import os
from functools import cache

import numpy as np
import pytest

import surfaces
from harness.accuracy.judge import Wrong, judge
from harness.conformance import Case, no_false_hit, refusal, rounding_adds
from harness.conformance.checks import CLAIM_CHECKS
from harness.contract import TruthStatus
from harness.kernels.functions import unsupported
from harness.oracle import first_hits
from harness.oracle.noise import root_shift
from harness.plugins import Plugin, find_methods
from harness.scenes.camera import scene_radius

from .conftest import opened, usable_devices
from .gallery import aimed, anywhere, held, surface_named, tails, view_rays
from .test_conformance import bench_on
from .test_devices import cast

DEFAULT_RAYS = 40_000
RAYS = int(os.environ.get("FIRSTHIT_RAYS", DEFAULT_RAYS))
NAMES = held()
METHODS = find_methods()
GRAZING = 1e-3
CLAIMING = [
    name
    for name, plugin in METHODS.plugins.items()
    if "no_false_hit" in plugin.method.claims and plugin.method.casts == "rays"
]
PLACES = [(info.name, precision) for precision in ("float32", "float64") for info in usable_devices()]
QUASTE_RAY = np.array(
    [[5.781935691833496, 3.3382019996643066, 3.854623794555664,
      -0.6479199528694153, -0.4282451570034027, -0.6299252510070801]], np.float32)  # fmt: skip
TAIL_RAYS = 2_000  # 11,000 is the experiment that brought the class about


def rays_for(surface, count, rng):
    """Half past the surface's tails, a quarter anywhere, the rest of the oblique view."""
    side = max(8, int((count / 4) ** 0.5))
    parts = (aimed(surface, tails(surface), count // 2, rng), anywhere(surface, count // 4, rng))
    return np.concatenate((*parts, view_rays(surface, side)))


def accepted(surface):
    return [name for name in CLAIMING if METHODS.get(name).method.accepts(surface) is None]


def false_hits(surface, rays, truth, method, device, precision):
    """Masks bool[n] of false hits on clear and on drowned rays."""
    verdicts = judge(cast(device, method, surface, precision, rays), truth, scene_radius(surface), GRAZING, precision)
    false = verdicts.wrong == Wrong.FALSE_HIT
    return false & verdicts.clear, false & verdicts.drowned


def test_what_claims_are_held_on_is_large_and_of_many_degrees():
    assert len(NAMES) >= 78
    assert {surface_named(name).degree for name in NAMES} >= {3, 4, 5, 6, 7, 8, 9, 12, 20, None}


@pytest.mark.parametrize("name", NAMES)
def test_the_oracle_decides_every_gallery_surface_in_view(name):
    surface = surface_named(name)
    truth = first_hits(surface, view_rays(surface, 24))
    assert (truth.status == TruthStatus.CROSSING).mean() > 0.02
    assert (truth.status == TruthStatus.UNDECIDED).sum() == 0


def _turns():
    """A surface with one method in one place, in turn; with FIRSTHIT_RAYS with every method."""
    turn = 0
    for k, name in enumerate(NAMES):
        methods = accepted(surface_named(name))
        chosen = methods if RAYS != DEFAULT_RAYS else methods[k % len(methods) :][:1]
        for method in chosen:
            yield (name, method, *PLACES[turn % len(PLACES)])
            turn += 1


@pytest.mark.one_in(8)
@pytest.mark.parametrize(("name", "method", "device_name", "precision"), list(_turns()) if PLACES else [])
def test_no_false_hit_on_clear_rays_of_the_gallery(name, method, device_name, precision):
    surface, device = surface_named(name), opened(device_name)
    if reason := unsupported(surface, precision, device.language):
        pytest.skip(reason)
    rays = rays_for(surface, RAYS // len(NAMES), np.random.default_rng(len(surface.formula)))
    truth = first_hits(surface, rays)
    false, _ = false_hits(surface, rays, truth, method, device, precision)
    at = np.flatnonzero(false)
    assert not len(at), (
        f"{len(at)} false hits: ray {rays[at[0]].tolist()}, margin {truth.margin[at[0]]:.2g}, "
        f"contrast {truth.contrast[at[0]]:.2g}"
    )


def claims_in_turn():
    """Every surface with one method that claims something, on one device in one precision, in turn."""
    chosen = []
    stating = [m for m, plugin in METHODS.plugins.items() if plugin.method.claims & CLAIM_CHECKS.keys()]
    casting = [m for m in stating if METHODS.get(m).method.casts == "rays"]
    for i, name in enumerate(NAMES):
        able = [m for m in casting if METHODS.get(m).method.accepts(surface_named(name)) is None]
        chosen += [(name, able[i % len(able)], *PLACES[(i // 2) % len(PLACES)])] if able and PLACES else []
    return chosen


@pytest.mark.one_in(8)
@pytest.mark.parametrize(("name", "method", "device_name", "precision"), claims_in_turn())
def test_claims_hold_on_the_gallery(name, method, device_name, precision):
    surface, plugin, bench = surface_named(name), METHODS.get(method), bench_on(opened(device_name))
    if reason := refusal(plugin, surface, precision, bench):
        pytest.skip(reason)
    rays = rays_for(surface, 400, np.random.default_rng(3))
    case = Case(surface, rays, first_hits(surface, rays))
    hits = bench.cast(plugin, case, precision)
    found = [CLAIM_CHECKS[claim](plugin, hits, case, precision, {}) for claim in plugin.method.claims & {*CLAIM_CHECKS}]
    assert not [f"{f.check}: {f.value:.3g}, {f.detail}" for f in found if f.fails]


# The surface and the ray that showed what the claim has to leave out


def test_the_ray_that_no_float32_can_know_is_drowned_and_not_grazing(device):
    surface = surface_named("quaste")
    truth = first_hits(surface, QUASTE_RAY)
    assert truth.status[0] == TruthStatus.MISS
    np.testing.assert_allclose(truth.margin[0], 0.0085, rtol=0.01)
    assert 2.0**-53 < truth.contrast[0] < 2.0**-24
    for precision, drowned in (("float32", True), ("float64", False)):
        if precision == "float64" and not device.info.float64:
            continue
        hits = cast(device, "bernstein", surface, precision, QUASTE_RAY)
        verdicts = judge(hits, truth, scene_radius(surface), GRAZING, precision)
        assert verdicts.drowned.tolist() == [drowned]
        assert not verdicts.grazing.any()
        assert drowned or verdicts.wrong[0] == Wrong.RIGHT


@cache
def tail_case(count):
    surface = surface_named("quaste")
    rays = aimed(surface, tails(surface), count, np.random.default_rng(5))
    return rays, first_hits(surface, rays)


@pytest.mark.parametrize("method", accepted(surface_named("quaste")))
def test_every_false_hit_at_the_tail_of_quaste_is_drowned_or_grazing(device, method):
    surface = surface_named("quaste")
    rays, truth = tail_case(max(TAIL_RAYS, RAYS // 20))
    false, _ = false_hits(surface, rays, truth, method, device, "float32")
    assert not false.any()
    outside = truth.margin >= GRAZING * scene_radius(surface)
    drowned = outside & (truth.contrast < 2.0**-23)
    assert 0 < drowned.sum() < 0.06 * len(rays)


def test_the_false_hits_that_the_class_is_about_are_there():
    """If none were left, the class would have nothing to hold: then drop it."""
    surface, device = surface_named("quaste"), opened(usable_devices()[0].name)
    rays, truth = tail_case(11_000)
    _, drowned = false_hits(surface, rays, truth, "ray_march", device, "float32")
    assert drowned.sum() > 5


# What rounding must add to an error


@pytest.mark.parametrize("name", ["geisha", "herz", "miau", "miter"])
def test_an_error_is_within_what_rounding_of_the_expansion_may_move_the_root(name):
    """Where the terms at a root are small and those of the expansion are not, condition says too little."""
    surface, device = surface_named(name), opened(usable_devices()[0].name)
    method = METHODS.get("ray_march")
    rays = rays_for(surface, 2_000, np.random.default_rng(0))
    truth = first_hits(surface, rays)
    verdicts = judge(
        cast(device, "ray_march", surface, "float32", rays), truth, scene_radius(surface), GRAZING, "float32"
    )
    measured = verdicts.clear & np.isfinite(verdicts.error)
    tolerance = method.method.tolerance(surface, dict(method.variant({}).parameters))
    assert (verdicts.error <= tolerance + rounding_adds(Case(surface, rays, truth), "float32"))[measured].all()
    assert measured.sum() > 100


def test_a_roots_shift_is_the_bound_over_the_slope():
    """f = x - 1/2 at its root from x = -3: the bound counts the point's and the difference's roundings."""
    plane = surfaces.from_formula("x - 1/2", "sphere:1")
    rays = np.array([[-3.0, 0.0, 0.0, 1.0, 0.0, 0.0], [-3.0, 0.0, 0.0, 2.0, 0.0, 0.0]])
    shift = root_shift(plane, rays, np.array([3.5, 1.75]))
    np.testing.assert_allclose(shift[0], 2.0 * shift[1])
    assert 0.5 <= shift[0] <= 4.0


# What the class cannot hide

NEAR_ENOUGH = """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    for (int i = 0; i <= 400; i++) {
        real t = t0 + (t1 - t0) * (real(i) / 400.0);
        hit.evaluations += 1;
        if (fabs(surface_value(ray_point(ray, t))) < LEVEL) return hit_at(hit, t);
    }
    return hit;
}
"""
LEVELS = {"torus": 5e-3, "barth_sextic": 1e-2, "quaste": 1e-2}


@pytest.mark.parametrize("name", LEVELS)
def test_a_method_that_takes_a_small_value_for_a_root_is_caught(tmp_path, name):
    (tmp_path / "near_enough").mkdir()
    (tmp_path / "near_enough" / "__init__.py").write_text("")
    (tmp_path / "near_enough" / "kernel.glsl").write_text(NEAR_ENOUGH)
    (tmp_path / "near_enough" / "method.py").write_text(
        "from harness.contract import Method, Parameter\n"
        'METHOD = Method(name="near_enough", source="test", needs=("surface_value",),\n'
        f'    parameters=(Parameter("LEVEL", {LEVELS[name]}, "value that is taken for none"),),\n'
        '    claims=frozenset({"no_false_hit"}))\n'
    )
    plugin: Plugin = find_methods(tmp_path).get("near_enough")
    surface = surface_named(name) if name in NAMES else surfaces.get(name)
    rays = rays_for(surface, 2_000, np.random.default_rng(1))
    case = Case(surface, rays, first_hits(surface, rays))
    hits = bench_on(opened(usable_devices()[0].name)).cast(plugin, case, "float32")
    found = no_false_hit(plugin, hits, case, "float32", {})
    assert found.fails, found.detail
    assert found.value > 3


@pytest.mark.parametrize("name", surfaces.names())
def test_hardly_a_ray_of_the_catalog_is_drowned(name):
    """Nothing is excused by the class on surfaces that are not written to drown."""
    surface = surfaces.get(name)
    rays = np.concatenate((view_rays(surface, 24), anywhere(surface, 500, np.random.default_rng(2))))
    truth = first_hits(surface, rays)
    grazing = truth.margin < GRAZING * scene_radius(surface)
    assert (~grazing & (truth.contrast < 2.0**-23)).mean() <= 1e-3
    assert not (~grazing & (truth.contrast < 2.0**-52)).any()
