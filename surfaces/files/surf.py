"""Read scripts of surf (.pic), the program of Stephan Endrass: `poly f = x*y*z; surface = f; draw_surface;`.

Its manual (surf-alggeo 1.0.6) lists the types int, double, string and poly, the operators, and the variables that say
what is drawn. The surface is clipped at the ball of `radius`, 10 by default, about (center_x, center_y, center_z), or
at a cube of that half edge; scale_x, scale_y and scale_z multiply coordinates before the equation sees them, so that
the domain is so much smaller. Quotients of whole numbers are fractions, as in its parser. Conditions are not run.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from fractions import Fraction

from surfaces import formula
from surfaces.files.expressions import ATOM, Text, add, call, div, mul, negative, power, rational, sub, word
from surfaces.files.source import Reading, Source, Token, tokens
from surfaces.files.syntax import PLAIN, Dialect, Parser, Parts, Scope, coordinates, function, one, shown
from surfaces.model import Box, Domain, FirsthitError, Sphere

NAME = "a surf script"
TYPES = ("int", "double", "poly", "polyxyz", "string")
AXES = ("xAxis", "yAxis", "zAxis")
SURFACES = ("surface", *(f"surface{i}" for i in range(2, 10)))
CLIPS = {"ball": 0, "sphere": 0, "cylinder_xaxis": 1, "cylinder_yaxis": 2, "cylinder_zaxis": 3, "cube": 4, "none": 5}
VIEW = {  # numbers that decide the domain, and their defaults
    "clip": 0.0,
    "radius": 10.0,
    **{f"{name}_{axis}": value for name, value in (("center", 0.0), ("scale", 1.0)) for axis in "xyz"},
    **{f"{name}_{axis}": 0.0 for name in ("rot", "origin") for axis in "xyz"},
    "clip_front": 10.0,
    "clip_back": -10.0,
}
_UNREAD = {
    "len": "it counts terms",
    "diff": "write the derivative",
    "hesse": "write the polynomial",
    "itostr": "it is a text",
    "itostrn": "it is a text",
}


def _remainder(a: Text, b: Text) -> Text:
    """Return the remainder of whole numbers, with the sign of the first, as in C."""
    if a.value is None or not b.value or a.value.denominator != 1 or b.value.denominator != 1:
        raise FirsthitError("% is read between whole numbers only")
    size = abs(a.value) % abs(b.value)
    return rational(size if a.value >= 0 else -size)


DIALECT = Dialect(
    infix={**PLAIN, "/": (60, div), "%": (60, _remainder), "^": (80, power)},
    prefix={"-": (70, negative), "+": (70, lambda a: a)},
    functions={
        **{name: one(name) for name in ("sqrt", "sin", "cos", "tan")},
        **{f"arc{name}": one(f"a{name}") for name in ("sin", "cos", "tan")},
        "pow": (2, 2, power),
        "cot": one("cot"),
        "arccot": (1, 1, lambda a: sub(div(word("pi"), word("2")), call("atan", a))),
        "deg": (1, 1, function("deg")),  # replaced by those of the script that knows its parts
        "rotate": (3, 3, function("rotate")),
    },
    names={
        **{name: Text((str(value),), ATOM, Fraction(value)) for name, value in CLIPS.items()},
        **{name: Text((str(value),), ATOM, Fraction(value)) for name, value in (("yes", 1), ("no", 0))},
        **{name: word(name) for name in AXES},
    },
    unread=_UNREAD,
)


@dataclass
class Drawn:
    """Hold what one `draw_surface` draws: the polynomials by their variables, and the numbers of VIEW."""

    surfaces: dict[str, Text]
    view: dict[str, float]


@dataclass
class Script:
    """Run a script, statement after statement."""

    source: Source
    parser: Parser
    parts: Parts = field(default_factory=Parts)
    kinds: dict[str, str] = field(default_factory=dict)
    surfaces: dict[str, Text] = field(default_factory=dict)
    view: dict[str, float] = field(default_factory=lambda: dict(VIEW))
    drawn: list[Drawn] = field(default_factory=list)
    draws: int = 0
    skipped: list[str] = field(default_factory=list)
    commands: list[str] = field(default_factory=list)

    def run(self) -> None:
        """Run all statements. Raises FirsthitError at one that is none, or not read."""
        while self.parser.peek().kind != "end":
            if not self.parser.took(";"):
                self._statement()

    def _statement(self) -> None:
        """Run one statement."""
        parser, first = self.parser, self.parser.name()
        if first.text in ("if", "goto"):
            self.source.fail(f"{first.text!r}: conditions and loops are not run; write out what they draw", first.line)
        if first.text in TYPES:
            self._declaration(first.text)
        elif parser.took(":"):
            return  # a label
        elif parser.took("="):
            self._assignment(first)
            parser.expect(";")
        else:
            self._command(first)

    def _declaration(self, kind: str) -> None:
        """Declare a name, and give it a value where there is one."""
        name = self.parser.name()
        if name.text in self.kinds:
            self.source.fail(f"{name.text[:40]!r} is declared twice", name.line)
        self.kinds[name.text] = kind
        if self.parser.took("="):
            self._assignment(name)
        self.parser.expect(";")

    def _assignment(self, name: Token) -> None:
        """Give a name its value. A value that concerns the picture only is skipped."""
        kind = self.kinds.get(name.text)
        wanted = kind in ("int", "double", "poly", "polyxyz") or name.text in VIEW or name.text in SURFACES
        if not wanted:
            if kind is None:
                self.skipped.append(name.text)
            while self.parser.peek().text != ";" and self.parser.peek().kind != "end":
                self.parser.take()
            return
        try:
            value = self.parser.expression()
        except FirsthitError as error:
            if str(error).startswith(str(self.source.path)):
                raise
            self.source.fail(str(error), name.line)
        if name.text in SURFACES:
            self.surfaces[name.text] = self.parser.scope.values[name.text] = value
        elif name.text in VIEW:
            self.view[name.text] = self.parts.constant(self.source, value, name.text, name.line)
        else:
            if kind == "int" and value.value is not None and value.value.denominator != 1:
                self.source.fail(f"int {name.text[:40]} is given {value.value}, which is not whole", name.line)
            scope = self.parser.scope
            scope.values[name.text] = self.parts.define(scope.fresh(name.text), value)

    def _command(self, name: Token) -> None:
        """Run a command, which is a word with nothing behind it."""
        token = self.parser.take()
        if token.text != ";" and token.kind != "end":
            self.source.fail(f"expected '=' or ';' behind {name.text[:40]!r}, found {shown(token)}", token.line)
        if name.text == "draw_surface":
            self.draws += 1
            if not self.drawn:
                self.drawn.append(Drawn(dict(self.surfaces), dict(self.view)))
        elif name.text not in ("clear_screen", "clear_pixmap", "set_size"):
            self.commands.append(name.text)

    def degree(self, value: Text) -> Text:
        """Return the degree of a polynomial, which surf's deg is."""
        return rational(formula.degree(formula.parse(self.parts.formula(value))) or 0)

    def turned(self, value: Text, angle: Text, axis: Text) -> Text:
        """Return a polynomial at turned points, as surf's rotate makes it (polyarith: polyxyz_rotate_x, _y and _z).

        About the z axis it takes x to x*c + y*s and y to y*c - x*s, about the others x or y and z likewise.
        """
        if str(axis) not in AXES:
            raise FirsthitError(f"rotate takes {', '.join(AXES)}, not {str(axis)[:40]!r}")
        first, second = {"xAxis": (1, 2), "yAxis": (0, 2), "zAxis": (0, 1)}[str(axis)]
        cosine, sine = call("cos", angle), call("sin", angle)
        at = [word(name) for name in "xyz"]
        p, q = at[first], at[second]
        at[first], at[second] = add(mul(p, cosine), mul(q, sine)), sub(mul(q, cosine), mul(p, sine))
        return call(self._function(value), *at)

    def _function(self, value: Text) -> str:
        """Return the name of a function of x, y and z with a polynomial's values, also of the parts that it names."""
        scope, moving = self.parser.scope, {"x", "y", "z"}
        called: dict[str, str] = {}

        def written(text: Text) -> Text:
            names = re.compile(r"[A-Za-z_][A-Za-z_0-9]*")
            return word(names.sub(lambda m: f"{called[m[0]]}(x, y, z)" if m[0] in called else m[0], str(text)))

        for name, arguments, part in list(self.parts.texts):
            if not arguments and moving & set(re.findall(r"[A-Za-z_][A-Za-z_0-9]*", str(part))):
                moving.add(name)
                own = scope.fresh(name)
                self.parts.define(own, written(part), ("x", "y", "z"))
                called[name] = own
        own = scope.fresh("turned")
        self.parts.define(own, written(value), ("x", "y", "z"))
        return own


