"""Parse formulas by precedence climbing into linear postfix code. Nothing is ever evaluated as Python.

    formula     statements with ; between them; the last is the surface: a value, or an equation a = b, which is a - b
    definition  let d = value, or let g(u, v) = value; the word let may be left out
    value       c ? a : b; or, and, not; < <= > >= == !=; + -; * / % and products without a sign; signs; ^
    operand     a number, a name, (value), |value|, √ before an operand, name(value, ...), an operand with a raised ²

Operators that stand on one line above bind alike, those further right bind tighter. `^` groups to the right, all others
to the left. It is no grammar for a library of parsers, since three things depend on what is known of names and on what
was read before: whether `|` opens or closes, whether `g(` is a call or a product, and whether `xy` is a name. So one
pass over the tokens that knows the names is shorter than a grammar and a pass that mends its tree, gives messages of
its own, and takes linear time.

A product without a sign is refused where it can be read in two ways (`1/2x`, `2 3`, `e^2x`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NoReturn

from surfaces.language.names import BUILT_IN, Function, Names
from surfaces.language.tokens import Token, exact, fail, tokens
from surfaces.model import FirsthitError

MAX_LENGTH = 2_000_000  # characters of a formula
MAX_DEPTH = 200  # of parentheses, calls, operands and signs inside one another
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")
_OR, _NOT, _PRODUCT, _SIGN, _POWER, _RAISED, _BAR = 4, 7, 20, 30, 40, 50, -2
_PRECEDENCE = {"?": 2, "or": _OR, "and": 6, **dict.fromkeys(COMPARISONS, 8), "+": 10, "-": 10}
_PRECEDENCE |= {"*": _PRODUCT, "/": _PRODUCT, "%": _PRODUCT, "^": _POWER, "(": _PRODUCT, "√": _PRODUCT, "|": _BAR}
_KINDS = {"number": _PRODUCT, "name": _PRODUCT, "raised": _RAISED, "end": -1}


class Values:
    """Parse the values of one formula. `parse` adds to `code`; `names` says what names mean, and gathers notes."""

    def __init__(self, text: str, names: Names, own: bool = True) -> None:
        if len(text) > MAX_LENGTH:
            raise FirsthitError(f"the formula has {len(text)} characters; at most {MAX_LENGTH} are accepted")
        self.text = text
        self.names = names
        self.own = own
        self.code: list[tuple[str, Any, int]] = []
        self.tokens = tokens(text)
        self.powers = [self._binding(token) for token in self.tokens]
        self.position = 0
        self.depth = 0
        self.bars = 0  # how many | are open inside the innermost parentheses
        self.joined = False  # whether a factor stands directly behind a closing | there
        self.later: set[str] = set()  # names that statements of this formula define, before or after here

    def fail(self, message: str, column: int) -> NoReturn:
        fail(self.text, message, column)

    @staticmethod
    def _binding(token: Token) -> int:
        """Return how tight a token binds as an operator: -1 if it is none, _BAR if that depends on open bars."""
        return _PRECEDENCE.get(token.text, -1) if token.kind == "operator" else _KINDS[token.kind]

    def peek(self) -> Token:
        """Return the next token."""
        return self.tokens[self.position]

    def ahead(self, count: int) -> Token:
        """Return the token that stands `count` tokens behind the next one, or the end."""
        return self.tokens[min(self.position + count, len(self.tokens) - 1)]

    def take(self) -> Token:
        """Return the next token, and go on behind it."""
        token = self.tokens[self.position]
        self.position += token.kind != "end"
        return token

    def expect(self, text: str) -> None:
        """Take a token that must be `text`. Raises FirsthitError if it is another."""
        token = self.take()
        if token.text != text or token.kind != "operator":
            if token.text == "=":
                self.fail("'=' has no place here; write == to compare", token.column)
            self.fail(f"expected {text!r} here, found {self.describe(token)}", token.column)

    @staticmethod
    def describe(token: Token) -> str:
        """Return how a message names a token."""
        return "the end of the formula" if token.kind == "end" else repr(token.text)

    def emit(self, name: str, value: Any, column: int) -> None:
        self.code.append((name, value, column))

    def surplus(self, token: Token) -> str:
        """Return what is wrong with a token that is left over."""
        if token.text in (")", ","):
            return f"{token.text!r} without its '('"
        if token.text == "=":
            return "'=' has no place here; write == to compare"
        if token.text == ";":
            return "';' has no place here: it stands between statements"
        if token.text == "|":
            return "'|' without its partner"
        return f"expected an operator before {self.describe(token)}; write * between factors"

    def parse(self, binding: int) -> None:
        """Parse everything that binds tighter than `binding`, and add its code."""
        self.depth += 1
        if self.depth > MAX_DEPTH:
            self.fail(f"nested more than {MAX_DEPTH} deep", self.peek().column)
        start = len(self.code)
        self.prefix()
        divisor: Token | None = None  # the sign of the division that the operand before is the divisor of
        while (power := self.power()) > binding:
            token = self.peek()
            if token.kind == "raised":
                self._raised(self.take())
            elif token.kind != "operator" or (token.text in ("(", "√", "|") and power == _PRODUCT):
                self._side_by_side(divisor)
                self.parse(_PRODUCT)
                self.emit("*", None, token.column)
            else:
                self.take()
                divisor = token if token.text in ("/", "%") else None
                self._operator(token, power, start)
        self.depth -= 1

    def power(self) -> int:
        """Return how tight the next token binds as an operator; -1 if it is none."""
        power = self.powers[self.position]
        if power != _BAR:
            return power
        if self.bars:
            return -1
        after = self.ahead(1)
        return _OR if after.text == "|" and not after.spaced else _PRODUCT

    def _operator(self, token: Token, power: int, start: int) -> None:
        """Parse what stands behind an operator, and add the operator's code."""
        name = "or" if token.text == "|" else token.text
        if token.text == "|":
            self.take()
        if name == "?":
            self.parse(1)
            self.expect(":")
            self.parse(1)
            self.emit("if", None, token.column)
            return
        self.parse(power - 1 if name == "^" else power)
        if name in COMPARISONS and self.peek().text in COMPARISONS and self.peek().kind == "operator":
            self.fail("write a < b and b < c for a chain of comparisons", self.peek().column)
        if name == "^" and self.power() == _PRODUCT and self.peek().text not in ("*", "/", "%"):
            base = self.code[start][0]
            if base in ("const", "constant") and self.code[start + 1][2] > token.column:
                written = self._between(token, self.peek())
                told = f"{written}*{self.peek().text} or ^({written[1:]}*{self.peek().text})"
                self.fail(f"this can be read in two ways; write {told}", self.peek().column)
        self.emit(name, None, token.column)

    def _between(self, first: Token, last: Token) -> str:
        """Return the text from one token to another, without the second; its middle is left out if it is long."""
        written = " ".join(self.text[first.column : last.column].split())
        return written if len(written) <= 24 else f"{written[:10]}...{written[-10:]}"

    def _raised(self, token: Token) -> None:
        """Add the code of a raised exponent."""
        if self.peek().text == "^" or self.peek().kind == "raised":
            self.fail("a power of a power needs parentheses", self.peek().column)
        self.number(token)
        self.emit("^", None, token.column)

    def _side_by_side(self, divisor: Token | None) -> None:
        """Raise FirsthitError if a product without a sign, whose second factor is next, can be read in two ways."""
        token, before = self.peek(), self.tokens[self.position - 1]
        if token.line:
            told = "a new line is no operator; write * for a product, or ; between statements"
            self.fail(told, token.column)
        if token.kind == "number":
            told = (
                f"two numbers side by side; write {before.text}*{token.text}"
                if before.kind == "number"
                else "a number behind a factor; write * for a product or ^ for a power"
            )
            self.fail(told, token.column)
        if divisor is not None:
            written, sign = self._between(divisor, token), divisor.text
            told = f"{written}*{token.text} or {sign}({written[1:].strip()}*{token.text})"
            self.fail(f"this can be read in two ways; write {told}", token.column)
        if token.text == "|" and self.joined:
            self.fail("these | | can be read in two ways; write abs(...), or * between factors", token.column)
        self.joined = self.joined or (before.text == "|" and token.text != "|")

    def prefix(self) -> None:
        """Parse a number, a name, a call, or a value in brackets or behind a sign."""
        token = self.take()
        if token.kind == "number":
            self.number(token)
        elif token.kind == "name":
            self.name(token)
        elif token.text in ("-", "+") and token.kind == "operator":
            self.parse(_SIGN)
            if token.text == "-":
                self.emit("neg", None, token.column)
        elif token.text in ("not", "!"):
            self.parse(_NOT if token.text == "not" else _SIGN)
            self.emit("not", None, token.column)
        elif token.text in ("(", "|"):
            self._bracket(token)
        elif token.text == "√":
            self._root(token)
        else:
            told = f"expected a number, a name or '(' here, found {self.describe(token)}"
            if token.text in ("=", ")", ",") and self.position > 1:
                told = f"a value is missing before {token.text!r}"
            self.fail(told, token.column)

    def number(self, token: Token) -> None:
        """Add a number's code. Raises FirsthitError if it is past the range of float64."""
        try:
            self.emit("const", exact(token.text), token.column)
        except FirsthitError as error:
            self.fail(str(error), token.column)
        if "e" in token.text.lower() and self.names.own("e"):
            self.names.notes.append(f"{token.text} is one number; the e in it is not yours")

    def _bracket(self, token: Token) -> None:
        """Parse a value in parentheses or between bars, whose first token is taken."""
        if token.text == "|":
            self.bars += 1
            self.parse(0)
            self.bars -= 1
            self.expect("|")
            self.emit("call", ("abs", 1), token.column)
            return
        outer, self.bars, self.joined = (self.bars, self.joined), 0, False
        self.parse(0)
        self.expect(")")
        self.bars, self.joined = outer

    def _root(self, token: Token) -> None:
        """Parse what stands behind √: parentheses, a call, or a number or name that nothing follows that may be its."""
        inside = self.peek()
        if inside.kind not in ("number", "name") and inside.text != "(":
            self.fail("write √(...)", inside.column)
        self.parse(_RAISED)
        following = self.peek()
        alone = inside.kind == "number" or (inside.kind == "name" and self.tokens[self.position - 1] is inside)
        if alone and (following.text == "^" or (self.power() in (_PRODUCT, _RAISED) and following.text not in "*/%")):
            self.fail("what belongs to the root? write √(...)", following.column)
        self.emit("call", ("sqrt", 1), token.column)

    def name(self, token: Token) -> None:
        """Parse a name or a call. Raises FirsthitError for an unknown name."""
        called = self.peek().text == "("
        meaning = self.names.meaning(token.text)
        if meaning is None:
            self._unknown(token, called)
            return
        kind, value = meaning
        if kind in ("function", "library", "built-in"):
            self._call(token, kind, value)
        else:
            self.emit(kind, value, token.column)

    def _unknown(self, token: Token, called: bool) -> None:
        """Parse a product of single letters. Raises FirsthitError if the word is none."""
        word = token.text
        if word in self.later:
            self.fail(f"{word!r} is defined later or by itself; a definition comes before its use", token.column)
        if not self.names.letters(word):
            self.fail(self.names.unknown(word, called), token.column)
        before = self.tokens[self.position - 2] if self.position > 1 else None
        split = "*".join(word)
        if before is not None and before.text in ("^", "/", "%", "√") and before.kind == "operator":
            sign = before.text
            self.fail(f"this can be read in two ways; write {sign}({split}) or {sign}{split}", token.column)
        # each letter becomes a token of its own, so that powers bind to the last one only
        letters = [Token("name", c, token.column + i) for i, c in enumerate(word)]
        self.tokens[self.position - 1 : self.position] = letters
        self.powers[self.position - 1 : self.position] = [_PRODUCT] * len(letters)
        self.name(letters[0])

    def _call(self, token: Token, kind: str, value: Any) -> None:
        """Parse a function's arguments, and add its call. Raises FirsthitError if their number is wrong."""
        name = token.text
        if self.peek().text != "(":
            power = self.peek().text == "^" or self.peek().kind == "raised"
            told = f"write {name}(...)^2 for the power of a function" if power else f"write {name}(...)"
            self.fail(f"{name!r} is a function; {told}", token.column)
        opening = self.take()
        outer, self.bars, self.joined = (self.bars, self.joined), 0, False
        self.depth += 1
        count = 1
        if self.peek().text == ")":
            self.fail(f"{name} takes a value; none is given", opening.column)
        self.parse(0)
        while self.peek().text == ",":
            self.take()
            self.parse(0)
            count += 1
        self.expect(")")
        self.depth -= 1
        self.bars, self.joined = outer
        if kind == "built-in":
            self._built_in(token, value, count)
        else:
            known: Mapping[int, Function] = {value.count: value} if kind == "function" else value
            if count not in known:
                self.fail(f"{name} takes {_values(*known)}, not {count}", token.column)
            self.emit("apply", known[count], token.column)

    def _built_in(self, token: Token, name: str, count: int) -> None:
        """Add the call of a function of the tape's own. Raises FirsthitError if the number of values is wrong."""
        wanted = BUILT_IN[name]
        if wanted is None and count < 2 and name != "length":
            self.fail(f"{name} takes two values or more", token.column)
        if wanted is not None and count != wanted:
            self.fail(f"{name} takes {_values(wanted)}, not {count}", token.column)
        code = {"if": "if", "pow": "^"}.get(name)
        self.emit(code or "call", None if code else (name, count), token.column)


def _values(*counts: int) -> str:
    """Return how a message names a number of values: "one value", "2 values", "1 or 2 values"."""
    if counts == (1,):
        return "one value"
    return f"{' or '.join(map(str, sorted(counts)))} values"
