"""The fingerprint of a device's arithmetic: it is steady, it sees what is changed, and equal ones mean equal hits."""

from __future__ import annotations

import dataclasses
import itertools
import json
import re
from functools import cache

import numpy as np
import pytest

import surfaces
from harness.commands.devices import _alike
from harness.contract import CellStatus, DeviceInfo, FirsthitError, Section, View
from harness.devices import bits, fingerprint, host_arithmetic, raster_arithmetic
from harness.devices.executor import CellError, LocalExecutor
from harness.devices.fingerprint import TEXTS, unlike
from harness.devices.interface import BuildError, hits_from, launch_rays
from harness.devices.raster import Rasteriser
from harness.kernels.assemble import method_program
from harness.kernels.sections import KERNELS, files
from harness.plugins import find_methods
from harness.running.environment import fingerprinted
from harness.scenes.camera import camera_for, rays_of

from .conftest import opened, usable_devices

DEVICE = DeviceInfo("opencl:one", "one", "driver 1", "compiler", 2, True, "device", ())
FOUND = {
    "float32": {"sums": "a", "sin": "b"},
    "float64": {"sums": "c"},
    "raster": {"depths": "d"},
    "host": {"tan": "e"},
}


@cache
def taken(name: str) -> fingerprint.Fingerprint:
    return fingerprint.fingerprint(opened(name))


# ---- on devices


def test_a_fingerprint_is_the_same_in_another_process(device):
    executor = LocalExecutor(100.0)
    try:
        again = executor.fingerprint(device.info.name)
    finally:
        executor.close()
    assert again == taken(device.info.name) == json.loads(json.dumps(again))
    assert ("float64" in again) == device.info.float64 and ("raster" in again) == isinstance(device, Rasteriser)
    assert {"float32", "host"} <= set(again)


@pytest.mark.parametrize(
    ("line", "planted", "part"),
    [
        ("y[0] = a + b;", "y[0] = (a + b) * (1.0 + 2.0 * UNIT_ROUNDOFF);", "sums"),
        ("y[8] = sqrt(a);", "y[8] = a == 1.0 ? 1.0 - UNIT_ROUNDOFF : sqrt(a);", "roots"),
        ("y[15] = small;", "y[15] = fabs(small) < 0.25 * REAL_TINY ? real(0) : small;", "denormals"),
        ("y[27] = a * b + c;", "y[27] = a * b == -c ? rest.lo : a * b + c;", "contraction"),
        ("y[36] = error.lo;", "y[36] = 0.0;", "exact"),
    ],
)
def test_what_a_planted_change_touches_differs_and_nothing_else(device, monkeypatch, line, planted, part):
    before = taken(device.info.name)

    def changed(*names: str) -> list[Section]:
        found = files(*names)
        text = found[-1].text
        if "rest.lo" in planted:  # needs the product's error ahead of its place
            text = text.replace("    Pair rest = two_prod(a, b);\n", "").replace(
                "    real d = x[3];\n", "    real d = x[3];\n    Pair rest = two_prod(a, b);\n"
            )
        assert line in text
        return [*found[:-1], Section(found[-1].origin, text.replace(line, planted))]

    monkeypatch.setattr(fingerprint, "files", changed)
    after = before["float32"] | fingerprint.answers(device, "float32", fingerprint.ARITHMETIC)
    assert unlike(before, before | {"float32": after}, "float32", False) == [f"float32 {part}"]


def cast(device, method: str, surface: surfaces.Surface) -> list[np.ndarray]:
    """Return t, status and evaluations of two views' rays, whose number is no multiple of a vector's width."""
    plugin = find_methods().get(method)
    views = [View("a", azimuth=30, elevation=35), View("b", azimuth=71, elevation=-20)]
    rays = np.concatenate([rays_of(camera_for(view, surface), 32) for view in views])[:-3]
    variant = plugin.variant({})
    program = method_program(plugin.method, plugin.folder, variant, surface, "float32", device.language, "rays")
    launch = launch_rays(device, program, device.build(program), rays)
    launch.run()
    hits = hits_from(launch.read())
    launch.release()
    return [hits.t.view(np.int64), hits.status, hits.evaluations]


def test_equal_fingerprints_mean_equal_hits_and_unequal_hits_unequal_fingerprints(monkeypatch):
    devices = [opened(info.name) for info in usable_devices()]
    if not devices:
        pytest.skip("there is no device")
    wave = surfaces.from_formula("sin(3*x)*cos(3*y) + sin(3*y)*cos(3*z) + sin(3*z)*cos(3*x)", surfaces.Sphere(2.0))
    cases = [("newton", surfaces.get("torus")), ("interval_march", wave)]
    found = []
    for device in devices:
        for option in ("", "-cl-fast-relaxed-math") if device.language == "cl" else ("",):
            with monkeypatch.context() as patched:
                if option:  # another arithmetic on the same device
                    options = {precision: [*given, option] for precision, given in device._options.items()}
                    patched.setattr(device, "_options", options)
                parts = {"float32": fingerprint.parts(device, "float32"), "host": {"all": "same"}}
                found.append((f"{device.info.name} {option}", parts, [cast(device, *case) for case in cases]))
    for (a, first, hits), (b, second, others) in itertools.combinations(found, 2):
        same = all(
            np.array_equal(x, y)
            for case, other in zip(hits, others, strict=True)
            for x, y in zip(case, other, strict=True)
        )
        assert same or unlike(first, second, "float32", False), f"{a} and {b} answer differently and look alike"


