"""Whatever a plugin does costs its own rows: it runs in a process of its own, and only plain values come back."""

from __future__ import annotations

import json
import os
import re
from collections import Counter
from pathlib import Path

import pytest

import surfaces
from harness import conformance, memory
from harness.cli import main
from harness.contract import FirsthitError, MeshRecipe, Section
from harness.gate import checked, revision
from harness.gate.judge import Change, Judged, Verdict, exit_code
from harness.hosting import host
from harness.kernels.complaints import recursion
from harness.plugins import find_methods
from harness.running.cards import card

from .conftest import usable_devices

HEAD = "import os, sys, time, signal, threading, numpy\nfrom firsthit import Method, Parameter\n"
GOOD = 'from firsthit import Method\nMETHOD = Method("good", "t", accepts=lambda _: None)\n'
KERNEL = "Hit first_hit(Ray ray, real t0, real t1) { return missed(no_hit(t1)); }\n"
TORUS = surfaces.get("torus")


def _plugin(folder: Path, name: str, text: str, kernel: str = KERNEL) -> None:
    (folder / name).mkdir(parents=True)
    (folder / name / "method.py").write_text(text)
    (folder / name / "kernel.glsl").write_text(kernel)


def _pair(folder: Path, text: str) -> Path:
    """Write a plugin `bad` of this text, and one that is good beside it."""
    _plugin(folder, "bad", HEAD + text)
    _plugin(folder, "good", GOOD)
    return folder


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("os._exit(0)", "it ended its process, with exit code 0; a method.py states METHOD"),
        ("os.abort()", "it ended its process, with signal SIGABRT"),
        ("os.kill(os.getpid(), signal.SIGKILL)", "it ended its process, with signal SIGKILL"),
        ("os.closerange(3, 100)\nwhile True: pass", "it closed the connection to firsthit"),
        ("class E(Exception):\n  def __str__(self): raise SystemExit\nraise E", "method.py:5: E: what cannot be shown"),
        ("raise MemoryError", "method.py:3: MemoryError"),
        ("def f(): f()\nf()", "RecursionError"),
        ("numpy.float64 = None\nMETHOD = 3", "does not define METHOD"),
        ("class M(Method):\n  name = property(lambda _: 1 / 0)\nMETHOD = M.__new__(M)", "ZeroDivisionError"),
        ("class P(Parameter):\n  sweep = 3\nMETHOD = Method('bad', 't', parameters=(P,))", "parameters: it holds"),
        ("METHOD = Method('bad', 't', label=3)", "label is 3; write a text"),
        ("METHOD = Method('bad', 't', settings={'a': {'N': 'x'}})", "settings: 'a' gives N the value 'x'"),
        ("METHOD = Method('bad', 't', settings={'a': 3})", "settings: 'a' is 3; write values of knobs by name"),
        (
            "K = [Parameter(c, 1, 'n', sweep=(1,) * 200) for c in 'AB']\nMETHOD = Method('bad', 't', parameters=K)",
            "parameters: sweeps have 40,401 combinations",
        ),
        ("print('x' * 300_000)\nMETHOD = 3", "does not define METHOD"),
    ],
)
def test_a_method_py_that_does_what_it_likes_costs_itself_only(tmp_path, text, words):
    catalog = find_methods(_pair(tmp_path, text))
    assert words in catalog.broken["bad"] and str(tmp_path / "bad") in catalog.broken["bad"]
    assert catalog.get("good").method.accepts(TORUS) is None and "newton" in catalog.plugins


def test_a_method_py_that_never_ends_costs_its_time(tmp_path, monkeypatch):
    monkeypatch.setattr(host, "LOAD_SECONDS", 2.0)
    catalog = find_methods(_pair(tmp_path, "while True: pass"))
    assert catalog.broken["bad"].endswith("it took longer than 2 s; nothing more is asked of it")
    assert "good" in catalog.plugins


