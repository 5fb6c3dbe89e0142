"""A baseline that was blessed on one device gates another one, and what cannot be compared is told before anything."""

import dataclasses
from xml.etree import ElementTree

import numpy as np
import pytest

from harness.cli import main
from harness.contract import CellStatus
from harness.devices import host
from harness.devices.executor import CellError, LocalExecutor
from harness.experiment import identity, plan, reading
from harness.gate import entries
from harness.gate.entries import asked_of
from harness.plugins import find_methods

from .conftest import usable_devices
from .test_gate import CONFIG, MINE, THEIRS, _copy, _plant, _row

pytestmark = pytest.mark.usefixtures("devices_found_once")


@pytest.fixture(scope="module")
def two_devices():
    """Two devices that compile with compilers of different makers, if possible."""
    names = [info.name for info in usable_devices() if info.name.startswith("opencl:")]
    names += [info.name for info in usable_devices() if info.name.startswith("opengl:")]
    if len(names) < 2:
        pytest.skip("fewer than two devices")
    return names[0], names[1]


@pytest.fixture(scope="module")
def blessed_elsewhere(tmp_path_factory, two_devices, devices_found_once):  # noqa: ARG001
    """The text of a baseline that was blessed on the first device."""
    folder = tmp_path_factory.mktemp("elsewhere")
    _copy(folder / "plugins", MINE, "mine")
    _copy(folder / "plugins", THEIRS, "theirs")
    (folder / "plugin.toml").write_text(CONFIG.format(device=two_devices[0]))
    arguments = ["bless", folder / "plugin.toml", "--runs", folder, "--reason", "the first"]
    assert main(["--plugins", *map(str, (folder / "plugins", *arguments))]) == 0
    return (folder / "baselines" / "plugin.toml").read_text()


def _with_other_bits(text):
    """A baseline's text as if its device rounded its sums otherwise."""
    line = next(line for line in text.splitlines() if line.startswith("sums = "))
    return text.replace(line, 'sums = "0123456789abcdef"')


@pytest.fixture(params=["as it is", "with other last bits"])
def gated(request, tmp_path, two_devices, capsys, blessed_elsewhere):
    """A function that gates the copies on the second device: exit code, stdout, stderr.

    It is run with the first device's baseline as it is, and as if that device's last bits were others.
    """
    plugins, config = tmp_path / "plugins", tmp_path / "plugin.toml"
    _copy(plugins, MINE, "mine")
    _copy(plugins, THEIRS, "theirs")
    config.write_text(CONFIG.format(device=two_devices[0]))
    baseline = tmp_path / "baselines" / "plugin.toml"
    baseline.parent.mkdir()
    other_bits = request.param == "with other last bits"
    baseline.write_text(_with_other_bits(blessed_elsewhere) if other_bits else blessed_elsewhere)

    def gate(*arguments, device=two_devices[1], command="gate"):
        capsys.readouterr()
        words = ["--plugins", plugins, command, config, "--runs", tmp_path, "--device", device, *arguments]
        code = main([str(word) for word in words])
        captured = capsys.readouterr()
        assert "Traceback" not in captured.err
        return code, captured.out, captured.err

    gate.plugins, gate.baseline, gate.config, gate.folder = plugins, baseline, config, tmp_path
    return gate


def test_an_unchanged_tree_passes_on_the_other_device(gated):
    code, out, err = gated()
    assert (code, out.splitlines()[-1].startswith("4 pass")) == (0, True), out + err


@pytest.mark.parametrize("gated", ["with other last bits"], indirect=True)  # the one with more slack
def test_a_loosened_threshold_is_caught_on_the_other_device(gated):
    _plant(gated.plugins, "mine", "method.py", '"EPSILON",\n            0.001,', '"EPSILON", 0.05,')
    code, out, _ = gated()
    assert code == 1
    assert _row(out, "mine torus", "error_p99") == "regressed"
    assert _row(out, "theirs", "error_p99") is None


