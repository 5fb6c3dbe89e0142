r"""Make a text safe for the place where it goes: nothing in it becomes markup, code, a command or an invisible sign.

Texts come from configs, files of surfaces, plugins, drivers, git and run folders of anybody. Each function here is of
one place. All of them first show what cannot be seen (`visible`): control characters, line ends that are none of the
place's own, marks that turn the direction of writing or have no width, halves of characters. So a text reads back
wherever it stands, and looks alike everywhere.

    terminal          visible (a name), one_line (prose in a table), lines (prose that has lines)
    CI servers        message, property_ (workflow commands of GitHub), xml, attribute (JUnit)
    Markdown          markdown (within a line), code (within a line), fenced (lines)
    HTML              html (between tags and between quotes), in_script, data (JSON within a page)
    drawings          shown (SVG; matplotlib is told to read no mathematics, reports.drawing.canvas.RC)
    typst             every (the template reads texts as JSON, and never as markup)
    tables            cell (CSV)
    commands          shell (a command that is printed to be pasted)
    files             whole (what is read from JSON, where a half of a character may stand)

LaTeX's escapes are in reports.for_papers.latex, where they are a part of how numbers and signs are set. File names and
anchors consist of ASCII letters, digits and hyphens alone (`slug` of reports.for_papers.model and
reports.site.markup), and Vega-Lite takes texts as data, which `in_script` writes.

Of an output's own lines none begins a command of a CI server: `lines` writes the first sign of `::` at a line's
beginning, and of `##[` and `##word[` anywhere, as an escape, wherever the command runs. It does so always, since what a
command prints is often printed again by another program, and one rule can be tested.
"""

from __future__ import annotations

import functools
import html as python_html
import json
import re
import shlex
import unicodedata
from collections.abc import Iterable, Mapping
from typing import Any

# Printable by Python's word, and seen by nobody: Unicode's Default_Ignorable_Code_Point that are no control signs
_HIDDEN = re.compile("[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u3164\ufe00-\ufe0f\uffa0\U000e0000-\U000e0fff]")
_ESCAPE = r"x[0-9a-f]{2}|u[0-9a-f]{4}|U[0-9a-f]{8}"
_SUSPECT = re.compile(rf"\\(?={_ESCAPE})|[^ -~]")
_ESCAPED = re.compile(rf"\\({_ESCAPE})")
_UNSEEN = re.compile("[^ -~]")
_HALVES = re.compile("[\ud800-\udfff]")
_LINE_ENDS = re.compile(r"[ \t]*(?:\r?\n|\t)(?:\r\n|[ \n\t])*")
_COMMAND = re.compile(r"^(\s*):(?=:)|#(?=#\w*\[)", re.MULTILINE)
_SIGNS = re.compile(r"[\\`*\[\]<&|~$#]|(?<![^\W_])_|_(?![^\W_])|(?<=\w):(?=//)|(?<=www)\.", re.IGNORECASE)
_ENTITIES = {"&": "&amp;", "<": "&lt;"}
_FORMULA = re.compile(r"'*[=+\-@＝＋－＠]")  # wide ones too, which spreadsheets of East Asia take


def visible(text: str, kept: str = "") -> str:
    r"""Return a text with what cannot be seen written as `\x1b`, `\u202e` or `\U000e0041`, but for the signs `kept`.

    A backslash that stands before such digits already is written as `\x5c`, so that no two texts look alike; `hidden`
    reads it back.
    """
    if text.isascii() and text.isprintable() and "\\" not in text:
        return text
    return _SUSPECT.sub(lambda found: found[0] if found[0] in kept else _shown(found[0]), text)


def hidden(text: str) -> str:
    """Return the text that `visible` was given."""
    return _ESCAPED.sub(lambda found: chr(int(found[1][1:], 16)), text)


@functools.lru_cache(maxsize=4096)
def _shown(sign: str) -> str:
    """Return one sign as it is, where it can be seen, else as an escape. A blank of any width can be seen."""
    if sign != "\\" and not _HIDDEN.match(sign) and (sign.isprintable() or unicodedata.category(sign) == "Zs"):
        return sign
    number = ord(sign)
    return f"\\x{number:02x}" if number < 0x100 else f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"


def one_line(text: str) -> str:
    """Return prose as one line: its line ends and tabs, with the blanks around them, become a blank; all else shows."""
    return visible(_LINE_ENDS.sub(" ", text) if "\n" in text or "\t" in text else text)


