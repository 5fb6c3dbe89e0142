"""Limits of a config stand on its fields: each number has a range, each list is free of repetitions."""

import dataclasses
import typing

import pytest

from harness.contract import FirsthitError, Method, Parameter, Variant
from harness.experiment import reading
from harness.experiment.config import Config
from harness.limits import Distinct, OneOf, Within
from harness.plugins import Plugin, find_methods

START = """title = "t"
surfaces = ["sphere"]
[[method]]
name = "newton"
"""
# numbers that a method or a surface bounds, and lists whose repetitions make variants or scenes that are refused
BOUND_ELSEWHERE = {"method.parameters", "surface.parameters", "scene.placed.parameters", "scene.placed.knobs"}
MAY_REPEAT = {"method", "method.settings", "method.parameters", "scene.placed", "angles.values"}


def leaves(kind, name="", limits=()):
    """Yield every field that holds a number or a list: its dotted name, "number" or "list", and its limits."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if origin is typing.Annotated:
        yield from leaves(arguments[0], name, arguments[1:])
    elif dataclasses.is_dataclass(kind):
        for key, hint in typing.get_type_hints(kind, include_extras=True).items():
            yield from leaves(hint, f"{name}.{key}".lstrip("."))
    elif origin is list:
        yield name, "list", limits
        one_of = [limit for limit in limits if isinstance(limit, OneOf)]
        yield from leaves(arguments[0], name, one_of)
    elif origin in (tuple, dict) or type(None) in arguments:
        for argument in arguments:
            yield from leaves(argument, name)
    elif kind in (int, float):
        yield name, "number", limits


def test_the_walk_finds_fields_at_every_depth():
    found = {(name, sort) for name, sort, _ in leaves(Config)}
    assert {("sizes", "list"), ("sizes", "number"), ("view.fov", "number"), ("scene.placed.turn", "number")} <= found
    assert {("gate.figures.absolute", "number"), ("angles.values", "number"), ("view.distance", "number")} <= found


def test_every_number_has_a_range_and_every_list_says_that_it_holds_nothing_twice():
    for name, sort, limits in leaves(Config):
        wanted = (Within, OneOf) if sort == "number" else Distinct
        spared = BOUND_ELSEWHERE if sort == "number" else MAY_REPEAT
        assert name in spared or any(isinstance(limit, wanted) for limit in limits), f"{sort} {name} has no limit"


def load(tmp_path, text):
    path = tmp_path / "c.toml"
    path.write_text(text)
    return reading.load(path, find_methods())


def refused(tmp_path, text):
    with pytest.raises(FirsthitError) as caught:
        load(tmp_path, text)
    assert caught.value.exit_code == 2
    return str(caught.value).split("c.toml:", 1)[1]


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("sizes = [64, 64]", "sizes: 64 is named twice"),
        ("samples_per_pixel = [4, 1, 4]", "samples_per_pixel: 4 is named twice"),
        ("samples_per_pixel = [1, 3]", "samples_per_pixel: 3 is not one of 1, 4, 9, 16"),
        ('precisions = ["float32", "float32"]', "precisions: 'float32' is named twice"),
        ('stages = ["rays", "rays"]', "stages: 'rays' is named twice"),
        ('prepass = ["beams", "beams"]', "prepass: 'beams' is named twice"),
        ('origins = ["eye", "eye"]', "origins: 'eye' is named twice"),
        ('proxies = ["box", "box"]', "proxies: 'box' is named twice"),
        ('normals = ["gradient", "gradient"]', "normals: 'gradient' is named twice"),
        ('devices = ["all", "all"]', "devices: 'all' is named twice"),
        ('studies = ["form_ranges", "form_ranges"]', "studies: 'form_ranges' is named twice"),
        ('families = ["grazing", "grazing"]', "families: 'grazing' is named twice"),
        ('families = ["all", "all"]', "families: unknown 'all'; known: "),
        ("tolerances = [0, 0.0]", "tolerances: 0.0 is named twice"),
        ("tolerances = [-0.5]", "tolerances.0: -0.5 is outside [0, 1000]"),
        ("tolerances = [nan]", "tolerances.0 is a finite number, not nan"),
        ("sizes = [-inf]", "sizes.0 is a finite number, not -inf"),
        ("seed = -1", "seed: -1 is outside [0, 9.22337e+18]"),
        ("seed = true", "seed is a whole number, not True"),
    ],
)
def test_a_list_or_number_of_the_experiment_keeps_its_limits(tmp_path, line, message):
    assert refused(tmp_path, f"{line}\n{START}").startswith(f"1: {message}")


@pytest.mark.parametrize(
    ("table", "line", "message"),
    [
        ("budget", "triangles = 0", "budget.triangles: 0 is outside [1, 1e+12]"),
        ("budget", f"seconds = 1{'0' * 400}", "budget.seconds is a finite number, not 1000"),
        ("accuracy", "undecided = 1.5", "accuracy.undecided: 1.5 is outside [0, 1]"),
        ("directions", "seed = -1", "directions.seed: -1 is outside [0, "),
        ("scene.mine", "counts = [0]", "scene.mine.counts.0: a scene has 1 to 1,000,000 parts, not 0"),
        ("scene.mine", "counts = [8, 8]", "counts: 8 is named twice"),
        ("scene.mine", "seed = -1", "scene.mine.seed: -1 is outside"),
        ("scene.mine", "fov = 180", "scene.mine.fov: 180.0 is outside [0.001, 179]"),
        ("scene.mine", "elevation = 91", "scene.mine.elevation: 91.0 is outside [-90, 90]"),
        ("scene.mine", "azimuth = 361", "scene.mine.azimuth: 361.0 is outside [-360, 360]"),
        ("scene.mine", "distance = 0", "scene.mine.distance: 0.0 is outside [1e-06, 1e+09]"),
        ("gate", 'same = ["title"]', "gate.same is gone: devices are compared by how they compute"),
        ("gate.last_bits", "misses = { relative = -1 }", "gate.last_bits.misses.relative: a tolerance is not negative"),
    ],
)
def test_a_field_of_a_table_keeps_its_limits(tmp_path, table, line, message):
    assert refused(tmp_path, f"{START}[{table}]\n{line}\n").startswith(f"6: {message}")


@pytest.mark.parametrize(
    ("placed", "message"),
    [
        ("at = [0, 0, 2e9]", "scene.mine.placed.0.at.2: 2000000000.0 is outside [-1e+09, 1e+09]"),
        ("turn = [0, 400, 0]", "scene.mine.placed.0.turn.1: 400.0 is outside [-360, 360]"),
        ("colour = [0, 0, 2]", "scene.mine.placed.0.colour.2: 2.0 is outside [0, 1]"),
        ("scale = -1", "scene.mine.placed.0.scale: a scale is positive, from 1e-09 to 1e+09, not -1"),
    ],
)
def test_an_instance_keeps_its_limits(tmp_path, placed, message):
    text = f'{START}[scene.mine]\nplaced = [{{ surface = "torus", {placed} }}]\n'
    assert refused(tmp_path, text).startswith(f"6: {message}")


def test_a_methods_own_stages_are_told_by_their_line(tmp_path):
    assert refused(tmp_path, f'{START}stages = ["rays", "beams"]\n').startswith("5: stages: unknown 'beams'; known: ")
    assert refused(tmp_path, f'{START}stages = ["rays", "rays"]\n').startswith("5: stages: 'rays' is named twice")


def test_a_view_may_not_take_the_name_of_one_of_a_set(tmp_path):
    text = f'{START}[[view]]\nname = "angle 0"\n[angles]\nvalues = [0, 90]\n'
    assert refused(tmp_path, text).startswith("5: view: 'angle 0' is named twice")


@pytest.mark.parametrize("value", [float("nan"), float("inf"), float("-inf"), 10**400])
def test_a_knob_is_a_finite_number(value):
    newton = find_methods().get("newton")
    for name in ("EPSILON", "MAX_EVALUATIONS"):
        with pytest.raises(FirsthitError, match=f"newton: {name} is a finite number, not "):
            newton.variant({name: value})
    assert isinstance(newton.variant({"EPSILON": 1e-3}), Variant)


def test_a_plugins_own_default_is_a_finite_number_too(tmp_path):
    method = Method("mine", "nowhere", parameters=(Parameter("STEP", float("nan"), "a step"),))
    with pytest.raises(FirsthitError, match="mine: STEP is a finite number, not nan"):
        Plugin(method, tmp_path).variant({})


def test_a_number_of_more_digits_than_python_reads_is_one_line(tmp_path):
    with pytest.raises(FirsthitError, match=r"c\.toml:1: a number of more than 1000 digits"):
        load(tmp_path, f"sizes = [1{'0' * 5000}]\n{START}")


def test_all_mistakes_are_told_at_once_each_with_its_line(tmp_path):
    text = f"""sizes = [64, 0, "x"]
