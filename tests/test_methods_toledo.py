"""What the methods of toledo2007 state about themselves, and copies broken on purpose."""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import surfaces
from harness import hardcases
from harness.accuracy.judge import Wrong, judge
from harness.contract import PRECISIONS, FirsthitError, RayStatus, Section, TruthStatus, View
from harness.devices.interface import hits_from, launch_rays, map_rows
from harness.kernels.assemble import map_program, method_program
from harness.oracle import first_hits
from harness.plugins import find_methods
from harness.scenes.camera import camera_for, rays_of, scene_radius

from .conftest import opened, usable_devices

OBLIQUE = View("oblique", azimuth=30, elevation=35)
LOW = View("18 degrees", azimuth=0, elevation=18)  # one of Table 1's
TOP = View("top", azimuth=30, elevation=90)
ALL_AROUND = View("no view: rays from all sides")
TILTED = {tilt: View(f"tilted by {tilt}", azimuth=0, elevation=90 - tilt, distance=5.584) for tilt in range(0, 91, 18)}


@cache
def _case(name, view, size):
    """Surface, rays, certified truth."""
    surface = surfaces.get(name)
    if view is ALL_AROUND:
        rng = np.random.default_rng(7)
        heading = rng.normal(size=(size * size, 3))
        heading /= np.linalg.norm(heading, axis=1)[:, None]
        feet = rng.uniform(-1.0, 1.0, (size * size, 3)) * scene_radius(surface)
        rays = np.concatenate([feet - 3.0 * heading, heading], axis=1).astype(np.float32)
    else:
        rays = rays_of(camera_for(view, surface), size)
    return surface, rays, first_hits(surface, rays)


def _cast(method, surface, rays, precision="float32", folder=None, **knobs):
    """Hits on the first device here; `folder` may hold another kernel."""
    plugin, device = find_methods().get(method), opened(usable_devices()[0].name)
    program = method_program(
        plugin.method, folder or plugin.folder, plugin.variant(knobs), surface, precision, device.language, "rays"
    )
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return hits


@dataclass(frozen=True)
class Outcome:
    """How rays outside the grazing class were answered: the share wrong, hits of a later root, errors of right hits."""

    rays: int
    wrong: float
    later_roots: int
    errors: NDArray[np.float64]
    exhausted: int
    evaluations: float  # for each ray
    most_evaluations: int


def _outcome(method, name, view, size=96, precision="float32", folder=None, **knobs):
    surface, rays, truth = _case(name, view, size)
    hits = _cast(method, surface, rays, precision, folder, **knobs)
    verdicts = judge(hits, truth, scene_radius(surface), 1e-3)
    clear = ~verdicts.grazing
    return Outcome(
        rays=int(clear.sum()),
        wrong=float(np.mean(verdicts.wrong[clear] != Wrong.RIGHT)),
        later_roots=int(np.sum(verdicts.wrong[clear] == Wrong.WRONG_ROOT)),
        errors=verdicts.error[clear & np.isfinite(verdicts.error)],
        exhausted=int(np.sum(verdicts.wrong[clear] == Wrong.EXHAUSTED)),
        evaluations=float(hits.evaluations.mean()),
        most_evaluations=int(hits.evaluations.max()),
    )


def _p99(outcome):
    return np.quantile(outcome.errors, 0.99)


def _broken(tmp_path, method, right, wrong):
    """A folder with the method's kernel, `right` replaced by `wrong` everywhere."""
    text = (find_methods().get(method).folder / "kernel.glsl").read_text()
    assert right in text
    (tmp_path / "kernel.glsl").write_text(text.replace(right, wrong))
    return tmp_path


# sphere tracing


@pytest.mark.parametrize("name", ["torus", "horn_torus"])
def test_two_starts_find_what_one_finds_from_all_sides(name):
    for rays in (1, 2):
        assert _outcome("sphere_tracing", name, ALL_AROUND, RAYS=rays).wrong == 0.0
    assert _outcome("sphere_tracing", name, ALL_AROUND, RAYS=2, AHEAD=0).wrong == 0.0


def test_a_second_start_that_never_goes_back_spends_less_than_the_printed_one():
    ours, printed = (_outcome("sphere_tracing", "torus", TILTED[0], 128, RAYS=2, AHEAD=k) for k in (1, 0))
    assert ours.evaluations < 0.9 * printed.evaluations


