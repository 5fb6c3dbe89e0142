"""Damaged files: a row is sealed, held against its declaration and against itself; whatever is wrong is one line."""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
from pathlib import Path

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import DeviceInfo, FirsthitError
from harness.devices import probes
from harness.gate import baseline
from harness.oracle import cache, cached_first_hits, first_hits
from harness.results import npz, sealed, store
from harness.results.store import Store
from harness.running import environment
from harness.scenes import meshes
from harness.studies import condition_numbers, extrema_bounds, torus_along_rays
from reports.reading import arrays, load

from .agreeing_rows import oldest, whole
from .conftest import usable_devices
from .synthetic_run import VARIANTS, cell, family_cell, plan, printed, reported, tiny_run
from .synthetic_run import arrays as pictures

KEY = "a1"
VIEW = whole(cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32") | {"key": KEY})
HARD = whole(family_cell("ray_march", "grazing", "opencl:intel", "float32") | {"key": KEY})
RAYS = np.array([[0.1, -3.0, 0.2, 0.0, 1.0, 0.0], [9.0, -3.0, 0.2, 0.0, 1.0, 0.0]], np.float32)


def changed(row, *path_and_value):
    *path, value = path_and_value
    made = json.loads(json.dumps(row))
    inner = made
    for name in path[:-1]:
        inner = inner[name]
    inner[path[-1]] = value
    return made


def written(folder: Path, content: bytes) -> Path:
    path = folder / "cells" / f"{KEY}.json"
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(content)
    return path


def refused(folder: Path, content: bytes) -> str:
    """Why a row is refused, by `run` and by a report alike; "" where it is taken."""
    path = written(folder, content)
    own = Store(folder)
    kept = own.read(KEY)
    try:
        store.read_row(path, KEY)
    except ValueError as error:
        assert kept is None and KEY in own.unreadable and "\n" not in own.unreadable[KEY]
        return str(error)
    return ""


def test_a_row_is_sealed_by_a_checksum_that_other_programs_can_compute(tmp_path):
    Store(tmp_path).write(VIEW)
    first, _, rest = (tmp_path / "cells" / f"{KEY}.json").read_bytes().partition(b"\n")
    assert json.loads(first.rstrip(b",") + b"}") == {"checksum": hashlib.sha256(rest).hexdigest()}
    row = Store(tmp_path).read(KEY)
    assert row == {"format": 1, **VIEW}, "the checksum is the file's, not the row's"
    Store(tmp_path).write_plan({"name": "n"})
    assert sealed.read(tmp_path / "plan.json") == {"format": 1, "name": "n"}


def test_a_row_whose_checksum_does_not_hold_is_no_row(tmp_path):
    good = sealed.sealed({"format": 1, **VIEW})
    assert refused(tmp_path, good) == ""
    assert refused(tmp_path, good.replace(b"\n", b"\r\n")) == "", "git may write lines as Windows does"
    assert "checksum does not hold" in refused(tmp_path, good.replace(b'"misses": 0', b'"misses": 1', 1))
    assert "not the first line" in refused(tmp_path, b"{\n" + good[1:])
    assert "no checksum" in refused(tmp_path, good.replace(b"checksum", b"chacksum", 1))
    assert refused(tmp_path, json.dumps({"format": 1, **VIEW}, indent=1).encode()) == "", "an older row has none"


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (changed(VIEW, "time", "median_ms", 0.0), "time.median_ms: 0.0 is not positive"),
        (changed(VIEW, "time", "median_ms", 1e9), "but the median of samples_ms is"),
        (changed(VIEW, "time", "rounds", [1, 2]), "rounds has 2 items, samples_ms 20"),
        (changed(VIEW, "time", "wall_samples_ms", [1.0]), "wall_samples_ms has 1 item,"),
        (changed(VIEW, "time", "rounds", [0] * 20), "a round stands twice"),
        (changed(VIEW, "time", "rounds", 20), "time.rounds is no list: 20"),
        (changed(VIEW, "time", "rounds", [0.5] * 20), "time.rounds[] is no whole number"),
        (changed(VIEW, "time", "samples_ms", []), "it has no samples"),
        (changed(VIEW, "time", "samples_ms", [0.0] * 20), "is not positive"),
        (changed(VIEW, "time", "upper_ms", 1e9), "do not lie around the median"),
        (changed(VIEW, "time", "drift_chance", 1.5), "time.drift_chance: 1.5 is outside [0, 1]"),
        (changed(VIEW, "accuracy", "misses", -1), "accuracy.misses: -1 is no count"),
        (changed(VIEW, "accuracy", "misses", 10**6), "more rays are wrong"),
        (changed(VIEW, "accuracy", "truth_hits", 0), "add up to"),
        (changed(VIEW, "accuracy", "error", "p99", 9.0), "a higher quantile is less"),
        (changed(VIEW, "accuracy", "error", "max", None), "some quantiles are null"),
        (changed(VIEW, "accuracy", "lanes", [{"level": "one"}]), "accuracy.lanes[].level is no whole number"),
        (changed(VIEW, "stage", "paper"), "stage: 'paper' is not one of"),
        (changed(VIEW, "parameters", {"EPSILON": "small"}), "parameters.EPSILON is no number"),
        (changed(VIEW, "camera", 7), "camera is no object"),
        (changed(VIEW, "arrays", "../../etc/passwd"), "names no file of arrays"),
        (changed(VIEW, "status", "failed"), "without a reason"),
        (changed(VIEW, "format", 2), "its format is 2, not 1"),
        (changed(HARD, "rungs", 0, "right", 1), "right and wrong rays add up to"),
        (changed(HARD, "rungs", 0, "decided", 1), "add up to"),
    ],
)
def test_a_row_that_contradicts_its_declaration_or_itself_is_unreadable(tmp_path, row, words):
    assert words in refused(tmp_path, sealed.sealed({"format": 1, **row}))


