"""docs/gating.md, "From an empty folder": its files and its commands, taken from the page and run to the letter."""

import re
import shlex
import subprocess
import tomllib

import pytest

from harness import ROOT
from harness.cli import build_parser, main

from .conftest import usable_devices

PAGE = (ROOT / "docs/gating.md").read_text()
DEVICE = "opencl:pocl"  # that the page names
MOST = 14  # commands; the page says how many
FENCE = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.M | re.S)
CODE = re.compile(r" +# exit code (\d+)$")


def commands(path):
    """The commands of the page's path, each with the exit code that the page says, and the files that it gives.

    Yields (command, exit code), or (file, text) for a file that the reader writes.
    """
    for language, file, text in FENCE.findall(path):
        if file:
            yield file, text
        elif language == "sh":
            for line in text.splitlines():
                code = CODE.search(line)
                yield CODE.sub("", line), int(code[1]) if code else 0


PATH = list(commands(PAGE.split("## From an empty folder")[1].split("\n## ")[0]))


def test_the_path_has_as_few_commands_as_the_page_says():
    counted = [what for what, code in PATH if isinstance(code, int)]
    assert len(counted) == MOST and "fourteen commands" in PAGE
    assert [code for _, code in PATH if isinstance(code, int)].count(1) == 2
    assert [what for what, text in PATH if isinstance(text, str)] == ["illinois/method.py", "illinois/kernel.glsl"]


@pytest.mark.usefixtures("devices_found_once", "few_degrees")
def test_the_path_is_as_written(tmp_path, monkeypatch, capsys):
    if DEVICE not in [info.name for info in usable_devices()]:
        pytest.skip(f"no {DEVICE}, which the page names")
    monkeypatch.chdir(tmp_path)
    for name in ("GIT_AUTHOR_NAME", "GIT_COMMITTER_NAME"):
        monkeypatch.setenv(name, "reader")
    for name in ("GIT_AUTHOR_EMAIL", "GIT_COMMITTER_EMAIL"):
        monkeypatch.setenv(name, "reader@example.org")
    for what, expected in PATH:
        if isinstance(expected, str):
            assert (tmp_path / what).exists(), "a file that the page says is there"
            (tmp_path / what).write_text(expected)
            continue
        program, *arguments = shlex.split(what)
        if program == "firsthit":
            code = main(arguments)
        else:
            code = subprocess.run(["bash", "-c", what], check=False).returncode
        captured = capsys.readouterr()
        assert code == expected, f"{what}\n{captured.out}{captured.err}"
        fallen = [line for line in captured.out.splitlines() if line.startswith("regressed")]
        if "--against" in what:
            assert fallen and all(": speed " in line for line in fallen), captured.out
        elif expected:
            assert {"torus", "heart", "grazing"} == {
                line.split()[2].removeprefix("family") or line.split()[3] for line in fallen
            }
            assert {"error_max", "error_p99", "worst_ratio"} <= set(captured.out.split())


def examples():
    """The other commands of the page, which stand alone on a line."""
    lines = re.findall(r"^    (firsthit .+)$", PAGE, re.M)
    assert lines
    return lines


@pytest.mark.parametrize("line", examples())
def test_every_other_command_of_the_page_can_be_typed(line):
    words = shlex.split(line)[1:]
    build_parser(words).parse_args(words)


def test_options_that_the_page_names_are_options():
    stated = set(re.findall(r"--[a-z]+(?:-[a-z]+)*", PAGE))
    parsers = build_parser()._subparsers._group_actions[0].choices  # type: ignore[union-attr]
    known = {option for parser in parsers.values() for option in parser._option_string_actions} | {"--plugins"}
    of_git = {"--quiet", "--message"}
    assert stated - known - of_git == set()


def test_figures_of_the_page_are_those_that_are_gated():
    from harness.results.figures import GATED, SPEED

    table = PAGE.split("## What is gated")[1].split("\n\n")[1]
    named = [name for line in table.splitlines()[2:] for name in re.findall(r"`(\w+)`", line.split("|")[1])]
    assert sorted(named) == sorted([*GATED, SPEED.name])
    chosen = re.search(r"\[gate\.figures\]\n((?:    .+\n)+)", PAGE)
    assert chosen and set(tomllib.loads(chosen[0].replace("    ", ""))["gate"]["figures"]) <= set(named)
