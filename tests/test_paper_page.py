"""docs/paper.md, "From an empty folder": its file and its commands, to the letter but for smaller pictures.

What conforms is asked on one device.
"""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess

import pytest

from harness import ROOT
from harness.cli import build_parser, main

from .conftest import usable_devices
from .test_gating_page import commands

PAGE = (ROOT / "docs/paper.md").read_text()
PATH = list(commands(PAGE.split("## From an empty folder")[1].split("\n## ")[0]))
SMALLER = {"sizes = [512]": "sizes = [32]", "size = 128": "size = 6", "seconds = 1.0": "seconds = 0.005"}
SURFACES = ("torus", "clebsch", "barth_sextic")


def test_the_path_has_as_few_commands_as_the_page_says():
    counted = [what for what, code in PATH if isinstance(code, int)]
    assert len(counted) == 6 and "in six commands" in PAGE
    assert [what for what, text in PATH if isinstance(text, str)] == ["paper.toml"]


@pytest.mark.usefixtures("devices_found_once", "few_degrees")
def test_the_path_ends_in_a_table_and_three_figures(tmp_path, monkeypatch, capsys):
    pytest.importorskip("typst")
    if not usable_devices():
        pytest.skip("no device")
    monkeypatch.chdir(tmp_path)
    for what, expected in PATH:
        if isinstance(expected, str):
            text = expected
            for large, small in SMALLER.items():
                assert text.count(large) == 1
                text = text.replace(large, small)
            (tmp_path / what).write_text(text.replace("fastest", usable_devices()[0].name))
            continue
        if what.startswith("firsthit "):
            one = ["--device", usable_devices()[0].name] if " conform " in what else []
            code = main([*shlex.split(what)[1:], *one])
        elif shutil.which("pdflatex"):
            code = subprocess.run(["bash", "-c", what], check=False, capture_output=True).returncode
        captured = capsys.readouterr()
        assert code == expected, f"{what}\n{captured.out}{captured.err}"
    made = tmp_path / "results"
    slugs = [surface.replace("_", "-") for surface in SURFACES]
    for slug in slugs:
        assert (made / f"figures/speed-error-{slug}.pdf").read_bytes().startswith(b"%PDF")
        assert "\\textbf{\\boldmath Mine}" in (made / f"tables/results-{slug}.tex").read_text()
    assert {path.stem for path in (made / "figures").glob("speed-error-*.pdf")} == {f"speed-error-{s}" for s in slugs}
    assert b"%PDF" in (made / "report.pdf").read_bytes()[:8]
    named = {name for name in re.findall(r"(?:figures|tables)/[a-z.-]+[a-z]\b", PAGE) if "." in name}
    assert named and all((made / name).is_file() for name in named)
    text = (made / "example.tex").read_text()
    assert all(f"figures/speed-error-{slug}}}" in text and f"tables/results-{slug}.tex}}" in text for slug in slugs)


@pytest.mark.parametrize("line", re.findall(r"^    (firsthit .+)$", PAGE, re.M))
def test_every_other_command_of_the_page_can_be_typed(line):
    words = shlex.split(line)[1:]
    build_parser(words).parse_args(words)