def test_a_frame_that_is_seen_a_little_differently_has_another_hash(device, monkeypatch):
    if not isinstance(device, Rasteriser):
        pytest.skip("the device draws no triangles")
    eye, *others = raster_arithmetic.CAMERA
    monkeypatch.setattr(raster_arithmetic, "CAMERA", ((eye[0] + 2.0**-20, *eye[1:]), *others))
    after = taken(device.info.name) | {"raster": raster_arithmetic.raster_arithmetic(device)}
    assert unlike(taken(device.info.name), after, "float32", False) == []
    assert {"raster rays", "raster depths"} <= set(unlike(taken(device.info.name), after, "float32", True))


# ---- numbers and hashes


def test_every_nan_counts_as_one_and_zeros_have_signs():
    nans = np.array([0x7FC00000, 0xFFC00001, 0x7F800001], np.uint32).view(np.float32)
    assert len({bits.hash_of(nans[k : k + 1]) for k in range(3)}) == 1
    assert bits.hash_of(np.array([0.0])) != bits.hash_of(np.array([-0.0]))
    assert bits.hash_of(np.array([1.5, 2.0])) == bits.hash_of(np.array([1.5, 2.0], ">f8"))
    assert bits.hash_of(np.array([1.5], np.float32)) != bits.hash_of(np.array([1.5], np.float64))


def test_words_are_those_of_splitmix64_whatever_numpy_does():
    def word(k: int, seed: int) -> int:
        x = (k + (seed << 32)) * 0x9E3779B97F4A7C15 % 2**64
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9 % 2**64
        x = (x ^ (x >> 27)) * 0x94D049BB133111EB % 2**64
        return x ^ (x >> 31)

    assert bits.words(5, 7).tolist() == [word(k, 7) for k in range(1, 6)]


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_rows_hold_special_values_and_every_magnitude(precision):
    rows = fingerprint.ARITHMETIC.rows(precision)
    tiny = np.finfo(rows.dtype).tiny
    for k, column in enumerate(rows.T):
        denormal = (column != 0) & (np.abs(column) < tiny)
        kinds = [
            np.isnan(column),
            column == np.inf,
            column == -np.inf,
            denormal,
            np.abs(column) == np.finfo(rows.dtype).max,
        ]
        zeros = column == 0
        kinds += [zeros & np.signbit(column), zeros & ~np.signbit(column)]
        assert all(kind.any() for kind in kinds), f"column {k}"
        exponents = np.frexp(column[np.isfinite(column)])[1]
        assert np.ptp(exponents) > 250
    for text in TEXTS:
        rows = text.rows(precision)
        assert len(rows) % 4 and rows.dtype == precision


@pytest.mark.parametrize("text", TEXTS, ids=lambda text: text.files[-1])
def test_parts_are_what_the_programs_comments_say(text):
    source = (KERNELS / "map" / text.files[-1]).read_text()
    assert (
        dict((name, int(count)) for name, count in re.findall(r"^    // ([a-z ]+): (\d+)$", source, re.M)) == text.parts
    )
    assert f"#define OUTPUTS {sum(text.parts.values())}\n" in source
    assert len(text.rows("float32").T) == int(re.search(r"#define INPUTS (\d+)", source)[1])
    assert {int(k) for k in re.findall(r"\by\[(\d+)\] =", source)} == set(range(sum(text.parts.values())))


def test_the_hosts_functions_are_seen(monkeypatch):
    before = host_arithmetic.host_arithmetic()
    assert before == host_arithmetic.host_arithmetic()
    sin = np.sin
    monkeypatch.setattr(np, "sin", lambda values: np.nextafter(sin(values), 2.0))
    after = host_arithmetic.host_arithmetic()
    assert unlike(
        {"float32": {"sums": "a"}, "host": before}, {"float32": {"sums": "a"}, "host": after}, "float32", False
    ) == ["host sin"]


# ---- comparing, keeping, failing


@pytest.mark.parametrize(
    ("change", "precision", "raster", "parts"),
    [
        ({}, "float32", True, []),
        ({"float32": {"sums": "a", "sin": "x"}}, "float32", False, ["float32 sin"]),
        ({"float32": {"sums": "a", "sin": "x"}}, "float64", True, []),
        ({"float32": {"sums": "a"}}, "float32", False, ["float32 sin"]),
        ({"float64": {}}, "float64", False, ["float64 (not known)"]),
        ({"raster": {"depths": "x"}}, "float32", False, []),
        ({"raster": {"depths": "x"}}, "float32", True, ["raster depths"]),
        ({"raster": {}}, "float32", True, ["raster (not known)"]),
        ({"host": {"tan": "x"}, "float32": {"sums": "x", "sin": "b"}}, "float32", True, ["float32 sums", "host tan"]),
    ],
)
def test_unlike_names_what_differs_for_a_row_of_a_precision(change, precision, raster, parts):
    other = FOUND | change
    assert unlike(FOUND, other, precision, raster) == unlike(other, FOUND, precision, raster) == parts