def lines(text: str) -> str:
    """Return prose of several lines for a terminal or a CI server's log: its lines stay, and none begins a command."""
    return harmless(visible(text.replace("\r\n", "\n"), "\n\t"))


def shown(text: str) -> str:
    """Return lines of a text that was made elsewhere, such as a drawing: as `visible`, but backslashes stay."""
    if text.isascii() and text.replace("\n", "").isprintable():
        return text
    return _UNSEEN.sub(lambda found: found[0] if found[0] in "\n\t" else _shown(found[0]), text)


def harmless(text: str) -> str:
    """Return lines of an output, of which none begins a command of a CI server, and what cannot be seen is shown.

    Backslashes stay: what was made visible before stays as it is. It is what every line passes that a command prints.
    """
    text = shown(text)
    return _COMMAND.sub(_defused, text) if ":" in text or "##" in text else text


def _defused(found: re.Match[str]) -> str:
    return r"\x23" if found[0] == "#" else rf"{found[1]}\x3a"


def message(text: str) -> str:
    """Escape a text for the message of a workflow command of GitHub; its lines stay."""
    shown = visible(text.replace("\r\n", "\n"), "\n")
    return shown.replace("%", "%25").replace("\n", "%0A")


def property_(text: str) -> str:
    """Escape a text for a property of a workflow command of GitHub."""
    return message(visible(text)).replace(":", "%3A").replace(",", "%2C")


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

    Raises ValueError where a number is not finite.
    """
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
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
    shown = one_line(text)
    ticks = "`" * (1 + max((len(run) for run in re.findall("`+", shown)), default=0))
    space = " " if "`" in shown or shown != shown.strip() or not shown else ""
    return f"{ticks}{space}{shown}{space}{ticks}"


def fenced(text: str) -> str:
    """Return lines as a block of code in Markdown, whatever backticks they have."""
    shown = visible(text.replace("\r\n", "\n"), "\n\t")
    fence = "`" * max(3, 1 + max((len(run) for run in re.findall("`+", shown)), default=0))
    return f"{fence}\n{shown}\n{fence}"


def every(value: Any) -> Any:
    """Return a JSON value whose texts are visible; their lines stay."""
    if isinstance(value, str):
        return visible(value, "\n\t")
    if isinstance(value, Mapping):
        return {key: every(item) for key, item in value.items()}
    return [every(item) for item in value] if isinstance(value, list | tuple) else value


def whole(value: Any) -> Any:
    """Return a value as JSON has it whose texts can be written as UTF-8: halves of characters are shown."""
    if isinstance(value, str):
        return _HALVES.sub(lambda found: _shown(found[0]), value)
    if isinstance(value, dict):
        return {whole(key): whole(item) for key, item in value.items()}
    return [whole(item) for item in value] if isinstance(value, list) else value


def cell(text: str) -> str:
    """Return a text for a cell of CSV, of which a spreadsheet makes no formula.

    A text that begins with =, +, - or @ gets a ' before it, as one does that begins with such a ' already; a number
    that is a text stays as it is, and so do line ends. Who wants the text itself takes the first ' away from one that
    has a ' or more before one of these signs.
    """
    shown = visible(text, "\n")
    return f"'{shown}" if _FORMULA.match(shown) and not _is_number(shown) else shown


def _is_number(text: str) -> bool:
    return re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?|[+-]?inf|-?\d+(\.\d+)?%", text, re.IGNORECASE) is not None


def shell(words: Iterable[str]) -> str:
    r"""Return a command of these words, on one line, that a POSIX shell reads as these words.

    A word with signs that cannot be seen is written as bash, zsh and ksh read it, `$'\x1b'`.
    """
    return " ".join(map(_word, words))


def _word(word: str) -> str:
    if visible(word.replace("\\", "")) == word.replace("\\", ""):
        return shlex.quote(word)
    shown = (one if one not in "\\'" and _shown(one) == one else _octal(one) for one in word)
    return f"$'{''.join(shown)}'"


def _octal(sign: str) -> str:
    """Return a sign by its bytes in octal digits, of which a shell reads three at most."""
    errors = "surrogateescape" if "\udc80" <= sign <= "\udcff" else "surrogatepass"  # a byte of a name that is no UTF-8
    return "".join(f"\\{byte:03o}" for byte in sign.encode("utf-8", errors))