def test_two_starts_take_fewer_steps_near_a_tangency():
    one, two = (_outcome("sphere_tracing", "torus", OBLIQUE, RAYS=rays).most_evaluations for rays in (1, 2))
    assert two < one


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("way = second ? -1.0 : 1.0;", "way = 1.0;"),  # a second start inside does not turn back
        ("turned && second", "turned"),  # ends at the first minimum
    ],
)
def test_broken_second_starts_are_caught(tmp_path, right, wrong):
    folder = _broken(tmp_path, "sphere_tracing", right, wrong)
    assert _outcome("sphere_tracing", "horn_torus", ALL_AROUND, folder=folder).wrong > 0.001


def test_a_smaller_distance_counts_as_a_hit_nearer_to_it():
    errors = [_p99(_outcome("sphere_tracing", "torus", OBLIQUE, EPSILON=e)) for e in (1e-2, 1e-3, 1e-4)]
    assert errors[0] > 5 * errors[1] > 25 * errors[2]


def test_surfaces_without_a_distance_are_refused():
    accepts = find_methods().get("sphere_tracing").method.accepts
    assert accepts(surfaces.get("torus")) is None
    assert "distance" in accepts(surfaces.get("barth_sextic"))


def _steepness(surface, shells):
    tables = find_methods().get("sphere_tracing_lipschitz").method.tables
    return 1.0 / np.array(tables(surface, {"SHELLS": shells}, "float32")["REACH"])


def _exceeded(surface, steepness, rng):
    """How near gradients come to the bounds: the largest ratio over shells, over 1 where one is exceeded."""
    shells, radius = len(steepness), surface.domain.radius
    points = rng.uniform(-1.0, 1.0, (200_000, 3)) * radius + surface.domain.center
    if hasattr(surface.domain, "lower"):
        points = np.clip(points, surface.domain.lower, surface.domain.upper)
    away = np.linalg.norm(points - surface.domain.center, axis=1)
    points, away = points[away <= radius], away[away <= radius]
    slopes = np.linalg.norm(surfaces.gradient(surface, points), axis=1)
    largest = [slopes[away <= radius * min(k + 2, shells) / shells].max() for k in range(shells)]
    return max(np.array(largest) / steepness)


@pytest.mark.parametrize(
    "name", ["torus", "barth_sextic", "sixteen_ball", "blinn_blob", "klein", "clebsch", "endrass_octic", "zitrus"]
)
@pytest.mark.parametrize("shells", [1, 16])
def test_lipschitz_bounds_hold_and_are_tight(name, shells, rng):
    surface = surfaces.get(name)
    steepness = _steepness(surface, shells)
    reach = _exceeded(surface, steepness, rng)
    assert 0.3 < reach <= 1.0
    assert _exceeded(surface, 0.3 * steepness, rng) > 1.0  # the check would see a bound that does not hold


def test_no_finite_lipschitz_bound_is_one_line():
    cone = replace(surfaces.get("sphere"), formula="sqrt(x^2 + y^2 + z^2) - R", degree=None)
    with pytest.raises(FirsthitError, match="no finite bound"):
        _steepness(cone, 4)


def test_steps_longer_than_the_bound_allows_are_caught(tmp_path):
    folder = _broken(tmp_path, "sphere_tracing_lipschitz", "fabs(f) * REACH[shell]", "8.0 * fabs(f)")
    assert _outcome("sphere_tracing_lipschitz", "tangle", OBLIQUE, SHELLS=1).wrong == 0.0
    assert _outcome("sphere_tracing_lipschitz", "tangle", OBLIQUE, SHELLS=1, folder=folder).wrong > 0.01


# Newton


@pytest.mark.parametrize("setting", ["Newton 0.001", "Newton 0.00003"])
def test_newton_as_printed_turns_back_in_dips_and_loses_nothing_else(setting):
    """What methods/newton states of Table 1's views: rays exhausted by signed steps, and no other wrong ray."""
    printed = find_methods().get("newton").method.settings[setting]
    assert printed["FORWARD"] == 0
    for view in TILTED.values():
        outcome = _outcome("newton", "torus", view, 128, **printed)
        ours = _outcome("newton", "torus", view, 128, EPSILON=printed["EPSILON"])
        assert ours.wrong == 0.0
        assert 0.005 < outcome.wrong == outcome.exhausted / outcome.rays < 0.06
        assert outcome.errors.max() < printed["EPSILON"] * 0.3
        assert ours.evaluations < outcome.evaluations


