"""What is drawn of kept runs: the page, by itself and in a real browser, and the pictures."""

import re
from html.parser import HTMLParser

import numpy as np
import pytest

from harness.gate.judge import tolerances_of
from reports.history import draw
from reports.history.page import LISTED
from tests import browser

from .kept_runs import SLOT, commit, kept, row

RULES = tolerances_of({})
LONG = "_and_no_place_to_break" * 5


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """The folder of a drawn history: six commits, two rows, three devices' worth of trouble in the texts."""
    told = draw.Told(f"tiny{LONG}", RULES, {"misses": "clear rays & more"}, ["A <note>."], ["x.json is damaged"])
    rows = [{SLOT: row(misses=m, error_max=e), f"a <b> & c{LONG}": row(misses=0)} for m, e in _PLANTED]
    all_runs = [kept(i, one) for i, one in enumerate(rows)]
    object.__setattr__(all_runs[3].commit, "subject", '<script>alert("x")</script> & é')
    all_runs.append(kept(4, {SLOT: row(misses=9)}, dirty=True))
    folder = tmp_path_factory.mktemp("drawn") / "history"
    steps = draw.build(all_runs, None, told, folder)
    assert len(steps) == 3
    return folder


_PLANTED = [(0, 1e-6), (0, 1.01e-6), (0, 1.01e-6), (4, 1.01e-6), (4, 5e-6), (1, 5e-6)]


