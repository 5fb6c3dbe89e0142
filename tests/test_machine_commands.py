"""What commands answer with --json is what docs/machine.md and the schemas say, and what their tables print."""

import dataclasses
import json
import shutil

import pytest
from jsonschema import Draft202012Validator

import surfaces
from harness import ROOT
from harness.cli import build_parser, main
from harness.commands import devices, history, machine_page
from harness.commands import schema as schema_command
from harness.commands.answers.table import ANSWERS, answer_schema
from harness.contract import CLAIMS, DeviceInfo
from harness.devices.discovery import Known
from harness.devices.fingerprint import digests
from harness.devices.probes import Probes
from harness.plugins import find_methods
from harness.results import sealed

from .conftest import usable_devices
from .kept_runs import SLOT, series
from .test_machine import answered as object_of

pytestmark = pytest.mark.usefixtures("devices_found_once")
RESTS = {"tiles": "bernstein", "tiles_interval": "interval_march"}
CONFIG = """title = "Cells to tell of"
surfaces = ["sphere", "heart"]
sizes = [16]
precisions = ["float32"]
devices = ["{device}"]
[[method]]
name = "sphere_tracing"
parameters = {{ AHEAD = [1, 0] }}
[accuracy]
size = 16
[budget]
seconds = 0.01
rounds = 1
"""


@pytest.fixture
def answered(capsys):
    """A function that runs a command of ANSWERS, holds its object against its schema, and returns it."""

    def answer(command, *arguments, code=0):
        value, _ = object_of(capsys, *command.split(), *arguments, code=code)
        Draft202012Validator(answer_schema(command)).validate(value)
        return value

    return answer


@pytest.fixture(scope="module")
def device_name():
    names = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
    if not names:
        pytest.skip("no OpenCL device")
    return names[0]


@pytest.fixture
def config(tmp_path, device_name):
    path = tmp_path / "told.toml"
    path.write_text(CONFIG.format(device=device_name))
    return path


@pytest.mark.parametrize("command", ANSWERS)
def test_schemas_are_schemas_and_a_command_prints_them(command, capsys):
    made = answer_schema(command)
    Draft202012Validator.check_schema(made)
    assert main(["schema", "--of", command]) == 0
    assert json.loads(capsys.readouterr().out) == made
    checks = Draft202012Validator(made)
    said = {"format": 1, "firsthit": "1", "command": command.split()[0], "exit_code": 2, "error": "no such config"}
    assert checks.is_valid(said)
    assert not checks.is_valid(said | {"error": None}), "without an error there is content"
    assert not checks.is_valid(said | {"parts": []}), "with an error there is none"


def test_every_command_with_json_is_documented_and_every_field_says_what_it_is():
    assert tuple(ANSWERS) == schema_command.ANSWERS
    page = machine_page.page()
    assert page == (ROOT / "docs" / "machine.md").read_text(encoding="utf-8"), machine_page.__doc__
    (commands,) = (action for action in build_parser()._actions if action.dest == "command")
    offering = {name for name, parser in commands.choices.items() if "--json" in parser._option_string_actions}
    assert {command.split()[0] for command in ANSWERS} == offering


def test_surfaces_are_listed_with_their_facts(answered):
    value = answered("list surfaces")
    listed = {one["name"]: one for one in value["surfaces"]}
    for group in surfaces.groups():
        assert {name for name in listed if listed[name]["group"] == group} >= set(surfaces.names(group))
    assert {one["group"] for one in value["surfaces"]} == set(value["groups"])
    torus, nested = listed["torus"], listed["torus:nested"]
    assert (torus["degree"], torus["parameters"], torus["form_of"]) == (4, {"R": "0.7", "r": "0.3"}, None)
    assert torus["domain"]["shape"] == "box" and torus["domain"]["upper"][2] == surfaces.get("torus").domain.upper[2]
    assert nested["form_of"] == "torus" and nested["formula"] != torus["formula"]
    assert torus["operations"] == surfaces.operations(surfaces.get("torus"))
    assert listed["barth_sextic"]["facts"]["singular_points"] == 50
    assert listed["barth_sextic"]["domain"]["shape"] == "sphere"


