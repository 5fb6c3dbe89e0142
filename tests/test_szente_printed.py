"""szente's methods as printed: each knob that puts the paper's own way in the place of ours."""

from __future__ import annotations

import dataclasses
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import surfaces
from harness.contract import RayStatus, Section
from harness.devices.interface import Device, hits_from, launch_rays, map_rows
from harness.kernels.assemble import map_program, method_program
from harness.kernels.fitting import nodes, whole_tables
from harness.plugins import find_methods

from .test_methods_szente import _case, _cast, _fast, _score


@pytest.mark.parametrize("basis", ["monomial", "bernstein"])
@pytest.mark.parametrize("degree", [2, 10])
def test_the_whole_inverse_is_that_of_nodes_in_double_precision(basis, degree):
    tables = {name: [Fraction(v) for v in values] for name, values in whole_tables(degree, basis, "float32").items()}
    parted = [hi + lo for hi, lo in zip(tables["INVERSE_HI"], tables["INVERSE_LO"], strict=True)]
    x = np.array([float(v) for v in nodes(degree, "float64")])
    if basis == "monomial":
        matrix = np.vander(x, increasing=True)
    else:
        y = (1 + x) / 2
        matrix = np.stack([math.comb(degree, j) * y**j * (1 - y) ** (degree - j) for j in range(degree + 1)], axis=1)
    found = np.array([float(v) for v in parted]).reshape(degree + 1, degree + 1)
    assert np.abs(found @ matrix - np.eye(degree + 1)).max() < 1e-10
    assert all(abs(v - hi) <= 2.0**-24 * abs(v) for v, hi in zip(parted, tables["INVERSE_HI"], strict=True))


# Roots of the quadratic derivative

QUADRATIC_ITEM = """#define INPUTS 3
#define OUTPUTS 2
void map_item(IN real v[INPUTS], OUT real y[OUTPUTS]) {
    real q[COEFFICIENTS];
    real x[COEFFICIENTS];
    for (int j = 0; j <= 2; j++) q[j] = v[j];
    x[0] = LOWER;
    x[3] = 1.0;
    quadratic_roots(x, q, LOWER == 0.0);
    y[0] = x[1];
    y[1] = x[2];
}
"""


@pytest.mark.parametrize("lower", [-1.0, 0.0])
def test_roots_of_quadratics_are_found_in_both_bases(device, lower, rng):
    roots = np.sort(rng.uniform(lower, 1, (500, 2)), axis=1)
    roots[::5, 1] += 10.0  # outside: moved to the end
    scale = 10.0 ** rng.uniform(-3, 3, 500)
    a, b, c = scale, -scale * roots.sum(axis=1), scale * roots.prod(axis=1)
    rows = np.stack([c, b, a] if lower else [c, b + 2 * c, a + b + c], axis=1)
    none = np.array([[1.0, 0.0, 1.0] if lower else [1.0, 2.0, 2.0], [1.0, 0.0, 0.0] if lower else [1.0, 2.0, 1.0]])
    linear = np.array([[-1.0, 4.0, 0.0] if lower else [-1.0, 2.0, 3.0]])  # 4 x - 1
    rows = np.concatenate([rows, none, linear]).astype(np.float32)
    item = Section("tests: quadratic", f"#define LOWER real({lower})\n{QUADRATIC_ITEM}")
    program = map_program(item, "float32", device.language, ("dual", "polynomial"))
    found = map_rows(device, program, rows, 2)
    apart = roots[:, 1] - roots[:, 0] > 0.01
    assert np.abs(found[:500] - np.clip(roots, lower, 1.0))[apart].max() < 1e-4
    assert (found[500:502] == 1.0).all()
    assert found[502].tolist() == pytest.approx([0.25, 1.0])


def _counts(device: Device, method: str, name: str, **knobs: float) -> Any:
    """Evaluations on each ray that hits."""
    surface, rays, _ = _case(name)
    hits = _cast(device, method, surface, rays, **knobs)
    return hits.evaluations[hits.status == RayStatus.HIT]


def test_bisection_halves_an_interval_of_f_itself(device):
    """On the sphere: 3 samples, f at the critical point, and 23 halvings of an interval of length 1."""
    printed = find_methods().get("eft_yuksel").method.settings["EFT + EVAL"]
    assert np.isin(_counts(device, "eft_yuksel", "sphere", **printed), (26, 27)).all()
    coarse = _counts(device, "eft_yuksel", "sphere", **printed | {"TOLERANCE": 2.0**-13})
    assert np.isin(coarse, (16, 17)).all()
    assert (_counts(device, "eft_yuksel", "sphere", **printed | {"EVAL": 0}) == 3).all()


