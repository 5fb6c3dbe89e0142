"""No text becomes markup, code or a command, and none is lost; tests.campaigns.texts and .pages try many more."""

from __future__ import annotations

import csv
import io
import json
import subprocess
import sys
import threading
import tomllib
from xml.etree import ElementTree

import matplotlib
import pytest
import typst
from matplotlib.figure import Figure

from harness import cli, escaping
from harness.commands import machine
from harness.contract import DeviceInfo, FirsthitError
from harness.devices import serving
from harness.gate import repository
from harness.plugins import find_methods
from harness.results import git
from reports.content import Code, Column, Document, Section, Table, Text
from reports.drawing import canvas
from reports.for_papers import latex, model
from reports.parts.last_page import rerun
from reports.reading import export, load
from reports.rendering import document
from surfaces import files, names
from surfaces.words import name_problem, title_problem
from tests import hostile_texts as hostile

from .synthetic_run import cell, tiny_run

LINE = "a\n::error file=x::y"


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a\x1b[2J", r"a\x1b[2J"),
        ("\u202egnp.exe", r"\u202egnp.exe"),
        ("a\u200bb\ufeff\ufe0f\U000e0041", r"a\u200bb\ufeff\ufe0f\U000e0041"),
        ("\ud800", r"\ud800"),
        (r"\x1b", r"\x5cx1b"),
        (r"C:\users\new x\xy", r"C:\users\new x\xy"),
        ("naïve ε²\u00a0→ 曲面 e\u0301", "naïve ε²\u00a0→ 曲面 e\u0301"),
    ],
)
def test_what_cannot_be_seen_is_shown_and_reads_back(text, shown):
    assert escaping.visible(text) == shown and escaping.hidden(shown) == text
    assert escaping.harmless(shown) == shown


@pytest.mark.parametrize(
    "text", [LINE, "\r::error::x", "\u2028::x::y", " ::x::y", "##[error]x", "##vso[a]b", "\x85::a::b"]
)
def test_no_line_of_a_command_is_a_command_of_a_ci_server(text, capsys):
    assert cli.main(["report", f"{text}/runs"]) == 2
    assert cli.main(["show", "--surface", f"{text}.toml"]) == 2
    told = capsys.readouterr().err
    assert not hostile.commands(told) and "there is no run folder" in told
    with pytest.raises(SystemExit):
        cli.main([text])
    assert not hostile.commands(capsys.readouterr().err)


def test_an_object_of_json_holds_no_command_of_a_ci_server():
    held = io.StringIO()
    machine._write(held, "plan", 0, None, {"a": "##[error]x"})
    assert "##[" not in held.getvalue() and json.loads(held.getvalue())["a"] == "##[error]x"


def test_an_output_that_cannot_write_a_letter_writes_its_number(monkeypatch):
    held = io.BytesIO()
    monkeypatch.setattr(sys, "stderr", io.TextIOWrapper(held, encoding="ascii", errors="strict"))
    assert cli.main(["report", "a→b"]) == 2
    assert b"no run folder a\\u2192b" in held.getvalue()


