"""Whatever stops a write half-way, the old file is whole and nothing lies beside it."""

import ast
import contextlib
import os
import signal
import subprocess
import sys
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import surfaces
from harness import studies
from harness.cli import main
from harness.commands import options
from harness.contract import DeviceInfo, FirsthitError
from harness.gate import baseline
from harness.oracle import cache
from harness.oracle import first_hits as certified
from harness.results import owner, writing
from harness.results.store import Store
from harness.results.writing import replacing, replacing_together, savez_atomically, write_atomically
from reports.site import build

ROOT = Path(__file__).parent.parent
RAYS = np.array([[0, 0, 5, 0, 0, -1]], np.float32)
# what may write without the writer of harness.results, and why that is right
EXEMPT = {
    "harness/commands/pictures.py": {"save"},  # into memory
    "harness/devices/opencl.py": {"write_text", "copy"},  # a list of drivers, gone when it is read
    "harness/gate/export.py": {"write_text", "save", "savez"},  # into the folder of revision.py
    "harness/gate/servers.py": {"open"},  # appends to the summary of a step, which is GitHub's file
    "harness/hosting/process.py": {"write_text"},  # a wish to the system, of which process to end first
    "harness/merging/merge.py": {"write_text", "open"},  # by the store, and into the writer's temporary file
    "harness/oracle/cache.py": {"open", "savez"},  # into the writer's temporary file
    "harness/results/archive.py": {"open"},  # into the writer's temporary file, and into a temporary folder
    "harness/results/compaction.py": {"write_table"},  # into the writer's temporary folder
    "harness/results/store.py": {"write_text"},  # its own, by the writer
    "harness/results/writing.py": {"mkstemp", "TemporaryDirectory", "open", "write_bytes", "savez_compressed"},
    "reports/drawing/canvas.py": {"savefig"},  # into memory
    "reports/drawing/images.py": {"save"},  # into memory
    "reports/drawing/pairs.py": {"savefig"},  # into memory
    "reports/for_papers/files.py": {"write_text", "write_bytes", "savefig"},  # into the writer's temporary folder
    "reports/history/draw.py": {"write_text"},  # into the writer's temporary folder, as those below
    "reports/history/multiples.py": {"savefig"},
    "reports/reading/export.py": {"write_table"},
    "reports/rendering/document.py": {"copy", "write_text", "write_bytes"},
    "reports/rendering/html.py": {"write_text"},
    "reports/rendering/pictures.py": {"save"},  # into memory
    "reports/report.py": {"to_csv", "write_text"},
    "reports/site/build.py": {"copyfile", "write_bytes", "write_text"},  # into a folder that it then renames
    "reports/site/pictures.py": {"save"},  # into that folder
}
WRITES = {"write_text", "write_bytes", "mkstemp", "mkdtemp", "TemporaryDirectory", "NamedTemporaryFile", "savefig"}
WRITES |= {"save", "savez", "savez_compressed", "tofile", "to_csv", "to_parquet", "write_table", "write_csv"}
OF_MODULES = {("shutil", "copy"), ("shutil", "copyfile"), ("shutil", "move"), ("json", "dump"), ("pickle", "dump")}


class Stopped(Exception):
    """What a test stops a write with."""


def writes(path):
    """The names of calls in a file that write to a disk: those of WRITES and OF_MODULES, and open for writing."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            modes = [a.value for a in node.args if isinstance(a, ast.Constant) and isinstance(a.value, str)]
            opens = name in ("open", "fdopen") and any(set(mode) & set("wax+") and len(mode) < 4 for mode in modes)
            module = getattr(getattr(node.func, "value", None), "id", "")
            if opens or (name in WRITES and isinstance(node.func, ast.Attribute)) or (module, name) in OF_MODULES:
                found.add("open" if opens else name)
    return found


def test_nothing_writes_past_the_writer():
    files = [
        f for room in ("surfaces", "harness", "firsthit", "methods", "reports") for f in (ROOT / room).rglob("*.py")
    ]
    found = {f.relative_to(ROOT).as_posix(): writes(f) for f in files}
    assert {name: calls for name, calls in found.items() if calls} == EXEMPT


def stop(*_, **__):
    raise Stopped


def fill(*_):
    raise OSError(28, "No space left on device")


def kept(path, write, tells=True):
    """Assert that `path` is as it was, with nothing beside it, after a write that is stopped and one that is not.

    With `tells` a write that fails raises FirsthitError.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"the old file")
    for way, error in ((stop, Stopped), (fill, FirsthitError)):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(writing, "flush", way)
            with pytest.raises(error) if tells or way is stop else contextlib.nullcontext():
                write()
        assert path.read_bytes() == b"the old file"
        assert [file.name for file in path.parent.iterdir()] == [path.name]
    write()
    assert path.read_bytes() != b"the old file"


