"""Operations per evaluation, counted again in the kernel text."""

import re

import pytest

import surfaces
from harness.kernels import costs
from harness.kernels.functions import surface_sections
from harness.kernels.sections import KERNELS
from harness.plugins import find_methods

OPERATION = re.compile(r" [-+*/] |\b(?:min|max|sqrt|exp|log|log2|pow|sin|cos|tan|floor|fma)\(")
FUNCTION = re.compile(
    r"^(?:Interval|GradientRange|Sided|real|int|bool|Dual|Pair|vec3|void) (\w+)\([^{]*\) \{\n(.*?)^\}", re.M | re.S
)
CONSTANT = re.compile(r"2\.0 \* UNIT_ROUNDOFF|2\.0 \* k \* UNIT_ROUNDOFF|16\.0 \* UNIT_ROUNDOFF|16\.0 \* REAL_TINY")
NAMES = ["sphere", "torus", "calyx", "barth_sextic", "endrass_octic", "sixteen_ball", "blinn_blob"]


def _counts(text, known=None):
    """Operations of each function in the text, those of the functions that it calls among them; loops count once.

    known: counts of functions, by name, that are not to be counted again, since they have loops or alternatives.
    """
    bodies = {name: re.sub(r"//.*", "", body) for name, body in FUNCTION.findall(text)}

    def count(name):
        if known and name in known:
            return known[name]
        body = CONSTANT.sub("K", bodies[name])
        called = re.findall(r"\b(\w+)\(", body)
        own = len(OPERATION.findall(body)) + body.count("fma(")  # two operations in one
        return own + sum(count(other) for other in called if other in bodies and other != name)

    return {name: count(name) for name in bodies}


NAMES_OF_FILES = (
    *("interval", "interval_exp_log", "interval_powr", "interval_atan2", "interval_jumps"),
    "interval_slopes",
)
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


SLOPED = {
    "kinks": "abs(x) + max(x, y) - min(z, 0.5) - 1",
    "quotients": "x/(2 + y^2) + x*z - 0.3",
    "functions": "exp(x) + cos(y)*sin(z) + tan(0.3*x) - 2",
    "powers": "(2 + x)^1.7 + (1 + y^2)^0.7 + sqrt(2 + z) - log(3 + x) - 2",
    "jumps": "floor(2*x) + step(0.1, y) + sign(z) + atan2(y, x) - 0.5",
}


@pytest.mark.parametrize("name", ["torus", "barth_sextic", "blinn_blob", "gyroid", "smooth_union", *SLOPED])
def test_a_range_with_its_derivatives_costs_what_its_generated_function_does(name):
    surface = surfaces.from_formula(SLOPED[name], "sphere:1.1") if name in SLOPED else surfaces.get(name)
    sections = surface_sections(surface, ["surface_gradient_range"], "float32", "glsl")
    known = {f"interval_{name}": costs.INTERVAL[name] for name in ("sin", "cos", "tan", "exp", "atan2")}
    known["surface_range"] = costs.operations_per_evaluation(surface, ["surface_range"])
    counted = _counts(LIBRARY + "\n".join(section.text for section in sections), known)["surface_gradient_range"]
    assert costs.operations_per_evaluation(surface, ["surface_gradient_range"]) == counted


def test_no_number_of_operations_holds_for_evaluations_that_cost_more_and_less():
    torus = surfaces.get("torus")
    cheap, costly = (costs.operations_per_evaluation(torus, [f"surface_{n}"]) for n in ("value", "gradient_range"))
    assert costly > 10 * cheap
    assert costs.operations_per_evaluation(torus, ["surface_value", "surface_gradient_range"]) is None


def test_every_method_that_answers_says_what_it_evaluates():
    torus = surfaces.get("torus")
    for plugin in find_methods().plugins.values():
        cost = costs.operations_per_evaluation(torus, plugin.method.needs)
        evaluates = plugin.method.answers and plugin.method.casts != "mesh"
        alike = "surface_gradient_range" not in plugin.method.needs
        assert (cost is not None and cost > 0) == (evaluates and alike), plugin.method.name
