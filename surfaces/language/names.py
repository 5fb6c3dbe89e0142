"""Say what each name in a formula means: what the user chose wins over the language's own names."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from surfaces.words import COORDINATES, suggestion

Code = tuple[tuple[str, Any, int], ...]  # instructions in postfix order: what to do, with what, from which column
CONSTANTS = {
    "pi": "the circle's number",
    "e": "Euler's number",
    "phi": "the golden ratio",
    "tau": "2*pi",
    "sqrt2": "a root",
    "sqrt3": "a root",
    "sqrt5": "a root",
}
# how many values a function of the tape's own takes; None: at least 2, or for length at least 1
BUILT_IN: dict[str, int | None] = {
    "sqrt": 1,
    "exp": 1,
    "log": 1,
    "sin": 1,
    "cos": 1,
    "tan": 1,
    "abs": 1,
    "floor": 1,
    "atan2": 2,
    "pow": 2,
    "if": 3,
    "min": None,
    "max": None,
    "length": None,
}
RESERVED = ("and", "or", "not", "let")


@dataclass(frozen=True)
class Function:
    """Hold a function that is defined in the language: its arguments' number, and the code of its value."""

    name: str
    count: int
    code: Code
    own: bool  # the user's, not the prelude's


@dataclass
class Names:
    """Hold the names of one formula. `meaning` says what a name is; `notes` collects what the user should be told."""

    parameters: frozenset[str]
    library: dict[str, dict[int, Function]]  # the prelude, by name and number of arguments
    parts: dict[str, int] = field(default_factory=dict)  # columns of definitions
    functions: dict[str, Function] = field(default_factory=dict)
    arguments: dict[str, int] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def own(self, name: str) -> tuple[str, Any] | None:
        """Return the kind and the value of a name that the user chose; None for others."""
        if name in self.arguments:
            return "argument", self.arguments[name]
        if name in self.parts:
            return "part", name
        if name in self.functions:
            return "function", self.functions[name]
        return ("parameter", name) if name in self.parameters else None

    def meaning(self, name: str) -> tuple[str, Any] | None:
        """Return the kind and the value of a name; None for an unknown one.

        The language's names are known in any case of letters, unless the user chose the same word in small letters.
        """
        own, lower = self.own(name), name.lower()
        if own:
            self._tell(name, own[0])
            return own
        if lower != name and self.own(lower):
            return None
        return self.language(lower)

    def language(self, name: str) -> tuple[str, Any] | None:
        """Return the kind and the value of a name of the language; None for an unknown one."""
        if name in COORDINATES:
            return "var", name
        if name in ("pi", "e", "phi", "tau"):
            return "constant", name
        if re.fullmatch(r"sqrt[1-9][0-9]{0,3}", name):
            return "root", int(name[4:])
        if name in BUILT_IN:
            return "built-in", name
        return ("library", self.library[name]) if name in self.library else None

    def _tell(self, name: str, kind: str) -> None:
        """Note that a name of the user's hides one of the language's."""
        hidden = self.language(name)
        if hidden is None or kind == "argument":
            return
        what = CONSTANTS.get(name, "a root") if hidden[0] in ("constant", "root") else "the function"
        word = "part" if kind in ("part", "function") else kind
        note = f"{name} is your {word}, not {what}"
        if note not in self.notes:
            self.notes.append(note)

    def letters(self, word: str) -> bool:
        """Return whether a word is a product of single letters, each a coordinate or a value that the user named."""
        if len(word) < 2 or len(word) > 12:
            return False
        return all(c in COORDINATES or (self.own(c) or ("function",))[0] != "function" for c in word)

    def values(self) -> Iterable[str]:
        """Return the names of values, for hints."""
        return [*COORDINATES, *self.arguments, *self.parts, *sorted(self.parameters), *CONSTANTS]

    def callables(self) -> Iterable[str]:
        """Return the names of functions, for hints."""
        return [*self.functions, *BUILT_IN, *(name for name in self.library if not name.startswith("_"))]

    def unknown(self, name: str, called: bool) -> str:
        """Return what to say of an unknown name; `called` says whether a parenthesis follows."""
        match = re.fullmatch(r"([A-Za-z])([0-9]+)", name)
        if match and self.meaning(match[1]):
            return f"unknown name {name!r}; did you mean {match[1]}^{match[2]} or {match[2]}*{match[1]}?"
        known = self.callables() if called else [*self.values(), *self.callables()]
        what = "function" if called else "name"
        return f"unknown {what} {name[:40]!r}; {suggestion(name.lower()[:40], known)}"
