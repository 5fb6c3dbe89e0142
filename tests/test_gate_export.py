"""The script that `gate --against` runs inside another revision finds that revision's modules by their old names."""

import json
import os
import subprocess
import sys

import pytest

from harness.gate.revision import EXPORT

SHARED = {
    "harness/__init__.py": "",
    "harness/contract.py": "class FirsthitError(Exception): ...\nclass Program: ...\n",
    "harness/plugins.py": "def find_methods(extra): return {}\n",
}
LOAD = """
from dataclasses import dataclass
@dataclass
class Config: devices: list
@dataclass
class Experiment: config: Config
def load(path, catalog): return Experiment(Config(["all"]))
"""
PLAN = """
from types import SimpleNamespace
def plan(experiment, catalog, found):
    cell = SimpleNamespace(slot="the only cell", family=None)
    return [SimpleNamespace(cell=cell, skip=f"on {found}", checks=(), timed=None)]
"""
FIND = "def discover_devices(wanted): return wanted\n"
LAYOUTS = {
    "flat": {"config": LOAD, "plan": PLAN, "executor": FIND},
    "in rooms": {"experiment/config": LOAD, "experiment/plan": PLAN, "devices/executor": FIND},
    "reading apart": {"experiment/config": "", "experiment/reading": LOAD, "experiment/plan": PLAN}
    | {"devices/executor": FIND},
    "without a plan": {"config": LOAD, "executor": FIND},
}


def ran(tree, layout):
    files = SHARED | {f"harness/{name}.py": text for name, text in LAYOUTS[layout].items()}
    for name, text in files.items():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text(text)
    told = json.dumps({"devices": ["opencl:none"], "own": {}})
    command = [sys.executable, "-c", EXPORT.read_text(encoding="utf-8"), "c.toml", "", ".", told]
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    return subprocess.run(command, cwd=tree, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("layout", ["flat", "in rooms", "reading apart"])
def test_every_layout_that_a_revision_may_have_is_read(tmp_path, layout):
    done = ran(tmp_path, layout)
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "cells.json").read_text())["cells"]["the only cell"]["skip"] == "on ['opencl:none']"


def test_a_revision_without_a_part_is_told_and_no_other_revisions_part_is_taken(tmp_path):
    """An editable installation offers this revision's modules wherever another one lacks them."""
    done = ran(tmp_path, "without a plan")
    assert done.returncode == 2
    assert "it has none of the modules harness.experiment.plan, harness.plan" in done.stderr
