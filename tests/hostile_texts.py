"""Make up hostile texts, and read outputs as those read them who would obey what they find there."""

from __future__ import annotations

import json
import random
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from markdown_it import MarkdownIt

from reports.for_papers import latex
from surfaces.visible import hidden
from tests.campaigns.frame import Fell

PAYLOADS = (  # for each place what would be obeyed there
    "a\n::error file=x::y",
    "\r::set-output name=a::b",
    "\x0b::add-mask::a",
    "\u2028::warning::x",
    "\x85::stop-commands::t",
    "  ::group::x",
    "##[error]x",
    "##vso[task.setvariable variable=a]b",
    "##teamcity[buildStop comment='x']",
    "%0A::error::x",
    "section_start:1:x\r\x1b[0K",
    "\x1b[2J\x1b[1;1H",
    "\x1b]0;title\x07",
    "\x9b31m",
    "\u202egnp.exe",
    "\u2066a\u2069",
    "a\u200bb\ufeff",
    "\U000e0041\U000e0042",
    "a\ufe0f\u034f\u3164",
    "\x00\x01\x08\x7f",
    "\ud800x",
    "\udcff",
    "\\x1b[31m \\u202e",
    "| a | b |",
    "|\n| --- |",
    "**b** __i__ _i_ *i* ~~s~~ `c` ``d",
    "[a](javascript:alert(1))",
    "![a](http://x/y.png)",
    "<https://a.b> https://a.b www.a.b",
    "$x$ $$y$$",
    "# h\n## i",
    "```\nx\n````",
    "&lt;b&gt; &#x1b; &amp",
    "a\\",
    "- x\n1. y\n> z",
    "<script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "' onmouseover='alert(1)",
    "</script><script>alert(1)</script>",
    "<!--<script>",
    "-->",
    "]]>",
    "<![CDATA[x]]>",
    "</title></style></textarea><svg onload=x>",
    "javascript:alert(1)",
    "{{constructor.constructor('alert(1)')()}}",
    "&entity; <!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/passwd'>]>",
    '#eval("1") #read("/etc/passwd") #import "x"',
    "#set page(width: 1pt)",
    "$ x^2 $ @label <label> `raw` *b* _i_ = h",
    "\\input{/etc/passwd} \\write18{id}",
    "% comment\n}{\\end{document}",
    "--- ?` !` ,, '' << ^^M ~",
    "=1+1",
    "+cmd|' /C calc'!A0",
    "@SUM(1)",
    "-2+3",
    "'=1",
    "\t=1",
    "a,b;c\"d'\r\ne",
    "$(id) `id` ${HOME} !! ; rm -rf x | y > z & a*b?",
    "'; id; '",
    '"""\nformula = "x"',
    "../../etc/passwd",
    "CON.html",
    "$\\frac$ $\\foo{",
    "a" * 3000,
    "",
    "   ",
    "x ##",
)
_RANGES = ((0, 0x20), (0x20, 0x7F), (0x7F, 0x250), (0x2000, 0x2070), (0xD800, 0xE000), (0xFE00, 0x10000), (0, 0x110000))


def text(dice: random.Random) -> str:
    """Make a hostile text: a payload, several of them, or signs of any kind. No two halves in it make one character."""
    return re.sub("([\ud800-\udbff])(?=[\udc00-\udfff])", "x", _text(dice))


def _text(dice: random.Random) -> str:
    kind = dice.random()
    if kind < 0.4:
        return dice.choice(PAYLOADS)
    if kind < 0.6:
        return dice.choice(("", " ", "\n", "x")).join(dice.choices(PAYLOADS[:-4], k=dice.randint(2, 4)))
    letters = "".join(chr(dice.randrange(*dice.choice(_RANGES))) for _ in range(dice.randint(1, 24)))
    return letters if kind < 0.8 else letters + dice.choice(PAYLOADS) + letters


def commands(output: str) -> list[str]:
    """Return the lines of an output that a CI server would take for commands, or that hold what moves a cursor.

    GitHub ends lines at CR and LF and trims them before it looks for `::`; it looks for `##[` anywhere in a line.
    """
    lines = re.split(r"\r\n|[\r\n]", output)
    return [line for line in lines if line.strip().startswith("::") or re.search(r"##\w*\[", line) or _moves(line)]


def _moves(line: str) -> bool:
    return any(c != "\t" and not c.isprintable() and not c.isspace() for c in line) or any(
        c in line for c in "\x0b\x0c\x1c\x1d\x1e\x85\u2028\u2029"
    )


def command(line: str) -> tuple[str, dict[str, str], str]:
    """Read a workflow command of GitHub by its runner's rules: its name, its properties and its message."""
    if re.search(r"[\r\n]", line) or not line.startswith("::"):
        raise Fell(f"no command: {line!r}")
    head, message = line[2:].split("::", 1)
    name, _, told = head.partition(" ")
    pairs = (part.split("=", 1) for part in told.split(",") if "=" in part)
    return name, {key: _unescaped(value, ":,") for key, value in pairs}, _unescaped(message, "")


def _unescaped(text: str, more: str) -> str:
    for sign in "\r\n" + more:
        text = text.replace(f"%{ord(sign):02X}", sign)
    return text.replace("%25", "%")