def test_two_that_know_nothing_are_not_alike():
    assert unlike({}, {}, "float32", True) == ["float32 (not known)", "host (not known)", "raster (not known)"]


def test_devices_of_the_same_arithmetic_name_the_first_of_them():
    devices = {"opencl:a": FOUND, "opencl:b": FOUND | {"float64": {}}, "opengl:c": {"float32": {"sums": "x"}}}
    first, second, third = _alike(devices)
    assert first[0] == "opencl:a" and all(len(cell) == 6 for cell in first[1:])
    assert second[1] == f"{first[1]} (as opencl:a)" and "as" not in second[2] and second[3].endswith("(as opencl:a)")
    assert "as" not in third[1] and third[2:] == ("-", "-")


class _Executor:
    """Stands for the workers: counts how often it was asked."""

    def __init__(self, error: str = "") -> None:
        self.asked, self.error = 0, error

    def fingerprint(self, _: str) -> fingerprint.Fingerprint:
        self.asked += 1
        if self.error:
            raise CellError(CellStatus.FAILED, self.error)
        return dict(FOUND)


def test_a_fingerprint_is_kept_until_what_decides_it_changes_and_the_hosts_part_is_found_anew(tmp_path, monkeypatch):
    executor = _Executor()
    for _ in range(2):
        found = fingerprinted(executor, DEVICE, tmp_path)
        assert found == FOUND | {"host": host_arithmetic.host_arithmetic()}
    assert executor.asked == 1
    fingerprinted(executor, DEVICE, tmp_path, again=True)
    fingerprinted(executor, DEVICE)
    fingerprinted(executor, dataclasses.replace(DEVICE, driver="driver 2"), tmp_path)
    for variable in ("CL_CONFIG_CPU_TARGET_ARCH", "GALLIUM_OVERRIDE_CPU_CAPS"):
        monkeypatch.setenv(variable, "another")  # each of them was seen to change a driver's arithmetic
        fingerprinted(executor, DEVICE, tmp_path)
    assert executor.asked == 6


@pytest.mark.parametrize("damage", ["", "{", "[1]", "{}", '{"fingerprint": {}, "digest": "0"}', "changed"])
def test_a_damaged_file_counts_as_nothing(tmp_path, damage):
    executor = _Executor()
    fingerprinted(executor, DEVICE, tmp_path)
    (file,) = tmp_path.iterdir()
    file.write_text(file.read_text().replace('"sin": "b"', '"sin": "x"') if damage == "changed" else damage)
    assert fingerprinted(executor, DEVICE, tmp_path)["float32"] == FOUND["float32"]
    assert executor.asked == 2


def test_a_folder_that_cannot_be_written_keeps_nothing(tmp_path):
    (tmp_path / "file").write_text("in the way")
    assert fingerprinted(_Executor(), DEVICE, tmp_path / "file" / "probes")["float32"] == FOUND["float32"]


def test_a_fingerprint_that_cannot_be_taken_is_told(tmp_path):
    with pytest.raises(FirsthitError, match=r"the fingerprint of opencl:one cannot be taken: no memory") as told:
        fingerprinted(_Executor("no memory"), DEVICE, tmp_path)
    assert told.value.exit_code == 3 and not list(tmp_path.iterdir())
    with pytest.raises(FirsthitError, match="cannot be used: its compiler fails"):
        fingerprinted(_Executor(), dataclasses.replace(DEVICE, problem="its compiler fails"))


class _Fake:
    """A device whose compiler refuses, or whose answers change from run to run."""

    info, language = DEVICE, "cl"

    def __init__(self, refuses: bool) -> None:
        self.refuses, self.runs = refuses, 0

    def build(self, _):
        if self.refuses:
            raise BuildError("arithmetic.glsl:7: no")

    def launch(self, _, __, outputs, ___):
        self.count = outputs[0][0]
        return self

    def run(self):
        self.runs += 1

    def read(self):
        answers = np.zeros(self.count, np.float32)
        answers[100] = self.runs
        return [answers]

    def release(self):
        pass


@pytest.mark.parametrize(
    ("refuses", "told"), [(True, "does not compile: arithmetic.glsl:7: no"), (False, "1 of 4099 rows")]
)
def test_a_program_that_does_not_compile_or_is_not_steady_is_told(refuses, told):
    with pytest.raises(FirsthitError, match=told) as error:
        fingerprint.fingerprint(_Fake(refuses))
    assert error.value.exit_code == 3