@pytest.mark.parametrize("forward", [0, 1])
def test_the_start_on_the_sphere_saves_evaluations(forward):
    sphere, box = (
        _outcome("newton", "torus", TILTED[0], 128, FORWARD=forward, SPHERE_START=start, MAX_EVALUATIONS=20)
        for start in (1, 0)
    )
    assert sphere.evaluations < 0.75 * box.evaluations
    assert (2 * sphere.exhausted < box.exhausted) if forward == 0 else (sphere.wrong == box.wrong == 0.0)


def test_a_signed_step_that_ends_before_the_rays_start_is_no_hit():
    inside = View("inside", azimuth=0, elevation=0, distance=0.1)
    surface, rays, _ = _case("torus", inside, 32)
    hits = _cast("newton", surface, rays, FORWARD=0)
    assert (hits.status == RayStatus.EXHAUSTED).any()
    assert (hits.t[hits.status == RayStatus.HIT] >= 0.0).all()
    assert not (hits.status == RayStatus.INVALID).any()


# Sturm


def test_sturm_fails_in_float32_only_and_only_from_some_sides():
    """toledo2007, 4.1 and Fig. 4: numerical defects that depend on the view."""
    knobs = {"BY_SIGN": 0, "ITERATIONS": 22, "CAREFUL": 0}
    low, top = (_outcome("sturm", "torus", view, 256, **knobs) for view in (LOW, TOP))
    assert low.wrong > 0.0
    assert top.wrong == 0.0
    assert _outcome("sturm", "torus", LOW, 256, "float64", **knobs).wrong == 0.0


def test_two_more_sturm_iterations_quarter_the_error():
    medians = [np.median(_outcome("sturm", "torus", OBLIQUE, ITERATIONS=n).errors) for n in (6, 8, 10, 12)]
    ratios = np.divide(medians[:-1], medians[1:])
    assert (ratios > 3.0).all()
    assert (ratios < 5.0).all()


def test_the_discard_before_the_search_changes_no_answer_and_saves_evaluations():
    knobs = {"BY_SIGN": 0, "ITERATIONS": 18, "CAREFUL": 0}
    surface, rays, _ = _case("cayley", OBLIQUE, 96)
    discarding, searching = (_cast("sturm", surface, rays, DISCARD=k, **knobs) for k in (1, 0))
    assert (discarding.status == searching.status).all()
    assert np.array_equal(discarding.t, searching.t, equal_nan=True)
    assert discarding.evaluations.mean() < 0.7 * searching.evaluations.mean()


def test_sturm_with_a_wrong_sign_is_caught(tmp_path):
    folder = _broken(tmp_path, "sturm", "offset * chain[g] - chain[f]", "chain[f] - offset * chain[g]")
    assert _outcome("sturm", "torus", OBLIQUE, folder=folder).wrong > 0.1


@pytest.mark.parametrize("family", ["tiny_coefficients", "huge_coefficients", "lower_degree"])
@pytest.mark.parametrize("method", ["sturm", "analytic"])
def test_what_is_no_number_is_never_a_hit(method, family):
    rung = hardcases.rungs(family)[-1]
    hits = _cast(method, rung.surface, rung.rays)
    truth = first_hits(rung.surface, rung.rays)
    hit = hits.status == RayStatus.HIT
    assert np.isfinite(hits.t[hit]).all()
    assert not (hit & (truth.status == TruthStatus.MISS) & (truth.margin > 1e-3)).any()


# double derivative bisection


@pytest.mark.parametrize("view", TILTED.values(), ids=lambda view: view.name)
def test_double_derivative_bisection_as_printed_has_no_defects_on_table_1s_views(view):
    """toledo2007, 4.2: without Sturm's numerical problems, and within 0.0014 of the minor radius."""
    printed = find_methods().get("double_derivative_bisection").method.settings["D.D. Bisection"]
    outcome = _outcome("double_derivative_bisection", "torus", view, 128, **printed)
    assert outcome.wrong == 0.0
    assert outcome.errors.max() < 0.0014 * 0.3


def test_a_split_at_t_m_alone_takes_some_later_roots():
    """The change that methods/double_derivative_bisection states: t_M may lie past the maximum between the minima."""
    printed, ours = (_outcome("double_derivative_bisection", "spindle_torus", ALL_AROUND, SPLIT=k) for k in (0, 1))
    assert 0 < printed.later_roots < 0.01 * len(printed.errors)
    assert ours.wrong == 0.0


