"""Make random formulas by a grammar of its own, each together with the value that it has at one point."""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import mpmath

PARAMETERS = {"a": "0.25", "b": "1/4", "e": "2", "R": "sqrt(4)", "xyz": "-0.5"}
VALUES = {"a": 0.25, "b": 0.25, "e": 2.0, "R": 2.0, "xyz": -0.5}
POINT = {"x": Fraction(5, 8), "y": Fraction(-3, 4), "z": Fraction(11, 8)}
SPACES = ["", "", "", " ", "  "]


@dataclass
class Made:
    """Hold a formula's text, how tight its outermost operator binds, and its value, NaN where it has none."""

    text: str
    binding: int
    value: Any

    def inside(self, binding: int) -> str:
        """Return the text, in parentheses unless it binds tighter than `binding`."""
        return self.text if self.binding > binding else f"({self.text})"


def _value(name: str) -> Any:
    """Return the value of a coordinate or a parameter."""
    exact = Fraction(VALUES[name]) if name in VALUES else POINT[name]
    return mpmath.mpf(exact.numerator) / exact.denominator


def _mod(a: Any, b: Any) -> Any:
    return a - b * mpmath.floor(a / b)


def _sign(a: Any) -> Any:
    return mpmath.sign(a)


def largest(*values: Any) -> Any:
    """Return the largest value, NaN where one is not known: Python's `max` may pass it over."""
    return mpmath.nan if any(mpmath.isnan(value) for value in values) else max(values)


def _over(function: Any) -> Any:
    """Return one over a function, NaN where that is 0."""
    return lambda a: 1 / function(a) if abs(a) < 50 and function(a) else mpmath.nan


def _hermite(low: Any, high: Any, a: Any) -> Any:
    if low == high:
        return mpmath.nan
    t = min(max((a - low) / (high - low), 0), 1)
    return t * t * (3 - 2 * t)


def _power(a: Any, b: Any) -> Any:
    return a**b if a > 0 and abs(b * mpmath.log(a)) < 50 else mpmath.nan


