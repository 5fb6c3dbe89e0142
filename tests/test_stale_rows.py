"""A copy of the project is edited between runs: what was measured with the old text runs again, truth included."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from harness import ROOT

from .conftest import usable_devices

CONFIG = """title = "t"
surfaces = ["torus"]
sizes = [16]
devices = ["{device}"]
[[method]]
name = "newton"
[[method]]
name = "mine"
[accuracy]
size = 16
[budget]
seconds = 0.01
"""
METHOD = """import sys
from pathlib import Path
from harness.contract import Method
sys.path.insert(0, str(Path(__file__).parent))
def accepts(surface):
    from helper import LIMIT
    return None if surface.degree <= LIMIT else f"degree {{surface.degree}}"
METHOD = Method(name="mine", source="t", needs=("surface_along", "surface_value_along"), accepts=accepts)
"""
KERNEL = """Hit first_hit(Ray ray, real t0, real t1) {
    Hit hit = no_hit(t1);
    Along along = surface_along(ray);
    real before = surface_value_along(along, t0);
    for (int i = 1; i <= 64; i++) {
        real t = t0 + (t1 - t0) * (real(i) / real(64));
        real value = surface_value_along(along, t);
        hit.evaluations += 1;
        if ((before < 0.0) != (value < 0.0)) return hit_at(hit, t);
        before = value;
    }
    return hit;
}
"""


class Copy:
    """A copy of the project, a plugin and a config; `run` runs the config there."""

    def __init__(self, folder: Path, device: str) -> None:
        self.tree, self.plugin, self.config = folder / "tree", folder / "plugins" / "mine", folder / "t.toml"
        for room in ("harness", "surfaces", "methods"):
            shutil.copytree(ROOT / room, self.tree / room, ignore=shutil.ignore_patterns("__pycache__"))
        self.plugin.mkdir(parents=True)
        (self.plugin / "method.py").write_text(METHOD)
        (self.plugin / "kernel.glsl").write_text(KERNEL)
        (self.plugin / "helper.py").write_text("LIMIT = 4\n")
        self.config.write_text(CONFIG.format(device=device))

    def firsthit(self, *arguments: object) -> str:
        command = [sys.executable, "-m", "harness.cli", "--plugins", self.plugin.parent, *arguments]
        environment = os.environ | {"PYTHONPATH": str(self.tree), "PYTHONDONTWRITEBYTECODE": "1"}
        ran = subprocess.run(
            list(map(str, command)), cwd=self.tree, env=environment, capture_output=True, text=True, check=False
        )
        assert ran.returncode == 0, ran.stderr
        return ran.stdout

    def run(self) -> tuple[str, dict, list[np.ndarray]]:
        """What the command said, newton's current row, and the conditions in the truth files, oldest first."""
        folder = self.config.parent / "runs"
        told = self.firsthit("run", self.config, "--runs", folder)
        cells = json.loads((folder / "t" / "plan.json").read_text())["cells"]
        key = next(cell["key"] for cell in cells if cell["slot"].startswith("newton"))
        files = sorted((folder / "t" / "truth").glob("*.npz"), key=lambda file: file.stat().st_mtime_ns)
        row = json.loads((folder / "t" / "cells" / f"{key}.json").read_text())
        return told, row, [np.load(file)["condition"] for file in files]

    def why(self, key: str) -> list[str]:
        return self.firsthit("why", key, "--runs", self.config.parent / "runs").splitlines()

    def append(self, file: str, text: str) -> None:
        path = self.tree / file
        path.write_text(path.read_text() + text)


@pytest.fixture
def copy(tmp_path) -> Copy:
    names = [info.name for info in usable_devices()]
    if not names:
        pytest.skip("no device")
    return Copy(tmp_path, names[0])


def test_what_decides_a_row_makes_it_run_again_and_nothing_else_does(copy):
    told, first, truth = copy.run()
    assert "2 cells run, 0 reused" in told and len(truth) == 1
    copy.append("harness/console.py", "\n# no cell depends on how tables are printed\n")
    assert "0 cells run, 2 reused" in copy.run()[0]

    (copy.plugin / "helper.py").write_text("LIMIT = 5\n")
    assert "1 cell run, 1 reused" in copy.run()[0]

    evaluate = "\n_of_old = evaluate\n\n\ndef evaluate(*given):\n    return 1000.0 * _of_old(*given)\n"
    copy.append("surfaces/evaluation.py", evaluate)
    assert "  methodology: surfaces/evaluation.py changed" in copy.why(first["key"])
    told, scaled, truth = copy.run()
    assert "2 cells run, 0 reused" in told and len(truth) == 2
    np.testing.assert_array_equal(*truth)
    old, new = (row["accuracy"]["residual"]["max"] for row in (first, scaled))
    assert old > 0.0 and new == pytest.approx(1000.0 * old)

    condition = "\n_of_old = classify\n\n\ndef classify(*given):\n    following, condition, *more = _of_old(*given)\n"
    copy.append("harness/oracle/classify.py", condition + "    return following, 1e6 * condition, *more\n")
    told, ill, truth = copy.run()
    assert "2 cells run, 0 reused" in told and len(truth) == 3
    np.testing.assert_array_equal(truth[2], 1e6 * truth[1])
    assert ill["accuracy"]["condition_ratio"]["max"] < 1e-3 * scaled["accuracy"]["condition_ratio"]["max"]

    assert "0 cells run, 2 reused" in copy.run()[0]
    before = copy.why(ill["key"])
    assert before.count("  methodology: harness/oracle/classify.py changed") == 1
    assert any(line.startswith("since then nothing changed") for line in before)