def test_methods_are_listed_with_knobs_claims_and_refusals(answered):
    value, catalog = answered("list methods"), find_methods()
    listed = {one["name"]: one for one in value["methods"]}
    assert set(listed) == set(catalog.plugins) and value["broken"] == {}
    method = catalog.get("ray_march").method
    knobs = {knob["name"]: knob for knob in listed["ray_march"]["knobs"]}
    assert {name: knob["default"] for name, knob in knobs.items()} == {p.name: p.default for p in method.parameters}
    assert {p.name: knobs[p.name]["printed"] for p in method.parameters} == {
        p.name: p.printed for p in method.parameters
    }
    assert {name: set(one["claims"]) for name, one in listed.items()} == {
        name: set(plugin.method.claims) for name, plugin in catalog.plugins.items()
    }
    assert {name: one["rest"] for name, one in listed.items() if one["rest"]} == RESTS
    assert value["claims"].items() <= CLAIMS.items()
    assert listed["sphere_tracing"]["refuses"]["heart"].startswith("the surface states no distance")
    assert "torus" not in listed["sphere_tracing"]["refuses"] and not listed["newton"]["refuses"]


def test_a_method_that_cannot_be_loaded_is_listed_with_its_reason(answered, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "method.py").write_text("METHOD = nonesuch")
    (tmp_path / "mine" / "kernel.glsl").write_text("")
    value = answered("list methods", "--plugins", tmp_path)
    assert "NameError" in value["broken"]["mine"] and "mine" not in {one["name"] for one in value["methods"]}


def test_configs_and_devices_are_listed(answered):
    configs = {one["name"]: one for one in answered("list configs")["configs"]}
    assert configs["quick"]["path"] == str(ROOT / "configs" / "quick.toml") and configs["quick"]["title"]
    names = {one["name"] for one in answered("list devices")["devices"] if one["problem"] is None}
    assert names == {info.name for info in usable_devices()}


def test_devices_say_what_they_are_worth_and_which_compute_alike(answered, monkeypatch):
    first = DeviceInfo("opencl:a", "A", "driver", "compiler", 4, True, "wall", (("pyopencl", "1"),))
    found = [first, dataclasses.replace(first, name="opencl:b"), dataclasses.replace(first, name="x", problem="none")]
    probes = Probes(1.0, 1.0, 0.5, 1.0, 1.0, 143.5, 120.0, "8 chains", None)
    parts = {"float32": {"sums": "1"}, "host": {"tan": "2"}}
    theirs = [parts, parts | {"float32": {"sums": "3"}}]
    looked = {info.name: (info, probes, one) for info, one in zip(found, theirs, strict=False)}
    monkeypatch.setattr(devices, "known_devices", lambda **_: Known(found, 0.0))
    monkeypatch.setattr(devices, "_look", lambda _, info, *__: looked.get(info.name, (info, None, None)))
    value = answered("devices")
    a, b, broken = value["devices"]
    assert value["since"] == "1970-01-01T00:00:00+00:00"
    assert (a["probes"]["peak_gflops"], a["probes"]["peak_median_gflops"]) == (143.5, 120.0)
    assert a["digests"] == digests(parts) and b["alike"] == {"float32": "opencl:b", "host": "opencl:a"}
    assert (broken["problem"], broken["probes"], broken["alike"]) == ("none", None, {})
    monkeypatch.setattr(devices, "known_devices", lambda **_: Known(found[2:], None))
    assert answered("devices", code=3)["since"] is None


@pytest.fixture(scope="module")
def ran(tmp_path_factory, device_name, devices_found_once):  # noqa: ARG001
    """A config and the folder of its runs, which was run once."""
    folder = tmp_path_factory.mktemp("ran")
    (folder / "told.toml").write_text(CONFIG.format(device=device_name))
    assert main(["run", str(folder / "told.toml"), "--runs", str(folder / "runs")]) == 0
    return folder / "told.toml", folder / "runs"


def test_a_plan_tells_each_cell_before_and_after_it_has_run(answered, ran, tmp_path):
    config, runs = ran
    (part,) = answered("plan", config, "--runs", tmp_path)["parts"]
    assert (part["config"], part["title"]) == (str(config), "Cells to tell of")
    assert part["to_run"] == len(part["cells"]) == 4
    assert [(cell["surface"], cell["knobs"]["AHEAD"], cell["state"], cell["seconds"]) for cell in part["cells"]] == [
        *(("sphere", knob, "to run", 1.41) for knob in (1, 0)),
        *(("heart", knob, "skip", 0.0) for knob in (1, 0)),
    ]
    assert part["seconds"] == 2.82 and "the surface states no distance" in part["cells"][2]["reason"]
    assert part["cells"][0]["view"] == {
        "name": "default",
        **{"azimuth": 30.0, "elevation": 30.0, "fov": 30.0, "distance": None, "target": None, "set": None},
    }
    (after,) = answered("plan", config, "--runs", runs)["parts"]
    assert [cell["key"] for cell in after["cells"]] == [cell["key"] for cell in part["cells"]]
    assert {cell["state"] for cell in after["cells"]} == {"done"}
    assert [cell["status"] for cell in after["cells"]] == ["ok", "ok", "skipped", "skipped"]
    assert (after["to_run"], after["seconds"]) == (0, 0)


