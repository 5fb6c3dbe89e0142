"""Answers about devices that are kept between commands: when they hold, when not, and that no row is made of one."""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from harness import ROOT, cli
from harness.contract import DeviceInfo
from harness.devices import discovery, kept_answers
from harness.devices.executor import LocalExecutor
from harness.results import sealed
from harness.running.environment import probed

from .conftest import usable_devices
from .test_runner import CONFIG

DEVICE = DeviceInfo("opencl:a", "A", "driver 1", "compiler 1", 4, True, "device", (("pyopencl", "1"),))
BROKEN = dataclasses.replace(DEVICE, name="opencl:a-2", problem="its compiler fails")


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def driver(tmp_path) -> Path:
    path = tmp_path / "libdriver.so"
    path.write_text("version 1")
    return path


def test_an_answer_comes_back_as_it_was_kept(cache, driver):
    before = time.time()
    kept_answers.keep("opencl", [DEVICE], [driver])
    answer = kept_answers.recall("opencl")
    assert answer is not None and answer.devices == (DEVICE,) and answer.since >= before - 1.0
    assert kept_answers.recall("opengl") is None
    assert list(cache.glob("firsthit/*/opencl.json"))


def _replace(driver: Path) -> None:
    driver.write_text("version 2 of the driver")


def _touch(driver: Path) -> None:
    os.utime(driver, ns=(0, driver.stat().st_mtime_ns + 1))


@pytest.mark.parametrize("change", [Path.unlink, _replace, _touch])
def test_a_driver_that_was_replaced_is_looked_at_anew(driver, change):
    kept_answers.keep("opencl", [DEVICE], [driver])
    change(driver)
    assert kept_answers.recall("opencl") is None


@pytest.mark.parametrize("name", ["OCL_ICD_FILENAMES", "LP_NUM_THREADS", "CUDA_VISIBLE_DEVICES", "LD_LIBRARY_PATH"])
def test_an_environment_variable_that_drivers_listen_to_is_seen(driver, monkeypatch, name):
    monkeypatch.delenv(name, raising=False)
    kept_answers.keep("opencl", [DEVICE], [driver])
    monkeypatch.setenv("EDITOR_OF_MINE", "no driver asks for this")
    assert kept_answers.recall("opencl")
    monkeypatch.setenv(name, "\udcff")  # a byte that is no text
    assert kept_answers.recall("opencl") is None


@pytest.mark.parametrize(
    ("part", "name", "now"),
    [
        (kept_answers.host, "processor", lambda: "another"),
        (kept_answers.host, "cores", lambda: 1024),
        (kept_answers.sources, "methodology", lambda: {"harness/devices/opencl.py": "edited"}),
        (kept_answers, "version", lambda _: "99"),
        (kept_answers.platform, "release", lambda: "another kernel"),
        (kept_answers, "MACHINE", (Path("/proc/version"),)),
    ],
)
def test_the_machine_the_packages_and_the_harness_are_seen(driver, monkeypatch, part, name, now):
    kept_answers.keep("opencl", [DEVICE], [driver])
    monkeypatch.setattr(part, name, now)
    assert kept_answers.recall("opencl") is None


def test_a_driver_that_is_installed_is_seen_before_anything_has_loaded_it(driver, tmp_path, monkeypatch):
    vendors = tmp_path / "vendors"
    vendors.mkdir()
    monkeypatch.setattr(kept_answers, "LISTS", (vendors,))
    kept_answers.keep("opencl", [DEVICE], [driver])
    (vendors / "new.icd").write_text(f"{tmp_path / 'libnew.so'}\n")
    assert kept_answers.recall("opencl") is None
    kept_answers.keep("opencl", [DEVICE], [driver])
    assert kept_answers.recall("opencl")
    (tmp_path / "libnew.so").write_text("the driver that the list names")
    assert kept_answers.recall("opencl") is None