@pytest.mark.parametrize("name", ["torus", "spindle_torus", "mitchell", "tangle"])
def test_double_derivative_bisection_has_no_defects_from_all_sides(name):
    assert _outcome("double_derivative_bisection", name, ALL_AROUND).wrong == 0.0


def test_derivative_bisection_by_the_wrong_sign_is_caught(tmp_path):
    folder = _broken(
        tmp_path, "double_derivative_bisection", "crossed || side * f.derivative < 0.0", "crossed || f.derivative > 0.0"
    )
    assert _outcome("double_derivative_bisection", "torus", OBLIQUE, folder=folder).wrong > 0.02


def test_twelve_halvings_meet_the_papers_error():
    """Table 1: 1400e-6 of the minor radius, of a ray's stay of up to two ring radii."""
    errors = _outcome("double_derivative_bisection", "torus", OBLIQUE, ITERATIONS=12).errors
    assert errors.max() < 0.0014 * 0.3


@pytest.mark.parametrize(
    ("name", "accepted"),
    [("torus", True), ("tangle", True), ("mitchell", True), ("flirt", False), ("octdong", False), ("sphere", False)],
)
def test_quartics_that_rise_along_every_ray_are_accepted(name, accepted):
    reason = find_methods().get("double_derivative_bisection").method.accepts(surfaces.get(name))
    assert (reason is None) == accepted


# closed forms

_CALLS = {
    2: "quadratic_roots(0.5 * x[1], x[0])",
    3: "cubic_roots(x[2], x[1], x[0])",
    4: "depressed_quartic_roots(x[2], x[1], x[0])",
}


def _closed_form(device, degree, coefficients, precision="float64"):
    """float64[n, 4], sorted, inf where there is no root, of monic polynomials (quartics without their cubic term)."""
    text = (
        f"#define INPUTS {max(coefficients.shape[1], 3)}\n#define OUTPUTS 4\n"
        "void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {\n"
        f"    Roots roots = {_CALLS[degree]};\n"
        "    y[0] = roots.a; y[1] = roots.b; y[2] = roots.c; y[3] = roots.d;\n}"
    )
    program = map_program(Section("closed form", text), precision, device.language, ("closed_form",))
    rows = np.zeros((len(coefficients), max(coefficients.shape[1], 3)))
    rows[:, : coefficients.shape[1]] = coefficients
    roots = np.array(map_rows(device, program, rows, 4), np.float64)
    return np.sort(np.where(np.isneginf(roots), np.inf, roots), axis=1)


def _monic(roots):
    """Coefficients below the leading one, lowest power first, of polynomials with these roots, conjugates included."""
    product = np.ones((len(roots), 1), complex)
    for k in range(roots.shape[1]):
        product = np.pad(product, ((0, 0), (1, 0))) - np.pad(product, ((0, 0), (0, 1))) * roots[:, k : k + 1]
    return product.real[:, :-1]


def _needs_float64(device):
    if not device.info.float64:
        pytest.skip("the device has no float64")


@pytest.mark.parametrize("degree", [2, 3, 4])
def test_closed_forms_find_all_real_roots(device, degree, rng):
    _needs_float64(device)
    roots = rng.uniform(-2.0, 2.0, (20_000, degree))
    if degree == 4:
        roots -= roots.mean(axis=1, keepdims=True)
    roots.sort(axis=1)
    roots = roots[np.diff(roots, axis=1).min(axis=1) > 1e-3]
    found = _closed_form(device, degree, _monic(roots))
    assert np.abs(found[:, :degree] - roots).max() < 1e-9
    assert np.isposinf(found[:, degree:]).all()


@pytest.mark.parametrize("degree", [2, 3, 4])
def test_closed_forms_find_no_root_where_a_pair_is_complex(device, degree, rng):
    _needs_float64(device)
    real, imaginary = rng.uniform(-2.0, 2.0, 20_000), rng.uniform(1e-3, 2.0, 20_000)
    roots = np.zeros((20_000, degree), complex)
    roots[:, 0], roots[:, 1] = real + 1j * imaginary, real - 1j * imaginary
    if degree == 3:
        roots[:, 2] = rng.uniform(-2.0, 2.0, 20_000)
    if degree == 4:
        spread = rng.uniform(1e-3, 2.0, 20_000)
        roots[:, 2], roots[:, 3] = -real - spread, -real + spread
    found = _closed_form(device, degree, _monic(roots))
    assert np.abs(found[:, : degree - 2] - np.sort(roots[:, 2:].real, axis=1)).max(initial=0.0) < 1e-9
    assert np.isposinf(found[:, degree - 2 :]).all()


