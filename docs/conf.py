"""Build the user guide with sphinx: `make guide` writes build/guide/. Nothing is fetched, and it works from file://."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
PAGES = {"CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md", "README.md": "index.md"}

project = "firsthit"
author = "the firsthit developers"
extensions = ["myst_parser"]
myst_heading_anchors = 3
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]  # what a command prints is no program
exclude_patterns = ["conf.py"]
html_theme = "furo"
html_title = "firsthit"
html_show_sphinx = False
html_copy_source = False
html_theme_options = {"top_of_page_buttons": []}

_OUTSIDE = re.compile(r"\[([^\]]*)\]\(\.\./([^)#\s]+)((?:#[^)\s]*)?)\)")


def _read(_: Any, page: str, source: list[str]) -> None:
    """Fill the pages of the project's own files, and turn links that leave docs/ into what the guide has of them."""
    whole = next((name for name, own in PAGES.items() if own == f"{page}.md" and page != "index"), None)
    if whole:
        source[0] = (ROOT / whole).read_text(encoding="utf-8").replace("](docs/", "](")
    source[0] = _OUTSIDE.sub(_linked, source[0])


def _linked(found: re.Match[str]) -> str:
    """Return a link to one of PAGES; of any other file of the project, its name."""
    text, name, anchor = found.groups()
    if name in PAGES:
        return f"[{text}]({PAGES[name]}{anchor})"
    return f"`{name}`" if text == name else f"{text} (`{name}`)"


def setup(app: Any) -> None:
    """Tell sphinx what pages are read through."""
    app.connect("source-read", _read)