class _Page(HTMLParser):
    """Note every id and link, what is open at the end, and the titles of drawings."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.opened, self.titles = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        told = dict(attributes)
        self.ids += [told["id"]] if "id" in told else []
        self.links += [told["href"]] if tag == "a" else []
        if tag not in ("meta", "link"):
            self.opened.append(tag)

    def handle_startendtag(self, tag, _attributes):
        assert tag in ("path", "line"), tag

    def handle_endtag(self, tag):
        assert self.opened.pop() == tag

    def handle_data(self, data):
        if self.opened and self.opened[-1] == "title":
            self.titles.append(data)


def test_the_page_is_whole_and_needs_nothing_beside_it(drawn):
    text = (drawn / "index.html").read_text(encoding="utf-8")
    page = _Page(text)
    assert page.opened == []
    assert len(page.ids) == len(set(page.ids))
    assert not re.search(r'(?:src|href)="(?!data:|#|\w+\.png")', text)
    assert not re.search(r"@import|url\(|<script", text)
    for link in page.links:
        assert link[1:] in page.ids if link.startswith("#") else (drawn / link).is_file()
    assert "x.json is damaged" in text
    assert "A &lt;note&gt;." in text


def test_the_page_lists_steps_with_their_commits_and_links_to_their_graphs(drawn):
    text = (drawn / "index.html").read_text(encoding="utf-8")
    items = re.findall(r'<li id="s\d+">(.*?)</li>', text)
    plain = [re.sub("<[^>]+>", "", item) for item in items]
    assert [p.split(" at commit")[0] for p in plain] == [
        f"misses of {SLOT}: 0 → 4",
        f"error_max of {SLOT}: 1.01e-06 → 5e-06",
        f"misses of {SLOT}: 4 → 1",
    ]
    assert "&lt;script&gt;alert" in plain[0]
    assert commit(3).hash[:8] in plain[0]
    assert f"last kept before: {commit(2).hash[:8]}" in plain[0]
    for item, figure in zip(items, ("misses", "error_max", "misses"), strict=True):
        graph = re.search('href="#(g[0-9]+)"', item)[1]
        section = text[: text.index(f'<figure id="{graph}"')]
        assert re.findall('<h2 id="([a-z_]+)"', section)[-1] == figure


def test_every_number_stands_on_the_drawing_and_in_the_table(drawn):
    text = (drawn / "index.html").read_text(encoding="utf-8")
    titles = _Page(text).titles
    h = [commit(i).hash[:8] for i in range(6)]
    assert f"0: 3 commits, {h[0]} 2026-03-01 to {h[2]} 2026-03-03" in titles
    assert f"1.01e-06: 3 commits, {h[1]} 2026-03-02 to {h[3]} 2026-03-04" in titles
    assert f"9: {h[4]} 2026-03-05, with uncommitted changes" in titles
    assert f"0: 6 commits, {h[0]} 2026-03-01 to {h[5]} 2026-03-06" in titles, "the row that never changes"
    for value in ("1e-06", "1.01e-06", "5e-06", "0", "4", "1", "9"):
        assert f'<td class="n">{value}</td>' in text


def test_there_is_a_picture_for_each_figure_with_the_steps_marked(drawn):
    from PIL import Image

    assert {path.name for path in drawn.iterdir()} == {"index.html", "misses.png", "error_max.png"}
    for name, worse, better in (("misses", True, True), ("error_max", True, False)):
        pixels = np.asarray(Image.open(drawn / f"{name}.png").convert("RGB")).astype(int)

        def near(color, pixels=pixels):
            return (np.abs(pixels - color).max(axis=-1) < 12).sum() > 10

        assert near((0xB3, 0x41, 0x00)) == worse
        assert near((0x00, 0x70, 0x4F)) == better
        assert near((0x00, 0x67, 0xA0))


def test_a_history_of_many_changes_lists_some_and_says_how_many_more(tmp_path):
    rows = [{f"row {i:02}": row(misses=(i + n) % 7) for i in range(60)} for n in range(30)]
    steps = draw.build([kept(n, one) for n, one in enumerate(rows)], None, draw.Told("t", RULES, {}), tmp_path)
    text = (tmp_path / "index.html").read_text()
    assert len(steps) == 60 * 29
    assert f"<summary>{1000 - LISTED} more</summary>" in text
    assert "740 smaller ones are marked in the graphs alone." in text
    page = _Page(text)
    assert page.opened == []
    assert {link[1:] for link in page.links if link.startswith("#")} <= set(page.ids)
    assert len(text) < 1_200_000


def test_a_figure_that_crept_is_listed_with_the_commit_since_which_it_did(tmp_path):
    for growth, steps in ((1.04, 1), (1.0005, 0)):
        all_runs = [kept(i, {SLOT: row(error_max=1e-6 * growth**i)}) for i in range(20)]
        assert len(draw.build(all_runs, None, draw.Told("t", RULES, {}), tmp_path)) == steps
        text = (tmp_path / "index.html").read_text(encoding="utf-8")
        assert ("No figure has changed beyond its tolerance" in text) == (steps == 0)
        assert (f"crept in smaller changes since {commit(0).hash[:8]}" in text) == (steps == 1)
        assert text.count('<a href="#s0" class="mark worse">') == steps


@pytest.fixture(scope="module")
def tab(drawn, tmp_path_factory):
    with browser.opened(tmp_path_factory.mktemp("profile")) as opened:
        opened.open(drawn / "index.html")
        yield opened


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_fits_a_telephone_and_a_screen_by_day_and_by_night(tab, width, scheme):
    tab.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width < 500)
    tab.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
    tab.run("document.querySelectorAll('details').forEach(d => d.open = true)")
    assert tab.run("document.documentElement.scrollWidth") <= width
    paper = [int(c) for c in re.findall(r"\d+", tab.run("getComputedStyle(document.body).backgroundColor"))][:3]
    ink = [int(c) for c in re.findall(r"\d+", tab.run("getComputedStyle(document.body).color"))][:3]
    assert (sum(paper) > sum(ink)) == (scheme == "light")
    smallest = tab.run(
        "Math.min(...[...document.querySelectorAll('figure')].map(f => f.getBoundingClientRect().width))"
    )
    assert smallest >= 290


def test_every_step_and_table_is_reached_by_the_keyboard(tab):
    reached = []
    tab.run("document.activeElement.blur(), window.scrollTo(0, 0)")
    for _ in range(60):
        tab.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", code="Tab", windowsVirtualKeyCode=9)
        reached.append(tab.run("(e => e.getAttribute('href') || e.textContent)(document.activeElement)"))
    assert {"#misses", "#g0", "#g1", "#s0", "#s1", "#s2", "misses.png", "numbers"} <= set(reached)


def test_a_step_leads_to_its_graph_and_back_and_nothing_is_fetched(tab, drawn):
    tab.run("document.querySelectorAll('details').forEach(d => d.open = false)")
    tab.click("document.querySelector('#s0 a')")
    assert tab.run("document.querySelector('figure:target').id") == tab.run("location.hash").lstrip("#")
    tab.click("document.querySelector('figure:target summary')")
    assert "with uncommitted changes" in tab.run("document.querySelector('figure:target').innerText")
    assert tab.problems == []
    assert {url.partition("#")[0] for url in tab.requests if not url.startswith("data:")} == {
        (drawn / "index.html").as_uri()
    }
