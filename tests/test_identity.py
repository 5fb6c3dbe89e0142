"""What decides a row: every module that a run imports is hashed, and what is left out is named with its reason."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import surfaces
from harness import ROOT, studies
from harness.contract import FirsthitError
from harness.devices import host
from harness.experiment import identity
from harness.oracle import cache
from harness.results import sources
from harness.results.sources import TRUTH, files_in, left_out, methodology

from .conftest import usable_devices

OWN = ("harness", "surfaces", "methods", "reports")
ENTRANCES = (
    "running.runner",
    "devices.worker",
    "devices.discovery",
    "experiment.plan",
    "experiment.reading",
    "running.environment",
    "devices.opencl",
    "devices.opengl",
)
# imported by a run and left out: harness/experiment/config.py asks for the names of studies that a config may use
READ_FOR_NAMES = {"harness/__init__.py", "harness/studies/__init__.py"}


def _files(module: str) -> list[str]:
    """The files that importing a module of ours executes; none for another's."""
    found: list[str] = []
    parts = module.split(".")
    for i in range(1, len(parts) + 1) if parts[0] in OWN else ():
        path = ROOT.joinpath(*parts[:i])
        found += [
            f.relative_to(ROOT).as_posix() for f in (path / "__init__.py", path.with_suffix(".py")) if f.is_file()
        ]
    return found


def _executed(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the node and all below it, without what stands under `if TYPE_CHECKING:`, which no run imports."""
    yield node
    typed = isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
    for child in node.orelse if typed else ast.iter_child_nodes(node):
        yield from _executed(child)


def reached(*modules: str) -> set[str]:
    """Files of ours that these modules import, at their tops or inside functions, and what those import."""
    found: set[str] = set()
    waiting = [file for module in modules for file in _files(module)]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found.add(file)
        for node in _executed(ast.parse((ROOT / file).read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                waiting += [f for name in node.names for f in _files(name.name)]
            elif isinstance(node, ast.ImportFrom):
                assert not node.level, f"{file} imports relatively, which this walk does not follow"
                waiting += [f for name in node.names for f in _files(f"{node.module}.{name.name}")]
    return found


def uncovered(files: set[str]) -> set[str]:
    """Find the files that no row's key holds, but for those that are read for names only."""
    return {file for file in files if file not in methodology()} - READ_FOR_NAMES


@pytest.fixture
def run_files() -> set[str]:
    return reached(*(f"harness.{name}" for name in ENTRANCES))


def test_every_module_that_a_run_imports_decides_its_row(run_files):
    assert {"harness/oracle/classify.py", "surfaces/evaluation.py", "harness/devices/opengl_raster.py"} <= run_files
    assert not uncovered(run_files)


@pytest.mark.parametrize("forgotten", ["harness/accuracy/judge.py", "harness/oracle", "harness/kernels", "surfaces"])
def test_leaving_out_what_decides_is_seen(run_files, monkeypatch, forgotten):
    monkeypatch.setitem(sources.NOT_DECIDING, forgotten, "forgotten")
    methodology.cache_clear()
    try:
        here = {f.relative_to(ROOT).as_posix() for f in files_in(ROOT / forgotten)}
        seen = uncovered(run_files | here)
    finally:
        methodology.cache_clear()
    assert seen == here


def test_what_is_left_out_is_there_and_has_a_reason():
    for path, reason in sources.NOT_DECIDING.items():
        assert (ROOT / path).exists() and reason
    assert left_out("harness/commands/experiment.py") == sources.NOT_DECIDING["harness/commands"]
    assert left_out("harness/commanding.py") is None


RUN = """
import dataclasses, json, sys
from pathlib import Path
from harness.experiment import plan, reading
from harness.devices.interface import find_devices
from harness.running.environment import probed
from harness.plugins import find_methods
from harness.running.runner import Runner
from harness.results.store import Store
from harness.devices.worker import Worker

class Here:
    '''Does in this process what a worker would.'''
    moves = 0
    def __init__(self): self.workers = {}
    def expect(self, samples): pass
    def __getattr__(self, operation):
        def do(device, *arguments, **named):
            worker = self.workers.setdefault(device, Worker(device))
            key_and_batch = (arguments[0], arguments[2]) if operation == "sample" else arguments
            return getattr(worker, operation)(*key_and_batch, **named)
        return do

catalog = find_methods()
experiment = reading.load(Path(sys.argv[1]), catalog)
info = next(i for i in find_devices(sys.argv[2].partition(":")[0]) if i.name == sys.argv[2])
folder = Path(sys.argv[1]).parent / "runs"
info, _ = probed(Here(), info, folder)
cells = plan.plan(experiment, catalog, [info])
about = {"commit": None, "dirty": False, "machine": None}
rows = Runner(experiment.config, catalog, Store(folder), Here(), about, lambda *_: None).run(cells)
files = {Path(m.__file__).resolve() for m in sys.modules.values() if getattr(m, "__file__", None)}
print(json.dumps({"rows": [[r["status"], r["reason"]] for r in rows.values()], "files": sorted(map(str, files))}))
"""
TINY = """title = "t"
surfaces = ["sphere"]
families = ["grazing"]
sizes = [16]
devices = ["{device}"]
{more}
[[method]]
name = "newton"
[accuracy]
size = 8
[budget]
seconds = 0.01
"""


def test_a_run_imports_nothing_that_the_walk_does_not_find(tmp_path, run_files):
    """Also what is imported by a name that is put together while it runs, as backends are."""
    for info in usable_devices():
        path = tmp_path / f"{info.name.replace(':', '-')}.toml"
        stages = 'stages = ["compute", "raster"]' if info.name.startswith("opengl") else 'prepass = ["none", "beams"]'
        path.write_text(TINY.format(device=info.name, more=stages))
        command = [sys.executable, "-c", RUN, str(path), info.name]
        ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=200, check=False)
        assert ran.returncode == 0, ran.stderr
        told = json.loads(ran.stdout.splitlines()[-1])
        assert sum(status == "ok" for status, _ in told["rows"]) == 3, told["rows"]
        ours = {Path(file) for file in told["files"]} & {ROOT / f for room in OWN for f in files_in(ROOT / room)}
        named = {file.relative_to(ROOT).as_posix() for file in ours}
        assert "harness/running/runner.py" in named and not named - run_files


