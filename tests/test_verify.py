"""`firsthit verify` finds a single altered figure among many rows, and nothing in rows as a run wrote them."""

from __future__ import annotations

import copy
import json
import math
import random
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from harness import oracle
from harness.cli import main
from harness.commands import verify
from harness.contract import FirsthitError, Surface, Truth, digest
from harness.oracle import cache
from harness.results import sealed
from harness.results.store import Store
from harness.spreading import pool
from harness.verifying import checks, truth
from harness.verifying.checks import Verified
from harness.verifying.model import CannotTell
from tests.many_rows import copies

from .conftest import usable_devices

CONFIG = """title = "Rows to be checked again"
surfaces = ["torus"]
sizes = [16]
devices = {devices}
stages = ["compute", "raster"]
families = ["tangent_plane"]
[[method]]
name = "newton"
[[method]]
name = "interval_adaptive"
[accuracy]
size = 12
max_wrong_share = 1.0
[budget]
seconds = 0.001
rounds = 8
repetitions = 8
timeout = 600
"""
NOT_CHECKED = {  # what only the device, the clock or the compiler could tell again
    *("build", "seconds", "environment", "extent", "casts", "prepass", "origin", "proxy", "normal", "pixel_tolerance"),
    *("answers", "evaluation_operations", "accuracy.lanes"),
    *("time.batch", "time.session", "time.rounds", "time.wall_samples_ms"),
    *("accuracy.fragments", "accuracy.fragments_discarded", "accuracy.pixels_drawn", "accuracy.other_instance"),
    *("rungs.max_error", "rungs.undecidable_right"),
}
ONLY_BY_DEVICE = {  # where a row's rays or evaluations are not known here
    "beams": ("accuracy.evaluations_mean", "accuracy.evaluations_max"),
    "raster": (
        "accuracy.domain_rays",
        "accuracy.certified_width",
        *(f"accuracy.{n}" for n in ("pixel_error", "ulp_error", "condition_ratio", "normal_error_degrees", "residual")),
    ),
}


TRUTHS: dict[str, Truth] = {}
pytestmark = pytest.mark.usefixtures("devices_found_once")


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Rows of every usable device."""
    devices = [info.name for info in usable_devices()]
    if not devices:
        pytest.skip("no device")
    folder = tmp_path_factory.mktemp("verify")
    (folder / "rows.toml").write_text(CONFIG.format(devices=json.dumps(devices)))
    assert main(["run", "-q", str(folder / "rows.toml"), "--runs", str(folder)]) == 0
    return folder / "rows"


@pytest.fixture(autouse=True)
def certified_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the oracle certify each set of rays once for all tests."""

    def first_hits(surface: Surface, rays: NDArray[np.float32]) -> Truth:
        name = cache.truth_path(Path(), surface, rays).name
        if name not in TRUTHS:
            TRUTHS[name] = oracle.first_hits(surface, rays)
        return TRUTHS[name]

    monkeypatch.setattr(checks, "first_hits", first_hits)


def verified(folder: Path, sample: float = 1.0) -> Verified:
    return checks.verify([folder], lambda count: round(sample * count), 1)


