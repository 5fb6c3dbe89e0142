"""The HTML page by itself, and in a real browser: light and dark, on a phone and on a desk."""

from __future__ import annotations

import base64
import io
import re
import time
from collections.abc import Iterator
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib.figure import Figure as Drawing
from PIL import Image

from reports import compare, parts, report
from reports.analysis import derive
from reports.content import (
    Code,
    Column,
    Document,
    Figure,
    Gallery,
    Matrix,
    Panel,
    Picture,
    Section,
    Square,
    Table,
    Text,
)
from reports.drawing import canvas, charts, style
from reports.reading import load
from reports.rendering import bundle, document, html, html_tables, pictures
from tests import browser
from tests.synthetic_run import write_run

EVIL = '</script><b title="x">&\u2028'  # a name that a surface or a plugin may have
LOOKS = [(width, dark) for dark in (False, True) for width in (390, 1280)]
NAMES = "(g => JSON.parse(decodeURIComponent(g.dataset.series)))"  # method and variants of a group of marks
POINTS = "[...document.querySelectorAll('#explorer .mark-symbol path')]"
TIP = "document.getElementById('tip')"
CONTRAST = """(() => {
  const parts = (color) => color.match(/[\\d.]+/g).map(Number);
  const luminance = ([r, g, b]) => [r, g, b].map((c) => c / 255)
    .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const ground = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const color = parts(getComputedStyle(e).backgroundColor);
      if (color.length === 3 || color[3] > 0.99) return color;
    }
    return [255, 255, 255];
  };
  const faint = [];
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
    if (!own || element.closest("svg, script, style, noscript, .note, option") || !element.checkVisibility()) continue;
    const both = [luminance(parts(getComputedStyle(element).color)), luminance(ground(element))].sort((a, b) => b - a);
    const contrast = (both[0] + 0.05) / (both[1] + 0.05);
    if (contrast < 4.5) faint.push([element.tagName, element.className, element.textContent.slice(0, 20), contrast]);
  }
  return faint;
})()"""


def picture(name: str, shade: int) -> Picture:
    """Make a picture of 2 × 2 pixels, each repeated 60 × 60 times."""
    pixels = np.full((2, 2, 3), shade, np.uint8)
    pixels[0, 1] = (250, 10, 10)
    made = io.BytesIO()
    Image.fromarray(pixels.repeat(60, 0).repeat(60, 1)).save(made, "PNG")
    return Picture(name, made.getvalue(), f"{name} of {EVIL}")


def drawing() -> str:
    """Draw a line of two variants of newton, and a point of ray_march."""
    with matplotlib.rc_context(canvas.RC):
        drawn = Drawing(figsize=(3, 2))
        axes = drawn.subplots()
        axes.plot([1, 2], [1, 2], marker="o", ms=9, gid=canvas.series("newton", "newton[EPSILON=0.001]", "newton, 2"))
        axes.plot([1], [2], marker="s", ms=9, gid=canvas.series("ray_march", "ray_march"))
        return canvas.svg(drawn)


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_run(tmp_path_factory.mktemp("runs") / "quick")