@pytest.mark.parametrize("gated", ["with other last bits"], indirect=True)  # the one with more slack
def test_a_dropped_root_is_caught_on_the_other_device(gated):
    drop = "Hit first_hit(Ray ray, real t0, real t1) {\n    t0 = t0 + 0.5 * (t1 - t0);"
    _plant(gated.plugins, "theirs", "kernel.glsl", "Hit first_hit(Ray ray, real t0, real t1) {", drop)
    code, out, _ = gated()
    assert code == 1
    assert "regressed" in (_row(out, "theirs torus", "wrong_root"), _row(out, "theirs torus", "misses"))
    assert _row(out, "mine", "misses") is None


@pytest.mark.parametrize("gated", ["with other last bits"], indirect=True)  # the one with more slack
def test_one_more_evaluation_a_ray_is_caught_on_the_other_device(gated):
    _plant(gated.plugins, "mine", "kernel.glsl", "hit.evaluations = 1;", "hit.evaluations = 2;")
    code, out, _ = gated()
    assert code == 1
    assert _row(out, "mine torus", "evaluations_mean") == "regressed"
    assert _row(out, "theirs", "evaluations_mean") is None


def test_blessing_on_the_other_device_keeps_the_first(gated, two_devices):
    assert gated("--reason", "also here", command="bless")[0] == 0
    text = gated.baseline.read_text()
    names = [line.split('"')[1].split()[0] for line in text.splitlines() if line.startswith("[device.")]
    assert set(names) == set(two_devices)
    code, out, _ = gated()
    assert (code, out.splitlines()[-1].startswith("4 pass")) == (0, True)


@pytest.mark.parametrize("gated", ["as it is"], indirect=True)
def test_where_nothing_can_be_compared_nothing_runs_and_it_says_what_to_do(gated):
    gated.config.write_text(
        gated.config.read_text().replace('families = ["double_root"]', "")
        + "[[view]]\nname = 'default'\nazimuth = 31\n"
    )
    code, out, err = gated()
    assert (code, out.splitlines()[-1]) == (3, "2 incomparable")
    assert "firsthit: 2 of 2 rows cannot be compared with" in err
    assert f"do: firsthit bless {gated.config} --reason" in err
    assert not (gated.folder / "gate-plugin").exists(), "nothing ran"


@pytest.mark.parametrize("gated", ["as it is"], indirect=True)
def test_rows_that_are_in_no_baseline_run_only_beside_others(gated):
    gated.config.write_text(gated.config.read_text().replace('["torus"]', '["sphere"]'))
    _, out, err = gated()
    assert out.splitlines()[-1].startswith("2 missing, 2 new, 2 pass")
    assert "cannot be compared" not in err
    gated.config.write_text(gated.config.read_text().replace("double_root", "grazing"))
    code, out, err = gated("--runs", gated.folder / "others")
    assert (code, out.splitlines()[-1]) == (3, "4 new")
    assert "not in the baseline; bless to gate it" in err
    assert not (gated.folder / "others").exists(), "nothing ran"


@pytest.mark.parametrize("gated", ["as it is"], indirect=True)
def test_an_absent_device_is_told_before_with_those_that_are_here(gated, two_devices):
    code, _, err = gated(device="opencl:nonesuch")
    assert code == 3
    assert f"--device {two_devices[0]}" in err
    code, out, err = gated("--device", "opencl:nonesuch")
    assert (code, out.splitlines()[-1].startswith("4 incomparable, 4 pass")) == (3, True)
    assert "4 of 8 rows cannot be compared" in err
    assert f"--device {two_devices[0]}" in err[: err.index("[1/")], "it is told before anything runs"


def _planned(text, tmp_path, device="opencl:pocl"):
    path = tmp_path / "asked.toml"
    path.write_text(text)
    info = dataclasses.replace(usable_devices()[0], name=device)
    catalog = find_methods()
    experiment = reading.load(path, catalog)
    experiment = dataclasses.replace(experiment, config=dataclasses.replace(experiment.config, devices=[device]))
    return plan.plan(experiment, catalog, [info], timed=False)


ASKED = """title = "What is asked"
surfaces = ["torus"]
families = ["grazing"]
stages = ["compute", "raster"]
[[method]]
name = "newton"
[[view]]
name = "oblique"
azimuth = 30
[scene.two]
placed = [
    { surface = "torus", at = [0.1, 0.0, 0.3], turn = [30.0, 45.0, 60.0], scale = 0.7 },
    { surface = "sphere", at = [1.0, 0.5, 0.0] },
]
"""