def test_rows_as_a_run_wrote_them_hold(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = verified(run)
    assert found.failing == [] and found.rows == found.checked["file"] == found.checked["stated"] > 5
    assert all(found.checked[name] for name in ("times", "answers", "truth")) and not found.missing
    assert verified(run, 0.0).checked["stored truth"] and verified(run, 0.0).failing == []
    assert main(["verify", str(run)]) == 0 and "0 do not hold" in capsys.readouterr().out


def leaves(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Yield the path and value of every leaf; of lists of numbers the first item, of lists of rungs the last one."""
    if isinstance(value, dict):
        for name, one in value.items():
            yield from leaves(one, (*path, name))
    elif isinstance(value, list) and value:
        yield from leaves(value[-1], (*path, len(value) - 1))
    elif value is not None:
        yield path, value


def altered(value: Any) -> Any:
    """Return another value of the same kind, not far off."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, str):
        return value + "x"
    if isinstance(value, list):
        return ["x"]
    return value + 1 if isinstance(value, int) else value * 1.4 + (1e-3 if value == 0.0 else 0.0)


def named(path: tuple[Any, ...]) -> str:
    return ".".join(str(part) for part in path if not isinstance(part, int))


def is_left_out(row: dict[str, Any], name: str) -> bool:
    left = set(NOT_CHECKED)
    left.update(ONLY_BY_DEVICE["beams"] if row["casts"] in ("beams", "quadtree", "tiles") else ())
    left.update(ONLY_BY_DEVICE["raster"] if row["stage"] == "raster" else ())
    return any(name == one or name.startswith(f"{one}.") for one in left)


def test_a_single_altered_figure_is_found_though_its_checksum_is_mended(run: Path, tmp_path: Path) -> None:
    rows = list(Store(run).rows())
    kinds = {(row["stage"], row["casts"], row["status"], bool(row["family"])): row for row in rows}
    assert len(kinds) >= 3
    missed = []
    for row in kinds.values():
        for path, value in leaves({name: one for name, one in row.items() if name not in ("identity", "format")}):
            if is_left_out(row, named(path)):
                continue
            other = copy.deepcopy(row)
            place = other
            for part in path[:-1]:
                place = place[part]
            place[path[-1]] = altered(value)
            missed += [] if _falls(run, tmp_path, row, other) else [f"{row['slot']}: {named(path)}"]
    assert not missed, missed


def _falls(run: Path, tmp_path: Path, row: dict[str, Any], other: dict[str, Any]) -> bool:
    """Tell whether a folder with this one row in the place of another is found to hold it."""
    folder = tmp_path / "one"
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "cells").mkdir(parents=True)
    (folder / "arrays").mkdir()
    shutil.copy(run / "plan.json", folder)
    if row["arrays"]:
        shutil.copy(run / row["arrays"], folder / row["arrays"])
    (folder / "cells" / f"{row['key']}.json").write_bytes(sealed.sealed(other))
    return bool(verified(folder).failing)


@pytest.mark.parametrize("name", ["truth", "status", "wrong", "grazing", "error"])
def test_an_altered_ray_is_found(run: Path, tmp_path: Path, name: str) -> None:
    row = next(row for row in Store(run).rows() if row["arrays"] and row["casts"] == "rays" and row["time"])
    folder = tmp_path / "run"
    shutil.copytree(run, folder)
    with np.load(folder / row["arrays"]) as stored:
        arrays = {key: stored[key] for key in stored.files}
    ray = random.Random(3).choice(np.argwhere(np.isfinite(arrays["error"])).tolist())
    arrays[name][tuple(ray)] = {"truth": 0, "status": 0, "wrong": 4, "grazing": True, "error": 0.01}[name]
    np.savez_compressed(folder / row["arrays"], **arrays)
    found = verified(folder)
    assert {one.file.stem for one in found.failing} == {row["key"]}


def test_one_altered_row_among_many_is_told(run: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "run"
    shutil.copytree(run, folder)
    row = next(row for row in Store(run).rows() if row["time"] and row["stage"] == "compute" and row["casts"] == "rays")
    row["accuracy"]["ulp_error"] = {name: one * 0.5 for name, one in row["accuracy"]["ulp_error"].items()}
    path = folder / "cells" / f"{row['key']}.json"
    path.write_bytes(sealed.sealed(row))
    capsys.readouterr()
    assert main(["verify", str(folder), "--sample", "0", "--json"]) == 1
    told = json.loads(capsys.readouterr().out)
    assert told["failing_rows"] == 1 and {one["slot"] for one in told["failing"]} == {row["slot"]}
    assert "accuracy.ulp_error.max" in {one["figure"] for one in told["failing"]}
    path.write_bytes(path.read_bytes().replace(b'"ok"', b'"OK"'))
    assert main(["verify", str(folder)]) == 1
    out = capsys.readouterr().out
    assert "checksum does not hold" in out
    assert "without a row" not in out, "a damaged row is no missing one"


def test_a_row_without_checksum_is_told_as_one_and_gone_arrays_are_named(run: Path, tmp_path: Path) -> None:
    folder = tmp_path / "run"
    shutil.copytree(run, folder)
    row = next(row for row in Store(run).rows() if row["arrays"])
    (folder / row["arrays"]).unlink()
    old = {name: value for name, value in row.items() if name != "checksum"}
    (folder / "cells" / f"{row['key']}.json").write_text(json.dumps(old))
    found = verified(folder)
    ((check, reason),) = (one for one in found.not_checked if one[0] == "file")
    assert found.not_checked[check, reason] == 1 and "no checksum" in reason
    assert found.checked["file"] == found.rows - 1
    (failing,) = found.failing
    assert failing.wrong.stored == f"cannot read {folder / row['arrays']}: No such file or directory"


def test_a_row_of_another_question_is_found(run: Path, tmp_path: Path) -> None:
    """Its identity was changed, and its key and checksum with it: it claims a view that it was not cast from."""
    folder = tmp_path / "run"
    shutil.copytree(run, folder)
    row = next(row for row in Store(run).rows() if row["time"] and row["casts"] == "rays" and row["stage"] == "compute")
    row["identity"]["view"]["elevation"] += 1.0
    row["camera"]["elevation"] += 1.0
    key = digest(row["slot"], row["identity"])
    (folder / row["arrays"]).rename(folder / "arrays" / f"{key}.npz")
    (folder / "cells" / f"{row['key']}.json").unlink()
    row |= {"key": key, "arrays": f"arrays/{key}.npz"}
    (folder / "cells" / f"{key}.json").write_bytes(sealed.sealed(row))
    found = verified(folder)
    assert {one.check for one in found.failing} == {"truth"} and found.missing == 1


def test_a_row_without_answers_ray_by_ray_is_held_against_the_truth_alone(run: Path, tmp_path: Path) -> None:
    """As that of a stranger who gives away no more than the row."""
    row = next(row for row in Store(run).rows() if row["time"] and row["casts"] == "rays" and row["stage"] == "compute")
    alone = row | {"arrays": None}
    assert not _falls(run, tmp_path, alone, alone)
    one_more = {"truth_hits": row["accuracy"]["truth_hits"] + 1, "truth_misses": row["accuracy"]["truth_misses"] - 1}
    assert _falls(run, tmp_path, alone, alone | {"accuracy": row["accuracy"] | one_more})


def test_a_surface_that_is_not_known_here_is_certified_by_the_row(run: Path) -> None:
    """The eye's distance, which follows from a length of the surface, is the one that the row tells."""
    row = next(row for row in Store(run).rows() if row["time"] and row["casts"] == "rays" and row["stage"] == "compute")
    assert row["identity"]["view"]["distance"] is None
    known, row = truth.rays_for(row)[1], copy.deepcopy(row)
    row["identity"]["surface"]["formula"] = row["formula"] = f"0 + ({row['formula']})"
    row["key"] = digest(row["slot"], row["identity"])
    surface, rays = truth.rays_for(row)
    assert surface.source == "a row" and np.array_equal(rays, known)
    with pytest.raises(CannotTell, match="distance"):
        truth.rays_for(row | {"camera": None})
    row["camera"]["distance"] = "far"
    with pytest.raises((FirsthitError, TypeError)):
        truth.rays_for(row)


def test_processes_find_the_same(run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("STARTING", "SENDING"):
        monkeypatch.setattr(pool, name, -1e3)
    monkeypatch.setattr(checks, "CHUNK", 2)
    folder = tmp_path / "run"
    made = copies(run, folder, 9)
    path = folder / "cells" / f"{made[6]['key']}.json"
    path.write_bytes(path.read_bytes().replace(b'"ok"', b'"OK"'))
    made[4]["accuracy"]["ulp_error"]["max"] *= 0.5
    (folder / "cells" / f"{made[4]['key']}.json").write_bytes(sealed.sealed(made[4]))
    alone = verified(folder)
    with pool.over(2):
        found = verified(folder)
        assert pool.spreading.taker().pids  # type: ignore[union-attr]
    assert found == alone and {one.file.stem for one in found.failing} == {made[4]["key"], made[6]["key"]}
    assert found.rows == 9 and found.certifiable == found.sampled == 7


def test_the_chance_to_find_a_row_is_told(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Draws n of N rows: none of k bad ones is among them with the chance C(N - k, n) / C(N, n)."""
    for of, number in ((10_000, 100), (50, 3), (7, 6)):
        bad = verify.enough(of, number)
        none = [math.comb(of - k, number) / math.comb(of, number) for k in (bad - 1, bad)]
        assert none[0] > 1.0 - verify.SURE >= none[1]
    assert verify.sampled(Verified(certifiable=10_000, sampled=100, seed=7)) == (
        "the truth of 100 of 10,000 rows (1.00%) was certified anew (seed 7): this tells of a single row that only "
        "the truth contradicts with a chance of 1.00%, of 294 such rows with 95%"
    )
    capsys.readouterr()
    seeds = set()
    for _ in range(2):
        assert main(["verify", str(run), "--sample", "1", "--json"]) == 0
        told = json.loads(capsys.readouterr().out)
        assert told["certified"] == 1 < told["certifiable"]
        seeds.add(told["seed"])
    assert len(seeds) == 2, "who makes up a row can foresee which ones are drawn"


def test_samples_and_mistakes(run: Path, tmp_path: Path) -> None:
    for text in ("some", "-1", "101%", "nan%"):
        with pytest.raises(SystemExit):
            main(["verify", str(run), "--sample", text])
    assert main(["verify", str(run), "--sample", "1%"]) == 0 == main(["verify", str(run), "--sample", "all"])
    assert main(["verify", str(tmp_path)]) == 2
    (tmp_path / "plan.json").write_text("{")
    assert main(["verify", str(tmp_path)]) == 3
    with pytest.raises(FirsthitError, match="there is no run folder"):
        verified(tmp_path / "none")
