"""Rows that nobody checked are no results: answers that are none, and truths that nobody decided, in every command."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest

import surfaces
from harness.cli import main
from harness.contract import TruthStatus, View
from harness.oracle import cached_first_hits
from harness.scenes.camera import camera_for, rays_of

from .conftest import usable_devices

pytestmark = pytest.mark.usefixtures("devices_found_once", "few_degrees")

PLUGIN = """from harness.contract import Method
METHOD = Method(name="{name}", source="test")
"""
KERNELS = {
    "nan": "return hit_at(hit, sqrt(-1.0 * t1));",
    "status": "hit.status = 5; hit.t = t0; return hit;",
    "count": "hit.evaluations = -1000000; return hit_at(hit, t0);",
    "outside": "return hit_at(hit, t1 + 1.0);",
}
CONFIG = """title = "t"
surfaces = ["sphere"]
sizes = [32]
devices = ["{device}"]
[accuracy]
size = 16
{accuracy}
[budget]
seconds = 0.02
"""


@pytest.fixture(params=[info.name for info in usable_devices()] or [None])
def name(request):
    return request.param or pytest.skip("no device")


@pytest.fixture
def plugins(tmp_path):
    for method, body in KERNELS.items():
        (tmp_path / "plugins" / method).mkdir(parents=True)
        (tmp_path / "plugins" / method / "method.py").write_text(PLUGIN.format(name=method))
        text = f"Hit first_hit(Ray ray, real t0, real t1) {{\n    Hit hit = no_hit(t0);\n    {body}\n}}\n"
        (tmp_path / "plugins" / method / "kernel.glsl").write_text(text)
    return tmp_path / "plugins"


def _config(folder, device, methods, accuracy="", more=""):
    text = CONFIG.format(device=device, accuracy=accuracy) + more
    path = folder / "t.toml"
    path.write_text(text + "".join(f"[[method]]\nname = {method!r}\n" for method in methods))
    return path


def _rows(folder):
    return {row["method"]: row for row in (json.loads(p.read_text()) for p in (folder / "t" / "cells").glob("*.json"))}


def _run(tmp_path, *arguments, plugins=None):
    options = ["--plugins", str(plugins)] if plugins else []
    return main([*options, *map(str, arguments), "--runs", str(tmp_path / "runs")])


def test_kernels_without_answers_are_not_timed(tmp_path, plugins, name, capsys):
    assert _run(tmp_path, "run", _config(tmp_path, name, KERNELS), plugins=plugins) == 3
    rows = _rows(tmp_path / "runs")
    for method in KERNELS:
        found = rows[method]["accuracy"]
        assert (rows[method]["status"], rows[method]["time"]) == ("failed", None), method
        assert found["invalid"] + found["grazing_invalid"] >= found["truth_hits"] > 0, method
        assert found["misses"] == found["wrong_root"] == found["false_hits"] == 0, method
        assert found["error"]["max"] is None
        assert found["evaluations_mean"] is None or found["evaluations_mean"] >= 0.0
    capsys.readouterr()


def test_trace_and_show_say_how_many_answers_are_none(tmp_path, plugins, name, capsys):
    rays = rays_of(camera_for(View("v"), surfaces.get("sphere")), 8)
    np.save(tmp_path / "rays.npy", rays)
    told = ["--surface", "sphere", "--method", "nan", "--device", name]
    arguments = ["trace", *told, "--rays", tmp_path / "rays.npy", "-o", tmp_path / "hits.npz"]
    assert main(["--plugins", str(plugins), *map(str, arguments)]) == 0
    status = np.load(tmp_path / "hits.npz")["status"]
    assert f"0 hit, 0 exhausted, {(status == 3).sum()} invalid" in capsys.readouterr().out
    assert (status == 3).sum() > 30
    assert main(["--plugins", str(plugins), "show", *told, "-o", str(tmp_path / "a.png"), "--size", "4"]) == 0
    assert "0.0% of 64 rays hit, 0 exhausted, 64 invalid" in capsys.readouterr().out


def test_conform_finds_answers_that_are_none(plugins, name, capsys):
    arguments = ["conform", "--method", "nan", "--surface", "sphere", "--device", name]
    assert main(["--plugins", str(plugins), *arguments]) == 1
    failing = capsys.readouterr().out.split("  FAILS  ")
    block = next(part for part in failing if part.startswith("answers  (sphere float32)"))
    assert "whose t is not finite or outside the domain" in " ".join(block.split())


def _undecided(share, of=TruthStatus.CROSSING):
    """The oracle, leaving so large a share of its hits undecided."""

    def first_hits(surface, rays, folder):
        truth = cached_first_hits(surface, rays, folder)
        hits = np.flatnonzero(truth.status == of)
        lost = hits[: int(np.ceil(share * len(hits)))]
        lower, upper, status = truth.lower.copy(), truth.upper.copy(), truth.status.copy()
        lower[lost] = upper[lost] = np.nan
        status[lost] = TruthStatus.UNDECIDED
        return dataclasses.replace(truth, lower=lower, upper=upper, status=status)

    return first_hits


@pytest.fixture
def one(monkeypatch):
    """The first device, and a function that makes the oracle undecided."""
    if not usable_devices():
        pytest.skip("no device")

    def leave(share):
        for module in ("accuracy.check", "experiment.kinds.family"):
            monkeypatch.setattr(f"harness.{module}.cached_first_hits", _undecided(share))

    return usable_devices()[0].name, leave


@pytest.mark.parametrize(
    ("share", "accuracy", "status"),
    [(0.005, "", "ok"), (0.1, "", "failed"), (1.0, "", "failed"), (0.1, "undecided = 0.2", "ok"),
     (0.005, "undecided = 0.0", "failed")],
)  # fmt: skip
def test_a_row_whose_hits_are_undecided_has_no_accuracy_and_no_time(tmp_path, one, capsys, share, accuracy, status):
    device, leave = one
    leave(share)
    path = _config(tmp_path, device, ["newton", "null"], accuracy)
    assert _run(tmp_path, "run", path) == (0 if status == "ok" else 3)
    rows, err = _rows(tmp_path / "runs"), capsys.readouterr().err
    assert rows["null"]["status"] == "ok", "the floor needs no truth"
    row = rows["newton"]
    assert row["status"] == status
    if status == "failed":
        assert (row["accuracy"], row["time"], row["arrays"]) == (None, None, None)
        assert "undecided" in row["reason"]
        assert row["reason"] in err
    else:
        assert row["accuracy"]["undecided"] > 0
        assert "hits undecided in 2 cells" in err


def test_hard_rays_that_nobody_decided_are_no_rungs(tmp_path, one, capsys):
    device, leave = one
    leave(0.5)
    path = _config(tmp_path, device, ["newton"])
    path.write_text(path.read_text().replace('surfaces = ["sphere"]', 'families = ["torus_axis"]'))
    assert _run(tmp_path, "run", path) == 3
    row = _rows(tmp_path / "runs")["newton"]
    assert (row["status"], row["rungs"]) == ("failed", None)
    assert "rays undecided" in row["reason"]
    capsys.readouterr()


def test_a_row_without_a_judged_ray_is_no_result(tmp_path, one):
    path = _config(tmp_path, one[0], ["newton"], "grazing_margin = 1.0")
    path.write_text(path.read_text().replace('["sphere"]', '["tiny"]').replace("size = 16", "size = 2"))
    path.write_text(path.read_text() + '[surface.tiny]\nformula = "x^2 + y^2 + z^2 - 1.4^2"\n')
    assert _run(tmp_path, "run", path) == 3
    assert "nothing to judge" in _rows(tmp_path / "runs")["newton"]["reason"]


def test_a_view_whose_every_ray_misses_is_judged_by_its_misses(tmp_path, one):
    path = _config(tmp_path, one[0], ["newton"], "", '[surface.empty]\nformula = "x^2 + y^2 + z^2 + 1"\n')
    path.write_text(path.read_text().replace('["sphere"]', '["empty"]'))
    assert _run(tmp_path, "run", path) == 0
    found = _rows(tmp_path / "runs")["newton"]["accuracy"]
    assert (found["truth_hits"], found["undecided"], found["judged"]) == (0, 0, 256)


def _recommend(tmp_path, device, formula, rays=16):
    told = ["--views", "2", "--rays", str(rays), "--size", "32", "--seconds", "0.01", "--precision", "float32"]
    arguments = ["recommend", "--formula", formula, "--error", "1e-3", "--device", device, *told]
    return main([*arguments, "--runs", str(tmp_path)])


@pytest.mark.parametrize("share", [0.05, 1.0])
def test_nothing_is_recommended_for_hits_that_nobody_decided(tmp_path, one, capsys, monkeypatch, share):
    device, leave = one
    leave(share)
    _only_newton(monkeypatch)
    assert _recommend(tmp_path, device, "x^2 + y^2 + z^2 - 1") == 1
    out = capsys.readouterr().out
    assert "No method draws" in out
    assert "hits undecided" in out


def test_nothing_is_recommended_for_a_surface_that_no_ray_hits(tmp_path, one, capsys, monkeypatch):
    _only_newton(monkeypatch)
    assert _recommend(tmp_path, one[0], "x^2 + y^2 + z^2 + 1") == 1
    assert "no hit to measure an error of" in capsys.readouterr().out


def test_a_recommendation_says_how_many_hits_were_left_undecided(tmp_path, one, capsys, monkeypatch):
    device, leave = one
    leave(0.001)
    _only_newton(monkeypatch)
    assert _recommend(tmp_path, device, "x^2 + y^2 + z^2 - 1", 32) == 0
    assert "The oracle left 4 of" in capsys.readouterr().out


def _only_newton(monkeypatch):
    from harness.plugins import find_methods
    from harness.recommend import search

    monkeypatch.setattr(search, "variants", lambda _: (find_methods().get("newton").variant({"EPSILON": 1e-5}),))


def test_the_oracle_command_says_that_its_answers_measure_nothing(tmp_path, capsys):
    np.save(tmp_path / "rays.npy", np.array([[-3.0, 0.1, 0.2, 1.0, 0.0, 0.0]], np.float32))
    told = ["--rays", str(tmp_path / "rays.npy"), "-o", str(tmp_path / "t.npz")]
    assert main(["oracle", "--formula", "cos(x)^2 + sin(x)^2 - 1 + 1e-9*y*0", *told]) == 0
    captured = capsys.readouterr()
    assert "1 undecided" in captured.out
    assert "the oracle leaves 1 of 1 hits undecided" in captured.err
    assert main(["oracle", "--surface", "sphere", *told]) == 0
    assert capsys.readouterr().err == ""
