"""The schema of configs is what the reader does: it takes every shipped config, and refuses nothing that is read."""

import copy
import functools
import json
import tomllib
from contextlib import nullcontext
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from harness import ROOT, schemas
from harness.cli import main
from harness.contract import FirsthitError
from harness.experiment import reading, shipped
from harness.experiment.config import Config, MethodChoice
from harness.experiment.resolving import resolve
from harness.experiment.schema import schema
from harness.experiment.toml_file import ConfigFile
from harness.plugins import find_methods

SHIPPED = ROOT / "configs" / "schema.json"
WHOLE = """
title = "Every table, with every kind of value"
baseline = "newton"
studies = ["extrema_bounds"]
surfaces = ["torus", "mine"]
families = ["cusp"]
sizes = [64]
samples_per_pixel = [4]
precisions = ["float32"]
stages = ["compute", "raster"]
prepass = ["none"]
origins = ["eye"]
proxies = ["box"]
tolerances = [0.5]
normals = ["gradient"]
devices = ["any"]
seed = 3
accuracy = { size = 64, grazing_margin = 0.01, max_wrong_share = 0.1, undecided = 0.5 }
budget = { seconds = 1.0, interval = 0.1, rounds = 2, repetitions = 3, timeout = 9.0, triangles = 10 }
angles = { values = [0.0, 90.0], azimuth = 1.0, fov = 20.0, distance = 9.0 }
directions = { count = 2, seed = 2, fov = 20.0, distance = 9.0 }
method = [
    { name = "newton", parameters = { EPSILON = [0.001, 0.01] }, stages = ["compute"], deviations = false },
    { name = "ray_march", settings = ["as printed"] },
]
[[view]]
name = "front"
azimuth = 1.0
elevation = 2.0
fov = 3.0
distance = 4.0
target = [0.0, 0.5, 1.0]
set = "own"
[surface.mine]
formula = "x^2 + y^2 + z^2 - a"
domain = "sphere:2"
parameters = { a = 1.0 }
[gate.figures.misses]
absolute = 1.0
relative = 0.1
better = "lower"
gated = true
[gate.last_bits.misses]
absolute = 1.0
relative = 0.1
[scene.made]
generate = "lattice"
counts = [2]
seed = 4
azimuth = 1.0
elevation = 2.0
fov = 3.0
distance = 90.0
[[scene.one.placed]]
surface = "torus"
parameters = { R = 0.5 }
domain = "sphere:2"
at = [0.0, 0.0, 0.0]
turn = [1.0, 2.0, 3.0]
scale = 2.0
colour = [0.1, 0.2, 0.3]
method = "newton"
knobs = { EPSILON = 0.01 }
"""


@functools.cache
def methods():
    return find_methods()


def refusal(table, taken):
    """What the reader says against a table; None where it reads it. Names are looked up where the schema refuses it."""
    file = ConfigFile(Path("c.toml"), "", table)
    try:
        config = reading.config_of(file)
        if not taken:
            resolve(config, file, methods())
    except FirsthitError as error:
        return str(error)
    return None


@pytest.fixture(scope="module")
def validator():
    made = schema()
    Draft202012Validator.check_schema(made)
    return Draft202012Validator(made)


def places(value, where=()):
    """Yield the place of every value in a table."""
    yield where
    for key, item in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from places(item, (*where, key))


def changed(table, where, change):
    """A copy of a table in which `change` was called with the holder and the key of the value at a place."""
    whole = {"": copy.deepcopy(table)}
    *path, last = ("", *where)
    change(functools.reduce(lambda value, key: value[key], path, whole), last)
    return whole[""]


OTHERS = ("other", 2.0, 3, -1, 1e19, True, [], {}, [1, 1], [-1.5])


def mutations():
    """Yield tables in which one value is another, is gone or stands twice, or a key was added, each with its name."""
    whole = tomllib.loads(WHOLE)
    for where in places(whole):
        here = functools.reduce(lambda value, key: value[key], where, whole)
        for other in OTHERS:
            yield f"{where} = {other!r}", changed(whole, where, lambda holder, key, o=other: put(holder, key, o))
        yield f"{where} twice", changed(whole, where, lambda holder, key: put(holder, key, [holder[key]] * 2))
        if where:
            yield f"{where} is gone", changed(whole, where, lambda holder, key: holder.pop(key))
        for name in fields_of(here) if isinstance(here, dict) else ():
            for other in OTHERS:
                added = (*where, name)
                yield f"{added} = {other!r}", changed(whole, added, lambda holder, key, o=other: put(holder, key, o))


