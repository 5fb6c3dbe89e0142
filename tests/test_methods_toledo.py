"""What the methods of toledo2007 state about themselves, and copies broken on purpose."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import surfaces
from harness import hardcases
from harness.accuracy.judge import Wrong, judge
from harness.contract import FirsthitError, RayStatus, TruthStatus, View
from harness.devices.interface import hits_from, launch_rays
from harness.kernels.assemble import method_program
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
def case_of(name, view, size):
    """Return the surface, its rays float32[size * size, 6] and their certified truth."""
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


def hits_of(method, surface, rays, precision="float32", folder=None, **knobs):
    """Return the hits of `method` on the first device here; `folder` may hold another kernel."""
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
    """Hold how rays outside the grazing class were answered.

    `wrong` is the share of them that is answered wrongly, `later_roots` counts hits of a later root, and `errors` are
    those of right hits.
    """

    rays: int
    wrong: float
    later_roots: int
    errors: NDArray[np.float64]
    exhausted: int
    evaluations: float  # for each ray
    most_evaluations: int


def outcome_of(method, name, view, size=96, precision="float32", folder=None, **knobs):
    """Cast the rays of `case_of`, and judge them against the truth."""
    surface, rays, truth = case_of(name, view, size)
    hits = hits_of(method, surface, rays, precision, folder, **knobs)
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


def p99_of(outcome):
    """Return the 99th percentile of the errors of right hits."""
    return np.quantile(outcome.errors, 0.99)


def broken_copy(tmp_path, method, right, wrong):
    """Write the method's kernel with `right` replaced by `wrong` everywhere into `tmp_path`, and return that folder."""
    text = (find_methods().get(method).folder / "kernel.glsl").read_text()
    assert right in text
    (tmp_path / "kernel.glsl").write_text(text.replace(right, wrong))
    return tmp_path


# sphere tracing


@pytest.mark.parametrize("name", ["torus", "horn_torus"])
def test_two_starts_find_what_one_finds_from_all_sides(name):
    for rays in (1, 2):
        assert outcome_of("sphere_tracing", name, ALL_AROUND, RAYS=rays).wrong == 0.0
    assert outcome_of("sphere_tracing", name, ALL_AROUND, RAYS=2, AHEAD=0).wrong == 0.0


def test_a_second_start_that_never_goes_back_spends_less_than_the_printed_one():
    ours, printed = (outcome_of("sphere_tracing", "torus", TILTED[0], 128, RAYS=2, AHEAD=k) for k in (1, 0))
    assert ours.evaluations < 0.9 * printed.evaluations


def test_two_starts_take_fewer_steps_near_a_tangency():
    one, two = (outcome_of("sphere_tracing", "torus", OBLIQUE, RAYS=rays).most_evaluations for rays in (1, 2))
    assert two < one


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("way = second ? -1.0 : 1.0;", "way = 1.0;"),  # a second start inside does not turn back
        ("turned && second", "turned"),  # ends at the first minimum
    ],
)
def test_broken_second_starts_are_caught(tmp_path, right, wrong):
    folder = broken_copy(tmp_path, "sphere_tracing", right, wrong)
    assert outcome_of("sphere_tracing", "horn_torus", ALL_AROUND, folder=folder).wrong > 0.001


def test_a_smaller_distance_counts_as_a_hit_nearer_to_it():
    errors = [p99_of(outcome_of("sphere_tracing", "torus", OBLIQUE, EPSILON=e)) for e in (1e-2, 1e-3, 1e-4)]
    assert errors[0] > 5 * errors[1] > 25 * errors[2]


def test_surfaces_without_a_distance_are_refused():
    accepts = find_methods().get("sphere_tracing").method.accepts
    assert accepts(surfaces.get("torus")) is None
    assert "distance" in accepts(surfaces.get("barth_sextic"))