def test_what_a_plugin_changes_is_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = "os.chdir('/'); os.environ['X_BAD'] = 'x'; sys.path.clear(); signal.signal(signal.SIGTERM, signal.SIG_IGN)\n"
    text += "Method.accepts = None; sys.modules['harness.contract'].CLAIMS.clear()\nimport atexit, builtins\n"
    text += "atexit.register(os.abort); threading.Thread(target=time.sleep, args=(99,)).start(); builtins.len = None\n"
    before = list(sys_path := __import__("sys").path)
    catalog = find_methods(_pair(tmp_path, text + "METHOD = Method('bad', 't', accepts=lambda _: 'no')"))
    assert "good" in catalog.plugins and "X_BAD" not in os.environ and Path.cwd() == tmp_path and sys_path == before
    assert isinstance(len("x"), int)


def test_a_fork_does_not_answer_in_its_parents_place(tmp_path):
    text = (
        "pid = os.fork()\nMETHOD = Method('bad', 'child' if pid == 0 else 'parent', accepts=lambda _: str(os.getpid()))"
    )
    method = find_methods(_pair(tmp_path, text)).get("bad").method
    assert method.source == "parent" and method.accepts(TORUS) == method.accepts(TORUS)


def _method(folder: Path, stated: str):
    _plugin(folder, "bad", f"{HEAD}METHOD = Method('bad', 't', {stated})\n")
    return find_methods(folder).get("bad").method


@pytest.mark.parametrize(
    ("stated", "words"),
    [
        ("accepts=lambda _: os._exit(7)", "accepts=... ended its process, with exit code 7"),
        ("accepts=lambda _: [].__getitem__(3)", "IndexError: list index out of range, in accepts=..."),
        ("accepts=lambda _: b'no'", "accepts returned b'no'; return None for a surface"),
        ("accepts=lambda _: time.sleep(99)", "accepts=... took longer than 2 s; nothing more is asked of it"),
        ("accepts=lambda _: bytearray(2**28)", "accepts=... held more than 0.5 of this machine's memory"),
        ("accepts=lambda _: (_ for _ in ()).throw(KeyboardInterrupt)", "KeyboardInterrupt, in accepts=..."),
        ("accepts=lambda _: os.write(int(sys.argv[1]), b'[]\\n')", "its process answered what is no answer"),
    ],
)
def test_a_function_that_does_what_it_likes_is_a_reason(tmp_path, monkeypatch, stated, words):
    monkeypatch.setattr(host, "CALL_SECONDS", 2.0)
    monkeypatch.setattr(memory, "of_machine", lambda: 400_000_000)
    with pytest.raises(FirsthitError, match=re.escape(words)) as caught:
        _method(tmp_path, stated).accepts(TORUS)
    assert caught.value.exit_code == 3


@pytest.mark.parametrize(
    ("name", "answer", "words"),
    [
        ("tolerance", "None", "tolerance returned None"),
        ("tolerance", "float('inf')", "tolerance returned inf"),
        ("tolerance", "'1'", "tolerance returned '1'"),
        ("mesh", "None", "mesh returned None; return MeshRecipe('contour', 64)"),
        ("mesh", "firsthit.MeshRecipe('cubes', 8)", "a mesh of the kind 'cubes'"),
        ("mesh", "firsthit.MeshRecipe('contour', 10**6)", "contour meshes have from 3 to"),
        ("mesh", "firsthit.MeshRecipe('contour', 'x')", "whose resolution is 'x'"),
        ("tables", "{'A': numpy.full(3, numpy.nan)}", "a table A that holds what is no finite number"),
        ("tables", "{'A': (x for x in 'ab')}", "a table A that is empty or no list"),
        ("tables", "{'A': range(10**9)}", "tables of over 100,000 numbers"),
        ("tables", "{'A': [object()]}", "a table A that holds what is no finite number"),
    ],
)
def test_an_answer_that_makes_no_sense_is_a_reason(tmp_path, name, answer, words):
    method = _method(
        tmp_path,
        f"{name}=lambda *_: __import__('harness.contract') and {answer}".replace(
            "firsthit.", "sys.modules['harness.contract']."
        ),
    )
    with pytest.raises(FirsthitError, match=re.escape(words)):
        getattr(method, name)(TORUS, {}, *(["float32"] if name == "tables" else []))


