"""A method's knobs at the values that its source prints: as settings, in configs, and on the report's page."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any

import pytest

from harness.cli import main
from harness.contract import FirsthitError, digest
from harness.experiment import reading
from harness.plugins import AS_PRINTED, Plugin, find_methods
from harness.running.cards import card

from .synthetic_run import cell, printed, reported, sampled, tiny_run

CONFIG = """
title = "t"
surfaces = ["sphere"]
[[method]]
name = "sturm"
deviations = true
"""


def _sturm() -> Plugin:
    return find_methods().get("sturm")


def test_as_printed_turns_every_knob_that_is_ours():
    bound = dict(_sturm().setting(AS_PRINTED).parameters)
    defaults = dict(_sturm().variant({}).parameters)
    assert {name for name in bound if bound[name] != defaults[name]} == set(_sturm().method.printed)
    assert bound | _sturm().method.printed == bound


@pytest.mark.parametrize("name", sorted(find_methods().plugins))
def test_a_printed_value_is_another_than_the_default(name):
    method = find_methods().get(name).method
    for parameter in method.parameters:
        assert parameter.printed is None or parameter.printed != parameter.default
        assert parameter.printed is None or type(parameter.printed) is type(parameter.default)


@pytest.mark.parametrize(
    "name", [n for n, p in find_methods().plugins.items() if p.method.printed and p.method.settings]
)
def test_as_printed_is_one_of_the_papers_named_settings(name):
    """So the page of deviations compares with what the papers' tables hold."""
    plugin = find_methods().get(name)
    named = [plugin.setting(setting).parameters for setting in plugin.method.settings]
    assert plugin.setting(AS_PRINTED).parameters in named


def test_a_method_as_printed_is_refused_where_nothing_is_ours():
    with pytest.raises(FirsthitError, match="has no setting 'as printed'"):
        find_methods().get("null").setting(AS_PRINTED)


def test_a_single_printed_knob_is_not_run_twice():
    plugin = _sturm()
    first = next(p for p in plugin.method.parameters if p.printed is not None)
    alone = dataclasses.replace(plugin, method=dataclasses.replace(plugin.method, parameters=(first,)))
    assert len({variant.parameters for variant in alone.deviations()}) == len(alone.deviations()) == 2


def test_a_config_asks_for_each_change_alone_and_for_all(tmp_path: Path):
    path = tmp_path / "d.toml"
    path.write_text(CONFIG, encoding="utf-8")
    variants = [str(v) for v in reading.load(path, find_methods()).variants]
    assert variants[0] == "sturm"
    assert variants[-1] == "sturm as printed"
    assert len(variants) == len(_sturm().method.printed) + 2


def test_list_methods_names_the_printed_setting(capsys):
    assert main(["list", "methods"]) == 0
    first = capsys.readouterr().out.partition("\n\n")[0]
    lines = {line.split()[0]: line for line in first.splitlines()}
    for name, plugin in find_methods().plugins.items():
        for knob, value in plugin.method.printed.items():
            assert f"{knob} = {value:g}" in lines[name]


def _cell(plugin: Plugin, knobs: dict[str, Any], times: float, misses: int) -> Any:
    made = cell("ray_march", "torus", "opencl:intel", "float32")
    variant = plugin.variant(knobs)
    slot = f"{variant} torus"
    made |= {"slot": slot, "key": digest(slot), "method": "sturm", "variant": str(variant), "arrays": None}
    made |= {"parameters": dict(variant.parameters)}
    made["accuracy"] |= {"misses": misses}
    return sampled(made, [times * (2.0 + 0.01 * i) for i in range(12)])


def test_the_page_says_what_each_change_is_worth(tmp_path: Path):
    plugin = _sturm()
    printed_knobs = plugin.method.printed
    cells = [_cell(plugin, {}, 1.0, 0), _cell(plugin, {"BY_SIGN": 0}, 1.5, 3), _cell(plugin, printed_knobs, 0.5, 40)]
    folder = tiny_run(tmp_path / "run", *cells)
    told = json.loads((folder / "plan.json").read_text())
    (folder / "plan.json").write_text(json.dumps(told | {"methods": {"sturm": card(plugin)}}))
    _, report = reported(folder)
    (section,) = [s for s in report.sections if s.title == "Deviations from the papers"]
    lines = [line.split(" | ") for line in printed(section.details).splitlines() if line.startswith("Sturm")]
    by_knob = {line[1]: line for line in lines}
    assert set(by_knob) == {"BY_SIGN", "all of these"}  # the others were not run alone
    assert by_knob["BY_SIGN"][2:4] == ["1", "0"]
    assert by_knob["BY_SIGN"][6] == "1.50×"
    assert by_knob["BY_SIGN"][10:12] == ["0", "3"]
    assert by_knob["all of these"][10:12] == ["0", "40"]


def test_a_run_without_printed_variants_has_no_such_page(tmp_path: Path):
    _, report = reported(tiny_run(tmp_path / "run", cell("ray_march", "torus", "opencl:intel", "float32")))
    assert not [s for s in report.sections if s.title == "Deviations from the papers"]


def test_the_projects_own_config_runs_every_change():
    experiment = reading.load(Path(__file__).parents[1] / "configs" / "deviations.toml", find_methods())
    changed = {name for name, plugin in find_methods().plugins.items() if plugin.method.printed}
    assert {variant.method for variant in experiment.variants} == changed | {"null"}