def test_a_device_with_a_problem_is_not_kept_unless_it_doubles_one_that_works(driver):
    kept_answers.keep("opencl", [DEVICE, BROKEN], [driver])
    assert kept_answers.recall("opencl").devices == (DEVICE, BROKEN)
    kept_answers.keep("opencl", [dataclasses.replace(DEVICE, problem="hangs")], [driver])
    assert kept_answers.recall("opencl") is None


def test_that_there_is_no_device_is_not_kept(driver):
    kept_answers.keep("opencl", [DEVICE], [driver])
    kept_answers.keep("opencl", [], [driver])
    assert kept_answers.recall("opencl") is None


def test_where_the_system_does_not_tell_what_ran_nothing_is_kept(cache):
    kept_answers.keep("opencl", [DEVICE], None)
    assert not cache.exists()


@pytest.mark.parametrize("damage", ["", "[]", "{}", "null", "half", "edited"])
def test_a_damaged_answer_is_none(cache, driver, damage):
    kept_answers.keep("opencl", [DEVICE], [driver])
    (file,) = cache.glob("firsthit/*/opencl.json")
    text = file.read_text()
    edited = {"half": text[: len(text) // 2], "edited": text.replace("driver 1", "driver 2")}
    file.write_text(edited.get(damage, damage))
    assert kept_answers.recall("opencl") is None
    kept_answers.keep("opencl", [DEVICE], [driver])
    assert kept_answers.recall("opencl")


@pytest.mark.parametrize("place", ["/proc/none", "{tmp}/file", "{tmp}/file/deeper"])
def test_a_folder_that_cannot_be_written_harms_nothing(tmp_path, driver, monkeypatch, place):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("XDG_CACHE_HOME", place.format(tmp=tmp_path))
    kept_answers.keep("opencl", [DEVICE], [driver])
    kept_answers.keep("opencl", [BROKEN], [driver])
    assert kept_answers.recall("opencl") is None


def test_a_user_without_a_home_keeps_nothing(driver, monkeypatch):
    def no_home() -> Path:
        raise RuntimeError("no home")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", no_home)
    kept_answers.keep("opencl", [DEVICE], [driver])
    assert kept_answers.recall("opencl") is None and kept_answers.probes_folder() is None


PROBES = dict.fromkeys(("two_sum", "two_prod_split", "two_prod_fma", "round_to_nearest", "division"), 1.0)
PROBES |= {"peak_gflops": 143.5, "peak_median_gflops": 120.0, "peak_shape": "8 chains", "clock_ratio": 0.9}


class _Backends:
    """Stands for the workers: answers with `devices`, and counts how often it was asked."""

    def __init__(self, monkeypatch, driver: Path) -> None:
        from harness.devices.probes import Probes

        self.devices, self.looks, self.probes, self.fingerprints = [DEVICE], 0, 0, 0

        def find(_, __):
            self.looks += 1
            return self.devices

        def probe(_, __):
            self.probes += 1
            return Probes(**PROBES)

        def fingerprint(_, __):
            self.fingerprints += 1
            return {"float32": {"sums": "a1"}}

        monkeypatch.setattr(discovery, "_installed", lambda: ["opencl"])
        monkeypatch.setattr(LocalExecutor, "find", find)
        monkeypatch.setattr(LocalExecutor, "running_files", lambda _, __: [driver])
        monkeypatch.setattr(LocalExecutor, "probe", probe)
        monkeypatch.setattr(LocalExecutor, "fingerprint", fingerprint)


@pytest.fixture
def backends(driver, monkeypatch) -> _Backends:
    return _Backends(monkeypatch, driver)


def test_devices_are_found_and_measured_once_and_again_on_request(backends, capsys):
    told = []
    for arguments in (["devices"], ["devices"], ["devices", "--again"]):
        assert cli.main(arguments) == 0
        told.append(capsys.readouterr().out)
    assert (backends.looks, backends.probes, backends.fingerprints) == (2, 2, 2)
    assert told[0] == told[2] and told[1].startswith(told[0])
    assert "was found on" in told[1] and "--again" in told[1] and "found on" not in told[0]
    assert told[0].splitlines()[1].endswith("  100"), "a peak of 143.5, known to one digit"


def test_probes_whose_file_is_damaged_are_measured_again(backends, cache):
    assert cli.main(["devices"]) == 0
    for text in ("{}", "[1]", '{"clock_ratio": 1}', "{"):
        (file,) = cache.glob("firsthit/*/probes/*.json")
        file.write_text(text)
        assert cli.main(["devices"]) == 0
    assert backends.probes == 5 and backends.looks == 1


@pytest.mark.usefixtures("backends")
def test_probes_that_cannot_be_kept_are_told_all_the_same(tmp_path):
    (tmp_path / "file").write_text("in the way")
    info, found = probed(LocalExecutor(1.0), DEVICE, tmp_path / "file" / "probes")
    assert info.clock == "device" and dataclasses.asdict(found) == PROBES


def test_looking_replaces_what_is_kept(backends):
    discovery.known_devices()
    backends.devices = [dataclasses.replace(DEVICE, driver="driver 2")]
    assert discovery.known_devices().devices == [DEVICE], "nothing that is seen has changed"
    assert discovery.discover_devices() == backends.devices
    assert discovery.known_devices().devices == backends.devices


def test_on_linux_a_worker_tells_the_files_of_its_driver():
    if sys.platform != "linux" or not usable_devices():
        pytest.skip("no device, or no Linux")
    backend = usable_devices()[0].name.partition(":")[0]
    executor = LocalExecutor(60.0)
    try:
        assert executor.running_files(backend) is None, "no worker runs yet"
        executor.find(backend)
        files = executor.running_files(backend)
    finally:
        executor.close()
    assert files is not None and any(".so" in file.name for file in files)
    binding = {"opencl": "pyopencl", "opengl": "moderngl"}[backend]
    assert any(binding in str(file) for file in files)


def _firsthit(folder: Path, *arguments: object) -> tuple[str, str]:
    environment = os.environ | {"PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": str(folder / "cache")}
    command = [sys.executable, "-m", "harness.cli", *map(str, arguments)]
    ran = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=200, check=False)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout, ran.stderr


def _rows(folder: Path) -> list[dict]:
    return [json.loads(file.read_text()) for file in sorted((folder / "t" / "cells").glob("*.json"))]


def test_a_run_reports_and_is_keyed_by_the_device_itself_where_the_kept_answer_is_wrong(tmp_path):
    if sys.platform != "linux" or not usable_devices():
        pytest.skip("no device, or no Linux")
    info, config = usable_devices()[0], tmp_path / "t.toml"
    backend = info.name.partition(":")[0]
    config.write_text(CONFIG.format(device=info.name, seconds=0.01, more=""))
    _firsthit(tmp_path, "run", config, "--runs", tmp_path / "first")
    (file,) = (tmp_path / "cache").glob(f"firsthit/*/{backend}.json")
    record = sealed.read(file)
    for facts in record["devices"]:
        facts |= {"title": "no such device", "driver": "another driver", "compute_units": 1000, "float64": False}
    file.write_bytes(sealed.sealed(record))
    assert "no such device" in _firsthit(tmp_path, "list", "devices")[0], "nothing that can be seen speaks against it"

    _, said = _firsthit(tmp_path, "run", config, "--runs", tmp_path / "second")
    assert f"looking for devices to run {config}" in said.splitlines()[0]
    assert f"{config}: 8 cells on {info.name};" in said.splitlines()[1]
    right, again = _rows(tmp_path / "first"), _rows(tmp_path / "second")
    assert len(again) == 8 and [row["key"] for row in again] == [row["key"] for row in right]
    assert {row["identity"]["device"]["driver"] for row in again} == {info.driver}
    plan = json.loads((tmp_path / "second" / "t" / "plan.json").read_text())
    assert (plan["devices"][0]["driver"], plan["devices"][0]["title"]) == (info.driver, info.title)
    assert "no such device" not in _firsthit(tmp_path, "list", "devices")[0], "the run's own look replaced it"
