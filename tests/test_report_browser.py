"""The HTML page in a real browser: light and dark, on a phone and on a desk."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from reports.rendering import bundle, html
from tests import browser
from tests.html_content import SHOWN, made
from tests.synthetic_run import write_run

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


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("page")
    html.write_html(*made(write_run(folder / "quick")), folder / "page.html", {"newton": "Newton"}, bundle.library())
    return folder / "page.html"


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Iterator[browser.Browser]:
    with browser.opened(tmp_path_factory.mktemp("profile")) as tab:
        yield tab


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
    tab.click(f"{table}.querySelectorAll('.sort')[2]")
    assert tab.run(f"{rows}.map(r => r.cells[2].textContent)") == ["9", "9", "80", "80", "1,000", "1,000"]
    tab.type(f"{table}.querySelector('.filter')", "row 5")
    assert tab.run(f"{rows}.map(r => r.cells[0].textContent)") == [f"row 5 {SHOWN}"]
    assert tab.run(f"{table}.querySelector('.count').textContent") == "1 of 6 rows"


def test_squares_tell_their_notes_to_pointer_and_keys(tab: browser.Browser) -> None:
    squares = "[...document.querySelectorAll('.square')]"
    assert tab.run(f"{TIP}.hidden")
    tab.hover(f"{squares}[1]")
    assert tab.run(f"{TIP}.textContent") == f"note 1 {SHOWN}"
    assert tab.run(f"{squares}.filter(s => s.tabIndex === 0).length") == 1
    tab.run(f"{squares}[0].focus()")
    assert tab.run(f"{TIP}.textContent") == f"note 0 {SHOWN}"
    for key, told in (("ArrowRight", 1), ("ArrowDown", 1), ("ArrowRight", 0), ("ArrowRight", 0)):
        tab.call("Input.dispatchKeyEvent", type="keyDown", key=key, code=key)
        assert tab.run(f"{TIP}.textContent") == f"note {told} {SHOWN}"
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
    assert f"Torus {SHOWN}" in tab.run(panels)
    tab.run(set_to.format("surface", f"Torus {SHOWN}"))
    assert tab.run(panels) == [f"Torus {SHOWN}"]
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


def test_without_scripts_there_is_nothing_that_needs_them(tab: browser.Browser, page: Path) -> None:
    tab.call("Emulation.setScriptExecutionDisabled", value=True)
    tab.open(page)
    tab.call("Emulation.setScriptExecutionDisabled", value=False)
    shown = "[...document.querySelectorAll('%s')].filter(e => e.checkVisibility()).length"
    assert [tab.run(shown % name) for name in ("input, select, .sort, .chip, .sliding", "#explore noscript")] == [0, 1]
    assert tab.run(shown % "main td") > 0


def test_paper_has_the_drawings_and_not_the_explorer(tab: browser.Browser) -> None:
    tab.call("Emulation.setEmulatedMedia", media="print")
    shown = "document.querySelector('%s').checkVisibility()"
    names = ("figure.drawing svg", "#explore", "#chips")
    assert [tab.run(shown % name) for name in names] == [True, False, False]
    tab.call("Emulation.setEmulatedMedia", media="screen")


def test_the_slider_starts_with_two_methods_and_moves_the_edge(tab: browser.Browser) -> None:
    gallery = "document.querySelector('figure.gallery')"
    options = tab.run(f"[...{gallery}.querySelector('.left').options].map(o => o.text)")
    assert len(options) == 6
    chosen = tab.run(f"['left', 'right'].map(s => {gallery}.querySelector(`.${{s}}`).selectedOptions[0].text)")
    assert chosen == [f"newton, 2 {SHOWN} – error", f"_odd# {SHOWN} – error"]
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
