"""Find the line of each key, table and item of a list in a text that is TOML: tomllib keeps no positions.

One pass over the text finds all of them, so that a mistake in a long config is told at once.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field

Where = tuple[str | int, ...]  # keys and places that lead to a value: ("view", 1, "fov")

DEEPEST = 50  # lists and tables in each other, or parts of a key
DIGITS = 1000  # of a number: no float needs more than 309

_WHOLE = re.compile(r"[+-]?(0[xob])?[0-9A-Fa-f_]+")
_TOKEN = re.compile(
    r"""
      (?P<space>[ \t\r]+|\#[^\n]*)
    | (?P<line>\n)
    | (?P<text>\"{3}(?:\\.|[^\\])*?\"{3}(?!\") | '{3}.*?'{3}(?!') | \"(?:\\.|[^"\\])*\" | '[^']*')
    | (?P<sign>[][{},=.])
    | (?P<word>[^\s][^][{},=.\s\#]*)
    """,
    re.VERBOSE | re.DOTALL,
)


@dataclass
class _Open:
    """Hold a list or an inline table that is not closed yet.

    place: where it stands
    item: of a list: the place of the item that is next; of a table: None
    """

    place: Where
    item: int | None


@dataclass
class _Reader:
    """Go through the tokens of a text, and note where each value begins."""

    found: dict[Where, int] = field(default_factory=dict)
    counts: dict[Where, int] = field(default_factory=dict)  # how many tables an array of tables has so far
    table: Where = ()  # that the last header names
    keys: list[str] = field(default_factory=list)  # of the key, or the header, that is being read
    header: int = 0  # brackets that the header has which is being read
    valued: bool = False  # what follows is a value, and no key
    opened: list[_Open] = field(default_factory=list)

    def note(self, place: Where, line: int) -> None:
        """Note that a place, and what leads to it, is set in a line, if no earlier line did."""
        while place and place not in self.found:
            self.found[place] = line
            place = place[:-1]

    def sign(self, sign: str, line: int) -> None:
        """Take one of the characters that give TOML its form."""
        if self.header or (sign == "[" and not (self.opened or self.valued or self.keys)):
            self._head(sign, line)
        elif sign == "=" and not self.valued:
            self.valued = True
        elif sign in "[{":
            place = self._begun(line)
            self.opened.append(_Open(place, 0 if sign == "[" else None))
            self.keys, self.valued = [], sign == "["
        elif sign in "]}":
            self.opened.pop()
            self._ended()
        elif sign == "," and self.opened:
            inner = self.opened[-1]
            self.keys, self.valued = [], inner.item is not None
            inner.item = None if inner.item is None else inner.item + 1

    def word(self, text: str, line: int) -> None:
        """Take a key, or a value that is neither a list nor a table."""
        if self.valued:
            self._begun(line)
            self._ended()
        else:
            self.keys.append(_key(text))

    def line_ends(self) -> None:
        if not self.opened:
            self.keys, self.valued, self.header = [], False, 0

    def _begun(self, line: int) -> Where:
        """Note the value that begins here, and return its place."""
        if self.opened and self.opened[-1].item is not None:
            place: Where = (*self.opened[-1].place, self.opened[-1].item)
        else:
            place = (*(self.opened[-1].place if self.opened else self.table), *self.keys)
        self.note(place, line)
        return place

    def _ended(self) -> None:
        """Go on after a value: only the rest of a number that has a point can follow before a comma or a line's end."""
        self.valued = bool(self.opened) and self.opened[-1].item is not None

    def _head(self, sign: str, line: int) -> None:
        if sign == "[":
            self.header += 1
        elif sign == "]":
            self._headed(self.header == 2, line)
            self.header, self.keys = -1, []  # the other bracket of two says nothing more

    def _headed(self, is_array: bool, line: int) -> None:
        if self.header < 0:
            return
        place: Where = ()
        for key in self.keys[:-1]:
            place = self._last_of((*place, key))
        place = (*place, self.keys[-1])
        if is_array:
            self.counts[place] = self.counts.get(place, 0) + 1
        self.table = self._last_of(place)
        self.note(self.table, line)

    def _last_of(self, place: Where) -> Where:
        """Return the place of the last table, where a place is that of an array of tables."""
        return (*place, self.counts[place] - 1) if place in self.counts else place


def lines_of(text: str) -> dict[Where, int]:
    """Return the line in which each key, table and item of a list begins, for a text that tomllib can read."""
    reader, line = _Reader(), 1
    for token in _TOKEN.finditer(text):
        kind, found = token.lastgroup, token[0]
        if kind == "line":
            reader.line_ends()
        elif kind == "sign":
            reader.sign(found, line)
        elif kind != "space":
            reader.word(found, line)
        line += found.count("\n")
    return reader.found


def excess(text: str) -> tuple[int, str] | None:
    """Say in which line a text is past what any config needs, and how; None where it is not, whether it is TOML or not.

    What is nested without end would make tomllib, and whoever writes a value into a message, fail.
    """
    line, depth, parts = 1, 0, 0
    for token in _TOKEN.finditer(text):
        kind, found = token.lastgroup, token[0]
        if kind == "sign":
            depth += (found in "[{") - (found in "]}")
            parts = parts + 1 if found == "." else 0
            if depth > DEEPEST or parts > DEEPEST:
                return line, f"a value that is nested more than {DEEPEST} deep; no key of a config is"
        elif kind == "word":
            if len(found) > DIGITS and _WHOLE.fullmatch(found):
                return line, f"a number of more than {DIGITS} digits, which no value of a config has"
        else:
            parts = 0 if kind == "line" else parts
            line += found.count("\n")
    return None


def _key(text: str) -> str:
    """Return a key without its quotes."""
    if text[0] == "'":
        return text[1:-1]
    if text[0] == '"':
        return text[1:-1] if "\\" not in text else str(next(iter(tomllib.loads(f"{text} = 0"))))
    return text