@pytest.fixture(scope="module")
def made(run: Path) -> tuple[Document, dict[str, style.Mark]]:
    """Make a document that has all that a page can show, and the marks of its methods."""
    loaded = load.load(run)
    frame = derive.derive(loaded.frame, loaded.plan.peaks)
    frame = frame.assign(surface_title=frame["surface_title"].replace("Torus", f"Torus {EVIL}"))
    explorer = charts.explorer(frame)
    number = Column("wide\nnumber", lambda value: f"{value} " * 9, numeric=True, over="both")
    rows = [(f"row {i} {EVIL}", (7 * i) % 5 + i / 10, i, f"{i} " * 30) for i in range(6)]
    table = Table((Column("name"), number, replace(number, title="other"), Column("text")), rows, "A table.", "Told.")
    squares = tuple(Square(f"{i}", color, f"note {i} {EVIL}") for i, color in enumerate(("#0072B2", "#f0e442", "")))
    lines = [("newton", (*squares, Square("none"))), ("ray_march", squares[::-1] + squares[:1])]
    matrix = Matrix(tuple("abcd"), lines, "A matrix.", "Colours.", "method", {"#0072B2": "good", "#f0e442": "bad"})
    panels = tuple(
        Panel(f"{name} {EVIL}", (picture(f"{name} drawn", 40 * i), picture(f"{name} error", 40 * i + 9)), "a note")
        for i, name in enumerate(("newton", "ray_march", "_odd#"))
    )
    figure = Figure("figure", drawing(), "a drawing", "Drawn.", "A line and a point.")
    chart = {
        "data": {"values": [{"a": 1, "b": 2}, {"a": 3, "b": 4}]},
        "mark": "point",
        "encoding": {"x": {"field": "a", "type": "quantitative"}, "y": {"field": "b", "type": "quantitative"}},
    }
    charted = Figure("charted", drawing(), "a chart", "Charted.", "", chart)
    summary = Section("Summary", (Text("The answer.", strong=True), Code("firsthit run quick --runs " + "x" * 200)))
    sections = (
        Section(f"Tables {EVIL}", (table, matrix), name="Tables"),
        Section("Drawings", (figure, charted, Gallery(panels, "Pictures."), Gallery(panels[:2], "Two.", across=4))),
        Section("Long", tuple(Text("word " * 120) for _ in range(8)), (table,)),
    )
    marks = style.marks(["newton", "ray_march", "_odd#", "null"])
    return Document(f"A page of {EVIL}", "under it", summary, sections, explorer), marks