def test_quartics_without_odd_terms_and_with_double_roots(device):
    """The resolvent then has a root 0, or a double one."""
    _needs_float64(device)
    roots = np.array([[-2.0, -1.0, 1.0, 2.0], [-1.0, -1.0, 1.0, 1.0], [0.0] * 4])
    assert np.abs(_closed_form(device, 4, _monic(roots)) - roots).max() < 1e-12


def _mapped(device, precision, call, values):
    """The numbers that a call on x[0] gives, for each of the values."""
    text = (
        "#define INPUTS 1\n#define OUTPUTS 1\n"
        f"void map_item(IN real x[INPUTS], OUT real y[OUTPUTS]) {{ y[0] = {call}; }}"
    )
    program = map_program(Section("closed form", text), precision, device.language, ("closed_form",))
    return np.array(map_rows(device, program, values[:, None], 1), np.float64)[:, 0]


@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_cubics_functions_are_as_exact_as_their_corrections_need(device, precision):
    if precision == "float64":
        _needs_float64(device)
    cosines = np.linspace(-1.0, 1.0, 2049)
    expected = np.cos(np.arccos(cosines) / 3.0)
    assert np.abs(_mapped(device, precision, "third_angle_cosine(x[0])", cosines) - expected).max() < 2e-7
    cubes = np.append(0.0, 10.0 ** np.linspace(-30.0, 30.0, 2049))
    found = _mapped(device, precision, "cube_root(x[0])", cubes)
    assert found[0] == 0.0
    assert np.abs(found[1:] / np.cbrt(cubes[1:]) - 1.0).max() < 1e-4


def test_loop_and_blinns_setting_is_what_they_print():
    method = find_methods().get("analytic").method
    assert method.printed == method.settings["Loop-Blinn"] == {"POLISH": 0, "SCREEN": 2}


@pytest.mark.parametrize("screen", [0, 1, 2])
@pytest.mark.parametrize("name", ["torus", "cayley", "plane_squared"])
def test_signs_of_bernstein_coefficients_discard_misses_only(name, screen):
    surface, rays, _ = _case(name, OBLIQUE, 96)
    sooner, later = (_cast("analytic", surface, rays, SCREEN=screen, EARLY_EXIT=e) for e in (1, 0))
    assert (sooner.status == later.status).all()
    assert np.array_equal(sooner.t, later.t, equal_nan=True)
    assert (sooner.status == RayStatus.HIT).any()


def test_a_discard_by_some_of_the_coefficients_is_caught(tmp_path):
    folder = _broken(tmp_path, "analytic", "above = above && a[i] > 0.0;", "above = a[i] > 0.0;")
    assert _outcome("analytic", "torus", OBLIQUE, folder=folder).wrong > 0.1


def test_depth_within_the_domain_is_as_exact_as_the_distance():
    """Loop and Blinn's tetrahedra bound a ray's depths; the planes do so much worse."""
    local, depth = (_p99(_outcome("analytic", "torus", OBLIQUE, POLISH=0, SCREEN=s)) for s in (0, 2))
    assert depth < 3.0 * local


def test_screen_space_is_noisier_and_the_near_plane_matters():
    """toledo2007, section 2, of Loop and Blinn: noise that the choice of clipping planes aggravates."""
    local = _p99(_outcome("analytic", "torus", OBLIQUE, POLISH=0))
    fitting, near = (_p99(_outcome("analytic", "torus", OBLIQUE, POLISH=0, SCREEN=1, NEAR=n)) for n in (2.5, 0.0078125))
    assert local * 10 < fitting
    assert fitting * 10 < near


def test_an_interval_that_ends_on_the_surface_needs_widening():
    """The torus touches its box, where f is 0 at both ends and the Bernstein form loses its leading coefficient."""
    level = View("level", azimuth=30, elevation=0)
    assert _outcome("analytic", "torus", level, 128).wrong == 0.0
    assert _outcome("analytic", "torus", level, 128, WIDENING=0.0).wrong > 0.0003