def test_every_module_that_the_oracle_imports_decides_its_truth():
    says_which = {
        "harness/__init__.py",
        "harness/results/__init__.py",
        "harness/results/npz.py",
        "harness/results/owner.py",
        "harness/results/sealed.py",
        "harness/results/sources.py",
        "harness/results/writing.py",
        "harness/spreading/__init__.py",
    }  # the version, which files these are, whose a temporary file is, how a file is read and replaced, and who answers
    assert "surfaces/evaluation.py" in reached("harness.oracle")
    assert reached("harness.oracle") - says_which <= sources.hashes(*TRUTH).keys()


def test_every_module_that_makes_a_mesh_decides_its_file():
    stores = {
        "harness/__init__.py",
        "harness/results/__init__.py",
        "harness/results/npz.py",
        "harness/results/owner.py",
        "harness/results/sealed.py",
        "harness/results/sources.py",
        "harness/results/writing.py",
    }
    names = {"harness/scenes/__init__.py", "harness/kernels/__init__.py", "harness/kernels/fitting.py"}
    assert reached("harness.scenes.meshes") - stores <= {*sources.hashes(*sources.MESHES), *names}


def test_a_part_that_is_not_there_is_no_cover():
    with pytest.raises(FirsthitError, match="is missing"):
        sources.hashes("harness/none.py")


# Keys


def _truth_name(*asked: float) -> str:
    rays = np.array([[0, 0, 3, 0, 0, -1]], np.float32)
    return cache.truth_path(Path("t"), surfaces.get("sphere"), rays, *asked).name