@pytest.mark.parametrize(
    "words", [["report"], ["run"], ["gate"], ["publish", "-o", "site"], ["history"], ["new", "method"]]
)
def test_a_name_of_10000_letters_is_a_mistake_and_no_traceback(words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert cli.main([*words, "a" * 10_000]) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_what_a_kernel_prints_is_no_output_of_the_command(capfd):
    program = "print('::error file=x::y\\x1b[2J'); import sys; print('##[error]z', file=sys.stderr)"
    with subprocess.Popen([sys.executable, "-c", program], **serving.STREAMS) as process:
        told = threading.Thread(target=serving._hand_on, args=(process.stdout, "opencl:x"))
        told.start()
        told.join()
    out, err = capfd.readouterr()
    assert out == ""
    assert sorted(err.splitlines()) == ["opencl:x: ::error file=x::y\\x1b[2J", "opencl:x: \\x23#[error]z"]


def test_a_driver_may_say_anything_of_a_device():
    info = DeviceInfo("opencl:x", LINE, "d\x1b[2J", "\u202ec", None, False, "wall", ())
    assert (info.title, info.driver, info.compiler) == ("a ::error file=x::y", r"d\x1b[2J", r"\u202ec")


def test_every_name_and_title_of_ours_may_be_one():
    for name, plugin in find_methods(None).plugins.items():
        assert not name_problem(name) and not title_problem(plugin.method.source)
    assert not [name for group in ("catalog", "gallery") for name in names(group) if name_problem(name)]
    assert name_problem("a\u202eb") and title_problem(LINE) and title_problem("a" * 10_000)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("source", "'a paper\\n::error file=x::y'"),
        ("source", "'\\x1b[2J'"),
        ("settings", "{'a\\n::error::': {}}"),
        ("claims", "frozenset({'a\\u202eb'})"),
        ("parameters", "(Parameter('N', 1, 'a\\nmeaning'),)"),
        ("parameters", "(Parameter('N' * 200, 1, 'a meaning'),)"),
    ],
)
def test_texts_of_a_method_are_refused_with_file_and_line(tmp_path, field, value):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "kernel.glsl").write_text("")
    given = {"source": "'me'"} | {field: value}
    fields = "".join(f"    {name}={text},\n" for name, text in given.items())
    head = "from harness.contract import Method, Parameter\n\nMETHOD = Method(\n    name='mine',\n"
    text = f"{head}    accepts=lambda surface: None,\n{fields})\n"
    (folder / "method.py").write_text(text)
    line = 1 + next(i for i, written in enumerate(text.splitlines()) if written.startswith(f"    {field}="))
    with pytest.raises(FirsthitError, match=rf"method\.py:{line}: {field}"):
        find_methods(folder).get("mine")


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("name", r"a\n::error file=x::y", "line 2: name: a name holds no"),
        ("name", "a/b", "line 2: name: a name holds no '/'"),
        ("name", "a" * 200, "line 2: name: a name has 100 letters at most"),
        ("title", r"\u001b[2J", "line 2: title: it holds no"),
        ("source", r"\u202e", "line 2: source: it holds no"),
    ],
)
def test_names_in_a_surfaces_file_are_refused_with_file_and_line(tmp_path, key, value, told):
    path = tmp_path / "s.toml"
    path.write_text(f'formula = "x^2 + y^2 + z^2 - 1"\n{key} = "{value}"\n')
    with pytest.raises(FirsthitError, match=r"s\.toml, ") as raised:
        files.load(path)
    assert told in str(raised.value)


def test_a_foreign_files_words_add_no_line_to_what_import_writes(tmp_path):
    model_ = {"Fxyz": ["x*x+y*y+z*z-1"], "Xmin": ["-2"], "Xmax": ["2"], "Ymin": ["-2"], "Ymax": ["2"], "Zmin": ["-2"]}
    model_ |= {"Zmax": ["2"], 'a\nname = "stolen"\n#': "x", "Name": ["b"], "Component": ["b"]}
    (tmp_path / "m.json").write_text(json.dumps({"Iso3D": model_}))
    out = tmp_path / "out.toml"
    assert cli.main(["import", str(tmp_path / "m.json"), "-o", str(out)]) == 0
    assert tomllib.loads(out.read_text())["name"] == "b"


def test_a_drawing_is_xml_whatever_its_texts_hold():
    with matplotlib.rc_context(canvas.RC):
        drawn = Figure(figsize=(1, 1))
        drawn.subplots().set_title("a\x1b\x00 $\\frac$ </text><script>")
        texts = [element.text for element in ElementTree.fromstring(canvas.svg(drawn)).iter() if element.text]
    assert "a\\x1b\\x00 $\\frac$ </text><script>" in texts