def test_bytes_arrays_and_what_a_library_writes(tmp_path):
    def library():
        with replacing(tmp_path / "c" / "file.txt") as temporary:
            assert temporary.suffix == ".txt", "a library may go by it"
            temporary.write_text("new")

    kept(tmp_path / "a" / "file.bin", lambda: write_atomically(tmp_path / "a" / "file.bin", b"new"))
    kept(tmp_path / "b" / "file.npz", lambda: savez_atomically(tmp_path / "b" / "file.npz", a=np.zeros(3)))
    kept(tmp_path / "c" / "file.txt", library)


def test_a_library_that_fails_half_way(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    with pytest.raises(Stopped), replacing(path) as temporary:
        temporary.write_text("ha")
        raise Stopped
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("file", "old")]


def test_rows_plans_truth_studies_and_baselines(tmp_path, monkeypatch):
    surface, truth = surfaces.get("sphere"), certified(surfaces.get("sphere"), RAYS)
    monkeypatch.setattr(studies, "_module", lambda _: type("Study", (), {"TITLE": "t", "compute": staticmethod(list)}))
    monkeypatch.setattr(studies, "key", lambda name: name)
    store, blessed = Store(tmp_path / "run"), tmp_path / "baselines" / "b.toml"
    file = cache.truth_path(tmp_path / "truth", surface, RAYS)
    kept(tmp_path / "run" / "cells" / "k.json", lambda: store.write({"key": "k"}))
    (tmp_path / "run" / "cells" / "k.json").unlink()
    (tmp_path / "run" / "cells").rmdir()
    kept(tmp_path / "run" / "plan.json", lambda: store.write_plan({}))
    kept(file, lambda: cache.store(file, truth), tells=False)  # it is kept by the process, and told at the run's end
    assert cache.unwritten(file.parent)
    kept(tmp_path / "done" / "studies" / "form_ranges.json", lambda: studies.run("form_ranges", tmp_path / "done"))
    kept(blessed, lambda: baseline.write(blessed, baseline.Baseline("b")))


def test_a_row_is_stored_after_its_arrays_and_not_without_them(tmp_path):
    store = Store(tmp_path)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(writing, "flush", stop)
        with pytest.raises(Stopped):
            store.write({"key": "k"}, {"status": np.zeros(1)})
    assert store.read("k") is None
    assert not [file for file in tmp_path.rglob("*") if file.is_file()]


def test_probes_which_a_run_does_without(tmp_path):
    from harness.devices.probes import Probes
    from harness.running.environment import probed

    fields = dict.fromkeys(Probes.__dataclass_fields__, 1.0)
    executor = SimpleNamespace(probe=lambda _: Probes(**fields))
    info = DeviceInfo("opencl:none", "", "", "", 1, True, "wall", ())
    probed(executor, info, tmp_path / "probes")
    (path,) = (tmp_path / "probes").iterdir()
    path.write_text("{}")  # so that they are looked for again
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(writing, "flush", fill)
        probed(executor, info, tmp_path / "probes")
    assert [(file, file.read_text()) for file in (tmp_path / "probes").iterdir()] == [(path, "{}")]


def test_what_commands_write(tmp_path):
    """Here oracle stands for trace, which writes as it does; what needs a device is called behind the casting."""
    image = pytest.importorskip("PIL.Image")
    from harness.commands import telling
    from harness.commands.pictures import save

    rays, truth, picture = tmp_path / "rays.npy", tmp_path / "oracle" / "t.npz", tmp_path / "show" / "a.png"
    np.save(rays, RAYS)
    options = ["oracle", "--surface", "sphere", "--rays", str(rays), "-o", str(truth)]
    truth.parent.mkdir()
    truth.write_text("old")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(writing, "flush", fill)
        assert main(options) == 3
    assert [(file, file.read_text()) for file in truth.parent.iterdir()] == [(truth, "old")]
    kept(picture, lambda: save(image.new("RGB", (2, 2)), picture))
    checked = SimpleNamespace(experiment=SimpleNamespace(name="quick"))
    for kind in ("junit", "markdown"):
        told = SimpleNamespace(junit=None, markdown=None, github=False, pictures=None, json=False)
        setattr(told, kind, tmp_path / kind / "gate.txt")
        kept(getattr(told, kind), partial(telling.tell, told, checked, [], "baseline.toml", 0, {}))