@pytest.mark.one_in(2)
@pytest.mark.parametrize("name", ["torus", "barth_decic"])
@pytest.mark.parametrize("setting", ["EFT + EVAL", "Bernstein"])
def test_each_printed_part_of_the_fit_alone_gives_the_picture(name, setting):
    whole = find_methods().get("eft_yuksel").method.settings[setting]
    for knobs in (whole, *({knob: value} for knob, value in whole.items())):
        wrong, error = _score(_fast(), "eft_yuksel", name, **knobs)
        assert wrong == 0.0
        assert error < 2e-6


def test_what_lies_behind_a_sampled_change_of_sign_is_looked_for_as_printed():
    found = [_counts(_fast(), "eft_yuksel", "sixteen_ball", SAMPLES=n).mean() for n in (0, 1)]
    assert found[0] > found[1]


def _with_no_coefficients(program: Any) -> Any:
    """The program, its exact expansion replaced by zeros."""
    head = "void surface_coefficients_along(Ray ray, OUT real c[SURFACE_DEGREE + 1])"
    zeros = f"{head} {{ for (int j = 0; j <= SURFACE_DEGREE; j++) c[j] = 0.0; }}"
    sections = [dataclasses.replace(s, text=zeros) if head in s.text else s for s in program.sections]
    assert sections != list(program.sections)
    return dataclasses.replace(program, sections=tuple(sections))


@pytest.mark.parametrize("expand", [0, 1])
def test_what_is_marched_as_printed_is_f_and_not_its_expansion(device, expand):
    surface, rays, _ = _case("torus")
    plugin = find_methods().get("ray_march")
    variant = plugin.variant({"EXPAND": expand, "STEPS": 500})
    program = method_program(plugin.method, plugin.folder, variant, surface, "float32", device.language, "rays")
    found = []
    for one in (program, _with_no_coefficients(program)):
        launch = launch_rays(device, one, device.build(one), rays)
        launch.run()
        found.append(hits_from(launch.read()))
        launch.release()
    assert (found[0].status == RayStatus.HIT).sum() > 300
    assert np.array_equal(found[0].t, found[1].t, equal_nan=True) == (expand == 0)


@pytest.mark.parametrize("block", [1, 4, 8])
def test_blocks_of_steps_are_the_same_steps(block):
    surface, rays, _ = _case("calyx")
    plain = _cast(_fast(), "ray_march", surface, rays, BLOCK=1)
    found = _cast(_fast(), "ray_march", surface, rays, BLOCK=block)
    assert np.array_equal(plain.status, found.status)
    assert np.array_equal(plain.t, found.t, equal_nan=True)
    assert (np.abs(found.evaluations - plain.evaluations) <= block).all()


def test_without_the_secant_the_hit_is_the_end_of_the_bracket():
    knobs = {"STEPS": 100, "REFINEMENTS": 0}
    ends, roots = (_score(_fast(), "ray_march", "torus", SECANT=n, **knobs) for n in (0, 1))
    assert ends[0] == roots[0] == 0.0
    assert ends[1] > 10 * roots[1]


@pytest.mark.parametrize("method", ["eft_yuksel", "ray_march"])
def test_values_of_f_and_its_degree_are_all_that_the_printed_methods_are_told(method):
    """Two surfaces of one degree and domain: the programs differ in the functions generated of f alone."""
    plugin = find_methods().get(method)
    variant = plugin.variant(plugin.method.printed)
    pair = [surfaces.from_formula(f, "sphere:1.5", "mine") for f in ("x^6 + y^6 + z^6 - 1", "x^6 + 2*y^2*z - x + 0.1")]
    sections = [
        method_program(plugin.method, plugin.folder, variant, surface, "float32", "cl", "rays").sections
        for surface in pair
    ]
    differ = {a.origin for a, b in zip(*sections, strict=True) if a != b}
    assert differ == {"generated: surface mine, surface_value"}


@pytest.mark.parametrize("method", ["eft_yuksel", "yuksel", "lu_lipschitz", "ray_march"])
def test_a_setting_binds_every_knob_that_is_printed_otherwise(method):
    described = find_methods().get(method).method
    assert described.printed
    assert any(described.printed.items() <= setting.items() for setting in described.settings.values())
    assert all(described.printed.keys() <= setting.keys() for setting in described.settings.values())


def test_no_roundings_are_reckoned_with_as_printed():
    spent = [_counts(_fast(), "lu_lipschitz", "endrass_octic", TRUST=trust).mean() for trust in (0.0, 0.0625, 1.0)]
    assert spent[0] < spent[1] < spent[2]


@pytest.mark.parametrize("setting", ["LU bound", "control point", "LU bound on subintervals"])
@pytest.mark.parametrize("name", ["flirt", "calyx"])
def test_the_printed_tracers_give_the_picture(device, name, setting):
    wrong, error = _score(device, "lu_lipschitz", name, **find_methods().get("lu_lipschitz").method.settings[setting])
    assert wrong <= 0.002
    assert error < 1e-5
