"""Make the words by which a mistaken name is answered."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

COORDINATES = ("x", "y", "z")  # the variables of a formula


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