def test_rows_of_old_versions_without_a_checksum_are_reported_whole(tmp_path):
    cells = [cell(v, s, "opencl:intel", "float32") for v in VARIANTS for s in ("sphere", "torus")]
    cells += [family_cell(v, "grazing", "opencl:intel", "float32") for v in VARIANTS if v != "null"]
    old = [oldest(one) for one in cells]
    assert "rounds" not in old[0]["time"] and "formula" not in old[0] and "invalid" not in old[-1]["rungs"][0]
    run, document = reported(tiny_run(tmp_path / "run", *old))
    assert not run.unreadable and (len(run.frame), len(run.families)) == (10, 4)
    told = "\n".join(printed(section.blocks) for section in (document.summary, *document.sections))
    assert all(f"{one['time']['median_ms']:.3g}" in told for one in cells if one["time"] and one["answers"])

    del old[0]["time"]["samples_ms"]
    (tmp_path / "run" / "cells" / f"{old[0]['key']}.json").write_text(json.dumps(old[0]))
    (lost,) = load.load(tmp_path / "run").unreadable
    assert lost.problem.startswith("time.samples_ms is missing")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"misses"', '"size"', "twice"),
        ('"misses": 0', '"misses": NaN', "which is no number"),
        ('"misses": 0', f'"misses": {"9" * 5000}', "4300"),
        ('"median_ms": ', '"median_ms": 1e999, "x": ', "inf is no finite number"),
        ('"reason": null', '"reason": "\\ud800"', "UTF-8"),
        ('"identity": {', f'"identity": {{"a": {"[" * 9000}', "deep"),
        ('"identity": {', f'"identity": {{"a": {"[" * 90 + "]" * 90}, ', "more than 64 deep"),
    ],
)
def test_what_json_does_not_know_is_damage(tmp_path, old, new, words):
    text = json.dumps({"format": 1, **VIEW}, indent=1)
    assert old in text
    assert words in refused(tmp_path, text.replace(old, new, 1).encode())
    assert words in refused(tmp_path, sealed.with_seal(text.replace(old, new, 1))) or words == "twice"
    assert "UTF-8" in refused(tmp_path, text.encode("utf-16")), "in no other encoding"
    assert refused(tmp_path, b"\xef\xbb\xbf" + text.encode())


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir, lambda path: path.symlink_to(path.name)])
def test_what_is_no_file_is_never_waited_for(tmp_path, make):
    for name in ("cells", "arrays"):
        (tmp_path / name).mkdir()
    make(tmp_path / "cells" / f"{KEY}.json")
    make(tmp_path / "arrays" / f"{KEY}.npz")
    own = Store(tmp_path)
    assert own.read(KEY) is None and KEY in own.unreadable
    with pytest.raises((OSError, ValueError)):
        arrays.read(tmp_path / "arrays" / f"{KEY}.npz")
    assert cache.load(tmp_path / "arrays" / f"{KEY}.npz", 4) is None