def test_truth_is_named_by_the_oracle_the_packages_and_what_was_asked(monkeypatch):
    names = {_truth_name(), _truth_name(0.5)}
    for part, changed in (("digest_of", lambda *_: "other"), ("packages", lambda: {"numpy": "0"})):
        with monkeypatch.context() as patched:
            cache._oracle.cache_clear()
            patched.setattr(cache, part, changed)
            names.add(_truth_name())
    cache._oracle.cache_clear()
    assert len(names) == 4 and _truth_name() in names


def test_a_study_is_as_old_as_what_it_computes_with(monkeypatch):
    before = studies.key("mesh_errors")
    assert before == studies.key("mesh_errors") != studies.key("condition_numbers")
    monkeypatch.setattr(sources, "methodology", lambda: {"surfaces/evaluation.py": "other"})
    assert studies.key("mesh_errors") != before


def test_settings_of_drivers_and_the_cores_are_told_apart(monkeypatch):
    monkeypatch.delenv("LP_NUM_THREADS", raising=False)
    monkeypatch.delenv("POCL_KERNEL_CACHE", raising=False)
    before = identity.common([], timed=True)
    monkeypatch.setenv("LP_NUM_THREADS", "1")
    monkeypatch.setenv("POCL_KERNEL_CACHE", "0")  # as the harness itself sets it
    monkeypatch.setattr(host, "cores", lambda: 1024)
    after = identity.common([], timed=True)
    assert after["settings"] == before["settings"] | {"LP_NUM_THREADS": "1"}
    assert after["cores"] == 1024
    assert identity.common([], timed=False)["cores"] is None


# A method's own modules


def _method(folder: Path, text: str = "") -> Path:
    folder.mkdir(parents=True)
    (folder / "method.py").write_text(text)
    (folder / "kernel.glsl").write_text("")
    return folder


def test_a_methods_key_holds_its_folder_and_its_modules_elsewhere(tmp_path):
    folder = _method(
        tmp_path / "mine", "import numpy\nfrom shared import tables\n\ndef accepts(_):\n    import helper\n"
    )
    (folder / "helper.py").write_text("")
    (folder / "weights.csv").write_text("1")
    (folder / "__pycache__").mkdir()
    (folder / "__pycache__" / "method.pyc").write_text("")
    (tmp_path / "unrelated.py").write_text("")
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "__init__.py").write_text("from . import deeper")
    (tmp_path / "shared" / "tables.py").write_text("")
    (tmp_path / "shared" / "deeper.py").write_text("")
    named = {"mine/method.py", "mine/kernel.glsl", "mine/helper.py", "mine/weights.csv"}
    shared = {"shared/__init__.py", "shared/tables.py", "shared/deeper.py"}
    before = sources.of_method(folder)
    assert before.keys() == named | shared
    (tmp_path / "shared" / "deeper.py").write_text("X = 1")
    after = sources.of_method(folder)
    (change,) = identity.changes({"method": before}, {"method": after})
    assert (str(change), change.part) == ("method: shared/deeper.py changed", ("method", "shared/deeper.py"))


def test_an_installed_methods_key_holds_its_package_and_no_other(tmp_path):
    site = tmp_path / "site-packages"
    folder = _method(site / "casters" / "mine", "import numpy, casters.common\n")
    for name in ("casters/__init__.py", "casters/common.py", "casters/mine/__init__.py", "numpy.py"):
        (site / name).write_text("")
    own = {f"casters/mine/{name}" for name in ("__init__.py", "method.py", "kernel.glsl")}
    assert sources.of_method(folder).keys() == own | {"casters/__init__.py", "casters/common.py"}


def test_our_methods_keys_are_their_folders():
    assert sources.of_method(ROOT / "methods" / "newton").keys() == {
        "methods/newton/kernel.glsl",
        "methods/newton/method.py",
    }
