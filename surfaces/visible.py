r"""Show what cannot be seen in a text.

That is: control characters, marks that turn the direction of writing or have no width, halves of characters, and what
Unicode has not assigned. They are written as `\x1b`, `\u202e` or `\U000e0041`. Blanks of any width can be seen.
"""

from __future__ import annotations

import functools
import re
import unicodedata

# Printable by Python's word, and seen by nobody: Unicode's Default_Ignorable_Code_Point that are no control signs
_HIDDEN = re.compile("[\u034f\u115f\u1160\u17b4\u17b5\u180b-\u180f\u3164\ufe00-\ufe0f\uffa0\U000e0000-\U000e0fff]")
_ESCAPE = r"x[0-9a-f]{2}|u[0-9a-f]{4}|U[0-9a-f]{8}"
_SUSPECT = re.compile(rf"\\(?={_ESCAPE})|[^ -~]")
_ESCAPED = re.compile(rf"\\({_ESCAPE})")
_UNSEEN = re.compile("[^ -~]")
_LINE_ENDS = re.compile(r"[ \t]*(?:\r?\n|\t)(?:\r\n|[ \n\t])*")


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


def joined(text: str) -> str:
    """Return prose with its line ends and tabs, and the blanks around them, as one blank each."""
    return _LINE_ENDS.sub(" ", text) if "\n" in text or "\t" in text else text


def one_line(text: str) -> str:
    """Return prose as one line in which all shows."""
    return visible(joined(text))


def shown(text: str) -> str:
    """Return lines of a text that was made elsewhere, such as a drawing: as `visible`, but backslashes stay."""
    if text.isascii() and text.replace("\n", "").isprintable():
        return text
    return _UNSEEN.sub(lambda found: found[0] if found[0] in "\n\t" else _shown(found[0]), text)