def test_answers_cross_as_plain_values(tmp_path):
    stated = "tolerance=lambda *_: numpy.float32(0.5), tables=lambda *_: {'A': numpy.arange(2), 'B': (0.1, 2)}"
    stated += ", mesh=lambda *_: sys.modules['harness.contract'].MeshRecipe('contour', numpy.int64(8))"
    method = _method(tmp_path, stated)
    assert method.tolerance(TORUS, {}) == 0.5 and type(method.tolerance(TORUS, {})) is float
    assert method.tables(TORUS, {}, "float32") == {"A": [0, 1], "B": [0.1, 2]}
    assert method.mesh(TORUS, {}) == MeshRecipe("contour", 8)


def test_a_process_that_ended_is_started_again_a_few_times(tmp_path):
    method = _method(tmp_path, "accepts=lambda surface: None if surface.name == 'torus' else os._exit(0)")
    for _ in range(host.MOST_ENDS):
        with pytest.raises(FirsthitError, match="ended its process"):
            method.accepts(surfaces.get("sphere"))
        last = _ == host.MOST_ENDS - 1
        if not last:
            assert method.accepts(TORUS) is None
    with pytest.raises(FirsthitError, match="nothing more is asked of it"):
        method.accepts(TORUS)


def test_what_it_prints_is_escaped_and_bounded(tmp_path, capsys):
    _plugin(tmp_path, "bad", HEAD + "print('\\x1b[31mred')\nos.write(1, b'\\xff\\n')\nprint('x' * 300_000)\n" + GOOD)
    find_methods(tmp_path)
    out, err = capsys.readouterr()
    assert out == "" and "\\x1b[31mred" in err and "xff\n" in err and len(err) < 100_000
    assert err.count("prints more, which is left out") == 1


def _odd(path: Path, how: str) -> None:
    path.unlink()
    if how == "folder":
        path.mkdir()
    elif how == "pipe":
        os.mkfifo(path)
    elif how == "circle":
        path.symlink_to(path)
    else:
        with path.open("wb") as file:
            file.truncate(2**30)


@pytest.mark.parametrize("file", ["method.py", "kernel.glsl"])
@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("folder", "Is a directory"),
        ("pipe", "no regular file"),
        ("circle", "but no"),
        ("huge", "has 1,073,741,824 bytes"),
    ],
)
def test_a_file_that_is_no_ordinary_one_is_said(tmp_path, file, how, words):
    _pair(tmp_path, "METHOD = Method('bad', 't')")
    _odd(tmp_path / "bad" / file, how)
    catalog = find_methods(tmp_path)
    assert words in catalog.broken["bad"] and "good" in catalog.plugins


CONFIG = """title = "t"
surfaces = ["sphere", "torus"]
sizes = [16]
devices = ["{device}"]
{methods}
[accuracy]
size = 12
max_wrong_share = 1.0
[budget]
seconds = 0.001
rounds = 1
"""
STATED = "METHOD = Method('bad', 't', parameters=(Parameter('N', 1, 'n'),), {})"
LOADED = "accepts=lambda surface: surface.name == 'torus' and {} or None"  # the sphere's cells are cast
DOES = [
    "sys.exit(0)",
    "os._exit(0)",
    STATED.format("").replace("1", "None"),
    STATED.format("tables=lambda *_: 1 / 0"),
    *(STATED.format(LOADED.format(does)) for does in ("os._exit(0)", "1 / 0", "3")),
]


def _config(folder: Path) -> tuple[list[str], int]:
    """Write a config that names all of DOES, `good` and `analytic`. Return its arguments, and how many cells fail."""
    names = [f"bad{i}" for i in range(len(DOES))]
    for name, text in zip(names, DOES, strict=True):
        _plugin(folder / "plugins", name, HEAD + text.replace("'bad'", repr(name)) + "\n")
    _plugin(folder / "plugins", "good", GOOD)
    knobs = "parameters = { N = 2 }\n"
    methods = [
        f'[[method]]\nname = "{name}"\n{knobs if "bad" in name else ""}' for name in (*names, "good", "analytic")
    ]
    text = CONFIG.format(device=usable_devices()[0].name, methods="".join(methods))
    (folder / "one.toml").write_text(text.replace("N = 2", "N = [2]"))
    where = ["--plugins", str(folder / "plugins"), "--runs", str(folder / "runs")]
    return [str(folder / "one.toml"), *where], sum(1 if "torus" in text else 2 for text in DOES)


