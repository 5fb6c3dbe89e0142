"""Leave out of a program what nothing calls: functions, types, macros and tables that its entry point never reaches.

A section is read line by line as items: a macro, or a definition that ends with a line on which all brackets are
closed, with the comment lines right above it. An item is kept where an item that is kept has one of its names. What
defines no name, such as `#version`, is always kept. So a text of an unexpected form loses nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from harness.contract import Section

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_WORD = re.compile(r"[A-Za-z_]\w*")
_MACRO = re.compile(r"\s*#\s*define\s+(\w+)")
_STRUCT = re.compile(r"\s*(?:STRUCT\s*\(\s*\w+\s*\)\s*)?struct\s+(\w+)\s*\{")
_DEFINED = re.compile(r"(\w+)\s*[(\[=;]")  # what stands before the first of these signs is the name


@dataclass(frozen=True)
class Item:
    """Hold a macro or a definition with its comments, or lines that define nothing.

    names: what it defines; none where it is always kept, and where it is a comment that stands alone
    words: all names in its code
    """

    text: str
    names: frozenset[str]
    words: frozenset[str]


def pruned(sections: Sequence[Section], entry: Sequence[Section]) -> list[Section]:
    """Return the sections without the items that `entry`, which is kept whole, does not reach.

    Sections of which nothing is left are left out; the order stays. Comments that stand alone stay with their section.
    """
    split = [list(items_of(section.text)) for section in sections]
    every = [item for items in split for item in items]
    words = _reached(every, {word for section in entry for word in _WORD.findall(_code(section.text))})
    left = []
    for section, items in zip(sections, split, strict=True):
        kept = [item for item in items if not item.names or item.names & words]
        if any(item.words for item in kept):
            text = re.sub(r"\n{3,}", "\n\n", "\n".join(item.text for item in kept)).strip("\n")
            left.append(Section(section.origin, text))
    return [*left, *entry]


def _reached(items: Iterable[Item], words: set[str]) -> set[str]:
    """Return the words that are reached from `words` and from the items that are always kept."""
    every, reached, before = list(items), words, set[str]()
    while reached != before:
        before = reached
        reached = before.union(*(item.words for item in every if not item.names or item.names & before))
    return reached


def items_of(text: str) -> Iterator[Item]:
    """Yield the items of a section's text, which together are all of its lines."""
    lines, code = text.rstrip().split("\n"), _code(text.rstrip()).split("\n")
    first, depth = 0, 0
    for last, (line, bare) in enumerate(zip(lines, code, strict=True)):
        depth += sum(bare.count(sign) for sign in "({[") - sum(bare.count(sign) for sign in ")}]")
        ends = bare.rstrip().endswith(("}", ";")) or (bare.lstrip().startswith("#") and not bare.endswith("\\"))
        continued = "\n".join(code[first:last]).rstrip().endswith("\\") and not bare.endswith("\\")
        if depth == 0 and (ends or continued or not line.strip()):
            yield _item("\n".join(lines[first : last + 1]), "\n".join(code[first : last + 1]))
            first = last + 1
    if first < len(lines):
        yield _item("\n".join(lines[first:]), "\n".join(code[first:]))


def _item(text: str, code: str) -> Item:
    return Item(text, frozenset(_names(code)), frozenset(_WORD.findall(code)))


def _names(code: str) -> Iterator[str]:
    """Yield the names that an item's code defines; none where its form is not known."""
    if macro := _MACRO.match(code):
        yield macro[1]
    elif struct := _STRUCT.match(code):
        yield struct[1]
    elif code.strip() and not code.lstrip().startswith("#") and (defined := _DEFINED.search(code)):
        yield defined[1]


def _code(text: str) -> str:
    """Return a text without its comments; its lines stay where they are."""
    return _COMMENT.sub(lambda found: "\n" * found[0].count("\n"), text)