def test_no_csv_of_a_run_holds_a_formula(tmp_path):
    made = cell("newton[EPSILON=0.001]", "torus", "opencl:intel", "float32") | {"arrays": None, "domain": "=1+1"}
    loaded = load.load(tiny_run(tmp_path / "run", made | {"surface_title": "\x1b", "formula": "-x^2"}))
    table = loaded.frame.reindex(columns=[f.name for f in (*export.SCHEMA, *export.DERIVED)])
    export.write(table, tmp_path / "a.csv", tmp_path / "a.parquet")
    (row,) = csv.DictReader((tmp_path / "a.csv").open(encoding="utf-8"))
    assert (row["domain"], row["formula"], row["surface_title"]) == ("'=1+1", "'-x^2", r"\x1b")


def test_a_stored_command_that_no_shell_reads_ends_no_report():
    assert rerun._words("firsthit run 'a b' --runs x") == ["firsthit", "run", "a b", "--runs", "x"]
    assert rerun._words("firsthit run 'a --runs") == ["firsthit", "run", "'a", "--runs"]
    assert rerun.folded(blank := " " * 500) == blank


def test_cells_of_csv_read_back():
    for text in ("=1", "'=1", "''-x", "+a", "@a", "-1.5", "+inf", "-x", "'a", "a=1", "−1", "95%"):
        shown = escaping.cell(text)
        assert shown == (f"'{text}" if text in ("=1", "'=1", "''-x", "+a", "@a", "-x") else text)


def test_latex_joins_no_signs_and_a_files_name_is_not_too_long():
    assert latex.escaped("--device ''a'' ?`") == "-{}-device '{}'a'{}' ?{}`"
    assert latex.escaped("\x1b\n\\input") == r"\textbackslash{}x1b \textbackslash{}input"
    assert latex.escaped("commit 4f5e2 –—") == "commit 4f5e2 --{}---" and "times" in latex.escaped("ε = 1e-6")
    assert len(model.slug("a" * 10_000)) == model.LONGEST


def test_a_commit_may_say_anything(tmp_path):
    def ran(*words, **more):
        return subprocess.run(["git", "-C", str(tmp_path), *words], check=True, capture_output=True, **more)

    ran("init", "-q")
    identity = ("-c", "user.name=a", "-c", "user.email=a@b", "-c", "i18n.commitEncoding=utf-8")
    ran(
        *identity,
        "commit",
        "--allow-empty",
        "--cleanup=verbatim",
        "-F",
        "-",
        input=b"\x1b[2J\r::error::x \xe9" + b"a" * 999,
    )
    subject = repository.commit_of(tmp_path, None, tmp_path / "c.toml").subject
    assert subject.startswith(r"\x1b[2J") and len(subject) == repository.SUBJECT
    assert subject.encode() and git.ran(tmp_path, "log").returncode == 0


def test_printed_commands_are_one_line_that_a_shell_reads_back():
    words = ["a b", LINE, "\x1b", "\\'\"$(id)`id`!", "##[error]x", "é\u202e", ""]
    command = escaping.shell(words)
    assert "\n" not in command and not hostile.commands(command)
    told = subprocess.run(["bash", "-c", f"printf '%s\\0' {command}"], capture_output=True, check=True).stdout.decode()
    assert told.split("\0")[:-1] == words


def test_typst_reads_a_text_and_no_markup(tmp_path):
    payloads = [
        '#eval("1") #read("/etc/passwd")',
        "$ x^2 $ @label <label>",
        "= h *b* _i_ `r` // c",
        "#set page(width: 1pt)",
    ]
    texts = [*payloads, "a\x1b[2J\u202e\\"]
    sections = tuple(Section(text, (Text(text), Code(text)), own_page=True) for text in texts)
    table = Table((Column(texts[0]),), [(text,) for text in texts], texts[1], texts[2])
    made = Document(texts[0], texts[1], Section("s", (Text(texts[3], strong=True), table)), sections)
    document.write_pdf(made, tmp_path / "typst", tmp_path / "a.pdf", "no date")
    told = typst.query(tmp_path / "typst" / document.REPORT, "heading", **document._settings(tmp_path / "typst"))
    assert [heading["body"]["text"] for heading in json.loads(told)] == list(map(escaping.visible, texts))
