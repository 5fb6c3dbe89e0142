"""The last page: why cells have no result, a line a reason; what the run was made with; commands that can be pasted."""

from __future__ import annotations

import json
import re
import shlex
import zlib
from pathlib import Path
from typing import Any

import pytest
import typst

from harness import ROOT
from harness.contract import digest
from harness.running import run
from reports import content
from reports.parts.last_page import TITLE, rerun
from reports.rendering import document
from tests.synthetic_run import cell, printed, reported, tiny_run

LONG = "newton[EPSILON=0.001,RELAXATION_OF_THE_LAST_STEP=1.25,STEP_BOUND=0.15]"


def refused(method: str, surface: str, reason: str) -> dict[str, Any]:
    """A cell that was skipped for `reason`."""
    made = cell("ray_march", "torus", "opencl:intel", "float32")
    slot = f"{method} {surface}"
    made |= {"slot": slot, "key": digest(slot), "method": method, "variant": method, "surface_title": surface}
    return made | {"status": "skipped", "reason": reason, "time": None, "accuracy": None, "arrays": None}


def last_page(folder: Path) -> content.Section:
    section = reported(folder)[1].sections[-1]
    assert section.title == TITLE
    return section


def test_a_reason_is_told_once_with_its_cells_methods_and_surfaces(tmp_path: Path) -> None:
    cells = [
        refused("yuksel", name, f"the method refuses the surface {name}: degree {degree}: for degrees 1 to 4")
        for name, degree in (("sextic", 6), ("decic", 10))
    ]
    cells += [refused(method, "torus", "no interval arithmetic") for method in ("newton", "sturm", "march", "fit")]
    page = last_page(tiny_run(tmp_path / "run", *cells))
    text = printed(page.blocks)
    assert "6 cells without a result: all skipped." in text
    assert "2 | skipped | degree 6: for degrees 1 to 4 | Yuksel | sextic, decic | opencl:intel" in text
    assert "4 | skipped | no interval arithmetic | 4 methods | torus | opencl:intel" in text
    assert text.count("no interval arithmetic") == 1
    assert printed(page.details).count("no interval arithmetic") == 4, "every cell is among the details"


def test_a_compilers_message_is_told_without_the_lines_that_it_quotes(tmp_path: Path) -> None:
    """The mistakes of one method follow each other, whatever its compilers call them."""
    said = {"pocl": "kernel.glsl:1:51: undeclared 'f'\n    | return f(|x|);\n    |        ^\nkernel.glsl:2: |y| too"}
    said["mesa"] = "kernel.glsl:1: no function 'f'\n    | return f(|x|);"
    cells = [
        refused(method, where, reason.replace("kernel", method))
        for where, reason in said.items()
        for method in ("newton", "sturm")
    ]
    page = last_page(tiny_run(tmp_path / "run", *cells))
    text = printed(page.blocks)
    assert "sturm.glsl:1:51: undeclared 'f' sturm.glsl:2: |y| too | " in text and "return f" not in text
    assert "return f" not in printed(page.details)
    methods = re.findall(r"1 \| skipped \| (\w+)\.glsl", text)
    assert methods == ["newton", "newton", "sturm", "sturm"]


def test_a_run_in_which_nothing_failed_says_so_and_needs_no_page_of_its_own(tmp_path: Path) -> None:
    made = cell("ray_march", "torus", "opencl:intel", "float32") | {"arrays": None}
    page = last_page(tiny_run(tmp_path / "run", made))
    text = printed(page.blocks)
    assert "Every planned cell ran and gave a result." in text and "Why cells have no result." not in text
    assert "by firsthit 0.1.0, commit abc1234 with uncommitted changes, Python 3.11.7, numpy 2.4.6" in text
    assert "opencl:intel | Intel(R) Xeon(R) *Platinum* @ 2.60GHz | 2026.2.0_#1 | 2 | 140 | yes" in text
    assert 'title = "quick"' not in text and 'title = "quick"' in printed(page.details)


