"""Read POV-Ray scenes: cubic, quartic, poly, polynomial, quadric and isosurface, and the numbers in them.

The manual (3.7, sections "Poly, Cubic and Quartic" and "Isosurface") gives the order of coefficients and the defaults.
A function's operators and how they bind are those of its parser (parser_functions.cpp: there is no ^). A part of a CSG
is read without what it is combined with. No other file is opened, and no loop, condition or macro is run.
"""

from __future__ import annotations

from dataclasses import replace

from surfaces.files.expressions import (
    SUM,
    Text,
    both,
    call,
    choose,
    compare,
    div,
    either,
    negative,
    power,
    rational,
    word,
)
from surfaces.files.placing import applied
from surfaces.files.povray_shapes import SHAPES, Shapes, Solid
from surfaces.files.source import Reading, Source, Token, tokens
from surfaces.files.syntax import (
    PLAIN,
    SAME,
    Dialect,
    Parser,
    Parts,
    Scope,
    comparison,
    coordinates,
    folded,
    one,
    shown,
)
from surfaces.model import FirsthitError

NAME = "a POV-Ray scene"
CSG = ("union", "difference", "intersection", "merge")
_SKIPPED = ("version", "default", "debug", "warning", "undef")
_FUNCTION = "give it as a formula"


def _selected(a: Text, *rest: Text) -> Text:
    """Return POV-Ray's select: b for a < 0, else c; or b, c, d for a < 0, a = 0, a > 0."""
    if len(rest) == 2:
        return choose(compare(a, "<", word("0")), *rest)
    return choose(compare(a, "<", word("0")), rest[0], choose(compare(a, "==", word("0")), rest[1], rest[2]))


DIALECT = Dialect(
    infix={
        "|": (10, either),
        "&": (20, both),
        **{sign: (30, comparison({"=": "=="}.get(sign, sign))) for sign in ("=", "!=", "<", "<=", ">", ">=")},
        **PLAIN,
        "/": (60, div),
    },
    prefix={"-": (70, negative), "+": (70, lambda a: a)},
    functions={
        **SAME,
        **{name: one(name) for name in ("floor", "ceil", "asinh", "acosh", "atanh", "radians", "degrees")},
        "int": one("trunc"),
        "ln": one("log"),
        "log": one("log10"),
        "sqr": (1, 1, lambda a: power(a, word("2"))),
        "pow": (2, 2, power),
        "atan2": (2, 2, lambda a, b: call("atan2", a, b)),
        "mod": (2, 2, lambda a, b: call("fmod", a, b)),
        "min": (1, 20, folded("min")),
        "max": (1, 20, folded("max")),
        "select": (3, 4, _selected),
    },
    names={"pi": word("pi"), "clock": rational(0), **{name: rational(1) for name in ("yes", "true", "on")}}
    | {name: rational(0) for name in ("no", "false", "off")},
    unread={"sum": "loops are not run", "prod": "loops are not run", "^": "POV-Ray has no such power; write pow(a, b)"}
    | {
        f"f_{name}": _FUNCTION
        for name in ("torus", "sphere", "noise3d", "noise_generator", "ridged_mf", "heart", "helix1")
    },
)