def _steepness(surface, shells):
    """Return the bound of the gradient's length in each shell, float64[shells]."""
    tables = find_methods().get("sphere_tracing_lipschitz").method.tables
    return 1.0 / np.array(tables(surface, {"SHELLS": shells}, "float32")["REACH"])


def _exceeded(surface, steepness, rng):
    """Return the largest ratio of a gradient's length to its bound, over all shells; above 1 one is exceeded."""
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
    cusp = surfaces.from_formula("sqrt(abs(x)) + y^2 + z^2 - 1")  # its slope is infinite where x is 0
    with pytest.raises(FirsthitError, match="no finite bound"):
        _steepness(cusp, 4)


def test_steps_longer_than_the_bound_allows_are_caught(tmp_path):
    folder = broken_copy(tmp_path, "sphere_tracing_lipschitz", "fabs(f) * REACH[shell]", "8.0 * fabs(f)")
    assert outcome_of("sphere_tracing_lipschitz", "tangle", OBLIQUE, SHELLS=1).wrong == 0.0
    assert outcome_of("sphere_tracing_lipschitz", "tangle", OBLIQUE, SHELLS=1, folder=folder).wrong > 0.01


# Newton


@pytest.mark.parametrize("setting", ["Newton 0.001", "Newton 0.00003"])
def test_newton_as_printed_turns_back_in_dips_and_loses_nothing_else(setting):
    """What methods/newton states of Table 1's views: rays exhausted by signed steps, and no other wrong ray."""
    printed = find_methods().get("newton").method.settings[setting]
    assert printed["FORWARD"] == 0
    for view in TILTED.values():
        outcome = outcome_of("newton", "torus", view, 128, **printed)
        ours = outcome_of("newton", "torus", view, 128, EPSILON=printed["EPSILON"])
        assert ours.wrong == 0.0
        assert 0.005 < outcome.wrong == outcome.exhausted / outcome.rays < 0.06
        assert outcome.errors.max() < printed["EPSILON"] * 0.3
        assert ours.evaluations < outcome.evaluations


@pytest.mark.parametrize("forward", [0, 1])
def test_the_start_on_the_sphere_saves_evaluations(forward):
    sphere, box = (
        outcome_of("newton", "torus", TILTED[0], 128, FORWARD=forward, SPHERE_START=start, MAX_EVALUATIONS=20)
        for start in (1, 0)
    )
    assert sphere.evaluations < 0.75 * box.evaluations
    assert (2 * sphere.exhausted < box.exhausted) if forward == 0 else (sphere.wrong == box.wrong == 0.0)


def test_a_signed_step_that_ends_before_the_rays_start_is_no_hit():
    inside = View("inside", azimuth=0, elevation=0, distance=0.1)
    surface, rays, _ = case_of("torus", inside, 32)
    hits = hits_of("newton", surface, rays, FORWARD=0)
    assert (hits.status == RayStatus.EXHAUSTED).any()
    assert (hits.t[hits.status == RayStatus.HIT] >= 0.0).all()
    assert not (hits.status == RayStatus.INVALID).any()


# Sturm


def test_sturm_fails_in_float32_only_and_only_from_some_sides():
    """toledo2007, 4.1 and Fig. 4: numerical defects that depend on the view."""
    knobs = {"BY_SIGN": 0, "ITERATIONS": 22, "CAREFUL": 0}
    low, top = (outcome_of("sturm", "torus", view, 256, **knobs) for view in (LOW, TOP))
    assert low.wrong > 0.0
    assert top.wrong == 0.0
    assert outcome_of("sturm", "torus", LOW, 256, "float64", **knobs).wrong == 0.0


def test_two_more_sturm_iterations_quarter_the_error():
    medians = [np.median(outcome_of("sturm", "torus", OBLIQUE, ITERATIONS=n).errors) for n in (6, 8, 10, 12)]
    ratios = np.divide(medians[:-1], medians[1:])
    assert (ratios > 3.0).all()
    assert (ratios < 5.0).all()


