"""What people and CI servers are told of made-up rows: table, Markdown, JUnit, annotations, step summary."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

from harness.contract import FirsthitError
from harness.escaping import hidden
from harness.gate import outputs, servers
from harness.gate.about import About
from harness.gate.baseline import Baseline
from harness.gate.chosen import Only
from harness.gate.judge import Change, Judged, Verdict

LONG = "double_derivative_bisection barth_sextic oblique 64x64x1 float32 compute"
ERROR = Change("error_max", 1e-5, 1.0, 1.05e-5, Verdict.REGRESSED)
FEWER = Change("misses", 3, 1, 3, Verdict.IMPROVED)
ROWS = [
    Judged("m a", "opencl:a", "m", Verdict.REGRESSED, "", (FEWER, ERROR), rule="last bits"),
    Judged("gone", "opencl:a", "m", Verdict.MISSING, "blessed, but no longer in the config"),
    Judged("m c|<&>\"'", "opencl:a", "m", Verdict.INCOMPARABLE, "another view"),
    Judged("m b", "opencl:a", "m", Verdict.PASS, rule="exact"),
]
ABOUT = {
    ("m a", "opencl:a"): About("firsthit gate c --only 'm a'", 1.25, None, Path("pics/a.png")),
    ("gone", "opencl:a"): About("firsthit gate c --only gone"),
    ("m b", "opencl:a"): About("firsthit gate c --only 'm b'", 2.0, "2026-11-28T01:02:03+00:00"),
}
HOSTILE = "m\n::error::x\r\n%0A|`<b>` [a](b)"


def hostile(verdict=Verdict.REGRESSED):
    return Judged(HOSTILE, "opencl:a", "m", verdict, HOSTILE, (ERROR,), rule="exact")


def test_junit_is_xml_with_a_failure_for_each_bad_row():
    suite = ElementTree.fromstring(servers.junit(ROWS, "t", ABOUT)).find("testsuite")
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("4", "2", "1")
    cases = {case.get("name"): [child.tag for child in case][1:] for case in suite}
    assert cases == {
        "m a": ["failure", "system-out"],
        "gone": ["failure"],
        "m c|<&>\"'": ["error"],
        "m b": [],
    }
    assert "error_max 1e-05 → 1" in suite.find("testcase/failure").get("message")


def test_junit_cases_say_what_they_took_when_and_how_to_get_them_again():
    suite = ElementTree.fromstring(servers.junit(ROWS, "t", ABOUT)).find("testsuite")
    cases = {case.get("name"): case for case in suite}
    told = {name: {p.get("name"): p.get("value") for p in case.iter("property")} for name, case in cases.items()}
    assert {name: case.get("time") for name, case in cases.items()} == {
        "m a": "1.250",
        "gone": None,
        "m c|<&>\"'": None,
        "m b": "2.000",
    }
    assert suite.get("time") == "3.250"
    assert told["m a"] == {
        "verdict": "regressed",
        "rule": "last bits",
        "command": "firsthit gate c --only 'm a'",
        "picture": "pics/a.png",
    }
    assert told["m b"]["earlier"] == "2026-11-28T01:02:03+00:00"
    body = cases["m a"].find("failure").text
    assert "again: firsthit gate c --only 'm a'" in body and "(rule: last bits)" in body
    assert cases["m a"].find("system-out").text == "[[ATTACHMENT|pics/a.png]]"


def test_junit_holds_any_name():
    row = ElementTree.fromstring(servers.junit([hostile()], "t\x00", {})).find("testsuite/testcase")
    assert hidden(row.get("name")) == HOSTILE


def test_markdown_is_a_table_with_the_worst_first_and_the_rule():
    text = outputs.markdown(ROWS, "t", "b.toml", 1, ABOUT)
    assert text.startswith(
        "## Gate t: **failed**\n\n1 regressed, 1 missing, 1 incomparable, 1 pass (1 of 4 held by last bits); "
        "held against `b.t"
    )
    rows = [line for line in text.splitlines() if line.startswith("| ")][2:]
    assert [row.split(" | ")[0] for row in rows] == ["| regressed", "| regressed", "| missing", "| incomparable"]
    assert rows[0].split(" | ")[1:5] == ["m a", "opencl:a", "last bits", "error_max"]
    assert "m c\\|&lt;&amp;>" in rows[3]


def test_markdown_says_how_to_get_a_bad_row_again_and_where_its_picture_is():
    text = outputs.markdown(ROWS, "t", "b.toml", 1, ABOUT)
    assert "`firsthit gate c --only 'm a'`  \n  wrong rays: `pics/a.png`" in text
    assert "`firsthit gate c --only gone`\n" in text
    assert "'m b'" not in text


def test_no_name_leaves_its_cell_of_a_table():
    text = outputs.markdown([hostile()], "t", "b`c", 1, {})
    rows = [line for line in text.splitlines() if line.startswith("| ")][2:]
    assert len(rows) == 1
    assert rows[0].replace("\\|", "").count("|") == len(outputs.HEADER) + 1
    assert "<b>" not in text and "`` b`c ``" in text
    for width in (None, 60):
        lines = outputs.table([hostile()], width).splitlines()
        assert not [line for line in lines if line.lstrip().startswith("::")]


def test_annotations_name_the_kernel_and_escape_what_they_must(tmp_path, monkeypatch):
    monkeypatch.setenv("GITHUB_WORKSPACE", str(tmp_path))
    folder = tmp_path / "a,b"
    folder.mkdir()
    kernel = folder / "kernel.glsl"
    kernel.write_text("")
    first, *others = servers.github(ROWS, {"m": kernel}, ABOUT).splitlines()
    assert first.startswith("::error file=a%2Cb/kernel.glsl,title=regressed%3A m a::m a on opencl:a: regressed (rule")
    assert "%0Aagain: firsthit gate c --only 'm a'" in first
    assert len(others) == 2
    assert others[1].startswith("::warning ")
    assert "file=" not in servers.github(ROWS, {"m": Path("/elsewhere/kernel.glsl")}, ABOUT)


def test_an_annotation_is_at_the_line_that_a_compiler_names(tmp_path, monkeypatch):
    monkeypatch.delenv("GITHUB_WORKSPACE", raising=False)
    monkeypatch.chdir(tmp_path)
    log = "m/kernel.glsl:7: error: use of undeclared identifier\n    | return x;\n    |        ^\n    where opencl:a"
    row = Judged("m a", "opencl:a", "m", Verdict.REGRESSED, log)
    assert outputs.lines([row])[0].reason == "m/kernel.glsl:7: error: use of undeclared identifier where opencl:a"
    assert servers.github([row], {"m": Path("m/kernel.glsl")}, {}).startswith("::error file=m/kernel.glsl,line=7,title")


def test_an_annotation_is_one_line_whatever_a_row_is_called():
    (line,) = servers.github([hostile()], {}, {}).splitlines()
    title, message = line.removeprefix("::error title=").split("::", 1)
    assert "\n" not in title and ":" not in title and "," not in title
    assert "%250A" in message, "what looks like an escape is escaped"


def test_github_shows_ten_of_each_kind_and_one_notice_counts_the_others():
    rows = [
        Judged(f"m {i}", "opencl:a", "m", verdict)
        for verdict, count in ((Verdict.REGRESSED, 12), (Verdict.MISSING, 3), (Verdict.INCOMPARABLE, 11))
        for i in range(count)
    ]
    lines = servers.github(rows, {}, {}).splitlines()
    kinds = [line.split(" ")[0] for line in lines]
    assert [kinds.count(kind) for kind in ("::error", "::warning", "::notice")] == [10, 10, 1]
    assert "::5 more errors and 1 more warnings are" in lines[-1]
    assert servers.github(rows[:10], {}, {}).count("::notice") == 0


def test_the_steps_summary_is_appended_where_github_names_a_file(tmp_path, monkeypatch):
    path = tmp_path / "summary.md"
    monkeypatch.delenv(servers.SUMMARY_FILE, raising=False)
    servers.summarize("nothing")
    monkeypatch.setenv(servers.SUMMARY_FILE, str(path))
    servers.summarize("first\n")
    servers.summarize("second é\n")
    assert path.read_text(encoding="utf-8") == "first\n\nsecond é\n"
    monkeypatch.setenv(servers.SUMMARY_FILE, str(tmp_path / "none" / "summary.md"))
    with pytest.raises(FirsthitError, match=servers.SUMMARY_FILE):
        servers.summarize("lost")


def test_a_summary_that_github_would_not_show_is_shortened_at_a_line(tmp_path, monkeypatch):
    path = tmp_path / "summary.md"
    path.write_bytes(b"x" * (2**20 - 500))
    monkeypatch.setenv(servers.SUMMARY_FILE, str(path))
    servers.summarize("".join(f"line {i} é\n" for i in range(100)))
    text = path.read_text(encoding="utf-8")
    assert len(path.read_bytes()) <= 2**20
    assert text.endswith("\nThe rest is too long for a step's summary; the step's log has the table.\n")
    assert text.splitlines()[-3].startswith("line ") and text.splitlines()[-3].endswith("é")
    path.write_bytes(b"x" * 2**20)
    servers.summarize("no place is left\n")
    assert len(path.read_bytes()) == 2**20


def test_the_table_lists_all_that_does_not_pass_and_the_rule():
    text = outputs.table(ROWS)
    assert text.splitlines()[0].split()[:4] == ["verdict", "cell", "device", "rule"]
    assert " ".join(text.splitlines()[1].split()) == "regressed m a opencl:a last bits error_max 1e-05 1 1.05e-05"
    assert text.splitlines()[-1] == "1 regressed, 1 missing, 1 incomparable, 1 pass (1 of 4 held by last bits)"
    assert outputs.table(ROWS[3:]) == "1 pass"


@pytest.mark.parametrize("width", [60, 100, 160])
def test_the_table_fits_a_terminal(width):
    reason = "the worker died during check: signal SIGSEGV, " * 5
    rows = [
        Judged(LONG, "opencl:a", "m", Verdict.REGRESSED, reason, (FEWER, ERROR), rule="last bits"),
        Judged(LONG, "opengl:b", "m", Verdict.INCOMPARABLE, reason),
        *ROWS,
    ]
    text = outputs.table(rows, width)
    assert max(map(len, text.splitlines())) <= width or width < len(LONG)
    assert all(word in text for word in ("error_max", "1.05e-05", "last bits", "opengl:b", "misses (improved)"))
    assert text.count("error_max") == 2, "each figure of a row once"


def test_the_table_stays_in_columns_where_these_fit():
    assert outputs.table(ROWS, 160) == outputs.table(ROWS)
    assert outputs.table(ROWS, 60) != outputs.table(ROWS)


SLOTS = ("newton torus 64x64x1", "my_newton torus 64x64x1", "sturm[N=1] torus 64x64x1", "newton family grazing")


@pytest.mark.parametrize(
    ("texts", "expected"),
    [
        ((), SLOTS),
        (("newton torus 64x64x1",), SLOTS[:1]),
        (("newton",), (SLOTS[0], SLOTS[1], SLOTS[3])),
        (("newton*torus",), SLOTS[:2]),
        (("[N=1]",), SLOTS[2:3]),
        (("sturm", "grazing"), SLOTS[2:]),
        (("gone torus",), ("gone torus",)),
    ],
)
def test_only_chooses_rows_by_a_whole_name_a_part_or_a_star(texts, expected):
    only = Only(texts, frozenset({"gone torus"} if texts == ("gone torus",) else ()))
    assert only.slots(SLOTS) == set(expected)


def test_only_that_chooses_nothing_says_what_there_is():
    with pytest.raises(FirsthitError, match=r"no row's name holds 'newtn'; did you mean 'newton'\?"):
        Only(("newtn",)).slots(SLOTS)
    with pytest.raises(FirsthitError, match="there are no rows"):
        Only(("a",)).slots(())


def test_rows_that_are_not_chosen_are_not_missing():
    blessed = Baseline("t", {"k": {"name": "d"}}, {"k": {"a x": {}, "b x": {}}})
    only = Only(("a",), frozenset({"a x", "b x"}))
    assert only.narrowed(blessed, ["a y"]).rows == {"k": {"a x": {}}}