@pytest.mark.usefixtures("devices_found_once")
@pytest.mark.skipif(not usable_devices(), reason="no device")
def test_a_config_that_names_plugins_which_go_wrong_runs_all_else(tmp_path, capsys):
    config, fell = _config(tmp_path)
    assert main(["plan", *config]) == 3
    assert capsys.readouterr().out.count("fails: ") == fell
    whole = Path(config[0]).read_text()
    Path(config[0]).write_text(
        whole[: whole.index("[[method]]")] + whole[whole.index('[[method]]\nname = "analytic"') :]
    )
    assert main(["bless", *config, "--reason", "before there were plugins"]) == 0
    Path(config[0]).write_text(whole)
    capsys.readouterr()
    assert main(["gate", *config, "--junit", str(tmp_path / "gate.xml")]) == 3
    told = capsys.readouterr()
    assert "Traceback" not in told.err and "bad0" in told.out
    cases = (tmp_path / "gate.xml").read_text().count("<testcase")
    assert cases == 2 * len(DOES) + 4
    rows = [json.loads(path.read_text()) for path in (tmp_path / "runs").glob("gate-one/cells/*.json")]
    assert Counter(row["status"] for row in rows) == {"failed": fell, "ok": cases - fell}
    assert all(row["reason"] for row in rows if row["status"] == "failed")
    assert {row["status"] for row in rows if row["method"] in ("good", "analytic")} == {"ok"}


def test_a_row_whose_method_cannot_be_asked_is_incomparable_and_no_regression():
    judged = Judged(
        "bad torus: accuracy",
        "d",
        "bad",
        Verdict.REGRESSED,
        "",
        (Change("status", "ok", "failed", "ok", Verdict.REGRESSED),),
    )
    told = checked._failed(judged, "bad/method.py:3: SystemExit: 0")
    assert exit_code([told], ()) == 3 and "SystemExit" in told.reason


def test_conform_finds_a_method_whose_functions_go_wrong_and_goes_on(tmp_path):
    _pair(tmp_path, "METHOD = Method('bad', 't', accepts=lambda _: os._exit(0))")
    bench = conformance.Bench("none", "cl", True, lambda *_: pytest.fail("nothing is cast"))
    found = list(conformance.findings(bench, find_methods(tmp_path).get("bad"), [TORUS]))
    assert found and all(finding.fails and "ended its process" in finding.detail for _, finding in found)


def test_a_kernel_without_any_function_is_no_mistake_of_ours():
    assert recursion(Section("bad/kernel.glsl", "")) is None
    assert recursion(Section("bad/kernel.glsl", "Hit first*hit(Ray ray) { }")) is None


def test_a_page_of_a_method_that_is_no_python_is_empty(tmp_path):
    _plugin(tmp_path, "bad", "METHOD = (")
    assert card(find_methods(tmp_path).with_stand_ins().get("bad"))["title"] == ""


def test_another_revision_whose_method_never_ends_is_given_up(tmp_path, monkeypatch):
    monkeypatch.setattr(revision, "PLAN_SECONDS", 1.0)
    monkeypatch.setattr(revision, "EXPORT", _written(tmp_path / "export.py", "import time; time.sleep(99)"))
    monkeypatch.setattr(revision, "_checked_out", lambda *_: tmp_path)
    there = revision.Revision("v1", "0" * 40, revision.ROOT.resolve(), None)
    monkeypatch.setattr(revision, "_held", lambda *_: None)
    with pytest.raises(FirsthitError, match="took longer than 1 s"):
        revision.programs_at(there, tmp_path / "one.toml", [])


def _written(path: Path, text: str) -> Path:
    path.write_text(text)
    return path


def test_help_says_that_plugins_run_as_the_user(capsys):
    with pytest.raises(SystemExit):
        main(["run", "--help"])
    assert "with your rights" in " ".join(capsys.readouterr().out.split())
