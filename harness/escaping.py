r"""Make a text safe for the place where it goes: nothing in it becomes markup, code, a command or an invisible sign.

Texts come from configs, files of surfaces, plugins, drivers, git and run folders of anybody. Each function here is of
one place. All of them first show what cannot be seen, which is surfaces.visible's work: control characters, line ends
that are none of the place's own, marks that turn the direction of writing or have no width, halves of characters. So a
text reads back wherever it stands, and looks alike everywhere.

    terminal          visible (a name), one_line (prose in a table), lines (prose that has lines), output (of processes)
    CI servers        message, property_ (workflow commands of GitHub), xml, attribute (JUnit)
    Markdown          markdown (within a line), code (within a line), fenced (lines)
    HTML              html (between tags and between quotes), in_script, data (JSON within a page)
    drawings          shown (SVG; matplotlib is told to read no mathematics, reports.drawing.canvas.RC)
    typst             every (the template reads texts as JSON, and never as markup)
    tables            cell (CSV)
    commands          shell (a command that is printed to be pasted)

LaTeX's escapes are in reports.for_papers.latex, where they are a part of how numbers and signs are set. File names and
anchors consist of ASCII letters, digits and hyphens alone (`slug` of reports.for_papers.model and
reports.site.markup), and Vega-Lite takes texts as data, which `in_script` writes.

Of an output's own lines none begins a command of a CI server: `lines` writes the first sign of `::` at a line's
beginning, and of `##[` and `##word[` anywhere, as an escape, wherever the command runs. It does so always, since what a
command prints is often printed again by another program, and one rule can be tested.
"""

from __future__ import annotations

import html as python_html
import json
import re
import shlex
from collections.abc import Iterable, Mapping
from typing import Any

from surfaces.visible import hidden as hidden
from surfaces.visible import joined as joined
from surfaces.visible import one_line as one_line
from surfaces.visible import shown as shown
from surfaces.visible import visible as visible

_COMMAND = re.compile(r"^(\s*):(?=:)|#(?=#\w*\[)", re.MULTILINE)
_SIGNS = re.compile(r"[\\`*\[\]<&|~$#]|(?<![^\W_])_|_(?![^\W_])|(?<=\w):(?=//)|(?<=www)\.", re.IGNORECASE)
_QUOTED = "\\'#"
_ENTITIES = {"&": "&amp;", "<": "&lt;"}
_FORMULA = re.compile(r"'*[=+\-@＝＋－＠]")  # wide ones too, which spreadsheets of East Asia take


def lines(text: str) -> str:
    """Return prose of several lines for a terminal or a CI server's log: its lines stay, and none begins a command."""
    return harmless(visible(text.replace("\r\n", "\n"), "\n\t"))


def harmless(text: str) -> str:
    """Return lines of an output, of which none begins a command of a CI server, and what cannot be seen is shown.

    Backslashes stay: what was made visible before stays as it is. It is what every line passes that a command prints.
    """
    text = shown(text)
    return _COMMAND.sub(_defused, text) if ":" in text or "##" in text else text


def _defused(found: re.Match[str]) -> str:
    return r"\x23" if found[0] == "#" else rf"{found[1]}\x3a"


def output(line: bytes) -> bytes:
    """Return a line that another process wrote, a driver's or a plugin's, as `lines` has it, with its end."""
    text = line.decode("utf-8", "backslashreplace")
    return f"{lines(text.removesuffix(chr(10)).removesuffix(chr(13)))}\n".encode()


def message(text: str) -> str:
    """Escape a text for the message of a workflow command of GitHub; its lines stay."""
    return _percented(visible(text.replace("\r\n", "\n"), "\n"))


def property_(text: str) -> str:
    """Escape a text for a property of a workflow command of GitHub."""
    return _percented(visible(text)).replace(":", "%3A").replace(",", "%2C")


def _percented(text: str) -> str:
    return text.replace("%", "%25").replace("\n", "%0A")


def xml(text: str) -> str:
    """Escape a text for XML, between tags: its lines stay, and what XML cannot hold is shown."""
    return python_html.escape(visible(text, "\n\t"), quote=False)