def test_why_tells_what_differs_between_two_results(answered, ran, tmp_path):
    shutil.copytree(ran[1], runs := tmp_path / "runs")
    folder = runs / "told" / "cells"
    first = next(path for path in sorted(folder.glob("*.json")) if '"ok"' in path.read_text())
    alone = answered("why", first.stem, "--runs", runs)
    assert (alone["key"], alone["status"], alone["reason"]) == (first.stem, "ok", None)
    assert alone["slot"].startswith("sphere_tracing[AHEAD=")
    assert alone["before"] is alone["after"] is None and alone["since"] == []
    row = sealed.read(first)
    row["key"], row["environment"]["started"] = "f" * 16, "2999-01-01T00:00:00+00:00"
    row["identity"]["device"]["driver"] = "another"
    row["identity"]["methodology"]["harness/limits.py"] = "edited"
    row["identity"]["method"].pop(gone := next(iter(row["identity"]["method"])))
    (folder / f"{row['key']}.json").write_bytes(sealed.sealed(row))
    earlier = answered("why", first.stem, "--runs", runs)
    assert earlier["since"] is None and earlier["after"]["key"] == row["key"]
    changes = {tuple(one["part"]): (one["change"], one["before"], one["now"]) for one in earlier["after"]["changes"]}
    assert changes[("device", "driver")][::2] == ("changed", "another")
    assert changes[("methodology", "harness/limits.py")] == ("changed", None, None)
    assert changes[("method", gone)] == ("gone", None, None)
    later = answered("why", row["key"], "--runs", runs)
    assert later["before"] == earlier["after"] | {"key": first.stem, "started": earlier["started"]}
    assert {tuple(one["part"]) for one in later["since"]} >= {("methodology", "harness/limits.py"), ("method", gone)}


def test_a_gate_tells_each_figure_with_what_it_is_held_to(answered, config, tmp_path, capsys):
    runs = ("--runs", tmp_path / "runs")
    value = answered("gate", config, *runs, code=2)
    assert "baselines" in value["error"]
    assert main(["bless", str(config), *map(str, runs), "--reason", "the first"]) == 0
    value = answered("gate", config, *runs)
    assert value["counts"] == {
        **{"regressed": 0, "missing": 0, "incomparable": 0, "new": 0, "improved": 0, "pass": 4},
    }
    baseline = tmp_path / "baselines" / "told.toml"
    assert (value["config"], value["baseline"], value["against"]) == (str(config), str(baseline), None)
    row = next(one for one in value["rows"] if " sphere " in one["slot"])
    assert (row["rule"], row["verdict"], row["reason"]) == ("exact", "pass", None)
    figures = {one["figure"]: one for one in row["figures"]}
    assert figures["misses"] == {
        **{"figure": "misses", "before": 0, "now": 0, "allowed": 0, "verdict": "pass"},
        "tolerance": {"better": "lower", "absolute": 0, "relative": 0},
    }
    assert figures["error_max"]["tolerance"]["relative"] == 0.05 and row["command"].startswith("firsthit gate ")
    text = baseline.read_text()
    mean = figures["evaluations_mean"]["now"]
    assert f"evaluations_mean = {mean}" in text
    baseline.write_text(text.replace(f"evaluations_mean = {mean}", "evaluations_mean = 0.125"))
    value = answered("gate", config, *runs, code=1)
    worse = {one["figure"]: one for one in value["rows"][0]["figures"] if one["verdict"] != "pass"}
    assert list(worse) == ["evaluations_mean"] and worse["evaluations_mean"]["before"] == 0.125
    assert worse["evaluations_mean"]["now"] > worse["evaluations_mean"]["allowed"]
    assert main(["gate", str(config), *map(str, runs)]) == 1
    assert capsys.readouterr().out.count("evaluations_mean") == value["counts"]["regressed"]


def test_a_history_tells_its_steps(answered, config, tmp_path, monkeypatch):
    monkeypatch.setattr(history.commits, "read_all", lambda _: (series(1, 1, 5), []))
    value = answered("history", config, "-o", tmp_path / "drawn")
    (step,) = value["steps"]
    assert (value["runs"], value["page"]) == (3, str(tmp_path / "drawn" / "index.html"))
    assert (step["figure"], step["slot"], step["worse"], step["before"], step["now"]) == (
        "misses",
        SLOT,
        True,
        "1",
        "5",
    )
    assert (step["subject"], len(step["commit"])) == ("change 2", 40)