def test_the_discard_before_the_search_changes_no_answer_and_saves_evaluations():
    knobs = {"BY_SIGN": 0, "ITERATIONS": 18, "CAREFUL": 0}
    surface, rays, _ = case_of("cayley", OBLIQUE, 96)
    discarding, searching = (hits_of("sturm", surface, rays, DISCARD=k, **knobs) for k in (1, 0))
    assert (discarding.status == searching.status).all()
    assert np.array_equal(discarding.t, searching.t, equal_nan=True)
    assert discarding.evaluations.mean() < 0.7 * searching.evaluations.mean()


def test_sturm_with_a_wrong_sign_is_caught(tmp_path):
    folder = broken_copy(tmp_path, "sturm", "offset * chain[g] - chain[f]", "chain[f] - offset * chain[g]")
    assert outcome_of("sturm", "torus", OBLIQUE, folder=folder).wrong > 0.1


@pytest.mark.parametrize("family", ["tiny_coefficients", "huge_coefficients", "lower_degree"])
@pytest.mark.parametrize("method", ["sturm", "analytic"])
def test_what_is_no_number_is_never_a_hit(method, family):
    rung = hardcases.rungs(family)[-1]
    hits = hits_of(method, rung.surface, rung.rays)
    truth = first_hits(rung.surface, rung.rays)
    hit = hits.status == RayStatus.HIT
    assert np.isfinite(hits.t[hit]).all()
    assert not (hit & (truth.status == TruthStatus.MISS) & (truth.margin > 1e-3)).any()


# double derivative bisection


@pytest.mark.parametrize("view", TILTED.values(), ids=lambda view: view.name)
def test_double_derivative_bisection_as_printed_has_no_defects_on_table_1s_views(view):
    """toledo2007, 4.2: without Sturm's numerical problems, and within 0.0014 of the minor radius."""
    printed = find_methods().get("double_derivative_bisection").method.settings["D.D. Bisection"]
    outcome = outcome_of("double_derivative_bisection", "torus", view, 128, **printed)
    assert outcome.wrong == 0.0
    assert outcome.errors.max() < 0.0014 * 0.3


def test_a_split_at_t_m_alone_takes_some_later_roots():
    """The change that methods/double_derivative_bisection states: t_M may lie past the maximum between the minima."""
    printed, ours = (outcome_of("double_derivative_bisection", "spindle_torus", ALL_AROUND, SPLIT=k) for k in (0, 1))
    assert 0 < printed.later_roots < 0.01 * len(printed.errors)
    assert ours.wrong == 0.0


@pytest.mark.parametrize("name", ["torus", "spindle_torus", "mitchell", "tangle"])
def test_double_derivative_bisection_has_no_defects_from_all_sides(name):
    assert outcome_of("double_derivative_bisection", name, ALL_AROUND).wrong == 0.0


def test_derivative_bisection_by_the_wrong_sign_is_caught(tmp_path):
    folder = broken_copy(
        tmp_path, "double_derivative_bisection", "crossed || side * f.derivative < 0.0", "crossed || f.derivative > 0.0"
    )
    assert outcome_of("double_derivative_bisection", "torus", OBLIQUE, folder=folder).wrong > 0.02


def test_twelve_halvings_meet_the_papers_error():
    """Table 1: 1400e-6 of the minor radius, of a ray's stay of up to two ring radii."""
    errors = outcome_of("double_derivative_bisection", "torus", OBLIQUE, ITERATIONS=12).errors
    assert errors.max() < 0.0014 * 0.3


@pytest.mark.parametrize(
    ("name", "accepted"),
    [("torus", True), ("tangle", True), ("mitchell", True), ("flirt", False), ("octdong", False), ("sphere", False)],
)
def test_quartics_that_rise_along_every_ray_are_accepted(name, accepted):
    reason = find_methods().get("double_derivative_bisection").method.accepts(surfaces.get(name))
    assert (reason is None) == accepted
