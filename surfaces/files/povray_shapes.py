"""Read the shapes of a POV-Ray scene: their equations, where they are clipped, and how they are placed."""

from __future__ import annotations

from dataclasses import dataclass, field

from surfaces.files.expressions import Text, mul, rational, sub, word
from surfaces.files.monomials import order_of, polynomial
from surfaces.files.placing import Move, by_matrix, moved, rotations, scaling, translation
from surfaces.files.source import Source, Token
from surfaces.files.syntax import Parser, Parts, Scope
from surfaces.model import Box, Domain, Sphere

SHAPES = ("cubic", "quartic", "poly", "polynomial", "quadric", "isosurface")
MAX_ORDER = 35  # of poly, in 3.7
_FACTOR = 60  # binds as a factor of a product does
_ENTRY = 40  # binds tighter than a comparison, whose > would end a vector
_AXES = ("x", "y", "z")
_REGIONS = {"bounded_by": 0, "contained_by": 1, "clipped_by": 2}  # which of them says more about where a shape ends


@dataclass
class Solid:
    """Hold a shape: f in x, y and z, where it is clipped, and the moves that place it."""

    kind: str
    line: int
    value: Text
    region: Domain | None = None
    rank: int = 0  # of the word that the region is from, in _REGIONS
    moves: list[Move] = field(default_factory=list)
    name: str = ""

    def clip(self, region: Domain | None, rank: int) -> None:
        """Take a region, unless there is one that says more."""
        if region is not None and (self.region is None or rank >= self.rank):
            self.region, self.rank = region, rank

    def move(self, source: Source, move: Move) -> None:
        """Move the shape, and the region that it has so far."""
        self.moves.append(move)
        if self.region is not None:
            self.region, exact = moved(self.region, move)
            if not exact:
                source.remark(f"{self.kind}: its region is turned or stretched; the box around it is the domain")


