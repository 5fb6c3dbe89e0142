"""Define what a paper is given: drawings, pictures and tables, each with a name that says what it is."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from matplotlib.figure import Figure as Drawing

from reports import wording
from reports.content import Table

LONGEST = 120  # letters of a file's name


@dataclass(frozen=True)
class Plate:
    """Hold a figure or a picture to be: `draw` makes a figure's drawing, `png` are a picture's bytes.

    The name is that of its file, without an ending; title and caption are plain text, and say what it shows.
    """

    name: str
    title: str
    caption: str
    draw: Callable[[], Drawing] | None = None
    png: bytes = b""


@dataclass(frozen=True)
class Tabled:
    """Hold a table, with the name of its file without an ending; the lines `strong` are set in bold."""

    name: str
    table: Table
    strong: frozenset[int] = frozenset()

    @property
    def title(self) -> str:
        """Return the table's title."""
        return self.table.title

    @property
    def caption(self) -> str:
        """Return the table's caption."""
        return self.table.caption


Named = TypeVar("Named", Plate, Tabled)


def slug(*parts: str) -> str:
    """Return a file's name for what these texts name: lower case letters, digits and hyphens.

    Letters lose their accents, and every other character becomes a hyphen, dots too, which LaTeX takes for the
    beginning of a file's ending: "Newton, ε = 0.001" is newton-e-0-001. Of a long one the beginning is taken.
    """
    text = "-".join(parts).replace("ε", "e").translate(str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789"))
    plain = unicodedata.normalize("NFKD", text.lower()).encode("ascii", "ignore").decode()
    return re.sub(r"[^a-z0-9]+", "-", plain)[:LONGEST].strip("-") or "unnamed"


def distinct(named: Sequence[Named], wholes: Sequence[str]) -> list[Named]:
    """Return `named` with a name for each: those that share one end in a digest of what they are, `wholes`."""
    counted = Counter(one.name for one in named)
    return [
        one if counted[one.name] == 1 else replace(one, name=f"{one.name}-{hashlib.sha256(w.encode()).hexdigest()[:6]}")
        for one, w in zip(named, wholes, strict=True)
    ]


def sentence(*told: str) -> str:
    """Join sentences, of which some may be empty, by spaces."""
    return " ".join(filter(None, (text.strip() for text in told)))


def exact(errors: object) -> str:
    """Return the sentence that says what an error of 0 is, where one of `errors` is 0; else ""."""
    return wording.zeros(errors).strip()