def test_arrays_of_another_type_or_shape_are_refused_before_anything_is_allocated(tmp_path):
    path, good = tmp_path / "a.npz", pictures(VIEW)
    np.savez(path, **good)
    assert arrays.read(path).truth.shape == (48, 48)
    cases = {
        "is of float64": {"error": good["error"].astype(np.float64)},
        "is of object": {"error": np.array([{}], object)},
        "has the shape": {"error": good["error"][:3]},
        "holds what it cannot hold": {"wrong": good["wrong"] + 9},
    }
    for words, other in cases.items():
        np.savez(path, **(good | other))
        with pytest.raises(ValueError, match=words):
            arrays.read(path)
    np.savez(path, **{name: array for name, array in good.items() if name != "truth"})
    with pytest.raises(ValueError, match="it has no truth"):
        arrays.read(path)
    claim = b"{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000,), }"
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("lower.npy", b"\x93NUMPY\x01\x00\x76\x00" + claim.ljust(117) + b"\n" + bytes(64))
    with pytest.raises(ValueError, match="claims the shape"):
        npz.read(path, {"lower": np.float64}, lambda *_: True)


def test_an_array_whose_name_was_damaged_is_not_taken_for_one_of_another_version(tmp_path):
    path = tmp_path / "a.npz"
    np.savez_compressed(path, lower=np.zeros(3), upper=np.ones(3))
    content = path.read_bytes()
    directory = content.index(b"PK\x01\x02")  # the names stand before each member and once more in the directory
    path.write_bytes(content[:directory] + content[directory:].replace(b"upper.npy", b"upqer.npy"))
    with pytest.raises(ValueError, match="damaged"):
        npz.read(path, {"lower": np.float64, "upper": np.float64}, lambda *_: True, frozenset({"upper"}))


def test_truth_that_is_damaged_or_contradicts_itself_is_made_again(tmp_path):
    torus = surfaces.get("torus")
    truth = cached_first_hits(torus, RAYS, tmp_path)
    (path,) = tmp_path.iterdir()
    arrays = {name: np.array(array) for name, array in vars(truth).items()}
    for name, value in (("lower", 9.0), ("upper", np.nan), ("status", 9)):
        np.savez(path, **(arrays | {name: np.full_like(arrays[name], value)}))
        assert cache.load(path, len(RAYS)) is None
        again = cached_first_hits(torus, RAYS, tmp_path)
        assert np.array_equal(again.lower, truth.lower, equal_nan=True)


def test_truth_that_cannot_be_written_is_kept_in_memory_and_said_once(tmp_path, monkeypatch):
    (tmp_path / "truth").write_text("in the way")
    made = []
    monkeypatch.setattr("harness.oracle.first_hits", lambda *a: made.append(1) or first_hits(*a))
    for _ in range(3):
        truth = cached_first_hits(surfaces.get("torus"), RAYS, tmp_path / "truth")
    assert len(made) == 1 and truth.status.tolist()[1] == 0
    assert "cannot write" in str(cache.unwritten(tmp_path / "truth"))
    assert cache.unwritten(tmp_path / "truth") is None