def test_a_report_is_replaced_as_a_whole(tmp_path):
    pytest.importorskip("typst")
    from reports import report
    from tests.synthetic_run import cell, tiny_run

    run, made = tiny_run(tmp_path / "run", cell("ray_march", "sphere", "opencl:pocl", "float32")), tmp_path / "made"
    made.mkdir()
    names = ("report.pdf", "report.html", "results.csv", "results.parquet", "stability.csv")
    for name in names:
        (made / name).write_text("old")
    before = {path: path.is_file() and path.read_bytes() for path in tmp_path.rglob("*")}
    for broken in ("export.write", "html.write_html", "document.write_pdf"):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(f"reports.report.{broken}", stop)
            with pytest.raises(Stopped):
                report.build(run, made)
        assert {path: path.is_file() and path.read_bytes() for path in tmp_path.rglob("*")} == before
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(writing, "flush", fill)
        with pytest.raises(FirsthitError, match=r"cannot write the report into .*: No space left"):
            report.build(run, made)
    assert {path: path.is_file() and path.read_bytes() for path in tmp_path.rglob("*")} == before
    report.build(run, made)
    assert not [name for name in names[:-1] if (made / name).read_bytes() == b"old"]
    assert not (made / "stability.csv").exists(), "of an earlier plan"


KILLED = """
import os, signal, sys
from pathlib import Path
from harness.results import writing
folder = Path(sys.argv[1])
def die(*_):
    os.kill(os.getpid(), signal.SIGKILL)
if sys.argv[2] == "bytes":
    writing.flush = die
    writing.write_atomically(folder / "a", b"new")
elif sys.argv[2] == "library":
    with writing.replacing(folder / "a") as temporary:
        temporary.write_text("ne")
        die()
else:
    with writing.replacing_together(folder, "the files") as made:
        (made / "a").write_text("new")
        die()
"""


@pytest.mark.parametrize("way", ["bytes", "library", "together"])
def test_a_process_that_is_killed_leaves_the_old_file(tmp_path, way):
    (tmp_path / "a").write_text("old")
    ran = subprocess.run([sys.executable, "-c", KILLED, str(tmp_path), way], cwd=ROOT, check=False)
    assert ran.returncode == -signal.SIGKILL
    assert (tmp_path / "a").read_text() == "old"


def test_files_that_belong_together_are_complete_before_the_first_is_replaced(tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).write_text("old")
    with pytest.raises(Stopped), replacing_together(tmp_path, "the files") as made:
        (made / "a").write_text("new")
        raise Stopped
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == {"a": "old", "b": "old"}
    with replacing_together(tmp_path, "the files") as made:
        (made / "a").write_text("new")
        (made / "scratch").mkdir()
        assert (tmp_path / "a").read_text() == "old"
    assert {file.name: file.read_text() for file in tmp_path.iterdir()} == {"a": "new", "b": "old"}


@pytest.mark.parametrize("command", ["show", "sheet"])
@pytest.mark.parametrize("name", ["a.jpg", "a.PNG.txt", "a"])
def test_a_picture_of_another_kind_is_refused(tmp_path, capsys, command, name):
    surface = ["--surface", "sphere"] if command == "show" else []
    assert main([command, *surface, "--method", "newton", "-o", str(tmp_path / name)]) == 2
    assert "pictures are PNG files; name it a" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_pipe_or_a_device_is_not_replaced_by_a_file(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(FirsthitError, match="a device or a pipe"):
        writing.write_atomically(pipe, b"x")
    assert pipe.is_fifo() and list(tmp_path.iterdir()) == [pipe]
    with pytest.raises(FirsthitError, match="a device or a pipe"):
        options.writable(pipe)


def test_what_a_killed_publish_left_is_put_back_or_removed(tmp_path):
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    for letter in "ab":
        left = tmp_path / f".site-{owner.machine()}-{ended.pid}-1-{letter * 8}"
        (left / "new").mkdir(parents=True)
    (left / "old").mkdir()
    (left / "old" / "page").write_text("old")
    with pytest.raises(ZeroDivisionError), build._replacing(tmp_path / "site"):
        raise ZeroDivisionError
    assert [path.relative_to(tmp_path).as_posix() for path in sorted(tmp_path.rglob("*"))] == ["site", "site/page"]