class Scene:
    """Read a scene's statements. `solids` are the shapes, in their order."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.parts = Parts()
        self.parser = Parser(source, tokens(source), DIALECT, Scope(coordinates(), {}, set("xyz") | {"fmod"}))
        self.parts.define("fmod", Text(("a - b*trunc(a/b)",), SUM), ("a", "b"))
        self.shapes = Shapes(source, self.parser, self.parts)
        self.solids: list[Solid] = []
        self.declared: dict[str, list[Solid]] = {}
        self.csg: list[str] = []

    def read(self) -> None:
        """Read all statements. Raises FirsthitError at one that is none, or not read."""
        while self.parser.peek().kind != "end":
            if self.parser.took("#"):
                self._directive()
            elif not self.parser.took(";"):
                self.solids += self._statement()

    def _directive(self) -> None:
        """Read what stands behind a #."""
        token = self.parser.name()
        if token.text in ("declare", "local"):
            self._declare()
        elif token.text == "include":
            self.source.remark(f"left out: #include {self.parser.take().text[:60]} (no other file is opened)")
        elif token.text in _SKIPPED:
            self._skip_value()
        else:
            self.source.fail(f"#{token.text} is not run; write out what it makes", token.line)

    def _declare(self) -> None:
        """Read the declaration of a number, a function or a shape; others are skipped."""
        parser, name = self.parser, self.parser.name()
        parser.expect("=")
        token = parser.peek()
        if token.text in (*SHAPES, *CSG, "object"):
            found = self._statement()
            for solid in found:
                solid.name = solid.name or name.text
            self.declared[name.text] = found
        elif token.text == "function":
            self._function(name)
        elif token.kind == "number" or token.text in ("-", "+", "(") or self._is_number(token):
            self._number(name.text)
        else:
            self._skip_value()
        parser.took(";")

    def _number(self, name: str) -> None:
        """Read the value of a number. One that is not read is skipped, and is unknown where it is used."""
        parser, start = self.parser, self.parser.at
        try:
            value = parser.expression()
        except FirsthitError:
            parser.at, parser.depth = start, 0
            self._skip_value()
        else:
            parser.scope.values[name] = self.parts.define(parser.scope.fresh(name), value)

    def _is_number(self, token: Token) -> bool:
        """Return whether a name begins a number."""
        known = {**DIALECT.names, **DIALECT.functions, **self.parser.scope.values}
        return token.kind == "name" and token.text in known and token.text not in ("x", "y", "z")

    def _function(self, name: Token) -> None:
        """Read the declaration of a function."""
        self.parser.take()
        given = self.shapes.arguments()
        value, ours = self.shapes.body(given)
        called = self.parser.scope.fresh(name.text)
        self.parser.scope.functions[name.text] = len(given), called
        self.parts.define(called, value, ours)

    def _statement(self) -> list[Solid]:
        """Read a statement that begins with a name, and return the shapes in it."""
        parser = self.parser
        name = parser.name()
        if name.text in SHAPES:
            return [self.shapes.shape(name)]
        if name.text in CSG:
            return self._combined(name)
        if name.text == "object" and parser.peek(1).text in self.declared and parser.peek().text == "{":
            parser.take()
            called = parser.take().text
            copies = [replace(solid, moves=list(solid.moves)) for solid in self.declared[called]]
            self.shapes.modifiers(copies)
            return copies
        if parser.peek().text != "{":
            self.source.fail(f"expected '{{' behind {name.text[:40]!r}, found {shown(parser.peek())}", name.line)
        self.shapes.left.append(name.text)
        self.shapes.skip_block()
        return []

    def _combined(self, name: Token) -> list[Solid]:
        """Read a CSG: its shapes, each alone."""
        self.parser.expect("{")
        self.parser.depth += 1
        if self.parser.depth > 50:
            self.source.fail("nested more than 50 deep", name.line)
        found: list[Solid] = []
        while self.parser.peek().text in (*SHAPES, *CSG, "object") or self._is_block():
            found += self._statement()
        self.shapes.modifiers(found)
        self.parser.depth -= 1
        self.csg.append(name.text)
        return found

    def _is_block(self) -> bool:
        """Return whether a shape that is not read, or another block, is next in a CSG."""
        modifiers = ("clipped_by", "bounded_by")
        return (
            self.parser.peek().kind == "name"
            and self.parser.peek(1).text == "{"
            and self.parser.peek().text not in modifiers
        )

    def _skip_value(self) -> None:
        """Skip what stands behind a # or an = that is not read: up to a ;, or to the end of its line and its blocks."""
        line = self.parser.peek().line
        while (token := self.parser.peek()).kind != "end" and token.line == line and token.text != "#":
            if token.text == "{":
                self.shapes.skip_block()
                line = self.parser.words[self.parser.at - 1].line
            elif self.parser.take().text == ";":
                return


def read(source: Source) -> Reading:
    """Read a scene. Raises FirsthitError where it has no shape that is an implicit surface."""
    scene = Scene(source)
    scene.read()
    solids = [*scene.solids, *(solid for found in scene.declared.values() for solid in found)]
    if not solids:
        only = f" (it has {', '.join(dict.fromkeys(scene.shapes.left))})"[:200] if scene.shapes.left else ""
        source.fail(f"the scene has none of {', '.join(SHAPES)}{only}")
    names = [solid.name or solid.kind for solid in solids]
    solid = solids[source.choose(names, "shape")]
    if scene.csg:
        source.left_out(scene.csg, "a shape is read alone, without what it is combined with")
    source.left_out(scene.shapes.left, "how it looks, and other shapes")
    return Reading(_placed(scene, solid), solid.region or "", name=solid.name)


def _placed(scene: Scene, solid: Solid) -> str:
    """Return the formula of a shape where its moves put it."""
    parts, scope = scene.parts, scene.parser.scope
    if not solid.moves:
        return parts.formula(solid.value)
    called = scope.fresh(solid.kind)
    parts.define(called, solid.value, ("x", "y", "z"))
    at = (word("x"), word("y"), word("z"))
    for step, move in enumerate(reversed(solid.moves), 1):
        news = [applied(row, at) for row in move.back]
        x, y, z = (
            new if len(str(new)) == 1 else parts.define(scope.fresh(f"{axis}{step}"), new)
            for axis, new in zip("xyz", news, strict=True)
        )
        at = (x, y, z)
    return parts.formula(call(called, *at))
