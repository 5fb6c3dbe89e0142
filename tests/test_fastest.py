"""`fastest` stands for the device with the highest peak; a method may name devices of its own."""

import json
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import pytest

from harness import cli
from harness.contract import DeviceInfo, FirsthitError
from harness.experiment import plan, reading, targets
from harness.plugins import find_methods
from harness.running import fastest
from harness.running.environment import _probes_file
from harness.running.fastest import settled

from .conftest import usable_devices

CONFIG = """title = "t"
surfaces = ["sphere"]
sizes = [16]
devices = ["fastest"]
[[method]]
name = "newton"
[[method]]
name = "null"
devices = ["all"]
[accuracy]
size = 16
[budget]
seconds = 0.002
rounds = 1
"""
PROBES = fastest.Probes(1.0, 1.0, 1.0, 1.0, 1.0, 100.0, 90.0, "8 chains", None)


def info(name, resident=None, problem=None):
    return DeviceInfo(name, "", "", "", 1, True, "wall", (), problem, resident)


class Heard:
    """Hear what is told."""

    def __init__(self):
        self.lines = []

    def doing(self, what):
        self.lines.append(what)
        return nullcontext()

    def warned(self, line):
        self.lines.append(line)


@pytest.fixture
def peaks(monkeypatch):
    """Let devices have these peaks, and none that is kept."""
    measured = {}
    monkeypatch.setattr(fastest.kept_answers, "probes_folder", lambda: None)

    def probed(_executor, device, _cache):
        return device, replace(PROBES, peak_gflops=measured[device.name]) if device.name in measured else None

    monkeypatch.setattr(fastest, "probed", probed)
    return measured


def load(tmp_path, text=CONFIG):
    (tmp_path / "c.toml").write_text(text)
    return reading.load(tmp_path / "c.toml", find_methods())


@pytest.mark.parametrize(
    ("measured", "first"),
    [
        ({info("opencl:a"): 10.0, info("opencl:b"): 20.0}, "opencl:b"),
        ({info("opencl:a"): 19.0, info("opencl:b"): 20.0}, "opencl:a"),
        ({info("opencl:cpu"): 900.0, info("opengl:gpu", 1024): 20.0}, "opengl:gpu"),
        ({info("opencl:gpu", 1024): 100.0, info("opengl:gpu", 1024): 101.0, info("opencl:c"): 5.0}, "opencl:gpu"),
        ({}, None),
    ],
)
def test_a_gpu_comes_first_then_the_peak_and_what_is_about_as_fast_in_the_order_of_finding(measured, first):
    order = targets.ranked(measured)
    assert len(order) == len(measured) and set(order) == set(measured)
    assert (order[0].name if order else None) == first


def test_the_word_makes_the_cells_that_the_name_makes(tmp_path, peaks):
    found = [info("opencl:slow"), info("opencl:quick"), info("opencl:slow-2", problem="no")]
    peaks |= {"opencl:slow": 10.0, "opencl:quick": 20.0}
    heard = Heard()
    made = settled([load(tmp_path)], found, heard)
    named = load(tmp_path, CONFIG.replace("fastest", "opencl:quick"))
    keys = [[p.key for p in plan.plan(part, find_methods(), found)] for part in (*made.parts, named)]
    assert keys[0] == keys[1]
    slots = [(p.cell.variant.method, p.cell.device) for p in plan.plan(named, find_methods(), found)]
    assert slots == [("newton", "opencl:quick"), ("null", "opencl:slow"), ("null", "opencl:quick")]
    assert list(made.parts[0].peaks.items()) == [("opencl:quick", 20.0), ("opencl:slow", 10.0)]
    assert "measuring the peak rate of opencl:slow" in heard.lines[0]
    assert heard.lines[-1] == ("the fastest device is opencl:quick, with a peak of 20 Gflop/s (opencl:slow 10)")


def test_a_device_that_may_be_faster_on_an_idle_machine_is_told_of(tmp_path, monkeypatch):
    monkeypatch.setattr(fastest.kept_answers, "probes_folder", lambda: None)
    rates = {"opencl:slowed": (28.0, 7.0), "opencl:quick": (60.0, 30.0), "opencl:steady": (20.0, 19.0)}

    def probed(_executor, device, _cache):
        peak, median = rates[device.name]
        return device, replace(PROBES, peak_gflops=peak, peak_median_gflops=median)

    monkeypatch.setattr(fastest, "probed", probed)
    heard = Heard()
    settled([load(tmp_path)], [info(name) for name in rates], heard)
    assert "other programs slowed the probe of opencl:slowed down" in heard.lines[-1]
    settled([load(tmp_path)], [info("opencl:quick"), info("opencl:steady")], heard := Heard())
    assert heard.lines[-1].startswith("the fastest device is opencl:quick"), "the winner's own peak can only be higher"
    settled([load(tmp_path)], [info("opencl:slowed"), info("opencl:quick", 1024)], heard := Heard())
    assert heard.lines[-1].startswith("the fastest device is opencl:quick"), "a GPU comes first anyway"