class Page(HTMLParser):
    """Read a page of HTML: its elements with their attributes, its texts, and what its scripts hold."""

    def __init__(self, page: str) -> None:
        super().__init__(convert_charrefs=True)
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.texts: list[str] = []
        self.scripts: list[str] = []
        self.comments: list[str] = []
        self._script = False
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        self._script = tag == "script"

    def handle_endtag(self, _tag: str) -> None:
        self._script = False

    def handle_data(self, data: str) -> None:
        (self.scripts if self._script else self.texts).append(data)

    def handle_comment(self, data: str) -> None:
        self.comments.append(data)

    def said(self) -> str:
        """Return all texts, attributes and data of scripts."""
        told = [value or "" for _, attributes in self.elements for value in attributes.values()]
        return "\n".join([*self.texts, *told, *self.scripts])


OURS = """
    a alt aria-current aria-hidden aria-label aria-pressed autocomplete b body button caption charset circle class
    clip-path clip-rule clippath code colspan content cx cy d data-columns data-error data-kind data-level
    data-method data-methods data-of data-series data-title data-v data-won data-zoom dd decoding defer defs details
    div dl download dt figcaption figure fill fill-rule form g h1 h2 h3 h4 head header height hidden href html i id
    img label lang li line link main meta name nav noscript ol open opacity option p path pattern patternunits
    points polygon polyline pre r rect rel role rowspan scope script section select small span src stroke
    stroke-width strong style summary svg tabindex table tbody td text text-anchor th thead time title tr transform
    type ul use value version viewbox width x x1 x2 xlink:href xmlns xmlns:xlink y y1 y2
"""  # the elements and attributes of our pages
_OURS = frozenset(OURS.split())


def harmless_page(page: Page) -> None:
    """Raise Fell where a page has an element or an attribute that is none of OURS, a link to a script or a comment."""
    for tag, attributes in page.elements:
        for name, value in {tag: "", **attributes}.items():
            if name not in _OURS:
                raise Fell(f"<{tag} {name}={value!r}> is none of ours")
            if name in ("href", "src") and not re.match(
                r"data:|mailto:|#|(\.\./)?[a-z./]+[a-zA-Z0-9.#/_-]*$", value or ""
            ):
                raise Fell(f"a link to {value!r}")
            if name in ("href", "src") and (value in ("x", "") or re.match(r"(java|vb)?script:", value or "", re.I)):
                raise Fell(f"a link to {value!r}")
    if page.comments:
        raise Fell(f"a comment {page.comments[0]!r}")


_READER = MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"])


def read_markdown(told: str) -> tuple[list[str], list[list[str]]]:
    """Read Markdown as GitHub does: the types of its blocks, and the texts of what stands in each line of it.

    Raises Fell where a line holds markup other than code.
    """
    kinds: list[str] = []
    found: list[list[str]] = []
    for token in _READER.parse(told):
        kinds.append(token.type)
        if token.type in ("fence", "html_block", "code_block"):
            found.append([token.content])
        if token.type == "inline":
            for child in token.children or []:
                if child.type not in ("text", "code_inline", "softbreak", "hardbreak", "text_special"):
                    raise Fell(f"{child.type} of {token.content!r}")
            found.append(["".join(c.content if "break" not in c.type else "\n" for c in token.children or [])])
    return kinds, found


_TEX = {made: sign for sign, made in {**latex._SPECIAL, **{s: f"${m}$" for s, m in latex._MATH.items()}}.items()}
_TEX_TOKEN = re.compile(
    "|".join(map(re.escape, sorted(_TEX, key=len, reverse=True))) + r"|\{\}|\$[\^_]\{[-0-9nk]*\}\$|.", re.S
)


def read_latex(made: str) -> str:
    """Read what LaTeX prints of a text. Raises Fell where it holds a sign that means something to LaTeX."""
    told = []
    for found in _TEX_TOKEN.findall(made):
        if found in _TEX:
            told.append(_TEX[found])
        elif found.startswith(("$^{", "$_{")):
            told.append(found[3:-2])
        elif found != "{}":
            if found in "\\{}$&#%_^~\n\r":
                raise Fell(f"{found!r} is bare in {made!r}")
            told.append(found)
    return "".join(told)


_LIKE = str.maketrans("’‘⁻⁰¹²³⁴⁵⁶⁷⁸⁹ⁿᵏ₋₀₁₂₃₄₅₆₇₈₉ₙ√✓μ−", "'`-0123456789nk-0123456789n√√µ-")


def typeset(text: str) -> str:
    """Return a text in which signs that print alike are one, and blanks of any width are."""
    return re.sub(r"[^\S\u00a0]", " ", text.translate(_LIKE).replace("“", "``").replace("”", "''"))


def read_xml(document: str) -> ElementTree.Element:
    """Read XML. Raises Fell where it is none."""
    try:
        return ElementTree.fromstring(document)
    except ElementTree.ParseError as error:
        raise Fell(f"no XML: {error}") from None


def put(value: Any, dice: random.Random, share: float, kept: frozenset[str], told: list[str], path: str = "") -> Any:
    """Return a JSON value, of whose texts about a share is replaced by hostile ones, which `told` gets.

    Texts below the names `kept` stay, since they are words of ours: a status, a key.
    """
    if isinstance(value, str):
        if dice.random() >= share:
            return value
        told.append(text(dice))
        return told[-1]
    if isinstance(value, dict):
        return {k: v if k in kept else put(v, dice, share, kept, told, k) for k, v in value.items()}
    return [put(item, dice, share, kept, told, path) for item in value] if isinstance(value, list) else value


def same(shown: str, wanted: str, where: str) -> None:
    """Raise Fell unless what is shown reads back as the text that is wanted."""
    if hidden(shown) != wanted:
        raise Fell(f"{where}: {shown[:300]!r} is not {wanted[:300]!r}")


def write(path: Path, value: Any) -> None:
    """Write JSON as a run folder holds it."""
    path.write_text(json.dumps(value), encoding="ascii")
