"""Make words: those by which a mistaken name is answered, and a count with its noun."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

from surfaces.visible import visible

COORDINATES = ("x", "y", "z")  # the variables of a formula
LONGEST_NAME = 100  # letters
LONGEST_TITLE = 2000


def suggestion(name: str, known: Iterable[str], most: int = 1, otherwise: str = "") -> str:
    """Return what to say of an unknown `name`: "did you mean 'torus'?", or "known: sphere, torus" where none is near.

    With `most` above 1, up to so many names are suggested, and less near ones too. `otherwise` replaces the list of
    what is known, where that is too long to print.
    """
    names = list(known)
    near = difflib.get_close_matches(name, names, most, 0.6 if most == 1 else 0.5)
    if near:
        return f"did you mean {repr(near[0]) if most == 1 else ', '.join(near)}?"
    return otherwise or f"known: {', '.join(names) or 'none'}"


def plural(n: int, noun: str) -> str:
    """Write a count and its noun: 1 row, 2 rows."""
    return f"{n:,} {noun}" if n == 1 else f"{n:,} {noun}s"


def name_problem(name: str) -> str | None:
    """Say why a text can be no name of a surface, a view, a scene or the like; None where it can.

    A name stands in file names, in one line of a terminal, and in CI logs, so that it is short and has letters that can
    be seen and that cannot begin a line, a folder or a command.
    """
    if not name.strip():
        return "a name has a letter at least"
    if len(name) > LONGEST_NAME:
        return f"a name has {LONGEST_NAME} letters at most, and {name[:20]!r}... has {len(name):,}"
    bad = unseen(name) or next((c for c in name if c in "/\\"), None)
    return None if bad is None else f"a name holds no {bad!r}: letters, digits, blanks and signs other than slashes"


def title_problem(title: str) -> str | None:
    """Say why a text can be no title, source or meaning, which stand in one line; None where it can."""
    if len(title) > LONGEST_TITLE:
        return f"it has {LONGEST_TITLE:,} letters at most, and {title[:20]!r}... has {len(title):,}"
    bad = unseen(title)
    return None if bad is None else f"it holds no {bad!a}: it is one line of letters and signs that can be seen"


def unseen(text: str) -> str | None:
    """Return the first sign of a text that cannot be seen; None where there is none."""
    return next((c for c in text if c != "\\" and visible(c) != c), None)