stagess = ["compute"]
seed = 1.5
{START}parameters = {{ EPSILON = ["a", 1.0] }}
[[method]]
nam = "x"
[budget]
seconds = -1
"""
    with pytest.raises(FirsthitError) as caught:
        load(tmp_path, text)
    assert caught.value.exit_code == 2
    assert [line.partition("c.toml:")[2] for line in str(caught.value).splitlines()] == [
        "1: sizes.1: 0 is outside [1, 16384]",
        "1: sizes.2 is a whole number, not 'x'",
        "2: unknown key 'stagess' in the top level; did you mean 'stages'?",
        "3: seed is a whole number, not 1.5",
        "8: method.0.parameters.EPSILON.0 is a number, not 'a'",
        "9: method.1 lacks 'name'",
        "10: unknown key 'nam' in method.1; did you mean 'name'?",
        "12: budget.seconds: -1.0 is outside [0, 100000]",
    ]


def test_all_names_that_are_not_there_are_told_at_once(tmp_path):
    text = """title = "t"
surfaces = ["toruss"]
[[method]]
name = "newtn"
[[method]]
name = "ray_march"
parameters = { STEP = 3 }
[[scene.one.placed]]
surface = "sper"
"""
    with pytest.raises(FirsthitError) as caught:
        load(tmp_path, text)
    told = [line.partition("c.toml:")[2] for line in str(caught.value).splitlines()]
    assert [line[: line.index(" ")] for line in told] == ["4:", "7:", "2:", "8:"]
    assert all(name in line for name, line in zip(("newtn", "STEP", "toruss", "sper"), told, strict=True))
