"""What the closed forms and Loop and Blinn's method state about themselves, and copies broken on purpose."""

import numpy as np
import pytest

from harness.contract import PRECISIONS, RayStatus, Section, View
from harness.devices.interface import map_rows
from harness.kernels.assemble import map_program
from harness.plugins import find_methods

from .test_methods_toledo import OBLIQUE, broken_copy, case_of, hits_of, outcome_of, p99_of

_CALLS = {
    2: "quadratic_roots(0.5 * x[1], x[0])",
    3: "cubic_roots(x[2], x[1], x[0])",
    4: "depressed_quartic_roots(x[2], x[1], x[0])",
}


def _closed_form(device, degree, coefficients, precision="float64"):
    """Return the real roots of monic polynomials, float64[n, 4], sorted, with inf where there is no root.

    `coefficients` are [n, k], lowest power first, without the leading 1; quartics have no cubic term.
    """
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
    """Return the coefficients of monic polynomials with the roots [n, k], lowest power first and without the leading 1.

    `roots` holds conjugates of complex roots too. Returns float64[n, k].
    """
    product = np.ones((len(roots), 1), complex)
    for k in range(roots.shape[1]):
        product = np.pad(product, ((0, 0), (1, 0))) - np.pad(product, ((0, 0), (0, 1))) * roots[:, k : k + 1]
    return product.real[:, :-1]


def _needs_float64(device):
    """Skip the test where the device has no float64."""
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
    """Return what `call`, an expression in x[0], gives for each of the values [n], as float64[n]."""
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


@pytest.mark.one_in(3)
@pytest.mark.parametrize("screen", [0, 1, 2])
@pytest.mark.parametrize("name", ["torus", "cayley", "plane_squared"])
def test_signs_of_bernstein_coefficients_discard_misses_only(name, screen):
    surface, rays, _ = case_of(name, OBLIQUE, 96)
    sooner, later = (hits_of("analytic", surface, rays, SCREEN=screen, EARLY_EXIT=e) for e in (1, 0))
    assert (sooner.status == later.status).all()
    assert np.array_equal(sooner.t, later.t, equal_nan=True)
    assert (sooner.status == RayStatus.HIT).any()


def test_a_discard_by_some_of_the_coefficients_is_caught(tmp_path):
    folder = broken_copy(tmp_path, "analytic", "above = above && a[i] > 0.0;", "above = a[i] > 0.0;")
    assert outcome_of("analytic", "torus", OBLIQUE, folder=folder).wrong > 0.1


def test_depth_within_the_domain_is_as_exact_as_the_distance():
    """Loop and Blinn's tetrahedra bound a ray's depths; the planes do so much worse."""
    local, depth = (p99_of(outcome_of("analytic", "torus", OBLIQUE, POLISH=0, SCREEN=s)) for s in (0, 2))
    assert depth < 3.0 * local


def test_screen_space_is_noisier_and_the_near_plane_matters():
    """toledo2007, section 2, of Loop and Blinn: noise that the choice of clipping planes aggravates."""
    local = p99_of(outcome_of("analytic", "torus", OBLIQUE, POLISH=0))
    fitting, near = (
        p99_of(outcome_of("analytic", "torus", OBLIQUE, POLISH=0, SCREEN=1, NEAR=n)) for n in (2.5, 0.0078125)
    )
    assert local * 10 < fitting
    assert fitting * 10 < near


def test_an_interval_that_ends_on_the_surface_needs_widening():
    """The torus touches its box, where f is 0 at both ends and the Bernstein form loses its leading coefficient."""
    level = View("level", azimuth=30, elevation=0)
    assert outcome_of("analytic", "torus", level, 128).wrong == 0.0
    assert outcome_of("analytic", "torus", level, 128, WIDENING=0.0).wrong > 0.0003