@pytest.fixture(scope="module")
def page(made: tuple[Document, dict[str, style.Mark]], tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("page") / "report.html"
    html.write_html(*made, path, {"newton": "Newton"}, bundle.library())
    return path


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Iterator[browser.Browser]:
    if browser.found() is None:
        pytest.skip("no chromium here; install Debian's package chromium to drive the page")
    tab = browser.Browser(tmp_path_factory.mktemp("profile"))
    try:
        yield tab
    finally:
        tab.close()


@pytest.fixture
def tab(opened: browser.Browser, page: Path) -> Iterator[browser.Browser]:
    """Open the page anew, light and 1280 wide; afterwards nothing was complained of, and nothing else was asked for."""
    opened.problems.clear()
    opened.requests.clear()
    opened.look(1280, dark=False)
    opened.open(page)
    yield opened
    assert opened.problems == []
    assert {url for url in opened.requests if not url.startswith("data:")} == {page.as_uri()}


def test_the_page_needs_nothing_beside_it(page: Path) -> None:
    text = re.sub(r"<script.*?</script>", "<script></script>", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert not re.search(r'(?:src|href)="(?!data:|#)[^"]', text)
    assert not re.search(r"@import|url\((?!#)", text)
    ids = re.findall(r'\bid="([^"]+)"', text)
    assert len(ids) == len(set(ids)), "an id is used twice"

    class Balance(HTMLParser):
        opened: list[str] = []  # noqa: RUF012

        def handle_starttag(self, tag: str, _attributes: object) -> None:
            if tag not in ("meta", "link", "img", "input", "use", "path", "rect", "br"):
                self.opened.append(tag)

        def handle_endtag(self, tag: str) -> None:
            if tag not in ("use", "path", "rect"):
                assert self.opened.pop() == tag

    parser = Balance()
    parser.feed(text)
    assert parser.opened == []


def test_the_page_says_what_the_document_says_and_runs_none_of_it(page: Path, made) -> None:
    text = page.read_text(encoding="utf-8")
    for section in (made[0].summary, *made[0].sections):
        assert f"<h2>{html.escaped(section.title)}</h2>" in text
    assert "<b title" not in text
    assert text.count("</script>") == text.count("<script")
    assert not re.search("[\u00ad\u200b-\u200f\u2060\ufeff]", text), "an invisible character"


def test_the_same_document_gives_the_same_page(page: Path, made) -> None:
    assert html.page(*made, {"newton": "Newton"}, bundle.library()) == page.read_text(encoding="utf-8")


def test_a_report_has_the_explorer_and_a_comparison_does_without(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parts, "sections", lambda _: [])  # they take long, and are others' matter
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
    outlines = {(mark.color, charts.outline(mark)) for mark in marks.values()}
    assert len(outlines) == len(set(marks.values()))
    for _, path in outlines:
        assert re.fullmatch(r"(M(-?[01]\.\d\d,-?[01]\.\d\dL?)+Z?)+", path)


def test_pictures_lose_nothing_but_repeated_pixels() -> None:
    png = picture("p", 80).png
    address, width, height = pictures.held(png)
    assert (width, height) == (120, 120)
    small = Image.open(io.BytesIO(base64.b64decode(address.partition(",")[2]))).convert("RGB")
    assert small.size == (20, 20)  # 6 is the largest side up to 8 of squares that 60 × 60 consists of
    assert np.array_equal(np.asarray(small.resize((120, 120), Image.NEAREST)), np.asarray(Image.open(io.BytesIO(png))))


def test_tables_have_captions_and_headings_of_rows(page: Path) -> None:
    tables = re.findall(r"<table><caption>.*?</table>", page.read_text(encoding="utf-8"), re.DOTALL)
    assert [table.count('<th scope="row"') for table in tables] == [6, 2, 6]
    assert all('<th scope="col"' in table for table in tables)


def test_text_on_a_square_is_read_on_any_colour() -> None:
    assert html_tables.on("#000000") == "#ffffff"
    assert html_tables.on("#ffffff") == "#111111"


def test_tables_sort_by_value_and_filter(tab: browser.Browser) -> None:
    table = "document.querySelector('figure.table')"
    rows = f"[...{table}.querySelectorAll('tbody tr')].filter(r => !r.hidden)"
    values = f"{rows}.map(r => Number(r.cells[1].dataset.v))"
    heading = f"{table}.querySelectorAll('.sort')[1]"
    before = tab.run(values)
    assert before != sorted(before)
    tab.click(heading)
    assert tab.run(values) == sorted(before)
    tab.click(heading)
    assert tab.run(values) == sorted(before, reverse=True)
    tab.type(f"{table}.querySelector('.filter')", "row 5")
    assert tab.run(f"{rows}.map(r => r.cells[0].textContent)") == [f"row 5 {EVIL}"]
    assert tab.run(f"{table}.querySelector('.count').textContent") == "1 of 6 rows"


def test_squares_tell_their_notes_to_pointer_and_keys(tab: browser.Browser) -> None:
    squares = "[...document.querySelectorAll('.square')]"
    assert tab.run(f"{TIP}.hidden")
    tab.hover(f"{squares}[1]")
    assert tab.run(f"{TIP}.textContent") == f"note 1 {EVIL}"
    assert tab.run(f"{squares}.filter(s => s.tabIndex === 0).length") == 1
    tab.run(f"{squares}[0].focus()")
    assert tab.run(f"{TIP}.textContent") == f"note 0 {EVIL}"
    for key, told in (("ArrowRight", 1), ("ArrowDown", 1), ("ArrowRight", 0), ("ArrowRight", 0)):
        tab.call("Input.dispatchKeyEvent", type="keyDown", key=key, code=key)
        assert tab.run(f"{TIP}.textContent") == f"note {told} {EVIL}"
    tab.call("Input.dispatchKeyEvent", type="keyDown", key="Escape", code="Escape")
    assert tab.run(f"{TIP}.hidden")


def test_hovering_names_the_variant_of_a_drawing(tab: browser.Browser) -> None:
    marks = f"[...document.querySelectorAll('.series')].find(g => {NAMES}(g).length > 2)"
    names = tab.run(f"{NAMES}({marks})")
    for i, name in enumerate(names[1:]):
        tab.hover(f"{marks}.querySelectorAll('use')[{i}]")
        assert tab.run(f"{TIP}.hidden") is False
        assert tab.run(f"{TIP}.textContent") == name


def test_chips_choose_methods_in_drawings_and_charts(tab: browser.Browser) -> None:
    chip = "[...document.querySelectorAll('.chip')].find(c => c.dataset.method === '%s')"
    faded = f"[...document.querySelectorAll('.faded')].map(g => {NAMES}(g)[0])"
    pale = f"{POINTS}.filter(p => Number(p.getAttribute('opacity')) < 0.5).length"
    tab.run("document.querySelector('#explorer').scrollIntoView()")
    tab.wait(f"{POINTS}.length > 5")
    every = tab.run(f"{POINTS}.length")
    assert tab.run(f"[{faded}.length, {pale}]") == [0, 0]
    tab.click(chip % "newton")
    assert tab.run(f"[...new Set({faded})]") == ["ray_march"]
    tab.wait(f"0 < {pale} && {pale} < {every}")
    alone = tab.run(pale)
    tab.click(chip % "ray_march")
    assert tab.run(f"{faded}.length") == 0
    tab.wait(f"{pale} < {alone}")
    assert tab.run("[...document.querySelectorAll('.chip[aria-pressed=true]')].length") == 2
    tab.click("document.getElementById('everyone')")
    tab.wait(f"{pale} === 0")


def test_the_explorer_follows_its_axes_and_its_rows(tab: browser.Browser) -> None:
    titles = "[...document.querySelectorAll('#explorer .role-axis-title text')].map(t => t.textContent)"
    set_to = (
        "((name, value) => {{const s = document.querySelector(`#explorer select[name=${{name}}]`);"
        "s.value = value; s.dispatchEvent(new Event('change'))}})({!r}, {!r})"
    )
    tab.run("document.querySelector('#explorer').scrollIntoView()")
    tab.wait(f"{titles}.includes('time a frame, ms')")
    assert tab.run(f"{titles}.includes('largest error |t − t*|, scene units')")
    heights = f"{POINTS}.map(p => p.getAttribute('transform'))"
    before = tab.run(heights)
    for name, value, title in (
        ("speed", "rate", "Mrays/s"),
        ("speed", "evaluations", "evaluations a ray"),
        ("error", "p99", "99th percentile error |t − t*|, scene units"),
        ("unit", "pixels", "99th percentile error |t − t*|, pixels"),
    ):
        tab.run(set_to.format(name, value))
        tab.wait(f"{titles}.includes({title!r}) && {POINTS}.length > 0")
        now = tab.run(heights)
        assert now != before
        before = now
    panels = "[...document.querySelectorAll('.panel-chart h3')].map(h => h.textContent)"
    assert len(tab.run(panels)) > 1
    assert f"Torus {EVIL}" in tab.run(panels)
    tab.run(set_to.format("surface", f"Torus {EVIL}"))
    assert tab.run(panels) == [f"Torus {EVIL}"]
    tab.run(set_to.format("device", "opencl:pocl"))
    assert "opencl:pocl" in tab.run("document.querySelector('#explorer select[name=device]').value")


def test_the_explorer_tells_numbers_and_shows_what_is_wrong_or_exact(tab: browser.Browser) -> None:
    tab.run("document.querySelector('#explorer').scrollIntoView()")
    tab.wait(f"{POINTS}.length > 5")
    for _ in range(40):
        tab.hover(f"{POINTS}[0]")
        if told := tab.run(f"{TIP}.hidden ? '' : {TIP}.textContent"):
            break
        time.sleep(0.05)  # a page that was just scrolled hides what it told
    for word in (" ms (", "Mrays/s", "a ray", "pixels", "99th", "wrong rays", "grazing", "device"):
        assert word in told
    assert tab.run(f"{POINTS}.some(p => p.getAttribute('fill') === 'white')"), "no hollow mark for wrong rays"
    ticks = "[...document.querySelectorAll('#explorer .role-axis-label text')].map(t => t.textContent)"
    assert tab.run(f"{ticks}.includes('0')"), "an error of 0 has a place"
    assert tab.run("document.querySelector('#explorer .said').textContent.startsWith('At 0:')")
    tab.click("document.querySelector('#explorer .numbers summary')")
    tab.wait(f"document.querySelectorAll('#explorer .numbers tbody tr').length === {POINTS}.length")


def test_the_explorer_zooms(tab: browser.Browser) -> None:
    tab.run("document.querySelector('#explorer').scrollIntoView()")
    tab.wait(f"{POINTS}.length > 5")
    places = f"{POINTS}.slice(0, 4).map(p => p.getAttribute('transform')).join()"
    before = tab.run(places)
    tab.click("document.querySelector('[data-zoom=\"0.6\"]')")
    tab.wait(f"{POINTS}.length > 5 && {places} !== {before!r}")
    tab.click("document.querySelector('[data-zoom=\"0\"]')")
    tab.wait(f"{POINTS}.length > 5 && {places} === {before!r}")
    x, y = tab.point("document.querySelector('#explorer .chart svg')")
    tab.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-200, modifiers=2)
    tab.wait(f"{places} !== {before!r}")


def test_a_chart_stands_in_for_its_drawing_but_on_paper(tab: browser.Browser) -> None:
    figure = "document.querySelector('figure.drawing:has(.chart)')"
    tab.run(f"{figure}.scrollIntoView()")
    tab.wait(f"{figure}.querySelectorAll('.chart .mark-symbol path').length === 2")
    assert tab.run(f"{figure}.querySelector('.drawn').checkVisibility()") is False
    tab.call("Emulation.setEmulatedMedia", media="print")
    assert tab.run(f"{figure}.querySelector('.drawn').checkVisibility()") is True
    assert tab.run(f"{figure}.querySelector('.chart').checkVisibility()") is False
    tab.call("Emulation.setEmulatedMedia", media="screen")


def test_the_slider_starts_with_two_methods_and_moves_the_edge(tab: browser.Browser) -> None:
    gallery = "document.querySelector('figure.gallery')"
    options = tab.run(f"[...{gallery}.querySelector('.left').options].map(o => o.text)")
    assert len(options) == 6
    chosen = tab.run(f"['left', 'right'].map(s => {gallery}.querySelector(`.${{s}}`).selectedOptions[0].text)")
    assert chosen == [f"newton {EVIL} – error", f"ray_march {EVIL} – error"]
    assert tab.run(f"{gallery}.querySelector('.under').src !== {gallery}.querySelector('.above').src")
    tab.click(f"{gallery}.querySelector('.slider')")
    tab.call("Input.dispatchKeyEvent", type="keyDown", key="Home", code="Home", windowsVirtualKeyCode=36)
    assert "0%" in tab.run(f"{gallery}.querySelector('.above').style.clipPath")
    tab.call("Input.dispatchKeyEvent", type="keyDown", key="End", code="End", windowsVirtualKeyCode=35)
    assert "100%" in tab.run(f"{gallery}.querySelector('.above').style.clipPath")
    select = f"{gallery}.querySelector('.left')"
    tab.run(f"{select}.value = 5, {select}.dispatchEvent(new Event('change'))")
    assert tab.run(
        f"{gallery}.querySelector('.under').src === [...{gallery}.querySelectorAll('.panel img')].at(-1).src"
    )


@pytest.mark.parametrize(("width", "dark"), LOOKS)
def test_every_look_is_readable(tab: browser.Browser, page: Path, width: int, dark: bool) -> None:
    tab.look(width, dark)
    tab.open(page)
    tab.run("document.querySelectorAll('.every').forEach(d => { d.open = true; })")
    tab.run("document.querySelector('#explorer').scrollIntoView()")
    tab.wait(f"{POINTS}.length > 0")
    assert tab.run("document.documentElement.scrollWidth <= document.documentElement.clientWidth"), "scrolls sideways"
    assert tab.run("matchMedia('(prefers-color-scheme: dark)').matches") is dark
    assert tab.run(CONTRAST) == []
    tab.run("document.querySelector('nav details').open = true")
    for i in range(tab.run("document.querySelectorAll('nav a').length")):
        tab.run(f"document.querySelectorAll('nav a')[{i}].click()")
        heading = "document.querySelector(location.hash + ' h2').getBoundingClientRect().top"
        assert tab.run(f"{heading} >= document.getElementById('chips').getBoundingClientRect().bottom")
