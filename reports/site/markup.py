"""Write HTML whose texts are escaped unless they are HTML already, and the frame that all pages share."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from harness import escaping
from reports import content, wording

PLACES = (  # what stands in the head of every page
    ("index.html", "Results"),
    ("surfaces.html", "Surfaces"),
    ("methods.html", "Methods"),
    ("runs.html", "Runs"),
    ("data.html", "Data"),
    ("submit.html", "Submit yours"),
)
_EMPTY = {"img", "input", "br", "meta", "link"}


class Html(str):
    """Mark a text as HTML, which `tag` takes as it is."""

    __slots__ = ()


def escaped(child: object) -> str:
    """Return HTML as it is, and anything else as text, escaped; None and False are nothing."""
    if isinstance(child, Html):
        return child
    return "" if child is None or child is False else escaping.html(str(child))


def join(*children: object) -> Html:
    """Write children one behind the other."""
    return Html("".join(map(escaped, children)))


def tag(name: str, /, *children: object, **attributes: object) -> Html:
    """Write an element. An attribute that is None or False is left out, one that is True has no value.

    `class_` writes class, and `data_error` data-error.
    """
    told = "".join(
        f" {key.rstrip('_').replace('_', '-')}" + ("" if value is True else f'="{escaped(value)}"')
        for key, value in attributes.items()
        if value is not None and value is not False
    )
    return Html(f"<{name}{told}>" + ("" if name in _EMPTY else f"{join(*children)}</{name}>"))


def link(to: str, /, *children: object, **attributes: object) -> Html:
    """Write a link."""
    return tag("a", *children, href=to, **attributes)


@dataclass(frozen=True)
class Head:
    """Hold a column's title; `numeric` sets its cells to the right, `note` tells what it is under the pointer."""

    title: str
    numeric: bool = False
    note: str = ""


@dataclass(frozen=True)
class Line:
    """Hold a line of a table: its cells, the first of which is its heading."""

    cells: Sequence[object]
    id: str | None = None
    kind: str | None = None  # a class


def table(caption: object, heads: Sequence[Head], lines: Sequence[Line], name: str | None = None) -> Html:
    """Write a table with a caption, column and row headers; a narrow window shows each line as a card.

    The roles keep it a table for screen readers where cards change how it is laid out.
    """
    top = tag("tr", *(_heading(head) for head in heads), role="row")
    body = (tag("tr", *_cells(heads, line.cells), id=line.id, class_=line.kind, role="row") for line in lines)
    return tag(
        "table",
        tag("caption", caption),
        tag("thead", top, role="rowgroup"),
        tag("tbody", *body, role="rowgroup"),
        id=name,
        role="table",
        class_="cards",
    )


def _heading(head: Head) -> Html:
    kind = "n" if head.numeric else None
    return tag("th", head.title, scope="col", role="columnheader", class_=kind, title=head.note or None)


def _cells(heads: Sequence[Head], cells: Sequence[object]) -> list[Html]:
    """Write the cells of a line, the first as its heading; each knows its column's title for the card."""
    made = [tag("th", cells[0], scope="row", role="rowheader")]
    for head, cell in zip(heads[1:], cells[1:], strict=True):
        made.append(tag("td", cell, role="cell", class_="n" if head.numeric else None, data_of=head.title))
    return made


def of_content(told: content.Table) -> Html:
    """Write a report's table."""
    heads = [Head(" ".join(filter(None, (c.over, c.title.replace("\n", " ")))), c.numeric) for c in told.columns]
    lines = [Line([c.show(v) for c, v in zip(told.columns, row, strict=True)]) for row in told.rows]
    return table(join(tag("b", told.title), " ", told.caption), heads, lines)


def code(text: str) -> Html:
    """Write a text to copy."""
    return tag("pre", tag("code", text), tabindex="0")


def folded(title: object, *body: object, opened: bool = False) -> Html:
    """Write what only some look up, under a heading to open."""
    return tag("details", tag("summary", title), *body, open=opened)


def paragraphs(text: str) -> Html:
    """Write a method's text: each line is a paragraph or, where it begins with "- ", a point of a list."""
    made: list[Html] = []
    points: list[Html] = []
    for line in [*text.split("\n"), ""]:
        if line.startswith("- "):
            points.append(tag("li", line[2:]))
            continue
        if points:
            made.append(tag("ul", *points))
            points = []
        if line.strip():
            made.append(tag("p", line))
    return join(*made)


def slug(name: str, taken: set[str]) -> str:
    """Make a name for a file of `name` that no other has, also where capitals do not count, and note it in `taken`."""
    plain = re.sub(r"[^A-Za-z0-9.-]+", "-", name).strip("-.")[:60] or "unnamed"
    found, count = plain, 1
    while found.lower() in taken:
        count += 1
        found = f"{plain}-{count}"
    taken.add(found.lower())
    return found


@dataclass(frozen=True)
class Frame:
    """Hold what all pages of a site share."""

    title: str

    def page(self, path: str, title: str, *body: object, data: Mapping[str, Any] | None = None) -> str:
        """Write the page at `path`, a path below the site's folder; `data` is for the site's script."""
        up = "../" * path.count("/")
        here = path.rpartition("/")[0]
        links = [tag("a", name, href=up + at, aria_current=_current(path, here, at)) for at, name in PLACES]
        told = None if data is None else Html(escaping.data("cells", data))
        head = tag(
            "head",
            tag("meta", charset="utf-8"),
            tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
            tag("meta", name="color-scheme", content="light dark"),
            tag("title", f"{title} · {self.title}" if title != self.title else title),
            tag("link", rel="icon", href="data:,"),
            tag("link", rel="stylesheet", href=f"{up}site.css"),
            tag("script", src=f"{up}site.js", defer=True) if data is not None else None,
        )
        banner = tag(
            "header",
            tag("a", "Skip to the content", href="#main", class_="skip"),
            tag("a", self.title, href=f"{up}index.html", class_="name"),
            tag("nav", *links, aria_label="Site"),
        )
        main = tag("main", tag("h1", title), *body, told, id="main")
        return "<!DOCTYPE html>\n" + tag("html", head, tag("body", banner, main), lang="en") + "\n"


def _current(path: str, here: str, at: str) -> str | None:
    """Say whether the link `at` is to this page, or to the list that this page belongs to."""
    return "page" if path == at else "true" if here and at == f"{here}.html" else None


def day(text: object) -> Html:
    """Return the day of an ISO 8601 time; a dash where there is none."""
    return tag("time", wording.NONE if wording.absent(text) else str(text)[:10])
