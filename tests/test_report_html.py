"""The HTML page as text: it needs nothing beside it, escapes everything, and is small. See also test_report_browser."""

from __future__ import annotations

import base64
import io
import json
import re
import sys
from html import unescape
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from harness import cli, escaping
from reports import compare, parts, report
from reports.analysis import derive
from reports.content import Column, Document, Table
from reports.drawing import charts, markers, shades, style
from reports.reading import load
from reports.rendering import bundle, document, html, html_tables, pictures
from tests import html_content
from tests.synthetic_run import cell, tiny_run, write_run

Made = tuple[Document, dict[str, style.Mark]]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "quick")


@pytest.fixture(scope="module")
def made(run: Path) -> Made:
    return html_content.made(run)


@pytest.fixture(scope="module")
def text(made: Made) -> str:
    return html.page(*made, {"newton": "Newton"}, bundle.library())


def test_the_page_needs_nothing_beside_it(text: str) -> None:
    text = re.sub(r"<script.*?</script>", "<script></script>", text, flags=re.DOTALL)
    assert not re.search(r'(?:src|href)="(?!data:|#)[^"]', text)
    assert not re.search(r"@import|url\((?!#)", text)
    ids = re.findall(r'\bid="([^"]+)"', text)
    assert len(ids) == len(set(ids)), "an id is used twice"

    class Balance(HTMLParser):
        opened: list[str] = []  # noqa: RUF012

        def handle_starttag(self, tag: str, _attributes: object) -> None:
            if tag in ("td", "th", "tr"):
                self.end_implied("td", "th", *(["tr"] if tag == "tr" else []))
            if tag not in ("meta", "link", "img", "input", "use", "path", "rect", "br"):
                self.opened.append(tag)

        def end_implied(self, *tags: str) -> None:
            while self.opened[-1] in tags:
                self.opened.pop()

        def handle_endtag(self, tag: str) -> None:
            if tag in ("tr", "tbody"):
                self.end_implied("td", "th", *(["tr"] if tag == "tbody" else []))
            if tag not in ("use", "path", "rect"):
                assert self.opened.pop() == tag

    parser = Balance()
    parser.feed(text)
    assert parser.opened == []


def test_the_page_says_what_the_document_says_and_runs_none_of_it(text: str, made: Made) -> None:
    for section in (made[0].summary, *made[0].sections):
        assert f"<h2>{html.escaped(section.title)}</h2>" in text
    assert "<b title" not in text
    assert text.count("</script>") == text.count("<script")
    assert not re.search("[\u00ad\u200b-\u200f\u2060\ufeff]", text), "an invisible character"


def test_a_script_reads_the_texts_that_the_page_shows() -> None:
    name = html_content.EVIL
    read = re.sub("<.*?>", "", escaping.data("cells", {name: [name, 1, {"a": name}], "b": 0.5}))
    shown = html_content.SHOWN
    assert json.loads(read) == {shown: [shown, 1, {"a": shown}], "b": 0.5}
    assert unescape(escaping.html(name)) == shown


def test_the_same_run_gives_the_same_page(text: str, run: Path) -> None:
    assert html.page(*html_content.made(run), {"newton": "Newton"}, bundle.library()) == text