def attribute(text: str) -> str:
    """Return a text as an attribute of XML, in quotes."""
    return f'"{python_html.escape(visible(text))}"'


def html(text: str) -> str:
    """Escape a text for HTML, between tags or between quotes; its line ends stay."""
    return python_html.escape(visible(text, "\n\t"), quote=True)


def in_script(value: Any) -> str:
    """Write a value as JSON that can stand between script tags, whatever its texts are; it has ASCII letters alone.

    Its texts are those that `html` writes, so that a script finds a name of the page in its data. Raises ValueError
    where a number is not finite.
    """
    text = json.dumps(every(value), allow_nan=False, separators=(",", ":"))
    for letter in "<>&":
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return text


def data(name: str, value: Any) -> str:
    """Return a script element with the id `name` that holds `value` as JSON, for the page's scripts to read."""
    return f'<script type="application/json" id="{html(name)}">{in_script(value)}</script>'


def markdown(text: str) -> str:
    """Escape a text for a line of Markdown, or for a cell of a table, where no line begins with it.

    The signs of emphasis, code, links, images, tables, mathematics, HTML and headings print as themselves; so do
    addresses, which are no links then. What a site makes of names behind @ and of numbers behind # is left to it.
    """
    return _SIGNS.sub(lambda found: _ENTITIES.get(found[0], f"\\{found[0]}"), one_line(text))


def code(text: str) -> str:
    """Return a text as code within a line of Markdown, whatever backticks it has; outside of tables."""
    seen = one_line(text)
    ticks = "`" * (1 + max((len(run) for run in re.findall("`+", seen)), default=0))
    padded = "`" in seen or seen != seen.strip(" ")  # a blank on either side is not read
    space = " " if (padded and seen.strip(" ")) or not seen else ""
    return f"{ticks}{space}{seen}{space}{ticks}"


def fenced(text: str) -> str:
    """Return lines as a block of code in Markdown, whatever backticks they have."""
    seen = visible(text.replace("\r\n", "\n"), "\n\t")
    fence = "`" * max(3, 1 + max((len(run) for run in re.findall("`+", seen)), default=0))
    return f"{fence}\n{seen}\n{fence}"


def every(value: Any) -> Any:
    """Return a JSON value whose texts, names of members too, are visible; their lines stay."""
    if isinstance(value, str):
        return visible(value, "\n\t")
    if isinstance(value, Mapping):
        return {every(key): every(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [item if type(item) in (int, float) else every(item) for item in value]
    return value


def cell(text: str) -> str:
    """Return a text for a cell of CSV, of which a spreadsheet makes no formula.

    A text that begins with =, +, - or @ gets a ' before it, as one does that begins with such a ' already; a number
    that is a text stays as it is, and so do line ends. Who wants the text itself takes the first ' away from one that
    has a ' or more before one of these signs.
    """
    seen = visible(text, "\n")
    return f"'{seen}" if _FORMULA.match(seen) and not _is_number(seen) else seen


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?|[+-]?inf|-?\d+(\.\d+)?%", text, re.IGNORECASE) is not None


def shell(words: Iterable[str]) -> str:
    r"""Return a command of these words, on one line, that a POSIX shell reads as these words.

    A word with signs that cannot be seen, or with ## as in ##[error], is written as `$'\033'`, for bash, zsh and ksh.
    """
    return " ".join(map(_word, words))


def _word(word: str) -> str:
    if visible(word.replace("\\", "")) == word.replace("\\", "") and "##" not in word:
        return shlex.quote(word)
    return f"$'{''.join(one if visible(one) == one and one not in _QUOTED else _octal(one) for one in word)}'"


def _octal(sign: str) -> str:
    """Return a sign by its bytes in octal digits, of which a shell reads three at most."""
    errors = "surrogateescape" if "\udc80" <= sign <= "\udcff" else "surrogatepass"  # a byte of a name that is no UTF-8
    return "".join(f"\\{byte:03o}" for byte in sign.encode("utf-8", errors))
