"""`run` and `trace` need numpy, python-flint and a backend's binding, and nothing else."""

import os
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import numpy as np
import pytest

from .conftest import usable_devices
from .test_runner import CONFIG

ROOT = Path(__file__).parent.parent
NEEDED = ("numpy", "python-flint")
BINDINGS = ("moderngl", "glcontext", "pyopencl", "pytools", "platformdirs", "typing_extensions", "siphash24")
DRIVERS = ("pocl-binary-distribution",)


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """An interpreter's path with only what a light run may use: links to the packages named above."""
    folder = tmp_path_factory.mktemp("light")
    for name in (*NEEDED, *BINDINGS, *DRIVERS):
        try:
            files = distribution(name).files or []
        except PackageNotFoundError:
            continue
        for top in {file.parts[0] for file in files if file.parts[0] not in ("..", "__pycache__")}:
            if not (folder / top).is_symlink():  # the PoCL driver lies inside pyopencl's folder
                (folder / top).symlink_to(str(distribution(name).locate_file(top)))
    for part in ("harness", "methods", "surfaces"):
        (folder / part).symlink_to(ROOT / part)
    return {**os.environ, "PYTHONPATH": str(folder)}


def _python(environment, *arguments):
    command = [sys.executable, "-S", *map(str, arguments)]  # -S: no installed packages but those on the path
    return subprocess.run(command, capture_output=True, text=True, timeout=200, check=False, env=environment, cwd="/")


@pytest.mark.parametrize(
    "package", ["matplotlib", "pandas", "pyarrow", "typst", "vl_convert", "PIL", "pyvista", "sympy", "reports"]
)
def test_everything_else_is_really_hidden(environment, package):
    assert f"No module named '{package}'" in _python(environment, "-c", f"import {package}").stderr


def test_a_run_and_a_trace_work_with_nothing_else(environment, tmp_path):
    if not usable_devices():
        pytest.skip("no device")
    config = tmp_path / "t.toml"
    text = CONFIG.format(device="all", seconds=0.05, more="")
    for many, few in ((', "torus"', ""), (", 0.0001, 0.00001", "")):
        assert text.count(many) == 1
        text = text.replace(many, few)
    config.write_text(text)
    result = _python(environment, "-m", "harness.cli", "run", config, "--runs", tmp_path / "runs")
    assert result.returncode == 0, result.stderr
    assert " ok" in result.stdout
    rays, output = tmp_path / "rays.npy", tmp_path / "hits.npz"
    np.save(rays, np.array([[0, 0, 5, 0, 0, -1]], np.float32))
    files = ("--rays", rays, "-o", output)
    result = _python(environment, "-m", "harness.cli", "trace", "--surface", "sphere", "--method", "newton", *files)
    assert result.returncode == 0, result.stderr
    assert np.isclose(np.load(output)["t"][0], 4.0, atol=1e-5)


def test_a_report_says_what_it_needs(environment, tmp_path):
    result = _python(environment, "-m", "harness.cli", "report", tmp_path)
    assert result.returncode == 3
    assert result.stderr.count("\n") == 1
    assert "pip install" in result.stderr