def read(source: Source) -> Reading:
    """Read a script. Raises FirsthitError where it draws no surface, or has statements that are not run."""
    scope = Scope(coordinates(), {}, set("xyz"))
    script = Script(source, Parser(source, tokens(source), DIALECT, scope))
    functions = {**DIALECT.functions, "deg": (1, 1, script.degree), "rotate": (3, 3, script.turned)}
    script.parser.dialect = Dialect(**{**vars(DIALECT), "functions": functions})
    script.run()
    drawn = script.drawn[0] if script.drawn else Drawn(script.surfaces, script.view)
    if not drawn.surfaces:
        curve = "curve" in script.skipped
        source.fail(f"the script draws {'a plane curve and ' if curve else ''}no surface: it has no surface=…")
    names = list(drawn.surfaces)
    chosen = names[source.choose(names, "surface")]
    if script.draws > 1:
        source.remark(f"the script draws {script.draws} pictures; the first is taken")
    source.left_out(dict.fromkeys([*script.skipped, *script.commands]), "what concerns the picture")
    return Reading(script.parts.formula(drawn.surfaces[chosen]), _domain(source, drawn.view))


def _domain(source: Source, view: dict[str, float]) -> Domain:
    """Return where the surface is clipped, in the equation's coordinates."""
    radius = view["radius"]
    scale, center, turns, origin = (
        [view[f"{name}_{axis}"] for axis in "xyz"] for name in ("scale", "center", "rot", "origin")
    )
    if radius <= 0.0 or not all(scale):
        source.fail(f"radius {radius:g} and scales {scale}: the clipping region is empty")
    if any(origin):
        source.remark("left out: origin_x, origin_y, origin_z (they move the picture); the domain is not moved")
    if (view["clip_front"], view["clip_back"]) != (VIEW["clip_front"], VIEW["clip_back"]):
        source.remark("left out: clip_front and clip_back (planes that clip the picture)")
    clip = int(view["clip"])
    if clip not in (CLIPS["ball"], CLIPS["cube"]):
        word_ = next((name for name, value in CLIPS.items() if value == clip), str(clip))
        source.remark(f"left out: clip = {word_}; the ball of the same radius is the domain")
    sizes = [abs(factor) * radius for factor in scale]
    turned = any(turns)
    if turned and any(center):
        source.remark("the clipping region is turned about the origin; the ball around it is the domain")
        return Sphere(
            max(map(abs, scale)) * (radius * (3.0**0.5 if clip == 4 else 1.0) + sum(c * c for c in center) ** 0.5)
        )
    middle = [factor * c for factor, c in zip(scale, center, strict=True)]
    if clip == CLIPS["cube"] and not turned:
        lower, upper = ([m + sign * s for m, s in zip(middle, sizes, strict=True)] for sign in (-1, 1))
        return Box((lower[0], lower[1], lower[2]), (upper[0], upper[1], upper[2]))
    if clip == CLIPS["cube"]:
        source.remark("the clipping cube is turned; the ball around it is the domain")
        return Sphere(max(sizes) * 3.0**0.5)
    if min(sizes) < max(sizes):
        source.remark(
            "the clipping ball is an ellipsoid in the equation's coordinates; the ball around it is the domain"
        )
    return Sphere(max(sizes), (middle[0], middle[1], middle[2]))