class Shapes:
    """Read shapes from the words of a scene. `left` gathers the names of what is skipped."""

    def __init__(self, source: Source, parser: Parser, parts: Parts) -> None:
        self.source, self.parser, self.parts = source, parser, parts
        self.left: list[str] = []

    def arguments(self) -> list[str]:
        """Read the names of a function's arguments, which are x, y and z where none are written."""
        start = self.parser.peek()
        if not self.parser.took("("):
            return list(_AXES)
        given = [self.parser.name().text]
        while self.parser.took(","):
            given.append(self.parser.name().text)
        self.parser.expect(")")
        if len(set(given)) < len(given):
            self.source.fail("two arguments have one name", start.line)
        return given

    def body(self, given: list[str]) -> tuple[Text, list[str]]:
        """Read { expression } in arguments of these names; return it, and the arguments' names in our language."""
        parser, outer = self.parser, self.parser.scope
        inner = Scope(dict(outer.values), dict(outer.functions), set(outer.taken))
        ours = [name if name in _AXES else inner.fresh(name) for name in given]
        inner.values.update(zip(given, map(word, ours), strict=True))
        parser.expect("{")
        parser.scope = inner
        value = parser.expression()
        parser.scope = outer
        parser.expect("}")
        return value, ours

    def shape(self, name: Token) -> Solid:
        """Read a shape and what is inside its braces."""
        self.parser.expect("{")
        if name.text == "isosurface":
            solid = self._isosurface(name)
        else:
            value = self._quadric() if name.text == "quadric" else self._polynomial(name)
            if value is None:
                self.source.fail(f"all coefficients of this {name.text} are 0", name.line)
            solid = Solid(name.text, name.line, value)
        self.modifiers([solid])
        return solid

    def _polynomial(self, name: Token) -> Text | None:
        """Read the coefficients of a cubic, quartic, poly or polynomial."""
        parser, source = self.parser, self.source
        degree = {"cubic": 3, "quartic": 4}.get(name.text)
        if degree is None:
            degree = self._order(name)
            parser.took(",")
        if name.text == "polynomial":
            return self._by_powers(degree)
        values = self._vector(None)
        order = order_of(degree)
        if len(values) != len(order):
            source.fail(f"a {name.text} of order {degree} has {len(order)} coefficients, not {len(values)}", name.line)
        return polynomial(zip(values, order, strict=True))

    def _order(self, name: Token) -> int:
        """Read the order of a polynomial."""
        value = self.parser.expression(_ENTRY).value
        if value is None or value.denominator != 1 or not 2 <= value <= MAX_ORDER:
            self.source.fail(f"{name.text} has a whole order from 2 to {MAX_ORDER}", name.line)
        return int(value)

    def _by_powers(self, degree: int) -> Text | None:
        """Read terms such as xyz(2,0,1): 3, where a later one replaces an earlier one."""
        parser, terms = self.parser, {}
        while parser.peek().text == "xyz":
            token = parser.take()
            parser.expect("(")
            powers = [parser.expression(_ENTRY).value]
            for _ in range(2):
                parser.expect(",")
                powers.append(parser.expression(_ENTRY).value)
            parser.expect(")")
            parser.expect(":")
            i, j, k = (int(p) if p is not None and p.denominator == 1 and p >= 0 else -1 for p in powers)
            if min(i, j, k) < 0 or i + j + k > degree:
                self.source.fail(f"xyz has three whole powers whose sum is at most {degree}", token.line)
            terms[i, j, k] = parser.expression(_ENTRY)
            parser.took(",")
        return polynomial((terms[powers], powers) for powers in order_of(degree) if powers in terms)

    def _quadric(self) -> Text | None:
        """Read <A,B,C>,<D,E,F>,<G,H,I>,J."""
        values: list[Text] = []
        for _ in range(3):
            values += self._vector(3)
            self.parser.took(",")
        values.append(self.parser.expression(_ENTRY))
        powers = [(2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 1, 0), (1, 0, 1), (0, 1, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        return polynomial(zip(values, [*powers, (0, 0, 0)], strict=True))

    def _vector(self, count: int | None) -> list[Text]:
        """Read <a, b, …>. Raises FirsthitError where it has another number of entries than `count`."""
        start = self.parser.expect("<")
        values = [self.parser.expression(_ENTRY)]
        while not self.parser.took(">"):
            self.parser.took(",")  # which POV-Ray lets be left out
            values.append(self.parser.expression(_ENTRY))
        if count is not None and len(values) != count:
            self.source.fail(f"expected {count} numbers between < and >, found {len(values)}", start.line)
        return values

    def _numbers(self, values: list[Text], line: int) -> tuple[float, float, float]:
        """Return the values of constants."""
        x, y, z = (self.parts.constant(self.source, value, "a coordinate", line) for value in values)
        return x, y, z

    def _isosurface(self, name: Token) -> Solid:
        """Read an isosurface up to its modifiers: its function, and the container that it has where none is given."""
        parser = self.parser
        if parser.take().text != "function":
            self.source.fail("an isosurface begins with function { … }", name.line)
        given = self.arguments()
        value, _ = self.body(given)
        if given != list(_AXES):
            self.source.fail("an isosurface's function has the arguments x, y, z", name.line)
        return Solid("isosurface", name.line, value, Box((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)), _REGIONS["contained_by"])

    def _region(self, token: Token) -> Domain | None:
        """Read a { sphere { } } or { box { } } with its moves; return None for another shape, which is skipped."""
        parser = self.parser
        parser.expect("{")
        kind = parser.peek().text
        found: Domain | None = None
        if kind in ("box", "sphere") and parser.peek(1).text == "{":
            self._opened()
            a = self._numbers(self._triple(), token.line)
            parser.took(",")
            if kind == "box":
                b = self._numbers(self._triple(), token.line)
                lower, upper = (tuple(f(p, q) for p, q in zip(a, b, strict=True)) for f in (min, max))
                found = Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))
            else:
                found = Sphere(self.parts.constant(self.source, parser.expression(_ENTRY), "a radius", token.line), a)
            held = Solid(token.text, token.line, word("x"), found)
            self.modifiers([held])
            found = held.region
        elif kind not in _REGIONS:
            self.source.remark(f"left out: {token.text} with {kind[:40]} (a sphere or a box is read)")
        while not parser.took("}"):
            if parser.peek().kind == "end":
                parser.expect("}")
            elif parser.peek().text == "{":
                self.skip_block()
            else:
                parser.take()
        return found

    def _opened(self) -> None:
        """Go on behind a name and {."""
        self.parser.take()
        self.parser.expect("{")

    def modifiers(self, solids: list[Solid]) -> None:
        """Read what stands behind a shape up to the end of its braces: moves, regions, and how it looks."""
        parser = self.parser
        while not parser.took("}"):
            token = parser.peek()
            if token.kind == "end":
                parser.expect("}")
            parser.take()
            if token.text in ("translate", "scale", "rotate", "matrix"):
                for move in self._move(token):
                    for solid in solids:
                        solid.move(self.source, move)
            elif token.text in _REGIONS:
                region = self._region(token)
                for solid in solids:
                    solid.clip(region, _REGIONS[token.text])
            elif token.text == "threshold":
                level = parser.expression(_ENTRY)
                for solid in solids:
                    solid.value = solid.value if level.value == 0 else sub(solid.value, level)
            elif token.text == "#":
                self.source.fail("directives inside a shape are not read", token.line)
            elif parser.peek().text == "{" and token.kind == "name":
                self.left.append(token.text)
                self.skip_block()
            elif token.text == "{":
                self.source.fail("'{' has no place here", token.line)

    def _move(self, token: Token) -> list[Move]:
        """Read a translation, a scaling, turns or a matrix."""
        name = token.text
        if name == "matrix":
            values = [value.value for value in self._vector(12)]
            known = [value for value in values if value is not None]
            move = by_matrix(known) if len(known) == 12 else None
            if move is None:
                why = "it has no inverse" if len(known) == 12 else "its numbers are not rational"
                self.source.fail(f"this matrix cannot be carried over: {why}", token.line)
            return [move]
        vector = self._triple()
        numbers = self._numbers(vector, token.line)
        by = (vector[0], vector[1], vector[2])
        if name == "scale" and 0.0 in numbers:
            self.source.fail("scale by 0", token.line)
        if name == "rotate":
            return rotations(by, numbers)
        return [translation(by, numbers) if name == "translate" else scaling(by, numbers)]

    def _triple(self) -> list[Text]:
        """Read a vector <a, b, c>, or times a number; or what `_along_axes` reads."""
        if self.parser.peek().text != "<":
            return self._along_axes()
        vector = self._vector(3)
        while self.parser.took("*"):
            factor = self.parser.expression(_FACTOR)
            vector = [mul(entry, factor) for entry in vector]
        return vector

    def _along_axes(self) -> list[Text]:
        """Read a vector that is written with x, y and z, as in 90*x, or a number, which stands for all three."""
        parser, start, scope = self.parser, self.parser.at, self.parser.scope
        entries = []
        for axis in _AXES:
            parser.at = start
            values = {**scope.values, **{other: rational(int(other == axis)) for other in _AXES}}
            parser.scope = Scope(values, scope.functions, scope.taken)
            entry = parser.expression(_ENTRY)
            entries.append(entry if entry.value is None else rational(entry.value))
        parser.scope = scope
        return entries

    def skip_block(self) -> None:
        """Skip { … } with all that is inside."""
        start = self.parser.expect("{")
        depth = 1
        while depth:
            token = self.parser.take()
            if token.kind == "end":
                self.source.fail("this '{' has no '}'", start.line)
            depth += (token.text == "{") - (token.text == "}") if token.kind == "operator" else 0
