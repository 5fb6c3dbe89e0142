"""Make random surfaces twice: as a formula's text, and as polynomials whose signs tell f's sign.

f need not be a polynomial: exp(p) - 1 has the sign of p, min(p, q) the lesser of two signs, and so has what is made of
such parts. So f's first root along a ray is known exactly (tests.exact_roots), although f itself is not.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import surfaces
from harness.contract import Surface
from surfaces.tape import Tape, walk
from tests.exact_roots import Poly, Signs, constant

Along = Callable[[Poly, Poly, Poly], Poly]  # a polynomial of x, y, z along a ray


@dataclass(frozen=True)
class Part:
    """Hold a polynomial in x, y and z: as text, and as a function of three polynomials in t."""

    text: str
    along: Along
    degree: int

    def __add__(self, other: Part) -> Part:
        text = f"({self.text} + {other.text})"
        return Part(text, lambda *p: self.along(*p) + other.along(*p), max(self.degree, other.degree))

    def __sub__(self, other: Part) -> Part:
        text = f"({self.text} - {other.text})"
        return Part(text, lambda *p: self.along(*p) - other.along(*p), max(self.degree, other.degree))

    def __mul__(self, other: Part) -> Part:
        text = f"{self.text}*{other.text}"
        return Part(f"({text})", lambda *p: self.along(*p) * other.along(*p), self.degree + other.degree)

    def __pow__(self, n: int) -> Part:
        return Part(f"({self.text})^{n}", lambda *p: self.along(*p) ** n, self.degree * n)


X, Y, Z = (Part(name, lambda *p, k=k: p[k], 1) for k, name in enumerate("xyz"))


def number(value: Fraction | int) -> Part:
    """Return a rational number as a part."""
    value = Fraction(value)
    text = str(value) if value >= 0 and value.denominator == 1 else f"({value})"
    return Part(text, lambda *_: constant(value), 0)


@dataclass(frozen=True)
class Shape:
    """Hold f as text, the parts whose signs tell f's, and how. `marks` are points at which rays are aimed.

    kind: "polynomial", "piecewise", "transcendental" or "jumps", which says what the oracle promises of it
    """

    text: str
    parts: tuple[Part, ...]
    sign: Callable[[Signs], int]
    kind: str
    marks: tuple[tuple[float, float, float], ...] = ()


MOST_DEGREE = 18  # of a surface of ours, so that the reference is quick
KINDS = ("polynomial", "piecewise", "transcendental", "jumps")


def small(pick: random.Random) -> Fraction:
    """Return a simple number between -1 and 1."""
    return Fraction(pick.randint(-8, 8), 8)


def wide(pick: random.Random) -> Fraction:
    """Return a number other than 0 of any size from 1e-6 to 1e6, or a simple one."""
    if pick.random() < 0.6:
        return Fraction(pick.choice([-1, 1]) * pick.randint(1, 9), pick.choice([1, 1, 2, 3, 4, 7]))
    return Fraction(pick.choice([-1, 1]) * pick.randint(1, 999)) * Fraction(10) ** pick.randint(-8, 4)


def sparse(pick: random.Random) -> Shape:
    """Make a polynomial of some random terms, up to degree 20."""
    degree = pick.choice([1, 2, 2, 3, 3, 4, 4, 5, 6, 7, 8, pick.randint(9, 20)])
    f = number(wide(pick))
    for k in range(pick.randint(1, 6)):
        term, left = number(wide(pick)), degree if not k else pick.randint(1, degree)
        for axis in pick.sample([X, Y, Z], 3):
            power = left if axis is Z else pick.randint(0, left)
            term, left = term * axis**power if power else term, left - power
        f = f + term
    return Shape(f.text, (f,), lambda s: s[0], "polynomial")


def _point(pick: random.Random) -> tuple[Fraction, Fraction, Fraction]:
    return small(pick), small(pick), small(pick)


def _about(point: tuple[Fraction, ...]) -> tuple[Part, ...]:
    return tuple(a - number(c) if c else a for a, c in zip((X, Y, Z), point, strict=True))


def piece(pick: random.Random) -> Shape:
    """Make a well-known surface about a simple point: it has tangent rays, nodes, or lies on special rays."""
    c = _point(pick)
    x, y, z = _about(c)
    r = Fraction(pick.randint(1, 8), 8)
    kind = pick.randrange(9)
    square = x**2 + y**2 + z**2
    at = [tuple(map(float, c))]
    if kind == 0:
        f = square - number(r * r)
        at = [tuple(float(v + (r if k == axis else 0)) for k, v in enumerate(c)) for axis in range(3)]
    elif kind == 1:
        f = number(small(pick)) * x + number(small(pick)) * y + z
    elif kind == 2:
        f = x**2 + y**2 - number(Fraction(pick.choice([1, 4, Fraction(1, 4)]))) * z**2
    elif kind == 3:
        f = (square + number(r * r - Fraction(1, 64))) ** 2 - number(4 * r * r) * (x**2 + y**2)
    elif kind == 4:
        f = x**2 + y**2 * z - number(r) * x * y
    elif kind == 5:
        f = number(4) * (x**2 + y**2 + z**2) + number(16) * x * y * z - number(1)  # Cayley's cubic, with four nodes
        at += [tuple(float(v + s) for v, s in zip(c, n, strict=True)) for n in ((-0.5, -0.5, -0.5), (0.5, 0.5, -0.5))]
    elif kind == 6:
        f = x**4 + y**4 + z**4 - number(r * r) * square
    elif kind == 7:
        f = x**2 * y**2 + y**2 * z**2 + z**2 * x**2 - number(r) * x * y * z  # Steiner's, with double lines
    else:
        f = x**2 - y**3 + number(small(pick)) * z**2
    return Shape(f.text, (f,), lambda s: s[0], "polynomial", tuple(at))  # type: ignore[arg-type]


def planted(pick: random.Random) -> Shape:
    """Make a product with repeated or neighbouring factors, or one that is moved off a touch by very little."""
    a, b = piece(pick), piece(pick)
    p, q = a.parts[0], b.parts[0]
    by = number(Fraction(pick.choice([-1, 1]), 10 ** pick.randint(3, 12)))
    f = pick.choice([p * q, p**2 * q, p**3, p**2, p * (p + by), p**2 + by, p * q + by, p**2 - by * q, p**2 + q**2])
    return Shape(f.text, (f,), lambda s: s[0], "polynomial", a.marks + b.marks)


def polynomial(pick: random.Random) -> Shape:
    """Make a polynomial of degree 12 at most, with points at which it is special."""
    while True:
        shape = pick.choice([piece, piece, planted])(pick)
        if shape.parts[0].degree <= 12:
            return shape


KEEPING = ["exp({}) - 1", "sinh({})", "tanh({})", "atan({})", "({})*exp(x)", "({})*(3/2 + sin(y))", "exp(z)*({})*2",
           "({})/(2 + cos(x*y))", "asinh({})", "({})*log(2 + x^2)", "exp({}) - cosh(0)", "sin(atan({}))"]  # fmt: skip
KEEPING_EXACTLY = ["cbrt({})", "({})*sqrt(x^2 + 1)", "({})/(1 + x^2 + y^2)", "({})^3", "({})/sqrt(1/4 + z^2)"]
COMPARING = ["exp({}) - exp({})", "atan({}) - atan({})", "sinh({}) - sinh({})", "tanh({}) - tanh({})"]


def kept(pick: random.Random) -> Shape:
    """Make a function that is no polynomial and has the sign of one."""
    a = polynomial(pick)
    kind, text = pick.choice([("transcendental", pick.choice(KEEPING)), ("piecewise", pick.choice(KEEPING_EXACTLY))])
    return Shape(text.format(a.text), a.parts, lambda s: s[0], "transcendental" if "cbrt" in text else kind, a.marks)


def compared(pick: random.Random) -> Shape:
    """Make a difference of two values of a rising function, or a distance."""
    a, b = piece(pick), piece(pick)
    p, q = a.parts[0], b.parts[0]
    r = Fraction(pick.randint(1, 8), 8)
    match pick.randrange(4):
        case 0:
            f, text, kind = p - q, pick.choice(COMPARING).format(p.text, q.text), "transcendental"
        case 1:
            f, text, kind = p**2 + q**2 - number(r * r), f"hypot({p.text}, {q.text}) - {r}", "piecewise"
        case 2:
            f, text, kind = p**2 - number(r * r), f"abs({p.text}) - {r}", "piecewise"
        case _:
            x, y, z = _about(_point(pick))
            f = x**2 + y**2 + z**2 - number(r * r)
            text, kind = f"length({x.text}, {y.text}, {z.text}) - {r}", "piecewise"
    return Shape(text, (f,), lambda s: s[0], kind, a.marks + b.marks)


def joined(pick: random.Random) -> Shape:
    """Make a minimum, maximum, product or choice of two to four surfaces."""
    shape = pick.choice([piece, piece, kept, compared])(pick)
    for _ in range(pick.randint(1, 3)):
        shape = _joined(pick, shape, pick.choice([piece, piece, piece, compared])(pick))
    return shape


def _joined(pick: random.Random, a: Shape, b: Shape) -> Shape:
    n, kinds = len(a.parts), {a.kind, b.kind, "piecewise"}
    name = pick.choice(["min", "max", "less", "min", "max", "less", "product", "abs", "if"])
    if name == "abs":
        text, sign = f"abs({a.text})*({b.text})", lambda s: abs(a.sign(s[:n])) * b.sign(s[n:])
    elif name == "product":
        text, sign = f"({a.text})*({b.text})", lambda s: a.sign(s[:n]) * b.sign(s[n:])
    elif name == "less":
        text, sign = f"max({a.text}, -({b.text}))", lambda s: max(a.sign(s[:n]), -b.sign(s[n:]))
    elif name == "if":
        kinds.add("jumps")
        asked = pick.choice(["<", "<=", ">", ">="])
        holds = {"<": lambda v: v < 0, "<=": lambda v: v <= 0, ">": lambda v: v > 0, ">=": lambda v: v >= 0}[asked]
        p = a.parts[0]
        text = f"if({p.text} {asked} 0, {a.text}, {b.text})"
        return Shape(
            text,
            a.parts + b.parts,
            lambda s: a.sign(s[:n]) if holds(s[0]) else b.sign(s[n:]),
            "jumps",
            a.marks + b.marks,
        )
    else:
        text = f"{name}({a.text}, {b.text})"
        least = min if name == "min" else max
        sign = lambda s: least(a.sign(s[:n]), b.sign(s[n:]))  # noqa: E731
    kind = max(kinds, key=KINDS.index)
    return Shape(text, a.parts + b.parts, sign, kind, a.marks + b.marks)


class _Surds:
    """Define the number system of pairs a + b·√d of polynomials in t, as far as a tape needs it."""

    def __init__(self) -> None:
        self.d = Fraction(0)

    def const(self, value: Fraction) -> tuple[Poly, Poly]:
        return constant(value), constant(0)

    def neg(self, a: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        return -a[0], -a[1]

    def add(self, a: tuple[Poly, Poly], b: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        return a[0] + b[0], a[1] + b[1]

    def sub(self, a: tuple[Poly, Poly], b: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        return a[0] - b[0], a[1] - b[1]

    def mul(self, a: tuple[Poly, Poly], b: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        return a[0] * b[0] + constant(self.d) * a[1] * b[1], a[0] * b[1] + a[1] * b[0]

    def sqr(self, a: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        return self.mul(a, a)

    def powi(self, a: tuple[Poly, Poly], n: int) -> tuple[Poly, Poly]:
        if n < 0:
            raise AttributeError("a negative power")
        result = self.const(Fraction(1))
        for _ in range(n):
            result = self.mul(result, a)
        return result

    def div(self, a: tuple[Poly, Poly], b: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        if len(b[0].num) != 1 or b[1].num:
            raise AttributeError("a division")
        return self.mul(a, (Poly([b[0].den * (1 if b[0].num[0] > 0 else -1)], abs(b[0].num[0])), constant(0)))

    def sqrt(self, a: tuple[Poly, Poly]) -> tuple[Poly, Poly]:
        value = Fraction(a[0].num[0], a[0].den) if len(a[0].num) == 1 and not a[1].num else Fraction(0)
        if value <= 0 or self.d not in (0, value):
            raise AttributeError("another root")
        self.d = value
        return constant(0), constant(1)


def _surd_sign(s: Signs) -> int:
    """Return the sign of a + b·√d of those of a, b and a² − d·b²."""
    a, b, norm = s
    return a if a == b or not b else b if not a else a * norm


def known_surface(surface: Surface) -> Shape | None:
    """Return a surface of ours as a shape, if it is a polynomial of moderate degree over Q or Q(√d); else None."""
    tape: Tape = surfaces.tape_of(surface)

    def along(x: Poly, y: Poly, z: Poly) -> tuple[Poly, Poly, Poly]:
        system = _Surds()
        point = dict(zip("xyz", ((p, constant(0)) for p in (x, y, z)), strict=True))
        a, b = walk(tape, system, point)[0]
        return a, b, a * a - constant(system.d) * b * b if b.num else a

    try:
        tried = along(Poly([1, 2]), Poly([2, 3]), Poly([3, 5]))
    except AttributeError:
        return None
    if max(len(p.num) for p in tried) > MOST_DEGREE + 1:
        return None
    if not tried[1].num:
        part = Part(surface.formula, lambda *p: along(*p)[0], len(tried[0].num) - 1)
        return Shape(surface.formula, (part,), lambda s: s[0], "polynomial")
    parts = tuple(Part(surface.formula, lambda *p, k=k: along(*p)[k], len(tried[k].num) - 1) for k in range(3))
    return Shape(surface.formula, parts, _surd_sign, "polynomial")


@lru_cache(maxsize=1)
def known() -> list[tuple[Surface, Shape]]:
    """Return the polynomial surfaces of the catalog and of the gallery."""
    every = [surfaces.get(name) for group in surfaces.groups() for name in surfaces.names(group)]
    return [(surface, shape) for surface in every if (shape := known_surface(surface))]