@pytest.mark.one_in(3)
@pytest.mark.parametrize(
    ("command", "folder"),
    [
        ("firsthit run configs/quick.toml", "runs/quick_$"),
        ("firsthit run configs/quick.toml --runs 'my runs'", "my runs/quick_$"),
        ("firsthit run configs/quick.toml --runs=/data", "/data/quick_$"),
    ],
)
def test_the_report_is_made_from_the_folder_that_the_run_is_in(tmp_path: Path, command: str, folder: str) -> None:
    run = tiny_run(tmp_path / "run", cell("ray_march", "torus", "opencl:intel", "float32"))
    told = json.loads((run / "plan.json").read_text()) | {"command": command}
    (run / "plan.json").write_text(json.dumps(told))
    (code,) = [block for block in last_page(run).blocks if isinstance(block, content.Code)]
    assert code.text.splitlines()[-1] == f"firsthit report {shlex.quote(folder)}"
    assert command in code.text


def test_a_long_command_is_folded_into_lines_that_a_shell_reads_as_the_same_words() -> None:
    words = ["firsthit", "run", "a config.toml", *(f"--option-{i}={'x' * 20}" for i in range(9)), "y" * 130]
    told = rerun.folded(shlex.join(words))
    assert shlex.split(told.replace("\\\n", "")) == words
    assert all(len(line) <= rerun.LINE for line in told.splitlines()[:-1])
    assert rerun.folded("firsthit run x.toml") == "firsthit run x.toml"


def characters(pdf: bytes) -> str:
    """Return all characters that a PDF's fonts map their glyphs to: what can be copied from it."""
    found = []
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", pdf, re.DOTALL):
        try:
            text = zlib.decompressobj().decompress(stream)
        except zlib.error:  # a stream that is not compressed, or by another filter
            text = stream
        for block in re.findall(rb"beginbf(?:char|range)(.*?)endbf", text, re.DOTALL):
            found += [bytes.fromhex(code.decode()) for code in re.findall(rb"<([0-9A-Fa-f]{4,})>\s*(?:\n|$)", block)]
    return "".join(code.decode("utf-16-be") for code in found)


def test_no_invisible_character_can_be_copied_from_a_pdf(tmp_path: Path) -> None:
    """Long names break in narrow columns, and a command pasted from the PDF is what the run says."""
    columns = tuple(content.Column(title, stretch=1) for title in "abcdef")
    table = content.Table(columns, [(LONG,) * 6], "T")
    blocks = (table, content.Code(f"firsthit run x.toml --methods {LONG}"), content.Text(LONG))
    made = content.Document("T", "", content.Section("", (content.Text("x"),)), (content.Section("S", blocks),))
    document.write_pdf(made, tmp_path / "pdf", tmp_path / "report.pdf", "")
    copied = characters((tmp_path / "report.pdf").read_bytes())
    assert set("newton[EPSILON=0.001]") <= set(copied), "the maps are found"
    assert not set(copied) & set("\u200b\u200c\u200d\u2060\u00ad\ufeff")


def measured(folder: Path, expression: str) -> list[float]:
    """Return what a Typst expression gives that uses `breakable` of blocks.typ."""
    (folder / "blocks.typ").write_text((document.HERE / "blocks.typ").read_text(encoding="utf-8"), encoding="utf-8")
    page = folder / "page.typ"
    page.write_text(f'#import "blocks.typ": breakable\n#context [#metadata({expression}) <told>]\n')
    (told,) = json.loads(typst.query(page, "<told>", **document._settings(folder)))
    return list(told["value"])


def test_long_names_break_where_a_column_is_narrow(tmp_path: Path) -> None:
    heights = f'(30mm, 300mm).map(width => measure(block(width: width, breakable("{LONG}"))).height / 1pt)'
    narrow, wide = measured(tmp_path, heights)
    assert narrow > 3 * wide


@pytest.mark.parametrize("text", ["131,044", LONG, "opencl:intel, opencl:pocl"])
def test_what_may_break_is_as_wide_as_what_may_not(tmp_path: Path, text: str) -> None:
    """No comma hangs over what comes after it."""
    plain, breaking = measured(tmp_path, f'("{text}", breakable("{text}")).map(one => measure(one).width / 1pt)')
    assert breaking == pytest.approx(plain, rel=0.005)


def test_a_config_of_the_project_is_told_by_its_place_there(tmp_path: Path) -> None:
    """A plan names it so that the last page knows that the commit holds it, however the command named it."""
    assert run._told(ROOT / "configs" / "quick.toml") == str(Path("configs", "quick.toml"))
    assert run._told(tmp_path / "mine.toml") == str(tmp_path / "mine.toml")
    assert run._told(Path("..", "mine.toml")) == str(Path("..", "mine.toml"))