FUNCTIONS: dict[str, tuple[int, Any]] = {
    "sqrt": (1, lambda a: mpmath.sqrt(a) if a >= 0 else mpmath.nan),
    "exp": (1, lambda a: mpmath.exp(a) if abs(a) < 50 else mpmath.nan),
    "log": (1, lambda a: mpmath.log(a) if a > 0 else mpmath.nan),
    "ln": (1, lambda a: mpmath.log(a) if a > 0 else mpmath.nan),
    "log10": (1, lambda a: mpmath.log10(a) if a > 0 else mpmath.nan),
    "sin": (1, mpmath.sin),
    "cos": (1, mpmath.cos),
    "abs": (1, abs),
    "ABS": (1, abs),
    "atan": (1, mpmath.atan),
    "asin": (1, lambda a: mpmath.asin(a) if abs(a) < 1 else mpmath.nan),
    "acos": (1, lambda a: mpmath.acos(a) if abs(a) < 1 else mpmath.nan),
    "sinh": (1, lambda a: mpmath.sinh(a) if abs(a) < 50 else mpmath.nan),
    "cosh": (1, lambda a: mpmath.cosh(a) if abs(a) < 50 else mpmath.nan),
    "tanh": (1, lambda a: mpmath.tanh(a) if abs(a) < 50 else mpmath.nan),
    "asinh": (1, mpmath.asinh),
    "floor": (1, mpmath.floor),
    "ceil": (1, mpmath.ceil),
    "round": (1, lambda a: mpmath.floor(a + mpmath.mpf(0.5))),
    "trunc": (1, lambda a: mpmath.floor(a) if a >= 0 else mpmath.ceil(a)),
    "fract": (1, lambda a: a - mpmath.floor(a)),
    "sign": (1, _sign),
    "cbrt": (1, lambda a: _sign(a) * mpmath.cbrt(abs(a))),
    "square": (1, lambda a: a * a),
    "cube": (1, lambda a: a**3),
    "mod": (2, lambda a, b: _mod(a, b) if b else mpmath.nan),
    "atan2": (2, lambda a, b: mpmath.atan2(a, b) if a or b else mpmath.mpf(0)),
    "min": (2, min),
    "max": (3, max),
    "hypot": (2, mpmath.hypot),
    "length": (3, lambda a, b, c: mpmath.sqrt(a * a + b * b + c * c)),
    "clamp": (3, lambda a, low, high: min(max(a, low), high)),
    "mix": (3, lambda a, b, t: a + (b - a) * t),
    "step": (2, lambda edge, a: mpmath.mpf(int(a >= edge))),
    "tan": (1, lambda a: mpmath.tan(a) if abs(mpmath.cos(a)) > 1e-6 else mpmath.nan),
    "sec": (1, _over(mpmath.cos)),
    "csc": (1, _over(mpmath.sin)),
    "cot": (1, lambda a: mpmath.cos(a) / mpmath.sin(a) if mpmath.sin(a) else mpmath.nan),
    "sech": (1, _over(mpmath.cosh)),
    "csch": (1, _over(mpmath.sinh)),
    "coth": (1, _over(mpmath.tanh)),
    "acosh": (1, lambda a: mpmath.acosh(a) if a > 1 else mpmath.nan),
    "atanh": (1, lambda a: mpmath.atanh(a) if abs(a) < 1 else mpmath.nan),
    "arcsin": (1, lambda a: mpmath.asin(a) if abs(a) < 1 else mpmath.nan),
    "arctan": (1, mpmath.atan),
    "log2": (1, lambda a: mpmath.log(a, 2) if a > 0 else mpmath.nan),
    "exp2": (1, lambda a: mpmath.mpf(2) ** a if abs(a) < 50 else mpmath.nan),
    "radians": (1, mpmath.radians),
    "degrees": (1, mpmath.degrees),
    "saturate": (1, lambda a: min(max(a, 0), mpmath.mpf(1))),
    "sgn": (1, _sign),
    "fabs": (1, abs),
    "frac": (1, lambda a: a - mpmath.floor(a)),
    "sqr": (1, lambda a: a * a),
    "pow": (2, _power),
    "fmod": (2, lambda a, b: a - b * (mpmath.floor(a / b) if a / b >= 0 else mpmath.ceil(a / b)) if b else mpmath.nan),
    "fmin": (2, min),
    "fmax": (2, max),
    "norm": (3, lambda a, b, c: mpmath.sqrt(a * a + b * b + c * c)),
    "lerp": (3, lambda a, b, t: a + (b - a) * t),
    "smoothstep": (3, _hermite),
    "dot": (4, lambda a, b, p, q: a * p + b * q),
}
CONSTANTS = {
    "pi": lambda: +mpmath.pi,
    "π": lambda: +mpmath.pi,
    "phi": lambda: +mpmath.phi,
    "sqrt3": lambda: mpmath.sqrt(3),
}
COMPARISONS: dict[str, Any] = {
    "<": lambda a, b: a < b, "<=": lambda a, b: a <= b, "≤": lambda a, b: a <= b, ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b, "==": lambda a, b: a == b, "!=": lambda a, b: a != b, "≠": lambda a, b: a != b,
}  # fmt: skip

EXPONENTS = [("^2", 2), ("²", 2), ("**3", 3), ("⁴", 4), ("^-1", -1), ("⁻²", -2), ("^0.5", 0.5), ("^(5/2)", 2.5),
             ("^x", 0.625), ("^0", 0), ("^1.25", 1.25)]  # fmt: skip


