"""Parse the statements of a formula: definitions of parts and functions, and the surface, which is the last one."""

from __future__ import annotations

from surfaces.language.grammar import Values
from surfaces.language.names import RESERVED, Code, Function
from surfaces.words import COORDINATES


class Parser(Values):
    """Parse one formula, or definitions alone."""

    def formula(self) -> Code:
        """Parse the whole text, and return the code of the surface's value."""
        self.definitions(self._last())
        if self._defines():
            token, name = self.peek(), self.ahead(int(self.peek().text == "let"))
            known = name.text in COORDINATES or self.names.meaning(name.text) or self.names.letters(name.text)
            if token.text == "let" or not known:
                self.fail(
                    "the last statement is the surface; this one only defines a name (a ; ends a statement)",
                    token.column,
                )
        self.parse(0)
        token = self.peek()
        if token.text == "=":
            self.take()
            self.parse(0)
            self.emit("-", None, token.column)
            if self.peek().text == "=":
                self.fail("an equation has one '='", self.peek().column)
        while self.peek().text == ";":
            self.take()
        if self.peek().kind != "end":
            self.fail(self.surplus(self.peek()), self.peek().column)
        return tuple(self.code)

    def _last(self) -> int:
        """Return the position at which the last statement begins."""
        end = len(self.tokens) - 1
        while end > 0 and self.tokens[end - 1].text == ";":
            end -= 1
        return next((i for i in range(end, 0, -1) if self.tokens[i - 1].text == ";"), 0)

    def definitions(self, stop: int) -> None:
        """Parse definitions up to a token's position. Raises FirsthitError at any other statement."""
        last = self.tokens[stop]  # a position moves on when a word becomes a product of letters
        for i in range(stop):
            if i == 0 or self.tokens[i - 1].text == ";":
                name = self.tokens[i + 1] if self.tokens[i].text == "let" else self.tokens[i]
                self.later.add(name.text)
        while self.peek() is not last:
            if self.peek().text == ";":
                self.take()
                continue
            if not self._defines():
                told = "only the last statement is the surface; the others define names, as in d = sqrt(x^2 + y^2)"
                self.fail(told, self.peek().column)
            self._definition()
            if self.peek().text != ";":
                self.fail(self.surplus(self.peek()), self.peek().column)

    def _defines(self) -> bool:
        """Return whether a statement that begins here is a definition."""
        if self.peek().text == "let" and self.ahead(1).kind == "name":
            return True
        if self.peek().kind != "name":
            return False
        at = 1
        if self.ahead(at).text == "(":
            while self.ahead(at + 1).kind == "name" and self.ahead(at + 2).text == ",":
                at += 2
            if self.ahead(at + 1).kind != "name" or self.ahead(at + 2).text != ")":
                return False
            at += 3
        return self.ahead(at).text == "="

    def _definition(self) -> None:
        """Parse the definition of a part or of a function."""
        if self.peek().text == "let":
            self.take()
        name, names = self.take(), self.names
        if name.text in RESERVED or (self.own and name.text in COORDINATES):
            self.fail(f"{name.text!r} cannot be defined: it has a meaning of its own", name.column)
        if name.text in names.parameters:
            self.fail(f"two definitions of {name.text!r}: it is a parameter too", name.column)
        if self.own and (name.text in names.parts or name.text in names.functions):
            self.fail(f"two definitions of {name.text!r}", name.column)
        arguments = self._arguments() if self.peek().text == "(" else None
        self.expect("=")
        if arguments is None:
            self.parse(0)
            self.emit("store", name.text, name.column)
            names.parts[name.text] = name.column
            return
        outer, self.code, names.arguments = self.code, [], {word: i for i, word in enumerate(arguments)}
        self.parse(0)
        function = Function(name.text, len(arguments), tuple(self.code), self.own)
        self.code, names.arguments = outer, {}
        if self.own:
            names.functions[name.text] = function
        else:
            names.library.setdefault(name.text, {})[len(arguments)] = function

    def _arguments(self) -> list[str]:
        """Parse the names of a function's arguments."""
        self.expect("(")
        found: list[str] = []
        while True:
            token = self.take()
            if token.kind != "name" or token.text in RESERVED:
                self.fail(f"expected the name of an argument here, found {self.describe(token)}", token.column)
            if token.text in found:
                self.fail(f"two arguments have the name {token.text!r}", token.column)
            found.append(token.text)
            if self.peek().text != ",":
                self.expect(")")
                return found
            self.take()
