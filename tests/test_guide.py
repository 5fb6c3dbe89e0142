"""The user guide: it is built without a warning, and no link in it or in the project's own pages is dead."""

from __future__ import annotations

import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

ROOT = Path(__file__).parent.parent
OWN = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
LINK = re.compile(r"(?<!`)\[[^\]]*\]\(([^)\s]+)\)")


class Links(HTMLParser):
    """Collect the addresses that a page leads to or shows, and the names that it can be entered by."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.to: list[str] = []
        self.names: set[str] = set()
        self.feed(text)

    def handle_starttag(self, _: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if value and name in ("href", "src"):
                self.to.append(value)
            if value and name == "id":
                self.names.add(value)


@pytest.fixture(scope="module")
def guide(tmp_path_factory):
    pytest.importorskip("sphinx", reason="sphinx is missing: pip install '.[guide]'")
    folder = tmp_path_factory.mktemp("guide")
    command = ("-m", "sphinx", "--fail-on-warning", "--nitpicky", "--quiet", "-d", str(folder / "doctrees"))
    made = folder / "pages"
    done = subprocess.run([sys.executable, *command, "docs", str(made)], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return made


def test_no_link_within_the_guide_is_dead(guide):
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in guide.rglob("*.html")}
    dead = []
    for path, links in pages.items():
        for address in links.to:
            parts = urlsplit(address)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            known = pages.get(target)
            if not target.exists() or (parts.fragment and known and unquote(parts.fragment) not in known.names):
                dead.append(f"{path.name}: {address}")
    assert len(pages) > 15 and not dead


def test_the_guide_needs_no_network(guide):
    loaded = re.compile(r'<(?:script|img|iframe)[^>]*\ssrc="(?:https?:)?//|<link[^>]*\shref="(?:https?:)?//|@import')
    styles = [*guide.rglob("*.html"), *guide.rglob("*.css")]
    assert [path.name for path in styles if loaded.search(path.read_text(encoding="utf-8"))] == []


@pytest.mark.parametrize("page", OWN)
def test_no_link_of_the_projects_own_pages_is_dead(page):
    addresses = [urlsplit(found) for found in LINK.findall((ROOT / page).read_text(encoding="utf-8"))]
    assert [parts.path for parts in addresses if not parts.scheme and not (ROOT / parts.path).exists()] == []


def test_every_page_is_in_the_guides_contents():
    contents = (ROOT / "docs" / "index.md").read_text(encoding="utf-8").splitlines()
    pages = {path.stem for path in (ROOT / "docs").glob("*.md")} - {"index"}
    assert pages <= set(contents)


@pytest.mark.parametrize("page", sorted(ROOT.glob("docs/*.md")), ids=lambda page: page.stem)
def test_what_a_table_says_of_all_its_rows_is_their_sum(page):
    for table in re.findall(r"^\|[-| ]+\|\n((?:\|.*\|\n)+)", page.read_text(encoding="utf-8"), re.M):
        *rows, last = ([cell.strip().replace(",", "") for cell in row.split("|")[1:-1]] for row in table.splitlines())
        for k, cell in enumerate(last):
            if last[0] == "all" and cell.isdigit():
                assert int(cell) == sum(int(row[k]) for row in rows), (page.name, k)
