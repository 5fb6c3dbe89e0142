"""Hold what readers of foreign files share: the file's text, sentences about it, and what is read from it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

from surfaces.model import Domain, FirsthitError, Surface
from surfaces.visible import one_line
from surfaces.words import suggestion

MAX_BYTES = 2**21  # of a file; the longest tape that is passed around has 0.2 MB
MAX_TOKENS = 200_000
MAX_FORMULA = 600_000  # characters in our language; a tape of 10,000 lines needs about 200,000
DEFAULT_DOMAIN = "sphere:1.5"
PART = "#"  # between a file's name and the name of one of its surfaces

FORMS = {  # the languages that surfaces are written in
    "jsurf": "a file of jsurf and SURFER, for polynomials",
    "pov": "a POV-Ray scene: poly up to degree 35, else an isosurface",
    "vm": "a tape of operations, as fidget reads it",
    "sympy": "Python text that makes the expression with sympy",
    "glsl": "a function float f(vec3 p)",
}


@dataclass(frozen=True)
class Imported:
    """Hold a surface that was read from a file, the format's name, and a sentence for each thing that was left out."""

    surface: Surface
    remarks: tuple[str, ...]
    form: str


@dataclass
class Reading:
    """Hold what a reader found: a formula in our language, and what belongs to it."""

    formula: str
    domain: str | Domain = ""  # empty where the file has none
    parameters: dict[str, str] = field(default_factory=dict)
    name: str = ""  # the file's own, where nothing else is said
    title: str = ""
    source: str = ""
    distance: str = ""


@dataclass(frozen=True, slots=True)
class Token:
    """Hold a word of a file: its kind is "number", "name", "text", "operator" or "end"."""

    kind: str
    text: str
    line: int  # from 1


@dataclass
class Source:
    """Hold a file that is being read. `part` names one of its surfaces, or is empty."""

    path: Path
    text: str
    part: str = ""
    remarks: list[str] = field(default_factory=list)
    chosen: bool = False  # whether `choose` was asked

    def fail(self, message: str, line: int | None = None) -> NoReturn:
        """Raise FirsthitError with the file's name, and the line where there is one."""
        where = f"{self.path}, line {line}" if line else str(self.path)
        raise FirsthitError(f"{where}: {message}")

    def line_of(self, word: str) -> int | None:
        """Return the first line that begins with a word; None where none does."""
        begins = re.compile(rf"[\s\"'{{]*{re.escape(word)}\b", re.IGNORECASE)
        return next((i for i, line in enumerate(self.text.split("\n"), 1) if begins.match(line)), None)

    def remark(self, text: str) -> None:
        """Say something of the file, once, in one line: what the file's own words are in it, they begin no other."""
        text = one_line(text)
        if text not in self.remarks:
            self.remarks.append(text)

    def left_out(self, what: Iterable[str], why: str) -> None:
        """Say in one sentence that some things of the file were left out, if there are any."""
        names = list(dict.fromkeys(what))
        if names:
            shown = ", ".join(names[:12]) + (f" and {len(names) - 12} more" if len(names) > 12 else "")
            self.remark(f"left out: {shown} ({why})")

    def choose(self, names: list[str], what: str) -> int:
        """Return which of several surfaces is meant: the one that `part` names or numbers, else the first.

        Says so where there are several. Raises FirsthitError where `part` is none of them.
        """
        self.chosen = True
        if self.part:
            if self.part in names:
                return names.index(self.part)
            if self.part.isdecimal() and 1 <= int(self.part[:9]) <= len(names):
                return int(self.part) - 1
            self.fail(f"there is no {what} {self.part!r}; {suggestion(self.part, names[:50])}")
        if len(names) > 1:
            shown = ", ".join(names[:8]) + (", …" if len(names) > 8 else "")
            self.remark(
                f"the file has {len(names)} {what}s ({shown}); the first is taken, and {self.path.name}{PART}NAME "
                "or a number behind it takes another"
            )
        return 0


_TOKEN = re.compile(
    r"(?P<space>[ \t\r\f\v\ufeff]+)|(?P<newline>\n)|(?P<comment>//[^\n]*)|(?P<block>/\*)"
    r"|(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)|(?P<name>[A-Za-z_][A-Za-z_0-9]*)"
    r'|(?P<text>"(?:[^"\\\n]|\\.)*")|(?P<operator>\*\*|<=|>=|==|!=|&&|\|\||[-+*/^%(){}\[\]<>=,;:!&|?.#@])'
)


def tokens(source: Source, text: str | None = None, line: int = 1) -> list[Token]:
    """Split text, the whole file's by default, into words; comments are // and /* */. The last word is the end.

    Raises FirsthitError at another character, at an open comment, and past MAX_TOKENS.
    """
    text = source.text if text is None else text
    found: list[Token] = []
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            source.fail(f"{text[at]!r} (U+{ord(text[at]):04X}) has no place here", line)
        kind, at = str(match.lastgroup), match.end()
        if kind == "newline":
            line += 1
        elif kind == "block":
            end = text.find("*/", at)
            if end < 0:
                source.fail("the comment that /* begins has no end", line)
            line, at = line + text.count("\n", at, end), end + 2
        elif kind not in ("space", "comment"):
            if len(found) == MAX_TOKENS:
                source.fail(f"more than {MAX_TOKENS} words are not read", line)
            found.append(Token(kind, match.group(), line))
    return [*found, Token("end", "", line)]