def fields_of(table):
    """The fields that a table of WHOLE could have beside its own, by what it has; and one that no table has."""
    beside = [names - table.keys() for names in tables() if len(table) > 1 and names > table.keys()]
    return sorted({"other"}.union(*beside))


@functools.cache
def tables():
    made = schema()
    return [set(own["properties"]) for own in (made, *made["$defs"].values())]


def put(holder, key, value):
    holder[key] = value


def test_the_schema_refuses_what_the_reader_refuses_but_for_what_values_mean(validator):
    whole = tomllib.loads(WHOLE)
    assert refusal(whole, taken=False) is None and validator.is_valid(whole)
    found = [(name, taken := validator.is_valid(table), refusal(table, taken)) for name, table in mutations()]
    assert len(found) > 1500 and sum(not taken for _, taken, _ in found) > 1000
    assert not [name for name, taken, told in found if told is None and not taken], "it refuses what is read"
    more = [f"{name}: {told}" for name, taken, told in found if told and taken]
    assert not [line for line in more if not line.endswith((" is a whole number, not 2.0", " is named twice"))]


@pytest.mark.parametrize("name", shipped.names())
def test_every_shipped_config_is_valid(validator, name):
    assert not [*validator.iter_errors(tomllib.loads(shipped.located(name).read_text(encoding="utf-8")))]


@pytest.mark.parametrize(
    ("text", "taken"),
    [
        ('title = "t"\ninclude = ["quick.toml"]', True),
        ('title = "t"\ninclude = ["quick.toml"]\nsizes = [64]', False),
        ('title = "t"\nsurfaces = "torus"', False),
        ('title = "t"\nsurfaces = "torus"\nmethod = { name = "newton" }', True),
        ('title = "t"\nstudies = ["extrema_bounds"]', True),
        ('title = "t"', False),
    ],
)
def test_what_a_whole_config_must_name(validator, text, taken):
    table = tomllib.loads(text)
    file = ConfigFile(ROOT / "configs" / "c.toml", text, table)
    assert validator.is_valid(table) == taken
    with nullcontext() if taken else pytest.raises(FirsthitError):
        resolve(reading.config_of(file), file, methods())


def test_the_shipped_schema_is_up_to_date_and_is_what_the_command_prints(capsys):
    assert main(["schema"]) == 0
    printed = capsys.readouterr().out
    assert printed == SHIPPED.read_text(encoding="utf-8"), "run `firsthit schema > configs/schema.json`"
    assert json.loads(printed) == schema()


def test_every_field_says_what_it_is():
    made = schema()
    tables = {"the config": made, **made["$defs"]}
    silent = [
        f"{table}.{name}"
        for table, own in tables.items()
        for name, field in own["properties"].items()
        if not field.get("description")
    ]
    assert not silent, "say it in the dataclass's docstring: `field: meaning`"


def test_descriptions_are_read_from_the_docstring():
    about, fields = schemas.descriptions(MethodChoice)
    assert about.startswith("Choose a method, and one value or several")
    assert fields["deviations"].endswith("that the method's source prints")
    assert schemas.descriptions(Config)[1]["proxies"] == schemas.descriptions(Config)[1]["normals"] == "of stage raster"


def test_defaults_ranges_words_and_names_are_told():
    made = schema()
    budget, config = made["$defs"]["BudgetChoice"]["properties"], made["properties"]
    assert budget["timeout"] | {"description": ""} == {
        "description": "",
        "type": "number",
        "minimum": 1e-3,
        "maximum": 1e6,
        "default": 60.0,
    }
    assert config["precisions"]["default"] == ["float32"]
    assert config["precisions"]["anyOf"][1] == {"enum": ["float32", "float64"]}
    assert "torus" in config["surfaces"]["anyOf"][1]["anyOf"][0]["enum"]
    assert "newton" in made["$defs"]["MethodChoice"]["properties"]["name"]["anyOf"][0]["enum"]
    assert "misses" in made["$defs"]["GateChoice"]["properties"]["figures"]["propertyNames"]["enum"]