def test_a_report_has_the_explorer_and_a_comparison_does_without(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    variants = ("ray_march", "newton[EPSILON=0.001]")
    run = tiny_run(tmp_path / "run", *(cell(name, "sphere", "opencl:pocl", "float32") for name in variants))
    monkeypatch.setattr(parts, "sections", lambda *_: [])  # they take long, and are others' matter
    monkeypatch.setattr(document, "write_pdf", lambda _, __, path, *_more: path.touch())
    report.build(run, tmp_path / "one")
    text = (tmp_path / "one" / "report.html").read_text(encoding="utf-8")
    assert 'id="explorer"' in text
    assert bundle.library() in text
    compare.build(run, run, tmp_path / "two")
    text = (tmp_path / "two" / "report.html").read_text(encoding="utf-8")
    assert 'id="explorer"' not in text
    assert "vegaEmbed" not in text
    assert len(text) < 200_000


def test_a_report_without_the_library_names_the_package(run: Path, monkeypatch: pytest.MonkeyPatch, capsys) -> None:
    for module in ("reports.report", "reports.rendering.bundle"):
        monkeypatch.delitem(sys.modules, module)
        room, _, name = module.rpartition(".")
        monkeypatch.delattr(sys.modules[room], name)
    monkeypatch.setitem(sys.modules, "vl_convert", None)
    assert cli.main(["report", str(run)]) == 3
    assert "a report needs the package vl_convert: pip install 'firsthit[report]'" in capsys.readouterr().err


def test_the_library_is_made_once_for_a_version(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("FIRSTHIT_CACHE", str(tmp_path))
    calls: list[str] = []
    monkeypatch.setattr(bundle.vl_convert, "javascript_bundle", lambda text: calls.append(text) or f"\n{text}")
    make = bundle.library.__wrapped__
    assert make() == make() == "window.vegaEmbed=vegaEmbed;"
    assert len(calls) == 1
    (kept,) = (tmp_path / "firsthit").iterdir()
    kept.write_text("window.vega")  # damaged
    assert make() == "window.vegaEmbed=vegaEmbed;"
    assert len(calls) == 2


def test_the_library_can_stand_between_script_tags() -> None:
    assert not re.search(r"</script|<!--|<script", bundle.library(), re.IGNORECASE)


def test_the_explorer_has_every_timed_row_or_says_which(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loaded = load.load(run)
    frame = derive.derive(loaded.frame, loaded.plan.peaks)
    timed = derive.contenders(frame)
    explorer = charts.explorer(frame)
    assert explorer is not None
    assert not explorer.note
    assert sorted(explorer.columns["ms"]) == sorted(float(f"{ms:.4g}") for ms in timed["median_ms"])
    monkeypatch.setattr(charts, "POINTS", len(timed) - 1)
    capped = charts.explorer(frame)
    assert capped is not None
    shown = len(capped.columns["ms"])
    assert f"{shown:,} of {len(timed):,} rows" in capped.note
    scenes = timed["comparison"].value_counts()[list(dict.fromkeys(timed.sort_index()["comparison"]))]
    assert shown == scenes.iloc[:-1].sum()
    assert charts.explorer(frame[frame["method"] == "null"]) is None


def test_each_mark_has_an_outline_of_its_own() -> None:
    marks = style.marks([*style._HOUSE, *(f"plugin{i}" for i in range(9))])
    outlines = {(mark.color, markers.outline(mark)) for mark in marks.values()}
    assert len(outlines) == len(set(marks.values()))
    for _, path in outlines:
        assert re.fullmatch(r"(M([LQC ]?-?[01]\.\d\d,-?[01]\.\d\d)+Z?)+", path)


def test_pictures_lose_nothing_but_repeated_pixels() -> None:
    png = html_content.picture("p", 80).png
    address, width, height = pictures.held(png)
    assert (width, height) == (120, 120)
    small = Image.open(io.BytesIO(base64.b64decode(address.partition(",")[2]))).convert("RGB")
    assert small.size == (20, 20)  # 6 is the largest side up to 8 of squares that 60 × 60 consists of
    assert np.array_equal(np.asarray(small.resize((120, 120), Image.NEAREST)), np.asarray(Image.open(io.BytesIO(png))))


def test_tables_have_captions_and_headings_of_rows(text: str) -> None:
    tables = re.findall(r"<table><caption>.*?</table>", text, re.DOTALL)
    assert [len(re.findall('<th scope="?row["> ]', table)) for table in tables] == [6, 2, 6, 6]
    assert tables[1].count('<th scope="rowgroup" colspan="5">of a kind</th>') == 1
    assert all('<th scope="col"' in table for table in tables)


def test_a_large_panel_comes_first_with_all_its_texts(text: str) -> None:
    hero = text[text.index('class="hero"') :]
    hero = hero[: hero.index("Heroic.")]
    for told in ("one note</small>", "another note</small>", '<th scope="row">10⁻³</th><td>newton</td>', "a miss</li>"):
        assert told in hero
    assert hero.count("<img") == 1


def test_text_on_a_square_is_read_on_any_colour() -> None:
    def luminance(color: str) -> float:
        shares = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in shares)
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue

    colors = [f"#{level:02x}{level:02x}{level:02x}" for level in range(256)]
    for color in (*colors, *(shades.shade(badness / 100) for badness in range(101)), shades.GOOD, shades.WRONG):
        low, high = sorted((luminance(color), luminance(shades.ink(color))))
        assert (high + 0.05) / (low + 0.05) >= 4.5, color


def test_a_row_of_long_texts_is_paragraphs_and_a_very_long_table_is_cut() -> None:
    texts = Table(tuple(Column(title, stretch=1) for title in ("one", "<two>")), [("first", "<second>")], "")
    assert html_tables.table(texts) == (
        '<div class="beside"><div><h3>one</h3><p>first</p></div>'
        "<div><h3>&lt;two&gt;</h3><p>&lt;second&gt;</p></div></div>"
    )
    rows = [(i,) for i in range(html_tables.ROWS + 1)]
    for told, count in ((rows, html_tables.ROWS), (rows[1:], html_tables.ROWS)):
        made = html_tables.table(Table((Column("number", numeric=True),), told, "Many.", "Numbers."))
        assert made.count("<th scope=row") == count
        assert ("These are the first 1,000 of 1,001 rows" in made) == (len(told) > html_tables.ROWS)
