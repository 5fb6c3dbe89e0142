"""Operations per evaluation, counted again in the kernel text."""

import re

import pytest

import surfaces
from harness.kernels import costs
from harness.kernels.functions import surface_sections
from harness.kernels.sections import KERNELS
from harness.plugins import find_methods

OPERATION = re.compile(r" [-+*/] |\b(?:min|max|sqrt|exp|log|log2|pow|sin|cos|tan|floor|fma)\(")
FUNCTION = re.compile(r"^(?:Interval|real|int|Dual|Pair|vec3|void) (\w+)\([^{]*\) \{\n(.*?)^\}", re.M | re.S)
CONSTANT = re.compile(r"2\.0 \* UNIT_ROUNDOFF|2\.0 \* k \* UNIT_ROUNDOFF|16\.0 \* UNIT_ROUNDOFF")
NAMES = ["sphere", "torus", "calyx", "barth_sextic", "endrass_octic", "sixteen_ball", "blinn_blob"]


def _counts(text):
    """Operations of each function in the text, those of the functions that it calls among them; loops count once."""
    bodies = {name: re.sub(r"//.*", "", body) for name, body in FUNCTION.findall(text)}

    def count(name):
        body = CONSTANT.sub("K", bodies[name])
        called = re.findall(r"\b(\w+)\(", body)
        own = len(OPERATION.findall(body)) + body.count("fma(")  # two operations in one
        return own + sum(count(other) for other in called if other in bodies and other != name)

    return {name: count(name) for name in bodies}


NAMES_OF_FILES = ("interval", "interval_exp_log", "interval_powr", "interval_atan2", "interval_jumps")
LIBRARY = "".join((KERNELS / "lib" / f"{name}.glsl").read_text() for name in NAMES_OF_FILES)
RAY = (KERNELS / "lib" / "ray.glsl").read_text()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("function", ["surface_value", "surface_value_along", "surface_dual_along", "surface_distance"])
def test_an_evaluation_costs_what_its_generated_function_does(name, function):
    surface = surfaces.get(name)
    if function == "surface_distance" and not surface.distance:
        pytest.skip("it states no distance")
    text = RAY + "\n".join(s.text for s in surface_sections(surface, [function], "float32", "glsl"))
    point = costs.POINT if function in ("surface_value", "surface_distance") else 0  # the caller's
    assert costs.operations_per_evaluation(surface, [function]) == _counts(text)[function] + point


@pytest.mark.parametrize("operation", ["add", "sub", "mul", "sqr", "min", "max", "abs"])
def test_interval_operations_cost_what_the_library_does(operation):
    assert costs.INTERVAL[operation] == _counts(LIBRARY)[f"interval_{operation}"]


def test_new_interval_operations_cost_what_the_library_does():
    counted = _counts(LIBRARY)
    assert costs.INTERVAL["powr"] == counted["interval_powr"]
    assert costs.INTERVAL["floor"] == counted["sided_floor"] + counted["open_floor"]
    assert costs.INTERVAL["select"] == counted["interval_select"]
    assert costs.INTERVAL["below"] == counted["sided_below"] + counted["open_below"] == 0
    sizes = counted["interval_magnitude"] * 2 + counted["interval_mignitude"] * 2 + 1  # whether the angles are usable
    assert costs.INTERVAL["atan2"] == sizes + counted["upper_angles"] + counted["open_atan2"] * 2


def test_every_operation_of_a_tape_has_a_cost():
    from surfaces.tape import LEAVES, Builder

    operations = {name for name in vars(Builder) if not name.startswith("_")} - LEAVES
    operations -= {"emit", "tape", "value", "is_constant", "powi"}  # no operations, and one of a cost of its own
    assert operations - costs.INTERVAL.keys() == set()


def test_a_piece_of_a_ray_costs_what_the_library_does():
    assert _counts(LIBRARY)["bounded_affine"] == costs.AFFINE


@pytest.mark.parametrize("name", ["sphere", "torus", "barth_sextic"])
def test_a_range_costs_what_its_generated_function_does(name):
    text = LIBRARY + "\n".join(
        s.text for s in surface_sections(surfaces.get(name), ["surface_range"], "float32", "glsl")
    )
    assert costs.operations_per_evaluation(surfaces.get(name), ["surface_range"]) == _counts(text)["surface_range"]


def test_every_method_that_answers_says_what_it_evaluates():
    torus = surfaces.get("torus")
    for plugin in find_methods().plugins.values():
        cost = costs.operations_per_evaluation(torus, plugin.method.needs)
        evaluates = plugin.method.answers and plugin.method.casts != "mesh"
        assert (cost is not None and cost > 0) == evaluates, plugin.method.name