def _scenes(planned):
    return {entries.slot_of(p): asked_of(p)["scene"] for p in planned}


def test_what_was_asked_does_not_depend_on_the_machine(tmp_path, monkeypatch):
    first = _planned(ASKED, tmp_path, "opengl:llvmpipe")
    before = _scenes(first)
    assert len(before) == 4
    monkeypatch.setattr(identity.sources, "packages", lambda: {"numpy": "9"})
    monkeypatch.setattr(host, "processor", lambda: "another")
    monkeypatch.setenv("LP_NATIVE_VECTOR_WIDTH", "128")
    assert _scenes(_planned(ASKED, tmp_path, "opengl:llvmpipe")) == before
    for planned in first:
        if planned.cell.scene:
            for group in planned.cell.scene.groups:  # as if cos and sin rounded otherwise on the host
                group.turn[:] = np.nextafter(group.turn, 1.0)
                group.place[:] = np.nextafter(group.place, -9.0)
    assert _scenes(first) == before
    skipped = _scenes(_planned(ASKED, tmp_path, "opencl:pocl"))
    assert skipped == before, "a device that cannot run a cell is asked the same"


@pytest.mark.parametrize(
    ("old", "new", "changed"),
    [
        ("azimuth = 30", "azimuth = 30.001", 2),
        ("at = [0.1,", "at = [0.10001,", 1),
        ("turn = [30.0,", "turn = [30.001,", 1),
        ('["torus"]', '["sphere"]', 2),
        ("scale = 0.7", "scale = 0.70001", 1),
    ],
)
def test_what_was_asked_tells_other_surfaces_views_and_instances_apart(tmp_path, old, new, changed):
    before = _scenes(_planned(ASKED, tmp_path, "opengl:llvmpipe"))
    after = _scenes(_planned(ASKED.replace(old, new), tmp_path, "opengl:llvmpipe"))
    assert len(set(after.values()) - set(before.values())) == changed


def test_a_device_that_does_not_tell_how_it_computes_costs_its_own_rows(tmp_path, two_devices, capsys, monkeypatch):
    _copy(tmp_path / "plugins", MINE, "mine")
    _copy(tmp_path / "plugins", THEIRS, "theirs")
    config = tmp_path / "plugin.toml"
    config.write_text(CONFIG.format(device='", "'.join(two_devices)))
    shared = ["--plugins", str(tmp_path / "plugins")]
    more = [str(config), "--runs", str(tmp_path)]
    assert main([*shared, "bless", *more, "--reason", "the first"]) == 0
    blessed = (tmp_path / "baselines" / "plugin.toml").read_text()
    for file in (tmp_path / "gate-plugin" / "probes").iterdir():
        file.unlink()
    taken = LocalExecutor.fingerprint

    def fingerprint(self, device):
        if device == two_devices[1]:
            raise CellError(CellStatus.CRASHED, "the worker was killed")
        return taken(self, device)

    monkeypatch.setattr(LocalExecutor, "fingerprint", fingerprint)
    capsys.readouterr()
    junit = tmp_path / "gate.xml"
    for force in ([], ["--force"]):
        assert main([*shared, "gate", *more, "--junit", str(junit), *force]) == 3
        out = capsys.readouterr().out
        told = f"the fingerprint of {two_devices[1]} cannot be taken: the worker was killed"
        assert out.splitlines()[-1] == "4 incomparable, 4 pass" and out.count(told) == 4
        cases = {(case.get("name"), case.get("classname")): case for case in ElementTree.parse(junit).iter("testcase")}
        errors = [case.find("error").text for case in cases.values() if case.find("error") is not None]
        assert len(cases) == 8 and len(errors) == 4 and all(told in error for error in errors)
    assert main([*shared, "bless", *more, "--reason", "again"]) == 3
    assert "not blessed" in capsys.readouterr().err
    assert (tmp_path / "baselines" / "plugin.toml").read_text() == blessed
