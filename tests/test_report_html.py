"""The HTML page of a synthetic run, by itself and in a real browser."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

import pytest

from reports import report
from reports.rendering import html
from tests import browser
from tests.synthetic_run import reported, write_run

_NAMES = "(g => JSON.parse(decodeURIComponent(g.dataset.series)))"  # method and variants of a group of marks


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    run = write_run(tmp_path_factory.mktemp("runs") / "quick")
    return report.build(run).with_name("report.html")


@pytest.fixture(scope="module")
def tab(page: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[browser.Browser]:
    if browser.found() is None:
        pytest.skip("no chromium here; install Debian's package chromium to drive the page")
    opened = browser.Browser(tmp_path_factory.mktemp("profile"))
    try:
        opened.open(page)
        yield opened
    finally:
        opened.close()


def test_the_page_needs_nothing_beside_it(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
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


def test_the_page_says_what_the_pdf_says(page: Path) -> None:
    _, report = reported(page.parent.with_name("quick"))
    text = page.read_text(encoding="utf-8")
    for section in (report.summary, *report.sections):
        assert f"<h2>{html._e(section.title)}</h2>" in text
    assert "use of `$x` @ *p = a_b[#i] &lt;7:3&gt;" in text


def test_tables_sort_by_value_and_filter(tab: browser.Browser) -> None:
    table = "[...document.querySelectorAll('figure.table')].find(f => f.textContent.includes('What wins where'))"
    column = f"[...{table}.querySelectorAll('th[scope=col]')].findIndex(h => h.textContent === 'ms')"
    rows = f"[...{table}.querySelectorAll('tbody tr')].filter(r => !r.hidden)"
    values = f"{rows}.map(r => Number(r.cells[{column}].dataset.v))"
    heading = f"{table}.querySelectorAll('.sort')[{column}]"
    before = tab.run(values)
    assert before != sorted(before)
    tab.click(heading)
    assert tab.run(values) == sorted(before)
    tab.click(heading)
    assert tab.run(values) == sorted(before, reverse=True)
    tab.type(f"{table}.querySelector('.filter')", "torus float64")
    shown = tab.run(f"{rows}.map(r => r.textContent)")
    assert 0 < len(shown) < len(before)
    assert all("Torus" in text and "float64" in text for text in shown)
    assert tab.run(f"{table}.querySelector('.count').textContent") == f"{len(shown)} of {len(before)} rows"


def test_hovering_names_the_variant(tab: browser.Browser) -> None:
    marks = f"[...document.querySelectorAll('.series')].find(g => {_NAMES}(g).length > 2)"
    names = tab.run(f"{_NAMES}({marks})")
    assert len(tab.run(f"[...{marks}.querySelectorAll('use')].map(u => 1)")) == len(names) - 1
    for i, name in enumerate(names[1:]):
        tab.hover(f"{marks}.querySelectorAll('use')[{i}]")
        assert tab.run("document.getElementById('tip').hidden") is False
        assert tab.run("document.getElementById('tip').textContent") == name


def test_clicking_a_method_fades_the_rest(tab: browser.Browser) -> None:
    method = tab.run(f"{_NAMES}(document.querySelector('.series'))[0]")
    chip = f"[...document.querySelectorAll('.chip')].find(c => c.dataset.method === '{method}')"
    faded = "[...document.querySelectorAll('.series')].filter(g => g.classList.contains('faded'))"
    assert tab.run(f"{faded}.length") == 0
    tab.click(chip)
    methods = tab.run(f"{faded}.map(g => {_NAMES}(g)[0])")
    assert methods
    assert method not in methods
    assert tab.run(f"{chip}.getAttribute('aria-pressed')") == "true"
    tab.click(chip)
    assert tab.run(f"{faded}.length") == 0


def test_the_slider_moves_the_edge_between_two_pictures(tab: browser.Browser) -> None:
    gallery = "document.querySelector('figure.gallery')"
    options = tab.run(f"[...{gallery}.querySelector('.left').options].map(o => o.text)")
    assert len(options) == 2 * tab.run(f"{gallery}.querySelectorAll('.panel').length")
    assert tab.run(f"{gallery}.querySelector('.under').src !== {gallery}.querySelector('.above').src")
    tab.click(f"{gallery}.querySelector('.slider')")
    tab.call("Input.dispatchKeyEvent", type="keyDown", key="Home", code="Home", windowsVirtualKeyCode=36)
    assert "0%" in tab.run(f"{gallery}.querySelector('.above').style.clipPath")
    tab.call("Input.dispatchKeyEvent", type="keyDown", key="End", code="End", windowsVirtualKeyCode=35)
    assert "100%" in tab.run(f"{gallery}.querySelector('.above').style.clipPath")
    last = len(options) - 1
    select = f"{gallery}.querySelector('.left')"
    tab.run(f"{select}.value = {last}, {select}.dispatchEvent(new Event('change'))")
    assert tab.run(
        f"{gallery}.querySelector('.under').src === [...{gallery}.querySelectorAll('.panel img')].at(-1).src"
    )


def test_the_console_stays_empty_and_nothing_is_fetched(tab: browser.Browser, page: Path) -> None:
    tab.run("document.body.scrollHeight")
    assert tab.problems == []
    assert {url for url in tab.requests if not url.startswith("data:")} == {page.as_uri()}