class Maker:
    """Make random formulas. `names` and `functions` are those that the formula has defined, with what they mean."""

    def __init__(self, pick: random.Random) -> None:
        self.pick = pick
        self.names: dict[str, Any] = {}
        self.functions: dict[str, tuple[int, Any]] = {}

    def space(self) -> str:
        return self.pick.choice(SPACES)

    def leaf(self) -> Made:
        """Make a number or a name."""
        pick = self.pick
        match pick.randrange(5):
            case 4 if pick.random() < 0.4:
                text = pick.choice(list(CONSTANTS))
                return Made(text, 60, CONSTANTS[text]())
            case 0:
                text = pick.choice(["1", "2", "3", "0.5", ".25", "4.", "1e-2", "12.5", "0"])
                return Made(text, 60, mpmath.mpf(text))
            case 1:
                text = pick.choice(list(VALUES))
                return Made(text, 60, mpmath.mpf(VALUES[text]))
            case 2 if self.names:
                text = pick.choice(list(self.names))
                return Made(text, 60, self.names[text])
        text = pick.choice("xyzXYZ")
        return Made(text, 60, _value(text.lower()))

    def made(self, depth: int) -> Made:
        """Make a value of at most this depth."""
        if depth == 0:
            return self.leaf()
        kinds = [self.sum, self.sum, self.product, self.product, self.side_by_side, self.factors, self.quotient,
                 self.power, self.call, self.call, self.sign, self.bars, self.root, self.choice]  # fmt: skip
        return self.pick.choice(kinds)(depth - 1)

    def sum(self, depth: int) -> Made:
        a, b, sign = self.made(depth), self.made(depth), self.pick.choice(["+", "-", "−"])
        text = f"{a.inside(9)}{self.space()}{sign}{self.space()}{b.inside(10)}"
        return Made(text, 10, a.value + b.value if sign == "+" else a.value - b.value)

    def product(self, depth: int) -> Made:
        a, b, sign = self.made(depth), self.made(depth), self.pick.choice(["*", "*", "·", "×"])
        return Made(f"{a.inside(19)}{self.space()}{sign}{self.space()}{b.inside(20)}", 20, a.value * b.value)

    def side_by_side(self, depth: int) -> Made:
        """Make a product without a sign, in parentheses, so that nothing before it makes it ambiguous."""
        a, b = self.made(depth), self.made(depth)
        return Made(f"(({a.text}){self.space()}({b.text}))", 60, a.value * b.value)

    def factors(self, depth: int) -> Made:
        """Make a product without a sign as people write it: 2xy(z + 1), in parentheses."""
        pick, text, value = self.pick, "", mpmath.mpf(1)
        if pick.random() < 0.6:
            text = pick.choice(["2", "0.5", "3 ", "4.", "12"])
            value = mpmath.mpf(text)
        word = "".join(pick.choice("xyzab") for _ in range(pick.randint(1, 3)))
        word = "x" if word in VALUES else word
        for letter in word:
            value *= _value(letter)
        text += word
        if pick.random() < 0.5:
            power, n = pick.choice([("^2", 2), ("²", 2), ("^3", 3)])
            text, value = text + power, value * _value(word[-1]) ** (n - 1)
        if pick.random() < 0.5:
            a = self.made(depth)
            text, value = f"{text}{self.space()}({a.text})", value * a.value
        return Made(f"({text})", 60, value)

    def quotient(self, depth: int) -> Made:
        a, b = self.made(depth), self.made(depth)
        sign = self.pick.choice("//÷%")
        divided = _mod if sign == "%" else mpmath.fdiv
        value = divided(a.value, b.value) if b.value else mpmath.nan
        return Made(f"{a.inside(19)}{self.space()}{sign}{self.space()}{b.inside(20)}", 20, value)

    def power(self, depth: int) -> Made:
        a = self.made(depth)
        text, n = self.pick.choice(EXPONENTS)
        value = a.value
        if (n != int(n) and not value >= 0) or (n == 0.625 and value == 0) or (n < 0 and not value):
            return Made(f"({a.text}){text}", 40, mpmath.nan)
        return Made(f"({a.text}){text}", 40, value ** mpmath.mpf(n) if abs(value) < 1e6 else mpmath.nan)

    def call(self, depth: int) -> Made:
        known = {**FUNCTIONS, **self.functions}
        own = bool(self.functions) and self.pick.random() < 0.5
        name = self.pick.choice(list(self.functions if own else known))
        count, function = known[name]
        values = [self.made(depth if i == 0 else max(depth - 2, 0)) for i in range(count)]
        finite = not any(mpmath.isnan(v.value) or abs(v.value) > 1e9 for v in values)
        value = function(*(v.value for v in values)) if finite else mpmath.nan
        return Made(f"{name}({(self.space() + ',' + self.space()).join(v.text for v in values)})", 60, value)

    def sign(self, depth: int) -> Made:
        a = self.made(depth)
        return Made(f"-{a.inside(30)}", 30, -a.value)

    def bars(self, depth: int) -> Made:
        a = self.made(depth)
        return Made(f"|({a.text})|", 60, abs(a.value))

    def root(self, depth: int) -> Made:
        a = self.made(depth)
        return Made(f"√({a.text})", 60, mpmath.sqrt(a.value) if a.value >= 0 else mpmath.nan)

    def choice(self, depth: int) -> Made:
        a, b = self.made(max(depth - 1, 0)), self.made(max(depth - 1, 0))
        p, q = self.made(depth), self.made(depth)
        sign = self.pick.choice(list(COMPARISONS))
        text = f"{a.inside(8)}{self.space()}{sign}{self.space()}{b.inside(8)}"
        holds = COMPARISONS[sign](a.value, b.value)
        if self.pick.random() < 0.3:
            text, holds = self.pick.choice(["not({})", "!({})"]).format(text), not holds
        if self.pick.random() < 0.3:
            word, all_ = self.pick.choice([("and", True), ("&&", True), ("or", False), ("||", False)])
            text = f"{text} {word} x > 0.5"
            holds = holds if all_ else True
        unknown = mpmath.isnan(a.value) or mpmath.isnan(b.value)
        value = mpmath.nan if unknown else p.value if holds else q.value
        if self.pick.random() < 0.1:
            return Made(f"({text})", 60, mpmath.nan if unknown else mpmath.mpf(int(holds)))
        if self.pick.random() < 0.5:
            return Made(f"if({text}, {p.text}, {q.text})", 60, value)
        return Made(f"({text} ? {p.text} : {q.text})", 60, value)

    def function(self) -> str:
        """Define a function of one or two values, and return the text of that."""
        a, b, name = self.made(1), self.made(1), self.pick.choice(["g", "blend", "q2"])
        match self.pick.randrange(3):
            case 0:
                text, self.functions[name] = "u^2*{} - {}", (1, lambda u: u * u * a.value - b.value)
            case 1:
                text, self.functions[name] = "u*{} + v*{}", (2, lambda u, v: u * a.value + v * b.value)
            case _:
                text, self.functions[name] = "max(u, v*{}, {})", (2, lambda u, v: largest(u, v * a.value, b.value))
        given = "u" if self.functions[name][0] == 1 else "u, v"
        return f"{self.pick.choice(['let ', ''])}{name}({given}) = {text.format(a.inside(59), b.inside(59))};\n"

    def formula(self) -> Made:
        """Make a whole formula, with definitions before it, comments and an equation."""
        pick, text = self.pick, ""
        self.names, self.functions = {}, {}
        if pick.random() < 0.3:
            text = self.function()
        for name in pick.sample(["d", "r1", "part", "q"], pick.choice([0, 0, 0, 1, 2])):
            value = self.made(pick.randrange(3))
            text += (
                f"{pick.choice(['let ', ''])}{name} = {value.text};{pick.choice([' ', chr(10), '# said' + chr(10)])}"
            )
            self.names[name] = value.value
        a = self.made(pick.randrange(5))
        if pick.random() < 0.3:
            b = self.made(pick.randrange(3))
            return Made(f"{text}{a.inside(9)} = {b.inside(9)}", 0, a.value - b.value)
        return Made(text + a.inside(9) + pick.choice(["", ";", " // end"]), 0, a.value)
