"""Say what each name in a formula means: what the user chose wins over the language's own names."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from surfaces.words import COORDINATES, suggestion

Code = tuple[tuple[str, Any, int], ...]  # instructions in postfix order: what to do, with what, from which column
CONSTANTS = {
    "pi": "the circle's number",
    "e": "Euler's number",
    "phi": "the golden ratio",
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
_NEEDS = "; a parameter needs a value: --parameter {0}=1, or {0} = 1; before the formula"
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
    used: set[str] = field(default_factory=set)  # parameters that occur

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
            if own[0] == "parameter":
                self.used.add(name)
            return own
        if lower != name and self.own(lower):
            return None
        return self.language(lower)

    def language(self, name: str) -> tuple[str, Any] | None:
        """Return the kind and the value of a name of the language; None for an unknown one."""
        if name in COORDINATES:
            return "var", name
        if name in ("pi", "e", "phi"):
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
        return all((self.own(c) or ("function",))[0] != "function" or c.lower() in COORDINATES for c in word)

    def values(self) -> list[str]:
        """Return the names of values, for hints."""
        return [*COORDINATES, *self.arguments, *self.parts, *sorted(self.parameters), *CONSTANTS]

    def callables(self) -> list[str]:
        """Return the names of functions, for hints."""
        return [*self.functions, *BUILT_IN, *(name for name in self.library if not name.startswith("_"))]

    def unknown(self, name: str, called: bool) -> str:
        """Return what to say of an unknown name; `called` says whether a parenthesis follows."""
        match = re.fullmatch(r"([A-Za-z])([0-9]+)", name)
        if match and self.meaning(match[1]):
            return f"unknown name {name!r}; did you mean {match[1]}^{match[2]} or {match[2]}*{match[1]}?"
        if name.lower() == "tau":
            return "tau is the golden ratio to some and 2*pi to others; write phi or 2*pi"
        for begin in range(1, len(name) - 1) if called else ():
            factors, function = name[:begin], name[begin:]
            if function in self.callables() and (self.letters(factors) or factors in self.values()):
                shown = factors if factors in self.values() else "*".join(factors)
                return f"unknown function {name[:40]!r}; did you mean {shown}*{function}(...)?"
        known = self.callables() if called else [*self.values(), *self.callables()]
        what, most = ("function", 16) if called else ("name", 8)
        otherwise = f"known: {', '.join(known[:most])}, ..." + ("" if called else _NEEDS.format(name[:40]))
        return f"unknown {what} {name[:40]!r}; {suggestion(name.lower()[:40], known, otherwise=otherwise)}"