@pytest.mark.parametrize("value", ["fast", None, [], True, -1.0, 1e999])
def test_probes_with_another_value_are_measured_again(tmp_path, value):
    info = DeviceInfo("opencl:one", "One", "1", "c", 2, True, "wall", ())
    found = dict.fromkeys(probes.Probes.__annotations__, 1.0) | {"peak_shape": "8 chains"}
    path = environment._probes_file(info, tmp_path)
    path.write_bytes(sealed.sealed(found))
    assert environment.kept_probes(info, tmp_path)[0] is not None
    path.write_text(json.dumps(found | {"division": value}))
    assert environment.kept_probes(info, tmp_path)[0] is None


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("devices",), [7]),
        (("devices",), [{"name": ["x"]}]),
        (("devices",), [{"name": "x", "probes": {"peak_gflops": "fast"}}]),
        (("devices",), [{"name": "x", "probes": 3}]),
        (("cells",), [{"key": "a", "slot": None}]),
        (("cells",), ["a"]),
        (("environment",), {"versions": 7}),
        (("methods",), {"newton": {"tables": [{"part": "p", "header": ["a", "b"], "rows": [["c"]]}]}}),
        (("methods",), {"newton": {"claims": 5}}),
        (("family_facts",), {"grazing": {"title": "t"}}),
        (("include",), [".."]),
        (("studies",), [{"study": "s", "key": "../x"}]),
    ],
)
def test_a_plan_with_a_malformed_entry_is_one_line(tmp_path, path, value):
    folder = tiny_run(tmp_path / "run", VIEW)
    assert load.load(folder)
    (folder / "plan.json").write_bytes(sealed.sealed(changed(plan([VIEW]), *path, value)))
    with pytest.raises(FirsthitError, match=r"cannot read .*plan\.json.*run the config again") as caught:
        load.load(folder)
    assert "\n" not in str(caught.value)


def test_a_study_that_lacks_a_column_is_named_and_not_drawn(tmp_path):
    for module in (condition_numbers, torus_along_rays, extrema_bounds):
        name = module.__name__.rpartition(".")[2]
        rows = module.compute() if module is not extrema_bounds else []
        document = {"format": 1, "key": "abc", "study": name, "rows": rows}
        folder = tiny_run(tmp_path / name, VIEW)
        named = plan([VIEW]) | {"studies": [{"study": name, "key": "abc"}]}
        (folder / "plan.json").write_bytes(sealed.sealed(named))
        (folder / "studies").mkdir()
        (folder / "studies" / "abc.json").write_bytes(sealed.sealed(document))
        assert load.load(folder).studies[name] == rows
        (folder / "studies" / "abc.json").write_bytes(sealed.sealed(document | {"rows": [{"degree": 3}]}))
        found = load.load(folder)
        assert not found.studies and found.unreadable[0].file == "studies/abc.json"


def test_a_mesh_whose_triangles_have_no_corners_is_made_again(tmp_path):
    points, corners = np.ones((4, 6), np.float32), np.array([[0, 1, 2]], np.uint32)
    path = tmp_path / "m.npz"
    for wrong, closed in (({}, False), ({"triangles": corners + 9}, False), ({"vertices": points[:, :3]}, False)):
        np.savez(path, **({"vertices": points, "triangles": corners, "closed": np.array(closed)} | wrong))
        assert (meshes._stored(path) is None) == bool(wrong)


@pytest.mark.parametrize("text", [f"format = {'9' * 5000}", f"a = {'[' * 5000}", "format = true", "\ufeffformat = 2"])
def test_a_baseline_that_toml_cannot_hold_is_one_line(tmp_path, text):
    path = tmp_path / "b.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FirsthitError, match="baseline") as caught:
        baseline.read(path)
    assert "\n" not in str(caught.value) and len(str(caught.value)) < 500


@pytest.mark.usefixtures("devices_found_once")
def test_a_damaged_row_is_told_on_a_quiet_screen_too(tmp_path, capsys):
    config = tmp_path / "tiny.toml"
    device = usable_devices()[0].name
    config.write_text(
        f'title = "t"\nsurfaces = ["sphere"]\nsizes = [16]\ndevices = ["{device}"]\n[[method]]\nname = "newton"\n'
    )
    assert main(["plan", str(config), "--runs", str(tmp_path), "--json"]) == 0
    (cell,) = json.loads(capsys.readouterr().out)["parts"][0]["cells"]
    row = tmp_path / "tiny" / "cells" / f"{cell['key']}.json"
    row.parent.mkdir(parents=True)
    row.write_text("{")
    assert main(["plan", str(config), "--runs", str(tmp_path), "-q"]) == 0
    assert f"{row} is damaged" in " ".join(capsys.readouterr().err.split())