def test_a_config_without_the_word_measures_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(fastest, "LocalExecutor", None)
    part = load(tmp_path, CONFIG.replace("fastest", "any"))
    assert settled([part], [info("opencl:a")], Heard()).parts == (part,)


def test_what_is_kept_is_not_measured_again(tmp_path, monkeypatch):
    monkeypatch.setattr(fastest.kept_answers, "probes_folder", lambda: tmp_path)
    file = _probes_file(info("opencl:a"), tmp_path)
    file.write_text(json.dumps({**vars(PROBES)}))
    heard = Heard()
    (part,) = settled([load(tmp_path)], [info("opencl:a")], heard).parts
    assert part.config.devices == ["opencl:a"]
    assert heard.lines == ["the fastest device is opencl:a, with a peak of 100 Gflop/s"]


@pytest.mark.usefixtures("peaks")
@pytest.mark.parametrize("found", [[], [info("opencl:a", problem="no")], [info("opencl:unprobed")]])
def test_without_a_device_that_works_none_is_the_fastest(tmp_path, found):
    with pytest.raises(FirsthitError, match="no usable device") as caught:
        settled([load(tmp_path)], found, Heard())
    assert caught.value.exit_code == 3


def test_of_a_config_that_only_rasters_the_fastest_draws_triangles(tmp_path, peaks):
    peaks |= {"opencl:quick": 50.0, "opengl:slow": 5.0}
    text = CONFIG.replace('devices = ["fastest"]', 'devices = ["fastest"]\nstages = ["raster"]')
    (part,) = settled([load(tmp_path, text)], [info("opencl:quick"), info("opengl:slow")], Heard()).parts
    assert part.config.devices == ["opengl:slow"]


def test_the_word_is_no_device_before_peaks_are_measured(tmp_path):
    with pytest.raises(ValueError, match="must be found"):
        plan.plan(load(tmp_path), find_methods(), [info("opencl:a")])


def test_an_option_for_devices_counts_for_every_method(tmp_path):
    part = load(tmp_path)
    assert part.wanted_devices() == ["fastest", "all"]
    assert part.on(["opencl:a"]).wanted_devices() == ["opencl:a"]
    assert part.on(()) is part


def test_a_methods_devices_are_held_to_their_limits(tmp_path):
    with pytest.raises(FirsthitError, match=r"9.*'all' is named twice"):
        load(tmp_path, CONFIG.replace('["all"]', '["all", "all"]'))


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not usable_devices(), reason="no device")
def test_a_run_says_what_it_chose_and_a_gate_plans_the_same_cells(tmp_path, peaks, capsys):
    names = [found.name for found in usable_devices()]
    peaks |= {name: 10.0 + 5.0 * i for i, name in enumerate(names)}
    chosen = targets.ranked({found: peaks[found.name] for found in usable_devices()})[0].name
    (tmp_path / "c.toml").write_text(CONFIG)
    where = [str(tmp_path / "c.toml"), "--runs", str(tmp_path / "runs")]
    assert cli.main(["run", *where]) == 0
    assert f"the fastest device is {chosen}, with a peak of" in capsys.readouterr().err
    told = json.loads((tmp_path / "runs/c/plan.json").read_text())
    assert next(iter(told["peaks"])) == chosen and set(told["peaks"]) == set(names)
    assert sorted(cell["slot"].split()[-1] for cell in told["cells"]) == sorted([chosen, *names])
    assert cli.main(["plan", *where, "--json"]) == 0
    assert {cell["state"] for part in json.loads(capsys.readouterr().out)["parts"] for cell in part["cells"]} == {
        "done"
    }
    baseline = ["--baseline", str(tmp_path / "b.toml")]
    assert cli.main(["bless", *where, *baseline, "--reason", "first"]) == 0
    assert cli.main(["gate", *where, *baseline]) == 0
    assert cli.main(["run", *where, "--device", names[0]]) == 0
    told = json.loads((tmp_path / "runs/c/plan.json").read_text())
    assert [cell["slot"].split()[-1] for cell in told["cells"]] == [names[0]] * 2 and told["peaks"] == {}


def test_quick_names_the_fastest_and_some_methods_everywhere():
    quick = reading.load(Path(__file__).parents[1] / "configs/quick.toml", find_methods())
    everywhere = [v for v in quick.variants if quick.devices_of(v) == ("all",)]
    assert quick.config.devices == ["fastest"] and 1 <= len({v.method for v in everywhere}) < 6
    assert len({v.method for v in quick.variants} - {"null"}) >= 8
    assert [surface.name for surface in quick.surfaces] == ["torus", "clebsch", "barth_sextic", "barth_decic"]
